#include <sightline/algorithms/levels/cell_pvs.h>

#include <sightline/algorithms/levels/ways.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/search/line_search.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/time_limit.h>
#include <sightline/kernel/uniform.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <utility>

namespace sightline {

using levels_detail::comes_through;
using levels_detail::Way;
using levels_detail::Way_line;
using levels_detail::Ways;

namespace {

// Random lines out of a cell: so many at once, until a turn finds no cell, or after so many turns.
constexpr std::size_t lines_at_once = 32, most_turns = 64;
// Cells whose floods go on at once, a quarter of those that ended: few, as they find again what they could be told.
constexpr std::size_t least_round = 8, most_in_round = 64;

/// A point of a polygon's inside, more often near corners than a mean of equal weights.
Triple point_within(const Near_polygon& polygon, std::mt19937_64& dice) {
  const Uniform unit(0.02, 1);
  Triple p{};
  double sum = 0;
  for (const Near_point& corner : polygon) {
    const double weight = std::pow(unit(dice), 3);
    sum += weight;
    for (std::size_t k = 0; k < 3; ++k) p[k] += weight * corner.near[k];
  }
  for (double& x : p) x /= sum;
  return p;
}

}  // namespace

class Cell_pvs_search::Maker {
 public:
  Maker(const Level_cells& level, Pvs_options options)
      : level_(level),
        options_(std::move(options)),
        occluders_(level.scene()),
        ways_(level, occluders_, options_.outside, options_.search.out_of_time),
        count_(static_cast<Cell_id>(level.cells().size())),
        columns_(count_),
        is_done_(count_) {}

  Cell_pvs make(std::uint32_t shard, std::uint32_t shards) {
    if (!ways_.is_whole()) ways_ = Ways(level_, occluders_, options_.outside, options_.search.out_of_time);
    // 1. Floods, lower cells first, in rounds: those of a round tell the later ones, and not each other, so that what
    // is searched is the same at any number of threads.
    std::vector<Cell_id> own;
    for (Cell_id c = shard; c < count_; c += shards)
      if (is_asked(c)) own.push_back(c);
    std::atomic<std::size_t> done{0};
    run_with_threads(options_.threads, [&] {
      for (std::size_t begin = 0, end = 0; begin < own.size(); begin = end) {
        end = std::min(own.size(), begin + std::clamp(begin / 4, least_round, most_in_round));
        parallel_for(end - begin, [&](std::size_t k) {
          if (!is_done_[own[begin + k]]) flood(own[begin + k]);
          if (options_.progress) options_.progress(++done, own.size());
        });
        for (std::size_t k = begin; k < end; ++k) is_done_[own[k]] = columns_[own[k]].in_time;
      }
    });

    // 2. Both halves.
    Cell_pvs pvs{
        ways_.is_asked(), std::vector<std::vector<Cell_id>>(count_), std::vector<std::vector<Cell_id>>(count_), {}};
    for (const Cell_id cell : own) {
      const Column& column = columns_[cell];
      pvs.counters += column.counters;
      for (const Cell_id other : column.visible) {
        pvs.visible[cell].push_back(other);
        pvs.visible[other].push_back(cell);
      }
      for (const Cell_id other : column.undecided) {
        pvs.undecided[cell].push_back(other);
        pvs.undecided[other].push_back(cell);
      }
    }
    for (auto* lists : {&pvs.visible, &pvs.undecided})
      for (std::vector<Cell_id>& list : *lists) std::sort(list.begin(), list.end());
    pvs.counters.cells = ways_.cells_asked();
    return pvs;
  }

