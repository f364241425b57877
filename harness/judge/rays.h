#pragma once
// What rays are judged against: the faces that each may be said to meet first.

#include <sightline/algorithms/rays/ray.h>
#include <sightline/harness/judge/grade.h>
#include <sightline/harness/judge/protocol.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <cstdint>
#include <vector>

namespace sightline::judge {

/// What may be said of a ray.
struct Ray_truth {
  std::vector<Face_id> right;  ///< faces, any of which is right; sorted
  bool nothing = false;        ///< that it meets nothing is right
};

/// Which hits count. As it stands: the law.
struct Ray_rule {
  Ray_start start = Ray_start::open;
  bool excuse_touching = false;  ///< a face that is met on its border or along may be named or passed over
  bool fronts_only = false;      ///< faces are met from the front only
  bool farthest = false;         ///< the last hit, not the first
};

/// Of each ray the faces of the least t, by Ray_tracer, and the repetitions of them that the scene sets aside. Pre:
/// `scene` is of the soup, directions are not zero. Degenerate: faces are closed: through an edge or a corner all faces
/// are met that hold the point, and a ray in a face's plane meets it where it comes to it; a part of a face that holds
/// the origin is passed over. Excused, whatever touches before the first hit that does more is right, too, and so is
/// nothing where none does more. Exact: yes.
std::vector<Ray_truth> ray_truths(const Polygon_soup& soup, const Scene& scene, const std::vector<Exact_ray>& rays,
                                  const Ray_rule& rule = {});

/// What is wrong with an answer. Pre: it is about as many rays.
Grade grade_rays(const std::vector<Ray_truth>& truths, const Answer& answer);

/// Whether a hit is no more than contact: along the face, or at a point of its border. Exact: yes.
bool touches(const Polygon_soup& soup, const Exact_ray& ray, const Face_hit& hit);

/// Rays about a scene, 27 at most: from the eye into faces, to corners and to middles of edges, and three of each of
/// generate::ray_kinds(). The same arguments give the same rays; none for a scene without faces.
std::vector<Exact_ray> rays_about(const Polygon_soup& soup, const Exact_point& eye, std::uint64_t seed);

}  // namespace sightline::judge
