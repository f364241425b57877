#include <sightline/harness/compare/process_memory.h>
#include <sightline/kernel/threads.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>

namespace sightline {
namespace {

/// Gives up outer work of 64 parts on the way, each of which calls `inner` with what counts; returns how often that
/// went on though not all it had begun was counted.
std::size_t unfinished(std::size_t expected, const std::function<void(const std::function<void()>& count)>& inner) {
  std::atomic<std::size_t> bad{0};
  constexpr int rounds = 100;
  for (int round = 0; round < rounds; ++round) {
    std::atomic<int> begun{0};
    EXPECT_THROW(run_with_threads(4,
                                  [&] {
                                    parallel_for(64, [&](std::size_t) {
                                      if (++begun > 8 + round % 8) throw std::domain_error("enough");
                                      std::atomic<std::size_t> counted{0};
                                      inner([&] {
                                        for (volatile int spin = 0; spin < 10000;) spin = spin + 1;  // time to give up
                                        ++counted;
                                      });
                                      if (counted != expected) ++bad;
                                    });
                                  }),
                 std::domain_error);
  }
  return bad;
}

TEST(Threads, work_within_work_that_is_given_up_never_goes_on_as_if_it_were_done) {
  EXPECT_EQ(unfinished(16, [](const auto& count) { parallel_for(16, [&](std::size_t) { count(); }); }), 0u);
  EXPECT_EQ(unfinished(2, [](const auto& count) { parallel_invoke(count, count); }), 0u);
  EXPECT_EQ(unfinished(9,
                       [](const auto& count) {
                         Task_group group;
                         group.run_and_wait([&] {
                           for (int k = 0; k < 8; ++k) group.run(count);
                           count();
                         });
                       }),
            0u);
}

TEST(Threads, what_a_part_throws_comes_out_at_any_depth) {
  const auto deep = [] {
    parallel_invoke(
        [] {
          parallel_for(4, [](std::size_t i) {
            if (i == 3) throw std::range_error("deep");
          });
        },
        [] {});
  };
  for (const int threads : {1, 2, 4}) EXPECT_THROW(run_with_threads(threads, deep), std::range_error);
}

TEST(Threads, to_ask_for_threads_again_and_again_takes_no_memory) {
  const auto ask = [](int times) {
    for (int time = 0; time < times; ++time)
      run_with_threads(2, [] {
        parallel_for(64, [](std::size_t) {
          for (volatile int spin = 0; spin < 500;) spin = spin + 1;  // time for the other thread to come
        });
      });
  };
  ask(200);
  const std::uint64_t before = process_memory("self", "VmRSS");
  if (before == 0) GTEST_SKIP() << "needs /proc";
  ask(3000);
  // oneTBB 2021.8 keeps 7 kB of each arena that two threads were in, which would be 20 MB.
  EXPECT_LT(process_memory("self", "VmRSS"), before + (std::size_t{4} << 20));
}

TEST(Threads, of_any_number_are_there_at_once_and_within_each_other) {
  std::atomic<int> done{0};
  run_with_threads(3, [&] {
    parallel_for(200, [&](std::size_t i) {
      run_with_threads(1 + static_cast<int>(i % 4), [&] { parallel_for(4, [&](std::size_t) { ++done; }); });
    });
  });
  EXPECT_EQ(done, 800);
}

}  // namespace
}  // namespace sightline
