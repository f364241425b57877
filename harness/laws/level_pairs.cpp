#include <sightline/harness/laws/level_pairs.h>

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/levels/pvs.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/level_checks.h>
#include <sightline/harness/laws/trace.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace levels_subject {

using generate::Points;

bool are_in_list(const std::vector<std::vector<Cell_id>>& lists, Cell_id a, Cell_id b) {
  return std::binary_search(lists[a].begin(), lists[a].end(), b);
}

/// Cells between which a random segment meets no face see each other; and all of that is symmetric.
Outcome segments(const Posed_scene& posed, const Answer&, Random& random) {
  const Level_cells level(posed.soup);
  const Cell_pvs pvs = mutually_visible_cells(level, options_of(random));
  const std::vector<Flat_face> flats = flat_faces_of(level.scene());
  for (std::size_t k = 0; k < 80; ++k) {
    const Cell_id a = static_cast<Cell_id>(random.below(level.cells().size())),
                  b = static_cast<Cell_id>(random.below(level.cells().size()));
    if (a == b || pvs.is_asked[a] == 0 || pvs.is_asked[b] == 0) continue;
    const std::string pair = "cells " + std::to_string(a) + " and " + std::to_string(b);
    for (const auto* lists : {&pvs.visible, &pvs.undecided})
      if (are_in_list(*lists, a, b) != are_in_list(*lists, b, a)) return Outcome::failed(pair + " are not symmetric");
    if (are_in_list(pvs.visible, a, b) || are_in_list(pvs.undecided, a, b)) continue;
    const Exact_point p = any_point_of(level, a, random), way = minus(any_point_of(level, b, random), p);
    const bool free = std::none_of(flats.begin(), flats.end(), [&](const Flat_face& flat) {
      const std::optional<Rational> t = met_at(flat, p, way);
      return t && *t <= 1;
    });
    if (free) return Outcome::failed(pair + " see each other, but are said not to");
  }
  return {};
}

/// The same asked of two cells alone: the one's portals are put into the scene as faces that look outwards, since what
/// comes to the cell comes to one of them first; a certificate says whether the other's portals see any of them.
std::optional<bool> see_each_other(const Posed_scene& posed, const Level_cells& level, Cell_id from, Cell_id to,
                                   Verdict& verdict) {
  for (const std::uint32_t w : level.cells()[from].walls) {
    const Cell_wall& wall = level.walls()[w];
    if (!wall.open.empty() && (wall.front == to || wall.behind == to)) return true;
  }
  Polygon_soup soup = posed.soup;
  const Face_id first = static_cast<Face_id>(soup.face_count());
  for (const Points& portal : portals_of(level, to)) soup.add_face(generate::added(soup, portal));
  const std::vector<Points> portals = portals_of(level, from);
  if (portals.empty() || soup.face_count() == first) return false;
  const Scene scene(soup);
  const Occluders occluders(scene);
  Weak_options options;
  options.threads = 1;
  options.search.cells = most_undecided_cells;
  for (Face_id face = first; face < soup.face_count(); ++face) options.faces.push_back(face);
  std::vector<Weak_source> sources;
  for (const Points& portal : portals) sources.push_back(weak_source(occluders, portal));
  Weakly_visible found = weakly_visible(occluders, sources, options);
  if (!found.undecided.empty() && found.visible.empty()) return std::nullopt;
  const bool sees = !found.visible.empty();
  for (const Piece& piece : scene.pieces())  // of which nothing is claimed
    if (piece.face < first && (found.undecided.empty() || found.undecided.back() != piece.face))
      found.undecided.push_back(piece.face);
  std::sort(found.undecided.begin(), found.undecided.end());
  verdict = verify_weak(soup, weak_certificate(scene, portals, false, found), {1, {}});
  return sees;
}

bool is_free(const Polygon_soup& soup, const Level_cells& level, Cell_id a, Cell_id b,
             const std::array<Exact_point, 2>& line) {
  if (level.at(line[0]) != a || level.at(line[1]) != b || line[0] == line[1]) return false;
  const std::vector<Face_hit> hits =
      hits_by_definition(soup, level.scene(), {line[0], minus(line[1], line[0])}, Ray_start::closed);
  return std::none_of(hits.begin(), hits.end(), [](const Face_hit& hit) { return hit.t <= 1; });
}

