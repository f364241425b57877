// sightline pvs: for each cell of a level the faces, and the cells, that are visible from it, as a table, with
// certificates, in parts; sightline merge: parts together.

#include "methods/methods.h"
#include "methods/weak.h"
#include "support/drawing.h"
#include "support/leaves.h"
#include "support/page.h"
#include "support/picture.h"
#include "support/ranks.h"
#include "support/shard.h"

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/algorithms/levels/pvs.h>
#include <sightline/algorithms/levels/stated_cell.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/io/binary.h>
#include <sightline/io/file.h>
#include <sightline/io/visibility_table.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

namespace sightline::app {

namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t blocks = 64;  // parts that --resume saves what is done in, and that processes share

using Row = Visibility_table::Row;

struct Pvs_arguments {
  Common common;
  View_arguments view;
  unsigned candidates = 5;
  std::string out, shard, svg, html, eye, obj, mesh, certificates;
  bool outside = false, resume = false, cells_too = false;
  Division_arguments division;
  std::vector<std::uint32_t> show;
};

/// What the cells of a box, a volume or a convex region see, together.
struct Group_row {
  std::uint32_t number;
  std::vector<Cell_id> cells;
  std::vector<Face_id> visible, undecided;  // ascending; what one cell sees is undecided of no group
};

/// Of groups that have cells which are asked about, by number.
std::vector<Group_row> rows_of_groups(const std::vector<std::uint32_t>& groups, const Visibility_table& table) {
  std::map<std::uint32_t, Group_row> rows;
  for (Cell_id cell = 0; cell < groups.size(); ++cell) {
    const Row* const seen = table.row_of(cell);
    if (seen == nullptr || groups[cell] == no_cell) continue;
    Group_row& row = rows.try_emplace(groups[cell], Group_row{groups[cell], {}, {}, {}}).first->second;
    row.cells.push_back(cell);
    row.visible.insert(row.visible.end(), seen->visible.begin(), seen->visible.end());
    row.undecided.insert(row.undecided.end(), seen->undecided.begin(), seen->undecided.end());
  }
  std::vector<Group_row> list;
  for (auto& [number, row] : rows) {
    for (std::vector<Face_id>* faces : {&row.visible, &row.undecided}) {
      std::sort(faces->begin(), faces->end());
      faces->erase(std::unique(faces->begin(), faces->end()), faces->end());
    }
    std::erase_if(row.undecided,
                  [&](Face_id f) { return std::binary_search(row.visible.begin(), row.visible.end(), f); });
    list.push_back(std::move(row));
  }
  return list;
}

/// What JSON and people call the groups of a division; nothing where there are none.
struct Group_names {
  const char *one, *all, *words;
};
std::optional<Group_names> names_of(Division::Kind kind) {
  switch (kind) {
    case Division::Kind::boxes: return Group_names{"box", "boxes", "boxes"};
    case Division::Kind::volumes: return Group_names{"volume", "volumes", "volumes"};
    case Division::Kind::regions: return Group_names{"convex_region", "convex_regions", "convex regions"};
    case Division::Kind::none:
    case Division::Kind::leaves: break;
  }
  return std::nullopt;
}

Json groups_json(const std::vector<Group_row>& rows, const Division& division, const Group_names& names) {
  Json list = Json::array();
  for (const Group_row& row : rows) {
    Json& json = list.emplace_back();
    if (division.kind != Division::Kind::boxes) json[names.one] = row.number;
    else {
      const auto [x, y, z] = division.counts;
      json[names.one] = {row.number % x, row.number / x % y, row.number / x / y};
    }
    json.update({{"cells", row.cells}, {"visible", row.visible}, {"undecided", row.undecided}});
  }
  return list;
}

/// The cells of a level. Errors: Out_of_budget: there is no table without them.
Level_cells cells_of(const Pvs_arguments& arguments, const Polygon_soup& soup, Space_tree tree) {
  Progress progress("dividing");
  Cell_options options;
  options.candidates = arguments.candidates;
  options.seed = arguments.common.seed;
  options.threads = arguments.common.threads;
  options.tree = std::move(tree);
  options.progress = arguments.common.within_budget([&](std::size_t done, std::size_t all) { progress(done, all); });
  return Level_cells(soup, options);
}

/// Whether the budget is over, for what then leaves the rest undecided; empty: there is none.
std::function<bool()> out_of_time(const Common& common, const Stopwatch& watch) {
  if (common.budget <= 0) return {};
  return [&common, &watch] { return watch.seconds() > common.budget; };
}

/// The table of a level that a command line asks for, and its parts.
class Table_maker {
 public:
  /// Pre: `watch` runs since the question was asked, and outlives the maker, as the other things do.
  Table_maker(const Pvs_arguments& arguments, const std::string& division, const Polygon_soup& soup,
              const Level_cells& level, const Stopwatch& watch)
      : arguments_(arguments), level_(level), watch_(watch), faces_(soup.face_count()), search_(level, options()) {
    question_ = fmt::format("scene {:016x}, candidates {}, seed {}{}{}{}", fingerprint(soup), arguments.candidates,
                            arguments.common.seed, arguments.outside ? ", outside" : "", division,
                            arguments.cells_too ? ", cells too" : "");
    if (arguments.cells_too) cell_search_.emplace(level, options());
  }

