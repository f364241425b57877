#pragma once
// Where an order's certificate says that planes cut its sequence (Order_cuts): kept up where fragments come and go,
// told otherwise, which changes no verdict, and made to look right where the order is wrong.

#include "claims.h"
#include "mutate.h"

#include <sightline/algorithms/verify/order.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace fuzz {

using Cut_plane = std::array<Rational, 4>;

// ---- Fragments come and go

/// One more fragment, before the k-th, at whose depth it is.
inline void insert_fragment(Order_certificate& claim, std::size_t k, const Order_fragment& fragment) {
  std::vector<std::uint32_t>& depths = claim.cuts.depths;
  if (!depths.empty() && depths.size() == claim.fragments.size())
    depths.insert(depths.begin() + static_cast<std::ptrdiff_t>(k), depths[std::min(k, depths.size() - 1)]);
  for (Order_cuts::Cut& cut : claim.cuts.others) cut.place += cut.place > k;
  claim.fragments.insert(claim.fragments.begin() + static_cast<std::ptrdiff_t>(k), fragment);
}
inline void remove_fragment(Order_certificate& claim, std::size_t k) {
  std::vector<std::uint32_t>& depths = claim.cuts.depths;
  if (depths.size() == claim.fragments.size()) depths.erase(depths.begin() + static_cast<std::ptrdiff_t>(k));
  for (Order_cuts::Cut& cut : claim.cuts.others) cut.place -= cut.place > k;
  claim.fragments.erase(claim.fragments.begin() + static_cast<std::ptrdiff_t>(k));
}

// ---- Planes

inline Cut_plane turned(Cut_plane plane) {
  for (Rational& x : plane) x = -x;
  return plane;
}
/// Through three points; all zeros where they are on a line.
inline Cut_plane plane_through(const Exact_point& p, const Exact_point& q, const Exact_point& r) {
  Cut_plane plane;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t x = (k + 1) % 3, y = (k + 2) % 3;
    plane[k] = (q[x] - p[x]) * (r[y] - p[y]) - (q[y] - p[y]) * (r[x] - p[x]);
    plane[3] -= plane[k] * p[k];
  }
  return plane;
}
inline Cut_plane plane_of(const Order_fragment& fragment) {
  const Points& loop = fragment.vertices;
  Cut_plane plane;
  for (std::size_t k = 2; k < loop.size() && plane == Cut_plane{}; ++k)
    plane = plane_through(loop[0], loop[k - 1], loop[k]);
  return plane;
}

/// One that has to do with a fragment, or with nothing: its own, one through the eye and two corners, that of another
/// cut, an ulp or so beside it, with large coefficients, none.
inline Cut_plane any_plane(const Order_certificate& claim, const Order_fragment& near, Mutator& random) {
  const Points& loop = near.vertices;
  Cut_plane plane = plane_of(near);
  switch (random.below(8)) {
    case 0:
    case 1: break;
    case 2:
    case 3: {
      const std::size_t k = random.below(loop.size());
      plane = plane_through(claim.eye, loop[k], loop[(k + 1) % loop.size()]);
    } break;
    case 4:
      if (!claim.cuts.others.empty()) plane = claim.cuts.others[random.below(claim.cuts.others.size())].plane;
      break;
    case 5: {
      Rational step = 1;
      mpq_div_2exp(step.get_mpq_t(), step.get_mpq_t(), random.below(100));
      plane[random.below(4)] += step;
    } break;
    case 6: {
      Rational scale = 1;
      if (random.below(2) == 0) mpq_mul_2exp(scale.get_mpq_t(), scale.get_mpq_t(), 1100);
      else mpq_div_2exp(scale.get_mpq_t(), scale.get_mpq_t(), 1100);
      for (Rational& x : plane) x *= scale;
    } break;
    default:  // often none
      for (Rational& x : plane) x = random.below(2) == 0 ? 0 : static_cast<long>(random.below(5)) - 2;
      if (random.below(2) == 0) plane = {};
  }
  return random.below(2) == 0 ? plane : turned(plane);
}

// ---- Told otherwise

/// A cut anywhere, or nowhere.
inline Order_cuts::Cut any_cut(const Order_certificate& claim, Mutator& random) {
  constexpr std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
  const std::size_t count = claim.fragments.size(), place = random.below(count + 2);
  const auto depth = static_cast<std::uint32_t>(random.below(random.below(2) == 0 ? 2 : count + 2));
  return {random.below(16) == 0 ? most : static_cast<std::uint32_t>(place), random.below(16) == 0 ? most : depth,
          any_plane(claim, claim.fragments[std::min(place, count - 1)], random)};
}

/// Changes cuts, and nothing else.
inline void retell_cuts(Order_certificate& claim, Mutator& random) {
  if (claim.fragments.empty()) return;
  auto& [depths, others] = claim.cuts;
  const std::size_t count = claim.fragments.size();
  const auto any_depth = [&] { return static_cast<std::uint32_t>(random.below(1 + random.below(count + 1))); };
  switch (random.below(10)) {
    case 0: claim.cuts = {}; break;
    case 1: others.clear(); break;
    case 2:  // none of them counts
      if (random.below(2) == 0) depths.push_back(any_depth());
      else depths.resize(depths.size() / 2);
      break;
    case 3:
      depths.resize(count);
      for (std::uint32_t& depth : depths) depth = any_depth();
      break;
    case 4:  // one at a time, from one end or the other
      depths.resize(count);
      for (std::size_t k = 0; k < count; ++k) depths[k] = static_cast<std::uint32_t>(k);
      if (random.below(2) == 0) std::reverse(depths.begin(), depths.end());
      break;
    case 5:
      if (depths.size() > 1) std::swap(depths[random.below(depths.size())], depths[random.below(depths.size())]);
      break;
    case 6:
      if (!others.empty()) others.erase(others.begin() + static_cast<std::ptrdiff_t>(random.below(others.size())));
      break;
    case 7:
      if (!others.empty()) {
        Order_cuts::Cut& cut = others[random.below(others.size())];
        if (random.below(2) == 0) cut.plane = any_plane(claim, claim.fragments[random.below(count)], random);
        else cut = {any_cut(claim, random).place, cut.depth, cut.plane};
      }
      break;
    default:
      depths.resize(count);
      for (std::size_t left = 1 + random.below(4); left > 0; --left) others.push_back(any_cut(claim, random));
      if (random.below(4) == 0) others.insert(others.end(), others.begin(), others.begin() + 1);
  }
}

