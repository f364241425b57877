// Queries about scenes of families: what query_from_json takes, what it refuses, and that it reads what query_json
// writes.

#include <sightline/harness/laws/query_json.h>
#include <sightline/harness/judge/protocol.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

using namespace sightline;
using harness::Posed_query;
using Json = nlohmann::json;

const Json whole = Json::parse(
    R"({"format": "sightline query 1", "name": "bars:7", "seed": 9, "distance": "beside", "eye": ["1/3", "-2", 0.5], "source": [[0, 0, 1], [1, 0, 1], [0, 1, 1]], "visible": [0, 4], "hidden": [2]})");

std::string error_of(const Json& value, std::size_t faces = 5) {
  try {
    harness::query_from_json(value, faces);
    return "taken";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}
Json with(const char* key, const Json& value) {
  Json changed = whole;
  changed[key] = value;
  return changed;
}

TEST(Query, is_what_it_says) {
  const Posed_query query = harness::query_from_json(whole, 5);
  EXPECT_EQ(query.scene.name, "bars:7");
  EXPECT_EQ(query.seed, 9u);
  EXPECT_EQ(query.scene.distance, generate::Distance::beside);
  EXPECT_EQ(query.scene.eye, (Exact_point{Rational(1, 3), Rational(-2), Rational(1, 2)}));
  ASSERT_EQ(query.scene.source.size(), 3u);
  EXPECT_EQ(query.scene.source[1], (Exact_point{Rational(1), Rational(0), Rational(1)}));
  EXPECT_EQ(query.scene.visible, (std::vector<Face_id>{0, 4}));
  EXPECT_EQ(query.scene.hidden, (std::vector<Face_id>{2}));
}

TEST(Query, may_leave_out_all_but_its_format_and_eye) {
  const Posed_query query =
      harness::query_from_json(Json::parse(R"({"format": "sightline query 1", "eye": [1, 2, 3]})"), 0);
  EXPECT_EQ(query.seed, 1u);
  EXPECT_EQ(query.scene.distance, generate::Posed_scene{}.distance);
  EXPECT_TRUE(query.scene.name.empty() && query.scene.source.empty() && query.scene.visible.empty() &&
              query.scene.hidden.empty());
  for (const char* key : {"format", "eye"}) {
    Json less = whole;
    less.erase(key);
    EXPECT_TRUE(
        error_of(less).starts_with(std::string("query: ") + (key[0] == 'f' ? "\"format\" is not" : "no \"eye\"")))
        << error_of(less);
  }
}

TEST(Query, that_is_written_is_the_same_when_read) {
  const Posed_query query = harness::query_from_json(whole, 5);
  const auto written = harness::query_json(query.scene, query.seed);
  Json expected = with("eye", {"1/3", "-2", "1/2"});
  expected["source"] = Json::parse(R"([["0", "0", "1"], ["1", "0", "1"], ["0", "1", "1"]])");
  EXPECT_EQ(Json(written), expected);
  const Posed_query again = harness::query_from_json(Json(written), 5);
  EXPECT_EQ(harness::query_json(again.scene, again.seed), written);
  // Of a pair of solids, where the second begins.
  generate::Posed_scene pair = query.scene;
  pair.first = 4;
  EXPECT_EQ(harness::query_from_json(Json(harness::query_json(pair, 1)), 5).scene.first, 4u);
}

TEST(Query, that_is_wrong_is_refused_in_one_line_that_says_why) {
  for (const auto& [key, value, why] : std::vector<std::tuple<const char*, Json, std::string>>{
           {"format", "sightline query 2", "\"format\" is not \"sightline query 1\""},
           {"name", 3, "\"name\" is no string"},
           {"first", 6, "\"first\" is not how many of the scene's 5 faces are the first solid's"},
           {"first", -1, "\"first\" is not how many"},
           {"seed", -1, "\"seed\" is no whole number"},
           {"seed", 1.5, "\"seed\" is no whole number"},
           {"distance", "near", "\"distance\" is neither"},
           {"distance", 0, "\"distance\" is neither"},
           {"eye", {1, 2}, "eye"},
           {"eye", {1, 2, "3/0"}, "eye"},
           {"source", {1, 2, 3}, "source"},
           {"source", 7, "source"},
           {"visible", 4, "\"visible\" is no list of faces"},
           {"visible", {5}, "\"visible\" names a face that is not one of the scene's 5"},
           {"hidden", {-1}, "\"hidden\" names a face that is not one of the scene's 5"},
           {"hidden", {1.0}, "\"hidden\" names a face"},
           {"hidden", {"1"}, "\"hidden\" names a face"}}) {
    const std::string error = error_of(with(key, value));
    EXPECT_TRUE(error.starts_with("query: ")) << error;
    EXPECT_NE(error.find(why), std::string::npos) << key << " " << value << ": " << error;
  }
  EXPECT_EQ(error_of(whole), "taken");
  EXPECT_NE(error_of(whole, 4), "taken") << "face 4 of four";
  for (const char* text : {"[]", "7", "null", "\"sightline query 1\""})
    EXPECT_EQ(error_of(Json::parse(text)), "query: expected an object");
}

}  // namespace
