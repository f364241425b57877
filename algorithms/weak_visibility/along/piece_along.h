#pragma once
// When one piece is seen by an eye that moves along a segment: by runs that prove how long their answer stays true.

#include <sightline/algorithms/weak_visibility/along/moving_eye.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/kernel/counters.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

namespace sightline {

/// A line on one of its sides: directions whose product with `sign` times its normal is positive.
struct Line_side {
  std::uint32_t line;
  int sign;
};

/// A convex polygon before the eye: a piece, or the part of one in front of a plane.
struct Eye_polygon {
  std::uint32_t piece;
  std::vector<Near_point> corners;
  /// From each corner to the next. Seen from behind the polygon's inside is where they all are positive, from the front
  /// where they are negative.
  std::vector<Line_side> edges;
  Quadratic eye_side;  ///< of the eye to its plane: linear
  double size;         ///< the square of twice its area, in doubles: large ones are tried first
};

/// What all searches of one path share: the pieces that can be seen or hide something at all. Pieces whose plane holds
/// the path are none. It refers to the occluders.
class Along_scene {
 public:
  Along_scene(const Occluders& occluders, const Exact_point& from, const Exact_point& to);
  explicit Along_scene(Occluders&&, const Exact_point&, const Exact_point&) = delete;

  const Occluders& occluders() const { return *occluders_; }
  const Moving_eye& eye() const { return eye_; }
  const std::vector<Eye_line>& lines() const { return lines_; }
  /// The number of a line, if it is one of the scene's.
  const std::map<Exact_pluecker, std::uint32_t, Less_entries>& numbers() const { return numbers_; }
  /// By piece; without corners where the path is in its plane.
  const std::vector<Eye_polygon>& polygons() const { return polygons_; }
  /// An edge on each line: its piece and corner.
  const std::array<std::uint32_t, 2>& edge(std::uint32_t line) const { return edges_[line]; }
  /// When the eye is on a closed piece, in order, with 0 and 1.
  const std::vector<Rational>& contacts() const { return contacts_; }

 private:
  bool is_on(const Eye_polygon& polygon, const Homogeneous& eye) const;

  const Occluders* occluders_;
  Moving_eye eye_;
  std::vector<Eye_line> lines_;
  std::vector<std::array<std::uint32_t, 2>> edges_;
  std::map<Exact_pluecker, std::uint32_t, Less_entries> numbers_;
  std::vector<Eye_polygon> polygons_;
  std::vector<Rational> contacts_;
};

enum class Along_kind : std::uint8_t {
  plane,        ///< the eye passes the face's plane
  contact,      ///< the eye is on a face
  edge_vertex,  ///< two of the edges are in a plane
  triple        ///< three edges, no two in a plane
};
/// Why something changes: the lines that the eye sees through one point.
struct Along_cause {
  Along_kind kind = Along_kind::plane;
  std::vector<std::uint32_t> lines;
};

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

/// When an eye sees one piece from one side. A run, at one moment, cuts the piece along edges as the eye sees them
/// until a part is beside all that is in front, or all parts are behind something. All that it rests on are signs of
/// quadratics in t, so its answer is true as far as none of these has a root. Doubles choose what is cut, and know most
/// signs of a range. Exact: yes. Proof: P-87
class Piece_along {
 public:
  /// `side`: 1 from the front, -1 from behind.
  Piece_along(const Along_scene& scene, std::uint32_t piece, int side);
  Piece_along(const Piece_along&) = delete;
  Piece_along(Piece_along&&) = default;

  /// Whether it is seen at a moment, by the law, also where the eye is on other faces.
  bool is_seen_at(const Quadratic_root& t);
  /// When it is seen within a range in which the eye is on no face: in order, disjoint, each as long as it can be.
  std::vector<Parameter_range> seen_within(const Parameter_range& range);
  /// Why a range of seen_within() ends there: what the runs beside it rest on.
  Along_cause cause(const Quadratic_root& end) const;
  const Along_counters& counters() const { return counters_; }

 private:
  using Cone = std::vector<Line_side>;  // sides in order: two consecutive ones meet in a ray, along the product of
                                        // their normals
  using Blockers = std::vector<std::uint32_t>;  // of blockers_
  struct Fact {
    const Quadratic* sign;
    std::array<std::uint32_t, 3> lines;
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

  const Eye_line& line(std::uint32_t number) const;
  std::uint32_t number_of(const Exact_pluecker& line);
  void add_blocker(std::uint32_t piece);
  /// Those that are not certainly out of the way throughout a range.
  Blockers left_in(const Parameter_range& range, const Blockers& all);
  bool is_out_of_the_way(const Eye_polygon& polygon, const Parameter_range& range);

  // ---- One run
  struct Answer {
    bool seen, sure;
    Parameter_range range;
    Cone part;
  };
  /// At t, true in the answer's range; not sure where a sign that it needs is zero at t alone.
  Answer run(const Quadratic_root& t, const Parameter_range& range, const Blockers& all);
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
  std::vector<Triple> rays(const Cone& cone);
  Line_side inside(std::uint32_t blocker, std::size_t edge) const;
  static Cone clip(const Cone& cone, const std::vector<int>& signs, const Line_side& side);

  // ---- What one point of it sees
  std::vector<Parameter_range> seen_from_within(const Cone& part, const Rational& t, const Parameter_range& range,
                                                const Blockers& blockers);

  const Along_scene* scene_;
  const Eye_polygon* target_;
  Near_plane plane_;
  int side_;
  Cone whole_;
  std::vector<const Eye_polygon*> blockers_;
  std::deque<Eye_polygon> parts_;  // blockers that are parts of pieces
  std::vector<Eye_line> own_;      // lines where blockers meet the target's plane: numbered after the scene's
  std::map<Exact_pluecker, std::uint32_t, Less_entries> own_numbers_;
  std::unordered_map<std::uint64_t, Quadratic> determinants_;
  std::vector<Seen_line> seen_;

  // The run at hand.
  unsigned run_ = 0;
  const Quadratic_root* now_ = nullptr;
  Near<4> low_, high_, middle_;
  bool at_once_ = false, unlucky_ = false;
  Blockers all_;
  std::vector<int> front_;  // by blocker: the eye's side of it
  std::vector<Fact> facts_;
  std::deque<Quadratic> linear_;
  std::vector<std::pair<Quadratic_root, std::array<std::uint32_t, 3>>> ends_;  // of runs, with a reason
  Along_counters counters_;
};

}  // namespace sightline
