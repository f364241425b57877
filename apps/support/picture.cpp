#include "picture.h"

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

static Direction3 parse_direction(const std::string& text, const std::string& option) {
  const Exact_point p = parse_point(text, option);
  const Direction3 direction{nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
  for (const double x : direction)
    if (!std::isfinite(x)) throw Usage_error(option + " wants a direction in the range of doubles");
  if (direction == Direction3{}) throw Usage_error(option + " wants a direction that is not 0,0,0");
  return direction;
}

void View_arguments::add_to(Command command) {
  command.add_option("--look", look, "direction X,Y,Z of the picture; by default to the centre of the scene");
  command.add_option("--up", up, "up direction X,Y,Z of the picture (0,0,1)");
  command.add_option("--field", field, "width of the picture's view in degrees")
      .check(range(1.0, 170.0) & finite_number())
      .show_default();
}

View View_arguments::view(const Exact_point& eye, const Scene& scene) const {
  View view{eye};
  if (!look.empty()) view.look = parse_direction(look, "--look");
  if (!up.empty()) view.up = parse_direction(up, "--up");
  view.field = field;
  return scene.counters().faces > 0 ? aimed(view, scene) : view;
}

View aimed(View view, const Scene& scene) {
  if (view.look == Direction3{}) {
    const auto box = scene.box();
    Exact_point centre;
    for (std::size_t k = 0; k < 3; ++k) centre[k] = (box[0][k] + box[1][k]) / 2;
    view.look = difference(centre, view.eye);
    if (view.look == Direction3{}) view.look = {1, 0, 0};
  }
  view.look = unit(view.look);
  Direction3 right = cross(view.look, unit(view.up));
  if (dot(right, right) < 1e-6) view.up = std::fabs(view.look[1]) < 0.9 ? Direction3{0, 1, 0} : Direction3{1, 0, 0};
  return view;
}

std::optional<std::array<Integer, 4>> near_plane(const View& view, const Scene& scene) {
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

static Flat_point projected(const View& view, const Axes& axes, const Direction3& v) {
  const double scale = scale_of(view), depth = dot(v, view.look);
  return {view.width / 2.0 + scale * dot(v, axes.right) / depth, view.height / 2.0 - scale * dot(v, axes.up) / depth};
}
Flat_point projected(const View& view, const Exact_point& p) {
  return projected(view, axes_of(view), difference(p, view.eye));
}

Svg empty_picture(const View& view) { return {view.width, view.height, "#f4f3ef"}; }

std::string colour_by_face(const Drawn& item, double shade) {
  const bool front = item.side == CGAL::POSITIVE;
  return fmt::format("hsl({:.0f},{}%,{:.0f}%)", std::fmod(item.fragment.face * 137.50776405, 360.0), front ? 45 : 12,
                     (front ? 62 : 55) + 18 * shade);
}

void paint(Svg& svg, const View& view, const std::vector<Drawn>& drawn, bool outlines, const Colour& colour) {
  const Direction3 light = unit({0.3, -0.5, 0.8});
  const Axes axes = axes_of(view);
  for (const Drawn& item : drawn) {
    std::vector<Flat_point> points;
    std::vector<Direction3> corners;
    for (const Exact_point& p : item.fragment.vertices) {
      corners.push_back(difference(p, view.eye));
      points.push_back(projected(view, axes, corners.back()));
    }
    Direction3 normal{};
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const auto arm = [&](std::size_t k) {
        return Direction3{corners[k][0] - corners[0][0], corners[k][1] - corners[0][1], corners[k][2] - corners[0][2]};
      };
      const Direction3 part = cross(arm(i - 1), arm(i));
      for (std::size_t k = 0; k < 3; ++k) normal[k] += part[k];
    }
    const std::string fill = colour(item, dot(unit(normal), light));
    svg.polygon(std::move(points), fill, outlines ? "#00000055" : fill, outlines ? 0.5 : 0.4);
  }
}

}  // namespace sightline::app
