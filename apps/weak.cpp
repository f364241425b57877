// sightline weak: the faces that are weakly visible from polygons, a picture of them and their certificate.

#include "methods/methods.h"
#include "methods/weak.h"

#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/weak_visibility/certificate.h>

namespace sightline::app {

namespace {

struct Weak_arguments {
  Common common;
  View_arguments view;
  Source_arguments sources;
  std::string method = "lines", certificate, svg, obj, eye, surfaces;
  Weak_task task;
};

// ---- Pictures

/// visible, hidden, undecided or "source", by face; sources are numbered after the faces.
std::vector<std::string> names_of(const Scene& scene, const Weak_faces& found, std::size_t sources) {
  std::vector<std::string> names(scene.counters().faces_read + sources, "source");
  const auto set = [&](const std::vector<Face_id>& faces, const char* name) {
    for (const Face_id face : faces) names[face] = name;
  };
  set(found.visible, "visible");
  set(found.hidden, "hidden");
  set(found.undecided, "undecided");
  return names;
}

/// The fronts of faces, as a painter paints them: what has its back to the eye is left out, so that one looks into
/// rooms.
void draw(const Weak_arguments& arguments, Polygon_soup soup, const Sources& sources,
          const std::vector<std::string>& names) {
  for (const std::vector<Exact_point>& polygon : sources.points) {
    std::vector<Point_id> loop;
    for (const Exact_point& p : polygon) loop.push_back(soup.add_point(p[0], p[1], p[2]));
    soup.add_face(loop);
  }
  Scene scene(soup);
  const Exact_point eye = eye_of(arguments.eye, scene);
  const View view = arguments.view.view(eye, scene);
  Task task;
  task.eye = eye;
  task.bsp.threads = arguments.common.threads;
  task.near = near_plane(view, scene);
  std::vector<Drawn> drawn = run_method("exact", scene, task).drawn;
  for (const std::vector<Face_id>* list :
       {&arguments.sources.faces,
        &arguments.sources.solid})  // faces of the scene that are sources: themselves, not their doubles
    for (const Face_id face : *list)
      for (Drawn& item : drawn)
        if (item.fragment.face == face) item.fragment.face = static_cast<Face_id>(names.size() - 1);
  std::erase_if(
      drawn, [&](const Drawn& item) { return item.side != CGAL::POSITIVE && names[item.fragment.face] != "source"; });
  Svg svg = empty_picture(view);
  paint(svg, view, drawn, true, [&](const Drawn& item, double shade) {
    const std::string& name = names[item.fragment.face];
    const auto [hue, strength, light] = name == "visible"  ? std::tuple(38, 85, 62)
                                        : name == "hidden" ? std::tuple(215, 12, 60)
                                        : name == "source" ? std::tuple(350, 75, 50)
                                                           : std::tuple(290, 60, 55);
    return fmt::format("hsl({},{}%,{:.0f}%)", hue, strength, light + 14 * shade);
  });
  svg.label(12, 22, 14, "orange: visible, grey: hidden, violet: undecided, red: the source");
  write_file(arguments.svg, svg.text());
}

/// The scene's pieces in groups "visible", "hidden", "undecided", coordinates rounded.
std::string obj_text(const Scene& scene, const std::vector<std::string>& names) {
  std::string text;
  std::size_t points = 0;
  for (const Piece& piece : scene.pieces()) {
    std::string face = "f";
    for (const Piece_corner& corner : scene.corners(piece)) {
      const Exact_point p = scene.position(corner.point);
      text += fmt::format("v {} {} {}\n", nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2]));
      face += fmt::format(" {}", ++points);
    }
    text += fmt::format("g {}\nusemtl {}\n{}\n", names[piece.face], names[piece.face], face);
  }
  return text;
}

// ---- Event surfaces

const char* name_of(Event_kind kind) {
  return kind == Event_kind::horizon ? "horizon" : kind == Event_kind::edge_vertex ? "edge and vertex" : "triple";
}

Json surfaces_json(const Scene& scene, const std::vector<Event_surface>& surfaces) {
  Json all = Json::array();
  for (const Event_surface& surface : surfaces) {
    Json rulings = Json::array();
    for (const auto& [p, q] : surface.rulings) rulings.push_back({point_json(p), point_json(q)});
    const Piece& piece = scene.pieces()[surface.piece];
    all.push_back({{"kind", name_of(surface.kind)},
                   {"face", piece.face},
                   {"piece", piece.number},
                   {"source", surface.source},
                   {"rulings", std::move(rulings)}});
  }
  return {{"format", "sightline event surfaces 1"}, {"scene", scene.file()}, {"surfaces", std::move(all)}};
}

