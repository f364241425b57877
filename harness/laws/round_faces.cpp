#include <sightline/harness/laws/round_faces.h>

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace round_faces {

using generate::Points;

/// Points of a parabola about a point of the scene, about as large as the scene; none where its axes are on one line.
Points parabola(const Polygon_soup& soup, std::size_t corners, Random& random) {
  Exact_point low = soup.point(0), high = low;
  for (Point_id p = 0; p < soup.point_count(); ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], soup.point(p)[k]);
      high[k] = std::max(high[k], soup.point(p)[k]);
    }
  const Exact_point origin = soup.point(static_cast<Point_id>(random.below(soup.point_count()))),
                    u = generate::lattice(random, 3), v = generate::lattice(random, 3);
  if (is_zero(cross(u, v))) return {};
  Rational size = 0;
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, Rational(high[k] - low[k]));
  size /= static_cast<long>(random.between(2, 8));
  const long half = static_cast<long>(corners / 2);
  Points polygon;
  for (long i = -half; i <= half; ++i) {
    const Rational x = size * i / half;
    polygon.push_back(generate::along(generate::along(origin, x, u), x * i / half, v));
  }
  return polygon;
}

/// Adds the polygon as a face, and its fan of triangles to the image.
void add(const Points& polygon, Posed_scene& whole, Image& image) {
  const Face_id face = whole.soup.add_face(generate::added(whole.soup, polygon));
  const std::vector<Point_id> ids = generate::added(image.scene.soup, polygon);
  for (std::size_t k = 1; k + 1 < ids.size(); ++k) {
    image.scene.soup.add_face({ids[0], ids[k], ids[k + 1]});
    image.face_of.emplace_back(face);
  }
}

Outcome run(const std::function<Answer(const Posed_scene&)>& answer, const Posed_scene& posed, std::size_t most_corners,
            Random& random) {
  constexpr std::size_t most_faces = 8, least_corners = 5, most_polygons = 2;
  if (posed.soup.face_count() > most_faces || posed.soup.point_count() == 0) return Outcome::not_applicable();
  Posed_scene whole = posed;
  Image image{posed, same_faces(posed.soup)};
  for (std::size_t k = 1 + random.below(most_polygons); k > 0; --k) {
    Points polygon = parabola(posed.soup, least_corners + random.below(most_corners - least_corners + 1), random);
    if (polygon.empty()) continue;
    if (random.chance(1, 2)) polygon = generate::reversed(std::move(polygon));
    add(polygon, whole, image);
  }
  if (whole.soup.face_count() == posed.soup.face_count()) return Outcome::not_applicable();
  const Answer of_whole = answer(whole), of_parts = answer(image.scene);
  if (!of_whole.flaw.empty()) return Outcome::failed("with polygons of many corners: " + of_whole.flaw);
  return compared(of_whole, pulled_back(image, of_parts, whole.soup.face_count()), "polygons of many corners",
                  "their triangles");
}

}  // namespace round_faces

Check round_faces_check(std::function<Answer(const Posed_scene&)> answer, std::size_t most_corners, std::size_t share) {
  return {"round", "polygons of many corners are as their triangles",
          [answer = std::move(answer), most_corners](const Posed_scene& posed, const Answer&, Random& random) {
            return round_faces::run(answer, posed, most_corners, random);
          },
          share};
}

}  // namespace sightline::harness
