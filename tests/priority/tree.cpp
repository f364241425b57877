// Priority trees and separating planes against the Lemma and plain rationals: what every tree must be, whatever it was
// made of.

#include "../sample.h"
#include "support.h"

#include <sightline/algorithms/priority/tree.h>
#include <sightline/kernel/traits/point_traits.h>

#include <CGAL/Cartesian.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

using namespace priority_test;

namespace {

using test_scenes::least;
using test_scenes::sample;

template <class Traits>
Points corners_of(const Traits& traits, const Convex_polygon<Traits>& polygon) {
  Points points;
  for (const auto& corner : polygon) points.push_back(traits.position(*corner.vertex));
  return points;
}

/// A plane in the file's coordinates: normal . p + offset, positive in front.
struct Equation {
  Exact_point normal;
  Rational offset;
  Rational at_point(const Exact_point& p) const { return dot(normal, p) + offset; }
};
template <class Traits>
Equation equation_of(const Related& scene, const Traits& traits, const Separating_plane& plane) {
  if (plane.is_free())
    return {at(exact(plane.free[0]), exact(plane.free[1]), exact(plane.free[2])), exact(plane.free[3])};
  for (std::uint32_t i = 0; i < scene.flats.size(); ++i)
    if (const Plane support = traits.supporting_plane(i); support.id() == plane.face.id()) {
      const Flat& flat = scene.flats[i];
      const Exact_point normal = along(at(0, 0, 0), support.flipped() == plane.face.flipped() ? 1 : -1, flat.normal);
      return {normal, -dot(normal, flat.corners[0])};
    }
  throw std::logic_error("a plane of no face");
}
/// Which sides of it corners are on: bit 1 behind, bit 2 in front, 0 all on it, as in Position; and whether any is on
/// it.
struct Lies {
  int sides = 0;
  bool touches = false;
};
Lies where(const Points& points, const Equation& plane) {
  Lies lies;
  for (const Exact_point& p : points) {
    const int side = sgn(plane.at_point(p));
    lies.sides |= side < 0 ? 1 : side > 0 ? 2 : 0;
    lies.touches |= side == 0;
  }
  return lies;
}

/// The Lemma's arcs. Doubles tell the signs that are far from 0, rationals the others.
Matrix all_arcs(const Flats& flats) {
  struct Rounded {
    std::array<double, 3> normal;
    double offset;
    std::vector<std::array<double, 3>> corners;
  };
  const auto rounded = [](const Exact_point& p) { return std::array{p[0].get_d(), p[1].get_d(), p[2].get_d()}; };
  std::vector<Rounded> all;
  for (const Flat& flat : flats) {
    all.push_back({rounded(flat.normal), dot(flat.normal, flat.corners[0]).get_d(), {}});
    for (const Exact_point& p : flat.corners) all.back().corners.push_back(rounded(p));
  }
  const std::size_t n = flats.size();
  Matrix sides(n, std::vector<char>(n)),
      arcs(n, std::vector<char>(n));  // sides of i to j: bit 1 behind, bit 2 in front
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < flats[i].corners.size(); ++k) {
        double value = -all[j].offset, size = std::abs(value);
        for (std::size_t a = 0; a < 3; ++a) {
          value += all[j].normal[a] * all[i].corners[k][a];
          size += std::abs(all[j].normal[a] * all[i].corners[k][a]);
        }
        const int side =
            std::abs(value) > 1e-12 * size ? (value > 0) - (value < 0) : sgn(flats[j].height(flats[i].corners[k]));
        sides[i][j] = static_cast<char>(sides[i][j] | (side < 0 ? 1 : side > 0 ? 2 : 0));
      }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) arcs[i][j] = (sides[i][j] & 2) != 0 && (sides[j][i] & 1) != 0;
  return arcs;
}

