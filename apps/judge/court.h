#pragma once
// A program asked one case at a time, within limits, and its answer graded.

#include "../support/common.h"
#include "cases.h"
#include "../support/limited_process.h"

#include <sightline/harness/judge/guess.h>

namespace sightline::app {

/// What is asked of a program, and what it is allowed.
struct Court_options {
  std::string program;         ///< a command line with {scene}, {query} and {answer}
  std::string format = "off";  ///< of the scene's file: its ending
  judge::Contract contract = judge::Contract::exact;
  Process_limits limits;
  judge::Truth_options truth;
};

/// What became of a case.
struct Judged {
  std::uint64_t seed = 0;
  std::string not_asked;  ///< why; the rest is then empty
  std::size_t faces = 0;
  judge::Mark mark = judge::Mark::right;
  bool breaks = false;  ///< the contract
  std::string why;
  judge::Grade grade;
  judge::Answer answer;  ///< where it is one
  judge::Kinds kinds;    ///< of the faces that are judged
  double seconds = 0;
  std::uint64_t bytes = 0;
};

/// Asks the program one query after another, in a folder of its own.
class Court {
 public:
  /// Errors: Usage_error where the command line holds not all that it has to.
  explicit Court(Court_options options);

  /// Errors: Usage_error where the program cannot be started; std::logic_error where the library contradicts what is
  /// known by construction.
  Judged judge(const Judge_case& asked, std::uint64_t seed) const;

  /// What the program wrote of the last case, byte by byte; nothing where it wrote no file.
  std::optional<std::string> said() const;
  /// The answer as it is read. Errors: std::invalid_argument.
  judge::Answer read(const Judge_case& asked, const std::string& said) const;

  /// What names of kept files end in: of the scene, the query, the answer and a picture.
  static std::vector<std::string> kept_endings(const std::string& format) { return {format, "json", "answer", "svg"}; }

  /// Writes the files of a case to a folder, so that the program can be asked again by hand: as it was asked, whatever
  /// the program did to its own. Returns their names: STEM.off or what the format is, STEM.json, STEM.answer. Errors:
  /// as write_file.
  std::vector<std::string> keep_files(const std::string& folder, const std::string& stem, const Judge_case& asked,
                                      const std::optional<std::string>& said) const;

  const std::vector<std::string>& words() const { return words_; }  ///< of the program's command

 private:
  std::filesystem::path scene() const { return place("scene." + options_.format); }
  std::filesystem::path query() const { return place("query.json"); }
  std::filesystem::path answer() const { return place("answer"); }
  std::filesystem::path place(const std::string& name) const {
    return folder_ / (blocked_ == 0 ? name : fmt::format("{}-{}", blocked_, name));
  }
  std::string scene_text(const Judge_case& asked) const;
  void write_case(const Judge_case& asked) const;
  void run(const Judge_case& asked, const judge::Truth& truth, Judged& judged) const;
  void grade_answer(const Judge_case& asked, const judge::Truth& truth, Judged& judged) const;

  Court_options options_;
  std::vector<std::string> words_;
  Temporary_folder folder_;
  mutable std::size_t blocked_ = 0;  // cases that left something which cannot be removed
};

}  // namespace sightline::app
