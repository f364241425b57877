#include "pixels.h"

#include "paths.h"

#include <sightline/io/svg.h>
#include <sightline/kernel/quoted.h>

#include <iostream>

namespace sightline::app {

std::vector<View> read_views(const Pixel_arguments& arguments) {
  const auto [width, height] = parse_size(arguments.size, "--pixels", 1, 4096);
  std::vector<View> views;
  read_lines(arguments.eyes,
             "an eye X,Y,Z, or X,Y,Z,DX,DY,DZ with the direction it looks in, not zero and in the range of doubles",
             [&, wide = width, high = height](const std::vector<Rational>& n) {
               if (n.size() != 3 && n.size() != 6) return false;
               View& view = views.emplace_back(View{{n[0], n[1], n[2]}});
               view.width = wide;
               view.height = high;
               if (n.size() == 3) return true;
               view.look = {nearest_double(n[3]), nearest_double(n[4]), nearest_double(n[5])};
               return view.look != Direction3{} && std::isfinite(view.look[0] + view.look[1] + view.look[2]);
             });
  return views;
}

std::string picture_file(const Pixel_arguments& arguments, std::size_t number) {
  return fmt::format("{}/image_{:04}.svg", arguments.pictures, number);
}

Pixel_view pixel_view(const View& view) {
  const Axes axes = axes_of(view);
  const double half = std::tan(view.field * 3.14159265358979 / 360);
  Pixel_view pixels{
      view.eye, view.look, {}, {}, static_cast<std::uint32_t>(view.width), static_cast<std::uint32_t>(view.height)};
  for (std::size_t k = 0; k < 3; ++k) {
    pixels.right[k] = half * axes.right[k];
    pixels.up[k] = half * view.height / view.width * axes.up[k];
  }
  return pixels;
}

std::string painted(const Pixel_image& image) {
  constexpr std::array<const char*, 7> colours{"#f4f3ef", "#5b9e6f", "#f0d264", "#e9a13b",
                                               "#dd6b33", "#bb3a2f", "#6d1f3d"};
  constexpr std::array<const char*, 7> names{"no face", "1", "2", "3-4", "5-8", "9-16", "more"};
  const auto colour = [&](std::uint32_t left) {
    return left < 3 ? left : left <= 4 ? 3u : left <= 8 ? 4u : left <= 16 ? 5u : 6u;
  };
  const std::uint32_t width = static_cast<std::uint32_t>(image.view.width),
                      height = static_cast<std::uint32_t>(image.view.height);
  const std::uint32_t zoom = std::max(1u, 480 / width), wide = zoom * width, high = zoom * height, margin = 12,
                      title = 26;
  Svg svg(static_cast<int>(2 * wide + 3 * margin), static_cast<int>(high + 2 * title + margin), "#ffffff");
  std::uint32_t left = margin;
  for (const auto& [statistics, name] :
       {std::pair(&image.by_number, "By h, for all viewpoints"), std::pair(&image.by_tree, "By the tree of planes")}) {
    const double share = statistics->covered == 0 ? 0
                                                  : 100.0 * static_cast<double>(statistics->single) /
                                                        static_cast<double>(statistics->covered);
    svg.label(left, 18, 13, fmt::format("{}: one face left at {:.1f}% of the pixels", name, share));
    svg.rectangle(left, title, wide, high, colours[0]);
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0, end = 0; x < width; x = end) {  // a rectangle for each run of one colour
        const auto at = [&, statistics = statistics](std::uint32_t column) {
          return colour(statistics->image[std::size_t{y} * width + column]);
        };
        for (end = x + 1; end < width && at(end) == at(x);) ++end;
        if (at(x) != 0) svg.rectangle(left + x * zoom, title + y * zoom, (end - x) * zoom, zoom, colours[at(x)]);
      }
    left += wide + margin;
  }
  double place = margin;
  for (std::size_t k = 0; k < names.size(); ++k) {
    svg.rectangle(place, title + high + 10, 14, 14, colours[k]);
    svg.label(place + 19, title + high + 22, 12, names[k]);
    place += 40 + 8.0 * static_cast<double>(std::string_view(names[k]).size());
  }
  return svg.text();
}

