#pragma once
// The files of a command line: no output takes the place of what is read or of another output, and each is written
// whole or not at all.

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace sightline::app {

/// A file as the command line names it: by which option, and how; "-" is standard input or output.
struct Named_file {
  std::string option, name;
};

/// Errors: Usage_error where an output is a file that is read, another output, or where standard output goes, whatever
/// names they have (links too), and where two are "-". Devices and pipes may be named twice. `many` are outputs too, in
/// any number: files of a folder. std::runtime_error where an output is a file that was read already, as another file
/// names it: a library of materials, say. Cost: a look at the disk for each pair but those of two of the many.
void check_files(const std::vector<Named_file>& inputs, const std::vector<Named_file>& outputs,
                 const std::vector<Named_file>& many = {});

/// What would be told after all work is told before it. Errors: std::runtime_error where the folder of an output is
/// none, and none of those that are `made` on the way, or the output is a folder.
void check_folders(const std::vector<Named_file>& outputs, const std::vector<std::string>& made);

/// Makes a folder that is not there yet. Errors: std::runtime_error where none can be made, which says what to name.
void make_folder(const std::filesystem::path& folder, std::string_view instead = "another folder");

/// What a name ends with from its last dot on, in small letters: ".json"; nothing where it has none.
std::string ending_of(const std::string& name);

/// All bytes of an input. Errors: Input_error.
std::string read_input(const std::string& name);
/// The file that an input is: what "-" stands for has a name too.
std::filesystem::path input_path(const std::string& name);

/// Writes an output, whole or not at all. Errors: std::runtime_error; of "-", none: main looks at standard output.
void write_file(const std::string& name, std::string_view text);
/// The same of what `write` writes to a stream, so that it need not be held. What `write` throws is thrown on.
void write_file(const std::string& name, const std::function<void(std::ostream&)>& write);
/// Writes a file of a temporary folder, without waiting for the disk. Errors: std::runtime_error.
void write_temporary(const std::filesystem::path& path, std::string_view text);

/// Lets SIGHUP, SIGINT and SIGTERM remove an output that is not finished before they end the program; a limit on the
/// size of files (SIGXFSZ) becomes an error of writing.
void watch_for_signals();
/// The first half of that, for a handler of somebody else's.
void remove_unfinished() noexcept;

}  // namespace sightline::app
