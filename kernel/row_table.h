#pragma once
// Rows of limbs, each kept once and numbered: what points, planes and lines are interned in.

#include <sightline/kernel/fixed_integer.h>

#include <cstddef>
#include <cstdint>
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
  std::uint32_t intern(const Limb* row);

  /// The number of the row, or none.
  std::uint32_t find(const Limb* row) const { return slots_.empty() ? none : slots_[slot_of(row)]; }

 private:
  std::size_t slot_of(const Limb* row) const;
  void grow();

  std::size_t stride_;
  std::vector<Limb> rows_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace sightline
