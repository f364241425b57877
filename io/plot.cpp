#include <sightline/io/plot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string_view>

namespace sightline {

void Log_plot::add(const std::string& series, double x, double y) {
  if (x > 0 && y >= 0 && std::isfinite(x) && std::isfinite(y)) series_[series].push_back({x, y});
}

void Log_plot::set_canvas(int width, int height, const std::string& background, const std::string& ink) {
  width_ = width;
  height_ = height;
  background_ = background;
  ink_ = ink;
}

/// Twelve that differ in hue or are light and dark of one hue.
static constexpr std::array<const char*, 12> palette{"#1f5fa8", "#d1620b", "#2f8f3a", "#b3262e", "#7a4fb0", "#7d5546",
                                                     "#c9519f", "#6b6b6b", "#9a9420", "#1fa3b5", "#0d2f57", "#5a1616"};

std::map<std::string, std::string> Log_plot::colours() const {
  std::map<std::string, std::string> result;
  std::set<std::string> used;
  for (const auto& [series, colour] : colours_)
    if (series_.contains(series)) used.insert(result[series] = colour);
  for (const auto& [series, points] : series_) {
    if (result.contains(series)) continue;
    std::uint32_t hash = 0;
    for (const char c : series) hash = 131 * hash + static_cast<unsigned char>(c);
    std::size_t place = hash % palette.size();
    for (std::size_t step = 0; step < palette.size() && used.contains(palette[place]); ++step)
      place = (place + 1) % palette.size();
    used.insert(result[series] = palette[place]);
  }
  return result;
}

std::string Log_plot::text() const {
  const double left = 70, right = width_ - 200, top = 70, bottom = height_ - 55, zero_row = 28;
  // 1. Whole decades that hold all points.
  std::array<std::array<double, 2>, 2> range{{{1e300, 0}, {1e300, 0}}};
  bool zeros = false;
  for (const auto& [name, points] : series_)
    for (const Flat_point& p : points)
      for (std::size_t k = 0; k < 2; ++k) {
        zeros = zeros || p[k] == 0;
        if (p[k] > 0) range[k] = {std::min(range[k][0], p[k]), std::max(range[k][1], p[k])};
      }
  for (auto& [low, high] : range) {
    low = high > 0 ? std::floor(std::log10(low)) : 0;
    high = high > 0 ? std::max(low + 1, std::ceil(std::log10(high))) : 1;
  }
  const double floor = zeros ? bottom - zero_row : bottom;  // where the lowest decade begins
  const auto place = [&](const Flat_point& p) {
    const auto share = [&](std::size_t k) { return (std::log10(p[k]) - range[k][0]) / (range[k][1] - range[k][0]); };
    return Flat_point{left + share(0) * (right - left), p[1] == 0 ? bottom : floor - share(1) * (floor - top)};
  };

  // 2. Axes.
  Svg svg(width_, height_, background_);
  const auto write = [&](double x, double y, double size, std::string_view words, std::string_view anchor = "start") {
    svg.label(x, y, size, words, anchor, ink_);
  };
  const std::string grey = "#dddddd";
  const auto decade = [](double exponent) { return "1e" + std::to_string(static_cast<int>(exponent)); };
  for (double e = range[0][0]; e <= range[0][1]; ++e) {
    const double x = place({std::pow(10, e), 0})[0];
    svg.line({x, top}, {x, bottom}, grey, 1);
    write(x, bottom + 18, 12, decade(e), "middle");
  }
  for (double e = range[1][0]; e <= range[1][1]; ++e) {
    const double y = place({1, std::pow(10, e)})[1];
    svg.line({left, y}, {right, y}, grey, 1);
    write(left - 8, y + 4, 12, decade(e), "end");
  }
  if (zeros) {
    svg.line({left, bottom}, {right, bottom}, grey, 1);
    write(left - 8, bottom + 4, 12, "0", "end");
  }
  write(left, 26, 16, title_);
  write(left, top - 14, 12, y_);
  write((left + right) / 2, height_ - 14, 12, x_, "middle");

  // 3. Series, with their names beside them.
  int number = 0;
  const std::map<std::string, std::string> colour_of = colours();
  for (const auto& [name, unsorted] : series_) {
    std::vector<Flat_point> points = unsorted;
    std::sort(points.begin(), points.end());
    const std::string& colour = colour_of.at(name);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Flat_point at = place(points[i]);
      if (i > 0) svg.line(place(points[i - 1]), at, colour, 1.8);
      svg.line(at, at, colour, 7);  // round ends: a dot
    }
    const double y = top + 20 * number++;
    svg.line({right + 14, y}, {right + 26, y}, colour, 4);
    write(right + 34, y + 4, 12, name);
  }
  return svg.text();
}

}  // namespace sightline
