// compare pvs: what the cells of a level see, by flooding, by random rays, through any portals, and by the table that a
// compiled level came with.

#include "compare.h"
#include "page.h"

#include "../support/page.h"
#include "leaves.h"

#include <sightline/algorithms/levels/pvs.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/io/file.h>
#include <sightline/io/quake_bsp.h>

#include <iostream>
#include <random>
#include <set>

namespace sightline::app {

namespace {

/// What a method says: by cell, ascending.
using Sets = std::vector<std::vector<Face_id>>;

struct Cells_question {
  const Level_cells& level;
  const Occluders& occluders;
  const Pvs& exact;
  const std::vector<Cell_id>& cells;  // that are asked about
  bool says;                          // the faces that are wrong, too
};

Json judged(const Cells_question& question, const Sets& said, double seconds, const Peak_memory& memory) {
  std::size_t visible = 0, hidden_wrongly = 0, visible_wrongly = 0, worst = 0;
  Json wrong_faces;  // of the first cell that has some
  for (const Cell_id c : question.cells) {
    const std::vector<Face_id>& truth = question.exact.visible[c];
    std::vector<Face_id> missing, more;
    std::set_difference(truth.begin(), truth.end(), said[c].begin(), said[c].end(), std::back_inserter(missing));
    std::set_difference(said[c].begin(), said[c].end(), truth.begin(), truth.end(), std::back_inserter(more));
    visible += said[c].size();
    hidden_wrongly += missing.size();
    visible_wrongly += more.size();
    worst = std::max(worst, missing.size());
    if (question.says && wrong_faces.is_null() && missing.size() + more.size() > 0) {
      const Exact_point at = question.level.inside(c);
      wrong_faces = {{"missing", {{"faces", missing}, {"name", "seen by the cell, not said"}}},
                     {"extra", {{"faces", more}, {"name", "said, not seen by the cell"}}},
                     {"at", point_json(at)},
                     {"words", fmt::format("cell {}, about ({}): faces that it sees missing {}, too many {}", c,
                                           Page::text(at), missing.size(), more.size())}};
    }
  }
  Json row{
      {"status", "done"},
      {"seconds", seconds},
      {"peak_bytes", memory.bytes()},
      {"visible", visible},
      {"pairs", question.exact.counters.pairs},
      {"errors", {{"wrongly_visible", visible_wrongly}, {"wrongly_hidden", hidden_wrongly}, {"worst_cell", worst}}}};
  if (!wrong_faces.is_null()) row["wrong_faces"] = std::move(wrong_faces);
  return row;
}

/// Random points of a cell: weighted means of its corners.
class Cell_points {
 public:
  Cell_points(const Level_cells& level, Cell_id cell) {
    std::set<std::uint32_t> corners;
    for (const std::uint32_t w : level.cells()[cell].walls)
      corners.insert(level.walls()[w].corners.begin(), level.walls()[w].corners.end());
    for (const std::uint32_t p : corners) corners_.push_back(level.points()[p]);
  }
  Exact_point any(std::mt19937_64& random) const {
    Exact_point p{};
    long sum = 0;
    for (const Exact_point& corner : corners_) {
      const long weight = 1 + static_cast<long>(random() % 64) * static_cast<long>(random() % 64);
      sum += weight;
      for (std::size_t k = 0; k < 3; ++k) p[k] += weight * corner[k];
    }
    for (Rational& x : p) x /= sum;
    return p;
  }

