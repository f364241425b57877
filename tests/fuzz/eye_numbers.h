#pragma once
// What visibility from a point stands on, by itself: planes through an eye or a sun, the rays where they meet and the
// forms of pieces, in whole numbers and within their errors in doubles; and the boxes around pieces.

#include "grid.h"
#include "support.h"

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/prepared_plane.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace fuzz {

// ---- By definition, in the grid's coordinates

inline bool is_positive_multiple(const Exact_point& a, const Exact_point& b) {
  return is_zero(cross(a, b)) && dot(a, b) > 0;
}
inline Exact_point exact_vector(const std::array<Integer, 3>& v) {
  return {Rational(v[0]), Rational(v[1]), Rational(v[2])};
}

/// Whether doubles are some positive multiple of a vector, each within the error.
inline bool are_within(const std::array<double, 3>& found, double error, const Exact_point& v) {
  if (!std::isfinite(error)) return true;
  Rational least = 0;
  std::optional<Rational> most;
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational low = exact(found[k]) - exact(error), high = exact(found[k]) + exact(error);
    if (v[k] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const Rational from = (v[k] > 0 ? low : high) / v[k], to = (v[k] > 0 ? high : low) / v[k];
    least = std::max(least, from);
    if (!most || to < *most) most = to;
  }
  return most && least <= *most && *most > 0;
}

/// A scene as seen from an eye, or from a sun: directions of points, and 1/t of pieces as linear forms of them. Of a
/// sun that is steepest to axis m a direction is that of a point moved along its light to m = 0; its last coordinate is
/// 1 against the light, and t falls towards it.
class Defined_view {
 public:
  Defined_view(const Scene& scene, const Exact_view& view) : scene_(scene), is_sun_(view.is_sun()) {
    const Located_point& eye = view.located_eye();
    eye_ = {Rational(eye.x), Rational(eye.y), Rational(eye.z)};
    unit_ = Rational(eye.w);
    if (is_sun_) {
      for (std::size_t k = 1; k < 3; ++k)
        if (abs(eye_[k]) > abs(eye_[axis_])) axis_ = k;
      unit_ = abs(eye_[axis_]);
    } else {
      for (Rational& x : eye_) x /= unit_;
    }
  }

  Exact_point at(std::uint32_t point) const {
    const Grid_points& points = scene_.points();
    return {Rational(points.integer(point, 0)), Rational(points.integer(point, 1)), Rational(points.integer(point, 2))};
  }
  /// Of a place of the grid, not the eye.
  Exact_point direction(const Exact_point& p) const {
    if (!is_sun_) return minus(p, eye_);
    const std::size_t i = (axis_ + 1) % 3, j = (axis_ + 2) % 3;
    const Rational rise = p[axis_] / eye_[axis_];
    return {Rational(p[i] - rise * eye_[i]), Rational(p[j] - rise * eye_[j]), Rational(-sgn(eye_[axis_]))};
  }
  Exact_point direction(std::uint32_t point) const { return direction(at(point)); }

  /// A piece's plane: positive in its front.
  struct Flat {
    Exact_point normal;
    Rational last;
    Rational at(const Exact_point& p) const { return dot(normal, p) + last; }
  };
  Flat plane(std::uint32_t piece) const {
    const std::span<const Piece_corner> corners = scene_.corners(scene_.pieces()[piece]);
    Exact_point normal{0, 0, 0};
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const Exact_point part = cross(minus(at(corners[k].point), at(corners[0].point)),
                                     minus(at(corners[k + 1].point), at(corners[0].point)));
      for (std::size_t i = 0; i < 3; ++i) normal[i] += part[i];
    }
    return {normal, -dot(normal, at(corners[0].point))};
  }
  /// Of the eye to a plane.
  Rational at_eye(const Flat& h) const { return is_sun_ ? dot(h.normal, eye_) : h.at(eye_); }
  /// h as a normal of directions, where it holds the eye.
  Exact_point in_view(const Flat& h) const {
    if (!is_sun_) return h.normal;
    return {h.normal[(axis_ + 1) % 3], h.normal[(axis_ + 2) % 3], Rational(-sgn(eye_[axis_]) * h.last)};
  }
  /// q of 1/t = q . r. Pre: the eye is not in its plane.
  Exact_point form(const Flat& h) const {
    const Rational share = -(is_sun_ ? unit_ : Rational(1)) / at_eye(h);
    Exact_point q = in_view(h);
    for (Rational& x : q) x *= share;
    return q;
  }
  /// Of directions whose place in f's plane is in front of h.
  Exact_point cut(const Flat& f, const Flat& h) const {
    const Exact_point of_f = form(f), of_h = in_view(h);
    const Rational share = is_sun_ ? Rational(at_eye(h) / unit_) : at_eye(h);
    Exact_point normal;
    for (std::size_t k = 0; k < 3; ++k) normal[k] = of_h[k] + share * of_f[k];
    return normal;
  }

  bool is_sun() const { return is_sun_; }
  const Exact_point& eye() const { return eye_; }
  /// The view's directions are so many of these.
  const Rational& unit() const { return unit_; }

 private:
  const Scene& scene_;
  bool is_sun_;
  Exact_point eye_;
  Rational unit_;
  std::size_t axis_ = 0;
};

