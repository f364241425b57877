#pragma once
// Pictures, read again as a browser reads them: what was drawn is there, in its place, as large as the frame leaves it.

#include "support.h"

#include <sightline/harness/generate/random.h>
#include <sightline/io/plot.h>
#include <sightline/io/svg.h>
#include <sightline/kernel/scene/pixel_view.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace fuzz {

using generate::Random;
using Flat_polygon = std::vector<Flat_point>;

/// An element without those in it, its attributes by name, and the text behind it.
struct Drawn {
  std::string name, text;
  std::map<std::string, std::string> attributes;

  double number(const std::string& attribute) const {
    const std::string& value = attributes.at(attribute);
    char* end = nullptr;
    const double x = std::strtod(value.c_str(), &end);
    require(!value.empty() && *end == 0 && std::isfinite(x), "an attribute is a number");
    return x;
  }
};

/// The elements of a picture in their order; nothing else is XML there.
inline std::vector<Drawn> elements_of(const std::string& svg) {
  std::vector<Drawn> elements;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find('>', at), next = svg.find('<', end);
    require(end != std::string::npos, "an element ends");
    if (svg[at + 1] == '/') continue;
    const std::string inside = svg.substr(at + 1, end - at - 1);
    Drawn& element = elements.emplace_back();
    element.name = inside.substr(0, inside.find_first_of(" /"));
    for (std::size_t from = 0, quote = 0; (quote = inside.find("=\"", from)) != std::string::npos;) {
      const std::size_t begin = inside.rfind(' ', quote) + 1, close = inside.find('"', quote + 2);
      require(close != std::string::npos, "a value ends");
      require(
          element.attributes.emplace(inside.substr(begin, quote - begin), inside.substr(quote + 2, close - quote - 2))
              .second,
          "an attribute comes once");
      from = close + 1;
    }
    if (next != std::string::npos) element.text = svg.substr(end + 1, next - end - 1);
  }
  return elements;
}

/// The loops of a path, or of a polygon's points: with M, l, z, spaces and commas, and signs that part numbers.
inline std::vector<Flat_polygon> loops_of(const std::string& path) {
  std::vector<Flat_polygon> loops;
  std::vector<double> numbers;
  bool by_steps = false;
  const auto end_pair = [&] {
    if (numbers.size() < 2) return;
    Flat_point p{numbers[0], numbers[1]};
    if (by_steps) p = {p[0] + loops.back().back()[0], p[1] + loops.back().back()[1]};
    loops.back().push_back(p);
    numbers.clear();
  };
  if (path.find('M') == std::string::npos) loops.emplace_back();
  for (const char* at = path.c_str(); *at != 0;) {
    if (*at == 'M') {
      loops.emplace_back();
      by_steps = false;
      ++at;
    } else if (*at == 'l') {
      by_steps = true;
      ++at;
    } else if (*at == ' ' || *at == ',' || *at == 'z') {
      ++at;
    } else {
      char* end = nullptr;
      numbers.push_back(std::strtod(at, &end));
      require(end != at, "a path has numbers only");
      at = end;
    }
    end_pair();
  }
  require(numbers.empty(), "numbers come in pairs");
  return loops;
}

/// Twice what is turned around, and how long the way is.
inline std::array<double, 2> turn_and_length(const Flat_polygon& loop) {
  std::array<double, 2> sum{0, 0};
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Flat_point &p = loop[k], &q = loop[(k + 1) % loop.size()];
    sum[0] += (p[0] - loop[0][0]) * (q[1] - loop[0][1]) - (p[1] - loop[0][1]) * (q[0] - loop[0][0]);
    sum[1] += std::hypot(q[0] - p[0], q[1] - p[1]);
  }
  return sum;
}

