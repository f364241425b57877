#include <sightline/kernel/scene/face_cutter.h>

#include <sightline/kernel/fixed_integer.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <type_traits>
#include <utility>

namespace sightline {

namespace {

// ---- Vectors of grid coordinates

template <class Number>
using Vector = std::array<Number, 3>;

/// The axes by the size of the vector along them, largest first; of equal ones, the first.
template <class Number>
std::array<std::size_t, 3> axes_by_size(const Vector<Number>& n) {
  const auto size = [&](std::size_t k) { return n[k] < 0 ? Number(-n[k]) : n[k]; };
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) { return size(b) < size(a); });
  return axes;
}

template <class Number>
std::size_t dominant(const Vector<Number>& n) {
  const auto size = [&](std::size_t k) { return n[k] < 0 ? Number(-n[k]) : n[k]; };
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (size(axis) < size(k)) axis = k;
  return axis;
}

/// A projection along an axis: the two axes that are left, in which the front's counterclockwise is the plane's.
struct Projection {
  std::size_t axis;
  bool mirrored;
  int i() const { return static_cast<int>((axis + (mirrored ? 2 : 1)) % 3); }
  int j() const { return static_cast<int>((axis + (mirrored ? 1 : 2)) % 3); }
};

template <class Number>
Projection along(std::size_t axis, const Vector<Number>& normal) {
  return {axis, normal[axis] < 0};
}

/// Convex parts of a face in a projection, as loops of its points.
struct Parts {
  Contour contour;
  std::vector<Point_loop> pieces;
};

Plane interned(Plane_table& planes, const Vector<__int128>& n, __int128 d) {
  const auto fits = [](__int128 x) { return x < (__int128{1} << 62) + 1 && x > -(__int128{1} << 62) - 1; };
  if (fits(n[0]) && fits(n[1]) && fits(n[2]))
    return planes.intern(static_cast<std::int64_t>(n[0]), static_cast<std::int64_t>(n[1]),
                         static_cast<std::int64_t>(n[2]), d);
  const auto wide = [](__int128 x) {
    const Limb limbs[2] = {static_cast<Limb>(x), static_cast<Limb>(x >> 64)};
    return from_limbs(limbs, 2);
  };
  return planes.intern(wide(n[0]), wide(n[1]), wide(n[2]), wide(d));
}

Plane interned(Plane_table& planes, const Vector<Fixed_integer<4>>& n, const Fixed_integer<4>& d) {
  const auto wide = [](const Fixed_integer<4>& x) { return from_limbs(x.limbs(), 4); };
  return planes.intern(wide(n[0]), wide(n[1]), wide(n[2]), wide(d));
}

Plane interned(Plane_table& planes, const Vector<Integer>& n, const Integer& d) {
  return planes.intern(n[0], n[1], n[2], d);
}

