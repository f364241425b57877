// Claims of the generators: counts, closedness, convexity, planarity, and the same scene everywhere.

#include "../sample.h"

#include <sightline/harness/generate/scenes.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/soups.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>

using namespace sightline;
namespace generate = sightline::generate;

namespace {

/// FNV-1a over all that a soup says.
std::uint64_t hash(const Polygon_soup& soup) {
  std::uint64_t h = 14695981039346656037u;
  const auto add = [&](const std::string& text) {
    for (const char c : text + " ") h = (h ^ static_cast<unsigned char>(c)) * 1099511628211u;
  };
  for (std::size_t i = 0; i < soup.coordinates.size(); ++i) add(to_string(soup.coordinates[i]));
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
      for (const Point_id p : soup.loop(f, k)) add(std::to_string(p));
      add("/");
    }
    add(";");
  }
  return h;
}

/// Coordinates times their common denominator.
struct Integer_soup {
  const Polygon_soup& soup;
  std::vector<std::int64_t> c;
  explicit Integer_soup(const Polygon_soup& s) : soup(s), c(s.coordinates.size()) {
    s.coordinates.for_each_scaled(
        s.coordinates.common_denominator(), [&](std::size_t i, std::int64_t n) { c[i] = n; },
        [](std::size_t, const Integer&) { FAIL() << "too large"; });
  }
  using Wide = __int128;
  using Vector = std::array<Wide, 3>;
  Vector point(Point_id p) const { return {c[3 * p], c[3 * p + 1], c[3 * p + 2]}; }
  static Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  static Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static Wide dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  Vector normal(Face_id f) const {
    Vector sum{0, 0, 0};
    const auto loop = soup.loop(f);
    for (std::size_t i = 2; i < loop.size(); ++i) {
      const Vector n = cross(minus(point(loop[i - 1]), point(loop[0])), minus(point(loop[i]), point(loop[0])));
      for (std::size_t k = 0; k < 3; ++k) sum[k] += n[k];
    }
    return sum;
  }
};

/// Every face: indices in range, an area, planar and strictly convex.
void expect_good_faces(const Polygon_soup& soup) {
  const Integer_soup s(soup);
  std::size_t bad = 0;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const auto loop = soup.loop(f);
    ASSERT_EQ(soup.loop_count(f), 1u);
    for (const Point_id p : loop) ASSERT_LT(p, soup.point_count());
    const auto n = s.normal(f);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto a = s.point(loop[i]), b = s.point(loop[(i + 1) % loop.size()]),
                 c = s.point(loop[(i + 2) % loop.size()]);
      const auto corner = Integer_soup::cross(Integer_soup::minus(b, a), Integer_soup::minus(c, b));
      bool parallel_to_normal = false;
      for (std::size_t k = 0; k < 3; ++k) {
        // Same signs as the normal, and proportional to it: the corner's plane is the face's and it turns left.
        if ((corner[k] > 0) != (n[k] > 0) || (corner[k] < 0) != (n[k] < 0)) ++bad;
        parallel_to_normal = parallel_to_normal || corner[k] != 0;
      }
      if (!parallel_to_normal) ++bad;
      if (Integer_soup::dot(n, Integer_soup::minus(b, a)) != 0) ++bad;
    }
  }
  EXPECT_EQ(bad, 0u) << soup.file;
}

bool closed(const Polygon_soup& soup) {
  std::map<std::pair<Point_id, Point_id>, int> balance;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const auto loop = soup.loop(f);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point_id a = loop[i], b = loop[(i + 1) % loop.size()];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

/// Six times the volume that the fronts of a closed soup look out of.
Integer_soup::Wide volume(const Polygon_soup& soup) {
  const Integer_soup s(soup);
  Integer_soup::Wide sum = 0;
  for (Face_id f = 0; f < soup.face_count(); ++f) sum += Integer_soup::dot(s.normal(f), s.point(soup.loop(f)[0]));
  return sum;
}

/// Whether every vertex is on or behind the plane of every face.
bool convex(const Polygon_soup& soup) {
  const Integer_soup s(soup);
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const auto n = s.normal(f);
    const auto level = Integer_soup::dot(n, s.point(soup.loop(f)[0]));
    for (Point_id p = 0; p < soup.point_count(); ++p) {
      const auto here = Integer_soup::dot(n, s.point(p));
      if (here > level) return false;
      if (here == level && std::find(soup.loop(f).begin(), soup.loop(f).end(), p) == soup.loop(f).end())
        return false;  // coplanar neighbour
    }
  }
  return true;
}

}  // namespace

