#include <sightline/algorithms/weak_visibility/partition/partition.h>

#include <sightline/algorithms/weak_visibility/partition/merged_occluders.h>
#include <sightline/algorithms/weak_visibility/partition/partition_builder.h>
#include <sightline/kernel/scene/polygon_soup.h>

namespace sightline {

struct Light_partitioner::Merged {
  explicit Merged(const Scene& of) : scene(merged_pieces(of)), occluders(scene) {}
  Scene scene;
  Occluders occluders;
};

Light_partitioner::Light_partitioner(const Scene& scene) : scene_(&scene), merged_(std::make_unique<Merged>(scene)) {}
Light_partitioner::~Light_partitioner() = default;

Light_partition Light_partitioner::partition(std::uint32_t piece, const std::vector<std::vector<Exact_point>>& sources,
                                             const Partition_options& options, Partition_counters& counters) const {
  const Occluders& occluders = merged_->occluders;
  const auto located = [&](const std::vector<Exact_point>& points) { return weak_source(occluders, points); };
  const std::vector<Exact_point> corners = scene_->corner_points(scene_->pieces()[piece]);
  const Weak_source receiver = located(corners);
  std::vector<Weak_source> located_sources;
  for (const std::vector<Exact_point>& source : sources) located_sources.push_back(located(source));
  Light_partition result;
  result.piece = piece;
  const Plane_chart chart(occluders.frame(), receiver.polygon, receiver.plane);
  const auto position = [&](long x, long y) {
    return occluders.scene().position(chart.point(Rational(x), Rational(y)));
  };
  result.chart[0] = position(0, 0);
  for (std::size_t k = 0; k < 3; ++k) {
    result.chart[1][k] = position(1, 0)[k] - result.chart[0][k];
    result.chart[2][k] = position(0, 1)[k] - result.chart[0][k];
  }
  partition_detail::Partition_builder(occluders, receiver.polygon, receiver.plane, located_sources, options, counters)
      .run(result);
  return result;
}

}  // namespace sightline
