#include "partition_picture.h"

#include "../support/picture.h"

#include <sightline/harness/generate/random.h>
#include <sightline/io/svg.h>
#include <sightline/kernel/vectors.h>

namespace sightline::app {

namespace {

/// Of a face, from where its first chart begins.
Near_doubles doubles_of(const Divided_face& divided) {
  Rational size = 0;
  for (const Light_partition& partition : divided.pieces)
    for (const std::size_t side : {1, 2})
      for (const Rational& x : partition.chart[side]) size = std::max(size, Rational(abs(x)));
  return {divided.pieces.front().chart[0], size};
}

std::array<double, 3> unit_vector(std::array<double, 3> a) {
  const double length = std::sqrt(dot(a, a));
  for (double& x : a) x /= length;
  return a;
}

// ---- Rays

/// A piece in its chart: a corner and the direction to the next, counterclockwise or not.
std::vector<Flat_point> chart_corners(const Scene& scene, const Light_partition& partition,
                                      const Near_doubles& doubles) {
  const std::array<double, 3> u = doubles.vector(partition.chart[1]), v = doubles.vector(partition.chart[2]);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), area = uu * vv - uv * uv;
  std::vector<Flat_point> corners;
  for (const Piece_corner& corner : scene.corners(scene.pieces()[partition.piece])) {
    const std::array<double, 3> p = doubles.vector(minus(scene.position(corner.point), partition.chart[0]));
    const double pu = dot(p, u), pv = dot(p, v);
    corners.push_back({(pu * vv - pv * uv) / area, (pv * uu - pu * uv) / area});
  }
  return corners;
}

double signed_area(const std::vector<Flat_point>& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Flat_point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    sum += (p[0] * q[1] - q[0] * p[1]) / 2;
  }
  return sum;
}

/// What of a convex polygon is within low <= coordinate <= high.
std::vector<Flat_point> between(std::vector<Flat_point> polygon, std::size_t axis, double low, double high) {
  for (const auto& [limit, sense] : {std::pair(low, 1.0), std::pair(high, -1.0)}) {
    std::vector<Flat_point> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Flat_point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double a = sense * (p[axis] - limit), b = sense * (q[axis] - limit);
      if (a >= 0) kept.push_back(p);
      if ((a < 0) != (b < 0))
        kept.push_back({p[0] + (q[0] - p[0]) * (a / (a - b)), p[1] + (q[1] - p[1]) * (a / (a - b))});
    }
    polygon = std::move(kept);
  }
  return polygon;
}

/// Strictly inside a piece, all exactly.
bool is_inside(const Scene& scene, const Piece& piece, const Exact_point& p) {
  const auto h = scene.file_coefficients(piece.support);
  const Exact_point normal{h[0], h[1], h[2]};
  const std::span<const Piece_corner> corners = scene.corners(piece);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Exact_point a = scene.position(corners[i].point),
                      along = minus(scene.position(corners[(i + 1) % corners.size()].point), a);
    if (dot(cross(along, minus(p, a)), normal) <= 0) return false;
  }
  return true;
}

// ---- Where the picture is

/// A plane's coordinates in doubles, the first chart's x to the right, and the pixels that they become.
class Picture_frame {
 public:
  static constexpr double margin = 20, legend = 36, wide = 760;

  Picture_frame(const Scene& scene, const Divided_face& divided) : doubles_(doubles_of(divided)) {
    const Light_partition& first = divided.pieces.front();
    right_ = unit_vector(doubles_.vector(first.chart[1]));
    const auto h = scene.file_coefficients(scene.pieces()[first.piece].support);
    const Rational largest = std::max({Rational(abs(h[0])), Rational(abs(h[1])), Rational(abs(h[2]))});
    up_ = cross(unit_vector(Near_doubles({}, largest).vector({h[0], h[1], h[2]})), right_);
    low_ = high_ = flat(first, 0, 0);
    for (const Light_partition& partition : divided.pieces)
      for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
        const Flat_point p = flat(partition, x, y);
        for (std::size_t k = 0; k < 2; ++k) {
          low_[k] = std::min(low_[k], p[k]);
          high_[k] = std::max(high_[k], p[k]);
        }
      }
    scale_ = wide / std::max(high_[0] - low_[0], high_[1] - low_[1]);
  }

  double width() const { return scale_ * (high_[0] - low_[0]); }
  double height() const { return scale_ * (high_[1] - low_[1]); }
  Flat_point pixel(const Light_partition& partition, double x, double y) const {
    const Flat_point p = flat(partition, x, y);
    return {margin + scale_ * (p[0] - low_[0]), legend + scale_ * (p[1] - low_[1])};
  }

 private:
  Flat_point flat(const Light_partition& partition, double x, double y) const {
    const std::array<double, 3> o = doubles_.point(partition.chart[0]), u = doubles_.vector(partition.chart[1]),
                                v = doubles_.vector(partition.chart[2]);
    std::array<double, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = o[k] + x * u[k] + y * v[k];
    return {dot(p, right_), -dot(p, up_)};
  }

  Near_doubles doubles_;
  std::array<double, 3> right_, up_;
  Flat_point low_, high_;
  double scale_;
};

