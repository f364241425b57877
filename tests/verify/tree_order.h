#pragma once
// Orders as BSP trees give them, for tests of their checks.

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/covering_of_scene.h>
#include <sightline/algorithms/bsp/order_cuts.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/exact_traits.h>

namespace verify_test {

using namespace sightline;

/// The order that a tree gives, with its cuts.
inline Order_certificate certificate_of_tree(const sightline::Scene& scene, const Exact_point& eye) {
  const Exact_traits traits(scene);
  Bsp_options options;
  options.threads = 1;
  const Bsp_tree<Exact_traits> tree = build_bsp(traits, options);
  Order_certificate certificate;
  certificate.eye = eye;
  add_pieces(certificate, scene);
  traverse_with_cuts(traits, tree, traits.eye(eye), &scene, certificate.cuts,
                     [&](const Fragment<Exact_traits>& drawn, Sign) {
                       const Piece& piece = scene.pieces()[drawn.polygon.piece];
                       Order_fragment& fragment = certificate.fragments.emplace_back();
                       fragment.face = piece.face;
                       fragment.piece = piece.number;
                       for (const auto& corner : drawn.polygon)
                         fragment.vertices.push_back(traits.position(*corner.vertex));
                     });
  return certificate;
}

}  // namespace verify_test
