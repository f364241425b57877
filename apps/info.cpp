// sightline info: what is in a scene, what was set aside, which arithmetic it takes.

#include "support/common.h"

#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/uniform.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <random>

namespace sightline::app {

namespace {

/// Where fronts look, as shares of the faces' area: out of what the faces enclose, or into it. A side of a face
/// is enclosed at a point if no ray from there gets away. Of the rest both sides are enclosed, or neither.
struct Fronts {
  std::size_t points = 0, outwards = 0, inwards = 0;
  static constexpr std::size_t rays = 24;  // from each side of a point
  double share(std::size_t count) const { return static_cast<double>(count) / static_cast<double>(points); }
  /// Whether one side alone is enclosed at three points of five, and nearly always this one.
  bool nearly_all(std::size_t count) const {
    return 5 * (outwards + inwards) >= 3 * points && 20 * count >= 19 * (outwards + inwards);
  }
};

/// By points spread evenly over the faces, and rays of which more go upright. In doubles: a sample, nothing is proved.
/// `in_time` is called before each point.
Fronts fronts_of(const Scene& scene, std::uint64_t seed, const Report& in_time) {
  const Occluders occluders(scene);
  const auto length = [](const Triple& a) { return std::sqrt(dot(a, a)); };
  // 1. Triangles of all pieces, by area.
  struct Triangle {
    std::uint32_t piece;
    std::size_t corner;
    double end;  // of its share of all area
  };
  std::vector<Triangle> triangles;
  double area = 0;
  for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
    const auto corners = occluders.corners(piece);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      area += length(cross(minus(corners[i], corners[0]), minus(corners[i + 1], corners[0])));
      triangles.push_back({piece, i, area});
    }
  }
  Fronts fronts;
  if (!(area > 0) || !std::isfinite(area)) return fronts;

  std::mt19937_64 dice(seed);
  const Uniform unit(0, 1);
  fronts.points = 1000;
  for (std::size_t k = 0; k < fronts.points; ++k) {
    in_time(k, fronts.points);
    // 2. A point, and a frame on its face.
    const double at = unit(dice) * area;
    const auto found = std::lower_bound(triangles.begin(), triangles.end() - 1, at,
                                        [](const Triangle& triangle, double x) { return triangle.end < x; });
    const auto corners = occluders.corners(found->piece);
    const Triple& origin = corners[0];
    const Triple a = minus(corners[found->corner], origin), b = minus(corners[found->corner + 1], origin);
    double s = unit(dice), t = unit(dice);
    if (s + t > 1) {
      s = 1 - s;
      t = 1 - t;
    }
    const auto& h = occluders.plane(found->piece).near;
    Triple p, n, u = a;
    for (std::size_t c = 0; c < 3; ++c) {
      p[c] = origin[c] + s * a[c] + t * b[c];
      n[c] = h[c] / length({h[0], h[1], h[2]});
      u[c] /= length(a);
    }
    const Triple v = cross(n, u);
    // 3. Whether a ray gets away, from its front and from its back.
    std::array<bool, 2> open{};
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t ray = 0; ray < Fronts::rays && !open[side]; ++ray) {
        const double square = unit(dice), angle = 6.283185307179586 * unit(dice), flat = std::sqrt(square),
                     up = (side == 0 ? 1 : -1) * std::sqrt(1 - square);
        Triple direction;
        for (std::size_t c = 0; c < 3; ++c)
          direction[c] = flat * std::cos(angle) * u[c] + flat * std::sin(angle) * v[c] + up * n[c];
        open[side] = !occluders.first_hit(p, direction);
      }
    fronts.outwards += open[0] && !open[1];
    fronts.inwards += !open[0] && open[1];
  }
  return fronts;
}

std::string text_of(const Fronts& fronts) {
  std::string text =
      fmt::format("{:.0f}% of the area looks out of what the faces enclose, {:.0f}% into it (a sample of {} points)",
                  100 * fronts.share(fronts.outwards), 100 * fronts.share(fronts.inwards), fronts.points);
  if (fronts.nearly_all(fronts.outwards))
    text +=
        ": right where one looks from outside, as at solids; rooms to look at from within are turned away, and --flip "
        "turns them";
  if (fronts.nearly_all(fronts.inwards))
    text +=
        ": right where one looks from within, as in rooms; solids to look at from outside are turned away, and --flip "
        "turns them";
  return text;
}

}  // namespace

static Exit run(const Common& common) {
  const Stopwatch watch;
  const Polygon_soup soup = common.read();
  const double reading = watch.seconds();
  const Report in_time = common.within_budget();
  const Scene scene = scene_of(soup);
  const double preparing = watch.seconds() - reading;
  in_time(0, 1);
  const Closure closing = closure(scene);
  in_time(0, 1);
  const Scene_counters& c = scene.counters();
  const double closed_after = watch.seconds();
  Progress progress("looking at fronts");
  const Fronts fronts = fronts_of(scene, common.seed, [&](std::size_t done, std::size_t all) {
    in_time(done, all);
    progress(done, all);
  });
  const double sampling = watch.seconds() - closed_after;
  progress.clear();
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
  if (fronts.points > 0)
    result["fronts"] = {{"points", fronts.points},
                        {"outwards", fronts.share(fronts.outwards)},
                        {"inwards", fronts.share(fronts.inwards)}};
  if (c.faces > 0) {
    const auto box = scene.box();
    result["box"] = {point_json(box[0]), point_json(box[1])};
  }
  Json counters = counters_json(c);
  counters["bits"] = {
      {"coordinate", budget.coordinate}, {"normal", budget.normal}, {"offset", budget.offset}, {"side", budget.side()}};
  if (write_json(common, "info", scene, result, counters,
                 {{"read", reading}, {"prepare", preparing}, {"fronts", sampling}}))
    return Exit::done;

  row("scene", scene.file());
  row("points", fmt::format("{} read, {} different", c.points_read, c.points));
  row("faces", fmt::format("{} read, {} kept, {} set aside", c.faces_read, c.faces, scene.set_aside().size()));
  row("pieces", fmt::format("{} convex pieces; {} faces are concave, {} not planar, {} with holes", c.pieces, c.concave,
                            c.non_planar, c.with_holes));
  row("planes", fmt::format("{} supporting planes; {} with those of edges; edges on {} lines", supporting,
                            scene.planes().size(), closing.lines));
  row("closed", !closing.closed ? "no"
                : c.faces > 0   ? "yes: the faces close up, as those of solids do"
                                : "yes: there are no faces");
  if (fronts.points > 0) row("fronts", text_of(fronts));
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
  row("seconds", fmt::format("{:.3f} to read, {:.3f} to prepare, {:.3f} for the fronts", reading, preparing, sampling));
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
