// sightline weak: the faces that are weakly visible from polygons, a picture of them and their certificate.

#include "methods/along.h"
#include "methods/methods.h"
#include "methods/weak.h"
#include "support/drawing.h"
#include "support/page.h"
#include "weak_partition.h"

#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/kernel/vectors.h>

#include <tuple>

namespace sightline::app {

namespace {

struct Weak_arguments {
  Common common;
  View_arguments view;
  Source_arguments sources;
  std::string method = "lines", certificate, svg, html, obj, mesh, eye, surfaces, along;
  Weak_task task;
  Partition_arguments partition;
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

/// What pictures show of where they look from.
struct Picture_eye {
  Exact_point at;
  std::optional<std::array<Rational, 4>> cut;  ///< only what is in front of this plane, which the sources lie in
  std::string up;                              ///< as --up, where that is not given
};

Rational value(const std::array<Rational, 4>& h, const Exact_point& p) {
  return h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3];
}

/// Whether at least three of four rays from the middle of a source hit something. In doubles: a sample.
bool is_enclosed(const Occluders& occluders, const Weak_source& source) {
  constexpr int rays = 64;
  Triple p{}, n{source.plane.near[0], source.plane.near[1], source.plane.near[2]};
  for (const Near_point& corner : source.polygon)
    for (std::size_t k = 0; k < 3; ++k) p[k] += corner.near[k] / static_cast<double>(source.polygon.size());
  const double length = std::sqrt(dot(n, n));
  int hits = 0;
  for (int ray = 0; ray < rays; ++ray) {  // even steps up and around a half sphere
    const double up = (ray + 0.5) / rays, flat = std::sqrt(1 - up * up), angle = 2.399963 * ray;
    const Triple around{flat * std::cos(angle), flat * std::sin(angle), up};
    // The half sphere about z, turned so that its top is the normal.
    Triple axis = std::fabs(n[0]) < 0.6 * length ? Triple{1, 0, 0} : Triple{0, 1, 0}, u = cross(n, axis), v, direction;
    const double size = std::sqrt(dot(u, u));
    for (std::size_t k = 0; k < 3; ++k) u[k] /= size;
    v = cross(n, u);
    for (std::size_t k = 0; k < 3; ++k)
      direction[k] = around[0] * u[k] + around[1] * v[k] / length + around[2] * n[k] / length;
    hits += occluders.first_hit(p, direction).has_value();
  }
  return 4 * hits >= 3 * rays;
}

/// The sources' plane, if they lie in one and look to one side of it.
std::optional<std::array<Rational, 4>> plane_of(const Sources& sources) {
  std::optional<std::array<Rational, 4>> plane;
  for (const std::vector<Exact_point>& polygon : sources.points) {
    Exact_point n{};  // Newell's sum, which is right for any start
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      const Exact_point part = cross(minus(polygon[i], polygon[0]), minus(polygon[i + 1], polygon[0]));
      for (std::size_t k = 0; k < 3; ++k) n[k] += part[k];
    }
    if (!plane) plane = {n[0], n[1], n[2], Rational(-dot(n, polygon[0]))};
    const Exact_point first{(*plane)[0], (*plane)[1], (*plane)[2]};
    if (!(dot(n, first) > 0) ||
        std::any_of(polygon.begin(), polygon.end(), [&](const Exact_point& p) { return value(*plane, p) != 0; }))
      return std::nullopt;
  }
  return plane;
}

/// The eye that is asked for. By default behind sources that look into a room, a little to the side, far enough to see
/// all visible faces within 70 degrees, what is behind the sources cut away; outside the scene for other sources.
Picture_eye picture_eye(const Weak_arguments& arguments, const Occluders& occluders, const Sources& sources,
                        const std::vector<Exact_point>& visible) {
  const Scene& scene = occluders.scene();
  const std::optional<std::array<Rational, 4>> plane = arguments.eye.empty() ? plane_of(sources) : std::nullopt;
  if (!plane || visible.empty() ||
      std::none_of(sources.polygons.begin(), sources.polygons.end(),
                   [&](const Weak_source& source) { return is_enclosed(occluders, source); }))
    return {eye_of(arguments.eye, scene), std::nullopt, ""};

  // 1. A frame on the source: its middle, its normal, and upwards or, where that is the normal, to the south.
  const std::vector<Exact_point>& polygon = sources.points[0];
  Exact_point middle{};
  for (const Exact_point& p : polygon)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += p[k] / Rational(static_cast<long>(polygon.size()));
  const auto unit = [](Direction3 a) {
    const double size = std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
    for (double& x : a) x /= size;
    const double length = std::sqrt(dot(a, a));
    for (double& x : a) x /= length;
    return a;
  };
  const auto rounded = [](const Exact_point& p) {
    return Direction3{nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
  };
  const auto& h = *plane;
  const Rational largest = std::max({Rational(abs(h[0])), Rational(abs(h[1])), Rational(abs(h[2]))});
  const Direction3 n = unit(rounded({Rational(h[0] / largest), Rational(h[1] / largest), Rational(h[2] / largest)}));
  const bool upright = std::fabs(n[2]) < 0.9;
  Direction3 aside = upright ? Direction3{0, 0, 1} : Direction3{0, -1, 0};
  const double along = dot(aside, n);
  for (std::size_t k = 0; k < 3; ++k) aside[k] -= along * n[k];
  aside = unit(aside);

  // 2. How far behind: as far as the visible point that needs most.
  constexpr double widest = 0.7, lean = 0.3;  // the tangent of half of 70 degrees; aside for each unit behind
  double behind = 0;
  for (const Exact_point& p : visible) {
    const Direction3 v = rounded(minus(p, middle));
    const double depth = std::max(0.0, dot(v, n)), far = std::sqrt(std::max(0.0, dot(v, v) - dot(v, n) * dot(v, n)));
    behind = std::max(behind, far / widest - depth);
  }
  const double size = nearest_double(Rational(scene.box()[1][0] - scene.box()[0][0]));
  behind = std::max(behind, 0.01 * size);
  Picture_eye eye{middle, plane, upright ? "" : "0,1,0"};
  for (std::size_t k = 0; k < 3; ++k) eye.at[k] += exact(behind * (lean * aside[k] - n[k]));
  return eye;
}

/// Corners of the faces of which `wanted` holds, as far as they are in front of a plane, if there is one.
std::vector<Exact_point> corners_of(const Scene& scene, const std::optional<std::array<Rational, 4>>& cut,
                                    const std::function<bool(const Piece&)>& wanted) {
  std::vector<Exact_point> points;
  for (const Piece& piece : scene.pieces()) {
    if (!wanted(piece)) continue;
    const auto corners = scene.corners(piece);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Exact_point p = scene.position(corners[i].point),
                        q = scene.position(corners[(i + 1) % corners.size()].point);
      if (!cut) {
        points.push_back(p);
        continue;
      }
      const Rational a = value(*cut, p), b = value(*cut, q);
      if (a >= 0) points.push_back(p);
      if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
        Exact_point& between = points.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) between[k] = p[k] + (q[k] - p[k]) * (a / (a - b));
      }
    }
  }
  return points;
}

