#include <sightline/harness/generate/soups.h>

#include <sightline/harness/generate/random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

namespace sightline::generate {

std::uint64_t cube_root(std::uint64_t n) {
  std::uint64_t root = 0;
  for (std::uint64_t bit = std::uint64_t{1} << 21; bit > 0; bit >>= 1) {
    const std::uint64_t larger = root | bit;
    if (static_cast<unsigned __int128>(larger) * larger * larger <= n) root = larger;
  }
  return root;
}

Polygon_soup soup_on_grid(std::size_t n, std::int64_t edge_steps, std::uint64_t seed, int bits) {
  require(bits >= 4 && bits <= 30, "soup: bits must be in 4 .. 30");
  require(edge_steps >= 4, "soup: the edge must be four steps of the grid or longer");
  require(n <= 1000000000, "soup: at most 10^9 triangles");
  const std::int64_t size = std::int64_t{1} << bits;
  const std::int64_t reach = std::min(3 * std::min(edge_steps, size) / 4, size / 2);
  const double step = std::ldexp(1.0, -bits);
  Random random(seed);
  Polygon_soup soup;
  soup.file = "soup";
  soup.coordinates.reserve(9 * n);
  for (std::size_t k = 0; k < n; ++k) {
    using Corner = std::array<std::int64_t, 3>;
    std::array<Corner, 3> corners;
    const auto has_area = [&] {
      // Differences have at most 30 bits, so nothing overflows.
      const auto [a, b, c] = corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if ((b[i] - a[i]) * (c[j] - a[j]) != (b[j] - a[j]) * (c[i] - a[i])) return true;
      }
      return false;
    };
    do {
      Corner centre;
      for (std::int64_t& c : centre) c = random.between(reach, size - reach);
      for (Corner& corner : corners)
        for (std::size_t i = 0; i < 3; ++i) corner[i] = centre[i] + random.between(-reach, reach);
    } while (!has_area());
    Point_id first = 0;
    for (const Corner& c : corners)
      first = soup.add_point(static_cast<double>(c[0]) * step, static_cast<double>(c[1]) * step,
                             static_cast<double>(c[2]) * step);
    soup.add_face({first - 2, first - 1, first});
  }
  return soup;
}

Polygon_soup soup(std::size_t n, double edge, std::uint64_t seed, int bits) {
  require(std::isfinite(edge) && edge > 0 && bits >= 4 && bits <= 30,
          "soup: the edge must be positive, bits in 4 .. 30");
  return soup_on_grid(n, std::llround(std::ldexp(std::min(edge, 1.0), bits)), seed, bits);
}

Polygon_soup soup_constant_density(std::size_t n, std::uint64_t seed) {
  require(n <= 1000000000, "soup_constant_density: at most 10^9 triangles");
  const std::uint64_t side = std::max<std::uint64_t>(cube_root(std::uint64_t{n} << 30), 1 << 10);  // 2^10 n^(1/3)
  Polygon_soup result = soup_on_grid(n, static_cast<std::int64_t>((std::uint64_t{1} << 36) / side), seed, 26);
  result.file = "soup_constant_density";
  return result;
}

Polygon_soup slivers(std::size_t n, std::uint64_t seed) {
  require(n <= 1000000000, "slivers: at most 10^9 triangles");
  constexpr std::int64_t size = std::int64_t{1} << 26;
  using Corner = std::array<std::int64_t, 3>;
  Polygon_soup result = soup_constant_density(n - n / 10, seed);
  result.file = "slivers";
  Random random(seed);
  const auto any = [&] { return Corner{random.between(0, size), random.between(0, size), random.between(0, size)}; };
  for (std::size_t k = 0; k < n / 10; ++k) {
    Corner a, b, c;
    for (bool is_long = false, has_area = false; !is_long || !has_area;) {
      a = any();
      b = any();
      const std::int64_t weight = random.between(1, 15);
      is_long = has_area = false;
      Corner off;  // 16 times the way from the line to c
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t exact = (16 - weight) * a[i] + weight * b[i];
        c[i] = (exact + 8) / 16;
        off[i] = 16 * c[i] - exact;
        is_long = is_long || std::abs(b[i] - a[i]) >= size / 2;
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        has_area = has_area || off[i] * (b[j] - a[j]) != off[j] * (b[i] - a[i]);
      }
    }
    Point_id last = 0;
    for (const Corner& p : {a, b, c})
      last = result.add_point(std::ldexp(static_cast<double>(p[0]), -26), std::ldexp(static_cast<double>(p[1]), -26),
                              std::ldexp(static_cast<double>(p[2]), -26));
    result.add_face({last - 2, last - 1, last});
  }
  return result;
}

