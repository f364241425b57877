#pragma once
// What checkers say of small certificates in cases that scenes of families hardly ever bring about: orders that are cut
// in two more often than a word has bits, rays of parts through borders, fates, outlines that run the other way, and
// points on edges of a surface.

#include "faces.h"
#include "support.h"

#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/verify/faces.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/solids.h>
#include <sightline/algorithms/verify/surface.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/solids.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fuzz {

// ---- Orders

/// Cuts a sequence in two again and again, mostly one fragment at its end at a time: deeper than 64 parts.
inline void cut_deeply(std::vector<std::uint32_t>& depths, generate::Random& random) {
  std::size_t begin = 0, end = depths.size();
  for (std::uint32_t depth = 0; end - begin > 1; ++depth) {
    const bool at_end = random.chance(15, 16);
    depths[at_end ? end - 1 : begin + 1] = depth;
    if (at_end) --end;
    else ++begin;
  }
}

/// Squares above each other, as an eye above all sees them, in an order that is right or has two of them exchanged: it
/// is accepted iff no higher one is drawn before a lower one, and the first such pair is named, however it is cut.
inline void try_deep_cuts(generate::Random& random) {
  const std::size_t count = 66 + random.below(40);
  std::vector<long> heights(count);
  for (std::size_t k = 0; k < count; ++k) heights[k] = static_cast<long>(k);
  if (random.chance(3, 4)) {
    const std::size_t k = random.chance(1, 2) ? random.below(8) : random.below(count - 1);
    std::swap(heights[k], heights[k + 1]);
  }
  generate::Faces faces;
  Order_certificate claim;
  claim.eye = {0, 0, 1000};
  for (std::size_t k = 0; k < count; ++k) {
    const Rational reach = generate::integer(random, 1, 4);
    faces.push_back(generate::either_way(generate::rectangle(-reach, reach, -reach, reach, heights[k]), random));
    claim.fragments.push_back({static_cast<Face_id>(k), 0, faces.back()});
  }
  claim.cuts.depths.assign(count, static_cast<std::uint32_t>(count));
  cut_deeply(claim.cuts.depths, random);
  std::vector<std::size_t> first;  // the pair that is drawn in the wrong order
  for (std::size_t later = 0; later < count && first.empty(); ++later)
    for (std::size_t earlier = 0; earlier < later && first.empty(); ++earlier)
      if (heights[earlier] > heights[later]) first = {earlier, later};
  const Verdict verdict = verify_order(generate::soup_of(faces), claim, {1, {}});
  require(verdict.accepted == first.empty(), "an order is accepted iff it is one, however deep it is cut");
  require(verdict.fragments == first, "the first two that are in the wrong order are named");
}

// ---- Parts

/// All of a large square is called visible, through a triangle that is in front of it. The part's ray says so first
/// where it meets the triangle, be it at its border only.
inline void try_rays_through_borders(generate::Random& random) {
  generate::Points triangle;
  for (int k = 0; k < 3; ++k) {
    triangle.push_back(generate::lattice(random, 4));
    triangle.back()[2] = generate::integer(random, 1, 3);
  }
  const Exact_point eye{0, 0, 4};
  if (dot(cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0])), minus(eye, triangle[0])) == 0)
    return;
  const generate::Points square = generate::either_way(generate::rectangle(-900, 900, -900, 900, 0), random);
  // A point of the triangle's plane, by weights of its corners.
  std::array<Rational, 3> weights;
  Rational sum = 0;
  for (Rational& w : weights) sum += w = generate::integer(random, -1, 3);
  if (sum <= 0) return;
  Exact_point ray{-eye[0], -eye[1], -eye[2]};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) ray[k] += weights[i] / sum * triangle[i][k];
  if (ray[2] >= 0) return;
  Visible_certificate claim;
  claim.eye = eye;
  const bool square_first = random.chance(1, 2);
  const std::vector<generate::Points> faces =
      square_first ? std::vector{square, triangle} : std::vector{triangle, square};
  for (std::size_t f = 0; f < 2; ++f) claim.fragments.push_back({static_cast<Face_id>(f), 0, faces[f]});
  const std::size_t of_square = square_first ? 0 : 1, of_triangle = 1 - of_square;
  claim.parts.push_back({of_square, square, ray});
  const bool meets = std::all_of(weights.begin(), weights.end(), [](const Rational& w) { return w >= 0; });
  const std::string near = "face " + std::to_string(of_triangle);
  const Verdict verdict = verify_visible(generate::soup_of(faces), claim, {1, {}});
  require(verdict.why == "part 0 (face " + std::to_string(of_square) + ')' +
                             (meets ? " is not what its ray meets first: " + near + " is nearer"
                                    : " is behind " + near + " somewhere"),
          "a part whose ray meets something before it is not what that meets first");
  require(verdict.fragments == std::vector{of_square, of_triangle}, "both are named");
}

// ---- Solids

struct Solids_claim {
  std::vector<Polygon_soup> solids;
  Solid_certificate claim;
};
/// Two boxes on a lattice, and what some operation makes of them.
inline Solids_claim claim_of_boxes(generate::Random& random) {
  std::vector<Polygon_soup> solids;
  for (int k = 0; k < 2; ++k) {
    const Exact_point low = generate::lattice(random, 2);
    Exact_point high = low;
    for (Rational& x : high) x += generate::integer(random, 1, 3);
    solids.push_back(generate::soup_of(generate::box(low, high)));
  }
  const Set_options options = harness::drawn_operation(random);
  const Operands operands(solids);
  return {solids, solid_certificate(operands, options, set_operation(operands, options))};
}

