#include <sightline/harness/laws/solids.h>

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/harness/generate/tangles.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/apart_solids.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/judge_laws.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/harness/laws/manners.h>
#include <sightline/harness/laws/open_solids.h>
#include <sightline/harness/laws/questions.h>
#include <sightline/harness/laws/solid_oracle.h>
#include <sightline/harness/laws/solid_proof.h>
#include <sightline/harness/laws/solid_retold.h>
#include <sightline/harness/laws/solid_rounding.h>
#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace sightline::harness {

namespace solids_subject {

using generate::add_cone, generate::add_prism, generate::any_step, generate::base_of, generate::face_alone;

constexpr std::array<const char*, 4> operation_names{"union", "intersection", "difference", "symmetric difference"};

Set_result result_of(const std::vector<Polygon_soup>& solids, Set_operation operation,
                     Inside_rule rule = Inside_rule::positive, bool keep_fragments = false) {
  Set_options options;
  options.operation = operation;
  options.inside = rule;
  options.keep_fragments = keep_fragments;
  return set_operation(Operands(solids), options);
}

// ---- Cones from the eye, for labels

struct Eye_cones {
  std::array<Polygon_soup, 2> solids;
  std::array<std::vector<std::optional<Face_id>>, 2> base_of;  // the scene's face that a solid's face is
};

Eye_cones cones_from_eye(const Posed_scene& scene, Answer& answer) {
  Eye_cones cones;
  for (Face_id f = 0; f < scene.soup.face_count(); ++f) {
    generate::Points base = base_of(scene.soup, f, true);
    if (base.empty()) continue;
    const Flat_face flat = flat_faces_of(Scene(face_alone(scene.soup, f)))[0];
    const int side = sgn(flat.height(scene.eye));
    if (side == 0) continue;
    answer.labels[f] = 0;
    if (side > 0) std::reverse(base.begin(), base.end());
    const std::size_t which = side > 0;
    add_cone(cones.solids[which], base, scene.eye);
    cones.base_of[which].push_back(f);
    cones.base_of[which].resize(cones.solids[which].face_count());
  }
  return cones;
}

Answer labels_of(const Posed_scene& scene) {
  Answer answer;
  answer.labels.assign(scene.soup.face_count(), Answer::none);
  const Scene prepared(scene.soup);
  answer.planar = prepared.non_planar().empty();
  const Eye_cones cones = cones_from_eye(scene, answer);
  const auto add = [&](std::size_t first, Set_operation operation, std::uint32_t bit) {
    const std::size_t faces = cones.solids[first].face_count();
    for (const Result_fragment& fragment :
         result_of({cones.solids[first], cones.solids[1 - first]}, operation, Inside_rule::positive, true).fragments) {
      if (fragment.fate == Result_fragment::Fate::dropped) continue;
      for (const Result_fragment::Part& part : fragment.parts) {
        const bool of_first = part.face < faces;
        const auto face = of_first ? cones.base_of[first][part.face] : cones.base_of[1 - first][part.face - faces];
        if (face) answer.labels[*face] |= bit;
      }
    }
  };
  add(0, Set_operation::subtract, 1);
  add(1, Set_operation::subtract, 2);
  add(0, Set_operation::unite, 4);
  add(0, Set_operation::intersect, 8);
  return answer;
}

// ---- Points

bool is_inside_by(Inside_rule rule, int winding) {
  if (rule == Inside_rule::positive) return winding > 0;
  if (rule == Inside_rule::nonzero) return winding != 0;
  return winding % 2 != 0;
}

bool is_in(Set_operation operation, const std::vector<bool>& inside) {
  const auto count = std::count(inside.begin(), inside.end(), true);
  switch (operation) {
    case Set_operation::unite: return count > 0;
    case Set_operation::intersect: return count == static_cast<std::ptrdiff_t>(inside.size());
    case Set_operation::subtract: return inside[0] && count == 1;
    case Set_operation::differ: break;
  }
  return count % 2 == 1;
}

// ---- Surfaces

/// Brute force: all vertices against all edges.
std::string flaw_of_surface(const Set_result& result) {
  const Polygon_soup& soup = result.soup;
  // 1. Edges, and how many faces they have.
  std::map<std::pair<Point_id, Point_id>, std::uint32_t> uses;
  std::set<Point_id> used;
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
      const auto loop = soup.loop(f, k);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        ++uses[std::minmax(loop[i], loop[(i + 1) % loop.size()])];
        used.insert(loop[i]);
      }
    }
  std::map<std::pair<Point_id, Point_id>, std::uint32_t> listed;
  for (const Crowded_edge& edge : result.crowded) listed[{edge.from, edge.to}] = edge.faces;
  std::set<Exact_point> places;
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    if (!used.count(p)) return "point " + std::to_string(p) + " is in no face";
    if (!places.insert(soup.point(p)).second) return "point " + std::to_string(p) + " is there twice";
  }
  for (const auto& [edge, count] : uses) {
    const auto at = listed.find(edge);
    if ((count == 2) != (at == listed.end()) || (count != 2 && at->second != count))
      return "an edge of " + std::to_string(count) + " faces is listed wrongly";
    const Exact_point p = soup.point(edge.first), q = soup.point(edge.second), along = minus(q, p);
    for (const Exact_point& v : places) {
      if (v == p || v == q || !is_zero(cross(along, minus(v, p)))) continue;
      const Rational t = dot(along, minus(v, p));
      if (t > 0 && t < dot(along, along)) return "vertex " + text_of(v) + " is inside an edge";
    }
  }
  // 2. Closed, planar, nothing set aside but duplicates; without holes, too.
  const Hole_free flat = without_holes(soup);
  for (const Polygon_soup* one : {&soup, &flat.soup}) {
    const Scene scene(*one);
    if (!closure(scene).closed) return "it is not closed";
    if (!scene.non_planar().empty()) return "face " + std::to_string(scene.non_planar()[0]) + " is not planar";
    for (const Set_aside& aside : scene.set_aside())
      return "face " + std::to_string(aside.face) + " is set aside: " + aside.why;
  }
  return {};
}

