// Laws, fuzzing and reducing on subjects that are wrong on purpose: each law catches what it is for, and lets through
// what is right.

#include <sightline/harness/laws/fuzz.h>
#include <sightline/harness/laws/laws.h>

#include <gtest/gtest.h>

namespace {

using namespace sightline;
using generate::Points;
using harness::Answer;
using harness::Outcome;
using harness::Posed_scene;

Points corners_of(const Polygon_soup& soup, Face_id face) {
  Points corners;
  for (const Point_id p : soup.loop(face)) corners.push_back(soup.point(p));
  return corners;
}
/// Twice the area vector.
Exact_point normal_of(const Points& c) {
  Exact_point sum{0, 0, 0};
  for (std::size_t k = 2; k < c.size(); ++k) {
    const Exact_point part = cross(minus(c[k - 1], c[0]), minus(c[k], c[0]));
    for (std::size_t i = 0; i < 3; ++i) sum[i] += part[i];
  }
  return sum;
}
Rational dot(const Exact_point& a, const Exact_point& b) { return Rational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]); }

/// A label for each face, by a function of the scene and the face's corners.
template <class Label>
std::function<Answer(const Posed_scene&)> labels(Label label) {
  return [label](const Posed_scene& posed) {
    Answer answer;
    for (Face_id f = 0; f < posed.soup.face_count(); ++f)
      answer.labels.push_back(label(posed, f, corners_of(posed.soup, f)));
    return answer;
  };
}
/// Right: 1 where the eye is in front of the face, 2 behind it, 4 in its plane.
std::uint32_t side_of_eye(const Posed_scene& posed, Face_id, const Points& c) {
  const int side = sgn(dot(normal_of(c), minus(posed.eye, c[0])));
  return side > 0 ? 1 : side < 0 ? 2 : 4;
}

const harness::Law& law(const std::string& name) {
  for (const harness::Law& l : harness::laws())
    if (l.name == name) return l;
  throw std::out_of_range(name);
}
/// How many of 60 scenes of planar convex faces a law finds something wrong in.
std::size_t failures(const std::string& name, const std::function<Answer(const Posed_scene&)>& answer) {
  const harness::Check check = harness::check_of(law(name), answer);
  std::size_t failed = 0, applied = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Posed_scene posed = generate::family("touching_faces").make({seed});
    generate::Random random(seed);
    const Outcome outcome = check.run(posed, answer(posed), random);
    applied += outcome.state != Outcome::State::not_applicable;
    failed += outcome.state == Outcome::State::failed;
  }
  EXPECT_GT(applied, name == "project" ? 4u : 40u) << name;  // that is for few scenes
  return failed;
}

TEST(Laws, let_a_right_answer_through) {
  for (const harness::Law& l : harness::laws()) EXPECT_EQ(failures(l.name, labels(side_of_eye)), 0u) << l.name;
  // Halves of a face may have different labels.
  EXPECT_EQ(failures("cut", labels([](const Posed_scene&, Face_id, const Points& c) {
                       return std::any_of(c.begin(), c.end(), [](const Exact_point& p) { return p[0] > 0; }) ? 1u : 0u;
                     })),
            0u);
}

TEST(Laws, catch_answers_that_depend_on_what_they_must_not) {
  EXPECT_GT(failures("permute", labels([](const Posed_scene&, Face_id f, const Points&) { return f % 2; })), 5u);
  EXPECT_GT(failures("begin", labels([](const Posed_scene&, Face_id, const Points& c) {
                       return static_cast<std::uint32_t>(1 + sgn(c[0][0]));
                     })),
            5u);
  EXPECT_GT(
      failures("translate", labels([](const Posed_scene&, Face_id, const Points& c) { return c[0][0] > 5 ? 1u : 0u; })),
      5u);
  EXPECT_GT(failures("scale", labels([](const Posed_scene&, Face_id, const Points& c) {
                       return dot(normal_of(c), normal_of(c)) > 4 ? 1u : 0u;
                     })),
            5u);
  EXPECT_GT(failures("rotate", labels([](const Posed_scene&, Face_id, const Points& c) {
                       return normal_of(c)[2] > 0 ? 1u : 0u;
                     })),
            5u);
  EXPECT_GT(failures("stretch", labels([](const Posed_scene&, Face_id, const Points& c) {
                       return dot(minus(c[1], c[0]), minus(c[2], c[1])) > 0 ? 1u : 0u;
                     })),
            5u);
  EXPECT_GT(failures("project", labels([](const Posed_scene&, Face_id, const Points& c) {
                       return dot(normal_of(c), normal_of(c)) > 4 ? 1u : 0u;
                     })),
            1u);
  EXPECT_GT(failures("mirror", labels([](const Posed_scene& posed, Face_id, const Points& c) {
                       return c[0][0] > posed.eye[0] ? 1u : 0u;
                     })),
            5u);
  EXPECT_GT(failures("turn", labels([](const Posed_scene&, Face_id, const Points&) { return 1u; })), 5u);
  EXPECT_GT(failures("cut", labels([](const Posed_scene&, Face_id, const Points& c) {
                       return static_cast<std::uint32_t>(c.size());
                     })),
            5u);
  EXPECT_GT(failures("bystander", labels([](const Posed_scene& posed, Face_id, const Points&) {
                       return static_cast<std::uint32_t>(posed.soup.face_count());
                     })),
            5u);
}

