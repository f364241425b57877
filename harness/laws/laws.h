#pragma once
// Laws that need no oracle: changes to a scene whose effect on every answer is known.

#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sightline::harness {

/// A scene made of another one, and which face of that each of its faces is, or is a part of.
struct Image {
  Posed_scene scene;
  std::vector<std::optional<Face_id>> face_of;  ///< none: a face of its own
  bool sides_swapped = false;                   ///< fronts became backs
};

/// Where a law applies.
enum class Law_kind {
  everywhere,
  planar_only  ///< which surface a face has that is not planar depends on how it lies to the axes
};

struct Law {
  std::string name, what;
  Law_kind kind;
  std::optional<Image> (*apply)(const Posed_scene&, Random&);  ///< none: this scene has nothing to apply it to
};

// ---- How they are made

std::vector<std::optional<Face_id>> same_faces(const Polygon_soup& soup);

/// A map of points that keeps faces planar and segments free: of the scene, the eye and the source. `mirrors`: it turns
/// loops round, and they are turned back.
template <class Map>
Image moved_by(const Posed_scene& scene, Map map, bool mirrors = false) {
  Image image{scene, same_faces(scene.soup)};
  image.scene.soup = generate::mapped(scene.soup, [&](Point_id, const Exact_point& p) { return map(p); });
  image.scene.eye = map(scene.eye);
  for (Exact_point& p : image.scene.source) p = map(p);
  if (mirrors) {
    image.scene.soup = generate::faces_reversed(image.scene.soup);
    image.scene.source = generate::reversed(image.scene.source);
  }
  return image;
}

/// The corners of a face of one loop that is planar and strictly convex; empty where it is not.
generate::Points convex_corners(const Polygon_soup& soup, Face_id face);

// ---- The laws

/// Loops begun elsewhere, some with a corner repeated or a straight one more.
std::optional<Image> begun_elsewhere(const Posed_scene& scene, Random& random);
std::optional<Image> permuted(const Posed_scene& scene, Random& random);
std::optional<Image> translated(const Posed_scene& scene, Random& random);
std::optional<Image> scaled(const Posed_scene& scene, Random& random);
std::optional<Image> rotated(const Posed_scene& scene, Random& random);
/// Each axis by a power of two of its own, at times one that takes doubles beyond their exponents, and sheared.
std::optional<Image> stretched(const Posed_scene& scene, Random& random);
/// By a projective map that keeps all of a small scene before what it takes to infinity, so that segments stay
/// segments. Nothing for larger ones, whose denominators would have no end, and for three in four.
std::optional<Image> projected(const Posed_scene& scene, Random& random);
std::optional<Image> mirrored(const Posed_scene& scene, Random& random);
/// All faces turned round. Pre: answers tell fronts from backs by bits 1 and 2, or not at all.
std::optional<Image> turned(const Posed_scene& scene, Random&);
/// A convex face in two, along the segment between two points of different edges, or two corners.
std::optional<Image> cut(const Posed_scene& scene, Random& random);
/// One more face, beyond a plane that has the scene, the eye and the source on its other side; of some small scenes so
/// far away, and off their grid, that whole numbers of theirs are just those that doubles hold, or some bits longer.
std::optional<Image> with_a_bystander(const Posed_scene& scene, Random& random);

const std::vector<Law>& laws();

// ---- As checks

/// An answer to an image, as one to the scene: a face's label is the union of the labels of its parts; `none` where one
/// of them has none. Pre: each face of the scene is in the image.
Answer pulled_back(const Image& image, const Answer& of_image, std::size_t faces);

/// That the subject's answer to the image of a scene is the image of its answer.
/// Where there are certificates, that of every fourth image is checked.
Check check_of(const Law& law, const std::function<Answer(const Posed_scene&)>& answer,
               const std::function<Answer(const Posed_scene&)>& verified = {});

/// Appends the laws of these names to a subject's checks.
void add_laws(Subject& subject, const std::vector<std::string>& names);

}  // namespace sightline::harness
