// sightline graph: the priority graph of a scene, its strongly connected components, and their order.

#include "support/drawing.h"
#include "support/page.h"
#include "support/pixels.h"

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/priority/certificate.h>
#include <sightline/algorithms/priority/pair_code.h>
#include <sightline/algorithms/priority/scope.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <utility>

namespace sightline::app {

namespace {

struct Graph_arguments {
  Common common;
  std::string method = "implicit", eye, direction, dot, html, mesh, certificate;
  std::vector<std::string> box, region;
  bool arcs = false, tree = false, split = false, codes = false, two_sided = false;
  Pixel_arguments pixels;
  bool wants_tree() const { return tree || split || codes || two_sided; }
};

using Faces = Priority_relation<Exact_traits>;
using Report = std::function<void(std::size_t done, std::size_t all)>;

/// One budget for all that a command does, whatever it shows of it.
Report shown(const Report& in_time, Progress& progress) {
  return [&](std::size_t done, std::size_t all) {
    in_time(done, all);
    progress(done, all);
  };
}

const std::map<Precedence, std::string> precedence_names{{Precedence::never, "never"},
                                                         {Precedence::first, "first"},
                                                         {Precedence::second, "second"},
                                                         {Precedence::by_plane, "plane"},
                                                         {Precedence::crossing, "crossing"}};

/// What a run found.
struct Found {
  Priority_components components;
  std::optional<Explicit_priority_graph> arcs;  // where they were asked for
  Component_trees trees;                        // implicit only
  Json counters;
  double component_seconds = 0, arc_seconds = 0;
};

/// Components and arcs of a relation of whatever scope.
template <class Relation>
Found find(const Relation& relation, const Graph_arguments& arguments, const Report& in_time) {
  // Arcs are counted where that takes no longer than a moment.
  constexpr std::uint32_t few = 2000;
  Found found;
  const bool is_explicit = arguments.method == "explicit";
  const Stopwatch watch;
  if (!is_explicit) {
    Implicit_priority_graph<Relation> graph(relation);
    Progress progress("searching");
    found.components = graph.find_components(&found.trees, shown(in_time, progress));
    found.component_seconds = watch.seconds();
    found.counters = counters_json(graph.counters());
  }
  if (is_explicit || arguments.arcs || !arguments.dot.empty() || relation.size() <= few) {
    Progress progress("comparing");
    found.arcs.emplace(relation, shown(in_time, progress));
    if (is_explicit) {
      found.components = components(*found.arcs);
      found.component_seconds = watch.seconds();
      found.counters = counters_json(found.arcs->counters());
    }
    found.arc_seconds = watch.seconds() - found.component_seconds;
  }
  return found;
}

Json name_json(const Scene& scene, std::uint32_t piece) {
  return {scene.pieces()[piece].face, scene.pieces()[piece].number};
}
std::string name(const Scene& scene, std::uint32_t piece) {
  const Piece& p = scene.pieces()[piece];
  return p.number == 0 ? std::to_string(p.face) : fmt::format("{}.{}", p.face, p.number);
}

/// One point an entry, or Usage_error.
std::vector<Exact_point> parse_points(const std::vector<std::string>& texts, const std::string& option) {
  std::vector<Exact_point> points;
  for (const std::string& text : texts) {
    std::istringstream words(text);
    for (std::string word; words >> word;) points.push_back(parse_point(word, option));
  }
  return points;
}

/// The graph for Graphviz: components of more than one face are boxes, each face is named, arcs within a component are
/// red.
std::string dot_of(const Scene& scene, const Found& found) {
  std::string text = "digraph priority {\n  node [shape=ellipse, fontsize=11];\n";
  for (std::size_t c = 0; c < found.components.size(); ++c) {
    const bool cyclic = found.components[c].size() > 1;
    if (cyclic) text += fmt::format("  subgraph cluster_{} {{\n    label=\"component {}\"; color=red;\n", c, c);
    for (const std::uint32_t i : found.components[c])
      text += fmt::format("  {}n{} [label=\"{}\"];\n", cyclic ? "  " : "", i, name(scene, i));
    if (cyclic) text += "  }\n";
  }
  const Arc_graph& graph = found.arcs->boost_graph();
  for (const auto& arc : boost::make_iterator_range(boost::edges(graph))) {
    const auto from = boost::source(arc, graph), to = boost::target(arc, graph);
    text += fmt::format("  n{} -> n{}{};\n", from, to,
                        found.components.h(from) == found.components.h(to) ? " [color=red]" : "");
  }
  return text + "}\n";
}

/// The tree of clusters, the codes of the cycles that it leaves, and how many parts a BSP tree would have made.
struct Clusters {
  Priority_tree<Exact_traits> tree;
  double seconds = 0;
  std::uint64_t bsp_fragments = 0;
  std::map<Precedence, std::uint64_t> pairs;
  Json codes = Json::array();  // of the pairs that some ray pierces
};

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
  if (!arguments.codes) return found;

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
  return found;
}

/// The pieces with their components, and the arcs where they are known and not too many.
void write_page(const Scene& scene, const Found& found, const std::string& scope, const std::string& file) {
  const Priority_components& all = found.components;
  Page page("graph", scene);
  page.add_fact("faces", fmt::format("{}", scene.counters().faces));
  page.add_fact("scope", scope);
  page.add_fact("arcs", found.arcs ? fmt::format("{}", found.arcs->arc_count()) : "not written out: --arcs does");
  page.add_fact("components",
                fmt::format("{}, {} of them cyclic, the largest of {} faces", all.size(), all.cyclic(), all.largest()));
  page.add_group("faces", "face");
  page.add_pieces(scene);
  constexpr std::size_t most_components = 1000000;  // that are told one by one
  std::vector<std::uint32_t> h;
  if (all.faces() <= most_components)
    for (std::uint32_t i = 0; i < all.faces(); ++i) h.push_back(all.h(i));
  else page.add_note("which component a face is in is too much for a page: --json has it");
  page.more()["components"] = packed(h);
  if (found.arcs) {
    constexpr std::size_t most_arcs = 60000, most_faces = 1700;
    const std::size_t n = found.arcs->size();
    const Arc_graph& graph = found.arcs->boost_graph();
    std::vector<std::uint32_t> list;
    std::vector<bool> matrix(found.arcs->arc_count() > most_arcs && n <= most_faces ? n * n : 0);
    if (found.arcs->arc_count() > most_arcs && n > most_faces)
      page.add_note("so many arcs are too many for a page: --arcs --json lists them");
    else
      for (const auto& arc : boost::make_iterator_range(boost::edges(graph))) {
        const std::size_t from = boost::source(arc, graph), to = boost::target(arc, graph);
        if (!matrix.empty()) matrix[from * n + to] = true;
        else list.insert(list.end(), {static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to)});
      }
    if (!matrix.empty()) page.more()["arc_matrix"] = packed(matrix);
    else if (found.arcs->arc_count() <= most_arcs) page.more()["arcs"] = packed(list);
  }
  page.write(file);
}

