// sightline order: the exact order of a scene from an eye, back to front or front to back, its picture and its
// certificate.

#include "methods/methods.h"
#include "support/drawing.h"
#include "support/page.h"

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/covering_of_scene.h>
#include <sightline/algorithms/image/bsp2d.h>
#include <sightline/algorithms/point_visibility/certificate.h>
#include <sightline/algorithms/priority/eye_order.h>
#include <sightline/algorithms/priority/kernels.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/harness/judge/order.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <iostream>

namespace sightline::app {

struct Order_arguments {
  Common common;
  View_arguments view;
  std::string eye, kernel = "exact", method = "bsp", certificate, svg, html, mesh;
  bool two_sided = false, front_to_back = false, skip_hidden = false;
  bool by_graph() const { return method == "graph"; }
};

/// What `verify` reads.
static Order_certificate certificate_of(const Scene& scene, const Exact_point& eye, const Outcome& outcome,
                                        bool on_view) {
  Order_certificate certificate;
  certificate.eye = eye;
  certificate.on_view = on_view;
  certificate.cuts = outcome.cuts;
  for (const Drawn& item : outcome.drawn) certificate.fragments.push_back(item.fragment);
  add_pieces(certificate, scene);
  return certificate;
}

/// A fragment with its corners.
static Drawn with_corners(const Exact_traits& traits, Drawn drawn, const Convex_polygon<Exact_traits>& polygon) {
  for (const Corner<Exact_traits>& corner : polygon) drawn.fragment.vertices.push_back(traits.position(*corner.vertex));
  return drawn;
}

namespace {

/// What of polygons is in front of a near plane, for a picture; nothing where there is no such plane.
class In_view {
 public:
  In_view(const Exact_traits& traits, const std::optional<Plane>& near) : traits_(traits) {
    if (near) cutter_ = traits.prepare(*near);
  }
  /// `drawn`: the polygon, but for its corners.
  void add(const Drawn& drawn, const Convex_polygon<Exact_traits>& polygon, Predicate_counts& counts,
           std::vector<Drawn>& to) {
    if (!cutter_) return;
    const Position at = classify(traits_, polygon, *cutter_, scratch_, counts);
    if (at == Position::in_front) to.push_back(with_corners(traits_, drawn, polygon));
    if (at == Position::across)
      to.push_back(with_corners(traits_, drawn, split(traits_, polygon, *cutter_, scratch_, store_)[1]));
  }

