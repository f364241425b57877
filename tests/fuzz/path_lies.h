#pragma once
// Lies about what an eye sees on its way, each by a name.

#include "claims.h"
#include "lies.h"

#include <algorithm>
#include <utility>

namespace fuzz {

/// One face is said to be seen, or not to be, at a moment or between two; its proofs beside that go on there.
inline bool of_a_while(Along_certificate& claim, const Posed_scene&, Bytes& bytes) {
  using Range = Along_certificate::Range;
  if (claim.fragments.empty() || claim.proofs.empty()) return false;
  const std::size_t fragment = any_of_first(claim.fragments, bytes), last = claim.moments.size() - 1;
  const Face_id face = claim.fragments[fragment].face;
  const std::size_t low = bytes.below(std::min<std::size_t>(256, last)), high = low + bytes.below(2);
  const bool is_seen = said_to_be_seen(claim, {low, high}).contains(face);
  std::vector<Range> seen;  // by places
  for (std::size_t k = 0; k <= last; ++k)
    for (const Range& place : {Range{k, k}, Range{k, k + 1}})
      if (place.high <= last &&
          said_to_be_seen(claim, place).contains(face) != (place.low == low && place.high == high))
        seen.push_back(place);
  std::erase_if(claim.faces, [&](const auto& of) { return of.face == face; });
  claim.faces.push_back({face, std::move(seen)});
  const std::size_t way = bytes.below(3);
  for (Along_certificate::Proof& proof : claim.proofs)
    if (way > 0 && proof.cone.empty() == is_seen && claim.fragments[proof.fragment].face == face &&
        proof.range.low <= high && low <= proof.range.high) {
      proof.range = {std::min(proof.range.low, low), std::max(proof.range.high, high)};
      if (way == 2) proof.range = {std::max<std::size_t>(proof.range.low, 1) - 1, std::min(proof.range.high + 1, last)};
    }
  if (bytes.below(3) == 0) {
    Along_certificate::Proof proof = claim.proofs[any_of_first(claim.proofs, bytes)];
    proof.fragment = fragment;
    proof.range = {low, high};
    claim.proofs.push_back(std::move(proof));
  }
  return true;
}

inline const std::vector<Lie<Along_certificate>>& lies_in(const Along_certificate&) {
  using Claim = Along_certificate;
  using Proof = Along_certificate::Proof;
  using Node = Along_certificate::Node;
  static const std::vector<Lie<Claim>> all = with_lies_about_fragments<Claim>(
      {{"from the true eye", [](Claim& claim, const Posed_scene& truth,
                                Bytes&) { return std::exchange(claim.from, truth.eye) != truth.eye; }},
       {"an end nudged", [](Claim& claim, const Posed_scene&,
                            Bytes& bytes) { return nudge(bytes.below(2) == 0 ? claim.from : claim.to, bytes); }},
       {"two-sided or not",
        [](Claim& claim, const Posed_scene&, Bytes&) {
          claim.two_sided = !claim.two_sided;
          return true;
        }},
       {"cones exchanged",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) { return exchange(claim.proofs, bytes, &Proof::cone); }},
       {"trees exchanged",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) { return exchange(claim.proofs, bytes, &Proof::tree); }},
       {"ranges exchanged",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) { return exchange(claim.proofs, bytes, &Proof::range); }},
       {"claims exchanged", [](Claim& claim, const Posed_scene&,
                               Bytes& bytes) { return exchange(claim.faces, bytes, &Along_certificate::Face::seen); }},
       {"what blocks exchanged",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          return !claim.proofs.empty() &&
                 exchange(claim.proofs[any_of_first(claim.proofs, bytes)].tree, bytes, &Node::blocked);
        }},
       {"cuts exchanged",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          return !claim.proofs.empty() &&
                 exchange(claim.proofs[any_of_first(claim.proofs, bytes)].tree, bytes, &Node::cut);
        }},
       {"a side turned",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.proofs.empty()) return false;
          Proof& proof = claim.proofs[any_of_first(claim.proofs, bytes)];
          if (proof.cone.empty()) return false;
          proof.cone[any_of_first(proof.cone, bytes)].sign *= -1;
          return true;
        }},
       {"a range twice",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.faces.empty()) return false;
          Along_certificate::Face& face = claim.faces[any_of_first(claim.faces, bytes)];
          if (face.seen.empty()) return false;
          const Along_certificate::Range range = face.seen[any_of_first(face.seen, bytes)];
          face.seen.push_back(range);
          return true;
        }},
       {"a proof left out",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) { return remove_any(claim.proofs, bytes); }},
       {"seen for a while, or not", of_a_while}});
  return all;
}

}  // namespace fuzz
