// To be read after covering.cpp, boxes.cpp and solid_faces.cpp: the check, step by step.

#include <sightline/algorithms/verify/solids.h>

#include <sightline/algorithms/verify/boxes.h>
#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/faces.h>
#include <sightline/algorithms/verify/numbered_points.h>
#include <sightline/algorithms/verify/parallel.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/set_aside.h>
#include <sightline/algorithms/verify/solid_faces.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sightline::certificate_check {
namespace {

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

/// How often operands wind round a point, where that is not 0; operands ascending.
using Numbers = std::vector<std::pair<std::uint32_t, int>>;

/// A sum of steps, in which operands that cancel are no longer: few at a time.
void add_step(Numbers& sum, std::uint32_t operand, int step) {
  const auto at = std::find_if(sum.begin(), sum.end(), [&](const auto& entry) { return entry.first == operand; });
  if (at == sum.end()) {
    sum.emplace_back(operand, step);
  } else if ((at->second += step) == 0) {
    *at = sum.back();
    sum.pop_back();
  }
}
Numbers in_order(Numbers sum) {
  std::sort(sum.begin(), sum.end());
  return sum;
}

class Solid_check {
 public:
  Solid_check(std::span<const Polygon_soup> operands, const Solid_certificate& claim, const Verify_options& options)
      : operands_(operands),
        claim_(claim),
        options_(options),
        operation_(claim.operation.empty() ? ' ' : claim.operation[0]),
        is_positive_(claim.inside == "positive"),
        is_nonzero_(claim.inside == "nonzero"),
        workers_(options, claim.fragments.size()),
        touched_(claim.fragments.size()) {}

  std::string check(const Polygon_soup* result) {
    check_names();
    number_points(result);
    check_coverings();
    number_planes();
    std::vector<Outward_box> boxes;
    for (const Solid_face& face : faces_) boxes.push_back(face.box());
    const Boxes tree(boxes);
    check_crossings(tree);
    check_numbers(tree);
    check_boundary();
    if (result != nullptr) check_result(*result);
    if (options_.progress) options_.progress(faces_.size(), faces_.size());
    std::size_t kept = 0;
    for (const auto& fragment : claim_.fragments) kept += fragment.fate != Solid_certificate::Fate::dropped;
    return claim_.operation + " of " + std::to_string(operands_.size()) + " solids (inside: " + claim_.inside +
           "): " + std::to_string(kept) + " of " + std::to_string(faces_.size()) + " fragments bound it" +
           (result == nullptr ? "" : ", and are the result");
  }

