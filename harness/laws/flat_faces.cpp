#include <sightline/harness/laws/flat_faces.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sightline::harness {

using generate::along;
using generate::Points;

Flat_face::Flat_face(Points points) : corners(std::move(points)) {
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    normal = along(normal, 1, cross(minus(corners[k], corners[0]), minus(corners[k + 1], corners[0])));
}

Rational Flat_face::height(const Exact_point& p) const { return dot(normal, minus(p, corners[0])); }

int Flat_face::side_within(const Exact_point& p) const {
  int least = 1;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Exact_point& next = corners[(k + 1) % corners.size()];
    least = std::min(least, sgn(dot(normal, cross(minus(next, corners[k]), minus(p, corners[k])))));
  }
  return least;
}

std::vector<Flat_face> flat_faces_of(const Scene& scene) {
  std::vector<Flat_face> faces;
  for (const Piece& piece : scene.pieces()) faces.emplace_back(scene.corner_points(piece));
  return faces;
}

Flat_face flat_face_of(const Exact_traits& traits, const Convex_polygon<Exact_traits>& polygon) {
  Points corners;
  for (const Corner<Exact_traits>& corner : polygon) corners.push_back(traits.position(*corner.vertex));
  return Flat_face(std::move(corners));
}

// ---- Rays

std::optional<Rational> pierced_at(const Flat_face& face, const Exact_point& eye, const Exact_point& direction) {
  const Rational height = face.height(eye), slope = dot(face.normal, direction);
  if (height <= 0 || slope >= 0) return std::nullopt;
  const Rational t = -height / slope;
  if (face.side_within(along(eye, t, direction)) <= 0) return std::nullopt;
  return t;
}

std::optional<Rational> met_at(const Flat_face& face, const Exact_point& origin, const Exact_point& direction) {
  const Rational height = face.height(origin), slope = dot(face.normal, direction);
  if (slope != 0) {
    const Rational t = -height / slope;
    if (t < 0 || face.side_within(along(origin, t, direction)) < 0) return std::nullopt;
    return t;
  }
  if (height != 0) return std::nullopt;
  // In the plane: the first point is the origin, or on an edge.
  if (face.side_within(origin) >= 0) return Rational(0);
  std::optional<Rational> first;
  const auto offer = [&](const Rational& t) {
    if (t >= 0 && (!first || t < *first) && face.side_within(along(origin, t, direction)) >= 0) first = t;
  };
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    const Exact_point& p = face.corners[k];
    const Exact_point across = cross(face.normal, minus(face.corners[(k + 1) % face.corners.size()], p));
    const Rational rise = dot(across, direction);
    if (rise != 0) offer(Rational(dot(across, minus(p, origin)) / rise));
  }
  return first;
}

// ---- Eyes

namespace {

/// What a half-space through the origin leaves of a pointed cone, given by its extreme rays in their order.
void cut_cone(Points& rays, const Exact_point& normal) {
  Points kept;
  std::vector<Rational> values;
  for (const Exact_point& ray : rays) values.push_back(dot(normal, ray));
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const std::size_t next = k + 1 == rays.size() ? 0 : k + 1;
    if (values[k] >= 0) kept.push_back(rays[k]);
    if (sgn(values[k]) * sgn(values[next]) >= 0) continue;
    const Rational of_this = abs(values[next]), of_next = abs(values[k]);
    kept.push_back(along({of_this * rays[k][0], of_this * rays[k][1], of_this * rays[k][2]}, of_next, rays[next]));
  }
  rays = std::move(kept);
}

Exact_point sum_of(const Points& vectors) {
  Exact_point sum{0, 0, 0};
  for (const Exact_point& v : vectors) sum = along(sum, 1, v);
  return sum;
}

/// Normals of the planes through an eye and the face's edges, to its inside.
void add_walls(const Exact_point& eye, const Flat_face& face, Points& arms, Points& walls) {
  for (const Exact_point& p : face.corners) arms.push_back(minus(p, eye));
  const Exact_point inside = sum_of(arms);
  for (std::size_t k = 0; k < arms.size(); ++k) {
    const Exact_point wall = cross(arms[k], arms[(k + 1) % arms.size()]);
    walls.push_back(dot(wall, inside) > 0 ? wall : minus(Exact_point{0, 0, 0}, wall));
  }
}

/// The part of a face in front of a plane, or on it.
Points part_in_front(const Points& corners, const Exact_point& normal, const Exact_point& origin) {
  Points part;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Exact_point &p = corners[k], &q = corners[(k + 1) % corners.size()];
    const Rational from = dot(normal, minus(p, origin)), to = dot(normal, minus(q, origin));
    if (from >= 0) part.push_back(p);
    if (sgn(from) * sgn(to) < 0) part.push_back(along(p, Rational(from / (from - to)), minus(q, p)));
  }
  return part;
}

}  // namespace

bool sees_over(const Exact_point& eye, const Flat_face& a, const Flat_face& b) {
  const Rational of_a = a.height(eye), of_b = b.height(eye);
  if (of_a <= 0 || of_b <= 0) return false;
  Points cone, arms, walls;
  add_walls(eye, a, cone, walls);
  add_walls(eye, b, arms, walls);
  // A ray meets the planes at heights over slopes downwards: a first where this is positive.
  walls.push_back(minus(Exact_point{of_a * b.normal[0], of_a * b.normal[1], of_a * b.normal[2]},
                        Exact_point{of_b * a.normal[0], of_b * a.normal[1], of_b * a.normal[2]}));
  for (std::size_t k = cone.size(); k < walls.size() && !cone.empty(); ++k) cut_cone(cone, walls[k]);
  const Exact_point inside = sum_of(cone);
  return std::all_of(walls.begin(), walls.end(), [&](const Exact_point& wall) { return dot(wall, inside) > 0; });
}

