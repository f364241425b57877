// Materials of OBJ files: which face has which, and what is wrong with a library.

#include "../sample.h"

#include <sightline/io/input.h>
#include <sightline/io/materials.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace {

using namespace sightline;

class Materials : public testing::Test {
 protected:
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("sightline_materials_" + std::to_string(getpid()));

  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }
  std::filesystem::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
  std::string error(const std::string& obj, const std::string& library) const {
    file("a.mtl", library);
    try {
      read_materials(file("a.obj", obj));
    } catch (const Input_error& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(Materials, are_those_of_the_last_usemtl) {
  file("glass.mtl", "newmtl clear pane\nKd 0.25 0.5 1\nd 0.75\nillum 2\nmap_Kd x.png\nnewmtl smoke\nTr 0.75\n");
  file("more.mtl", "newmtl smoke\nKd 1 1 1\nnewmtl lamp\nKd spectral lamp.rfl\nKd 1 0 0\nd -halo 0.5\n");
  const auto materials =
      read_materials(file("panes.obj",
                          "mtllib glass.mtl more.mtl\nv 0 0 0\nf 1 1 1\nusemtl clear   pane\nf 1 1 1\nf 1 1 1 \\\n1\n"
                          "usemtl smoke\nfo 1 1 1\nusemtl lamp\nf 1 1 1\n"));
  ASSERT_EQ(materials.size(), 5u);
  EXPECT_FALSE(materials[0]);
  EXPECT_EQ(materials[1]->name, "clear pane");
  EXPECT_EQ(materials[1]->colour, (std::array<double, 3>{0.25, 0.5, 1}));
  EXPECT_EQ(materials[1]->opacity, 0.75);
  EXPECT_EQ(materials[2]->name, "clear pane");
  EXPECT_EQ(materials[3]->opacity, 0.25);  // of two with one name the first counts
  EXPECT_EQ(materials[3]->colour, (std::array<double, 3>{0.8, 0.8, 0.8}));
  EXPECT_EQ(materials[4]->colour, (std::array<double, 3>{1, 0, 0}));
  EXPECT_EQ(materials[4]->opacity, 0.5);
  EXPECT_TRUE(read_materials(file("none.obj", "v 0 0 0\n")).empty());
}

TEST_F(Materials, stand_in_libraries_whose_names_may_have_blanks) {
  file("two  words.mtl", "newmtl m\nd 0.5\n");
  file("words.mtl", "newmtl m\nd 0.25\n");
  const auto opacity = [&](const std::string& line) {
    return read_materials(file("blanks.obj", line + "\nusemtl m\nf 1 1 1\n")).at(0)->opacity;
  };
  EXPECT_EQ(opacity("mtllib two  words.mtl # one"), 0.5);
  file("two", "newmtl other\n");
  EXPECT_EQ(opacity("mtllib two words.mtl"), 0.25);
  EXPECT_EQ(opacity("mtllib words.mtl"), 0.25);
}

TEST_F(Materials, that_are_wrong_are_told_at_their_place) {
  const std::string obj = "mtllib a.mtl\nusemtl m\nf 1 2 3\n";
  const auto ends = [](const std::string& text, const std::string& place) {
    return text.find(place) != std::string::npos;
  };
  EXPECT_TRUE(ends(error(obj, "newmtl other\n"), "a.obj:2:1: no material \"m\"")) << error(obj, "newmtl other\n");
  EXPECT_TRUE(ends(error(obj, "newmtl m\nd 1.5\n"), "a.mtl:2:3: an opacity"));
  EXPECT_TRUE(ends(error(obj, "newmtl m\nd\n"), "a.mtl:2:2: an opacity"));
  EXPECT_TRUE(ends(error(obj, "newmtl m\nTr -0.5\n"), "a.mtl:2:4: an opacity"));
  EXPECT_TRUE(ends(error(obj, "newmtl m\nd nan\n"), "a.mtl:2:3: "));
  EXPECT_TRUE(ends(error(obj, "newmtl " + std::string(1001, 'm') + "\n"), "is longer than 1000 bytes"));
  EXPECT_TRUE(ends(error(obj, "newmtl m\nKd 1 2\n"), "a.mtl:2:7: a colour has three numbers"));
  EXPECT_TRUE(ends(error(obj, "newmtl m\nKd 1 2 1e999\n"), "a.mtl:2:8: "));
  EXPECT_TRUE(ends(error(obj, "Kd 1 1 1\n"), "a.mtl:1:1: \"Kd\" before any newmtl"));
  EXPECT_TRUE(ends(error(obj, "newmtl\n"), "a.mtl:1:1: a material without a name"));
  EXPECT_TRUE(ends(error("v 0 0 0\nmtllib a.mtl  b.mtl\n", ""), "a.obj:2:15: no file \"b.mtl\" beside this one"));
}

}  // namespace
