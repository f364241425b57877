// Plane-defined polygons under the knife, and what does not model Partition_traits.

#include "../sample.h"
#include "cutting.h"

#include <sightline/kernel/traits/exact_traits.h>

#include <CGAL/Simple_cartesian.h>

using namespace kernel_test;

namespace {

using test_scenes::sample;

/// One square in z = 0 and planes to cut it by, added to the scene in grid coordinates by their file coefficients.
struct Square_and_planes {
  Polygon_soup soup;
  std::unique_ptr<Scene> scene;
  std::vector<Plane> planes;
  Square_and_planes(const std::vector<std::array<long, 4>>& cutters, bool mirrored) {
    soup = soup_of({{-4, -4, 0},
                    {4, -4, 0},
                    {4, 4, 0},
                    {-4, 4, 0},
                    {-64, 0, 1},
                    {64, 0, 1},
                    {0, 64, 1},
                    {0, -64, 1},
                    {1, 0, 1},
                    {0, 1, 0}});
    if (mirrored) soup.add_face({3, 2, 1, 0});
    else soup.add_face({0, 1, 2, 3});
    soup.add_face({4, 5, 6});
    soup.add_face({4, 5, 7});
    scene = std::make_unique<Scene>(soup);
    for (const auto& h : cutters) {
      // File = offset + unit x grid here (scale 1): read off where the origin is.
      const Located_point o = scene->locate({0, 0, 0}), e = scene->locate({1, 0, 0});
      const Rational unit(Integer(e.x * o.w - o.x * e.w), Integer(o.w * e.w));
      std::array<Rational, 4> g{Rational(h[0]), Rational(h[1]), Rational(h[2]), Rational(0)};
      g[3] =
          Rational(h[3]) * unit - (h[0] * Rational(o.x, o.w) + h[1] * Rational(o.y, o.w) + h[2] * Rational(o.z, o.w));
      planes.push_back(scene->add_plane({g[0].get_num(), g[1].get_num(), g[2].get_num(), g[3].get_num()}));
    }
  }
};

}  // namespace

TEST(Exact_traits, pieces_begin_with_their_corners_on_their_planes_and_inside_their_edges) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 4);
  const Scene scene(soup);
  const Exact_traits traits(scene);
  Polygon_store<Exact_traits> store;
  for (std::uint32_t i = 0; i < traits.piece_count(); ++i) {
    const Convex_polygon<Exact_traits> polygon = store.piece(traits, i);
    ASSERT_EQ(polygon.size, 4u);
    EXPECT_EQ(polygon.piece, i);
    EXPECT_EQ(positions(traits, polygon), scene.corner_points(scene.pieces()[i]));
    for (std::uint32_t k = 0; k < 4; ++k) {
      const auto& corner = polygon.corners[k];
      Predicate_counts on, inside;
      EXPECT_EQ(traits.side(*corner.vertex, traits.prepare(traits.supporting_plane(i)), on), CGAL::ZERO);
      EXPECT_EQ(traits.side(*corner.vertex, traits.prepare(corner.edge.bound), on), CGAL::ZERO);
      EXPECT_EQ(traits.side(*polygon.corners[(k + 1) % 4].vertex, traits.prepare(corner.edge.bound), on), CGAL::ZERO);
      EXPECT_EQ(on.combinatorial, 3u);
      EXPECT_EQ(traits.side(*polygon.corners[(k + 2) % 4].vertex, traits.prepare(corner.edge.bound), inside),
                CGAL::POSITIVE);
      EXPECT_EQ(inside.filtered, 1u);
      // The wall beyond the edge is known, so a cut of the edge lies on it without arithmetic.
      ASSERT_NE(corner.edge.beyond, Vertex::no_plane);
      EXPECT_NE(corner.edge.beyond, traits.supporting_plane(i).id());
      EXPECT_EQ(traits.side(*corner.vertex, traits.prepare(Plane(corner.edge.beyond, false)), on), CGAL::ZERO);
    }
  }
}

