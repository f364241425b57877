// Lists of numbers, one a line: what read_number_lines takes, passes over and refuses.

#include <sightline/io/number_lines.h>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace sightline::test {
namespace {

/// The lines as they were taken, "1,2;3/4"; or the error.
std::string lines_of(std::string_view text, std::size_t most = 3) {
  std::string found;
  try {
    read_number_lines({"file", text}, "one to three numbers", [&](const std::vector<Rational>& numbers) {
      if (numbers.size() > most) return false;
      if (!found.empty()) found += ';';
      for (std::size_t k = 0; k < numbers.size(); ++k) found += (k > 0 ? "," : "") + to_string(numbers[k]);
      return true;
    });
    return found;
  } catch (const Input_error& error) {
    return error.what();
  }
}
void expect_error(std::string_view text, const std::string& place, const std::string& why) {
  const std::string said = lines_of(text);
  EXPECT_TRUE(said.starts_with(place)) << said;
  EXPECT_NE(said.find(why), std::string::npos) << said;
}

TEST(Number_lines, are_exact_decimals_and_fractions) { EXPECT_EQ(lines_of("0.1,-2e-3,7\n3/6\n"), "1/10,-1/500,7;1/2"); }

TEST(Number_lines, pass_over_blanks_beside_commas_and_comments_and_empty_lines) {
  EXPECT_EQ(lines_of("# two\n\n 1 , 2,\t3  # the first\r\n\r\n4"), "1,2,3;4");
}

TEST(Number_lines, may_begin_with_names_and_only_once) {
  EXPECT_EQ(lines_of("x,y\n1,2\n"), "1,2");
  EXPECT_EQ(lines_of("# a comment\nWeight Face\n1,2\n"), "1,2");
  EXPECT_EQ(lines_of("x1,y2\n1,2\n"), "1,2");
  expect_error("O,2\n1,2\n", "file:1:1: ", "\"O\" is none");  // a letter among numbers
  expect_error("1,2\nx,y\n", "file:2:1: ", "\"x\" is none");
  expect_error("x,y\nx,y\n1,2\n", "file:2:1: ", "\"x\" is none");
  for (const char* text : {"nan,1\n", "NaN,1\n", "inf,1\n", "Infinity,1\n"})
    expect_error(text, "file:1:1: ", "is none");
  for (const char* text : {"{1,2}\n", "\xC3\xA9,1\n"}) expect_error(text, "file:1:1: ", "is none");
}

TEST(Number_lines, of_numbers_without_a_comma_between_them_are_refused) {
  expect_error("1,2\n1,2 5,3\n", "file:2:5: ", "expected a comma before \"5,3\"");
  expect_error("1 2 3\n", "file:1:3: ", "expected a comma before \"2\"");
  expect_error("1,2 ,3 4\n", "file:1:8: ", "expected a comma before \"4\"");
}

TEST(Number_lines, that_are_not_what_is_wanted_are_named_with_their_place) {
  expect_error("1\n  1,2,3,4\n", "file:2:3: ", "expected one to three numbers, found \"1,2,3,4\"");
  for (const char* text : {",1", ",", "1/0", "1/", "0x1", "1;2", "1e99999"})
    expect_error(text, "file:1:1: ", "a line wants one to three numbers");
  for (const char* text : {"1,,2", "1,", "1,x", "1,1/0,3"})
    expect_error(text, "file:1:3: ", "a line wants one to three numbers");
  expect_error("1, 2,x", "file:1:1: ", "\"x\" is none");  // where there are blanks the line is named
  expect_error("1,1e99999", "file:1:3: ", "(decimals or p/q, exponents within +-1100); \"1e99999\" is none");
}

TEST(Number_lines, of_which_there_is_none_are_an_error) {
  for (const char* text : {"", "\n\n", "# only this", "x,y,z\n"})
    expect_error(text, "file", "has no line; write one to three numbers a line");
}

TEST(Number_lines, of_the_corpus_are_taken_or_refused_at_their_place) {
  const auto said_of = [](const std::string& name) {
    std::ifstream in(std::string(SIGHTLINE_SOURCE_DIR) + "/tests/corpus/paths/" + name, std::ios::binary);
    EXPECT_TRUE(in) << name;
    return lines_of(std::string{std::istreambuf_iterator<char>(in), {}}, 8);
  };
  EXPECT_TRUE(said_of("viewpoints.csv").starts_with("1,2,3;")) << said_of("viewpoints.csv");
  EXPECT_TRUE(said_of("motion.txt").starts_with("1,0,0,0,1/2,0,0;3,0,4,0,-100,1/2,2")) << said_of("motion.txt");
  EXPECT_TRUE(said_of("weights.txt").starts_with("1/4,0,3;3/4")) << said_of("weights.txt");
  EXPECT_TRUE(said_of("comma_missing.txt").starts_with("file:1:5: ")) << said_of("comma_missing.txt");
  EXPECT_TRUE(said_of("nan_first.csv").starts_with("file:1:1: ")) << said_of("nan_first.csv");
}

}  // namespace
}  // namespace sightline::test
