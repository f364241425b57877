// Compiled levels: their own table of what leaves see against the exact one, and a copy that has that.

#include "flaw.h"
#include "program.h"

#include <sightline/io/binary.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

namespace program {

using Corner = std::array<float, 3>;

/// Four rooms in a row along x, with a door in each wall between two: the first cannot see the last. Each leaf lists
/// the faces of its room; those of the box around all are in each list.
class Compiled_levels : public Program {
 protected:
  Compiled_levels() {
    add_box({-12, -4, -4}, {20, 4, 4});
    add_wall(-4, -3);
    add_wall(4, 3);
    add_wall(12, -3);
  }

  /// The file, with this table: a byte for each of leaves 1 to 4, in which bit k is leaf k + 1.
  std::string level(const std::string& name, const std::array<std::uint8_t, 4>& table) {
    using sightline::store;
    std::array<std::string, 15> lumps;
    for (const float x : {4.f, 12.f, -4.f}) {
      for (const float entry : {1.f, 0.f, 0.f, x}) store(lumps[1], entry);
      store(lumps[1], std::int32_t{0});
    }
    store(lumps[12], std::uint16_t{0});
    store(lumps[12], std::uint16_t{0});
    std::uint16_t points = 0;
    std::int32_t edges = 0;
    for (const std::vector<Corner>& face : faces_) {
      store(lumps[7], std::uint32_t{0});
      store(lumps[7], edges);
      store(lumps[7], static_cast<std::uint16_t>(face.size()));
      lumps[7].append(10, '\0');
      for (std::size_t k = 0; k < face.size(); ++k) {  // clockwise, as files have it
        const std::size_t from = face.size() - 1 - k, to = (from + face.size() - 1) % face.size();
        store(lumps[12], static_cast<std::uint16_t>(points + from));
        store(lumps[12], static_cast<std::uint16_t>(points + to));
        store(lumps[13], ++edges);
      }
      for (const Corner& corner : face)
        for (const float x : corner) store(lumps[3], x);
      points = static_cast<std::uint16_t>(points + face.size());
    }
    for (const auto& [plane, front, behind] : {std::array<std::int16_t, 3>{0, 1, 2}, {1, -5, -4}, {2, -3, -2}}) {
      store(lumps[5], std::int32_t{plane});
      store(lumps[5], front);
      store(lumps[5], behind);
      lumps[5].append(16, '\0');
    }
    for (std::int32_t leaf = 0; leaf < 5; ++leaf) {
      store(lumps[10], std::int32_t{leaf == 0 ? -2 : -1});
      store(lumps[10], leaf - 1);
      lumps[10].append(12, '\0');
      store(lumps[10], static_cast<std::uint16_t>(lumps[11].size() / 2));
      const auto first = lumps[11].size() / 2;
      for (std::size_t face = 0; face < faces_.size(); ++face)
        if (leaf > 0 && (rooms_[face] == 0 || rooms_[face] == leaf)) store(lumps[11], static_cast<std::uint16_t>(face));
      store(lumps[10], static_cast<std::uint16_t>(lumps[11].size() / 2 - first));
      lumps[10].append(4, '\0');
      if (leaf > 0) store(lumps[4], table[static_cast<std::size_t>(leaf - 1)]);
    }
    lumps[14].append(36, '\0');
    for (const std::int32_t value : {0, 0, 0, 0, 4, 0, static_cast<std::int32_t>(faces_.size())})
      store(lumps[14], value);
    std::string bytes, body;
    store(bytes, std::int32_t{29});
    for (const std::string& lump : lumps) {
      store(bytes, static_cast<std::int32_t>(124 + body.size()));
      store(bytes, static_cast<std::int32_t>(lump.size()));
      body += lump;
    }
    return file(name, bytes + body);
  }
  Json compared_faces(const std::string& name) {
    const Outcome r = run({"compare", name, "pvs", "--rays", "1000", "--json", "-"});
    EXPECT_EQ(r.code, done) << r;
    const Json schema = run({"schema", "compare"}).json(), written = r.json();
    EXPECT_EQ(flaw(written, schema, schema, "compare"), "");
    return written["result"];
  }
  Json compared(const std::string& name) { return compared_faces(name)["leaves"]; }
  static Json row_of(const Json& rows, const std::string& method) {
    for (const Json& row : rows)
      if (row["method"] == method) return row;
    ADD_FAILURE() << method;
    return {};
  }