bool some_eye_sees_over(const Points& hull, const Flat_face& a, const Flat_face& b) {
  if (hull.empty()) return false;
  const auto back = minus(Exact_point{0, 0, 0}, a.normal);
  const Points before = part_in_front(a.corners, b.normal, b.corners[0]),
               behind = part_in_front(b.corners, back, a.corners[0]);
  if (std::none_of(before.begin(), before.end(), [&](const Exact_point& p) { return b.height(p) > 0; }) ||
      std::none_of(behind.begin(), behind.end(), [&](const Exact_point& q) { return a.height(q) < 0; }))
    return false;
  Points normals;
  for (const Exact_point& p : before) {
    for (const Exact_point& r : hull) normals.push_back(minus(p, r));
    for (const Exact_point& q : behind) normals.push_back(minus(p, q));
  }
  for (unsigned octant = 0; octant < 8; ++octant) {
    Points cone(3, Exact_point{0, 0, 0});
    for (std::size_t k = 0; k < 3; ++k) cone[k][k] = (octant >> k & 1) != 0 ? 1 : -1;
    for (std::size_t k = 0; k < normals.size() && !cone.empty(); ++k) cut_cone(cone, normals[k]);
    if (!cone.empty()) return false;
  }
  return true;
}

Face_meeting meeting_of(const Flat_face& face, const Flat_face& other) {
  // 1. Where the other one meets the face's plane.
  Points ends;
  bool front = false, behind = false;
  for (std::size_t k = 0; k < other.corners.size(); ++k) {
    const Exact_point &p = other.corners[k], &q = other.corners[(k + 1) % other.corners.size()];
    const Rational s = face.height(p), t = face.height(q);
    front = front || s > 0;
    behind = behind || s < 0;
    if (s == 0) ends.push_back(p);
    else if (sgn(s) * sgn(t) < 0) ends.push_back(along(p, Rational(s / (s - t)), minus(q, p)));
  }
  if (ends.empty()) return Face_meeting::none;
  auto [from, to] = std::pair(*std::min_element(ends.begin(), ends.end()), *std::max_element(ends.begin(), ends.end()));
  // 2. What of that is inside the face.
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    const Exact_point& p = face.corners[k];
    const Exact_point inwards = cross(face.normal, minus(face.corners[(k + 1) % face.corners.size()], p));
    const Rational s = dot(inwards, minus(from, p)), t = dot(inwards, minus(to, p));
    if (s <= 0 && t <= 0) return Face_meeting::none;
    const Exact_point cut = s == t ? from : along(from, Rational(s / (s - t)), minus(to, from));
    if (s < 0) from = cut;
    else if (t < 0) to = cut;
  }
  if (from == to) return Face_meeting::none;
  return front && behind ? Face_meeting::passes : Face_meeting::stands;
}

bool cross_each_other(const Flat_face& a, const Flat_face& b) { return meeting_of(b, a) == Face_meeting::passes; }

// ---- What is asked

namespace {

/// Of a face's plane; inside it, if no weight is below 1.
Exact_point mixed(const Points& corners, std::int64_t least, Random& random) {
  Exact_point sum{0, 0, 0};
  std::int64_t all = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::int64_t weight = k + 1 < corners.size() || all > 0 ? random.between(least, 4) : 1 - all;
    sum = along(sum, Rational(static_cast<long>(weight)), corners[k]);
    all += weight;
  }
  if (all == 0) return corners[0];
  for (Rational& x : sum) x /= Rational(static_cast<long>(all));
  return sum;
}

}  // namespace

Exact_point any_point(const Posed_scene& posed, const std::vector<Flat_face>& faces, Random& random) {
  const auto corner = [&] {
    return posed.soup.point(static_cast<Point_id>(random.below(std::max<std::size_t>(1, posed.soup.point_count()))));
  };
  const std::uint64_t kind = random.below(8);
  if (posed.soup.point_count() == 0 || kind == 0) return posed.eye;
  if (faces.empty() || kind == 1) return corner();
  const Points& corners = faces[random.below(faces.size())].corners;
  switch (kind) {
    case 2: return mixed({corner(), corner()}, 1, random);
    case 3: return mixed(corners, -2, random);
    case 4: {
      const std::size_t k = random.below(corners.size());
      return mixed({corners[k], corners[(k + 1) % corners.size()]}, 1, random);
    }
    case 5: return mixed({posed.eye, corner(), corner(), corner()}, -1, random);
    default: return mixed(corners, 1, random);
  }
}

Exact_point any_direction(const Posed_scene& posed, const std::vector<Flat_face>& faces, const Exact_point& from,
                          Random& random) {
  if (!faces.empty() && random.chance(1, 8)) {
    const Points& corners = faces[random.below(faces.size())].corners;
    const std::size_t k = random.below(corners.size());
    const Exact_point edge = minus(corners[(k + 1) % corners.size()], corners[k]);
    return random.chance(1, 2) ? edge : minus(Exact_point{0, 0, 0}, edge);
  }
  const Exact_point direction = minus(any_point(posed, faces, random), from);
  if (!is_zero(direction)) return direction;
  Exact_point axis{0, 0, 0};
  axis[random.below(3)] = random.chance(1, 2) ? 1 : -1;
  return axis;
}

Check check_of_a_share(const char* name, const char* what, std::uint64_t share,
                       Outcome (*run)(const Posed_scene&, Random&)) {
  return {name, what, [run](const Posed_scene& posed, const Answer&, Random& random) { return run(posed, random); },
          share};
}

}  // namespace sightline::harness
