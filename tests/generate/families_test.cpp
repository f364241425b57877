// Families: the same from the same parameters, exactly degenerate where they say so and beside it else, and where the
// parameters put them.

#include <sightline/harness/generate/families.h>
#include <sightline/kernel/scene/scene.h>

#include <gtest/gtest.h>

#include <set>

namespace {

namespace generate = sightline::generate;
using generate::Family_parameters;
using generate::Posed_scene;
using sightline::Exact_point;
using sightline::Face_id;
using sightline::Piece;
using sightline::Point_id;
using sightline::Polygon_soup;
using sightline::Rational;
using sightline::Scene;

Family_parameters with(std::uint64_t seed, std::int64_t ulps = 0, std::size_t size = 0) {
  Family_parameters parameters;
  parameters.seed = seed;
  parameters.ulps = ulps;
  parameters.size = size;
  return parameters;
}
std::string text_of(const Posed_scene& scene) {
  std::string text = scene.name;
  const auto add = [&](const Exact_point& p) {
    for (const Rational& x : p) text += ' ' + sightline::to_string(x);
  };
  for (Point_id p = 0; p < scene.soup.point_count(); ++p) add(scene.soup.point(p));
  for (Face_id f = 0; f < scene.soup.face_count(); ++f)
    for (std::size_t k = 0; k < scene.soup.loop_count(f); ++k)
      for (const Point_id p : scene.soup.loop(f, k)) text += ' ' + std::to_string(p);
  add(scene.eye);
  for (const Exact_point& p : scene.source) add(p);
  for (const Face_id f : scene.visible) text += " v" + std::to_string(f);
  for (const Face_id f : scene.hidden) text += " h" + std::to_string(f);
  return text;
}
std::size_t set_aside(const Posed_scene& scene, const std::string& why) {
  const Scene read(scene.soup);
  return static_cast<std::size_t>(
      std::count_if(read.set_aside().begin(), read.set_aside().end(),
                    [&](const sightline::Set_aside& entry) { return entry.why.starts_with(why); }));
}
std::size_t planes(const Posed_scene& posed) {
  const Scene scene(posed.soup);
  return scene.planes().size();
}

TEST(Families, have_names_of_their_own_and_say_what_they_are) {
  std::set<std::string> names;
  for (const generate::Family& family : generate::families()) {
    EXPECT_TRUE(names.insert(family.name).second) << family.name;
    EXPECT_GE(family.what.size(), 20u) << family.name;
  }
  EXPECT_GE(names.size(), 50u);
  EXPECT_THROW(generate::family("castle"), std::invalid_argument);
}

TEST(Families, make_the_same_from_the_same_parameters_and_another_from_another_seed) {
  for (const generate::Family& family : generate::families()) {
    if (family.name == "rooms") continue;
    std::set<std::string> texts;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const Posed_scene scene = family.make(with(seed, 0, family.small_size));
      EXPECT_EQ(text_of(scene), text_of(family.make(with(seed, 0, family.small_size))));
      EXPECT_GE(scene.soup.face_count(), 1u) << family.name;
      EXPECT_EQ(scene.distance, generate::Distance::exact);
      texts.insert(text_of(scene));
    }
    EXPECT_EQ(texts.size(), 6u) << family.name;
  }
}

TEST(Families, are_where_the_offset_and_the_scale_put_them) {
  for (const generate::Family& family : generate::families()) {
    if (family.name == "rooms") continue;
    for (const int power : {-1000, -1070, 900, 0}) {
      Family_parameters parameters = with(2, 1, family.small_size);
      const Posed_scene here = family.make(parameters);
      parameters.scale = generate::power_of_two(power);
      parameters.offset = {500000, Rational(-1, 3), 4000000};
      const Posed_scene there = family.make(parameters);
      ASSERT_EQ(here.soup.point_count(), there.soup.point_count());
      const auto place = [&](const Exact_point& p) { return generate::along(parameters.offset, parameters.scale, p); };
      for (Point_id p = 0; p < here.soup.point_count(); ++p)
        ASSERT_EQ(place(here.soup.point(p)), there.soup.point(p)) << family.name;
      EXPECT_EQ(place(here.eye), there.eye);
      for (std::size_t k = 0; k < here.source.size(); ++k) EXPECT_EQ(place(here.source[k]), there.source[k]);
      EXPECT_EQ(here.visible, there.visible);
      EXPECT_EQ(here.hidden, there.hidden);
    }
  }
  Family_parameters nowhere;
  nowhere.scale = 0;
  EXPECT_THROW(generate::family("uniform").make(nowhere), std::invalid_argument);
}

