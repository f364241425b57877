#include <sightline/harness/laws/window_laws.h>

#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace window_laws {

using Polygons = std::vector<Image_polygon>;

// ---- The oracle: cells of slabs

/// Twice what a loop bounds, by the strips between its edges and the line y = 0.
Rational twice_strips(const Image_loop& loop) {
  Rational sum = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Image_point &a = loop[k], &b = loop[(k + 1) % loop.size()];
    sum += (a[0] - b[0]) * (a[1] + b[1]);
  }
  return sum;
}

/// An edge that is not upright, from left to right.
struct Slope {
  Image_point left, right;
  std::size_t list;  ///< 0 of the polygons, 1 of the window
  int step;          ///< by which the winding number above it is larger than below

  Rational at(const Rational& x) const {
    return Rational(left[1] + (x - left[0]) / (right[0] - left[0]) * (right[1] - left[1]));
  }
};

void add_slopes(std::span<const Image_polygon> polygons, std::size_t list, std::vector<Slope>& slopes) {
  const auto add = [&](const Image_loop& loop, int wanted) {
    // One of no area is a spike, which comes to nothing, or crosses itself.
    const int sense = (twice_strips(loop) < 0 ? -1 : 1) * wanted;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Image_point &a = loop[k], &b = loop[(k + 1) % loop.size()];
      if (a[0] < b[0]) slopes.push_back({a, b, list, sense});
      if (b[0] < a[0]) slopes.push_back({b, a, list, -sense});
    }
  };
  for (const Image_polygon& polygon : polygons) {
    add(polygon.outer, 1);
    for (const Image_loop& hole : polygon.holes) add(hole, -1);
  }
}

struct Slab_cell {
  Image_point inside;
  Rational area;
  std::array<int, 2> winding;
};

std::vector<Slab_cell> slab_cells(const std::vector<Slope>& slopes) {
  // 1. Where slabs end: at corners, and where edges cross.
  std::vector<Rational> ends;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    ends.insert(ends.end(), {slopes[i].left[0], slopes[i].right[0]});
    for (std::size_t j = 0; j < i; ++j) {
      const Rational from = std::max(slopes[i].left[0], slopes[j].left[0]),
                     to = std::min(slopes[i].right[0], slopes[j].right[0]);
      if (from >= to) continue;
      const Rational before = slopes[i].at(from) - slopes[j].at(from), after = slopes[i].at(to) - slopes[j].at(to);
      if (sgn(before) * sgn(after) < 0) ends.push_back(Rational(from + before / (before - after) * (to - from)));
    }
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  // 2. In each the edges, from below.
  std::vector<Slab_cell> cells;
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const Rational middle = (ends[k - 1] + ends[k]) / 2, width = ends[k] - ends[k - 1];
    std::vector<std::pair<Rational, const Slope*>> through;
    for (const Slope& slope : slopes)
      if (slope.left[0] <= ends[k - 1] && ends[k] <= slope.right[0]) through.emplace_back(slope.at(middle), &slope);
    std::sort(through.begin(), through.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::array<int, 2> winding{};
    for (std::size_t i = 0; i + 1 < through.size(); ++i) {
      winding[through[i].second->list] += through[i].second->step;
      const Rational &low = through[i].first, &high = through[i + 1].first;
      if (low < high) cells.push_back({{middle, Rational((low + high) / 2)}, Rational((high - low) * width), winding});
    }
  }
  return cells;
}

/// How often a loop runs around a point that is not on it, counterclockwise: what its edges cross of a ray to the
/// right.
int winding_around(const Image_loop& loop, const Image_point& p) {
  int winding = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Image_point &a = loop[k], &b = loop[(k + 1) % loop.size()];
    if ((a[1] <= p[1]) == (b[1] <= p[1])) continue;
    const Rational across = a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    if (across > p[0]) winding += a[1] < b[1] ? 1 : -1;
  }
  return winding;
}

/// What is wrong with a loop of a result; or nothing.
std::string flaw_of_loop(const Image_loop& loop, int sense) {
  if (loop.size() < 3) return "has a loop of " + std::to_string(loop.size()) + " corners";
  if (sgn(twice_strips(loop)) != sense) return "has a loop that runs the wrong way round";
  if (std::set<Image_point>(loop.begin(), loop.end()).size() != loop.size())
    return "has a loop that passes a point twice";
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Image_point &p = loop[k], &q = loop[(k + 1) % loop.size()], &r = loop[(k + 2) % loop.size()];
    if ((q[0] - p[0]) * (r[1] - q[1]) == (q[1] - p[1]) * (r[0] - q[0])) return "has a straight corner";
  }
  return {};
}

