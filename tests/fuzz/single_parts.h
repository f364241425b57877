#pragma once
// Parts of the library by themselves, at the bounds of what they are asked: boxes for rays, matrix games, moments of a
// path, tables of planes, vertices of a CGAL kernel, points rounded to numbers, places in an image, and what is left of
// faces that are hardly any.

#include "decimal.h"
#include "refusals.h"
#include "support.h"

#include <sightline/algorithms/image/pixel_cones.h>
#include <sightline/algorithms/rays/ray_boxes.h>
#include <sightline/algorithms/solids/rounding.h>
#include <sightline/algorithms/verify/faces.h>
#include <sightline/algorithms/verify/moments.h>
#include <sightline/algorithms/verify/set_aside.h>
#include <sightline/algorithms/verify/surface.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/algorithms/weak_visibility/search/matrix_game.h>
#include <sightline/harness/generate/pixel_views.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/coordinates.h>
#include <sightline/kernel/fixed_integer.h>
#include <sightline/kernel/line_table.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/point_traits.h>
#include <sightline/kernel/vectors.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fuzz {

using generate::Random;

// ---- Boxes for rays

/// Where a ray is in a box, as [t, u]; nothing where it passes it by. In rationals.
inline std::optional<std::array<Rational, 2>> in_box(const Ray_boxes::Ray& ray, const Ray_boxes::Box& box) {
  Rational first = 0, last = 1000000;
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational o = exact(ray.origin[k]), d = exact(ray.direction[k]), low = exact(box.low[k]),
                   high = exact(box.high[k]);
    if (d == 0) {
      if (o < low || o > high) return std::nullopt;
      continue;
    }
    const Rational one = (low - o) / d, other = (high - o) / d;
    first = std::max(first, std::min(one, other));
    last = std::min(last, std::max(one, other));
  }
  if (first > last) return std::nullopt;
  return std::array{first, last};
}

/// Each box that a ray meets before the limit is in a leaf that it visits; none is visited twice.
inline void try_ray_boxes(Random& random) {
  const bool many = random.chance(1, 100), chain = random.chance(1, 4);
  const std::size_t count = many ? 4096 + random.below(200) : random.below(chain ? 90 : 40);
  std::vector<Ray_boxes::Box> boxes(count);
  double place = 1;  // of a chain, whose boxes no plane halves
  for (Ray_boxes::Box& box : boxes) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double size = chain ? 0 : static_cast<double>(random.below(8)) / 64;
      box.low[k] = chain ? (k == 0 ? place : 0) : static_cast<double>(random.between(-64, 56)) / 64;
      box.high[k] = box.low[k] + size;
    }
    place /= 32;
  }
  const Ray_boxes tree(boxes);
  require(tree.order().size() == count, "each box is in the order of leaves");
  const std::set<std::uint32_t> all(tree.order().begin(), tree.order().end());
  require(all.size() == count && (count == 0 || *all.rbegin() == count - 1), "no box is in two leaves");
  for (std::size_t turn = 0; turn < (many ? 3 : 8); ++turn) {
    Ray_boxes::Ray ray{{}, {}, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      ray.origin[k] = chain && random.chance(3, 4) ? 0 : static_cast<double>(random.between(-128, 128)) / 64;
      ray.direction[k] = static_cast<double>(random.between(-4, 4)) / 4;
    }
    ray.direction[random.below(3)] = random.chance(1, 2) ? 1 : -1;
    const float limit =
        random.chance(1, 2) ? std::numeric_limits<float>::infinity() : static_cast<float>(random.below(16)) / 8;
    std::vector<bool> visited(count);
    tree.visit(
        ray,
        [&](std::uint32_t first, std::uint32_t size) {
          require(size > 0 && first + size <= count, "a leaf has boxes");
          for (std::uint32_t at = first; at < first + size; ++at) {
            require(!visited[tree.order()[at]], "no leaf is visited twice");
            visited[tree.order()[at]] = true;
          }
        },
        [&] { return limit; });
    for (std::size_t i = 0; i < count; ++i) {
      if (visited[i]) continue;
      const auto range = in_box(ray, boxes[i]);
      require(!range || (std::isfinite(limit) && (*range)[0] > exact(double{limit})),
              "a box that a ray meets before the limit is visited");
    }
  }
}

// ---- Matrix games

