// Polygons with points of a CGAL kernel: exact where the kernel is, and caught in lockstep where it is not.

#include "cutting.h"

#include <sightline/kernel/predicates.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/lockstep_traits.h>
#include <sightline/kernel/traits/point_traits.h>

#include <CGAL/Cartesian.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

using namespace kernel_test;

namespace {
using Float = Point_traits<CGAL::Simple_cartesian<float>>;
using Double = Point_traits<CGAL::Simple_cartesian<double>>;
using Gmpq = Point_traits<CGAL::Cartesian<CGAL::Gmpq>>;
using Epick = Point_traits<CGAL::Exact_predicates_inexact_constructions_kernel>;
using Epeck = Point_traits<CGAL::Exact_predicates_exact_constructions_kernel>;

static_assert(Partition_traits<Float> && Partition_traits<Double> && Partition_traits<Gmpq> &&
              Partition_traits<Epick> && Partition_traits<Epeck>);
static_assert(Partition_traits<Lockstep_traits<Exact_traits, Float>> && Partition_traits<Lockstep_traits<Gmpq, Float>>);
static_assert(Exact_traits::is_exact && Gmpq::is_exact && Epeck::is_exact && !Float::is_exact && !Double::is_exact &&
              !Epick::is_exact);

/// Tenths, and planes that pass through common points: the fan of a tilted pyramid and squares through its apex.
Polygon_soup degenerate_soup() {
  Polygon_soup soup;
  const auto add = [&](long x, long y, long z) {
    for (const long n : {x, y, z}) soup.coordinates.push_decimal(n, -1);
    return static_cast<Point_id>(soup.point_count() - 1);
  };
  const Point_id apex = add(3, 7, 11);
  std::vector<Point_id> rim;
  for (int i = 0; i < 8; ++i)
    rim.push_back(add(3 + 13 * ((i * 5) % 8 - 4) + i, 7 + 9 * ((i * 3) % 8 - 3), 11 + 7 * (i % 3 - 1) + (i % 2)));
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t j = i + 1; j < 8; j += 2) soup.add_face({apex, rim[i], rim[j]});
  for (int i = 0; i < 5; ++i) {
    const long a = 17 + i, b = 23 - 3 * i, c = 5 * i - 7;
    soup.add_face(
        {add(3 - a, 7 - b, 11 - c), add(3 + b, 7 - a, 11 + c), add(3 + a, 7 + b, 11 + c), add(3 - b, 7 + a, 11 - c)});
  }
  return soup;
}

/// A model whose every sign is wrong: front for behind, behind for on, on for in front.
struct Wrong : Gmpq {
  using Gmpq::Gmpq;
  Sign side(const Vertex& v, const Cutter& cutter, Predicate_counts& counts) const {
    const Sign s = Gmpq::side(v, cutter, counts);
    return s == CGAL::POSITIVE ? CGAL::NEGATIVE : s == CGAL::NEGATIVE ? CGAL::ZERO : CGAL::POSITIVE;
  }
  Sign side(const Eye& eye, Plane plane, Predicate_counts& counts) const { return Gmpq::side(eye, plane, counts); }
  Vertex meet(std::uint32_t piece, const Corner<Wrong>& from, const Corner<Wrong>& to, Sign s,
              const Cutter& cutter) const {
    return Gmpq::meet(piece, Corner<Gmpq>{from.vertex, {}}, Corner<Gmpq>{to.vertex, {}}, s, cutter);
  }
};

template <class Truth, class Judged>
typename Lockstep_traits<Truth, Judged>::Mistakes mistakes(const Scene& scene, std::uint64_t* asked = nullptr) {
  const Truth truth(scene);
  const Judged judged(scene);
  const Lockstep_traits<Truth, Judged> both(truth, judged);
  Polygon_store<Lockstep_traits<Truth, Judged>> store;
  Predicate_counts counts;
  split_all(both, store, counts);
  if (asked) *asked = counts.total();
  for (std::uint32_t i = 0; i < both.piece_count(); ++i)
    for (std::uint32_t j = 0; j < both.piece_count(); ++j) {
      const auto eye = both.eye(truth.position(store.piece(both, j).corners[0].vertex->truth));
      EXPECT_EQ(both.side(eye, both.supporting_plane(i), counts),
                truth.side(eye.truth, truth.supporting_plane(i), counts));
    }
  return both.mistakes();
}

