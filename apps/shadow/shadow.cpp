// sightline shadow: which parts of faces lights reach, and what shadows the others; exactly.

#include "shadow.h"

#include "../support/drawing.h"
#include "../support/solid_file.h"
#include "picture.h"

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/shadow/volume.h>
#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/io/format.h>
#include <sightline/io/off.h>
#include <sightline/kernel/threads.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace sightline::app {

namespace {

struct Placed_light {
  Exact_point at;  ///< or the direction to it
  bool is_sun;
  Exact_view view(const Scene& scene) const { return is_sun ? Exact_view(scene, Sun{at}) : Exact_view(scene, at); }
  std::string name() const {
    return fmt::format("{} ({}, {}, {})", is_sun ? "sun" : "light", to_string(at[0]), to_string(at[1]),
                       to_string(at[2]));
  }
};

std::vector<Placed_light> lights_of(const Shadow_arguments& arguments) {
  std::vector<Placed_light> lights;
  for (const std::string& text : arguments.lights) lights.push_back({parse_point(text, "--light"), false});
  for (const std::string& text : arguments.suns) {
    lights.push_back({parse_point(text, "--sun"), true});
    if (lights.back().at == Exact_point{0, 0, 0}) throw Usage_error("--sun: 0,0,0 is no direction");
  }
  if (lights.empty()) throw Usage_error("give a --light X,Y,Z or a --sun DX,DY,DZ, or several");
  return lights;
}

/// Groups lit, shadowed and away; light-N-lit and so on where there are several.
Grouped_polygons drawing_of(const Scene& scene, const std::vector<Shadows>& all) {
  Grouped_polygons polygons;
  std::vector<Exact_point> corners;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::string prefix = all.size() > 1 ? fmt::format("light-{}-", k) : "";
    const std::uint32_t lit = polygons.add_group(prefix + "lit", drawing_colours::seen),
                        shadowed = polygons.add_group(prefix + "shadowed", drawing_colours::hidden),
                        away = polygons.add_group(prefix + "away", drawing_colours::other);
    std::vector<bool> turned(scene.pieces().size());
    for (const Shadow_part& part : all[k].parts) {
      turned[part.piece] = true;
      polygons.add_polygon(part.is_lit() ? lit : shadowed, scene.pieces()[part.piece].face, part.vertices);
    }
    for (std::uint32_t i = 0; i < turned.size(); ++i) {
      if (turned[i]) continue;
      polygons.add_polygon(away, scene.pieces()[i].face, scene.corner_points(scene.pieces()[i]));
    }
  }
  return polygons;
}

Json part_json(const Scene& scene, const Shadow_part& part, std::size_t light) {
  const Piece& piece = scene.pieces()[part.piece];
  Json json{{"face", piece.face},
            {"piece", piece.number},
            {"light", light},
            {"side", part.side == CGAL::POSITIVE ? "front" : "back"}};
  if (!part.is_lit()) {
    json["by"] = scene.pieces()[part.by].face;
    json["by_piece"] = scene.pieces()[part.by].number;
  }
  Json& corners = json["vertices"] = Json::array();
  for (const Exact_point& p : part.vertices) corners.push_back(point_json(p));
  return json;
}

/// Of what does not go together.
void check_usage(const Shadow_arguments& arguments, const std::vector<Placed_light>& lights) {
  if (arguments.svg.empty() && !arguments.eye.empty()) throw Usage_error("--eye is the eye of the picture: give --svg");
  if (!arguments.eye.empty()) parse_point(arguments.eye, "--eye");
  arguments.view.check_usage(!arguments.svg.empty());
  if (!arguments.volume.empty() && lights.size() > 1)
    throw Usage_error("--volume is of one light: give one --light or --sun for each file");
}

/// The shadows of each light.
std::vector<Shadows> shadows_of(const Shadow_arguments& arguments, const Scene& scene, const Piece_boxes& boxes,
                                const std::vector<Placed_light>& lights) {
  std::vector<Shadows> all;
  for (const Placed_light& light : lights) {
    Progress progress("casting shadows");
    Shadow_options options;
    options.two_sided = arguments.two_sided;
    options.threads = arguments.common.threads;
    options.progress = arguments.common.within_budget(progress);
    all.push_back(shadows(light.view(scene), boxes, options));
  }
  return all;
}

