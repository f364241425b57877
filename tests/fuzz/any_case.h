#pragma once
// A case of any family, as `sightline fuzz` draws them.

#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/fuzz.h>

#include <vector>

namespace fuzz {

using namespace sightline;

inline harness::Fuzz_case any_case(generate::Random& random) {
  const std::vector<generate::Family>& families = generate::families();
  return harness::draw_case(families[random.below(families.size())], random);
}

}  // namespace fuzz
