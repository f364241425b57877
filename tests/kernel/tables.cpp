// Interning: equal rows, planes and lines have equal ids, others do not.

#include "grid.h"

#include <rapidcheck/gtest.h>

#include <sightline/kernel/line_table.h>

#include <map>

using namespace kernel_test;

// ---- Rows

RC_GTEST_PROP(Row_table, numbers_equal_rows_alike_in_the_order_of_their_first_appearance,
              (std::vector<std::pair<std::uint8_t, std::uint8_t>> rows)) {
  Row_table table(2);
  std::map<std::pair<Limb, Limb>, std::uint32_t> oracle;
  for (const auto& [a, b] : rows) {
    const Limb row[2] = {Limb{a} << 60 | a, Limb{b}};
    const auto known = oracle.find({row[0], row[1]});
    RC_ASSERT(table.find(row) == (known == oracle.end() ? Row_table::none : known->second));
    const std::uint32_t id = table.intern(row);
    RC_ASSERT(id == oracle.try_emplace({row[0], row[1]}, static_cast<std::uint32_t>(oracle.size())).first->second);
    RC_ASSERT(table.size() == oracle.size());
    RC_ASSERT(table[id][0] == row[0] && table[id][1] == row[1]);
  }
}

TEST(Row_table, keeps_its_numbers_while_it_grows) {
  Row_table table(1);
  for (Limb x = 0; x < 20000; ++x) {
    const Limb row = x * 0x9e3779b97f4a7c15u;
    ASSERT_EQ(table.intern(&row), x);
  }
  for (Limb x = 0; x < 20000; ++x) {
    const Limb row = x * 0x9e3779b97f4a7c15u, other = row + 1;
    ASSERT_EQ(table.find(&row), x);
    ASSERT_EQ(table.intern(&row), x);
    ASSERT_EQ(table.find(&other), Row_table::none);
  }
}

TEST(Row_table, keeps_its_numbers_when_room_is_made) {
  Row_table table(1);
  for (Limb x = 0; x < 100; ++x) table.intern(&x);
  table.reserve(5000);
  table.reserve(10);
  for (Limb x = 0; x < 5000; ++x) ASSERT_EQ(table.intern(&x), x);
}

TEST(Row_table, an_empty_table_finds_nothing) {
  const Limb row = 0;
  EXPECT_EQ(Row_table(1).find(&row), Row_table::none);
}

TEST(Row_table, rows_that_differ_in_one_limb_differ) {
  Row_table table(3);
  std::vector<std::array<Limb, 3>> rows;
  for (int limb = 0; limb < 3; ++limb)
    for (int bit = 0; bit < 64; ++bit) {
      std::array<Limb, 3> row{};
      row[static_cast<std::size_t>(limb)] = Limb{1} << bit;
      rows.push_back(row);
    }
  for (std::uint32_t i = 0; i < rows.size(); ++i) ASSERT_EQ(table.intern(rows[i].data()), i);
}

// ---- Handles

TEST(Plane, a_handle_knows_its_plane_and_side) {
  constexpr Plane h(12, true);
  static_assert(h.id() == 12 && h.flipped() && h.opposite() == Plane(12, false) && h.opposite().opposite() == h &&
                h.valid() && !h.is_axis_plane());
  static_assert(!Plane().valid());
  for (const int axis : {0, 1, 2})
    for (const std::uint32_t point : {0u, 1u, Plane::max_axis_point - 1}) {
      const Plane a = Plane::across(axis, point);
      EXPECT_TRUE(a.is_axis_plane() && a.valid() && a.opposite().valid() && !a.flipped());
      EXPECT_EQ(a.axis(), axis);
      EXPECT_EQ(a.axis_point(), point);
      EXPECT_EQ(a.opposite().id(), a.id());
      EXPECT_GE(a.id(), Plane::max_table_planes);
    }
}

// ---- Points

