// Judging: the protocol, the truth, grades and contracts.

#include "../sample.h"

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/soups.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/judge/explain.h>
#include <sightline/harness/judge/guess.h>
#include <sightline/harness/judge/rays.h>
#include <sightline/harness/judge/truth.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <iostream>

// ---- harness/judge/README.md

#include <sightline/harness/judge/truth.h>
#include <sightline/algorithms/covering_of_scene.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/harness/generate/random.h>

/// text: what a program answered to the query.
void grade_text(const sightline::Polygon_soup& soup, const sightline::judge::Query& query, const std::string& text,
                std::ostream& out) {
  const sightline::judge::Truth truth = sightline::judge::truth_of(soup, query);
  const sightline::judge::Answer answer = sightline::judge::read_answer(text, query.question, soup.face_count());
  const sightline::judge::Grade grade = sightline::judge::grade(truth, answer);
  for (const sightline::Face_id face : grade.wrong_visible) out << "face " << face << " is shown but hidden\n";
  for (const sightline::Face_id face : grade.wrong_hidden) out << "face " << face << " is missing but visible\n";
}

namespace {

using namespace sightline;
using namespace sightline::judge;

const std::uint64_t rounds = test_scenes::is_sanitized() ? 10 : 40;

/// A square of side 2 around the axis of z that looks up.
void add_square(Polygon_soup& soup, const Rational& x, const Rational& z, const Rational& half = 1) {
  std::vector<Point_id> loop;
  for (const auto& [dx, dy] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
    loop.push_back(soup.add_point(x + half * dx, half * dy, z));
  soup.add_face(loop);
}
/// Squares at these heights, one above the other.
Polygon_soup tower(std::initializer_list<int> heights) {
  Polygon_soup soup;
  for (const int z : heights) add_square(soup, 0, z);
  return soup;
}
Query question(Question kind, const Exact_point& eye, bool two_sided = false) {
  Query query;
  query.question = kind;
  query.eye = eye;
  query.two_sided = two_sided;
  return query;
}
Grade graded_by(const Truth_options& options, const Polygon_soup& soup, const Query& query, const std::string& text) {
  const Truth truth = truth_of(soup, query, options);
  EXPECT_EQ(truth.not_asked, "");
  return grade(truth, read_answer(text, query.question, soup.face_count(), query.rays.size()));
}
Grade graded(const Polygon_soup& soup, const Query& query, const std::string& text, bool cycles = false) {
  Truth_options options;
  options.cycles = cycles;
  return graded_by(options, soup, query, text);
}
using Faces = std::vector<Face_id>;

// ---- The protocol

TEST(Protocol, writes_doubles_as_numbers_and_others_as_fractions) {
  EXPECT_EQ(to_json(question(Question::see, {Rational(1, 2), Rational(1, 3), -3}, true)).dump(),
            R"({"query":"see","eye":[0.5,"1/3",-3.0],"two_sided":true})");
  Query weak = question(Question::weak, {0, 0, 0});
  weak.source = {{0, 0, 1}, {exact(0x1p-1074), 0, 1}, {0, 1, 1}};
  for (const Query& query : {weak, question(Question::order, {exact(0.1), Rational(1, 10), exact(1e300)}, true)}) {
    const Query again = query_from_json(nlohmann::json::parse(to_json(query).dump()));
    EXPECT_EQ(again.question, query.question);
    EXPECT_EQ(again.eye == query.eye, true);
    EXPECT_EQ(again.source == query.source, true);
    EXPECT_EQ(again.two_sided, query.two_sided);
  }
  for (const char* bad :
       {"[]", R"({"eye":[0,0,0],"two_sided":false})", R"({"query":"look","eye":[0,0,0],"two_sided":false})",
        R"({"query":"see","eye":[0,0],"two_sided":false})", R"({"query":"see","eye":[0,0,0],"two_sided":1})",
        R"({"query":"weak","source":[[0,0,"a"]],"two_sided":false})"})
    EXPECT_THROW(query_from_json(nlohmann::json::parse(bad)), std::invalid_argument) << bad;
}

TEST(Protocol, reads_answers_as_json_and_as_lines) {
  for (const char* text : {R"({"visible": [3, 1, 3], "abstained": [2]})", "3\n1\r\n\n  3 \nabstained 2"}) {
    const Answer answer = read_answer(text, Question::see, 4);
    EXPECT_EQ(answer.visible, (Faces{1, 3})) << text;
    EXPECT_EQ(answer.abstained, (Faces{2})) << text;
  }
  EXPECT_TRUE(read_answer("", Question::weak, 4).visible.empty());
  for (const char* text : {R"({"abstained": "all"})", "abstained all\n"})
    EXPECT_EQ(read_answer(text, Question::see, 3).abstained, (Faces{0, 1, 2})) << text;
  const Answer order = read_answer(
      R"({"order": [2, {"face": 0, "vertices": [[0, 0.5, "1/3"], [1, 0, 0], [0, 1, 0]]}, 1]})", Question::order, 3);
  ASSERT_EQ(order.order.size(), 3u);
  EXPECT_EQ(order.order[0].face, 2u);
  EXPECT_TRUE(order.order[0].part.empty());
  EXPECT_EQ((order.order[1].part.at(0) == Exact_point{0, Rational(1, 2), Rational(1, 3)}), true);
}

/// What reading an answer says is wrong; "nothing" where it says nothing.
std::string refusal_of(const std::function<void()>& reading) {
  try {
    reading();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Protocol, says_what_is_wrong_with_an_answer) {
  const auto what = [](const char* text, Question question = Question::see) {
    return refusal_of([&] { read_answer(text, question, 3); });
  };
  EXPECT_EQ(what("{\"visible\": [0"), "begins with { but is not JSON");
  EXPECT_EQ(what("{\"visble\": [0]}"), "has no \"visible\": write {\"visible\": [0, 4, 7]}");
  EXPECT_EQ(what("{\"visible\": 0}"), "\"visible\" is no list");
  EXPECT_EQ(what("{\"visible\": [0, -1]}"), "visible[1] is no face; write its number, from 0");
  EXPECT_EQ(what("{\"visible\": [3]}"), "visible[0] names face 3; the scene has faces 0 to 2");
  EXPECT_EQ(what("{\"visible\": [1], \"abstained\": [1]}"), "face 1 is both answered and abstained from");
  EXPECT_EQ(what("{\"visible\": [1], \"abstained\": \"some\"}"),
            "\"abstained\" is neither a list of faces nor \"all\"");
  EXPECT_EQ(what("0\nface 1\n"), "line 2 holds more than one face; write one a line");
  EXPECT_EQ(what("0\n1.0\n"), "line 2: \"1.0\" is no face; write its number, from 0");
  EXPECT_EQ(what("abstained\n"), "line 1: \"\" is no face; write its number, from 0");
  EXPECT_EQ(what("0\n7\n"), "line 2 names face 7; the scene has faces 0 to 2");
  EXPECT_EQ(what("99999999999999999999\n"), "line 1: \"99999999999999999999\" is no face; write its number, from 0");
  EXPECT_EQ(what("0\n1\n0\n", Question::order), "face 0 is in the order twice");
  EXPECT_EQ(what("0\nabstained 0\n", Question::order), "face 0 is both answered and abstained from");
  EXPECT_EQ(what("{\"order\": [{\"face\": 0}]}", Question::order),
            "order[0] is neither a face nor a part {\"face\": 0, \"vertices\": [[x, y, z], ...]}");
  EXPECT_EQ(what("{\"order\": [{\"face\": 0, \"vertices\": [[0, 0, 0], [1, 0, 0]]}]}", Question::order),
            "order[0] has fewer than three vertices; give the corners of a convex part of the face");
  EXPECT_EQ(what("{\"order\": [0, {\"face\": 0, \"vertices\": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}]}", Question::order),
            "face 0 is in the order as a whole and in parts");
  EXPECT_EQ(what("{\"order\": [{\"face\": 0, \"vertices\": [[0, 0, 0], [1, 0, null], [0, 1, 0]]}]}", Question::order),
            "order[0].vertices[1] is no number; write 0.5, or \"1/3\" where it is no double");
}

TEST(Protocol, takes_memory_in_proportion_to_an_answer_and_its_scene) {
  constexpr std::size_t faces = 100000;
  std::string text;
  for (int k = 0; k < 1000; ++k) text += "abstained all\n";
  const Answer answer = read_answer(text, Question::see, faces);
  EXPECT_EQ(answer.abstained.size(), faces);
  EXPECT_LE(answer.abstained.capacity(), 2 * faces);
}

// ---- See and weak

TEST(Truth, of_an_eye_above_two_squares) {
  const Polygon_soup soup = tower({0, 1});
  const Query above = question(Question::see, {0, 0, 5});
  EXPECT_FALSE(graded(soup, above, "1\n").wrong());
  EXPECT_EQ(graded(soup, above, "1\n").judged, 2u);
  EXPECT_EQ(graded(soup, above, "0\n1\n").wrong_visible, (Faces{0}));
  EXPECT_EQ(graded(soup, above, "").wrong_hidden, (Faces{1}));
  const Grade open = graded(soup, above, "abstained 1\n0\n");
  EXPECT_EQ(open.abstained, (Faces{1}));
  EXPECT_EQ(open.wrong_visible, (Faces{0}));
  EXPECT_TRUE(open.wrong_hidden.empty());
  // From below they are seen from behind.
  EXPECT_FALSE(graded(soup, question(Question::see, {0, 0, -5}), "").wrong());
  EXPECT_EQ(graded(soup, question(Question::see, {0, 0, -5}, true), "1\n").wrong_hidden, (Faces{0}));
  EXPECT_EQ(graded(soup, question(Question::see, {0, 0, -5}, true), "1\n").wrong_visible, (Faces{1}));
}

TEST(Truth, of_a_lamp_above_two_squares) {
  const Polygon_soup soup = tower({0, 1});
  Query lamp = question(Question::weak, {0, 0, 0});
  lamp.source = {{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}};  // looks down, as large as they are
  EXPECT_EQ(graded(soup, lamp, "0\n1\n").wrong_visible, (Faces{0}));
  EXPECT_FALSE(graded(soup, lamp, "1\n").wrong());
  lamp.source = {{-3, -3, 2}, {-3, 3, 2}, {3, 3, 2}, {3, -3, 2}};  // larger
  EXPECT_EQ(graded(soup, lamp, "1\n").wrong_hidden, (Faces{0}));
  EXPECT_FALSE(graded(soup, lamp, "0\n1\n").wrong());
  std::reverse(lamp.source.begin(), lamp.source.end());
  EXPECT_EQ(graded(soup, lamp, "1\n").wrong_visible, (Faces{1}));
  lamp.source = {{-1, -1, -2}, {1, -1, -2}, {1, 1, -2}, {-1, 1, -2}};  // looks up at their backs
  EXPECT_EQ(graded(soup, lamp, "0\n").wrong_visible, (Faces{0}));
  lamp.two_sided = true;
  EXPECT_FALSE(graded(soup, lamp, "0\n").wrong());
  lamp.source = {{0, 0, 2}, {1, 0, 2}, {2, 0, 2}};
  EXPECT_NE(truth_of(soup, lamp).not_asked, "");
}

TEST(Truth, leaves_out_faces_that_are_none) {
  Polygon_soup soup = tower({0, 1});
  soup.add_face({0, 1, 1});                                 // 2: no area
  soup.add_face({soup.loop(1)[2], soup.loop(1)[3], 4, 5});  // 3: face 1 once more
  const Query above = question(Question::see, {0, 0, 5});
  EXPECT_EQ(graded(soup, above, "1\n").judged, 2u);
  EXPECT_FALSE(graded(soup, above, "1\n2\n3\n").wrong());
  EXPECT_FALSE(graded(soup, question(Question::order, {0, 0, 5}), "2\n0\n1\n").wrong());
  Polygon_soup bow;
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 1), std::pair(1, 0), std::pair(0, 1)})
    bow.add_point(Rational(x), Rational(y), Rational(0));
  bow.add_face({0, 1, 2, 3});
  bow.add_face({0, 1, 2});
  EXPECT_NE(truth_of(bow, above).not_asked, "");
  EXPECT_NE(truth_of(Polygon_soup(), above).not_asked, "");
}

