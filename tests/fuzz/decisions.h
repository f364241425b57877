#pragma once
// Trees of on-view tests against all trees, by sets of views; the views of some planes against eyes anywhere; and eyes
// of objects that move.

#include "refusals.h"
#include "support.h"

#include <sightline/algorithms/cutset/decision_tree.h>
#include <sightline/algorithms/cutset/motion.h>
#include <sightline/algorithms/cutset/view_cells.h>
#include <sightline/harness/generate/random.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fuzz {

/// The least weight of tests that tells a set of views apart: of each face that does tell some apart, that of both
/// parts. Views are bits of the set.
class Least_tests {
 public:
  explicit Least_tests(std::vector<std::pair<std::uint32_t, Rational>> views) : views_(std::move(views)) {}

  std::uint32_t everything() const { return (1u << views_.size()) - 1; }
  Rational all() { return of(everything()); }

  /// The views of a set that have the face.
  std::uint32_t with(std::uint32_t set, unsigned face) const {
    std::uint32_t on = 0;
    for (std::size_t v = 0; v < views_.size(); ++v) on |= (set >> v & views_[v].first >> face & 1) << v;
    return on;
  }
  /// The lowest face that a best tree of the set may test.
  unsigned lowest(std::uint32_t set) {
    std::optional<std::pair<Rational, unsigned>> best;
    for (unsigned face = 0; face < 32; ++face) {
      const std::uint32_t on = with(set, face);
      if (on == 0 || on == set) continue;
      const std::pair<Rational, unsigned> cost(of(on) + of(set & ~on), face);
      if (!best || cost < *best) best = cost;
    }
    return best->second;
  }

 private:
  const Rational& of(std::uint32_t set) {
    const auto [place, is_new] = known_.try_emplace(set);
    if (!is_new || (set & (set - 1)) == 0) return place->second;
    std::optional<Rational> least;
    for (unsigned face = 0; face < 32; ++face) {
      const std::uint32_t on = with(set, face);
      if (on == 0 || on == set) continue;
      const Rational cost = of(on) + of(set & ~on);
      if (!least || cost < *least) least = cost;
    }
    Rational weight = 0;
    for (std::size_t v = 0; v < views_.size(); ++v)
      if ((set >> v & 1) != 0) weight += views_[v].second;
    return known_[set] = weight + *least;
  }

  std::vector<std::pair<std::uint32_t, Rational>> views_;
  std::map<std::uint32_t, Rational> known_;
};

/// Of any binary tree, by taking the two least together.
inline Rational least_of_binary_trees(std::multiset<Rational> weights) {
  Rational sum = 0;
  while (weights.size() > 1) {
    const Rational both = *weights.begin() + *std::next(weights.begin());
    weights.erase(weights.begin(), std::next(weights.begin(), 2));
    weights.insert(both);
    sum += both;
  }
  return sum;
}

inline void try_tests(Bytes& from) {
  const bool many = from.below(48) == 0;  // so that more sets of views are searched than there is room for at first
  generate::Random random(from.word());
  const unsigned faces = many ? 11 : 1 + static_cast<unsigned>(from.below(from.below(4) == 0 ? 32 : 6));
  const bool long_weights = from.below(4) == 0;
  std::vector<Weighted_view> given;
  std::map<std::uint32_t, Rational> weights;
  Rational total = 0;
  for (std::size_t k = many ? 26 : 1 + from.below(9); k > 0; --k) {
    const std::uint32_t view =
        static_cast<std::uint32_t>((many ? random.below(1u << 30) : from.word()) & ((std::uint64_t{1} << faces) - 1));
    Rational weight(abs(from.integer(long_weights ? 64 : 5)), 1 + from.below(4));
    weight.canonicalize();
    given.push_back({view, weight});
    weights[view] += weight;
    total += weight;
  }
  const auto built = [&](std::size_t most_states) -> std::optional<Decision_tree> {
    try {
      return least_tests(given, faces, most_states);
    } catch (const std::length_error&) {
      return std::nullopt;
    } catch (const std::invalid_argument&) {
      require(total == 0, "views of some weight have a tree");
      return std::nullopt;
    }
  };
  const std::optional<Decision_tree> tree = built(1000000);
  require(tree.has_value() == (total != 0), "views of some weight have a tree, and no others");
  if (!tree) return;
  const auto more = built(tree->states);
  require(more && more->steps.size() == tree->steps.size(), "as many states as were searched are enough");
  require(tree->states == 0 || !built(tree->states - 1), "fewer states than were searched are not");

  std::multiset<Rational> ends;
  Rational expected = 0;
  for (const auto& [view, weight] : weights) {
    ends.insert(weight);
    unsigned tests = 0;
    std::uint32_t asked = 0;
    const std::uint32_t found = tree->run(
        [&, on_view = view](std::uint32_t face) {
          require(face < faces && (asked >> face & 1) == 0, "each face is tested once");
          asked |= 1u << face;
          return (on_view >> face & 1) != 0;
        },
        &tests);
    require(found == view, "tests of a view end at it");
    require(tree->run([on_view = view](std::uint32_t face) { return (on_view >> face & 1) != 0; }) == view,
            "so they do where nobody counts them");
    expected += weight * tests;
  }
  require(tree->views.size() == weights.size(), "each view is one end");
  require(tree->steps.size() + 1 == weights.size(), "each test has two answers");
  require(tree->expected == Rational(expected / total), "the expected number of tests is that of its paths");
  Least_tests least({weights.begin(), weights.end()});
  require(tree->expected == Rational(least.all() / total), "no tree of tests expects fewer");
  const auto descend = [&](const auto& self, std::uint32_t at, std::uint32_t set) -> void {
    if ((at & Decision_tree::leaf) != 0) return;
    const auto& [face, on, off] = tree->steps[at];
    require(face == least.lowest(set), "of best trees the one is taken that tests the lowest face");
    self(self, on, least.with(set, face));
    self(self, off, set & ~least.with(set, face));
  };
  descend(descend, tree->steps.empty() ? Decision_tree::leaf : 0, least.everything());
  require(tree->bound == Rational(least_of_binary_trees(ends) / total), "the bound is that of any binary tree");
}

