#pragma once
// The subject `cutset`: on-view faces along a path of viewpoints, by a cut-set that moves.

#include <sightline/algorithms/cutset/on_view.h>
#include <sightline/algorithms/cutset/tracker.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/face_graph.h>
#include <sightline/kernel/scene/scene.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sightline::harness {

namespace cutset_subject {

/// From a point of the scene to the eye, by way of corners and of places beyond them, and a direction now and then.
std::vector<Viewpoint> path_to_the_eye(const Posed_scene& posed, Random& random);

/// On-view by definition, in rationals and from corners only.
bool is_on_view(const generate::Points& corners, const Viewpoint& view);

/// Follows a path, and compares each frame with the definition. Returns what is wrong, or nothing.
template <class Traits>
std::string flaw_along(const Scene& scene, const Traits& traits, const std::vector<Viewpoint>& path) {
  const Face_graph graph(scene);
  Cut_set_tracker<Traits> tracker(traits, graph);
  std::vector<generate::Points> nodes(graph.size());
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    for (const Piece_corner& corner : scene.corners(scene.pieces()[graph.piece(i)]))
      nodes[i].push_back(scene.position(corner.point));
  for (std::size_t frame = 0; frame < path.size(); ++frame) {
    tracker.move_to(path[frame]);
    std::vector<bool> on(graph.size()), in_cut(graph.edges().size());
    for (std::uint32_t i = 0; i < graph.size(); ++i) on[i] = is_on_view(nodes[i], path[frame]);
    for (const std::uint32_t e : tracker.cut_edges()) in_cut[e] = true;
    const std::string where = "frame " + std::to_string(frame) + ": ";
    for (std::uint32_t i = 0; i < graph.size(); ++i)
      if (tracker.on_view(i) != on[i])
        return where + "the tracker says that " + face_name(scene.pieces()[graph.piece(i)].face) + " is " +
               (on[i] ? "off" : "on") + "-view, the definition that it is not";
    for (std::size_t e = 0; e < in_cut.size(); ++e)
      if (in_cut[e] != (on[graph.edges()[e].first] != on[graph.edges()[e].second]))
        return where + "edge " + std::to_string(e) + (in_cut[e] ? " is" : " is not") + " in the cut-set";
  }
  return {};
}

/// From nowhere straight to the eye. Labels: 1 where a node of the face is on-view.
Answer answer(const Posed_scene& posed);

template <class Make_traits>
Outcome along_a_path(const Posed_scene& posed, Random& random, Make_traits make_traits) {
  const Scene scene(posed.soup);
  const std::string flaw = flaw_along(scene, make_traits(scene), path_to_the_eye(posed, random));
  return flaw.empty() ? Outcome{} : Outcome::failed(flaw);
}

}  // namespace cutset_subject

Subject cutset();

}  // namespace sightline::harness