TEST(Truth, is_about_planar_faces_on_doubles) {
  Polygon_soup soup = tower({0});
  soup.add_point(Rational(1, 3), Rational(1, 7), Rational(1, 10));
  soup.add_face({0, 1, 2, 4});  // not planar
  add_square(soup, 0, 2);
  const Polygon_soup planar = with_planar_faces(soup);
  EXPECT_EQ(planar.face_count(), 4u);
  EXPECT_EQ(planar.point_count(), soup.point_count());
  const Scene scene(planar);
  EXPECT_TRUE(scene.non_planar().empty());
  EXPECT_EQ(planar.loop(3).size(), 4u);
  EXPECT_EQ(with_planar_faces(planar).face_count(), 4u);

  const Polygon_soup doubles = rounded_to_doubles(soup);
  for (std::size_t k = 0; k < doubles.coordinates.size(); ++k)
    EXPECT_EQ(exact(nearest_double(soup.coordinates[k])), doubles.coordinates[k]);
  EXPECT_NE(doubles.coordinates[12], soup.coordinates[12]);
  Query query = question(Question::weak, {0, 0, Rational(1, 3)});
  query.source = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(rounded_to_doubles(query).source.size(), 4u);
  EXPECT_EQ(rounded_to_doubles(query).eye[2], exact(1.0 / 3));
  // 0.1 and 0.2 are not 0.3: three of four corners stay in one plane.
  query.source = {{0, 0, 0}, {1, 0, Rational(1, 10)}, {1, 1, Rational(3, 10)}, {0, 1, Rational(1, 5)}};
  EXPECT_EQ(rounded_to_doubles(query).source.size(), 3u);
  EXPECT_THROW(rounded_to_doubles(Exact_point{exact_decimal(1, 400), 0, 0}), std::domain_error);
}

// ---- Orders

