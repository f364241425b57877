#pragma once
// Bytes as letters, digits, + and /, as other formats hold them.

#include <string>
#include <string_view>

namespace sightline {

/// Three bytes in four characters, with = where the last three are not whole (RFC 4648, section 4).
std::string base64(std::string_view bytes);

}  // namespace sightline
