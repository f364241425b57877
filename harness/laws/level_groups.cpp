#include <sightline/harness/laws/level_groups.h>

#include <sightline/algorithms/levels/coarse.h>
#include <sightline/algorithms/levels/grid.h>
#include <sightline/algorithms/levels/volumes.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/level_checks.h>
#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>

namespace sightline::harness::levels_subject {

using generate::Points;

namespace {

std::string cell_name(Cell_id cell) { return "cell " + std::to_string(cell); }

Points points_of_loop(const Polygon_soup& soup, Face_id f) {
  Points points;
  for (const Point_id p : soup.loop(f)) points.push_back(soup.point(p));
  return points;
}

Rational six_volumes(const Polygon_soup& polyhedron) {
  Rational sum = 0;
  for (Face_id f = 0; f < polyhedron.face_count(); ++f) sum += six_cones(points_of_loop(polyhedron, f));
  return sum;
}

/// A convex polygon made smaller about its middle.
Points shrunken(const Points& polygon) {
  Exact_point middle{0, 0, 0};
  for (const Exact_point& p : polygon)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += p[k] / Rational(static_cast<long>(polygon.size()));
  Points inner = polygon;
  for (Exact_point& p : inner)
    for (std::size_t k = 0; k < 3; ++k) p[k] = (p[k] + 3 * middle[k]) / 4;
  return inner;
}

/// Adds a polyhedron with points of its own, which its faces share, all faces either way round. One of them may have a
/// hole, which another face fills.
void add_volume(Polygon_soup& volumes, const Polygon_soup& polyhedron, bool is_turned, Random& random) {
  std::map<Exact_point, Point_id> ids;
  const auto loop_of = [&](const Points& points) {
    std::vector<Point_id> loop;
    for (const Exact_point& p : points) {
      const auto [at, is_new] = ids.try_emplace(p, 0);
      if (is_new) at->second = volumes.add_point(p[0], p[1], p[2]);
      loop.push_back(at->second);
    }
    if (is_turned) std::reverse(loop.begin(), loop.end());
    return loop;
  };
  const bool has_hole = random.chance(1, 2);
  const Face_id with_hole = static_cast<Face_id>(random.below(polyhedron.face_count()));
  for (Face_id f = 0; f < polyhedron.face_count(); ++f) {
    const Points points = points_of_loop(polyhedron, f);
    volumes.add_face(loop_of(points));
    if (!has_hole || f != with_hole) continue;
    const std::vector<Point_id> filling = loop_of(shrunken(points));
    const std::vector<Point_id> hole(filling.rbegin(), filling.rend());
    volumes.add_hole(hole);
    volumes.add_face(filling);
  }
}

/// A cell that is not taken yet, and as a rule some beside it, so that the whole is convex or bent: what hangs together
/// by points, and of three at most, so that there is no hollow in it.
std::vector<Cell_id> some_neighbours(const Level_cells& level, Cell_id first, std::vector<char>& is_taken,
                                     Random& random) {
  std::vector<Cell_id> cells{first};
  is_taken[first] = 1;
  for (std::uint64_t more = random.below(3); more > 0; --more) {
    const Level_cell& last = level.cells()[cells[random.below(cells.size())]];
    const Cell_wall& wall = level.walls()[last.walls[random.below(last.walls.size())]];
    for (const Cell_id beside : {wall.front, wall.behind})
      if (beside != no_cell && is_taken[beside] == 0) {
        cells.push_back(beside);
        is_taken[beside] = 1;
        break;
      }
  }
  return cells;
}

/// Cells of another tree, and some together, as volumes: those of a level name the one that holds them, and fill it.
Outcome cells_as_volumes(const Posed_scene& posed, Random& random) {
  Cell_options options;
  options.tree = any_tree(posed.soup, random);
  for (Point_id p = 0; p < posed.soup.point_count(); ++p) options.tree.corners.push_back(posed.soup.point(p));
  const Level_cells other(random.chance(1, 2) ? posed.soup : Polygon_soup{}, options);
  Polygon_soup volumes;
  std::vector<std::vector<Polygon_soup>> given;  // of each the cells
  std::vector<char> is_taken(other.cells().size(), 0);
  for (Cell_id c = 0; c < other.cells().size() && given.size() < 12; ++c) {
    if (random.chance(1, 2) || is_taken[c] != 0) continue;
    const std::vector<Cell_id> cells = some_neighbours(other, c, is_taken, random);
    std::vector<Polygon_soup>& parts = given.emplace_back();
    for (const Cell_id cell : cells) parts.push_back(polyhedron(other, {cell}));
    const bool is_turned = random.chance(1, 3);
    add_volume(volumes, polyhedron(other, cells), is_turned, random);
  }
  const Volume_division division = volume_division(volumes);
  if (division.volumes != given.size()) return Outcome::failed("volumes are not as many as were given");
  options.tree = division.tree;
  const Level_cells level(posed.soup, options);
  std::vector<Rational> filled(given.size());
  for (Cell_id c = 0; c < level.cells().size(); ++c) {
    const Exact_point p = level.inside(c);
    std::size_t expected = 0;
    for (; expected < given.size(); ++expected) {
      // On the border of a part it is between two of the volume: cells go through no side of that.
      const auto holds = [&](const Polygon_soup& part) {
        for (Face_id f = 0; f < part.face_count(); ++f)
          if (Flat_face(points_of_loop(part, f)).height(p) > 0) return false;
        return true;
      };
      if (std::any_of(given[expected].begin(), given[expected].end(), holds)) break;
    }
    if (level.cells()[c].leaf != expected) return Outcome::failed(cell_name(c) + " is in another volume than it names");
    if (expected < given.size()) filled[expected] += six_volumes(polyhedron(level, {c}));
  }
  for (std::size_t v = 0; v < given.size(); ++v) {
    for (const Polygon_soup& part : given[v]) filled[v] -= six_volumes(part);
    if (filled[v] != 0) return Outcome::failed("cells do not fill volume " + std::to_string(v));
  }
  return {};
}

/// By leaf: what its cells see together, and what is undecided of some of them.
struct Leaf_row {
  std::set<Face_id> visible, undecided;
};
std::map<std::uint32_t, Leaf_row> rows_of_leaves(const Level_cells& level, const Pvs& pvs) {
  std::map<std::uint32_t, Leaf_row> rows;
  for (Cell_id c = 0; c < level.cells().size(); ++c) {
    if (pvs.is_asked[c] == 0) continue;
    Leaf_row& row = rows[level.cells()[c].leaf];
    row.visible.insert(pvs.visible[c].begin(), pvs.visible[c].end());
    row.undecided.insert(pvs.undecided[c].begin(), pvs.undecided[c].end());
  }
  return rows;
}

/// Even boxes as volumes, those at the rim as far as cells go.
Outcome boxes_as_volumes(const Posed_scene& posed, Random& random) {
  // 1. The same boxes in two ways.
  const std::array<Exact_point, 2> box = box_of_corners(posed.soup);
  std::array<std::uint32_t, 3> counts{};
  for (std::size_t k = 0; k < 3; ++k)
    counts[k] = box[0][k] == box[1][k] ? 1 : static_cast<std::uint32_t>(random.between(1, 2));
  Cell_options division;
  division.tree = even_boxes(posed.soup, counts);
  const Level_cells boxes(posed.soup, division);
  const std::array<Exact_point, 2> world = exact_box(boxes.points());
  Polygon_soup volumes;
  for (std::uint32_t number = 0; number < counts[0] * counts[1] * counts[2]; ++number) {
    const std::array<std::uint32_t, 3> place{number % counts[0], number / counts[0] % counts[1],
                                             number / counts[0] / counts[1]};
    std::array<Exact_point, 2> own = world;
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational side = (box[1][k] - box[0][k]) / counts[k];
      if (place[k] > 0) own[0][k] = box[0][k] + place[k] * side;
      if (place[k] + 1 < counts[k]) own[1][k] = box[0][k] + (place[k] + 1) * side;
    }
    const bool is_turned = random.chance(1, 3);
    add_volume(volumes, generate::soup_of(generate::box(own[0], own[1])), is_turned, random);
  }
  division.tree = volume_division(volumes).tree;
  const Level_cells rooms(posed.soup, division);