TEST(Orders, of_a_tower) {
  const Polygon_soup soup = tower({0, 1, 2});
  const Query above = question(Question::order, {0, 0, 5});
  EXPECT_FALSE(graded(soup, above, "0\n1\n2\n").wrong());
  EXPECT_EQ(graded(soup, above, "0\n1\n2\n").judged, 3u);
  const Grade swapped = graded(soup, above, "0\n2\n1\n");
  ASSERT_EQ(swapped.wrong_pairs.size(), 1u);
  EXPECT_EQ(swapped.wrong_pairs[0], (std::array<Face_id, 2>{2, 1}));
  EXPECT_EQ(swapped.wrong_hidden, (Faces{2}));
  EXPECT_EQ(swapped.wrong_visible, (Faces{1}));
  EXPECT_EQ(graded(soup, above, "0\n2\n").wrong_hidden, (Faces{1}));
  const Grade open = graded(soup, above, "0\n2\nabstained 1\n");
  EXPECT_FALSE(open.wrong());
  EXPECT_EQ(open.abstained, (Faces{1}));
  // From below none is on-view: they may be missing, but not in the wrong order.
  EXPECT_FALSE(graded(soup, question(Question::order, {0, 0, -5}), "").wrong());
  EXPECT_EQ(graded(soup, question(Question::order, {0, 0, -5}), "0\n1\n").wrong_pairs.size(), 1u);
  EXPECT_EQ(graded(soup, question(Question::order, {0, 0, -5}, true), "").wrong_hidden.size(), 3u);
  // In the plane of one of them: it may stand anywhere.
  for (const char* order : {"0\n1\n2\n", "1\n0\n2\n", "0\n2\n"})
    EXPECT_FALSE(graded(soup, question(Question::order, {0, 0, 1}, true), order).wrong()) << order;
}

TEST(Orders, have_wrong_pairs_whatever_else_is_wrong) {
  const Scene scene(tower({0, 1, 2}));
  const Order_truth truth(scene, {0, 0, 5}, true);
  Answer answer;
  answer.order = {{2, {}}, {0, {}}};  // 1 is missing
  EXPECT_EQ(truth.wrong_pairs(answer), (std::vector<std::array<Face_id, 2>>{{2, 0}}));
  answer.order = {{2, {}}, {1, {}}, {0, {}}};
  EXPECT_EQ(truth.wrong_pairs(answer), (std::vector<std::array<Face_id, 2>>{{1, 0}, {2, 0}, {2, 1}})) << "sorted";
  answer.order = {{0, {}}, {1, {}}, {2, {}}};
  EXPECT_TRUE(truth.wrong_pairs(answer).empty());
}

TEST(Orders, of_a_face_of_thousands_of_corners_in_as_many_parts_are_judged_as_fast_as_of_one_of_few) {
  // Between a parabola and a chord of it, in strips: a minute where each part asked for all of the face.
  constexpr int n = 5000;
  Polygon_soup soup;
  std::vector<Point_id> corners;
  for (int x = 0; x < n; ++x) corners.push_back(soup.add_point(x, x * x, 0));
  soup.add_face(corners);
  Answer answer;
  for (int x = 0; x + 1 < n; ++x) {
    const int y = (n - 1) * x, on = x + 1;
    answer.order.push_back({0, {{x, x * x, 0}, {on, on * on, 0}, {on, y + n - 1, 0}, {x, y, 0}}});
  }
  EXPECT_TRUE(Order_truth(Scene(soup), {0, 0, 5}, true).wrong_pairs(answer).empty());
}

TEST(Orders, of_squares_a_hair_apart_are_judged_exactly) {
  Polygon_soup soup;
  add_square(soup, 0, 1);
  add_square(soup, 0, 1 + exact(0x1p-52));
  const Query above = question(Question::order, {0, 0, 5});
  EXPECT_FALSE(graded(soup, above, "0\n1\n").wrong());
  EXPECT_TRUE(graded(soup, above, "1\n0\n").wrong());
}

std::string part(int face, double x0, double x1, double z) {
  Json corners = Json::array();
  for (const auto& [x, y] : {std::pair(x0, -1), std::pair(x1, -1), std::pair(x1, 1), std::pair(x0, 1)})
    corners.push_back({x, y, z});
  return Json{{"face", face}, {"vertices", corners}}.dump();
}

TEST(Orders, may_hold_parts_with_rounded_corners) {
  const Polygon_soup soup = tower({0, 1});
  const Query above = question(Question::order, {0, 0, 5});
  const auto order = [](const std::string& entries) { return "{\"order\": [" + entries + "]}"; };
  EXPECT_FALSE(graded(soup, above, order(part(0, -1, 0.25, 0) + "," + part(0, 0.25, 1, 0) + ", 1")).wrong());
  EXPECT_FALSE(graded(soup, above, order(part(0, -1, 0.25, 1e-9) + "," + part(0, 0.2500001, 1, 0) + ", 1"))
                   .wrong());  // beside the plane; a gap that nobody sees
  EXPECT_EQ(graded(soup, above, order(part(0, -1, 0.25, 0) + "," + part(0, 0.3, 1, 0) + ", 1")).wrong_hidden,
            (Faces{0}));
  EXPECT_EQ(graded(soup, above, order(part(0, -1, 0.25, 0) + "," + part(0, 0.25, 1.5, 0) + ", 1")).wrong_visible,
            (Faces{0}));
  const Grade over = graded(soup, above, order(part(0, -1, 0.25, 0) + ", 1, " + part(0, 0.25, 1, 0)));
  EXPECT_EQ(over.wrong_pairs.size(), 1u);
  EXPECT_EQ(over.wrong_hidden, (Faces{1}));
  // What is missing is 2^-20 of the face, and no more: rounding may be that.
  std::string nearly_all = part(0, -1, 0.999998, 0);
  for (std::size_t at; (at = nearly_all.find("0.999998,")) != std::string::npos;)
    nearly_all.replace(at, 8, "0.99999809265136718750");
  EXPECT_FALSE(graded(soup, above, order(nearly_all + ", 1")).wrong());
  EXPECT_EQ(graded(soup, above, order(part(0, 0.25, 0.25, 0) + ", 1")).wrong_hidden, (Faces{0}));  // without area
  // Out of the plane by 2^-20 of the face's size, and more.
  EXPECT_FALSE(graded(soup, above, order(part(0, -1, 1, 0x1p-19) + ", 1")).wrong());
  EXPECT_FALSE(graded(soup, above, order(part(0, -1, 1, -0x1p-19) + ", 1")).wrong());
  for (const double z : {0x1.00001p-19, -0x1.00001p-19, 777.0, 1e300})
    EXPECT_EQ(graded(soup, above, order(part(0, -1, 1, z) + ", 1")).wrong_visible, (Faces{0})) << z;
}

TEST(Orders, in_a_cycle_are_asked_only_where_parts_are) {
  const Query above = question(Question::order, {0, 0, 1000});
  const Polygon_soup soup = generate::bars(3);
  EXPECT_NE(truth_of(soup, above).not_asked, "");
  std::vector<Face_id> order{0, 1, 2};
  do {
    std::string text;
    for (const Face_id face : order) text += std::to_string(face) + "\n";
    EXPECT_TRUE(graded(soup, above, text, true).wrong());
  } while (std::next_permutation(order.begin(), order.end()));
}

/// Random triangles, some of them parallel to the axes, with an eye above.
struct Heap {
  Polygon_soup soup;
  Exact_point eye;
};
Heap heap(std::uint64_t seed, std::size_t faces) {
  generate::Random random(seed);
  Heap made;
  made.soup = generate::soup(faces, 0.6, seed, 6);
  for (std::size_t k = 0; k < 3; ++k) made.eye[k] = Rational(static_cast<long>(random.between(-8, 16))) / 8;
  return made;
}