 private:
  using Number = Numbered_points::Number;
  /// Of an operand: the fragments, each as often as it is part of a face.
  using Parts = std::vector<std::pair<std::size_t, const Solid_certificate::Part*>>;

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
    const auto in_operands = [&](const char* what, std::size_t i, std::uint32_t operand) {
      if (operand >= operands_.size()) reject(name(what, i) + " names solid " + std::to_string(operand));
    };
    for (std::size_t i = 0; i < claim_.fragments.size(); ++i) {
      const Solid_certificate::Fragment& fragment = claim_.fragments[i];
      if (fragment.parts.empty()) reject(name("fragment", i) + " is of no face", {i});
      if (fragment.parts[0].turned) reject(name("fragment", i) + " is turned against its first face", {i});
      for (const auto& part : fragment.parts) in_operands("fragment", i, part.operand);
      for (std::size_t k = 0; k < fragment.front.size(); ++k) {
        in_operands("fragment", i, fragment.front[k].first);
        if (fragment.front[k].second == 0 || (k > 0 && fragment.front[k].first <= fragment.front[k - 1].first))
          reject(name("fragment", i) + " has winding numbers that are 0 or out of order", {i});
      }
    }
    for (std::size_t i = 0; i < claim_.pieces.size(); ++i) in_operands("piece", i, claim_.pieces[i].operand);
    for (std::size_t i = 0; i < claim_.set_aside.size(); ++i) in_operands("set_aside", i, claim_.set_aside[i].operand);
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
    near_.reserve(points_.size());
    for (Number k = 0; k < points_.size(); ++k) near_.emplace_back(points_[k]);
    faces_.reserve(numbers.size());
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
    std::vector<Parts> parts(operands_.size());
    for (std::size_t i = 0; i < claim_.fragments.size(); ++i)
      for (const Solid_certificate::Part& part : claim_.fragments[i].parts) parts[part.operand].emplace_back(i, &part);
    for (std::uint32_t operand = 0; operand < operands_.size(); ++operand) {
      Covering covering;
      Covering_places of;  // in the certificate
      for (std::size_t i = 0; i < claim_.pieces.size(); ++i) {
        const auto& piece = claim_.pieces[i];
        if (piece.operand != operand) continue;
        covering.pieces.push_back({piece.face, piece.piece, piece.vertices});
        of.pieces.push_back(i);
      }
      for (const auto& entry : claim_.set_aside) {
        if (entry.operand != operand) continue;
        if (!entry.why.starts_with("zero area"))
          reject("solid " + std::to_string(operand) + ": " + name("face", entry.face) +
                 " is set aside, and not for zero area: it bounds nothing");
        covering.set_aside.push_back({entry.face, entry.why});
      }
      const std::vector<bool> whole = whole_triangles(operand, parts[operand], covering);
      for (const auto& [i, part] : parts[operand]) {
        if (part->face < whole.size() && whole[part->face]) continue;
        covering.fragments.push_back({part->face, part->piece, claim_.fragments[i].vertices});
        if (part->turned)
          std::reverse(covering.fragments.back().vertices.begin(), covering.fragments.back().vertices.end());
        of.fragments.push_back(i);
      }
      try {
        check_covering(operands_[operand], covering, workers_, nullptr, whole, nullptr, &of);
      } catch (Rejection& rejection) {
        rejection.verdict.why = "solid " + std::to_string(operand) + ": " + rejection.verdict.why;
        for (std::size_t& i : rejection.verdict.fragments) i = of.fragments[i];
        throw;
      }
      const Numbered_chain boundary = boundary_of(operand, parts[operand], covering);
      if (const auto point = boundary.nonzero(points_))
        reject("solid " + std::to_string(operand) + " is not closed near " + name(*point));
    }
  }

  /// The sum of an operand's fragments: of a face of one loop, without pieces, that is the loop, as they tile it.
  Numbered_chain boundary_of(std::uint32_t operand, const Parts& parts, const Covering& covering) const {
    const Polygon_soup& soup = operands_[operand];
    std::vector<bool> by_fragments(soup.face_count());
    for (const auto& piece : covering.pieces) by_fragments[piece.face] = true;
    std::vector<bool> is_tiled(soup.face_count());
    for (const auto& [i, part] : parts) is_tiled[part->face] = true;
    Numbered_chain boundary;
    std::vector<Number> loop;
    for (Face_id f = 0; f < soup.face_count(); ++f) {
      if (soup.loop_count(f) != 1) by_fragments[f] = true;
      if (by_fragments[f] || !is_tiled[f]) continue;
      loop.clear();
      for (const Point_id p : soup.loop(f)) loop.push_back(operand_numbers_[operand][p]);
      boundary.add(loop, 1);
    }
    for (const auto& [i, part] : parts)
      if (by_fragments[part->face]) boundary.add(faces_[i].numbers, part->turned ? -1 : 1);
    return boundary;
  }

  /// The operand's faces that are triangles, each the one fragment that names it: those are tiled.
  std::vector<bool> whole_triangles(std::uint32_t operand, const Parts& parts, const Covering& covering) const {
    const Polygon_soup& soup = operands_[operand];
    std::vector<std::size_t> times(soup.face_count());
    for (const auto& [i, part] : parts)
      if (part->face < times.size()) ++times[part->face];
    for (const auto& piece : covering.pieces)
      if (piece.face < times.size()) times[piece.face] = 0;
    for (const auto& entry : covering.set_aside)
      if (entry.face < times.size()) times[entry.face] = 0;
    std::vector<bool> whole(soup.face_count());
    std::vector<Number> loop;
    for (const auto& [i, part] : parts) {
      if (part->face >= times.size() || times[part->face] != 1 || !faces_[i].has_plane()) continue;
      if (soup.loop_count(part->face) != 1 || soup.loop(part->face).size() != 3) continue;
      loop.clear();
      for (const Point_id p : soup.loop(part->face))
        if (p < soup.point_count()) loop.push_back(operand_numbers_[operand][p]);
      if (part->turned) std::reverse(loop.begin(), loop.end());
      whole[part->face] = is_rotation(loop, faces_[i].numbers);
    }
    return whole;
  }

