// compare pvs: what the cells of a level see, by flooding, by rays at random and from middle to middle, through any
// portals, and by the table that a compiled level came with.

#include "../support/leaves.h"
#include "../support/limited_process.h"
#include "../support/page.h"
#include "compare.h"
#include "leaves.h"
#include "page.h"
#include "sizes.h"

#include <sightline/algorithms/levels/pvs.h>
#include <sightline/harness/compare/cell_sights.h>
#include <sightline/io/quake_bsp.h>
#include <sightline/own_leaves.h>

#include <iostream>
#include <numbers>
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
  bool samples;                       // pairs to measure, too
  std::uint64_t seed;
};

Json judged(const Cells_question& question, const Sets& said, double seconds, const Peak_memory& memory) {
  const std::uint64_t bytes = memory.bytes();
  std::size_t visible = 0, worst = 0;
  Pairs hidden_wrongly, visible_wrongly;
  Json wrong_faces;  // of the first cell that has some
  for (const Cell_id c : question.cells) {
    const std::vector<Face_id>& truth = question.exact.visible[c];
    std::vector<Face_id> missing, more;
    std::set_difference(truth.begin(), truth.end(), said[c].begin(), said[c].end(), std::back_inserter(missing));
    std::set_difference(said[c].begin(), said[c].end(), truth.begin(), truth.end(), std::back_inserter(more));
    visible += said[c].size();
    const std::vector<Face_id>& open = question.exact.undecided[c];  // not judged
    std::erase_if(more, [&](Face_id face) { return std::binary_search(open.begin(), open.end(), face); });
    for (const Face_id face : missing) hidden_wrongly.push_back({c, face});
    for (const Face_id face : more) visible_wrongly.push_back({c, face});
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
  Json row{{"status", "done"},
           {"seconds", seconds},
           {"peak_bytes", bytes},
           {"visible", visible},
           {"pairs", question.exact.counters.pairs},
           {"errors",
            {{"wrongly_visible", visible_wrongly.size()},
             {"wrongly_hidden", hidden_wrongly.size()},
             {"worst_cell", worst}}}};
  if (question.samples)
    row["sample"] = sample_json(std::move(hidden_wrongly), std::move(visible_wrongly), question.seed);
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
      if (k % rays_a_point == 0) p = question.occluders.located(points.any(random)).near;
      const auto hit = question.occluders.first_hit(p, {normal(random), normal(random), normal(random)});
      if (hit && hit->front) seen.insert(scene.pieces()[hit->piece].face);
    }
    sets[c].assign(seen.begin(), seen.end());
  }
  return sets;
}

