#pragma once
// Whether an eye sees a piece at one moment, and how long the reasons for that stay true.

#include <sightline/algorithms/weak_visibility/along/piece_view.h>
#include <sightline/kernel/counters.h>

#include <array>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sightline {

struct Along_counters {
  std::uint64_t pieces = 0, runs = 0, witnesses = 0, parts = 0, signs = 0, exact_signs = 0;
  template <class Visit>
  static void each(Visit visit) {
    visit("pieces", &Along_counters::pieces);
    visit("runs", &Along_counters::runs);
    visit("witnesses", &Along_counters::witnesses);
    visit("parts", &Along_counters::parts);
    visit("signs", &Along_counters::signs);
    visit("exact_signs", &Along_counters::exact_signs);
  }
};

/// A cut of a cone, first the part on this side, then the other one; or what covers a cone.
struct Along_step {
  bool is_cut;
  Line_side cut;
  std::uint32_t blocker;
};

/// A run cuts the piece along edges, as the eye sees them, until a part is beside all that is in front, or all parts
/// are behind something. All that it rests on are signs of quadratics in t, so its answer is true as far as none of
/// these has a root. Doubles choose what is cut, and know most signs of a range. It refers to the view. Exact: yes.
/// Proof: P-87
class Piece_run {
 public:
  using Cone = Eye_cone;
  using Blockers = Piece_view::Blockers;

  explicit Piece_run(const Piece_view& view) : view_(&view) {}

  struct Answer {
    bool seen, sure;
    Parameter_range range;
    Cone part;                      ///< what is seen, or none
    std::vector<Along_step> steps;  ///< in preorder, where nothing is
  };
  /// At t, true in the answer's range; not sure where a sign that it needs is zero at t alone.
  Answer run(const Quadratic_root& t, const Parameter_range& range, const Blockers& all);
  /// Of a cone, in doubles, in the run at hand.
  std::vector<Triple> rays(const Cone& cone);

  /// Of determinants that were zero at the ends of answers *seen*: the end, and the three lines.
  const std::vector<std::pair<Quadratic_root, std::array<std::uint32_t, 3>>>& zeros() const { return zeros_; }
  Along_counters& counters() { return counters_; }

 private:
  static constexpr std::uint32_t no_line = ~std::uint32_t{0};
  struct Fact {
    const Quadratic* sign;
    std::array<std::uint32_t, 3> lines;  ///< `no_line`: it is no determinant
  };
  struct Seen_line {  // in the run at hand
    unsigned run = 0;
    Near<3> low, high;
    Triple now;
  };
  struct Guess {
    enum { covers, beside, beside_side, across } kind;
    std::size_t edge;
  };

  const Eye_line& line(std::uint32_t number) const { return view_->line(number); }
  /// Whether some part of a cone is beside all blockers; `left` are those that may be in front of it.
  bool find(const Cone& cone, const Blockers& left, Cone& found);
  const Seen_line& seen(std::uint32_t line);
  int sign(std::uint32_t i, std::uint32_t j, std::uint32_t k);
  /// The sign that three lines' determinant has throughout the range; 0 where doubles do not tell.
  int certain(std::uint32_t i, std::uint32_t j, std::uint32_t k);
  /// The sign of f at the moment of the run: a fact that the answer rests on.
  int note(const Quadratic& f, const std::array<std::uint32_t, 3>& lines);
  /// Of each ray of a cone, to a line.
  std::vector<int> signs(const Cone& cone, const Line_side& side);
  bool covers(std::uint32_t blocker, const Cone& cone);
  bool is_beside(std::uint32_t blocker, const Cone& cone);
  bool is_outside(std::uint32_t blocker, std::size_t edge, const Cone& cone);
  bool is_beyond_side(std::uint32_t blocker, const Line_side& side);
  /// In doubles: what to try. Exact: no
  Guess guess(std::uint32_t blocker, const Cone& cone, const std::vector<Triple>& rays);
  Line_side inside(std::uint32_t blocker, std::size_t edge) const;
  static Cone clip(const Cone& cone, const std::vector<int>& signs, const Line_side& side);

  const Piece_view* view_;
  std::unordered_map<std::uint64_t, Quadratic> determinants_;
  std::vector<Seen_line> seen_;  // by line, once there is a run
  std::vector<std::pair<Quadratic_root, std::array<std::uint32_t, 3>>> zeros_;

  // The run at hand.
  unsigned run_ = 0;
  const Quadratic_root* now_ = nullptr;
  Near<4> low_, high_, middle_;
  bool at_once_ = false, unlucky_ = false;
  Blockers all_;
  std::vector<int> front_;  // by blocker: the eye's side of it
  std::vector<Fact> facts_;
  std::vector<Along_step> steps_;
  std::deque<Quadratic> linear_;
  Along_counters counters_;
};

}  // namespace sightline