  /// Of all faces, and lower cells of pairs, whose id is shard modulo shards.
  Visibility_table make(const Shard& own) { return counted(part(own)); }

  /// The same in blocks, each made by whoever is free of the processes that share the work, and with --resume kept in a
  /// folder beside the output until all are there. In the first process; in others nothing.
  Visibility_table make_in_blocks(const Shard& own, Ranks& ranks) {
    // 1. What was made before.
    const bool keep = arguments_.resume && ranks.is_first();
    const fs::path folder = keep ? kept_folder() : fs::path();
    std::vector<Visibility_table> parts(blocks);
    std::vector<std::string> names;
    std::vector<std::uint32_t> missing;
    const auto shard_of_block = [&](std::uint32_t b) { return Shard{own.shard + own.shards * b, own.shards * blocks}; };
    for (std::uint32_t b = 0; b < blocks; ++b) {
      const auto [shard, shards] = shard_of_block(b);
      names.push_back((folder / fmt::format("{}-of-{}.pvs", shard, shards)).string());
      std::optional<Visibility_table> before = keep ? kept(names[b]) : std::nullopt;
      if (before) parts[b] = *std::move(before);
      else missing.push_back(b);
    }
    blocks_kept_ = blocks - static_cast<std::uint32_t>(missing.size());
    block_count_ = blocks_left_ = missing.size();

    // 2. The others.
    ranks.share(
        fmt::format("{}, shard {}/{}", question_, own.shard, own.shards), missing,
        [&](std::uint32_t b) { return bytes_of(part(shard_of_block(b))); },
        [&](std::uint32_t b, const std::string& answer) {
          parts[b] = counted(read_part(names[b], answer));
          --blocks_left_;
          const bool whole = std::all_of(parts[b].rows.begin(), parts[b].rows.end(), [](const Row& row) {
            return row.undecided.empty() && row.cells_undecided.empty();
          });
          if (keep && whole) write_bytes(names[b], table_bytes(parts[b]));  // what time left open is asked again
        });
    return ranks.is_first() ? joined(parts, names) : Visibility_table{};
  }
  /// To be called when the table is written, and nothing is undecided: an end before that would lose what is kept.
  void remove_kept() const {
    std::error_code error;
    fs::remove_all(arguments_.out + ".parts", error);
  }
  void clear() { progress_.clear(); }
  const Pvs_counters& counters() const { return counts_.faces; }
  const Cell_pvs_counters& cell_counters() const { return counts_.cells; }
  double cell_seconds() const { return counts_.cell_seconds; }
  std::uint32_t blocks_kept() const { return blocks_kept_; }

 private:
  struct Counts {
    Pvs_counters faces;
    Cell_pvs_counters cells;
    double cell_seconds = 0;
  };
  struct Part {
    Visibility_table table;
    Counts counts;
  };

  Part part(const Shard& own) {
    const auto [shard, shards] = own;
    const Pvs pvs = search_.ask(shard, shards);
    Part part{{question_, std::vector<bool>(level_.cells().size()), std::vector<bool>(faces_), {}}, {pvs.counters, {}}};
    for (std::size_t f = shard; f < faces_; f += shards) part.table.faces[f] = true;
    for (Cell_id c = 0; c < level_.cells().size(); ++c)
      if (pvs.is_asked[c] != 0) {
        part.table.cells[c] = true;
        part.table.rows.push_back({pvs.visible[c], pvs.undecided[c]});
      }
    if (cell_search_) add_cells(part, shard, shards);
    return part;
  }
  Visibility_table counted(Part part) {
    counts_.faces += part.counts.faces;
    counts_.cells += part.counts.cells;
    counts_.cell_seconds += part.counts.cell_seconds;
    return std::move(part.table);
  }

  /// A part as a message: its counters, then its table.
  static std::string bytes_of(const Part& part) {
    std::string bytes;
    store_counters(bytes, part.counts.faces);
    store_counters(bytes, part.counts.cells);
    store(bytes, part.counts.cell_seconds);
    return bytes + table_bytes(part.table);
  }
  static Part read_part(const std::string& name, std::string_view bytes) {
    Part part;
    load_counters(bytes, part.counts.faces);
    load_counters(bytes, part.counts.cells);
    part.counts.cell_seconds = load<double>(bytes, 0, std::endian::little);
    bytes.remove_prefix(sizeof(double));
    part.table = read_table({name, bytes});
    return part;
  }

  Pvs_options options() {
    Pvs_options options;
    options.outside = arguments_.outside;
    options.threads = arguments_.common.threads;
    options.search.seed = arguments_.common.seed;
    options.progress = [this](std::size_t done, std::size_t all) {
      progress_((block_count_ - blocks_left_) * all + done, block_count_ * all);
    };
    options.search.out_of_time = out_of_time(arguments_.common, watch_);
    return options;
  }

