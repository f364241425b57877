#pragma once
// What adapters share that trace by Embree: the scene as it has it, in floats.

#include "adapter.h"

#include <sightline/io/decimal.h>

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace adapter {

using Vector = std::array<double, 3>;

inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector near(const Exact_point& p) { return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])}; }

/// The scene's convex pieces in triangles, as Embree has it.
class Traced_scene {
 public:
  explicit Traced_scene(const Scene& scene) : device_(rtcNewDevice("threads=1")), traced_(rtcNewScene(device_)) {
    rtcSetSceneFlags(traced_, RTC_SCENE_FLAG_ROBUST);
    std::vector<std::array<float, 3>> points;
    std::vector<std::array<unsigned, 3>> triangles;
    for (const Piece& piece : scene.pieces()) {
      const auto first = static_cast<unsigned>(points.size());
      for (const Exact_point& p : scene.corner_points(piece)) {
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

  /// The face that a ray hits first beyond some t, if it does so from the front, or from behind where that counts.
  /// Nothing where a number is 1.8e18 or more: there Embree would end the program.
  std::optional<Face_id> hit(const Vector& from, const Vector& direction, bool two_sided, float least_t) const {
    const auto is_taken = [](double x) { return std::fabs(x) < 1.8e18; };
    if (!std::all_of(from.begin(), from.end(), is_taken) || !std::all_of(direction.begin(), direction.end(), is_taken))
      return std::nullopt;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(from[0]);
    query.ray.org_y = static_cast<float>(from[1]);
    query.ray.org_z = static_cast<float>(from[2]);
    query.ray.dir_x = static_cast<float>(direction[0]);
    query.ray.dir_y = static_cast<float>(direction[1]);
    query.ray.dir_z = static_cast<float>(direction[2]);
    query.ray.tnear = least_t;
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

}  // namespace adapter
