// sightline shadow: which parts of faces lights reach, and what shadows the others; exactly.

#include "support/drawing.h"
#include "support/picture.h"
#include "support/solid_file.h"

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/shadow/shadow.h>
#include <sightline/algorithms/shadow/volume.h>
#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/io/format.h>
#include <sightline/kernel/threads.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace sightline::app {

namespace {

struct Shadow_arguments {
  Common common;
  std::vector<std::string> lights, suns;
  bool two_sided = false;
  std::string eye, svg, obj, mesh, volume;
  View_arguments view;
};

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

// ---- The picture

using Corners = std::vector<Direction3>;

/// What is in both of two convex polygons of one plane, which is not parallel to the axis.
Corners common_part(Corners polygon, const Corners& by, std::size_t axis) {
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  double sense = 0;
  for (std::size_t k = 0; k < by.size(); ++k) {
    const Direction3 &a = by[k], &b = by[(k + 1) % by.size()];
    sense += a[x] * b[y] - a[y] * b[x];
  }
  for (std::size_t k = 0; k < by.size() && !polygon.empty(); ++k) {
    const Direction3 &a = by[k], &b = by[(k + 1) % by.size()];
    const auto inside = [&](const Direction3& p) {
      return ((b[x] - a[x]) * (p[y] - a[y]) - (b[y] - a[y]) * (p[x] - a[x])) * sense;
    };
    Corners left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Direction3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double at_p = inside(p), at_q = inside(q);
      if (at_p >= 0) left.push_back(p);
      if ((at_p < 0) == (at_q < 0)) continue;
      const double share = at_p / (at_p - at_q);
      left.push_back({p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1]), p[2] + share * (q[2] - p[2])});
    }
    polygon = std::move(left);
  }
  return polygon.size() < 3 ? Corners() : polygon;
}

Corners rounded_corners(const std::vector<Exact_point>& corners) {
  Corners all;
  for (const Exact_point& p : corners)
    all.push_back({nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])});
  return all;
}

/// The axis that a polygon is steepest to.
std::size_t axis_of(const Corners& corners) {
  Direction3 normal{};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Direction3 n = cross(corners[k], corners[(k + 1) % corners.size()]);
    for (std::size_t i = 0; i < 3; ++i) normal[i] += n[i];
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::fabs(normal[k]) > std::fabs(normal[axis])) axis = k;
  return axis;
}

/// Twice its area.
double size_of(const Corners& corners) {
  Direction3 normal{};
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Direction3 n = cross(minus(corners[k - 1], corners[0]), minus(corners[k], corners[0]));
    for (std::size_t i = 0; i < 3; ++i) normal[i] += n[i];
  }
  return std::sqrt(dot(normal, normal));
}

/// A part of what the eye sees, with how many lights reach it, and what shadows it from the last one that does not.
struct Shown {
  std::uint32_t piece;
  Sign side;
  bool is_small;  ///< in the picture
  std::size_t lights = 0;
  bool turned = false;  ///< to a light
  std::uint32_t by = Shadow_part::nothing;
  Corners corners = {};

  /// What looks alike is one shape.
  auto look() const { return std::tuple(piece, lights, turned, by); }
};

using Flat_box = std::array<Flat_point, 2>;  // least, most
constexpr Flat_box empty_box{{{1e300, 1e300}, {-1e300, -1e300}}};
void add_to(Flat_box& box, const Flat_point& p) {
  for (std::size_t k = 0; k < 2; ++k) {
    box[0][k] = std::min(box[0][k], p[k]);
    box[1][k] = std::max(box[1][k], p[k]);
  }
}
Flat_box box_of(const std::vector<Flat_point>& points) {
  Flat_box box = empty_box;
  for (const Flat_point& p : points) add_to(box, p);
  return box;
}

/// The parts that a light makes of one side of a piece, found by where they are on it: a ground has thousands.
class Parts_on_piece {
 public:
  void add(const Shadow_part& part) { parts_.push_back({&part, rounded_corners(part.vertices), {}}); }
  bool empty() const { return parts_.empty(); }

