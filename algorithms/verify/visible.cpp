#include <sightline/algorithms/verify/visible.h>

#include <sightline/algorithms/verify/order.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

namespace sightline {
namespace visible_check {

int side(const Cone& cone, const Integer_vector& direction) {
  int least = 1;
  for (const Integer_vector& plane : cone.edge_planes) {
    least = std::min(least, sign_of_dot(plane, direction));
    if (least < 0) break;
  }
  return least;
}

Cone cone_of(const std::string& what, const Visible_certificate::Directions& directions) {
  if (directions.size() < 3) reject(what + " has fewer than three directions");
  if (!canonical(directions)) reject(what + " has a direction that is not in canonical numbers");
  std::vector<Integer_vector> rays;
  for (const Exact_point& direction : directions) rays.push_back(primitive(direction));
  Integer_vector middle;  // of the planes of neighbouring rays: if the cone is convex and pointed, it is in front, or
                          // behind, of all rays
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (is_zero(rays[i])) reject(what + " has a direction that is zero");
    const Integer_vector plane = cross(rays[i], rays[(i + 1) % rays.size()]);
    for (std::size_t k = 0; k < 3; ++k) middle[k] += plane[k];
  }
  if (sign_of_dot(middle, rays[0]) < 0) middle = negated(middle);
  Polygon section;  // by the plane where middle.d = 1
  for (const Integer_vector& ray : rays) {
    const Integer height = dot(middle, ray);
    if (sgn(height) <= 0) reject(what + " is not a convex cone, or not a pointed one");
    Exact_point& p = section.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) p[k] = Rational(ray[k]) / Rational(height);
  }
  if (const std::string fault = not_convex(section, {newell_normal(section), section[0]}); !fault.empty())
    reject(what + " " + fault);
  Exact_point origin;
  Cone cone(section, origin);
  cone.distance = 0;
  return cone;
}

