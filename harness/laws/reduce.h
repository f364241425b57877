#pragma once
// The smallest scene that still fails: a delta debugger. It removes faces and corners and rounds coordinates as long as
// somebody says that the rest still fails.

#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace sightline::harness {

using generate::Posed_scene;

struct Reduce_options {
  std::size_t most_tests = 20000;
  std::function<bool()> out_of_time;                                   ///< asked before each test
  std::function<void(std::size_t tests, std::size_t faces)> progress;  ///< told after each step that was kept
};

struct Reduced {
  Posed_scene scene;
  std::size_t tests = 0;  ///< how often it was asked whether a scene fails
  std::size_t kept = 0;   ///< steps that were kept
  bool finished = false;  ///< no step is left; else tests or time ran out
};

namespace reduce_detail {

/// A scene in pieces that are easy to take out: each face has points of its own.
struct Draft {
  std::vector<std::vector<generate::Points>> faces;  ///< loops
  Exact_point eye{0, 0, 0};
  generate::Points source;

  explicit Draft(const Posed_scene& scene);
  Posed_scene scene(const std::string& name) const;
  /// Calls f for every point.
  template <class Function>
  void for_each_point(Function f) {
    for (auto& loops : faces)
      for (auto& loop : loops)
        for (Exact_point& p : loop) f(p);
    for (Exact_point& p : source) f(p);
    f(eye);
  }
};

/// How long a number is, written down; less is rounder.
std::size_t length_of(const Rational& x);

/// Rounder numbers near x, the roundest first.
std::vector<Rational> rounder(const Rational& x);

class Reducer {
 public:
  Reducer(const Posed_scene& given, const std::function<bool(const Posed_scene&)>& fails, const Reduce_options& options)
      : given_(given), fails_(fails), options_(options), draft_(given) {}

  Reduced run();

 private:
  bool still_fails(const Draft& draft);
  /// Keeps a change if the scene still fails.
  template <class Change>
  bool attempt(Change change);

  /// Runs of faces, from half of them down to single ones. Ref: Zeller and Hildebrandt 2002
  void remove_faces();
  void remove_loops_and_corners();

  std::size_t length();
  /// Maps of all points, kept where the numbers become shorter: a corner to the origin, no denominators, no common
  /// factor, on each axis small integers in the same order.
  void move_all();

  /// A value of an axis, everywhere at once: what is in one plane stays there.
  void round_values();
  /// The points of one place, one coordinate at a time.
  void round_points();

  const Posed_scene& given_;
  const std::function<bool(const Posed_scene&)>& fails_;
  const Reduce_options& options_;
  Draft draft_;
  Reduced result_;
  bool exhausted_ = false;
};

}  // namespace reduce_detail

/// A scene, as small and as round as steps of one at a time make it, for which `fails` still says true: fewer faces,
/// fewer corners, rounder coordinates of faces, eye and source. Where even the scene with its points renumbered does
/// not fail, it is returned as it is, and `kept` is 0. Pre: fails(scene). What is known of the scene's answers is lost.
/// Cost: tests of about (faces + corners + 3 x 8 points) a round, and as many rounds as still help. Ref: Zeller and
/// Hildebrandt 2002
inline Reduced reduce(const Posed_scene& scene, const std::function<bool(const Posed_scene&)>& fails,
                      const Reduce_options& options = {}) {
  return reduce_detail::Reducer(scene, fails, options).run();
}

}  // namespace sightline::harness
