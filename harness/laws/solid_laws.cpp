#include <sightline/harness/laws/solid_laws.h>

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/query.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/scene/face_graph.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace {

using Directed_edge = std::pair<Exact_point, Exact_point>;

struct Asked_tree {
  const Scene scene;
  const Exact_traits traits;
  const std::vector<Flat_face> faces;
  const Exact_tree tree;

  explicit Asked_tree(const Posed_scene& posed)
      : scene(posed.soup), traits(scene), faces(flat_faces_of(scene)), tree(build_bsp(traits, one_thread())) {}
  static Bsp_options one_thread() {
    Bsp_options options;
    options.threads = 1;
    return options;
  }
  Face_id face(std::size_t piece) const { return scene.pieces()[piece].face; }
};

/// How often each piece counts: once, and once for each face that was set aside as its face's duplicate.
std::vector<int> counted(const Scene& scene) {
  std::map<Face_id, int> more;
  for (const Set_aside& aside : scene.set_aside())
    if (aside.reason == Set_aside_reason::duplicate)
      ++more[static_cast<Face_id>(std::stoul(aside.why.substr(text_of(aside.reason).size())))];
  std::vector<int> times;
  for (const Piece& piece : scene.pieces()) times.push_back(1 + more[piece.face]);
  return times;
}

/// Whether each stretch of each line has as many edges one way as the other. Edges end where any corner is.
bool is_closed_by_edges(const std::vector<Flat_face>& faces, const std::vector<int>& times) {
  std::set<Exact_point> corners;
  for (const Flat_face& face : faces) corners.insert(face.corners.begin(), face.corners.end());
  std::map<Directed_edge, int> sums;  // from the lower end
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t k = 0; k < faces[i].corners.size(); ++k) {
      const Exact_point &p = faces[i].corners[k], &q = faces[i].corners[(k + 1) % faces[i].corners.size()];
      const Exact_point &low = std::min(p, q), &high = std::max(p, q), along = minus(high, low);
      Exact_point from = low;
      for (auto next = corners.upper_bound(low); *next <= high; ++next) {  // in the order along the line
        if (!is_zero(cross(along, minus(*next, low)))) continue;
        sums[{from, *next}] += p < q ? times[i] : -times[i];
        from = *next;
        if (from == high) break;
      }
    }
  return std::all_of(sums.begin(), sums.end(), [](const auto& entry) { return entry.second == 0; });
}

/// Pre: the point is on no face.
int winding_by_ray(const std::vector<Flat_face>& faces, const std::vector<int>& times, const Exact_point& point,
                   Random& random) {
  for (;;) {
    Exact_point direction = generate::lattice(random, 1000);
    if (is_zero(direction)) continue;
    int winding = 0;
    bool general = true;
    for (std::size_t i = 0; i < faces.size() && general; ++i) {
      const std::optional<Rational> t = met_at(faces[i], point, direction);
      if (!t) continue;
      const Rational slope = dot(faces[i].normal, direction);
      general = slope != 0 && faces[i].side_within(generate::along(point, *t, direction)) > 0;
      winding += sgn(slope) * times[i];
    }
    if (general) return winding;
  }
}

