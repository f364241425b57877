#pragma once
// How wrong an answer is, as `compare` measures it: answers that are right, and such as are wrong by what is known,
// against definitions.

#include "support.h"

#include <sightline/algorithms/baseline/depth_buffer.h>
#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/kernels.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/harness/compare/cell_sights.h>
#include <sightline/harness/compare/cut_set_errors.h>
#include <sightline/harness/compare/flat_polygon.h>
#include <sightline/harness/compare/image_errors.h>
#include <sightline/harness/compare/order_errors.h>
#include <sightline/harness/compare/screen_sizes.h>
#include <sightline/harness/compare/visible_errors.h>
#include <sightline/harness/compare/weak_errors.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/pixel_views.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/fuzz.h>
#include <sightline/kernel/scene/face_graph.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/sightline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

namespace fuzz {

namespace measuring {

using generate::Points;
using generate::Random;
using harness::Flat_face;

/// A small scene of a family, and an eye.
inline std::optional<harness::Posed_scene> any_scene(Random& random, std::size_t most_pieces) {
  const std::vector<generate::Family>& families = generate::families();
  harness::Posed_scene posed = harness::make(harness::draw_case(families[random.below(families.size())], random));
  const Scene scene(posed.soup);
  if (scene.pieces().empty() || scene.pieces().size() > most_pieces) return std::nullopt;
  return posed;
}

/// Below it doubles have fewer digits.
constexpr double least_size = 1e-300;

inline bool is_near(double a, double b, double allowed) { return std::fabs(a - b) <= allowed; }

// ---- Images

inline void try_images(Random& random) {
  constexpr std::size_t width = 5, height = 4;
  constexpr std::uint32_t nothing = Piece_image::nothing;
  const std::optional<harness::Posed_scene> posed = any_scene(random, 12);
  if (!posed) return;
  const Scene scene(posed->soup);
  Piece_image truth, image;
  for (Piece_image* made : {&truth, &image}) {
    made->width = width;
    made->height = height;
  }
  for (std::size_t k = 0; k < width * height; ++k) {
    const auto any = [&] {
      return random.chance(1, 4) ? nothing : static_cast<std::uint32_t>(random.below(scene.pieces().size()));
    };
    truth.pieces.push_back(any());
    image.pieces.push_back(random.chance(1, 2) ? truth.pieces.back() : any());
    truth.tied.push_back(random.chance(1, 5));
  }
  const auto face = [&](std::uint32_t piece) -> std::optional<Face_id> {
    if (piece == nothing) return std::nullopt;
    return scene.pieces()[piece].face;
  };
  std::uint64_t wrong = 0, tied = 0;
  std::set<Face_id> covered, shown, seen;
  std::map<Face_id, std::uint64_t> expected;
  for (std::size_t k = 0; k < width * height; ++k) {
    const std::optional<Face_id> is = face(truth.pieces[k]), said = face(image.pieces[k]);
    if (said) seen.insert(*said);
    if (truth.tied[k] != 0) {
      ++tied;
      continue;
    }
    if (is) ++expected[*is];
    if (is == said) continue;
    ++wrong;
    if (is) covered.insert(*is);
    if (said) shown.insert(*said);
  }
  std::uint64_t missing = 0, largest = 0;
  for (const auto& [f, pixels] : expected)
    if (seen.count(f) == 0) {
      ++missing;
      largest = std::max(largest, pixels);
    }
  const Image_errors found = image_errors(scene, truth, image);
  require(found.pixels == width * height && found.wrong == wrong && found.tied == tied,
          "pixels of an image are wrong where they show another face, and no tie");
  require(found.missing == missing && found.largest_missing == largest,
          "a face is missing iff it has pixels off ties and the image shows it nowhere");
  require(found.covered == std::vector<Face_id>(covered.begin(), covered.end()) &&
              found.shown == std::vector<Face_id>(shown.begin(), shown.end()),
          "faces of wrong pixels are named");
}

inline void try_colours(Random& random) {
  const auto layer = [&] {
    Layer made{};
    for (double& x : made.colour) x = static_cast<double>(random.below(256));
    made.alpha = static_cast<double>(random.below(17)) / 16;
    return made;
  };
  Blended_image truth, image;
  double largest = 0, sum = 0;
  std::uint64_t wrong = 0, tied = 0;
  Mean_errors means;
  for (std::size_t k = random.below(12); k > 0; --k) {
    const Layer is = layer();
    Layer said = is;
    const std::size_t channel = random.below(5);
    double off = static_cast<double>(random.between(-3, 3)) / 4;
    if (random.chance(1, 4)) off = 40;
    if (channel < 3) said.colour[channel] += off;
    else if (channel == 3) said.alpha += off / 256;
    else off = 0;
    const double by = channel == 3 ? 255 * std::fabs(said.alpha - is.alpha) : std::fabs(off);
    truth.layers.push_back(is);
    image.layers.push_back(said);
    truth.tied.push_back(random.chance(1, 4));
    means.add(is, said);
    require(difference(is, said) == by, "a colour is off by the channel that is most so");
    if (truth.tied.back() != 0) {
      ++tied;
      continue;
    }
    wrong += by > 0.5;
    largest = std::max(largest, by);
    sum += by;
  }
  const Colour_errors found = colour_errors(truth, image);
  const std::uint64_t off_ties = truth.layers.size() - tied;
  require(found.pixels == truth.layers.size() && found.tied == tied && found.wrong == wrong && found.largest == largest,
          "colours are wrong where they are off by more than half a step, and no tie");
  require(is_near(found.mean, off_ties == 0 ? 0 : sum / static_cast<double>(off_ties), 1e-9),
          "their mean error is that of pixels off ties");
  require(means.compared == truth.layers.size() && means.off >= wrong && means.largest >= largest &&
              is_near(means.mean() * static_cast<double>(means.compared), means.sum, 1e-9),
          "means over squares count each pixel");
}

// ---- Lists of faces

inline void try_weak_lists(Random& random) {
  const auto status = [&] { return random.below(4); };  // of each face: visible, hidden, undecided, set aside
  Weak_faces exact, said;
  Weak_errors wanted;
  for (Face_id f = 0; f < 12; ++f) {
    const std::uint64_t is = status(), answer = is == 3 ? 3 : random.below(3);
    std::array<std::vector<Face_id>*, 3> of_exact{&exact.visible, &exact.hidden, &exact.undecided},
        of_said{&said.visible, &said.hidden, &said.undecided};
    if (is < 3) of_exact[is]->push_back(f);
    if (answer < 3) of_said[answer]->push_back(f);
    wanted.wrongly_visible += is == 1 && answer == 0;
    wanted.wrongly_hidden += is == 0 && answer == 1;
    wanted.undecided += is < 2 && answer == 2;
    wanted.unjudged += is == 2;
  }
  const Weak_errors found = weak_errors(exact, said);
  require(found.wrongly_visible == wanted.wrongly_visible && found.wrongly_hidden == wanted.wrongly_hidden &&
              found.undecided == wanted.undecided && found.unjudged == wanted.unjudged,
          "faces of weak visibility are wrong as lists say");
}

inline void try_cut_sets(Random& random) {
  const std::optional<harness::Posed_scene> posed = any_scene(random, 20);
  if (!posed) return;
  const Scene scene(posed->soup);
  const Face_graph graph(scene);
  const Exact_traits traits(scene);
  const std::vector<Flat_face> faces = harness::flat_faces_of(scene);
  const bool at_infinity = random.chance(1, 2);
  const Exact_point at = random.chance(1, 2) ? posed->eye : harness::any_point(*posed, faces, random);
  const std::vector<bool> on = on_view_nodes(traits, graph, {at, at_infinity});
  std::vector<bool> said;
  std::size_t wrong = 0;
  for (std::uint32_t node = 0; node < graph.size(); ++node) {
    const Flat_face& face = faces[graph.piece(node)];
    require(on[node] == (at_infinity ? dot(face.normal, at) > 0 : face.height(at) > 0),
            "a node is on-view iff the viewpoint is in front of its face");
    said.push_back(random.chance(1, 4) ? !on[node] : on[node]);
    wrong += said[node] != on[node];
  }
  std::vector<std::uint32_t> cut;
  for (std::uint32_t e = 0; e < graph.edges().size(); ++e) {
    const bool is_cut = on[graph.edges()[e].first] != on[graph.edges()[e].second];
    const bool says_so = random.chance(1, 4) ? !is_cut : is_cut;
    if (says_so) cut.push_back(e);
    wrong += says_so != is_cut;
  }
  require(cut_set_errors(graph, on, said, cut) == wrong, "nodes and edges of a cut-set are wrong where they differ");
}

// ---- Polygons of the plane

using Flat_point = Flat_polygon::Point;

inline Rational turn(const Flat_point& a, const Flat_point& b, const Flat_point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// The area of a convex hull: of all triangles from one corner to edges of it, which have no point to the right.
inline Rational area_of_hull(const std::vector<Flat_point>& points) {
  Rational twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (points[i] == points[j]) continue;
      const bool is_edge = std::all_of(points.begin(), points.end(), [&](const Flat_point& p) {
        const Rational side = turn(points[i], points[j], p);
        if (side != 0) return side > 0;
        // On its line: the edge is the longest one.
        const auto along = [&](const Flat_point& q) {
          return Rational((q[0] - points[i][0]) * (points[j][0] - points[i][0]) +
                          (q[1] - points[i][1]) * (points[j][1] - points[i][1]));
        };
        return along(p) >= 0 && along(p) <= along(points[j]);
      });
      if (is_edge) twice += turn(points[0], points[i], points[j]);
    }
  return twice / 2;
}

inline void try_flat_polygons(Random& random) {
  const auto any_points = [&] {
    std::vector<Flat_point> points;
    const long denominator = static_cast<long>(random.between(1, 3));
    for (std::size_t k = 3 + random.below(5); k > 0; --k) {
      const Rational x = generate::ratio(static_cast<long>(random.between(-6, 6)), denominator),
                     y = generate::ratio(static_cast<long>(random.between(-6, 6)), denominator);
      if (std::find(points.begin(), points.end(), Flat_point{x, y}) == points.end()) points.push_back({x, y});
    }
    return points;
  };
  const std::vector<Flat_point> points = any_points();
  const Flat_polygon hull = Flat_polygon::hull(points), other = Flat_polygon::hull(any_points());
  const Rational whole = area_of_hull(points);
  require(hull.empty() == (whole == 0), "a hull is empty iff its points are on a line");
  if (hull.empty()) return;
  require(hull.area() == whole, "a hull has the area of its triangles");
  for (std::size_t k = 0; k < hull.lines().size(); ++k)
    require(std::find(points.begin(), points.end(), hull.vertex(k)) != points.end(), "a hull's corners are points");
  const Flat_polygon::Flat_line line{Integer(static_cast<long>(random.between(-3, 3))),
                                     Integer(static_cast<long>(random.between(-3, 3))),
                                     Integer(static_cast<long>(random.between(-9, 9)))};
  const auto value = [&](const Flat_point& p) { return Rational(line[0] * p[0] + line[1] * p[1] + line[2]); };
  if (line[0] != 0 || line[1] != 0) {
    const auto part_of = [&](int sign) {
      std::vector<Flat_point> kept;
      for (std::size_t k = 0; k < hull.lines().size(); ++k) {
        const Flat_point p = hull.vertex(k), q = hull.vertex((k + 1) % hull.lines().size());
        const Rational from = sign * value(p), to = sign * value(q);
        if (from >= 0) kept.push_back(p);
        if (sgn(from) * sgn(to) < 0) {
          const Rational t = from / (from - to);
          kept.push_back({Rational(p[0] + t * (q[0] - p[0])), Rational(p[1] + t * (q[1] - p[1]))});
        }
      }
      return kept;
    };
    require(hull.clipped(line).area() == area_of_hull(part_of(1)),
            "what is clipped has the area of one side of a line");
    require(hull.clipped(line).empty() == (area_of_hull(part_of(1)) == 0), "a part without area is empty");
  }
  // What is in one and not in the other, with what is in both.
  Flat_polygon both = hull;
  for (const Flat_polygon::Flat_line& side : other.lines()) both = both.clipped(side);
  Rational rest = 0;
  for (const Flat_polygon& part : hull.without(other)) {
    rest += part.area();
    Flat_polygon common = part;
    for (const Flat_polygon::Flat_line& side : other.lines()) common = common.clipped(side);
    require(other.empty() || common.empty(), "what is left of a polygon has nothing of the other one");
  }
  require(rest + (other.empty() || both.empty() ? Rational(0) : both.area()) == whole,
          "what is left of a polygon and what is in both are all of it");
}

// ---- Orders

/// Twice a polygon's area as its plane's dominant axis sees it.
inline Rational projected(const Points& corners, const Exact_point& normal) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (abs(normal[k]) > abs(normal[axis])) axis = k;
  return abs(Flat_face(corners).normal[axis]);
}

inline void try_orders(Random& random) {
  const std::optional<harness::Posed_scene> posed = any_scene(random, 8);
  if (!posed) return;
  const Scene scene(posed->soup);
  std::vector<Flat_face> faces = harness::flat_faces_of(scene);
  // 1. All pieces in any order.
  std::vector<std::size_t> places(faces.size());
  for (std::size_t k = 0; k < places.size(); ++k) places[k] = k;
  random.shuffle(places);
  std::vector<Order_fragment> order;
  Rational all = 0;
  for (const std::size_t k : places) {
    order.push_back({scene.pieces()[k].face, scene.pieces()[k].number, faces[k].corners});
    all += projected(faces[k].corners, faces[k].normal);
  }
  std::vector<Flat_face> to_eye;  // turned to the eye
  for (const std::size_t k : places) {
    const bool is_behind = faces[k].height(posed->eye) < 0;
    to_eye.emplace_back(is_behind ? generate::reversed(faces[k].corners) : faces[k].corners);
  }
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j)
      wrong += to_eye[i].height(posed->eye) > 0 && to_eye[j].height(posed->eye) > 0 &&
               harness::sees_over(posed->eye, to_eye[i], to_eye[j]);
  constexpr std::size_t most = 1000;
  const auto measured = [&] { return order_errors(scene, posed->eye, order, most); };
  const Order_errors found = measured();
  require(
      found.fragments == order.size() && found.pairs == order.size() * (order.size() - 1) / 2 && found.degenerate == 0,
      "each fragment and each pair of them is counted");
  require(found.wrong == wrong && found.wrong_beyond_rounding <= wrong,
          "a pair is wrong iff what is drawn earlier is nearer somewhere");
  require(found.lost == 0 && found.overlapping == 0 && found.outside == 0, "whole pieces are all that there is");
  // 2. One of them otherwise.
  const std::size_t chosen = random.below(order.size());
  Points& corners = order[chosen].vertices;
  const Exact_point normal = faces[places[chosen]].normal;
  const Rational whole = projected(corners, normal);
  const std::uint64_t kind = random.below(4);
  Rational lost = 0, overlapping = 0, outside = 0;
  if (kind == 0) {
    order.erase(order.begin() + static_cast<std::ptrdiff_t>(chosen));
    lost = whole;
  } else if (kind == 1) {
    order.push_back(order[chosen]);
    overlapping = whole;
  } else {
    const std::size_t k = random.below(corners.size());
    const Exact_point& before = corners[(k + corners.size() - 1) % corners.size()];
    if (kind == 3 && corners.size() > 3) return;
    corners[k] =
        generate::along(before, kind == 2 ? generate::ratio(1, 2) : generate::ratio(3, 2), minus(corners[k], before));
    const Rational now = projected(corners, normal);
    if (kind == 2) lost = whole - now;
    else outside = now - whole;
  }
  const Order_errors other = measured();
  require(other.lost * all == lost, "what no fragment holds is lost");
  require(other.overlapping * all == overlapping, "what two fragments hold overlaps");
  require(other.outside * all == outside, "what is beyond its face is outside");
}