TEST(Grid_points, equal_points_have_one_id_at_every_width) {
  for (const int bits : {1, 20, 53, 54, 63, 64, 65, 127, 128, 200}) {
    Random random(static_cast<std::uint64_t>(bits));
    Grid grid(bits);
    EXPECT_EQ(grid.points.bits(), bits);
    const Integer most = power_of_two(bits) - 1;
    std::vector<std::array<Integer, 3>> sample{{0, 0, 0}, {most, -most, most}, {-most, -most, -most}};
    for (int i = 0; i < 40; ++i)
      sample.push_back({any_size(random, bits), any_size(random, bits), uniform(random, bits)});
    for (const auto& p : sample) {
      const std::uint32_t id = grid.point(p);
      ASSERT_EQ(grid.point(p), id);
      ASSERT_EQ(grid.at(id), p);
      for (int k = 0; k < 3; ++k) {
        const Rational truth = shifted(p[static_cast<std::size_t>(k)], grid.points.shift());
        ASSERT_LE(abs(exact(grid.points.approximate(id, k)) - truth), shifted(abs(truth), 52));
      }
    }
  }
}

TEST(Grid_points, machine_integers_and_gmp_integers_name_the_same_points) {
  Grid_points points(40);
  const std::uint32_t a = points.intern(std::array<std::int64_t, 3>{-5, 7, 1ll << 39});
  EXPECT_EQ(points.intern(std::array<Integer, 3>{-5, 7, power_of_two(39)}), a);
  EXPECT_EQ(points.small(a, 0), -5);
}

TEST(Grid_points, a_coordinate_wider_than_its_limbs_is_refused) {
  Grid_points points(63);
  EXPECT_THROW(points.intern(std::array<Integer, 3>{power_of_two(63), 0, 0}), std::overflow_error);
  EXPECT_EQ(points.size(), 0u);
}

// ---- Planes

TEST(Plane_table, the_form_is_canonical) {
  Grid grid(20);
  const Plane h = grid.planes.intern(Integer(-6), Integer(9), Integer(0), Integer(12));
  EXPECT_TRUE(h.flipped());
  for (int k = 0; k < 4; ++k)
    EXPECT_EQ(grid.planes.integer(h.id(), k), (std::array<int, 4>{2, -3, 0, -4}[static_cast<std::size_t>(k)]));
  const Plane g = grid.planes.intern(Integer(0), Integer(0), Integer(-5), Integer(3));
  EXPECT_TRUE(g.flipped());
  EXPECT_EQ(grid.planes.integer(g.id(), 2), 5);
  EXPECT_EQ(grid.planes.integer(g.id(), 3), -3);
  EXPECT_EQ(grid.planes.intern(Integer(0), Integer(7), Integer(-7), Integer(0)),
            grid.planes.intern(Integer(0), Integer(1), Integer(-1), Integer(0)));
  EXPECT_EQ(grid.predicates().coefficients(h)[0], -2);
  EXPECT_EQ(grid.predicates().coefficients(h.opposite())[0], 2);
}

TEST(Plane_table, every_row_has_gcd_one_and_a_positive_lead) {
  Random random(3);
  for (const int bits : {8, 30, 60}) {
    Grid grid(bits);
    for (int i = 0; i < 200; ++i) {
      const Coefficients h{any_size(random, bits) * (random() % 3 != 0), any_size(random, bits) * (random() % 2),
                           any_size(random, bits), any_size(random, 2 * bits)};
      if (h[0] == 0 && h[1] == 0 && h[2] == 0) continue;
      const Plane plane = grid.plane(h);
      const auto k = [&](int j) { return grid.planes.integer(plane.id(), j); };
      ASSERT_EQ(gcd(gcd(k(0), k(1)), gcd(k(2), k(3))), 1);
      ASSERT_GT(k(0) != 0 ? k(0) : k(1) != 0 ? k(1) : k(2), 0);
      // It is a multiple of what it was made from, negative where the handle is flipped.
      const Coefficients oriented = grid.predicates().coefficients(plane);
      for (std::size_t i0 = 0; i0 < 4; ++i0)
        for (std::size_t j = 0; j < 4; ++j) ASSERT_EQ(oriented[i0] * h[j], oriented[j] * h[i0]);
      ASSERT_GT(oriented[0] * h[0] + oriented[1] * h[1] + oriented[2] * h[2], 0);
    }
  }
}

