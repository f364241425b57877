#pragma once
// What cells of a level see of faces, shown by a sightline each, and how large it looks.

#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/harness/compare/screen_sizes.h>

#include <functional>
#include <map>
#include <vector>

namespace sightline {

/// From a point of a cell's inside to one of a face's, in front of it; no closed face meets the open segment.
struct Cell_sightline {
  Face_id face;
  Exact_point from, to;
};

/// Sightlines and sizes of pairs of a cell and a face. Each point is looked from once. Whoever asks says when the time
/// is over, and gets what there is then. Exact: sightlines are, sizes as seen_faces().
class Cell_sights {
 public:
  using Is_over = std::function<bool()>;

  /// Pre: model, level and occluders are of one soup, and outlive it.
  Cell_sights(const Level_cells& level, const Occluders& occluders, const Model& model)
      : level_(&level), occluders_(&occluders), model_(&model) {}

  /// For each of the faces that the cell sees one sightline, ascending by face: from the cell's middle, the mean of its
  /// corners, where the face is seen from there, or else before the portal that a search finds it through,
  /// at least three eighths as far back as the line goes within the cell. Pre: faces ascend, and none looks into the
  /// cell. Degenerate: a face that is hidden has none. Cost: what the middle sees, and a search for each other face and
  /// portal. Errors: Out_of_budget.
  std::vector<Cell_sightline> sightlines(Cell_id cell, const std::vector<Face_id>& faces, const Is_over& is_over);

  /// What of a face is seen from a point; of no pixels: nothing. Errors: Out_of_budget.
  Seen_face seen(const Exact_point& eye, Face_id face, const Is_over& is_over);

  /// In pixels, how large a face would look from the cell's middle with nothing before it: what is drawn for nothing
  /// where the cell does not see it. 0 where it turns away from there.
  double size_alone(Cell_id cell, Face_id face) const {
    return sightline::size_alone(*model_, level_->inside(cell), face);
  }

 private:
  const std::map<Face_id, Seen_face>& seen_from(const Exact_point& eye, const Is_over& is_over);

  const Level_cells* level_;
  const Occluders* occluders_;
  const Model* model_;
  std::map<Exact_point, std::map<Face_id, Seen_face>> seen_;
};

}  // namespace sightline
