// bench/cityjson.py, which makes the scenes of the benches of cities.

#include "../sample.h"

#include <sightline/io/read.h>

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace cityjson {
namespace {

namespace fs = std::filesystem;

/// The scene that the script makes of a file of that name.
sightline::Polygon_soup converted(const std::string& name, const std::string& text) {
  const fs::path folder = fs::temp_directory_path() / ("sightline-cityjson-" + std::to_string(std::random_device()()));
  fs::create_directory(folder);
  std::ofstream(folder / name) << text;
  const std::string command = "python3 '" SIGHTLINE_SOURCE_DIR "/bench/cityjson.py' '" + (folder / name).string() +
                              "' --out '" + folder.string() + "' 2>'" + (folder / "said").string() + "'";
  const int status = std::system(command.c_str());
  std::ifstream said(folder / "said");
  EXPECT_EQ(status, 0) << said.rdbuf();
  sightline::Polygon_soup soup = sightline::read_scene(folder / (name.substr(0, name.find('.')) + ".qoff"));
  fs::remove_all(folder);
  return soup;
}
/// How the script ends that is given a city with these vertices, of which the first three are a face's, and what it
/// says.
std::string said_of(const std::string& vertices, const std::string& face = "0, 1, 2") {
  const fs::path folder = fs::temp_directory_path() / ("sightline-cityjson-" + std::to_string(std::random_device()()));
  fs::create_directory(folder);
  std::ofstream(folder / "city.json")
      << R"({"CityObjects": {"a": {"geometry": [{"type": "MultiSurface", "boundaries": [[[)" << face
      << R"(]]]}]}}, "vertices": )" << vertices << "}";
  const std::string command = "python3 '" SIGHTLINE_SOURCE_DIR "/bench/cityjson.py' '" +
                              (folder / "city.json").string() + "' --out '" + folder.string() + "' 2>'" +
                              (folder / "said").string() + "'";
  const int status = std::system(command.c_str());
  std::ostringstream said;
  said << WEXITSTATUS(status) << ' ' << std::ifstream(folder / "said").rdbuf();
  fs::remove_all(folder);
  return said.str();
}
bool has_python() { return std::system("command -v python3 >/dev/null 2>&1") == 0; }

sightline::Exact_point corner(const sightline::Polygon_soup& soup, sightline::Face_id face, std::size_t k) {
  return soup.point(soup.loop(face, 0)[k]);
}
sightline::Exact_point thousandths(long x, long y, long z) {
  sightline::Exact_point p{sightline::Rational(x, 1000), sightline::Rational(y, 1000), sightline::Rational(z, 1000)};
  for (sightline::Rational& c : p) c.canonicalize();
  return p;
}

TEST(City_json, becomes_a_scene_with_the_coordinates_that_it_says_and_the_highest_level_of_detail) {
  if (!has_python()) GTEST_SKIP() << "needs python3";
  const sightline::Polygon_soup soup = converted("city.city.json", R"({
    "type": "CityJSON", "version": "2.0", "transform": {"scale": [0.001, 0.001, 1e-3], "translate": [81868.09, -5, 0.1]},
    "vertices": [[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0], [0, 0, 0], [2, 2, 0], [4, 2, 0], [4, 4, 0]],
    "CityObjects": {
      "a": {"type": "Building", "geometry": [{"type": "Solid", "lod": "1.2", "boundaries": [[[[0, 1, 2]]]]},
                                             {"type": "Solid", "lod": "2", "boundaries": [[[[0, 1, 2, 3]], [[3, 2, 1]]], [[[4, 2, 1]]]]}]},
      "b": {"type": "Road", "geometry": [{"type": "MultiSurface", "lod": 1, "boundaries": [[[1, 2, 3]], [[0, 1, 2, 3], [5, 6, 7]]]}]},
      "c": {"type": "CityObjectGroup"}}})");
  ASSERT_EQ(soup.face_count(), 4u);  // three of a's second level, one of b's: the other has a hole
  EXPECT_EQ(soup.loop(0, 0).size(), 4u);
  EXPECT_EQ(corner(soup, 0, 0), thousandths(81868090, -5000, 100));
  EXPECT_EQ(corner(soup, 0, 2), thousandths(81868100, -4990, 100));
  EXPECT_EQ(soup.loop(0, 0)[0], soup.loop(2, 0)[0]);  // equal points are one
  EXPECT_EQ(soup.point_count(), 4u);
  EXPECT_EQ(corner(soup, 3, 0), thousandths(81868100, -5000, 100));
}

TEST(City_json, of_a_sequence_is_all_its_features_by_the_transform_of_its_first_line) {
  if (!has_python()) GTEST_SKIP() << "needs python3";
  const std::string feature =
      R"({"type": "CityJSONFeature", "CityObjects": {"a": {"type": "Building", "geometry": [{"type": "MultiSolid", "boundaries": [[[[[0, 1, 2]]]], [[[[0, 2, 1]]]]]}]}}, "vertices": )";
  const sightline::Polygon_soup soup = converted(
      "tile.jsonl",
      R"({"type": "CityJSON", "CityObjects": {}, "vertices": [], "transform": {"scale": [0.5, 0.5, 0.5], "translate": [0, 0, 1]}})"
      "\n" +
          feature + "[[0, 0, 0], [1, 0, 0], [0, 1, 0]]}\n" + feature + "[[0, 0, 0], [3, 0, 0], [0, 3, 0]]}\n");
  ASSERT_EQ(soup.face_count(), 4u);
  EXPECT_EQ(soup.point_count(), 5u);
  EXPECT_EQ(corner(soup, 0, 1), thousandths(500, 0, 1000));
  EXPECT_EQ(corner(soup, 3, 2), thousandths(1500, 0, 1000));
  EXPECT_EQ(corner(soup, 3, 1), thousandths(0, 1500, 1000));
}

TEST(City_json, that_is_none_is_refused_in_one_line) {
  if (!has_python()) GTEST_SKIP() << "needs python3";
  const std::string three = "[[0, 0, 0], [1, 0, 0], [0, 1, 0]]";
  EXPECT_EQ(said_of(three).substr(0, 2), "0 ");
  for (const auto& [vertices, face, why] : std::vector<std::array<std::string, 3>>{
           {three, "0, 1, -1", "no vertex -1 of 3"},
           {three, "0, 1, 3", "no vertex 3 of 3"},
           {three, "0, 1, 1.5", "no vertex 3/2 of 3"},
           {three, "0, 1, \"2\"", "no vertex 2 of 3"},
           {three, "0, 1, true", "no vertex True of 3"},
           {"[[0, 0, 0], [1e99999999, 0, 0], [0, 1, 0]]", "0, 1, 2", "the exponent of 1e99999999"},
           {"[[0, 0, 0], [NaN, 0, 0], [0, 1, 0]]", "0, 1, 2", "NaN is no finite number"},
           {"[[0, 0, 0], [1, 0], [0, 1, 0]]", "0, 1, 2", "three numbers"},
           {"7", "0, 1, 2", ""},
           {"[[", "0, 1, 2", ""}}) {
    const std::string said = said_of(vertices, face);
    EXPECT_EQ(said.substr(0, 15), "3 cityjson.py: ") << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    EXPECT_NE(said.find(why), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace cityjson
