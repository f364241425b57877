// The fuzz targets as a program: fuzz_targets TARGET [SECONDS [SEED]] runs the corpus and inputs near it, until
// something is wrong or the time is up. Exit code 0: nothing found; 1: a finding, whose input is written to
// finding.TARGET; 2: usage.

#include "../targets.h"

#include <chrono>
#include <iostream>

int main(int count, char** words) {
  using namespace fuzz;
  const std::string name = count > 1 ? words[1] : "";
  const auto target = std::find_if(targets().begin(), targets().end(), [&](const Target& t) { return t.name == name; });
  if (target == targets().end() || count > 4) {
    std::cerr << "usage: fuzz_targets TARGET [SECONDS [SEED]]; targets:";
    for (const Target& t : targets()) std::cerr << ' ' << t.name;
    std::cerr << '\n';
    return 2;
  }
  const double seconds = count > 2 ? std::atof(words[2]) : 10;
  const auto begin = std::chrono::steady_clock::now();
  const auto spent = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };

  const std::vector<Seed> seeds = seeds_of(*target);
  Mutator mutator(count > 3 ? std::strtoull(words[3], nullptr, 10) : 1);
  std::size_t inputs = 0;
  for (; inputs < seeds.size() || spent() < seconds; ++inputs) {
    const std::string input = inputs < seeds.size() ? seeds[inputs].bytes : input_near(seeds, mutator);
    try {
      target->run(input);
    } catch (const std::exception& finding) {
      std::ofstream("finding." + name, std::ios::binary) << input;
      std::cout << name << ": " << finding.what() << "; input " << inputs << " after " << spent()
                << " s, written to finding." << name << '\n';
      return 1;
    }
  }
  std::cout << name << ": nothing in " << inputs << " inputs, " << spent() << " s\n";
  if (!certificates_shown.empty()) print(std::cout, certificates_shown);
}
