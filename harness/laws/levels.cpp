#include <sightline/harness/laws/levels.h>

#include <sightline/algorithms/levels/grid.h>
#include <sightline/algorithms/levels/pvs.h>
#include <sightline/algorithms/weak_visibility/volume.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/level_certificates.h>
#include <sightline/harness/laws/level_checks.h>
#include <sightline/harness/laws/level_groups.h>
#include <sightline/harness/laws/level_hasty.h>
#include <sightline/harness/laws/level_pairs.h>
#include <sightline/harness/laws/manners.h>
#include <sightline/harness/laws/questions.h>
#include <sightline/harness/laws/solid_oracle.h>
#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace levels_subject {

using generate::Points;

// ---- Brute force, on corners alone

/// Where a ray meets a piece, t > 0; nothing beside it and where the ray runs along it.
struct Meeting {
  Rational t;
  int side;     // within the piece: 1 inside, 0 on an edge
  bool leaves;  // through its front, from behind
};
std::optional<Meeting> meeting(const Flat_face& flat, const Exact_point& p, const Exact_point& direction) {
  const Rational slope = dot(flat.normal, direction);
  if (slope == 0) return std::nullopt;
  const Rational t = -flat.height(p) / slope;
  if (t <= 0) return std::nullopt;
  const int side = flat.side_within(generate::along(p, t, direction));
  if (side < 0) return std::nullopt;
  return Meeting{t, side, slope > 0};
}

/// The winding number about a point along a ray; nothing where the ray meets an edge.
std::optional<int> winding_along(const std::vector<Flat_face>& flats, const Exact_point& p,
                                 const Exact_point& direction) {
  int sum = 0;
  for (const Flat_face& flat : flats)
    if (const std::optional<Meeting> at = meeting(flat, p, direction)) {
      if (at->side == 0) return std::nullopt;
      sum += at->leaves ? 1 : -1;
    }
  return sum;
}

/// The face whose front a ray meets first, in its inside and no other there; else nothing.
std::optional<Face_id> first_front(const Scene& scene, const std::vector<Flat_face>& flats, const Exact_point& p,
                                   const Exact_point& direction) {
  std::optional<Rational> nearest;
  std::optional<Face_id> face;
  for (std::size_t i = 0; i < flats.size(); ++i) {
    const std::optional<Meeting> at = meeting(flats[i], p, direction);
    if (!at || (nearest && at->t > *nearest)) continue;
    const bool again = nearest && at->t == *nearest;
    nearest = at->t;
    face = at->side > 0 && !at->leaves && !again ? std::optional<Face_id>(scene.pieces()[i].face) : std::nullopt;
  }
  return face;
}

Exact_point any_direction(Random& random) {
  for (;;) {
    const Exact_point direction{generate::integer(random, -99, 99), generate::integer(random, -99, 99),
                                generate::integer(random, -99, 99)};
    if (!is_zero(direction)) return direction;
  }
}

// ---- Checks

/// Cells are convex, with their points inside, and fill a box.
Outcome fill(const Level_cells& level) {
  const auto [low, high] = exact_box(level.points());
  Rational volume = 0;
  for (Cell_id c = 0; c < level.cells().size(); ++c) {
    const Exact_point inside = level.inside(c);
    const std::string cell = "cell " + std::to_string(c);
    if (level.at(inside) != c) return Outcome::failed(cell + " does not hold the mean of its corners");
    bool outside = false;
    for (const std::uint32_t w : level.cells()[c].walls) {
      const Cell_wall& wall = level.walls()[w];
      const Points polygon = level.polygon(wall.corners);
      const int side = sgn(Flat_face(polygon).height(inside));
      if (side != (wall.front == c ? 1 : -1))
        return Outcome::failed(cell + " is on the other side of wall " + std::to_string(w));
      volume += wall.front == c ? -six_cones(polygon) : six_cones(polygon);
      outside |= wall.behind == no_cell;
    }
    if (outside != level.cells()[c].is_outside) return Outcome::failed(cell + ": whether it has an end");
  }
  if (volume != 6 * (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]))
    return Outcome::failed("cells do not fill their box");
  return {};
}

