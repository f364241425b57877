#include <sightline/algorithms/weak_visibility/search/cell_cuts.h>

#include <sightline/algorithms/weak_visibility/edge_lines.h>
#include <sightline/kernel/line_table.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace sightline {

std::optional<Cell_cut> common_plane(const Line_cell& cell, const Occluders& occluders) {
  const auto plane_of = [&](const Edge_lines::Edge_line& a,
                            const Edge_lines::Edge_line& b) -> std::optional<Near_plane> {
    if (!Edge_lines::coplanar(a, b)) return {};
    const auto direction = [](const Exact_pluecker& l) { return std::array<Integer, 3>{l[0], l[1], l[2]}; };
    const std::array<Integer, 3> p = occluders.grid_point(a.points[0]), q = occluders.grid_point(b.points[0]);
    std::array<Integer, 3> normal = cross(direction(a.exact()), direction(b.exact()));
    if (is_zero(normal)) normal = cross(direction(a.exact()), minus(q, p));  // parallel, and not the same line
    if (is_zero(normal)) return {};
    return near_plane(occluders.frame(), {normal[0], normal[1], normal[2], Integer(-dot(normal, p))});
  };
  for (const bool source : {true, false})
    for (std::size_t i = 0; i < cell.rows.size(); ++i)
      for (std::size_t k = i + 1; k < cell.rows.size(); ++k)
        if (const auto plane =
                plane_of((*cell.lines)[cell.rows[i].literal.line], (*cell.lines)[cell.rows[k].literal.line]);
            plane && is_across(*plane, source ? cell.domain->source : cell.domain->target))
          return Cell_cut{source, *plane};
  return {};
}

namespace {

/// False beyond doubles, where numbers propose nothing.
bool all_finite(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

constexpr double of_heights = 0x1p-12;  // heights are times this, so that those of normals to 256 do not overflow

/// How far a point is along a normal, times of_heights.
double height_of(const Near_point& p, const Triple& normal) {
  double height = 0;
  for (std::size_t k = 0; k < 3; ++k) height += normal[k] * (of_heights * p.near[k]);
  return height;
}

/// A normal of few bits that points from an edge into its convex polygon, about within its plane.
Triple inward_of(const Near_polygon& polygon, std::size_t e) {
  const Triple &a = polygon[e].near, &b = polygon[(e + 1) % polygon.size()].near;
  const Triple along{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const double square = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
  Triple inward{};
  double most = 0;
  for (const Near_point& p : polygon) {
    const Triple to{p.near[0] - a[0], p.near[1] - a[1], p.near[2] - a[2]};
    const double share = square > 0 ? (to[0] * along[0] + to[1] * along[1] + to[2] * along[2]) / square : 0;
    const Triple across{to[0] - share * along[0], to[1] - share * along[1], to[2] - share * along[2]};
    const double length = across[0] * across[0] + across[1] * across[1] + across[2] * across[2];
    if (length > most) {
      most = length;
      inward = across;
    }
  }
  const double largest = size(inward);
  if (largest > 0)
    for (double& x : inward) x = std::round(x / largest * 256);
  return inward;
}

/// The plane on which a normal of few bits takes a height, rounded down to a few thousandths of an extent, so that it
/// and what it cuts keep few bits.
Near_plane plane_at(const Near_frame& frame, const Triple& normal, double height, double extent) {
  const int step = std::ilogb(extent) - 10;
  const double rounded = std::ldexp(std::floor(std::ldexp(height, -step)), step);
  const Rational offset = exact(rounded) / exact(of_heights) * frame.unit();
  std::array<Integer, 4> h;
  for (std::size_t k = 0; k < 3; ++k) h[k] = Integer(normal[k]) * offset.get_den();
  h[3] = -offset.get_num();
  return near_plane(frame, h);
}

}  // namespace

std::vector<Cell_cut> shaves(const Line_cell& cell, Matrix_game<double>& game, const Near_frame& frame,
                             Weak_counters& counters) {
  std::vector<Cell_cut> cuts;
  double kept = 1;
  const std::size_t n = cell.domain->target.size();
  std::vector<double> values(cell.pairs());
  for (const bool source : {true, false}) {
    const Near_polygon& polygon = source ? cell.domain->source : cell.domain->target;
    for (std::size_t e = 0; e < polygon.size(); ++e) {
      const Triple inward = inward_of(polygon, e);
      std::vector<double> heights;
      for (const Near_point& p : polygon) heights.push_back(height_of(p, inward));
      const double low = *std::min_element(heights.begin(), heights.end()),
                   high = *std::max_element(heights.begin(), heights.end());
      if (!(high - low > 1e-12 * of_heights) || !all_finite(heights)) continue;
      double empty = 0;  // the share of the height that is known to hold no line
      for (const double share : {0.5, 0.25, 0.75, 0.125, 0.875}) {
        if (share < empty || (empty == 0 && share > 0.5) || (empty == 0.5 && share < 0.5) ||
            (empty == 0.25 && share == 0.125))
          continue;
        const double height = low + share * (high - low), scale = 1 / (high - low);
        for (std::size_t c = 0; c < values.size(); ++c) values[c] = (height - heights[source ? c / n : c % n]) * scale;
        ++counters.programs;
        if (game.value_with(values) < -1e-8) empty = share;
        else if (share > 0.5) break;
      }
      if (empty == 0) continue;
      kept *= 1 - empty;
      cuts.push_back({source, plane_at(frame, inward, low + empty * (high - low), high - low)});
    }
  }
  if (!(kept < 0.8)) cuts.clear();
  return cuts;
}

std::optional<Cell_cut> bisector(const Line_domain& domain, const Near_frame& frame) {
  const auto longest = [](const Near_polygon& polygon, std::array<std::size_t, 2>& ends) {
    double most = -1;
    for (std::size_t i = 0; i < polygon.size(); ++i)
      for (std::size_t j = i + 1; j < polygon.size(); ++j) {
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k)
          square += (polygon[i].near[k] - polygon[j].near[k]) * (polygon[i].near[k] - polygon[j].near[k]);
        if (square > most) {
          most = square;
          ends = {i, j};
        }
      }
    return most;
  };
  std::array<std::size_t, 2> s{}, t{};
  const bool source = longest(domain.source, s) >= longest(domain.target, t);
  const Near_point &a = source ? domain.source[s[0]] : domain.target[t[0]],
                   &b = source ? domain.source[s[1]] : domain.target[t[1]];
  Triple normal{b.near[0] - a.near[0], b.near[1] - a.near[1], b.near[2] - a.near[2]};
  const double scale = size(normal);
  if (!(scale > 0) || !all_finite(a.near) || !all_finite(b.near) || !std::isfinite(scale)) return {};
  for (double& x : normal) x = std::round(x / scale * 16);
  const double low = height_of(a, normal), high = height_of(b, normal);
  if (!(high - low > 0x1p-900)) return {};
  const Near_plane plane = plane_at(frame, normal, (low + high) / 2, high - low);
  if (!is_across(plane, source ? domain.source : domain.target)) return {};
  return Cell_cut{source, plane};
}

}  // namespace sightline
