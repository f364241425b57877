#pragma once
// Texts as JSON has them.

#include <iosfwd>
#include <string_view>

namespace sightline::certificate_check {

/// Writes a text in quotes, with quotes, backslashes and control characters escaped. Pre: UTF-8. Post: read as JSON it
/// is the text.
void write_json_text(std::ostream& out, std::string_view text);

}  // namespace sightline::certificate_check
