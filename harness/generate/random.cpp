#include <sightline/harness/generate/random.h>

#include <locale>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

namespace sightline::generate {

std::uint64_t Random::below(std::uint64_t n) {
  const std::uint64_t rejected = (0 - n) % n;  // 2^64 mod n: the numbers below it would favour small results
  std::uint64_t drawn = engine_();
  while (drawn < rejected) drawn = engine_();
  return drawn % n;
}

std::string Random::state() const {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << engine_;
  return std::move(text).str();
}

void Random::set_state(const std::string& text) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  std::mt19937_64 engine;
  // The last number is a place among the others, which the library does not look at.
  const std::string place = text.substr(text.find_last_of(' ') + 1);
  const bool has_place = !place.empty() && place.size() <= 3 &&
                         place.find_first_not_of("0123456789") == std::string::npos &&
                         std::stoul(place) <= std::mt19937_64::state_size;
  if (!has_place || !(in >> engine)) throw std::invalid_argument("no state of a sequence of random numbers");
  engine_ = engine;
}

}  // namespace sightline::generate
