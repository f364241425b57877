// The picture of a case that is answered wrongly.

#include "picture.h"

#include "../methods/methods.h"

#include <sightline/kernel/vectors.h>

namespace sightline::app {

namespace {

Direction3 near(const Exact_point& p) { return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])}; }
Direction3 unit(const Direction3& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? Direction3{a[0] / length, a[1] / length, a[2] / length} : Direction3{};
}
bool holds(const std::vector<Face_id>& faces, Face_id face) {
  return std::binary_search(faces.begin(), faces.end(), face);
}

/// The box of some points: its middle, and its longest side.
struct Extent {
  Direction3 low, high;

  explicit Extent(const std::vector<Exact_point>& points) : low(near(points.at(0))), high(low) {
    for (const Exact_point& p : points)
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], nearest_double(p[k]));
        high[k] = std::max(high[k], nearest_double(p[k]));
      }
  }
  double size() const {
    const double longest = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    return longest > 0 ? longest : 1;
  }
  Direction3 middle() const { return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2}; }
};

/// A direction across the line that the face in question does not hide behind its edge; `front`: onto its front.
Direction3 best_look(const Direction3& line, const Direction3& normal, bool front = false) {
  Direction3 best{1, 2, -1};
  double most = -1;
  for (const double x : {-2.0, -1.0, 0.3, 1.0, 2.0})
    for (const double y : {-2.0, -1.0, 0.5, 1.0, 2.0})
      for (const double z : {-1.2, -0.7, 0.7}) {
        const Direction3 look = unit({x, y, z});
        const double along = dot(look, line), facing = dot(look, normal);
        const double value = std::sqrt(std::max(0.0, 1 - along * along)) *
                             (0.4 + std::min(0.7, front ? -facing : std::fabs(facing))) *
                             (z < 0 ? 1.1 : 1.0);  // rather from above
        if (value > most) {
          most = value;
          best = look;
        }
      }
  return best;
}

/// From far off, so that all points fill the picture.
View view_of(const std::vector<Exact_point>& points, const Direction3& look) {
  constexpr double far = 30;  // times the size
  const Extent extent(points);
  const Direction3 middle = extent.middle();
  View view;
  view.width = 480;
  view.height = 360;
  view.look = look;
  for (std::size_t k = 0; k < 3; ++k) view.eye[k] = exact(middle[k] - far * extent.size() * look[k]);
  double half = 1e-9;
  const Axes axes = axes_of(view);
  const auto coordinates = [&](const Exact_point& p) {
    const Direction3 v = near(minus(p, view.eye));
    const double depth = dot(v, look);
    return Flat_point{dot(v, axes.right) / depth, dot(v, axes.up) / depth};
  };
  Flat_point low = coordinates(points[0]), high = low;
  for (const Exact_point& p : points)
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], coordinates(p)[k]);
      high[k] = std::max(high[k], coordinates(p)[k]);
    }
  for (std::size_t k = 0; k < 3; ++k)
    view.look[k] += axes.right[k] * (low[0] + high[0]) / 2 + axes.up[k] * (low[1] + high[1]) / 2;
  view.look = unit(view.look);
  const double shape = static_cast<double>(view.width) / view.height;
  half = std::max({half, (high[0] - low[0]) / 2, (high[1] - low[1]) / 2 * shape});
  view.field = 2 * std::atan(1.25 * half) * 180 / 3.14159265358979;
  return view;
}

void dot_at(Svg& svg, const Flat_point& p, double radius, std::string_view colour) {
  std::vector<Flat_point> circle;
  for (int k = 0; k < 16; ++k)
    circle.push_back({p[0] + radius * std::cos(k * 0.392699), p[1] + radius * std::sin(k * 0.392699)});
  svg.polygon(std::move(circle), colour, "#ffffff", 1);
}

/// A line of text that is read on any ground.
void name_at(Svg& svg, const Flat_point& p, const std::string& words) {
  svg.rectangle(p[0] + 6, p[1] - 17, 6.6 * static_cast<double>(words.size()) + 4, 15, "#ffffff");
  svg.label(p[0] + 8, p[1] - 6, 12, words);
}

/// The line that refutes an answer, or where one looks from, as the picture has it: what is far off stands nearer.
struct Shown_line {
  Exact_point from, to;
  Direction3 along;  // from `to` to where `from` is indeed
  bool is_far;

  Shown_line(const std::vector<Exact_point>& points, const judge::Query& query, const judge::Explanation& why)
      : from(query.question == judge::Question::weak      ? query.source.at(0)
             : query.question == judge::Question::boolean ? points[0]
                                                          : query.eye),
        to(points[0]) {
    if (why.refutation) {
      from = why.refutation->from;
      to = why.refutation->to;
    }
    along = near(minus(from, to));
    const double size = Extent(points).size(), distance = std::sqrt(dot(along, along));
    is_far = distance > 4 * size;
    if (is_far)
      for (std::size_t k = 0; k < 3; ++k) from[k] = to[k] + exact(along[k] / distance * 3 * size);
  }
};

/// The normal of a face that is refuted; upwards where there is none.
Direction3 normal_of_refuted(const Scene& scene, const judge::Explanation& why) {
  Direction3 normal{0, 0, 1};
  for (const Piece& piece : scene.pieces()) {
    if (!why.refutation || piece.face != why.refutation->face) continue;
    const auto corners = scene.corners(piece);
    const Exact_point p = scene.position(corners[0].point);
    normal = unit(near(cross(minus(scene.position(corners[1].point), p), minus(scene.position(corners[2].point), p))));
  }
  return normal;
}

