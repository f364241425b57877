// Scenes in glTF: what nodes make of meshes, exactly; and what is refused.

#include <sightline/io/binary.h>
#include <sightline/io/grouped_polygons.h>
#include <sightline/io/read.h>
#include <sightline/io/write.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <limits>
#include <string>
#include <vector>

namespace {

using namespace sightline;
using Tree = nlohmann::json;

constexpr Format glb = Format::glb;

std::string file_of(const std::string& json, const std::string& binary) {
  std::string text = json, data = binary, all = "glTF";
  while (text.size() % 4 != 0) text += ' ';
  while (data.size() % 4 != 0) data += '\0';
  store(all, std::uint32_t{2});
  store(all, static_cast<std::uint32_t>(28 + text.size() + data.size()));
  store(all, static_cast<std::uint32_t>(text.size()));
  store(all, std::uint32_t{0x4E4F534A});
  all += text;
  store(all, static_cast<std::uint32_t>(data.size()));
  store(all, std::uint32_t{0x004E4942});
  return all + data;
}

/// A mesh of one primitive of these points, shown once by a node, which a test changes.
struct Glb {
  Tree tree;
  std::string binary;

  template <class Index = std::uint16_t>
  explicit Glb(const std::vector<float>& points, const std::vector<Index>& indices = {}) {
    for (const float x : points) store(binary, x);
    const std::size_t split = binary.size();
    for (const Index i : indices) store(binary, i);
    tree["asset"]["version"] = "2.0";
    tree["scenes"] = Tree::array({{{"nodes", {0}}}});
    tree["nodes"] = Tree::array({{{"mesh", 0}}});
    tree["buffers"] = Tree::array({{{"byteLength", binary.size()}}});
    tree["bufferViews"] = Tree::array({{{"buffer", 0}, {"byteLength", split}}});
    tree["accessors"] =
        Tree::array({{{"bufferView", 0}, {"componentType", 5126}, {"type", "VEC3"}, {"count", points.size() / 3}}});
    Tree primitive{{"attributes", {{"POSITION", 0}}}};
    if (!indices.empty()) {
      const int component = sizeof(Index) == 1 ? 5121 : sizeof(Index) == 2 ? 5123 : 5125;
      tree["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", split}, {"byteLength", binary.size() - split}});
      tree["accessors"].push_back(
          {{"bufferView", 1}, {"componentType", component}, {"type", "SCALAR"}, {"count", indices.size()}});
      primitive["indices"] = 1;
    }
    tree["meshes"] = Tree::array({{{"primitives", Tree::array({primitive})}}});
  }
  Tree& primitive() { return tree["meshes"][0]["primitives"][0]; }
  Tree& node() { return tree["nodes"][0]; }
  std::string bytes() const { return file_of(tree.dump(), binary); }
  Polygon_soup read() const { return read_scene(bytes(), glb, "it"); }
};

const std::vector<float> triangle{0, 0, 0, 1, 0, 0, 0, 1, 0};
const std::vector<float> five{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};

std::string faces_of(const Polygon_soup& soup) {
  std::string text;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    for (const Point_id p : soup.loop(f)) text += std::to_string(p);
    text += ' ';
  }
  return text;
}
std::string why(const std::string& bytes) {
  try {
    read_scene(bytes, glb, "it");
  } catch (const Input_error& error) {
    return error.what();
  }
  return "accepted";
}
std::string why(const Glb& gltf) { return why(gltf.bytes()); }

TEST(Read_glb, of_triangles_strips_and_fans_with_indices_of_each_size) {
  EXPECT_EQ(faces_of(Glb(triangle).read()), "012 ");
  EXPECT_EQ(faces_of(Glb(five, std::vector<std::uint8_t>{4, 3, 2, 0, 1, 2}).read()), "432 012 ");
  EXPECT_EQ(faces_of(Glb(five, std::vector<std::uint16_t>{4, 3, 2}).read()), "432 ");
  EXPECT_EQ(faces_of(Glb(five, std::vector<std::uint32_t>{4, 3, 2}).read()), "432 ");
  Glb strip(five), fan(five);
  strip.primitive()["mode"] = 5;
  EXPECT_EQ(faces_of(strip.read()), "012 132 234 ");
  fan.primitive()["mode"] = 6;
  EXPECT_EQ(faces_of(fan.read()), "120 230 340 ");
  for (const int mode : {0, 1, 2, 3}) {
    strip.primitive()["mode"] = mode;
    EXPECT_EQ(strip.read().face_count(), 0u) << "points and lines";
  }
}

TEST(Read_glb, of_points_between_other_things) {
  Glb gltf({0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9});
  gltf.tree["accessors"][0]["count"] = 3;
  gltf.tree["bufferViews"][0]["byteStride"] = 16;
  const Polygon_soup soup = gltf.read();
  ASSERT_EQ(soup.point_count(), 3u);
  EXPECT_EQ(soup.point(2), (Exact_point{0, 1, 0}));
}

