#pragma once
// An image of which each pixel names a piece of the scene.

#include <sightline/kernel/counters.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline {

struct Image_counters {
  std::uint64_t edge_on = 0;  ///< pieces not seen: the eye is in their plane, or numbers do not hold them
  std::uint64_t drawn = 0;    ///< polygons of which some centre was looked at
  std::uint64_t centres = 0;  ///< polygons at pixel centres
  std::uint64_t exact_sides = 0, exact_depths = 0;     ///< signs that doubles left open
  std::uint64_t spans = 0;                             ///< of rows, in which faces were compared: scan_line
  std::uint64_t windows = 0;                           ///< looked at: warnock
  std::uint64_t swaps = 0, splits = 0, unordered = 0;  ///< of polygons, as in Newell_counters: newell
  /// Each by its key in reports.
  template <class Visit>
  static void each(Visit visit) {
    visit("edge_on", &Image_counters::edge_on);
    visit("drawn", &Image_counters::drawn);
    visit("centres", &Image_counters::centres);
    visit("exact_sides", &Image_counters::exact_sides);
    visit("exact_depths", &Image_counters::exact_depths);
    visit("spans", &Image_counters::spans);
    visit("windows", &Image_counters::windows);
    visit("swaps", &Image_counters::swaps);
    visit("splits", &Image_counters::splits);
    visit("unordered", &Image_counters::unordered);
  }
};

/// The piece that each pixel shows, row by row from the top left.
struct Piece_image {
  static constexpr std::uint32_t nothing = ~std::uint32_t{0};

  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> pieces;
  std::vector<std::uint8_t> tied;  ///< 1 where a rule had to choose; empty where nobody asks
  Image_counters counters;

  std::size_t pixel(std::uint32_t x, std::uint32_t y) const { return std::size_t{y} * width + x; }
};

}  // namespace sightline
