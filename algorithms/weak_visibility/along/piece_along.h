#pragma once
// When one piece is seen by an eye that moves along a segment: by runs that prove how long their answer stays true.

#include <sightline/algorithms/weak_visibility/along/along_scene.h>
#include <sightline/algorithms/weak_visibility/along/piece_cause.h>
#include <sightline/algorithms/weak_visibility/along/piece_run.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace sightline {

/// What proves for a while whether a piece is seen; the moments of the proof are this range.
struct Along_proof {
  Parameter_range range;
  Along_certificate::Proof proof;
};

/// When an eye sees one piece from one side. Runs, and what single points of the piece see for a while, leave less and
/// less of a range. Exact: yes. Proof: P-87
class Piece_along {
 public:
  /// `side`: 1 from the front, -1 from behind. `with_proofs`: what is_seen_at() and seen_within() say is kept as
  /// proofs.
  Piece_along(const Along_scene& scene, std::uint32_t piece, int side, bool with_proofs);

  /// Whether it is seen at a moment, by the law, also where the eye is on other faces.
  bool is_seen_at(const Quadratic_root& t);
  /// When it is seen within a range in which the eye is on no face: in order, disjoint, each as long as it can be.
  std::vector<Parameter_range> seen_within(const Parameter_range& range);
  /// Whether the eye is in its plane.
  bool is_edge_on(const Quadratic_root& t) const { return view_->side_of_eye(t) == 0; }
  /// Why a range of seen_within() ends there, of its two ends. Pre: the eye is on no face then.
  Along_cause cause(const Quadratic_root& end, const Parameter_range& seen);
  const Along_counters& counters() const { return run_->counters(); }
  const std::vector<Along_proof>& proofs() const { return proofs_; }

 private:
  using Blockers = Piece_view::Blockers;
  /// Determinants that are zero at an end of a range, of those that the run next to it rests on: their lines.
  std::vector<std::array<std::uint32_t, 3>> zero_at(const Quadratic_root& end, const Parameter_range& seen);
  /// What one point of a part of it, at t, sees in a range.
  std::vector<Parameter_range> seen_from_within(const Eye_cone& part, const Rational& t, const Parameter_range& range,
                                                const Blockers& blockers);

  void keep(const Piece_run::Answer& answer);

  bool with_proofs_;
  std::vector<Along_proof> proofs_;
  std::unique_ptr<const Piece_view> view_;
  std::unique_ptr<Piece_run> run_;
};

}  // namespace sightline
