#pragma once
// Lies about what an eye sees, each by a name.

#include "lies.h"

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <utility>

namespace fuzz {

inline bool is_of_another_in_its_plane(Visible_certificate& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.parts.empty()) return false;
  std::size_t& own = claim.parts[any_of_first(claim.parts, bytes)].fragment;
  const std::vector<Flat> fragments = flats(claim);
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < fragments.size(); ++i)
    if (i != own && fragments[i].is_in_plane_of(fragments[own])) others.push_back(i);
  if (others.empty()) return false;
  own = others[any_of_first(others, bytes)];
  return true;
}

/// One side of a cone of rays: where their product with `outwards` is not positive. Nothing where no inside is left.
inline Points clipped_cone(const Points& rays, const Exact_point& outwards) {
  Points left;
  const auto height = [&](const Exact_point& ray) -> Rational { return dot(outwards, ray); };
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Exact_point &p = rays[i], &q = rays[(i + 1) % rays.size()];
    const Rational at_p = height(p), at_q = height(q);
    if (sgn(at_p) <= 0) left.push_back(p);
    if (sgn(at_p) * sgn(at_q) >= 0) continue;
    Exact_point& between = left.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) between[k] = abs(at_q) * p[k] + abs(at_p) * q[k];
  }
  return left.size() < 3 || is_flat_cone(left) ? Points() : left;
}

/// A cone of rays cut along the edges of another one: what is in both, and what is beside it.
struct Cut_cone {
  Points inside;
  std::vector<Points> beside;
};
inline Cut_cone cut_cone(Points rays, const Points& along) {
  Exact_point middle = along[0];
  for (std::size_t i = 1; i < along.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] += along[i][axis];
  std::vector<Points> beside;
  for (std::size_t i = 0; i < along.size() && !rays.empty(); ++i) {
    Exact_point outwards = cross(along[i], along[(i + 1) % along.size()]);
    const int sense = sgn(dot(outwards, middle));
    if (sense == 0) continue;  // a straight corner
    Exact_point inwards = outwards;
    for (Rational& x : sense > 0 ? outwards : inwards) x = -x;
    if (Points part = clipped_cone(rays, inwards); !part.empty()) beside.push_back(std::move(part));
    rays = clipped_cone(rays, outwards);
  }
  return {std::move(rays), std::move(beside)};
}

/// The rays to a fragment's corners.
inline Points outline_of(const Visible_certificate& claim, std::size_t fragment) {
  Points outline;
  for (const Exact_point& p : claim.fragments[fragment].vertices) outline.push_back(minus(p, claim.eye));
  return outline;
}
inline void add_part(Visible_certificate& claim, std::size_t fragment, const Points& rays) {
  Visible_certificate::Part& part = claim.parts.emplace_back();
  part.fragment = fragment;
  for (const Exact_point& ray : rays) {
    part.rays.push_back(static_cast<std::uint32_t>(claim.rays.size()));
    claim.rays.push_back(ray);
  }
}

/// A part is cut along the edges of another fragment, and what they have in common is said to be of that one: which is
/// behind it, wherever the certificate is right.
inline bool shows_what_is_behind(Visible_certificate& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.parts.empty()) return false;
  const std::size_t k = any_of_first(claim.parts, bytes), count = claim.fragments.size();
  const Visible_certificate::Part part = claim.parts[k];
  // 1. Another fragment that the eye would see there.
  std::size_t other = any_of_first(claim.fragments, bytes);
  Cut_cone cut;
  for (std::size_t tried = 0; tried < count && cut.inside.empty(); ++tried) {
    other = (other + 1) % count;
    const Points outline = outline_of(claim, other);
    if (other != part.fragment && !is_flat_cone(outline)) cut = cut_cone(rays_of(claim, part), outline);
  }
  if (cut.inside.empty()) return false;
  // 2. The parts.
  claim.parts.erase(claim.parts.begin() + static_cast<std::ptrdiff_t>(k));
  for (const Points& rays : cut.beside) add_part(claim, part.fragment, rays);
  add_part(claim, other, cut.inside);
  return true;
}

/// A fragment of which something is seen is seen whole: one part, and all that was there is cut away.
inline bool shows_all_of_one(Visible_certificate& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.parts.empty()) return false;
  const std::size_t whole = claim.parts[any_of_first(claim.parts, bytes)].fragment;
  const Points outline = outline_of(claim, whole);
  if (is_flat_cone(outline)) return false;
  const std::vector<Visible_certificate::Part> parts = std::exchange(claim.parts, {});
  const std::vector<Points> empty = std::exchange(claim.empty, {});
  for (const Visible_certificate::Part& part : parts)
    for (const Points& rays : cut_cone(rays_of(claim, part), outline).beside) add_part(claim, part.fragment, rays);
  for (const Points& cone : empty)
    for (Points& rays : cut_cone(cone, outline).beside) claim.empty.push_back(std::move(rays));
  add_part(claim, whole, outline);
  return true;
}

