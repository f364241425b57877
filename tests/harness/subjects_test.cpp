// The project's own commands as subjects: nothing is found in what is right, and the families' truth is the truth at every distance.

#include <sightline/algorithms/harness/fuzz.h>
#include <sightline/algorithms/harness/subjects.h>

#include <gtest/gtest.h>

#include <cstdlib>

namespace {

using namespace sightline;

#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t rounds = 1;
#else
constexpr std::size_t rounds = 3;
#endif
std::size_t times(std::size_t n) { return std::getenv("SIGHTLINE_LONG") != nullptr ? 20 * n : n; }

class Subjects : public testing::TestWithParam<std::size_t> {};

TEST_P(Subjects, agree_on_scenes_of_every_family) {
  const harness::Subject subject = harness::subjects()[GetParam()];
  harness::Fuzz_options options;
  options.seed = 20, options.scenes = times(40 * rounds);
  harness::Fuzz_summary summary;
  const auto found = harness::fuzz(subject, options, summary);
  if (found) { FAIL() << to_string(found->which) << ", check '" << found->disagreement.check << "': " << found->disagreement.what; }
  EXPECT_GE(summary.cases, 3 * summary.scenes);
  EXPECT_LT(summary.undecided, summary.cases / 20);
  for (const harness::Check& check : subject.checks) EXPECT_GT(summary.by_check[check.name].cases(), 0u) << check.name << " never ran";
}

INSTANTIATE_TEST_SUITE_P(All, Subjects, testing::Range(std::size_t{0}, harness::subjects().size()), [](const auto& of) { return harness::subjects()[of.param].name; });

TEST(Families, know_the_truth_at_every_distance) {
  const harness::Subject weak = harness::weak();
  std::size_t known = 0, undecided = 0;
  for (const generate::Family& family : generate::families())
    for (const std::int64_t ulps : {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, std::int64_t{1000}, std::int64_t{-1000}, generate::far_ulps, -generate::far_ulps})
      for (std::uint64_t seed = 0; seed < times(rounds); ++seed) {
        generate::Family_parameters parameters;
        parameters.seed = seed, parameters.ulps = ulps, parameters.size = family.small_size;
        if (family.small_size > 0) continue;  // kinds know nothing
        const generate::Posed_scene scene = family.make(parameters);
        if (scene.visible.empty() && scene.hidden.empty()) continue;
        harness::Answer answer = harness::weak_subject::by_lines(scene);
        EXPECT_EQ(answer.flaw, "") << family.name << ' ' << seed << ' ' << ulps;
        for (const Face_id face : scene.visible) {
          ++known, undecided += answer.labels[face] == harness::Answer::none;
          EXPECT_NE(answer.labels[face], 0u) << family.name << ' ' << seed << ", " << ulps << " ulps: face " << face << " is said to be visible";
        }
        for (const Face_id face : scene.hidden) {
          ++known, undecided += answer.labels[face] == harness::Answer::none;
          EXPECT_NE(answer.labels[face], 1u) << family.name << ' ' << seed << ", " << ulps << " ulps: face " << face << " is said to be hidden";
        }
      }
  EXPECT_GT(known, 80 * rounds);
  EXPECT_LT(undecided, known / 20);
}

}  // namespace
