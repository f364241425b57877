// Running a program within limits.

#include "limited_process.h"

#include "options.h"

#include <sightline/harness/compare/process_memory.h>
#include <sightline/kernel/time_limit.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>

namespace sightline::app {

namespace {

// What a signal must end and remove.
std::atomic<pid_t> running_group{0};
constexpr std::size_t most_names = 16;
std::atomic<const char*> folder_name{nullptr};
std::array<std::atomic<const char*>, most_names> file_names{};

/// A process and all that it started, in any of its threads.
std::vector<std::string> with_descendants(pid_t process) {
  std::vector<std::string> all{std::to_string(process)};
  for (std::size_t next = 0; next < all.size(); ++next) {
    std::error_code gone;
    for (std::filesystem::directory_iterator task("/proc/" + all[next] + "/task", gone), end; !gone && task != end;
         task.increment(gone)) {
      std::ifstream children(task->path() / "children");
      for (std::string child; children >> child;) all.push_back(child);
    }
  }
  return all;
}

/// Memory that a process and all that it started hold now, what they share counted once; the peak of the first one
/// alone where that is more.
std::uint64_t memory_of(pid_t process) {
  const std::vector<std::string> all = with_descendants(process);
  std::uint64_t sum = 0;
  for (const std::string& name : all) {
    const std::uint64_t shared_out = all.size() > 1 ? process_memory(name, "Pss", "smaps_rollup") : 0;
    sum += shared_out > 0 ? shared_out : process_memory(name, "VmRSS");
  }
  return std::max(sum, process_memory(all[0], "VmHWM"));
}

void set_limit(int what, rlim_t most) {
  const rlimit limit{most, most};
  setrlimit(static_cast<__rlimit_resource_t>(what), &limit);
}

/// Of a process that is killed by the clock: what ends it if it escapes from its group.
rlim_t processor_seconds(const Process_limits& limits) {
  return static_cast<rlim_t>(std::min(1e9, limits.seconds * std::max(1u, std::thread::hardware_concurrency()))) + 2;
}

/// In the child: a group of its own, which ends with this process.
void keep_apart(pid_t parent, rlim_t processor_seconds) {
  setpgid(0, 0);
  end_with_parent(parent);
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, processor_seconds);
}

/// In the child, between fork and exec: only what is safe there. Does not return.
[[noreturn]] void become(const std::vector<char*>& argv, int input, int output, int report, pid_t parent,
                         rlim_t processor_seconds) {
  keep_apart(parent, processor_seconds);
  signal(SIGXFSZ, SIG_DFL);
  set_limit(RLIMIT_FSIZE, rlim_t{256} << 20);
  dup2(input, 0);
  dup2(output, 1);
  dup2(output, 2);
  execvp(argv[0], argv.data());
  const int error = errno;
  [[maybe_unused]] const ssize_t written = ::write(report, &error, sizeof error);
  _exit(127);
}

std::string tail_of(const std::string& file) {
  constexpr std::streamoff most = 2000;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  in.seekg(std::max<std::streamoff>(0, size - most));
  std::ostringstream text;
  text << in.rdbuf();
  std::string said = text.str();
  while (!said.empty() && (said.back() == '\n' || said.back() == '\r')) said.pop_back();
  return said;
}

/// A file descriptor that is closed at the end, and not handed on to programs.
struct Descriptor {
  int number;
  explicit Descriptor(int n) : number(n) {
    if (number < 0) throw std::runtime_error(std::string("a file cannot be opened: ") + std::strerror(errno));
  }
  Descriptor(const Descriptor&) = delete;
  ~Descriptor() { close_now(); }
  void close_now() {
    if (number >= 0) close(number);
    number = -1;
  }
};

}  // namespace

std::vector<std::string> split_words(const std::string& command) {
  std::vector<std::string> words;
  bool in_word = false;
  char quote = 0;
  for (const char c : command) {
    if (quote != 0 && c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
      if (!in_word) words.emplace_back();
      in_word = true;
    } else if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
      in_word = false;
    } else {
      if (!in_word) words.emplace_back();
      in_word = true;
      words.back() += c;
    }
  }
  if (quote != 0) throw std::invalid_argument(std::string("a quote ") + quote + " is not closed");
  return words;
}

