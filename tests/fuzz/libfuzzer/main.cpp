// One target for libFuzzer, which the build names: SIGHTLINE_FUZZ_TARGET.

#include "../targets.h"

#include <cstdio>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    fuzz::SIGHTLINE_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  } catch (const std::exception& finding) {
    std::fprintf(stderr, "finding: %s\n", finding.what());
    std::abort();
  }
  return 0;
}

/// libFuzzer's own mutations of bytes, and ours of text, lines and JSON.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  if (seed % 2 == 0) return LLVMFuzzerMutate(data, size, most);
  fuzz::Mutator mutator(seed);
  std::string text(reinterpret_cast<const char*>(data), size);
  const bool json = seed % 8 != 1 && text.starts_with('{');
  const nlohmann::json value = json ? nlohmann::json::parse(text, nullptr, false) : nlohmann::json();
  text = value.is_object() ? mutator.damaged(value).dump() : mutator.damaged(std::move(text));
  if (text.size() > most) text.resize(most);
  std::copy(text.begin(), text.end(), data);
  return text.size();
}
