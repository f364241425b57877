#pragma once
// Hand-made scenes and orders for the tests of the checker.

#include <gtest/gtest.h>

#include <sightline/algorithms/verify/order.h>

#include <random>

namespace verify_test {

using namespace sightline;
using Points = std::vector<Exact_point>;

inline Exact_point at(const Rational& x, const Rational& y, const Rational& z) { return {x, y, z}; }
inline Rational ratio(long p, long q) {
  Rational value(p, static_cast<unsigned long>(q));
  value.canonicalize();
  return value;
}
/// 2^-bits
inline Rational tiny(unsigned bits) {
  Integer denominator = 1;
  denominator <<= bits;
  return Rational(Integer(1), denominator);
}
inline Points reversed(Points points) {
  std::reverse(points.begin(), points.end());
  return points;
}
using Dice = std::mt19937;
inline long roll(Dice& dice, long least, long most) {
  return least + static_cast<long>(dice() % static_cast<unsigned long>(most - least + 1));
}
/// The rectangle [x0, x1] x [y0, y1] at height z, front up.
inline Points rectangle(const Rational& x0, const Rational& x1, const Rational& y0, const Rational& y1,
                        const Rational& z) {
  return {at(x0, y0, z), at(x1, y0, z), at(x1, y1, z), at(x0, y1, z)};
}

struct Scene {
  Polygon_soup soup;
  Order_certificate certificate;

  std::vector<Point_id> ids(const Points& loop) {
    std::vector<Point_id> result;
    for (const Exact_point& p : loop) result.push_back(soup.add_point(p[0], p[1], p[2]));
    return result;
  }
  Face_id face(const Points& outer, const std::vector<Points>& holes = {}) {
    const Face_id f = soup.add_face(ids(outer));
    for (const Points& hole : holes) soup.add_hole(ids(hole));
    return f;
  }
  /// Draws a fragment, nearer than all before.
  Scene& draw(Face_id f, const Points& polygon, std::uint32_t piece = 0) {
    certificate.fragments.push_back({f, piece, polygon});
    return *this;
  }
  Scene& cut(Face_id f, std::uint32_t piece, const Points& polygon) {
    certificate.pieces.push_back({f, piece, polygon});
    return *this;
  }
  Scene& leave_out(Face_id f, const std::string& why) {
    certificate.set_aside.push_back({f, why});
    return *this;
  }
  Scene& seen_from(const Exact_point& eye) {
    certificate.eye = eye;
    return *this;
  }
  Verdict verdict() const { return verify_order(soup, certificate); }
};

inline void expect_accepted(const Scene& scene) {
  const Verdict verdict = scene.verdict();
  EXPECT_TRUE(verdict.accepted) << verdict.why;
  EXPECT_TRUE(verdict.fragments.empty());
}
inline void expect_rejected(const Scene& scene, const std::string& words,
                            const std::vector<std::size_t>& fragments = {}) {
  const Verdict verdict = scene.verdict();
  EXPECT_FALSE(verdict.accepted) << verdict.why;
  EXPECT_NE(verdict.why.find(words), std::string::npos) << verdict.why;
  EXPECT_EQ(verdict.why.find('\n'), std::string::npos);
  EXPECT_EQ(verdict.fragments, fragments) << verdict.why;
}

}  // namespace verify_test