TEST(Orders, of_whole_faces_are_graded_as_verify_accepts_them) {
  std::size_t accepted = 0, rejected = 0, cycles = 0;
  for (std::uint64_t seed = 0; seed < rounds; ++seed) {
    const Heap made = heap(seed, 4);
    const Scene scene(made.soup);
    const Truth truth = truth_of(made.soup, question(Question::order, made.eye, true), {1, 20, true});
    std::vector<Face_id> order{0, 1, 2, 3};
    bool some = false;
    do {
      Order_certificate certificate;
      certificate.eye = made.eye;
      add_pieces(certificate, scene);
      Answer answer;
      for (const Face_id face : order) {
        Order_fragment& fragment = certificate.fragments.emplace_back();
        fragment.face = face;
        for (const Point_id p : made.soup.loop(face)) fragment.vertices.push_back(made.soup.point(p));
        answer.order.push_back({face, {}});
      }
      const bool right = verify_order(made.soup, certificate).accepted;
      EXPECT_EQ(!grade(truth, answer).wrong(), right) << "seed " << seed;
      some = some || right;
      ++(right ? accepted : rejected);
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_EQ(truth.order->whole_faces_do(), some) << "seed " << seed;
    cycles += !some;
  }
  EXPECT_GT(accepted, rounds / 4);
  EXPECT_GT(rejected, rounds);
  EXPECT_GT(cycles, rounds / 20);
}

TEST(Orders, by_exact_trees_are_right_with_rounded_corners_and_wrong_when_reversed) {
  std::size_t cut = 0, wrong = 0;
  for (std::uint64_t seed = 0; seed < rounds; ++seed) {
    Heap made = heap(seed, 12);
    if (seed % 2 ==
        0) {  // in the plane of a face: what is on different sides of it is beside each other, however far apart
      const std::array<Exact_point, 3> p{made.soup.point(0), made.soup.point(1), made.soup.point(2)};
      for (std::size_t k = 0; k < 3; ++k) made.eye[k] = p[0][k] + 2 * (p[1][k] - p[0][k]) - 3 * (p[2][k] - p[0][k]);
    }
    const Scene scene(made.soup);
    const Exact_traits traits(scene);
    const auto tree = build_bsp(traits, {});
    std::vector<std::size_t> fragments(scene.counters().faces_read);
    for (const auto& fragment : tree.fragments) ++fragments[scene.pieces()[fragment.polygon.piece].face];
    Answer answer;
    traverse(traits, tree, traits.eye(made.eye), Direction::back_to_front, [&](const auto& fragment, Sign) {
      Drawn_face& drawn = answer.order.emplace_back();
      drawn.face = scene.pieces()[fragment.polygon.piece].face;
      if (fragments[drawn.face] == 1) return;
      ++cut;
      for (const auto& corner : fragment.polygon)
        drawn.part.push_back(rounded_to_doubles(traits.position(*corner.vertex)));
    });
    const Truth truth = truth_of(made.soup, question(Question::order, made.eye, true), {1, 20, true});
    EXPECT_FALSE(grade(truth, answer).wrong()) << "seed " << seed;
    std::reverse(answer.order.begin(), answer.order.end());
    wrong += grade(truth, answer).wrong();
  }
  EXPECT_GT(cut, rounds);
  EXPECT_GT(wrong, rounds / 2);
}

// ---- Contracts

TEST(Contracts, are_broken_by_what_they_forbid) {
  Grade shows, hides, open;
  shows.wrong_visible = {1};
  hides.wrong_hidden = {2};
  open.abstained = {3};
  struct Case {
    Mark mark;
    Grade grade;
    std::array<bool, 3> broken;  // exact, conservative, aggressive
  };
  const std::array<Case, 8> cases{{{Mark::right, {}, {false, false, false}},
                                   {Mark::abstained, open, {false, false, false}},
                                   {Mark::wrong, shows, {true, false, true}},
                                   {Mark::wrong, hides, {true, true, false}},
                                   {Mark::invalid, {}, {true, true, true}},
                                   {Mark::crashed, {}, {true, true, true}},
                                   {Mark::timed_out, {}, {false, false, false}},
                                   {Mark::out_of_memory, {}, {false, false, false}}}};
  for (const Case& c : cases)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(breaks(static_cast<Contract>(k), c.mark, c.grade), c.broken[k])
          << mark_names[static_cast<std::size_t>(c.mark)] << ", " << contract_names[k];
  EXPECT_EQ(mark_of({}), Mark::right);
  EXPECT_EQ(mark_of(open), Mark::abstained);
  EXPECT_EQ(mark_of(shows), Mark::wrong);
  EXPECT_EQ(mark_of(hides), Mark::wrong);
  open.wrong_hidden = {0};
  EXPECT_EQ(mark_of(open), Mark::wrong);
}

// ---- Why an answer is wrong

Explanation explained(const Polygon_soup& soup, const Query& query, const std::string& text,
                      Contract contract = Contract::exact) {
  const Answer answer = read_answer(text, query.question, soup.face_count());
  return explain(soup, query, answer, grade(truth_of(soup, query), answer), contract);
}

TEST(Explanation, of_what_an_eye_sees_names_a_line_and_a_share_of_all_directions) {
  // A cube's lid is a sixth of all that its middle sees: a square of side 2 at distance 1.
  const Polygon_soup soup = tower({-1, -2});
  const Query middle = question(Question::see, {0, 0, 0});
  const Explanation missing = explained(soup, middle, "");
  ASSERT_TRUE(missing.refutation);
  EXPECT_EQ(missing.refutation->face, 0u);
  EXPECT_EQ(missing.refutation->to[2], -1);
  EXPECT_FALSE(missing.refutation->by);
  EXPECT_NEAR(missing.share, 1.0 / 6, 1e-12);
  EXPECT_EQ(missing.share_words, "16.67 % of all directions show a face that the answer leaves out");

  const Explanation shown = explained(soup, middle, "0\n1\n");
  ASSERT_TRUE(shown.refutation);
  EXPECT_EQ(shown.refutation->face, 1u);
  EXPECT_EQ(shown.refutation->by, Face_id{0});
  EXPECT_EQ((shown.refutation->at == Exact_point{0, 0, -1}), true);
  EXPECT_EQ(shown.share, 0);
  EXPECT_NE(shown.share_words.find(" leaves out; hidden faces that it shows"), std::string::npos);

  const Explanation both = explained(soup, middle, "1\n");
  EXPECT_EQ(both.refutation->face, 0u);
  EXPECT_NE(both.share_words.find(" leaves out, and hidden faces that it shows"), std::string::npos);
  EXPECT_EQ(explained(soup, middle, "1\n", Contract::aggressive).refutation->face, 1u);
  EXPECT_EQ(explained(soup, question(Question::see, {0, 0, -5}), "0\n").refutation->words, "the eye is behind face 0");
}

TEST(Explanation, counts_no_face_but_its_own_and_nothing_edge_on) {
  Polygon_soup apart;  // both are seen
  add_square(apart, 0, -1);
  add_square(apart, 10, -2);
  const Explanation own = explained(apart, question(Question::see, {0, 0, 0}), "1\n");
  ASSERT_TRUE(own.refutation);
  EXPECT_EQ(own.refutation->to[2], -1);
  EXPECT_NEAR(own.share, 1.0 / 6, 1e-12);
  Polygon_soup beside;  // the eye is in the plane of face 1
  add_square(beside, 0, -1);
  add_square(beside, 5, 0);
  const Explanation edge_on = explained(beside, question(Question::see, {0, 0, 0}), "0\n1\n");
  EXPECT_NE(edge_on.share_words.find("would fill 0 %"), std::string::npos) << edge_on.share_words;
}

TEST(Explanation, of_faces_in_one_plane_finds_the_part_that_is_anothers) {
  Polygon_soup soup;
  add_square(soup, 0, 0);
  add_square(soup, 1, 0);
  const Explanation why = explained(soup, question(Question::see, {0, 0, 1}), "0\n");
  ASSERT_TRUE(why.refutation);
  EXPECT_EQ(why.refutation->face, 1u);
  EXPECT_LE(why.refutation->to[0], 2);
  EXPECT_GE(why.refutation->to[0], 0);

  // Where one is within the other, what is seen there is called one's; left out, each is found.
  Polygon_soup within;
  add_square(within, 0, 0);
  const Rational half(1, 2);
  within.add_face({within.add_point(-half, -half, 0), within.add_point(half, -half, 0), within.add_point(half, half, 0),
                   within.add_point(-half, half, 0)});
  for (const bool two_sided : {false, true})
    for (const Face_id left_out : {0u, 1u}) {
      const Query query = question(Question::see, {0, 0, two_sided ? -1 : 1}, two_sided);
      const Explanation whose = explained(within, query, left_out == 0 ? "1\n" : "0\n");
      ASSERT_TRUE(whose.refutation) << left_out;
      EXPECT_EQ(whose.refutation->face, left_out);
      EXPECT_NEAR(whose.share, left_out == 0 ? 1.0 / 6 : 4 * std::asin(1.0 / 5) / (4 * 3.14159265358979), 1e-12);
    }
}

TEST(Explanation, of_an_order_names_a_direction_in_which_it_is_wrong) {
  const Polygon_soup soup = tower({0, 1});
  const Explanation why = explained(soup, question(Question::order, {0, 0, 2}), "1\n0\n");
  ASSERT_TRUE(why.refutation);
  EXPECT_EQ(why.refutation->face, 1u);
  EXPECT_EQ((why.refutation->to[2]), 1);
  EXPECT_EQ(why.refutation->over, Face_id{0});
  // The lower square, at distance 2, is all behind the upper one: half as wide in the view.
  EXPECT_NEAR(why.share, 4 * std::asin(1.0 / 5) / (4 * 3.14159265358979), 1e-12);
  EXPECT_EQ(explained(soup, question(Question::order, {0, 0, 2}), "0\n").refutation->words,
            "face 1 is missing in the order");
}

TEST(Explanation, of_an_order_that_is_all_wrong_looks_at_some_of_its_pairs) {
  Polygon_soup soup;
  std::string reversed;
  for (int k = 0; k < 150; ++k) {
    add_square(soup, 0, k);
    reversed = std::to_string(k) + "\n" + reversed;
  }
  const Query above = question(Question::order, {0, 0, 500});
  const Answer answer = read_answer(reversed, Question::order, soup.face_count());
  const Grade grade = graded(soup, above, reversed);
  ASSERT_EQ(grade.wrong_pairs.size(), 150u * 149 / 2);
  EXPECT_NE(explain(soup, above, answer, grade, Contract::exact).share_words.find("summed over 10000 of 11175 pairs"),
            std::string::npos);
}

TEST(Explanation, of_weak_visibility_is_a_sightline_or_what_stands_in_the_way) {
  const Polygon_soup soup = tower({0, 1});
  Query lamp = question(Question::weak, {0, 0, 0});
  lamp.source = {{-3, -3, 2}, {-3, 3, 2}, {3, 3, 2}, {3, -3, 2}};  // looks down, and past the upper one
  const Explanation missing = explained(soup, lamp, "1\n");
  ASSERT_TRUE(missing.refutation);
  EXPECT_EQ(missing.refutation->face, 0u);
  EXPECT_EQ(missing.refutation->from[2], 2);
  EXPECT_EQ(missing.refutation->to[2], 0);
  EXPECT_NEAR(missing.share, 0.5, 1e-12);
  lamp.source = {{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}};
  const Explanation shown = explained(soup, lamp, "0\n1\n");
  ASSERT_TRUE(shown.refutation);
  EXPECT_EQ(shown.refutation->by, Face_id{1});
  EXPECT_NE(shown.refutation->words.find("is proved"), std::string::npos);
  EXPECT_EQ(explained(soup, lamp, "0\n").refutation->face, 1u);  // of what is missing, and what is shown
  EXPECT_EQ(explained(soup, lamp, "0\n", Contract::aggressive).refutation->face, 0u);
}

TEST(Explanation, of_weak_visibility_says_so_of_what_is_behind_the_source_with_nothing_between) {
  const Polygon_soup soup = tower({0, 1});  // both look up, to the back of a source that does
  Query lamp = question(Question::weak, {0, 0, 0});
  lamp.source = {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}};
  const Explanation why = explained(soup, lamp, "1\n");
  ASSERT_TRUE(why.refutation);
  EXPECT_EQ(why.refutation->words, "face 1 is behind the source, or in its plane");
}

