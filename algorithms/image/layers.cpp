#include <sightline/algorithms/image/layers.h>

#include <sightline/algorithms/point_visibility/visible_region.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace sightline {

namespace image_detail {

namespace {

using Surface = Visible_surface<Exact_view>;

/// Cones of directions, and for each what one looks through to see them.
struct Looks {
  Cones<Exact_view> cones;
  std::vector<std::vector<std::uint32_t>> through;  // pieces
  std::vector<double> light;                        // the share that they let pass
};

/// visit(cone of the surface, part, its own cone) for all parts, by the tree of cuts.
template <class Visit>
void each_part(const Exact_view& view, const Surface& surface, Visit visit) {
  struct Step {
    Surface::Cone region;
    std::int32_t child;
  };
  Predicate_counts counts;
  std::vector<Step> steps;
  for (std::size_t k = 0; k < surface.cones.size(); ++k) {
    steps.push_back({surface.cones[k], surface.roots[k]});
    while (!steps.empty()) {
      Step step = std::move(steps.back());
      steps.pop_back();
      if (step.child < 0) {
        visit(k, static_cast<std::size_t>(~step.child), std::move(step.region));
        continue;
      }
      const Surface::Node& node = surface.nodes[static_cast<std::size_t>(step.child)];
      std::array<Surface::Cone, 2> parts = visible_detail::cut(view, step.region, node.plane, counts);
      steps.push_back({std::move(parts[0]), node.front});
      steps.push_back({std::move(parts[1]), node.behind});
    }
  }
}

}  // namespace

}  // namespace image_detail

void visible_layers(const Exact_view& view, const Piece_boxes& boxes, Cones<Exact_view> cones,
                    const std::vector<double>& alpha, const std::function<void(const Visible_layer&)>& visit,
                    const Visible_options& options) {
  using namespace image_detail;
  Looks looks;
  looks.through.resize(cones.size());
  looks.light.assign(cones.size(), 1);
  looks.cones = std::move(cones);
  while (!looks.cones.empty()) {
    // 1. What is first.
    Visible_layer layer{visible_surface(view, boxes, std::move(looks.cones), looks.through, options), {}};
    layer.light.resize(layer.surface.parts.size());
    // 2. Where it lets light through.
    Looks behind;
    each_part(view, layer.surface, [&](std::size_t cone, std::size_t part, Surface::Cone&& region) {
      layer.light[part] = looks.light[cone];
      const std::uint32_t piece = layer.surface.parts[part].piece;
      if (piece == Surface::nothing || alpha[piece] >= 1) return;
      behind.cones.push_back(std::move(region));
      behind.through.push_back(looks.through[cone]);
      behind.through.back().push_back(piece);
      behind.light.push_back(looks.light[cone] * (1 - alpha[piece]));
    });
    visit(layer);
    looks = std::move(behind);
  }
}

}  // namespace sightline
