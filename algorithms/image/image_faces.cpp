#include <sightline/algorithms/image/image_faces.h>

#include <sightline/algorithms/image/bands.h>
#include <sightline/algorithms/image/number_cones.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/vectors.h>

#include <optional>
#include <span>
#include <vector>

namespace sightline::image_detail {

namespace {

/// The plane of a piece's edge, its front inside as the eye sees the piece.
Exact_view::Plane inwards(const Exact_view& view, std::uint32_t piece, std::uint32_t edge) {
  const std::span<const Piece_corner> corners = view.scene().corners(view.scene().pieces()[piece]);
  const std::uint32_t p = corners[edge].point, q = corners[edge + 1 == corners.size() ? 0 : edge + 1].point;
  // Counterclockwise around it, an edge of a front has what it bounds behind it.
  return view.eye_side(piece) == CGAL::POSITIVE ? view.edge(q, p) : view.edge(p, q);
}

}  // namespace

Image_faces::Image_faces(const Exact_view& view, const Pixel_view& pixels, const Image_options& options)
    : scene_(view.scene()), centres_(pixels), cones_(centres_, {}) {
  add_all(view, options);
}

Image_faces::Image_faces(const Scene& scene, const Pixel_view& pixels, Image_kernel kernel,
                         const Image_options& options)
    : scene_(scene), centres_(pixels), cones_(centres_, {}) {
  if (kernel == Image_kernel::float_numbers) {
    add_all_in<float>(options);
  } else if (kernel == Image_kernel::double_numbers) {
    add_all_in<double>(options);
  } else {
    own_ = std::make_unique<const Exact_view>(scene, pixels.eye);
    add_all(*own_, options);
  }
}

void Image_faces::add_face(std::uint32_t piece, const Pixel_form& nearness, bool from_behind) {
  const Piece& its = scene_.pieces()[piece];
  faces_.push_back({piece, nearness, {from_behind, its.face, its.number}});
}

void Image_faces::add_all(const Exact_view& view, const Image_options& options) {
  for (std::uint32_t i = 0; i < scene_.pieces().size(); ++i)
    if (view.eye_side(i) != CGAL::ZERO)
      add_face(i, Pixel_form(centres_, view.nearness(i)), view.eye_side(i) == CGAL::NEGATIVE);
  const auto normal = [this, &view](std::uint32_t face, std::uint32_t edge) {
    return view.normal(inwards(view, piece(face), edge));
  };
  exact_crossing_ = [this, &view](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t f = piece(a), g = piece(b);
    if (view.same_plane(f, g)) return std::array<Integer, 3>{0, 0, 0};
    return view.normal(view.crossing(f, g));
  };
  cones_ = all_cones(faces_.size(), Pixel_cones(centres_, normal), options, [&](Pixel_cones& to, std::size_t i) {
    const std::uint32_t its = faces_[i].piece;
    const std::span<const Piece_corner> corners = scene_.corners(scene_.pieces()[its]);
    std::vector<Approximate_vector> directions;
    for (const Piece_corner& corner : corners) directions.push_back(view.approximate(view.ray(corner.point)));
    if (!to.add(directions)) return;
    for (std::uint32_t e = 0; e < corners.size(); ++e)
      to.add_edge(Pixel_form(centres_, view.approximate(inwards(view, its, e))));
  });
}

template <class Number>
void Image_faces::add_all_in(const Image_options& options) {
  const Number_image<Number> numbers(centres_.view());
  cones_ = Pixel_cones(centres_, no_normal);
  exact_crossing_ = no_normal;
  std::vector<Vector_of<Number>> points(scene_.points().size()), arms;
  parallel_for(points.size(),
               [&](std::size_t p) { points[p] = numbers.arm(scene_.position(static_cast<std::uint32_t>(p))); });
  for (std::uint32_t i = 0; i < scene_.pieces().size(); ++i) {
    if (options.progress) options.progress(0, scene_.pieces().size());
    arms.clear();
    for (const Piece_corner& corner : scene_.corners(scene_.pieces()[i])) arms.push_back(points[corner.point]);
    const std::optional<Number_plane<Number>> plane = numbers.plane(arms);
    if (!plane) continue;
    Vector_of<Number> q = plane->normal;
    for (Number& x : q) x /= plane->at_plane;
    const Pixel_form nearness = numbers.form(q);
    if (!numbers.is_finite(nearness) || !numbers.add(cones_, arms, *plane)) continue;
    add_face(i, nearness, plane->at_plane > 0);
  }
}

Image_counters Image_faces::counters() const {
  Image_counters counters;
  counters.edge_on = scene_.pieces().size() - faces_.size();
  counters.drawn = faces_.size();
  return counters;
}

Piece_image Image_faces::empty_image() const {
  const Pixel_view& pixels = centres_.view();
  Piece_image image{pixels.width, pixels.height, {}, {}, counters()};
  image.pieces.assign(std::size_t{pixels.width} * pixels.height, Piece_image::nothing);
  return image;
}

int Image_faces::exact_nearer(std::uint32_t a, std::uint32_t b, std::int64_t x, std::int64_t y,
                              Image_counters& counters) const {
  ++counters.exact_depths;
  const std::array<Integer, 3> normal = exact_crossing_(a, b);
  return is_zero(normal) ? 0 : sgn(dot(normal, centres_.exact(x, y)));
}

}  // namespace sightline::image_detail
