#include <sightline/algorithms/verify/boxes.h>

#include <sightline/kernel/number.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sightline::certificate_check {

namespace {

constexpr std::uint32_t few_boxes = 8;  // boxes of a leaf

/// The box about two points of a segment's coordinates, which are known up to `error` each.
Outward_box box_about(const std::array<double, 3>& a, const std::array<double, 3>& b,
                      const std::array<double, 3>& error) {
  Outward_box box;
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = std::min(a[k], b[k]) - error[k];
    box.high[k] = std::max(a[k], b[k]) + error[k];
  }
  return box;
}

}  // namespace

Outward_box::Outward_box(const Polygon& points) {
  for (const Exact_point& p : points)
    for (std::size_t k = 0; k < 3; ++k) {
      const double nearest = nearest_double(p[k]);
      low[k] = std::min(low[k], std::nextafter(nearest, -infinity));
      high[k] = std::max(high[k], std::nextafter(nearest, infinity));
    }
}

void Outward_box::join(const Outward_box& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], other.low[k]);
    high[k] = std::max(high[k], other.high[k]);
  }
}

Boxes::Boxes(const std::vector<Outward_box>& boxes) : order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Middle> middles(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      // Halved first: their sum may be beyond the range; never not a number.
      const double sum = boxes[i].low[k] / 2 + boxes[i].high[k] / 2;
      middles[i][k] = std::isnan(sum) ? 0 : sum;
    }
  if (!boxes.empty()) add(boxes, middles, 0, static_cast<std::uint32_t>(boxes.size()));
  boxes_.reserve(boxes.size());
  for (const std::uint32_t i : order_) boxes_.push_back(boxes[i]);
}

void Boxes::add(const std::vector<Outward_box>& boxes, const std::vector<Middle>& middles, std::uint32_t begin,
                std::uint32_t end) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({{}, begin, end, at + 1});
  for (std::uint32_t i = begin; i < end; ++i) nodes_[at].box.join(boxes[order_[i]]);
  if (end - begin <= few_boxes) {
    leaves_.push_back(at);
    return;
  }
  // Halves by their middles, along the longest side.
  const Outward_box& box = nodes_[at].box;
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (box.high[k] - box.low[k] > box.high[axis] - box.low[axis]) axis = k;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) { return middles[a][axis] < middles[b][axis]; });
  add(boxes, middles, begin, middle);
  add(boxes, middles, middle, end);
  nodes_[at].next = static_cast<std::uint32_t>(nodes_.size());
}

void Boxes::find(const Outward_box& part, std::vector<std::size_t>& found) const {
  for (std::uint32_t at = 0; at < nodes_.size();) {
    const Node& node = nodes_[at];
    const bool is_leaf = node.next == at + 1;
    at = node.box.meets(part) ? at + 1 : node.next;
    if (!is_leaf || !node.box.meets(part)) continue;
    for (std::uint32_t i = node.begin; i < node.end; ++i)
      if (boxes_[i].meets(part)) found.push_back(order_[i]);
  }
}

std::vector<std::size_t> Boxes::near_segment(const Exact_point& from, const Exact_point& to) const {
  std::vector<std::size_t> found;
  // 1. Its ends in doubles, and how far from them a point is that is computed of them: eight roundings, each of what is
  // at most twice the farther end, and of what underflows.
  std::array<double, 3> a{}, b{}, error{};
  bool fits = true;
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = nearest_double(from[k]);
    b[k] = nearest_double(to[k]);
    const double farthest = std::max(std::fabs(a[k]), std::fabs(b[k]));
    fits = fits && farthest < 1e300;
    error[k] = 0x1p-49 * farthest + 0x1p-1000;
  }
  if (!fits) {
    find(Outward_box(Polygon{from, to}), found);
  } else {
    // 2. In parts, as their boxes are smaller together than that of the whole.
    std::size_t parts = 1;
    while (parts * parts * parts < boxes_.size() && parts < 1024) parts *= 2;
    const auto point = [&](std::size_t i) {
      std::array<double, 3> p{};
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = a[k] + static_cast<double>(i) / static_cast<double>(parts) * (b[k] - a[k]);
      return p;
    };
    for (std::size_t i = 0; i < parts; ++i) find(box_about(point(i), point(i + 1), error), found);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace sightline::certificate_check