 private:
  std::vector<Exact_point> corners_;
};

/// As many rays from random points of each cell in random directions, in doubles.
Sets by_rays(const Cells_question& question, std::size_t rays, std::uint64_t seed) {
  const Scene& scene = question.level.scene();
  Sets sets(question.level.cells().size());
  for (const Cell_id c : question.cells) {
    std::mt19937_64 random(seed * 1000003 + c);
    std::normal_distribution<double> normal;
    const Cell_points points(question.level, c);
    std::set<Face_id> seen(question.level.cells()[c].faces.begin(), question.level.cells()[c].faces.end());
    constexpr std::size_t rays_a_point = 16;
    Triple p{};
    for (std::size_t k = 0; k < rays; ++k) {
      if (k % rays_a_point == 0) {
        const Located_point at = scene.locate(points.any(random));
        p = near_point(question.occluders.frame(), {at.x, at.y, at.z, at.w}).near;
      }
      const auto hit = question.occluders.first_hit(p, {normal(random), normal(random), normal(random)});
      if (hit && hit->front) seen.insert(scene.pieces()[hit->piece].face);
    }
    sets[c].assign(seen.begin(), seen.end());
  }
  return sets;
}

/// All faces of a region: what portals lead to at all.
Sets by_portals(const Cells_question& question) {
  std::vector<std::set<Face_id>> of_region(question.level.counters().regions);
  for (const Cell_id c : question.cells) {
    const Level_cell& cell = question.level.cells()[c];
    of_region[cell.region].insert(cell.faces.begin(), cell.faces.end());
  }
  Sets sets(question.level.cells().size());
  for (const Cell_id c : question.cells) {
    const std::set<Face_id>& faces = of_region[question.level.cells()[c].region];
    sets[c].assign(faces.begin(), faces.end());
  }
  return sets;
}

// ---- The table of a compiled level

class Engine {
 public:
  explicit Engine(Quake_level level) : level_(std::move(level)), faces_(level_.leaves.size()) {
    for (std::size_t l = 1; l < level_.leaves.size(); ++l) {
      std::set<Face_id> faces(level_.leaves[l].faces.begin(), level_.leaves[l].faces.end());
      for (const std::size_t other : level_.seen_from(l))
        faces.insert(level_.leaves[other].faces.begin(), level_.leaves[other].faces.end());
      faces_[l].assign(faces.begin(), faces.end());
    }
  }
  const Quake_level& file() const { return level_; }
  /// The leaf of a point, by the file's own planes, exactly.
  std::size_t leaf_at(const Exact_point& p) const {
    std::int32_t at = level_.root;
    while (at >= 0) {
      const Quake_level::Node& node = level_.nodes[static_cast<std::size_t>(at)];
      const Quake_level::Plane& plane = level_.planes[node.plane];
      Rational height = -exact(double{plane.distance});
      for (std::size_t k = 0; k < 3; ++k) height += exact(double{plane.normal[k]}) * p[k];
      at = node.children[height < 0 ? 1 : 0];
    }
    return static_cast<std::size_t>(-1 - at);
  }
  const std::vector<Face_id>& seen_from(std::size_t leaf) const { return faces_[leaf]; }
  bool knows(std::size_t leaf) const { return level_.is_open(leaf); }

