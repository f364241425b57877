#include <sightline/kernel/row_table.h>

#include <algorithm>
#include <stdexcept>

namespace sightline {

std::uint32_t Row_table::intern(const Limb* row) {
  if (2 * (size() + 1) > slots_.size()) grow();
  std::uint32_t& slot = slots_[slot_of(row)];
  if (slot == none) {
    if (size() == none) throw std::length_error("too many rows");
    slot = static_cast<std::uint32_t>(size());
    rows_.insert(rows_.end(), row, row + stride_);
  }
  return slot;
}

std::size_t Row_table::slot_of(const Limb* row) const {
  Limb h = 0x9e3779b97f4a7c15u;
  for (std::size_t i = 0; i < stride_; ++i) {
    h = (h ^ row[i]) * 0xff51afd7ed558ccdu;
    h ^= h >> 32;
  }
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t s = h & mask;; s = (s + 1) & mask)
    if (slots_[s] == none || std::equal(row, row + stride_, &rows_[slots_[s] * stride_])) return s;
}

void Row_table::grow() {
  slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), none);
  for (std::uint32_t id = 0; id < size(); ++id) slots_[slot_of((*this)[id])] = id;
}

}  // namespace sightline
