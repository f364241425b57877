#include "picture.h"

#include <sightline/kernel/quoted.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace sightline::app {

static Direction3 unit(const Direction3& a) {
  const double size = std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
  if (!(size > 0)) return {};
  const Direction3 scaled{a[0] / size, a[1] / size, a[2] / size};
  const double length = std::sqrt(dot(scaled, scaled));
  return {scaled[0] / length, scaled[1] / length, scaled[2] / length};
}
static Direction3 difference(const Exact_point& a, const Exact_point& b) {
  return {nearest_double(Rational(a[0] - b[0])), nearest_double(Rational(a[1] - b[1])),
          nearest_double(Rational(a[2] - b[2]))};
}
/// `way`, from an eye to a point; or where doubles do not hold that well, another one of its direction. Degenerate:
/// zero where they are one.
static Direction3 towards(const Exact_point& p, const Exact_point& eye, const Direction3& way) {
  const double size = std::max({std::fabs(way[0]), std::fabs(way[1]), std::fabs(way[2])});
  if (size > 1e-300 && size < 1e300) return way;
  Exact_point exact_way;
  Rational longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    exact_way[k] = p[k] - eye[k];
    longest = std::max(longest, Rational(abs(exact_way[k])));
  }
  if (longest == 0) return {};
  for (Rational& x : exact_way) x /= longest;
  return difference(exact_way, {});
}
static Direction3 towards(const Exact_point& p, const Exact_point& eye) { return towards(p, eye, difference(p, eye)); }

Direction3 Near_doubles::vector(const Exact_point& v) const {
  return {nearest_double(times_power(v[0], exponent_)), nearest_double(times_power(v[1], exponent_)),
          nearest_double(times_power(v[2], exponent_))};
}
Near_doubles near_doubles(const std::array<Exact_point, 2>& box) {
  const Exact_point sizes = minus(box[1], box[0]);
  Exact_point middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (box[0][k] + box[1][k]) / 2;
  return {middle, std::max({sizes[0], sizes[1], sizes[2]})};
}

