#include <sightline/harness/laws/priority_laws.h>

#include <sightline/algorithms/priority/eye_order.h>
#include <sightline/algorithms/priority/pair_code.h>
#include <sightline/algorithms/priority/pixels.h>
#include <sightline/algorithms/priority/relation.h>
#include <sightline/algorithms/priority/scope.h>
#include <sightline/algorithms/priority/tree.h>
#include <sightline/harness/generate/pixel_views.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace sightline::harness {

namespace {

using Depth_of_face = std::pair<Rational, std::uint32_t>;  // along a ray

std::string pieces_named(std::size_t i, std::size_t j) {
  return "pieces " + std::to_string(i) + " and " + std::to_string(j);
}

struct Asked_scene {
  const Scene scene;
  const Exact_traits traits;
  const Priority_relation<Exact_traits> relation;
  const std::vector<Flat_face> faces;

  explicit Asked_scene(const Posed_scene& posed)
      : scene(posed.soup), traits(scene), relation(traits), faces(flat_faces_of(scene)) {}
  std::uint32_t any_face(Random& random) const { return static_cast<std::uint32_t>(random.below(faces.size())); }
};

// ---- Regions

View_region any_region(const Posed_scene& posed, const std::vector<Flat_face>& faces, Random& random) {
  const auto point = [&] { return any_point(posed, faces, random); };
  const std::uint64_t kind = random.below(8);
  if (kind < 3) return View_region::eye(point());
  if (kind < 5) {
    Exact_point low = point(), high = point();
    if (!random.chance(1, 8))  // else empty, as likely as not
      for (std::size_t k = 0; k < 3; ++k)
        if (low[k] > high[k]) std::swap(low[k], high[k]);
    return View_region::box(low, high);
  }
  View_region region;
  for (std::uint64_t k = random.below(4) + 2; k > 0; --k) region.points.push_back(point());
  return region;
}

/// That a box has its corners, each once, and none where it is empty.
std::string flaw_of_box(const Exact_point& low, const Exact_point& high) {
  std::set<Exact_point> expected;
  for (const Rational& x : {low[0], high[0]})
    for (const Rational& y : {low[1], high[1]})
      for (const Rational& z : {low[2], high[2]}) expected.insert({x, y, z});
  for (std::size_t k = 0; k < 3; ++k)
    if (low[k] > high[k]) expected.clear();
  const std::vector<Exact_point> corners = View_region::box(low, high).points;
  return corners.size() == expected.size() && std::set<Exact_point>(corners.begin(), corners.end()) == expected
             ? ""
             : "a box of viewpoints has other corners";
}

Outcome check_region(const Posed_scene& posed, Random& random) {
  constexpr std::size_t pairs = 6, eyes = 3;
  const Asked_scene asked(posed);
  if (asked.faces.size() < 2) return Outcome::not_applicable();
  Exact_point low = any_point(posed, asked.faces, random), high = any_point(posed, asked.faces, random);
  for (std::size_t k = 0; k < 3; ++k)
    if (random.chance(1, 6)) high[k] = low[k];
    else if (low[k] > high[k] && !random.chance(1, 8)) std::swap(low[k], high[k]);
  if (const std::string flaw = flaw_of_box(low, high); !flaw.empty()) return Outcome::failed(flaw);
  const View_region region = any_region(posed, asked.faces, random);
  const Region_relation<Exact_traits> relation(asked.relation, region);
  for (std::uint32_t i = 0; i < asked.faces.size(); ++i) {
    const bool seen = std::any_of(region.points.begin(), region.points.end(),
                                  [&](const Exact_point& p) { return asked.faces[i].height(p) > 0; });
    if (seen != relation.on_view(i))
      return Outcome::failed("from the region piece " + std::to_string(i) + " is not " +
                             (seen ? "off-view" : "on-view"));
  }

  // Points of the region: corners, and between all of them.
  generate::Points inside;
  for (std::size_t k = 0; k < eyes && !region.points.empty(); ++k) {
    if (region.points.size() == 1 && k > 0) break;
    if (k == 0) {
      inside.push_back(region.points[random.below(region.points.size())]);
      continue;
    }
    Exact_point sum{0, 0, 0};
    std::int64_t all = 0;
    for (std::size_t p = 0; p < region.points.size(); ++p) {
      const std::int64_t weight = p + 1 == region.points.size() && all == 0 ? 1 : random.between(0, 3);
      sum = generate::along(sum, Rational(static_cast<long>(weight)), region.points[p]);
      all += weight;
    }
    for (Rational& x : sum) x /= Rational(static_cast<long>(all));
    inside.push_back(sum);
  }

  Relation_counters counters;
  for (std::size_t k = 0; k < pairs; ++k) {
    const std::uint32_t i = asked.any_face(random), j = asked.any_face(random);
    if (i == j) continue;
    const Flat_face &a = asked.faces[i], &b = asked.faces[j];
    const bool found = relation.may_obscure(i, j, counters);
    const Arcs arcs = relation.arcs(j, i, counters);
    if (arcs.back != found)
      return Outcome::failed("arcs between " + pieces_named(i, j) + " depend on who is named first");
    if (!found)
      for (const Exact_point& eye : inside)
        if (sees_over(eye, a, b))
          return Outcome::failed("no arc between " + pieces_named(i, j) +
                                 ", but an eye of the region sees the first over the second");
    const bool truly =
        region.points.size() == 1 ? sees_over(region.points[0], a, b) : some_eye_sees_over(region.points, a, b);
    if (found != truly)
      return Outcome::failed(std::string(found ? "an arc" : "no arc") + " between " + pieces_named(i, j) + ", but " +
                             (truly ? "some" : "no") + " eye of the region sees the first over the second");
  }
  return {};
}

// ---- Rays and codes

Outcome check_rays(const Posed_scene& posed, Random& random) {
  constexpr std::size_t rays = 3, pairs = 3;
  const Asked_scene asked(posed);
  if (asked.faces.empty()) return Outcome::not_applicable();
  Relation_counters counters;
  for (std::size_t k = 0; k < rays; ++k) {
    const Exact_point eye = random.chance(1, 3) ? posed.eye : any_point(posed, asked.faces, random),
                      direction = any_direction(posed, asked.faces, eye, random);
    const Ray_relation<Exact_traits> ray(asked.relation, eye, direction);
    std::vector<Depth_of_face> along_ray;
    for (std::uint32_t i = 0; i < asked.faces.size(); ++i) {
      const std::optional<Rational> t = pierced_at(asked.faces[i], eye, direction);
      if (t != ray.parameter(i)) return Outcome::failed("a ray pierces piece " + std::to_string(i) + " elsewhere");
      if (t) along_ray.emplace_back(*t, i);
    }
    std::sort(along_ray.begin(), along_ray.end());
    for (const auto& [s, i] : along_ray)
      for (const auto& [t, j] : along_ray) {
        if (i == j) continue;
        const Arcs arcs = ray.arcs(i, j, counters);
        if (arcs.forth != (s < t) || arcs.back != (t < s))
          return Outcome::failed("along a ray " + pieces_named(i, j) + " are not in their order");
        if (s == t) continue;
        const Pair_code code = pair_code(asked.relation, i, j, counters);
        if (code.precedence == Precedence::crossing) continue;  // asked below
        if (code.first_is_nearer(eye) != std::optional(s < t))
          return Outcome::failed("the code of " + pieces_named(i, j) + " is not the order along a ray");
      }
  }
  for (std::size_t k = 0; k < pairs; ++k) {
    const std::uint32_t i = asked.any_face(random), j = asked.any_face(random);
    if (i == j) continue;
    const bool crossing = pair_code(asked.relation, i, j, counters).precedence == Precedence::crossing;
    if (crossing != cross_each_other(asked.faces[i], asked.faces[j]))
      return Outcome::failed("by their code " + pieces_named(i, j) + (crossing ? " cross" : " do not cross"));
  }
  return {};
}

// ---- Pixels

std::optional<Pixel_view> any_view(const Posed_scene& posed, const std::vector<Flat_face>& faces, Random& random) {
  Pixel_view view;
  view.eye = random.chance(1, 2) ? posed.eye : any_point(posed, faces, random);
  view.width = static_cast<std::uint32_t>(random.between(1, 4));
  view.height = static_cast<std::uint32_t>(random.between(1, 3));
  for (std::array<double, 3>* const d : {&view.look, &view.right, &view.up}) {
    const Exact_point exactly = any_direction(posed, faces, view.eye, random);
    for (std::size_t k = 0; k < 3; ++k) (*d)[k] = nearest_double(exactly[k]);
  }
  if (random.chance(1, 2))  // narrow, so that most pixels are of what is looked at
    for (std::size_t k = 0; k < 3; ++k) {
      view.right[k] /= 8;
      view.up[k] /= 8;
    }
  if (random.chance(1, 4)) generate::flatten(view, random);
  if (random.chance(1, 4)) generate::stretch(view, random);
  for (const double x : {view.ray(0, 0)[0], view.ray(0, 0)[1], view.ray(0, 0)[2]})
    if (!std::isfinite(4 * x)) return std::nullopt;
  return view;
}

/// Whether a direction is another one but for a few roundings of doubles.
bool is_rounded(const Exact_point& direction, const Exact_point& exactly, const Pixel_view& view) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational size = abs(exact(view.look[k])) + abs(exact(view.right[k])) + abs(exact(view.up[k]));
    if (abs(direction[k] - exactly[k]) > size * generate::power_of_two(-48) + generate::power_of_two(-1060))
      return false;
  }
  return true;
}

