#pragma once
// A scene that one certificate of weak visibility after the other is about: what all of them say of it is checked once.

#include <sightline/algorithms/verify/boxes.h>
#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/parallel.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/verify/weak_lines.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <string>
#include <vector>

namespace sightline::weak_check {

/// Fragments that are the scene, as check_covering() says, and what is asked of them again and again.
class Known_scene {
 public:
  /// Rejects unless they are the scene.
  Known_scene(const Polygon_soup& soup, const Covering& covering, const Workers& workers);

  /// Whether another certificate says the same of the scene: the same fragments, pieces and faces that are set aside,
  /// in the same order. Cost: linear.
  bool is_of(const Covering& other) const;

  const Covered& covered() const { return covered_; }
  const std::vector<Outline>& outlines() const { return outlines_; }
  const Boxes& boxes() const { return boxes_; }

 private:
  Covering covering_;
  Covered covered_;
  std::vector<Outline> outlines_;
  Boxes boxes_;
};

/// What verify_weak() does once the scene is known. Rejects, or returns what was shown, in one line.
std::string check(const Polygon_soup& soup, const Weak_certificate& certificate, const Known_scene& scene,
                  const Verify_options& options);

}  // namespace sightline::weak_check