  /// Of pairs of cells whose lower one is shard modulo shards.
  void add_cells(Part& part, std::uint32_t shard, std::uint32_t shards) {
    const Stopwatch watch;
    const Cell_pvs pvs = cell_search_->ask(shard, shards);
    part.counts.cells = pvs.counters;
    Visibility_table& table = part.table;
    table.lower_cells.resize(table.cells.size());
    for (std::size_t c = shard; c < table.cells.size(); c += shards) table.lower_cells[c] = true;
    std::size_t r = 0;
    for (Cell_id c = 0; c < table.cells.size(); ++c) {
      if (!table.cells[c]) continue;
      table.rows[r].cells = pvs.visible[c];
      table.rows[r++].cells_undecided = pvs.undecided[c];
    }
    part.counts.cell_seconds = watch.seconds();
  }

  /// Where parts are kept. Errors: std::runtime_error where it cannot be made.
  fs::path kept_folder() const {
    const fs::path folder = arguments_.out + ".parts";
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
      throw std::runtime_error(folder.string() + ": cannot be made (" + error.message() + "); name another --out");
    return folder;
  }
  /// A part that was made before; nothing where there is none, or it is of another question.
  std::optional<Visibility_table> kept(const fs::path& path) const {
    if (!fs::exists(path)) return std::nullopt;
    try {
      const std::string bytes = read_bytes(path);
      Visibility_table table = read_table({path.string(), bytes});
      if (table.question == question_) return table;
    } catch (const Input_error&) {
    }
    return std::nullopt;
  }
  const Pvs_arguments& arguments_;
  const Level_cells& level_;
  const Stopwatch& watch_;
  Progress progress_{"looking"};
  std::size_t faces_;
  Pvs_search search_;
  std::optional<Cell_pvs_search> cell_search_;
  std::string question_;
  Counts counts_;
  std::uint32_t blocks_kept_ = 0;
  std::size_t block_count_ = 1, blocks_left_ = 1;
};

Json table_json(const Visibility_table& table) {
  Json cells = Json::array();
  std::size_t r = 0;
  for (std::size_t c = 0; c < table.cells.size(); ++c) {
    if (!table.cells[c]) continue;
    const Row& row = table.rows[r++];
    cells.push_back({{"cell", c}, {"visible", row.visible}, {"undecided", row.undecided}});
    if (table.has_cells()) cells.back().update({{"cells", row.cells}, {"cells_undecided", row.cells_undecided}});
  }
  return {{"format", table.has_cells() ? "sightline pvs 2" : "sightline pvs 1"},
          {"question", table.question},
          {"cells", std::move(cells)}};
}

std::string table_csv(const Visibility_table& table) {
  std::string text = table.has_cells() ? "cell,kind,number,state\n" : "cell,face,state\n";
  std::size_t r = 0;
  for (std::size_t c = 0; c < table.cells.size(); ++c) {
    if (!table.cells[c]) continue;
    const Row& row = table.rows[r++];
    const auto add = [&](const char* kind, const std::vector<std::uint32_t>& numbers, const char* state) {
      for (const std::uint32_t number : numbers) text += fmt::format("{},{}{},{}\n", c, kind, number, state);
    };
    add(table.has_cells() ? "face," : "", row.visible, "visible");
    add(table.has_cells() ? "face," : "", row.undecided, "undecided");
    add("cell,", row.cells, "visible");
    add("cell,", row.cells_undecided, "undecided");
  }
  return text;
}

void write_table(const std::string& out, const Visibility_table& table) {
  write_file(out, out.ends_with(".json")  ? to_text(table_json(table)) + "\n"
                  : out.ends_with(".csv") ? table_csv(table)
                                          : table_bytes(table));
}

/// The scene's pieces in groups "visible", "hidden" and "undecided", and cells in groups of their own.
Grouped_polygons drawing_of(const Level_cells& level, const Visibility_table& table,
                            const std::vector<Cell_id>& cells) {
  const Scene& scene = level.scene();
  Grouped_polygons polygons;
  const std::uint32_t hidden = polygons.add_group("hidden", drawing_colours::hidden),
                      visible = polygons.add_group("visible", drawing_colours::seen),
                      undecided = polygons.add_group("undecided", drawing_colours::open);
  std::vector<std::uint32_t> groups(scene.counters().faces_read, hidden);
  for (const bool sees : {false, true})
    for (const Cell_id cell : cells)
      for (const Face_id face : sees ? table.row_of(cell)->visible : table.row_of(cell)->undecided)
        groups[face] = sees ? visible : undecided;
  add_pieces(polygons, scene, [&](std::uint32_t piece) { return groups[scene.pieces()[piece].face]; });
  for (const Cell_id cell : cells) {
    const std::uint32_t group = polygons.add_group(fmt::format("cell-{}", cell), drawing_colours::source);
    for (const std::uint32_t w : level.cells()[cell].walls)
      polygons.add_polygon(group, Grouped_polygons::no_face, level.polygon(level.walls()[w].corners));
  }
  return polygons;
}

/// The faces that look into cells that are asked about, from their fronts, so that one looks into rooms, and the cells.
void draw(const Pvs_arguments& arguments, const Polygon_soup& soup, const Level_cells& level,
          const Visibility_table& table) {
  // 1. The faces of rooms, and what is known of them.
  std::vector<char> seen(soup.face_count(), 0);  // 1: hidden, 2: undecided, 3: visible
  for (Cell_id cell = 0; cell < table.cells.size(); ++cell)
    if (table.cells[cell])
      for (const Face_id face : level.cells()[cell].faces) seen[face] = 1;
  for (const Cell_id cell : arguments.show) {
    for (const Face_id face : table.row_of(cell)->undecided) seen[face] = std::max<char>(seen[face], 2);
    for (const Face_id face : table.row_of(cell)->visible) seen[face] = 3;
  }
  std::vector<Face_id> shown;
  for (Face_id face = 0; face < seen.size(); ++face)
    if (seen[face] != 0) shown.push_back(face);
  const Polygon_soup rooms = generate::with_faces(soup, shown);
  Scene scene(rooms);

  // 2. From above, or from where one asks for, farthest first.
  constexpr double room_for_the_legend = 36;
  const Exact_point eye = eye_of(arguments.eye, scene);
  std::vector<Exact_point> corners;
  for (const Piece& piece : scene.pieces())
    for (const Piece_corner& corner : scene.corners(piece)) corners.push_back(scene.position(corner.point));
  const View view = arguments.view.view(eye, scene, corners, room_for_the_legend);
  Task task;
  task.eye = eye;
  task.bsp.threads = arguments.common.threads;
  task.near = near_plane(view, scene);
  std::vector<Drawn> drawn = run_method("exact", scene, task).drawn;
  std::erase_if(drawn, [](const Drawn& item) { return item.side != CGAL::POSITIVE; });
  Svg svg = empty_picture(view);
  paint(svg, view, drawn, true, [&](const Drawn& item, double shade) {
    const Face_id face = shown[item.fragment.face];
    const auto [hue, strength, light] = seen[face] == 3   ? std::tuple(38, 85, 62)
                                        : seen[face] == 2 ? std::tuple(290, 60, 55)
                                                          : std::tuple(215, 12, 60);
    return Look{fmt::format("hsl({},{}%,{:.0f}%)", hue, strength, light + 14 * shade),
                fmt::format("face {}: {}", face,
                            seen[face] == 3   ? "visible"
                            : seen[face] == 2 ? "undecided"
                                              : "hidden")};
  });

  // 3. The cells that look, in outline.
  for (const Cell_id cell : arguments.show)
    for (const std::uint32_t w : level.cells()[cell].walls) {
      std::vector<Flat_point> outline;
      for (const Exact_point& p : level.polygon(level.walls()[w].corners)) outline.push_back(projected(view, p));
      svg.polygon(std::move(outline), "#d0204020", "#d02040", 1.6, fmt::format("cell-{}-{}", cell, w),
                  fmt::format("cell {}", cell));
    }
  svg.label(12, 22, 14, "orange: visible, grey: hidden, violet: undecided, red: the cell that looks", "start",
            ink_on(view.background));
  write_file(arguments.svg, svg.text());
}

/// The cells that are asked about, those of --show first, and what each sees.
void write_page(const Pvs_arguments& arguments, const Level_cells& level, const Visibility_table& table) {
  Page page("pvs", level.scene());
  page.add_fact("faces", fmt::format("{}", level.scene().counters().faces));
  page.add_fact("cells", fmt::format("{} of {} are asked about", table.rows.size(), table.cells.size()));
  for (const auto& [name, role] : {std::pair("visible", "seen"), {"hidden", "hidden"}, {"undecided", "open"}})
    page.add_group(name, role);
  page.add_pieces(level.scene());
  std::vector<Cell_id> cells = arguments.show;
  for (Cell_id cell = 0; cell < table.cells.size(); ++cell)
    if (table.cells[cell] && std::find(arguments.show.begin(), arguments.show.end(), cell) == arguments.show.end())
      cells.push_back(cell);
  constexpr std::size_t most_bytes = 500000;
  std::size_t bytes = 0;
  Json list = Json::array();
  for (const Cell_id cell : cells) {
    const Visibility_table::Row& row = *table.row_of(cell);
    std::vector<float> ends;  // of the sides of its walls
    for (const std::uint32_t w : level.cells()[cell].walls)
      page.append_sides(ends, level.polygon(level.walls()[w].corners));
    bytes += 160 + 6 * ends.size() + 4 * (row.visible.size() + row.undecided.size());
    if (bytes > most_bytes) {
      page.add_note(fmt::format("{} of {} cells are shown: --show CELL, which may be repeated, chooses", list.size(),
                                cells.size()));
      break;
    }
    list.push_back({{"cell", cell},
                    {"inside", Page::text(level.inside(cell))},
                    {"visible", packed(row.visible)},
                    {"undecided", packed(row.undecided)},
                    {"walls", packed(ends)}});
  }
  page.more()["cells"] = std::move(list);
  std::set<std::uint32_t> rooms;  // the faces that look into one of them
  for (const Cell_id cell : cells) rooms.insert(level.cells()[cell].faces.begin(), level.cells()[cell].faces.end());
  page.more()["rooms"] = packed(std::vector<std::uint32_t>(rooms.begin(), rooms.end()));
  page.write(arguments.html);
}

/// A cell as what bounds it, for the index: its corners, and its walls as places of these, as seen from outside.
void state_walls(Json& entry, const Cell_statement& statement) {
  std::map<Exact_point, std::size_t> places;
  Json corners = Json::array(), walls = Json::array();
  for (const std::vector<Exact_point>& polygon : statement.walls) {
    Json& wall = walls.emplace_back(Json::array());
    for (const Exact_point& p : polygon) {
      const auto [at, is_new] = places.try_emplace(p, places.size());
      if (is_new) corners.push_back(point_json(p));
      wall.push_back(at->second);
    }
  }
  entry["corners"] = std::move(corners);
  entry["walls"] = std::move(walls);
}

/// What the portals of a cell see outwards: how many faces are undecided, as they are once the budget is over; those
/// that nothing is proved of; then the certificate.
std::string certificate_of(const Pvs_arguments& arguments, const Level_cells& level, const Occluders& occluders,
                           const Stopwatch& watch, Cell_id cell) {
  Sources sources;
  for (const std::vector<Exact_point>& portal : portals_of(level, cell)) {
    sources.polygons.push_back(weak_source(occluders, portal));
    sources.points.push_back(portal);
  }
  Weakly_visible found;
  if (!sources.polygons.empty()) {
    Weak_task task;
    task.threads = arguments.common.threads;
    task.seed = arguments.common.seed;
    task.out_of_time = out_of_time(arguments.common, watch);
    found = run_weak_method("lines", occluders, sources, task).found;
  }
  std::string bytes;
  store(bytes, static_cast<std::uint32_t>(found.undecided.size()));
  store(bytes, static_cast<std::uint32_t>(found.unproved.size()));
  for (const Face_id face : found.unproved) store(bytes, face);
  std::ostringstream certificate;
  write_certificate(certificate, weak_certificate(level.scene(), sources.points, false, found));
  return bytes + std::move(certificate).str();
}

/// A certificate for each cell that is asked about, made by whoever is free; and an index that states all cells, as the
/// table of the first process has them. Returns there whether they leave nothing undecided.
bool write_certificates(const Pvs_arguments& arguments, const Level_cells& level, const Visibility_table& table,
                        const Stopwatch& watch, Ranks& ranks) {
  const fs::path folder = arguments.certificates;
  std::error_code error;
  if (ranks.is_first()) fs::create_directories(folder, error);
  if (error)
    throw std::runtime_error(folder.string() + ": cannot be made (" + error.message() + "); name another folder");
  const Occluders occluders(level.scene());
  Progress progress("proving");
  std::vector<Cell_id> asked;
  for (Cell_id cell = 0; cell < table.cells.size(); ++cell)
    if (table.cells[cell]) asked.push_back(cell);
  std::map<Cell_id, std::vector<Face_id>> unproved;
  bool all_decided = true;
  const auto name_of = [](Cell_id cell) { return fmt::format("cell-{}.json", cell); };
  ranks.share(
      "certificates", asked, [&](Cell_id cell) { return certificate_of(arguments, level, occluders, watch, cell); },
      [&](Cell_id cell, const std::string& answer) {
        std::vector<Face_id>& faces = unproved[cell];
        progress(unproved.size(), asked.size());
        const auto number = [&](std::size_t i) { return load<std::uint32_t>(answer, 4 * i, std::endian::little); };
        all_decided = all_decided && number(0) == 0;
        faces.resize(number(1));
        for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = number(i + 2);
        write_file((folder / name_of(cell)).string(), std::string_view(answer).substr(4 * (faces.size() + 2)));
      });
  if (!ranks.is_first()) return true;
  Json index = Json::array(), rest = Json::array();
  for (Cell_id cell = 0; cell < table.cells.size(); ++cell) {
    const Cell_statement statement = stated_cell(level, cell);
    Json entry{{"cell", cell}};
    if (table.cells[cell])
      entry.update({{"within", statement.within}, {"certificate", name_of(cell)}, {"unproved", unproved[cell]}});
    state_walls((table.cells[cell] ? index : rest).emplace_back(std::move(entry)), statement);
  }
  progress.clear();
  write_file((folder / "index.json").string(), to_text({{"format", "sightline pvs certificates 3"},
                                                        {"question", table.question},
                                                        {"cells", std::move(index)},
                                                        {"rest", std::move(rest)}}) +
                                                   "\n");
  return all_decided;
}

std::size_t count_of(const Visibility_table& table, std::vector<std::uint32_t> Row::*numbers) {
  std::size_t sum = 0;
  for (const Row& row : table.rows) sum += (row.*numbers).size();
  return sum;
}
/// How much of a whole.
double percent(std::size_t part, std::size_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, whole));
}

