// Every target on every file of the corpus that it begins with, and on inputs near those.
// SIGHTLINE_LONG: so many times the inputs, for a long run. (Longer ones: README.md in this folder.)

#include "../sample.h"
#include "targets.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string_view>

namespace {

using fuzz::Target;

const std::size_t share = test_scenes::is_sanitized() ? 16 : test_scenes::is_long() ? 1 : 3;  // one in so many inputs

std::size_t times() {
  const char* const more = std::getenv("SIGHTLINE_LONG");
  return more == nullptr ? 1 : std::max(1ul, std::strtoul(more, nullptr, 10));
}

/// In C's way, so that a finding can be run again.
std::string escaped(std::string_view bytes) {
  std::string text;
  for (const char c : bytes.substr(0, 4000)) {
    char code[8];
    std::snprintf(code, sizeof code, c >= 32 && c < 127 && c != '"' && c != '\\' ? "%c" : "\\%03o",
                  static_cast<unsigned char>(c));
    text += code;
  }
  return text;
}

/// Whether the target has nothing to say against the bytes.
testing::AssertionResult survives(const Target& target, std::string_view bytes) {
  try {
    target.run(bytes);
  } catch (const std::exception& finding) {
    return testing::AssertionFailure() << target.name << ": " << finding.what() << "\n\"" << escaped(bytes) << '"';
  }
  return testing::AssertionSuccess();
}

class Fuzz : public testing::TestWithParam<Target> {};

TEST_P(Fuzz, the_corpus) {
  for (const fuzz::Seed& seed : seeds_of(GetParam())) EXPECT_TRUE(survives(GetParam(), seed.bytes)) << seed.file;
  EXPECT_TRUE(survives(GetParam(), ""));
}

TEST_P(Fuzz, inputs_near_the_corpus) {
  const std::vector<fuzz::Seed> seeds = seeds_of(GetParam());
  fuzz::Mutator mutator(7);
  static const std::map<std::string_view, std::size_t> of_long_ones{
      // each of their inputs is many questions
      {"forged", 100},     {"pairs", 15},         {"faces", 80},        {"weak_claims", 50},   {"decisions", 500},
      {"scene_laws", 160}, {"arcs", 120},         {"separations", 120}, {"planar_parts", 250}, {"pictures", 300},
      {"drawings", 1000},  {"only_nonsense", 60}, {"weak_laws", 40},    {"level_laws", 20},    {"image_laws", 60},
      {"solid_laws", 30},  {"view_laws", 60},     {"one_edge", 600},    {"eye_numbers", 300}};
  const auto found = of_long_ones.find(GetParam().name);
  const std::size_t inputs = found == of_long_ones.end() ? 1500 : found->second;
  for (std::size_t k = 0; k < std::max<std::size_t>(1, inputs * times() / share); ++k)
    ASSERT_TRUE(survives(GetParam(), input_near(seeds, mutator))) << "input " << k;
}

TEST(Fuzz_certificates, of_the_corpus_are_accepted_but_for_those_that_are_wrong) {
  std::size_t accepted = 0, rejected = 0;
  for (const fuzz::Seed& seed : fuzz::seeds_of({"certificate", fuzz::certificate, {"certificates/"}})) {
    const std::optional<sightline::Verdict> verdict = fuzz::checked_certificate(seed.bytes);
    ASSERT_TRUE(verdict) << seed.file;
    const bool wrong = seed.file.find("/wrong_") != std::string::npos;
    EXPECT_EQ(verdict->accepted, !wrong) << seed.file << ": " << verdict->why;
    ++(wrong ? rejected : accepted);
    if (wrong) RecordProperty(std::filesystem::path(seed.file).stem().string(), verdict->why);
  }
  EXPECT_GE(accepted, 10u);
  EXPECT_GE(rejected, 16u);
}

TEST(Fuzz_certificates, with_broken_tables_are_refused_in_one_line) {
  std::size_t refused = 0;
  for (const fuzz::Seed& seed : fuzz::seeds_of({"read_certificate", fuzz::read_certificate, {"forms/"}})) {
    const bool broken = seed.file.find("/broken_") != std::string::npos,
               whole = seed.file.find("_table.json") != std::string::npos && !broken;
    if (!broken && !whole) continue;
    EXPECT_EQ(fuzz::certificate_in(seed.bytes).has_value(), whole) << seed.file;
    refused += broken;
  }
  EXPECT_GE(refused, 10u);
}

TEST(Fuzz_forged, certificates_are_accepted_and_rejected_alike) {
  fuzz::Mutator mutator(3);
  fuzz::Judged all;
  for (std::size_t k = 0; k < 100 / share; ++k)
    for (const auto& [name, judged] : fuzz::judged_forgeries(mutator.random_bytes(40))) all += judged;
  EXPECT_GT(all.accepted, 100 / share);
  EXPECT_GT(all.the_truth, 50 / share);
  EXPECT_GT(all.rejected, 400 / share);
}

INSTANTIATE_TEST_SUITE_P(, Fuzz, testing::ValuesIn(fuzz::targets()),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
