// What is written by hand beside a library that has it, each asked what the engine asks: Google Benchmark.
// bench_handmade [--benchmark_filter=...] A row is timed once its answers are known to be right.

#include <sightline/algorithms/weak_visibility/events/active_subranges.h>
#include <sightline/algorithms/weak_visibility/events/event_lines.h>
#include <sightline/algorithms/weak_visibility/events/quadratic_roots.h>
#include <sightline/algorithms/weak_visibility/partition/curve_arrangement.h>
#include <sightline/algorithms/weak_visibility/search/line_cell.h>
#include <sightline/algorithms/weak_visibility/search/matrix_game.h>
#include <sightline/harness/generate/soups.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <CGAL/Arr_conic_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/CORE_algebraic_number_traits.h>
#include <CGAL/Cartesian.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>
#include <CGAL/Gmpzf.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>
#include <CGAL/Root_of_traits.h>
#include <boost/icl/interval_set.hpp>
#include <boost/multiprecision/cpp_int.hpp>

#include <benchmark/benchmark.h>

#include <numeric>
#include <optional>
#include <random>

using namespace sightline;

namespace {

/// Times ask(i) for all i < count in turn, once is_right(i, ask(i)) held for each.
template <class Ask, class Is_right>
void measure(benchmark::State& state, std::size_t count, Ask ask, Is_right is_right) {
  for (std::size_t i = 0; i < count; ++i)
    if (!is_right(i, ask(i))) return state.SkipWithError("a wrong answer");
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(ask(i));
    if (++i == count) i = 0;
  }
}

// ---- Signs of determinants, beside Boost.Multiprecision and GMP

template <unsigned bits>
using Boost_integer = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<bits, bits, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, void>,
    boost::multiprecision::et_off>;

/// As Predicates::side_exact() has it.
template <class Number>
Number value_of_determinant(const std::array<Number, 4>& p, const std::array<Number, 4>& q,
                            const std::array<Number, 4>& r, const std::array<Number, 4>& s) {
  const auto minor = [](const auto& f, const auto& g, std::size_t i, std::size_t j) -> Number {
    return f[i] * g[j] - f[j] * g[i];
  };
  return minor(p, q, 0, 1) * minor(r, s, 2, 3) - minor(p, q, 0, 2) * minor(r, s, 1, 3) +
         minor(p, q, 0, 3) * minor(r, s, 1, 2) + minor(p, q, 1, 2) * minor(r, s, 0, 3) -
         minor(p, q, 1, 3) * minor(r, s, 0, 2) + minor(p, q, 2, 3) * minor(r, s, 0, 1);
}

/// The planes of a soup on a grid of `bits` bits.
template <class Number>
std::vector<std::array<Number, 4>> planes(int bits) {
  const Scene scene(generate::soup(1024, 0.5, 1, bits));
  const Exact_traits traits(scene);
  std::vector<std::array<Number, 4>> rows(traits.piece_count());
  for (std::uint32_t piece = 0; piece < rows.size(); ++piece) {
    const std::array<Integer, 4> h = traits.predicates().coefficients(traits.supporting_plane(piece));
    for (std::size_t k = 0; k < 4; ++k)
      if constexpr (std::is_constructible_v<Number, std::string>) {
        rows[piece][k] = Number(h[k].get_str());
      } else {
        std::array<Limb, Number::bits / 64> limbs;
        to_limbs(h[k], limbs.data(), Number::bits / 64);
        rows[piece][k] = {limbs.data(), Number::bits / 64};
      }
  }
  return rows;
}

