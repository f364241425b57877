#pragma once
// The result of `sightline compare` as a page to look at.

#include "compare.h"

#include <vector>

namespace sightline::app {

/// Writes the page of --html: the scene, and of each that was asked seconds, memory and errors; where rows hold faces
/// as "said", which of the `visible` ones it misses, and which it has too many. Takes "said" out of the rows. `eye`:
/// where there is one. Errors: as write_file.
void write_comparison(const Compare_arguments& arguments, const Scene& scene, Json& rows, const Exact_point* eye = {},
                      const std::vector<Face_id>* visible = {});

}  // namespace sightline::app