TEST(Read_glb, where_nodes_put_it_exactly) {
  Glb gltf(triangle);
  gltf.node()["translation"] = {0.1, -2, 1e-3};
  gltf.node()["scale"] = {2, 3, 0.5};
  gltf.node()["rotation"] = {0, 0, 3, 1};  // of another length than 1: by twice the angle whose tangent is 3
  const Polygon_soup soup = gltf.read();
  const Rational tenth(1, 10), thousandth(1, 1000);
  EXPECT_EQ(soup.point(0), (Exact_point{tenth, -2, thousandth}));
  EXPECT_EQ(soup.point(1), (Exact_point{tenth + 2 * Rational(-4, 5), -2 + 2 * Rational(3, 5), thousandth}));
  EXPECT_EQ(soup.point(2), (Exact_point{tenth - 3 * Rational(3, 5), -2 + 3 * Rational(-4, 5), thousandth}));
  EXPECT_EQ(faces_of(soup), "012 ");
  // Rounded first, where that is wished.
  EXPECT_EQ(read_scene(gltf.bytes(), glb, "it", {true}).point(0)[0], exact(0.1));
}

TEST(Read_glb, rotated_about_each_axis_and_by_matrices) {
  const auto at = [](const Tree& rotation) {
    Glb gltf({1, 2, 3, 0, 0, 0, 1, 1, 1});
    gltf.node()["rotation"] = rotation;
    return gltf.read().point(0);
  };
  EXPECT_EQ(at({1, 0, 0, 1}), (Exact_point{1, -3, 2}));  // quarter turns
  EXPECT_EQ(at({0, 1, 0, 1}), (Exact_point{3, 2, -1}));
  EXPECT_EQ(at({0, 0, 1, 1}), (Exact_point{-2, 1, 3}));
  EXPECT_EQ(at({1, 1, 1, 1}), (Exact_point{3, 1, 2}));
  Glb gltf({1, 2, 3, 0, 0, 0, 1, 1, 1});
  gltf.node()["matrix"] = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 7, 8, 9, 1};  // by column
  EXPECT_EQ(gltf.read().point(0), (Exact_point{8, 5, 11}));
}

TEST(Read_glb, fronts_stay_fronts_where_a_node_mirrors) {
  Glb gltf(triangle);
  gltf.node()["scale"] = {-1, 1, 1};
  EXPECT_EQ(faces_of(gltf.read()), "021 ");
  gltf.node()["scale"] = {-1, -1, 1};
  EXPECT_EQ(faces_of(gltf.read()), "012 ");
}

TEST(Read_glb, nodes_below_nodes_and_meshes_that_come_twice) {
  Glb gltf(triangle);
  gltf.tree["nodes"] = Tree::parse(R"([{"children": [1, 2], "scale": [2, 2, 2]}, {"mesh": 0, "translation": [1, 0, 0]},
                                      {"mesh": 0}, {"mesh": 0}])");
  const Polygon_soup soup = gltf.read();
  EXPECT_EQ(faces_of(soup), "012 345 ") << "node 3 is not of the scene";
  EXPECT_EQ(soup.point(0), (Exact_point{2, 0, 0}));
  EXPECT_EQ(soup.point(1), (Exact_point{4, 0, 0}));
  EXPECT_EQ(soup.point(4), (Exact_point{2, 0, 0}));
  gltf.tree.erase("scenes");
  EXPECT_EQ(gltf.read().face_count(), 3u) << "all nodes";
  gltf.tree["scenes"] = Tree::parse(R"([{"nodes": [0]}, {"nodes": [3]}])");
  gltf.tree["scene"] = 1;
  EXPECT_EQ(gltf.read().face_count(), 1u);
}

TEST(Read_glb, points_that_primitives_share_come_once) {
  Glb gltf(five, std::vector<std::uint16_t>{0, 1, 2});
  gltf.tree["meshes"][0]["primitives"].push_back(gltf.primitive());
  gltf.tree["meshes"][0]["primitives"].push_back({{"attributes", {{"NORMAL", 0}}}});
  const Polygon_soup soup = gltf.read();
  EXPECT_EQ(faces_of(soup), "012 012 ");
  EXPECT_EQ(soup.point_count(), 5u);
}

TEST(Read_glb, of_what_was_drawn) {
  Grouped_polygons all;
  all.add_group("visible", {255, 0, 128});
  all.add_polygon(0, 7, {{1, 1, 0}, {3, 1, 0}, {3, 3, 2}, {1, 3, 2}});
  const Polygon_soup soup = read_scene(drawing_bytes(all, Drawing_format::glb), glb, "drawing");
  EXPECT_EQ(faces_of(soup), "012 023 ");
  EXPECT_EQ(soup.point(2), (Exact_point{3, 3, 2}));
  std::ostringstream out;
  EXPECT_THROW(write_scene(soup, out, glb), std::runtime_error);
}

