#pragma once
// Roots of quadratics against intervals so small that different roots cannot share one.

#include "support.h"

#include <sightline/algorithms/weak_visibility/events/active_subranges.h>

namespace fuzz {

/// A root (p + e sqrt(d)) / q of a quadratic, known to be in [low, low + 2] 2^-count.
struct Narrow {
  Integer low;
  bool same(const Narrow& other) const { return abs(low - other.low) <= 4; }
};

/// Roots of two quadratics with coefficients below 2^bits, and the numbers 0 and 1, differ by more than this many
/// binary places can hide: Mahler's bound on the distance of two roots of a polynomial P of degree n <= 6 with integer
/// coefficients is above n^-(n+2)/2 |P|^-(n-1), |P| the length of its coefficients, here below 2^(2 bits + 8).
inline unsigned long places_for(int bits) { return static_cast<unsigned long>(5 * (2 * bits + 8) + 16 + 8); }

/// All real roots, by completing the square with integer square roots of many places.
inline std::vector<Narrow> narrow_roots(const Quadratic& f, unsigned long places) {
  const Integer &c = f.c[0], &b = f.c[1], &a = f.c[2];
  const auto quotient = [&](const Integer& top, const Integer& bottom) {
    Integer k;
    mpz_fdiv_q(k.get_mpz_t(), top.get_mpz_t(), bottom.get_mpz_t());
    return Narrow{k};
  };
  if (sgn(a) == 0) return sgn(b) == 0 ? std::vector<Narrow>{} : std::vector{quotient(Integer(-c) << places, b)};
  const Integer square = b * b - 4 * a * c;
  if (sgn(square) < 0) return {};
  Integer root = square << (2 * places);
  mpz_sqrt(root.get_mpz_t(), root.get_mpz_t());
  std::vector<Narrow> roots{quotient((Integer(-b) << places) - root, 2 * a)};
  if (sgn(square) > 0) roots.push_back(quotient((Integer(-b) << places) + root, 2 * a));
  return roots;
}

/// The sign of value - root; the same to all places counts as equal, which is then so.
inline int compare(const Narrow& a, const Narrow& b) { return a.same(b) ? 0 : cmp(a.low, b.low) < 0 ? -1 : 1; }

inline void quadratic_roots(std::string_view bytes) {
  Bytes from(bytes);
  static constexpr std::array widths{3, 8, 40, 200};
  const int bits = widths[from.below(widths.size())];
  std::array<Quadratic, 2> f;
  for (Quadratic& q : f)
    for (Integer& c : q.c) c = from.integer(bits);
  Quadratic other;  // whose sign is asked, at roots of the two
  for (Integer& c : other.c) c = from.integer(bits);
  if (from.below(4) == 0) {  // of one root in common: (s - k) (a s + b), and times a constant
    const Integer k = f[0].c[0], a = f[0].c[1], b = f[0].c[2], factor = from.integer(3);
    f[0].c = {Integer(-k * b), Integer(b - k * a), a};
    f[1].c = {Integer(factor * f[0].c[0]), Integer(factor * f[0].c[1]), Integer(factor * f[0].c[2])};
    const Integer first = other.c[0], second = other.c[1];
    if (from.below(2) == 0) other.c = {Integer(-k * first), Integer(first - k * second), second};  // of one of them
  }
  int widest = 1;
  for (const Quadratic* q : std::array<const Quadratic*, 3>{&f[0], &f[1], &other})
    for (const Integer& c : q->c) widest = std::max(widest, static_cast<int>(bit_length(c)));
  const unsigned long places = places_for(widest);
  const Narrow zero{0}, one{Integer(1) << places};
  const Parameter_range whole{Quadratic_root(0), Quadratic_root(1)};

  // The roots within (0, 1), each once.
  std::vector<std::pair<Quadratic_root, Narrow>> all;
  for (const Quadratic& q : f) {
    std::vector<Narrow> truth = narrow_roots(q, places);
    std::erase_if(truth, [&](const Narrow& r) { return compare(r, zero) <= 0 || compare(r, one) >= 0; });
    std::sort(truth.begin(), truth.end(), [](const Narrow& a, const Narrow& b) { return a.low < b.low; });
    std::vector<Quadratic_root> found;
    append_roots(q, whole, found);
    std::sort(found.begin(), found.end());
    require(found.size() == truth.size(), "as many roots as there are");
    for (std::size_t k = 0; k < found.size(); ++k) all.emplace_back(found[k], truth[k]);
    if (!q.is_zero() && q.certain_sign() != 0)
      require(q.sign(Rational(1, 3)) != -q.certain_sign() && truth.empty(), "a certain sign is that of all values");
  }

  // Signs there: those beside them, unless there is a root.
  for (const auto& [a, near_a] : all) {
    const std::vector<Narrow> zeros = narrow_roots(other, places);
    const bool is_zero = other.is_zero() || std::any_of(zeros.begin(), zeros.end(),
                                                        [&, &near = near_a](const Narrow& r) { return r.same(near); });
    Rational beside(near_a.low, Integer(1) << places);
    beside.canonicalize();
    require(a.sign_of(other) == (is_zero ? 0 : other.sign(beside)),
            "a polynomial's sign at a root is the one beside it");
  }

  // Comparison, and what is between.
  for (const auto& [a, near_a] : all) {
    require(compare(whole.low, a) < 0 && compare(a, whole.high) < 0, "a root within the range is");
    const unsigned long count = 1 + from.below(64);  // fewer than places
    Integer k = near_a.low;
    k >>= places - count;  // value 2^count is in [k, k + 1]
    require(abs(a.bits(count) - k) <= 2, "bits are those of the root");
    const std::array<Rational, 2> bounds = a.bounds();
    const Quadratic own = a.polynomial();
    const auto is_at = [&](const Rational& s) { return Quadratic_root(s.get_num(), 0, Integer(0), s.get_den()); };
    if (bounds[0] == bounds[1])
      require(a.rational() && *a.rational() == bounds[0] && a == is_at(bounds[0]), "a fraction is its own bounds");
    else
      require(!a.rational() && own.sign(bounds[0]) * own.sign(bounds[1]) < 0 && is_at(bounds[0]) < a &&
                  a < is_at(bounds[1]),
              "a root is within its bounds, and no other one of its polynomial");
    for (const auto& [b, near_b] : all) {
      require(compare(a, b) == compare(near_a, near_b), "roots are compared rightly");
      if (compare(near_a, near_b) >= 0) continue;
      const Rational s = inner_rational({a, b}, from.below(3));
      const Integer scaled = s.get_num() * (Integer(1) << places), &d = s.get_den();
      require((near_a.low - 1) * d < scaled && scaled < (near_b.low + 3) * d, "an inner rational is within its range");
    }
  }
  const std::vector<Parameter_range> parts = divided(whole, f);
  for (const Parameter_range& part : parts) {
    const Rational s = inner_rational(part), t = inner_rational(part, 1);
    for (const Quadratic& q : f)
      require(q.is_zero() || (q.sign(s) == q.sign(t) && q.sign(s) != 0), "no root is within a part");
  }

  // What some signs leave of the range.
  const std::array signs{from.below(2) == 0 ? 1 : -1, from.below(2) == 0 ? 1 : -1};
  const auto holds = [&](const Rational& s) { return f[0].sign(s) == signs[0] && f[1].sign(s) == signs[1]; };
  Active_subranges<Quadratic_root> active(whole);
  subtract_where(active, f, holds);
  const std::vector<Parameter_range> left = active.ranges();
  bool before = false;
  std::size_t runs = 0;
  for (const Parameter_range& part : parts) {
    const Rational s = inner_rational(part);
    const Quadratic_root at(s.get_num(), 0, Integer(0), s.get_den());
    const bool is_left = std::any_of(left.begin(), left.end(),
                                     [&](const Parameter_range& range) { return range.low < at && at < range.high; });
    require(is_left == !holds(s), "what is left is where it does not hold");
    runs += is_left && !before;
    before = is_left;
  }
  require(left.size() == runs, "neighbours are joined");
}

}  // namespace fuzz
