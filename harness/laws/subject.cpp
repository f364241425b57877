#include <sightline/harness/laws/subject.h>

#include <map>

namespace sightline::harness {

std::vector<std::uint32_t> first_of_its_kind(const std::vector<std::uint32_t>& labels) {
  std::map<std::uint32_t, std::uint32_t> first;
  std::vector<std::uint32_t> names;
  for (std::size_t k = 0; k < labels.size(); ++k)
    names.push_back(labels[k] == Answer::none
                        ? Answer::none
                        : first.try_emplace(labels[k], static_cast<std::uint32_t>(k)).first->second);
  return names;
}

Outcome compared(const Answer& a, const Answer& b, const std::string& one, const std::string& other) {
  if (a.labels.size() != b.labels.size())
    return Outcome::failed(other + " answers about " + std::to_string(b.labels.size()) + " faces, not " +
                           std::to_string(a.labels.size()));
  std::vector<std::uint32_t> mine = a.labels, theirs = b.labels;
  bool open = false;
  for (std::size_t k = 0; k < mine.size(); ++k)
    if (mine[k] == Answer::none || theirs[k] == Answer::none) {
      mine[k] = theirs[k] = Answer::none;
      open = true;
    }
  if (a.is_partition) {
    mine = first_of_its_kind(mine);
    theirs = first_of_its_kind(theirs);
  }
  for (std::size_t k = 0; k < mine.size(); ++k)
    if (mine[k] != theirs[k])
      return Outcome::failed(face_name(k) + ": " + one + " says " + std::to_string(mine[k]) + ", " + other + ' ' +
                             std::to_string(theirs[k]));
  if (open && a.undecided + b.undecided > 0) return Outcome::undecided();
  return {};
}

}  // namespace sightline::harness
