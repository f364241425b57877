#pragma once
// Polygons that are painted, as cones of directions in the numbers of a kernel.

#include <sightline/algorithms/image/bands.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/image/pixel_cones.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline::image_detail {

/// Polygons in their order, without those in whose plane the eye is, or that the kernel's numbers cannot hold.
class Painted_cones {
 public:
  /// Pre: the centres outlive them. Parallel. Exact: as the kernel is.
  Painted_cones(const std::vector<Painted_polygon>& polygons, const Pixel_centres& centres, Image_kernel kernel,
                const Image_options& options);
  /// The parts of a surface that show something, in their order. Pre: view, surface and centres outlive them. Parallel.
  /// Exact: yes.
  Painted_cones(const Exact_view& view, const Visible_surface<Exact_view>& surface, const Pixel_centres& centres,
                const Image_options& options);
  /// The same in the numbers of the view, without those that have fewer than three different rays, or one behind the
  /// eye. Exact: no.
  template <class Number>
  Painted_cones(const Number_view<Number>& view, const Visible_surface<Number_view<Number>>& surface,
                const Pixel_centres& centres, const Image_options& options);
  Painted_cones(const Painted_cones&) = delete;
  Painted_cones& operator=(const Painted_cones&) = delete;

  const Pixel_cones& cones() const { return cones_; }
  std::uint32_t piece(std::uint32_t cone) const { return pieces_[cone]; }

  /// Which of the centres on its border a polygon has: all, or those of Pixel_cones::holds_beside().
  enum class Border { whole, half };
  /// visit(pixel, piece) for what each polygon covers, in their order at each pixel. Returns what it took.
  template <class Visit>
  Image_counters paint(Border border, const Image_options& options, Visit visit) const;

 private:
  void add_exactly(const std::vector<Painted_polygon>& polygons, const Image_options& options);
  template <class Number>
  void add_in(const std::vector<Painted_polygon>& polygons, const Image_options& options);

  std::size_t left_out_ = 0;
  std::vector<std::uint32_t> pieces_;
  std::vector<std::vector<std::array<Integer, 3>>> normals_;  // of each cone's edges, inwards; where numbers are exact
  Pixel_cones cones_;
};

template <class Visit>
Image_counters Painted_cones::paint(Border border, const Image_options& options, Visit visit) const {
  Image_counters sum = draw_bands(bands_of(cones_), options, [&](const Band& band, Image_counters& counters) {
    const std::size_t width = cones_.centres().view().width;
    for (const std::uint32_t cone : band.cones)
      for (std::int64_t y = std::max<std::int64_t>(band.top, cones_[cone].top);
           y < std::min<std::int64_t>(band.bottom, cones_[cone].bottom); ++y)
        cones_.row(cone, y, counters, [&](std::int64_t x, bool on_border) {
          if (on_border && border == Border::half && !cones_.holds_beside(cone, x, y, counters)) return;
          visit(static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x), pieces_[cone]);
        });
  });
  sum.edge_on = left_out_;
  sum.drawn = cones_.size();
  return sum;
}

}  // namespace sightline::image_detail