  void prepare() {
    if (parts_.empty()) return;
    axis_ = axis_of(parts_[0].corners);
    whole_ = empty_box;
    for (One& one : parts_) {
      one.box = box(one.corners);
      for (const Flat_point& p : one.box) add_to(whole_, p);
    }
    side_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(parts_.size()))), 1, 512);
    cells_.assign(side_ * side_, {});
    seen_.assign(parts_.size(), 0);
    for (std::uint32_t i = 0; i < parts_.size(); ++i)
      for_each_cell(parts_[i].box, [&](auto& cell) { cell.push_back(i); });
  }

  /// visit(part, what it has in common with a polygon of the piece), in their order.
  template <class Visit>
  void cut(const Corners& polygon, Visit visit) {
    const Flat_box at = box(polygon);
    ++asked_;
    std::vector<std::uint32_t> near;
    for_each_cell(at, [&](const auto& cell) {
      for (const std::uint32_t i : cell)
        if (std::exchange(seen_[i], asked_) != asked_ && are_near(parts_[i].box, at)) near.push_back(i);
    });
    std::sort(near.begin(), near.end());
    for (const std::uint32_t i : near)
      if (Corners common = common_part(polygon, parts_[i].corners, axis_); !common.empty())
        visit(*parts_[i].part, std::move(common));
  }

 private:
  struct One {
    const Shadow_part* part;
    Corners corners;
    Flat_box box;
  };

  Flat_box box(const Corners& corners) const {
    Flat_box box = empty_box;
    for (const Direction3& p : corners) add_to(box, {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]});
    return box;
  }
  static bool are_near(const Flat_box& a, const Flat_box& b) {
    return a[0][0] <= b[1][0] && b[0][0] <= a[1][0] && a[0][1] <= b[1][1] && b[0][1] <= a[1][1];
  }
  template <class Visit>
  void for_each_cell(const Flat_box& box, Visit visit) {
    const auto cell = [&](double x, std::size_t k) {
      const double at = (x - whole_[0][k]) / (whole_[1][k] - whole_[0][k]) * static_cast<double>(side_);
      return at > 0 ? std::min(side_ - 1, static_cast<std::size_t>(std::min(at, 1e9))) : 0;  // 0 for no number, too
    };
    for (std::size_t y = cell(box[0][1], 1); y <= cell(box[1][1], 1); ++y)
      for (std::size_t x = cell(box[0][0], 0); x <= cell(box[1][0], 0); ++x) visit(cells_[y * side_ + x]);
  }

  std::vector<One> parts_;
  std::size_t axis_ = 0, side_ = 1;
  Flat_box whole_{};
  std::vector<std::vector<std::uint32_t>> cells_;
  std::vector<std::uint64_t> seen_;
  std::uint64_t asked_ = 0;
};

Look look_of(const Scene& scene, const Shown& one, std::size_t lights, double shade) {
  const std::string face = fmt::format("face {}", scene.pieces()[one.piece].face);
  const double light = static_cast<double>(one.lights) / static_cast<double>(lights);
  const auto mixed = [&](int dark, int bright, double by_shade) {
    return static_cast<int>(std::clamp(dark + light * (bright - dark) + by_shade * shade, 0.0, 255.0));
  };
  const double less = one.turned ? 1 : 0.72;  // what is turned away is darkest
  const std::string fill =
      fmt::format("#{:02x}{:02x}{:02x}", static_cast<int>(less * mixed(98, 232, 26)),
                  static_cast<int>(less * mixed(104, 206, 26)), static_cast<int>(less * mixed(128, 140, 22)));
  if (!one.turned) return {fill, face + ", turned away"};
  if (one.by == Shadow_part::nothing) return {fill, face + ", lit"};
  return {fill, fmt::format("{}, {}in the shadow of face {}", face,
                            one.lights > 0 ? fmt::format("lit by {} of {}, ", one.lights, lights) : "",
                            scene.pieces()[one.by].face)};
}

