#include <sightline/algorithms/verify/faces.h>

#include <algorithm>
#include <map>

namespace sightline::certificate_check {

Face::Face(const Polygon_soup& soup, Face_id f) {
  for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
    Polygon loop;
    for (const Point_id p : soup.loop(f, k))
      if (Exact_point point = soup.point(p); loop.empty() || point != loop.back()) loop.push_back(std::move(point));
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    loops.push_back(std::move(loop));
  }
  if (loops[0].empty()) return;
  plane = {newell_normal(loops[0]), loops[0][0]};
  has_front = !is_zero(plane.normal);
  if (!has_front) plane.normal = some_normal();
  const Homogeneous front = plane_of(plane);
  for (const Polygon& loop : loops)
    for (const Exact_point& p : loop) planar = planar && side(front, homogeneous(p)) == 0;
  if (!planar) return;
  for (std::size_t k = 1; k < loops.size(); ++k)
    if (sgn(dot(plane.normal, newell_normal(loops[k]))) > 0) std::reverse(loops[k].begin(), loops[k].end());
}

Integer_vector Face::some_normal() const {  // of the first three points that are not collinear
  std::vector<Exact_point> arms;
  for (const Polygon& loop : loops)
    for (const Exact_point& p : loop) {
      if (p == loops[0][0]) continue;
      arms.push_back(minus(p, loops[0][0]));
      const Integer_vector normal = primitive(cross(arms.front(), arms.back()));
      if (!is_zero(normal)) return normal;
    }
  return {};
}

std::size_t Boundary_chain::Hash::operator()(const Exact_point& p) const {
  std::size_t hash = 0;
  for (const Rational& x : p)
    for (const mpz_srcptr part : {x.get_num_mpz_t(), x.get_den_mpz_t()})
      for (std::size_t k = 0; k < mpz_size(part); ++k)
        hash = (hash ^ hash >> 29 ^ mpz_getlimbn(part, static_cast<mp_size_t>(k))) * 0x9e3779b97f4a7c15;
  return hash ^ hash >> 32;
}

std::size_t Boundary_chain::number_of(const Exact_point& p) {
  const auto [place, is_new] = numbers_.try_emplace(p, points_.size());
  if (is_new) points_.push_back(p);
  return place->second;
}

void Boundary_chain::add(const Polygon& loop, long multiplicity) {
  if (loop.empty()) return;
  std::size_t from = number_of(loop.back());
  for (const Exact_point& p : loop) {
    const std::size_t to = number_of(p);
    if (from < to) net_[{from, to}] += multiplicity;
    if (to < from) net_[{to, from}] -= multiplicity;
    from = to;
  }
}

std::optional<Exact_point> Boundary_chain::nonzero() const {
  // What is left between points is laid on lines, where parts of segments may cancel.
  std::map<std::pair<Integer_vector, std::size_t>, long> arrivals;
  std::unordered_map<std::size_t, Homogeneous> corners;
  const auto corner = [&](std::size_t i) -> const Homogeneous& {
    const auto [place, is_new] = corners.try_emplace(i);
    if (is_new) place->second = homogeneous(points_[i]);
    return place->second;
  };
  for (const auto& [ends, times] : net_) {
    if (times == 0) continue;
    const auto [from, to] = ends;
    Integer_vector direction = primitive(minus(corner(to), corner(from)));
    if (direction < Integer_vector{}) direction = negated(direction);
    arrivals[{direction, to}] += times;
    arrivals[{std::move(direction), from}] -= times;
  }
  const Exact_point* least = nullptr;  // so that what is said does not depend on numbers
  for (const auto& [place, count] : arrivals)
    if (count != 0 && (least == nullptr || points_[place.second] < *least)) least = &points_[place.second];
  return least == nullptr ? std::nullopt : std::optional(*least);
}

}  // namespace sightline::certificate_check