Outcome check_points(const Posed_scene& posed, Random& random) {
  constexpr std::size_t points = 4;
  const Asked_tree asked(posed);
  const std::vector<int> times = counted(asked.scene);
  const bool closed = is_closed_by_edges(asked.faces, times);
  if (closure(asked.scene).closed != closed)
    return Outcome::failed(std::string("edges ") + (closed ? "close up" : "do not close up") + ", closure() says else");
  Predicate_counts counts;
  for (std::size_t k = 0; k < points; ++k) {
    const Exact_point point = any_point(posed, asked.faces, random);
    const Point_location found = locate_point(asked.traits, asked.tree, point, closed, counts);

    // The way down, by planes in the file's coordinates.
    Bsp_leaf leaf;
    for (std::int32_t next = asked.tree.nodes.empty() ? -1 : 0; next >= 0;) {
      const auto& node = asked.tree.nodes[static_cast<std::size_t>(next)];
      const std::array<Rational, 4> h = asked.scene.file_coefficients(node.plane);
      const Rational value = h[0] * point[0] + h[1] * point[1] + h[2] * point[2] + h[3];
      leaf = {next, value >= 0, leaf.on_boundary || value == 0};
      next = leaf.in_front ? node.front : node.behind;
    }
    if (leaf != found.leaf || leaf != find_leaf(asked.traits, asked.tree, point, counts))
      return Outcome::failed("a point's cell is another one");

    std::set<Face_id> held;
    for (std::size_t i = 0; i < asked.faces.size(); ++i)
      if (asked.faces[i].holds(point)) held.insert(asked.face(i));
    if (!std::equal(held.begin(), held.end(), found.faces.begin(), found.faces.end()))
      return Outcome::failed("other faces hold a point");
    const Location truth = !held.empty()                                            ? Location::on
                           : !closed                                                ? Location::undefined
                           : winding_by_ray(asked.faces, times, point, random) != 0 ? Location::inside
                                                                                    : Location::outside;
    if (truth != found.location)
      return Outcome::failed("a point's location is " + std::to_string(static_cast<int>(found.location)) + ", not " +
                             std::to_string(static_cast<int>(truth)));
  }
  return {};
}

// ---- Rays

Outcome check_first_hit(const Posed_scene& posed, Random& random) {
  constexpr std::size_t rays = 4;
  const Asked_tree asked(posed);
  for (std::size_t k = 0; k < rays; ++k) {
    const Exact_point origin = any_point(posed, asked.faces, random),
                      direction = any_direction(posed, asked.faces, origin, random);
    const std::optional<Ray_hit> found = first_hit(asked.traits, asked.tree, {origin, direction});
    std::optional<std::pair<Rational, Face_id>> truth;
    for (std::size_t i = 0; i < asked.faces.size(); ++i)
      if (const auto t = met_at(asked.faces[i], origin, direction))
        if (const std::pair hit(*t, asked.face(i)); !truth || hit < *truth) truth = hit;
    if (found.has_value() != truth.has_value())
      return Outcome::failed(found ? "a ray hits what is not there" : "a ray misses " + face_name(truth->second));
    if (!found) continue;
    if (found->t != truth->first || found->face != truth->second)
      return Outcome::failed("a ray hits " + face_name(found->face) + " after " + sightline::to_string(found->t) +
                             ", not " + face_name(truth->second) + " after " + sightline::to_string(truth->first));
    const Exact_point at = generate::along(origin, truth->first, direction);
    std::optional<std::uint32_t> number;
    for (const auto& fragment : asked.tree.fragments)
      if (asked.face(fragment.polygon.piece) == found->face && (!number || fragment.number < *number) &&
          flat_face_of(asked.traits, fragment.polygon).holds(at))
        number = fragment.number;
    if (number != found->number) return Outcome::failed("a ray hits another fragment of " + face_name(found->face));
  }
  return {};
}

// ---- Convex parts

/// The axis along which faces of this normal are seen as polygons of the two others.
std::size_t axis_across(const Exact_point& normal) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (abs(normal[k]) > abs(normal[axis])) axis = k;
  return axis;
}

/// Whether a point of a face's plane is within its loops, by parity; nothing where it is on one of them.
std::optional<bool> is_within_loops(const Polygon_soup& soup, Face_id face, std::size_t axis,
                                    const Exact_point& point) {
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  bool within = false;
  for (std::size_t l = 0; l < soup.loop_count(face); ++l) {
    const auto loop = soup.loop(face, l);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Exact_point p = soup.point(loop[k]), q = soup.point(loop[(k + 1) % loop.size()]);
      const Rational turn = (q[x] - p[x]) * (point[y] - p[y]) - (q[y] - p[y]) * (point[x] - p[x]);
      const auto between = [&](std::size_t of) {
        return std::min(p[of], q[of]) <= point[of] && point[of] <= std::max(p[of], q[of]);
      };
      if (turn == 0 && between(x) && between(y)) return std::nullopt;
      if ((p[y] > point[y]) != (q[y] > point[y]) && (turn > 0) == (q[y] > p[y])) within = !within;
    }
  }
  return within;
}

