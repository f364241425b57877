// Writing a soup and reading it again gives the soup; what a format cannot hold is refused.

#include "soup_text.h"

#include <sightline/io/file.h>
#include <sightline/io/write.h>
#include <sightline/io/exact_text.h>

#include <fstream>
#include <rapidcheck/gtest.h>
#include <sstream>

namespace sightline::test {
namespace {

namespace fs = std::filesystem;

constexpr std::array all_formats{Format::obj, Format::off, Format::qoff, Format::ply, Format::ply_binary, Format::stl};

std::string written(const Polygon_soup& soup, Format format) {
  std::ostringstream out;
  write_scene(soup, out, format);
  return out.str();
}

/// "ax ay az bx by bz cx cy cz, ..." of each face, by value.
std::vector<std::vector<Exact_point>> faces_by_value(const Polygon_soup& soup) {
  std::vector<std::vector<Exact_point>> faces(soup.face_count());
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (const Point_id p : soup.loop(f)) faces[f].push_back(soup.point(p));
  return faces;
}

double any_double() {
  const auto bits = *rc::gen::arbitrary<std::uint64_t>();  // often small: subnormals
  const auto value = std::bit_cast<double>(*rc::gen::element(bits, bits << 40, bits * 0x9E3779B97F4A7C15u));
  return std::isfinite(value) ? value : static_cast<double>(bits);
}
Rational any_decimal() {
  const auto mantissa = *rc::gen::arbitrary<std::int64_t>();
  Rational value = exact_decimal(Integer(static_cast<long>(mantissa)), *rc::gen::inRange(-30, 30));
  if (*rc::gen::inRange(0, 10) == 0)
    value *= exact_decimal(Integer("123456789012345678901234567890123"), *rc::gen::inRange(-900, 900));
  return value;
}
Rational any_rational() {
  const auto denominator = *rc::gen::inRange<std::int64_t>(1, 1000);
  Rational value(Integer(static_cast<long>(*rc::gen::arbitrary<std::int64_t>())),
                 Integer(static_cast<long>(denominator)));
  value.canonicalize();
  return value;
}

/// A soup of up to 9 points, whose coordinates `any` draws, and up to 6 faces of up to `most` corners, or of exactly
/// `most` where only those will do.
template <class Any>
Polygon_soup any_soup(Any any, std::size_t least, std::size_t most) {
  Polygon_soup soup;
  const auto points = *rc::gen::inRange<std::size_t>(1, 10);
  for (std::size_t i = 0; i < points; ++i) {
    const auto x = any(), y = any(), z = any();
    soup.add_point(x, y, z);
  }
  const auto faces = *rc::gen::inRange<std::size_t>(0, 7);
  for (std::size_t f = 0; f < faces; ++f) {
    const auto size = *rc::gen::inRange<std::size_t>(least, most + 1);
    soup.add_face(
        *rc::gen::container<std::vector<Point_id>>(size, rc::gen::inRange<Point_id>(0, static_cast<Point_id>(points))));
  }
  return soup;
}

void check_same(const Polygon_soup& soup, Format format) {
  const Polygon_soup again = read_scene(written(soup, format), format, "again");
  if (format == Format::stl) RC_ASSERT(faces_by_value(again) == faces_by_value(soup));
  else RC_ASSERT(text_of(again) == text_of(soup));
}

RC_GTEST_PROP(Round_trip, of_doubles_is_exact_in_every_format, ()) {
  const Polygon_soup soup = any_soup(any_double, 0, 9);
  for (const Format format : all_formats)
    if (format != Format::stl) check_same(soup, format);
  check_same(any_soup(any_double, 3, 3), Format::stl);
}
RC_GTEST_PROP(Round_trip, of_decimals_is_exact_in_text, ()) {
  const Polygon_soup soup = any_soup(any_decimal, 0, 9);
  for (const Format format : {Format::obj, Format::off, Format::qoff, Format::ply}) check_same(soup, format);
  check_same(any_soup(any_decimal, 3, 3), Format::stl);
}
RC_GTEST_PROP(Round_trip, of_rationals_is_exact_in_qoff, ()) { check_same(any_soup(any_rational, 0, 9), Format::qoff); }

TEST(Round_trip, of_the_least_and_the_greatest_double_is_exact) {
  Polygon_soup soup;
  soup.add_point(std::ldexp(1.0, -1074), -std::numeric_limits<double>::max(), std::numeric_limits<double>::min());
  soup.add_point(-0.0, std::nextafter(1.0, 2.0), -0.1);
  soup.add_face({0, 1, 0});
  for (const Format format : all_formats)
    EXPECT_EQ(text_of(read_scene(written(soup, format), format, "again")), text_of(soup));
}

TEST(Round_trip, of_the_empty_soup_is_the_empty_soup) {
  for (const Format format : all_formats) EXPECT_EQ(text_of(read_scene(written({}, format), format, "again")), " |");
}

TEST(Round_trip, of_a_polygon_of_300_corners_outgrows_short_lists) {
  Polygon_soup soup;
  std::vector<Point_id> corners;
  for (int i = 0; i < 300; ++i) corners.push_back(soup.add_point(double(i), i * i / 4.0, 0));
  soup.add_face(corners);
  for (const Format format : {Format::ply, Format::ply_binary})
    EXPECT_EQ(text_of(read_scene(written(soup, format), format, "again")), text_of(soup));
  EXPECT_NE(written(soup, Format::ply).find("list uint uint"), std::string::npos);
  Polygon_soup short_soup;
  short_soup.add_point(0.0, 0.0, 0.0);
  short_soup.add_face(std::vector<Point_id>(255, 0));
  EXPECT_NE(written(short_soup, Format::ply).find("list uchar uint"), std::string::npos);
  EXPECT_EQ(text_of(read_scene(written(short_soup, Format::ply_binary), Format::ply, "again")), text_of(short_soup));
}

TEST(Decimal_text, is_short_where_the_number_is) {
  const std::vector<std::pair<Rational, std::string>> cases{
      {0, "0"},
      {-25, "-25"},
      {Rational(1, 2), "0.5"},
      {Rational(-1, 8), "-0.125"},
      {Rational(5, 4), "1.25"},
      {Rational(1, 5), "0.2"},
      {Rational(-3, 1000), "-0.003"},
      {exact_decimal(12, -9), "1.2e-8"},
      {Rational(1) / exact(0x1p48), "3.552713678800500929355621337890625e-15"},
      {exact_decimal(7, 3), "7000"}};
  for (const auto& [value, text] : cases) EXPECT_EQ(decimal_text(value), text);
  EXPECT_FALSE(decimal_text(Rational(1, 3)));
  EXPECT_FALSE(decimal_text(Rational(1, 30)));
  EXPECT_TRUE(decimal_text(exact_decimal(1, -1100)));
  EXPECT_FALSE(decimal_text(exact_decimal(1, -1101)));  // the reader would refuse it
}

void expect_not_representable(const Polygon_soup& soup, Format format, const std::string& part) {
  try {
    (void)written(soup, format);
    ADD_FAILURE() << "was written: " << part;
  } catch (const Not_representable& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("; "), std::string::npos) << error.what() << " does not say what to do";
  }
}

TEST(Not_representable, is_a_third_outside_qoff) {
  Polygon_soup soup;
  soup.add_point(0.0, 0.0, 0.0);
  soup.add_point(Rational(0), Rational(1, 3), Rational(0));
  soup.add_face({0, 1, 0});
  for (const Format format : {Format::obj, Format::off, Format::ply, Format::stl})
    expect_not_representable(soup, format, "cannot hold the coordinate 1/3 of point 1, which is no finite decimal");
  expect_not_representable(soup, Format::ply_binary, "cannot hold the coordinate 1/3 of point 1, which is no double");
  EXPECT_EQ(text_of(read_scene(written(soup, Format::qoff), Format::qoff, "again")), text_of(soup));
}

TEST(Not_representable, is_a_decimal_that_is_no_double_in_binary_ply) {
  for (const Rational& value :
       {Rational(1, 10), exact_decimal(1, 400), exact_decimal(1, -400), Rational(Integer("9007199254740993"))}) {
    Polygon_soup soup;
    soup.add_point(Rational(0), Rational(0), value);
    expect_not_representable(soup, Format::ply_binary, "of point 0, which is no double");
    EXPECT_NO_THROW(written(soup, Format::ply));
  }
}

TEST(Not_representable, is_a_hole_in_any_format) {
  Polygon_soup soup;
  soup.add_point(0.0, 0.0, 0.0);
  soup.add_face({0, 0, 0});
  soup.add_face({0, 0, 0});
  soup.add_hole({0, 0, 0});
  for (const Format format : all_formats) expect_not_representable(soup, format, "face 1, which has holes");
}

TEST(Not_representable, is_a_quadrangle_in_stl) {
  Polygon_soup soup;
  soup.add_point(0.0, 0.0, 0.0);
  soup.add_face({0, 0, 0});
  soup.add_face({0, 0, 0, 0});
  expect_not_representable(soup, Format::stl, "STL cannot hold face 1, which has 4 corners");
}

TEST(Write_scene, to_a_file_goes_by_its_ending) {
  const fs::path folder = fs::path(testing::TempDir()) / ("sightline_write_" + std::to_string(std::random_device()()));
  fs::create_directories(folder);
  Polygon_soup soup;
  soup.add_point(0.5, 0.0, -1.0);
  soup.add_face({0, 0, 0});
  for (const char* name : {"a.obj", "a.OFF", "a.qoff", "a.ply", "a.stl"}) {
    write_scene(soup, folder / name);
    EXPECT_EQ(text_of(read_scene(folder / name)), text_of(soup)) << name;
    EXPECT_FALSE(fs::exists(folder / (std::string(name) + ".partial"))) << name;
  }
  write_scene(soup, folder / "b.ply", Format::ply_binary);
  EXPECT_EQ(text_of(read_scene(folder / "b.ply")), text_of(soup));
  EXPECT_THROW(write_scene(soup, folder / "a.txt"), std::runtime_error);
  EXPECT_FALSE(fs::exists(folder / "a.txt"));
  try {
    write_scene(soup, folder / "none" / "a.obj");
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("none/a.obj: cannot be written: No such file or directory"),
              std::string::npos)
        << error.what();
  }

