#pragma once
// What `compare` measures of views: visible surfaces, pixels of a cube, areas in an image, what cells of a level see,
// and sizes, for answers that are right and such as are wrong by what is known.

#include "measured_flat.h"

#include <sightline/algorithms/baseline/depth_buffer.h>
#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/kernels.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/harness/compare/cell_sights.h>
#include <sightline/harness/compare/image_errors.h>
#include <sightline/harness/compare/screen_sizes.h>
#include <sightline/harness/compare/visible_errors.h>
#include <sightline/harness/generate/pixel_views.h>
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
#include <vector>

namespace fuzz::measuring {

// ---- Visible surfaces

inline Visible_options alone() {
  Visible_options options;
  options.threads = 1;
  return options;
}

/// What an eye sees, and what measures answers by it.
struct Seen_exactly {
  Scene scene;
  Exact_view view;
  Visible_surface<Exact_view> surface;
  Visible_reference reference;

  explicit Seen_exactly(const harness::Posed_scene& posed)
      : scene(posed.soup),
        view(scene, posed.eye),
        surface(visible_surface(view, Piece_boxes(scene), alone())),
        reference(view, surface) {}
};

inline void try_visible(Random& random) {
  constexpr double sphere = 4 * std::numbers::pi, rounding = 1e-6, nearly_none = 1e-10;
  const std::optional<harness::Posed_scene> posed = any_scene(random, 8);
  if (!posed) return;
  Seen_exactly seen(*posed);
  const Scene& scene = seen.scene;
  const Exact_view& view = seen.view;
  const Visible_surface<Exact_view>& surface = seen.surface;
  const Visible_errors none = seen.reference.errors(view, surface);
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
  const Visible_errors found = seen.reference.errors(view, answer);
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
  Seen_exactly seen(*posed);
  const Scene& scene = seen.scene;
  const Exact_view& view = seen.view;
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
  const Visible_errors pixels = seen.reference.errors(buffer), parts = seen.reference.errors(numbers, cones);
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
  const Visible_surface<Exact_view> surface = visible_surface(view, Piece_boxes(scene), field_of_view(view), alone());
  const Exact_point right = exact(pixels.right), up = exact(pixels.up), look = exact(pixels.look);
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

}  // namespace fuzz::measuring
