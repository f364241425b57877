#pragma once
// A quick answer that leaves out nothing that is visible: a face counts as hidden only where one piece alone hides it,
// or where it looks away.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace sightline {

struct Conservative_options {
  bool two_sided = false;
  int threads = 0;                                                  ///< 0: as many as there are processors
  std::function<void(std::size_t done, std::size_t all)> progress;  ///< faces; called by any thread
};

/// The proof that a piece is hidden from a source, where it needs one blocking piece at most: two cuts leave what they
/// have in front of each other, then that is blocked, or there is nothing. None: it may be visible. Cost: pieces near
/// the shaft between them. Exact: yes. Proof: P-70, P-72
std::optional<std::vector<Weak_step>> hidden_by_one_piece(const Occluders& occluders, const Weak_source& source,
                                                          std::uint32_t piece, bool two_sided);

/// The faces that may be visible, in the sense of weakly_visible(): all that are, and some that are not, as several
/// pieces together may hide a face. Nothing is undecided; what is hidden is proved, what is visible is not. Post:
/// `hidden` is a subset of what weakly_visible() finds hidden; the same at any number of threads. Cost: a walk through
/// the pieces near each shaft between a source and a piece. Exact: of what it says is hidden. Proof: P-70, P-72
Weakly_visible possibly_visible(const Occluders& occluders, const std::vector<Weak_source>& sources,
                                const Conservative_options& options = {});

}  // namespace sightline
