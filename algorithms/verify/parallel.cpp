#include <sightline/algorithms/verify/parallel.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace sightline::certificate_check {

Workers::Workers(const Verify_options& options, std::size_t total) : threads(options.threads) {
  if (options.progress) go_on = [&options, total] { options.progress(0, total); };
}

void for_each_below(std::size_t count, std::size_t enough, const Workers& workers,
                    const std::function<void(std::size_t)>& body) {
  const std::size_t most =
      workers.threads > 0 ? static_cast<std::size_t>(workers.threads) : std::thread::hardware_concurrency();
  const std::size_t threads = std::min(most, count / enough);
  if (threads <= 1) {
    for (std::size_t i = 0; i < count; ++i) {
      workers.ask();
      body(i);
    }
    return;
  }
  std::atomic<std::size_t> next = 0, failed = count;
  std::exception_ptr failure;
  std::mutex mutex, of_asking;
  const auto work = [&] {
    for (std::size_t i = next++; i < failed; i = next++) {
      try {
        if (workers.go_on) {
          const std::lock_guard lock(of_asking);
          workers.ask();
        }
        body(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (i > failed) continue;
        failed = i;
        failure = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t k = 1; k < threads; ++k) others.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace sightline::certificate_check
