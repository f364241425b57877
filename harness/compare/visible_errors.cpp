#include <sightline/harness/compare/visible_errors.h>

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>

#include <iterator>

namespace sightline {
namespace visible_errors_detail {

double cross(const Image_point& a, const Image_point& b, const Image_point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double solid_angle(const Image_polygon& p) {
  double sum = 0;
  const auto dot = [](const Image_point& a, const Image_point& b) { return 1 + a[0] * b[0] + a[1] * b[1]; };
  for (std::size_t k = 1; k + 1 < p.size(); ++k) {
    const Image_point &a = p[0], &b = p[k], &c = p[k + 1];
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    sum += 2 * std::atan2(cross(a, b, c), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum;
}

Image_polygon hull(Image_polygon points) {
  std::sort(points.begin(), points.end());
  Image_polygon chain;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = chain.size();
    for (const Image_point& p : points) {
      while (chain.size() >= start + 2 && cross(chain[chain.size() - 2], chain.back(), p) <= 0) chain.pop_back();
      chain.push_back(p);
    }
    if (!chain.empty()) chain.pop_back();
    std::reverse(points.begin(), points.end());
  }
  const auto close = [](const Image_point& a, const Image_point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1]) <= rounding;
  };
  chain.erase(std::unique(chain.begin(), chain.end(), close), chain.end());
  while (chain.size() > 1 && close(chain.front(), chain.back())) chain.pop_back();
  if (chain.size() < 3) chain.clear();
  return chain;
}

Image_polygon clipped(const Image_polygon& polygon, const Image_point& p, const Image_point& q, bool left) {
  const std::size_t n = polygon.size();
  const double length = (left ? 1 : -1) * std::hypot(q[0] - p[0], q[1] - p[1]);
  thread_local std::vector<double> distance;
  distance.assign(n, 0);
  bool inside = false, outside = false;
  for (std::size_t k = 0; k < n; ++k) {
    const double d = cross(p, q, polygon[k]) / length;
    distance[k] = std::fabs(d) <= rounding ? 0 : d;
    inside = inside || distance[k] > 0;
    outside = outside || distance[k] < 0;
  }
  if (!inside) return {};
  if (!outside) return polygon;
  Image_polygon part;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = k + 1 == n ? 0 : k + 1;
    const double a = distance[k], b = distance[next];
    if (a >= 0) part.push_back(polygon[k]);
    if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
      const double t = a / (a - b);
      part.push_back({polygon[k][0] + t * (polygon[next][0] - polygon[k][0]),
                      polygon[k][1] + t * (polygon[next][1] - polygon[k][1])});
    }
  }
  return part;
}

Image_polygon intersection(Image_polygon a, const Image_polygon& b) {
  for (std::size_t k = 0; k < b.size() && !a.empty(); ++k) a = clipped(a, b[k], b[k + 1 == b.size() ? 0 : k + 1]);
  return a;
}

std::vector<Image_polygon> without(std::vector<Image_polygon> polygons, const Image_polygon& b) {
  std::vector<Image_polygon> left;
  for (Image_polygon& a : polygons) {
    if (intersection(a, b).empty()) {
      left.push_back(std::move(a));
      continue;
    }
    for (std::size_t k = 0; k < b.size() && !a.empty(); ++k) {
      const Image_point &p = b[k], &q = b[k + 1 == b.size() ? 0 : k + 1];
      if (Image_polygon part = clipped(a, p, q, false); !part.empty()) left.push_back(std::move(part));
      a = clipped(a, p, q);
    }
  }
  return left;
}

