// The question cutset: which faces a moving viewpoint is in front of, and the edges between these and the rest.

#include "questions.h"

#include <sightline/algorithms/cutset/tracker.h>
#include <sightline/algorithms/cutset/update_1977.h>
#include <sightline/harness/compare/cut_set_errors.h>
#include <sightline/harness/generate/random.h>

namespace sightline::app {

namespace {

/// Viewpoints where answers are hard: at corners, beyond them along edges, between them; and a walk of small steps
/// about the scene. The same arguments give the same.
std::vector<Viewpoint> hard_views(const Polygon_soup& soup, std::size_t count, std::uint64_t seed) {
  generate::Random random(seed);
  std::vector<Viewpoint> views;
  if (soup.point_count() == 0) return views;
  const auto any = [&] { return soup.point(static_cast<Point_id>(random.below(soup.point_count()))); };
  const auto between = [](const Exact_point& p, const Exact_point& q, const Rational& t) {
    Exact_point r;
    for (std::size_t k = 0; k < 3; ++k) r[k] = p[k] + t * (q[k] - p[k]);
    return r;
  };
  Exact_point walk = any();
  for (std::size_t k = 0; k < count; ++k) {
    const Exact_point p = any(), q = any();
    switch (k % 4) {
      case 0: views.push_back({between(p, q, Rational(static_cast<long>(random.between(-2, 3))))}); break;
      case 1: views.push_back({between(p, q, Rational(static_cast<long>(random.between(-3, 6)), 3))}); break;
      default: views.push_back({walk = between(walk, between(p, q, 2), Rational(1, 16))}); break;
    }
    for (Rational& x : views.back().at) {
      x.canonicalize();
      constexpr double most = std::numeric_limits<double>::max();
      x = exact(std::clamp(nearest_double(x), -most, most));
    }
  }
  return views;
}

/// How many nodes and edges are wrong at a viewpoint, and which nodes are said to be on-view.
struct Frame_errors {
  std::size_t count = 0;
  std::vector<bool> said;
};

/// Moves to a viewpoint, and gives what counts the errors there, once the time is taken.
using Count = std::function<Frame_errors()>;
using Frame_counts = std::function<Count(std::size_t view)>;

struct Cut_set_trial : Trial {
  Scene scene;
  Face_graph graph;
  Exact_traits traits;
  std::vector<Viewpoint> views;
  std::vector<std::vector<bool>> truth;
  bool says;

  Cut_set_trial(const Compare_arguments& arguments, const Polygon_soup& soup)
      : scene(soup),
        graph(scene),
        traits(scene),
        views(hard_views(soup, arguments.random, arguments.common.seed)),
        says(arguments.says) {
    for (const Viewpoint& view : views) truth.push_back(on_view_nodes(traits, graph, view));
    const auto add = [&](const char* kernel, const char* method, std::function<Json()> judge) {
      contestants.push_back({{{"kernel", kernel}, {"method", method}}, std::move(judge)});
    };
    add("exact", "tracker", [this] {
      return judged([this] {
        auto tracker = std::make_shared<Cut_set_tracker<Exact_traits>>(traits, graph);
        return [this, tracker](std::size_t k) {
          tracker->move_to(views[k]);
          return wrong(k, *tracker);
        };
      });
    });
    for (const bool mended : {true, false})
      add("exact", mended ? "1977" : "1977-literal", [this, mended] {
        return judged([this, mended] {
          auto update = std::make_shared<Cut_set_1977<Exact_traits>>(
              traits, graph, views[0], mended ? Reading_1977::mended : Reading_1977::literal);
          return [this, update](std::size_t k) {
            if (k > 0) update->update_1977(views[k]);
            return wrong(k, *update);
          };
        });
      });
    add("exact", "each face", [this] {
      return judged([this] {
        return [this](std::size_t k) -> Count {
          const std::vector<bool> on = on_view_nodes(traits, graph, views[k]);
          return [this, k, on] { return errors(k, on); };
        };
      });
    });
    add("double", "each face", [this] { return judged([this] { return in_numbers<double>(); }); });
    add("float", "each face", [this] { return judged([this] { return in_numbers<float>(); }); });
    right = [](const Json& r) {
      return r["method"].get<std::string>().starts_with("1977") || r["errors"]["wrong_frames"] == 0;
    };
  }