/// Whether the insides of convex polygons of one plane are apart: then an edge of one keeps the other outside.
bool apart(const Flat& a, const Flat& b) {
  const auto by_edge_of = [](const Flat& f, const Flat& other) {
    for (std::size_t k = 0; k < f.corners.size(); ++k) {
      const Exact_point inward = cross(f.normal, minus(f.corners[(k + 1) % f.corners.size()], f.corners[k]));
      if (std::all_of(other.corners.begin(), other.corners.end(),
                      [&](const Exact_point& p) { return dot(inward, minus(p, f.corners[k])) <= 0; }))
        return true;
    }
    return false;
  };
  return by_edge_of(a, b) || by_edge_of(b, a);
}

/// Everything that holds for every tree. Adds up what trees are made of.
template <class Traits>
class Laws {
 public:
  using Tree = Priority_tree<Traits>;
  Priority_tree_counters sum;
  std::size_t empty_sides = 0, nested = 0, cut_pieces = 0, touching = 0;

  ::testing::AssertionResult hold(const Related& scene, const Traits& traits, const Priority_tree_options& options,
                                  const Tree& tree) {
    flats_.clear();
    for (const auto& polygon : tree.polygons) flats_.emplace_back(corners_of(traits, polygon));
    arcs_ = all_arcs(flats_);
    for (Result law :
         {nodes(scene, traits, tree), polygons(scene, traits, options, tree), counters(scene, options, tree)})
      if (!law) return law << (options.two_sided ? ", both sides" : "") << (options.split ? ", cut" : "");
    return testing::AssertionSuccess();
  }

 private:
  using Result = ::testing::AssertionResult;
  using Members = std::vector<std::uint32_t>;
  using Node = typename Tree::Node;

  static Result fails() { return testing::AssertionFailure(); }

  Result counters(const Related& scene, const Priority_tree_options& options, const Tree& tree) {
    const Priority_tree_counters& c = tree.counters;
    if (c.pieces != scene.flats.size() * (options.two_sided ? 2 : 1)) return fails() << c.pieces << " pieces";
    if (c.polygons != members_.size() || c.polygons != c.pieces + c.splits)
      return fails() << c.polygons << " polygons, " << c.splits << " splits";
    if (c.by_number + c.by_plane + c.left != c.polygons) return fails() << "the ways do not add up";
    if (c.by_plane != on_planes_ || c.left != in_cycles_)
      return fails() << c.by_plane << " by plane, not " << on_planes_ << "; " << c.left << " left, not " << in_cycles_;
    if (!options.split && (c.splits != 0 || c.cutting_planes != 0)) return fails() << "cuts";
    if (options.split && (c.left != 0 || c.cycles != 0)) return fails() << c.left << " left";
    if (c.splits > 0 && c.cutting_planes == 0)
      return fails() << c.cutting_planes << " cutting planes, " << c.splits << " splits";
    if (c.sequences != kinds_[0] || c.planes != kinds_[1] || c.cycles != kinds_[2] || c.free_planes != free_)
      return fails() << "nodes by kind";
    sum.by_number += c.by_number;
    sum.by_plane += c.by_plane;
    sum.left += c.left;
    sum.splits += c.splits;
    sum.cutting_planes += c.cutting_planes;
    sum.sequences += c.sequences;
    sum.planes += c.planes;
    sum.cycles += c.cycles;
    sum.free_planes += c.free_planes;
    return testing::AssertionSuccess();
  }