template <class Traits>
void check_exact_model() {
  Random random(5);
  for (const int bits : {3, 20}) {
    const Polygon_soup soup = random_soup(random, 9, bits, [](long n) {
      Rational r(n, 10);
      r.canonicalize();
      return r;
    });
    const Scene scene(soup);
    const Traits traits(scene);
    Polygon_store<Traits> store;
    for (std::uint32_t i = 0; i < traits.piece_count(); ++i) {
      EXPECT_EQ(positions(traits, store.piece(traits, i)), scene.corner_points(scene.pieces()[i]));
      std::vector<Plane> planes;
      for (std::uint32_t j = 0; j < traits.piece_count(); ++j)
        planes.push_back(random() % 2 ? traits.supporting_plane(j) : traits.supporting_plane(j).opposite());
      Predicate_counts counts;
      cut_deep(
          traits, store.piece(traits, i), planes,
          [&](Plane plane) {
            const Plane support = scene.pieces()[plane.id()].support;
            return scene.file_coefficients(plane.flipped() ? support.opposite() : support);
          },
          store, counts);
      ASSERT_FALSE(testing::Test::HasFailure());
    }
  }
}
}  // namespace

TEST(Field_number, goes_to_and_fro_exactly_in_exact_kernels) {
  for (const Rational& value :
       {Rational(1, 3), Rational(-7), exact(0.1), exact_decimal(1, -400), exact_decimal(3, 400), Rational(0)}) {
    EXPECT_EQ(Field_number<CGAL::Gmpq>::to(Field_number<CGAL::Gmpq>::from(value)), value);
    EXPECT_EQ(Field_number<CGAL::Epeck::FT>::to(Field_number<CGAL::Epeck::FT>::from(value)), value);
    EXPECT_EQ(Field_number<Rational>::to(Field_number<Rational>::from(value)), value);
  }
  EXPECT_EQ(Field_number<double>::from(Rational(1, 3)), 1.0 / 3);
  EXPECT_EQ(Field_number<float>::from(Rational(1, 3)), 1.0f / 3);
  EXPECT_THROW(Field_number<double>::to(std::numeric_limits<double>::infinity()), std::domain_error);
}

TEST(Point_traits, laws_of_splitting_hold_for_Gmpq) { check_exact_model<Gmpq>(); }
TEST(Point_traits, laws_of_splitting_hold_for_Epeck) { check_exact_model<Epeck>(); }

TEST(Point_traits, the_side_of_a_plane_and_of_its_opposite_are_opposite) {
  const Scene scene(degenerate_soup());
  const auto check = [&](const auto& traits) {
    using Traits = std::decay_t<decltype(traits)>;
    Polygon_store<Traits> store;
    Predicate_counts counts;
    for (std::uint32_t i = 0; i < traits.piece_count(); ++i)
      for (const auto& corner : store.piece(traits, 0)) {
        const Plane h = traits.supporting_plane(i);
        EXPECT_EQ(traits.side(*corner.vertex, traits.prepare(h), counts),
                  -traits.side(*corner.vertex, traits.prepare(h.opposite()), counts));
        const std::optional<Plane> across = traits.axis_plane(1, *corner.vertex);
        ASSERT_TRUE(across);
        EXPECT_EQ(traits.side(*corner.vertex, traits.prepare(*across), counts), CGAL::ZERO);
      }
    EXPECT_TRUE(traits.same_sense(traits.supporting_plane(0), traits.supporting_plane(0)));
    EXPECT_FALSE(traits.same_sense(traits.supporting_plane(0), traits.supporting_plane(0).opposite()));
  };
  check(Gmpq(scene));
  check(Double(scene));
  check(Exact_traits(scene));
}