/// How faces look by what the answer makes of them. `source`: the number of the source, where it is one of them.
Look look_of(Face_id face, const std::optional<Face_id>& source, const judge::Grade& grade,
             const judge::Explanation& why, double shade) {
  struct Kind {
    std::string_view title;
    int hue, strength, light;
    double opacity;
  };
  const auto [title, hue, strength, light, opacity] =
      face == source                                 ? Kind{"the source", 50, 85, 60, 0.9}
      : holds(grade.wrong_hidden, face)              ? Kind{"left out", 20, 90, 58, 0.6}
      : holds(grade.wrong_visible, face)             ? Kind{"shown wrongly", 285, 60, 62, 0.6}
      : why.refutation && why.refutation->by == face ? Kind{"in the way", 205, 55, 58, 0.55}
                                                     : Kind{"", 140, 12, 72, 0.45};
  return {fmt::format("hsla({},{}%,{:.0f}%,{})", hue, strength, light + 12 * shade, opacity),
          face == source  ? std::string(title)
          : title.empty() ? fmt::format("face {}", face)
                          : fmt::format("face {}: {}", face, title)};
}

/// The line that refutes, with names; or else the eye, where there is one.
void draw_line(Svg& svg, const View& view, const Shown_line& line, const judge::Query& query,
               const judge::Explanation& why) {
  const bool weak = query.question == judge::Question::weak, solids = query.question == judge::Question::boolean;
  const Flat_point p = projected(view, line.from);
  constexpr std::string_view red = "#c01818";
  if (!why.refutation) {
    if (!weak && !solids && query.question != judge::Question::trace) dot_at(svg, p, 4.5, "#202020");
    return;
  }
  const Flat_point q = projected(view, line.to);
  if (why.refutation->at) {
    const Flat_point at = projected(view, *why.refutation->at);
    svg.line(p, at, red, 2);
    svg.line(at, q, red, 1.5, true);
    dot_at(svg, at, 4, red);
    name_at(svg, at, fmt::format("face {}", *why.refutation->by));
  } else {
    svg.line(p, q, red, 2);
  }
  dot_at(svg, p, 4.5, "#202020");
  dot_at(svg, q, 4, red);
  const std::string looker = solids ? "point" : query.question == judge::Question::trace ? "origin" : "eye";
  name_at(svg, p, weak ? "source" : line.is_far ? looker + ", farther" : looker);
  name_at(svg, q, fmt::format("face {}", why.refutation->face));
}

/// What the colours mean that are there, in a line at the bottom.
void draw_key(Svg& svg, const judge::Query& query, const judge::Grade& grade, const judge::Explanation& why,
              const Wrong_words& names) {
  double x = 8;
  const auto key = [&](std::string_view colour, std::string_view words) {
    svg.rectangle(x, 344, 10, 10, colour);
    svg.label(x + 14, 353, 11, words);
    x += 26 + 5.8 * static_cast<double>(words.size());
  };
  if (!grade.wrong_hidden.empty()) key("hsl(20,90%,58%)", names.hidden);
  if (!grade.wrong_visible.empty()) key("hsl(285,60%,62%)", names.visible);
  if (why.refutation && why.refutation->by) key("hsl(205,55%,58%)", "in the way");
  if (query.question == judge::Question::weak) key("hsl(50,85%,60%)", "source");
  if (grade.wrong()) key("hsl(140,12%,72%)", "right");
}

}  // namespace

std::array<double, 3> look_at_front(const Scene& scene, const judge::Explanation& why) {
  const judge::Refutation& line = why.refutation.value();
  return best_look(unit(near(minus(line.from, line.to))), normal_of_refuted(scene, why), true);
}

Wrong_words words_of_wrong(judge::Question question) {
  switch (question) {
    case judge::Question::order: return {"nearer, or missing", "drawn over it"};
    case judge::Question::trace: return {"met, but not named", "named, but not met first"};
    case judge::Question::boolean: return {"lacks what is beside", "holds what is beside"};
    case judge::Question::see:
    case judge::Question::weak: break;
  }
  return {"missing but visible", "shown but hidden"};
}

std::string picture_of(const Polygon_soup& soup, const judge::Query& query, const judge::Grade& grade,
                       const judge::Explanation& why, const Wrong_words& words) {
  const bool weak = query.question == judge::Question::weak;
  std::vector<Exact_point> points;
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (const Point_id p : soup.loop(f)) points.push_back(soup.point(p));
  if (points.empty()) return {};

  // 1. The line that refutes; an eye that is far from the scene stays outside of the picture.
  const Shown_line line(points, query, why);
  points.push_back(line.from);
  if (weak) points.insert(points.end(), query.source.begin(), query.source.end());

  // 2. Faces, and the source as one of them, as a painter paints them from far off.
  Polygon_soup all = soup;
  std::optional<Face_id> source;
  if (weak) {
    source = static_cast<Face_id>(soup.face_count());
    std::vector<Point_id> loop;
    for (const Exact_point& p : query.source) loop.push_back(all.add_point(p[0], p[1], p[2]));
    all.add_face(loop);
  }
  Scene scene(all);
  const View view = view_of(points, best_look(unit(line.along), normal_of_refuted(scene, why)));
  Task task;
  task.eye = view.eye;
  Svg svg = empty_picture(view);
  paint(svg, view, run_method("exact", scene, task).drawn, true,
        [&](const Drawn& item, double shade) { return look_of(item.fragment.face, source, grade, why, shade); });

  // 3. The source's outline, which may be that of a face; the line over all.
  for (std::size_t k = 0; weak && k < query.source.size(); ++k)
    svg.line(projected(view, query.source[k]), projected(view, query.source[(k + 1) % query.source.size()]), "#c09000",
             2);
  draw_line(svg, view, line, query, why);
  draw_key(svg, query, grade, why, words);
  return svg.text();
}

}  // namespace sightline::app