/// That a leaf's row has the leaves of cells that may see one of its own, and itself.
std::string flaw_of_leaves(const Level_cells& level, const Cell_pvs& pvs) {
  std::uint32_t leaves = 0;
  for (const Level_cell& cell : level.cells()) leaves = std::max(leaves, static_cast<std::uint32_t>(cell.leaf) + 1);
  std::set<std::pair<std::size_t, std::size_t>> expected;
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) expected.emplace(leaf, leaf);
  for (Cell_id a = 0; a < level.cells().size(); ++a)
    for (Cell_id b = 0; b < level.cells().size(); ++b)
      if (are_in_list(pvs.visible, a, b) || are_in_list(pvs.undecided, a, b))
        expected.emplace(level.cells()[a].leaf, level.cells()[b].leaf);
  const std::vector<std::vector<bool>> rows = visible_leaves(level, pvs, leaves);
  for (std::size_t a = 0; a < leaves; ++a)
    for (std::size_t b = 0; b < leaves; ++b)
      if (rows[a][b] != (expected.count({a, b}) > 0))
        return "leaves " + std::to_string(a) + " and " + std::to_string(b) + " are not as their cells";
  return {};
}

/// That counters say what the table has.
std::string flaw_of_counters(const Cell_pvs& pvs) {
  const Cell_pvs_counters& c = pvs.counters;
  const auto cells = static_cast<std::size_t>(std::count(pvs.is_asked.begin(), pvs.is_asked.end(), 1));
  const auto pairs_in = [](const std::vector<std::vector<Cell_id>>& lists) {
    std::size_t both_ways = 0;
    for (const std::vector<Cell_id>& list : lists) both_ways += list.size();
    return both_ways / 2;
  };
  if (c.cells != cells || c.pairs != cells * (cells - 1) / 2) return "cells or pairs are miscounted";
  if (c.visible != pairs_in(pvs.visible) || c.undecided != pairs_in(pvs.undecided))
    return "pairs that see each other, or may, are miscounted";
  if (c.unreached > c.pairs - c.visible - c.undecided || c.hidden > c.searched)
    return "more is unreached or hidden than there is";
  // Floods at one time may see each other's cells.
  const std::size_t most = 2 * c.visible;
  if (c.adjacent > most || c.by_lines > most || c.extended > most || c.adjacent + c.by_lines + c.extended > most)
    return "more is seen than there is";
  return {};
}

/// A search that takes longer, for what a short one left undecided.
std::optional<std::array<Exact_point, 2>> sightline_in_time(const Level_cells& level, Pvs_options options, Cell_id from,
                                                            Cell_id to) {
  options.search.cells *= 20;
  return Cell_pvs_search(level, options).sightline(from, to);
}

Outcome pairs(const Posed_scene& posed, const Answer&, Random& random) {
  const Level_cells level(posed.soup);
  const Pvs_options options = options_of(random);
  Cell_pvs_search search(level, options);
  const Cell_pvs pvs = search.ask(0, 1);
  if (const std::string flaw = flaw_of_counters(pvs); !flaw.empty()) return Outcome::failed(flaw);
  if (const std::string flaw = flaw_of_leaves(level, pvs); !flaw.empty()) return Outcome::failed(flaw);
  if (const Cell_id any = static_cast<Cell_id>(random.below(level.cells().size())); search.sightline(any, any))
    return Outcome::failed("a cell has a sightline to itself");
  bool undecided = pvs.counters.undecided > 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const Cell_id a = static_cast<Cell_id>(random.below(level.cells().size())),
                  b = static_cast<Cell_id>(random.below(level.cells().size()));
    if (a == b || pvs.is_asked[a] == 0 || pvs.is_asked[b] == 0 || are_in_list(pvs.undecided, a, b)) continue;
    Verdict verdict{true, {}, {}};
    const std::optional<bool> sees = see_each_other(posed, level, a, b, verdict);
    undecided |= !sees;
    const std::string pair = "cells " + std::to_string(a) + " and " + std::to_string(b);
    if (!verdict.accepted) return Outcome::failed(pair + ": their certificate is rejected: " + verdict.why);
    if (sees && *sees != are_in_list(pvs.visible, a, b))
      return Outcome::failed(pair + (*sees ? " by themselves see each other" : " by themselves do not"));
    const std::optional<std::array<Exact_point, 2>> line = search.sightline(a, b);
    if (!line && are_in_list(pvs.visible, a, b)) {
      if (sees && !sightline_in_time(level, options, a, b))
        return Outcome::failed(pair + " see each other, but have no sightline");
      undecided = true;
    }
    if (line && !are_in_list(pvs.visible, a, b))
      return Outcome::failed(pair + " have a sightline, though they do not see each other");
    if (!line && have_a_way(level, a, b)) return Outcome::failed(pair + " have a way between them, but no sightline");
    if (line && !is_free(posed.soup, level, a, b, *line))
      return Outcome::failed(pair + ": a sightline is not from the one to the other, or meets a face");
  }
  return undecided ? Outcome::undecided() : Outcome{};
}

}  // namespace levels_subject

Check segments_check() {
  return {"segments", "cells that a random segment joins see each other", levels_subject::segments};
}

Check pairs_check() {
  return {"pairs", "two cells by themselves see each other as the table says, with a certificate",
          levels_subject::pairs};
}

}  // namespace sightline::harness
