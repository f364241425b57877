#pragma once
// Questions of weak visibility from a seed: drafts, turned and projected so that nothing about them is axis-parallel.

#include <sightline/harness/generate/projective.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/weak_draft.h>
#include <sightline/kernel/number.h>

#include <array>

namespace sightline::generate::weak_drafts {

struct Drafter {
  const char* name;
  const char* what;
  Draft (*draft)(Random& random, const Rational& gap);
};
extern const std::array<Drafter, 18> drafters;

/// Faces and roles in random order, turned at random where that changes nothing, the whole in one of several positions.
Weak_scene finished(Draft draft, Random& random);

}  // namespace sightline::generate::weak_drafts
