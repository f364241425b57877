#pragma once
// What doubles say for certain though nothing exact is asked after them: which pieces are near a shaft, where lines
// may meet a chart's plane, where polygons of any size are halved, lines from beside what is near, and the pixels of an
// image whose directions are nearly in a plane.

#include "soups.h"
#include "support.h"

#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/image/scan_line.h>
#include <sightline/algorithms/priority/pixels.h>
#include <sightline/algorithms/priority/relation.h>
#include <sightline/algorithms/weak_visibility/events/homogeneous.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/partition/plane_chart.h>
#include <sightline/algorithms/weak_visibility/search/cell_cuts.h>
#include <sightline/algorithms/weak_visibility/search/line_cell.h>
#include <sightline/algorithms/weak_visibility/search/near_lines.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace fuzz {

// ---- Near a shaft

/// A corner for `face` that is farther behind the plane of three points than a shaft's planes may be from it, or hardly
/// less: 10^-9 of what is 1 in the frame of the scene.
inline Exact_point hardly_beside(const generate::Points& face, const Exact_point& apex, const Rational& unit,
                                 generate::Random& random) {
  const Exact_point n = cross(minus(face[1], face[0]), minus(apex, face[0]));
  const double length = std::sqrt(nearest_double(dot(n, n)));
  const Rational share = generate::integer(random, -8, 8) / 4, more = generate::integer(random, -8, 8) / 4,
                 off = unit * exact(1e-9 / length * (1 - static_cast<double>(random.below(64)) * 0x1p-48));
  const int side = random.chance(1, 2) ? 1 : -1;
  Exact_point p;
  for (std::size_t k = 0; k < 3; ++k)
    p[k] = exact(nearest_double(
        Rational(face[0][k] + share * (face[1][k] - face[0][k]) + more * (apex[k] - face[0][k]) + side * off * n[k])));
  return p;
}

/// A small face that touches the hull of two polygons, at a corner of either or in between, is near their shaft.
inline void try_near_shaft(generate::Random& random) {
  const auto point = [&] { return generate::lattice(random, 4); };
  generate::Points from{point(), point(), point()}, to{point(), point(), point()};
  if (!spans_a_plane(from) || !spans_a_plane(to)) return;
  const auto soup_of_all = [&](std::span<const generate::Points> probes) {
    generate::Faces faces{from, to};
    faces.insert(faces.end(), probes.begin(), probes.end());
    return generate::soup_of(faces);
  };
  // 1. A corner that a plane through an edge and a corner hardly passes.
  if (random.chance(3, 4)) {
    const generate::Points widest{{-4, -4, -4}, {4, 4, 4}, {4, -4, 4}};
    const Scene scene(soup_of_all({{widest}}));
    const Occluders occluders(scene);
    double most = 0;  // what 4 is in its frame
    for (const Triple& p : occluders.corners(2))
      for (const double x : p) most = std::max(most, std::fabs(x));
    const Exact_point apex = to[0];
    if (!spans_a_plane({from[0], from[1], apex})) return;
    (random.chance(1, 2) ? from : to)[2] = hardly_beside(from, apex, Rational(4 / exact(most)), random);
    if (!spans_a_plane(from) || !spans_a_plane(to)) return;
  }
  // 2. Faces that touch the hull at a point.
  std::vector<generate::Points> probes{{{-4, -4, -4}, {4, 4, 4}, {4, -4, 4}}};
  for (const generate::Points* polygon : {&from, &to})
    for (const Exact_point& corner : *polygon) probes.push_back({corner, corner, corner});
  const Rational share = generate::integer(random, 0, 8) / 8;
  Exact_point middle = from[random.below(3)];
  for (std::size_t k = 0; k < 3; ++k) middle[k] += share * (to[0][k] - middle[k]);
  probes.push_back({middle, middle, middle});
  const Rational size = generate::power_of_two(-static_cast<int>(random.between(0, 90)));
  for (std::size_t k = 1; k < probes.size(); ++k) do
      for (std::size_t c = 1; c < 3; ++c)
        for (std::size_t i = 0; i < 3; ++i) probes[k][c][i] = probes[k][0][i] + size * generate::integer(random, -4, 4);
    while (!spans_a_plane(probes[k]));
  const Scene scene(soup_of_all(probes));
  const Occluders occluders(scene);
  std::array<std::optional<std::uint32_t>, 2> polygons;
  for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece)
    if (scene.pieces()[piece].face < 2) polygons[scene.pieces()[piece].face] = piece;
  if (!polygons[0] || !polygons[1]) return;
  const std::vector<std::uint32_t> near =
      occluders.near_shaft(occluders.polygon(*polygons[0]), occluders.polygon(*polygons[1]));
  for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece)
    require(scene.pieces()[piece].face == 2 || std::find(near.begin(), near.end(), piece) != near.end(),
            "what touches the hull of two polygons is near their shaft");
}