// ---- A scene, and an eye in some special place, or a sun

struct Seen_scene {
  std::unique_ptr<Scene> scene;
  std::unique_ptr<Exact_view> view;
  std::vector<std::array<Integer, 3>> field;
};

/// Coordinates of any width and place, or few places with points close about them: planes through the eye and two such
/// pairs are hardly apart.
inline std::vector<Exact_point> drawn_points(generate::Random& random) {
  std::vector<Exact_point> points;
  const std::size_t count = 6 + random.below(6);
  if (random.chance(1, 2)) {
    Drawn_coordinates drawn(random);
    for (std::size_t k = 0; k < count; ++k) points.push_back(drawn.point());
    return points;
  }
  std::vector<Exact_point> places;
  const Rational far = generate::power_of_two(static_cast<int>(random.below(60)));
  for (int k = 0; k < 3; ++k) {
    places.push_back(generate::lattice(random, 5));
    for (Rational& x : places.back()) x *= far;
  }
  for (std::size_t k = 0; k < count; ++k)
    points.push_back(generate::along(places[random.below(3)], 1, generate::lattice(random, 3)));
  return points;
}

inline Exact_point drawn_eye(const std::vector<Exact_point>& points, generate::Random& random) {
  const auto any = [&] { return points[random.below(points.size())]; };
  const Exact_point p = any(), q = any(), r = any();
  Exact_point eye = p;
  switch (random.below(6)) {
    case 0: break;  // a corner
    case 5: {       // hardly off a plane of three
      static constexpr std::array powers{30, 200, 290, 305, 500, 512, 530, 1000, 1060};
      const Exact_point normal = cross(minus(q, p), minus(r, p));
      eye = generate::along(p, generate::power_of_two(-powers[random.below(powers.size())]), normal);
      for (std::size_t k = 0; k < 3; ++k) eye[k] += (q[k] - p[k]) * 3 / 8 - (r[k] - p[k]) / 2;
      break;
    }
    case 1:  // in a plane of three
      for (std::size_t k = 0; k < 3; ++k) eye[k] += (q[k] - p[k]) * 3 / 7 - (r[k] - p[k]) / 2;
      break;
    case 2:  // next to one
      eye =
          generate::along(p, generate::power_of_two(-static_cast<int>(random.below(70))), generate::lattice(random, 3));
      break;
    case 3:  // far away
      eye =
          generate::along(p, generate::power_of_two(static_cast<int>(random.below(90))), generate::lattice(random, 3));
      break;
    default: eye = generate::half_lattice(random, 9); break;
  }
  return eye;
}

inline std::optional<Seen_scene> drawn_view(generate::Random& random) {
  const std::vector<Exact_point> points = drawn_points(random);
  Polygon_soup soup;
  for (const Exact_point& p : points) soup.add_point(p[0], p[1], p[2]);
  for (std::size_t faces = 2 + random.below(4); faces > 0; --faces) {
    std::vector<Point_id> corners;
    for (int k = 0; k < 3; ++k) corners.push_back(static_cast<Point_id>(random.below(points.size())));
    soup.add_face(corners);
  }
  Seen_scene seen;
  seen.scene = std::make_unique<Scene>(soup);
  if (seen.scene->pieces().empty()) return std::nullopt;
  const Exact_point eye = drawn_eye(points, random);
  if (random.chance(1, 4)) {
    const Exact_point towards = random.chance(1, 2) ? minus(eye, points[0]) : generate::lattice(random, 4);
    if (is_zero(towards)) return std::nullopt;
    seen.view = std::make_unique<Exact_view>(*seen.scene, Sun(towards));
    return seen;
  }
  if (random.chance(1, 2)) {
    std::vector<Exact_point> rays{generate::lattice(random, 4), generate::lattice(random, 4),
                                  generate::lattice(random, 4)};
    const Rational turn = dot(cross(rays[0], rays[1]), rays[2]);
    if (turn < 0) std::swap(rays[0], rays[1]);
    if (turn != 0) seen.field = field_of(rays);
  }
  seen.view = std::make_unique<Exact_view>(*seen.scene, eye, seen.field);
  return seen;
}

