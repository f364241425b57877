#pragma once
// What was read, in messages of one line.

#include <cstddef>
#include <string>
#include <string_view>

namespace sightline {

/// Text made fit for a message of one line: control characters (and, if only_ascii, bytes above 127) become \xNN, and
/// what is longer than `limit` is cut off with "...".
std::string printable(std::string_view text, std::size_t limit, bool only_ascii);

/// A token in quotes, for a message.
std::string quoted(std::string_view token);

}  // namespace sightline