/// What is refused: too many faces, faces beyond them, weights below zero.
inline void try_refused_views(Bytes& from) {
  const unsigned faces = static_cast<unsigned>(from.below(40));
  std::vector<Weighted_view> views;
  bool right = faces <= 32, has_weight = false;
  for (std::size_t k = 1 + from.below(3); k > 0; --k) {
    const std::uint32_t on_view = from.below(2) == 0 ? static_cast<std::uint32_t>(from.below(8)) : 1u << from.below(32);
    const Rational weight(static_cast<long>(from.below(8)) - (from.below(4) == 0 ? 4 : 0));
    views.push_back({on_view, weight});
    for (unsigned face = faces; face < 32; ++face) right = right && (on_view >> face & 1) == 0;
    right = right && weight >= 0;
    has_weight = has_weight || weight > 0;
  }
  std::string why;
  try {
    least_tests(views, faces, 1000000);
  } catch (const std::invalid_argument& error) {
    why = error.what();
  }
  require(why.empty() == (right && has_weight), "views are refused iff faces or weights are out of bounds");
  if (!why.starts_with("a view of face")) return;
  const auto is_named = [&](const Weighted_view& view) {
    const std::string face = std::to_string(std::bit_width(view.on_view) - 1);
    return why == "a view of face " + face + ", of " + std::to_string(faces);
  };
  require(std::any_of(views.begin(), views.end(), is_named), "what is refused is a face of a view");
}

