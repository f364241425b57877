// Templates that are compiled once for the library's traits compile from the header for anybody else's.

#include <sightline/algorithms/bsp/build.h>

namespace {

/// The exact traits, but for a rough order of coordinates that says nothing.
class Own_traits : public sightline::Exact_traits {
 public:
  using Exact_traits::Exact_traits;
  double coordinate(const Vertex&, int) const { return 0; }
  Vertex meet(std::uint32_t piece, const sightline::Corner<Own_traits>& from, const sightline::Corner<Own_traits>& to,
              sightline::Sign side, const Cutter& cutter) const {
    return Exact_traits::meet(piece, {from.vertex, from.edge}, {to.vertex, to.edge}, side, cutter);
  }
};
static_assert(sightline::Partition_traits<Own_traits>);

}  // namespace

std::size_t nodes_by_own_traits(const sightline::Scene& scene) {
  return sightline::build_bsp(Own_traits(scene)).nodes.size();
}
