#pragma once
// Convex faces by their corners alone, in rationals: what laws ask by brute force. Nothing here uses planes of a scene,
// predicates, or what an algorithm found.

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/partition_traits.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace sightline::harness {

/// A convex polygon, counterclockwise seen from where its normal points.
struct Flat_face {
  generate::Points corners;
  Exact_point normal{0, 0, 0};  ///< twice its area long

  explicit Flat_face(generate::Points points);
  Rational height(const Exact_point& p) const;
  /// 1 inside, 0 on the boundary, -1 outside. Pre: p is in the face's plane.
  int side_within(const Exact_point& p) const;
  bool holds(const Exact_point& p) const { return height(p) == 0 && side_within(p) >= 0; }
};

std::vector<Flat_face> flat_faces_of(const Scene& scene);
Flat_face flat_face_of(const Exact_traits& traits, const Convex_polygon<Exact_traits>& polygon);

// ---- Rays

/// Where a ray from in front of a face goes through its inside: eye + t direction, t > 0.
std::optional<Rational> pierced_at(const Flat_face& face, const Exact_point& eye, const Exact_point& direction);

/// The least t >= 0 for which origin + t direction is on the face or its boundary.
std::optional<Rational> met_at(const Flat_face& face, const Exact_point& origin, const Exact_point& direction);

// ---- Eyes

/// Whether some ray from an eye in front of both goes through the inside of a and then through that of b. The
/// directions that do are an open cone: a's, cut by b's, and by the plane through the eye where both are as far.
bool sees_over(const Exact_point& eye, const Flat_face& a, const Flat_face& b);

/// Whether sees_over() some point of the points' convex hull. Such eyes p + s (p - q), s > 0, p inside the part A of a
/// in front of b's plane, q inside the part B of b behind a's, are an open convex set, whose closure is
/// conv A + cone(A - B). The hull of points r misses it iff some n != 0 has n (p - r) >= 0 and n (p - q) >= 0 for all
/// corners p, q and all r; whether there is one, half-spaces say that cut each octant of all n.
bool some_eye_sees_over(const generate::Points& hull, const Flat_face& a, const Flat_face& b);

/// What a convex face has inside another one, in another plane: a segment, and whether it goes through there.
enum class Face_meeting { none, stands, passes };
Face_meeting meeting_of(const Flat_face& face, const Flat_face& other);

/// Whether the insides of two faces in different planes have a point in common.
bool cross_each_other(const Flat_face& a, const Flat_face& b);

// ---- What is asked

/// A point that is degenerate as likely as not: the eye, a corner, between two of them, in the plane of a face, inside
/// it. Pre: the scene has a face of three corners or a point.
Exact_point any_point(const Posed_scene& posed, const std::vector<Flat_face>& faces, generate::Random& random);
/// To such a point, along an edge or an axis; not zero.
Exact_point any_direction(const Posed_scene& posed, const std::vector<Flat_face>& faces, const Exact_point& from,
                          generate::Random& random);

/// A check of one scene in `share`: what it does takes longer than the rest of its subject's checks.
Check check_of_a_share(const char* name, const char* what, std::uint64_t share,
                       Outcome (*run)(const Posed_scene& posed, generate::Random& random));

}  // namespace sightline::harness
