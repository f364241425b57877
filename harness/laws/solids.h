#pragma once
// The subject `boolean`: set operations on solids that are made of a scene's faces.

#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <string>
#include <vector>

namespace sightline::harness {

/// The two solids of a scene that is a pair. Else solids of faces of a scene: cones over them, prisms on them, or
/// copies of one another; two or three; now and then of faces that are folded flat instead, or a block with a hole in
/// which an island touches it. Faces that cross themselves or have holes are left out. May be empty, and wound round
/// any number of times.
std::vector<Polygon_soup> solids_of(const Posed_scene& scene, Random& random);

/// Any operation, with its fragments, as certificates ask for them.
template <class Source>
Set_options drawn_operation(Source& random) {
  Set_options options;
  options.operation = set_operations[random.below(4)];
  options.inside = inside_rules[random.below(3)];
  options.keep_fragments = true;
  return options;
}

/// What is wrong with the four set operations on some solids; empty: nothing. By points: in the result iff the
/// operands' winding numbers say so. By volumes, as rationals, of three solids at most: what is in the union and in the
/// intersection adds up to the solids, and so on. By the surface: closed, no vertex inside an edge, edges of other than
/// two faces listed.
std::string flaw_by_points(const std::vector<Polygon_soup>& solids, std::size_t points, Random& random);
std::string flaw_by_volumes(const std::vector<Polygon_soup>& solids);
std::string flaw_of_surfaces(const std::vector<Polygon_soup>& solids);

/// Labels say what is left of each face's cone from the eye: its base in A less B, in B less A, in the union, in the
/// intersection; A the cones over faces that look away from the eye, B those over others.
Subject boolean();

}  // namespace sightline::harness
