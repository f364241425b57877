#include <sightline/algorithms/image/means.h>

#include <sightline/algorithms/image/bands.h>
#include <sightline/algorithms/image/blend.h>
#include <sightline/algorithms/image/layers.h>
#include <sightline/algorithms/image/pixel_cones.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <span>

namespace sightline {

namespace image_detail {

namespace {

/// In pixels from the top left.
using Image_point = std::array<double, 2>;

/// A part of a surface, in the image.
struct Image_polygon {
  std::span<const Image_point> corners;  // of a convex polygon
  Layer shown;                           // what it adds to a pixel that it covers
  double top, bottom;
};

/// What a row has of an edge: x from `least` to `most`, over so much of the row's height; negative where it goes up.
struct Row_edge {
  double least, most, height;

  /// How much of column x, a square, is to its right.
  double beside(double x) const {
    if (most <= x) return height;
    if (least >= x + 1) return 0;
    if (least == most) return height * (x + 1 - least);
    const double from = std::max(least, x), to = std::min(most, x + 1);
    return height * (from - least + (to - from) * (x + 1 - (from + to) / 2)) / (most - least);
  }
};

/// The edges in a row.
void edges_in(std::span<const Image_point> corners, double top, std::vector<Row_edge>& edges) {
  edges.clear();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Image_point &p = corners[i], &q = corners[i + 1 == corners.size() ? 0 : i + 1];
    const double from = std::max(std::min(p[1], q[1]), top), to = std::min(std::max(p[1], q[1]), top + 1);
    if (from >= to) continue;
    const double slope = (q[0] - p[0]) / (q[1] - p[1]);
    const auto at = [&](double y) { return y == p[1] ? p[0] : y == q[1] ? q[0] : p[0] + slope * (y - p[1]); };
    const auto [least, most] = std::minmax({at(from), at(to)});
    edges.push_back({least, most, p[1] < q[1] ? to - from : from - to});
  }
}

/// One row of an image, as it fills.
struct Row {
  double top;
  std::span<Colour> sums;
  std::span<double> covered;

  void add(const Image_polygon& polygon, std::vector<Row_edge>& edges) {
    const auto column = [this](double x) {
      return static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(sums.size())));
    };
    // 1. The columns that its part in the row may reach.
    edges_in(polygon.corners, top, edges);
    if (edges.empty()) return;
    double least = edges[0].least, most = edges[0].most;
    for (const Row_edge& edge : edges) {
      least = std::min(least, edge.least);
      most = std::max(most, edge.most);
    }
    std::array<double, 2> after{least, least}, before{most, most};  // of the edges downwards, and of those upwards
    for (const Row_edge& edge : edges) {
      const std::size_t way = edge.height > 0 ? 0 : 1;
      after[way] = std::max(after[way], edge.most);
      before[way] = std::min(before[way], edge.least);
    }
    const std::size_t first = column(std::floor(least)), last = column(std::ceil(most));
    // 2. Those that it covers whole: from the chain of edges on its left to that on its right.
    std::size_t inner_first = last, inner_last = last;
    if (polygon.top <= top && polygon.bottom >= top + 1) {
      const std::size_t left = after[0] <= before[1] ? 0 : 1;
      inner_first = std::clamp(column(std::ceil(after[left])), first, last);
      inner_last = std::clamp(column(std::floor(before[1 - left])), inner_first, last);
    }
    // 3. All of them.
    const auto in_part = [&](std::size_t from, std::size_t to) {
      for (std::size_t x = from; x < to; ++x) {
        double share = 0;
        for (const Row_edge& edge : edges) share += edge.beside(static_cast<double>(x));
        add(x, std::fabs(share), polygon.shown);
      }
    };
    in_part(first, inner_first);
    for (std::size_t x = inner_first; x < inner_last; ++x) add(x, 1, polygon.shown);
    in_part(inner_last, last);
  }

