#pragma once
// glTF 2.0, binary (.glb) and in JSON (.gltf): the triangles of a scene's meshes, where its nodes put them.

#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <functional>
#include <string>
#include <string_view>

namespace sightline {

bool looks_like_glb(std::string_view bytes);

/// The bytes of a file by its path from the folder that the scene's file is in. Errors: Input_error where there is
/// none.
using Gltf_neighbour = std::function<std::string(const std::string& path)>;

/// Reads the scene that the file shows (`scene`, or else its first; without scenes all nodes that are nobody's child).
/// Points: those of each node's meshes, in the order of the nodes, children behind their parent; points that primitives
/// of a node share come once, unused ones too. Faces: triangles, strips and fans, counterclockwise as seen from the
/// front, also where a node mirrors. Where a node puts them is computed exactly from the file's decimals and floats; a
/// rotation is about its quaternion's axis whatever the quaternion's length. y stays y. Passed over: points and lines,
/// materials, textures, skins, morph targets, animations, cameras, lights; primitives without POSITION. Errors:
/// Input_error, which names the byte, or the place in the JSON: for buffers in other files that `neighbour` does not
/// give, sparse accessors, extensions that the file requires, nodes in a circle or with two parents, numbers of nodes
/// beyond 2^4096, and where nodes make more than the file's own size of one mesh (a million points more, eight million
/// triangles). Cost: linear in what is made. Exact: yes. Source: Khronos, glTF 2.0 specification.
Polygon_soup read_glb(const Input& input, const Read_options& options = {}, const Gltf_neighbour& neighbour = {});
/// The same of a file of JSON alone, its buffers in data: URIs or in files beside it.
Polygon_soup read_gltf(const Input& input, const Read_options& options = {}, const Gltf_neighbour& neighbour = {});

}  // namespace sightline
