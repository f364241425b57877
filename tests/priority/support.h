#pragma once
// Priority relations by brute force: the Lemma in plain rational arithmetic, closures by Floyd and Warshall, and scenes
// where everything touches.

#include "../bsp/support.h"

#include <sightline/algorithms/priority/explicit_graph.h>
#include <sightline/algorithms/priority/relation.h>
#include <sightline/harness/generate/shapes.h>

namespace priority_test {

using namespace bsp_test;

// ---- The Lemma

/// A convex polygon by its corners only. `height` is positive in front.
struct Flat {
  Points corners;
  Exact_point normal{0, 0, 0};  ///< twice the area vector (Newell)
  Rational offset;              ///< of a point of the plane along the normal

  explicit Flat(Points points) : corners(std::move(points)) {
    for (std::size_t k = 0; k < corners.size(); ++k)
      normal = along(normal, 1, cross(corners[k], corners[(k + 1) % corners.size()]));
    offset = dot(normal, corners[0]);
  }
  Rational height(const Exact_point& p) const { return dot(normal, p) - offset; }

  /// Where the line from p through q meets the plane, as p + t (q - p); none if it is parallel.
  std::optional<Rational> crossing(const Exact_point& p, const Exact_point& q) const {
    const Rational from = height(p), to = height(q);
    if (from == to) return std::nullopt;
    return Rational(from / (from - to));
  }
  /// Whether a point of the plane is in the polygon: strictly inside (1), on its boundary (0), outside (-1). Projects
  /// along the longest axis of the normal.
  int holds(const Exact_point& p) const {
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (abs(normal[k]) > abs(normal[axis])) axis = k;
    const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
    int least = 1;
    for (std::size_t k = 0; k < corners.size() && least >= 0; ++k) {
      const Exact_point &a = corners[k], &b = corners[(k + 1) % corners.size()];
      const Rational turn = (b[i] - a[i]) * (p[j] - a[j]) - (b[j] - a[j]) * (p[i] - a[i]);
      least = std::min(least, sgn(turn) * sgn(normal[axis]));
    }
    return least;
  }
};

using Flats = std::vector<Flat>;

/// sides[i][j][k]: the side of polygon j's plane that corner k of polygon i is on, -1, 0 or 1.
using Sides = std::vector<std::vector<std::vector<int>>>;

inline Sides sides_of(const Flats& flats) {
  Sides sides(flats.size(), std::vector<std::vector<int>>(flats.size()));
  for (std::size_t j = 0; j < flats.size(); ++j) {
    const Rational offset = dot(flats[j].normal, flats[j].corners[0]);
    for (std::size_t i = 0; i < flats.size(); ++i)
      for (const Exact_point& p : flats[i].corners)
        sides[i][j].push_back(sgn(Rational(dot(flats[j].normal, p) - offset)));
  }
  return sides;
}

using Matrix = std::vector<std::vector<char>>;

/// The Lemma, word for word: a < b where a meets the open half-space in front of b's plane, and b the one behind a's.
/// Corners decide.
inline Matrix arcs_of(const Sides& sides) {
  const std::size_t n = sides.size();
  const auto has = [&](std::size_t i, std::size_t j, int side) {
    return std::count(sides[i][j].begin(), sides[i][j].end(), side) > 0;
  };
  Matrix arcs(n, std::vector<char>(n, 0));
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) arcs[a][b] = has(a, b, 1) && has(b, a, -1);
  return arcs;
}
inline Matrix arcs_of(const Flats& flats) { return arcs_of(sides_of(flats)); }

/// The arcs that a library's relation has, one question at a time.
template <class Relation>
Matrix asked(const Relation& relation) {
  Relation_counters counters;
  Matrix arcs(relation.size(), std::vector<char>(relation.size(), 0));
  for (std::uint32_t i = 0; i < relation.size(); ++i)
    for (std::uint32_t j = 0; j < relation.size(); ++j) arcs[i][j] = relation.may_obscure(i, j, counters);
  return arcs;
}

inline std::size_t count_arcs(const Matrix& arcs) {
  std::size_t count = 0;
  for (const std::vector<char>& row : arcs) count += static_cast<std::size_t>(std::count(row.begin(), row.end(), 1));
  return count;
}

inline testing::AssertionResult same_arcs(const Matrix& found, const Matrix& expected) {
  if (found.size() != expected.size())
    return testing::AssertionFailure() << found.size() << " faces, not " << expected.size();
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t j = 0; j < found.size(); ++j)
      if (found[i][j] != expected[i][j])
        return testing::AssertionFailure() << (expected[i][j] ? "missing arc " : "extra arc ") << i << " < " << j;
  return testing::AssertionSuccess();
}

inline testing::AssertionResult part_of(const Matrix& fewer, const Matrix& more) {
  for (std::size_t i = 0; i < fewer.size(); ++i)
    for (std::size_t j = 0; j < fewer.size(); ++j)
      if (fewer[i][j] && !more[i][j]) return testing::AssertionFailure() << "only the smaller has " << i << " < " << j;
  return testing::AssertionSuccess();
}

// ---- Components

/// Reachability over one or more arcs (Floyd, Warshall).
inline Matrix closure(Matrix arcs) {
  for (std::size_t k = 0; k < arcs.size(); ++k)
    for (std::size_t i = 0; i < arcs.size(); ++i)
      if (arcs[i][k])
        for (std::size_t j = 0; j < arcs.size(); ++j) arcs[i][j] = static_cast<char>(arcs[i][j] | arcs[k][j]);
  return arcs;
}

