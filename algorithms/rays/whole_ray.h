#pragma once
// One ray and the pieces of a scene in whole numbers: for what doubles leave open.

#include <sightline/algorithms/rays/ray.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstdint>
#include <optional>

namespace sightline {

/// A corner (twice) or an edge of a piece that a ray's line meets, by the scene's points; `none`: it meets neither, or
/// nobody asked. Planes that the line crosses, and that hold the same border, are met in one point.
struct Met_border {
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  std::uint32_t from = none, to = none;
  bool is_known() const { return from != none; }
  bool is_corner() const { return is_known() && from == to; }
  friend bool operator==(const Met_border&, const Met_border&) = default;
};

/// Numbers are made where they are first asked for: in machine numbers where all are short, without a division where
/// the ray is in doubles and the grid is as fine as a power of two. Exact: yes. Proof: P-95
class Whole_ray {
 public:
  /// What the rays of a scene share.
  class Grid {
   public:
    /// Pre: the scene outlives it.
    explicit Grid(const Scene& scene);
    /// Between neighbours of the grid, in the file's coordinates.
    const Rational& step() const { return step_; }

   private:
    friend class Whole_ray;
    const Scene* scene_;
    Rational step_;
    bool is_dyadic_ = false;  ///< step and centre are doubles
    double double_step_ = 0;
    std::array<double, 3> double_centre_{};
  };

  /// Of either; both outlive it.
  Whole_ray(const Grid& grid, const Exact_ray* given, const Double_ray* doubles)
      : grid_(grid), scene_(*grid.scene_), given_(given), doubles_(doubles) {}

  /// Whether the line meets a piece, and which corner or edge of it. Pre: it is not in the piece's plane.
  std::optional<Met_border> crosses(std::uint32_t piece);
  /// The part of the ray, from t = 0 on, that a piece holds.
  std::optional<Face_hit> part(std::uint32_t piece);
  /// Where the piece's plane is met. Pre: the line crosses it.
  Rational parameter(std::uint32_t piece);

 private:
  /// (origin + t direction / denominator) / weight, in grid coordinates.
  struct Whole {
    std::array<Integer, 3> origin, direction;
    Integer weight, denominator;
  };
  /// Origin and direction, some positive multiple of it, where all is short: products of three numbers, corners among
  /// them, have less than 128 bits.
  struct Small {
    std::array<std::int64_t, 3> origin, direction;
    std::int64_t weight;
  };
  const Whole& whole();
  /// Nothing where numbers are too long.
  const std::optional<Small>& small();
  std::optional<Small> small_of(const Double_ray& ray) const;
  std::optional<Small> small_of(const Whole& whole) const;
  /// place(point, k): a coordinate of a corner from the ray's origin. Products of three numbers are in Product.
  template <class Product, class Number, class Place>
  std::optional<Met_border> crosses_in(std::uint32_t piece, const std::array<Number, 3>& direction, Place place) const;
  std::optional<Face_hit> part_along(std::uint32_t piece, const std::array<Integer, 4>& plane);

  const Grid& grid_;
  const Scene& scene_;
  const Exact_ray* given_;
  const Double_ray* doubles_;
  std::optional<Whole> whole_;
  std::optional<std::optional<Small>> small_;
};

}  // namespace sightline