TEST(Generate, random_numbers_are_those_of_the_standard_and_in_range) {
  generate::Random random(5489);
  std::mt19937_64 engine;  // the standard's default seed and its 10000th number
  engine.discard(9999);
  EXPECT_EQ(engine(), 9981545732273789042u);
  std::set<std::int64_t> seen;
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t x = random.between(-3, 3);
    EXPECT_TRUE(-3 <= x && x <= 3);
    seen.insert(x);
  }
  EXPECT_EQ(seen.size(), 7u);
  EXPECT_EQ(random.below(1), 0u);
}

TEST(Generate, cube_root) {
  for (const std::uint64_t n : {0u, 1u, 7u, 8u, 9u, 26u, 27u, 1000000u}) {
    const std::uint64_t r = generate::cube_root(n);
    EXPECT_LE(r * r * r, n);
    EXPECT_GT((r + 1) * (r + 1) * (r + 1), n);
  }
  EXPECT_EQ(generate::cube_root(~std::uint64_t{0}), 2642245u);
}

TEST(Generate, every_kind_has_good_faces_and_is_made_by_name) {
  for (const generate::Kind& kind : generate::kinds()) {
    const Polygon_soup soup = generate::make(kind.name, kind.example_size, 1);
    EXPECT_GT(soup.face_count(), 0u);
    EXPECT_EQ(soup.file, kind.name);
    expect_good_faces(soup);
    for (const std::size_t size : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{4}})
      if (kind.name != "bars" || size >= 3) expect_good_faces(generate::make(kind.name, size, 2));
  }
  EXPECT_THROW(generate::make("dodecahedron", 1, 1), std::invalid_argument);
  EXPECT_THROW(generate::make("bars", 2, 1), std::invalid_argument);
  EXPECT_THROW(generate::make("menger_sponge", 6, 1), std::invalid_argument);
}

TEST(Generate, scenes_are_the_same_everywhere_and_differ_by_seed) {
  // Computed once; a change here is a change of every benchmark and test that starts from a seed.
  const std::map<std::string_view, std::uint64_t> expected{
      {"bars", 2949218905005145629u},
      {"city", 8391980320577071881u},
      {"city_rotated", 4341621242322360003u},
      {"convex_sphere", 15272415975494666540u},
      {"crossing", 15083811948795330693u},
      {"grid", 7038090722155783299u},
      {"lattice", 12077981401367600343u},
      {"menger_sponge", 7480419304083887745u},
      {"menger_sponge_merged", 7925202077407358754u},
      {"rooms", 11635159072090337317u},
      {"slivers", 5933622526260200321u},
      {"soup", 5957434815199489955u},
      {"soup_constant_density", 4547890741699796672u},
      {"stacked", 10648042557059944281u},
      {"terrain", 11350070746479544031u},
      {"triangles_between_squares", 11538573766325856895u},
  };
  for (const generate::Kind& kind : generate::kinds()) {
    const std::uint64_t h = hash(generate::make(kind.name, kind.example_size, 1));
    const auto known = expected.find(kind.name);
    EXPECT_TRUE(known != expected.end() && known->second == h) << "{\"" << kind.name << "\", " << h << "u},";
    const std::set<std::string_view> without_chance{
        "bars", "crossing", "grid", "lattice", "menger_sponge", "menger_sponge_merged", "stacked"};
    const bool random = without_chance.count(kind.name) == 0;
    EXPECT_EQ(h != hash(generate::make(kind.name, kind.example_size, 2)), random) << kind.name;
  }
}

