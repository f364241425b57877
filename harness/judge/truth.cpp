#include <sightline/harness/judge/truth.h>

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/verify/weak_lines.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/time_limit.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

namespace sightline::judge {

Polygon_soup with_planar_faces(const Polygon_soup& soup) {
  const Scene scene(soup);
  std::vector<bool> cut(soup.face_count());
  for (const Face_id face : scene.non_planar()) cut[face] = true;
  for (Face_id f = 0; f < soup.face_count(); ++f)
    if (soup.loop_count(f) > 1) cut[f] = true;
  if (std::find(cut.begin(), cut.end(), true) == cut.end()) return soup;

  Polygon_soup result;
  result.file = soup.file;
  result.coordinates = soup.coordinates;
  std::map<Exact_point, Point_id> first;
  for (Point_id p = 0; p < soup.point_count(); ++p) first.try_emplace(soup.point(p), p);
  std::vector<std::vector<const Piece*>> pieces(soup.face_count());
  for (const Piece& piece : scene.pieces()) pieces[piece.face].push_back(&piece);
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    if (!cut[f]) result.add_face(soup.loop(f));
    else
      for (const Piece* piece : pieces[f]) {
        std::vector<Point_id> corners;
        for (const Piece_corner& corner : scene.corners(*piece))
          corners.push_back(first.at(scene.position(corner.point)));
        result.add_face(corners);
      }
  }
  return result;
}

Exact_point rounded_to_doubles(const Exact_point& p) {
  return {exact(nearest_double(p[0])), exact(nearest_double(p[1])), exact(nearest_double(p[2]))};
}

Polygon_soup rounded_to_doubles(const Polygon_soup& soup) {
  Polygon_soup result = soup;
  result.coordinates = {};
  for (Point_id p = 0; p < soup.point_count(); ++p)
    for (const Rational& x : rounded_to_doubles(soup.point(p))) result.coordinates.push(x);
  return result;
}

Query rounded_to_doubles(Query query) {
  query.eye = rounded_to_doubles(query.eye);
  for (Exact_point& p : query.source) p = rounded_to_doubles(p);
  for (Exact_ray& ray : query.rays) ray = {rounded_to_doubles(ray.origin), rounded_to_doubles(ray.direction)};
  const certificate_check::Integer_vector normal = certificate_check::newell_normal(query.source);
  if (query.source.empty() || certificate_check::is_zero(normal)) return query;
  const certificate_check::Plane plane{normal, query.source[0]};
  if (std::all_of(query.source.begin(), query.source.end(), [&](const Exact_point& p) { return plane.side(p) == 0; }))
    return query;
  for (std::size_t k = 2; k < query.source.size(); ++k) {
    const std::vector<Exact_point> triangle{query.source[0], query.source[k - 1], query.source[k]};
    if (!certificate_check::is_zero(certificate_check::newell_normal(triangle))) {
      query.source = triangle;
      break;
    }
  }
  return query;
}