template <class Number>
void determinant(benchmark::State& state) {
  const int bits = static_cast<int>(state.range(0));
  const std::vector<std::array<Number, 4>> rows = planes<Number>(bits);
  const std::vector<std::array<Integer, 4>> exact = planes<Integer>(bits);
  const auto sign = [n = rows.size()](const auto& of, std::size_t i) {
    const auto value = value_of_determinant(of[i], of[5 * i % n], of[(7 * i + 1) % n], of[(11 * i + 3) % n]);
    if constexpr (requires { value.sign(); }) return value.sign();
    else return sgn(value);
  };
  measure(
      state, rows.size(), [&](std::size_t i) { return sign(rows, i); },
      [&](std::size_t i, int found) { return found == sign(exact, i); });
}
BENCHMARK(determinant<Fixed_integer<2>>)->Arg(12);
BENCHMARK(determinant<Boost_integer<128>>)->Arg(12);
BENCHMARK(determinant<Integer>)->Arg(12);
BENCHMARK(determinant<Fixed_integer<4>>)->Arg(26);
BENCHMARK(determinant<Boost_integer<256>>)->Arg(26);
BENCHMARK(determinant<Integer>)->Arg(26);
BENCHMARK(determinant<Fixed_integer<8>>)->Arg(30);
BENCHMARK(determinant<Boost_integer<512>>)->Arg(30);
BENCHMARK(determinant<Integer>)->Arg(30);

// ---- Matrix games, beside CGAL's solver of linear programs

struct Game {
  std::size_t rows, columns;
  std::vector<double> values;
};

/// Games as cells of lines between two squares past 200 triangles have them: 5 to 20 rows, one for each line; a column
/// for each pair of vertices (16) or, with the end on one square fixed, for each vertex of the other (4).
std::vector<Game> games(std::size_t columns) {
  const Scene scene(generate::triangles_between_squares(200, 1));
  const Occluders occluders(scene);
  Edge_lines lines(occluders);
  Line_domain domain(std::make_shared<Near_polygon>(occluders.polygon(0)),
                     std::make_shared<Near_polygon>(occluders.polygon(1)));
  std::vector<std::uint32_t> undecided;
  for (std::uint32_t piece = 2; piece < 202; ++piece)
    for (const Edge_lines::Edge& edge : lines.of(piece))
      if (domain.row(lines, edge.line, occluders.frame()).decided == 0) undecided.push_back(edge.line);
  std::mt19937 dice(1);
  std::vector<Game> all(64);
  for (Game& game : all) {
    game = {5 + dice() % 16, columns, {}};
    const bool wrong = dice() % 2 != 0;  // some lines on the wrong side
    std::shuffle(undecided.begin(), undecided.end(), dice);
    for (std::size_t k = 0; k < game.rows; ++k) {
      const Side_row& row = domain.row(lines, undecided[k], occluders.frame());
      const double middle = std::accumulate(row.values.begin(), row.values.end(), 0.0);
      const double sign = (middle > 0) == (wrong && dice() % 3 == 0) ? -1 : 1;
      for (std::size_t c = 0; c < columns; ++c) {
        double value = 0;
        for (std::size_t i = c; i < 16; i += columns) value += row.values[i] / static_cast<double>(16 / columns);
        game.values.push_back(sign * value);
      }
    }
  }
  return all;
}

template <class Number>
void set_up(Matrix_game<Number>& solver, const Game& game) {
  solver.restart(game.columns);
  for (auto from = game.values.begin(); from != game.values.end(); from += static_cast<std::ptrdiff_t>(game.columns))
    std::copy_n(from, game.columns, solver.add_row().begin());
}
int sign_in_rationals(const Game& game) {
  Matrix_game<Rational> solver;
  set_up(solver, game);
  return sgn(solver.solve());
}
/// The sign of a game's value by weights in doubles that prove it; 2 where they do not. Each sum is within 2^-46 of
/// what is added up: fewer than 2^6 terms, two roundings each.
int proven_sign(const Game& game) {
  static Matrix_game<double> solver;
  set_up(solver, game);
  const bool positive = solver.solve() > 0;
  const std::span<const double> weights = positive ? solver.column_weights() : solver.row_weights();
  for (std::size_t s = 0; s < (positive ? game.rows : game.columns); ++s) {
    double sum = 0, size = 0;
    for (std::size_t t = 0; t < weights.size(); ++t) {
      const double v = weights[t] * (positive ? solver.row(s)[t] : -solver.row(t)[s]);
      sum += v;
      size += std::fabs(v);
    }
    if (!(sum > 0x1p-46 * size)) return 2;
  }
  return positive ? 1 : -1;
}
/// The same by CGAL, exactly: the least w + 1 >= 0 such that some mixture of rows is at most w in all columns.
int sign_by_cgal(const Game& game) {
  const int n = static_cast<int>(game.rows), m = static_cast<int>(game.columns);
  CGAL::Quadratic_program<double> program(CGAL::SMALLER, true, 0, false, 0);
  program.set_r(m, CGAL::EQUAL);  // the weights' sum
  program.set_b(m, 1);
  program.set_c(n, 1);
  for (int k = 0; k < n; ++k) {
    for (int c = 0; c < m; ++c) program.set_a(k, c, game.values[static_cast<std::size_t>(k * m + c)]);
    program.set_a(k, m, 1);
  }
  for (int c = 0; c < m; ++c) {
    program.set_a(n, c, -1);
    program.set_b(c, -1);
  }
  const auto value = CGAL::solve_nonnegative_linear_program(program, CGAL::Gmpzf()).objective_value();
  return CGAL::compare(value.numerator(), value.denominator());
}