void Arc_chain::add(const Cone& cone, long multiplicity) {
  for (std::size_t i = 0; i < cone.rays.size(); ++i) {
    Integer_vector axis = cone.edge_planes[i], from = cone.rays[i], to = cone.rays[(i + 1) % cone.rays.size()];
    long count = multiplicity;  // taken with the side that the cone is on
    if (axis < Integer_vector{}) {
      axis = negated(axis);
      count = -count;
    }
    const auto left = [&](const Integer_vector& a, const Integer_vector& b) {
      return sign_of_dot(cross(a, b), axis) > 0;
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

void check(const Polygon_soup& soup, const Visible_certificate& certificate, const Verify_options& options) {
  // 1. The eye is a point, and the fragments are the scene.
  if (!canonical(certificate.eye)) reject("the eye is not a point in canonical numbers");
  check_covering(soup, certificate);
  const std::size_t pieces = certificate.fragments.size(), parts = certificate.parts.size(),
                    tiles = parts + certificate.empty.size();
  std::vector<Cone> cones;  // of the pieces, then of the tiles: of the parts and of what is empty
  std::vector<certificate_check::Plane> planes;
  std::vector<std::tuple<bool, Face_id, std::uint32_t>>
      preference;  // of pieces equally far: seen from the front, then as in the file
  for (const Order_fragment& piece : certificate.fragments) {
    cones.emplace_back(piece.vertices, certificate.eye);
    planes.push_back({newell_normal(piece.vertices), piece.vertices[0]});
    preference.emplace_back(planes.back().side(certificate.eye) <= 0, piece.face, piece.piece);
  }
  const auto face_of = [&](std::size_t piece) { return name("face", certificate.fragments[piece].face); };

  // 2. Each part is a convex polygon inside its piece, with its ray inside its cone.
  std::vector<std::string> names;    // of the tiles
  std::vector<Integer_vector> rays;  // of the parts
  for (std::size_t k = 0; k < parts; ++k) {
    const auto& [own, vertices, ray] = certificate.parts[k];
    if (own >= pieces) reject(name("part", k) + " is of fragment " + std::to_string(own) + ", which there is not");
    const std::string what = names.emplace_back(name("part", k) + " (" + face_of(own) + ")");
    if (!canonical(vertices) || !canonical(ray))
      reject(what + " has a vertex or a ray that is not in canonical numbers", {own});
    if (cones[own].edge_on) reject(what + " is seen edge-on: the eye is in its plane", {own});
    if (const std::string fault = not_convex(vertices, planes[own]); !fault.empty()) reject(what + " " + fault, {own});
    const Cone cone(vertices, certificate.eye);
    for (const Integer_vector& corner : cone.rays)
      if (side(cones[own], corner) < 0) reject(what + " is not inside its piece", {own});
    const Integer_vector direction = primitive(ray);
    if (side(cone, direction) <= 0) reject(what + " does not have its ray strictly inside its cone", {own});
    rays.push_back(direction);
    cones.push_back(cone);
  }
  for (std::size_t k = 0; k < certificate.empty.size(); ++k)
    cones.push_back(cone_of(names.emplace_back(name("empty cone", k)), certificate.empty[k]));

  // 3. No ray meets a piece before its part. No piece is nearer than a part, or as far and preferred, and none is in an
  // empty cone.
  enum class Fault { meets_first, is_nearer, is_preferred, is_in };
  std::optional<std::tuple<bool, std::size_t, std::size_t, Fault>>
      first;  // of rays before others, then by tile, then by piece
  Pair_check pair;
  const auto compare = [&](std::size_t tile, std::size_t i) {
    const std::size_t k = tile - pieces;
    const auto found = [&](Fault fault) {
      const std::tuple here(fault != Fault::meets_first, k, i, fault);
      if (!first || here < *first) first = here;
    };
    const Cone &own = cones[tile], &piece = cones[i];
    if (k >= parts) {  // at distance 0: nearer than the piece wherever both are
      if (pair.nearer_somewhere(own, piece)) found(Fault::is_in);
      return;
    }
    if (side(piece, rays[k]) >= 0 &&
        piece.distance * dot(own.nearness, rays[k]) < own.distance * dot(piece.nearness, rays[k]))
      found(Fault::meets_first);
    if (pair.nearer_somewhere(piece, own)) found(Fault::is_nearer);
    const bool one_plane = piece.nearness == own.nearness && piece.distance == own.distance;
    if (one_plane && preference[i] < preference[certificate.parts[k].fragment] && !separates(piece, own) &&
        !separates(own, piece))
      found(Fault::is_preferred);
  };
  std::vector<std::size_t> places(cones.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  const auto middle = places.begin() + static_cast<std::ptrdiff_t>(pieces);
  Pairs(cones, compare).each({middle, places.end()}, {places.begin(), middle}, share_of(options, tiles));
  if (first) {
    const auto [later, k, i, fault] = *first;
    if (fault == Fault::is_in) reject(names[k] + " has " + face_of(i) + " in it", {i});
    const std::string what =
        fault == Fault::meets_first ? " is not what its ray meets first: " + face_of(i) + " is nearer"
        : fault == Fault::is_nearer ? " is behind " + face_of(i) + " somewhere"
                                    : " is as far as " + face_of(i) + " somewhere, which is preferred";
    reject(names[k] + what, {certificate.parts[k].fragment, i});
  }
  if (options.progress) options.progress(tiles, tiles);

  // 4. Parts and empty cones are the field.
  std::optional<Cone> field;
  if (!certificate.field.empty()) field = cone_of("the field", certificate.field);
  check_field(std::span(cones).subspan(pieces), names, field ? &*field : nullptr);
}

}  // namespace visible_check
}  // namespace sightline
namespace sightline {

Verdict verify_visible(const Polygon_soup& soup, const Visible_certificate& certificate,
                       const Verify_options& options) {
  return certificate_check::verdict_of([&] {
    visible_check::check(soup, certificate, options);
    const std::string counts = std::to_string(certificate.parts.size()) + " visible parts and " +
                               std::to_string(certificate.empty.size()) + " empty cones";
    return counts + " tile " + (certificate.field.empty() ? "all directions" : "the field") +
           ", every face counted or set aside for a true reason";
  });
}

}  // namespace sightline
