// An adapter for `sightline judge`: what rays meet first by Embree, in floats, in its robust mode. A fourth argument is
// the least t at which a face counts, 1e-4 by default: what tracers call their epsilon. Rays whose numbers Embree does
// not take are left open.

#include "embree.h"

#include <cmath>

namespace {

using namespace sightline;

bool takes(const adapter::Vector& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::fabs(x) < 1.8e18; });
}

void solve(const adapter::Task& task) {
  const float least_t = task.more.empty() ? 1e-4f : std::stof(task.more[0]);
  const adapter::Traced_scene scene(task.scene);
  judge::Json first = judge::Json::array();
  for (const Exact_ray& ray : task.query.rays) {
    const adapter::Vector from = adapter::near(ray.origin), direction = adapter::near(ray.direction);
    if (!takes(from) || !takes(direction)) {
      first.push_back("abstained");
      continue;
    }
    const auto face = scene.hit(from, direction, true, least_t);
    first.push_back(face ? judge::Json(*face) : judge::Json());
  }
  adapter::write_answer(task, {{"first", std::move(first)}});
}

}  // namespace

int main(int argc, char** argv) { return adapter::main(argc, argv, sightline::judge::Question::trace, solve); }
