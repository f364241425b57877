#include <sightline/algorithms/priority/certificate.h>

#include <sightline/algorithms/covering_of_scene.h>
#include <sightline/kernel/sign.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline {

Graph_certificate graph_certificate(const Scene& scene, const Priority_relation<Exact_traits>& faces,
                                    const Priority_components& components, const Component_trees& trees) {
  Graph_certificate certificate;
  std::vector<std::size_t> place(faces.size());
  for (std::size_t c = 0; c < components.size(); ++c) {
    certificate.sizes.push_back(components[c].size());
    for (const std::uint32_t i : components[c]) {
      place[i] = certificate.fragments.size();
      certificate.fragments.push_back(whole_piece(scene, scene.pieces()[i]));
    }
  }
  Predicate_counts counts;
  const auto add = [&](std::uint32_t from, std::uint32_t to) {
    if (from != to)
      certificate.arcs.push_back({place[from], place[to], faces.find_corner(from, CGAL::POSITIVE, to, counts),
                                  faces.find_corner(to, CGAL::NEGATIVE, from, counts)});
  };
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    add(trees.from[i], i);
    add(i, trees.to[i]);
  }
  add_pieces(certificate, scene);
  return certificate;
}

}  // namespace sightline
