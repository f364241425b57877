// The search, with events for what it leaves open, against z3: every face of small scenes, by two programs that share
// no more than the scene. SIGHTLINE_LONG: so many times the scenes, for a long run.

#include "../sample.h"
#include "parallel_planes.h"
#include "z3.h"

#include <sightline/harness/generate/families.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/weak.h>

#include <gtest/gtest.h>

#include <iostream>

namespace weak_opinions {
namespace {

using namespace sightline;
using weak_scenes::Points;
using weak_scenes::Random;
using weak_scenes::Weak_scene;

/// Of z3 for one piece: a third of a second, as a rule.
constexpr unsigned z3_effort = 300000;
/// Larger scenes are not asked about: z3 says little of them.
constexpr std::size_t most_faces = 20;

struct Opinions {
  std::size_t scenes = 0, agreed = 0;         ///< `agreed`: of each face both say the same
  std::size_t visible = 0, hidden = 0;        ///< faces, by both
  std::size_t by_events = 0;                  ///< of these, faces that lines left open
  std::size_t z3_unknown = 0, undecided = 0;  ///< faces that z3, or the engine, says nothing about
};
std::ostream& operator<<(std::ostream& to, const Opinions& o) {
  return to << o.agreed << " of " << o.scenes << " scenes agree in all faces; of faces " << o.visible
            << " are visible and " << o.hidden << " hidden by both, " << o.by_events << " of them by events; z3 leaves "
            << o.z3_unknown << " open, the engine " << o.undecided;
}

/// Asks both about all faces of a scene.
void ask_both(const Weak_scene& scene, Opinions& sum) {
  const Scene read(scene.soup);
  const Occluders occluders(read);
  const std::vector<Weak_source> sources{weak_source(occluders, scene.source)};
  Weak_options lines;
  lines.search.cells = 2000;
  Weakly_visible found = weakly_visible(occluders, sources, lines);
  const std::vector<Face_id> left_open = found.undecided;
  search_thoroughly(occluders, sources, lines, found);
  settle_by_events(occluders, sources, 300, {}, found);

  bool agree = true;
  const auto compare = [&](const std::vector<Face_id>& faces, bool visible) {
    for (const Face_id face : faces) {
      const std::optional<bool> z3 = weak_oracle::z3_says(scene, face, z3_effort);
      EXPECT_EQ(z3.value_or(visible), visible) << scene.name << ", face " << face;
      agree = agree && z3 == visible;
      if (!z3) ++sum.z3_unknown;
      else {
        ++(visible ? sum.visible : sum.hidden);
        sum.by_events += std::binary_search(left_open.begin(), left_open.end(), face);
      }
    }
  };
  compare(found.visible, true);
  compare(found.hidden, false);
  sum.undecided += found.undecided.size();
  ++sum.scenes;
  sum.agreed += agree && found.undecided.empty();
}

TEST(Engine_and_z3, say_the_same_of_scenes_with_a_source) {
  if (!weak_oracle::has_z3()) GTEST_SKIP() << "needs z3 (Debian: z3)";
  std::vector<weak_scenes::Family> families = weak_scenes::families();
  families.push_back({"parallel_planes", weak_oracle::parallel_planes_scene});
  Opinions sum;
  const std::size_t step = test_scenes::is_sanitized() ? 3 : 1;  // sanitizers do not see into z3
  for (std::size_t k = 0; k < families.size(); k += step)
    for (std::uint64_t seed = k; seed < k + weak_scenes::seeds(1); ++seed) ask_both(families[k].make(seed), sum);
  std::cout << sum << '\n';
  EXPECT_GT(2 * sum.agreed, sum.scenes);
  EXPECT_GT(10 * sum.visible, sum.scenes);
  EXPECT_GT(10 * sum.hidden, sum.scenes);
  EXPECT_LT(20 * sum.undecided, sum.visible + sum.hidden);
}

/// Scenes made for an eye: one of their own faces is the source, so that it touches, crosses, or is in the plane of
/// others.
TEST(Engine_and_z3, say_the_same_of_scenes_that_a_face_of_their_own_looks_at) {
  if (!weak_oracle::has_z3()) GTEST_SKIP() << "needs z3 (Debian: z3)";
  Opinions sum;
  for (std::size_t k = 0; k < generate::families().size(); ++k)
    for (std::uint64_t seed = 0; seed < weak_scenes::seeds(1); ++seed) {
      // An eighth of the families for each seed: all of them take a minute. Sanitizers do not see into z3.
      if ((k + seed) % (test_scenes::is_sanitized() ? 16 : 8) != 2) continue;
      const generate::Family& family = generate::families()[k];
      generate::Family_parameters parameters;
      parameters.seed = seed;
      parameters.size = family.small_size;
      parameters.ulps = static_cast<std::int64_t>(seed % 3) - 1;
      const generate::Posed_scene posed = family.make(parameters);
      const Scene read(posed.soup);
      if (!posed.source.empty() || read.pieces().empty() || read.pieces().size() > most_faces) continue;
      const Points source = read.corner_points(read.pieces()[Random(seed).below(read.pieces().size())]);
      ask_both({posed.name, posed.soup, source, {}, std::nullopt}, sum);
    }
  std::cout << sum << '\n';
  EXPECT_GT(2 * sum.agreed, sum.scenes);
  EXPECT_GT(sum.visible, sum.scenes);
  EXPECT_GT(sum.hidden, sum.scenes);
  EXPECT_LT(20 * sum.undecided, sum.visible + sum.hidden);
}

}  // namespace
}  // namespace weak_opinions
