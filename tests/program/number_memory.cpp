// The program's memory for numbers of any size: numbers are what they are in it, and threads that hand numbers to
// others do not fill it. This process takes it, too, from its first test on.

#include "../../apps/support/number_memory.h"

#include <sightline/harness/compare/process_memory.h>
#include <sightline/kernel/number.h>

#include "../sample.h"

#include <gtest/gtest.h>

#include <barrier>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace sightline {
namespace {

class Number_memory : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (test_scenes::is_sanitized()) return;
    early_ = Integer("123456789012345678901234567890");  // from malloc, and given back to the lists
    app::keep_numbers_in_small_blocks([] { std::abort(); });
  }
  void SetUp() override {
    if (test_scenes::is_sanitized()) GTEST_SKIP() << "under sanitizers numbers take what malloc gives";
  }
  static std::optional<Integer> early_;
};
std::optional<Integer> Number_memory::early_;

TEST_F(Number_memory, numbers_that_grow_shrink_and_go_are_what_they_are) {
  early_.reset();
  // 2^k - 1 for one k after the other, kept in a crowd in which any may be taken for another one where blocks overlap.
  struct Entry {
    unsigned bits;
    Integer value;
  };
  const auto power = [](unsigned bits) {
    Integer value;
    mpz_setbit(value.get_mpz_t(), bits);
    return Integer(value - 1);
  };
  std::mt19937_64 random(1);
  std::vector<Entry> crowd(1000);
  std::size_t grown = 0;
  for (int turn = 0; turn < 200000; ++turn) {
    Entry& entry = crowd[random() % crowd.size()];
    ASSERT_EQ(mpz_popcount(entry.value.get_mpz_t()), entry.bits);
    ASSERT_EQ(mpz_sizeinbase(entry.value.get_mpz_t(), 2), entry.bits == 0 ? 1 : entry.bits);
    const auto bits = static_cast<unsigned>(random() % 3 == 0 ? random() % 4000 : random() % 200);
    grown += bits > entry.bits;
    if (random() % 2 == 0) {
      mpz_realloc2(entry.value.get_mpz_t(), 1);  // to the least there is; nothing is left of the value
      const Integer value = power(bits);
      mpz_set(entry.value.get_mpz_t(), value.get_mpz_t());  // which grows where it is
    } else {
      entry.value = Integer(power(bits));
    }
    entry.bits = bits;
  }
  EXPECT_GT(grown, 50000u);
}

TEST_F(Number_memory, numbers_made_in_one_thread_and_left_to_another_do_not_fill_it) {
  const std::uint64_t before = process_memory("self", "VmRSS");
  if (before == 0) GTEST_SKIP() << "needs /proc";
  constexpr int rounds = 100, count = 20000;
  std::vector<Integer> numbers;
  std::barrier in_turn(2);
  std::thread maker([&] {
    for (int round = 0; round < rounds; ++round) {
      for (int k = 0; k < count; ++k) numbers.emplace_back(Integer(k + 1) << 200);
      in_turn.arrive_and_wait();  // made
      in_turn.arrive_and_wait();  // gone
    }
  });
  int right = 0;
  for (int round = 0; round < rounds; ++round) {
    in_turn.arrive_and_wait();
    for (int k = 0; k < count; ++k) right += Integer(numbers[static_cast<std::size_t>(k)] >> 200) == k + 1;
    numbers.clear();
    in_turn.arrive_and_wait();
  }
  maker.join();
  EXPECT_EQ(right, rounds * count);
  // A round has 20,000 numbers of 40 bytes and more; 100 rounds would be 80 MB.
  EXPECT_LT(process_memory("self", "VmRSS"), before + (std::size_t{16} << 20));
}

}  // namespace
}  // namespace sightline