/// A random point of a wall is on a face that the wall names, or in an open part of it.
Outcome point_of_wall(const Level_cells& level, const std::vector<Flat_face>& flats, Random& random) {
  const std::size_t w = random.below(level.walls().size());
  const Cell_wall& wall = level.walls()[w];
  const Flat_face polygon(level.polygon(wall.corners));
  Exact_point p{};
  long sum = 0;
  for (const Exact_point& corner : polygon.corners) {
    const long weight = static_cast<long>(random.between(1, 1000));
    sum += weight;
    for (std::size_t k = 0; k < 3; ++k) p[k] += weight * corner[k];
  }
  for (Rational& x : p) x /= sum;
  int covered = -1, open = -1;  // 1: inside; 0: on the boundary
  for (std::size_t i = 0; i < flats.size(); ++i) {
    const Flat_face& flat = flats[i];
    if (flat.height(p) != 0 || !is_zero(cross(flat.normal, polygon.normal))) continue;
    const int side = flat.side_within(p);
    const Face_id face = level.scene().pieces()[i].face;
    covered = std::max(covered, side);
    const std::vector<Face_id>& faces = dot(flat.normal, polygon.normal) > 0 ? wall.faces_front : wall.faces_behind;
    if (side > 0 && !std::binary_search(faces.begin(), faces.end(), face))
      return Outcome::failed("wall " + std::to_string(w) + " does not name " + face_name(face));
  }
  for (const std::vector<std::uint32_t>& part : wall.open)
    open = std::max(open, Flat_face(level.polygon(part)).side_within(p));
  if (wall.behind == no_cell) return {};
  if (std::max(covered, open) < 0)
    return Outcome::failed("a point of wall " + std::to_string(w) + " is on no face and in no open part");
  if (covered > 0 && open > 0)
    return Outcome::failed("a point of wall " + std::to_string(w) + " is on a face and in an open part");
  return {};
}

Outcome windings(const Level_cells& level, const std::vector<Flat_face>& flats, Random& random) {
  int least = 0;
  for (const Level_cell& cell : level.cells()) least = std::min(least, cell.winding);
  for (std::size_t k = 0; k < 8; ++k) {
    const Cell_id c = static_cast<Cell_id>(random.below(level.cells().size()));
    std::optional<int> expected;
    while (!expected) expected = winding_along(flats, level.inside(c), any_direction(random));
    const Level_cell& cell = level.cells()[c];
    if (cell.winding != *expected || cell.is_solid != (*expected > least))
      return Outcome::failed("cell " + std::to_string(c) + " has the winding number " + std::to_string(*expected) +
                             ", not " + std::to_string(cell.winding));
  }
  return {};
}

/// Each cell is in the leaf that it names: the middle of it, by the tree itself, and no corner beyond a plane above.
Outcome leaves(const Level_cells& level, const Space_tree& tree) {
  const auto height = [](const std::array<Rational, 4>& h, const Exact_point& p) {
    return Rational(h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3]);
  };
  for (Cell_id c = 0; c < level.cells().size(); ++c) {
    std::int32_t at = tree.root;
    while (at >= 0) {
      const Space_tree::Node& node = tree.nodes[static_cast<std::size_t>(at)];
      const int side = sgn(height(node.plane, level.inside(c)));
      if (side == 0) return Outcome::failed("cell " + std::to_string(c) + " has a given plane through its middle");
      for (const std::uint32_t w : level.cells()[c].walls)
        for (const Exact_point& p : level.polygon(level.walls()[w].corners))
          if (side * sgn(height(node.plane, p)) < 0)
            return Outcome::failed("cell " + std::to_string(c) + " is on both sides of a given plane");
      at = node.children[side > 0 ? 0 : 1];
    }
    if (level.cells()[c].leaf != static_cast<std::uint32_t>(-1 - at))
      return Outcome::failed("cell " + std::to_string(c) + " is in another leaf than it names");
  }
  return {};
}

/// Each cell names the box that its middle is in, by division; one beyond the rim names the box at the rim.
Outcome in_boxes(const Level_cells& level, const std::array<Exact_point, 2>& box,
                 const std::array<std::uint32_t, 3>& counts) {
  for (Cell_id c = 0; c < level.cells().size(); ++c) {
    const Exact_point p = level.inside(c);
    std::uint32_t number = 0;
    for (std::size_t k = 3; k-- > 0;) {
      std::uint32_t place = 0;
      while (place + 1 < counts[k] && (p[k] - box[0][k]) * counts[k] > (place + 1) * (box[1][k] - box[0][k])) ++place;
      number = number * counts[k] + place;
    }
    if (level.cells()[c].leaf != number)
      return Outcome::failed("cell " + std::to_string(c) + " is in another box than it names");
  }
  return {};
}

