#pragma once
// What runs out when: items by a time that only goes forward.

#include <bit>
#include <cstdint>
#include <vector>

namespace sightline {

/// Items by the time at which they run out: a radix heap, as the time never goes back. Times are doubles >= 0, compared as their bits are.
/// Cost: amortized constant for an item and each binary order of magnitude between its time and now. Exact: yes.
class Expiry_queue {
 public:
  /// Pre: time >= now().
  void push(double time, std::uint32_t item) {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(time);
    buckets_[static_cast<std::size_t>(64 - std::countl_zero(bits ^ now_))].push_back({bits, item});
    ++size_;
  }
  /// Moves on to a time and takes out the items that ran out before it (not at it), appended to `expired` in an order that depends on nothing but the calls so far. Pre: time >= now().
  void advance(double time, std::vector<std::uint32_t>& expired) {
    const std::uint64_t now = std::bit_cast<std::uint64_t>(time);
    // Above the highest bit in which the time changes, buckets stay what they are.
    const std::size_t touched = static_cast<std::size_t>(64 - std::countl_zero(now ^ now_));
    now_ = now;
    for (std::size_t k = 0; k <= touched && touched > 0; ++k) {
      moved_.swap(buckets_[k]);
      for (const Entry& entry : moved_) {
        if (entry.time < now) expired.push_back(entry.item), --size_;
        else buckets_[static_cast<std::size_t>(64 - std::countl_zero(entry.time ^ now))].push_back(entry);
      }
      moved_.clear();
    }
  }
  double now() const { return std::bit_cast<double>(now_); }
  std::size_t size() const { return size_; }
  void clear() {
    for (auto& bucket : buckets_) bucket.clear();
    size_ = 0;
  }

 private:
  struct Entry {
    std::uint64_t time;
    std::uint32_t item;
  };
  std::vector<Entry> buckets_[65];  // by the highest bit in which an item's time differs from now, plus one
  std::vector<Entry> moved_;
  std::uint64_t now_ = 0;
  std::size_t size_ = 0;
};

}  // namespace sightline