/// The part of a triangle in a frame: by strips between all places where its sides or the frame's have ends or cross.
inline double turn_in_frame(const Flat_polygon& triangle, double low_x, double high_x, double low_y, double high_y) {
  const double sign = turn_and_length(triangle)[0] > 0 ? 1 : -1;
  std::vector<double> places{low_x, high_x};
  for (std::size_t k = 0; k < 3; ++k) {
    const Flat_point &p = triangle[k], &q = triangle[(k + 1) % 3];
    places.push_back(p[0]);
    for (const double y : {low_y, high_y})
      if (p[1] != q[1]) places.push_back(p[0] + (q[0] - p[0]) * (y - p[1]) / (q[1] - p[1]));
  }
  std::sort(places.begin(), places.end());
  double turn = 0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double x = (places[i] + places[i + 1]) / 2;
    if (x < low_x || x > high_x) continue;
    double low = std::numeric_limits<double>::infinity(), high = -low;  // of the triangle there
    for (std::size_t k = 0; k < 3; ++k) {
      const Flat_point &p = triangle[k], &q = triangle[(k + 1) % 3];
      if ((p[0] < x) == (q[0] < x)) continue;
      const double y = p[1] + (q[1] - p[1]) * (x - p[0]) / (q[0] - p[0]);
      low = std::min(low, y);
      high = std::max(high, y);
    }
    turn += 2 * (places[i + 1] - places[i]) * std::max(0.0, std::min(high, high_y) - std::max(low, low_y));
  }
  return sign * turn;
}

/// Of triangles that run round in one sense, or are left out where a number is none.
inline void require_area(const std::vector<Flat_polygon>& drawn, const std::vector<Flat_polygon>& loops, int width,
                         int height) {
  double expected = 0, found = 0, length = 0;
  for (const Flat_polygon& triangle : drawn) {
    bool finite = true;
    for (const Flat_point& p : triangle) finite = finite && std::isfinite(p[0]) && std::isfinite(p[1]);
    if (finite) expected += turn_in_frame(triangle, -10, width + 10, -10, height + 10);
  }
  for (const Flat_polygon& loop : loops) {
    require(loop.size() >= 3, "what is filled has three corners");
    found += turn_and_length(loop)[0];
    length += turn_and_length(loop)[1];
    for (const Flat_point& p : loop)
      require(p[0] >= -10.01 && p[0] <= width + 10.01 && p[1] >= -10.01 && p[1] <= height + 10.01,
              "what is filled is in the frame");
  }
  length += 4.0 * static_cast<double>(drawn.size());  // slivers that vanish
  require(std::fabs(found - expected) <= 0.02 * length + 0.1, "what is filled is as large as was drawn");
}

inline Flat_polygon any_triangle(Random& random, int width, int height) {
  Flat_polygon triangle(3);
  const double far = random.chance(1, 4) ? 40 : 1;
  do
    for (Flat_point& p : triangle)
      p = {far * (random.between(-width, 2 * width) + 0.125 * random.between(0, 7)),
           far * (random.between(-height, 2 * height) + 0.125 * random.between(0, 7))};
  while (turn_and_length(triangle)[0] <= 0);
  if (random.chance(1, 16)) triangle[random.below(3)][random.below(2)] = std::numeric_limits<double>::quiet_NaN();
  return triangle;
}

