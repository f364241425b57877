#include <sightline/io/format.h>

#include <algorithm>
#include <cctype>
#include <string>

namespace sightline {

std::optional<Format> format_of_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".obj") return Format::obj;
  if (ending == ".off") return Format::off;
  if (ending == ".qoff") return Format::qoff;
  if (ending == ".ply") return Format::ply;
  if (ending == ".stl") return Format::stl;
  if (ending == ".map") return Format::map;
  if (ending == ".bsp") return Format::bsp;
  if (ending == ".glb") return Format::glb;
  if (ending == ".gltf") return Format::gltf;
  return std::nullopt;
}

}  // namespace sightline
