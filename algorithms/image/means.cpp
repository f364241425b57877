#include <sightline/algorithms/image/means.h>

#include <sightline/algorithms/image/pixel_cones.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <optional>
#include <utility>

namespace sightline {

namespace image_detail {

namespace {

/// In pixels from the top left.
using Image_point = std::array<double, 2>;
using Image_polygon = std::vector<Image_point>;

/// The part of a convex polygon where coordinate k is at least (sense 1) or at most (sense -1) a limit; what is cut has
/// exactly that coordinate.
void clip(const Image_polygon& polygon, std::size_t k, double limit, int sense, Image_polygon& part) {
  part.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Image_point &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const double at_p = sense * (p[k] - limit), at_q = sense * (q[k] - limit);
    if (at_p >= 0) part.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      const double t = at_p / (at_p - at_q);
      Image_point cut;
      cut[k] = limit;
      cut[1 - k] = p[1 - k] + t * (q[1 - k] - p[1 - k]);
      part.push_back(cut);
    }
  }
}

/// With respect to its first corner, so that what is lost is of its own size.
double area(const Image_polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const double ax = polygon[i - 1][0] - polygon[0][0], ay = polygon[i - 1][1] - polygon[0][1],
                 bx = polygon[i][0] - polygon[0][0], by = polygon[i][1] - polygon[0][1];
    twice += ax * by - ay * bx;
  }
  return std::fabs(twice) / 2;
}

/// What a row's polygon has at one height: nothing, where it does not reach it.
std::optional<std::array<double, 2>> extent_at(const Image_polygon& polygon, double height) {
  std::optional<std::array<double, 2>> extent;
  for (const Image_point& p : polygon) {
    if (p[1] != height) continue;
    if (!extent) extent = {p[0], p[0]};
    extent = {std::min((*extent)[0], p[0]), std::max((*extent)[1], p[0])};
  }
  return extent;
}

/// One row of an image, as it fills.
class Row {
 public:
  Row(std::uint32_t width, std::int64_t y) : top_(static_cast<double>(y)), sums_(width), covered_(width) {}

  void add(const Image_polygon& polygon, const Colour& colour) {
    // 1. The row's part.
    clip(polygon, 1, top_, 1, below_);
    clip(below_, 1, top_ + 1, -1, part_);
    if (part_.size() < 3) return;
    const auto [least, most] = std::minmax_element(part_.begin(), part_.end());
    const auto width = static_cast<double>(sums_.size());
    const auto first = static_cast<std::size_t>(std::clamp(std::floor((*least)[0]), 0.0, width)),
               last = static_cast<std::size_t>(std::clamp(std::ceil((*most)[0]), 0.0, width));
    // 2. Squares whose four corners are in it.
    std::size_t inner_first = last, inner_last = last;
    const auto above = extent_at(part_, top_), beneath = extent_at(part_, top_ + 1);
    if (above && beneath) {
      const double from = std::max((*above)[0], (*beneath)[0]), to = std::min((*above)[1], (*beneath)[1]);
      if (to - from >= 1) {
        inner_first = std::clamp(static_cast<std::size_t>(std::clamp(std::ceil(from), 0.0, width)), first, last);
        inner_last = std::clamp(static_cast<std::size_t>(std::clamp(std::floor(to), 0.0, width)), inner_first, last);
      }
    }
    // 3. The others, one by one.
    for (std::size_t x = first; x < last; ++x) {
      if (x >= inner_first && x < inner_last) {
        add(x, 1, colour);
        continue;
      }
      clip(part_, 0, static_cast<double>(x), 1, right_);
      clip(right_, 0, static_cast<double>(x) + 1, -1, square_);
      add(x, area(square_), colour);
    }
  }

  const std::vector<Colour>& sums() const { return sums_; }
  const std::vector<double>& covered() const { return covered_; }

 private:
  void add(std::size_t x, double weight, const Colour& colour) {
    for (std::size_t k = 0; k < 3; ++k) sums_[x][k] += weight * colour[k];
    covered_[x] += weight;
  }

  double top_;
  std::vector<Colour> sums_;
  std::vector<double> covered_;
  Image_polygon below_, part_, right_, square_;
};

/// Where rays of the field are in the image.
class Corners {
 public:
  Corners(const Exact_view& view, const Pixel_centres& centres) : view_(view), centres_(centres) {
    const auto exactly = [](const std::array<double, 3>& v) {
      return Exact_point{exact(v[0]), exact(v[1]), exact(v[2])};
    };
    const Pixel_view& pixels = centres.view();
    const Exact_point look = exactly(pixels.look), right = exactly(pixels.right), up = exactly(pixels.up);
    to_look_ = cross(right, up);
    to_right_ = cross(up, look);
    to_up_ = cross(look, right);
  }

