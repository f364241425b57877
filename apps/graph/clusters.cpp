#include "clusters.h"

#include <sightline/algorithms/bsp/build.h>

#include <utility>

namespace sightline::app {

namespace {

const std::map<Precedence, std::string> precedence_names{{Precedence::never, "never"},
                                                         {Precedence::first, "first"},
                                                         {Precedence::second, "second"},
                                                         {Precedence::by_plane, "plane"},
                                                         {Precedence::crossing, "crossing"}};

/// How each pair of faces of a cycle is to be drawn.
void add_codes(Clusters& found, const Scene& scene, const Exact_traits& traits, const Graph_arguments& arguments,
               const Report& report) {
  const Priority_relation<Exact_traits> faces(traits, found.tree.polygons);
  Relation_counters counters;
  const auto name_of = [&](std::uint32_t i) -> Json {
    Json label = name_json(scene, found.tree.polygons[i].piece);
    if (arguments.two_sided) label.push_back(found.tree.turned[i] ? "back" : "front");
    return label;
  };
  for (const auto& node : found.tree.nodes) {
    if (node.kind != Priority_tree<Exact_traits>::Kind::cycle) continue;
    const auto members = found.tree.slots_of(node);
    for (std::size_t a = 0; a < members.size(); ++a) {
      for (std::size_t b = a + 1; b < members.size(); ++b) {
        report(a, members.size());
        const std::uint32_t i = static_cast<std::uint32_t>(members[a]), j = static_cast<std::uint32_t>(members[b]);
        const Pair_code code = pair_code(faces, i, j, counters);
        ++found.pairs[code.precedence];
        if (arguments.common.json.empty() || code.precedence == Precedence::never) continue;
        Json entry{name_of(i), name_of(j), precedence_names.at(code.precedence)};
        if (code.plane)
          entry.push_back({{"normal", point_json(code.plane->normal)}, {"point", point_json(code.plane->point)}});
        found.codes.push_back(std::move(entry));
      }
    }
  }
}

}  // namespace

Clusters clusters_of(const Scene& scene, const Exact_traits& traits, const Graph_arguments& arguments,
                     const Report& in_time) {
  Clusters found;
  Stopwatch watch;
  Progress progress("separating");
  const Report report = shown(in_time, progress);
  found.tree = build_priority_tree(traits, {arguments.two_sided, arguments.split, report});
  found.seconds = watch.seconds();
  if (arguments.split) {
    Bsp_options options;
    options.seed = arguments.common.seed;
    options.threads = arguments.common.threads;
    options.progress = in_time;
    found.bsp_fragments = build_bsp(traits, options).counters.fragments;
  }
  if (arguments.codes) add_codes(found, scene, traits, arguments, report);
  return found;
}

Json to_json(const Clusters& clusters) {
  const Priority_tree_counters& c = clusters.tree.counters;
  return {{"polygons", c.polygons},
          {"by_number", c.by_number},
          {"by_plane", c.by_plane},
          {"left", c.left},
          {"planes", c.planes},
          {"cutting_planes", c.cutting_planes},
          {"free_planes", c.free_planes},
          {"sequences", c.sequences},
          {"cycles", c.cycles},
          {"depth", c.depth},
          {"graphs", c.graphs}};
}

void print(const Clusters& clusters, const Graph_arguments& arguments) {
  const Priority_tree_counters& c = clusters.tree.counters;
  row("tree", fmt::format("{} planes that cut nothing{} ({} of no face), {} lists of fixed order, depth {}; {:.3f} s",
                          c.planes - c.cutting_planes,
                          c.cutting_planes > 0 ? fmt::format(" and {} that cut", c.cutting_planes) : "", c.free_planes,
                          c.sequences, c.depth, clusters.seconds));
  row("settled",
      fmt::format("of {} {}: {} by priority, {} on planes, {} left in {} cycles", c.polygons,
                  arguments.two_sided ? "sides of faces" : "faces", c.by_number, c.by_plane, c.left, c.cycles));
  if (arguments.split)
    row("pieces", fmt::format("{} after {} cuts; a BSP tree has {} fragments: {:.2f} of them", c.polygons, c.splits,
                              clusters.bsp_fragments,
                              static_cast<double>(c.polygons) / (arguments.two_sided ? 2 : 1) /
                                  static_cast<double>(std::max<std::uint64_t>(1, clusters.bsp_fragments))));
  if (arguments.codes) {
    const auto count = [&](Precedence p) { return clusters.pairs.contains(p) ? clusters.pairs.at(p) : 0; };
    row("codes", fmt::format("of the pairs in cycles {} are never seen along one ray, {} in one order, {} by the eye's "
                             "side of a plane, {} cross",
                             count(Precedence::never), count(Precedence::first) + count(Precedence::second),
                             count(Precedence::by_plane), count(Precedence::crossing)));
  }
}

}  // namespace sightline::app
