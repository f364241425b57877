#pragma once
// What was read, in messages of one line.

#include <string>
#include <string_view>

namespace sightline {

/// Text made fit for a message of one line: control characters (and, if only_ascii, bytes above 127) become \xNN, and
/// what is longer than `limit` is cut off with "...".
inline std::string printable(std::string_view text, std::size_t limit, bool only_ascii) {
  constexpr const char* hex = "0123456789ABCDEF";
  std::string result;
  for (const char c : text.substr(0, limit)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 32 || byte == 127 || (only_ascii && byte > 127))
      (((result += "\\x") += hex[byte >> 4]) += hex[byte & 15]);
    else result += c;
  }
  return text.size() > limit ? result + "..." : result;
}

/// A token in quotes, for a message.
inline std::string quoted(std::string_view token) {
  std::string result = "\"";
  result += printable(token, 40, true), result += '"';
  return result;
}

}  // namespace sightline