  /// Planes by number, and for each point those of the fragments that it is a corner of. Pre: fragments are planar.
  void number_planes() {
    constexpr std::size_t usual_planes = 8;                         // of a point
    std::unordered_multimap<std::size_t, const Solid_face*> known;  // by digits
    std::uint32_t count = 0;
    for (Solid_face& face : faces_) {
      std::size_t digits = 0;
      for (const Integer& n : face.plane) digits = mixed_digits(digits, n.get_mpz_t());
      const auto [begin, end] = known.equal_range(digits);
      const auto same =
          std::find_if(begin, end, [&](const auto& entry) { return is_in_plane_of(face, *entry.second); });
      face.plane_number = same != end ? same->second->plane_number : count++;
      if (same == end) known.emplace(digits, &face);
      for (const Number corner : face.numbers) {
        std::vector<std::uint32_t>& planes = near_[corner].planes;
        if (planes.empty()) planes.reserve(usual_planes);
        if (std::find(planes.begin(), planes.end(), face.plane_number) == planes.end())
          planes.push_back(face.plane_number);
      }
    }
  }

  /// Whether two fragments are known to be of one tiling, so that they have no area in common. Pre: planes are
  /// numbered.
  bool are_tiles_of_one(std::size_t i, std::size_t j) const {
    if (faces_[i].plane_number != faces_[j].plane_number) return false;
    const Solid_certificate::Part &a = claim_.fragments[i].parts[0], &b = claim_.fragments[j].parts[0];
    return a.operand == b.operand && a.face == b.face && a.piece == b.piece;
  }

  /// No fragment is cut into by another one. Post: those are marked that may share more with another than whole edges.
  void check_crossings(const Boxes& tree) {
    for_each_below(tree.leaves(), 20, workers_, [&](std::size_t leaf) {
      tree.for_each_pair(leaf, [&](std::size_t i, std::size_t j) {
        if (i > j) std::swap(i, j);
        const Contact contact = are_tiles_of_one(i, j) ? Contact::edges : contact_of(faces_[i], faces_[j]);
        if (contact == Contact::crossed)
          reject(name("fragment", i) + " and " + name("fragment", j) + " cross or overlap", {i, j});
        if (contact == Contact::little) return;
        for (const std::size_t touched : {i, j}) std::atomic_ref(touched_[touched]).store(1, std::memory_order_relaxed);
      });
    });
  }

  /// Fragments of which the points just before them hang together: neighbours across an edge that no others have, that
  /// share nothing but whole edges and single points with any.
  Patches patches() const {
    struct Edge {
      Number from, to;
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
    sort_by_ends(edges, points_.size());
    Patches patches(faces_.size());
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      while (end < edges.size() && edges[end].from == edges[begin].from && edges[end].to == edges[begin].to) ++end;
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
      const Rational weight = weight_of(k, attempt);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * points_[faces_[i].numbers[k]][c];
      weights += weight;
    }
    for (Rational& x : sum) x /= weights;
    return sum;
  }
  /// Of a corner but the first, whose weight is 1. From the eleventh attempt on that of the second grows, and that of
  /// the third with its square: points go on coming along conics, of which no line has more than two, so that edges of
  /// others, which may touch the fragment wherever they like, are beside all but a few.
  static unsigned long weight_of(std::size_t corner, std::size_t attempt) {
    constexpr std::size_t few = 11;
    const std::size_t any = (7 * corner + 13 * attempt * corner * corner + 5 * attempt) % few, turn = attempt / few;
    return static_cast<unsigned long>(1 + any + (corner == 1 ? turn : corner == 2 ? turn * turn : 0));
  }

  /// The same in doubles: of the point in the fragment's plane, two coordinates exactly; nothing where they do not tell
  /// that it is inside.
  std::optional<Near_point> near_point_inside(std::size_t i, std::size_t attempt) const {
    const Solid_face& face = faces_[i];
    const std::size_t size = face.corners.size();
    Near_point p{};
    for (std::size_t c = 0; c < 3; ++c) {
      if (c == face.axis) continue;
      double sum = face.corners[0]->near[c].value, weights = 1;
      for (std::size_t k = 1; k < size; ++k) {
        const auto weight = static_cast<double>(weight_of(k, attempt));
        sum += weight * face.corners[k]->near[c].value;
        weights += weight;
      }
      p[c].value = sum / weights;
    }
    const int sense = sgn(face.plane[face.axis]);
    for (std::size_t k = 0; k < size; ++k)
      if (turn_along(face.corners[k]->near, face.corners[k + 1 == size ? 0 : k + 1]->near, p, face.axis) != sense)
        return std::nullopt;
    return face.lifted(p);
  }