const char* fill_of(Light light) {
  constexpr const char* fills[] = {"#fdeeb5", "#d8a24c", "#3d4257", "#a05fb0"};
  return fills[static_cast<std::size_t>(light)];
}

using Shapes = std::array<std::vector<std::vector<Flat_point>>, lights>;

/// A chain over a stretch of x as pixels, with so many points as one sees.
std::vector<Flat_point> pixels_of(const Picture_frame& frame, const Light_partition& partition,
                                  const std::vector<Flat_point>& chain) {
  constexpr double step = 5;
  std::vector<Flat_point> all;
  for (const Flat_point& p : chain) all.push_back(frame.pixel(partition, p[0], p[1]));
  const double length = std::hypot(all.back()[0] - all.front()[0], all.back()[1] - all.front()[1]);
  std::size_t every = 1;
  while (2 * every < all.size() && length * static_cast<double>(every) < step * static_cast<double>(all.size() - 1))
    every *= 2;
  std::vector<Flat_point> kept;
  for (std::size_t k = 0; k + 1 < all.size(); k += every) kept.push_back(all[k]);
  kept.push_back(all.back());
  return kept;
}

}  // namespace

Sampled_face sampled_face(const Occluders& occluders, const Divided_face& divided,
                          const std::vector<Weak_source>& sources, std::size_t rays, std::uint64_t seed,
                          const std::function<bool()>& out_of_time) {
  constexpr int in_a_square = 16;
  constexpr long fine = 1 << 20;
  const Scene& scene = occluders.scene();
  const Near_doubles doubles = doubles_of(divided);
  generate::Random random(seed);
  // 1. How long a square's side is.
  std::vector<std::array<double, 2>> sides;
  double area = 0;
  for (const Light_partition& partition : divided.pieces) {
    const std::array<double, 3> u = doubles.vector(partition.chart[1]), v = doubles.vector(partition.chart[2]);
    sides.push_back({std::sqrt(dot(u, u)), std::sqrt(dot(v, v))});
    area += sides.back()[0] * sides.back()[1] * std::fabs(signed_area(chart_corners(scene, partition, doubles)));
  }
  const double side = std::sqrt(in_a_square * area / static_cast<double>(rays));
  // 2. Rays from each square of each piece, if they begin within it.
  Sampled_face sampled;
  double sum = 0;
  for (std::size_t n = 0; n < divided.pieces.size() && !sampled.ended; ++n) {
    const Light_partition& partition = divided.pieces[n];
    const Near_plane& plane = occluders.plane(partition.piece);
    const std::vector<Flat_point> corners = chart_corners(scene, partition, doubles);
    std::array<long, 2> count;
    for (std::size_t k = 0; k < 2; ++k) count[k] = std::max(1L, std::lround(sides[n][k] / side));
    const auto reaches = [&](const Near_point& p) {
      const Weak_source& source = sources[random.below(sources.size())];
      std::array<Integer, 4> at{0, 0, 0, 0};
      for (const Near_point& corner : source.polygon) {
        const unsigned long weight = 1 + random.below(fine);
        Integer others = weight;  // homogeneous coordinates with equal w
        for (const Near_point& other : source.polygon)
          if (&other != &corner) others *= other.exact[3];
        for (std::size_t k = 0; k < 4; ++k) at[k] += others * corner.exact[k];
      }
      const Near_point q = near_point(occluders.frame(), std::move(at));
      return sightline::side(source.plane, p) > 0 && sightline::side(plane, q) > 0 &&
             !occluders.blocker(p, q, plane, source.plane);
    };
    for (long i = 0; i < count[0] && !sampled.ended; ++i)
      for (long j = 0; j < count[1] && !sampled.ended; ++j) {
        int asked = 0, free = 0;
        for (int k = 0; k < in_a_square && !sampled.ended; ++k) {
          sampled.ended = has_run_out(out_of_time);
          const auto place = [&](long at, long of) {
            Rational found(at * fine + static_cast<long>(random.below(fine)), of * fine);
            found.canonicalize();
            return found;
          };
          const Rational x = place(i, count[0]), y = place(j, count[1]);
          const Exact_point p = partition.point(x, y);
          if (!is_inside(scene, scene.pieces()[partition.piece], p)) continue;
          ++asked;
          free += reaches(occluders.located(p));
        }
        if (asked == 0 || sampled.ended) continue;
        const auto along = [](long at, long of) { return static_cast<double>(at) / static_cast<double>(of); };
        const Sampled_face::Square square{n,
                                          {along(i, count[0]), along(i + 1, count[0])},
                                          {along(j, count[1]), along(j + 1, count[1])},
                                          free == asked ? Light::lit
                                          : free == 0   ? Light::umbra
                                                        : Light::penumbra};
        const double part =
            sides[n][0] * sides[n][1] *
            std::fabs(signed_area(between(between(corners, 0, square.x[0], square.x[1]), 1, square.y[0], square.y[1])));
        sampled.shares[static_cast<std::size_t>(square.light)] += part;
        sum += part;
        sampled.rays += static_cast<std::size_t>(asked);
        sampled.squares.push_back(square);
      }
  }
  if (sum > 0)
    for (double& share : sampled.shares) share /= sum;
  return sampled;
}