Outcome check_face(const Posed_scene& posed, const Scene& scene, const std::vector<Flat_face>& faces, Face_id face,
                   Random& random) {
  constexpr std::size_t points = 4;
  const auto fail = [&](const std::string& why) { return Outcome::failed(face_name(face) + ": " + why); };
  std::set<Exact_point> own;
  Exact_point of_loops{0, 0, 0}, of_pieces{0, 0, 0};
  for (std::size_t l = 0; l < posed.soup.loop_count(face); ++l) {
    generate::Points loop;
    for (const Point_id p : posed.soup.loop(face, l)) loop.push_back(posed.soup.point(p));
    own.insert(loop.begin(), loop.end());
    // Holes of either sense are taken from what is outside them.
    const Exact_point area = Flat_face(loop).normal;
    const bool along = l == 0 || dot(area, of_loops) < 0;
    of_loops = along ? generate::along(of_loops, 1, area) : minus(of_loops, area);
  }
  std::vector<const Flat_face*> pieces;
  for (std::size_t i = 0; i < scene.pieces().size(); ++i) {
    const Piece& piece = scene.pieces()[i];
    if (piece.face != face) continue;
    const Flat_face& flat = faces[i];
    pieces.push_back(&flat);
    of_pieces = generate::along(of_pieces, 1, flat.normal);
    const auto corners = scene.corners(piece);
    const std::array<Rational, 4> support = scene.file_coefficients(piece.support);
    if (!is_zero(cross(flat.normal, {support[0], support[1], support[2]})) ||
        dot(flat.normal, Exact_point{support[0], support[1], support[2]}) <= 0)
      return fail("its plane has another normal");
    for (std::size_t k = 0; k < flat.corners.size(); ++k) {
      const std::size_t n = flat.corners.size();
      if (own.count(flat.corners[k]) == 0) return fail("a corner of a piece is none of its own");
      if (dot(flat.normal, cross(minus(flat.corners[(k + 1) % n], flat.corners[k]),
                                 minus(flat.corners[(k + 2) % n], flat.corners[k]))) <= 0)
        return fail("a piece is not convex");
      const std::array<Rational, 4> bound = scene.file_coefficients(corners[k].edge);
      for (std::size_t c = 0; c < n; ++c) {
        const Exact_point& p = flat.corners[c];
        if (support[0] * p[0] + support[1] * p[1] + support[2] * p[2] + support[3] != 0)
          return fail("a corner is not in its plane");
        const int side = sgn(Rational(bound[0] * p[0] + bound[1] * p[1] + bound[2] * p[2] + bound[3]));
        if (side != (c == k || c == (k + 1) % n ? 0 : 1)) return fail("a bounding plane has a corner on another side");
      }
    }
  }
  const auto aside = std::find_if(scene.set_aside().begin(), scene.set_aside().end(),
                                  [&](const Set_aside& s) { return s.face == face; });
  if ((aside == scene.set_aside().end()) == pieces.empty()) return fail("it is neither kept nor set aside, or both");
  if (pieces.empty()) {
    if (aside->reason == Set_aside_reason::zero_area && !is_zero(of_loops))
      return fail("it is set aside, but has area");
    return {};
  }
  const bool flat =
      std::all_of(own.begin(), own.end(), [&](const Exact_point& p) { return pieces[0]->height(p) == 0; });
  if (!flat) {
    if (posed.soup.loop_count(face) == 1 && of_pieces != of_loops) return fail("its pieces have another vector area");
    return {};
  }
  if (of_pieces != of_loops) return fail("its pieces have another area");
  const std::size_t axis = axis_across(pieces[0]->normal);
  for (std::size_t k = 0; k < points; ++k) {
    std::vector<Exact_point> some(own.begin(), own.end());
    random.shuffle(some);
    Exact_point point{0, 0, 0};  // between three of the points
    if (k == 0) {
      const Flat_face& piece = *pieces[random.below(pieces.size())];
      some.assign(piece.corners.begin(), piece.corners.begin() + 3);
    }
    const std::array<long, 3> weights{random.chance(1, 4) ? 0 : 3, 2, static_cast<long>(random.between(1, 5))};
    for (std::size_t c = 0; c < 3; ++c)
      point = generate::along(point, generate::ratio(weights[c], weights[0] + weights[1] + weights[2]), some[c]);
    const std::optional<bool> within = is_within_loops(posed.soup, face, axis, point);
    if (!within) continue;
    std::size_t inside = 0, touched = 0;
    for (const Flat_face* piece : pieces) {
      inside += piece->side_within(point) > 0;
      touched += piece->side_within(point) == 0;
    }
    if (inside > 1 || (inside == 1 && touched > 0)) return fail("two of its pieces overlap");
    if (*within != (inside + touched > 0))
      return fail(*within ? "a point of it is in no piece" : "a piece reaches out");
  }
  return {};
}

