#pragma once
// Wavefront OBJ.

#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <ostream>

namespace sightline {

/// Reads OBJ: `v` and `f`; texture coordinates, normals, groups, materials, lines and points are passed over.
/// Throws Input_error. Exact: yes. Cost: one pass.
Polygon_soup read_obj(const Input& input, const Read_options& options = {});

/// Writes OBJ. Throws Not_representable where a coordinate is no finite decimal or a face has holes. Exact: yes.
void write_obj(const Polygon_soup& soup, std::ostream& out);

}  // namespace sightline
