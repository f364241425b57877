// To be read after covering.cpp and pairs.h, from top to bottom: cones of directions, sums of their boundaries, and the
// check; in it run() first.

#include <sightline/algorithms/verify/visible.h>

#include <sightline/algorithms/verify/pairs.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace sightline {
namespace visible_check {
namespace {

using namespace order_check;

// ---- Cones

/// Where a direction lies: 1 strictly inside the cone, 0 on its boundary, -1 outside. Zero is on the boundary.
int side(const Cone& cone, const Integer_vector& direction) {
  int least = 1;
  for (const Integer_vector& plane : cone.edge_planes) {
    least = std::min(least, sign_of_dot(plane, direction));
    if (least < 0) break;
  }
  return least;
}

/// The cone that directions span. It stands at distance 0, that is, nearer than any polygon. Rejects unless it is
/// convex and pointed, with an inside. Proof: P-63a
Cone cone_of(const std::string& what, const Visible_certificate::Directions& directions) {
  if (directions.size() < 3) reject(what + " has fewer than three directions");
  if (!canonical(directions)) reject(what + " has a direction that is not in canonical numbers");
  std::vector<Integer_vector> rays;
  for (const Exact_point& direction : directions) rays.push_back(primitive(direction));
  Integer_vector middle;  // of the planes of neighbouring rays: if the cone is convex and pointed, it is in front, or
                          // behind, of all rays
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (is_zero(rays[i])) reject(what + " has a direction that is zero");
    const Integer_vector plane = certificate_check::cross(rays[i], rays[(i + 1) % rays.size()]);
    for (std::size_t k = 0; k < 3; ++k) middle[k] += plane[k];
  }
  const int way = sign_of_dot(middle, rays[0]) < 0 ? -1 : 1;
  std::vector<Homogeneous> section;  // by the plane where the middle, or its opposite, has the product 1 with d
  for (const Integer_vector& ray : rays) {
    const Integer height = way * dot(middle, ray);
    if (sgn(height) <= 0) reject(what + " is not a convex cone, or not a pointed one");
    section.push_back({ray[0], ray[1], ray[2], height});
  }
  if (const std::string fault = not_convex(section, {middle[0], middle[1], middle[2], -way}); !fault.empty())
    reject(what + " " + fault);
  Cone cone(section, {0, 0, 0, 1});
  cone.distance = 0;
  return cone;
}

/// A sum of boundaries of cones, as arcs of great circles, each shorter than half a circle. A circle is the normal of
/// its plane up to sign. The sum is zero iff on each circle it is zero just after one point and does not change at any
/// point. Proof: P-63d
class Arc_chain {
 public:
  void add(const Cone& cone, long multiplicity);
  /// A direction where the chain is not zero, if there is one.
  std::optional<Integer_vector> nonzero() const;

 private:
  struct Circle {
    Integer_vector base;
    long after_base = 0;
    std::map<Integer_vector, long> jumps;  // counterclockwise around the axis
  };
  std::map<Integer_vector, Circle> circles_;
};

void Arc_chain::add(const Cone& cone, long multiplicity) {
  for (std::size_t i = 0; i < cone.rays.size(); ++i) {
    Integer_vector axis = primitive(cone.edge_planes[i]), from = cone.rays[i],
                   to = cone.rays[(i + 1) % cone.rays.size()];
    long count = multiplicity;  // taken with the side that the cone is on
    if (axis < Integer_vector{}) {
      axis = negated(axis);
      count = -count;
    }
    const auto left = [&](const Integer_vector& a, const Integer_vector& b) {
      return sign_of_dot(certificate_check::cross(a, b), axis) > 0;
    };
    if (!left(from, to)) std::swap(from, to);
    const auto [place, is_new] = circles_.try_emplace(axis);
    Circle& circle = place->second;
    if (is_new) circle.base = from;
    circle.jumps[from] += count;
    circle.jumps[to] -= count;
    if (from == circle.base || (left(from, circle.base) && left(circle.base, to))) circle.after_base += count;
  }
}

std::optional<Integer_vector> Arc_chain::nonzero() const {
  for (const auto& [axis, circle] : circles_) {
    for (const auto& [direction, jump] : circle.jumps)
      if (jump != 0) return direction;
    if (circle.after_base != 0) return circle.base;
  }
  return std::nullopt;
}

// ---- The field

/// Rejects unless each direction of the field, off a set of measure zero, is in exactly one cone, and no other
/// direction is in any. Proof: P-63e
void check_field(std::span<const Cone> cones, const std::vector<std::string>& names, const Cone* field) {
  Arc_chain difference;
  for (const Cone& cone : cones) difference.add(cone, 1);
  if (field != nullptr) difference.add(*field, -1);
  if (const auto direction = difference.nonzero())
    reject("parts and empty cones do not tile the field: boundaries do not cancel near the direction " +
           name(Exact_point{(*direction)[0], (*direction)[1], (*direction)[2]}));
  if (cones.empty()) reject("there is neither a part nor an empty cone");

  // Now all directions of the field are in equally many cones, and a direction inside the first one counts for all.
  Integer_vector inside;
  for (const Integer_vector& ray : cones[0].rays)
    for (std::size_t k = 0; k < 3; ++k) inside[k] += ray[k];
  if (field != nullptr && side(*field, inside) <= 0) reject(names[0] + " is not inside the field");
  for (std::size_t i = 1; i < cones.size(); ++i)
    if (side(cones[i], inside) >= 0) reject(names[0] + " and " + names[i] + " overlap");
}

// ---- The certificate

/// The certificate, step by step; each throws a Rejection.
class Check {
 public:
  Check(const Visible_certificate& certificate, const Verify_options& options)
      : certificate_(certificate),
        options_(options),
        pieces_(certificate.fragments.size()),
        parts_(certificate.parts.size()),
        tiles_(parts_ + certificate.empty.size()),
        workers_(options, tiles_) {}

