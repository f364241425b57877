// An adapter for `sightline judge`: weak visibility estimated by random rays that Embree traces, in floats. A fourth
// argument is the number of rays.

#include "embree.h"

#include <cmath>
#include <random>
#include <set>

namespace {

using namespace sightline;
using adapter::dot, adapter::near, adapter::Traced_scene, adapter::Vector;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector unit(const Vector& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// Rays from points spread evenly over the source, to all sides in front of it; what they hit is visible, all else is
/// said to be hidden.
void solve(const adapter::Task& task) {
  const std::size_t rays = task.more.empty() ? 100000 : std::stoul(task.more[0]);
  const Traced_scene scene(task.scene);
  std::vector<Vector> source;
  for (const Exact_point& p : task.query.source) source.push_back(near(p));
  std::vector<double> areas;
  Vector sum{};
  for (std::size_t k = 2; k < source.size(); ++k) {
    const Vector part = cross(minus(source[k - 1], source[0]), minus(source[k], source[0]));
    for (std::size_t i = 0; i < 3; ++i) sum[i] += part[i];
    areas.push_back((areas.empty() ? 0 : areas.back()) + std::sqrt(dot(part, part)));
  }
  const Vector up = unit(sum), u = unit(minus(source[1], source[0])), v = cross(up, u);
  std::mt19937_64 dice(1);
  std::uniform_real_distribution<double> share(0, 1);
  std::set<Face_id> visible;
  for (std::size_t ray = 0; ray < rays; ++ray) {
    const double place = share(dice) * areas.back();
    const std::size_t k =
        2 + std::min(areas.size() - 1,
                     static_cast<std::size_t>(std::upper_bound(areas.begin(), areas.end(), place) - areas.begin()));
    double s = share(dice), t = share(dice);
    if (s + t > 1) {
      s = 1 - s;
      t = 1 - t;
    }
    const Vector a = minus(source[k - 1], source[0]), b = minus(source[k], source[0]);
    const double height = share(dice), angle = 6.283185307179586 * share(dice), flat = std::sqrt(1 - height * height);
    Vector from{}, direction{};
    for (std::size_t i = 0; i < 3; ++i) {
      from[i] = source[0][i] + s * a[i] + t * b[i];
      direction[i] = flat * std::cos(angle) * u[i] + flat * std::sin(angle) * v[i] + height * up[i];
    }
    if (const auto face = scene.hit(from, direction, task.query.two_sided, 1e-4f)) visible.insert(*face);
  }
  adapter::write_answer(task, {{"visible", visible}});
}

}  // namespace

int main(int argc, char** argv) { return adapter::main(argc, argv, sightline::judge::Question::weak, solve); }
