#include "files.h"

#include "limited_process.h"
#include "options.h"

#include <sightline/io/file.h>

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <fstream>
#include <iostream>
#include <map>

namespace sightline::app {

namespace fs = std::filesystem;

// ---- Which file is which

/// Where a file is or will be, links followed; an empty path where that cannot be told.
static fs::path place_of(const std::string& name) {
  try {
    return fs::weakly_canonical(fs::absolute(behind_links(name)));
  } catch (const fs::filesystem_error&) {
    return {};
  }
}

static bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::exists(a, error) && !fs::is_regular_file(a, error)) return false;
  if (fs::equivalent(a, b, error)) return true;
  const fs::path place = place_of(a);
  return !place.empty() && place == place_of(b);
}

static bool clash(const Named_file& a, const Named_file& b) {
  return a.name == "-" || b.name == "-" ? a.name == b.name : same_file(a.name, b.name);
}

/// Errors: Usage_error where an output is one of the inputs, or one of the first so many of the others, or where
/// standard output goes by another name than -: what is printed would go to the file that it replaces.
static void check_output(const Named_file& output, const std::vector<Named_file>& inputs,
                         const std::vector<Named_file>& others, std::size_t count) {
  for (const Named_file& input : inputs)
    if (output.name != "-" && clash(output, input))
      throw Usage_error(fmt::format("{} {}: that is the file that {} reads, which would be lost; name another one",
                                    output.option, output.name, input.option));
  for (std::size_t j = 0; j < count; ++j)
    if (clash(output, others[j]))
      throw Usage_error(fmt::format("{} {}: that is where {} writes to already; name another file", output.option,
                                    output.name, others[j].option));
  if (output.name != "-" && same_file(output.name, "/dev/stdout"))
    throw Usage_error(
        fmt::format("{} {}: that is the file that standard output goes to, which would be lost; name "
                    "another one, or -",
                    output.option, output.name));
  if (output.name != "-") check_replaceable(output.name);
}

void check_files(const std::vector<Named_file>& inputs, const std::vector<Named_file>& outputs,
                 const std::vector<Named_file>& many) {
  for (std::size_t i = 0; i < inputs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (inputs[i].name == "-" && inputs[j].name == "-")
        throw Usage_error(
            fmt::format("{} -: {} reads standard input already; name a file", inputs[i].option, inputs[j].option));
  for (std::size_t i = 0; i < outputs.size(); ++i) check_output(outputs[i], inputs, outputs, i);
  std::map<fs::path, std::string> places;  // of the many: two are one only by a link
  for (const Named_file& output : many) {
    check_output(output, inputs, outputs, outputs.size());
    if (const auto [found, is_new] = places.emplace(place_of(output.name), output.name); !is_new)
      throw Usage_error(fmt::format("{} {}: that is {} by a link; remove it, or name another folder", output.option,
                                    output.name, found->second));
  }
}

void check_folders(const std::vector<Named_file>& outputs, const std::vector<std::string>& made) {
  for (const Named_file& output : outputs) {
    if (output.name == "-") continue;
    std::error_code error;
    const fs::path file = fs::absolute(behind_links(output.name)), folder = file.parent_path();
    const auto refuse = [&](const std::string& why) {
      throw std::runtime_error(fmt::format("{}: cannot be written: {}", output.name, why));
    };
    if (fs::is_directory(file, error)) refuse("that is a folder; name a file");
    const fs::file_status status = fs::status(folder, error);
    if (fs::is_directory(status) || !fs::status_known(status)) continue;
    const bool is_file = fs::exists(status);
    const auto is_there_then = [&](const std::string& name) { return place_of(name) == place_of(folder.string()); };
    if (!is_file && std::any_of(made.begin(), made.end(), is_there_then)) continue;
    refuse(folder.string() + (is_file ? " is a file, and no folder; name another file"
                                      : " is not there; make that folder, or name another file"));
  }
}

// ---- Reading and writing

fs::path input_path(const std::string& name) { return name == "-" ? "/dev/stdin" : name; }
std::string ending_of(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

std::string read_input(const std::string& name) { return read_bytes(input_path(name)); }

void write_file(const std::string& name, std::string_view text) {
  if (name == "-") std::cout << text;
  else write_bytes(name, text);
}

void write_file(const std::string& name, const std::function<void(std::ostream&)>& write) {
  if (name == "-") write(std::cout);
  else write_stream(name, write);
}

void write_temporary(const fs::path& path, std::string_view text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(path.string() + ": cannot be written; check the free space of that folder");
}

// ---- Signals

void remove_unfinished() noexcept {
  if (const char* const name = unfinished_file()) unlink(name);
}

extern "C" {
static void end_by_signal_without_remains(int number) {
  if (put_off(number)) return;
  remove_unfinished();
  end_what_runs();
  std::signal(number, SIG_DFL);
  std::raise(number);
}
}

void watch_for_signals() {
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int number : {SIGHUP, SIGINT, SIGTERM})
    if (std::signal(number, end_by_signal_without_remains) == SIG_IGN) std::signal(number, SIG_IGN);
}

void make_folder(const fs::path& folder, std::string_view instead) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw std::runtime_error(
        fmt::format("{}: cannot be made ({}); name {}", folder.string(), error.message(), instead));
}

}  // namespace sightline::app
