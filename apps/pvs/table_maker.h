#pragma once
// The table of `sightline pvs`: whole, as a part, or in blocks that processes share and --resume keeps.

#include "../support/ranks.h"
#include "../support/shard.h"
#include "pvs.h"

#include <sightline/algorithms/levels/pvs.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sightline::app {

/// The table of a level that a command line asks for, and its parts.
class Table_maker {
 public:
  /// Pre: `limit` began when the question was asked; the other things outlive the maker.
  Table_maker(const Pvs_arguments& arguments, const Division& division, const Polygon_soup& soup,
              const Level_cells& level, const Time_limit& limit);

  /// Of all faces, and lower cells of pairs, whose id is shard modulo shards.
  Visibility_table make(const Shard& own) { return counted(part(own)); }

  /// The same in blocks, each made by whoever is free of the processes that share the work, and with --resume kept in a
  /// folder beside the output until all are there; an output that is there already is taken as it is, where it is
  /// binary, of this question and decided. In the first process; in others nothing.
  Visibility_table make_in_blocks(const Shard& own, Ranks& ranks);
  /// To be called when the table is written, and nothing is undecided: an end before that would lose what is kept.
  void remove_kept() const;
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

  Part part(const Shard& own);
  Visibility_table counted(Part part);

  /// A part as a message: its counters, then its table.
  static std::string bytes_of(const Part& part);
  static Part read_part(const std::string& name, std::string_view bytes);

  Pvs_options options();

  /// Of pairs of cells whose lower one is shard modulo shards.
  void add_cells(Part& part, std::uint32_t shard, std::uint32_t shards);

  /// Where parts are kept. Errors: std::runtime_error where it cannot be made.
  std::filesystem::path kept_folder() const;
  /// A part that was made before; nothing where there is none, or it is of another question, of other cells, or of
  /// other faces than those of this share.
  std::optional<Visibility_table> kept(const std::filesystem::path& path, const Shard& own) const;

  const Pvs_arguments& arguments_;
  const Level_cells& level_;
  const Time_limit limit_;
  Progress progress_{"looking"};
  std::size_t faces_;
  Pvs_search search_;
  std::optional<Cell_pvs_search> cell_search_;
  std::string question_;
  std::vector<bool> asked_;  // cells
  Counts counts_;
  std::uint32_t blocks_kept_ = 0;
  std::vector<std::filesystem::path> blocks_;  // where they are kept
  std::size_t block_count_ = 1, blocks_left_ = 1;
};

}  // namespace sightline::app
