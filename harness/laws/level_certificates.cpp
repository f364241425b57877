#include <sightline/harness/laws/level_certificates.h>

#include <sightline/algorithms/levels/stated_cell.h>
#include <sightline/algorithms/verify/level_fill.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/level_checks.h>
#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>

namespace sightline::harness::levels_subject {

using generate::Points;

namespace {

/// All that is said of a cell, or of several as if they were one.
struct Said {
  Cell_statement cell;
  Weak_certificate certificate;
};

/// What is true of cells; of what they see, nothing is claimed.
Said said_of(const Level_cells& level, const std::vector<Cell_id>& cells) {
  Said said;
  std::set<Face_id> within;
  for (const Cell_id c : cells) within.insert(level.cells()[c].faces.begin(), level.cells()[c].faces.end());
  said.cell.within.assign(within.begin(), within.end());
  const Polygon_soup walls = polyhedron(level, cells);
  for (Face_id f = 0; f < walls.face_count(); ++f) {
    Points& wall = said.cell.walls.emplace_back();
    for (const Point_id p : walls.loop(f)) wall.push_back(walls.point(p));
  }
  Weakly_visible nothing;
  for (const Piece& piece : level.scene().pieces())
    if (nothing.undecided.empty() || nothing.undecided.back() != piece.face) nothing.undecided.push_back(piece.face);
  said.certificate = weak_certificate(level.scene(), portals_about(level, cells), false, nothing);
  return said;
}

std::array<Exact_point, 2> box_about_cells(const std::vector<Cell_of_level>& cells) {
  Points corners;
  for (const Cell_of_level& cell : cells)
    for (const Points& wall : cell.walls) corners.insert(corners.end(), wall.begin(), wall.end());
  return exact_box(corners);
}

/// Whether some corner of a face is in front of a polygon's plane.
bool has_scene_in_front(const Level_cells& level, const Points& polygon) {
  const Flat_face flat(polygon);
  const std::vector<Flat_face> faces = flat_faces_of(level.scene());
  return std::any_of(faces.begin(), faces.end(), [&](const Flat_face& face) {
    return std::any_of(face.corners.begin(), face.corners.end(),
                       [&](const Exact_point& p) { return flat.height(p) > 0; });
  });
}

/// Walls that are none, or bound nothing.
void tell_nonsense(std::vector<Points>& walls, Random& random) {
  Points& wall = walls[random.below(walls.size())];
  switch (random.below(6)) {
    case 0: walls.clear(); break;
    case 1: wall.clear(); break;
    case 2: {  // not in lowest terms
      Rational& x = wall[random.below(wall.size())][random.below(3)];
      mpz_mul_ui(mpq_numref(x.get_mpq_t()), mpq_numref(x.get_mpq_t()), 2);
      mpz_mul_ui(mpq_denref(x.get_mpq_t()), mpq_denref(x.get_mpq_t()), 2);
      break;
    }
    case 3: wall.assign(3, wall[0]); break;
    case 4: {  // it crosses itself
      Points star;
      for (const std::size_t k : {0, 2, 1}) star.push_back(wall[k % wall.size()]);
      star.insert(star.end(), wall.begin(), wall.end());
      wall = star;
      break;
    }
    default: {  // a wall and its back
      const Points front = wall;
      walls = {front, Points(front.rbegin(), front.rend())};
    }
  }
}

/// Something else than the truth about a cell; nothing where the choice at hand can't be wrong here.
std::optional<Said> forged(const Level_cells& level, Cell_id cell, const Said& truth, Random& random) {
  Said said = truth;
  std::vector<Points>&walls = said.cell.walls, &sources = said.certificate.sources;
  const auto any_of = [&](auto& list) { return list.begin() + static_cast<std::ptrdiff_t>(random.below(list.size())); };
  switch (random.below(12)) {
    case 10:
    case 11: tell_nonsense(walls, random); return said;
    case 0: walls.erase(any_of(walls)); return said;
    case 1: {
      Points& wall = *any_of(walls);
      std::reverse(wall.begin(), wall.end());
      return said;
    }
    case 2: {  // a way out that is not told
      if (sources.empty()) return std::nullopt;
      const auto source = any_of(sources);
      if (!has_scene_in_front(level, *source)) return std::nullopt;
      sources.erase(source);
      return said;
    }
    case 3: {
      if (sources.empty()) return std::nullopt;
      Points& source = *any_of(sources);
      std::reverse(source.begin(), source.end());
      return said;
    }
    case 4: {  // beside its wall, by any distance
      if (sources.empty()) return std::nullopt;
      Points& source = *any_of(sources);
      const Exact_point normal = Flat_face(source).normal;
      for (Exact_point& p : source)
        p = generate::along(
            p, generate::ratio(static_cast<long>(random.between(1, 9)) * (random.chance(1, 2) ? 1 : -1), 64), normal);
      return said;
    }
    case 5: {  // through a face
      std::vector<Points> covered;
      for (const auto& [w, c] : walls_about(level, {cell})) {
        const Cell_wall& wall = level.walls()[w];
        if (wall.faces_front.empty() && wall.faces_behind.empty()) continue;
        covered.push_back(level.polygon(wall.corners));
        if (wall.front == c) std::reverse(covered.back().begin(), covered.back().end());
      }
      if (covered.empty()) return std::nullopt;
      sources.push_back(*any_of(covered));
      return said;
    }
    case 6: {
      if (said.cell.within.empty()) return std::nullopt;
      said.cell.within.erase(any_of(said.cell.within));
      return said;
    }
    case 7: {
      const Face_id face = level.scene().pieces()[random.below(level.scene().pieces().size())].face;
      if (std::find(said.cell.within.begin(), said.cell.within.end(), face) != said.cell.within.end())
        return std::nullopt;
      said.cell.within.push_back(face);
      return said;
    }
    case 8: {  // with a neighbour: a face is between them, or they are not convex together
      const std::uint32_t w = *any_of(level.cells()[cell].walls);
      const Cell_wall& wall = level.walls()[w];
      if (wall.behind == no_cell) return std::nullopt;
      said = said_of(level, {wall.front, wall.behind});
      bool is_convex = true;
      for (const Points& side : said.cell.walls)
        for (const Points& other : said.cell.walls)
          for (const Exact_point& p : other) is_convex = is_convex && Flat_face(side).height(p) <= 0;
      if (is_convex && wall.faces_front.empty() && wall.faces_behind.empty()) return std::nullopt;
      return said;
    }
    default: {  // the whole world
      const auto [low, high] = exact_box(level.points());
      walls = generate::box(low, high);
      sources.clear();
      said.cell.within.clear();
      return said;
    }
  }
}

/// One cell.
Outcome of_a_cell(const Posed_scene& posed, const Level_cells& level, Cell_id cell, Random& random) {
  const std::string name = "cell " + std::to_string(cell);
  const Verify_options one_thread{1, {}};
  Said truth = said_of(level, {cell});
  Level_cell_checker checker(posed.soup, one_thread);
  const Verdict verdict = checker.check(truth.cell, truth.certificate);
  if (!verdict.accepted) return Outcome::failed(name + " is refused: " + verdict.why);
  for (std::size_t k = 0; k < 6; ++k)
    if (const std::optional<Said> said = forged(level, cell, truth, random))
      if (const Verdict lie = checker.check(said->cell, said->certificate); lie.accepted)
        return Outcome::failed(name + ": what is not true of it is accepted: " + lie.why);

  // A way out beyond which there is nothing need not be told to whoever looks; who walks is told of its wall.
  for (std::size_t s = 0; s < truth.certificate.sources.size(); ++s) {
    const Points& source = truth.certificate.sources[s];
    if (has_scene_in_front(level, source)) continue;
    Said less = truth;
    less.certificate.sources.erase(less.certificate.sources.begin() + static_cast<std::ptrdiff_t>(s));
    const Verdict without = checker.check(less.cell, less.certificate);
    if (!without.accepted) return Outcome::failed(name + " is refused without a way to nowhere: " + without.why);
    const std::vector<std::size_t>& open = checker.open_walls();
    const bool is_told = std::any_of(open.begin(), open.end(), [&](std::size_t w) {
      const Flat_face wall(less.cell.walls[w]);
      return std::all_of(source.begin(), source.end(), [&](const Exact_point& p) { return wall.holds(p); });
    });
    if (!is_told) return Outcome::failed(name + " has a way that is neither a source nor an open wall");
  }

  // Who knows another scene says what one says who knows none.
  Said other = truth;
  std::vector<Order_fragment>& fragments = other.certificate.fragments;
  if (fragments.empty()) return {};
  const std::size_t place = random.below(fragments.size()), way = random.below(6);
  if (way == 0) fragments.erase(fragments.begin() + static_cast<std::ptrdiff_t>(place));
  if (way == 1) fragments[place].vertices[0][random.below(3)] += 1;
  if (way == 2) std::swap(fragments[place], fragments[random.below(fragments.size())]);
  if (way == 3) other.certificate.set_aside.push_back({fragments[place].face, "zero area"});
  if (way == 4 && !other.certificate.set_aside.empty()) other.certificate.set_aside[0].why += '.';
  if (way == 5) other.certificate.pieces.push_back({fragments[place].face, 0, fragments[place].vertices});
  for (const Said& said : {other, truth, other}) {
    const Verdict mine = checker.check(said.cell, said.certificate),
                  anew = verify_level_cell(posed.soup, said.cell, said.certificate, one_thread);
    if (mine.accepted != anew.accepted || mine.why != anew.why)
      return Outcome::failed(name + ": who knows the scene says " + mine.why + ", who does not " + anew.why);
  }
  return {};
}

/// All of them. Those that are not solid have certificates.
Outcome of_all(const Posed_scene& posed, const Level_cells& level, Random& random) {
  std::vector<Cell_of_level> truth;
  for (Cell_id c = 0; c < level.cells().size(); ++c) {
    const bool is_asked = !level.cells()[c].is_solid;
    truth.push_back({c, stated_cell(level, c).walls, is_asked, {}});
    if (is_asked) truth.back().sources = portals_of(level, c);
  }
  bool is_beyond = false;
  const Verdict verdict = verify_level_fill(
      posed.soup, truth, {1, [&](std::size_t done, std::size_t all) { is_beyond = is_beyond || done > all; }});
  if (is_beyond) return Outcome::failed("the checker of cells tells of more than all");
  if (!verdict.accepted) return Outcome::failed("cells that fill the box are refused: " + verdict.why);

  for (std::size_t k = 0; k < 4; ++k) {
    std::vector<Cell_of_level> said = truth;
    Polygon_soup soup = posed.soup;
    const std::size_t place = random.below(said.size());
    Cell_of_level& cell = said[place];
    const std::size_t way = random.below(8);
    if (way == 7 && random.chance(1, 3)) cell.open_walls = {cell.walls.size() + random.below(2)};
    else if (way == 7) tell_nonsense(cell.walls, random);
    if (way == 0) {  // a hole, unless what is left is a smaller box
      said.erase(said.begin() + static_cast<std::ptrdiff_t>(place));
      if (said.empty() || box_about_cells(said) != box_about_cells(truth)) continue;
    }
    if (way == 1) said.push_back(cell);  // twice
    if (way == 2) {                      // the whole box once more
      if (said.size() == 1) continue;
      const auto [low, high] = exact_box(level.points());
      said.push_back({said.size(), generate::box(low, high), false, {}});
    }
    if (way == 3) {  // a face beyond it
      const Exact_point high = exact_box(level.points())[1];
      Points triangle{high, high, high};
      for (std::size_t i = 0; i < 3; ++i) triangle[i][i] += 1;
      soup.add_face(generate::added(soup, triangle));
    }
    if (way == 4) {  // a room left out
      const std::vector<std::uint32_t>& walls = level.cells()[place].walls;
      const bool has_way =
          std::any_of(walls.begin(), walls.end(), [&](std::uint32_t w) { return !level.walls()[w].open.empty(); });
      if (!cell.has_certificate || !has_way) continue;
      cell.has_certificate = false;
      cell.sources.clear();
    }
    if (way == 5) {  // a cell elsewhere, as large as it was; or a wall otherwise than its cell beyond has it
      const Exact_point step{generate::integer(random, 1, 9), generate::integer(random, -9, 9),
                             generate::integer(random, -9, 9)};
      const std::vector<std::uint32_t>& walls = level.cells()[place].walls;
      const std::size_t w = random.below(walls.size());
      if (level.cells()[place].is_outside && level.walls()[walls[w]].behind == no_cell) continue;
      if (level.cells()[place].is_outside) {
        Points& wall = cell.walls[w];
        wall.push_back(generate::centroid({wall.front(), wall.back()}));
      } else {
        for (Points& wall : cell.walls)
          for (Exact_point& corner : wall) corner = generate::along(corner, generate::ratio(1, 1 << 20), step);
        cell.sources.clear();
        if (box_about_cells(said) != box_about_cells(truth)) continue;
      }
    }
    if (way == 6) {  // a room left out, to which a wall that nobody looks through is open
      const std::vector<std::uint32_t>& walls = level.cells()[place].walls;
      const std::size_t w = random.below(walls.size());
      const Cell_wall& wall = level.walls()[walls[w]];
      if (!cell.has_certificate || wall.open.empty() || wall.behind == no_cell) continue;
      for (Cell_of_level& any : said) any.sources.clear();
      cell.open_walls = {w};
      said[wall.front == place ? wall.behind : wall.front].has_certificate = false;
    }
    if (const Verdict lie = verify_level_fill(soup, said); lie.accepted)
      return Outcome::failed("cells that do not fill the box, or leave out a room, are accepted: " + lie.why);
  }
  return {};
}

}  // namespace

Outcome certificates(const Posed_scene& posed, Random& random) {
  const Level_cells level(posed.soup);
  if (level.scene().pieces().empty()) return Outcome::not_applicable();
  for (std::size_t k = 0; k < 3; ++k)
    if (const Outcome outcome =
            of_a_cell(posed, level, static_cast<Cell_id>(random.below(level.cells().size())), random);
        outcome.state != Outcome::State::passed)
      return outcome;
  return of_all(posed, level, random);
}

}  // namespace sightline::harness::levels_subject
