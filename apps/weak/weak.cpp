// sightline weak: the faces that are weakly visible from polygons, a picture of them and their certificate.

#include "weak.h"

#include "../methods/along.h"
#include "../support/drawing.h"
#include "../support/page.h"
#include "outputs.h"
#include "page.h"
#include "picture.h"

#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/weak_visibility/certificate.h>

#include <optional>
#include <tuple>

namespace sightline::app {

namespace {

/// --partition and --along are questions of their own, with options of their own.
Exit run_other_question(const Weak_arguments& arguments) {
  const bool is_partition = arguments.partition.asked_for();
  const std::string name = is_partition ? "--partition" : "--along";
  const char* const given = arguments.view.first_given();
  for (const auto& [other, is_given] : {std::pair("--obj", !arguments.obj.empty()),
                                        {"--mesh", !arguments.mesh.empty()},
                                        {"--eye", !arguments.eye.empty()},
                                        {given, given != nullptr},
                                        {"--html", !arguments.html.empty()},
                                        {"--surfaces", !arguments.surfaces.empty()}})
    if (is_given)
      throw Usage_error(std::string(other) + " is for faces that are visible or hidden: leave it out with " + name);
  if (is_partition && !arguments.certificate.empty())
    throw Usage_error("--certificate is not written of a partition: leave it out with --partition");
  if (is_partition) return run_partition(arguments.partition, arguments.common, arguments.sources, arguments.svg);
  if (!arguments.sources.empty()) throw Usage_error("--along is a path of its own: leave out --from and its like");
  return run_along(arguments.common,
                   {arguments.along, arguments.sources.two_sided, arguments.certificate, arguments.svg});
}

/// Of what does not go together.
void check_usage(const Weak_arguments& arguments) {
  const std::string& method = arguments.method;
  if ((method == "sample" || method == "doubles") && !arguments.certificate.empty())
    throw Usage_error("--method " + method + " proves nothing: leave out --certificate, or take --method lines");
  const Weak_task usual;
  for (const auto& [option, its, is_given] :
       {std::tuple("--rays", "sample", arguments.task.rays != usual.rays),
        {"--cells", "lines", arguments.task.cells != usual.cells},
        {"--event-edges", "lines", arguments.task.event_edges != usual.event_edges}})
    if (is_given && method != its) throw Usage_error(fmt::format("{} is for --method {}: leave it out", option, its));
  if (!arguments.surfaces.empty() && method != "events")
    throw Usage_error("--surfaces are those of events: add --method events");
  if (!arguments.surfaces.empty() && !arguments.surfaces.ends_with(".obj") && !arguments.surfaces.ends_with(".json"))
    throw Usage_error("--surfaces wants a file that ends with .json or .obj, not " + arguments.surfaces);
  arguments.view.check_usage(!arguments.svg.empty());
  if (arguments.svg.empty() && !arguments.eye.empty())
    throw Usage_error("--eye is the eye of the picture: add --svg FILE, or leave it out");
  if (!arguments.eye.empty()) parse_point(arguments.eye, "--eye");
}

/// What the method is asked, within a limit: some leave open what they have no time for, others end.
Weak_task task_of(const Weak_arguments& arguments, const Time_limit& limit, const Report& report) {
  const Common& common = arguments.common;
  Weak_task task = arguments.task;
  task.two_sided = arguments.sources.two_sided;
  task.threads = common.threads;
  task.seed = common.seed;
  task.surfaces = !arguments.surfaces.empty();
  const bool leaves_open = arguments.method == "lines" || arguments.method == "events";
  if (leaves_open) task.out_of_time = limit.end();
  task.progress = leaves_open ? report : common.within_budget(report);
  return task;
}

/// What a search in doubles makes of an exact answer, for its page.
Json made_by_doubles(Weak_arguments arguments, const Occluders& occluders, const Sources& sources,
                     const Weakly_visible& found, const Time_limit& limit) {
  if (arguments.method != "lines" && arguments.method != "events")
    return doubles_left_out(fmt::format("by {} the answer is not exact itself", arguments.method));
  return asked_of_doubles(limit, [&](const Report& report) {
    arguments.method = "doubles";
    Weak_task task = task_of(arguments, limit, {});
    task.progress = report;
    task.out_of_time = limit.end();
    const Weakly_visible doubles = run_weak_method(arguments.method, occluders, sources, task).found;
    report(1, 1);  // what they had no time for is not theirs
    return doubles_json(found, doubles);
  });
}

/// The certificate, surfaces, pictures and the page, where they are asked for; `limit`: of the answer.
void write_outputs(const Weak_arguments& arguments, const Polygon_soup& soup, const Occluders& occluders,
                   const Sources& sources, const Weak_outcome& outcome, const Time_limit& limit) {
  const Scene& scene = occluders.scene();
  const Weakly_visible& found = outcome.found;
  if (!arguments.certificate.empty())
    write_file(arguments.certificate, [&](std::ostream& out) {
      write_certificate(out, weak_certificate(scene, sources.points, arguments.sources.two_sided, found));
    });
  if (!arguments.surfaces.empty())
    write_file(arguments.surfaces, arguments.surfaces.ends_with(".obj")
                                       ? surfaces_obj(outcome.surfaces)
                                       : surfaces_json(scene, outcome.surfaces).dump() + "\n");
  const std::vector<std::string> names = names_of(scene, found, sources.points.size());
  if (!arguments.svg.empty()) draw(arguments, soup, occluders, sources, names);
  if (!arguments.obj.empty() || !arguments.mesh.empty())
    write_drawings(arguments.obj, arguments.mesh, drawing_of(scene, sources, names));
  if (!arguments.html.empty())
    write_page(arguments, scene, sources, found, names, made_by_doubles(arguments, occluders, sources, found, limit));
}

Json counters_of(const Weak_outcome& outcome) {
  Json counters = counters_json(outcome.found.counters);
  counters["events"] = counters_json(outcome.events);
  counters["events"]["surfaces"] = outcome.surfaces.size();
  return counters;
}

Json result_json(const Weak_arguments& arguments, const Occluders& occluders, const Sources& sources,
                 const Weak_outcome& outcome) {
  const Weakly_visible& found = outcome.found;
  return {{"visible", found.visible},
          {"hidden", found.hidden},
          {"undecided", found.undecided},
          {"certificate", arguments.certificate},
          {"unproved", found.unproved},
          {"by_events", outcome.by_events},
          {"within", outcome.within},
          {"open", arguments.common.json.empty() ? Json() : open_json(occluders, sources, found)}};
}

/// What is known of the faces.
void print_faces(const Weak_arguments& arguments, const Weak_outcome& outcome, std::size_t faces) {
  const Weakly_visible& found = outcome.found;
  row("visible", fmt::format("{} of {} faces", found.visible.size(), faces));
  if (arguments.method == "conservative")
    row("of these, too many",
        "those that several pieces hide together: `sightline compare SCENE weak` with the same sources says how many");
  if (!outcome.within.empty())
    row("of these, within",
        fmt::format("{}: parts of them are seen without leaving the volume", outcome.within.size()));
  row("hidden", fmt::format("{}", found.hidden.size()));
  row("undecided", found.undecided.empty()
                       ? "none"
                       : fmt::format("{}: --budget, --cells and --event-edges set how long each is looked at; --json "
                                     "shows the cells that are open",
                                     found.undecided.size()));
  if (!outcome.by_events.empty())
    row("by events", fmt::format("{} of them, that lines left open", outcome.by_events.size()));
  if (!found.unproved.empty())
    row("unproved", fmt::format("{}: a certificate leaves these open", found.unproved.size()));
}

/// How they came to be known.
void print_search(const Weak_arguments& arguments, const Weak_outcome& outcome) {
  const Weakly_visible& found = outcome.found;
  const Weak_counters& c = found.counters;
  const Event_counters& e = outcome.events;
  if (arguments.method == "sample")
    row("rays", fmt::format("{} from each source; nothing is proved", arguments.task.rays));
  if (arguments.method == "lines") {
    row("searches",
        fmt::format("{}: {} facing away, {} seen by the first lines, {} hidden by one piece, {} together with others; "
                    "{} cells in the others",
                    c.targets, c.away, c.by_rays, c.by_one, c.together, c.cells));
    if (found.visible.empty() && found.undecided.empty() && c.away > 0 && c.cells == 0 && c.by_one == 0)
      row("turned round?",
          "all faces are behind the source or have their backs to it; a source looks to the side from which its "
          "corners run counterclockwise: to look to the other one, write them backwards; --flip turns the scene "
          "instead");
    row("cells", fmt::format("{} blocked, {} empty, {} by what was learned; {} cuts, {} shaves, {} bisections; {} "
                             "linear programs, {} of them exact",
                             c.blocked, c.empty, c.learned, c.cuts, c.shaves, c.bisections,
                             c.programs + c.exact_programs, c.exact_programs));
  }
  if (e.targets > 0)
    row("events", fmt::format("{} searches; {} in planes of edges, {} of a vertex and an edge, {} of three edges; {} "
                              "cells of lines beside them",
                              e.targets, e.horizon, e.edge_vertex, e.triple, e.cells));
  if (!arguments.surfaces.empty())
    row("surfaces", fmt::format("{} in {}", outcome.surfaces.size(), arguments.surfaces));
}

Exit run_weak(const Weak_arguments& arguments) {
  const Common& common = arguments.common;
  if (arguments.partition.asked_for() || !arguments.along.empty()) return run_other_question(arguments);
  check_usage(arguments);
  const Polygon_soup soup = common.read();
  const Scene scene = scene_of(soup);

  // 1. What is visible.
  Stopwatch watch;
  const Occluders occluders(scene);
  const Time_limit limit(common.budget);
  const Sources sources = sources_of(arguments.sources, common, soup, occluders, common.within_budget());
  const double prepare_seconds = watch.seconds();
  Progress progress("searching");
  watch = {};
  const Weak_outcome outcome =
      run_weak_method(arguments.method, occluders, sources,
                      task_of(arguments, limit, [&](std::size_t done, std::size_t all) { progress(done, all); }));
  const double seconds = watch.seconds();
  progress.clear();

  // 2. What is written and told of it.
  write_outputs(arguments, soup, occluders, sources, outcome, limit);
  const Exit exit = outcome.found.undecided.empty() ? Exit::done : Exit::undecided;
  if (write_json(common, "weak", scene, result_json(arguments, occluders, sources, outcome), counters_of(outcome),
                 {{"prepare", prepare_seconds}, {"search", seconds}}))
    return exit;
  scene_rows(scene);
  row("sources", fmt::format("{} convex polygons", sources.polygons.size()));
  print_faces(arguments, outcome, scene.counters().faces);
  print_search(arguments, outcome);
  row("seconds", fmt::format("{:.4f}, and {:.4f} to prepare the scene", seconds, prepare_seconds));
  return exit;
}

}  // namespace

void add_weak(Command program) {
  const Command command =
      program.add_command("weak",
                          "The faces that are weakly visible from polygons or solids: seen from some "
                          "point of them, exactly, with a certificate for both answers");
  auto a = std::make_shared<Weak_arguments>();
  a->common.add_to(command);
  a->sources.add_to(command);
  const Option along =
      command
          .add_option("--along", a->along,
                      "instead of polygons an eye that moves straight from X,Y,Z to X,Y,Z: the exact moments at which "
                      "faces appear and disappear; --svg draws when each is visible")
          .check(not_empty());
  const Option partition = a->partition.add_to(command).excludes(along);
  const Option method =
      command
          .add_option(
              "--method", a->method,
              "lines: exact, with certificates; events: exact, by Plantinga's events, slow where many edges are near; "
              "doubles: a search without proofs; sample: random rays, as others do")
          .check(one_of({"lines", "events", "doubles", "sample"}))
          .show_default()
          .excludes(along)
          .excludes(partition);
  command
      .add_flag("--conservative{conservative}", a->method,
                "instead of a method: quick, visible is all that no single piece hides, so some faces too many; "
                "`sightline compare SCENE weak` says how many")
      .disable_flag_override()
      .excludes(method)
      .excludes(along)
      .excludes(partition);
  command.add_option("--rays", a->task.rays, "sample: from each source")
      .check(whole_number())
      .show_default()
      .excludes(along)
      .excludes(partition);
  command
      .add_option("--cells", a->task.cells,
                  "lines: how many cells a search may take before its face is undecided; 0: as many as it takes, "
                  "unless --event-edges says where to end")
      .check(whole_number())
      .show_default()
      .excludes(along)
      .excludes(partition);
  command
      .add_option(
          "--event-edges", a->task.event_edges,
          "lines: faces that stay undecided go to events where so many edges are near at most; 0: none does. More, "
          "and more cells, where neither this nor --cells is given")
      .check(whole_number())
      .show_default()
      .excludes(along)
      .excludes(partition);
  command
      .add_option("--certificate", a->certificate,
                  "write what `sightline verify` reads: of lines all answers, of events what is visible, with "
                  "--conservative what is hidden; with --along when each face is visible")
      .writes_file();
  command
      .add_option("--surfaces", a->surfaces,
                  "events: write the surfaces where visibility changes, FILE.json exactly, FILE.obj as strips; "
                  "then no search ends before it has them all")
      .writes_file();
  command
      .add_option(
          "--svg", a->svg,
          "draw the faces from an eye: visible ones orange, hidden ones grey; what has its back to the eye is left out")
      .writes_file(".svg");
  command
      .add_option("--html", a->html,
                  "write a page to look at: what is visible, hidden, undecided; of a face its sightline, or its proof "
                  "as a tree to walk")
      .writes_file(".html");
  add_mesh_option(command, a->mesh, "faces visible, hidden, undecided, and the sources,");
  command.add_option("--obj", a->obj, "the same as OBJ").writes_file(".obj");
  command
      .add_option(
          "--eye", a->eye,
          "the eye X,Y,Z of the picture; by default behind a source that looks into a room, and what is behind it "
          "is cut away, or else outside the scene")
      .check(not_empty());
  a->view.add_to(command);
  command.footer(
      "Example: sightline weak room.off --from \"0,0,1 1,0,1 1,0,2 0,0,2\" --svg room.svg --certificate room.json\n"
      "Exit code 4: some faces are undecided.");
  command.set_action([a] { return run_weak(*a); });
}

}  // namespace sightline::app
