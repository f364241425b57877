#pragma once
// Flat pictures as SVG.

#include <array>
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

  /// A filled convex polygon with a thin outline; with an id, which no other shape has, and a title, which browsers
  /// show under the pointer, unless they are empty. Pre: as label(). Degenerate: what lies outside the frame, or has
  /// coordinates that are no numbers, is left out.
  void polygon(std::vector<Flat_point> points, std::string_view fill, std::string_view stroke, double stroke_width,
               std::string_view id = {}, std::string_view title = {});

  /// Polygons that run round in one sense, filled as one shape without an outline: where they touch, nothing shows
  /// between them. Degenerate: as polygon().
  void shape(const std::vector<std::vector<Flat_point>>& polygons, std::string_view fill);
  /// The same with an outline, an id and a title, as polygon() has them: what is many polygons and looks alike.
  void shape(const std::vector<std::vector<Flat_point>>& polygons, std::string_view fill, std::string_view stroke,
             double stroke_width, std::string_view id, std::string_view title);
  /// Chains of straight lines, as one. Degenerate: a chain is left out as line() is.
  void chains(const std::vector<std::vector<Flat_point>>& lines, std::string_view stroke, double stroke_width);

  /// A filled rectangle without an outline, its edges sharp. Pre: finite numbers.
  void rectangle(double x, double y, double width, double height, std::string_view fill);
  /// A straight line with round ends, dashed or not. Degenerate: with coordinates that are no numbers, or that an SVG
  /// has no room for, it is left out.
  void line(const Flat_point& from, const Flat_point& to, std::string_view stroke, double stroke_width,
            bool dashed = false);
  /// A line of text that begins at a place, or has it as its middle or end ("start", "middle", "end"). Pre: no
  /// character that XML reserves.
  void label(double x, double y, double size, std::string_view words, std::string_view anchor = "start",
             std::string_view fill = "#000000");

  std::string text() const;

 private:
  static std::string number(double x);
  std::string path_of(const std::vector<std::vector<Flat_point>>& polygons) const;
  /// Sutherland and Hodgman, with a margin so that no outline of the frame shows.
  std::vector<Flat_point> clipped(std::vector<Flat_point> points) const;

  int width_, height_;
  std::string body_;
};

}  // namespace sightline
