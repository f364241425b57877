#pragma once
// How wrong an answer to "what is visible from here?" is, against the exact visible surface.

#include <sightline/algorithms/baseline/depth_buffer.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/point_visibility/visible.h>

#include <numbers>

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
  std::uint64_t not_finite =
      0;  ///< parts or pieces whose numbers say nothing; they are left out, and their area is missing
};

namespace visible_errors_detail {

using Ray_direction = std::array<double, 3>;
using Image_point = std::array<double, 2>;  ///< right, up, in [-1, 1], of a side of the cube
using Image_polygon = std::vector<Image_point>;

/// What is narrower, in an image of width 2, is rounding and counts as nothing.
inline constexpr double rounding = 0x1p-46;

inline double cross(const Image_point& a, const Image_point& b, const Image_point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// The solid angle of a polygon: of the triangles of a fan, the sign as they turn. Ref: Van Oosterom and Strackee 1983.
inline double solid_angle(const Image_polygon& p) {
  double sum = 0;
  const auto dot = [](const Image_point& a, const Image_point& b) { return 1 + a[0] * b[0] + a[1] * b[1]; };
  for (std::size_t k = 1; k + 1 < p.size(); ++k) {
    const Image_point &a = p[0], &b = p[k], &c = p[k + 1];
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    sum += 2 * std::atan2(cross(a, b, c), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum;
}

/// The convex hull, counterclockwise, without corners that are one but for rounding.
inline Image_polygon hull(Image_polygon points) {
  std::sort(points.begin(), points.end());
  Image_polygon chain;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = chain.size();
    for (const Image_point& p : points) {
      while (chain.size() >= start + 2 && cross(chain[chain.size() - 2], chain.back(), p) <= 0) chain.pop_back();
      chain.push_back(p);
    }
    if (!chain.empty()) chain.pop_back();
    std::reverse(points.begin(), points.end());
  }
  const auto close = [](const Image_point& a, const Image_point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1]) <= rounding;
  };
  chain.erase(std::unique(chain.begin(), chain.end(), close), chain.end());
  while (chain.size() > 1 && close(chain.front(), chain.back())) chain.pop_back();
  if (chain.size() < 3) chain.clear();
  return chain;
}

/// The part of a convex polygon to the left of the line from p to q, or to its right. Degenerate: a part that is
/// nowhere farther from the line than rounding is empty.
inline Image_polygon clipped(const Image_polygon& polygon, const Image_point& p, const Image_point& q,
                             bool left = true) {
  const std::size_t n = polygon.size();
  const double length = (left ? 1 : -1) * std::hypot(q[0] - p[0], q[1] - p[1]);
  thread_local std::vector<double> distance;
  distance.assign(n, 0);
  bool inside = false, outside = false;
  for (std::size_t k = 0; k < n; ++k) {
    const double d = cross(p, q, polygon[k]) / length;
    distance[k] = std::fabs(d) <= rounding ? 0 : d;
    inside = inside || distance[k] > 0, outside = outside || distance[k] < 0;
  }
  if (!inside) return {};
  if (!outside) return polygon;
  Image_polygon part;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = k + 1 == n ? 0 : k + 1;
    const double a = distance[k], b = distance[next];
    if (a >= 0) part.push_back(polygon[k]);
    if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
      const double t = a / (a - b);
      part.push_back({polygon[k][0] + t * (polygon[next][0] - polygon[k][0]),
                      polygon[k][1] + t * (polygon[next][1] - polygon[k][1])});
    }
  }
  return part;
}
inline Image_polygon intersection(Image_polygon a, const Image_polygon& b) {
  for (std::size_t k = 0; k < b.size() && !a.empty(); ++k) a = clipped(a, b[k], b[k + 1 == b.size() ? 0 : k + 1]);
  return a;
}
/// Convex polygons that fill what is in one of `polygons` and not in b.
inline std::vector<Image_polygon> without(std::vector<Image_polygon> polygons, const Image_polygon& b) {
  std::vector<Image_polygon> left;
  for (Image_polygon& a : polygons) {
    if (intersection(a, b).empty()) {
      left.push_back(std::move(a));
      continue;
    }
    for (std::size_t k = 0; k < b.size() && !a.empty(); ++k) {
      const Image_point &p = b[k], &q = b[k + 1 == b.size() ? 0 : k + 1];
      if (Image_polygon part = clipped(a, p, q, false); !part.empty()) left.push_back(std::move(part));
      a = clipped(a, p, q);
    }
  }
  return left;
}

