#pragma once
// Faces that let light through, and all of them that a ray meets, in rationals.

#include "../point_visibility/oracle.h"

#include <sightline/algorithms/image/colour.h>

#include <array>
#include <tuple>

namespace image_test {

using namespace sightline;

inline std::vector<Tint> any_tints(std::size_t pieces, generate::Random& random) {
  std::vector<Tint> tints;
  for (std::size_t i = 0; i < pieces; ++i) {
    Tint& tint = tints.emplace_back();
    for (double& c : tint.colour) c = static_cast<double>(random.below(256));
    tint.alpha = std::array<double, 5>{0, 0.25, 0.5, 0.75, 1}[random.below(5)];
  }
  return tints;
}

/// All layers that a ray meets, up to one that hides all.
struct Stack {
  Layer layer;
  bool tied = false;
};

inline Stack brute_stack(const oracle::Flats& flats, const Exact_point& eye, const Exact_point& direction,
                         const std::vector<Tint>& tints) {
  struct Hit {
    Rational t;
    std::tuple<bool, Face_id, std::uint32_t> rank;
    std::uint32_t piece;
    bool on_border;
  };
  std::vector<Hit> hits;
  for (std::uint32_t i = 0; i < flats.size(); ++i)
    if (const std::optional<Rational> t = oracle::crossing(flats[i], eye, direction))
      if (const int inside = flats[i].holds(oracle::along(eye, *t, direction)); inside >= 0)
        hits.push_back({*t, {sgn(flats[i].height(eye)) < 0, flats[i].face, flats[i].number}, i, inside == 0});
  std::sort(hits.begin(), hits.end(),
            [](const Hit& a, const Hit& b) { return std::tie(a.t, a.rank) < std::tie(b.t, b.rank); });
  Stack stack;
  for (std::size_t k = 0; k < hits.size(); ++k) {
    const bool shared = (k > 0 && hits[k - 1].t == hits[k].t) || (k + 1 < hits.size() && hits[k + 1].t == hits[k].t);
    stack.tied = stack.tied || hits[k].on_border || shared;
    stack.layer.put_behind(tints[hits[k].piece]);
    if (tints[hits[k].piece].alpha == 1) break;
  }
  return stack;
}

}  // namespace image_test