  /// Returns what was shown, in one line.
  std::string run(const Polygon_soup& soup) {
    // 1. The eye is a point, and the fragments are the scene.
    if (!canonical(certificate_.eye)) reject("the eye is not a point in canonical numbers");
    const Covered covered = check_covering(soup, certificate_, workers_);
    take_pieces();

    // 2. Each part is a convex polygon inside its piece, with its ray inside its cone.
    for (std::size_t k = 0; k < parts_; ++k) {
      workers_.ask();
      check_part(k);
    }
    for (std::size_t k = 0; k < certificate_.empty.size(); ++k) {
      workers_.ask();
      cones_.push_back(cone_of(names_.emplace_back(name("empty cone", k)), certificate_.empty[k]));
    }

    // 3. No ray meets a piece before its part. No piece is nearer than a part, or as far and preferred, and none is in
    // an empty cone.
    compare_all();

    // 4. Parts and empty cones are the field.
    std::optional<Cone> field;
    if (!certificate_.field.empty()) field = cone_of("the field", certificate_.field);
    check_field(std::span(cones_).subspan(pieces_), names_, field ? &*field : nullptr);
    return std::to_string(parts_) + " visible parts and " + std::to_string(certificate_.empty.size()) +
           " empty cones tile " + (field ? "the field" : "all directions") + rays_of_field() + " from " +
           exact_name(certificate_.eye) + ", every face counted or set aside for a true reason; " + covered.text();
  }

 private:
  enum class Fault { meets_first, is_nearer, is_preferred, is_in };
  /// Of rays before others, then by tile, then by piece.
  using Found = std::tuple<bool, std::size_t, std::size_t, Fault>;

  void take_pieces();
  void check_part(std::size_t k);
  Cone cone_over(const std::string& what, const Visible_certificate::Part& part) const;
  void compare_all();
  /// Finds what is wrong with tile k and piece i.
  void compare(std::size_t k, std::size_t i);
  [[noreturn]] void refuse(const Found& found) const;

  std::string rays_of_field() const {
    std::string text;
    for (const Exact_point& ray : certificate_.field) text += (text.empty() ? " of " : " ") + exact_name(ray);
    return text;
  }
  std::string face_of(std::size_t piece) const { return name("face", certificate_.fragments[piece].face); }

