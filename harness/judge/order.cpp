#include <sightline/harness/judge/order.h>

#include <sightline/algorithms/verify/pairs.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/scene/exact_plane.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace sightline::judge {

Order_truth::Order_truth(const Scene& scene, const Exact_point& eye, bool two_sided)
    : eye_(eye), faces_(scene.counters().faces_read) {
  for (const Piece& piece : scene.pieces()) {
    Face& face = faces_[piece.face];
    if (face.pieces.empty()) face.set_plane(scene.file_coefficients(piece.support));
    const order_check::Polygon& polygon = face.pieces.emplace_back(scene.corner_points(piece));
    const int side = order_check::Plane{order_check::newell_normal(polygon), polygon[0]}.side(eye);
    face.required = side > 0 || (two_sided && side < 0);
  }
  for (Face& face : faces_)
    if (!face.pieces.empty()) face.measure();
  find_cycle();
}

Grade Order_truth::grade(const Answer& answer) const {
  Grade grade;
  std::set<Face_id> shown, hidden;
  grade.wrong_pairs = wrong_pairs(answer);
  for (const auto& [earlier, later] : grade.wrong_pairs) {
    hidden.insert(earlier);
    shown.insert(later);
  }
  judge_areas(answer, grade, shown, hidden);
  grade.wrong_visible.assign(shown.begin(), shown.end());
  grade.wrong_hidden.assign(hidden.begin(), hidden.end());
  return grade;
}

void Order_truth::Face::set_plane(const std::array<Rational, 4>& coefficients) {
  plane = coefficients;
  for (std::size_t k = 1; k < 3; ++k)
    if (abs(plane[axis]) < abs(plane[k])) axis = k;
}

void Order_truth::Face::measure() {
  order_check::Polygon corners;
  for (const order_check::Polygon& polygon : pieces) corners.insert(corners.end(), polygon.begin(), polygon.end());
  const std::array<Exact_point, 2> box = exact_box(corners);
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, Rational(box[1][k] - box[0][k]));
  for (const order_check::Polygon& polygon : pieces) area += flat(polygon).area();
}

Flat_polygon Order_truth::Face::flat(const std::vector<Exact_point>& points) const {
  std::vector<Flat_polygon::Point> corners;
  for (const Exact_point& p : points) corners.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3]});
  return Flat_polygon::hull(std::move(corners));
}

bool Order_truth::Face::leaves(const std::vector<Exact_point>& part) const {
  return std::any_of(part.begin(), part.end(), [&](const Exact_point& p) {
    const Rational height = (plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3]) / plane[axis];
    return Rational(abs(height) * (1 << tolerance_bits)) > size;
  });
}

order_check::Polygon Order_truth::Face::shrunk(const Flat_polygon& part) const {
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  order_check::Polygon points(part.lines().size());
  Flat_polygon::Point middle{0, 0};
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) middle[k] += part.vertex(i)[k] / static_cast<long>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Flat_polygon::Point at = part.vertex(i);
    points[i][x] = at[0] + (middle[0] - at[0]) / (1 << tolerance_bits);
    points[i][y] = at[1] + (middle[1] - at[1]) / (1 << tolerance_bits);
    points[i][axis] = -(plane[x] * points[i][x] + plane[y] * points[i][y] + plane[3]) / plane[axis];
  }
  return points;
}

