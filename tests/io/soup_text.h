#pragma once
// What the tests of readers and writers share: a soup as text, and the error that bad bytes must give.

#include <sightline/io/read.h>

#include <gtest/gtest.h>

#include <random>

namespace sightline::test {

constexpr Format obj = Format::obj, off = Format::off, ply = Format::ply, stl = Format::stl;

/// "x y z, x y z | 0 1 2, 2 1 0": points in lowest terms, then faces; a hole follows its contour behind a '/'.
inline std::string text_of(const Polygon_soup& soup) {
  std::string text;
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    const Exact_point point = soup.point(p);
    text += (p == 0 ? "" : ", ") + to_string(point[0]) + " " + to_string(point[1]) + " " + to_string(point[2]);
  }
  text += " |";
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    if (f != 0) text += ",";
    for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
      if (k != 0) text += " /";
      for (const Point_id p : soup.loop(f, k)) text += " " + std::to_string(p);
    }
  }
  return text;
}

inline std::string read_text(std::string_view bytes, Format format, const Read_options& options = {}) {
  return text_of(read_scene(bytes, format, "scene", options));
}

/// The Input_error of bytes that must not be read; fails where they are.
inline std::optional<Input_error> error_of(std::string_view bytes, Format format, const Read_options& options = {}) {
  try {
    const Polygon_soup soup = read_scene(bytes, format, "scene", options);
    ADD_FAILURE() << "read as " << text_of(soup).substr(0, 200);
  } catch (const Input_error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.file, "scene") << what;
    EXPECT_EQ(what.find_first_of("\r\n"), std::string::npos) << what;
    EXPECT_NE(what.find("; "), std::string::npos) << what << " does not say what to do";
    return error;
  }
  return std::nullopt;
}

/// Expects an error in text at a line and column, whose message holds `part`.
inline void expect_error_at(std::size_t line, std::size_t column, const std::string& part, std::string_view bytes,
                            Format format, const Read_options& options = {}) {
  SCOPED_TRACE(printable(bytes, 200, true));
  const std::optional<Input_error> error = error_of(bytes, format, options);
  if (!error) return;
  EXPECT_EQ(error->line, line) << error->what();
  EXPECT_EQ(error->column, column) << error->what();
  EXPECT_FALSE(error->byte);
  EXPECT_TRUE(
      std::string(error->what()).starts_with("scene:" + std::to_string(line) + ":" + std::to_string(column) + ": "))
      << error->what();
  EXPECT_NE(std::string(error->what()).find(part), std::string::npos) << error->what();
}

/// Expects an error in binary data at an offset, whose message holds `part`.
inline void expect_error_at_byte(std::size_t byte, const std::string& part, std::string_view bytes, Format format) {
  SCOPED_TRACE(printable(bytes, 200, true));
  const std::optional<Input_error> error = error_of(bytes, format);
  if (!error) return;
  EXPECT_EQ(error->byte, byte) << error->what();
  EXPECT_EQ(error->line, 0u);
  EXPECT_TRUE(std::string(error->what()).starts_with("scene: byte " + std::to_string(byte) + ": ")) << error->what();
  EXPECT_NE(std::string(error->what()).find(part), std::string::npos) << error->what();
}

}  // namespace sightline::test
