#pragma once
// Families of questions of weak visibility: a shaft that surfaces close, or edges that one line meets. Each has a truth
// known by construction.

#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/weak_draft.h>
#include <sightline/kernel/number.h>

namespace sightline::generate::weak_drafts {

// ---- Families: surfaces that close the shaft
// ----------------------------------------------------------------------------------------------------- A surface over
// all of [-1, 1]^2 between the heights of source and target hides the target: the height above it of a point that goes
// along a line changes sign. A piece of it missing is seen through along the vertical.

/// Triangles around a point, corners at any height: they share edges, some fold steeply.
Draft shared_edges(Random& random, const Rational& gap);

/// Two slopes that meet in a ridge, each cut across at places of its own: along the ridge no edge is shared as a whole.
Draft cracks(Random& random, const Rational& gap);

/// A square in one plane cut again and again by lines, each across one piece: T-junctions.
Draft t_junctions(Random& random, const Rational& gap);

/// Strips in one plane that overlap, up to a seam in which they only touch.
Draft coplanar_overlap(Random& random, const Rational& gap);

// ---- Families: edges that one line meets
// ----------------------------------------------------------------------------------------------------------- Plates
// that reach out of the shaft on one side of an edge: a line is free if its side of each edge has the right sign. Where
// the Pluecker coordinates of the edges, each with its sign, have a positive combination that is zero, no line has all
// signs right, whatever the plates' planes. One plate drawn back by a gap frees those lines that met all edges.

/// A plane through an edge of the source, edges in it of a plate left of it and then of one right of it: a line would
/// have to cross the plane twice.
Draft coplanar_edges(Random& random, const Rational& gap, bool parallel);
inline Draft slats(Random& random, const Rational& gap) { return coplanar_edges(random, gap, true); }
inline Draft edges_in_one_plane(Random& random, const Rational& gap) { return coplanar_edges(random, gap, false); }

/// Edges through one point. With the moment n of a line about it, sides are u_k . n; the directions u_k add up to zero.
Draft concurrent_edges(Random& random, const Rational& gap);

/// Four rulings of y = k x (z - 2), at four heights. On a line y - k x (z - 2) is a quadratic in z: its sign can change
/// twice, not thrice.
Draft regulus(Random& random, const Rational& gap);

/// Rulings y = c x, z = c at c_1 < c_2 < c_3, and the line through (0, 0, c_4) in direction (1, c_4, v), which is
/// tangent to y = x z there: the z axis meets all four and is a double root. Lines are x = a + alpha z, y = b + beta z;
/// f(z) = y - x z on them is b + (beta - a) z - alpha z^2, and must be > 0, < 0, > 0 at the first three, f(c_4) < v
/// (alpha b - beta a) at the fourth. By interpolation f(c_4) = sum |L_k f(c_k)| > 0, and alpha b - beta a <=
/// discriminant(f) / 4 <= 5/4 |f|^2 for the largest coefficient |f| <= 3, itself at most max 2 / |(c_k - c_i) (c_k -
/// c_j)| times sum |f(c_k)|. So it is hidden for small v > 0; for v < 0 lines near x = 1/2, y = z / 2 are free, which
/// pass the fourth edge by gap - v / 4.
Draft tangent(Random& random, const Rational& gap);

/// Five horizontal edges that a line meets, in general position but for that: free lines (a, b), a + b z at height z,
/// have n_k . (a + b z_k) > d_k. Hidden iff the one linear relation of the vectors (n_k, z_k n_k) has coefficients of
/// one sign.
Draft five_edges(Random& random, const Rational& gap);

/// Plates with a slit or a hole, of width 2^-k for k up to 60, around one line; or one of them closed, or overlapping.
Draft apertures(Random& random, const Rational& gap);

}  // namespace sightline::generate::weak_drafts