Check check_of_solids(const char* name, const char* what,
                      std::string (*flaw)(const std::vector<Polygon_soup>&, Random&)) {
  return {name, what, [flaw](const Posed_scene& scene, const Answer&, Random& random) {
            const std::vector<Polygon_soup> solids = solids_of(scene, random);
            if (solids.empty()) return Outcome::not_applicable();
            std::string found = flaw(solids, random);
            return found.empty() ? Outcome{} : Outcome::failed(std::move(found));
          }};
}

}  // namespace solids_subject

using namespace solids_subject;

/// A block, and two prisms through it that leave an island between them in a hole, which touches the hole in a corner.
std::vector<Polygon_soup> block_with_island(Random& random) {
  const Exact_point by = generate::lattice(random, 5);
  const Rational half(3, 2);
  const auto prism = [&](const std::vector<std::array<Rational, 2>>& outline, long low, long high) {
    generate::Points base;
    for (const auto& p : outline) base.push_back({p[0] + by[0], p[1] + by[1], low + by[2]});
    std::reverse(base.begin(), base.end());  // as seen from below
    Polygon_soup soup;
    add_prism(soup, base, {0, 0, high - low});
    return soup;
  };
  const long side = random.between(5, 7);
  std::vector<Polygon_soup> solids{prism({{-1, -1}, {side, -1}, {side, side}, {-1, side}}, 0, 1),
                                   prism({{0, 0}, {4, 0}, {4, 4}, {half, half}, {2, 1}}, -1, 2),
                                   prism({{0, 0}, {1, 2}, {half, half}, {4, 4}, {0, 4}}, -1, 2)};
  const Exact_point turn = generate::lattice(random, 3);
  for (Polygon_soup& solid : solids)
    solid = generate::rotated(solid, generate::rotation(4, turn[0].get_num().get_si(), turn[1].get_num().get_si(),
                                                        turn[2].get_num().get_si()));
  return solids;
}

/// Four prisms with a face through one point: in each of these faces three others cross.
std::vector<Polygon_soup> prisms_through_a_point(Random& random) {
  const Exact_point at = generate::lattice(random, 5);
  std::vector<Polygon_soup> solids(4);
  for (Polygon_soup& solid : solids) {
    Exact_point front, u;
    do {
      front = generate::lattice(random, 2);
      u = cross(front, generate::lattice(random, 2));
    } while (is_zero(u));
    const Exact_point v = cross(front, u);
    generate::Points base(3);  // counterclockwise, the point inside
    Exact_point along;
    for (std::size_t k = 0; k < 3; ++k) {
      base[0][k] = at[k] + 8 * u[k];
      base[1][k] = at[k] + 4 * (v[k] - u[k]);
      base[2][k] = at[k] - 4 * (v[k] + u[k]);
      along[k] = -3 * front[k];
    }
    add_prism(solid, base, along);
  }
  return solids;
}