void game(benchmark::State& state, int (*sign)(const Game&)) {
  const std::vector<Game> all = games(static_cast<std::size_t>(state.range(0)));
  measure(
      state, all.size(), [&](std::size_t i) { return sign(all[i]); },
      [&](std::size_t i, int found) { return found == sign_in_rationals(all[i]); });
}
BENCHMARK_CAPTURE(game, Matrix_game_of_doubles_and_proof, proven_sign)->Arg(4)->Arg(16);
BENCHMARK_CAPTURE(game, Matrix_game_of_rationals, sign_in_rationals)->Arg(4)->Arg(16);
BENCHMARK_CAPTURE(game, CGAL_linear_program, sign_by_cgal)->Arg(4)->Arg(16);

// ---- Roots of quadratics, beside CGAL's

/// Sides of eight lines along a ruled quadric, as searches by events ask for them; 100 to 160 bits.
std::vector<std::vector<Quadratic>> quadratics() {
  const Scene scene(generate::triangles_between_squares(12, 1));
  const Occluders occluders(scene);
  const Event_lines events(occluders, occluders.polygon(0), occluders.plane(0), occluders.polygon(1),
                           occluders.plane(1), 1);
  std::vector<Event_lines::Event_line> edges = events.lines();
  std::erase_if(edges, [](const Event_lines::Event_line& line) { return !line.real; });
  std::mt19937 dice(1);
  const auto edge = [&]() -> const Event_lines::Event_line& { return edges[dice() % edges.size()]; };
  std::vector<std::vector<Quadratic>> all;
  while (all.size() < 256) {
    // As Event_regulus has it.
    const std::array<Filtered, 2>& hull = edge().hull;
    const Homogeneous &first = hull[0].exact, &last = hull[1].exact;
    const Homogeneous step{last[0] - first[0], last[1] - first[1], last[2] - first[2], last[3] - first[3]};
    const Exact_pluecker &b = edge().pluecker, &c = edge().pluecker;
    const Homogeneous b0 = join(first, b), b1 = join(step, b), c0 = join(first, c), c1 = join(step, c);
    const Exact_pluecker l0 = meet(b0, c0), l1 = meet(b0, c1), other = meet(b1, c0), l2 = meet(b1, c1);
    std::vector<Quadratic> set(8);
    bool has_roots = false;
    for (Quadratic& f : set) {
      const Exact_pluecker& line = edge().pluecker;
      f = {{side(l0, line), side(l1, line) + side(other, line), side(l2, line)}};
      has_roots |= !f.is_zero() && f.certain_sign() == 0;
    }
    if (has_roots) all.push_back(std::move(set));
  }
  return all;
}

