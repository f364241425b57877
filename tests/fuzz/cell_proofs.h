#pragma once
// Cells of lines by themselves: there is no proof that a cell is empty where it has a line, and of two sides there is
// one by exact multipliers iff some mixture of them is nowhere positive.

#include "any_case.h"
#include "support.h"

#include <sightline/algorithms/weak_visibility/edge_lines.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/search/cell_cuts.h>
#include <sightline/algorithms/weak_visibility/search/cell_proofs.h>
#include <sightline/algorithms/weak_visibility/search/line_cell.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/fuzz.h>
#include <sightline/kernel/line_table.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace fuzz {

/// All lines of edges between a source and a piece, and cells of them.
class Cells_of_lines {
 public:
  Cells_of_lines(const Occluders& occluders, const Weak_source& source, std::uint32_t target)
      : occluders_(&occluders),
        lines_(occluders),
        proofs_(occluders, lines_, source.plane, occluders.plane(target)),
        domain_(std::make_shared<const Near_polygon>(source.polygon),
                std::make_shared<const Near_polygon>(occluders.polygon(target))) {
    for (std::uint32_t piece = 0; piece < occluders.scene().pieces().size(); ++piece) lines_.of(piece);
  }

  /// Of the cell of a line at random, however little room it has.
  void try_with_a_line(generate::Random& random) {
    const Exact_pluecker pair = pluecker_of_pair(inner(domain_.source, random), inner(domain_.target, random));
    Line_cell cell{&domain_, &lines_, &occluders_->frame(), {}};
    for (std::uint32_t line = 0; line < lines_.size(); ++line) {
      const int sign = sgn(sightline::dot(pair, lines_[line].exact()));
      if (sign == 0 || random.chance(1, 3)) continue;
      const Side_row& row = domain_.row(lines_, line, occluders_->frame());
      require(row.decided != -sign, "a line is on a side on which polygons have none");
      if (row.decided == 0) cell.rows.push_back({cell.rows.size(), {line, sign}, &row});
    }
    if (cell.rows.empty()) return;
    ++asked;
    std::vector<Multiplier> proof;
    proofs_.relax(cell, counters);
    try_shaves(cell);
    bool is_proved = proofs_.by_relaxation(cell, proof, counters) == Cell_proofs::Relaxation::empty ||
                     proofs_.by_exact_relaxation(cell, proof, counters) || proofs_.at_corner(cell, proof, counters);
    for (const bool of_source : {true, false})
      for (const bool thoroughly : {true, false})
        is_proved = is_proved || proofs_.by_forms(cell, of_source, thoroughly, proof, counters);
    require(!is_proved, "a cell that has a line is proved empty");
  }

