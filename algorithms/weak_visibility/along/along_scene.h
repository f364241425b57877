#pragma once
// What all searches along one path share: pieces and lines of edges as a moving eye sees them.

#include <sightline/algorithms/weak_visibility/along/moving_eye.h>
#include <sightline/algorithms/weak_visibility/occluders.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

namespace sightline {

/// A line on one of its sides: directions whose product with `sign` times its normal is positive.
struct Line_side {
  std::uint32_t line;
  int sign;
};

/// A convex polygon before the eye: a piece, or the part of one in front of a plane.
struct Eye_polygon {
  std::uint32_t piece;
  std::vector<Near_point> corners;
  /// From each corner to the next. Seen from behind the polygon's inside is where they all are positive, from the front
  /// where they are negative.
  std::vector<Line_side> edges;
  Quadratic eye_side;  ///< of the eye to its plane: linear
  double size;         ///< the square of twice its area, in doubles: large ones are tried first
};

/// What all searches of one path share: the pieces that can be seen or hide something at all. Pieces whose plane holds
/// the path are none. It refers to the occluders.
class Along_scene {
 public:
  /// ask(): before each piece here, and on the way of searches, from any thread; what it throws ends them.
  Along_scene(const Occluders& occluders, const Exact_point& from, const Exact_point& to, std::function<void()> ask);
  Along_scene(Occluders&&, const Exact_point&, const Exact_point&, std::function<void()>) = delete;

  const Occluders& occluders() const { return *occluders_; }
  void ask() const { ask_(); }
  const Moving_eye& eye() const { return eye_; }
  const std::vector<Eye_line>& lines() const { return lines_; }
  /// The number of a line, if it is one of the scene's.
  const std::map<Exact_pluecker, std::uint32_t, Less_entries>& numbers() const { return numbers_; }
  /// By piece; without corners where the path is in its plane.
  const std::vector<Eye_polygon>& polygons() const { return polygons_; }
  /// The edges on a line, each a piece and a corner.
  const std::vector<std::array<std::uint32_t, 2>>& edges(std::uint32_t line) const { return edges_[line]; }
  /// When the eye is on a closed piece, in order.
  const std::vector<Rational>& contacts() const { return contacts_; }
  /// The same with 0 and 1.
  const std::vector<Rational>& stops() const { return stops_; }

 private:
  bool is_on(const Eye_polygon& polygon, const Homogeneous& eye) const;

  const Occluders* occluders_;
  std::function<void()> ask_;
  Moving_eye eye_;
  std::vector<Eye_line> lines_;
  std::vector<std::vector<std::array<std::uint32_t, 2>>> edges_;  // by line
  std::map<Exact_pluecker, std::uint32_t, Less_entries> numbers_;
  std::vector<Eye_polygon> polygons_;
  std::vector<Rational> contacts_, stops_;
};

/// The square of twice a polygon's area, in doubles.
double squared_size(std::span<const Near_point> corners);

}  // namespace sightline