/// Two boxes, and a fragment of theirs with another fate: it is told what it is called, and what it should be.
inline void try_other_fates(generate::Random& random) {
  using Fate = Solid_certificate::Fate;
  auto [solids, claim] = claim_of_boxes(random);
  const std::size_t i = random.below(claim.fragments.size());
  const Fate right = claim.fragments[i].fate, wrong = static_cast<Fate>(random.below(3));
  claim.fragments[i].fate = wrong;
  const auto text_of = [](Fate fate) {
    return std::string(fate == Fate::dropped ? "dropped" : fate == Fate::kept ? "kept" : "turned");
  };
  const Verdict verdict = verify_solids(solids, claim, nullptr, {1, {}});
  require(verdict.accepted == (right == wrong), "a fragment has one fate");
  require(right == wrong || verdict.why == "fragment " + std::to_string(i) + " is " + text_of(wrong) +
                                               ", and should be " + text_of(right),
          "it is told what a fragment is called, and what it should be");
}

// ---- Outlines

/// What is wrong with a loop that is not convex: by its area, whichever way it goes.
inline void try_outlines(generate::Random& random) {
  const auto [u, v] = generate::directions(random, 3);
  const Exact_point origin = generate::lattice(random, 3);
  generate::Points loop;
  for (std::size_t k = 3 + random.below(4); k > 0; --k)
    loop.push_back(generate::lattice_in_plane(random, origin, u, v, -2, 2));
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (loop[k] == loop[(k + 1) % loop.size()]) return;
  const Exact_point normal = cross(u, v);
  Rational area = 0;
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    area += dot(normal, cross(minus(loop[k], loop[0]), minus(loop[k + 1], loop[0])));
  const std::string why =
      certificate_check::not_convex(loop, certificate_check::Plane{certificate_check::primitive(normal), origin});
  const std::string_view begin = area < 0    ? "is clockwise as seen from the front of its face"
                                 : area == 0 ? "has zero area"
                                             : "is not convex";
  require((area > 0 && why.empty()) || why.starts_with(begin), "what is wrong with an outline is told by its area");
}

// ---- Surfaces

/// A square with a hole and a way to that, there and back, over a point above the middle of it: the parts of the same
/// without the point are another surface, though boundaries cancel and all looks alike from above.
inline void try_points_on_edges(generate::Random& random) {
  const auto height = [&] { return generate::integer(random, -1, 1); };
  generate::Points outer, hole;
  for (const auto& [x, y] : std::array<std::array<long, 2>, 4>{{{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}})
    outer.push_back({x, y, height()});
  const long near = random.between(1, 3), far = random.between(-3, 3);  // clockwise
  for (const auto& [x, y] : std::array<std::array<long, 2>, 3>{{{-2 * near, -2 * near}, {far - 4, 4}, {4, far - 4}}})
    hole.push_back({x, y, height()});
  Exact_point middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (outer[0][k] + hole[0][k]) / 2;
  middle[2] += random.chance(1, 2) ? 1 : -1;
  const auto loop = [&](bool with_middle) {
    generate::Points all = outer;
    all.push_back(outer[0]);
    if (with_middle) all.push_back(middle);
    all.insert(all.end(), hole.begin(), hole.end());
    all.push_back(hole[0]);
    if (with_middle) all.push_back(middle);
    return all;
  };
  const Polygon_soup bent = generate::soup_of({loop(true)}), straight = generate::soup_of({loop(false)});
  const Scene scene(straight);
  if (scene.pieces().empty() || scene.non_planar().empty()) return;
  Outlined parts;
  for (const Piece& piece : scene.pieces()) {
    generate::Points& corners = parts.emplace_back(scene.corner_points(piece));
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random.below(corners.size())),
                corners.end());
  }
  const auto is_surface = [&](const Polygon_soup& of) {
    std::vector<certificate_check::Surface_piece> named;
    for (const generate::Points& part : parts) named.push_back({&part, "a piece"});
    return passes([&] { certificate_check::check_surface("a face", certificate_check::Face(of, 0), named); });
  };
  require(is_surface(straight), "the parts of a face are its surface, which has a way to a hole");
  require(!is_surface(bent), "a face with a point on an edge of a part has another surface");
}

/// Two solids of triangles or quadrilaterals, and a fragment the other way round: it is named by its place in the list,
/// in words as in numbers.
inline void try_named_fragments(generate::Random& random) {
  auto [solids, claim] = claim_of_boxes(random);
  const std::size_t i = random.below(claim.fragments.size());
  std::reverse(claim.fragments[i].vertices.begin(), claim.fragments[i].vertices.end());
  const Verdict verdict = verify_solids(solids, claim, nullptr, {1, {}});
  require(!verdict.accepted && verdict.fragments == std::vector{i}, "a fragment the other way round is told");
  require(verdict.why.find("fragment " + std::to_string(i) + ' ') != std::string::npos,
          "a fragment is named by its place in the certificate");
}

inline void small_certificates(std::string_view bytes) {
  static constexpr std::array<void (*)(generate::Random&), 6> laws{
      try_deep_cuts, try_rays_through_borders, try_other_fates, try_outlines, try_points_on_edges, try_named_fragments};
  ask_one_of(laws, bytes);
}

}  // namespace fuzz