TEST(Generate, triangles_between_squares_are_those_of_the_formula) {
  // The formula in the standard's words. Distributions differ between libraries; this one is meant.
#if defined(__GLIBCXX__)
  for (const std::size_t n : {1u, 10u, 50u})
    for (const std::uint64_t t : {0u, 1u, 39u}) {
      std::mt19937 engine(static_cast<std::uint32_t>(1000 * n + t));
      std::uniform_real_distribution<float> u(-1, 1);
      const Polygon_soup soup = generate::triangles_between_squares(n, t);
      ASSERT_EQ(soup.point_count(), 8 + 3 * n);
      for (std::size_t k = 0; k < n; ++k) {
        float centre[3];
        for (float& c : centre) c = u(engine);
        centre[0] *= 1.2f;
        centre[1] *= 1.2f;
        centre[2] = 5 + 4 * centre[2];
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const Exact_point p = soup.point(soup.loop(static_cast<Face_id>(2 + k))[corner]);
          for (std::size_t i = 0; i < 3; ++i) {
            float x = centre[i] + 1.05f * u(engine);
            if (i == 2) x = std::clamp(x, 0.1f, 9.9f);
            EXPECT_EQ(p[i], exact(double{x})) << n << " " << t << " " << k;
          }
        }
      }
    }
#endif
  // The squares look at each other, and the triangles are strictly between.
  const Polygon_soup soup = generate::triangles_between_squares(3, 0);
  EXPECT_EQ(soup.face_count(), 5u);
  const Integer_soup s(soup);
  EXPECT_GT(s.normal(0)[2], 0);
  EXPECT_LT(s.normal(1)[2], 0);
  std::size_t clamped = 0;
  for (std::uint64_t t = 0; t < 20; ++t) {
    const Polygon_soup many = generate::triangles_between_squares(50, t);
    for (Point_id p = 0; p < many.point_count(); ++p) {
      const Exact_point x = many.point(p);
      EXPECT_EQ(abs(x[0]) == 1 && abs(x[1]) == 1 && x[2] == (p < 4 ? 0 : 10), p < 8);
      if (p < 8) continue;
      EXPECT_TRUE(abs(x[0]) <= 2.25 && abs(x[1]) <= 2.25 && x[2] >= exact(double{0.1f}) && x[2] <= exact(double{9.9f}));
      clamped += x[2] == exact(double{0.1f}) || x[2] == exact(double{9.9f});
    }
  }
  EXPECT_GT(clamped, 0u);
}

TEST(Generate, lattice_of_many_squares_has_its_corners_on_the_edges_of_a_cube) {
  constexpr std::size_t n = 20000;
  const Polygon_soup soup = generate::lattice(n);
  EXPECT_EQ(soup.face_count(), 3 * (n + 1));
  EXPECT_EQ(soup.point_count(), 12 * (n - 1) + 8);  // each once
  for (Face_id f = 0; f < soup.face_count(); f += 1001) {
    const std::size_t axis = f / (n + 1);
    for (std::size_t k = 0; k < 4; ++k) {
      const Exact_point p = soup.point(soup.loop(f)[k]);
      EXPECT_EQ(p[axis], static_cast<long>(f % (n + 1)));
      EXPECT_EQ(p[(axis + 1) % 3], k == 1 || k == 2 ? static_cast<long>(n) : 0);
      EXPECT_EQ(p[(axis + 2) % 3], k >= 2 ? static_cast<long>(n) : 0);
    }
  }
  EXPECT_THROW(generate::lattice(0), std::invalid_argument);
}

TEST(Generate, lattice_and_merged_sponge_have_the_area_of_their_unit_quads) {
  const auto area = [](const Polygon_soup& soup) {  // axis-parallel faces only
    const Integer_soup integers{soup};
    Integer_soup::Wide twice = 0;
    for (Face_id f = 0; f < soup.face_count(); ++f)
      for (const Integer_soup::Wide n : integers.normal(f)) twice += n < 0 ? -n : n;
    return static_cast<long>(twice / 2);
  };
  for (const std::size_t n : {1u, 2u, 5u}) {
    EXPECT_EQ(generate::lattice(n).face_count(), 3 * (n + 1));
    EXPECT_EQ(area(generate::lattice(n)), area(generate::grid(n)));
  }
  for (const std::size_t level : {0u, 1u, 2u}) {
    const Polygon_soup merged = generate::menger_sponge(level, true), unit = generate::menger_sponge(level);
    EXPECT_EQ(area(merged), area(unit));
    EXPECT_EQ(area(merged), static_cast<long>(unit.face_count()));
    if (level == 0) {
      EXPECT_EQ(merged.face_count(), 6u);
    }
    if (level > 0) {
      EXPECT_LE(3 * merged.face_count(), 2 * unit.face_count());
    }
  }
}

