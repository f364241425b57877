#include <sightline/algorithms/priority/pixels.h>

namespace sightline {

namespace priority_detail {

Pixel_cone::Pixel_cone(const std::vector<Exact_point>& corners, const Exact_point& eye) {
  std::vector<std::array<double, 3>> rounded;
  for (const Exact_point& p : corners) {
    const Exact_point& arm = arms.emplace_back(minus(p, eye));
    rounded.push_back({nearest_double(arm[0]), nearest_double(arm[1]), nearest_double(arm[2])});
  }
  for (std::size_t k = 0; k < arms.size(); ++k) sides.emplace_back(rounded[next(k)], rounded[k]);
}

bool Pixel_cone::holds(const std::array<double, 3>& d, Pixel_sets& counts) const {
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const int side = sides[k].side(d);
    if (side > 0) continue;
    if (side < 0) return false;
    ++counts.exact;
    if (sgn(dot(cross(arms[next(k)], arms[k]), {exact(d[0]), exact(d[1]), exact(d[2])})) <= 0) return false;
  }
  return true;
}

}  // namespace priority_detail

Pixel_statistics pixel_statistics(const Pixel_sets& sets, std::span<const std::uint32_t> priority) {
  Pixel_statistics found;
  found.image.reserve(sets.size());
  for (std::size_t pixel = 0; pixel < sets.size(); ++pixel) {
    const std::span<const std::uint32_t> all = sets[pixel];
    std::uint32_t best = std::numeric_limits<std::uint32_t>::max();
    for (const std::uint32_t i : all) best = std::min(best, priority[i]);
    const std::size_t left = static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [&](std::uint32_t i) { return priority[i] == best; }));
    found.image.push_back(static_cast<std::uint32_t>(left));
    if (all.empty()) continue;
    ++found.covered;
    found.several += all.size() > 1;
    found.single += left == 1;
    found.faces += all.size();
    found.left += left;
    if (found.by_size.size() <= all.size()) found.by_size.resize(all.size() + 1);
    if (found.by_size[all.size()].size() <= left) found.by_size[all.size()].resize(left + 1);
    ++found.by_size[all.size()][left];
  }
  return found;
}

template Pixel_sets pixel_sets(const Priority_relation<Exact_traits>&, const Pixel_view&, const std::function<void()>&);
template std::vector<std::uint32_t> priorities(const Exact_traits&, const Priority_tree<Exact_traits>&,
                                               const Exact_point&);

}  // namespace sightline