/// Rays from the middle of each cell to the middle of each piece of a face, in doubles: what they meet first.
Sets by_midpoints(const Cells_question& question) {
  const Scene& scene = question.level.scene();
  std::vector<Triple> middles;
  for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
    const Near_polygon corners = question.occluders.polygon(piece);
    Triple& middle = middles.emplace_back(Triple{});
    for (const Near_point& corner : corners)
      for (std::size_t k = 0; k < 3; ++k) middle[k] += corner.near[k] / static_cast<double>(corners.size());
  }
  Sets sets(question.level.cells().size());
  for (const Cell_id c : question.cells) {
    const Triple p = question.occluders.located(question.level.inside(c)).near;
    std::set<Face_id> seen(question.level.cells()[c].faces.begin(), question.level.cells()[c].faces.end());
    for (const Triple& q : middles) {
      const auto hit = question.occluders.first_hit(p, {q[0] - p[0], q[1] - p[1], q[2] - p[2]});
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

/// For each cell what the table says of the leaf that it is in; of solid and sky it says nothing.
Sets by_engine(const Cells_question& question, const Quake_level& file) {
  Sets sets(question.level.cells().size());
  for (const Cell_id c : question.cells) {
    const Level_cell& cell = question.level.cells()[c];
    if (!file.is_open(cell.leaf)) {
      sets[c] = question.exact.visible[c];  // nothing to judge
      continue;
    }
    std::set<Face_id> seen(cell.faces.begin(), cell.faces.end());
    const auto add = [&](std::size_t leaf) {
      seen.insert(file.leaves[leaf].faces.begin(), file.leaves[leaf].faces.end());
    };
    add(cell.leaf);
    for (const std::size_t other : file.seen_from(cell.leaf)) add(other);
    sets[c].assign(seen.begin(), seen.end());
  }
  return sets;
}

// ---- Sizes

/// A pair that a method hides, what shows that it is wrong, and what is seen of the face from there.
struct Sight {
  Cell_id cell;
  Cell_sightline line;
  Seen_face seen;
};

/// Of the pairs that the table hides those that an exact sightline shows, as far as time goes.
std::vector<std::pair<Cell_id, Cell_sightline>> refutations(const Cells_question& question, const Quake_level& file,
                                                            Cell_sights& sights, const Cell_sights::Is_over& is_over) {
  std::vector<std::pair<Cell_id, Cell_sightline>> all;
  const Sets said = by_engine(question, file);
  try {
    for (const Cell_id c : question.cells) {
      std::vector<Face_id> missing;
      const std::vector<Face_id>& truth = question.exact.visible[c];
      std::set_difference(truth.begin(), truth.end(), said[c].begin(), said[c].end(), std::back_inserter(missing));
      if (missing.empty()) continue;
      for (Cell_sightline& line : sights.sightlines(c, missing, is_over)) all.emplace_back(c, std::move(line));
    }
  } catch (const Out_of_budget&) {
  }
  return all;
}

/// How large their faces look, of as many as there is time for.
std::vector<Sight> measured(std::vector<std::pair<Cell_id, Cell_sightline>> lines, Cell_sights& sights,
                            const Cell_sights::Is_over& is_over) {
  std::vector<Sight> all;
  try {
    for (auto& [cell, line] : lines) {
      Seen_face seen = sights.seen(line.from, line.face, is_over);
      all.push_back({cell, std::move(line), std::move(seen)});
    }
  } catch (const Out_of_budget&) {
  }
  return all;
}

/// Of a sample of such pairs, as many as there is time for.
std::vector<Sight> sights_of(const Json& sample, Cell_sights& sights, const Cell_sights::Is_over& is_over) {
  std::vector<Sight> all;
  try {
    for (const Json& pair : sample)
      for (Cell_sightline& line : sights.sightlines(pair[0], {pair[1].get<Face_id>()}, is_over)) {
        Seen_face seen = sights.seen(line.from, line.face, is_over);
        all.push_back({pair[0], std::move(line), std::move(seen)});
      }
  } catch (const Out_of_budget&) {
  }
  return all;
}

/// The same of pairs that a method has too many: how large they would look.
Screen_sizes sizes_alone(const Json& sample, const Cell_sights& sights, const Cell_sights::Is_over& is_over) {
  Screen_sizes sizes;
  for (const Json& pair : sample) {
    if (is_over && is_over()) break;
    sizes.add(sights.size_alone(pair[0], pair[1]));
  }
  return sizes;
}

/// What draws a face as it is seen, the largest part of it in the middle, a twentieth of the picture wide unless that
/// took more than 90 degrees.
std::string how_to_draw(const std::string& scene, const Sight& sight) {
  constexpr double degree = std::numbers::pi / 180;
  const double field = std::clamp(20 * sight.seen.width / degree, least_field, 90.0);
  std::string eye, look;
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational& from = sight.line.from[k];
    eye += (k > 0 ? "," : "") + to_string(from);
    look += fmt::format("{}{}", k > 0 ? "," : "", nearest_double(Rational(sight.seen.middle[k] - from)));
  }
  return fmt::format("sightline see {} --eye={} --look={} --field {:.3g} --svg face-{}.svg", shell_word(scene), eye,
                     look, field, sight.line.face);
}

/// The largest first.
Json sightlines_json(const Cells_question& question, const std::string& scene, const Space_tree& tree,
                     std::vector<Sight> sights, const Sightline_files* files) {
  std::stable_sort(sights.begin(), sights.end(),
                   [](const Sight& a, const Sight& b) { return a.seen.pixels > b.seen.pixels; });
  Json all = Json::array();
  for (const Sight& sight : sights) {
    const std::uint32_t leaf = question.level.cells()[sight.cell].leaf;
    all.push_back({{"leaf", leaf},
                   {"face", sight.line.face},
                   {"cell", sight.cell},
                   {"from", point_json(sight.line.from)},
                   {"to", point_json(sight.line.to)},
                   {"through", leaves_along(tree, sight.line.from, sight.line.to)},
                   {"pixels", sight.seen.pixels},
                   {"draw", how_to_draw(scene, sight)}});
    if (files == nullptr) continue;
    const std::optional<std::string> file = files->write(sight.cell, leaf, sight.line);
    if (file) all.back()["certificate"] = *file;
  }
  return all;
}

void print(const Json& rows) {
  const std::string line = "{:<22} {:>9} {:>9} {:>10} {:>16} {:>15} {:>11}\n";
  std::cout << fmt::format(fmt::runtime(line), "method", "seconds", "peak MB", "visible", "wrongly visible",
                           "wrongly hidden", "worst cell");
  for (const Json& r : rows) {
    const std::string name = cells_name(r);
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

/// A compiled level with a table of what its leaves see.
std::optional<Quake_level> level_with_table(const Common& common) {
  const std::string bytes = common.scene.empty() ? std::string() : level_bytes(common);
  if (!looks_like_quake_level(bytes)) return {};
  Quake_level file = read_quake_level({common.scene, bytes});
  if (file.visibility.empty()) return {};
  return file;
}

struct Level_trial : Trial {
  Time_limit limit;                 // for the truth
  std::optional<Quake_level> file;  // cells are within its leaves
  Space_tree tree;                  // that of the file
  Level_cells level;
  Occluders occluders;
  Pvs_options options;
  Stopwatch watch;
  Pvs exact;
  double seconds;
  std::vector<Cell_id> cells;
  Cells_question question;

  /// The budget is for the truth too, which leaves pairs open then. `samples`: there are pairs to measure.
  Level_trial(const Compare_arguments& arguments, const Polygon_soup& soup, bool samples)
      : limit(arguments.common.budget),
        file(level_with_table(arguments.common)),
        tree(file ? space_tree(*file, arguments.common.scene) : Space_tree()),
        level(soup, cell_options(arguments.common, tree)),
        occluders(level.scene()),
        options(pvs_options(arguments.common)),
        exact(potentially_visible(level, in_time())),
        seconds(watch.seconds()),
        cells(asked_cells(exact)),
        question{level, occluders, exact, cells, arguments.says, samples, arguments.common.seed} {
    const Common& common = arguments.common;
    add({{"kernel", "exact"}, {"method", "flooding"}}, [this] { return potentially_visible(level, options).visible; });
    for (const std::size_t rays : arguments.rays)
      add({{"kernel", "double"}, {"method", "rays"}, {"rays", rays}},
          [this, rays, seed = common.seed] { return by_rays(question, rays, seed); });
    add({{"kernel", "double"}, {"method", "midpoints"}}, [this] { return by_midpoints(question); });
    add({{"kernel", "exact"}, {"method", "any portals"}}, [this] { return by_portals(question); });
    if (file) add({{"kernel", "float"}, {"method", "the file's table"}}, [this] { return by_engine(question, *file); });
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
  Pvs_options in_time() const {
    Pvs_options limited = options;
    limited.search.out_of_time = limit.end();
    return limited;
  }
  /// On one thread, since processes are made after it.
  static Cell_options cell_options(const Common& common, const Space_tree& tree) {
    Cell_options options;
    options.tree = tree;
    options.seed = common.seed;
    options.threads = 1;
    options.progress = common.within_budget();
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
  auto trial = std::make_unique<Level_trial>(arguments, soup, false);
  if (trial->exact.counters.undecided > 0) throw Out_of_budget("undecided: the truth takes longer than the budget");
  return trial;
}

Exit compare_cells(const Compare_arguments& arguments) {
  const Common& common = arguments.common;
  const Polygon_soup soup = common.read();
  const Level_trial trial(arguments, soup, true);
  const Model model(soup);
  std::optional<Sightline_files> files;
  if (!arguments.sightlines.empty()) {
    if (!trial.file) throw Usage_error("--sightlines are of a compiled level, .bsp, that has a table; SCENE has none");
    files.emplace(arguments.sightlines, trial.level, model);
  }
  const Sightline_files* const to_files = files ? &*files : nullptr;
  const auto& [level, exact, question, file] = std::tie(trial.level, trial.exact, trial.question, trial.file);

  // 1. What methods say, each in a process of its own.
  Json rows = Json::array();
  Exit exit = ask(trial, common.budget, rows);
  std::optional<Leaves_compared> leaves;
  if (file) leaves = compare_leaves(arguments, *file, trial.tree, level, trial.occluders, to_files);
  if (exit == Exit::done && leaves) exit = leaves->exit;
  if (exit == Exit::done && exact.counters.undecided + (leaves ? leaves->undecided : 0) > 0) exit = Exit::undecided;

  // 2. What shows that the table is wrong, and how large that looks which methods have wrong.
  Cell_sights sights(level, trial.occluders, model);
  std::size_t refuted = 0;
  Json sightlines = Json::array();
  for (Json& r : rows) {
    if (r["status"] != "done") continue;
    const Cell_sights::Is_over is_over = Time_limit(common.budget).end();
    const std::vector<Sight> hidden = sights_of(r["sample"]["wrongly_hidden"], sights, is_over);
    Screen_sizes of_hidden;
    for (const Sight& sight : hidden) of_hidden.add(sight.seen.pixels);
    const Screen_sizes of_visible = sizes_alone(r["sample"]["wrongly_visible"], sights, is_over);
    r["sizes"] = {{"wrongly_hidden", sizes_json(of_hidden)}, {"wrongly_visible", sizes_json(of_visible)}};
    r.erase("sample");
    if (r["method"] == "the file's table") {
      const Cell_sights::Is_over also_over = Time_limit(common.budget).end();
      std::vector<std::pair<Cell_id, Cell_sightline>> lines = refutations(question, *file, sights, also_over);
      refuted = lines.size();
      sightlines =
          sightlines_json(question, common.scene, trial.tree, measured(std::move(lines), sights, also_over), to_files);
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
  print_sizes(rows);
  if (leaves) {
    row("leaves", fmt::format("{} pairs of leaves, each other way round too: {} visible, {} undecided", leaves->pairs,
                              leaves->visible, leaves->undecided));
    print(leaves->rows);
    row("the table",
        fmt::format("hides {} pairs of leaves that have an exact sightline in the open, {} more through what it calls "
                    "solid and has no face; --json lists all",
                    leaves->refuted, leaves->through_solid));
  }
  if (file)
    row("the table", fmt::format("hides {} pairs of a cell and a face that have an exact sightline; --json lists "
                                 "them, the largest first, and how to draw each",
                                 refuted));
  return exit;
}

}  // namespace sightline::app
