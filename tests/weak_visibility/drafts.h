#pragma once
// What scenes are made of: families of small ones in the easiest position, degenerate on purpose, most with a truth known by construction. A gap of 0 lets faces just
// touch, a positive one leaves so much between them, a negative one makes them overlap.

#include "scene.h"

namespace weak_scenes {

// ---- Parts of them ---------------------------------------------------------------------------------------------------------

/// A scene in the making; its target is faces[0], unless there are others.
struct Draft {
  Faces faces;
  Points source;
  std::optional<bool> truth;
  std::vector<std::size_t> targets{0};
  bool bodies = false;  ///< whether the faces' fronts are to stay, and the source is one of them
};

/// The shaft [-1, 1]^2 x [0, height]: source at its bottom, target at its top, each looking at the other. Every line between them stays in it.
inline Draft shaft(const Rational& height) { return {{reversed(rectangle(-1, 1, -1, 1, height))}, rectangle(-1, 1, -1, 1, 0), std::nullopt}; }

inline const Rational& tiny_gap() {
  static const Rational gap(1, 1ul << 40);
  return gap;
}

/// A convex face drawn in towards its centroid (gap > 0) or blown up (gap < 0), in its plane.
inline Points shrunk(const Points& face, const Rational& gap) {
  const Exact_point middle = centroid(face);
  Points points;
  for (const Exact_point& p : face) points.push_back(along(p, gap, minus(middle, p)));
  return points;
}
inline void shrink_one(Faces& faces, std::size_t first, const Rational& gap, Random& random) {
  Points& face = faces[first + random.below(faces.size() - first)];
  face = shrunk(face, gap);
}

/// The parallelogram with the edge `on` - u .. `on` + u that extends from it by w, front up if w is left of u seen from above.
inline Points plate(const Exact_point& on, const Exact_point& u, const Exact_point& w) {
  const Exact_point a = along(on, -1, u), b = along(on, 1, u);
  return {a, b, along(b, 1, w), along(a, 1, w)};
}

inline Exact_point scaled(const Rational& factor, const Exact_point& v) { return along(at(0, 0, 0), factor, v); }
inline Exact_point level_direction(Random& random) {
  Exact_point u = at(0, 0, 0);
  while (oracle::is_zero(u)) u = {integer(random, -2, 2), integer(random, -2, 2), 0};
  return u;
}
/// A fraction strictly between 0 and 1.
inline Rational share(Random& random) {
  const std::int64_t whole = random.between(2, 5), part = random.between(1, whole - 1);
  return ratio(part, whole);
}
/// Numbers in increasing order from `low` to `high`, these included, `inner` of them between.
inline std::vector<Rational> subdivided(const Rational& low, const Rational& high, std::size_t inner, Random& random) {
  std::set<Rational> cuts{low, high};
  while (cuts.size() < inner + 2) cuts.insert(Rational(low + (high - low) * ratio(random.between(1, 11), 12)));
  return {cuts.begin(), cuts.end()};
}

// ---- Families: surfaces that close the shaft -----------------------------------------------------------------------------------------------------
// A surface over all of [-1, 1]^2 between the heights of source and target hides the target: the height above it of a point that goes along a line changes sign.
// A piece of it missing is seen through along the vertical.

/// Triangles around a point, corners at any height: they share edges, some fold steeply.
inline Draft shared_edges(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  Points rim;
  for (const Exact_point& corner : rectangle(-1, 1, -1, 1, 0)) rim.push_back(corner);
  for (std::size_t count = random.below(4); count > 0; --count) {
    const std::size_t k = random.below(rim.size());
    rim.insert(rim.begin() + static_cast<std::ptrdiff_t>(k) + 1, along(rim[k], share(random), minus(rim[(k + 1) % rim.size()], rim[k])));
  }
  for (Exact_point& p : rim) p[2] = ratio(random.between(1, 7), 2);
  const Exact_point middle{ratio(random.between(-3, 3), 4), ratio(random.between(-3, 3), 4), ratio(random.between(1, 7), 2)};
  for (std::size_t k = 0; k < rim.size(); ++k) draft.faces.push_back({rim[k], rim[(k + 1) % rim.size()], middle});
  shrink_one(draft.faces, 1, gap, random);
  draft.truth = sgn(gap) > 0;
  return draft;
}

/// Two slopes that meet in a ridge, each cut across at places of its own: along the ridge no edge is shared as a whole.
inline Draft cracks(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational ridge = ratio(random.between(-2, 2), 3), start = ratio(random.between(3, 5), 2), rise = ratio(random.between(-2, 2), 4);
  for (const long side : {-1, 1}) {
    const Rational slope = ratio(random.between(-4, 4), 4);
    const std::size_t inner = random.below(3);
    const std::vector<Rational> cuts = subdivided(-1, 1, inner, random);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Rational low = Rational(start + rise * cuts[k]), high = Rational(start + rise * cuts[k + 1]);
      draft.faces.push_back(
          {at(ridge, cuts[k], low), at(ridge, cuts[k + 1], high), at(side, cuts[k + 1], Rational(high + slope)), at(side, cuts[k], Rational(low + slope))});
    }
  }
  shrink_one(draft.faces, 1, gap, random);
  draft.truth = sgn(gap) > 0;
  return draft;
}

