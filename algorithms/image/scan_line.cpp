#include <sightline/algorithms/image/scan_line.h>

#include <sightline/algorithms/image/bands.h>
#include <sightline/algorithms/image/image_faces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sightline {

namespace image_detail {

namespace {

/// A face in a row: its two edges there have the centres of columns [first, last) between them.
struct Active {
  std::uint32_t face;
  std::int64_t first, last;
};
/// Columns [first, last) of a row.
struct Span {
  std::int64_t first, last;
};

/// One band of rows, from top to bottom: show(faces that are there, columns, row) for each of its spans.
template <class Show>
class Scan_line {
 public:
  Scan_line(const Image_faces& faces, const Band& band, Image_counters& counters, Show& show)
      : cones_(faces.cones()), width_(faces.centres().view().width), band_(band), counters_(counters), show_(show) {}

  void draw() {
    make_table();
    for (std::int64_t y = band_.top; y < band_.bottom; ++y) {
      update_active(y);
      sort_active();
      sweep(y);
    }
  }

 private:
  /// Faces by the first row that they may reach.
  void make_table() {
    table_.resize(static_cast<std::size_t>(band_.bottom - band_.top));
    for (const std::uint32_t face : band_.cones) {
      const std::int64_t first = std::max<std::int64_t>(cones_[face].top, band_.top);
      if (first < cones_[face].bottom) table_[static_cast<std::size_t>(first - band_.top)].push_back(face);
    }
  }

  /// Those of row y: without faces that end above it, with those that begin in it, and where their edges are there.
  /// That is asked of the edges anew, as steps from row to row would add up their roundings.
  void update_active(std::int64_t y) {
    std::erase_if(active_, [&](const Active& active) { return cones_[active.face].bottom <= y; });
    for (const std::uint32_t face : table_[static_cast<std::size_t>(y - band_.top)]) active_.push_back({face, 0, 0});
    for (Active& active : active_) {
      const Pixel_cones::Columns columns = cones_.columns(active.face, y, counters_);
      active.first = columns.first;
      active.last = columns.last;
    }
  }

  /// From left to right, by insertion: they are nearly so from the row before.
  void sort_active() {
    for (std::size_t i = 1; i < active_.size(); ++i) {
      const Active moved = active_[i];
      std::size_t to = i;
      for (; to > 0 && active_[to - 1].first > moved.first; --to) active_[to] = active_[to - 1];
      active_[to] = moved;
    }
  }

  /// Spans in which the same faces are there, from left to right.
  void sweep(std::int64_t y) {
    there_.clear();
    std::size_t next = 0;
    for (std::int64_t x = 0;;) {
      // 1. What ends here, and what begins here.
      std::erase_if(there_, [&](const Active& active) { return active.last <= x; });
      if (there_.empty()) {
        if (next == active_.size()) return;
        x = std::max(x, active_[next].first);
      }
      for (; next < active_.size() && active_[next].first <= x; ++next)
        if (active_[next].last > x) there_.push_back(active_[next]);
      if (there_.empty()) continue;
      // 2. Up to where something ends or begins.
      std::int64_t last = next < active_.size() ? active_[next].first : width_;
      for (const Active& active : there_) last = std::min(last, active.last);
      show_(there_, Span{x, last}, y);
      x = last;
    }
  }

  const Pixel_cones& cones_;
  const std::int64_t width_;
  const Band& band_;
  Image_counters& counters_;
  Show& show_;
  std::vector<std::vector<std::uint32_t>> table_;  // of each row
  std::vector<Active> active_;                     // in this row
  std::vector<Active> there_;                      // in this span
};

/// A column inside a span: about where two faces cross, or in the middle. Any would do.
std::int64_t crossing(const Image_faces& faces, std::uint32_t left, std::uint32_t right, const Span& span,
                      std::int64_t y) {
  const Pixel_form &f = faces.nearness(left), &g = faces.nearness(right);
  const double upwards = faces.centres().upwards(y);
  const double across = (g.at_row(upwards) - f.at_row(upwards)) / (f.a - g.a);
  if (std::isfinite(across)) {
    const std::int64_t x = faces.centres().column(across);
    if (span.first < x && x < span.last) return x;
  }
  return span.first + (span.last - span.first) / 2;
}

using Two_faces = std::array<std::uint32_t, 2>;

/// A span, split as often as it takes: show(span) shows it, or gives two faces that come in different orders at its
/// ends.
class Split_spans {
 public:
  template <class Show>
  void each(const Image_faces& faces, const Span& whole, std::int64_t y, Show show) {
    left_.assign(1, whole);
    while (!left_.empty()) {
      const Span span = left_.back();
      left_.pop_back();
      const std::optional<Two_faces> two = show(span);
      if (!two) continue;
      const std::int64_t middle = crossing(faces, (*two)[0], (*two)[1], span, y);
      left_.push_back({middle, span.last});
      left_.push_back({span.first, middle});
    }
  }