TEST(Exact_traits, a_cut_of_an_edge_is_known_to_lie_on_both_its_faces) {
  // A tetrahedron (no wall is the edge plane of another) and a triangle that cuts four of its edges.
  Polygon_soup soup = soup_of({{0, 0, 0}, {7, 1, 2}, {2, 8, 1}, {1, 2, 9}, {-9, 1, 3}, {12, -5, 2}, {3, 14, 4}});
  soup.add_face({0, 2, 1});
  soup.add_face({0, 1, 3});
  soup.add_face({1, 2, 3});
  soup.add_face({2, 0, 3});
  soup.add_face({4, 5, 6});
  const Scene scene(soup);
  const Exact_traits traits(scene);
  Polygon_store<Exact_traits> store;
  Predicate_counts counts;
  const auto cutter = traits.prepare(traits.supporting_plane(4));
  int crossings = 0;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const Convex_polygon<Exact_traits> polygon = store.piece(traits, i);
    if (position(traits, polygon, cutter, counts) != Position::across) continue;
    const auto parts =
        checked_split(traits, polygon, cutter, scene.file_coefficients(traits.supporting_plane(4)), store, counts);
    for (const auto& part : parts)
      for (const auto& corner : part) {
        if (corner.vertex->is_input()) continue;
        ++crossings;
        std::size_t known = 0;
        for (std::uint32_t j = 0; j < 5; ++j) {
          Predicate_counts one;
          known += traits.side(*corner.vertex, traits.prepare(traits.supporting_plane(j)), one) == CGAL::ZERO &&
                   one.combinatorial == 1;
        }
        EXPECT_EQ(known, 3u);  // its own face, the face beyond the edge, the cutter
      }
  }
  EXPECT_GE(crossings, 12);
}

TEST(Split, every_way_in_which_a_plane_meets_a_square) {
  struct Case {
    std::array<long, 4> plane;  // in the file's coordinates
    Position where;
    std::array<std::uint32_t, 2> corners;  // of the part behind and the part in front
  };
  const std::vector<Case> cases{
      {{1, 0, 0, 0}, Position::across, {4, 4}},  // through two edges
      {{1, 3, 0, -1}, Position::across, {4, 4}},
      {{1, 1, 0, -4}, Position::across, {5, 3}},  // cuts off a corner
      {{1, 1, 0, 4}, Position::across, {3, 5}},
      {{1, 1, 0, 0}, Position::across, {3, 3}},  // through two corners
      {{1, -1, 0, 0}, Position::across, {3, 3}},
      {{1, 3, 0, 8}, Position::across, {3, 4}},  // through one corner and an edge
      {{3, 1, 5, -8}, Position::across, {4, 3}},
      {{1, 0, 0, -4}, Position::behind, {0, 0}},  // along an edge
      {{1, 0, 0, 4}, Position::in_front, {0, 0}},
      {{0, 1, 7, 4}, Position::in_front, {0, 0}},
      {{1, 1, 0, -8}, Position::behind, {0, 0}},  // touches a corner
      {{1, 1, 3, 8}, Position::in_front, {0, 0}},
      {{1, 0, 0, -5}, Position::behind, {0, 0}},  // misses
      {{0, 0, 1, 0}, Position::on, {0, 0}},       // contains
      {{0, 0, 1, -1}, Position::behind, {0, 0}},  // parallel
  };
  for (const bool mirrored : {false, true}) {
    std::vector<std::array<long, 4>> planes;
    for (const Case& c : cases) planes.push_back(c.plane);
    const Square_and_planes given(planes, mirrored);
    const Exact_traits traits(*given.scene);
    Polygon_store<Exact_traits> store;
    const Convex_polygon<Exact_traits> square = store.piece(traits, 0);
    for (std::size_t i = 0; i < cases.size(); ++i)
      for (const bool opposite : {false, true}) {
        const Plane plane = opposite ? given.planes[i].opposite() : given.planes[i];
        Predicate_counts counts;
        const Position expected = !opposite                              ? cases[i].where
                                  : cases[i].where == Position::behind   ? Position::in_front
                                  : cases[i].where == Position::in_front ? Position::behind
                                                                         : cases[i].where;
        ASSERT_EQ(position(traits, square, traits.prepare(plane), counts), expected) << i;
        if (expected != Position::across) continue;
        const auto parts =
            checked_split(traits, square, traits.prepare(plane), given.scene->file_coefficients(plane), store, counts);
        EXPECT_EQ(parts[opposite ? 1 : 0].size, cases[i].corners[0]) << i;
        EXPECT_EQ(parts[opposite ? 0 : 1].size, cases[i].corners[1]) << i;
        // Edges go on to bound the parts: every part in front of all its edge planes.
        for (const auto& part : parts)
          for (std::uint32_t k = 0; k < part.size; ++k)
            for (std::uint32_t l = 0; l < part.size; ++l) {
              const Sign s = traits.side(*part.corners[l].vertex, traits.prepare(part.corners[k].edge.bound), counts);
              ASSERT_EQ(s, l == k || l == (k + 1) % part.size ? CGAL::ZERO : CGAL::POSITIVE)
                  << "case " << i << " edge " << k << " corner " << l;
            }
      }
  }
}

