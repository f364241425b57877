// read_scene: which format, and files that are none.

#include "soup_text.h"

#include <fstream>

namespace sightline::test {
namespace {

namespace fs = std::filesystem;

/// A folder that is there as long as the test.
class Read_scene : public testing::Test {
 protected:
  Read_scene() : folder_(fs::path(testing::TempDir()) / ("sightline_read_" + std::to_string(std::random_device()()))) {
    fs::create_directories(folder_);
  }
  ~Read_scene() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name, std::string_view bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  static std::string message(const fs::path& path) {
    try {
      return "read as " + text_of(read_scene(path));
    } catch (const Input_error& error) {
      EXPECT_EQ(error.file, path.string());
      EXPECT_EQ(error.line, 0u);
      EXPECT_TRUE(std::string(error.what()).starts_with(path.string() + ": "));
      return error.what();
    }
  }

  fs::path folder_;
};

const std::string obj_text = "v 0 0 0\n", off_text = "OFF\n1 0 0\n0 0 0\n",
                  stl_text = "solid\nfacet normal 0 0 1 outer loop vertex 0 0 0 endloop endfacet endsolid";
const std::string ply_text =
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\nend_header\n0 0 0\n";
const std::string binary_stl(84, '\0');

TEST_F(Read_scene, goes_by_the_ending_in_upper_or_lower_case) {
  for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{{"a.obj", obj_text},
                                                                                    {"a.OBJ", obj_text},
                                                                                    {"a.off", off_text},
                                                                                    {"a.Off", off_text},
                                                                                    {"a.ply", ply_text},
                                                                                    {"a.PLY", ply_text},
                                                                                    {"a.stl", stl_text},
                                                                                    {"a.sTl", stl_text},
                                                                                    {"a.b.obj", obj_text}})
    EXPECT_EQ(read_scene(file(name, bytes)).point_count(), 1u) << name;
  EXPECT_EQ(text_of(read_scene(file("a.qoff", "OFF 1 0 0\n1/3 0 0"))), "1/3 0 0 |");
  EXPECT_EQ(text_of(read_scene(file("a.QOFF", "OFF 1 0 0\n1/3 0 0"))), "1/3 0 0 |");
  EXPECT_EQ(read_scene(file("b.stl", binary_stl)).face_count(), 0u);
}

TEST_F(Read_scene, goes_by_the_content_where_the_ending_is_unknown) {
  EXPECT_EQ(read_scene(file("a", obj_text)).point_count(), 1u);
  EXPECT_EQ(read_scene(file("a.txt", "\xEF\xBB\xBF# c\n\no x\n" + obj_text)).point_count(), 1u);
  EXPECT_EQ(read_scene(file("a.txt", "# c\n" + off_text)).point_count(), 1u);
  EXPECT_EQ(read_scene(file("a.txt", "COFF 1 0 0\n0 0 0 1 1 1\n")).point_count(), 1u);
  EXPECT_EQ(read_scene(file("a.txt", ply_text)).point_count(), 1u);
  EXPECT_EQ(read_scene(file("a.txt", stl_text)).point_count(), 1u);
  EXPECT_EQ(read_scene(file("a.bin", binary_stl)).point_count(), 0u);
  const std::string unknown = message(file("a.dat", "glTX...."));
  for (const char* ending : {".obj", ".off", ".qoff", ".ply", ".stl"})
    EXPECT_NE(unknown.find(ending), std::string::npos) << unknown;
  EXPECT_NE(message(file("a.txt", "")).find("known format"), std::string::npos);
}

TEST_F(Read_scene, keeps_the_name_of_the_file) {
  const fs::path path = file("a.obj", obj_text + "f 7\n");
  EXPECT_EQ(read_scene(file("b.obj", obj_text)).file, (folder_ / "b.obj").string());
  try {
    (void)read_scene(path);
    ADD_FAILURE();
  } catch (const Input_error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(path.string() + ":2:3: ")) << error.what();
  }
}

TEST_F(Read_scene, hands_its_options_on) {
  EXPECT_EQ(read_scene(file("a.obj", "v 0.1 0 0"), {true}).point(0)[0], exact(0.1));
}

TEST_F(Read_scene, what_is_no_file_is_an_error) {
  EXPECT_NE(message(folder_ / "none.obj").find("no such file"), std::string::npos);
  EXPECT_NE(message(folder_).find("is a directory"), std::string::npos);
  EXPECT_NE(message("/dev/zero").find("not a file that has an end"), std::string::npos);
  EXPECT_EQ(message("/dev/null").find("not a file that has an end"), std::string::npos) << "it is empty";
}

TEST_F(Read_scene, a_file_that_may_not_be_read_is_an_error) {
  const fs::path secret = file("secret.obj", obj_text);
  fs::permissions(secret, fs::perms::none);
  if (std::ifstream(secret).good())
    GTEST_SKIP() << "this user may read everything, so an unreadable file cannot be made";
  EXPECT_NE(message(secret).find("cannot be opened: Permission denied"), std::string::npos);
}

TEST(Empty_file, is_an_error_in_every_format) {
  for (const Format format : {Format::obj, Format::off, Format::qoff, Format::ply, Format::ply_binary, Format::stl})
    for (const char* bytes : {"", " ", "\n\n\r\t \n", "\xEF\xBB\xBF", "\xEF\xBB\xBF \n"})
      expect_error_at(1, 1, "the file is empty", bytes, format);
}

TEST(Binary_garbage, is_an_error_in_every_format) {
  std::mt19937 random(7);
  for (const Format format : {Format::obj, Format::off, Format::qoff, Format::ply, Format::stl})
    for (int i = 0; i < 100; ++i) {
      std::string bytes(200, 'x');
      for (char& c : bytes) c = static_cast<char>(random());
      bytes[0] = '\x80';
      EXPECT_TRUE(error_of(bytes, format));
    }
}

}  // namespace
}  // namespace sightline::test