TEST(Laws,
     mirror_catches_a_wrong_sense) {  // right but for the loop's sense, which a mirror turns and the law turns back
  const auto unturned = labels([](const Posed_scene& posed, Face_id, const Points& c) {
    const Exact_point n = normal_of(c), e = minus(posed.eye, c[0]);
    return sgn(n[0]) * sgn(e[0]) * sgn(n[1]) > 0 ? 1u : 0u;
  });
  EXPECT_GT(failures("mirror", unturned), 3u);
}

TEST(Laws, partitions_are_compared_by_who_is_together) {
  const auto by_plane =
      [](const Posed_scene& posed) {  // faces with the same normal are together; names are places, backwards
        Answer answer = labels([](const Posed_scene& p, Face_id f, const Points& c) {
          for (Face_id g = 0; g < f; ++g)
            if (is_zero(cross(normal_of(c), normal_of(corners_of(p.soup, g))))) return 1000u - g;
          return 1000u - f;
        })(posed);
        answer.is_partition = true;
        return answer;
      };
  for (const char* name : {"permute", "translate", "rotate", "stretch", "mirror", "turn"})
    EXPECT_EQ(failures(name, by_plane), 0u) << name;
  const auto by_place = [](const Posed_scene& posed) {
    Answer answer = labels([](const Posed_scene&, Face_id f, const Points&) { return f / 2; })(posed);
    answer.is_partition = true;
    return answer;
  };
  EXPECT_GT(failures("permute", by_place), 5u);
}

TEST(Laws, what_one_answer_leaves_out_is_not_compared) {
  Answer a, b;
  a.labels = {1, 2, Answer::none};
  b.labels = {1, Answer::none, 7};
  EXPECT_EQ(harness::compared(a, b, "a", "b").state, Outcome::State::passed);
  a.undecided = 1;
  EXPECT_EQ(harness::compared(a, b, "a", "b").state, Outcome::State::undecided);
  b.labels[0] = 0;
  EXPECT_EQ(harness::compared(a, b, "a", "b").state, Outcome::State::failed);
  a.labels = {1};
  b.labels = {1, 1};
  EXPECT_EQ(harness::compared(a, b, "a", "b").state, Outcome::State::failed) << "answers about different scenes";
}

TEST(Laws, are_not_for_what_depends_on_the_axes_or_on_pieces) {
  const Posed_scene posed = generate::family("touching_faces").make({1});
  const auto state = [&](const char* name, bool planar, bool is_partition, bool whole) {
    const auto answer = [=](const Posed_scene& scene) {
      Answer other = labels(side_of_eye)(scene);
      other.planar = planar;
      other.is_partition = is_partition;
      other.whole = whole;
      return other;
    };
    generate::Random random(1);
    return harness::check_of(law(name), answer).run(posed, answer(posed), random).state;
  };
  for (const char* name : {"rotate", "mirror"}) {
    EXPECT_EQ(state(name, true, false, true), Outcome::State::passed) << name;
    EXPECT_EQ(state(name, false, false, true), Outcome::State::not_applicable) << name;
  }
  for (const char* name : {"begin", "translate", "scale", "turn"}) {
    EXPECT_EQ(state(name, true, false, true), Outcome::State::passed) << name;
    EXPECT_EQ(state(name, false, false, true), Outcome::State::passed) << name;
  }
  EXPECT_EQ(state("permute", false, false, false), Outcome::State::passed);
  EXPECT_EQ(state("permute", true, true, true), Outcome::State::passed);
  EXPECT_EQ(state("permute", true, true, false), Outcome::State::not_applicable);
}

