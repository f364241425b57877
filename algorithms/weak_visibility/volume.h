#pragma once
// Solids that look: what is seen from some point of their inside.

#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace sightline {

/// A solid that the faces of a scene bound; inside is where their winding number is not zero, so fronts may look
/// outwards or inwards. Bodies may be several, concave, nested, touch, overlap or have faces in common: a face counts
/// as often as it is given. What some point of its inside sees is
/// what its surface sees outwards, and the faces of which it sees a part right in front, from within. Faces of the
/// scene that lie in the surface hide nothing from it, as a source that is a face does not hide what is in front of it.
/// Cost: for each face a ray, which looks at the ranges of all faces in doubles and at those that it is near exactly;
/// where others meet a face's inside, a ray for each part that their planes cut it into, two where one of them is in
/// its plane. Exact: yes. Proof: P-08, P-74
class Weak_volume {
 public:
  /// Errors: std::invalid_argument where the faces do not close up, or enclose nothing. `progress` is told how far it
  /// is; what it throws ends it.
  explicit Weak_volume(const Polygon_soup& soup,
                       const std::function<void(std::size_t done, std::size_t all)>& progress = {});

  ~Weak_volume();

  /// The parts of its faces that have the inside on one side only, convex, counterclockwise as seen from outside. A
  /// face is in parts only where these look to different sides.
  const std::vector<std::vector<Exact_point>>& surface() const& { return surface_; }
  void surface() const&& = delete;  // of what is gone when it is looked at

  /// Whether its inside holds points right in front of some part of a convex polygon, right behind where asked for:
  /// then these see it, whatever else there is. Degenerate: a polygon in the surface is in front of what it looks into,
  /// and behind it of what has it in front. Cost: none to speak of where it is outside the solid's box, else as said
  /// above. Exact: yes
  bool sees_from_within(const std::vector<Exact_point>& polygon, bool behind) const;

 private:
  using Polygon = std::vector<Exact_point>;
  /// Is called all the time, and may throw.
  using Go_on = std::function<void()>;
  struct Face;
  struct Parts {
    std::vector<Polygon> polygons;
    std::size_t covers;  // faces that may cover some of them
  };

  /// A polygon in parts between which the surface may pass, cut by the planes of faces that may meet its inside. On
  /// each part, all points right in front are inside, or none; likewise right behind.
  Parts parts_of(const Polygon& polygon, const Exact_plane& plane, const Go_on& go_on) const;
  /// The winding number of the points right in front (side 1) or behind (-1) of a part: along a ray from its mean.
  int winding_beside(const Polygon& part, const Exact_plane& plane, int beside) const;

  void add_surface(std::size_t k, const Go_on& go_on);

  std::vector<Face> faces_;
  std::array<std::array<double, 2>, 3> box_;  // of all of them, in nearest doubles
  std::vector<Polygon> surface_;
};

/// Adds the faces that a volume sees from within to those that its surface was found to see; they are unproved, as they
/// need no sightline. Returns them, sorted. Once out of time, what was found hidden and is not asked is undecided.
/// Cost: Weak_volume::sees_from_within() of the pieces that are not found visible. Exact: yes. Proof: P-74
std::vector<Face_id> add_seen_from_within(const Scene& scene, const Weak_volume& volume, bool two_sided,
                                          Weakly_visible& found, const std::function<bool()>& out_of_time = {});

}  // namespace sightline
