// sightline weak: the faces that are weakly visible from polygons, a picture of them and their certificate.

#include "picture.h"

#include <sightline/algorithms/baseline/ray_sampling.h>
#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/events.h>

#include <sstream>

namespace sightline::app {

namespace {

struct Weak_arguments {
  Common common;
  View_arguments view;
  std::vector<Face_id> faces;
  std::vector<std::string> polygons;
  std::string method = "lines", certificate, svg, obj, eye;
  bool two_sided = false;
  std::size_t rays = Ray_sampling_options{}.rays;
  std::size_t cells = Weak_search_options{}.cells;
};

/// Sources as they were given, and as the search takes them.
struct Sources {
  std::vector<std::vector<Exact_point>> points;
  std::vector<Weak_source> polygons;
};

Sources sources_of(const Weak_arguments& arguments, const Occluders& occluders) {
  const Scene& scene = occluders.scene();
  Sources sources;
  for (const Face_id face : arguments.faces) {
    bool found = false;
    for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
      if (scene.pieces()[i].face != face) continue;
      found = true;
      std::vector<Exact_point>& points = sources.points.emplace_back();
      for (const Piece_corner& corner : scene.corners(scene.pieces()[i])) points.push_back(scene.position(corner.point));
      sources.polygons.push_back(weak_source(occluders, i));
    }
    if (!found) throw Usage_error(fmt::format("--from-face {}: the scene has no such face, or it was set aside (`sightline info` lists them)", face));
  }
  for (const std::string& text : arguments.polygons) {
    std::istringstream words(text);
    std::vector<Exact_point>& points = sources.points.emplace_back();
    for (std::string word; words >> word;) points.push_back(parse_point(word, "--from"));
    try {
      sources.polygons.push_back(weak_source(occluders, points));
    } catch (const std::invalid_argument& error) {
      throw Usage_error(std::string("--from: ") + error.what());
    }
  }
  return sources;
}

// ---- Pictures ---------------------------------------------------------------------------------------------------------------

/// visible, hidden, undecided or "source", by face; sources are numbered after the faces.
std::vector<std::string> names_of(const Scene& scene, const Weakly_visible& found, std::size_t sources) {
  std::vector<std::string> names(scene.counters().faces_read + sources, "source");
  const auto set = [&](const std::vector<Face_id>& faces, const char* name) {
    for (const Face_id face : faces) names[face] = name;
  };
  set(found.visible, "visible"), set(found.hidden, "hidden"), set(found.undecided, "undecided");
  return names;
}

/// The fronts of faces, as a painter paints them: what has its back to the eye is left out, so that one looks into rooms.
void draw(const Weak_arguments& arguments, Polygon_soup soup, const Sources& sources, const std::vector<std::string>& names) {
  for (const std::vector<Exact_point>& polygon : sources.points) {
    std::vector<Point_id> loop;
    for (const Exact_point& p : polygon) loop.push_back(soup.add_point(p[0], p[1], p[2]));
    soup.add_face(loop);
  }
  Scene scene(soup);
  const Exact_point eye = eye_of(arguments.eye, scene);
  const View view = arguments.view.view(eye, scene);
  Task task;
  task.eye = eye, task.bsp.threads = arguments.common.threads;
  task.near = near_plane(view, scene);
  std::vector<Drawn> drawn = run_method("exact", scene, task).drawn;
  for (const Face_id face : arguments.faces)  // a face of the scene that is a source: itself, not its double
    for (Drawn& item : drawn)
      if (item.fragment.face == face) item.fragment.face = static_cast<Face_id>(names.size() - 1);
  std::erase_if(drawn, [&](const Drawn& item) { return item.side != CGAL::POSITIVE && names[item.fragment.face] != "source"; });
  Svg svg = empty_picture(view);
  paint(svg, view, drawn, true, [&](const Drawn& item, double shade) {
    const std::string& name = names[item.fragment.face];
    const auto [hue, strength, light] = name == "visible" ? std::tuple(38, 85, 62) : name == "hidden" ? std::tuple(215, 12, 60) : name == "source" ? std::tuple(350, 75, 50) : std::tuple(290, 60, 55);
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

/// What rays hit, and the rest as hidden: nothing of it is proved.
Weakly_visible sampled(const Weak_arguments& arguments, const Occluders& occluders, const Sources& sources) {
  Weakly_visible found;
  found.visible = visible_by_sampling(occluders, sources.polygons, {arguments.rays, arguments.common.seed, arguments.two_sided});
  for (const Piece& piece : occluders.scene().pieces())
    if (piece.number == 0 && !std::binary_search(found.visible.begin(), found.visible.end(), piece.face)) found.hidden.push_back(piece.face);
  return found;
}

/// The same answers by another method, without proofs of what is hidden.
Weakly_visible by_events(const Weak_arguments& arguments, const Occluders& occluders, const Sources& sources, const Weak_options& lines) {
  Events_options options;
  options.two_sided = arguments.two_sided, options.seed = arguments.common.seed, options.threads = arguments.common.threads;
  options.out_of_time = lines.search.out_of_time, options.progress = lines.progress;
  Weakly_visible_by_events events = weakly_visible_by_events(occluders, sources.polygons, options);
  Weakly_visible found;
  found.visible = std::move(events.visible), found.hidden = std::move(events.hidden), found.undecided = std::move(events.undecided);
  return found;
}

Exit run(const Weak_arguments& arguments) {
  const Common& common = arguments.common;
  const bool by_lines = arguments.method == "lines";
  if (!by_lines && !arguments.certificate.empty()) throw Usage_error("--method " + arguments.method + " writes no certificate: leave out --certificate, or take --method lines");
  if (arguments.faces.empty() && arguments.polygons.empty()) throw Usage_error("say what looks: --from-face ID, or --from \"X,Y,Z X,Y,Z X,Y,Z ...\"");
  const Polygon_soup soup = common.read();
  const Scene scene(soup);
  Stopwatch watch;
  const Occluders occluders(scene);
  const Sources sources = sources_of(arguments, occluders);
  const double prepare_seconds = watch.seconds();
  Progress progress("searching");
  Weak_options options;
  options.threads = common.threads;
  options.search.two_sided = arguments.two_sided, options.search.seed = common.seed, options.search.cells = arguments.cells;
  if (common.budget > 0) options.search.out_of_time = [&] { return watch.seconds() > common.budget; };
  options.progress = [&](std::size_t done, std::size_t all) { progress(done, all); };
  watch = {};
  const Weakly_visible found = by_lines ? weakly_visible(occluders, sources.polygons, options) : arguments.method == "events" ? by_events(arguments, occluders, sources, options) : sampled(arguments, occluders, sources);
  const double seconds = watch.seconds();

  if (!arguments.certificate.empty()) write_file(arguments.certificate, to_json(weak_certificate(scene, sources.points, arguments.two_sided, found)).dump() + "\n");
  const std::vector<std::string> names = names_of(scene, found, sources.points.size());
  if (!arguments.svg.empty()) draw(arguments, soup, sources, names);
  if (!arguments.obj.empty()) write_file(arguments.obj, obj_text(scene, names));

  const Exit exit = found.undecided.empty() ? Exit::done : Exit::undecided;
  const Weak_counters& c = found.counters;
  Json counters{{"searches", c.targets}, {"away", c.away}, {"by_rays", c.by_rays}, {"occluders", c.occluders}, {"cells", c.cells}, {"cuts", c.cuts}, {"shaves", c.shaves}, {"bisections", c.bisections},
                {"blocked", c.blocked}, {"empty", c.empty}, {"learned", c.learned}, {"jumps", c.jumps}, {"programs", c.programs}, {"exact_programs", c.exact_programs}, {"confirmed", c.confirmed},
                {"refuted", c.refuted}, {"lines", c.lines}, {"open", c.open}, {"deepest", c.deepest}};
  Json result{{"visible", found.visible}, {"hidden", found.hidden}, {"undecided", found.undecided}, {"certificate", arguments.certificate}};
  if (write_json(common, "weak", scene, std::move(result), counters, {{"prepare", prepare_seconds}, {"search", seconds}})) return exit;
  scene_rows(scene);
  row("sources", fmt::format("{} convex polygons", sources.polygons.size()));
  row("visible", fmt::format("{} of {} faces", found.visible.size(), scene.counters().faces));
  row("hidden", fmt::format("{}", found.hidden.size()));
  row("undecided", found.undecided.empty() ? "none" : fmt::format("{}: --cells and --budget set how long each is looked at", found.undecided.size()));
  if (arguments.method == "sample") row("rays", fmt::format("{} from each source; nothing is proved", arguments.rays));
  if (by_lines) row("searches", fmt::format("{}: {} facing away, {} seen by the first lines; {} cells in the others", c.targets, c.away, c.by_rays, c.cells));
  if (by_lines) row("cells", fmt::format("{} blocked, {} empty, {} by what was learned; {} cuts, {} shaves, {} bisections; {} linear programs, {} of them exact", c.blocked, c.empty, c.learned, c.cuts, c.shaves, c.bisections, c.programs + c.exact_programs, c.exact_programs));
  row("seconds", fmt::format("{:.4f}, and {:.4f} to prepare the scene", seconds, prepare_seconds));
  return exit;
}

}  // namespace

}  // namespace sightline::app

void add_weak(CLI::App& app) {
  CLI::App* command = app.add_subcommand("weak", "The faces that are weakly visible from polygons: seen from some point of them, exactly, with a certificate for both answers");
  auto a = std::make_shared<sightline::app::Weak_arguments>();
  a->common.add_to(*command);
  command->add_option("--from-face", a->faces, "a face of the scene that looks to its front; may be repeated");
  command->add_option("--from", a->polygons, "a convex polygon \"X,Y,Z X,Y,Z X,Y,Z ...\", counterclockwise as seen from the side it looks to; may be repeated for a region of several")->check(sightline::app::not_empty);
  command->add_option("--method", a->method, "lines: exact, with certificates; events: exact, by Plantinga's events, for up to some tens of edges; sample: random rays in doubles, what others do, to compare with")->check(CLI::IsMember({"lines", "events", "sample"}))->capture_default_str();
  command->add_option("--rays", a->rays, "of --method sample, from each source")->capture_default_str();
  command->add_flag("--two-sided", a->two_sided, "count faces seen from behind too (they hide what is behind them anyway)");
  command->add_option("--cells", a->cells, "how many cells a search may take before its face is undecided")->capture_default_str();
  command->add_option("--certificate", a->certificate, "write what `sightline verify` reads");
  command->add_option("--svg", a->svg, "draw the faces from an eye: visible ones orange, hidden ones grey; what has its back to the eye is left out");
  command->add_option("--obj", a->obj, "write the scene with groups visible, hidden, undecided");
  command->add_option("--eye", a->eye, "the eye X,Y,Z of the picture; by default a place outside the scene")->check(sightline::app::not_empty);
  a->view.add_to(*command);
  command->footer("Example: sightline weak room.off --from \"0,0,1 1,0,1 1,0,2 0,0,2\" --svg room.svg --certificate room.json\n"
                  "Exit code 4: some faces are undecided.");
  set_action(*command, [a] { return sightline::app::run(*a); });
}