Outcome check_parts(const Posed_scene& posed, Random& random) {
  const Scene scene(posed.soup);
  const std::vector<Flat_face> faces = flat_faces_of(scene);
  for (Face_id face = 0; face < posed.soup.face_count(); ++face)
    if (Outcome outcome = check_face(posed, scene, faces, face, random); outcome.state == Outcome::State::failed)
      return outcome;
  return {};
}

// ---- The face graph

using Scene_edge = std::pair<std::uint32_t, std::uint32_t>;  // from, to: points of the scene

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}
/// Whether two partitions of the same things are one.
bool is_same_partition(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  return first_of_its_kind(a) == first_of_its_kind(b);
}

/// Whether all corners are behind the pieces' planes, or on them, and a ray from between them leaves through one piece.
bool bounds_a_convex_body(const std::vector<const Flat_face*>& pieces, Random& random) {
  generate::Points all;
  for (const Flat_face* piece : pieces) all.insert(all.end(), piece->corners.begin(), piece->corners.end());
  const Exact_point middle = generate::centroid(all);
  for (const Flat_face* piece : pieces)
    if (piece->height(middle) >= 0 ||
        std::any_of(all.begin(), all.end(), [&](const Exact_point& p) { return piece->height(p) > 0; }))
      return false;
  for (;;) {
    const Exact_point direction = generate::lattice(random, 1000);
    if (is_zero(direction)) continue;
    std::size_t hits = 0, touches = 0;
    for (const Flat_face* piece : pieces)
      if (const auto t = met_at(*piece, middle, direction))
        ++(piece->side_within(generate::along(middle, *t, direction)) > 0 ? hits : touches);
    if (touches == 0) return hits == 1;
  }
}

