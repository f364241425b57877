// Budgets: what has no limit never ends, and what has one ends once.

#include <sightline/kernel/time_limit.h>

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <limits>
#include <thread>

namespace sightline {
namespace {

void wait(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

TEST(Time_limits, No_seconds_and_what_is_no_number_are_no_limit) {
  for (const double none : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const Time_limit limit(none);
    wait(1);
    EXPECT_FALSE(limit.is_over()) << none;
    EXPECT_FALSE(limit.end()) << none << ": a function that is there would be asked";
  }
}

TEST(Time_limits, One_is_over_after_its_seconds_and_stays_so) {
  const Time_limit hasty(1e-3), patient(3600);
  EXPECT_FALSE(patient.is_over());
  EXPECT_EQ(patient.seconds(), 3600);
  wait(3);
  EXPECT_TRUE(hasty.is_over());
  EXPECT_TRUE(hasty.is_over());
  EXPECT_FALSE(patient.is_over());
}

TEST(Time_limits, A_copy_and_a_function_of_it_end_when_it_ends_not_when_they_were_made) {
  const Time_limit limit(5e-3);
  wait(10);
  const Time_limit copy = limit;
  EXPECT_TRUE(copy.is_over());
  std::function<bool()> end;
  {
    const Time_limit gone = limit;
    end = gone.end();
  }
  ASSERT_TRUE(end);
  EXPECT_TRUE(end());
  EXPECT_FALSE(Time_limit(3600).end()());
}

TEST(Time_limits, A_stopwatch_starts_anew_when_it_is_assigned) {
  Stopwatch watch;
  wait(20);
  const double before = watch.seconds();
  EXPECT_GE(before, 0.02);
  watch = {};
  EXPECT_LT(watch.seconds(), before);
}

}  // namespace
}  // namespace sightline