// ---- Planes, rays and pieces of a view

class View_laws {
 public:
  View_laws(const Seen_scene& seen, generate::Random& random)
      : scene_(*seen.scene), view_(*seen.view), defined_(scene_, view_), random_(random) {
    for (std::uint32_t f = 0; f < scene_.pieces().size(); ++f) {
      flats_.push_back(defined_.plane(f));
      require(static_cast<int>(view_.eye_side(f)) == sgn(defined_.at_eye(flats_[f])), "an eye has its side of a piece");
      if (view_.eye_side(f) != CGAL::ZERO) pieces_.push_back(f);
    }
    for (std::uint32_t k = 0; k < seen.field.size(); ++k) add(view_.field_side(k), exact_vector(seen.field[k]));
    draw_planes();
    draw_rays();
  }

  void check() {
    for (const Known_plane& w : planes_) check(w);
    for (const Known_ray& r : rays_) check(r);
    for (const std::uint32_t f : pieces_) check_form(f);
    check_points();
  }

 private:
  struct Known_plane {
    Exact_view::Plane plane;
    Exact_point normal;
  };
  struct Known_ray {
    Exact_view::Ray ray;
    Exact_point direction;
  };

  // ---- What there is

  void add(const Exact_view::Plane& w, const Exact_point& normal) {
    if (is_zero(normal)) return;
    if (random_.chance(1, 2)) planes_.push_back({w, normal});
    else planes_.push_back({view_.opposite(w), {Rational(-normal[0]), Rational(-normal[1]), Rational(-normal[2])}});
  }
  void draw_planes() {
    const auto points = static_cast<std::uint32_t>(scene_.points().size());
    for (int turn = 0; turn < 9; ++turn) {
      const auto p = static_cast<std::uint32_t>(random_.below(points)),
                 q = static_cast<std::uint32_t>(random_.below(points));
      if (p != q) add(view_.edge(p, q), cross(defined_.direction(p), defined_.direction(q)));
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      Exact_point normal{0, 0, 0};
      normal[k] = 1;
      add(view_.axis(k), normal);
    }
    for (const std::uint32_t f : pieces_)
      for (std::uint32_t g = 0; g < flats_.size(); ++g) {
        if (view_.same_plane(f, g) || random_.chance(1, 2)) continue;
        const auto support = scene_.pieces()[g].support;
        add(view_.cut(f, support), defined_.cut(flats_[f], flats_[g]));
        if (view_.eye_side(g) != CGAL::ZERO)
          add(view_.crossing(f, g), minus(defined_.form(flats_[f]), defined_.form(flats_[g])));
      }
  }
  void draw_rays() {
    for (std::uint32_t p = 0; p < scene_.points().size(); ++p)
      if (const Exact_point d = defined_.direction(p); !is_zero(d)) rays_.push_back({view_.ray(p), d});
    for (std::uint32_t k = 0; k < 3; ++k) {
      Exact_point d{0, 0, 0};
      const bool positive = random_.chance(1, 2);
      d[k] = positive ? 1 : -1;
      rays_.push_back({view_.axis_ray(k, positive), d});
    }
    for (int turn = 0; turn < 12; ++turn) {
      const Known_plane &w = planes_[random_.below(planes_.size())], &u = planes_[random_.below(planes_.size())];
      const Exact_point d = cross(w.normal, u.normal);
      if (!is_zero(d)) rays_.push_back({view_.meet(w.plane, u.plane, counts_), d});
    }
  }

  // ---- What holds

  void check(const Known_plane& w) {
    require(is_positive_multiple(exact_vector(view_.normal(w.plane)), w.normal),
            "a plane's normal is what it is made of");
    const auto& [x, y, z, size, error, name, flipped] = w.plane;
    require(are_within({x, y, z}, error, w.normal), "a plane's doubles are within their error");
    require(exact(size) >= abs(exact(x)) + abs(exact(y)) + abs(exact(z)),
            "a plane's size is what its doubles add up to");
    for (std::uint32_t p = 0; p < scene_.points().size(); ++p)
      if (const Exact_point d = defined_.direction(p); !is_zero(d))
        require(static_cast<int>(view_.side(w.plane, p, counts_)) == sgn(dot(w.normal, d)),
                "a point has its side of a plane");
    for (const Known_ray& r : rays_)
      require(static_cast<int>(view_.side(w.plane, r.ray, counts_)) == sgn(dot(w.normal, r.direction)),
              "a ray has its side of a plane");
  }

