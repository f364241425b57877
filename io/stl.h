#pragma once
// STL, text and binary: triangles, of which equal points are made one.

#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <ostream>

namespace sightline {

/// Whether the bytes are an STL file, by their number or their first word.
bool is_stl(const Input& input);

/// Reads STL, text or binary. Points are merged by exact value; facet normals, names and spare bytes are passed over.
/// Throws Input_error. Exact: yes (the floats of binary data as they are). Cost: one pass, and a hash table of the
/// points.
Polygon_soup read_stl(const Input& input, const Read_options& options = {});

/// Writes STL in text; normals are written as 0 0 0, which stands for "as the points say". Reading gives the same
/// triangles, but only the points in use, and each once. Throws Not_representable where a face is no triangle or a
/// coordinate no finite decimal. Exact: yes.
void write_stl(const Polygon_soup& soup, std::ostream& out);

}  // namespace sightline
