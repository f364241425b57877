#include <sightline/harness/generate/random.h>

#include <locale>
#include <sstream>

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
  if (!(in >> engine)) throw std::invalid_argument("no state of a sequence of random numbers");
  engine_ = engine;
}

}  // namespace sightline::generate
