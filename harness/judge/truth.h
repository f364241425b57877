#pragma once
// The exact truth about a query, as the library computes it, and answers graded against it.

#include <sightline/harness/judge/grade.h>
#include <sightline/harness/judge/order.h>
#include <sightline/harness/judge/protocol.h>
#include <sightline/harness/judge/rays.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <memory>
#include <string>
#include <vector>

namespace sightline::judge {

/// What is known about the faces of a scene.
struct Truth {
  std::string not_asked;         ///< why no answer can be right or wrong; empty: the query can be asked
  std::vector<Face_id> visible;  ///< of see and weak; sorted
  std::vector<Face_id> hidden;
  std::shared_ptr<const Order_truth> order;
  std::vector<Ray_truth> rays;               ///< of trace
  std::shared_ptr<const Solid_truth> solid;  ///< of boolean
};

struct Truth_options {
  int threads = 0;      ///< 0: as many as there are processors; the same truth at any number, unless time runs out
  double seconds = 20;  ///< for weak; what is undecided then is not judged
  bool cycles = false;  ///< orders are asked for also where no order of whole faces is right
  bool excuse_touching = false;  ///< of trace: Ray_rule
};

/// A scene that programs can be asked about: faces that are not planar, or have holes, are replaced by the planar
/// convex pieces that the library cuts them into, at the same place in the list, on the same points. Where all are
/// planar and without holes, the soup itself. Post: what is asked means the same to everybody. Exact: yes.
Polygon_soup with_planar_faces(const Polygon_soup& soup);

/// Every coordinate rounded to the nearest double, so that a program that reads doubles has the scene exactly. Errors:
/// std::domain_error where one is beyond their range.
Exact_point rounded_to_doubles(const Exact_point& p);
Polygon_soup rounded_to_doubles(const Polygon_soup& soup);
/// A source that is not planar any more becomes its first triangle that has area.
Query rounded_to_doubles(Query query);

/// What is true of a query. Faces that are set aside (zero area, duplicates of earlier ones), and those that a search
/// leaves undecided, are neither visible nor hidden. Weak visibility is certified, and the certificate checked by
/// verify_weak(). Pre: faces are planar, with_planar_faces(). Degenerate: what visible_surface(), weakly_visible(),
/// Order_truth, ray_truths() and solid_truth() say. Cost: that of these, and of the check. Errors: std::logic_error
/// where the checker does not accept the library's own certificate. Exact: yes.
Truth truth_of(const Polygon_soup& soup, const Query& query, const Truth_options& options = {});

/// What is wrong with an answer. Pre: the query could be asked, and the answer is about its scene. Errors: those of
/// grade_solid(). Exact: yes.
Grade grade(const Truth& truth, const Answer& answer);

}  // namespace sightline::judge
