// Watching the case that is being run.

#include "case_watch.h"

#include "../support/files.h"
#include "../support/options.h"

#include <fmt/format.h>

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
#endif

namespace sightline::app {

namespace {

// Lines for signal handlers, which can only write what is there. Empty: there is no case.
char line_of_crash[1400], line_of_delay[1400];

void set_line(char (&line)[1400], const std::string& text) {
  const std::size_t length = std::min(text.size(), sizeof line - 2);
  std::memcpy(line, text.data(), length);
  line[length] = '\n';
  line[length + 1] = 0;
}
void tell(const char* line) { [[maybe_unused]] const ssize_t written = write(2, line, std::strlen(line)); }
void tell_of_crash() { tell(line_of_crash); }

/// By the processor's time of this process: a machine that has much else to do is no finding.
void set_alarm(double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = std::min<suseconds_t>(
      999999, static_cast<suseconds_t>(std::ceil(1e6 * (seconds - std::floor(seconds)))));  // all 0 would be no alarm
  setitimer(ITIMER_PROF, &timer, nullptr);
}

extern "C" void end_by_signal(int number) {
  tell_of_crash();
  remove_unfinished();
  std::signal(number, SIG_DFL);
  std::raise(number);
}
extern "C" void end_by_alarm(int) {
  tell(line_of_delay);
  _exit(static_cast<int>(Exit::disagreement));
}

}  // namespace

void watch_for_crashes() {
  for (const int number : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGTERM, SIGINT})
    std::signal(number, end_by_signal);
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_set_death_callback(tell_of_crash);
#endif
}

void begin_case(const std::string& replay, double seconds, const std::string& doing) {
  set_alarm(0);
  set_line(line_of_crash, fmt::format("sightline fuzz: ended {}: {}", doing, replay));
  set_line(line_of_delay,
           fmt::format("sightline fuzz: no end within {} s of processor time {}: {}", seconds, doing, replay));
  std::signal(SIGPROF, end_by_alarm);
  set_alarm(std::min(std::max(seconds, 1e-6), 1e8));
}

void end_case() {
  set_alarm(0);
  line_of_crash[0] = 0;
}

}  // namespace sightline::app
