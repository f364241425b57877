#pragma once
// What a command found, as files for programs that draw: --mesh.

#include "common.h"

#include <sightline/io/grouped_polygons.h>
#include <sightline/kernel/scene/scene.h>

#include <functional>
#include <string>

namespace sightline::app {

/// Colours of groups, in all commands.
namespace drawing_colours {
using Colour = std::array<std::uint8_t, 3>;
inline constexpr Colour seen{241, 175, 75}, hidden{141, 150, 165}, open{190, 71, 209}, source{223, 32, 64},
    other{90, 160, 215};
/// Of things that are to be told apart, to be used in turn; told apart by the colour-blind too (Okabe and Ito).
inline constexpr std::array<Colour, 7> in_turn{
    {{230, 159, 0}, {86, 180, 233}, {0, 158, 115}, {240, 228, 66}, {0, 114, 178}, {213, 94, 0}, {204, 121, 167}}};
}  // namespace drawing_colours

/// Adds --mesh FILE; `what` says what of the command's is in it.
Option add_mesh_option(Command command, std::string& file, const std::string& what);

/// All pieces of a scene, each in the group that `group_of` says of its number.
void add_pieces(Grouped_polygons& polygons, const Scene& scene,
                const std::function<std::uint32_t(std::uint32_t piece)>& group_of);

/// Writes what --obj and --mesh ask for, where they are given, each whole or not at all. Errors: as write_file.
void write_drawings(const std::string& obj, const std::string& mesh, const Grouped_polygons& polygons);

}  // namespace sightline::app
