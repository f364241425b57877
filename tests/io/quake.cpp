// Quake's levels: brushes between planes, and compiled ones with their tree and table.

#include "soup_text.h"

#include <sightline/io/binary.h>
#include <sightline/io/quake_bsp.h>
#include <sightline/io/quake_map.h>
#include <sightline/io/write.h>
#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/vectors.h>

#include <array>
#include <cstddef>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace sightline::test {
namespace {

constexpr Format map = Format::map, bsp = Format::bsp;

/// A side through three points, clockwise as seen from outside.
std::string side(const std::string& a, const std::string& b, const std::string& c,
                 const std::string& texture = "wall") {
  return "( " + b + " ) ( " + a + " ) ( " + c + " ) " + texture + " 0 0 0 1 1\n";
}
/// A box whose low corner is the origin, as its six sides.
std::string box(const std::string& x, const std::string& y, const std::string& z, const std::string& texture = "wall") {
  return side("0 0 0", "0 0 1", "0 1 0", texture) + side(x + " 0 0", x + " 1 0", x + " 0 1", texture) +
         side("0 0 0", "1 0 0", "0 0 1", texture) + side("0 " + y + " 0", "0 " + y + " 1", "1 " + y + " 0", texture) +
         side("0 0 0", "0 1 0", "1 0 0", texture) + side("0 0 " + z, "1 0 " + z, "0 1 " + z, texture);
}
std::string entity(const std::string& kind, const std::vector<std::string>& brushes) {
  std::string text = "{\n\"classname\" \"" + kind + "\"\n";
  for (const std::string& brush : brushes) text += "{\n" + brush + "}\n";
  return text + "}\n";
}

TEST(Quake_map, a_brush_is_what_its_sides_leave) {
  const Polygon_soup soup = read_scene(entity("worldspawn", {box("2", "0.5", "1e1")}), map, "scene");
  EXPECT_EQ(soup.point_count(), 8u);
  ASSERT_EQ(soup.face_count(), 6u);
  const Exact_point middle{1, Rational(1, 4), 5};
  std::set<Exact_point> corners;
  for (Face_id f = 0; f < 6; ++f) {
    ASSERT_EQ(soup.loop(f).size(), 4u);
    std::array<Exact_point, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = soup.point(soup.loop(f)[k]);
    EXPECT_LT(dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), minus(middle, p[0])), 0) << "face " << f;
    for (const Point_id c : soup.loop(f)) corners.insert(soup.point(c));
  }
  std::set<Exact_point> expected;
  for (const Rational& x : {Rational(0), Rational(2)})
    for (const Rational& y : {Rational(0), Rational(1, 2)})
      for (const Rational& z : {Rational(0), Rational(10)}) expected.insert({x, y, z});
  EXPECT_EQ(corners, expected);
}

