#pragma once
// A question asked from Python: the interpreter goes on, Ctrl-C ends it, and progress is told in the thread that asked.

#include <sightline/sightline.h>

#include <pybind11/pybind11.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace sightline::python {

namespace py = pybind11;

/// What every question takes besides: threads, progress (a callable of two numbers, or None), budget.
struct Question {
  int threads = 0;
  py::object progress;
  double budget = 0;
  bool two_sided = false;
};
/// One that nobody says anything about.
inline Question plain_question() { return {0, py::none(), 0, false}; }

/// Does the work in a thread of its own, the GIL released. Twenty times a second the thread that asked sees whether
/// there are signals, and calls progress(done, all); what they raise (KeyboardInterrupt) comes out of here. It ends the
/// work by its own progress, for which nobody waits: where that takes longer than a moment, the thread is left to come
/// to its end alone. Errors: what the work throws. Pre: the GIL is held; the work touches no Python, and all that it
/// refers to is its own.
void wait_for(const Question& question, std::function<void(const Asking&)> work);

/// Waits for work that was left to come to its end alone, for the end of the interpreter; a second Ctrl-C ends the
/// process.
void wait_for_what_was_left();

/// What `work`, which is called with an Asking, returns. Pre: as wait_for(): it captures values, never references.
template <class Work>
auto answer_to(const Question& question, Work work) {
  struct Asked {
    Work work;
    std::optional<decltype(work(Asking()))> answer;
  };
  const auto asked = std::make_shared<Asked>(Asked{std::move(work), {}});
  wait_for(question, [asked](const Asking& asking) { asked->answer.emplace(asked->work(asking)); });
  return std::move(*asked->answer);
}

}  // namespace sightline::python
