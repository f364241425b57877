#include "table_maker.h"

#include "../support/files.h"
#include "tables.h"

#include <sightline/io/binary.h>
#include <sightline/io/file.h>

#include <algorithm>
#include <bit>
#include <system_error>
#include <utility>

namespace sightline::app {

namespace fs = std::filesystem;

Table_maker::Table_maker(const Pvs_arguments& arguments, const Division& division, const Polygon_soup& soup,
                         const Level_cells& level, const Time_limit& limit)
    : arguments_(arguments), level_(level), limit_(limit), faces_(soup.face_count()), search_(level, options()) {
  question_ = question_of(soup, division, arguments.outside, arguments.cells_too);
  if (arguments.cells_too) cell_search_.emplace(level, options());
  const std::vector<char> asked = asked_cells(level, arguments.outside);
  asked_.assign(asked.begin(), asked.end());
}

static bool is_decided(const Visibility_table& table) {
  return count_of(table, &Visibility_table::Row::undecided) == 0 &&
         count_of(table, &Visibility_table::Row::cells_undecided) == 0;
}

Visibility_table Table_maker::make_in_blocks(const Shard& own, Ranks& ranks) {
  // 1. What was made before: all, or some blocks.
  const bool keep = arguments_.resume && ranks.is_first();
  std::optional<Visibility_table> whole = keep ? kept(arguments_.out, own) : std::nullopt;
  if (whole && !is_decided(*whole)) whole.reset();
  const fs::path folder = keep ? kept_folder() : fs::path();
  std::vector<Visibility_table> parts(table_blocks);
  std::vector<std::string> names;
  std::vector<std::uint32_t> missing;
  const auto shard_of_block = [&](std::uint32_t b) {
    return Shard{own.shard + own.shards * b, own.shards * table_blocks};
  };
  for (std::uint32_t b = 0; b < table_blocks; ++b) {
    const auto [shard, shards] = shard_of_block(b);
    names.push_back((folder / fmt::format("{}-of-{}.pvs", shard, shards)).string());
    if (keep) blocks_.push_back(names.back());
    if (whole) continue;
    std::optional<Visibility_table> before = keep ? kept(names[b], {shard, shards}) : std::nullopt;
    if (before) parts[b] = *std::move(before);
    else missing.push_back(b);
  }
  blocks_kept_ = table_blocks - static_cast<std::uint32_t>(missing.size());
  block_count_ = blocks_left_ = missing.size();

  // 2. The others.
  ranks.share(
      fmt::format("{}, shard {}/{}", question_, own.shard, own.shards), missing,
      [&](std::uint32_t b) { return bytes_of(part(shard_of_block(b))); },
      [&](std::uint32_t b, const std::string& answer) {
        parts[b] = counted(read_part(names[b], answer));
        --blocks_left_;
        if (keep && is_decided(parts[b])) write_bytes(names[b], table_bytes(parts[b]));  // else it is asked again
      },
      [this](std::size_t done, std::size_t all) { progress_(done, all); });
  if (whole) return *std::move(whole);
  return ranks.is_first() ? joined(parts, names) : Visibility_table{};
}

void Table_maker::remove_kept() const {
  std::error_code error;
  const fs::path folder = arguments_.out + ".parts";
  std::vector<fs::path> own;  // blocks, and what was begun of them
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (std::any_of(blocks_.begin(), blocks_.end(), [&](const fs::path& block) {
          return at->path().filename().string().starts_with(block.filename().string());
        }))
      own.push_back(at->path());
  for (const fs::path& file : own) fs::remove(file, error);
  fs::remove(folder, error);  // unless something else is in it
}

/// Each number below `count` that is the shard's.
static std::vector<bool> each_of(std::size_t count, const Shard& own) {
  std::vector<bool> found(count);
  for (std::size_t k = own.shard; k < count; k += own.shards) found[k] = true;
  return found;
}

Table_maker::Part Table_maker::part(const Shard& own) {
  const auto [shard, shards] = own;
  const Pvs pvs = search_.ask(shard, shards);
  Part part{{question_, std::vector<bool>(level_.cells().size()), each_of(faces_, own), {}}, {pvs.counters, {}}};
  for (Cell_id c = 0; c < level_.cells().size(); ++c)
    if (pvs.is_asked[c] != 0) {
      part.table.cells[c] = true;
      part.table.rows.push_back({pvs.visible[c], pvs.undecided[c]});
    }
  if (cell_search_) add_cells(part, shard, shards);
  return part;
}

Visibility_table Table_maker::counted(Part part) {
  counts_.faces += part.counts.faces;
  counts_.cells += part.counts.cells;
  counts_.cell_seconds += part.counts.cell_seconds;
  return std::move(part.table);
}

std::string Table_maker::bytes_of(const Part& part) {
  std::string bytes;
  store_counters(bytes, part.counts.faces);
  store_counters(bytes, part.counts.cells);
  store(bytes, part.counts.cell_seconds);
  return bytes + table_bytes(part.table);
}

Table_maker::Part Table_maker::read_part(const std::string& name, std::string_view bytes) {
  Part part;
  load_counters(bytes, part.counts.faces);
  load_counters(bytes, part.counts.cells);
  part.counts.cell_seconds = load<double>(bytes, 0, std::endian::little);
  bytes.remove_prefix(sizeof(double));
  part.table = read_table({name, bytes});
  return part;
}

Pvs_options Table_maker::options() {
  Pvs_options options;
  options.outside = arguments_.outside;
  options.threads = arguments_.common.threads;
  options.search.seed = arguments_.common.seed;
  options.progress = [this](std::size_t done, std::size_t all) {
    progress_((block_count_ - blocks_left_) * all + done, block_count_ * all);
  };
  options.search.out_of_time = limit_.end();
  return options;
}

void Table_maker::add_cells(Part& part, std::uint32_t shard, std::uint32_t shards) {
  const Stopwatch watch;
  const Cell_pvs pvs = cell_search_->ask(shard, shards);
  part.counts.cells = pvs.counters;
  Visibility_table& table = part.table;
  table.lower_cells = each_of(table.cells.size(), {shard, shards});
  std::size_t r = 0;
  for (Cell_id c = 0; c < table.cells.size(); ++c) {
    if (!table.cells[c]) continue;
    table.rows[r].cells = pvs.visible[c];
    table.rows[r++].cells_undecided = pvs.undecided[c];
  }
  part.counts.cell_seconds = watch.seconds();
}

fs::path Table_maker::kept_folder() const {
  const fs::path folder = arguments_.out + ".parts";
  make_folder(folder, "another --out");
  return folder;
}

std::optional<Visibility_table> Table_maker::kept(const fs::path& path, const Shard& own) const {
  if (!fs::is_regular_file(path)) return std::nullopt;
  try {
    const std::string bytes = read_own_bytes(path);
    Visibility_table table = read_table({path.string(), bytes});
    // It is a block of this table, of its cells and of this share of its faces; else it is asked again.
    if (table.question != question_ || table.cells != asked_) return std::nullopt;
    if (table.faces == each_of(faces_, own) &&
        table.lower_cells == (cell_search_ ? each_of(table.cells.size(), own) : std::vector<bool>()))
      return table;
  } catch (const Input_error&) {
  }
  return std::nullopt;
}

}  // namespace sightline::app
