#include <sightline/harness/generate/weak_shafts.h>

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/projective.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace sightline::generate::weak_drafts {

Draft shared_edges(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  Points rim;
  for (const Exact_point& corner : rectangle(-1, 1, -1, 1, 0)) rim.push_back(corner);
  for (std::size_t count = random.below(4); count > 0; --count) {
    const std::size_t k = random.below(rim.size());
    rim.insert(rim.begin() + static_cast<std::ptrdiff_t>(k) + 1,
               along(rim[k], share(random), minus(rim[(k + 1) % rim.size()], rim[k])));
  }
  for (Exact_point& p : rim) p[2] = ratio(random.between(1, 7), 2);
  const Exact_point middle{ratio(random.between(-3, 3), 4), ratio(random.between(-3, 3), 4),
                           ratio(random.between(1, 7), 2)};
  for (std::size_t k = 0; k < rim.size(); ++k) draft.faces.push_back({rim[k], rim[(k + 1) % rim.size()], middle});
  shrink_one(draft.faces, 1, gap, random);
  draft.truth = sgn(gap) > 0;
  return draft;
}

Draft cracks(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational ridge = ratio(random.between(-2, 2), 3), start = ratio(random.between(3, 5), 2),
                 rise = ratio(random.between(-2, 2), 4);
  for (const long side : {-1, 1}) {
    const Rational slope = ratio(random.between(-4, 4), 4);
    const std::size_t inner = random.below(3);
    const std::vector<Rational> cuts = subdivided(-1, 1, inner, random);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Rational low = Rational(start + rise * cuts[k]), high = Rational(start + rise * cuts[k + 1]);
      draft.faces.push_back({at(ridge, cuts[k], low), at(ridge, cuts[k + 1], high),
                             at(side, cuts[k + 1], Rational(high + slope)), at(side, cuts[k], Rational(low + slope))});
    }
  }
  shrink_one(draft.faces, 1, gap, random);
  draft.truth = sgn(gap) > 0;
  return draft;
}

Draft t_junctions(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  Faces tiles{rectangle(-1, 1, -1, 1, integer(random, 1, 3))};
  for (std::size_t count = 1 + random.below(6); count > 0; --count) {
    const std::size_t tile = random.below(tiles.size()), n = tiles[tile].size(), first = random.below(n),
                      other = first + 1 + random.below(n - 1);
    const Points whole = tiles[tile];
    const auto on_edge = [&](std::size_t k) {
      return along(whole[k % n], share(random), minus(whole[(k + 1) % n], whole[k % n]));
    };
    const Exact_point p = on_edge(first), q = on_edge(other);
    Points left{p}, right{q};
    for (std::size_t k = first + 1; k <= other; ++k) left.push_back(whole[k % n]);
    for (std::size_t k = other + 1; k <= first + n; ++k) right.push_back(whole[k % n]);
    left.push_back(q);
    right.push_back(p);
    tiles[tile] = left;
    tiles.push_back(right);
  }
  add(draft.faces, tiles);
  shrink_one(draft.faces, 1, gap, random);
  draft.truth = sgn(gap) > 0;
  return draft;
}

Draft coplanar_overlap(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational height = integer(random, 1, 3);
  const std::vector<Rational> cuts = subdivided(-1, 1, 1 + random.below(4), random);
  const std::size_t seam = 1 + random.below(cuts.size() - 2);
  const auto add_strip = [&](Rational from, Rational to, bool left_of_seam) {
    if (left_of_seam) to = std::min(to, cuts[seam]);
    else from = std::max(from, Rational(cuts[seam] + gap));
    const Rational low = Rational(-1 - ratio(random.between(0, 2), 2)),
                   high = Rational(1 + ratio(random.between(0, 2), 2));
    draft.faces.push_back(rectangle(from, to, low, high, height));
  };
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const Rational before = ratio(random.between(0, 3), 4), after = ratio(random.between(0, 3), 4);
    add_strip(k == seam ? Rational(cuts[k] + gap) : Rational(cuts[k] - before), Rational(cuts[k + 1] + after),
              k < seam);
  }
  draft.truth = sgn(gap) > 0;
  return draft;
}

Draft coplanar_edges(Random& random, const Rational& gap, bool parallel) {
  Draft draft = shaft(4);
  const Rational lean = ratio(random.between(1, 7), 16);  // the plane x = 1 - lean z
  Rational heights[2][2];                                 // of either plate's edge, at y = -4 and at y = 4
  for (std::size_t k = 0; k < 2; ++k)
    for (Rational& z : heights[k])
      z = Rational(1 + static_cast<long>(k) + (parallel ? ratio(1, 2) : ratio(random.between(1, 7), 8)));
  for (std::size_t k = 0; k < 2; ++k) {
    Exact_point a = at(Rational(1 - lean * heights[k][0]), -4, heights[k][0]),
                b = at(Rational(1 - lean * heights[k][1]), 4, heights[k][1]);
    if (k == 1) {
      a[0] += gap;
      b[0] += gap;
    }
    const Rational slope = parallel ? Rational(0) : ratio(random.between(-1, 1), 16);
    const Exact_point w = at(k == 0 ? -4 : 4, 0, slope);
    draft.faces.push_back({a, b, along(b, 1, w), along(a, 1, w)});
  }
  draft.truth = sgn(gap) > 0;
  return draft;
}