template <class Number>
Vector<Number> located(const Grid_points& points, std::uint32_t p) {
  const auto coordinate = [&](int k) -> Number {
    if constexpr (std::is_same_v<Number, Integer>) return points.integer(p, k);
    else if constexpr (std::is_same_v<Number, __int128>) return points.small(p, k);
    else return Number(points.coordinate(p, k), points.limbs());
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

/// Bounds each edge by the plane through it parallel to the dominant axis of the normal: half as many bits as a face
/// plane, and one plane for edges that project to one line. With s the sign of normal[axis], (s unit x edge) points
/// inward, since (s unit x edge) . (normal x edge) = s normal[axis] |edge|^2 > 0. Proof: P-05
template <class Number>
void bound(const Grid_points& points, std::size_t axis, bool negative, std::span<Piece_corner> corners,
           Plane_table& planes) {
  Vector<Number> unit{};
  unit[axis] = negative ? -1 : 1;
  Vector<Number> from = located<Number>(points, corners[0].point);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector<Number> to = located<Number>(points, corners[k + 1 == corners.size() ? 0 : k + 1].point);
    const Vector<Number> inward = cross(unit, minus(to, from));
    corners[k].edge = interned(planes, inward, Number(-dot(inward, from)));
    from = to;
  }
}

/// Calls with() with a number of the narrowest of three types. In g-bit coordinates a normal has 2 g + 2 bits, a normal
/// times a difference 3 g + 6, and the area vector of a loop of up to 2^28 corners 28 more: 30 bits fit 128, 72 bits
/// fit 256.
template <class With>
auto with_numbers_for(const Grid_points& points, With with) {
  if (points.bits() <= 30) return with(__int128{});
  if (points.bits() <= 72) return with(Fixed_integer<4>{});
  return with(Integer{});
}

// ---- One face

/// Cuts a face in the given number type.
template <class Number>
class Cutter {
 public:
  Cutter(const Grid_points& points, Face_id face, const std::vector<Point_loop>& loops, Scene_faces& faces,
         Piece_bounds edges)
      : points_(points), face_(face), loops_(loops), outer_(loops[0]), faces_(faces), edges_(edges) {}

  std::optional<Set_aside_reason> cut() {
    const Vector<Number> normal = area_vector(outer_);
    if (outer_.size() == 3 && loops_.size() == 1) {
      if (is_zero(normal)) return Set_aside_reason::zero_area;
      add_piece(normal, outer_);
      return std::nullopt;
    }
    if (loops_.size() > 1) ++faces_.counters.with_holes;
    if (all_collinear()) return Set_aside_reason::zero_area;
    if (!is_zero(normal)) return all_in_plane(normal) ? cut_planar(normal) : cut_non_planar(normal);
    const Vector<Number> across = any_normal();
    return all_in_plane(across) ? flaw_of_flat(across) : cut_non_planar(normal);
  }

 private:
  // ---- The three kinds of faces

  /// Of a contour in a plane that goes back on all its edges, or of one that crosses itself.
  Set_aside_reason flaw_of_flat(const Vector<Number>& normal) const {
    const Parts parts = parts_in(loops_, {dominant(normal), false}, Into::convex_parts);
    return parts.contour == Contour::zero_area ? Set_aside_reason::zero_area : Set_aside_reason::self_intersecting;
  }

  std::optional<Set_aside_reason> cut_planar(const Vector<Number>& normal) {
    const Projection projection = along(dominant(normal), normal);
    if (Point_loop corners; loops_.size() == 1 && is_convex(outer_, projection, corners)) {
      add_piece(normal, corners);
      return std::nullopt;
    }
    const Parts parts = parts_in(loops_, projection, Into::convex_parts);
    if (parts.contour == Contour::zero_area) return Set_aside_reason::zero_area;
    if (parts.contour == Contour::self_intersecting) return Set_aside_reason::self_intersecting;
    if (Point_loop corners;
        loops_.size() == 1 && is_convex(without_straight_points(outer_), projection, corners)) {  // but for spikes
      add_piece(normal, corners);
      return std::nullopt;
    }
    ++faces_.counters.concave;
    faces_.concave.push_back(face_);
    for (const Point_loop& piece : parts.pieces) add_piece(normal, piece);
    return std::nullopt;
  }

  /// One surface, whatever the loops' accidents. Without straight points and spikes, and in a projection where the
  /// contour is simple, its triangulation is one of the face: along the dominant axis, or else another. Else the cone
  /// from the least point; but that knows no holes. Proof: P-22
  std::optional<Set_aside_reason> cut_non_planar(const Vector<Number>& normal) {
    const std::vector<Point_loop> loops = reduced();
    if (loops.empty()) return Set_aside_reason::zero_area;
    if (!cut_along_an_axis(loops, normal)) {
      if (loops.size() > 1) return Set_aside_reason::no_simple_projection;
      if (!cut_as_cone(loops[0])) return Set_aside_reason::zero_area;  // each edge is walked back
      ++faces_.counters.fanned;
    }
    ++faces_.counters.non_planar;
    faces_.non_planar.push_back(face_);
    return std::nullopt;
  }

  bool cut_along_an_axis(const std::vector<Point_loop>& loops, const Vector<Number>& normal) {
    for (const std::size_t axis : axes_by_size(normal)) {
      const Projection projection = along(axis, normal);
      const bool all_have_area =
          std::all_of(loops.begin(), loops.end(), [&](const Point_loop& loop) { return area_vector(loop)[axis] != 0; });
      if (!all_have_area || hides_a_point(loops, projection)) continue;
      const Parts parts = parts_in(loops, projection, Into::triangles);
      if (parts.contour != Contour::simple || !has_boundary(loops, parts, axis)) continue;
      for (const Point_loop& triangle : parts.pieces) add_piece(area_vector(triangle), triangle);
      return true;
    }
    return false;
  }

  /// Triangles from the least point to the edges, which are cut where a point is inside, less those walked back.
  bool cut_as_cone(const Point_loop& loop) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> net;  // edges from the lower id to the higher
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point_loop path = points_along(loop[i], loop[i + 1 == loop.size() ? 0 : i + 1], loop);
      for (std::size_t k = 1; k < path.size(); ++k)
        net[std::minmax(path[k - 1], path[k])] += path[k - 1] < path[k] ? 1 : -1;
    }
    std::erase_if(net, [](const auto& entry) { return entry.second == 0; });
    if (net.empty()) return false;
    std::uint32_t apex = net.begin()->first.first;
    for (const auto& [edge, times] : net) apex = std::min({apex, edge.first, edge.second}, before());
    for (const auto& [edge, times] : net) {
      const Point_loop triangle =
          times > 0 ? Point_loop{apex, edge.first, edge.second} : Point_loop{apex, edge.second, edge.first};
      const Vector<Number> n = area_vector(triangle);
      for (int k = 0; k < std::abs(times) && !is_zero(n); ++k) add_piece(n, triangle);
    }
    return true;
  }

  // ---- Loops without what goes back on itself

  /// Without points that lie on one line with their neighbours, and again until there are none; without loops of which
  /// nothing is left; nothing where that is the contour.
  std::vector<Point_loop> reduced() const {
    std::vector<Point_loop> loops;
    for (const Point_loop& loop : loops_) {
      Point_loop kept = without_straight_points(loop);
      if (kept.empty() && loops.empty()) return {};
      if (!kept.empty()) loops.push_back(std::move(kept));
    }
    return loops;
  }

  Point_loop without_straight_points(const Point_loop& loop) const {
    const auto straight = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r) {
      return is_zero(cross(edge(p, q), edge(q, r)));
    };
    Point_loop kept;
    for (const std::uint32_t p : loop) {
      while (kept.size() > 1 && straight(kept[kept.size() - 2], kept.back(), p)) kept.pop_back();
      if (kept.empty() || kept.back() != p) kept.push_back(p);
    }
    std::size_t first = 0;  // where the end and the beginning meet
    while (kept.size() - first > 2) {
      if (kept.back() == kept[first] || straight(kept[kept.size() - 2], kept.back(), kept[first])) kept.pop_back();
      else if (straight(kept.back(), kept[first], kept[first + 1])) ++first;
      else break;
    }
    kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(first));
    if (kept.size() < 3) kept.clear();
    return kept;
  }

  /// p, the points of the loop inside the edge from p to q, in their order, and q.
  Point_loop points_along(std::uint32_t p, std::uint32_t q, const Point_loop& loop) const {
    const Vector<Number> d = edge(p, q);
    const Number length = dot(d, d);
    std::vector<std::pair<Number, std::uint32_t>> inside;
    for (const std::uint32_t r : loop) {
      const Vector<Number> e = edge(p, r);
      const Number at = dot(d, e);
      if (at > 0 && at < length && is_zero(cross(d, e))) inside.emplace_back(at, r);
    }
    std::sort(inside.begin(), inside.end());
    Point_loop path{p};
    for (const auto& [at, r] : inside)
      if (path.back() != r) path.push_back(r);
    path.push_back(q);
    return path;
  }

  /// Lexicographic order of points.
  auto before() const {
    return [&](std::uint32_t p, std::uint32_t q) { return at(p) < at(q); };
  }

  // ---- In space

  Vector<Number> at(std::uint32_t p) const { return located<Number>(points_, p); }
  Vector<Number> edge(std::uint32_t p, std::uint32_t q) const { return minus(at(q), at(p)); }

  /// Twice the area vector of a loop.
  Vector<Number> area_vector(const Point_loop& loop) const {
    Vector<Number> sum{};
    if (loop.size() < 3) return sum;
    const Vector<Number> origin = at(loop[0]);
    Vector<Number> before = minus(at(loop[1]), origin);
    for (std::size_t i = 2; i < loop.size(); ++i) {
      const Vector<Number> next = minus(at(loop[i]), origin);
      const Vector<Number> part = cross(before, next);
      for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
      before = next;
    }
    return sum;
  }

  /// Whether the contour has no points off a line.
  bool all_collinear() const {
    if (outer_.size() < 3) return true;
    const Vector<Number> first = edge(outer_[0], outer_[1]);
    return std::all_of(outer_.begin(), outer_.end(),
                       [&](std::uint32_t p) { return is_zero(cross(first, edge(outer_[0], p))); });
  }

  /// Of a plane that holds the contour, if one does. Pre: !all_collinear().
  Vector<Number> any_normal() const {
    const Vector<Number> first = edge(outer_[0], outer_[1]);
    Vector<Number> normal{};
    for (std::size_t i = 2; is_zero(normal); ++i) normal = cross(first, edge(outer_[0], outer_[i]));
    return normal;
  }

  bool all_in_plane(const Vector<Number>& normal) const {
    const Vector<Number> origin = at(outer_[0]);
    return std::all_of(loops_.begin(), loops_.end(), [&](const Point_loop& loop) {
      return std::all_of(loop.begin(), loop.end(),
                         [&](std::uint32_t p) { return dot(normal, minus(at(p), origin)) == 0; });
    });
  }

  // ---- In a projection

  /// Whether a loop of three points or more is a convex polygon walked once counterclockwise; `corners` then are its
  /// vertices that are not straight.
  bool is_convex(const Point_loop& loop, const Projection& projection, Point_loop& corners) const {
    struct Step {
      Number x, y;
    };
    const auto i = static_cast<std::size_t>(projection.i()), j = static_cast<std::size_t>(projection.j());
    const auto step = [&](std::uint32_t p, std::uint32_t q) {
      const Vector<Number> e = edge(p, q);
      return Step{e[i], e[j]};
    };
    const auto upward = [](const Step& e) { return e.y > 0 || (e.y == 0 && e.x > 0); };
    int turns_of_direction = 0;  // between the upper and the lower half plane of directions: 2 for one round
    corners.clear();
    Step before = step(loop.back(), loop.front());
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Step after = step(loop[k], loop[k + 1 == loop.size() ? 0 : k + 1]);
      const Number turn = before.x * after.y - before.y * after.x;
      if (turn < 0) return false;
      if (turn == 0 && before.x * after.x + before.y * after.y < 0) return false;  // a spike
      if (turn > 0) corners.push_back(loop[k]);
      turns_of_direction += upward(before) != upward(after);
      before = after;
    }
    return turns_of_direction == 2 && corners.size() >= 3;
  }

  /// Whether two different points of the loops have one projection.
  bool hides_a_point(const std::vector<Point_loop>& loops, const Projection& projection) const {
    std::map<std::array<Integer, 2>, std::uint32_t> seen;
    for (const Point_loop& loop : loops)
      for (const std::uint32_t p : loop) {
        const std::array<Integer, 2> place{points_.integer(p, projection.i()), points_.integer(p, projection.j())};
        if (seen.try_emplace(place, p).first->second != p) return true;
      }
    return false;
  }

  enum class Into { convex_parts, triangles };

  Parts parts_in(const std::vector<Point_loop>& loops, const Projection& projection, Into into) const {
    std::vector<std::uint32_t> ids;
    for (const Point_loop& loop : loops) ids.insert(ids.end(), loop.begin(), loop.end());
    std::vector<Point_loop> indices = loops;
    if (into == Into::triangles) {  // which ask for points in lexicographic order
      std::sort(ids.begin(), ids.end(), before());
      ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
      for (Point_loop& loop : indices)
        for (std::uint32_t& p : loop)
          p = static_cast<std::uint32_t>(std::lower_bound(ids.begin(), ids.end(), p, before()) - ids.begin());
    } else {
      std::uint32_t next = 0;
      for (Point_loop& loop : indices)
        for (std::uint32_t& p : loop) p = next++;
    }
    std::vector<Planar_point> planar;
    for (const std::uint32_t p : ids)
      planar.push_back({points_.integer(p, projection.i()), points_.integer(p, projection.j())});
    Convex_parts parts = into == Into::triangles ? triangles(planar, indices) : convex_parts(planar, indices);
    for (Point_loop& piece : parts.pieces)
      for (std::uint32_t& corner : piece) corner = ids[corner];
    return {parts.contour, std::move(parts.pieces)};
  }

  /// Whether the pieces' directed edges add up to those of the loops: in a projection an edge-on part of a non-planar
  /// face can get lost.
  bool has_boundary(const std::vector<Point_loop>& loops, const Parts& parts, std::size_t axis) const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> net;
    const auto add = [&](const Point_loop& loop, int sign) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::uint32_t p = loop[i], q = loop[i + 1 == loop.size() ? 0 : i + 1];
        net[std::minmax(p, q)] += p < q ? sign : -sign;
      }
    };
    for (const Point_loop& piece : parts.pieces) add(piece, 1);
    const auto sense = [&](const Point_loop& loop) {
      const Number area = area_vector(loop)[axis];
      return area < 0 ? -1 : area == 0 ? 0 : 1;
    };  // holes run against the contour
    const int of_contour = sense(loops[0]);
    for (const Point_loop& loop : loops) add(loop, &loop != &loops[0] && sense(loop) == of_contour ? 1 : -1);
    return std::all_of(net.begin(), net.end(), [](const auto& entry) { return entry.second == 0; });
  }

  // ---- Pieces

  void add_piece(const Vector<Number>& normal, const Point_loop& loop) {
    const Plane support = interned(faces_.planes, normal, Number(-dot(normal, at(loop[0]))));
    const std::size_t first = faces_.corners.size();
    faces_.pieces.push_back(
        {face_, number_++, support, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(loop.size())});
    for (const std::uint32_t p : loop) faces_.corners.push_back({p, Plane{}});
    if (edges_ == Piece_bounds::left_out) return;
    const std::size_t axis = dominant(normal);
    bound<Number>(points_, axis, normal[axis] < 0, std::span(faces_.corners).subspan(first), faces_.planes);
  }

  const Grid_points& points_;
  const Face_id face_;
  const std::vector<Point_loop>& loops_;
  const Point_loop& outer_;
  Scene_faces& faces_;
  const Piece_bounds edges_;
  std::uint32_t number_ = 0;  // of the next piece
};

}  // namespace

std::optional<Set_aside_reason> cut_face(const Grid_points& points, Face_id f, const std::vector<Point_loop>& loops,
                                         Scene_faces& faces, Piece_bounds edges) {
  return with_numbers_for(
      points, [&]<class Number>(const Number&) { return Cutter<Number>(points, f, loops, faces, edges).cut(); });
}

void bound_piece(const Grid_points& points, Scene_faces& faces, std::size_t piece) {
  const Piece& own = faces.pieces[piece];
  const std::span<Piece_corner> corners = std::span(faces.corners).subspan(own.first, own.size);
  if (corners[0].edge.valid()) return;
  const std::uint32_t id = own.support.id();
  const Vector<Integer> normal{faces.planes.integer(id, 0), faces.planes.integer(id, 1), faces.planes.integer(id, 2)};
  const std::size_t axis = dominant(normal);
  const bool negative = (sgn(normal[axis]) < 0) != own.support.flipped();
  with_numbers_for(points,
                   [&]<class Number>(const Number&) { bound<Number>(points, axis, negative, corners, faces.planes); });
}

}  // namespace sightline