/// A small face beyond a plane through an edge of one polygon and a corner of the other, which has both on one side, is
/// not near their shaft.
inline void try_kept_away(generate::Random& random) {
  const auto point = [&] { return generate::lattice(random, 4); };
  const generate::Points from{point(), point(), point()}, to{point(), point(), point()};
  if (!spans_a_plane(from) || !spans_a_plane(to)) return;
  const bool turned = random.chance(1, 2);
  const generate::Points &own = turned ? to : from, &other = turned ? from : to;
  const std::size_t edge = random.below(3);
  const Exact_point &a = own[edge], &b = own[(edge + 1) % 3], n = cross(minus(b, a), minus(other[random.below(3)], a));
  bool front = false, behind = false;
  for (const generate::Points* polygon : {&from, &to})
    for (const Exact_point& p : *polygon) {
      front |= dot(n, minus(p, a)) > 0;
      behind |= dot(n, minus(p, a)) < 0;
    }
  if (front == behind) return;
  const Rational size = abs(n[0]) + abs(n[1]) + abs(n[2]), share = generate::integer(random, 0, 8) / 8;
  const Exact_point beyond = generate::along(generate::along(a, share, minus(b, a)), (front ? -1 : 1) / (2 * size), n);
  generate::Points face(3, beyond);
  for (Exact_point& p : face)
    for (Rational& x : p) x += generate::integer(random, -4, 4) / 256;
  if (!spans_a_plane(face)) return;
  const Scene scene(generate::soup_of({from, to, face}));
  if (scene.pieces().size() != 3) return;
  const Occluders occluders(scene);
  std::array<std::uint32_t, 3> pieces{};
  for (std::uint32_t piece = 0; piece < 3; ++piece) pieces[scene.pieces()[piece].face] = piece;
  const std::vector<std::uint32_t> near =
      occluders.near_shaft(occluders.polygon(pieces[0]), occluders.polygon(pieces[1]));
  require(std::find(near.begin(), near.end(), pieces[2]) == near.end(),
          "what a plane beside two polygons keeps away is not near their shaft");
}

// ---- Lines from beside

/// Of lines between polygons that are near each other one end is hardly farther from the middle of the other polygon
/// than any point of its own is.
inline void try_lines_from_beside(generate::Random& random) {
  const auto point = [&](std::int64_t reach, const Rational& above) {
    Exact_point p = generate::lattice(random, reach);
    p[2] = p[2] / 4 + above;
    return p;
  };
  const generate::Points low{point(20, 0), point(20, 0), point(20, 0)}, high{point(4, 9), point(4, 9), point(4, 9)};
  if (!spans_a_plane(low) || !spans_a_plane(high)) return;
  const Scene scene(generate::soup_of({low, high}));
  const Occluders occluders(scene);
  if (scene.pieces().size() != 2) return;
  const std::array<Near_polygon, 2> polygons{occluders.polygon(0), occluders.polygon(1)};
  for (std::uint32_t own = 0; own < 2; ++own)  // pre: each is in front of the other, in part
    if (side(occluders.plane(own), polygons[1 - own]) < 1) return;
  const std::vector<Line_weights> lines = near_lines(polygons[0], occluders.plane(0), polygons[1], occluders.plane(1));
  require(lines.size() == 4, "doubles hold the lines from beside");
  const auto distance = [](const Triple& p, const Triple& q) {
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  };
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::size_t own = k % 2;
    const std::vector<double> even(3, 1.0 / 3);
    const Triple middle = weighted_mean(polygons[1 - own], even),
                 end = weighted_mean(polygons[own], own == 0 ? lines[k].source : lines[k].target);
    double least = std::numeric_limits<double>::infinity(), size = 0;
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; i + j <= 8; ++j)
        least = std::min(least, distance(middle, weighted_mean(polygons[own], {i / 8.0, j / 8.0, (8 - i - j) / 8.0})));
    for (const Near_point& corner : polygons[1 - own]) size = std::max(size, distance(middle, corner.near));
    const double share = k < 2 ? 0.25 : 0.03125;
    require(distance(middle, end) <= least + share * size + 1e-6, "a line from beside has an end that is near");
  }
}

