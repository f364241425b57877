#pragma once
// Perspective pictures of polygons, drawn as a painter would: the canvas, the camera, colours and names.

#include "common.h"

#include <sightline/algorithms/verify/covering.h>
#include <sightline/io/svg.h>
#include <sightline/kernel/vectors.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sightline::app {

using Direction3 = std::array<double, 3>;

/// Exact points and vectors in doubles that hold them however far and however large all is: from an origin, in a unit
/// of about a size, which is a power of two. Exact: rounded once.
class Near_doubles {
 public:
  /// Degenerate: a unit of one where the size is 0.
  Near_doubles(Exact_point origin, const Rational& size)
      : origin_(std::move(origin)), exponent_(size == 0 ? 0 : -binary_exponent(size)) {}
  Direction3 point(const Exact_point& p) const { return vector(minus(p, origin_)); }
  Direction3 vector(const Exact_point& v) const;

 private:
  Exact_point origin_;
  long exponent_;
};
/// Of a box.
Near_doubles near_doubles(const std::array<Exact_point, 2>& box);

/// A fragment as drawn: where it is, and which part of its face.
struct Drawn {
  Order_fragment fragment;   ///< exact vertices; `piece` is the convex piece of the face, as in the certificate
  std::uint32_t number = 0;  ///< among the fragments of its face
  Sign side = CGAL::ZERO;    ///< of the eye to the face's front, as the kernel saw it
};

/// Two whole numbers, as in 960x720. Errors: Usage_error naming the option, where it is something else, or one of them
/// is not between least and most.
std::array<int, 2> parse_size(const std::string& text, const std::string& option, int least, int most);

/// What a picture is drawn on: the options of every command that draws one.
struct Canvas_arguments {
  std::string size, background;

  /// `usual`: what the help says of the size where none is given.
  void add_to(Command command, const std::string& usual);
  std::array<int, 2> size_or(const std::array<int, 2>& usual) const;
  std::string background_or(const std::string& usual) const { return background.empty() ? usual : background; }
};
/// The colour of words on a background: dark, or light where that is dark. Pre: one that --background takes.
std::string ink_on(const std::string& background);
/// Red, green, blue and opacity, each 0 to 255.
std::array<int, 4> rgba_of(const std::string& background);

/// Where one looks from, and where to.
struct View {
  Exact_point eye;
  std::array<double, 3> look{};  ///< a direction; zero: to the centre of the scene
  std::array<double, 3> up{0, 0, 1};
  double field = 60;  ///< degrees, of the picture's width
  int width = 960, height = 720;
  std::string background = "#f4f3ef";
  bool lit = true;  ///< faces are lighter towards the light
};

/// Adds --shade to a command that draws.
Option add_shade_option(Command command, std::string& shade);

/// What there is to say of an option of a picture where none is drawn.
Usage_error no_picture_for(const std::string& option);

/// Of a picture's width, in degrees.
inline constexpr double least_field = 1e-6, most_field = 170;

/// The options of a picture's view.
struct View_arguments {
  std::string look, up, shade = "lambert";
  double field = 0;  ///< 0: so that what is shown fills the picture
  Canvas_arguments canvas;

  /// `usual`: what the help says of the size where none is given.
  void add_to(Command command, const std::string& usual = "by default 960 wide, and as high as what there is to see");
  void check_usage() const;         ///< before a long read. Errors: Usage_error
  const char* first_given() const;  ///< the name of an option that is not as it is by default; null: none
  /// The same, and that none is given where there is no picture.
  void check_usage(bool has_picture) const;
  /// Fitted to the points that are shown, or to all of the scene: what is not given of direction, field and height is
  /// such that these fill the picture but for so many pixels along its sides. Where they are all around the eye, it
  /// looks to the middle of the scene, 90 degrees wide. Aimed, unless the scene is empty. in_time(): before each turn
  /// over the points; what it throws ends them. Errors: Usage_error.
  View view(const Exact_point& eye, const Scene& scene, double margin = usual_margin, const Report& in_time = {}) const;
  View view(const Exact_point& eye, const Scene& scene, const std::vector<Exact_point>& shown, double margin,
            const Report& in_time = {}) const;
  static constexpr double usual_margin = 24;
};

/// Unit vectors to the right and upwards in the picture.
struct Axes {
  std::array<double, 3> right, up;
};
/// Pre: the view is aimed.
Axes axes_of(const View& view);
/// Fills in the direction where it is zero.
View aimed(View view, const Scene& scene);
/// The near plane of a view in grid coordinates: across the direction, a thousandth of the scene's size in front of the
/// eye. Nothing where all of the scene is in front of it, or no face is left.
std::optional<std::array<Integer, 4>> near_plane(const View& view, const Scene& scene);
/// The view's four corner rays, counterclockwise around its inside in the sense of field_of(). Exactly these doubles.
std::vector<Exact_point> corner_rays(const View& view);
/// A point of the scene in the picture. Pre: in front of the eye.
Flat_point projected(const View& view, const Exact_point& p);
/// The same of what is so far from the eye, in doubles. Pre: the axes are the view's.
Flat_point projected(const View& view, const Axes& axes, const Direction3& from_eye);
/// How a polygon is drawn.
struct Look {
  std::string fill;   ///< a colour that SVG knows
  std::string title;  ///< what it is, in words
};
/// For a polygon and a shade from -1 to 1 by the way that it faces.
using Look_of = std::function<Look(const Drawn&, double shade)>;
/// A hue for each face; back sides are duller. Pale ones are paper for lines.
Look look_by_face(const Drawn& item, double shade);
Look pale_look(const Drawn& item, double shade);
/// Paints each polygon over those before it, with thin outlines or without. The n-th polygon of face 7 has the id
/// face-7-n, from 1. Pre: nothing drawn is behind the near plane.
void paint(Svg& svg, const View& view, const std::vector<Drawn>& drawn, bool outlines,
           const Look_of& look = look_by_face);
Svg empty_picture(const View& view);

/// The light of pictures on a polygon: -1 to 1.
double shade_of(const std::vector<Exact_point>& corners);
/// The colours of look_by_face() in red, green and blue, each 0 to 255.
std::array<double, 3> colour_by_face(Face_id face, bool front, double shade);

}  // namespace sightline::app