  Frame_errors errors(std::size_t k, const std::vector<bool>& on) const {
    Frame_errors errors{0, on};
    for (std::size_t node = 0; node < on.size(); ++node) errors.count += on[node] != truth[k][node];
    return errors;
  }
  template <class Tracker>
  Count wrong(std::size_t k, const Tracker& tracker) const {
    return [this, k, &tracker] {
      Frame_errors errors{cut_set_errors(graph, truth[k], tracker), {}};
      for (std::uint32_t node = 0; node < graph.size(); ++node) errors.said.push_back(tracker.on_view(node));
      return errors;
    };
  }

  /// Faces whose side is wrong at a viewpoint, or which edges of the cut-set are wrong beside.
  Json wrong_faces(std::size_t k, const Frame_errors& errors) const {
    std::vector<Face_id> missing, extra;
    for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
      const std::uint32_t node = graph.node(i);
      const Face_id face = scene.pieces()[i].face;
      if (truth[k][node] == errors.said[node]) continue;
      std::vector<Face_id>& faces = truth[k][node] ? missing : extra;
      if (faces.empty() || faces.back() != face) faces.push_back(face);
    }
    return {
        {"missing", {{"faces", missing}, {"name", "on-view, but not said to be"}}},
        {"extra", {{"faces", extra}, {"name", "off-view, but said to be on-view"}}},
        {"at", point_json(views[k].at)},
        {"words", missing.size() + extra.size() > 0
                      ? fmt::format("at viewpoint {} of a path: on-view faces missing {}, too many {}", k + 1,
                                    missing.size(), extra.size())
                      : fmt::format("at viewpoint {} of a path edges of the cut-set are wrong, and no face", k + 1)}};
  }

  template <class Number>
  Frame_counts in_numbers() const {
    auto planes = std::make_shared<const Rounded_planes<Number>>(graph);
    return [this, planes](std::size_t k) -> Count {
      const std::vector<bool> on = planes->on_view(views[k]);
      return [this, k, on] { return errors(k, on); };
    };
  }

  Json judged(const std::function<Frame_counts()>& prepare) const {
    const Peak_memory memory;
    Stopwatch watch;
    const Frame_counts frame = prepare();
    double seconds = watch.seconds();
    std::size_t wrong_frames = 0;
    Json wrong;
    for (std::size_t k = 0; k < views.size(); ++k) {
      watch = {};
      const Count count = frame(k);
      seconds += watch.seconds();
      const Frame_errors errors = count();
      if (errors.count == 0) continue;
      ++wrong_frames;
      // Of the first one, and rather of one where faces are wrong than edges.
      if (says && (wrong.is_null() || (wrong["missing"]["faces"].empty() && wrong["extra"]["faces"].empty())))
        wrong = wrong_faces(k, errors);
    }
    Json row{{"status", "done"},
             {"seconds", seconds},
             {"peak_bytes", memory.bytes()},
             {"errors", {{"frames", views.size()}, {"wrong_frames", wrong_frames}}}};
    if (!wrong.is_null()) row["wrong_faces"] = std::move(wrong);
    return row;
  }
};

}  // namespace

std::unique_ptr<Trial> cutset_trial(const Compare_arguments& arguments, const Polygon_soup& soup) {
  if (soup.point_count() == 0) throw std::invalid_argument("the scene has no point to look from");
  return std::make_unique<Cut_set_trial>(arguments, soup);
}

}  // namespace sightline::app
