// Judging set operations: the protocol, the points that answers are judged at, and what is found wrong.

#include "../sample.h"
#include "../solids/shapes.h"

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/judge/case.h>
#include <sightline/harness/judge/explain.h>
#include <sightline/harness/judge/guess.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/harness/judge/truth.h>
#include <sightline/harness/laws/solid_oracle.h>
#include <sightline/io/off.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <set>
#include <sstream>

namespace {

using namespace sightline;
using namespace sightline::judge;
using test_solids::add_box;
using test_solids::box;

struct Asked_solids {
  Polygon_soup soup;
  Query query;
};
Asked_solids asked(const Polygon_soup& a, const Polygon_soup& b, Set_operation operation) {
  Asked_solids of{joined(std::array{a, b}), {}};
  of.query.question = Question::boolean;
  of.query.operation = operation;
  of.query.first = a.face_count();
  return of;
}
const Polygon_soup corner_box = box({0, 0, 0}, {4, 4, 4}), other_box = box({2, 2, 2}, {6, 6, 6});

Polygon_soup result_of(const Asked_solids& of, Set_operation operation) {
  Set_options options;
  options.operation = operation;
  return without_holes(set_operation(Operands(solids_of(of.soup, of.query.first)), options).soup).soup;
}
std::string off(const Polygon_soup& soup) {
  std::ostringstream text;
  write_qoff(soup, text);
  return text.str();
}
Grade graded_surface(const Asked_solids& of, const Polygon_soup& surface) {
  const Truth truth = truth_of(of.soup, of.query);
  EXPECT_EQ(truth.not_asked, "");
  return grade(truth, read_answer(off(surface), Question::boolean, of.soup.face_count()));
}
std::string refusal(const Asked_solids& of, const Polygon_soup& surface) {
  try {
    graded_surface(of, surface);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Solids, have_areas_that_doubles_hold_however_small_a_result_is_beside_them) {
  const Rational least = generate::power_of_two(-540);
  const Polygon_soup crumb = box({0, 0, 0}, {least, least, least});
  const Asked_solids of = asked(corner_box, crumb, Set_operation::intersect);
  EXPECT_FALSE(graded_surface(of, crumb).wrong());
  Polygon_soup two = crumb;  // as many faces again, beyond all points
  add_box(two, {9, 9, 9}, {9 + least, 9 + least, 9 + least});
  const Grade twice = graded_surface(of, two);
  EXPECT_NEAR(twice.area_error, 1, 1e-9);
  EXPECT_NEAR(twice.volume_error, 1, 1e-9);
  Polygon_soup more = crumb;  // so large that its area is none of doubles, in the crumb's unit
  add_box(more, {9, 9, 9}, {10, 10, 10});
  EXPECT_TRUE(graded_surface(of, more).too_large());
  EXPECT_GT(graded_surface(of, more).area_error, 1e100);
}

TEST(Solids, are_asked_about_and_answered_in_off) {
  const Asked_solids of = asked(corner_box, other_box, Set_operation::differ);
  const std::string text = to_json(of.query).dump();
  EXPECT_EQ(text, R"({"query":"boolean","operation":"symmetric-difference","first":6})");
  EXPECT_EQ(to_json(query_from_json(nlohmann::json::parse(text))).dump(), text);
  for (const char* bad : {R"({"query":"boolean","operation":"union"})", R"({"query":"boolean","first":1})",
                          R"({"query":"boolean","operation":"unite","first":1})",
                          R"({"query":"boolean","operation":"union","first":-1})"})
    EXPECT_THROW(query_from_json(nlohmann::json::parse(bad)), std::invalid_argument) << bad;
  const auto read = [](const std::string& answer) { return read_answer(answer, Question::boolean, 12).surface; };
  EXPECT_EQ(read("OFF\n0 0 0\n")->face_count(), 0u);
  EXPECT_EQ(read("OFF 3 1 0\n0 0 0\n0.5 0 0\n0 1 0\n3 0 1 2\n")->point(1)[0], Rational(1, 2));
  EXPECT_EQ(read("OFF 3 1 0\n0 0 0\n1/3 0 0\n0 1 0\n3 0 1 2\n")->point(1)[0], Rational(1, 3));
  // Each number by itself, and comments with a slash.
  EXPECT_EQ(read("OFF # of a/b\n3 1 0\n0 0 0\n1/3 0.5 0\n0 1e1 0\n3 0 1 2\n")->point(1),
            (Exact_point{Rational(1, 3), Rational(1, 2), 0}));
  EXPECT_FALSE(read(" abstained\n"));
  EXPECT_FALSE(read("abstained all"));
  for (const char* bad : {"", "OFF", "OFF\n0 1 0\n3 0 1 2\n", "0\n1\n", "{\"visible\": [1]}"})
    EXPECT_THROW(read(bad), std::invalid_argument) << bad;
  // Numbers of whatever length: no common denominator is needed.
  std::string longer = "OFF 4 1 0\n0 0 0\n";
  for (const unsigned long base : {3u, 5u, 7u}) {
    Integer power;
    mpz_ui_pow_ui(power.get_mpz_t(), base, 2000);
    longer += "1/" + to_string(power) + " 1 " + std::to_string(base) + "\n";
  }
  EXPECT_EQ(read(longer + "3 1 2 3\n")->face_count(), 1u);
}

TEST(Solids, that_bound_nothing_are_not_asked_about) {
  const auto why = [](const Polygon_soup& a, const Polygon_soup& b) {
    const Asked_solids of = asked(a, b, Set_operation::unite);
    return truth_of(of.soup, of.query).not_asked;
  };
  EXPECT_EQ(why(corner_box, other_box), "");
  Polygon_soup open, twice = corner_box, inward;
  open.coordinates = inward.coordinates = corner_box.coordinates;
  for (Face_id f = 0; f < 6; ++f) {
    const std::vector<Point_id> loop(corner_box.loop(f).rbegin(), corner_box.loop(f).rend());
    if (f > 0) open.add_face(corner_box.loop(f));
    inward.add_face(loop);
  }
  add_box(twice, {1, 1, 1}, {2, 2, 2});  // inside the first, its front outwards
  EXPECT_EQ(why(open, other_box), "a solid is not closed");
  EXPECT_EQ(why(corner_box, Polygon_soup()), "a solid has no faces");
  EXPECT_EQ(why(corner_box, twice), "a solid winds otherwise than once round its inside");
  EXPECT_EQ(why(inward, other_box), "a solid winds otherwise than once round its inside");
}

/// Whether each point that is judged is inside what winding numbers say.
void expect_points_as_winding_numbers_say(const Asked_solids& of) {
  const std::array<Polygon_soup, 2> solids = solids_of(of.soup, of.query.first);
  const std::array<harness::Solid_oracle, 2> oracles{harness::Solid_oracle(solids[0]),
                                                     harness::Solid_oracle(solids[1])};
  generate::Random random(1);
  const Solid_truth truth = solid_truth(of.soup, of.query, 1);
  EXPECT_GT(truth.points.size(), 0u);
  for (const Judged_point& point : truth.points) {
    Windings windings;
    for (std::uint32_t operand = 0; operand < 2; ++operand) {
      ASSERT_FALSE(oracles[operand].is_on_a_face(point.at));
      windings.push_back({operand, oracles[operand].winding(point.at, random)});
    }
    EXPECT_EQ(point.inside, is_in_result(of.query.operation, Inside_rule::positive, windings, 2))
        << "beside face " << point.face << ", " << name(of.query.operation);
  }
}

TEST(Solids, have_points_beside_a_face_where_no_corner_touches_it) {
  // Two tetrahedra: the apex of the first is the middle of a face of the second, and between them is nothing.
  Polygon_soup above, below;
  const auto add = [](Polygon_soup& soup, const std::array<std::array<long, 3>, 4>& corners) {
    for (const std::array<long, 3>& p : corners) soup.add_point(Rational(p[0]), Rational(p[1]), Rational(p[2]));
    for (const std::array<Point_id, 3>& face : {std::array<Point_id, 3>{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}})
      soup.add_face(std::vector<Point_id>(face.begin(), face.end()));
  };
  add(above, {{{-1, -5, -2}, {5, 1, 4}, {-1, 1, -2}, {1, -1, -1}}});
  add(below, {{{-1, -3, -3}, {5, -3, 3}, {-1, 3, -3}, {2, -1, -1}}});
  for (const Set_operation operation : set_operations)
    expect_points_as_winding_numbers_say(asked(above, below, operation));
}

TEST(Solids, of_pairs_that_touch_have_points_as_winding_numbers_say) {
  for (const generate::Family& family : generate::families())
    for (std::uint64_t seed = 1; family.pair && seed <= test_scenes::sample(12u); ++seed) {
      generate::Family_parameters parameters;
      parameters.seed = seed;
      parameters.size = family.small_size;
      const generate::Posed_scene posed = family.make(parameters);
      SCOPED_TRACE(posed.name);
      const std::array<Polygon_soup, 2> solids = solids_of(posed.soup, posed.first);
      for (const Set_operation operation : set_operations)
        expect_points_as_winding_numbers_say(asked(solids[0], solids[1], operation));
    }
}

TEST(Solids, of_two_boxes_are_right_for_one_operation_alone) {
  for (const Set_operation operation : set_operations)
    for (const Set_operation said : set_operations) {
      const Asked_solids of = asked(corner_box, other_box, operation);
      const Grade grade = graded_surface(of, result_of(of, said));
      EXPECT_EQ(grade.wrong(), said != operation) << name(operation) << " answered by " << name(said);
      EXPECT_EQ(grade.wrong_points.empty(), said == operation);
    }
  const Asked_solids both = asked(corner_box, other_box, Set_operation::intersect);
  const Grade more = graded_surface(both, corner_box);
  EXPECT_TRUE(more.wrong_hidden.empty());
  EXPECT_FALSE(more.wrong_visible.empty());
  EXPECT_DOUBLE_EQ(more.volume_error, 7);
  EXPECT_DOUBLE_EQ(more.area_error, 3);
  EXPECT_TRUE(keeps(Contract::conservative, more));
  EXPECT_FALSE(keeps(Contract::aggressive, more));
  const Grade less = graded_surface(both, box({2, 2, 2}, {4, 4, 3}));
  EXPECT_TRUE(less.wrong_visible.empty());
  EXPECT_DOUBLE_EQ(less.volume_error, -0.5);
  EXPECT_FALSE(keeps(Contract::conservative, less));
  EXPECT_TRUE(keeps(Contract::aggressive, less));
  const Grade open = grade(truth_of(both.soup, both.query), read_answer("abstained\n", Question::boolean, 12));
  EXPECT_EQ(open.abstained.size(), open.judged);
  EXPECT_FALSE(open.wrong());
  EXPECT_EQ(mark_of(open), Mark::abstained);
}

TEST(Solids, are_surfaces_that_wind_once) {
  const Asked_solids of = asked(corner_box, other_box, Set_operation::unite);
  // Both as they are wind twice round what they share.
  const Grade twice = graded_surface(of, of.soup);
  EXPECT_TRUE(twice.wrong_hidden.empty());
  ASSERT_FALSE(twice.wrong_points.empty());
  EXPECT_TRUE(std::all_of(twice.wrong_points.begin(), twice.wrong_points.end(),
                          [](const Wrong_point& p) { return p.inside && p.winding == 2; }));
  // Not closed.
  const Polygon_soup exact = result_of(of, Set_operation::unite);
  Polygon_soup holed;
  holed.coordinates = exact.coordinates;
  for (Face_id f = 1; f < exact.face_count(); ++f) holed.add_face(exact.loop(f));
  EXPECT_NE(refusal(of, holed).find("not closed"), std::string::npos) << refusal(of, holed);
  EXPECT_NE(refusal(of, holed).find("edges without an opposite, one between ("), std::string::npos);
  // Closed though an edge is met by two: no vertex is inside it.
  Polygon_soup halves;
  add_box(halves, {0, 0, 0}, {4, 4, 2});
  add_box(halves, {0, 0, 2}, {2, 4, 4});
  add_box(halves, {2, 0, 2}, {4, 4, 4});
  const Asked_solids same = asked(corner_box, corner_box, Set_operation::intersect);
  EXPECT_EQ(refusal(same, halves), "nothing");
  const Grade walls = graded_surface(same, halves);  // the halves' walls are in it: no volume, but area
  EXPECT_EQ(walls.volume_error, 0);
  EXPECT_DOUBLE_EQ(walls.area_error, 0.5);
  EXPECT_TRUE(walls.wrong());
  const Rational huge = generate::power_of_two(900);  // no double holds its square
  const Polygon_soup corner = generate::scaled(corner_box, huge);
  const Asked_solids far = asked(corner, corner, Set_operation::intersect);
  EXPECT_DOUBLE_EQ(graded_surface(far, generate::scaled(halves, huge)).area_error, 0.5);
  // One face of many corners, its neighbours of fewer: edges are matched in parts.
  Polygon_soup junctions;
  for (Face_id f = 0; f < 6; ++f) {
    std::vector<Point_id> loop;
    for (const Point_id p : corner_box.loop(f)) {
      const Exact_point at = corner_box.point(p);
      loop.push_back(junctions.add_point(at[0], at[1], at[2]));
    }
    const Exact_point p = junctions.point(loop[0]), q = junctions.point(loop[1]);
    if (f == 3)
      loop.insert(loop.begin() + 1, junctions.add_point((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2));
    junctions.add_face(loop);
  }
  EXPECT_FALSE(graded_surface(same, junctions).wrong());
  // A face that crosses itself.
  Polygon_soup bow = corner_box;
  const Point_id first = bow.add_point(9, 0, 0);
  bow.add_point(10, 1, 0);
  bow.add_point(10, 0, 0);
  bow.add_point(9, 1, 0);
  bow.add_face({first, first + 1, first + 2, first + 3});
  EXPECT_EQ(refusal(same, bow), "face 6 crosses itself");
}

TEST(Solids, may_be_rounded_and_nothing_more) {
  const Asked_solids of = asked(corner_box, other_box, Set_operation::unite);
  const Polygon_soup exact = result_of(of, Set_operation::unite);
  const auto moved_corner = [&](int bits) {
    return generate::mapped(exact, [&](Point_id, const Exact_point& p) {
      return p == Exact_point{6, 6, 6} ? Exact_point{6 + generate::power_of_two(bits), 6, 6} : p;
    });
  };
  EXPECT_FALSE(graded_surface(of, moved_corner(-40)).wrong());
  EXPECT_TRUE(graded_surface(of, moved_corner(-10)).wrong());
  // What no point that is judged is in shows in the volume.
  Polygon_soup void_in_it = exact;
  add_box(void_in_it, {10, 10, 10}, {10 + Rational(1, 4), 10 + Rational(1, 4), 10 + Rational(1, 4)});
  const Grade island = graded_surface(of, void_in_it);
  EXPECT_TRUE(island.wrong());
  EXPECT_TRUE(island.too_large());
  EXPECT_TRUE(island.wrong_points.empty());
  // Of an empty result the errors are shares of both solids.
  const Asked_solids none = asked(corner_box, corner_box, Set_operation::subtract);
  EXPECT_FALSE(graded_surface(none, Polygon_soup()).wrong());
  EXPECT_DOUBLE_EQ(graded_surface(none, corner_box).volume_error, 0.5);
}

TEST(Solids, of_which_a_face_is_not_planar_are_measured_where_their_points_are) {
  // A pyramid of four sides; two of them together are one face, wherever its loop begins.
  Polygon_soup pyramid;
  for (const auto& [x, y, z] : {std::array{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}, {4, 4, 8}})
    pyramid.add_point(Rational(x), Rational(y), Rational(z));
  for (const std::vector<Point_id>& loop :
       {std::vector<Point_id>{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}})
    pyramid.add_face(loop);
  const Asked_solids of = asked(pyramid, pyramid, Set_operation::unite);
  std::set<std::pair<std::size_t, double>> found;
  for (std::size_t turn = 0; turn < 4; ++turn) {
    Polygon_soup answer;
    answer.coordinates = pyramid.coordinates;
    for (const std::vector<Point_id>& loop : {std::vector<Point_id>{0, 3, 2, 1}, {2, 3, 4}, {3, 0, 4}})
      answer.add_face(loop);
    std::vector<Point_id> bent{0, 1, 2, 4};
    std::rotate(bent.begin(), bent.begin() + static_cast<std::ptrdiff_t>(turn), bent.end());
    answer.add_face(bent);
    const Grade grade = graded_surface(of, answer);
    found.emplace(grade.wrong_points.size(), grade.volume_error);
    EXPECT_EQ(grade.wrong_points.empty(), grade.volume_error == 0);
  }
  EXPECT_EQ(found.size(), 1u);
}

/// What is asked about a family, far from degenerate or not.
std::vector<std::pair<Case, std::string>> some_cases() {
  std::vector<std::pair<Case, std::string>> cases;
  Case_options options;
  options.question = Question::boolean;
  std::uint64_t seed = 0;
  for (const char* family : {"boxes", "leaves", "touching_faces", "hinged", "tangle", "crossing_faces"})
    for (const std::int64_t ulps : {std::int64_t{0}, std::int64_t{1}, generate::far_ulps}) {
      ++seed;
      generate::Family_parameters parameters;
      parameters.seed = seed;
      parameters.ulps = ulps;
      parameters.size = generate::family(family).small_size;
      const Case made = case_of(generate::family(family), parameters, options);
      if (made.not_asked.empty() && flaw_of_solids(made.soup, made.query.first).empty())
        cases.emplace_back(made, std::string(family) + ", seed " + std::to_string(seed) + ", ulps " +
                                     std::to_string(ulps) + ", " + name(made.query.operation));
    }
  return cases;
}

/// The law: an answer is right iff nothing is in it or in the exact result alone.
TEST(Solids, of_families_are_right_iff_they_differ_by_nothing) {
  std::size_t right = 0, wrong = 0;
  for (const auto& [made, what] : some_cases()) {
    const Asked_solids of{made.soup, made.query};
    const auto truth = solid_truth(of.soup, of.query);
    const Polygon_soup exact = result_of(of, of.query.operation);
    for (const Set_operation said : set_operations) {
      Answer answer;
      answer.surface = result_of(of, said);
      const std::array<Polygon_soup, 2> both{exact, *answer.surface};
      Set_options options;
      options.operation = Set_operation::differ;
      const bool differs = volume(set_operation(Operands(both), options).soup) != 0;
      EXPECT_EQ(!grade_solid(truth, answer).wrong_points.empty(), differs) << what << " answered by " << name(said);
      ++(differs ? wrong : right);
    }
  }
  EXPECT_GT(right, 8u);
  EXPECT_GT(wrong, 8u);
}

/// What points are said to be, winding numbers of each solid by brute force say, too; and each cell has a point.
TEST(Solids, are_judged_at_points_of_every_cell) {
  std::size_t inside = 0, outside = 0;
  for (const auto& [made, what] : some_cases()) {
    const std::array<Polygon_soup, 2> solids = solids_of(made.soup, made.query.first);
    const harness::Solid_oracle a(solids[0]), b(solids[1]);
    generate::Random random(1);
    std::set<std::pair<int, int>> cells;
    for (const Judged_point& point : solid_truth(made.soup, made.query).points) {
      ASSERT_FALSE(a.is_on_a_face(point.at) || b.is_on_a_face(point.at)) << what;
      const int in_a = a.winding(point.at, random), in_b = b.winding(point.at, random);
      cells.emplace(in_a, in_b);
      const Set_operation operation = made.query.operation;
      const bool expected = operation == Set_operation::unite       ? in_a == 1 || in_b == 1
                            : operation == Set_operation::intersect ? in_a == 1 && in_b == 1
                            : operation == Set_operation::subtract  ? in_a == 1 && in_b == 0
                                                                    : in_a != in_b;
      ASSERT_EQ(point.inside, expected) << what;
      ASSERT_TRUE((point.face < made.query.first ? a : b).is_on_a_face(point.on)) << what;
      ++(expected ? inside : outside);
    }
    for (const auto& [cell, operation] :
         {std::pair(std::pair(1, 1), Set_operation::intersect), std::pair(std::pair(1, 0), Set_operation::subtract)})
      EXPECT_EQ(cells.count(cell) > 0, volume(result_of({made.soup, made.query}, operation)) > 0) << what;
  }
  EXPECT_GT(inside, 100u);
  EXPECT_GT(outside, 100u);
}

TEST(Solids, are_judged_at_points_anywhere_too) {
  const Asked_solids of = asked(corner_box, other_box, Set_operation::unite);
  std::size_t anywhere = 0;  // the others are off a face along an axis
  for (const Judged_point& point : solid_truth(of.soup, of.query).points) {
    std::size_t apart = 0;
    for (std::size_t k = 0; k < 3; ++k) apart += point.at[k] != point.on[k];
    anywhere += apart > 1;
  }
  EXPECT_GE(anywhere, 8u);
}

TEST(Solids, keep_the_holes_of_their_faces) {
  Polygon_soup frame;
  for (const long size : {3, 1})
    for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) frame.add_point(size * x, size * y, 0);
  frame.add_face({0, 1, 2, 3});
  frame.add_hole({7, 6, 5, 4});
  const std::array<Polygon_soup, 2> solids = solids_of(joined(std::array{frame, frame}), 1);
  for (const Polygon_soup& solid : solids) {
    ASSERT_EQ(solid.face_count(), 1u);
    EXPECT_EQ(solid.loop_count(0), 2u);
  }
}

TEST(Solids, that_are_wrong_are_explained_and_guessed_about) {
  const Asked_solids of = asked(corner_box, other_box, Set_operation::subtract);
  Answer answer;
  answer.surface = other_box;
  const Grade wrong = grade(truth_of(of.soup, of.query), answer);
  const Explanation lacking = explain(of.soup, of.query, answer, wrong, Contract::exact);
  ASSERT_TRUE(lacking.refutation);
  EXPECT_NE(lacking.refutation->words.find(" is inside the result, and the answer winds round it 0 times"),
            std::string::npos)
      << lacking.refutation->words;
  EXPECT_GT(lacking.share, 0.2);
  const Explanation extra = explain(of.soup, of.query, answer, wrong, Contract::aggressive);
  EXPECT_NE(extra.refutation->words.find(" is outside the result, and the answer winds round it 1 times"),
            std::string::npos)
      << extra.refutation->words;
  const auto fits = [&](const Polygon_soup& surface) {
    std::vector<Reading> found;
    Answer said;
    said.surface = surface;
    for (const Reading reading : readings_of(Question::boolean))
      if (is_right(reading, of.soup, of.query, said, {})) found.push_back(reading);
    return found;
  };
  using Readings = std::vector<Reading>;
  EXPECT_EQ(fits(other_box), Readings());
  const Asked_solids turned = asked(other_box, corner_box, Set_operation::subtract);
  EXPECT_EQ(fits(result_of(turned, Set_operation::subtract)), (Readings{Reading::swapped}));
  Polygon_soup inward;
  const Polygon_soup exact = result_of(of, Set_operation::subtract);
  inward.coordinates = exact.coordinates;
  for (Face_id f = 0; f < exact.face_count(); ++f)
    inward.add_face(std::vector<Point_id>(exact.loop(f).rbegin(), exact.loop(f).rend()));
  EXPECT_EQ(fits(inward), (Readings{Reading::inside_out}));
}

TEST(Solids, are_moved_apart_as_eyes_are) {
  const Asked_solids of = asked(corner_box, other_box, Set_operation::unite);
  Case_options options;
  options.question = Question::boolean;
  const Case given = case_of(of.soup, of.query, options);
  EXPECT_TRUE(given.as_given);
  const Case away = moved(given, {9, 0, 0}, options);
  EXPECT_EQ(volume(result_of({away.soup, away.query}, Set_operation::intersect)), 0);
  EXPECT_EQ(volume(result_of({away.soup, away.query}, Set_operation::unite)), 128);
}

TEST(Solid_truth, is_there_where_a_solid_is_rounded_to_two_points) {
  Polygon_soup flat;  // a tetrahedron of which two corners are at each
  for (const long x : {0L, 9L, 0L, 9L}) flat.add_point(Rational(x), Rational(x), Rational(x));
  for (const auto& [a, b, c] : {std::array{0u, 2u, 1u}, {0u, 1u, 3u}, {1u, 2u, 3u}, {0u, 3u, 2u}})
    flat.add_face({a, b, c});
  const Asked_solids both = asked(box({0, 0, 0}, {1, 1, 1}), flat, Set_operation::differ);
  ASSERT_EQ(flaw_of_solids(both.soup, both.query.first), "");
  EXPECT_EQ(solid_truth(both.soup, both.query).volume, 1);
}

}  // namespace