std::vector<Pixel_image> images_of(const Scene& scene, const Exact_traits& traits, const Faces& faces,
                                   const Priority_components& components, const std::vector<View>& views,
                                   const Graph_arguments& arguments, const Report& in_time) {
  std::vector<Pixel_image> images;
  Progress progress("looking");
  const Report report = shown(in_time, progress);
  std::vector<std::uint32_t> h(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) h[i] = components.h(i);
  const Priority_tree<Exact_traits> tree =
      build_priority_tree(traits, {false, false, report});  // cuts nothing, so its polygons are the faces
  for (const View& unaimed : views) {
    const View view = scene.counters().faces > 0 ? aimed(unaimed, scene) : unaimed;
    report(images.size(), views.size());
    const Pixel_sets sets = pixel_sets(faces, pixel_view(view));
    Pixel_image image{view, pixel_statistics(sets, h), pixel_statistics(sets, priorities(traits, tree, view.eye)), {}};
    if (!images.empty()) {
      const std::vector<std::uint32_t> before = std::exchange(images.back().by_number.image, {}),
                                       &now = image.by_number
                                                  .image;  // one image's pixels are kept, however many there are
      std::size_t changed = 0;
      for (std::size_t k = 0; k < now.size(); ++k) changed += before[k] != now[k];
      image.changed = static_cast<double>(changed) / static_cast<double>(now.size());
    }
    if (!arguments.pixels.pictures.empty())
      write_file(picture_file(arguments.pixels, images.size() + 1), painted(image));
    image.by_tree.image = std::vector<std::uint32_t>{};
    images.push_back(std::move(image));
  }
  return images;
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

void print(const Scene& scene, const Found& found, const std::string& scope, const Graph_arguments& arguments) {
  const Priority_components& all = found.components;
  scene_rows(scene);
  row("scope", scope);
  if (found.arcs) row("arcs", fmt::format("{}", found.arcs->arc_count()));
  else row("arcs", "not written out; --arcs does");
  row("components", fmt::format("{}: {} of one face, {} cyclic, the largest of {} faces", all.size(),
                                all.size() - all.cyclic(), all.cyclic(), all.largest()));
  row("seconds",
      fmt::format(
          "{:.3f} for components ({}){}", found.component_seconds, arguments.method,
          found.arcs && arguments.method != "explicit" ? fmt::format(", {:.3f} for arcs", found.arc_seconds) : ""));
  constexpr std::size_t shown = 20, members = 12;
  for (std::size_t c = 0; c < std::min(shown, all.size()); ++c) {
    std::string line;
    for (std::size_t k = 0; k < std::min(members, all[c].size()); ++k)
      line += (k == 0 ? "" : ", ") + name(scene, all[c][k]);
    if (all[c].size() > members) line += fmt::format(", ... {} more", all[c].size() - members);
    std::cout << fmt::format("{:>6}. {}{}\n", c + 1, all[c].size() > 1 ? "cyclic: " : "face ", line);
  }
  if (all.size() > shown) std::cout << fmt::format("   ... {} more: --json - prints them all\n", all.size() - shown);
}

}  // namespace