/// A plane in grid coordinates, on the same side of which are the same points.
std::array<Integer, 4> on_grid(const std::array<Rational, 4>& h, const Scene& scene) {
  // A point of the grid is at origin + step times its coordinates.
  const Exact_point origin = scene.position({0, 0, 0, 1});
  const Rational step = scene.position({1, 0, 0, 1})[0] - origin[0];
  const std::array<Rational, 4> there{h[0] * step, h[1] * step, h[2] * step, value(h, origin)};
  Integer denominators = 1;
  for (const Rational& x : there) denominators = lcm(denominators, x.get_den());
  std::array<Integer, 4> grid;
  for (std::size_t k = 0; k < 4; ++k) grid[k] = Rational(there[k] * denominators).get_num();
  return grid;
}

/// The fronts of faces, as a painter paints them: what has its back to the eye is left out, so that one looks into
/// rooms.
void draw(const Weak_arguments& arguments, Polygon_soup soup, const Occluders& occluders, const Sources& sources,
          const std::vector<std::string>& names) {
  // 1. The camera.
  const auto is_visible = [&](const Piece& piece) { return names[piece.face] == "visible"; };
  const std::optional<std::array<Rational, 4>> plane = plane_of(sources);
  const Picture_eye eye = picture_eye(arguments, occluders, sources, corners_of(occluders.scene(), plane, is_visible));
  const auto is_shown = [&](const Piece& piece) {
    return value(occluders.scene().file_coefficients(piece.support), eye.at) > 0;
  };
  std::vector<Exact_point> shown = corners_of(occluders.scene(), eye.cut, is_shown),
                           lit = corners_of(occluders.scene(), eye.cut, is_visible);
  for (const std::vector<Exact_point>& polygon : sources.points) {
    std::vector<Point_id> loop;
    for (const Exact_point& p : polygon) {
      loop.push_back(soup.add_point(p[0], p[1], p[2]));
      shown.push_back(p);
      lit.push_back(p);
    }
    soup.add_face(loop);
  }
  Scene scene(soup);
  constexpr double room_for_the_legend = 36;
  View_arguments camera = arguments.view;
  if (camera.up.empty()) camera.up = eye.up;
  View view = camera.view(eye.at, scene, shown, room_for_the_legend);
  if (eye.cut) {  // a large building is shown as far as it takes to show what is visible
    const View of_lit = camera.view(eye.at, scene, lit, room_for_the_legend);
    if (view.field > 1.4 * of_lit.field) view = of_lit;
  }

  // 2. What is in front of the cut, or of the near plane, farthest first.
  Task task;
  task.eye = eye.at;
  task.bsp.threads = arguments.common.threads;
  task.near = eye.cut ? on_grid(*eye.cut, scene) : near_plane(view, scene);
  std::vector<Drawn> drawn = run_method("exact", scene, task).drawn;

  // 3. Sources are drawn last where one looks through them, and else where they are.
  for (const std::vector<Face_id>* list :
       {&arguments.sources.faces,
        &arguments.sources.solid})  // faces of the scene that are sources: themselves, not their doubles
    for (const Face_id face : *list)
      for (Drawn& item : drawn)
        if (item.fragment.face == face) item.fragment.face = static_cast<Face_id>(names.size() - 1);
  const auto is_source = [&](const Drawn& item) { return names[item.fragment.face] == "source"; };
  std::erase_if(drawn, [&](const Drawn& item) {
    if (!eye.cut) return item.side != CGAL::POSITIVE && !is_source(item);
    const auto in_cut = [&](const Exact_point& p) { return value(*eye.cut, p) == 0; };
    return item.side != CGAL::POSITIVE || is_source(item) ||
           std::all_of(item.fragment.vertices.begin(), item.fragment.vertices.end(), in_cut);
  });
  Svg svg = empty_picture(view);
  paint(svg, view, drawn, true, [&](const Drawn& item, double shade) {
    const std::string& name = names[item.fragment.face];
    const auto [hue, strength, light] = name == "visible"  ? std::tuple(38, 85, 62)
                                        : name == "hidden" ? std::tuple(215, 12, 60)
                                        : name == "source" ? std::tuple(350, 75, 50)
                                                           : std::tuple(290, 60, 55);
    return Look{fmt::format("hsl({},{}%,{:.0f}%)", hue, strength, light + 14 * shade),
                name == "source" ? name : fmt::format("face {}: {}", item.fragment.face, name)};
  });
  if (eye.cut)
    for (std::size_t i = 0; i < sources.points.size(); ++i) {
      std::vector<Flat_point> outline;
      for (const Exact_point& p : sources.points[i]) outline.push_back(projected(view, p));
      svg.polygon(std::move(outline), "#d0204030", "#d02040", 1.6, fmt::format("source-{}", i + 1), "source");
    }
  svg.label(12, 22, 14, "orange: visible, grey: hidden, violet: undecided, red: the source", "start",
            ink_on(view.background));
  write_file(arguments.svg, svg.text());
}

