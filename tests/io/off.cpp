// OFF, and OFF with rational coordinates.

#include "soup_text.h"

namespace sightline::test {
namespace {

constexpr Format qoff = Format::qoff;

TEST(Off, header_and_counts_stand_on_one_line_or_two_or_the_header_is_missing) {
  for (const char* text :
       {"OFF\n1 1 0\n0 0.5 0\n3 0 0 0\n", "OFF 1 1 0\n0 0.5 0\n3 0 0 0\n", "1 1 0\n0 0.5 0\n3 0 0 0\n",
        "OFF\n1 1\n0 0.5 0\n3 0 0 0", "# c\nOFF # c\n# c\n1 1 0 # c\n\n0 0.5 0 # c\n\n3 0 0 0 # c\n#",
        "\xEF\xBB\xBFOFF\r\n1 1 0\r\n0 0.5 0\r\n3 0 0 0\r\n"})
    EXPECT_EQ(read_text(text, off), "0 1/2 0 | 0 0 0") << text;
  EXPECT_EQ(read_text("OFF 0 0 0", off), " |");
}

TEST(Off, colours_normals_and_texture_coordinates_are_passed_over) {
  EXPECT_EQ(read_text("COFF\n1 1 0\n0 0 0 255 0 0 255\n3 0 0 0 0.1 0.2 0.3 1\n", off), "0 0 0 | 0 0 0");
  EXPECT_EQ(read_text("NOFF\n1 1 0\n0 0 0 nan 0 -1\n3 0 0 0 7\n", off), "0 0 0 | 0 0 0");
  EXPECT_EQ(read_text("STOFF\n1 0 0\n0 0 0 0.5 0.5\n", off), "0 0 0 |");
  EXPECT_EQ(read_text("STCNOFF 1 0 0\n0 0 0 0 0 1 1 1 1 1 0.5 0.5\n", off), "0 0 0 |");
  EXPECT_EQ(read_text("OFF 1 0 0\n0 0 0 255 0 0 1\n", off), "0 0 0 |");  // it says it has none
  expect_error_at(2, 15, "unexpected \"5\"", "OFF 1 0 0\n0 0 0 1 2 3 4 5\n", off);
  expect_error_at(2, 25, "unexpected \"10\"", "COFF 1 0 0\n0 0 0 1 2 3 4 5 6 7 8 9 10\n", off);
  expect_error_at(2, 7, "\"red\" is not a number", "OFF 1 0 0\n0 0 0 red\n", off);
  expect_error_at(3, 17, "unexpected \"5\"", "OFF 1 1 0\n0 0 0\n3 0 0 0 1 2 3 4 5\n", off);
}

TEST(Off, other_kinds_of_off_are_refused_with_a_reason) {
  expect_error_at(1, 5, "binary OFF is not supported", "OFF BINARY\n1 1 0\n", off);
  expect_error_at(1, 1, "\"4OFF\" are not of three dimensions", "4OFF\n1 1 0\n0 0 0 0\n", off);
  expect_error_at(1, 1, "\"nOFF\" are not of three dimensions", "nOFF\n5\n1 1 0\n", off);
  expect_error_at(1, 1, "\"C4nOFF\" are not of three dimensions", "C4nOFF\n5\n1 1 0\n", off);
  expect_error_at(1, 1, "unknown header \"OFF490\"", "OFF490 518 0\n", off);
  expect_error_at(1, 1, "unknown header \"XOFF\"", "XOFF\n1 1 0\n", off);
  expect_error_at(1, 1, "unknown header \"v\"", "v 0 0 0\n", off);
}

TEST(Off, counts_that_are_missing_or_none_are_an_error) {
  expect_error_at(2, 1, "the counts are missing", "OFF\n", off);
  expect_error_at(3, 1, "no header", "# only\n# comments\n", off);
  expect_error_at(2, 2, "the number of faces is missing", "OFF\n1\n1\n0\n0 0 0\n1 0\n", off);
  expect_error_at(2, 1, "\"-8\" is not a number of vertices", "OFF\n-8 6 0\n", off);
  expect_error_at(2, 3, "\"6.0\" is not a number of faces", "OFF\n0 6.0 0\n", off);
  expect_error_at(2, 5, "\"x\" is not a number of edges", "OFF\n0 0 x\n", off);
  expect_error_at(2, 7, "unexpected \"0\"", "OFF\n0 0 0 0\n", off);
}

TEST(Off, counts_larger_than_the_file_are_an_error_before_any_memory_is_taken) {
  expect_error_at(2, 1, "1000000000 vertices are announced, but only 16 bytes follow",
                  "OFF\n1000000000 6 0\n0 0 0\n0 0 0", off);
  expect_error_at(2, 3, "1000000000 faces are announced", "OFF\n1 1000000000 0\n0 0 0\n", off);
  expect_error_at(2, 1, "1000000000000000000 vertices", "OFF\n99999999999999999999999999 6 0\n0 0 0\n", off);
  expect_error_at(4, 1, "4000000000 corners are announced", "OFF\n1 1 0\n0 0 0\n4000000000 0 0\n", off);
  EXPECT_EQ(read_text("OFF\n1 0 0\n0 0 0", off), "0 0 0 |");  // exactly as many bytes as need be
  EXPECT_EQ(read_text("OFF\n1 1 0\n0 0 0\n1 0", off), "0 0 0 | 0");
}

TEST(Off, a_file_that_is_cut_off_is_an_error_at_its_end) {
  expect_error_at(4, 1, "the file ends after 1 of 2 vertices", "OFF\n2 1 000000000000\n0 0 0\n", off);
  expect_error_at(3, 6, "the file ends after 1 of 2 faces", "OFF\n0 2 0 # as many bytes as are needed\n0 # c", off);
  expect_error_at(3, 4, "a coordinate is missing", "OFF\n2 0 0 # as many bytes as are needed\n0 0", off);
  expect_error_at(4, 4, "corner 2 of 3 is missing", "OFF\n1 1 0\n0 0 0\n3 0\n\n\n\n\n\n", off);
}

TEST(Off, more_lines_than_announced_are_an_error) {
  expect_error_at(4, 1, "more lines than the 1 vertices and 0 faces", "OFF\n1 0 0\n0 0 0\n3 0 0 0\n", off);
  expect_error_at(4, 1, "more lines than the 0 vertices and 1 faces", "OFF\n0 1 0\n0\n0\n", qoff);
}

TEST(Off, faces_of_any_number_of_corners_are_kept) {
  EXPECT_EQ(read_text("OFF 2 4 0\n0 0 0\n1 0 0\n0\n1 1\n2 1 0\n5 0 1 0 1 0\n", off),
            "0 0 0, 1 0 0 |, 1, 1 0, 0 1 0 1 0");
}

TEST(Off, an_index_out_of_range_is_an_error) {
  expect_error_at(3, 5, "vertex index \"1\" is out of range; there are 1 vertices", "OFF 1 1 0\n0 0 0\n3 0 1 0\n", off);
  expect_error_at(3, 5, "\"-1\" is out of range", "OFF 1 1 0\n0 0 0\n3 0 -1 0\n", off);
  expect_error_at(3, 5, "\"-0\" is out of range", "OFF 1 1 0\n0 0 0\n3 0 -0 0\n", off);
  expect_error_at(3, 5, "\"4294967296\" is out of range", "OFF 1 1 0\n0 0 0\n3 0 4294967296 0\n", off);
  expect_error_at(3, 5, "\"x\" is not a vertex index", "OFF 1 1 0\n0 0 0\n3 0 x 0\n", off);
  expect_error_at(3, 1, "\"-3\" is not a number of corners", "OFF 1 1 0\n0 0 0\n-3 0 0 0\n", off);
}

TEST(Off, a_coordinate_that_is_none_is_an_error) {
  expect_error_at(2, 3, "\"nan\" is not a finite number", "OFF 1 0 0\n0 nan 0\n", off);
  expect_error_at(2, 5, "\"Infinity\" is not a finite number", "OFF 1 0 0\n0 0 Infinity\n", off);
  expect_error_at(2, 3, "\"1/2\" is not a decimal; coordinates p/q belong into a .qoff file", "OFF 1 0 0\n0 1/2 0\n",
                  off);
  expect_error_at(2, 3, "\"1.5\" is not a number p or p/q", "OFF 1 0 0\n0 1.5 0\n", qoff);
  expect_error_at(2, 3, "\"1/0\" has the denominator 0", "OFF 1 0 0\n0 1/0 0\n", qoff);
}

TEST(Qoff, coordinates_are_integers_or_fractions) {
  EXPECT_EQ(
      read_text("OFF\n2 1 0\n1/3 -22/7 4/2\n-12345678901234567890123 1/12345678901234567890123 0/9\n3 0 1 0\n", qoff),
      "1/3 -22/7 2, -12345678901234567890123 1/12345678901234567890123 0 | 0 1 0");
}

/// The soup of the points (1/d, 0, 0).
std::string reciprocals(const std::vector<Integer>& denominators) {
  std::string text = "OFF\n" + std::to_string(denominators.size()) + " 0 0\n";
  for (const Integer& d : denominators) text += "1/" + to_string(d) + " 0 0\n";
  return text;
}
Integer power(unsigned long base, unsigned long exponent) {
  Integer result;
  mpz_ui_pow_ui(result.get_mpz_t(), base, exponent);
  return result;
}

TEST(Qoff, a_common_denominator_of_8192_bits_is_read_and_no_more) {
  const std::string too_long = "common denominator of the coordinates needs more than 8192 bits";
  const Polygon_soup soup = read_scene(reciprocals({power(2, 8191)}), qoff, "scene");
  EXPECT_EQ(bit_length(soup.coordinates.common_denominator()), 8192u);
  expect_error_at(3, 1, too_long, reciprocals({power(2, 8192)}), qoff);
  // Two of them: 2^a 3^b, just within and just beyond. 3^2584 has 4096 bits, and is more than 2^4095.4.
  EXPECT_EQ(bit_length(power(3, 2584)), 4096u);
  EXPECT_NO_THROW(read_scene(
      reciprocals({power(2, 4096), power(3, 2584), power(2, 4095), power(3, 2583), power(2, 4096)}), qoff, "scene"));
  expect_error_at(4, 1, too_long, reciprocals({power(2, 4097), power(3, 2584)}), qoff);
}

TEST(Qoff, many_denominators_are_refused_as_soon_as_they_are_too_many) {
  std::vector<Integer> odd;
  for (unsigned long d = 3; d < 200000; d += 2) odd.emplace_back(d);
  const std::optional<Input_error> error = error_of(reciprocals(odd), qoff);
  ASSERT_TRUE(error);
  EXPECT_NE(std::string(error->what()).find("common denominator"), std::string::npos);
  EXPECT_LT(error->line, 4000u);
  EXPECT_NO_THROW(read_scene(reciprocals(odd), qoff, "scene", {true}));  // rounded to doubles they share a power of two
}

TEST(Qoff, a_denominator_that_comes_again_costs_nothing_and_changes_nothing) {
  std::vector<Integer> mixed;
  for (int i = 0; i < 1000; ++i) mixed.insert(mixed.end(), {3, 7, 21, power(7, 40), 1});
  EXPECT_EQ(read_scene(reciprocals(mixed), qoff, "scene").coordinates.common_denominator(), 3 * power(7, 40));
}

}  // namespace
}  // namespace sightline::test