Rational twice_area_of(const Polygons& polygons) {
  Rational sum = 0;
  for (const Image_polygon& polygon : polygons) {
    sum += twice_strips(polygon.outer);
    for (const Image_loop& hole : polygon.holes) sum += twice_strips(hole);
  }
  return sum;
}

std::string point_name(const Image_point& p) {
  return "(" + sightline::to_string(p[0]) + ", " + sightline::to_string(p[1]) + ")";
}

/// What is wrong with a result that is to hold the cells of a winding number 1 in the polygons and of `in_window` in
/// the window; or nothing.
std::string flaw_of_result(const Polygons& result, const std::vector<Slab_cell>& cells, int in_window) {
  Rational all = 0;
  for (const Slab_cell& cell : cells)
    if (cell.winding == std::array<int, 2>{1, in_window}) all += cell.area;
  for (const Image_polygon& polygon : result) {
    if (const std::string flaw = flaw_of_loop(polygon.outer, 1); !flaw.empty()) return flaw;
    for (const Image_loop& hole : polygon.holes)
      if (const std::string flaw = flaw_of_loop(hole, -1); !flaw.empty()) return flaw;
    if (2 * area(polygon) != twice_area_of({polygon})) return "has another area than area() says";
  }
  if (twice_area_of(result) != 2 * all)
    return "has an area of " + sightline::to_string(Rational(twice_area_of(result) / 2)) + " instead of " +
           sightline::to_string(all);
  for (const Slab_cell& cell : cells) {
    int holds = 0;
    for (const Image_polygon& polygon : result) {
      int winding = winding_around(polygon.outer, cell.inside);
      for (const Image_loop& hole : polygon.holes) winding += winding_around(hole, cell.inside);
      if (winding != 0 && winding != 1)
        return "has a polygon with a hole beside it, " + std::to_string(winding) + " times around " +
               point_name(cell.inside);
      holds += winding;
    }
    if (holds != (cell.winding == std::array<int, 2>{1, in_window}))
      return "holds " + point_name(cell.inside) + " " + std::to_string(holds) + " times";
  }
  return {};
}

// ---- What is clipped

Image_point grid_point(std::int64_t x, std::int64_t y) {
  return {Rational(static_cast<long>(x)), Rational(static_cast<long>(y))};
}

/// From left to right along the lower heights, and back along the upper ones.
Image_loop between(const std::vector<std::int64_t>& low, const std::vector<std::int64_t>& high) {
  Image_loop loop;
  const auto columns = static_cast<std::int64_t>(low.size());
  for (std::int64_t x = 0; x < columns; ++x) loop.push_back(grid_point(x, low[static_cast<std::size_t>(x)]));
  for (std::int64_t x = columns; x-- > 0;) loop.push_back(grid_point(x, high[static_cast<std::size_t>(x)]));
  return loop;
}

/// A polygon, its holes and what is in them, between chains of heights that never fall below one another: they touch
/// and run together, in corners, edges and spikes.
Polygons any_layers(Random& random) {
  const std::size_t columns = 2 + random.below(4), chains = 2 * (1 + random.below(3));
  std::vector<std::vector<std::int64_t>> heights(chains, std::vector<std::int64_t>(columns));
  for (std::size_t x = 0; x < columns; ++x) {
    std::vector<std::int64_t> column(chains);
    for (std::int64_t& height : column) height = random.between(0, 4);
    std::sort(column.begin(), column.end());
    for (std::size_t k = 0; k < chains; ++k) heights[k][x] = column[k];
  }
  Polygons polygons{{between(heights.front(), heights.back()), {}}};
  if (chains == 4) polygons[0].holes.push_back(between(heights[1], heights[2]));
  if (chains == 6 && random.chance(1, 2)) {  // one over the other
    polygons[0].holes.push_back(between(heights[1], heights[2]));
    polygons[0].holes.push_back(between(heights[3], heights[4]));
  } else if (chains == 6) {  // one in the other
    polygons[0].holes.push_back(between(heights[1], heights[4]));
    polygons.push_back({between(heights[2], heights[3]), {}});
  }
  return polygons;
}

Image_loop rectangle_of(std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height) {
  return {grid_point(x, y), grid_point(x + width, y), grid_point(x + width, y + height), grid_point(x, y + height)};
}

