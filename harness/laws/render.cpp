#include <sightline/harness/laws/render.h>

#include <sightline/algorithms/baseline/depth_buffer.h>
#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/algorithms/image/blend.h>
#include <sightline/algorithms/image/bsp2d.h>
#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/layers.h>
#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/image/newell.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/image/scan_line.h>
#include <sightline/algorithms/image/warnock.h>
#include <sightline/algorithms/image/weiler_atherton.h>
#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/certificate.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/priority/eye_order.h>
#include <sightline/algorithms/priority/tree.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/harness/compare/pixel_squares.h>
#include <sightline/harness/generate/pixel_views.h>
#include <sightline/harness/laws/depth_laws.h>
#include <sightline/harness/laws/few_bits.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/images.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/harness/laws/manners.h>
#include <sightline/harness/laws/met_pieces.h>
#include <sightline/harness/laws/questions.h>
#include <sightline/harness/laws/window_laws.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sightline::harness {

namespace render_subject {

using namespace images;

/// A view along an axis, 90 degrees wide.
Pixel_view cube_view(const Exact_point& eye, const Cube_side& side) {
  Pixel_view pixels{eye, {}, {}, {}, 9, 9};
  pixels.right[side.axis[0]] = side.sense[0];
  pixels.up[side.axis[1]] = side.sense[1];
  pixels.look[side.axis[2]] = side.sense[2];
  return pixels;
}

Answer shown(const Posed_scene& posed) {
  const Scene scene(posed.soup);
  const Exact_view view(scene, posed.eye);
  Answer answer;
  answer.labels.assign(posed.soup.face_count(), Answer::none);
  answer.planar = scene.counters().non_planar + scene.counters().no_simple_projection == 0;
  for (const Piece& piece : scene.pieces()) answer.labels[piece.face] = 0;
  for (const Cube_side& side : cube_sides) {
    const Piece_image image = centres(view, cube_view(posed.eye, side), serial());
    for (std::size_t i = 0; i < image.pieces.size(); ++i)
      if (image.pieces[i] != Piece_image::nothing && !image.tied[i])
        answer.labels[scene.pieces()[image.pieces[i]].face] = 1;
  }
  return answer;
}

// ---- Checks, each in a view of its own

using Surface = Visible_surface<Exact_view>;

Surface by_see(const Exact_view& view, Cones<Exact_view> cones) {
  Visible_options alone;
  alone.threads = 1;
  return visible_surface(view, Piece_boxes(view.scene()), std::move(cones), alone);
}
Surface by_clip_polygons(const Exact_view& view, Cones<Exact_view> cones) {
  Visible_options alone;
  alone.threads = 1;
  return weiler_atherton(view, std::move(cones), alone);
}
Surface by_two_trees(const Exact_view& view, Cones<Exact_view> cones) {
  Bsp2d_options alone;
  alone.threads = 1;
  return bsp2d(view, std::move(cones), alone).surface;
}

/// The parts of a surface whose closed cone holds a centre show what it shows.
Outcome by_parts(const Seen& seen, const Exact_view& view, const Surface& surface, const std::string& method) {
  const Piece_image truth = seen.truth();
  std::vector<std::vector<Exact_point>> rays;
  for (const auto& part : surface.parts) {
    std::vector<Exact_point>& own = rays.emplace_back();
    for (const Exact_view::Ray& ray : surface.of(part)) {
      const std::array<Integer, 3> d = view.direction(ray);
      own.push_back({Rational(d[0]), Rational(d[1]), Rational(d[2])});
    }
  }
  for (std::size_t i = 0; i < truth.pieces.size(); ++i) {
    if (truth.tied[i]) continue;
    const Exact_point d = seen.pixels.centre(static_cast<std::uint32_t>(i % seen.pixels.width),
                                             static_cast<std::uint32_t>(i / seen.pixels.width));
    bool found = false, agrees = false;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      bool inside = true;
      for (std::size_t r = 0; r < rays[k].size() && inside; ++r)
        inside = sgn(dot(d, cross(rays[k][r], rays[k][r + 1 == rays[k].size() ? 0 : r + 1]))) >= 0;
      found = found || inside;
      agrees = agrees || (inside && surface.parts[k].piece == truth.pieces[i]);
    }
    if (!agrees)
      return Outcome::failed(place(seen.pixels, i) + " shows " + name(truth.pieces[i]) + " to an exact ray, " +
                             (found ? "and another to " : "and is in no part of ") + method);
  }
  return {};
}

