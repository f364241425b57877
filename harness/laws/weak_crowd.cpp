#include <sightline/harness/laws/weak_crowd.h>

#include <sightline/algorithms/verify/verdict.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/labels.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace sightline::harness {

namespace weak_crowd {

using generate::Points;

/// A mean of a polygon's corners, of few bits.
Exact_point any_point_in(const Points& corners, Random& random) {
  constexpr long whole = 64;
  Exact_point p = corners[0];
  for (std::size_t k = 1; k < corners.size(); ++k)
    p = generate::along(p, generate::ratio(random.between(0, whole), whole), minus(corners[k], p));
  return p;
}

/// Small triangles on segments from the source to the faces' corners, as many as searches look for in a tree of boxes.
void add_crowd(Posed_scene& posed, std::size_t triangles, Random& random) {
  constexpr long fine = 32;
  Points corners;
  for (Point_id p = 0; p < posed.soup.point_count(); ++p) corners.push_back(posed.soup.point(p));
  const long small = random.between(20, 400);
  for (std::size_t n = 0; n < triangles; ++n) {
    const Exact_point from = any_point_in(posed.source, random),
                      way = minus(corners[random.below(corners.size())], from),
                      at = generate::along(from, generate::ratio(random.between(1, fine - 1), fine), way);
    const Rational reach = std::max({Rational(abs(way[0])), Rational(abs(way[1])), Rational(abs(way[2]))}) / small;
    std::vector<Point_id> loop;
    for (int k = 0; k < 3; ++k) {
      const Exact_point p = generate::along(at, reach / 4, generate::lattice(random, 4));
      loop.push_back(posed.soup.add_point(p[0], p[1], p[2]));
    }
    posed.soup.add_face(loop);
  }
}

Outcome run(const Posed_scene& posed, const Answer& answer, Random& random) {
  constexpr std::size_t most_faces = 10, most_cells = 40;
  constexpr int most_bits = 64;
  if (!random.chance(1, 40)) return Outcome::not_applicable();
  const std::size_t faces = posed.soup.face_count();
  if (faces == 0 || faces > most_faces || Scene(posed.soup).bits() > most_bits) return Outcome::not_applicable();
  Posed_scene crowded = posed;
  add_crowd(crowded, 1 + random.below(2400), random);
  const Scene scene(crowded.soup);
  const Occluders occluders(scene);
  Weak_options options;
  options.threads = 1;
  options.search.cells = 1 + random.below(most_cells);
  options.search.rays = random.chance(1, 2) ? 0 : 24;
  options.search.thorough = random.chance(1, 3);
  for (Face_id face = 0; face < faces; ++face)
    if (answer.labels[face] != Answer::none) options.faces.push_back(face);
  if (options.faces.empty()) return Outcome::not_applicable();
  Weakly_visible found = weakly_visible(occluders, {weak_source(occluders, posed.source)}, options);
  for (const Face_id face : found.visible)
    if (face < faces && answer.labels[face] == 0)
      return Outcome::failed(face_name(face) + " is hidden, but visible among a crowd");
  for (const Piece& piece : scene.pieces())
    if (!std::binary_search(options.faces.begin(), options.faces.end(), piece.face) &&
        (found.undecided.empty() || found.undecided.back() != piece.face))
      found.undecided.push_back(piece.face);
  std::sort(found.undecided.begin(), found.undecided.end());
  const Verdict verdict = verify_weak(crowded.soup, weak_certificate(scene, {posed.source}, false, found));
  return verdict.accepted ? Outcome{} : Outcome::failed("the certificate among a crowd is rejected: " + verdict.why);
}

}  // namespace weak_crowd

Check crowd_check() {
  return {"crowd", "what is hidden is hidden among a thousand small triangles, and proved", weak_crowd::run};
}

}  // namespace sightline::harness