/// Mixtures prove a game's value from both sides; one that is ended early has no value below the right one.
inline void try_games(Random& random) {
  const std::size_t columns = 1 + random.below(5), rows = 1 + random.below(7);
  std::vector<std::vector<Rational>> a(rows, std::vector<Rational>(columns));
  for (auto& row : a)
    for (Rational& x : row) x = Rational(random.between(-6, 6)) / (random.chance(1, 4) ? 7 : 6);
  const auto filled = [&](auto& game, std::size_t most) {
    game.restart(columns);
    for (std::size_t k = 0; k < std::min(rows, most); ++k) {
      const auto room = game.add_row();
      for (std::size_t c = 0; c < columns; ++c)
        if constexpr (std::is_same_v<std::decay_t<decltype(room[c])>, Rational>) room[c] = a[k][c];
        else room[c] = a[k][c].get_d();
    }
  };
  const auto best_for_columns = [&](const auto& game) {
    std::optional<Rational> least;
    for (std::size_t k = 0; k < rows; ++k) {
      Rational sum = 0;
      for (std::size_t c = 0; c < columns; ++c) sum += a[k][c] * Rational(game.column_weights()[c]);
      if (!least || sum < *least) least = sum;
    }
    return *least;
  };
  const auto best_for_rows = [&](const auto& game) {
    std::optional<Rational> most;
    for (std::size_t c = 0; c < columns; ++c) {
      Rational sum = 0;
      for (std::size_t k = 0; k < rows; ++k) sum += a[k][c] * Rational(game.row_weights()[k]);
      if (!most || sum > *most) most = sum;
    }
    return *most;
  };
  Matrix_game<Rational> game;
  filled(game, rows);
  const Rational value = game.solve();
  require(best_for_columns(game) == value && best_for_rows(game) == value, "mixtures prove the value of a game");
  Matrix_game<double> rounded;
  filled(rounded, rows);
  require(std::fabs(rounded.solve() - value.get_d()) < 1e-8, "doubles come close to the value of a game");
  if (rows > 1) {
    Matrix_game<double> less;
    filled(less, rows - 1);
    less.solve();
    std::vector<double> last;
    for (const Rational& x : a.back()) last.push_back(x.get_d());
    require(std::fabs(less.value_with(last) - value.get_d()) < 1e-8, "one more row is as if it had been there");
  }
  const std::size_t steps = random.below(4);
  const auto ended = [&](auto& early) {
    filled(early, rows);
    std::size_t asked = 0;
    early.end_when([&] { return asked++ >= steps; });
    const Rational bound(early.solve());
    require(bound > value - Rational(1, 100000000), "a game that is ended early promises nobody less");
    require(steps > 0 || bound == 1, "a game of no step promises nothing");
    early.end_when({});
  };
  ended(game);
  ended(rounded);
  if (rows > 1 && steps == 0) {
    Matrix_game<double> none;
    filled(none, rows - 1);
    none.end_when([] { return true; });
    none.solve();
    require(none.value_with(std::vector<double>(columns, 0.0)) == 1, "a game of no step promises nothing of more");
  }
}

/// Mixtures of a basis: what is found solves its equations; nothing is found where there is no time for a value of
/// zero.
inline void try_equations(Random& random) {
  const std::size_t n = 1 + random.below(random.chance(1, 20) ? 20 : 4), other = random.chance(1, 6) ? n + 1 : n;
  std::vector<std::vector<Rational>> a(other, std::vector<Rational>(n));
  for (auto& row : a)
    for (Rational& x : row) x = random.between(-2, 2);
  if (n > 1 && random.chance(1, 3)) a[n - 1] = a[0];  // no single mixture
  std::vector<std::size_t> rows(n), columns(other);
  for (std::size_t k = 0; k < n; ++k) rows[k] = k;
  for (std::size_t k = 0; k < other; ++k) columns[k] = k;
  const bool no_time = random.chance(1, 3);
  std::vector<Rational> weights;
  Rational value;
  const bool found = solve_basis(
      rows, columns, [&](std::size_t row, std::size_t column) { return a[column][row]; }, weights, value,
      [&] { return no_time; });
  // The same by rationals alone.
  std::vector<std::vector<Rational>> square(n + 1, std::vector<Rational>(n + 2));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) square[i][k] = a[i][k];
    square[i][n] = -1;
    square[n][i] = 1;
  }
  square[n][n + 1] = 1;
  std::vector<Rational> right;
  const bool single = solve_equations(square, right);
  if (other != n || n > 16) return require(!found, "what is no basis, or too large a one, is not solved");
  if (!single) return;  // a proposal, which nobody believes
  require(found == (right.back() != 0 || !no_time),
          "a basis is solved iff there is time, or its value is clear of zero");
  if (!found) return;
  Integer wide = 1;
  mpz_mul_2exp(wide.get_mpz_t(), wide.get_mpz_t(), 200);
  const Rational close(1, wide);
  require(weights.size() == n && abs(Rational(value - right.back())) <= close, "the value of a basis");
  for (std::size_t k = 0; k < n; ++k)
    require(abs(Rational(weights[k] - right[k])) <= close, "the mixture of a basis solves its equations");
}

