// Explicit and implicit graphs against arcs by the Lemma and components by transitive closure.

#include "../sample.h"
#include "support.h"

#include <sightline/algorithms/priority/implicit_graph.h>

using namespace priority_test;

namespace {

using test_scenes::least;
using test_scenes::sample;

using Relation = Priority_relation<Exact_traits>;
using Implicit = Implicit_priority_graph<Relation>;

static_assert(Priority_graph<Explicit_priority_graph> && Priority_graph<Implicit>);

/// Whether the trees prove that each component is strongly connected: from its root every member over arcs of one tree,
/// and back over arcs of the other.
testing::AssertionResult prove(const Component_trees& trees, const Priority_components& components,
                               const Matrix& arcs) {
  const std::size_t n = arcs.size();
  if (trees.from.size() != n || trees.to.size() != n)
    return testing::AssertionFailure() << trees.from.size() << " and " << trees.to.size() << " arcs";
  std::vector<std::uint32_t> root(components.size(), static_cast<std::uint32_t>(n));
  for (std::uint32_t face = 0; face < n; ++face)
    for (const bool is_from : {true, false}) {
      const std::vector<std::uint32_t>& tree = is_from ? trees.from : trees.to;
      std::uint32_t at_face = face;
      for (std::size_t steps = 0; tree[at_face] != at_face; ++steps) {
        const std::uint32_t next = tree[at_face];
        if (steps == n) return testing::AssertionFailure() << "a cycle above face " << face;
        if (next >= n || components.h(next) != components.h(face))
          return testing::AssertionFailure() << "face " << at_face << " hangs on " << next << " of another component";
        if (!(is_from ? arcs[next][at_face] : arcs[at_face][next]))
          return testing::AssertionFailure()
                 << "no such arc: " << (is_from ? next : at_face) << " < " << (is_from ? at_face : next);
        at_face = next;
      }
      std::uint32_t& known = root[components.h(face)];
      if (known == n) known = at_face;
      if (known != at_face)
        return testing::AssertionFailure()
               << "two roots of component " << components.h(face) << ": " << known << " and " << at_face;
    }
  return testing::AssertionSuccess();
}

/// Whether the condensation is the graph of arcs between components, each once, each to a higher number (so it has no
/// cycle).
testing::AssertionResult right_condensation(const Arc_graph& condensed, const Priority_components& components,
                                            const Matrix& arcs) {
  std::set<std::pair<std::size_t, std::size_t>> expected, found;
  for (std::uint32_t i = 0; i < arcs.size(); ++i)
    for (std::uint32_t j = 0; j < arcs.size(); ++j)
      if (arcs[i][j] && components.h(i) != components.h(j)) expected.emplace(components.h(i), components.h(j));
  for (const auto& arc : boost::make_iterator_range(boost::edges(condensed))) {
    if (boost::source(arc, condensed) >= boost::target(arc, condensed))
      return testing::AssertionFailure() << "an arc to " << boost::target(arc, condensed);
    found.emplace(boost::source(arc, condensed), boost::target(arc, condensed));
  }
  if (boost::num_vertices(condensed) != components.size())
    return testing::AssertionFailure() << boost::num_vertices(condensed) << " vertices";
  if (found != expected || boost::num_edges(condensed) != expected.size())
    return testing::AssertionFailure() << boost::num_edges(condensed) << " arcs, not " << expected.size();
  return testing::AssertionSuccess();
}

/// Everything about both graphs of a relation whose arcs are known.
void check(const Relation& relation, const Matrix& arcs) {
  const Explicit_priority_graph written(relation);
  const std::uint64_t n = arcs.size();
  ASSERT_EQ(written.size(), n);
  ASSERT_EQ(written.arc_count(), count_arcs(arcs));
  ASSERT_EQ(written.counters().pairs, n * (n - std::min<std::uint64_t>(n, 1)) / 2);
  Implicit searched(relation);
  ASSERT_EQ(searched.size(), n);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      ASSERT_EQ(written.has_arc(i, j), arcs[i][j] != 0) << i << ", " << j;
      ASSERT_EQ(searched.has_arc(i, j), arcs[i][j] != 0) << i << ", " << j;
    }