std::string picture_of(const Scene& scene, const Divided_face& divided, const Sampled_face* beside) {
  const Picture_frame frame(scene, divided);
  const double to_second = frame.width() + Picture_frame::margin;
  Svg svg(
      static_cast<int>(std::ceil(2 * Picture_frame::margin + frame.width() + (beside != nullptr ? to_second : 0.0))),
      static_cast<int>(std::ceil(Picture_frame::margin + Picture_frame::legend + frame.height())), "#f4f3ef");
  const auto words = [](std::string text, const auto& share) {
    for (const Light light : {Light::lit, Light::penumbra, Light::umbra, Light::undecided})
      if (const double own = share(light); light != Light::undecided || own > 0)
        text += fmt::format(" {} {:.2f} %,", name_of(light), 100 * own);
    text.pop_back();
    return text;
  };
  // 1. Cells, then borders.
  Shapes shapes;
  std::vector<std::vector<Flat_point>> borders;
  for (const Light_partition& partition : divided.pieces) {
    for (const Light_partition::Strip& strip : partition.strips) {
      std::vector<Flat_point> polygon = pixels_of(frame, partition, strip.lower),
                              upper = pixels_of(frame, partition, strip.upper);
      polygon.insert(polygon.end(), upper.rbegin(), upper.rend());
      shapes[static_cast<std::size_t>(partition.cells[strip.cell].light)].push_back(std::move(polygon));
    }
    for (const std::vector<Flat_point>& line : partition.border_lines)
      borders.push_back(pixels_of(frame, partition, line));
  }
  for (std::size_t light = 0; light < lights; ++light) svg.shape(shapes[light], fill_of(static_cast<Light>(light)));
  svg.chains(borders, "#20242c", 1.1);
  svg.label(Picture_frame::margin, 24, 15, words(fmt::format("face {}:", divided.face), [&](Light light) {
              const Bounded share = divided.shares[static_cast<std::size_t>(light)];
              return (share.low + share.high) / 2;
            }));
  if (beside == nullptr) return svg.text();
  // 2. Squares of rays.
  const Near_doubles doubles = doubles_of(divided);
  Shapes squares;
  for (const Sampled_face::Square& square : beside->squares) {
    const Light_partition& partition = divided.pieces[square.piece];
    std::vector<Flat_point> pixels;
    for (const Flat_point& p : between(between(chart_corners(scene, partition, doubles), 0, square.x[0], square.x[1]),
                                       1, square.y[0], square.y[1])) {
      const Flat_point at = frame.pixel(partition, p[0], p[1]);
      pixels.push_back({at[0] + to_second, at[1]});
    }
    if (pixels.size() >= 3) squares[static_cast<std::size_t>(square.light)].push_back(std::move(pixels));
  }
  for (std::size_t light = 0; light < lights; ++light) svg.shape(squares[light], fill_of(static_cast<Light>(light)));
  svg.label(Picture_frame::margin + to_second, 24, 15, words(fmt::format("{} rays:", beside->rays), [&](Light light) {
              return beside->shares[static_cast<std::size_t>(light)];
            }));
  return svg.text();
}

}  // namespace sightline::app