TEST(Generate, soup_counts_bounds_and_edge_lengths) {
  for (const double edge : {0.001, 0.1, 1.0}) {
    const Polygon_soup soup = generate::soup(2000, edge, 3);
    EXPECT_EQ(soup.face_count(), 2000u);
    EXPECT_EQ(soup.point_count(), 6000u);
    double sum = 0;
    for (Face_id f = 0; f < soup.face_count(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        const Exact_point a = soup.point(soup.loop(f)[i]), b = soup.point(soup.loop(f)[(i + 1) % 3]);
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_TRUE(a[k] >= 0 && a[k] <= 1);
          square += std::pow(Rational(a[k] - b[k]).get_d(), 2);
        }
        sum += std::sqrt(square);
      }
    const double mean = sum / 6000;
    EXPECT_NEAR(mean / edge, edge < 1 ? 0.9925 : 0.6617, 0.03);  // where edge is 1, corners are anywhere in the cube
    EXPECT_EQ(soup.coordinates.common_denominator(), Integer(1) << 26);
  }
  EXPECT_EQ(generate::soup(50, 0.5, 1, 10).coordinates.common_denominator(), 1024);
  EXPECT_EQ(generate::soup(0, 0.5, 1).face_count(), 0u);
  expect_good_faces(generate::soup(500, 4.0 / 16, 1, 4));  // a coarse grid, where zero areas would be common
  EXPECT_THROW(generate::soup(1, 0.0, 1), std::invalid_argument);
  EXPECT_THROW(generate::soup(1, 1e-9, 1), std::invalid_argument);
  EXPECT_THROW(generate::soup(1, 0.1, 1, 31), std::invalid_argument);
}

TEST(Generate, constant_density_shrinks_edges_with_the_cube_root) {
  const auto mean_extent = [](std::size_t n) {
    const Polygon_soup soup = generate::soup_constant_density(n, 1);
    Rational sum = 0;
    for (Face_id f = 0; f < soup.face_count(); ++f)
      sum += abs(Rational(soup.point(soup.loop(f)[0])[0] - soup.point(soup.loop(f)[1])[0]));
    return sum.get_d() / static_cast<double>(n);
  };
  EXPECT_NEAR(mean_extent(1000) / mean_extent(8000), 2.0, 0.1);
}

TEST(Generate, a_tenth_of_slivers_are_slivers) {
  const Polygon_soup soup = generate::slivers(1000, 7);
  EXPECT_EQ(soup.face_count(), 1000u);
  const Integer_soup s(soup);
  const double step = std::ldexp(1.0, -26);
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const auto loop = soup.loop(f);
    double longest = 0, area = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto edge = Integer_soup::minus(s.point(loop[i]), s.point(loop[(i + 1) % 3]));
      double square = 0;
      for (const auto x : edge) square += std::pow(static_cast<double>(x) * step, 2);
      longest = std::max(longest, std::sqrt(square));
    }
    for (const auto x : s.normal(f)) area += std::pow(static_cast<double>(x) * step * step, 2);
    const double aspect = longest * longest / std::sqrt(area);
    if (f < 900) EXPECT_LT(aspect, 1e6) << f;
    else EXPECT_GT(aspect, 0x1p24) << f;
  }
}

TEST(Generate, terrain_is_a_height_field) {
  for (const std::size_t n : {1u, 2u, 7u, 32u, 1000u}) {
    const Polygon_soup soup = generate::terrain(n, 4);
    EXPECT_GE(soup.face_count(), n);
    const Integer_soup s(soup);
    std::map<std::pair<Point_id, Point_id>, int> edges;
    for (Face_id f = 0; f < soup.face_count(); ++f) {
      EXPECT_GT(s.normal(f)[2], 0);
      for (std::size_t i = 0; i < 3; ++i) {
        const auto loop = soup.loop(f);
        EXPECT_EQ(++edges[std::make_pair(loop[i], loop[(i + 1) % 3])], 1);
      }
    }
    std::size_t open = 0;
    for (const auto& [ends, count] : edges) open += edges.count({ends.second, ends.first}) == 0;
    std::size_t m = 1;
    while (2 * m * m < soup.face_count()) ++m;
    EXPECT_EQ(open, 4 * m);
  }
}

