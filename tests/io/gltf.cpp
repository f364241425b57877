// Scenes in glTF: what nodes make of meshes, exactly; and what is refused.

#include "soup_text.h"

#include <sightline/io/binary.h>
#include <sightline/io/gltf.h>
#include <sightline/io/file.h>
#include <sightline/io/grouped_polygons.h>
#include <sightline/io/read.h>
#include <sightline/io/write.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <filesystem>
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
  EXPECT_NE(why(whole.substr(0, whole.size() - 1)).find("get all of it"), std::string::npos);
  EXPECT_TRUE(why(whole.substr(0, whole.size() - 1)).starts_with("it: byte 8: the file should have"))
      << "at its length";
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
  refused("/bufferViews/0/byteLength", 8, "accessors[0]: it goes beyond");  // less than one point
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

/// Nodes that turn points about askew axes, each with a denominator of its own: all come to lie on one grid.
TEST(Read_glb, grids_out_of_proportion_are_refused) {
  const auto turned = [](int count) {
    Glb gltf(std::vector<float>(3 * 600, 0.75f));
    gltf.tree["nodes"] = Tree::array();
    gltf.tree["scenes"][0]["nodes"] = Tree::array();
    for (int k = 0; k < count; ++k) {
      gltf.tree["nodes"].push_back({{"mesh", 0}, {"rotation", {0.123456789012345 + 0.001 * k, 0.2, 0.3, 0.9}}});
      gltf.tree["scenes"][0]["nodes"].push_back(k);
    }
    return why(gltf);
  };
  EXPECT_EQ(turned(3), "accepted");
  EXPECT_NE(turned(40).find("long out of all proportion to the file"), std::string::npos) << turned(40);
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

// ---- In JSON, its buffers elsewhere

std::string in_base64(const std::string& bytes) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
  }
  return text;
}
Polygon_soup read_json(const Tree& tree) { return read_scene(tree.dump(), Format::gltf, "it"); }
std::string why_not(const Tree& tree) {
  try {
    read_json(tree);
  } catch (const Input_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Read_gltf, with_its_buffers_in_itself_is_the_binary_file) {
  for (std::size_t extra = 0; extra < 3; ++extra) {  // all ends of base64
    Glb gltf(five, std::vector<std::uint8_t>{4, 3, 2, 0, 1, 2});
    gltf.node()["translation"] = {0.1, -2, 1e-3};
    const Polygon_soup binary = gltf.read();
    gltf.tree["buffers"][0]["uri"] =
        "data:application/octet-stream;base64," + in_base64(gltf.binary + std::string(extra, '\xff'));
    const Polygon_soup text = read_json(gltf.tree);
    EXPECT_EQ(faces_of(text), faces_of(binary));
    ASSERT_EQ(text.point_count(), binary.point_count());
    for (Point_id p = 0; p < text.point_count(); ++p) EXPECT_EQ(text.point(p), binary.point(p));
  }
}

TEST(Read_gltf, finds_its_buffers_beside_it) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "gltf beside";
  std::filesystem::create_directories(folder / "parts");
  Glb gltf(five, std::vector<std::uint16_t>{4, 3, 2});
  // The indices in a file of their own.
  const std::size_t split = gltf.tree["bufferViews"][0]["byteLength"];
  write_bytes(folder / "parts" / "five points.bin", gltf.binary.substr(0, split));
  write_bytes(folder / "indices.bin", gltf.binary.substr(split));
  gltf.tree["buffers"] = Tree::array({{{"uri", "parts/five%20points.bin"}}, {{"uri", "indices.bin"}}});
  gltf.tree["bufferViews"][1] = {{"buffer", 1}, {"byteLength", 6}};
  write_bytes(folder / "scene.gltf", gltf.tree.dump());
  EXPECT_EQ(faces_of(read_scene(folder / "scene.gltf")), "432 ");
  EXPECT_EQ(read_scene(folder / "scene.gltf").point_count(), 5u);
  const auto refused = [&] {
    try {
      read_scene(folder / "scene.gltf");
    } catch (const Input_error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  // What is wrong in a file beside it is said with that file's name; one that is not there is named.
  std::string wrong = gltf.binary.substr(split);
  wrong[2] = 9;
  write_bytes(folder / "indices.bin", wrong);
  EXPECT_EQ(refused(),
            (folder / "scene.gltf").string() + ": in indices.bin, byte 2: there is no point 9 of 5; repair the index");
  std::filesystem::remove(folder / "indices.bin");
  EXPECT_NE(refused().find("indices.bin"), std::string::npos) << refused();
  std::filesystem::remove_all(folder);
}

TEST(Read_gltf, reads_a_file_once_however_many_buffers_it_is) {
  Glb gltf(triangle);
  gltf.tree["buffers"] = Tree::array();
  gltf.tree["bufferViews"] = Tree::array();
  gltf.tree["accessors"] = Tree::array();
  Tree primitives = Tree::array();
  for (std::size_t k = 0; k < 5; ++k) {
    gltf.tree["buffers"].push_back({{"uri", k % 2 == 0 ? "a.bin" : "././/a.bin"}});
    gltf.tree["bufferViews"].push_back({{"buffer", k}, {"byteLength", 36}});
    gltf.tree["accessors"].push_back({{"bufferView", k}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    primitives.push_back({{"attributes", {{"POSITION", k}}}});
  }
  gltf.tree["meshes"][0]["primitives"] = primitives;
  int reads = 0;
  const std::string text = gltf.tree.dump();
  const Polygon_soup soup = read_gltf({"it", text}, {}, [&](const std::string& path) {
    EXPECT_EQ(path, "a.bin");
    ++reads;
    return gltf.binary;
  });
  EXPECT_EQ(soup.face_count(), 5u);
  EXPECT_EQ(reads, 1);
}

TEST(Read_gltf, json_that_is_none_is_told_where_its_token_begins) {
  const auto at = [](std::size_t line, std::size_t column, const std::string& text,
                     const char* part = "this is no JSON") {
    test::expect_error_at(line, column, part, text, Format::gltf);
  };
  at(1, 11, "{\"asset\": x}");
  at(3, 2, "{\"asset\": {\"version\":\"2.0\"},\n \"nodes\": [1,2,\n nul ]}");
  at(3, 1, "{\"asset\":\n{\"version\":\"2.0\"}}\n}");
  at(1, 8, "{\"a\": \"b\tc\"}");
  at(1, 7, "{\"a\": ");
  at(1, 7, "{\"a\": -1.5e+400}", "a number beyond the range of doubles");
  const std::string whole = Glb(triangle).tree.dump();
  for (const std::string& behind : {std::string("\0", 1), std::string("\0 ]", 3), std::string("\0{}", 3)})
    at(1, whole.size() + 1, whole + behind, "this is behind the end of the JSON; remove it");
}

TEST(Read_gltf, of_buffers_that_are_nowhere_says_so) {
  Glb gltf(triangle);
  const auto with = [&](const char* uri) {
    gltf.tree["buffers"][0]["uri"] = uri;
    return why_not(gltf.tree);
  };
  EXPECT_NE(why_not(gltf.tree).find("buffers[0]: its data are not in this file"), std::string::npos);
  for (const char* uri : {"https://example.org/a.bin", "/etc/passwd", "%2Fetc%2Fpasswd", "../a.bin", "b/%2e./a.bin", "",
                          "a%2", "a%zz", "a%00", "data:;base64,A*AA", "data:text/plain,abc", "file:a.bin"})
    EXPECT_NE(with(uri).find("is neither data in base64 nor a file beside this one"), std::string::npos) << with(uri);
  EXPECT_NE(with("points.bin").find("its data are not in this file, but in"), std::string::npos);
  EXPECT_NE(with("data:;base64,AAAA").find("it goes beyond its buffer"), std::string::npos);
  try {
    read_scene("{\n \"asset\": nothing}", Format::gltf, "it");
    ADD_FAILURE() << "accepted";
  } catch (const Input_error& error) {
    EXPECT_EQ(error.line, 2u) << error.what();
  }
}

}  // namespace
