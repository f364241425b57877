#pragma once
// What becomes of faces, and what checkers take for it: the scene and the checkers, which share nothing, agree about
// what is set aside and why, about the one surface of a face that is not planar, and about faces drawn without their
// spikes; no two parts of a planar face could be one.

#include "soups.h"

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/faces.h>
#include <sightline/algorithms/verify/set_aside.h>
#include <sightline/algorithms/verify/surface.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace fuzz {

using Outlined = std::vector<generate::Points>;  // parts of a face

template <class Check>
bool passes(Check check) {
  try {
    check();
    return true;
  } catch (const certificate_check::Rejection&) {
    return false;
  }
}

// ---- What is set aside

/// Whether nothing is left of a contour without its spikes.
inline bool all_spikes(const Polygon_soup& soup, Face_id face) {
  const certificate_check::Face given(soup, face);
  return certificate_check::without_straight_points(given.loops[0]).empty();
}

/// Reasons, right and wrong, of every face: one is accepted iff the scene says the same.
inline void try_reasons(const Polygon_soup& soup, const Scene& scene) {
  std::vector<std::string> why(soup.face_count());
  std::set<Face_id> set_aside;
  for (const Set_aside& entry : scene.set_aside()) {
    why[entry.face] = entry.why;
    set_aside.insert(entry.face);
  }
  const std::string duplicate(text_of(Set_aside_reason::duplicate));
  std::vector<std::string> reasons{"", duplicate, duplicate + "x", duplicate + "-0", duplicate + "4294967296", "zero"};
  for (const std::string_view text : set_aside_texts)
    if (text != duplicate) reasons.emplace_back(text);
  for (std::size_t f = 0; f <= soup.face_count(); ++f) reasons.push_back(duplicate + std::to_string(f));
  for (Face_id face = 0; face < soup.face_count(); ++face)
    for (const std::string& reason : reasons) {
      // A hole the other way round is the same hole to the checker, and another one to the scene.
      if (reason.starts_with(duplicate) && soup.loop_count(face) > 1 && reason != why[face]) continue;
      // Of what has no area both may hold.
      if (why[face] == text_of(Set_aside_reason::zero_area) && reason.starts_with("not planar")) continue;
      // So may these, where a hole takes all of a contour that crosses itself, or it is nothing but spikes.
      if (why[face] == text_of(Set_aside_reason::self_intersecting) && reason == text_of(Set_aside_reason::zero_area) &&
          (soup.loop_count(face) > 1 || all_spikes(soup, face)))
        continue;
      const bool accepted = passes([&] { certificate_check::check_set_aside(soup, {face, reason}, set_aside); });
      if (accepted != (!reason.empty() && reason == why[face]))
        throw Finding("face " + std::to_string(face) + ", set aside for \"" + why[face] + "\", is " +
                      (accepted ? "accepted" : "rejected") + " for \"" + reason + '"');
    }
}

// ---- Surfaces

inline generate::Points from_least(generate::Points polygon) {
  std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  return polygon;
}
/// Whichever way they are written down.
inline std::multiset<generate::Points> all_of(const Outlined& parts) {
  std::multiset<generate::Points> all;
  for (const generate::Points& part : parts) all.insert(from_least(part));
  return all;
}

/// The other diagonal of two triangles with an edge in common: of those that there are, the k-th.
inline std::optional<Outlined> other_diagonal(Outlined parts, std::size_t k) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t e = 0; e < 9; ++e) {
        const std::size_t a = e / 3, b = e % 3;
        if (parts[i][a] != parts[j][(b + 1) % 3] || parts[i][(a + 1) % 3] != parts[j][b] || k-- > 0) continue;
        const Exact_point from = parts[i][a], to = parts[i][(a + 1) % 3], here = parts[i][(a + 2) % 3],
                          there = parts[j][(b + 2) % 3];
        parts[i] = {from, there, here};
        parts[j] = {there, to, here};
        return parts;
      }
  return std::nullopt;
}

/// The parts of a face that is not planar are its surface, and no others are: with another diagonal, one less, one more
/// or one the other way round.
inline void try_surface(const Polygon_soup& soup, Face_id face, const Outlined& parts, Random& random) {
  const certificate_check::Face given(soup, face);
  require(!given.planar, "a face that is cut along an axis is not planar");
  const auto is_surface = [&](const Outlined& pieces) {
    std::vector<certificate_check::Surface_piece> named;
    for (const generate::Points& piece : pieces) named.push_back({&piece, "a piece"});
    return passes([&] { certificate_check::check_surface("a face", given, named); });
  };
  require(is_surface(parts), "the parts of a face are its surface");
  Outlined told = parts;
  random.shuffle(told);
  for (generate::Points& part : told) std::rotate(part.begin(), part.begin() + 1, part.end());
  require(is_surface(told), "the parts of a face are its surface, however they are told");
  std::vector<Outlined> lies;
  for (std::size_t k = 0;; ++k) {
    const std::optional<Outlined> lie = other_diagonal(parts, k);
    if (!lie) break;
    lies.push_back(*lie);
  }
  const std::size_t i = random.below(parts.size());
  lies.insert(lies.end(), 4, parts);
  const std::size_t last = lies.size() - 4;
  lies[last].erase(lies[last].begin() + static_cast<std::ptrdiff_t>(i));
  lies[last + 1].push_back(parts[i]);
  std::reverse(lies[last + 2][i].begin(), lies[last + 2][i].end());
  lies[last + 3][i][random.below(3)] = soup.point(static_cast<Point_id>(random.below(soup.point_count())));
  for (const Outlined& lie : lies)
    if (all_of(lie) != all_of(parts)) require(!is_surface(lie), "a face has no other surface");
}

