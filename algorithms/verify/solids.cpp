// To be read after covering.cpp and solid_faces.cpp: the fragments on grids of ranks, then the check, step by step.

#include <sightline/algorithms/verify/solids.h>

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/faces.h>
#include <sightline/algorithms/verify/numbered_points.h>
#include <sightline/algorithms/verify/parallel.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/set_aside.h>
#include <sightline/algorithms/verify/solid_faces.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace sightline::certificate_check {
namespace {

/// Fragments by squares of grids over ranks of two of their coordinates: whole numbers from here on.
class Rank_grid {
 public:
  using Number = Numbered_points::Number;

  struct Box {
    std::array<std::uint32_t, 3> low, high;  // ranks
  };

  Rank_grid(const Numbered_points& points, const std::vector<Solid_point>& near, const std::vector<Solid_face>& faces)
      : boxes_(faces.size()) {
    while (side_ * side_ < faces.size()) ++side_;
    for (std::size_t k = 0; k < 3; ++k) rank_faces(points, near, faces, k);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
      squares_[axis].resize(side_ * side_);
      for (std::size_t i = 0; i < faces.size(); ++i)
        for (std::size_t s = square(boxes_[i].low[x], x); s <= square(boxes_[i].high[x], x); ++s)
          for (std::size_t t = square(boxes_[i].low[y], y); t <= square(boxes_[i].high[y], y); ++t)
            squares_[axis][s * side_ + t].push_back(static_cast<std::uint32_t>(i));
    }
  }
  /// The number of values below x.
  std::uint32_t rank(const Rational& x, std::size_t k) const {
    const auto at = std::lower_bound(values_[k].begin(), values_[k].end(), x,
                                     [](const Rational* value, const Rational& than) { return *value < than; });
    return static_cast<std::uint32_t>(at - values_[k].begin());
  }
  const Box& box(std::size_t i) const { return boxes_[i]; }
  std::size_t side() const { return side_; }
  std::size_t square(std::uint32_t rank, std::size_t k) const {
    return std::min(side_ - 1, rank * side_ / std::max<std::size_t>(1, values_[k].size()));
  }
  /// Those in a square as seen along an axis.
  const std::vector<std::uint32_t>& at(std::size_t axis, std::size_t x, std::size_t y) const {
    return squares_[axis][x * side_ + y];
  }

 private:
  void rank_faces(const Numbered_points& points, const std::vector<Solid_point>& near,
                  const std::vector<Solid_face>& faces, std::size_t k) {
    std::vector<Number> sorted(near.size());
    std::iota(sorted.begin(), sorted.end(), Number{0});
    std::sort(sorted.begin(), sorted.end(), [&](Number i, Number j) {
      const int known = (near[i].near[k] - near[j].near[k]).sign();
      return known != 0 ? known < 0 : points[i][k] < points[j][k];
    });
    std::vector<std::uint32_t> ranks(near.size());
    for (const Number number : sorted) {
      if (values_[k].empty() || *values_[k].back() != points[number][k]) values_[k].push_back(&points[number][k]);
      ranks[number] = static_cast<std::uint32_t>(values_[k].size() - 1);
    }
    for (std::size_t i = 0; i < faces.size(); ++i) {
      boxes_[i].low[k] = boxes_[i].high[k] = ranks[faces[i].numbers[0]];
      for (const Number number : faces[i].numbers) {
        boxes_[i].low[k] = std::min(boxes_[i].low[k], ranks[number]);
        boxes_[i].high[k] = std::max(boxes_[i].high[k], ranks[number]);
      }
    }
  }

  std::vector<Box> boxes_;  // of the fragments
  std::array<std::vector<const Rational*>, 3> values_;
  std::size_t side_ = 1;
  std::array<std::vector<std::vector<std::uint32_t>>, 3> squares_;
};

bool boxes_meet(const Rank_grid::Box& a, const Rank_grid::Box& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.high[k] < b.low[k] || b.high[k] < a.low[k]) return false;
  return true;
}

/// Sets of fragments that hang together.
class Patches {
 public:
  explicit Patches(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0u); }
  /// The least of those with i.
  std::uint32_t least(std::uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    i = least(i);
    j = least(j);
    parents_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::uint32_t> parents_;
};

