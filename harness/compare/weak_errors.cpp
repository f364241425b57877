#include <sightline/harness/compare/weak_errors.h>

#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace sightline {

Weak_errors weak_errors(const Weak_faces& exact, const Weak_faces& said) {
  const auto common = [](const std::vector<Face_id>& a, const std::vector<Face_id>& b) {
    std::vector<Face_id> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return both.size();
  };
  return {common(exact.hidden, said.visible), common(exact.visible, said.hidden),
          common(exact.visible, said.undecided) + common(exact.hidden, said.undecided), exact.undecided.size()};
}

}  // namespace sightline
