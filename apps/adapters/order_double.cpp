// An adapter for `sightline judge`: back-to-front orders from a BSP tree whose arithmetic is plain doubles.

#include "adapter.h"

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/kernel/traits/point_traits.h>
#include <sightline/io/decimal.h>

#include <CGAL/Simple_cartesian.h>

namespace {

/// Faces that the tree does not cut are given as a whole, all others in fragments.
void solve(const adapter::Task& task) {
  using namespace sightline;
  using Traits = Point_traits<CGAL::Simple_cartesian<double>>;
  const Traits traits(task.scene);
  Bsp_options options;
  options.threads = 1;
  const Bsp_tree<Traits> tree = build_bsp(traits, options);
  std::vector<std::size_t> fragments(task.scene.counters().faces_read);
  for (const Fragment<Traits>& fragment : tree.fragments) ++fragments[task.scene.pieces()[fragment.polygon.piece].face];

  judge::Json order = judge::Json::array();
  traverse(traits, tree, traits.eye(task.query.eye), Direction::back_to_front,
           [&](const Fragment<Traits>& fragment, Sign) {
             const Face_id face = task.scene.pieces()[fragment.polygon.piece].face;
             if (fragments[face] == 1) {
               order.push_back(face);
               return;
             }
             judge::Json vertices = judge::Json::array();
             try {
               for (const Corner<Traits>& corner : fragment.polygon) {
                 const Exact_point p = traits.position(*corner.vertex);
                 vertices.push_back({nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])});
               }
             } catch (const std::domain_error&) {  // a corner that is no number: the fragment is lost
               return;
             }
             order.push_back({{"face", face}, {"vertices", std::move(vertices)}});
           });
  adapter::write_answer(task, {{"order", std::move(order)}});
}

}  // namespace

int main(int argc, char** argv) { return adapter::main(argc, argv, sightline::judge::Question::order, solve); }
