#pragma once
// What is said of an answer, and what a program may promise.

#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace sightline::judge {

/// A ray about which an answer is wrong: the face that is named, or none, and what would be right.
struct Wrong_ray {
  std::size_t ray = 0;
  std::optional<Face_id> said;
  std::vector<Face_id> right;
  bool nothing = false;  ///< that it meets nothing would be right
};

/// A point that a solid holds and ought not, or the other way round.
struct Wrong_point {
  Exact_point at, on;          ///< the point, and one of a face beside it
  Face_id face = 0;            ///< that face
  bool inside = false;         ///< whether it is in the exact result
  std::optional<int> winding;  ///< how often the answer winds round it; none: a face of the answer holds it

  /// Whether the answer has more there than the result, not less.
  bool is_held() const { return winding ? *winding > (inside ? 1 : 0) : !inside; }
};

/// What is wrong with an answer. Lists are sorted. Faces that nothing is known about, or that are no faces (of zero
/// area, doubles of others), are in none of them.
struct Grade {
  std::vector<Face_id> wrong_visible;  ///< shown although hidden; in an order: painted over a face that is nearer
                                       ///< there, or outside of itself; of rays: named although not met first;
                                       ///< of solids: beside a point that is held although outside
  std::vector<Face_id> wrong_hidden;   ///< hidden although visible; in an order: painted over by a face that is farther
                                       ///< there, or missing, or in part; of rays: met first but not named; of
                                       ///< solids: beside a point that is inside but not held
  std::vector<Face_id> abstained;      ///< no answer; of rays and points: their numbers
  std::vector<std::array<Face_id, 2>>
      wrong_pairs;                    ///< of an order: drawn earlier but nearer somewhere, and what is drawn over it
  std::vector<Wrong_ray> wrong_rays;  ///< of rays
  std::vector<Wrong_point> wrong_points;    ///< of solids
  double volume_error = 0, area_error = 0;  ///< of solids: by how much too large, as shares of the exact ones
  std::size_t judged = 0;                   ///< faces about which something is known, or rays, or points

  bool too_large() const { return volume_error > largest_error; }
  bool too_small() const { return volume_error < -largest_error; }
  bool wrong() const {
    return !wrong_visible.empty() || !wrong_hidden.empty() || too_large() || too_small() ||
           std::fabs(area_error) > largest_error;
  }

  static constexpr double largest_error = 0x1p-20;  ///< of volumes and areas: what is rounded is right
};

/// What a program promises: no wrong faces; never to hide a visible one; never to show a hidden one. Of solids: the
/// result; never less than it; never more. Abstaining breaks none of them.
enum class Contract { exact, conservative, aggressive };
inline constexpr std::array<std::string_view, 3> contract_names{"exact", "conservative", "aggressive"};

bool keeps(Contract contract, const Grade& grade);

/// What became of a case, the worst first. An answer is `wrong` where any face is, `abstained` where none is but some
/// are left open.
enum class Mark { crashed, invalid, wrong, out_of_memory, timed_out, abstained, right };
inline constexpr std::array<std::string_view, 7> mark_names{"crashed",   "invalid",   "wrong", "out of memory",
                                                            "timed out", "abstained", "right"};

inline Mark mark_of(const Grade& grade) {
  return grade.wrong() ? Mark::wrong : grade.abstained.empty() ? Mark::right : Mark::abstained;
}

/// Whether a case breaks the contract: by a wrong face that it forbids, by an answer outside of the protocol, or by a
/// crash. To run out of time or memory breaks nothing: the judge sets the limits.
bool breaks(Contract contract, Mark mark, const Grade& grade);

}  // namespace sightline::judge
