// Which scenes fuzzing runs and with which checks, and what each step of making a scene small is for.

#include <sightline/algorithms/solids/measure.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/fuzz.h>
#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/scene/scene.h>

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace {

using namespace sightline;
using generate::Posed_scene;
using harness::Answer;
using harness::Outcome;

Answer all_alike(const Posed_scene& posed) {
  Answer answer;
  answer.labels.assign(posed.soup.face_count(), 0);
  return answer;
}
Posed_scene scene_of(const generate::Faces& faces) {
  Posed_scene scene;
  scene.soup = generate::soup_of(faces);
  return scene;
}
/// All values of an axis in a scene's faces.
std::multiset<Rational> values_of(const Posed_scene& scene, std::size_t axis) {
  std::multiset<Rational> values;
  for (Face_id f = 0; f < scene.soup.face_count(); ++f)
    for (const Point_id p : scene.soup.loop(f)) values.insert(scene.soup.point(p)[axis]);
  return values;
}

/// Whether there is one face, its corners apart.
bool is_one_face(const Posed_scene& scene, std::size_t corners) {
  if (scene.soup.face_count() != 1 || scene.soup.loop(0).size() != corners) return false;
  std::set<Exact_point> places;
  for (const Point_id p : scene.soup.loop(0)) places.insert(scene.soup.point(p));
  return places.size() == corners;
}

// ---- Fuzzing

TEST(Fuzz_options, keep_scenes_out_that_are_too_large_or_have_no_source) {
  harness::Subject subject;
  subject.wants_source = true;
  subject.answer = [](const Posed_scene& posed) {
    if (posed.soup.face_count() > 4) throw std::logic_error("too many faces");
    if (posed.source.empty()) throw std::logic_error("no source");
    return all_alike(posed);
  };
  harness::Fuzz_options options;
  options.scenes = 100;
  options.most_faces = 4;
  harness::Fuzz_summary summary;
  const auto found = harness::fuzz(subject, options, summary);
  EXPECT_FALSE(found) << found->disagreement.what;
  EXPECT_EQ(summary.scenes, 100u);
}

TEST(Fuzz_options, shards_run_together_what_one_run_does_and_each_its_own) {
  harness::Subject subject;
  std::multiset<std::string> asked;
  subject.answer = [&](const Posed_scene& posed) {
    std::string text;
    for (Point_id p = 0; p < posed.soup.point_count(); ++p)
      for (const Rational& x : posed.soup.point(p)) text += to_string(x) + ' ';
    asked.insert(text);
    return all_alike(posed);
  };
  const auto asked_by = [&](std::size_t shard, std::size_t shards) {
    harness::Fuzz_options options;
    options.scenes = 50;
    options.shard = shard;
    options.shards = shards;
    harness::Fuzz_summary summary;
    asked.clear();
    EXPECT_FALSE(harness::fuzz(subject, options, summary));
    EXPECT_EQ(summary.scenes, asked.size());
    return asked;
  };
  const std::multiset<std::string> all = asked_by(0, 1);
  std::multiset<std::string> together;
  for (std::size_t shard = 0; shard < 3; ++shard) {
    const std::multiset<std::string> own = asked_by(shard, 3);
    EXPECT_EQ(own.size(), shard < 2 ? 17u : 16u);
    together.insert(own.begin(), own.end());
  }
  EXPECT_EQ(all.size(), 50u);
  EXPECT_EQ(together, all);
}

TEST(Fuzz_options, from_any_place_the_same_sequence_goes_on_to_the_same_finding) {
  harness::Subject subject;
  std::size_t asked = 0;
  subject.answer = [&](const Posed_scene& posed) {
    Answer answer = all_alike(posed);
    if (++asked == 30) answer.flaw = "the thirtieth";
    return answer;
  };
  std::vector<harness::Fuzz_place> places;
  std::vector<harness::Fuzz_summary> summaries;
  harness::Fuzz_options options;
  options.shard = 1;
  options.shards = 2;
  harness::Fuzz_summary whole;
  options.at = [&](const harness::Fuzz_place& at) {
    places.push_back(at);
    summaries.push_back(whole);
  };
  const auto found = harness::fuzz(subject, options, whole);
  ASSERT_TRUE(found);
  ASSERT_GE(places.size(), 60u);
  options.at = {};
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}, places.size() / 2, places.size() - 1}) {
    harness::Fuzz_summary rest = summaries[k];
    asked = rest.scenes;
    options.from = harness::Fuzz_place{generate::Random(9), places[k].drawn};
    options.from->random.set_state(places[k].random.state());  // by way of text
    const auto again = harness::fuzz(subject, options, rest);
    ASSERT_TRUE(again);
    EXPECT_EQ(to_string(again->which), to_string(found->which)) << k;
    EXPECT_EQ(rest.scenes, whole.scenes);
    EXPECT_EQ(rest.by_family.size(), whole.by_family.size());
  }
  EXPECT_THROW(generate::Random(1).set_state("1 2 3"), std::invalid_argument);
}