// ---- Moments

/// Moments 0, square roots of sixteenths in intervals, 1; also some that are none. Signs at them and between them are
/// those of f0 + f2 s + f1 sqrt(s).
inline void try_moments(Random& random) {
  std::vector<long> sixteenths{0, 16};
  for (std::size_t k = random.below(4); k > 0; --k) sixteenths.push_back(random.between(1, 15));
  std::sort(sixteenths.begin(), sixteenths.end());
  sixteenths.erase(std::unique(sixteenths.begin(), sixteenths.end()), sixteenths.end());
  std::vector<Path_moment> moments;
  for (const long s : sixteenths) {
    const auto low = static_cast<long>(std::floor(std::sqrt(static_cast<double>(s)) * 4096));
    if (s == 0 || s == 1 || s == 4 || s == 9 || s == 16) {
      const Rational root(static_cast<long>(std::lround(std::sqrt(static_cast<double>(s)))), 4);
      Path_moment at{{}, root, root};
      at.low.canonicalize();
      at.high.canonicalize();
      moments.push_back(at);
    } else {
      Path_moment at{{Rational(-s), 0, 16}, Rational(low, 16384), Rational(low + 1, 16384)};
      at.low.canonicalize();
      at.high.canonicalize();
      moments.push_back(at);
    }
  }
  const auto refused = [&](const std::vector<Path_moment>& all) {
    return is_refused<certificate_check::Rejection>([&] { along_check::Moments{all}; });
  };
  require(!refused(moments), "moments in order are moments");
  std::vector<Path_moment> wrong = moments;
  Path_moment& one = wrong[random.below(wrong.size())];
  switch (random.below(8)) {
    case 0: wrong.front().low = wrong.front().high = Rational(1, 1000); break;  // does not begin at 0
    case 1: wrong.back().low = wrong.back().high = Rational(999, 1000); break;
    case 2: wrong.front().high = Rational(1, 1000); break;  // zero is no quadratic
    case 5: wrong[0] = {{-1, 0, 1}, Rational(1, 2), Rational(3, 2)}; break;
    case 6: wrong.front().low = 1; break;                                                // no range
    case 3: one = {{1, 0, 1}, one.low, Rational(one.low + Rational(1, 100000))}; break;  // no root there
    case 4: one = {{-1, 2, 0}, Rational(0), Rational(1)}; break;                         // no quadratic
    default: std::swap(wrong.front(), wrong.back());
  }
  require(refused(wrong), "what are no moments is refused");

  const along_check::Moments told(moments);
  along_check::Polynomial f;
  for (Integer& x : f) x = random.between(-6, 6);
  if (random.chance(1, 8)) f = {0, 0, 0};
  if (random.chance(1, 4)) f = {4 * f[0] * f[0], 4 * f[0] * f[1], f[1] * f[1]};  // touches zero
  const auto sign_at = [&](std::size_t k) {
    const Rational s = Rational(sixteenths[k]) / 16, fixed = f[0] + f[2] * s;
    const int one_sign = sgn(fixed), root_sign = sixteenths[k] == 0 ? 0 : sgn(f[1]);
    if (root_sign == 0 || one_sign == root_sign) return one_sign != 0 ? one_sign : root_sign;
    if (one_sign == 0) return root_sign;
    const Rational by_root = f[1] * f[1] * s;
    const int order = cmp(Rational(fixed * fixed), by_root);
    return order == 0 ? 0 : order > 0 ? one_sign : root_sign;
  };
  const std::size_t i = random.below(moments.size()), j = i + random.below(moments.size() - i);
  require(told.sign_at(i, f) == sign_at(i), "a sign at a moment");
  int least = std::min(sign_at(i), sign_at(j)), most = std::max(sign_at(i), sign_at(j)), least_inside = 2;
  const auto see = [&](const Rational& t) {
    if (t < 0 || t * t * 16 <= sixteenths[i] || t * t * 16 >= sixteenths[j]) return;
    const int sign = sgn(Rational(f[0] + t * (f[1] + t * f[2])));
    least = std::min(least, sign);
    most = std::max(most, sign);
    least_inside = std::min(least_inside, sign);
  };
  for (long t = 1; t < 64; ++t) see(Rational(t) / 64);
  if (f[2] != 0) see(Rational(-f[1]) / Rational(2 * f[2]));
  require(told.never_negative(i, j, f) == (least >= 0), "what is never negative between two moments");
  if (i == j) {
    require(told.positive(i, i, f) == (sign_at(i) > 0), "what is positive at a moment");
    require(told.sign(i, i, f) == sign_at(i), "the sign at a moment is one");
  } else if (told.positive(i, j, f)) {
    require(least >= 0 && least_inside > 0, "what is positive between two moments");
    require(told.sign(i, j, f) == 1, "what is positive has that sign");
  } else if (f[0] == 0 && f[1] == 0 && f[2] == 0) {
    require(told.sign(i, j, f) == 0, "zero is zero throughout");
  } else {
    require(least < 0 || least_inside <= 0, "what is positive is known to be");
  }
}