void row_of_cells(const Cell_pvs_counters& c, std::size_t visible, std::size_t undecided) {
  row("", fmt::format("{} of two cells: {} see each other ({:.3g}%), {} undecided", c.pairs, visible,
                      percent(visible, c.pairs), undecided));
  row("",
      fmt::format("{} neighbours, {} along random lines, {} along a sightline made longer; {} searches, {} of which "
                  "found hidden, {} left to events; {} pairs were not reached",
                  c.adjacent, c.by_lines, c.extended, c.searched, c.hidden, c.by_events, c.unreached));
}

/// A copy of a compiled level with what its leaves see in the place of its own table: cells from cells alone.
Exit run_into_level(const Pvs_arguments& arguments) {
  const Common& common = arguments.common;
  if (!arguments.shard.empty() || arguments.resume || !arguments.show.empty() || !arguments.certificates.empty())
    throw Usage_error("--out FILE.bsp is about leaves alone: leave out --shard, --resume, --show and --certificates");
  if (!arguments.svg.empty() || !arguments.html.empty() || !arguments.obj.empty() || !arguments.mesh.empty())
    throw Usage_error("--out FILE.bsp draws nothing: leave out --svg, --html, --obj and --mesh, or name another --out");
  if (const Division_arguments& d = arguments.division; !d.grid.empty() || !d.volumes.empty() || d.coarse > 0)
    throw Usage_error("--out FILE.bsp is about the level's leaves: leave out --grid, --volumes and --coarse");
  const std::string bytes = compiled_level(common, "--out FILE.bsp");
  const Quake_level file = read_quake_level({common.scene, bytes});
  const Polygon_soup soup = common.read();
  const Stopwatch watch;
  const Level_cells level = cells_of(arguments, soup, space_tree(file, common.scene));
  const double cells_seconds = watch.seconds();
  Progress progress("looking");
  Pvs_options options;
  options.outside = arguments.outside;
  options.threads = common.threads;
  options.search.seed = common.seed;
  options.progress = [&](std::size_t done, std::size_t all) { progress(done, all); };
  options.search.out_of_time = out_of_time(common, watch);
  const Cell_pvs pvs = mutually_visible_cells(level, options);
  progress.clear();
  const double seconds = watch.seconds() - cells_seconds;
  const std::vector<std::vector<bool>> rows = rows_of_level(level, pvs, file);
  write_file(arguments.out, with_visibility(bytes, rows));

  std::size_t visible = 0;
  for (const std::vector<bool>& row : rows)
    visible += static_cast<std::size_t>(std::count(row.begin(), row.end(), true));
  const Cell_pvs_counters& c = pvs.counters;
  const Exit exit = c.undecided > 0 ? Exit::undecided : Exit::done;
  Json counters = counters_json(c);
  counters["cells"] = counters_json(level.counters());
  if (write_json(common, "pvs", level.scene(),
                 {{"cells", c.cells},
                  {"faces", 0},
                  {"visible", 0},
                  {"undecided", 0},
                  {"blocks_kept", 0},
                  {"pairs_of_cells", {{"visible", c.visible}, {"undecided", c.undecided}}},
                  {"leaves", {{"leaves", rows.size()}, {"visible", visible}}}},
                 std::move(counters), {{"cells", cells_seconds}, {"pvs", seconds}}))
    return exit;
  scene_rows(level.scene());
  row("cells", fmt::format("{} of {} are asked about", c.cells, level.counters().cells));
  row_of_cells(c, c.visible, c.undecided);
  row("leaves", fmt::format("{} have rows: of {} pairs, each with itself too, {} are visible", rows.size(),
                            rows.size() * rows.size(), visible));
  row("seconds", fmt::format("{:.3f} for cells, {:.3f} for what they see", cells_seconds, seconds));
  return exit;
}

