#pragma once
// What a search among lines says, and what it was asked: the answer with its proof, the options, the counters.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace sightline {

enum class Weak_status : char { hidden, visible, undecided };

/// What a search modelled.
struct Weak_counters {
  std::size_t targets = 0;    ///< pairs of a source and a piece
  std::size_t away = 0;       ///< of these, facing away from each other
  std::size_t by_rays = 0;    ///< of these, seen along one of the first few lines
  std::size_t occluders = 0;  ///< pieces near the shafts, summed over pairs
  std::size_t cells = 0, cuts = 0, shaves = 0, bisections = 0, blocked = 0, empty = 0, corners = 0, learned = 0,
              jumps = 0;
  std::size_t programs = 0, exact_programs = 0, form_programs = 0, by_forms = 0, confirmed = 0,
              refuted = 0;  ///< `confirmed`, `refuted`: lines proposed in doubles, by the exact test
  std::size_t lines = 0, open = 0, deepest = 0;

  Weak_counters& operator+=(const Weak_counters& o);
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

struct Weak_answer {
  Weak_status status = Weak_status::undecided;
  std::array<Near_point, 2> sightline;  ///< where visible: strictly inside source and target
  std::vector<Weak_step> proof;         ///< where hidden; where undecided with steps that are `open`
  std::vector<Weak_line> lines;
};

struct Weak_search_options {
  bool two_sided = false;
  std::size_t cells = 200000;  ///< that a search may take; then `undecided`
  std::size_t open =
      8;  ///< cells that may stay open; then it ends: only a line could decide any more, and events find that sooner
  int bisections = 12;  ///< how often, one in another, a cell is halved that has neither a line nor a proof
  int rays = 24;        ///< lines that are tried before the search
  std::uint64_t seed = 1;
  std::function<bool()> out_of_time;  ///< asked now and then
};

}  // namespace sightline
