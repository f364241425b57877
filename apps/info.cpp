// sightline info: what is in a scene, what was set aside, which arithmetic it takes.

#include "support/common.h"

#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/closed.h>

#include <iostream>

namespace sightline::app {

static Exit run(const Common& common) {
  const Stopwatch watch;
  const Polygon_soup soup = common.read();
  const double reading = watch.seconds();
  const Scene scene(soup);
  const double preparing = watch.seconds() - reading;
  const Closure closing = closure(scene);
  const Scene_counters& c = scene.counters();
  const Bit_budget& budget = scene.planes().budget();

  std::size_t supporting = 0;
  std::vector<bool> seen(scene.planes().size());
  for (const Piece& piece : scene.pieces())
    if (!seen[piece.support.id()]) {
      seen[piece.support.id()] = true;
      ++supporting;
    }

  Json result{{"points_read", c.points_read},
              {"points", c.points},
              {"pieces", c.pieces},
              {"supporting_planes", supporting},
              {"planes", scene.planes().size()},
              {"lines", closing.lines},
              {"closed", closing.closed},
              {"scale_bits", scene.scale_bits()}};
  const auto faces = [](const std::vector<Face_id>& list) { return Json(list); };
  result["non_planar"] = faces(scene.non_planar());
  result["concave"] = faces(scene.concave());
  if (c.faces > 0) {
    const auto box = scene.box();
    result["box"] = {point_json(box[0]), point_json(box[1])};
  }
  Json counters = counters_json(c);
  counters["bits"] = {
      {"coordinate", budget.coordinate}, {"normal", budget.normal}, {"offset", budget.offset}, {"side", budget.side()}};
  if (write_json(common, "info", scene, result, counters, {{"read", reading}, {"prepare", preparing}}))
    return Exit::done;

  row("scene", scene.file());
  row("points", fmt::format("{} read, {} different", c.points_read, c.points));
  row("faces", fmt::format("{} read, {} kept, {} set aside", c.faces_read, c.faces, scene.set_aside().size()));
  row("pieces", fmt::format("{} convex pieces; {} faces are concave, {} not planar, {} with holes", c.pieces, c.concave,
                            c.non_planar, c.with_holes));
  row("planes", fmt::format("{} supporting planes; {} with those of edges; edges on {} lines", supporting,
                            scene.planes().size(), closing.lines));
  row("closed", closing.closed ? "yes: the faces bound a solid" : "no");
  if (c.faces > 0) {
    const auto box = scene.box();
    const auto text = [](const Exact_point& p) {
      return fmt::format("({:g}, {:g}, {:g})", nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2]));
    };
    row("box", text(box[0]) + " to " + text(box[1]));
  }
  row("coordinates",
      fmt::format("integers of {} bits at a scale of 2^{}; {} bits on the coarsest grid about the centre", scene.bits(),
                  scene.scale_bits(), budget.coordinate));
  row("arithmetic",
      fmt::format("{}: planes of {} and {} bits (normal, offset), so a side of a vertex takes at most {} bits",
                  name(scene.predicates().arithmetic()), budget.normal, budget.offset, budget.side()));
  row("seconds", fmt::format("{:.3f} to read, {:.3f} to prepare", reading, preparing));
  for (const Set_aside& entry : scene.set_aside())
    std::cout << fmt::format("set aside: face {}: {}\n", entry.face, entry.why);
  for (const Face_id f : scene.non_planar()) std::cout << fmt::format("not planar, triangulated: face {}\n", f);
  for (const Face_id f : scene.concave()) std::cout << fmt::format("concave, cut into convex pieces: face {}\n", f);
  return Exit::done;
}

void add_info(Command program) {
  const Command command =
      program.add_command("info", "What is in a scene, what was set aside and why, and the arithmetic that it takes");
  auto common = std::make_shared<Common>();
  common->add_to(command);
  command.set_action([common] { return run(*common); });
}

}  // namespace sightline::app