std::vector<Polygon_soup> solids_of(const Posed_scene& scene, Random& random) {
  if (scene.first > 0) {
    const generate::Solid_pair pair = generate::solids_of(scene.soup, scene.first);
    return {pair.begin(), pair.end()};
  }
  if (random.chance(1, 24)) return block_with_island(random);
  if (random.chance(1, 48)) return prisms_through_a_point(random);
  Polygon_soup folded;  // now and then, bases that are folded flat
  if (random.chance(1, 16)) folded = generate::soup_of({generate::folded_loop(random), generate::folded_loop(random)});
  const Polygon_soup& faces = folded.face_count() > 0 ? folded : scene.soup;
  std::vector<generate::Points> bases;
  for (Face_id f = 0; f < faces.face_count(); ++f)
    if (generate::Points base = base_of(faces, f, false); !base.empty()) bases.push_back(std::move(base));
  if (bases.empty()) return {};
  std::vector<Polygon_soup> solids(static_cast<std::size_t>(random.between(2, 3)));
  const Exact_point along = generate::lattice(random, 2);
  Exact_point apex = random.chance(1, 2) ? scene.eye : bases[0][0];
  if (random.chance(1, 3)) {  // on an edge
    const generate::Points& base = bases[random.below(bases.size())];
    for (std::size_t k = 0; k < 3; ++k) apex[k] = (base[0][k] + base[1][k]) / 2;
  }
  for (Polygon_soup& solid : solids) {
    const std::size_t place = static_cast<std::size_t>(&solid - solids.data());
    if (place > 0 && random.chance(1, 4)) {  // a copy, beside the first or where it is, its faces in another order
      solid = generate::translated(solids[0], any_step(scene, random));
      if (random.chance(1, 2) && solid.face_count() > 0) solid = generate::faces_permuted(solid, random.below(1000));
      continue;
    }
    for (auto count = random.between(place == 0 ? 1 : 0, 3); count > 0; --count) {
      generate::Points base = bases[random.below(bases.size())];
      if (random.chance(1, 3)) std::reverse(base.begin(), base.end());
      if (random.chance(1, 2)) add_cone(solid, base, random.chance(2, 3) ? apex : generate::lattice(random, 8));
      else add_prism(solid, base, random.chance(2, 3) ? along : generate::lattice(random, 3));
    }
  }
  return solids;
}

std::string flaw_by_points(const std::vector<Polygon_soup>& solids, std::size_t points, Random& random) {
  const Inside_rule rule = inside_rules[random.below(3)];
  std::vector<Solid_oracle> operands;
  std::vector<Exact_point> corners;
  for (const Polygon_soup& solid : solids) {
    operands.emplace_back(solid);
    for (const Exact_point& p : corners_of(solid)) corners.push_back(p);
  }
  if (corners.empty()) return {};
  for (std::size_t k = 0; k < 4; ++k) {
    const Set_result result = result_of(solids, set_operations[k], rule);
    const Solid_oracle oracle(result.soup);
    std::vector<Exact_point> places = corners;
    for (const Exact_point& p : corners_of(result.soup)) places.push_back(p);
    for (std::size_t i = 0; i < points; ++i) {
      const Exact_point p = any_point_of(places, random);
      if (oracle.is_on_a_face(p)) continue;
      if (std::any_of(operands.begin(), operands.end(), [&](const auto& one) { return one.is_on_a_face(p); })) continue;
      std::vector<bool> inside;
      for (const Solid_oracle& one : operands) inside.push_back(is_inside_by(rule, one.winding(p, random)));
      const int expected = is_in(set_operations[k], inside) ? 1 : 0, found = oracle.winding(p, random);
      if (found != expected)
        return std::string(operation_names[k]) + ": " + text_of(p) + " is wound round " + std::to_string(found) +
               " times, not " + std::to_string(expected);
    }
  }
  return {};
}