 private:
  void add(std::size_t x, double share, const Layer& shown) {
    for (std::size_t k = 0; k < 3; ++k) sums[x][k] += share * shown.colour[k];
    covered[x] += share * shown.alpha;
  }
};

/// Where rays of the field are in the image.
class Corners {
 public:
  Corners(const Exact_view& view, const Pixel_centres& centres)
      : view_(view), centres_(centres), places_(centres.view()) {}

  Image_point operator()(const Exact_view::Ray& ray) const {
    const Pixel_view& pixels = centres_.view();
    const double half = std::max(pixels.width, pixels.height) / 2.0;
    const auto in_pixels = [&](double across, double upwards) {
      return Image_point{(across + 1) / 2 * pixels.width, (1 - upwards) / 2 * pixels.height};
    };
    const auto place = centres_.place(view_.approximate(ray), ray.error);
    if (place && place->error * half < 0x1p-31 && std::fabs(place->across) <= 1 && std::fabs(place->upwards) <= 1)
      return in_pixels(place->across, place->upwards);
    const auto [across, upwards] = places_(view_.direction(ray));
    return in_pixels(across, upwards);
  }

 private:
  const Exact_view& view_;
  const Pixel_centres& centres_;
  Image_places places_;
};

/// Parts of surfaces in an image, and the rows that they make.
class Image_parts {
 public:
  /// Pre: the view outlives them.
  Image_parts(const Exact_view& view, const Pixel_view& pixels)
      : centres_(pixels), place_(view, centres_), height_(pixels.height), width_(pixels.width) {}
  Image_parts(const Image_parts&) = delete;
  Image_parts& operator=(const Image_parts&) = delete;

  /// Parts that show something; shown(i) is what part i adds to a pixel that it covers. In parallel.
  template <class Shown>
  void add(const Visible_surface<Exact_view>& surface, Shown shown) {
    std::vector<Image_point>& corners = corners_.emplace_back(surface.rays.size());
    const std::size_t before = polygons_.size();
    polygons_.resize(before + surface.parts.size());
    parallel_for(surface.parts.size(), [&](std::size_t i) {
      const auto& part = surface.parts[i];
      if (part.piece == surface.nothing) return;
      Image_polygon polygon{{&corners[part.first], part.size}, shown(i), double(height_), 0};
      for (std::size_t k = part.first; k < part.first + part.size; ++k) {
        corners[k] = place_(surface.rays[k]);
        polygon.top = std::min(polygon.top, corners[k][1]);
        polygon.bottom = std::max(polygon.bottom, corners[k][1]);
      }
      polygons_[before + i] = polygon;
    });
  }

  /// Each row once. In parallel.
  void draw(const std::function<void(const Mean_row&)>& visit, const Image_options& options) const {
    const std::vector<std::vector<std::uint32_t>> bands = polygons_of_bands();
    std::size_t done = 0;
    std::mutex mutex;
    parallel_for(bands.size(), [&](std::size_t band) {
      std::vector<Row_edge> edges;
      std::vector<Colour> sums(width_);
      std::vector<double> covered(width_);
      for (std::size_t y = band * rows; y < std::min<std::size_t>((band + 1) * rows, height_); ++y) {
        std::fill(sums.begin(), sums.end(), Colour{});
        std::fill(covered.begin(), covered.end(), 0);
        for (const std::uint32_t i : bands[band]) Row{double(y), sums, covered}.add(polygons_[i], edges);
        visit({static_cast<std::uint32_t>(y), sums, covered});
      }
      if (!options.progress) return;
      const std::lock_guard lock(mutex);
      options.progress(++done, bands.size());
    });
  }

 private:
  static constexpr std::size_t rows = 16;  // of a band

  std::vector<std::vector<std::uint32_t>> polygons_of_bands() const {
    const std::size_t count = (height_ + rows - 1) / rows;
    std::vector<std::vector<std::uint32_t>> bands(count);
    for (std::uint32_t i = 0; i < polygons_.size(); ++i) {
      if (!(polygons_[i].top < polygons_[i].bottom)) continue;
      const auto last = std::min(static_cast<std::size_t>(polygons_[i].bottom) / rows, count - 1);
      for (auto band = static_cast<std::size_t>(std::max(polygons_[i].top, 0.0)) / rows; band <= last; ++band)
        bands[band].push_back(i);
    }
    return bands;
  }

