#include "waiting.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace sightline::python {

void wait_for(const Question& question, const std::function<void(const Asking&)>& work) {
  struct Given_up {};
  std::atomic<bool> given_up = false;
  std::atomic<std::size_t> done = 0, all = 0;
  Asking asking{question.threads, {}, question.budget, question.two_sided};
  asking.progress = [&](std::size_t so_far, std::size_t of_all) {
    if (given_up) throw Given_up();
    done = so_far;
    all = of_all;
  };

  std::exception_ptr raised, thrown;  // by Python, by the work
  {
    const py::gil_scoped_release released;
    std::mutex mutex;
    std::condition_variable end;
    bool ended = false;
    std::thread worker([&] {
      try {
        work(asking);
      } catch (const Given_up&) {
      } catch (...) {
        thrown = std::current_exception();
      }
      const std::lock_guard lock(mutex);
      ended = true;
      end.notify_one();
    });
    std::unique_lock lock(mutex);
    while (!end.wait_for(lock, std::chrono::milliseconds(50), [&] { return ended; })) {
      if (given_up) continue;
      lock.unlock();
      {
        const py::gil_scoped_acquire acquired;
        try {
          if (PyErr_CheckSignals() != 0) throw py::error_already_set();
          if (!question.progress.is_none() && all > 0) question.progress(done.load(), all.load());
        } catch (...) {
          raised = std::current_exception();
          given_up = true;
        }
      }
      lock.lock();
    }
    lock.unlock();
    worker.join();
  }
  if (raised) std::rethrow_exception(raised);
  if (thrown) std::rethrow_exception(thrown);
  if (!question.progress.is_none()) question.progress(all.load(), all.load());
}

}  // namespace sightline::python