// ---- Planes in a table

/// Planes by integers of any length and of machine width are the same ones, reduced; a coordinate's plane is found.
inline void try_plane_table(Random& random) {
  const int bits = random.chance(1, 4) ? 1500 : random.chance(1, 2) ? 60 : 10;
  Plane_table table{Grid_points(bits)};
  const auto drawn = [&] { return static_cast<long>(random.between(-6, 6)) * (random.chance(1, 2) ? 6 : 1); };
  const std::array<long, 4> h{drawn(), drawn(), drawn(), drawn()};
  const auto by_words = [&] { return table.intern(h[0], h[1], h[2], __int128{h[3]}); };
  const auto by_integers = [&] { return table.intern(Integer(h[0]), Integer(h[1]), Integer(h[2]), Integer(h[3])); };
  if (h[0] == 0 && h[1] == 0 && h[2] == 0) {
    require(is_refused<std::domain_error>(by_words) && is_refused<std::domain_error>(by_integers),
            "a plane without a normal is refused");
  } else {
    const Plane plane = by_words(), same = by_integers();
    require(plane.id() == same.id() && plane.flipped() == same.flipped(), "one plane has one name");
    Integer divisor = 0;
    for (const long x : h) divisor = gcd(divisor, Integer(x));
    for (int k = 0; k < 4; ++k)
      require(Integer(table.integer(plane.id(), k) * (plane.flipped() ? -divisor : divisor)) ==
                  h[static_cast<std::size_t>(k)],
              "a plane's coefficients without what they have in common");
  }
  if (bits == 10)
    require(is_refused<std::overflow_error>([&] { table.intern(1, 0, 0, __int128{1} << 100); }),
            "an offset wider than its limbs is refused");
  const int axis = static_cast<int>(random.below(3)), limbs = Grid_points(bits).limbs();
  const Integer at = random.chance(1, 4) ? Integer(0) : Integer(static_cast<long>(random.between(-1000, 1000)));
  std::vector<Limb> coordinate(static_cast<std::size_t>(limbs));
  to_limbs(at, coordinate.data(), limbs);
  const auto across = [&](const Integer& x) { return table.intern(axis == 0, axis == 1, axis == 2, Integer(-x)); };
  const Plane beside = across(at + 1);
  const Plane before = table.find_axis_plane(axis, coordinate.data(), limbs);
  require(!before.valid() || table.integer(before.id(), 3) == -at, "no other plane is taken for a coordinate's");
  const Plane own = across(at);
  const Plane found = table.find_axis_plane(axis, coordinate.data(), limbs);
  require(found.valid() && found.id() == own.id() && !found.flipped() && own.id() != beside.id(),
          "a coordinate's plane is found");
}

// ---- Tables of lines

