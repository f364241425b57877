// Which vertices and lines are the same in space, against exact coordinates; where all residues are zero; edges that
// are made later; points that are copied.

#include "shapes.h"

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/solids/space_ids.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/predicates.h>

#include <gtest/gtest.h>

#include <map>

namespace {

using namespace sightline;

Operands triangles(const std::vector<std::array<std::array<long, 3>, 3>>& all) {
  Polygon_soup soup;
  for (const auto& corners : all) {
    std::vector<Point_id> loop;
    for (const auto& p : corners) loop.push_back(soup.add_point(Rational(p[0]), Rational(p[1]), Rational(p[2])));
    soup.add_face(loop);
  }
  Operands operands(std::span(&soup, 1));
  for (std::size_t i = 0; i < operands.pieces().size(); ++i) operands.make_edges(i);
  return operands;
}

Operands any_triangles(generate::Random& random, std::size_t count) {
  std::vector<std::array<std::array<long, 3>, 3>> all(count);
  for (auto& corners : all)
    for (auto& p : corners)
      for (long& x : p) x = random.between(-1, 1);
  return triangles(all);
}

std::array<Rational, 3> place_of(const std::array<Integer, 4>& h) {
  std::array<Rational, 3> place;
  for (std::size_t k = 0; k < 3; ++k) {
    place[k] = Rational(h[k], h[3]);
    place[k].canonicalize();
  }
  return place;
}

TEST(Space_ids, vertices_have_one_id_iff_they_have_one_place) {
  generate::Random random(7);
  const Operands operands = any_triangles(random, 16);
  const Predicates predicates = operands.predicates();
  const auto planes = static_cast<std::uint32_t>(operands.planes().size());
  Vertex_ids ids(operands);
  std::map<std::array<Rational, 3>, std::uint32_t> known;
  const auto check = [&](const Vertex& v) {
    const std::uint32_t id = ids.id(v);
    EXPECT_EQ(known.try_emplace(place_of(predicates.homogeneous(v)), id).first->second, id);
    EXPECT_EQ(place_of(ids.at(id)), place_of(predicates.homogeneous(v)));
  };
  std::size_t checked = 0;
  for (std::size_t i = 0; i < operands.pieces().size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) check(operands.vertex(predicates, i, k));
  for (std::uint32_t p = 0; p < planes; ++p)
    for (std::uint32_t q = p + 1; q < planes; ++q)
      for (std::uint32_t r = q + 1; r < planes; r += 1 + (p + q) % 3) {
        if (predicates.orientation_exact(p, q, r) == 0) continue;
        check(predicates.meet(p, q, r));
        ++checked;
      }
  // Planes across an axis, as trees of the scene have them.
  for (Point_id p = 0; p < 9; ++p)
    for (int axis = 0; axis < 3; ++axis) {
      const std::uint32_t across = Plane::across(axis, p).id();
      for (std::uint32_t q = 0; q + 1 < planes; ++q)
        if (predicates.orientation_exact(q, q + 1, across) != 0) check(predicates.meet(q, q + 1, across));
    }
  EXPECT_EQ(ids.size(), known.size());
  EXPECT_GT(checked, known.size());  // places have several names
}

TEST(Space_ids, lines_have_one_id_iff_their_minors_are_proportional) {
  generate::Random random(8);
  const Operands operands = any_triangles(random, 30);
  const Predicates predicates = operands.predicates();
  const auto planes = static_cast<std::uint32_t>(operands.planes().size());
  Line_ids ids(operands);
  std::map<std::array<Rational, 6>, std::uint32_t> known;
  std::size_t checked = 0;
  for (std::uint32_t p = 0; p < planes; ++p)
    for (std::uint32_t q = p + 1; q < planes; ++q) {
      const auto f = predicates.coefficients(Plane(p, false)), g = predicates.coefficients(Plane(q, false));
      std::array<Rational, 6> row;
      std::size_t k = 0;
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) row[k++] = Rational(f[i] * g[j] - f[j] * g[i]);
      if (row[0] == 0 && row[1] == 0 && row[3] == 0) continue;  // parallel
      const std::size_t axis = row[3] != 0 ? 0 : row[1] != 0 ? 1 : 2;
      const Rational unit = axis == 0 ? row[3] : axis == 1 ? row[1] : row[0];
      for (Rational& n : row) n /= unit;
      const std::uint32_t id = ids.id(p, q);
      EXPECT_EQ(known.try_emplace(row, id).first->second, id);
      EXPECT_EQ(ids.axis(id), axis);
      EXPECT_EQ(ids.id(q, p), id);
      ++checked;
    }
  EXPECT_EQ(ids.size(), known.size());
  EXPECT_GT(checked, known.size());
}

TEST(Space_ids, edges_with_the_same_ends_are_on_one_line) {
  const Operands operands = triangles({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}}});
  Line_ids ids(operands);
  const auto& pieces = operands.pieces();
  const std::uint32_t line =
      ids.id(pieces[0].support.id(), operands.corners(0)[0].edge.id(), operands.corners(0)[0].point, 1);
  EXPECT_EQ(ids.id(pieces[1].support.id(), operands.corners(1)[0].edge.id(), operands.corners(1)[0].point, 1), line);
  EXPECT_EQ(ids.id(pieces[0].support.id(), pieces[1].support.id()), line);
  EXPECT_NE(ids.id(pieces[0].support.id(), operands.corners(0)[1].edge.id(), 1, 2), line);
}

