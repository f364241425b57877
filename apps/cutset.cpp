// sightline cutset: the on-view faces of a scene along a path of viewpoints, by Tanimoto's cut-set.

#include "support/decisions.h"
#include "support/page.h"
#include "support/paths.h"
#include "support/picture.h"

#include <sightline/algorithms/cutset/tracker.h>
#include <sightline/algorithms/cutset/update_1977.h>
#include <sightline/harness/compare/cut_set_errors.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <iostream>
#include <map>
#include <utility>

namespace sightline::app {

namespace {

struct Cutset_arguments {
  Common common;
  Path_arguments path;
  Decision_arguments decisions;
  Canvas_arguments canvas;
  std::string method = "tracker", svg, html, shade = "lambert";
  bool faces = false, check = false;
};

/// What one viewpoint gave.
struct Frame {
  std::size_t number;  // from 1
  Viewpoint view;
  Cut_set_counters counters;
  std::size_t cut_edges, on_view;  // on_view: faces
  std::vector<Face_id> faces;      // these, sorted, where they were asked for: frames times faces may be much
  std::vector<bool> nodes;         // on-view; for a picture
  std::size_t wrong = 0;           // nodes and edges that brute force contradicts, where that was asked for
};

/// Faces of which a piece is on-view, sorted. A face that is not planar has pieces in several planes.
template <class Tracker>
std::vector<Face_id> faces_on_view(const Face_graph& graph, const Tracker& tracker) {
  std::vector<Face_id> faces;
  const std::vector<Piece>& pieces = graph.scene().pieces();
  for (std::uint32_t i = 0; i < pieces.size(); ++i)
    if (tracker.on_view(graph.node(i)) && (faces.empty() || faces.back() != pieces[i].face))
      faces.push_back(pieces[i].face);  // pieces are in the order of faces
  return faces;
}

/// Nodes and edges of which a tracker says something else than a test of each piece does.
template <class Tracker>
std::size_t disagreements(const Exact_traits& traits, const Face_graph& graph, const Tracker& tracker,
                          const Viewpoint& view) {
  return cut_set_errors(graph, on_view_nodes(traits, graph, view), tracker);
}

/// A frame of the page: which pieces are on-view.
struct Page_frame {
  std::size_t number;
  Viewpoint view;
  std::vector<bool> pieces;
  std::size_t cut_edges, tests;
};

/// What a path gave: all frames for JSON, otherwise the first ones and those of a picture.
struct Followed {
  std::vector<Frame> frames;
  std::vector<Page_frame> page;
  Cut_set_counters total;
  std::size_t count = 0, wrong = 0;  // frames, and those that brute force contradicts
  std::size_t cut_edges = 0;         // in all but the first, which is tested as a whole
  double seconds = 0;
};

constexpr std::size_t frames_shown = 20;

/// As many frames as a page of so many pieces has: a bit for each of both.
std::size_t frames_of_page(std::size_t pieces) {
  constexpr std::size_t most_bits = 1800000, most = 360, least = 2;
  return std::clamp(most_bits / std::max<std::size_t>(pieces, 1), least, most);
}

/// A path, by whatever tracker: move(view) says what it took.
template <class Tracker, class Move>
Followed follow(const Cutset_arguments& arguments, const Exact_traits& traits, const Face_graph& graph,
                const Path& path, const Report& in_time, const Tracker& tracker, Move move) {
  Progress progress("moving");
  const auto report = [&](std::size_t done, std::size_t all) {
    in_time(done, all);
    progress(done, all);
  };
  const std::size_t every = (path.size + pictures_in_a_strip - 1) / pictures_in_a_strip,
                    in_page = frames_of_page(graph.scene().pieces().size()),
                    every_in_page = (path.size + in_page - 1) / in_page;
  Followed followed;
  for (std::size_t k = 0; k < path.size; ++k) {
    report(k, path.size);
    const Viewpoint view = path.at(k);
    const Stopwatch watch;
    const Cut_set_counters counters = move(view);
    followed.seconds += watch.seconds();
    const std::size_t cut_edges = tracker.cut_edges().size(),
                      wrong = arguments.check ? disagreements(traits, graph, tracker, view) : 0;
    followed.total += counters;
    ++followed.count;
    followed.wrong += wrong > 0;
    if (k > 0) followed.cut_edges += cut_edges;
    if (!arguments.html.empty() && k % every_in_page == 0) {
      Page_frame& frame = followed.page.emplace_back(Page_frame{k + 1, view, {}, cut_edges, counters.tests});
      for (std::uint32_t i = 0; i < graph.scene().pieces().size(); ++i)
        frame.pieces.push_back(tracker.on_view(graph.node(i)));
    }
    const bool pictured = !arguments.svg.empty() && k % every == 0;
    if (k >= frames_shown && !pictured && arguments.common.json.empty()) continue;
    std::vector<Face_id> faces = faces_on_view(graph, tracker);
    Frame& frame = followed.frames.emplace_back(Frame{k + 1, view, counters, cut_edges, faces.size(), {}, {}, wrong});
    if (arguments.faces) frame.faces = std::move(faces);
    if (pictured)
      for (std::uint32_t node = 0; node < graph.size(); ++node) frame.nodes.push_back(tracker.on_view(node));
  }
  return followed;
}

/// The edges of a face graph by a piece and its corner where they begin, and a piece on the other side.
Json edges_json(const Face_graph& graph) {
  const Scene& scene = graph.scene();
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::uint32_t>> places;
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
    const auto corners = scene.corners(scene.pieces()[i]);
    for (std::uint32_t c = 0; c < corners.size(); ++c)
      places.try_emplace({corners[c].point, corners[(c + 1) % corners.size()].point}, i, c);
  }
  std::vector<std::uint32_t> pieces, corners, others;
  for (const Face_graph::Edge& edge : graph.edges()) {
    const auto at = places.find({edge.from, edge.to});
    if (at == places.end()) continue;
    pieces.push_back(at->second.first);
    corners.push_back(at->second.second);
    others.push_back(graph.piece(edge.second));
  }
  return {{"pieces", packed(pieces)}, {"corners", packed(corners)}, {"others", packed(others)}};
}

/// At each place of the path the pieces of which a test of each plane in doubles says something else than an exact one.
Json made_by_doubles(const Exact_traits& traits, const Face_graph& graph, const std::vector<Page_frame>& frames,
                     const Time_limit& limit) {
  const std::size_t pieces = graph.scene().pieces().size();
  if (pieces > Page::most_triangles) return doubles_left_out("the faces are too many");
  return asked_of_doubles(limit, [&](const Report& report) -> Json {
    constexpr std::size_t most = 100000;  // of the one kind, in a page
    const Rounded_planes<double> rounded(graph);
    std::vector<std::uint32_t> begin_missing{0}, begin_extra{0}, missing, extra;
    for (std::size_t k = 0; k < frames.size(); ++k) {
      report(k, frames.size());
      const std::vector<bool> truth = on_view_nodes(traits, graph, frames[k].view),
                              said = rounded.on_view(frames[k].view);
      for (std::uint32_t i = 0; i < pieces; ++i) {
        const std::uint32_t node = graph.node(i);
        if (truth[node] != said[node]) (truth[node] ? missing : extra).push_back(i);
      }
      if (missing.size() > most || extra.size() > most)
        return doubles_left_out("they err in too many faces for a page");
      begin_missing.push_back(static_cast<std::uint32_t>(missing.size()));
      begin_extra.push_back(static_cast<std::uint32_t>(extra.size()));
    }
    return {{"missing", {{"begin", packed(begin_missing)}, {"pieces", packed(missing)}}},
            {"extra", {{"begin", packed(begin_extra)}, {"pieces", packed(extra)}}}};
  });
}

/// The path, and at each of its places what is on-view; `doubles`: what stands under that key.
void write_page(const Cutset_arguments& arguments, const Face_graph& graph, const Followed& followed, Json doubles) {
  Page page("cutset", graph.scene());
  page.add_fact("faces", fmt::format("{}", graph.scene().counters().faces));
  page.add_fact("face graph", fmt::format("{} nodes, {} edges", graph.size(), graph.edges().size()));
  page.add_fact("path", fmt::format("{} viewpoints", followed.count));
  page.add_fact("method", arguments.method);
  if (followed.page.size() < followed.count)
    page.add_note(fmt::format("{} of {} viewpoints are shown, evenly", followed.page.size(), followed.count));
  for (const auto& [name, role] :
       {std::pair("on-view", "seen"), {"on-view since the step before", "new"}, {"off-view", "hidden"}})
    page.add_group(name, role);
  page.add_pieces(graph.scene());
  std::vector<std::uint32_t> numbers, cuts, tests;
  std::vector<bool> on, at_infinity;
  Json places = Json::array(), texts = Json::array();
  for (const Page_frame& frame : followed.page) {
    numbers.push_back(static_cast<std::uint32_t>(frame.number));
    cuts.push_back(static_cast<std::uint32_t>(frame.cut_edges));
    tests.push_back(static_cast<std::uint32_t>(frame.tests));
    at_infinity.push_back(frame.view.at_infinity);
    on.insert(on.end(), frame.pieces.begin(), frame.pieces.end());
    places.push_back(frame.view.at_infinity ? Json() : page.place(frame.view.at));
    texts.push_back(Page::text(frame.view.at));
  }
  page.more()["frames"] = {{"numbers", packed(numbers)},  {"cut_edges", packed(cuts)},
                           {"tests", packed(tests)},      {"at_infinity", packed(at_infinity)},
                           {"places", std::move(places)}, {"texts", std::move(texts)},
                           {"on_view", packed(on)}};
  page.more()["doubles"] = std::move(doubles);
  constexpr std::size_t most_edges = 40000;
  if (graph.edges().size() <= most_edges) page.more()["edges"] = edges_json(graph);
  else page.add_note("so many edges are too many for a page: the cut is left out");
  page.write(arguments.html);
}

Json frames_json(const std::vector<Frame>& frames, const Cutset_arguments& arguments) {
  Json list = Json::array();
  for (const Frame& frame : frames) {
    Json entry{{frame.view.at_infinity ? "direction" : "eye", point_json(frame.view.at)},
               {"on_view", arguments.faces ? Json(frame.faces) : Json(frame.on_view)},
               {"cut_edges", frame.cut_edges},
               {"tests", frame.counters.tests},
               {"tests_away", frame.counters.away},
               {"births", frame.counters.births},
               {"changed", frame.counters.changed}};
    if (arguments.check) entry["wrong"] = frame.wrong;
    list.push_back(std::move(entry));
  }
  return list;
}

void print_frames(const Followed& followed, bool check) {
  std::cout << "frame  on-view  cut edges    tests  births  viewpoint\n";
  for (const Frame& frame : followed.frames) {
    if (frame.number > frames_shown) break;
    const Exact_point& at = frame.view.at;
    std::cout << fmt::format("{:>5}  {:>7}  {:>9}  {:>7}  {:>6}  {}({:g}, {:g}, {:g}){}\n", frame.number, frame.on_view,
                             frame.cut_edges, frame.counters.tests, frame.counters.births,
                             frame.view.at_infinity ? "at infinity, " : "", nearest_double(at[0]),
                             nearest_double(at[1]), nearest_double(at[2]), check && frame.wrong > 0 ? "  WRONG" : "");
  }
  if (followed.count > frames_shown)
    std::cout << fmt::format("  ... {} more: --json - prints them all\n", followed.count - frames_shown);
}

Exit run_decisions(const Cutset_arguments& arguments) {
  const Scene scene = scene_of(arguments.common.read());
  const Report in_time = arguments.common.within_budget();
  const Stopwatch watch;
  const Decisions decisions = [&] {
    const Waiting waiting("searching");
    return decide(arguments.decisions, Face_graph(scene), in_time);
  }();
  const double seconds = watch.seconds();
  if (write_json(arguments.common, "cutset", scene, {{"decision_tree", to_json(decisions)}},
                 {{"states", decisions.tree.states}}, {{"search", seconds}}))
    return Exit::done;
  scene_rows(scene);
  print(decisions);
  row("seconds", fmt::format("{:.3f}", seconds));
  return Exit::done;
}

/// Of what does not go together.
void check_usage(const Cutset_arguments& arguments) {
  check_usage(arguments.path);
  const Decision_arguments& decisions = arguments.decisions;
  if (arguments.path.given() == decisions.wanted)
    throw Usage_error("cutset wants a path (--path FILE, --orbit FRAMES or --motion FILE) or --decision-tree");
  if (!decisions.wanted && (decisions.inside || !decisions.likelihood.empty()))
    throw Usage_error("--inside and --likelihood go with --decision-tree");
  for (const auto& [option, is_given] : {std::pair("--html", !arguments.html.empty()),
                                         {"--svg", !arguments.svg.empty()},
                                         {"--faces", arguments.faces},
                                         {"--check", arguments.check},
                                         {"--method", arguments.method != Cutset_arguments{}.method}})
    if (decisions.wanted && is_given)
      throw Usage_error(fmt::format("{} is of a path: leave it out with --decision-tree", option));
  for (const auto& [option, is_given] : {std::pair("--size", !arguments.canvas.size.empty()),
                                         {"--background", !arguments.canvas.background.empty()},
                                         {"--shade", arguments.shade != Cutset_arguments{}.shade}})
    if (arguments.svg.empty() && is_given) throw no_picture_for(option);
}

/// By the tracker or by an update as published, which tests all nodes for the first frame.
Followed follow(const Cutset_arguments& arguments, const Exact_traits& traits, const Face_graph& graph,
                const Path& path, const Report& in_time) {
  if (arguments.method == "tracker") {
    Cut_set_tracker tracker(traits, graph);
    return follow(arguments, traits, graph, path, in_time, tracker,
                  [&](const Viewpoint& view) { return tracker.move_to(view); });
  }
  Cut_set_1977<Exact_traits> update(traits, graph, path.at(0),
                                    arguments.method == "1977" ? Reading_1977::mended : Reading_1977::literal);
  bool started = false;
  return follow(arguments, traits, graph, path, in_time, update, [&](const Viewpoint& view) {
    Cut_set_counters counters;
    counters.tests = started ? update.update_1977(view) : graph.size();
    started = true;
    return counters;
  });
}

/// The frames that were picked for it, beside each other.
void write_picture(const Cutset_arguments& arguments, const Face_graph& graph, const std::vector<Frame>& frames) {
  std::vector<Outline> outlines;
  for (const Frame& frame : frames)
    if (!frame.nodes.empty())
      outlines.push_back({frame.view, frame.nodes, frame.number,
                          fmt::format("{}: {} on-view, {} tests", frame.number, frame.on_view, frame.counters.tests)});
  write_file(arguments.svg, painted(graph, outlines, arguments.canvas, arguments.shade == "lambert"));
}

/// Components that are convex bodies.
std::size_t convex_bodies(const Face_graph& graph) {
  std::size_t convex = 0;
  for (const Face_graph::Component& component : graph.components()) convex += component.inside.has_value();
  return convex;
}

Json counters_of(const Face_graph& graph, const Followed& followed) {
  Json counters{{"nodes", graph.size()},
                {"edges", graph.edges().size()},
                {"components", graph.components().size()},
                {"convex", convex_bodies(graph)},
                {"refused", graph.refused()},
                {"first_tests", followed.frames.front().counters.tests}};
  append_counters(counters, followed.total);
  return counters;
}

/// What frames took, all faces and the cut-set's edges beside it; the first one apart, which tests all.
void print_tests(const Followed& followed, const Face_graph& graph, bool is_tracked) {
  const Cut_set_counters &total = followed.total, &first = followed.frames.front().counters;
  const std::size_t later = followed.count - 1;
  const std::uint64_t tests = total.tests - first.tests, away = total.away - first.away;
  const auto a_frame = [&](std::uint64_t part) {
    return later == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(later);
  };
  const double share =
      later == 0 || graph.size() == 0 ? 0 : static_cast<double>(tests) / static_cast<double>(later * graph.size());
  row("tests",
      fmt::format(
          "{} for the first frame; then {:.4g} a frame: {:.3g}% of testing all faces, {:.3g} for each "
          "edge of the cut-set",
          first.tests, a_frame(tests), 100 * share,
          followed.cut_edges == 0 ? 0.0 : static_cast<double>(tests) / static_cast<double>(followed.cut_edges)));
  if (is_tracked && later > 0)
    row("tests split", fmt::format("{:.4g} a frame at the cut-set, {:.4g} away from it, where births are looked for",
                                   a_frame(tests - away), a_frame(away)));
  row("beyond doubles", fmt::format("{} of {} tests", total.exact, total.tests));
  if (is_tracked)
    row("changes",
        fmt::format(
            "{} of nodes, {} clusters born away from the cut-set, {} searches of convex bodies that showed no face",
            total.changed, total.births, total.searches));
}

void print(const Cutset_arguments& arguments, const Face_graph& graph, const Followed& followed, double graph_seconds) {
  scene_rows(graph.scene());
  row("face graph",
      fmt::format("{} nodes (faces joined across coplanar edges), {} edges, {} components, {} of them convex bodies",
                  graph.size(), graph.edges().size(), graph.components().size(), convex_bodies(graph)));
  if (graph.refused() > 0)
    row("not manifold", fmt::format("{} pieces stand apart in the graph: births, not the cut-set, find their changes",
                                    graph.refused()));
  print_frames(followed, arguments.check);
  print_tests(followed, graph, arguments.method == "tracker");
  if (arguments.check)
    row("check", followed.wrong == 0 ? fmt::format("all {} frames equal brute force", followed.count)
                                     : fmt::format("{} of {} frames are WRONG", followed.wrong, followed.count));
  row("seconds",
      fmt::format("{:.3f} for the graph, {:.4f} for {} frames", graph_seconds, followed.seconds, followed.count));
}

Exit run(const Cutset_arguments& arguments) {
  const Common& common = arguments.common;
  check_usage(arguments);
  if (arguments.decisions.wanted) return run_decisions(arguments);
  const Scene scene = scene_of(common.read());
  const Path path = path_of(arguments.path, scene);
  const Report in_time = common.within_budget();
  const Time_limit limit(common.budget);
  const Stopwatch watch;
  const Face_graph graph(scene);
  const Exact_traits traits(scene);
  const double graph_seconds = watch.seconds();
  const Followed followed = follow(arguments, traits, graph, path, in_time);

  if (!arguments.svg.empty()) write_picture(arguments, graph, followed.frames);
  if (!arguments.html.empty())
    write_page(arguments, graph, followed, made_by_doubles(traits, graph, followed.page, limit));
  Json result;
  if (!common.json.empty()) result["frames"] = frames_json(followed.frames, arguments);
  if (arguments.check) result["wrong_frames"] = followed.wrong;
  if (!write_json(common, "cutset", scene, std::move(result), counters_of(graph, followed),
                  {{"graph", graph_seconds}, {"frames", followed.seconds}}))
    print(arguments, graph, followed, graph_seconds);
  return followed.wrong > 0 ? Exit::disagreement : Exit::done;
}

}  // namespace

