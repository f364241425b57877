#include <sightline/algorithms/image/newell.h>

#include <sightline/algorithms/image/bands.h>
#include <sightline/algorithms/image/number_cones.h>
#include <sightline/algorithms/image/pixel_cones.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>
#include <type_traits>
#include <utility>

namespace sightline {

namespace image_detail {

namespace {

// ---- Products of points and planes, in floats, doubles or integers

template <class Number>
constexpr bool is_rounded = std::is_floating_point_v<Number>;

/// A point x : y : z : w from the eye, w > 0; or a plane, by its products with points: positive behind the plane of a
/// face as seen from the eye, or inside an edge of its cone.
template <class Number>
struct Factor {
  std::array<Number, 4> values;
};
template <>
struct Factor<Integer> {
  std::array<Integer, 4> values;
  std::array<double, 4> near;  ///< up to a common positive factor, each within 2^-51 of its own value; at most 1
};

template <class Number>
Factor<Number> factor(std::array<Number, 4> values) {
  if constexpr (is_rounded<Number>) {
    return {values};
  } else {
    const std::array<double, 4> near = in_proportion(values);
    return {std::move(values), near};
  }
}
template <class Number>
Factor<Number> factor(const Vector_of<Number>& v, const Number& w) {
  return factor<Number>({v[0], v[1], v[2], w});
}

template <class Number>
Number product(const std::array<Number, 4>& a, const std::array<Number, 4>& b) {
  return Number(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]);
}

/// The sign of a product whose magnitude is more than a share of that of its terms; else 0.
template <class Number>
int clear_sign(const std::array<Number, 4>& a, const std::array<Number, 4>& b, Number share, Number least) {
  Number sum = 0, size = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Number term = a[k] * b[k];
    sum += term;
    size += std::fabs(term);
  }
  const Number bound = share * size + least;
  return sum > bound ? 1 : sum < -bound ? -1 : 0;
}

/// The sign of a product. In rounded numbers what is within rounding of zero is zero, so that corners that faces share,
/// and faces of one plane, are found to be on it.
template <class Number>
int sign(const Factor<Number>& a, const Factor<Number>& b) {
  if constexpr (is_rounded<Number>) {
    return clear_sign<Number>(a.values, b.values, 16 * std::numeric_limits<Number>::epsilon(), 0);
  } else {
    if (const int clear = clear_sign<double>(a.near, b.near, 0x1p-48, 0x1p-1000); clear != 0) return clear;  // P-82
    return sgn(product(a.values, b.values));
  }
}

/// The same point, in smallest integers or with w = 1.
template <class Number>
void reduce(std::array<Number, 4>& p) {
  if constexpr (is_rounded<Number>) {
    for (std::size_t k = 0; k < 3; ++k) p[k] /= p[3];
    p[3] = 1;
  } else {
    const Integer divisor = gcd(gcd(p[0], p[1]), gcd(p[2], p[3]));
    for (Integer& x : p) mpz_divexact(x.get_mpz_t(), x.get_mpz_t(), divisor.get_mpz_t());
  }
}

/// a / b as a double; of integers the nearest one, so no quotient that is less becomes more. Pre: b > 0.
template <class Number>
double quotient(const Number& a, const Number& b) {
  if constexpr (is_rounded<Number>) {
    return static_cast<double>(a / b);
  } else {
    Rational ratio(a, b);
    ratio.canonicalize();
    return nearest_double(ratio);
  }
}

/// Linear forms of directions: with those of look, right and up 1 or 0, times one positive factor.
template <class Number>
struct Image_axes {
  Vector_of<Number> across, upwards, depth;

