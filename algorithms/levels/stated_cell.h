#pragma once
// What certificates say of a cell beside what it sees.

#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/verify/level_cell.h>

namespace sightline {

/// A cell's walls, as seen from outside of it, and the faces that look into it: what verify_level_cell() takes beside
/// the certificate of what portals_of() the cell see. Cost: its corners. Exact: yes. Proof: P-88b
Cell_statement stated_cell(const Level_cells& level, Cell_id cell);

}  // namespace sightline
