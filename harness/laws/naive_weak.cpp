#include <sightline/harness/laws/naive_weak.h>

#include <sightline/algorithms/baseline/doubles_search.h>
#include <sightline/algorithms/baseline/ray_sampling.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace sightline::harness {

namespace naive_weak {

using generate::Faces;
using generate::Points;

struct Lit_scene {
  Faces faces;
  Points source;
  std::vector<Face_id> seen;  ///< known to be, by their fronts
};

/// Convex, around the origin in the plane z = 0, front up.
Points any_source(Random& random) {
  Points all{{1, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {1, -1, 0}};
  all.erase(all.begin() + static_cast<std::ptrdiff_t>(random.below(6)));
  for (Exact_point& p : all) p[1] *= generate::ratio(2, 3);
  return all;
}

/// A box that the source is in the floor of, its walls and its ceiling in tiles.
Lit_scene room(Random& random) {
  Lit_scene made{{}, any_source(random), {}};
  const auto tile = [&](const Exact_point& p, const Exact_point& u, const Exact_point& v) {
    const auto at = [&](long i, long j) { return generate::along(generate::along(p, i, u), j, v); };
    made.seen.push_back(static_cast<Face_id>(made.faces.size()));
    made.faces.push_back({at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
  };
  for (long i = -1; i < 1; ++i)
    for (long j = 0; j < 2; ++j) {
      tile({3 * i, -3, 2 * j}, {0, 0, 2}, {3, 0, 0});  // each looks into the room
      tile({3 * i, 3, 2 * j}, {3, 0, 0}, {0, 0, 2});
      tile({-3, 3 * i, 2 * j}, {0, 3, 0}, {0, 0, 2});
      tile({3, 3 * i, 2 * j}, {0, 0, 2}, {0, 3, 0});
      tile({3 * i, 3 * (j - 1), 4}, {0, 3, 0}, {3, 0, 0});
    }
  return made;
}

/// Lids close above all parts of the source, and something above them.
Lit_scene lids(Random& random) {
  Lit_scene made{{}, any_source(random), {}};
  const auto close = [](const Exact_point& p) { return Exact_point{p[0], p[1], generate::ratio(1, 100)}; };
  const auto lid = [&](const Exact_point& p, const Exact_point& q, const Exact_point& r) {
    made.seen.push_back(static_cast<Face_id>(made.faces.size()));
    made.faces.push_back({close(p), close(r), close(q)});  // looks down
  };
  for (std::size_t k = 1; k + 1 < made.source.size(); ++k) {
    const Exact_point &p = made.source[0], &q = made.source[k], &r = made.source[k + 1];
    const Exact_point a = generate::centroid({p, q}), b = generate::centroid({q, r}), c = generate::centroid({r, p});
    lid(p, a, c);
    lid(a, q, b);
    lid(c, b, r);
    lid(a, b, c);
  }
  const Rational quarter(1, 4);
  made.faces.push_back(
      generate::reversed(generate::rectangle(-quarter, quarter, -quarter, quarter, generate::ratio(1, 2))));
  return made;
}

/// Plates over a source, at random: most of them across, or most of them upright, whose planes cut source and targets.
Lit_scene pile(Random& random) {
  Lit_scene made{{}, any_source(random), {}};
  const std::size_t count = 4 + random.below(5);
  const std::uint64_t upright = random.chance(1, 2) ? 1 : 5;  // of six
  for (std::size_t k = 0; k < count; ++k) {
    const auto any = [&](long reach) -> Rational { return generate::integer(random, -reach, reach) / 1000; };
    Exact_point middle{0, 0, 1 + Rational(static_cast<long>(k)) / 4}, u{generate::ratio(4, 5), 0, 0}, v{0, -u[0], 0};
    for (const std::size_t axis : {0, 1}) middle[axis] = any(900);
    u[2] = any(100);
    if (random.chance(upright, 6))
      for (const std::size_t axis : {0, 1, 2}) v[axis] = any(700);
    Points plate;
    for (const auto& [s, t] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
      plate.push_back(generate::along(generate::along(middle, s, u), t, v));
    made.faces.push_back(generate::either_way(std::move(plate), random));
  }
  return made;
}

/// A target behind two plates, with a gap between them or none, and with room either way.
Lit_scene past_two_plates(Random& random) {
  Lit_scene made{{}, any_source(random), {}};
  const Rational gap = (generate::integer(random, 0, 1) * 2 - 1) * generate::integer(random, 10, 100) / 1000;
  made.faces = {generate::rectangle(-4, 0, -3, 3, 1), generate::rectangle(gap, 4, -3, 3, 1),
                generate::reversed(generate::rectangle(-1, 1, -1, 1, 2))};
  return made;
}

/// The same turned, which floating-point numbers are to take as it is.
void turn(Lit_scene& made, Random& random) {
  const Exact_point by = generate::lattice(random, 3);
  const auto turned = [&](const Faces& faces) {
    const Polygon_soup soup = generate::rotated(
        generate::soup_of(faces),
        generate::rotation(4, by[0].get_num().get_si(), by[1].get_num().get_si(), by[2].get_num().get_si()));
    Faces all;
    for (Face_id f = 0; f < soup.face_count(); ++f) {
      all.emplace_back();
      for (const Point_id p : soup.loop(f)) all.back().push_back(soup.point(p));
    }
    return all;
  };
  made.faces = turned(made.faces);
  made.source = turned({made.source})[0];
}

/// Turns some of the faces round; without `two_sided` those are not seen.
void turn_some_round(Lit_scene& made, bool two_sided, Random& random) {
  std::vector<Face_id> seen;
  for (Face_id f = 0; f < made.faces.size(); ++f) {
    const bool is_turned = random.chance(1, 4);
    if (is_turned) made.faces[f] = generate::reversed(std::move(made.faces[f]));
    if ((!is_turned || two_sided) && std::binary_search(made.seen.begin(), made.seen.end(), f)) seen.push_back(f);
  }
  made.seen = std::move(seen);
}

std::string flaw_of_rays(Lit_scene made, Random& random) {
  Ray_sampling_options options;
  options.rays = 3000;
  options.seed = random.below(1000);
  options.two_sided = random.chance(1, 2);
  std::size_t told = 0;
  const bool listens = random.chance(3, 4);
  if (listens) options.progress = [&](std::size_t done, std::size_t all) { told += done <= all ? 1 : 1000000; };
  turn_some_round(made, options.two_sided, random);
  turn(made, random);
  const Scene scene(generate::soup_of(made.faces));
  const Occluders occluders(scene);
  const std::vector<Face_id> seen = visible_by_sampling(occluders, {weak_source(occluders, made.source)}, options);
  if (listens && (told == 0 || told > options.rays)) return "random rays tell nothing of their progress, or too much";
  if (seen == made.seen) return {};
  return "random rays see too little, or too much";
}

Doubles_search_options in_one_thread(bool two_sided) {
  Doubles_search_options options;
  options.two_sided = two_sided;
  options.threads = 1;
  return options;
}

std::string flaw_of_known(Lit_scene made, Random& random) {
  const bool two_sided = random.chance(1, 2);
  turn_some_round(made, two_sided, random);
  turn(made, random);
  const Scene scene(generate::soup_of(made.faces));
  const Occluders occluders(scene);
  const Weak_faces found =
      visible_by_doubles(occluders, {weak_source(occluders, made.source)}, in_one_thread(two_sided));
  for (const Face_id face : made.seen)
    if (!std::binary_search(found.visible.begin(), found.visible.end(), face))
      return "the search in doubles does not see " + face_name(face);
  return {};
}

std::string flaw_of_pile(Lit_scene made, Random& random) {
  const bool two_sided = random.chance(1, 2);
  turn(made, random);
  const Scene scene(generate::soup_of(made.faces));
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, made.source)};
  Weak_options options;
  options.threads = 1;
  options.search.two_sided = two_sided;
  const Weakly_visible truth = weakly_visible(occluders, sources, options);
  Doubles_search_options hasty = in_one_thread(two_sided);
  const bool is_hasty = random.chance(1, 4);
  if (is_hasty) {
    hasty.cells = 1 + random.below(30);
    hasty.halvings = static_cast<int>(random.below(3));
  }
  const Weak_faces found = visible_by_doubles(occluders, sources, hasty);
  const auto differ = [](const std::vector<Face_id>& a, const std::vector<Face_id>& b) {
    return std::any_of(a.begin(), a.end(), [&](Face_id f) { return std::binary_search(b.begin(), b.end(), f); });
  };
  if (differ(truth.visible, found.hidden)) return "the search in doubles hides what is proved visible";
  if (differ(truth.hidden, found.visible)) return "the search in doubles sees what is proved hidden";
  if (!is_hasty && found.undecided.size() > truth.undecided.size() + 1)
    return "the search in doubles does not decide what is easy";
  return {};
}

Outcome run(const Posed_scene&, Random& random) {
  std::string flaw = flaw_of_rays(room(random), random);
  if (flaw.empty()) flaw = flaw_of_rays(lids(random), random);
  if (flaw.empty()) flaw = flaw_of_known(room(random), random);
  for (int k = 0; k < 3 && flaw.empty(); ++k) flaw = flaw_of_pile(pile(random), random);
  if (flaw.empty()) flaw = flaw_of_pile(past_two_plates(random), random);
  return flaw.empty() ? Outcome{} : Outcome::failed(std::move(flaw));
}

}  // namespace naive_weak

Check naive_weak_check() {
  return check_of_a_share("naive", "random rays and a search in doubles, where what is seen is known or proved", 8,
                          naive_weak::run);
}

}  // namespace sightline::harness
