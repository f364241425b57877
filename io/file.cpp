#include <sightline/io/file.h>

#include <sightline/io/input.h>
#include <sightline/kernel/quoted.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <streambuf>
#include <system_error>
#include <utility>
#include <vector>
#if __has_include(<sys/stat.h>)
#include <sys/stat.h>
#endif
#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

namespace sightline {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& message) {
  throw Input_error::of_file(path.string(), message);
}
[[noreturn]] void fail_to_open(const fs::path& path) {
  fail(path, std::string("cannot be opened: ") + std::strerror(errno) + "; check its permissions");
}

/// Errors: Input_error where it has no bytes to read.
fs::file_status status_of_input(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) fail(path, "no such file, or it is out of reach; check the path");
  if (fs::is_directory(status)) fail(path, "is a directory; name a file in it");
  if (!fs::is_regular_file(status) && !fs::is_fifo(status) && fs::canonical(path, error) != "/dev/null")
    fail(path, "is not a file that has an end; name a regular file");
  return status;
}

/// A FIFO that is standard input already is not opened anew: that could wait for a writer that is gone.
std::FILE* opened(const fs::path& path) {
#if __has_include(<unistd.h>)
  if (path == "/dev/stdin" && fs::is_fifo(path)) {
    const int own = dup(STDIN_FILENO);
    return own < 0 ? nullptr : fdopen(own, "rb");
  }
#endif
  return std::fopen(path.c_str(), "rb");
}

std::string shown(const fs::path& path) { return printable(path.string(), path.string().size(), false); }

// ---- Files that are read, and kept

/// The number of a file on this machine, whatever its names; none where there is no regular file.
using File_number = std::pair<std::uintmax_t, std::uintmax_t>;
std::optional<File_number> number_of_file(const fs::path& path) {
#if __has_include(<sys/stat.h>)
  struct stat found;
  if (stat(path.string().c_str(), &found) == 0 && fs::is_regular_file(path))
    return File_number(found.st_dev, found.st_ino);
#endif
  return std::nullopt;
}

/// What is kept: each file by one name that it was read by.
class Kept_files {
 public:
  void begin() { keeps_ = true; }
  void add(const fs::path& path) {
    if (!keeps_) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (const auto number = number_of_file(path)) names_[*number] = path;
  }
  /// The name that a file was read by, if it still is that file's; numbers of files that are gone are given again.
  std::optional<fs::path> name_of(const fs::path& path) {
    if (!keeps_) return std::nullopt;
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto number = number_of_file(path);
    const auto found = number ? names_.find(*number) : names_.end();
    if (found == names_.end() || number_of_file(found->second) != number) return std::nullopt;
    return found->second;
  }

 private:
  std::atomic<bool> keeps_{false};
  std::mutex mutex_;
  std::map<File_number, fs::path> names_;
};
Kept_files& kept_files() {
  static Kept_files files;
  return files;
}

}  // namespace

void keep_what_is_read() { kept_files().begin(); }
void will_be_read(const fs::path& path) { kept_files().add(path); }

void check_replaceable(const fs::path& path) {
  if (const std::optional<fs::path> read = kept_files().name_of(path))
    throw std::runtime_error(shown(path) + ": cannot be written: that is " +
                             (*read == path ? "a file" : shown(*read) + ',') +
                             " that is read, which would be lost; name another one");
}

// ---- Reading

std::ifstream open_bytes(const fs::path& path) {
  status_of_input(path);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) fail_to_open(path);
  will_be_read(path);
  return in;
}

std::string read_bytes(const fs::path& path) {
  std::string bytes = read_own_bytes(path);
  will_be_read(path);
  return bytes;
}

std::string read_own_bytes(const fs::path& path) {
  const fs::file_status status = status_of_input(path);
  std::error_code error;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(opened(path), std::fclose);
  if (!file) fail_to_open(path);
  std::string bytes;
  std::size_t used = 0;
  if (fs::is_regular_file(status))
    if (const std::uintmax_t size = fs::file_size(path, error); !error) bytes.resize(size + 1);
  for (;;) {
    if (used == bytes.size()) bytes.resize(2 * used + 65536);
    const std::size_t got = std::fread(bytes.data() + used, 1, bytes.size() - used, file.get());
    used += got;
    if (got == 0) break;
  }
  if (std::ferror(file.get())) fail(path, std::string("cannot be read: ") + std::strerror(errno) + "; check the file");
  bytes.resize(used);
  return bytes;
}

fs::path behind_links(const fs::path& path) {
  fs::path target = path;
  constexpr int most = 40;  // as many as Linux follows
  for (int links = 0; fs::is_symlink(fs::symlink_status(target)); ++links) {
    if (links == most)
      throw fs::filesystem_error("links lead in a circle", path,
                                 std::make_error_code(std::errc::too_many_symbolic_link_levels));
    target = target.parent_path() / fs::read_symlink(target);
  }
  return target;
}