TEST(Split, cutting_fifty_deep_stays_exact_and_its_error_does_not_grow) {
  for (const int bits : {12, 50}) {
    if (test_scenes::is_sanitized() && bits == 12) continue;
    Random random(static_cast<std::uint64_t>(bits));
    Polygon_soup soup;
    const long m = (1l << bits) - 1;
    for (const auto& p : {std::array<long, 3>{-m, -m, 0}, {m, -m, 1}, {m, m, 2}, {-m, m, 1}})
      soup.add_point(Rational(p[0]), Rational(p[1]), Rational(p[2]));
    soup.add_face({0, 1, 2, 3});
    // Planes that graze the square's rim from all around, so that each cut leaves most of it; some through common
    // points.
    std::vector<Point_id> apexes;
    for (int i = 0; i < 4; ++i)
      apexes.push_back(soup.add_point(Rational(static_cast<long>(random() % 9)),
                                      Rational(static_cast<long>(random() % 9)), Rational(m)));
    for (int i = 0; i < 90; ++i) {
      const double angle = 0.0393 * i * 7 + 0.01 * static_cast<double>(random() % 100);
      const auto rim = [&](double a, double r) {
        return soup.add_point(Rational(std::lround(std::cos(a) * r * static_cast<double>(m))),
                              Rational(std::lround(std::sin(a) * r * static_cast<double>(m))),
                              Rational(static_cast<long>(random() % 5) - 2));
      };
      soup.add_face({rim(angle, 0.96), rim(angle + 0.4, 0.96), apexes[random() % 4]});
    }
    const Scene scene(soup);
    const Exact_traits traits(scene);
    Polygon_store<Exact_traits> store;
    Predicate_counts counts;
    std::vector<Plane> planes;
    for (std::uint32_t i = 1; i < traits.piece_count(); ++i) planes.push_back(traits.supporting_plane(i));
    const auto file = [&](Plane plane) { return scene.file_coefficients(plane); };
    Convex_polygon<Exact_traits> polygon = store.piece(traits, 0);
    const int cuts = cut_deep(traits, polygon, planes, file, store, counts);
    EXPECT_GE(cuts, 50) << bits;
    // No vertex knows its place worse than a meet of input planes does: it is one.
    std::size_t made = 0;
    double worst = 0;
    Split_scratch<Exact_traits> scratch;
    for (const Plane plane : planes) {
      const auto cutter = traits.prepare(plane);
      if (classify(traits, polygon, cutter, scratch, counts) != Position::across) continue;
      const auto parts = split(traits, polygon, cutter, scratch, store);
      polygon = parts[0].size > parts[1].size ? parts[0] : parts[1];
      for (const auto& corner : polygon) {
        ++made;
        worst = std::max(worst, corner.vertex->error);
      }
    }
    EXPECT_GT(made, 50u);
    EXPECT_LT(worst, std::ldexp(1.0, bits - 24)) << bits;
  }
}

