// sightline verify: checks a certificate against a scene.

#include "pvs/cell_index.h"
#include "support/common.h"

#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/level_cell.h>
#include <sightline/algorithms/verify/level_fill.h>
#include <sightline/algorithms/verify/solids_json.h>
#include <sightline/io/file.h>
#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/io/read.h>
#include <sightline/io/visibility_table.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <sstream>

namespace sightline::app {

static Verdict verdict_on(const Polygon_soup& soup, const Order_certificate& claim, const Verify_options& options) {
  return verify_order(soup, claim, options);
}
static Verdict verdict_on(const Polygon_soup& soup, const Graph_certificate& claim, const Verify_options& options) {
  return verify_graph(soup, claim, options);
}
static Verdict verdict_on(const Polygon_soup& soup, const Visible_certificate& claim, const Verify_options& options) {
  return verify_visible(soup, claim, options);
}
static Verdict verdict_on(const Polygon_soup& soup, const Weak_certificate& claim, const Verify_options& options) {
  return verify_weak(soup, claim, options);
}
static Verdict verdict_on(const Polygon_soup& soup, const Along_certificate& claim, const Verify_options& options) {
  return verify_along(soup, claim, options);
}

static Certificate certificate_of(std::istream& in, const std::string& file) {
  try {
    return read_certificate(in);
  } catch (const Certificate_error& error) {
    if (in.bad()) throw Input_error::of_file(file, "cannot be read to its end; check the file");
    if (error.is_no_json && format_of_ending(file))
      throw Input_error::of_file(file,
                                 "is a scene by its name, not a certificate; `verify` wants SCENE, then CERTIFICATE");
    const std::string what = error.message + (error.is_no_json ? "; write the file again, or fetch it again"
                                                               : "; make the certificate again");
    if (error.line == 0) throw Input_error::of_file(file, what);
    throw Input_error::in_text(file, error.line, error.column, what);
  }
}

/// How many faces a cell's certificate and its statement show to be visible from it.
static std::size_t faces_shown_by(const Weak_certificate& claim, const Cell_statement& statement) {
  std::set<Face_id> shown(statement.within.begin(), statement.within.end());
  for (const Weak_certificate::Sightline& line : claim.visible) shown.insert(claim.fragments[line.fragment].face);
  return shown.size();
}

/// Which cells of a folder are checked: all, or so many, drawn at random, or those that are named.
struct Choice {
  std::size_t sample = 0;  // 0: all
  std::vector<std::uint64_t> cells;
};

static std::vector<std::size_t> chosen_of(const std::vector<Cell_entry>& cells, const Choice& choice,
                                          const Common& common) {
  std::vector<std::size_t> chosen;
  for (const std::uint64_t cell : choice.cells) {
    const auto at = std::find_if(cells.begin(), cells.end(), [&](const Cell_entry& e) { return e.cell == cell; });
    if (at == cells.end()) throw Usage_error(fmt::format("--cell {}: the folder has no certificate of it", cell));
    chosen.push_back(static_cast<std::size_t>(at - cells.begin()));
  }
  if (!chosen.empty()) return chosen;
  chosen.resize(cells.size());
  std::iota(chosen.begin(), chosen.end(), 0);
  if (choice.sample > 0 && choice.sample < cells.size()) {
    std::mt19937_64 random(common.seed);
    std::shuffle(chosen.begin(), chosen.end(), random);
    chosen.resize(choice.sample);
  }
  return chosen;
}

/// Cells of a folder with their certificates; and that its cells fill a level.
static Exit run_folder(const Common& common, const std::string& folder, const Choice& choice) {
  const Polygon_soup soup = common.read();
  Cell_index index = read_index(folder);
  if (const std::string scene = fmt::format("scene {:016x},", fingerprint(soup));
      index.question.find("scene ") != std::string::npos && index.question.find(scene) == std::string::npos) {
    const std::string why = "the index is of another scene, as it says, or SCENE was read with other options";
    const Json result{{"accepted", false},
                      {"why", why},
                      {"rejected", Json::array({Json{{"file", folder + "/index.json"}, {"why", why}}})}};
    if (!write_json(common, "verify", Scene(soup), result, {{"certificates", 0}}, {{"verify", 0.0}}))
      row("REJECTED", why);
    return Exit::disagreement;
  }
  std::vector<Cell_entry>& cells = index.cells;
  const std::vector<std::size_t> chosen = chosen_of(cells, choice, common);
  const Stopwatch watch;
  const Time_limit limit(common.budget);
  Progress progress("verifying");
  Verify_options options;
  options.threads = common.threads;
  options.progress = common.within_budget();  // within a cell
  Json rejected = Json::array();

  // 1. Cell by cell.
  std::vector<Cell_of_level> level;
  std::size_t visible = 0, undecided = 0;  // faces, summed over cells
  Level_cell_checker checker(soup, options);
  for (const Cell_entry& entry : cells) level.push_back({entry.cell, entry.statement.walls, true, {}, {}});
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    progress(i, chosen.size());
    if (limit.is_over())
      throw Out_of_budget(
          fmt::format("undecided: the budget of {} s ran out after {} of {} cells", limit.seconds(), i, chosen.size()));
    const Cell_entry& entry = cells[chosen[i]];
    std::ifstream in = open_bytes(entry.file);
    const Certificate certificate = certificate_of(in, entry.file);
    const Weak_certificate* const claim = std::get_if<Weak_certificate>(&certificate);
    if (claim == nullptr)
      throw Input_error::of_file(entry.file, "is no certificate of weak visibility; write the folder again");
    Verdict verdict;
    if (claim->two_sided) verdict.why = "backs count as visible, which is not what cells are asked";
    else verdict = checker.check(entry.statement, *claim);
    if (!verdict.accepted) {
      rejected.push_back({{"cell", entry.cell}, {"file", entry.file}, {"why", verdict.why}});
      continue;
    }
    level[chosen[i]].sources = claim->sources;
    level[chosen[i]].open_walls = checker.open_walls();
    visible += faces_shown_by(*claim, entry.statement);
    undecided += claim->undecided.size();
  }

