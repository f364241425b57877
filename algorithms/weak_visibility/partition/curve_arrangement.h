#pragma once
// What lines and conics divide a rectangle into, between upright lines through all places where their order may change.

#include <sightline/algorithms/weak_visibility/partition/plane_chart.h>
#include <sightline/algorithms/weak_visibility/partition/real_root.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sightline {

/// Dyadic.
struct Chart_box {
  double x0, x1, y0, y1;
};

/// low <= exact value <= high
struct Bounded {
  double low, high;
};

/// The doubles beside a number, or the number itself.
Bounded bounds_of(const Rational& x);

/// A part of a line that is not upright, from one x to a greater one.
struct Stretch {
  std::uint32_t curve;
  Rational from, to;
};

/// Whether a curve may meet a closed rectangle. In doubles: false where it surely does not.
bool may_meet(const Plane_curve& curve, const Chart_box& box);

/// Slabs, each between neighbours among the values of x at which a curve is upright, leaves the rectangle or meets
/// another one; in each slab arcs that do not meet, in order. Between arcs, and below and above them, are its sectors:
/// open, met by no curve, each with a rational point. Pre: curves are different components(). Cost: for n curves, n^2
/// resultants; n sectors a slab. Exact: yes; but for areas and values at limits, which are bounds. Proof: P-86
class Curve_arrangement {
 public:
  Curve_arrangement(std::span<const Plane_curve> curves, const Chart_box& box,
                    const std::function<bool()>& out_of_time = {});
  /// Of stretches of lines that do not cross, within the rectangle: slabs are between neighbours among their ends and
  /// `uprights`, values of x within it. Cost: for n stretches, n log n, and the arcs of all slabs.
  Curve_arrangement(std::span<const Plane_curve> curves, const Chart_box& box, std::span<const Stretch> stretches,
                    std::span<const Rational> uprights);
  /// Whether time ran out: then there are no slabs.
  bool ended() const { return slabs_.empty(); }

  struct Arc {
    std::uint32_t curve;
    bool upper;  ///< the larger of two values of y
    friend bool operator==(const Arc&, const Arc&) = default;
  };
  struct Slab {
    Rational x;               ///< of the points of its sectors
    std::vector<Arc> arcs;    ///< upwards
    std::vector<Rational> y;  ///< of a point of each sector, upwards: one more than arcs
  };
  const std::vector<Slab>& slabs() const { return slabs_; }
  /// Slab k is between limits k and k + 1.
  Bounded limit(std::size_t k) const { return limits_[k]; }
  /// y of an arc at a limit of its slab; from the rectangle's lower to its upper side where doubles do not tell.
  Bounded value(const Arc& arc, std::size_t limit) const;
  /// y of an arc at a place within its slab, rounded.
  double near(const Arc& arc, double x) const;
  /// The area between an arc and y = 0, within its slab, in up to 2^halvings parts: bounds are a 2^-30 of the slab's
  /// width apart where these do for it.
  Bounded area_below(const Arc& arc, std::size_t slab, int halvings = 14) const;

 private:
  Slab slab_of(std::span<const Plane_curve> curves, std::span<const std::uint32_t> active, Rational x) const;
  void keep_doubles(std::span<const Plane_curve> curves, std::vector<Real_root>& roots);

  std::vector<Slab> slabs_;
  std::vector<Bounded> limits_;
  std::vector<std::array<Bounded, 9>> near_;  // of each curve: a, b, c of a y^2 + b y + c, and b^2 - 4 a c
  Chart_box box_;
};

}  // namespace sightline