// ---- Planar faces

/// What is left of a face without its spikes is a tiling of it iff the scene keeps the face.
inline void try_without_spikes(const Polygon_soup& soup, Face_id face, bool kept) {
  const certificate_check::Face given(soup, face);
  if (!given.planar || !given.has_front) return;
  // 1. The face alone, and less its spikes.
  Polygon_soup as_it_is, bare;
  for (const certificate_check::Polygon& loop : given.loops) {
    const certificate_check::Polygon left = certificate_check::without_straight_points(loop);
    if (&loop == &given.loops[0] && left.empty()) return;
    for (const auto& [to, points] : {std::pair(&as_it_is, &loop), std::pair(&bare, &left)}) {
      std::vector<Point_id> ids;
      for (const Exact_point& p : *points) ids.push_back(to->add_point(p[0], p[1], p[2]));
      if (&loop == &given.loops[0]) to->add_face(ids);
      else if (!ids.empty()) to->add_hole(ids);
    }
  }
  // 2. Drawn in the parts of the latter.
  const Scene scene(bare);
  Covering drawn;
  for (const Piece& piece : scene.pieces()) {
    Order_fragment& fragment = drawn.fragments.emplace_back();
    fragment.vertices = scene.corner_points(piece);
  }
  const bool accepted = passes([&] { certificate_check::check_covering(as_it_is, drawn, 1); });
  require(accepted == kept, kept ? "a face without its spikes is a tiling of it"
                                 : "a face that is set aside is not drawn without its spikes");
}

/// Twice the area of points' convex hull in a plane, by the normal.
inline Rational hull_area(const generate::Points& points, const Exact_point& normal) {
  Rational area = 0;
  for (const Exact_point& p : points)
    for (const Exact_point& q : points) {
      if (p == q) continue;
      // An edge of the hull has all else on its left; a straight one counts once, from end to end.
      const Exact_point left = cross(normal, minus(q, p));
      const bool is_edge = std::all_of(points.begin(), points.end(), [&](const Exact_point& r) {
        const int side = sgn(dot(left, minus(r, p)));
        if (side != 0) return side > 0;
        const Rational at = dot(minus(q, p), minus(r, p));
        return at >= 0 && at <= dot(minus(q, p), minus(q, p));
      });
      if (is_edge) area += dot(normal, cross(minus(p, points[0]), minus(q, points[0])));
    }
  return area;
}

/// Two parts make up a convex polygon iff that is all of their hull.
inline void try_parts(const Outlined& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Exact_point normal = harness::Flat_face(parts[i]).normal;
      std::set<Exact_point> both(parts[i].begin(), parts[i].end());
      both.insert(parts[j].begin(), parts[j].end());
      require(
          hull_area({both.begin(), both.end()}, normal) != hull_area(parts[i], normal) + hull_area(parts[j], normal),
          "no two parts of a face could be one");
    }
}

inline void faces(std::string_view bytes) {
  Random random(Bytes(bytes).word());
  const Polygon_soup soup = soup_of_outlines(1 + random.below(4), random);
  const Scene scene(soup);
  try_reasons(soup, scene);
  std::vector<Outlined> parts(soup.face_count());
  for (const Piece& piece : scene.pieces()) {
    parts[piece.face].push_back(scene.corner_points(piece));
  }
  const std::set<Face_id> skew(scene.non_planar().begin(), scene.non_planar().end());
  std::vector<char> kept(soup.face_count(), 1);
  for (const Set_aside& entry : scene.set_aside())
    kept[entry.face] = entry.why.starts_with(text_of(Set_aside_reason::duplicate)) ? 2 : 0;
  for (Face_id face = 0; face < parts.size(); ++face) {
    if (kept[face] != 2) try_without_spikes(soup, face, kept[face] == 1);
    if (parts[face].empty()) continue;
    if (skew.count(face) > 0) try_surface(soup, face, parts[face], random);
    else try_parts(parts[face]);
  }
}

}  // namespace fuzz
