#pragma once
// What is told of cases that are answered wrongly: why, how small they can be made, and what may be the reason.

#include "judge.h"

#include <sightline/harness/judge/guess.h>

#include <string>
#include <vector>

namespace sightline::app {

/// Why a case is wrong, for people: the line that refutes, the share that is wrong, and a picture. Pre: its mark is
/// `wrong`.
Json explained(const Judge_arguments& arguments, const Judge_case& asked, const Judged& broken);

/// Writes the picture of an explained case beside its scene, where files are kept.
void keep_picture(const Judge_arguments& arguments, Json& explained_case, const std::string& stem);

/// A case made smaller as long as the program breaks the contract in the same way: how far, and the files that are
/// kept. Faces stay planar, their corners apart, and coordinates doubles where these are wanted.
Json made_smaller(const Judge_arguments& arguments, const Court& court, const Judge_case& asked, const Judged& broken);

/// What a wrong case looks like once it is moved, and under other readings of the question.
std::vector<std::string> guesses(const Judge_arguments& arguments, const Court& court, const Case_group& group,
                                 const Judge_case& asked, const Judged& broken);

/// What all wrong cases have in common.
class Common_guess {
 public:
  Common_guess(judge::Question question, bool two_sided)
      : readings_(judge::readings_of(question)), two_sided_(two_sided) {}

  /// Returns what readings are left. `kept`: those that were left before.
  const std::vector<judge::Reading>& add(const Judge_case& asked, const Judged& wrong,
                                         const judge::Truth_options& options, const std::vector<judge::Reading>* kept);
  void add(const judge::Kinds& kinds);
  std::vector<std::string> words() const;

 private:
  std::vector<judge::Reading> readings_;  // under which all wrong answers are right
  bool two_sided_;
  std::size_t wrong_ = 0;
  bool supported_ = false;
  judge::Kinds kinds_;
};

}  // namespace sightline::app