  // 2. All together.
  for (Cell_entry& entry : index.rest) level.push_back({entry.cell, std::move(entry.statement.walls), false, {}, {}});
  const Verdict filled = verify_level_fill(soup, level, options);
  if (!filled.accepted) rejected.push_back({{"file", folder + "/index.json"}, {"why", filled.why}});

  const double seconds = watch.seconds();
  progress.clear();
  const Exit exit = rejected.empty() ? Exit::done : Exit::disagreement;
  std::string what = fmt::format("{} of {} cells and their certificates, {} rejected", chosen.size(), cells.size(),
                                 rejected.size() - (filled.accepted ? 0 : 1));
  if (filled.accepted)
    what += fmt::format("; with {} others they fill a box about the scene, and no way leads to these{}",
                        index.rest.size(), chosen.size() < cells.size() ? " from those checked" : "");
  what += fmt::format("; {} faces seen in all, {} undecided", visible, undecided);
  if (!common.json.empty()) {
    const Json result{{"accepted", rejected.empty()}, {"why", what}, {"rejected", rejected}};
    if (write_json(common, "verify", Scene(soup), result, {{"certificates", chosen.size()}}, {{"verify", seconds}}))
      return exit;
  }
  row(rejected.empty() ? "accepted" : "REJECTED", what);
  for (const Json& one : rejected)
    row("", one.contains("cell")
                ? fmt::format("cell {} ({}): {}", one["cell"].dump(), one["file"].get<std::string>(),
                              one["why"].get<std::string>())
                : fmt::format("{}: {}", one["file"].get<std::string>(), one["why"].get<std::string>()));
  row("seconds", fmt::format("{:.3f}", seconds));
  return exit;
}

/// A set operation: of SCENE, the first solid, and of others.
struct Solid_files {
  std::vector<std::string> others;
  std::string result;
};