TEST(Families, say_how_far_from_their_degeneracy_they_are) {
  const generate::Family& leaves = generate::family("leaves");
  for (const auto& [ulps, distance] :
       std::map<std::int64_t, generate::Distance>{{0, generate::Distance::exact},
                                                  {1, generate::Distance::beside},
                                                  {-1, generate::Distance::beside},
                                                  {generate::far_ulps - 1, generate::Distance::beside},
                                                  {generate::far_ulps, generate::Distance::far},
                                                  {-generate::far_ulps, generate::Distance::far},
                                                  {std::numeric_limits<std::int64_t>::min(), generate::Distance::far}})
    EXPECT_EQ(leaves.make(with(1, ulps)).distance, distance) << ulps;
}

TEST(Families, are_exactly_degenerate_at_0_ulps_and_not_beside) {
  std::size_t thin = 0, twice = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    thin += set_aside(generate::family("slender").make(with(seed)), "zero area");
    twice += set_aside(generate::family("duplicates").make(with(seed)), "duplicate");
    const std::size_t in_one_plane = planes(generate::family("near_parallel").make(with(seed))),
                      in_one_stack = planes(generate::family("leaves").make(with(seed)));
    for (const std::int64_t ulps : {1, -1, 1000}) {
      EXPECT_LE(set_aside(generate::family("slender").make(with(seed, ulps)), "zero area"), 0u) << seed;
      EXPECT_LE(in_one_plane, planes(generate::family("near_parallel").make(with(seed, ulps)))) << seed;
      EXPECT_LT(in_one_stack, planes(generate::family("leaves").make(with(seed, ulps)))) << seed;
    }
  }
  std::size_t no_projection = 0, no_projection_beside = 0, crossing = 0, crossing_beside = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Posed_scene exact = generate::family("twisted_holes").make(with(seed)),
                      beside = generate::family("twisted_holes").make(with(seed, 1));
    no_projection += set_aside(exact, "not planar, with holes");
    no_projection_beside += set_aside(beside, "not planar, with holes");
    crossing += set_aside(exact, "self-intersecting");
    crossing_beside += set_aside(beside, "self-intersecting");
  }
  EXPECT_GT(no_projection, no_projection_beside);
  EXPECT_GT(no_projection_beside, 50u);
  EXPECT_GT(crossing, 20 * crossing_beside);
  EXPECT_GT(thin, 40u);
  EXPECT_GT(twice, 10u);
}

TEST(Families, have_planar_faces_with_holes_of_which_most_are_kept) {
  std::size_t holed = 0, kept = 0, two_holes = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Posed_scene posed = generate::family("flat_holes").make(with(seed));
    const Scene scene(posed.soup);
    std::vector<char> has_piece(posed.soup.face_count());
    for (const Piece& piece : scene.pieces()) has_piece[piece.face] = 1;
    for (Face_id f = 0; f < posed.soup.face_count(); ++f) {
      if (posed.soup.loop_count(f) < 2) continue;
      ++holed;
      kept += static_cast<std::size_t>(has_piece[f]);
      two_holes += posed.soup.loop_count(f) > 2 && has_piece[f] != 0;
    }
  }
  EXPECT_GT(holed, 200u);
  EXPECT_GT(2 * kept, holed);
  EXPECT_LT(kept, holed) << "some cross";
  EXPECT_GT(5 * two_holes, holed);
}

TEST(Families, have_simple_faces_of_many_corners_convex_and_concave_ones) {
  std::size_t many = 0, convex = 0, sources = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Posed_scene posed = generate::family("many_corners").make(with(seed));
    const Scene scene(posed.soup);
    std::vector<std::size_t> pieces(posed.soup.face_count());
    for (const Piece& piece : scene.pieces()) ++pieces[piece.face];
    for (Face_id f = 0; f < posed.soup.face_count(); ++f) {
      if (posed.soup.loop(f).size() < 8) continue;
      ++many;
      convex += pieces[f] == 1;
    }
    EXPECT_EQ(set_aside(posed, "self-intersecting"), 0u) << seed;
    sources += posed.source.size() >= 8;
  }
  EXPECT_GT(many, 200u);
  EXPECT_GT(3 * convex, many);
  EXPECT_LT(3 * convex, 2 * many);
  EXPECT_GT(sources, 60u);
}