TEST(Explanation, of_weak_visibility_looks_from_elsewhere_where_the_middle_of_the_source_is_on_what_hides) {
  // A trough on the middle line of the source hides what is in it.
  Polygon_soup soup;
  const auto add = [&](const std::vector<std::array<int, 3>>& corners) {
    std::vector<Point_id> loop;
    for (const auto& [x, y, z] : corners) loop.push_back(soup.add_point(Rational(x), Rational(y), Rational(z)));
    soup.add_face(loop);
  };
  for (const int side : {1, -1}) add({{-9, 0, 0}, {9, 0, 0}, {9, 9 * side, 9}, {-9, 9 * side, 9}});
  add({{-1, -1, 4}, {-1, 1, 4}, {1, 1, 4}, {1, -1, 4}});
  Query lamp = question(Question::weak, {0, 0, 0}, true);
  lamp.source = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  ASSERT_EQ(truth_of(soup, lamp).hidden, (Faces{2}));
  const Explanation why = explained(soup, lamp, "0\n1\n2\n");
  ASSERT_TRUE(why.refutation);
  EXPECT_EQ(why.refutation->face, 2u);
  ASSERT_TRUE(why.refutation->by);
  EXPECT_LE(*why.refutation->by, 1u);
}

TEST(Explanation, has_shares_at_any_scale) {
  for (const int power : {-1000, 900}) {
    const Rational one = generate::power_of_two(power);
    Polygon_soup soup;
    for (const Rational& z : {Rational(0), one}) {
      std::vector<Point_id> loop;
      for (const auto& [dx, dy] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
        loop.push_back(soup.add_point(dx * one, dy * one, z));
      soup.add_face(loop);
    }
    EXPECT_NEAR(explained(soup, question(Question::see, {0, 0, Rational(2 * one)}), "").share, 1.0 / 6, 1e-12) << power;
    Query lamp = question(Question::weak, {0, 0, 0});
    const Rational three = 3 * one, two = 2 * one;
    lamp.source = {{-three, -three, two}, {-three, three, two}, {three, three, two}, {three, -three, two}};
    EXPECT_NEAR(explained(soup, lamp, "1\n").share, 0.5, 1e-12) << power;
  }
}

// ---- Guesses

TEST(Guess, of_a_reading_holds_where_the_answer_is_right_so) {
  const Polygon_soup soup = tower({0, 1});
  const auto fits = [&](const Query& query, const std::string& text) {
    std::vector<Reading> found;
    for (const Reading reading : readings_of(query.question))
      if (is_right(reading, soup, query, read_answer(text, query.question, soup.face_count()), {}))
        found.push_back(reading);
    return found;
  };
  using Readings = std::vector<Reading>;
  const Query above = question(Question::see, {0, 0, 5}), below = question(Question::see, {0, 0, -5});
  EXPECT_EQ(fits(above, ""), (Readings{Reading::turned}));
  EXPECT_EQ(fits(above, "0\n1\n"), (Readings{Reading::nothing_hides}));
  EXPECT_EQ(fits(above, "0\n"), (Readings{Reading::complement}));
  EXPECT_EQ(fits(below, "0\n"), (Readings{Reading::turned, Reading::other_sides}));
  EXPECT_EQ(fits(question(Question::see, {0, 0, -5}, true), "1\n"), (Readings{Reading::complement, Reading::from_one}));
  EXPECT_EQ(fits(question(Question::order, {0, 0, 5}), "1\n0\n"), (Readings{Reading::reversed}));
  Query lamp = question(Question::weak, {0, 0, 0});
  lamp.source = {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}};  // looks up
  EXPECT_EQ(fits(lamp, "1\n"), (Readings{Reading::source_turned}));
}