Outcome check_face_graph(const Posed_scene& posed, Random& random) {
  const Scene scene(posed.soup);
  const Face_graph graph(scene);
  const std::vector<Flat_face> faces = flat_faces_of(scene);
  const std::uint32_t n = static_cast<std::uint32_t>(faces.size());
  std::map<Scene_edge, std::vector<std::uint32_t>> pieces_of;  // that walk along the edge
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto corners = scene.corners(scene.pieces()[i]);
    for (std::size_t k = 0; k < corners.size(); ++k)
      pieces_of[{corners[k].point, corners[(k + 1) % corners.size()].point}].push_back(i);
  }
  const auto has_piece = [&](const Scene_edge& edge, std::uint32_t node) {
    const auto found = pieces_of.find(edge);
    return found != pieces_of.end() && std::any_of(found->second.begin(), found->second.end(),
                                                   [&](std::uint32_t i) { return graph.node(i) == node; });
  };

  // What the graph says is there.
  std::set<std::array<std::uint32_t, 4>> edges;
  std::vector<std::uint32_t> components(graph.size());
  for (const Face_graph::Edge& edge : graph.edges()) {
    if (edge.first == edge.second || !has_piece({edge.from, edge.to}, edge.first) ||
        !has_piece({edge.to, edge.from}, edge.second))
      return Outcome::failed("two nodes do not share the edge that joins them");
    edges.insert({edge.first, edge.second, edge.from, edge.to});
    edges.insert({edge.second, edge.first, edge.to, edge.from});
  }
  for (std::uint32_t node = 0; node < graph.size(); ++node)
    for (const std::uint32_t e : graph.edges_of(node)) {
      const Face_graph::Edge& edge = graph.edges()[e];
      if ((edge.first != node && edge.second != node) ||
          graph.across(e, node) != (edge.first == node ? edge.second : edge.first))
        return Outcome::failed("an edge of a node is another's");
    }

  // What is there, the graph says, where OpenMesh took all of it.
  std::vector<std::uint32_t> node_of(n), component_of(n), nodes(n), whole(n);
  std::iota(node_of.begin(), node_of.end(), 0u);
  std::iota(component_of.begin(), component_of.end(), 0u);
  std::vector<char> open(n);
  const auto in_one_plane = [&](std::uint32_t i, std::uint32_t j) {
    return dot(faces[i].normal, faces[j].normal) > 0 &&
           std::all_of(faces[j].corners.begin(), faces[j].corners.end(),
                       [&](const Exact_point& p) { return faces[i].height(p) == 0; });
  };
  for (const auto& [edge, walkers] : pieces_of) {
    const auto back = pieces_of.find({edge.second, edge.first});
    for (const std::uint32_t i : walkers) {
      if (back == pieces_of.end()) {
        open[i] = 1;
        continue;
      }
      if (graph.refused() > 0) continue;
      const std::uint32_t j = back->second[0];
      component_of[root_of(component_of, i)] = root_of(component_of, j);
      if (in_one_plane(i, j)) node_of[root_of(node_of, i)] = root_of(node_of, j);
      if (graph.node(i) != graph.node(j) && edges.count({graph.node(i), graph.node(j), edge.first, edge.second}) == 0)
        return Outcome::failed("an edge that two nodes share is missing");
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    nodes[i] = graph.node(i);
    whole[i] = graph.component(graph.node(i));
    if (!in_one_plane(graph.piece(graph.node(i)), i)) return Outcome::failed("a node is in two planes");
    node_of[i] = root_of(node_of, i);
    component_of[i] = root_of(component_of, i);
  }
  if (graph.refused() == 0 && (!is_same_partition(node_of, nodes) || !is_same_partition(component_of, whole)))
    return Outcome::failed("other pieces hang together");

  for (std::uint32_t c = 0; c < graph.components().size(); ++c) {
    const Face_graph::Component& component = graph.components()[c];
    std::vector<const Flat_face*> pieces;
    std::set<std::uint32_t> its_nodes;
    bool closed = true;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (whole[i] != c) continue;
      pieces.push_back(&faces[i]);
      its_nodes.insert(nodes[i]);
      closed = closed && !open[i];
    }
    if (component.pieces != pieces.size() || component.nodes != its_nodes.size() ||
        its_nodes.count(component.node) == 0)
      return Outcome::failed("a component has another size");
    if (component.closed && !closed) return Outcome::failed("a component with an open edge counts as closed");
    if (graph.refused() == 0 && component.closed != closed) return Outcome::failed("a closed component counts as open");
    const bool convex = component.closed && bounds_a_convex_body(pieces, random);
    if (convex != component.inside.has_value())
      return Outcome::failed(convex ? "a convex body counts as none" : "what is no convex body counts as one");
    if (convex && std::any_of(pieces.begin(), pieces.end(),
                              [&](const Flat_face* piece) { return piece->height(*component.inside) >= 0; }))
      return Outcome::failed("the point inside a convex body is not inside");
  }
  return {};
}

}  // namespace

Check points_check() {
  return check_of_a_share("points", "cells, faces and solids at points, by brute force", 24, check_points);
}
Check first_hit_check() {
  return check_of_a_share("first hit", "the first points of rays on faces, by brute force", 24, check_first_hit);
}
Check parts_check() { return check_of_a_share("parts", "convex parts make up what loops bound", 24, check_parts); }
Check face_graph_check() {
  return check_of_a_share("face graph", "shared edges, components and convex bodies, by brute force", 24,
                          check_face_graph);
}

}  // namespace sightline::harness
