#include <sightline/algorithms/image/concave_window.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <utility>

namespace sightline {

namespace image_detail {

namespace {

/// (q - p) x (r - p): positive where r is to the left of the line from p to q.
Rational turn_of(const Image_point& p, const Image_point& q, const Image_point& r) {
  return Rational((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
}
int side_of(const Image_point& p, const Image_point& q, const Image_point& r) { return sgn(turn_of(p, q, r)); }
Image_point difference_of(const Image_point& p, const Image_point& q) {
  return {Rational(p[0] - q[0]), Rational(p[1] - q[1])};
}
int cross_sign(const Image_point& a, const Image_point& b) { return sgn(Rational(a[0] * b[1] - a[1] * b[0])); }
Image_point middle_of(const Image_point& p, const Image_point& q) {
  return {Rational((p[0] + q[0]) / 2), Rational((p[1] + q[1]) / 2)};
}

Rational loop_area(const Image_loop& loop) {
  Rational twice = 0;
  for (std::size_t k = 2; k < loop.size(); ++k) twice += turn_of(loop[0], loop[k - 1], loop[k]);
  return twice / 2;
}

/// What bounds the polygons, and the window.
enum Owner : std::size_t { of_polygons, of_window };

/// An edge from its lower to its higher end, which are compared by x, then y.
struct Segment {
  Image_point low, high;
  Owner owner;
  int sense;  ///< 1 where the loop runs that way, with its inside to the left, -1 against it

  bool is_vertical() const { return low[0] == high[0]; }
};

/// Windings on both sides of a part of an edge, seen from its lower end.
using Windings = std::array<int, 2>;
struct Part_sides {
  Windings left, right;
};

class Window_clipper {
 public:
  Window_clipper(std::span<const Image_polygon> polygons, std::span<const Image_polygon> window) {
    add(polygons, of_polygons);
    add(window, of_window);
    std::sort(segments_.begin(), segments_.end(), [](const Segment& a, const Segment& b) { return a.low < b.low; });
    for (const auto& [ends, steps] : parts()) {
      if (steps == Windings{0, 0}) continue;  // as much runs one way as the other
      sides_.emplace_back(ends, sides_of(ends.first, ends.second, steps));
    }
  }

  /// What is in the polygons, and in the window or not.
  std::vector<Image_polygon> result(bool in_window) const {
    const auto holds = [&](const Windings& w) { return w[of_polygons] != 0 && (w[of_window] != 0) == in_window; };
    std::vector<Ends> edges;
    for (const auto& [ends, sides] : sides_) {
      const bool left = holds(sides.left), right = holds(sides.right);
      if (left && !right) edges.push_back(ends);
      if (right && !left) edges.emplace_back(ends.second, ends.first);
    }
    return grouped(loops_of(edges));
  }

 private:
  using Ends = std::pair<Image_point, Image_point>;

  // ---- Edges, and where they are cut

  void add(std::span<const Image_polygon> polygons, Owner owner) {
    for (const Image_polygon& polygon : polygons) {
      add(polygon.outer, owner, 1);
      for (const Image_loop& hole : polygon.holes) add(hole, owner, -1);
    }
  }
  void add(const Image_loop& loop, Owner owner, int wanted) {
    const int sense =
        loop_area(loop) < 0 ? -1 : 1;  // where it has no area, it is a spike, which comes to nothing, or crosses itself
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Image_point &from = loop[k], &to = loop[k + 1 == loop.size() ? 0 : k + 1];
      if (from < to) segments_.push_back({from, to, owner, sense * wanted});
      if (to < from) segments_.push_back({to, from, owner, -sense * wanted});
    }
  }

  /// Parts of edges that no other one meets but in its ends or all over, with how windings grow to their left.
  std::map<Ends, Windings> parts() const {
    std::vector<Image_loop> cuts(segments_.size());
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      cuts[i].insert(cuts[i].end(), {segments_[i].low, segments_[i].high});
      for (std::size_t j = i + 1; j < segments_.size() && segments_[j].low[0] <= segments_[i].high[0]; ++j)
        meet(segments_[i], segments_[j], cuts[i], cuts[j]);
    }
    std::map<Ends, Windings> found;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      std::sort(cuts[i].begin(), cuts[i].end());
      cuts[i].erase(std::unique(cuts[i].begin(), cuts[i].end()), cuts[i].end());
      for (std::size_t k = 1; k < cuts[i].size(); ++k)
        found[{cuts[i][k - 1], cuts[i][k]}][segments_[i].owner] += segments_[i].sense;
    }
    return found;
  }
  static void meet(const Segment& a, const Segment& b, Image_loop& of_a, Image_loop& of_b) {
    const int low = side_of(a.low, a.high, b.low), high = side_of(a.low, a.high, b.high);
    if (low == 0 && high == 0) {  // on one line: ends that are between the other's
      for (const Image_point& p : {b.low, b.high})
        if (a.low < p && p < a.high) of_a.push_back(p);
      for (const Image_point& p : {a.low, a.high})
        if (b.low < p && p < b.high) of_b.push_back(p);
      return;
    }
    if (low * high > 0 || side_of(b.low, b.high, a.low) * side_of(b.low, b.high, a.high) > 0) return;
    const Rational from = turn_of(a.low, a.high, b.low), to = turn_of(a.low, a.high, b.high), t = from / (from - to);
    Image_point at;
    for (std::size_t k = 0; k < 2; ++k) at[k] = b.low[k] + t * (b.high[k] - b.low[k]);
    of_a.push_back(at);
    of_b.push_back(at);
  }

  // ---- Sides

