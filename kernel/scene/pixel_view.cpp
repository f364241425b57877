#include <sightline/kernel/scene/pixel_view.h>

#include <sightline/kernel/vectors.h>

#include <cstddef>

namespace sightline {

bool Pixel_view::has_places_in_doubles() const {
  const double looks = dot(look, look), rights = dot(right, right), ups = dot(up, up);
  const auto is_moderate = [](double square) { return square > 0x1p-200 && square < 0x1p200; };
  if (!is_moderate(looks) || !is_moderate(rights) || !is_moderate(ups)) return false;
  const double volume = dot(look, cross(right, up));
  const auto is_coarse = [&](double half, std::uint32_t count) { return looks * count * count < 0x1p39 * half; };
  return volume * volume > 1e-6 * (looks * rights * ups) && is_coarse(rights, width) && is_coarse(ups, height);
}

std::array<double, 3> Pixel_view::ray(std::uint32_t x, std::uint32_t y) const {
  const double across = 2 * (x + 0.5) / width - 1, upwards = 1 - 2 * (y + 0.5) / height;
  std::array<double, 3> d{};
  for (std::size_t k = 0; k < 3; ++k) d[k] = look[k] + across * right[k] + upwards * up[k];
  return d;
}

Exact_point Pixel_view::centre(std::uint32_t x, std::uint32_t y) const {
  const auto place = [](std::uint32_t pixel, std::uint32_t count) {
    Rational at(2 * Integer(pixel) + 1 - count, count);
    at.canonicalize();
    return at;
  };
  return direction(place(x, width), Rational(-place(y, height)));
}

Exact_point Pixel_view::direction(const Rational& across, const Rational& upwards) const {
  Exact_point d;
  for (std::size_t k = 0; k < 3; ++k) d[k] = exact(look[k]) + across * exact(right[k]) + upwards * exact(up[k]);
  return d;
}

Image_places::Image_places(const Pixel_view& pixels) {
  const Exact_point look = exact(pixels.look), right = exact(pixels.right), up = exact(pixels.up);
  to_right_ = cross(up, look);
  to_up_ = cross(look, right);
  to_look_ = cross(right, up);
}

std::array<double, 2> Image_places::operator()(const std::array<Integer, 3>& direction) const {
  const Exact_point d{Rational(direction[0]), Rational(direction[1]), Rational(direction[2])};
  const Rational depth = dot(d, to_look_);
  return {nearest_double(Rational(dot(d, to_right_) / depth)), nearest_double(Rational(dot(d, to_up_) / depth))};
}

}  // namespace sightline
