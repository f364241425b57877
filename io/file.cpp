#include <sightline/io/file.h>

#include <sightline/io/input.h>
#include <sightline/kernel/quoted.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <system_error>
#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

namespace sightline {

namespace fs = std::filesystem;

std::string read_bytes(const fs::path& path) {
  const auto fail = [&path](const std::string& message) { throw Input_error::of_file(path.string(), message); };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) fail("no such file, or it is out of reach; check the path");
  if (fs::is_directory(status)) fail("is a directory; name a file in it");
  if (!fs::is_regular_file(status) && !fs::is_fifo(status)) fail("is not a file that has an end; name a regular file");

  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) fail(std::string("cannot be opened: ") + std::strerror(errno) + "; check its permissions");
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
  if (std::ferror(file.get())) fail(std::string("cannot be read: ") + std::strerror(errno) + "; check the file");
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
std::atomic_flag taken;  // by one file at a time

/// What the last call of the system said.
std::error_code last_error() { return {errno, std::generic_category()}; }

/// Writes all bytes to a file that is open for writing, and closes it; `flush`: only once they are on the disk.
std::error_code write_and_close(std::FILE* file, std::string_view bytes, bool flush) {
  std::error_code error;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size() || std::fflush(file) != 0) error = last_error();
#if __has_include(<unistd.h>)
  if (!error && flush && fsync(fileno(file)) != 0) error = last_error();
#endif
  if (std::fclose(file) != 0 && !error) error = last_error();
  return error;
}

/// A file beside the one that it becomes; removed unless it did.
class Aside {
 public:
  explicit Aside(const fs::path& target) : target_(target), registered_(!taken.test_and_set()) {
    for (int number = 0; file_ == nullptr && (number == 0 || errno == EEXIST); ++number) {
      path_ = target;
      path_ += ".partial" + (number == 0 ? "" : std::to_string(number));
      file_ = std::fopen(path_.c_str(), "wbx");
    }
    if (file_ == nullptr) error_ = last_error();
    if (file_ == nullptr || !registered_ || path_.string().size() >= sizeof unfinished) return;
    std::strcpy(unfinished, path_.c_str());
    begun = true;
  }
  Aside(const Aside&) = delete;
  ~Aside() {
    std::error_code ignored;
    if (file_ != nullptr && error_) fs::remove(path_, ignored);
    if (!registered_) return;
    begun = false;
    taken.clear();
  }

  /// Writes it and puts it in its place, with the permissions of what was there.
  std::error_code become(std::string_view bytes, const fs::file_status& before) {
    if (!error_) error_ = write_and_close(file_, bytes, true);
    if (!error_ && fs::exists(before)) fs::permissions(path_, before.permissions(), error_);
    if (!error_) fs::rename(path_, target_, error_);
    return error_;
  }

 private:
  fs::path target_, path_;
  bool registered_;
  std::FILE* file_ = nullptr;
  std::error_code error_;
};

std::error_code write_whole(const fs::path& path, std::string_view bytes) {
  // 1. What is no regular file is written to as it is; a file that is there must let itself be written.
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::status_known(status)) return error;
  if (fs::exists(status)) {
    const bool direct = !fs::is_regular_file(status);
    std::FILE* const file = std::fopen(path.c_str(), direct ? "wb" : "r+b");
    if (file == nullptr) return last_error();
    if (direct) return write_and_close(file, bytes, false);
    std::fclose(file);
  }

  // 2. A file is written beside the one that it becomes.
  return Aside(behind_links(path)).become(bytes, status);
}

}  // namespace

void write_bytes(const fs::path& path, std::string_view bytes) {
  if (const std::error_code error = write_whole(path, bytes))
    throw std::runtime_error(printable(path.string(), path.string().size(), false) +
                             ": cannot be written: " + error.message());
}

const char* unfinished_file() noexcept { return begun ? unfinished : nullptr; }

}  // namespace sightline