// ---- Bounds in a chart

/// Lines through points of a face are met where a chart's bounds say, whatever sizes face and lines have.
inline void try_chart_bounds(generate::Random& random) {
  static constexpr std::array<std::int64_t, 7> powers{0, 30, 300, 440, 500, 550, 660};
  const auto power = [&] {
    const std::int64_t about = powers[random.below(powers.size())] + random.between(-4, 4);
    return generate::power_of_two(static_cast<int>(random.chance(1, 2) ? about : -about));
  };
  const Rational small = power(), large = power();
  const auto point = [&](const Rational& scale) {
    Exact_point p = generate::lattice(random, 9);
    for (Rational& x : p) x *= scale;
    return p;
  };
  generate::Points face{point(small), point(small), point(small)};
  const generate::Points other{point(large), point(large), point(large)};
  if (random.chance(1, 3)) {  // a sliver
    const Exact_point on = generate::along(face[0], generate::integer(random, 0, 4) / 4, minus(face[1], face[0]));
    face[2] = generate::along(on, generate::power_of_two(-static_cast<int>(random.between(8, 45))), minus(face[2], on));
  }
  if (!spans_a_plane(face) || !spans_a_plane(other)) return;
  const Exact_point normal = cross(minus(face[1], face[0]), minus(face[2], face[0]));
  const Scene scene(generate::soup_of({face, other}));
  const Occluders occluders(scene);
  const auto piece = static_cast<std::uint32_t>(scene.pieces()[0].face == 0 ? 0 : 1);
  const Near_frame& frame = occluders.frame();
  const Plane_chart chart(frame, occluders.polygon(piece), occluders.plane(piece));
  std::array<Near<6>, 3> lines;
  std::array<Near_point, 3> met;
  for (std::size_t n = 0; n < 3; ++n) {
    const Rational a = generate::integer(random, 0, 8) / 8, b = generate::integer(random, 0, 8) / 8 * (1 - a);
    Exact_point in_face, from = point(random.chance(1, 4) ? small : large);
    for (std::size_t k = 0; k < 3; ++k)
      in_face[k] = face[0][k] + a * (face[1][k] - face[0][k]) + b * (face[2][k] - face[0][k]);
    if (dot(normal, minus(from, face[0])) == 0) return;
    met[n] = occluders.located(in_face);
    lines[n] = join(near(occluders.located(from)), near(met[n]));
  }
  const Plane_chart::Bounds bounds = chart.bounds(lines);
  for (const Near_point& p : met) {
    const std::array<Rational, 2> at = chart.at(p.exact);
    const auto is_within = [](const Rational& x, double low, double high) {
      return !(std::isfinite(low) ? x < exact(low) : low > 0) && !(std::isfinite(high) ? x > exact(high) : high < 0);
    };
    require(is_within(at[0], bounds.x0, bounds.x1) && is_within(at[1], bounds.y0, bounds.y1),
            "lines meet a chart's plane within the bounds that it gives");
  }
}

// ---- Cuts of what is large

/// A bisector goes across the longer one of two polygons, however large they are; beyond doubles there may be none.
inline void try_bisector(generate::Random& random) {
  const Scene scene(generate::soup_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}));
  const Occluders occluders(scene);
  const auto polygon = [&]() -> std::optional<Near_polygon> {
    const int power = static_cast<int>(random.between(random.chance(1, 2) ? 1000 : -1000, 1025));
    generate::Points corners{generate::lattice(random, 7), generate::lattice(random, 7), generate::lattice(random, 7)};
    if (!spans_a_plane(corners)) return std::nullopt;
    Near_polygon near;
    for (Exact_point& p : corners) {
      for (Rational& x : p) x *= generate::power_of_two(power);
      near.push_back(occluders.located(p));
    }
    return near;
  };
  const std::optional<Near_polygon> source = polygon(), target = polygon();
  if (!source || !target) return;
  const Line_domain domain(std::make_shared<const Near_polygon>(*source),
                           std::make_shared<const Near_polygon>(*target));
  const std::optional<Cell_cut> cut = bisector(domain, occluders.frame());
  require(!cut || is_across(cut->plane, cut->source ? *source : *target), "a bisector is across what it cuts");
  const auto is_ordinary = [](const Near_polygon& of) {
    double most = 0;
    for (const Near_point& p : of)
      for (const double x : p.near) most = std::max(most, std::fabs(x));
    return most > 0x1p-400 && most < 0x1p1022;
  };
  require(cut || !is_ordinary(*source) || !is_ordinary(*target), "what doubles hold has a bisector");
}

