#pragma once
// sightline weak --along: what an eye sees on its way, and when that changes.

#include "../support/common.h"

namespace sightline::app {

struct Along_arguments {
  std::string path;  ///< "X,Y,Z X,Y,Z"
  bool two_sided = false;
  std::string certificate;  ///< the file to write it to, or none
  std::string svg;          ///< the file for a picture of when each face is seen, or none
};

/// Errors: Usage_error where the path is none.
Exit run_along(const Common& common, const Along_arguments& arguments);

}  // namespace sightline::app
