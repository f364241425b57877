#pragma once
// Where one looks from.

#include <sightline/kernel/scene/polygon_soup.h>

namespace sightline {

/// A point to look from, or a direction towards a viewpoint at infinity (of any length but zero).
struct Viewpoint {
  Exact_point at;
  bool at_infinity = false;
};
bool operator==(const Viewpoint& a, const Viewpoint& b);

}  // namespace sightline