/// Lines through points of a grid, narrow or wide: one name for each, whatever points and in whatever order, its sense
/// that of the way, canonical coordinates those of the way.
inline void try_line_table(Random& random) {
  const int bits = random.chance(1, 2) ? 20 : 90;
  Grid_points points(bits);
  const auto number = [&]() -> Integer {
    Integer x = static_cast<long>(random.between(-9, 9));
    if (bits > 62 && random.chance(1, 2)) x = x * Integer("1000000000000000000000") + 1;
    return x;
  };
  std::array<Integer, 3> at, way;
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = number();
    way[k] = random.chance(1, 3) ? Integer(0) : number();
  }
  if (way == std::array<Integer, 3>{}) way[random.below(3)] = 1;
  std::vector<std::uint32_t> on;  // 0, 1, 3 and 4 ways from there
  for (const long times : {0, 1, 3, 4}) {
    std::array<Integer, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = at[k] + times * way[k];
    on.push_back(points.intern(p));
  }
  Line_table table(points);
  const std::size_t p = random.below(4), q = (p + 1 + random.below(3)) % 4;
  const sightline::Line one = table.through(on[p], on[q]);
  require(table.through(on[q], on[p]) == sightline::Line{one.id, !one.flipped},
          "a line back is the same, turned round");
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      require(table.through(on[i], on[j]) == sightline::Line{one.id, one.flipped != (p > q)}, "a line has one name");
  require(table.size() == 1, "one line is one");
  require(is_refused<std::domain_error>([&] { table.through(on[p], on[p]); }), "a point has no line");
  std::size_t lead = 0;
  while (way[lead] == 0) ++lead;
  require(sgn(table.integer(one.id, static_cast<int>(lead))) > 0, "a canonical line's first direction is positive");
  require(one.flipped == ((sgn(way[lead]) < 0) != (p > q)), "a line runs against the canonical one iff it does");
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    const auto of = [&](std::size_t place) { return table.integer(one.id, static_cast<int>(place)); };
    require(of(u) * way[v] == of(v) * way[u], "a line has its direction");
    require(of(3 + k) == at[u] * of(v) - at[v] * of(u), "a line has its moment");
  }
}

// ---- Vertices of a CGAL kernel

/// Sides, meets and places by CGAL's filtered kernel are those of rationals; of numbers that doubles hold, or do not.
inline void try_lazy_points(Random& random) {
  using Lazy = Point_traits<CGAL::Epeck>;
  const auto number = [&]() -> Rational {
    return Rational(random.between(-8, 8)) / (random.chance(1, 3) ? 3 : 1) *
           (random.chance(1, 30) ? Rational(Integer("1" + std::string(320, '0'))) : Rational(1));
  };
  Polygon_soup soup;
  for (std::size_t k = 0; k < 3; ++k) soup.add_point(number(), number(), number());
  soup.add_face({0, 1, 2});
  const Scene scene(soup);
  Lazy lazy(scene);
  Predicate_counts counts;
  for (std::uint32_t piece = 0; piece < lazy.piece_count(); ++piece) {
    std::vector<Lazy::Vertex> vertices;
    lazy.append_corners(piece, [&](const Lazy::Vertex& v, Lazy::Edge) { vertices.push_back(v); });
    std::array<Rational, 4> h{number(), number(), number(), number()};
    if (h[0] == 0 && h[1] == 0 && h[2] == 0) h[random.below(3)] = 1;
    const auto value = [&](const Exact_point& p) { return Rational(h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3]); };
    const Plane plane = lazy.add_plane(h);
    std::vector<Sign> sides;
    for (const Lazy::Vertex& v : vertices) {
      const Exact_point p = scene.position(v.input);
      require(lazy.is_input(v) && lazy.position(v) == p, "a corner is where the scene has it");
      sides.push_back(lazy.side(v, lazy.prepare(plane), counts));
      require(static_cast<int>(sides.back()) == sgn(value(p)), "a corner's side is that of rationals");
      require(lazy.side(v, lazy.prepare(plane.opposite()), counts) == -sides.back(),
              "a plane turned round has sides exchanged");
      require(lazy.side(lazy.eye(p), plane, counts) == sides.back(), "an eye's side is that of a corner there");
      for (int axis = 0; axis < 3; ++axis) {
        const std::optional<Plane> across = lazy.axis_plane(axis, v);
        require(across && lazy.side(v, lazy.prepare(*across), counts) == CGAL::ZERO, "a corner's planes hold it");
        require(lazy.same_sense(*across, *across), "a plane has its own sense");
      }
    }
    for (std::size_t a = 0; a < vertices.size(); ++a)
      for (std::size_t b = 0; b < vertices.size(); ++b) {
        if (sides[a] == CGAL::ZERO || sides[a] != -sides[b]) continue;
        const Lazy::Vertex met =
            lazy.meet(piece, {&vertices[a], {}}, {&vertices[b], {}}, sides[a], lazy.prepare(plane));
        const Exact_point p = lazy.position(met), from = scene.position(vertices[a].input),
                          to = scene.position(vertices[b].input);
        require(value(p) == 0 && !lazy.is_input(met) && !lazy.axis_plane(0, met), "an edge meets a plane in it");
        const Rational share = value(from) / Rational(value(from) - value(to));
        const Approximate_point about = lazy.approximate(met);
        for (std::size_t k = 0; k < 3; ++k) {
          require(p[k] == Rational(from[k] + share * (to[k] - from[k])), "where an edge meets a plane");
          require(!std::isfinite(about.error) || abs(Rational(p[k] - exact(k == 0   ? about.x
                                                                           : k == 1 ? about.y
                                                                                    : about.z))) <= exact(about.error),
                  "a point in doubles is within its error");
        }
      }
  }
}

