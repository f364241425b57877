#include <sightline/io/bit_rows.h>

#include <algorithm>

namespace sightline {

std::string packed_row(const std::vector<bool>& row) {
  std::string bytes((row.size() + 7) / 8, '\0');
  for (std::size_t i = 0; i < row.size(); ++i)
    if (row[i]) bytes[i / 8] = static_cast<char>(static_cast<unsigned char>(bytes[i / 8]) | 1u << i % 8);
  std::string packed;
  for (std::size_t i = 0; i < bytes.size();) {
    packed += bytes[i];
    if (bytes[i] != 0) {
      ++i;
      continue;
    }
    std::size_t run = 0;
    while (i < bytes.size() && bytes[i] == 0 && run < 255) {
      ++run;
      ++i;
    }
    packed += static_cast<char>(run);
  }
  return packed;
}

std::optional<Unpacked_row> unpacked_row(std::string_view bytes, std::size_t offset, std::size_t size) {
  Unpacked_row result{std::vector<bool>(size), offset};
  std::size_t& i = result.end;
  for (std::size_t first = 0; first < size;) {  // of the next byte's bits
    if (i >= bytes.size()) return std::nullopt;
    const unsigned char byte = static_cast<unsigned char>(bytes[i++]);
    if (byte == 0) {
      if (i >= bytes.size() || bytes[i] == 0) return std::nullopt;
      first += 8 * std::size_t{static_cast<unsigned char>(bytes[i++])};
      continue;
    }
    for (std::size_t bit = 0; bit < 8 && first + bit < size; ++bit)
      if ((byte >> bit & 1) != 0) result.row[first + bit] = true;
    first += 8;
  }
  return result;
}

}  // namespace sightline
