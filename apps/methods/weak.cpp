#include "weak.h"

#include <sightline/algorithms/baseline/doubles_search.h>
#include <sightline/algorithms/baseline/ray_sampling.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/algorithms/weak_visibility/conservative.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/io/input.h>
#include <sightline/io/read.h>
#include <sightline/algorithms/weak_visibility/events/events.h>

#include <map>
#include <sstream>

namespace sightline::app {

// ---- What looks

void Source_arguments::add_to(Command command, const std::string& prefix) {
  command.add_option("--from-face", faces, prefix + "a face of the scene that looks to its front; may be repeated");
  command
      .add_option("--from", polygons,
                  prefix +
                      "a convex polygon \"X,Y,Z X,Y,Z X,Y,Z ...\", counterclockwise as seen from the side it looks to; "
                      "may be repeated for a region of several")
      .check(not_empty());
  command
      .add_option("--from-volume", volumes,
                  prefix +
                      "a closed polyhedron, as a file like SCENE: what its surface sees outwards, and the faces that "
                      "it sees from within; may be repeated")
      .reads_file();
  command.add_option("--from-faces", solid, prefix + "the same for faces of the scene that bound a solid, with commas")
      .delimiter(',');
  command.add_flag("--two-sided", two_sided,
                   prefix + "count faces seen from behind too (they hide what is behind them anyway)");
}

static void add_source(Sources& sources, const Occluders& occluders, const std::vector<Exact_point>& points) {
  sources.polygons.push_back(weak_source(occluders, points));
  sources.points.push_back(points);
}

/// Errors: std::invalid_argument, as Volume.
static void add_volume(Sources& sources, const Occluders& occluders, const Polygon_soup& soup, const Report& progress) {
  for (const std::vector<Exact_point>& part : sources.volumes.emplace_back(soup, progress).surface())
    add_source(sources, occluders, part);
}

static void check_face(const Scene& scene, Face_id face, const std::string& option) {
  if (std::none_of(scene.pieces().begin(), scene.pieces().end(),
                   [&](const Piece& piece) { return piece.face == face; }))
    throw Usage_error(fmt::format(
        "{} {}: the scene has no such face, or it was set aside (`sightline info` lists them)", option, face));
}

Sources sources_of(const Source_arguments& arguments, const Common& common, const Polygon_soup& soup,
                   const Occluders& occluders, const Report& progress) {
  if (arguments.faces.empty() && arguments.polygons.empty() && arguments.volumes.empty() && arguments.solid.empty())
    throw Usage_error(
        "say what looks: --from-face ID, --from \"X,Y,Z X,Y,Z X,Y,Z ...\", --from-volume FILE or --from-faces "
        "ID,ID,...");
  const Scene& scene = occluders.scene();
  Sources sources;
  for (const Face_id face : arguments.faces) {
    check_face(scene, face, "--from-face");
    for (const Piece& piece : scene.pieces()) {
      if (piece.face != face) continue;
      add_source(sources, occluders, scene.corner_points(piece));
    }
  }
  for (const std::string& text : arguments.polygons) {
    std::istringstream words(text);
    std::vector<Exact_point> points;
    for (std::string word; words >> word;) points.push_back(parse_point(word, "--from"));
    try {
      add_source(sources, occluders, points);
    } catch (const std::invalid_argument& error) {
      throw Usage_error(std::string("--from: ") + error.what());
    }
  }
  for (const std::string& file : arguments.volumes) {
    Common of_file = common;
    of_file.scene = file;
    of_file.flip = false;  // that turns SCENE alone
    const Polygon_soup volume = of_file.read();
    try {
      add_volume(sources, occluders, volume, progress);
    } catch (const std::invalid_argument& error) {
      throw Input_error::of_file(file, error.what());
    }
  }
  if (!arguments.solid.empty()) {
    for (const Face_id face : arguments.solid) check_face(scene, face, "--from-faces");
    try {
      add_volume(sources, occluders, generate::with_faces(soup, arguments.solid), progress);
    } catch (const std::invalid_argument& error) {
      throw Usage_error(std::string("--from-faces: ") + error.what());
    }
  }
  return sources;
}

// ---- Methods

static Weak_outcome by_lines(const Occluders& occluders, const Sources& sources, const Weak_task& task,
                             const Events_options& events) {
  Weak_options options;
  options.threads = task.threads;
  options.progress = task.progress;
  options.search.two_sided = task.two_sided;
  options.search.seed = task.seed;
  if (task.cells > 0) options.search.cells = task.cells;
  options.search.out_of_time = task.out_of_time;
  Weak_outcome outcome{weakly_visible(occluders, sources.polygons, options), {}, {}, {}, {}};
  search_thoroughly(occluders, sources.polygons, options, outcome.found);
  if (task.event_edges == 0) return outcome;
  const std::vector<Face_id> before = outcome.found.undecided;
  outcome.events = settle_by_events(occluders, sources.polygons, task.event_edges, events, outcome.found);
  if (task.cells == 0 && task.event_edges == usual_event_edges)
    outcome.events += decide_the_rest(occluders, sources.polygons, options, task.event_edges, events, outcome.found);
  const std::vector<Face_id>& after = outcome.found.undecided;
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(outcome.by_events));
  return outcome;
}

