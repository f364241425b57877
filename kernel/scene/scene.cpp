#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <type_traits>
#include <unordered_map>
#include <utility>

namespace sightline {

Scene::Scene(const Polygon_soup& soup) : file_(soup.file) {
  counters_.faces_read = soup.face_count();
  counters_.points_read = soup.point_count();
  if (soup.face_count() >= Plane::max_table_planes || soup.point_count() >= Plane::max_axis_point)
    throw std::length_error("scenes of up to 2^28 points and 2^30 faces only");
  const std::vector<std::uint32_t> merged = place_points(soup);
  planes_ = Plane_table(points_);
  add_faces(soup, merged);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  pairs.reserve(corners_.size());
  for (const Piece& piece : pieces_)
    for (const Piece_corner& corner : corners(piece)) pairs.emplace_back(corner.point, piece.support.id());
  incidences_ = Point_planes(points_.size(), pairs);
  counters_.points = points_.size();
  counters_.pieces = pieces_.size();
  counters_.faces = counters_.faces_read - set_aside_.size();
}

std::array<Rational, 4> Scene::file_coefficients(const std::array<Integer, 4>& h) const {
  Integer offset = h[3] * unit_;
  for (std::size_t k = 0; k < 3; ++k) offset -= h[k] * offset_[k];
  return {Rational(h[0] * scale_), Rational(h[1] * scale_), Rational(h[2] * scale_), Rational(offset)};
}

Located_point Scene::locate(const Exact_point& p) const {
  std::array<Rational, 3> grid;
  Integer common = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    grid[k] = (p[k] * scale_ - offset_[k]) / unit_;
    common = lcm(common, grid[k].get_den());
  }
  Located_point q{Integer(grid[0] * common), Integer(grid[1] * common), Integer(grid[2] * common), common, 0, 0, 0, 0};
  std::array<double*, 3> place{&q.ax, &q.ay, &q.az};
  for (std::size_t k = 0; k < 3; ++k) {
    Rational scaled = grid[k];
    scaled /= points_.divisor();
    mpq_div_2exp(scaled.get_mpq_t(), scaled.get_mpq_t(), static_cast<mp_bitcnt_t>(points_.shift()));
    *place[k] = nearest_double(scaled);
    if (exact_or_infinite(*place[k], scaled)) continue;
    q.error = std::max(q.error, std::fabs(*place[k]) * 0x1p-52 + 0x1p-1000);
  }
  for (const double* x : place)
    if (!std::isfinite(*x)) {
      q.ax = q.ay = q.az = 0;
      q.error = std::numeric_limits<double>::infinity();
    }
  return q;
}

Exact_point Scene::position(const std::array<Integer, 4>& h) const {
  Exact_point p;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = Rational(offset_[k] * h[3] + unit_ * h[k], scale_ * h[3]);
    p[k].canonicalize();
  }
  return p;
}

std::array<Exact_point, 2> Scene::box() const {
  std::array<Exact_point, 2> corners;
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t k = 0; k < 3; ++k) corners[side][k] = Rational(offset_[k] + unit_ * box_[side][k]) / scale_;
  return corners;
}

std::vector<std::uint32_t> Scene::place_points(const Polygon_soup& soup) {
  scale_ = soup.coordinates.common_denominator();
  const std::size_t count = soup.coordinates.size();
  std::vector<std::int64_t> narrow(count);
  std::unordered_map<std::size_t, Integer> wide;
  soup.coordinates.for_each_scaled(
      scale_, [&](std::size_t i, std::int64_t n) { narrow[i] = n; },
      [&](std::size_t i, const Integer& n) { wide.emplace(i, n); });
  const auto read = [&](std::size_t i) -> Integer {
    const auto at = wide.find(i);
    return at == wide.end() ? Integer(static_cast<long>(narrow[i])) : at->second;
  };
  if (wide.empty()) return place<std::int64_t>(count, 1, [&](std::size_t i) { return narrow[i]; });
  return place<Integer>(count, scale_ / usual_denominator(soup.coordinates), read);
}

