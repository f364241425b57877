#include <sightline/algorithms/verify/level_cell.h>

#include <sightline/algorithms/verify/cell_walls.h>
#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/known_scene.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/weak_lines.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sightline::level_check {

using namespace certificate_check;
using weak_check::Corners;
using weak_check::cut;
using weak_check::Outline;
using weak_check::reaches;

namespace {

Homogeneous turned(const Homogeneous& plane) {
  return {Integer(-plane[0]), Integer(-plane[1]), Integer(-plane[2]), Integer(-plane[3])};
}

/// What is in front of all planes; no corners where that has no area.
Corners within(const Corners& whole, const std::vector<Homogeneous>& planes) {
  const auto is_outside = [&](const Homogeneous& plane) { return !reaches(plane, whole, 1); };
  if (std::any_of(planes.begin(), planes.end(), is_outside)) return {};  // as a rule, and nothing is copied for it
  Corners corners = whole;
  for (const Homogeneous& plane : planes) {
    if (corners.empty()) break;
    corners = cut(corners, plane);
  }
  return corners;
}

/// A polygon without another one of its plane, in convex parts that have area.
void take_away(std::vector<Corners>& parts, const Outline& cover) {
  std::vector<Corners> left;
  const std::vector<Homogeneous> edges = edge_planes(cover);
  for (Corners& part : parts) {
    if (within(part, edges).empty()) {
      left.push_back(std::move(part));
      continue;
    }
    for (const Homogeneous& edge : edges) {
      if (Corners outside = cut(part, turned(edge)); !outside.empty()) left.push_back(std::move(outside));
      part = cut(part, edge);
    }
  }
  parts = std::move(left);
}

/// Whether two planes look to the same side. Pre: they are the same plane.
bool alike(const Homogeneous& a, const Homogeneous& b) {
  return sign_of_dot(Integer_vector{a[0], a[1], a[2]}, Integer_vector{b[0], b[1], b[2]}) > 0;
}

/// (2) Rejects where a fragment passes through the inside.
void check_inside(const std::vector<Outline>& walls, const std::vector<Order_fragment>& fragments,
                  const std::vector<Outline>& outlines) {
  std::vector<Homogeneous> planes;
  for (const Outline& wall : walls) planes.push_back(turned(wall.plane));
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    // In front of a wall's plane in part, or nowhere inside: a fragment in that plane has no part.
    if (!within(outlines[i].corners, planes).empty())
      reject(name("face", fragments[i].face) + " passes through its inside", {i});
  }
}

/// (3) Rejects unless the sources lie in walls, looking out, and no fragment covers some of one.
void check_sources(const std::vector<Outline>& walls, const std::vector<Outline>& sources,
                   const std::vector<Order_fragment>& fragments, const std::vector<Outline>& outlines) {
  for (std::size_t s = 0; s < sources.size(); ++s) {
    bool in_wall = false, looks_in = false;
    for (const Outline& wall : walls)
      if (is_within(sources[s], wall)) (alike(wall.plane, sources[s].plane) ? in_wall : looks_in) = true;
    if (!in_wall) reject(name("source", s) + (looks_in ? " looks into the cell" : " is in none of its walls"));
    const std::vector<Homogeneous> edges = edge_planes(sources[s]);
    for (std::size_t i = 0; i < outlines.size(); ++i)
      if (outlines[i].in_plane(sources[s].plane) && !within(outlines[i].corners, edges).empty())
        reject(name("face", fragments[i].face) + " covers some of " + name("source", s), {i});
  }
}

/// Whether all of a wall is on an outline in its plane.
bool covers(const Outline& outline, const Outline& wall) {
  const std::vector<Homogeneous> edges = edge_planes(outline);
  return std::all_of(wall.corners.begin(), wall.corners.end(), [&](const Homogeneous& p) {
    return std::all_of(edges.begin(), edges.end(), [&](const Homogeneous& edge) { return side(edge, p) >= 0; });
  });
}

