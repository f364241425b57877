// sightline graph: the priority graph of a scene, its strongly connected components, and their order.

#include "../support/drawing.h"
#include "../support/page.h"
#include "clusters.h"

#include <sightline/algorithms/priority/certificate.h>
#include <sightline/algorithms/priority/kernels.h>
#include <sightline/algorithms/priority/scope.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

namespace sightline::app {

namespace {

using Faces = Priority_relation<Exact_traits>;
/// Of so many all pairs are compared in a moment: arcs are counted without being asked for.
constexpr std::uint32_t few_faces = 2000;

/// Which viewpoints are asked about: all, those of a box or of the hull of some points, one, or those of one ray.
struct Viewpoints {
  std::vector<Exact_point> box, region;
  std::optional<Exact_point> eye, direction;  // with a direction the ray's; by itself, an eye

  bool are_all() const { return box.empty() && region.empty() && !eye; }
};

/// What a run found.
struct Found {
  std::string scope;  // the viewpoints, in words
  Priority_components components;
  std::optional<Explicit_priority_graph> arcs;  // where they were asked for
  Component_trees trees;                        // implicit only
  Json counters;
  double component_seconds = 0, arc_seconds = 0;
};

/// Components and arcs of a relation of whatever scope.
template <class Relation>
Found find(const Relation& relation, const Graph_arguments& arguments, const Report& in_time) {
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
  if (is_explicit || arguments.arcs || !arguments.dot.empty() || relation.size() <= few_faces) {
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

/// All arcs of a graph, one after another, sorted.
std::vector<std::array<std::uint32_t, 2>> arcs_of(const Explicit_priority_graph& graph) {
  std::vector<std::array<std::uint32_t, 2>> arcs;
  arcs.reserve(graph.arc_count());
  for (const auto& arc : boost::make_iterator_range(boost::edges(graph.boost_graph())))
    arcs.push_back({static_cast<std::uint32_t>(boost::source(arc, graph.boost_graph())),
                    static_cast<std::uint32_t>(boost::target(arc, graph.boost_graph()))});
  return arcs;
}

/// The arcs of one sorted list that are not in the other: numbers, two an arc.
std::vector<std::uint32_t> without(const std::vector<std::array<std::uint32_t, 2>>& arcs,
                                   const std::vector<std::array<std::uint32_t, 2>>& others) {
  std::vector<std::array<std::uint32_t, 2>> left;
  std::set_difference(arcs.begin(), arcs.end(), others.begin(), others.end(), std::back_inserter(left));
  std::vector<std::uint32_t> numbers;
  for (const auto& [from, to] : left) numbers.insert(numbers.end(), {from, to});
  return numbers;
}

/// The arcs that the same comparison of all pairs in plain doubles lacks, and those that it has too many.
Json made_by_doubles(const Scene& scene, const Viewpoints& asked, const Found& found, const Time_limit& limit) {
  constexpr std::size_t most_arcs = 60000;
  if (!found.arcs) return doubles_left_out("the arcs are not known");
  if (!asked.are_all()) return doubles_left_out("the viewpoints are not all");
  if (found.arcs->size() > few_faces)
    return doubles_left_out(fmt::format("of more than {} faces all pairs would take as long once more", few_faces));
  return asked_of_doubles(limit, [&](const Report& report) -> Json {
    const Double_traits traits(scene);
    const auto exact = arcs_of(*found.arcs),
               rounded = arcs_of(Explicit_priority_graph(Priority_relation<Double_traits>(traits), report));
    const std::vector<std::uint32_t> missing = without(exact, rounded), extra = without(rounded, exact);
    if (missing.size() + extra.size() > 2 * most_arcs)
      return doubles_left_out(
          fmt::format("{} wrong arcs are too many for a page", (missing.size() + extra.size()) / 2));
    return {{"missing", packed(missing)}, {"extra", packed(extra)}};
  });
}

/// The pieces with their components, and the arcs where they are known and not too many; `doubles`: what stands under
/// that key.
void write_page(const Scene& scene, const Found& found, const std::string& file, Json doubles) {
  const Priority_components& all = found.components;
  Page page("graph", scene);
  page.add_fact("faces", fmt::format("{}", scene.counters().faces));
  page.add_fact("scope", found.scope);
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
  page.more()["doubles"] = std::move(doubles);
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
    const Pixel_sets sets = pixel_sets(faces, pixel_view(view), [&] { report(images.size(), views.size()); });
    Pixel_image image{view, pixel_statistics(sets, h), pixel_statistics(sets, priorities(traits, tree, view.eye)), {}};
    report(images.size(), views.size());
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

void print(const Scene& scene, const Found& found, const Graph_arguments& arguments) {
  const Priority_components& all = found.components;
  scene_rows(scene);
  row("scope", found.scope);
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

/// The pieces, in cycles or not, with the number of their component.
void write_mesh(const Scene& scene, const Priority_components& components, const std::string& file) {
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

/// Usage errors come before a long read.
Viewpoints viewpoints_of(const Graph_arguments& arguments) {
  Viewpoints asked{parse_points(arguments.box, "--box"), parse_points(arguments.region, "--region"), {}, {}};
  if (!arguments.box.empty() && asked.box.size() != 2) throw Usage_error("--box wants two corners X,Y,Z X,Y,Z");
  if (!arguments.region.empty() && asked.region.empty())
    throw Usage_error("--region wants points X,Y,Z X,Y,Z ..., at least one");
  if (!arguments.eye.empty()) asked.eye = parse_point(arguments.eye, "--eye");
  if (!arguments.direction.empty()) asked.direction = parse_point(arguments.direction, "--ray");
  if (asked.direction && *asked.direction == Exact_point())
    throw Usage_error("--ray wants a direction that is not 0,0,0");
  if (!arguments.certificate.empty() && !(asked.are_all() && arguments.method == "implicit"))
    throw Usage_error(
        "--certificate is for --method implicit over all viewpoints: leave out --box, --region and --eye");
  if (!asked.are_all() && (arguments.wants_tree() || !arguments.pixels.size.empty()))
    throw Usage_error(
        "--tree, --codes, --split, --two-sided and --pixels are over all viewpoints: leave out --box, --region and "
        "--eye");
  return asked;
}

/// No picture of a view takes the place of what else is written.
void check_pictures(const Graph_arguments& arguments, std::size_t views) {
  if (arguments.pixels.pictures.empty()) return;
  std::vector<Named_file> pictures;
  for (std::size_t k = 1; k <= views; ++k) pictures.push_back({"--pictures", picture_file(arguments.pixels, k)});
  arguments.common.command->check_outputs(pictures);
}

/// What is found of the viewpoints that are asked about.
Found found_from(const Viewpoints& asked, const Faces& faces, const Graph_arguments& arguments, const Report& in_time) {
  const auto in_scope = [](Found found, std::string scope) {
    found.scope = std::move(scope);
    return found;
  };
  if (asked.direction)
    return in_scope(find(Ray_relation<Exact_traits>(faces, asked.eye.value_or(Exact_point()), *asked.direction),
                         arguments, in_time),
                    "one ray");
  if (asked.eye)
    return in_scope(find(Region_relation<Exact_traits>(faces, View_region::eye(*asked.eye)), arguments, in_time),
                    "one viewpoint");
  if (asked.are_all()) return in_scope(find(faces, arguments, in_time), "all viewpoints");
  const View_region region =
      asked.box.empty() ? View_region{asked.region} : View_region::box(asked.box[0], asked.box[1]);
  return in_scope(find(Region_relation<Exact_traits>(faces, region), arguments, in_time),
                  region.points.empty() ? "no viewpoint: the box is empty"
                                        : fmt::format("viewpoints in the hull of {} points", region.points.size()));
}

/// Highest priority first.
Json components_json(const Scene& scene, const Priority_components& all) {
  Json components = Json::array();
  for (std::size_t c = 0; c < all.size(); ++c) {
    Json& members = components.emplace_back(Json::array());
    for (const std::uint32_t i : all[c]) members.push_back(name_json(scene, i));
  }
  return components;
}

Json arcs_json(const Scene& scene, const Arc_graph& graph) {
  Json list = Json::array();
  for (const auto& arc : boost::make_iterator_range(boost::edges(graph)))
    list.push_back({name_json(scene, static_cast<std::uint32_t>(boost::source(arc, graph))),
                    name_json(scene, static_cast<std::uint32_t>(boost::target(arc, graph)))});
  return list;
}

/// Writes the document of --json. Returns as write_json.
bool write_result(const Graph_arguments& arguments, const Scene& scene, const Found& found,
                  std::optional<Clusters>& clusters, const std::vector<Pixel_image>& images) {
  Json result{{"scope", found.scope}, {"arcs", found.arcs ? Json(found.arcs->arc_count()) : Json()}};
  if (!arguments.common.json.empty()) {
    result["components"] = components_json(scene, found.components);
    if (arguments.arcs) result["arc_list"] = arcs_json(scene, found.arcs->boost_graph());
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
  return write_json(arguments.common, "graph", scene, std::move(result), counters, seconds);
}

Exit run(const Graph_arguments& arguments) {
  const Common& common = arguments.common;
  const Viewpoints asked = viewpoints_of(arguments);
  const std::vector<View> views = arguments.pixels.size.empty() ? std::vector<View>{} : read_views(arguments.pixels);
  check_pictures(arguments, views.size());
  const Scene scene = scene_of(common.read());
  const Report in_time = common.within_budget();
  const Time_limit limit(common.budget);
  const Exact_traits traits(scene);
  const Faces faces(traits);

  // 1. The graph.
  const Found found = found_from(asked, faces, arguments, in_time);
  if (!arguments.certificate.empty()) {
    in_time(1, 1);  // no certificate once the budget is over
    write_file(arguments.certificate, [&](std::ostream& out) {
      write_certificate(out, graph_certificate(scene, faces, found.components, found.trees));
    });
  }
  if (!arguments.dot.empty()) write_file(arguments.dot, dot_of(scene, found));
  if (!arguments.html.empty()) write_page(scene, found, arguments.html, made_by_doubles(scene, asked, found, limit));
  if (!arguments.mesh.empty()) write_mesh(scene, found.components, arguments.mesh);

  // 2. What stands on it: clusters, and what pixels see.
  std::optional<Clusters> clusters;
  if (arguments.wants_tree()) clusters = clusters_of(scene, traits, arguments, in_time);
  std::vector<Pixel_image> images;
  if (!arguments.pixels.size.empty())
    images = images_of(scene, traits, faces, found.components, views, arguments, in_time);

  // 3. What is told of both.
  if (write_result(arguments, scene, found, clusters, images)) return Exit::done;
  print(scene, found, arguments);
  if (clusters) print(*clusters, arguments);
  if (!images.empty()) print(images);
  return Exit::done;
}

}  // namespace

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