/// A square in one plane cut again and again by lines, each across one piece: T-junctions.
inline Draft t_junctions(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  Faces tiles{rectangle(-1, 1, -1, 1, integer(random, 1, 3))};
  for (std::size_t count = 1 + random.below(6); count > 0; --count) {
    const std::size_t tile = random.below(tiles.size()), n = tiles[tile].size(), first = random.below(n), other = first + 1 + random.below(n - 1);
    const Points whole = tiles[tile];
    const auto on_edge = [&](std::size_t k) { return along(whole[k % n], share(random), minus(whole[(k + 1) % n], whole[k % n])); };
    const Exact_point p = on_edge(first), q = on_edge(other);
    Points left{p}, right{q};
    for (std::size_t k = first + 1; k <= other; ++k) left.push_back(whole[k % n]);
    for (std::size_t k = other + 1; k <= first + n; ++k) right.push_back(whole[k % n]);
    left.push_back(q), right.push_back(p);
    tiles[tile] = left, tiles.push_back(right);
  }
  view_scenes::add(draft.faces, tiles);
  shrink_one(draft.faces, 1, gap, random);
  draft.truth = sgn(gap) > 0;
  return draft;
}

/// Strips in one plane that overlap, up to a seam in which they only touch.
inline Draft coplanar_overlap(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational height = integer(random, 1, 3);
  const std::vector<Rational> cuts = subdivided(-1, 1, 1 + random.below(4), random);
  const std::size_t seam = 1 + random.below(cuts.size() - 2);
  const auto add_strip = [&](Rational from, Rational to, bool left_of_seam) {
    if (left_of_seam) to = std::min(to, cuts[seam]);
    else from = std::max(from, Rational(cuts[seam] + gap));
    const Rational low = Rational(-1 - ratio(random.between(0, 2), 2)), high = Rational(1 + ratio(random.between(0, 2), 2));
    draft.faces.push_back(rectangle(from, to, low, high, height));
  };
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const Rational before = ratio(random.between(0, 3), 4), after = ratio(random.between(0, 3), 4);
    add_strip(k == seam ? Rational(cuts[k] + gap) : Rational(cuts[k] - before), Rational(cuts[k + 1] + after), k < seam);
  }
  draft.truth = sgn(gap) > 0;
  return draft;
}

// ---- Families: edges that one line meets -----------------------------------------------------------------------------------------------------------
// Plates that reach out of the shaft on one side of an edge: a line is free if its side of each edge has the right sign. Where the Pluecker coordinates of the edges,
// each with its sign, have a positive combination that is zero, no line has all signs right, whatever the plates' planes. One plate drawn back by a gap frees those lines
// that met all edges.