namespace truth_detail {

void find_seen(const Scene& scene, const Query& query, const Truth_options& options, Truth& truth) {
  const Piece_boxes boxes(scene);
  Visible_options visible;
  visible.threads = options.threads;
  const auto surface = visible_surface(Exact_view(scene, query.eye), boxes, visible);
  truth.visible = surface.visible;
  if (!query.two_sided) return;
  truth.visible.clear();
  std::set_union(surface.visible.begin(), surface.visible.end(), surface.from_behind.begin(), surface.from_behind.end(),
                 std::back_inserter(truth.visible));
}

void find_lit(const Polygon_soup& soup, const Scene& scene, const Query& query, const Truth_options& options,
              Truth& truth) {
  const Occluders occluders(scene);
  Weak_options weak;
  weak.threads = options.threads;
  weak.search.two_sided = query.two_sided;
  weak.search.out_of_time = [watch = Stopwatch(), &options] { return watch.seconds() > options.seconds; };
  std::vector<Weak_source> sources;
  try {
    sources.push_back(weak_source(occluders, query.source));
  } catch (const std::invalid_argument& error) {
    truth.not_asked = error.what();
    return;
  }
  Weakly_visible found = weakly_visible(occluders, sources, weak);
  if (const Verdict verdict = verify_weak(soup, weak_certificate(scene, {query.source}, query.two_sided, found));
      !verdict.accepted)
    throw std::logic_error("the library's own answer is not accepted by its checker: " + verdict.why +
                           "; please report it");
  if (found.visible.empty() && found.hidden.empty() && !found.undecided.empty())
    truth.not_asked = "nothing is decided within the budget";
  truth.visible = std::move(found.visible);
  truth.hidden = std::move(found.hidden);
}

void find_traced(const Polygon_soup& soup, const Scene& scene, const Query& query, const Truth_options& options,
                 Truth& truth) {
  if (query.rays.empty()) truth.not_asked = "there is no ray";
  for (const Exact_ray& ray : query.rays)
    if (ray.direction == Exact_point{0, 0, 0}) truth.not_asked = "a ray has no direction";
  if (!truth.not_asked.empty()) return;
  Ray_rule rule;
  rule.excuse_touching = options.excuse_touching;
  truth.rays = ray_truths(soup, scene, query.rays, rule);
}

}  // namespace truth_detail

Truth truth_of(const Polygon_soup& soup, const Query& query, const Truth_options& options) {
  Truth truth;
  const Scene scene(soup);
  if (scene.counters().faces == 0) truth.not_asked = "the scene has no faces";
  else if (scene.counters().self_intersecting > 0)
    truth.not_asked = "faces cross themselves, and bound nothing that all agree on";
  else if (scene.counters().no_simple_projection > 0)
    truth.not_asked = "faces with holes are simple in no projection, and bound nothing that all agree on";
  if (!truth.not_asked.empty()) return truth;
  switch (query.question) {
    case Question::order:
      truth.order = std::make_shared<const Order_truth>(scene, query.eye, query.two_sided);
      if (!options.cycles && !truth.order->whole_faces_do())
        truth.not_asked = "faces overlap in a cycle, so no order of whole faces is right";
      break;
    case Question::see: truth_detail::find_seen(scene, query, options, truth); break;
    case Question::weak: truth_detail::find_lit(soup, scene, query, options, truth); break;
    case Question::trace: truth_detail::find_traced(soup, scene, query, options, truth); break;
    case Question::boolean:
      truth.not_asked = flaw_of_solids(soup, query.first);
      if (truth.not_asked.empty())
        truth.solid = std::make_shared<const Solid_truth>(solid_truth(soup, query, options.threads));
      break;
  }
  if (query.question == Question::see)
    for (const Piece& piece : scene.pieces())
      if (piece.number == 0 && !std::binary_search(truth.visible.begin(), truth.visible.end(), piece.face))
        truth.hidden.push_back(piece.face);
  return truth;
}

Grade grade(const Truth& truth, const Answer& answer) {
  if (truth.order) return truth.order->grade(answer);
  if (!truth.rays.empty()) return grade_rays(truth.rays, answer);
  if (truth.solid) return grade_solid(*truth.solid, answer);
  Grade grade;
  grade.judged = truth.visible.size() + truth.hidden.size();
  const auto judge = [&](const std::vector<Face_id>& faces, bool visible, std::vector<Face_id>& wrong) {
    for (const Face_id face : faces) {
      if (std::binary_search(answer.abstained.begin(), answer.abstained.end(), face)) grade.abstained.push_back(face);
      else if (std::binary_search(answer.visible.begin(), answer.visible.end(), face) != visible) wrong.push_back(face);
    }
  };
  judge(truth.visible, true, grade.wrong_hidden);
  judge(truth.hidden, false, grade.wrong_visible);
  std::sort(grade.abstained.begin(), grade.abstained.end());
  return grade;
}

}  // namespace sightline::judge
