// Compiled levels: their own table of what leaves see against the exact one, and a copy that has that.

#include "program.h"

#include <sightline/io/binary.h>

#include <array>
#include <fstream>

namespace program {

using Corner = std::array<float, 3>;

/// Four rooms in a row along x, with a door in each wall between two: the first cannot see the last.
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
      lumps[10].append(20, '\0');
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
  Json compared(const std::string& name) {
    const Outcome r = run({"compare", name, "pvs", "--rays", "1000", "--json", "-"});
    EXPECT_EQ(r.code, done) << r;
    return r.json()["result"]["leaves"];
  }

  static void expect_wrong(const Json& leaves, const std::string& method, int hidden, int visible) {
    for (const Json& row : leaves["rows"]) {
      if (row["method"] != method) continue;
      EXPECT_EQ(row["errors"]["wrongly_hidden"], hidden);
      EXPECT_EQ(row["errors"]["wrongly_visible"], visible);
      return;
    }
    ADD_FAILURE() << method;
  }

 private:
  void add_quad(const Corner& a, const Corner& b, const Corner& c, const Corner& d) { faces_.push_back({a, b, c, d}); }
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
    const float l = middle - 0.5f, h = middle + 0.5f;
    for (const auto& [y0, z0, y1, z1] :
         {std::array<float, 4>{-4, -4, 4, l}, {-4, h, 4, 4}, {-4, l, l, h}, {h, l, 4, h}}) {
      add_quad({x, y0, z0}, {x, y1, z0}, {x, y1, z1}, {x, y0, z1});
      add_quad({x, y0, z0}, {x, y0, z1}, {x, y1, z1}, {x, y1, z0});
    }
  }

  std::vector<std::vector<Corner>> faces_;
};

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
  const Json leaves = compared(file("solid.bsp", bytes));
  EXPECT_EQ(leaves["pairs"], 6);
  EXPECT_EQ(leaves["refuted"], 0);
}

}  // namespace program