static double ratio(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

static Json to_json(const Pixel_statistics& s) {
  Json sizes = Json::array();
  for (std::size_t size = 1; size < s.by_size.size(); ++size)
    for (std::size_t left = 1; left < s.by_size[size].size(); ++left)
      if (s.by_size[size][left] > 0) sizes.push_back({size, left, s.by_size[size][left]});
  return {{"single", s.single}, {"left", s.left}, {"by_size", std::move(sizes)}};
}

Json to_json(const std::vector<Pixel_image>& images) {
  Json result = Json::array();
  for (const Pixel_image& image : images) {
    const Pixel_statistics& s = image.by_number;
    result.push_back({{"eye", point_json(image.view.eye)},
                      {"look", image.view.look},
                      {"width", image.view.width},
                      {"height", image.view.height},
                      {"covered", s.covered},
                      {"several", s.several},
                      {"faces", s.faces},
                      {"by_h", to_json(s)},
                      {"by_tree", to_json(image.by_tree)},
                      {"changed", image.changed ? Json(*image.changed) : Json()}});
  }
  return result;
}

/// One row an image, then one a size of S, over all images.
void print(const std::vector<Pixel_image>& images) {
  std::cout << "image  covered  mean |S|  by h: |S^| = 1  mean |S^|  by tree: |S^| = 1  mean |S^|  changed\n";
  for (std::size_t k = 0; k < images.size(); ++k) {
    const Pixel_statistics &h = images[k].by_number, &t = images[k].by_tree;
    std::cout << fmt::format("{:>5}  {:>7}  {:>8.2f}  {:>13.1f}%  {:>9.2f}  {:>16.1f}%  {:>9.2f}  {}\n", k + 1,
                             h.covered, ratio(h.faces, h.covered), 100 * ratio(h.single, h.covered),
                             ratio(h.left, h.covered), 100 * ratio(t.single, t.covered), ratio(t.left, t.covered),
                             images[k].changed ? fmt::format("{:>6.1f}%", 100 * *images[k].changed) : "");
  }
  constexpr std::size_t shown = 12;
  std::vector<std::array<std::uint64_t, 5>> sizes;  // pixels; with one left, and the sum left, by h and by tree
  const auto add = [&](const Pixel_statistics& s, std::size_t column) {
    for (std::size_t size = 1; size < s.by_size.size(); ++size)
      for (std::size_t left = 1; left < s.by_size[size].size(); ++left) {
        if (sizes.size() < size) sizes.resize(size);
        auto& row = sizes[size - 1];
        row[0] += column == 1 ? s.by_size[size][left] : 0;
        row[column] += left == 1 ? s.by_size[size][left] : 0;
        row[column + 1] += left * s.by_size[size][left];
      }
  };
  for (const Pixel_image& image : images) {
    add(image.by_number, 1);
    add(image.by_tree, 3);
  }
  std::cout << "  |S|   pixels            by h: |S^| = 1  mean |S^|  by tree: |S^| = 1  mean |S^|\n";
  for (std::size_t k = 0; k < std::min(shown, sizes.size()); ++k) {
    const auto& row = sizes[k];
    if (row[0] > 0)
      std::cout << fmt::format("{:>5}  {:>7}  {:>24.1f}%  {:>9.2f}  {:>16.1f}%  {:>9.2f}\n", k + 1, row[0],
                               100 * ratio(row[1], row[0]), ratio(row[2], row[0]), 100 * ratio(row[3], row[0]),
                               ratio(row[4], row[0]));
  }
  if (sizes.size() > shown) std::cout << fmt::format("  ... up to |S| = {}: --json - prints them all\n", sizes.size());
}

}  // namespace sightline::app