constexpr std::size_t worth_a_certificate = 2000;  // parts

Outcome see(const Seen& seen) {
  const Exact_view view(seen.scene, seen.pixels.eye, field_of(seen.pixels));
  return by_parts(seen, view, by_see(view, field_of_view(view)), "see");
}

/// A method that gives a visible surface: all around it has the faces of `see`, and a certificate; in the field parts
/// and paint show what exact rays do.
template <Surface (*method)(const Exact_view&, Cones<Exact_view>)>
Outcome by_surface(const Seen& seen) {
  const Exact_view view(seen.scene, seen.pixels.eye, field_of(seen.pixels));
  const Surface around = method(view, whole_sphere(view)), truth = by_see(view, whole_sphere(view));
  if (around.visible != truth.visible || around.from_behind != truth.from_behind)
    return Outcome::failed("other faces are visible to the method than to see");
  if (around.parts.size() <= worth_a_certificate) {
    const Verdict verdict = verify_visible(seen.soup, visible_certificate(view, around, view.eye()));
    if (!verdict.accepted) return Outcome::failed("its certificate is rejected: " + verdict.why);
  }
  const Surface inside = method(view, field_of_view(view));
  const Outcome parts = by_parts(seen, view, inside, "the method");
  if (parts.state != Outcome::State::passed) return parts;
  return same(seen.pixels, seen.truth(), paint(view, inside, seen.pixels, serial()), "the method", false);
}

Painted_polygon painted(const Exact_traits& traits, const Convex_polygon<Exact_traits>& polygon) {
  Painted_polygon made{polygon.piece, {}};
  for (const Corner<Exact_traits>& corner : polygon) made.corners.push_back(traits.position(*corner.vertex));
  return made;
}

/// The tree's fragments, farthest first.
std::vector<Painted_polygon> tree_order(const Seen& seen) {
  const Exact_traits traits(seen.scene);
  Bsp_options options;
  options.threads = 1;
  const auto tree = build_bsp(traits, options);
  std::vector<Painted_polygon> polygons;
  traverse(traits, tree, traits.eye(seen.pixels.eye), Direction::back_to_front,
           [&](const auto& fragment, Sign) { polygons.push_back(painted(traits, fragment.polygon)); });
  return polygons;
}

/// Faces from both sides by the priority graph, farthest first.
std::vector<Painted_polygon> graph_order(const Seen& seen) {
  const Exact_traits traits(seen.scene);
  const Priority_tree<Exact_traits> tree = build_priority_tree(traits, {true, false, {}});
  std::vector<Painted_polygon> polygons;
  for (const Convex_polygon<Exact_traits>& polygon : back_to_front(traits, tree, seen.pixels.eye).polygons)
    polygons.push_back(painted(traits, polygon));
  return polygons;
}

/// An order, painted.
template <std::vector<Painted_polygon> (*order)(const Seen&)>
Outcome by_order(const Seen& seen) {
  return same(seen.pixels, seen.truth(), paint(order(seen), seen.pixels, Image_kernel::exact, serial()), "the order",
              false);
}

/// A method that decides at centres, by the same rule where faces are tied, or, not `ties`, by whatever is painted
/// last.
template <Piece_image (*method)(const Scene&, const Pixel_view&, Image_kernel, const Image_options&), bool ties = true>
Outcome by_method(const Seen& seen) {
  return same(seen.pixels, seen.truth(), method(seen.scene, seen.pixels, Image_kernel::exact, serial()), "the method",
              ties);
}

/// Polygons sorted, compared and cut: in exact numbers there is a cut wherever one is needed.
Outcome by_newell(const Seen& seen) {
  const Newell_order order = newell_order(seen.scene, seen.pixels, Image_kernel::exact, serial());
  if (order.counters.unordered != 0) return Outcome::failed("polygons are painted without an order");
  return by_method<newell, false>(seen);
}

