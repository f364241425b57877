#include <sightline/algorithms/verify/planes_between.h>

#include <sightline/algorithms/verify/verdict.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace sightline::order_check {

using namespace certificate_check;

namespace {

/// For the side of the plane of b on which a ray of a meets the polygon of a, as side_to_plane(), exactly: the sign of
/// its product with the ray. It is met at t where nearness.d t = distance.
void find_height(Integer_vector& height, const Cone& a, const Cone& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    mpz_mul(height[k].get_mpz_t(), a.distance.get_mpz_t(), b.nearness[k].get_mpz_t());
    mpz_submul(height[k].get_mpz_t(), b.distance.get_mpz_t(), a.nearness[k].get_mpz_t());
  }
}

/// The plane as that of a cone; nothing where the eye is in front of it, or it is none.
std::optional<Cone> plane_as_cone(const std::array<Rational, 4>& plane, const Exact_point& eye) {
  if (!canonical(plane)) return std::nullopt;
  const Exact_point normal{plane[0], plane[1], plane[2]};
  // At eye + t d it is 0 where t (normal.d) = -(normal.eye + plane[3]).
  const Homogeneous form = homogeneous(normal);
  const Integer_vector direction{form[0], form[1], form[2]};
  Rational distance = -(dot(direction, eye) + plane[3] * form[3]);
  if (is_zero(direction) || sgn(distance) < 0) return std::nullopt;
  Cone cone;
  for (std::size_t k = 0; k < 3; ++k) cone.nearness[k] = direction[k] * distance.get_den();
  cone.distance = distance.get_num();
  return cone;
}

}  // namespace

Cut_places cut_places(const Order_certificate& certificate, const Workers& workers) {
  Cut_places places;
  const std::size_t count = certificate.fragments.size();
  if (certificate.cuts.depths.size() != count) return places;
  places.depths = certificate.cuts.depths;
  // Of those at one place the first of the least depth, which is cut by before any other, and then nothing is left to
  // be cut there: so there are no more planes than fragments, however many are said.
  std::vector<const Order_cuts::Cut*> said;
  for (const Order_cuts::Cut& cut : certificate.cuts.others)
    if (cut.place > 0 && cut.place < count) said.push_back(&cut);
  std::stable_sort(said.begin(), said.end(), [](const Order_cuts::Cut* a, const Order_cuts::Cut* b) {
    return std::tie(a->place, a->depth) < std::tie(b->place, b->depth);
  });
  for (const Order_cuts::Cut* cut : said) {
    if (!places.others.empty() && places.others.back().place == cut->place) continue;
    workers.ask();
    if (const std::optional<Cone> plane = plane_as_cone(cut->plane, certificate.eye))
      places.others.push_back({cut->place, cut->depth, *plane, Rounded_cone(*plane)});
  }
  return places;
}

Planes_between::Planes_between(const std::vector<Cone>& cones, const std::vector<Rounded_cone>& rounded,
                               const Workers& workers, Cut_places places)
    : cones_(cones), rounded_(rounded), places_(std::move(places)), paths_(cones.size()), settled_(cones.size(), 1) {
  constexpr std::size_t large = 4096;  // threads share its polygons; of smaller parts each has its own
  // Threads ask within small parts, too, which may be cut many times: never two at once, nonetheless.
  std::mutex of_asking;
  Workers all = workers, each = 1;
  if (workers.go_on)
    all.go_on = each.go_on = [&] {
      const std::lock_guard lock(of_asking);
      workers.go_on();
    };
  std::vector<Part> parts{{0, cones.size(), 0}}, small;
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    if (part.size() < large) small.push_back(part);
    else
      for (const Part& half : cut(part, all)) parts.push_back(half);
  }
  for_each_below(small.size(), 1, all, [&](std::size_t i) { cut_to_the_end(small[i], each); });
  // What is said may be of no use: then it does no harm, either.
  constexpr std::ptrdiff_t few = 64;
  const auto open = [](const std::vector<char>& settled) { return std::count(settled.begin(), settled.end(), 0); };
  if (places_.depths.empty() || open(settled_) <= few) return;
  of_samples_ = std::make_unique<Planes_between>(cones, rounded, workers);
  if (open(of_samples_->settled_) < open(settled_)) settled_ = of_samples_->settled_;
}

