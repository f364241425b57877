#pragma once
// Real roots of polynomials of one unknown with integer coefficients: isolated, refined, compared exactly.

#include <sightline/kernel/number.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace sightline {

/// c[0] + c[1] x + c[2] x^2 + ...
using Polynomial = std::vector<Integer>;

/// A root of a polynomial: the only one strictly between two rationals, or a rational itself. Copies share the
/// polynomial. Exact: yes. Proof: P-86
class Real_root {
 public:
  explicit Real_root(Rational exact) : low_(exact), high_(std::move(exact)) {}
  /// Pre: f has one root strictly between low and high, where it changes from the sign `from`, and is square-free.
  Real_root(std::shared_ptr<const Polynomial> f, Rational low, Rational high, int from)
      : f_(std::move(f)), low_(std::move(low)), high_(std::move(high)), from_(from) {}

  bool is_rational() const { return f_ == nullptr; }  ///< where it is known to be: low() == high() is it
  const Rational& low() const { return low_; }
  const Rational& high() const { return high_; }
  /// Halves the interval.
  void refine();
  /// Until the interval is no longer than 2^-bits.
  void refine_to(unsigned long bits);

  /// -1, 0, 1. Refines both until they are apart or known to be equal. Cost: a greatest common divisor where they are
  /// equal or very near.
  friend int compare(Real_root& a, Real_root& b);

 private:
  std::shared_ptr<const Polynomial> f_;  // none: low_ is the number
  Rational low_, high_;
  int from_ = 0;
};

/// Appends the roots strictly between low and high, in order, each once. Degenerate: the zero polynomial has none. Pre:
/// low < high, dyadic. Cost: bisections by Descartes' rule of signs. Exact: yes
void append_real_roots(Polynomial f, const Rational& low, const Rational& high, std::vector<Real_root>& roots);

/// In order, each once. Returns false, and leaves them in any order, where time ran out.
bool sort_distinct(std::vector<Real_root>& roots, const std::function<bool()>& out_of_time = {});

/// A dyadic rational strictly between two different numbers, a < b, of few bits.
Rational between(Real_root& a, Real_root& b);

}  // namespace sightline