Integer Scene::usual_denominator(const Coordinates& coordinates) const {
  auto by_use = coordinates.denominators();
  std::stable_sort(by_use.begin(), by_use.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  Integer usual = 1;
  std::size_t covered = 0;
  for (const auto& [denominator, uses] : by_use) {
    const Integer next = lcm(usual, denominator);
    if (bit_length(next) > 20) continue;  // leaves doubles room for coordinates and their products
    usual = next;
    covered += uses;
  }
  return 2 * covered > coordinates.size() ? usual : scale_;
}

template <class Number, class Read>
std::vector<std::uint32_t> Scene::place(std::size_t count, Integer divisor, Read read) {
  std::array<Number, 3> low{}, high{}, first{};
  Number common{}, largest{};
  const auto magnitude = [](const Number& n) { return n < 0 ? Number(-n) : n; };
  for (std::size_t i = 0; i < count; ++i) {
    const Number n = read(i);
    const std::size_t k = i % 3;
    if (i < 3) low[k] = high[k] = first[k] = n;
    if (n < low[k]) low[k] = n;
    if (high[k] < n) high[k] = n;
    if (largest < magnitude(n)) largest = magnitude(n);
    if (common != 1) common = greatest_divisor(common, Number(n - first[k]));
  }
  if (common == 0) common = 1;
  // The centre of each axis, moved to the grid that the first point is on, or to a multiple of the divisor.
  Number reach = 1;
  std::array<Number, 3> offset;
  if (common != 1) divisor = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Number centre = low[k] + (high[k] - low[k]) / 2;
    offset[k] = first[k] + common * ((centre - first[k]) / common);
    if constexpr (std::is_same_v<Number, Integer>)
      if (divisor > 1) offset[k] = divisor * (centre / divisor);
    box_[0][k] = integer((low[k] - offset[k]) / common);
    box_[1][k] = integer((high[k] - offset[k]) / common);
    for (const Number& end : {low[k], high[k]})
      if (const Number far = magnitude(Number((end - offset[k]) / common)); reach < far) reach = far;
    offset_[k] = integer(offset[k]);
  }
  unit_ = integer(common);
  bits_read_ = static_cast<int>(bit_length(integer(largest)));
  const int bits = static_cast<int>(bit_length(integer(reach)));
  // Doubles of what is read stay below 2^512, so that no product or sum of theirs overflows: Plane_group has no other
  // guard against what is no number.
  if (bits <= 53 || bits - static_cast<int>(bit_length(divisor)) >= 512) divisor = 1;
  points_ = Grid_points(bits, divisor);
  points_.reserve(count / 3);

  std::vector<std::uint32_t> merged(count / 3);
  for (std::size_t p = 0; p < merged.size(); ++p) {
    std::array<Number, 3> grid;
    for (std::size_t k = 0; k < 3; ++k) grid[k] = (read(3 * p + k) - offset[k]) / common;
    merged[p] = points_.intern(grid);
  }
  return merged;
}

void Scene::add_faces(const Polygon_soup& soup, const std::vector<std::uint32_t>& merged) {
  std::unordered_multimap<std::size_t, Face_id> seen;  // kept faces by a hash of their loops
  std::vector<Loop> loops, others;
  const auto read_loops = [&](Face_id f, std::vector<Loop>& into) {
    into.resize(soup.loop_count(f));
    for (std::size_t k = 0; k < into.size(); ++k) {
      Loop& loop = into[k];
      loop.clear();
      for (const Point_id p : soup.loop(f, k))
        if (loop.empty() || loop.back() != merged[p]) loop.push_back(merged[p]);
      while (loop.size() > 1 && loop.back() == loop.front()) loop.pop_back();
    }
  };
  seen.reserve(soup.face_count());
  const auto rotated = [](std::vector<Loop> of) {
    for (Loop& loop : of) {
      std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
      const Loop begun =
          loop;  // where the least point comes back, as in a keyhole, the least of the rotations that begin with it
      for (std::size_t k = 1; k < begun.size(); ++k) {
        if (begun[k] != begun[0]) continue;
        Loop turned = begun;
        std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(k), turned.end());
        loop = std::min(loop, turned);
      }
    }
    return of;
  };
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    read_loops(f, loops);
    // An exact duplicate repeats the loops of an earlier kept face up to rotation.
    const std::vector<Loop> key = rotated(loops);
    std::size_t h = key.size();
    for (const Loop& loop : key)
      for (const std::uint32_t p : loop) {
        h = (h ^ p) * 0xff51afd7ed558ccdu;
        h ^= h >> 29;
      }
    const auto [begin, end] = seen.equal_range(h);
    const auto twin = std::find_if(begin, end, [&](const auto& entry) {
      read_loops(entry.second, others);
      return rotated(others) == key;
    });
    if (twin != end) {
      set_aside(f, Set_aside_reason::duplicate, std::to_string(twin->second));
    } else if (const auto reason = points_.bits() <= 30   ? add_face<__int128>(f, loops)
                                   : points_.bits() <= 72 ? add_face<Fixed_integer<4>>(f, loops)
                                                          : add_face<Integer>(f, loops)) {
      set_aside(f, *reason);
    } else {
      seen.emplace(h, f);
    }
  }
}

