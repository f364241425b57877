#include "rays.h"

#include "../support/command.h"

#include <sightline/kernel/number.h>

#ifdef SIGHTLINE_EMBREE

#include <sightline/kernel/threads.h>

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <string>
#include <thread>

namespace sightline::app {

namespace {

constexpr std::uint32_t packet = 8;  // rays that are traced together: neighbours in a row

/// Whether Embree takes a number of a ray: beyond these it ends the program.
bool is_taken(double x) { return std::fabs(x) < 1.8e18; }
bool are_taken(const std::array<double, 3>& v) { return std::all_of(v.begin(), v.end(), is_taken); }

using Floats = std::array<float, 3>;

Floats rounded(const Exact_point& p) {
  return {static_cast<float>(nearest_double(p[0])), static_cast<float>(nearest_double(p[1])),
          static_cast<float>(nearest_double(p[2]))};
}

/// As long as it has a device, Embree keeps TBB to as many, which has a message for whoever asks for more.
int no_more_than_processors(int threads) {
  return std::min(threads, std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
}

}  // namespace

struct Traced_scene::Handles {
  RTCDevice device;
  RTCScene traced;
  std::vector<std::uint32_t> piece_of;  // each triangle's

  explicit Handles(int threads)
      : device(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())), traced(rtcNewScene(device)) {}
  Handles(const Handles&) = delete;
  ~Handles() {
    rtcReleaseScene(traced);
    rtcReleaseDevice(device);
  }

  /// hit(x, y, piece) for each pixel of a row; nothing where no triangle is hit.
  template <class Hit>
  void trace(const Pixel_view& pixels, std::uint32_t y, Hit hit) const;
};

bool has_rays() { return true; }

Traced_scene::Traced_scene(const Scene& scene, int threads, bool watertight)
    : handles_(std::make_unique<Handles>(threads)) {
  if (watertight) rtcSetSceneFlags(handles_->traced, RTC_SCENE_FLAG_ROBUST);
  std::vector<Floats> points;
  std::vector<std::array<unsigned, 3>> triangles;
  for (std::uint32_t p = 0; p < scene.points().size(); ++p) points.push_back(rounded(scene.position(p)));
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
    const auto corners = scene.corners(scene.pieces()[i]);
    for (std::size_t k = 2; k < corners.size(); ++k) {
      triangles.push_back({corners[0].point, corners[k - 1].point, corners[k].point});
      handles_->piece_of.push_back(i);
    }
  }
  const RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  std::copy(points.begin(), points.end(),
            static_cast<Floats*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                         sizeof(Floats), points.size())));
  std::copy(triangles.begin(), triangles.end(),
            static_cast<std::array<unsigned, 3>*>(rtcSetNewGeometryBuffer(
                geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof triangles[0], triangles.size())));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(handles_->traced, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(handles_->traced);
}
Traced_scene::Traced_scene(Traced_scene&&) noexcept = default;
Traced_scene::~Traced_scene() = default;

template <class Hit>
void Traced_scene::Handles::trace(const Pixel_view& pixels, std::uint32_t y, Hit hit) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const Floats eye = rounded(pixels.eye);
  const bool is_eye_taken = are_taken({eye[0], eye[1], eye[2]});
  for (std::uint32_t first = 0; first < pixels.width; first += packet) {
    // 1. Neighbours in a row; those beyond its end, and what Embree does not take, switched off.
    alignas(64) std::array<int, packet> valid{};
    RTCRayHit8 rays{};
    const std::uint32_t count = std::min(packet, pixels.width - first);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::array<double, 3> d = pixels.ray(first + k, y);
      valid[k] = is_eye_taken && are_taken(d) ? -1 : 0;
      rays.ray.org_x[k] = eye[0];
      rays.ray.org_y[k] = eye[1];
      rays.ray.org_z[k] = eye[2];
      rays.ray.dir_x[k] = static_cast<float>(d[0]);
      rays.ray.dir_y[k] = static_cast<float>(d[1]);
      rays.ray.dir_z[k] = static_cast<float>(d[2]);
      rays.ray.tfar[k] = std::numeric_limits<float>::infinity();
      rays.ray.mask[k] = ~0u;
      rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    }
    // 2. What each hits first.
    rtcIntersect8(valid.data(), traced, &context, &rays);
    for (std::uint32_t k = 0; k < count; ++k)
      hit(first + k,
          rays.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID ? Piece_image::nothing : piece_of[rays.hit.primID[k]]);
  }
}

