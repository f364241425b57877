#pragma once
// Flat pictures as SVG.

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace sightline {

using Flat_point = std::array<double, 2>;  ///< x to the right, y downwards, in pixels

/// An SVG picture that is drawn as a painter draws: later shapes cover earlier ones. Coordinates are rounded to
/// hundredths of a pixel; polygons are clipped to the frame, so that what is far outside it does no harm. Exact: no, it
/// is a picture.
class Svg {
 public:
  Svg(int width, int height, std::string_view background = "#ffffff") : width_(width), height_(height) {
    body_ = "<rect width=\"100%\" height=\"100%\" fill=\"" + std::string(background) + "\"/>\n";
  }

  /// A filled convex polygon with a thin outline. Degenerate: what lies outside the frame, or has coordinates that are
  /// no numbers, is left out.
  void polygon(std::vector<Flat_point> points, std::string_view fill, std::string_view stroke, double stroke_width) {
    for (const Flat_point& p : points)
      if (!std::isfinite(p[0]) || !std::isfinite(p[1])) return;
    points = clipped(std::move(points));
    if (points.size() < 3) return;
    body_ += "<polygon points=\"";
    for (const Flat_point& p : points) body_ += number(p[0]) + ',' + number(p[1]) + ' ';
    body_.back() = '"';
    body_ += " fill=\"" + std::string(fill) + "\" stroke=\"" + std::string(stroke) + "\" stroke-width=\"" +
             number(stroke_width) + "\"/>\n";
  }

  /// A filled rectangle without an outline, its edges sharp. Pre: finite numbers.
  void rectangle(double x, double y, double width, double height, std::string_view fill) {
    body_ += "<rect x=\"" + number(x) + "\" y=\"" + number(y) + "\" width=\"" + number(width) + "\" height=\"" +
             number(height) + "\" fill=\"" + std::string(fill) + "\" shape-rendering=\"crispEdges\"/>\n";
  }
  /// A straight line with round ends, dashed or not. Degenerate: with coordinates that are no numbers, or that an SVG
  /// has no room for, it is left out.
  void line(const Flat_point& from, const Flat_point& to, std::string_view stroke, double stroke_width,
            bool dashed = false) {
    for (const Flat_point& p : {from, to})
      if (!(std::fabs(p[0]) < 1e6 && std::fabs(p[1]) < 1e6)) return;
    body_ += "<line x1=\"" + number(from[0]) + "\" y1=\"" + number(from[1]) + "\" x2=\"" + number(to[0]) + "\" y2=\"" +
             number(to[1]) + "\" stroke=\"" + std::string(stroke) + "\" stroke-width=\"" + number(stroke_width) +
             (dashed ? "\" stroke-dasharray=\"3 3" : "") + "\" stroke-linecap=\"round\"/>\n";
  }
  /// A line of text that begins at a place, or has it as its middle or end ("start", "middle", "end"). Pre: no
  /// character that XML reserves.
  void label(double x, double y, double size, std::string_view words, std::string_view anchor = "start") {
    body_ += "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" font-family=\"sans-serif\" font-size=\"" +
             number(size) + "\"";
    if (anchor != "start") body_ += " text-anchor=\"" + std::string(anchor) + '"';
    body_ += '>' + std::string(words) + "</text>\n";
  }

  std::string text() const {
    const std::string w = std::to_string(width_), h = std::to_string(height_);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w +
           ' ' + h + "\" stroke-linejoin=\"round\">\n" + body_ + "</svg>\n";
  }

 private:
  static std::string number(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", x);
    std::string s = text;
    s.erase(s.find_last_not_of('0') + 1);
    if (s.back() == '.') s.pop_back();
    return s == "-0" ? "0" : s;
  }
  /// Sutherland and Hodgman, with a margin so that no outline of the frame shows.
  std::vector<Flat_point> clipped(std::vector<Flat_point> points) const {
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

  int width_, height_;
  std::string body_;
};

}  // namespace sightline
