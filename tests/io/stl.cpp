// STL, text and binary.

#include "soup_text.h"

#include <sightline/io/binary.h>
#include <sightline/kernel/time_limit.h>

namespace sightline::test {
namespace {

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 1\n outer loop\n  vertex " + a + "\n  vertex " + b + "\n  vertex " + c +
         "\n endloop\nendfacet\n";
}
std::string binary(const std::string& beginning, const std::vector<std::array<float, 9>>& facets) {
  std::string bytes = beginning;
  bytes.resize(80, ' ');
  store(bytes, static_cast<std::uint32_t>(facets.size()));
  for (const std::array<float, 9>& facet : facets) {
    for (int i = 0; i < 3; ++i) store(bytes, std::nanf(""));  // the normal is of no interest
    for (const float value : facet) store(bytes, value);
    bytes += "\xFF\xFF";
  }
  return bytes;
}

TEST(Stl, text_merges_points_by_exact_value) {
  EXPECT_EQ(read_text("solid a name # of words\n" + facet("0 0 0", "1 0 0", "0 1.50 0") +
                          facet("0.15e1 0 0", "1.0 -0 0", "-0.0 15e-1 0") + "endsolid a name\n",
                      stl),
            "0 0 0, 1 0 0, 0 3/2 0, 3/2 0 0 | 0 1 2, 3 1 2");
}

TEST(Stl, text_keeps_points_apart_that_are_one_double) {
  const std::string a = "0.1 0 0", b = "0.1000000000000000000000001 0 0", c = "0.10000000000000000000000010 0 0";
  EXPECT_EQ(read_scene("solid\n" + facet(a, b, c) + "endsolid", stl, "scene").point_count(), 2u);
  EXPECT_EQ(read_scene("solid\n" + facet(a, b, c) + "endsolid", stl, "scene", {true}).point_count(), 1u);
}

TEST(Stl, text_may_hold_several_solids_and_capitals) {
  EXPECT_EQ(read_text("SOLID\nEndSolid\nsolid b\n" + facet("0 0 0", "1 0 0", "0 1 0") + "endsolid\nsolid\n" +
                          facet("0 0 0", "0 1 0", "1 0 0") + "endsolid c",
                      stl),
            "0 0 0, 1 0 0, 0 1 0 | 0 1 2, 0 2 1");
  EXPECT_EQ(
      read_text("solid\nFACET NORMAL nan -nan 0 OUTER LOOP VERTEX 1 0 0\nVertex 2 0 0 ENDLOOP ENDFACET\nendsolid\n",
                stl),
      "1 0 0, 2 0 0 | 0 1");
  for (const std::string wrong : {"FACTS", "FACEU", "GACET", "fACEt0"})
    EXPECT_TRUE(error_of("solid\n" + wrong +
                             " normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                             "endloop\nendfacet\nendsolid\n",
                         stl))
        << wrong;
}

TEST(Stl, text_with_a_facet_on_the_line_of_a_name_is_an_error) {
  const std::string facet =
      "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\nendsolid\n";
  expect_error_at(1, 9, "a facet on the line of a name; break the line", "solid s " + facet, Format::stl);
  EXPECT_EQ(read_scene("solid a facet of many\n" + facet, Format::stl, "scene").face_count(), 1u);
}

TEST(Stl, points_whose_hashes_were_made_to_agree_take_no_longer) {
  // Multiples of 2^64, whose last 64 bits are 0, and of 2^64 + 1.
  const auto seconds = [](const Integer& step) {
    std::string text = "solid\n";
    for (int k = 1; k <= 10000; ++k) {
      const std::string x = to_string(Integer(k * step));
      text += "facet normal 0 0 0 outer loop vertex " + x + " 0 0 vertex " + x + " 0 1 vertex " + x +
              " 1 0 endloop endfacet\n";
    }
    text += "endsolid\n";
    const double begin = processor_seconds();
    EXPECT_EQ(read_scene(text, Format::stl, "scene").point_count(), 30000u);
    return processor_seconds() - begin;
  };
  const Integer power = Integer(1) << 64;
  const double other = seconds(power + 1);
  EXPECT_LT(seconds(power), 3 * other + 0.2);
}

TEST(Stl, text_that_is_cut_off_is_an_error_at_its_end) {
  const std::string text = "solid\n" + facet("0 0 0", "1 0 0", "0 1 0") + "endsolid";
  for (std::size_t size = 6; size < text.size(); ++size) {
    SCOPED_TRACE(size);
    const std::optional<Input_error> error = error_of(std::string_view(text).substr(0, size), stl);
    ASSERT_TRUE(error);
    EXPECT_NE(error->line, 0u);
  }
  expect_error_at(2, 1, "the file ends where facet should follow", "solid\n", stl);
  expect_error_at(4, 14, "the file ends where a coordinate should follow",
                  "solid\nfacet normal 0 0 1\nouter loop\nvertex 0.5 1 ", stl);
}

TEST(Stl, a_word_out_of_place_is_an_error) {
  expect_error_at(2, 1, "unexpected \"vertex\"; write facet or endsolid", "solid\nvertex 0 0 0\n", stl);
  expect_error_at(2, 7, "unexpected \"0\"; write normal", "solid\nfacet 0 0 1\n", stl);
  expect_error_at(2, 14, "\"outer\" is not a number", "solid\nfacet normal outer loop\n", stl);
  expect_error_at(3, 7, "unexpected \"vertex\"; write loop", "solid\nfacet normal 0 0 1\nouter vertex\n", stl);
  expect_error_at(4, 1, "unexpected \"endfacet\"; write vertex or endloop",
                  "solid\nfacet normal 0 0 1\nouter loop\nendfacet\n", stl);
  expect_error_at(5, 1, "unexpected \"facet\"; write endfacet",
                  "solid\nfacet normal 0 0 1\nouter loop\nendloop\nfacet\n", stl);
  expect_error_at(2, 1, "unexpected \"#\"; write facet or endsolid", "solid\n# no comments here\nendsolid\n", stl);
  expect_error_at(3, 1, "unexpected \"facet\"; write solid", "solid\nendsolid\nfacet\n", stl);
}

TEST(Stl, a_coordinate_in_text_that_is_none_is_an_error) {
  expect_error_at(5, 12, "\"nan\" is not a finite number", "solid\n" + facet("0 0 0", "0 nan 0", "0 0 0"), stl);
  expect_error_at(5, 14, "\"inf\" is not a finite number", "solid\n" + facet("0 0 0", "0 0 inf", "0 0 0"), stl);
}

TEST(Stl, binary_merges_points_by_exact_value) {
  EXPECT_EQ(
      read_text(binary("made by hand", {{0, 0, 0, 1, 0, 0, 0, 0.5f, 0}, {-0.0f, 0, 0, 0, 0.5f, -0.0f, 1, 0, 1}}), stl),
      "0 0 0, 1 0 0, 0 1/2 0, 1 0 1 | 0 1 2, 0 2 3");
  EXPECT_EQ(read_text(binary("none", {}), stl), " |");
  const Polygon_soup soup = read_scene(binary("", {{1e-45f, 3e38f, 0.1f, 0, 0, 0, 0, 0, 1e-45f}}), stl, "scene");
  EXPECT_EQ(soup.point(0), (Exact_point{exact(std::ldexp(1.0, -149)), exact(double{3e38f}), exact(double{0.1f})}));
  EXPECT_EQ(soup.point_count(), 3u);
}

TEST(Stl, binary_that_begins_with_solid_is_told_by_its_size) {
  EXPECT_EQ(read_text(binary("solid of facets", {{0, 0, 0, 1, 0, 0, 0, 1, 0}}), stl), "0 0 0, 1 0 0, 0 1 0 | 0 1 2");
}

TEST(Stl, binary_that_is_cut_off_or_too_long_is_an_error) {
  const std::string bytes = binary("solid of facets", {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0, 1, 0, 0, 0, 1, 0}});
  expect_error_at_byte(bytes.size() - 1, "2 facets are announced, but the file ends after 1",
                       bytes.substr(0, bytes.size() - 1), stl);
  expect_error_at_byte(84, "2 facets are announced, but the file ends after 0", bytes.substr(0, 84), stl);
  expect_error_at_byte(184, "the file goes on after the 2 facets", bytes + "x", stl);
  expect_error_at_byte(70, "the file ends within the header", "made by hand" + std::string(58, ' '), stl);
  std::string absurd = binary("absurd", {});
  absurd.replace(80, 4, "\xFF\xFF\xFF\xFF");
  expect_error_at_byte(84, "4294967295 facets are announced", absurd, stl);
}

TEST(Stl, binary_coordinates_must_be_finite) {
  for (const float bad : {std::nanf(""), HUGE_VALF, -HUGE_VALF})
    expect_error_at_byte(84 + 50 + 12 + 20, "a coordinate is not a finite number",
                         binary("", {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0, 1, 0, bad, 0, 1, 0}}), stl);
}

}  // namespace
}  // namespace sightline::test
