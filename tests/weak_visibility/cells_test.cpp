// Proofs that a cell holds no line, asked for directly: there is none where a line is, however little room it has.
// SIGHTLINE_LONG: so many times the scenes, for a long run.

#include "scenes.h"
#include "../fuzz/cell_proofs.h"
#include "../sample.h"

#include <sightline/algorithms/weak_visibility/search/cell_proofs.h>
#include <sightline/algorithms/weak_visibility/search/likely_blockers.h>
#include <sightline/algorithms/weak_visibility/search/touching_lines.h>
#include <sightline/algorithms/weak_visibility/weak.h>

#include <gtest/gtest.h>

namespace weak_cells {
namespace {

using namespace sightline;
using weak_scenes::Random;
using weak_scenes::Weak_scene;

TEST(Cell_proofs_of_cells_with_a_line, do_not_exist) {
  std::size_t asked = 0, exact = 0, forms = 0;
  for (const weak_scenes::Family& family : weak_scenes::families())
    for (std::uint64_t seed = 0; seed < weak_scenes::seeds(test_scenes::is_sanitized() ? 2 : 6); ++seed) {
      const Weak_scene scene = family.make(seed);
      const Scene read(scene.soup);
      const Occluders occluders(read);
      Random random(seed);
      const Weak_source source = weak_source(occluders, scene.source);
      for (const Face_id face : scene.targets) {
        const auto piece =
            std::find_if(read.pieces().begin(), read.pieces().end(), [&](const Piece& p) { return p.face == face; });
        fuzz::Cells_of_lines cells(occluders, source, static_cast<std::uint32_t>(piece - read.pieces().begin()));
        for (int k = 0; k < 12; ++k) EXPECT_NO_THROW(cells.try_with_a_line(random)) << scene.name << ", face " << face;
        asked += cells.asked;
        exact += cells.counters.exact_programs;
        forms += cells.counters.form_programs;
      }
    }
  EXPECT_GT(asked, test_scenes::least(1000u));
  EXPECT_GT(exact, test_scenes::least(1000u));
  EXPECT_GT(forms, test_scenes::least(1000u));
}

TEST(Cell_proofs_of_cells_without_a_line, hold_where_their_sum_is_zero_for_some_pairs_of_corners) {
  using weak_scenes::at;
  // Lines from x = p >= 0 to x = q pass x = 0 at half the height where p + q > 0, and at a quarter where 3 p + q > 0:
  // none passes the first one to the right and the second one to the left.
  const auto plate = [](const Rational& z) { return weak_scenes::Points{at(0, -9, z), at(0, 9, z), at(9, 0, z)}; };
  const Scene scene(weak_scenes::soup_of(
      {weak_scenes::reversed(weak_scenes::rectangle(-1, 1, -1, 1, 1)), plate(Rational(1, 2)), plate(Rational(1, 4))}));
  const Occluders occluders(scene);
  const Weak_source source = weak_source(occluders, weak_scenes::rectangle(0, 1, -1, 1, 0));
  Edge_lines lines(occluders);
  Cell_proofs proofs(occluders, lines, source.plane, occluders.plane(0));
  const std::array<std::uint32_t, 2> edges{lines.of(1)[0].line, lines.of(2)[0].line};
  Line_domain domain(std::make_shared<const Near_polygon>(source.polygon),
                     std::make_shared<const Near_polygon>(occluders.polygon(0)));
  const Exact_pluecker right = pluecker_of_pair(occluders.located({Rational(1, 2), 0, 0}).exact,
                                                occluders.located({Rational(1, 2), 0, 1}).exact);
  Line_cell cell{&domain, &lines, &occluders.frame(), {}};
  for (std::size_t k = 0; k < 2; ++k) {
    const Side_row& row = domain.row(lines, edges[k], occluders.frame());
    ASSERT_EQ(row.decided, 0);
    cell.rows.push_back({k, {edges[k], (k == 0 ? 1 : -1) * sgn(dot(right, lines[edges[k]].exact()))}, &row});
  }
  Weak_counters counters;
  std::vector<Multiplier> by_basis, by_game;
  proofs.relax(cell, counters);
  EXPECT_EQ(proofs.by_relaxation(cell, by_basis, counters), Cell_proofs::Relaxation::empty);
  EXPECT_TRUE(proofs.by_exact_relaxation(cell, by_game, counters));
  EXPECT_EQ(by_basis.size(), 2u);
  EXPECT_EQ(by_game.size(), 2u);
}

/// Plates on rulings (x, c x, c) of the regulus y = z x, and one that is tangent to it on the axis x = y = 0, which is
/// on all of them: the one line that meets the four, twice.
class Tangent_plates {
 public:
  Tangent_plates() : lines_(occluders_), source_(weak_source(occluders_, weak_scenes::rectangle(-1, 1, -1, 1, 0))) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t line = lines_.of(static_cast<std::uint32_t>(k + 1))[0].line;
      const Side_row& row = domain_.row(lines_, line, occluders_.frame());
      EXPECT_EQ(row.decided, 0);
      cell.rows.push_back({k, {line, 1}, &row});
    }
  }
  std::array<Integer, 4> on_axis(long z) const { return occluders_.located(weak_scenes::at(0, 0, z)).exact; }
  const Near_plane& target_plane() const { return occluders_.plane(0); }
  const Near_plane& source_plane() const { return source_.plane; }

