#include <sightline/harness/laws/weak_together.h>

#include <sightline/algorithms/verify/verdict.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/labels.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace weak_together {

/// A point strictly inside a convex polygon.
Exact_point point_inside(const generate::Points& corners, Random& random) {
  constexpr long most = 4;
  Exact_point sum;
  long weights = 0;
  for (const Exact_point& corner : corners) {
    const long weight = random.between(1, most);
    weights += weight;
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * corner[k];
  }
  for (Rational& x : sum) x /= weights;
  return sum;
}

/// Each piece as triangles around a point of its inside.
struct Fans {
  generate::Faces triangles;
  std::vector<Face_id> faces;  // that they are of

  Fans(const Scene& scene, Random& random) {
    for (const Piece& piece : scene.pieces()) {
      const generate::Points corners = scene.corner_points(piece);
      const Exact_point inside = point_inside(corners, random);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        triangles.push_back({inside, corners[i], corners[(i + 1) % corners.size()]});
        faces.push_back(piece.face);
      }
    }
  }
};

Outcome run(const Posed_scene& posed, const Answer& answer, Random& random) {
  constexpr std::size_t most_pieces = 12, most_cells = 1500;
  if (!random.chance(1, 4)) return Outcome::not_applicable();
  const Scene whole(posed.soup);
  if (whole.pieces().empty() || whole.pieces().size() > most_pieces) return Outcome::not_applicable();
  const Fans fans(whole, random);
  const Polygon_soup soup = generate::soup_of(fans.triangles);
  const Scene scene(soup);
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, posed.source)};
  Weak_options options;
  options.search.cells = most_cells;
  options.search.rays = random.chance(1, 2) ? 24 : 0;
  options.threads = static_cast<int>(1 + random.below(3));

  // 1. Together, and one by one.
  options.together_after = random.chance(1, 4) ? 1 + random.below(32) : 0;
  const Weakly_visible found = weakly_visible(occluders, sources, options);
  const Verdict verdict = verify_weak(soup, weak_certificate(scene, {posed.source}, false, found));
  if (!verdict.accepted) return Outcome::failed("the certificate of fans is rejected: " + verdict.why);
  const Weak_counters& counters = found.counters;
  if (counters.targets != scene.pieces().size()) return Outcome::failed("pairs of fans are not asked about once each");
  if (counters.together == 1 || counters.together > found.hidden.size() ||
      (counters.together > 0 && counters.polygons == 0))
    return Outcome::failed("what is hidden together is miscounted");
  options.together_after = {};
  options.search.rays = 24;
  const Weakly_visible one_by_one = weakly_visible(occluders, sources, options);
  if (one_by_one.counters.together + one_by_one.counters.polygons > 0)
    return Outcome::failed("triangles are hidden together though each is to be searched by itself");
  const auto labelled = [&](const Weakly_visible& seen) {
    Answer result;
    result.labels.assign(soup.face_count(), Answer::none);
    label_weakly_seen(seen, result);
    return result;
  };
  const Answer together = labelled(found);
  const Outcome outcome = compared(labelled(one_by_one), together, "one by one", "together");
  if (outcome.state == Outcome::State::failed) return outcome;

  // 2. A face is seen where one of its triangles is.
  constexpr std::uint32_t hidden = 0, visible = 1;
  std::vector<std::uint32_t> of_faces(answer.labels.size(), hidden);
  for (std::size_t t = 0; t < fans.faces.size(); ++t) {
    std::uint32_t& label = of_faces[fans.faces[t]];
    if (label != visible && together.labels[t] != hidden) label = together.labels[t];
  }
  for (std::size_t f = 0; f < of_faces.size(); ++f)
    if (const std::uint32_t label = answer.labels[f];
        label != Answer::none && of_faces[f] != Answer::none && of_faces[f] != label)
      return Outcome::failed(face_name(f) + " is " + (label == visible ? "visible" : "hidden") +
                             ", and its fan is not");
  return outcome.state == Outcome::State::undecided ? Outcome{} : outcome;
}

}  // namespace weak_together

Check together_check() {
  return {"together", "the same of fans of triangles, hidden together or one by one", weak_together::run};
}

}  // namespace sightline::harness
