#include "leaves.h"

#include "../support/leaves.h"

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>

namespace sightline::app {

namespace {

using Rows = std::vector<std::vector<bool>>;  // of leaf l + 1

struct Leaf_question {
  const Quake_level& file;
  const Level_cells& level;
  const Occluders& occluders;
  const Cell_pvs& pvs;
  const Rows& exact;
  std::vector<std::vector<Cell_id>> cells;  // by leaf, those that are asked about
};

Rows by_table(const Quake_level& file) {
  Rows rows(file.visible_leaves, std::vector<bool>(file.visible_leaves));
  for (std::size_t l = 0; l < rows.size(); ++l)
    for (const std::size_t seen : file.seen_from(l + 1)) rows[l][seen - 1] = true;
  return rows;
}

/// Which leaves see each other, and of which others that is undecided.
std::array<Rows, 2> seen_and_open(const Level_cells& level, Cell_pvs pvs, const Quake_level& file) {
  Rows open = rows_of_level(level, pvs, file);
  for (std::vector<Cell_id>& others : pvs.undecided) others.clear();
  Rows seen = rows_of_level(level, pvs, file);
  for (std::size_t l = 0; l < open.size(); ++l)
    for (std::size_t m = 0; m < open.size(); ++m) open[l][m] = open[l][m] && !seen[l][m];
  return {std::move(seen), std::move(open)};
}

/// Corners of a leaf's cells in near coordinates, and points of their insides. In doubles.
class Leaf_points {
 public:
  explicit Leaf_points(const Leaf_question& question) {
    const Level_cells& level = question.level;
    for (const std::vector<Cell_id>& cells : question.cells) {
      std::vector<std::vector<Triple>>& of_leaf = corners_.emplace_back();
      for (const Cell_id cell : cells) {
        std::set<std::uint32_t> corners;
        for (const std::uint32_t w : level.cells()[cell].walls)
          corners.insert(level.walls()[w].corners.begin(), level.walls()[w].corners.end());
        std::vector<Triple>& own = of_leaf.emplace_back();
        for (const std::uint32_t p : corners) own.push_back(question.occluders.located(level.points()[p]).near);
      }
    }
  }
  bool has(std::size_t leaf) const { return !corners_[leaf].empty(); }
  /// The mean of the corners of its first cell.
  Triple middle(std::size_t leaf) const {
    return mean(corners_[leaf][0], [] { return 1.0; });
  }
  Triple any(std::size_t leaf, std::mt19937_64& random) const {
    std::exponential_distribution<double> weight;
    return mean(corners_[leaf][random() % corners_[leaf].size()], [&] { return weight(random); });
  }

 private:
  template <class Weight>
  static Triple mean(const std::vector<Triple>& corners, Weight weight_of) {
    Triple p{};
    double sum = 0;
    for (const Triple& corner : corners) {
      const double weight = weight_of();
      sum += weight;
      for (std::size_t k = 0; k < 3; ++k) p[k] += weight * corner[k];
    }
    for (double& x : p) x /= sum;
    return p;
  }