  void check(const Known_ray& r) {
    require(is_positive_multiple(exact_vector(view_.direction(r.ray)), r.direction),
            "a ray goes where its planes meet");
    require(are_within({r.ray.x, r.ray.y, r.ray.z}, r.ray.error, r.direction),
            "a ray's doubles are within their error");
    require(exact(r.ray.size) >= abs(exact(r.ray.x)) + abs(exact(r.ray.y)) + abs(exact(r.ray.z)),
            "a ray's size is what its doubles add up to");
    for (const std::uint32_t f : pieces_) {
      const Exact_point of_f = defined_.form(flats_[f]);
      for (const std::uint32_t g : pieces_) {
        const Rational nearer = dot(minus(of_f, defined_.form(flats_[g])), r.direction);
        require(static_cast<int>(view_.nearer(f, g, r.ray, counts_)) == sgn(nearer),
                "the nearer of two planes is nearer");
      }
      // A sun's light comes from everywhere, but not across itself.
      if (defined_.is_sun() && r.direction[2] == 0) continue;
      if (const Rational inverse = dot(of_f, r.direction); inverse != 0) check_place(f, r, inverse);
    }
  }
  /// Where a ray meets a piece's plane, on the line through the eye, and how far away.
  void check_place(std::uint32_t piece, const Known_ray& r, const Rational& inverse) {
    const Located_point found = scene_.locate(view_.position(piece, r.ray));
    const Exact_point place{Rational(Rational(found.x) / found.w), Rational(Rational(found.y) / found.w),
                            Rational(Rational(found.z) / found.w)};
    require(flats_[piece].at(place) == 0, "a ray meets a plane in it");
    const Exact_point from = defined_.direction(place);
    require(is_zero(cross(from, r.direction)), "a ray meets a plane on its line");
    if (defined_.is_sun()) return;
    require(sgn(dot(from, r.direction)) == sgn(inverse), "a ray meets a plane before the eye or behind it");
    const double farthest = view_.farthest(piece, r.ray);
    if (inverse < 0 || std::isinf(farthest)) return;
    const Rational away = dot(from, from) / (in_boxes() * in_boxes());
    require(farthest >= 0 && exact(farthest) * exact(farthest) >= away, "nothing of a plane is farther than its bound");
  }

  void check_form(std::uint32_t piece) {
    const Approximate_eye_plane found = view_.nearness(piece);
    if (std::isinf(found.size)) return;
    Exact_point q = defined_.form(flats_[piece]);
    // Directions that are narrow are doubles as they are, others by a power of two.
    const Rational unit =
        view_.bits() <= 62 ? defined_.unit() : Rational(defined_.unit() * generate::power_of_two(-view_.bits()));
    for (std::size_t k = 0; k < 3; ++k) {
      q[k] /= unit;
      require(abs(Rational(exact(found.normal[k]) - q[k])) <= exact(found.error), "a piece's form is within its error");
    }
  }

  void check_points() {
    for (std::uint32_t f = 0; f < flats_.size(); ++f)
      for (std::uint32_t p = 0; p < scene_.points().size(); ++p) {
        const int side = sgn(flats_[f].at(defined_.at(p)));
        require(static_cast<int>(view_.side(f, p, counts_)) == side, "a point has its side of a piece's plane");
        if (view_.eye_side(f) != CGAL::ZERO)
          require(static_cast<int>(view_.beyond(f, p, counts_)) == -side * static_cast<int>(view_.eye_side(f)),
                  "a point is beyond a piece's plane where the eye is on its other side");
      }
  }

  /// How long what is 1 in boxes is in the grid.
  Rational in_boxes() const {
    return Rational(scene_.points().divisor()) * generate::power_of_two(static_cast<int>(scene_.points().shift()));
  }

  const Scene& scene_;
  const Exact_view& view_;
  Defined_view defined_;
  generate::Random& random_;
  Predicate_counts counts_;
  std::vector<Defined_view::Flat> flats_;
  std::vector<std::uint32_t> pieces_;  // those in whose plane the eye is not
  std::vector<Known_plane> planes_;
  std::vector<Known_ray> rays_;
};