TEST(Quake_map, corners_are_exact_where_three_planes_meet) {
  // 3 x + y + z = 1 cuts a tetrahedron off a box, with a corner at 1/3, which no double holds.
  const std::string cut = side("0 1 0", "0 0 1", "1 -1 -1");
  const Polygon_soup soup = read_scene(entity("worldspawn", {box("2", "2", "2") + cut}), map, "scene");
  ASSERT_EQ(soup.face_count(), 4u);
  EXPECT_EQ(soup.point_count(), 4u);
  EXPECT_TRUE(closure(Scene(soup)).closed);
  std::set<Exact_point> corners;
  for (Point_id p = 0; p < soup.point_count(); ++p) corners.insert(soup.point(p));
  EXPECT_EQ(corners, (std::set<Exact_point>{{0, 0, 0}, {Rational(1, 3), 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  expect_error_at(4, 3, "not a decimal", entity("worldspawn", {side("0 0 0", "1/3 0 0", "0 1 0")}), map);
}

TEST(Quake_map, the_world_is_kept_and_what_is_not_drawn_is_passed_over) {
  const std::string one = box("1", "1", "1");
  EXPECT_EQ(read_scene("// a level\n" + entity("worldspawn", {one, box("3", "3", "3", "clip")}) +
                           entity("func_door", {one}) + entity("func_detail", {box("2", "2", "2")}) +
                           "{\n\"classname\" \"light\"\n\"origin\" \"0 0 1\" // here\n}\n",
                       map, "scene")
                .face_count(),
            12u);
  // One side that is drawn is enough; words of a value are not looked at.
  EXPECT_EQ(read_scene("{\n\"message\" \"{ a ( b\"\n\"classname\" \"worldspawn\"\n{\n" +
                           box("1", "1", "1", "skip").substr(0, box("1", "1", "1", "skip").rfind("skip")) +
                           "METAL [ 0 0 1 16 ] [ 0 1 0 64 ] 90 1 1\n}\n}",
                       map, "scene")
                .face_count(),
            6u);
}

TEST(Quake_map, sides_that_leave_nothing_or_come_twice_are_passed_over) {
  const std::string cube = box("1", "1", "1");
  const std::string touching = side("2 0 0", "0 2 0", "2 0 1");  // x + y = 2: along an edge
  const std::string beyond = side("9 0 0", "9 1 0", "9 0 1"), again = side("1 0 0", "1 5 0", "1 0 5");
  for (const std::string& more : {touching, beyond, again, again + again + touching + beyond}) {
    const Polygon_soup soup = read_scene(entity("worldspawn", {cube + more}), map, "scene");
    EXPECT_EQ(soup.face_count(), 6u) << more;
    EXPECT_EQ(soup.point_count(), 8u) << more;
  }
}

TEST(Quake_map, brushes_that_touch_share_their_points) {
  const Polygon_soup soup = read_scene(
      entity("worldspawn", {box("1", "1", "1"), box("1", "1", "1") + side("9 0 0", "9 1 0", "9 0 1")}), map, "scene");
  EXPECT_EQ(soup.point_count(), 8u);
  EXPECT_EQ(soup.face_count(), 12u);
}

TEST(Quake_map, brushes_are_known_by_their_numbers_and_faces) {
  const std::string cube = box("1", "1", "1");
  const std::string text =
      entity("worldspawn", {cube, box("2", "2", "2", "clip"), cube + side("1 0 0", "0 1 0", "1 0 1")}) +
      entity("func_door", {cube}) + entity("func_detail", {cube});
  std::vector<std::array<std::size_t, 4>> found;
  for (const Map_brush& brush : read_map_brushes({"scene", text}))
    found.push_back({brush.entity, brush.brush, brush.first_face, brush.faces});
  EXPECT_EQ(found, (std::vector<std::array<std::size_t, 4>>{{0, 0, 0, 6}, {0, 2, 6, 5}, {2, 0, 11, 6}}));
  EXPECT_EQ(read_scene(text, map, "scene").face_count(), 17u);
}

TEST(Quake_map, places_are_the_origins_of_what_has_no_brushes) {
  const std::string text = "{\n\"classname\" \"worldspawn\"\n{\n" + box("1", "1", "1") +
                           "}\n}\n{\n\"origin\" \"1 -2.5 3e1\" // here\n\"classname\" \"info_player_start\"\n}\n"
                           "{\n\"classname\" \"func_door\"\n\"origin\" \"7 7 7\"\n{\n" +
                           box("1", "1", "1") + "}\n}\n{\n\"classname\" \"light\"\n}\n{\n\"origin\" \"0 0 0\"\n}\n";
  const std::vector<Map_place> places = read_map_places({"scene", text});
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].name, "info_player_start");
  EXPECT_EQ(places[0].origin, (Exact_point{1, Rational(-5, 2), 30}));
  EXPECT_EQ(places[1].name, "");
  EXPECT_EQ(places[1].origin, (Exact_point{0, 0, 0}));
  EXPECT_NO_THROW(read_scene("{\n\"origin\" \"here\"\n}\n", map, "scene"));  // nothing that faces need
  EXPECT_THROW(read_map_places({"scene", "{\n\"origin\" \"here\"\n}\n"}), Input_error);
  EXPECT_THROW(read_map_places({"scene", "{\n\"origin\" \"1 2\"\n}\n"}), Input_error);
}

std::size_t faces_in(const std::string& text) { return read_scene(text, map, "scene").face_count(); }

TEST(Quake_map, keys_and_sides_are_alone_on_their_lines_or_an_error) {
  const std::string cube = box("8", "8", "8");
  // A seventh side behind the sixth would be lost, and with it half of the box.
  const std::string half = side("4 0 0", "4 1 0", "4 0 1");
  EXPECT_EQ(faces_in(entity("worldspawn", {cube + half})), 6u);
  std::string joined = cube + half;
  joined[cube.size() - 1] = ' ';
  expect_error_at(9, 46, "unexpected \"(\"; begin a line of its own with it", entity("worldspawn", {joined}), map);
  std::string closed = cube;
  closed.insert(cube.size() - 1, " }");
  expect_error_at(9, 46, "unexpected \"}\"", entity("worldspawn", {closed}), map);
  EXPECT_EQ(faces_in(entity("worldspawn", {cube.substr(0, cube.size() - 1) + " // ( 4 0 0 )\n"})), 6u);
  const auto keys = [&](const std::string& text) { return "{\n" + text + "\n{\n" + cube + "}\n}\n"; };
  EXPECT_EQ(faces_in(keys("\"message\" \"two // words\" // and more\n\"wad\" \"\"\n\"classname\" \"worldspawn\"")), 6u);
  EXPECT_EQ(faces_in(keys("\"my key\" \"a\"\n\"classname\" \"worldspawn\"")), 6u);
  expect_error_at(2, 18, "begin a line of its own with it", keys("\"mapversion\" \"1\" \"classname\" \"worldspawn\""),
                  map);
  for (const char* text : {"\"classname\"\n\"worldspawn\"", "\"classname\"\"worldspawn\"", "\"classname\" worldspawn",
                           "\"classname\" \"worldspawn", "\"classname \"worldspawn\"", "\"classname\" \"a\"b\""}) {
    const std::optional<Input_error> error = error_of(keys(text), map);
    ASSERT_TRUE(error) << text;
    EXPECT_NE(std::string(error->what()).find("no \"KEY\" \"VALUE\" here"), std::string::npos) << error->what();
  }
  EXPECT_THROW(read_map_places({"scene", "{\n\"origin\" \"1 2 3 4\"\n}\n"}), Input_error);
}

TEST(Quake_map, errors_name_the_line) {
  const std::string cube = box("1", "1", "1");
  const std::string open = cube.substr(0, cube.rfind('\n', cube.size() - 2) + 1);
  expect_error_at(3, 1, "brush 0 of entity 0 has no end", entity("worldspawn", {open}), map);
  expect_error_at(14, 1, "brush 1 of entity 1 has no end", entity("light", {}) + entity("func_group", {cube, open}),
                  map);
  expect_error_at(3, 1, "has no volume", entity("worldspawn", {cube + side("0 0 0", "0 1 0", "0 0 1")}), map);
  expect_error_at(3, 1, "has no volume", entity("worldspawn", {cube + side("-1 0 0", "-1 1 0", "-1 0 1")}), map);
  expect_error_at(4, 1, "lie on a line", entity("worldspawn", {side("0 0 0", "1 2 3", "2 4 6")}), map);
  expect_error_at(4, 9, "no ) here", entity("worldspawn", {"( 0 0 0 0 ) ( 1 0 0 ) ( 0 1 0 ) t\n"}), map);
  expect_error_at(4, 7, "not a", entity("worldspawn", {"( 0 0 x ) ( 1 0 0 ) ( 0 1 0 ) t\n"}), map);
  expect_error_at(4, 1, "of later games", entity("worldspawn", {"brushDef\n"}), map);
  expect_error_at(1, 1, "an entity begins with {", "entity", map);
  const std::string whole = entity("worldspawn", {cube});
  for (std::size_t size = 1; size + 2 < whole.size(); ++size)
    EXPECT_TRUE(error_of(std::string_view(whole).substr(0, size), map)) << size;
  std::string many = entity("worldspawn", {cube});
  for (std::size_t k = 0; k < most_brush_sides; ++k) many.insert(many.find("( 0 0 1"), side("9 0 0", "9 1 0", "9 0 1"));
  EXPECT_TRUE(error_of(many, map));
}

TEST(Quake_map, numbers_out_of_proportion_are_an_error) {
  const std::string long_one = "1" + std::string(400, '7');
  expect_error_at(10, 1, "bits, more than 1024; give its points with fewer digits",
                  entity("worldspawn", {box("1", "1", "1") + side("0 0 " + long_one, "0 1 0", "1 0 0")}), map);
  // Cubes whose sides are a little askew: each of their corners has a denominator of its own.
  std::mt19937 random(1);
  const auto askew = [&](const std::array<int, 3>& p) {
    std::string text;
    for (const int x : p) text += std::to_string(x) + '.' + std::to_string(100000 + random() % 900000) + ' ';
    return text;
  };
  std::vector<std::string> cubes;
  for (int k = 0; k < 120; ++k) {
    std::string sides;
    for (int axis = 0; axis < 3; ++axis)
      for (const int at : {0, 100}) {
        std::array<std::array<int, 3>, 3> points{};
        for (std::array<int, 3>& p : points) p[static_cast<std::size_t>(axis)] = at;
        points[1][static_cast<std::size_t>((axis + (at == 0 ? 2 : 1)) % 3)] = 100;
        points[2][static_cast<std::size_t>((axis + (at == 0 ? 1 : 2)) % 3)] = 100;
        sides += side(askew(points[0]), askew(points[1]), askew(points[2]));
      }
    cubes.push_back(sides);
  }
  const auto found = error_of(entity("worldspawn", cubes), map);
  ASSERT_TRUE(found);
  EXPECT_NE(std::string(found->what()).find("long out of all proportion to the file"), std::string::npos)
      << found->what();
  cubes.resize(10);
  EXPECT_NO_THROW(read_scene(entity("worldspawn", cubes), map, "scene"));
}

// ---- Compiled levels

struct Tiny_level {
  std::vector<std::array<float, 3>> points{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};
  std::vector<std::array<std::uint16_t, 2>> edges{{0, 0}, {0, 1}, {1, 2}, {2, 3}, {0, 3}};
  std::vector<std::int32_t> turns{1, 2, 3, -4};
  std::int32_t version = 29, world_faces = 1;
  std::vector<std::pair<std::int32_t, std::int32_t>> leaves{{-2, -1}, {-1, 0}, {-1, 2}, {-3, -1}};  // contents, row
  std::string rows = std::string("\x03\x05\x00\x01", 4);  // leaves 1, 2; 1, 3; none
  std::int32_t visible_leaves = 3;
  std::string entities;
  std::vector<std::array<std::int16_t, 2>> nodes{{-2, 1}, {-3, -1}};

  std::string bytes() const {
    std::array<std::string, 15> lumps;
    lumps[0] = entities;
    for (const float x : {0.f, 0.f, 1.f, 0.f}) store(lumps[1], x);
    store(lumps[1], std::int32_t{2});
    for (const auto& p : points)
      for (const float x : p) store(lumps[3], x);
    lumps[4] = rows;
    for (const auto& node : nodes) {
      store(lumps[5], std::int32_t{0});
      for (const std::int16_t child : node) store(lumps[5], child);
      lumps[5].append(16, '\0');
    }
    store(lumps[7], std::uint16_t{0});
    store(lumps[7], std::uint16_t{0});
    store(lumps[7], std::int32_t{0});
    store(lumps[7], static_cast<std::uint16_t>(turns.size()));
    lumps[7].append(10, '\0');
    for (const auto& [contents, row] : leaves) {
      store(lumps[10], contents);
      store(lumps[10], row);
      lumps[10].append(12, '\0');
      store(lumps[10], std::uint16_t{0});
      store(lumps[10], static_cast<std::uint16_t>(contents == -1 && row == 0 ? 1 : 0));
      lumps[10].append(4, '\0');
    }
    store(lumps[11], std::uint16_t{0});
    for (const auto& edge : edges)
      for (const std::uint16_t p : edge) store(lumps[12], p);
    for (const std::int32_t turn : turns) store(lumps[13], turn);
    lumps[14].append(36, '\0');
    for (const std::int32_t value : {0, 0, 0, 0, visible_leaves, 0, world_faces}) store(lumps[14], value);

    std::string file, body;
    store(file, version);
    for (const std::string& lump : lumps) {
      store(file, static_cast<std::int32_t>(124 + body.size()));
      store(file, static_cast<std::int32_t>(lump.size()));
      body += lump;
    }
    return file + body;
  }
};

TEST(Quake_bsp, faces_tree_leaves_and_table_are_read) {
  const std::string bytes = Tiny_level().bytes();
  EXPECT_EQ(read_text(bytes, bsp), "0 0 0, 0 1 0, 1 1 0, 1 0 0 | 3 2 1 0");  // clockwise in the file
  const Quake_level level = read_quake_level({"scene", bytes});
  ASSERT_EQ(level.nodes.size(), 2u);
  EXPECT_EQ(level.nodes[0].children, (std::array<std::int32_t, 2>{-2, 1}));
  EXPECT_EQ(level.planes[0].normal[2], 1);
  ASSERT_EQ(level.leaves.size(), 4u);
  EXPECT_EQ(level.leaves[1].faces, std::vector<Face_id>{0});
  EXPECT_EQ(level.leaves[2].faces, std::vector<Face_id>{});
  EXPECT_EQ(level.seen_from(1), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(level.seen_from(2), (std::vector<std::size_t>{}));
  EXPECT_EQ(level.seen_from(3), (std::vector<std::size_t>{1, 2, 3}));  // no row
}

TEST(Quake_bsp, places_are_the_origins_of_what_has_no_model_of_the_file) {
  Tiny_level level;
  level.entities =
      "{\n\"classname\" \"worldspawn\"\n}\n{\n\"classname\" \"light\"\n\"origin\" \"1 -2.5 3\"\n}\n"
      "{\n\"model\" \"*1\"\n\"origin\" \"7 7 7\"\n}\n{\n\"model\" \"a.mdl\"\n\"origin\" \"0 0 0\"\n}\n";
  level.entities.push_back('\0');
  const std::vector<Map_place> places = read_level_places({"scene", level.bytes()});
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].name, "light");
  EXPECT_EQ(places[0].origin, (Exact_point{1, Rational(-5, 2), 3}));
  EXPECT_EQ(places[1].origin, (Exact_point{0, 0, 0}));
  level.entities = "{\n\"origin\" \"1 2\"\n}\n";
  EXPECT_THROW(read_level_places({"scene", level.bytes()}), Input_error);
  const std::string bytes = level.bytes();
  EXPECT_THROW(read_level_places({"scene", bytes.substr(0, 123)}), Input_error);
  EXPECT_THROW(read_level_places({"scene", bytes.substr(0, 130)}), Input_error);  // within the entities
  EXPECT_TRUE(read_level_places({"scene", Tiny_level().bytes()}).empty());
}

TEST(Quake_bsp, a_table_is_written_and_nothing_else) {
  for (const std::size_t leaves : {std::size_t{3}, std::size_t{70}, std::size_t{2100}}) {
    Tiny_level tiny;
    tiny.leaves.assign(leaves + 1, {-1, -1});
    tiny.visible_leaves = static_cast<std::int32_t>(leaves);
    const std::string before = tiny.bytes();
    std::vector<std::vector<bool>> rows(leaves, std::vector<bool>(leaves));
    for (std::size_t l = 0; l < leaves; ++l)
      for (std::size_t m = 0; m < leaves; ++m) rows[l][m] = l == m || (l + 7 * m) % 61 == 3;
    const std::string after = with_visibility(before, rows);
    const Quake_level old = read_quake_level({"before", before}), level = read_quake_level({"after", after});
    for (std::size_t l = 0; l < leaves; ++l) {
      std::vector<std::size_t> seen;
      for (std::size_t m = 0; m < leaves; ++m)
        if (rows[l][m]) seen.push_back(m + 1);
      ASSERT_EQ(level.seen_from(l + 1), seen) << leaves << " leaves, leaf " << l + 1;
    }
    EXPECT_EQ(text_of(level.soup), text_of(old.soup));
    // Only the entry of the lump, the leaves' rows and the lump itself differ.
    const std::size_t first_leaf = load<std::uint32_t>(before, 4 + 8 * 10, std::endian::little);
    std::string masked = after.substr(0, before.size());
    masked.replace(4 + 8 * 4, 8, before.substr(4 + 8 * 4, 8));
    const std::size_t lump = load<std::uint32_t>(before, 4 + 8 * 4, std::endian::little);
    masked.replace(lump, tiny.rows.size(), tiny.rows);
    for (std::size_t l = 1; l <= leaves; ++l)
      masked.replace(first_leaf + 28 * l + 4, 4, before.substr(first_leaf + 28 * l + 4, 4));
    EXPECT_TRUE(masked == before) << leaves;
  }
}

TEST(Quake_bsp, what_names_nothing_is_an_error_at_its_byte) {
  const auto broken = [](auto change) {
    Tiny_level level;
    change(level);
    return level.bytes();
  };
  expect_error_at_byte(0, "version 30, not 29", broken([](Tiny_level& level) { level.version = 30; }), bsp);
  EXPECT_TRUE(error_of(broken([](Tiny_level& level) { level.turns[2] = 5; }), bsp));
  EXPECT_TRUE(error_of(broken([](Tiny_level& level) { level.edges[2][0] = 4; }), bsp));
  EXPECT_TRUE(error_of(broken([](Tiny_level& level) { level.world_faces = 2; }), bsp));
  EXPECT_TRUE(error_of(broken([](Tiny_level& level) { level.world_faces = -1; }), bsp));
  EXPECT_TRUE(error_of(broken([](Tiny_level& level) { level.points[1][2] = std::nanf(""); }), bsp));
  EXPECT_TRUE(error_of(broken([](Tiny_level& level) { level.nodes[1][0] = 1; }), bsp));   // its own child
  EXPECT_TRUE(error_of(broken([](Tiny_level& level) { level.nodes[1][0] = 0; }), bsp));   // back to the root
  EXPECT_TRUE(error_of(broken([](Tiny_level& level) { level.nodes[1][1] = -5; }), bsp));  // the fifth of four leaves
  EXPECT_TRUE(error_of(broken([](Tiny_level& level) { level.leaves[1].second = 4; }), bsp));
  EXPECT_TRUE(error_of(broken([](Tiny_level& level) { level.rows = std::string("\0\0\0\x01", 4); }), bsp));
  EXPECT_TRUE(error_of(broken([](Tiny_level& level) { level.visible_leaves = 4; }), bsp));
}

/// Each row is as long as the lump in the worst case: a lump of many that begin in turn takes its square to read.
TEST(Quake_bsp, rows_that_overlap_are_an_error) {
  Tiny_level level;
  level.leaves.assign(21, {-1, -1});
  level.visible_leaves = 20;  // rows of three bytes
  level.rows = std::string(7, '\x01');
  level.leaves[1].second = level.leaves[2].second = 1;
  level.leaves[3].second = 4;
  EXPECT_NO_THROW(read_scene(level.bytes(), bsp, "scene"));
  level.leaves[4].second = 2;
  const auto error = error_of(level.bytes(), bsp);
  ASSERT_TRUE(error);
  EXPECT_NE(std::string(error->what()).find("overlaps that of another leaf"), std::string::npos) << error->what();
}

TEST(Quake_bsp, lumps_that_overlap_are_an_error) {
  std::string bytes = Tiny_level().bytes(), begin;
  store(begin, load<std::int32_t>(bytes, 4 + 8 * 3, std::endian::little) + 4);
  bytes.replace(4 + 8 * 4, 4, begin);  // the table within the points
  expect_error_at_byte(4 + 8 * 4, "begins within another", bytes, bsp);
}

TEST(Quake_bsp, cut_off_anywhere_it_is_an_error) {
  const std::string bytes = Tiny_level().bytes();
  for (std::size_t size = 1; size < bytes.size(); ++size)
    EXPECT_TRUE(error_of(std::string_view(bytes).substr(0, size), bsp)) << size;
}

TEST(Quake, levels_are_known_by_their_content_and_not_written) {
  EXPECT_EQ(format_of_content({"x", Tiny_level().bytes()}), bsp);
  EXPECT_EQ(format_of_content({"x", "// Game: Quake\n{\n}\n"}), map);
  EXPECT_EQ(format_of_content({"x", "{ }"}), map);
  EXPECT_EQ(format_of_ending("a.MAP"), map);
  EXPECT_EQ(format_of_ending("a.geom.bsp"), bsp);
  std::ostringstream out;
  EXPECT_THROW(write_scene(read_scene(Tiny_level().bytes(), bsp, "x"), out, bsp), std::runtime_error);
}

}  // namespace
}  // namespace sightline::test
