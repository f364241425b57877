#include <sightline/algorithms/point_visibility/boxes.h>

#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/threads.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>

namespace sightline {

Piece_boxes::Piece_boxes(const Scene& scene) {
  std::vector<Entry> entries = entries_of(scene);
  if (entries.empty()) return;
  nodes_.resize(nodes_for(static_cast<std::uint32_t>(entries.size())));
  build(entries, 0, 0, static_cast<std::uint32_t>(entries.size()));
  place(scene, entries);
}

bool Piece_boxes::is_behind(const Box& box, const Prepared_plane& h) {
  const std::array<double, 3> n{h.a, h.b, h.c};
  double value = h.d;
  for (std::size_t k = 0; k < 3; ++k) value += n[k] * (n[k] > 0 ? box.high[k] : box.low[k]);
  return value < -2 * h.bound;
}

double Piece_boxes::distance(const Box& box, const Located_point& eye) {
  const std::array<double, 3> e{eye.ax, eye.ay, eye.az};
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = std::max({box.low[k] - e[k], e[k] - box.high[k], 0.0});
    sum += x * x;
  }
  return std::isfinite(sum) ? std::sqrt(sum) : 0;
}

std::vector<Piece_boxes::Entry> Piece_boxes::entries_of(const Scene& scene) {
  const Grid_points& points = scene.points();
  const double error = points.bits() <= 53 ? 0 : 0x1p-50 * points.range() + 0x1p-1000;
  std::vector<Entry> entries;
  entries.reserve(scene.pieces().size());
  const auto add = [&](Entry entry) {
    Box& box = entry.box;
    box.low.fill(std::numeric_limits<double>::infinity());
    box.high.fill(-std::numeric_limits<double>::infinity());
    for (std::uint32_t k = 0; k < entry.size; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = points.approximate(corner(scene, entry, k), static_cast<int>(axis));
        box.low[axis] = std::min(box.low[axis], x - error);
        box.high[axis] = std::max(box.high[axis], x + error);
      }
    entries.push_back(entry);
  };
  constexpr std::uint32_t stride = chunk_size - 1;  // neighbours have a corner in common
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
    // What is cut off along the boundary, then what is left, of every 31st corner, and so on.
    std::uint32_t step = 1, left = scene.pieces()[i].size;
    for (; left > chunk_size; step *= stride, left = (left + stride - 1) / stride)
      for (std::uint32_t k = 0; k + 1 < left; k += stride)
        add({{}, i, k * step, step, std::min(chunk_size, left - k + 1)});
    if (left > 2) add({{}, i, 0, step, left});
  }
  return entries;
}

std::uint32_t Piece_boxes::corner(const Scene& scene, const Entry& entry, std::uint32_t k) {
  const std::span<const Piece_corner> corners = scene.corners(scene.pieces()[entry.piece]);
  const std::size_t at = std::size_t{entry.first} + std::size_t{k} * entry.step;
  return corners[at < corners.size() ? at : 0].point;
}

std::uint32_t Piece_boxes::nodes_for(std::uint32_t count) {
  std::uint32_t nodes = 0, smaller = 1,
                larger = 0;  // of the subtrees of a level: how many hold `count` chunks, and how many count + 1
  for (;; count /= 2) {
    nodes += smaller + larger;
    if (count + (larger > 0) <= leaf_size) return nodes;
    if (count <= leaf_size) return nodes + 2 * larger;
    if (count % 2 == 0) smaller = 2 * smaller + larger;
    else larger = smaller + 2 * larger;
  }
}

void Piece_boxes::build(std::vector<Entry>& entries, std::uint32_t at, std::uint32_t first, std::uint32_t count) {
  const auto begin = entries.begin() + first, end = begin + count;
  Box all = begin->box;
  for (auto e = begin; e != end; ++e)
    for (std::size_t k = 0; k < 3; ++k) {
      all.low[k] = std::min(all.low[k], e->box.low[k]);
      all.high[k] = std::max(all.high[k], e->box.high[k]);
    }
  nodes_[at] = {all, first, count, 0};
  if (count <= leaf_size) return;
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (all.high[k] - all.low[k] > all.high[axis] - all.low[axis]) axis = k;
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, end, [&](const Entry& a, const Entry& b) {
    const double x = a.box.low[axis] + a.box.high[axis], y = b.box.low[axis] + b.box.high[axis];
    return x != y ? x < y : std::tie(a.piece, a.first, a.step) < std::tie(b.piece, b.first, b.step);
  });
  const std::uint32_t second = nodes_[at].second = at + 1 + nodes_for(half);
  constexpr std::uint32_t worth_a_task = 4096;
  const auto left = [&] { build(entries, at + 1, first, half); };
  const auto right = [&] { build(entries, second, first + half, count - half); };
  if (count >= worth_a_task) parallel_invoke(left, right);
  else {
    left();
    right();
  }
}

void Piece_boxes::place(const Scene& scene, const std::vector<Entry>& entries) {
  chunks_.reserve(entries.size());
  for (const Entry& entry : entries) {
    chunks_.push_back({entry.piece, static_cast<std::uint32_t>(points_.size()), entry.size});
    for (std::uint32_t k = 0; k < entry.size; ++k) points_.push_back(corner(scene, entry, k));
  }
}

}  // namespace sightline