inline void shapes_in_a_picture(Random& random) {
  const int width = static_cast<int>(random.between(20, 200)), height = static_cast<int>(random.between(20, 200));
  Svg svg(width, height, "#123456");
  // 1. Draw.
  const Flat_polygon alone = any_triangle(random, width, height);
  svg.polygon(alone, "#111111", "#222222", 1.25, "one", "a title");
  std::vector<Flat_polygon> together(1 + random.below(3));
  for (Flat_polygon& triangle : together) triangle = any_triangle(random, width, height);
  svg.shape(together, "#333333");
  const bool is_titled = random.chance(1, 2);
  svg.shape(together, "#333333", "#444444", 0.5, is_titled ? "" : "two", is_titled ? "another title" : "");
  const auto any_x = [&] { return 0.25 * random.between(-4 * width, 8 * width); };
  Flat_polygon chain(2 + random.below(4));
  for (Flat_point& p : chain) p = {any_x(), any_x()};
  if (random.chance(1, 4)) chain.push_back(chain.back());
  const auto any_far = [&] {  // the last is far off, but there is room for it
    constexpr std::array<double, 4> all{1e6, -1e6, std::numeric_limits<double>::quiet_NaN(), 999999};
    return all[random.below(all.size())];
  };
  if (random.chance(1, 4)) chain[0][random.below(2)] = any_far();
  svg.chains({chain}, "#555555", 2);
  const Flat_point from{any_x(), any_x()};
  Flat_point to{any_x(), any_x()};
  if (random.chance(1, 4)) to[random.below(2)] = any_far();
  const bool dashed = random.chance(1, 2);
  svg.line(from, to, "#666666", 3, dashed);
  svg.rectangle(from[0], from[1], 5, 0.5, "#777777");
  svg.label(from[0], from[1], 12, "words", "middle", "#888888");
  svg.label(1, 2, 8, "more");
  // 2. Read.
  const std::vector<Drawn> all = elements_of(svg.text());
  const auto one = [&](const std::string& attribute, const std::string& value) -> const Drawn* {
    const Drawn* found = nullptr;
    for (const Drawn& drawn : all)
      if (const auto at = drawn.attributes.find(attribute); at != drawn.attributes.end() && at->second == value) {
        require(found == nullptr, "a shape is there once");
        found = &drawn;
      }
    return found;
  };
  require(
      all.size() >= 2 && all[0].name == "svg" && all[0].number("width") == width && all[0].number("height") == height,
      "a picture has its size");
  require(all[1].name == "rect" && all[1].attributes.at("fill") == "#123456", "its background is behind it");
  const Drawn* polygon = one("id", "one");
  require_area({alone}, polygon == nullptr ? std::vector<Flat_polygon>{} : loops_of(polygon->attributes.at("points")),
               width, height);
  if (polygon != nullptr) {
    require(polygon->attributes.at("fill") == "#111111" && polygon->attributes.at("stroke") == "#222222" &&
                polygon->number("stroke-width") == 1.25,
            "a polygon has its colours");
    require(svg.text().find("<title>a title</title></polygon>") != std::string::npos, "a polygon has its title");
  }
  std::size_t shapes = 0;
  for (const Drawn& drawn : all) {
    if (const auto fill = drawn.attributes.find("fill"); fill == drawn.attributes.end() || fill->second != "#333333")
      continue;
    ++shapes;
    require_area(together, loops_of(drawn.attributes.at("d")), width, height);
    require(drawn.attributes.count("id") == (!is_titled && drawn.attributes.count("stroke") > 0 ? 1 : 0),
            "a shape has its name, or none");
  }
  require(shapes == 0 || shapes == 2, "a shape is there with its outline and without");
  if (shapes == 0) require_area(together, {}, width, height);
  else require(one("stroke", "#444444")->number("stroke-width") == 0.5, "a shape has its outline");
  require((svg.text().find("<title>another title</title></path>") != std::string::npos) == (is_titled && shapes > 0),
          "a shape has its title, or none");
  // 3. Lines and words.
  const auto has_room = [](const Flat_point& p) { return std::fabs(p[0]) < 1e6 && std::fabs(p[1]) < 1e6; };
  const Drawn* line = one("stroke", "#666666");
  require((line != nullptr) == (has_room(from) && has_room(to)), "a line is there where there is room for it");
  if (line != nullptr)
    require(std::fabs(line->number("x1") - from[0]) < 0.006 && std::fabs(line->number("y1") - from[1]) < 0.006 &&
                std::fabs(line->number("x2") - to[0]) < 0.006 && std::fabs(line->number("y2") - to[1]) < 0.006 &&
                line->number("stroke-width") == 3 && line->attributes.count("stroke-dasharray") == (dashed ? 1 : 0),
            "a line is where it was drawn");
  Flat_polygon corners = chain;
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const bool is_drawn = corners.size() > 1 && std::all_of(chain.begin(), chain.end(), has_room);
  const Drawn* path = one("stroke", "#555555");
  require((path != nullptr) == is_drawn, "a chain is there where there is room for it");
  if (path != nullptr) {
    const std::vector<Flat_polygon> read = loops_of(path->attributes.at("d"));
    require(read.size() == 1 && read[0] == corners, "a chain is where it was drawn");  // quarters are not rounded
  }
  const Drawn* box = one("fill", "#777777");
  require(box != nullptr && box->number("x") == from[0] && box->number("y") == from[1] && box->number("width") == 5 &&
              box->number("height") == 0.5,
          "a rectangle is where it was drawn");
  const Drawn* words = one("fill", "#888888");
  require(words != nullptr && words->text == "words" && words->attributes.at("text-anchor") == "middle" &&
              words->number("x") == from[0] && words->number("y") == from[1] && words->number("font-size") == 12,
          "words are where they were written");
  require(all.back().text == "more" && all.back().attributes.count("fill") == 0 &&
              all.back().attributes.count("text-anchor") == 0,
          "what is usual is not said");
}

