#pragma once
// What the tests of comparisons share: exact numbers and points.

#include <sightline/kernel/scene/polygon_soup.h>

#include <gtest/gtest.h>

namespace compare_test {

using namespace sightline;

inline Rational ratio(long p, long q) {
  Rational value(p, static_cast<unsigned long>(q));
  value.canonicalize();
  return value;
}
inline Exact_point at(const Rational& x, const Rational& y, const Rational& z) { return {x, y, z}; }

}  // namespace compare_test