Exit run_pvs(const Pvs_arguments& arguments, Ranks& ranks) {
  const Common& common = arguments.common;
  if (!ranks.is_alone() && arguments.out.ends_with(".bsp"))
    throw Usage_error("--out FILE.bsp is asked of one process: call it without mpirun");
  if (arguments.out.ends_with(".bsp")) return run_into_level(arguments);
  if (!ranks.is_alone() && common.scene == "-")
    throw Usage_error("of several processes one alone has a standard input: name a file that all can read");
  const Shard own = shard_of(arguments.shard);
  if (arguments.resume && (arguments.out.empty() || arguments.out == "-"))
    throw Usage_error("--resume keeps what is done beside an output: name it with --out FILE");
  if (own.shards > 1 && (!arguments.show.empty() || !arguments.certificates.empty()))
    throw Usage_error("a shard has some faces only: leave out --show and --certificates, or --shard");
  if (arguments.show.empty() && (!arguments.svg.empty() || !arguments.obj.empty() || !arguments.mesh.empty()))
    throw Usage_error("a picture is of what a cell sees: say which with --show CELL");
  arguments.view.check_usage(!arguments.svg.empty());
  if (arguments.svg.empty() && !arguments.eye.empty())
    throw Usage_error("--eye is the eye of the picture: add --svg FILE, or leave it out");
  const Polygon_soup soup = common.read();
  const Division division = arguments.division.division(common, soup);
  const Stopwatch watch;
  const Level_cells level = cells_of(arguments, soup, division.tree);
  const double cells_seconds = watch.seconds();

  const std::vector<char> asked = asked_cells(level, arguments.outside);
  for (const Cell_id cell : arguments.show)
    if (cell >= asked.size() || asked[cell] == 0)
      throw Usage_error(
          fmt::format("--show {}: no such cell, or one that is not asked about; `sightline cells` lists them", cell));

  Table_maker maker(arguments, division.question, soup, level, watch);
  const bool in_blocks = arguments.resume || !ranks.is_alone();
  const Visibility_table table = in_blocks ? maker.make_in_blocks(own, ranks) : maker.make(own);
  maker.clear();
  if (!ranks.is_first()) {
    if (!arguments.certificates.empty()) write_certificates(arguments, level, table, watch, ranks);
    return Exit::done;
  }
  const double seconds = watch.seconds() - cells_seconds;
  const std::size_t visible = count_of(table, &Row::visible), undecided = count_of(table, &Row::undecided),
                    cells_visible = count_of(table, &Row::cells) / 2,
                    cells_undecided = count_of(table, &Row::cells_undecided) / 2;
  if (!arguments.out.empty()) write_table(arguments.out, table);
  if (arguments.resume && undecided + cells_undecided == 0) maker.remove_kept();
  if (!arguments.svg.empty()) draw(arguments, soup, level, table);
  if (!arguments.obj.empty() || !arguments.mesh.empty())
    write_drawings(arguments.obj, arguments.mesh, drawing_of(level, table, arguments.show));
  if (!arguments.html.empty()) write_page(arguments, level, table);
  const bool all_proved = arguments.certificates.empty() || write_certificates(arguments, level, table, watch, ranks);

  const Exit exit = undecided + cells_undecided > 0 || !all_proved ? Exit::undecided : Exit::done;
  const Pvs_counters& c = maker.counters();
  const Cell_pvs_counters& of_cells = maker.cell_counters();
  Json result{{"cells", table.rows.size()},
              {"faces", std::count(table.faces.begin(), table.faces.end(), true)},
              {"visible", visible},
              {"undecided", undecided},
              {"blocks_kept", maker.blocks_kept()}};
  if (arguments.cells_too) result["pairs_of_cells"] = {{"visible", cells_visible}, {"undecided", cells_undecided}};
  Json shown = Json::array();
  for (const Cell_id cell : arguments.show) {
    const Row& seen = *table.row_of(cell);
    shown.push_back({{"cell", cell},
                     {"point", point_json(level.inside(cell))},
                     {"visible", seen.visible},
                     {"undecided", seen.undecided}});
    if (arguments.cells_too) shown.back().update({{"cells", seen.cells}, {"cells_undecided", seen.cells_undecided}});
  }
  if (!shown.empty()) result["shown"] = shown;
  const std::optional<Group_names> names = names_of(division.kind);
  std::vector<Group_row> groups;
  if (names) {
    groups = rows_of_groups(division.groups(level), table);
    result[names->all] = groups_json(groups, division, *names);
  }
  Json counters = counters_json(c);
  counters["cells"] = counters_json(level.counters());
  if (arguments.cells_too) counters["pairs_of_cells"] = counters_json(of_cells);
  if (write_json(common, "pvs", level.scene(), std::move(result), std::move(counters),
                 {{"cells", cells_seconds}, {"pvs", seconds}, {"pairs_of_cells", maker.cell_seconds()}}))
    return exit;
  scene_rows(level.scene());
  row("cells", fmt::format("{} of {} are asked about", table.rows.size(), level.counters().cells));
  row("pairs", fmt::format("{} of a cell and a face: {} visible ({:.3g}%), {} undecided", c.pairs, visible,
                           percent(visible, c.pairs), undecided));
  row("seen", fmt::format("{} within their cell, {} by a neighbour's sightline; {} searches, {} of which found hidden, "
                          "{} left to events; {} pairs were not reached",
                          c.within, c.extended, c.searched, c.hidden, c.by_events, c.unreached));
  if (arguments.cells_too) row_of_cells(of_cells, cells_visible, cells_undecided);
  if (names) {
    std::size_t pairs = 0;
    for (const Group_row& group : groups) pairs += group.visible.size();
    row(names->words, fmt::format("{} have cells that are asked about; {} pairs of one of them and a face are visible; "
                                  "--json - lists them",
                                  groups.size(), pairs));
  }
  if (arguments.resume)
    row("resumed", fmt::format("{} of {} blocks were there{}", maker.blocks_kept(), blocks,
                               undecided + cells_undecided == 0
                                   ? ""
                                   : "; those that are decided are kept, and the same command goes on from there"));
  for (const Cell_id cell : arguments.show) {
    row(fmt::format("cell {}", cell), fmt::format("sees {}", fmt::join(table.row_of(cell)->visible, " ")));
    if (arguments.cells_too) row("", fmt::format("and cells {}", fmt::join(table.row_of(cell)->cells, " ")));
  }
  row("seconds",
      fmt::format("{:.3f} for cells, {:.3f} for what they see{}", cells_seconds, seconds,
                  arguments.cells_too ? fmt::format(", {:.3f} of it for pairs of cells", maker.cell_seconds()) : ""));
  return exit;
}