std::string flaw_by_volumes(const std::vector<Polygon_soup>& given) {
  const std::vector<Polygon_soup> solids(given.begin(), given.begin() + std::min<std::ptrdiff_t>(std::ssize(given), 3));
  const Polygon_soup &a = solids[0], &b = solids[1];
  const auto of = [](const std::vector<Polygon_soup>& some, Set_operation operation) {
    return volume(result_of(some, operation).soup);
  };
  const Rational only_a = of({a}, Set_operation::unite), only_b = of({b}, Set_operation::unite);
  const Rational both = of({a, b}, Set_operation::intersect), any = of({a, b}, Set_operation::unite);
  if (any + both != only_a + only_b) return "union and intersection do not add up to the two";
  if (of({a, b}, Set_operation::subtract) + both != only_a) return "difference and intersection are not the first";
  if (of({a, b}, Set_operation::differ) + both != any) return "symmetric difference and intersection are not the union";
  if (of({a, a}, Set_operation::unite) != only_a || of({a, a}, Set_operation::subtract) != 0)
    return "a solid and itself are not itself";
  // The surfaces of all in one operand, as a level's brushes are: what is in any of them.
  Polygon_soup surfaces;
  for (const Polygon_soup& solid : solids) generate::append(surfaces, result_of({solid}, Set_operation::unite).soup);
  if (of({surfaces}, Set_operation::unite) != of(solids, Set_operation::unite))
    return "the union of one operand that has the surfaces of all is not theirs";
  if (solids.size() < 3) return {};
  const Polygon_soup& c = solids[2];
  const Rational all = of(solids, Set_operation::intersect);
  if (of(solids, Set_operation::unite) != any + of({c}, Set_operation::unite) - of({a, c}, Set_operation::intersect) -
                                              of({b, c}, Set_operation::intersect) + all)
    return "the union of three is not what theirs in pairs say";
  // One after the other is all at once, and the result's own surface is one to go on with.
  const Polygon_soup first = result_of({a, b}, Set_operation::unite).soup;
  if (of({first, c}, Set_operation::subtract) != of(solids, Set_operation::unite) - of({c}, Set_operation::unite))
    return "the union of two, less the third, is not that of three less it";
  return {};
}

std::string flaw_of_surfaces(const std::vector<Polygon_soup>& solids) {
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string flaw = flaw_of_surface(result_of(solids, set_operations[k]));
    if (!flaw.empty()) return std::string(operation_names[k]) + ": " + flaw;
  }
  return {};
}

Subject boolean() {
  Subject subject;
  subject.name = "boolean";
  subject.what = "set operations on cones, prisms and copies, by winding numbers of points, volumes and surfaces";
  subject.answer = [](const Posed_scene& scene) { return labels_of(scene); };
  subject.checks = {
      check_of_solids(
          "points", "points are in the result iff the solids' winding numbers say so",
          [](const std::vector<Polygon_soup>& solids, Random& random) { return flaw_by_points(solids, 8, random); }),
      check_of_solids("volumes", "volumes of results add up, as rationals",
                      [](const std::vector<Polygon_soup>& solids, Random&) { return flaw_by_volumes(solids); }),
      check_of_solids("surface", "results are closed, planar, without vertices inside edges",
                      [](const std::vector<Polygon_soup>& solids, Random&) { return flaw_of_surfaces(solids); }),
      check_of_solids(
          "proof", "the certificate is accepted, and rejected when it is forged",
          [](const std::vector<Polygon_soup>& solids, Random& random) { return flaw_of_certificate(solids, random); }),
      check_of_solids(
          "rounding", "rounded results are closed, and where they are said to be sound, solids with the same inside",
          [](const std::vector<Polygon_soup>& solids, Random& random) { return flaw_of_rounding(solids, random); })};
  add_laws(subject,
           {"begin", "permute", "translate", "scale", "rotate", "stretch", "project", "mirror", "turn", "cut"});
  subject.checks.push_back(judged_solids_check());
  subject.checks.push_back(check_of_solids(
      "results", "the result is accepted however its faces are told, and no other one is",
      [](const std::vector<Polygon_soup>& solids, Random& random) { return flaw_of_told_result(solids, random); }));
  subject.checks.push_back(manners_check(questions_of_boolean()));
  subject.checks.push_back(open_solids_check());
  subject.checks.push_back(apart_solids_check());
  return subject;
}

}  // namespace sightline::harness
