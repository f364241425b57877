#include <sightline/io/svg.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace sightline {

void Svg::polygon(std::vector<Flat_point> points, std::string_view fill, std::string_view stroke, double stroke_width,
                  std::string_view id, std::string_view title) {
  for (const Flat_point& p : points)
    if (!std::isfinite(p[0]) || !std::isfinite(p[1])) return;
  points = clipped(std::move(points));
  if (points.size() < 3) return;
  body_ += "<polygon ";
  if (!id.empty()) body_ += "id=\"" + std::string(id) + "\" ";
  body_ += "points=\"";
  for (const Flat_point& p : points) body_ += number(p[0]) + ',' + number(p[1]) + ' ';
  body_.back() = '"';
  body_ += " fill=\"" + std::string(fill) + "\" stroke=\"" + std::string(stroke) + "\" stroke-width=\"" +
           number(stroke_width) +
           (title.empty() ? "\"/>\n" : "\"><title>" + std::string(title) + "</title></polygon>\n");
}

namespace {

/// "Mx,y x,y ...", each place once in a row; empty where fewer than so many are left.
std::string chain_of(std::vector<std::string> places, std::size_t least) {
  places.erase(std::unique(places.begin(), places.end()), places.end());
  if (places.size() < least) return {};
  std::string path;
  for (std::size_t k = 0; k < places.size(); ++k) path += (k == 0 ? 'M' : ' ') + places[k];
  return path;
}

}  // namespace

std::string Svg::path_of(const std::vector<std::vector<Flat_point>>& polygons) const {
  using Place = std::array<long, 2>;  // in hundredths of a pixel
  // With its sign where it is negative, which parts it from a number before it, or with what parts them else.
  const auto add = [](std::string& path, long hundredths, const char* parting) {
    path += hundredths < 0 ? "-" : parting;
    const long size = std::labs(hundredths), whole = size / 100, rest = size % 100;
    if (whole > 0 || rest == 0) path += std::to_string(whole);
    if (rest == 0) return;
    path += '.';
    path += static_cast<char>('0' + rest / 10);
    if (rest % 10 > 0) path += static_cast<char>('0' + rest % 10);
  };
  std::string path;
  for (const std::vector<Flat_point>& polygon : polygons) {
    if (std::any_of(polygon.begin(), polygon.end(),
                    [](const Flat_point& p) { return !std::isfinite(p[0]) || !std::isfinite(p[1]); }))
      continue;
    // A corner is rounded alike wherever it stands; what that leaves without a width is left out.
    std::vector<Place> places;
    for (const Flat_point& p : clipped(polygon)) places.push_back({std::lround(100 * p[0]), std::lround(100 * p[1])});
    places.erase(std::unique(places.begin(), places.end()), places.end());
    while (places.size() > 1 && places.front() == places.back()) places.pop_back();
    if (places.size() < 3) continue;
    path += 'M';
    add(path, places[0][0], "");
    add(path, places[0][1], ",");
    for (std::size_t k = 1; k < places.size(); ++k) {  // by steps, which are short
      if (k == 1) path += 'l';
      add(path, places[k][0] - places[k - 1][0], k == 1 ? "" : " ");
      add(path, places[k][1] - places[k - 1][1], ",");
    }
    path += 'z';
  }
  return path;
}

void Svg::shape(const std::vector<std::vector<Flat_point>>& polygons, std::string_view fill) {
  const std::string path = path_of(polygons);
  if (!path.empty()) body_ += "<path d=\"" + path + "\" fill=\"" + std::string(fill) + "\"/>\n";
}

void Svg::shape(const std::vector<std::vector<Flat_point>>& polygons, std::string_view fill, std::string_view stroke,
                double stroke_width, std::string_view id, std::string_view title) {
  const std::string path = path_of(polygons);
  if (path.empty()) return;
  body_ += "<path ";
  if (!id.empty()) body_ += "id=\"" + std::string(id) + "\" ";
  body_ += "d=\"" + path + "\" fill=\"" + std::string(fill) + "\" stroke=\"" + std::string(stroke) +
           "\" stroke-width=\"" + number(stroke_width) +
           (title.empty() ? "\"/>\n" : "\"><title>" + std::string(title) + "</title></path>\n");
}