  const Priority_components by_tarjan = components(written);
  ASSERT_TRUE(right_components(by_tarjan, arcs));
  ASSERT_TRUE(right_condensation(condensation(written.boost_graph(), by_tarjan), by_tarjan, arcs));

  Component_trees trees;
  const Priority_components by_search = searched.find_components(&trees);
  ASSERT_TRUE(right_components(by_search, arcs));
  ASSERT_TRUE(prove(trees, by_search, arcs));
  ASSERT_TRUE(right_condensation(condensation(written.boost_graph(), by_search), by_search, arcs));

  const Priority_components again = components(searched);  // the index forgot nothing for good
  for (std::uint32_t i = 0; i < n; ++i) ASSERT_EQ(again.h(i), by_search.h(i)) << i;
}

TEST(Graph, of_an_empty_scene_has_no_component) {
  const Related scene{Polygon_soup()};
  check(scene.relation, {});
  EXPECT_EQ(components(Explicit_priority_graph(scene.relation)).size(), 0u);
  Implicit searched(scene.relation);
  EXPECT_EQ(components(searched).size(), 0u);
  EXPECT_EQ(components(searched).largest(), 0u);
}

TEST(Graph, of_one_face_has_one_component_and_no_arc) {
  const Related scene(soup_of({rectangle(0, 1, 0, 1, 0)}));
  check(scene.relation, {{0}});
  Implicit searched(scene.relation);
  Component_trees trees;
  const Priority_components found = searched.find_components(&trees);
  EXPECT_EQ(found.size(), 1u);
  EXPECT_EQ(found.cyclic(), 0u);
  EXPECT_EQ(trees.from, std::vector<std::uint32_t>{0});
  EXPECT_EQ(trees.to, std::vector<std::uint32_t>{0});
}

TEST(Graph, of_stacked_squares_has_one_enumeration_from_the_top_down) {
  for (const std::size_t n : {2u, 3u, 17u, 64u}) {
    std::vector<Points> squares;
    for (std::size_t k = 0; k < n; ++k)
      squares.push_back(
          rectangle(0, 1, 0, 1, static_cast<long>(k * 7 % n)));  // heights in another order; 7 divides no n
    const Related scene(soup_of(squares));
    const Explicit_priority_graph written(scene.relation);
    Implicit searched(scene.relation);
    EXPECT_EQ(written.arc_count(), n * (n - 1) / 2);
    for (const Priority_components& found : {components(written), components(searched)})
      for (std::uint32_t k = 0; k < n; ++k) EXPECT_EQ(found.h(k), n - 1 - k * 7 % n) << k << " of " << n;
  }
}

TEST(Graph, explicit_and_implicit_have_the_components_of_the_closure_on_degenerate_scenes) {
  std::size_t cyclic = 0, acyclic = 0, several = 0;
  for (std::uint64_t k = 0; k < sample(2500u); ++k) {
    SCOPED_TRACE(k);
    const Related scene(degenerate_soup(k + 100000));
    const Matrix arcs = arcs_of(scene.flats);
    check(scene.relation, arcs);
    if (HasFatalFailure()) return;
    std::size_t large = 0;
    for (const auto& set : components_by_closure(arcs)) large += set.size() > 1;
    cyclic += large > 0;
    acyclic += large == 0;
    several += large > 1;
  }
  EXPECT_GT(cyclic, least(400u));
  EXPECT_GT(acyclic, least(400u));
  EXPECT_GT(several, least(20u));
}

