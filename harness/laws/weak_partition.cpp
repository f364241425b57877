#include <sightline/harness/laws/weak_partition.h>

#include <sightline/algorithms/weak_visibility/events/homogeneous.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/partition/partition.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <cstddef>

namespace sightline::harness {

namespace {

/// What segments from a point of a cell to the source contradict: one that is free, umbra; one that is not, or does not
/// begin in front of both, lit. Segments at random, so that none only touches something.
bool is_contradicted(const Occluders& occluders, const Weak_source& source, std::uint32_t piece,
                     const Light_partition& partition, const Light_partition::Cell& cell, Random& random) {
  constexpr int segments = 6;
  const Near_plane& plane = occluders.plane(piece);
  Exact_point at = partition.chart[0];
  for (std::size_t k = 0; k < 3; ++k) at[k] += cell.at[0] * partition.chart[1][k] + cell.at[1] * partition.chart[2][k];
  const Located_point located = occluders.scene().locate(at);
  const Near_point p = near_point(occluders.frame(), {located.x, located.y, located.z, located.w});
  for (int k = 0; k < segments; ++k) {
    Homogeneous sum{0, 0, 0, 0};
    for (const Near_point& corner : source.polygon) {
      const unsigned long weight = 1 + random.below(1u << 20);
      for (std::size_t i = 0; i < 4; ++i) sum[i] += weight * corner.exact[i];
    }
    const Near_point q = near_point(occluders.frame(), sum);
    const bool is_free = sgn(dot(source.plane.exact, p.exact)) > 0 && sgn(dot(plane.exact, q.exact)) > 0 &&
                         !occluders.blocker(p, q, plane, source.plane);
    if (cell.light == (is_free ? Light::umbra : Light::lit)) return true;
  }
  return false;
}

}  // namespace

Check partition_check() {
  return {"partition",
          "a face is hidden iff all of it is in umbra, and segments from its cells to the source are free or not as "
          "their light says",
          [](const Posed_scene& posed, const Answer& answer, Random& random) {
            constexpr std::size_t most_pieces = 10;
            const Scene scene(posed.soup);
            constexpr int most_bits = 100;  // an arrangement's roots have some fifty times as many
            if (scene.pieces().empty() || scene.pieces().size() > most_pieces || scene.bits() > most_bits)
              return Outcome::not_applicable();
            const Face_id face = scene.pieces()[random.below(scene.pieces().size())].face;
            if (answer.labels[face] == Answer::none) return Outcome::not_applicable();
            const Occluders occluders(scene);
            const Weak_source source = weak_source(occluders, posed.source);
            const Light_partitioner partitioner(scene);
            std::size_t asked = 0;
            Partition_options options;
            constexpr std::size_t most_rectangles = 2000;
            options.out_of_time = [&] { return ++asked > most_rectangles; };
            bool some_light = false, open = false;
            for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
              if (scene.pieces()[piece].face != face) continue;
              Partition_counters counters;
              const Light_partition partition = partitioner.partition(piece, {posed.source}, options, counters);
              constexpr std::size_t most_cells = 30;
              for (const auto& cell : partition.cells) {
                if (random.chance(most_cells, std::max(most_cells, partition.cells.size())) &&
                    is_contradicted(occluders, source, piece, partition, cell, random))
                  return Outcome::failed("a cell of " + face_name(face) + " is " + name_of(cell.light) +
                                         ", but a segment from there to the source says otherwise");
                some_light |= cell.light == Light::lit || cell.light == Light::penumbra;
                open |= cell.light == Light::undecided;
              }
            }
            if (some_light ? answer.labels[face] == 1 : !open && answer.labels[face] == 0) return Outcome{};
            if (!some_light && open) return Outcome::undecided();
            return Outcome::failed(face_name(face) + (some_light ? " has light in its partition, but is hidden"
                                                                 : " is all in umbra, but visible"));
          }};
}

}  // namespace sightline::harness