TEST(Guess, of_neighbours_says_no_more_than_they_do) {
  const std::string exactly = "exactly degenerate";
  const auto words = [&](std::vector<Neighbour> n) { return words_of(std::move(n), exactly); };
  constexpr std::int64_t billionth = std::int64_t{1} << 22, millionth = std::int64_t{1} << 32;
  EXPECT_EQ(words({{0, true}, {1, false}, {-1, false}}),
            "wrong only where it is exactly degenerate, right when moved by one ulp: contact is decided wrongly, all "
            "else is right");
  EXPECT_EQ(words({{1, true}, {0, true}, {-1, false}, {billionth, true}, {-billionth, false}, {millionth, false}}),
            "wrong when moved by up to 2^-30 of the scene's size to the one side (+), right from 2^-20 of the scene's "
            "size on: a tolerance of a size between, or rounding");
  EXPECT_EQ(
      words({{-1, true}, {1, true}, {0, false}, {billionth, false}}),
      "wrong when moved by up to one ulp, right from 2^-30 of the scene's size on: a tolerance of a size between, "
      "or rounding");
  EXPECT_EQ(words({{0, true}, {1, true}, {millionth, true}}),
            "wrong wherever it is moved, as far as 2^-20 of the scene's size: no tolerance explains that");
  EXPECT_EQ(words({{0, true}, {-millionth, true}, {millionth, false}}),
            "wrong when moved to the other side (-), as far as 2^-20 of the scene's size, right when moved to the "
            "opposite one: no tolerance explains that");
  EXPECT_EQ(words({{0, false}, {1, false}, {millionth, true}, {-millionth, true}}),
            "wrong when moved by 2^-20 of the scene's size, right when moved by nothing: it does not come from being "
            "exactly degenerate");
  EXPECT_EQ(words({{1, true}, {0, true}, {-millionth, false}}),
            "wrong when moved to the one side (+), as far as one ulp, right when moved to the opposite one: no "
            "tolerance explains that");
  EXPECT_EQ(words({{0, false}, {1, true}}),
            "wrong when moved by one ulp, right when moved by nothing: it does not come from being exactly degenerate")
      << "nobody asked on the opposite side";
  EXPECT_EQ(words({{0, true}}), "wrong where it is exactly degenerate; of where it is moved nothing is known");
  EXPECT_EQ(words({{0, false}}), "");
}

TEST(Guess, of_each_reading_has_words_of_its_own) {
  std::set<std::string> all;
  std::size_t readings = 0;
  for (int k = 0; k <= static_cast<int>(Reading::swapped); ++k, ++readings) {
    const std::string words = words_of(static_cast<Reading>(k), false);
    EXPECT_EQ(words.rfind("as if ", 0), 0u) << k;
    all.insert(words);
  }
  EXPECT_EQ(all.size(), readings);
  EXPECT_EQ(words_of(Reading::other_sides, false), "as if faces seen from behind counted too");
  EXPECT_EQ(words_of(Reading::other_sides, true), "as if only fronts counted");
}

TEST(Guess, of_concave_faces_wants_both_kinds) {
  EXPECT_EQ(words_of(Kinds{1, 2, 5, 0}), "2 of 3 concave faces are wrong, and none of 5 convex ones");
  EXPECT_EQ(words_of(Kinds{1, 2, 5, 1}), "");
  EXPECT_EQ(words_of(Kinds{1, 2, 0, 0}), "");
  EXPECT_EQ(words_of(Kinds{1, 0, 5, 2}), "");
}

// ---- Rays

Query rays(std::vector<Exact_ray> all) {
  Query query;
  query.question = Question::trace;
  query.rays = std::move(all);
  return query;
}
Grade graded_rays(const Polygon_soup& soup, const Query& query, const std::string& text, bool excuse = false) {
  Truth_options options;
  options.excuse_touching = excuse;
  return graded_by(options, soup, query, text);
}

TEST(Rays, are_written_and_read) {
  const Query query = rays({{{Rational(1, 2), Rational(1, 3), -3}, {0, 0, -1}}});
  const std::string text = to_json(query).dump();
  EXPECT_EQ(text, R"({"query":"trace","rays":[{"origin":[0.5,"1/3",-3.0],"direction":[0.0,0.0,-1.0]}]})");
  EXPECT_EQ(to_json(query_from_json(nlohmann::json::parse(text))).dump(), text);
  for (const char* bad :
       {R"({"query":"trace"})", R"({"query":"trace","rays":1})", R"({"query":"trace","rays":[1]})",
        R"({"query":"trace","rays":[{"origin":[0,0,0]}]})", R"({"query":"trace","rays":[{"direction":[0,0,1]}]})",
        R"({"query":"trace","rays":[[[0,0,0],[0,0,1]]]})",
        R"({"query":"trace","rays":[{"origin":[0,0,0],"direction":[0,0]}]})"})
    EXPECT_THROW(query_from_json(nlohmann::json::parse(bad)), std::invalid_argument) << bad;
  EXPECT_NE(truth_of(tower({0}), rays({})).not_asked, "");
  EXPECT_NE(truth_of(tower({0}), rays({{{0, 0, 1}, {0, 0, 0}}})).not_asked, "");
}

