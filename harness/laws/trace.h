#pragma once
// The subject `trace`: what rays meet.

#include <sightline/algorithms/rays/ray.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/scene/scene.h>

#include <vector>

namespace sightline::harness {

Subject trace();

/// All hits of a ray by the definition: of each planar face that is kept, the loops of the file and the winding number
/// of each part of the ray; of others, the triangles of the scene. Shares nothing with tracers but the words, nor with
/// how they join parts. Cost: O(faces), rationals. Exact: yes.
std::vector<Face_hit> hits_by_definition(const Polygon_soup& soup, const Scene& scene, const Exact_ray& ray,
                                         Ray_start start);
/// Of these those of the least t.
std::vector<Face_hit> first_by_definition(const Polygon_soup& soup, const Scene& scene, const Exact_ray& ray,
                                          Ray_start start);
/// Whether what a ray meets in doubles is the first of its exact first hits, or nothing where there are none: the same
/// face and side, tied iff they are several, and between bounds that hold.
bool is_first(const Ray_tracer::Nearest& near, const std::vector<Face_hit>& first);

}  // namespace sightline::harness
