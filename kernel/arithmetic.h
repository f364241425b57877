#pragma once
// The bit budget of a scene, and the narrowest exact arithmetic that provably fits it.

#include <cstddef>
#include <string_view>

namespace sightline {

enum class Arithmetic { bits128, bits256, bits512, gmp };

constexpr std::string_view name(Arithmetic a) {
  constexpr std::string_view names[] = {"128", "256", "512", "gmp"};
  return names[static_cast<std::size_t>(a)];
}

/// Widths of what predicates are made of, in bits of magnitude.
struct Bit_budget {
  int coordinate = 0;  ///< |x| < 2^coordinate for every input point, on the scene's grid
  int normal = 0;      ///< |a|, |b|, |c| < 2^normal for every interned plane
  int offset = 0;      ///< |d| < 2^offset for every interned plane

  /// The side of a vertex (three planes) to a fourth is the sign of a 4x4 determinant with rows (a, b, c, d): 24
  /// products of three normal coefficients and one offset, so |det| < 24 x 2^(3 normal + offset) < 2^(3 normal + offset
  /// + 5); one more bit holds the sign. The orientation of the triple (6 products of three normal coefficients) is
  /// smaller. An axis plane has offset bits = coordinate bits, normal 1. Proof: P-02
  constexpr int side() const {
    const int d = offset > coordinate ? offset : coordinate;
    const int n = normal > 1 ? normal : 1;
    return 3 * n + d + 5 + 1;
  }

  /// The narrowest arithmetic whose width is at least side(). An input point's side (three products of a normal
  /// coefficient and a coordinate, plus an offset) is narrower, since the plane passes through an input point.
  constexpr Arithmetic arithmetic() const {
    const int width = side();
    return width <= 128   ? Arithmetic::bits128
           : width <= 256 ? Arithmetic::bits256
           : width <= 512 ? Arithmetic::bits512
                          : Arithmetic::gmp;
  }
};

}  // namespace sightline