void Scene::set_aside(Face_id f, Set_aside_reason reason, const std::string& of) {
  set_aside_.push_back({f, reason, std::string(text_of(reason)) + of});
  switch (reason) {
    case Set_aside_reason::zero_area: ++counters_.zero_area; break;
    case Set_aside_reason::duplicate: ++counters_.duplicates; break;
    case Set_aside_reason::self_intersecting: ++counters_.self_intersecting; break;
    case Set_aside_reason::no_simple_projection: ++counters_.no_simple_projection; break;
  }
}

template <class Number>
Scene::Vector<Number> Scene::at(std::uint32_t p) const {
  const auto coordinate = [&](int k) -> Number {
    if constexpr (std::is_same_v<Number, Integer>) return points_.integer(p, k);
    else if constexpr (std::is_same_v<Number, __int128>) return points_.small(p, k);
    else return Number(points_.coordinate(p, k), points_.limbs());
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

template <class Number>
Scene::Vector<Number> Scene::difference(const Vector<Number>& a, const Vector<Number>& b) {
  return {Number(a[0] - b[0]), Number(a[1] - b[1]), Number(a[2] - b[2])};
}

template <class Number>
Scene::Vector<Number> Scene::cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class Number>
Number Scene::dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Number>
bool Scene::is_zero(const Vector<Number>& a) {
  return a[0] == 0 && a[1] == 0 && a[2] == 0;
}

template <class Number>
Scene::Vector<Number> Scene::area_vector(const Loop& loop) const {
  Vector<Number> sum{};
  if (loop.size() < 3) return sum;
  const Vector<Number> origin = at<Number>(loop[0]);
  Vector<Number> before = difference(at<Number>(loop[1]), origin);
  for (std::size_t i = 2; i < loop.size(); ++i) {
    const Vector<Number> next = difference(at<Number>(loop[i]), origin);
    const Vector<Number> part = cross(before, next);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
    before = next;
  }
  return sum;
}

template <class Number>
std::optional<Set_aside_reason> Scene::add_face(Face_id f, const std::vector<Loop>& loops) {
  const Loop& outer = loops[0];
  Vector<Number> normal = area_vector<Number>(outer);
  if (outer.size() == 3 && loops.size() == 1) {
    if (is_zero(normal)) return Set_aside_reason::zero_area;
    add_piece(f, 0, normal, outer);
    return std::nullopt;
  }
  if (loops.size() > 1) ++counters_.with_holes;
  if (all_collinear<Number>(outer)) return Set_aside_reason::zero_area;
  const bool planar = !is_zero(normal) && std::all_of(loops.begin(), loops.end(), [&](const Loop& loop) {
    const Vector<Number> origin = at<Number>(outer[0]);
    return std::all_of(loop.begin(), loop.end(),
                       [&](std::uint32_t p) { return dot(normal, difference(at<Number>(p), origin)) == 0; });
  });
  if (planar) return add_planar_face(f, normal, loops);
  if (is_zero(normal) &&
      all_coplanar<Number>(loops)) {  // a contour that goes back on all its edges, or one that crosses itself
    Vector<Number> across{};
    for (std::size_t i = 0; is_zero(across); ++i)
      across = area_vector<Number>({outer[i], outer[i + 1], outer[(i + 2) % outer.size()]});
    std::vector<std::uint32_t> ids;
    return project(loops, dominant(across), false, ids, convex_parts).contour == Contour::zero_area
               ? Set_aside_reason::zero_area
               : Set_aside_reason::self_intersecting;
  }
  return add_non_planar_face(f, normal, loops);
}

template <class Number>
std::optional<Set_aside_reason> Scene::add_planar_face(Face_id f, const Vector<Number>& normal,
                                                       const std::vector<Loop>& loops) {
  const int axis = dominant(normal);
  if (loops.size() == 1) {
    Loop corners;
    if (is_convex<Number>(loops[0], axis, normal[static_cast<std::size_t>(axis)] < 0, corners)) {
      add_piece(f, 0, normal, corners);
      return std::nullopt;
    }
  }
  std::vector<std::uint32_t> ids;
  const Convex_parts parts = project(loops, axis, normal[static_cast<std::size_t>(axis)] < 0, ids, convex_parts);
  if (parts.contour == Contour::zero_area) return Set_aside_reason::zero_area;
  if (parts.contour == Contour::self_intersecting) return Set_aside_reason::self_intersecting;
  ++counters_.concave;
  concave_.push_back(f);
  for (std::uint32_t number = 0; number < parts.pieces.size(); ++number)
    add_piece(f, number, normal, named(parts.pieces[number], ids));
  return std::nullopt;
}

template <class Number>
std::optional<Set_aside_reason> Scene::add_non_planar_face(Face_id f, const Vector<Number>& normal,
                                                           const std::vector<Loop>& loops) {
  const auto keep = [&] {
    ++counters_.non_planar;
    non_planar_.push_back(f);
    return std::nullopt;
  };
  // In a projection where the contour is simple, a triangulation of it is one of the face: along the dominant axis,
  // or else another.
  std::array<int, 3> axes{0, 1, 2};
  const auto size = [&](int k) {
    return normal[static_cast<std::size_t>(k)] < 0 ? Number(-normal[static_cast<std::size_t>(k)])
                                                   : normal[static_cast<std::size_t>(k)];
  };
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return size(b) < size(a); });
  for (const int axis : axes) {
    if (normal[static_cast<std::size_t>(axis)] == 0) continue;
    std::vector<std::uint32_t> ids;
    if (hides_a_point(loops, axis)) continue;
    const Convex_parts parts = project(loops, axis, normal[static_cast<std::size_t>(axis)] < 0, ids, triangles);
    if (parts.contour != Contour::simple || !has_boundary<Number>(parts, ids, loops, axis)) continue;
    for (std::uint32_t number = 0; number < parts.pieces.size(); ++number) {
      const Loop triangle = named(parts.pieces[number], ids);
      add_piece(f, number, area_vector<Number>(triangle), triangle);
    }
    return keep();
  }
  if (loops.size() > 1) return Set_aside_reason::no_simple_projection;
  // No simple projection along an axis: the fan of the first vertex, as most programs draw it.
  std::uint32_t number = 0;
  for (std::size_t i = 2; i < loops[0].size(); ++i) {
    const Loop triangle{loops[0][0], loops[0][i - 1], loops[0][i]};
    const Vector<Number> n = area_vector<Number>(triangle);
    if (!is_zero(n)) add_piece(f, number++, n, triangle);
  }
  if (number == 0) return Set_aside_reason::zero_area;  // spikes only
  ++counters_.fanned;
  return keep();
}