  const Visible_certificate& certificate_;
  const Verify_options& options_;
  const std::size_t pieces_, parts_, tiles_;  // how many
  const Workers workers_;
  std::vector<Cone> cones_;                       // of the pieces, then of the tiles: of the parts and of what is empty
  std::vector<certificate_check::Plane> planes_;  // of the pieces
  std::vector<std::tuple<bool, Face_id, std::uint32_t>>
      preference_;                    // of pieces equally far: seen from the front, then as in the file
  std::vector<std::string> names_;    // of the tiles
  std::vector<Integer_vector> rays_;  // of the parts
  std::optional<Found> first_;
  std::mutex of_first_;
};

void Check::take_pieces() {
  for (const Order_fragment& piece : certificate_.fragments) {
    workers_.ask();
    cones_.emplace_back(piece.vertices, certificate_.eye);
    planes_.push_back({newell_normal(piece.vertices), piece.vertices[0]});
    preference_.emplace_back(planes_.back().side(certificate_.eye) <= 0, piece.face, piece.piece);
  }
}

void Check::check_part(std::size_t k) {
  const Visible_certificate::Part& part = certificate_.parts[k];
  const std::size_t own = part.fragment;
  if (own >= pieces_) reject(name("part", k) + " is of fragment " + std::to_string(own) + ", which there is not");
  const std::string what = names_.emplace_back(name("part", k) + " (" + face_of(own) + ")");
  const bool by_vertices = part.rays.empty();
  if (by_vertices && (!canonical(part.vertices) || !canonical(part.ray)))
    reject(what + " has a vertex or a ray that is not in canonical numbers", {own});
  if (cones_[own].edge_on) reject(what + " is seen edge-on: the eye is in its plane", {own});
  if (by_vertices) {
    if (const std::string fault = not_convex(part.vertices, planes_[own]); !fault.empty())
      reject(what + " " + fault, {own});
    cones_.emplace_back(part.vertices, certificate_.eye);
    rays_.push_back(primitive(part.ray));
  } else {
    cones_.push_back(cone_over(what, part));
    Integer_vector& sum = rays_.emplace_back();
    for (const Integer_vector& ray : cones_.back().rays)
      for (std::size_t i = 0; i < 3; ++i) sum[i] += ray[i];
  }
  for (const Integer_vector& corner : cones_.back().rays)
    if (side(cones_[own], corner) < 0) reject(what + " is not inside its piece", {own});
  if (side(cones_.back(), rays_.back()) <= 0) reject(what + " does not have its ray strictly inside its cone", {own});
}

/// The cone of a part that is given by rays: over its fragment's plane.
Cone Check::cone_over(const std::string& what, const Visible_certificate::Part& part) const {
  Visible_certificate::Directions rays;
  for (const std::uint32_t number : part.rays) {
    if (number >= certificate_.rays.size())
      reject(what + " names ray " + std::to_string(number) + ", which there is not", {part.fragment});
    rays.push_back(certificate_.rays[number]);
  }
  Cone cone = cone_of(what, rays);
  cone.nearness = cones_[part.fragment].nearness;
  cone.distance = cones_[part.fragment].distance;
  return cone;
}

void Check::compare_all() {
  std::vector<std::size_t> places(cones_.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  const auto middle = places.begin() + static_cast<std::ptrdiff_t>(pieces_);
  const std::vector<Rounded_cone> in_doubles = rounded(cones_, workers_);
  Pairs(cones_, in_doubles, [&](std::size_t tile, std::size_t i) {
    compare(tile - pieces_, i);
  }).each({middle, places.end()}, {places.begin(), middle}, workers_, share_of(options_, tiles_));
  if (first_) refuse(*first_);
  if (options_.progress) options_.progress(tiles_, tiles_);
}

void Check::compare(std::size_t k, std::size_t i) {
  const auto found = [&](Fault fault) {
    const Found here(fault != Fault::meets_first, k, i, fault);
    const std::lock_guard lock(of_first_);
    if (!first_ || here < *first_) first_ = here;
  };
  thread_local Pair_check pair;
  const Cone &own = cones_[pieces_ + k], &piece = cones_[i];
  if (k >= parts_) {  // at distance 0: nearer than the piece wherever both are
    if (pair.nearer_somewhere(own, piece)) found(Fault::is_in);
    return;
  }
  if (side(piece, rays_[k]) >= 0 &&
      piece.distance * dot(own.nearness, rays_[k]) < own.distance * dot(piece.nearness, rays_[k]))
    found(Fault::meets_first);
  if (pair.nearer_somewhere(piece, own)) found(Fault::is_nearer);
  const bool one_plane = piece.nearness == own.nearness && piece.distance == own.distance;
  if (one_plane && preference_[i] < preference_[certificate_.parts[k].fragment] && !separates(piece, own) &&
      !separates(own, piece))
    found(Fault::is_preferred);
}

void Check::refuse(const Found& found) const {
  const auto& [later, k, i, fault] = found;
  if (fault == Fault::is_in) reject(names_[k] + " has " + face_of(i) + " in it", {i});
  const std::string what =
      fault == Fault::meets_first ? " is not what its ray meets first: " + face_of(i) + " is nearer"
      : fault == Fault::is_nearer ? " is behind " + face_of(i) + " somewhere"
                                  : " is as far as " + face_of(i) + " somewhere, which is preferred";
  reject(names_[k] + what, {certificate_.parts[k].fragment, i});
}

}  // namespace
}  // namespace visible_check

Verdict verify_visible(const Polygon_soup& soup, const Visible_certificate& certificate,
                       const Verify_options& options) {
  return certificate_check::verdict_of([&] { return visible_check::Check(certificate, options).run(soup); });
}

}  // namespace sightline