// ---- Faces that are hardly any

/// Faces with holes that are the same, turned round, or others; contours and holes without area. A checker takes a
/// reason iff loops say so.
inline void try_hardly_faces(Random& random) {
  require(certificate_check::same_cycle({}, {}), "nothing is the same as nothing");
  Polygon_soup soup;
  for (const long x : {0, 8, 2, 3, 4}) soup.add_point(Rational(x), Rational(0), Rational(0));
  for (const long x : {8, 0, 2, 3, 2, 4, 5})
    soup.add_point(Rational(x), Rational(x == 0 || x == 8 ? 8 : 3), Rational(0));
  soup.add_point(Rational(3), Rational(4), Rational(0));  // 12
  soup.add_point(Rational(2), Rational(4), Rational(0));  // 13
  soup.add_point(Rational(5), Rational(5), Rational(1));  // 14: above the plane
  const std::vector<Point_id> square{0, 1, 5, 6}, flat{0, 1, 0, 2}, hole{7, 8, 12}, other{7, 12, 13};
  const bool is_flat = random.chance(1, 4);
  const std::vector<Point_id>& outer = is_flat ? flat : square;
  soup.add_face(outer);
  soup.add_hole(hole);
  soup.add_face(outer);
  const std::size_t kind = random.below(4);
  std::vector<Point_id> second = kind == 3 ? other : hole;
  if (kind == 1) std::reverse(second.begin(), second.end());
  if (kind == 2) std::rotate(second.begin(), second.begin() + 1, second.end());
  soup.add_hole(second);
  const auto is_taken = [&](Face_id face, std::string why, const std::set<Face_id>& set_aside = {}) {
    return !is_refused<certificate_check::Rejection>([&] {
      certificate_check::check_set_aside(soup, {face, std::move(why)}, set_aside);
    });
  };
  require(is_taken(1, "duplicate of 0") == (kind != 3), "a face is another one's duplicate iff their loops are");
  require(!is_taken(1, "duplicate of 0", {0, 1}), "a face is no duplicate of one that is set aside");
  require(is_taken(0, "zero area") == is_flat, "a face without a contour's area has none, whatever its holes");

  // Not planar: all in one line but a hole, or simple along no axis, with a hole.
  const auto refused = [&](const std::vector<Point_id>& contour, bool has_hole) {
    Polygon_soup one = soup;
    const Face_id face = one.add_face(contour);
    if (has_hole) one.add_hole({7, 8, 14});
    const certificate_check::Face given(one, face);
    const certificate_check::Skew_face skew(given);
    if (skew.axis()) return false;
    return is_refused<certificate_check::Rejection>([&] { certificate_check::check_surface("a face", given, {}); });
  };
  require(refused(flat, true), "of what has no area nothing is a surface");
  require(refused({0, 5, 1, 6, 14}, random.chance(1, 2)), "what is simple along no axis is no surface of nothing");
}

// ---- Places in an image