static Direction3 parse_direction(const std::string& text, const std::string& option) {
  const Exact_point p = parse_point(text, option);
  const Direction3 direction{nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
  for (const double x : direction)
    if (!std::isfinite(x)) throw Usage_error(option + " wants a direction in the range of doubles");
  if (direction == Direction3{}) throw Usage_error(option + " wants a direction that is not 0,0,0");
  return direction;
}

// ---- Options

std::array<int, 2> parse_size(const std::string& text, const std::string& option, int least, int most) {
  std::istringstream in(text);
  std::array<int, 2> size{};
  char times = 0;
  const auto good = [&](int x) { return x >= least && x <= most; };
  if (text.find_first_not_of("0123456789x") != std::string::npos || !(in >> size[0] >> times >> size[1]) ||
      times != 'x' || !in.eof() || !good(size[0]) || !good(size[1]))
    throw Usage_error(fmt::format("{0} wants WIDTHxHEIGHT from {1}x{1} to {2}x{2}, not {3}", option, least, most,
                                  sightline::quoted(text)));
  return size;
}

/// Names of colours, and their red, green and blue.
static const std::map<std::string, std::array<int, 3>> named_colours{
    {"black", {0, 0, 0}},    {"white", {255, 255, 255}}, {"gray", {128, 128, 128}}, {"silver", {192, 192, 192}},
    {"red", {255, 0, 0}},    {"maroon", {128, 0, 0}},    {"green", {0, 128, 0}},    {"lime", {0, 255, 0}},
    {"blue", {0, 0, 255}},   {"navy", {0, 0, 128}},      {"yellow", {255, 255, 0}}, {"olive", {128, 128, 0}},
    {"aqua", {0, 255, 255}}, {"teal", {0, 128, 128}},    {"purple", {128, 0, 128}}, {"fuchsia", {255, 0, 255}}};

static bool is_colour(const std::string& text) {
  if (text == "none" || named_colours.contains(text)) return true;
  return (text.size() == 4 || text.size() == 7) && text[0] == '#' &&
         text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
}

constexpr int least_size = 16, most_size = 16384;

void Canvas_arguments::add_to(Command command, const std::string& usual) {
  command
      .add_option(
          "--size", size,
          fmt::format("WIDTHxHEIGHT of the picture in pixels, each from {} to {}; {}", least_size, most_size, usual))
      .check(none_of([](const std::string& text) -> std::string {
        try {
          parse_size(text, "it", least_size, most_size);
          return "";
        } catch (const Usage_error& error) {
          return error.what();
        }
      }));
  command
      .add_option("--background", background,
                  "of the picture: #rgb or #rrggbb in hexadecimal digits, a name of HTML's sixteen, or none, which is "
                  "transparent")
      .check(none_of([](const std::string& text) -> std::string {
        if (is_colour(text)) return "";
        std::string names;
        for (const auto& [name, value] : named_colours) names += name + ", ";
        return sightline::quoted(text) + " is no colour: give #rgb, #rrggbb, " + names + "or none";
      }));
}

std::array<int, 2> Canvas_arguments::size_or(const std::array<int, 2>& usual) const {
  return size.empty() ? usual : parse_size(size, "--size", least_size, most_size);
}

std::array<int, 4> rgba_of(const std::string& background) {
  if (background == "none") return {0, 0, 0, 0};
  if (const auto named = named_colours.find(background); named != named_colours.end())
    return {named->second[0], named->second[1], named->second[2], 255};
  std::array<int, 4> colour{0, 0, 0, 255};
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = background.size() == 4 ? 17 * std::stoi(background.substr(1 + k, 1), nullptr, 16)
                                       : std::stoi(background.substr(1 + 2 * k, 2), nullptr, 16);
  return colour;
}

std::string ink_on(const std::string& background) {
  const std::array<int, 4> colour = rgba_of(background);
  // How bright each of the three looks.
  return colour[3] == 0 || 0.3 * colour[0] + 0.6 * colour[1] + 0.1 * colour[2] > 110 ? "#000000" : "#f4f3ef";
}

Option add_shade_option(Command command, std::string& shade) {
  return command
      .add_option("--shade", shade,
                  "lambert: faces of a picture are lighter towards the light; none: one colour a face")
      .check(one_of({"lambert", "none"}))
      .show_default();
}

void View_arguments::add_to(Command command, const std::string& usual) {
  command.add_option("--look", look,
                     "direction X,Y,Z of the picture; by default to the middle of what there is to see");
  command.add_option("--up", up,
                     "up direction X,Y,Z of the picture (0,0,1); where the look goes along it, 0,1,0 or 1,0,0");
  command
      .add_option("--field", field,
                  "width of the picture's view in degrees; by default so wide that what there is to see fills the "
                  "picture, 90 where it is all around the eye")
      .check(range(least_field, most_field) & finite_number());
  add_shade_option(command, shade);
  canvas.add_to(command, usual);
}

Usage_error no_picture_for(const std::string& option) {
  return Usage_error(option + " is of a picture: add --svg FILE, or leave it out");
}

const char* View_arguments::first_given() const {
  for (const auto& [option, is_given] : {std::pair("--look", !look.empty()),
                                         {"--up", !up.empty()},
                                         {"--field", field != 0},
                                         {"--shade", shade != View_arguments{}.shade},
                                         {"--size", !canvas.size.empty()},
                                         {"--background", !canvas.background.empty()}})
    if (is_given) return option;
  return nullptr;
}

void View_arguments::check_usage(bool has_picture) const {
  if (const char* option = first_given(); option != nullptr && !has_picture) throw no_picture_for(option);
  check_usage();
}

void View_arguments::check_usage() const {
  if (!look.empty()) parse_direction(look, "--look");
  if (!up.empty()) parse_direction(up, "--up");
}

// ---- The camera

/// What directions span in a picture: the tangents of their angles to the right and upwards.
struct Span {
  std::array<double, 2> least{1e300, 1e300}, most{-1e300, -1e300};
  double half(std::size_t k) const { return (most[k] - least[k]) / 2; }
};
/// None where one of the directions is not well before the eye.
static std::optional<Span> span_of(const View& view, const std::vector<Direction3>& rays) {
  constexpr double well_before = 0.2;  // the cosine of 78 degrees
  const auto [right, up] = axes_of(view);
  Span span;
  for (const Direction3& ray : rays) {
    const double depth = dot(ray, view.look);
    if (!(depth > well_before)) return std::nullopt;
    const std::array<double, 2> at{dot(ray, right) / depth, dot(ray, up) / depth};
    for (std::size_t k = 0; k < 2; ++k) {
      span.least[k] = std::min(span.least[k], at[k]);
      span.most[k] = std::max(span.most[k], at[k]);
    }
  }
  return span;
}

/// The axis of a narrow cone around unit vectors: it goes towards the farthest one, by ever shorter steps.
static Direction3 middle_of(const std::vector<Direction3>& rays) {
  Direction3 axis{};
  for (const Direction3& ray : rays)
    for (std::size_t k = 0; k < 3; ++k) axis[k] += ray[k];
  axis = unit(axis);
  for (int step = 2; step < 40; ++step) {
    const auto far = std::min_element(rays.begin(), rays.end(), [&](const Direction3& a, const Direction3& b) {
      return dot(a, axis) < dot(b, axis);
    });
    for (std::size_t k = 0; k < 3; ++k) axis[k] += ((*far)[k] - axis[k]) / step;
    axis = unit(axis);
  }
  return axis;
}

View View_arguments::view(const Exact_point& eye, const Scene& scene, double margin, const Report& in_time) const {
  if (in_time) in_time(0, 1);
  std::vector<Exact_point> all;
  std::vector<bool> taken(scene.points().size());
  for (const Piece& piece : scene.pieces())
    for (const Piece_corner& corner : scene.corners(piece))
      if (!taken[corner.point]) {
        taken[corner.point] = true;
        all.push_back(scene.position(corner.point));
      }
  return view(eye, scene, all, margin, in_time);
}

View View_arguments::view(const Exact_point& eye, const Scene& scene, const std::vector<Exact_point>& shown,
                          double margin, const Report& in_time) const {
  // 1. What is given.
  View view{eye};
  if (!look.empty()) view.look = parse_direction(look, "--look");
  if (!up.empty()) view.up = parse_direction(up, "--up");
  const auto [width, height] = canvas.size_or({view.width, view.height});
  view.width = width;
  view.height = height;
  view.background = canvas.background_or(view.background);
  view.field = field > 0 ? field : 90;
  view.lit = shade == "lambert";
  if (scene.counters().faces == 0) return view;

  // 2. The direction: to the middle of what is shown, which each step brings nearer.
  std::vector<Direction3> rays;
  for (const Exact_point& p : shown)
    if (const Direction3 ray = unit(towards(p, eye)); ray != Direction3{}) rays.push_back(ray);
  if (rays.empty()) return aimed(view, scene);
  const bool to_aim = look.empty();
  if (to_aim) view.look = middle_of(rays);
  std::optional<Span> span;
  if (view.look != Direction3{}) {
    view = aimed(view, scene);
    span = span_of(view, rays);
    for (int step = 0; to_aim && span && step < 20; ++step) {
      if (in_time) in_time(0, 1);
      const Axes axes = axes_of(view);
      View next = view;
      for (std::size_t k = 0; k < 3; ++k)
        next.look[k] +=
            (span->least[0] + span->half(0)) * axes.right[k] + (span->least[1] + span->half(1)) * axes.up[k];
      next = aimed(next, scene);
      const std::optional<Span> there = span_of(next, rays);
      if (!there) break;
      view = next;
      span = there;
    }
  }
  if (!span) {
    if (to_aim) view.look = {};
    return aimed(view, scene);
  }

  // 3. Height and field: to both sides as much as the longer one needs, since the direction may be given, or the steps
  // have not come to their end.
  std::array<double, 2> half;
  for (std::size_t k = 0; k < 2; ++k) half[k] = std::max(-span->least[k], span->most[k]);
  if (canvas.size.empty() && field == 0 && half[0] > 0)
    view.height = static_cast<int>(std::lround(
        std::clamp(2 * margin + (view.width - 2 * margin) * half[1] / half[0], view.width * 0.4, view.width * 1.0)));
  const double inner_width = std::max(view.width - 2 * margin, view.width * 0.5),
               inner_height = std::max(view.height - 2 * margin, view.height * 0.5),
               a_pixel = std::max(half[0] / inner_width, half[1] / inner_height);  // in tangents, twice
  if (field == 0 && a_pixel > 0) view.field = std::min(150.0, std::atan(a_pixel * view.width) * 360 / 3.14159265358979);
  return view;
}

View aimed(View view, const Scene& scene) {
  if (view.look == Direction3{}) {
    const auto box = scene.box();
    Exact_point centre;
    for (std::size_t k = 0; k < 3; ++k) centre[k] = (box[0][k] + box[1][k]) / 2;
    view.look = towards(centre, view.eye);
    if (view.look == Direction3{}) view.look = {1, 0, 0};
  }
  view.look = unit(view.look);
  Direction3 right = cross(view.look, unit(view.up));
  if (dot(right, right) < 1e-6) view.up = std::fabs(view.look[1]) < 0.9 ? Direction3{0, 1, 0} : Direction3{1, 0, 0};
  return view;
}

std::optional<std::array<Integer, 4>> near_plane(const View& view, const Scene& scene) {
  if (scene.counters().faces == 0) return std::nullopt;
  std::array<Integer, 4> h;
  for (std::size_t k = 0; k < 3; ++k) h[k] = static_cast<long>(std::lround(view.look[k] * 1024));
  const Located_point eye = scene.locate(view.eye);
  Integer reach = 1;
  mpz_mul_2exp(reach.get_mpz_t(), reach.get_mpz_t(), static_cast<mp_bitcnt_t>(scene.points().bits()));
  // h . eye, rounded up, and 1024 times a thousandth of the size.
  Integer at = h[0] * eye.x + h[1] * eye.y + h[2] * eye.z;
  mpz_cdiv_q(at.get_mpz_t(), at.get_mpz_t(), eye.w.get_mpz_t());
  h[3] = -(at + reach + 1);
  for (std::uint32_t p = 0; p < scene.points().size(); ++p)
    if (sgn(Integer(h[0] * scene.points().integer(p, 0) + h[1] * scene.points().integer(p, 1) +
                    h[2] * scene.points().integer(p, 2) + h[3])) <= 0)
      return h;
  return std::nullopt;
}

Axes axes_of(const View& view) {
  const Direction3 right = unit(cross(view.look, unit(view.up)));
  return {right, cross(right, view.look)};
}

static double scale_of(const View& view) { return view.width / 2.0 / std::tan(view.field * 3.14159265358979 / 360); }

std::vector<Exact_point> corner_rays(const View& view) {
  const auto [right, up] = axes_of(view);
  const double across = view.width / 2.0 / scale_of(view), upwards = across * view.height / view.width;
  std::vector<Exact_point> rays;
  for (const auto& [x, y] : {std::pair(-across, upwards), std::pair(across, upwards), std::pair(across, -upwards),
                             std::pair(-across, -upwards)}) {
    Exact_point& ray = rays.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) ray[k] = exact(view.look[k] + x * right[k] + y * up[k]);
  }
  return rays;
}