TEST(Read_glb, what_is_no_such_file_is_refused_with_its_byte) {
  const std::string whole = Glb(triangle).bytes();
  for (std::size_t length = 1; length < whole.size(); ++length)
    EXPECT_TRUE(why(whole.substr(0, length)).starts_with("it: byte ")) << length;
  EXPECT_NE(why(whole + "more").find("data behind"), std::string::npos);
  EXPECT_NE(why("glTF" + whole.substr(4, 4).replace(0, 1, "\1") + whole.substr(8)).find("version 1"),
            std::string::npos);
  EXPECT_NE(why(file_of("{\"asset\": ", "")).find("no JSON"), std::string::npos);
  EXPECT_NE(why(file_of(std::string(100000, '['), "")).find("too deep"), std::string::npos);
  EXPECT_NE(why(file_of("{}", "")).find("version: it is missing"), std::string::npos);
  EXPECT_NE(why(file_of("[1]", "")).find("it is missing"), std::string::npos);
  Glb odd({0, 0, 0, 1, std::numeric_limits<float>::infinity(), 0, 0, 1, 0});
  EXPECT_NE(why(odd).find("not a finite number"), std::string::npos);
}

TEST(Read_glb, what_is_not_read_is_refused_with_its_place) {
  const auto refused = [](const std::string& pointer, const Tree& value, const std::string& message) {
    Glb gltf(five, std::vector<std::uint16_t>{0, 1, 2});
    gltf.tree[Tree::json_pointer(pointer)] = value;
    const std::string said = why(gltf);
    EXPECT_NE(said.find(message), std::string::npos) << pointer << ": " << said;
  };
  refused("/asset/version", "1.0", "only glTF 2");
  refused("/extensionsRequired", {"KHR_draco_mesh_compression"}, "KHR_draco_mesh_compression");
  refused("/buffers/0/uri", "other.bin", "not in this file");
  refused("/accessors/0/sparse", {{"count", 1}}, "sparse");
  refused("/accessors/0/componentType", 5123, "none of those");
  refused("/accessors/0/type", "VEC2", "no VEC3");
  refused("/accessors/0/count", 6, "accessors[0]: it goes beyond");
  refused("/accessors/0/count", 4294967295u, "accessors[0]: it goes beyond");
  refused("/accessors/0/count", 18446744073709551615u, "accessors[0]: it goes beyond");
  refused("/accessors/0/count", -1, "accessors[0].count: -1 is no count");
  refused("/accessors/0/count", 1.5, "is no count");
  refused("/accessors/0/count", 2, "there is no point 2 of 2");
  refused("/accessors/0/byteOffset", 18446744073709551615u, "it goes beyond");
  refused("/accessors/0/bufferView", 7, "there is no bufferViews[7]");
  refused("/accessors/0/bufferView", nullptr, "is no count or index");
  refused("/bufferViews/0/byteLength", 1000000, "beyond its buffer");
  refused("/bufferViews/0/byteOffset", 18446744073709551615u, "beyond its buffer");
  refused("/bufferViews/0/byteStride", 4, "overlap");
  refused("/bufferViews/0/buffer", 1, "there is no buffers[1]");
  refused("/accessors/1/count", 2, "no triangles");
  refused("/meshes/0/primitives/0/mode", 7, "no mode 7");
  refused("/nodes/0/mesh", 1, "there is no meshes[1]");
  refused("/nodes/0/children", {0}, "below itself");
  refused("/nodes/0/children", {5}, "there is no nodes[5]");
  refused("/scenes/0/nodes", {0, 0}, "two parents");
  refused("/scene", 1, "there is no scenes[1]");
  refused("/nodes/0/rotation", {0, 0, 0, 0}, "about no axis");
  refused("/nodes/0/translation", {0, 0}, "no list of 3");
  refused("/nodes/0/translation", {0, 0, "1"}, "translation[2]: it is no number");
  refused("/nodes/0/translation", {0, 0, 1e300}, "accepted");
  refused("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "last row");
}

TEST(Read_glb, numbers_out_of_proportion_are_refused) {
  Glb gltf(triangle);
  gltf.tree["nodes"] = Tree::array();
  for (int k = 0; k < 8; ++k) gltf.tree["nodes"].push_back({{"scale", {1e300, 1e-300, 1}}, {"children", {k + 1}}});
  gltf.tree["nodes"].push_back({{"mesh", 0}});
  EXPECT_NE(why(gltf).find("out of all proportion"), std::string::npos) << why(gltf);
  gltf.tree["nodes"][2]["children"] = {8};
  EXPECT_EQ(why(gltf), "accepted");
}

TEST(Read_glb, copies_out_of_proportion_are_refused) {
  std::vector<float> many(3 * 3000);
  Glb gltf(many);
  Tree copies = Tree::array(), numbers = Tree::array();
  for (int k = 0; k < 2000; ++k) {
    copies.push_back({{"mesh", 0}});
    numbers.push_back(k);
  }
  gltf.tree["nodes"] = copies;
  gltf.tree["scenes"][0]["nodes"] = numbers;
  EXPECT_NE(why(gltf).find("too many points"), std::string::npos);
}

}  // namespace
