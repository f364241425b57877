#include <sightline/harness/compare/pixel_squares.h>

#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace sightline {

namespace {

using Flat_line = Flat_polygon::Flat_line;

/// The line with the values of a form, up to a positive factor.
Flat_line flat_line(const std::array<Rational, 3>& form) { return Over_common(form).whole; }

template <class Number>
Rational value(const std::array<Number, 3>& form, const Flat_polygon::Point& at) {
  return Rational(form[0] * at[0] + form[1] * at[1] + form[2]);
}

/// Of a form's values at the corners of a convex cell.
struct Signs {
  bool positive = false, negative = false;
};
template <class Number, class Corners>
Signs signs(const std::array<Number, 3>& form, const Corners& corners) {
  Signs found;
  for (const auto& corner : corners) {
    const int sign = sgn(value(form, corner.exact));
    found.positive = found.positive || sign > 0;
    found.negative = found.negative || sign < 0;
  }
  return found;
}

/// Each over its greatest, so that the rounding of a value at a place from -1 to 1 is below 2^-49.
std::array<double, 3> scaled(const Flat_line& h) {
  const Integer greatest = std::max({Integer(abs(h[0])), Integer(abs(h[1])), Integer(abs(h[2]))});
  std::array<double, 3> about;
  for (std::size_t k = 0; k < 3; ++k) about[k] = nearest_double(Rational(h[k]) / Rational(greatest));
  return about;
}

}  // namespace

Pixel_squares::Pixel_squares(const Scene& scene, const Pixel_view& pixels) : pixels_(pixels) {
  const Exact_point look = exact(pixels.look), right = exact(pixels.right), up = exact(pixels.up);
  const auto in_image = [&](const Exact_point& n) { return Form{dot(n, right), dot(n, up), dot(n, look)}; };
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
    // 1. Its corners from the eye, and its plane.
    const Piece& piece = scene.pieces()[i];
    std::vector<Exact_point> arms;
    Exact_point middle{0, 0, 0}, normal{0, 0, 0};
    for (const Piece_corner& corner : scene.corners(piece)) {
      arms.push_back(minus(scene.position(corner.point), pixels.eye));
      for (std::size_t k = 0; k < 3; ++k) middle[k] += arms.back()[k];
    }
    for (std::size_t k = 2; k < arms.size(); ++k) {
      const Exact_point turn = cross(minus(arms[k - 1], arms[0]), minus(arms[k], arms[0]));
      for (std::size_t c = 0; c < 3; ++c) normal[c] += turn[c];
    }
    const Rational at_plane = dot(normal, arms[0]);
    if (at_plane == 0) continue;
    // 2. How near it is, and the planes through its edges.
    Seen_piece& seen = seen_.emplace_back();
    for (Rational& x : normal) x /= at_plane;
    seen.nearness = in_image(normal);
    seen.rank = {at_plane > 0, piece.face, piece.number};
    seen.piece = i;
    for (std::size_t k = 0; k < arms.size(); ++k) {
      Exact_point side = cross(arms[k], arms[(k + 1) % arms.size()]);
      if (dot(side, middle) < 0)
        for (Rational& x : side) x = -x;
      seen.edges.push_back(flat_line(in_image(side)));
      seen.about.push_back(scaled(seen.edges.back()));
    }
  }
}

Layer Pixel_squares::mean(std::uint32_t x, std::uint32_t y, const std::vector<Tint>& tints) const {
  const auto place = [](std::uint32_t k, std::uint32_t count) {
    return Rational(Rational(2 * static_cast<long>(k) - static_cast<long>(count)) / Rational(count));
  };
  const Rational left = place(x, pixels_.width), right = place(x + 1, pixels_.width), top = -place(y, pixels_.height),
                 bottom = -place(y + 1, pixels_.height);
  const Flat_polygon square = Flat_polygon::hull({{left, bottom}, {right, bottom}, {right, top}, {left, top}});
  Members members(seen_.size());
  std::iota(members.begin(), members.end(), 0);
  Layer sum;
  show(square, members, square.area(), tints, sum);
  return sum;
}

bool Pixel_squares::has_area(const Seen_piece& seen, const Flat_polygon& cell, const Corners& corners) {
  for (const std::array<double, 3>& h : seen.about)
    if (std::all_of(corners.begin(), corners.end(),
                    [&](const Corner& p) { return h[0] * p.about[0] + h[1] * p.about[1] + h[2] < -0x1p-40; }))
      return false;
  Flat_polygon there = cell;
  for (const Flat_line& edge : seen.edges) {
    there = there.clipped(edge);
    if (there.empty()) return false;
  }
  return true;
}

void Pixel_squares::show(const Flat_polygon& cell, const Members& members, const Rational& whole,
                         const std::vector<Tint>& tints, Layer& sum) const {
  Corners corners;
  Flat_polygon::Point middle{0, 0};
  for (std::size_t k = 0; k < cell.lines().size(); ++k) {
    Corner& corner = corners.emplace_back(Corner{cell.vertex(k), {}});
    for (std::size_t c = 0; c < 2; ++c) {
      corner.about[c] = nearest_double(corner.exact[c]);
      middle[c] += corner.exact[c];
    }
  }
  for (Rational& x : middle) x /= static_cast<unsigned>(corners.size());
  const auto is_all_over = [&](std::uint32_t i) {
    return std::none_of(seen_[i].edges.begin(), seen_[i].edges.end(),
                        [&](const Flat_line& edge) { return signs(edge, corners).negative; });
  };
  const auto before = [&](std::uint32_t i, std::uint32_t j) { return minus(seen_[i].nearness, seen_[j].nearness); };

  // 1. What has an area here, nearest first at the middle, which is inside.
  std::vector<std::pair<Rational, std::uint32_t>> by_depth;
  for (const std::uint32_t i : members)
    if (has_area(seen_[i], cell, corners)) by_depth.emplace_back(value(seen_[i].nearness, middle), i);
  std::sort(by_depth.begin(), by_depth.end(), [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : seen_[a.second].rank < seen_[b.second].rank;
  });
  // 2. Not what is behind something all over that hides it all over.
  Members here;
  Members hiding;
  for (const auto& [nearness, j] : by_depth) {
    if (std::any_of(hiding.begin(), hiding.end(),
                    [&, j = j](std::uint32_t i) { return !signs(before(i, j), corners).negative; }))
      continue;
    here.push_back(j);
    if (tints[seen_[j].piece].alpha >= 1 && is_all_over(j)) hiding.push_back(j);
  }
  // 3. Cut where one of the others ends, or two cross.
  const auto cut = [&](const Flat_line& h) {
    show(cell.clipped(h), here, whole, tints, sum);
    show(cell.clipped({Integer(-h[0]), Integer(-h[1]), Integer(-h[2])}), here, whole, tints, sum);
  };
  const auto divides = [&](const auto& form) {
    const Signs found = signs(form, corners);
    return found.positive && found.negative;
  };
  for (const std::uint32_t i : here)
    for (const Flat_line& edge : seen_[i].edges)
      if (divides(edge)) return cut(edge);
  for (const std::uint32_t i : here)
    for (const std::uint32_t j : here)
      if (i < j && divides(before(i, j))) return cut(flat_line(before(i, j)));
  // 4. All of it is as at its middle.
  Layer layer;
  for (const std::uint32_t i : here) layer.put_behind(tints[seen_[i].piece]);
  const double share = nearest_double(cell.area() / whole);
  for (std::size_t k = 0; k < 3; ++k) sum.colour[k] += share * layer.colour[k];
  sum.alpha += share * layer.alpha;
}

}  // namespace sightline
