// The example of harness/laws/README.md.

#include <sightline/harness/laws/fuzz.h>
#include <sightline/harness/laws/laws.h>

namespace harness = sightline::harness;

/// Which faces have the eye in front of them, as one might write it in doubles.
harness::Answer in_front(const harness::Posed_scene& posed) {
  harness::Answer answer;
  for (sightline::Face_id face = 0; face < posed.soup.face_count(); ++face) {
    std::array<std::array<double, 3>, 3> d{};  // from the eye to three corners
    const auto loop = posed.soup.loop(face);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        d[k][axis] = posed.soup.point(loop[k])[axis].get_d() - posed.eye[axis].get_d();
    double volume = 0;
    for (std::size_t k = 0; k < 3; ++k)
      volume += d[0][k] * (d[1][(k + 1) % 3] * d[2][(k + 2) % 3] - d[1][(k + 2) % 3] * d[2][(k + 1) % 3]);
    answer.labels.push_back(volume < 0 ? 1 : 0);
  }
  return answer;
}

std::string try_it(std::size_t scenes) {
  harness::Subject subject;
  subject.name = "in front";
  subject.answer = in_front;
  harness::add_laws(subject, {"permute", "translate", "rotate", "bystander"});  // what must change nothing
  harness::Fuzz_options options;
  options.scenes = scenes;
  options.family = "edge_on";
  harness::Fuzz_summary summary;
  const auto found = harness::fuzz(subject, options, summary);
  if (!found) return std::to_string(summary.cases) + " cases, nothing found";
  const auto smallest = harness::reduce(subject, found->scene, found->which.parameters.seed, found->disagreement);
  return found->disagreement.check + ", " + std::to_string(smallest.scene.soup.face_count()) + " face";
}

#include <gtest/gtest.h>

namespace {

TEST(Harness_example, finds_what_doubles_get_wrong_and_makes_it_small) { EXPECT_EQ(try_it(1000), "rotate, 1 face"); }

}  // namespace