TEST(Point_traits, a_crossing_is_made_the_same_from_both_ends) {
  const Scene scene(degenerate_soup());
  const Double traits(scene);
  Polygon_store<Double> store;
  const auto polygon = store.piece(traits, 0);
  Predicate_counts counts;
  int crossings = 0;
  for (std::uint32_t j = 0; j < traits.piece_count(); ++j) {
    const auto cutter = traits.prepare(traits.supporting_plane(j));
    for (std::uint32_t k = 0; k < polygon.size; ++k) {
      const auto &from = polygon.corners[k], &to = polygon.corners[(k + 1) % polygon.size];
      const Sign s = traits.side(*from.vertex, cutter, counts);
      if (s == CGAL::ZERO || traits.side(*to.vertex, cutter, counts) != -s) continue;
      ++crossings;
      EXPECT_EQ(traits.meet(0, from, to, s, cutter).point, traits.meet(0, to, from, -s, cutter).point);
    }
  }
  EXPECT_GT(crossings, 0);
}

TEST(Point_traits, a_plane_of_ones_own_is_where_its_coefficients_say) {
  const Scene scene(degenerate_soup());
  Gmpq traits(scene);
  const Plane plane = traits.add_plane({Rational(1), Rational(-1, 3), Rational(0), Rational(2, 7)});
  Predicate_counts counts;
  EXPECT_EQ(traits.side(traits.eye({Rational(0), Rational(6, 7), Rational(5)}), plane, counts), CGAL::ZERO);
  EXPECT_EQ(traits.side(traits.eye({Rational(1), Rational(6, 7), Rational(5)}), plane, counts), CGAL::POSITIVE);
  EXPECT_EQ(traits.side(traits.eye({Rational(1), Rational(6, 7), Rational(5)}), plane.opposite(), counts),
            CGAL::NEGATIVE);
}

TEST(Lockstep, floats_and_doubles_are_caught_on_degenerate_input) {
  const Scene scene(degenerate_soup());
  std::uint64_t asked = 0;
  const auto by_float = mistakes<Exact_traits, Float>(scene, &asked);
  const auto by_double = mistakes<Exact_traits, Double>(scene);
  EXPECT_GT(asked, 1000u);
  EXPECT_GT(by_float.asked, asked);
  EXPECT_GT(by_float.wrong(), 0u);
  EXPECT_GT(by_double.wrong(), 0u);
  EXPECT_GT(by_double.missed_zero, 0u) << "incidences that rounding hides";
  EXPECT_EQ(by_float.asked, by_double.asked) << "both see the same queries";
}

TEST(Lockstep, constructions_of_Epick_are_caught_on_degenerate_input) {
  EXPECT_GT((mistakes<Exact_traits, Epick>(Scene(degenerate_soup())).wrong()), 0u);
}

TEST(Lockstep, exact_kernels_make_no_mistake_on_degenerate_input) {
  const Scene scene(degenerate_soup());
  const auto by_gmpq = mistakes<Exact_traits, Gmpq>(scene);
  EXPECT_GT(by_gmpq.asked, 1000u);
  EXPECT_EQ(by_gmpq.wrong(), 0u);
  EXPECT_EQ((mistakes<Exact_traits, Epeck>(scene).wrong()), 0u);
  EXPECT_EQ((mistakes<Gmpq, Epeck>(scene).wrong()), 0u);
}

TEST(Lockstep, each_kind_of_mistake_is_counted_as_what_it_is) {
  const Scene scene(degenerate_soup());
  const Gmpq truth(scene);
  const Wrong judged(scene);
  const Lockstep_traits<Gmpq, Wrong> both(truth, judged);
  Polygon_store<Lockstep_traits<Gmpq, Wrong>> store;
  Predicate_counts counts;
  std::array<std::uint64_t, 3> expected{};
  for (std::uint32_t i = 0; i < both.piece_count(); ++i)
    for (const auto& corner : store.piece(both, i))
      for (std::uint32_t j = 0; j < both.piece_count(); ++j)
        ++expected[static_cast<std::size_t>(both.side(*corner.vertex, both.prepare(both.supporting_plane(j)), counts) +
                                            1)];
  const auto found = both.mistakes();
  EXPECT_EQ(found.asked, expected[0] + expected[1] + expected[2]);
  EXPECT_EQ(found.false_zero, expected[0]);
  EXPECT_EQ(found.missed_zero, expected[1]);
  EXPECT_EQ(found.opposite, expected[2]);
  EXPECT_EQ(found.wrong(), found.asked);
}