/// What is told of the space behind a light's shadows.
struct Told_volume {
  Json json;
  std::string text, warning;
};

/// Writes the space in the shadow of one light.
Told_volume write_volume(const Shadow_arguments& arguments, const Scene& scene, const Placed_light& light) {
  const Common& common = arguments.common;
  const Stopwatch since;
  Shadow_volume made;
  Progress progress("the space in shadow");
  const auto report = common.within_budget(progress);
  run_with_threads(common.threads, [&] {
    made = light.is_sun ? shadow_volume(scene, Sun{light.at}, report) : shadow_volume(scene, light.at, report);
  });
  progress.clear();
  const Polygon_soup flat = without_holes(made.soup).soup;
  const auto rounding = write_solid(flat, arguments.volume, false, most_snap_rounds);
  const Rational size = volume(made.soup);
  Told_volume told;
  told.json = {{"faces", flat.face_count()},
               {"casting", made.casting},
               {"volume", to_string(size)},
               {"box", {point_json(made.box[0]), point_json(made.box[1])}},
               {"seconds", since.seconds()}};
  if (rounding) told.json["rounding"] = rounding_json(*rounding, flat);
  told.text = fmt::format(
      "{} in shadow, of {} pieces, within the scene's box and a quarter of its longest side; "
      "{} faces, {:.3f} seconds{}{}",
      digits_of(size, 6), made.casting, flat.face_count(), since.seconds(), rounding ? "; rounded: " : "",
      rounding ? rounding_text(*rounding) : "");
  if (!rounding) told.warning = warning_of_denominator(flat, arguments.volume);
  return told;
}

/// Faces that some light reaches, and the others.
struct Lit_and_dark {
  std::vector<Face_id> lit, dark;
};

Lit_and_dark lit_and_dark(const Scene& scene, const std::vector<Shadows>& all) {
  std::vector<bool> is_lit(scene.counters().faces_read), kept(is_lit.size());
  for (const Piece& piece : scene.pieces()) kept[piece.face] = true;
  for (const Shadows& of_light : all)
    for (const Face_id face : of_light.lit) is_lit[face] = true;
  Lit_and_dark faces;
  for (Face_id face = 0; face < kept.size(); ++face)
    if (kept[face]) (is_lit[face] ? faces.lit : faces.dark).push_back(face);
  return faces;
}

/// `parts`: whether these are listed.
Json result_json(const Scene& scene, const std::vector<Placed_light>& lights, const std::vector<Shadows>& all,
                 const Lit_and_dark& faces, bool parts) {
  Json lit = Json::array(), dark = Json::array(), of_lights = Json::array();
  for (std::size_t k = 0; parts && k < all.size(); ++k) {
    of_lights.push_back({{lights[k].is_sun ? "sun" : "light", point_json(lights[k].at)},
                         {"lit_faces", all[k].lit},
                         {"away", all[k].away}});
    for (const Shadow_part& part : all[k].parts) (part.is_lit() ? lit : dark).push_back(part_json(scene, part, k));
  }
  return {{"lights", std::move(of_lights)},
          {"lit", std::move(lit)},
          {"dark", std::move(dark)},
          {"lit_faces", faces.lit},
          {"dark_faces", faces.dark}};
}

void print(const std::vector<Placed_light>& lights, const std::vector<Shadows>& all) {
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Shadows& of_light = all[k];
    const auto parts = static_cast<std::size_t>(std::count_if(of_light.parts.begin(), of_light.parts.end(),
                                                              [](const Shadow_part& part) { return part.is_lit(); }));
    row(lights[k].is_sun ? "sun" : "light",
        fmt::format("{}: {} faces lit, {} turned away; {} lit parts, {} in shadow", lights[k].name(),
                    of_light.lit.size(), of_light.away.size(), parts, of_light.parts.size() - parts));
  }
}