/// The heedless painters, by their words: of the pieces that a centre's ray meets the one whose key comes last is on
/// top. At some pixels.
Outcome heedless(const Seen& seen) {
  std::vector<Flat_face> faces;
  for (const Piece& piece : seen.scene.pieces()) faces.emplace_back(seen.scene.corner_points(piece));
  const Exact_point eye = seen.pixels.eye, look = exact(seen.pixels.look);
  for (const Painter_key key : {Painter_key::nearest, Painter_key::farthest, Painter_key::mean}) {
    const Piece_image image = heedless_painter(seen.scene, seen.pixels, key, Image_kernel::exact, serial());
    std::vector<Rational> keys;
    for (const Flat_face& face : faces) {
      std::vector<Rational> depths;
      Rational sum = 0;
      for (const Exact_point& p : face.corners) sum += depths.emplace_back(dot(minus(p, eye), look));
      const auto [least, most] = std::minmax_element(depths.begin(), depths.end());
      keys.push_back(key == Painter_key::nearest    ? *least
                     : key == Painter_key::farthest ? *most
                                                    : Rational(sum / static_cast<unsigned long>(depths.size())));
    }
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t i = (2 * k + 1) * image.pieces.size() / 16;
      const Exact_point ray = seen.pixels.centre(static_cast<std::uint32_t>(i % seen.pixels.width),
                                                 static_cast<std::uint32_t>(i / seen.pixels.width));
      std::uint32_t top = Piece_image::nothing;
      for (std::uint32_t f = 0; f < faces.size(); ++f)
        if ((top == Piece_image::nothing || keys[f] <= keys[top]) && faces[f].height(eye) != 0 &&
            met_at(faces[f], eye, ray))
          top = f;
      if (image.pieces[i] != top)
        return Outcome::failed(place(seen.pixels, i) + " shows " + name(image.pieces[i]) +
                               " by a heedless painter, not " + name(top) + ", whose key comes last");
    }
  }
  return {};
}

/// Tints of pieces, three of four let light through.
std::vector<Tint> glass(const Scene& scene) {
  std::vector<Tint> tints;
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i)
    tints.push_back({{double(i % 7), double(i % 5), double(i % 3)}, i % 4 == 3 ? 1 : 0.25 * (i % 4 + 1)});
  return tints;
}

/// What is visible at centres, and through that, one surface behind the other.
Blended_image by_surfaces_behind(const Seen& seen, const std::vector<Tint>& tints) {
  Blended_image image = Blended_image::empty(seen.pixels);
  const Exact_view view(seen.scene, seen.pixels.eye, field_of(seen.pixels));
  std::vector<double> alpha;
  for (const Tint& tint : tints) alpha.push_back(tint.alpha);
  const auto add = [&](const Visible_layer& layer) {
    const Piece_image shown = paint(view, layer.surface, seen.pixels, serial());
    for (std::size_t i = 0; i < shown.pieces.size(); ++i)
      if (shown.pieces[i] != Piece_image::nothing) image.layers[i].put_behind(tints[shown.pieces[i]]);
  };
  Visible_options alone;
  alone.threads = 1;
  visible_layers(view, Piece_boxes(seen.scene), field_of_view(view), alpha, add, alone);
  return image;
}

