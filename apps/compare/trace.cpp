// compare trace: rays by exact methods and by Embree, through corners, edges, along faces, from faces, from afar.

#include "compare.h"
#include "page.h"

#include "../support/page.h"

#include "../methods/rays.h"
#include "../support/paths.h"

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/rays/by_tree.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/harness/generate/rays.h>

#include <iostream>

namespace sightline::app {

namespace {

/// Rays, by kind, and what each meets first.
struct Asked_rays {
  std::vector<std::string> kinds;
  std::vector<std::size_t> kind;  ///< of each ray
  std::vector<Exact_ray> rays;
  std::vector<std::vector<Face_hit>> truth;
  bool says = false;  ///< the faces that are wrong, too
};

Asked_rays rays_of(const Compare_arguments& arguments, const Polygon_soup& soup) {
  Asked_rays asked;
  asked.says = arguments.says;
  const auto add = [&](const Exact_ray& ray) {
    asked.kind.push_back(asked.kinds.size() - 1);
    asked.rays.push_back(ray);
  };
  if (!arguments.ray_file.empty() || !arguments.own_rays.empty()) {
    asked.kinds.push_back("file");
    for (const Exact_ray& ray : arguments.ray_file.empty() ? arguments.own_rays : read_rays(arguments.ray_file))
      add(ray);
    return asked;
  }
  generate::Random random(arguments.common.seed);
  for (const generate::Ray_kind& kind : generate::ray_kinds()) {
    asked.kinds.emplace_back(kind.name);
    for (std::size_t i = 0; i < arguments.random; ++i) add(kind.make(soup, random));
  }
  return asked;
}

/// What is wrong about one ray: `said` is the face that is named, or nothing.
Json wrong_faces_of(const Exact_ray& ray, const std::vector<Face_hit>& truth, Face_id said) {
  std::vector<Face_id> met, named;
  for (const Face_hit& hit : truth) met.push_back(hit.face);
  if (said != Ray_tracer::Nearest::nothing) named.push_back(said);
  Json wrong{{"missing", {{"faces", met}, {"name", "met, but not named"}}},
             {"extra", {{"faces", named}, {"name", "named, but not met first"}}},
             {"words", fmt::format("the ray from ({}) in direction ({}) meets {}; {} is named", Page::text(ray.origin),
                                   Page::text(ray.direction),
                                   met.empty() ? "nothing" : fmt::format("face {} first", met.front()),
                                   named.empty() ? "nothing" : fmt::format("face {}", said))}};
  if (truth.empty()) return wrong;
  Exact_point at;
  for (std::size_t k = 0; k < 3; ++k) at[k] = ray.origin[k] + truth.front().t * ray.direction[k];
  wrong["line"] = {{"face", met.front()}, {"from", point_json(ray.origin)}, {"to", point_json(at)}};
  return wrong;
}

struct Ray_errors {
  std::size_t rays = 0, missed = 0, invented = 0, wrong = 0;
  Json json() const { return {{"rays", rays}, {"missed", missed}, {"invented", invented}, {"wrong_face", wrong}}; }
};

/// A row: find(ray number) gives the face that is met first, or nothing.
template <class Prepare>
Json judge_rays(const Asked_rays& asked, Prepare prepare) {
  const Peak_memory memory;
  const Stopwatch watch;
  auto find = prepare();
  const double ready = watch.seconds();
  std::vector<Face_id> faces(asked.rays.size());
  for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = find(i);
  const double seconds = watch.seconds() - ready;
  std::vector<Ray_errors> by_kind(asked.kinds.size());
  Json wrong_faces;  // of the first ray that is wrong
  for (std::size_t i = 0; i < faces.size(); ++i) {
    Ray_errors& e = by_kind[asked.kind[i]];
    const std::vector<Face_hit>& truth = asked.truth[i];
    ++e.rays;
    const Ray_errors before = e;
    if (truth.empty()) e.invented += faces[i] != Ray_tracer::Nearest::nothing;
    else if (faces[i] == Ray_tracer::Nearest::nothing) ++e.missed;
    else e.wrong += std::none_of(truth.begin(), truth.end(), [&](const Face_hit& hit) { return hit.face == faces[i]; });
    const bool is_wrong = e.invented + e.missed + e.wrong > before.invented + before.missed + before.wrong;
    if (is_wrong && asked.says && wrong_faces.is_null()) wrong_faces = wrong_faces_of(asked.rays[i], truth, faces[i]);
  }
  Ray_errors all;
  Json kinds = Json::object();
  for (std::size_t k = 0; k < by_kind.size(); ++k) {
    all.rays += by_kind[k].rays;
    all.missed += by_kind[k].missed;
    all.invented += by_kind[k].invented;
    all.wrong += by_kind[k].wrong;
    kinds[asked.kinds[k]] = by_kind[k].json();
  }
  Json row{{"status", "done"},     {"prepare", ready},           {"seconds", seconds}, {"peak_bytes", memory.bytes()},
           {"errors", all.json()}, {"by_kind", std::move(kinds)}};
  if (!wrong_faces.is_null()) row["wrong_faces"] = std::move(wrong_faces);
  return row;
}

Face_id first_face(const std::vector<Face_hit>& hits) {
  return hits.empty() ? Ray_tracer::Nearest::nothing : hits.front().face;
}

Contestant by_embree(const Scene& scene, const Asked_rays& asked, bool watertight) {
  return {{{"kernel", "float"}, {"method", watertight ? "Embree, robust" : "Embree"}}, [&, watertight] {
            if (!has_rays()) return Json{{"status", "left out: this program was built without Embree"}};
            std::vector<Double_ray> rays;
            for (const Exact_ray& ray : asked.rays) rays.push_back(in_doubles(ray));
            return judge_rays(asked, [&] {
              auto floats = std::make_shared<Traced_scene>(scene, 1, watertight);
              return [&, floats](std::size_t i) {
                const Traced_hit hit = floats->first(rays[i]);
                return hit.piece == Piece_image::nothing ? Ray_tracer::Nearest::nothing
                                                         : scene.pieces()[hit.piece].face;
              };
            });
          }};
}

void print_rays(const Asked_rays& asked, const Json& rows) {
  const std::string line = "{:<16} {:>10} {:>10} {:>9} {:>10} {:>10} {:>11}\n";
  std::cout << fmt::format(fmt::runtime(line), "method", "prepare", "ns a ray", "peak MB", "missed", "invented",
                           "wrong face");
  const auto share = [](const Json& e, const char* key) {
    return fmt::format("{:.0f}", 1e6 * e[key].get<double>() / std::max(1.0, e["rays"].get<double>()));
  };
  for (const Json& r : rows) {
    const std::string name = r["method"];
    if (r["status"] != "done") {
      std::cout << fmt::format("{:<16} {}\n", name, r["status"].get<std::string>());
      continue;
    }
    const Json& e = r["errors"];
    std::cout << fmt::format(
        fmt::runtime(line), name, fmt::format("{:.4f}", r["prepare"].get<double>()),
        fmt::format("{:.0f}", 1e9 * r["seconds"].get<double>() / std::max(1.0, e["rays"].get<double>())),
        fmt::format("{:.1f}", r["peak_bytes"].get<double>() / 1e6), share(e, "missed"), share(e, "invented"),
        share(e, "wrong_face"));
    if (r["kernel"] == "exact" || asked.kinds.size() < 2) continue;
    for (const std::string& kind : asked.kinds) {
      const Json& of_kind = r["by_kind"][kind];
      std::cout << fmt::format(fmt::runtime(line), "  " + kind, "", "", "", share(of_kind, "missed"),
                               share(of_kind, "invented"), share(of_kind, "wrong_face"));
    }
  }
}

struct Ray_trial : Trial {
  Scene scene;
  Asked_rays asked;
  std::size_t hit = 0, tied = 0;