 private:
  Quake_level level_;
  std::vector<std::vector<Face_id>> faces_;
};

/// For each cell what the table says of the leaves that some of its points are in; of sky alone it says nothing.
Sets by_engine(const Cells_question& question, const Engine& engine) {
  Sets sets(question.level.cells().size());
  for (const Cell_id c : question.cells) {
    std::set<Face_id> seen(question.level.cells()[c].faces.begin(), question.level.cells()[c].faces.end());
    std::mt19937_64 random(c);
    const Cell_points points(question.level, c);
    bool known = false;
    for (std::size_t k = 0; k < 24; ++k) {
      const std::size_t leaf = engine.leaf_at(points.any(random));
      if (!engine.knows(leaf)) continue;
      seen.insert(engine.seen_from(leaf).begin(), engine.seen_from(leaf).end());
      known = true;
    }
    if (known) sets[c].assign(seen.begin(), seen.end());
    else sets[c] = question.exact.visible[c];  // nothing to judge
  }
  return sets;
}

/// Sightlines from a leaf to a face that the leaf's row leaves out: exact, and free of all faces.
Json refutations(const Cells_question& question, const Engine& engine, const Sets& said, std::size_t& count) {
  constexpr std::size_t most = 20;
  Json all = Json::array();
  const Scene& scene = question.level.scene();
  for (const Cell_id c : question.cells) {
    std::vector<Face_id> missing;
    const std::vector<Face_id>& truth = question.exact.visible[c];
    std::set_difference(truth.begin(), truth.end(), said[c].begin(), said[c].end(), std::back_inserter(missing));
    if (missing.empty()) continue;
    std::vector<Weak_source> sources;
    for (const std::vector<Exact_point>& portal : portals_of(question.level, c))
      sources.push_back(weak_source(question.occluders, portal));
    Weak_options options;
    options.threads = 1;
    options.faces = missing;
    for (const Weakly_visible::Pair& pair : weakly_visible(question.occluders, sources, options).pairs) {
      if (pair.answer.status != Weak_status::visible) continue;
      const Exact_point r = scene.position(pair.answer.sightline[0].exact),
                        q = scene.position(pair.answer.sightline[1].exact);
      // From a little before the portal, within the cell.
      Exact_point p;
      Rational back(1, 64);
      do {
        back /= 16;
        for (std::size_t k = 0; k < 3; ++k) p[k] = r[k] + back * (r[k] - q[k]);
      } while (question.level.at(p) != c && back > Rational(1, 1l << 60));
      const Face_id face = scene.pieces()[pair.piece].face;
      const std::size_t leaf = engine.leaf_at(p);
      if (!engine.knows(leaf)) continue;
      const std::vector<Face_id>& row = engine.seen_from(leaf);
      if (std::binary_search(row.begin(), row.end(), face)) continue;
      ++count;
      if (all.size() < most)
        all.push_back({{"leaf", leaf}, {"face", face}, {"cell", c}, {"from", point_json(p)}, {"to", point_json(q)}});
    }
  }
  return all;
}

void print(const Json& rows) {
  const std::string line = "{:<22} {:>9} {:>9} {:>10} {:>16} {:>15} {:>11}\n";
  std::cout << fmt::format(fmt::runtime(line), "method", "seconds", "peak MB", "visible", "wrongly visible",
                           "wrongly hidden", "worst cell");
  for (const Json& r : rows) {
    std::string name = r["method"];
    if (r.contains("rays")) name += fmt::format(", {} a cell", r["rays"].get<std::size_t>());
    if (r["status"] != "done") {
      std::cout << fmt::format("{:<22} {}\n", name, r["status"].get<std::string>());
      continue;
    }
    const Json& e = r["errors"];
    std::cout << fmt::format(fmt::runtime(line), name, fmt::format("{:.4f}", r["seconds"].get<double>()),
                             fmt::format("{:.1f}", r["peak_bytes"].get<double>() / 1e6),
                             r["visible"].get<std::size_t>(), e["wrongly_visible"].get<std::size_t>(),
                             e["wrongly_hidden"].get<std::size_t>(),
                             e.contains("worst_cell") ? e["worst_cell"].dump() : "");
  }
}

/// Cells that eyes may be in.
std::vector<Cell_id> asked_cells(const Pvs& exact) {
  std::vector<Cell_id> cells;
  for (Cell_id c = 0; c < exact.is_asked.size(); ++c)
    if (exact.is_asked[c] != 0) cells.push_back(c);
  return cells;
}

struct Level_trial : Trial {
  Level_cells level;
  Occluders occluders;
  Pvs_options options;
  Stopwatch watch;
  Pvs exact;
  double seconds;
  std::vector<Cell_id> cells;
  Cells_question question;
  std::optional<Engine> engine;

  /// `limited`: the budget is for the truth too, which leaves pairs open then.
  Level_trial(const Compare_arguments& arguments, const Polygon_soup& soup, bool limited)
      : level(soup, cell_options(arguments.common)),
        occluders(level.scene()),
        options(pvs_options(arguments.common)),
        exact(potentially_visible(level, limited ? within(arguments.common.budget) : options)),
        seconds(watch.seconds()),
        cells(asked_cells(exact)),
        question{level, occluders, exact, cells, arguments.says} {
    const Common& common = arguments.common;
    const std::string bytes = common.scene.empty() || common.scene == "-" ? std::string() : read_bytes(common.scene);
    if (looks_like_quake_level(bytes)) {
      Quake_level file = read_quake_level({common.scene, bytes});
      if (!file.visibility.empty()) engine.emplace(std::move(file));
    }
    add({{"kernel", "exact"}, {"method", "flooding"}}, [this] { return potentially_visible(level, options).visible; });
    for (const std::size_t rays : arguments.rays)
      add({{"kernel", "double"}, {"method", "rays"}, {"rays", rays}},
          [this, rays, seed = common.seed] { return by_rays(question, rays, seed); });
    add({{"kernel", "exact"}, {"method", "any portals"}}, [this] { return by_portals(question); });
    if (engine)
      add({{"kernel", "float"}, {"method", "the file's table"}}, [this] { return by_engine(question, *engine); });
    right = [](const Json& r) {
      return r["errors"]["wrongly_hidden"] == 0 &&
             (r["method"] == "any portals" || r["errors"]["wrongly_visible"] == 0);
    };
  }

