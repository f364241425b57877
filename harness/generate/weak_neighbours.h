#pragma once
// Families of questions of weak visibility: source and target with edges, corners or planes in common, closed bodies,
// and faces anywhere.

#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/weak_draft.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>

namespace sightline::generate::weak_drafts {

// ---- Families: source and target with edges, corners, planes in common

/// A floor and a wall that share an edge or a corner, and a plate in the plane x = z between them. Lines from (a, y) on
/// the floor to (b, y') on the wall cross it at x = a b / (a + b), at most 1; where both are triangles of half-width a
/// / 2, b / 2 at |y| <= x.
Draft hinged(Random& random, const Rational& gap);

/// Planes that cut the other polygon, or nearly: nothing between, and little in front.
Draft facing(Random& random, const Rational& gap);

/// A lid in the target's plane blocks nothing, just before it everything; also one in the source's.
Draft lids(Random& random, const Rational& gap);

/// Two slopes that start from a line across the source, touching it or coming through it, and cover it like a valley.
Draft valley(Random& random, const Rational& gap);

// ---- Families: closed bodies, and no truth

Exact_point box_size(Random& random);
void all_are_targets(Draft& draft);

Draft boxes(Random& random, const Rational& gap);

/// One face from that number on is moved by the gap along an axis.
void move_a_face(Draft& draft, std::size_t first, const Rational& gap, Random& random);

/// Anything on the integer lattice: faces cross each other and the source, and share planes, edges and corners.
Draft lattice_faces(Random& random, const Rational& gap);

Draft triangles(Random& random, const Rational& gap);

}  // namespace sightline::generate::weak_drafts