TEST(Laws, move_the_source_with_the_scene) {
  const auto side_of_source = labels([](const Posed_scene& posed, Face_id, const Points& c) {
    return static_cast<std::uint32_t>(1 + sgn(dot(normal_of(c), minus(posed.source[0], c[0]))));
  });
  for (const char* name : {"translate", "scale", "rotate", "mirror"})
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const Posed_scene posed = generate::family("slats").make({seed});
      generate::Random random(seed);
      EXPECT_EQ(harness::check_of(law(name), side_of_source).run(posed, side_of_source(posed), random).state,
                Outcome::State::passed)
          << name << ' ' << seed;
    }
}

TEST(Laws, know_nothing_of_a_face_of_which_a_part_is_left_out) {
  harness::Image image;
  image.face_of = {0, 0, std::nullopt};
  Answer of_parts;
  for (const bool is_partition : {false, true})
    for (const auto& parts : {std::pair(Answer::none, 1u), std::pair(1u, Answer::none)}) {
      of_parts.is_partition = is_partition;
      of_parts.labels = {parts.first, parts.second, 7};
      EXPECT_EQ(harness::pulled_back(image, of_parts, 1).labels, (std::vector<std::uint32_t>{Answer::none}));
    }
}

TEST(Laws, a_cut_keeps_a_face_and_a_bystander_is_out_of_sight) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Posed_scene posed = generate::family("touching_faces").make({seed});
    generate::Random random(seed);
    const auto cut = harness::cut(posed, random);
    ASSERT_TRUE(cut);
    ASSERT_EQ(cut->scene.soup.face_count(), posed.soup.face_count() + 1);
    std::vector<Exact_point> area(posed.soup.face_count(), {0, 0, 0});
    const auto add_area = [](Exact_point& sum, const Points& c) {
      for (std::size_t k = 0; k < c.size(); ++k) sum = generate::along(sum, 1, cross(c[k], c[(k + 1) % c.size()]));
    };
    for (Face_id f = 0; f < cut->scene.soup.face_count(); ++f) {
      const Points corners = harness::convex_corners(cut->scene.soup, f);
      EXPECT_FALSE(corners.empty()) << "seed " << seed;
      add_area(area[*cut->face_of[f]], corners);
    }
    for (Face_id f = 0; f < posed.soup.face_count(); ++f) {
      Exact_point whole{0, 0, 0};
      add_area(whole, corners_of(posed.soup, f));
      EXPECT_TRUE(is_zero(minus(whole, area[f]))) << "seed " << seed;
    }
    const auto more = harness::with_a_bystander(posed, random);
    ASSERT_EQ(more->scene.soup.face_count(), posed.soup.face_count() + 1);
    EXPECT_FALSE(more->face_of.back());
    bool apart = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Rational low = 1000000, high = posed.eye[axis];
      for (const Exact_point& p : corners_of(more->scene.soup, posed.soup.face_count())) low = std::min(low, p[axis]);
      for (Point_id p = 0; p < posed.soup.point_count(); ++p) high = std::max(high, posed.soup.point(p)[axis]);
      apart = apart || high < low;
    }
    EXPECT_TRUE(apart) << "seed " << seed;
  }
}

// ---- Cases

TEST(Cases, are_named_and_made_again_from_their_names) {
  generate::Random random(3);
  for (const generate::Family& family : generate::families()) {
    const harness::Fuzz_case drawn = harness::draw_case(family, random), read = harness::parse_case(to_string(drawn));
    EXPECT_EQ(to_string(drawn), to_string(read));
    if (family.name == "rooms") continue;
    const Posed_scene a = harness::make(drawn), b = harness::make(read);
    ASSERT_EQ(a.soup.point_count(), b.soup.point_count()) << to_string(drawn);
    for (Point_id p = 0; p < a.soup.point_count(); ++p) EXPECT_EQ(a.soup.point(p), b.soup.point(p));
    EXPECT_EQ(a.eye, b.eye);
  }
  EXPECT_EQ(to_string(harness::parse_case("regulus:5")), "regulus:5:0:0:0,0,0:0");
}

