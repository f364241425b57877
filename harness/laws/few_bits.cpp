#include <sightline/harness/laws/few_bits.h>

#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/image/newell.h>
#include <sightline/algorithms/image/number_painter.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/image/scan_line.h>
#include <sightline/algorithms/image/warnock.h>
#include <sightline/algorithms/image/weiler_atherton.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/harness/laws/images.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace few_bits {

using images::Seen;
using images::serial;

/// Whether all corners, the eye, and all directions are multiples of 1/8 up to `most`.
bool has_small_numbers(const Seen& seen, long most) {
  const auto is_small = [&](const Exact_point& v) {
    return std::all_of(v.begin(), v.end(),
                       [&](const Rational& x) { return abs(x) <= most && Rational(8 * x).get_den() == 1; });
  };
  for (const std::array<double, 3>& v : {seen.pixels.look, seen.pixels.right, seen.pixels.up})
    if (!is_small({exact(v[0]), exact(v[1]), exact(v[2])})) return false;
  for (Point_id p = 0; p < seen.soup.point_count(); ++p)
    if (!is_small(seen.soup.point(p))) return false;
  return is_small(seen.pixels.eye);
}

/// Both show the same where all around a pixel show what it does, and nothing there is tied.
Outcome same_within(const Pixel_view& pixels, const Piece_image& truth, const Piece_image& image,
                    const std::string& method, const std::vector<std::uint8_t>& tied) {
  const std::size_t width = pixels.width, height = pixels.height;
  for (std::size_t y = 1; y + 1 < height; ++y)
    for (std::size_t x = 1; x + 1 < width; ++x) {
      const std::size_t i = y * width + x;
      bool is_even = true;
      for (std::size_t v = y - 1; v <= y + 1; ++v)
        for (std::size_t u = x - 1; u <= x + 1; ++u)
          is_even = is_even && truth.pieces[v * width + u] == truth.pieces[i] && tied[v * width + u] == 0;
      if (is_even && image.pieces[i] != truth.pieces[i])
        return Outcome::failed(images::place(pixels, i) + " shows " + images::name(truth.pieces[i]) +
                               ", as all around it, " + images::name(image.pieces[i]) + " by " + method);
    }
  return {};
}

/// Whether the eye sees no corner of a piece on an edge's line, but where the edge ends in its own piece. Pre: small
/// numbers, of which doubles hold volumes.
bool is_in_general_position(const Seen& seen) {
  const Scene& scene = seen.scene;
  std::vector<std::vector<std::array<double, 3>>> polygons;  // of the pieces, as the eye has them
  for (const Piece& piece : scene.pieces()) {
    polygons.emplace_back();
    for (const Piece_corner& corner : scene.corners(piece)) {
      std::array<double, 3> at{};
      const Exact_point p = scene.position(corner.point);
      for (std::size_t k = 0; k < 3; ++k) at[k] = Rational(p[k] - seen.pixels.eye[k]).get_d();
      polygons.back().push_back(at);
    }
  }
  for (std::size_t i = 0; i < polygons.size(); ++i)
    for (std::size_t k = 0; k < polygons[i].size(); ++k) {
      const std::size_t next = (k + 1) % polygons[i].size();
      const std::array<double, 3> plane = cross(polygons[i][k], polygons[i][next]);
      for (std::size_t j = 0; j < polygons.size(); ++j)
        for (std::size_t m = 0; m < polygons[j].size(); ++m)
          if ((i != j || (m != k && m != next)) && dot(plane, polygons[j][m]) == 0) return false;
    }
  return true;
}

template <class Number>
Piece_image by_clip_polygons(const Seen& seen) {
  const Number_view<Number> view(seen.scene, seen.pixels.eye, field_of(seen.pixels));
  Visible_options alone;
  alone.threads = 1;
  return paint(view, weiler_atherton(view, field_of_view(view), alone), seen.pixels, serial());
}

Outcome run(const Seen& seen) {
  if (!has_small_numbers(seen, 256)) return Outcome::not_applicable();
  const Piece_image truth = seen.truth();
  const bool is_general = is_in_general_position(seen);
  for (const Image_kernel kernel : {Image_kernel::double_numbers, Image_kernel::float_numbers}) {
    const bool in_floats = kernel == Image_kernel::float_numbers;
    if (in_floats && !has_small_numbers(seen, 8)) break;
    const std::string numbers = in_floats ? " in floats" : " in doubles";

    // 1. Each sign is one of corners: rounding tells all that are not zero.
    const Outcome spans = images::same(seen.pixels, truth, scan_line(seen.scene, seen.pixels, kernel, serial()),
                                       "spans" + numbers, false);
    if (spans.state != Outcome::State::passed) return spans;
    const Outcome windows = images::same(seen.pixels, truth, warnock(seen.scene, seen.pixels, kernel, serial()),
                                         "windows" + numbers, false);
    if (windows.state != Outcome::State::passed) return windows;

    // 2. What is painted has centres on its borders, and what is cut has corners that are rounded.
    for (const Painter_key key : {Painter_key::nearest, Painter_key::farthest}) {
      const Outcome painted = same_within(
          seen.pixels, heedless_painter(seen.scene, seen.pixels, key, Image_kernel::exact, serial()),
          heedless_painter(seen.scene, seen.pixels, key, kernel, serial()), "a heedless painter" + numbers, truth.tied);
      if (painted.state != Outcome::State::passed) return painted;
    }
    const Outcome sorted = same_within(seen.pixels, truth, newell(seen.scene, seen.pixels, kernel, serial()),
                                       "newell" + numbers, truth.tied);
    if (sorted.state != Outcome::State::passed) return sorted;
    // Where a corner is on an edge, as that of another face, what is left of a cut is noise.
    if (!is_general) continue;
    const Outcome clipped =
        same_within(seen.pixels, truth, in_floats ? by_clip_polygons<float>(seen) : by_clip_polygons<double>(seen),
                    "clip polygons" + numbers, truth.tied);
    if (clipped.state != Outcome::State::passed) return clipped;
  }
  return {};
}

}  // namespace few_bits

Check few_bits_check() {
  return images::check_of("few_bits", "small numbers in floats and doubles show what exact rays do", few_bits::run);
}

}  // namespace sightline::harness