 private:
  std::vector<Span> left_;
};

/// What is first at both ends of a span is first in all of it, as 1 / t is linear; else it is split, where the two
/// cross.
class Show_first {
 public:
  Show_first(const Image_faces& faces, Piece_image& image, Image_counters& counters)
      : faces_(faces), image_(image), counters_(counters) {}

  void operator()(const std::vector<Active>& there, const Span& whole, std::int64_t y) {
    split_.each(faces_, whole, y, [&](const Span& span) -> std::optional<Two_faces> {
      ++counters_.spans;
      const std::uint32_t left = first_at(there, span.first, y), right = first_at(there, span.last - 1, y);
      if (left != right) return Two_faces{left, right};
      std::fill_n(image_.pieces.begin() + y * image_.width + span.first, span.last - span.first, faces_.piece(left));
      return std::nullopt;
    });
  }

 private:
  std::uint32_t first_at(const std::vector<Active>& there, std::int64_t x, std::int64_t y) {
    if (there.size() == 1) return there[0].face;
    return faces_.first_of(there, x, y, counters_, &Active::face).face;
  }

  const Image_faces& faces_;
  Piece_image& image_;
  Image_counters& counters_;
  Split_spans split_;
};

/// The same of all layers down to one that hides all: they are in one order at both ends, or the span is split.
class Show_layers {
 public:
  Show_layers(const Image_faces& faces, const std::vector<Tint>& tints, Blended_image& image, Image_counters& counters)
      : faces_(faces), tints_(tints), image_(image), counters_(counters) {}

  void operator()(const std::vector<Active>& there, const Span& whole, std::int64_t y) {
    split_.each(faces_, whole, y, [&](const Span& span) -> std::optional<Two_faces> {
      ++counters_.spans;
      sort_at(there, span.first, y, left_);
      sort_at(there, span.last - 1, y, right_);
      const auto [left, right] = std::mismatch(left_.begin(), left_.end(), right_.begin(), right_.end());
      if (left != left_.end()) return Two_faces{*left, *right};
      Layer layer;
      for (const std::uint32_t face : left_) layer.put_behind(tints_[faces_.piece(face)]);
      std::fill_n(image_.layers.begin() + y * image_.width + span.first, span.last - span.first, layer);
      return std::nullopt;
    });
  }

 private:
  /// What is there, nearest first, up to what hides all.
  void sort_at(const std::vector<Active>& there, std::int64_t x, std::int64_t y, std::vector<std::uint32_t>& sorted) {
    sorted.clear();
    for (const Active& active : there) sorted.push_back(active.face);
    std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
      const int nearer = faces_.nearer(faces_.nearness(a, x, y), faces_.nearness(b, x, y), x, y, counters_);
      return nearer > 0 || (nearer == 0 && faces_.before(a, b));
    });
    counters_.centres += sorted.size();
    const auto hides_all = std::find_if(sorted.begin(), sorted.end(),
                                        [&](std::uint32_t face) { return tints_[faces_.piece(face)].alpha >= 1; });
    if (hides_all != sorted.end()) sorted.erase(hides_all + 1, sorted.end());
  }

  const Image_faces& faces_;
  const std::vector<Tint>& tints_;
  Blended_image& image_;
  Image_counters& counters_;
  Split_spans split_;
  std::vector<std::uint32_t> left_, right_;  // faces at a span's ends
};

/// All bands, each shown by show_of(its counters).
template <class Show_of>
Image_counters draw_spans(const Image_faces& faces, const Image_options& options, Show_of show_of) {
  return draw_bands(bands_of(faces.cones()), options, [&](const Band& band, Image_counters& counters) {
    auto show = show_of(counters);
    Scan_line(faces, band, counters, show).draw();
  });
}

}  // namespace

}  // namespace image_detail

Piece_image scan_line(const Scene& scene, const Pixel_view& pixels, Image_kernel kernel, const Image_options& options) {
  using namespace image_detail;
  Piece_image image;
  run_with_threads_for(options, pixels, scene.pieces().size(), [&] {
    const Image_faces faces(scene, pixels, kernel, options);
    image = faces.empty_image();
    image.counters +=
        draw_spans(faces, options, [&](Image_counters& counters) { return Show_first(faces, image, counters); });
  });
  return image;
}

Blended_image blended_scan_line(const Scene& scene, const Pixel_view& pixels, Image_kernel kernel,
                                const std::vector<Tint>& tints, const Image_options& options) {
  using namespace image_detail;
  check_tints(tints, scene.pieces().size());
  Blended_image image = Blended_image::empty(pixels);
  run_with_threads_for(options, pixels, scene.pieces().size(), [&] {
    const Image_faces faces(scene, pixels, kernel, options);
    image.counters = faces.counters();
    image.counters += draw_spans(faces, options,
                                 [&](Image_counters& counters) { return Show_layers(faces, tints, image, counters); });
  });
  return image;
}

}  // namespace sightline
