#pragma once
// Scenes from lists of points, for tests.

#include <sightline/kernel/scene/polygon_soup.h>

#include <vector>

namespace test_scenes {

/// Each list is a face.
inline sightline::Polygon_soup soup_of(const std::vector<std::vector<sightline::Exact_point>>& faces) {
  sightline::Polygon_soup soup;
  for (const std::vector<sightline::Exact_point>& face : faces) {
    std::vector<sightline::Point_id> ids;
    for (const sightline::Exact_point& p : face) ids.push_back(soup.add_point(p[0], p[1], p[2]));
    soup.add_face(ids);
  }
  return soup;
}

}  // namespace test_scenes