  const Pixel_centres centres_;
  const Corners place_;
  const std::uint32_t height_, width_;
  std::vector<std::vector<Image_point>> corners_;  // of each surface
  std::vector<Image_polygon> polygons_;            // nothing where a part shows nothing
};

}  // namespace

}  // namespace image_detail

std::vector<std::array<Integer, 3>> field_of(const Pixel_view& pixels) {
  std::vector<Exact_point> rays{pixels.direction(-1, 1), pixels.direction(1, 1), pixels.direction(1, -1),
                                pixels.direction(-1, -1)};
  // Where right, up and look turn the other way, the image is a mirror's.
  if (sgn(dot(exact(pixels.look), cross(exact(pixels.right), exact(pixels.up)))) > 0)
    std::reverse(rays.begin(), rays.end());
  return field_of(rays);
}

void visible_means(const Exact_view& view, const Visible_surface<Exact_view>& surface, const Pixel_view& pixels,
                   const std::function<Colour(std::uint32_t piece)>& colour,
                   const std::function<void(const Mean_row&)>& visit, const Image_options& options) {
  using namespace image_detail;
  run_with_threads_for(options, pixels, view.scene().pieces().size(), [&] {
    Image_parts parts(view, pixels);
    parts.add(surface, [&](std::size_t i) { return Layer{colour(surface.parts[i].piece), 1}; });
    parts.draw(visit, options);
  });
}

void blended_means(const Exact_view& view, const Pixel_view& pixels, const std::vector<Tint>& tints,
                   const std::function<void(const Mean_row&)>& visit, const Image_options& options) {
  using namespace image_detail;
  check_tints(tints, view.scene().pieces().size());
  std::vector<double> alpha;
  for (const Tint& tint : tints) alpha.push_back(tint.alpha);
  run_with_threads_for(options, pixels, view.scene().pieces().size(), [&] {
    Image_parts parts(view, pixels);
    const auto add = [&](const Visible_layer& layer) {
      parts.add(layer.surface, [&](std::size_t i) {
        const Tint& tint = tints[layer.surface.parts[i].piece];
        Layer shown;
        shown.put_behind({tint.colour, layer.light[i] * tint.alpha});
        return shown;
      });
    };
    visible_layers(view, Piece_boxes(view.scene()), field_of_view(view), alpha, add,
                   {options.threads, options.progress});
    parts.draw(visit, options);
  });
}

Mean_image Mean_image::empty(const Pixel_view& pixels) {
  const std::size_t size = std::size_t{pixels.width} * pixels.height;
  return {pixels.width, pixels.height, std::vector<Colour>(size), std::vector<double>(size)};
}
void Mean_image::set(const Mean_row& row) {
  const auto first = static_cast<std::ptrdiff_t>(std::size_t{row.y} * width);
  std::copy(row.colours.begin(), row.colours.end(), colours.begin() + first);
  std::copy(row.covered.begin(), row.covered.end(), covered.begin() + first);
}

Mean_image visible_means(const Exact_view& view, const Visible_surface<Exact_view>& surface, const Pixel_view& pixels,
                         const std::function<Colour(std::uint32_t piece)>& colour, const Image_options& options) {
  Mean_image image = Mean_image::empty(pixels);
  visible_means(
      view, surface, pixels, colour, [&](const Mean_row& row) { image.set(row); }, options);
  return image;
}
Mean_image blended_means(const Exact_view& view, const Pixel_view& pixels, const std::vector<Tint>& tints,
                         const Image_options& options) {
  Mean_image image = Mean_image::empty(pixels);
  blended_means(
      view, pixels, tints, [&](const Mean_row& row) { image.set(row); }, options);
  return image;
}

}  // namespace sightline
