// A model of a million triangles from arrays; bench/arrays.py does the same in Python and compares.

#include <sightline/sightline.h>

#include <sightline/harness/compare/process_memory.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <vector>

int main() {
  constexpr std::uint32_t n = 708;  // corners along each side of a terrain
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j)
      points.push_back({i * 0.01, j * 0.01, ((i * 7919 + j * 104729) % 1000) / 512.0});
  for (std::uint32_t i = 0; i + 1 < n; ++i)
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
      const std::uint32_t k = i * n + j;
      triangles.push_back({k, k + n, k + n + 1});
      triangles.push_back({k, k + n + 1, k + 1});
    }
  const sightline::Peak_memory memory;
  const std::clock_t start = std::clock();
  const auto model = sightline::Model::of_triangles(points, triangles);
  std::printf("%zu %.3f %.1f\n", model.face_count(), static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC,
              static_cast<double>(memory.bytes()) / 1e6);
}