  // Told all the while, the bytes are the same; whoever says no at any moment leaves the old file as it was.
  Polygon_soup many;
  for (int k = 0; k < 20000; ++k) many.add_point(k, 0.5, -1.0);
  many.add_face({0, 1, 2});
  write_scene(many, folder / "many.off");
  const std::string bytes = read_bytes(folder / "many.off");
  std::vector<std::array<std::size_t, 2>> told;
  const auto write_until = [&](std::size_t calls) {
    told.clear();
    write_scene(many, folder / "told.off", [&](std::size_t done, std::size_t all) {
      if (told.size() == calls) throw std::domain_error("no");
      told.push_back({done, all});
    });
  };
  write_until(1000);
  EXPECT_EQ(read_bytes(folder / "told.off"), bytes);
  EXPECT_GE(told.size(), 2 * (bytes.size() >> 17)) << "a few times a megabyte";
  EXPECT_EQ(told.front()[1], 0u);
  EXPECT_EQ(told.back(), (std::array{bytes.size(), bytes.size()}));
  const std::size_t calls = told.size();
  write_scene(soup, folder / "told.off");
  for (std::size_t k = 0; k < calls; ++k) {
    EXPECT_THROW(write_until(k), std::domain_error);
    EXPECT_EQ(text_of(read_scene(folder / "told.off")), text_of(soup));
    EXPECT_FALSE(fs::exists(folder / "told.off.partial"));
  }

  // What cannot be written leaves the old file as it was.
  Polygon_soup third;
  third.add_point(Rational(1, 3), Rational(0), Rational(0));
  EXPECT_THROW(write_scene(third, folder / "a.obj"), Not_representable);
  EXPECT_EQ(text_of(read_scene(folder / "a.obj")), text_of(soup));
  EXPECT_FALSE(fs::exists(folder / "a.obj.partial"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace sightline::test