/// Strips of quadrilaterals between rulings in groups by kind, coordinates rounded.
std::string surfaces_obj(const std::vector<Event_surface>& surfaces) {
  std::string text;
  std::size_t points = 0;
  for (const Event_surface& surface : surfaces) {
    const std::string kind = surface.kind == Event_kind::edge_vertex ? "edge_and_vertex" : name_of(surface.kind);
    text += fmt::format("g {0}\nusemtl {0}\n", kind);
    for (const auto& ruling : surface.rulings)
      for (const Exact_point& p : ruling)
        text += fmt::format("v {} {} {}\n", nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2]));
    for (std::size_t k = 1; k < surface.rulings.size(); ++k, points += 2)
      text += fmt::format("f {} {} {} {}\n", points + 1, points + 2, points + 4, points + 3);
    points += 2;
  }
  return text;
}

// ---- What stays open

/// The pairs of undecided faces with the first of their open cells: conditions on segments from a part of a source to a
/// part of a piece.
Json open_json(const Occluders& occluders, const Sources& sources, const Weakly_visible& found) {
  constexpr std::size_t most_cells = 4;
  const std::vector<Piece>& pieces = occluders.scene().pieces();
  const auto points_json = [](const std::vector<Exact_point>& points) {
    Json list = Json::array();
    for (const Exact_point& p : points) list.push_back(point_json(p));
    return list;
  };
  Json all = Json::array();
  for (const Weakly_visible::Pair& pair : found.open) {
    Json cells = Json::array();
    for (const Open_cell& cell : open_cells(occluders, sources.polygons[pair.source], pair, most_cells)) {
      Json sides = Json::array();
      for (const Open_cell::Side& side : cell.sides)
        sides.push_back({{"face", pieces[side.edge.piece].face},
                         {"piece", pieces[side.edge.piece].number},
                         {"corner", side.edge.corner},
                         {"side", side.sign}});
      cells.push_back(
          {{"source", points_json(cell.source)}, {"target", points_json(cell.target)}, {"sides", std::move(sides)}});
    }
    const auto is_open = [](const Weak_step& step) { return step.kind == Weak_step::Kind::open; };
    const auto count = std::count_if(pair.answer.proof.begin(), pair.answer.proof.end(), is_open);
    all.push_back({{"face", pieces[pair.piece].face},
                   {"piece", pieces[pair.piece].number},
                   {"source", pair.source},
                   {"open_cells", count},
                   {"cells", std::move(cells)}});
  }
  return all;
}

// ---- The command

