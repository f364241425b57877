#pragma once
// How wrong an answer is, as `compare` measures it: answers that are right, and such as are wrong by what is known,
// against definitions.

#include "measured_flat.h"
#include "measured_views.h"
#include "support.h"

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/harness/compare/cut_set_errors.h>
#include <sightline/harness/compare/image_errors.h>
#include <sightline/harness/compare/order_errors.h>
#include <sightline/harness/compare/weak_errors.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/kernel/scene/face_graph.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/sightline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

namespace fuzz {

namespace measuring {

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

/// Whether a scene's coordinates and a point's are integers below 2^bits. Then a face of up to 16 corners has a normal
/// below 2^(2 bits + 6), and heights are sums below 2^(3 bits + 10).
inline bool are_small_integers(const Polygon_soup& soup, const Exact_point& point, int bits) {
  const auto is_small = [&](const Rational& x) { return x.get_den() == 1 && abs(x.get_num()) < Integer(1) << bits; };
  const auto all_small = [&](const Exact_point& p) { return std::all_of(p.begin(), p.end(), is_small); };
  for (Point_id p = 0; p < soup.point_count(); ++p)
    if (!all_small(soup.point(p))) return false;
  for (Face_id f = 0; f < soup.face_count(); ++f)
    if (soup.loop(f).size() > 16) return false;
  return all_small(point);
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
  const Viewpoint view{at, at_infinity};
  if (are_small_integers(posed->soup, at, 12))
    require(Rounded_planes<double>(graph).on_view(view) == on, "of small integers doubles tell what is on-view");
  if (are_small_integers(posed->soup, at, 3))
    require(Rounded_planes<float>(graph).on_view(view) == on, "of very small integers floats tell what is on-view");
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
  if (order[chosen].vertices.size() > 3 && random.chance(1, 3)) {  // its loop crosses itself
    std::swap(order[chosen].vertices[0], order[chosen].vertices[1]);
    const Order_errors crossed = measured();
    require(crossed.degenerate == 1 && crossed.wrong <= wrong, "a fragment whose loop crosses itself is degenerate");
    require(crossed.lost == 0 && crossed.outside == 0, "and stands for its hull");
    return;
  }
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

// ---- Areas

/// The root of a rational, or less by up to 2^-100 of it.
inline Rational root_below(const Rational& square) {
  const long places = 101 - binary_exponent(square) / 2;
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
