#include <sightline/algorithms/verify/json_text.h>

#include <ostream>

namespace sightline::certificate_check {

void write_json_text(std::ostream& out, std::string_view text) {
  static constexpr char digits[] = "0123456789abcdef";
  out << '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') out << '\\' << c;
    else if (byte < 32) out << "\\u00" << digits[byte >> 4] << digits[byte & 15];
    else out << c;
  }
  out << '"';
}

}  // namespace sightline::certificate_check
