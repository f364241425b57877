#pragma once
// The file formats, and how a caller wishes them read.

#include <filesystem>
#include <optional>

namespace sightline {

/// A polygon file format; Quake's two (map, bsp) and glTF (glb, gltf) are read only. A PLY file says itself whether it
/// is text or binary, and an STL file shows it: for reading, ply and ply_binary are the same, and so for writing they
/// are not.
enum class Format { obj, off, qoff, ply, ply_binary, stl, map, bsp, glb, gltf };

/// What write_scene knows, and what read_scene knows beside it, for messages.
inline constexpr const char* supported_formats =
    "OBJ (.obj), OFF (.off), OFF with rational coordinates (.qoff), PLY (.ply) and STL (.stl)";
inline constexpr const char* read_only_formats = "Quake's levels (.map, .bsp) and glTF (.glb, .gltf)";

struct Read_options {
  /// `--coordinates double`: a number in text is first rounded to the nearest double, ties to even.
  bool round_to_double = false;
  /// Of .qoff: the coordinates' common denominator may be of any length. No Scene can be made of such a soup's points
  /// together.
  bool any_denominator = false;
  /// Of .qoff: what has no `/` is a decimal.
  bool decimals_too = false;
};

/// The format that a file name's ending names, upper or lower case (.ply: text, when written); nothing for any other
/// ending.
std::optional<Format> format_of_ending(const std::filesystem::path& path);

}  // namespace sightline
