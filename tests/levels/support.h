#pragma once
// What tests of levels share: scenes of the corpus, and laws asked of them.

#include "../sample.h"

#include <sightline/harness/laws/fuzz.h>
#include <sightline/harness/laws/levels.h>
#include <sightline/io/read.h>

#include <gtest/gtest.h>

namespace levels_test {

inline sightline::Polygon_soup corpus_scene(const std::string& file) {
  return sightline::read_scene(std::filesystem::path(SIGHTLINE_SOURCE_DIR "/tests/corpus/" + file));
}

/// That the law of this name holds of a scene.
inline void expect_passed(const std::string& check, const sightline::Polygon_soup& soup, std::uint64_t seed) {
  sightline::harness::Posed_scene posed;
  posed.soup = soup;
  const sightline::harness::Subject subject = sightline::harness::pvs();
  const auto found = sightline::harness::first_disagreement(subject, posed, seed, check);
  EXPECT_FALSE(found) << found->check << ": " << found->what;
}

}  // namespace levels_test