/// (4), (5) Rejects unless sources and fragments cover all walls, but for those beyond which there is nothing to see.
/// Returns the faces that look into the cell; adds to `open_walls` those that are not covered.
std::set<Face_id> check_walls(const std::vector<Outline>& walls, const std::vector<Outline>& sources,
                              const std::vector<Order_fragment>& fragments, const std::vector<Outline>& outlines,
                              std::vector<std::size_t>& open_walls, const std::function<void()>& ask) {
  std::set<Face_id> looking_in;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const std::vector<Homogeneous> edges = edge_planes(walls[w]);
    std::vector<Corners> open{walls[w].corners};
    for (const Outline& source : sources)
      if (source.in_plane(walls[w].plane)) take_away(open, source);
    std::vector<const Outline*> upon;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
      if (!outlines[i].in_plane(walls[w].plane) || within(outlines[i].corners, edges).empty()) continue;
      if (!alike(outlines[i].plane, walls[w].plane)) looking_in.insert(fragments[i].face);
      if (covers(outlines[i], walls[w])) open.clear();
      upon.push_back(&outlines[i]);
    }
    for (std::size_t k = 0; k < upon.size() && !open.empty(); ++k) {
      ask();
      take_away(open, *upon[k]);
    }
    if (open.empty()) continue;
    const bool ends_scene = std::none_of(outlines.begin(), outlines.end(), [&](const Outline& outline) {
      return reaches(walls[w].plane, outline.corners, 1);
    });
    if (ends_scene) {
      open_walls.push_back(w);
      continue;
    }
    Exact_point corner;
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = Rational(open[0][0][k], open[0][0][3]);
      corner[k].canonicalize();
    }
    reject("some of " + name("wall", w) + " is covered by no source and no face, at " + exact_name(corner));
  }
  return looking_in;
}

/// Rejects what is said of sightlines where there is no source; that faces are undecided may be said anywhere.
void check_without_sources(const Polygon_soup& soup, const Weak_certificate& certificate) {
  if (!certificate.visible.empty() || !certificate.hidden.empty())
    reject("it has no source, and says something of what is seen from one");
  std::set<Face_id> undecided;
  for (const Face_id f : certificate.undecided) {
    if (f >= soup.face_count()) reject(name("face", f) + ", which is said to be undecided, is not there");
    if (!undecided.insert(f).second) reject(name("face", f) + " is undecided twice");
  }
}

std::string check_cell(const Polygon_soup& soup, const Cell_statement& cell, const Weak_certificate& certificate,
                       const weak_check::Known_scene& scene, const Verify_options& options,
                       std::vector<std::size_t>& open_walls) {
  // 1. The walls are those of a cell: soon seen, so that nothing else is asked where they are not.
  const std::vector<Outline> walls = outlines_of_walls(cell.walls);

  // 0. The certificate is right.
  if (!certificate.sources.empty()) weak_check::check(soup, certificate, scene, options);
  else check_without_sources(soup, certificate);
  const std::vector<Outline>& fragments = scene.outlines();
  std::vector<Outline> sources;
  for (const Polygon& source : certificate.sources) sources.emplace_back(source);

  // 2. to 4. Nothing is inside, and its portals are the sources.
  check_inside(walls, certificate.fragments, fragments);
  check_sources(walls, sources, certificate.fragments, fragments);
  const std::set<Face_id> looking_in = check_walls(walls, sources, certificate.fragments, fragments, open_walls, [&] {
    if (options.progress) options.progress(0, 1);
  });

  // 5. What looks into it is what is said to.
  const std::set<Face_id> said(cell.within.begin(), cell.within.end());
  for (const Face_id f : said)
    if (!looking_in.contains(f)) reject(name("face", f) + " does not look into it, but is said to");
  for (const Face_id f : looking_in)
    if (!said.contains(f)) reject(name("face", f) + " looks into it, and is not said to");
  return std::to_string(walls.size()) + " walls, " + std::to_string(sources.size()) + " portals, " +
         std::to_string(looking_in.size()) + " faces that look into it";
}

}  // namespace
}  // namespace sightline::level_check

namespace sightline {

Verdict verify_level_cell(const Polygon_soup& soup, const Cell_statement& cell, const Weak_certificate& certificate,
                          const Verify_options& options) {
  return Level_cell_checker(soup, options).check(cell, certificate);
}

Level_cell_checker::Level_cell_checker(const Polygon_soup& soup, Verify_options options)
    : soup_(soup), options_(std::move(options)) {}
Level_cell_checker::~Level_cell_checker() = default;

Verdict Level_cell_checker::check(const Cell_statement& cell, const Weak_certificate& certificate) {
  return certificate_check::verdict_of([&] {
    if (scene_ == nullptr || !scene_->is_of(certificate)) {
      const certificate_check::Workers workers(options_, certificate.visible.size() + certificate.hidden.size());
      scene_.reset();
      scene_ = std::make_unique<const weak_check::Known_scene>(soup_, certificate, workers);
    }
    open_walls_.clear();
    return level_check::check_cell(soup_, cell, certificate, *scene_, options_, open_walls_);
  });
}

}  // namespace sightline