TEST(Plane_table, numbers_of_a_machine_and_integers_make_the_same_plane) {
  Random random(5);
  Grid grid(30);
  const auto integer = [](std::int64_t n) { return Integer(static_cast<long>(n)); };
  for (int i = 0; i < 2000; ++i) {
    // With a common divisor, odd and even, and with zeros.
    const auto one = static_cast<std::int64_t>(random() % 12 + 1);
    const auto other = static_cast<std::int64_t>(random() % 40 + 1);
    const std::int64_t factor = one * other;
    const auto any = [&] {
      return random() % 4 == 0 ? 0 : (static_cast<std::int64_t>(random() % (1u << 20)) - (1 << 19)) * factor;
    };
    const std::int64_t a = any(), b = any(), c = any(), d = any();
    if (a == 0 && b == 0 && c == 0) continue;
    ASSERT_EQ(grid.planes.intern(a, b, c, __int128{d}),
              grid.planes.intern(integer(a), integer(b), integer(c), integer(d)));
  }
}

TEST(Plane_table, one_plane_has_one_id_whatever_points_and_orientation_it_was_made_from) {
  Random random(11);
  for (const int bits : {6, 25, 70, 120}) {
    Grid grid(bits);
    for (int round = 0; round < 30; ++round) {
      // Points of one plane: o + i u + j v.
      std::array<Integer, 3> o, u, v;
      for (std::size_t k = 0; k < 3; ++k) {
        o[k] = uniform(random, bits - 4);
        u[k] = uniform(random, bits - 4);
        v[k] = uniform(random, bits - 4);
      }
      const auto at = [&](int i, int j) {
        return std::array<Integer, 3>{o[0] + i * u[0] + j * v[0], o[1] + i * u[1] + j * v[1],
                                      o[2] + i * u[2] + j * v[2]};
      };
      const Coefficients h = through(at(0, 0), at(1, 0), at(0, 1));
      if (h[0] == 0 && h[1] == 0 && h[2] == 0) continue;
      const Plane plane = grid.plane(h);
      EXPECT_EQ(grid.plane(through(at(1, 0), at(0, 1), at(0, 0))), plane);
      EXPECT_EQ(grid.plane(through(at(0, 1), at(1, 0), at(0, 0))), plane.opposite());
      EXPECT_EQ(grid.plane(through(at(3, -2), at(1, 1), at(-1, 3))).id(), plane.id());
      EXPECT_EQ(grid.plane(through(at(-3, -3), at(2, -3), at(-3, 3))), plane);
      Coefficients moved = h;
      moved[3] += gcd(gcd(h[0], h[1]), h[2]);
      EXPECT_NE(grid.plane(moved).id(), plane.id());
    }
  }
}

TEST(Plane_table, machine_integers_and_gmp_integers_make_the_same_planes) {
  Random random(17);
  for (const int bits : {5, 19, 20, 30}) {
    Plane_table fast((Grid_points(bits))), wide((Grid_points(bits)));
    for (int i = 0; i < 3000; ++i) {
      std::array<std::int64_t, 3> n;
      for (auto& x : n) x = random() % 5 == 0 ? 0 : any_size(random, 2 * bits + 2).get_si();
      if (random() % 3 == 0)
        for (auto& x : n) x = x / 64 * 60;  // common divisors
      if (n[0] == 0 && n[1] == 0 && n[2] == 0) continue;
      const Integer offset = random() % 3 == 0   ? Integer(any_size(random, 3 * bits) / 60 * 60)
                             : random() % 7 == 0 ? Integer(0)
                                                 : any_size(random, 3 * bits + 3);
      __int128 d = 0;
      Limb limbs[2];
      to_limbs(offset, limbs, 2);
      d = static_cast<__int128>(static_cast<unsigned __int128>(limbs[1]) << 64 | limbs[0]);
      const Plane a = fast.intern(n[0], n[1], n[2], d);
      const Plane b = wide.intern(Integer(static_cast<long>(n[0])), Integer(static_cast<long>(n[1])),
                                  Integer(static_cast<long>(n[2])), offset);
      ASSERT_EQ(a, b);
      for (int k = 0; k < 4; ++k) ASSERT_EQ(fast.integer(a.id(), k), wide.integer(b.id(), k));
      const Approximate_plane x = fast.approximate(a.id()), y = wide.approximate(b.id());
      ASSERT_TRUE(x.a == y.a && x.b == y.b && x.c == y.c && x.d == y.d);
    }
    EXPECT_EQ(fast.size(), wide.size());
    EXPECT_EQ(fast.budget().normal, wide.budget().normal);
    EXPECT_EQ(fast.budget().offset, wide.budget().offset);
    EXPECT_EQ(fast.budget().coordinate, bits);
  }
}

