#include <sightline/harness/report/picture.h>

#include <sightline/io/svg.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace sightline::report {

namespace {

constexpr int panel_width = 560, height = 470;

std::string colour_of(const std::string& kernel) {
  static const std::map<std::string, std::string> colours{{"exact", "#0072b2"},  {"epeck", "#3f9fd6"},
                                                          {"gmpq", "#008a63"},   {"epick", "#b55a92"},
                                                          {"double", "#c98500"}, {"float", "#c94f00"}};
  const auto found = colours.find(kernel);
  return found == colours.end() ? "#202020" : found->second;
}

/// A shape for each method: polygons and stars.
std::vector<Flat_point> mark(std::size_t shape, const Flat_point& at, double radius) {
  static constexpr struct {
    int corners;
    double inner, turn;  // inner: of a star, else 0
  } shapes[] = {{16, 0, 0},     {4, 0, 0.5},  {3, 0, 0}, {4, 0, 0},      {3, 0, 0.5},  {5, 0.45, 0},
                {5, 0, 0},      {4, 0.35, 0}, {6, 0, 0}, {4, 0.35, 0.5}, {3, 0.35, 0}, {6, 0.5, 0},
                {3, 0.35, 0.5}, {8, 0.6, 0},  {7, 0, 0}, {8, 0, 0}};
  const auto& [corners, inner, turn] = shapes[shape % std::size(shapes)];
  std::vector<Flat_point> points;
  const int steps = inner > 0 ? 2 * corners : corners;
  for (int k = 0; k < steps; ++k) {
    const double angle =
        2 * std::numbers::pi * (k / static_cast<double>(steps) + turn / corners) - std::numbers::pi / 2;
    const double r = inner > 0 && k % 2 == 1 ? inner * radius : radius;
    points.push_back({at[0] + r * std::cos(angle), at[1] + r * std::sin(angle)});
  }
  return points;
}

/// Without what XML reserves.
std::string plain(std::string words) {
  for (char& c : words)
    if (c == '<' || c == '>' || c == '&' || c == '"') c = ' ';
  return words;
}

struct Panel_point {
  std::size_t size;
  double seconds, error;
};

/// A question's contenders, and a point for each size.
struct Panel {
  Question question;
  std::vector<Contender> who;
  std::vector<std::vector<Panel_point>> points;
  std::vector<std::string> methods;

