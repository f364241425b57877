#pragma once
// The cut-set along paths, and the update of 1977, against every face by itself; views of a few planes in spaces of
// one to three dimensions against points on, between and beside these.

#include "soups.h"

#include <sightline/algorithms/cutset/tracker.h>
#include <sightline/algorithms/cutset/update_1977.h>
#include <sightline/algorithms/cutset/view_cells.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

namespace fuzz {

// ---- Scenes and paths

/// The faces of a convex hull of lattice points, fronts outside: every plane through three of them with none in front,
/// its points wound by their angles. None where all are in one plane.
inline generate::Faces hull_of(const std::set<std::array<long, 3>>& points) {
  using Whole = std::array<long, 3>;
  generate::Faces faces;
  std::set<std::set<Whole>> seen;
  for (const Whole& p : points)
    for (const Whole& q : points)
      for (const Whole& r : points) {
        const Whole normal = cross(minus(q, p), minus(r, p));
        if (is_zero(normal)) continue;
        std::set<Whole> on;
        bool front = false, behind = false;
        for (const Whole& s : points) {
          const long height = dot(normal, minus(s, p));
          front |= height > 0;
          behind |= height < 0;
          if (height == 0) on.insert(s);
        }
        if (front || !behind || !seen.insert(on).second) continue;
        // Each corner's successor has all others on its left; of those on a line the farthest has.
        generate::Points face;
        const Whole begin = *on.begin();
        Whole at = begin;
        do {
          face.push_back({Rational(at[0]), Rational(at[1]), Rational(at[2])});
          std::optional<Whole> next;
          for (const Whole& s : on) {
            if (s == at) continue;
            const long turn = next ? dot(normal, cross(minus(*next, at), minus(s, at))) : -1;
            if (turn < 0 || (turn == 0 && dot(minus(s, at), minus(s, at)) > dot(minus(*next, at), minus(*next, at))))
              next = s;
          }
          at = *next;
        } while (at != begin);
        faces.push_back(std::move(face));
      }
  return faces;
}

inline generate::Faces any_hull(Random& random) {
  const std::int64_t reach = random.between(1, 4);
  std::set<std::array<long, 3>> points;
  for (std::uint64_t k = 4 + random.below(6); k > 0; --k) {
    std::array<long, 3> p;
    for (long& x : p) x = static_cast<long>(random.between(-reach, reach));
    points.insert(p);
  }
  return hull_of(points);
}

/// Convex bodies, whole or less a face, and other faces beside them; anywhere, and of any size.
inline Polygon_soup soup_to_walk_about(Random& random) {
  if (random.chance(1, 6)) return soup_of_outlines(1 + random.below(5), random);
  generate::Faces faces;
  for (std::uint64_t k = 1 + random.below(3); k > 0; --k) {
    generate::Faces body = random.chance(1, 3) ? solids(random) : any_hull(random);
    if (body.size() > 4 && random.chance(1, 6)) body.erase(body.begin() + 1);
    const Exact_point place = generate::lattice(random, 5);
    for (generate::Points& face : body)
      for (Exact_point& p : face) p = generate::along(place, 1, p);
    generate::add(faces, body);
  }
  if (random.chance(1, 3)) generate::add_any(faces, 1 + random.below(40), random);
  if (random.chance(1, 4)) faces = of_many_scales(faces, random);
  const std::array<Rational, 2> moves{Rational(1, 3), Rational(100000000)};
  const Rational move = random.chance(1, 4) ? moves[random.below(2)] : Rational(0);
  const Rational scale = random.chance(1, 4) ? generate::power_of_two(random.chance(1, 2) ? -160 : 300) : Rational(1);
  for (generate::Points& face : faces)
    for (Exact_point& p : face) p = {Rational((p[0] + move) * scale), Rational((p[1] - move) * scale), p[2] * scale};
  return generate::soup_of(faces);
}

/// The plane of a node, by its corners alone: where a x + b y + c z + d > 0 it is seen from the front.
using Height = std::array<Rational, 4>;
inline std::vector<Height> heights_of(const Face_graph& graph) {
  std::vector<Height> heights;
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    const auto corners = graph.scene().corners(graph.scene().pieces()[graph.piece(i)]);
    const auto corner = [&](std::size_t k) { return graph.scene().position(corners[k % corners.size()].point); };
    Exact_point normal{0, 0, 0};
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      normal = generate::along(normal, 1, cross(minus(corner(k), corner(0)), minus(corner(k + 1), corner(0))));
    heights.push_back({normal[0], normal[1], normal[2], Rational(-dot(normal, corner(0)))});
  }
  return heights;
}
inline Rational height_of(const Height& h, const Viewpoint& view) {
  return h[0] * view.at[0] + h[1] * view.at[1] + h[2] * view.at[2] + (view.at_infinity ? Rational(0) : h[3]);
}

