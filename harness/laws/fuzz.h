#pragma once
// Random families x checks, until one fails. `sightline fuzz COMMAND`.

#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/reduce.h>
#include <sightline/harness/laws/subject.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace sightline::harness {

/// A scene of a family, by name: "FAMILY:SEED:SIZE:ULPS:X,Y,Z:POWER", scaled by 2^POWER and then moved by (X, Y, Z).
/// What follows the seed may be left out.
struct Fuzz_case {
  std::string family;
  generate::Family_parameters parameters;
  int power = 0;
};

std::string to_string(const Fuzz_case& c);

/// The case of that name, or std::invalid_argument that says what is wrong with it.
Fuzz_case parse_case(std::string_view text);

inline Posed_scene make(const Fuzz_case& c) { return generate::family(c.family).make(c.parameters); }

// ---- One scene

/// How often a check was run, and what came of it.
struct Tally {
  std::size_t passed = 0, undecided = 0, not_applicable = 0;
  std::size_t cases() const { return passed + undecided; }
};

struct Disagreement {
  std::string check, what;
};

/// Runs the subject and all its checks (or the named one) on a scene, in order, up to the first that fails. Answers are
/// checked by themselves first: "certificate", which does not apply where the subject has none. An exception is a
/// failure. `seed` is of the checks' random choices; `tell(check, outcome)` is told of each.
template <class Tell>
std::optional<Disagreement> first_disagreement(const Subject& subject, const Posed_scene& scene, std::uint64_t seed,
                                               const std::string& only, Tell tell) {
  std::string at = "certificate";
  try {
    const Answer answer = subject.verified ? subject.verified(scene) : subject.answer(scene);
    if (!answer.flaw.empty()) return Disagreement{at, answer.flaw};
    tell(at, !subject.verified ? Outcome::not_applicable() : answer.undecided > 0 ? Outcome::undecided() : Outcome{});
    for (std::size_t k = 0; k < subject.checks.size(); ++k) {
      const Check& check = subject.checks[k];
      if (!only.empty() && check.name != only) continue;
      at = check.name;
      Random random(seed * 64 + k);
      const bool is_drawn = check.share == 1 || random.chance(1, check.share);
      const Outcome outcome = is_drawn || !only.empty() ? check.run(scene, answer, random) : Outcome::not_applicable();
      if (outcome.state == Outcome::State::failed) return Disagreement{at, outcome.what};
      tell(at, outcome);
    }
  } catch (const std::exception& error) {
    return Disagreement{at, std::string("throws: ") + error.what()};
  }
  return std::nullopt;
}
inline std::optional<Disagreement> first_disagreement(const Subject& subject, const Posed_scene& scene,
                                                      std::uint64_t seed, const std::string& only = {}) {
  return first_disagreement(subject, scene, seed, only, [](const std::string&, const Outcome&) {});
}

/// The same scene, smaller, for which the same check fails; where an exception was the failure, by one of the same
/// words.
Reduced reduce(const Subject& subject, const Posed_scene& scene, std::uint64_t seed, const Disagreement& found,
               const Reduce_options& options = {});

// ---- Many

/// Where a sequence of cases is.
struct Fuzz_place {
  Random random;
  std::size_t drawn = 0;  ///< of all shards
};

struct Fuzz_options {
  std::uint64_t seed = 1;
  std::size_t scenes = 0;  ///< 0: no limit; of all shards together
  /// Of the scenes drawn those whose number is `shard` modulo `shards`.
  std::size_t shard = 0, shards = 1;
  std::string family;                           ///< empty: any
  std::string check;                            ///< empty: all; its random choices are the same either way
  std::size_t most_faces = 40;                  ///< scenes of more faces are passed over
  std::function<bool()> out_of_time;            ///< asked before each scene
  std::function<void(const Fuzz_case&)> begin;  ///< told before each scene
  std::optional<Fuzz_place> from;               ///< where the sequence goes on; it then takes the summary on, too
  std::function<void(const Fuzz_place&)> at;    ///< told before each scene is drawn, and at the end of time
};

struct Fuzz_summary {
  std::size_t scenes = 0, cases = 0, undecided = 0;
  std::map<std::string, Tally> by_check, by_family;
};

struct Finding {
  Fuzz_case which;
  Disagreement disagreement;
  Posed_scene scene;
};

/// Half of the cases are exactly degenerate, most of the others a few ulps beside it; one in five is moved, one in five
/// is scaled.
Fuzz_case draw_case(const generate::Family& family, Random& random);

/// Draws cases until one fails or time is over. One seed is one sequence of cases, whatever the machine; how far it
/// gets is a matter of time. The seed of a case's checks is the case's.
std::optional<Finding> fuzz(const Subject& subject, const Fuzz_options& options, Fuzz_summary& summary);

}  // namespace sightline::harness
