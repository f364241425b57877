#pragma once
// Convex cones of directions against the pixel centres of an image: which are inside, row by row; doubles with a bound
// first, then integers.

#include <sightline/algorithms/image/piece_image.h>
#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/pixel_view.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace sightline::image_detail {

/// The centres of an image: in doubles, and as integer vectors.
class Pixel_centres {
 public:
  /// Errors: std::invalid_argument unless there are 1 to 2^20 pixels each way, directions are finite, and they span the
  /// space.
  explicit Pixel_centres(const Pixel_view& view);

  const Pixel_view& view() const { return view_; }
  double across(std::int64_t x) const { return static_cast<double>(2 * x + 1 - view_.width) / view_.width; }
  double upwards(std::int64_t y) const {
    return static_cast<double>(std::int64_t{view_.height} - 2 * y - 1) / view_.height;
  }
  /// No less than the pixel at a place from -1 to 1, where it is beside the image no farther than two pixels.
  std::int64_t column(double across) const;
  /// A positive multiple of the direction.
  std::array<Integer, 3> exact(std::int64_t x, std::int64_t y) const;
  /// 1 where a plane through the eye and a centre is in front of what lies beside that centre to the right, or, where
  /// that is in the plane too, above it; else -1. Pre: not all zero.
  int beside(const std::array<Integer, 3>& normal) const;
  /// The place of a direction in the image, across and upwards; nothing where it is not well before the eye.
  struct Place {
    double across, upwards;
    double error;  ///< of each, where they are from -1 to 1
  };
  /// `error`: of each coordinate of the direction.
  std::optional<Place> place(const Approximate_vector& direction, double error) const;
  /// At least the sum of magnitudes of each coordinate, over look, right and up.
  double size() const { return size_; }

 private:
  Pixel_view view_;
  std::array<Integer, 3> look_, right_, up_;  // for centres 2 x + 1 - width and height - 2 y - 1
  std::array<double, 3> to_look_{}, to_right_{}, to_up_{};
  double size_ = 0;
  double skewness_ = 0, longest_ = 0;  // product of lengths by volume; of 1 / length
  bool has_places_ = false;
};

/// A linear form of directions at places of the image: a across + b upwards + c, up to `bound` for all of them, the
/// rounding of that line included; infinite, and the rest 0, where doubles cannot hold it. Proof: P-80
struct Pixel_form {
  double a, b, c, bound;

  Pixel_form(double across, double upwards, double constant, double within)
      : a(across), b(upwards), c(constant), bound(within) {}
  Pixel_form(const Pixel_centres& centres, const Approximate_eye_plane& plane);
  double at_row(double upwards) const { return b * upwards + c; }
};

/// The columns [first, last) of a row in which a cone may be, and those [inner_first, inner_last) in which it is.
struct Pixel_span {
  std::int64_t first, last, inner_first, inner_last;

  /// Of what is left, where the form, `k` at the middle of the row, is not negative.
  void narrow(const Pixel_centres& centres, const Pixel_form& form, double k);
};

/// Cones, each with its number, and the rows of the image that it may reach.
class Pixel_cones {
 public:
  /// The normal, inwards, of a cone's edge: what is asked where doubles do not tell.
  using Exact_normal = std::function<std::array<Integer, 3>(std::uint32_t cone, std::uint32_t edge)>;

  struct Cone {
    std::size_t first_edge;
    std::uint32_t edges;
    std::int32_t left, right, top, bottom;  ///< columns [left, right), rows [top, bottom)
  };

  Pixel_cones(const Pixel_centres& centres, Exact_normal exact_normal)
      : centres_(&centres), exact_normal_(std::move(exact_normal)) {}

  const Pixel_centres& centres() const { return *centres_; }
  std::size_t size() const { return cones_.size(); }
  const Cone& operator[](std::size_t i) const { return cones_[i]; }

  /// Begins a cone with the directions of its corners, to a relative 2^-40; its edges may be off by so many pixels
  /// more. False where it holds no centre, whatever its edges are. Proof: P-80
  bool add(const std::vector<Approximate_vector>& corners, double beyond = 0);
  /// One more edge of the cone begun last.
  void add_edge(const Pixel_form& form) {
    edges_.push_back(form);
    ++cones_.back().edges;
  }
  /// Other cones behind these.
  void append(const Pixel_cones& others);
  std::span<const Pixel_form> edges(std::uint32_t cone) const {
    return {edges_.data() + cones_[cone].first_edge, cones_[cone].edges};
  }

  /// 1 where a centre is inside one edge, 0 on it, -1 outside. Exact: as the edges and exact_normal are.
  int side(std::uint32_t cone, std::uint32_t edge, std::int64_t x, std::int64_t y, Image_counters& counters) const;
  /// The columns [first, last) of the centres of row y in the closed cone. Exact: as side() is.
  struct Columns {
    std::int64_t first, last;
  };
  Columns columns(std::uint32_t cone, std::int64_t y, Image_counters& counters) const;

  /// Whether a centre of the closed cone is in it still when it is moved to the right by next to nothing, and upwards
  /// by next to nothing of that: of cones that share out a larger one, exactly one holds it then. Exact: as side() is.
  bool holds_beside(std::uint32_t cone, std::int64_t x, std::int64_t y, Image_counters& counters) const;

  /// visit(x, on_border) for the centres of row y in the closed cone, from left to right. Exact: as the edges and
  /// exact_normal are.
  template <class Visit>
  void row(std::uint32_t cone, std::int64_t y, Image_counters& counters, Visit visit) const {
    const Pixel_span span = narrowed(cone, y);
    if (span.first >= span.last) return;
    counters.centres += static_cast<std::uint64_t>(span.last - span.first);
    const auto one_by_one = [&](std::int64_t from, std::int64_t to) {
      for (std::int64_t x = from; x < to; ++x)
        if (const int inside = side(cone, x, y, counters); inside >= 0) visit(x, inside == 0);
    };
    one_by_one(span.first, span.inner_first);
    for (std::int64_t x = span.inner_first; x < span.inner_last; ++x) visit(x, false);
    one_by_one(span.inner_last, span.last);
  }

 private:
  /// The columns of a row that doubles leave, and those of which they are sure.
  Pixel_span narrowed(std::uint32_t cone, std::int64_t y) const;
  /// 1 inside, 0 on the border, -1 outside.
  int side(std::uint32_t cone, std::int64_t x, std::int64_t y, Image_counters& counters) const;

  const Pixel_centres* centres_;
  Exact_normal exact_normal_;
  std::vector<Cone> cones_;
  std::vector<Pixel_form> edges_;
};

}  // namespace sightline::image_detail
