#pragma once
// The questions of sightline report: how each is put to its methods, and in one figure how wrong an answer is.

#include "../compare/compare.h"
#include "../judge/court.h"

#include <sightline/harness/judge/case.h>

#include <memory>
#include <string>
#include <vector>

namespace sightline::app {

/// How much is asked of each case: what differs between a quick report and a whole one.
struct Report_effort {
  bool quick;
  std::vector<std::uint32_t> buffer_sizes;  ///< see: pixels along each side of the cube
  std::vector<int> bits;                    ///< see, render: of depths
  int image_size;                           ///< render: pixels along each side
  std::vector<std::size_t> weak_rays;       ///< weak: random rays of `sample`
  std::size_t rays;                         ///< trace: of each kind
  std::size_t views;                        ///< cutset: along a path
  bool own_query = false;                   ///< what is asked is somebody's (--ask), and methods are asked just that
};
Report_effort report_effort(bool quick);

/// Limits of one method on one case.
struct Report_limits {
  double seconds;
  std::uint64_t bytes;
};

/// How wrong an answer is.
struct Report_verdict {
  enum Kind { right, wrong, abstained, crashed, stopped, not_asked } kind = not_asked;
  double error = 0;  ///< the share of the answer that is wrong, as the question has it
  double seconds = 0;
  std::uint64_t peak_bytes = 0;
  std::string why_not_asked = {};  ///< of not_asked: to be counted; empty: it is no answer to count
  bool broken = false;             ///< it claims to be exact, and its answer is not what that promises
  /// The answer, and of questions that `judge` does not ask the faces that it has wrong (Compare_arguments::says),
  /// where the arguments ask for it; or null.
  Json said = nullptr, wrong_faces = nullptr;
};

struct Report_question {
  std::string name;
  std::string error_means;
  std::size_t quick_size;  ///< where a quick report has larger scenes, it is not asked of them
  /// The arguments of `compare` that ask it of a case.
  Compare_arguments (*arguments)(const Judge_case& asked, const Report_effort& effort);
  std::unique_ptr<Trial> (*trial)(const Compare_arguments& arguments, const Polygon_soup& soup);
  /// The share of an answer that is wrong, and whether it is wrong at all. Pre: its status is done.
  Report_verdict (*judged)(const Json& row, std::size_t faces);
  /// What asks it of one contender again, after the scene: the options of `compare`, or, where they begin with a dash,
  /// of this command.
  std::string (*again)(const Compare_arguments& arguments, const Json& name);
};
/// order, see, render, weak, trace, cutset, pvs, boolean.
const std::vector<Report_question>& report_questions();
const Report_question& report_question(const std::string& name);
/// What `judge` asks of the same cases, so that programs stand beside the methods; of other questions an eye is enough.
judge::Question case_question(const std::string& name);

/// The cut-set along a path of viewpoints that follows from the scene and the seed: by trackers, and face by face in
/// several numbers.
std::unique_ptr<Trial> cutset_trial(const Compare_arguments& arguments, const Polygon_soup& soup);

/// Set operations on the two solids of a case: the exact surface, and that with its points rounded to doubles and
/// floats, as most formats hold them; judged as programs are.
std::unique_ptr<Trial> boolean_trial(const Compare_arguments& arguments, const Polygon_soup& soup);
/// In one figure how wrong a solid is: the largest of the errors of its volume and area and the share of wrong points.
double solid_error(const judge::Grade& grade);

/// What tells a contender from others of its question, in words: "depth buffer 256, 24 bit".
std::string method_of(const Json& name);

/// Asks one contender, apart.
Report_verdict verdict_of(const Report_question& question, const Trial& trial, const Contestant& contestant,
                          std::size_t faces, const Report_limits& limits);

/// Somebody's program as a contender: a word that names it, and how to ask it.
struct Report_program {
  std::string question, command;
  std::shared_ptr<Court> court;
  std::string name() const;  ///< its command without the files
};
/// "see=python3 mine.py {scene} {query} {answer}". Errors: Usage_error.
Report_program report_program(const std::string& text, const Report_limits& limits);
Contestant contestant_of(const Report_program& program, std::shared_ptr<const Judge_case> asked, std::uint64_t seed);

}  // namespace sightline::app
