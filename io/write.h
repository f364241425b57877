#pragma once
// Writing a scene, exactly or not at all.

#include <sightline/io/format.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <ostream>

namespace sightline {

/// Writes a scene such that read_scene gives it back: the same points and faces; from STL the same triangles of the
/// same points. Throws Not_representable where the format cannot hold it; then some of it may have been written; and
/// std::out_of_range where a face has a corner that is no point. Exact: yes. Post: errors of the stream are left in its
/// state.
void write_scene(const Polygon_soup& soup, std::ostream& out, Format format);

/// Writes a scene to a file, whole or not at all, as write_bytes does. Throws Not_representable, or std::runtime_error
/// where the file cannot be written.
void write_scene(const Polygon_soup& soup, const std::filesystem::path& path, Format format);

/// Writes a scene to a file in the format that its ending says (.ply: text). Throws as above, and std::runtime_error
/// where the ending says none.
void write_scene(const Polygon_soup& soup, const std::filesystem::path& path);

/// The same, and calls `progress` all the while with how many bytes are made, and then with how many of how many are
/// written. What it throws is thrown on, and what was there before stays.
void write_scene(const Polygon_soup& soup, const std::filesystem::path& path,
                 const std::function<void(std::size_t done, std::size_t all)>& progress);

}  // namespace sightline
