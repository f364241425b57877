// PLY, text and binary of both byte orders.

#include "soup_text.h"

#include <sightline/io/binary.h>

namespace sightline::test {
namespace {

const std::string vertex_lines = "property float x\nproperty float y\nproperty float z\n";
const std::string face_line = "property list uchar int vertex_indices\n";

/// A header of points (lines 3 to 6) and faces (lines 7 and 8); data begin in line 10.
std::string header(const std::string& encoding, const std::string& point_count, const std::string& face_count) {
  return "ply\nformat " + encoding + " 1.0\nelement vertex " + point_count + "\n" + vertex_lines + "element face " +
         face_count + "\n" + face_line + "end_header\n";
}
template <class Value>
std::string bytes_of_value(Value value, bool big) {
  std::string bytes;
  store(bytes, value);
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

TEST(Ply, text_holds_exact_decimals) {
  EXPECT_EQ(read_text(header("ascii", "2", "1") + "0.1 0 0\n-1 2 3e-1\n3 0 1 0\n", ply), "1/10 0 0, -1 2 3/10 | 0 1 0");
}

TEST(Ply, other_elements_and_properties_are_passed_over) {
  EXPECT_EQ(read_text("ply\r\nformat ascii 1.0\r\ncomment element vertex 9\r\nobj_info x\r\nelement material "
                      "1\r\nproperty list uchar float rgb\r\nproperty uchar k\r\n"
                      "element face 1\r\nproperty uchar red\r\nproperty list uint8 int32 vertex_index\r\nproperty list "
                      "uchar float texcoord\r\n"
                      "element empty 0\r\nelement vertex 2\r\nproperty double nx\r\nproperty double z\r\nproperty "
                      "float64 y\r\nproperty double x\r\n"
                      "element edge 1\r\nproperty int vertex1\r\nproperty int vertex2\r\nend_header\r\n"
                      "3 0.1 0.2 0.3 7\r\n255 3 0 1 1 2 0.5 0.5\r\nnan 3 2 1\r\n0 6 5 4\r\n0 1\r\n",
                      ply),
            "1 2 3, 4 5 6 | 0 1 1");
}

TEST(Ply, faces_of_any_number_of_corners_are_kept) {
  EXPECT_EQ(read_text(header("ascii", "1", "4") + "0 0 0\n0\n1 0\n2 0 0\n4 0 0 0 0", ply), "0 0 0 |, 0, 0 0, 0 0 0 0");
}

TEST(Ply, no_faces_is_a_scene_too) {
  EXPECT_EQ(read_text("ply\nformat ascii 1.0\nelement vertex 1\n" + vertex_lines + "end_header\n1 2 3\n", ply),
            "1 2 3 |");
}

TEST(Ply, binary_holds_floats_as_they_are_in_either_byte_order) {
  for (const bool big : {false, true}) {
    const std::string encoding = big ? "binary_big_endian" : "binary_little_endian";
    std::string bytes = header(encoding, "2", "2");
    for (const float value : {0.1f, -2.0f, 1e-45f, -0.0f, 0.5f, 3e38f}) bytes += bytes_of_value(value, big);
    bytes += '\3';
    for (const int corner : {0, 1, 0}) bytes += bytes_of_value(corner, big);
    bytes += '\0';
    const Polygon_soup soup = read_scene(bytes, ply, "scene");
    EXPECT_EQ(soup.point(0), (Exact_point{exact(double{0.1f}), -2, exact(std::ldexp(1.0, -149))}));
    EXPECT_EQ(soup.point(1), (Exact_point{0, Rational(1, 2), exact(double{3e38f})}));
    EXPECT_EQ(text_of(soup).substr(text_of(soup).find('|')), "| 0 1 0,");
  }
}

TEST(Ply, binary_reads_every_scalar_type) {
  for (const bool big : {false, true}) {
    std::string bytes =
        std::string("ply\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
        " 1.0\nelement first 1\nproperty list short double skipped\nproperty ushort skipped2\nelement vertex 3\n"
        "property char x\nproperty uchar s\nproperty uint y\nproperty double z\nelement face 1\nproperty list uint "
        "ushort vertex_indices\nend_header\n";
    bytes += bytes_of_value(std::int16_t{2}, big) + bytes_of_value(1.0, big) + bytes_of_value(2.0, big) +
             bytes_of_value(std::uint16_t{9}, big);
    for (int i = 0; i < 3; ++i) {
      bytes += bytes_of_value(static_cast<std::int8_t>(-i - 1), big) + bytes_of_value(std::uint8_t{255}, big);
      bytes += bytes_of_value(std::uint32_t{4294967295}, big) + bytes_of_value(0.25 * i, big);
    }
    bytes += bytes_of_value(std::uint32_t{3}, big);
    for (const int corner : {2, 1, 0}) bytes += bytes_of_value(static_cast<std::uint16_t>(corner), big);
    EXPECT_EQ(read_text(bytes, ply), "-1 4294967295 0, -2 4294967295 1/4, -3 4294967295 1/2 | 2 1 0");
    EXPECT_EQ(read_text(bytes + " \r\n", ply), read_text(bytes, ply));
    expect_error_at_byte(bytes.size(), "more data than the header announces", bytes + "x", ply);
    expect_error_at_byte(bytes.size() - 10, "a list of 3 numbers, but there is room for 2",
                         bytes.substr(0, bytes.size() - 1), ply);
  }
}

TEST(Ply, integers_of_each_width_keep_their_sign) {
  const auto read_with = [](const std::string& type, const std::string& value) {
    const std::string head = "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty " + type +
                             " x\nproperty " + type + " y\nproperty " + type + " z\nend_header\n";
    return read_text(head + value + value + value, ply);
  };
  EXPECT_EQ(read_with("int8", "\xFF"), "-1 -1 -1 |");
  EXPECT_EQ(read_with("uint8", "\xFF"), "255 255 255 |");
  EXPECT_EQ(read_with("int16", "\xFE\xFF"), "-2 -2 -2 |");
  EXPECT_EQ(read_with("uint16", "\xFE\xFF"), "65534 65534 65534 |");
  EXPECT_EQ(read_with("int32", "\xFD\xFF\xFF\xFF"), "-3 -3 -3 |");
  EXPECT_EQ(read_with("uint32", "\xFD\xFF\xFF\xFF"), "4294967293 4294967293 4294967293 |");
}

TEST(Ply, binary_data_begin_right_behind_the_header_whatever_its_line_ends) {
  const std::string data = std::string("\n\0\0\0", 4) + bytes_of_value(0.0f, false) +
                           bytes_of_value(0.0f, false);  // x is 0x0000000A, and begins with \n
  for (const std::string line_end : {"\n", "\r\n", "\r"}) {
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty int x\nproperty float y\nproperty float "
        "z\nend_header\n";
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += line_end.size())
      text.replace(at, 1, line_end);
    EXPECT_EQ(read_text(text + data, ply), "10 0 0 |") << printable(line_end, 5, true);
    EXPECT_EQ(read_text(text + "\1" + data.substr(1), ply), "1 0 0 |") << printable(line_end, 5, true);
  }
}

TEST(Ply, a_header_that_is_none_is_an_error) {
  expect_error_at(1, 1, "unexpected \"plyx\"; a PLY file begins with a line ply", "plyx\n", ply);
  expect_error_at(1, 5, "unexpected \"x\"", "ply x\n", ply);
  expect_error_at(2, 1, "the file ends within the header", "ply\n", ply);
  expect_error_at(2, 1, "unexpected \"comment\"; the second line", "ply\ncomment\n", ply);
  expect_error_at(2, 8, "unknown format \"text\"", "ply\nformat text 1.0\n", ply);
  expect_error_at(2, 14, "unknown version \"2.0\"", "ply\nformat ascii 2.0\n", ply);
  expect_error_at(2, 18, "unexpected \"x\"", "ply\nformat ascii 1.0 x\n", ply);
  const std::string begin = "ply\nformat ascii 1.0\n";
  expect_error_at(3, 1, "unknown header line \"elements\"", begin + "elements\n", ply);
  expect_error_at(3, 8, "the name of the element is missing", begin + "element", ply);
  expect_error_at(3, 15, "the number of elements is missing", begin + "element vertex", ply);
  expect_error_at(3, 16, "\"-1\" is not a number of elements", begin + "element vertex -1\n", ply);
  expect_error_at(3, 18, "unexpected \"x\"", begin + "element vertex 0 x\n", ply);
  expect_error_at(4, 9, "element \"vertex\" comes twice", begin + "element vertex 0\nelement vertex 0\n", ply);
  expect_error_at(3, 9, "triangle strips are not supported", begin + "element tristrips 0\n", ply);
  expect_error_at(3, 1, "a property before the first element", begin + vertex_lines, ply);
  expect_error_at(4, 10, "unknown type \"real\"", begin + "element vertex 0\nproperty real x\n", ply);
  expect_error_at(4, 15, "a list's length cannot be \"float\"",
                  begin + "element face 0\nproperty list float int vertex_indices\n", ply);
  expect_error_at(4, 15, "the name of the property is missing", begin + "element face 0\nproperty float\n", ply);
  expect_error_at(4, 18, "unexpected \"y\"", begin + "element vertex 0\nproperty float x y\n", ply);
  expect_error_at(5, 16, "property \"x\" comes twice", begin + "element vertex 0\nproperty float x\nproperty float x\n",
                  ply);
  expect_error_at(4, 27, "\"vertex_indices\" is not a list of integers",
                  begin + "element face 0\nproperty list uchar float vertex_indices\n", ply);
  expect_error_at(4, 14, "\"vertex_index\" is not a list of integers",
                  begin + "element face 0\nproperty int vertex_index\n", ply);
  expect_error_at(4, 27, "\"x\" is a list", begin + "element vertex 0\nproperty list uchar float x\n", ply);
  expect_error_at(3, 9, "element vertex has no property y",
                  begin + "element vertex 0\nproperty float x\nproperty float z\nend_header\n", ply);
  expect_error_at(7, 9, "element face has no property vertex_indices",
                  begin + "element vertex 0\n" + vertex_lines + "element face 0\nend_header\n", ply);
  expect_error_at(3, 11, "the header has no element vertex", begin + "end_header\n", ply);
  expect_error_at(3, 12, "unexpected \"x\"", begin + "end_header x\n", ply);
}

TEST(Ply, counts_larger_than_the_file_are_an_error_before_any_memory_is_taken) {
  expect_error_at(3, 16, "1000000000 elements are announced, but only 123 bytes follow",
                  header("ascii", "1000000000", "1") + "0 0 0\n", ply);
  expect_error_at(3, 16, "40 elements \"vertex\" are announced, but there is room for 1 at most",
                  header("ascii", "40", "1") + "0 0 0\n", ply);
  expect_error_at(7, 14, "5 elements \"face\" are announced, but there is room for 2 at most",
                  header("ascii", "1", "5") + "0 0 0\n0\n0\n", ply);
  expect_error_at(3, 16, "2 elements \"vertex\" are announced, but there is room for 1 at most",
                  header("binary_little_endian", "2", "0") + std::string(23, '\0'), ply);
  expect_error_at(7, 14, "9 elements \"face\" are announced, but there is room for 8 at most",
                  header("binary_little_endian", "1", "9") + std::string(20, '\0'), ply);
  expect_error_at(11, 1, "a list of 1000000000 numbers, but there is room for 2 at most",
                  header("ascii", "1", "1") + "0 0 0\n1000000000 0 0", ply);
  expect_error_at(11, 1, "a list of -3 numbers", header("ascii", "1", "1") + "0 0 0\n-3 0 0 0\n", ply);
  const std::string head = header("binary_little_endian", "1", "1");
  expect_error_at_byte(head.size() + 12, "a list of 3 numbers, but there is room for 2 at most",
                       head + std::string(12, '\0') + "\3" + std::string(11, '\0'), ply);
  // Each element has a byte, but the second value of the first one is cut off.
  const std::string lists = "ply\nformat binary_little_endian 1.0\nelement vertex 0\n" + vertex_lines +
                            "element mixed 1\nproperty list uchar char a\nproperty int b\nend_header\n";
  EXPECT_EQ(read_text(lists + "\3abc1234", ply), " |");
  expect_error_at_byte(lists.size() + 7, "the file ends within its data", lists + "\3abc123", ply);
}

TEST(Ply, text_that_is_cut_off_or_too_long_is_an_error) {
  expect_error_at(11, 1, "the file ends after 1 of 2 elements \"vertex\"",
                  header("ascii", "2", "0") + "0.0000000 0 0\n", ply);
  expect_error_at(10, 4, "a coordinate is missing", header("ascii", "1", "0") + "0 0\n\n\n", ply);
  expect_error_at(11, 4, "a number is missing", header("ascii", "1", "1") + "0 0 0\n3 0\n\n\n\n", ply);
  const std::string coloured =
      "ply\nformat ascii 1.0\nelement vertex 1\n" + vertex_lines + "property uchar red\nend_header\n";
  expect_error_at(9, 6, "a number is missing; complete the line", coloured + "0 0 0\n\n\n", ply);
  expect_error_at(9, 7, "\"#\" is not a number", coloured + "0 0 0 # 7\n", ply);  // there are no comments here
  EXPECT_EQ(read_text(coloured + "0 0 0 7", ply), "0 0 0 |");                     // exactly as many bytes as need be
  expect_error_at(10, 7, "unexpected \"0\"; an element has no more properties", header("ascii", "1", "0") + "0 0 0 0\n",
                  ply);
  expect_error_at(11, 1, "more lines than the header announces", header("ascii", "1", "0") + "0 0 0\n3 0 0 0\n", ply);
}

TEST(Ply, an_index_out_of_range_is_an_error) {
  expect_error_at(11, 5, "vertex index 1 is out of range; there are 1 vertices",
                  header("ascii", "1", "1") + "0 0 0\n3 0 1 0\n", ply);
  expect_error_at(11, 5, "vertex index -1 is out of range", header("ascii", "1", "1") + "0 0 0\n3 0 -1 0\n", ply);
  expect_error_at(11, 5, "\"x\" is not an integer", header("ascii", "1", "1") + "0 0 0\n3 0 x 0\n", ply);
  for (const char* index : {"\1\0\0\0", "\xFF\xFF\xFF\xFF"}) {
    const std::string head =
        header("binary_little_endian", "1", "1") + std::string(12, '\0') + "\3" + std::string(4, '\0');
    expect_error_at_byte(head.size(), "is out of range", head + std::string(index, 4) + std::string(4, '\0'), ply);
  }
}

TEST(Ply, a_coordinate_that_is_none_is_an_error) {
  expect_error_at(10, 3, "\"nan\" is not a finite number", header("ascii", "1", "0") + "0 nan 0\n", ply);
  for (const float bad : {std::nanf(""), HUGE_VALF, -HUGE_VALF}) {
    const std::string head = header("binary_big_endian", "1", "0") + std::string(4, '\0');
    expect_error_at_byte(head.size(), "a coordinate is not a finite number",
                         head + bytes_of_value(bad, true) + std::string(4, '\0'), ply);
  }
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double "
      "z\nend_header\n" +
      std::string(16, '\0');
  expect_error_at_byte(head.size(), "a coordinate is not a finite number", head + bytes_of_value(HUGE_VAL, false), ply);
}

}  // namespace
}  // namespace sightline::test
