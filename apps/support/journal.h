#pragma once
// What --resume keeps beside an output: which question it is about, and what of it is done.

#include "common.h"

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace sightline::app {

/// What a file of --resume begins with: whose it is, the program's version, and what was asked, by options' names.
Json resumed_head(const std::string& command, Json asked);
/// Holds the head that was found in a file to the one of the same command line. Errors: std::runtime_error, naming the
/// first option that is another, or the version.
void check_resumed(const std::string& file, const nlohmann::json& found, const Json& head);

/// A number for bytes, as text: FNV-1a of 64 bits.
std::string hash_of_bytes(std::string_view bytes);
/// The same of a file's. Errors: Input_error where it cannot be read.
std::string content_hash(const std::string& file);
/// The same of each file that a command line names, by name: its program, as PATH has it, and words that are files.
Json hashes_of_words(const std::vector<std::string>& words);

/// Bytes as text that JSON holds, whatever they are: each is the code point of its number; and back.
std::string text_of_bytes(std::string_view bytes);
std::string bytes_of_text(std::string_view text);

/// A file of lines, each a unit of work that is done. A unit is known by its number and what it is of; a line that was
/// being written when the program ended is none.
class Journal {
 public:
  Journal(std::string file, Json head) : file_(std::move(file)), head_(std::move(head)) {}

  /// The lines that are there. Errors: as check_resumed(); Input_error where the file cannot be read.
  std::vector<nlohmann::json> lines();
  /// Goes on behind them. Errors: std::runtime_error where it cannot be written. Pre: lines() was called.
  void begin();
  void add(const Json& line);
  void remove();

 private:
  void write(const Json& line);

  std::string file_;
  Json head_;
  std::uintmax_t good_ = 0;  // bytes that are whole lines
  std::ofstream out_;
};

}  // namespace sightline::app