/// Whether one loop of numbers is the other, begun elsewhere.
bool is_rotation(std::span<const Numbered_points::Number> a, std::span<const Numbered_points::Number> b) {
  if (a.size() != b.size()) return false;
  for (std::size_t first = 0; first < b.size(); ++first)
    if (std::equal(a.begin(), a.end() - static_cast<std::ptrdiff_t>(first),
                   b.begin() + static_cast<std::ptrdiff_t>(first)) &&
        std::equal(a.end() - static_cast<std::ptrdiff_t>(first), a.end(), b.begin()))
      return true;
  return false;
}

using Numbers = std::map<std::uint32_t, int>;

class Solid_check {
 public:
  Solid_check(std::span<const Polygon_soup> operands, const Solid_certificate& claim, const Verify_options& options)
      : operands_(operands),
        claim_(claim),
        options_(options),
        workers_(options, claim.fragments.size()),
        touched_(claim.fragments.size()) {}

  std::string check(const Polygon_soup* result) {
    check_names();
    number_points(result);
    check_coverings();
    const Rank_grid grid(points_, near_, faces_);
    check_crossings(grid);
    check_numbers(grid);
    check_boundary();
    if (result != nullptr) check_result(*result);
    if (options_.progress) options_.progress(faces_.size(), faces_.size());
    std::size_t kept = 0;
    for (const auto& fragment : claim_.fragments) kept += fragment.fate != Solid_certificate::Fate::dropped;
    return claim_.operation + " of " + std::to_string(operands_.size()) + " solids: " + std::to_string(kept) + " of " +
           std::to_string(faces_.size()) + " fragments bound it" + (result == nullptr ? "" : ", and are the result");
  }

 private:
  using Number = Numbered_points::Number;

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

  /// All points by number: first those of fragments, which are made ready, then those of operands and of the result.
  void number_points(const Polygon_soup* result) {
    std::vector<std::vector<Number>> numbers;
    for (std::size_t i = 0; i < claim_.fragments.size(); ++i) {
      const std::size_t before = points_.size();
      numbers.push_back(points_.add(claim_.fragments[i].vertices));
      for (std::size_t k = before; k < points_.size(); ++k)
        if (!canonical(points_[static_cast<Number>(k)]))
          reject(name("fragment", i) + " has a vertex that is not in canonical numbers", {i});
    }
    for (Number k = 0; k < points_.size(); ++k) near_.emplace_back(points_[k]);
    for (std::vector<Number>& corners : numbers) {
      workers_.ask();
      faces_.emplace_back(std::move(corners), near_);
    }
    const auto add = [&](const Polygon_soup& soup) {
      std::vector<Number> all;
      for (Point_id p = 0; p < soup.point_count(); ++p) all.push_back(points_.add(soup.point(p)));
      return all;
    };
    for (const Polygon_soup& operand : operands_) operand_numbers_.push_back(add(operand));
    if (result != nullptr) result_numbers_ = add(*result);
  }

  /// Each operand is its fragments, and closed.
  void check_coverings() const {
    std::vector<std::vector<std::pair<std::size_t, const Solid_certificate::Part*>>> parts(operands_.size());
    for (std::size_t i = 0; i < claim_.fragments.size(); ++i)
      for (const Solid_certificate::Part& part : claim_.fragments[i].parts) parts[part.operand].emplace_back(i, &part);
    for (std::uint32_t operand = 0; operand < operands_.size(); ++operand) {
      Covering covering;
      for (const auto& piece : claim_.pieces)
        if (piece.operand == operand) covering.pieces.push_back({piece.face, piece.piece, piece.vertices});
      for (const auto& entry : claim_.set_aside) {
        if (entry.operand != operand) continue;
        if (!entry.why.starts_with("zero area"))
          reject("solid " + std::to_string(operand) + ": " + name("face", entry.face) +
                 " is set aside, and not for zero area: it bounds nothing");
        covering.set_aside.push_back({entry.face, entry.why});
      }
      const std::vector<bool> whole = whole_triangles(operand, parts[operand], covering);
      std::vector<std::size_t> of;
      for (const auto& [i, part] : parts[operand]) {
        if (part->face < whole.size() && whole[part->face]) continue;
        covering.fragments.push_back({part->face, part->piece, claim_.fragments[i].vertices});
        if (part->turned)
          std::reverse(covering.fragments.back().vertices.begin(), covering.fragments.back().vertices.end());
        of.push_back(i);
      }
      try {
        check_covering(operands_[operand], covering, workers_, nullptr, whole);
      } catch (Rejection& rejection) {
        rejection.verdict.why = "solid " + std::to_string(operand) + ": " + rejection.verdict.why;
        for (std::size_t& i : rejection.verdict.fragments) i = of[i];
        throw;
      }
      Numbered_chain boundary;
      for (const auto& [i, part] : parts[operand]) boundary.add(faces_[i].numbers, part->turned ? -1 : 1);
      if (const auto point = boundary.nonzero(points_))
        reject("solid " + std::to_string(operand) + " is not closed near " + name(*point));
    }
  }

