#include <sightline/harness/laws/apart_solids.h>

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/solids.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace {

using generate::Points;
using Whole_face = std::vector<Points>;  // its loops, each begun where it is least, holes in order

/// A star around a point, counterclockwise, without straight corners: its corners are in directions around the half
/// circle by the tangent of half an angle, less than a half turn apart.
Points any_star(Random& random, const Exact_point& centre) {
  static constexpr std::array<std::pair<long, long>, 12> directions{
      {{4, 0}, {4, 1}, {3, 3}, {1, 4}, {0, 4}, {-2, 4}, {-3, 2}, {-4, 0}, {-3, -3}, {-1, -4}, {1, -3}, {3, -2}}};
  Points star;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    if (k % 3 != 0 && random.chance(1, 2)) continue;  // one in each quarter stays
    const Rational far = generate::ratio(random.between(2, 9), 8);
    star.push_back({centre[0] + far * directions[k].first, centre[1] + far * directions[k].second, centre[2]});
  }
  const auto is_straight = [&](std::size_t k) {
    const Exact_point &a = star[(k + star.size() - 1) % star.size()], &b = star[k], &c = star[(k + 1) % star.size()];
    return is_zero(cross(minus(b, a), minus(c, b)));
  };
  for (std::size_t k = 0; k < star.size(); ++k) {
    if (!is_straight(k)) continue;
    star.erase(star.begin() + static_cast<std::ptrdiff_t>(k));
    k = ~std::size_t{0};  // from the first again
  }
  return star;
}

Polygon_soup prism_on(Points base, long height) {
  std::reverse(base.begin(), base.end());  // as seen from below
  Polygon_soup soup;
  generate::add_prism(soup, base, {0, 0, height});
  return soup;
}

/// The loop begun at its least corner; of one that comes back to that, so that it is the least list.
Points begun_at_its_least(const Points& loop) {
  Points least = loop, turned = loop;
  for (std::size_t k = 1; k < loop.size(); ++k) {
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    least = std::min(least, turned);
  }
  return least;
}

std::multiset<Whole_face> faces_in(const Polygon_soup& soup) {
  std::multiset<Whole_face> faces;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    Whole_face face;
    for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
      Points loop;
      for (const Point_id p : soup.loop(f, k)) loop.push_back(soup.point(p));
      face.push_back(begun_at_its_least(loop));
    }
    std::sort(face.begin() + 1, face.end());
    faces.insert(std::move(face));
  }
  return faces;
}

Set_result result_of(const std::vector<Polygon_soup>& solids, Set_operation operation) {
  Set_options options;
  options.operation = operation;
  return set_operation(Operands(solids), options);
}

/// Apart, and one in a hollow of the other's outline where that has one.
std::string flaw_apart(Random& random) {
  const Polygon_soup one = prism_on(any_star(random, {0, 0, 0}), 2);
  const Polygon_soup other = prism_on(any_star(random, {20, static_cast<long>(random.between(-9, 9)), 0}), 3);
  std::multiset<Whole_face> all = faces_in(one);
  all.merge(faces_in(other));
  const bool is_union = random.chance(1, 2);
  const Set_result result = result_of({one, other}, is_union ? Set_operation::unite : Set_operation::differ);
  return faces_in(result.soup) == all ? "" : "solids apart do not keep their faces";
}

std::string flaw_through(Random& random) {
  const Points star = any_star(random, {0, 0, 0});
  Points lower = star, square{{-6, -6, 0}, {6, -6, 0}, {6, 6, 0}, {-6, 6, 0}};
  for (Exact_point& p : lower) p[2] = -1;
  const Set_result result = result_of({prism_on(square, 1), prism_on(lower, 3)}, Set_operation::subtract);
  // 1. Faces: four sides, the walls of the hole, and two with a hole.
  const Polygon_soup& soup = result.soup;
  std::size_t with_hole = 0, walls = 0;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const bool has_hole = soup.loop_count(f) == 2 && soup.loop(f).size() == 4 && soup.loop(f, 1).size() == star.size();
    with_hole += has_hole;
    walls += soup.loop_count(f) == 1 && soup.loop(f).size() == 4;
  }
  if (with_hole != 2 || walls != 4 + star.size() || soup.face_count() != with_hole + walls)
    return "a block with a hole through it has other faces than walls and two with a hole";
  // 2. Cut, these are less than their triangles: of a face of k corners and a hole there are k.
  const std::size_t parts = without_holes(soup).soup.face_count() - walls;
  return parts < 2 * (4 + star.size()) ? "" : "faces with holes are cut into all their triangles";
}

/// A tetrahedron between points of a lattice, its faces outside.
Polygon_soup any_tetrahedron(Random& random) {
  for (;;) {
    Points p;
    for (int k = 0; k < 4; ++k) p.push_back(generate::lattice(random, 6));
    const Rational way = dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), minus(p[3], p[0]));
    if (way == 0) continue;
    if (way < 0) std::swap(p[1], p[2]);
    return generate::soup_of({{p[0], p[2], p[1]}, {p[0], p[1], p[3]}, {p[1], p[2], p[3]}, {p[2], p[0], p[3]}});
  }
}

/// Small solids, of which one has a part as far away as doubles hold whole numbers, or a little farther, and off the
/// others' grid by a fraction with a large prime. Moved to the middle of that grid, all coordinates are of 52 to 57
/// bits, those of the small solids whole numbers.
std::string flaw_far(Random& random) {
  std::vector<Polygon_soup> solids(2);
  for (Polygon_soup& solid : solids)
    for (std::uint64_t count = 1 + random.below(2); count > 0; --count)
      generate::append(solid, any_tetrahedron(random));
  const Set_operation operation = set_operations[random.below(4)];
  const Polygon_soup near = result_of(solids, operation).soup;
  static constexpr std::array<long, 4> primes{1048583, 2097143, 16777213, 1073741789};
  Exact_point away;
  for (Rational& x : away) x = generate::long_integer(random);
  away[random.below(3)] += generate::ratio(1, primes[random.below(primes.size())]);
  const Polygon_soup far = generate::translated(any_tetrahedron(random), away);
  generate::append(solids[0], far);
  const Set_result result = result_of(solids, operation);
  Rational expected = volume(near);
  std::multiset<Whole_face> all = faces_in(near);
  if (operation != Set_operation::intersect) {
    expected += volume(far);
    all.merge(faces_in(far));
  }
  if (volume(result.soup) != expected) return "a part far away changes the volume of what is left of the others";
  return faces_in(result.soup) == all ? "" : "a part far away changes faces of what is left of the others";
}

}  // namespace

Check apart_solids_check() {
  return {"apart",
          "stars apart keep their faces, and one through a block leaves walls and two faces with a hole; what is far "
          "away changes nothing",
          [](const Posed_scene&, const Answer&, Random& random) {
            static constexpr std::array<std::string (*)(Random&), 3> laws{flaw_apart, flaw_through, flaw_far};
            const std::string flaw = laws[random.below(laws.size())](random);
            return flaw.empty() ? Outcome{} : Outcome::failed(flaw);
          },
          4};
}

}  // namespace sightline::harness
