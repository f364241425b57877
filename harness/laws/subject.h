#pragma once
// What a harness runs: a subject answers questions about a scene, and checks compare its answers with everything else
// that is known.

#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/convex_parts.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

using generate::Posed_scene;
using generate::Random;

/// What a method says of the faces of a scene. A label is a set of bits, and what they mean is the subject's: the label
/// of a face that is cut in two is the union of both.
struct Answer {
  static constexpr std::uint32_t none = ~std::uint32_t{0};  ///< the face was set aside, or nothing is decided about it

  std::vector<std::uint32_t> labels;  ///< by face, or `none`
  bool is_partition = false;          ///< labels only say which faces are together
  bool planar = true;  ///< whether no face had to be cut along an axis, so that the scene is the same wherever it is
  bool whole = true;   ///< whether each kept face is one convex piece
  std::size_t undecided = 0;  ///< faces
  std::string flaw;           ///< what is wrong with the answer by itself: its certificate was rejected; empty: nothing
};

/// What became of a check.
struct Outcome {
  enum class State { passed, failed, undecided, not_applicable } state = State::passed;
  std::string what;  ///< where failed: one line

  static Outcome failed(std::string why) { return {State::failed, std::move(why)}; }
  static Outcome undecided() { return {State::undecided, {}}; }
  static Outcome not_applicable() { return {State::not_applicable, {}}; }
};

/// An oracle or a law. Given the scene and the subject's answer to it; random numbers are for its own choices.
struct Check {
  std::string name, what;
  std::function<Outcome(const Posed_scene& scene, const Answer& answer, Random& random)> run;
  std::uint64_t share = 1;  ///< it is run of one scene in so many, at random, where others are too
};

/// A command under test.
struct Subject {
  std::string name, what;
  bool wants_source = false;                         ///< only scenes with a source polygon
  std::function<Answer(const Posed_scene&)> answer;  ///< by the method that the command uses unless told otherwise
  /// The same, its certificate checked, which takes longer; empty: there is none.
  std::function<Answer(const Posed_scene&)> verified;
  std::vector<Check> checks;
};

inline std::string face_name(std::size_t face) { return "face " + std::to_string(face); }

/// Components and other partitions: each label becomes the number of its first face.
std::vector<std::uint32_t> first_of_its_kind(const std::vector<std::uint32_t>& labels);

/// Whether two answers to one question agree on all faces that both of them label. `one` and `other` say whose they
/// are.
Outcome compared(const Answer& a, const Answer& b, const std::string& one, const std::string& other);

}  // namespace sightline::harness