  Ray_trial(const Compare_arguments& arguments, const Polygon_soup& soup)
      : scene(scene_of(soup)), asked(rays_of(arguments, soup)) {
    // 1. The truth by boxes; the tree is asked for it again, as a contestant.
    {
      const Ray_tracer tracer(scene);
      Ray_counters counters;
      const auto in_time = arguments.common.within_budget();
      for (const Exact_ray& ray : asked.rays) {
        if (asked.truth.size() % 256 == 0) in_time(asked.truth.size(), asked.rays.size());
        asked.truth.push_back(tracer.first(ray, Ray_start::open, counters));
        hit += !asked.truth.back().empty();
        tied += asked.truth.back().size() > 1;
      }
    }

    // 2. Who is asked.
    contestants = {{{{"kernel", "exact"}, {"method", "boxes"}},
                    [this] {
                      return judge_rays(asked, [&] {
                        auto tracer = std::make_shared<Ray_tracer>(scene);
                        return [&, tracer, counters = Ray_counters()](std::size_t i) mutable {
                          return first_face(tracer->first(asked.rays[i], Ray_start::open, counters));
                        };
                      });
                    }},
                   {{{"kernel", "exact"}, {"method", "tree"}},
                    [this] {
                      return judge_rays(asked, [&] {
                        struct Tree {
                          Exact_traits traits;
                          Exact_tree tree;
                        };
                        Bsp_options options;
                        options.threads = 1;
                        auto made = std::make_shared<Tree>(Tree{Exact_traits(scene), {}});
                        made->tree = build_bsp(made->traits, options);
                        return [&, made](std::size_t i) {
                          return first_face(first_hits(made->traits, made->tree, asked.rays[i]));
                        };
                      });
                    }},
                   by_embree(scene, asked, false),
                   by_embree(scene, asked, true)};
    right = [](const Json& r) {
      return r["errors"]["missed"] == 0 && r["errors"]["invented"] == 0 && r["errors"]["wrong_face"] == 0;
    };
  }
};

}  // namespace

std::unique_ptr<Trial> trace_trial(const Compare_arguments& arguments, const Polygon_soup& soup) {
  return std::make_unique<Ray_trial>(arguments, soup);
}

Exit compare_rays(const Compare_arguments& arguments) {
  const Common& common = arguments.common;
  const Ray_trial trial(arguments, common.read());
  const std::size_t count = trial.asked.rays.size();
  Json rows = Json::array();
  const Exit exit = ask(trial, common.budget, rows);
  if (!arguments.html.empty()) write_comparison(arguments, trial.scene, rows);
  if (write_json(common, "compare", trial.scene,
                 {{"question", "trace"}, {"rays", count}, {"hit", trial.hit}, {"tied", trial.tied}, {"rows", rows}},
                 Json::object(), Json::object()))
    return exit;
  scene_rows(trial.scene);
  row("rays", fmt::format("{}: {} meet something, {} of them several faces at once; errors are per million", count,
                          trial.hit, trial.tied));
  print_rays(trial.asked, rows);
  return exit;
}

}  // namespace sightline::app