  static void expect_wrong(const Json& leaves, const std::string& method, int hidden, int visible) {
    const Json row = row_of(leaves["rows"], method);
    EXPECT_EQ(row["errors"]["wrongly_hidden"], hidden);
    EXPECT_EQ(row["errors"]["wrongly_visible"], visible);
  }

  /// A square of a 256th, front to smaller x, and its back, before the wall at the end of room 3.
  void add_tiny() {
    const float x = 11, y = -1, z = -1, s = 1 / 256.f;
    add_quad({x, y, z}, {x, y, z + s}, {x, y + s, z + s}, {x, y + s, z}, 3);
    add_quad({x, y, z}, {x, y + s, z}, {x, y + s, z + s}, {x, y, z + s}, 3);
  }
  const std::vector<Corner>& face(std::size_t id) const { return faces_[id]; }

 private:
  void add_quad(const Corner& a, const Corner& b, const Corner& c, const Corner& d, int room = 0) {
    faces_.push_back({a, b, c, d});
    rooms_.push_back(room);
  }
  /// Seen from inside.
  void add_box(const Corner& l, const Corner& h) {
    add_quad({l[0], l[1], l[2]}, {l[0], h[1], l[2]}, {l[0], h[1], h[2]}, {l[0], l[1], h[2]});
    add_quad({h[0], l[1], l[2]}, {h[0], l[1], h[2]}, {h[0], h[1], h[2]}, {h[0], h[1], l[2]});
    add_quad({l[0], l[1], l[2]}, {l[0], l[1], h[2]}, {h[0], l[1], h[2]}, {h[0], l[1], l[2]});
    add_quad({l[0], h[1], l[2]}, {h[0], h[1], l[2]}, {h[0], h[1], h[2]}, {l[0], h[1], h[2]});
    add_quad({l[0], l[1], l[2]}, {h[0], l[1], l[2]}, {h[0], h[1], l[2]}, {l[0], h[1], l[2]});
    add_quad({l[0], l[1], h[2]}, {l[0], h[1], h[2]}, {h[0], h[1], h[2]}, {h[0], l[1], h[2]});
  }
  /// Both sides of a wall across the row, but for a door of one unit about y = z = middle.
  void add_wall(float x, float middle) {
    const int behind = static_cast<int>(x + 4) / 8 + 1;  // rooms are eight units long
    const float l = middle - 0.5f, h = middle + 0.5f;
    for (const auto& [y0, z0, y1, z1] :
         {std::array<float, 4>{-4, -4, 4, l}, {-4, h, 4, 4}, {-4, l, l, h}, {h, l, 4, h}}) {
      add_quad({x, y0, z0}, {x, y1, z0}, {x, y1, z1}, {x, y0, z1}, behind + 1);
      add_quad({x, y0, z0}, {x, y0, z1}, {x, y1, z1}, {x, y1, z0}, behind);
    }
  }

