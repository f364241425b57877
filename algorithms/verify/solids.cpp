// To be read after covering.cpp: the fragments on a grid of ranks, then the check, step by step.

#include <sightline/algorithms/verify/solids.h>

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/faces.h>
#include <sightline/algorithms/verify/parallel.h>
#include <sightline/algorithms/verify/polygons.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace sightline::certificate_check {
namespace {

/// A fragment, made ready: its corners, its plane, and the planes of its edges, which have its inside in front.
struct Solid_face {
  std::vector<Homogeneous> corners;
  Homogeneous plane;
  std::array<std::uint32_t, 3> low, high;  // ranks of its coordinates
};

/// Fragments by squares of a grid over ranks of their first two coordinates: whole numbers from here on.
class Rank_grid {
 public:
  explicit Rank_grid(const std::vector<Solid_certificate::Fragment>& fragments, std::vector<Solid_face>& faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const auto& fragment : fragments)
        for (const Exact_point& p : fragment.vertices) values_[k].push_back(p[k]);
      std::sort(values_[k].begin(), values_[k].end());
      values_[k].erase(std::unique(values_[k].begin(), values_[k].end()), values_[k].end());
    }
    while (side_ * side_ < fragments.size()) ++side_;
    squares_.resize(side_ * side_);
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] =
            std::minmax_element(fragments[i].vertices.begin(), fragments[i].vertices.end(),
                                [&](const Exact_point& p, const Exact_point& q) { return p[k] < q[k]; });
        faces[i].low[k] = rank((*low)[k], k);
        faces[i].high[k] = rank((*high)[k], k);
      }
      for (std::size_t x = square(faces[i].low[0], 0); x <= square(faces[i].high[0], 0); ++x)
        for (std::size_t y = square(faces[i].low[1], 1); y <= square(faces[i].high[1], 1); ++y)
          squares_[x * side_ + y].push_back(static_cast<std::uint32_t>(i));
    }
  }
  /// The number of values below x.
  std::uint32_t rank(const Rational& x, std::size_t k) const {
    return static_cast<std::uint32_t>(std::lower_bound(values_[k].begin(), values_[k].end(), x) - values_[k].begin());
  }
  std::size_t side() const { return side_; }
  std::size_t square(std::uint32_t rank, std::size_t k) const {
    return std::min(side_ - 1, rank * side_ / std::max<std::size_t>(1, values_[k].size()));
  }
  const std::vector<std::uint32_t>& at(std::size_t x, std::size_t y) const { return squares_[x * side_ + y]; }

 private:
  std::array<std::vector<Rational>, 3> values_;
  std::size_t side_ = 1;
  std::vector<std::vector<std::uint32_t>> squares_;
};

bool boxes_meet(const Solid_face& a, const Solid_face& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.high[k] < b.low[k] || b.high[k] < a.low[k]) return false;
  return true;
}

/// The turn from p over q to r as seen against an axis.
int turn_along(const Homogeneous& p, const Homogeneous& q, const Homogeneous& r, std::size_t axis) {
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  return sgn(Integer(p[x] * (q[y] * r[3] - r[y] * q[3]) - p[y] * (q[x] * r[3] - r[x] * q[3]) +
                     p[3] * (q[x] * r[y] - r[x] * q[y])));
}

std::size_t axis_of(const Homogeneous& plane) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (mpz_cmpabs(plane[k].get_mpz_t(), plane[axis].get_mpz_t()) > 0) axis = k;
  return axis;
}

/// Whether a point in the face's plane is strictly inside it.
bool is_strictly_inside(const Solid_face& face, const Homogeneous& p) {
  const std::size_t axis = axis_of(face.plane), size = face.corners.size();
  const int sense = sgn(face.plane[axis]);
  for (std::size_t k = 0; k < size; ++k)
    if (turn_along(face.corners[k], face.corners[(k + 1) % size], p, axis) * sense <= 0) return false;
  return true;
}

bool same_plane(const Homogeneous& a, const Homogeneous& b) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      if (a[i] * b[j] != a[j] * b[i]) return false;
  return true;
}

