#include <sightline/kernel/scene/planar_pieces.h>

namespace sightline::planar {

void Pieces::merge() {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t first = 0; first < origin.size(); ++first) {
      if (!alive[first] || twin[first] == none) continue;
      if (twin[previous[first]] == next[twin[first]]) continue;  // the chain begins earlier
      std::uint32_t last = first;
      while (twin[next[last]] != none && twin[next[last]] == previous[twin[last]]) last = next[last];
      const std::uint32_t before = previous[first], after = next[last];
      const std::uint32_t other_before = previous[twin[last]], other_after = next[twin[first]];
      // Neither angle can reach a full turn, or the chain would be longer: a left turn or straight means at most pi.
      if (turn_at(before, other_after) == CGAL::RIGHT_TURN || turn_at(other_before, after) == CGAL::RIGHT_TURN)
        continue;
      unite(first, last);
      changed = true;
    }
  }
}

void Pieces::merge_circles() {
  const auto corner_beyond = [&](std::uint32_t h) -> const Site& { return sites[origin[previous[h]]]; };
  std::vector<std::uint32_t> diagonals;
  for (std::uint32_t h = 0; h < origin.size(); ++h)
    if (twin[h] != none && h < twin[h] &&
        Traits::Side_of_oriented_circle_2{}(sites[origin[h]], sites[destination(h)], corner_beyond(h),
                                            corner_beyond(twin[h])) == CGAL::ON_ORIENTED_BOUNDARY)
      diagonals.push_back(h);
  for (const std::uint32_t h : diagonals) unite(h, h);
}

void Pieces::unite(std::uint32_t first, std::uint32_t last) {
  const std::uint32_t before = previous[first], after = next[last];
  const std::uint32_t other_before = previous[twin[last]], other_after = next[twin[first]];
  for (std::uint32_t h = first;; h = next[h]) {
    alive[h] = alive[twin[h]] = false;
    if (h == last) break;
  }
  link(before, other_after);
  link(other_before, after);
}

std::vector<std::vector<std::uint32_t>> Pieces::loops(bool with_straight_corners) const {
  std::vector<std::vector<std::uint32_t>> result;
  std::vector<bool> seen(origin.size(), false);
  for (std::uint32_t start = 0; start < origin.size(); ++start) {
    if (!alive[start] || seen[start]) continue;
    std::vector<std::uint32_t>& piece = result.emplace_back();
    for (std::uint32_t h = start; !seen[h]; h = next[h]) {
      seen[h] = true;
      if (with_straight_corners || turn_at(previous[h], h) != CGAL::COLLINEAR) piece.push_back(origin[h]);
    }
  }
  return result;
}

}  // namespace sightline::planar
