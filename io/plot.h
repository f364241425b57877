#pragma once
// Plots with logarithmic axes, as SVG.

#include <sightline/io/svg.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sightline {

/// Series of points by name, joined in the order of x; both axes are logarithmic. Points with y = 0 stand on a line of
/// their own, marked 0, below the others. A series has the colour that was set for it, or else one that follows from
/// its name, so that it keeps it from plot to plot; where two names of a plot share theirs, the later one in order of
/// the alphabet takes the next that is free. Pre: words without characters that XML reserves. Degenerate: points with x
/// <= 0 or y < 0, and what is no number, are left out; without points there are only axes. Exact: no, it is a picture.
class Log_plot {
 public:
  Log_plot(std::string title, std::string x, std::string y)
      : title_(std::move(title)), x_(std::move(x)), y_(std::move(y)) {}

  void add(const std::string& series, double x, double y);
  /// A colour that SVG knows, for all points of a series.
  void set_colour(const std::string& series, const std::string& colour) { colours_[series] = colour; }
  void set_canvas(int width, int height, const std::string& background, const std::string& ink);

  std::string text() const;

 private:
  /// Of all series that have points.
  std::map<std::string, std::string> colours() const;

  std::string title_, x_, y_;
  int width_ = 860, height_ = 560;
  std::string background_ = "#ffffff", ink_ = "#000000";
  std::map<std::string, std::string> colours_;
  std::map<std::string, std::vector<Flat_point>> series_;
};

}  // namespace sightline