template <class Number>
bool Scene::has_boundary(const Convex_parts& parts, const std::vector<std::uint32_t>& ids,
                         const std::vector<Loop>& loops, int axis) const {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> net;
  const auto add = [&](const Loop& loop, int sign) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t p = loop[i], q = loop[i + 1 == loop.size() ? 0 : i + 1];
      net[std::minmax(p, q)] += p < q ? sign : -sign;
    }
  };
  for (const auto& piece : parts.pieces) add(named(piece, ids), 1);
  const auto sense = [&](const Loop& loop) {
    const Number area = area_vector<Number>(loop)[static_cast<std::size_t>(axis)];
    return area < 0 ? -1 : area == 0 ? 0 : 1;
  };  // holes run against the contour; triangles() leaves one without area here as it is, and the contour has some
  for (const Loop& loop : loops) add(loop, &loop != &loops[0] && sense(loop) == sense(loops[0]) ? 1 : -1);
  return std::all_of(net.begin(), net.end(), [](const auto& entry) { return entry.second == 0; });
}

template <class Number>
bool Scene::all_collinear(const Loop& loop) const {
  if (loop.size() < 3) return true;
  const Vector<Number> origin = at<Number>(loop[0]), along = difference(at<Number>(loop[1]), origin);
  return std::all_of(loop.begin(), loop.end(),
                     [&](std::uint32_t p) { return is_zero(cross(along, difference(at<Number>(p), origin))); });
}

