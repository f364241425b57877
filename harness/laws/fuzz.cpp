#include <sightline/harness/laws/fuzz.h>

#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/time_limit.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace sightline::harness {

std::string to_string(const Fuzz_case& c) {
  const auto& p = c.parameters;
  return c.family + ':' + std::to_string(p.seed) + ':' + std::to_string(p.size) + ':' + std::to_string(p.ulps) + ':' +
         sightline::to_string(p.offset[0]) + ',' + sightline::to_string(p.offset[1]) + ',' +
         sightline::to_string(p.offset[2]) + ':' + std::to_string(c.power);
}

Fuzz_case parse_case(std::string_view text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ':') parts.emplace_back();
    else parts.back() += c;
  }
  const auto fail = [&](const std::string& why) {
    throw std::invalid_argument("'" + std::string(text) + "' is no case: " + why +
                                "; it is FAMILY:SEED:SIZE:ULPS:X,Y,Z:POWER");
  };
  const auto number = [&](std::size_t k, auto& value) {
    if (k >= parts.size()) return;
    const std::string& part = parts[k];
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || end != part.data() + part.size()) fail("'" + part + "' is no whole number that fits");
  };
  if (parts.size() > 6) fail("more than six parts");
  Fuzz_case c;
  c.family = parts[0];
  generate::family(c.family);
  number(1, c.parameters.seed);
  number(2, c.parameters.size);
  number(3, c.parameters.ulps);
  number(5, c.power);
  if (parts.size() > 4) {
    std::array<std::string, 3> axes;
    std::size_t axis = 0;
    for (const char d : parts[4]) {
      if (d != ',') axes[std::min<std::size_t>(axis, 2)] += d;
      else ++axis;
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (axis != 2 || axes[k].empty() || c.parameters.offset[k].set_str(axes[k], 10) != 0 ||
          sgn(c.parameters.offset[k].get_den()) == 0)
        fail("'" + parts[4] + "' is no X,Y,Z of integers or fractions");
    for (Rational& x : c.parameters.offset) x.canonicalize();
  }
  if (c.power < -1100 || c.power > 1100) fail("the power is not between -1100 and 1100");
  c.parameters.scale = generate::power_of_two(c.power);
  return c;
}

Reduced reduce(const Subject& subject, const Posed_scene& scene, std::uint64_t seed, const Disagreement& found,
               const Reduce_options& options) {
  const bool throws = found.what.starts_with("throws:");
  const auto fails = [&](const Posed_scene& smaller) {
    if (subject.wants_source && smaller.source.size() < 3) return false;
    const std::optional<Disagreement> other = first_disagreement(subject, smaller, seed, found.check);
    return other && other->check == found.check &&
           (throws ? other->what == found.what : !other->what.starts_with("throws:"));
  };
  return reduce(scene, fails, options);
}

Fuzz_case draw_case(const generate::Family& family, Random& random) {
  Fuzz_case c;
  c.family = family.name;
  c.parameters.seed = random.below(std::uint64_t{1} << 32);
  c.parameters.size = family.small_size;
  const std::int64_t sign = random.chance(1, 2) ? 1 : -1;
  switch (random.below(8)) {
    case 0: c.parameters.ulps = sign; break;
    case 1: c.parameters.ulps = sign * random.between(2, 1000); break;
    case 2: c.parameters.ulps = sign * (std::int64_t{1} << random.between(10, 40)); break;
    case 3: c.parameters.ulps = sign * generate::far_ulps; break;
    default: break;
  }
  static constexpr std::array<std::int64_t, 4> offsets{1000, 1000000, 100000000, std::int64_t{1} << 52};
  if (random.chance(1, 5)) c.parameters.offset = generate::lattice(random, offsets[random.below(offsets.size())]);
  static constexpr std::array<int, 6> powers{-1000, -1060, 900, -30, 30, -50};
  if (random.chance(1, 5)) c.power = powers[random.below(powers.size())];
  c.parameters.scale = generate::power_of_two(c.power);
  return c;
}

std::optional<Finding> fuzz(const Subject& subject, const Fuzz_options& options, Fuzz_summary& summary) {
  std::vector<const generate::Family*> families;
  for (const generate::Family& f : generate::families())
    if (options.family.empty() || f.name == options.family) families.push_back(&f);
  if (families.empty()) generate::family(options.family);  // says which there are
  Fuzz_place place = options.from.value_or(Fuzz_place{Random(options.seed)});
  auto& [random, drawn] = place;
  std::size_t unfit = 0;  // in a row
  for (;;) {
    if (options.at) options.at(place);
    if ((options.scenes != 0 && drawn >= options.scenes) || has_run_out(options.out_of_time)) break;
    const generate::Family& family = *families[random.below(families.size())];
    const Fuzz_case which = draw_case(family, random);
    if (options.begin) options.begin(which);
    const Posed_scene scene = make(which);
    if (scene.soup.face_count() > options.most_faces || (subject.wants_source && scene.source.empty())) {
      if (++unfit > 10000)
        throw std::invalid_argument("no scene of '" + options.family + "' fits '" + subject.name +
                                    "': it has no source polygon, or more than " + std::to_string(options.most_faces) +
                                    " faces");
      continue;
    }
    unfit = 0;
    if (drawn++ % options.shards != options.shard) continue;
    ++summary.scenes;
    const auto tell = [&](const std::string& check, const Outcome& outcome) {
      for (Tally* tally : {&summary.by_check[check], &summary.by_family[family.name]}) {
        tally->passed += outcome.state == Outcome::State::passed;
        tally->undecided += outcome.state == Outcome::State::undecided;
        tally->not_applicable += outcome.state == Outcome::State::not_applicable;
      }
      summary.cases += outcome.state != Outcome::State::not_applicable;
      summary.undecided += outcome.state == Outcome::State::undecided;
    };
    if (auto found = first_disagreement(subject, scene, which.parameters.seed, options.check, tell))
      return Finding{which, *found, scene};
  }
  return std::nullopt;
}

}  // namespace sightline::harness
