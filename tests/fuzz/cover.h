#pragma once
// What a certificate says of a scene beside its answer: the pieces of faces that are cut, and of no others, told by the
// faces' own points; and that a checker takes it, and nothing less.

#include "faces.h"

#include <sightline/algorithms/covering_of_scene.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

namespace fuzz {

/// Whether all points of a face are in one plane.
inline bool is_planar(const Polygon_soup& soup, Face_id face) {
  generate::Points points;
  for (std::size_t k = 0; k < soup.loop_count(face); ++k)
    for (const Point_id p : soup.loop(face, k)) points.push_back(soup.point(p));
  Exact_point normal{0, 0, 0};
  for (const Exact_point& p : points)
    for (const Exact_point& q : points)
      if (is_zero(normal)) normal = cross(minus(p, points[0]), minus(q, points[0]));
  return std::all_of(points.begin(), points.end(),
                     [&](const Exact_point& p) { return dot(normal, minus(p, points[0])) == 0; });
}

inline void cover(std::string_view bytes) {
  Random random(Bytes(bytes).word());
  const Polygon_soup soup = random.chance(1, 4) ? any_soup(random).soup : soup_of_outlines(1 + random.below(4), random);
  const Scene scene(soup);
  // 1. All pieces are fragments, in their order; those of a face that is cut are pieces too.
  std::map<Face_id, std::size_t> count;
  for (const Piece& piece : scene.pieces()) ++count[piece.face];
  std::vector<Order_fragment> all, cut;
  for (const Piece& piece : scene.pieces()) {
    Order_fragment part;
    part.face = piece.face;
    part.piece = piece.number;
    part.vertices = scene.corner_points(piece);
    if (count[piece.face] > 1 || !is_planar(soup, piece.face)) cut.push_back(part);
    all.push_back(std::move(part));
  }
  Covering covering, pieces;
  add_all(covering, scene);
  add_pieces(pieces, scene);
  const auto are = [](const auto& told, const std::vector<Order_fragment>& meant) {
    return std::equal(told.begin(), told.end(), meant.begin(), meant.end(), [](const auto& a, const auto& b) {
      return a.face == b.face && a.piece == b.piece && a.vertices == b.vertices;
    });
  };
  require(are(covering.fragments, all), "each piece is a fragment");
  require(are(covering.pieces, cut) && are(pieces.pieces, cut),
          "pieces are those of faces that are cut, and no others");
  require(pieces.fragments.empty(), "pieces alone are no fragments");
  require(covering.set_aside.size() == scene.set_aside().size() &&
              covering.set_aside.size() + count.size() == soup.face_count(),
          "a face has pieces or is set aside");
  for (std::size_t k = 0; k < covering.set_aside.size(); ++k)
    require(covering.set_aside[k].face == scene.set_aside()[k].face &&
                covering.set_aside[k].why == scene.set_aside()[k].why,
            "what is set aside is told with its reason");

  // 2. A checker takes it, and not less: without a fragment, without a face that is set aside, without a piece.
  const auto is_scene = [&](const Covering& told) {
    return passes([&] { certificate_check::check_covering(soup, told, 1); });
  };
  require(is_scene(covering), "a scene's covering is the scene");
  const auto less = [&](auto part) {
    Covering lie = covering;
    auto& list = lie.*part;
    if (list.empty()) return;
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(random.below(list.size())));
    require(!is_scene(lie), "less than the covering is not the scene");
  };
  less(&Covering::fragments);
  less(&Covering::set_aside);
  less(&Covering::pieces);
}

}  // namespace fuzz
