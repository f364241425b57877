#pragma once
// The page of `sightline weak`.

#include "weak.h"

#include <string>
#include <vector>

namespace sightline::app {

/// The faces that a search in doubles gets wrong, of those that are decided.
Json doubles_json(const Weakly_visible& found, const Weakly_visible& doubles);

/// Faces by what is known of them, sources, sightlines and proofs; `doubles`: what stands under that key.
void write_page(const Weak_arguments& arguments, const Scene& scene, const Sources& sources,
                const Weakly_visible& found, const std::vector<std::string>& names, Json doubles);

}  // namespace sightline::app