// ---- Visible surfaces

inline std::array<double, 3> unit_of(const Exact_point& d) {
  const Rational size = std::max({Rational(abs(d[0])), Rational(abs(d[1])), Rational(abs(d[2]))});
  std::array<double, 3> v;
  for (std::size_t k = 0; k < 3; ++k) v[k] = nearest_double(Rational(d[k] / size));
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (double& x : v) x /= length;
  return v;
}

/// The solid angle of a convex cone of directions, by the angles between its sides. Ref: Girard
inline double angles_of(const Points& cone) {
  double sum = 2 * std::numbers::pi;
  for (std::size_t k = 0; k < cone.size(); ++k) {
    const Exact_point& ray = cone[k];
    const std::array<double, 3> before = unit_of(cross(cone[(k + cone.size() - 1) % cone.size()], ray)),
                                after = unit_of(cross(ray, cone[(k + 1) % cone.size()])), both = cross(before, after);
    sum -= std::atan2(std::sqrt(dot(both, both)), dot(before, after));
  }
  return sum;
}

inline void try_visible(Random& random) {
  constexpr double sphere = 4 * std::numbers::pi, rounding = 1e-6, nearly_none = 1e-10;
  const std::optional<harness::Posed_scene> posed = any_scene(random, 8);
  if (!posed) return;
  const Scene scene(posed->soup);
  const Exact_view view(scene, posed->eye);
  Visible_options options;
  options.threads = 1;
  const Visible_surface<Exact_view> surface = visible_surface(view, Piece_boxes(scene), options);
  Visible_reference reference(view, surface);
  const Visible_errors none = reference.errors(view, surface);
  require(none.wrong < nearly_none && none.gaps < nearly_none && none.overlaps < nearly_none &&
              none.tied < nearly_none && none.not_finite == 0,
          "an exact surface is not wrong by itself");
  require(none.wrongly_visible + none.wrongly_hidden + none.missing == 0, "its faces are not wrong by themselves");

  // One part otherwise, and lists.
  const auto share_of = [&](const Visible_surface<Exact_view>::Part& part) {
    Points cone;
    for (const Exact_view::Ray& ray : surface.of(part)) {
      const std::array<Integer, 3> d = view.direction(ray);
      cone.push_back({Rational(d[0]), Rational(d[1]), Rational(d[2])});
    }
    return angles_of(cone) / sphere;
  };
  Visible_surface<Exact_view> answer = surface;
  const std::size_t chosen = random.below(surface.parts.size());
  const auto part = surface.parts[chosen];
  const bool is_nothing = part.piece == surface.nothing;
  const double share = share_of(part);
  double wrong = 0, gaps = 0, overlaps = 0;
  const std::uint64_t kind = random.below(3);
  if (kind == 0) {
    answer.parts.erase(answer.parts.begin() + static_cast<std::ptrdiff_t>(chosen));
    gaps = share;
    if (!is_nothing) wrong = share;
  } else if (kind == 1) {
    answer.parts.push_back(part);
    overlaps = share;
  } else {
    const auto other = static_cast<std::uint32_t>(random.below(scene.pieces().size()));
    if (!is_nothing && (scene.pieces()[other].face == scene.pieces()[part.piece].face ||
                        scene.pieces()[other].support.id() == scene.pieces()[part.piece].support.id()))
      return;
    answer.parts[chosen].piece = other;
    wrong = share;
  }
  std::set<Face_id> exact(surface.visible.begin(), surface.visible.end()), said = exact;
  for (Face_id f = 0; f < posed->soup.face_count(); ++f)
    if (random.chance(1, 4) && said.erase(f) == 0) said.insert(f);
  answer.visible.assign(said.begin(), said.end());
  std::uint64_t wrongly_visible = 0, wrongly_hidden = 0;
  for (Face_id f = 0; f < posed->soup.face_count(); ++f) {
    wrongly_visible += said.count(f) > exact.count(f);
    wrongly_hidden += said.count(f) < exact.count(f);
  }
  std::set<Face_id> shown;
  for (const auto& of_answer : answer.parts)
    if (of_answer.piece != surface.nothing) shown.insert(scene.pieces()[of_answer.piece].face);
  std::map<Face_id, double> missing;
  for (const auto& of_surface : surface.parts) {
    if (of_surface.piece == surface.nothing || view.eye_side(of_surface.piece) != CGAL::POSITIVE) continue;
    const Face_id face = scene.pieces()[of_surface.piece].face;
    if (shown.count(face) == 0) missing[face] += share_of(of_surface);
  }
  double largest = 0;
  for (const auto& [face, of_face] : missing) largest = std::max(largest, of_face);
  const Visible_errors found = reference.errors(view, answer);
  require(is_near(found.wrong, wrong, rounding) && is_near(found.gaps, gaps, rounding) &&
              is_near(found.overlaps, overlaps, rounding) && found.tied < nearly_none,
          "a part that is left out, twice there, or another face's is wrong by its solid angle");
  require(found.wrongly_visible == wrongly_visible && found.wrongly_hidden == wrongly_hidden,
          "faces are wrongly visible and wrongly hidden as lists say");
  require(found.missing == missing.size() && is_near(found.largest_missing, largest, rounding),
          "a face is missing iff it is seen and no part shows it");
}

