#include <sightline/harness/judge/rays.h>

#include <sightline/algorithms/rays/tracer.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/rays.h>
#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

namespace sightline::judge {
namespace {

bool is_on_segment(const Exact_point& x, const Exact_point& p, const Exact_point& q) {
  const Exact_point along = minus(q, p), to = minus(x, p);
  const Exact_point off = cross(along, to);
  if (off[0] != 0 || off[1] != 0 || off[2] != 0) return false;
  const Rational share = dot(along, to);
  return share >= 0 && share <= dot(along, along);
}

/// Hits of one t at a time, until take() says that it has enough.
template <class Take>
void each_depth(const std::vector<Face_hit>& hits, Take take) {
  for (std::size_t begin = 0, end = 0; begin < hits.size(); begin = end) {
    while (end < hits.size() && hits[end].t == hits[begin].t) ++end;
    if (!take(begin, end)) return;
  }
}

Exact_point weighted(const std::array<Exact_point, 3>& corners, const std::array<long, 3>& weights) {
  const long sum = weights[0] + weights[1] + weights[2];
  Exact_point p{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) p[k] += corners[i][k] * weights[i] / sum;
  return p;
}

}  // namespace

bool touches(const Polygon_soup& soup, const Exact_ray& ray, const Face_hit& hit) {
  if (hit.side == Met_side::along) return true;
  const Exact_point at = point_at(ray, hit.t);
  for (std::size_t l = 0; l < soup.loop_count(hit.face); ++l) {
    const auto loop = soup.loop(hit.face, l);
    for (std::size_t i = 0; i < loop.size(); ++i)
      if (is_on_segment(at, soup.point(loop[i]), soup.point(loop[(i + 1) % loop.size()]))) return true;
  }
  return false;
}

std::vector<Ray_truth> ray_truths(const Polygon_soup& soup, const Scene& scene, const std::vector<Exact_ray>& rays,
                                  const Ray_rule& rule) {
  const Ray_tracer tracer(scene);
  Ray_counters counters;
  std::vector<std::array<Face_id, 2>> repetitions;  // set aside, and what it repeats
  for (const Set_aside& entry : scene.set_aside())
    if (const std::optional<Face_id> kept = face_repeated_by(entry)) repetitions.push_back({entry.face, *kept});
  std::vector<Ray_truth> truths;
  for (const Exact_ray& ray : rays) {
    // 1. What counts, by depth.
    std::vector<Face_hit> hits = tracer.all(ray, rule.start, counters);
    if (rule.fronts_only) std::erase_if(hits, [](const Face_hit& hit) { return hit.side != Met_side::front; });
    // 2. The first depth, or the last; and where touching is excused, those up to the first that does more.
    Ray_truth& truth = truths.emplace_back();
    truth.nothing = true;
    each_depth(hits, [&](std::size_t begin, std::size_t end) {
      if (rule.farthest) truth.right.clear();
      bool does_more = !rule.excuse_touching;
      for (std::size_t i = begin; i < end; ++i) {
        truth.right.push_back(hits[i].face);
        does_more = does_more || !touches(soup, ray, hits[i]);
      }
      truth.nothing = truth.nothing && !does_more;
      return rule.farthest || !does_more;
    });
    // 3. Repetitions of these faces are as right.
    const std::vector<Face_id> met = truth.right;
    for (const auto& [face, kept] : repetitions)
      if (std::find(met.begin(), met.end(), kept) != met.end()) truth.right.push_back(face);
    std::sort(truth.right.begin(), truth.right.end());
    truth.right.erase(std::unique(truth.right.begin(), truth.right.end()), truth.right.end());
  }
  return truths;
}

Grade grade_rays(const std::vector<Ray_truth>& truths, const Answer& answer) {
  Grade grade;
  grade.judged = truths.size();
  grade.abstained = answer.abstained;
  std::set<Face_id> shown, hidden;
  for (std::size_t ray = 0; ray < truths.size(); ++ray) {
    if (std::binary_search(answer.abstained.begin(), answer.abstained.end(), ray)) continue;
    const Ray_truth& truth = truths[ray];
    const std::optional<Face_id> said = answer.first.at(ray);
    if (said ? std::binary_search(truth.right.begin(), truth.right.end(), *said) : truth.nothing) continue;
    grade.wrong_rays.push_back({ray, said, truth.right, truth.nothing});
    if (said) shown.insert(*said);
    if (!truth.nothing) hidden.insert(truth.right.front());
  }
  grade.wrong_visible.assign(shown.begin(), shown.end());
  grade.wrong_hidden.assign(hidden.begin(), hidden.end());
  return grade;
}

std::vector<Exact_ray> rays_about(const Polygon_soup& soup, const Exact_point& eye, std::uint64_t seed) {
  constexpr std::size_t each = 3;
  std::vector<Exact_ray> rays;
  if (soup.face_count() == 0) return rays;
  generate::Random random(seed);
  const auto from_eye = [&](const std::array<long, 3>& weights) {
    const auto loop = soup.loop(static_cast<Face_id>(random.below(soup.face_count())));
    if (loop.size() < 3) return;
    const std::size_t first = random.below(loop.size());
    std::array<Exact_point, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = soup.point(loop[(first + i) % loop.size()]);
    const Exact_point to = weighted(corners, weights);
    if (eye != to) rays.push_back({eye, minus(to, eye)});
  };
  for (std::size_t k = 0; k < each; ++k) {
    from_eye({2, 1, 1});
    from_eye({1, 0, 0});
    from_eye({1, 1, 0});
    for (const generate::Ray_kind& kind : generate::ray_kinds()) rays.push_back(kind.make(soup, random));
  }
  return rays;
}

}  // namespace sightline::judge
