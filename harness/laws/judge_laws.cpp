#include <sightline/harness/laws/judge_laws.h>

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/harness/judge/rays.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/trace.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace sightline::harness {

namespace judge_laws {

Polygon_soup surface_of(std::span<const Polygon_soup> solids, Set_operation operation) {
  Set_options options;
  options.operation = operation;
  return without_holes(set_operation(Operands(solids), options).soup).soup;
}

/// Where no point is judged, so that volume and area alone can tell what is there.
Exact_point beyond(const Polygon_soup& soup) {
  Rational most = 0;
  for (Point_id p = 0; p < soup.point_count(); ++p)
    for (const Rational& x : soup.point(p)) most = std::max(most, Rational(abs(x)));
  return {8 * most, 8 * most, 8 * most};
}

Polygon_soup with_faces(Polygon_soup soup, const generate::Faces& faces) {
  for (const generate::Points& face : faces) soup.add_face(generate::added(soup, face));
  return soup;
}

/// What the judge says of a result with an island, one turned inside out, and a wall of no thickness beyond it: too
/// much, too little, or too large a surface; and of an island so small that it passes for a rounding error.
template <class Graded>
std::string flaw_of_limits(const Polygon_soup& result, const Polygon_soup& solids, const judge::Solid_truth& truth,
                           Graded graded) {
  const Exact_point low = beyond(solids);
  const auto island = [&](const Rational& side) { return generate::box(low, generate::along(low, side, {1, 1, 1})); };
  // 1. As much again.
  Rational side = low[0];
  generate::Faces faces = island(side);
  if (!graded(with_faces(result, faces)).too_large()) return "an island is not too much for the judge";
  for (generate::Points& face : faces) std::reverse(face.begin(), face.end());
  if (!graded(with_faces(result, faces)).too_small()) return "an island turned inside out is not too little";
  // 2. A wall.
  const generate::Points& face = faces[0];
  const judge::Grade wall = graded(with_faces(result, {face, generate::reversed(face)}));
  if (wall.volume_error != 0 || !wall.wrong()) return "a wall of no thickness is no surface too much";
  // 3. A quarter of what is allowed.
  const Rational allowed = exact(judge::Grade::largest_error / 4);
  const auto is_allowed = [&](const Rational& length) {
    const Rational square = length * length;
    return square * length <= allowed * truth.volume_scale &&
           6 * square <= allowed * exact(truth.area_scale) * truth.unit * truth.unit;
  };
  while (!is_allowed(side)) side /= 2;
  if (graded(with_faces(result, island(side))).wrong()) return "an island as small as a rounding error is one too much";
  return {};
}

Outcome judge_solids(const Posed_scene& posed, Random& random) {
  const generate::Solid_pair solids = generate::pair_of_solids(posed, random);
  const Polygon_soup both = judge::joined(solids);
  judge::Query query;
  query.question = judge::Question::boolean;
  query.first = solids[0].face_count();
  query.operation = set_operations[random.below(4)];
  if (!judge::flaw_of_solids(both, query.first).empty()) return Outcome::not_applicable();
  const judge::Solid_truth truth = judge::solid_truth(both, query);
  const auto graded = [&](const Polygon_soup& surface) {
    judge::Answer answer;
    answer.surface = surface;
    return judge::grade_solid(truth, answer);
  };
  // 1. Results of any operation.
  const Polygon_soup exact = surface_of(solids, query.operation);
  for (const Set_operation said : set_operations) {
    const Polygon_soup surface = surface_of(solids, said);
    const bool differs = volume(surface_of(std::array{exact, surface}, Set_operation::differ)) != 0;
    if (graded(surface).wrong() != differs)
      return Outcome::failed(std::string("the judge ") + (differs ? "accepts" : "rejects") + " the " + name(said) +
                             " for the " + name(query.operation));
  }
  // 2. Both as they are, which wind twice round what they share.
  if (volume(surface_of(solids, Set_operation::intersect)) != 0 && graded(both).wrong_points.empty())
    return Outcome::failed("the judge finds no point that both solids wind round twice, though they overlap");
  // 3. Volume and area by themselves.
  if (const std::string flaw = flaw_of_limits(exact, both, truth, graded); !flaw.empty()) return Outcome::failed(flaw);
  // 4. An open surface.
  if (exact.face_count() == 0) return {};
  Polygon_soup open;
  open.coordinates = exact.coordinates;
  const std::size_t left_out = random.below(exact.face_count());
  for (Face_id f = 0; f < exact.face_count(); ++f)
    if (f != left_out) open.add_face(exact.loop(f));
  try {
    graded(open);
  } catch (const std::invalid_argument&) {
    return {};
  }
  return Outcome::failed("the judge takes a surface less a face for a closed one");
}

Outcome judge_rays(const Posed_scene& posed, Random& random) {
  const Scene scene(posed.soup);
  if (scene.pieces().empty()) return Outcome::not_applicable();
  std::vector<Exact_ray> rays = judge::rays_about(posed.soup, posed.eye, random.below(1000000));
  std::erase_if(rays, [](const Exact_ray& ray) { return ray.direction == Exact_point{0, 0, 0}; });
  const std::vector<judge::Ray_truth> truths = judge::ray_truths(posed.soup, scene, rays);
  judge::Answer answer;
  std::set<std::size_t> wrong;
  for (std::size_t ray = 0; ray < rays.size(); ++ray) {
    const std::vector<Face_hit> first = first_by_definition(posed.soup, scene, rays[ray], Ray_start::open);
    std::optional<Face_id> said;
    if (!first.empty() && random.chance(1, 2)) said = first[random.below(first.size())].face;
    else if (random.chance(1, 2)) said = scene.pieces()[random.below(scene.pieces().size())].face;
    const bool is_right =
        said ? std::any_of(first.begin(), first.end(), [&](const Face_hit& hit) { return hit.face == *said; })
             : first.empty();
    if (!is_right) wrong.insert(ray);
    answer.first.push_back(said);
  }
  std::set<std::size_t> found;
  for (const judge::Wrong_ray& ray : judge::grade_rays(truths, answer).wrong_rays) found.insert(ray.ray);
  if (found == wrong) return {};
  std::vector<std::size_t> other;
  std::set_symmetric_difference(found.begin(), found.end(), wrong.begin(), wrong.end(), std::back_inserter(other));
  const auto& said = answer.first[other[0]];
  return Outcome::failed(std::string("the judge ") + (found.count(other[0]) > 0 ? "rejects " : "accepts ") +
                         (said ? face_name(*said) : std::string("nothing")) + " as what a ray meets first");
}

}  // namespace judge_laws

Check judged_solids_check() {
  return check_of_a_share("judge", "the judge finds results of set operations wrong iff they differ", 8,
                          judge_laws::judge_solids);
}
Check judged_rays_check() {
  return check_of_a_share("judge", "the judge finds answers about rays wrong iff they are", 8, judge_laws::judge_rays);
}

}  // namespace sightline::harness
