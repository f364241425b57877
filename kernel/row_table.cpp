#include <sightline/kernel/row_table.h>

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

namespace sightline {

void Row_table::reserve(std::size_t rows) {
  rows_.reserve(rows * stride_);
  const std::size_t slots = std::bit_ceil(2 * (rows + 1));
  if (slots > slots_.size()) grow(slots);
}

std::uint32_t Row_table::intern(const Limb* row) {
  if (2 * (count_ + 1) > slots_.size()) grow(std::max<std::size_t>(64, 2 * slots_.size()));
  const std::uint32_t hash = hash_of(row);
  Slot& slot = slots_[slot_of(row, hash)];
  if (slot.row == none) {
    if (count_ == none) throw std::length_error("too many rows");
    slot = {static_cast<std::uint32_t>(count_++), hash};
    rows_.insert(rows_.end(), row, row + stride_);
  }
  return slot.row;
}

std::uint32_t Row_table::hash_of(const Limb* row) const {
  Limb h = 0x9e3779b97f4a7c15u;
  for (std::size_t i = 0; i < stride_; ++i) {
    h = (h ^ row[i]) * 0xff51afd7ed558ccdu;
    h ^= h >> 32;
  }
  return static_cast<std::uint32_t>(h);
}

std::size_t Row_table::slot_of(const Limb* row, std::uint32_t hash) const {
  const auto is_row = [&](std::uint32_t id) {
    const Limb* known = (*this)[id];
    for (std::size_t i = 0; i < stride_; ++i)
      if (known[i] != row[i]) return false;
    return true;
  };
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t s = hash & mask;; s = (s + 1) & mask)
    if (slots_[s].row == none || (slots_[s].hash == hash && is_row(slots_[s].row))) return s;
}

void Row_table::grow(std::size_t slots) {
  std::vector<Slot> grown(slots);
  const std::size_t mask = slots - 1;
  for (const Slot& slot : slots_) {
    if (slot.row == none) continue;
    std::size_t s = slot.hash & mask;
    while (grown[s].row != none) s = (s + 1) & mask;
    grown[s] = slot;
  }
  slots_ = std::move(grown);
}

}  // namespace sightline