TEST(Graph, explicit_and_implicit_have_the_components_of_the_closure_where_a_dozen_scenes_are_one) {
  std::size_t faces = 0, several = 0;
  for (std::uint64_t k = 0; k < sample(60u); ++k) {
    SCOPED_TRACE(k);
    Random random(k);
    Polygon_soup all;
    for (int part = 0; part < 12; ++part) {  // side by side, or so far apart that an index can tell them
      const long step = k % 2 == 0 ? 3 : 30;
      const Polygon_soup some =
          generate::translated(touching_soup(random), at(step * random.between(-3, 3), step * random.between(-3, 3),
                                                         k % 3 == 0 ? 0 : step * random.between(-3, 3)));
      for (Face_id f = 0; f < some.face_count(); ++f) {
        Points loop;
        for (const Point_id p : some.loop(f)) loop.push_back(some.point(p));
        add_face(all, loop);
      }
    }
    const Related scene(moved(all, static_cast<Move>(k % 5), k));
    const Matrix arcs = arcs_of(scene.flats);
    check(scene.relation, arcs);
    if (HasFatalFailure()) return;
    const Sets sets = components_by_closure(arcs);
    faces += scene.flats.size();
    several += sets.size() > 1;
  }
  EXPECT_GT(faces, least(2000u));
  EXPECT_GT(several, least(6u));
}

TEST(Graph, explicit_and_implicit_have_the_components_of_the_closure_on_generated_scenes) {
  const std::vector<std::pair<std::string_view, std::size_t>> sizes{
      {"bars", 40},         {"city", 40},
      {"city_rotated", 15}, {"convex_sphere", 200},
      {"crossing", 25},     {"grid", 2},
      {"lattice", 4},       {"menger_sponge_merged", 1},
      {"soup", 150},        {"soup_constant_density", 150},
      {"stacked", 60},      {"terrain", 150}};
  std::size_t largest = 0;
  for (const auto& [kind, size] : sizes) {
    SCOPED_TRACE(kind);
    const Related scene(generate::make(kind, size, 1));
    const Matrix arcs = arcs_of(scene.flats);
    check(scene.relation, arcs);
    if (HasFatalFailure()) return;
    const Priority_components found = components(Explicit_priority_graph(scene.relation));
    largest = std::max(largest, found.largest());
    if (kind == "convex_sphere") {
      EXPECT_EQ(count_arcs(arcs), 0u) << "no face of a convex body hides another";
      EXPECT_EQ(found.size(), scene.flats.size());
    }
    if (kind == "lattice" || kind == "crossing") {
      EXPECT_GT(found.largest(), 2u) << "faces that cross are in a cycle";
    }
    if (kind == "stacked") {
      EXPECT_EQ(found.size(), 60u);
    }
  }
  EXPECT_GT(largest, 100u);
}

TEST(Graph, an_inside_out_convex_body_has_no_arc_either) {
  // From inside, all faces are on-view, and none lies before another.
  const Related scene(generate::faces_reversed(generate::make("convex_sphere", 60, 3)));
  check(scene.relation, Matrix(scene.flats.size(), std::vector<char>(scene.flats.size(), 0)));
}

TEST(Graph, is_right_for_the_fragments_of_a_tree) {
  std::size_t cut = 0;
  for (std::uint64_t k = 0; k < 100; ++k) {
    SCOPED_TRACE(k);
    const Built built(degenerate_soup(k + 200000));
    Priority_relation<Exact_traits> relation(built.traits);
    Flats flats;
    for (const Piece& piece : built.scene.pieces()) flats.emplace_back(built.scene.corner_points(piece));
    for (const Drawn& fragment : built.tree.fragments) {
      relation.add(fragment.polygon);
      flats.emplace_back(built.corners(fragment.polygon));
      cut += fragment.number > 0;
    }
    check(relation, arcs_of(flats));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(cut, 100u);
}

TEST(Graph, an_implicit_search_of_a_city_compares_few_of_all_pairs) {
  const Related scene(generate::make("city", 200, 1));
  Implicit searched(scene.relation);
  const Priority_components found = components(searched);
  const std::uint64_t n = scene.flats.size(), compared = searched.counters().relation.pairs;
  EXPECT_EQ(n, 1001u);
  EXPECT_EQ(found.faces(), n);
  EXPECT_GE(compared, n - found.size()) << "each face but one of a component is reached over an arc that was asked for";
  EXPECT_LT(compared, n * n / 20);
}

}  // namespace