  explicit Image_axes(const Pixel_view& pixels) {
    Vector_of<Number> look, right, up;
    if constexpr (is_rounded<Number>) {
      look = converted<Number>(pixels.look);
      right = converted<Number>(pixels.right);
      up = converted<Number>(pixels.up);
    } else {
      std::array<Rational, 9> all;
      for (std::size_t k = 0; k < 3; ++k) {
        all[k] = exact(pixels.look[k]);
        all[k + 3] = exact(pixels.right[k]);
        all[k + 6] = exact(pixels.up[k]);
      }
      const std::array<Integer, 9> scaled = Over_common(all).whole;
      look = {scaled[0], scaled[1], scaled[2]};
      right = {scaled[3], scaled[4], scaled[5]};
      up = {scaled[6], scaled[7], scaled[8]};
    }
    across = cross(up, look);
    upwards = cross(look, right);
    depth = cross(right, up);
    if (dot(depth, look) < 0)
      for (Vector_of<Number>* form : {&across, &upwards, &depth}) *form = {-(*form)[0], -(*form)[1], -(*form)[2]};
  }
};

// ---- The order

/// Where a polygon is in the image, and how far along its normal; in doubles that keep the order of exact ones.
struct Extents {
  double left, right, low, high, nearest, farthest;
};

template <class Number>
class Newell {
 public:
  Newell(const Scene& scene, const Pixel_view& pixels, const Image_options& options)
      : scene_(scene), pixels_(pixels), options_(options), axes_(pixels) {
    add_points();
    add_pieces();
    most_splits_ = is_rounded<Number> ? 64 * faces_.size() + 4096 : std::numeric_limits<std::size_t>::max();
  }

  Newell_order order() {
    while (next()) {
      if (const std::optional<std::uint32_t> other = blocker()) settle(*other);
      else paint_last();
    }
    return std::move(order_);
  }

 private:
  struct Corner {
    Factor<Number> at;
    double across, upwards, depth;
    bool is_before_eye;   ///< not beside it, nor behind
    unsigned is_outside;  ///< bits: beyond each of the image's sides, or not before the eye
  };
  /// A piece of the scene whose plane the eye is not in.
  struct Face {
    std::uint32_t piece;
    Factor<Number> plane;
    bool from_behind;
    std::tuple<bool, Face_id, std::uint32_t> rank;  ///< of overlapping ones of one plane the least is shown
  };
  /// All of a face, or a part.
  struct Polygon {
    std::uint32_t face;  ///< whose number is that of its whole polygon
    std::vector<std::uint32_t> corners;
    std::vector<Factor<Number>> edges;  ///< of its cone, each from the corner of its number
  };
  enum class State : unsigned char { waiting, marked, cut, painted };
  /// What became of a polygon; of a cut one also its parts, `count` of them from `first` on.
  struct Fate {
    State state = State::waiting;
    std::uint32_t first = 0, count = 0;
  };
  /// A polygon that was moved to the end of the list, and the first face that it was not compared with yet.
  struct Moved {
    std::uint32_t polygon, next;
  };

  // ---- What there is

  Corner corner(std::array<Number, 4> values) const {
    const Vector_of<Number> v{values[0], values[1], values[2]};
    const Number x = dot(axes_.across, v), y = dot(axes_.upwards, v), z = dot(axes_.depth, v);
    Corner made{factor<Number>(values), 0, 0, quotient<Number>(z, values[3]), z > 0, 0};
    if (made.is_before_eye) {
      made.across = quotient<Number>(x, z);
      made.upwards = quotient<Number>(y, z);
    }
    made.is_outside = unsigned{x >= z} | unsigned{-x >= z} << 1 | unsigned{y >= z} << 2 | unsigned{-y >= z} << 3 |
                      unsigned{z <= 0} << 4;
    return made;
  }

  void add_points() {
    const Number_image<std::conditional_t<is_rounded<Number>, Number, double>> numbers(pixels_);
    corners_.resize(scene_.points().size());
    parallel_for(corners_.size(), [&](std::size_t i) {
      const Exact_point p = scene_.position(static_cast<std::uint32_t>(i));
      if constexpr (is_rounded<Number>) {
        const Vector_of<Number> arm = numbers.arm(p);
        corners_[i] = corner({arm[0], arm[1], arm[2], 1});
      } else {
        const Exact_point arm = minus(p, pixels_.eye);
        corners_[i] = corner(Over_common<4>({arm[0], arm[1], arm[2], 1}).whole);
      }
    });
  }

