// A user of the front door, and of a kernel and traits of one's own.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/sightline.h>

#include <iostream>

std::string tenth_from_elsewhere();
std::size_t nodes_by_own_traits(const sightline::Scene& scene);
std::size_t nodes_by_own_kernel(const sightline::Scene& scene);

int main() {
  const std::vector<std::array<double, 3>> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const auto model = sightline::Model::of_triangles(points, triangles);
  const sightline::Scene scene(model.soup());
  std::cout << sightline::to_string(sightline::exact_decimal(1, -1)) << ' ' << tenth_from_elsewhere() << ' '
            << sightline::see(model, {2, 2, 2}).visible.size() << ' ' << nodes_by_own_traits(scene) << ' '
            << nodes_by_own_kernel(scene) << '\n';
}