Homogeneous mean(const Homogeneous& p, const Homogeneous& q) {
  Homogeneous m;
  for (std::size_t k = 0; k < 3; ++k) m[k] = p[k] * q[3] + q[k] * p[3];
  m[3] = 2 * p[3] * q[3];
  return m;
}

/// Where the segment from p (at height s) to q (at t, of the other sign) is at height 0.
Homogeneous crossing(const Homogeneous& p, const Integer& s, const Homogeneous& q, const Integer& t) {
  Homogeneous c;
  for (std::size_t k = 0; k < 4; ++k) c[k] = p[k] * t - q[k] * s;
  if (sgn(c[3]) < 0)
    for (Integer& n : c) n = -n;
  return c;
}

Integer height(const Homogeneous& plane, const Homogeneous& p) {
  return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3] * p[3];
}

/// Lexicographic: along a line, one way.
bool is_less(const Homogeneous& p, const Homogeneous& q) {
  for (std::size_t k = 0; k < 3; ++k)
    if (const int order = cmp(Integer(p[k] * q[3]), Integer(q[k] * p[3])); order != 0) return order < 0;
  return false;
}

/// Whether b has a whole segment inside a: pieces in different planes.
bool cuts_into(const Solid_face& a, const Solid_face& b) {
  // 1. Where b meets a's plane.
  std::vector<Homogeneous> ends;
  const std::size_t size = b.corners.size();
  std::vector<Integer> heights;
  for (const Homogeneous& p : b.corners) heights.push_back(height(a.plane, p));
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t next = (k + 1) % size;
    if (sgn(heights[k]) == 0) ends.push_back(b.corners[k]);
    else if (sgn(heights[k]) * sgn(heights[next]) < 0)
      ends.push_back(crossing(b.corners[k], heights[k], b.corners[next], heights[next]));
  }
  if (ends.empty()) return false;
  Homogeneous from = ends[0], to = ends[0];
  for (const Homogeneous& end : ends) {  // straight corners may make them more than two
    if (is_less(end, from)) from = end;
    if (is_less(to, end)) to = end;
  }
  if (!is_less(from, to)) return false;
  // 2. Of that, what a holds.
  const std::size_t axis = axis_of(a.plane), corners = a.corners.size();
  const int sense = sgn(a.plane[axis]);
  for (std::size_t k = 0; k < corners; ++k) {
    const auto turn = [&](const Homogeneous& p) -> Integer {
      const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
      const Homogeneous &q = a.corners[k], &r = a.corners[(k + 1) % corners];
      const Integer value =
          q[x] * (r[y] * p[3] - p[y] * r[3]) - q[y] * (r[x] * p[3] - p[x] * r[3]) + q[3] * (r[x] * p[y] - p[x] * r[y]);
      return sense > 0 ? value : Integer(-value);
    };
    const Integer s = turn(from), t = turn(to);
    if (sgn(s) <= 0 && sgn(t) <= 0) return false;
    if (sgn(s) < 0) from = crossing(from, s, to, t);
    else if (sgn(t) < 0) to = crossing(from, s, to, t);
  }
  return is_strictly_inside(a, mean(from, to));
}

/// Whether two faces in one plane have area in common.
bool overlap(const Solid_face& a, const Solid_face& b) {
  const std::size_t axis = axis_of(a.plane);
  const auto apart = [&](const Solid_face& one, const Solid_face& other) {
    const int sense = sgn(one.plane[axis]);
    const std::size_t size = one.corners.size();
    for (std::size_t k = 0; k < size; ++k)
      if (std::all_of(other.corners.begin(), other.corners.end(), [&](const Homogeneous& p) {
            return turn_along(one.corners[k], one.corners[(k + 1) % size], p, axis) * sense <= 0;
          }))
        return true;
    return false;
  };
  return !apart(a, b) && !apart(b, a);
}

using Numbers = std::map<std::uint32_t, int>;