TEST(First_disagreement, runs_the_named_check_alone_and_each_with_numbers_of_its_own) {
  std::vector<std::uint64_t> drawn;
  harness::Subject subject;
  subject.answer = all_alike;
  for (const char* name : {"first", "second"})
    subject.checks.push_back({name, "", [&drawn, name](const Posed_scene&, const Answer&, generate::Random& random) {
                                drawn.push_back(random.below(std::uint64_t{1} << 60));
                                return name == std::string("first") ? Outcome::failed("always") : Outcome{};
                              }});
  const Posed_scene scene = scene_of({generate::rectangle(0, 1, 0, 1, 0)});
  ASSERT_TRUE(harness::first_disagreement(subject, scene, 1));
  EXPECT_FALSE(harness::first_disagreement(subject, scene, 1, "second"));
  ASSERT_TRUE(harness::first_disagreement(subject, scene, 2, "first"));
  ASSERT_TRUE(harness::first_disagreement(subject, scene, 1, "first"));
  ASSERT_EQ(drawn.size(), 4u);
  EXPECT_NE(drawn[0], drawn[1]) << "by check";
  EXPECT_NE(drawn[0], drawn[2]) << "by seed";
  EXPECT_EQ(drawn[0], drawn[3]);
}

TEST(First_disagreement, runs_a_check_of_a_share_on_that_share_and_the_same_way_where_it_is_named) {
  std::map<std::uint64_t, std::uint64_t> drawn;  // by seed
  std::uint64_t seed = 0;
  harness::Subject subject;
  subject.answer = all_alike;
  subject.checks.push_back({"first", "",
                            [&](const Posed_scene&, const Answer&, generate::Random& random) {
                              drawn[seed] = random.below(std::uint64_t{1} << 60);
                              return Outcome{};
                            },
                            4});
  const Posed_scene scene = scene_of({generate::rectangle(0, 1, 0, 1, 0)});
  for (seed = 0; seed < 400; ++seed) EXPECT_FALSE(harness::first_disagreement(subject, scene, seed));
  EXPECT_GT(drawn.size(), 60u);
  EXPECT_LT(drawn.size(), 140u);
  const auto before = std::exchange(drawn, {});
  for (seed = 0; seed < 400; ++seed) EXPECT_FALSE(harness::first_disagreement(subject, scene, seed, "first"));
  EXPECT_EQ(drawn.size(), 400u);
  for (const auto& [of, number] : before) EXPECT_EQ(drawn[of], number);
}

// ---- Making scenes small

TEST(Reduce, stays_with_the_check_that_failed) {
  harness::Subject subject;
  subject.answer = [](const Posed_scene& posed) {
    Answer answer = all_alike(posed);
    if (posed.soup.face_count() < 3) answer.flaw = "another failure";
    return answer;
  };
  subject.checks = {
      {"always", "", [](const Posed_scene&, const Answer&, generate::Random&) { return Outcome::failed("always"); }}};
  const Posed_scene tower = generate::family("stacked").make({1, 8});
  EXPECT_EQ(harness::reduce(subject, tower, 1, {"always", "always"}).scene.soup.face_count(), 3u);
}

