#pragma once
// Which piece may hide a whole part of a scene from a source, found for boxes of pieces at once.

#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace sightline {

inline constexpr std::uint32_t no_blocker = std::numeric_limits<std::uint32_t>::max();

/// For each piece of the scene another one that seems to block all lines to it from the source, or `no_blocker`. From
/// the root of the tree of boxes down: of the pieces on the line of middles of source and box one that blocks all lines
/// to the box's corners serves all that is in it. In doubles, for proposals: they are checked pair by pair. When time
/// runs out, those that were found. Cost: a line for each box that no piece blocks, or that is the first of its kind.
std::vector<std::uint32_t> likely_blockers(const Occluders& occluders, const Weak_source& source,
                                           const std::function<bool()>& out_of_time = {});

}  // namespace sightline