  // 2. What they see.
  const Pvs_options options = options_of(random);
  const std::map<std::uint32_t, Leaf_row> a = rows_of_leaves(boxes, potentially_visible(boxes, options));
  std::map<std::uint32_t, Leaf_row> b = rows_of_leaves(rooms, potentially_visible(rooms, options));
  b.erase(static_cast<std::uint32_t>(counts[0] * counts[1] * counts[2]));  // beyond all volumes
  bool undecided = false;
  for (const auto& [leaf, row] : a) {
    const Leaf_row& other = b[leaf];
    undecided |= !row.undecided.empty() || !other.undecided.empty();
    for (const auto& [one, two] : {std::pair(&row, &other), {&other, &row}})
      for (const Face_id face : one->visible)
        if (!two->visible.contains(face) && !two->undecided.contains(face))
          return Outcome::failed("box " + std::to_string(leaf) + " and the same as a volume disagree about " +
                                 face_name(face));
  }
  if (a.size() != b.size()) return Outcome::failed("boxes are asked about that are not as volumes");
  return undecided ? Outcome::undecided() : Outcome{};
}

// ---- Convex regions

/// Whether two convex sets of cells with a wall in common are convex together: segments from corners of the one to
/// corners of the other pass through what they have in common.
bool are_convex_together(const Level_cells& level, const std::vector<Cell_id>& a, const std::vector<Cell_id>& b) {
  std::vector<Flat_face> between;
  std::set<std::uint32_t> corners[2];
  for (const auto& [w, cell] : walls_about(level, a)) {
    const Cell_wall& wall = level.walls()[w];
    const Cell_id other = wall.front == cell ? wall.behind : wall.front;
    if (std::find(b.begin(), b.end(), other) != b.end()) between.emplace_back(level.polygon(wall.corners));
    corners[0].insert(wall.corners.begin(), wall.corners.end());
  }
  for (const auto& [w, cell] : walls_about(level, b))
    corners[1].insert(level.walls()[w].corners.begin(), level.walls()[w].corners.end());
  for (const std::uint32_t i : corners[0])
    for (const std::uint32_t j : corners[1]) {
      const Exact_point &p = level.points()[i], &q = level.points()[j];
      const Rational at_p = between[0].height(p), at_q = between[0].height(q);
      if (at_p == 0 && at_q == 0) continue;
      const Exact_point crossing = generate::along(p, at_p / (at_p - at_q), minus(q, p));
      if (std::none_of(between.begin(), between.end(),
                       [&](const Flat_face& wall) { return wall.side_within(crossing) >= 0; }))
        return false;
    }
  return true;
}

/// Regions hold what they should: cells that are not solid, no face inside; convex; and no two could be one.
Outcome regions_are_convex(const Level_cells& level, const std::vector<std::vector<Cell_id>>& regions,
                           const std::vector<std::uint32_t>& region_of, std::size_t most) {
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const std::string region = "region " + std::to_string(r);
    std::set<std::uint32_t> corners;
    for (const Cell_id c : regions[r])
      for (const std::uint32_t w : level.cells()[c].walls) {
        const Cell_wall& wall = level.walls()[w];
        corners.insert(wall.corners.begin(), wall.corners.end());
        const bool is_inner = wall.behind != no_cell && region_of[wall.front] == region_of[wall.behind];
        if (is_inner && !(wall.faces_front.empty() && wall.faces_behind.empty()))
          return Outcome::failed(region + " has a face inside");
      }
    for (const auto& [w, cell] : walls_about(level, regions[r])) {
      const Flat_face wall(level.polygon(level.walls()[w].corners));
      for (const std::uint32_t p : corners)
        if (sgn(wall.height(level.points()[p])) * (level.walls()[w].front == cell ? 1 : -1) < 0)
          return Outcome::failed(region + " is not convex");
    }
  }
  if (regions.size() <= most) return {};
  std::set<std::pair<std::uint32_t, std::uint32_t>> covered, open;
  for (const Cell_wall& wall : level.walls()) {
    if (wall.behind == no_cell || region_of[wall.front] == no_cell || region_of[wall.behind] == no_cell) continue;
    const auto pair = std::minmax(region_of[wall.front], region_of[wall.behind]);
    if (pair.first == pair.second) continue;
    (wall.faces_front.empty() && wall.faces_behind.empty() ? open : covered).insert(pair);
  }
  for (const auto& [a, b] : open)
    if (!covered.contains({a, b}) && are_convex_together(level, regions[a], regions[b]))
      return Outcome::failed("regions " + std::to_string(a) + " and " + std::to_string(b) + " could be one");
  return {};
}