  /// The winding numbers just before a fragment's front, by a ray from a point in it along the axis in which its normal
  /// is longest, to the end of all that is nearer; nothing where that meets an edge, or comes so near that it is not
  /// told. Pre: the box is about the point.
  template <class Corner, class Point>
  std::optional<Numbers> numbers_at(const Boxes& tree, std::size_t i, const Point& p, Outward_box ray,
                                    const Corner& corner) const {
    const std::size_t axis = faces_[i].axis;
    const Outward_box all = tree.all();
    const bool is_up = all.high[axis] - ray.high[axis] <= ray.low[axis] - all.low[axis];
    if (is_up) ray.high[axis] = Outward_box::infinity;
    else ray.low[axis] = -Outward_box::infinity;
    thread_local std::vector<std::size_t> met;
    met.clear();
    tree.find(ray, met);
    Numbers sum;
    for (const std::size_t j : met) {
      if (j == i) continue;
      const Solid_face& face = faces_[j];
      bool left = false, right = false, on = false;
      const std::size_t size = face.corners.size();
      for (std::size_t k = 0; k < size && !(left && right); ++k) {
        const int turn = turn_along(corner(face, k), corner(face, k + 1 == size ? 0 : k + 1), p, axis);
        left |= turn > 0;
        right |= turn < 0;
        on |= turn == 0;
      }
      if (left && right) continue;
      if (on) return std::nullopt;
      const int upwards = sgn(face.plane[axis]), here = face.side(p);
      if (here == 0) return std::nullopt;
      if ((here == upwards) == is_up) continue;  // it is on the other side
      for (const Solid_certificate::Part& part : claim_.fragments[j].parts)
        add_step(sum, part.operand, part.turned == is_up ? -upwards : upwards);
    }
    // The ray begins on one side of the fragment; its front may be on the other.
    if ((sgn(faces_[i].plane[axis]) > 0) != is_up)
      for (const Solid_certificate::Part& part : claim_.fragments[i].parts)
        add_step(sum, part.operand, part.turned ? 1 : -1);
    return in_order(std::move(sum));
  }
  std::optional<Numbers> numbers_by_doubles(const Boxes& tree, std::size_t i, std::size_t attempt) const {
    const std::optional<Near_point> p = near_point_inside(i, attempt);
    if (!p) return std::nullopt;
    Outward_box ray;
    for (std::size_t k = 0; k < 3; ++k) {
      ray.low[k] = (*p)[k].value - 2 * (*p)[k].error;
      ray.high[k] = (*p)[k].value + 2 * (*p)[k].error;
      if (!(ray.low[k] <= ray.high[k])) return std::nullopt;
    }
    return numbers_at(tree, i, *p, ray,
                      [](const Solid_face& face, std::size_t k) -> const Near_point& { return face.corners[k]->near; });
  }
  std::optional<Numbers> numbers_by_integers(const Boxes& tree, std::size_t i, std::size_t attempt) const {
    const Exact_point p = point_inside(i, attempt);
    return numbers_at(tree, i, Solid_point(p), Outward_box(Polygon{p}),
                      [](const Solid_face& face, std::size_t k) -> const Solid_point& { return *face.corners[k]; });
  }

  bool is_in_result(const Numbers& numbers) const {
    std::size_t inside = 0;
    bool first = false;
    for (const auto& [operand, number] : numbers) {
      const bool is_inside = is_positive_ ? number > 0 : is_nonzero_ ? number != 0 : number % 2 != 0;
      inside += is_inside;
      first |= is_inside && operand == 0;
    }
    switch (operation_) {
      case 'u': return inside > 0;
      case 'i': return inside == operands_.size();
      case 'd': return first && inside == 1;
      default: return inside % 2 == 1;
    }
  }