std::vector<Parameter_range> by_divided(const std::vector<Quadratic>& set) {
  return divided({Quadratic_root(0), Quadratic_root(1)}, set);
}
using Roots = std::vector<CGAL::Root_of_traits<CGAL::Gmpz>::Root_of_2>;
Roots by_root_of_2(const std::vector<Quadratic>& set) {
  Roots roots;
  for (const Quadratic& f : set) {
    if (f.is_zero() || f.certain_sign() != 0) continue;
    const auto c = [&](std::size_t k) { return CGAL::Gmpz(f.c[k].get_mpz_t()); };
    CGAL::compute_roots_of_2(c(2), c(1), c(0), std::back_inserter(roots));
  }
  std::erase_if(roots, [](const auto& root) { return !(CGAL::is_positive(root) && root < CGAL::Gmpq(1)); });
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  return roots;
}
void roots(benchmark::State& state, auto method) {
  const auto all = quadratics();
  const auto are_same = [&](std::size_t i, const auto&) {
    const Roots roots = by_root_of_2(all[i]);
    const std::vector<Parameter_range> parts = by_divided(all[i]);
    const auto inner = [&](std::size_t k) { return CGAL::Gmpq(inner_rational(parts[k]).get_mpq_t()); };
    bool same = parts.size() == roots.size() + 1;
    for (std::size_t k = 0; k < roots.size() && same; ++k) same = inner(k) < roots[k] && roots[k] < inner(k + 1);
    return same;
  };
  const auto ask = [&](std::size_t i) { return method(all[i]); };
  measure(state, all.size(), ask, are_same);
}
BENCHMARK_CAPTURE(roots, Quadratic_root, by_divided);
BENCHMARK_CAPTURE(roots, CGAL_Root_of_2, by_root_of_2);

// ---- Sets of subranges

