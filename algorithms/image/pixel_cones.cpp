#include <sightline/algorithms/image/pixel_cones.h>

#include <sightline/kernel/vectors.h>

#include <limits>
#include <stdexcept>

namespace sightline::image_detail {

// ---- Centres

Pixel_centres::Pixel_centres(const Pixel_view& view) : view_(view) {
  constexpr std::uint32_t most = 1u << 20;
  if (view.width < 1 || view.height < 1 || view.width > most || view.height > most)
    throw std::invalid_argument("an image has 1 to 2^20 pixels each way");
  std::array<Exact_point, 3> axes;
  const std::array<const std::array<double, 3>*, 3> given{&view.look, &view.right, &view.up};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      if (!std::isfinite((*given[i])[k])) throw std::invalid_argument("the directions of an image are finite");
      axes[i][k] = sightline::exact((*given[i])[k]);
    }
  if (sgn(dot(axes[0], cross(axes[1], axes[2]))) == 0)
    throw std::invalid_argument("the directions of an image span the space");

  // A centre is look + (2 x + 1 - width) / width right + (height - 2 y - 1) / height up.
  Integer divisor = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    axes[1][k] /= static_cast<unsigned long>(view.width);
    axes[2][k] /= static_cast<unsigned long>(view.height);
    for (const Exact_point& axis : axes) divisor = lcm(divisor, axis[k].get_den());
  }
  for (std::size_t k = 0; k < 3; ++k) {
    look_[k] = Rational(axes[0][k] * divisor).get_num();
    right_[k] = Rational(axes[1][k] * divisor).get_num();
    up_[k] = Rational(axes[2][k] * divisor).get_num();
    size_ = std::max(size_, std::fabs(view.look[k]) + std::fabs(view.right[k]) + std::fabs(view.up[k]));
  }
  size_ *= 1 + 0x1p-50;

  const std::array<double, 3> forth = cross(view.right, view.up);
  const double volume = dot(view.look, forth),
               sizes = dot(view.look, view.look) * dot(view.right, view.right) * dot(view.up, view.up);
  has_places_ = view.has_places_in_doubles();
  if (!has_places_) return;
  skewness_ = std::sqrt(sizes) / std::fabs(volume);
  for (const auto* axis : given) longest_ = std::max(longest_, 1 / std::sqrt(dot(*axis, *axis)));
  const std::array<double, 3> right = cross(view.up, view.look), up = cross(view.look, view.right);
  for (std::size_t k = 0; k < 3; ++k) {
    to_look_[k] = forth[k] / volume;
    to_right_[k] = right[k] / volume;
    to_up_[k] = up[k] / volume;
  }
}

std::int64_t Pixel_centres::column(double across) const {
  const double width = view_.width;
  return static_cast<std::int64_t>(std::floor(std::clamp(((across + 1) * width - 1) / 2, -2.0, width + 2))) + 1;
}

std::array<Integer, 3> Pixel_centres::exact(std::int64_t x, std::int64_t y) const {
  const long across = static_cast<long>(2 * x + 1 - view_.width),
             upwards = static_cast<long>(std::int64_t{view_.height} - 2 * y - 1);
  std::array<Integer, 3> d;
  for (std::size_t k = 0; k < 3; ++k) d[k] = look_[k] + across * right_[k] + upwards * up_[k];
  return d;
}

int Pixel_centres::beside(const std::array<Integer, 3>& normal) const {
  const int right = sgn(dot(normal, right_));
  return right != 0 ? right : sgn(dot(normal, up_)) > 0 ? 1 : -1;
}

std::optional<Pixel_centres::Place> Pixel_centres::place(const Approximate_vector& direction, double error) const {
  if (!has_places_) return std::nullopt;
  const std::array<double, 3> d{direction.x, direction.y, direction.z};
  const double z = dot(d, to_look_), length = dot(d, d);  // d = z (look + across right + upwards up)
  if (!(length > 0x1p-900) || !(z > 1e-6 * std::sqrt(length / dot(view_.look, view_.look)))) return std::nullopt;
  Place at{dot(d, to_right_) / z, dot(d, to_up_) / z, 0};
  if (!std::isfinite(at.across + at.upwards)) return std::nullopt;
  // The dual axes, no longer than skewness / length, are off by 2^-49 skewness of that; products with d by 2^-50 more.
  const double size = std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]);
  at.error = 2 * (3 * error + 0x1p-48 * skewness_ * size) * skewness_ * longest_ / z;
  return at;
}

// ---- Forms

// Three products and two sums for each coefficient, two for k, two at a centre, one for across: 12 roundings of 2^-53
// at most, of terms whose sum is size x size.
Pixel_form::Pixel_form(const Pixel_centres& centres, const Approximate_eye_plane& plane) {
  const Pixel_view& view = centres.view();
  a = dot(plane.normal, view.right);
  b = dot(plane.normal, view.up);
  c = dot(plane.normal, view.look);
  bound = centres.size() * (3 * plane.error + 0x1p-48 * plane.size) + 0x1p-960 * (1 + centres.size() + plane.size);
  // Where products are too large for doubles, their sum may not be: the form says nothing.
  if (std::fabs(a) + std::fabs(b) + std::fabs(c) < 0x1p1000 && std::isfinite(bound)) return;
  a = b = c = 0;
  bound = std::numeric_limits<double>::infinity();
}