TEST(Plane_table, machine_integers_work_where_rows_have_more_limbs_than_they_need) {
  Plane_table fast((Grid_points(80))), wide((Grid_points(80)));
  EXPECT_GT(fast.offset_limbs(), 2);
  for (const std::int64_t s : {1, -1}) {
    const Plane a = fast.intern(3 * s, -5 * s, std::int64_t{0}, static_cast<__int128>(-7) * s),
                b = wide.intern(Integer(3 * s), Integer(-5 * s), Integer(0), Integer(-7 * s));
    EXPECT_EQ(a, b);
    for (int k = 0; k < 4; ++k) EXPECT_EQ(fast.integer(a.id(), k), wide.integer(b.id(), k));
  }
}

TEST(Plane_table, the_budget_is_the_largest_width_of_the_reduced_planes) {
  Grid grid(20);
  grid.planes.intern(Integer(1024 * 8), Integer(0), Integer(0), Integer(8 * 5));
  EXPECT_EQ(grid.planes.budget().normal, 11);
  EXPECT_EQ(grid.planes.budget().offset, 3);
  grid.planes.intern(std::int64_t{1}, std::int64_t{2}, std::int64_t{-4096}, __int128{-65536});
  EXPECT_EQ(grid.planes.budget().normal, 13);
  EXPECT_EQ(grid.planes.budget().offset, 17);
}

TEST(Plane_table, a_plane_without_a_normal_is_refused) {
  Grid grid(10);
  EXPECT_THROW(grid.planes.intern(Integer(0), Integer(0), Integer(0), Integer(1)), std::domain_error);
  EXPECT_THROW(grid.planes.intern(std::int64_t{0}, std::int64_t{0}, std::int64_t{0}, __int128{0}), std::domain_error);
  EXPECT_EQ(grid.planes.size(), 0u);
}

TEST(Plane_table, planes_wider_than_their_rows_are_refused_and_leave_no_trace) {
  Grid grid(10);  // one limb each
  EXPECT_THROW(grid.planes.intern(power_of_two(63), Integer(1), Integer(0), Integer(0)), std::overflow_error);
  EXPECT_THROW(grid.planes.intern(Integer(1), Integer(1), Integer(0), power_of_two(63)), std::overflow_error);
  EXPECT_THROW(grid.planes.intern(std::int64_t{1}, std::int64_t{1}, std::int64_t{0}, __int128{1} << 63),
               std::overflow_error);
  EXPECT_EQ(grid.planes.size(), 0u);
  EXPECT_EQ(grid.planes.budget().normal, 0);
  // Reduced they fit.
  EXPECT_NO_THROW(grid.planes.intern(power_of_two(63), power_of_two(63), Integer(0), power_of_two(63)));
  EXPECT_NO_THROW(grid.planes.intern(std::int64_t{2}, std::int64_t{2}, std::int64_t{0}, __int128{1} << 63));
}

