#pragma once
// Small scenes from a seed for weak visibility: a source polygon, targets, and where it is known by construction, the
// truth. They come in threes: seeds 3 k, 3 k + 1, 3 k + 2 are one scene whose faces touch exactly, are 2^-40 apart, and
// overlap by 2^-40.

#include "../point_visibility/oracle.h"

#include <sightline/harness/generate/weak_scenes.h>

#include <cstdlib>
#include <functional>

namespace weak_scenes {

using namespace sightline::generate::weak_drafts;
using sightline::cross;
using sightline::Exact_point;
using sightline::Face_id;
using sightline::Integer;
using sightline::minus;
using sightline::Polygon_soup;
using sightline::Rational;
using sightline::generate::along;
using sightline::generate::at;
using sightline::generate::centroid;
using sightline::generate::either_way;
using sightline::generate::Faces;
using sightline::generate::image;
using sightline::generate::integer;
using sightline::generate::lattice;
using sightline::generate::Points;
using sightline::generate::project;
using sightline::generate::Projective_map;
using sightline::generate::Random;
using sightline::generate::random_axes;
using sightline::generate::random_projection;
using sightline::generate::ratio;
using sightline::generate::rectangle;
using sightline::generate::reversed;
using sightline::generate::scaling;
using sightline::generate::soup_of;
using sightline::generate::Weak_scene;

/// How many seeds to take where so many are usual: SIGHTLINE_LONG=N times as many.
inline std::uint64_t seeds(std::uint64_t usual) {
  const char* more = std::getenv("SIGHTLINE_LONG");
  return more != nullptr ? usual * static_cast<std::uint64_t>(std::max(1L, std::atol(more))) : usual;
}

inline const Rational& tiny_gap() {
  static const Rational gap(1, 1ul << 40);
  return gap;
}

struct Family {
  std::string name;
  std::function<Weak_scene(std::uint64_t seed)> make;  ///< the same seed gives the same scene
};

inline Draft drafted(std::size_t which, std::uint64_t seed, Random& random) {
  const Rational gap = seed % 3 == 0 ? Rational(0) : seed % 3 == 1 ? tiny_gap() : Rational(-tiny_gap());
  return drafters[which].draft(random, gap);
}

/// One for each drafter; and any of them moved by 10^6, scaled by 2^-50, or with some coordinate of a face moved by
/// 2^-40.
inline const std::vector<Family>& families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> list;
    const auto add = [&](const std::string& name, auto make) {
      const std::uint64_t number = list.size();
      list.push_back({name, [name, make, number](std::uint64_t seed) {
                        Random random(seed / 3 * 64 + number);
                        Weak_scene scene = make(seed, random);
                        scene.name = name + ' ' + std::to_string(seed);
                        return scene;
                      }});
    };
    for (std::size_t which = 0; which < drafters.size(); ++which)
      add(drafters[which].name,
          [which](std::uint64_t seed, Random& random) { return finished(drafted(which, seed, random), random); });
    add("far", [](std::uint64_t seed, Random& random) {
      const Draft draft = drafted(random.below(drafters.size()), seed, random);
      return project(finished(draft, random), scaling(1, at(1000000, -1000000, 1000000)));
    });
    add("tiny", [](std::uint64_t seed, Random& random) {
      const Draft draft = drafted(random.below(drafters.size()), seed, random);
      return project(finished(draft, random), scaling(Rational(1, 1ul << 50), at(0, 0, 0)));
    });
    add("nudged", [](std::uint64_t seed, Random& random) {
      const Draft draft = drafted(random.below(drafters.size()), seed, random);
      Weak_scene scene = finished(draft, random);
      for (std::size_t count = 1 + random.below(3); count > 0; --count) {
        const std::size_t chosen = random.below(scene.soup.point_count()), axis = random.below(3);
        const long sign = random.chance(1, 2) ? 1 : -1;
        scene.soup = sightline::generate::mapped(scene.soup, [&](sightline::Point_id id, Exact_point p) {
          if (id == chosen) p[axis] += sign * tiny_gap();
          return p;
        });
      }
      scene.truth.reset();
      return scene;
    });
    return list;
  }();
  return all;
}

}  // namespace weak_scenes
