#pragma once
// What is said of faces, and what proves it: the answer to a pair of a source and a piece, the lists of faces; and what
// a search among lines was asked, and counted.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/kernel/counters.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace sightline {

enum class Weak_status : char { hidden, visible, undecided };

/// What a search modelled.
struct Weak_counters {
  std::size_t targets = 0;  ///< pairs of a source and a piece
  std::size_t away = 0;     ///< of these, facing away from each other, all of them
  std::size_t by_rays = 0;  ///< of these, seen along one of the first few lines
  std::size_t by_one = 0;  ///< of these, or of their parts where the plane of one passes the other, hidden by one piece
  std::size_t together = 0;  ///< of these, hidden with others in their plane by one search among all lines to a polygon
                             ///< that holds them
  std::size_t polygons = 0;  ///< such polygons that were searched
  std::size_t occluders = 0;  ///< pieces near the shafts, summed over pairs
  std::size_t cells = 0, cuts = 0, shaves = 0, bisections = 0, blocked = 0, empty = 0, corners = 0, learned = 0,
              jumps = 0;
  std::size_t programs = 0, exact_programs = 0, form_programs = 0, by_forms = 0, confirmed = 0,
              refuted = 0;  ///< `confirmed`, `refuted`: lines proposed in doubles, by the exact test
  std::size_t lines = 0, open = 0, deepest = 0;

  /// Each by its key in reports, in their order.
  template <class Visit>
  static void each(Visit visit) {
    visit("searches", &Weak_counters::targets);
    visit("away", &Weak_counters::away);
    visit("by_rays", &Weak_counters::by_rays);
    visit("by_one", &Weak_counters::by_one);
    visit("together", &Weak_counters::together);
    visit("polygons", &Weak_counters::polygons);
    visit("occluders", &Weak_counters::occluders);
    visit("cells", &Weak_counters::cells);
    visit("cuts", &Weak_counters::cuts);
    visit("shaves", &Weak_counters::shaves);
    visit("bisections", &Weak_counters::bisections);
    visit("blocked", &Weak_counters::blocked);
    visit("empty", &Weak_counters::empty);
    visit("", &Weak_counters::corners);
    visit("learned", &Weak_counters::learned);
    visit("jumps", &Weak_counters::jumps);
    visit("programs", &Weak_counters::programs);
    visit("exact_programs", &Weak_counters::exact_programs);
    visit("", &Weak_counters::form_programs);
    visit("", &Weak_counters::by_forms);
    visit("confirmed", &Weak_counters::confirmed);
    visit("refuted", &Weak_counters::refuted);
    visit("lines", &Weak_counters::lines);
    visit("open", &Weak_counters::open);
    visit("deepest", &Weak_counters::deepest, Largest{});
  }
};

/// One step of a proof that no line is free, in the order of a walk that takes a node before its two parts. P-72 says
/// what they mean.
struct Weak_step {
  enum class Kind : char { line, cut_source, cut_target, blocked, empty, away, open };
  using Form = std::array<Integer, 4>;  ///< in grid coordinates
  struct Term {
    std::uint32_t line;
    Rational factor;
    std::optional<Form> source, target;  ///< forms that are not negative there, to be multiplied too
  };
  Kind kind;
  std::uint32_t index = 0;         ///< of a line of the proof, or of a piece
  std::array<Integer, 4> plane{};  ///< of a cut, in grid coordinates
  std::vector<Term> terms;
};

/// A line that proofs speak of, by an edge that lies on it.
struct Weak_line {
  std::uint32_t piece, corner;
};

/// A proof that nothing is seen of a convex polygon, nor of the pieces in its plane that it holds.
struct Shared_proof {
  Near_polygon target;
  std::vector<Weak_step> proof;
  std::vector<Weak_line> lines;
};

struct Weak_answer {
  Weak_status status = Weak_status::undecided;
  std::vector<Near_point> sightline;  ///< where visible: two points, strictly inside source and target; else none, as
                                      ///< hidden pairs are many
  std::vector<Weak_step> proof;       ///< where hidden; where undecided with steps that are `open`
  std::vector<Weak_line> lines;
  /// Where hidden together with other pieces of its plane: what hides them all, and `proof` is empty.
  std::shared_ptr<const Shared_proof> shared = {};

  const std::vector<Weak_step>& all_steps() const { return shared ? shared->proof : proof; }
  const std::vector<Weak_line>& all_lines() const { return shared ? shared->lines : lines; }
};

/// An answer that says nothing: all lines are open.
inline Weak_answer nothing_known() {
  Weak_answer answer;
  answer.proof.push_back({Weak_step::Kind::open, 0, {}, {}});
  return answer;
}

/// The answer where a source and a piece look away from each other.
inline Weak_answer facing_away() {
  Weak_answer answer;
  answer.status = Weak_status::hidden;
  answer.proof.push_back({Weak_step::Kind::away, 0, {}, {}});
  return answer;
}

/// The answer where one piece blocks all lines.
inline Weak_answer blocked_by(std::uint32_t piece) {
  Weak_answer answer;
  answer.status = Weak_status::hidden;
  answer.proof.push_back({Weak_step::Kind::blocked, piece, {}, {}});
  return answer;
}

struct Weak_search_options {
  bool two_sided = false;
  std::size_t cells = 200000;  ///< that a search may take; then `undecided`
  /// Cells that may stay open; then it ends: only a line could decide any more, and events find that sooner.
  std::size_t open = 8;
  int bisections = 12;  ///< how often, one in another, a cell is halved that has neither a line nor a proof
  int rays = 24;        ///< lines that are tried before the search
  std::uint64_t seed = 1;
  std::function<bool()> out_of_time;  ///< asked before each cell; then what is left is undecided
  /// By dearer means, for pairs of which another search left cells open: cells are cut at once by planes that edges
  /// share, and by those through lines that they touch; programs are exact, and lines are looked for in cells that are
  /// thinner than what doubles tell apart. Proof: P-71h
  bool thorough = false;
};

// ---- Of all faces

/// Every kept face is in one of the three lists, which are sorted.
struct Weak_faces {
  std::vector<Face_id> visible, hidden, undecided;

  std::vector<Face_id>& of(Weak_status status) {
    return status == Weak_status::visible ? visible : status == Weak_status::hidden ? hidden : undecided;
  }
};

/// What was found, and what proves it.
struct Weakly_visible : Weak_faces {
  struct Pair {
    std::uint32_t piece, source;
    Weak_answer answer;
  };
  std::vector<Pair> pairs;  ///< of a visible face the one pair with a sightline, of a hidden one all pairs; faces in
                            ///< order, then pieces, then sources
  std::vector<Pair> open;   ///< of an undecided face the pairs that are so, in the same order
  std::vector<Face_id> unproved;  ///< faces among the visible and the hidden ones that no pairs prove, sorted: other
                                  ///< methods leave some, weakly_visible() none
  Weak_counters counters;
};

/// The first piece of each face that is kept; pieces of a face are neighbours.
std::vector<std::uint32_t> first_pieces(const std::vector<Piece>& pieces);

/// Calls decide(f, begin, end) for each kept face, the f-th in order, of the pieces from `begin` to before `end`: on so
/// many threads, in any order. After each, progress(done, all) by any thread.
void for_each_face(const std::vector<Piece>& pieces, const std::vector<std::uint32_t>& first, int threads,
                   const std::function<void(std::size_t, std::size_t)>& progress,
                   const std::function<void(std::size_t f, std::uint32_t begin, std::uint32_t end)>& decide);

}  // namespace sightline
