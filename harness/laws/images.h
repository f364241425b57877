#pragma once
// What laws of images share: views with what exact rays see there, and how two images are compared.

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/piece_image.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace sightline::harness::images {

/// In one thread.
Image_options serial();

std::string place(const Pixel_view& pixels, std::size_t i);
std::string name(std::uint32_t piece);

/// Both show the same off ties; everywhere, where `ties` says that rules are the same.
Outcome same(const Pixel_view& pixels, const Piece_image& truth, const Piece_image& image, const std::string& method,
             bool ties);

/// A view with its truth.
struct Seen {
  const Polygon_soup& soup;
  Scene scene;
  Pixel_view pixels;

  Seen(const generate::Posed_scene& posed, generate::Random& random);
  Piece_image truth() const;
};

using Image_check = Outcome (*)(const Seen&);

/// A check of scenes that have points, in any view.
Check check_of(const std::string& name, const std::string& what, Image_check run);

}  // namespace sightline::harness::images