/// Pixels of a cube's sides, whatever they show: measured as pixels, and as cones.
inline void try_cube_pixels(Random& random) {
  constexpr double rounding = 1e-9;
  using Numbers = Number_view<CGAL::Gmpq>;
  const std::optional<harness::Posed_scene> posed = any_scene(random, 8);
  if (!posed) return;
  const Scene scene(posed->soup);
  const Exact_view view(scene, posed->eye);
  Visible_options options;
  options.threads = 1;
  const Visible_surface<Exact_view> surface = visible_surface(view, Piece_boxes(scene), options);
  Visible_reference reference(view, surface);
  Depth_buffer buffer;
  buffer.size = std::uint32_t{1} << random.below(3);
  Visible_surface<Numbers> cones;
  const Numbers numbers(scene, posed->eye);
  std::set<Face_id> visible;
  for (const Cube_side& side : cube_sides)
    for (std::uint32_t y = 0; y < buffer.size; ++y)
      for (std::uint32_t x = 0; x < buffer.size; ++x) {
        const std::uint32_t piece =
            random.chance(1, 3) ? buffer.nothing : static_cast<std::uint32_t>(random.below(scene.pieces().size()));
        buffer.pieces.push_back(piece);
        if (piece != buffer.nothing && view.eye_side(piece) == CGAL::POSITIVE)
          visible.insert(scene.pieces()[piece].face);
        cones.parts.push_back({piece, 4, cones.rays.size()});
        for (const auto& [right, up] : {std::array<std::uint32_t, 2>{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}) {
          const std::array<int, 3> image{static_cast<int>(2 * right) - static_cast<int>(buffer.size),
                                         static_cast<int>(2 * up) - static_cast<int>(buffer.size),
                                         static_cast<int>(buffer.size)};
          std::array<CGAL::Gmpq, 3> ray;
          for (std::size_t k = 0; k < 3; ++k) ray[side.axis[k]] = CGAL::Gmpq(side.sense[k] * image[k]);
          cones.rays.push_back({ray, Eye_plane_name::axis(0), Eye_plane_name::axis(1)});
        }
      }
  cones.visible.assign(visible.begin(), visible.end());
  const Visible_errors pixels = reference.errors(buffer), parts = reference.errors(numbers, cones);
  require(is_near(pixels.wrong, parts.wrong, rounding) && is_near(pixels.tied, parts.tied, rounding),
          "pixels are as wrong as the cones that they fill");
  require(parts.gaps < rounding && parts.overlaps < rounding && pixels.gaps == 0 && pixels.overlaps == 0,
          "pixels leave no gap");
  require(pixels.wrongly_visible == parts.wrongly_visible && pixels.wrongly_hidden == parts.wrongly_hidden &&
              pixels.missing == parts.missing && is_near(pixels.largest_missing, parts.largest_missing, rounding),
          "pixels show the faces that their cones do");
}

/// What faces have of an image, in pixels.
inline void try_seen_areas(Random& random) {
  constexpr double rounding = 1e-6;
  const std::optional<harness::Posed_scene> posed = any_scene(random, 8);
  if (!posed) return;
  const Scene scene(posed->soup);
  const Pixel_view pixels = generate::any_pixel_view(posed->soup, posed->eye, random);
  const Exact_view view(scene, posed->eye, field_of(pixels));
  Visible_options options;
  options.threads = 1;
  const Visible_surface<Exact_view> surface = visible_surface(view, Piece_boxes(scene), field_of_view(view), options);
  const auto exact_vector = [](const std::array<double, 3>& v) {
    return Exact_point{exact(v[0]), exact(v[1]), exact(v[2])};
  };
  const Exact_point right = exact_vector(pixels.right), up = exact_vector(pixels.up), look = exact_vector(pixels.look);
  const Rational all = dot(right, cross(up, look));
  std::vector<double> wanted(posed->soup.face_count());
  std::set<Face_id> seen;
  for (const auto& part : surface.parts) {
    if (part.piece == surface.nothing) continue;
    // A ray is (x right + y up + look) times a number: Cramer's rule.
    std::vector<Flat_point> corners;
    for (const Exact_view::Ray& ray : surface.of(part)) {
      const std::array<Integer, 3> d = view.direction(ray);
      const Exact_point v{Rational(d[0]), Rational(d[1]), Rational(d[2])};
      const Rational depth = dot(right, cross(up, v)) / all;
      corners.push_back(
          {Rational(dot(v, cross(up, look)) / all / depth), Rational(dot(right, cross(v, look)) / all / depth)});
    }
    Rational twice = 0;
    for (std::size_t k = 2; k < corners.size(); ++k) twice += turn(corners[0], corners[k - 1], corners[k]);
    const Face_id face = scene.pieces()[part.piece].face;
    wanted[face] += std::fabs(nearest_double(twice)) / 8 * pixels.width * pixels.height;
    seen.insert(face);
  }
  const std::vector<double> found = seen_areas(view, surface, pixels);
  for (Face_id f = 0; f < posed->soup.face_count(); ++f) {
    require((found[f] > 0) == (seen.count(f) > 0), "a face has an area in an image iff a part shows it");
    require(is_near(found[f], wanted[f], rounding * (1 + wanted[f])), "a face has the area of its parts in an image");
  }
}

// ---- Areas

/// The root of a rational, or less by up to 2^-100 of it.
inline Rational root_below(const Rational& square) {
  const long size =
                 (static_cast<long>(bit_length(square.get_num())) - static_cast<long>(bit_length(square.get_den()))) /
                 2,
             places = 101 - size;
  const Rational scaled = times_power(square, 2 * places);
  return times_power(Rational(Integer(sqrt(Integer(scaled.get_num() / scaled.get_den())))), -places);
}

/// Areas of faces and of all of a scene: within the bounds that are told, and to nearly all digits of doubles.
inline void try_areas(Random& random) {
  constexpr double digits = 1e-12, least_area = 1e-290;
  const std::optional<harness::Posed_scene> posed = any_scene(random, 12);
  if (!posed) return;
  const Model model(posed->soup);
  const Scene scene(posed->soup);
  std::map<Face_id, Rational> areas;
  const std::vector<Flat_face> faces = harness::flat_faces_of(scene);
  for (std::size_t k = 0; k < faces.size(); ++k)
    areas[scene.pieces()[k].face] += root_below(dot(faces[k].normal, faces[k].normal)) / 2;
  Polygon_soup flat;  // of planar faces the loops have the areas of the pieces
  for (const Flat_face& face : faces) flat.add_face(generate::added(flat, face.corners));
  Rational all = 0;
  for (Face_id f = 0; f < posed->soup.face_count(); ++f) {
    all += areas[f];
    const double wanted = nearest_double(areas[f]), found = model.area(f);
    if (std::isinf(wanted)) require(std::isinf(found), "an area that doubles do not hold is infinite");
    else require(is_near(found, wanted, digits * wanted + least_area), "a face has the area of its pieces");
  }
  const auto [low, high] = area(flat);
  const Rational above = all + times_power(all, -99);
  require(!(low > 0) || std::isinf(low) || exact(low) <= above, "an area is at least its lower bound");
  require(std::isinf(high) || exact(high) >= all, "an area is at most its upper bound");
  const double near_all = nearest_double(all);
  if (near_all < 1e300) require(high - low <= digits * near_all + least_area, "bounds of an area are close");
}

// ---- Cells of a level

inline void try_cell_sights(Random& random) {
  constexpr std::size_t most_cells = 12;
  const std::optional<harness::Posed_scene> posed = any_scene(random, 8);
  if (!posed) return;
  Cell_options one;
  one.threads = 1;
  const Level_cells level(posed->soup, one);
  if (level.cells().empty() || level.cells().size() > most_cells) return;
  const Occluders occluders(level.scene());
  const Model model(posed->soup);
  Cell_sights sights(level, occluders, model);
  const auto cell = static_cast<Cell_id>(random.below(level.cells().size()));
  const Level_cell& of_level = level.cells()[cell];
  if (of_level.is_solid) return;
  const std::vector<Flat_face> faces = harness::flat_faces_of(level.scene());
  std::vector<Face_id> asked;
  for (Face_id f = 0; f < posed->soup.face_count(); ++f)
    if (!std::binary_search(of_level.faces.begin(), of_level.faces.end(), f) && random.chance(2, 3)) asked.push_back(f);
  std::set<Face_id> found;
  for (const Cell_sightline& line : sights.sightlines(cell, asked, {})) {
    require(std::binary_search(asked.begin(), asked.end(), line.face) && found.insert(line.face).second,
            "each face that is asked for has one sightline at most");
    require(level.at(line.from) == cell, "a sightline begins in its cell");
    const Exact_point way = minus(line.to, line.from);
    bool ends = false;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      ends = ends ||
             (level.scene().pieces()[k].face == line.face && faces[k].holds(line.to) && faces[k].height(line.from) > 0);
      const std::optional<Rational> t = harness::met_at(faces[k], line.from, way);
      require(!t || *t >= 1, "nothing is met on a sightline");
    }
    require(ends, "a sightline ends on its face, from its front");
  }
  // What the middle sees of faces, it has sightlines to.
  const Exact_point middle = level.inside(cell);
  for (const Face_id f : asked) {
    const Seen_face seen = sights.seen(middle, f, {});
    require(seen.pixels <= sights.size_alone(cell, f) * (1 + 1e-6) + least_size,
            "a cell's middle sees no more of a face than there is");
    require(seen.pixels == 0 || found.count(f) > 0, "what a cell's middle sees has a sightline");
  }
}

