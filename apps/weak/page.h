#pragma once
// The page of `sightline weak`.

#include "weak.h"

#include <string>
#include <vector>

namespace sightline::app {

/// Faces by what is known of them, sources, sightlines and proofs; and what a search in doubles makes of the same.
void write_page(const Weak_arguments& arguments, const Scene& scene, const Sources& sources,
                const Weakly_visible& found, const std::vector<std::string>& names, const Weakly_visible* doubles);

}  // namespace sightline::app
