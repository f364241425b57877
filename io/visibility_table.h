#pragma once
// Tables of what the cells of a level see, as files: whole ones, and parts that many machines made.

#include <sightline/io/input.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace sightline {

/// For cells that were asked about, the faces that they see and that are undecided, ascending; of the faces that were
/// asked about the others are hidden. And, where pairs of cells were asked about, the other cells, symmetric.
struct Visibility_table {
  std::string question;            ///< one line: of which scene, with which options; parts of one table have the same
  std::vector<bool> cells, faces;  ///< which were asked about
  struct Row {
    std::vector<Face_id> visible, undecided;
    std::vector<std::uint32_t> cells = {}, cells_undecided = {};
  };
  std::vector<Row> rows;               ///< of the cells that were asked about, in order
  std::vector<bool> lower_cells = {};  ///< a pair of cells was asked about where its lower one is here; empty: none was

  bool has_cells() const { return !lower_cells.empty(); }

  /// The row of a cell; null where it was not asked about. Cost: O(cells)
  const Row* row_of(std::size_t cell) const;
};

/// The bytes of a table: a line `sightline pvs 3`; the question, behind its length; the numbers of cells and faces;
/// which cells were asked about and which faces; and for each of these cells two rows of bits (bit_rows.h), of what is
/// visible and of what is undecided. Where pairs of cells were asked about, the line is `sightline pvs 4`; a row of the
/// lower cells of these pairs follows which faces were asked about, and the two rows of each of them that is asked
/// about are followed by two more, of higher cells: so what is read is symmetric. Numbers are of 4 bytes, the least
/// significant first. The last 8 bytes are the sum of all before them, sum_of_bytes().
std::string table_bytes(const Visibility_table& table);

/// Reads a table, also of older programs: `sightline pvs 1`, and with pairs of cells `2`, which have no sum. Errors:
/// Input_error where the bytes are none, end too soon, or have not their sum; and of a scene without faces, whose rows
/// take no byte, where there are 65,536 rows more than bytes. Cost: one pass; memory in proportion to the bytes.
Visibility_table read_table(const Input& input);

/// Parts that are none of one table, or not all of it; names the parts.
struct Merge_error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One table of parts with different faces and lower cells, which need not have all. Errors: Merge_error where two are
/// answers to different questions, or have a face or a lower cell in common. `names`: of the parts, for messages.
Visibility_table joined(const std::vector<Visibility_table>& parts, const std::vector<std::string>& names);

/// The same of parts that together have all faces. Errors: Merge_error too where a face is in none: then it says which
/// of how many shards to run again.
Visibility_table merged(const std::vector<Visibility_table>& parts, const std::vector<std::string>& names);

/// A number for what a scene is: of its points and faces, whatever its file. FNV-1a of 64 bits.
std::uint64_t fingerprint(const Polygon_soup& soup);

}  // namespace sightline
