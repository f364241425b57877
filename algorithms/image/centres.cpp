#include <sightline/algorithms/image/centres.h>

#include <sightline/algorithms/image/bands.h>
#include <sightline/algorithms/image/pixel_cones.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/vectors.h>

#include <span>
#include <tuple>
#include <utility>

namespace sightline {

namespace image_detail {

/// The plane of a piece's edge, its front inside as the eye sees the piece.
Exact_view::Plane inwards(const Exact_view& view, std::uint32_t piece, std::uint32_t edge) {
  const std::span<const Piece_corner> corners = view.scene().corners(view.scene().pieces()[piece]);
  const std::uint32_t p = corners[edge].point, q = corners[edge + 1 == corners.size() ? 0 : edge + 1].point;
  // Counterclockwise around it, an edge of a front has what it bounds behind it.
  return view.eye_side(piece) == CGAL::POSITIVE ? view.edge(q, p) : view.edge(p, q);
}

namespace {

/// 1 / t of a piece at the places of the image.
struct Nearness {
  std::uint32_t piece;
  Pixel_form form;
};

/// What was met first so far in a row.
struct Met {
  double nearness = 0, bound = 0;
  std::uint32_t cone = Piece_image::nothing;
  bool tied = false;
};

class Centres {
 public:
  Centres(const Exact_view& view, const Pixel_view& pixels) : view_(view), centres_(pixels), cones_(centres_, {}) {
    std::vector<std::uint32_t> seen;
    for (std::uint32_t i = 0; i < view.scene().pieces().size(); ++i)
      if (view.eye_side(i) != CGAL::ZERO) seen.push_back(i);
    nearness_.reserve(seen.size());
    for (const std::uint32_t piece : seen) nearness_.push_back({piece, Pixel_form(centres_, view.nearness(piece))});
    const auto normal = [this](std::uint32_t cone, std::uint32_t edge) {
      return view_.normal(inwards(view_, nearness_[cone].piece, edge));
    };
    cones_ = all_cones(seen.size(), Pixel_cones(centres_, normal), [&](Pixel_cones& to, std::size_t i) {
      const std::span<const Piece_corner> corners = view.scene().corners(view.scene().pieces()[seen[i]]);
      std::vector<Approximate_vector> directions;
      for (const Piece_corner& corner : corners) directions.push_back(view.approximate(view.ray(corner.point)));
      to.add(directions);
      for (std::uint32_t e = 0; e < corners.size(); ++e)
        to.add_edge(Pixel_form(centres_, view.approximate(inwards(view, seen[i], e))));
    });
  }

  Piece_image image(const Image_options& options) const {
    const Pixel_view& pixels = centres_.view();
    Piece_image image{pixels.width, pixels.height, {}, {}, {}};
    image.pieces.assign(std::size_t{pixels.width} * pixels.height, Piece_image::nothing);
    image.tied.assign(image.pieces.size(), 0);
    image.counters = draw_bands(bands_of(cones_), options, [&](const Band& band, Image_counters& counters) {
      std::vector<Met> row;
      for (std::int64_t y = band.top; y < band.bottom; ++y) {
        row.assign(pixels.width, {});
        for (const std::uint32_t cone : band.cones)
          if (cones_[cone].top <= y && y < cones_[cone].bottom) draw(row, cone, y, counters);
        for (std::uint32_t x = 0; x < pixels.width; ++x) {
          if (row[x].cone == Piece_image::nothing) continue;
          const std::size_t at = image.pixel(x, static_cast<std::uint32_t>(y));
          image.pieces[at] = nearness_[row[x].cone].piece;
          image.tied[at] = row[x].tied;
        }
      }
    });
    image.counters.edge_on = view_.scene().pieces().size() - nearness_.size();
    image.counters.drawn = cones_.size();
    return image;
  }

 private:
  void draw(std::vector<Met>& row, std::uint32_t cone, std::int64_t y, Image_counters& counters) const {
    const Pixel_form& form = nearness_[cone].form;
    const double k = form.at_row(centres_.upwards(y));
    cones_.row(cone, y, counters, [&](std::int64_t x, bool on_border) {
      Met& met = row[static_cast<std::size_t>(x)];
      const Met here{form.a * centres_.across(x) + k, form.bound, cone, on_border};
      const double more = here.nearness - met.nearness, bound = here.bound + met.bound;
      if (met.cone == Piece_image::nothing || more > bound) {
        met = here;
      } else if (!(more < -bound)) {
        const int nearer = exact_nearer(cone, met.cone, x, y, counters);
        if (nearer > 0 || (nearer == 0 && before(cone, met.cone))) met = here;
        if (nearer == 0) met.tied = true;
      }
    });
  }

  int exact_nearer(std::uint32_t a, std::uint32_t b, std::int64_t x, std::int64_t y, Image_counters& counters) const {
    ++counters.exact_depths;
    const std::uint32_t f = nearness_[a].piece, g = nearness_[b].piece;
    if (view_.same_plane(f, g)) return 0;
    return sgn(dot(view_.normal(view_.crossing(f, g)), centres_.exact(x, y)));
  }

  bool before(std::uint32_t a, std::uint32_t b) const {
    const auto key = [&](std::uint32_t cone) {
      const Piece& piece = view_.scene().pieces()[nearness_[cone].piece];
      return std::tuple(view_.eye_side(nearness_[cone].piece) != CGAL::POSITIVE, piece.face, piece.number);
    };
    return key(a) < key(b);
  }

  const Exact_view& view_;
  Pixel_centres centres_;
  std::vector<Nearness> nearness_;  // of each cone
  Pixel_cones cones_;
};

}  // namespace

}  // namespace image_detail

Piece_image centres(const Exact_view& view, const Pixel_view& pixels, const Image_options& options) {
  Piece_image image;
  run_with_threads(options.threads, [&] { image = image_detail::Centres(view, pixels).image(options); });
  return image;
}

}  // namespace sightline
