#pragma once
// Why an answer is wrong, so that a person sees it: the line that refutes it, and how much of the view it concerns.

#include <sightline/harness/judge/grade.h>
#include <sightline/harness/judge/protocol.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <optional>
#include <string>

namespace sightline::judge {

/// A segment from the eye, from the source, or from a point in or outside a solid, to a face about which an answer is
/// wrong.
struct Refutation {
  Face_id face = 0;
  Exact_point from, to;
  std::optional<Face_id> by;         ///< the face that the segment meets first, where it shows that one is not seen
  std::optional<Exact_point> at;     ///< where it does
  std::string words;                 ///< one line: what the segment shows
  std::optional<Face_id> over = {};  ///< of an order: the face that is farther, and drawn over it
};

struct Explanation {
  std::optional<Refutation> refutation;  ///< none where no segment tells, as of parts in an order
  /// Of what is wrong: see, order: the solid angle as a share of all directions, 4 pi; weak: the area of wrong faces as
  /// a share of those that are answered for; trace: of the rays; boolean: of the points. In doubles from exact
  /// differences.
  double share = 0;
  std::string share_words;  ///< one line: what the share is of
};

/// Explains a grade. See: a face that is missing is seen along a line in the middle of the largest part of it that is
/// visible; one that is shown is hidden by what the line to a point of it meets. Order: a direction in which what is
/// drawn earlier is nearer. Weak: a sightline that verify_weak() accepts, or what stands on a line to a hidden face.
/// Trace: a ray, and what it meets. Boolean: a point, and the face beside it. Faces that the contract forbids to be
/// wrong come first. Pre: faces are planar, the grade is of an answer to the query, and wrong. `seconds`: for the
/// sightline of a weak query. Cost: that of the truth; of an order at most 10,000 of the wrong pairs are looked at.
/// Exact: yes, but for the share and words.
Explanation explain(const Polygon_soup& soup, const Query& query, const Answer& answer, const Grade& grade,
                    Contract contract, double seconds = 20);

}  // namespace sightline::judge
