// What is lit, in penumbra and in umbra: by hand, and against what an eye sees from points of the face.
// SIGHTLINE_LONG: so many times the scenes, for a long run.

#include "rays.h"
#include "scenes.h"
#include "../sample.h"

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/weak_visibility/partition/merged_occluders.h>
#include <sightline/algorithms/weak_visibility/partition/partition.h>
#include <sightline/harness/laws/weak_partition.h>
#include <sightline/io/read.h>

#include <gtest/gtest.h>

#include <cmath>

namespace weak_partition {
namespace {

using namespace sightline;
using generate::Random;
using weak_scenes::Faces;
using weak_scenes::Points;
using weak_scenes::ratio;
using weak_scenes::reversed;
using weak_scenes::soup_of;

Exact_point at(Rational x, Rational y, Rational z) { return {std::move(x), std::move(y), std::move(z)}; }
/// From a corner, along two sides.
Points parallelogram(const Exact_point& corner, const Exact_point& u, const Exact_point& v) {
  const Exact_point next = oracle::along(corner, 1, u);
  return {corner, next, oracle::along(next, 1, v), oracle::along(corner, 1, v)};
}

Exact_point area_vector(const Points& polygon) {
  Exact_point sum{0, 0, 0};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Exact_point part =
        oracle::cross(oracle::minus(polygon[i], polygon[0]), oracle::minus(polygon[i + 1], polygon[0]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return sum;
}

/// What an eye sees of a source: another algorithm, on the scene with the source as its first face.
class Eyes {
 public:
  Eyes(const Polygon_soup& soup, const Points& source) : source_(area_vector(source)) {
    std::vector<Point_id> ids;
    for (const Exact_point& p : source) ids.push_back(with_.add_point(p[0], p[1], p[2]));
    with_.add_face(ids);
    for (Point_id p = 0; p < soup.point_count(); ++p) {
      const Exact_point at = soup.point(p);
      with_.add_point(at[0], at[1], at[2]);
    }
    for (Face_id f = 0; f < soup.face_count(); ++f) {
      const auto shifted = [&](std::size_t loop) {
        std::vector<Point_id> own;
        for (const Point_id p : soup.loop(f, loop)) own.push_back(p + static_cast<Point_id>(source.size()));
        return own;
      };
      with_.add_face(shifted(0));
      for (std::size_t k = 1; k < soup.loop_count(f); ++k) with_.add_hole(shifted(k));
    }
    scene_.emplace(with_);
    boxes_.emplace(*scene_);
  }

  /// `front`: the side of the face's plane that counts.
  Light light_at(const Exact_point& eye, const weak_oracle::Half_space& front) const {
    const Exact_view view(*scene_, eye);
    Visible_options options;
    options.threads = 1;
    const auto surface = visible_surface(view, *boxes_, options);
    Rational seen = 0;
    for (const auto& part : surface.parts) {
      if (part.piece == surface.nothing || scene_->pieces()[part.piece].face != 0 ||
          view.eye_side(part.piece) != CGAL::POSITIVE)
        continue;
      // In front of the face.
      Points polygon = vertices(view, surface, part), kept;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Exact_point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const Rational a = front.height(p), b = front.height(q);
        if (a >= 0) kept.push_back(p);
        if (sgn(a) * sgn(b) < 0) kept.push_back(oracle::along(p, a / (a - b), oracle::minus(q, p)));
      }
      if (kept.size() >= 3) seen += oracle::dot(area_vector(kept), source_);
    }
    return seen == 0 ? Light::umbra : seen == oracle::dot(source_, source_) ? Light::lit : Light::penumbra;
  }

 private:
  Exact_point source_;
  Polygon_soup with_;
  std::optional<Scene> scene_;
  std::optional<Piece_boxes> boxes_;
};

struct Tally {
  std::array<std::size_t, lights> points{};
  std::size_t conics = 0, cells = 0, borders = 0, edges = 0;
};

/// Each cell's point, and points at random, are as the eye says; shares add up to one.
void expect_right(const Polygon_soup& soup, const Points& source, Face_id face, std::size_t samples, Random& random,
                  Tally& tally, bool all_borders = false) {
  const Scene scene(soup);
  const Light_partitioner partitioner(scene);
  const Eyes eyes(soup, source);
  Partition_options options;
  options.all_borders = all_borders;
  for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
    if (scene.pieces()[piece].face != face) continue;
    Partition_counters counters;
    const Light_partition found = partitioner.partition(piece, {source}, options, counters);
    const std::array<Rational, 4> h = scene.file_coefficients(scene.pieces()[piece].support);
    const weak_oracle::Half_space front{{h[0], h[1], h[2]}, Rational(-h[3])};
    const auto point = [&](const Rational& x, const Rational& y) {
      return oracle::along(oracle::along(found.chart[0], x, found.chart[1]), y, found.chart[2]);
    };
    for (const Light_partition::Cell& cell : found.cells) {
      const Exact_point p = point(cell.at[0], cell.at[1]);
      EXPECT_EQ(cell.light, eyes.light_at(p, front)) << "face " << face;
      if (all_borders) {
        ASSERT_EQ(cell.edges.size(), 1u);
        EXPECT_EQ(harness::flaw_of_edges(scene, piece, source, p, cell.edges[0]), "") << "face " << face;
        tally.edges += cell.edges[0].size();
      }
      const std::size_t there = found.cell_at(cell.at[0], cell.at[1]);
      if (there != Light_partition::none && cell.area.low > 1e-6) {
        EXPECT_EQ(&cell, &found.cells[there]) << "face " << face;
      }
      EXPECT_LE(cell.area.low, cell.area.high);
      EXPECT_GT(cell.area.high, 0);
    }
    double low = 0, high = 0;
    for (const Bounded& share : found.shares()) {
      low += share.low;
      high += share.high;
    }
    EXPECT_LE(low, 1.0);
    EXPECT_GE(high, 1.0);
    EXPECT_LT(high - low, 1e-6);
    for (std::size_t k = 0; k < samples; ++k) {
      const Rational x = ratio(2 * static_cast<long>(random.below(1 << 20)) + 1, 1 << 21),
                     y = ratio(2 * static_cast<long>(random.below(1 << 20)) + 1, 1 << 21);
      const std::size_t cell = found.cell_at(x, y);
      if (cell == Light_partition::none) continue;
      const Light light = eyes.light_at(point(x, y), front);
      EXPECT_EQ(found.cells[cell].light, light) << "face " << face << " at " << x << ", " << y;
      if (all_borders) {
        EXPECT_EQ(harness::flaw_of_edges(scene, piece, source, point(x, y), found.cells[cell].edges[0]), "")
            << "face " << face << " at " << x << ", " << y;
      }
      ++tally.points[static_cast<std::size_t>(light)];
    }
    tally.cells += found.cells.size();
    for (const Light_partition::Border& border : found.borders)
      if (border.below != Light_partition::none && border.above != Light_partition::none) {
        ++tally.borders;
        tally.conics += !found.curves[border.curve].is_line();
      }
  }
}

// ---- By hand

void expect_share(const Bounded& share, const Rational& exact_share) {
  EXPECT_LE(exact(share.low), exact_share);
  EXPECT_GE(exact(share.high), exact_share);
  EXPECT_LT(share.high - share.low, 1e-9);
}

Light_partition partition_of(const Polygon_soup& soup, const Points& source, std::uint32_t piece) {
  const Scene scene(soup);
  Partition_counters counters;
  return Light_partitioner(scene).partition(piece, {source}, {}, counters);
}

/// A floor of side 8, a square lamp of side 1 four above its middle, looking down, and a square table between.
Polygon_soup table(const Rational& half, const Rational& height) {
  Faces faces;
  faces.push_back(parallelogram(at(-4, -4, 0), at(8, 0, 0), at(0, 8, 0)));
  faces.push_back(parallelogram({-half, -half, height}, {2 * half, 0, 0}, {0, 2 * half, 0}));
  return soup_of(faces);
}
Points lamp() { return reversed(parallelogram({ratio(-1, 2), ratio(-1, 2), 4}, at(1, 0, 0), at(0, 1, 0))); }

TEST(Partition_by_hand, a_square_table_under_a_square_lamp) {
  // From a corner of the lamp at s, the table's edge at 1, one above the floor, throws its shadow to s + (1 - s) 4 / 3.
  const Light_partition found = partition_of(table(1, 1), lamp(), 0);
  const auto shares = found.shares();
  expect_share(shares[2], ratio(49, 9) / 64);  // (7 / 3)^2
  expect_share(shares[0], 1 - ratio(9, 64));   // 3^2
  expect_share(shares[1], ratio(9, 64) - ratio(49, 9) / 64);
  EXPECT_EQ(found.cells.size(), 3u);
}

TEST(Partition_by_hand, a_small_table_leaves_no_umbra_and_a_touching_one_hides_what_it_covers) {
  const auto small = partition_of(table(ratio(1, 16), 1), lamp(), 0).shares();
  EXPECT_EQ(small[2].high, 0);
  // s + (1 / 16 - s) 4 / 3 at s = -1 / 2: 1 / 4; so a square of side 1 / 2.
  expect_share(small[1], ratio(1, 256));
  const auto lying = partition_of(table(1, 0), lamp(), 0).shares();
  expect_share(lying[0], 1);  // what lies in the face's plane hides nothing of what is in front of it
}

TEST(Partition_by_hand, a_floor_so_small_beside_the_scene_that_its_width_is_no_double_has_its_shadows) {
  // Of a lamp from x = a on, a plate from x = a / 2 on halfway to it hides all where x >= 0, and not quite all beyond.
  // Two triangles out of the way make lines that meet the floor's plane far from it.
  const double low = 0x1.9c07541e29fecp+658, high = 0x1.0eff55b252443p+660, up = 0x1.83239efebeaaap+660,
               x = 0x1.fc2e6a5d64bf1p+662, y = 0x1.c9d2294750502p+662, z = 0x1.f8c110fc0b67cp+661, small = 0x1p-440;
  const auto point = [](double px, double py, double pz) { return Exact_point{exact(px), exact(py), exact(pz)}; };
  const auto level = [&](double x0, double x1, double y0, double y1, double pz) {
    return Points{point(x0, y0, pz), point(x1, y0, pz), point(x1, y1, pz), point(x0, y1, pz)};
  };
  Faces faces{level(-small, 2 * small, -small, small, 0), level(low / 2, 2 * high, -up, 2 * up, up / 2)};
  for (const double far : {z, -z}) faces.push_back({point(x, 0, far), point(x, y, far), point(0.75 * x, y, far)});
  const auto shares = partition_of(soup_of(faces), reversed(level(low, high, low, high, up)), 0).shares();
  EXPECT_EQ(shares[0].high, 0);
  expect_share(shares[1], ratio(1, 3));
  expect_share(shares[2], ratio(2, 3));
}

/// Level in z = 2, halfway to the lamp, from x = low to x = high, and far beyond the floor along y.
Points plate(const Rational& low, const Rational& high) {
  return parallelogram({low, -20, 2}, {high - low, 0, 0}, {0, 40, 0});
}
Polygon_soup plates(const std::vector<std::array<Rational, 2>>& all) {
  Faces faces;
  faces.push_back(parallelogram(at(-4, -4, 0), at(8, 0, 0), at(0, 8, 0)));
  for (const auto& [low, high] : all) faces.push_back(plate(low, high));
  return soup_of(faces);
}

TEST(Partition_by_hand, a_box_on_the_floor_throws_the_shadow_of_its_top_and_none_of_its_own) {
  // A segment to the lamp that is beside the box at the height of its top is beside it all along.
  const Polygon_soup soup = read_scene(std::string(SIGHTLINE_SOURCE_DIR) + "/tests/corpus/general/box_on_floor.off");
  const Light_partition found = partition_of(soup, lamp(), 0);
  const auto shares = found.shares();
  expect_share(shares[2], ratio(49, 9) / 64);  // as under the table, and what the box stands on is within
  expect_share(shares[0], 1 - ratio(9, 64));
  EXPECT_EQ(found.cells.size(), 3u);
  EXPECT_EQ(found.borders.size() + found.uprights.size(), 8u);  // the sides of two squares
}

TEST(Partition_by_hand, a_square_lamp_over_an_edge_goes_down_over_a_strip) {
  // From x the lamp's point at s is seen past the edge at 0 iff (x + s) / 2 < 0.
  const Light_partition found = partition_of(plates({{0, 20}}), lamp(), 0);
  const auto shares = found.shares();
  expect_share(shares[0], ratio(7, 16));  // x < -1 / 2
  expect_share(shares[1], ratio(1, 8));
  expect_share(shares[2], ratio(7, 16));  // x > 1 / 2
  EXPECT_EQ(found.cells.size(), 3u);
}

TEST(Partition_by_hand, a_slit_shows_all_of_the_lamp_where_it_is_wide_enough) {
  // From x the lamp's point at s is seen through a slit of half the width w iff |x + s| < 2 w.
  const Light_partition wide = partition_of(plates({{-20, ratio(-1, 2)}, {ratio(1, 2), 20}}), lamp(), 0);
  expect_share(wide.shares()[0], ratio(1, 8));  // |x| < 1 / 2
  expect_share(wide.shares()[1], ratio(1, 4));  // |x| < 3 / 2
  expect_share(wide.shares()[2], ratio(5, 8));
  EXPECT_EQ(wide.cells.size(), 5u);
  const Light_partition narrow = partition_of(plates({{-20, ratio(-1, 8)}, {ratio(1, 8), 20}}), lamp(), 0);
  EXPECT_EQ(narrow.shares()[0].high, 0);
  expect_share(narrow.shares()[1], ratio(3, 16));  // |x| < 3 / 4
  expect_share(narrow.shares()[2], ratio(13, 16));
  EXPECT_EQ(narrow.cells.size(), 3u);
  const Light_partition closed = partition_of(plates({{-20, 0}, {0, 20}}), lamp(), 0);  // of no width
  expect_share(closed.shares()[2], 1);
  EXPECT_EQ(closed.cells.size(), 1u);
}

TEST(Partition_by_hand, half_of_a_face_behind_the_source_is_dark) {
  // A wall with a lamp in the plane that halves it.
  Faces faces;
  faces.push_back(parallelogram(at(0, 0, 0), at(0, 4, 0), at(0, 0, 4)));  // in x = 0, looks along x
  const Points looks_up = parallelogram({1, 1, 2}, at(1, 0, 0), at(0, 1, 0));
  const auto shares = partition_of(soup_of(faces), looks_up, 0).shares();
  expect_share(shares[0], ratio(1, 2));
  expect_share(shares[2], ratio(1, 2));
}

TEST(Partition_by_hand, a_source_across_the_plane_of_the_face_is_never_seen_whole) {
  Faces faces;
  faces.push_back(parallelogram(at(0, 0, 0), at(4, 0, 0), at(0, 4, 0)));
  const Points across = parallelogram(at(-1, 0, -1), at(0, 1, 0), at(0, 0, 2));  // looks along x
  const auto shares = partition_of(soup_of(faces), across, 0).shares();
  expect_share(shares[1], 1);
}

TEST(Partition_by_hand, shares_of_a_face_of_several_pieces_are_those_of_all_of_it) {
  // An L in x = 0, of area 8; what is above z = 1 / 3, its foot but a third, is lit.
  const Faces faces{{at(0, 0, 0), at(0, 6, 0), at(0, 6, 1), at(0, 1, 1), at(0, 1, 3), at(0, 0, 3)}};
  const Scene scene(soup_of(faces));
  ASSERT_EQ(scene.pieces().size(), 2u);
  const Points looks_up = parallelogram({1, 1, ratio(1, 3)}, at(1, 0, 0), at(0, 1, 0));
  std::vector<Light_partition> pieces;
  Partition_counters counters;
  const Light_partitioner partitioner(scene);
  for (std::uint32_t piece = 0; piece < 2; ++piece)
    pieces.push_back(partitioner.partition(piece, {looks_up}, {}, counters));
  const auto shares = shares_of_face(scene, pieces);
  expect_share(shares[0], ratio(3, 4));
  expect_share(shares[2], ratio(1, 4));
  EXPECT_LT(shares[0].high - shares[0].low, 0x1p-45);
}

TEST(Partition_by_hand, a_face_too_thin_for_areas_in_doubles_is_lit_as_what_is_not_dark) {
  // Of its cells, which are all lit, none has an area that doubles tell.
  Polygon_soup soup;
  soup.add_point(0, 0, 0);
  soup.add_point(3, 1, 0);
  soup.add_point(1, Rational("4503599627370499/13510798882111488"), 0);
  soup.add_face(std::vector<Point_id>{0, 1, 2});
  const auto shares = partition_of(soup, {at(0, 0, 5), at(0, 1, 5), at(1, 0, 5)}, 0).shares();
  EXPECT_EQ(shares[0].low, 1);
  EXPECT_EQ(shares[0].high, 1);
  for (const std::size_t light : {1, 2, 3}) EXPECT_EQ(shares[light].high, 0);
}

TEST(Partition_by_hand, a_face_that_is_bent_has_the_areas_of_its_triangles) {
  // Whichever diagonal bends it, the triangles have other areas than their shadows in z = 0; a lamp below sees none.
  const Faces faces{{at(0, 0, 0), at(4, 0, 0), at(4, 3, 0), at(0, 3, 4)}};
  const Scene scene(soup_of(faces));
  ASSERT_EQ(scene.pieces().size(), 2u);
  const Points looks_along_x = parallelogram(at(1, -9, 9), at(0, 1, 0), at(0, 0, 1));  // lights what is beyond x = 1
  std::vector<Light_partition> pieces;
  Partition_counters counters;
  double whole = 0, lit = 0;
  for (std::uint32_t piece = 0; piece < 2; ++piece) {
    pieces.push_back(Light_partitioner(scene).partition(piece, {looks_along_x}, {}, counters));
    const Points corners = scene.corner_points(scene.pieces()[piece]);
    const Exact_point n = area_vector(corners);
    const double area = std::sqrt(Rational(oracle::dot(n, n)).get_d());
    whole += area;
    lit += area * pieces.back().shares()[0].high;
  }
  const Bounded share = shares_of_face(scene, pieces)[0];
  EXPECT_GT(share.low, 0.1);
  EXPECT_NEAR(share.low, lit / whole, 1e-12);
  EXPECT_NEAR(share.high, lit / whole, 1e-12);
  EXPECT_NE(pieces[0].shares()[0].high, pieces[1].shares()[0].high);
}

// ---- Against the eye

TEST(Partition, is_as_the_eye_says_in_all_families) {
  Tally tally;
  Random random(7);
  for (const weak_scenes::Family& family : weak_scenes::families())
    for (std::uint64_t seed = 0; seed < weak_scenes::seeds(test_scenes::is_sanitized() ? 1 : 2); ++seed) {
      const weak_scenes::Weak_scene scene = family.make(seed);
      SCOPED_TRACE(scene.name);
      for (const Face_id face : scene.targets) expect_right(scene.soup, scene.source, face, 6, random, tally);
    }
  EXPECT_GT(tally.points[0] + tally.points[1] + tally.points[2], test_scenes::least(400u));
  EXPECT_GT(tally.points[1], test_scenes::least(40u));
  EXPECT_GT(tally.points[2], test_scenes::least(40u));
}

/// Triangles at random between a lamp and a floor.
Polygon_soup triangles(Random& random, long count, long size) {
  Faces faces;
  faces.push_back(parallelogram(at(0, 0, 0), at(16, 0, 0), at(0, 16, 0)));
  for (long k = 0; k < count; ++k) {
    const auto coordinate = [&](long low, long high) { return low + static_cast<long>(random.below(high - low + 1)); };
    const long x = coordinate(3, 13), y = coordinate(3, 13), z = coordinate(3, 9);
    Points corners;
    for (int n = 0; n < 3; ++n) {
      const long dx = coordinate(-size, size), dy = coordinate(-size, size), dz = coordinate(-2, 2);
      corners.push_back(at(x + dx, y + dy, z + dz));
    }
    faces.push_back(corners);
  }
  return soup_of(faces);
}

TEST(Partition, of_floors_under_triangles_has_conics_and_is_as_the_eye_says) {
  Tally tally;
  const bool sanitized = test_scenes::is_sanitized();
  const std::uint64_t first = sanitized ? 5 : 4, seeds = sanitized ? 1 : 8;  // 5: points of all kinds, and conics
  for (std::uint64_t seed = first; seed < first + weak_scenes::seeds(seeds); ++seed) {
    Random random(seed);  // 11: a point of a sector in the plane of a triangle
    const Polygon_soup soup = triangles(random, sanitized ? 5 : 8, 6);
    SCOPED_TRACE(seed);
    expect_right(soup, reversed(parallelogram(at(6, 6, 12), at(4, 0, 0), at(0, 4, 0))), 0, 40, random, tally);
  }
  EXPECT_GT(tally.conics, test_scenes::least(4u));
  EXPECT_GT(tally.points[2], test_scenes::least(10u));
}

TEST(Partition, of_a_floor_under_bars_is_as_the_eye_says_from_ten_thousand_points) {
  Tally tally;
  Random random(17);
  const Points lamp = reversed(parallelogram(at(-1, -1, 9), at(2, 0, 0), at(0, 2, 0)));
  const std::size_t samples = test_scenes::sample(std::size_t{10000});
  expect_right(read_scene(std::string(SIGHTLINE_SOURCE_DIR) + "/tests/corpus/general/bars_over_floor.off"), lamp, 0,
               samples, random, tally);
  const std::size_t asked = tally.points[0] + tally.points[1] + tally.points[2];
  EXPECT_GT(asked, samples - samples / 100);  // what is on a border, or beside an end of one, is not asked
  // As many of each as its share of the floor says: 13.0, 56.2 and 30.8 %.
  const double count = static_cast<double>(asked);
  for (const auto& [points, share] :
       {std::pair(tally.points[0], 0.12964), {tally.points[1], 0.56212}, {tally.points[2], 0.30823}})
    EXPECT_NEAR(static_cast<double>(points) / count, share, 4 * std::sqrt(share * (1 - share) / count));
}

TEST(Partition, of_narrow_sectors_in_the_plane_of_a_wall_ends) {
  // An upright wall whose plane goes through the middle of a sector narrower than 2^-12 of the floor.
  const Rational x = ratio(1365, 256), s = ratio(5, 512);
  Faces faces{parallelogram(at(0, 0, 0), at(16, 0, 0), at(0, 16, 0)),
              {at(x, 7, 2), at(x, 9, 2), at(x, 9, 4), at(x, 7, 4)}};
  const Points lamp = reversed(parallelogram(at(x - s, 6, 12), at(2 * s, 0, 0), at(0, 4, 0)));
  Tally tally;
  Random random(1);
  expect_right(soup_of(faces), lamp, 0, 20, random, tally);
}

TEST(Partition, with_all_borders_is_the_same_in_more_cells) {
  Tally few, many;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    Random random(seed), again(seed);
    const Polygon_soup soup = triangles(random, 3, 6);
    const Points source = reversed(parallelogram(at(6, 6, 12), at(4, 0, 0), at(0, 4, 0)));
    expect_right(soup, source, 0, 0, again, few);
    expect_right(soup, source, 0, 20, again, many, true);
  }
  EXPECT_GT(many.cells, few.cells);
  EXPECT_GT(many.edges, 3 * many.cells);
}

TEST(Partition, with_all_borders_names_the_edges_that_brute_force_finds) {
  Tally tally;
  Random random(9);
  for (const weak_scenes::Family& family : weak_scenes::families())
    for (std::uint64_t seed = 0; seed < weak_scenes::seeds(test_scenes::is_sanitized() ? 1 : 2); ++seed) {
      const weak_scenes::Weak_scene scene = family.make(seed);
      if (const Scene prepared(scene.soup); prepared.pieces().size() > 8) continue;
      SCOPED_TRACE(scene.name);
      expect_right(scene.soup, scene.source, scene.targets.front(), 4, random, tally, true);
    }
  EXPECT_GT(tally.edges, test_scenes::least(400u));
}

TEST(Partition, has_edges_of_each_source_by_its_number) {
  // The first lamp looks away; the second one is whole over the first rows, where its own four edges bound it.
  Partition_options options;
  options.all_borders = true;
  Partition_counters counters;
  const Scene scene(table(1, 1));
  const auto cells = Light_partitioner(scene).partition(0, {reversed(lamp()), lamp()}, options, counters).cells;
  bool some = false;
  for (const Light_partition::Cell& cell : cells) {
    ASSERT_EQ(cell.edges.size(), 2u);
    EXPECT_TRUE(cell.edges[0].empty());
    EXPECT_NE(cell.light, Light::lit);
    some |= cell.edges[1].size() == 4;
  }
  EXPECT_TRUE(some);
}

TEST(Partition, without_time_is_undecided) {
  Partition_options options;
  options.out_of_time = [] { return true; };
  Partition_counters counters;
  const Polygon_soup soup = table(1, 1);
  const Scene scene(soup);
  expect_share(Light_partitioner(scene).partition(0, {lamp()}, options, counters).shares()[3], 1);
}

/// Points of a parabola and the chord between its ends.
Polygon_soup parabola(int corners) {
  Polygon_soup soup;
  std::vector<Point_id> loop;
  for (int x = 0; x < corners; ++x) loop.push_back(soup.add_point(x, x * x, 0));
  soup.add_face(loop);
  return soup;
}

TEST(Partition, of_a_face_with_a_thousand_corners_is_one_cell_in_time) {
  // Hours where the lines of all edges were arranged, and no end to it by what asks for the time.
  const Scene scene(parabola(test_scenes::is_sanitized() ? 200 : 1000));
  const Light_partitioner partitioner(scene);
  Partition_counters counters;
  for (const bool is_over : {false, true}) {
    Partition_options options;
    options.out_of_time = [&] { return is_over; };
    const Light_partition found = partitioner.partition(0, {lamp()}, options, counters);
    ASSERT_EQ(found.cells.size(), 1u);
    EXPECT_EQ(found.cells[0].light, is_over ? Light::undecided : Light::lit);
    EXPECT_EQ(found.cells[0].area.low, 1);
  }
}

TEST(Partition, of_a_round_floor_under_a_table_is_as_the_eye_says) {
  Random random(11);
  Points round{at(-4, 0, 0)};
  for (long k = -15; k <= 15; ++k) {
    const Rational t = ratio(k, 5), w = 1 + t * t;
    round.push_back({4 * (1 - t * t) / w, 8 * t / w, 0});
  }
  Faces faces{round, parallelogram(at(-1, -1, 1), at(2, 0, 0), at(0, 2, 0))};
  for (const bool all_borders : {false, true}) {
    Tally tally;
    expect_right(soup_of(faces), lamp(), 0, 100, random, tally, all_borders);
    for (std::size_t light = 0; light < 3; ++light) EXPECT_GT(tally.points[light], 0u);
  }
}

TEST(Partition, that_time_ends_says_nothing_else_than_the_whole_one) {
  Random random(5);
  const Polygon_soup soup = triangles(random, 4, 6);
  const Points source = reversed(parallelogram(at(6, 6, 12), at(4, 0, 0), at(0, 4, 0)));
  const Scene scene(soup);
  const Light_partitioner partitioner(scene);
  Partition_counters counters;
  Partition_options options;
  std::size_t calls = 0, end = 0, decided = 0, open = 0;
  options.out_of_time = [&] { return ++calls == end; };  // once: the next time it is asked there is time again
  const Light_partition whole = partitioner.partition(0, {source}, options, counters);
  const std::size_t all = calls;
  ASSERT_GT(all, 20u);
  EXPECT_GT(all, 2 * counters.boxes);  // within rectangles too
  for (std::size_t k = 0; k < 24; ++k) {
    calls = 0;
    end = 1 + k * (all - 1) / 23;
    const auto shares = partitioner.partition(0, {source}, options, counters).shares();
    for (std::size_t light = 0; light < 3; ++light) {
      EXPECT_LE(shares[light].low, whole.shares()[light].high) << end;
      decided += shares[light].low > 0;
    }
    open += shares[3].low > 0;
  }
  EXPECT_GT(decided, 3u);
  EXPECT_GT(open, 20u);
}

// ---- The arrangement

TEST(Merged_pieces, of_a_fan_of_thousands_of_triangles_are_one_in_time) {
  // Of a polygon between a parabola and a chord: a minute where each step took what the polygon so far has of corners.
  const int n = test_scenes::is_sanitized() ? 1000 : 20000;
  Polygon_soup soup;
  for (int x = 0; x < n; ++x) soup.add_point(x, x * x, 0);
  for (Point_id k = 1; k + 1 < soup.point_count(); ++k) soup.add_face(std::vector<Point_id>{0, k, k + 1});
  const Polygon_soup merged = merged_pieces(Scene(soup));
  ASSERT_EQ(merged.face_count(), 1u);
  EXPECT_EQ(merged.loop(0).size(), soup.point_count());
}

TEST(Curve_arrangement, of_a_circle_and_a_line_has_their_areas) {
  // (x - 1/2)^2 + (y - 1/2)^2 = 1/16, and y = x.
  const std::vector<Plane_curve> curves{{{7, -16, -16, 16, 0, 16}}, {{0, -1, 1, 0, 0, 0}}};
  const Curve_arrangement found(curves, {0, 1, 0, 1});
  const auto bounds = [&](int halvings) {
    double low = 0, high = 0;
    for (std::size_t s = 0; s < found.slabs().size(); ++s)
      for (const Curve_arrangement::Arc& arc : found.slabs()[s].arcs) {
        if (arc.curve != 0) continue;
        const Bounded area = found.area_below(arc, s, halvings);
        low += arc.upper ? area.low : -area.high;
        high += arc.upper ? area.high : -area.low;
      }
    return Bounded{low, high};
  };
  const double circle = std::acos(-1.0) / 16;
  for (const auto& [halvings, apart] : {std::pair(14, 1e-6), {4, 0.02}, {0, 1.0}}) {
    const Bounded area = bounds(halvings);
    EXPECT_LE(area.low, circle) << halvings;
    EXPECT_GE(area.high, circle) << halvings;
    EXPECT_LT(area.high - area.low, apart) << halvings;
  }
  for (const Curve_arrangement::Slab& slab : found.slabs())
    for (std::size_t k = 0; k < slab.y.size(); ++k)
      for (const Plane_curve& curve : curves) EXPECT_NE(curve.sign(slab.x, slab.y[k]), 0);
}

TEST(Real_root, equal_ones_of_different_polynomials_are_one) {
  std::vector<Real_root> roots;
  append_real_roots({-1, 0, 2}, 0, 1, roots);        // 2 x^2 = 1
  append_real_roots({1, 0, -4, 0, 4}, 0, 1, roots);  // its square
  append_real_roots({0, -1, 0, 2}, -1, 1, roots);    // x (2 x^2 - 1)
  append_real_roots({-1, 0, 0, 2}, 0, 1, roots);     // 2 x^3 = 1
  sort_distinct(roots);
  ASSERT_EQ(roots.size(), 4u);  // -sqrt(1/2), 0, sqrt(1/2), cube root
  EXPECT_EQ(compare(roots[0], roots[1]), -1);
  EXPECT_EQ(compare(roots[3], roots[2]), 1);
}

TEST(Real_root, of_two_near_ones_only_one_is_the_others) {
  const Integer half = Integer(1) << 39, whole = Integer(1) << 40;
  std::vector<Real_root> near, one;  // 1/2 - 2^-40 and 1/2 + 2^-40; and the second with -3
  append_real_roots({Integer((Integer(1) << 78) - 1), Integer(-(Integer(1) << 80)), Integer(Integer(1) << 80)}, 0, 1,
                    near);
  append_real_roots({Integer(-3 * (half + 1)), Integer(3 * whole - half - 1), whole}, Rational(1, 4), 1, one);
  ASSERT_EQ(near.size(), 2u);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(compare(near[0], one[0]), -1);
  EXPECT_EQ(compare(near[1], one[0]), 0);
}

TEST(Plane_curve, falls_apart_into_lines_over_the_rationals) {
  // (x + 2 y - 1)(3 x - y + 2), (x - 1)(y + x), (2 x - 1)(x + 3), and x^2 - 2 y^2, which does not.
  EXPECT_EQ(components({{-2, -1, 5, 3, 5, -2}}).size(), 2u);
  EXPECT_EQ(components({{0, -1, -1, 1, 1, 0}}).size(), 2u);
  EXPECT_EQ(components({{-3, 5, 0, 2, 0, 0}}).size(), 2u);
  EXPECT_EQ(components({{0, 0, 0, 1, 0, -2}}).size(), 1u);
  EXPECT_EQ(components({{1, 0, 0, 1, 0, 0}}).size(), 0u);
  for (const Plane_curve& line : components({{-2, -1, 5, 3, 5, -2}})) EXPECT_TRUE(line.is_line());
}

}  // namespace
}  // namespace weak_partition
