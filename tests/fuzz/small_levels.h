#pragma once
// What levels of few faces in even boxes promise: boxes are even, and refused only where a scene has no extent; tables
// of leaves are those of cells; what had no time is decided when it is asked again; shortcuts are taken.

#include "soups.h"
#include "support.h"

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/levels/grid.h>
#include <sightline/algorithms/levels/pvs.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace fuzz {

/// The leaf that a point is in, by each plane on the way down. Pre: it is on none of them.
inline std::size_t leaf_of(const Space_tree& tree, const Exact_point& p) {
  std::int32_t at = tree.root;
  while (at >= 0) {
    const Space_tree::Node& node = tree.nodes[static_cast<std::size_t>(at)];
    Rational height = node.plane[3];
    for (std::size_t k = 0; k < 3; ++k) height += node.plane[k] * p[k];
    at = node.children[height > 0 ? 0 : 1];
  }
  return static_cast<std::size_t>(-1 - at);
}

/// A scene is divided along the axes along which it has an extent, and refused where it is to be along others; a point
/// is in the box that its shares of the extents say.
inline void try_even_boxes(generate::Random& random) {
  generate::Faces faces;
  for (std::uint64_t k = 1 + random.below(3); k > 0; --k)
    faces.push_back({generate::lattice(random, 4), generate::lattice(random, 4), generate::lattice(random, 4)});
  const std::size_t flat = random.below(4);  // an axis, or none
  std::array<std::uint32_t, 3> counts;
  Exact_point low = faces[0][0], high = low;
  for (std::size_t k = 0; k < 3; ++k) {
    counts[k] = static_cast<std::uint32_t>(1 + random.below(4));
    if (k == flat && random.chance(1, 2)) counts[k] = 1;
    for (generate::Points& face : faces)
      for (Exact_point& p : face) {
        if (k == flat) p[k] = low[k];
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
  }
  bool is_wrong = false;
  for (std::size_t k = 0; k < 3; ++k) is_wrong = is_wrong || (counts[k] > 1 && low[k] == high[k]);
  Space_tree tree;
  const bool refused = is_refused<std::invalid_argument>([&] { tree = even_boxes(generate::soup_of(faces), counts); });
  require(refused == is_wrong, "boxes are refused iff they are to divide what has no extent");
  if (refused) return;
  for (int turn = 0; turn < 8; ++turn) {
    std::array<std::size_t, 3> box{};
    Exact_point p = low;
    for (std::size_t k = 0; k < 3; ++k) {
      box[k] = random.below(counts[k]);
      const Rational share = generate::integer(random, 1, 8) / 9;  // within the box
      p[k] += (high[k] - low[k]) * (static_cast<long>(box[k]) + share) / static_cast<long>(counts[k]);
    }
    require(leaf_of(tree, p) == box[0] + counts[0] * (box[1] + counts[1] * box[2]), "boxes are even");
  }
}

/// Few faces in even boxes, so that there are several cells that see each other.
inline Level_cells any_small_level(generate::Random& random) {
  generate::Faces faces{generate::box({-4, -4, -4}, {4, 4, 4})[random.below(6)]};
  for (std::uint64_t k = random.below(3); k > 0; --k) {
    const generate::Points face = generate::any_face(random);
    if (spans_a_plane(face)) faces.push_back(face);
  }
  faces.push_back({{-4, -4, -4}, {4, 4, 4}, {4, -4, 4}});
  Cell_options options;
  const Polygon_soup soup = generate::soup_of(faces);
  options.tree = even_boxes(
      soup, {static_cast<std::uint32_t>(1 + random.below(3)), static_cast<std::uint32_t>(1 + random.below(3)), 1});
  return Level_cells(soup, options);
}

inline Pvs_options options_of_levels() {
  Pvs_options options;
  options.threads = 1;
  options.outside = true;
  options.search.cells = 3000;
  return options;
}

/// Leaves see each other iff cells of theirs do, or may; and themselves.
inline void try_leaves(const Level_cells& level, const Cell_pvs& pvs) {
  std::size_t leaves = 0;
  for (const Level_cell& cell : level.cells()) leaves = std::max<std::size_t>(leaves, cell.leaf + 1);
  const std::vector<std::vector<bool>> rows = visible_leaves(level, pvs, leaves);
  for (std::size_t a = 0; a < leaves; ++a)
    for (std::size_t b = 0; b < leaves; ++b) {
      bool expected = a == b;
      for (Cell_id c = 0; c < level.cells().size(); ++c)
        for (Cell_id d = 0; d < level.cells().size(); ++d) {
          if (level.cells()[c].leaf != a || level.cells()[d].leaf != b) continue;
          const auto is_in = [d](const std::vector<Cell_id>& list) {
            return std::find(list.begin(), list.end(), d) != list.end();
          };
          expected = expected || is_in(pvs.visible[c]) || is_in(pvs.undecided[c]);
        }
      require(rows[a][b] == expected, "leaves see each other iff their cells do");
    }
}

inline void try_small_levels(generate::Random& random) {
  constexpr std::size_t most_cells = 24, more_than_a_round = 10;
  const Level_cells level = any_small_level(random);
  if (level.cells().size() > most_cells) return;
  const Pvs_options options = options_of_levels();
  const Cell_pvs pvs = mutually_visible_cells(level, options);
  try_leaves(level, pvs);
  // Of a search that had no time to begin with, asked again once it has.
  bool is_late = true;
  Pvs_options late = options;
  late.search.out_of_time = [&] { return is_late; };
  Cell_pvs_search search(level, late);
  if (random.chance(1, 2)) search.ask(0, 1);
  is_late = false;
  const Cell_pvs again = search.ask(0, 1);
  require(again.visible == pvs.visible && again.undecided == pvs.undecided,
          "what had no time is decided when it is asked again");
  // What was found before is told.
  if (pvs.counters.undecided == 0 && pvs.counters.cells > more_than_a_round)
    require(pvs.counters.told > 0, "floods are told what earlier ones found");
  const Pvs_counters counters = potentially_visible(level, options).counters;
  require(counters.hidden + counters.visible + counters.undecided + counters.unreached >= counters.pairs,
          "a pair that is hidden was found so, or not reached");
}

/// Boxes about one small face: most see each other along lines at random.
inline void try_lines_in_a_level(generate::Random& random) {
  const Exact_point p = generate::lattice(random, 4);
  Exact_point q = p, r = p;
  q[0] += 3 * 64;
  r[1] += 3 * 64;
  r[2] += 1;
  const Polygon_soup soup = generate::soup_of({{p, q, r}});
  Cell_options cells;
  cells.tree = even_boxes(soup, {3, 3, 1});
  const Cell_pvs pvs = mutually_visible_cells(Level_cells(soup, cells), options_of_levels());
  require(pvs.counters.by_lines > 0, "cells see each other along random lines");
}

inline void small_levels(std::string_view bytes) {
  static constexpr std::array<void (*)(generate::Random&), 4> laws{try_even_boxes, try_small_levels, try_small_levels,
                                                                   try_lines_in_a_level};
  ask_one_of(laws, bytes);
}

}  // namespace fuzz