  /// By a ray to the part's middle, from below, or, to an upright one, from the left: each edge that it crosses is a
  /// step, and those through the middle are the part's own.
  Part_sides sides_of(const Image_point& low, const Image_point& high, const Windings& steps) const {
    const Image_point middle = middle_of(low, high);
    const bool is_upright = low[0] == high[0];
    Windings before{};
    for (const Segment& s : segments_) {
      if (s.low[0] > middle[0]) break;
      if (is_upright) {
        const bool rises = s.low[1] < s.high[1];
        const Image_point &bottom = rises ? s.low : s.high, &top = rises ? s.high : s.low;
        if (bottom[1] <= middle[1] && middle[1] < top[1] && side_of(bottom, top, middle) < 0)
          before[s.owner] -= rises ? s.sense : -s.sense;
      } else if (middle[0] < s.high[0] && side_of(s.low, s.high, middle) > 0) {
        before[s.owner] += s.sense;
      }
    }
    Part_sides sides{before, before};
    for (std::size_t owner = 0; owner < 2; ++owner) {
      if (is_upright) sides.right[owner] -= steps[owner];
      else sides.left[owner] += steps[owner];
      for (const int winding : {sides.left[owner], sides.right[owner]})
        if (winding != 0 && winding != 1)
          throw std::invalid_argument("polygons that overlap, or loops that cross themselves or each other");
    }
    return sides;
  }

  // ---- Loops

  /// Loops of edges that have what they bound to their left, none of which passes a point twice.
  static std::vector<Image_loop> loops_of(const std::vector<Ends>& edges) {
    std::map<Image_point, std::vector<std::size_t>> from;
    for (std::size_t e = 0; e < edges.size(); ++e) from[edges[e].first].push_back(e);
    std::vector<char> used(edges.size());
    std::vector<Image_loop> loops;
    for (std::size_t first = 0; first < edges.size(); ++first) {
      Image_loop path;
      std::map<Image_point, std::size_t> place;  // of points on the path
      for (std::size_t e = first; !used[e]; e = next(edges, from, e)) {
        used[e] = true;
        const Image_point& at = edges[e].first;
        if (const auto seen = place.find(at); seen != place.end()) {  // a loop of its own
          const std::size_t begin = seen->second;
          loops.emplace_back(path.begin() + static_cast<std::ptrdiff_t>(begin), path.end());
          for (std::size_t k = begin; k < path.size(); ++k) place.erase(path[k]);
          path.resize(begin);
        }
        place[at] = path.size();
        path.push_back(at);
      }
      if (!path.empty()) loops.push_back(std::move(path));
    }
    return loops;
  }
  /// The edge that bounds the same wedge: the first one clockwise from the way back.
  static std::size_t next(const std::vector<Ends>& edges, const std::map<Image_point, std::vector<std::size_t>>& from,
                          std::size_t e) {
    const Image_point& at = edges[e].second;
    const Image_point back = difference_of(edges[e].first, at);
    const auto direction = [&](std::size_t f) { return difference_of(edges[f].second, at); };
    const std::vector<std::size_t>& leaving = from.at(at);
    return *std::min_element(leaving.begin(), leaving.end(), [&](std::size_t f, std::size_t g) {
      const Image_point a = direction(f), b = direction(g);
      const int half_a = cross_sign(back, a), half_b = cross_sign(back, b);  // -1: less than half a turn, 1: more
      return half_a != half_b ? half_a < half_b : cross_sign(a, b) < 0;
    });
  }

  // ---- Polygons

  static std::vector<Image_polygon> grouped(const std::vector<Image_loop>& loops) {
    std::vector<Image_polygon> polygons;
    std::vector<std::pair<const Image_loop*, Rational>> outers;  // of each polygon, with its area
    for (const Image_loop& loop : loops)
      if (const Rational area = loop_area(loop); area > 0) {
        polygons.push_back({without_straight_corners(loop), {}});
        outers.emplace_back(&loop, area);
      }
    for (const Image_loop& loop : loops) {
      if (loop_area(loop) > 0) continue;
      // A hole's part of an edge is no other loop's, so its middle is strictly inside the outer loop around it.
      const Image_point middle = middle_of(loop[0], loop[1]);
      std::size_t best = outers.size();
      for (std::size_t i = 0; i < outers.size(); ++i)
        if ((best == outers.size() || outers[i].second < outers[best].second) && encloses(*outers[i].first, middle))
          best = i;
      polygons.at(best).holes.push_back(without_straight_corners(loop));
    }
    return polygons;
  }
  static bool encloses(const Image_loop& loop, const Image_point& p) {
    bool inside = false;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Image_point &a = loop[k], &b = loop[k + 1 == loop.size() ? 0 : k + 1];
      if ((a[1] > p[1]) == (b[1] > p[1])) continue;
      if (side_of(a, b, p) * (b[1] > a[1] ? 1 : -1) > 0) inside = !inside;
    }
    return inside;
  }
  static Image_loop without_straight_corners(const Image_loop& loop) {
    Image_loop corners;
    for (std::size_t k = 0; k < loop.size(); ++k)
      if (side_of(loop[k == 0 ? loop.size() - 1 : k - 1], loop[k], loop[k + 1 == loop.size() ? 0 : k + 1]) != 0)
        corners.push_back(loop[k]);
    return corners;
  }

  std::vector<Segment> segments_;
  std::vector<std::pair<Ends, Part_sides>> sides_;
};

}  // namespace

}  // namespace image_detail

Rational area(const Image_polygon& polygon) {
  Rational sum = image_detail::loop_area(polygon.outer);
  for (const Image_loop& hole : polygon.holes) sum += image_detail::loop_area(hole);
  return sum;
}

Clipped_polygons clip_to_window(std::span<const Image_polygon> polygons, std::span<const Image_polygon> window) {
  const image_detail::Window_clipper clipper(polygons, window);
  return {clipper.result(true), clipper.result(false)};
}

}  // namespace sightline
