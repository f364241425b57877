#pragma once
// What a back-to-front order is judged against: which faces must be in it, and for each two which one must come first.

#include <sightline/algorithms/verify/pairs.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/harness/compare/flat_polygon.h>
#include <sightline/harness/judge/grade.h>
#include <sightline/harness/judge/protocol.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstddef>
#include <set>
#include <vector>

namespace sightline::judge {

/// A scene and an eye, ready to judge orders. Whole faces are compared exactly, by the code of `verify`. A part has
/// rounded corners as a rule, so it is moved onto its face's exact plane along the dominant axis, stands for its convex
/// hull there, and is compared smaller by 2^-20 about its middle, or not at all where it has less than 2^-20 of its
/// face's area; one that is out of the plane by more than 2^-20 of the face's size is wrong. Pre: all faces are planar.
/// Degenerate: faces in whose plane the eye is may stand anywhere, or be missing; contact is no overlap; equal distance
/// is in order both ways. Exact: yes.
class Order_truth {
 public:
  Order_truth(const Scene& scene, const Exact_point& eye, bool two_sided);

  /// Whether some order of the whole faces that must be in it is right; else the scene needs cuts.
  bool whole_faces_do() const { return !has_cycle_; }

  /// Pre: faces of the answer are below the scene's number of faces. Cost: about O(n log n) and the pairs that overlap.
  Grade grade(const Answer& answer) const;

  /// The wrong pairs alone, sorted: drawn earlier but nearer somewhere, and what is drawn over it. What is missing, or
  /// out of its face, is not looked for, which takes long where a face is in hundreds of parts.
  std::vector<std::array<Face_id, 2>> wrong_pairs(const Answer& answer) const;

 private:
  static constexpr int tolerance_bits = 20;  // of parts: what a picture does not show

  struct Face {
    std::vector<order_check::Polygon> pieces;  // none: it is set aside
    std::array<Rational, 4> plane;
    std::size_t axis = 0;  // the dominant one of the normal
    Rational size, area;   // the longest side of its box; seen along the axis
    bool required = false;

    void set_plane(const std::array<Rational, 4>& coefficients);
    void measure();
    Flat_polygon flat(const std::vector<Exact_point>& points) const;
    /// Whether some corner is out of the plane, along the dominant axis, by more than the tolerance of the face's size.
    bool leaves(const std::vector<Exact_point>& part) const;
    /// A part on the plane, smaller by the tolerance, in either sense.
    order_check::Polygon shrunk(const Flat_polygon& part) const;
  };

  /// Hands on each two cones of different owners that may overlap, both ways round.
  template <class Take>
  static void each_pair(const std::vector<order_check::Cone>& cones, Take take);

  void find_cycle();

  /// Faces that are missing, in part or altogether, and parts that reach out of their faces.
  void judge_areas(const Answer& answer, Grade& grade, std::set<Face_id>& shown, std::set<Face_id>& hidden) const;
  static std::vector<Flat_polygon> without(const std::vector<Flat_polygon>& polygons, const Flat_polygon& other);

  Exact_point eye_;
  std::vector<Face> faces_;
  bool has_cycle_ = false;
};

}  // namespace sightline::judge
