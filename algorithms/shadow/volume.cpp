#include <sightline/algorithms/shadow/volume.h>

#include <sightline/algorithms/solids/operands.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace sightline {

namespace {

using Box = std::array<Exact_point, 2>;

/// The scene's box, larger by a quarter of its longest side; nothing for a scene without pieces.
std::optional<Box> box_around(const Scene& scene) {
  if (scene.pieces().empty()) return std::nullopt;
  Box box;
  bool first = true;
  for (const Piece& piece : scene.pieces())
    for (const Piece_corner& corner : scene.corners(piece)) {
      const Exact_point p = scene.position(corner.point);
      for (std::size_t k = 0; k < 3; ++k) {
        if (first || p[k] < box[0][k]) box[0][k] = p[k];
        if (first || p[k] > box[1][k]) box[1][k] = p[k];
      }
      first = false;
    }
  Rational margin;
  for (std::size_t k = 0; k < 3; ++k) margin = std::max(margin, Rational((box[1][k] - box[0][k]) / 4));
  for (std::size_t k = 0; k < 3; ++k) {
    box[0][k] -= margin;
    box[1][k] += margin;
  }
  return box;
}

Polygon_soup box_soup(const Box& box) {
  Polygon_soup soup;
  for (std::size_t k = 0; k < 8; ++k) soup.add_point(box[k >> 2 & 1][0], box[k >> 1 & 1][1], box[k & 1][2]);
  for (const std::array<Point_id, 4>& face :
       {std::array<Point_id, 4>{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}})
    soup.add_face(face);
  return soup;
}

/// A whole number above a rational.
Integer above(const Rational& x) {
  Integer whole;
  mpz_fdiv_q(whole.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
  return whole + 1;
}

class Caster {
 public:
  Caster(const Scene& scene, const Exact_point& light, bool is_sun) : scene_(scene), light_(light), is_sun_(is_sun) {}

  Shadow_volume cast(const std::function<void(std::size_t, std::size_t)>& progress) {
    Shadow_volume volume;
    const std::optional<Box> box = box_around(scene_);
    if (!box) return volume;
    volume.box = *box;
    for (std::uint32_t i = 0; i < scene_.pieces().size(); ++i) volume.casting += add_frustum(i, *box);
    // All frusta are one operand: where it winds round at all, some face is in the light's way.
    Set_options options;
    options.operation = Set_operation::intersect;
    options.progress = progress;
    const std::vector<Polygon_soup> both{std::move(frusta_), box_soup(*box)};
    Set_result result = set_operation(Operands(both), options);
    volume.soup = std::move(result.soup);
    volume.counters = result.counters;
    return volume;
  }

 private:
  /// A piece's shadow, from the piece to beyond the box; nothing where the light is in its plane.
  bool add_frustum(std::uint32_t piece, const Box& box) {
    const std::vector<Exact_point> corners = scene_.corner_points(scene_.pieces()[piece]);
    Exact_point normal;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const Exact_point part = cross(minus(corners[k], corners[0]), minus(corners[k + 1], corners[0]));
      for (std::size_t axis = 0; axis < 3; ++axis) normal[axis] += part[axis];
    }
    // 1. How far it reaches: its end, which is parallel to the piece, has the box behind it.
    const Rational slope = is_sun_ ? -dot(normal, light_) : dot(normal, minus(corners[0], light_));
    if (sgn(slope) == 0) return false;
    Rational farthest = is_sun_ ? 0 : 1;
    for (std::size_t k = 0; k < 8; ++k) {
      const Exact_point b{box[k >> 2 & 1][0], box[k >> 1 & 1][1], box[k & 1][2]};
      farthest = std::max(farthest, Rational(dot(normal, minus(b, is_sun_ ? corners[0] : light_)) / slope));
    }
    const Integer reach = above(farthest);  // whole, so that it brings no denominators
    // 2. Its corners and faces: the piece looks to the light, its end away from it.
    const auto n = static_cast<Point_id>(corners.size());
    const auto first = static_cast<Point_id>(frusta_.point_count());
    for (const Exact_point& c : corners) frusta_.add_point(c[0], c[1], c[2]);
    for (const Exact_point& c : corners) {
      Exact_point end;
      for (std::size_t k = 0; k < 3; ++k)
        end[k] = is_sun_ ? Rational(c[k] - reach * light_[k]) : Rational(light_[k] + reach * (c[k] - light_[k]));
      frusta_.add_point(end[0], end[1], end[2]);
    }
    const bool front = sgn(slope) < 0;  // the light is in front of the piece
    const auto add = [&](std::vector<Point_id> loop) {
      if (!front) std::reverse(loop.begin(), loop.end());
      frusta_.add_face(loop);
    };
    std::vector<Point_id> near, end;
    for (Point_id k = 0; k < n; ++k) {
      const Point_id next = (k + 1) % n;
      near.push_back(first + k);
      end.insert(end.begin(), first + n + k);
      add({first + next, first + k, first + n + k, first + n + next});
    }
    add(std::move(near));
    add(std::move(end));
    return true;
  }

  const Scene& scene_;
  const Exact_point& light_;
  const bool is_sun_;
  Polygon_soup frusta_;
};

}  // namespace

Shadow_volume shadow_volume(const Scene& scene, const Exact_point& light,
                            const std::function<void(std::size_t, std::size_t)>& progress) {
  return Caster(scene, light, false).cast(progress);
}
Shadow_volume shadow_volume(const Scene& scene, const Sun& sun,
                            const std::function<void(std::size_t, std::size_t)>& progress) {
  return Caster(scene, sun.direction, true).cast(progress);
}

}  // namespace sightline
