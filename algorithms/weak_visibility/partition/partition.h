#pragma once
// Where the light of a polygon changes on a face: lit, penumbra, umbra, and their borders.

#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/partition/border_curves.h>
#include <sightline/algorithms/weak_visibility/partition/light_partition.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/kernel/counters.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace sightline {

struct Partition_counters {
  Border_counters borders;
  std::size_t boxes = 0, alike = 0;           ///< rectangles of the face; of these, seen alike from everywhere
  std::size_t arrangements = 0, sectors = 0;  ///< the others, with curves between them; what these divide them into

  template <class Visit>
  static void each(Visit visit) {
    visit("borders", &Partition_counters::borders);
    visit("boxes", &Partition_counters::boxes);
    visit("alike", &Partition_counters::alike);
    visit("arrangements", &Partition_counters::arrangements);
    visit("sectors", &Partition_counters::sectors);
  }
};

struct Partition_options {
  bool all_borders = false;  ///< also where the edges that bound what is seen change
  std::function<bool()> out_of_time;
  std::function<void(double share)> progress;
};

/// The partition of the front of a piece by what it sees of sources. Cells of one light are
/// one where doubles tell that a stretch of their border is open; so a region may come as several cells where it is as
/// narrow as doubles are. Degenerate: what is behind a source's plane, or in it, sees nothing of it; a source that
/// is partly behind the piece's plane is never seen whole. Cost: candidates for borders as events; an arrangement of
/// those in each rectangle of a grid that is as fine as they are dense. Exact: yes; `undecided` where time ran out.
/// Ref: Plantinga; Demouth, Devillers, Everett, Glisse, Lazard, Seidel. Proof: P-86
class Light_partitioner {
 public:
  /// Of all pieces of the scene as occluders, which it merges.
  explicit Light_partitioner(Scene&&) = delete;
  explicit Light_partitioner(const Scene& scene);
  ~Light_partitioner();
  /// `sources`: convex polygons in the file's coordinates. Errors: std::invalid_argument, as weak_source().
  Light_partition partition(std::uint32_t piece, const std::vector<std::vector<Exact_point>>& sources,
                            const Partition_options& options, Partition_counters& counters) const;

 private:
  const Scene* scene_;
  struct Merged;
  std::unique_ptr<const Merged> merged_;
};

}  // namespace sightline