Draft concurrent_edges(Random& random, const Rational& gap) {
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
        for (std::size_t k = 0; k < directions.size(); ++k)
          free = free && (k == drawn_back || sgn(directions[k][0] * x + directions[k][1] * y) > 0);
        if (free) draft.truth = true;
      }
  return draft;
}

Draft regulus(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational steepness = ratio(random.between(1, 4), 4);
  std::set<Rational> heights;
  while (heights.size() < 4) heights.insert(ratio(random.between(2, 14), 4));
  const bool alternating = random.chance(1, 2);
  const std::size_t drawn_back = random.below(4);
  std::size_t changes = 0, k = 0;
  long free = random.chance(1, 2) ? 1 : -1;
  for (const Rational& height : heights) {
    if (k > 0 && (alternating || random.chance(1, 2))) {
      ++changes;
      free = -free;
    }
    const Rational slope = Rational(steepness * (height - 2));
    Exact_point on = at(0, 0, height);
    if (k++ == drawn_back) on[1] -= free * gap;
    draft.faces.push_back(plate(on, at(2, Rational(2 * slope), 0), at(0, -6 * free, ratio(random.between(-1, 1), 4))));
  }
  if (changes == 3) draft.truth = sgn(gap) > 0;
  else if (sgn(gap) >= 0) draft.truth = true;  // a wide overlap may close what is free
  return draft;
}

Draft tangent(Random& random, const Rational& gap) {
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
  Rational v = std::min(Rational(least / (ratio(15, 4) * most * integer(random, 1, 2))),
                        Rational((1 - c[3]) / 4));  // plates stay below z = 1
  if (turned) v = -v;
  for (std::size_t k = 0; k < 3; ++k)
    draft.faces.push_back(plate(at(0, 0, c[k]), at(2, Rational(2 * c[k]), 0), at(0, k % 2 == 0 ? -6 : 6, 0)));
  draft.faces.push_back(plate(at(0, gap, c[3]), at(2, Rational(2 * c[3]), Rational(2 * v)), at(0, 6, 0)));
  if (!turned) draft.truth = sgn(gap) > 0;
  else if (gap > v / 4) draft.truth = true;
  return draft;
}

Draft five_edges(Random& random, const Rational& gap) {
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
      positive += sign > 0;
      negative += sign < 0;
    }
    const bool hidden = positive == 5 || negative == 5;
    if (positive + negative == 5 && hidden == wants_hidden) break;
  }
  const Exact_point from{ratio(random.between(-2, 2), 4), ratio(random.between(-2, 2), 4), 0},
      to{ratio(random.between(-2, 2), 4), ratio(random.between(-2, 2), 4), 4};
  for (std::size_t k = 0; k < 5; ++k) {
    const Exact_point n = at(normals[k][0], normals[k][1], 0), on = along(from, heights[k + 1] / 4, minus(to, from));
    draft.faces.push_back(plate(along(on, k == drawn_back ? Rational(-gap) : Rational(0), n),
                                at(Rational(-3 * n[1]), Rational(3 * n[0]), 0), scaled(-3, n)));
  }
  if (wants_hidden) draft.truth = sgn(gap) > 0;
  else if (sgn(gap) >= 0) draft.truth = true;  // a wide overlap may close what is free
  return draft;
}

Draft apertures(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const std::size_t plates = 1 + random.below(3), closed = random.below(plates);
  const Exact_point from{ratio(random.between(-2, 2), 4), ratio(random.between(-2, 2), 4), 0},
      to{ratio(random.between(-2, 2), 4), ratio(random.between(-2, 2), 4), 4};
  for (std::size_t k = 0; k < plates; ++k) {
    const Exact_point on = along(from, ratio(static_cast<std::int64_t>(k) + 1, 4), minus(to, from));
    static constexpr unsigned long exponents[] = {1, 2, 5, 10, 20, 30, 40, 50, 60};
    Rational half(1, 1ul << exponents[random.below(9)]), other(1, 1ul << exponents[random.below(9)]);
    if (k == closed) half *= sgn(gap);
    half /= 2;
    other /= 2;
    if (random.chance(1, 2)) {
      const Exact_point u = level_direction(random), across = at(Rational(-u[1]), u[0], 0);
      draft.faces.push_back(plate(along(on, half, across), scaled(4, u), scaled(4, across)));
      draft.faces.push_back(plate(along(on, Rational(-half), across), scaled(4, u), scaled(-4, across)));
    } else {  // four rectangles, each beside the next
      const Rational x0 = Rational(on[0] - half), x1 = Rational(on[0] + half), y0 = Rational(on[1] - other),
                     y1 = Rational(on[1] + other), &z = on[2];
      add(draft.faces, {rectangle(-1, x0, -1, y1, z), rectangle(-1, x1, y1, 1, z), rectangle(x1, 1, y0, 1, z),
                        rectangle(x0, 1, -1, y0, z)});
    }
  }
  draft.truth = sgn(gap) > 0;
  return draft;
}

}  // namespace sightline::generate::weak_drafts
