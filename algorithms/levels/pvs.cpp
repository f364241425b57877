#include <sightline/algorithms/levels/pvs.h>

#include <sightline/algorithms/levels/ways.h>
#include <sightline/algorithms/weak_visibility/search/line_search.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/time_limit.h>

#include <algorithm>
#include <atomic>
#include <utility>

namespace sightline {
namespace levels_detail {

class Pvs_maker {
 public:
  Pvs_maker(const Level_cells& level, Pvs_options options)
      : level_(level),
        options_(std::move(options)),
        occluders_(level.scene()),
        ways_(level, occluders_, options_.outside, options_.search.out_of_time) {
    find_starts();
  }

  Pvs make(std::uint32_t shard, std::uint32_t shards) const {
    Pvs pvs;
    pvs.is_asked = ways_.is_asked();
    const auto is_mine = [&](Face_id face) { return face % shards == shard; };
    struct Column {
      std::vector<Cell_id> visible, undecided;
      Pvs_counters counters;
    };
    std::vector<Column> columns(faces_.size());
    std::atomic<std::size_t> done{0};
    run_with_threads(options_.threads, [&] {
      parallel_for(faces_.size(), [&](std::size_t f) {
        if (is_mine(faces_[f].face)) columns[f].counters = flood(faces_[f], columns[f].visible, columns[f].undecided);
        if (options_.progress) options_.progress(++done, faces_.size());
      });
    });
    pvs.visible.resize(level_.cells().size());
    pvs.undecided.resize(level_.cells().size());
    Pvs_counters& c = pvs.counters;
    c.cells = ways_.cells_asked();
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      for (const Cell_id cell : columns[f].visible) pvs.visible[cell].push_back(faces_[f].face);
      for (const Cell_id cell : columns[f].undecided) pvs.undecided[cell].push_back(faces_[f].face);
      const Pvs_counters& own = columns[f].counters;
      if (is_mine(faces_[f].face)) c.pairs += c.cells;
      c.visible += columns[f].visible.size();
      c.undecided += columns[f].undecided.size();
      c.within += own.within;
      c.extended += own.extended;
      c.searched += own.searched;
      c.hidden += own.hidden;
      c.unreached += own.unreached;
      c.by_events += own.by_events;
      c.search += own.search;
    }
    c.faces = faces_.size();
    return pvs;
  }

 private:
  struct Target {
    Face_id face;
    std::vector<std::uint32_t> pieces;
    std::vector<Cell_id> starts;  // cells that it looks into
  };
  /// A line along which the face is seen: from a point of a way, and on its way back to there from inside a cell.
  struct Sightline {
    Way_line line;
    Cell_id cell;
  };

  /// The faces that look into cells that are asked about.
  void find_starts() {
    const std::vector<Piece>& pieces = level_.scene().pieces();
    std::vector<std::vector<Cell_id>> starts(level_.scene().counters().faces_read);
    for (Cell_id c = 0; c < level_.cells().size(); ++c)
      if (ways_.is_asked()[c] != 0)
        for (const Face_id face : level_.cells()[c].faces) starts[face].push_back(c);
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
      const Face_id face = pieces[i].face;
      if (starts[face].empty()) continue;
      if (faces_.empty() || faces_.back().face != face) faces_.push_back({face, {}, starts[face]});
      faces_.back().pieces.push_back(i);
    }
  }

  bool out_of_time() const { return has_run_out(options_.search.out_of_time); }

