// An adapter for `sightline judge`: weak visibility estimated by random rays that Embree traces, in floats. A fourth
// argument is the number of rays.

#include "adapter.h"

#include <sightline/io/decimal.h>

#include <embree3/rtcore.h>

#include <cmath>
#include <random>
#include <set>

namespace {

using namespace sightline;
using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector near(const Exact_point& p) { return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])}; }
Vector unit(const Vector& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// The scene's convex pieces in triangles, as Embree has it.
class Traced_scene {
 public:
  explicit Traced_scene(const Scene& scene) : device_(rtcNewDevice("threads=1")), traced_(rtcNewScene(device_)) {
    rtcSetSceneFlags(traced_, RTC_SCENE_FLAG_ROBUST);
    std::vector<std::array<float, 3>> points;
    std::vector<std::array<unsigned, 3>> triangles;
    for (const Piece& piece : scene.pieces()) {
      const auto first = static_cast<unsigned>(points.size());
      for (const Exact_point& p : adapter::corners(scene, piece)) {
        const Vector at = near(p);
        points.push_back({static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])});
      }
      for (unsigned k = 2; k < piece.size; ++k) {
        triangles.push_back({first, first + k - 1, first + k});
        face_of_.push_back(piece.face);
      }
    }
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    std::copy(points.begin(), points.end(),
              static_cast<std::array<float, 3>*>(rtcSetNewGeometryBuffer(
                  geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof points[0], points.size())));
    std::copy(triangles.begin(), triangles.end(),
              static_cast<std::array<unsigned, 3>*>(rtcSetNewGeometryBuffer(
                  geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof triangles[0], triangles.size())));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(traced_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(traced_);
  }
  Traced_scene(const Traced_scene&) = delete;
  ~Traced_scene() {
    rtcReleaseScene(traced_);
    rtcReleaseDevice(device_);
  }

  /// The face that a ray hits first, if it does so from the front, or from behind where that counts.
  std::optional<Face_id> hit(const Vector& from, const Vector& direction, bool two_sided) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(from[0]);
    query.ray.org_y = static_cast<float>(from[1]);
    query.ray.org_z = static_cast<float>(from[2]);
    query.ray.dir_x = static_cast<float>(direction[0]);
    query.ray.dir_y = static_cast<float>(direction[1]);
    query.ray.dir_z = static_cast<float>(direction[2]);
    query.ray.tnear = 1e-4f;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(traced_, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const Vector normal{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z};
    if (!two_sided && dot(normal, direction) >= 0) return std::nullopt;
    return face_of_[query.hit.primID];
  }

 private:
  RTCDevice device_;
  RTCScene traced_;
  std::vector<Face_id> face_of_;  // of each triangle
};

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
    if (const auto face = scene.hit(from, direction, task.query.two_sided)) visible.insert(*face);
  }
  adapter::write_answer(task, {{"visible", visible}});
}

}  // namespace

int main(int argc, char** argv) { return adapter::main(argc, argv, sightline::judge::Question::weak, solve); }