/// Layers that let light through, by spans, the tree, the graph, surfaces and newell, against those that rays meet.
Outcome by_layers(const Seen& seen) {
  const std::vector<Tint> tints = glass(seen.scene);
  const Blended_image truth = blended_centres(Exact_view(seen.scene, seen.pixels.eye), seen.pixels, tints, serial());
  const auto check = [&](const Blended_image& image, const std::string& method, bool ties) {
    for (std::size_t i = 0; i < truth.layers.size(); ++i) {
      if (truth.tied[i] && !ties) continue;
      double error = std::fabs(truth.layers[i].alpha - image.layers[i].alpha);
      for (std::size_t k = 0; k < 3; ++k)
        error = std::max(error, std::fabs(truth.layers[i].colour[k] - image.layers[i].colour[k]));
      if (!(error < 1e-9))
        return Outcome::failed(place(seen.pixels, i) + " has other layers by " + method + " than on an exact ray");
    }
    return Outcome();
  };
  const Outcome spans =
      check(blended_scan_line(seen.scene, seen.pixels, Image_kernel::exact, tints, serial()), "spans", true);
  if (spans.state != Outcome::State::passed) return spans;
  const Outcome tree =
      check(blended_painting(tree_order(seen), seen.pixels, Image_kernel::exact, tints, serial()), "the tree", false);
  if (tree.state != Outcome::State::passed) return tree;
  const Outcome graph =
      check(blended_painting(graph_order(seen), seen.pixels, Image_kernel::exact, tints, serial()), "the graph", false);
  if (graph.state != Outcome::State::passed) return graph;
  const Outcome surfaces = check(by_surfaces_behind(seen, tints), "surfaces behind one another", false);
  if (surfaces.state != Outcome::State::passed) return surfaces;
  const Newell_order sorted = newell_order(seen.scene, seen.pixels, Image_kernel::exact, serial());
  return check(blended_painting(sorted.polygons, seen.pixels, Image_kernel::exact, tints, serial()), "newell", false);
}

Colour opaque_colour(std::uint32_t piece) { return {piece % 2 + 1.0, piece % 3 * 1.0, 1}; }

/// The means of what a view sees; with glass, of all layers.
template <bool Transparent>
Mean_image means(const Seen& seen, const Pixel_view& pixels) {
  const Exact_view view(seen.scene, pixels.eye, field_of(pixels));
  if (Transparent) return blended_means(view, pixels, glass(seen.scene), serial());
  Visible_options alone;
  alone.threads = 1;
  const auto surface = visible_surface(view, Piece_boxes(seen.scene), field_of_view(view), alone);
  return visible_means(view, surface, pixels, opaque_colour, serial());
}

/// Some pixels' means are those of areas in rationals.
template <bool Transparent>
Outcome as_areas(const Seen& seen, const Pixel_view& pixels) {
  std::vector<Tint> tints = glass(seen.scene);
  if (!Transparent)
    for (std::uint32_t i = 0; i < tints.size(); ++i) tints[i] = {opaque_colour(i), 1};
  const Mean_image image = means<Transparent>(seen, pixels);
  const Pixel_squares squares(seen.scene, pixels);
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t i = (2 * k + 1) * image.covered.size() / 12;
    const Layer right =
        squares.mean(static_cast<std::uint32_t>(i % pixels.width), static_cast<std::uint32_t>(i / pixels.width), tints);
    double error = std::fabs(image.covered[i] - right.alpha);
    for (std::size_t c = 0; c < 3; ++c) error = std::max(error, std::fabs(image.colours[i][c] - right.colour[c]));
    if (!(error < 1e-6))
      return Outcome::failed(place(pixels, i) + " is off by " + std::to_string(error) + " from areas in rationals");
  }
  return {};
}

/// So in a view, and in one that is skew: its directions to the right and forward are next to one another.
template <bool Transparent>
Outcome in_squares(const Seen& seen) {
  const Outcome straight = as_areas<Transparent>(seen, seen.pixels);
  if (straight.state != Outcome::State::passed) return straight;
  Pixel_view skew = seen.pixels;
  for (std::size_t k = 0; k < 3; ++k) skew.right[k] = skew.look[k] / 2 + 0x1p-20 * skew.right[k];
  if (dot(exact(skew.look), cross(exact(skew.right), exact(skew.up))) == 0) return {};
  return as_areas<Transparent>(seen, skew);
}

/// Whether pixels of an image, those of its first columns and rows, have the means of four pixels each of a finer one.
Outcome quarters_of(const Mean_image& coarse, const Mean_image& fine, const Pixel_view& pixels, std::uint32_t columns,
                    std::uint32_t rows, std::uint32_t fine_width) {
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x) {
      const std::size_t i = y * pixels.width + x, first = 2 * y * fine_width + 2 * x;
      for (std::size_t k = 0; k < 3; ++k) {
        double sum = 0;
        for (const std::size_t at :
             {std::size_t{0}, std::size_t{1}, std::size_t{fine_width}, fine_width + std::size_t{1}})
          sum += fine.colours[first + at][k] / 4;
        if (!(std::fabs(sum - coarse.colours[i][k]) < 1e-7))
          return Outcome::failed(place(pixels, i) + " is not the mean of its quarters");
      }
    }
  return {};
}

