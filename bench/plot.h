#pragma once
// Line plots with logarithmic axes, as SVG.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace bench {

/// Series of points by name, drawn with both axes logarithmic. Values that are not positive are left out.
class Plot {
 public:
  Plot(std::string title, std::string x, std::string y) : title_(std::move(title)), x_(std::move(x)), y_(std::move(y)) {}
  void add(const std::string& series, double x, double y) {
    if (x > 0 && y > 0) points_[series].push_back({x, y});
  }
  void write(const std::string& path) const {
    double low[2] = {1e300, 1e300}, high[2] = {0, 0};
    for (const auto& [name, list] : points_)
      for (const auto& p : list)
        for (int k = 0; k < 2; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    if (points_.empty()) return;
    for (int k = 0; k < 2; ++k) low[k] = std::floor(std::log10(low[k])), high[k] = std::max(low[k] + 1, std::ceil(std::log10(high[k])));
    constexpr double width = 860, height = 560, left = 80, right = 200, top = 50, bottom = 60;
    const auto place = [&](double x, double y) {
      return std::array<double, 2>{left + (std::log10(x) - low[0]) / (high[0] - low[0]) * (width - left - right),
                                   height - bottom - (std::log10(y) - low[1]) / (high[1] - low[1]) * (height - top - bottom)};
    };
    std::string s = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" font-family=\"sans-serif\" font-size=\"12\">\n"
                                "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n<text x=\"{2}\" y=\"28\" font-size=\"16\">{3}</text>\n", width, height, left, title_);
    for (double e = low[0]; e <= high[0]; ++e) {
      const auto p = place(std::pow(10, e), std::pow(10, low[1]));
      s += fmt::format("<path d=\"M{0:.1f} {1}V{2}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">1e{4:.0f}</text>\n", p[0], top, height - bottom, height - bottom + 18, e);
    }
    for (double e = low[1]; e <= high[1]; ++e) {
      const auto p = place(std::pow(10, low[0]), std::pow(10, e));
      s += fmt::format("<path d=\"M{0} {1:.1f}H{2}\" stroke=\"#ddd\"/><text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">1e{5:.0f}</text>\n", left, p[1], width - right, left - 8, p[1] + 4, e);
    }
    s += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", (left + width - right) / 2, height - 18, x_);
    s += fmt::format("<text transform=\"translate(20 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n", height / 2, y_);
    int index = 0;
    for (const auto& [name, unsorted] : points_) {
      auto list = unsorted;
      std::sort(list.begin(), list.end());
      const std::string colour = fmt::format("hsl({:.0f},65%,{}%)", std::fmod(index * 137.508, 360), index % 2 ? 45 : 38);
      s += "<path fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"1.8\" d=\"";
      for (std::size_t i = 0; i < list.size(); ++i) {
        const auto p = place(list[i][0], list[i][1]);
        s += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", p[0], p[1]);
      }
      s += "\"/>\n";
      for (const auto& q : list) {
        const auto p = place(q[0], q[1]);
        s += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>", p[0], p[1], colour);
      }
      s += fmt::format("\n<rect x=\"{}\" y=\"{}\" width=\"14\" height=\"4\" fill=\"{}\"/><text x=\"{}\" y=\"{}\">{}</text>\n", width - right + 12, top + 20 * index, colour, width - right + 32,
                       top + 20 * index + 6, name);
      ++index;
    }
    std::ofstream(path) << s << "</svg>\n";
  }

 private:
  std::string title_, x_, y_;
  std::map<std::string, std::vector<std::array<double, 2>>> points_;
};

}  // namespace bench
