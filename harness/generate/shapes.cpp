#include <sightline/harness/generate/shapes.h>

#include <sightline/harness/generate/random.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sightline::generate {

Lattice_point circle_point(std::uint64_t k, std::uint64_t n, std::int64_t radius) {
  const std::uint64_t quadrant = 4 * k / n, rest = 4 * k % n;
  const Integer u = static_cast<unsigned long>(rest), v = static_cast<unsigned long>(n);
  const Integer p = u * (11 * v * v + 3 * u * u), q = 14 * v * v * v;  // t = p / q
  const Integer denominator = q * q + p * p;
  const auto rounded = [&](const Integer& numerator) {
    Integer result;
    const Integer above = 2 * static_cast<long>(radius) * numerator + denominator, below = 2 * denominator;
    mpz_fdiv_q(result.get_mpz_t(), above.get_mpz_t(), below.get_mpz_t());
    return static_cast<std::int64_t>(result.get_si());
  };
  const std::int64_t x = rounded(q * q - p * p), y = rounded(2 * p * q);
  switch (quadrant % 4) {
    case 0: return {x, y};
    case 1: return {-y, x};
    case 2: return {-x, -y};
    default: return {y, -x};
  }
}

Polygon_soup convex_sphere(std::size_t faces, std::uint64_t seed) {
  require(faces <= 10000000, "convex_sphere: at most 10^7 faces");
  std::size_t b = 1;
  while (8 * (b + 1) * (b + 1) <= faces) ++b;
  const std::size_t a = std::max<std::size_t>((faces + 8 * b - 1) / (8 * b), 1);
  const std::size_t slices = 4 * a, stacks = 2 * b;

  // The third grid in a row on which both outlines are strictly convex.
  const auto left_turn = [](const Lattice_point& p, const Lattice_point& q, const Lattice_point& r) {
    return (q[0] - p[0]) * (r[1] - q[1]) > (q[1] - p[1]) * (r[0] - q[0]);
  };
  std::vector<Lattice_point> ring, meridian;
  int bits = 4;
  for (int successes = 0; successes < 3; ++bits) {
    require(bits <= 26, "convex_sphere: too many faces for exact doubles");
    const std::int64_t radius = std::int64_t{1} << bits;
    ring.clear();
    meridian.clear();
    for (std::size_t k = 0; k < slices; ++k) ring.push_back(circle_point(k, slices, radius));
    for (std::size_t k = 0; k <= stacks; ++k) meridian.push_back(circle_point((k + 3 * b) % (4 * b), 4 * b, radius));
    bool convex = true;
    for (std::size_t k = 0; k < slices; ++k)
      convex = convex && left_turn(ring[k], ring[(k + 1) % slices], ring[(k + 2) % slices]);
    for (std::size_t k = 0; k + 1 < meridian.size(); ++k) {
      convex = convex && meridian[k][1] < meridian[k + 1][1] && (k == 0 || meridian[k][0] > 0);
      convex = convex && (k == 0 || left_turn(meridian[k - 1], meridian[k], meridian[k + 1]));
    }
    successes = convex ? successes + 1 : 0;
  }
  --bits;

  Polygon_soup soup;
  soup.file = "convex_sphere";
  soup.coordinates.reserve(3 * (slices * (stacks - 1) + 2));
  const double step = std::ldexp(1.0, -2 * bits);
  const std::int64_t radius = std::int64_t{1} << bits;
  const auto add = [&](std::int64_t r, const Lattice_point& p, std::int64_t z) {
    soup.add_point(static_cast<double>(r * p[0]) * step, static_cast<double>(r * p[1]) * step,
                   static_cast<double>(radius * z) * step);
  };
  add(0, {0, 0}, meridian[0][1]);
  for (std::size_t i = 1; i < stacks; ++i)
    for (const Lattice_point& p : ring) add(meridian[i][0], p, meridian[i][1]);
  add(0, {0, 0}, meridian[stacks][1]);

  const Point_id north = static_cast<Point_id>(soup.point_count() - 1);
  const auto id = [&](std::size_t i, std::size_t j) {
    return i == 0 ? 0 : i == stacks ? north : static_cast<Point_id>(1 + (i - 1) * slices + j % slices);
  };
  std::vector<std::uint32_t> order(slices * stacks);
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<std::uint32_t>(k);
  if (seed != 0) Random(seed).shuffle(order);
  for (const std::uint32_t k : order) {
    const std::size_t i = k / slices, j = k % slices;
    if (i == 0) soup.add_face({id(0, 0), id(1, j + 1), id(1, j)});
    else if (i + 1 == stacks) soup.add_face({id(i, j), id(i, j + 1), north});
    else soup.add_face({id(i, j), id(i, j + 1), id(i + 1, j + 1), id(i + 1, j)});
  }
  return soup;
}