/// Squares of a board, or a board without them: neighbours share edges, or touch in corners, and so does the rim.
Polygons any_board(Random& random) {
  const std::int64_t width = random.between(1, 4), height = random.between(1, 4);
  Polygons polygons;
  if (random.chance(1, 2)) polygons.push_back({rectangle_of(0, 0, width, height), {}});
  const bool are_holes = !polygons.empty();
  for (std::int64_t x = 0; x < width; ++x)
    for (std::int64_t y = 0; y < height; ++y) {
      if (random.chance(1, 2)) continue;
      Image_loop cell = rectangle_of(x, y, 1, 1);
      if (are_holes) polygons[0].holes.push_back(std::move(cell));
      else polygons.push_back({std::move(cell), {}});
    }
  return polygons;
}

/// Rectangles in one another, each of them a hole of the one around it, or what is in one.
Polygons any_rings(Random& random) {
  std::array<std::int64_t, 2> least{0, 0}, most{random.between(7, 9), random.between(7, 9)};
  Polygons polygons;
  for (std::size_t level = 0; level < 5 && least[0] < most[0] && least[1] < most[1]; ++level) {
    Image_loop loop = rectangle_of(least[0], least[1], most[0] - least[0], most[1] - least[1]);
    if (level % 2 == 0) polygons.push_back({std::move(loop), {}});
    else polygons.back().holes.push_back(std::move(loop));
    const bool touches = random.chance(1, 3);
    for (std::size_t k = 0; k < 2; ++k) {
      least[k] += touches ? random.between(0, 1) : 1;
      most[k] -= touches ? random.between(0, 1) : 1;
    }
  }
  return polygons;
}

/// Triangles around a point; of some a smaller one is missing, at the point or in the middle.
Polygons any_fan(Random& random) {
  static constexpr std::array<std::array<std::int64_t, 2>, 12> round{
      {{2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {-1, 2}, {-2, 2}, {-2, 0}, {-2, -2}, {0, -2}, {1, -2}, {2, -2}}};
  Polygons polygons;
  for (std::size_t k = 0; k < round.size(); ++k) {
    if (random.chance(1, 2)) continue;
    const std::array<std::int64_t, 2>&a = round[k], &b = round[(k + 1) % round.size()];
    Image_polygon& wedge = polygons.emplace_back();
    wedge.outer = {grid_point(2, 2), grid_point(2 + a[0], 2 + a[1]), grid_point(2 + b[0], 2 + b[1])};
    if (random.chance(1, 2)) continue;
    Image_loop& hole = wedge.holes.emplace_back(wedge.outer);
    const std::size_t towards = random.below(3);
    for (Image_point& p : hole)
      for (std::size_t i = 0; i < 2; ++i) p[i] = (p[i] + wedge.outer[towards][i]) / 2;
  }
  return polygons;
}

/// A face as it lies, without one axis. Whether it may be clipped is for the cells to say.
Polygons flat_face(const Polygon_soup& soup, Random& random) {
  if (soup.face_count() == 0) return any_fan(random);
  const Face_id face = static_cast<Face_id>(random.below(soup.face_count()));
  const std::size_t axis = random.below(3);
  Image_polygon polygon;
  for (std::size_t k = 0; k < soup.loop_count(face); ++k) {
    Image_loop loop;
    for (const Point_id id : soup.loop(face, k)) {
      const Exact_point p = soup.point(id);
      loop.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3]});
    }
    if (k == 0) polygon.outer = std::move(loop);
    else polygon.holes.push_back(std::move(loop));
  }
  return {polygon};
}

Polygons any_polygons(const Polygon_soup& soup, Random& random) {
  switch (random.below(9)) {
    case 0: return flat_face(soup, random);
    case 1:
    case 2: return any_board(random);
    case 3: return any_fan(random);
    case 4:
    case 5: return any_rings(random);
    default: return any_layers(random);
  }
}

template <class Function>
void for_each_loop(Polygons& polygons, Function f) {
  for (Image_polygon& polygon : polygons) {
    f(polygon.outer);
    for (Image_loop& hole : polygon.holes) f(hole);
  }
}