  std::optional<std::array<Exact_point, 2>> sightline(Cell_id from, Cell_id to) const {
    if (!is_asked(from) || !is_asked(to) || from == to) return std::nullopt;
    // 1. Through a portal between them, from a point of the one.
    for (const std::size_t w : ways_.into(from))
      if (ways_[w].from == to) {
        const Exact_point r = middle_of(points_of(ways_[w].source.polygon)), p = level_.inside(from);
        Exact_point way;
        for (std::size_t k = 0; k < 3; ++k) way[k] = r[k] - p[k];
        return into_cells(from, to, r, r, way);
      }
    // 2. From portal to portal.
    Cell_pvs_counters counters;
    for (const std::size_t w : ways_.into(from))
      for (const std::size_t v : ways_.into(to)) {
        const Weak_answer answer = decide(Ways::back(w), Ways::back(v), counters);
        if (answer.status != Weak_status::visible) continue;
        const Exact_point r = level_.scene().position(answer.sightline[0].exact),
                          s = level_.scene().position(answer.sightline[1].exact);
        Exact_point way;
        for (std::size_t k = 0; k < 3; ++k) way[k] = s[k] - r[k];
        return into_cells(from, to, r, s, way);
      }
    return std::nullopt;
  }

 private:
  /// What a cell's flood found of the cells above it.
  struct Column {
    std::vector<Cell_id> visible, undecided;
    Cell_pvs_counters counters;
    bool in_time = true;  // or else it is asked again
  };
  enum class Known : char { nothing, is_hidden, is_undecided, is_visible, is_told_hidden };
  struct Flood {
    Cell_id cell;
    std::vector<Known> known;      // by cell
    std::vector<Cell_id> waiting;  // cells that are visible or undecided, in the order in which they were found
    Cell_pvs_counters& counters;

    /// Whether it was not known.
    bool see(Cell_id other) {
      if (known[other] == Known::is_visible) return false;
      if (known[other] != Known::is_undecided) waiting.push_back(other);
      known[other] = Known::is_visible;
      return true;
    }
  };

  bool out_of_time() const { return has_run_out(options_.search.out_of_time); }

  bool is_asked(Cell_id cell) const { return ways_.is_asked()[cell] != 0; }

  /// What floods of earlier rounds say of a pair.
  Known told(Cell_id a, Cell_id b) const {
    if (a == b) return Known::is_visible;
    if (a > b) std::swap(a, b);
    if (!is_done_[a]) return Known::nothing;
    const Column& column = columns_[a];
    if (std::binary_search(column.visible.begin(), column.visible.end(), b)) return Known::is_visible;
    const bool open = std::binary_search(column.undecided.begin(), column.undecided.end(), b);
    return open ? Known::nothing : Known::is_told_hidden;
  }

  /// All cells that see a cell, outwards from there. Once out of time, what is neither visible nor told to be hidden is
  /// undecided.
  void flood(Cell_id cell) {
    Column& column = columns_[cell] = {};  // where it was given up, it begins anew
    column.in_time = ways_.is_whole();
    Cell_pvs_counters& counters = column.counters;
    Flood flood{cell, std::vector<Known>(count_, Known::nothing), {}, counters};
    flood.see(cell);

    // 1. What is known: by lower cells, and of neighbours.
    for (Cell_id other = 0; other < cell; ++other) {
      if (!is_asked(other)) continue;
      const Known known = told(other, cell);
      counters.told += known != Known::nothing;
      if (known == Known::is_visible) flood.see(other);
      else flood.known[other] = known;
    }
    for (const std::size_t w : ways_.into(cell)) counters.adjacent += flood.see(ways_[w].from);

    // 2. Along lines, and then from cell to cell: who sees it sees it through a neighbour that does.
    see_along_lines(flood);
    for (std::size_t next = 0; next < flood.waiting.size() && column.in_time; ++next)
      for (const std::size_t w : ways_.into(flood.waiting[next])) {
        Known& of_cell = flood.known[ways_[w].from];
        if (of_cell == Known::is_visible || of_cell == Known::is_told_hidden) continue;
        if (column.in_time = !out_of_time(); !column.in_time) break;
        const Weak_status found = look_through(w, flood);
        if (found == Weak_status::hidden) of_cell = std::max(of_cell, Known::is_hidden);
        if (found != Weak_status::undecided || of_cell == Known::is_undecided) continue;
        of_cell = Known::is_undecided;
        flood.waiting.push_back(ways_[w].from);
      }

    // 3. Pairs with cells above it.
    for (Cell_id other = cell + 1; other < count_; ++other) {
      if (!is_asked(other)) continue;
      ++counters.pairs;
      Known& known = flood.known[other];
      if (!column.in_time && known != Known::is_visible && known != Known::is_told_hidden) known = Known::is_undecided;
      if (known == Known::is_visible) column.visible.push_back(other);
      if (known == Known::is_undecided) column.undecided.push_back(other);
      counters.unreached += known == Known::nothing;
    }
    if (!column.undecided.empty() && out_of_time()) column.in_time = false;  // the last search may have had too little
    counters.visible = column.visible.size();
    counters.undecided = column.undecided.size();
  }

