#pragma once
// What an eye sees on its way as a certificate that a sceptic can check.

#include <sightline/algorithms/verify/along.h>
#include <sightline/algorithms/weak_visibility/along/along.h>
#include <sightline/kernel/scene/scene.h>

namespace sightline {

/// What verify_along() checks: when each face is seen, and the proofs. Pre: the answer was made `with_proofs`, of this
/// path and scene. Exact: yes
Along_certificate along_certificate(const Scene& scene, const Visible_along& found, const Exact_point& from,
                                    const Exact_point& to, bool two_sided);

}  // namespace sightline