/// The pieces, in cycles or not, with the number of their component.
static void write_mesh(const Scene& scene, const Priority_components& components, const std::string& file) {
  Grouped_polygons polygons;
  const std::uint32_t alone = polygons.add_group("alone", drawing_colours::hidden),
                      cyclic = polygons.add_group("cyclic", drawing_colours::seen);
  std::vector<std::uint32_t> numbers(scene.pieces().size());
  for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = components.h(i);
  add_pieces(polygons, scene,
             [&](std::uint32_t piece) { return components[components.h(piece)].size() > 1 ? cyclic : alone; });
  polygons.add_column("component", std::move(numbers));
  write_drawings({}, file, polygons);
}

static Exit run(const Graph_arguments& arguments) {
  const Common& common = arguments.common;
  // Usage errors come before a long read.
  const std::vector<Exact_point> box = parse_points(arguments.box, "--box"),
                                 region = parse_points(arguments.region, "--region");
  if (!arguments.box.empty() && box.size() != 2) throw Usage_error("--box wants two corners X,Y,Z X,Y,Z");
  const Exact_point origin;
  const Exact_point eye = arguments.eye.empty() ? origin : parse_point(arguments.eye, "--eye");
  const Exact_point direction = arguments.direction.empty() ? origin : parse_point(arguments.direction, "--ray");
  if (!arguments.direction.empty() && direction == origin)
    throw Usage_error("--ray wants a direction that is not 0,0,0");
  const bool whole = box.empty() && region.empty() && arguments.eye.empty();
  if (!arguments.certificate.empty() && !(whole && arguments.method == "implicit"))
    throw Usage_error(
        "--certificate is for --method implicit over all viewpoints: leave out --box, --region and --eye");
  if (!whole && (arguments.wants_tree() || !arguments.pixels.size.empty()))
    throw Usage_error(
        "--tree, --codes, --split, --two-sided and --pixels are over all viewpoints: leave out --box, --region and "
        "--eye");

  const std::vector<View> views = arguments.pixels.size.empty() ? std::vector<View>{} : read_views(arguments.pixels);
  if (!arguments.pixels.pictures.empty()) {
    std::vector<Named_file> pictures;
    for (std::size_t k = 1; k <= views.size(); ++k)
      pictures.push_back({"--pictures", picture_file(arguments.pixels, k)});
    common.command->check_outputs(pictures);
  }

  const Scene scene(common.read());
  const Report in_time = common.within_budget([](std::size_t, std::size_t) {});
  const Exact_traits traits(scene);
  const Faces faces(traits);
  std::string scope = "all viewpoints";
  const Found found = [&] {
    if (!arguments.direction.empty()) {
      scope = "one ray";
      return find(Ray_relation<Exact_traits>(faces, eye, direction), arguments, in_time);
    }
    if (!arguments.eye.empty()) {
      scope = "one viewpoint";
      return find(Region_relation<Exact_traits>(faces, View_region::eye(eye)), arguments, in_time);
    }
    if (!whole) {
      const View_region viewpoints = box.empty() ? View_region{region} : View_region::box(box[0], box[1]);
      scope = viewpoints.points.empty() ? "no viewpoint: the box is empty"
                                        : fmt::format("viewpoints in the hull of {} points", viewpoints.points.size());
      return find(Region_relation<Exact_traits>(faces, viewpoints), arguments, in_time);
    }
    return find(faces, arguments, in_time);
  }();

  if (!arguments.certificate.empty()) {
    in_time(1, 1);  // no certificate once the budget is over
    write_file(arguments.certificate, [&](std::ostream& out) {
      write_certificate(out, graph_certificate(scene, faces, found.components, found.trees));
    });
  }
  if (!arguments.dot.empty()) write_file(arguments.dot, dot_of(scene, found));
  if (!arguments.html.empty()) write_page(scene, found, scope, arguments.html);
  if (!arguments.mesh.empty()) write_mesh(scene, found.components, arguments.mesh);
  std::optional<Clusters> clusters;
  if (arguments.wants_tree()) clusters = clusters_of(scene, traits, arguments, in_time);
  std::vector<Pixel_image> images;
  if (!arguments.pixels.size.empty())
    images = images_of(scene, traits, faces, found.components, views, arguments, in_time);
  Json result{{"scope", scope}, {"arcs", found.arcs ? Json(found.arcs->arc_count()) : Json()}};
  if (!common.json.empty()) {
    Json components = Json::array();
    for (std::size_t c = 0; c < found.components.size(); ++c) {
      Json& members = components.emplace_back(Json::array());
      for (const std::uint32_t i : found.components[c]) members.push_back(name_json(scene, i));
    }
    result["components"] = std::move(components);
    if (arguments.arcs) {
      Json& list = result["arc_list"] = Json::array();
      const Arc_graph& graph = found.arcs->boost_graph();
      for (const auto& arc : boost::make_iterator_range(boost::edges(graph)))
        list.push_back({name_json(scene, static_cast<std::uint32_t>(boost::source(arc, graph))),
                        name_json(scene, static_cast<std::uint32_t>(boost::target(arc, graph)))});
    }
  }
  Json counters = found.counters, seconds{{"components", found.component_seconds}, {"arcs", found.arc_seconds}};
  if (clusters) {
    result["tree"] = to_json(*clusters);
    seconds["tree"] = clusters->seconds;
    if (arguments.codes) result["codes"] = std::move(clusters->codes);
    if (arguments.split) {
      result["splits"] = clusters->tree.counters.splits;
      result["pieces"] = clusters->tree.counters.polygons;
      counters["bsp_fragments"] = clusters->bsp_fragments;
    }
  }
  if (!images.empty()) result["images"] = app::to_json(images);
  if (write_json(common, "graph", scene, std::move(result), counters, seconds)) return Exit::done;
  print(scene, found, scope, arguments);
  if (clusters) print(*clusters, arguments);
  if (!images.empty()) print(images);
  return Exit::done;
}