TEST(Generate, convex_sphere_is_exactly_convex_and_closed) {
  for (const std::size_t n : {0u, 1u, 8u, 9u, 16u, 17u, 24u, 32u, 100u, 1000u, test_scenes::sample(10000u)}) {
    const Polygon_soup soup = generate::convex_sphere(n);
    EXPECT_GE(soup.face_count(), std::max<std::size_t>(n, 8));
    EXPECT_LE(static_cast<double>(soup.face_count()),
              static_cast<double>(std::max<std::size_t>(n, 8)) + std::sqrt(8.0 * static_cast<double>(n)));
    EXPECT_TRUE(closed(soup)) << n;
    EXPECT_TRUE(convex(soup)) << n;
    EXPECT_GT(volume(soup), 0);
    expect_good_faces(soup);
  }
  // Near the sphere: all points within 1/100 of it in square.
  const Polygon_soup soup = generate::convex_sphere(1000);
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    const Exact_point x = soup.point(p);
    EXPECT_NEAR(Rational(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).get_d(), 1.0, 0.01);
  }
  // Shuffled: the same faces.
  std::multiset<std::vector<Point_id>> faces, shuffled;
  const Polygon_soup other = generate::convex_sphere(1000, 9);
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    faces.insert({soup.loop(f).begin(), soup.loop(f).end()});
    shuffled.insert({other.loop(f).begin(), other.loop(f).end()});
  }
  EXPECT_EQ(faces, shuffled);
  EXPECT_NE(hash(soup), hash(other));
}

TEST(Generate, circle_points_are_near_the_circle_and_in_order) {
  for (const std::uint64_t n : {1u, 2u, 3u, 4u, 5u, 12u, 100u}) {
    constexpr std::int64_t radius = 1 << 20;
    for (std::uint64_t k = 0; k < n; ++k) {
      const auto p = generate::circle_point(k, n, radius), q = generate::circle_point((k + 1) % n, n, radius);
      EXPECT_LE(std::abs(std::hypot(static_cast<double>(p[0]), static_cast<double>(p[1])) - radius), 1.0);
      if (n >= 3) {
        const double turn =
            std::atan2(static_cast<double>(p[0] * q[1] - p[1] * q[0]), static_cast<double>(p[0] * q[0] + p[1] * q[1]));
        EXPECT_NEAR(turn * static_cast<double>(n) / 6.283185307179586, 1.0, 0.12) << k << " of " << n;
      }
    }
  }
  EXPECT_EQ(generate::circle_point(0, 8, 100), (generate::Lattice_point{100, 0}));
  EXPECT_EQ(generate::circle_point(2, 8, 100), (generate::Lattice_point{0, 100}));
  EXPECT_EQ(generate::circle_point(6, 8, 100), (generate::Lattice_point{0, -100}));
}

