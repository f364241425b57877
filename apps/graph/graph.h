#pragma once
// What the sources of `sightline graph` share: its command line, progress within its budget, names of faces.

#include "../support/pixels.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sightline::app {

struct Graph_arguments {
  Common common;
  std::string method = "implicit", eye, direction, dot, html, mesh, certificate;
  std::vector<std::string> box, region;
  bool arcs = false, tree = false, split = false, codes = false, two_sided = false;
  Pixel_arguments pixels;
  bool wants_tree() const { return tree || split || codes || two_sided; }
};

/// One budget for all that a command does, whatever it shows of it.
inline Report shown(const Report& in_time, Progress& progress) {
  return [&](std::size_t done, std::size_t all) {
    in_time(done, all);
    progress(done, all);
  };
}

/// A piece of the scene, as JSON has it.
inline Json name_json(const Scene& scene, std::uint32_t piece) {
  return {scene.pieces()[piece].face, scene.pieces()[piece].number};
}

}  // namespace sightline::app