/// That counters say what there is.
std::string flaw_of_counters(const Level_cells& level) {
  Cell_counters found;
  std::set<std::uint32_t> regions;
  for (const Level_cell& cell : level.cells()) {
    regions.insert(cell.region);
    if (cell.is_solid) ++found.solid;
    if (cell.is_outside) ++found.outside;
  }
  for (const Cell_wall& wall : level.walls()) {
    if (!wall.open.empty() && !level.cells()[wall.front].is_solid) ++found.portals;
    if (wall.open.empty() && wall.behind != no_cell) ++found.covered;
  }
  const Cell_counters& said = level.counters();
  const bool right = said.cells == level.cells().size() && said.walls == level.walls().size() &&
                     said.solid == found.solid && said.outside == found.outside && said.portals == found.portals &&
                     said.covered == found.covered && said.regions == regions.size();
  return right ? "" : "cells, walls or regions are miscounted";
}

Outcome of_cells(const Posed_scene& posed, const Answer&, Random& random) {
  Cell_options options;
  std::array<std::uint32_t, 3> boxes{};  // of a grid
  if (random.chance(1, 2)) options.tree = any_tree(posed.soup, random);
  else if (random.chance(1, 2)) {
    const std::array<Exact_point, 2> box = box_of_corners(posed.soup);
    for (std::size_t k = 0; k < 3; ++k)
      boxes[k] = box[0][k] == box[1][k] ? 1 : static_cast<std::uint32_t>(random.between(1, 3));
    options.tree = even_boxes(posed.soup, boxes);
  }
  const Level_cells level(posed.soup, options);
  if (boxes[0] > 0)
    if (const Outcome outcome = in_boxes(level, box_of_corners(posed.soup), boxes);
        outcome.state != Outcome::State::passed)
      return outcome;
  if (const std::string flaw = flaw_of_counters(level); !flaw.empty()) return Outcome::failed(flaw);
  const std::vector<Flat_face> flats = flat_faces_of(level.scene());
  if (const Outcome outcome = fill(level); outcome.state != Outcome::State::passed) return outcome;
  if (const Outcome outcome = leaves(level, options.tree); outcome.state != Outcome::State::passed) return outcome;
  for (std::size_t k = 0; k < 20; ++k)
    if (const Outcome outcome = point_of_wall(level, flats, random); outcome.state != Outcome::State::passed)
      return outcome;
  if (level.is_closed() && level.scene().counters().duplicates == 0) return windings(level, flats, random);
  return {};
}

/// Boxes on a small lattice, some of them inside out, that touch, overlap and have faces in common, faces whole or in
/// two: winding numbers.
Outcome of_boxes(const Posed_scene&, const Answer&, Random& random) {
  generate::Faces faces;
  for (std::size_t boxes = 1 + random.below(4); boxes > 0; --boxes) {
    const Exact_point low = generate::lattice(random, 2);
    Exact_point high;
    for (std::size_t k = 0; k < 3; ++k) high[k] = low[k] + generate::integer(random, 1, 3);
    const bool inside_out = random.chance(1, 3);
    for (const Points& face : generate::box(low, high)) {
      const Points turned = inside_out ? generate::reversed(face) : face;
      if (random.chance(1, 2)) {
        faces.push_back(turned);
        continue;
      }
      const Exact_point p = generate::centroid({turned[0], turned[1]}), q = generate::centroid({turned[2], turned[3]});
      faces.push_back({turned[0], p, q, turned[3]});
      faces.push_back({p, turned[1], turned[2], q});
    }
  }
  generate::shuffle(faces, random);
  const Level_cells level(generate::soup_of(faces));
  if (!level.is_closed()) return Outcome::failed("boxes do not close up");
  std::vector<Flat_face> flats;  // of the boxes themselves: a scene sets duplicates aside
  for (const Points& face : faces) flats.emplace_back(face);
  if (const Outcome outcome = fill(level); outcome.state != Outcome::State::passed) return outcome;
  return windings(level, flats, random);
}

/// That lists name each face once, and counters say what they have.
std::string flaw_of_counters(const Level_cells& level, const Pvs& pvs) {
  std::set<Face_id> looking_in;
  std::size_t asked = 0, within = 0, visible = 0, undecided = 0;
  for (Cell_id c = 0; c < level.cells().size(); ++c) {
    for (const auto* list : {&pvs.visible[c], &pvs.undecided[c]})
      if (std::adjacent_find(list->begin(), list->end(), std::greater_equal<>()) != list->end())
        return "faces of a cell are not ascending";
    visible += pvs.visible[c].size();
    undecided += pvs.undecided[c].size();
    if (pvs.is_asked[c] == 0) continue;
    const std::set<Face_id> own(level.cells()[c].faces.begin(), level.cells()[c].faces.end());
    ++asked;
    within += own.size();
    looking_in.insert(own.begin(), own.end());
  }
  const Pvs_counters& c = pvs.counters;
  if (c.cells != asked || c.faces != looking_in.size() || c.pairs != asked * looking_in.size())
    return "cells, faces or pairs are miscounted";
  if (c.visible != visible || c.undecided != undecided || c.within != within)
    return "pairs that see each other, or may, are miscounted";
  // A pair is seen by a longer sightline once at most, and where it may see, once more.
  if (c.extended > visible || c.hidden > c.searched || c.unreached > c.pairs - visible - undecided)
    return "more is extended, hidden or unreached than there is";
  return {};
}