 private:
  static weak_scenes::Points plate(const Rational& c, const Rational& rise) {
    using weak_scenes::at;
    return {at(-2, Rational(-2 * c), Rational(c - rise)), at(2, Rational(2 * c), Rational(c + rise)), at(0, 6, c)};
  }
  const Scene scene_{weak_scenes::soup_of({weak_scenes::reversed(weak_scenes::rectangle(-1, 1, -1, 1, 1)),
                                           plate(Rational(1, 4), 0), plate(Rational(1, 2), 0), plate(Rational(3, 4), 0),
                                           plate(Rational(3, 5), Rational(1, 100))})};
  const Occluders occluders_{scene_};
  Edge_lines lines_;
  const Weak_source source_;
  Line_domain domain_{std::make_shared<const Near_polygon>(source_.polygon),
                      std::make_shared<const Near_polygon>(occluders_.polygon(0))};

 public:
  Line_cell cell{&domain_, &lines_, &occluders_.frame(), {}};
};

TEST(Touching_lines, are_where_a_four_edge_determinant_has_a_double_root) {
  Tangent_plates plates;
  std::size_t strict = 0;
  // Whatever the signs, it is in the cell's closure; and no sector plane leaves it out.
  for (unsigned signs = 0; signs < 16; ++signs) {
    for (std::size_t k = 0; k < 4; ++k) plates.cell.rows[k].literal.sign = (signs >> k & 1u) != 0 ? 1 : -1;
    const std::vector<Touching_line> lines = touching_lines(plates.cell, plates.source_plane(), plates.target_plane());
    const auto axis = std::find_if(lines.begin(), lines.end(), [&](const Touching_line& line) {
      return line.from == plates.on_axis(0) && line.to == plates.on_axis(1);
    });
    ASSERT_NE(axis, lines.end()) << signs;
    EXPECT_EQ(axis->met.size(), 4u);
    // Every one of them is a line of the closure: sides by the pair itself, corners of four bounds at least.
    for (const Touching_line& line : lines) {
      const Exact_pluecker pair = pluecker_of_pair(line.from, line.to);
      EXPECT_GE(line.met.size(), 4u);
      for (const Exact_pluecker& met : line.met) EXPECT_EQ(dot(pair, met), 0);
      for (const Line_cell::Row& row : plates.cell.rows) {
        const int side = row.literal.sign * sgn(dot(pair, (*plates.cell.lines)[row.literal.line].exact()));
        EXPECT_GE(side, 0);
        strict += side > 0;
      }
    }
  }
  EXPECT_GT(strict, 0u);
}

TEST(Sector_planes, hold_a_touching_line_and_cut_a_polygon) {
  Tangent_plates plates;
  const auto cut = sector_plane(plates.cell, plates.source_plane(), plates.target_plane());
  ASSERT_TRUE(cut);
  EXPECT_TRUE(is_across(cut->plane, cut->source ? plates.cell.domain->source : plates.cell.domain->target));
  const std::vector<Touching_line> lines = touching_lines(plates.cell, plates.source_plane(), plates.target_plane());
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&](const Touching_line& line) {
    return value(cut->plane, {line.from, {}}) == 0 && value(cut->plane, {line.to, {}}) == 0;
  }));
}

