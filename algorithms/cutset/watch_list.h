#pragma once
// Watched nodes side by side: their planes, and how long each node's status holds. Laws, tested: a move tests what ran
// out and nothing else; what is not confirmed is handed out, once.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sightline {

/// Nodes in places, each with its row (see On_view) and the length of path up to which its status holds. Sixteen of
/// them are a block, tested at one go, two doubles at a time; a block, and a group of blocks, in which nothing ran out
/// is passed over. A place that was given up is the next to be taken. Cost: of a move O(places / 512 + blocks in which
/// something ran out), else constant. Memory: 52 bytes for each place. Exact: filtered, what doubles leave open is
/// handed out. Proof: P-51
class Watch_list {
 public:
  static constexpr std::uint32_t nowhere = ~std::uint32_t{0};
  static constexpr double far = 0x1p1000;  ///< no status holds longer

  /// What a move confirmed.
  struct Confirmed {
    std::uint64_t nodes = 0, away = 0;  ///< all, and those not at the cut-set
  };

  /// A place, to be set before anything else is done.
  std::uint32_t take() {
    if (free_.empty()) {
      const std::uint32_t begin = static_cast<std::uint32_t>(block_size * blocks_.size());
      if (blocks_.size() % group_size == 0) first_of_group_.push_back(never);
      blocks_.emplace_back();
      first_.push_back(never);
      for (std::uint32_t k = block_size; k-- > 0;) free_.push_back(begin + k);
    }
    const std::uint32_t place = free_.back();
    free_.pop_back();
    return place;
  }
  /// The row is kept with the status as its sign: a height is positive while the status stays.
  template <class Row>
  void set(std::uint32_t place, std::uint32_t node, const Row& row, bool on, double until, bool at_cut) {
    const std::uint32_t k = place % block_size;
    Block& block = blocks_[place / block_size];
    Two& two = block.rows[k / 2];
    const double sign = on ? 1 : -1;
    two.a[k % 2] = sign * row.a;
    two.b[k % 2] = sign * row.b;
    two.c[k % 2] = sign * row.c;
    two.d[k % 2] = sign * row.d;
    block.node[k] = node;
    set_until(place, until);
    set_at_cut(place, at_cut);
  }
  void set_until(std::uint32_t place, double until) {
    blocks_[place / block_size].until[place % block_size / 2][place % 2] = until;
    for (double* first : {&first_[place / block_size], &first_of_group_[place / (block_size * group_size)]})
      *first = std::min(*first, until);
  }
  void set_at_cut(std::uint32_t place, bool at_cut) {
    std::uint64_t& bits = blocks_[place / block_size].at_cut;
    const std::uint32_t k = place % block_size;
    bits = (bits & ~(std::uint64_t{1} << k)) | std::uint64_t{at_cut} << k;
  }
  /// Gives the place up. Returns how long its node's status holds.
  double remove(std::uint32_t place) {
    const std::uint32_t k = place % block_size;
    Block& block = blocks_[place / block_size];
    const double until = block.until[k / 2][k % 2];
    block.node[k] = nowhere;
    block.until[k / 2][k % 2] = never;
    free_.push_back(place);
    return until;
  }
  /// No status holds any more.
  void forget_all() {
    for (std::uint32_t b = 0; b < blocks_.size(); ++b)
      for (std::uint32_t k = 0; k < block_size; ++k)
        if (blocks_[b].node[k] != nowhere) set_until(b * block_size + k, -1);
  }

  /// Tests the nodes whose status held to less than `path`, in doubles. Those that it does not confirm are appended to
  /// `open`: set_until(), set() or remove() must follow for each.
  template <class Eye>
  Confirmed test(const Eye& eye, double path, std::vector<std::uint32_t>& open) {
    Confirmed confirmed;
    for (std::size_t g = 0; g < first_of_group_.size(); ++g) {
      if (first_of_group_[g] >= path) continue;
      double first = never;
      for (std::size_t b = g * group_size; b < std::min((g + 1) * group_size, blocks_.size()); ++b) {
        if (first_[b] < path) {
          Block& block = blocks_[b];
          const auto [confirmed_bits, open_bits] = test_block(block, eye, path, first_[b]);
          confirmed.nodes += static_cast<std::uint64_t>(std::popcount(confirmed_bits));
          confirmed.away += static_cast<std::uint64_t>(std::popcount(confirmed_bits & ~block.at_cut));
          for (std::uint64_t bits = open_bits; bits != 0; bits &= bits - 1)
            open.push_back(block.node[static_cast<std::size_t>(std::countr_zero(bits))]);
        }
        first = std::min(first, first_[b]);
      }
      first_of_group_[g] = first;
    }
    return confirmed;
  }

 private:
  static constexpr std::uint32_t block_size = 16, group_size = 32;
  static constexpr double never = std::numeric_limits<double>::infinity();
  using Doubles [[gnu::vector_size(16)]] = double;
  using Bits [[gnu::vector_size(16)]] = std::uint64_t;
  struct alignas(64) Two {
    Doubles a, b, c, d;
  };
  struct Block {
    std::array<Two, block_size / 2> rows{};
    std::array<Doubles, block_size / 2> until;  // never: a free place, or one that test() left open
    std::array<std::uint32_t, block_size> node;
    std::uint64_t at_cut = 0;  // bit k: node k
    Block() {
      until.fill(Doubles{never, never});
      node.fill(nowhere);
    }
  };

  /// All nodes of a block, whether they ran out or not; what did not stays what it was. Returns two sets of those that
  /// did, confirmed and open; `first` becomes the least that one of the others holds.
  template <class Eye>
  static std::array<std::uint64_t, 2> test_block(Block& block, const Eye& eye, double path, double& first) {
    const Doubles now{path, path}, latest{far, far}, zero{}, nevers{never, never};
    Doubles least = nevers;
    Bits bit{1, 2}, expired{}, open{};
    for (std::size_t k = 0; k < block_size / 2; ++k) {
      const Two& two = block.rows[k];
      const Doubles clear = two.a * eye.x + two.b * eye.y + two.c * eye.z + two.d * eye.w - eye.bound,
                    old = block.until[k];
      Doubles until = (path + clear) * (1 - 0x1p-52);  // rounded down
      until = until < latest ? until : latest;
      until = until > now ? until : now;
      until = clear > zero ? until : nevers;
      until = old < now ? until : old;
      const Bits ran_out = std::bit_cast<Bits>(old < now) & bit;
      expired |= ran_out;
      open |= ran_out & ~std::bit_cast<Bits>(clear > zero);  // not clear <= 0: it may be no number
      bit += bit;
      bit += bit;
      least = until < least ? until : least;
      block.until[k] = until;
    }
    first = std::min(least[0], least[1]);
    return {(expired[0] | expired[1]) & ~(open[0] | open[1]), open[0] | open[1]};
  }

  std::vector<Block> blocks_;
  std::vector<double> first_, first_of_group_;  // no node of the block, or of the group, runs out earlier
  std::vector<std::uint32_t> free_;
};

}  // namespace sightline