/// A plane through an edge of the source, edges in it of a plate left of it and then of one right of it: a line would have to cross the plane twice.
inline Draft coplanar_edges(Random& random, const Rational& gap, bool parallel) {
  Draft draft = shaft(4);
  const Rational lean = ratio(random.between(1, 7), 16);  // the plane x = 1 - lean z
  Rational heights[2][2];                                 // of either plate's edge, at y = -4 and at y = 4
  for (std::size_t k = 0; k < 2; ++k)
    for (Rational& z : heights[k]) z = Rational(1 + static_cast<long>(k) + (parallel ? ratio(1, 2) : ratio(random.between(1, 7), 8)));
  for (std::size_t k = 0; k < 2; ++k) {
    Exact_point a = at(Rational(1 - lean * heights[k][0]), -4, heights[k][0]), b = at(Rational(1 - lean * heights[k][1]), 4, heights[k][1]);
    if (k == 1) a[0] += gap, b[0] += gap;
    const Rational slope = parallel ? Rational(0) : ratio(random.between(-1, 1), 16);
    const Exact_point w = at(k == 0 ? -4 : 4, 0, slope);
    draft.faces.push_back({a, b, along(b, 1, w), along(a, 1, w)});
  }
  draft.truth = sgn(gap) > 0;
  return draft;
}
inline Draft slats(Random& random, const Rational& gap) { return coplanar_edges(random, gap, true); }
inline Draft edges_in_one_plane(Random& random, const Rational& gap) { return coplanar_edges(random, gap, false); }

/// Edges through one point. With the moment n of a line about it, sides are u_k . n; the directions u_k add up to zero.
inline Draft concurrent_edges(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Exact_point point{ratio(random.between(-2, 2), 4), ratio(random.between(-2, 2), 4), 2};
  Points directions;
  const auto flat = [](const Exact_point& u) { return sgn(u[0]) == 0 && sgn(u[1]) == 0; };
  do {
    directions.assign(2 + random.below(2), at(0, 0, 0));
    Exact_point last = at(0, 0, 0);
    for (Exact_point& u : directions) {
      u = {integer(random, -3, 3), integer(random, -3, 3), ratio(random.between(-1, 1), 8)};
      last = along(last, -1, u);
    }
    directions.push_back(last);
  } while (std::any_of(directions.begin(), directions.end(), flat));
  const std::size_t drawn_back = random.below(directions.size());
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const Exact_point &u = directions[k], w = at(u[1], Rational(-u[0]), ratio(random.between(-1, 1), 8));
    draft.faces.push_back(plate(along(point, k == drawn_back ? gap : Rational(0), w), scaled(3, u), scaled(3, w)));
  }
  if (sgn(gap) <= 0) draft.truth = false;
  else  // verticals with the moment n, if the other sides allow one
    for (long x = -5; x <= 5; ++x)
      for (long y = -5; y <= 5; ++y) {
        bool free = true;
        for (std::size_t k = 0; k < directions.size(); ++k) free = free && (k == drawn_back || sgn(directions[k][0] * x + directions[k][1] * y) > 0);
        if (free) draft.truth = true;
      }
  return draft;
}

/// Four rulings of y = k x (z - 2), at four heights. On a line y - k x (z - 2) is a quadratic in z: its sign can change twice, not thrice.
inline Draft regulus(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational steepness = ratio(random.between(1, 4), 4);
  std::set<Rational> heights;
  while (heights.size() < 4) heights.insert(ratio(random.between(2, 14), 4));
  const bool alternating = random.chance(1, 2);
  const std::size_t drawn_back = random.below(4);
  std::size_t changes = 0, k = 0;
  long free = random.chance(1, 2) ? 1 : -1;
  for (const Rational& height : heights) {
    if (k > 0 && (alternating || random.chance(1, 2))) ++changes, free = -free;
    const Rational slope = Rational(steepness * (height - 2));
    Exact_point on = at(0, 0, height);
    if (k++ == drawn_back) on[1] -= free * gap;
    draft.faces.push_back(plate(on, at(2, Rational(2 * slope), 0), at(0, -6 * free, ratio(random.between(-1, 1), 4))));
  }
  draft.truth = changes < 3 || sgn(gap) > 0;
  return draft;
}

