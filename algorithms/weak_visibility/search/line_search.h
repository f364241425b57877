#pragma once
// Whether a convex polygon is weakly visible from another one: a search among the lines between them, by the sides on
// which they pass edges.

#include <sightline/algorithms/weak_visibility/edge_lines.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/search/cell_cuts.h>
#include <sightline/algorithms/weak_visibility/search/cell_line.h>
#include <sightline/algorithms/weak_visibility/search/cell_proofs.h>
#include <sightline/algorithms/weak_visibility/search/line_cell.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/time_limit.h>

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <vector>

namespace sightline {

/// One search: source and target are convex, in grid coordinates. Which lines are blocked by a piece is a conjunction
/// of the signs of its edge lines; "hidden" says that such conjunctions cover all lines between the polygons but for a
/// set of measure zero. The search takes a line of the cell that it is in, and a piece that blocks it; cuts the
/// polygons where they cross that piece's plane; and goes on, edge by edge, to the lines that pass the piece outside of
/// it. A cell ends where a piece blocks all of it, or where multipliers show that it has no line. Doubles propose, each
/// step is checked in integers before it is believed. Lines are known by name, so that edges shared by faces,
/// T-junctions and abutting faces make one variable. Cost: exponential at worst, bounded by the options. Exact: yes, or
/// undecided. Ref: design.md, sections 4 and 5. Proof: P-70, P-71, P-72
class Line_search {
 public:
  Line_search(const Occluders& occluders, Near_polygon source, const Near_plane& source_plane, Near_polygon target,
              std::uint32_t target_piece, const Weak_search_options& options);
  /// The target is a convex polygon of no face, in a plane whose front is to be looked at; pieces in that plane hide
  /// nothing. `salt`: beside the seed, for lines that are tried. Proof: P-90
  Line_search(const Occluders& occluders, Near_polygon source, const Near_plane& source_plane, Near_polygon target,
              const Near_plane& target_plane, const Weak_search_options& options, std::uint64_t salt = 0);
  Line_search(const Line_search&) = delete;

  Weak_answer run(Weak_counters& counters);
  /// What run() says before it searches cells, if that is enough: whether the polygons are away from each other, one
  /// piece hides it all, or one of the first lines sees. Else nothing, and nothing is counted.
  std::optional<Weak_answer> first_answer(Weak_counters& counters);
  /// Whether that was not enough, and run() goes on where it ended; else it has to be asked of another search.
  bool can_go_on() const { return waits_; }
  /// About how many bytes it takes to keep, mostly of candidates and of pairs of corners.
  std::size_t bytes() const;
  /// A sightline beside another line, if one of a few is free. It asks no more than that, and nothing where the plane
  /// of source or target passes the other one. Pre: both are in front of the other's plane, or across it.
  std::optional<std::array<Near_point, 2>> beside(const Triple& p, const Triple& q, Weak_counters& counters);

 private:
  using Used = std::bitset<256>;  // places of the path; beyond that nothing is left out
  struct Refutation {
    Weak_status status;
    std::uint32_t node = 0;
    Used used;
  };
  struct Node {
    Weak_step step;
    std::array<std::uint32_t, 2>
        parts{};  // for lines: where the side is positive, where it is negative; for cuts: in front, behind
  };
  struct Lemma {
    std::vector<Weak_step::Term> terms;
    std::vector<Literal> literals;
  };
  /// An edge of a blocking piece, and the sign that its line has inside.
  struct Edge_sign {
    std::uint32_t line;
    int inside;
  };

  Weak_answer answer_of(const Refutation& found);

  // ---- From the whole to the first cell

  /// Leaves only what source and target have in front of each other, looks for one piece between all of it, tries some
  /// lines, then searches; not among more than `most_pairs`.
  Refutation begin(std::uint32_t d);

  /// A piece that blocks all of a domain's lines, if one of those that the line of middles meets does. Proof: P-71
  std::optional<std::uint32_t> whole_blocker(Line_domain& domain) const;

  /// Whether both points are off a piece's plane, in doubles: else the piece may only touch their segment's end.
  bool is_between(std::uint32_t piece, const Triple& p, const Triple& q) const;

  /// Whether a line that needs no candidates is free.
  bool is_seen_along(const Line_domain& domain, const Line_weights& line);
  /// Whether one of a few lines that need no candidates is free: that of middles, and some where the polygons are near.
  bool try_lines(const Line_domain& domain);

  /// What may come between the polygons of a domain. Many domains end without that question.
  const std::vector<Candidate>& candidates_of(std::uint32_t d);
  /// Forgets candidates that cannot come between, and notes from which side the others do.
  void settle(Line_domain& domain) const;

  /// Whether one of some lines is free, to begin with that of middles. Notes how much each candidate blocks, by the
  /// first of them; the fewer candidates, the fewer samples.
  bool try_rays(std::uint32_t d);
  /// The higher the power, the nearer to a pair of vertices.
  Line_weights random_line(const Line_domain& domain, int power = 3);