Polygon_soup triangles_between_squares(std::size_t n, std::uint64_t t) {
  require(n <= 1000000000, "triangles_between_squares: at most 10^9 triangles");
  Polygon_soup soup;
  soup.file = "triangles_between_squares";
  soup.coordinates.reserve(9 * n + 24);
  for (const auto& [x, y, z] : std::array<std::array<double, 3>, 8>{
           {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 10}, {-1, 1, 10}, {1, 1, 10}, {1, -1, 10}}})
    soup.add_point(x, y, z);
  soup.add_face({0, 1, 2, 3});
  soup.add_face({4, 5, 6, 7});
  std::mt19937 engine(static_cast<std::uint32_t>(1000 * std::uint64_t{n} + t));
  // As std::uniform_real_distribution<float>(-1, 1) of libstdc++, where a draw that rounds to 2^32 counts as the float
  // before.
  const auto u = [&] { return std::min(static_cast<float>(engine()) * 0x1p-32f, 1 - 0x1p-24f) * 2 - 1; };
  for (std::size_t k = 0; k < n; ++k) {
    const std::array<float, 3> draws{u(), u(), u()}, centre{1.2f * draws[0], 1.2f * draws[1], 5 + 4 * draws[2]};
    Point_id last = 0;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::array<float, 3> p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = centre[i] + 1.05f * u();
      last = soup.add_point(p[0], p[1], double{std::clamp(p[2], 0.1f, 9.9f)});
    }
    soup.add_face({last - 2, last - 1, last});
  }
  return soup;
}

Polygon_soup terrain(std::size_t n, std::uint64_t seed) {
  require(n <= 1000000000, "terrain: at most 10^9 triangles");
  std::size_t m = 1;
  while (2 * m * m < n) ++m;
  const std::size_t row = m + 1;
  Random random(seed);

  // Sum the octaves, each a lattice of random heights with bilinear interpolation in integers.
  std::vector<std::int64_t> height(row * row, 0);  // in steps of 2^-20
  std::size_t wave = 1;
  while (2 * wave <= m) wave *= 2;
  for (; wave > 0; wave /= 2) {
    const std::size_t nodes = m / wave + 2;
    const std::int64_t amplitude = static_cast<std::int64_t>(wave) << 8;  // a quarter of the wave length 2^-10 wave
    std::vector<std::int32_t> node(nodes * nodes);
    for (std::int32_t& h : node) h = static_cast<std::int32_t>(random.between(-amplitude, amplitude));
    const std::int64_t w = static_cast<std::int64_t>(wave);
    for (std::size_t j = 0; j < row; ++j)
      for (std::size_t i = 0; i < row; ++i) {
        const std::int64_t u = static_cast<std::int64_t>(i % wave), v = static_cast<std::int64_t>(j % wave);
        const std::int32_t* at = &node[(j / wave) * nodes + i / wave];
        const std::int64_t sum =
            (w - u) * (w - v) * at[0] + u * (w - v) * at[1] + (w - u) * v * at[nodes] + u * v * at[nodes + 1];
        height[j * row + i] += sum / (w * w);
      }
  }

  Polygon_soup soup;
  soup.file = "terrain";
  soup.coordinates.reserve(3 * row * row);
  for (std::size_t j = 0; j < row; ++j)
    for (std::size_t i = 0; i < row; ++i)
      soup.add_point(static_cast<double>(i) * 0x1p-10, static_cast<double>(j) * 0x1p-10,
                     static_cast<double>(height[j * row + i]) * 0x1p-20);
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < m; ++i) {
      const Point_id a = static_cast<Point_id>(j * row + i), b = a + 1, d = a + static_cast<Point_id>(row), c = d + 1;
      if (random.chance(1, 2)) {
        soup.add_face({a, b, c});
        soup.add_face({a, c, d});
      } else {
        soup.add_face({a, b, d});
        soup.add_face({b, c, d});
      }
    }
  return soup;
}

}  // namespace sightline::generate
