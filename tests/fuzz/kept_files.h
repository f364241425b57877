#pragma once
// Files in a folder, under several names, through links and beside what stands in the way: written whole or not at all,
// and kept where they are read.

#include "rare_files.h"
#include "support.h"

#include <sightline/harness/generate/random.h>
#include <sightline/io/file.h>
#include <sightline/io/input.h>

#include <sys/stat.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace fuzz {

/// What a folder is thought to hold.
class Folder_model {
 public:
  struct File {
    std::string bytes;
    unsigned mode = 0644;
    std::optional<std::string> read_by;  ///< the last name that it was read by since what is read is kept
  };
  /// A name is that of a file, perhaps among others, a link to another name, or a folder.
  struct Entry {
    std::shared_ptr<File> file;
    std::string link;
  };

  std::map<std::string, Entry> entries;
  bool keeps = false;

  /// Where a name leads to, be it there or not; none where links lead in a circle.
  std::optional<std::string> behind(std::string name) const {
    for (int links = 0; links <= 40; ++links) {
      const auto found = entries.find(name);
      if (found == entries.end() || found->second.link.empty()) return name;
      name = found->second.link;
    }
    return std::nullopt;
  }
  std::shared_ptr<File> file_of(const std::string& name) const {
    const Entry* const entry = entry_of(name);
    return entry ? entry->file : nullptr;
  }
  bool is_folder(const std::string& name) const {
    const Entry* const entry = entry_of(name);
    return entry && !entry->file;
  }
  /// Kept is a file as long as the name that it was read by is still its own.
  bool is_kept(const File& file) const { return file.read_by && file_of(*file.read_by).get() == &file; }

 private:
  /// What a name leads to; null where there is nothing, or a circle.
  const Entry* entry_of(const std::string& name) const {
    const std::optional<std::string> target = behind(name);
    const auto found = target ? entries.find(*target) : entries.end();
    return found == entries.end() ? nullptr : &found->second;
  }
};

/// A walk through what may be done with files of one folder, held to the model after each step.
class File_walk {
 public:
  /// `gone`: another folder of the same disk, where files stay that are no longer in the first, so that no new file has
  /// the number of one that was read.
  File_walk(const std::filesystem::path& folder, const std::filesystem::path& gone, bool keeps,
            generate::Random& random)
      : folder_(folder), gone_(gone), random_(random) {
    model_.keeps = keeps;
    names_ = {"a", "b", "c", "a.partial", "a.partial1", "b.partial", std::string(255, 'n'), std::string(251, 'm')};
  }

  void step() {
    const std::string& name = names_[random_.below(names_.size())];
    switch (random_.below(10)) {
      case 0: return stand_in_the_way(name);
      case 1: return take_away(name);
      case 2: return read(name);
      case 3: will_be_read(folder_ / name); return mark_as_read(name);
      case 4: return give_up(name);
      default: return write(name);
    }
  }

  void begin_to_keep() {
    keep_what_is_read();
    model_.keeps = true;
  }