// ---- Flat views

/// Two directions of an image hardly beside the third, of lengths that may multiply to zero: a face about a row of
/// pixels is pierced by the rays that go through its inside.
inline void try_flat_views(generate::Random& random) {
  using Vector = std::array<double, 3>;
  const auto number = [&] { return static_cast<double>(random.between(-(1 << 30), 1 << 30)) * 0x1p-30; };
  const auto power = [&] { return static_cast<int>(random.chance(1, 4) ? 0 : random.between(260, 300)); };
  const Vector a{number(), number(), number()}, b{number(), number(), number()}, w{number(), number(), number()};
  const double of_a = number(), of_b = number(), of_w = std::ldexp(number(), -static_cast<int>(random.between(45, 53)));
  const int short_ones = -power(), long_one = power();
  Pixel_view view{{0, 0, 0}, {}, {}, {}, 9, 5};
  for (std::size_t i = 0; i < 3; ++i) {
    view.look[i] = std::ldexp(a[i], short_ones);
    view.right[i] = std::ldexp(b[i], short_ones);
    view.up[i] = std::ldexp(of_a * a[i] + of_b * b[i] + of_w * w[i], long_one);
  }
  generate::Points face(3);
  for (Exact_point& p : face) {
    const double x = number(), y = std::ldexp(number(), -50);
    for (std::size_t i = 0; i < 3; ++i) p[i] = exact(a[i] + x * b[i] + y * w[i]);
  }
  if (dot(cross(face[0], face[1]), face[2]) > 0) std::swap(face[1], face[2]);
  const Scene scene(generate::soup_of({face}));
  const Exact_traits traits(scene);
  const Priority_relation<Exact_traits> relation(traits);
  if (relation.size() != 1) return;
  const Pixel_sets sets = pixel_sets(relation, view);
  for (std::uint32_t y = 0; y < view.height; ++y)
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const Exact_point ray = exact(view.ray(x, y));
      bool is_inside = true;
      for (std::size_t k = 0; k < 3; ++k) is_inside = is_inside && dot(cross(face[(k + 1) % 3], face[k]), ray) > 0;
      require(sets[y * view.width + x].empty() != is_inside, "a pixel has the faces that its ray goes through");
    }
}

/// A face so near the eye that a kernel's numbers hardly hold its plane, or do not, before others: each pixel shows it,
/// or what it shows without it.
inline void try_nearest_faces(generate::Random& random) {
  generate::Faces faces;
  for (std::uint64_t n = 1 + random.below(4); n > 0; --n) {
    const Rational depth = generate::integer(random, 2, 9);
    generate::Points face;
    for (int c = 0; c < 3; ++c)
      face.push_back({generate::integer(random, -9, 9), generate::integer(random, -9, 9), Rational(-depth)});
    if (spans_a_plane(face)) faces.push_back(face);
  }
  const bool in_floats = random.chance(1, 2);
  const Rational near =
      generate::power_of_two(-static_cast<int>(in_floats ? random.between(110, 155) : random.between(1000, 1085)));
  generate::Faces more = faces;
  more.insert(more.begin(), {{-1, -1, Rational(-near)}, {1, -1, Rational(-near)}, {0, 1, Rational(-near)}});
  const Pixel_view view{{0, 0, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, 6, 6};
  const Image_kernel kernel = in_floats ? Image_kernel::float_numbers : Image_kernel::double_numbers;
  const Scene without(generate::soup_of(faces)), with(generate::soup_of(more));
  const Piece_image image = scan_line(without, view, kernel), other = scan_line(with, view, kernel);
  for (std::size_t k = 0; k < image.pieces.size(); ++k) {
    const auto face_of = [](const Scene& scene, std::uint32_t piece) {
      return piece == Piece_image::nothing ? Face_id{1000} : scene.pieces()[piece].face;
    };
    const Face_id shown = face_of(without, image.pieces[k]), now = face_of(with, other.pieces[k]);
    require(now == 0 || now == (shown == 1000 ? shown : shown + 1), "a face more is shown, or changes no pixel");
  }
}

inline void sure_doubles(std::string_view bytes) {
  static constexpr std::array<void (*)(generate::Random&), 9> laws{
      try_bisector,   try_near_shaft,    try_near_shaft, try_chart_bounds,     try_chart_bounds,
      try_flat_views, try_nearest_faces, try_kept_away,  try_lines_from_beside};
  ask_one_of(laws, bytes);
}

}  // namespace fuzz
