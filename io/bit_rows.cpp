#include <sightline/io/bit_rows.h>

#include <algorithm>

namespace sightline {

std::string packed_row(const std::vector<bool>& row) {
  std::vector<std::uint32_t> ones;
  for (std::size_t k = 0; k < row.size(); ++k)
    if (row[k]) ones.push_back(static_cast<std::uint32_t>(k));
  return packed_row(ones, row.size());
}

std::string packed_row(std::span<const std::uint32_t> ones, std::size_t size) {
  std::string packed;
  std::size_t next = 0;  // byte of the row
  const auto pass_zeros = [&](std::size_t to) {
    while (next < to) {
      const std::size_t run = std::min<std::size_t>(to - next, 255);
      packed += '\0';
      packed += static_cast<char>(run);
      next += run;
    }
  };
  for (std::size_t i = 0; i < ones.size();) {
    const std::size_t place = ones[i] / 8;
    pass_zeros(place);
    unsigned byte = 0;
    for (; i < ones.size() && ones[i] / 8 == place; ++i) byte |= 1u << ones[i] % 8;
    packed += static_cast<char>(byte);
    ++next;
  }
  pass_zeros((size + 7) / 8);
  return packed;
}

std::optional<Unpacked_row> unpacked_row(std::string_view bytes, std::size_t offset, std::size_t size) {
  Unpacked_row result{{}, offset};
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
      if ((byte >> bit & 1) != 0) result.ones.push_back(static_cast<std::uint32_t>(first + bit));
    first += 8;
  }
  return result;
}

std::vector<bool> bits_of_row(std::span<const std::uint32_t> ones, std::size_t size) {
  std::vector<bool> row(size);
  for (const std::uint32_t one : ones) row[one] = true;
  return row;
}

}  // namespace sightline