Image_polygon on_side(const std::vector<Ray_direction>& cone, const Cube_side& side) {
  std::vector<Ray_direction> polygon, next;
  for (const Ray_direction& d : cone) polygon.push_back(side.turned(d));
  for (const std::size_t axis : {0, 1})
    for (const int sense : {1, -1}) {
      next.clear();
      const auto form = [&](const Ray_direction& d) { return d[2] + sense * d[axis]; };
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Ray_direction &p = polygon[k], &q = polygon[k + 1 == polygon.size() ? 0 : k + 1];
        const double a = form(p), b = form(q);
        if (a >= 0) next.push_back(p);
        if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
          const double t = a / (a - b);
          next.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])});
        }
      }
      polygon.swap(next);
      if (polygon.size() < 3) return {};
    }
  Image_polygon image;
  for (const Ray_direction& d : polygon)
    if (d[2] > 0) image.push_back({std::clamp(d[0] / d[2], -1.0, 1.0), std::clamp(d[1] / d[2], -1.0, 1.0)});
  return image;
}

Ray_direction direction(const std::array<Rational, 3>& d) {
  Rational size = 0;
  for (const Rational& x : d) size = std::max(size, Rational(abs(x)));
  if (size == 0) return {0, 0, 0};
  return {nearest_double(Rational(d[0] / size)), nearest_double(Rational(d[1] / size)),
          nearest_double(Rational(d[2] / size))};
}

Ray_direction direction(const Exact_view& view, const Exact_view::Ray& r) { return in_proportion(view.direction(r)); }

void Image::add(std::uint32_t piece, Image_polygon polygon) {
  Image_part part{piece, std::move(polygon), {1, 1}, {-1, -1}};
  for (const Image_point& p : part.polygon)
    for (std::size_t k = 0; k < 2; ++k) {
      part.low[k] = std::min(part.low[k], p[k]);
      part.high[k] = std::max(part.high[k], p[k]);
    }
  parts_.push_back(std::move(part));
}

void Image::make_grid() {
  cells_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(parts_.size()))), 1, 512);
  grid_.assign(cells_ * cells_, {});
  for (std::uint32_t i = 0; i < parts_.size(); ++i)
    each_cell(parts_[i], [&](std::vector<std::uint32_t>& cell) { cell.push_back(i); });
  met_.assign(parts_.size(), 0);
  round_ = 0;
}

std::vector<std::uint32_t> Image::near(const Image_part& other) {
  std::vector<std::uint32_t> found;
  ++round_;
  each_cell(other, [&](const std::vector<std::uint32_t>& cell) {
    for (const std::uint32_t i : cell) {
      if (met_[i] == round_) continue;
      met_[i] = round_;
      const Image_part& part = parts_[i];
      if (part.low[0] <= other.high[0] && other.low[0] <= part.high[0] && part.low[1] <= other.high[1] &&
          other.low[1] <= part.high[1])
        found.push_back(i);
    }
  });
  return found;
}

template <class Function>
void Image::each_cell(const Image_part& part, Function function) {
  const auto cell = [&](double v) {
    return std::min(cells_ - 1, static_cast<std::size_t>((v + 1) / 2 * static_cast<double>(cells_)));
  };
  for (std::size_t y = cell(part.low[1]); y <= cell(part.high[1]); ++y)
    for (std::size_t x = cell(part.low[0]); x <= cell(part.high[0]); ++x) function(grid_[y * cells_ + x]);
}

}  // namespace visible_errors_detail

