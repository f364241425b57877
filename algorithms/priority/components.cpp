#include <sightline/algorithms/priority/components.h>

#include <algorithm>
#include <utility>

namespace sightline {

Priority_components::Priority_components(std::vector<std::uint32_t> h, std::uint32_t count)
    : h_(std::move(h)), begin_(count + std::size_t{1}), members_(h_.size()) {
  for (const std::uint32_t c : h_) ++begin_[c + std::size_t{1}];
  for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t r = 0; r < h_.size(); ++r) members_[next[h_[r]]++] = r;
}

std::size_t Priority_components::largest() const {
  std::size_t most = 0;
  for (std::size_t c = 0; c < size(); ++c) most = std::max(most, (*this)[c].size());
  return most;
}

std::size_t Priority_components::cyclic() const {
  std::size_t count = 0;
  for (std::size_t c = 0; c < size(); ++c) count += (*this)[c].size() > 1;
  return count;
}

}  // namespace sightline