/// Points are where the axes' own labels put them.
inline void points_in_a_plot(Random& random) {
  Log_plot plot("title", "across", "upwards");
  const int width = static_cast<int>(random.between(400, 900)), height = static_cast<int>(random.between(300, 600));
  plot.set_canvas(width, height, "#fefefe", "#010101");
  const bool is_wide = random.chance(1, 8);  // all that doubles hold
  const std::array<std::string, 4> names{"ab", "bc", "cd", "de"};
  std::map<std::string, std::vector<Flat_point>> series;
  for (const std::string& name : names)
    for (std::uint64_t count = random.below(4); count > 0; --count) {
      const auto any = [&] {
        const int reach = is_wide ? 290 : 3;
        return std::pow(10.0, static_cast<double>(random.between(-reach, reach))) *
               static_cast<double>(random.between(1, 9));
      };
      Flat_point p{any(), any()};
      if (random.chance(1, 6)) p[1] = 0;
      if (random.chance(1, 12)) p[random.below(2)] = random.chance(1, 2) ? -1 : INFINITY;
      if (random.chance(1, 24)) p[0] = 0;
      plot.add(name, p[0], p[1]);
      if (p[0] > 0 && p[1] >= 0 && std::isfinite(p[0]) && std::isfinite(p[1])) series[name].push_back(p);
    }
  const bool has_colour = random.chance(1, 2);
  if (has_colour) plot.set_colour(names[0], "#abcdef");
  // 1. The axes, by their labels.
  const std::vector<Drawn> all = elements_of(plot.text());
  std::array<std::map<int, double>, 2> decades;
  std::map<std::string, double> name_at;
  double zero = -1;
  for (const Drawn& drawn : all) {
    if (drawn.name != "text") continue;
    require(drawn.attributes.at("fill") == "#010101", "words are in the canvas' ink");
    const auto anchor = drawn.attributes.find("text-anchor");
    const bool is_across = anchor != drawn.attributes.end() && anchor->second == "middle";
    if (drawn.text.starts_with("1e"))
      decades[is_across ? 0 : 1][std::stoi(drawn.text.substr(2))] =
          is_across ? drawn.number("x") : drawn.number("y") - 4;
    else if (drawn.text == "0") zero = drawn.number("y") - 4;
    else if (series.count(drawn.text) > 0) name_at[drawn.text] = drawn.number("y") - 4;
  }
  bool any = false, any_zero = false;
  for (const auto& [name, points] : series)
    for (const Flat_point& p : points) {
      any = true;
      any_zero = any_zero || p[1] == 0;
    }
  require((zero >= 0) == any_zero, "zero has a row where there is one");
  for (const auto& axis : decades) {
    require(axis.size() >= 2, "an axis has two decades at least");
    require(axis.rbegin()->first - axis.begin()->first + 1 == static_cast<int>(axis.size()), "no decade is left out");
  }
  require(decades[0].begin()->second > 0 && decades[0].rbegin()->second < width, "all is on the canvas");
  require(decades[1].begin()->second < height && decades[1].rbegin()->second > 0, "so it is upwards");
  if (any_zero) require(zero > decades[1].begin()->second + 5, "zero is below all others");
  if (!any) return;
  const auto place = [&](std::size_t k, double value) {
    const auto& [low, at_low] = *decades[k].begin();
    const auto& [high, at_high] = *decades[k].rbegin();
    const double share = (std::log10(value) - low) / (high - low);
    require(share > -1e-6 && share < 1 + 1e-6, "axes hold all points");
    return at_low + share * (at_high - at_low);
  };
  // 2. Dots, lines between them, and names beside their colours.
  std::set<std::string> colours;
  for (auto& [name, points] : series) {
    std::sort(points.begin(), points.end());
    std::vector<Flat_point> expected;
    for (const Flat_point& p : points) expected.push_back({place(0, p[0]), p[1] == 0 ? zero : place(1, p[1])});
    require(name_at.count(name) > 0, "a series has its name");
    std::string colour;
    for (const Drawn& drawn : all)
      if (drawn.name == "line" && drawn.number("stroke-width") == 4 &&
          std::fabs(drawn.number("y1") - name_at[name]) < 1)
        colour = drawn.attributes.at("stroke");
    require(colours.insert(colour).second && !colour.empty(), "series have colours of their own");
    if (name == names[0] && has_colour) require(colour == "#abcdef", "a series has the colour that was set");
    std::vector<Flat_point> dots, joints;
    for (const Drawn& drawn : all) {
      if (drawn.name != "line" || drawn.attributes.at("stroke") != colour || drawn.number("stroke-width") == 4)
        continue;
      const bool is_dot = drawn.number("stroke-width") == 7;
      (is_dot ? dots : joints).push_back({drawn.number("x1"), drawn.number("y1")});
      if (!is_dot) joints.push_back({drawn.number("x2"), drawn.number("y2")});
    }
    const auto is_near = [](const Flat_point& a, const Flat_point& b) {
      return std::fabs(a[0] - b[0]) < 0.05 && std::fabs(a[1] - b[1]) < 0.05;
    };
    require(std::equal(dots.begin(), dots.end(), expected.begin(), expected.end(), is_near),
            "dots are at their places");
    require(joints.size() == 2 * (expected.size() - 1), "dots are joined");
    for (std::size_t k = 0; k < joints.size(); ++k)
      require(is_near(joints[k], expected[(k + 1) / 2]), "dots are joined in their order");
  }
}

