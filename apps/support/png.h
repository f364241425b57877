#pragma once
// PNG pictures, by libpng.

#include <cstdint>
#include <string>
#include <vector>

namespace sightline::app {

/// The file's bytes of an image: red, green, blue and opacity of each pixel, row by row from the top. Pre: 4 width
/// height values. Errors: std::runtime_error with libpng's words.
std::string png(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& rgba);

}  // namespace sightline::app
