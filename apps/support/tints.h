#pragma once
// What pieces look like in pictures: by the palette, an OBJ's materials, or a list of colours.

#include "common.h"

#include <sightline/algorithms/image/colour.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace sightline {
class Exact_view;
}

namespace sightline::app {

struct Tint_arguments {
  std::string colours = "palette";
  double alpha = 1;

  void add_to(Command command);
};

/// The tint of each piece as the eye sees it, lighter towards the light where they are lit. Errors: Usage_error for
/// materials of what is no OBJ; Input_error for files, also where a list has fewer or more lines than there are faces.
std::vector<Tint> tints_of(const Tint_arguments& arguments, const std::string& scene_file, const Exact_view& view,
                           bool lit, const Report& progress = {});
/// Whether any of them lets something through.
bool is_transparent(const std::vector<Tint>& tints);

}  // namespace sightline::app
