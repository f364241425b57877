#pragma once
// Why a face of a file is not modelled: the one list of reasons, and of what listings and certificates say for them.
// Proof: P-00

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace sightline {

enum class Set_aside_reason { zero_area, duplicate, self_intersecting, no_simple_projection };

/// The texts, in the order of the reasons. Behind "duplicate of " stands the id of the earlier face.
inline constexpr std::array<std::string_view, 4> set_aside_texts{"zero area", "duplicate of ", "self-intersecting",
                                                                 "not planar, with holes, and simple along no axis"};

constexpr std::string_view text_of(Set_aside_reason reason) {
  return set_aside_texts[static_cast<std::size_t>(reason)];
}

/// The reason that a text begins with, if it does with any.
constexpr std::optional<Set_aside_reason> set_aside_reason(std::string_view text) {
  for (std::size_t k = 0; k < set_aside_texts.size(); ++k)
    if (text.starts_with(set_aside_texts[k])) return static_cast<Set_aside_reason>(k);
  return std::nullopt;
}

}  // namespace sightline