void print(const Lit_and_dark& faces, const Scene& scene, bool two_sided) {
  constexpr std::size_t shown = 12;
  std::string some;
  for (std::size_t k = 0; k < std::min(faces.dark.size(), shown); ++k)
    some += fmt::format("{}{}", k == 0 ? ": " : ", ", faces.dark[k]);
  if (faces.dark.size() > shown) some += ", ...";
  row("lit", fmt::format("{} of {} faces, in part at least{}", faces.lit.size(), scene.counters().faces,
                         two_sided ? "" : "; --two-sided counts back sides too"));
  row("lit by none", fmt::format("{}{}", faces.dark.size(), some));
}

Exit run(const Shadow_arguments& arguments) {
  const Common& common = arguments.common;
  const std::vector<Placed_light> lights = lights_of(arguments);
  check_usage(arguments, lights);
  const Scene scene = scene_of(common.read());
  const Stopwatch watch;
  const Piece_boxes boxes(scene);
  const std::vector<Shadows> all = shadows_of(arguments, scene, boxes, lights);
  const double seconds = watch.seconds();

  const std::size_t whole =
      arguments.svg.empty() ? 0 : draw(arguments, scene, boxes, all, eye_of(arguments.eye, scene));
  if (!arguments.obj.empty() || !arguments.mesh.empty())
    write_drawings(arguments.obj, arguments.mesh, drawing_of(scene, all));
  std::optional<Told_volume> space;
  if (!arguments.volume.empty()) space = write_volume(arguments, scene, lights[0]);

  const Lit_and_dark faces = lit_and_dark(scene, all);
  Shadow_counters counters;
  for (const Shadows& of_light : all) counters += of_light.counters;
  Json result = result_json(scene, lights, all, faces, !common.json.empty());
  if (space) result["volume"] = std::move(space->json);
  if (write_json(common, "shadow", scene, std::move(result), counters_json(counters), {{"shadow", seconds}}))
    return Exit::done;
  scene_rows(scene);
  print(lights, all);
  print(faces, scene, arguments.two_sided);
  if (space) row("volume", space->text);
  if (space && !space->warning.empty()) row("exact", space->warning);
  if (whole > 0)
    row("picture", fmt::format("{} parts smaller than a pixel are drawn whole, in the light of most of them", whole));
  row("seconds", fmt::format("{:.4f}", seconds));
  return Exit::done;
}

}  // namespace

void add_shadow(Command program) {
  const Command command = program.add_command(
      "shadow", "The parts of faces that lights reach, and what shadows the others, as exact polygons");
  auto a = std::make_shared<Shadow_arguments>();
  a->common.add_to(command);
  command.add_option("--light", a->lights, "a light X,Y,Z; any number of them").check(not_empty()).expected(1, 1000);
  command.add_option("--sun", a->suns, "a light at infinity: the direction DX,DY,DZ to it, from anywhere in the scene")
      .check(not_empty())
      .expected(1, 1000);
  command.add_flag("--two-sided", a->two_sided, "back sides are lit too, by lights behind them");
  command
      .add_option("--svg", a->svg,
                  "draw the scene from an eye: lit parts bright, shadowed ones grey, what is turned away darkest")
      .writes_file(".svg");
  command.add_option("--eye", a->eye, "the eye X,Y,Z of the picture; by default a place outside the scene")
      .check(not_empty());
  a->view.add_to(command);
  command
      .add_option(
          "--volume", a->volume,
          "write the space in the shadow of one light as a closed surface: .qoff holds it exactly, other formats "
          "rounded so that nothing breaks, where that can be")
      .writes_file()
      .check(surface_ending());
  add_mesh_option(command, a->mesh, "the parts lit, in shadow and turned away,");
  command
      .add_option("--obj", a->obj, "the same as OBJ; groups are light-0-lit and so on where there are several lights")
      .writes_file(".obj");
  command.footer(
      "A face is lit where a light strictly in front of it sees it, as `sightline see --eye` does; of a shadow the "
      "JSON "
      "names the face that the light meets first.\n"
      "Example: sightline shadow town.qoff --light 3,3,9 --sun=-1,-2,3 --svg town.svg --json -");
  command.set_action([a] { return run(*a); });
}

}  // namespace sightline::app
