#pragma once
// The lines that edges of pieces lie on, numbered as one search meets them.

#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/kernel/line_table.h>

#include <unordered_map>

namespace sightline {

/// Edges by the lines that they lie on: edges on one line have its number, also where their end points differ. Exact:
/// yes.
class Edge_lines {
 public:
  struct Line {
    Weak_line edge;                       ///< the first edge met on it; the line runs as it does
    std::array<std::uint32_t, 2> points;  ///< that edge's ends
    bool flipped;                         ///< runs against the canonical direction
    Six near;
    double ends_sum, ends_product;  ///< of the largest coordinates of its two points
    Exact_six exact;
  };
  /// An edge's line: `sense` -1 where it runs the other way.
  struct Edge {
    std::uint32_t line;
    int sense;
  };

  explicit Edge_lines(const Occluders& occluders) : occluders_(&occluders), names_(occluders.scene().points()) {}

  std::size_t size() const { return lines_.size(); }
  const Line& operator[](std::uint32_t line) const { return lines_[line]; }
  const std::vector<Line>& all() const { return lines_; }

  /// The edges of a piece, from each corner to the next.
  const std::vector<Edge>& of(std::uint32_t piece) {
    std::vector<Edge>& edges = of_piece_[piece];
    if (edges.empty())
      for (std::size_t i = 0; i < occluders_->size(piece); ++i) edges.push_back(edge(piece, i));
    return edges;
  }

  /// Whether a line goes through a point of the scene. Exact: yes.
  bool passes(const Line& line, std::uint32_t point) const {
    if (line.points[0] == point || line.points[1] == point) return true;
    const Triple v = occluders_->near_point_of(point);
    const Six& l = line.near;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, w = (k + 2) % 3;
      if (std::fabs(v[u] * l[w] - v[w] * l[u] - l[3 + k]) > 1e-9) return false;  // the moment that the line would have
    }
    const std::array<Integer, 3> p = occluders_->grid_point(point);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, w = (k + 2) % 3;
      if (p[u] * line.exact[w] - p[w] * line.exact[u] != line.exact[3 + k]) return false;
    }
    return true;
  }

 private:
  Edge edge(std::uint32_t piece, std::size_t corner) {
    const std::array<std::uint32_t, 2> points = occluders_->edge_points(piece, corner);
    const auto [name, flipped] = names_.through(points[0], points[1]);
    if (name == lines_.size()) {
      const double a = sightline::size(occluders_->corners(piece)[corner]),
                   b = sightline::size(occluders_->corners(piece)[(corner + 1) % occluders_->size(piece)]);
      lines_.push_back({{piece, static_cast<std::uint32_t>(corner)},
                        points,
                        flipped,
                        occluders_->edges(piece)[corner],
                        a + b,
                        a * b,
                        occluders_->exact_edge_of(points)});
    }
    return {name, flipped == lines_[name].flipped ? 1 : -1};
  }

  const Occluders* occluders_;
  Line_table names_;  // as many as lines_, in the same order
  std::vector<Line> lines_;
  std::unordered_map<std::uint32_t, std::vector<Edge>> of_piece_;
};

}  // namespace sightline