  /// Each in the tree is a part of its piece, seen from the side it says, and the parts tile the piece.
  Result polygons(const Related& scene, const Traits& traits, const Priority_tree_options& options, const Tree& tree) {
    if (tree.turned.size() != tree.polygons.size() || tree.two_sided != options.two_sided) return fails() << "turned";
    std::map<std::pair<std::uint32_t, bool>, std::vector<std::uint32_t>> parts;
    for (const std::uint32_t p : members_) parts[{tree.polygons[p].piece, tree.turned[p] != 0}].push_back(p);
    if (parts.size() != scene.flats.size() * (options.two_sided ? 2 : 1))
      return fails() << parts.size() << " sides of pieces";
    for (const auto& side : parts) {
      const Flat& piece = scene.flats.at(side.first.first);
      const bool turned = side.first.second;
      const Plane support = traits.supporting_plane(side.first.first);
      if (turned && !options.two_sided) return fails() << "a back";
      Exact_point area{0, 0, 0};
      for (const std::uint32_t p : side.second) {
        const Flat& part = flats_[p];
        area = along(area, turned ? -1 : 1, part.normal);
        if (tree.polygons[p].support != (turned ? support.opposite() : support)) return fails() << "support of " << p;
        if ((dot(part.normal, piece.normal) < 0) != turned || dot(part.normal, part.normal) == 0)
          return fails() << "the side of " << p;
        for (const Exact_point& q : part.corners)
          if (piece.height(q) != 0 || piece.holds(q) < 0)
            return fails() << "polygon " << p << " is no part of its piece";
        for (const Exact_point& q : part.corners)
          if (part.holds(q) != 0) return fails() << "polygon " << p << " is not convex";
        for (const std::uint32_t other : side.second)
          if (other < p && !apart(part, flats_[other]))
            return fails() << "polygons " << p << " and " << other << " overlap";
      }
      if (area != piece.normal) return fails() << "parts do not fill piece " << side.first.first;
      if (side.second.size() == 1 &&
          !std::is_permutation(piece.corners.begin(), piece.corners.end(), flats_[side.second[0]].corners.begin(),
                               flats_[side.second[0]].corners.end()))
        return fails() << "piece " << side.first.first << " has other corners";
      cut_pieces += side.second.size() > 1;
    }
    return testing::AssertionSuccess();
  }

  Result nodes(const Related& scene, const Traits& traits, const Tree& tree) {
    scene_ = &scene;
    traits_ = &traits;
    tree_ = &tree;
    seen_.assign(tree.polygons.size(), 0);
    reached_.assign(tree.nodes.size(), 0);
    kinds_ = {};
    on_planes_ = in_cycles_ = free_ = 0;
    members_.clear();
    Result result = below(tree.slots.at(0), members_, 0);
    if (!result) return result;
    // Every polygon once, but those that were cut, which stay in the list.
    if (std::any_of(seen_.begin(), seen_.end(), [](int times) { return times > 1; }))
      return fails() << "a polygon twice";
    if (members_.size() + tree.counters.splits != tree.polygons.size())
      return fails() << members_.size() << " polygons in the tree, of " << tree.polygons.size();
    if (std::count(reached_.begin(), reached_.end(), 1) != static_cast<std::ptrdiff_t>(reached_.size()))
      return fails() << "not each node once";
    return result;
  }