/// Where to go next: into planes and by a little out of them, to corners, between them, along edges, back, far away, to
/// infinity, also along what the place is from the origin, and from there to the place of a direction's numbers;
/// nowhere.
inline Viewpoint next_view(const Scene& scene, const std::vector<Viewpoint>& path, Random& random) {
  const auto corners = scene.corners(scene.pieces()[random.below(scene.pieces().size())]);
  const std::size_t k = random.below(corners.size());
  const auto corner = [&](std::size_t j) { return scene.position(corners[(k + j) % corners.size()].point); };
  const Exact_point p = corner(0), u = minus(corner(1), p), v = minus(corner(2), p), normal = cross(u, v);
  const Exact_point other = scene.position(static_cast<std::uint32_t>(random.below(scene.points().size())));
  const auto few = [&] { return generate::ratio(static_cast<long>(random.between(-3, 5)), 2); };
  const auto little = [&] {
    static constexpr std::array powers{0, -1, -3, -20, -45, -52, -60, -300};
    return Rational((random.chance(1, 2) ? 1 : -1) * generate::power_of_two(powers[random.below(powers.size())]));
  };
  const Viewpoint here = path.empty() ? Viewpoint{p} : path.back();
  const Exact_point from = here.at_infinity ? other : here.at;
  switch (random.below(12)) {
    case 0: return {p};
    case 1: return {generate::along(p, few(), u)};
    case 2: return {generate::along(generate::along(p, few(), u), few(), v)};
    case 3: return {generate::along(generate::along(generate::along(p, few(), u), few(), v), little(), normal)};
    case 4: return {generate::along(p, few(), minus(other, p))};
    case 5: return {generate::along(from, little(), minus(other, from))};
    case 6: return {generate::centroid({p, corner(1), corner(2), other})};
    case 7: return path.empty() ? here : path[path.size() - 1 - random.below(std::min<std::size_t>(3, path.size()))];
    case 8: {
      static constexpr std::array powers{10, 40, 76, 90, 1000, 1100};
      return {generate::along(p, generate::power_of_two(powers[random.below(powers.size())]), minus(other, from))};
    }
    case 9: {
      Exact_point along = random.chance(1, 2) ? u : random.chance(1, 2) ? normal : minus(other, p);
      if (random.chance(1, 2)) along = generate::along(along, little(), minus(other, p));
      if (is_zero(along)) along[random.below(3)] = -1;
      return {along, true};
    }
    case 10: return {generate::along(from, few(), minus(p, from))};
    default:
      if (is_zero(here.at) || random.chance(1, 2)) return here;
      return {here.at, !here.at_infinity};
  }
}

// ---- The definition

struct View_of_nodes {
  std::vector<bool> on;              ///< by node
  std::vector<std::uint32_t> cut;    ///< edges, ascending
  std::vector<bool> at_cut;          ///< by node: at such an edge
  std::vector<std::uint32_t> shown;  ///< by component: how many nodes are on-view