/// The means of an image are those of four pixels each in one of twice its size.
template <bool Transparent>
Outcome refined(const Seen& seen) {
  Pixel_view twice = seen.pixels;
  twice.width *= 2;
  twice.height *= 2;
  const Mean_image coarse = means<Transparent>(seen, seen.pixels), fine = means<Transparent>(seen, twice);
  for (std::size_t i = 0; i < coarse.covered.size(); ++i)
    if (!(coarse.covered[i] > -1e-9 && coarse.covered[i] < 1 + 1e-8))
      return Outcome::failed(place(seen.pixels, i) + " is covered " + std::to_string(coarse.covered[i]) + " times");
  return quarters_of(coarse, fine, seen.pixels, seen.pixels.width, seen.pixels.height, twice.width);
}

/// The same of the upper left quarter of what is seen, in an image of its own: so up is up, and left is left.
template <bool Transparent>
Outcome quartered(const Seen& seen) {
  Pixel_view quarter = seen.pixels;
  for (std::size_t k = 0; k < 3; ++k) {
    quarter.right[k] /= 2;
    quarter.up[k] /= 2;
    quarter.look[k] += quarter.up[k] - quarter.right[k];
  }
  // Where doubles hold it exactly: a field whose sides are close to a line may be turned over by a rounding.
  for (std::size_t k = 0; k < 3; ++k)
    if (2 * quarter.right[k] != seen.pixels.right[k] || 2 * quarter.up[k] != seen.pixels.up[k] ||
        exact(quarter.look[k]) != exact(seen.pixels.look[k]) + exact(quarter.up[k]) - exact(quarter.right[k]))
      return Outcome::not_applicable();
  return quarters_of(means<Transparent>(seen, seen.pixels), means<Transparent>(seen, quarter), seen.pixels,
                     seen.pixels.width / 2, seen.pixels.height / 2, quarter.width);
}

}  // namespace render_subject

Subject render() {
  using namespace render_subject;
  Subject subject;
  subject.name = "render";
  subject.what = "images by exact rays, exact areas and orders, against each other";
  subject.answer = shown;
  subject.checks = {
      check_of("see", "a pixel's centre shows what the part of see around it shows", see),
      check_of("bsp", "the tree's fragments, painted, show what exact rays do", by_order<tree_order>),
      check_of("graph", "faces in the order of the priority graph, painted, show what exact rays do",
               by_order<graph_order>),
      check_of("newell", "polygons sorted, compared and cut show what exact rays do", by_newell),
      check_of("scan_line", "spans of rows show what exact rays do", by_method<scan_line>),
      check_of("warnock", "windows cut into four show what exact rays do", by_method<warnock>),
      check_of("weiler_atherton", "windows cut along the nearest polygon's edges show what see does",
               by_surface<by_clip_polygons>),
      check_of("bsp2d", "near to far, clipped by what is covered, shows what see does", by_surface<by_two_trees>),
      check_of("layers", "what lets light through is sorted as exact rays meet it", by_layers),
      check_of("refine", "a pixel's mean is that of its quarters", refined<false>),
      check_of("refine_layers", "so it is where faces let light through", refined<true>),
      check_of("quarter", "the upper left quarter of a field has the means of its pixels", quartered<false>),
      check_of("quarter_layers", "so it is where faces let light through", quartered<true>),
  };
  add_laws(subject, {"permute", "translate", "scale", "bystander"});
  // Behind the others, whose random numbers depend on their places.
  subject.checks.push_back(windows_check());
  subject.checks.push_back(check_of("heedless", "the heedless painters show what comes last by their keys", heedless));
  subject.checks.push_back(few_bits_check());
  subject.checks.push_back(check_of("squares", "a pixel's mean is that of areas in rationals", in_squares<false>));
  subject.checks.push_back(check_of("squares_layers", "so it is where faces let light through", in_squares<true>));
  subject.checks.push_back(depth_check());
  subject.checks.push_back(manners_check(questions_of_render()));
  subject.checks.push_back(definition_check());
  return subject;
}

}  // namespace sightline::harness