  /// Every file has its bytes and permissions, every link leads where it did, and nothing else is there.
  void check() const {
    std::size_t found = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const auto known = model_.entries.find(entry.path().filename().string());
      require(known != model_.entries.end(), "files: nothing is left beside what was written");
      ++found;
      if (!known->second.link.empty())
        require(entry.is_symlink() && std::filesystem::read_symlink(entry.path()) == known->second.link,
                "files: links stay links");
      else if (known->second.file == nullptr) require(entry.is_directory(), "files: folders stay");
      else {
        const Folder_model::File& file = *known->second.file;
        require(!entry.is_symlink() && bytes_of(entry.path()) == file.bytes, "files: each has the bytes it was given");
        require(static_cast<unsigned>(entry.status().permissions()) == file.mode, "files: permissions stay");
      }
    }
    require(found == model_.entries.size(), "files: all are there");
    require(unfinished_file() == nullptr, "files: none is unfinished once it is written");
    require(!put_off(SIGURG), "files: a signal waits only while a file is made");
  }

 private:
  static std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }
  std::string some_bytes() {
    const std::size_t size = random_.chance(1, 4) ? 65536 + random_.below(3) - 1 : random_.below(40);
    std::string bytes(size, '\0');
    for (char& c : bytes) c = static_cast<char>(random_.below(256));
    return bytes;
  }

  /// A link, a folder, another name of a file or a file that somebody else made.
  void stand_in_the_way(const std::string& name) {
    if (model_.entries.count(name) > 0) return;
    const std::string& other = names_[random_.below(names_.size())];
    Folder_model::Entry& entry = model_.entries[name];
    switch (random_.below(4)) {
      case 0:
        entry.link = other;
        std::filesystem::create_symlink(other, folder_ / name);
        return;
      case 1: std::filesystem::create_directory(folder_ / name); return;
      case 2:
        if (const auto found = model_.entries.find(other); found != model_.entries.end() && found->second.file) {
          entry.file = found->second.file;
          std::filesystem::create_hard_link(folder_ / other, folder_ / name);
          return;
        }
        [[fallthrough]];
      default:
        entry.file = std::make_shared<Folder_model::File>();
        entry.file->bytes = some_bytes();
        entry.file->mode = std::array<unsigned, 4>{0644, 0600, 0755, 0640}[random_.below(4)];
        std::ofstream(folder_ / name, std::ios::binary) << entry.file->bytes;
        std::filesystem::permissions(folder_ / name, static_cast<std::filesystem::perms>(entry.file->mode));
    }
  }

  void take_away(const std::string& name) {
    const auto found = model_.entries.find(name);
    if (found == model_.entries.end()) return;
    if (found->second.file) keep_number(name);
    std::filesystem::remove(folder_ / name);
    model_.entries.erase(found);
  }
  void keep_number(const std::string& name) {
    std::filesystem::create_hard_link(folder_ / name, gone_ / std::to_string(gone_count_++));
  }
  void mark_as_read(const std::string& name) {
    const std::shared_ptr<Folder_model::File> file = model_.file_of(name);
    if (model_.keeps && file) file->read_by = name;
  }

  void read(const std::string& name) {
    const std::shared_ptr<Folder_model::File> file = model_.file_of(name);
    const std::uint64_t kind = random_.below(3);
    std::string bytes;
    const bool refused = is_refused<Input_error>([&] {
      if (kind == 0) bytes = read_bytes(folder_ / name);
      else if (kind == 1) bytes = read_own_bytes(folder_ / name);
      else {
        std::ifstream in = open_bytes(folder_ / name);
        bytes.assign(std::istreambuf_iterator<char>(in), {});
      }
    });
    require(refused == (file == nullptr), "files: what is a file is read, and nothing else");
    if (refused) return;
    require(bytes == file->bytes, "files: each is read as it is");
    if (kind != 1) mark_as_read(name);
  }

  /// Whether a file of that name can be written: no folder, no circle of links, no file that is kept.
  bool is_writable(const std::string& name) const {
    const std::shared_ptr<Folder_model::File> file = model_.file_of(name);
    return model_.behind(name) && !model_.is_folder(name) && !(file && model_.is_kept(*file));
  }

  void write(const std::string& name) {
    const std::string bytes = some_bytes();
    const bool writable = is_writable(name), as_stream = random_.chance(1, 2);
    const std::shared_ptr<Folder_model::File> before = model_.file_of(name);
    if (before) keep_number(*model_.behind(name));
    const bool refused = is_refused<std::runtime_error>([&] {
      if (!as_stream) return write_bytes(folder_ / name, bytes);
      write_stream(folder_ / name, [&](std::ostream& out) {
        check_unfinished(name);
        out << bytes.substr(0, bytes.size() / 2) << std::flush << bytes.substr(bytes.size() / 2);
      });
    });
    require(refused != writable, "files: what is read, a folder or a circle of links is refused, nothing else");
    if (before) {
      const bool free = !is_refused<std::runtime_error>([&] { check_replaceable(folder_ / name); });
      require(free == writable, "files: what is read may not be replaced");
    }
    if (refused) return;
    Folder_model::Entry& entry = model_.entries[*model_.behind(name)];
    entry.file = std::make_shared<Folder_model::File>();  // another file: other names keep the one that was there
    entry.file->bytes = bytes;
    const mode_t mask = umask(0);
    umask(mask);
    entry.file->mode = before ? before->mode : 0666 & ~mask;
  }

  /// While a file is written it stands beside its name, which is told to whoever has to remove it.
  void check_unfinished(const std::string& name) const {
    const char* const unfinished = unfinished_file();
    require(unfinished != nullptr, "files: one that is begun is told");
    const std::filesystem::path path = unfinished;
    const std::string own = path.filename().string(), target = *model_.behind(name);
    require(std::filesystem::exists(path) && model_.entries.count(own) == 0 && own.size() <= 255,
            "files: what is begun stands beside all that was there");
    require(path.parent_path() == folder_ && target.starts_with(own.substr(0, own.rfind(".partial"))),
            "files: what is begun is named after what it becomes");
    std::string expected;
    for (int number = 0; expected.empty() || model_.entries.count(expected) > 0; ++number) {
      const std::string ending = number == 0 ? ".partial" : ".partial" + std::to_string(number);
      expected = target.substr(0, 255 - ending.size()) + ending;
    }
    require(own == expected, "files: what is begun is .partial, or .partial1 and so on where that is taken");
  }

  struct Given_up {};
  void give_up(const std::string& name) {
    const bool writable = is_writable(name);
    bool given_up = false;
    const bool refused = is_refused<std::runtime_error>([&] {
      try {
        write_stream(folder_ / name, [&](std::ostream& out) {
          out << some_bytes();
          throw Given_up();
        });
      } catch (const Given_up&) {
        given_up = true;
      }
    });
    require(given_up == writable && refused != writable, "files: what is thrown while writing is thrown on");
  }

  const std::filesystem::path &folder_, &gone_;
  int gone_count_ = 0;
  generate::Random& random_;
  std::vector<std::string> names_;
  Folder_model model_;
};

/// What is read is kept until the end of the process: the first input that wants that begins it on its way, and from
/// then on those that do not are passed over.
inline void kept_files(std::string_view bytes) {
  static const Own_folder parent;
  static bool keeps = false;
  Bytes from(bytes);
  const bool wants_kept = from.below(8) == 0;
  if (keeps && !wants_kept) return;
  // A folder of a new name, as files that are made now may have numbers that those of the last one had.
  static int count = 0;
  const std::filesystem::path all = parent.path / "kept", folder = all / std::to_string(count++), gone = all / "gone";
  std::filesystem::remove_all(all);
  std::filesystem::create_directories(folder);
  std::filesystem::create_directory(gone);
  generate::Random random(from.word());
  File_walk walk(folder, gone, keeps, random);
  const std::size_t before = wants_kept && !keeps ? 30 : 0, steps = before + 1 + random.below(30);
  for (std::size_t k = 0; k < steps; ++k) {
    if (k == before && wants_kept && !keeps) {
      walk.begin_to_keep();
      keeps = true;
    }
    walk.step();
    walk.check();
  }
}

}  // namespace fuzz