/// What a convex cone covers of a side of the cube, its corners as they run. Pre: finite directions, none of them zero.
inline Image_polygon on_side(const std::vector<Ray_direction>& cone, const Cube_side& side) {
  std::vector<Ray_direction> polygon, next;
  for (const Ray_direction& d : cone) polygon.push_back(side.turned(d));
  for (const std::size_t axis : {0, 1})
    for (const int sense : {1, -1}) {
      next.clear();
      const auto form = [&](const Ray_direction& d) { return d[2] + sense * d[axis]; };
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Ray_direction &p = polygon[k], &q = polygon[k + 1 == polygon.size() ? 0 : k + 1];
        const double a = form(p), b = form(q);
        if (a >= 0) next.push_back(p);
        if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
          const double t = a / (a - b);
          next.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])});
        }
      }
      polygon.swap(next);
      if (polygon.size() < 3) return {};
    }
  Image_polygon image;
  for (const Ray_direction& d : polygon)
    if (d[2] > 0) image.push_back({std::clamp(d[0] / d[2], -1.0, 1.0), std::clamp(d[1] / d[2], -1.0, 1.0)});
  return image;
}

// ---- Rays as doubles, the largest coordinate 1: each within 2^-52 of what it stands for
// --------------------------------------------

inline Ray_direction direction(const std::array<Rational, 3>& d) {
  Rational size = 0;
  for (const Rational& x : d) size = std::max(size, Rational(abs(x)));
  if (size == 0) return {0, 0, 0};
  return {nearest_double(Rational(d[0] / size)), nearest_double(Rational(d[1] / size)),
          nearest_double(Rational(d[2] / size))};
}
inline Ray_direction direction(const Exact_view& view, const Exact_view::Ray& r) {
  const std::array<Integer, 3> d = view.direction(r);
  long shift = 0;
  for (const Integer& x : d) shift = std::max(shift, static_cast<long>(bit_length(x)));
  Ray_direction to;
  for (std::size_t k = 0; k < 3; ++k) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, d[k].get_mpz_t());
    to[k] = std::ldexp(mantissa, static_cast<int>(std::max(exponent - shift, -5000L)));
  }
  return to;
}
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
// ---------------------------------------------------------------------------------------------------------

struct Part {
  std::uint32_t piece;  // or nothing
  Image_polygon polygon;
  Image_point low, high;  // its box
};

/// Parts of an image, and which of them are near a box.
class Image {
 public:
  void add(std::uint32_t piece, Image_polygon polygon) {
    Part part{piece, std::move(polygon), {1, 1}, {-1, -1}};
    for (const Image_point& p : part.polygon)
      for (std::size_t k = 0; k < 2; ++k)
        part.low[k] = std::min(part.low[k], p[k]), part.high[k] = std::max(part.high[k], p[k]);
    parts_.push_back(std::move(part));
  }
  std::span<const Part> parts() const { return parts_; }