  View_of_nodes(const Face_graph& graph, std::vector<bool> on_view)
      : on(std::move(on_view)), at_cut(graph.size()), shown(graph.components().size()) {
    for (std::uint32_t e = 0; e < graph.edges().size(); ++e) {
      const auto& [i, j, from, to] = graph.edges()[e];
      if (on[i] == on[j]) continue;
      cut.push_back(e);
      at_cut[i] = at_cut[j] = true;
    }
    for (std::uint32_t i = 0; i < graph.size(); ++i) shown[graph.component(i)] += on[i];
  }
};

inline View_of_nodes seen_from(const Face_graph& graph, const std::vector<Height>& heights, const Viewpoint& view) {
  std::vector<bool> on;
  for (const Height& h : heights) on.push_back(height_of(h, view) > 0);
  return View_of_nodes(graph, std::move(on));
}

/// Clusters of nodes that changed of which none was at the cut-set.
inline std::uint64_t births_between(const Face_graph& graph, const View_of_nodes& before, const View_of_nodes& after) {
  std::uint64_t births = 0;
  std::vector<bool> done(graph.size());
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    if (done[i] || before.on[i] == after.on[i]) continue;
    bool at_cut = false;
    std::vector<std::uint32_t> stack{i};
    done[i] = true;
    while (!stack.empty()) {
      const std::uint32_t at = stack.back();
      stack.pop_back();
      at_cut = at_cut || before.at_cut[at];
      for (const std::uint32_t e : graph.edges_of(at)) {
        const std::uint32_t j = graph.across(e, at);
        if (done[j] || before.on[j] == after.on[j]) continue;
        done[j] = true;
        stack.push_back(j);
      }
    }
    births += !at_cut;
  }
  return births;
}

/// By component, whether nodes on-view before and after have one in common or share an edge.
inline std::vector<bool> kept_in_touch(const Face_graph& graph, const View_of_nodes& before,
                                       const View_of_nodes& after) {
  std::vector<bool> kept(graph.components().size());
  for (std::uint32_t i = 0; i < graph.size(); ++i)
    if (before.on[i] && after.on[i]) kept[graph.component(i)] = true;
  for (const auto& [i, j, from, to] : graph.edges())
    if ((before.on[i] && after.on[j]) || (before.on[j] && after.on[i])) kept[graph.component(i)] = true;
  return kept;
}

inline std::vector<std::uint32_t> ascending(std::vector<std::uint32_t> list) {
  std::sort(list.begin(), list.end());
  return list;
}

// ---- The tracker

inline void check_move(const Face_graph& graph, const Cut_set_tracker<Exact_traits>& tracker,
                       const View_of_nodes& before, const View_of_nodes& after, bool moved) {
  std::vector<std::uint32_t> changed;
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    require(tracker.on_view(i) == after.on[i], "a node is on-view iff the eye is strictly in front of its plane");
    if (before.on[i] != after.on[i]) changed.push_back(i);
  }
  require(tracker.on_view_count() == static_cast<std::size_t>(std::count(after.on.begin(), after.on.end(), true)),
          "as many nodes are on-view as are counted");
  require(ascending(tracker.cut_edges()) == after.cut, "the cut-set is the edges of which one node is on-view");
  require(ascending(tracker.changed()) == changed, "what a move changed is listed, once");
  const Cut_set_counters& last = tracker.last();
  if (!moved) {
    require(last.tests + last.searches + last.compared == 0, "where nothing moves nothing is tested");
    return;
  }
  std::uint64_t searches = 0;
  const std::vector<bool> kept = kept_in_touch(graph, before, after);
  for (std::uint32_t c = 0; c < kept.size(); ++c)
    searches += graph.components()[c].inside && (after.shown[c] == 0 || !kept[c]);
  require(last.searches == searches, "a convex body is searched iff it shows no face, or none that the update finds");
  require(last.changed == changed.size(), "what changed is counted");
  require(last.births == births_between(graph, before, after), "clusters that no cut edge told of are counted");
  require(last.tests <= graph.size() && last.away <= last.tests && last.exact <= last.tests,
          "a move tests a node once");
}

