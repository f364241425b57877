// What was read, in messages of one line.

#include <sightline/kernel/quoted.h>

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace {

using sightline::printable;
/// Not std::quoted(), which strings find by themselves.
std::string shown(std::string_view token) { return sightline::quoted(token); }

TEST(Quoted, is_what_was_read_on_one_line) {
  EXPECT_EQ(shown("1e5x"), "\"1e5x\"");
  EXPECT_EQ(shown(""), "\"\"");
  EXPECT_EQ(shown("a\nb\x7f"), "\"a\\x0Ab\\x7F\"");
  EXPECT_EQ(shown("\xc3\xa9~ "), "\"\\xC3\\xA9~ \"") << "bytes above 127, and none of 32 to 126";
  EXPECT_EQ(printable("\xc3\xa9\x1f", 40, false), "\xc3\xa9\\x1F");
}

TEST(Quoted, is_cut_off_where_it_is_longer_than_that) {
  const std::string forty(40, 'x');
  EXPECT_EQ(shown(forty), '"' + forty + '"');
  EXPECT_EQ(shown(forty + 'y'), '"' + forty + "...\"");
  EXPECT_EQ(printable("abc", 2, true), "ab...");
  EXPECT_EQ(printable("abc", 3, true), "abc");
}

}  // namespace
