#pragma once
// Files as bytes, whole: what every reader begins with, and what every output ends in.

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace sightline {

/// All bytes of a file (or pipe; /dev/stdin is not opened anew where it is one). Errors: Input_error where there is
/// none, or it cannot be read.
std::string read_bytes(const std::filesystem::path& path);
/// The same of a file that the program writes for itself, to go on from: it may be replaced (keep_what_is_read()).
std::string read_own_bytes(const std::filesystem::path& path);

/// From now on, files that read_bytes() or open_bytes() open are not replaced by write_bytes() or write_stream(), by
/// whatever name: for programs that read first and then write something else. Until then, a file may be read, changed
/// and written.
void keep_what_is_read();
/// Where that was called: a file is read later, and kept already.
void will_be_read(const std::filesystem::path& path);
/// Errors: std::runtime_error where a file would be replaced that is kept; names both.
void check_replaceable(const std::filesystem::path& path);

/// The file that a path is a name of: links are followed, also one to a file that is not there yet. Errors:
/// std::filesystem::filesystem_error where they lead in a circle.
std::filesystem::path behind_links(const std::filesystem::path& path);

/// Writes a file whole or not at all: to PATH.partial (or PATH.partial1 and so on, where that is taken; without the end
/// of a name that would be too long), and renamed
/// once it is on the disk, so that what was there before stays until then. Its permissions stay, links stay links, and
/// what is no regular file (a device, a pipe) is written to directly. Errors: std::runtime_error that names the path
/// and says what the system said; as check_replaceable(). Cost: waits for the disk.
void write_bytes(const std::filesystem::path& path, std::string_view bytes);

/// The same of what `write` writes to a stream, so that it need not be held; where it throws, that is thrown on, and
/// nothing is there.
void write_stream(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// A file (or pipe) to be read once from its beginning, without holding it. Errors: as read_bytes(), when it is opened;
/// what cannot be read later ends the stream, with badbit.
std::ifstream open_bytes(const std::filesystem::path& path);

/// The name of a file that write_bytes has begun and not yet renamed, or nullptr: what a signal handler removes before
/// it ends the process. Of files that are written at the same time, one.
const char* unfinished_file() noexcept;

/// Whether a signal has to wait, as a file is being made that has no name yet: then it is raised again once it has.
/// What a signal handler asks first, and returns where it has.
bool put_off(int signal) noexcept;

}  // namespace sightline