TEST(Plane_table, rows_hold_every_plane_through_three_grid_points) {
  for (const int bits : {1, 19, 20, 29, 30, 31, 41, 42, 53, 62, 63, 64, 100}) {
    Grid grid(bits);
    const Integer m = power_of_two(bits) - 1;
    std::vector<std::array<Integer, 3>> corners;
    for (int i = 0; i < 8; ++i)
      corners.push_back({i & 1 ? m : Integer(-m), i & 2 ? m : Integer(-m), i & 4 ? m : Integer(-m)});
    corners.push_back({m - 1, 1 - m, m});
    corners.push_back({-m, m, m - 1});
    for (const auto& a : corners)
      for (const auto& b : corners)
        for (const auto& c : corners) {
          const Coefficients h = through(a, b, c);
          if (h[0] != 0 || h[1] != 0 || h[2] != 0) {
            ASSERT_NO_THROW(grid.plane(h)) << bits;
          }
        }
  }
}

TEST(Plane_table, axis_planes_are_found_where_they_are_and_only_there) {
  for (const int bits : {10, 20, 63, 64, 65, 130, 500}) {
    Random random(static_cast<std::uint64_t>(bits));
    Grid grid(bits);
    const Integer most = power_of_two(bits) - 1;
    for (const Integer& x :
         {Integer(0), Integer(1), Integer(-1), most, Integer(-most), uniform(random, bits),
          bits > 64 ? power_of_two(64) : Integer(3), bits > 64 ? Integer(-power_of_two(64)) : Integer(-3)})
      for (int axis = 0; axis < 3; ++axis) {
        std::array<Integer, 3> p{7, 7, 7};
        p[static_cast<std::size_t>(axis)] = x;
        const std::uint32_t point = grid.point(p);
        const auto find = [&] {
          return grid.planes.find_axis_plane(axis, grid.points.coordinate(point, axis), grid.points.limbs());
        };
        const std::size_t before = grid.planes.size();
        Coefficients h{0, 0, 0, -x};
        h[static_cast<std::size_t>(axis)] = 1;
        const Plane found = find();
        const Plane made = grid.planes.intern(h[0], h[1], h[2], h[3]);
        ASSERT_EQ(found.valid(), grid.planes.size() == before) << bits << ' ' << x << ' ' << axis;
        if (found.valid()) {
          ASSERT_EQ(found, made);
        }
        ASSERT_EQ(find(), made) << bits << ' ' << x << ' ' << axis;
        ASSERT_FALSE(made.flipped());  // its front is where the coordinate is larger, as with Plane::across
      }
  }
}

TEST(Plane_table, approximations_of_wide_planes_are_within_their_bound_and_about_one) {
  Random random(5);
  for (const int bits : {30, 53, 54, 80, 300, 1100}) {
    Grid grid(bits);
    for (int i = 0; i < 30; ++i) {
      std::array<std::array<Integer, 3>, 3> p;
      for (auto& point : p)
        for (auto& x : point) x = random() % 3 ? uniform(random, bits) : any_size(random, bits);
      const Coefficients h = through(p[0], p[1], p[2]);
      if (h[0] == 0 && h[1] == 0 && h[2] == 0) continue;
      const Plane plane = grid.plane(h);
      const Approximate_plane f = grid.planes.approximate(plane.id());
      const std::array<double, 4> rounded{f.a, f.b, f.c, f.d};
      // One power of two is common to all, but for the offset's own shift.
      int width = 0;
      for (int k = 0; k < 3; ++k)
        width = std::max(width, static_cast<int>(bit_length(grid.planes.integer(plane.id(), k))));
      const long scale = grid.points.shift() == 0 ? 0 : width;
      for (int k = 0; k < 4; ++k) {
        const Rational truth = shifted(grid.planes.integer(plane.id(), k), scale + (k == 3 ? grid.points.shift() : 0));
        ASSERT_LE(abs(exact(rounded[static_cast<std::size_t>(k)]) - truth),
                  shifted(abs(truth), 52) + exact(4.9406564584124654e-324));
      }
      if (scale != 0) {
        const double n = std::max({std::fabs(f.a), std::fabs(f.b), std::fabs(f.c)});
        ASSERT_TRUE(n >= 0.5 && n <= 1);
      }
    }
  }
}

// ---- Lines

