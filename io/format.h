#pragma once
// The file formats, and how a caller wishes them read.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string>

namespace sightline {

/// A polygon file format. A PLY file says itself whether it is text or binary, and an STL file shows it: for reading,
/// ply and ply_binary are the same, and so for writing they are not.
enum class Format { obj, off, qoff, ply, ply_binary, stl };

/// What read_scene knows, for messages.
inline constexpr const char* supported_formats =
    "OBJ (.obj), OFF (.off), OFF with rational coordinates (.qoff), PLY (.ply) and STL (.stl)";

struct Read_options {
  bool round_to_double =
      false;  ///< `--coordinates double`: a number in text is first rounded to the nearest double, ties to even
};

/// The format that a file name's ending names, upper or lower case (.ply: text, when written); nothing for any other
/// ending.
inline std::optional<Format> format_of_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".obj") return Format::obj;
  if (ending == ".off") return Format::off;
  if (ending == ".qoff") return Format::qoff;
  if (ending == ".ply") return Format::ply;
  if (ending == ".stl") return Format::stl;
  return std::nullopt;
}

}  // namespace sightline
