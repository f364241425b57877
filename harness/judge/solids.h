#pragma once
// What set operations on two solids are judged against: points about every face, volume and area.

#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/harness/judge/grade.h>
#include <sightline/harness/judge/protocol.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sightline::judge {

using generate::joined, generate::solids_of;

/// A point off the faces of both solids, and whether the result holds it.
struct Judged_point {
  Exact_point at, on;  ///< nothing is between it and this point of a face
  Face_id face = 0;
  bool inside = false;
};

struct Solid_truth {
  std::vector<Judged_point> points;
  Rational volume, volume_scale;  ///< of the exact result; what errors are a share of
  Rational unit = 1;              ///< of lengths, such that doubles hold the area in its squares
  double area = 0, area_scale = 0;
};

/// Why no answer can be right or wrong; empty: each solid is closed and winds once round its inside.
std::string flaw_of_solids(const Polygon_soup& soup, std::size_t first);

/// By set_operation(), whose certificate verify_solids() has accepted: of each convex fragment of the arrangement of
/// both solids' faces, 200 at most, two points on either side, half of the way to the next face and 2^-20 of it, so
/// that each cell has one; and sixteen anywhere about, by winding numbers alone. Errors are shares of the exact volume
/// and area, or, of an empty result, of the solids'. Pre: flaw_of_solids() is empty. Exact: yes, but for the area.
/// Errors: std::logic_error where the library contradicts itself.
Solid_truth solid_truth(const Polygon_soup& soup, const Query& query, int threads = 0);

/// What is wrong with an answer: points by the answer's own winding numbers, which are 1 in the result and 0 outside,
/// volume and area. Errors: std::invalid_argument where it is no closed surface: edges that none runs along the other
/// way, wherever these are cut, or faces that cross themselves. Exact: yes, but for the area.
Grade grade_solid(const Solid_truth& truth, const Answer& answer);

}  // namespace sightline::judge
