#pragma once
// Certificates of weak visibility made by hand, of a few polygons that nearly hide one another: a sightline, or a tree
// that says what blocks all lines, is accepted iff rationals say so.

#include "claims.h"
#include "soups.h"

#include <sightline/harness/laws/flat_faces.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace fuzz {

using generate::Random;
using harness::Flat_face;

/// A triangle or a parallelogram: its middle and its arms are small whole numbers, about the height z. Of area.
inline Points leaning(long z, long size, Random& random) {
  for (;;) {
    const auto vector = [&](long most) { return generate::lattice(random, most); };
    Exact_point p = vector(2), u = vector(size), v = vector(size);
    if (random.chance(2, 3)) u[2] = v[2] = 0;
    p[2] = Rational(z + random.between(-1, 1)) - (random.chance(1, 2) ? Rational(u[2] + v[2]) / 2 : Rational(0));
    if (is_zero(cross(u, v))) continue;
    const auto at = [&](const Rational& s, const Rational& t) {
      return generate::along(generate::along(p, s, u), t, v);
    };
    if (random.chance(1, 3)) return {at(-1, -1), at(1, 0), at(0, 1)};
    if (random.chance(1, 2)) return {at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)};
    return {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
  }
}

/// The polygon with its front to a point, if that is not in its plane.
inline Points facing(Points polygon, const Exact_point& point) {
  if (Flat_face(polygon).height(point) < 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

/// A source, and faces, of which the first is the target.
struct Weak_scene {
  Points source;
  std::vector<Points> faces;

  Polygon_soup soup() const { return generate::soup_of(faces); }
  /// Fragments are the faces; of all but the target nothing is said.
  Weak_certificate certificate(bool two_sided) const {
    Weak_certificate all;
    all.sources = {source};
    all.two_sided = two_sided;
    for (Face_id f = 0; f < faces.size(); ++f) {
      all.fragments.push_back({f, 0, faces[f]});
      if (f > 0) all.undecided.push_back(f);
    }
    return all;
  }
};

/// Strictly inside, as likely as not at its centre.
inline Exact_point any_inside(const Points& polygon, Random& random) {
  Exact_point sum{0, 0, 0};
  long all = 0;
  const bool centre = random.chance(1, 2);
  for (const Exact_point& p : polygon) {
    const long weight = centre ? 1 : static_cast<long>(random.between(1, 4));
    sum = generate::along(sum, weight, p);
    all += weight;
  }
  for (Rational& x : sum) x /= all;
  return sum;
}

// ---- Sightlines

/// A face that has the point inside, on an edge or as a corner; in a plane, if one is given.
inline Points touching(const Exact_point& p, const Points* in_plane_of, Random& random) {
  for (;;) {
    Exact_point u = generate::lattice(random, 2), v = generate::lattice(random, 2);
    if (in_plane_of != nullptr) {
      u = minus((*in_plane_of)[1], (*in_plane_of)[0]);
      v = minus((*in_plane_of)[2], (*in_plane_of)[random.below(2)]);
      if (random.chance(1, 2)) std::swap(u, v);
    }
    if (is_zero(cross(u, v))) continue;
    const auto at = [&](long s, long t) { return generate::along(generate::along(p, s, u), t, v); };
    Points face;
    switch (random.below(4)) {
      case 0: face = {at(0, 0), at(1, 0), at(0, 1)}; break;
      case 1: face = {at(-1, 0), at(1, 0), at(0, 1)}; break;
      case 2: face = {at(-1, -1), at(1, -1), at(0, 1)}; break;
      default: face = {at(1, 0), at(2, 0), at(1, 1)};
    }
    return face;
  }
}

/// A face in a plane with the segment from p to p + u: on it, before it, behind it or on one side of it.
inline Points beside(const Exact_point& p, const Exact_point& u, Random& random) {
  Exact_point v{0, 0, 0};
  while (is_zero(cross(u, v))) v = generate::lattice(random, 2);
  const Rational s = Rational(static_cast<long>(random.between(-3, 5))) / 2;
  const Rational t = Rational(static_cast<long>(random.between(-3, 3))) / 2;
  const Points plane{p, generate::along(p, 1, u), generate::along(p, 1, v)};
  return touching(generate::along(generate::along(p, s, u), t, v), &plane, random);
}

inline void try_sightline(Random& random) {
  Weak_scene scene{leaning(0, 2, random), {leaning(4, 2, random)}};
  const Exact_point p = random.chance(1, 8) ? scene.source[0] : any_inside(scene.source, random),
                    q = random.chance(1, 8) ? scene.faces[0][0] : any_inside(scene.faces[0], random);
  if (!random.chance(1, 8)) {
    scene.source = facing(scene.source, q);
    scene.faces[0] = facing(scene.faces[0], p);
  }
  for (std::uint64_t k = random.below(3); k > 0; --k) {
    Points other;
    switch (random.below(5)) {
      case 0: other = touching(p, random.chance(1, 2) ? &scene.source : nullptr, random); break;
      case 1: other = touching(q, random.chance(1, 2) ? &scene.faces[0] : nullptr, random); break;
      case 2: other = touching(generate::along(p, Rational(1, 2), minus(q, p)), nullptr, random); break;
      case 3: other = beside(p, minus(q, p), random); break;
      default: other = leaning(2, 2, random);
    }
    scene.faces.push_back(generate::either_way(other, random));
  }
  const bool two_sided = random.chance(1, 4);
  Weak_certificate claim = scene.certificate(two_sided);
  claim.visible.push_back({0, 0, p, q});

  const Flat_face source(scene.source), target(scene.faces[0]);
  const auto in_plane = [](const Flat_face& a, const Flat_face& b) {
    return std::all_of(a.corners.begin(), a.corners.end(), [&](const Exact_point& r) { return b.height(r) == 0; });
  };
  bool holds = source.side_within(p) > 0 && target.side_within(q) > 0 && source.height(q) > 0 &&
               (two_sided ? target.height(p) != 0 : target.height(p) > 0);
  for (const Points& face : scene.faces) {
    const Flat_face other(face);
    const std::optional<Rational> t = harness::met_at(other, p, minus(q, p));
    const bool along = other.height(p) == 0 && other.height(q) == 0;
    const bool is_end = !along && t && ((*t == 0 && in_plane(other, source)) || (*t == 1 && in_plane(other, target)));
    holds = holds && (!t || *t > 1 || is_end);
  }
  const Verdict verdict = verify_weak(scene.soup(), claim);
  if (verdict.accepted != holds)
    throw Finding(std::string("a sightline is ") + (holds ? "rejected: " : "accepted: ") + verdict.why);
}

// ---- What is hidden

using Proof = std::vector<Weak_certificate::Node>;

inline Weak_certificate::Node leaf(std::size_t fragment) {
  return {Weak_certificate::Node::Kind::blocked, fragment, {}, {}};
}

/// Whether each line from source to target passes the blocker between them: it does if those from corner to corner do.
inline bool is_blocked(const Points& source, const Points& target, const Points& blocker) {
  const Flat_face face(blocker);
  int here = 0, there = 0;  // sides of source and target
  for (const Points* of : {&source, &target}) {
    bool above = false, below = false;
    for (const Exact_point& p : *of) {
      above = above || face.height(p) > 0;
      below = below || face.height(p) < 0;
    }
    (of == &source ? here : there) = int{above} - int{below};
  }
  if (here * there >= 0) return false;
  for (const Exact_point& p : source)
    for (const Exact_point& q : target) {
      const Rational from = face.height(p), to = face.height(q);
      if (from == to) continue;  // both are in its plane
      if (face.side_within(generate::along(p, Rational(from / (from - to)), minus(q, p))) < 0) return false;
    }
  return true;
}

/// A plane that has corners of the polygon on both sides.
inline Weak_certificate::Form any_cut(const Points& polygon, Random& random) {
  for (;;) {
    const Exact_point normal = generate::lattice(random, 2), at = any_inside(polygon, random);
    const Rational offset = -dot(normal, at);
    if (std::any_of(polygon.begin(), polygon.end(), [&](const Exact_point& p) { return dot(normal, p) + offset != 0; }))
      return {normal[0], normal[1], normal[2], offset};
  }
}

/// A tree at random over the lines and cuts, each of its leaves blocked by one of the blockers.
inline void grow(Proof& proof, const Weak_scene& scene, std::size_t lines, std::size_t depth, bool cuts_only,
                 const std::vector<std::size_t>& blockers, Random& random) {
  using Node = Weak_certificate::Node::Kind;
  if (depth == 0 || random.chance(1, 3)) return proof.push_back(leaf(blockers[random.below(blockers.size())]));
  const std::uint64_t kind = cuts_only ? 1 + random.below(2) : random.below(3);
  if (kind == 0) proof.push_back({Node::line, random.below(lines), {}, {}});
  else if (kind == 1) proof.push_back({Node::cut_source, 0, any_cut(scene.source, random), {}});
  else proof.push_back({Node::cut_target, 0, any_cut(scene.faces[0], random), {}});
  // A plane may leave one half of a cell empty that is cut before: such trees are rejected.
  for (int half = 0; half < 2; ++half) grow(proof, scene, lines, depth - 1, cuts_only, blockers, random);
}

/// Near each corner of a polygon, and in its middle, strictly inside.
inline Places near_corners(const Points& polygon) {
  Places all;
  for (std::size_t k = 0; k <= polygon.size(); ++k) {
    Exact_point sum{0, 0, 0};
    long weights = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const long weight = i == k ? 1000 : 1;
      sum = generate::along(sum, weight, polygon[i]);
      weights += weight;
    }
    for (Rational& x : sum) x /= weights;
    all.push_back(place(sum));
  }
  return all;
}

/// Throws where a line from near a corner of the source to near one of the target passes all faces by.
inline void try_hidden(const Weak_scene& scene, bool two_sided) {
  const Flat source(scene.source), target(scene.faces[0]);
  std::vector<Flat> others;
  for (std::size_t f = 1; f < scene.faces.size(); ++f) others.emplace_back(scene.faces[f]);
  for (const Place& p : near_corners(scene.source))
    for (const Place& q : near_corners(scene.faces[0])) {
      const int front = target.side(p);
      if (source.side(q) <= 0 || front == 0 || (front < 0 && !two_sided)) continue;
      require(std::any_of(others.begin(), others.end(),
                          [&](const Flat& other) {
                            return other.hit(p, q).has_value() || (other.side(p) == 0 && other.side(q) == 0);
                          }),
              "what is hidden is not seen past all faces");
    }
}

inline Rational canonical(Rational value) {
  value.canonicalize();
  return value;
}

inline void try_tree(Random& random) {
  using Node = Weak_certificate::Node::Kind;
  Weak_scene scene{leaning(0, 1, random), {leaning(4, 1, random)}};
  scene.source = facing(scene.source, scene.faces[0][0]);
  scene.faces[0] = facing(scene.faces[0], scene.source[0]);
  const Points wall = generate::either_way(leaning(2, static_cast<long>(random.between(1, 4)), random), random);
  const std::size_t n = wall.size(), first = random.below(n), second = first + 2;
  const bool in_two = n == 4 && random.chance(1, 2);
  if (in_two) {  // along a diagonal
    scene.faces.push_back({wall[first], wall[(first + 1) % n], wall[second % n]});
    scene.faces.push_back({wall[second % n], wall[(second + 1) % n], wall[first]});
  } else {
    scene.faces.push_back(wall);
  }
  if (random.chance(1, 4)) scene.faces.push_back(leaning(2, 2, random));
  const bool two_sided = random.chance(1, 4), truth = is_blocked(scene.source, scene.faces[0], wall);
  const Polygon_soup soup = scene.soup();
  Weak_certificate claim = scene.certificate(two_sided);
  for (std::size_t f = 1; f < scene.faces.size(); ++f)
    for (std::size_t k = 0; k < scene.faces[f].size(); ++k) claim.lines.push_back({f, k});
  const auto accepts = [&](const Proof& proof) {
    claim.hidden = {{0, 0, proof}};
    return verify_weak(soup, claim).accepted;
  };

  // 1. One leaf, or two on both sides of the diagonal, say what corners say.
  if (!in_two) {
    require(accepts({leaf(1)}) == truth, "a blocked leaf is accepted iff lines from corner to corner are blocked");
  } else {
    const std::size_t diagonal = 2;  // of the first half
    const bool one = accepts({{Node::line, diagonal, {}, {}}, leaf(1), leaf(2)}),
               other = accepts({{Node::line, diagonal, {}, {}}, leaf(2), leaf(1)});
    require((one || other) == truth, "two halves of a wall are accepted iff it blocks lines from corner to corner");
  }

  // 2. More of a tree than is needed.
  std::vector<std::size_t> blockers;
  for (std::size_t f = 1; f < scene.faces.size(); ++f) blockers.push_back(f);
  for (std::size_t k = 0; k < 6; ++k) {
    const bool cuts_only = !in_two && k < 2;
    Proof proof;
    grow(proof, scene, claim.lines.size(), 1 + k / 2, cuts_only, cuts_only ? std::vector<std::size_t>{1} : blockers,
         random);
    const bool accepted = accepts(proof);
    if (accepted) try_hidden(scene, two_sided);
    if (cuts_only && truth && k == 0) require(accepted, "what blocks all lines blocks those of a part");
  }

  // 3. Leaves that say both sides of a line are empty: sums of it, whatever its factors.
  for (std::size_t k = 0; k < claim.lines.size(); ++k) {
    const auto empty = [&] {
      const Rational factor(static_cast<long>(random.between(-2, 2)), 1 + random.below(2));
      return Weak_certificate::Node{Node::empty, 0, {}, {{k, canonical(factor), {}, {}}}};
    };
    if (accepts({{Node::line, k, {}, {}}, empty(), empty()})) try_hidden(scene, two_sided);
  }
}

inline void weak_claims(std::string_view bytes) {
  constexpr std::size_t claims = 8;
  Random random(Bytes(bytes).word());
  for (std::size_t k = 0; k < claims; ++k) {
    if (random.chance(1, 2)) try_sightline(random);
    else try_tree(random);
  }
}

}  // namespace fuzz