/// A step so short that sixteen of them lead out of no status, a 64th of the distance from the nearest plane; nothing
/// where a plane is near for the scene's size, or the scene for the eye's distance.
inline std::optional<Rational> short_step_at(const Scene& scene, const std::vector<Height>& heights,
                                             const Viewpoint& view) {
  if (view.at_infinity) return std::nullopt;
  Rational size = 0, own_size = 0;
  for (std::uint32_t p = 0; p < scene.points().size(); ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      size = std::max(size, Rational(abs(scene.position(p)[k] - view.at[k])));
      own_size = std::max(own_size, Rational(abs(scene.position(p)[k] - scene.position(0)[k])));
    }
  if (size > own_size * generate::power_of_two(100)) return std::nullopt;
  int halves = 0;
  for (const Height& h : heights) {
    const Rational value = height_of(h, view), square = h[0] * h[0] + h[1] * h[1] + h[2] * h[2];
    for (; halves <= 8; ++halves) {
      const Rational least = size * generate::power_of_two(-halves);
      if (value * value >= least * least * square) break;
    }
  }
  if (halves > 8) return std::nullopt;
  return Rational(size * generate::power_of_two(-halves - 6));
}

inline void try_tracker(Random& random) {
  const Polygon_soup soup = soup_to_walk_about(random);
  const Scene scene(soup);
  if (scene.pieces().empty()) return;
  const Exact_traits traits(scene);
  const Face_graph graph(scene);
  const std::vector<Height> heights = heights_of(graph);
  Cut_set_tracker<Exact_traits> tracker(traits, graph);
  View_of_nodes before(graph, std::vector<bool>(graph.size()));
  std::vector<Viewpoint> path;
  std::uint64_t tests = 0;
  const auto move_to = [&](const Viewpoint& view) {
    tracker.move_to(view);
    View_of_nodes after = seen_from(graph, heights, view);
    const bool stays = !path.empty() && path.back().at == view.at && path.back().at_infinity == view.at_infinity;
    check_move(graph, tracker, before, after, !stays);
    tests += tracker.last().tests;
    require(tracker.counters().tests == tests && tracker.predicates().total() == tests, "each test is counted once");
    before = std::move(after);
    path.push_back(view);
  };
  for (std::uint64_t k = 4 + random.below(12); k > 0; --k) {
    move_to(next_view(scene, path, random));
    if (random.chance(1, 16)) {
      bool thrown = false;
      try {
        tracker.move_to({{0, 0, 0}, true});
      } catch (const std::invalid_argument&) {
        thrown = true;
      }
      require(thrown, "zero is no direction");
    }
    if (!random.chance(1, 6)) continue;
    // What was tested from far away is tested again on the way back, and then holds for a while.
    const Viewpoint here = path.back();
    const std::optional<Rational> step = short_step_at(scene, heights, here);
    if (!step) continue;
    Viewpoint far{{1, 0, 0}, true};
    if (random.chance(1, 2)) far = {generate::along(here.at, *step * generate::power_of_two(70), {1, 1, 1})};
    move_to(far);
    move_to(here);
    for (int steps = 0; steps < 4; ++steps) {
      move_to({generate::along(here.at, *step, generate::lattice(random, 1))});
      require(tracker.last().searches > 0 || tracker.last().tests == 0, "a status holds as long as it is known to");
    }
  }
}

// ---- The update of 1977