namespace {

/// For the signal handler: a name that is never freed. Written before `begun` says that it is there.
char unfinished[4096];
std::atomic<bool> begun{false};
std::atomic_flag taken;               // by one file at a time
std::atomic<bool> being_made{false};  // a file, of which `unfinished` is not the name yet
std::atomic<int> waiting{0};          // a signal that came meanwhile

/// What the last call of the system said.
std::error_code last_error() { return {errno, std::generic_category()}; }

/// Writes to a file that is open for writing, and keeps what went wrong first; no further byte is then taken.
class Bytes_out final : public std::streambuf {
 public:
  explicit Bytes_out(std::FILE* file) : file_(file), buffer_(std::size_t{1} << 16) {
    setp(buffer_.data(), buffer_.data() + buffer_.size());
  }
  /// Writes what is left, to the disk where `flush` says so. What went wrong, if anything did.
  std::error_code finish(bool flush) {
    if (sync() == 0 && std::fflush(file_) != 0) error_ = last_error();
#if __has_include(<unistd.h>)
    if (!error_ && flush && fsync(fileno(file_)) != 0) error_ = last_error();
#endif
    return error_;
  }

 protected:
  int_type overflow(int_type c) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }
  int sync() override {
    const auto size = static_cast<std::size_t>(pptr() - pbase());
    if (!error_ && std::fwrite(pbase(), 1, size, file_) != size) error_ = last_error();
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return error_ ? -1 : 0;
  }

 private:
  std::FILE* file_;
  std::vector<char> buffer_;
  std::error_code error_;
};

using Write = std::function<void(std::ostream&)>;

/// Fills a file that is open for writing, and closes it; `flush`: only once it is on the disk.
std::error_code fill_and_close(std::FILE* file, const Write& write, bool flush) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> closed(file, std::fclose);
  Bytes_out bytes(file);
  std::ostream out(&bytes);
  out.exceptions(std::ios::badbit);  // what is long to make is not made for nothing
  try {
    write(out);
  } catch (const std::ios_base::failure&) {
  }
  std::error_code error = bytes.finish(flush);
  if (std::fclose(closed.release()) != 0 && !error) error = last_error();
  return error;
}

/// A file beside the one that it becomes; removed unless it did.
class Aside {
 public:
  explicit Aside(const fs::path& target) : target_(target), registered_(!taken.test_and_set()) {
    if (registered_) being_made = true;
    make();
    if (!registered_) return;
    if (file_ != nullptr && path_.string().size() < sizeof unfinished) {
      std::strcpy(unfinished, path_.c_str());
      begun = true;
    }
    being_made = false;
    if (const int signal = waiting.exchange(0); signal != 0) std::raise(signal);
  }
  Aside(const Aside&) = delete;
  ~Aside() {
    std::error_code ignored;
    if (file_ != nullptr && !became_) fs::remove(path_, ignored);
    if (!registered_) return;
    begun = false;
    taken.clear();
  }

  /// Fills it and puts it in its place, with the permissions of what was there.
  std::error_code become(const Write& write, const fs::file_status& before) {
    if (!error_) error_ = fill_and_close(file_, write, true);
    if (!error_ && fs::exists(before)) fs::permissions(path_, before.permissions(), error_);
    if (!error_) fs::rename(path_, target_, error_);
    became_ = !error_;
    return error_;
  }

 private:
  void make() {
    constexpr std::size_t longest = 255;  // name, of most systems
    const std::string name = target_.filename().string();
    for (int number = 0; file_ == nullptr && (number == 0 || errno == EEXIST); ++number) {
      const std::string ending = ".partial" + (number == 0 ? "" : std::to_string(number));
      path_ = target_.parent_path() / (name.substr(0, longest - ending.size()) + ending);
      file_ = std::fopen(path_.c_str(), "wbx");
    }
    if (file_ == nullptr) error_ = last_error();
  }

  fs::path target_, path_;
  bool registered_, became_ = false;
  std::FILE* file_ = nullptr;
  std::error_code error_;
};

std::error_code write_whole(const fs::path& path, const Write& write) {
  // 1. What is read stays. What is no regular file is written to as it is; a file that is there must let itself be
  // written.
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::status_known(status)) return error;
  check_replaceable(path);
  if (fs::exists(status)) {
    const bool direct = !fs::is_regular_file(status);
    std::FILE* const file = std::fopen(path.c_str(), direct ? "wb" : "r+b");
    if (file == nullptr) return last_error();
    if (direct) return fill_and_close(file, write, false);
    std::fclose(file);
  }

  // 2. A file is written beside the one that it becomes.
  return Aside(behind_links(path)).become(write, status);
}

}  // namespace

void write_stream(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  if (const std::error_code error = write_whole(path, write))
    throw std::runtime_error(shown(path) + ": cannot be written: " + error.message());
}

void write_bytes(const fs::path& path, std::string_view bytes) {
  write_stream(path, [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

const char* unfinished_file() noexcept { return begun ? unfinished : nullptr; }

bool put_off(int signal) noexcept {
  waiting = signal;
  if (being_made) return true;
  return waiting.exchange(0) == 0;  // the file was made in between, and whoever made it raises the signal
}

}  // namespace sightline