/// Looks for "format" at the top level of JSON, and ends there.
class Format_finder : public nlohmann::json::json_sax_t {
 public:
  std::string format;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool string(string_t& text) override {
    if (is_next_ && depth_ == 1) format = text;
    return !is_next_;
  }
  bool start_object(std::size_t) override { return go(1); }
  bool start_array(std::size_t) override { return go(1); }
  bool end_object() override { return go(-1); }
  bool end_array() override { return go(-1); }
  bool key(string_t& name) override {
    is_next_ = depth_ == 1 && name == "format";
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override { return false; }

 private:
  bool go(int by) {
    depth_ += by;
    return !is_next_;
  }
  int depth_ = 0;
  bool is_next_ = false;
};

/// An input that can be read again from its beginning: what cannot (standard input, another pipe) is held.
static std::unique_ptr<std::istream> open_to_rewind(const std::string& file) {
  const std::filesystem::path path = input_path(file);
  if (std::filesystem::is_regular_file(path)) return std::make_unique<std::ifstream>(open_bytes(path));
  return std::make_unique<std::istringstream>(read_input(file));
}

/// Whether it is what `boolean --certificate` writes: of one solid there is no other to tell. The stream is at its
/// beginning again.
static bool is_of_solids(std::istream& in) {
  Format_finder finder;
  nlohmann::json::sax_parse(in, &finder);
  in.clear();
  in.seekg(0);
  return finder.format.starts_with("sightline boolean");
}

static Solid_certificate solid_certificate_of(std::istream& in, const std::string& file) {
  std::ostringstream text;
  text << in.rdbuf();
  try {
    return read_solid_certificate(std::move(text).str());
  } catch (const std::invalid_argument& error) {
    throw Input_error::of_file(file, std::string(error.what()) + "; make the certificate again");
  }
}

static Verdict verdict_on_solids(const Polygon_soup& soup, const Common& common, const Solid_certificate& certificate,
                                 const Solid_files& files, const Verify_options& options) {
  Read_options reading;
  reading.round_to_double = common.coordinates == "double";
  std::vector<Polygon_soup> solids{soup};
  for (const std::string& other : files.others) solids.push_back(common.format.read(other, reading));
  std::optional<Polygon_soup> result;
  if (!files.result.empty()) {
    reading.any_denominator = true;  // each of its new points has one of its own
    result = common.format.read(files.result, reading);
  }
  return verify_solids(solids, certificate, result ? &*result : nullptr, options);
}

static Exit run(const Common& common, const std::string& file, const Solid_files& files, const Choice& choice) {
  if (std::filesystem::is_directory(file)) return run_folder(common, file, choice);
  if (choice.sample > 0 || !choice.cells.empty())
    throw Usage_error("--sample and --cell are for a folder of certificates; this is a file");
  const Polygon_soup soup = common.read();
  Certificate certificate;
  Solid_certificate solids;
  const std::unique_ptr<std::istream> in = open_to_rewind(file);
  const bool of_solids = !files.others.empty() || !files.result.empty() || is_of_solids(*in);
  if (of_solids) solids = solid_certificate_of(*in, file);
  else certificate = certificate_of(*in, file);
  const Stopwatch watch;
  Progress progress("verifying");
  Verify_options options;
  options.threads = common.threads;
  options.progress = common.within_budget(progress);
  const Verdict verdict =
      of_solids ? verdict_on_solids(soup, common, solids, files, options)
                : std::visit([&](const auto& claim) { return verdict_on(soup, claim, options); }, certificate);
  const double seconds = watch.seconds();
  progress.clear();
  const Exit exit = verdict.accepted ? Exit::done : Exit::disagreement;
  Json result{{"accepted", verdict.accepted}, {"why", verdict.why}, {"fragments", verdict.fragments}};
  if (!common.json.empty()) {
    const std::size_t fragments =
        of_solids ? solids.fragments.size()
                  : std::visit([](const Covering& covering) { return covering.fragments.size(); }, certificate);
    const Json counters{{"fragments", fragments}};
    if (write_json(common, "verify", Scene(soup), result, counters, {{"verify", seconds}})) return exit;
  }
  row(verdict.accepted ? "accepted" : "REJECTED", verdict.why);
  row("seconds", fmt::format("{:.3f}", seconds));
  return exit;
}

void add_verify(Command program) {
  const Command command = program.add_command(
      "verify", "Checks a certificate against a scene, by code that shares nothing with what made it");
  auto common = std::make_shared<Common>();
  auto certificate = std::make_shared<std::string>();
  common->add_to(command);
  auto choice = std::make_shared<Choice>();
  command
      .add_option("CERTIFICATE", *certificate,
                  "a file that --certificate wrote, or a folder that `pvs --certificates` wrote")
      .required()
      .reads_file();
  const Option sample = command.add_option("--sample", choice->sample, "of a folder, so many cells, drawn by --seed")
                            .check(range(1, std::numeric_limits<int>::max()));
  command.add_option("--cell", choice->cells, "of a folder, this cell alone; may be repeated").excludes(sample);
  auto solids = std::make_shared<Solid_files>();
  command
      .add_option(
          "--solid", solids->others,
          "of a certificate of `boolean`: another solid, in the order in which they were given; SCENE is the first")
      .expected(1, 1 << 20)
      .reads_file();
  command
      .add_option("--result", solids->result,
                  "of a certificate of `boolean`: the result that it wrote; it must be what the certificate keeps")
      .reads_file();
  command.footer("Exit code 0: accepted; 1: rejected; 3: scene or certificate cannot be read.");
  command.set_action([common, certificate, solids, choice] { return run(*common, *certificate, *solids, *choice); });
}

}  // namespace sightline::app
