#pragma once
// How wrong an answer to "what is visible from here?" is, against the exact visible surface.

#include <sightline/algorithms/baseline/depth_buffer.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/traits/point_traits.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace sightline {

/// Areas are shares of the sphere of directions, 0 to 1. Visible is what the eye sees from the front; what is shown may
/// be seen from either side.
struct Visible_errors {
  double wrong = 0;  ///< another face is shown than the exact one, or none, or one where there is none; pieces of one
                     ///< face are not told apart
  double tied = 0;   ///< another face is shown, but one in the same plane that is there too: not wrong
  std::uint64_t wrongly_visible = 0;  ///< faces that the answer calls visible, and that are not
  std::uint64_t wrongly_hidden = 0;   ///< the other way round
  std::uint64_t missing = 0;          ///< faces of the exact surface, seen from the front, that are shown nowhere
  double largest_missing = 0;         ///< the largest area of one of them
  double gaps = 0;      ///< directions that no part holds; where there is something to see they are wrong too
  double overlaps = 0;  ///< directions that two parts hold, counted for each two; where one is wrong they are wrong too
  /// Parts or pieces whose numbers say nothing; they are left out, and their area is missing.
  std::uint64_t not_finite = 0;
};

namespace visible_errors_detail {

using Ray_direction = std::array<double, 3>;
using Image_point = std::array<double, 2>;  ///< right, up, in [-1, 1], of a side of the cube
using Image_polygon = std::vector<Image_point>;

/// What is narrower, in an image of width 2, is rounding and counts as nothing.
inline constexpr double rounding = 0x1p-46;

double cross(const Image_point& a, const Image_point& b, const Image_point& c);

/// The solid angle of a polygon: of the triangles of a fan, the sign as they turn. Ref: Van Oosterom and Strackee 1983.
double solid_angle(const Image_polygon& p);

/// The convex hull, counterclockwise, without corners that are one but for rounding.
Image_polygon hull(Image_polygon points);

/// The part of a convex polygon to the left of the line from p to q, or to its right. Degenerate: a part that is
/// nowhere farther from the line than rounding is empty.
Image_polygon clipped(const Image_polygon& polygon, const Image_point& p, const Image_point& q, bool left = true);
Image_polygon intersection(Image_polygon a, const Image_polygon& b);
/// Convex polygons that fill what is in one of `polygons` and not in b.
std::vector<Image_polygon> without(std::vector<Image_polygon> polygons, const Image_polygon& b);

/// What a convex cone covers of a side of the cube, its corners as they run. Pre: finite directions, none of them zero.
Image_polygon on_side(const std::vector<Ray_direction>& cone, const Cube_side& side);

// ---- Rays as doubles, the largest coordinate 1: each within 2^-52 of what it stands for

Ray_direction direction(const std::array<Rational, 3>& d);
Ray_direction direction(const Exact_view& view, const Exact_view::Ray& r);
template <class FT>
Ray_direction direction(const Number_view<FT>&, const typename Number_view<FT>::Ray& r) {
  using number = Field_number<FT>;
  if constexpr (!std::is_floating_point_v<FT>) {
    return direction(std::array<Rational, 3>{number::to(r.v[0]), number::to(r.v[1]), number::to(r.v[2])});
  } else {
    const std::array<double, 3> v{r.v[0], r.v[1], r.v[2]};
    const double size = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
    return {v[0] / size, v[1] / size, v[2] / size};  // no numbers where the size is 0 or infinite
  }
}

// ---- A surface in six images

struct Image_part {
  std::uint32_t piece;  // or nothing
  Image_polygon polygon;
  Image_point low, high;  // its box
};

/// Parts of an image, and which of them are near a box.
class Image {
 public:
  void add(std::uint32_t piece, Image_polygon polygon);
  std::span<const Image_part> parts() const { return parts_; }

  /// Sorts the parts into a grid of about as many cells.
  void make_grid();
  /// The parts whose boxes meet that of another one. Pre: make_grid().
  std::vector<std::uint32_t> near(const Image_part& other);

 private:
  template <class Function>
  void each_cell(const Image_part& part, Function function);

  std::vector<Image_part> parts_;
  std::size_t cells_ = 1;
  std::vector<std::vector<std::uint32_t>> grid_;
  std::vector<std::uint32_t> met_;
  std::uint32_t round_ = 0;
};

/// A visible surface in the six images of the cube.
struct Images {
  std::array<Image, 6> sides;
  std::vector<double> areas;         // of each piece, in steradians
  std::vector<unsigned char> shown;  // whether a piece is shown
  std::uint64_t not_finite = 0;

