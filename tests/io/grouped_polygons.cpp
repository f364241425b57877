// Groups of polygons in files for programs that draw: read back, number by number.

#include <sightline/io/binary.h>
#include <sightline/io/grouped_polygons.h>
#include <sightline/io/read.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace sightline;
using nlohmann::json;

/// A square and a pentagon that share an edge, a triangle of no face far from both, and a group without polygons.
Grouped_polygons drawing(const Rational& offset = 0, const Rational& scale = 1) {
  Grouped_polygons all;
  all.add_group("visible", {255, 0, 128});
  all.add_group("none", {1, 2, 3});
  all.add_group("source", {10, 20, 30});
  const auto at = [&](long x, long y, const Rational& z) {
    return Exact_point{scale * (x + offset), scale * y, scale * z};
  };
  all.add_polygon(0, 7, {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)});
  all.add_polygon(0, 9, {at(1, 1, 0), at(1, 0, 0), at(2, 0, 0), at(3, 1, 0), at(2, 2, 0)});
  all.add_polygon(2, Grouped_polygons::no_face, {at(0, 0, Rational(1, 3)), at(5, 0, 1), at(0, 5, 1)});
  all.add_column("order", {2, 0, 1});
  return all;
}

void expect_read_back(Drawing_format format, Format as) {
  const Grouped_polygons all = drawing();
  const Polygon_soup soup = read_scene(drawing_bytes(all, format), as, "drawing", {});
  ASSERT_EQ(soup.face_count(), 3u);
  ASSERT_EQ(soup.point_count(), 10u) << "two corners are shared";
  for (std::uint32_t p = 0; p < 10; ++p)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(nearest_double(soup.point(p)[axis]), all.points()[p][static_cast<std::size_t>(axis)]);
  std::vector<std::uint32_t> corners;
  for (Face_id face = 0; face < 3; ++face)
    for (const Point_id corner : soup.loop(face, 0)) corners.push_back(corner);
  EXPECT_EQ(corners, all.corners());
}

TEST(Grouped_polygons, are_read_back_from_obj) {
  expect_read_back(Drawing_format::obj, Format::obj);
  const std::string text = drawing_bytes(drawing(), Drawing_format::obj);
  EXPECT_NE(text.find("g visible\nusemtl visible\nf 1 2 3 4\nf 3 2 5 6 7\ng source\nusemtl source\nf 8 9 10\n"),
            std::string::npos)
      << text;
}

TEST(Grouped_polygons, are_read_back_from_ply_with_what_is_said_of_them) {
  expect_read_back(Drawing_format::ply, Format::ply);
  const std::string bytes = drawing_bytes(drawing(), Drawing_format::ply);
  EXPECT_NE(bytes.find("comment group 2 is source\n"), std::string::npos);
  // The last face: three corners, its id, its group, its order, its colour.
  const std::size_t last = bytes.size() - (1 + 3 * 4 + 4 + 4 + 4 + 3);
  EXPECT_EQ(bytes[last], 3);
  const auto number = [&](std::size_t at) { return load<std::int32_t>(bytes, last + at, std::endian::little); };
  EXPECT_EQ(number(1), 7);
  EXPECT_EQ(number(13), -1) << "no face";
  EXPECT_EQ(number(17), 2);
  EXPECT_EQ(number(21), 1);
  EXPECT_EQ(bytes.substr(last + 25), "\x0a\x14\x1e");
}

TEST(Grouped_polygons, of_many_corners_are_in_ply_too) {
  Grouped_polygons all;
  all.add_group("g", {});
  std::vector<Exact_point> corners;
  for (int k = -200; k <= 200; ++k) corners.push_back({k, k * k, 0});
  all.add_polygon(0, 0, corners);
  const Polygon_soup soup = read_scene(drawing_bytes(all, Drawing_format::ply), Format::ply, "drawing", {});
  EXPECT_EQ(soup.loop(0, 0).size(), 401u);
}

/// What the two parts of a .glb hold.
struct Gltf {
  json tree;
  std::string numbers;

