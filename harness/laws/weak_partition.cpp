#include <sightline/harness/laws/weak_partition.h>

#include <sightline/algorithms/weak_visibility/partition/partition.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <cstddef>

namespace sightline::harness {

Check partition_check() {
  return {"partition", "a face is hidden iff all of it is in umbra",
          [](const Posed_scene& posed, const Answer& answer, Random& random) {
            constexpr std::size_t most_pieces = 10;
            const Scene scene(posed.soup);
            if (scene.pieces().empty() || scene.pieces().size() > most_pieces) return Outcome::not_applicable();
            const Face_id face = scene.pieces()[random.below(scene.pieces().size())].face;
            if (answer.labels[face] == Answer::none) return Outcome::not_applicable();
            const Light_partitioner partitioner(scene);
            std::size_t asked = 0;
            Partition_options options;
            constexpr std::size_t most_rectangles = 2000;
            options.out_of_time = [&] { return ++asked > most_rectangles; };
            bool some_light = false, open = false;
            for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
              if (scene.pieces()[piece].face != face) continue;
              Partition_counters counters;
              for (const auto& cell : partitioner.partition(piece, {posed.source}, options, counters).cells) {
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
