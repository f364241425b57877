#pragma once
// The materials of a Wavefront OBJ: what its faces look like.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sightline {

/// A diffuse colour (Kd) in red, green and blue, each 0 to 1 as a rule; and what of the light from behind it keeps back
/// (d, or 1 - Tr).
struct Material {
  std::string name;
  std::array<double, 3> colour{0.8, 0.8, 0.8};
  double opacity = 1;
};

/// The material of each face of an OBJ file, in their order; nothing for faces before the first `usemtl`. Libraries
/// (`mtllib`) are found beside the file; of a material in several of them the first counts, of a line in a material the
/// last; what is about textures and shine is passed over. Degenerate: a file without materials gives none. Errors:
/// Input_error for what cannot be read, a colour that is no three finite numbers, an opacity that is not from 0 to 1,
/// and a material that no library has. Cost: one pass over each file.
std::vector<std::optional<Material>> read_materials(const std::filesystem::path& obj);

}  // namespace sightline