TEST(Split, laws_hold_for_random_polygons_and_planes_of_the_scene) {
  Random random(8);
  for (const int bits : {3, 10, 26, 55}) {
    const Polygon_soup soup = random_soup(random, 24, bits, [](long n) { return Rational(n); });
    const Scene scene(soup);
    const Exact_traits traits(scene);
    Polygon_store<Exact_traits> store;
    int across = 0;
    for (std::uint32_t i = 0; i < traits.piece_count(); ++i) {
      Predicate_counts counts;
      std::vector<Plane> planes;
      for (std::uint32_t j = 0; j < traits.piece_count(); ++j)
        planes.push_back(random() % 2 ? traits.supporting_plane(j) : traits.supporting_plane(j).opposite());
      across += cut_deep(
          traits, store.piece(traits, i), planes, [&](Plane plane) { return scene.file_coefficients(plane); }, store,
          counts);
      ASSERT_FALSE(HasFailure());
    }
    EXPECT_GT(across, 10);
  }
}

TEST(Exact_traits, axis_planes_have_the_tables_names_where_it_holds_them) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 4);
  const Point_id p = soup.add_point(Rational(1), Rational(2), Rational(3)),
                 q = soup.add_point(Rational(2), Rational(2), Rational(9)),
                 r = soup.add_point(Rational(-3), Rational(1), Rational(1));
  soup.add_face({p, q, r});
  const Scene scene(soup);
  const Exact_traits traits(scene);
  Polygon_store<Exact_traits> store;
  Predicate_counts counts;
  const auto cube = store.piece(traits, 0), triangle = store.piece(traits, 6);
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<Plane> known = traits.axis_plane(axis, *cube.corners[0].vertex),
                               fresh = traits.axis_plane(axis, *triangle.corners[0].vertex);
    ASSERT_TRUE(known && fresh);
    EXPECT_FALSE(known->is_axis_plane());
    EXPECT_TRUE(fresh->is_axis_plane());
    for (const Plane plane : {*known, *fresh}) {
      const auto& own = plane == *known ? cube.corners[0] : triangle.corners[0];
      EXPECT_EQ(traits.side(*own.vertex, traits.prepare(plane), counts), CGAL::ZERO);
      for (const auto& polygon : {cube, triangle})
        for (const auto& corner : polygon) {
          const Exact_point x = traits.position(*corner.vertex), o = traits.position(*own.vertex);
          EXPECT_EQ(static_cast<int>(traits.side(*corner.vertex, traits.prepare(plane), counts)),
                    sgn(Rational(x[static_cast<std::size_t>(axis)] - o[static_cast<std::size_t>(axis)])));
        }
    }
  }
  const Vertex meet = scene.predicates().meet(traits.supporting_plane(0).id(), traits.supporting_plane(2).id(),
                                              traits.supporting_plane(6).id());
  EXPECT_FALSE(traits.axis_plane(0, meet));
}

TEST(Exact_traits, an_eye_is_on_the_side_that_its_coordinates_say) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 4);
  const Scene scene(soup);
  const Exact_traits traits(scene);
  Predicate_counts counts;
  for (const long x : {-1l, 0l, 1l, 4l, 5l})
    for (std::uint32_t i = 0; i < 6; ++i) {
      const Exact_point eye{Rational(x), Rational(1, 3), Rational(7)};
      EXPECT_EQ(static_cast<int>(traits.side(traits.eye(eye), traits.supporting_plane(i), counts)),
                sgn(value(scene.file_coefficients(traits.supporting_plane(i)), eye)));
    }
}

TEST(Exact_traits, knows_coplanar_faces_and_whether_they_face_alike) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 4);
  add_cube(soup, 4, 0, 0, 4);
  add_cube(soup, 8, 0, 0, 4);
  const Scene scene(soup);
  const Exact_traits traits(scene);
  EXPECT_TRUE(traits.same_plane(traits.supporting_plane(1), traits.supporting_plane(6)));
  EXPECT_FALSE(traits.same_sense(traits.supporting_plane(1), traits.supporting_plane(6)));
  EXPECT_TRUE(traits.same_plane(traits.supporting_plane(5), traits.supporting_plane(11)));
  EXPECT_TRUE(traits.same_sense(traits.supporting_plane(5), traits.supporting_plane(11)));
  EXPECT_FALSE(traits.same_plane(traits.supporting_plane(0), traits.supporting_plane(1)));
}

