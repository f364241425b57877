#pragma once
// The command line of `sightline shadow`.

#include "../support/picture.h"

#include <string>
#include <vector>

namespace sightline::app {

struct Shadow_arguments {
  Common common;
  std::vector<std::string> lights, suns;
  bool two_sided = false;
  std::string eye, svg, obj, mesh, volume;
  View_arguments view;
};

}  // namespace sightline::app
