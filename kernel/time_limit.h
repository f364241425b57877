#pragma once
// The clock of all that is timed, and a budget of seconds, which may run out.

#include <chrono>
#include <ctime>
#include <functional>
#include <stdexcept>

namespace sightline {

/// The budget of a question ran out before there was an answer.
struct Out_of_budget : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Seconds since it was made, by a clock that is never set.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Seconds of this process on processors, those of all its threads.
inline double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Whether an option of that kind, which may be empty, says that the time is over.
inline bool has_run_out(const std::function<bool()>& out_of_time) { return out_of_time && out_of_time(); }

/// So many seconds from when it was made; 0: no limit. A copy has the same end.
class Time_limit {
 public:
  explicit Time_limit(double seconds) : seconds_(seconds) {}

  double seconds() const { return seconds_; }  ///< in all
  bool is_over() const { return seconds_ > 0 && watch_.seconds() > seconds_; }
  /// The same for options that ask a function, which may outlive this; empty: no limit.
  std::function<bool()> end() const {
    if (!(seconds_ > 0)) return {};
    return [limit = *this] { return limit.is_over(); };
  }

 private:
  double seconds_;
  Stopwatch watch_;
};

}  // namespace sightline
