#pragma once
// All generators, and one that is called by name: `sightline generate KIND --size N --seed S`.

#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace sightline::generate {

/// A generator with its parameters reduced to a size and a seed.
struct Kind {
  std::string_view name, size_means, what;
  std::size_t example_size, small_size;  ///< a scene to look at; one of few faces, for many scenes
  Polygon_soup (*make)(std::size_t size, std::uint64_t seed);
};

/// All kinds of scene, by name, but for those that came later.
std::span<const Kind> kinds();

/// The scene of a kind. Post: the same arguments give the same soup on every machine; `file` is the kind.
/// Pre: the kind is one of kinds() and can be made in this size, or std::invalid_argument with the reason.
Polygon_soup make(std::string_view kind, std::size_t size, std::uint64_t seed);

}  // namespace sightline::generate
