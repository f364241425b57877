#include <sightline/harness/laws/level_hasty.h>

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/levels/pvs.h>
#include <sightline/harness/laws/level_checks.h>
#include <sightline/harness/laws/level_pairs.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sightline::harness {

namespace hasty_levels {

using Rows = std::vector<std::vector<std::uint32_t>>;

bool is_in(const std::vector<std::uint32_t>& row, std::uint32_t number) {
  return std::binary_search(row.begin(), row.end(), number);
}

/// By cell, what is decided in haste, against what is decided at leisure.
std::string flaw_of(const Rows& visible, const Rows& undecided, const Rows& all_visible, const Rows& all_undecided,
                    const std::string& what) {
  for (std::size_t cell = 0; cell < all_visible.size(); ++cell) {
    const std::string place = "cell " + std::to_string(cell) + " and " + what + ' ';
    for (const std::uint32_t seen : visible[cell]) {
      if (is_in(undecided[cell], seen)) return place + std::to_string(seen) + " are both seen and undecided";
      if (!is_in(all_visible[cell], seen) && !is_in(all_undecided[cell], seen))
        return place + std::to_string(seen) + " are seen in haste only";
    }
    for (const std::uint32_t seen : all_visible[cell])
      if (!is_in(visible[cell], seen) && !is_in(undecided[cell], seen))
        return place + std::to_string(seen) + " are hidden in haste";
  }
  return {};
}

/// Where something is undecided although nothing was spared.
std::string gap_in(const Rows& undecided, const std::string& what) {
  for (std::size_t cell = 0; cell < undecided.size(); ++cell)
    if (!undecided[cell].empty())
      return "cell " + std::to_string(cell) + " and " + what + ' ' + std::to_string(undecided[cell].front()) +
             " are undecided after all events";
  return {};
}

/// The union of two parts, row by row.
void add(Rows& rows, const Rows& more) {
  rows.resize(more.size());
  for (std::size_t i = 0; i < more.size(); ++i) {
    rows[i].insert(rows[i].end(), more[i].begin(), more[i].end());
    std::sort(rows[i].begin(), rows[i].end());
  }
}

Outcome run(const Posed_scene& posed, const Answer&, Random& random) {
  constexpr std::size_t most_faces = 12;
  if (posed.soup.face_count() > most_faces) return Outcome::not_applicable();
  const Level_cells level(posed.soup);
  const Pvs_options leisure = levels_subject::options_of(random);
  Pvs_options haste = leisure;
  haste.search.cells = 1 + random.below(6);
  haste.search.rays = static_cast<int>(random.below(3));
  constexpr std::size_t all_edges = 1000, forever = ~std::size_t{0};
  constexpr std::array<std::size_t, 3> event_edges{0, 10, all_edges};
  haste.event_edges = event_edges[random.below(posed.soup.face_count() <= most_faces / 2 ? 3 : 2)];
  std::size_t asked = 0;
  const std::size_t patience = random.chance(1, 2) ? forever : random.below(2000);
  const bool is_thorough = haste.event_edges == all_edges && patience == forever;  // events decide what is left
  haste.search.out_of_time = [&] { return ++asked > patience; };
  const auto parts = static_cast<std::uint32_t>(1 + random.below(3));

  // 1. Faces.
  Rows visible, undecided;
  for (std::uint32_t k = 0; k < parts; ++k) {
    const Pvs part = Pvs_search(level, haste).ask(k, parts);
    if (haste.event_edges == 0 && part.counters.by_events > 0)
      return Outcome::failed("events decide faces though none is to be asked");
    add(visible, part.visible);
    add(undecided, part.undecided);
  }
  const Pvs faces = potentially_visible(level, leisure);
  std::string flaw = flaw_of(visible, undecided, faces.visible, faces.undecided, "face");
  if (flaw.empty() && is_thorough) flaw = gap_in(undecided, "face");
  if (!flaw.empty()) return Outcome::failed(flaw);

  // 2. Cells, their parts asked of one object or of several.
  visible.clear();
  undecided.clear();
  Cell_pvs_search together(level, haste);
  const bool is_one = random.chance(1, 2);
  for (std::uint32_t k = 0; k < parts; ++k) {
    const Cell_pvs part = is_one ? together.ask(k, parts) : Cell_pvs_search(level, haste).ask(k, parts);
    add(visible, part.visible);
    add(undecided, part.undecided);
  }
  const Cell_pvs cells = mutually_visible_cells(level, leisure);
  flaw = flaw_of(visible, undecided, cells.visible, cells.undecided, "cell");
  if (flaw.empty() && is_thorough) flaw = gap_in(undecided, "cell");
  if (!flaw.empty()) return Outcome::failed(flaw);

  // 3. Sightlines of some pairs, of events too.
  if (patience != forever) return {};
  for (int k = 0; k < 3; ++k) {
    const Cell_id a = static_cast<Cell_id>(random.below(visible.size()));
    if (visible[a].empty()) continue;
    const Cell_id b = visible[a][random.below(visible[a].size())];
    const std::optional<std::array<Exact_point, 2>> line = together.sightline(a, b);
    if (line && !levels_subject::is_free(posed.soup, level, a, b, *line))
      return Outcome::failed("cells " + std::to_string(a) + " and " + std::to_string(b) +
                             ": a sightline is not from the one to the other, or meets a face");
  }
  return {};
}

}  // namespace hasty_levels

Check hasty_levels_check() {
  return {
      "hasty",
      "what little search decides is what more does, in parts and where time runs out too; with events it decides all",
      hasty_levels::run, 4};
}

}  // namespace sightline::harness