/// Rulings y = c x, z = c at c_1 < c_2 < c_3, and the line through (0, 0, c_4) in direction (1, c_4, v), which is tangent to y = x z there: the z axis meets all
/// four and is a double root. Lines are x = a + alpha z, y = b + beta z; f(z) = y - x z on them is b + (beta - a) z - alpha z^2, and must be > 0, < 0, > 0 at the first
/// three, f(c_4) < v (alpha b - beta a) at the fourth. By interpolation f(c_4) = sum |L_k f(c_k)| > 0, and alpha b - beta a <= discriminant(f) / 4 <= 5/4 |f|^2
/// for the largest coefficient |f| <= 3, itself at most max 2 / |(c_k - c_i) (c_k - c_j)| times sum |f(c_k)|. So it is hidden for small v > 0;
/// for v < 0 lines near x = 1/2, y = z / 2 are free.
inline Draft tangent(Random& random, const Rational& gap) {
  Draft draft = shaft(1);
  const std::vector<Rational> cuts = subdivided(0, 1, 4, random);
  const Rational* const c = cuts.data() + 1;
  Rational least = 1000, most = 0;  // |L_k|, and the bound on coefficients
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const Rational across = Rational((c[k] - c[i]) * (c[k] - c[j]));
    least = std::min(least, Rational(abs((c[3] - c[i]) * (c[3] - c[j]) / across)));
    most = std::max(most, Rational(2 / abs(across)));
  }
  const bool turned = random.chance(1, 4);
  Rational v = std::min(Rational(least / (ratio(15, 4) * most * integer(random, 1, 2))), Rational((1 - c[3]) / 4));  // plates stay below z = 1
  if (turned) v = -v;
  for (std::size_t k = 0; k < 3; ++k) draft.faces.push_back(plate(at(0, 0, c[k]), at(2, Rational(2 * c[k]), 0), at(0, k % 2 == 0 ? -6 : 6, 0)));
  draft.faces.push_back(plate(at(0, gap, c[3]), at(2, Rational(2 * c[3]), Rational(2 * v)), at(0, 6, 0)));
  draft.truth = turned || sgn(gap) > 0;
  return draft;
}

/// Five horizontal edges that a line meets, in general position but for that: free lines (a, b), a + b z at height z, have n_k . (a + b z_k) > d_k. Hidden iff the
/// one linear relation of the vectors (n_k, z_k n_k) has coefficients of one sign.
inline Draft five_edges(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const std::size_t drawn_back = random.below(5);
  std::vector<std::vector<Rational>> normals;
  std::vector<Rational> heights;
  const bool wants_hidden = random.chance(3, 4);
  while (true) {
    heights = subdivided(0, 4, 5, random);
    normals.clear();
    for (std::size_t k = 1; k < 6; ++k) {
      const Rational x = integer(random, -4, 4), y = integer(random, -4, 4);
      normals.push_back({x, y, Rational(heights[k] * x), Rational(heights[k] * y)});
    }
    int positive = 0, negative = 0;
    for (std::size_t k = 0; k < 5; ++k) {  // by Cramer's rule
      std::vector<std::vector<Rational>> others = normals;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      const int sign = sgn(determinant(others)) * (k % 2 == 0 ? 1 : -1);
      positive += sign > 0, negative += sign < 0;
    }
    const bool hidden = positive == 5 || negative == 5;
    if (positive + negative == 5 && hidden == wants_hidden) break;
  }
  const Exact_point from{ratio(random.between(-2, 2), 4), ratio(random.between(-2, 2), 4), 0}, to{ratio(random.between(-2, 2), 4), ratio(random.between(-2, 2), 4), 4};
  for (std::size_t k = 0; k < 5; ++k) {
    const Exact_point n = at(normals[k][0], normals[k][1], 0), on = along(from, heights[k + 1] / 4, minus(to, from));
    draft.faces.push_back(plate(along(on, k == drawn_back ? Rational(-gap) : Rational(0), n), at(Rational(-3 * n[1]), Rational(3 * n[0]), 0), scaled(-3, n)));
  }
  draft.truth = !wants_hidden || sgn(gap) > 0;
  return draft;
}