Visible_errors Visible_reference::errors(const Depth_buffer& buffer) {
  using namespace visible_errors_detail;
  Visible_errors e;
  e.not_finite = buffer.not_finite;
  const double size = buffer.size;
  const auto line = [&](std::uint32_t k) { return 2 * k / size - 1; };
  const auto pixel = [&](double v) {
    return std::min(buffer.size - 1, static_cast<std::uint32_t>(std::max(0.0, (v + 1) / 2 * size)));
  };
  double wrong = 0;
  for (std::size_t side = 0; side < 6; ++side)
    for (const Image_part& part : images_.sides[side].parts())
      for (std::uint32_t y = pixel(part.low[1]); y <= pixel(part.high[1]); ++y) {
        const double below = line(y), above = line(y + 1);
        const Image_polygon row =
            clipped(clipped(part.polygon, {-1, below}, {1, below}), {-1, above}, {1, above}, false);
        if (row.empty()) continue;
        double least = 1, most = -1;
        for (const Image_point& p : row) {
          least = std::min(least, p[0]);
          most = std::max(most, p[0]);
        }
        for (std::uint32_t x = pixel(least); x <= pixel(most); ++x) {
          const std::uint32_t shown = buffer.piece(side, x, y);
          if (same(part.piece, shown)) continue;
          const double left = line(x), right = line(x + 1);
          const Image_polygon both = clipped(clipped(row, {left, 1}, {left, -1}), {right, 1}, {right, -1}, false);
          if (!both.empty()) wrong += wrong_area(side, part.piece, shown, both, e);
        }
      }
  e.wrong = wrong / sphere;
  std::vector<unsigned char> shown(view_->scene().pieces().size(), 0);
  for (const std::uint32_t piece : buffer.pieces)
    if (piece != nothing) shown[piece] = 1;
  std::vector<Face_id> visible;
  for (std::uint32_t i = 0; i < shown.size(); ++i)
    if (shown[i] && view_->eye_side(i) == CGAL::POSITIVE) visible.push_back(face(i));
  std::sort(visible.begin(), visible.end());
  visible.erase(std::unique(visible.begin(), visible.end()), visible.end());
  count(visible, shown, e);
  return e;
}

double Visible_reference::wrong_area(std::size_t side, std::uint32_t f, std::uint32_t g, const Image_polygon& polygon,
                                     Visible_errors& e) {
  using namespace visible_errors_detail;
  if (same(f, g)) return 0;
  const double area = solid_angle(polygon);
  if (f == nothing || g == nothing || !view_->same_plane(f, g)) return area;
  const double tied = std::min(area, solid_angle(intersection(polygon, outline(side, g))));
  e.tied += tied / sphere;
  return area - tied;
}

const Visible_reference::Image_polygon& Visible_reference::outline(std::size_t side, std::uint32_t piece) {
  using namespace visible_errors_detail;
  const auto [at, is_new] = outlines_.try_emplace({piece, side});
  if (!is_new) return at->second;
  const Scene& scene = view_->scene();
  std::vector<Ray_direction> cone;
  for (const Piece_corner& corner : scene.corners(scene.pieces()[piece])) {
    Exact_point d = scene.position(corner.point);
    for (std::size_t k = 0; k < 3; ++k) d[k] -= view_->eye()[k];
    cone.push_back(direction(d));
  }
  return at->second = hull(on_side(cone, cube_sides[side]));
}

void Visible_reference::count(const std::vector<Face_id>& visible, const std::vector<unsigned char>& shown,
                              Visible_errors& e) const {
  std::vector<Face_id> difference;
  std::set_difference(visible.begin(), visible.end(), visible_.begin(), visible_.end(), std::back_inserter(difference));
  e.wrongly_visible = difference.size();
  difference.clear();
  std::set_difference(visible_.begin(), visible_.end(), visible.begin(), visible.end(), std::back_inserter(difference));
  e.wrongly_hidden = difference.size();

  struct Face {
    double area = 0;
    bool there = false, shown = false;
  };
  std::map<Face_id, Face> faces;
  for (std::uint32_t i = 0; i < shown.size(); ++i) {
    if (view_->eye_side(i) != CGAL::POSITIVE || (!images_.shown[i] && !shown[i])) continue;
    Face& f = faces[face(i)];
    f.area += images_.areas[i];
    f.there = f.there || images_.shown[i];
    f.shown = f.shown || shown[i];
  }
  for (const auto& [id, f] : faces)
    if (f.there && !f.shown) {
      ++e.missing;
      e.largest_missing = std::max(e.largest_missing, f.area / sphere);
    }
}

}  // namespace sightline