  /// Appends the polygons below a slot, and checks the nodes.
  Result below(typename Tree::Slot slot, Members& members, std::size_t depth) {
    if (slot == Tree::nothing) return testing::AssertionSuccess();
    if (slot >= 0) {
      ++seen_.at(static_cast<std::size_t>(slot));
      members.push_back(static_cast<std::uint32_t>(slot));
      return testing::AssertionSuccess();
    }
    ++reached_.at(static_cast<std::size_t>(~slot));
    const Node& node = tree_->nodes[static_cast<std::size_t>(~slot)];
    ++kinds_[static_cast<std::size_t>(node.kind)];
    nested += depth > 2;
    std::vector<Members> children;
    for (const auto child : tree_->slots_of(node)) {
      children.emplace_back();
      if (Result result = below(child, children.back(), depth + 1); !result) return result;
      members.insert(members.end(), children.back().begin(), children.back().end());
    }
    return node.kind == Tree::Kind::sequence ? sequence(children)
           : node.kind == Tree::Kind::plane  ? plane(node, children)
                                             : cycle(node, children);
  }
  Result sequence(const std::vector<Members>& children) const {
    if (children.size() < 2) return fails() << "a sequence of " << children.size();
    for (std::size_t early = 0; early < children.size(); ++early)
      for (std::size_t late = early + 1; late < children.size(); ++late)
        for (const std::uint32_t i : children[late])
          for (const std::uint32_t j : children[early])
            if (arcs_[i][j]) return fails() << i << " may obscure " << j << ", which has priority";
    return testing::AssertionSuccess();
  }
  Result plane(const Node& node, const std::vector<Members>& children) {
    if (children.size() < 2) return fails() << "a plane node of " << children.size();
    const Equation h = equation_of(*scene_, *traits_, node.plane);
    free_ += node.plane.is_free();
    empty_sides += children[0].empty() || children[1].empty();
    for (std::size_t k = 0; k < children.size(); ++k) {
      const int expected = k == 0 ? 1 : k == 1 ? 2 : 0;
      if (k > 1 && children[k].size() != 1) return fails() << "no polygon on a plane";
      on_planes_ += k > 1;
      for (const std::uint32_t p : children[k]) {
        const Lies lies = where(flats_[p].corners, h);
        if (lies.sides != expected)
          return fails() << "polygon " << p << ", sides " << lies.sides << " of a plane, not " << expected;
        if (node.plane.is_free() && lies.touches) return fails() << "polygon " << p << " touches a free plane";
        touching += k < 2 && lies.touches;
      }
    }
    Predicate_counts counts;  // the side of eyes: corners, and one in the plane
    const Exact_point corner = flats_[0].corners[0],
                      foot = along(corner, -h.at_point(corner) / dot(h.normal, h.normal), h.normal);
    for (const Exact_point& eye : {corner, foot, along(foot, 1, h.normal), along(foot, -1, h.normal)})
      if (side_of(*traits_, node.plane, eye, traits_->eye(eye), counts) != sgn(h.at_point(eye)))
        return fails() << "the side of an eye";
    return testing::AssertionSuccess();
  }
  Result cycle(const Node& node, const std::vector<Members>& children) {
    Matrix among(children.size(), std::vector<char>(children.size()));
    in_cycles_ += children.size();
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (children[i].size() != 1 || tree_->slots_of(node)[i] < 0) return fails() << "no polygon in a cycle";
      for (std::size_t j = 0; j < children.size(); ++j)
        among[i][j] = arcs_[children[i][0]][tree_->slots_of(node)[j] < 0 ? 0 : children[j].at(0)];
    }
    if (children.size() < 2 || components_by_closure(among).size() != 1)
      return fails() << "a cycle node that is no component";
    return testing::AssertionSuccess();
  }

  Flats flats_;
  Matrix arcs_;
  Members members_;  // below the root
  const Related* scene_ = nullptr;
  const Traits* traits_ = nullptr;
  const Tree* tree_ = nullptr;
  std::vector<int> seen_, reached_;
  std::array<std::size_t, 3> kinds_{};
  std::size_t on_planes_ = 0, in_cycles_ = 0, free_ = 0;
};

using Exact_laws = Laws<Exact_traits>;
using Grown = Priority_tree<Exact_traits>;

const std::array<Priority_tree_options, 4> all_options{
    {{false, false, {}}, {true, false, {}}, {false, true, {}}, {true, true, {}}}};

/// All of a tree in words, but for memory.
template <class Traits>
std::string in_words(const Traits& traits, const Priority_tree<Traits>& tree) {
  std::string words;
  const auto say = [&](const auto& x) { words += testing::PrintToString(x) + ' '; };
  for (const auto& node : tree.nodes) {
    say(static_cast<int>(node.kind));
    say(node.plane.free);
    say(node.plane.face.id());
    say(node.plane.face.flipped());
    say(node.first);
    say(node.count);
  }
  say(tree.slots);
  say(tree.turned);
  for (const auto& polygon : tree.polygons) {
    say(polygon.piece);
    for (const Exact_point& p : corners_of(traits, polygon))
      words += to_string(p[0]) + ' ' + to_string(p[1]) + ' ' + to_string(p[2]) + ';';
  }
  return words;
}

