#pragma once
// Weak visibility as a careful program in doubles finds it: the same cells of lines, with a tolerance, and what it
// finds believed.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/search/matrix_game.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/kernel/line_table.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace sightline {

struct Doubles_search_options {
  bool two_sided = false;
  double tolerance = 1e-9;   ///< what is smaller counts as zero, where the scene's coordinates are at most 1
  std::size_t cells = 5000;  ///< for a source and a piece; then `undecided`
  int halvings = 6;          ///< of source or target, one in another, where a cell may have a line and none is found
  int threads = 0;           ///< 0: as many as there are processors
  std::function<void(std::size_t done, std::size_t all)> progress;  ///< faces; called by any thread
};

/// One search in doubles: takes a line of the cell, and a piece that blocks it; cuts source or target by that piece's
/// plane; goes on, edge by edge, to lines that pass it outside. A cell ends where a linear program finds no line with
/// room, a line with no piece in its way makes the target visible. Nothing is checked, names of lines are not known,
/// nothing is learned from a cell. Exact: no
class Doubles_search {
 public:
  Doubles_search(Occluders&&, const Doubles_search_options&) = delete;
  Doubles_search(const Occluders&, Doubles_search_options&&) = delete;
  Doubles_search(const Occluders& occluders, const Doubles_search_options& options)
      : occluders_(&occluders), options_(&options) {}

  /// Whether a piece is visible from a source.
  Weak_status run(const Weak_source& source, std::uint32_t piece);

 private:
  using Polygon = std::vector<Triple>;
  /// An edge, and the sign with which lines of the cell pass it.
  struct Side {
    std::uint32_t piece;
    std::size_t edge;
    int sign;
  };
  struct Weighted_line {
    std::vector<double> source, target;  // weights of the corners
  };

  static Polygon near_of(const Near_polygon& polygon) {
    Polygon points;
    for (const Near_point& p : polygon) points.push_back(p.near);
    return points;
  }
  static double height(const std::array<double, 4>& h, const Triple& p);
  /// How far a polygon is in front of a plane, and behind it.
  static std::array<double, 2> reach(const Polygon& polygon, const std::array<double, 4>& h);
  /// The part of a polygon on one side of a plane; nothing where that is too thin.
  Polygon part(const Polygon& polygon, const std::array<double, 4>& h, int side) const;

  // ---- Cells

  Weak_status search(const Polygon& source, const Polygon& target, int halvings);
  template <class Search>
  static Weak_status both(Search search);
  /// Both halves of the longer one of the two polygons, cut across its longest diagonal.
  Weak_status halves(const Polygon& source, const Polygon& target, int halvings);

  // ---- A line of the cell

  /// The sides of an edge on lines between corners, scaled to at most 1.
  std::vector<double> sides(const Polygon& source, const Polygon& target, std::uint32_t piece, std::size_t edge) const;

  /// Whether there is a line on the path's sides with some room, and one that is; nothing where there may be one, and
  /// none was found.
  std::optional<bool> find_line(const Polygon& source, const Polygon& target, Weighted_line& line);
  /// The least side of a line whose one end is the best for the other; then that end goes half as far as it may towards
  /// the polygon's middle.
  double improve(Weighted_line& line, bool source);

  // ---- What blocks it

  static Triple mean(const Polygon& polygon, const std::vector<double>& weights);
  /// A piece that a line meets, of several the one with the fewest open edges; those with the signs that they have
  /// inside.
  std::optional<std::uint32_t> find_blocker(const Polygon& source, const Polygon& target, const Weighted_line& line,
                                            std::vector<Side>& open) const;

  const Occluders* occluders_;
  const Doubles_search_options* options_;
  std::vector<std::uint32_t> pieces_;
  std::vector<Side> path_;
  std::vector<std::vector<double>> rows_;
  Matrix_game<double> game_, end_;
  std::size_t cells_ = 0;
};

/// The faces that a search in doubles takes for weakly visible from one of the sources, hidden, or neither. Degenerate:
/// what is thinner than the tolerance is not there, neither gaps nor faces; where differences of products lose all
/// digits, sides are what is left. Post: the same at any number of threads. Cost: exponential at worst, bounded by the
/// options. Exact: no
Weak_faces visible_by_doubles(const Occluders& occluders, const std::vector<Weak_source>& sources,
                              const Doubles_search_options& options = {});

}  // namespace sightline
