#pragma once
// Closed surfaces made of a scene's faces: cones over them, prisms on them, and pairs of these, which touch as likely
// as not.

#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <span>

namespace sightline::generate {

/// A face, holes and all, on points of its own.
Polygon_soup face_alone(const Polygon_soup& soup, Face_id face);

/// The corners of a face that solids can be made of, none twice in turn: one loop that does not cross itself, with
/// area; none of any other face. `planar`: nor of one that is not planar.
Points base_of(const Polygon_soup& soup, Face_id face, bool planar);

/// Adds the base as it is, then what closes it, to the apex.
void add_cone(Polygon_soup& soup, const Points& base, const Exact_point& apex);
/// Adds the base as it is, and what closes it, moved along.
void add_prism(Polygon_soup& soup, const Points& base, const Exact_point& along);

/// How far a solid may be moved: not, by a lattice step, or by a few ulps.
Exact_point any_step(const Posed_scene& scene, Random& random);

using Solid_pair = std::array<Polygon_soup, 2>;

/// Both solids as one scene, each on points of its own that are there once and in use, and back: its first so many
/// faces, and all others.
Polygon_soup joined(std::span<const Polygon_soup, 2> solids);
Solid_pair solids_of(const Polygon_soup& soup, std::size_t first);

/// The two solids of a scene that is a pair; of another scene two, each a cone over a planar face or a prism on one,
/// fronts outwards: of any two faces with one apex or another, on the same face, or one a copy of the other beside it.
/// Empty where no face serves.
Solid_pair pair_of_solids(const Posed_scene& scene, Random& random);

/// A surface, and a copy of it: where it is, a few ulps away, or moved along the axes by quarters of its box, so that
/// planes of faces meet.
Solid_pair pair_of_copies(const Polygon_soup& soup, Random& random);

/// Two surfaces, the second scaled by a power of two to about the size of the first, its axes exchanged in turn where
/// that helps, and sheared along one of them, by which volumes are kept, so that a face of each lies in one plane and
/// a corner of each in one place. Where faces are parallel, it is moved only. Pre: both have points; coordinates within
/// the range of doubles. Degenerate: of faces without area, corner on corner is all; one that is not planar may be cut
/// otherwise then. Exact: yes.
Solid_pair pair_on_a_plane(const Polygon_soup& a, const Polygon_soup& b, Random& random);

/// A tetrahedron whose four corners, seen along one of the axes, are those of a convex quadrilateral, and along it are
/// less than two steps of floats apart: rounded to floats, it may be turned inside out and no normal of it, or be flat.
Polygon_soup thin_tetrahedron(Random& random);

/// A box, and a tetrahedron that stands on an edge right across one of its faces and beyond, both turned, far from the
/// origin: rounded to floats, the edge may go through the face.
Polygon_soup tetrahedron_upon_a_box(Random& random);

/// A box with a hollow tetrahedron in it, of which an edge lies in the box's top, from below; turned, and far away too.
Polygon_soup tetrahedron_below_a_top(Random& random);

}  // namespace sightline::generate