  std::vector<std::vector<std::vector<Triple>>> corners_;  // by leaf, by cell
};

/// Whether a segment is free, in doubles.
bool is_free(const Occluders& occluders, const Triple& p, const Triple& q) {
  const Triple way{q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  const auto hit = occluders.first_hit(p, way);
  if (!hit) return true;
  const std::array<double, 4>& h = occluders.plane(hit->piece).near;
  const double height = h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3],
               slope = h[0] * way[0] + h[1] * way[1] + h[2] * way[2];
  return -height / slope > 1;
}

/// Between the middles of each two leaves.
Rows by_midpoints(const Leaf_question& question) {
  const Leaf_points points(question);
  const std::size_t count = question.exact.size();
  Rows rows(count, std::vector<bool>(count));
  for (std::size_t l = 0; l < count; ++l)
    for (std::size_t m = 0; m < l; ++m)
      if (points.has(l + 1) && points.has(m + 1))
        rows[l][m] = rows[m][l] = is_free(question.occluders, points.middle(l + 1), points.middle(m + 1));
  return rows;
}

/// As many segments from random points of each leaf to random points of random others.
Rows by_points(const Leaf_question& question, std::size_t segments, std::uint64_t seed) {
  const Leaf_points points(question);
  const std::size_t count = question.exact.size();
  Rows rows(count, std::vector<bool>(count));
  for (std::size_t l = 0; l < count; ++l) {
    if (!points.has(l + 1)) continue;
    std::mt19937_64 random(seed * 1000003 + l);
    for (std::size_t k = 0; k < segments; ++k) {
      const std::size_t m = random() % count;
      if (m == l || rows[l][m] || !points.has(m + 1)) continue;
      const Triple to = points.any(m + 1, random);
      if (is_free(question.occluders, points.any(l + 1, random), to)) rows[l][m] = rows[m][l] = true;
    }
  }
  return rows;
}

/// `open`: pairs that are undecided, and not judged.
Json judged(const Quake_level& file, const Rows& exact, const Rows& open, const Rows& said, double seconds,
            const Peak_memory& memory) {
  std::size_t visible = 0, hidden_wrongly = 0, visible_wrongly = 0, worst = 0;
  for (std::size_t l = 0; l < exact.size(); ++l) {
    std::size_t missing = 0;
    for (std::size_t m = 0; m < exact.size(); ++m) {
      if (l == m || !file.is_open(l + 1) || !file.is_open(m + 1)) continue;
      visible += said[l][m];
      if (open[l][m]) continue;
      missing += exact[l][m] && !said[l][m];
      visible_wrongly += said[l][m] && !exact[l][m];
    }
    hidden_wrongly += missing;
    worst = std::max(worst, missing);
  }
  return {
      {"status", "done"},
      {"seconds", seconds},
      {"peak_bytes", memory.bytes()},
      {"visible", visible},
      {"errors", {{"wrongly_visible", visible_wrongly}, {"wrongly_hidden", hidden_wrongly}, {"worst_cell", worst}}}};
}

/// Adds the leaves below a node that a segment goes through, in its order.
void add_leaves(const Space_tree& tree, std::int32_t below, const Exact_point& from, const Exact_point& to,
                std::vector<std::size_t>& all) {
  struct Part {
    std::int32_t at;
    Exact_point p, q;
  };
  std::vector<Part> waiting{{below, from, to}};  // a level may be as deep as it has nodes
  while (!waiting.empty()) {
    const auto [at, p, q] = std::move(waiting.back());
    waiting.pop_back();
    if (at < 0) {
      all.push_back(static_cast<std::size_t>(-1 - at));
      continue;
    }
    const Space_tree::Node& node = tree.nodes[static_cast<std::size_t>(at)];
    const std::array<Rational, 4>& h = node.plane;
    const Rational a = h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3],
                   b = h[0] * q[0] + h[1] * q[1] + h[2] * q[2] + h[3];
    if (a == 0 && b == 0) continue;  // along the border of leaves, inside none
    if (sgn(a) * sgn(b) >= 0) {
      waiting.push_back({node.children[a + b > 0 ? 0 : 1], p, q});
      continue;
    }
    Exact_point middle;
    for (std::size_t k = 0; k < 3; ++k) middle[k] = (b * p[k] - a * q[k]) / (b - a);
    waiting.push_back({node.children[a > 0 ? 1 : 0], middle, q});
    waiting.push_back({node.children[a > 0 ? 0 : 1], p, middle});
  }
}

/// That a segment begins and ends in these leaves and meets no closed face: by corners and rationals alone.
bool is_sightline(const std::vector<std::size_t>& leaves, const std::vector<harness::Flat_face>& faces,
                  std::size_t from, std::size_t to, const std::array<Exact_point, 2>& ends) {
  if (leaves.empty() || leaves.front() != from || leaves.back() != to) return false;
  const Exact_point way = minus(ends[1], ends[0]);
  return std::none_of(faces.begin(), faces.end(), [&](const harness::Flat_face& face) {
    const std::optional<Rational> t = harness::met_at(face, ends[0], way);
    return t && *t <= 1;
  });
}

}  // namespace

std::vector<std::size_t> leaves_along(const Space_tree& tree, const Exact_point& from, const Exact_point& to) {
  std::vector<std::size_t> all;
  add_leaves(tree, tree.root, from, to, all);
  return all;
}