TEST(Priority_tree, keeps_all_laws_on_degenerate_scenes_with_one_or_both_sides_cut_or_whole) {
  Exact_laws laws;
  for (std::uint64_t k = 0; k < sample(1200u); ++k) {
    const Related scene(degenerate_soup(k));
    for (const std::size_t kind : {k / 32 % 2, 3 - k / 32 % 2})  // two of the four
      ASSERT_TRUE(
          laws.hold(scene, scene.traits, all_options[kind], build_priority_tree(scene.traits, all_options[kind])))
          << "scene " << k;
  }
  EXPECT_GT(laws.sum.sequences, least(1000u));
  EXPECT_GT(laws.sum.planes, least(1000u));
  EXPECT_GT(laws.sum.cycles, least(500u));
  EXPECT_GT(laws.sum.free_planes, least(100u));
  EXPECT_GT(laws.sum.cutting_planes, least(500u));
  EXPECT_GT(laws.sum.by_plane, least(1000u));
  EXPECT_GT(laws.sum.by_number, least(1000u));
  EXPECT_GT(laws.cut_pieces, least(500u));
  EXPECT_GT(laws.touching, least(1000u)) << "polygons that touch the plane they are beside";
  EXPECT_GT(laws.nested, least(100u));
}

TEST(Priority_tree, keeps_all_laws_on_scenes_of_each_kind_and_cities_are_settled_without_a_cut) {
  const std::vector<std::pair<const char*, std::size_t>> scenes{
      {"city", 40}, {"city_rotated", 40}, {"rooms", 1},           {"bars", 5},         {"crossing", 6}, {"lattice", 3},
      {"soup", 80}, {"terrain", 100},     {"convex_sphere", 200}, {"menger_sponge", 1}};
  for (const auto& [kind, full] : scenes) {
    const std::size_t size = test_scenes::is_sanitized() ? std::min(full, 3 + full / 12) : full;
    const Related scene(generate::make(kind, size, 1));
    Exact_laws laws;
    for (const Priority_tree_options& options : all_options) {
      const Grown tree = build_priority_tree(scene.traits, options);
      EXPECT_TRUE(laws.hold(scene, scene.traits, options, tree)) << kind;
      if (std::string_view(kind).starts_with("city")) {
        EXPECT_EQ(tree.counters.left + tree.counters.splits, 0u) << kind;
        EXPECT_GT(tree.counters.planes, 0u) << kind;
      }
    }
    EXPECT_EQ(laws.sum.cycles > 0, laws.sum.splits > 0) << kind;
  }
}

TEST(Priority_tree, is_the_same_every_time_and_of_its_own_polygons) {
  std::size_t long_words = 0;
  for (std::uint64_t k = 0; k < 120; k += test_scenes::is_sanitized() ? 17 : 1) {
    const Related scene(k < 119 ? degenerate_soup(k) : generate::make("soup", 40, 1));
    for (const Priority_tree_options& options : all_options) {
      const std::string words = in_words(scene.traits, build_priority_tree(scene.traits, options));
      ASSERT_EQ(words, in_words(scene.traits, build_priority_tree(scene.traits, options))) << "scene " << k;
      long_words += words.size() > 500;
      if (options.split) continue;
      Polygon_store<Exact_traits> store;
      std::vector<Convex_polygon<Exact_traits>> polygons;
      std::vector<char> turned;
      for (std::uint32_t i = 0; i < scene.traits.piece_count(); ++i) {
        polygons.push_back(store.piece(scene.traits, i));
        turned.push_back(0);
        if (options.two_sided) {
          polygons.push_back(turned_round(polygons.back(), store));
          turned.push_back(1);
        }
      }
      ASSERT_EQ(words, in_words(scene.traits, build_priority_tree(
                                                  scene.traits, std::span<const Convex_polygon<Exact_traits>>(polygons),
                                                  turned, options)))
          << "scene " << k;
    }
  }
  EXPECT_GT(long_words, least(200u));
}

