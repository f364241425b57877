#pragma once
// Sides of vertices to planes: every stage of the cascade against Cramer's rule on rationals (tests/kernel/grid.h).

#include "../kernel/grid.h"
#include "support.h"

#include <cmath>

namespace fuzz {

using kernel_test::Grid;
using kernel_test::Position;

/// A grid of some width with up to eight points, planes through them, and what the points know of the planes.
inline Grid grid_in(Bytes& from, std::vector<std::uint32_t>& points) {
  static constexpr std::array widths{6, 13, 20, 26, 31, 40, 53, 54, 64, 90};
  const int bits = widths[from.below(widths.size())];
  Integer divisor = 1;
  if (bits > 53 && from.below(2) == 1) divisor = 3 * kernel_test::power_of_two(bits - 31);
  if (bits > 53 && from.below(4) == 1)  // so small that products of doubles underflow
    divisor = 3 * kernel_test::power_of_two(bits + 900 + static_cast<int>(from.below(120)));
  // One with which whole coordinates have as many bits as doubles hold, one less or a few more.
  if (bits > 60 && from.below(4) == 1)
    divisor = kernel_test::power_of_two(bits - 52 - static_cast<int>(from.below(4))) - 1;
  const int whole_bits = bits - static_cast<int>(bit_length(divisor));
  Grid grid(bits, divisor);
  for (std::size_t k = 3 + from.below(6); k > 0; --k) {
    std::array<Integer, 3> p;
    const bool whole = from.below(2) == 1 && whole_bits > 0;
    for (Integer& x : p) x = whole ? Integer(from.integer(whole_bits) * divisor) : from.integer(bits);
    points.push_back(grid.point(p));
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> incidences;
  for (std::size_t k = 3 + from.below(5); k > 0; --k) {
    std::array<std::uint32_t, 3> corner;
    for (std::uint32_t& p : corner) p = points[from.below(points.size())];
    const kernel_test::Coefficients h =
        kernel_test::through(grid.at(corner[0]), grid.at(corner[1]), grid.at(corner[2]));
    if (h[0] == 0 && h[1] == 0 && h[2] == 0) continue;
    const Plane plane = grid.plane(h);
    if (from.below(2) == 0) continue;
    for (const std::uint32_t p : corner) incidences.emplace_back(p, plane.id());
  }
  grid.incidences = Point_planes(grid.points.size(), incidences);
  return grid;
}

/// Coordinates and planes in doubles are those of the tables' integers, within what the tables say.
inline void check_doubles(const Grid& grid) {
  const Rational tiny = kernel_test::shifted(1, 1074);  // what is below doubles
  for (std::uint32_t p = 0; p < grid.points.size(); ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational near = exact(grid.points.approximate(p, static_cast<int>(k))),
                     value = grid.approximated(grid.at(p)[k]), error = near - value;
      require(abs(error) <= kernel_test::shifted(abs(value), 53) + tiny, "a coordinate in doubles is the nearest one");
      require(abs(near) <= exact(grid.points.range()), "coordinates are within their range");
      require(!grid.points.is_exact(p, static_cast<int>(k)) || (error == 0 && near.get_den() == 1),
              "what is called exact is a whole number, without error");
    }
  for (std::uint32_t id = 0; id < grid.planes.size(); ++id) {
    const Approximate_plane& plane = grid.planes.approximate(id);
    const std::array<Rational, 4> near{exact(plane.a), exact(plane.b), exact(plane.c), exact(plane.d)};
    std::array<Rational, 4> value;
    for (int k = 0; k < 4; ++k) value[static_cast<std::size_t>(k)] = grid.planes.integer(id, k);
    value[3] = grid.approximated(value[3]);
    // The factor of all of them: a power of two, by one that is not 0.
    const std::size_t some = value[0] != 0 ? 0 : value[1] != 0 ? 1 : 2;
    const long power = -std::ilogb(Rational(near[some] / value[some]).get_d() * 1.25);
    for (std::size_t k = 0; k < 4; ++k) {
      const Rational scaled = kernel_test::shifted(value[k], power), error = near[k] - scaled;
      require(abs(error) <= kernel_test::shifted(abs(scaled), 52) + tiny, "a plane in doubles is near its own");
      require(!plane.exact || abs(near[k]) >= kernel_test::power_of_two(53) ||
                  (near[k] == value[k] && near[k].get_den() == 1),
              "a plane that is called exact is one of whole numbers, without error where these are below 2^53");
    }
  }
}

inline void check_side(const Grid& grid, const Predicates& predicates, const Vertex& v, const Position& x, Plane plane,
                       const kernel_test::Coefficients& h) {
  const Sign truth = kernel_test::sign(kernel_test::evaluate(h, x));
  for (const bool opposite : {false, true}) {
    const Plane g = opposite ? plane.opposite() : plane;
    const Sign expected = opposite ? -truth : truth;
    const Prepared_plane prepared = predicates.prepare(g);
    Predicate_counts counts;
    require(predicates.side(v, prepared, counts) == expected, "the side is right");
    require(counts.total() == 1, "one stage decides");
    require(!predicates.incident(v, g.id()) || expected == CGAL::ZERO, "incident is on");
    const CGAL::Uncertain<Sign> filtered = Predicates::side_filtered(v, prepared), fixed = predicates.side_fixed(v, g);
    require(!CGAL::is_certain(filtered) || filtered.inf() == expected, "doubles are right where they are certain");
    require(CGAL::is_certain(fixed) == (predicates.arithmetic() != Arithmetic::gmp),
            "fixed width is certain iff the scene fits it");
    require(!CGAL::is_certain(fixed) || fixed.inf() == expected, "fixed width is right");
    require(predicates.side_exact<Integer>(v, g) == expected, "GMP is right");
    const int width = grid.planes.budget().side();
    if (width <= 128) require(predicates.side_exact<Fixed_integer<2>>(v, g) == expected, "128 bits are right");
    if (width <= 256) require(predicates.side_exact<Fixed_integer<4>>(v, g) == expected, "256 bits are right");
    if (width <= 512) require(predicates.side_exact<Fixed_integer<8>>(v, g) == expected, "512 bits are right");
  }
  if (v.error == std::numeric_limits<double>::infinity()) return;
  const std::array<double, 3> rounded{v.x, v.y, v.z};
  for (std::size_t k = 0; k < 3; ++k)
    require(abs(exact(rounded[k]) - grid.approximated(x[k])) <= exact(v.error),
            "the doubles of a vertex are within its error");
}

inline void side(std::string_view bytes) {
  Bytes from(bytes);
  std::vector<std::uint32_t> points;
  Grid grid = grid_in(from, points);
  check_doubles(grid);
  const Predicates predicates = grid.predicates();
  std::vector<std::pair<Plane, kernel_test::Coefficients>> planes;
  for (std::size_t k = 0; k < grid.handles.size(); ++k) planes.emplace_back(grid.handles[k], grid.made[k]);
  for (std::size_t k = 0; k < 2; ++k) {  // across an axis, through a point
    const std::uint32_t p = points[from.below(points.size())];
    const int axis = static_cast<int>(from.below(3));
    kernel_test::Coefficients h{0, 0, 0, -grid.at(p)[static_cast<std::size_t>(axis)]};
    h[static_cast<std::size_t>(axis)] = 1;
    planes.emplace_back(Plane::across(axis, p), h);
  }
  for (const std::uint32_t p : points) {
    const Vertex v = predicates.input_vertex(p, Vertex::no_plane, Vertex::no_plane, Vertex::no_plane);
    const std::array<Integer, 3> at = grid.at(p);
    for (const auto& [plane, h] : planes) check_side(grid, predicates, v, {at[0], at[1], at[2]}, plane, h);
  }
  for (std::size_t round = 0; round < 4; ++round) {
    const std::array<std::size_t, 3> triple{from.below(planes.size()), from.below(planes.size()),
                                            from.below(planes.size())};
    std::array<std::uint32_t, 3> ids;
    for (std::size_t k = 0; k < 3; ++k) ids[k] = planes[triple[k]].first.id();
    const auto [p, q, r] = ids;
    const std::optional<Position> meet =
        kernel_test::meeting_point(planes[triple[0]].second, planes[triple[1]].second, planes[triple[2]].second);
    // The determinant of normals, turned round with planes.
    const auto& [a, b, c] = std::array{planes[triple[0]].second, planes[triple[1]].second, planes[triple[2]].second};
    const Integer determinant =
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    Predicate_counts counts;
    std::array<Plane, 3> asked;
    int expected = sgn(determinant);
    for (std::size_t k = 0; k < 3; ++k) {
      asked[k] = planes[triple[k]].first;
      if (from.below(2) == 0) continue;
      asked[k] = asked[k].opposite();
      expected = -expected;
    }
    require(static_cast<int>(predicates.orientation(asked[0], asked[1], asked[2], counts)) == expected,
            "an orientation is the sign of the determinant of normals");
    require((expected == 0) == !meet, "normals are dependent iff planes do not meet in a point");
    if (!meet) {
      try {
        predicates.meet(p, q, r);
      } catch (const std::domain_error&) {
        continue;
      }
      require(false, "planes that do not meet in a point are refused");
    }
    for (const auto& order : {ids, std::array{q, p, r}, std::array{r, p, q}}) {
      const Vertex v = predicates.meet(order[0], order[1], order[2]);
      for (const auto& [plane, h] : planes) check_side(grid, predicates, v, *meet, plane, h);
    }
  }
}

}  // namespace fuzz
