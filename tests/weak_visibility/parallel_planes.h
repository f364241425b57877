#pragma once
// Weak visibility with a known answer: source in z = 0, target in z = 1, convex occluders between in planes z =
// constant. A line is the pair (a, b) of its points at z = 0 and z = 1; at height z it is at (1 - z) a + z b. So the
// lines that an occluder blocks are a convex polytope in R^4, and the target is visible iff such polytopes do not cover
// the polytope of all lines from source to target up to measure zero. `project` (scene.h) makes edges skew and planes
// cross, and keeps the truth.

#include "rays.h"

namespace weak_oracle {

using weak_scenes::at;
using weak_scenes::Faces;
using weak_scenes::ratio;

// ---- Linear programs

struct Optimum {
  Rational value;
  std::vector<Rational> x;
};

/// The largest objective . x subject to rows x <= bounds and x >= 0, by the simplex method with Bland's rule, which
/// ends. Pre: bounds >= 0; the optimum is finite, or std::domain_error. Exact: yes
inline Optimum maximise(std::vector<std::vector<Rational>> rows, std::vector<Rational> bounds,
                        std::vector<Rational> objective) {
  const std::size_t m = rows.size(), n = objective.size();
  // Variables 0 .. n - 1 are x, n .. n + m - 1 the slacks. The dictionary: basic[i] = bounds[i] - sum rows[i][j]
  // free[j], value + sum objective[j] free[j].
  std::vector<std::size_t> basic(m), free(n);
  for (std::size_t i = 0; i < m; ++i) basic[i] = n + i;
  for (std::size_t j = 0; j < n; ++j) free[j] = j;
  Rational value = 0;
  while (true) {
    std::size_t in = n, out = m;
    for (std::size_t j = 0; j < n; ++j)
      if (sgn(objective[j]) > 0 && (in == n || free[j] < free[in])) in = j;
    if (in == n) break;
    Rational least;
    for (std::size_t i = 0; i < m; ++i) {
      if (sgn(rows[i][in]) <= 0) continue;
      const Rational limit = Rational(bounds[i] / rows[i][in]);
      if (out == m || limit < least || (limit == least && basic[i] < basic[out])) {
        out = i;
        least = limit;
      }
    }
    if (out == m) throw std::domain_error("the linear program has no finite optimum");
    // free[in] and basic[out] change places.
    const Rational pivot = rows[out][in];
    for (Rational& x : rows[out]) x /= pivot;
    rows[out][in] = 1 / pivot;
    bounds[out] /= pivot;
    const auto eliminate = [&](std::vector<Rational>& row, Rational& constant, int sign) {
      const Rational factor = row[in];
      if (sgn(factor) == 0) return;
      for (std::size_t j = 0; j < n; ++j)
        if (j != in) row[j] -= factor * rows[out][j];
      row[in] = -factor * rows[out][in];
      constant += sign * factor * bounds[out];
    };
    for (std::size_t i = 0; i < m; ++i)
      if (i != out) eliminate(rows[i], bounds[i], -1);
    eliminate(objective, value, 1);
    std::swap(basic[out], free[in]);
  }
  Optimum optimum{value, std::vector<Rational>(n)};
  for (std::size_t i = 0; i < m; ++i)
    if (basic[i] < n) optimum.x[basic[i]] = bounds[i];
  return optimum;
}

// ---- Lines as points of R^4

using Line_point = std::array<Rational, 4>;  ///< (a, b)

/// Open: normal . x > offset.
struct Wall {
  Line_point normal;
  Rational offset;
  Rational height(const Line_point& x) const {
    return Rational(normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2] + normal[3] * x[3] - offset);
  }
};
using Cell = std::vector<Wall>;
inline Wall opposite(const Wall& wall) {
  Wall other{wall.normal, Rational(-wall.offset)};
  for (Rational& x : other.normal) x = -x;
  return other;
}