TEST(Line_table, edges_of_a_T_junction_share_their_line) {
  Grid_points points(10);
  const auto p = [&](int x, int y, int z) { return points.intern(std::array<std::int64_t, 3>{x, y, z}); };
  Line_table lines(points);
  const std::uint32_t a = p(0, 0, 5), b = p(4, 8, 5), middle = p(1, 2, 5), off = p(1, 2, 6);
  const Line whole = lines.through(a, b);
  EXPECT_EQ(lines.through(a, middle), whole);
  EXPECT_EQ(lines.through(middle, b), whole);
  EXPECT_EQ(lines.through(b, middle), (Line{whole.id, !whole.flipped}));
  EXPECT_NE(lines.through(a, off).id, whole.id);
  EXPECT_NE(lines.through(p(0, 0, 6), p(4, 8, 6)).id, whole.id);  // parallel
  EXPECT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines.integer(whole.id, 0), 1);
  EXPECT_EQ(lines.integer(whole.id, 1), 2);
  EXPECT_EQ(lines.integer(whole.id, 2), 0);
}

TEST(Line_table, a_line_needs_two_points) {
  for (const int bits : {10, 62, 63, 130}) {
    Grid grid(bits);
    const std::uint32_t a = grid.point({Integer(1), Integer(2), Integer(3)});
    Line_table lines(grid.points);
    EXPECT_THROW(lines.through(a, a), std::domain_error) << bits;
  }
}

TEST(Line_table, one_line_has_one_id_and_its_coordinates_are_canonical) {
  Random random(23);
  for (const int bits : {5, 30, 31, 62, 130}) {
    Grid grid(bits);
    Line_table lines(grid.points);
    for (int round = 0; round < 60; ++round) {
      std::array<Integer, 3> o, u;
      for (std::size_t k = 0; k < 3; ++k) {
        o[k] = uniform(random, bits - 3);
        u[k] = random() % 3 == 0 ? Integer(0) : uniform(random, bits - 4);
      }
      if (u[0] == 0 && u[1] == 0 && u[2] == 0) continue;
      const auto at = [&](int i) { return grid.point({o[0] + i * u[0], o[1] + i * u[1], o[2] + i * u[2]}); };
      const Line line = lines.through(at(0), at(1));
      for (const auto& [i, j] : {std::pair{0, 2}, {-3, 5}, {1, 2}, {3, 4}}) {
        ASSERT_EQ(lines.through(at(i), at(j)), line);
        ASSERT_EQ(lines.through(at(j), at(i)), (Line{line.id, !line.flipped}));
      }
      std::array<Integer, 6> l;
      for (int k = 0; k < 6; ++k) l[static_cast<std::size_t>(k)] = lines.integer(line.id, k);
      ASSERT_EQ(gcd(gcd(l[0], l[1]), l[2]), 1);
      ASSERT_GT(l[0] != 0 ? l[0] : l[1] != 0 ? l[1] : l[2], 0);
      ASSERT_EQ(l[0] * l[3] + l[1] * l[4] + l[2] * l[5], 0);
      ASSERT_EQ(o[1] * l[2] - o[2] * l[1], l[3]);
      ASSERT_EQ(o[2] * l[0] - o[0] * l[2], l[4]);
      ASSERT_EQ(o[0] * l[1] - o[1] * l[0], l[5]);
      ASSERT_EQ(sgn(Integer(l[0] * u[0] + l[1] * u[1] + l[2] * u[2])), line.flipped ? -1 : 1);
    }
  }
}

TEST(Line_table, rows_hold_the_lines_through_the_corners_of_the_grid) {
  for (const int bits : {1, 30, 31, 62, 63, 64}) {
    Grid grid(bits);
    const Integer m = power_of_two(bits) - 1;
    std::vector<std::uint32_t> corners;
    for (int i = 0; i < 8; ++i)
      corners.push_back(
          grid.point({i & 1 ? m : Integer(-m), i & 2 ? m : Integer(-m), i & 4 ? Integer(m - 1) : Integer(-m)}));
    Line_table lines(grid.points);
    for (const std::uint32_t a : corners)
      for (const std::uint32_t b : corners)
        if (a != b) {
          ASSERT_NO_THROW(lines.through(a, b));
        }
  }
}