/// A direction has its place within the bound that is told, also where the axes of the image are nearly in a plane and
/// of very different lengths.
inline void try_places(Random& random) {
  Pixel_view view{{0, 0, 0}, {}, {}, {}, 1 + static_cast<std::uint32_t>(random.below(200)), 7};
  for (std::array<double, 3>* axis : {&view.look, &view.right, &view.up})
    for (double& x : *axis) x = static_cast<double>(random.between(-1000, 1000)) / 8;
  if (random.chance(3, 4)) generate::flatten(view, random);
  if (random.chance(3, 4)) generate::stretch(view, random);
  const Exact_point look = exact(view.look), right = exact(view.right), up = exact(view.up);
  if (sgn(dot(look, cross(right, up))) == 0) return;
  const image_detail::Pixel_centres centres(view);
  const auto share = [&] { return Rational(static_cast<long>(random.between(-64, 64)), 64l); };
  const Rational across = share(), upwards = random.chance(1, 2) ? Rational(0) : share();
  Exact_point direction;
  Rational most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    direction[k] = look[k] + across * right[k] + upwards * up[k];
    most = std::max(most, Rational(abs(direction[k])));
  }
  if (most == 0) return;
  const long power = -binary_exponent(most);  // a multiple that doubles hold well
  Approximate_vector rounded{};
  double* const entries[] = {&rounded.x, &rounded.y, &rounded.z};
  for (std::size_t k = 0; k < 3; ++k) *entries[k] = nearest_double(times_power(direction[k], power));
  const auto place = centres.place(rounded, 0x1p-52);
  if (!place || !std::isfinite(place->error)) return;
  require(abs(Rational(exact(place->across) - across)) <= exact(place->error) &&
              abs(Rational(exact(place->upwards) - upwards)) <= exact(place->error),
          "a direction's place in an image is off by no more than is told");
}

// ---- Points rounded to numbers

/// A number beside the middle between two neighbouring floats or doubles, or on it; also the smallest and the largest.
template <class Floating>
Rational about_halfway(Random& random) {
  using Limits = std::numeric_limits<Floating>;
  Floating near = std::ldexp(static_cast<Floating>(random.between(1 << 20, 1 << 21)), -20);
  switch (random.below(8)) {
    case 0: near = Limits::max(); break;
    case 1: near = Limits::min(); break;
    case 2: near = static_cast<Floating>(random.below(3)) * Limits::denorm_min(); break;
    case 3: near = std::nextafter(Floating{2}, Floating{0}); break;
    default: near = std::ldexp(near, static_cast<int>(random.between(-9, 9)));
  }
  const Rational half =
      exact(std::ldexp(1.0, std::max(near == 0 ? 0 : std::ilogb(near), Limits::min_exponent - 1) - Limits::digits));
  Rational hair = half;
  mpq_div_2exp(hair.get_mpq_t(), hair.get_mpq_t(), static_cast<mp_bitcnt_t>(random.between(1, 90)));
  const Rational value = exact(near) + half + hair * static_cast<long>(random.between(-1, 1));
  return random.chance(1, 2) ? value : Rational(-value);
}

