#pragma once
// Proofs that a cell holds no line: multipliers of its path's sides whose sum is nowhere positive.

#include <sightline/algorithms/weak_visibility/edge_lines.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/search/line_cell.h>
#include <sightline/algorithms/weak_visibility/search/matrix_game.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/kernel/line_table.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace sightline {

/// A side of the path, times a factor, times forms that are not negative on the source or on the target.
struct Multiplier {
  std::size_t place;  ///< of the path
  Rational factor;
  std::optional<Weak_step::Form> source = {}, target = {};
};

/// Looks for such proofs. Doubles propose; each proof that is returned is checked in integers, or in doubles with their
/// errors. Proof: P-71
class Cell_proofs {
 public:
  enum class Relaxation {
    empty,
    has_room,  ///< by the basis that doubles ended with, which in thin cells may be a wrong one: no proof
    unclear
  };

  Cell_proofs(const Occluders& occluders, const Edge_lines& lines, const Near_plane& source_plane,
              const Near_plane& target_plane, std::function<bool()> out_of_time = {})
      : occluders_(&occluders),
        lines_(&lines),
        planes_{&source_plane, &target_plane},
        out_of_time_(std::move(out_of_time)) {
    exact_game_.end_when(out_of_time_);
  }

  /// The relaxation in doubles, weights for all pairs of vertices at once: its value, and the game itself.
  double relax(const Line_cell& cell, Weak_counters& counters);
  Matrix_game<double>& game() { return game_; }

  /// What the relaxation's weights, or its basis, prove. Pre: relax() for this cell.
  Relaxation by_relaxation(const Line_cell& cell, std::vector<Multiplier>& proof, Weak_counters& counters) const;

  /// The relaxation in rationals: a proof where its value is not positive. It is not tried where entries are many or
  /// long.
  bool by_exact_relaxation(const Line_cell& cell, std::vector<Multiplier>& proof, Weak_counters& counters);

  /// Three lines through a point v, of the scene or not, with directions d1, d2, d3: p - v is c1 d1 + c2 d2 + c3 d3
  /// with forms c in p, and as p, v and the line are in one plane, c1 h1 + c2 h2 + c3 h3 is 0 for all p and q. Where
  /// the signs on the path and those of the forms, on the source or on the target, are such that no term is negative,
  /// no line is in the cell. Corners of boxes are like that. Proof: P-71c
  bool at_corner(const Line_cell& cell, std::vector<Multiplier>& proof, Weak_counters& counters);

  /// Multipliers that are forms: the path's sides times the forms of the polygon's edges, which are not negative on it.
  /// A sum of such products is of degree two in one of the points; it is not positive where its coefficients, for pairs
  /// of vertices of that polygon and a vertex of the other, are not. `thoroughly`: small programs of which doubles say
  /// that the value is about 0 are solved in rationals, the first few of them. Proof: P-71d
  bool by_forms(const Line_cell& cell, bool source, bool thoroughly, std::vector<Multiplier>& proof,
                Weak_counters& counters);

 private:
  // Of programs of forms that are solved in rationals: how many, and how long their entries are; each takes a tenth of
  // a second at most.
  static constexpr std::size_t most_exact_games = 16, most_bits = 250000;

  struct Weighted {
    std::size_t row;
    double near;
    Rational exact;
  };
  /// A polygon's edges as forms, not negative on it; their values on its vertices, and the largest of each.
  struct Edge_forms {
    std::vector<Weak_step::Form> forms;
    std::vector<std::vector<Rational>> heights;
    std::vector<Rational> most;
  };

  const Edge_lines::Edge_line& line_of(const Line_cell& cell, std::size_t row) const {
    return (*lines_)[cell.rows[row].literal.line];
  }

  static bool conclude(const Line_cell& cell, const std::vector<Weighted>& proposal, std::vector<Multiplier>& proof);
  /// Whether the weighted sum of rows is negative on all pairs of vertices, for certain: rows within their errors,
  /// products and sums within 2^-53 of their sizes, each.
  static bool is_proof_in_doubles(const Line_cell& cell, const std::vector<Weighted>& weights);
  static bool is_proof(const Line_cell& cell, const std::vector<Weighted>& weights);

  bool corner_proof(const Line_cell& cell, const std::array<std::size_t, 3>& rows, bool source,
                    std::vector<Multiplier>& proof) const;

  /// False where the polygon is not convex, or turns the other way round than its plane says: then the forms would be
  /// no multipliers.
  static bool edges_of(const Near_polygon& polygon, const Near_plane& plane, Edge_forms& edges);
  /// A plane through an edge, upright on the polygon's plane, the polygon in front. It is zero on the edge.
  static Weak_step::Form form_of(const Near_polygon& polygon, std::size_t edge, const Near_plane& plane);

  class Form_products;
  using Row_weights = std::vector<std::pair<std::size_t, Rational>>;
  /// Exact weights of products under which hardly a sum is positive, if any, as the game says that ended with `result`:
  /// those of its basis, or, where there is room, its very doubles. Empty where there are none.
  Row_weights form_weights(const Form_products& products, const Edge_forms& edges, double result, bool thoroughly);

  const Occluders* occluders_;
  const Edge_lines* lines_;
  std::array<const Near_plane*, 2> planes_;  // of source and target
  std::function<bool()> out_of_time_;
  Matrix_game<double> game_, wide_;
  Matrix_game<Rational> exact_game_;
  std::size_t exact_games_ = 0;  // of forms, that were tried
};

}  // namespace sightline
