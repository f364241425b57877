#include <sightline/kernel/quoted.h>

namespace sightline {

std::string printable(std::string_view text, std::size_t limit, bool only_ascii) {
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

std::string quoted(std::string_view token) {
  std::string result = "\"";
  result += printable(token, 40, true);
  result += '"';
  return result;
}

}  // namespace sightline
