#pragma once
// Small scenes from a seed for weak visibility: a source polygon, targets, and where it is known by construction, the truth. They come in threes: seeds 3 k, 3 k + 1,
// 3 k + 2 are one scene whose faces touch exactly, are 2^-40 apart, and overlap by 2^-40.

#include "drafts.h"

#include <functional>

namespace weak_scenes {

struct Family {
  std::string name;
  std::function<Weak_scene(std::uint64_t seed)> make;  ///< the same seed gives the same scene
};

struct Drafter {
  const char* name;
  Draft (*draft)(Random& random, const Rational& gap);
};
inline constexpr std::array drafters{Drafter{"shared_edges", shared_edges},
                                     Drafter{"cracks", cracks},
                                     Drafter{"t_junctions", t_junctions},
                                     Drafter{"coplanar_overlap", coplanar_overlap},
                                     Drafter{"slats", slats},
                                     Drafter{"edges_in_one_plane", edges_in_one_plane},
                                     Drafter{"concurrent_edges", concurrent_edges},
                                     Drafter{"regulus", regulus},
                                     Drafter{"tangent", tangent},
                                     Drafter{"five_edges", five_edges},
                                     Drafter{"apertures", apertures},
                                     Drafter{"hinged", hinged},
                                     Drafter{"facing", facing},
                                     Drafter{"lids", lids},
                                     Drafter{"valley", valley},
                                     Drafter{"boxes", boxes},
                                     Drafter{"lattice_faces", lattice_faces},
                                     Drafter{"triangles", triangles}};

/// Faces and roles in random order, turned at random where that changes nothing, the whole in one of several positions.
inline Weak_scene finished(Draft draft, Random& random) {
  // What changes nothing: source and target in each other's place, occluders turned, more of them before what is hidden anyway.
  if (!draft.bodies && draft.targets.size() == 1 && random.chance(1, 3)) std::swap(draft.source, draft.faces[draft.targets[0]]);
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < draft.faces.size(); ++k) {
    order.push_back(k);
    if (!draft.bodies && std::count(draft.targets.begin(), draft.targets.end(), k) == 0) draft.faces[k] = either_way(draft.faces[k], random);
  }
  Faces extra;
  view_scenes::add_any(extra, random.below(3), random);
  const bool add_extra = random.chance(1, 3), add_source = !draft.bodies && random.chance(1, 4);
  random.shuffle(order);
  Faces faces;
  Weak_scene scene;
  for (const std::size_t k : order) {
    if (std::count(draft.targets.begin(), draft.targets.end(), k) > 0) scene.targets.push_back(static_cast<Face_id>(faces.size()));
    faces.push_back(draft.faces[k]);
  }
  if (add_extra && draft.truth == false) view_scenes::add(faces, extra);
  if (add_source) faces.push_back(draft.source);
  scene.soup = view_scenes::soup_of(faces), scene.source = draft.source, scene.truth = draft.truth;
  const sightline::Scene read(scene.soup);
  for (const sightline::Set_aside& face : read.set_aside()) std::erase(scene.targets, face.face);
  switch (random.below(5)) {
    case 0: return scene;
    case 1: return project(scene, random_axes(random));
    case 2: return project(scene, random_rotation(random));
    case 3: return project(scene, random_shear(random));
    default: return project(scene, random_projection(scene, random));
  }
}

inline Draft drafted(std::size_t which, std::uint64_t seed, Random& random) {
  const Rational gap = seed % 3 == 0 ? Rational(0) : seed % 3 == 1 ? tiny_gap() : Rational(-tiny_gap());
  return drafters[which].draft(random, gap);
}

/// One for each drafter; and any of them moved by 10^6, scaled by 2^-50, or with some coordinate of a face moved by 2^-40.
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
      add(drafters[which].name, [which](std::uint64_t seed, Random& random) { return finished(drafted(which, seed, random), random); });
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
