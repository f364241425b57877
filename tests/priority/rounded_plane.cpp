// Planes through a viewpoint in doubles, where doubles end: against rationals.

#include <sightline/algorithms/priority/rounded_plane.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace sightline;
using priority_detail::Rounded_plane;

Exact_point exactly(const Triple& v) { return {exact(v[0]), exact(v[1]), exact(v[2])}; }

TEST(Rounded_plane, tells_no_wrong_side_of_vectors_of_all_exponents) {
  generate::Random random(1);
  std::size_t told = 0;
  for (int k = 0; k < 20000; ++k) {
    std::array<Exact_point, 3> exact_vectors;
    std::array<Triple, 3> vectors{};
    for (std::size_t v = 0; v < 3; ++v) {
      const int power = static_cast<int>(random.between(-1100, 1020));
      for (std::size_t x = 0; x < 3; ++x) {
        Rational size(static_cast<long>(random.between(-1000, 1000)), 3);
        const int own = random.chance(1, 2) ? power : static_cast<int>(random.between(-1100, 1000));
        if (own < 0) mpq_div_2exp(size.get_mpq_t(), size.get_mpq_t(), static_cast<mp_bitcnt_t>(-own));
        else mpq_mul_2exp(size.get_mpq_t(), size.get_mpq_t(), static_cast<mp_bitcnt_t>(own));
        exact_vectors[v][x] = size;
        vectors[v][x] = nearest_double(size);
      }
    }
    const int side = Rounded_plane(vectors[0], vectors[1]).side(vectors[2]);
    if (side == 0) continue;
    ++told;
    ASSERT_EQ(side, sgn(dot(cross(exact_vectors[0], exact_vectors[1]), exact_vectors[2]))) << k;
  }
  EXPECT_GT(told, 1000u);
}

TEST(Rounded_plane, tells_nothing_of_a_vector_lost_to_underflow_that_a_long_one_brings_back) {
  // a's first entry, 2^-1076, is lost; times 2^1000 and 2^10 it outweighs 2^-1074 times 2^1000.
  const Exact_point a{Rational(Integer(1), Integer(Integer(1) << 1076)), 1, 0};
  const Triple rounded{nearest_double(a[0]), 1, 0}, b{0, 0, 0x1p1000}, d{0x1p-1074, 0x1p10, 0};
  EXPECT_EQ(rounded[0], 0);
  EXPECT_LT(sgn(dot(cross(a, exactly(b)), exactly(d))), 0);
  EXPECT_EQ(Rounded_plane(rounded, b).side(d), 0);
}

}  // namespace
