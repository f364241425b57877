#include <sightline/algorithms/verify/order.h>

#include <sightline/kernel/number.h>

#include <numeric>
#include <string>

namespace sightline {
namespace order_check {

void Sides::find(const Cone& a, const Cone& b) {
  inside.assign(b.rays.size(), 1);
  crossings.clear();
  for (std::size_t i = 0; i < a.edge_planes.size(); ++i) {
    const int first = sign_of_dot(a.edge_planes[i], b.rays[0]);
    int side = first;
    for (std::size_t j = 0; j < b.rays.size(); ++j) {
      if (side < 0) inside[j] = 0;
      const int next = j + 1 < b.rays.size() ? sign_of_dot(a.edge_planes[i], b.rays[j + 1]) : first;
      if (side * next < 0) crossings.push_back({i, j});
      side = next;
    }
  }
}

bool Pair_check::nearer_somewhere(const Cone& a, const Cone& b) {
  if (a.nearness == b.nearness && a.distance == b.distance) return false;  // one plane: equally far everywhere
  if (separates(a, b) || separates(b, a)) return false;
  a_sides_.find(a, b);
  b_sides_.find(b, a);

  // Directions that span the common part of the cones: rays of one in the other, and where two edges cross.
  common_.clear();
  for (std::size_t i = 0; i < a.rays.size(); ++i)
    if (b_sides_.inside[i]) common_.push_back(a.rays[i]);
  for (std::size_t j = 0; j < b.rays.size(); ++j)
    if (a_sides_.inside[j]) common_.push_back(b.rays[j]);
  for (const auto& [i, j] : a_sides_.crossings) {
    const Integer_vector &from = a.rays[i], &to = a.rays[(i + 1) % a.rays.size()];
    const Integer side_of_from = dot(b.edge_planes[j], from), side_of_to = dot(b.edge_planes[j], to);
    if (sgn(side_of_from) * sgn(side_of_to) >= 0) continue;
    Integer_vector d;  // on b's edge plane j, between the two rays of a
    for (std::size_t k = 0; k < 3; ++k) d[k] = abs(side_of_to) * from[k] + abs(side_of_from) * to[k];
    if (sign_of_dot(b.nearness, d) > 0) common_.push_back(primitive(d));  // otherwise -d is in b's cone, not d
  }

  // Has the common part an inside? Then the sum of what spans it is strictly inside a's edge planes.
  Integer_vector middle;
  for (const Integer_vector& d : common_)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += d[k];
  for (const Integer_vector& plane : a.edge_planes)
    if (sign_of_dot(plane, middle) <= 0) return false;

  // 1/t of b minus 1/t of a is linear in the direction: a may nowhere be the nearer one.
  Integer_vector farther;
  for (std::size_t k = 0; k < 3; ++k) farther[k] = a.distance * b.nearness[k] - b.distance * a.nearness[k];
  for (const Integer_vector& d : common_)
    if (sign_of_dot(farther, d) < 0) return true;
  return false;
}

std::function<void(double)> share_of(const Verify_options& options, std::size_t total) {
  if (!options.progress) return {};
  return [&options, total](double share) {
    options.progress(static_cast<std::size_t>(share * static_cast<double>(total)), total);
  };
}

std::optional<std::pair<std::size_t, std::size_t>> first_misordered(const std::vector<Cone>& cones,
                                                                    const Verify_options& options) {
  Pair_check check;
  std::optional<std::pair<std::size_t, std::size_t>> first;  // (later, earlier)
  Pairs pairs(cones, [&](std::size_t earlier, std::size_t later) {
    if (earlier < later && (!first || std::pair(later, earlier) < *first) &&
        check.nearer_somewhere(cones[earlier], cones[later]))
      first = std::pair(later, earlier);
  });
  std::vector<std::size_t> all(cones.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  pairs.each(all, all, share_of(options, cones.size()));
  if (first) std::swap(first->first, first->second);
  return first;
}

void check(const Polygon_soup& soup, const Order_certificate& certificate, const Verify_options& options) {
  // 1. The eye is a point, and the fragments are the scene.
  if (!canonical(certificate.eye)) reject("the eye is not a point in canonical numbers");
  check_covering(soup, certificate, certificate.on_view ? &certificate.eye : nullptr);

  // 2. No fragment is nearer than one that is drawn after it.
  std::vector<Cone> cones;
  for (const Order_fragment& fragment : certificate.fragments) cones.emplace_back(fragment.vertices, certificate.eye);
  const auto pair = first_misordered(cones, options);
  if (pair) {
    const auto [earlier, later] = *pair;
    const auto full_name = [&](std::size_t i) {
      return name("fragment", i) + " (" + name("face", certificate.fragments[i].face) + ")";
    };
    reject(full_name(earlier) + " is drawn before " + full_name(later) + " but is nearer somewhere in their overlap",
           {earlier, later});
  }
  if (options.progress) options.progress(cones.size(), cones.size());
}

}  // namespace order_check
}  // namespace sightline
namespace sightline {

Verdict verify_order(const Polygon_soup& soup, const Order_certificate& certificate, const Verify_options& options) {
  return certificate_check::verdict_of([&] {
    order_check::check(soup, certificate, options);
    return std::to_string(certificate.fragments.size()) + " fragments in back-to-front order, every " +
           (certificate.on_view ? "on-view " : "") + "face drawn once or set aside for a true reason";
  });
}

}  // namespace sightline
