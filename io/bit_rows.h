#pragma once
// Rows of bits with their runs of zeros made short, as Quake's tables have them.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sightline {

/// Bit k of a row is bit k mod 8, from the least, of byte k / 8; a byte 0 and a byte n stand for n bytes of 0.
std::string packed_row(const std::vector<bool>& row);
/// The same of a row of `size` bits of which these are 1. Pre: ascending, below `size`. Cost: as long as what it
/// returns.
std::string packed_row(std::span<const std::uint32_t> ones, std::size_t size);

/// The row of `size` bits that begins at `offset`, and where it ends; nothing where it does not end within the bytes,
/// or has a run of none. Bits beyond `size` are not looked at.
struct Unpacked_row {
  std::vector<std::uint32_t> ones;  ///< ascending
  std::size_t end;
};
std::optional<Unpacked_row> unpacked_row(std::string_view bytes, std::size_t offset, std::size_t size);

/// A row as its bits.
std::vector<bool> bits_of_row(std::span<const std::uint32_t> ones, std::size_t size);

}  // namespace sightline