/// direction . (the line's point at height z), as a form on lines.
inline Line_point at_height(const Rational& z, const Rational& x, const Rational& y) {
  return {Rational((1 - z) * x), Rational((1 - z) * y), Rational(z * x), Rational(z * y)};
}

/// The lines that pass through the interior of a convex polygon in a plane z = constant. Pre: counterclockwise seen
/// from above.
inline Cell lines_through(const Points& polygon) {
  Cell cell;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Exact_point &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const Rational x = Rational(p[1] - q[1]), y = Rational(q[0] - p[0]);
    cell.push_back({at_height(p[2], x, y), Rational(x * p[0] + y * p[1])});
  }
  return cell;
}

/// A point strictly inside all walls, if there is one. Pre: the cell is bounded. Exact: yes
inline std::optional<Line_point> inner_point(const Cell& cell) {
  // x = x+ - x-, and a slack t - lift of all walls, as large as it can be up to 1; with lift, x = 0 and t = 0 satisfy
  // all.
  Rational lift = 0;
  for (const Wall& wall : cell) lift = std::max(lift, wall.offset);
  std::vector<std::vector<Rational>> rows;
  std::vector<Rational> bounds;
  for (const Wall& wall : cell) {
    std::vector<Rational> row(9, 1);
    for (std::size_t i = 0; i < 4; ++i) {
      row[i] = -wall.normal[i];
      row[4 + i] = wall.normal[i];
    }
    rows.push_back(row);
    bounds.push_back(Rational(lift - wall.offset));
  }
  std::vector<Rational> slack(9, 0);
  slack[8] = 1;
  rows.push_back(slack);
  bounds.push_back(Rational(lift + 1));
  const Optimum best = maximise(rows, bounds, slack);
  if (best.value <= lift) return std::nullopt;
  Line_point point;
  for (std::size_t i = 0; i < 4; ++i) point[i] = best.x[i] - best.x[4 + i];
  return point;
}

/// The supremum of form . x on a cell that has this inner point. Pre: the cell is bounded. Exact: yes
inline Rational supremum(const Cell& cell, const Line_point& inside, const Line_point& form) {
  std::vector<std::vector<Rational>> rows;
  std::vector<Rational> bounds, objective(8);
  for (const Wall& wall : cell) {
    std::vector<Rational> row(8);
    for (std::size_t i = 0; i < 4; ++i) {
      row[i] = -wall.normal[i];
      row[4 + i] = wall.normal[i];
    }
    rows.push_back(row);
    bounds.push_back(wall.height(inside));
  }
  for (std::size_t i = 0; i < 4; ++i) {
    objective[i] = form[i];
    objective[4 + i] = -form[i];
  }
  return Rational(maximise(rows, bounds, objective).value + Wall{form, 0}.height(inside));
}

// ---- Scenes

/// All polygons convex and counterclockwise seen from above: the source in z = 0, the target in z = 1, the occluders
/// strictly between.
struct Parallel_scene {
  Points source, target;
  Faces occluders;
};

struct Free_cell {
  Cell cell;
  Line_point inside;
};

