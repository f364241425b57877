// Lines, tokens and places in text.

#include "soup_text.h"

#include <sightline/io/text.h>

namespace sightline::test {
namespace {

TEST(Text, line_ends_blanks_comments_and_byte_order_mark_are_all_welcome) {
  const std::string expected = "1 2 3, 4 5 6 | 0 1 0";
  for (const char* text :
       {"v 1 2 3\nv 4 5 6\nf 1 2 1\n", "v 1 2 3\nv 4 5 6\nf 1 2 1", "v 1 2 3\r\nv 4 5 6\r\nf 1 2 1\r\n",
        "v 1 2 3\rv 4 5 6\rf 1 2 1\r", "v 1 2 3\r\n\n\r\rv 4 5 6\nf 1 2 1",
        "\tv\t1 \t2\v3\f \n  v 4 5 6\t\t\nf 1 2 1 \t", "\xEF\xBB\xBFv 1 2 3\nv 4 5 6\nf 1 2 1",
        "# v 9 9 9\nv 1 2 3 # v 8 8 8\n  #\nv 4 5 6 #\nf 1 2 1 # \\\n"})
    EXPECT_EQ(read_text(text, Format::obj), expected) << printable(text, 100, true);
}

TEST(Text, lines_are_counted_the_same_for_every_line_end) {
  expect_error_at(3, 3, "\"x\" is not a number", "v 1 2 3\n\nv x", Format::obj);
  expect_error_at(3, 3, "\"x\" is not a number", "v 1 2 3\r\n\r\nv x", Format::obj);
  expect_error_at(3, 3, "\"x\" is not a number", "v 1 2 3\r\rv x", Format::obj);
  expect_error_at(5, 3, "\"x\" is not a number", "v 1 2 3\n\r\r\n\nv x", Format::obj);
}

TEST(Text, columns_count_bytes_from_one_and_leave_the_byte_order_mark_out) {
  expect_error_at(1, 3, "\"x\"", "v x", Format::obj);
  expect_error_at(1, 4, "\"x\"", "\tv x", Format::obj);
  expect_error_at(1, 3, "\"x\"", "\xEF\xBB\xBFv x", Format::obj);
  expect_error_at(2, 3, "\"x\"", "\xEF\xBB\xBFo \xC3\xA9\nv x", Format::obj);
}

TEST(Text, a_missing_token_is_reported_behind_the_last_one) {
  expect_error_at(2, 6, "a coordinate is missing", "v 1 2 3\nv 1 2", Format::obj);
  expect_error_at(2, 6, "a coordinate is missing", "v 1 2 3\nv 1 2   \nv 1 2 3\n", Format::obj);
  expect_error_at(2, 2, "a coordinate is missing", "v 1 2 3\nv # 1 2 3\n", Format::obj);
}

TEST(Text, a_hash_within_a_token_begins_no_comment) {
  expect_error_at(1, 7, "\"1.#INF\" is not a finite number", "v 1 2 1.#INF", Format::obj);
}

TEST(Text, messages_stay_on_one_line_and_short_whatever_the_file_holds) {
  expect_error_at(1, 3, "\"\\x01\\x7F\\xFF\" is not a number", "v \x01\x7F\xFF 0 0", Format::obj);
  const std::optional<Input_error> error = error_of("v " + std::string(100000, 'x') + " 0 0", Format::obj);
  ASSERT_TRUE(error);
  EXPECT_LT(std::string(error->what()).size(), 200u);
  try {
    (void)read_scene("x", Format::obj, "two\nlines");
    ADD_FAILURE();
  } catch (const Input_error& named) {
    EXPECT_TRUE(std::string(named.what()).starts_with("two\\x0Alines:1:1: ")) << named.what();
    EXPECT_EQ(named.file, "two\nlines");
  }
}

TEST(Text, integers_are_held_at_ten_to_the_eighteen) {
  EXPECT_EQ(parse_integer("999999999999999999"), 999999999999999999);
  EXPECT_EQ(parse_integer("1000000000000000000"), 1000000000000000000);
  EXPECT_EQ(parse_integer("-99999999999999999999999999999999"), -1000000000000000000);
  EXPECT_EQ(parse_integer("+7"), 7);
  for (const char* token : {"", "-", "+", "--1", "1.", "1 ", "x", "1e3"}) EXPECT_FALSE(parse_integer(token)) << token;
}

}  // namespace
}  // namespace sightline::test