  std::vector<std::vector<Corner>> faces_;
  std::vector<int> rooms_;  // by face; 0: it is in all of them
};

double number_of(const Json& text) {
  const std::string s = text;
  const std::size_t slash = s.find('/');
  return std::stod(s) / (slash == std::string::npos ? 1 : std::stod(s.substr(slash + 1)));
}
/// Of the part of a rectangle across the x axis that an eye sees through a hole in another plane across it, in pixels:
/// by the integral of the solid angle, from the four corners of what is common to the two.
double seen_through(const std::array<double, 3>& eye, const std::vector<Corner>& face,
                    const std::array<double, 2>& y_hole, const std::array<double, 2>& z_hole, double x_hole) {
  const double depth = std::abs(face[0][0] - eye[0]), scale = depth / std::abs(x_hole - eye[0]);
  std::array<std::array<double, 2>, 2> sides;  // of y and z, about the eye
  for (std::size_t k = 0; k < 2; ++k) {
    const auto [least, most] = std::minmax_element(
        face.begin(), face.end(), [&](const Corner& a, const Corner& b) { return a[k + 1] < b[k + 1]; });
    const std::array<double, 2>& hole = k == 0 ? y_hole : z_hole;
    sides[k] = {std::max((*least)[k + 1] - eye[k + 1], scale * (hole[0] - eye[k + 1])),
                std::min((*most)[k + 1] - eye[k + 1], scale * (hole[1] - eye[k + 1]))};
    if (sides[k][0] >= sides[k][1]) return 0;
  }
  const auto corner = [&](double y, double z) {
    return std::atan2(y * z, depth * std::sqrt(depth * depth + y * y + z * z));
  };
  const auto& [y, z] = sides;
  return 512 * 512 * (corner(y[1], z[1]) - corner(y[0], z[1]) - corner(y[1], z[0]) + corner(y[0], z[0]));
}

TEST_F(Compiled_levels, own_tables_are_refuted_by_sightlines_leaf_by_leaf) {
  // Leaves 2 and 3, which have a door between them, do not see each other by it, and 1 and 4 do.
  const Json leaves = compared(level("wrong.bsp", {0x0f, 0x0b, 0x0d, 0x0f}));
  EXPECT_EQ(leaves["pairs"], 12);
  EXPECT_EQ(leaves["visible"], 10);
  EXPECT_EQ(leaves["undecided"], 0);
  expect_wrong(leaves, "leaves, flooding", 0, 0);
  expect_wrong(leaves, "leaves, the file's", 2, 2);
  EXPECT_EQ(leaves["refuted"], 2);
  EXPECT_EQ(leaves["through_solid"], 0);
  ASSERT_EQ(leaves["sightlines"].size(), 2u);
  EXPECT_EQ(leaves["sightlines"][0]["through"], Json({2, 3}));
  EXPECT_EQ(leaves["sightlines"][1]["through"], Json({3, 2}));
}

TEST_F(Compiled_levels, faces_that_tables_hide_are_as_large_as_a_door_leaves_them) {
  // Rooms 2 and 3, with a door at x = 4: what is hidden are walls at the far ends, and in room 3 a square of a 256th.
  add_tiny();
  const Json said = compared_faces(level("wrong.bsp", {0x0f, 0x0b, 0x0d, 0x0f}));
  const Json table = row_of(said["rows"], "the file's table");
  const std::size_t hidden = table["errors"]["wrongly_hidden"];
  EXPECT_EQ(said["refuted"], hidden);
  EXPECT_EQ(table["visible"].get<std::size_t>() + hidden - table["errors"]["wrongly_visible"].get<std::size_t>(),
            said["visible"]);
  ASSERT_GT(hidden, 4u);
  ASSERT_LE(hidden, 20u) << "all are listed";
  ASSERT_EQ(said["sightlines"].size(), hidden);
  std::array<std::size_t, 5> counts{};
  double last = 1e9, largest = 0;
  for (const Json& line : said["sightlines"]) {
    EXPECT_EQ(line["through"], line["leaf"] == 2 ? Json({2, 3}) : Json({3, 2})) << line;
    std::array<double, 3> eye{};
    for (std::size_t k = 0; k < 3; ++k) eye[k] = number_of(line["from"][k]);
    const double pixels = line["pixels"], expected = seen_through(eye, face(line["face"]), {2.5, 3.5}, {2.5, 3.5}, 4);
    EXPECT_GT(pixels, 0) << line;
    EXPECT_NEAR(pixels / expected, 1, 1e-3) << line << ": the square hides a little of a wall, at most";
    EXPECT_LE(pixels, last) << "the largest first";
    last = pixels;
    largest = std::max(largest, pixels);
    ++counts[pixels < 1 ? 0 : pixels < 10 ? 1 : pixels < 100 ? 2 : pixels < 1000 ? 3 : 4];
  }
  EXPECT_GT(counts[0], 0u) << "the square";
  EXPECT_GT(counts[3] + counts[4], 0u) << "walls";
  const Json& sizes = table["sizes"]["wrongly_hidden"];
  EXPECT_EQ(sizes["measured"], hidden);
  EXPECT_EQ(sizes["largest"], largest);
  std::size_t k = 0;
  for (const char* key : {"below_1", "below_10", "below_100", "below_1000", "above"})
    EXPECT_EQ(sizes[key], counts[k++]) << key;
  // What is too many: rooms 1 and 4, which see no walls of each other.
  EXPECT_EQ(table["sizes"]["wrongly_visible"]["measured"], table["errors"]["wrongly_visible"]);
  EXPECT_GT(table["sizes"]["wrongly_visible"]["largest"], 100);
  EXPECT_EQ(row_of(said["rows"], "flooding")["sizes"]["wrongly_hidden"]["measured"], 0);
  // A leaf sees itself, whether or not its row says so.
  const Json same = compared_faces(level("itself.bsp", {0x0f, 0x0b, 0x09, 0x0f}));
  EXPECT_EQ(row_of(same["rows"], "the file's table")["errors"], table["errors"]);
}

TEST_F(Compiled_levels, each_pair_that_a_table_hides_has_a_certificate_of_its_own) {
  add_tiny();
  const std::string wrong = level("wrong.bsp", {0x0f, 0x0b, 0x0d, 0x0f}), lines = path("lines").string();
  const Outcome r = run({"compare", wrong, "pvs", "--rays", "10", "--sightlines", lines, "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json said = r.json()["result"];
  const auto check = [&](const Json& line, bool to_face) {
    ASSERT_TRUE(line.contains("certificate")) << line;
    const fs::path file = fs::path(lines) / line["certificate"].get<std::string>();
    const Json certificate = Json::parse(read_file(file));
    ASSERT_EQ(certificate["visible"].size(), 1u);
    const Json& shown = certificate["visible"][0];
    if (to_face) {
      EXPECT_EQ(shown["from"], line["from"]);
      EXPECT_EQ(shown["to"], line["to"]);
      EXPECT_EQ(certificate["fragments"][shown["fragment"].get<std::size_t>()]["face"], line["face"]);
    } else {  // through the door; the line that is listed would end on an edge
      const double from = number_of(shown["from"][0]), to = number_of(shown["to"][0]);
      EXPECT_LT((from - 4) * (to - 4), 0);
      const double t = (4 - from) / (to - from);
      for (std::size_t k = 1; k < 3; ++k) {
        const double y = number_of(shown["from"][k]) + t * (number_of(shown["to"][k]) - number_of(shown["from"][k]));
        EXPECT_GT(y, 2.5);
        EXPECT_LT(y, 3.5);
      }
    }
    EXPECT_EQ(run({"verify", wrong, file.string()}).code, done) << line;
  };
  ASSERT_GT(said["sightlines"].size(), 4u);
  for (const Json& line : said["sightlines"]) check(line, true);
  ASSERT_EQ(said["leaves"]["sightlines"].size(), 2u);
  for (const Json& line : said["leaves"]["sightlines"]) check(line, false);
  EXPECT_EQ(std::distance(fs::directory_iterator(lines), {}),
            static_cast<std::ptrdiff_t>(said["sightlines"].size() + said["leaves"]["sightlines"].size()));
  EXPECT_EQ(run({"compare", (corpus / "general" / "two_rooms.map").string(), "pvs", "--sightlines", lines}).code,
            usage);
}

TEST_F(Compiled_levels, budgets_that_run_out_anywhere_leave_an_answer) {
  add_tiny();
  const std::string wrong = level("wrong.bsp", {0x0f, 0x0b, 0x0d, 0x0f});
  for (const char* budget : {"0.001", "0.003", "0.01", "0.03", "0.1"}) {
    const Outcome r = run({"compare", wrong, "pvs", "--rays", "10", "--budget", budget, "--json", "-"});
    EXPECT_TRUE(r.code == done || r.code == undecided) << r;
    if (r.code == undecided && r.out.empty()) {  // no time for the cells
      EXPECT_TRUE(r.one_line_of_error()) << r;
      continue;
    }
    const Json said = r.json();
    ASSERT_FALSE(said.is_discarded()) << r;
    for (const Json& row : said["result"]["leaves"]["rows"])  // what is undecided is not judged
      if (row["status"] == "done" && row["method"] != "leaves, the file's") {
        EXPECT_EQ(row["errors"]["wrongly_visible"], 0) << row;
      }
    EXPECT_LE(said["result"]["sightlines"].size(), said["result"]["refuted"].get<std::size_t>());
  }
}

TEST_F(Compiled_levels, a_row_says_how_to_draw_what_it_shows) {
  add_tiny();
  const Json said = compared_faces(level("wrong.bsp", {0x0f, 0x0b, 0x0d, 0x0f}));
  for (const Json& line : said["sightlines"]) {
    std::istringstream command(line["draw"].get<std::string>());
    std::vector<std::string> words;
    for (std::string word; command >> word;) words.push_back(word);
    ASSERT_EQ(words[0], "sightline");
    words.erase(words.begin());
    const std::string name = "face-" + std::to_string(line["face"].get<int>());
    EXPECT_EQ(words.back(), name + ".svg");
    words.back() = path(words.back()).string();
    words.insert(words.end(), {"--certificate", path("seen.json").string()});
    ASSERT_EQ(run(words).code, done) << line;
    // It shows the face, a small one about a twentieth of 960 wide, and the certificate is right.
    const std::string drawn = read_file(path(name + ".svg")), before = "id=\"" + name + "-1\" points=\"";
    const std::size_t at = drawn.find(before);
    ASSERT_NE(at, std::string::npos) << line;
    if (line["pixels"] < 1) {
      std::istringstream corners(drawn.substr(at + before.size()));
      double least = 960, most = 0, x = 0, y = 0;
      for (char comma = 0; corners >> x >> comma >> y; most = std::max(most, x)) least = std::min(least, x);
      EXPECT_GT(most - least, 20) << drawn;
      EXPECT_LT(most - least, 150) << drawn;
      EXPECT_NEAR((least + most) / 2, 480, 1);
    }
    const Outcome checked = run({"verify", path("wrong.bsp").string(), path("seen.json").string()});
    EXPECT_EQ(checked.code, done) << checked;
  }
}

TEST_F(Compiled_levels, a_copy_has_the_exact_table) {
  const std::string wrong = level("wrong.bsp", {0x0f, 0x0b, 0x0d, 0x0f}), copy = path("copy.bsp").string();
  ASSERT_EQ(run({"pvs", wrong, "--out", copy}).code, done);
  for (const char* picture : {"--svg", "--html", "--obj", "--mesh"}) {
    const std::string ending = std::string(picture) == "--mesh" ? "ply" : picture + 2;
    const Outcome drawn = run({"pvs", wrong, "--out", copy, picture, path("drawn." + ending).string()});
    EXPECT_EQ(drawn.code, usage) << drawn;
  }
  const Json said = compared(copy);
  EXPECT_EQ(said["visible"], 10);
  expect_wrong(said, "leaves, the file's", 0, 0);
  EXPECT_EQ(said["refuted"], 0);
  // What sightlines in the open go through is open: a wall that the file calls solid without a face is told apart.
  std::string bytes = read_file(wrong);
  const std::size_t leaf_lump = sightline::load<std::uint32_t>(bytes, 4 + 8 * 10, std::endian::little);
  bytes[leaf_lump + 2 * 28] = '\xfe';  // leaf 2: contents -2
  const Json solid = compared_faces(file("solid.bsp", bytes)), &leaves = solid["leaves"];
  ASSERT_FALSE(solid["sightlines"].empty());
  for (const Json& line : solid["sightlines"]) EXPECT_EQ(line["leaf"], 3) << "of what is solid a table says nothing";
  EXPECT_EQ(leaves["pairs"], 6);
  EXPECT_EQ(leaves["refuted"], 0);
}

TEST_F(Compiled_levels, from_standard_input_are_compiled_levels_all_the_same) {
  const std::string wrong = level("wrong.bsp", {0x0f, 0x0b, 0x0d, 0x0f}), copy = path("copy.bsp").string(),
                    same = path("same.bsp").string();
  ASSERT_EQ(run({"pvs", wrong, "--out", copy}).code, done);
  const Json by_name = compared(wrong);
  input_ = wrong;
  ASSERT_EQ(run({"pvs", "-", "--out", same}).code, done);
  EXPECT_EQ(read_file(same), read_file(copy));
  EXPECT_EQ(run({"cells", "-", "--leaves"}).code, done);
  EXPECT_EQ(compared("-")["refuted"], by_name["refuted"]);
}

}  // namespace program
