#include <sightline/harness/laws/met_pieces.h>

#include <sightline/algorithms/image/blend.h>
#include <sightline/algorithms/image/layers.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/harness/laws/images.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace sightline::harness {

namespace {

using namespace images;

struct Met_piece {
  Rational t;  // how far along the ray
  std::uint32_t piece;
  bool on_border;
};

/// Where a ray meets a closed piece whose plane it pierces.
std::optional<Met_piece> met(const Scene& scene, std::uint32_t piece, const Exact_point& eye, const Exact_point& ray) {
  std::vector<Exact_point> corners;
  for (const Piece_corner& corner : scene.corners(scene.pieces()[piece]))
    corners.push_back(minus(scene.position(corner.point), eye));
  Exact_point normal{0, 0, 0};
  for (std::size_t k = 1; k + 1 < corners.size() && normal == Exact_point{0, 0, 0}; ++k)
    normal = cross(minus(corners[k], corners[0]), minus(corners[k + 1], corners[0]));
  const Rational height = dot(normal, corners[0]), slope = dot(normal, ray);
  if (height == 0 || slope == 0 || sgn(height) != sgn(slope)) return std::nullopt;
  Met_piece found{height / slope, piece, false};
  const int inside = sgn(height);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const int side = sgn(dot(ray, cross(corners[k], corners[(k + 1) % corners.size()])));
    if (side == -inside) return std::nullopt;
    if (side == 0) found.on_border = true;
  }
  return found;
}

std::vector<Met_piece> all_met(const Seen& seen, const Exact_point& ray) {
  std::vector<Met_piece> all;
  for (std::uint32_t piece = 0; piece < seen.scene.pieces().size(); ++piece)
    if (std::optional<Met_piece> one = met(seen.scene, piece, seen.pixels.eye, ray)) all.push_back(std::move(*one));
  std::stable_sort(all.begin(), all.end(), [](const Met_piece& a, const Met_piece& b) { return a.t < b.t; });
  return all;
}

/// Every third piece hides what is behind it.
std::vector<Tint> glass(std::size_t pieces) {
  std::vector<Tint> tints;
  for (std::size_t i = 0; i < pieces; ++i) tints.push_back({{double(i), 1, 0}, i % 3 == 2 ? 1 : 0.5});
  return tints;
}

std::string flaw_at(const Piece_image& shown, const Blended_image& blended, const std::vector<Tint>& tints,
                    const std::vector<Met_piece>& all, std::size_t i) {
  // 1. The first.
  if ((shown.pieces[i] == Piece_image::nothing) != all.empty())
    return "a ray meets nothing, and shows something, or so";
  if (!all.empty()) {
    const auto first =
        std::find_if(all.begin(), all.end(), [&](const Met_piece& m) { return m.piece == shown.pieces[i]; });
    if (first == all.end() || first->t != all[0].t) return "the piece shown is not the first that a ray meets";
    const bool is_tied = first->on_border || (all.size() > 1 && all[1].t == all[0].t);
    if (is_tied != (shown.tied[i] != 0)) return "what is a tie and what is none is not what a ray says";
  }
  // 2. All, up to one that hides the rest.
  Layer layer;
  bool is_tied = false, has_choice = false;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool same = k + 1 < all.size() && all[k + 1].t == all[k].t;
    is_tied = is_tied || all[k].on_border || same;
    has_choice = has_choice || same;
    layer.put_behind(tints[all[k].piece]);
    if (tints[all[k].piece].alpha == 1) break;
  }
  if (has_choice) return {};  // how the rule chose is asked elsewhere
  if (is_tied != (blended.tied[i] != 0)) return "which layers are ties and which are not is not what a ray says";
  double error = std::fabs(layer.alpha - blended.layers[i].alpha);
  for (std::size_t k = 0; k < 3; ++k) error = std::max(error, std::fabs(layer.colour[k] - blended.layers[i].colour[k]));
  return error < 1e-9 ? "" : "layers are not those that a ray meets";
}

Outcome by_definition(const Seen& seen) {
  constexpr std::size_t most_rays = 16;
  const Exact_view view(seen.scene, seen.pixels.eye);
  const Piece_image shown = seen.truth();
  const std::vector<Tint> tints = glass(seen.scene.pieces().size());
  const Blended_image blended = blended_centres(view, seen.pixels, tints, serial());
  const std::size_t count = shown.pieces.size(), step = 1 + count / most_rays;
  for (std::size_t i = step / 2; i < count; i += step) {
    const std::vector<Met_piece> all =
        all_met(seen, seen.pixels.centre(static_cast<std::uint32_t>(i % seen.pixels.width),
                                         static_cast<std::uint32_t>(i / seen.pixels.width)));
    const std::string flaw = flaw_at(shown, blended, tints, all, i);
    if (!flaw.empty()) return Outcome::failed(place(seen.pixels, i) + ": " + flaw);
  }
  return {};
}

}  // namespace

Check definition_check() {
  return check_of("definition", "what is shown, and where a rule chooses, is what rays in rationals meet",
                  by_definition);
}

}  // namespace sightline::harness
