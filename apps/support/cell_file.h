#pragma once
// Cells as a file, which `cells --out` writes and `pvs --cells` reads.

#include "leaves.h"

#include <string>
#include <vector>

namespace sightline::app {

/// The whole of it as JSON: points once, by number; cells, with the convex region of each where there are regions;
/// walls; and of what scene they are and how they were made, so that they can be made again.
std::string cells_text(const Level_cells& level, const Polygon_soup& soup, const Division& division,
                       const std::vector<std::uint32_t>& regions);

/// Cells of a file: made again, and held to what the file says of them.
class Cell_file {
 public:
  /// Errors: Input_error where the file is none, is damaged, or of another scene than `soup`, which is that of
  /// `common`.
  Cell_file(const std::string& file, const Common& common, const Polygon_soup& soup);

  /// How they were made: again from the scene, but for volumes, whose tree the file alone has, and which it names.
  const Division& division() const { return division_; }
  /// The convex region of each cell, where they are put together to such. Errors: Input_error where the cells are
  /// others.
  std::vector<std::uint32_t> checked_regions(const Level_cells& level) const;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  void read_made(const nlohmann::json& made, const Common& common, const Polygon_soup& soup);
  void read_tree(const nlohmann::json& tree);

  std::string file_;
  nlohmann::json json_;
  Division division_;
};

}  // namespace sightline::app