/// Sides of boxes on a small lattice: cells of a few planes, walls of which some are covered.
Polygon_soup sheets(Random& random) {
  generate::Faces faces;
  for (std::size_t count = 3 + random.below(6); count > 0; --count) {
    const Exact_point low = generate::lattice(random, 2);
    Exact_point high;
    for (std::size_t k = 0; k < 3; ++k) high[k] = low[k] + generate::integer(random, 1, 3);
    faces.push_back(generate::box(low, high)[random.below(6)]);
  }
  return generate::soup_of(faces);
}

}  // namespace

Outcome volumes(const Posed_scene& posed, Random& random) {
  const Outcome outcome = cells_as_volumes(posed, random);
  return outcome.state == Outcome::State::passed ? boxes_as_volumes(posed, random) : outcome;
}

Outcome coarse(const Posed_scene& posed, Random& random) {
  const Polygon_soup soup = random.chance(1, 2) ? posed.soup : sheets(random);
  Cell_options cell_options;
  if (random.chance(2, 3)) cell_options.tree = any_tree(soup, random);
  const Level_cells level(soup, cell_options);
  const std::size_t most = random.chance(1, 2) ? 1 : 1 + random.below(level.cells().size());
  const std::vector<std::uint32_t> region_of = convex_regions(level, most);
  std::vector<std::vector<Cell_id>> regions;
  for (Cell_id c = 0; c < region_of.size(); ++c) {
    if ((region_of[c] == no_cell) != level.cells()[c].is_solid)
      return Outcome::failed(cell_name(c) + " is solid, or in no region");
    if (region_of[c] == no_cell) continue;
    if (region_of[c] >= regions.size()) regions.resize(region_of[c] + 1);
    regions[region_of[c]].push_back(c);
  }
  if (const Outcome outcome = regions_are_convex(level, regions, region_of, most);
      outcome.state != Outcome::State::passed)
    return outcome;

  // What a region sees by itself is what its cells see.
  Pvs_options options = options_of(random);
  options.outside = true;
  const Pvs pvs = potentially_visible(level, options);
  const Occluders occluders(level.scene());
  bool undecided = false;
  for (std::size_t k = 0; k < 2 && !regions.empty(); ++k) {
    const std::size_t r = random.below(regions.size());
    const Weakly_visible found = seen_alone(level, occluders, regions[r]);
    std::set<Face_id> seen, open(found.undecided.begin(), found.undecided.end());
    for (const Cell_id c : regions[r]) {
      seen.insert(pvs.visible[c].begin(), pvs.visible[c].end());
      open.insert(pvs.undecided[c].begin(), pvs.undecided[c].end());
    }
    undecided |= !open.empty();
    const std::set<Face_id> alone(found.visible.begin(), found.visible.end());
    std::vector<Face_id> differ;
    std::set_symmetric_difference(seen.begin(), seen.end(), alone.begin(), alone.end(), std::back_inserter(differ));
    for (const Face_id face : differ)
      if (!open.contains(face))
        return Outcome::failed("region " + std::to_string(r) +
                               " by itself does not see what its cells see: " + face_name(face));
  }
  return undecided ? Outcome::undecided() : Outcome{};
}

}  // namespace sightline::harness::levels_subject