// ---- Merging

struct Merge_arguments {
  std::vector<std::string> parts;
  std::string out;
};

Exit run_merge(const Merge_arguments& arguments) {
  if (arguments.out.ends_with(".bsp"))
    throw Usage_error(
        "--out: a level has a table of leaves, which parts do not hold: `pvs LEVEL --out FILE.bsp` makes it");
  std::vector<Visibility_table> parts;
  for (const std::string& file : arguments.parts) {
    const std::string bytes = read_input(file);
    parts.push_back(read_table({file, bytes}));
  }
  try {
    const Visibility_table table = merged(parts, arguments.parts);
    write_table(arguments.out, table);
    if (arguments.out != "-")
      row("merged",
          fmt::format("{} parts: {} cells, {} faces, {} pairs visible, {} undecided", parts.size(), table.rows.size(),
                      table.faces.size(), count_of(table, &Row::visible), count_of(table, &Row::undecided)));
  } catch (const Merge_error& error) {
    throw std::runtime_error(std::string("merge: ") + error.what());
  }
  return Exit::done;
}

}  // namespace

void add_pvs(Command program) {
  const Command command =
      program.add_command("pvs", "What each cell of a level can see, exactly: a table, in parts, with certificates");
  auto a = std::make_shared<Pvs_arguments>();
  a->common.add_to(command);
  command
      .add_option(
          "--out", a->out,
          "write the table: .json, .csv, or else binary; .bsp: a copy of SCENE, a compiled level, with what its "
          "leaves see in the place of its own table")
      .writes_file();
  command.add_option("--candidates", a->candidates, "face planes tried for each node of the tree of cells")
      .check(range(1, 1000))
      .show_default();
  command.add_flag("--outside", a->outside, "ask about cells too from which there is a way out of the level");
  command.add_flag("--cells-too", a->cells_too,
                   "find the pairs of cells of which some point of the one sees some point of the other, too");
  a->division.add_to(command);
  command.add_option("--show", a->show, "print what this cell sees; may be repeated");
  add_mesh_option(command, a->mesh, "faces visible, hidden, undecided from --show, and the cells,");
  command.add_option("--obj", a->obj, "the same as OBJ").writes_file().check(ending(".obj"));
  command
      .add_option("--svg", a->svg, "draw the rooms and what --show sees of them, without what has its back to the eye")
      .writes_file()
      .check(ending(".svg"));
  command.add_option("--html", a->html, "write a page to look at: click a cell, and what it sees")
      .writes_file()
      .check(ending(".html"));
  command.add_option("--eye", a->eye, "with --svg: X,Y,Z; by default a place outside the scene").check(not_empty());
  a->view.add_to(command);
  command
      .add_option("--certificates", a->certificates,
                  "write a certificate for each cell, and an index that states the cells, to this folder")
      .check(not_empty());
  command.add_option(
      "--shard", a->shard,
      "I/N: the faces, and pairs whose lower cell, are I modulo N; by default what SLURM_ARRAY_TASK_ID and "
      "_COUNT say");
  command.add_flag("--resume", a->resume, "keep blocks of faces beside --out, and do not ask again what they hold");
  command.footer(
      "Example: sightline pvs level.map --out level.pvs\n"
      "         for i in 0 1 2 3; do sightline pvs level.map --shard $i/4 --out part$i.pvs --resume & done; wait\n"
      "         sightline merge part?.pvs --out level.pvs\n"
      "         mpirun -n 3 sightline pvs level.map --threads 1 --resume --out level.pvs\n"
      "         sightline pvs level.bsp --out better.bsp\n"
      "Cells are those of `sightline cells` with the same --candidates, --seed, --leaves, --grid and --volumes. Exit "
      "code 4: pairs are undecided; in a .bsp their leaves see each other.");
  command.set_action([a] { return Ranks::together([&](Ranks& ranks) { return run_pvs(*a, ranks); }); });
}

void add_merge(Command program) {
  const Command command = program.add_command("merge", "Makes one table of the parts that `pvs --shard` wrote");
  auto a = std::make_shared<Merge_arguments>();
  command.add_option("PARTS", a->parts, "tables of one scene, with the same options").required().reads_file();
  command.add_option("--out", a->out, "write the table: .json, .csv, or else binary").required().writes_file();
  command.footer(
      "Refuses parts of other scenes or options, a face twice, and a face in none; then it says which shards "
      "to run again.");
  command.set_action([a] { return run_merge(*a); });
}

}  // namespace sightline::app
