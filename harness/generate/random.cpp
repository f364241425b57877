#include <sightline/harness/generate/random.h>

namespace sightline::generate {

std::uint64_t Random::below(std::uint64_t n) {
  const std::uint64_t rejected = (0 - n) % n;  // 2^64 mod n: the numbers below it would favour small results
  std::uint64_t drawn = engine_();
  while (drawn < rejected) drawn = engine_();
  return drawn % n;
}

}  // namespace sightline::generate
