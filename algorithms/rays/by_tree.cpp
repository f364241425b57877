#include <sightline/algorithms/rays/by_tree.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace sightline {

namespace {

enum class Wanted_hits { first, all };

/// The parts of a ray that fragments hold, nearer cells first; where the first hit is wanted, no cells beyond one.
std::vector<Face_hit> parts_by_tree(const Exact_traits& traits, const Exact_tree& tree, const Exact_ray& ray,
                                    Ray_start start, Wanted_hits wanted) {
  const bsp_detail::Grid_ray grid(traits, ray);
  std::vector<Face_hit> parts;
  std::optional<Rational> first;  // the least t that counts
  const auto add = [&](const Fragment<Exact_traits>& fragment, Met_side side, const Rational& t,
                       const Rational& until) {
    if ((start == Ray_start::closed || t > 0) && (!first || t < *first)) first = t;
    parts.push_back({traits.face(fragment.polygon.piece), side, t, until});
  };
  bsp_detail::walk_along(
      tree, grid, [&](const Rational& from) { return wanted == Wanted_hits::first && first && *first < from; },
      [&](const Fragment<Exact_traits>& fragment, const std::array<Rational, 2>& range) {
        add(fragment, Met_side::along, range[0], range[1]);
      },
      [&](const Fragment<Exact_traits>& fragment, const Rational& t, bool rises) {
        add(fragment, rises != fragment.same_sense ? Met_side::front : Met_side::back, t, t);
      });
  return parts;
}

}  // namespace

std::vector<Face_hit> all_hits(const Exact_traits& traits, const Exact_tree& tree, const Exact_ray& ray,
                               Ray_start start) {
  check_direction(ray);
  return hits_of(parts_by_tree(traits, tree, ray, start, Wanted_hits::all), start);
}

std::vector<Face_hit> first_hits(const Exact_traits& traits, const Exact_tree& tree, const Exact_ray& ray,
                                 Ray_start start) {
  check_direction(ray);
  std::vector<Face_hit> parts = parts_by_tree(traits, tree, ray, start, Wanted_hits::first);
  // What runs along a face may go on in other fragments, far behind.
  if (std::any_of(parts.begin(), parts.end(), [](const Face_hit& part) { return part.t < part.until; }))
    parts = parts_by_tree(traits, tree, ray, start, Wanted_hits::all);
  return only_first(hits_of(std::move(parts), start));
}

}  // namespace sightline
