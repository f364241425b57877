// To be read after covering.cpp and pairs.h, from top to bottom.

#include <sightline/algorithms/verify/order.h>

#include <sightline/algorithms/verify/numbered_points.h>
#include <sightline/algorithms/verify/pairs.h>
#include <sightline/algorithms/verify/planes_between.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/rounded_cones.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sightline {
namespace order_check {
namespace {

/// The first pair (earlier, later), by the later one's place and then the earlier one's, where the earlier one is
/// nearer somewhere.
std::optional<std::pair<std::size_t, std::size_t>> first_misordered(const std::vector<Cone>& cones, Cut_places places,
                                                                    const Verify_options& options) {
  const Workers workers(options, cones.size());
  const std::vector<Rounded_cone> in_doubles = rounded(cones, workers);
  const Planes_between planes(cones, in_doubles, workers, std::move(places));
  std::optional<std::pair<std::size_t, std::size_t>> first;  // (later, earlier)
  std::mutex mutex;
  Pairs pairs(cones, in_doubles, [&](std::size_t one, std::size_t other) {
    thread_local Pair_check check;
    const auto [earlier, later] = std::minmax({one, other});
    if (planes.in_order(earlier, later) || nowhere_nearer(in_doubles[earlier], in_doubles[later])) return;
    if (!check.nearer_somewhere(cones[earlier], in_doubles[earlier], cones[later], in_doubles[later])) return;
    const std::lock_guard lock(mutex);
    if (const std::pair here(later, earlier); !first || here < *first) first = here;
  });
  // Pairs of settled cones are in order. Of the time, planes are half of what they settle.
  std::vector<std::size_t> open, settled;
  for (std::size_t i = 0; i < cones.size(); ++i) (planes.is_settled(i) ? settled : open).push_back(i);
  const std::function<void(double)> progress = share_of(options, cones.size());
  const double begin =
      cones.empty() ? 0 : 0.5 * static_cast<double>(settled.size()) / static_cast<double>(cones.size());
  const auto from_to = [&](double from, double to) -> std::function<void(double)> {
    if (!progress) return {};
    return [&progress, from, to](double share) { progress(from + share * (to - from)); };
  };
  if (progress) progress(begin);
  const double middle = settled.empty() ? 1 : (1 + begin) / 2;
  pairs.each(open, workers, from_to(begin, middle));
  if (!open.empty() && !settled.empty()) pairs.each(open, settled, workers, from_to(middle, 1));
  if (first) std::swap(first->first, first->second);
  return first;
}

/// The cones of polygons; what many have is found once for each corner.
std::vector<Cone> cones_of(const Numbered_polygons& polygons, std::size_t count, const Exact_point& at,
                           const Workers& workers) {
  const Homogeneous eye = homogeneous(at);
  std::vector<Homogeneous> points(polygons.points().size());
  std::vector<Integer_vector> rays(points.size());
  for_each_below(points.size(), 1000, workers, [&](std::size_t i) {
    points[i] = homogeneous(polygons.points()[static_cast<Numbered_points::Number>(i)]);
    rays[i] = ray_to(points[i], eye);
  });
  std::vector<Cone> cones(count);
  for_each_below(count, 100, workers, [&](std::size_t i) {
    cones[i] = Cone(each_of(points, polygons[i]), each_of(rays, polygons[i]), eye);
  });
  return cones;
}

/// The certificate, step by step; throws a Rejection. Returns what was shown, in one line.
std::string check(const Polygon_soup& soup, const Order_certificate& certificate, const Verify_options& options) {
  // 1. The eye is a point, and the fragments are the scene.
  if (!canonical(certificate.eye)) reject("the eye is not a point in canonical numbers");
  const Workers workers(options, certificate.fragments.size());
  Numbered_polygons corners;
  const Covered covered =
      check_covering(soup, certificate, workers, certificate.on_view ? &certificate.eye : nullptr, {}, &corners);

  // 2. No fragment is nearer than one that is drawn after it.
  const std::vector<Cone> cones = cones_of(corners, certificate.fragments.size(), certificate.eye, workers);
  const auto pair = first_misordered(cones, cut_places(certificate, workers), options);
  if (pair) {
    const auto [earlier, later] = *pair;
    const auto full_name = [&](std::size_t i) {
      return name("fragment", i) + " (" + name("face", certificate.fragments[i].face) + ")";
    };
    reject(full_name(earlier) + " is drawn before " + full_name(later) + " but is nearer somewhere in their overlap",
           {earlier, later});
  }
  if (options.progress) options.progress(cones.size(), cones.size());
  return std::to_string(cones.size()) + " fragments in back-to-front order from " + exact_name(certificate.eye) +
         ", every " + (certificate.on_view ? "on-view " : "") + "face drawn once or set aside for a true reason; " +
         covered.text();
}

}  // namespace
}  // namespace order_check

Verdict verify_order(const Polygon_soup& soup, const Order_certificate& certificate, const Verify_options& options) {
  return certificate_check::verdict_of([&] { return order_check::check(soup, certificate, options); });
}

}  // namespace sightline
