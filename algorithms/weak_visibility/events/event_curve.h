#pragma once
// Event lines: those of a pencil, and the rulings of a quadric that touch three skew edges. Each as a curve of lines
// with a parameter in (0, 1).

#include <sightline/algorithms/weak_visibility/events/event_cells.h>
#include <sightline/algorithms/weak_visibility/events/event_lines.h>
#include <sightline/algorithms/weak_visibility/events/homogeneous.h>
#include <sightline/algorithms/weak_visibility/events/quadratic_roots.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sightline {

/// A point that is not in a plane. Pre: the plane is not zero.
Homogeneous off_plane(const Homogeneous& plane);

enum class Event_kind : char { horizon, edge_vertex, triple };

/// A part of a curve in doubles. Its lines are sums of these, times x^2, x y and y^2 for x, y >= 0, x + y = 1; so where
/// all three are on one side of a line, all of the part is.
struct Near_part {
  std::array<Near<6>, 3> lines;
  /// Of three skew edges: the planes with the second and with the third, at both ends; between these sums times x and
  /// y.
  std::array<std::array<Near<4>, 2>, 2> planes;
  /// The side on which all of it passes a line: 1, -1; 0: on both; nothing where doubles do not tell.
  std::optional<int> course(const Near<6>& line) const;
  std::array<Near_part, 2> halves() const;
};

inline std::optional<int> Near_part::course(const Near<6>& line) const {
  // One bound for the three of them.
  const auto& [a, b, c] = lines;
  const Near<6> worst{{}, std::max({a.size, b.size, c.size}), std::max({a.error, b.error, c.error})};
  const double error = homogeneous_detail::error_of_products(6, worst, line);
  int sides[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<double, 6>&x = lines[k].at, &y = line.at;
    const double value = -(x[0] * y[3] + x[1] * y[4] + x[2] * y[5] + x[3] * y[0] + x[4] * y[1] + x[5] * y[2]);
    sides[k] = (value > error) - (value < -error);
  }
  const int sum = sides[0] + sides[1] + sides[2];
  if (sum == 3 || sum == -3) return sum / 3;
  const bool both = sides[0] * sides[1] < 0 || sides[1] * sides[2] < 0 || sides[0] * sides[2] < 0;
  return both ? std::optional(0) : std::nullopt;
}

/// A curve of lines l[0] + l[1] s + l[2] s^2, 0 < s < 1: in doubles at once, in integers when asked for.
class Event_curve {
 public:
  using Lines = std::array<Exact_pluecker, 3>;
  Event_curve(Event_kind kind, const Near_part& near) : kind_(kind), near_(near) {}
  virtual ~Event_curve() = default;
  Event_kind kind() const { return kind_; }
  /// All of it. The parameter is another one, signs are those of the exact lines.
  const Near_part& near() const { return near_; }
  /// Whether surely no line of a part touches the edges between their ends. In doubles.
  virtual bool is_off(const Near_part&) const { return false; }
  const Lines& lines() const {
    if (!lines_) lines_ = exact_lines();
    return *lines_;
  }
  /// The skew edges that it is made of: none for pencils.
  virtual std::span<const std::uint32_t> edges() const { return {}; }
  virtual Event_chart chart(const Rational& s) const = 0;
  /// Parameters where what is touched changes otherwise than by sides.
  virtual std::vector<Quadratic> ends(std::span<const Event_lines::Event_line> lines) const = 0;

 protected:
  Event_curve(const Event_curve&) = default;
  Event_curve& operator=(const Event_curve&) = default;

 private:
  virtual Lines exact_lines() const = 0;

  Event_kind kind_;
  Near_part near_;
  mutable std::optional<Lines> lines_;
};

/// The lines through a point in a plane, to the points of a segment of that plane: from `first` to `last`. Refers to
/// them. Pre: the point is not on the segment's line.
class Event_pencil final : public Event_curve {
 public:
  Event_pencil(Event_kind kind, const Filtered& vertex, const Homogeneous& plane,
               const std::array<Filtered, 2>& segment);
  Event_chart chart(const Rational& s) const override;
  /// Where a line of it is one of the lines, or in the plane of two through the point, or meets two of the plane in one
  /// point.
  std::vector<Quadratic> ends(std::span<const Event_lines::Event_line> lines) const override;

 private:
  Lines exact_lines() const override;
  Homogeneous step() const;

  const Filtered* vertex_;
  const Homogeneous* plane_;
  const std::array<Filtered, 2>* segment_;
};

/// The lines through the points x(s) = (1 - s) hull[0] + s hull[1] of an edge that touch two others: in the planes of
/// x(s) with these (Plantinga's Eq. 1). Refers to them. Pre: pairwise skew.
class Event_regulus final : public Event_curve {
 public:
  using Edge = Event_lines::Event_line;
  Event_regulus(std::span<const Edge> lines, const std::array<std::uint32_t, 3>& edges);

  bool is_off(const Near_part& part) const override;
  /// The parameters for which lines touch the edges between their ends. Exact: yes
  std::vector<Parameter_range> touching() const;

  std::span<const std::uint32_t> edges() const override { return edges_; }
  Event_chart chart(const Rational& s) const override;
  std::vector<Quadratic> ends(std::span<const Event_lines::Event_line>) const override { return {}; }

 private:
  Lines exact_lines() const override;
  /// The planes of hull[0], and of hull[1] - hull[0], with the other edges.
  struct Planes {
    Homogeneous step, b0, b1, c0, c1;
  };
  const Planes& planes() const;

  std::array<std::uint32_t, 3> edges_;
  const Edge *a_, *b_, *c_;
  mutable std::optional<Planes> planes_;
};

}  // namespace sightline
