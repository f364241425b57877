#include <sightline/harness/generate/exponents.h>

#include <sightline/harness/generate/families.h>
#include <sightline/kernel/vectors.h>

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace sightline::generate {
namespace {

/// Numbers of few sizes, far apart; as often as not, along each axis of one or two sizes only.
class Sizes {
 public:
  explicit Sizes(Random& random) : random_(&random) {
    std::vector<int> all;
    for (std::size_t count = 2 + random.below(4); count > 0; --count)
      all.push_back(static_cast<int>(random.chance(1, 4) ? 0 : random.between(-1070, 1020)));
    const bool by_axis = random.chance(1, 2);
    for (std::vector<int>& powers : powers_) {
      powers = all;
      if (!by_axis) continue;
      random.shuffle(powers);
      powers.resize(1 + random.below(2));
    }
  }
  Rational number(std::size_t axis) {
    if (random_->chance(1, 5)) return 0;
    const std::vector<int>& powers = powers_[axis];
    const Rational size = power_of_two(powers[random_->below(powers.size())]);
    const int sign = random_->chance(1, 2) ? 1 : -1;
    return Rational(sign * integer(*random_, 1, 3) * size);
  }
  /// Two different ones, the smaller one first.
  std::pair<Rational, Rational> extent(std::size_t axis) {
    Rational low = number(axis), high = number(axis);
    while (low == high) high = number(axis);
    if (high < low) std::swap(low, high);
    return {low, high};
  }
  Exact_point point() {
    const Rational x = number(0), y = number(1), z = number(2);
    return {x, y, z};
  }

 private:
  Random* random_;
  std::array<std::vector<int>, 3> powers_;
};

/// Over a segment across the axis, along it.
Points wall(Sizes& sizes, std::size_t axis) {
  Exact_point a = sizes.point(), b = sizes.point();
  std::tie(a[axis], b[axis]) = sizes.extent(axis);
  Exact_point above_a = a, above_b = b;
  above_a[axis] = b[axis];
  b[axis] = a[axis];
  return {a, b, above_b, above_a};
}

Points across(Sizes& sizes, std::size_t axis) {
  const auto [u0, u1] = sizes.extent((axis + 1) % 3);
  const auto [v0, v1] = sizes.extent((axis + 2) % 3);
  const Rational height = sizes.number(axis);
  Points face;
  for (const auto& [u, v] : {std::pair(u0, v0), std::pair(u1, v0), std::pair(u1, v1), std::pair(u0, v1)}) {
    Exact_point p;
    p[axis] = height;
    p[(axis + 1) % 3] = u;
    p[(axis + 2) % 3] = v;
    face.push_back(p);
  }
  return face;
}

/// A face with area.
Points face_of(Sizes& sizes, std::size_t axis, Random& random) {
  for (;;) {
    const Points face = random.chance(1, 3)   ? Points{sizes.point(), sizes.point(), sizes.point()}
                        : random.chance(1, 2) ? wall(sizes, axis)
                                              : across(sizes, axis);
    if (!is_zero(cross(minus(face[1], face[0]), minus(face[2], face[0])))) return either_way(face, random);
  }
}

}  // namespace

Faces_and_source exponents(Random& random) {
  Sizes sizes(random);
  const std::size_t axis = random.below(3);
  Faces_and_source made;
  for (std::size_t count = 2 + random.below(5); count > 0; --count) made.faces.push_back(face_of(sizes, axis, random));
  Sizes of_source = random.chance(1, 2) ? sizes : Sizes(random);
  made.source = face_of(of_source, axis, random);
  return made;
}

}  // namespace sightline::generate
