#pragma once
// An image in bands of rows, each drawn by one thread.

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/pixel_cones.h>
#include <sightline/kernel/threads.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace sightline::image_detail {

/// Runs work on as many threads as the options say. Where they do not say, a small picture of few pieces is one
/// thread's: it is done before another one has woken up.
template <class Work>
void run_with_threads_for(const Image_options& options, const Pixel_view& pixels, std::size_t pieces,
                          const Work& work) {
  constexpr std::size_t small = 8192;
  const bool is_small = std::size_t{pixels.width} * pixels.height <= small && pieces <= small / 16;
  run_with_threads(options.threads == 0 && is_small ? 1 : options.threads, work);
}

/// Rows [top, bottom), and the cones that may reach them, in their order.
struct Band {
  std::int64_t top, bottom;
  std::vector<std::uint32_t> cones;
};

std::vector<Band> bands_of(const Pixel_cones& cones);

/// Adds the cones of things 0 to before `count`, in their order: add(cones, i). Parallel.
template <class Add>
Pixel_cones all_cones(std::size_t count, const Pixel_cones& none, const Image_options& options, Add add) {
  constexpr std::size_t chunk = 1024;
  const std::size_t chunks = (count + chunk - 1) / chunk;
  std::vector<Pixel_cones> parts(chunks, none);
  parallel_for(chunks, [&](std::size_t k) {
    if (options.progress) options.progress(0, chunks);  // asked, but nothing is drawn yet
    for (std::size_t i = k * chunk; i < std::min(count, (k + 1) * chunk); ++i) add(parts[k], i);
  });
  Pixel_cones all = none;
  for (const Pixel_cones& part : parts) all.append(part);
  return all;
}

/// draw(band, counters) for each. Parallel.
template <class Draw>
Image_counters draw_bands(const std::vector<Band>& bands, const Image_options& options, Draw draw) {
  Image_counters sum;
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(bands.size(), [&](std::size_t i) {
    Image_counters counters;
    draw(bands[i], counters);
    const std::lock_guard lock(mutex);
    sum += counters;
    if (options.progress) options.progress(++done, bands.size());
  });
  return sum;
}

}  // namespace sightline::image_detail
