#pragma once
// Questions with a budget: what `see` and `weak` do of them, held to the time they had and to their answers without
// one.

#include <sightline/harness/laws/subject.h>

#include <cstdint>
#include <string>

namespace sightline::harness {

/// A budget in processor time of this process, so that a machine that does other work too is no reason to fail: 1 to 20
/// milliseconds, which is over earlier where it has been asked after a number of times that is drawn too. So scenes
/// that take no millisecond run out of it as well, always at the same place.
class Budget {
 public:
  explicit Budget(Random& random);
  void begin();  ///< once the scene is ready: a budget is for a question

  /// To be asked by what has the budget. Once over, it stays so.
  bool over();

  bool was_over() const { return over_; }
  /// What is wrong where the answer is there only now: it took more than the budget, a tenth of it, and 50 ms (under
  /// sanitizers ten times as much); empty: nothing.
  std::string overdrawn() const;

 private:
  double begin_ = 0, seconds_;  // once it is over by being asked, seconds_ is what had been spent then
  std::uint64_t asks_left_;
  bool over_ = false;
};

/// For one scene in eight: with a budget, what is seen is what is seen without, or the question ends; now and then in a
/// crowd of copies of the scene, which takes longer than it has.
Check see_budget_check();

/// For one scene in sixteen, by lines or by events: with a budget, each face is decided as without, or undecided; what
/// lines decide is proved, in a crowd of copies too.
Check weak_budget_check();

}  // namespace sightline::harness
