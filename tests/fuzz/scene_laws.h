#pragma once
// The checks of `sightline fuzz order`, `graph` and `cutset` that ask a scene by itself, some of which those commands
// ask of a share only: here each of every scene, also of such as no family makes (soups.h).

#include "soups.h"

#include <sightline/harness/laws/cutset.h>
#include <sightline/harness/laws/graph.h>
#include <sightline/harness/laws/order.h>

#include <set>
#include <string>

namespace fuzz {

inline void scene_laws(std::string_view bytes) {
  static const std::vector<harness::Subject> subjects{harness::order(), harness::graph(), harness::cutset()};
  static const std::set<std::string> meant{
      "definition", "graph",    "graph two-sided", "gmpq",         "points",  "first hit",
      "parts",      "path",     "face graph",      "region",       "rays",    "pixels",
      "splits",     "explicit", "empty",           "another_tree", "rounding"};
  Bytes from(bytes);
  Random random(from.word());
  Posed_scene scene;
  if (random.chance(1, 3)) {
    const generate::Family& family = generate::families()[random.below(generate::families().size())];
    generate::Family_parameters parameters;
    parameters.seed = random.below(1000000);
    parameters.size = family.small_size;
    parameters.ulps = random.chance(1, 2) ? 0 : random.between(-2, 2);
    scene = family.make(parameters);
  } else {
    scene = any_soup(random);
  }
  if (scene.soup.face_count() > 24) return;
  const harness::Subject& subject = subjects[random.below(subjects.size())];
  const harness::Answer answer = (subject.verified ? subject.verified : subject.answer)(scene);
  if (!answer.flaw.empty()) throw Finding(subject.name + ": " + answer.flaw);
  for (const harness::Check& check : subject.checks) {
    if (meant.count(check.name) == 0) continue;
    Random own(random.below(1u << 30));
    const harness::Outcome outcome = check.run(scene, answer, own);
    if (outcome.state == harness::Outcome::State::failed)
      throw Finding(subject.name + ", " + check.name + ": " + outcome.what);
  }
}

}  // namespace fuzz