inline void try_update_1977(Random& random) {
  const Polygon_soup soup = random.chance(1, 4) ? soup_to_walk_about(random) : generate::soup_of(any_hull(random));
  const Scene scene(soup);
  if (scene.pieces().empty()) return;
  const Exact_traits traits(scene);
  const Face_graph graph(scene);
  const std::vector<Height> heights = heights_of(graph);
  std::vector<Viewpoint> path{next_view(scene, {}, random)};
  for (std::uint64_t k = 1 + random.below(6); k > 0; --k) {
    const Viewpoint from = path.back(), to = next_view(scene, path, random);
    path.push_back(to);
    const View_of_nodes before = seen_from(graph, heights, from), after = seen_from(graph, heights, to);
    // It tests the ends of cut edges, and all neighbours of what changed.
    std::vector<bool> tested = before.at_cut, found = before.on;
    std::vector<std::uint32_t> stack;
    const auto take = [&](std::uint32_t i) {
      found[i] = after.on[i];
      if (before.on[i] != after.on[i]) stack.push_back(i);
    };
    for (std::uint32_t i = 0; i < graph.size(); ++i)
      if (tested[i]) take(i);
    while (!stack.empty()) {
      const std::uint32_t i = stack.back();
      stack.pop_back();
      for (const std::uint32_t e : graph.edges_of(i)) {
        const std::uint32_t j = graph.across(e, i);
        if (tested[j]) continue;
        tested[j] = true;
        take(j);
      }
    }
    const auto tests = static_cast<std::uint64_t>(std::count(tested.begin(), tested.end(), true));
    const View_of_nodes told(graph, found);
    for (const Reading_1977 reading : {Reading_1977::mended, Reading_1977::literal}) {
      Cut_set_1977<Exact_traits> update(traits, graph, from, reading);
      require(ascending(update.cut_edges()) == before.cut, "it begins with the cut-set");
      require(update.update_1977(to) == tests, "the update tests what the paper says, once");
      for (std::uint32_t i = 0; i < graph.size(); ++i)
        require(update.on_view(i) == found[i], "the update finds what its tests tell");
      const std::vector<std::uint32_t> cut = ascending(update.cut_edges());
      if (reading == Reading_1977::mended) {
        require(cut == told.cut, "the cut-set, mended, is that of what was found");
        continue;
      }
      require(std::adjacent_find(cut.begin(), cut.end()) == cut.end() &&
                  std::includes(told.cut.begin(), told.cut.end(), cut.begin(), cut.end()),
              "to the letter, the cut-set is a part of it");
      std::vector<std::uint32_t> edges(graph.size());  // of each node, to such as changed
      for (const std::uint32_t e : told.cut) {
        const auto& [i, j, a, b] = graph.edges()[e];
        const bool of_i = before.on[i] != found[i], of_j = before.on[j] != found[j],
                   kept = std::binary_search(cut.begin(), cut.end(), e);
        require(of_i || of_j || kept, "what stays of the cut-set is kept");
        if (of_i && !of_j) edges[j] += kept;
        if (of_j && !of_i) edges[i] += kept;
        if ((of_i && !of_j && before.at_cut[j]) || (of_j && !of_i && before.at_cut[i]))
          require(!kept, "to the letter, no edge is added to a node that is checked already");
      }
      for (std::uint32_t i = 0; i < graph.size(); ++i) {
        bool others = true, any = false;  // all neighbours that changed have another status; there are some
        for (const std::uint32_t e : graph.edges_of(i)) {
          const std::uint32_t j = graph.across(e, i);
          if (before.on[j] == found[j]) continue;
          any = true;
          others = others && found[j] != found[i];
        }
        if (any && others && before.on[i] == found[i] && !before.at_cut[i])
          require(edges[i] == 1, "to the letter, an edge is added where a node is tested");
      }
    }
    if (graph.components().size() == 1 && graph.components()[0].inside)
      require((found == after.on) == (after.shown[0] == 0 || kept_in_touch(graph, before, after)[0]),
              "on a convex body the update is right iff what is on-view keeps in touch, or is nothing");
  }
}

// ---- Views of planes, lines and points