Outcome check_pixels(const Posed_scene& posed, Random& random) {
  const Asked_scene asked(posed);
  if (asked.faces.empty()) return Outcome::not_applicable();
  const std::optional<Pixel_view> view = any_view(posed, asked.faces, random);
  if (!view) return Outcome::not_applicable();
  const Pixel_sets sets = pixel_sets(asked.relation, *view);
  const Priority_tree<Exact_traits> tree = build_priority_tree(asked.traits);
  const std::vector<std::uint32_t> number = priorities(asked.traits, tree, view->eye);
  const Pixel_statistics found = pixel_statistics(sets, number);
  Pixel_statistics truth;
  std::map<std::array<std::size_t, 2>, std::uint64_t> of_size;  // how many are pierced, and left
  for (std::uint32_t y = 0; y < view->height; ++y)
    for (std::uint32_t x = 0; x < view->width; ++x) {
      const std::size_t pixel = std::size_t{y} * view->width + x;
      const std::array<double, 3> d = view->ray(x, y);
      const Exact_point direction{exact(d[0]), exact(d[1]), exact(d[2])};
      if (!is_rounded(direction, view->centre(x, y), *view))
        return Outcome::failed("pixel " + std::to_string(x) + ", " + std::to_string(y) + " looks elsewhere");
      std::vector<Depth_of_face> pierced;
      for (std::uint32_t i = 0; i < asked.faces.size(); ++i)
        if (const auto t = pierced_at(asked.faces[i], view->eye, direction)) pierced.emplace_back(*t, i);
      std::vector<std::uint32_t> members;
      for (const auto& [t, i] : pierced) members.push_back(i);
      if (!std::equal(members.begin(), members.end(), sets[pixel].begin(), sets[pixel].end()))
        return Outcome::failed("pixel " + std::to_string(x) + ", " + std::to_string(y) + " pierces other pieces");
      std::sort(pierced.begin(), pierced.end());
      std::size_t left = 0;
      for (const auto& [s, i] : pierced) {
        left += std::none_of(members.begin(), members.end(),
                             [&, face = i](std::uint32_t j) { return number[j] < number[face]; });
        for (const auto& [t, j] : pierced)
          if (s < t && number[i] > number[j])
            return Outcome::failed("by a tree's numbers the farther of " + pieces_named(i, j) + " is nearer");
      }
      if (!members.empty()) ++of_size[{members.size(), left}];
      truth.covered += !members.empty();
      truth.several += members.size() >= 2;
      truth.single += left == 1;
      truth.faces += members.size();
      truth.left += left;
      truth.image.push_back(static_cast<std::uint32_t>(left));
    }
  if (truth.covered != found.covered || truth.several != found.several || truth.single != found.single ||
      truth.faces != found.faces || truth.left != found.left || truth.image != found.image)
    return Outcome::failed("what is counted at pixels is not what is there");
  std::map<std::array<std::size_t, 2>, std::uint64_t> counted;
  for (std::size_t all = 0; all < found.by_size.size(); ++all)
    for (std::size_t left = 0; left < found.by_size[all].size(); ++left)
      if (found.by_size[all][left] > 0) counted[{all, left}] = found.by_size[all][left];
  if (counted != of_size) return Outcome::failed("pixels by how much they pierce are not what is there");
  return {};
}

