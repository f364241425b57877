#pragma once
// Answers of weak visibility as certificates that a sceptic can check.

#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <vector>

namespace sightline {

/// What verify_weak() checks, in the file's coordinates. Lines of all proofs are numbered together. What is unproved
/// counts as undecided there: nothing is claimed about it. Sources are named by their strict corners. Pre: `sources`
/// are the points that the answers are for. Exact: yes
Weak_certificate weak_certificate(const Scene& scene, const std::vector<std::vector<Exact_point>>& sources,
                                  bool two_sided, const Weakly_visible& found);

}  // namespace sightline