TEST(Generate, city_boxes_are_disjoint_boxes_on_the_ground) {
  for (const bool rotated : {false, true}) {
    const std::size_t boxes = 200;
    const Polygon_soup soup = generate::city(boxes, 11, rotated);
    EXPECT_EQ(soup.face_count(), 5 * boxes + 1);
    EXPECT_EQ(soup.point_count(), 8 * boxes + 4);
    expect_good_faces(soup);
    const Integer_soup s(soup);
    std::set<std::pair<Integer, Integer>> cells;
    bool some_turned = false;
    for (std::size_t k = 0; k < boxes; ++k) {
      // All eight corners lie strictly within one unit cell that no other box uses.
      std::set<std::pair<Integer, Integer>> own;
      for (std::size_t i = 0; i < 8; ++i) {
        const Exact_point p = soup.point(static_cast<Point_id>(8 * k + i));
        EXPECT_EQ(sgn(p[2]), i < 4 ? 0 : 1);
        EXPECT_TRUE(p[0].get_den() != 1 && p[1].get_den() != 1);
        own.emplace(Integer(p[0].get_num() / p[0].get_den()), Integer(p[1].get_num() / p[1].get_den()));
        EXPECT_TRUE(p[0] > 0 && p[1] > 0);
      }
      EXPECT_EQ(own.size(), 1u);
      EXPECT_TRUE(cells.insert(*own.begin()).second);
      // With a bottom it is closed, and its angles are right.
      Polygon_soup box;
      box.coordinates = soup.coordinates;
      for (std::size_t f = 5 * k; f < 5 * k + 5; ++f) box.add_face(soup.loop(static_cast<Face_id>(f)));
      const Point_id b = static_cast<Point_id>(8 * k);
      box.add_face({b + 3, b + 2, b + 1, b});
      EXPECT_TRUE(closed(box));
      EXPECT_GT(volume(box), 0);
      const auto u = Integer_soup::minus(s.point(b + 1), s.point(b)),
                 v = Integer_soup::minus(s.point(b + 3), s.point(b));
      EXPECT_EQ(Integer_soup::dot(u, v), 0);
      some_turned = some_turned || u[1] != 0;
    }
    EXPECT_EQ(some_turned, rotated);
    const Integer promised = rotated ? Integer(1024) * 25 * 13 * 17 * 29 : Integer(1024);
    EXPECT_EQ(promised % soup.coordinates.common_denominator(), 0);
  }
  EXPECT_EQ(generate::city(0, 1).face_count(), 1u);
}

TEST(Generate, grid_has_all_walls_once) {
  for (const std::size_t n : {1u, 2u, 5u}) {
    const Polygon_soup soup = generate::grid(n);
    EXPECT_EQ(soup.face_count(), 3 * n * n * (n + 1));
    EXPECT_EQ(soup.point_count(), (n + 1) * (n + 1) * (n + 1));
    std::set<std::set<Point_id>> walls;
    const Integer_soup s(soup);
    for (Face_id f = 0; f < soup.face_count(); ++f) {
      EXPECT_TRUE(walls.insert({soup.loop(f).begin(), soup.loop(f).end()}).second);
      const auto normal = s.normal(f);
      EXPECT_EQ(normal[0] + normal[1] + normal[2], 2);
    }
  }
}

TEST(Generate, menger_sponge_has_the_known_area_and_volume) {
  std::size_t area_20 = 2, area_8 = 4, volume_20 = 1;
  for (std::size_t level = 0; level <= 3; ++level) {
    const Polygon_soup soup = generate::menger_sponge(level);
    EXPECT_EQ(soup.face_count(), area_20 + area_8) << level;
    EXPECT_TRUE(closed(soup));
    EXPECT_EQ(static_cast<std::size_t>(volume(soup)), 6 * volume_20);
    area_20 *= 20;
    area_8 *= 8;
    volume_20 *= 20;
  }
}

TEST(Generate, rooms_are_closed_and_connected) {
  for (const std::uint64_t seed : {1u, 2u, 3u})
    for (const auto& [nx, ny] : {std::pair<std::size_t, std::size_t>{1, 1}, {3, 2}, {6, 7}}) {
      const Polygon_soup soup = generate::rooms(nx, ny, seed);
      EXPECT_TRUE(closed(soup));
      EXPECT_GT(volume(soup), 0);
      expect_good_faces(soup);
      // Every face is reached from the first one across shared edges: one outside with all rooms, no sealed cavity.
      std::map<std::pair<Point_id, Point_id>, std::vector<Face_id>> at;
      for (Face_id f = 0; f < soup.face_count(); ++f)
        for (std::size_t i = 0; i < 4; ++i) at[std::minmax(soup.loop(f)[i], soup.loop(f)[(i + 1) % 4])].push_back(f);
      std::vector<bool> seen(soup.face_count(), false);
      std::vector<Face_id> visit{0};
      seen[0] = true;
      std::size_t count = 0;
      while (!visit.empty()) {
        const Face_id f = visit.back();
        visit.pop_back();
        ++count;
        for (std::size_t i = 0; i < 4; ++i)
          for (const Face_id g : at[std::minmax(soup.loop(f)[i], soup.loop(f)[(i + 1) % 4])])
            if (!seen[g]) {
              seen[g] = true;
              visit.push_back(g);
            }
      }
      EXPECT_EQ(count, soup.face_count());
    }
}