TEST(Rays, are_answered_a_line_each) {
  const auto read = [](const std::string& text) { return read_answer(text, Question::trace, 3, 4); };
  for (const char* text : {"2\nnone\n\n abstained \r\n0", R"({"first": [2, null, "abstained", 0]})"}) {
    const Answer answer = read(text);
    EXPECT_EQ(answer.first, (std::vector<std::optional<Face_id>>{2, std::nullopt, std::nullopt, 0})) << text;
    EXPECT_EQ(answer.abstained, (Faces{2})) << text;
  }
  for (const char* text : {"abstained all\n", R"({"abstained": "all"})"})
    EXPECT_EQ(read(text).abstained, (Faces{0, 1, 2, 3})) << text;
  const auto what = [&](const std::string& text) { return refusal_of([&] { read(text); }); };
  const std::string count = "it is of 1 rays, and 4 are asked about; write a line for each: a face, none or abstained";
  EXPECT_EQ(what("1\n"), count);
  EXPECT_EQ(what(R"({"first": [1]})"), count);
  EXPECT_NE(what(""), "nothing");
  EXPECT_EQ(what("0\n3\n"), "line 2 names face 3; the scene has faces 0 to 2");
  EXPECT_EQ(what("-1\n"), "line 1: \"-1\" is no face; write its number, from 0, or none");
  EXPECT_EQ(what("0\nabstained 1\n"),
            "line 2: \"1\" after `abstained`; write `abstained` in the line of a ray, or `abstained all`");
  EXPECT_EQ(what("0\nabstained all\n"), "all rays are abstained from, and some are answered");
  EXPECT_EQ(what(R"({"first": [-1]})"), "first[0] is no face; write its number, from 0, or null, or \"abstained\"");
  EXPECT_EQ(what(R"({"abstained": [1], "first": [0]})"),
            "\"abstained\" is not \"all\"; write \"abstained\" in the place of a ray");
  EXPECT_EQ(what(R"({"visible": [1]})"), "has no \"first\": write {\"first\": [0, 4, 7]}");
}

TEST(Rays, meet_the_upper_of_two_squares) {
  const Polygon_soup soup = tower({0, 1});
  const Query down = rays({{{0, 0, 5}, {0, 0, -1}}, {{0, 0, 5}, {0, 0, 1}}});
  EXPECT_FALSE(graded_rays(soup, down, "1\nnone\n").wrong());
  EXPECT_EQ(graded_rays(soup, down, "1\nnone\n").judged, 2u);
  const Grade farther = graded_rays(soup, down, "0\nnone\n");
  EXPECT_EQ(farther.wrong_visible, (Faces{0}));
  EXPECT_EQ(farther.wrong_hidden, (Faces{1}));
  ASSERT_EQ(farther.wrong_rays.size(), 1u);
  EXPECT_EQ(farther.wrong_rays[0].ray, 0u);
  const Grade missed = graded_rays(soup, down, "none\nnone\n");
  EXPECT_EQ(missed.wrong_hidden, (Faces{1}));
  EXPECT_TRUE(missed.wrong_visible.empty());
  const Grade invented = graded_rays(soup, down, "1\n0\n");
  EXPECT_TRUE(invented.wrong_hidden.empty());
  EXPECT_EQ(invented.wrong_visible, (Faces{0}));
  const Grade open = graded_rays(soup, down, "abstained\n0\n");
  EXPECT_EQ(open.abstained, (Faces{0}));
  EXPECT_EQ(open.wrong_rays.size(), 1u);
}

TEST(Rays, of_faces_on_the_same_points_meet_those_alone_that_repeat_the_face) {
  // Two concave faces on four points, and the first of them again: the ray meets the second alone.
  Polygon_soup soup;
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(8, 0), std::pair(0, 8), std::pair(2, 2)})
    soup.add_point(x, y, 0.0);
  soup.add_face(std::vector<Point_id>{0, 1, 3, 2});
  soup.add_face(std::vector<Point_id>{0, 1, 2, 3});
  soup.add_face(std::vector<Point_id>{1, 3, 2, 0});
  const Query down = rays({{{3, 4, 5}, {0, 0, -1}}});
  EXPECT_FALSE(graded_rays(soup, down, "1\n").wrong());
  EXPECT_TRUE(graded_rays(soup, down, "0\n").wrong());
  EXPECT_TRUE(graded_rays(soup, down, "2\n").wrong());
  const Query both = rays({{{1, 1, 5}, {0, 0, -1}}, {{4, Rational(1, 2), 5}, {0, 0, -1}}});
  EXPECT_FALSE(graded_rays(soup, both, "2\n0\n").wrong()) << "both halves of what repeats";
}

TEST(Rays, that_touch_follow_the_law_or_are_excused) {
  Polygon_soup soup;  // two squares with an edge in common, one below, and the first once more
  add_square(soup, 0, 1);
  add_square(soup, 2, 1);
  add_square(soup, 1, 0, 3);
  soup.add_face({2, 3, 0, 1});
  const Exact_ray edge{{1, 0, 5}, {0, 0, -1}}, corner{{-1, -1, 5}, {0, 0, -1}}, along{{-4, 0, 1}, {1, 0, 0}},
      on{{0, 0, 1}, {0, 0, -1}};
  const Query query = rays({edge, corner, along, on});
  const auto wrong = [&](const std::string& text, bool excuse) {
    std::vector<std::size_t> all;
    for (const Wrong_ray& ray : graded_rays(soup, query, text, excuse).wrong_rays) all.push_back(ray.ray);
    return all;
  };
  using Rays = std::vector<std::size_t>;
  for (const char* right : {"0\n0\n0\n2\n", "1\n3\n3\n2\n"}) {
    EXPECT_EQ(wrong(right, false), Rays()) << right;
    EXPECT_EQ(wrong(right, true), Rays()) << right;
  }
  // What is touched is passed over: wrong by the law.
  EXPECT_EQ(wrong("2\nnone\nnone\n2\n", false), (Rays{0, 1, 2}));
  EXPECT_EQ(wrong("2\nnone\nnone\n2\n", true), (Rays{1}));  // below the corner is the border of nothing: face 2 is met
  EXPECT_EQ(wrong("2\n2\n1\n2\n", true), Rays());
  EXPECT_EQ(wrong("none\n1\n2\n0\n", true), (Rays{0, 1, 2, 3}));
  // A hit is contact at a corner, on an edge and along a face; in its interior, from a side, it is more.
  const auto contact = [&](const Exact_ray& ray, Met_side side, int t) { return touches(soup, ray, {0, side, t, t}); };
  EXPECT_TRUE(contact(edge, Met_side::front, 4));
  EXPECT_TRUE(contact(corner, Met_side::front, 4));
  EXPECT_TRUE(contact(along, Met_side::along, 4));
  EXPECT_FALSE(contact({{0, 0, 5}, {0, 0, -1}}, Met_side::front, 4));
}

TEST(Rays, to_the_farthest_that_touch_it_do_not_meet_nothing_where_they_met_more_before) {
  const Polygon_soup soup = tower({0, 1});
  const Query query = rays({{{0, 0, 5}, {Rational(1, 5), 0, -1}}});  // through the upper one, on the lower one's edge
  const Scene scene(soup);
  Ray_rule rule;
  rule.excuse_touching = rule.farthest = true;
  const std::vector<Ray_truth> truths = ray_truths(soup, scene, query.rays, rule);
  ASSERT_EQ(truths.size(), 1u);
  EXPECT_EQ(truths[0].right, (Faces{0}));
  EXPECT_FALSE(truths[0].nothing);
}

