#pragma once
// A perspective picture of an order, drawn as a painter would.

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

/// A fragment as drawn: where it is, and which part of its face.
struct Drawn {
  Order_fragment fragment;   ///< exact vertices; `piece` is the convex piece of the face, as in the certificate
  std::uint32_t number = 0;  ///< among the fragments of its face
  Sign side = CGAL::ZERO;    ///< of the eye to the face's front, as the kernel saw it
};

/// Where one looks from, and where to.
struct View {
  Exact_point eye;
  std::array<double, 3> look{};  ///< a direction; zero: to the centre of the scene
  std::array<double, 3> up{0, 0, 1};
  double field = 60;  ///< degrees, of the picture's width
  int width = 960, height = 720;
};

/// The options of a picture's view.
struct View_arguments {
  std::string look, up;
  double field = 60;

  void add_to(Command command);
  /// Aimed, unless the scene is empty. Errors: Usage_error.
  View view(const Exact_point& eye, const Scene& scene) const;
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
/// eye. Nothing where all of the scene is in front of it.
std::optional<std::array<Integer, 4>> near_plane(const View& view, const Scene& scene);
/// The view's four corner rays, counterclockwise around its inside in the sense of field_of(). Exactly these doubles.
std::vector<Exact_point> corner_rays(const View& view);
/// A point of the scene in the picture. Pre: in front of the eye.
Flat_point projected(const View& view, const Exact_point& p);
/// A colour that SVG knows, for a polygon and a shade from -1 to 1 by the way that it faces.
using Colour = std::function<std::string(const Drawn&, double)>;
/// A hue for each face; back sides are duller.
std::string colour_by_face(const Drawn& item, double shade);
/// Paints each polygon over those before it, with thin outlines or without. Pre: nothing drawn is behind the near
/// plane.
void paint(Svg& svg, const View& view, const std::vector<Drawn>& drawn, bool outlines,
           const Colour& colour = colour_by_face);
Svg empty_picture(const View& view);

}  // namespace sightline::app
