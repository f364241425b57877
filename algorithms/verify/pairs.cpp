// To be read after polygons.cpp, from top to bottom: how two cones lie to each other, then which one is nearer.

#include <sightline/algorithms/verify/pairs.h>

#include <sightline/kernel/number.h>

namespace sightline::order_check {

void Pair_check::Sides::find(const Cone& a, const Cone& b) {
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

}  // namespace sightline::order_check