  /// Of any sides of two lines.
  void try_two_sides(generate::Random& random) {
    std::vector<std::uint32_t> open;
    for (std::uint32_t line = 0; line < lines_.size(); ++line)
      if (domain_.row(lines_, line, occluders_->frame()).decided == 0) open.push_back(line);
    if (open.size() < 2) return;
    random.shuffle(open);
    Line_cell cell{&domain_, &lines_, &occluders_->frame(), {}};
    for (std::size_t k = 0; k < 2; ++k)
      cell.rows.push_back(
          {k, {open[k], random.chance(1, 2) ? 1 : -1}, &domain_.row(lines_, open[k], occluders_->frame())});
    constexpr std::size_t most_bits = 100000;  // with more it is not tried
    std::size_t bits = 0;
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t c = 0; c < cell.pairs(); ++c) bits += bit_length(side_of(cell, k, c).get_num());
    if (bits > most_bits) return;
    const bool is_empty = has_mixture(cell);
    std::vector<Multiplier> proof, exact;
    proofs_.relax(cell, counters);
    const bool is_found = proofs_.by_relaxation(cell, proof, counters) == Cell_proofs::Relaxation::empty;
    require(!is_found || (is_empty && is_proof(cell, proof)), "sides that doubles combine have such a mixture");
    require(proofs_.by_exact_relaxation(cell, exact, counters) == is_empty,
            "two sides leave no line by exact multipliers iff some mixture of them is nowhere positive");
    require(!is_empty || is_proof(cell, exact), "exact multipliers are a proof");
  }

  Weak_counters counters;
  std::size_t asked = 0;  ///< cells that have a line

 private:
  /// What is shaved off, if anything is, leaves less than four fifths of the polygons, by their heights; planes are
  /// rounded to a thousandth or two.
  void try_shaves(const Line_cell& cell) {
    constexpr double most_kept = 0.8, rounding = 0.02;
    const std::vector<Cell_cut> cuts = shaves(cell, proofs_.game(), occluders_->frame(), counters);
    double kept = 1;
    for (const Cell_cut& cut : cuts) {
      const auto height = [&](const std::array<Integer, 4>& p) {
        Rational sum = 0;
        for (std::size_t k = 0; k < 4; ++k) sum += Rational(cut.plane.exact[k] * p[k]);
        return Rational(sum / p[3]);
      };
      const Near_polygon& polygon = cut.source ? domain_.source : domain_.target;
      Rational low = height(polygon[0].exact), high = low;
      for (const Near_point& p : polygon) {
        low = std::min(low, height(p.exact));
        high = std::max(high, height(p.exact));
      }
      require(low < 0 && high > 0, "a shave is across its polygon");
      kept *= nearest_double(Rational(high / (high - low)));
    }
    require(cuts.empty() || kept < most_kept + rounding, "shaves leave less than four fifths");
  }

  /// A point inside a polygon, by weights that are often of very different sizes.
  static std::array<Integer, 4> inner(const Near_polygon& polygon, generate::Random& random) {
    const std::uint64_t unequal = random.chance(1, 2) ? 1 : 40;
    std::array<Integer, 4> sum{0, 0, 0, 0};
    Integer common = 1;
    for (const Near_point& p : polygon) common *= p.exact[3];
    for (const Near_point& p : polygon) {
      const Integer any = Integer(static_cast<unsigned long>(1 + random.below(1000))) << random.below(unequal);
      for (std::size_t k = 0; k < 4; ++k) sum[k] += any * (common / p.exact[3]) * p.exact[k];
    }
    return sum;
  }

  Rational side_of(const Line_cell& cell, std::size_t row, std::size_t c) {
    const Literal& literal = cell.rows[row].literal;
    return Rational(literal.sign * domain_.exact_sides(lines_, literal.line, occluders_->frame())[c]);
  }

  /// Whether t a + (1 - t) b is nowhere positive for some t of [0, 1], of two rows a and b.
  bool has_mixture(const Line_cell& cell) {
    Rational least = 0, most = 1;
    for (std::size_t c = 0; c < cell.pairs(); ++c) {
      const Rational a = side_of(cell, 0, c), b = side_of(cell, 1, c), slope = a - b;
      if (slope == 0 && b > 0) return false;
      if (slope == 0) continue;
      const Rational at = -b / slope;
      if (slope > 0 && at < most) most = at;
      if (slope < 0 && at > least) least = at;
    }
    return least <= most;
  }

  bool is_proof(const Line_cell& cell, const std::vector<Multiplier>& proof) {
    for (std::size_t c = 0; c < cell.pairs(); ++c) {
      Rational sum = 0;
      for (const Multiplier& m : proof) sum += m.factor * side_of(cell, m.place, c);
      if (sum > 0) return false;
    }
    return !proof.empty() && std::all_of(proof.begin(), proof.end(), [](const Multiplier& m) { return m.factor > 0; });
  }

  const Occluders* occluders_;
  Edge_lines lines_;
  Cell_proofs proofs_;
  Line_domain domain_;
};

inline void cell_proofs(std::string_view bytes) {
  constexpr std::size_t most_pieces = 12;
  constexpr int turns = 12;
  Bytes from(bytes);
  generate::Random random(from.word());
  const harness::Posed_scene posed = harness::make(any_case(random));
  if (posed.source.empty()) return;
  const Scene scene(posed.soup);
  if (scene.pieces().empty() || scene.pieces().size() > most_pieces) return;
  const Occluders occluders(scene);
  const Weak_source source = weak_source(occluders, posed.source);
  const auto piece = static_cast<std::uint32_t>(random.below(scene.pieces().size()));
  const Near_polygon target = occluders.polygon(piece);
  const auto is_in_front = [](const Near_plane& plane, const Near_polygon& polygon) {
    return std::all_of(polygon.begin(), polygon.end(), [&](const Near_point& p) { return side(plane, p) >= 0; });
  };
  // As a search has them: each in front of the other.
  if (!is_in_front(source.plane, target) || !is_in_front(occluders.plane(piece), source.polygon)) return;
  Cells_of_lines cells(occluders, source, piece);
  for (int k = 0; k < turns; ++k) {
    cells.try_with_a_line(random);
    cells.try_two_sides(random);
  }
}

}  // namespace fuzz