TEST(Polygon_store, addresses_stay_while_it_grows_and_when_it_is_moved) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 4);
  const Scene scene(soup);
  const Exact_traits traits(scene);
  Polygon_store<Exact_traits> store;
  const auto first = store.piece(traits, 3);
  const std::vector<Exact_point> before = positions(traits, first);
  for (int i = 0; i < 3000; ++i) store.piece(traits, static_cast<std::uint32_t>(i % 6));
  const Polygon_store<Exact_traits> moved = std::move(store);
  EXPECT_EQ(positions(traits, first), before);
}

TEST(Polygon_store, takes_the_lists_that_it_is_given_back_and_no_others) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 4);
  const Scene scene(soup);
  const Exact_traits traits(scene);
  Polygon_store<Exact_traits> store;
  const auto first = store.piece(traits, 0), second = store.piece(traits, 1);
  const std::vector<Exact_point> before = positions(traits, second);
  store.reuse(first);
  EXPECT_EQ(store.piece(traits, 2).corners, first.corners);
  EXPECT_NE(store.piece(traits, 3).corners, second.corners);
  EXPECT_EQ(positions(traits, second), before);
}

// ---- Planes at once

namespace {
/// Every part that cutting a scene by some of its planes makes, to groups of one to six of its planes: as position()
/// says, and as many sides by arithmetic.
void expect_groups_agree(const Scene& scene, Random& random) {
  const Exact_traits traits(scene);
  Polygon_store<Exact_traits> store;
  Split_scratch<Exact_traits> scratch;
  Predicate_counts ignored;
  std::vector<Convex_polygon<Exact_traits>> parts;
  for (std::uint32_t i = 0; i < traits.piece_count(); ++i) parts.push_back(store.piece(traits, i));
  const auto some_plane = [&] {
    const Plane plane = traits.supporting_plane(static_cast<std::uint32_t>(random() % traits.piece_count()));
    return random() % 2 == 0 ? plane : plane.opposite();
  };
  for (int round = 0; round < 4 && traits.piece_count() > 0; ++round) {
    const auto cutter = traits.prepare(some_plane());
    for (std::size_t i = parts.size(); i-- > 0;) {
      if (classify(traits, parts[i], cutter, scratch, ignored) != Position::across) continue;
      const auto halves = split(traits, parts[i], cutter, scratch, store);
      parts[i] = halves[0];
      parts.push_back(halves[1]);
    }
  }
  for (std::size_t size = 1; size <= Plane_group<Exact_traits>::most && !parts.empty(); ++size) {
    std::vector<Plane> planes;
    for (std::size_t k = 0; k < size; ++k) planes.push_back(some_plane());
    if (random() % 2 == 0)
      planes[0] = Plane::across(static_cast<int>(random() % 3), scene.corners(scene.pieces()[0])[0].point);
    Plane_group<Exact_traits> group;
    group.prepare(traits, planes);
    std::vector<Plane_group<Exact_traits>::Positions> found(parts.size());
    Predicate_counts counts;
    group.find(traits, parts, found.data(), counts);
    std::uint64_t sides = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t k = 0; k < size; ++k) {
        ASSERT_EQ(static_cast<Position>(found[i][k]), position(traits, parts[i], traits.prepare(planes[k]), ignored))
            << "part " << i << ", plane " << k << " of " << size;
        sides += parts[i].size;
      }
    }
    EXPECT_EQ(counts.total(), sides);
  }
}
}  // namespace