/// What an eye sees, each part cut by the shadows on it; but what is smaller than a pixel is drawn whole, in the light
/// of the largest part of it. Returns how many are.
std::size_t draw(const Shadow_arguments& arguments, const Scene& scene, const Piece_boxes& boxes,
                 const std::vector<Shadows>& all, const Exact_point& eye) {
  std::size_t whole = 0;
  const sightline::app::View view = arguments.view.view(eye, scene);
  Svg svg = empty_picture(view);
  if (scene.counters().faces > 0) {
    const Exact_view seen_from(scene, eye, field_of(corner_rays(view)));
    Visible_options options;
    options.threads = arguments.common.threads;
    options.progress = arguments.common.within_budget([](std::size_t, std::size_t) {});
    const auto surface = visible_surface(seen_from, boxes, field_of_view(seen_from), options);
    const Axes axes = axes_of(view);
    const Direction3 from{nearest_double(eye[0]), nearest_double(eye[1]), nearest_double(eye[2])};
    const auto in_picture = [&](const Corners& corners) {
      std::vector<Flat_point> points;
      for (const Direction3& p : corners) points.push_back(projected(view, axes, minus(p, from)));
      return points;
    };
    std::vector<Shown> shown;
    for (const auto& part : surface.parts) {
      if (part.piece == surface.nothing) continue;
      Corners corners = rounded_corners(vertices(seen_from, surface, part));
      const auto [least, most] = box_of(in_picture(corners));
      Shown& one = shown.emplace_back(Shown{part.piece, seen_from.eye_side(part.piece), false});
      one.is_small = most[0] - least[0] < 1 && most[1] - least[1] < 1;
      one.corners = std::move(corners);
      whole += one.is_small;
    }
    for (const Shadows& of_light : all) {
      std::map<std::pair<std::uint32_t, Sign>, Parts_on_piece> by_piece;  // the light is on that side
      for (const Shadow_part& part : of_light.parts) by_piece[{part.piece, part.side}].add(part);
      for (auto& [piece, parts] : by_piece) parts.prepare();
      std::vector<Shown> finer;
      for (Shown& one : shown) {
        options.progress(0, shown.size());
        const auto parts = by_piece.find({one.piece, one.side});
        if (parts == by_piece.end()) {
          finer.push_back(std::move(one));
          continue;
        }
        const auto put = [&](Shown& to, const Shadow_part& part) {
          to.turned = true;
          to.lights += part.is_lit();
          if (!part.is_lit()) to.by = part.by;
        };
        if (one.is_small) {
          double most = -1;
          const Shadow_part* largest = nullptr;
          parts->second.cut(one.corners, [&](const Shadow_part& part, const Corners& common) {
            if (const double size = size_of(common); size > most) {
              most = size;
              largest = &part;
            }
          });
          if (largest != nullptr) put(one, *largest);
          finer.push_back(std::move(one));
          continue;
        }
        parts->second.cut(one.corners, [&](const Shadow_part& part, Corners&& common) {
          Shown& cut =
              finer.emplace_back(Shown{one.piece, one.side, false, one.lights, one.turned, one.by, std::move(common)});
          put(cut, part);
        });
      }
      shown = std::move(finer);
    }
    // What looks alike, in the order in which its first part is found.
    std::map<decltype(shown[0].look()), std::size_t> places;
    std::vector<std::pair<const Shown*, std::vector<std::vector<Flat_point>>>> shapes;
    for (const Shown& one : shown) {
      const auto [place, is_new] = places.try_emplace(one.look(), shapes.size());
      if (is_new) shapes.push_back({&one, {}});
      shapes[place->second].second.push_back(in_picture(one.corners));
    }
    std::map<Face_id, std::size_t> of_face;
    std::vector<Exact_point> corners;
    for (const auto& [first, polygons] : shapes) {
      const Piece& piece = scene.pieces()[first->piece];
      corners.clear();
      for (const Piece_corner& corner : scene.corners(piece)) corners.push_back(scene.position(corner.point));
      if (first->side == CGAL::NEGATIVE) std::reverse(corners.begin(), corners.end());
      const Look look = look_of(scene, *first, all.size(), view.lit ? shade_of(corners) : 0);
      svg.shape(polygons, look.fill, look.fill, 0.4, fmt::format("face-{}-{}", piece.face, ++of_face[piece.face]),
                look.title);
    }
  }
  write_file(arguments.svg, svg.text());
  return whole;
}

// ---- Other outputs

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
      corners.clear();
      for (const Piece_corner& corner : scene.corners(scene.pieces()[i]))
        corners.push_back(scene.position(corner.point));
      polygons.add_polygon(away, scene.pieces()[i].face, corners);
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

}  // namespace