inline void try_view(generate::Random& random) {
  const std::optional<Seen_scene> seen = drawn_view(random);
  if (seen) View_laws(*seen, random).check();
}

// ---- Boxes

/// A convex polygon of any number of corners, on a parabola, in a plane of the lattice.
inline std::vector<Exact_point> drawn_convex(generate::Random& random) {
  static constexpr std::array counts{3, 4, 5, 31, 32, 33, 34, 63, 64, 65, 500, 1000, 1024, 1100};
  const auto count = static_cast<long>(random.chance(3, 4) ? 3 + random.below(3) : counts[random.below(counts.size())]);
  const auto [u, v] = generate::directions(random, 3);
  const Exact_point origin = generate::lattice(random, 9);
  std::vector<Exact_point> corners;
  for (long k = 0; k < count; ++k) {
    const Rational x = generate::ratio(k, 4), y = x * x;
    Exact_point p = origin;
    for (std::size_t i = 0; i < 3; ++i) p[i] += x * u[i] + y * v[i];
    corners.push_back(p);
  }
  return corners;
}

/// Chunks are parts of their pieces that make these up, in a tree of boxes that hold them; what boxes say is so.
class Box_laws {
 public:
  Box_laws(const Scene& scene, generate::Random& random)
      : scene_(scene), boxes_(scene), random_(random), unit_(scene.points().divisor()) {
    unit_ *= generate::power_of_two(static_cast<int>(scene.points().shift()));
  }

  void check() const {
    const auto count = static_cast<std::uint32_t>(boxes_.chunks().size());
    require(boxes_.nodes().empty() == scene_.pieces().empty(), "a scene with pieces has a tree of boxes");
    if (count == 0) return;
    check_node(0, 0, count);
    check_chunks();
  }

  void check(const Piece_boxes::Box& box, const Located_point& eye) const {
    // 1. Behind a plane of the scene.
    for (const Piece& piece : scene_.pieces()) {
      const bool flipped = random_.chance(1, 2);
      const auto support = flipped ? piece.support.opposite() : piece.support;
      if (!Piece_boxes::is_behind(box, scene_.prepared(support))) continue;
      const std::array<Integer, 4> h = scene_.predicates().coefficients(support);
      require(
          is_all(box,
                 [&](const Exact_point& p) { return Rational(h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3]) < 0; }),
          "a box that is behind a plane is");
    }
    if (std::isinf(eye.error)) return;
    // 2. At most as far away as it is.
    const double distance = Piece_boxes::distance(box, eye);
    const Exact_point at{Rational(Rational(eye.x) / eye.w), Rational(Rational(eye.y) / eye.w),
                         Rational(Rational(eye.z) / eye.w)};
    Rational away = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational x = at[k] / unit_,
                     beside = std::max(Rational(exact(box.low[k]) - x), Rational(x - exact(box.high[k])));
      if (beside > 0) away += beside * beside;
    }
    const Rational least = exact(distance) * (1 - generate::power_of_two(-49)) - 2 * exact(eye.error);
    require(least <= 0 || least * least <= away, "a box is not nearer than its distance");
  }

  const Piece_boxes& boxes() const { return boxes_; }
  template <class Holds>
  bool is_all(const Piece_boxes::Box& box, const Holds& holds) const {
    for (unsigned corner = 0; corner < 8; ++corner) {
      Exact_point p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = exact((corner >> k & 1) != 0 ? box.high[k] : box.low[k]) * unit_;
      if (!holds(p)) return false;
    }
    return true;
  }

 private:
  void check_node(std::uint32_t at, std::uint32_t first, std::uint32_t count) const {
    require(at < boxes_.nodes().size(), "a child is there");
    const Piece_boxes::Node& node = boxes_.nodes()[at];
    require(node.first == first && node.count == count && count > 0, "a node has the chunks of its half");
    for (std::uint32_t chunk = first; chunk < first + count; ++chunk)
      for (const std::uint32_t p : boxes_.points(boxes_.chunks()[chunk]))
        for (int k = 0; k < 3; ++k) {
          const Rational x = Rational(scene_.points().integer(p, k)) / unit_;
          const auto axis = static_cast<std::size_t>(k);
          require(exact(node.box.low[axis]) <= x && x <= exact(node.box.high[axis]), "a node's box holds its chunks");
        }
    require((node.second == 0) == (count <= Piece_boxes::leaf_size), "what is more than a leaf is halved");
    if (node.second == 0) return;
    check_node(at + 1, first, count / 2);
    check_node(node.second, first + count / 2, count - count / 2);
  }
  void check_chunks() const {
    const auto area_of = [&](std::size_t size, const auto& point) {
      Exact_point area{0, 0, 0};
      for (std::size_t k = 0; k < size; ++k) {
        const std::uint32_t p = point(k), q = point((k + 1) % size);
        const auto x = [&](std::uint32_t of, std::size_t i) {
          return Rational(scene_.points().integer(of, static_cast<int>(i)));
        };
        for (std::size_t i = 0; i < 3; ++i)
          area[i] += x(p, (i + 1) % 3) * x(q, (i + 2) % 3) - x(p, (i + 2) % 3) * x(q, (i + 1) % 3);
      }
      return area;
    };
    std::vector<Exact_point> missing;
    for (const Piece& piece : scene_.pieces()) {
      const std::span<const Piece_corner> corners = scene_.corners(piece);
      missing.push_back(area_of(corners.size(), [&](std::size_t k) { return corners[k].point; }));
    }
    std::vector<Exact_point> normals = missing;
    for (const Piece_boxes::Chunk& chunk : boxes_.chunks()) {
      require(chunk.size >= 3 && chunk.size <= Piece_boxes::chunk_size, "a chunk is a polygon of few corners");
      const std::span<const std::uint32_t> points = boxes_.points(chunk);
      const Exact_point area = area_of(points.size(), [&](std::size_t k) { return points[k]; });
      require(is_positive_multiple(area, normals[chunk.piece]), "a chunk is a part of its piece");
      for (std::size_t i = 0; i < 3; ++i) missing[chunk.piece][i] -= area[i];
    }
    require(std::all_of(missing.begin(), missing.end(), is_zero<Rational>), "a piece's chunks make it up");
  }

  const Scene& scene_;
  Piece_boxes boxes_;
  generate::Random& random_;
  Rational unit_;
};