void add_graph(Command program) {
  const Command command = program.add_command(
      "graph", "Which face may obscure which: the priority graph, its strongly connected components and their order");
  auto a = std::make_shared<Graph_arguments>();
  a->common.add_to(command);
  command.add_option("--method", a->method, "implicit: no arc is written out; explicit: all are")
      .check(one_of({"implicit", "explicit"}))
      .show_default();
  const Option box = command.add_option("--box", a->box, "viewpoints in a box only: two corners X,Y,Z X,Y,Z")
                         .check(not_empty())
                         .expected(1, 2);
  const Option region =
      command.add_option("--region", a->region, "viewpoints in the convex hull of these points only: X,Y,Z X,Y,Z ...")
          .check(not_empty())
          .expected(1, 1 << 20);
  const Option eye = command.add_option("--eye", a->eye, "one viewpoint only").check(not_empty());
  command.add_option("--ray", a->direction, "one ray only, from the eye in direction X,Y,Z")
      .check(not_empty())
      .needs(eye);
  box.excludes(region).excludes(eye);
  region.excludes(eye);
  command.add_flag("--arcs", a->arcs, "write all arcs out, however many, and list them in the JSON");
  command.add_flag(
      "--tree", a->tree,
      "separate the faces by planes that cut none, and order what is left by the graph: how many faces each settles");
  command.add_flag(
      "--codes", a->codes,
      "codes for the pairs in the cycles that the tree leaves: which face is nearer along any ray; listed in the JSON");
  command.add_flag("--split", a->split, "cut faces until no cycle is left, and compare with a BSP tree");
  command.add_flag("--two-sided", a->two_sided, "a tree of both sides of each face");
  const Option pixels =
      command
          .add_option("--pixels", a->pixels.size,
                      "WIDTHxHEIGHT: how many faces the priorities leave to choose from at each pixel of images")
          .check(not_empty());
  const Option eyes =
      command
          .add_option("--eyes", a->pixels.eyes,
                      "the images' eyes: a file with X,Y,Z a line, or X,Y,Z,DX,DY,DZ with the direction of view")
          .reads_file();
  const Option pictures =
      command.add_option("--pictures", a->pixels.pictures, "a folder to write a picture of each image to")
          .check(folder());
  pixels.needs(eyes);
  eyes.needs(pixels);
  pictures.needs(pixels);
  command.add_option("--dot", a->dot, "write the graph for Graphviz, cyclic components in boxes").writes_file();
  command
      .add_option("--html", a->html,
                  "write a page to look at: components, cycles, and what is in front of and behind a face")
      .writes_file(".html");
  add_mesh_option(command, a->mesh, "faces alone and in cycles, with their components,");
  command.add_option("--certificate", a->certificate, "write what `sightline verify` reads").writes_file();
  command.footer(
      "Face r1 may obscure r2, r1 < r2, if from some eye in front of both a ray meets r1 first. Components are listed "
      "highest priority first:\n"
      "no face of a later one obscures a face of an earlier one, whatever the viewpoint. Options that take several "
      "points end at the next option.\n"
      "Example: sightline graph object.off --dot object.dot --certificate object.json");
  command.set_action([a] { return run(*a); });
}

}  // namespace sightline::app