  /// The operand's faces that are triangles, each the one fragment that names it: those are tiled.
  std::vector<bool> whole_triangles(std::uint32_t operand,
                                    const std::vector<std::pair<std::size_t, const Solid_certificate::Part*>>& parts,
                                    const Covering& covering) const {
    const Polygon_soup& soup = operands_[operand];
    std::vector<std::size_t> times(soup.face_count());
    for (const auto& [i, part] : parts)
      if (part->face < times.size()) ++times[part->face];
    for (const auto& piece : covering.pieces)
      if (piece.face < times.size()) times[piece.face] = 0;
    for (const auto& entry : covering.set_aside)
      if (entry.face < times.size()) times[entry.face] = 0;
    std::vector<bool> whole(soup.face_count());
    for (const auto& [i, part] : parts) {
      if (part->face >= times.size() || times[part->face] != 1 || !faces_[i].has_plane()) continue;
      if (soup.loop_count(part->face) != 1 || soup.loop(part->face).size() != 3) continue;
      std::vector<Number> loop;
      for (const Point_id p : soup.loop(part->face))
        if (p < soup.point_count()) loop.push_back(operand_numbers_[operand][p]);
      if (part->turned) std::reverse(loop.begin(), loop.end());
      whole[part->face] = is_rotation(loop, faces_[i].numbers);
    }
    return whole;
  }

  /// No fragment is cut into by another one. Post: those are marked that may share more with another than whole edges.
  void check_crossings(const Rank_grid& grid) {
    for_each_below(grid.side() * grid.side(), 20, workers_, [&](std::size_t place) {
      const std::size_t x = place / grid.side(), y = place % grid.side();
      const std::vector<std::uint32_t>& here = grid.at(2, x, y);
      for (std::size_t j = 0; j < here.size(); ++j)
        for (std::size_t i = 0; i < j; ++i) {
          const Rank_grid::Box &a = grid.box(here[i]), &b = grid.box(here[j]);
          // Each pair once: where both are for the first time.
          if (!boxes_meet(a, b) || grid.square(std::max(a.low[0], b.low[0]), 0) != x ||
              grid.square(std::max(a.low[1], b.low[1]), 1) != y)
            continue;
          const Contact contact = contact_of(faces_[here[i]], faces_[here[j]]);
          if (contact == Contact::crossed)
            reject(name("fragment", here[i]) + " and " + name("fragment", here[j]) + " cross or overlap",
                   {here[i], here[j]});
          if (contact == Contact::little) continue;
          for (const std::uint32_t touched : {here[i], here[j]})
            std::atomic_ref(touched_[touched]).store(1, std::memory_order_relaxed);
        }
    });
  }

