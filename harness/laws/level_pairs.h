#pragma once
// Checks of the subject `pvs`: which cells see each other.

#include <sightline/algorithms/levels/cells.h>
#include <sightline/harness/laws/subject.h>

#include <array>

namespace sightline::harness {

namespace levels_subject {

/// Whether a segment goes from inside the one cell to inside the other, and meets no face on its way.
bool is_free(const Polygon_soup& soup, const Level_cells& level, Cell_id a, Cell_id b,
             const std::array<Exact_point, 2>& line);

}  // namespace levels_subject

/// That cells which a random segment joins see each other, and that all of it is symmetric.
Check segments_check();

/// That two cells by themselves see each other as the table says, with a certificate; that a sightline goes from the
/// one to the other; and that leaves see what their cells do.
Check pairs_check();

}  // namespace sightline::harness
