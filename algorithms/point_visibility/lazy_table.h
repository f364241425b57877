#pragma once
// A table whose rows are made when somebody first asks for them.

#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>

namespace sightline {

/// Rows in blocks of `block`, each made as a whole by the first thread that asks for one of its rows. What a row holds
/// must follow from its number alone: where two threads make the same block at once, one of them is thrown away.
/// References stay valid. Cost: O(n / block) to begin with, then O(1) a row, and a block where one is made.
template <class Row, std::size_t block>
class Lazy_table {
 public:
  Lazy_table() = default;
  explicit Lazy_table(std::size_t n) : rows_(n), blocks_(new std::atomic<Row*>[(n + block - 1) / block]()) {}
  Lazy_table(Lazy_table&& other) noexcept : rows_(std::exchange(other.rows_, 0)), blocks_(std::move(other.blocks_)) {}
  Lazy_table& operator=(Lazy_table&& other) noexcept {
    std::swap(rows_, other.rows_);
    std::swap(blocks_, other.blocks_);
    return *this;
  }
  ~Lazy_table() {
    for (std::size_t b = 0; b * block < rows_; ++b) delete[] blocks_[b].load(std::memory_order_relaxed);
  }

  /// Row i, by make(i) where it is not there yet.
  template <class Make>
  const Row& at(std::size_t i, const Make& make) const {
    const Row* rows = blocks_[i / block].load(std::memory_order_acquire);
    if (rows == nullptr)
      rows = fill(i / block, make);  // one expression with ?: and [] goes wrong in g++ 12 under sanitizers
    return rows[i % block];
  }

 private:
  template <class Make>
  [[gnu::noinline]] const Row* fill(std::size_t b, const Make& make) const {
    std::unique_ptr<Row[]> rows(new Row[block]);
    for (std::size_t k = 0; k < block && b * block + k < rows_; ++k) rows[k] = make(b * block + k);
    Row* there = nullptr;
    if (blocks_[b].compare_exchange_strong(there, rows.get(), std::memory_order_acq_rel)) return rows.release();
    return there;
  }

  std::size_t rows_ = 0;
  std::unique_ptr<std::atomic<Row*>[]> blocks_;
};

}  // namespace sightline