Leaves_compared compare_leaves(const Compare_arguments& arguments, const Quake_level& file, const Space_tree& tree,
                               const Level_cells& level, const Occluders& occluders, const Sightline_files* files) {
  const Common& common = arguments.common;
  Pvs_options options;
  options.threads = 1;  // processes are made after it
  options.search.seed = common.seed;
  Leaves_compared compared;
  const Stopwatch watch;
  Time_limit limit(common.budget);
  Pvs_options in_time = options;
  in_time.search.out_of_time = [&] { return limit.is_over(); };
  Cell_pvs_search search(level, in_time);
  const Cell_pvs pvs = search.ask(0, 1);
  compared.seconds = watch.seconds();
  const std::array<Rows, 2> rows = seen_and_open(level, pvs, file);
  const Rows &exact = rows[0], &undecided = rows[1];
  Leaf_question question{file, level, occluders, pvs, exact, {}};
  question.cells.resize(file.leaves.size());
  for (Cell_id c = 0; c < level.cells().size(); ++c)
    if (pvs.is_asked[c] != 0) question.cells[level.cells()[c].leaf].push_back(c);

  // 1. Who says what.
  Trial trial;
  const auto add = [&](Json name, std::function<Rows()> method) {
    trial.contestants.push_back({std::move(name), [&, method = std::move(method)] {
                                   const Peak_memory memory;
                                   const Stopwatch own;
                                   const Rows said = method();
                                   return judged(file, exact, undecided, said, own.seconds(), memory);
                                 }});
  };
  add({{"kernel", "exact"}, {"method", "leaves, flooding"}},
      [&] { return rows_of_level(level, mutually_visible_cells(level, options), file); });
  add({{"kernel", "double"}, {"method", "leaves, midpoints"}}, [&] { return by_midpoints(question); });
  for (const std::size_t segments : arguments.rays)
    add({{"kernel", "double"}, {"method", "leaves, points"}, {"rays", segments}},
        [&question, segments, &common] { return by_points(question, segments, common.seed); });
  add({{"kernel", "float"}, {"method", "leaves, the file's"}}, [&] { return by_table(file); });
  trial.right = [](const Json& r) { return r["errors"]["wrongly_hidden"] == 0 && r["errors"]["wrongly_visible"] == 0; };
  compared.exit = ask(trial, common.budget, compared.rows);
  compared.undecided = pvs.counters.undecided;

  // 2. What refutes the table.
  limit = Time_limit(common.budget);
  const Rows table = by_table(file);
  std::vector<harness::Flat_face> faces;
  for (std::size_t l = 0; l < exact.size(); ++l)
    for (std::size_t m = 0; m < exact.size(); ++m) {
      if (l == m || !file.is_open(l + 1) || !file.is_open(m + 1)) continue;
      ++compared.pairs;
      compared.visible += exact[l][m];
      if (!exact[l][m] || table[l][m]) continue;
      if (faces.empty()) faces = harness::flat_faces_of(level.scene());
      std::optional<std::array<Exact_point, 2>> ends;
      std::array<Cell_id, 2> cells{};
      for (const Cell_id from : question.cells[l + 1]) {
        for (const Cell_id to : question.cells[m + 1])
          if (!ends && std::binary_search(pvs.visible[from].begin(), pvs.visible[from].end(), to)) {
            ends = search.sightline(from, to);
            cells = {from, to};
          }
      }
      if (!ends) continue;
      const std::vector<std::size_t> through = leaves_along(tree, (*ends)[0], (*ends)[1]);
      const bool checked = is_sightline(through, faces, l + 1, m + 1, *ends);
      const bool open =
          std::all_of(through.begin(), through.end(), [&](std::size_t leaf) { return file.is_open(leaf); });
      compared.refuted += checked && open;
      compared.through_solid += checked && !open;
      compared.sightlines.push_back({{"from_leaf", l + 1},
                                     {"to_leaf", m + 1},
                                     {"from", point_json((*ends)[0])},
                                     {"to", point_json((*ends)[1])},
                                     {"through", through},
                                     {"checked", checked}});
      if (!checked) compared.exit = Exit::disagreement;
      if (files == nullptr || !checked) continue;
      if (const std::optional<std::string> proof = files->write(cells, {l + 1, m + 1}, *ends))
        compared.sightlines.back()["certificate"] = *proof;
    }
  return compared;
}

}  // namespace sightline::app
