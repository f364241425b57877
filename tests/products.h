#pragma once
// Sums of products of rational numbers for oracles, reduced once: Rational reduces after each multiplication and each
// addition, which took most of their time.

#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>

namespace test_scenes {

using Vector = std::array<sightline::Rational, 3>;

class Sum_of_products {
 public:
  void add(const sightline::Rational& a, const sightline::Rational& b) { accumulate(a, b, mpz_add); }
  void subtract(const sightline::Rational& a, const sightline::Rational& b) { accumulate(a, b, mpz_sub); }
  sightline::Rational value() const {
    sightline::Rational result(numerator_, denominator_);
    if (mpz_cmp_ui(denominator_.get_mpz_t(), 1) != 0) result.canonicalize();
    return result;
  }

 private:
  template <class Operation>
  void accumulate(const sightline::Rational& a, const sightline::Rational& b, Operation operation) {
    if (sgn(a) == 0 || sgn(b) == 0) return;
    mpz_mul(product_.get_mpz_t(), a.get_num_mpz_t(), b.get_num_mpz_t());
    mpz_mul(below_.get_mpz_t(), a.get_den_mpz_t(), b.get_den_mpz_t());
    if (mpz_cmp(below_.get_mpz_t(), denominator_.get_mpz_t()) != 0) {
      mpz_mul(numerator_.get_mpz_t(), numerator_.get_mpz_t(), below_.get_mpz_t());
      mpz_mul(product_.get_mpz_t(), product_.get_mpz_t(), denominator_.get_mpz_t());
      mpz_mul(denominator_.get_mpz_t(), denominator_.get_mpz_t(), below_.get_mpz_t());
    }
    operation(numerator_.get_mpz_t(), numerator_.get_mpz_t(), product_.get_mpz_t());
  }

  sightline::Integer numerator_ = 0, denominator_ = 1, product_, below_;
};

/// a[0] b[0] + a[1] b[1] + a[2] b[2]
inline sightline::Rational dot(const Vector& a, const Vector& b) {
  Sum_of_products sum;
  for (std::size_t k = 0; k < 3; ++k) sum.add(a[k], b[k]);
  return sum.value();
}

/// The cross product of two vectors.
inline Vector cross(const Vector& a, const Vector& b) {
  Vector result;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    Sum_of_products sum;
    sum.add(a[i], b[j]);
    sum.subtract(a[j], b[i]);
    result[k] = sum.value();
  }
  return result;
}

}  // namespace test_scenes