/// Appends cells with disjoint interiors, which together are the given one without the shadows from number `next` on,
/// up to measure zero; stops at `most`. Cost: exponential in the shadows. Exact: yes
inline void subtract(const std::vector<Cell>& shadows, std::size_t next, const Free_cell& from, std::size_t most,
                     std::vector<Free_cell>& free) {
  if (free.size() >= most) return;
  if (next == shadows.size()) {
    free.push_back(from);
    return;
  }
  Cell within = from.cell;
  within.insert(within.end(), shadows[next].begin(), shadows[next].end());
  if (!inner_point(within)) return subtract(shadows, next + 1, from, most, free);
  // Facet by facet: beyond this one, and within those before.
  Cell cell = from.cell;
  for (const Wall& wall : shadows[next]) {
    cell.push_back(opposite(wall));
    const std::optional<Line_point> inside =
        sgn(wall.height(from.inside)) < 0 &&
                std::all_of(cell.begin(), cell.end(), [&](const Wall& w) { return sgn(w.height(from.inside)) > 0; })
            ? from.inside
            : inner_point(cell);
    if (inside) subtract(shadows, next + 1, {cell, *inside}, most, free);
    cell.back() = wall;
  }
}
inline std::vector<Free_cell> free_cells(const Parallel_scene& scene, std::size_t most) {
  std::vector<Cell> shadows;
  for (const Points& occluder : scene.occluders) shadows.push_back(lines_through(occluder));
  Cell all = lines_through(scene.source);
  const Cell to = lines_through(scene.target);
  all.insert(all.end(), to.begin(), to.end());
  std::vector<Free_cell> free;
  const Exact_point a = oracle::centroid(scene.source), b = oracle::centroid(scene.target);
  subtract(shadows, 0, {all, {a[0], a[1], b[0], b[1]}}, most, free);
  return free;
}

/// A sightline if the target is visible; none if it is hidden. Exact: yes
inline std::optional<Sightline> decide(const Parallel_scene& scene) {
  const std::vector<Free_cell> free = free_cells(scene, 1);
  if (free.empty()) return std::nullopt;
  const Line_point& x = free[0].inside;
  return Sightline{at(x[0], x[1], 0), at(x[2], x[3], 1)};
}

/// The target looks down, and is face 0; occluders look up.
inline Weak_scene in_space(const Parallel_scene& scene, const std::string& name, std::optional<bool> truth) {
  Faces faces{weak_scenes::reversed(scene.target)};
  faces.insert(faces.end(), scene.occluders.begin(), scene.occluders.end());
  return {name, weak_scenes::soup_of(faces), scene.source, {0}, truth};
}

// ---- From a seed

/// A triangle or parallelogram in the plane z, corners multiples of 1/2 about a centre in [-reach, reach]^2.
inline Points random_convex(Random& random, const Rational& z, std::int64_t reach, std::int64_t size) {
  while (true) {
    const Exact_point middle{ratio(random.between(-2 * reach, 2 * reach), 2),
                             ratio(random.between(-2 * reach, 2 * reach), 2), z};
    const auto vector = [&] {
      return Exact_point{ratio(random.between(-size, size), 2), ratio(random.between(-size, size), 2), 0};
    };
    const Exact_point u = vector(), v = vector();
    const Rational area = cross(u, v)[2];
    if (sgn(area) == 0) continue;
    Points points{along(along(middle, -1, u), -1, v), along(along(middle, 1, u), -1, v),
                  along(along(middle, 1, u), 1, v), along(along(middle, -1, u), 1, v)};
    if (random.chance(1, 2)) points.erase(points.begin() + static_cast<std::ptrdiff_t>(random.below(4)));
    return sgn(area) > 0 ? points : weak_scenes::reversed(points);
  }
}
inline Parallel_scene random_parallel(Random& random, std::size_t occluders) {
  Parallel_scene scene{random_convex(random, 0, 1, 3), random_convex(random, 1, 1, 3), {}};
  for (; occluders > 0; --occluders) {
    const Rational z = ratio(random.between(1, 5), 6);
    scene.occluders.push_back(random_convex(random, z, 2, 6));
  }
  return scene;
}