/// The scene's pieces in groups "visible", "hidden", "undecided", and the sources.
Grouped_polygons drawing_of(const Scene& scene, const Sources& sources, const std::vector<std::string>& names) {
  Grouped_polygons polygons;
  const std::uint32_t visible = polygons.add_group("visible", drawing_colours::seen),
                      hidden = polygons.add_group("hidden", drawing_colours::hidden),
                      undecided = polygons.add_group("undecided", drawing_colours::open),
                      source = polygons.add_group("source", drawing_colours::source);
  add_pieces(polygons, scene, [&](std::uint32_t piece) {
    const std::string& name = names[scene.pieces()[piece].face];
    return name == "visible" ? visible : name == "hidden" ? hidden : undecided;
  });
  for (const std::vector<Exact_point>& polygon : sources.points)
    polygons.add_polygon(source, Grouped_polygons::no_face, polygon);
  return polygons;
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

// ---- The page

/// Sightlines of visible faces: the pair's piece and source, the ends, and these exactly where they are few.
Json sightlines_json(Page& page, const Scene& scene, const Weakly_visible& found) {
  constexpr std::size_t most = 8000, most_texts = 600;
  std::vector<std::uint32_t> pieces, sources;
  std::vector<float> ends;
  std::vector<std::string> texts;
  for (const Weakly_visible::Pair& pair : found.pairs) {
    if (pair.answer.status != Weak_status::visible) continue;
    if (pieces.size() == most) {
      page.add_note(fmt::format("the sightlines of {} faces are shown, the others left out", most));
      break;
    }
    pieces.push_back(pair.piece);
    sources.push_back(pair.source);
    for (const Near_point& end : pair.answer.sightline) {
      const Exact_point at = scene.position(end.exact);
      page.append_place(ends, at);
      if (found.visible.size() <= most_texts) texts.push_back(Page::text(at));
    }
  }
  return {{"pieces", packed(pieces)}, {"sources", packed(sources)}, {"ends", packed(ends)}, {"texts", texts}};
}

/// Proofs as walks that take a node before its two parts: `kinds` as in Weak_step::Kind, of each the piece that blocks
/// or has the edge, and that edge's first corner; the steps of the n-th pair are begin[n] up to begin[n + 1].
Json proofs_json(Page& page, const Weakly_visible& found) {
  constexpr std::size_t most_steps = 60000;
  std::vector<std::uint32_t> pieces, sources, begin{0}, kinds, of, corners;
  std::size_t left_out = 0;
  for (const std::vector<Weakly_visible::Pair>* list : {&found.pairs, &found.open})
    for (const Weakly_visible::Pair& pair : *list) {
      const Weak_answer& answer = pair.answer;
      if (answer.status == Weak_status::visible) continue;
      if (kinds.size() + answer.proof.size() > most_steps) {
        ++left_out;
        continue;
      }
      pieces.push_back(pair.piece);
      sources.push_back(pair.source);
      for (const Weak_step& step : answer.proof) {
        const bool is_line = step.kind == Weak_step::Kind::line;
        kinds.push_back(static_cast<std::uint32_t>(step.kind));
        of.push_back(is_line ? answer.lines[step.index].piece : step.index);
        corners.push_back(is_line ? answer.lines[step.index].corner : 0);
      }
      begin.push_back(static_cast<std::uint32_t>(kinds.size()));
    }
  if (left_out > 0)
    page.add_note(fmt::format("the proofs of {} pairs are too long for a page: --certificate writes them", left_out));
  return {{"pieces", packed(pieces)}, {"sources", packed(sources)}, {"begin", packed(begin)},
          {"kinds", packed(kinds)},   {"of", packed(of)},           {"corners", packed(corners)}};
}

/// Faces by what is known of them, sources, sightlines and proofs.
void write_page(const Weak_arguments& arguments, const Scene& scene, const Sources& sources,
                const Weakly_visible& found, const std::vector<std::string>& names) {
  static const std::vector<std::string> groups{"visible", "hidden", "undecided", "source"};
  Page page("weak", scene);
  page.add_fact("faces", fmt::format("{}", scene.counters().faces));
  page.add_fact("sources", fmt::format("{} convex polygons", sources.points.size()));
  page.add_fact("visible", fmt::format("{}", found.visible.size()));
  page.add_fact("hidden", fmt::format("{}", found.hidden.size()));
  page.add_fact("undecided", fmt::format("{}", found.undecided.size()));
  page.add_fact("method", arguments.method);
  for (const auto& [name, role] :
       {std::pair("visible", "seen"), {"hidden", "hidden"}, {"undecided", "open"}, {"source", "source"}})
    page.add_group(name, role);
  page.add_pieces(scene, [&](std::uint32_t piece) {
    const std::string& name = names[scene.pieces()[piece].face];
    return static_cast<std::uint32_t>(std::find(groups.begin(), groups.end(), name) - groups.begin());
  });
  page.more()["base"] = page.polygons();
  for (const std::vector<Exact_point>& source : sources.points) page.add_polygon(Page::no_face, source, 3);
  page.more()["sightlines"] = sightlines_json(page, scene, found);
  page.more()["proofs"] = proofs_json(page, found);
  page.write(arguments.html);
}

// ---- The command

Exit run_weak(const Weak_arguments& arguments) {
  const Common& common = arguments.common;
  const std::string& method = arguments.method;
  const bool is_partition = arguments.partition.asked_for();
  if (is_partition || !arguments.along.empty()) {
    const std::string name = is_partition ? "--partition" : "--along";
    const View_arguments& view = arguments.view;
    for (const auto& [other, is_given] : {std::pair("--obj", !arguments.obj.empty()),
                                          {"--mesh", !arguments.mesh.empty()},
                                          {"--eye", !arguments.eye.empty()},
                                          {"--look", !view.look.empty()},
                                          {"--up", !view.up.empty()},
                                          {"--field", view.field != 0},
                                          {"--shade", view.shade != View_arguments{}.shade},
                                          {"--size", !view.canvas.size.empty()},
                                          {"--background", !view.canvas.background.empty()},
                                          {"--html", !arguments.html.empty()},
                                          {"--surfaces", !arguments.surfaces.empty()}})
      if (is_given)
        throw Usage_error(std::string(other) + " is for faces that are visible or hidden: leave it out with " + name);
    if (is_partition && !arguments.certificate.empty())
      throw Usage_error("--certificate is not written of a partition: leave it out with --partition");
    if (is_partition) return run_partition(arguments.partition, common, arguments.sources, arguments.svg);
    if (!arguments.sources.empty()) throw Usage_error("--along is a path of its own: leave out --from and its like");
    return run_along(common, {arguments.along, arguments.sources.two_sided, arguments.certificate, arguments.svg});
  }
  if ((method == "sample" || method == "doubles") && !arguments.certificate.empty())
    throw Usage_error("--method " + method + " proves nothing: leave out --certificate, or take --method lines");
  const Weak_task usual;
  for (const auto& [option, its, is_given] :
       {std::tuple("--rays", "sample", arguments.task.rays != usual.rays),
        {"--cells", "lines", arguments.task.cells != usual.cells},
        {"--event-edges", "lines", arguments.task.event_edges != usual.event_edges}})
    if (is_given && method != its) throw Usage_error(fmt::format("{} is for --method {}: leave it out", option, its));
  const bool as_obj = arguments.surfaces.ends_with(".obj");
  if (!arguments.surfaces.empty() && method != "events")
    throw Usage_error("--surfaces are those of events: add --method events");
  if (!arguments.surfaces.empty() && !as_obj && !arguments.surfaces.ends_with(".json"))
    throw Usage_error("--surfaces wants a file that ends with .json or .obj, not " + arguments.surfaces);
  arguments.view.check_usage(!arguments.svg.empty());
  if (arguments.svg.empty() && !arguments.eye.empty())
    throw Usage_error("--eye is the eye of the picture: add --svg FILE, or leave it out");
  if (!arguments.eye.empty()) parse_point(arguments.eye, "--eye");
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
  if (!arguments.svg.empty()) draw(arguments, soup, occluders, sources, names);
  if (!arguments.obj.empty() || !arguments.mesh.empty())
    write_drawings(arguments.obj, arguments.mesh, drawing_of(scene, sources, names));
  if (!arguments.html.empty()) write_page(arguments, scene, sources, found, names);

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
    row("searches",
        fmt::format("{}: {} facing away, {} seen by the first lines, {} hidden by one piece; {} cells in the others",
                    c.targets, c.away, c.by_rays, c.by_one, c.cells));
  if (method == "lines" && found.visible.empty() && found.undecided.empty() && c.away > 0 && c.cells == 0 &&
      c.by_one == 0)
    row("turned round?",
        "all faces are behind the source or have their backs to it; a source looks to the side from which its corners "
        "run counterclockwise: to look to the other one, write them backwards; --flip turns the scene instead");
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
      .writes_file()
      .check(ending(".svg"));
  command
      .add_option("--html", a->html,
                  "write a page to look at: what is visible, hidden, undecided; of a face its sightline, or its proof "
                  "as a tree to walk")
      .writes_file()
      .check(ending(".html"));
  add_mesh_option(command, a->mesh, "faces visible, hidden, undecided, and the sources,");
  command.add_option("--obj", a->obj, "the same as OBJ").writes_file().check(ending(".obj"));
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