TEST(Generate, bars_form_a_cycle) {
  for (const std::size_t n : {3u, 4u, 5u, 8u, 17u, 100u}) {
    const Polygon_soup soup = generate::bars(n);
    ASSERT_EQ(soup.face_count(), n);
    const Integer_soup s(soup);
    expect_good_faces(soup);
    const auto separated = [&](Face_id f, Face_id g) {  // the projections have disjoint interiors
      for (const auto& [a, b] : {std::pair{f, g}, std::pair{g, f}})
        for (std::size_t i = 0; i < 4; ++i) {
          const auto p = s.point(soup.loop(a)[i]), q = s.point(soup.loop(a)[(i + 1) % 4]);
          bool all = true;
          for (const Point_id r : soup.loop(b)) {
            const auto x = s.point(r);
            all = all && (q[0] - p[0]) * (x[1] - p[1]) <= (q[1] - p[1]) * (x[0] - p[0]);
          }
          if (all) return true;
        }
      return false;
    };
    for (Face_id f = 0; f < n; ++f) {
      EXPECT_GT(s.normal(f)[2], 0);
      for (Face_id g = 0; g < n; ++g) {
        if (f == g) continue;
        const bool next = g == (f + 1) % n, previous = f == (g + 1) % n;
        EXPECT_EQ(separated(f, g), !next && !previous) << f << " " << g << " of " << n;
        if (!next) continue;
        // Where the projections meet f is higher: its end is in front of g's plane, g's beginning behind f's. (Then,
        // with both planes' fronts up, f's height minus g's is positive at f's end and at g's beginning, which holds
        // the meeting.)
        for (const std::size_t i : {1u, 2u})
          EXPECT_GT(
              Integer_soup::dot(s.normal(g), Integer_soup::minus(s.point(soup.loop(f)[i]), s.point(soup.loop(g)[0]))),
              0);
        for (const std::size_t i : {0u, 3u})
          EXPECT_LT(
              Integer_soup::dot(s.normal(f), Integer_soup::minus(s.point(soup.loop(g)[i]), s.point(soup.loop(f)[0]))),
              0);
      }
    }
  }
}

TEST(Generate, crossing_faces_share_a_segment) {
  const std::size_t n = 100;
  const Polygon_soup soup = generate::crossing(n);
  const Integer_soup s(soup);
  ASSERT_EQ(soup.face_count(), n);
  for (Face_id f = 0; f < n; ++f) {
    const auto p = s.point(soup.loop(f)[0]), q = s.point(soup.loop(f)[1]);
    EXPECT_TRUE(p[0] == -q[0] && p[1] == -q[1]);  // the axis is in the middle
    for (Face_id g = 0; g < f; ++g) {
      const auto r = s.point(soup.loop(g)[1]);
      EXPECT_NE(q[0] * r[1], q[1] * r[0]);  // another plane
    }
  }
}

TEST(Generate, stacked_faces_are_parallel) {
  const Polygon_soup soup = generate::stacked(5);
  ASSERT_EQ(soup.face_count(), 5u);
  for (Face_id f = 0; f < 5; ++f)
    for (const Point_id p : soup.loop(f)) EXPECT_EQ(soup.point(p)[2] * 1024, f);
}

TEST(Generate, hundred_thousands_of_faces_take_no_time) {
  for (const auto& [kind, full] : {std::pair<std::string_view, std::size_t>{"soup", 1000000},
                                   {"soup_constant_density", 1000000},
                                   {"terrain", 1000000},
                                   {"city", 200000},
                                   {"city_rotated", 20000},
                                   {"convex_sphere", 100000},
                                   {"convex_sphere", 1000000},
                                   {"grid", 69},
                                   {"menger_sponge", 4},
                                   {"rooms", 60}}) {
    const std::size_t size = 1 + test_scenes::sample(full);
    const auto start = std::chrono::steady_clock::now();
    const Polygon_soup soup = generate::make(kind, size, 1);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("  %-22s %8zu faces %8zu points %.2f s, common denominator of %zu bits\n", std::string(kind).c_str(),
                soup.face_count(), soup.point_count(), seconds, bit_length(soup.coordinates.common_denominator()));
    EXPECT_LT(seconds, 60);  // generous: sanitizers and shared machines
  }
}