  Image_point operator()(const Exact_view::Ray& ray) const {
    const Pixel_view& pixels = centres_.view();
    const double half = std::max(pixels.width, pixels.height) / 2.0;
    const auto in_pixels = [&](double across, double upwards) {
      return Image_point{(across + 1) / 2 * pixels.width, (1 - upwards) / 2 * pixels.height};
    };
    const auto place = centres_.place(view_.approximate(ray), ray.error);
    if (place && place->error * half < 0x1p-31 && std::fabs(place->across) <= 1 && std::fabs(place->upwards) <= 1)
      return in_pixels(place->across, place->upwards);
    const std::array<Integer, 3> integers = view_.direction(ray);
    const Exact_point d{Rational(integers[0]), Rational(integers[1]), Rational(integers[2])};
    const Rational z = dot(d, to_look_);
    return in_pixels(nearest_double(Rational(dot(d, to_right_) / z)), nearest_double(Rational(dot(d, to_up_) / z)));
  }

 private:
  const Exact_view& view_;
  const Pixel_centres& centres_;
  Exact_point to_look_, to_right_, to_up_;
};

}  // namespace

}  // namespace image_detail

std::vector<std::array<Integer, 3>> field_of(const Pixel_view& pixels) {
  std::vector<Exact_point> rays{pixels.direction(-1, 1), pixels.direction(1, 1), pixels.direction(1, -1),
                                pixels.direction(-1, -1)};
  const auto exactly = [](const std::array<double, 3>& v) {
    return Exact_point{exact(v[0]), exact(v[1]), exact(v[2])};
  };
  // Where right, up and look turn the other way, the image is a mirror's.
  if (sgn(dot(exactly(pixels.look), cross(exactly(pixels.right), exactly(pixels.up)))) > 0)
    std::reverse(rays.begin(), rays.end());
  return field_of(rays);
}

Mean_image visible_means(const Exact_view& view, const Visible_surface<Exact_view>& surface, const Pixel_view& pixels,
                         const std::function<Colour(std::uint32_t piece)>& colour, const Image_options& options) {
  using namespace image_detail;
  constexpr std::size_t rows = 16;
  const Pixel_centres centres(pixels);
  const std::size_t size = std::size_t{pixels.width} * pixels.height;
  Mean_image image{pixels.width, pixels.height, std::vector<Colour>(size), std::vector<double>(size)};
  run_with_threads(options.threads, [&] {
    // 1. The parts in the image.
    const Corners corners(view, centres);
    std::vector<Image_polygon> polygons(surface.parts.size());
    parallel_for(polygons.size(), [&](std::size_t i) {
      if (surface.parts[i].piece == surface.nothing) return;
      for (const Exact_view::Ray& ray : surface.of(surface.parts[i])) polygons[i].push_back(corners(ray));
    });
    // 2. Which bands of rows they meet.
    const std::size_t count = (pixels.height + rows - 1) / rows;
    std::vector<std::vector<std::uint32_t>> bands(count);
    for (std::uint32_t i = 0; i < polygons.size(); ++i) {
      double top = pixels.height, bottom = 0;
      for (const Image_point& p : polygons[i]) {
        top = std::min(top, p[1]);
        bottom = std::max(bottom, p[1]);
      }
      if (!(top < bottom)) continue;
      const auto last = std::min(static_cast<std::size_t>(bottom) / rows, count - 1);
      for (auto band = static_cast<std::size_t>(std::max(top, 0.0)) / rows; band <= last; ++band)
        bands[band].push_back(i);
    }
    // 3. Row by row.
    std::size_t done = 0;
    std::mutex mutex;
    parallel_for(count, [&](std::size_t band) {
      for (std::size_t y = band * rows; y < std::min<std::size_t>((band + 1) * rows, pixels.height); ++y) {
        Row row(pixels.width, static_cast<std::int64_t>(y));
        for (const std::uint32_t i : bands[band]) row.add(polygons[i], colour(surface.parts[i].piece));
        std::copy(row.sums().begin(), row.sums().end(), &image.colours[y * pixels.width]);
        std::copy(row.covered().begin(), row.covered().end(), &image.covered[y * pixels.width]);
      }
      if (!options.progress) return;
      const std::lock_guard lock(mutex);
      options.progress(++done, count);
    });
  });
  return image;
}

}  // namespace sightline