static Weak_outcome by_events(const Occluders& occluders, const Sources& sources, const Events_options& options) {
  Weakly_visible_by_events events = weakly_visible_by_events(occluders, sources.polygons, options);
  Weak_outcome outcome;
  static_cast<Weak_faces&>(outcome.found) = events;
  outcome.found.unproved = events.hidden;
  for (const Weakly_visible_by_events::Pair& pair : events.sightlines)
    outcome.found.pairs.push_back({pair.piece, pair.source, weak_answer(pair.answer)});
  outcome.events = events.counters;
  outcome.surfaces = std::move(events.surfaces);
  return outcome;
}

/// Faces of which nothing is proved.
static Weak_outcome unproved(Weak_faces faces) {
  Weak_outcome outcome;
  static_cast<Weak_faces&>(outcome.found) = std::move(faces);
  std::merge(outcome.found.visible.begin(), outcome.found.visible.end(), outcome.found.hidden.begin(),
             outcome.found.hidden.end(), std::back_inserter(outcome.found.unproved));
  return outcome;
}

static Weak_faces by_samples(const Occluders& occluders, const Sources& sources, const Weak_task& task) {
  Weak_faces faces;
  faces.visible =
      visible_by_sampling(occluders, sources.polygons, {task.rays, task.seed, task.two_sided, task.progress});
  const std::vector<Piece>& pieces = occluders.scene().pieces();
  for (const std::uint32_t first : first_pieces(pieces))
    if (!std::binary_search(faces.visible.begin(), faces.visible.end(), pieces[first].face))
      faces.hidden.push_back(pieces[first].face);
  return faces;
}

std::string colour_of_method(const std::string& method) {
  static const std::map<std::string, std::string> colours{{"lines", "#1f5fa8"},
                                                          {"events", "#2f8f3a"},
                                                          {"conservative", "#7a4fb0"},
                                                          {"doubles", "#d1620b"},
                                                          {"sample", "#b3262e"}};
  return colours.at(method);
}

Weak_outcome run_weak_method(const std::string& method, const Occluders& occluders, const Sources& sources,
                             const Weak_task& task) {
  Events_options events;
  events.two_sided = task.two_sided;
  events.seed = task.seed;
  events.threads = task.threads;
  events.surfaces = task.surfaces;
  events.out_of_time = task.out_of_time;
  Weak_outcome outcome;
  if (method == "lines") outcome = by_lines(occluders, sources, task, events);
  else if (method == "conservative")
    outcome.found = possibly_visible(occluders, sources.polygons, {task.two_sided, task.threads, task.progress});
  else if (method == "sample") outcome = unproved(by_samples(occluders, sources, task));
  else if (method == "doubles") {
    Doubles_search_options options;
    options.two_sided = task.two_sided;
    options.threads = task.threads;
    options.progress = task.progress;
    outcome = unproved(visible_by_doubles(occluders, sources.polygons, options));
  } else {
    events.progress = task.progress;
    outcome = by_events(occluders, sources, events);
  }
  for (const Weak_volume& volume : sources.volumes) {
    const std::vector<Face_id> within =
        add_seen_from_within(occluders.scene(), volume, task.two_sided, outcome.found, task.out_of_time);
    outcome.within.insert(outcome.within.end(), within.begin(), within.end());
  }
  std::sort(outcome.within.begin(), outcome.within.end());
  return outcome;
}

}  // namespace sightline::app