TEST(Cases, that_make_no_sense_are_told) {
  for (const char* text : {"", "castle:1", "regulus:x", "regulus:-1", "regulus:1:2:3:4", "regulus:1:2:3:1,2:0",
                           "regulus:1:2:3:1,2,3,4:0", "regulus:1:2:3:1,,3:0", "regulus:1:2:3:1,2,1/0:0",
                           "regulus:1:2:3:0,0,0:5000", "regulus:1:2:3:0,0,0:0:0", "regulus:99999999999999999999"})
    EXPECT_THROW(harness::parse_case(text), std::invalid_argument) << text;
}

// ---- Fuzzing and reducing

/// Wrong where a face has a corner with x + y = 1 and the eye is in its plane.
harness::Subject wrong_now_and_then() {
  harness::Subject subject;
  subject.name = "wrong";
  subject.answer = labels(side_of_eye);
  subject.checks = {{"planted", "", [](const Posed_scene& posed, const Answer& answer, generate::Random&) {
                       for (Face_id f = 0; f < posed.soup.face_count(); ++f)
                         for (const Exact_point& p : corners_of(posed.soup, f))
                           if (answer.labels[f] == 4 && p[0] + p[1] == 1) return Outcome::failed("here");
                       return Outcome{};
                     }}};
  return subject;
}

TEST(Fuzz, finds_a_planted_fault_replays_it_by_name_and_makes_it_small) {
  const harness::Subject subject = wrong_now_and_then();
  harness::Fuzz_options options;
  options.scenes = 3000;
  options.seed = 1;  // of others, what is found may be left with longer numbers
  harness::Fuzz_summary summary, again;
  const auto found = harness::fuzz(subject, options, summary);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->disagreement.check, "planted");
  EXPECT_GT(summary.scenes, 0u);
  const auto other = harness::fuzz(subject, options, again);
  ASSERT_TRUE(other);
  EXPECT_EQ(to_string(found->which), to_string(other->which)) << "one seed, one sequence";
  const harness::Fuzz_case read = harness::parse_case(to_string(found->which));
  EXPECT_TRUE(harness::first_disagreement(subject, harness::make(read), read.parameters.seed));

  const harness::Reduced reduced =
      harness::reduce(subject, found->scene, found->which.parameters.seed, found->disagreement);
  EXPECT_TRUE(reduced.finished);
  EXPECT_TRUE(harness::first_disagreement(subject, reduced.scene, found->which.parameters.seed));
  EXPECT_EQ(reduced.scene.soup.face_count(), 1u);
  EXPECT_LE(reduced.scene.soup.point_count(), 3u);
  std::size_t ones = 0;
  for (std::size_t k = 0; k < reduced.scene.soup.coordinates.size(); ++k) {
    const Rational x = reduced.scene.soup.coordinates[k];
    EXPECT_LE(abs(x), 1) << x;
    ones += sgn(x) != 0;
  }
  EXPECT_LE(ones, 9u);
}

TEST(Fuzz, goes_on_where_nothing_is_wrong_and_counts_what_it_does) {
  harness::Subject subject;
  subject.name = "right";
  subject.answer = [](const Posed_scene& posed) {
    Answer answer;
    answer.labels.assign(posed.soup.face_count(), 4);
    return answer;
  };
  harness::add_laws(subject, {"permute", "translate", "scale", "rotate", "mirror", "turn", "cut", "bystander"});
  EXPECT_EQ(subject.checks.size(), 8u);
  harness::Fuzz_options options;
  options.scenes = 200;
  harness::Fuzz_summary summary;
  EXPECT_FALSE(harness::fuzz(subject, options, summary));
  EXPECT_EQ(summary.scenes, 200u);
  EXPECT_EQ(summary.by_check.size(), 9u) << "the laws, and the answer by itself";
  EXPECT_EQ(summary.by_check["certificate"].not_applicable, 200u) << "there is none";
  EXPECT_EQ(summary.by_check["certificate"].cases(), 0u);
  EXPECT_GT(summary.by_family.size(), 30u);
  std::size_t cases = 0;
  for (const auto& entry : summary.by_family) cases += entry.second.cases();
  EXPECT_EQ(cases, summary.cases);
  options.family = "castle";
  EXPECT_THROW(harness::fuzz(subject, options, summary), std::invalid_argument);
}