  explicit Gltf(const std::string& bytes) {
    const auto number = [&](std::size_t at) { return load<std::uint32_t>(bytes, at, std::endian::little); };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number(4), 2u);
    EXPECT_EQ(number(8), bytes.size());
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(number(12) % 4, 0u);
    tree = json::parse(bytes.substr(20, number(12)));
    if (20 + number(12) == bytes.size()) return;
    EXPECT_EQ(bytes.substr(24 + number(12), 4), std::string("BIN\0", 4));
    numbers = bytes.substr(28 + number(12));
    EXPECT_EQ(number(20 + number(12)), numbers.size());
    EXPECT_EQ(tree["buffers"][0]["byteLength"], numbers.size());
  }

  template <class Value>
  std::vector<Value> values(const json& accessor_number) const {
    const json& accessor = tree["accessors"][accessor_number.get<std::size_t>()];
    const json& view = tree["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    EXPECT_EQ(accessor["componentType"], (std::is_same_v<Value, float> ? 5126 : 5125));
    std::vector<Value> all(accessor["count"].get<std::size_t>() * (accessor["type"] == "VEC3" ? 3 : 1));
    EXPECT_EQ(view["byteLength"], 4 * all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = load<Value>(numbers, view["byteOffset"].get<std::size_t>() + 4 * i, std::endian::little);
    return all;
  }
};

TEST(Grouped_polygons, are_fans_of_triangles_in_gltf_with_faces_at_their_corners) {
  const Gltf gltf(drawing_bytes(drawing(), Drawing_format::glb));
  const json& primitives = gltf.tree["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 2u) << "a group without polygons is left out";
  ASSERT_EQ(gltf.tree["materials"].size(), 2u);
  EXPECT_EQ(gltf.tree["materials"][1]["name"], "source");
  const json& colour = gltf.tree["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"];
  EXPECT_EQ(colour[0], 1.0);
  EXPECT_EQ(colour[1], 0.0);
  EXPECT_NEAR(colour[2].get<double>(), 0.2158605, 1e-6) << "128 on a screen is a fifth of the light";
  const json& first = primitives[0]["attributes"];
  EXPECT_EQ(gltf.values<std::uint32_t>(primitives[0]["indices"]),
            (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 4, 7, 8}));
  EXPECT_EQ(gltf.values<float>(first["_FACE"]), (std::vector<float>{7, 7, 7, 7, 9, 9, 9, 9, 9}));
  EXPECT_EQ(gltf.values<float>(first["_ORDER"]), (std::vector<float>{2, 2, 2, 2, 0, 0, 0, 0, 0}));
  EXPECT_EQ(gltf.values<float>(primitives[1]["attributes"]["_FACE"]), (std::vector<float>{-1, -1, -1}));
  const std::vector<float> places = gltf.values<float>(first["POSITION"]);
  EXPECT_EQ(gltf.tree["nodes"][0]["translation"], json({2.5, 2.5, 0.5}));
  EXPECT_EQ(places[0] + 2.5, 0);
  EXPECT_EQ(places[3 * 7] + 2.5, 3) << "the pentagon's fourth corner";
  const json& accessor = gltf.tree["accessors"][first["POSITION"].get<std::size_t>()];
  EXPECT_EQ(accessor["min"], json({-2.5, -2.5, -0.5}));
  EXPECT_EQ(accessor["max"], json({0.5, -0.5, -0.5}));
}

TEST(Grouped_polygons, far_away_keep_their_shape_in_gltf) {
  const Rational far = 1L << 40;
  const Gltf gltf(drawing_bytes(drawing(far), Drawing_format::glb)),
      near(drawing_bytes(drawing(), Drawing_format::glb));
  const auto places = [](const Gltf& of) {
    return of.values<float>(of.tree["meshes"][0]["primitives"][0]["attributes"]["POSITION"]);
  };
  EXPECT_EQ(places(gltf), places(near));
  EXPECT_EQ(gltf.tree["nodes"][0]["translation"][0], std::ldexp(1, 40) + 2.5);
}

TEST(Grouped_polygons, beyond_floats_keep_their_shape_in_gltf) {
  const Gltf near(drawing_bytes(drawing(), Drawing_format::glb));
  const auto places = [](const Gltf& of) {
    return of.values<float>(of.tree["meshes"][0]["primitives"][0]["attributes"]["POSITION"]);
  };
  EXPECT_FALSE(near.tree["nodes"][0].contains("scale"));
  for (const int exponent : {130, 900, -200, -1000}) {
    Rational scale = 1;
    if (exponent > 0) mpq_mul_2exp(scale.get_mpq_t(), scale.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
    else mpq_div_2exp(scale.get_mpq_t(), scale.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
    const Gltf gltf(drawing_bytes(drawing(0, scale), Drawing_format::glb));
    std::vector<float> doubled = places(gltf);
    for (float& x : doubled) x *= 2;  // the drawing is five long, so that its scale is twice that
    EXPECT_EQ(doubled, places(near)) << exponent;
    EXPECT_EQ(gltf.tree["nodes"][0]["scale"], json(std::vector<double>(3, std::ldexp(2, exponent)))) << exponent;
  }
}

/// The numbers of an array of VTK's XML: eight bytes of length, then they, in base64.
std::string vtk_array(const std::string& text, const std::string& name) {
  std::size_t at = text.find("Name=\"" + name + "\"");
  EXPECT_NE(at, std::string::npos) << name;
  at = text.find('>', at) + 1;
  const std::string code = text.substr(at, text.find('<', at) - at);
  EXPECT_EQ(code.size() % 4, 0u);
  std::string bytes;
  std::uint32_t bits = 0, count = 0;
  for (const char c : code) {
    if (c == '=') break;
    const auto value = std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
    EXPECT_NE(value, std::string_view::npos);
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
  }
  EXPECT_EQ(load<std::uint64_t>(bytes, 0, std::endian::little), bytes.size() - 8) << name;
  return bytes.substr(8);
}

template <class Value>
std::vector<Value> vtk_numbers(const std::string& text, const std::string& name) {
  const std::string bytes = vtk_array(text, name);
  std::vector<Value> all;
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(Value))
    all.push_back(load<Value>(bytes, at, std::endian::little));
  return all;
}

TEST(Grouped_polygons, are_cells_with_data_in_vtk) {
  const Grouped_polygons all = drawing();
  for (const Drawing_format format : {Drawing_format::vtp, Drawing_format::vtu}) {
    const std::string text = drawing_bytes(all, format);
    std::vector<double> places;
    for (const auto& p : all.points()) places.insert(places.end(), p.begin(), p.end());
    EXPECT_EQ(vtk_numbers<double>(text, "Points"), places);
    EXPECT_EQ(vtk_numbers<std::int64_t>(text, "connectivity"),
              std::vector<std::int64_t>(all.corners().begin(), all.corners().end()));
    EXPECT_EQ(vtk_numbers<std::int64_t>(text, "offsets"), (std::vector<std::int64_t>{4, 9, 12}));
    EXPECT_EQ(vtk_numbers<std::int64_t>(text, "face"), (std::vector<std::int64_t>{7, 9, -1}));
    EXPECT_EQ(vtk_numbers<std::uint32_t>(text, "group"), (std::vector<std::uint32_t>{0, 0, 2}));
    EXPECT_EQ(vtk_numbers<std::uint32_t>(text, "order"), (std::vector<std::uint32_t>{2, 0, 1}));
    EXPECT_EQ(vtk_array(text, "colour"), std::string("\xff\0\x80\xff\0\x80\x0a\x14\x1e", 9));
    EXPECT_NE(text.find("<!-- group 2 is source -->"), std::string::npos);
  }
  EXPECT_EQ(vtk_array(drawing_bytes(all, Drawing_format::vtu), "types"), "\7\7\7");
}

TEST(Grouped_polygons, have_names_in_vtk_that_end_no_comment) {
  Grouped_polygons all;
  all.add_group("1-x_---_y--", {});
  EXPECT_NE(drawing_bytes(all, Drawing_format::vtp).find("<!-- group 0 is 1-x_-_-_y-_ -->"), std::string::npos)
      << drawing_bytes(all, Drawing_format::vtp);
}

TEST(Grouped_polygons, may_be_none) {
  const Grouped_polygons none;
  EXPECT_EQ(drawing_bytes(none, Drawing_format::obj), "");
  EXPECT_EQ(vtk_numbers<double>(drawing_bytes(none, Drawing_format::vtp), "Points").size(), 0u);
  EXPECT_FALSE(Gltf(drawing_bytes(none, Drawing_format::glb)).tree.contains("meshes"));
}

TEST(Grouped_polygons, beyond_doubles_are_refused) {
  Grouped_polygons all;
  all.add_group("g", {});
  mpz_class huge;
  mpz_ui_pow_ui(huge.get_mpz_t(), 10, 400);
  EXPECT_THROW(all.add_polygon(0, 0, {{Rational(huge), 0, 0}, {1, 0, 0}, {0, 1, 0}}), std::overflow_error);
}

TEST(Drawing_formats, are_known_by_their_endings) {
  EXPECT_EQ(drawing_format_of_ending("a.GLB"), Drawing_format::glb);
  EXPECT_EQ(drawing_format_of_ending("a.b.vtp"), Drawing_format::vtp);
  EXPECT_EQ(drawing_format_of_ending("a.stl"), std::nullopt);
  EXPECT_EQ(drawing_format_of_ending("glb"), std::nullopt);
}

}  // namespace
