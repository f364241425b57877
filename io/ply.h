#pragma once
// Stanford PLY: text, and binary of either byte order.

#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <ostream>

namespace sightline {

/// Reads PLY 1.0: of each vertex x, y and z, of each face vertex_indices (or vertex_index); everything else is passed
/// over. Throws Input_error. Exact: yes (decimals in text, floats in binary data as they are). Cost: one pass.
Polygon_soup read_ply(const Input& input, const Read_options& options = {});

/// Writes PLY, as text or as little-endian doubles. Throws Not_representable where a coordinate is no finite decimal
/// (text) or no double (binary), or a face has holes. Exact: yes.
void write_ply(const Polygon_soup& soup, std::ostream& out, bool binary);

}  // namespace sightline