class Solid_check {
 public:
  Solid_check(std::span<const Polygon_soup> operands, const Solid_certificate& claim, const Verify_options& options)
      : operands_(operands), claim_(claim), options_(options), faces_(claim.fragments.size()) {}

  std::string check(const Polygon_soup* result) {
    check_names();
    check_coverings();
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      faces_[i].corners = homogeneous(claim_.fragments[i].vertices);
      faces_[i].plane = plane_of(claim_.fragments[i].vertices);
    }
    const Rank_grid grid(claim_.fragments, faces_);
    check_crossings(grid);
    for_each_below(faces_.size(), 100, options_.threads, [&](std::size_t i) { check_numbers(grid, i); });
    check_boundary();
    if (result != nullptr) check_result(*result);
    std::size_t kept = 0;
    for (const auto& fragment : claim_.fragments) kept += fragment.fate != Solid_certificate::Fate::dropped;
    return claim_.operation + " of " + std::to_string(operands_.size()) + " solids: " + std::to_string(kept) + " of " +
           std::to_string(faces_.size()) + " fragments bound it" + (result == nullptr ? "" : ", and are the result");
  }

 private:
  /// All refer to something.
  void check_names() const {
    if (claim_.operands != operands_.size())
      reject("the certificate is of " + std::to_string(claim_.operands) + " solids, not of " +
             std::to_string(operands_.size()));
    if (claim_.operation != "union" && claim_.operation != "intersection" && claim_.operation != "difference" &&
        claim_.operation != "symmetric-difference")
      reject("the operation is none of union, intersection, difference and symmetric-difference");
    if (claim_.inside != "positive" && claim_.inside != "nonzero" && claim_.inside != "odd")
      reject("inside is none of positive, nonzero and odd");
    const auto in_operands = [&](const std::string& what, std::uint32_t operand) {
      if (operand >= operands_.size()) reject(what + " names solid " + std::to_string(operand));
    };
    for (std::size_t i = 0; i < claim_.fragments.size(); ++i) {
      const Solid_certificate::Fragment& fragment = claim_.fragments[i];
      if (fragment.parts.empty()) reject(name("fragment", i) + " is of no face", {i});
      if (fragment.parts[0].turned) reject(name("fragment", i) + " is turned against its first face", {i});
      for (const auto& part : fragment.parts) in_operands(name("fragment", i), part.operand);
      for (std::size_t k = 0; k < fragment.front.size(); ++k) {
        in_operands(name("fragment", i), fragment.front[k].first);
        if (fragment.front[k].second == 0 || (k > 0 && fragment.front[k].first <= fragment.front[k - 1].first))
          reject(name("fragment", i) + " has winding numbers that are 0 or out of order", {i});
      }
    }
    for (std::size_t i = 0; i < claim_.pieces.size(); ++i) in_operands(name("piece", i), claim_.pieces[i].operand);
    for (const auto& entry : claim_.set_aside) in_operands("set_aside", entry.operand);
  }

  /// Each operand is its fragments, and closed.
  void check_coverings() const {
    for (std::uint32_t operand = 0; operand < operands_.size(); ++operand) {
      Covering covering;
      std::vector<std::size_t> of;
      for (std::size_t i = 0; i < claim_.fragments.size(); ++i)
        for (const Solid_certificate::Part& part : claim_.fragments[i].parts) {
          if (part.operand != operand) continue;
          covering.fragments.push_back({part.face, part.piece, claim_.fragments[i].vertices});
          if (part.turned)
            std::reverse(covering.fragments.back().vertices.begin(), covering.fragments.back().vertices.end());
          of.push_back(i);
        }
      for (const auto& piece : claim_.pieces)
        if (piece.operand == operand) covering.pieces.push_back({piece.face, piece.piece, piece.vertices});
      for (const auto& entry : claim_.set_aside) {
        if (entry.operand != operand) continue;
        if (!entry.why.starts_with("zero area"))
          reject("solid " + std::to_string(operand) + ": " + name("face", entry.face) +
                 " is set aside, and not for zero area: it bounds nothing");
        covering.set_aside.push_back({entry.face, entry.why});
      }
      try {
        check_covering(operands_[operand], covering, options_.threads);
      } catch (Rejection& rejection) {
        rejection.verdict.why = "solid " + std::to_string(operand) + ": " + rejection.verdict.why;
        for (std::size_t& i : rejection.verdict.fragments) i = of[i];
        throw;
      }
      Boundary_chain boundary;
      for (const Order_fragment& fragment : covering.fragments) boundary.add(fragment.vertices, 1);
      if (const auto point = boundary.nonzero())
        reject("solid " + std::to_string(operand) + " is not closed near " + name(*point));
    }
  }

  /// No fragment is cut into by another one.
  void check_crossings(const Rank_grid& grid) const {
    for_each_below(grid.side() * grid.side(), 20, options_.threads, [&](std::size_t place) {
      const std::size_t x = place / grid.side(), y = place % grid.side();
      const std::vector<std::uint32_t>& here = grid.at(x, y);
      for (std::size_t j = 0; j < here.size(); ++j)
        for (std::size_t i = 0; i < j; ++i) {
          const Solid_face &a = faces_[here[i]], &b = faces_[here[j]];
          // Each pair once: where both are for the first time.
          if (!boxes_meet(a, b) || std::max(grid.square(a.low[0], 0), grid.square(b.low[0], 0)) != x ||
              std::max(grid.square(a.low[1], 1), grid.square(b.low[1], 1)) != y)
            continue;
          const bool wrong = same_plane(a.plane, b.plane) ? overlap(a, b) : cuts_into(a, b) || cuts_into(b, a);
          if (wrong)
            reject(name("fragment", here[i]) + " and " + name("fragment", here[j]) + " cross or overlap",
                   {here[i], here[j]});
        }
    });
  }

  /// A point inside fragment i; different ones for different attempts.
  Homogeneous point_inside(std::size_t i, std::size_t attempt) const {
    const std::vector<Homogeneous>& corners = faces_[i].corners;
    Homogeneous sum = corners[0];
    Integer weights = 1;
    for (std::size_t k = 1; k < corners.size(); ++k) {
      const Integer weight = static_cast<unsigned long>(1 + (7 * k + 13 * attempt * k * k + 5 * attempt) % 11);
      Homogeneous next;
      for (std::size_t c = 0; c < 3; ++c) next[c] = sum[c] * corners[k][3] + weight * corners[k][c] * sum[3];
      next[3] = sum[3] * corners[k][3];
      sum = next;
      weights += weight;
    }
    sum[3] *= weights;
    return sum;
  }

  /// The winding numbers just before a fragment's front, by a ray along the third axis; nothing where it meets an edge.
  std::optional<Numbers> numbers_at(const Rank_grid& grid, std::size_t i, const Homogeneous& p) const {
    const auto coordinate = [&](std::size_t k) {
      Rational x(p[k], p[3]);
      x.canonicalize();
      return x;
    };
    const std::uint32_t x = grid.rank(coordinate(0), 0), y = grid.rank(coordinate(1), 1);
    const int front_is_up = sgn(faces_[i].plane[2]);
    Numbers above;
    // Between two values a point is in the square of either, whichever its rank says; boxes hold both.
    for (const std::uint32_t j : grid.at(grid.square(x, 0), grid.square(y, 1))) {
      const Solid_face& face = faces_[j];
      if (j == i || face.low[0] > x || x > face.high[0] || face.low[1] > y || y > face.high[1]) continue;
      bool left = false, right = false, on = false;
      const std::size_t size = face.corners.size();
      for (std::size_t k = 0; k < size && !(left && right); ++k) {
        const int turn = turn_along(face.corners[k], face.corners[(k + 1) % size], p, 2);
        left |= turn > 0;
        right |= turn < 0;
        on |= turn == 0;
      }
      if (left && right) continue;
      if (on) return std::nullopt;
      const int upwards = sgn(face.plane[2]), here = side(face.plane, p);
      if (here == 0) return std::nullopt;
      if (here == upwards) continue;  // it is below
      for (const Solid_certificate::Part& part : claim_.fragments[j].parts)
        above[part.operand] += part.turned ? -upwards : upwards;
    }
    // The ray begins above the fragment; its front may be below.
    if (front_is_up < 0)
      for (const Solid_certificate::Part& part : claim_.fragments[i].parts) above[part.operand] -= part.turned ? -1 : 1;
    std::erase_if(above, [](const auto& entry) { return entry.second == 0; });
    return above;
  }

  /// The same by a ray in any direction, past all fragments.
  Numbers numbers_by_brute_force(std::size_t i) const {
    for (std::size_t attempt = 0;; ++attempt) {
      const Homogeneous p = point_inside(i, attempt);
      const Integer_vector d{Integer(static_cast<unsigned long>(1009 + 31 * attempt)),
                             Integer(static_cast<unsigned long>(97 + attempt * attempt)),
                             Integer(static_cast<unsigned long>(10007))};
      if (const auto found = numbers_along(i, p, d)) return *found;
    }
  }
  std::optional<Numbers> numbers_along(std::size_t i, const Homogeneous& p, const Integer_vector& d) const {
    const auto slope = [&](const Homogeneous& plane) {
      return sgn(Integer(plane[0] * d[0] + plane[1] * d[1] + plane[2] * d[2]));
    };
    if (slope(faces_[i].plane) == 0) return std::nullopt;
    Numbers beyond;
    for (std::size_t j = 0; j < faces_.size(); ++j) {
      if (j == i) continue;
      const Solid_face& face = faces_[j];
      const int along = slope(face.plane), here = side(face.plane, p);
      if (along == 0 && here != 0) continue;
      if (along == 0) return std::nullopt;
      if (here == 0 || here == along) {
        if (here == 0 && !same_plane(face.plane, faces_[i].plane)) return std::nullopt;
        continue;
      }
      // Where the ray meets its plane: p + t d.
      const Integer value = height(face.plane, p);
      const Integer rate = face.plane[0] * d[0] + face.plane[1] * d[1] + face.plane[2] * d[2];
      Homogeneous q;
      for (std::size_t k = 0; k < 3; ++k) q[k] = p[k] * rate - value * d[k];
      q[3] = p[3] * rate;
      if (sgn(q[3]) < 0)
        for (Integer& n : q) n = -n;
      const std::size_t axis = axis_of(face.plane), size = face.corners.size();
      const int sense = sgn(face.plane[axis]);
      bool outside = false, on = false;
      for (std::size_t k = 0; k < size; ++k) {
        const int turn = turn_along(face.corners[k], face.corners[(k + 1) % size], q, axis) * sense;
        outside |= turn < 0;
        on |= turn == 0;
      }
      if (outside) continue;
      if (on) return std::nullopt;
      for (const Solid_certificate::Part& part : claim_.fragments[j].parts)
        beyond[part.operand] += part.turned ? -along : along;
    }
    if (slope(faces_[i].plane) < 0)
      for (const Solid_certificate::Part& part : claim_.fragments[i].parts)
        beyond[part.operand] -= part.turned ? -1 : 1;
    std::erase_if(beyond, [](const auto& entry) { return entry.second == 0; });
    return beyond;
  }

  bool is_in_result(const Numbers& numbers) const {
    std::size_t inside = 0;
    bool first = false;
    for (const auto& [operand, number] : numbers) {
      const bool is_inside = claim_.inside == "positive"  ? number > 0
                             : claim_.inside == "nonzero" ? number != 0
                                                          : number % 2 != 0;
      inside += is_inside;
      first |= is_inside && operand == 0;
    }
    if (claim_.operation == "union") return inside > 0;
    if (claim_.operation == "intersection") return inside == operands_.size();
    if (claim_.operation == "difference") return first && inside == 1;
    return inside % 2 == 1;
  }

  void check_numbers(const Rank_grid& grid, std::size_t i) const {
    const Solid_certificate::Fragment& fragment = claim_.fragments[i];
    std::optional<Numbers> front;
    if (sgn(faces_[i].plane[2]) != 0)  // else it is upright
      for (std::size_t attempt = 0; attempt < 4 && !front; ++attempt)
        front = numbers_at(grid, i, point_inside(i, attempt));
    if (!front) front = numbers_by_brute_force(i);
    if (!std::equal(front->begin(), front->end(), fragment.front.begin(), fragment.front.end(),
                    [](const auto& a, const auto& b) { return a.first == b.first && a.second == b.second; }))
      reject("before " + name("fragment", i) + " the solids wind round otherwise than it says", {i});
    Numbers behind = *front;
    for (const Solid_certificate::Part& part : fragment.parts) behind[part.operand] += part.turned ? -1 : 1;
    const bool before = is_in_result(*front), beyond = is_in_result(behind);
    const auto fate = before == beyond ? Solid_certificate::Fate::dropped
                      : before         ? Solid_certificate::Fate::turned
                                       : Solid_certificate::Fate::kept;
    if (fate != fragment.fate)
      reject(name("fragment", i) + " is " + text_of(fragment.fate) + ", and should be " + text_of(fate), {i});
  }
  static std::string text_of(Solid_certificate::Fate fate) {
    return fate == Solid_certificate::Fate::kept     ? "kept"
           : fate == Solid_certificate::Fate::turned ? "turned"
                                                     : "dropped";
  }

  /// A kept fragment as the result has it.
  Polygon boundary_of(const Solid_certificate::Fragment& fragment) const {
    Polygon polygon = fragment.vertices;
    if (fragment.fate == Solid_certificate::Fate::turned) std::reverse(polygon.begin(), polygon.end());
    return polygon;
  }

  void check_boundary() const {
    Boundary_chain boundary;
    for (const auto& fragment : claim_.fragments)
      if (fragment.fate != Solid_certificate::Fate::dropped) boundary.add(boundary_of(fragment), 1);
    if (const auto point = boundary.nonzero()) reject("what is kept is not closed near " + name(*point));
  }

  /// In each plane, and from each side of it, the result's faces and what is kept are the same chain.
  void check_result(const Polygon_soup& result) const {
    std::map<std::array<Rational, 4>, Boundary_chain> planes;
    const auto add = [&](const std::vector<Polygon>& loops, long times) {
      const Integer_vector n = newell_normal(loops[0]);
      if (is_zero(n)) reject("a face of the result has no area");
      const Rational offset = dot(n, loops[0][0]);
      for (const Polygon& loop : loops)
        for (const Exact_point& p : loop)
          if (dot(n, p) != offset) reject("a face of the result is not planar near " + name(p));
      planes[{Rational(n[0]), Rational(n[1]), Rational(n[2]), offset}].add(loops, times);
    };
    for (Face_id f = 0; f < result.face_count(); ++f) {
      std::vector<Polygon> loops(result.loop_count(f));
      for (std::size_t k = 0; k < loops.size(); ++k)
        for (const Point_id p : result.loop(f, k)) loops[k].push_back(result.point(p));
      add(loops, 1);
    }
    for (const auto& fragment : claim_.fragments)
      if (fragment.fate != Solid_certificate::Fate::dropped) add({boundary_of(fragment)}, -1);
    for (const auto& [plane, chain] : planes)
      if (const auto point = chain.nonzero()) reject("the result is not what is kept, near " + name(*point));
  }

  std::span<const Polygon_soup> operands_;
  const Solid_certificate& claim_;
  const Verify_options& options_;
  std::vector<Solid_face> faces_;
};

}  // namespace
}  // namespace sightline::certificate_check

namespace sightline {

Verdict verify_solids(std::span<const Polygon_soup> operands, const Solid_certificate& certificate,
                      const Polygon_soup* result, const Verify_options& options) {
  return certificate_check::verdict_of(
      [&] { return certificate_check::Solid_check(operands, certificate, options).check(result); });
}

}  // namespace sightline
