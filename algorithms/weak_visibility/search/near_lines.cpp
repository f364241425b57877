#include <sightline/algorithms/weak_visibility/search/near_lines.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace sightline {
namespace {

Triple mixed(const Triple& p, const Triple& q, double share) {
  Triple r;
  for (std::size_t k = 0; k < 3; ++k) r[k] = p[k] + share * (q[k] - p[k]);
  return r;
}
double distance(const Triple& p, const Triple& q) {
  const Triple d = minus(q, p);
  return std::sqrt(dot(d, d));
}

Triple middle_of(const Near_polygon& polygon) {
  Triple middle{};
  for (const Near_point& corner : polygon)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += corner.near[k] / static_cast<double>(polygon.size());
  return middle;
}

/// Of a point as a mixture of corners a, b, c: where it is projected onto their plane.
std::array<double, 3> mixture(const Triple& p, const Triple& a, const Triple& b, const Triple& c) {
  const Triple u = minus(b, a), v = minus(c, a), w = minus(p, a);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v),
               determinant = uu * vv - uv * uv;
  const double of_b = (vv * wu - uv * wv) / determinant, of_c = (uu * wv - uv * wu) / determinant;
  return {1 - of_b - of_c, of_b, of_c};
}

/// The point of a convex polygon nearest to p, as a mixture of its corners: p's projection if it is inside.
std::vector<double> nearest(const Near_polygon& polygon, const Triple& p) {
  std::vector<double> weights(polygon.size(), 0);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const std::array<double, 3> m = mixture(p, polygon[0].near, polygon[i].near, polygon[i + 1].near);
    if (!(m[0] >= 0 && m[1] >= 0 && m[2] >= 0)) continue;
    weights[0] = m[0];
    weights[i] = m[1];
    weights[i + 1] = m[2];
    return weights;
  }
  double least = std::numeric_limits<double>::infinity(), share = 0;
  std::size_t edge = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Triple &a = polygon[i].near, &b = polygon[(i + 1) % polygon.size()].near;
    const Triple along = minus(b, a);
    const double at = std::clamp(dot(minus(p, a), along) / dot(along, along), 0.0, 1.0),
                 far = distance(p, mixed(a, b, at));
    if (!(far < least)) continue;
    least = far;
    edge = i;
    share = at;
  }
  weights[edge] = 1 - share;
  weights[(edge + 1) % polygon.size()] += share;
  return weights;
}

/// A point of `own` that is near the middle of `other`, and off the plane of that by a share of its size, in front.
std::vector<double> beside(const Near_polygon& own, const Near_polygon& other, const Near_plane& plane, double share) {
  const Triple middle = middle_of(other);
  std::vector<double> weights = nearest(own, middle);
  double reach = 0, size = 0;
  std::size_t ahead = 0;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (const double height = likely_value(plane.near, own[i].near); height > reach) {
      reach = height;
      ahead = i;
    }
  for (const Near_point& corner : other) size = std::max(size, distance(corner.near, middle));
  const double far = distance(weighted_mean(own, weights), own[ahead].near),
               step = far > 0 ? std::min(0.5, share * size / far) : 0.5;
  for (double& w : weights) w *= 1 - step;
  weights[ahead] += step;
  return weights;
}

/// A mixture of corners with something of each.
void spread(std::vector<double>& weights, double share) {
  for (double& w : weights) w = (1 - share) * w + share / static_cast<double>(weights.size());
}

/// Of a line its end in `own`, beside the middle of `other`, and that in `other`, near there.
std::array<std::vector<double>, 2> ends_beside(const Near_polygon& own, const Near_polygon& other,
                                               const Near_plane& plane, double share) {
  std::vector<double> end = beside(own, other, plane, share), other_end = nearest(other, weighted_mean(own, end));
  spread(other_end, share);
  spread(end, 0x1p-30);
  return {std::move(end), std::move(other_end)};
}

bool is_finite(const Line_weights& line) {
  const auto all_finite = [](const std::vector<double>& weights) {
    return std::all_of(weights.begin(), weights.end(), [](double w) { return std::isfinite(w); });
  };
  return all_finite(line.source) && all_finite(line.target);
}

}  // namespace

std::vector<Line_weights> near_lines(const Near_polygon& source, const Near_plane& source_plane,
                                     const Near_polygon& target, const Near_plane& target_plane) {
  constexpr std::array off{0.25, 0.03125};
  std::vector<Line_weights> lines;
  const auto add = [&](Line_weights line) {
    if (is_finite(line)) lines.push_back(std::move(line));
  };
  for (const double share : off) {
    auto [from, to_near] = ends_beside(source, target, target_plane, share);
    add({std::move(from), std::move(to_near), {}, {}});
    auto [to, from_near] = ends_beside(target, source, source_plane, share);
    add({std::move(from_near), std::move(to), {}, {}});
  }
  return lines;
}

std::vector<Line_weights> lines_beside(const Near_polygon& source, const Near_polygon& target, const Triple& p,
                                       const Triple& q) {
  constexpr std::array off{0x1p-8, 0x1p-5, 0x1p-2};
  std::vector<Line_weights> lines;
  for (const double share : off) {
    Line_weights line{nearest(source, p), nearest(target, q), {}, {}};
    spread(line.source, 0x1p-30);
    spread(line.target, share);
    if (is_finite(line)) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace sightline