TEST(Reduce, rounds_one_point_where_another_must_keep_the_value) {
  const Posed_scene scene = scene_of({{generate::at(7, 0, 0), generate::at(7, 3, 0), generate::at(5, 5, 0)}});
  const harness::Reduced reduced = harness::reduce(
      scene, [](const Posed_scene& posed) { return is_one_face(posed, 3) && values_of(posed, 0).count(7) > 0; });
  EXPECT_EQ(values_of(reduced.scene, 0), (std::multiset<Rational>{0, 0, 7}));
}

TEST(Reduce, rounds_a_value_everywhere_at_once) {
  // All corners in one horizontal plane; the eye stays, so that nothing can be moved as a whole.
  Posed_scene scene = scene_of({generate::rectangle(0, 1, 0, 1, generate::ratio(5, 3))});
  scene.eye = generate::at(0, 0, 100);
  const harness::Reduced reduced = harness::reduce(scene, [](const Posed_scene& posed) {
    const std::multiset<Rational> heights = values_of(posed, 2);
    return posed.eye[2] == 100 && is_one_face(posed, 4) && heights.count(*heights.begin()) == 4;
  });
  EXPECT_EQ(values_of(reduced.scene, 2), (std::multiset<Rational>{0, 0, 0, 0}));
}

TEST(Reduce, moves_what_keeps_its_shape) {
  const Posed_scene scene = scene_of({{generate::at(1001, 5, 9), generate::at(1004, 5, 9), generate::at(1001, 12, 9)}});
  const harness::Reduced reduced = harness::reduce(scene, [](const Posed_scene& posed) {
    if (!is_one_face(posed, 3)) return false;
    const auto corner = [&](std::size_t k) { return posed.soup.point(posed.soup.loop(0)[k]); };
    return minus(corner(1), corner(0)) == generate::at(3, 0, 0) && minus(corner(2), corner(0)) == generate::at(0, 7, 0);
  });
  EXPECT_EQ(reduced.scene.soup.point(reduced.scene.soup.loop(0)[0]), generate::at(0, 0, 0));
}

TEST(Reduce, begins_again_as_long_as_it_helps) {
  // A face can go only once all numbers are small, and these are rounded after faces were tried.
  const Posed_scene scene = scene_of({generate::rectangle(8, 9, 8, 9, 8), generate::rectangle(20, 21, 20, 21, 20)});
  const harness::Reduced reduced = harness::reduce(scene, [](const Posed_scene& posed) {
    if (posed.soup.face_count() != 1) return posed.soup.face_count() > 1;
    return *values_of(posed, 0).rbegin() <= 1 && *values_of(posed, 1).rbegin() <= 1;
  });
  EXPECT_EQ(reduced.scene.soup.face_count(), 1u);
}

TEST(Reduce, leaves_a_source_its_three_corners) {
  const Posed_scene scene = generate::family("slats").make({1});
  ASSERT_EQ(scene.source.size(), 4u);
  const harness::Reduced reduced = harness::reduce(scene, [](const Posed_scene&) { return true; });
  EXPECT_EQ(reduced.scene.source.size(), 3u);
  EXPECT_EQ(reduced.scene.soup.face_count(), 0u);
}

/// No face can be left out alone; rounding moves corners onto others, and faces without area go.
TEST(Reduce, makes_surfaces_small_that_fail_only_while_they_are_closed) {
  Posed_scene scene;
  generate::Family_parameters parameters;
  parameters.size = 8;
  const Polygon_soup ball = generate::family("convex_sphere").make(parameters).soup;
  for (int k = 0; k < 4; ++k) generate::append(scene.soup, generate::translated(ball, {5 * k, 0, 0}));
  ASSERT_GT(scene.soup.face_count(), 30u);
  const harness::Reduced reduced = harness::reduce(
      scene, [](const Posed_scene& posed) { return closure(Scene(posed.soup)).closed && volume(posed.soup) > 0; });
  EXPECT_TRUE(reduced.finished);
  EXPECT_EQ(reduced.scene.soup.face_count(), 4u);
  EXPECT_EQ(reduced.scene.soup.point_count(), 4u);
}

}  // namespace
