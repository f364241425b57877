#include <sightline/harness/laws/along_edges.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <vector>

namespace sightline::harness {

namespace moving_edges {

/// x + y sqrt(d). Those that are put together have the same d, or y = 0.
struct Surd {
  Rational x = 0, y = 0, d = 0;
  Surd() = default;
  Surd(int whole) : x(whole) {}
  Surd(const Rational& rational) : x(rational) {}
  Surd(Rational a, Rational b, Rational c) : x(std::move(a)), y(std::move(b)), d(std::move(c)) {}
  const Rational& other_root(const Surd& o) const { return sgn(d) != 0 ? d : o.d; }
  Surd operator+(const Surd& o) const { return {Rational(x + o.x), Rational(y + o.y), other_root(o)}; }
  Surd operator-(const Surd& o) const { return {Rational(x - o.x), Rational(y - o.y), other_root(o)}; }
  Surd operator*(const Surd& o) const {
    return {Rational(x * o.x + y * o.y * other_root(o)), Rational(x * o.y + y * o.x), other_root(o)};
  }
  bool operator==(int zero) const { return zero == 0 && sign() == 0; }
  int sign() const {
    const int a = sgn(x), b = sgn(y) * sgn(d);
    if (b == 0 || a == b) return a == 0 ? b : a;
    if (a == 0) return b;
    const int larger = cmp(Rational(x * x), Rational(y * y * d));
    return larger > 0 ? a : larger < 0 ? b : 0;
  }
};
using Surds = std::array<Surd, 3>;

Surds surds(const Exact_point& p) { return {Surd(p[0]), Surd(p[1]), Surd(p[2])}; }
Surds turned(const Surds& a) { return {Surd(0) - a[0], Surd(0) - a[1], Surd(0) - a[2]}; }

Surd surd(const Quadratic_root& t) {
  if (const std::optional<Rational> rational = t.rational()) return {*rational};
  const Quadratic f = t.polynomial();
  const Integer twice = 2 * f.c[2], square = f.c[1] * f.c[1] - 4 * f.c[2] * f.c[0];
  // 2 c2 t + c1 is the root of the square, or minus that.
  const int sign = t.sign_of({{f.c[1], twice, Integer(0)}});
  Rational x(Integer(-f.c[1]), twice), y(Integer(sign), twice);
  x.canonicalize();
  y.canonicalize();
  return {x, y, Rational(square)};
}

struct Plane {
  Exact_point normal;
  Rational offset;
  Surd height(const Surds& p) const { return dot(surds(normal), p) - Surd(offset); }
  Rational height(const Exact_point& p) const { return Rational(dot(normal, p) - offset); }
};
using Corners = std::vector<Exact_point>;
using Edge = std::array<Exact_point, 2>;

Plane plane_of(const Corners& corners) {
  Plane plane{{0, 0, 0}, 0};
  for (std::size_t i = 2; i < corners.size() && is_zero(plane.normal); ++i)
    plane.normal = cross(minus(corners[1], corners[0]), minus(corners[i], corners[0]));
  plane.offset = dot(plane.normal, corners[0]);
  return plane;
}

/// A ray meets a closed segment: as weights of its ends.
bool meets(const Surds& eye, const Surds& ray, const Edge& edge, std::array<Surd, 2>& weights) {
  const Surds a = minus(surds(edge[0]), eye), b = minus(surds(edge[1]), eye), normal = cross(a, b);
  if (is_zero(normal)) {  // in line with the eye
    weights = {1, 0};
    return is_zero(cross(a, ray)) && dot(a, ray).sign() >= 0;
  }
  if (dot(normal, ray).sign() != 0) return false;
  weights = {dot(cross(ray, b), normal), dot(cross(a, ray), normal)};
  return weights[0].sign() >= 0 && weights[1].sign() >= 0 && weights[0].sign() + weights[1].sign() > 0;
}

/// Whether a ray goes to a closed piece, past its edges or within them, and meets the edges before it.
bool reaches(const Surds& eye, const Surds& ray, const Corners& face, const std::vector<Edge>& edges) {
  const Plane plane = plane_of(face);
  const Surd towards = dot(surds(plane.normal), ray);
  const int side = plane.height(eye).sign();
  if (side * towards.sign() >= 0) return false;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Surds n = cross(minus(surds(face[i]), eye), minus(surds(face[(i + 1) % face.size()]), eye));
    if (side * dot(n, ray).sign() > 0) return false;
  }
  for (const Edge& edge : edges) {
    std::array<Surd, 2> weights;
    if (!meets(eye, ray, edge, weights)) return false;
    const Surd at = weights[0] * Surd(plane.height(edge[0])) + weights[1] * Surd(plane.height(edge[1]));
    if (side * at.sign() < 0) return false;
  }
  return true;
}

/// Whether it does so, and its end is in so many planes of other faces as there are less than three edges.
bool is_event_ray(const Scene& scene, const Surds& eye, const Surds& ray, const Corners& face,
                  const std::vector<Edge>& edges) {
  if (!reaches(eye, ray, face, edges)) return false;
  const Plane plane = plane_of(face);
  const Surd height = plane.height(eye), towards = dot(surds(plane.normal), ray);
  std::set<std::uint32_t> planes;
  for (const Piece& piece : scene.pieces()) {
    const Plane other = plane_of(scene.corner_points(piece));
    if (is_zero(cross(other.normal, plane.normal))) continue;
    if ((other.height(eye) * towards - height * dot(surds(other.normal), ray)).sign() == 0)
      planes.insert(piece.support.id());
  }
  return edges.size() + planes.size() >= 3;
}

bool are_in_a_plane(const Edge& k, const Edge& l) {
  return dot(cross(minus(k[1], k[0]), minus(l[0], k[0])), minus(l[1], k[0])) == 0;
}
bool are_on_a_line(const Edge& k, const Edge& l) {
  const Exact_point along = minus(k[1], k[0]);
  return is_zero(cross(along, minus(l[0], k[0]))) && is_zero(cross(along, minus(l[1], k[0])));
}

/// Whether an eye sees three lines through one point.
bool look_concurrent(const Exact_point& eye, const std::vector<Edge>& edges) {
  const auto normal = [&](const Edge& edge) { return cross(minus(edge[0], eye), minus(edge[1], eye)); };
  return dot(normal(edges[0]), cross(normal(edges[1]), normal(edges[2]))) == 0;
}

/// Whether it does so at four moments of its way, and so all along.
bool always_look_concurrent(const Exact_point& from, const Exact_point& way, const std::vector<Edge>& edges) {
  bool always = true;
  for (const long n : {0, 1, 2, 3}) {
    Exact_point p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = from[k] + Rational(n, 3) * way[k];
    always &= look_concurrent(p, edges);
  }
  return always;
}

Surds eye_at(const Exact_point& from, const Exact_point& way, const Quadratic_root& t) {
  const Surd at = surd(t);
  Surds eye;
  for (std::size_t k = 0; k < 3; ++k) eye[k] = Surd(from[k]) + at * Surd(way[k]);
  return eye;
}

bool is_on(const Corners& polygon, const Exact_point& p) {
  const Plane plane = plane_of(polygon);
  if (plane.height(p) != 0) return false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Exact_point along = minus(polygon[(i + 1) % polygon.size()], polygon[i]);
    if (dot(cross(along, minus(p, polygon[i])), plane.normal) < 0) return false;
  }
  return true;
}

}  // namespace moving_edges