template <class Take>
void Order_truth::each_pair(const std::vector<order_check::Cone>& cones, Take take) {
  std::vector<std::size_t> all(cones.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::vector<order_check::Rounded_cone> rounded = order_check::rounded(cones, 1);
  order_check::Pairs pairs(cones, rounded, std::move(take));
  pairs.each(all, all, 1);
}

void Order_truth::find_cycle() {
  std::vector<order_check::Cone> cones;
  std::vector<Face_id> owner;
  for (Face_id f = 0; f < faces_.size(); ++f)
    for (const order_check::Polygon& polygon : faces_[f].pieces)
      if (faces_[f].required) {
        cones.emplace_back(polygon, eye_);
        owner.push_back(f);
      }
  std::vector<std::set<Face_id>> over(faces_.size());  // what each must be drawn before
  order_check::Pair_check check;
  each_pair(cones, [&](std::size_t i, std::size_t j) {
    if (owner[i] != owner[j] && check.nearer_somewhere(cones[i], cones[j])) over[owner[j]].insert(owner[i]);
  });
  // Draw what nothing undrawn must come before; where nothing is left to draw but faces are, they are in cycles or
  // over such.
  std::vector<std::size_t> before(faces_.size());
  for (const auto& above : over)
    for (const Face_id f : above) ++before[f];
  std::vector<Face_id> ready;
  for (Face_id f = 0; f < faces_.size(); ++f)
    if (before[f] == 0) ready.push_back(f);
  std::size_t drawn = 0;
  for (; !ready.empty(); ++drawn) {
    const Face_id face = ready.back();
    ready.pop_back();
    for (const Face_id f : over[face])
      if (--before[f] == 0) ready.push_back(f);
  }
  has_cycle_ = drawn < faces_.size();
}

std::vector<std::array<Face_id, 2>> Order_truth::wrong_pairs(const Answer& answer) const {
  std::vector<order_check::Cone> cones;
  std::vector<std::size_t> place;  // in the order
  for (std::size_t i = 0; i < answer.order.size(); ++i) {
    const Drawn_face& drawn = answer.order[i];
    const Face& face = faces_[drawn.face];
    if (face.pieces.empty()) continue;
    if (drawn.part.empty()) {
      for (const order_check::Polygon& polygon : face.pieces) {
        cones.emplace_back(polygon, eye_);
        place.push_back(i);
      }
    } else if (const Flat_polygon part = face.flat(drawn.part);
               Rational(part.area() * (1 << tolerance_bits)) > face.area) {
      cones.emplace_back(face.shrunk(part), eye_);
      place.push_back(i);
    }
  }
  std::set<std::array<Face_id, 2>> wrong;
  order_check::Pair_check check;
  each_pair(cones, [&](std::size_t i, std::size_t j) {
    if (place[i] >= place[j] || !check.nearer_somewhere(cones[i], cones[j])) return;
    wrong.insert({answer.order[place[i]].face, answer.order[place[j]].face});
  });
  return {wrong.begin(), wrong.end()};
}

void Order_truth::judge_areas(const Answer& answer, Grade& grade, std::set<Face_id>& shown,
                              std::set<Face_id>& hidden) const {
  std::vector<std::vector<Flat_polygon>> parts(faces_.size());
  std::vector<bool> whole(faces_.size());
  for (const Drawn_face& drawn : answer.order) {
    const Face& face = faces_[drawn.face];
    if (drawn.part.empty()) {
      whole[drawn.face] = true;
    } else if (!face.pieces.empty()) {
      parts[drawn.face].push_back(face.flat(drawn.part));
      if (face.leaves(drawn.part)) shown.insert(drawn.face);
    }
  }
  for (Face_id f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    if (face.pieces.empty()) continue;
    if (face.required) ++grade.judged;
    if (whole[f]) continue;
    if (face.required && std::binary_search(answer.abstained.begin(), answer.abstained.end(), f)) {
      grade.abstained.push_back(f);
      continue;
    }
    std::vector<Flat_polygon> missing, outside = parts[f];
    for (const order_check::Polygon& polygon : face.pieces)
      outside = without(outside, missing.emplace_back(face.flat(polygon)));
    for (const Flat_polygon& part : parts[f]) missing = without(missing, part);
    const auto beyond_rounding = [&](const std::vector<Flat_polygon>& polygons) {
      Rational sum = 0;
      for (const Flat_polygon& polygon : polygons) sum += polygon.area();
      return Rational(sum * (1 << tolerance_bits)) > face.area;
    };
    if (face.required && beyond_rounding(missing)) hidden.insert(f);
    if (beyond_rounding(outside)) shown.insert(f);
  }
}

std::vector<Flat_polygon> Order_truth::without(const std::vector<Flat_polygon>& polygons, const Flat_polygon& other) {
  std::vector<Flat_polygon> rest;
  for (const Flat_polygon& polygon : polygons)
    for (Flat_polygon& left : polygon.without(other)) rest.push_back(std::move(left));
  return rest;
}

}  // namespace sightline::judge