/// Moves all by an affine map; half of the time only to lattice points.
void move(Polygons& polygons, Random& random) {
  std::array<std::array<Rational, 3>, 2> map{{{1, 0, 0}, {0, 1, 0}}};
  const Rational unit = random.chance(1, 2) ? Rational(1) : Rational(1, static_cast<long>(1 + random.below(3)));
  for (auto& row : map) row[2] = unit * static_cast<long>(random.between(-2, 2));
  if (random.chance(1, 2)) map[0][1] = unit * static_cast<long>(random.between(-2, 2));
  if (random.chance(1, 4)) map[0][0] = map[1][1] = -unit;
  if (random.chance(1, 4)) std::swap(map[0], map[1]);
  for_each_loop(polygons, [&](Image_loop& loop) {
    for (Image_point& p : loop)
      p = {Rational(map[0][0] * p[0] + map[0][1] * p[1] + map[0][2]),
           Rational(map[1][0] * p[0] + map[1][1] * p[1] + map[1][2])};
  });
}

/// What must change nothing: loops that begin elsewhere or run the other way, corners that are repeated or straight,
/// spikes; polygons in another order.
void dress(Polygons& polygons, Random& random) {
  for_each_loop(polygons, [&](Image_loop& loop) {
    if (loop.empty()) return;
    if (random.chance(1, 3)) std::reverse(loop.begin(), loop.end());
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(random.below(loop.size())), loop.end());
    if (random.chance(1, 2)) return;
    const Image_point last = loop.back(), first = loop.front();
    switch (random.below(3)) {
      case 0: loop.push_back(last); break;
      case 1: loop.push_back({Rational((last[0] + first[0]) / 2), Rational((last[1] + first[1]) / 2)}); break;
      default: {
        const std::int64_t up = random.between(0, 4);
        const Image_point tip = grid_point(random.between(0, 4), up);
        loop.insert(loop.end(), {tip, last});
      }
    }
  });
  random.shuffle(polygons);
}

Outcome check_windows(const Posed_scene& posed, Random& random) {
  Polygons polygons = any_polygons(posed.soup, random);
  Polygons window = random.chance(1, 3) ? polygons : any_polygons(posed.soup, random);
  if (random.chance(1, 2)) move(window, random);
  if (random.chance(1, 12)) {  // which is hardly ever without an overlap
    const Polygons more = any_polygons(posed.soup, random);
    window.insert(window.end(), more.begin(), more.end());
  }
  if (random.chance(1, 12) && !window.empty()) {  // nor is a hole where it ought to be
    const Polygons more = any_polygons(posed.soup, random);
    if (!more.empty()) window[0].holes.push_back(more[0].outer);
  }
  // Everything, as often as not in smaller or larger numbers.
  if (random.chance(1, 2)) {
    const Rational scale = random.chance(1, 2) ? Rational(1, 3) : Rational(0x1p60);
    for (Polygons* all : {&polygons, &window})
      for_each_loop(*all, [&](Image_loop& loop) {
        for (Image_point& p : loop) p = {Rational(p[0] * scale), Rational(p[1] * scale)};
      });
  }
  dress(polygons, random);
  dress(window, random);
  return checked_clip(polygons, window);
}

}  // namespace window_laws

Outcome checked_clip(std::span<const Image_polygon> polygons, std::span<const Image_polygon> window) {
  using namespace window_laws;
  std::vector<Slope> slopes;
  add_slopes(polygons, 0, slopes);
  add_slopes(window, 1, slopes);
  const std::vector<Slab_cell> cells = slab_cells(slopes);
  const bool overlap = std::any_of(cells.begin(), cells.end(), [](const Slab_cell& cell) {
    return std::min(cell.winding[0], cell.winding[1]) < 0 || std::max(cell.winding[0], cell.winding[1]) > 1;
  });
  Clipped_polygons made, exchanged;
  try {
    made = clip_to_window(polygons, window);
    if (overlap) return Outcome::failed("polygons that overlap are clipped");
    exchanged = clip_to_window(window, polygons);
  } catch (const std::invalid_argument& refused) {
    return overlap ? Outcome() : Outcome::failed(std::string("refused: ") + refused.what());
  }
  if (const std::string flaw = flaw_of_result(made.inside, cells, 1); !flaw.empty())
    return Outcome::failed("what is inside the window " + flaw);
  if (const std::string flaw = flaw_of_result(made.outside, cells, 0); !flaw.empty())
    return Outcome::failed("what is outside the window " + flaw);
  if (twice_area_of(exchanged.inside) != twice_area_of(made.inside))
    return Outcome::failed("polygons and window exchanged have another inside");
  return {};
}

Check windows_check() {
  return {"windows", "polygons clipped to concave windows with holes, by cells of the plane",
          [](const Posed_scene& posed, const Answer&, Random& random) {
            return window_laws::check_windows(posed, random);
          }};
}

}  // namespace sightline::harness
