// Sets of subranges by hand, and list and tree against each other with many ranges; fuzz target active_subranges has
// bits as their oracle.

#include <sightline/algorithms/weak_visibility/events/active_subranges.h>

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace {

using namespace sightline;

template <class Key>
using Pairs = std::vector<std::array<Key, 2>>;

template <class Set>
auto pairs(const Set& set) {
  Pairs<double> pairs;
  for (const auto& range : set.ranges()) pairs.push_back({range.low, range.high});
  return pairs;
}

/// The square root of k / n^2.
Quadratic_root root(unsigned long k, unsigned long n) { return {Integer(0), 1, Integer(k), Integer(n)}; }

template <class Set>
class Subranges : public testing::Test {};
using Sets = testing::Types<Subrange_list<double>, Subrange_tree<double>, Active_subranges<double>>;
TYPED_TEST_SUITE(Subranges, Sets);

TYPED_TEST(Subranges, leave_what_is_not_subtracted) {
  TypeParam set(std::vector<Open_range<double>>{{0, 8}});
  set.subtract(3, 4);
  EXPECT_EQ(pairs(set), (Pairs<double>{{0, 3}, {4, 8}}));
  set.subtract(4, 5);  // touches what is gone
  EXPECT_EQ(pairs(set), (Pairs<double>{{0, 3}, {5, 8}}));
  set.subtract(6, 6);  // nothing
  set.subtract(7, 2);
  set.subtract(-3, 0);
  set.subtract(8, 9);
  set.subtract(3, 5);
  EXPECT_EQ(pairs(set), (Pairs<double>{{0, 3}, {5, 8}}));
  set.subtract(-1, 1);  // beyond the ends
  set.subtract(7, 9);
  EXPECT_EQ(pairs(set), (Pairs<double>{{1, 3}, {5, 7}}));
  EXPECT_EQ(set.first().low, 1);
  EXPECT_EQ(set.last().low, 5);
  set.subtract(2, 6);  // across a gap
  EXPECT_EQ(pairs(set), (Pairs<double>{{1, 2}, {6, 7}}));
  set.subtract(1, 2);
  EXPECT_EQ(set.first().high, 7);
  EXPECT_FALSE(set.empty());
  set.subtract(0, 10);
  EXPECT_TRUE(set.empty());
  EXPECT_TRUE(set.ranges().empty());
  set.subtract(0, 10);
  EXPECT_TRUE(set.empty());
}

TEST(Active_subranges, of_many_bars_leave_the_gaps_in_whatever_order) {
  constexpr unsigned long n = 400;  // bar k from the root of 2 k + 1 to that of 2 k + 2
  std::vector<unsigned long> bars(n * n / 2 - 1);
  std::iota(bars.begin(), bars.end(), 0ul);
  std::mt19937_64 random(5);
  for (int turn = 0; turn < 2; ++turn, std::shuffle(bars.begin(), bars.end(), random)) {
    Active_subranges<Quadratic_root> active(Parameter_range{Quadratic_root(0), Quadratic_root(1)});
    for (const unsigned long k : bars) active.subtract(root(2 * k + 1, n), root(2 * k + 2, n));
    const auto left = active.ranges();
    ASSERT_EQ(left.size(), bars.size() + 1);
    for (unsigned long k = 0; k < left.size(); ++k) {
      ASSERT_TRUE(left[k].low == root(2 * k, n)) << k;
      ASSERT_TRUE(left[k].high == (k < bars.size() ? root(2 * k + 1, n) : Quadratic_root(1))) << k;
    }
    active.subtract(root(1, n), root(n * n - 1, n));  // most of a tree at once
    EXPECT_EQ(active.ranges().size(), 2u);
    active.subtract(root(n * n - 2, n), root(n * n, n));
    EXPECT_TRUE(active.last().high == root(1, n));
  }
}

TEST(Active_subranges, of_keys_that_sixty_bits_do_not_tell_apart) {
  // (2^80 + sqrt(k)) / 2^81
  const auto key = [](unsigned long k) { return Quadratic_root(Integer(1) << 80, 1, Integer(k), Integer(1) << 81); };
  Active_subranges<Quadratic_root> active(Parameter_range{Quadratic_root(0), Quadratic_root(1)});
  for (unsigned long k = 1; k < 200; k += 2) active.subtract(key(k), key(k + 1));
  const auto left = active.ranges();
  ASSERT_EQ(left.size(), 101u);
  EXPECT_TRUE(left[7].low == key(14) && left[7].high == key(15));
  active.subtract(key(0), key(200));
  EXPECT_EQ(active.ranges().size(), 2u);
}

TEST(Active_subranges, of_two_sets) {
  using Set = Active_subranges<double>;
  const Set a(std::vector<Open_range<double>>{{0, 2}, {3, 5}, {7, 9}}),
      b(std::vector<Open_range<double>>{{2, 4}, {8, 10}}), none;
  EXPECT_EQ(pairs(merged(a, b)), (Pairs<double>{{0, 5}, {7, 10}}));
  EXPECT_EQ(pairs(common(a, b)), (Pairs<double>{{3, 4}, {8, 9}}));
  EXPECT_EQ(pairs(merged(a, none)), pairs(a));
  EXPECT_TRUE(common(none, b).empty());
}

}  // namespace
