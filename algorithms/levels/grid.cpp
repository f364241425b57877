#include <sightline/algorithms/levels/grid.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace sightline {

namespace levels_detail {

using Counts = std::array<std::uint32_t, 3>;
using Box_corners = std::array<Exact_point, 2>;

/// The least and the largest coordinates of corners of faces; zeros where there are none.
Box_corners box_of_corners(const Polygon_soup& soup) {
  Box_corners box{};
  bool is_first = true;
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t l = 0; l < soup.loop_count(f); ++l)
      for (const Point_id id : soup.loop(f, l)) {
        const Exact_point p = soup.point(id);
        if (std::exchange(is_first, false)) box = {p, p};
        for (std::size_t k = 0; k < 3; ++k) {
          box[0][k] = std::min(box[0][k], p[k]);
          box[1][k] = std::max(box[1][k], p[k]);
        }
      }
  return box;
}

/// Halves boxes until each is alone.
class Box_divider {
 public:
  Box_divider(const Box_corners& box, const Counts& counts) : box_(box), counts_(counts) {}

  /// The node or leaf of the boxes from `low` up to, but without, `high`.
  std::int32_t divided(const Counts& low, const Counts& high) {
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    if (high[axis] - low[axis] == 1)
      return -1 - static_cast<std::int32_t>(low[0] + counts_[0] * (low[1] + counts_[1] * low[2]));
    Counts middle_low = low, middle_high = high;
    const std::uint32_t at = low[axis] + (high[axis] - low[axis]) / 2;
    middle_low[axis] = middle_high[axis] = at;
    Space_tree::Node node{};
    node.plane[axis] = 1;
    const Rational part = Rational(at) / counts_[axis];
    node.plane[3] = -(box_[0][axis] + part * (box_[1][axis] - box_[0][axis]));
    const std::size_t number = tree.nodes.size();
    tree.nodes.push_back(std::move(node));
    const std::array<std::int32_t, 2> children{divided(middle_low, high), divided(low, middle_high)};
    tree.nodes[number].children = children;
    return static_cast<std::int32_t>(number);
  }

  Space_tree tree;

 private:
  const Box_corners& box_;
  const Counts& counts_;
};

}  // namespace levels_detail

Space_tree even_boxes(const Polygon_soup& soup, const std::array<std::uint32_t, 3>& counts) {
  const levels_detail::Box_corners box = levels_detail::box_of_corners(soup);
  for (std::size_t k = 0; k < 3; ++k)
    if (counts[k] > 1 && box[0][k] == box[1][k])
      throw std::invalid_argument(std::string("the scene has no extent along ") + "xyz"[k] + ", so that it can't be " +
                                  "divided there");
  levels_detail::Box_divider divider(box, counts);
  divider.tree.root = divider.divided({0, 0, 0}, counts);
  return std::move(divider.tree);
}

}  // namespace sightline