/// Plates with a slit or a hole, of width 2^-k for k up to 60, around one line; or one of them closed, or overlapping.
inline Draft apertures(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const std::size_t plates = 1 + random.below(3), closed = random.below(plates);
  const Exact_point from{ratio(random.between(-2, 2), 4), ratio(random.between(-2, 2), 4), 0}, to{ratio(random.between(-2, 2), 4), ratio(random.between(-2, 2), 4), 4};
  for (std::size_t k = 0; k < plates; ++k) {
    const Exact_point on = along(from, ratio(static_cast<std::int64_t>(k) + 1, 4), minus(to, from));
    static constexpr unsigned long exponents[] = {1, 2, 5, 10, 20, 30, 40, 50, 60};
    Rational half(1, 1ul << exponents[random.below(9)]), other(1, 1ul << exponents[random.below(9)]);
    if (k == closed) half *= sgn(gap);
    half /= 2, other /= 2;
    if (random.chance(1, 2)) {
      const Exact_point u = level_direction(random), across = at(Rational(-u[1]), u[0], 0);
      draft.faces.push_back(plate(along(on, half, across), scaled(4, u), scaled(4, across)));
      draft.faces.push_back(plate(along(on, Rational(-half), across), scaled(4, u), scaled(-4, across)));
    } else {  // four rectangles, each beside the next
      const Rational x0 = Rational(on[0] - half), x1 = Rational(on[0] + half), y0 = Rational(on[1] - other), y1 = Rational(on[1] + other), &z = on[2];
      view_scenes::add(draft.faces, {rectangle(-1, x0, -1, y1, z), rectangle(-1, x1, y1, 1, z), rectangle(x1, 1, y0, 1, z), rectangle(x0, 1, -1, y0, z)});
    }
  }
  draft.truth = sgn(gap) > 0;
  return draft;
}

// ---- Families: source and target with edges, corners, planes in common -------------------------------------------------------------------------------

/// A floor and a wall that share an edge or a corner, and a plate in the plane x = z between them. Lines from (a, y) on the floor to (b, y') on the wall cross it at
/// x = a b / (a + b), at most 1; where both are triangles of half-width a / 2, b / 2 at |y| <= x.
inline Draft hinged(Random& random, const Rational& gap) {
  Draft draft;
  const Rational near = Rational(1 - gap);
  if (random.chance(1, 2)) {
    draft.source = {at(0, -1, 0), at(2, -1, 0), at(2, 1, 0), at(0, 1, 0)};
    draft.faces = {{at(0, -1, 0), at(0, 1, 0), at(0, 1, 2), at(0, -1, 2)}};
    const Rational end = integer(random, 1, 2), side = integer(random, 1, 2);
    switch (random.below(3)) {
      case 0: draft.faces.push_back({at(gap, -1, gap), at(end, Rational(-side), end), at(end, side, end), at(gap, 1, gap)}); break;
      case 1: draft.faces.push_back({at(0, -1, 0), at(near, Rational(-side), near), at(near, side, near), at(0, 1, 0)}); break;
      default: draft.faces.push_back({at(0, -1, 0), at(end, -1, end), at(end, near, end), at(0, near, 0)});
    }
  } else {
    draft.source = {at(0, 0, 0), at(2, -1, 0), at(2, 1, 0)};
    draft.faces = {{at(0, 0, 0), at(0, 1, 2), at(0, -1, 2)}};
    switch (random.below(3)) {
      case 0: draft.faces.push_back({at(gap, 0, gap), at(1, -1, 1), at(1, 1, 1)}); break;
      case 1: draft.faces.push_back({at(0, 0, 0), at(near, Rational(-near), near), at(near, near, near)}); break;
      default: draft.faces.push_back({at(0, 0, 0), at(1, -1, 1), at(1, near, 1)});
    }
  }
  draft.truth = sgn(gap) > 0;
  return draft;
}