// ---- Sizes

inline void try_sizes(Random& random) {
  constexpr double rounding = 1e-6;
  const std::optional<harness::Posed_scene> posed = any_scene(random, 8);
  if (!posed) return;
  const Model model(posed->soup);
  const std::map<Face_id, Seen_face> seen = seen_faces(model, posed->eye);
  const Scene scene(posed->soup);
  std::map<Face_id, double> alone;
  for (std::size_t k = 0; k < scene.pieces().size(); ++k) {
    const Flat_face face = harness::flat_faces_of(scene)[k];
    if (face.height(posed->eye) <= 0) continue;
    Points cone;
    for (const Exact_point& p : face.corners) cone.push_back(minus(p, posed->eye));
    alone[scene.pieces()[k].face] += angles_of(cone);
  }
  double all = 0;
  for (Face_id f = 0; f < posed->soup.face_count(); ++f) {
    const double size = size_alone(model, posed->eye, f) * pixel_angle;
    require(is_near(size, alone.count(f) > 0 ? alone.at(f) : 0, rounding),
            "a face alone is as large as its angles say");
    if (seen.count(f) == 0) continue;
    const Seen_face& of_face = seen.at(f);
    all += of_face.pixels * pixel_angle;
    require(of_face.pixels * pixel_angle <= size * (1 + rounding) + least_size,
            "no more is seen of a face than there is");
    require(of_face.width >= 0 && of_face.width <= 2 * std::numbers::pi, "what is seen has a width");
  }
  require(all <= 4 * std::numbers::pi * (1 + rounding), "no more is seen than all directions");
  Screen_sizes sizes;
  std::array<std::size_t, 5> counts{};
  double largest = 0;
  for (std::size_t k = random.below(9); k > 0; --k) {
    const double pixels =
        std::pow(10.0, static_cast<double>(random.below(5))) + static_cast<double>(random.between(-1, 1));
    std::size_t at = 0;
    for (const double bound : {1, 10, 100, 1000}) at += pixels >= bound;
    ++counts[at];
    largest = std::max(largest, pixels);
    sizes.add(pixels);
  }
  require(sizes.counts == counts && sizes.largest == largest, "sizes are counted from each bound on");
}

}  // namespace measuring

inline void measures(std::string_view bytes) {
  Bytes from(bytes);
  const std::size_t kind = from.below(13);
  generate::Random random(from.word());
  if (kind == 0) measuring::try_images(random);
  else if (kind == 1) measuring::try_colours(random);
  else if (kind == 2) measuring::try_weak_lists(random);
  else if (kind == 3) measuring::try_cut_sets(random);
  else if (kind == 4) measuring::try_flat_polygons(random);
  else if (kind == 5) measuring::try_sizes(random);
  else if (kind == 6) measuring::try_visible(random);
  else if (kind == 7) measuring::try_cube_pixels(random);
  else if (kind == 8) measuring::try_seen_areas(random);
  else if (kind == 9) measuring::try_cell_sights(random);
  else if (kind == 10) measuring::try_areas(random);
  else measuring::try_orders(random);
}

}  // namespace fuzz