void Svg::chains(const std::vector<std::vector<Flat_point>>& lines, std::string_view stroke, double stroke_width) {
  std::string path;
  for (const std::vector<Flat_point>& line : lines) {
    if (!std::all_of(line.begin(), line.end(),
                     [](const Flat_point& p) { return std::fabs(p[0]) < 1e6 && std::fabs(p[1]) < 1e6; }))
      continue;
    std::vector<std::string> places;
    for (const Flat_point& p : line) places.push_back(number(p[0]) + ',' + number(p[1]));
    path += chain_of(std::move(places), 2);
  }
  if (!path.empty())
    body_ += "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + std::string(stroke) + "\" stroke-width=\"" +
             number(stroke_width) + "\" stroke-linecap=\"round\"/>\n";
}

void Svg::rectangle(double x, double y, double width, double height, std::string_view fill) {
  body_ += "<rect x=\"" + number(x) + "\" y=\"" + number(y) + "\" width=\"" + number(width) + "\" height=\"" +
           number(height) + "\" fill=\"" + std::string(fill) + "\" shape-rendering=\"crispEdges\"/>\n";
}

void Svg::line(const Flat_point& from, const Flat_point& to, std::string_view stroke, double stroke_width,
               bool dashed) {
  for (const Flat_point& p : {from, to})
    if (!(std::fabs(p[0]) < 1e6 && std::fabs(p[1]) < 1e6)) return;
  body_ += "<line x1=\"" + number(from[0]) + "\" y1=\"" + number(from[1]) + "\" x2=\"" + number(to[0]) + "\" y2=\"" +
           number(to[1]) + "\" stroke=\"" + std::string(stroke) + "\" stroke-width=\"" + number(stroke_width) +
           (dashed ? "\" stroke-dasharray=\"3 3" : "") + "\" stroke-linecap=\"round\"/>\n";
}

void Svg::label(double x, double y, double size, std::string_view words, std::string_view anchor,
                std::string_view fill) {
  body_ += "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" font-family=\"sans-serif\" font-size=\"" +
           number(size) + "\"";
  if (fill != "#000000") body_ += " fill=\"" + std::string(fill) + '"';
  if (anchor != "start") body_ += " text-anchor=\"" + std::string(anchor) + '"';
  body_ += '>' + std::string(words) + "</text>\n";
}

std::string Svg::text() const {
  const std::string w = std::to_string(width_), h = std::to_string(height_);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w + ' ' +
         h + "\" stroke-linejoin=\"round\">\n" + body_ + "</svg>\n";
}

std::string Svg::number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", x);
  std::string s = text;
  s.erase(s.find_last_not_of('0') + 1);
  if (s.back() == '.') s.pop_back();
  return s == "-0" ? "0" : s;
}

std::vector<Flat_point> Svg::clipped(std::vector<Flat_point> points) const {
  constexpr double margin = 10;
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}})
    for (const double sense : {1.0, -1.0}) {
      const double limit = sense > 0 ? -margin : -((axis == 0 ? width_ : height_) + margin);
      const auto inside = [&](const Flat_point& p) { return sense * p[axis] - limit; };
      std::vector<Flat_point> kept;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Flat_point &p = points[i], &q = points[(i + 1) % points.size()];
        const double a = inside(p), b = inside(q);
        if (a >= 0) kept.push_back(p);
        if ((a < 0) != (b < 0))
          kept.push_back({p[0] + (q[0] - p[0]) * (a / (a - b)), p[1] + (q[1] - p[1]) * (a / (a - b))});
      }
      points = std::move(kept);
    }
  return points;
}

}  // namespace sightline
