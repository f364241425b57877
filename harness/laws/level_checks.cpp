#include <sightline/harness/laws/level_checks.h>

#include <sightline/algorithms/levels/ways.h>
#include <sightline/algorithms/weak_visibility/volume.h>
#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>

namespace sightline::harness::levels_subject {

using generate::Points;

Rational six_cones(const Points& polygon) {
  Rational sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) sum += dot(polygon[0], cross(polygon[i], polygon[i + 1]));
  return sum;
}

Space_tree any_tree(const Polygon_soup& soup, Random& random) {
  Space_tree tree;
  std::int32_t leaves = 0;
  const std::size_t nodes = random.below(8);
  for (std::size_t n = 0; n < nodes; ++n) {
    Space_tree::Node node;
    const std::size_t made = tree.nodes.size();
    if (made > 0 && random.chance(1, 4)) node.plane = tree.nodes[random.below(made)].plane;
    else {
      for (std::size_t k = 0; k < 3; ++k) node.plane[k] = generate::integer(random, -2, 2);
      if (random.chance(1, 2) || is_zero(Exact_point{node.plane[0], node.plane[1], node.plane[2]})) {
        node.plane = {};
        node.plane[random.below(3)] = random.chance(1, 2) ? 1 : -1;
      }
      Exact_point p{};
      if (soup.point_count() > 0) p = soup.point(static_cast<Point_id>(random.below(soup.point_count())));
      for (std::size_t k = 0; k < 3; ++k) node.plane[3] -= node.plane[k] * p[k];
    }
    for (std::int32_t& child : node.children) child = -1 - leaves++;
    if (made > 0) {  // in the place of a leaf
      Space_tree::Node& above = tree.nodes[random.below(made)];
      std::int32_t& child = above.children[random.below(2)];
      if (child >= 0) continue;
      child = static_cast<std::int32_t>(made);
    }
    tree.nodes.push_back(node);
  }
  tree.root = tree.nodes.empty() ? -1 - leaves : 0;
  return tree;
}

std::array<Exact_point, 2> box_of_corners(const Polygon_soup& soup) {
  Points corners;
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t l = 0; l < soup.loop_count(f); ++l)
      for (const Point_id p : soup.loop(f, l)) corners.push_back(soup.point(p));
  return corners.empty() ? std::array<Exact_point, 2>{} : exact_box(corners);
}

Polygon_soup polyhedron(const Level_cells& level, const std::vector<Cell_id>& cells) {
  Polygon_soup soup;
  for (const auto& [w, cell] : walls_about(level, cells)) {
    Points polygon = level.polygon(level.walls()[w].corners);
    if (level.walls()[w].front == cell) std::reverse(polygon.begin(), polygon.end());
    soup.add_face(generate::added(soup, polygon));
  }
  return soup;
}

Exact_point any_point_of(const Level_cells& level, Cell_id cell, Random& random) {
  Exact_point p = level.inside(cell);
  const std::vector<std::uint32_t>& walls = level.cells()[cell].walls;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<std::uint32_t>& corners = level.walls()[walls[random.below(walls.size())]].corners;
    const Exact_point& corner = level.points()[corners[random.below(corners.size())]];
    const Rational part = generate::ratio(static_cast<long>(random.below(64)), 64);
    for (std::size_t i = 0; i < 3; ++i) p[i] += part * (corner[i] - p[i]);
  }
  return p;
}

bool have_a_way(const Level_cells& level, Cell_id a, Cell_id b) {
  return std::any_of(level.cells()[a].walls.begin(), level.cells()[a].walls.end(), [&](std::uint32_t w) {
    const Cell_wall& wall = level.walls()[w];
    return !wall.open.empty() && (wall.front == b || wall.behind == b);
  });
}

std::vector<std::pair<std::uint32_t, Cell_id>> walls_about(const Level_cells& level,
                                                           const std::vector<Cell_id>& cells) {
  std::vector<std::pair<std::uint32_t, Cell_id>> walls;
  for (const Cell_id cell : cells)
    for (const std::uint32_t w : level.cells()[cell].walls) {
      const Cell_id other = level.walls()[w].front == cell ? level.walls()[w].behind : level.walls()[w].front;
      if (std::find(cells.begin(), cells.end(), other) == cells.end()) walls.emplace_back(w, cell);
    }
  return walls;
}

std::vector<Points> portals_about(const Level_cells& level, const std::vector<Cell_id>& cells) {
  std::vector<Points> portals;
  for (const auto& [w, cell] : walls_about(level, cells))
    for (const std::vector<std::uint32_t>& part : level.walls()[w].open)
      portals.push_back(levels_detail::looking_from(level, level.walls()[w], part, cell));
  return portals;
}

Weakly_visible seen_alone(const Level_cells& level, const Occluders& occluders, const std::vector<Cell_id>& cells) {
  std::vector<Weak_source> sources;
  for (const Points& portal : portals_about(level, cells)) sources.push_back(weak_source(occluders, portal));
  Weak_options options;
  options.threads = 1;
  options.search.cells = most_undecided_cells;
  Weakly_visible found;
  if (!sources.empty()) found = weakly_visible(occluders, sources, options);
  else
    for (const Piece& piece : level.scene().pieces())
      if (found.hidden.empty() || found.hidden.back() != piece.face) found.hidden.push_back(piece.face);
  add_seen_from_within(level.scene(), Weak_volume(polyhedron(level, cells)), false, found);
  return found;
}

Pvs_options options_of(Random& random) {
  Pvs_options options;
  options.threads = 1;
  options.search.cells = most_undecided_cells;
  options.event_edges = 0;
  options.outside = random.chance(1, 2);
  return options;
}

}  // namespace sightline::harness::levels_subject
