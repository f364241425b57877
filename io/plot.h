#pragma once
// Plots with logarithmic axes, as SVG.

#include <sightline/io/svg.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sightline {

/// Series of points by name, joined in the order of x; both axes are logarithmic. Points with y = 0 stand on a line of
/// their own, marked 0, below the others. Pre: words without characters that XML reserves. Degenerate: points with x <=
/// 0 or y < 0, and what is no number, are left out; without points there are only axes. Exact: no, it is a picture.
class Log_plot {
 public:
  Log_plot(std::string title, std::string x, std::string y)
      : title_(std::move(title)), x_(std::move(x)), y_(std::move(y)) {}

  void add(const std::string& series, double x, double y);

  std::string text() const;

 private:
  std::string title_, x_, y_;
  std::map<std::string, std::vector<Flat_point>> series_;
};

}  // namespace sightline
