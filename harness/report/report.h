#pragma once
// What a report of speed against error holds: rows, one for each method, family, distance and size; the smallest scenes
// that show an error; as JSON and from it; parts together.

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sightline::report {

using Json = nlohmann::ordered_json;

/// Who was asked: what tells it from others.
struct Contender {
  std::string question, method, kernel;
  friend bool operator==(const Contender&, const Contender&) = default;
};

/// The smallest case of a row that is answered wrongly: fewest faces, then the first.
struct Wrong_case {
  std::size_t faces = 0;
  std::uint64_t seed = 0;
  double error = 0;
};

/// What a method made of some cases of a family at one distance, of one size. A case is wrong, abstained, crashed,
/// stopped (by the limit of time or memory), or right.
struct Row {
  std::size_t unit = 0;  ///< which family, distance and size of a question, in the order in which they are asked
  Contender who;
  std::string family, distance;
  std::size_t size = 0;    ///< faces that were asked for; 0: as small as the family has them
  std::uint64_t seed = 0;  ///< of the first case; the next has the next number
  std::size_t cases = 0, wrong = 0, abstained = 0, crashed = 0, stopped = 0;
  std::size_t broken = 0;         ///< of the wrong and crashed, those where the method promises more, as exact ones do
  double faces = 0;               ///< mean
  std::optional<double> seconds;  ///< median of the cases that ended; none where none did
  double worst_seconds = 0;
  std::uint64_t peak_bytes = 0;
  double error = 0, worst_error = 0;  ///< mean and largest share of an answer that is wrong, as the question has it
  std::optional<Wrong_case> smallest;
};

/// A scene that shows an error of a method, as small as could be found.
struct Example {
  Contender who;
  std::string family, distance;  ///< where it was found
  std::size_t size = 0;
  std::uint64_t seed = 0;
  std::size_t faces_before = 0, faces = 0;
  double error = 0;
  std::string file, scene;  ///< a name, and what the file holds: OFF with exact coordinates
  std::string query;        ///< the same of a program's query; empty where the command line says it
  std::string why;      ///< what refutes the answer, or why no face of it is marked, in words; empty where nothing does
  std::string again;    ///< the command that shows the error, beside the file
  std::string picture;  ///< SVG
  Json view = nullptr;  ///< the scene to turn around: the data of a page (apps/page); null: none
};

/// What a question's error is a share of, for people.
struct Question {
  std::string name, error_means;
};

struct Report {
  Json asked = Json::object();     ///< the options that say which rows there are
  Json contents = Json::object();  ///< by file: a name of what it held, of all files that are asked about
  std::uint32_t shard = 0, shards = 1;
  std::size_t units = 0;  ///< of all shards
  std::size_t open = 0;   ///< of this one, not reached in time
  std::vector<Question> questions;
  std::vector<Row> rows;
  std::vector<Example> examples;
  Json not_asked = Json::object();  ///< cases by the reason why they were not asked
  double seconds = 0;
};

Json to_json(const Row& row);
/// Errors of this and the next: std::invalid_argument that says in one line what is missing or of another type.
Row row_from_json(const nlohmann::json& value);

/// The document of `sightline report --json`, with the summaries.
Json to_json(const Report& report);
Report report_from_json(const nlohmann::json& document);

/// The shards of one report as one: rows in the order of units, of each method the example of the smallest wrong case.
/// Errors: std::invalid_argument where parts are of different reports, or of files that changed between them, a shard
/// is there twice, not finished, or missing, which it names. Pre: at least one part.
Report merged(const std::vector<Report>& parts);

/// All rows of a contender.
struct Summary {
  Contender who;
  std::size_t rows = 0, cases = 0, wrong = 0, abstained = 0, crashed = 0, stopped = 0;
  std::optional<double> seconds;  ///< median of the rows' medians
  double worst_seconds = 0;
  std::uint64_t peak_bytes = 0;
  double error = 0, worst_error = 0;  ///< mean over cases that ended, and largest
};
/// In the order in which contenders first appear.
std::vector<Summary> summaries(const std::vector<Row>& rows);

/// For each contender that errs the row with its smallest wrong case, in the order in which contenders first appear;
/// of equal ones the first.
std::vector<const Row*> smallest_wrong(const std::vector<Row>& rows);

}  // namespace sightline::report