/// What random rays from inside cells meet first is visible from there.
Outcome sightlines(const Posed_scene& posed, const Answer&, Random& random) {
  const Level_cells level(posed.soup);
  const Pvs pvs = potentially_visible(level, options_of(random));
  if (const std::string flaw = flaw_of_counters(level, pvs); !flaw.empty()) return Outcome::failed(flaw);
  const std::vector<Flat_face> flats = flat_faces_of(level.scene());
  for (std::size_t k = 0; k < 60; ++k) {
    const Cell_id c = static_cast<Cell_id>(random.below(level.cells().size()));
    if (pvs.is_asked[c] == 0) continue;
    const std::optional<Face_id> face = first_front(level.scene(), flats, level.inside(c), any_direction(random));
    if (face && !std::binary_search(pvs.visible[c].begin(), pvs.visible[c].end(), *face) &&
        !std::binary_search(pvs.undecided[c].begin(), pvs.undecided[c].end(), *face))
      return Outcome::failed("cell " + std::to_string(c) + " sees " + face_name(*face) +
                             ", which is said to be hidden");
  }
  return {};
}

/// A cell by itself sees what it is said to see.
Outcome alone(const Posed_scene& posed, const Answer&, Random& random) {
  const Level_cells level(posed.soup);
  const Pvs pvs = potentially_visible(level, options_of(random));
  const Occluders occluders(level.scene());
  bool undecided = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Cell_id c = static_cast<Cell_id>(random.below(level.cells().size()));
    if (pvs.is_asked[c] == 0) continue;
    const Weakly_visible found = seen_alone(level, occluders, {c});
    undecided |= !found.undecided.empty() || !pvs.undecided[c].empty();
    for (const bool visible : {true, false}) {
      const std::vector<Face_id>& said = visible ? pvs.visible[c] : found.visible;
      const std::vector<Face_id>& other = visible ? found.visible : pvs.visible[c];
      const std::vector<Face_id>& open = visible ? found.undecided : pvs.undecided[c];
      for (const Face_id face : said)
        if (!std::binary_search(other.begin(), other.end(), face) &&
            !std::binary_search(open.begin(), open.end(), face))
          return Outcome::failed("cell " + std::to_string(c) +
                                 (visible ? " by itself does not see " : " by itself sees ") + face_name(face));
    }
  }
  return undecided ? Outcome::undecided() : Outcome{};
}

// ---- Ways out

/// Of each cell how many walls are to be passed to one that has no end; `no_way` where there is no way.
constexpr std::size_t no_way = ~std::size_t{0};
std::vector<std::size_t> steps_out(const Level_cells& level) {
  std::vector<std::size_t> steps(level.cells().size(), no_way);
  for (Cell_id c = 0; c < level.cells().size(); ++c)
    if (level.cells()[c].is_outside && !level.cells()[c].is_solid) steps[c] = 0;
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (const Cell_wall& wall : level.walls()) {
      if (wall.behind == no_cell || wall.open.empty()) continue;
      for (const auto& [from, to] : {std::pair(wall.front, wall.behind), std::pair(wall.behind, wall.front)})
        if (!level.cells()[from].is_solid && steps[to] != no_way && steps[to] + 1 < steps[from]) {
          steps[from] = steps[to] + 1;
          goes_on = true;
        }
    }
  }
  return steps;
}

/// A place where several cells meet, or one within one: anywhere between a point of a cell and corners of its walls.
Exact_point any_place_about(const Level_cells& level, Random& random) {
  const Cell_id cell = static_cast<Cell_id>(random.below(level.cells().size()));
  if (random.chance(1, 3)) return any_point_of(level, cell, random);
  const std::vector<std::uint32_t>& walls = level.cells()[cell].walls;
  const Points corners = level.polygon(level.walls()[walls[random.below(walls.size())]].corners);
  const auto any_corner = [&] { return corners[random.below(corners.size())]; };
  Exact_point p = any_corner();  // of the wall: a corner, on an edge, inside
  for (std::uint64_t more = random.below(3); more > 0; --more)
    p = generate::along(p, generate::ratio(static_cast<long>(random.below(65)), 64), minus(any_corner(), p));
  return p;
}

