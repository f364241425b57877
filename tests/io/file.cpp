// Files as bytes: whole or not at all, behind links, and what the system says of them.

#include <sightline/io/file.h>
#include <sightline/io/input.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <ostream>
#include <random>
#include <stdexcept>

namespace sightline {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path path(const std::string& name) const { return folder_ / name; }
  /// How many files are in the folder, whatever their names.
  std::ptrdiff_t count() const { return std::distance(fs::directory_iterator(folder_), {}); }
  static void expect_refused(const fs::path& path, const std::string& why) {
    try {
      write_bytes(path, "new");
      ADD_FAILURE() << path << " was written";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), path.string() + ": cannot be written: " + why);
    }
  }

 private:
  const fs::path folder_ = fs::path(testing::TempDir()) / ("sightline_files_" + std::to_string(std::random_device()()));
};

TEST_F(Files, are_written_whole_and_leave_nothing_beside_them) {
  const std::string bytes("a\0b\n\xff", 5);
  for (const std::string& text : {bytes, std::string(), std::string(3'000'000, 'x')}) {
    write_bytes(path("a"), text);
    EXPECT_EQ(read_bytes(path("a")), text);
    EXPECT_EQ(count(), 1);
  }
  EXPECT_EQ(unfinished_file(), nullptr);
}

TEST_F(Files, beside_which_something_stands_are_written_all_the_same) {
  write_bytes(path("a.partial"), "mine");
  write_bytes(path("a.partial1"), "mine too");
  write_bytes(path("a"), "new");
  EXPECT_EQ(read_bytes(path("a")), "new");
  EXPECT_EQ(read_bytes(path("a.partial")), "mine");
  EXPECT_EQ(read_bytes(path("a.partial1")), "mine too");
  EXPECT_EQ(count(), 3);
}

TEST_F(Files, with_the_longest_names_are_written_too) {
  const std::string longest(255, 'n');
  write_bytes(path(longest), "old");
  write_bytes(path(longest), "new");
  EXPECT_EQ(read_bytes(path(longest)), "new");
  EXPECT_EQ(count(), 1);
  expect_refused(path(longest + 'n'), "File name too long");
}

TEST_F(Files, written_as_streams_are_whole_or_not_there) {
  const std::string line = "0123456789\n";
  write_stream(path("a"), [&](std::ostream& out) {
    for (int k = 0; k < 100'000; ++k) out << line;
    EXPECT_NE(unfinished_file(), nullptr);
  });
  EXPECT_EQ(read_bytes(path("a")).size(), 1'100'000u);
  const auto half = [&](std::ostream& out) {
    out << std::string(200'000, 'y');
    throw std::domain_error("given up");
  };
  EXPECT_THROW(write_stream(path("a"), half), std::domain_error);
  EXPECT_THROW(write_stream(path("b"), half), std::domain_error);
  EXPECT_EQ(read_bytes(path("a")).substr(0, 11), line);
  EXPECT_EQ(count(), 1);
  EXPECT_EQ(unfinished_file(), nullptr);
  // What cannot be written is not made to its end.
  std::size_t made = 0;
  const auto endless = [&](std::ostream& out) {
    for (;; ++made) out << line;
  };
  EXPECT_THROW(write_stream("/dev/full", endless), std::runtime_error);
  EXPECT_LT(made, 100'000u);
}

TEST_F(Files, are_opened_as_streams_or_refused) {
  const std::string bytes("a\0b\n\xff", 5);
  write_bytes(path("a"), bytes);
  std::ifstream in = open_bytes(path("a"));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), bytes);
  for (const char* name : {"", "none"}) EXPECT_THROW(open_bytes(path(name)), Input_error) << name;
  EXPECT_THROW(open_bytes("/dev/zero"), Input_error);
}

TEST_F(Files, keep_their_permissions) {
  const auto own = fs::perms::owner_read | fs::perms::owner_write;
  write_bytes(path("a"), "old");
  fs::permissions(path("a"), own);
  write_bytes(path("a"), "new");
  EXPECT_EQ(fs::status(path("a")).permissions(), own);
  // Where there was none, those of any new file.
  write_bytes(path("b"), "new");
  std::ofstream(path("c")) << "new";
  EXPECT_EQ(fs::status(path("b")).permissions(), fs::status(path("c")).permissions());
}

TEST_F(Files, that_are_locked_are_not_replaced) {
  if (geteuid() == 0) GTEST_SKIP() << "root writes everything";
  write_bytes(path("a"), "old");
  fs::permissions(path("a"), fs::perms::owner_read);
  expect_refused(path("a"), "Permission denied");
  EXPECT_EQ(read_bytes(path("a")), "old");
}

TEST_F(Files, behind_links_are_written_and_links_stay) {
  fs::create_directories(path("in"));
  write_bytes(path("in/a"), "old");
  fs::create_symlink("in/a", path("one"));
  fs::create_symlink("one", path("two"));
  fs::create_symlink("in/not_yet", path("ahead"));
  write_bytes(path("two"), "new");
  write_bytes(path("ahead"), "first");
  EXPECT_TRUE(fs::is_symlink(path("one")) && fs::is_symlink(path("two")) && fs::is_symlink(path("ahead")));
  EXPECT_EQ(read_bytes(path("in/a")), "new");
  EXPECT_EQ(read_bytes(path("in/not_yet")), "first");
  EXPECT_EQ(behind_links(path("two")), path("in/a"));
}

TEST(Signals, are_put_off_only_while_a_file_is_made) { EXPECT_FALSE(put_off(SIGTERM)); }

TEST_F(Files, that_cannot_be_written_are_refused_with_what_the_system_says) {
  fs::create_symlink("b", path("a"));
  fs::create_symlink("a", path("b"));
  expect_refused(path("a"), "Too many levels of symbolic links");
  EXPECT_THROW(behind_links(path("a")), fs::filesystem_error);
  expect_refused(path("none/a"), "No such file or directory");
  expect_refused(path(""), "Is a directory");
  if (fs::exists("/dev/full")) expect_refused("/dev/full", "No space left on device");
  EXPECT_EQ(count(), 2) << "nothing is left beside them";
}

}  // namespace sightline