/// Planes that cut the other polygon, or nearly: nothing between, and little in front.
inline Draft facing(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational low = integer(random, -2, 1), high = Rational(low + integer(random, 1, 2)), back = integer(random, -3, -1);
  draft.truth = sgn(gap) > 0;
  switch (random.below(6)) {
    case 0: draft.faces = {{at(-1, low, back), at(-1, high, back), at(-1, high, gap), at(-1, low, gap)}}; break;   // a wall behind the source's plane but for its top
    case 1: draft.faces = {{at(-1, low, 1), at(-1, high, back), at(-1, high, gap)}}, draft.truth = true; break;     // across it
    case 2:  // a wall, and the source behind it but for its rim
      draft.source = rectangle(back, gap, -1, 1, 0);
      draft.faces = {{at(0, low, 0), at(0, high, 0), at(0, high, 2), at(0, low, 2)}};
      break;
    case 3: draft.faces = {reversed(rectangle(low, high, low, high, gap))}; break;                                         // parallel, or in one plane
    case 4: draft.faces = {rectangle(low, high, low, high, Rational(4 + gap))}, draft.truth = false; break;                // turned away
    default:  // a triangle that is hardly steeper than the source's plane: in front of it is p where gap (2 (x - low) - (high - low) y) > 0
      draft.faces = {{at(low, -1, Rational(-gap)), at(high, 1, Rational(-gap)), at(low, 1, gap)}};
      draft.truth = sgn(gap) > 0 || (sgn(gap) < 0 && 2 * (-1 - low) < high - low);
  }
  return draft;
}

/// A lid in the target's plane blocks nothing, just before it everything; also one in the source's.
inline Draft lids(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational wide = Rational(1 + ratio(random.between(1, 2), 2));
  draft.faces.push_back(rectangle(Rational(-wide), wide, -1, wide, Rational(4 + gap)));
  draft.faces.push_back(rectangle(-1, wide, Rational(-wide), 1, random.chance(1, 2) ? Rational(-gap) : Rational(0)));
  draft.truth = sgn(gap) >= 0;
  return draft;
}

/// Two slopes that start from a line across the source, touching it or coming through it, and cover it like a valley.
inline Draft valley(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational middle = ratio(random.between(-3, 3), 4);
  const std::uint64_t where = random.below(3);  // the gap: on the source, at the far end, at the side
  const long chosen = random.chance(1, 2) ? 1 : -1;
  for (const long side : {-1, 1}) {
    const Rational steepness = ratio(random.between(1, 7), 4), deep = ratio(random.between(0, 2), 4), mine = side == chosen ? gap : Rational(0);
    const Rational from = where == 0 ? Rational(middle + side * mine) : Rational(middle - side * deep);
    const Rational to = Rational(side * (where == 1 ? Rational(1 - mine) : Rational(1))), low = -1, high = where == 2 ? Rational(1 - mine) : Rational(1);
    const auto height = [&](const Rational& x) { return Rational(side * steepness * (x - middle)); };
    draft.faces.push_back({at(from, low, height(from)), at(to, low, height(to)), at(to, high, height(to)), at(from, high, height(from))});
  }
  draft.truth = sgn(gap) > 0;
  return draft;
}

// ---- Families: closed bodies, and no truth -----------------------------------------------------------------------------------------------------------

inline Exact_point box_size(Random& random) { return {integer(random, 1, 3), integer(random, 1, 3), integer(random, 1, 3)}; }
inline void all_are_targets(Draft& draft) {
  draft.targets.clear();
  for (std::size_t k = 0; k < draft.faces.size(); ++k) draft.targets.push_back(k);
}

