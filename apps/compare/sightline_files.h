#pragma once
// Sightlines as certificates: what shows a skeptic that a level's table hides something wrongly.

#include "../support/options.h"

#include <sightline/algorithms/levels/cells.h>
#include <sightline/harness/compare/cell_sights.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/sightline.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sightline::app {

/// Writes certificates of weak visibility to a folder: of one source, a triangle about the line's beginning within its
/// cell, one sightline, and of all other faces nothing.
class Sightline_files {
 public:
  /// Makes the folder. Pre: the others outlive it, and the level is of the model's faces. Errors: std::runtime_error
  Sightline_files(std::filesystem::path folder, const Level_cells& level, const Model& model);

  /// From a cell to a face. Returns the name of the file; nothing where the line ends on the border of the face's
  /// pieces.
  std::optional<std::string> write(Cell_id cell, std::size_t leaf, const Cell_sightline& line) const;

  /// Between points of two cells, nothing between them: a line from one through the other to the first face behind
  /// that, which may show its back. Where it meets that on its border, or none, a line between points beside these.
  /// Returns nothing where no such line is found.
  std::optional<std::string> write(const std::array<Cell_id, 2>& cells, const std::array<std::size_t, 2>& leaves,
                                   const std::array<Exact_point, 2>& ends) const;

 private:
  /// A triangle about a point of a cell, within it, that looks along a direction.
  std::vector<Exact_point> source_about(const Exact_point& point, const Exact_point& direction, Cell_id cell) const;
  bool write(const std::string& name, Cell_id cell, const Exact_point& from, const Exact_point& to, Face_id face,
             bool is_back) const;

  std::filesystem::path folder_;
  const Level_cells& level_;
  const Model& model_;
  std::vector<harness::Flat_face> pieces_;
};

}  // namespace sightline::app