/// The first faces by rationals and the law alone: where the line meets the plane, and whether that is in the convex
/// face; nothing is asked of a ray in a plane.
std::optional<Faces> first_by_force(const Polygon_soup& soup, const Exact_ray& ray) {
  Faces first;
  Rational nearest = 0;
  const auto times = [](const Exact_point& a, const Exact_point& b) {
    return Exact_point{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto less = [](const Exact_point& a, const Exact_point& b) {
    return Exact_point{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  const auto with = [](const Exact_point& a, const Exact_point& b) {
    return Rational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
  };
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const auto loop = soup.loop(f);
    const Exact_point a = soup.point(loop[0]),
                      normal = times(less(soup.point(loop[1]), a), less(soup.point(loop[2]), a));
    const Rational rise = with(normal, ray.direction), height = with(normal, less(a, ray.origin));
    if (rise == 0 && height == 0) return std::nullopt;
    if (rise == 0) continue;
    const Rational t = height / rise;
    if (t <= 0 || (!first.empty() && t > nearest)) continue;
    const Exact_point at = point_at(ray, t);
    bool inside = true;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Exact_point p = soup.point(loop[i]), q = soup.point(loop[(i + 1) % loop.size()]);
      inside = inside && with(normal, times(less(q, p), less(at, p))) >= 0;
    }
    if (!inside) continue;
    if (t < nearest || first.empty()) first.clear();
    nearest = t;
    first.push_back(f);
  }
  return first;
}

TEST(Rays, about_heaps_are_judged_as_by_force) {
  std::size_t met = 0, missed = 0, several = 0;
  for (std::uint64_t seed = 0; seed < rounds; ++seed) {
    Heap made = heap(seed, 6);
    made.soup.add_face({0, 1, 3});  // shares an edge with one, and a corner with another
    const Query query = rays(rays_about(made.soup, made.eye, seed));
    const Truth truth = truth_of(made.soup, query);
    ASSERT_EQ(truth.rays.size(), query.rays.size());
    for (std::size_t r = 0; r < query.rays.size(); ++r) {
      const auto first = first_by_force(made.soup, query.rays[r]);
      if (!first) continue;
      EXPECT_EQ(truth.rays[r].right, *first) << "seed " << seed << ", ray " << r;
      EXPECT_EQ(truth.rays[r].nothing, first->empty()) << "seed " << seed << ", ray " << r;
      ++(first->empty() ? missed : met);
      several += first->size() > 1;
    }
  }
  EXPECT_GT(met, 8 * rounds);
  EXPECT_GT(missed, rounds / 4);
  EXPECT_GT(several, 0u);
}

TEST(Rays, that_are_answered_wrongly_are_explained_and_guessed_about) {
  const Polygon_soup soup = tower({0, 1});
  const Query query = rays({{{0, 0, 5}, {0, 0, -1}}, {{0, 0, Rational(1, 2)}, {0, 0, 1}}, {{0, 0, 1}, {0, 0, 1}}});
  const auto why = [&](const std::string& text, Contract contract = Contract::exact) {
    const Answer answer = read_answer(text, Question::trace, 2, 3);
    return explain(soup, query, answer, grade(truth_of(soup, query), answer), contract);
  };
  const Explanation farther = why("0\n1\nnone\n");
  ASSERT_TRUE(farther.refutation);
  EXPECT_EQ(farther.refutation->words,
            "ray 0, from (0, 0, 5) towards (0, 0, -1), first meets face 1 at (0, 0, 1), and face 0 only at (0, 0, 0)");
  EXPECT_EQ(farther.refutation->by, Face_id{1});
  EXPECT_NEAR(farther.share, 1.0 / 3, 1e-12);
  const Explanation missed = why("1\nnone\nnone\n");
  EXPECT_EQ(missed.refutation->words,
            "ray 1, from (0, 0, 0.5) towards (0, 0, 1), first meets face 1 from behind at (0, 0, 1)");
  EXPECT_EQ(missed.refutation->face, 1u);
  EXPECT_EQ(why("none\n1\n0\n").refutation->face, 1u);
  EXPECT_EQ(why("none\n1\n0\n", Contract::aggressive).refutation->words,
            "ray 2, from (0, 0, 1) towards (0, 0, 1), meets nothing");
  const Query along = rays({{{-5, 0, 0}, {1, 0, 0}}});
  const Answer none = read_answer("none\n", Question::trace, 2, 1);
  EXPECT_EQ(explain(soup, along, none, grade(truth_of(soup, along), none), Contract::exact).refutation->words,
            "ray 0, from (-5, 0, 0) towards (1, 0, 0), first meets face 0 along itself at (-1, 0, 0)");

  const auto fits = [&](const std::string& text) {
    std::vector<Reading> found;
    for (const Reading reading : readings_of(Question::trace))
      if (is_right(reading, soup, query, read_answer(text, Question::trace, 2, 3), {})) found.push_back(reading);
    return found;
  };
  using Readings = std::vector<Reading>;
  EXPECT_EQ(fits("0\n1\nnone\n"), (Readings{Reading::farthest}));
  EXPECT_EQ(fits("1\n1\n1\n"), (Readings{Reading::closed_start}));
  EXPECT_EQ(fits("1\nnone\nnone\n"), (Readings{Reading::fronts_only}));
  EXPECT_EQ(fits("1\n1\nnone\n"), Readings());  // the nearest is not the farthest
  const Query one = rays({{{0, 0, 5}, {0, 0, -1}}});
  EXPECT_TRUE(is_right(Reading::from_one, tower({1, 0}), one, read_answer("1\n", Question::trace, 2, 1), {}));
  EXPECT_TRUE(is_right(Reading::to_points, tower({6}), rays({{{0, 0, 5}, {0, 0, 6}}}),
                       read_answer("0\n", Question::trace, 1, 1), {}));
}

TEST(Numbers, of_json_are_doubles_whole_or_quotients) {
  EXPECT_EQ(judge::number_from_json("1/3", "at"), Rational(1, 3));
  EXPECT_EQ(judge::number_from_json(0.5, "at"), Rational(1, 2));
  EXPECT_EQ(judge::number_from_json(std::uint64_t{18446744073709551615u}, "at") + 1, Rational("18446744073709551616"));
  EXPECT_NO_THROW(
      judge::check_integers("[18446744073709551615, -9223372036854775808, 1e30, 0.1, \"18446744073709551617\"]"));
  EXPECT_THROW(judge::check_integers("{\"a\": [18446744073709551617]}"), std::invalid_argument);
  EXPECT_THROW(judge::check_integers("-9223372036854775809"), std::invalid_argument);
  EXPECT_EQ(judge::number_from_json(-3, "at"), Rational(-3));
  EXPECT_EQ(judge::point_from_json({1, "-2/7", 0.25}, "at"), (Exact_point{1, Rational(-2, 7), Rational(1, 4)}));
  EXPECT_THROW(judge::number_from_json("1/0", "at"), std::invalid_argument);
  EXPECT_THROW(judge::number_from_json(true, "at"), std::invalid_argument);
  EXPECT_THROW(judge::point_from_json({1, 2}, "at"), std::invalid_argument);
  EXPECT_THROW(judge::point_from_json({{"x", 1}, {"y", 2}, {"z", 3}}, "at"), std::invalid_argument);
}

TEST(Example, of_the_page_grades_a_text) {
  std::ostringstream out;
  grade_text(tower({0, 1, 2}), question(Question::see, {0, 0, 5}), "0\n", out);
  EXPECT_EQ(out.str(), "face 0 is shown but hidden\nface 2 is missing but visible\n");
}

}  // namespace