// ---- Made to look right

/// Fragments that are exchanged, and before the second one a cut first of all by a plane that has to do with one of
/// them: one of many such planes has each on its side, seen from where the eye is not.
inline bool exchanged_across_a_cut(Order_certificate& claim, Mutator& random) {
  const std::size_t count = claim.fragments.size();
  if (count < 2) return false;
  const std::size_t i = random.below(count - 1), j = random.below(2) == 0 ? i + 1 : i + 1 + random.below(count - 1 - i);
  std::swap(claim.fragments[i], claim.fragments[j]);
  claim.cuts.depths.resize(count);
  for (std::uint32_t& depth : claim.cuts.depths) ++depth;
  for (Order_cuts::Cut& cut : claim.cuts.others) cut.depth += cut.depth < std::numeric_limits<std::uint32_t>::max();
  const Order_fragment& near = claim.fragments[random.below(2) == 0 ? i : j];
  claim.cuts.others.push_back(
      {static_cast<std::uint32_t>(i + 1 + random.below(j - i)), 0, any_plane(claim, near, random)});
  return true;
}

/// What comes before a node of the tree after it, and the other way round, as if the eye were on the other side; with
/// its plane, and those within, turned, or not, and the fragments' planes said, or not.
inline bool sides_exchanged(Order_certificate& claim, Mutator& random) {
  auto& [depths, others] = claim.cuts;
  const std::size_t count = claim.fragments.size();
  if (count < 2 || depths.size() != count) return false;
  const std::size_t node = random.below(count);
  const std::uint32_t depth = depths[node];
  std::size_t begin = node, first = node, last = node + 1, end = node + 1;
  while (first > 0 && depths[first - 1] == depth) --first;
  while (last < count && depths[last] == depth) ++last;
  for (begin = first; begin > 0 && depths[begin - 1] > depth;) --begin;
  for (end = last; end < count && depths[end] > depth;) ++end;
  if (begin == first && end == last) return false;
  std::vector<std::size_t> order;
  for (std::size_t k = last; k < end; ++k) order.push_back(k);
  for (std::size_t k = first; k < last; ++k) order.push_back(k);
  for (std::size_t k = begin; k < first; ++k) order.push_back(k);
  const Order_certificate before = claim;
  for (std::size_t k = 0; k < order.size(); ++k) {
    claim.fragments[begin + k] = before.fragments[order[k]];
    depths[begin + k] = before.cuts.depths[order[k]];
  }
  const bool turn = random.below(2) == 0, say = random.below(2) == 0;
  for (Order_cuts::Cut& cut : others) {
    if (cut.place <= begin || cut.place >= end) continue;
    if (cut.place < first) cut.place += static_cast<std::uint32_t>(end - first);
    else if (cut.place > last) cut.place -= static_cast<std::uint32_t>(last - begin);
    else cut.place = static_cast<std::uint32_t>(begin + end - cut.place);
    if (turn) cut.plane = turned(cut.plane);
  }
  if (!say) return true;
  const Cut_plane plane = plane_of(before.fragments[node]);
  for (const std::size_t place : {begin + end - last, begin + end - first})
    others.push_back({static_cast<std::uint32_t>(place), depth, turn ? turned(plane) : plane});
  return true;
}

/// The whole sequence from its end, with planes turned, or not.
inline bool from_near_to_far(Order_certificate& claim, Mutator& random) {
  const std::size_t count = claim.fragments.size();
  if (count < 2) return false;
  std::reverse(claim.fragments.begin(), claim.fragments.end());
  std::reverse(claim.cuts.depths.begin(), claim.cuts.depths.end());
  const bool turn = random.below(2) == 0;
  for (Order_cuts::Cut& cut : claim.cuts.others) {
    cut.place = static_cast<std::uint32_t>(count - std::min<std::size_t>(count, cut.place));
    if (turn) cut.plane = turned(cut.plane);
  }
  for (std::size_t k = 0; k < count && random.below(2) == 0; ++k)
    claim.cuts.others.push_back({static_cast<std::uint32_t>(k + random.below(2)), 0, plane_of(claim.fragments[k])});
  return true;
}

/// Two fragments anywhere, with what is said of their depths.
inline bool exchanged_with_depths(Order_certificate& claim, Mutator& random) {
  const std::size_t count = claim.fragments.size();
  if (count < 2 || claim.cuts.depths.size() != count) return false;
  const std::size_t i = random.below(count), j = random.below(count);
  std::swap(claim.fragments[i], claim.fragments[j]);
  std::swap(claim.cuts.depths[i], claim.cuts.depths[j]);
  return i != j;
}

}  // namespace fuzz