using Sets = std::set<std::vector<std::uint32_t>>;

inline Sets components_by_closure(const Matrix& arcs) {
  const Matrix reach = closure(arcs);
  Sets sets;
  for (std::uint32_t i = 0; i < arcs.size(); ++i) {
    std::vector<std::uint32_t> members;
    for (std::uint32_t j = 0; j < arcs.size(); ++j)
      if (i == j || (reach[i][j] && reach[j][i])) members.push_back(j);
    sets.insert(members);
  }
  return sets;
}

/// Whether components are those of the arcs, members ascend, h names each member's component, and each arc goes to an
/// equal or a higher number.
template <class Components>
testing::AssertionResult right_components(const Components& found, const Matrix& arcs) {
  Sets sets;
  std::size_t members = 0, largest = 0, cyclic = 0;
  if (found.faces() != arcs.size()) return testing::AssertionFailure() << found.faces() << " faces";
  for (std::size_t c = 0; c < found.size(); ++c) {
    const std::vector<std::uint32_t> set(found[c].begin(), found[c].end());
    if (set.empty() || !std::is_sorted(set.begin(), set.end()))
      return testing::AssertionFailure() << "component " << c << " is empty or not ascending";
    for (const std::uint32_t face : set)
      if (found.h(face) != c)
        return testing::AssertionFailure() << "h(" << face << ") = " << found.h(face) << " in component " << c;
    members += set.size();
    largest = std::max(largest, set.size());
    cyclic += set.size() > 1;
    sets.insert(set);
  }
  if (members != arcs.size()) return testing::AssertionFailure() << members << " members";
  if (sets != components_by_closure(arcs))
    return testing::AssertionFailure() << "other components than the closure has";
  if (found.largest() != largest || found.cyclic() != cyclic)
    return testing::AssertionFailure() << "largest " << found.largest() << ", cyclic " << found.cyclic();
  for (std::uint32_t i = 0; i < arcs.size(); ++i)
    for (std::uint32_t j = 0; j < arcs.size(); ++j)
      if (arcs[i][j] && found.h(i) > found.h(j))
        return testing::AssertionFailure() << i << " < " << j << " goes from " << found.h(i) << " to " << found.h(j);
  return testing::AssertionSuccess();
}

// ---- A scene and its relation

struct Related {
  Polygon_soup soup;
  Scene scene;
  Exact_traits traits;
  Priority_relation<Exact_traits> relation;
  Flats flats;  ///< the scene's pieces, from positions only

  explicit Related(Polygon_soup given) : soup(std::move(given)), scene(soup), traits(scene), relation(traits) {
    for (const Piece& piece : scene.pieces()) flats.emplace_back(scene.corner_points(piece));
  }
  Related(const Related&) = delete;
};

// ---- Random scenes

/// generate::touching_faces as a soup.
inline Polygon_soup touching_soup(Random& random) { return soup_of(generate::touching_faces(random)); }

enum class Move { none, far, tiny, one_ulp, turned };

/// The same scene where floating point is worse.
inline Polygon_soup moved(const Polygon_soup& soup, Move move, std::uint64_t seed) {
  switch (move) {
    case Move::none: return soup;
    case Move::far: return generate::translated(soup, at(100000000, -100000000, 100000000));
    case Move::tiny: return generate::scaled(soup, exact_decimal(1, -50));
    case Move::one_ulp:
      return generate::one_ulp_perturbed(generate::translated(soup, at(ratio(1, 3), ratio(1, 7), ratio(-2, 3))), seed);
    case Move::turned:
      return generate::rotated(soup,
                               generate::rotation(1 + static_cast<long>(seed % 4), 1, -2, static_cast<long>(seed % 3)));
  }
  return soup;
}

/// Scene number k of the degenerate ones: three in four of touching faces, the others with concave and non-planar faces
/// too; half of them moved.
inline Polygon_soup degenerate_soup(std::uint64_t k) {
  Random random(k);
  static constexpr std::array moves{Move::none, Move::far,     Move::none, Move::tiny,
                                    Move::none, Move::one_ulp, Move::none, Move::turned};
  const Polygon_soup soup = k % 4 == 3 ? random_soup(random, 8) : touching_soup(random);
  return moved(soup, moves[k / 4 % moves.size()], k);
}

/// A point of a convex polygon: a corner, on an edge, or anywhere, with the small weights that meet degeneracies.
inline Exact_point point_of(const Points& points, Random& random) {
  Exact_point sum{0, 0, 0};
  long total = 0;
  const bool sparse = random.chance(1, 2);
  while (total == 0) {
    for (const Exact_point& p : points) {
      const long weight = sparse && random.chance(2, 3) ? 0 : static_cast<long>(random.between(0, 3));
      sum = along(sum, weight, p);
      total += weight;
    }
  }
  for (Rational& x : sum) x /= total;
  return sum;
}
/// A point strictly inside.
inline Exact_point inside_of(const Points& points, Random& random) {
  Exact_point sum{0, 0, 0};
  long total = 0;
  for (const Exact_point& p : points) {
    const long weight = static_cast<long>(random.between(1, 12));
    sum = along(sum, weight, p);
    total += weight;
  }
  for (Rational& x : sum) x /= total;
  return sum;
}

/// The wall over a segment; its front is to the right of who walks from (x, y) to (u, v).
inline Points wall(long x, long y, long u, long v) { return {at(x, y, 0), at(u, v, 0), at(u, v, 1), at(x, y, 1)}; }

}  // namespace priority_test