inline void try_boxes(generate::Random& random) {
  generate::Faces faces;
  const bool is_large = random.chance(1, 4);
  for (std::size_t n = random.below(40); n > 0; --n)
    faces.push_back(is_large ? drawn_convex(random) : generate::any_face(random));
  const Rational size = random.chance(1, 2)
                            ? Rational(1)
                            : Rational(generate::power_of_two(static_cast<int>(random.between(-200, 200))) / 3);
  for (generate::Points& face : faces)
    for (Exact_point& p : face)
      for (Rational& x : p) x *= size;
  if (random.chance(1, 3) && !faces.empty())  // numbers that are no doubles
    for (Exact_point& p : faces.back()) p = generate::along(p, generate::power_of_two(-80) * size, {1, 1, 1});
  const Scene scene(generate::soup_of(faces));
  Box_laws(scene, random).check();
}

/// Boxes of a view's scene before its eye, and planes through that.
inline void try_boxes_before_an_eye(generate::Random& random) {
  const std::optional<Seen_scene> seen = drawn_view(random);
  if (!seen) return;
  const Scene& scene = *seen->scene;
  const Exact_view& view = *seen->view;
  const Box_laws laws(scene, random);
  laws.check();
  for (const Piece_boxes::Node& node : laws.boxes().nodes()) {
    laws.check(node.box, view.located_eye());
    if (view.is_sun()) continue;
    const Exact_point eye = Defined_view(scene, view).eye();
    for (int turn = 0; turn < 9; ++turn) {
      const auto p = static_cast<std::uint32_t>(random.below(scene.points().size())),
                 q = static_cast<std::uint32_t>(random.below(scene.points().size()));
      if (p == q) continue;
      const Exact_view::Plane w = view.edge(p, q);
      const Approximate_eye_plane about = view.approximate(w);
      if (!Piece_boxes::is_behind(node.box, about.normal, about.size, about.error, view.located_eye())) continue;
      const Exact_point normal = exact_vector(view.normal(w));
      require(laws.is_all(node.box, [&](const Exact_point& corner) { return dot(normal, minus(corner, eye)) < 0; }),
              "a box that is behind a plane through the eye is");
    }
  }
}

inline void eye_numbers(std::string_view bytes) {
  static constexpr std::array<void (*)(generate::Random&), 4> laws{try_view, try_view, try_boxes,
                                                                   try_boxes_before_an_eye};
  ask_one_of(laws, bytes);
}

}  // namespace fuzz
