#pragma once
// Somebody else's program, run in a process group of its own with limits on time and memory; and a folder for its
// files.

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace sightline::app {

struct Process_limits {
  double seconds = 10;                           ///< on the clock
  std::uint64_t bytes = std::uint64_t{1} << 30;  ///< of memory in use, with all processes that it starts
};

/// What became of a run.
struct Process_end {
  enum Kind { exited, signalled, timed_out, out_of_memory };
  Kind kind = exited;
  int number = 0;           ///< the exit code, or the signal
  double seconds = 0;       ///< on the clock, to about two milliseconds
  std::uint64_t bytes = 0;  ///< the most memory in use; 0 where the run was too short to see it
  std::string said;         ///< the last lines of standard output and error together, at most 2000 bytes
};

/// Words as a shell would split them: blanks between, '...' and "..." hold a word together. Errors:
/// std::invalid_argument where a quote is open.
std::vector<std::string> split_words(const std::string& command);

/// Text as one word of a shell's command line.
std::string shell_word(const std::string& text);

/// Runs a program (found along PATH) without input, what it prints into a file, and waits for its end, or ends it and
/// all that it started. It cannot write files beyond 256 MiB, nor leave a core. Errors: Usage_error where it cannot be
/// started, saying why; std::runtime_error where there can be no process.
Process_end run_limited(const std::vector<std::string>& words, const Process_limits& limits, const std::string& output);

/// Does work in a copy of this process, within limits beyond the memory that this one has, and writes what it returns
/// into a file, which is whole where the copy exits with 0; what it prints is lost. Pre: `work` needs no threads, as
/// the copy has none of this one's. Errors: std::runtime_error where there can be no process.
Process_end work_limited(const std::function<std::string()>& work, const Process_limits& limits,
                         const std::filesystem::path& output);

/// In a process that has just been forked: it ends with the thread that forked it, and now where that is gone already.
/// Safe between fork and exec.
void end_with_parent(pid_t parent);

/// A folder that is gone at the end; of several a signal removes the last that was made.
class Temporary_folder {
 public:
  Temporary_folder();
  Temporary_folder(const Temporary_folder&) = delete;
  ~Temporary_folder();
  std::filesystem::path operator/(const std::string& name) const;

 private:
  std::filesystem::path path_;
  mutable std::set<std::string> files_;  // which a signal removes
};

/// Ends what run_limited() or work_limited() waits for, and removes the temporary folder with what it was asked for.
/// For a handler of signals.
void end_what_runs() noexcept;

}  // namespace sightline::app
