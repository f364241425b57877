#pragma once
// Rows of limbs, each kept once and numbered: what points, planes and lines are interned in.

#include <sightline/kernel/fixed_integer.h>

#include <algorithm>
#include <vector>

namespace sightline {

/// Numbers equal rows alike, in the order of their first appearance. Cost: one expected probe a row. Reads are
/// thread-safe beside reads.
class Row_table {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  explicit Row_table(std::size_t stride = 1) : stride_(stride) {}

  std::size_t stride() const { return stride_; }
  std::size_t size() const { return rows_.size() / stride_; }
  void reserve(std::size_t rows) { rows_.reserve(rows * stride_); }
  const Limb* operator[](std::size_t id) const { return &rows_[id * stride_]; }

  /// The number of the row; a new one if there was none like it. Pre: `row` does not point into the table.
  std::uint32_t intern(const Limb* row) {
    if (2 * (size() + 1) > slots_.size()) grow();
    std::uint32_t& slot = slots_[slot_of(row)];
    if (slot == none) {
      if (size() == none) throw std::length_error("too many rows");
      slot = static_cast<std::uint32_t>(size());
      rows_.insert(rows_.end(), row, row + stride_);
    }
    return slot;
  }

  /// The number of the row, or none.
  std::uint32_t find(const Limb* row) const { return slots_.empty() ? none : slots_[slot_of(row)]; }

 private:
  std::size_t slot_of(const Limb* row) const {
    Limb h = 0x9e3779b97f4a7c15u;
    for (std::size_t i = 0; i < stride_; ++i) {
      h = (h ^ row[i]) * 0xff51afd7ed558ccdu;
      h ^= h >> 32;
    }
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t s = h & mask;; s = (s + 1) & mask)
      if (slots_[s] == none || std::equal(row, row + stride_, &rows_[slots_[s] * stride_])) return s;
  }
  void grow() {
    slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), none);
    for (std::uint32_t id = 0; id < size(); ++id) slots_[slot_of((*this)[id])] = id;
  }

  std::size_t stride_;
  std::vector<Limb> rows_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace sightline