std::string flaw_of_change(const Scene& scene, const Exact_point& from, const Exact_point& to, const Quadratic_root& t,
                           const Along_event::Change& change) {
  using namespace moving_edges;
  const Exact_point way = minus(to, from);
  const Surds eye = eye_at(from, way, t);
  std::vector<Corners> pieces;
  for (const Piece& piece : scene.pieces())
    if (piece.face == change.face) pieces.push_back(scene.corner_points(piece));
  // 1. The eye in a plane, or on a face.
  if (change.kind == Along_kind::plane || change.kind == Along_kind::contact) {
    if (!change.edges.empty()) return "a horizon or a contact names edges";
    if (change.kind == Along_kind::plane)
      return std::any_of(pieces.begin(), pieces.end(),
                         [&](const Corners& piece) { return plane_of(piece).height(eye).sign() == 0; })
                 ? ""
                 : "at a horizon the eye is not in the face's plane";
    const std::optional<Rational> moment = t.rational();
    if (!moment) return "a contact at an irrational moment";
    Exact_point p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = from[k] + *moment * way[k];
    return std::any_of(scene.pieces().begin(), scene.pieces().end(),
                       [&](const Piece& piece) { return is_on(scene.corner_points(piece), p); })
               ? ""
               : "at a contact the eye is on no face";
  }
  // 2. Edges, all different; in a plane or not.
  std::vector<Edge> edges;
  for (const auto& [piece, corner] : change.edges) {
    const Corners corners = scene.corner_points(scene.pieces()[piece]);
    edges.push_back({corners[corner], corners[(corner + 1) % corners.size()]});
  }
  if (edges.size() > 3) return "an event names more than three edges";
  bool in_a_plane = false;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (are_on_a_line(edges[i], edges[j])) return "an event names two edges on one line";
      in_a_plane |= are_in_a_plane(edges[i], edges[j]);
    }
  if (in_a_plane ? change.kind == Along_kind::triple : edges.size() == 3 && change.kind != Along_kind::triple)
    return in_a_plane ? "two edges of a triple are in a plane" : "no two edges of edge and vertex are in a plane";
  if (edges.size() == 3 && always_look_concurrent(from, way, edges))
    return "edges are named that look concurrent all along";
  // 3. One ray to all of them, if any: through an end, or where two look crossed, or one and a side of the face; or
  // where the planes of other faces meet the face's, if edges are missing.
  for (const Corners& face : pieces) {
    std::vector<Surds> ends, normals;
    const auto add = [&](const Exact_point& p, const Exact_point& q) {
      normals.push_back(cross(minus(surds(p), eye), minus(surds(q), eye)));
    };
    for (const Edge& edge : edges) {
      for (const Exact_point& p : edge) ends.push_back(minus(surds(p), eye));
      add(edge[0], edge[1]);
    }
    if (edges.size() < 3)
      for (const Piece& other : scene.pieces()) {
        const Plane plane = plane_of(face), its = plane_of(scene.corner_points(other));
        const Surd height = plane.height(eye), its_height = its.height(eye);
        Surds& normal = normals.emplace_back();
        for (std::size_t k = 0; k < 3; ++k)
          normal[k] = its_height * Surd(plane.normal[k]) - height * Surd(its.normal[k]);
      }
    const std::size_t first = normals.size();
    for (std::size_t i = 0; i < face.size(); ++i) {
      ends.push_back(minus(surds(face[i]), eye));
      add(face[i], face[(i + 1) % face.size()]);
    }
    for (std::size_t i = 0; i < first; ++i)
      for (std::size_t j = i + 1; j < normals.size(); ++j) {
        const Surds ray = cross(normals[i], normals[j]);
        if (is_zero(ray)) continue;
        ends.push_back(ray);
        ends.push_back(turned(ray));
      }
    if (std::any_of(ends.begin(), ends.end(),
                    [&](const Surds& ray) { return !is_zero(ray) && is_event_ray(scene, eye, ray, face, edges); }))
      return "";
  }
  return "no ray of the eye to the face meets all " + std::to_string(edges.size()) + " edges that an event names";
}