/// Points on all sides of hyperplanes and of where they meet: of each hyperplane those of the others within it, and
/// beside them; the origin where there is none.
template <std::size_t dimension>
std::vector<std::array<Rational, dimension>> points_about(
    const std::vector<std::array<Rational, dimension + 1>>& forms) {
  std::vector<std::array<Rational, dimension>> points;
  if constexpr (dimension > 0)
    for (const auto& form : forms) {
      std::size_t gone = 0;  // the variable that the others tell
      while (gone < dimension && form[gone] == 0) ++gone;
      if (gone == dimension) continue;
      std::vector<std::array<Rational, dimension>> within;
      for (const auto& other : forms) {
        auto& rest = within.emplace_back();
        for (std::size_t k = 0, to = 0; k <= dimension; ++k)
          if (k != gone) rest[to++] = other[k] - other[gone] * form[k] / form[gone];
      }
      for (const auto& q : points_about<dimension - 1>(within)) {
        std::array<Rational, dimension> p;
        p[gone] = form[dimension];
        for (std::size_t k = 0, at = 0; k < dimension; ++k) {
          if (k == gone) continue;
          p[k] = q[at++];
          p[gone] += form[k] * p[k];
        }
        p[gone] /= -form[gone];
        const Rational step = generate::power_of_two(-32 << dimension);
        for (const int side : {-1, 0, 1}) {
          auto& beside = points.emplace_back(p);
          for (std::size_t k = 0; k < dimension; ++k) beside[k] += side * step * form[k];
        }
      }
    }
  if (points.empty()) points.emplace_back();
  return points;
}

template <std::size_t dimension>
void try_cells(Random& random) {
  using Form = std::array<Rational, dimension + 1>;
  std::vector<Form> forms;
  for (std::uint64_t k = random.below(dimension == 3 ? 4 : 6); k > 0; --k) {
    Form form;
    for (Rational& x : form) x = generate::integer(random, -2, 2);
    if (!forms.empty() && random.chance(1, 4)) {  // parallel, or the same either way round
      form = forms[random.below(forms.size())];
      if (random.chance(1, 2)) form[dimension] += generate::integer(random, -1, 1);
      if (random.chance(1, 2))
        for (Rational& x : form) x = -x;
    }
    forms.push_back(form);
  }
  const auto value = [&](const Form& form, const std::array<Rational, dimension>& p) {
    Rational sum = form[dimension];
    for (std::size_t k = 0; k < dimension; ++k) sum += form[k] * p[k];
    return sum;
  };
  const auto set_of = [&](const std::array<Rational, dimension>& p) {
    std::uint32_t set = 0;
    for (std::size_t k = 0; k < forms.size(); ++k) set |= static_cast<std::uint32_t>(value(forms[k], p) > 0) << k;
    return set;
  };
  const auto is_off = [&](const std::array<Rational, dimension>& p) {
    return std::all_of(forms.begin(), forms.end(), [&](const Form& form) {
      return value(form, p) != 0 || std::all_of(form.begin(), form.end(), [](const Rational& x) { return x == 0; });
    });
  };
  std::set<std::uint32_t> all, open;
  for (const auto& p : points_about<dimension>(forms)) {
    all.insert(set_of(p));
    if (is_off(p)) open.insert(set_of(p));
  }
  const auto check = [&](const auto& cells, const std::set<std::uint32_t>& sets) {
    require(cells.size() == sets.size(), "as many views as there are");
    for (const auto& [set, sample] : cells) {
      require(sets.count(set) > 0 && set_of(sample) == set, "a view is there, and its sample has it");
      require(open.count(set) == 0 || is_off(sample), "the sample of an open view is off all planes");
    }
  };
  check(view_cells_detail::open_cells<dimension>(std::span<const Form>(forms)), open);
  check(view_cells_detail::all_cells<dimension>(std::span<const Form>(forms), 0), all);
}

inline void cutset(std::string_view bytes) {
  Random random(Bytes(bytes).word());
  switch (random.below(12)) {
    case 0: try_cells<1>(random); break;
    case 1: try_cells<2>(random); break;
    case 2: try_cells<3>(random); break;
    case 3:
    case 4:
    case 5: try_update_1977(random); break;
    default: try_tracker(random);
  }
}

}  // namespace fuzz
