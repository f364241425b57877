#pragma once
// What became of forged certificates, by kinds of forgery.

#include <cstddef>
#include <iomanip>
#include <map>
#include <ostream>
#include <string>

namespace fuzz {

/// What became of certificates; of those accepted, how many say what is true of the scene, to the same question.
struct Judged {
  std::size_t rejected = 0, accepted = 0, the_truth = 0;

  std::size_t shown() const { return rejected + accepted; }
  Judged& operator+=(const Judged& other) {
    rejected += other.rejected;
    accepted += other.accepted;
    the_truth += other.the_truth;
    return *this;
  }
};
/// By what was forged: "kind of certificate: kind of forgery".
using Tallies = std::map<std::string, Judged>;

inline void add(Tallies& to, const Tallies& tallies) {
  for (const auto& [name, judged] : tallies) to[name] += judged;
}
inline void print(std::ostream& out, const Tallies& tallies) {
  const auto row = [&](const auto& name, const auto& shown, const auto& rejected, const auto& accepted,
                       const auto& the_truth) {
    out << std::left << std::setw(48) << name << std::right;
    out << std::setw(12) << shown << std::setw(12) << rejected << std::setw(12) << accepted << std::setw(12)
        << the_truth << '\n';
  };
  Judged all;
  row("forged", "shown", "rejected", "accepted", "the truth");
  for (const auto& [name, judged] : tallies) {
    row(name, judged.shown(), judged.rejected, judged.accepted, judged.the_truth);
    all += judged;
  }
  row("all", all.shown(), all.rejected, all.accepted, all.the_truth);
}

}  // namespace fuzz
