#pragma once
// Moments of a path, which are roots of quadratics, and the signs of quadratics at them and between them: rationals and
// integers only. To be read before along.cpp.

#include <sightline/algorithms/verify/polygons.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace sightline {

/// The root of polynomial[0] + polynomial[1] t + polynomial[2] t^2 in [low, high], where there is no other. Of a
/// fraction both ends are it, and there is no polynomial but zero.
struct Path_moment {
  std::array<Rational, 3> polynomial;
  Rational low, high;
};

namespace along_check {

/// c[0] + c[1] t + c[2] t^2
using Polynomial = certificate_check::Integer_vector;

/// Moments in order, each before the next. It refers to them.
class Moments {
 public:
  /// Rejects unless they are in order, each one root that is told apart, from 0 to 1.
  explicit Moments(const std::vector<Path_moment>& moments);

  std::size_t size() const { return moments_.size(); }
  /// 1: moment k is after t, 0: it is t, -1: it is before.
  int compare(std::size_t k, const Rational& t) const;
  int sign_at(std::size_t k, const Polynomial& f) const;
  /// Whether it is >= 0 at moment i, or, if i < j, at all t between moments i and j. Proof: P-127a
  bool never_negative(std::size_t i, std::size_t j, const Polynomial& f) const;
  /// The same for > 0.
  bool positive(std::size_t i, std::size_t j, const Polynomial& f) const;
  /// The sign that it has at moment i, or throughout between moments i and j; nothing where it has no one sign.
  std::optional<int> sign(std::size_t i, std::size_t j, const Polynomial& f) const;

 private:
  /// Whether f is least or greatest between two moments.
  bool has_extreme(std::size_t i, std::size_t j, const Polynomial& f) const;

  const std::vector<Path_moment>& moments_;
};

}  // namespace along_check

}  // namespace sightline
