#include <sightline/io/input.h>

namespace sightline {

Input_error Input_error::in_text(const std::string& file, std::size_t line, std::size_t column,
                                 const std::string& message) {
  return {file, line, column, std::nullopt, ":" + std::to_string(line) + ":" + std::to_string(column) + ": " + message};
}

void Input::fail(const char* place, const std::string& message) const {
  const char* const end = bytes.data() + bytes.size();
  const char* line_begin = bytes.data();
  if (bytes.starts_with(byte_order_mark) && place >= line_begin + byte_order_mark.size())
    line_begin += byte_order_mark.size();
  std::size_t line = 1;
  for (const char* p = line_begin; p < place; ++p) {
    const bool ends_line = *p == '\n' || (*p == '\r' && (p + 1 == end || p[1] != '\n'));
    if (ends_line) {
      ++line;
      line_begin = p + 1;
    }
  }
  throw Input_error::in_text(name, line, static_cast<std::size_t>(place - line_begin) + 1, message);
}

}  // namespace sightline
