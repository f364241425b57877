// sightline trace: what rays meet first, or at all, exactly.

#include "methods/rays.h"
#include "support/common.h"
#include "support/paths.h"

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/rays/by_tree.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <iostream>

namespace sightline::app {

namespace {

struct Trace_arguments {
  Common common;
  std::string rays, method = "boxes";
  bool all = false, closed = false;
};

/// What each ray meets, and what that took.
struct Traced {
  std::vector<std::vector<Face_hit>> hits;
  Json counters = Json::object();
  double prepare_seconds = 0, seconds = 0;
};

/// find(ray, number) for all rays, in parallel blocks.
template <class Find>
void trace_all(const std::vector<Exact_ray>& rays, const Common& common, Traced& traced, Find find) {
  Progress progress("tracing");
  const auto report = common.within_budget(progress);
  const Stopwatch watch;
  traced.hits.resize(rays.size());
  constexpr std::size_t block = 64;
  std::atomic<std::size_t> done{0};
  run_with_threads(common.threads, [&] {
    parallel_for((rays.size() + block - 1) / block, [&](std::size_t b) {
      const std::size_t end = std::min(rays.size(), (b + 1) * block);
      for (std::size_t i = b * block; i < end; ++i) traced.hits[i] = find(rays[i]);
      report(done += end - b * block, rays.size());
    });
  });
  traced.seconds = watch.seconds();
}

Traced by_boxes(const Scene& scene, const std::vector<Exact_ray>& rays, const Trace_arguments& arguments,
                Ray_start start) {
  Traced traced;
  const Stopwatch watch;
  std::optional<Ray_tracer> tracer;
  run_with_threads(arguments.common.threads, [&] { tracer.emplace(scene); });
  traced.prepare_seconds = watch.seconds();
  Per_thread<Ray_counters> counters;
  trace_all(rays, arguments.common, traced, [&](const Exact_ray& ray) {
    return arguments.all ? tracer->all(ray, start, counters.local()) : tracer->first(ray, start, counters.local());
  });
  Ray_counters sum;
  counters.for_each([&](Ray_counters& c) { sum += c; });
  traced.counters = counters_json(sum);
  return traced;
}

Traced by_tree(const Scene& scene, const std::vector<Exact_ray>& rays, const Trace_arguments& arguments,
               Ray_start start) {
  Traced traced;
  const Stopwatch watch;
  const Exact_traits traits(scene);
  Bsp_options options;
  options.threads = arguments.common.threads;
  options.seed = arguments.common.seed;
  const Exact_tree tree = build_bsp(traits, options);
  traced.prepare_seconds = watch.seconds();
  trace_all(rays, arguments.common, traced, [&](const Exact_ray& ray) {
    return arguments.all ? all_hits(traits, tree, ray, start) : first_hits(traits, tree, ray, start);
  });
  traced.counters = {{"nodes", tree.counters.nodes}, {"fragments", tree.counters.fragments}};
  return traced;
}

Traced by_embree(const Scene& scene, const std::vector<Exact_ray>& rays, const Trace_arguments& arguments) {
  Traced traced;
  const Stopwatch watch;
  const Traced_scene floats(scene, arguments.common.threads);
  traced.prepare_seconds = watch.seconds();
  trace_all(rays, arguments.common, traced, [&](const Exact_ray& ray) {
    const Traced_hit hit = floats.first(in_doubles(ray));
    std::vector<Face_hit> hits;
    if (hit.piece != Piece_image::nothing && std::isfinite(hit.t))
      hits.push_back(
          {scene.pieces()[hit.piece].face, hit.back ? Met_side::back : Met_side::front, exact(hit.t), exact(hit.t)});
    return hits;
  });
  return traced;
}

const char* name_of(Met_side side) {
  return side == Met_side::front ? "front" : side == Met_side::back ? "back" : "along";
}

Json hit_json(const Exact_ray& ray, const Face_hit& hit) {
  Json json{{"face", hit.face}, {"side", name_of(hit.side)}, {"t", to_string(hit.t)}};
  if (hit.until != hit.t) json["until"] = to_string(hit.until);
  json["point"] = point_json(point_at(ray, hit.t));
  return json;
}
/// The first hit, with all faces that are met there.
Json first_json(const Exact_ray& ray, const std::vector<Face_hit>& hits) {
  if (hits.empty()) return nullptr;
  Json json = hit_json(ray, hits.front());
  for (const Face_hit& hit : hits) json["faces"].push_back(hit.face);
  return json;
}

std::string about(const Rational& value) {
  return value.get_den() == 1 && bit_length(value.get_num()) < 50 ? to_string(value) : digits_of(value, 9);
}

/// The first rays, a line for each hit.
void print_hits(const std::vector<Exact_ray>& rays, const Traced& traced, bool all) {
  constexpr std::size_t most = 20;
  std::cout << fmt::format("{:>8} {:>8} {:<6} {:>16}  {}\n", "ray", "face", "side", "t", "point");
  for (std::size_t i = 0; i < std::min(rays.size(), most); ++i) {
    const std::vector<Face_hit>& hits = traced.hits[i];
    if (hits.empty()) std::cout << fmt::format("{:>8} {:>8}\n", i, "none");
    for (std::size_t k = 0; k < (all ? hits.size() : std::min<std::size_t>(hits.size(), 1)); ++k) {
      const Face_hit& hit = hits[k];
      const Exact_point p = point_at(rays[i], hit.t);
      std::string more = hit.until == hit.t ? "" : fmt::format(", until {}", about(hit.until));
      for (std::size_t j = 1; !all && j < hits.size(); ++j)
        more += fmt::format("{}{}", j == 1 ? ", and faces " : ", ", hits[j].face);
      std::cout << fmt::format("{:>8} {:>8} {:<6} {:>16}  ({}, {}, {}){}\n", i, hit.face, name_of(hit.side),
                               about(hit.t), about(p[0]), about(p[1]), about(p[2]), more);
    }
  }
  if (rays.size() > most)
    std::cout << fmt::format("{:>8} and {} more rays; --json FILE writes all, exactly\n", "...", rays.size() - most);
}

}  // namespace

static Exit run(const Trace_arguments& arguments) {
  const Common& common = arguments.common;
  if (arguments.method == "embree" && (arguments.all || arguments.closed))
    throw Usage_error("--method embree traces first hits at t > 0: leave out --all and --closed");
  const std::vector<Exact_ray> rays = read_rays(arguments.rays);
  const Scene scene = scene_of(common.read());
  const Ray_start start = arguments.closed ? Ray_start::closed : Ray_start::open;
  Traced traced = arguments.method == "tree"     ? by_tree(scene, rays, arguments, start)
                  : arguments.method == "embree" ? by_embree(scene, rays, arguments)
                                                 : by_boxes(scene, rays, arguments, start);
  std::size_t hit = 0, tied = 0, along = 0, all = 0;
  for (const std::vector<Face_hit>& hits : traced.hits) {
    hit += !hits.empty();
    tied += hits.size() > 1 && hits[1].t == hits[0].t;
    all += hits.size();
    along += static_cast<std::size_t>(
        std::count_if(hits.begin(), hits.end(), [](const Face_hit& h) { return h.side == Met_side::along; }));
  }
  Json list = Json::array();
  if (!common.json.empty())
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (!arguments.all) {
        list.push_back(first_json(rays[i], traced.hits[i]));
        continue;
      }
      Json& of_ray = list.emplace_back(Json::array());
      for (const Face_hit& h : traced.hits[i]) of_ray.push_back(hit_json(rays[i], h));
    }
  if (write_json(common, "trace", scene,
                 {{"method", arguments.method},
                  {"start", arguments.closed ? "closed" : "open"},
                  {"rays", rays.size()},
                  {"hit", hit},
                  {"hits", std::move(list)}},
                 std::move(traced.counters), {{"prepare", traced.prepare_seconds}, {"trace", traced.seconds}}))
    return Exit::done;
  scene_rows(scene);
  row("rays", fmt::format("{}: {} meet something{}, {} several faces at once", rays.size(), hit,
                          arguments.all ? fmt::format(", {} hits in all", all) : "", tied));
  if (along > 0) row("along", fmt::format("{} hits run along a face", along));
  row("seconds", fmt::format("{:.4f}, and {:.4f} to prepare the scene ({})", traced.seconds, traced.prepare_seconds,
                             arguments.method));
  print_hits(rays, traced, arguments.all);
  return Exit::done;
}

void add_trace(Command program) {
  const Command command = program.add_command(
      "trace", "What rays meet first, or at all: faces, exact parameters and points, ties and grazing included");
  auto a = std::make_shared<Trace_arguments>();
  a->common.add_to(command);
  command
      .add_option("--rays", a->rays,
                  "a file with X,Y,Z,DX,DY,DZ a line: the points (X, Y, Z) + t (DX, DY, DZ), t > 0; decimals or p/q, "
                  "# begins a comment")
      .required()
      .reads_file();
  command.add_flag("--all", a->all, "all hits of each ray, in order; by default the first");
  command.add_flag("--closed", a->closed, "what holds a ray's origin is met, at t = 0; by default it is passed over");
  command
      .add_option("--method", a->method,
                  "boxes: exact, quick; tree: exact, by a BSP tree; embree: in floats, as others do")
      .check(one_of({"boxes", "tree", "embree"}))
      .show_default();
  command.footer(
      "Faces are closed and met from both sides. A ray in a face's plane meets it from t until another t.\n"
      "Example: sightline trace town.qoff --rays rays.csv --json hits.json");
  command.set_action([a] { return run(*a); });
}

}  // namespace sightline::app