// ---- Trees that cut

Outcome check_splits(const Posed_scene& posed, Random& random) {
  constexpr std::size_t rays = 6;
  const Asked_scene asked(posed);
  if (asked.faces.empty()) return Outcome::not_applicable();
  const Priority_tree<Exact_traits> tree = build_priority_tree(asked.traits, {false, true, {}});
  const Exact_point eye = random.chance(1, 2) ? posed.eye : any_point(posed, asked.faces, random);
  std::vector<std::uint32_t> drawn;
  bool cyclic = false;
  Predicate_counts counts;
  walk_back_to_front(
      asked.traits, tree, eye, counts, [&](std::uint32_t i) { drawn.push_back(i); },
      [&](std::span<const Priority_tree<Exact_traits>::Slot>) { cyclic = true; });
  if (cyclic) return Outcome::failed("a tree that cuts has a cycle");
  std::vector<Flat_face> parts;
  std::vector<Exact_point> areas(asked.faces.size(), Exact_point{0, 0, 0});
  for (const std::uint32_t i : drawn) {
    parts.push_back(flat_face_of(asked.traits, tree.polygons[i]));
    Exact_point& area = areas[tree.polygons[i].piece];
    area = generate::along(area, 1, parts.back().normal);
  }
  for (std::size_t i = 0; i < areas.size(); ++i)
    if (areas[i] != asked.faces[i].normal)
      return Outcome::failed("the parts of piece " + std::to_string(i) + " have another area");
  for (std::size_t k = 0; k < rays; ++k) {
    const Exact_point direction = any_direction(posed, asked.faces, eye, random);
    std::optional<Depth_of_face> before;
    std::vector<char> seen(asked.faces.size());
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const auto t = pierced_at(parts[p], eye, direction);
      if (!t) continue;
      const std::uint32_t piece = tree.polygons[drawn[p]].piece;
      if (seen[piece]) return Outcome::failed("two parts of piece " + std::to_string(piece) + " overlap");
      seen[piece] = 1;
      if (before && before->first < *t)
        return Outcome::failed("of " + pieces_named(before->second, piece) + " the farther is drawn later");
      before.emplace(*t, piece);
    }
    for (std::uint32_t i = 0; i < asked.faces.size(); ++i) {
      const auto t = pierced_at(asked.faces[i], eye, direction);
      if (seen[i] && !t) return Outcome::failed("a part reaches out of piece " + std::to_string(i));
      if (!t || seen[i]) continue;
      const Exact_point at = generate::along(eye, *t, direction);  // then it is between parts
      bool held = false;
      for (std::size_t p = 0; p < parts.size(); ++p)
        held = held || (tree.polygons[drawn[p]].piece == i && parts[p].holds(at));
      if (!held) return Outcome::failed("a point of piece " + std::to_string(i) + " is in none of its parts");
    }
  }
  return {};
}

}  // namespace

Check region_check() {
  return check_of_a_share("region", "arcs from regions, against eyes that see one face over the other", 96,
                          check_region);
}
Check rays_check() {
  return check_of_a_share("rays", "arcs along rays and codes of pairs, against depths", 48, check_rays);
}
Check pixels_check() {
  return check_of_a_share("pixels", "what pixels pierce, and numbers of trees, against depths", 96, check_pixels);
}
Check splits_check() { return check_of_a_share("splits", "trees that cut, against depths", 96, check_splits); }

}  // namespace sightline::harness