  void see_along_lines(Flood& flood) const {
    std::mt19937_64 dice(options_.search.seed * 0x9e3779b97f4a7c15u + flood.cell);
    const std::vector<std::size_t>& first = ways_.into(flood.cell);
    for (std::size_t turn = 0; turn < most_turns && !first.empty() && !out_of_time(); ++turn) {
      const std::size_t before = flood.counters.by_lines;
      for (std::size_t k = 0; k < lines_at_once; ++k) {
        const std::size_t back = first[dice() % first.size()];
        const std::vector<std::size_t>& second = ways_.into(ways_[back].from);
        const Way &out = ways_[Ways::back(back)], &on = ways_[Ways::back(second[dice() % second.size()])];
        const Triple from = point_within(out.source.polygon, dice);
        const Triple to = point_within(on.source.polygon, dice);
        const Way_line line(from, to);
        if (!comes_through(out, line) || !comes_through(on, line)) continue;
        flood.counters.by_lines += flood.see(on.to);
        follow(line, on.to, flood, flood.counters.by_lines);
      }
      if (flood.counters.by_lines == before) return;
    }
  }

  /// Sees the cells that a line comes through beyond one that sees the flood's cell along it.
  void follow(const Way_line& line, Cell_id cell, Flood& flood, std::size_t& counter) const {
    for (bool goes_on = true; goes_on;) {
      goes_on = false;
      for (const std::size_t w : ways_.into(cell))
        if (comes_through(ways_[Ways::back(w)], line)) {
          cell = ways_[w].from;
          counter += flood.see(cell);
          goes_on = true;
          break;
        }
    }
  }

  /// Whether the flood's cell is seen through a way, into any of its portals.
  Weak_status look_through(std::size_t w, Flood& flood) const {
    const Way& way = ways_[w];
    Weak_status status = Weak_status::hidden;
    for (const std::size_t in : ways_.into(flood.cell)) {
      // 1. The cell before that portal would be seen too.
      const Cell_id before = ways_[in].from;
      if (told(way.from, before) == Known::is_told_hidden || told(way.to, before) == Known::is_told_hidden) {
        ++flood.counters.implied;
        continue;
      }

      // 2. A search, from portal to portal.
      const Weak_answer answer = decide(w, Ways::back(in), flood.counters);
      if (answer.status == Weak_status::visible) {
        flood.see(way.from);
        follow(Way_line(answer.sightline[1].near, answer.sightline[0].near), way.from, flood, flood.counters.extended);
        return Weak_status::visible;
      }
      flood.counters.hidden += answer.status == Weak_status::hidden;
      if (answer.status == Weak_status::undecided) status = Weak_status::undecided;
    }
    return status;
  }

  /// A sightline from r to s, both inside portals, made longer so that its ends are inside the cells: where it may
  /// reach a wall, half as far.
  std::array<Exact_point, 2> into_cells(Cell_id from, Cell_id to, const Exact_point& r, const Exact_point& s,
                                        const Exact_point& way) const {
    const auto longer_by = [&](const Rational& part) {
      std::array<Exact_point, 2> ends{r, s};
      for (std::size_t k = 0; k < 3; ++k) {
        ends[0][k] -= part * way[k];
        ends[1][k] += part * way[k];
      }
      return ends;
    };
    for (Rational part(1, 2);; part /= 4) {
      const std::array<Exact_point, 2> ends = longer_by(part);
      if (level_.at(ends[0]) == from && level_.at(ends[1]) == to) return longer_by(part / 2);
    }
  }

