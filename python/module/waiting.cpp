#include "waiting.h"

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <thread>

namespace sightline::python {

namespace {

struct Given_up {};

/// What a worker and the thread that asked have in common.
struct Running {
  Asking asking;
  std::function<void(const Asking&)> work;
  std::atomic<bool> given_up = false;
  std::atomic<std::size_t> done = 0, all = 0;
  std::exception_ptr thrown;
  std::mutex mutex;
  std::condition_variable end;
  bool ended = false;
};

std::atomic<int> workers = 0;                                                             // that have not ended
const int forgotten_by_children = pthread_atfork(nullptr, nullptr, [] { workers = 0; });  // which have no such threads

void run(const std::shared_ptr<Running>& running) {
  try {
    running->work(running->asking);
  } catch (const Given_up&) {
  } catch (...) {
    running->thrown = std::current_exception();
  }
  running->work = nullptr;
  {
    const std::lock_guard lock(running->mutex);
    running->ended = true;
  }
  running->end.notify_one();
}

}  // namespace

void wait_for(const Question& question, std::function<void(const Asking&)> work) {
  const auto running = std::make_shared<Running>();
  running->work = std::move(work);
  running->asking = {question.threads, {}, question.budget, question.two_sided};
  running->asking.progress = [state = running.get()](std::size_t done, std::size_t all) {
    if (state->given_up) throw Given_up();
    state->done = done;
    state->all = all;
  };

  std::exception_ptr raised;  // by Python
  {
    const py::gil_scoped_release released;
    std::thread(
        [](std::shared_ptr<Running> own) {
          run(own);
          own.reset();
          --workers;
        },
        running)
        .detach();
    ++workers;
    std::unique_lock lock(running->mutex);
    const auto has_ended = [&] { return running->ended; };
    while (!raised && !running->end.wait_for(lock, std::chrono::milliseconds(50), has_ended)) {
      lock.unlock();
      {
        const py::gil_scoped_acquire acquired;
        try {
          if (PyErr_CheckSignals() != 0) throw py::error_already_set();
          if (!question.progress.is_none() && running->all > 0)
            question.progress(running->done.load(), running->all.load());
        } catch (...) {
          raised = std::current_exception();
          running->given_up = true;
        }
      }
      lock.lock();
    }
    if (raised) running->end.wait_for(lock, std::chrono::milliseconds(100), has_ended);
  }
  if (raised) std::rethrow_exception(raised);
  if (running->thrown) std::rethrow_exception(running->thrown);
  if (!question.progress.is_none()) question.progress(running->all.load(), running->all.load());
}

void wait_for_what_was_left() {
  while (workers > 0) {
    {
      const py::gil_scoped_release released;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    if (PyErr_CheckSignals() == 0) continue;
    std::fflush(nullptr);
    std::_Exit(130);  // as a shell says it of SIGINT; to end in order takes the workers' end
  }
}

}  // namespace sightline::python
