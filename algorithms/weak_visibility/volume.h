#pragma once
// Solids that look: what is seen from some point of their inside.

#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace sightline {

/// A solid that the faces of a scene bound; inside is where their winding number is not zero, so fronts may look
/// outwards or inwards. Bodies may be several, concave, nested, touch, overlap or have faces in common: a face counts
/// as often as it is given. What some point of its inside sees is
/// what its surface sees outwards, and the faces of which it sees a part right in front, from within. Faces of the
/// scene that lie in the surface hide nothing from it, as a source that is a face does not hide what is in front of it.
/// Cost: a tree of its faces; where its faces cross one another's planes nearby, a point location for each part that
/// these cut a face into. Exact: yes. Proof: P-08, P-74
class Weak_volume {
 public:
  /// Errors: std::invalid_argument where the faces do not close up, or enclose nothing.
  explicit Weak_volume(const Polygon_soup& soup);

  ~Weak_volume();

  /// The parts of its faces that have the inside on one side only, convex, counterclockwise as seen from outside. A
  /// face is in parts only where these look to different sides.
  const std::vector<std::vector<Exact_point>>& surface() const { return surface_; }

  /// Whether its inside holds points right in front of some part of a convex polygon, right behind where asked for:
  /// then these see it, whatever else there is. Degenerate: a polygon in the surface is in front of what it looks into,
  /// and behind it of what has it in front. Cost: none to speak of where it is outside the solid's box, else as said
  /// above. Exact: yes
  bool sees_from_within(const std::vector<Exact_point>& polygon, bool behind) const;

 private:
  using Polygon = std::vector<Exact_point>;

  /// A polygon in parts between which the surface may pass, cut by the planes of faces whose boxes meet its own. On
  /// each part, all points right in front are inside, or none; likewise right behind.
  std::vector<Polygon> parts_of(const Polygon& polygon) const;
  /// Whether the points right in front (side 1) or behind (-1) of a part are inside: one of them, nearer than all
  /// planes of faces that its mean is not in.
  bool is_inside_beside(const Polygon& part, const Exact_plane& plane, int beside) const;

  void add_surface(const Polygon& polygon, const Exact_plane& plane);

  struct Space;
  std::unique_ptr<const Space> space_;  // which points are inside
  std::vector<Polygon> polygons_;
  std::vector<Exact_plane> planes_;
  std::vector<std::array<Exact_point, 2>> boxes_;
  std::array<Exact_point, 2> box_;  // of all of them
  std::vector<Polygon> surface_;
};

/// Adds the faces that a volume sees from within to those that its surface was found to see; they are unproved, as they
/// need no sightline. Returns them, sorted. Once out of time, what was found hidden and is not asked is undecided.
/// Cost: Weak_volume::sees_from_within() of the pieces that are not found visible. Exact: yes. Proof: P-74
std::vector<Face_id> add_seen_from_within(const Scene& scene, const Weak_volume& volume, bool two_sided,
                                          Weakly_visible& found, const std::function<bool()>& out_of_time = {});

}  // namespace sightline
