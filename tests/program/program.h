#pragma once
// The program as a user meets it: a command line, files in a folder of its own, what it prints, its exit code. Limits
// on time and memory.

#include "../sample.h"

#include <stdexcept>
#include <string>

namespace program {
[[noreturn]] inline void json_lacks(const char* condition) {
  throw std::logic_error(std::string("JSON is not as expected: ") + condition);
}
}  // namespace program
#define JSON_ASSERT(condition) \
  ((condition) ? static_cast<void>(0) : program::json_lacks(#condition))  // a failed test, not an abort

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <string_view>
#include <thread>
#include <vector>

#ifndef SIGHTLINE_PROGRAM  // the program is not built here
#define SIGHTLINE_PROGRAM ""
#endif

extern char** environ;

namespace program {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// Exit codes (design.md, section 7).
inline constexpr int done = 0, disagreement = 1, usage = 2, bad_input = 3, undecided = 4;

/// Shadow memory: no limit on addresses, and all takes longer.
inline const bool sanitized = test_scenes::is_sanitized();

/// The program: what was built beside the tests, or what the environment variable names.
inline const std::string executable =
    std::getenv("SIGHTLINE_PROGRAM") != nullptr ? std::getenv("SIGHTLINE_PROGRAM") : SIGHTLINE_PROGRAM;

struct Limits {
  double seconds = 60;
  std::size_t mebibytes = 4096;                            ///< of addresses, with those of threads' stacks
  std::size_t file_blocks = 0;                             ///< of 512 bytes, of a file that is written; 0: no limit
  std::function<bool()> is_enough = [] { return false; };  ///< once it says so the run is killed
};

/// What became of a run of the program.
struct Outcome {
  int code = -1;  ///< of exit; -1 where a signal ended it, or the time ran out
  std::string out, err;
  std::string ended;    ///< "exit 3", "signal 11", "no end within 60 s"
  std::string command;  ///< for messages
  double processor_seconds = 0;

  /// Whether stderr is exactly one line.
  bool one_line_of_error() const { return !err.empty() && err.find('\n') == err.size() - 1; }
  Json json() const { return Json::parse(out, nullptr, false); }
};

inline std::ostream& operator<<(std::ostream& to, const Outcome& run) {
  return to << run.command << "\n  -> " << run.ended << "\n  stdout: " << run.out.substr(0, 1000)
            << "\n  stderr: " << run.err.substr(0, 1000);
}

inline std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline const fs::path corpus = fs::path(SIGHTLINE_SOURCE_DIR) / "tests" / "corpus";

/// Tests of the program: a fresh folder for each, gone afterwards.
class Program : public testing::Test {
 protected:
  void SetUp() override {
    if (executable.empty()) GTEST_SKIP() << "the program is not built here";
    std::string pattern = (fs::temp_directory_path() / "sightline-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
  }

  fs::path path(const std::string& name) const { return folder_ / name; }

  std::string file(const std::string& name, std::string_view bytes) const {
    std::ofstream out(path(name), std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    EXPECT_TRUE(out);
    return path(name).string();
  }

  Outcome run(const std::vector<std::string>& arguments, Limits limits = {}) const {
    return run_to(path("stdout").string(), arguments, limits);
  }

  /// A run whose standard output goes to a file of its own choice.
  Outcome run_to(const std::string& out, const std::vector<std::string>& arguments, Limits limits = {}) const {
    const std::string err = errors_.empty() ? path("stderr").string() : errors_;
    std::vector<std::string> words{
        "/bin/sh", "-c",
        (limits.file_blocks == 0 ? "" : "ulimit -f " + std::to_string(limits.file_blocks) + " && ") +
            (sanitized ? "" : "ulimit -v " + std::to_string(limits.mebibytes * 1024) + " && ulimit -c 0 && ") +
            "exec \"$@\"",
        "sh"};
    words.insert(words.end(), launcher_.begin(), launcher_.end());
    words.push_back(executable);
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, input_.c_str(), O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    Outcome result;
    result.command = "sightline";
    for (const std::string& argument : arguments)
      result.command += " " + (argument.size() > 200 ? argument.substr(0, 200) + "..." : argument);
    pid_t child = 0;
    std::vector<char*> variables;
    for (char** variable = environ; *variable != nullptr; ++variable)
      if (!std::string_view(*variable).starts_with("ASAN_OPTIONS=")) variables.push_back(*variable);
    std::string asan = "ASAN_OPTIONS=";
    if (const char* options = std::getenv("ASAN_OPTIONS")) asan += options;
    if (!commands_run_.insert(arguments.empty() ? "" : arguments[0]).second) asan += ":detect_leaks=0";
    if (sanitized) variables.push_back(asan.data());
    variables.push_back(nullptr);
    const int failed = posix_spawn(&child, words[0].c_str(), &actions, nullptr, argv.data(), variables.data());
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) {
      result.ended = "could not be started";
      return result;
    }

    const double allowed = limits.seconds * (sanitized ? 10 : 1);
    const auto start = std::chrono::steady_clock::now();
    int status = 0;
    rusage used{};
    auto pause = std::chrono::microseconds(500);
    while (wait4(child, &status, WNOHANG, &used) == 0) {
      const bool is_late = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > allowed;
      if (is_late || limits.is_enough()) {
        kill(child, SIGKILL);
        wait4(child, &status, 0, &used);
        result.ended = is_late ? "no end within " + std::to_string(allowed) + " s" : "killed by the test";
        break;
      }
      std::this_thread::sleep_for(pause);
      pause = std::min(2 * pause, std::chrono::microseconds(20000));
    }
    for (const timeval& time : {used.ru_utime, used.ru_stime})
      result.processor_seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    if (result.ended.empty()) {
      if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
      result.ended =
          WIFEXITED(status) ? "exit " + std::to_string(result.code) : "signal " + std::to_string(WTERMSIG(status));
    }
    if (fs::is_regular_file(out)) result.out = read_file(out);
    if (fs::is_regular_file(err)) result.err = read_file(err);
    return result;
  }

  std::string input_ = "/dev/null",
              errors_;                 ///< standard input of runs, and standard error where it is no file of ours
  std::vector<std::string> launcher_;  ///< what starts the program, with its own arguments; empty: nothing does

 private:
  fs::path folder_;
  /// Memory that is lost is looked for in a test's first run of each command: that takes a third of a short run.
  mutable std::set<std::string> commands_run_;
};

/// The files of a folder of the corpus that are scenes, sorted.
inline std::vector<fs::path> scenes_in(const fs::path& folder) {
  std::vector<fs::path> scenes;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    for (const std::string_view ending : {".obj", ".off", ".qoff", ".ply", ".stl"})
      if (at->path().extension() == ending && at->is_regular_file()) scenes.push_back(at->path());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

}  // namespace program