 private:
  const Exact_traits& traits_;
  std::optional<Prepared_plane> cutter_;
  Polygon_store<Exact_traits> store_;
  Split_scratch<Exact_traits> scratch_;
};

}  // namespace

/// What the order by the priority graph took, and its picture's polygons.
struct Graph_order {
  Priority_tree_counters tree;
  Eye_order_counters eye;
  std::vector<Drawn> in_view;  // in front of the near plane, where there is one
};

/// The order by the priority graph: whole faces but where they overlap in a cycle.
static Outcome run_graph(Scene& scene, const Task& task, bool two_sided, Graph_order& graph) {
  std::optional<Plane> near;
  if (task.near) near = scene.add_plane(*task.near);
  const Exact_traits traits(scene);
  Outcome outcome;
  Stopwatch watch;
  const Priority_tree<Exact_traits> tree = build_priority_tree(traits, {two_sided, false, task.bsp.progress});
  outcome.build_seconds = watch.seconds();
  watch = {};
  const Eye_order<Exact_traits> order = back_to_front(traits, tree, *task.eye, task.bsp.progress);
  outcome.order_seconds = watch.seconds();
  graph.tree = tree.counters;
  graph.eye = order.counters;
  outcome.tree.fragments = order.counters.fragments;
  outcome.tree.splits = order.counters.splits;
  outcome.tree.predicates = tree.counters.predicates;
  outcome.walk.predicates = order.counters.predicates;

  std::vector<std::uint32_t> seen(scene.counters().faces_read);
  In_view in_view(traits, near);
  for (const Convex_polygon<Exact_traits>& polygon : order.polygons) {
    if (task.bsp.progress && outcome.drawn.size() % 64 == 0)
      task.bsp.progress(outcome.drawn.size(), order.polygons.size());
    const Piece& piece = scene.pieces()[polygon.piece];
    Drawn drawn;
    drawn.fragment.face = piece.face;
    drawn.fragment.piece = piece.number;
    drawn.number = seen[piece.face]++;
    drawn.side = traits.side(traits.eye(*task.eye), piece.support, outcome.walk.predicates);
    outcome.drawn.push_back(with_corners(traits, drawn, polygon));
    in_view.add(drawn, polygon, outcome.walk.predicates, graph.in_view);
  }
  return outcome;
}

/// What the order by a tree that passes over what is hidden took, what is seen, and its picture's polygons.
struct Skipped_order {
  Bsp2d_counters counters;
  Visible_surface<Exact_view> surface;
  std::vector<Drawn> in_view;  // as in Graph_order
};

/// What is seen of the fragments of a tree, farthest first.
static Outcome run_skipping(Scene& scene, const Task& task, Skipped_order& skipped) {
  std::optional<Plane> near;
  if (task.near) near = scene.add_plane(*task.near);
  const Exact_traits traits(scene);
  Outcome outcome;
  Stopwatch watch;
  const Exact_tree tree = build_bsp(traits, task.bsp);
  outcome.build_seconds = watch.seconds();
  outcome.tree = tree.counters;
  watch = {};
  const Exact_view view(scene, *task.eye);
  Bsp2d_options options;
  options.progress = task.bsp.progress;
  Bsp2d result = bsp2d(view, tree, whole_sphere(view), options);
  outcome.order_seconds = watch.seconds();
  outcome.walk.nodes = result.counters.nodes;
  outcome.walk.fragments = result.counters.fragments;
  outcome.walk.on_planes = result.counters.on_planes;
  outcome.walk.predicates = result.counters.predicates;
  skipped = {result.counters, std::move(result.surface), {}};
  std::reverse(result.seen.begin(), result.seen.end());
  In_view in_view(traits, near);
  for (const std::uint32_t i : result.seen) {
    const Fragment<Exact_traits>& fragment = tree.fragments[i];
    const Piece& piece = scene.pieces()[fragment.polygon.piece];
    const Drawn drawn{{piece.face, piece.number, {}}, fragment.number, view.eye_side(fragment.polygon.piece)};
    outcome.drawn.push_back(with_corners(traits, drawn, fragment.polygon));
    in_view.add(drawn, fragment.polygon, outcome.walk.predicates, skipped.in_view);
  }
  return outcome;
}

/// An order, and what the way to it says besides.
struct Found_order {
  Outcome outcome;
  Graph_order graph;      // by the graph
  Skipped_order skipped;  // with --skip-hidden
};

/// An order of the same kind in plain doubles, as the judge takes it: faces that are drawn once, in one piece, stand
/// for themselves, others for the parts that doubles make of them. Errors: std::domain_error where one is no number.
static judge::Answer order_in_doubles(const Order_arguments& arguments, Scene& scene, Task task) {
  judge::Answer answer;
  task.near = std::nullopt;
  if (!arguments.by_graph()) {
    Outcome outcome = run_method("double", scene, task);
    if (outcome.not_finite > 0) throw std::domain_error("parts that are no numbers");
    for (Drawn& item : outcome.drawn) answer.order.push_back({item.fragment.face, std::move(item.fragment.vertices)});
  } else {
    const Double_traits traits(scene);
    const auto tree = build_priority_tree(traits, {arguments.two_sided, false, task.bsp.progress});
    const auto order = back_to_front(traits, tree, *task.eye, task.bsp.progress);
    for (const Convex_polygon<Double_traits>& polygon : order.polygons) {
      judge::Drawn_face& drawn = answer.order.emplace_back();
      drawn.face = scene.pieces()[polygon.piece].face;
      for (const Corner<Double_traits>& corner : polygon) drawn.part.push_back(traits.position(*corner.vertex));
    }
  }
  std::vector<std::uint32_t> parts(scene.counters().faces_read), pieces(scene.counters().faces_read);
  for (const judge::Drawn_face& drawn : answer.order) ++parts[drawn.face];
  for (const Piece& piece : scene.pieces()) ++pieces[piece.face];
  for (judge::Drawn_face& drawn : answer.order)
    if (parts[drawn.face] == 1 && pieces[drawn.face] == 1) drawn.part.clear();
  return answer;
}

/// What is in the wrong place where the order is found in plain doubles: pairs of faces, of which the first is nearer
/// somewhere, but the second painted over it.
static Json made_by_doubles(const Order_arguments& arguments, Scene& scene, const Task& task, const Found_order& found,
                            const Time_limit& limit) {
  // Each part is compared with all that it overlaps: where parts are so many, for seconds.
  constexpr std::size_t most_parts = 4000, most_pairs = 50000;
  if (arguments.kernel == "float" || arguments.kernel == "double" || arguments.kernel == "epick")
    return doubles_left_out(fmt::format("by --kernel {} the order is not exact itself", arguments.kernel));
  if (!scene.non_planar().empty()) return doubles_left_out("some faces are not planar");
  if (found.outcome.drawn.size() > most_parts || scene.pieces().size() > most_parts)
    return doubles_left_out(fmt::format("of more than {} parts all pairs would take too long", most_parts));
  return asked_of_doubles(limit, [&](const Report& report) -> Json {
    Task in_doubles = task;
    in_doubles.bsp.progress = report;
    const judge::Answer answer = order_in_doubles(arguments, scene, in_doubles);
    if (answer.order.size() > 2 * most_parts)
      return doubles_left_out(fmt::format("they cut faces into {} parts", answer.order.size()));
    const judge::Order_truth truth(scene, *task.eye, !arguments.by_graph() || arguments.two_sided);
    report(1, 2);
    const std::vector<std::array<Face_id, 2>> wrong = truth.wrong_pairs(answer);
    report(1, 1);
    if (wrong.size() > most_pairs)
      return doubles_left_out(fmt::format("{} wrong pairs are too many for a page", wrong.size()));
    std::vector<std::uint32_t> pairs;
    for (const auto& [covered, over] : wrong) pairs.insert(pairs.end(), {covered, over});
    return {{"pairs", packed(pairs)}};
  });
}

/// The fragments in their order, back to front; `doubles`: what stands under that key.
static void write_page(const Order_arguments& arguments, const Scene& scene, const Exact_point& eye,
                       const Outcome& outcome, Json doubles) {
  Page page("order", scene);
  page.set_eye(eye);
  page.add_fact("faces", fmt::format("{}", scene.counters().faces));
  page.add_fact("polygons", fmt::format("{}{}, back to front", outcome.drawn.size(),
                                        arguments.skip_hidden ? " that are seen" : ""));
  page.add_fact("cuts", fmt::format("{}", outcome.tree.splits));
  page.add_fact("method", arguments.by_graph() ? "graph" : "bsp, " + arguments.kernel);
  page.add_fact("eye", Page::text(eye));
  page.add_group("painted", "one a face");
  for (const Drawn& item : outcome.drawn) page.add_polygon(item.fragment.face, item.fragment.vertices);
  page.more()["doubles"] = std::move(doubles);
  page.write(arguments.html);
}

/// The same for programs that draw.
static void write_mesh(const std::string& file, const Outcome& outcome) {
  Grouped_polygons polygons;
  polygons.add_group("painted", drawing_colours::seen);
  std::vector<std::uint32_t> order(outcome.drawn.size());
  std::iota(order.begin(), order.end(), 0u);
  for (const Drawn& item : outcome.drawn) polygons.add_polygon(0, item.fragment.face, item.fragment.vertices);
  polygons.add_column("order", std::move(order));
  write_drawings({}, file, polygons);
}

/// Of what does not go together.
static void check_usage(const Order_arguments& arguments) {
  if (!arguments.eye.empty()) parse_point(arguments.eye, "--eye");
  arguments.view.check_usage(!arguments.svg.empty());
  if (arguments.by_graph() && arguments.kernel != "exact")
    throw Usage_error("--method graph is exact: leave out --kernel");
  if (!arguments.by_graph() && arguments.two_sided)
    throw Usage_error("--two-sided is for --method graph: a tree draws both sides anyway");
  if (!arguments.skip_hidden) return;
  if (!arguments.front_to_back) throw Usage_error("--skip-hidden needs --front-to-back: what hides comes first");
  if (arguments.by_graph() || arguments.kernel != "exact")
    throw Usage_error("--skip-hidden is for a tree, and exact: leave out --method and --kernel");
}

/// Back to front. Pre: the task has a near plane only where a picture wants one of an order that is not a plain tree's.
static Found_order find_order(const Order_arguments& arguments, Scene& scene, const Task& task) {
  Found_order found;
  if (arguments.by_graph()) found.outcome = run_graph(scene, task, arguments.two_sided, found.graph);
  else if (arguments.skip_hidden) found.outcome = run_skipping(scene, task, found.skipped);
  else found.outcome = run_method(arguments.kernel, scene, task);
  return found;
}

static void write_order_certificate(const Order_arguments& arguments, const Scene& scene, const Exact_point& eye,
                                    const Found_order& found, const Bsp_options& options) {
  options.progress(1, 1);  // no certificate once the budget is over
  write_file(arguments.certificate, [&](std::ostream& out) {
    if (arguments.skip_hidden)
      write_visible_certificate(out, Exact_view(scene, eye), found.skipped.surface, eye, {}, options.progress);
    else
      write_certificate(out, certificate_of(scene, eye, found.outcome, arguments.by_graph() && !arguments.two_sided));
  });
}

/// What is in front of the near plane, where there is one, as a painter paints it. A plain tree is asked again for it.
static void write_picture(const Order_arguments& arguments, Scene& scene, const View& view, Task task,
                          const std::optional<std::array<Integer, 4>>& near, const Found_order& found) {
  std::vector<Drawn> again;
  if (near && !task.near) {
    task.near = near;
    again = run_method(arguments.kernel, scene, task).drawn;
  }
  Svg svg = empty_picture(view);
  paint(svg, view,
        !near                   ? found.outcome.drawn
        : arguments.skip_hidden ? found.skipped.in_view
        : arguments.by_graph()  ? found.graph.in_view
                                : again,
        true);
  write_file(arguments.svg, svg.text());
}

static Json fragments_json(const std::vector<Drawn>& drawn) {
  Json fragments = Json::array();
  for (const Drawn& item : drawn) {
    Json vertices = Json::array();
    for (const Exact_point& p : item.fragment.vertices) vertices.push_back(point_json(p));
    fragments.push_back({{"face", item.fragment.face}, {"piece", item.number}, {"vertices", std::move(vertices)}});
  }
  return fragments;
}

static Json counters_of(const Order_arguments& arguments, const Found_order& found) {
  const Outcome& outcome = found.outcome;
  const Bsp_counters& c = outcome.tree;
  Json counters{{"kernel", arguments.kernel},
                {"nodes", c.nodes},
                {"depth", c.depth},
                {"splits", c.splits},
                {"fragments", c.fragments},
                {"free_planes", c.free_planes},
                {"eye_on_planes", outcome.walk.on_planes},
                {"not_finite", outcome.not_finite},
                {"degenerate", c.degenerate},
                {"predicates", predicates_json(c.predicates)},
                {"eye_predicates", predicates_json(outcome.walk.predicates)}};
  if (arguments.skip_hidden) counters["skip_hidden"] = counters_json(found.skipped.counters);
  if (arguments.by_graph()) {
    Json by = counters_json(found.graph.tree);
    append_counters(by, found.graph.eye);
    by["pairs"] = found.graph.tree.search.relation.pairs + found.graph.eye.search.relation.pairs;
    counters["graph"] = std::move(by);
  }
  return counters;
}

/// What --skip-hidden saw, and passed over.
static void print(const Skipped_order& skipped, const Bsp_counters& tree, std::size_t faces) {
  row("visible",
      fmt::format("{} faces, {} from behind", skipped.surface.visible.size(), skipped.surface.from_behind.size()));
  const Bsp2d_counters& k = skipped.counters;
  row("not visited",
      fmt::format("{} of {} nodes, {} of {} fragments, {} of {} faces; {} fragments visited in vain", k.nodes_skipped,
                  tree.nodes, k.fragments_skipped, tree.fragments, k.faces_skipped, faces, k.hidden + k.edge_on));
}

/// The first of the fragments, one a line.
static void print(const std::vector<Drawn>& drawn) {
  constexpr std::size_t shown = 20;
  for (std::size_t i = 0; i < std::min(shown, drawn.size()); ++i)
    std::cout << fmt::format("{:>6}. face {}, piece {}{}\n", i + 1, drawn[i].fragment.face, drawn[i].number,
                             drawn[i].side == CGAL::ZERO       ? ", edge-on"
                             : drawn[i].side == CGAL::NEGATIVE ? ", from behind"
                                                               : "");
  if (drawn.size() > shown)
    std::cout << fmt::format("   ... {} more: --json - prints them all, --svg draws them\n", drawn.size() - shown);
}

static void print(const Order_arguments& arguments, const Scene& scene, const Exact_point& eye,
                  const Found_order& found) {
  const Outcome& outcome = found.outcome;
  const Bsp_counters& c = outcome.tree;
  scene_rows(scene);
  row("eye", fmt::format("({}, {}, {})", to_string(eye[0]), to_string(eye[1]), to_string(eye[2])));
  const std::string direction = arguments.front_to_back ? "front to back" : "back to front";
  if (arguments.by_graph()) {
    const Eye_order_counters& by_eye = found.graph.eye;
    row("order", fmt::format("{} polygons, {}; {} off-view, {} searched for this eye, {} cyclic overlaps of "
                             "{} faces took {} cuts",
                             outcome.drawn.size(), direction, by_eye.off_view, by_eye.searched, by_eye.cycles,
                             by_eye.in_cycles, c.splits));
  } else {
    row("order", fmt::format("{} fragments{}, {}; the eye is in the planes of {} nodes", outcome.drawn.size(),
                             arguments.skip_hidden ? " that are seen" : "", direction, outcome.walk.on_planes));
  }
  if (arguments.skip_hidden) print(found.skipped, c, scene.counters().faces);
  if (outcome.not_finite + c.degenerate > 0)
    row("lost", fmt::format("{} fragments degenerate, {} not finite", c.degenerate, outcome.not_finite));
  row("seconds", fmt::format("{:.3f} to build, {:.4f} to order ({})", outcome.build_seconds, outcome.order_seconds,
                             arguments.kernel));
  if (arguments.certificate.empty() && arguments.svg.empty() && arguments.html.empty() && arguments.mesh.empty())
    print(outcome.drawn);
}

static Exit run(const Order_arguments& arguments) {
  const Common& common = arguments.common;
  check_usage(arguments);
  Scene scene = scene_of(common.read());
  const Exact_point eye = eye_of(arguments.eye, scene);
  const View view = arguments.svg.empty() ? View{eye} : arguments.view.view(eye, scene);
  const std::optional<std::array<Integer, 4>> near = arguments.svg.empty() ? std::nullopt : near_plane(view, scene);

  // 1. The order.
  Progress progress("building");
  const Time_limit limit(common.budget);
  Task task;
  task.eye = eye;
  task.bsp.seed = common.seed;
  task.bsp.threads = common.threads;
  task.bsp.progress = common.within_budget(progress);
  if (arguments.by_graph() || arguments.skip_hidden) task.near = near;
  Found_order found = find_order(arguments, scene, task);

  // 2. What is written of it, back to front.
  if (!arguments.certificate.empty()) write_order_certificate(arguments, scene, eye, found, task.bsp);
  if (!arguments.svg.empty()) write_picture(arguments, scene, view, task, near, found);
  if (!arguments.html.empty()) {
    progress.clear();
    write_page(arguments, scene, eye, found.outcome, made_by_doubles(arguments, scene, task, found, limit));
  }
  if (!arguments.mesh.empty()) write_mesh(arguments.mesh, found.outcome);

  // 3. What is told of it; the other way round is an order, too.
  std::vector<Drawn>& drawn = found.outcome.drawn;
  if (arguments.front_to_back) std::reverse(drawn.begin(), drawn.end());
  progress.clear();
  Json result{{"eye", point_json(eye)}, {"fragments", common.json.empty() ? Json::array() : fragments_json(drawn)}};
  if (arguments.skip_hidden) {
    result["visible"] = found.skipped.surface.visible;
    result["from_behind"] = found.skipped.surface.from_behind;
  }
  if (!write_json(common, "order", scene, std::move(result), counters_of(arguments, found),
                  {{"build", found.outcome.build_seconds}, {"order", found.outcome.order_seconds}}))
    print(arguments, scene, eye, found);
  return Exit::done;
}

void add_order(Command program) {
  const Command command = program.add_command(
      "order", "The exact order of a scene from an eye, back to front, with a picture and a certificate");
  auto a = std::make_shared<Order_arguments>();
  a->common.add_to(command);
  add_eye_option(command, a->eye);
  command.add_option("--kernel", a->kernel, "arithmetic").check(one_of(kernel_names)).show_default();
  command
      .add_option("--method", a->method,
                  "bsp: a tree that cuts faces, both sides of each drawn; graph: the on-view faces, whole but where "
                  "they overlap in a cycle")
      .check(one_of({"bsp", "graph"}))
      .show_default();
  command.add_flag("--two-sided", a->two_sided, "with --method graph: faces seen from behind too");
  command.add_flag("--front-to-back", a->front_to_back, "list the nearest first");
  command.add_flag("--skip-hidden", a->skip_hidden,
                   "with --front-to-back: only what is seen; what is behind that is not visited");
  command
      .add_option("--certificate", a->certificate,
                  "write what `sightline verify` reads: of the order; with --skip-hidden of what is seen")
      .writes_file();
  command.add_option("--svg", a->svg, "draw the order as a painter would").writes_file(".svg");
  command.add_option("--html", a->html, "write a page to look at, in which a slider paints back to front")
      .writes_file(".html");
  add_mesh_option(command, a->mesh, "the fragments, back to front,");
  a->view.add_to(command);
  command.footer(
      "Example: sightline order room.off --eye 0.5,-3,1.7 --svg room.svg --certificate room.json\n"
      "A fragment is [face, piece]; the certificate's `piece` is the convex piece of the face that the fragment is a "
      "part of.");
  command.set_action([a] { return run(*a); });
}

}  // namespace sightline::app