  /// Before each fragment the solids wind round as it says, and its fate follows from that.
  void check_numbers(const Boxes& tree) const {
    Patches patches = this->patches();
    std::vector<std::uint32_t> least(faces_.size()), first;
    for (std::uint32_t i = 0; i < faces_.size(); ++i) least[i] = patches.least(i);
    for (const std::uint32_t i : tree.order())  // so that rays after one another meet the same
      if (least[i] == i) first.push_back(i);
    std::vector<Numbers> numbers(faces_.size());
    for_each_below(first.size(), 20, workers_, [&](std::size_t k) {
      const std::size_t i = first[k];
      std::optional<Numbers> found;
      constexpr std::size_t attempts_in_doubles = 4;
      for (std::size_t attempt = 0; attempt < attempts_in_doubles && !found; ++attempt)
        found = numbers_by_doubles(tree, i, attempt);
      for (std::size_t attempt = 0; !found; ++attempt) found = numbers_by_integers(tree, i, attempt);
      numbers[i] = std::move(*found);
    });
    for_each_below(faces_.size(), 1000, workers_, [&](std::size_t i) { check_fate(i, numbers[least[i]]); });
  }

  void check_fate(std::size_t i, const Numbers& front) const {
    const Solid_certificate::Fragment& fragment = claim_.fragments[i];
    if (!std::equal(front.begin(), front.end(), fragment.front.begin(), fragment.front.end(),
                    [](const auto& a, const auto& b) { return a.first == b.first && a.second == b.second; }))
      reject("before " + name("fragment", i) + " the solids wind round otherwise than it says", {i});
    Numbers behind = front;
    for (const Solid_certificate::Part& part : fragment.parts) add_step(behind, part.operand, part.turned ? -1 : 1);
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
  void check_result(const Polygon_soup& result) {
    // 1. Faces that are a fragment, corner by corner, are what is kept of that.
    std::vector<std::pair<Number, std::size_t>> kept;  // by least number
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (times(i) != 0) kept.emplace_back(*std::min_element(faces_[i].numbers.begin(), faces_[i].numbers.end()), i);
    std::sort(kept.begin(), kept.end());
    std::vector<bool> is_found(faces_.size());
    std::vector<Number> reversed;
    const auto is_kept = [&](const std::vector<Number>& loop) {
      reversed.assign(loop.rbegin(), loop.rend());
      const Number least = *std::min_element(loop.begin(), loop.end());
      for (auto at = std::lower_bound(kept.begin(), kept.end(), std::pair(least, std::size_t{0}));
           at != kept.end() && at->first == least; ++at) {
        const std::size_t i = at->second;
        if (is_found[i] || !is_rotation(times(i) > 0 ? loop : reversed, faces_[i].numbers)) continue;
        is_found[i] = true;
        return true;
      }
      return false;
    };
    // 2. The others are, plane by plane, what is left.
    std::map<Homogeneous, Numbered_chain> planes;
    for (Face_id f = 0; f < result.face_count(); ++f) {
      std::vector<std::vector<Number>> loops(result.loop_count(f));
      for (std::size_t k = 0; k < loops.size(); ++k)
        for (const Point_id p : result.loop(f, k)) loops[k].push_back(result_numbers_.at(p));
      if (loops.size() == 1 && !loops[0].empty() && is_kept(loops[0])) continue;
      Polygon outer;
      for (const Number p : loops[0]) outer.push_back(points_[p]);
      const Integer_vector normal = newell_normal(outer);
      if (is_zero(normal)) reject("a face of the result has no area");
      const Homogeneous plane = plane_of(Plane{normal, outer[0]});
      for (const std::vector<Number>& loop : loops)
        for (const Number p : loop)
          if (side(plane, homogeneous(points_[p])) != 0)
            reject("a face of the result is not planar near " + name(points_[p]));
      const Face face(result, f);  // its holes run against its outer loop
      if (self_intersecting(face))
        reject(name("face", f) + " of the result crosses itself, or winds round some of it otherwise than once");
      for (const Polygon& loop : face.loops) planes[plane].add(points_.add(loop), 1);
    }
    for (const auto& [least, i] : kept) {
      if (is_found[i]) continue;
      Homogeneous plane = faces_[i].plane;
      if (times(i) < 0)
        for (Integer& n : plane) n = -n;
      planes[plane].add(faces_[i].numbers, -times(i));
    }
    for (const auto& [plane, chain] : planes)
      if (const auto point = chain.nonzero(points_)) reject("the result is not what is kept, near " + name(*point));
  }

  std::span<const Polygon_soup> operands_;
  const Solid_certificate& claim_;
  const Verify_options& options_;
  const char operation_;  // its name's first letter
  const bool is_positive_, is_nonzero_;
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
