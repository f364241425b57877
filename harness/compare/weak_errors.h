#pragma once
// How wrong an answer of weak visibility is: faces, against the exact answer.

#include <sightline/algorithms/weak_visibility/weak_answer.h>

#include <cstddef>

namespace sightline {

struct Weak_errors {
  std::size_t wrongly_visible = 0, wrongly_hidden = 0;
  std::size_t undecided = 0;  ///< left open, though the exact answer knows
  std::size_t unjudged = 0;   ///< that the exact answer leaves open, whatever is said of them
  std::size_t all() const { return wrongly_visible + wrongly_hidden + undecided; }
};

/// Faces that are said to be visible and are hidden, and so on. Pre: lists as Weak_faces has them, of the same scene.
/// Cost: linear. Exact: yes
Weak_errors weak_errors(const Weak_faces& exact, const Weak_faces& said);

}  // namespace sightline