void Pixel_span::narrow(const Pixel_centres& centres, const Pixel_form& form, double k) {
  // The form is a across + k. Where that is more than the bound, and where it is less than minus the bound, is told one
  // column away from where doubles put it.
  if (!std::isfinite(form.a) || !std::isfinite(k) || !std::isfinite(form.bound)) {
    inner_last = inner_first;
    return;
  }
  if (form.a == 0) {
    if (k < -form.bound) last = first;
    if (!(k > form.bound)) inner_last = inner_first;
    return;
  }
  const std::int64_t maybe = centres.column((-form.bound - k) / form.a),
                     surely = centres.column((form.bound - k) / form.a);
  if (form.a > 0) {
    first = std::max(first, maybe - 1);
    inner_first = std::max(inner_first, surely + 1);
  } else {
    last = std::min(last, maybe + 1);
    inner_last = std::min(inner_last, surely - 1);
  }
}

// ---- Cones

bool Pixel_cones::add(const std::vector<Approximate_vector>& corners, double beyond) {
  const Pixel_view& view = centres_->view();
  Cone cone{edges_.size(), 0, 0, static_cast<std::int32_t>(view.width), 0, static_cast<std::int32_t>(view.height)};
  std::array<double, 4> box{1, -1, 1, -1};  // across from, to; upwards from, to
  bool placed = true;
  for (const Approximate_vector& corner : corners) {
    const double size = std::fabs(corner.x) + std::fabs(corner.y) + std::fabs(corner.z);
    const auto at = centres_->place(corner, 0x1p-40 * size);
    placed = placed && at;
    if (!placed) break;
    const double across = at->error * std::max(1.0, std::fabs(at->across)),
                 upwards = at->error * std::max(1.0, std::fabs(at->upwards));
    box = {std::min(box[0], at->across - across), std::max(box[1], at->across + across),
           std::min(box[2], at->upwards - upwards), std::max(box[3], at->upwards + upwards)};
  }
  if (placed) {  // centre i of a row is at (2 i + 1) / count - 1; 2^-20 of a pixel is for doubles
    const auto centre = [](double place, std::uint32_t count, double more) {
      return std::clamp(((place + 1) * count - 1) / 2 + more, -2.0, count + 2.0);
    };
    const double more = beyond + 0x1p-20;
    const auto first = [&](double place, std::uint32_t count) {
      return std::max(0, static_cast<std::int32_t>(std::ceil(centre(place, count, -more))));
    };
    const auto last = [&](double place, std::uint32_t count) {
      return std::min(static_cast<std::int32_t>(count),
                      static_cast<std::int32_t>(std::floor(centre(place, count, more))) + 1);
    };
    cone.left = first(box[0], view.width);
    cone.right = last(box[1], view.width);
    cone.top = first(-box[3], view.height);
    cone.bottom = last(-box[2], view.height);
  }
  const bool holds = cone.left < cone.right && cone.top < cone.bottom;
  if (!holds) cone.left = cone.right = cone.top = cone.bottom = 0;
  cones_.push_back(cone);
  return holds;
}

void Pixel_cones::append(const Pixel_cones& others) {
  const std::size_t shift = edges_.size();
  edges_.insert(edges_.end(), others.edges_.begin(), others.edges_.end());
  for (Cone cone : others.cones_) {
    cone.first_edge += shift;
    cones_.push_back(cone);
  }
}

Pixel_span Pixel_cones::narrowed(std::uint32_t cone, std::int64_t y) const {
  const Cone& c = cones_[cone];
  const double upwards = centres_->upwards(y);
  Pixel_span span{c.left, c.right, c.left, c.right};
  for (const Pixel_form& form : edges(cone)) {
    if (span.first >= span.last) break;
    span.narrow(*centres_, form, form.at_row(upwards));
  }
  span.last = std::max(span.first, span.last);
  span.inner_first = std::clamp(span.inner_first, span.first, span.last);
  span.inner_last = std::clamp(span.inner_last, span.inner_first, span.last);
  return span;
}

Pixel_cones::Columns Pixel_cones::columns(std::uint32_t cone, std::int64_t y, Image_counters& counters) const {
  const Pixel_span span = narrowed(cone, y);
  const auto is_outside = [&](std::int64_t x) {
    return (x < span.inner_first || x >= span.inner_last) && side(cone, x, y, counters) < 0;
  };
  Columns columns{span.first, span.last};
  while (columns.first < columns.last && is_outside(columns.first)) ++columns.first;
  while (columns.first < columns.last && is_outside(columns.last - 1)) --columns.last;
  return columns;
}

int Pixel_cones::side(std::uint32_t cone, std::uint32_t edge, std::int64_t x, std::int64_t y,
                      Image_counters& counters) const {
  const Pixel_form& form = edges_[cones_[cone].first_edge + edge];
  const double value = form.a * centres_->across(x) + form.at_row(centres_->upwards(y));
  if (value > form.bound) return 1;
  if (value < -form.bound) return -1;
  ++counters.exact_sides;
  return sgn(dot(exact_normal_(cone, edge), centres_->exact(x, y)));
}

bool Pixel_cones::holds_beside(std::uint32_t cone, std::int64_t x, std::int64_t y, Image_counters& counters) const {
  for (std::uint32_t e = 0; e < cones_[cone].edges; ++e) {
    if (side(cone, e, x, y, counters) != 0) continue;
    const std::array<Integer, 3> normal = exact_normal_(cone, e);
    const Pixel_form& form = edges_[cones_[cone].first_edge + e];  // is all there is where numbers are rounded
    const bool inside = is_zero(normal) ? form.a > 0 || (form.a == 0 && form.b >= 0) : centres_->beside(normal) > 0;
    if (!inside) return false;
  }
  return true;
}

int Pixel_cones::side(std::uint32_t cone, std::int64_t x, std::int64_t y, Image_counters& counters) const {
  int least = 1;
  for (std::uint32_t e = 0; e < cones_[cone].edges && least >= 0; ++e)
    least = std::min(least, side(cone, e, x, y, counters));
  return least;
}

}  // namespace sightline::image_detail
