#pragma once
// Rows of bits with runs of zeros about as long as one byte tells, and tables of them: packed, they are what a plain
// packer makes of them, byte by byte.

#include "support.h"

#include <sightline/harness/generate/random.h>
#include <sightline/io/bit_rows.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fuzz {

/// Few ones, mostly with runs of zero bytes between them that one byte just tells, or two; and at the end.
inline std::vector<bool> any_long_row(std::size_t size, generate::Random& random) {
  static constexpr std::array<std::size_t, 12> runs{0, 1, 2, 253, 254, 255, 256, 257, 510, 511, 512, 765};  // of bytes
  std::vector<bool> row(size);
  std::size_t next = random.chance(1, 4) ? size : 0;
  for (;;) {
    next += 8 * runs[random.below(runs.size())] + random.below(16);
    if (next >= size) return row;
    row[next++] = true;
  }
}

/// Bytes of eight bits each, the first one the least; of zeros in a row, up to 255, a zero and their number.
inline std::string plainly_packed(const std::vector<bool>& row) {
  std::string bytes((row.size() + 7) / 8, '\0'), packed;
  for (std::size_t k = 0; k < row.size(); ++k)
    if (row[k]) bytes[k / 8] = static_cast<char>(bytes[k / 8] | 1 << k % 8);
  int zeros = 0;
  const auto end_run = [&] {
    if (zeros > 0) packed += {'\0', static_cast<char>(zeros)};
    zeros = 0;
  };
  for (const char byte : bytes) {
    if (byte == 0) {
      if (++zeros == 255) end_run();
    } else {
      end_run();
      packed += byte;
    }
  }
  end_run();
  return packed;
}

/// A row is packed as plainly as can be, and unpacked from between other bytes; one that ends too early is refused, and
/// so is a run of none. Bits behind its last are nobody's.
inline void try_long_row(generate::Random& random) {
  const std::size_t size = random.below(random.chance(1, 4) ? 40 : 20001);
  std::vector<bool> row = any_long_row(size, random);
  if (size > 0 && random.chance(1, 2)) row.back() = true;
  std::vector<std::uint32_t> ones;
  for (std::size_t k = 0; k < size; ++k)
    if (row[k]) ones.push_back(static_cast<std::uint32_t>(k));
  std::string packed = packed_row(row);
  require(packed == plainly_packed(row) && packed == packed_row(ones, size), "a row is packed as plainly as can be");
  require(bits_of_row(ones, size) == row, "a row is its ones");
  if (size % 8 != 0 && row.back()) packed.back() = static_cast<char>(packed.back() | 0xff << size % 8);
  const std::string before(random.below(3), 'x');
  std::string bytes = before + packed + "behind";
  const std::optional<Unpacked_row> found = unpacked_row(bytes, before.size(), size);
  require(found && found->ones == ones && found->end == before.size() + packed.size(), "a row is what was packed");
  if (packed.empty()) return;
  const std::size_t cut = before.size() + random.below(packed.size());
  require(!unpacked_row(std::string_view(bytes).substr(0, cut), before.size(), size), "a row that ends is refused");
  if (const std::size_t zero = packed.find('\0'); zero != std::string::npos) {
    bytes[before.size() + zero + 1] = '\0';
    require(!unpacked_row(bytes, before.size(), size), "a run of none is refused");
  }
}

}  // namespace fuzz
