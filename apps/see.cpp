// sightline see: the exact visible parts of a scene from an eye, their picture and their certificate.

#include "support/drawing.h"
#include "support/page.h"
#include "support/picture.h"

#include <sightline/algorithms/image/bsp2d.h>
#include <sightline/algorithms/image/weiler_atherton.h>
#include <sightline/algorithms/point_visibility/certificate.h>
#include <sightline/algorithms/point_visibility/line_drawing.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/kernels.h>
#include <sightline/algorithms/point_visibility/visible.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <optional>
#include <ostream>
#include <set>

namespace sightline::app {

namespace {

struct See_arguments {
  Common common;
  View_arguments view;
  std::string eye, kernel = "exact", method = "regions", certificate, svg, html, mesh;
  bool two_sided = false, frustum = false, lines = false;
};

/// What a kernel saw, in exact numbers.
struct Seen {
  std::vector<Drawn_line> lines;
  std::vector<Drawn> parts;  ///< fragment.piece: the convex piece; no vertices where nobody asks for them
  std::vector<Face_id> visible, from_behind;  ///< from_behind: those that no front shows
  Visible_counters counters;
  std::size_t edge_on = 0,
              not_finite = 0;  ///< pieces in the eye's plane; parts of an inexact kernel that are no numbers
  double seconds = 0, line_seconds = 0;
};

/// What a run is asked for.
struct Wanted {
  bool two_sided = false, corners = false;
  std::string method = "regions";  ///< exact only, if another
  std::string certificate;         ///< the file to write it to, or none; exact only
  bool lines = false;              ///< exact only
};

template <sightline::View V>
Seen seen_by(const V& view, const Visible_surface<V>& surface, const Wanted& wanted) {
  Seen seen;
  for (std::uint32_t i = 0; i < view.scene().pieces().size(); ++i) seen.edge_on += view.eye_side(i) == CGAL::ZERO;
  seen.visible = surface.visible;
  std::set_difference(surface.from_behind.begin(), surface.from_behind.end(), surface.visible.begin(),
                      surface.visible.end(), std::back_inserter(seen.from_behind));
  seen.counters = surface.counters;
  if (wanted.two_sided) {
    seen.visible.clear();
    std::set_union(surface.visible.begin(), surface.visible.end(), surface.from_behind.begin(),
                   surface.from_behind.end(), std::back_inserter(seen.visible));
  }
  for (const auto& part : surface.parts) {
    if (part.piece == surface.nothing) continue;
    const Piece& piece = view.scene().pieces()[part.piece];
    try {
      std::vector<Exact_point> at;
      if (wanted.corners || !V::is_exact) at = vertices(view, surface, part);
      seen.parts.push_back({{piece.face, piece.number, std::move(at)}, piece.number, view.eye_side(part.piece)});
    } catch (const std::domain_error&) {
      ++seen.not_finite;
    }
  }
  return seen;
}

Json lines_json(const Scene& scene, const std::vector<Drawn_line>& lines) {
  Json all = Json::array();
  for (const Drawn_line& line : lines) {
    Json parts = Json::array();
    for (const Line_part& part : line.parts) {
      Json& entry = parts.emplace_back(Json{{"from", to_string(part.from)},
                                            {"to", to_string(part.to)},
                                            {"visible", part.hidden_by == Line_part::nothing}});
      if (part.hidden_by != Line_part::nothing)
        entry["hidden_by"] = {scene.pieces()[part.hidden_by].face, scene.pieces()[part.hidden_by].number};
      entry["vertices"] = {point_json(line.at(part.from)), point_json(line.at(part.to))};
    }
    all.push_back({{"class", line.kind},
                   {"faces", line.faces},
                   {"vertices", {point_json(line.ends[0]), point_json(line.ends[1])}},
                   {"parts", std::move(parts)}});
  }
  return all;
}
/// Hidden parts dashed, then visible ones: outlines heavier, edges between faces of one plane not at all. Dashes are
/// of edges that are next to what is seen, at a face or at an end; others are behind it for good, and faint.
void draw(Svg& svg, const View& view, const Seen& seen) {
  std::set<Exact_point> ends;
  std::vector<bool> shown;
  for (const Drawn& part : seen.parts) {
    shown.resize(std::max<std::size_t>(shown.size(), part.fragment.face + 1));
    shown[part.fragment.face] = true;
  }
  for (const Drawn_line& line : seen.lines)
    for (const Line_part& part : line.parts)
      if (part.hidden_by == Line_part::nothing) {
        if (part.from == 0) ends.insert(line.ends[0]);
        if (part.to == 1) ends.insert(line.ends[1]);
      }
  const auto is_near = [&](const Drawn_line& line) {
    return ends.contains(line.ends[0]) || ends.contains(line.ends[1]) ||
           std::any_of(line.faces.begin(), line.faces.end(),
                       [&](Face_id face) { return face < shown.size() && shown[face]; });
  };
  enum class Pass { behind, dashed, visible };
  for (const Pass pass : {Pass::behind, Pass::dashed, Pass::visible})
    for (const Drawn_line& line : seen.lines) {
      const std::string_view kind = line.kind;
      if (kind == "smooth") continue;
      for (const Line_part& part : line.parts) {
        const Pass its = part.hidden_by == Line_part::nothing ? Pass::visible
                         : is_near(line)                      ? Pass::dashed
                                                              : Pass::behind;
        if (its != pass) continue;
        const Flat_point from = projected(view, line.at(part.from)), to = projected(view, line.at(part.to));
        if (pass == Pass::visible)
          svg.line(from, to, kind == "intersection" ? "#b0281c" : "#1c1c1c",
                   kind == "boundary" || kind == "silhouette" ? 1.6 : 1);
        else if (pass == Pass::dashed) svg.line(from, to, "#00000090", 0.8, true);
        else svg.line(from, to, "#00000018", 0.5);
      }
    }
}

/// The faces of one sorted list that are not in the other.
std::vector<Face_id> without(const std::vector<Face_id>& faces, const std::vector<Face_id>& others) {
  std::vector<Face_id> left;
  std::set_difference(faces.begin(), faces.end(), others.begin(), others.end(), std::back_inserter(left));
  return left;
}

/// The visible parts over the scene's pieces, its lines, and what plain doubles would have made of it.
void write_page(const See_arguments& arguments, const Scene& scene, const Exact_point& eye, const Seen& seen,
                Json doubles) {
  Page page("see", scene);
  page.set_eye(eye);
  page.add_fact("faces", fmt::format("{}", scene.counters().faces));
  page.add_fact("visible", fmt::format("{} faces", seen.visible.size()));
  page.add_fact("from behind", fmt::format("{} faces", seen.from_behind.size()));
  page.add_fact("eye", Page::text(eye));
  page.add_group("visible", "one a face");
  page.add_group("visible from behind", "one a face");
  page.add_group("the scene, beneath", "hidden");
  page.add_pieces(scene, [](std::uint32_t) { return 2; });
  page.more()["base"] = page.polygons();
  for (const Drawn& part : seen.parts)
    page.add_polygon(part.fragment.face, part.fragment.vertices, part.side == CGAL::POSITIVE ? 0 : 1);
  page.more()["doubles"] = std::move(doubles);
  if (!arguments.lines) page.add_note("--lines adds the scene's edges, hidden ones dashed, and what hides them");
  constexpr std::size_t most_parts = 12000, most_texts = 1000;
  std::size_t parts = 0;
  for (const Drawn_line& line : seen.lines) parts += line.parts.size();
  if (parts > most_parts) page.add_note(fmt::format("{} parts of lines are too many for a page: left out", parts));
  if (parts > 0 && parts <= most_parts) {
    std::vector<float> ends;
    std::vector<std::uint32_t> edges, hidden_by, kinds;
    std::vector<std::string> names, texts;
    for (std::uint32_t i = 0; i < seen.lines.size(); ++i) {
      const Drawn_line& line = seen.lines[i];
      const std::size_t kind =
          static_cast<std::size_t>(std::find(names.begin(), names.end(), line.kind) - names.begin());
      if (kind == names.size()) names.emplace_back(line.kind);
      for (const Line_part& part : line.parts) {
        const Exact_point from = line.at(part.from), to = line.at(part.to);
        page.append_place(ends, from);
        page.append_place(ends, to);
        edges.push_back(i);
        kinds.push_back(static_cast<std::uint32_t>(kind));
        hidden_by.push_back(part.hidden_by == Line_part::nothing ? 0 : part.hidden_by + 1);
        if (parts <= most_texts) texts.push_back(Page::text(from) + " to " + Page::text(to));
      }
    }
    page.more()["lines"] = {{"ends", packed(ends)},           {"edges", packed(edges)}, {"kinds", packed(kinds)},
                            {"hidden_by", packed(hidden_by)}, {"names", names},         {"texts", texts}};
  }
  page.write(arguments.html);
}

/// The visible parts, and all of what has none.
void write_mesh(const std::string& file, const Scene& scene, const Seen& seen) {
  Grouped_polygons polygons;
  const std::uint32_t front = polygons.add_group("visible", drawing_colours::seen),
                      back = polygons.add_group("visible_from_behind", drawing_colours::other),
                      hidden = polygons.add_group("hidden", drawing_colours::hidden);
  std::vector<char> has_part(scene.counters().faces_read);
  for (const Drawn& part : seen.parts) {
    polygons.add_polygon(part.side == CGAL::POSITIVE ? front : back, part.fragment.face, part.fragment.vertices);
    has_part[part.fragment.face] = 1;
  }
  std::vector<Exact_point> corners;
  for (const Piece& piece : scene.pieces()) {
    if (has_part[piece.face]) continue;
    corners = scene.corner_points(piece);
    polygons.add_polygon(hidden, piece.face, corners);
  }
  write_drawings({}, file, polygons);
}

/// Faces that show their front.
std::size_t fronts_of(const Seen& seen) {
  std::size_t behind = 0;  // `visible` may count these too
  for (const Face_id face : seen.from_behind)
    behind += std::binary_search(seen.visible.begin(), seen.visible.end(), face);
  return seen.visible.size() - behind;
}

/// By one of the methods that share directions out exactly.
Visible_surface<Exact_view> surface_by(const std::string& method, const Exact_view& view, const Piece_boxes& boxes,
                                       Cones<Exact_view> cones, const Visible_options& options) {
  if (method == "weiler-atherton") return weiler_atherton(view, std::move(cones), options);
  if (method == "regions") return visible_surface(view, boxes, std::move(cones), options);
  Bsp2d_options trees;
  trees.threads = options.threads;
  trees.progress = options.progress;
  Bsp2d found = bsp2d(view, std::move(cones), trees);
  found.surface.counters.predicates = found.counters.predicates;
  return std::move(found.surface);
}

/// The whole sphere, or the given field of view.
Seen see(const Scene& scene, const Exact_point& eye, const std::string& kernel, const std::vector<Exact_point>& field,
         const Wanted& wanted, const Visible_options& options) {
  const Stopwatch watch;
  const Piece_boxes boxes(scene);
  Seen seen;
  const auto with = [&](const auto& view) {
    const auto surface = visible_surface(view, boxes, options);
    const double seconds = watch.seconds();
    seen = seen_by(view, surface, wanted);
    seen.seconds = seconds;
  };
  if (kernel == "exact") {
    const Exact_view view(scene, eye, field.empty() ? std::vector<std::array<Integer, 3>>() : field_of(field));
    const auto surface =
        surface_by(wanted.method, view, boxes, field.empty() ? whole_sphere(view) : field_of_view(view), options);
    const double seconds = watch.seconds();
    seen = seen_by(view, surface, wanted);
    seen.seconds = seconds;
    if (!wanted.certificate.empty())
      write_file(wanted.certificate, [&](std::ostream& out) {
        write_visible_certificate(out, view, surface, eye, field, options.progress);
      });
    if (wanted.lines) {
      const Stopwatch more;
      seen.lines = line_drawing(view, surface, boxes, options.threads, options.progress);
      seen.line_seconds = more.seconds();
    }
  } else if (kernel == "double") {
    with(Number_view<double>(scene, eye));
  } else if (kernel == "float") {
    with(Number_view<float>(scene, eye));
  } else if (kernel == "gmpq") {
    with(Number_view<CGAL::Gmpq>(scene, eye));
  } else {
    with(Number_view<CGAL::Exact_predicates_exact_constructions_kernel::FT>(scene, eye));
  }
  return seen;
}

/// Of what does not go together.
void check_usage(const See_arguments& arguments) {
  if (!arguments.eye.empty()) parse_point(arguments.eye, "--eye");
  arguments.view.check_usage(!arguments.svg.empty() || arguments.frustum);
  if (arguments.kernel != "exact" &&
      (!arguments.certificate.empty() || !arguments.svg.empty() || !arguments.html.empty() || !arguments.mesh.empty() ||
       arguments.frustum || arguments.lines || arguments.method != "regions"))
    throw Usage_error(
        "--method, --certificate, --svg, --html, --mesh, --lines and --frustum are exact: leave out --kernel");
}

/// What is in a view, drawn; with --lines as paper for these.
void write_picture(const See_arguments& arguments, const Scene& scene, const View& view,
                   const Visible_options& options) {
  Svg svg = empty_picture(view);
  if (scene.counters().faces > 0) {
    const Seen picture =
        see(scene, view.eye, "exact", corner_rays(view), {true, true, arguments.method, "", arguments.lines}, options);
    paint(svg, view, picture.parts, false, arguments.lines ? pale_look : look_by_face);
    if (arguments.lines) draw(svg, view, picture);
  }
  write_file(arguments.svg, svg.text());
}

/// The faces that the same algorithm in doubles gets wrong, for the page.
Json made_by_doubles(const See_arguments& arguments, const Scene& scene, const Exact_point& eye, const Seen& seen,
                     Visible_options options, const Time_limit& limit) {
  if (arguments.frustum) return doubles_left_out("they look in all directions, and --frustum does not");
  return asked_of_doubles(limit, [&](const Report& report) -> Json {
    options.progress = report;
    const Seen doubles = see(scene, eye, "double", {}, {arguments.two_sided, false, "regions", "", false}, options);
    return {{"missing", packed(without(seen.visible, doubles.visible))},
            {"extra", packed(without(doubles.visible, seen.visible))}};
  });
}

/// The parts that count: with --two-sided backs, too.
std::vector<const Drawn*> counted_parts(const Seen& seen, bool two_sided) {
  std::vector<const Drawn*> parts;
  for (const Drawn& drawn : seen.parts)
    if (two_sided || drawn.side == CGAL::POSITIVE) parts.push_back(&drawn);
  return parts;
}

Json parts_json(const std::vector<const Drawn*>& parts) {
  Json pieces = Json::array();
  for (const Drawn* drawn : parts) {
    Json corners = Json::array();
    for (const Exact_point& p : drawn->fragment.vertices) corners.push_back(point_json(p));
    pieces.push_back({{"face", drawn->fragment.face},
                      {"piece", drawn->fragment.piece},
                      {"side", drawn->side == CGAL::POSITIVE ? "front" : "back"},
                      {"vertices", std::move(corners)}});
  }
  return pieces;
}

Json counters_of_seen(const See_arguments& arguments, const Seen& seen) {
  const Visible_counters& c = seen.counters;
  Json counters{
      {"kernel", arguments.kernel}, {"method", arguments.method}, {"pieces", c.pieces}, {"edge_on", seen.edge_on}};
  append_counters(counters, c);
  counters["parts"] = seen.parts.size();
  counters["not_finite"] = seen.not_finite;
  counters["predicates"] = predicates_json(c.predicates);
  return counters;
}

/// How many of the scene's edges are visible, and how many lines there are where faces cross.
void print_lines(const Seen& seen) {
  std::size_t whole = 0, hidden = 0, crossing = 0;
  for (const Drawn_line& line : seen.lines) {
    const auto is_hidden = [](const Line_part& part) { return part.hidden_by != Line_part::nothing; };
    const std::string_view kind = line.kind;
    crossing += kind == "intersection";
    whole += kind != "intersection" && std::none_of(line.parts.begin(), line.parts.end(), is_hidden);
    hidden += std::all_of(line.parts.begin(), line.parts.end(), is_hidden);
  }
  row("lines", fmt::format("{} edges: {} visible, {} hidden, {} in part; {} lines where faces cross, {:.3f} seconds",
                           seen.lines.size() - crossing, whole, hidden, seen.lines.size() - crossing - whole - hidden,
                           crossing, seen.line_seconds));
}

/// `parts`: how many count.
void print(const See_arguments& arguments, const Scene& scene, const Exact_point& eye, const Seen& seen,
           std::size_t parts) {
  const Visible_counters& c = seen.counters;
  scene_rows(scene);
  row("eye", fmt::format(
                 "({}, {}, {}){}", to_string(eye[0]), to_string(eye[1]), to_string(eye[2]),
                 seen.edge_on > 0 ? fmt::format(", in the planes of {} pieces, which are edge-on", seen.edge_on) : ""));
  row("visible", fmt::format("{} of {} faces, in {} parts{}", seen.visible.size(), scene.counters().faces, parts,
                             arguments.two_sided ? "" : "; --two-sided counts back sides too"));
  const std::size_t fronts = fronts_of(seen), backs = seen.from_behind.size();
  if (backs > 0 && fronts * 9 <= backs)
    row("turned round?",
        fmt::format("{} of the {} faces that are seen show their backs: the eye is on their wrong side, or they are "
                    "turned round; --flip turns the scene, --two-sided counts backs",
                    backs, fronts + backs));
  if (arguments.method != "bsp2d") {
    row("looked at",
        fmt::format("{} pieces, counted once a region, in {} boxes; {} pieces and {} boxes dropped behind others",
                    c.looked_at, c.opened, c.hidden, c.hidden_boxes));
    row("regions", fmt::format("{} after {} cuts, {} of them where pieces cross; {} pairs put together again",
                               c.regions, c.splits, c.crossings, c.merged));
  }
  if (arguments.lines) print_lines(seen);
  if (seen.not_finite > 0) row("lost", fmt::format("{} parts are not finite", seen.not_finite));
  row("predicates", fmt::format("{} by names, {} by doubles, {} by fixed width, {} by GMP", c.predicates.combinatorial,
                                c.predicates.filtered, c.predicates.fixed, c.predicates.gmp));
  row("seconds",
      fmt::format("{:.4f} ({})", seen.seconds, arguments.method == "regions" ? arguments.kernel : arguments.method));
}

Exit run(const See_arguments& arguments) {
  const Common& common = arguments.common;
  check_usage(arguments);
  const Scene scene = scene_of(common.read());
  const Exact_point eye = eye_of(arguments.eye, scene);
  const bool has_view = !arguments.svg.empty() || arguments.frustum;
  const View view = has_view ? arguments.view.view(eye, scene) : View{eye};

  // 1. What is seen.
  Progress progress("looking");
  const Time_limit limit(common.budget);
  Visible_options options;
  options.threads = common.threads;
  options.progress = common.within_budget(progress);
  const std::vector<Exact_point> field =
      arguments.frustum && scene.counters().faces > 0 ? corner_rays(view) : std::vector<Exact_point>();
  const bool corners = !common.json.empty() || !arguments.html.empty() || !arguments.mesh.empty();
  const Seen seen =
      see(scene, eye, arguments.kernel, field,
          {arguments.two_sided, corners, arguments.method, arguments.certificate, arguments.lines}, options);

  // 2. What is drawn of it.
  if (!arguments.svg.empty()) write_picture(arguments, scene, view, options);
  if (!arguments.html.empty()) {
    progress.clear();
    write_page(arguments, scene, eye, seen, made_by_doubles(arguments, scene, eye, seen, options, limit));
  }
  if (!arguments.mesh.empty()) write_mesh(arguments.mesh, scene, seen);
  progress.clear();

  // 3. What is told of it.
  const std::vector<const Drawn*> parts = counted_parts(seen, arguments.two_sided);
  Json result{{"eye", point_json(eye)},
              {"visible", seen.visible},
              {"from_behind", seen.from_behind},
              {"pieces", common.json.empty() ? Json::array() : parts_json(parts)}},
      seconds{{"see", seen.seconds}};
  if (arguments.lines) {
    if (!common.json.empty()) result["lines"] = lines_json(scene, seen.lines);
    seconds["lines"] = seen.line_seconds;
  }
  if (!write_json(common, "see", scene, std::move(result), counters_of_seen(arguments, seen), seconds))
    print(arguments, scene, eye, seen, parts.size());
  return Exit::done;
}

}  // namespace

void add_see(Command program) {
  const Command command =
      program.add_command("see", "The exact visible parts of a scene from an eye, with a picture and a certificate");
  auto a = std::make_shared<See_arguments>();
  a->common.add_to(command);
  add_eye_option(command, a->eye);
  command.add_option("--kernel", a->kernel, "arithmetic")
      .check(one_of({"exact", "epeck", "gmpq", "double", "float"}))
      .show_default();
  command
      .add_option("--method", a->method,
                  "how directions are shared out, exactly, each in parts of its own: regions, cut by what is nearest "
                  "in them; weiler-atherton: along the edges of the nearest polygon; bsp2d: near to far by a tree, "
                  "clipped by another one of what is covered")
      .check(one_of({"regions", "weiler-atherton", "bsp2d"}))
      .show_default();
  command.add_flag("--two-sided", a->two_sided,
                   "count faces seen from behind too (they hide what is behind them anyway)");
  command.add_flag("--frustum", a->frustum,
                   "only what is in the picture's view (--look, --up, --field), not the whole sphere of directions");
  command.add_flag("--lines", a->lines,
                   "cut the scene's edges into visible and hidden parts: in the JSON with the face that hides them, "
                   "in the picture solid and, next to what is seen, dashed; what is farther behind is faint");
  command.add_option("--certificate", a->certificate, "write what `sightline verify` reads, unless --budget runs out")
      .writes_file();
  command.add_option("--svg", a->svg, "draw the visible parts; the n-th polygon of face 7 has the id face-7-n")
      .writes_file(".svg");
  command
      .add_option("--html", a->html,
                  "write a page to look at: the visible parts in the scene, and unrolled as the eye sees them; with "
                  "--lines what hides an edge")
      .writes_file(".html");
  add_mesh_option(command, a->mesh, "the visible parts, and the faces without,");
  a->view.add_to(command);
  command.footer(
      "Example: sightline see room.off --eye 0.5,-3,1.7 --svg room.svg --certificate room.json\n"
      "Where faces of one plane overlap, one is shown: seen from its front before from behind, then the lower face id; "
      "`visible` has them all.");
  command.set_action([a] { return run(*a); });
}

}  // namespace sightline::app