static Exit run(const Shadow_arguments& arguments) {
  const Common& common = arguments.common;
  const std::vector<Placed_light> lights = lights_of(arguments);
  if (arguments.svg.empty() && !arguments.eye.empty()) throw Usage_error("--eye is the eye of the picture: give --svg");
  if (!arguments.eye.empty()) parse_point(arguments.eye, "--eye");
  arguments.view.check_usage(!arguments.svg.empty());
  if (!arguments.volume.empty() && lights.size() > 1)
    throw Usage_error("--volume is of one light: give one --light or --sun for each file");
  const Scene scene(common.read());
  const Stopwatch watch;
  const Piece_boxes boxes(scene);
  std::vector<Shadows> all;
  for (const Placed_light& light : lights) {
    Progress progress("casting shadows");
    Shadow_options options;
    options.two_sided = arguments.two_sided;
    options.threads = common.threads;
    options.progress = common.within_budget([&](std::size_t done, std::size_t of) { progress(done, of); });
    all.push_back(shadows(light.view(scene), boxes, options));
  }
  const double seconds = watch.seconds();
  const std::size_t whole =
      arguments.svg.empty() ? 0 : draw(arguments, scene, boxes, all, eye_of(arguments.eye, scene));
  if (!arguments.obj.empty() || !arguments.mesh.empty())
    write_drawings(arguments.obj, arguments.mesh, drawing_of(scene, all));

  // The space behind them.
  Json volume_json;
  std::string volume_text;
  if (!arguments.volume.empty()) {
    const Stopwatch since;
    Shadow_volume made;
    Progress progress("the space in shadow");
    const auto report = common.within_budget([&](std::size_t done, std::size_t of) { progress(done, of); });
    run_with_threads(common.threads, [&] {
      made = lights[0].is_sun ? shadow_volume(scene, Sun{lights[0].at}, report)
                              : shadow_volume(scene, lights[0].at, report);
    });
    progress.clear();
    const Polygon_soup flat = without_holes(made.soup).soup;
    const auto rounding = write_solid(flat, arguments.volume, false, true);
    const Rational size = volume(made.soup);
    volume_json = {{"faces", flat.face_count()},
                   {"casting", made.casting},
                   {"volume", to_string(size)},
                   {"box", {point_json(made.box[0]), point_json(made.box[1])}},
                   {"seconds", since.seconds()}};
    if (rounding) volume_json["rounding"] = rounding_json(*rounding);
    volume_text = fmt::format(
        "{} in shadow, of {} pieces, within the scene's box and a quarter of its longest side; "
        "{} faces, {:.3f} seconds{}{}",
        digits_of(size, 6), made.casting, flat.face_count(), since.seconds(), rounding ? "; rounded: " : "",
        rounding ? rounding_text(*rounding) : "");
  }

  // Faces that some light reaches, and the others.
  std::vector<bool> is_lit(scene.counters().faces_read), kept(is_lit.size());
  for (const Piece& piece : scene.pieces()) kept[piece.face] = true;
  Shadow_counters counters;
  for (const Shadows& of_light : all) {
    for (const Face_id face : of_light.lit) is_lit[face] = true;
    counters += of_light.counters;
  }
  std::vector<Face_id> lit_faces, dark_faces;
  for (Face_id face = 0; face < kept.size(); ++face)
    if (kept[face]) (is_lit[face] ? lit_faces : dark_faces).push_back(face);
  Json lit = Json::array(), dark = Json::array(), of_lights = Json::array();
  if (!common.json.empty())
    for (std::size_t k = 0; k < all.size(); ++k) {
      of_lights.push_back({{lights[k].is_sun ? "sun" : "light", point_json(lights[k].at)},
                           {"lit_faces", all[k].lit},
                           {"away", all[k].away}});
      for (const Shadow_part& part : all[k].parts) (part.is_lit() ? lit : dark).push_back(part_json(scene, part, k));
    }
  Json result{{"lights", std::move(of_lights)},
              {"lit", std::move(lit)},
              {"dark", std::move(dark)},
              {"lit_faces", lit_faces},
              {"dark_faces", dark_faces}};
  if (!volume_json.is_null()) result["volume"] = std::move(volume_json);
  if (write_json(common, "shadow", scene, std::move(result), counters_json(counters), {{"shadow", seconds}}))
    return Exit::done;
  scene_rows(scene);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Shadows& of_light = all[k];
    const auto parts = static_cast<std::size_t>(std::count_if(of_light.parts.begin(), of_light.parts.end(),
                                                              [](const Shadow_part& part) { return part.is_lit(); }));
    row(lights[k].is_sun ? "sun" : "light",
        fmt::format("{}: {} faces lit, {} turned away; {} lit parts, {} in shadow", lights[k].name(),
                    of_light.lit.size(), of_light.away.size(), parts, of_light.parts.size() - parts));
  }
  std::string some;
  for (std::size_t k = 0; k < std::min<std::size_t>(dark_faces.size(), 12); ++k)
    some += fmt::format("{}{}", k == 0 ? ": " : ", ", dark_faces[k]);
  if (dark_faces.size() > 12) some += ", ...";
  row("lit", fmt::format("{} of {} faces, in part at least{}", lit_faces.size(), scene.counters().faces,
                         arguments.two_sided ? "" : "; --two-sided counts back sides too"));
  row("lit by none", fmt::format("{}{}", dark_faces.size(), some));
  if (!volume_text.empty()) row("volume", volume_text);
  if (whole > 0)
    row("picture", fmt::format("{} parts smaller than a pixel are drawn whole, in the light of most of them", whole));
  row("seconds", fmt::format("{:.4f}", seconds));
  return Exit::done;
}

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
      .check(solid_ending());
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