bool meets_three(const Scene& scene, const Exact_point& from, const Exact_point& to, const Quadratic_root& t,
                 std::uint32_t piece, const std::array<std::array<std::uint32_t, 2>, 2>& crossed) {
  using namespace moving_edges;
  const Exact_point way = minus(to, from);
  const Surds eye = eye_at(from, way, t);
  const Corners face = scene.corner_points(scene.pieces()[piece]);
  const auto normal_of = [&](const Edge& edge) {
    return cross(minus(surds(edge[0]), eye), minus(surds(edge[1]), eye));
  };
  std::array<Surds, 2> planes;
  for (std::size_t k = 0; k < 2; ++k) {
    const Corners corners = scene.corner_points(scene.pieces()[crossed[k][0]]);
    planes[k] = normal_of({corners[crossed[k][1]], corners[(crossed[k][1] + 1) % corners.size()]});
  }
  const Surds line = cross(planes[0], planes[1]);
  if (is_zero(line)) return false;
  for (const Surds& ray : {line, turned(line)}) {
    // 1. The edges that it meets: of each line one, but of those whose plane holds the way, or that it goes along.
    std::vector<Edge> met;
    for (const Piece& other : scene.pieces()) {
      const Corners corners = scene.corner_points(other);
      const Plane plane = plane_of(corners);
      if (plane.height(from) == 0 && plane.height(to) == 0) continue;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Edge edge{corners[i], corners[(i + 1) % corners.size()]};
        if (!is_zero(normal_of(edge)) && reaches(eye, ray, face, {edge}) &&
            std::none_of(met.begin(), met.end(), [&](const Edge& known) { return are_on_a_line(known, edge); }))
          met.push_back(edge);
      }
    }
    // 2. Three of them that are not seen as one, and through one point at that moment only.
    for (std::size_t i = 0; i < met.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (std::size_t k = 0; k < j; ++k) {
          const Surds normal = normal_of(met[i]);
          if (is_zero(cross(normal, normal_of(met[j]))) && is_zero(cross(normal, normal_of(met[k])))) continue;
          if (!always_look_concurrent(from, way, {met[i], met[j], met[k]})) return true;
        }
  }
  return false;
}

}  // namespace sightline::harness