  void add(Json name, std::function<Sets()> method) {
    contestants.push_back({std::move(name), [this, method = std::move(method)] {
                             const Peak_memory memory;
                             const Stopwatch own;
                             const Sets sets = method();
                             return judged(question, sets, own.seconds(), memory);
                           }});
  }
  Pvs_options within(double budget) const {
    Pvs_options limited = options;
    limited.search.out_of_time = Time_limit(budget).end();
    return limited;
  }
  /// On one thread, since processes are made after it.
  static Cell_options cell_options(const Common& common) {
    Cell_options options;
    options.seed = common.seed;
    options.threads = 1;
    return options;
  }
  static Pvs_options pvs_options(const Common& common) {
    Pvs_options options;
    options.threads = 1;
    options.search.seed = common.seed;
    return options;
  }
};

}  // namespace

std::unique_ptr<Trial> pvs_trial(const Compare_arguments& arguments, const Polygon_soup& soup) {
  auto trial = std::make_unique<Level_trial>(arguments, soup, arguments.common.budget > 0);
  if (trial->exact.counters.undecided > 0) throw Out_of_budget("undecided: the truth takes longer than the budget");
  return trial;
}

Exit compare_cells(const Compare_arguments& arguments) {
  const Common& common = arguments.common;
  const Level_trial trial(arguments, common.read(), false);
  const auto& [level, exact, question, engine] = std::tie(trial.level, trial.exact, trial.question, trial.engine);
  Json rows = Json::array();
  Exit exit = ask(trial, common.budget, rows);
  std::optional<Leaves_compared> leaves;
  if (engine) leaves = compare_leaves(arguments, engine->file(), common.read());
  if (exit == Exit::done && leaves) exit = leaves->exit;
  if (exit == Exit::done && exact.counters.undecided + (leaves ? leaves->undecided : 0) > 0) exit = Exit::undecided;

  std::size_t refuted = 0;
  Json sightlines = Json::array();
  if (engine) {
    sightlines = refutations(question, *engine, by_engine(question, *engine), refuted);
    if (Json& r = rows.back(); r["status"] == "done") {  // of a table what is proved counts
      r["errors"]["wrongly_hidden"] = refuted;
      r["errors"].erase("worst_cell");
    }
  }
  if (!arguments.html.empty()) write_comparison(arguments, level.scene(), rows);
  Json result{{"question", "pvs"},
              {"cells", trial.cells.size()},
              {"pairs", exact.counters.pairs},
              {"visible", exact.counters.visible},
              {"undecided", exact.counters.undecided},
              {"rows", rows},
              {"refuted", refuted},
              {"sightlines", sightlines}};
  if (leaves)
    result["leaves"] = {{"pairs", leaves->pairs},
                        {"visible", leaves->visible},
                        {"undecided", leaves->undecided},
                        {"seconds", leaves->seconds},
                        {"rows", leaves->rows},
                        {"refuted", leaves->refuted},
                        {"through_solid", leaves->through_solid},
                        {"sightlines", leaves->sightlines}};
  if (write_json(common, "compare", level.scene(), std::move(result), counters_json(exact.counters),
                 {{"pvs", trial.seconds}}))
    return exit;
  scene_rows(level.scene());
  row("exact", fmt::format("{} cells, {} pairs of a cell and a face: {} visible, {} undecided", trial.cells.size(),
                           exact.counters.pairs, exact.counters.visible, exact.counters.undecided));
  print(rows);
  if (leaves) {
    row("leaves", fmt::format("{} pairs of leaves, each other way round too: {} visible, {} undecided", leaves->pairs,
                              leaves->visible, leaves->undecided));
    print(leaves->rows);
    row("the table",
        fmt::format("hides {} pairs of leaves that have an exact sightline in the open, {} more through what it calls "
                    "solid and has no face; --json lists all",
                    leaves->refuted, leaves->through_solid));
  }
  if (engine)
    row("the table", fmt::format("hides {} pairs of a cell and a face from a leaf that has an exact sightline; --json "
                                 "lists the first",
                                 refuted));
  return exit;
}

}  // namespace sightline::app
