#pragma once
// Pieces and lines in rationals, by definition: what the laws of line drawings stand on. Shares nothing with what
// draws.

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/weak_flats.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace sightline::harness::line_flats {

using weak_flats::Level;
using Interval = std::pair<Rational, Rational>;

/// A piece in its plane.
struct Flat_piece {
  generate::Points corners;
  Level plane;
  std::vector<Level> walls;  ///< through its edges, the piece on their positive sides
  Face_id face;

  bool is_in_plane_of(const Flat_piece& other) const;
};
using Flat_pieces = std::vector<Flat_piece>;

Flat_pieces flat_pieces(const Scene& scene);

/// p + t (q - p).
Exact_point between(const Exact_point& p, const Rational& t, const Exact_point& q);

/// The part of [least, most] of t for which p + t (q - p) is inside or on all walls; none where it has no length.
/// `touches`: one that has no length counts too.
std::optional<Interval> clipped(const std::vector<Level>& walls, const Exact_point& p, const Exact_point& q,
                                Interval range, bool touches = false);

/// Whether a point of a piece's plane is on the piece.
bool is_within_walls(const Flat_piece& flat, const Exact_point& x);

/// Whether the open segment from p to q meets a closed piece.
bool blocks(const Flat_piece& flat, const Exact_point& p, const Exact_point& q);

/// Whether it meets none.
bool is_sightline(const Flat_pieces& flats, const Exact_point& p, const Exact_point& q);

/// The faces that hold a point of a line, in planes whose pieces hold what is next to it on both sides of the line;
/// none where these are not two planes.
std::set<Face_id> crossing_at(const Flat_pieces& flats, const Exact_point& x, const Exact_point& direction);

/// What two pieces have in common, where they go through each other: an open segment, if there is one.
std::optional<std::array<Exact_point, 2>> common_segment(const Flat_piece& f, const Flat_piece& g);

}  // namespace sightline::harness::line_flats