  /// All cells that see a face, outwards from where it is. Once out of time, what is not visible is undecided.
  Pvs_counters flood(const Target& target, std::vector<Cell_id>& visible, std::vector<Cell_id>& undecided) const {
    Pvs_counters counters;
    enum class Known : char { nothing, is_hidden, is_undecided, is_visible };
    std::vector<Known> known(level_.cells().size(), Known::nothing);
    std::vector<Sightline> sightlines;
    std::vector<Cell_id> waiting = target.starts;
    for (const Cell_id cell : waiting) known[cell] = Known::is_visible;
    counters.within = waiting.size();
    bool is_over = !ways_.is_whole();
    for (std::size_t next = 0; next < waiting.size() && !is_over; ++next) {
      for (const std::size_t w : ways_.into(waiting[next])) {
        const Way& way = ways_[w];
        Known& of_cell = known[way.from];
        if (of_cell == Known::is_visible) continue;
        if (is_over = out_of_time(); is_over) break;
        const Weak_status found = look_through(way, target, sightlines, counters);
        if (found == Weak_status::hidden) {
          of_cell = std::max(of_cell, Known::is_hidden);
          continue;
        }
        if (of_cell < Known::is_undecided) waiting.push_back(way.from);
        of_cell = found == Weak_status::visible ? Known::is_visible : Known::is_undecided;
      }
    }
    for (Cell_id c = 0; c < known.size(); ++c) {
      if (is_over && ways_.is_asked()[c] != 0 && known[c] != Known::is_visible) known[c] = Known::is_undecided;
      if (known[c] == Known::is_visible) visible.push_back(c);
      if (known[c] == Known::is_undecided) undecided.push_back(c);
      counters.unreached += known[c] == Known::nothing && ways_.is_asked()[c] != 0;
    }
    return counters;
  }

  Weak_status look_through(const Way& way, const Target& target, std::vector<Sightline>& sightlines,
                           Pvs_counters& counters) const {
    // 1. What is seen through the next way is seen from this one, if the sightline made longer comes through it.
    for (Sightline& sightline : sightlines)
      if (sightline.cell == way.to && comes_through(way, sightline.line)) {
        sightline.cell = way.from;
        ++counters.extended;
        return Weak_status::visible;
      }

    // 2. A search.
    ++counters.searched;
    Weak_status status = Weak_status::hidden;
    for (const std::uint32_t piece : target.pieces) {
      const Weak_answer answer = Line_search(occluders_, way.source.polygon, way.source.plane,
                                             occluders_.polygon(piece), piece, options_.search)
                                     .run(counters.search);
      if (answer.status == Weak_status::visible) {
        sightlines.push_back({{answer.sightline[0].near, answer.sightline[1].near}, way.from});
        return Weak_status::visible;
      }
      if (answer.status == Weak_status::undecided) status = Weak_status::undecided;
    }

    // 3. What that leaves open.
    if (status == Weak_status::undecided && options_.event_edges > 0) {
      status = visible_at_any_cost(occluders_, way.source, target.face, options_).status;
      counters.by_events += status != Weak_status::undecided;
    }
    counters.hidden += status == Weak_status::hidden;
    return status;
  }

  const Level_cells& level_;
  Pvs_options options_;
  Occluders occluders_;
  Ways ways_;
  std::vector<Target> faces_;
};

}  // namespace levels_detail

using levels_detail::Pvs_maker;

std::vector<char> regions_with_a_way_out(const Level_cells& level) {
  std::vector<char> has_way_out(level.counters().regions, 0);
  for (const Level_cell& cell : level.cells())
    if (cell.is_outside) has_way_out[cell.region] = 1;
  return has_way_out;
}

std::vector<char> asked_cells(const Level_cells& level, bool outside) {
  const std::vector<Level_cell>& cells = level.cells();
  const std::vector<char> has_way_out = regions_with_a_way_out(level);
  const auto is_inside = [&](const Level_cell& cell) { return !cell.is_solid && has_way_out[cell.region] == 0; };
  const bool all = outside || std::none_of(cells.begin(), cells.end(), is_inside);
  std::vector<char> asked;
  for (const Level_cell& cell : cells) asked.push_back(all ? !cell.is_solid : is_inside(cell));
  return asked;
}

std::vector<std::vector<Exact_point>> portals_of(const Level_cells& level, Cell_id cell) {
  std::vector<std::vector<Exact_point>> portals;
  for (const std::uint32_t w : level.cells()[cell].walls)
    for (const std::vector<std::uint32_t>& part : level.walls()[w].open)
      portals.push_back(levels_detail::looking_from(level, level.walls()[w], part, cell));
  return portals;
}

Pvs potentially_visible(const Level_cells& level, const Pvs_options& options) {
  return Pvs_search(level, options).ask(0, 1);
}

Pvs_search::Pvs_search(const Level_cells& level, Pvs_options options)
    : maker_(std::make_unique<Pvs_maker>(level, std::move(options))) {}
Pvs_search::~Pvs_search() = default;
Pvs Pvs_search::ask(std::uint32_t shard, std::uint32_t shards) const { return maker_->make(shard, shards); }

}  // namespace sightline