Polygon_soup triangulated_sphere(int meridians, int rings, double x) {
  Polygon_soup soup;
  const auto near = [](double value) { return std::round(value * 0x1p20) * 0x1p-20; };
  const Point_id top = soup.add_point(near(x), 0.0, 1.0), bottom = soup.add_point(near(x), 0.0, -1.0);
  std::vector<std::vector<Point_id>> ring;
  for (int j = 1; j < rings; ++j) {
    ring.emplace_back();
    for (int i = 0; i < meridians; ++i) {
      const double height = M_PI * j / rings, angle = 2 * M_PI * (i + 0.37 * j) / meridians;
      ring.back().push_back(soup.add_point(near(x + std::sin(height) * std::cos(angle)),
                                           near(std::sin(height) * std::sin(angle)), near(std::cos(height))));
    }
  }
  for (int i = 0; i < meridians; ++i) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>((i + 1) % meridians);
    soup.add_face({top, ring.front()[a], ring.front()[b]});
    soup.add_face({bottom, ring.back()[b], ring.back()[a]});
    for (std::size_t j = 0; j + 1 < ring.size(); ++j) {
      soup.add_face({ring[j][a], ring[j + 1][a], ring[j + 1][b]});
      soup.add_face({ring[j][a], ring[j + 1][b], ring[j][b]});
    }
  }
  return soup;
}

Polygon_soup bars(std::size_t n) {
  require(n >= 3 && n <= 1000000, "bars: size must be in 3 .. 10^6");
  // A side is 2^18 / 8 or longer; a bar ends 1/8 of its side beyond the corners and is 1/8 of it wide.
  const std::int64_t radius = std::int64_t{1} << 18;
  const std::int64_t large = radius * static_cast<std::int64_t>(n) / 8 + radius;
  Polygon_soup soup;
  soup.file = "bars";
  for (std::size_t k = 0; k < n; ++k) {
    const Lattice_point from = circle_point(k, n, large), to = circle_point((k + 1) % n, n, large);
    const std::int64_t x = (to[0] - from[0]) / 16,
                       y = (to[1] - from[1]) / 16;  // a sixteenth of the side: half the width
    // The parallelogram start +- (-y, x), start + (to - from + 4 (x, y)) +- (-y, x), rising from 0 to one radius.
    const std::int64_t start_x = from[0] - 2 * x, start_y = from[1] - 2 * y, end_x = to[0] + 2 * x,
                       end_y = to[1] + 2 * y;
    const auto add = [&](std::int64_t px, std::int64_t py, double pz) {
      return soup.add_point(static_cast<double>(px) * 0x1p-18, static_cast<double>(py) * 0x1p-18, pz);
    };
    const Point_id first = add(start_x + y, start_y - x, 0.0);
    add(end_x + y, end_y - x, 1.0);
    add(end_x - y, end_y + x, 1.0);
    add(start_x - y, start_y + x, 0.0);
    soup.add_face({first, first + 1, first + 2, first + 3});
  }
  return soup;
}

Polygon_soup crossing(std::size_t n) {
  require(n <= 100000, "crossing: at most 10^5 faces");
  const int bits = n <= 1000 ? 18 : 36;
  Polygon_soup soup;
  soup.file = "crossing";
  for (std::size_t k = 0; k < n; ++k) {
    const Lattice_point p = circle_point(k, 2 * n, std::int64_t{1} << bits);  // half a turn
    const double x = std::ldexp(static_cast<double>(p[0]), -bits), y = std::ldexp(static_cast<double>(p[1]), -bits);
    const Point_id first = soup.add_point(-x, -y, -1.0);
    soup.add_point(x, y, -1.0);
    soup.add_point(x, y, 1.0);
    soup.add_point(-x, -y, 1.0);
    soup.add_face({first, first + 1, first + 2, first + 3});
  }
  return soup;
}

Polygon_soup stacked(std::size_t n) {
  require(n <= 100000000, "stacked: at most 10^8 faces");
  Polygon_soup soup;
  soup.file = "stacked";
  for (std::size_t k = 0; k < n; ++k) {
    const double z = static_cast<double>(k) * 0x1p-10;
    const Point_id first = soup.add_point(0.0, 0.0, z);
    soup.add_point(1.0, 0.0, z);
    soup.add_point(1.0, 1.0, z);
    soup.add_point(0.0, 1.0, z);
    soup.add_face({first, first + 1, first + 2, first + 3});
  }
  return soup;
}

}  // namespace sightline::generate