/// By the sides of walls that a point is on: the cells none of whose walls it is beyond.
std::vector<Cell_id> cells_about(const Level_cells& level, const Exact_point& p) {
  std::vector<char> is_beyond(level.cells().size(), 0);
  for (const Cell_wall& wall : level.walls()) {
    const Rational height = Flat_face(level.polygon(wall.corners)).height(p);
    if (height < 0) is_beyond[wall.front] = 1;
    if (height > 0 && wall.behind != no_cell) is_beyond[wall.behind] = 1;
  }
  std::vector<Cell_id> cells;
  for (Cell_id c = 0; c < level.cells().size(); ++c)
    if (is_beyond[c] == 0) cells.push_back(c);
  return cells;
}

Outcome ways_out(const Posed_scene& posed, const Answer&, Random& random) {
  const Level_cells level(posed.soup);
  const std::vector<std::size_t> steps = steps_out(level);
  for (std::size_t k = 0; k < 12; ++k) {
    const Exact_point p = any_place_about(level, random);
    const std::string from = "from " + text_of(p);
    const std::vector<Cell_id> cells = cells_about(level, p), way = level.way_out(p);
    if (level.about(p) != cells) return Outcome::failed("about " + text_of(p) + " are other cells");
    const auto is_open = [&](Cell_id cell) { return !level.cells()[cell].is_solid; };
    const auto open = std::find_if(cells.begin(), cells.end(), is_open);
    if (level.at(p) != (open == cells.end() ? cells.front() : *open)) return Outcome::failed(from + " in another cell");
    std::size_t least = no_way;
    for (const Cell_id cell : cells)
      if (is_open(cell)) least = std::min(least, steps[cell]);
    if (way.empty() != (least == no_way))
      return Outcome::failed(from + (way.empty() ? " no way out" : " there is no way out"));
    if (way.empty()) continue;
    if (!std::binary_search(cells.begin(), cells.end(), way.front()))
      return Outcome::failed(from + " another place's way");
    if (way.size() != least + 1) return Outcome::failed(from + " another way is shorter");
    for (std::size_t i = 0; i + 1 < way.size(); ++i)
      if (steps[way[i]] != steps[way[i + 1]] + 1 || !have_a_way(level, way[i], way[i + 1]))
        return Outcome::failed(from + " the way out goes through a wall");
  }
  Exact_point beyond = level.inside(0);
  for (const Exact_point& p : level.points()) beyond[0] = std::max(beyond[0], Rational(p[0] + 1));
  return level.at(beyond) == no_cell && level.about(beyond).empty() && level.way_out(beyond).empty()
             ? Outcome{}
             : Outcome::failed("a point beyond the box is in a cell");
}

/// Nothing is asked of faces alone: cells are the program's choice.
Answer nothing(const Posed_scene& posed) {
  Answer answer;
  answer.labels.assign(posed.soup.face_count(), Answer::none);
  return answer;
}

}  // namespace levels_subject

Subject pvs() {
  Subject subject;
  subject.name = "pvs";
  subject.what = "cells of a level, their walls, and what each sees";
  subject.answer = levels_subject::nothing;
  subject.checks = {
      {"cells", "cells fill a box; points of walls are on faces or open; winding numbers along rays",
       levels_subject::of_cells},
      {"boxes", "winding numbers of cells among boxes that touch, overlap and are inside out",
       levels_subject::of_boxes},
      {"sightlines", "what random rays from cells meet first is visible", levels_subject::sightlines},
      {"alone", "a cell by itself sees the same", levels_subject::alone},
      segments_check(),
      pairs_check(),
      check_of_a_share("volumes",
                       "cells fill the volumes that they name; boxes as volumes see what boxes of a grid see", 2,
                       levels_subject::volumes),
      check_of_a_share("coarse", "regions are convex, empty and as few as can be, and see what they see by themselves",
                       2, levels_subject::coarse),
      check_of_a_share("certificates", "what is true of cells is accepted, and what is not is refused", 2,
                       levels_subject::certificates),
      {"ways",
       "cells about a place are those whose walls it is not beyond; ways out of them go through open walls, as few as "
       "can be, and are there iff some wall after another is open",
       levels_subject::ways_out}};
  subject.checks.push_back(hasty_levels_check());
  subject.checks.push_back(manners_check(questions_of_pvs()));
  return subject;
}

}  // namespace sightline::harness