/// A root that is not rational, or a double, near x.
template <class Key>
Key key_near(double x, std::mt19937_64& random) {
  if constexpr (std::is_same_v<Key, double>) {
    return x;
  } else {
    const unsigned long d = random() % 1000000 + 2;
    return {Integer(x * 0x1p40 - std::sqrt(static_cast<double>(d))), 1, Integer(d), Integer(1) << 40};
  }
}
/// As many bars beside each other, in any order.
template <class Key>
std::vector<Open_range<Key>> bars(std::size_t count) {
  std::mt19937_64 random(7);
  std::vector<std::size_t> places(count);
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::shuffle(places.begin(), places.end(), random);
  std::vector<Open_range<Key>> bars;
  for (const std::size_t place : places) {
    const auto key = [&](double share) {
      return key_near<Key>(0.01 + 0.98 * (static_cast<double>(place) + share) / static_cast<double>(count), random);
    };
    const Key low = key(0.25);
    bars.push_back({low, key(0.75)});
  }
  return bars;
}
std::size_t count_of(const auto& set) { return set.ranges().size(); }
template <class Key>
std::size_t count_of(const boost::icl::interval_set<Key>& set) {
  return set.iterative_size();
}
template <class Key>
void take_away(auto& set, Open_range<Key>& bar) {
  set.subtract(std::move(bar.low), std::move(bar.high));
}
template <class Key>
void take_away(boost::icl::interval_set<Key>& set, Open_range<Key>& bar) {
  set.subtract(boost::icl::interval<Key>::right_open(bar.low, bar.high));
}
/// All of the bars, in turn, of a set that is made for them: what it takes for each is in `each`.
template <class Set, class Key>
void subranges(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const std::vector<Open_range<Key>> all = bars<Key>(count);
  for (auto _ : state) {
    state.PauseTiming();
    std::vector<Open_range<Key>> bars = all;
    state.ResumeTiming();
    std::optional<Set> set;
    if constexpr (std::is_same_v<Set, boost::icl::interval_set<Key>>)
      set.emplace().add(boost::icl::interval<Key>::right_open(Key(0), Key(1)));
    else set.emplace(std::vector<Open_range<Key>>{{Key(0), Key(1)}});
    for (Open_range<Key>& bar : bars) take_away(*set, bar);
    state.PauseTiming();
    if (count_of(*set) != count + 1) state.SkipWithError("a wrong answer");
    set.reset();
    state.ResumeTiming();
  }
  state.counters["each"] = benchmark::Counter(
      static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(subranges<Subrange_list<Quadratic_root>, Quadratic_root>)->RangeMultiplier(10)->Range(10, 100000);
// Each alone, where Active_subranges::most_listed goes from one to the other.
BENCHMARK(subranges<Subrange_list<Quadratic_root>, Quadratic_root>)->RangeMultiplier(2)->Range(1, 256);
BENCHMARK(subranges<Subrange_tree<Quadratic_root>, Quadratic_root>)->RangeMultiplier(2)->Range(1, 256);
BENCHMARK(subranges<Active_subranges<Quadratic_root>, Quadratic_root>)->RangeMultiplier(10)->Range(10, 1000000);
BENCHMARK(subranges<Active_subranges<double>, double>)->RangeMultiplier(10)->Range(10, 1000000);
BENCHMARK(subranges<boost::icl::interval_set<double>, double>)->RangeMultiplier(10)->Range(10, 1000000);

// ---- Arrangements of conics

/// As many ellipses within the unit square, each with an axis at an angle.
std::vector<Plane_curve> ellipses(std::size_t count, std::mt19937_64& random) {
  std::vector<Plane_curve> curves;
  while (curves.size() < count) {
    const auto between = [&](long low, long high) {
      return low + static_cast<long>(random() % static_cast<unsigned long>(high - low + 1));
    };
    // p (1024 x - a)^2 + q (1024 x - a)(1024 y - b) + r (1024 y - b)^2 = w
    const long a = between(384, 640), b = between(384, 640), p = between(500, 1100), q = between(-400, 400),
               r = between(500, 1100), w = between(15000000, 40000000);
    curves.push_back({{p * a * a + q * a * b + r * b * b - w, 1024 * (-2 * p * a - q * b), 1024 * (-2 * r * b - q * a),
                       1048576 * p, 1048576 * q, 1048576 * r}});
  }
  return curves;
}
/// How many parts the places where their order may change divide the square into, from left to right.
std::size_t by_curve_arrangement(const std::vector<Plane_curve>& curves) {
  return Curve_arrangement(curves, {0, 1, 0, 1}).slabs().size();
}
/// The same from its vertices, with the ends of ellipses among them, no two of which have one x.
std::size_t by_arr_conic_traits(const std::vector<Plane_curve>& curves) {
  using Numbers = CGAL::CORE_algebraic_number_traits;
  using Traits =
      CGAL::Arr_conic_traits_2<CGAL::Cartesian<Numbers::Rational>, CGAL::Cartesian<Numbers::Algebraic>, Numbers>;
  std::vector<Traits::Curve_2> conics;
  for (const Plane_curve& curve : curves) {
    const auto c = [&](std::size_t k) { return Numbers::Rational(curve.c[k].get_si()); };
    conics.emplace_back(c(3), c(5), c(4), c(1), c(2), c(0));
  }
  const Traits traits;
  CGAL::Arrangement_2<Traits> arrangement(&traits);
  CGAL::insert(arrangement, conics.begin(), conics.end());
  return arrangement.number_of_vertices() + 1;
}
void conics(benchmark::State& state, auto method) {
  std::mt19937_64 random(5);
  std::vector<std::vector<Plane_curve>> all;
  while (all.size() < 8) all.push_back(ellipses(static_cast<std::size_t>(state.range(0)), random));
  measure(
      state, all.size(), [&](std::size_t i) { return method(all[i]); },
      [&](std::size_t i, std::size_t parts) {
        return parts == by_curve_arrangement(all[i]) && parts == by_arr_conic_traits(all[i]);
      });
}
BENCHMARK_CAPTURE(conics, Curve_arrangement, by_curve_arrangement)->Arg(2)->Arg(4)->Arg(8);
BENCHMARK_CAPTURE(conics, CGAL_Arr_conic_traits_2, by_arr_conic_traits)->Arg(2)->Arg(4)->Arg(8);

}  // namespace

BENCHMARK_MAIN();