inline void try_views(Bytes& from) {
  std::vector<std::array<Rational, 4>> planes;
  for (std::size_t k = 1 + from.below(6); k > 0; --k) {
    std::array<Rational, 4> h;
    for (Rational& x : h) x = from.integer(2);
    if (h[0] == 0 && h[1] == 0 && h[2] == 0) h[from.below(3)] = 1;
    if (!planes.empty() && from.below(4) == 0) {  // one more of the same direction, or the same one
      h = planes.back();
      if (from.below(2) == 0) h[3] += 1;
      if (from.below(2) == 0)
        for (Rational& x : h) x = -x;
    }
    planes.push_back(h);
  }
  const auto value = [&](std::size_t k, const Exact_point& p) {
    return Rational(planes[k][0] * p[0] + planes[k][1] * p[1] + planes[k][2] * p[2] + planes[k][3]);
  };
  const auto seen_from = [&](const Exact_point& p) {
    std::uint32_t set = 0;
    for (std::size_t k = 0; k < planes.size(); ++k) set |= static_cast<std::uint32_t>(value(k, p) > 0) << k;
    return set;
  };
  std::map<std::uint32_t, bool> open;  // by set
  std::vector<std::array<Rational, 4>> worse = planes;
  worse.insert(worse.begin() + static_cast<std::ptrdiff_t>(from.below(worse.size() + 1)), {0, 0, 0, 1});
  require(is_refused<std::invalid_argument>([&] { view_cells(worse); }), "a plane without a normal is refused");
  const std::vector<View_cell> cells = view_cells(planes);
  const bool with_inside = from.below(2) == 0;
  std::size_t listed = 0;
  for (const Weighted_view& view : uniform_likelihood(cells, with_inside)) {
    const auto cell =
        std::find_if(cells.begin(), cells.end(), [&](const View_cell& one) { return one.on_view == view.on_view; });
    require(cell != cells.end() && view.weight == (cell->on_view != 0 && cell->open ? 1 : 0),
            "open views that show a face are as likely as each other, others not likely at all");
    ++listed;
  }
  require(listed ==
              static_cast<std::size_t>(std::count_if(
                  cells.begin(), cells.end(), [&](const View_cell& cell) { return with_inside || cell.on_view != 0; })),
          "each view has its likelihood");
  for (const View_cell& cell : cells) {
    require(open.emplace(cell.on_view, cell.open).second, "a view is listed once");
    require(seen_from(cell.sample) == cell.on_view && on_view_from(planes, cell.sample) == cell.on_view,
            "a view's sample has it");
    for (std::size_t k = 0; k < planes.size(); ++k)
      require(!cell.open || value(k, cell.sample) != 0, "an open view's sample is off all planes");
  }
  // Eyes: anywhere, and where three of the planes meet, or near that.
  std::vector<Exact_point> eyes;
  for (std::size_t k = 0; k < 12; ++k)
    eyes.push_back({Rational(from.integer(3)), Rational(from.integer(3)), Rational(from.integer(3)) / 2});
  for (std::size_t k = 0; k < 12; ++k) {
    std::array<std::array<Rational, 4>, 3> h;
    for (auto& row : h) row = planes[from.below(planes.size())];
    const auto minor = [&](std::size_t i, std::size_t j, std::size_t l) {
      return Rational(h[0][i] * (h[1][j] * h[2][l] - h[1][l] * h[2][j]) -
                      h[0][j] * (h[1][i] * h[2][l] - h[1][l] * h[2][i]) +
                      h[0][l] * (h[1][i] * h[2][j] - h[1][j] * h[2][i]));
    };
    const Rational w = minor(0, 1, 2);
    if (w == 0) continue;
    Exact_point p{Rational(-minor(3, 1, 2) / w), Rational(-minor(0, 3, 2) / w), Rational(-minor(0, 1, 3) / w)};
    if (from.below(2) == 0)
      for (Rational& x : p) x += Rational(from.integer(2)) / 64;
    eyes.push_back(p);
  }
  for (const Exact_point& eye : eyes) {
    const auto found = open.find(seen_from(eye));
    require(found != open.end(), "what an eye sees is listed");
    bool is_off = true;
    for (std::size_t k = 0; k < planes.size(); ++k) is_off = is_off && value(k, eye) != 0;
    require(!is_off || found->second, "what an eye off all planes sees is open");
  }
}

/// Moving the object, by q p q* and a translation, takes what an eye is for it back to the eye.
inline void try_motion(Bytes& from) {
  using Quaternion = std::array<Rational, 4>;
  const auto times = [](const Quaternion& a, const Quaternion& b) {
    return Quaternion{Rational(a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3]),
                      Rational(a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2]),
                      Rational(a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1]),
                      Rational(a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])};
  };
  Rigid_motion motion;
  for (Rational& x : motion.quaternion) x = from.integer(3);
  for (Rational& x : motion.translation) x = from.integer(4);
  Viewpoint eye{{Rational(from.integer(4)), Rational(from.integer(4)), Rational(from.integer(4))}, from.below(3) == 0};
  const Quaternion& q = motion.quaternion;
  const Rational size = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  try {
    const Viewpoint seen = motion.seen_from(eye);
    require(size != 0, "zero is no rotation");
    require(seen.at_infinity == eye.at_infinity, "directions stay directions");
    const Quaternion back = times(times(q, {0, seen.at[0], seen.at[1], seen.at[2]}),
                                  {q[0], Rational(-q[1]), Rational(-q[2]), Rational(-q[3])});
    for (std::size_t k = 0; k < 3; ++k)
      require(Rational(back[k + 1] / size) + (eye.at_infinity ? Rational(0) : motion.translation[k]) == eye.at[k],
              "what an eye is for a moved object is moved to the eye");
  } catch (const std::invalid_argument&) {
    require(size == 0, "any quaternion but zero is a rotation");
  }
}

inline void decisions(std::string_view bytes) {
  Bytes from(bytes);
  const std::size_t kind = from.below(8);
  if (kind == 0) try_motion(from);
  else if (kind == 1) try_refused_views(from);
  else if (from.below(2) == 0) try_tests(from);
  else try_views(from);
}

}  // namespace fuzz
