#pragma once
// Numbers in binary data, of either byte order.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace sightline {

/// The Value whose bytes stand at `offset`. Pre: they are all there.
template <class Value>
Value load(std::string_view bytes, std::size_t offset, std::endian order) {
  char raw[sizeof(Value)];
  std::memcpy(raw, bytes.data() + offset, sizeof(Value));
  if (order != std::endian::native)
    for (std::size_t i = 0; i < sizeof(Value) / 2; ++i) std::swap(raw[i], raw[sizeof(Value) - 1 - i]);
  Value value;
  std::memcpy(&value, raw, sizeof(Value));
  return value;
}

/// Appends the bytes of a value, least significant first.
template <class Value>
void store(std::string& bytes, Value value) {
  char raw[sizeof(Value)];
  std::memcpy(raw, &value, sizeof(Value));
  if constexpr (std::endian::native == std::endian::big)
    for (std::size_t i = 0; i < sizeof(Value) / 2; ++i) std::swap(raw[i], raw[sizeof(Value) - 1 - i]);
  bytes.append(raw, sizeof(Value));
}

/// A sum that is another one wherever one byte is: FNV-1a of 64 bits. `before`: of the bytes before these.
inline std::uint64_t sum_of_bytes(std::string_view bytes, std::uint64_t before = 0xcbf29ce484222325u) {
  for (const char c : bytes) before = (before ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return before;
}

}  // namespace sightline