  Panel(const Report& report, const Question& asked) : question(asked) {
    std::vector<std::size_t> sizes;
    for (const Row& row : report.rows) sizes.push_back(row.size);
    std::sort(sizes.begin(), sizes.end());
    sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    for (const std::size_t size : sizes) {
      std::vector<Row> rows;
      for (const Row& row : report.rows)
        if (row.who.question == asked.name && row.size == size) rows.push_back(row);
      for (const Summary& s : summaries(rows)) {
        if (!s.seconds) continue;
        const auto found = std::find(who.begin(), who.end(), s.who);
        const auto place = static_cast<std::size_t>(found - who.begin());
        if (found == who.end()) {
          who.push_back(s.who);
          points.emplace_back();
          if (std::find(methods.begin(), methods.end(), s.who.method) == methods.end()) methods.push_back(s.who.method);
        }
        points[place].push_back({size, *s.seconds, s.error});
      }
    }
  }
  std::size_t shape(std::size_t contender) const {
    return static_cast<std::size_t>(std::find(methods.begin(), methods.end(), who[contender].method) - methods.begin());
  }
};

std::string power_name(int e) {
  if (e < -3) return std::to_string(static_cast<int>(std::lround(std::pow(10, e + 6)))) + " us";
  if (e < 0) return std::to_string(static_cast<int>(std::lround(std::pow(10, e + 3)))) + " ms";
  return std::to_string(static_cast<int>(std::lround(std::pow(10, e)))) + " s";
}

void draw(Svg& svg, double x, const Panel& panel) {
  // 1. The scales.
  const double left = x + 62, right = x + 344, top = 44, low = 344, zero_top = 354, zero_low = 410;
  double least = 1, most = 0, least_error = 1, most_error = 0;
  for (const auto& of_one : panel.points)
    for (const Panel_point& p : of_one) {
      least = std::min(least, p.seconds);
      most = std::max(most, p.seconds);
      if (p.error > 0) {
        least_error = std::min(least_error, p.error);
        most_error = std::max(most_error, p.error);
      }
    }
  const double x0 = std::floor(2 * std::log10(std::max(least, 1e-9))) / 2,
               x1 = std::max(x0 + 0.5, std::ceil(2 * std::log10(std::max(most, 1e-9))) / 2);
  const double y0 = std::floor(std::log10(least_error)),
               y1 = std::max(y0 + 1, most_error > 0 ? std::ceil(std::log10(most_error)) : 0);
  const auto across = [&](double e) { return left + (e - x0) / (x1 - x0) * (right - left); };
  const auto up = [&](double e) { return low - (e - y0) / (y1 - y0) * (low - top); };

  // 2. The axes.
  svg.label(left, 26, 16, plain(panel.question.name) + ": seconds against error");
  svg.rectangle(left, zero_top, right - left, zero_low - zero_top, "#eef3ec");
  for (int e = static_cast<int>(std::ceil(x0)); e <= x1; ++e) {
    svg.line({across(e), top}, {across(e), zero_low}, "#d9dee2", 1);
    svg.label(across(e), zero_low + 17, 11, power_name(e), "middle");
  }
  const int step = std::max(1, static_cast<int>(std::ceil((y1 - y0) / 8)));
  for (int e = static_cast<int>(y1); e >= y0; e -= step) {
    svg.line({left, up(e)}, {right, up(e)}, "#d9dee2", 1);
    svg.label(left - 6, up(e) + 4, 11, e == 0 ? "1" : "1e" + std::to_string(e), "end");
  }
  svg.label(left - 6, (zero_top + zero_low) / 2 + 4, 11, "no error", "end");
  svg.label((left + right) / 2, zero_low + 38, 11, "median seconds of a case; upwards: mean error", "middle",
            "#5d6872");

  // 3. A line along sizes and a mark for each; the legend.
  const double row = std::min(16.0, (height - 60.0) / static_cast<double>(std::max<std::size_t>(1, panel.who.size())));
  for (std::size_t c = 0; c < panel.who.size(); ++c) {
    const std::string colour = colour_of(panel.who[c].kernel);
    const double place = (static_cast<double>(c) + 0.5) / static_cast<double>(panel.who.size());
    const auto at = [&](const Panel_point& p) {
      return Flat_point{across(std::log10(std::max(p.seconds, 1e-9))),
                        p.error > 0 ? up(std::log10(p.error)) : zero_top + 6 + place * (zero_low - zero_top - 12)};
    };
    const std::vector<Panel_point>& points = panel.points[c];
    for (std::size_t k = 1; k < points.size(); ++k) svg.line(at(points[k - 1]), at(points[k]), colour, 1);
    for (std::size_t k = 0; k < points.size(); ++k)
      svg.polygon(mark(panel.shape(c), at(points[k]), 4.2 + 1.3 * static_cast<double>(k)), colour, "#ffffff", 0.6);
    const double y = top + row * (static_cast<double>(c) + 0.5);
    svg.polygon(mark(panel.shape(c), {right + 20, y}, 4.5), colour, "#ffffff", 0.6);
    svg.label(right + 30, y + 4, 11, plain(panel.who[c].method) + ", " + plain(panel.who[c].kernel));
  }
}

}  // namespace

std::string report_picture(const Report& report) {
  std::vector<Panel> panels;
  for (const Question& question : report.questions)
    if (panels.size() < 2)
      if (Panel panel(report, question); !panel.who.empty()) panels.push_back(std::move(panel));
  Svg svg(panel_width * std::max<int>(1, static_cast<int>(panels.size())), height);
  for (std::size_t k = 0; k < panels.size(); ++k)
    draw(svg, static_cast<double>(panel_width) * static_cast<double>(k), panels[k]);
  return svg.text();
}

}  // namespace sightline::report