  /// Sorts the parts into a grid of about as many cells.
  void make_grid() {
    cells_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(parts_.size()))), 1, 512);
    grid_.assign(cells_ * cells_, {});
    for (std::uint32_t i = 0; i < parts_.size(); ++i)
      each_cell(parts_[i], [&](std::vector<std::uint32_t>& cell) { cell.push_back(i); });
    met_.assign(parts_.size(), 0), round_ = 0;
  }
  /// The parts whose boxes meet that of another one. Pre: make_grid().
  std::vector<std::uint32_t> near(const Part& other) {
    std::vector<std::uint32_t> found;
    ++round_;
    each_cell(other, [&](const std::vector<std::uint32_t>& cell) {
      for (const std::uint32_t i : cell) {
        if (met_[i] == round_) continue;
        met_[i] = round_;
        const Part& part = parts_[i];
        if (part.low[0] <= other.high[0] && other.low[0] <= part.high[0] && part.low[1] <= other.high[1] &&
            other.low[1] <= part.high[1])
          found.push_back(i);
      }
    });
    return found;
  }

 private:
  template <class Function>
  void each_cell(const Part& part, Function function) {
    const auto cell = [&](double v) {
      return std::min(cells_ - 1, static_cast<std::size_t>((v + 1) / 2 * static_cast<double>(cells_)));
    };
    for (std::size_t y = cell(part.low[1]); y <= cell(part.high[1]); ++y)
      for (std::size_t x = cell(part.low[0]); x <= cell(part.high[0]); ++x) function(grid_[y * cells_ + x]);
  }

  std::vector<Part> parts_;
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
/// equal answers differ by 0, or by some 10^-17 where parts are about that narrow; a wrong area is right to about 2^-48
/// for each part that it is made of. Nothing else is rounded: which faces are visible, and who is seen in a part, is
/// exact. Pre: the view and its scene outlive it; the surface covers the whole sphere.
class Visible_reference {
 public:
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
      for (const Part& part : images_.sides[side].parts()) {
        std::vector<std::pair<double, std::uint32_t>> shown;  // the largest first, so that little is left to cut
        for (const std::uint32_t i : image.near(part)) {
          const Part& other = image.parts()[i];
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
    e.wrong = wrong / sphere, e.gaps = gaps / sphere, e.overlaps = overlaps / sphere;
    count(surface.visible, answer.shown, e);
    return e;
  }

  /// Of a depth buffer: each pixel shows its piece all over. Visible are faces with a piece that has a pixel, and that
  /// the eye is in front of. Cost: O(pixels that each exact part meets). Exact: areas no, see above; counts yes.
  Visible_errors errors(const Depth_buffer& buffer) {
    using namespace visible_errors_detail;
    Visible_errors e;
    e.not_finite = buffer.not_finite;
    const double size = buffer.size;
    const auto line = [&](std::uint32_t k) { return 2 * k / size - 1; };
    const auto pixel = [&](double v) {
      return std::min(buffer.size - 1, static_cast<std::uint32_t>(std::max(0.0, (v + 1) / 2 * size)));
    };
    double wrong = 0;
    for (std::size_t side = 0; side < 6; ++side)
      for (const Part& part : images_.sides[side].parts())
        for (std::uint32_t y = pixel(part.low[1]); y <= pixel(part.high[1]); ++y) {
          const double below = line(y), above = line(y + 1);
          const Image_polygon row =
              clipped(clipped(part.polygon, {-1, below}, {1, below}), {-1, above}, {1, above}, false);
          if (row.empty()) continue;
          double least = 1, most = -1;
          for (const Image_point& p : row) least = std::min(least, p[0]), most = std::max(most, p[0]);
          for (std::uint32_t x = pixel(least); x <= pixel(most); ++x) {
            const std::uint32_t shown = buffer.piece(side, x, y);
            if (same(part.piece, shown)) continue;
            const double left = line(x), right = line(x + 1);
            const Image_polygon both = clipped(clipped(row, {left, 1}, {left, -1}), {right, 1}, {right, -1}, false);
            if (!both.empty()) wrong += wrong_area(side, part.piece, shown, both, e);
          }
        }
    e.wrong = wrong / sphere;
    std::vector<unsigned char> shown(view_->scene().pieces().size(), 0);
    for (const std::uint32_t piece : buffer.pieces)
      if (piece != nothing) shown[piece] = 1;
    std::vector<Face_id> visible;
    for (std::uint32_t i = 0; i < shown.size(); ++i)
      if (shown[i] && view_->eye_side(i) == CGAL::POSITIVE) visible.push_back(face(i));
    std::sort(visible.begin(), visible.end());
    visible.erase(std::unique(visible.begin(), visible.end()), visible.end());
    count(visible, shown, e);
    return e;
  }

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
                    Visible_errors& e) {
    using namespace visible_errors_detail;
    if (same(f, g)) return 0;
    const double area = solid_angle(polygon);
    if (f == nothing || g == nothing || !view_->same_plane(f, g)) return area;
    const double tied = std::min(area, solid_angle(intersection(polygon, outline(side, g))));
    e.tied += tied / sphere;
    return area - tied;
  }
  /// All of a piece in an image.
  const Image_polygon& outline(std::size_t side, std::uint32_t piece) {
    using namespace visible_errors_detail;
    const auto [at, is_new] = outlines_.try_emplace({piece, side});
    if (!is_new) return at->second;
    const Scene& scene = view_->scene();
    std::vector<Ray_direction> cone;
    for (const Piece_corner& corner : scene.corners(scene.pieces()[piece])) {
      Exact_point d = scene.position(corner.point);
      for (std::size_t k = 0; k < 3; ++k) d[k] -= view_->eye()[k];
      cone.push_back(direction(d));
    }
    return at->second = hull(on_side(cone, cube_sides[side]));
  }
  /// `visible`: sorted.
  void count(const std::vector<Face_id>& visible, const std::vector<unsigned char>& shown, Visible_errors& e) const {
    std::vector<Face_id> difference;
    std::set_difference(visible.begin(), visible.end(), visible_.begin(), visible_.end(),
                        std::back_inserter(difference));
    e.wrongly_visible = difference.size();
    difference.clear();
    std::set_difference(visible_.begin(), visible_.end(), visible.begin(), visible.end(),
                        std::back_inserter(difference));
    e.wrongly_hidden = difference.size();

    struct Face {
      double area = 0;
      bool there = false, shown = false;
    };
    std::map<Face_id, Face> faces;
    for (std::uint32_t i = 0; i < shown.size(); ++i) {
      if (view_->eye_side(i) != CGAL::POSITIVE || (!images_.shown[i] && !shown[i])) continue;
      Face& f = faces[face(i)];
      f.area += images_.areas[i], f.there = f.there || images_.shown[i], f.shown = f.shown || shown[i];
    }
    for (const auto& [id, f] : faces)
      if (f.there && !f.shown) ++e.missing, e.largest_missing = std::max(e.largest_missing, f.area / sphere);
  }

  const Exact_view* view_;
  std::vector<Face_id> visible_;
  visible_errors_detail::Images images_;
  std::map<std::pair<std::uint32_t, std::size_t>, Image_polygon> outlines_;
};

}  // namespace sightline
