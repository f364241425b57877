#include <sightline/algorithms/weak_visibility/edge_lines.h>

#include <sightline/kernel/number.h>

#include <algorithm>
#include <cmath>

namespace sightline {

const std::vector<Edge_lines::Edge>& Edge_lines::of(std::uint32_t piece) {
  std::vector<Edge>& edges = of_piece_[piece];
  if (edges.empty())
    for (std::size_t i = 0; i < occluders_->size(piece); ++i) edges.push_back(edge(piece, i));
  return edges;
}

const Exact_pluecker& Edge_lines::Edge_line::exact() const {
  if (!made) made = occluders->exact_pluecker_of(points);
  return *made;
}

bool Edge_lines::coplanar(const Edge_line& a, const Edge_line& b) {
  double near = 0;
  for (std::size_t x = 0; x < 6; ++x) near += a.near[x] * b.near[(x + 3) % 6];
  if (std::fabs(near) > 1e-12) return false;
  Integer product = 0;
  for (std::size_t x = 0; x < 6; ++x) product += a.exact()[x] * b.exact()[(x + 3) % 6];
  return sgn(product) == 0;
}

Edge_lines::Edge Edge_lines::edge(std::uint32_t piece, std::size_t corner) {
  const std::array<std::uint32_t, 2> points = occluders_->edge_points(piece, corner);
  const auto [name, flipped] = names_.through(points[0], points[1]);
  if (name == lines_.size()) {
    const Triple &a = occluders_->corners(piece)[corner],
                 &b = occluders_->corners(piece)[(corner + 1) % occluders_->size(piece)];
    const Triple rest = occluders_->rest_of(points[0]);
    lines_.push_back({{piece, static_cast<std::uint32_t>(corner)},
                      points,
                      flipped,
                      occluders_->edges(piece)[corner],
                      a,
                      rest,
                      way_between(a, rest, b, occluders_->rest_of(points[1])),
                      std::max(sightline::size(a), sightline::size(b)),
                      occluders_});
  }
  return {name, flipped == lines_[name].flipped ? 1 : -1};
}

}  // namespace sightline