  // ---- A cell

  Refutation refute(std::uint32_t d, std::size_t depth);

  bool out_of_time() const { return has_run_out(options_->out_of_time); }
  Refutation open();
  Refutation leaf(Weak_step step, Used used);

  template <class Part>
  Refutation cut(std::uint32_t d, const Cell_cut& by, Part part);

  /// A cell with neither a line nor a proof: its polygons are too large for what is left of it. First cuts off what the
  /// relaxation shows to hold none of its lines, edge by edge; if that is little, halves the longer one of the two
  /// polygons.
  Refutation narrow(std::uint32_t d, std::size_t depth);
  Refutation shave(std::uint32_t d, const std::vector<Cell_cut>& cuts, std::size_t k, std::size_t depth);
  Refutation bisect(std::uint32_t d, std::size_t depth);

  /// The lines that pass the piece outside an edge, edge by edge; what is left is blocked.
  Refutation branch(std::uint32_t d, const Candidate& blocker, const std::vector<Edge_sign>& unknown,
                    std::size_t depth);
  /// A branching as a node, from what its edges' outsides and the rest came to.
  Refutation put_together(const std::vector<Edge_sign>& edges, const std::vector<Refutation>& outside, Refutation rest);

  void push(const Literal& literal) {
    path_.push_back(literal);
    sign_[literal.line] = literal.sign;
  }
  void pop() {
    sign_[path_.back().line] = 0;
    path_.pop_back();
  }

  // ---- Blockers

  const std::vector<Edge_lines::Edge>& edge_lines(std::uint32_t piece);
  const Side_row& row(Line_domain& domain, std::uint32_t line) const {
    return domain.row(lines_, line, occluders_->frame());
  }

  /// Whether a line, from p to q, meets a piece, by doubles. Close to an edge, its own row of the domain tells more.
  bool is_in_the_way(Line_domain& domain, const Line_weights& line, const Triple& p, const Triple& q,
                     const Pluecker& pluecker, Candidate& candidate);
  /// The candidates that a line meets, in order, while `visit` says so.
  template <class Visit>
  void for_each_blocker(Line_domain& domain, const Line_weights& line, Visit visit);
  /// All of them, by their numbers. Senses are those that the domain has.
  void find_blockers(std::uint32_t d, const Line_weights& line, std::vector<Candidate>& blockers);
  double height_of(Line_domain& domain, std::uint32_t line, const Line_weights& weights) const;

  /// The blocker with the fewest edges that are not known to have the line inside; some more are worth it for one that
  /// blocks much. One that is cut first comes last. Post: those that block more come first.
  const Candidate* choose(Line_domain& domain, std::vector<Candidate>& blockers, std::vector<Edge_sign>& unknown);
  std::vector<Edge_sign> signs_of(const Candidate& blocker);

  // ---- A line of the cell, or none

  enum class Look { found, ended, unclear };

  Look look_for_line(std::uint32_t d, Line_weights& line, Refutation& ended);
  /// From the relaxation's weights, from the middle, and from pairs of vertices that have much weight.
  std::vector<Line_weights> starts_of(const Line_domain& domain);

  // ---- What is learned

  bool by_lemma(Refutation& ended);

  /// A leaf by multipliers that have been checked, and a lemma for cells to come.
  Refutation conclude(const std::vector<Multiplier>& multipliers);
  /// All but the first so many.
  void forget_lemmas(std::size_t kept);

  // ---- A line that nothing blocks

  /// Takes a proposed line, with few bits, then with more, and moved a little, to the exact test. Returns a piece that
  /// is in the way, or none.
  std::optional<std::uint32_t> confirm(const Line_domain& domain, const Line_weights& line);
  /// Pre: positive weights.
  Near_point inner_point(const Near_polygon& polygon, const std::vector<Integer>& weights) const;

  std::vector<Weak_step> in_order(std::uint32_t root) const;

  const Occluders* occluders_;
  const Near_plane *source_plane_, *target_plane_;
  const Weak_search_options* options_;
  std::mt19937_64 dice_;
  Weak_counters* counters_ = nullptr;
  std::vector<std::unique_ptr<Line_domain>> domains_;  // none where all has been said of it
  std::vector<std::uint32_t> parents_{0};              // of domains: what they are parts of
  Edge_lines lines_;
  std::vector<int> sign_;  // of lines on the path
  std::vector<Literal> path_;
  Line_cell cell_;  // that was looked at last
  Line_finder finder_;
  Cell_proofs proofs_;
  std::vector<Lemma> lemmas_;
  std::vector<std::vector<std::uint32_t>> lemmas_of_;
  std::vector<Node> nodes_;
  bool only_first_ = false, waits_ = false;  // first_answer() is asked; it was, and a search is to begin with the whole
  Weak_counters first_counters_;
  bool facing_ = false;  // whether some part of source and target look to each other
  std::array<Near_point, 2> sightline_;
  std::size_t cells_ = 0, open_ = 0;
};

}  // namespace sightline