  /// Fragments of which the points just before them hang together: neighbours across an edge that no others have, that
  /// share nothing but whole edges and single points with any.
  Patches patches() const {
    struct Edge {
      Number low, high;
      std::uint32_t fragment;
      bool upwards;
    };
    std::vector<Edge> edges;
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      Number from = faces_[i].numbers.back();
      for (const Number to : faces_[i].numbers) {
        edges.push_back({std::min(from, to), std::max(from, to), i, from < to});
        from = to;
      }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
      return std::tie(a.low, a.high, a.fragment) < std::tie(b.low, b.high, b.fragment);
    });
    Patches patches(faces_.size());
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      while (end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high) ++end;
      const Edge &one = edges[begin], &other = edges[end - 1];
      if (end - begin == 2 && one.upwards != other.upwards && !touched_[one.fragment] && !touched_[other.fragment])
        patches.join(one.fragment, other.fragment);
    }
    return patches;
  }

  /// A point inside fragment i; different ones for different attempts.
  Exact_point point_inside(std::size_t i, std::size_t attempt) const {
    Exact_point sum = points_[faces_[i].numbers[0]];
    Rational weights = 1;
    for (std::size_t k = 1; k < faces_[i].numbers.size(); ++k) {
      const Rational weight = static_cast<unsigned long>(1 + (7 * k + 13 * attempt * k * k + 5 * attempt) % 11);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * points_[faces_[i].numbers[k]][c];
      weights += weight;
    }
    for (Rational& x : sum) x /= weights;
    return sum;
  }

  /// The winding numbers just before a fragment's front, by a ray from a point in it along the axis in which its normal
  /// is longest; nothing where that meets an edge.
  std::optional<Numbers> numbers_at(const Rank_grid& grid, std::size_t i, const Exact_point& at) const {
    const Solid_point p(at);
    const std::size_t axis = faces_[i].axis, x_axis = (axis + 1) % 3, y_axis = (axis + 2) % 3;
    const std::uint32_t x = grid.rank(at[x_axis], x_axis), y = grid.rank(at[y_axis], y_axis);
    Numbers above;
    // Between two values a point is in the square of either, whichever its rank says; boxes hold both.
    for (const std::uint32_t j : grid.at(axis, grid.square(x, x_axis), grid.square(y, y_axis))) {
      const Rank_grid::Box& box = grid.box(j);
      if (j == i || box.low[x_axis] > x || x > box.high[x_axis] || box.low[y_axis] > y || y > box.high[y_axis])
        continue;
      const Solid_face& face = faces_[j];
      bool left = false, right = false, on = false;
      const std::size_t size = face.corners.size();
      for (std::size_t k = 0; k < size && !(left && right); ++k) {
        const int turn = turn_along(*face.corners[k], *face.corners[k + 1 == size ? 0 : k + 1], p, axis);
        left |= turn > 0;
        right |= turn < 0;
        on |= turn == 0;
      }
      if (left && right) continue;
      if (on) return std::nullopt;
      const int upwards = sgn(face.plane[axis]), here = face.side(p);
      if (here == 0) return std::nullopt;
      if (here == upwards) continue;  // it is below
      for (const Solid_certificate::Part& part : claim_.fragments[j].parts)
        above[part.operand] += part.turned ? -upwards : upwards;
    }
    // The ray begins above the fragment; its front may be below.
    if (sgn(faces_[i].plane[axis]) < 0)
      for (const Solid_certificate::Part& part : claim_.fragments[i].parts) above[part.operand] -= part.turned ? -1 : 1;
    std::erase_if(above, [](const auto& entry) { return entry.second == 0; });
    return above;
  }

  /// The same by a ray in any direction, past all fragments.
  Numbers numbers_by_brute_force(std::size_t i) const {
    for (std::size_t attempt = 0;; ++attempt) {
      const Homogeneous p = homogeneous(point_inside(i, attempt));
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
      const Integer value = height(face.plane, p);
      const int along = slope(face.plane), here = sgn(value);
      if (along == 0 && here != 0) continue;
      if (along == 0) return std::nullopt;
      if (here == along) continue;
      // Where the ray meets its plane: p + t d. At p itself, a face beside this one in its plane is not met.
      const Integer rate = face.plane[0] * d[0] + face.plane[1] * d[1] + face.plane[2] * d[2];
      Exact_point q;
      for (std::size_t k = 0; k < 3; ++k) {
        q[k] = Rational(p[k] * rate - value * d[k], p[3] * rate);
        q[k].canonicalize();
      }
      const Solid_point met(q);
      const std::size_t size = face.corners.size();
      const int sense = sgn(face.plane[face.axis]);
      bool outside = false, on = false;
      for (std::size_t k = 0; k < size; ++k) {
        const int turn = turn_along(*face.corners[k], *face.corners[(k + 1) % size], met, face.axis) * sense;
        outside |= turn < 0;
        on |= turn == 0;
      }
      if (outside) continue;
      if (on || here == 0) return std::nullopt;
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

  /// Before each fragment the solids wind round as it says, and its fate follows from that.
  void check_numbers(const Rank_grid& grid) const {
    Patches patches = this->patches();
    std::vector<std::uint32_t> least(faces_.size()), first;
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      least[i] = patches.least(i);
      if (least[i] == i) first.push_back(i);
    }
    std::vector<Numbers> numbers(faces_.size());
    for_each_below(first.size(), 20, workers_, [&](std::size_t k) {
      const std::size_t i = first[k];
      std::optional<Numbers> found;
      for (std::size_t attempt = 0; attempt < 4 && !found; ++attempt)
        found = numbers_at(grid, i, point_inside(i, attempt));
      numbers[i] = found ? *found : numbers_by_brute_force(i);
    });
    for_each_below(faces_.size(), 1000, workers_, [&](std::size_t i) { check_fate(i, numbers[least[i]]); });
  }

  void check_fate(std::size_t i, const Numbers& front) const {
    const Solid_certificate::Fragment& fragment = claim_.fragments[i];
    if (!std::equal(front.begin(), front.end(), fragment.front.begin(), fragment.front.end(),
                    [](const auto& a, const auto& b) { return a.first == b.first && a.second == b.second; }))
      reject("before " + name("fragment", i) + " the solids wind round otherwise than it says", {i});
    Numbers behind = front;
    for (const Solid_certificate::Part& part : fragment.parts) behind[part.operand] += part.turned ? -1 : 1;
    const bool before = is_in_result(front), beyond = is_in_result(behind);
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

  /// How often the boundary of a fragment is the result's: 1, -1 or 0.
  long times(std::size_t i) const {
    const Solid_certificate::Fate fate = claim_.fragments[i].fate;
    return fate == Solid_certificate::Fate::kept ? 1 : fate == Solid_certificate::Fate::turned ? -1 : 0;
  }

  void check_boundary() const {
    Numbered_chain boundary;
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (times(i) != 0) boundary.add(faces_[i].numbers, times(i));
    if (const auto point = boundary.nonzero(points_)) reject("what is kept is not closed near " + name(*point));
  }

  /// In each plane, and from each side of it, the result's faces and what is kept are the same chain.
  void check_result(const Polygon_soup& result) const {
    // 1. Faces that are a fragment, corner by corner, are what is kept of that.
    std::map<std::vector<Number>, std::vector<std::size_t>> kept;  // by loops that begin with their least number
    const auto from_least = [](std::vector<Number> loop) {
      std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
      return loop;
    };
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (times(i) == 0) continue;
      std::vector<Number> loop = faces_[i].numbers;
      if (times(i) < 0) std::reverse(loop.begin(), loop.end());
      kept[from_least(std::move(loop))].push_back(i);
    }
    // 2. The others are, plane by plane, what is left.
    std::map<Homogeneous, Numbered_chain> planes;
    for (Face_id f = 0; f < result.face_count(); ++f) {
      std::vector<std::vector<Number>> loops(result.loop_count(f));
      for (std::size_t k = 0; k < loops.size(); ++k)
        for (const Point_id p : result.loop(f, k)) loops[k].push_back(result_numbers_.at(p));
      if (loops.size() == 1 && !loops[0].empty())
        if (const auto same = kept.find(from_least(loops[0])); same != kept.end() && !same->second.empty()) {
          same->second.pop_back();
          continue;
        }
      Polygon outer;
      for (const Number p : loops[0]) outer.push_back(points_[p]);
      const Integer_vector normal = newell_normal(outer);
      if (is_zero(normal)) reject("a face of the result has no area");
      const Homogeneous plane = plane_of(Plane{normal, outer[0]});
      for (const std::vector<Number>& loop : loops)
        for (const Number p : loop)
          if (side(plane, homogeneous(points_[p])) != 0)
            reject("a face of the result is not planar near " + name(points_[p]));
      if (self_intersecting(Face(result, f)))
        reject(name("face", f) + " of the result crosses itself, or winds round some of it otherwise than once");
      for (const std::vector<Number>& loop : loops) planes[plane].add(loop, 1);
    }
    for (const auto& [loop, same] : kept)
      for (const std::size_t i : same) {
        Homogeneous plane = faces_[i].plane;
        if (times(i) < 0)
          for (Integer& n : plane) n = -n;
        planes[plane].add(loop, -1);
      }
    for (const auto& [plane, chain] : planes)
      if (const auto point = chain.nonzero(points_)) reject("the result is not what is kept, near " + name(*point));
  }

  std::span<const Polygon_soup> operands_;
  const Solid_certificate& claim_;
  const Verify_options& options_;
  const Workers workers_;
  Numbered_points points_;
  std::vector<Solid_point> near_;  // of the fragments' corners
  std::vector<Solid_face> faces_;  // the fragments
  std::vector<char> touched_;      // by fragment
  std::vector<std::vector<Number>> operand_numbers_;
  std::vector<Number> result_numbers_;
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
