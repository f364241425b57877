// Wavefront OBJ.

#include "soup_text.h"

namespace sightline::test {
namespace {

TEST(Obj, corners_may_carry_texture_and_normal) {
  EXPECT_EQ(read_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1 2 3\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 "
                      "2/1/1 3/1/1\nf 1/ 2// 3//-1\n",
                      obj),
            "0 0 0, 1 0 0, 0 1 0 | 0 1 2, 0 1 2, 0 1 2, 0 1 2, 0 1 2");
}

TEST(Obj, negative_indices_count_back_from_the_last_vertex_so_far) {
  EXPECT_EQ(read_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf -3 -2 -1\nv 3 0 0\nf -1//-1 -4/-1 +2\n", obj),
            "0 0 0, 1 0 0, 2 0 0, 3 0 0 | 0 1 2, 3 0 1");
}

TEST(Obj, a_face_may_come_before_its_vertices) {
  EXPECT_EQ(read_text("f 1 2 3\nv 0 0 0\nv 1 0 0\nf 2 3 1\nv 2 0 0\n", obj), "0 0 0, 1 0 0, 2 0 0 | 0 1 2, 1 2 0");
}

TEST(Obj, what_only_dresses_faces_is_passed_over) {
  EXPECT_EQ(
      read_text(
          "mtllib a.mtl\no x\ng a b\ns off\nusemtl m\nv 0 0 0\nvt nonsense\nvn 0 0 1\nvp 1\nl 1 1\np 1\nlod 3\nfo 1\n",
          obj),
      "0 0 0 | 0");
}

TEST(Obj, a_vertex_may_carry_weight_one_and_a_colour) {
  EXPECT_EQ(read_text("v 1 2 3 1\nv 1 2 3 1.0\nv 1 2 3 0.5 0.5 0.5\nv 1 2 3 1 0.5 0.5 0.5\n", obj),
            "1 2 3, 1 2 3, 1 2 3, 1 2 3 |");
  expect_error_at(1, 9, "weight w other than 1", "v 1 2 3 0.5\n", obj);
  expect_error_at(1, 9, "weight w other than 1", "v 1 2 3 2 0.5 0.5 0.5\n", obj);
  expect_error_at(1, 11, "5 numbers after v", "v 1 2 3 1 2\n", obj);
  expect_error_at(1, 17, "more than 7 numbers", "v 1 2 3 1 2 3 4 5\n", obj);
  expect_error_at(1, 9, "\"red\" is not a number", "v 1 2 3 red\n", obj);
}

TEST(Obj, a_backslash_joins_lines) {
  EXPECT_EQ(read_text("v 1 \\\n2 3\nv 4 5\\\r\n6\nf 1 \\ \n  2 \\\r 1\n", obj), "1 2 3, 4 5 6 | 0 1 0");
  EXPECT_EQ(read_text("v 1 2 3\ng a \\\nv 4 5 6\n", obj), "1 2 3 |");
  EXPECT_EQ(read_text("v 1 2 3\n# a \\\nv 4 5 6\n", obj), "1 2 3, 4 5 6 |");
  expect_error_at(2, 3, "\"x\" is not a number", "v 1 \\\n2 x", obj);
  expect_error_at(1, 5, "\"\\\" is not a number", "v 1 \\", obj);  // nothing to join with
}

TEST(Obj, faces_of_any_number_of_corners_are_kept) {
  EXPECT_EQ(read_text("v 0 0 0\nf\nf 1\nf 1 1\n", obj), "0 0 0 |, 0, 0 0");
  std::string text, face = "f";
  for (int i = 1; i <= 20000; ++i) {
    text += "v " + std::to_string(i) + " 0.5 0\n";
    face += " " + std::to_string(i);
  }
  const Polygon_soup soup = read_scene(text + face, obj, "scene");
  ASSERT_EQ(soup.face_count(), 1u);
  EXPECT_EQ(soup.loop(0).size(), 20000u);
  EXPECT_EQ(soup.loop(0)[19999], 19999u);
}

TEST(Obj, an_index_out_of_range_is_an_error) {
  expect_error_at(2, 5, "vertex index \"0\" is out of range; there are 1 vertices", "v 0 0 0\nf 1 0 1\n", obj);
  expect_error_at(2, 5, "\"-0\" is out of range", "v 0 0 0\nf 1 -0 1\n", obj);
  expect_error_at(2, 5, "\"-2\" is out of range; there are 1 vertices so far", "v 0 0 0\nf 1 -2 1\nv 0 0 0", obj);
  expect_error_at(2, 7, "\"2/1\" is out of range", "v 0 0 0\nf 1 1 2/1\n", obj);
  expect_error_at(2, 3, "out of range", "v 0 0 0\nf 99999999999999999999999 1 1\n", obj);
  expect_error_at(2, 3, "out of range", "v 0 0 0\nf 4294967297 1 1\n", obj);  // 1 + 2^32
}

TEST(Obj, of_several_indices_out_of_range_the_first_is_reported) {
  expect_error_at(1, 5, "\"3\" is out of range; there are 2 vertices", "f 2 3 4 3\nf 9\nv 0 0 0\nv 0 0 0\n", obj);
  expect_error_at(2, 3, "\"5\" is out of range", "f 3 3\nf 5 4\nv 0 0 0\nv 0 0 0\nv 0 0 0\n", obj);
}

TEST(Obj, a_corner_that_is_none_is_an_error) {
  for (const char* corner : {"x", "1.5", "1/x", "1/1/x", "1/1/1/1", "/1", "//1", "1e0", "nan"})
    expect_error_at(2, 5, "is not a corner of a face", "v 0 0 0\nf 1 " + std::string(corner) + " 1\n", obj);
}

TEST(Obj, a_coordinate_that_is_none_is_an_error) {
  expect_error_at(1, 5, "\"nan\" is not a finite number", "v 0 nan 0\n", obj);
  expect_error_at(1, 7, "\"-inf\" is not a finite number", "v 0 0 -inf\n", obj);
  expect_error_at(1, 3, "\"0x1p3\" is a hexadecimal number", "v 0x1p3 0 0\n", obj);
  expect_error_at(1, 3, "exponent out of range", "v 1e1101 0 0\n", obj);
  expect_error_at(1, 6, "a coordinate is missing", "v 1 2", obj);
}

TEST(Obj, a_statement_that_is_unknown_is_an_error) {
  expect_error_at(2, 1, "unknown statement \"vertex\"", "v 0 0 0\nvertex 0 0 0\n", obj);
  expect_error_at(1, 1, "unknown statement \"\\x00\\x01\\xFF\"", std::string_view("\0\1\xFF\n\n", 5), obj);
  expect_error_at(2, 2, "free-form curves and surfaces (\"surf\") are not supported", "v 0 0 0\n surf 0 1 0 1 1\n",
                  obj);
}

}  // namespace
}  // namespace sightline::test
