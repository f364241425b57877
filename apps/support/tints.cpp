#include "tints.h"

#include "files.h"
#include "paths.h"
#include "picture.h"

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/io/input.h>
#include <sightline/io/materials.h>

#include <optional>

namespace sightline::app {

void Tint_arguments::add_to(Command command) {
  command
      .add_option("--colours", colours,
                  "palette: a hue for each face; materials: Kd and d or Tr of an OBJ; or a file with a line R,G,B or "
                  "R,G,B,ALPHA for each face, 0 to 255 and 0 to 1")
      .reads_file()
      .show_default();
  command.add_option("--alpha", alpha, "opacity of faces that have none of their own")
      .check(range(0.0, 1.0))
      .show_default();
}

/// What a list or a library says of a face.
struct Own_tint {
  Colour colour;
  std::optional<double> alpha;
};

static std::vector<std::optional<Own_tint>> own_tints(const Tint_arguments& arguments, const std::string& scene_file,
                                                      const Scene& scene) {
  const std::size_t faces = scene.counters().faces_read;
  std::vector<std::optional<Own_tint>> tints;
  if (arguments.colours == "palette") {
    tints.resize(faces);
  } else if (arguments.colours == "materials") {
    if (!scene_file.ends_with(".obj") && !scene_file.ends_with(".OBJ"))
      throw Usage_error("--colours materials is for scenes in .obj files, which name their materials");
    for (const std::optional<Material>& material : read_materials(scene_file)) {
      tints.emplace_back();
      if (!material) continue;
      tints.back() = Own_tint{material->colour, material->opacity};
      for (double& c : tints.back()->colour) c = 255 * std::clamp(c, 0.0, 1.0);
    }
  } else {
    read_lines(arguments.colours, "a colour R,G,B of 0 to 255, perhaps with ,ALPHA of 0 to 1",
               [&](const std::vector<Rational>& n) {
                 if (n.size() != 3 && n.size() != 4) return false;
                 for (std::size_t k = 0; k < n.size(); ++k)
                   if (n[k] < 0 || n[k] > (k < 3 ? 255 : 1)) return false;
                 Own_tint& tint = tints.emplace_back(Own_tint{}).value();
                 for (std::size_t k = 0; k < 3; ++k) tint.colour[k] = nearest_double(n[k]);
                 if (n.size() == 4) tint.alpha = nearest_double(n[3]);
                 return true;
               });
    if (tints.size() != faces)
      throw Input_error::of_file(
          arguments.colours, fmt::format("{} colours for {} faces; write a line for each face", tints.size(), faces));
  }
  return tints;
}

std::vector<Tint> tints_of(const Tint_arguments& arguments, const std::string& scene_file, const Exact_view& view,
                           bool lit, const Report& progress) {
  const Scene& scene = view.scene();
  const std::vector<std::optional<Own_tint>> own = own_tints(arguments, scene_file, scene);
  std::vector<Tint> tints;
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
    if (progress) progress(0, scene.pieces().size());
    const Piece& piece = scene.pieces()[i];
    const std::vector<Exact_point> corners = scene.corner_points(piece);
    const double shade = lit ? shade_of(corners) : 0;
    Tint& tint = tints.emplace_back(Tint{{}, arguments.alpha});
    if (const std::optional<Own_tint>& given = own[piece.face]) {
      tint.colour = given->colour;
      for (double& c : tint.colour) c *= lit ? 0.8 + 0.2 * shade : 1;
      tint.alpha = given->alpha.value_or(arguments.alpha);
    } else {
      tint.colour = colour_by_face(piece.face, view.eye_side(i) == CGAL::POSITIVE, shade);
    }
  }
  return tints;
}

bool is_transparent(const std::vector<Tint>& tints) {
  return std::any_of(tints.begin(), tints.end(), [](const Tint& tint) { return tint.alpha < 1; });
}

}  // namespace sightline::app