  /// The faces with their polygons, farthest first.
  void add_pieces() {
    // 1. All that the image may show.
    std::vector<std::optional<Face>> faces(scene_.pieces().size());
    std::vector<Polygon> polygons(faces.size());
    std::vector<Extents> extents(faces.size());
    parallel_for(faces.size(), [&](std::size_t i) {
      faces[i] = face(static_cast<std::uint32_t>(i));
      if (!faces[i]) return;
      for (const Piece_corner& its : scene_.corners(scene_.pieces()[i])) polygons[i].corners.push_back(its.point);
      add_edges(polygons[i], faces[i]->from_behind);
      extents[i] = extents_of(polygons[i]);
    });
    std::vector<std::uint32_t> shown;
    for (std::uint32_t i = 0; i < faces.size(); ++i)
      if (!faces[i] || !holds(polygons[i])) ++order_.edge_on;
      else if (!is_outside(polygons[i])) shown.push_back(i);
    // 2. By their farthest depth.
    std::stable_sort(shown.begin(), shown.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return extents[a].farthest > extents[b].farthest; });
    for (const std::uint32_t i : shown) {
      polygons[i].face = static_cast<std::uint32_t>(faces_.size());
      faces_.push_back(std::move(*faces[i]));
      add(std::move(polygons[i]), extents[i]);
    }
    left_.assign(faces_.size(), 1);
  }

  /// Nothing where the eye is in its plane, or the numbers cannot hold it.
  std::optional<Face> face(std::uint32_t i) const {
    const Piece& piece = scene_.pieces()[i];
    Vector_of<Number> normal;
    Number at_plane;  // normal . d = at_plane for the d that lead to it
    if constexpr (is_rounded<Number>) {
      std::vector<Vector_of<Number>> arms;
      for (const Piece_corner& its : scene_.corners(piece)) {
        const std::array<Number, 4>& v = corners_[its.point].at.values;
        arms.push_back({v[0], v[1], v[2]});
      }
      const auto plane = Number_image<Number>::plane(arms);
      if (!plane) return std::nullopt;
      normal = plane->normal;
      at_plane = plane->at_plane;
    } else {
      const std::array<Rational, 4> h = scene_.file_coefficients(piece.support);
      const Exact_point& e = pixels_.eye;
      const std::array<Integer, 4> scaled =
          Over_common<4>({h[0], h[1], h[2], -(h[0] * e[0] + h[1] * e[1] + h[2] * e[2] + h[3])}).whole;
      normal = {scaled[0], scaled[1], scaled[2]};
      at_plane = scaled[3];
      if (at_plane == 0) return std::nullopt;
    }
    const bool from_behind = at_plane > 0;
    if (from_behind) at_plane = -at_plane;
    else normal = {-normal[0], -normal[1], -normal[2]};
    return Face{i, factor<Number>(normal, at_plane), from_behind, {from_behind, piece.face, piece.number}};
  }

  void add_edges(Polygon& polygon, bool from_behind) const {
    const auto arm = [&](std::size_t k) {
      const std::array<Number, 4>& v = corners_[polygon.corners[k]].at.values;
      return Vector_of<Number>{v[0], v[1], v[2]};
    };
    const std::size_t size = polygon.corners.size();
    for (std::size_t k = 0; k < size; ++k) {
      Vector_of<Number> n = cross(arm(k), arm(k + 1 == size ? 0 : k + 1));
      if (!from_behind) n = {-n[0], -n[1], -n[2]};
      polygon.edges.push_back(factor<Number>(n, 0));
    }
  }

