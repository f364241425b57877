#pragma once
// Reading a scene, whatever its format.

#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sightline {

/// The format that the bytes show, for a file whose ending says nothing; nothing where they show none.
std::optional<Format> format_of_content(const Input& input);

/// Reads a scene from bytes in a known format; `name` is what messages call it, and Polygon_soup::file.
/// Throws Input_error on anything that is not well-formed. Faces of fewer than three corners and the like are
/// well-formed. Exact: yes. Cost: one pass.
Polygon_soup read_scene(std::string_view bytes, Format format, const std::string& name,
                        const Read_options& options = {});

/// Reads a scene from a file, whose format its ending says (.obj .off .qoff .ply .stl .map .bsp .glb .gltf, in upper or
/// lower case), or else its content. Throws Input_error, also where the file cannot be read or its format is unknown.
/// Exact: yes. Cost: one pass.
Polygon_soup read_scene(const std::filesystem::path& path, const Read_options& options = {});

}  // namespace sightline