Flat_point projected(const View& view, const Axes& axes, const Direction3& v) {
  const double scale = scale_of(view), depth = dot(v, view.look);
  return {view.width / 2.0 + scale * dot(v, axes.right) / depth, view.height / 2.0 - scale * dot(v, axes.up) / depth};
}
Flat_point projected(const View& view, const Exact_point& p) {
  return projected(view, axes_of(view), towards(p, view.eye));
}

// ---- Polygons

Svg empty_picture(const View& view) { return {view.width, view.height, view.background}; }

static std::string title_of(const Drawn& item) {
  return fmt::format("face {}{}", item.fragment.face, item.side == CGAL::NEGATIVE ? ", from behind" : "");
}
static double hue_of(Face_id face) { return std::fmod(face * 137.50776405, 360.0); }

/// Degrees, percent, percent.
static std::array<double, 3> hsl_by_face(Face_id face, bool front, double shade) {
  return {hue_of(face), front ? 45.0 : 12.0, (front ? 62 : 55) + 18 * shade};
}

Look look_by_face(const Drawn& item, double shade) {
  const auto [hue, saturation, lightness] = hsl_by_face(item.fragment.face, item.side == CGAL::POSITIVE, shade);
  return {fmt::format("hsl({:.0f},{:.0f}%,{:.0f}%)", hue, saturation, lightness), title_of(item)};
}
std::array<double, 3> colour_by_face(Face_id face, bool front, double shade) {
  const auto [hue, saturation, lightness] = hsl_by_face(face, front, shade);
  const double light = std::clamp(lightness / 100, 0.0, 1.0), spread = saturation / 100 * std::min(light, 1 - light);
  std::array<double, 3> colour;
  for (std::size_t k = 0; k < 3; ++k) {  // CSS Color 4, 7.1
    const double at = std::fmod(std::array<double, 3>{0, 8, 4}[k] + hue / 30, 12);
    colour[k] = 255 * (light - spread * std::max(-1.0, std::min({at - 3, 9 - at, 1.0})));
  }
  return colour;
}
Look pale_look(const Drawn& item, double shade) {
  const bool front = item.side == CGAL::POSITIVE;
  return {
      fmt::format("hsl({:.0f},{}%,{:.0f}%)", hue_of(item.fragment.face), front ? 30 : 6, (front ? 88 : 80) + 7 * shade),
      title_of(item)};
}