Traced_hit Traced_scene::first(const Double_ray& ray) const {
  if (!are_taken(ray.origin) || !are_taken(ray.direction)) return {};
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit hit{};
  hit.ray.org_x = static_cast<float>(ray.origin[0]);
  hit.ray.org_y = static_cast<float>(ray.origin[1]);
  hit.ray.org_z = static_cast<float>(ray.origin[2]);
  hit.ray.dir_x = static_cast<float>(ray.direction[0]);
  hit.ray.dir_y = static_cast<float>(ray.direction[1]);
  hit.ray.dir_z = static_cast<float>(ray.direction[2]);
  hit.ray.tfar = std::numeric_limits<float>::infinity();
  hit.ray.mask = ~0u;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(handles_->traced, &context, &hit);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const float ahead = hit.hit.Ng_x * hit.ray.dir_x + hit.hit.Ng_y * hit.ray.dir_y + hit.hit.Ng_z * hit.ray.dir_z;
  return {handles_->piece_of[hit.hit.primID], static_cast<double>(hit.ray.tfar), ahead > 0};
}

Piece_image Traced_scene::image(const Pixel_view& pixels, const Image_options& options) const {
  Piece_image image{pixels.width, pixels.height, {}, {}, {}};
  image.pieces.assign(std::size_t{pixels.width} * pixels.height, Piece_image::nothing);
  run_with_threads(no_more_than_processors(options.threads), [&] {
    std::mutex mutex;
    std::size_t done = 0;
    parallel_for(pixels.height, [&](std::size_t y) {
      const auto row = static_cast<std::uint32_t>(y);
      handles_->trace(pixels, row,
                      [&](std::uint32_t x, std::uint32_t piece) { image.pieces[image.pixel(x, row)] = piece; });
      const std::lock_guard lock(mutex);
      if (options.progress) options.progress(++done, pixels.height);
    });
  });
  image.counters.drawn = handles_->piece_of.size();
  return image;
}

Mean_image Traced_scene::means(const Pixel_view& pixels, unsigned n,
                               const std::function<Colour(std::uint32_t piece)>& colour,
                               const Image_options& options) const {
  const std::size_t count = std::size_t{pixels.width} * pixels.height;
  Mean_image means{pixels.width, pixels.height, std::vector<Colour>(count), std::vector<double>(count)};
  Pixel_view finer = pixels;
  finer.width *= n;
  finer.height *= n;
  const double share = 1.0 / (static_cast<double>(n) * n);
  run_with_threads(no_more_than_processors(options.threads), [&] {
    std::mutex mutex;
    std::size_t done = 0;
    parallel_for(pixels.height, [&](std::size_t y) {
      for (unsigned k = 0; k < n; ++k)
        handles_->trace(finer, static_cast<std::uint32_t>(y) * n + k, [&](std::uint32_t x, std::uint32_t piece) {
          if (piece == Piece_image::nothing) return;
          const std::size_t at = y * pixels.width + x / n;
          const Colour of_piece = colour(piece);
          for (std::size_t c = 0; c < 3; ++c) means.colours[at][c] += share * of_piece[c];
          means.covered[at] += share;
        });
      const std::lock_guard lock(mutex);
      if (options.progress) options.progress(++done, pixels.height);
    });
  });
  return means;
}

}  // namespace sightline::app

#else

namespace sightline::app {

struct Traced_scene::Handles {};

bool has_rays() { return false; }
Traced_scene::Traced_scene(const Scene&, int, bool) {
  throw Usage_error("this program was built without Embree (Debian: libembree-dev), so it has no --method rays");
}
Traced_scene::Traced_scene(Traced_scene&&) noexcept = default;
Traced_scene::~Traced_scene() = default;
Traced_hit Traced_scene::first(const Double_ray&) const { return {}; }
Piece_image Traced_scene::image(const Pixel_view&, const Image_options&) const { return {}; }
Mean_image Traced_scene::means(const Pixel_view&, unsigned, const std::function<Colour(std::uint32_t piece)>&,
                               const Image_options&) const {
  return {};
}

}  // namespace sightline::app

#endif