template <class Kernel>
void check_kernel(const Related& scene, std::uint64_t k) {
  const Point_traits<Kernel> traits(scene.scene);
  Laws<Point_traits<Kernel>> laws;
  for (const Priority_tree_options& options : all_options) {
    const auto tree = build_priority_tree(traits, options);
    ASSERT_TRUE(laws.hold(scene, traits, options, tree)) << "scene " << k;
    if (options.split) continue;
    const Grown expected = build_priority_tree(scene.traits, options);
    EXPECT_EQ(tree.slots, expected.slots) << "scene " << k;
    EXPECT_EQ(tree.nodes.size(), expected.nodes.size()) << "scene " << k;
  }
}
TEST(Priority_tree, keeps_all_laws_under_other_exact_kernels) {
  for (std::uint64_t k = 0; k < test_scenes::sample(60u); ++k) {
    const Related scene(degenerate_soup(k + 80000));
    ASSERT_NO_FATAL_FAILURE(check_kernel<CGAL::Epeck>(scene, k));
    ASSERT_NO_FATAL_FAILURE(check_kernel<CGAL::Cartesian<CGAL::Gmpq>>(scene, k));
  }
}

// ---- By hand

std::array<Grown, 4> trees_of(const Related& scene, Exact_laws& laws) {
  std::array<Grown, 4> trees;
  for (std::size_t k = 0; k < 4; ++k) {
    trees[k] = build_priority_tree(scene.traits, all_options[k]);
    EXPECT_TRUE(laws.hold(scene, scene.traits, all_options[k], trees[k]));
  }
  return trees;
}

TEST(Priority_tree, of_three_bars_over_each_other_is_one_cycle_and_cut_has_four_or_five_polygons) {
  const Related scene(generate::bars(3));
  Exact_laws laws;
  const auto trees = trees_of(scene, laws);
  ASSERT_EQ(trees[0].nodes.size(), 1u);
  EXPECT_EQ(trees[0].nodes[0].kind, Grown::Kind::cycle);
  EXPECT_EQ(trees[0].nodes[0].count, 3u);
  EXPECT_EQ(trees[0].counters.left, 3u);
  EXPECT_TRUE(trees[2].counters.polygons == 4 || trees[2].counters.polygons == 5) << trees[2].counters.polygons;
}

TEST(Priority_tree, of_a_body_with_three_blades_leaves_its_long_sides_as_no_plane_parts_them) {
  // That of graph.svg. Each of the three long sides, 0, 3 and 6, runs into the hull of the other two.
  const std::vector<std::array<long, 2>> outline{{1, 0},  {8, 0}, {8, 1},  {3, 1}, {-4, 8},
                                                 {-4, 7}, {0, 3}, {0, -8}, {1, -8}};
  std::vector<Points> walls;
  for (std::size_t k = 0; k < 9; ++k)
    walls.push_back(wall(outline[k][0], outline[k][1], outline[(k + 1) % 9][0], outline[(k + 1) % 9][1]));
  const Related scene(soup_of(walls));
  Exact_laws laws;
  const auto trees = trees_of(scene, laws);
  std::vector<std::vector<Grown::Slot>> cycles;
  for (const auto& node : trees[0].nodes)
    if (node.kind == Grown::Kind::cycle)
      cycles.emplace_back(trees[0].slots_of(node).begin(), trees[0].slots_of(node).end());
  EXPECT_EQ(cycles, (std::vector<std::vector<Grown::Slot>>{{0, 3, 6}}));
  EXPECT_EQ(trees[0].counters.by_number + trees[0].counters.by_plane, 6u);
}

