#include <sightline/harness/laws/empty_scenes.h>

#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace empty_scenes {

/// The points, and, where it is asked for, faces that go from one of them to another one and back.
Polygon_soup without_area(const Polygon_soup& soup, bool with_faces) {
  Polygon_soup flat;
  for (Point_id p = 0; p < soup.point_count(); ++p)
    flat.add_point(soup.point(p)[0], soup.point(p)[1], soup.point(p)[2]);
  for (Face_id f = 0; f < soup.face_count() && with_faces; ++f) {
    const auto loop = soup.loop(f);
    if (loop.empty()) continue;
    flat.add_face({loop[0], loop.back(), loop[0], loop.back()});
  }
  return flat;
}

Outcome run(const std::function<Answer(const Posed_scene&)>& answer, const Posed_scene& posed, Random& random) {
  Posed_scene empty = posed;
  empty.soup = random.chance(1, 4) ? Polygon_soup() : without_area(posed.soup, random.chance(1, 2));
  const Answer found = answer(empty);
  if (!found.flaw.empty()) return Outcome::failed("without any area " + found.flaw);
  if (found.labels.size() != empty.soup.face_count())
    return Outcome::failed("without any area there are " + std::to_string(found.labels.size()) + " labels");
  for (std::size_t f = 0; f < found.labels.size(); ++f)
    if (found.labels[f] != Answer::none) return Outcome::failed(face_name(f) + " has no area, but a label");
  return {};
}

}  // namespace empty_scenes

Check empty_scenes_check(std::function<Answer(const Posed_scene&)> answer) {
  return {"empty", "nothing is said of faces without area, nor where there are none",
          [answer = std::move(answer)](const Posed_scene& posed, const Answer&, Random& random) {
            return empty_scenes::run(answer, posed, random);
          },
          16};
}

}  // namespace sightline::harness
