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
  std::size_t size() const { return count_; }
  /// Room for so many rows, all together.
  void reserve(std::size_t rows);
  const Limb* operator[](std::size_t id) const { return &rows_[id * stride_]; }

  /// The number of the row; a new one if there was none like it. Pre: `row` does not point into the table.
  std::uint32_t intern(const Limb* row);

  /// The number of the row, or none.
  std::uint32_t find(const Limb* row) const { return slots_.empty() ? none : slots_[slot_of(row, hash_of(row))].row; }

 private:
  /// A row, and some bits of its hash: most others are told from it without a look at it, and tables grow without one.
  struct Slot {
    std::uint32_t row = none, hash = 0;
  };
  std::uint32_t hash_of(const Limb* row) const;
  std::size_t slot_of(const Limb* row, std::uint32_t hash) const;
  void grow(std::size_t slots);

  std::size_t stride_, count_ = 0;
  std::vector<Limb> rows_;
  std::vector<Slot> slots_;  // a power of two of them, at most half of them taken
};

}  // namespace sightline
