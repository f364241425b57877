// Real meshes and solids, along orbits, jumps, and paths through planes, edges and vertices: every frame equals a test
// of every face. SIGHTLINE_LONG: the frames of each scene, for a long run.

#include "support.h"
#include "../sample.h"

#include <sightline/io/read.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/io/decimal.h>
#include <sightline/io/text.h>

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace cutset_test {
namespace {

std::vector<std::string> collected() {
  const std::filesystem::path root = SIGHTLINE_SCENES_DIR;
  std::vector<std::string> names;
  if (root.empty()) return names;
  for (const char* folder : {"b_classic", "c_convex", "c_convex/tess"}) {
    if (!std::filesystem::is_directory(root / folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(root / folder))
      if (entry.is_regular_file()) names.push_back(std::string(folder) + "/" + entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// A solid of the collection in JSON: {"vertices": [[x, y, z], ...], "faces": [[i, j, k, ...], ...]}, coordinates as
/// decimals.
Polygon_soup read_solid(const std::filesystem::path& file) {
  std::ifstream in(file);
  const nlohmann::json solid = nlohmann::json::parse(in);
  Polygon_soup soup;
  for (const auto& p : solid.at("vertices")) {
    std::array<Rational, 3> at;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string decimal = p[k].dump();
      const Input input{"solid", decimal};
      const Text_reader reader(input, Text_reader::Comments::none);
      at[k] = value_of(parse_decimal(reader, input.bytes));
    }
    soup.add_point(at[0], at[1], at[2]);
  }
  for (const auto& face : solid.at("faces")) soup.add_face(face.get<std::vector<Point_id>>());
  return soup;
}

class Mesh : public testing::TestWithParam<std::string> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Mesh);

/// By the traits' own predicate, node by node.
std::vector<bool> every_face(const Stage& stage, const Viewpoint& view) {
  std::vector<bool> on(stage.graph.size());
  Predicate_counts counts;
  const Located_point eye = stage.traits.eye(view.at);
  for (std::uint32_t i = 0; i < on.size(); ++i)
    on[i] = stage.traits.side(eye, stage.graph.plane(i), counts) == CGAL::POSITIVE;
  return on;
}

TEST_P(Mesh, every_frame_equals_a_test_of_every_face) {
  const std::filesystem::path file = std::filesystem::path(SIGHTLINE_SCENES_DIR) / GetParam();
  const Stage stage(file.extension() == ".json" ? read_solid(file) : read_scene(file));
  Cut_set_tracker tracker(stage.traits, stage.graph);
  const auto box = stage.scene.box();
  Exact_point centre, half;
  for (std::size_t k = 0; k < 3; ++k) {
    centre[k] = (box[0][k] + box[1][k]) / 2;
    half[k] = (box[1][k] - box[0][k]) / 2;
  }
  const char* const wanted = std::getenv("SIGHTLINE_LONG");
  const std::size_t frames = wanted != nullptr ? static_cast<std::size_t>(std::max(300, std::atoi(wanted)))
                                               : test_scenes::sample(std::size_t{300});
  std::mt19937_64 random(stage.graph.size());
  const auto some = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
  const auto corner_of = [&](const Piece& piece, std::size_t k) {
    return stage.scene.position(stage.scene.corners(piece)[k % piece.size].point);
  };
  std::uint64_t tests = 0, smooth = 0;
  std::size_t frame = 0;
  const auto move = [&](const Viewpoint& view) {
    tracker.move_to(view);
    const std::vector<bool> on = view.at_infinity ? on_view(stage.graph, view) : every_face(stage, view);
    ++frame;
    return agrees(tracker, stage.graph, on);
  };
  while (frame < frames) {
    // A part of an orbit.
    const std::int64_t circle = 1 << 10, begin = static_cast<std::int64_t>(some(1024));
    const Rational radius(3 + static_cast<int>(some(40)), 8), height(static_cast<int>(some(17)) - 8, 4);
    for (std::int64_t k = 0; k < 40; ++k) {
      const auto [x, y] = generate::circle_point(static_cast<std::uint64_t>((begin + k) % circle), circle, 1 << 20);
      Viewpoint view{centre, false};
      view.at[0] += half[0] * radius * Rational(x, 1 << 20);
      view.at[1] += half[1] * radius * Rational(y, 1 << 20);
      view.at[2] += half[2] * height;
      ASSERT_TRUE(move(view)) << "frame " << frame;
      if (k > 0) {
        tests += tracker.last().tests;
        ++smooth;
      }
    }
    // Along an edge and beyond it, through a vertex; in a face's plane; inside; at infinity along an edge.
    const Piece& piece = stage.scene.pieces()[some(stage.scene.pieces().size())];
    const Exact_point p = corner_of(piece, 0), q = corner_of(piece, 1), r = corner_of(piece, 2);
    for (int k = -2; k <= 6; ++k) {
      Viewpoint on_edge{p, false}, in_plane{p, false};
      for (std::size_t a = 0; a < 3; ++a) {
        on_edge.at[a] += (q[a] - p[a]) * Rational(k, 4);
        in_plane.at[a] += (q[a] - p[a]) * (k + 3) - (r[a] - p[a]) * 5;
      }
      ASSERT_TRUE(move(on_edge)) << "frame " << frame;
      ASSERT_TRUE(move(in_plane)) << "frame " << frame;
    }
    ASSERT_TRUE(move({centre, false})) << "frame " << frame;
    if (frame < 3000) {  // its oracle is slow
      Viewpoint away{q, true};
      for (std::size_t a = 0; a < 3; ++a) away.at[a] -= p[a];
      ASSERT_TRUE(move(away)) << "frame " << frame;
    }
  }
  // "5 times fewer tests than brute force on a smooth orbit" is asked of meshes of 10^5 faces; small steps do that on
  // all of them.
  EXPECT_LT(static_cast<double>(tests), 0.2 * static_cast<double>(smooth * stage.graph.size()));
}

INSTANTIATE_TEST_SUITE_P(Collected, Mesh, testing::ValuesIn(collected()),
                         [](const testing::TestParamInfo<std::string>& scene) {
                           std::string name = scene.param;
                           for (char& c : name)
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           return name;
                         });

TEST(Solids, are_triangulated_where_their_faces_are_not_planar_and_then_mostly_dented) {
  if (collected().empty()) GTEST_SKIP() << "no collection of scenes here";
  std::size_t solids = 0, convex = 0, planar = 0;
  for (const std::string& name : collected()) {
    if (!name.ends_with(".json")) continue;
    const Stage stage(read_solid(std::filesystem::path(SIGHTLINE_SCENES_DIR) / name));
    ++solids;
    convex += stage.graph.is_convex(0);
    planar += stage.scene.non_planar().empty();
    if (stage.scene.non_planar().empty()) {
      EXPECT_TRUE(stage.graph.is_convex(0)) << name;
    }
  }
  RecordProperty("solids", static_cast<int>(solids));
  RecordProperty("convex", static_cast<int>(convex));
  RecordProperty("planar", static_cast<int>(planar));
  std::cout << solids << " solids, " << planar << " with planar faces only, " << convex << " convex\n";
  EXPECT_GE(convex, planar);
}

}  // namespace
}  // namespace cutset_test
