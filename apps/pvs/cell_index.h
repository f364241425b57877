#pragma once
// The index of a folder of certificates, one of each cell of a level: `pvs` and `merge` write it, `verify` reads it.

#include "../support/common.h"
#include "../support/shard.h"

#include <sightline/algorithms/verify/level_cell.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sightline::app {

/// What is known of a certificate beside it: the faces of which it proves nothing, and what its bytes add up to; no sum
/// where it leaves something undecided, so that it is to be made again.
struct Certificate_facts {
  std::vector<Face_id> unproved;
  std::optional<std::uint64_t> sum;
};

/// An entry of a cell whose certificate is such a file of the folder.
Json asked_entry(std::uint64_t cell, const Cell_statement& statement, const std::string& certificate,
                 const Certificate_facts& facts);
/// An entry of a cell that is not asked about.
Json other_entry(std::uint64_t cell, const Cell_statement& statement);

/// Writes the index of a folder; of a shard, its part of one, which says whether its certificates leave nothing
/// undecided. Errors: std::runtime_error.
void write_index(const std::filesystem::path& folder, const std::string& question, const Shard& own, bool all_decided,
                 Json cells, Json rest);

/// By cell what the part of a shard, or else the index, says of certificates, where it is there, answers that question,
/// and they leave nothing undecided.
std::map<std::uint64_t, Certificate_facts> facts_in_index(const std::filesystem::path& folder,
                                                          const std::string& question, const Shard& own);

/// Puts the parts of an index that shards wrote into one, byte by byte what one run writes, and removes them. Returns
/// whether their certificates leave nothing undecided. Errors: Input_error where one is missing, and then which shard
/// to run again; where they are of several divisions, or answer another question.
bool join_index(const std::filesystem::path& folder, const std::string& question);

/// A cell of a folder: what its index says of it, and its certificate, if it has one.
struct Cell_entry {
  std::uint64_t cell = 0;
  std::string file;
  Cell_statement statement;
};

/// The cells that the index of a folder states, in its order.
struct Cell_index {
  std::string question;                 ///< as the table has it; empty where it says none
  std::vector<Cell_entry> cells, rest;  ///< with certificates, and without
};

/// Errors: Input_error where there is no index, or what it holds is none.
Cell_index read_index(const std::filesystem::path& folder);

}  // namespace sightline::app
