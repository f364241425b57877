// What cells see, against the same question to the cell as a solid that looks, and against random sightlines.

#include "support.h"

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/algorithms/levels/pvs.h>
#include <sightline/algorithms/levels/ways.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <stdexcept>

namespace sightline {
namespace {

using levels_test::corpus_scene;
using levels_test::expect_passed;

TEST(Pvs, of_scenes_is_what_each_cell_sees_by_itself) {
  const std::size_t share = test_scenes::is_sanitized() ? 4 : 1;
  for (const char* file : {"general/two_rooms.map", "general/two_rooms.off", "general/cube.off", "general/l_room.off",
                           "general/crossing_quads.obj", "general/cornell.obj", "robust/duplicates.off",
                           "robust/thirds.qoff", "robust/t_junctions.off"}) {
    SCOPED_TRACE(file);
    const Polygon_soup soup = corpus_scene(file);
    for (std::uint64_t seed = 1; seed <= 4 / share; ++seed)
      for (const char* check : {"sightlines", "alone", "segments", "pairs"}) expect_passed(check, soup, seed);
  }
}

TEST(Pvs, is_the_same_on_any_number_of_threads_and_in_shards) {
  const Level_cells level(corpus_scene("general/two_rooms.map"));
  Pvs_options options;
  options.threads = 1;
  const Pvs one = potentially_visible(level, options);
  options.threads = 3;
  EXPECT_EQ(potentially_visible(level, options).visible, one.visible);
  std::vector<std::vector<Face_id>> merged(level.cells().size());
  std::size_t pairs = 0;
  const Pvs_search search(level, options);
  for (std::uint32_t shard = 0; shard < 4; ++shard) {
    const Pvs part = search.ask(shard, 4);
    pairs += part.counters.pairs;
    for (Cell_id c = 0; c < merged.size(); ++c)
      merged[c].insert(merged[c].end(), part.visible[c].begin(), part.visible[c].end());
  }
  for (std::vector<Face_id>& faces : merged) std::sort(faces.begin(), faces.end());
  EXPECT_EQ(merged, one.visible);
  EXPECT_EQ(pairs, one.counters.pairs);
}

TEST(Cell_pvs, is_the_same_on_any_number_of_threads_and_in_shards) {
  const Level_cells level(corpus_scene("general/two_rooms.map"));
  Pvs_options options;
  options.threads = 1;
  const Cell_pvs one = mutually_visible_cells(level, options);
  EXPECT_EQ(one.counters.pairs, one.counters.cells * (one.counters.cells - 1) / 2);
  EXPECT_EQ(one.counters.undecided, 0u);
  EXPECT_GT(one.counters.visible, one.counters.adjacent);
  EXPECT_LT(one.counters.visible, one.counters.pairs);
  options.threads = 3;
  EXPECT_EQ(mutually_visible_cells(level, options).visible, one.visible);
  Cell_pvs_search together(level, options);
  for (const bool alone : {false, true}) {  // parts that tell each other what they found, and parts that do not
    std::vector<std::vector<Cell_id>> merged(level.cells().size());
    std::size_t pairs = 0;
    for (std::uint32_t shard = 4; shard-- > 0;) {
      const Cell_pvs part = alone ? Cell_pvs_search(level, options).ask(shard, 4) : together.ask(shard, 4);
      pairs += part.counters.pairs;
      for (Cell_id c = 0; c < merged.size(); ++c)
        merged[c].insert(merged[c].end(), part.visible[c].begin(), part.visible[c].end());
    }
    for (std::vector<Cell_id>& cells : merged) std::sort(cells.begin(), cells.end());
    EXPECT_EQ(merged, one.visible);
    EXPECT_EQ(pairs, one.counters.pairs);
  }
}

TEST(Cell_pvs, is_the_same_after_an_exception_in_the_middle) {
  const Level_cells level(corpus_scene("general/two_rooms.map"));
  Pvs_options options;
  options.threads = 1;
  const Cell_pvs one = mutually_visible_cells(level, options);
  std::size_t calls = 0, throws_at = 0;
  options.progress = [&](std::size_t, std::size_t) {
    if (++calls == throws_at) throw std::runtime_error("enough");
  };
  Cell_pvs_search search(level, options);
  for (throws_at = 1; throws_at <= 4; ++throws_at) {
    calls = 0;
    EXPECT_THROW(search.ask(0, 1), std::runtime_error);
  }
  throws_at = 0;
  const Cell_pvs again = search.ask(0, 1);
  EXPECT_EQ(again.visible, one.visible);
  EXPECT_EQ(again.counters.visible, one.counters.visible);
}

TEST(Cell_pvs, has_sightlines_from_cell_to_cell_whose_ends_are_in_them) {
  const Level_cells level(corpus_scene("general/two_rooms.map"));
  const Cell_pvs pvs = mutually_visible_cells(level);
  EXPECT_GT(pvs.counters.by_lines, 0u);  // most of what is visible is found without a search
  const Cell_pvs_search search(level);
  std::size_t asked = 0;
  for (Cell_id from = 0; from < level.cells().size(); ++from)
    for (const Cell_id to : pvs.visible[from]) {
      const auto ends = search.sightline(from, to);
      ASSERT_TRUE(ends);
      EXPECT_EQ(level.at((*ends)[0]), from);  // also where a neighbour is thinner than the way to it is long
      EXPECT_EQ(level.at((*ends)[1]), to);
      ++asked;
    }
  EXPECT_EQ(asked, 2 * pvs.counters.visible);
}

TEST(Pvs, that_a_search_does_not_decide_is_decided_by_events) {
  const Level_cells level(corpus_scene("general/two_rooms.map"));
  Pvs_options options;
  options.search.cells = 1;
  options.search.rays = 0;
  const Pvs pvs = potentially_visible(level, options);
  EXPECT_GT(pvs.counters.by_events, 0u);
  EXPECT_EQ(pvs.counters.undecided, 0u);
  EXPECT_EQ(pvs.visible, potentially_visible(level).visible);
  const Cell_pvs cells = mutually_visible_cells(level, options);
  EXPECT_GT(cells.counters.by_events, 0u);
  EXPECT_EQ(cells.visible, mutually_visible_cells(level).visible);
}

TEST(Cell_pvs, has_sightlines_that_end_before_walls_which_a_step_reaches) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
    expect_passed("pairs", corpus_scene("robust/sightline_onto_wall.qoff"), seed);
}

TEST(Cell_pvs, out_of_time_is_undecided) {
  const Level_cells level(corpus_scene("general/two_rooms.map"));
  Pvs_options options;
  std::atomic<bool> is_over = true;
  std::atomic<std::size_t> asked = 0;
  options.search.out_of_time = [&] {
    ++asked;
    return is_over.load();
  };
  Cell_pvs_search search(level, options);
  const Cell_pvs pvs = search.ask(0, 1), whole = mutually_visible_cells(level);
  EXPECT_GT(pvs.counters.undecided, 0u);
  EXPECT_LE(asked, 2 * pvs.counters.cells) << "it goes on although time is over";
  for (Cell_id c = 0; c < level.cells().size(); ++c)
    for (const Cell_id other : whole.visible[c])
      EXPECT_TRUE(std::binary_search(pvs.visible[c].begin(), pvs.visible[c].end(), other) ||
                  std::binary_search(pvs.undecided[c].begin(), pvs.undecided[c].end(), other));
  is_over = false;
  const Cell_pvs again = search.ask(0, 1);
  EXPECT_EQ(again.counters.undecided, 0u) << "what was given up counts as done";
  EXPECT_EQ(again.visible, whole.visible);
}

TEST(Cell_pvs, is_asked_again_wherever_time_ran_out) {
  const Level_cells level(corpus_scene("general/two_rooms.map"));
  const Cell_pvs whole = mutually_visible_cells(level);
  Pvs_options options;
  options.threads = 1;
  constexpr std::size_t never = std::numeric_limits<std::size_t>::max();
  std::size_t left = never;
  options.search.out_of_time = [&] { return left == 0 || --left == 0; };
  mutually_visible_cells(level, options);
  const std::size_t all = never - left;
  for (std::size_t after = 2 * all / 3; after <= all; ++after) {  // late: in some cell's last search
    left = after;
    Cell_pvs_search search(level, options);
    search.ask(0, 1);
    left = never;
    const Cell_pvs again = search.ask(0, 1);
    ASSERT_EQ(again.counters.undecided, 0u) << "time ran out when it was asked for the " << after << "th time";
    ASSERT_EQ(again.visible, whole.visible);
  }
}

TEST(Pvs, of_rooms_leaves_out_what_has_a_way_out) {
  const Level_cells level(corpus_scene("general/two_rooms.map"));
  const Pvs rooms = potentially_visible(level);
  Pvs_options options;
  options.outside = true;
  const Pvs all = potentially_visible(level, options);
  std::size_t asked = 0;
  for (Cell_id c = 0; c < level.cells().size(); ++c) {
    EXPECT_EQ(all.is_asked[c] != 0, !level.cells()[c].is_solid);
    if (rooms.is_asked[c] == 0) continue;
    ++asked;
    EXPECT_FALSE(level.cells()[c].is_outside);
    EXPECT_EQ(rooms.visible[c], all.visible[c]);
  }
  EXPECT_EQ(asked, rooms.counters.cells);
  EXPECT_GT(all.counters.cells, rooms.counters.cells);
  // From a corner of the first room, past the jamb of the door, the far wall of the second is seen, its near one is
  // not.
  const Cell_id corner = level.at({1, 1, 1});
  ASSERT_NE(rooms.is_asked[corner], 0);
}

TEST(Pvs, out_of_time_is_undecided) {
  const Level_cells level(corpus_scene("general/two_rooms.map"));
  Pvs_options options;
  std::atomic<std::size_t> asked = 0;
  options.search.out_of_time = [&] {
    ++asked;
    return true;
  };
  const Pvs pvs = potentially_visible(level, options);
  EXPECT_EQ(asked, 1u) << "it goes on although time is over";
  const Pvs whole = potentially_visible(level);
  EXPECT_GT(pvs.counters.undecided, 0u);
  for (Cell_id c = 0; c < level.cells().size(); ++c)
    for (const Face_id face : whole.visible[c])
      EXPECT_TRUE(std::binary_search(pvs.visible[c].begin(), pvs.visible[c].end(), face) ||
                  std::binary_search(pvs.undecided[c].begin(), pvs.undecided[c].end(), face));
}

TEST(Pvs, ways_that_there_was_no_time_for_hide_nothing) {
  const Level_cells level(corpus_scene("general/two_rooms.map"));
  const Pvs whole = potentially_visible(level);
  Pvs_options options;
  for (const std::size_t last : {1u, 2u, 5u}) {
    std::atomic<std::size_t> asked = 0;
    options.search.out_of_time = [&] { return ++asked == last; };  // a clock that goes back: searches have time
    const Pvs pvs = potentially_visible(level, options);
    EXPECT_EQ(pvs.counters.searched, 0u);
    for (Cell_id c = 0; c < level.cells().size(); ++c)
      for (const Face_id face : whole.visible[c])
        EXPECT_TRUE(std::binary_search(pvs.visible[c].begin(), pvs.visible[c].end(), face) ||
                    std::binary_search(pvs.undecided[c].begin(), pvs.undecided[c].end(), face));
  }
}

/// Two squares that see each other past a wall, and no time to find that.
TEST(Pvs, what_events_have_no_time_for_is_not_hidden) {
  Polygon_soup soup;
  for (const long z : {0, 2, 1})
    for (const auto& [x, y] : {std::pair(0, 0), {2, 0}, {2, 2}, {0, 2}}) soup.add_point(z == 1 ? 2 * x - 2 : x, y, z);
  soup.add_face({0, 1, 2, 3});
  soup.add_face({7, 6, 5, 4});
  soup.add_face({8, 9, 10, 11});
  const Scene scene(soup);
  const Occluders occluders(scene);
  const Weak_source source = weak_source(occluders, {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  Pvs_options options;
  EXPECT_NE(levels_detail::visible_at_any_cost(occluders, source, 1, options).status, Weak_status::undecided);
  options.search.out_of_time = [] { return true; };
  EXPECT_EQ(levels_detail::visible_at_any_cost(occluders, source, 1, options).status, Weak_status::undecided);
}

}  // namespace
}  // namespace sightline
