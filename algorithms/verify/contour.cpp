#include <sightline/algorithms/verify/contour.h>

#include <sightline/algorithms/verify/boxes.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace sightline::certificate_check {

namespace {

/// a - b over a positive denominator, not in lowest terms: what signs need no more of.
struct Difference {
  Integer over, under;

  void set(const Rational& a, const Rational& b) {
    mpz_mul(over.get_mpz_t(), a.get_num_mpz_t(), b.get_den_mpz_t());
    mpz_submul(over.get_mpz_t(), b.get_num_mpz_t(), a.get_den_mpz_t());
    mpz_mul(under.get_mpz_t(), a.get_den_mpz_t(), b.get_den_mpz_t());
  }
};

/// a b times all four denominators: of two such products the difference has the sign of a b - c d.
void set_product(Integer& result, const Difference& a, const Difference& b, const Difference& c, const Difference& d) {
  mpz_mul(result.get_mpz_t(), a.over.get_mpz_t(), b.over.get_mpz_t());
  mpz_mul(result.get_mpz_t(), result.get_mpz_t(), c.under.get_mpz_t());
  mpz_mul(result.get_mpz_t(), result.get_mpz_t(), d.under.get_mpz_t());
}

}  // namespace

int side(const Contour::Edge& e, const Contour::Point& p) {
  thread_local Difference along[2], apart[2];
  thread_local Integer left, right;
  for (std::size_t k = 0; k < 2; ++k) {
    along[k].set(e.to[k], e.from[k]);
    apart[k].set(p[k], e.from[k]);
  }
  set_product(left, along[0], apart[1], along[1], apart[0]);
  set_product(right, along[1], apart[0], along[0], apart[1]);
  const int order = cmp(left, right);
  return (order > 0) - (order < 0);
}

bool cross_inside(const Contour::Edge& e, const Contour::Edge& f) {
  return side(e, f.from) * side(e, f.to) < 0 && side(f, e.from) * side(f, e.to) < 0;
}

bool inside(const Contour::Edge& e, const Contour::Point& p) {
  return p != e.from && p != e.to && side(e, p) == 0 && std::min(e.from, e.to) < p && p < std::max(e.from, e.to);
}

namespace {

/// Where the lines of the edges meet. Pre: they are not parallel.
Contour::Point crossing(const Contour::Edge& e, const Contour::Edge& f) {
  const Rational ex = e.to[0] - e.from[0], ey = e.to[1] - e.from[1], fx = f.to[0] - f.from[0], fy = f.to[1] - f.from[1];
  const Rational t = ((f.from[0] - e.from[0]) * fy - (f.from[1] - e.from[1]) * fx) / (ex * fy - ey * fx);
  return {Rational(e.from[0] + t * ex), Rational(e.from[1] + t * ey)};
}

}  // namespace

Contour::Contour(const std::vector<Polygon>& loops, std::size_t axis, bool mirrored) {
  for (const Polygon& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      edges.push_back({look(loop[i], axis, mirrored), look(loop[(i + 1) % loop.size()], axis, mirrored)});
      points.insert(edges.back().from);
    }
}

Contour::Point Contour::look(const Exact_point& p, std::size_t axis, bool mirrored) {
  const Rational &x = p[(axis + 1) % 3], &y = p[(axis + 2) % 3];
  if (mirrored) return {y, x};
  return {x, y};
}

Contour seen_from_front(const std::vector<Polygon>& loops, const Plane& plane) {
  std::size_t axis = 0;
  while (sgn(plane.normal[axis]) == 0) ++axis;
  return Contour(loops, axis, sgn(plane.normal[axis]) < 0);
}

bool Contour::crosses_itself() const {
  // Edges cross in a point of both, so that their boxes meet. What is walked often, there or back, is one.
  std::set<std::pair<Point, Point>> segments;
  for (const Edge& e : edges) segments.emplace(std::min(e.from, e.to), std::max(e.from, e.to));
  std::vector<Edge> once;
  for (const auto& [from, to] : segments) once.push_back({from, to});
  std::vector<Outward_box> boxes;
  boxes.reserve(once.size());
  for (const Edge& e : once)
    boxes.emplace_back(Polygon{{e.from[0], e.from[1], Rational(0)}, {e.to[0], e.to[1], Rational(0)}});
  const Boxes tree(boxes);
  bool found = false;
  for (std::size_t leaf = 0; leaf < tree.leaves() && !found; ++leaf)
    tree.for_each_pair(leaf, [&](std::size_t i, std::size_t j) {
      const Edge &e = once[i], &f = once[j];
      found = found || (cross_inside(e, f) && !points.count(crossing(e, f)));
    });
  return found;
}

Contour::Winding Contour::winding() const {
  // 1. The edges from left to right; upright ones meet no line in the middle.
  std::vector<std::pair<const Rational*, const Edge*>> by_left_end;
  for (const Edge& e : edges)
    if (e.from[0] != e.to[0]) by_left_end.emplace_back(&std::min(e.from, e.to)[0], &e);
  std::stable_sort(by_left_end.begin(), by_left_end.end(),
                   [](const auto& a, const auto& b) { return *a.first < *b.first; });
  // 2. Between neighbouring abscissae no edges cross: add up the winding number from below on a line in the middle.
  std::set<Rational> abscissae;
  for (const Point& p : points) abscissae.insert(p[0]);
  Winding found = Winding::none;
  if (abscissae.empty()) return found;
  std::vector<const Edge*> here;
  auto next = by_left_end.begin();
  for (auto left = abscissae.begin(), right = std::next(left); right != abscissae.end(); ++left, ++right) {
    std::erase_if(here, [&](const Edge* e) { return std::max(e->from, e->to)[0] == *left; });
    for (; next != by_left_end.end() && *next->first == *left; ++next) here.push_back(next->second);
    const Rational middle = (*left + *right) / 2;
    std::map<Rational, int> steps;
    for (const Edge* e : here) {
      const auto& [from, to] = *e;
      const Rational height = from[1] + (to[1] - from[1]) * (middle - from[0]) / (to[0] - from[0]);
      steps[height] += from[0] < to[0] ? 1 : -1;
    }
    int number = 0;
    for (const auto& [height, step] : steps) {
      number += step;
      if (number != 0 && number != 1) return Winding::other;
      if (number == 1) found = Winding::once;
    }
  }
  return found;
}

bool Contour::edge_passes_a_point() const {
  std::map<std::pair<Point, Point>, long> walks;  // there minus back
  for (const auto& [from, to] : edges) {
    if (from < to) ++walks[{from, to}];
    else --walks[{to, from}];
  }
  return std::any_of(walks.begin(), walks.end(), [&](const auto& walk) {
    const Edge edge{walk.first.first, walk.first.second};
    return walk.second != 0 &&
           std::any_of(points.begin(), points.end(), [&](const Point& p) { return inside(edge, p); });
  });
}

}  // namespace sightline::certificate_check
