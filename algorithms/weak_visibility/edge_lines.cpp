#include <sightline/algorithms/weak_visibility/edge_lines.h>

#include <sightline/kernel/number.h>

#include <cmath>

namespace sightline {

const std::vector<Edge_lines::Edge>& Edge_lines::of(std::uint32_t piece) {
  std::vector<Edge>& edges = of_piece_[piece];
  if (edges.empty())
    for (std::size_t i = 0; i < occluders_->size(piece); ++i) edges.push_back(edge(piece, i));
  return edges;
}

bool Edge_lines::passes(const Edge_line& line, std::uint32_t point) const {
  if (line.points[0] == point || line.points[1] == point) return true;
  const Triple v = occluders_->near_point_of(point);
  const Pluecker& l = line.near;
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

Edge_lines::Edge Edge_lines::edge(std::uint32_t piece, std::size_t corner) {
  const std::array<std::uint32_t, 2> points = occluders_->edge_points(piece, corner);
  const auto [name, flipped] = names_.through(points[0], points[1]);
  if (name == lines_.size()) {
    const double a = sightline::size(occluders_->corners(piece)[corner]),
                 b = sightline::size(occluders_->corners(piece)[(corner + 1) % occluders_->size(piece)]);
    lines_.push_back({{piece, static_cast<std::uint32_t>(corner)},
                      points,
                      flipped,
                      occluders_->edges(piece)[corner],
                      ends(a, b),
                      occluders_->exact_pluecker_of(points)});
  }
  return {name, flipped == lines_[name].flipped ? 1 : -1};
}

}  // namespace sightline