/// The parallelogram in the plane z that just holds where all lines of the cells pass: between two lines along (x, y),
/// and two across. `bounds` are those of
/// +(-y, x), -(-y, x), +(x, y), -(x, y).
struct Shutter {
  Rational z, x, y;
  std::array<Rational, 4> bounds;
  Points polygon() const {
    // The point with n . p = s, m . p = t for n = (-y, x), m = (x, y).
    const Rational size = Rational(x * x + y * y);
    const auto corner = [&](const Rational& s, const Rational& t) {
      return at(Rational((t * x - s * y) / size), Rational((s * x + t * y) / size), z);
    };
    const Rational low_s = Rational(-bounds[1]), low_t = Rational(-bounds[3]);
    // n is m turned left: with m to the right, n points up.
    return {corner(low_s, low_t), corner(low_s, bounds[2]), corner(bounds[0], bounds[2]), corner(bounds[0], low_t)};
  }
};
inline Shutter shutter(const std::vector<Free_cell>& free, Random& random) {
  Shutter result{ratio(random.between(1, 7), 8), 0, 0, {}};
  while (sgn(result.x) == 0 && sgn(result.y) == 0) {
    result.x = static_cast<long>(random.between(-2, 2));
    result.y = static_cast<long>(random.between(-2, 2));
  }
  const std::array<Line_point, 4> forms{
      at_height(result.z, Rational(-result.y), result.x), at_height(result.z, result.y, Rational(-result.x)),
      at_height(result.z, result.x, result.y), at_height(result.z, Rational(-result.x), Rational(-result.y))};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < free.size(); ++i) {
      const Rational bound = supremum(free[i].cell, free[i].inside, forms[k]);
      if (i == 0 || bound > result.bounds[k]) result.bounds[k] = bound;
    }
  return result;
}

/// One scene closed by a shutter that only just holds all lines that were free, in two parts that only touch, so
/// hidden; and the same with a side of the shutter moved in by 2^-40, so visible: free lines come as near to that side
/// as one likes. Those extreme lines touch other occluders, up to four edges in all.
struct Closed_and_reopened {
  Parallel_scene closed, reopened;
};
inline Closed_and_reopened closed_and_reopened(std::uint64_t seed) {
  Random random(seed);
  constexpr std::size_t too_many = 24;
  while (true) {
    Parallel_scene open = random_parallel(random, random.below(4));
    std::vector<Free_cell> free = free_cells(open, too_many);
    // Perhaps a shutter first that leaves some.
    if (random.chance(1, 2) && !free.empty() && free.size() < too_many) {
      Shutter part = shutter(free, random);
      const std::size_t side = random.below(4);
      part.bounds[side] = (part.bounds[side] * 2 - part.bounds[side ^ 1]) / 3;  // two thirds of its width
      open.occluders.push_back(part.polygon());
      free = free_cells(open, too_many);
    }
    if (free.empty() || free.size() >= too_many) continue;
    const Shutter whole = shutter(free, random);
    Shutter smaller = whole;
    const std::size_t side = random.below(4);
    smaller.bounds[side] -= weak_scenes::tiny_gap();
    const Rational cut = weak_scenes::share(random);
    const auto closed_by = [&](const Shutter& last) {
      Parallel_scene scene = open;
      const Points p = last.polygon();
      const Exact_point from = along(p[0], cut, minus(p[1], p[0])), to = along(p[3], cut, minus(p[2], p[3]));
      scene.occluders.push_back({p[0], from, to, p[3]});
      scene.occluders.push_back({from, p[1], p[2], to});
      return scene;
    };
    return {closed_by(whole), closed_by(smaller)};
  }
}

/// In space, half of them under a random projective map: seeds 3 k, 3 k + 1, 3 k + 2 are a closed scene, the same
/// reopened, and one of random occluders.
inline Weak_scene parallel_planes_scene(std::uint64_t seed) {
  const std::string name = "parallel_planes " + std::to_string(seed);
  Random random(seed / 3);
  Weak_scene scene;
  if (seed % 3 < 2) {
    const Closed_and_reopened pair = closed_and_reopened(seed / 3);
    scene = seed % 3 == 0 ? in_space(pair.closed, name, false) : in_space(pair.reopened, name, true);
  } else {
    const Parallel_scene parallel = random_parallel(random, 3 + random.below(6));
    scene = in_space(parallel, name, decide(parallel).has_value());
  }
  return random.chance(1, 2) ? scene : project(scene, weak_scenes::random_projection(scene, random));
}

}  // namespace weak_oracle