  template <View V>
  Images(const V& view, const Visible_surface<V>& surface)
      : areas(view.scene().pieces().size(), 0.0), shown(areas.size(), 0) {
    std::vector<Ray_direction> cone;
    for (const auto& part : surface.parts) {
      cone.clear();
      bool finite = true;
      for (const typename V::Ray& r : surface.of(part)) {
        Ray_direction d = direction(view, r);
        finite = finite && std::isfinite(d[0] + d[1] + d[2]) && (d[0] != 0 || d[1] != 0 || d[2] != 0);
        // A ray that rounding turned round is drawn where its line meets the plane in front of the eye, as
        // view.position() has it.
        if constexpr (!V::is_exact)
          if (part.piece != surface.nothing && view.nearness(part.piece, {d[0], d[1], d[2]}) < 0)
            d = {-d[0], -d[1], -d[2]};
        cone.push_back(d);
      }
      if (!finite) {
        ++not_finite;
        continue;
      }
      if (part.piece != surface.nothing) shown[part.piece] = 1;
      for (std::size_t side = 0; side < 6; ++side) {
        Image_polygon polygon = on_side(cone, cube_sides[side]);
        if (part.piece != surface.nothing) areas[part.piece] += std::fabs(solid_angle(polygon));
        if (polygon = hull(std::move(polygon)); !polygon.empty()) sides[side].add(part.piece, std::move(polygon));
      }
    }
  }
};

}  // namespace visible_errors_detail

/// The exact visible surface, ready to be compared with: answers to the same question by other means, over the whole
/// sphere. All areas are measured in doubles, on the six images of a cube around the eye: solid angles of polygons
/// whose corners are rounded to about 2^-50 of an image. What is narrower than 2^-46 counts as no difference, so that
/// equal answers differ by 0, or by some 10^-17 where parts are about that narrow, and 10^-12 where an edge is so short
/// that its line is off by as much; a wrong area is right to about 2^-48 for each part that it is made of. Nothing else
/// is rounded: which faces are visible, and who is seen in a part, is exact. Pre: the view and its scene outlive it;
/// the surface covers the whole sphere.
class Visible_reference {
 public:
  Visible_reference(Exact_view&&, const Visible_surface<Exact_view>&) = delete;
  Visible_reference(const Exact_view& view, const Visible_surface<Exact_view>& surface)
      : view_(&view), visible_(surface.visible), images_(view, surface) {}

  /// Of an answer made in other numbers: a partition into cones that may have gaps and overlaps. A cone that rounding
  /// made concave stands for its hull in each image. Cost: about O(n) for n parts, and what differs. Exact: areas no,
  /// see above; counts yes.
  template <View V>
  Visible_errors errors(const V& view, const Visible_surface<V>& surface) {
    using namespace visible_errors_detail;
    Visible_errors e;
    Images answer(view, surface);
    e.not_finite = answer.not_finite;
    double wrong = 0, gaps = 0, overlaps = 0;
    for (std::size_t side = 0; side < 6; ++side) {
      Image& image = answer.sides[side];
      image.make_grid();
      for (const Image_part& part : images_.sides[side].parts()) {
        std::vector<std::pair<double, std::uint32_t>> shown;  // the largest first, so that little is left to cut
        for (const std::uint32_t i : image.near(part)) {
          const Image_part& other = image.parts()[i];
          const Image_polygon both = intersection(part.polygon, other.polygon);
          if (both.empty()) continue;
          wrong += wrong_area(side, part.piece, other.piece, both, e);
          shown.emplace_back(-solid_angle(both), i);
        }
        std::sort(shown.begin(), shown.end());
        std::vector<Image_polygon> left{part.polygon};
        for (const auto& [area, i] : shown) left = without(std::move(left), image.parts()[i].polygon);
        double gap = 0;
        for (const Image_polygon& polygon : left) gap += solid_angle(polygon);
        gaps += gap;
        if (part.piece != nothing) wrong += gap;
      }
      for (std::uint32_t i = 0; i < image.parts().size(); ++i)
        for (const std::uint32_t j : image.near(image.parts()[i]))
          if (i < j) overlaps += solid_angle(intersection(image.parts()[i].polygon, image.parts()[j].polygon));
    }
    e.wrong = wrong / sphere;
    e.gaps = gaps / sphere;
    e.overlaps = overlaps / sphere;
    count(surface.visible, answer.shown, e);
    return e;
  }

  /// Of a depth buffer: each pixel shows its piece all over. Visible are faces with a piece that has a pixel, and that
  /// the eye is in front of. Cost: O(pixels that each exact part meets). Exact: areas no, see above; counts yes.
  Visible_errors errors(const Depth_buffer& buffer);

 private:
  using Image_polygon = visible_errors_detail::Image_polygon;
  static constexpr std::uint32_t nothing = Depth_buffer::nothing;
  static constexpr double sphere = 4 * std::numbers::pi;
  static_assert(nothing == Visible_surface<Exact_view>::nothing);

  Face_id face(std::uint32_t piece) const { return view_->scene().pieces()[piece].face; }
  bool same(std::uint32_t f, std::uint32_t g) const {
    return f == g || (f != nothing && g != nothing && face(f) == face(g));
  }

  /// The area of a polygon where f is seen and g is shown, less what of it is tied.
  double wrong_area(std::size_t side, std::uint32_t f, std::uint32_t g, const Image_polygon& polygon,
                    Visible_errors& e);
  /// All of a piece in an image.
  const Image_polygon& outline(std::size_t side, std::uint32_t piece);
  /// `visible`: sorted.
  void count(const std::vector<Face_id>& visible, const std::vector<unsigned char>& shown, Visible_errors& e) const;

  const Exact_view* view_;
  std::vector<Face_id> visible_;
  visible_errors_detail::Images images_;
  std::map<std::pair<std::uint32_t, std::size_t>, Image_polygon> outlines_;
};

}  // namespace sightline