/// Of a tetrahedron each corner goes to the nearest numbers, or all are refused: there are none.
template <class Floating>
void try_rounding(Random& random) {
  Polygon_soup soup;
  std::vector<Exact_point> corners(4);
  for (Exact_point& p : corners)
    for (Rational& x : p)
      x = random.chance(1, 2) ? about_halfway<Floating>(random) : Rational(static_cast<long>(random.between(-2, 2)));
  const Rational volume =
      dot(minus(corners[1], corners[0]), cross(minus(corners[2], corners[0]), minus(corners[3], corners[0])));
  if (volume == 0) return;
  if (volume < 0) std::swap(corners[2], corners[3]);
  for (const Exact_point& p : corners) soup.add_point(p[0], p[1], p[2]);
  for (const auto& [a, b, c] : {std::array{0u, 2u, 1u}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
    soup.add_face(std::vector<Point_id>{a, b, c});
  std::optional<Rounded_surface> made;
  if (is_refused<std::domain_error>([&] {
        made = rounded(soup, sizeof(Floating) == sizeof(float) ? Rounding::to_float : Rounding::to_double);
      })) {
    bool is_beyond = false;
    for (const Exact_point& p : corners)
      for (const Rational& x : p)
        is_beyond =
            is_beyond ||
            is_nearest(std::copysign(std::numeric_limits<Floating>::infinity(), static_cast<Floating>(sgn(x))), x);
    return require(is_beyond, "only what the numbers do not hold is refused");
  }
  Rational farthest = 0;
  std::set<Point_id> moved;
  for (Face_id f = 0; f < made->soup.face_count(); ++f) {
    const auto now = made->soup.loop(f), before = soup.loop(made->face_of[f]);
    require(now.size() == 3, "a triangle stays one");
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Rational x = made->soup.point(now[k])[axis], then = soup.point(before[k])[axis];
        const auto number = static_cast<Floating>(x.get_d());
        require(exact(number) == x && is_nearest(number, then), "a coordinate goes to the nearest number");
        farthest = std::max(farthest, Rational(abs(x - then)));
        if (x != then) moved.insert(before[k]);
      }
  }
  require(made->moved >= moved.size(), "points that move are counted");
  require(exact(made->farthest) >= farthest, "nothing moves farther than what is said");
}

/// Numbers with denominators of twos and fives, long and short, and others: each is what was pushed.
inline void try_coordinates(Random& random) {
  struct List {
    Coordinates numbers;
    std::vector<Rational> pushed;
    std::size_t narrow = 0;  // at least: numerators of 64 bits
  };
  const auto mantissa = [&] {
    const auto any = static_cast<std::int64_t>(random.below(std::uint64_t{1} << random.below(63)));
    return random.chance(1, 2) ? -any : any;
  };
  const auto push = [&](List& list) {
    const std::int64_t m = mantissa();
    const std::uint64_t kind = random.below(5);
    if (kind < 2) {
      const int exponent = static_cast<int>(random.between(kind == 0 ? -70 : -6, 4));
      list.numbers.push_decimal(m, exponent);
      list.pushed.push_back(exact_decimal(Integer(static_cast<long>(m)), exponent));
    } else if (kind == 2) {
      const double d = std::ldexp(static_cast<double>(m), static_cast<int>(random.between(-140, 30)));
      list.numbers.push_double(d);
      list.pushed.push_back(exact(d));
    } else {
      // The denominator of a decimal of many places, or one that might be taken for it.
      std::int64_t denominator = std::int64_t{1} << random.below(40);
      for (std::uint64_t fives = random.below(9); fives > 0; --fives) denominator *= 5;
      if (random.chance(1, 4)) denominator = 1 + static_cast<std::int64_t>(random.below(1000));
      Rational ratio{Integer(static_cast<long>(m)), Integer(static_cast<long>(denominator))};
      ratio.canonicalize();
      ++list.narrow;
      if (kind == 3) list.numbers.push_ratio(m, denominator);
      else list.numbers.push(ratio);
      list.pushed.push_back(ratio);
    }
  };
  std::array<List, 2> lists;
  for (List& list : lists)
    for (std::size_t k = random.below(24); k > 0; --k) push(list);
  lists[0].numbers.append(lists[1].numbers);
  lists[0].pushed.insert(lists[0].pushed.end(), lists[1].pushed.begin(), lists[1].pushed.end());
  std::size_t counted = 0;
  for (const auto& [denominator, uses] : lists[0].numbers.denominators()) counted += uses;
  require(lists[0].narrow + lists[1].narrow <= counted && counted <= lists[0].pushed.size(),
          "denominators are counted for numerators of 64 bits");
  require(lists[0].numbers.size() == lists[0].pushed.size(), "a list has as many numbers as were pushed");
  Integer common = 1;
  for (std::size_t k = 0; k < lists[0].pushed.size(); ++k) {
    require(lists[0].numbers[k] == lists[0].pushed[k], "a number is what was pushed");
    common = lcm(common, lists[0].pushed[k].get_den());
  }
  require(lists[0].numbers.common_denominator() == common, "a common denominator is the least one");
  const Integer scale = common * static_cast<long>(random.between(1, 9));
  std::size_t told = 0;
  const auto is_scaled = [&](std::size_t k, const Integer& n) {
    require(k == told++ && lists[0].pushed[k] * scale == n, "numbers are told in order, each times the scale");
  };
  lists[0].numbers.for_each_scaled(
      scale, [&](std::size_t k, std::int64_t n) { is_scaled(k, Integer(static_cast<long>(n))); },
      [&](std::size_t k, const Integer& n) { is_scaled(k, n); });
  require(told == lists[0].pushed.size(), "each number is told");
}

inline void single_parts(std::string_view bytes) {
  Bytes from(bytes);
  const std::size_t kind = from.below(12);
  Random random(from.word());
  switch (kind) {
    case 0: return try_ray_boxes(random);
    case 1: return try_games(random);
    case 2: return try_equations(random);
    case 3: return try_moments(random);
    case 4: return try_plane_table(random);
    case 5: return try_lazy_points(random);
    case 6: return try_line_table(random);
    case 7: return try_rounding<float>(random);
    case 8: return try_rounding<double>(random);
    case 9: return try_coordinates(random);
    case 10:
      for (int k = 0; k < 20; ++k) try_places(random);
      return;
    default: return try_hardly_faces(random);
  }
}

}  // namespace fuzz
