#include <sightline/algorithms/image/centres.h>

#include <sightline/algorithms/image/bands.h>
#include <sightline/algorithms/image/image_faces.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace sightline {

namespace image_detail {

namespace {

/// What was met first so far at a centre.
struct Met {
  Nearness nearness;
  bool tied = false;
};

/// A band as its faces change it, and how near what is met in each of its tiles is at least: what is behind that is
/// passed over.
class Drawn_band {
 public:
  Drawn_band(const Image_faces& faces, const Band& band, Image_counters& counters)
      : faces_(faces),
        band_(band),
        counters_(counters),
        width_(faces.centres().view().width),
        met_(static_cast<std::size_t>(width_ * (band.bottom - band.top))),
        tiles_(place(width_ - 1) + 1),
        is_passed_over_(tiles_.size()) {}

  void draw(std::uint32_t face) {
    const Pixel_cones::Cone& cone = faces_.cones()[face];
    const Rows rows{std::max<std::int64_t>(cone.top, band_.top), std::min<std::int64_t>(cone.bottom, band_.bottom)};
    if (is_hidden(face, rows)) return;  // in all tiles; in others, is_passed_over_
    const Pixel_form& form = faces_.nearness(face);
    for (std::int64_t y = rows.top; y < rows.bottom; ++y) {
      const double k = form.at_row(faces_.centres().upwards(y));
      faces_.cones().row(face, y, counters_, [&](std::int64_t x, bool on_border) {
        const std::size_t tile = place(x);
        if (is_passed_over_[tile] != 0) return;
        Met& met = entry(x, y);
        const Nearness here{form.a * faces_.centres().across(x) + k, form.bound, face};
        const int nearer =
            met.nearness.face == Nearness::nothing ? 1 : faces_.nearer(here, met.nearness, x, y, counters_);
        if (nearer > 0 || (nearer == 0 && faces_.before(face, met.nearness.face))) {
          met = {here, on_border};
          ++tiles_[tile].changes;
        }
        if (nearer == 0) met.tied = true;
      });
    }
  }

  const Met& at(std::int64_t x, std::int64_t y) const {
    return met_[static_cast<std::size_t>((y - band_.top) * width_ + x)];
  }

 private:
  static constexpr std::int64_t tile_width = 16;
  struct Rows {
    std::int64_t top, bottom;
  };
  struct Tile {
    bool is_full = false;         // something is met at each of its centres: no farther than this
    double least = 0, bound = 0;  // of 1 / t
    std::int64_t changes = 0;     // since then: it is nearer, if anything
  };

  Met& entry(std::int64_t x, std::int64_t y) { return met_[static_cast<std::size_t>((y - band_.top) * width_ + x)]; }

  static std::size_t place(std::int64_t x) { return static_cast<std::size_t>(x) / std::size_t{tile_width}; }

  /// Whether it is farther than what is met in all tiles that it may reach, and in which of them: nearer() would say so
  /// at each centre, since rounding is monotone.
  bool is_hidden(std::uint32_t face, const Rows& rows) {
    const Pixel_cones::Cone& cone = faces_.cones()[face];
    const Pixel_form& form = faces_.nearness(face);
    const double k = form.at_row(faces_.centres().upwards(form.b > 0 ? rows.top : rows.bottom - 1));
    bool everywhere = true;
    for (std::int64_t left = cone.left / tile_width * tile_width; left < cone.right; left += tile_width) {
      const Tile& tile = looked_at(left);
      const std::int64_t x = form.a > 0 ? std::min<std::int64_t>(cone.right, left + tile_width) - 1
                                        : std::max<std::int64_t>(cone.left, left);
      const double nearest = form.a * faces_.centres().across(x) + k;
      const bool is_behind = tile.is_full && tile.least - nearest > form.bound + tile.bound;
      is_passed_over_[place(left)] = is_behind ? 1 : 0;
      everywhere &= is_behind;
    }
    return everywhere;
  }

  /// The tile that begins at a column; looked through again where as much has changed as there are centres.
  const Tile& looked_at(std::int64_t left) {
    Tile& tile = tiles_[place(left)];
    const std::int64_t right = std::min(left + tile_width, width_);
    if (tile.changes < (right - left) * (band_.bottom - band_.top)) return tile;
    tile = {true, std::numeric_limits<double>::infinity(), 0, 0};
    for (std::int64_t y = band_.top; y < band_.bottom && tile.is_full; ++y)
      for (std::int64_t x = left; x < right; ++x) {
        const Nearness& nearness = at(x, y).nearness;
        tile.is_full &= nearness.face != Nearness::nothing;
        tile.least = std::min(tile.least, nearness.value);
        tile.bound = std::max(tile.bound, nearness.bound);
      }
    return tile;
  }

  const Image_faces& faces_;
  const Band& band_;
  Image_counters& counters_;
  const std::int64_t width_;
  std::vector<Met> met_;
  std::vector<Tile> tiles_;
  std::vector<std::uint8_t> is_passed_over_;  // tiles, for the face that is drawn
};

/// The faces of a band; nearest in the middle of their boxes first, where these cover it several times.
std::vector<std::uint32_t> in_order(const Image_faces& faces, const Band& band) {
  constexpr std::int64_t often = 4;
  std::int64_t covered = 0;
  std::vector<std::pair<double, std::uint32_t>> all;
  for (const std::uint32_t face : band.cones) {
    const Pixel_cones::Cone& cone = faces.cones()[face];
    const std::int64_t top = std::max<std::int64_t>(cone.top, band.top),
                       bottom = std::min<std::int64_t>(cone.bottom, band.bottom);
    covered += (bottom - top) * (cone.right - cone.left);
    all.emplace_back(-faces.nearness(face, (cone.left + cone.right) / 2, (top + bottom) / 2).value, face);
  }
  if (covered < often * faces.centres().view().width * (band.bottom - band.top)) return band.cones;
  std::sort(all.begin(), all.end());
  std::vector<std::uint32_t> sorted;
  for (const auto& [nearness, face] : all) sorted.push_back(face);
  return sorted;
}

Piece_image image_at_centres(const Image_faces& faces, const Image_options& options) {
  Piece_image image = faces.empty_image();
  image.tied.assign(image.pieces.size(), 0);
  image.counters += draw_bands(bands_of(faces.cones()), options, [&](const Band& band, Image_counters& counters) {
    Drawn_band drawn(faces, band, counters);
    for (const std::uint32_t face : in_order(faces, band)) drawn.draw(face);
    for (std::int64_t y = band.top; y < band.bottom; ++y)
      for (std::uint32_t x = 0; x < image.width; ++x) {
        const Met& met = drawn.at(x, y);
        if (met.nearness.face == Nearness::nothing) continue;
        const std::size_t at = image.pixel(x, static_cast<std::uint32_t>(y));
        image.pieces[at] = faces.piece(met.nearness.face);
        image.tied[at] = met.tied;
      }
  });
  return image;
}

}  // namespace

}  // namespace image_detail

Piece_image centres(const Exact_view& view, const Pixel_view& pixels, const Image_options& options) {
  Piece_image image;
  image_detail::run_with_threads_for(options, pixels, view.scene().pieces().size(), [&] {
    image = image_detail::image_at_centres(image_detail::Image_faces(view, pixels, options), options);
  });
  return image;
}

}  // namespace sightline
