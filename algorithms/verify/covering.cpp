#include <sightline/algorithms/verify/covering.h>

#include <sightline/algorithms/verify/set_aside.h>

#include <sstream>

namespace sightline {
namespace certificate_check {

Exact_point minus(const Exact_point& a, const Exact_point& b) {
  return {Rational(a[0] - b[0]), Rational(a[1] - b[1]), Rational(a[2] - b[2])};
}

Rational dot(const Integer_vector& a, const Exact_point& b) {
  return Rational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

Integer dot(const Integer_vector& a, const Integer_vector& b) {
  return Integer(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

int sign_of_dot(const Integer_vector& a, const Integer_vector& b) {
  thread_local Integer sum;  // reused: most of the time of a check is spent here
  mpz_mul(sum.get_mpz_t(), a[0].get_mpz_t(), b[0].get_mpz_t());
  mpz_addmul(sum.get_mpz_t(), a[1].get_mpz_t(), b[1].get_mpz_t());
  mpz_addmul(sum.get_mpz_t(), a[2].get_mpz_t(), b[2].get_mpz_t());
  return sgn(sum);
}

bool is_zero(const Integer_vector& a) { return sgn(a[0]) == 0 && sgn(a[1]) == 0 && sgn(a[2]) == 0; }

Integer_vector negated(const Integer_vector& a) { return {Integer(-a[0]), Integer(-a[1]), Integer(-a[2])}; }

Integer_vector primitive(const Integer_vector& v) {
  const Integer divisor = gcd(gcd(v[0], v[1]), v[2]);
  if (sgn(divisor) == 0) return v;
  return {Integer(v[0] / divisor), Integer(v[1] / divisor), Integer(v[2] / divisor)};
}

Integer_vector primitive(const Exact_point& v) {
  const Integer scale = lcm(lcm(v[0].get_den(), v[1].get_den()), v[2].get_den());
  Integer_vector scaled;
  for (std::size_t k = 0; k < 3; ++k) scaled[k] = v[k].get_num() * (scale / v[k].get_den());
  return primitive(scaled);
}

Integer_vector newell_normal(const Polygon& loop) {
  Exact_point sum;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Exact_point part = cross(minus(loop[i], loop[0]), minus(loop[i + 1], loop[0]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return primitive(sum);
}

Homogeneous homogeneous(const Exact_point& p) {
  const Integer scale = lcm(lcm(p[0].get_den(), p[1].get_den()), p[2].get_den());
  Homogeneous h;
  for (std::size_t k = 0; k < 3; ++k) h[k] = p[k].get_num() * (scale / p[k].get_den());
  h[3] = scale;
  return h;
}

Homogeneous plane_of(const Polygon& polygon) {
  const Integer_vector normal = newell_normal(polygon);
  const Rational offset = -dot(normal, polygon[0]);
  Homogeneous plane;
  for (std::size_t k = 0; k < 3; ++k) plane[k] = normal[k] * offset.get_den();
  plane[3] = offset.get_num();
  return plane;
}

int side(const Homogeneous& plane, const Homogeneous& p) {
  thread_local Integer sum;
  mpz_mul(sum.get_mpz_t(), plane[0].get_mpz_t(), p[0].get_mpz_t());
  for (std::size_t k = 1; k < 4; ++k) mpz_addmul(sum.get_mpz_t(), plane[k].get_mpz_t(), p[k].get_mpz_t());
  return sgn(sum);
}

Face::Face(const Polygon_soup& soup, Face_id f) {
  for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
    Polygon loop;
    for (const Point_id p : soup.loop(f, k))
      if (Exact_point point = soup.point(p); loop.empty() || point != loop.back()) loop.push_back(std::move(point));
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    loops.push_back(std::move(loop));
  }
  if (loops[0].empty()) return;
  plane = {newell_normal(loops[0]), loops[0][0]};
  has_front = !is_zero(plane.normal);
  if (!has_front) plane.normal = some_normal();
  for (const Polygon& loop : loops)
    for (const Exact_point& p : loop) planar = planar && plane.side(p) == 0;
  if (!planar) return;
  for (std::size_t k = 1; k < loops.size(); ++k)
    if (sgn(dot(plane.normal, newell_normal(loops[k]))) > 0) std::reverse(loops[k].begin(), loops[k].end());
}

std::vector<Polygon> Face::seen_along(std::size_t axis) const {
  const int sense = sgn(newell_normal(loops[0])[axis]);
  if (sense == 0) return {};
  std::vector<Polygon> seen = loops;
  for (std::size_t k = 1; k < seen.size(); ++k)
    if (sgn(newell_normal(seen[k])[axis]) == sense) std::reverse(seen[k].begin(), seen[k].end());
  return seen;
}

Integer_vector Face::some_normal() const {  // of the first three points that are not collinear
  std::vector<Exact_point> arms;
  for (const Polygon& loop : loops)
    for (const Exact_point& p : loop) {
      if (p == loops[0][0]) continue;
      arms.push_back(minus(p, loops[0][0]));
      const Integer_vector normal = primitive(cross(arms.front(), arms.back()));
      if (!is_zero(normal)) return normal;
    }
  return {};
}

std::string not_convex(const Polygon& polygon, const Plane& plane) {
  const std::size_t n = polygon.size();
  if (n < 3) return "has fewer than three vertices";
  for (const Exact_point& p : polygon)
    if (plane.side(p) != 0) return "has a vertex off the plane of its face";
  std::vector<Integer_vector> edges(n);
  for (std::size_t i = 0; i < n; ++i) {
    edges[i] = primitive(minus(polygon[(i + 1) % n], polygon[i]));
    if (is_zero(edges[i])) return "has a repeated vertex";
  }
  const int area = sign_of_dot(newell_normal(polygon), plane.normal);
  if (area <= 0) return area == 0 ? "has zero area" : "is clockwise as seen from the front of its face";
  // Every corner turns left by less than 180 degrees, and the edges turn once around in all.
  const auto turn = [&](const Integer_vector& a, const Integer_vector& b) {
    return sign_of_dot(cross(a, b), plane.normal);
  };
  const auto upper = [&](const Integer_vector& edge) {  // angle to edge 0 in [0, 180)
    const int left = turn(edges[0], edge);
    return left > 0 || (left == 0 && sign_of_dot(edges[0], edge) > 0);
  };
  std::size_t rounds = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Integer_vector &in = edges[i], &out = edges[(i + 1) % n];
    const int left = turn(in, out);
    if (left < 0 || (left == 0 && sign_of_dot(in, out) < 0)) return "is not convex";
    rounds += !upper(in) && upper(out);
  }
  return rounds == 1 ? "" : "is not convex (it turns more than once around)";
}

void Boundary_chain::add(const Polygon& loop, long multiplicity) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Exact_point &from = loop[i], &to = loop[(i + 1) % loop.size()];
    Integer_vector direction = primitive(minus(to, from));
    if (direction < Integer_vector{}) direction = negated(direction);
    arrivals_[{direction, to}] += multiplicity;
    arrivals_[{direction, from}] -= multiplicity;
  }
}

std::optional<Exact_point> Boundary_chain::nonzero() const {
  for (const auto& [place, count] : arrivals_)
    if (count != 0) return place.second;
  return std::nullopt;
}

Cone::Cone(const Polygon& polygon, const Exact_point& eye) {
  const Integer_vector normal = newell_normal(polygon);
  const Rational height = dot(normal, minus(eye, polygon[0]));
  edge_on = sgn(height) == 0;
  if (edge_on) return;
  const bool front = sgn(height) > 0;
  std::vector<Integer_vector> all;
  for (const Exact_point& p : polygon) all.push_back(primitive(minus(p, eye)));
  const auto edge_plane = [&](std::size_t i) {
    const Integer_vector plane = primitive(cross(all[i], all[(i + 1) % all.size()]));
    return front ? negated(plane) : plane;
  };
  Integer_vector previous = edge_plane(all.size() - 1);
  for (std::size_t i = 0; i < all.size(); ++i) {
    Integer_vector next = edge_plane(i);
    if (next == previous) continue;  // a straight corner
    rays.push_back(all[i]);
    edge_planes.push_back(next);
    previous = std::move(next);
  }
  const Integer_vector inward = front ? negated(normal) : normal;
  for (std::size_t k = 0; k < 3; ++k) nearness[k] = inward[k] * height.get_den();
  distance = abs(height.get_num());  // coprime to nearness, as the normal is primitive and the height reduced
}

bool separates(const Cone& a, const Cone& b) {
  return std::any_of(a.edge_planes.begin(), a.edge_planes.end(), [&](const Integer_vector& plane) {
    return std::none_of(b.rays.begin(), b.rays.end(),
                        [&](const Integer_vector& ray) { return sign_of_dot(plane, ray) > 0; });
  });
}

std::string name(const Exact_point& p) {
  std::ostringstream text;
  text << '(' << nearest_double(p[0]) << ", " << nearest_double(p[1]) << ", " << nearest_double(p[2]) << ')';
  return text.str();
}

bool canonical(const Rational& r) { return sgn(r.get_den()) > 0 && gcd(r.get_num(), r.get_den()) == 1; }

bool canonical(const Polygon& polygon) {
  return std::all_of(polygon.begin(), polygon.end(), [](const Exact_point& p) { return canonical(p); });
}

void check_tiling(const std::string& what, Boundary_chain target, const Plane& plane, bool winds_once,
                  const std::vector<Tile>& tiles) {
  if (tiles.empty()) reject(what + " has no fragment and is not set aside");
  for (const Tile& tile : tiles) {
    if (const std::string fault = not_convex(*tile.polygon, plane); !fault.empty())
      reject(tile.name + " of " + what + " " + fault, tile.fragments);
    target.add(*tile.polygon, -1);
  }
  if (const auto point = target.nonzero())
    reject(what + " is not tiled by its parts: boundaries do not cancel near " + name(*point));
  if (winds_once) return;
  Exact_point eye = plane.origin;
  for (std::size_t k = 0; k < 3; ++k) eye[k] += plane.normal[k];
  std::vector<Cone> cones;
  for (const Tile& tile : tiles) cones.emplace_back(*tile.polygon, eye);
  for (std::size_t j = 0; j < tiles.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      if (!separates(cones[i], cones[j]) && !separates(cones[j], cones[i])) {  // in one plane that is an overlap
        std::vector<std::size_t> both = tiles[i].fragments;
        both.insert(both.end(), tiles[j].fragments.begin(), tiles[j].fragments.end());
        reject(tiles[i].name + " and " + tiles[j].name + " of " + what + " overlap", both);
      }
}

/// A point where the chain is not the boundary of a face that is not planar: of its contour, and of its holes as some
/// axis has them.
static std::optional<Exact_point> off_boundary(const Face& face, const Boundary_chain& chain) {
  const auto uncancelled = [&](const std::vector<Polygon>& loops) {
    Boundary_chain difference = chain;
    difference.add(loops, -1);
    return difference.nonzero();
  };
  if (face.loops.size() == 1) return uncancelled(face.loops);
  std::optional<Exact_point> point = face.loops[0].front();
  for (std::size_t axis = 0; axis < 3 && point; ++axis)
    if (const std::vector<Polygon> loops = face.seen_along(axis); !loops.empty()) point = uncancelled(loops);
  return point;
}

void check_pieces(const std::string& what, const Face& face, const std::vector<Tile>& pieces) {
  std::set<Exact_point> own;
  for (const Polygon& loop : face.loops) own.insert(loop.begin(), loop.end());
  Boundary_chain boundary;
  std::size_t triangles = 0;
  for (const Tile& piece : pieces) {
    for (const Exact_point& p : *piece.polygon)
      if (!own.count(p)) reject(piece.name + " of " + what + " has a vertex that is not one of the face's");
    if (face.planar) continue;
    if (piece.polygon->empty()) reject(piece.name + " of " + what + " is empty");
    const Plane plane{newell_normal(*piece.polygon), piece.polygon->front()};
    if (is_zero(plane.normal)) reject(piece.name + " of " + what + " has zero area");
    if (const std::string fault = not_convex(*piece.polygon, plane); !fault.empty())
      reject(piece.name + " of " + what + " " + fault);
    boundary.add(*piece.polygon, 1);
    triangles += piece.polygon->size() - 2;
  }
  if (face.planar) {
    Boundary_chain target;
    target.add(face.loops, 1);
    check_tiling(what, target, face.plane, false, pieces);
    return;
  }
  if (const auto point = off_boundary(face, boundary))
    reject(what + " is not bounded as its pieces are: boundaries do not cancel near " + name(*point));
  // As many triangles as a polygon with holes has; fewer only where zero-area ones were left out, which holes forbid,
  // or where loops touch: two for each time that they come back to a point. A hole walked there and back is none.
  std::size_t holes = 0, corners = 0;
  std::set<Exact_point> different;
  for (const Polygon& loop : face.loops) {
    Boundary_chain alone;
    alone.add(loop, 1);
    if (!alone.nonzero()) continue;
    holes += &loop != &face.loops[0];
    corners += loop.size();
    different.insert(loop.begin(), loop.end());
  }
  const std::size_t most = face.corner_count() + 2 * (face.loops.size() - 1) - 2;
  if (triangles > most || (holes > 0 && triangles + 2 * (corners - different.size()) + 2 < corners + 2 * holes))
    reject(what + " has the wrong number of pieces for its corners");
}

void check_covering(const Polygon_soup& soup, const Covering& covering, const Exact_point* eye) {
  const auto left_out = [&](const Plane& plane, const std::vector<Tile>& tiles) {
    return eye != nullptr && tiles.empty() && plane.side(*eye) <= 0;
  };
  // 1. Everything refers to something, once, and is a number.
  const auto in_scene = [&](const std::string& what, Face_id face) {
    if (face >= soup.face_count())
      reject(what + " names face " + std::to_string(face) + ", which the scene does not have");
  };
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t k = 0; k < soup.loop_count(f); ++k)
      for (const Point_id p : soup.loop(f, k))
        if (p >= soup.point_count()) reject("the scene's " + name("face", f) + " names a point that it does not have");
  std::set<Face_id> set_aside;
  for (const auto& entry : covering.set_aside) {
    in_scene("set_aside", entry.face);
    if (!set_aside.insert(entry.face).second) reject(name("face", entry.face) + " is set aside twice");
  }
  std::vector<std::map<std::uint32_t, const Polygon*>> pieces(soup.face_count());
  for (std::size_t i = 0; i < covering.pieces.size(); ++i) {
    const auto& piece = covering.pieces[i];
    in_scene(name("piece", i), piece.face);
    if (!canonical(piece.vertices)) reject(name("piece", i) + " has a vertex that is not in canonical numbers");
    if (set_aside.count(piece.face)) reject(name("face", piece.face) + " is set aside but has pieces");
    if (!pieces[piece.face].emplace(piece.piece, &piece.vertices).second)
      reject(name("face", piece.face) + " has " + name("piece", piece.piece) + " twice");
  }
  std::vector<std::map<std::uint32_t, std::vector<Tile>>> tiles(
      soup.face_count());  // by face, then by piece where it has such
  for (std::size_t i = 0; i < covering.fragments.size(); ++i) {
    const Order_fragment& fragment = covering.fragments[i];
    in_scene(name("fragment", i), fragment.face);
    if (!canonical(fragment.vertices))
      reject(name("fragment", i) + " has a vertex that is not in canonical numbers", {i});
    if (set_aside.count(fragment.face)) reject(name("face", fragment.face) + " is set aside but drawn", {i});
    const auto& own = pieces[fragment.face];
    if (!own.empty() && !own.count(fragment.piece))
      reject(name("fragment", i) + " is of a piece that its face does not have", {i});
    tiles[fragment.face][own.empty() ? 0 : fragment.piece].push_back({&fragment.vertices, name("fragment", i), {i}});
  }

  // 2. Nothing is lost and nothing is drawn twice.
  for (const auto& entry : covering.set_aside) check_set_aside(soup, entry, set_aside);
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    if (set_aside.count(f)) continue;
    const std::string what = name("face", f);
    const Face face(soup, f);
    if (pieces[f].empty()) {
      if (!face.planar) reject(what + " is not planar and has no pieces");
      if (!face.has_front) reject(what + " has no front and is not set aside");
      Boundary_chain contour;
      contour.add(face.loops, 1);
      const bool winds_once = face.loops.size() == 1 && not_convex(face.loops[0], face.plane).empty();
      if (!left_out(face.plane, tiles[f][0])) check_tiling(what, contour, face.plane, winds_once, tiles[f][0]);
      continue;
    }
    if (face.planar && !face.has_front) reject(what + " has no front and is not set aside");
    std::vector<Tile> parts;
    for (const auto& [number, polygon] : pieces[f]) parts.push_back({polygon, name("piece", number), {}});
    check_pieces(what, face, parts);
    for (const auto& [number, polygon] : pieces[f]) {
      Boundary_chain contour;
      contour.add(*polygon, 1);
      const Plane plane{newell_normal(*polygon), polygon->front()};
      if (!left_out(plane, tiles[f][number]))
        check_tiling(what + ", " + name("piece", number), contour, plane, true, tiles[f][number]);
    }
  }
}

}  // namespace certificate_check
}  // namespace sightline
