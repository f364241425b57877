#pragma once
// Winding numbers by brute force, in rationals, and points to ask them at.

#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <string>
#include <vector>

namespace sightline::harness {

/// A surface by the convex parts of its faces alone, each face cut by itself. Nothing of it is shared with set
/// operations.
class Solid_oracle {
 public:
  explicit Solid_oracle(const Polygon_soup& soup);

  /// Faces with area that bound nothing: they cross themselves.
  const std::vector<Face_id>& unusable() const { return unusable_; }
  bool has_bent_faces() const { return has_bent_faces_; }
  /// The convex parts, each with points of its own.
  Polygon_soup parts() const;
  bool is_on_a_face(const Exact_point& p) const;
  /// Pre: !is_on_a_face(p), and the surface is closed.
  int winding(const Exact_point& p, generate::Random& random) const;

 private:
  std::vector<Flat_face> faces_;
  std::vector<Face_id> unusable_;
  bool has_bent_faces_ = false;
};

std::vector<Exact_point> corners_of(const Polygon_soup& soup);
/// Anywhere that something may be wrong: on the way between two corners, a little beside it. Pre: there are corners.
Exact_point any_point_of(const std::vector<Exact_point>& corners, generate::Random& random);
std::string text_of(const Exact_point& p);

}  // namespace sightline::harness