TEST(Space_ids, rows_whose_factor_is_a_multiple_of_the_prime_have_their_ids) {
  constexpr long prime = 2147483647;
  // x = 0, x + prime y = 0, z = 0, x = y: the minors of the first two are the prime's multiples, all of them.
  const Operands operands = triangles({{{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                       {{{0, 0, 0}, {prime, -1, 0}, {0, 0, 1}}},
                                       {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                       {{{0, 0, 0}, {1, 1, 0}, {0, 0, 1}}}});
  const Predicates predicates = operands.predicates();
  const auto plane = [&](std::size_t i) { return operands.pieces()[i].support.id(); };
  ASSERT_EQ(abs(predicates.homogeneous(predicates.meet(plane(0), plane(1), plane(2)))[3]) % prime, 0);
  Vertex_ids vertices(operands);
  const std::uint32_t origin = vertices.id(operands.vertex(predicates, 0, 0));
  EXPECT_EQ(vertices.id(predicates.meet(plane(0), plane(1), plane(2))), origin);
  EXPECT_EQ(vertices.id(predicates.meet(plane(0), plane(3), plane(2))), origin);
  EXPECT_NE(vertices.id(operands.vertex(predicates, 1, 1)), origin);
  Line_ids lines(operands);
  const std::uint32_t line = lines.id(plane(0), plane(1));
  EXPECT_EQ(lines.id(plane(0), plane(3)), line);
  EXPECT_EQ(lines.id(plane(1), plane(3)), line);
  EXPECT_EQ(lines.axis(line), 2u);
  EXPECT_NE(lines.id(plane(1), plane(2)), line);
}

TEST(Operands, edges_that_are_made_later_have_the_piece_in_front) {
  generate::Random random(9);
  for (const long size : {3L, 1L << 31, 1L << 45}) {  // numbers of each width
    std::vector<std::array<std::array<long, 3>, 3>> all(20);
    for (auto& corners : all)
      for (auto& p : corners)
        for (long& x : p) x = random.between(-size, size);
    const Operands operands = triangles(all);
    const Predicates predicates = operands.predicates();
    Predicate_counts counts;
    for (std::size_t i = 0; i < operands.pieces().size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const Plane edge = operands.corners(i)[k].edge;
        ASSERT_TRUE(edge.valid());
        EXPECT_NE(edge.id(), operands.pieces()[i].support.id());
        for (std::size_t c = 0; c < 3; ++c) {
          const Vertex corner = operands.vertex(predicates, i, c);
          EXPECT_EQ(predicates.side(corner, predicates.prepare(edge), counts),
                    c == (k + 2) % 3 ? CGAL::POSITIVE : CGAL::ZERO);
        }
      }
  }
}

TEST(Operands, pieces_of_a_face_that_meet_nothing_else_have_edges) {
  Polygon_soup lifted = test_solids::box({0, 0, 0}, {1, 1, 1});
  Polygon_soup bent;  // its top is two triangles
  for (Point_id p = 0; p < lifted.point_count(); ++p) {
    Exact_point at = lifted.point(p);
    if (p == 7) at[2] = 2;
    bent.add_point(at[0], at[1], at[2]);
  }
  for (Face_id f = 0; f < lifted.face_count(); ++f) bent.add_face(lifted.loop(f));
  const std::vector<Polygon_soup> solids{bent, test_solids::box({5, 5, 5}, {6, 6, 6})};
  const Set_result result = set_operation(Operands(solids), {});
  EXPECT_EQ(result.soup.face_count(), 13u);
  EXPECT_TRUE(result.crowded.empty());
  const Rational found = volume(result.soup);
  EXPECT_TRUE(found == Rational(13, 6) || found == Rational(7, 3)) << found;
}

TEST(Operands, points_are_copied_as_they_were_read) {
  const std::vector<Exact_point> all{{Rational(1, 3), 0, Rational(-7, 10)},
                                     {Rational(5, 1024), Rational(1, 1 << 20), 1000003},
                                     {Rational(-1, 3), Rational(2, 5), 0},
                                     {Rational("1/100000000000000000000"), Rational("123456789012345678901"), 1}};
  for (const std::size_t count : {std::size_t{3}, std::size_t{4}}) {  // the last does not fit a machine's numbers
    Polygon_soup read;
    for (std::size_t p = 0; p < count; ++p) read.add_point(all[p][0], all[p][1], all[p][2]);
    read.add_face({0, 1, 2});
    const Operands operands(std::span(&read, 1));
    Polygon_soup copied, expected;
    for (std::uint32_t p = 0; p < operands.points().size(); ++p) {
      operands.add_point(p, copied);
      const Exact_point at = operands.position(p);
      expected.add_point(at[0], at[1], at[2]);
      EXPECT_EQ(copied.point(p), at);
      EXPECT_EQ(copied.point(p), all[p]);
    }
    EXPECT_EQ(copied.coordinates.denominators(), expected.coordinates.denominators());
  }
}

}  // namespace