  Extents extents_of(const Polygon& polygon) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Extents e{infinity, -infinity, infinity, -infinity, infinity, -infinity};
    bool is_before_eye = true;
    for (const std::uint32_t i : polygon.corners) {
      const Corner& its = corners_[i];
      is_before_eye = is_before_eye && its.is_before_eye;
      e = {std::min(e.left, its.across),  std::max(e.right, its.across),  std::min(e.low, its.upwards),
           std::max(e.high, its.upwards), std::min(e.nearest, its.depth), std::max(e.farthest, its.depth)};
    }
    if (!is_before_eye) {
      e.left = e.low = -infinity;
      e.right = e.high = infinity;
    }
    return e;
  }

  /// Whether its edges and corners are numbers.
  bool holds(const Polygon& polygon) const {
    if constexpr (is_rounded<Number>) {
      const auto is_finite = [](const Factor<Number>& f) { return std::isfinite(product(f.values, f.values)); };
      return std::all_of(polygon.edges.begin(), polygon.edges.end(), is_finite) &&
             std::all_of(polygon.corners.begin(), polygon.corners.end(),
                         [&](std::uint32_t i) { return is_finite(corners_[i].at); });
    }
    return true;
  }

  bool is_outside(const Polygon& polygon) const {
    unsigned sides = ~0u;
    for (const std::uint32_t i : polygon.corners) sides &= corners_[i].is_outside;
    return sides != 0;
  }

  void add(Polygon polygon, const Extents& extents) {
    farthest_.emplace(extents.farthest, ~static_cast<std::uint32_t>(polygons_.size()));
    polygons_.push_back(std::move(polygon));
    extents_.push_back(extents);
    fates_.emplace_back();
  }

  // ---- The list: marked polygons at its end, before them the others by their farthest depth

  /// Whether there is a polygon left; the last one is then marked.
  bool next() {
    if (options_.progress) options_.progress(painted_, polygons_.size());
    if (!moved_.empty()) return true;
    while (!farthest_.empty() && fates_[~farthest_.top().second].state != State::waiting) farthest_.pop();
    if (farthest_.empty()) return false;
    move_to_end(~farthest_.top().second);
    return true;
  }

  void move_to_end(std::uint32_t polygon) {
    while (left_[first_] == 0) ++first_;  // of its own face there is one left
    fates_[polygon].state = State::marked;
    moved_.push_back({polygon, first_});
  }

  /// Behind all where it was not moved.
  auto place_of(std::uint32_t polygon) {
    return std::find_if(moved_.begin(), moved_.end(), [&](const Moved& moved) { return moved.polygon == polygon; });
  }

  void paint_last() {
    const Polygon& polygon = polygons_[moved_.back().polygon];
    fates_[moved_.back().polygon].state = State::painted;
    --left_[polygon.face];
    moved_.pop_back();
    ++painted_;
    Painted_polygon& made = order_.polygons.emplace_back(Painted_polygon{faces_[polygon.face].piece, {}});
    for (const std::uint32_t i : polygon.corners) made.corners.push_back(position(i));
  }

  Exact_point position(std::uint32_t i) const {
    if (i < scene_.points().size()) return scene_.position(i);
    Exact_point p = pixels_.eye;
    const std::array<Number, 4>& v = corners_[i].at.values;
    for (std::size_t k = 0; k < 3; ++k) {
      if constexpr (is_rounded<Number>) {
        p[k] += exact(static_cast<double>(v[k]));
      } else {
        Rational arm(v[k], v[3]);
        arm.canonicalize();
        p[k] += arm;
      }
    }
    return p;
  }

  /// What the last polygon must not be painted before, if anything. What it was compared with before it had to wait is
  /// not compared again, nor are parts of that.
  std::optional<std::uint32_t> blocker() {
    auto& [p, face] = moved_.back();
    for (; face < left_.size(); ++face) {
      if (extents_[face].farthest < extents_[p].nearest) break;  // so are all behind it
      if (left_[face] == 0) continue;
      if (const auto q = blocker_in(face, p)) return q;
    }
    return std::nullopt;
  }

  /// Of what is left of a face.
  std::optional<std::uint32_t> blocker_in(std::uint32_t face, std::uint32_t p) {
    todo_.assign(1, face);
    while (!todo_.empty()) {
      const std::uint32_t q = todo_.back();
      todo_.pop_back();
      const Fate& fate = fates_[q];
      if (fate.state == State::painted || q == p || are_beside(p, q)) continue;
      if (fate.state != State::cut && !may_precede(p, q)) return q;
      for (std::uint32_t i = 0; i < fate.count; ++i) todo_.push_back(fate.first + i);
    }
    return std::nullopt;
  }

  /// Makes the last polygon wait for another one, or cuts one of them.
  void settle(std::uint32_t q) {
    const std::uint32_t p = moved_.back().polygon;
    if (fates_[q].state != State::marked && may_precede_by_planes(q, p)) {
      ++order_.counters.swaps;
      move_to_end(q);
    } else if (order_.counters.splits == most_splits_ || !cut(p, q)) {
      ++order_.counters.unordered;
      paint_last();
    }
  }

  // ---- Pairs

  static bool passed(std::uint64_t& by) {
    ++by;
    return true;
  }

  /// Whether P may be painted before Q, as they do not meet in the image, or not in depth.
  bool are_beside(std::uint32_t p, std::uint32_t q) {
    const Extents &a = extents_[p], &b = extents_[q];
    // 1. In depth P begins where Q has ended.
    if (b.farthest < a.nearest) return passed(order_.counters.by_depth);
    // 2. One is beside the other, or above.
    const bool are_apart = a.right < b.left || b.right < a.left || a.high < b.low || b.high < a.low;
    order_.counters.by_extents += are_apart;
    return are_apart;
  }

  /// Whether P may be painted before Q, as it is nowhere nearer where both are seen.
  bool may_precede(std::uint32_t p, std::uint32_t q) {
    Newell_counters& counters = order_.counters;
    // 3. P is behind Q's plane or in it; in it, the rule chooses.
    if (polygons_[p].face == polygons_[q].face) return passed(counters.by_behind);
    const Face &of_p = face_of(p), &of_q = face_of(q);
    const bool is_behind = !reaches(p, of_q.plane, -1), is_in = is_behind && !reaches(p, of_q.plane, 1);
    if (is_in ? of_q.rank < of_p.rank : is_behind) return passed(counters.by_behind);
    // 4. Q is in front of P's plane or in it.
    if (!is_in && !reaches(q, of_p.plane, 1)) return passed(counters.by_in_front);
    // 5. An edge of one has the other outside.
    if (has_outside(p, q) || has_outside(q, p)) return passed(counters.by_apart);
    return false;
  }

  /// Tests 3 and 4 alone.
  bool may_precede_by_planes(std::uint32_t p, std::uint32_t q) const {
    return !reaches(p, face_of(q).plane, -1) || !reaches(q, face_of(p).plane, 1);
  }

  const Face& face_of(std::uint32_t polygon) const { return faces_[polygons_[polygon].face]; }

  /// Whether a corner is strictly on that side of a plane.
  bool reaches(std::uint32_t polygon, const Factor<Number>& plane, int side) const {
    const std::vector<std::uint32_t>& corners = polygons_[polygon].corners;
    return std::any_of(corners.begin(), corners.end(),
                       [&](std::uint32_t i) { return sign(plane, corners_[i].at) == side; });
  }
  bool is_across(std::uint32_t polygon, const Factor<Number>& plane) const {
    return reaches(polygon, plane, -1) && reaches(polygon, plane, 1);
  }
  bool has_outside(std::uint32_t p, std::uint32_t q) const {
    const std::vector<Factor<Number>>& edges = polygons_[p].edges;
    return std::any_of(edges.begin(), edges.end(), [&](const Factor<Number>& edge) { return !reaches(q, edge, 1); });
  }

  // ---- Cuts

  /// Cuts a polygon, where P, the last one, cannot be painted before Q, nor Q before P: by Q's plane, or else, Q being
  /// marked, another one of the cycle by which each waits for the next. In exact numbers some cut there is.
  bool cut(std::uint32_t p, std::uint32_t q) {
    // 1. The pairs of the cycle; where faces cross, one pair.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs{{p, q}};
    if (fates_[q].state == State::marked) {
      for (auto from = place_of(q); from + 1 != moved_.end(); ++from)
        pairs.emplace_back(from->polygon, (from + 1)->polygon);
    }
    // 2. By the plane of one of a pair.
    for (const auto& [a, b] : pairs)
      if (cut_if_across(a, face_of(b).plane) || cut_if_across(b, face_of(a).plane)) return true;
    // 3. By a plane through the eye.
    for (const auto& [a, b] : pairs)
      if (cut_by_edges(a, b) || cut_by_edges(b, a)) return true;
    return false;
  }

  bool cut_by_edges(std::uint32_t a, std::uint32_t b) {
    for (std::size_t k = 0; k < polygons_[b].edges.size(); ++k)
      if (cut_if_across(a, polygons_[b].edges[k])) {
        ++order_.counters.through_eye;
        return true;
      }
    return false;
  }

  /// Puts two parts in the place of a polygon, unless it is on one side. What was moved after it is unmarked.
  bool cut_if_across(std::uint32_t polygon, const Factor<Number>& plane) {
    if (!is_across(polygon, plane)) return false;
    ++order_.counters.splits;
    const auto at = place_of(polygon);
    for (auto moved = at; moved != moved_.end(); ++moved) fates_[moved->polygon].state = State::waiting;
    moved_.erase(at, moved_.end());
    const auto first = static_cast<std::uint32_t>(polygons_.size());
    for (Polygon& part : parts(polygons_[polygon], plane)) {
      if (part.corners.size() < 3 || is_outside(part)) continue;
      add_edges(part, faces_[part.face].from_behind);
      const Extents extents = extents_of(part);
      add(std::move(part), extents);
    }
    const std::uint32_t count = static_cast<std::uint32_t>(polygons_.size()) - first;
    fates_[polygon] = {State::cut, first, count};
    left_[polygons_[polygon].face] += count - 1;
    return true;
  }

  std::array<Polygon, 2> parts(const Polygon& whole, const Factor<Number>& plane) {
    std::array<Polygon, 2> made{Polygon{whole.face, {}, {}}, Polygon{whole.face, {}, {}}};
    std::vector<int> sides;
    for (const std::uint32_t i : whole.corners) sides.push_back(sign(plane, corners_[i].at));
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const std::size_t after = k + 1 == sides.size() ? 0 : k + 1;
      if (sides[k] <= 0) made[0].corners.push_back(whole.corners[k]);
      if (sides[k] >= 0) made[1].corners.push_back(whole.corners[k]);
      if (sides[k] * sides[after] >= 0) continue;
      const std::uint32_t between = crossing(whole.corners[k], whole.corners[after], plane);
      for (Polygon& part : made) part.corners.push_back(between);
    }
    return made;
  }

  /// A new corner, where the edge between two on either side of a plane meets it.
  std::uint32_t crossing(std::uint32_t i, std::uint32_t j, const Factor<Number>& plane) {
    const std::array<Number, 4>&a = corners_[i].at.values, &b = corners_[j].at.values;
    Number of_b = product(plane.values, a), of_a = product(plane.values, b);
    if (of_a < 0) of_a = -of_a;
    else of_b = -of_b;
    std::array<Number, 4> v;
    for (std::size_t k = 0; k < 4; ++k) v[k] = of_a * a[k] + of_b * b[k];
    reduce<Number>(v);
    corners_.push_back(corner(v));
    return static_cast<std::uint32_t>(corners_.size() - 1);
  }

  const Scene& scene_;
  const Pixel_view& pixels_;
  const Image_options& options_;
  Image_axes<Number> axes_;
  std::vector<Corner> corners_;  // the scene's points, then those of cuts
  std::vector<Face> faces_;
  std::vector<Polygon> polygons_;                                   // the faces, farthest first, then parts
  std::vector<Extents> extents_;                                    // of polygons
  std::vector<Fate> fates_;                                         // of polygons
  std::vector<std::uint32_t> left_;                                 // of each face, polygons to be painted
  std::uint32_t first_ = 0;                                         // of those the first
  std::priority_queue<std::pair<double, std::uint32_t>> farthest_;  // polygons, the complement of their numbers
  std::vector<Moved> moved_;
  std::vector<std::uint32_t> todo_;  // of a face, when it is searched
  std::size_t painted_ = 0, most_splits_ = 0;
  Newell_order order_;
};

}  // namespace

}  // namespace image_detail

Newell_order newell_order(const Scene& scene, const Pixel_view& pixels, Image_kernel kernel,
                          const Image_options& options) {
  using namespace image_detail;
  const Pixel_centres checked(pixels);
  Newell_order order;
  run_with_threads_for(options, pixels, scene.pieces().size(), [&] {
    order = kernel == Image_kernel::float_numbers    ? Newell<float>(scene, pixels, options).order()
            : kernel == Image_kernel::double_numbers ? Newell<double>(scene, pixels, options).order()
                                                     : Newell<Integer>(scene, pixels, options).order();
  });
  return order;
}

Piece_image newell(const Scene& scene, const Pixel_view& pixels, Image_kernel kernel, const Image_options& options) {
  const Newell_order order = newell_order(scene, pixels, kernel, options);
  Piece_image image = paint(order.polygons, pixels, kernel, options);
  image.counters.edge_on += order.edge_on;
  image.counters.swaps = order.counters.swaps;
  image.counters.splits = order.counters.splits;
  image.counters.unordered = order.counters.unordered;
  return image;
}

}  // namespace sightline