/// The first bytes are a seed.
/// Twelve series have colours of their own; more than that have some colour each.
inline void many_series_in_a_plot(Random& random) {
  Log_plot plot("title", "across", "upwards");
  const std::size_t count = 1 + random.below(30);
  for (std::size_t k = 0; k < count; ++k) plot.add("series " + std::to_string(100 + k), 1, static_cast<double>(k + 1));
  std::vector<std::string> colours;
  for (const Drawn& drawn : elements_of(plot.text()))
    if (drawn.name == "line" && drawn.number("stroke-width") == 4) colours.push_back(drawn.attributes.at("stroke"));
  const std::set<std::string> apart(colours.begin(), colours.end());
  require(colours.size() == count, "each series has its colour");
  require(apart.size() == std::min<std::size_t>(count, 12), "as many colours are used as there are");
}

/// Doubles have places in images whose directions are neither tiny nor huge, of whatever length else.
inline void places_in_images(Random& random) {
  static constexpr std::array powers{0, 1, -1, 40, -40, 95, -95, 105, -105, 120, -120, 150, -150};
  const int power = powers[random.below(powers.size())];
  Pixel_view view;
  view.width = view.height = 1 + static_cast<std::uint32_t>(random.below(9));
  const std::size_t axis = random.below(3);
  view.look[axis] = std::ldexp(random.chance(1, 2) ? 1.0 : -1.0, power);
  view.right[(axis + 1) % 3] = std::ldexp(static_cast<double>(random.between(1, 3)), power);
  view.up[(axis + 2) % 3] = std::ldexp(static_cast<double>(random.between(1, 3)), power);
  require(view.has_places_in_doubles() == (std::abs(power) < 100),
          "doubles have places in an image iff its directions are neither tiny nor huge");
}

inline void pictures(std::string_view bytes) {
  std::uint64_t seed = bytes.size();
  for (const char c : bytes.substr(0, 16)) seed = 31 * seed + static_cast<unsigned char>(c);
  Random random(seed);
  shapes_in_a_picture(random);
  points_in_a_plot(random);
  many_series_in_a_plot(random);
  places_in_images(random);
}

}  // namespace fuzz