template <class Number>
bool Scene::all_coplanar(const std::vector<Loop>& loops) const {  // Pre: those of the first loop are not all collinear
  const Loop& outer = loops[0];
  const Vector<Number> origin = at<Number>(outer[0]), along = difference(at<Number>(outer[1]), origin);
  Vector<Number> normal{};
  for (std::size_t i = 2; is_zero(normal); ++i) normal = cross(along, difference(at<Number>(outer[i]), origin));
  return std::all_of(loops.begin(), loops.end(), [&](const Loop& loop) {
    return std::all_of(loop.begin(), loop.end(),
                       [&](std::uint32_t p) { return dot(normal, difference(at<Number>(p), origin)) == 0; });
  });
}

template <class Number>
int Scene::dominant(const Vector<Number>& n) {
  int axis = 0;
  const auto size = [&](int k) {
    return n[static_cast<std::size_t>(k)] < 0 ? Number(-n[static_cast<std::size_t>(k)])
                                              : n[static_cast<std::size_t>(k)];
  };
  for (int k = 1; k < 3; ++k)
    if (size(axis) < size(k)) axis = k;
  return axis;
}

template <class Number>
bool Scene::is_convex(const Loop& loop, int axis, bool mirrored, Loop& corners) const {
  const auto [i, j] = projection(axis, mirrored);
  struct Step {
    Number x, y;
  };
  const auto step = [&, i = i, j = j](std::uint32_t p, std::uint32_t q) {
    const Vector<Number> e = difference(at<Number>(q), at<Number>(p));
    return Step{e[static_cast<std::size_t>(i)], e[static_cast<std::size_t>(j)]};
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

bool Scene::hides_a_point(const std::vector<Loop>& loops, int axis) const {
  const auto [i, j] = projection(axis, false);
  std::map<std::array<Integer, 2>, std::uint32_t> seen;
  for (const Loop& loop : loops)
    for (const std::uint32_t p : loop)
      if (seen.try_emplace({points_.integer(p, i), points_.integer(p, j)}, p).first->second != p) return true;
  return false;
}

template <class Cut>
Convex_parts Scene::project(const std::vector<Loop>& loops, int axis, bool mirrored, std::vector<std::uint32_t>& ids,
                            Cut cut) const {
  const auto [i, j] = projection(axis, mirrored);
  std::vector<Planar_point> points;
  std::vector<Loop> indices;
  for (const Loop& loop : loops) {
    Loop& index = indices.emplace_back();
    for (const std::uint32_t p : loop) {
      index.push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back({points_.integer(p, i), points_.integer(p, j)});
      ids.push_back(p);
    }
  }
  return cut(points, indices);
}

Plane Scene::intern(const Vector<__int128>& n, __int128 d) {
  if (fits(n[0]) && fits(n[1]) && fits(n[2]))
    return planes_.intern(static_cast<std::int64_t>(n[0]), static_cast<std::int64_t>(n[1]),
                          static_cast<std::int64_t>(n[2]), d);
  const auto wide = [](__int128 x) {
    const Limb limbs[2] = {static_cast<Limb>(x), static_cast<Limb>(x >> 64)};
    return from_limbs(limbs, 2);
  };
  return planes_.intern(wide(n[0]), wide(n[1]), wide(n[2]), wide(d));
}

Plane Scene::intern(const Vector<Fixed_integer<4>>& n, const Fixed_integer<4>& d) {
  const auto wide = [](const Fixed_integer<4>& x) { return from_limbs(x.limbs(), 4); };
  return planes_.intern(wide(n[0]), wide(n[1]), wide(n[2]), wide(d));
}

template <class Number>
void Scene::add_piece(Face_id f, std::uint32_t number, const Vector<Number>& normal, const Loop& loop) {
  const Vector<Number> origin = at<Number>(loop[0]);
  const Plane support = intern(normal, Number(-dot(normal, origin)));
  const int axis = dominant(normal);
  Vector<Number> unit{};
  unit[static_cast<std::size_t>(axis)] = normal[static_cast<std::size_t>(axis)] < 0 ? -1 : 1;
  pieces_.push_back(
      {f, number, support, static_cast<std::uint32_t>(corners_.size()), static_cast<std::uint32_t>(loop.size())});
  Vector<Number> from = origin;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::uint32_t next = loop[k + 1 == loop.size() ? 0 : k + 1];
    const Vector<Number> to = at<Number>(next);
    const Vector<Number> inward = cross(unit, difference(to, from));
    corners_.push_back({loop[k], intern(inward, Number(-dot(inward, from)))});
    from = to;
  }
}

}  // namespace sightline