Exit run_weak(const Weak_arguments& arguments) {
  const Common& common = arguments.common;
  const std::string& method = arguments.method;
  if ((method == "sample" || method == "doubles") && !arguments.certificate.empty())
    throw Usage_error("--method " + method + " proves nothing: leave out --certificate, or take --method lines");
  const bool as_obj = arguments.surfaces.ends_with(".obj");
  if (!arguments.surfaces.empty() && method != "events")
    throw Usage_error("--surfaces are those of events: add --method events");
  if (!arguments.surfaces.empty() && !as_obj && !arguments.surfaces.ends_with(".json"))
    throw Usage_error("--surfaces wants a file that ends with .json or .obj, not " + arguments.surfaces);
  const Polygon_soup soup = common.read();
  const Scene scene(soup);
  Stopwatch watch;
  const Occluders occluders(scene);
  const Sources sources = sources_of(arguments.sources, common, soup, occluders);
  const double prepare_seconds = watch.seconds();
  Progress progress("searching");
  Weak_task task = arguments.task;
  task.two_sided = arguments.sources.two_sided;
  task.threads = common.threads;
  task.seed = common.seed;
  task.surfaces = !arguments.surfaces.empty();
  const bool leaves_open = method == "lines" || method == "events";
  const std::function<void(std::size_t, std::size_t)> report = [&](std::size_t done, std::size_t all) {
    progress(done, all);
  };
  if (leaves_open && common.budget > 0) task.out_of_time = [&] { return watch.seconds() > common.budget; };
  task.progress = leaves_open ? report : common.within_budget(report);
  watch = {};
  const Weak_outcome outcome = run_weak_method(method, occluders, sources, task);
  const Weakly_visible& found = outcome.found;
  const double seconds = watch.seconds();
  progress.clear();

  if (!arguments.certificate.empty())
    write_file(arguments.certificate, [&](std::ostream& out) {
      write_certificate(out, weak_certificate(scene, sources.points, task.two_sided, found));
    });
  if (!arguments.surfaces.empty())
    write_file(arguments.surfaces,
               as_obj ? surfaces_obj(outcome.surfaces) : surfaces_json(scene, outcome.surfaces).dump() + "\n");
  const std::vector<std::string> names = names_of(scene, found, sources.points.size());
  if (!arguments.svg.empty()) draw(arguments, soup, sources, names);
  if (!arguments.obj.empty()) write_file(arguments.obj, obj_text(scene, names));

  const Exit exit = found.undecided.empty() ? Exit::done : Exit::undecided;
  const Weak_counters& c = found.counters;
  const Event_counters& e = outcome.events;
  Json counters = counters_json(c);
  counters["events"] = counters_json(e);
  counters["events"]["surfaces"] = outcome.surfaces.size();
  Json result{
      {"visible", found.visible},     {"hidden", found.hidden},
      {"undecided", found.undecided}, {"certificate", arguments.certificate},
      {"unproved", found.unproved},   {"by_events", outcome.by_events},
      {"within", outcome.within},     {"open", common.json.empty() ? Json() : open_json(occluders, sources, found)}};
  if (write_json(common, "weak", scene, std::move(result), counters,
                 {{"prepare", prepare_seconds}, {"search", seconds}}))
    return exit;
  scene_rows(scene);
  row("sources", fmt::format("{} convex polygons", sources.polygons.size()));
  row("visible", fmt::format("{} of {} faces", found.visible.size(), scene.counters().faces));
  if (method == "conservative")
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
  if (method == "sample") row("rays", fmt::format("{} from each source; nothing is proved", task.rays));
  if (method == "lines")
    row("searches", fmt::format("{}: {} facing away, {} seen by the first lines; {} cells in the others", c.targets,
                                c.away, c.by_rays, c.cells));
  if (method == "lines" && found.visible.empty() && found.undecided.empty() && c.away > 0 && c.cells == 0)
    row("turned round?",
        "all faces are behind the source or have their backs to it; a source looks to the side from which its corners "
        "run counterclockwise: to look to the other one, write them backwards");
  if (method == "lines")
    row("cells", fmt::format("{} blocked, {} empty, {} by what was learned; {} cuts, {} shaves, {} bisections; {} "
                             "linear programs, {} of them exact",
                             c.blocked, c.empty, c.learned, c.cuts, c.shaves, c.bisections,
                             c.programs + c.exact_programs, c.exact_programs));
  if (e.targets > 0)
    row("events", fmt::format("{} searches; {} in planes of edges, {} of a vertex and an edge, {} of three edges; {} "
                              "cells of lines beside them",
                              e.targets, e.horizon, e.edge_vertex, e.triple, e.cells));
  if (task.surfaces) row("surfaces", fmt::format("{} in {}", outcome.surfaces.size(), arguments.surfaces));
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
  const Option method =
      command
          .add_option(
              "--method", a->method,
              "lines: exact, with certificates; events: exact, by Plantinga's events, slow where many edges are near; "
              "doubles: a search without proofs; sample: random rays, as others do")
          .check(one_of({"lines", "events", "doubles", "sample"}))
          .show_default();
  command
      .add_flag("--conservative{conservative}", a->method,
                "instead of a method: quick, visible is all that no single piece hides, so some faces too many; "
                "`sightline compare SCENE weak` says how many")
      .disable_flag_override()
      .excludes(method);
  command.add_option("--rays", a->task.rays, "sample: from each source").check(whole_number()).show_default();
  command
      .add_option("--cells", a->task.cells,
                  "lines: how many cells a search may take before its face is undecided; 0: as many as it takes, "
                  "unless --event-edges says where to end")
      .check(whole_number())
      .show_default();
  command
      .add_option(
          "--event-edges", a->task.event_edges,
          "lines: faces that stay undecided go to events where so many edges are near at most; 0: none does. More, "
          "and more cells, where neither this nor --cells is given")
      .check(whole_number())
      .show_default();
  command
      .add_option("--certificate", a->certificate,
                  "write what `sightline verify` reads: of lines all answers, of events what is visible, with "
                  "--conservative what is hidden")
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
      .writes_file()
      .check(ending(".svg"));
  command.add_option("--obj", a->obj, "write the scene with groups visible, hidden, undecided")
      .writes_file()
      .check(ending(".obj"));
  command.add_option("--eye", a->eye, "the eye X,Y,Z of the picture; by default a place outside the scene")
      .check(not_empty());
  a->view.add_to(command);
  command.footer(
      "Example: sightline weak room.off --from \"0,0,1 1,0,1 1,0,2 0,0,2\" --svg room.svg --certificate room.json\n"
      "Exit code 4: some faces are undecided.");
  command.set_action([a] { return run_weak(*a); });
}

}  // namespace sightline::app
