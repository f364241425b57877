#include <sightline/algorithms/verify/level_fill.h>

#include <sightline/algorithms/verify/cell_walls.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <string>

namespace sightline::level_check {

using namespace certificate_check;

namespace {

constexpr std::size_t the_end = ~std::size_t{0};  // of the box, in the place of a cell

std::string cell_name(const Cell_of_level& cell) { return "cell " + std::to_string(cell.cell); }

/// A loop as it begins with its least corner.
Polygon begun_at_least(Polygon loop) {
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

/// The box about corners that are added.
struct Corner_box {
  Exact_point low, high;
  bool is_empty = true;

  void add(const Exact_point& p) {
    if (is_empty) low = high = p;
    is_empty = false;
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  bool holds(const Exact_point& p) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] < low[k] || p[k] > high[k]) return false;
    return true;
  }
  /// Whether a polygon lies in one of its sides.
  bool has_in_side(const Polygon& polygon) const {
    for (std::size_t k = 0; k < 3; ++k)
      for (const Exact_point* end : {&low, &high})
        if (std::all_of(polygon.begin(), polygon.end(), [&](const Exact_point& p) { return p[k] == (*end)[k]; }))
          return true;
    return false;
  }
  Rational volume() const { return Rational((high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2])); }
};

/// Six times the volume of the cone from the origin to a polygon, positive where its front looks away.
Rational six_of_cone(const Polygon& polygon) {
  Rational sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Exact_point normal = cross(polygon[i], polygon[i + 1]);
    for (std::size_t k = 0; k < 3; ++k) sum += polygon[0][k] * normal[k];
  }
  return sum;
}

/// The sum of what is in [begin, end), by halves: numbers with denominators of their own get long only at last.
Rational sum_of(const std::vector<Rational>& values, std::size_t begin, std::size_t end) {
  if (end - begin == 0) return 0;
  if (end - begin == 1) return values[begin];
  const std::size_t middle = begin + (end - begin) / 2;
  return sum_of(values, begin, middle) + sum_of(values, middle, end);
}

/// (2) For each wall of each cell the place of the cell beyond it, or the_end.
std::vector<std::vector<std::size_t>> neighbours_of(const std::vector<Cell_of_level>& cells, const Corner_box& box,
                                                    const std::function<void()>& ask) {
  struct Owner {
    std::size_t cell, wall;
  };
  std::map<Polygon, Owner> owners;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    ask();
    for (std::size_t w = 0; w < cells[c].walls.size(); ++w) {
      const auto [at, is_new] = owners.try_emplace(begun_at_least(cells[c].walls[w]), Owner{c, w});
      if (!is_new)
        reject(cell_name(cells[c]) + " has " + name("wall", w) + " that " + cell_name(cells[at->second.cell]) +
               " has too, the same way round");
    }
  }
  std::vector<std::vector<std::size_t>> neighbours;
  for (const Cell_of_level& cell : cells) {
    ask();
    std::vector<std::size_t>& beyond = neighbours.emplace_back();
    for (std::size_t w = 0; w < cell.walls.size(); ++w) {
      Polygon turned = cell.walls[w];
      std::reverse(turned.begin(), turned.end());
      const auto at = owners.find(begun_at_least(std::move(turned)));
      if (at == owners.end() && !box.has_in_side(cell.walls[w]))
        reject(cell_name(cell) + " has " + name("wall", w) + " with no cell beyond it, at " +
               exact_name(cell.walls[w][0]));
      beyond.push_back(at == owners.end() ? the_end : at->second.cell);
    }
  }
  return neighbours;
}

std::string check_fill(const Polygon_soup& soup, const std::vector<Cell_of_level>& cells,
                       const Verify_options& options) {
  const auto ask = [&] {
    if (options.progress) options.progress(0, cells.size());
  };
  // 1. Cells are polyhedra.
  std::vector<std::vector<Outline>> outlines;
  for (const Cell_of_level& cell : cells) try {
      ask();
      outlines.push_back(outlines_of_walls(cell.walls));
    } catch (const Rejection& rejection) {
      reject(cell_name(cell) + ": " + rejection.verdict.why);
    }

  // 2. to 4. They fill the box, which holds the scene.
  Corner_box box;
  for (const Cell_of_level& cell : cells) {
    ask();
    for (const Polygon& wall : cell.walls)
      for (const Exact_point& p : wall) box.add(p);
  }
  const std::vector<std::vector<std::size_t>> neighbours = neighbours_of(cells, box, ask);
  std::vector<Rational> cones;  // of walls that are not of two cells, which see one from both sides
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t w = 0; w < cells[c].walls.size(); ++w)
      if (neighbours[c][w] == the_end) cones.push_back(six_of_cone(cells[c].walls[w]));
  if (box.is_empty || sum_of(cones, 0, cones.size()) != 6 * box.volume())
    reject("the volumes of cells do not sum to that of the box about them");
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t l = 0; l < soup.loop_count(f); ++l)
      for (const Point_id p : soup.loop(f, l))
        if (!box.holds(soup.point(p))) reject(name("face", f) + " has a corner that no cell is about");

  // 5. Who walks through sources, and where no face is in the way, stays in cells that have certificates.
  std::size_t certified = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    ask();
    certified += cells[c].has_certificate;
    for (const std::size_t w : cells[c].open_walls) {
      if (w >= outlines[c].size()) reject(cell_name(cells[c]) + " has no " + name("wall", w));
      const std::size_t other = neighbours[c][w];
      if (other == the_end || cells[other].has_certificate) continue;
      reject(cell_name(cells[c]) + ": some of " + name("wall", w) +
             " is covered by no source and no face, and beyond is " + cell_name(cells[other]) +
             ", which has no certificate");
    }
    for (std::size_t s = 0; s < cells[c].sources.size(); ++s) {
      const Outline source(cells[c].sources[s]);
      for (std::size_t w = 0; w < outlines[c].size(); ++w) {
        const std::size_t other = neighbours[c][w];
        if (other == the_end || cells[other].has_certificate || !is_within(source, outlines[c][w])) continue;
        reject(cell_name(cells[c]) + ": through " + name("source", s) + " there is a way to " +
               cell_name(cells[other]) + ", which has no certificate");
      }
    }
  }
  return std::to_string(cells.size()) + " cells fill a box about the scene, " + std::to_string(certified) +
         " of them have certificates";
}

}  // namespace
}  // namespace sightline::level_check

namespace sightline {

Verdict verify_level_fill(const Polygon_soup& soup, const std::vector<Cell_of_level>& cells,
                          const Verify_options& options) {
  return certificate_check::verdict_of([&] { return level_check::check_fill(soup, cells, options); });
}

}  // namespace sightline