void add_cutset(Command program) {
  const Command command =
      program.add_command("cutset", "The on-view faces along a path of viewpoints: cut-set, tests, births");
  auto a = std::make_shared<Cutset_arguments>();
  a->common.add_to(command);
  add_to(command, a->path);
  add_to(command, a->decisions);
  command.add_flag("--faces", a->faces, "in the JSON, `on_view` is the list of on-view faces, not their number");
  command.add_flag("--check", a->check, "hold each frame to a test of every face; exit code 1 where one is wrong");
  command
      .add_option("--method", a->method,
                  "tracker: right whatever the move; 1977: the published update, which loses faces on some moves; "
                  "1977-literal: the same to the letter, which loses edges of the cut-set")
      .check(one_of({"tracker", "1977", "1977-literal"}))
      .show_default();
  command
      .add_option("--svg", a->svg,
                  "draw up to twelve of the frames: on-view faces, those green that became on-view since the frame "
                  "drawn before, and the cut-set as an outline")
      .writes_file(".svg");
  command.add_option("--html", a->html, "write a page to look at, which plays the path: on-view faces and the cut-set")
      .writes_file(".html");
  add_shade_option(command, a->shade);
  a->canvas.add_to(command, "by default each frame is 300 wide");
  command.footer(
      "Example: sightline cutset bunny.off --orbit 360 --check --svg orbit.svg\n"
      "         sightline cutset box.off --decision-tree\n"
      "A face counts as on-view where a piece of it is; a viewpoint in a face's plane is off-view. `tests` are on-view "
      "predicates, `births` clusters of changed faces away from the cut-set.");
  command.set_action([a] { return run(*a); });
}

}  // namespace sightline::app