TEST(Priority_tree, of_a_ring_of_four_blades_needs_no_cut_though_its_graph_is_one_cycle) {
  const Related scene(soup_of({wall(4, 2, 9, 2), wall(5, 3, 5, 8), wall(3, 4, -2, 4),
                               wall(2, 3, 2, -2)}));  // two are right of x = 3 1/2, two left of it
  ASSERT_EQ(components_by_closure(arcs_of(scene.flats)).size(), 1u);
  Exact_laws laws;
  for (const Grown& tree : trees_of(scene, laws)) {
    EXPECT_EQ(tree.polygons.size(), tree.two_sided ? 8u : 4u);
    EXPECT_EQ(tree.counters.left, 0u);
    EXPECT_GE(tree.counters.free_planes, 1u);
  }
}

TEST(Priority_tree, of_two_faces_that_cross_is_a_cycle_or_one_cut) {
  const Related scene(soup_of({rectangle(-1, 1, -1, 1, 0), {at(0, -1, -1), at(0, 1, -1), at(0, 1, 1), at(0, -1, 1)}}));
  Exact_laws laws;
  const auto trees = trees_of(scene, laws);
  ASSERT_EQ(trees[0].nodes.size(), 1u);
  EXPECT_EQ(trees[0].nodes[0].kind, Grown::Kind::cycle);
  EXPECT_EQ(trees[1].counters.left, 4u);
  EXPECT_EQ(trees[2].counters.splits, 1u);
}

TEST(Priority_tree, of_no_face_or_one_has_no_node) {
  const Related none(Polygon_soup{}), one(soup_of({rectangle(0, 1, 0, 1, 0)}));
  Exact_laws laws;
  for (const Grown& tree : trees_of(none, laws)) {
    EXPECT_TRUE(tree.nodes.empty());
    EXPECT_EQ(tree.slots, std::vector{Grown::nothing});
  }
  for (const Grown& tree : trees_of(one, laws)) {
    EXPECT_EQ(tree.polygons.size(), tree.two_sided ? 2u : 1u);
    EXPECT_EQ(tree.counters.left, 0u);
    EXPECT_TRUE(tree.two_sided || tree.slots == std::vector<Grown::Slot>{0});
  }
}

// ---- Separating planes

/// Triangles of lattice points on one side of a plane through the origin, at least `gap` away by the values of the
/// normal.
void add_group(std::vector<Points>& faces, const Exact_point& normal, long gap, std::size_t count, int side,
               Random& random) {
  for (std::size_t made = 0; made < count;) {
    Points face;
    while (face.size() < 3) {
      const Exact_point p = lattice_point(random, 6);
      if (Rational(side * dot(normal, p)) >= gap) face.push_back(p);
    }
    const int off =
        sgn(dot(normal, face[0])) * side + sgn(dot(normal, face[1])) * side + sgn(dot(normal, face[2])) * side;
    const Exact_point n = Flat(face).normal;
    if (off > 0 && dot(n, n) != 0) {
      faces.push_back(face);
      ++made;
    }
  }
}

/// What find returns must be true. Returns the size of the larger side, or 0.
std::size_t check_find(const Related& scene, const std::vector<std::uint32_t>& members, std::size_t least,
                       std::size_t directions, Separation_finder<Exact_traits>& finder) {
  Predicate_counts counts;
  const std::optional<Separation> found = finder.find(members, least, directions, counts);
  if (!found) return 0;
  const Equation h = equation_of(scene, scene.traits, found->plane);
  std::vector<std::uint32_t> all;
  for (int side = 0; side < 3; ++side)
    for (const std::uint32_t i : found->sides[static_cast<std::size_t>(side)]) {
      const Lies lies = where(scene.flats[i].corners, h);
      EXPECT_EQ(lies.sides, side) << "member " << i;
      EXPECT_FALSE(found->plane.is_free() && lies.touches) << "member " << i;
      all.push_back(i);
    }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, members);
  EXPECT_GE(std::min(found->sides[1].size(), found->sides[2].size()), least);
  return std::max(found->sides[1].size(), found->sides[2].size());
}