TEST(Fuzz, an_exception_and_a_rejected_certificate_are_findings) {
  harness::Subject subject;
  subject.answer = [](const Posed_scene& posed) -> Answer {
    if (posed.soup.face_count() > 4) throw std::domain_error("too many");
    Answer answer;
    if (posed.soup.face_count() == 3) answer.flaw = "rejected";
    answer.labels.assign(posed.soup.face_count(), 0);
    return answer;
  };
  harness::Fuzz_options options;
  harness::Fuzz_summary summary;
  const auto found = harness::fuzz(subject, options, summary);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->disagreement.check, "certificate");
  options.family = "rooms";
  options.most_faces = 1000;
  const auto thrown = harness::fuzz(subject, options, summary);
  ASSERT_TRUE(thrown);
  EXPECT_EQ(thrown->disagreement.what, "throws: too many");
  EXPECT_EQ(harness::reduce(subject, thrown->scene, 1, thrown->disagreement).scene.soup.face_count(), 5u);
}

TEST(Fuzz, a_rejected_certificate_is_a_finding_of_the_scene_itself) {
  harness::Subject subject;
  subject.answer = labels(side_of_eye);
  subject.verified = [](const Posed_scene& posed) {
    Answer answer = labels(side_of_eye)(posed);
    if (posed.soup.face_count() == 3) answer.flaw = "rejected";
    return answer;
  };
  harness::Fuzz_options options;
  options.scenes = 1000;
  harness::Fuzz_summary summary;
  const auto found = harness::fuzz(subject, options, summary);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->disagreement.check, "certificate");
  EXPECT_EQ(found->disagreement.what, "rejected");
  EXPECT_EQ(summary.by_check["certificate"].passed, summary.scenes - 1);
}

TEST(Laws, check_the_certificate_of_some_images) {
  const auto answer = labels(side_of_eye);
  const harness::Check check = harness::check_of(law("translate"), answer, [&](const Posed_scene& posed) {
    Answer flawed = answer(posed);
    flawed.flaw = "rejected";
    return flawed;
  });
  std::size_t failed = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Posed_scene posed = generate::family("touching_faces").make({seed});
    generate::Random random(seed);
    failed += check.run(posed, answer(posed), random).state == Outcome::State::failed;
  }
  EXPECT_GT(failed, 10u);
  EXPECT_LT(failed, 50u);
}

TEST(Reduce, rounds_a_point_where_its_value_must_stay_elsewhere) {
  const Posed_scene tower = generate::family("stacked").make({1, 2});
  const auto corners_at_one = [](const Posed_scene& posed) {
    std::size_t count = 0;
    for (Point_id p = 0; p < posed.soup.point_count(); ++p) count += posed.soup.point(p)[0] == 1;
    return count;
  };
  ASSERT_EQ(corners_at_one(tower), 4u);
  const harness::Reduced reduced =
      harness::reduce(tower, [&](const Posed_scene& posed) { return corners_at_one(posed) > 0; });
  EXPECT_EQ(corners_at_one(reduced.scene), 1u);
  ASSERT_EQ(reduced.scene.soup.face_count(), 1u);
  EXPECT_EQ(reduced.scene.soup.loop(0).size(), 3u);
}

TEST(Reduce, ends_with_a_scene_that_fails_and_has_nothing_to_spare) {
  const Posed_scene city = generate::family("city").make({3, 4});
  std::size_t asked = 0;
  const auto fails = [&](const Posed_scene& posed) {  // two faces that look up, one above 1/4
    ++asked;
    std::size_t up = 0, high = 0;
    for (Face_id f = 0; f < posed.soup.face_count(); ++f) {
      const Points c = corners_of(posed.soup, f);
      up += sgn(normal_of(c)[2]) > 0;
      high += sgn(normal_of(c)[2]) > 0 && c[0][2] > generate::ratio(1, 4);
    }
    return up >= 2 && high >= 1;
  };
  ASSERT_TRUE(fails(city));
  const harness::Reduced reduced = harness::reduce(city, fails);
  EXPECT_TRUE(fails(reduced.scene));
  EXPECT_EQ(reduced.scene.soup.face_count(), 2u);
  EXPECT_LE(reduced.scene.soup.point_count(), 6u);
  EXPECT_EQ(reduced.tests + 2, asked);
  EXPECT_TRUE(reduced.finished);

  harness::Reduce_options few;
  few.most_tests = 5;
  const harness::Reduced cut_short = harness::reduce(city, fails, few);
  EXPECT_TRUE(fails(cut_short.scene));
  EXPECT_FALSE(cut_short.finished);
  EXPECT_EQ(cut_short.tests, 5u);
  const harness::Reduced stays =
      harness::reduce(city, [](const Posed_scene& posed) { return posed.soup.file == "city"; });
  EXPECT_EQ(stays.scene.soup.face_count(), city.soup.face_count());
}

}  // namespace
