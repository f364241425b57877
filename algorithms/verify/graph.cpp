// To be read after covering.cpp, from top to bottom.

#include <sightline/algorithms/verify/graph.h>

#include <sightline/algorithms/verify/faces.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/surface.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace sightline {
namespace graph_check {
namespace {

using namespace certificate_check;

/// A polygon's corners and its plane.
struct Oriented_face {
  std::vector<Homogeneous> corners;
  Homogeneous plane;

  explicit Oriented_face(const Polygon& polygon) : plane(plane_of(polygon)) {
    for (const Exact_point& p : polygon) corners.push_back(homogeneous(p));
  }

  bool has_corner(int side_of, const Oriented_face& other) const {
    return std::any_of(corners.begin(), corners.end(),
                       [&](const Homogeneous& p) { return side(other.plane, p) == side_of; });
  }
};

bool may_obscure(const Oriented_face& a, const Oriented_face& b) { return a.has_corner(1, b) && b.has_corner(-1, a); }

/// Rejects unless every face of the component [begin, end) is reached from the first one, along `next`.
void check_reached(std::size_t begin, std::size_t end, const std::vector<std::vector<std::size_t>>& next,
                   const char* how) {
  std::set<std::size_t> seen{begin};
  std::vector<std::size_t> open{begin};
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    for (const std::size_t j : next[i])
      if (seen.insert(j).second) open.push_back(j);
  }
  for (std::size_t i = begin; i < end; ++i)
    if (!seen.count(i))
      reject(name("fragment", i) + how + name("fragment", begin) + ", the first of its component, by the arcs given",
             {begin, i});
}

/// Rejects where a fragment is part of what the scene has as one polygon: a face that is convex but for spikes, or a
/// triangle of one that is not planar. Returns how many faces are cut as the certificate has them: those that are not
/// convex, on their own points.
std::size_t check_whole(const Polygon_soup& soup, const Graph_certificate& certificate) {
  std::map<Face_id, std::vector<const Order_fragment*>> fragments;
  for (const Order_fragment& fragment : certificate.fragments) fragments[fragment.face].push_back(&fragment);
  std::size_t cut = 0;
  for (const auto& [f, parts] : fragments) {
    if (parts.size() == 1) continue;
    const Face face(soup, f);
    std::set<Exact_point> own;
    for (const Polygon& loop : face.loops) own.insert(loop.begin(), loop.end());
    std::set<std::uint32_t> pieces;
    for (const Order_fragment* part : parts) {
      if (!face.planar && !pieces.insert(part->piece).second)
        reject(name("face", f) + ", " + name("piece", part->piece) + " is cut, though it is one triangle");
      for (const Exact_point& p : without_straight_points(part->vertices))
        if (!own.count(p)) reject(name("face", f) + " is cut at " + name(p) + ", which is none of its points");
    }
    if (!face.planar) continue;
    const Polygon contour = without_straight_points(face.loops[0]);
    if (face.loops.size() == 1 && not_convex(contour, face.plane).empty())
      reject(name("face", f) + " is convex, but in " + std::to_string(parts.size()) + " fragments");
    ++cut;
  }
  return cut;
}

/// The certificate, step by step; throws a Rejection. Returns what was shown, in one line.
std::string check(const Polygon_soup& soup, const Graph_certificate& certificate, const Verify_options& options) {
  // 1. The fragments are the scene, and the components are the fragments.
  const Workers workers(options, certificate.fragments.size());
  const Covered covered = check_covering(soup, certificate, workers);
  const std::size_t cut = check_whole(soup, certificate);
  const std::size_t n = certificate.fragments.size();
  std::vector<std::size_t> component(n);
  std::size_t end = 0;
  for (std::size_t c = 0; c < certificate.sizes.size(); ++c) {
    const std::size_t size = certificate.sizes[c];
    if (size == 0) reject(name("component", c) + " is empty");
    if (size > n - end) reject("the components have more members than there are fragments");
    std::fill_n(component.begin() + static_cast<std::ptrdiff_t>(end), size, c);
    end += size;
  }
  if (end != n) reject("the components leave out fragments", {end});

  // 2. The arcs are arcs, and hold each component together: from its first face to all, and from all to it.
  std::vector<Oriented_face> faces;
  for (const Order_fragment& fragment : certificate.fragments) {
    workers.ask();
    faces.emplace_back(fragment.vertices);
  }
  std::vector<std::vector<std::size_t>> forth(n), back(n);
  for (std::size_t k = 0; k < certificate.arcs.size(); ++k) {
    const auto& arc = certificate.arcs[k];
    if (arc.from >= n || arc.to >= n || arc.corner_from >= faces[arc.from].corners.size() ||
        arc.corner_to >= faces[arc.to].corners.size())
      reject(name("arc", k) + " names something that is not there");
    if (component[arc.from] != component[arc.to]) reject(name("arc", k) + " leaves its component", {arc.from, arc.to});
    if (side(faces[arc.to].plane, faces[arc.from].corners[arc.corner_from]) <= 0)
      reject(name("arc", k) + ": the corner of " + name("fragment", arc.from) + " is not in front of " +
                 name("fragment", arc.to),
             {arc.from, arc.to});
    if (side(faces[arc.from].plane, faces[arc.to].corners[arc.corner_to]) >= 0)
      reject(name("arc", k) + ": the corner of " + name("fragment", arc.to) + " is not behind " +
                 name("fragment", arc.from),
             {arc.from, arc.to});
    forth[arc.from].push_back(arc.to);
    back[arc.to].push_back(arc.from);
  }
  std::size_t begin = 0;
  for (const std::size_t size : certificate.sizes) {
    check_reached(begin, begin + size, forth, " is not reached from ");
    check_reached(begin, begin + size, back, " does not reach ");
    begin += size;
  }

  // 3. No face may obscure one of an earlier component.
  for (std::size_t later = 0; later < n; ++later) {
    if (options.progress) options.progress(later, n);
    for (std::size_t earlier = 0; earlier < later; ++earlier)
      if (component[earlier] != component[later] && may_obscure(faces[later], faces[earlier]))
        reject(name("fragment", later) + " (" + name("face", certificate.fragments[later].face) + ") may obscure " +
                   name("fragment", earlier) + " (" + name("face", certificate.fragments[earlier].face) +
                   "), which has higher priority",
               {earlier, later});
  }
  if (options.progress) options.progress(n, n);
  return std::to_string(certificate.sizes.size()) + " strongly connected components of " + std::to_string(n) +
         " pieces in order of priority, " + std::to_string(cut) +
         " faces that are not convex in pieces as the certificate cuts them; " + covered.text();
}

}  // namespace
}  // namespace graph_check

Verdict verify_graph(const Polygon_soup& soup, const Graph_certificate& certificate, const Verify_options& options) {
  return certificate_check::verdict_of([&] { return graph_check::check(soup, certificate, options); });
}

}  // namespace sightline