TEST(Plane_group, finds_the_positions_that_corners_have_one_by_one) {
  Random random(3);
  for (int i = 0; i < sample(200); ++i) {
    SCOPED_TRACE(i);
    const int bits =
        std::array{2, 3, 20, 40, 52}[static_cast<std::size_t>(i % 5)];  // few bits: most corners are on many planes
    expect_groups_agree(Scene(random_soup(random, 12, bits, [](long n) { return static_cast<double>(n); })), random);
    expect_groups_agree(Scene(random_soup(random, 12, bits,
                                          [](long n) {
                                            Rational r(n, 27);
                                            r.canonicalize();
                                            return r;
                                          })),
                        random);
    if (i % 40 > 4) continue;  // each takes as long as twenty of the others
    // The ends of the range of doubles: most coordinates small, so that these have doubles of their own, and a few that
    // are far or fine.
    expect_groups_agree(Scene(random_soup(random, 12, bits,
                                          [](long n) {
                                            return n % 13 == 0   ? std::ldexp(static_cast<double>(n), 970)
                                                   : n % 11 == 0 ? std::ldexp(static_cast<double>(n), -1074)
                                                                 : static_cast<double>(n) / 1024;
                                          })),
                        random);
    expect_groups_agree(
        Scene(random_soup(
            random, 12, bits,
            [](long n) { return n % 13 == 0 ? Rational(exact_decimal(n, 400)) : Rational(exact_decimal(n, -2)); })),
        random);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// ---- Wrong models

namespace {
/// A model that lacks one requirement, by number; none for -1.
template <int Lacks>
struct Model {
  struct Vertex {};
  struct Edge {};
  using Cutter = Plane;
  struct Eye {};
  std::size_t piece_count() const requires(Lacks != 0) { return 0; }
  std::uint32_t face(std::uint32_t) const requires(Lacks != 1) { return 0; }
  Plane supporting_plane(std::uint32_t) const requires(Lacks != 2) { return {}; }
  void append_corners(std::uint32_t, auto) const requires(Lacks != 3) {}
  Cutter prepare(Plane h) const requires(Lacks != 4) { return h; }
  Sign side(const Vertex&, const Cutter&, Predicate_counts&) const requires(Lacks != 5) { return CGAL::ZERO; }
  Vertex meet(std::uint32_t, const Corner<Model>&, const Corner<Model>&, Sign, const Cutter&) const
      requires(Lacks != 6) {
    return {};
  }
  Edge bound(const Cutter&, Sign) const requires(Lacks != 7) { return {}; }
  bool same_plane(Plane, Plane) const requires(Lacks != 8) { return false; }
  bool same_sense(Plane, Plane) const requires(Lacks != 9) { return false; }
  Sign side(const Eye&, Plane, Predicate_counts&) const requires(Lacks != 10) { return CGAL::ZERO; }
  std::optional<Plane> axis_plane(int, const Vertex&) const requires(Lacks != 11) { return {}; }
  double coordinate(const Vertex&, int) const requires(Lacks != 12) { return 0; }
  bool is_input(const Vertex&) const requires(Lacks != 13) { return false; }
};
struct Integer_sides : Model<5> {  // signs as plain integers
  int side(const Vertex&, const Cutter&, Predicate_counts&) const { return 0; }
  Sign side(const Eye&, Plane, Predicate_counts&) const { return CGAL::ZERO; }
  Vertex meet(std::uint32_t, const Corner<Integer_sides>&, const Corner<Integer_sides>&, Sign, const Cutter&) const {
    return {};
  }
};
struct Changing_prepare : Model<4> {  // not const
  Cutter prepare(Plane h) { return h; }
  Vertex meet(std::uint32_t, const Corner<Changing_prepare>&, const Corner<Changing_prepare>&, Sign,
              const Cutter&) const {
    return {};
  }
};
template <int... Lacks>
constexpr bool none_models(std::integer_sequence<int, Lacks...>) {
  return (!Partition_traits<Model<Lacks>> && ...);
}
}  // namespace
static_assert(Partition_traits<Exact_traits> && Partition_traits<Model<-1>>);
static_assert(none_models(std::make_integer_sequence<int, 14>()));
static_assert(!Partition_traits<Integer_sides> && !Partition_traits<Changing_prepare>);
static_assert(!Partition_traits<int> && !Partition_traits<Scene> && !Partition_traits<CGAL::Simple_cartesian<double>>);