TEST(Likely_blockers, are_found_for_all_that_is_behind_a_wall_and_for_nothing_beside_it) {
  using weak_scenes::rectangle;
  using weak_scenes::reversed;
  // A wall at z = 2, and squares at z = 3 behind it and beside it, that look down.
  std::vector<std::vector<Exact_point>> faces{reversed(rectangle(-9, 9, -9, 9, 2))};
  const auto in_shadow = [](int x, int y) { return std::abs(x) < 9 && std::abs(y) < 9; };
  for (int x = -12; x < 12; ++x)
    for (int y = -12; y < 12; ++y) faces.push_back(reversed(rectangle(x, x + 1, y, y + 1, 3)));
  const Scene scene(weak_scenes::soup_of(faces));
  const Occluders occluders(scene);
  const Weak_source source = weak_source(occluders, rectangle(-1, 1, -1, 1, 0));
  const std::vector<std::uint32_t> likely = likely_blockers(occluders, source);
  std::size_t found = 0;
  for (std::uint32_t k = 1; k < likely.size(); ++k) {
    const int x = static_cast<int>(k - 1) / 24 - 12, y = static_cast<int>(k - 1) % 24 - 12;
    const Near_polygon target = occluders.polygon(k);
    if (likely[k] == no_blocker) {
      found += in_shadow(x, y) && in_shadow(x + 1, y + 1) ? 0 : 1;
      continue;
    }
    EXPECT_EQ(likely[k], 0u);
    EXPECT_TRUE(occluders.blocks_all(0, source.polygon, target, pairs_of(source.polygon, target))) << x << ' ' << y;
    ++found;
  }
  EXPECT_GT(found, 23u * 24);  // all but those in boxes that are in shadow in part
  const std::size_t with =
      static_cast<std::size_t>(likely.size() - std::count(likely.begin(), likely.end(), no_blocker));
  EXPECT_GT(with, 200u);
  EXPECT_EQ(likely[0], no_blocker);
  // When time runs out there are fewer.
  std::size_t asked = 0;
  const std::vector<std::uint32_t> fewer = likely_blockers(occluders, source, [&] { return ++asked > 9; });
  const std::size_t left = static_cast<std::size_t>(fewer.size() - std::count(fewer.begin(), fewer.end(), no_blocker));
  EXPECT_LT(left, with);
  EXPECT_EQ(asked, 10u);
  EXPECT_EQ(likely_blockers(occluders, source, [] { return false; }), likely);
  // What looks away needs none.
  Weak_source away = weak_source(occluders, reversed(rectangle(-1, 1, -1, 1, 0)));
  const std::vector<std::uint32_t> none = likely_blockers(occluders, away);
  EXPECT_EQ(std::count(none.begin(), none.end(), no_blocker), static_cast<std::ptrdiff_t>(none.size()));
}

TEST(One_piece, blocks_all_up_to_the_edge_of_its_shadow_and_no_further) {
  using weak_scenes::rectangle;
  using weak_scenes::reversed;
  // From [-1, 1] at z = 0 over the edges of [-3, 3] at z = 2 lines reach z = 4 within [-5, 5].
  const Rational little = Rational(1, 1024) / (Integer(1) << 60);
  for (const Rational& more : {Rational(0), little, Rational(-little)}) {
    const Scene scene(weak_scenes::soup_of(
        {reversed(rectangle(-3, 3, -3, 3, 2)), reversed(rectangle(-5, Rational(5 + more), -5, 5, 4))}));
    const Occluders occluders(scene);
    const Weak_source source = weak_source(occluders, rectangle(-1, 1, -1, 1, 0));
    const Near_polygon target = occluders.polygon(1);
    const std::vector<Pluecker> pairs = pairs_of(source.polygon, target);
    EXPECT_EQ(occluders.blocks_all(0, source.polygon, target, pairs), more <= 0);
    EXPECT_FALSE(occluders.blocks_all(1, source.polygon, target, pairs));  // it is not between
    const Weakly_visible found = weakly_visible(occluders, {source});
    EXPECT_EQ(found.visible.size(), more <= 0 ? 1u : 2u);
    EXPECT_EQ(found.counters.by_one, more <= 0 ? 1u : 0u);
  }
}

TEST(One_piece, of_so_many_corners_that_several_boxes_hold_it_blocks_all_too) {
  using weak_scenes::at;
  using weak_scenes::rectangle;
  // Along a parabola.
  std::vector<Exact_point> arc;
  for (int x = -60; x <= 60; ++x) arc.push_back(at(x, x * x, 2));
  const Scene scene(
      weak_scenes::soup_of({weak_scenes::reversed(arc), weak_scenes::reversed(rectangle(-50, 50, 2900, 3500, 4))}));
  const Occluders occluders(scene);
  ASSERT_GT(occluders.boxes().chunks().size(), scene.pieces().size());
  const Weakly_visible found = weakly_visible(occluders, {weak_source(occluders, rectangle(-50, 50, 2900, 3500, 0))});
  EXPECT_EQ(found.visible.size(), 1u);
  EXPECT_EQ(found.counters.by_one, 1u);
}

