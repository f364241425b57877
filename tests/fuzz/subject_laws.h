#pragma once
// The checks of `sightline fuzz weak`, `pvs`, `render`, `boolean`, `see`, `shadow` and `trace` that ask a scene by
// itself, which those commands ask after all their images of it, or of a share of them only: here one of them for each
// scene, and images not.

#include "any_case.h"
#include "scene_laws.h"

#include <sightline/harness/laws/fuzz.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/harness/laws/levels.h>
#include <sightline/harness/laws/render.h>
#include <sightline/harness/laws/see.h>
#include <sightline/harness/laws/shadow.h>
#include <sightline/harness/laws/solids.h>
#include <sightline/harness/laws/trace.h>
#include <sightline/harness/laws/weak.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace fuzz {

/// The checks of a subject but those of laws of images, of budgets, since time is the machine's, and of manners, for
/// which others ask in threads. Crowds are among them.
inline std::vector<harness::Check> own_checks(const harness::Subject& subject) {
  std::vector<harness::Check> own;
  for (const harness::Check& check : subject.checks) {
    const auto& laws = harness::laws();
    const bool is_law =
        std::any_of(laws.begin(), laws.end(), [&](const harness::Law& law) { return law.name == check.name; });
    if (!is_law && check.name != "budget" && check.name != "manners") own.push_back(check);
  }
  return own;
}

/// One of a subject's own checks, of a scene of a family, also one that asks a share of the scenes.
inline void ask_a_law(const harness::Subject& subject, std::string_view bytes) {
  constexpr std::size_t most_faces = 24;
  Bytes from(bytes);
  Random random(from.word());
  const Posed_scene scene = harness::make(any_case(random));
  if (scene.soup.face_count() > most_faces || (subject.wants_source && scene.source.empty())) return;
  const std::vector<harness::Check> checks = own_checks(subject);
  const harness::Check& check = checks[random.below(checks.size())];
  Random own(random.below(1u << 30));
  const harness::Outcome outcome = check.run(scene, subject.answer(scene), own);
  if (outcome.state == harness::Outcome::State::failed)
    throw Finding(subject.name + ", " + check.name + ": " + outcome.what);
}

inline void weak_laws(std::string_view bytes) {
  static const harness::Subject subject = harness::weak();
  ask_a_law(subject, bytes);
}

inline void level_laws(std::string_view bytes) {
  static const harness::Subject subject = harness::pvs();
  ask_a_law(subject, bytes);
}

inline void image_laws(std::string_view bytes) {
  static const harness::Subject subject = harness::render();
  ask_a_law(subject, bytes);
}

inline void solid_laws(std::string_view bytes) {
  static const harness::Subject subject = harness::boolean();
  ask_a_law(subject, bytes);
}

inline void view_laws(std::string_view bytes) {
  static const std::vector<harness::Subject> subjects{harness::see(), harness::shadow(), harness::trace()};
  ask_a_law(subjects[bytes.size() % subjects.size()], bytes);
}

}  // namespace fuzz
