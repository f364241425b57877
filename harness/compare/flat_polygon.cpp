#include <sightline/harness/compare/flat_polygon.h>

#include <sightline/kernel/number.h>

#include <algorithm>
#include <utility>

namespace sightline {

Flat_polygon Flat_polygon::hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  const auto turn = [](const Point& p, const Point& q, const Point& r) {
    return sgn(Rational((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])));
  };
  std::vector<Point> chain;
  for (int half = 0; half < 2; ++half) {  // the lower chain from left to right, then the upper one back
    const std::size_t start = chain.size();
    for (const Point& p : points) {
      while (chain.size() >= start + 2 && turn(chain[chain.size() - 2], chain.back(), p) <= 0) chain.pop_back();
      chain.push_back(p);
    }
    if (!chain.empty()) chain.pop_back();
    std::reverse(points.begin(), points.end());
  }
  Flat_polygon polygon;
  if (chain.size() < 3) return polygon;
  for (std::size_t i = 0; i < chain.size(); ++i)
    polygon.lines_.push_back(line_through(chain[i], chain[(i + 1) % chain.size()]));
  return polygon;
}

Flat_polygon::Point Flat_polygon::vertex(std::size_t i) const {
  const std::array<Integer, 3> v = homogeneous(i);
  Point p{Rational(v[0], v[2]), Rational(v[1], v[2])};
  p[0].canonicalize();
  p[1].canonicalize();
  return p;
}

Flat_polygon Flat_polygon::clipped(const Flat_line& h) const {
  const std::size_t n = lines_.size();
  std::vector<int> side(n);
  for (std::size_t i = 0; i < n; ++i) side[i] = side_of_vertex(i, h);
  Flat_polygon part;
  if (std::none_of(side.begin(), side.end(), [](int s) { return s > 0; })) return part;
  if (std::none_of(side.begin(), side.end(), [](int s) { return s < 0; })) return *this;
  for (std::size_t i = 0; i < n; ++i) {  // line i runs from vertex i to vertex i + 1
    const int from = side[i], to = side[(i + 1) % n];
    if (from > 0 || to > 0) part.lines_.push_back(lines_[i]);
    if (from > 0 && to <= 0) part.lines_.push_back(h);
  }
  return part;
}

std::vector<Flat_polygon> Flat_polygon::without(const Flat_polygon& other) const {
  std::vector<Flat_polygon> pieces;
  if (other.empty()) return {*this};
  Flat_polygon rest = *this;
  for (const Flat_line& h : other.lines_) {
    if (rest.empty()) break;
    if (Flat_polygon outside = rest.clipped({Integer(-h[0]), Integer(-h[1]), Integer(-h[2])}); !outside.empty())
      pieces.push_back(std::move(outside));
    rest = rest.clipped(h);
  }
  return pieces;
}

Rational Flat_polygon::area() const {
  Rational twice = 0;
  for (std::size_t i = 1; i + 1 < lines_.size(); ++i) {
    const Point o = vertex(0), p = vertex(i), q = vertex(i + 1);
    twice += (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
  }
  return twice / 2;
}

Flat_polygon::Flat_line Flat_polygon::line_through(const Point& p, const Point& q) {
  const Rational a = p[1] - q[1], b = q[0] - p[0];
  Flat_line line = Over_common<3>({a, b, Rational(-(a * p[0] + b * p[1]))}).whole;
  const Integer divisor = gcd(gcd(line[0], line[1]), line[2]);
  for (Integer& x : line) x /= divisor;
  return line;
}

std::array<Integer, 3> Flat_polygon::homogeneous(std::size_t i) const {
  const Flat_line &g = lines_[i == 0 ? lines_.size() - 1 : i - 1], &h = lines_[i];
  return {g[1] * h[2] - g[2] * h[1], g[2] * h[0] - g[0] * h[2], g[0] * h[1] - g[1] * h[0]};
}

int Flat_polygon::side_of_vertex(std::size_t i, const Flat_line& h) const {
  const std::array<Integer, 3> v = homogeneous(i);
  return sgn(Integer(h[0] * v[0] + h[1] * v[1] + h[2] * v[2]));
}

}  // namespace sightline
