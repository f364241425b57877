#include <sightline/algorithms/cutset/on_view.h>

namespace sightline {

bool operator==(const Viewpoint& a, const Viewpoint& b) {
  return a.at_infinity == b.at_infinity && std::equal(a.at.begin(), a.at.end(), b.at.begin());
}

}  // namespace sightline