std::string shell_word(const std::string& text) {
  if (!text.empty() &&
      text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./,:=@%{}") ==
          std::string::npos &&
      text.find("{}") == std::string::npos)
    return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

/// Waits for the end of a child, looks at its memory now and then, and kills it, with all that it started, where it is
/// over.
static Process_end end_of(pid_t child, const Process_limits& limits) {
  // 1. Wait. The system's own figure is of use where it is above what this process had when it forked.
  const std::uint64_t own = process_memory("self", "VmHWM");
  const Stopwatch watch;
  Process_end end;
  bool killed = false;
  int status = 0;
  rusage usage{};
  auto pause = std::chrono::microseconds(100);
  while (wait4(child, &status, WNOHANG, &usage) == 0) {
    end.bytes = std::max(end.bytes, memory_of(child));
    end.seconds = watch.seconds();
    if (end.seconds > limits.seconds || end.bytes > limits.bytes) {
      end.kind = end.bytes > limits.bytes ? Process_end::out_of_memory : Process_end::timed_out;
      killed = true;
      kill(-child, SIGKILL);
      wait4(child, &status, 0, &usage);
      break;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::microseconds(2000));
  }
  end.seconds = watch.seconds();
  kill(-child, SIGKILL);  // what it left running
  running_group = 0;

  // 2. What became of it.
  if (const std::uint64_t most = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024; most > own)
    end.bytes = std::max(end.bytes, most);
  if (!killed) {
    end.kind = WIFEXITED(status) ? Process_end::exited : Process_end::signalled;
    end.number = WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status);
    if (end.bytes > limits.bytes) end.kind = Process_end::out_of_memory;
  }
  return end;
}

void end_with_parent(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it ended before that
}

/// A child of this process, in a group of its own; 0 in the child.
static pid_t forked() {
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(std::string("no process: ") + std::strerror(errno));
  if (child > 0) setpgid(child, child);
  running_group = child;
  if (child == 0) folder_name = nullptr;  // the parent's
  return child;
}

Process_end run_limited(const std::vector<std::string>& words, const Process_limits& limits,
                        const std::string& output_file) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  Descriptor input(open("/dev/null", O_RDONLY | O_CLOEXEC)),
      output(open(output_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
  Descriptor from(ends[0]), to(ends[1]);

  // 1. Start it. The pipe closes by itself once the program runs, so that nothing of this process is measured.
  const rlim_t seconds = processor_seconds(limits);
  const pid_t parent = getpid(), child = forked();
  if (child == 0) become(argv, input.number, output.number, to.number, parent, seconds);
  to.close_now();
  int error = 0;
  if (read(from.number, &error, sizeof error) == static_cast<ssize_t>(sizeof error)) {
    waitpid(child, nullptr, 0);
    running_group = 0;
    throw Usage_error("'" + words[0] + "' cannot be started: " + std::strerror(error) + "; check the name and PATH");
  }

  // 2. Wait for its end.
  Process_end end = end_of(child, limits);
  end.said = tail_of(output_file);
  return end;
}

Process_end work_limited(const std::function<std::string()>& work, const Process_limits& limits,
                         const std::filesystem::path& output) {
  Process_limits with_own = limits;
  with_own.bytes += process_memory("self", "VmRSS");
  Descriptor nowhere(open("/dev/null", O_WRONLY | O_CLOEXEC));
  const rlim_t seconds = processor_seconds(limits);
  const pid_t parent = getpid(), child = forked();
  if (child > 0) return end_of(child, with_own);
  // The copy. It leaves without cleaning up: what there is belongs to this process, which does.
  keep_apart(parent, seconds);
  dup2(nowhere.number, 1);
  dup2(nowhere.number, 2);
  int code = 1;
  try {
    const std::string answer = work();
    std::ofstream out(output, std::ios::binary);
    out << answer << std::flush;
    code = out ? 0 : 1;
  } catch (...) {
  }
  _exit(code);
}

std::filesystem::path Temporary_folder::operator/(const std::string& name) const {
  const auto [file, is_new] = files_.insert((path_ / name).string());
  if (is_new && files_.size() <= most_names) file_names[files_.size() - 1] = file->c_str();
  return *file;
}

void end_what_runs() noexcept {
  if (const pid_t group = running_group; group > 0) kill(-group, SIGKILL);
  const char* const folder = folder_name;
  if (folder == nullptr) return;
  for (const std::atomic<const char*>& file : file_names)
    if (const char* const name = file) unlink(name);
  rmdir(folder);
}

Temporary_folder::Temporary_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "sightline-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr)
    throw std::runtime_error(pattern + ": no folder can be made there; check TMPDIR");
  path_ = pattern;
  folder_name = path_.c_str();
}
Temporary_folder::~Temporary_folder() {
  folder_name = nullptr;
  for (std::atomic<const char*>& name : file_names) name = nullptr;
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace sightline::app