/// The unit normal of a polygon, of whatever size: arms from its first corner are scaled before they are multiplied.
/// Degenerate: zero of what is flat, or beyond doubles.
static Direction3 normal_of(const std::vector<Direction3>& corners) {
  std::vector<Direction3> arms;
  double size = 0;
  for (const Direction3& corner : corners) {
    arms.push_back(minus(corner, corners[0]));
    for (const double x : arms.back()) {
      if (!std::isfinite(x)) return {};
      size = std::max(size, std::fabs(x));
    }
  }
  Direction3 normal{};
  if (!(size > 0)) return normal;
  for (Direction3& arm : arms)
    for (double& x : arm) x /= size;
  for (std::size_t i = 2; i < arms.size(); ++i) {
    const Direction3 part = cross(arms[i - 1], arms[i]);
    for (std::size_t k = 0; k < 3; ++k) normal[k] += part[k];
  }
  return unit(normal);
}

static double shade_of(const std::vector<Direction3>& corners) {
  return dot(normal_of(corners), unit({0.3, -0.5, 0.8}));
}
double shade_of(const std::vector<Exact_point>& corners) {
  std::vector<Direction3> arms;
  for (const Exact_point& p : corners) arms.push_back(difference(p, corners[0]));
  return shade_of(arms);
}

void paint(Svg& svg, const View& view, const std::vector<Drawn>& drawn, bool outlines, const Look_of& look) {
  std::map<Face_id, std::size_t> polygons;  // of each face, so far
  const Axes axes = axes_of(view);
  for (const Drawn& item : drawn) {
    std::vector<Flat_point> points;
    std::vector<Direction3> corners;
    for (const Exact_point& p : item.fragment.vertices) {
      corners.push_back(difference(p, view.eye));
      points.push_back(projected(view, axes, towards(p, view.eye, corners.back())));
    }
    const auto [fill, title] = look(item, view.lit ? shade_of(corners) : 0);
    svg.polygon(std::move(points), fill, outlines ? "#00000055" : fill, outlines ? 0.5 : 0.4,
                fmt::format("face-{}-{}", item.fragment.face, ++polygons[item.fragment.face]), title);
  }
}

}  // namespace sightline::app