bool Planes_between::is_apart(std::size_t i, const Cut& cut) const {
  if (cones_[i].edge_on) return true;
  if (cut.plane->edge_on) return false;
  const int own_side = i < cut.place ? 1 : -1;
  // Where doubles can tell of no ray that it is on the wrong side, the others are asked exactly.
  const Rounded_height in_doubles(rounded_[i], *cut.in_doubles);
  bool is_known = true;
  for (const Rounded_vector& ray : rounded_[i].rays) {
    const std::optional<int> side = in_doubles.side(ray);
    if (!side) is_known = false;
    else if (*side == -own_side) return false;
  }
  if (is_known) return true;
  const Cone &own = cones_[i], &plane = *cut.plane;
  if (own.distance == plane.distance && own.nearness == plane.nearness) return true;  // in it
  thread_local Integer_vector height;
  find_height(height, own, plane);
  for (std::size_t ray = 0; ray < own.rays.size(); ++ray)
    if (!in_doubles.side(rounded_[i].rays[ray]) && sign_of_dot(height, own.rays[ray]) == -own_side) return false;
  return true;
}

Planes_between::Cut Planes_between::cut_by_depth(const Part& part) const {
  const std::size_t begin = part.begin, end = part.end;
  const std::span<const std::uint32_t> depths = places_.depths.subspan(begin, part.size());
  const auto least = std::min_element(depths.begin(), depths.end());
  // 1. By a plane that no polygon has.
  const auto is_before = [](const Cut_places::Cut& cut, std::size_t place) { return cut.place < place; };
  const auto from = std::lower_bound(places_.others.begin(), places_.others.end(), begin + 1, is_before),
             to = std::lower_bound(from, places_.others.end(), end, is_before);
  const auto other = std::min_element(from, to, [](const auto& a, const auto& b) { return a.depth < b.depth; });
  if (other != to && other->depth <= *least) return {other->place, &other->plane, &other->in_doubles};
  // 2. Before the first polygon of the least depth, or after those next to it, or, if that is all, between them.
  std::size_t place = begin + static_cast<std::size_t>(least - depths.begin());
  if (place > begin) return at_plane_of(place, place);
  while (place < end && places_.depths[place] == *least) ++place;
  return at_plane_of(begin, place < end ? place : begin + part.size() / 2);
}

Planes_between::Cut Planes_between::cut_by_samples(const Part& part) const {
  // Of a few polygons about the middle the one whose plane has most of a few others on their sides.
  constexpr std::size_t candidates = 5, samples = 24;
  const std::size_t begin = part.begin, size = part.size();
  std::size_t at = begin + size / 2, most = 0;
  for (std::size_t c = 0; c < candidates && size > candidates * samples; ++c) {
    const std::size_t candidate = begin + size / 4 + size / 2 * c / candidates;
    const Cut cut = at_plane_of(candidate, candidate);
    std::size_t count = 0;
    for (std::size_t s = 0; s < samples; ++s) count += is_apart(begin + size * s / samples, cut);
    if (count > most) {
      most = count;
      at = candidate;
    }
  }
  return at_plane_of(at, at);
}

std::vector<Planes_between::Part> Planes_between::cut(const Part& part, const Workers& workers) {
  constexpr std::size_t block = 512;
  const std::size_t begin = part.begin, end = part.end;
  const int depth = part.depth;
  const std::size_t size = part.size();
  if (size < 2) return {};
  // 1. Where it is cut, unless that would tell nothing any more.
  const bool has_bit = depth < deepest, has_depths = !places_.depths.empty();
  const auto of_part = settled_.begin() + static_cast<std::ptrdiff_t>(begin);
  const bool any_settled =
      std::find(of_part, of_part + static_cast<std::ptrdiff_t>(size), 1) != of_part + static_cast<std::ptrdiff_t>(size);
  if (!has_bit && (!has_depths || !any_settled || depth >= deepest_part(size))) {
    std::fill_n(of_part, size, 0);
    return {};
  }
  const Cut cut = has_depths ? cut_by_depth(part) : cut_by_samples(part);
  // 2. Who is on its side. A polygon in whose plane the cut is, is in it.
  const std::uint64_t bit = has_bit ? first >> depth : 0;
  for_each_below((size + block - 1) / block, 1, workers, [&](std::size_t k) {
    for (std::size_t i = begin + k * block; i < std::min(end, begin + (k + 1) * block); ++i) {
      if (i >= cut.place) paths_[i].turns |= bit;
      if (!has_bit && settled_[i] == 0) continue;
      if (is_apart(i, cut)) paths_[i].apart |= bit;
      else settled_[i] = 0;
    }
  });
  return {{begin, cut.place, depth + 1}, {cut.place, end, depth + 1}};
}

void Planes_between::cut_to_the_end(const Part& part, const Workers& worker) {
  constexpr std::size_t worth_asking = 512;
  for (const Part& half : cut(part, part.size() < worth_asking ? 1 : worker)) cut_to_the_end(half, worker);
}

}  // namespace sightline::order_check