TEST(Families, tangles_have_faces_that_are_folded_flat) {
  std::size_t folded = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Scene scene(generate::family("tangle").make(with(seed)).soup);
    const auto& pieces = scene.pieces();
    bool any = false;
    for (std::size_t i = 1; i < pieces.size(); ++i)
      for (std::size_t j = i; j-- > 0 && pieces[j].face == pieces[i].face;)
        any = any || pieces[j].support == pieces[i].support.opposite();
    folded += any;
  }
  EXPECT_GT(folded, 5u);
}

TEST(Families, beside_their_degeneracy_move_by_so_many_ulps_of_their_size) {
  for (const char* name : {"uniform", "coplanar", "aligned", "tangle"}) {
    bool moved = false;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const Posed_scene exact = generate::family(name).make(with(seed)),
                        beside = generate::family(name).make(with(seed, 7));
      ASSERT_EQ(exact.soup.point_count(), beside.soup.point_count());
      const Rational step = Rational(7 * generate::power_of_two(3 - 52));
      for (Point_id p = 0; p < exact.soup.point_count(); ++p)
        for (std::size_t k = 0; k < 3; ++k) {
          const Rational difference = Rational((beside.soup.point(p)[k] - exact.soup.point(p)[k]) / step);
          EXPECT_TRUE(difference.get_den() == 1 && difference >= 0 && difference <= 3)
              << name << ' ' << seed << ": " << difference;
          moved = moved || difference != 0;
        }
    }
    EXPECT_TRUE(moved) << name;
  }
  const Posed_scene exact = generate::family("city").make(with(1, 0, 3)),
                    beside = generate::family("city").make(with(1, -2, 3));
  const Rational step = Rational(2 * generate::power_of_two(generate::size_bits(exact.soup) - 52));
  for (Point_id p = 0; p < exact.soup.point_count(); ++p)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LE(abs(Rational(beside.soup.point(p)[k] - exact.soup.point(p)[k])), step);
}

TEST(Families, have_doubles_for_coordinates_at_every_scale_where_they_have_them_at_one) {
  std::size_t all = 0, doubles = 0;
  for (const generate::Family& family : generate::families()) {
    if (family.name == "rooms" || family.name == "exponents") continue;  // these have all scales by themselves
    for (std::uint64_t seed = 0; seed < 4; ++seed)
      for (const int power : {-1000, 900}) {
        Family_parameters parameters = with(seed, 0, family.small_size);
        const Posed_scene here = family.make(parameters);
        parameters.scale = generate::power_of_two(power);
        const Posed_scene there = family.make(parameters);
        const auto is_double = [](const Rational& x) { return sightline::exact(sightline::nearest_double(x)) == x; };
        for (std::size_t k = 0; k < here.soup.coordinates.size(); ++k, ++all) {
          EXPECT_EQ(is_double(here.soup.coordinates[k]), is_double(there.soup.coordinates[k]))
              << family.name << ' ' << seed;
          doubles += is_double(here.soup.coordinates[k]);
        }
      }
  }
  EXPECT_GT(2 * doubles, all);
}

TEST(Families, have_one_with_exponents_of_all_doubles_in_one_scene) {
  bool tiny = false, huge = false;
  std::size_t mixed = 0, kept = 0, faces = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Posed_scene scene = generate::family("exponents").make(with(seed));
    EXPECT_GE(scene.source.size(), 3u);
    const Scene read(scene.soup);
    kept += read.counters().faces;
    faces += scene.soup.face_count();
    Rational least = 1, most = 1;
    for (std::size_t k = 0; k < scene.soup.coordinates.size(); ++k) {
      const Rational x = abs(scene.soup.coordinates[k]);
      EXPECT_EQ(sightline::exact(sightline::nearest_double(x)), x) << seed;
      if (x == 0) continue;
      least = std::min(least, x);
      most = std::max(most, x);
    }
    tiny = tiny || least < generate::power_of_two(-1022);
    huge = huge || most > generate::power_of_two(1000);
    mixed += most > Rational(least * generate::power_of_two(1100));
  }
  EXPECT_TRUE(tiny && huge);
  EXPECT_GT(mixed, 20u);
  EXPECT_GT(10 * kept, 9 * faces);
}

TEST(Families, are_as_large_as_one_wants) {
  for (const char* name : {"regulus", "t_junctions", "coplanar", "leaves", "tangle", "exponents"}) {
    const Posed_scene scene = generate::family(name).make(with(5, 0, 300));
    EXPECT_GE(scene.soup.face_count(), 300u) << name;
    EXPECT_LE(scene.soup.face_count(), 310u) << name;
    EXPECT_THROW(generate::family(name).make(with(5, 0, 10000000)), std::invalid_argument);
  }
}

}  // namespace