/// All directions on one side of a plane through the eye are left out: what is on the other side ends at that plane,
/// all along it. Often the plane is one through two rays.
inline bool leaves_out_one_side(Visible_certificate& claim, const Posed_scene&, Bytes& bytes) {
  const std::vector<Visible_certificate::Part> parts = std::exchange(claim.parts, {});
  const std::vector<Points> empty = std::exchange(claim.empty, {});
  if (parts.empty() && empty.empty()) return false;
  Points all;
  for (const Visible_certificate::Part& part : parts)
    for (const Exact_point& ray : rays_of(claim, part)) all.push_back(ray);
  for (const Points& cone : empty) all.insert(all.end(), cone.begin(), cone.end());
  Exact_point outwards{0, 0, 0};
  if (bytes.below(2) == 0) {
    const Exact_point& ray = all[any_of_first(all, bytes)];
    outwards = cross(ray, all[any_of_first(all, bytes)]);
  }
  if (is_zero(outwards)) {
    for (Rational& x : outwards) x = static_cast<long>(bytes.below(7)) - 3;
    outwards[2] += 4;
  }
  for (const Visible_certificate::Part& part : parts)
    if (const Points rays = clipped_cone(rays_of(claim, part), outwards); !rays.empty())
      add_part(claim, part.fragment, rays);
  for (const Points& cone : empty)
    if (Points rays = clipped_cone(cone, outwards); !rays.empty()) claim.empty.push_back(std::move(rays));
  return true;
}

/// All directions twice: once more with each part and each empty cone cut along a plane, which goes through the first
/// one's middle, so that this is in no other cone, but on the border of two.
inline bool shows_all_twice(Visible_certificate& claim, const Posed_scene&, Bytes& bytes) {
  const std::vector<Visible_certificate::Part> parts = claim.parts;
  const std::vector<Points> empty = claim.empty;
  if (parts.empty() && empty.empty()) return false;
  const Points first = parts.empty() ? empty[0] : rays_of(claim, parts[0]);
  Exact_point middle{0, 0, 0}, normal;
  for (const Exact_point& ray : first) {
    const Place whole = direction(ray);
    const Integer common = gcd(gcd(whole[0], whole[1]), whole[2]);
    for (std::size_t k = 0; k < 3; ++k) middle[k] += Rational(whole[k]) / common;
  }
  for (Rational& x : normal) x = static_cast<long>(bytes.below(7)) - 3;
  normal = cross(normal, middle);
  if (is_zero(normal)) return false;
  const Exact_point opposite{-normal[0], -normal[1], -normal[2]};
  for (const Exact_point& outwards : {normal, opposite}) {
    for (const Visible_certificate::Part& part : parts)
      if (const Points rays = clipped_cone(rays_of(claim, part), outwards); !rays.empty())
        add_part(claim, part.fragment, rays);
    for (const Points& cone : empty)
      if (Points rays = clipped_cone(cone, outwards); !rays.empty()) claim.empty.push_back(std::move(rays));
  }
  return true;
}

/// The field is one part, which is there twice, among all others: these are as many times in no field as that is once
/// more in it.
inline bool has_all_beside_the_field(Visible_certificate& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.parts.empty()) return false;
  const Visible_certificate::Part part = claim.parts[any_of_first(claim.parts, bytes)];
  claim.field = rays_of(claim, part);
  claim.parts.push_back(part);
  return true;
}

inline const std::vector<Lie<Visible_certificate>>& lies_in(const Visible_certificate&) {
  using Claim = Visible_certificate;
  static const std::vector<Lie<Claim>> all = with_lies_about_fragments<Claim>(
      {{"of the true eye", of_the_true_eye<Claim>},
       {"the eye nudged", nudges_the_eye<Claim>},
       {"a ray nudged", [](Claim& claim, const Posed_scene&, Bytes& bytes) { return nudge_any(claim.rays, bytes); }},
       {"an empty cone nudged",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          return !claim.empty.empty() && nudge_any(claim.empty[any_of_first(claim.empty, bytes)], bytes);
        }},
       {"parts exchanged",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          return exchange(claim.parts, bytes, &Visible_certificate::Part::fragment);
        }},
       {"a part of another fragment",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.parts.empty()) return false;
          const std::size_t fragment = any_of_first(claim.fragments, bytes);
          return std::exchange(claim.parts[any_of_first(claim.parts, bytes)].fragment, fragment) != fragment;
        }},
       {"a part of another fragment in its plane", is_of_another_in_its_plane},
       {"what is behind is seen", shows_what_is_behind},
       {"one fragment is seen whole", shows_all_of_one},
       {"what is seen is called empty",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.parts.empty()) return false;
          const std::size_t k = any_of_first(claim.parts, bytes);
          claim.empty.push_back(rays_of(claim, claim.parts[k]));
          claim.parts.erase(claim.parts.begin() + static_cast<std::ptrdiff_t>(k));
          return true;
        }},
       {"what is empty is seen",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.empty.empty() || claim.fragments.empty()) return false;
          const std::size_t k = any_of_first(claim.empty, bytes);
          add_part(claim, any_of_first(claim.fragments, bytes), claim.empty[k]);
          claim.empty.erase(claim.empty.begin() + static_cast<std::ptrdiff_t>(k));
          return true;
        }},
       {"one part, in a field",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.parts.empty()) return false;
          claim.field = rays_of(claim, claim.parts[any_of_first(claim.parts, bytes)]);
          claim.parts = {claim.parts[any_of_first(claim.parts, bytes)]};
          claim.empty.clear();
          return true;
        }},
       {"one side of a plane left out", leaves_out_one_side},
       {"all directions twice", shows_all_twice},
       {"all beside the field", has_all_beside_the_field},
       {"a part left out",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) { return remove_any(claim.parts, bytes); }},
       {"an empty cone left out",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) { return remove_any(claim.empty, bytes); }}});
  return all;
}

}  // namespace fuzz