  /// Whether there is a free line between two portals, in front of both. What is undecided is asked the other way
  /// round, and then of events.
  Weak_answer decide(std::size_t from, std::size_t to, Cell_pvs_counters& counters) const {
    if (out_of_time()) return nothing_known();
    Weak_answer answer = search(from, to, counters);
    if (answer.status == Weak_status::undecided) {
      answer = search(to, from, counters);
      std::reverse(answer.sightline.begin(), answer.sightline.end());
    }
    if (answer.status == Weak_status::undecided && options_.event_edges > 0) {
      answer = by_events(from, to);
      counters.by_events += answer.status != Weak_status::undecided;
    }
    return answer;
  }
  Weak_answer search(std::size_t from, std::size_t to, Cell_pvs_counters& counters) const {
    ++counters.searched;
    const Weak_source &source = ways_[from].source, &target = ways_[to].source;
    return Line_search(occluders_, source.polygon, source.plane, target.polygon, target.plane, options_.search,
                       from * ways_.count() + to)
        .run(counters.search);
  }

  /// The same in a scene of its own, in which the portal that is looked at is a face.
  Weak_answer by_events(std::size_t from, std::size_t to) const {
    const Scene& level = level_.scene();
    Polygon_soup soup;
    const auto add = [&](const std::vector<Exact_point>& polygon) {
      std::vector<Point_id> loop;
      for (const Exact_point& p : polygon) loop.push_back(soup.add_point(p[0], p[1], p[2]));
      soup.add_face(loop);
    };
    for (const Piece& piece : level.pieces()) add(level.corner_points(piece));
    const Face_id target = static_cast<Face_id>(soup.face_count());
    add(points_of(ways_[to].source.polygon));
    const Scene scene(soup);
    const Occluders occluders(scene);
    const Weak_answer found = levels_detail::visible_at_any_cost(
        occluders, weak_source(occluders, points_of(ways_[from].source.polygon)), target, options_);
    Weak_answer answer = nothing_known();
    answer.status = found.status;
    if (found.status == Weak_status::visible)
      for (const std::size_t k : {0u, 1u})
        answer.sightline.push_back(occluders_.located(scene.position(found.sightline[k].exact)));
    return answer;
  }

  std::vector<Exact_point> points_of(const Near_polygon& polygon) const {
    std::vector<Exact_point> points;
    for (const Near_point& corner : polygon) points.push_back(level_.scene().position(corner.exact));
    return points;
  }

  const Level_cells& level_;
  Pvs_options options_;
  Occluders occluders_;
  Ways ways_;
  Cell_id count_;
  std::vector<Column> columns_;
  std::vector<bool> is_done_;
};

Cell_pvs mutually_visible_cells(const Level_cells& level, const Pvs_options& options) {
  return Cell_pvs_search(level, options).ask(0, 1);
}

std::vector<std::vector<bool>> visible_leaves(const Level_cells& level, const Cell_pvs& pvs, std::size_t leaves) {
  std::vector<std::vector<bool>> rows(leaves, std::vector<bool>(leaves));
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) rows[leaf][leaf] = true;
  for (Cell_id c = 0; c < level.cells().size(); ++c)
    for (const std::vector<Cell_id>* others : {&pvs.visible[c], &pvs.undecided[c]})
      for (const Cell_id other : *others) rows[level.cells()[c].leaf][level.cells()[other].leaf] = true;
  return rows;
}

Cell_pvs_search::Cell_pvs_search(const Level_cells& level, Pvs_options options)
    : maker_(std::make_unique<Maker>(level, std::move(options))) {}
Cell_pvs_search::~Cell_pvs_search() = default;
std::optional<std::array<Exact_point, 2>> Cell_pvs_search::sightline(Cell_id from, Cell_id to) const {
  return maker_->sightline(from, to);
}
Cell_pvs Cell_pvs_search::ask(std::uint32_t shard, std::uint32_t shards) { return maker_->make(shard, shards); }

}  // namespace sightline
