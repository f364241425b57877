#pragma once
// Paths of viewpoints, from files and round a scene, and pictures of what is on-view along them.

#include "picture.h"

#include <sightline/kernel/scene/face_graph.h>
#include <sightline/algorithms/cutset/motion.h>
#include <sightline/algorithms/rays/ray.h>

namespace sightline::app {

/// Where viewpoints come from: one of a file of viewpoints, a file of motions of the object seen from --eye, and a
/// circle round the scene.
struct Path_arguments {
  std::string path, motion, eye;
  std::size_t orbit = 0;
  double radius = 3, height = 1;
  bool given() const { return !path.empty() || !motion.empty() || orbit > 0; }
};

void add_to(Command command, Path_arguments& arguments);
/// Errors: Usage_error where there is more than one path.
void check_usage(const Path_arguments& arguments);
/// Calls `take` with the numbers of each line; '#' begins a comment, a first line that begins with a letter is a
/// header. Errors: Input_error with line and column, saying what is `wanted`, for what is no number, where `take` says
/// no, and for a file without a line.
void read_lines(const std::string& file, const std::string& wanted,
                const std::function<bool(const std::vector<Rational>&)>& take);

/// Rays: X,Y,Z,DX,DY,DZ a line, origin and direction. Errors: Input_error with line and column.
std::vector<Exact_ray> read_rays(const std::string& file);

/// Viewpoints, each made when it is asked for: an orbit of any length takes no memory.
struct Path {
  std::size_t size;
  std::function<Viewpoint(std::size_t)> at;
};
/// At least one viewpoint. Errors: Input_error with line and column.
Path path_of(const Path_arguments& arguments, const Scene& scene);

/// A frame's picture: the on-view nodes from a viewpoint.
struct Outline {
  Viewpoint view;
  std::vector<bool> on_view;
  std::size_t number;  ///< of the frame
  std::string title;
};
inline constexpr std::size_t pictures_in_a_strip = 12;
/// The frames beside each other: on-view faces, the far ones first by the distance of their middle (a sketch: `order`
/// is exact), and the edges of the cut-set; under each frame how many faces became on-view and off-view since the
/// frame before it in the picture, those that became on-view green. Face 7 of frame 2 has the ids frame-2-face-7-n.
/// `lit`: faces are darker away from the light.
std::string painted(const Face_graph& graph, const std::vector<Outline>& outlines, const Canvas_arguments& canvas,
                    bool lit);

}  // namespace sightline::app
