#include <sightline/algorithms/image/warnock.h>

#include <sightline/algorithms/image/bands.h>
#include <sightline/algorithms/image/image_faces.h>
#include <sightline/kernel/threads.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace sightline {

namespace image_detail {

namespace {

/// The centres of columns [left, right) and rows [top, bottom).
struct Pixel_window {
  std::int64_t left, right, top, bottom;

  std::int64_t pixels() const { return (right - left) * (bottom - top); }
  /// sign_at(x, y) at the four corners: the least and the most.
  template <class Sign_at>
  std::pair<int, int> signs(Sign_at sign_at) const {
    return std::minmax(
        {sign_at(left, top), sign_at(right - 1, top), sign_at(left, bottom - 1), sign_at(right - 1, bottom - 1)});
  }
};

/// Where a face is with respect to a window.
enum class Place { surrounds, meets, disjoint };

/// The faces that come down to a window.
struct Listed {
  std::vector<std::uint32_t> surrounders;
  std::vector<std::uint32_t> others;  ///< contained in it, or intersecting it
};

class Warnock {
 public:
  Warnock(const Image_faces& faces, const Image_options& options, Piece_image& image)
      : faces_(faces), options_(options), image_(image) {}

  Image_counters draw() {
    Listed all;
    for (std::uint32_t face = 0; face < faces_.size(); ++face) all.others.push_back(face);
    return subdivide({0, image_.width, 0, image_.height}, all, 0);
  }

 private:
  static constexpr int parallel_levels = 4;

  Image_counters subdivide(const Pixel_window& window, const Listed& above, int level) {
    Image_counters counters;
    ++counters.windows;
    // 1. What surrounds it, and what meets it.
    Listed listed{above.surrounders, {}};
    for (const std::uint32_t face : above.others) {
      const Place place = place_of(face, window, counters);
      if (place == Place::surrounds) listed.surrounders.push_back(face);
      if (place == Place::meets) listed.others.push_back(face);
    }
    // 2. Without what is behind the surrounder that is first at a corner.
    std::uint32_t first = Nearness::nothing;
    if (!listed.surrounders.empty()) {
      first = faces_.first_of(listed.surrounders, window.left, window.top, counters).face;
      const auto is_hidden = [&](std::uint32_t face) {
        return face != first && is_before(first, face, window, counters);
      };
      std::erase_if(listed.surrounders, is_hidden);
      std::erase_if(listed.others, is_hidden);
    }
    // 3. Nothing, one surrounder in front of all else, or a single pixel; or four windows.
    const bool is_decided = window.pixels() == 1 || (listed.others.empty() && listed.surrounders.size() <= 1);
    if (!is_decided) counters += quarter(window, listed, level);
    else if (first != Nearness::nothing) fill(window, faces_.piece(first));
    if (level == parallel_levels || (is_decided && level < parallel_levels)) report(window);
    return counters;
  }

  Image_counters quarter(const Pixel_window& window, const Listed& listed, int level) {
    const std::int64_t x = (window.left + window.right) / 2, y = (window.top + window.bottom) / 2;
    const std::array<Pixel_window, 4> quarters{{{window.left, x, window.top, y},
                                                {x, window.right, window.top, y},
                                                {window.left, x, y, window.bottom},
                                                {x, window.right, y, window.bottom}}};
    std::array<Image_counters, 4> counters;
    const auto subdivide_one = [&](std::size_t k) {
      if (quarters[k].pixels() > 0) counters[k] = subdivide(quarters[k], listed, level + 1);
    };
    if (level < parallel_levels) {
      parallel_for(4, subdivide_one);
    } else {
      for (std::size_t k = 0; k < 4; ++k) subdivide_one(k);
    }
    Image_counters sum;
    for (const Image_counters& its : counters) sum += its;
    return sum;
  }

  /// By the signs of its edges at the corners: convex is the window, and the cone.
  Place place_of(std::uint32_t face, const Pixel_window& window, Image_counters& counters) const {
    const Pixel_cones::Cone& cone = faces_.cones()[face];
    if (cone.right <= window.left || window.right <= cone.left || cone.bottom <= window.top ||
        window.bottom <= cone.top)
      return Place::disjoint;
    Place place = Place::surrounds;
    const std::span<const Pixel_form> edges = faces_.cones().edges(face);
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      const auto [least, most] = signs(edges[e], window, [&](std::int64_t x, std::int64_t y) {
        return faces_.cones().side(face, e, x, y, counters);
      });
      if (most < 0) return Place::disjoint;
      if (least < 0) place = Place::meets;
    }
    return place;
  }

  /// Whether the plane of one face is met before that of another one in all of a window.
  bool is_before(std::uint32_t one, std::uint32_t other, const Pixel_window& window, Image_counters& counters) const {
    const Pixel_form &f = faces_.nearness(one), &g = faces_.nearness(other);
    const auto [least, most] =
        signs({f.a - g.a, f.b - g.b, f.c - g.c, f.bound + g.bound}, window, [&](std::int64_t x, std::int64_t y) {
          return faces_.nearer(faces_.nearness(one, x, y), faces_.nearness(other, x, y), x, y, counters);
        });
    return least > 0 || (least == 0 && faces_.before(one, other));
  }

  /// The least and the most sign of a form at the corners of a window: by doubles, or sign_at(x, y).
  template <class Sign_at>
  std::pair<int, int> signs(const Pixel_form& form, const Pixel_window& window, Sign_at sign_at) const {
    const Pixel_centres& centres = faces_.centres();
    const double left = centres.across(window.left), right = centres.across(window.right - 1);
    const double over = form.at_row(centres.upwards(window.top)),
                 under = form.at_row(centres.upwards(window.bottom - 1));
    const double least = form.a * (form.a > 0 ? left : right) + std::min(over, under),
                 most = form.a * (form.a > 0 ? right : left) + std::max(over, under);
    if (least > form.bound) return {1, 1};
    if (most < -form.bound) return {-1, -1};
    if (least < -form.bound && most > form.bound) return {-1, 1};
    return window.signs(sign_at);
  }

  void fill(const Pixel_window& window, std::uint32_t piece) {
    for (std::int64_t y = window.top; y < window.bottom; ++y)
      std::fill_n(image_.pieces.begin() + y * image_.width + window.left, window.right - window.left, piece);
  }

  void report(const Pixel_window& window) {
    if (!options_.progress) return;
    const std::lock_guard lock(mutex_);
    done_ += static_cast<std::size_t>(window.pixels());
    options_.progress(done_, image_.pieces.size());
  }

  const Image_faces& faces_;
  const Image_options& options_;
  Piece_image& image_;
  std::mutex mutex_;
  std::size_t done_ = 0;  // pixels
};

}  // namespace

}  // namespace image_detail

Piece_image warnock(const Scene& scene, const Pixel_view& pixels, Image_kernel kernel, const Image_options& options) {
  using namespace image_detail;
  Piece_image image;
  run_with_threads_for(options, pixels, scene.pieces().size(), [&] {
    const Image_faces faces(scene, pixels, kernel, options);
    image = faces.empty_image();
    image.counters += Warnock(faces, options, image).draw();
  });
  return image;
}

}  // namespace sightline
