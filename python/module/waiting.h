#pragma once
// A question asked from Python: the interpreter goes on, Ctrl-C ends it, and progress is told in the thread that asked.

#include <sightline/sightline.h>

#include <pybind11/pybind11.h>

#include <cstddef>
#include <functional>
#include <optional>

namespace sightline::python {

namespace py = pybind11;

/// What every question takes besides: threads, progress (a callable of two numbers, or None), budget.
struct Question {
  int threads = 0;
  py::object progress;
  double budget = 0;
  bool two_sided = false;
};

/// Does the work in a thread of its own, the GIL released. Twenty times a second the thread that asked sees whether
/// there are signals, and calls progress(done, all); what they raise (KeyboardInterrupt) ends the work, by its own
/// progress, and comes out of here. Errors: what the work throws. Pre: the GIL is held; the work touches no Python.
void wait_for(const Question& question, const std::function<void(const Asking&)>& work);

template <class Work>
auto answer_to(const Question& question, Work work) {
  std::optional<decltype(work(Asking()))> answer;
  wait_for(question, [&](const Asking& asking) { answer.emplace(work(asking)); });
  return std::move(*answer);
}

}  // namespace sightline::python