inline Draft boxes(Random& random, const Rational& gap) {
  using view_scenes::box;
  Draft draft;
  draft.bodies = true;
  const Exact_point low = lattice(random, 1), high = along(low, 1, box_size(random));
  switch (random.below(4)) {
    case 0: {  // one on the other: the upper one's bottom from the lower one's top
      const Exact_point base{Rational(low[0] + ratio(random.between(-1, 1), 2)), Rational(low[1] + ratio(random.between(-1, 1), 2)), Rational(high[2] + gap)};
      draft.faces = box(low, high);
      draft.source = draft.faces[5];
      view_scenes::add(draft.faces, box(base, along(base, 1, box_size(random))));
      draft.targets = {10}, draft.truth = sgn(gap) > 0;
      break;
    }
    case 1:  // a square in a box, one of whose walls is a little too small
      draft.source = rectangle(-3, 3, -3, 3, -1);
      draft.faces = {reversed(rectangle(-1, 1, -1, 1, 2))};
      view_scenes::add(draft.faces, box(at(-1, -1, 1), at(1, 1, 3)));
      shrink_one(draft.faces, 1, gap, random);
      if (sgn(gap) <= 0) draft.truth = false;
      break;
    case 2: {  // a room with a box in it, perhaps at a wall
      draft.faces = box(at(-3, -3, -3), at(3, 3, 3));
      for (Points& face : draft.faces) face = reversed(face);
      draft.source = draft.faces[random.below(6)];
      view_scenes::add(draft.faces, box(low, along(low, 2, at(1, 1, 1))));
      all_are_targets(draft);
      break;
    }
    default: {
      const Exact_point other = lattice(random, 4), third = lattice(random, 4);
      draft.faces = box(low, high);
      draft.source = draft.faces[random.below(6)];
      view_scenes::add(draft.faces, box(other, along(other, 1, box_size(random))));
      view_scenes::add(draft.faces, box(third, along(third, 1, box_size(random))));
      all_are_targets(draft);
      draft.targets.erase(draft.targets.begin(), draft.targets.begin() + 6);
    }
  }
  return draft;
}

/// One face from that number on is moved by the gap along an axis.
inline void move_a_face(Draft& draft, std::size_t first, const Rational& gap, Random& random) {
  Points& face = draft.faces[first + random.below(draft.faces.size() - first)];
  const std::size_t axis = random.below(3);
  for (Exact_point& p : face) p[axis] += gap;
}

/// Anything on the integer lattice: faces cross each other and the source, and share planes, edges and corners.
inline Draft lattice_faces(Random& random, const Rational& gap) {
  Draft draft;
  view_scenes::add_any(draft.faces, 2 + random.below(7), random);
  const Exact_point corner = lattice(random, 3);
  const auto [u, v] = view_scenes::directions(random, 3);
  draft.source = view_scenes::in_plane(corner, u, v, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  if (random.chance(1, 2)) draft.source.pop_back();
  move_a_face(draft, 0, gap, random);
  all_are_targets(draft);
  return draft;
}

inline Draft triangles(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational narrow = ratio(1, random.between(1, 6));
  for (Points* square : {&draft.source, &draft.faces[0]})
    for (Exact_point& p : *square) p[0] *= narrow, p[1] *= narrow;
  const std::size_t count = 3 + random.below(10);
  while (draft.faces.size() < count) {
    const Exact_point centre{ratio(random.between(-3, 3), 4), ratio(random.between(-3, 3), 4), ratio(random.between(4, 12), 4)};
    Points corners(3, centre);
    for (Exact_point& p : corners) p = along(p, ratio(1, 4), Exact_point{integer(random, -12, 12), integer(random, -12, 12), integer(random, -3, 3)});
    if (!oracle::is_zero(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0])))) draft.faces.push_back(corners);
  }
  move_a_face(draft, 1, gap, random);
  return draft;
}

}  // namespace weak_scenes
