#include "sizes.h"

#include <algorithm>
#include <iostream>
#include <random>

namespace sightline::app {

namespace {

constexpr std::array<const char*, 5> size_keys{"below_1", "below_10", "below_100", "below_1000", "above"};

Pairs some_of(Pairs pairs, std::uint64_t seed) {
  constexpr std::size_t most = 200;
  std::mt19937_64 random(seed);
  std::shuffle(pairs.begin(), pairs.end(), random);
  pairs.resize(std::min(pairs.size(), most));
  return pairs;
}

}  // namespace

Json sample_json(Pairs hidden, Pairs visible, std::uint64_t seed) {
  return {{"wrongly_hidden", some_of(std::move(hidden), seed)}, {"wrongly_visible", some_of(std::move(visible), seed)}};
}

Json sizes_json(const Screen_sizes& sizes) {
  Json all{{"measured", sizes.measured()}};
  for (std::size_t k = 0; k < size_keys.size(); ++k) all[size_keys[k]] = sizes.counts[k];
  all["largest"] = sizes.largest;
  return all;
}

std::string cells_name(const Json& row) {
  std::string name = row["method"];
  if (row.contains("rays")) name += fmt::format(", {} a cell", row["rays"].get<std::size_t>());
  return name;
}

void print_sizes(const Json& rows) {
  const std::string line = "{:<22} {:<14} {:>17} {:>8} {:>9} {:>9} {:>9} {:>9} {:>11}\n";
  std::cout << fmt::format(fmt::runtime(line), "pixels of a pair", "", "measured", "below 1", "1 to 10", "10 to 100",
                           "to 1000", "above", "largest");
  for (const Json& r : rows) {
    if (!r.contains("sizes")) continue;
    for (const auto& [key, words] :
         {std::pair("wrongly_hidden", "wrongly hidden"), std::pair("wrongly_visible", "wrongly visible")}) {
      const Json& s = r["sizes"][key];
      if (r["errors"][key] == 0) continue;
      const auto count = [&](std::size_t k) { return s[size_keys[k]].get<std::size_t>(); };
      std::cout << fmt::format(
          fmt::runtime(line), cells_name(r), words,
          fmt::format("{} of {}", s["measured"].get<std::size_t>(), r["errors"][key].get<std::size_t>()), count(0),
          count(1), count(2), count(3), count(4), fmt::format("{:.3g}", s["largest"].get<double>()));
    }
  }
}

}  // namespace sightline::app