TEST(Separation_finder, finds_planes_that_are_there_and_none_that_cut) {
  std::size_t none = 0, by_face = 0, subsets = 0;
  for (std::uint64_t k = 0; k < 600; ++k) {
    Random random(k);
    Exact_point normal = lattice_point(random, 2);
    const std::size_t axis = random.below(3);
    const bool across_axis = k % 3 == 0, with_face = k % 3 == 1;
    if (across_axis || dot(normal, normal) == 0) {
      normal = at(0, 0, 0);
      normal[axis] = random.chance(1, 2) ? 1 : -3;
    }
    std::vector<Points> faces;
    const std::size_t front = 1 + random.below(6), behind = 1 + random.below(6);
    add_group(faces, normal, with_face ? 0 : 1, front, 1, random);
    add_group(faces, normal, with_face ? 0 : 1, behind, -1, random);
    if (with_face) {
      const Exact_point u = normal[0] == 0 && normal[1] == 0 ? at(1, 0, 0) : at(-normal[1], normal[0], 0);
      faces.push_back({at(0, 0, 0), u, cross(normal, u)});
      if (random.chance(1, 2)) faces.back() = reversed(faces.back());
    }
    random.shuffle(faces);
    const Related scene(moved(soup_of(faces), k % 5 == 3 ? Move::far : k % 5 == 4 ? Move::tiny : Move::none, k));
    ASSERT_EQ(scene.flats.size(), faces.size());
    Separation_finder<Exact_traits> finder(scene.traits);
    Polygon_store<Exact_traits> store;
    std::vector<std::uint32_t> members, some;
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
      finder.add(store.piece(scene.traits, i));
      members.push_back(i);
      if (random.chance(1, 2)) some.push_back(i);
    }
    const std::size_t larger = check_find(scene, members, 1, with_face ? 100 : 1 + random.below(4), finder);
    if (across_axis || with_face) {
      if (with_face && k % 5 == 4) continue;  // where projections round, planes that are touched may be passed over
      ASSERT_GT(larger, 0u) << "case " << k << ": there is one";
      ASSERT_LE(larger, std::max(front, behind)) << "case " << k << ": there is one that divides better";
      by_face += with_face;
    }
    none += larger == 0;
    subsets += check_find(scene, some, 1, 3, finder) > 0;
    check_find(scene, members, 2 + random.below(4), 5, finder);
  }
  EXPECT_GT(none, 10u);
  EXPECT_GT(subsets, 100u);
  EXPECT_GT(by_face, 100u);
}

TEST(Separation_finder, finds_nothing_among_too_few_and_looks_across_the_axes_alone_if_told_to) {
  const Related scene(soup_of({rectangle(0, 1, 0, 1, 0), rectangle(0, 1, 0, 1, 1), rectangle(0, 1, 0, 1, 2)}));
  Separation_finder<Exact_traits> finder(scene.traits);
  Polygon_store<Exact_traits> store;
  for (std::uint32_t i = 0; i < 3; ++i) finder.add(store.piece(scene.traits, i));
  EXPECT_EQ(check_find(scene, {}, 1, 3, finder), 0u);
  EXPECT_EQ(check_find(scene, {1}, 1, 3, finder), 0u);
  EXPECT_EQ(check_find(scene, {0, 2}, 2, 3, finder), 0u);
  EXPECT_EQ(check_find(scene, {0, 2}, 1, 3, finder), 1u);
  EXPECT_EQ(check_find(scene, {0, 1, 2}, 1, 3, finder), 1u) << "the one in the middle is on the plane";
  EXPECT_EQ(check_find(scene, {0, 2}, 1, 0, finder), 1u);
}

}  // namespace
