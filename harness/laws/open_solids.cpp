#include <sightline/harness/laws/open_solids.h>

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace open_solids {

using generate::Points;
using Open_edge = std::tuple<std::uint32_t, Face_id, Exact_point, Exact_point>;

struct Made {
  std::vector<Polygon_soup> solids;
  std::vector<Open_edge> open;
  std::vector<std::pair<std::uint32_t, Face_id>> crossed;
};

/// Boxes that may have corners, edges and faces in common, each an operand, some of their faces left out.
Made any_boxes(Random& random) {
  Made made;
  const std::uint32_t count = static_cast<std::uint32_t>(1 + random.below(3));
  for (std::uint32_t operand = 0; operand < count; ++operand) {
    const Exact_point low = generate::lattice(random, 1);
    Exact_point high;
    for (std::size_t k = 0; k < 3; ++k) high[k] = low[k] + generate::integer(random, 1, 2);
    const std::uint64_t left_out = random.chance(1, 4) ? 0 : random.below(3);
    generate::Faces faces;
    for (Points& face : generate::box(low, high))
      if (!random.chance(left_out, 6)) faces.push_back(std::move(face));
    // 1. Edges that go one way only.
    std::vector<std::pair<Exact_point, Exact_point>> edges;
    for (const Points& face : faces)
      for (std::size_t k = 0; k < face.size(); ++k) edges.emplace_back(face[k], face[(k + 1) % face.size()]);
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (std::find(edges.begin(), edges.end(), std::pair(edges[k].second, edges[k].first)) == edges.end())
        made.open.emplace_back(operand, static_cast<Face_id>(k / 4), edges[k].first, edges[k].second);
    // 2. A face that is none.
    if (random.chance(1, 4)) {
      made.crossed.emplace_back(operand, static_cast<Face_id>(faces.size()));
      faces.push_back({{0, 0, 9}, {1, 1, 9}, {1, 0, 9}, {0, 1, 9}});
    }
    made.solids.push_back(generate::soup_of(faces));
  }
  return made;
}

std::string flaw_of_flaws(const Made& made) {
  std::vector<Open_edge> open;
  std::vector<std::pair<std::uint32_t, Face_id>> crossed;
  std::uint32_t last = 0;
  for (const Operand_flaw& flaw : flaws(Operands(made.solids))) {
    if (flaw.operand < last) return "what is wrong with operands is not told in their order";
    last = flaw.operand;
    if (flaw.why.empty()) open.emplace_back(flaw.operand, flaw.face, flaw.from, flaw.to);
    else crossed.emplace_back(flaw.operand, flaw.face);
  }
  std::vector<Open_edge> expected = made.open;
  std::sort(expected.begin(), expected.end());
  std::sort(open.begin(), open.end());
  if (open != expected)
    return std::to_string(open.size()) + " edges are told to be open, and " + std::to_string(expected.size()) + " are";
  return crossed == made.crossed ? std::string() : "other faces are told to cross themselves than do";
}

/// Each side of a box is along two axes: the sum is rational. A hole of two points takes nothing off.
std::string flaw_of_area(const Polygon_soup& solid, Random& random) {
  static constexpr std::array<int, 6> powers{0, 0, -530, -600, 505, 600};
  const int power = powers[random.below(powers.size())];
  const Rational factor = generate::power_of_two(power);
  Polygon_soup soup = generate::scaled(solid, factor);
  Rational sum = 0;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const auto loop = soup.loop(f);
    const Exact_point normal =
        cross(minus(soup.point(loop[1]), soup.point(loop[0])), minus(soup.point(loop[2]), soup.point(loop[0])));
    if (soup.point(loop[0])[2] != 9 * factor) sum += abs(normal[0]) + abs(normal[1]) + abs(normal[2]);
  }
  if (soup.face_count() > 0) {
    const auto loop = soup.loop(static_cast<Face_id>(soup.face_count() - 1));
    soup.add_hole({loop[0], loop[1]});
  }
  const auto [low, high] = area(soup);
  if (!(low >= 0 && low <= high)) return "bounds of an area are none";
  if (exact(low) > sum || (std::isfinite(high) && exact(high) < sum))
    return "an area is not within its bounds, scaled by 2^" + std::to_string(power);
  if (power == 0 && exact(high) - exact(low) > sum * Rational(1, 1000000) + Rational(1, 1000000))
    return "bounds of an area are far apart";
  return {};
}

Outcome run(const Posed_scene&, const Answer&, Random& random) {
  const Made made = any_boxes(random);
  std::string flaw = flaw_of_flaws(made);
  if (flaw.empty()) flaw = flaw_of_area(made.solids[0], random);
  return flaw.empty() ? Outcome{} : Outcome::failed(std::move(flaw));
}

}  // namespace open_solids

Check open_solids_check() {
  return {"open", "open edges and crossed faces of boxes are told, and areas are within their bounds",
          open_solids::run};
}

}  // namespace sightline::harness