TEST(One_piece, before_too_many_pairs_of_corners_is_not_looked_for_nor_are_proofs) {
  using weak_scenes::at;
  using weak_scenes::reversed;
  const auto on_parabola = [](long z) {
    std::vector<Exact_point> arc;
    for (int x = 0; x <= 3200; ++x) arc.push_back(at(x, x * x, z));
    return arc;
  };
  const auto seen = [&](const std::vector<std::vector<Exact_point>>& faces) {
    const Scene scene(weak_scenes::soup_of(faces));
    const Occluders occluders(scene);
    return weakly_visible(occluders, {weak_source(occluders, on_parabola(0))});
  };
  const std::vector<Exact_point> target = reversed(on_parabola(9)),
                                 between = weak_scenes::rectangle(-1, 3300, -1, 20000000, 1);
  EXPECT_EQ(seen({target}).visible, std::vector<Face_id>{0});
  EXPECT_EQ(seen({target, between}).undecided, std::vector<Face_id>{0});
}

TEST(Small_sides, are_those_of_big_integers_up_to_forty_bits_and_in_planes) {
  using weak_scenes::at;
  const Integer most = (Integer(1) << 40) - 1;
  Random random(17);
  std::size_t zeros = 0;
  for (int round = 0; round < 200; ++round) {
    const bool is_large = round % 2 == 0;
    const auto coordinate = [&] {
      const Integer any = is_large && random.chance(1, 2) ? most : Integer(static_cast<unsigned long>(random.below(4)));
      return random.chance(1, 2) ? any : Integer(-any);
    };
    const auto corner = [&] { return at(coordinate(), coordinate(), coordinate()); };
    // One is kept at the bound, so that the grid has its 40 bits; the triangles need not have an area to be looked at.
    const Scene scene(
        weak_scenes::soup_of({{at(most, 0, 0), at(0, most, 0), at(0, 0, most)}, {corner(), corner(), corner()}}));
    if (scene.pieces().size() < 2) continue;
    const Occluders occluders(scene);
    const auto point = [&](const Integer& w) {
      return near_point(occluders.frame(), {coordinate(), coordinate(), coordinate(), w});
    };
    const std::array<std::uint32_t, 2> edge = occluders.edge_points(1, 0);
    const Near_point p = point(1), q = random.chance(1, 4) ? occluders.polygon(1)[0] : point(1);
    const int exact = sgn(dot(pluecker_of_pair(p.exact, q.exact), occluders.exact_pluecker_of(edge)));
    EXPECT_EQ(occluders.small_side(p, q, edge), exact);
    zeros += exact == 0;
    // Beyond the bound, or between the integers, nothing is said.
    Near_point beyond = p, between = p;
    beyond.exact[2] = -2 * most;
    between.exact[3] = 2;
    EXPECT_EQ(occluders.small_side(p, beyond, edge), std::nullopt);
    EXPECT_EQ(occluders.small_side(between, q, edge), std::nullopt);
  }
  EXPECT_GT(zeros, 5u);
}

TEST(Occluders_of_a_line, are_faces_that_its_end_is_on_and_not_those_whose_plane_it_is_in_beside_them) {
  using weak_scenes::at;
  // A triangle in the plane x = 0, where z <= y.
  const Scene scene(weak_scenes::soup_of(
      {weak_scenes::reversed(weak_scenes::rectangle(-1, 1, -1, 1, 2)), {at(0, -5, -5), at(0, 5, -5), at(0, 5, 5)}}));
  const Occluders occluders(scene);
  const Weak_source source = weak_source(occluders, weak_scenes::rectangle(-1, 1, -1, 1, 0));
  const auto point = [&](const Rational& x, const Rational& y, const Rational& z) {
    return occluders.located({x, y, z});
  };
  const Rational half(1, 2);
  const auto blocker = [&](const Rational& y, const Rational& x) {
    return occluders.blocker(point(0, y, 0), point(x, y, 2), source.plane, occluders.plane(0));
  };
  EXPECT_FALSE(blocker(-half, half));
  EXPECT_FALSE(blocker(-half, Rational(-half)));
  EXPECT_EQ(blocker(half, half), 1u);
  EXPECT_EQ(blocker(half, Rational(-half)), 1u);
  EXPECT_EQ(blocker(0, half), 1u);   // on its edge
  EXPECT_EQ(blocker(-half, 0), 1u);  // within its plane: not looked at further
}

}  // namespace
}  // namespace weak_cells
