#include "png.h"

#include <png.h>

#include <stdexcept>

namespace sightline::app {

std::string png(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& rgba) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = PNG_FORMAT_RGBA;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, rgba.data(), 0, nullptr) == 0) {
    const std::string what = image.message;
    png_image_free(&image);
    throw std::runtime_error("a PNG cannot be made: " + what);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace sightline::app
