#include "certificates.h"

#include "../methods/weak.h"
#include "../support/files.h"
#include "cell_index.h"

#include <sightline/algorithms/levels/stated_cell.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/io/binary.h>
#include <sightline/io/file.h>
#include <sightline/io/input.h>

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace sightline::app {

namespace fs = std::filesystem;

namespace {

/// What `--resume` keeps of cells whose certificates are whole: which question they answer, what their bytes add up to,
/// and what they do not prove. Beside each certificate, until the index has it of all.
class Kept_cells {
 public:
  Kept_cells(fs::path folder, std::string question, const Shard& own, bool keeps)
      : folder_(std::move(folder)), question_(std::move(question)), keeps_(keeps) {
    if (keeps) indexed_ = facts_in_index(folder_, question_, own);
  }

  static std::string name_of(Cell_id cell) { return fmt::format("cell-{}.json", cell); }
  fs::path certificate(Cell_id cell) const { return folder_ / name_of(cell); }

  /// Nothing where there is no such cell, of this question, with the certificate that was written.
  std::optional<Certificate_facts> facts_of(Cell_id cell) const {
    if (!keeps_ || !fs::is_regular_file(certificate(cell))) return std::nullopt;
    try {
      Certificate_facts facts;
      if (fs::is_regular_file(mark(cell))) {
        const nlohmann::json json = nlohmann::json::parse(read_own_bytes(mark(cell)));
        if (json.at("question") != question_) return std::nullopt;
        facts = {json.at("unproved").get<std::vector<Face_id>>(), json.at("sum").get<std::uint64_t>()};
      } else if (const auto at = indexed_.find(cell); at != indexed_.end()) {
        facts = at->second;
      }
      if (facts.sum == sum_of_bytes(read_own_bytes(certificate(cell)))) return facts;
    } catch (const nlohmann::json::exception&) {
    } catch (const Input_error&) {
    }
    return std::nullopt;
  }
  void keep(Cell_id cell, const Certificate_facts& facts) const {
    if (!keeps_ || !facts.sum) return;
    const Json json{{"question", question_}, {"sum", *facts.sum}, {"unproved", facts.unproved}};
    write_file(mark(cell).string(), to_text(json) + "\n");
  }
  void forget(const std::vector<Cell_id>& cells) const {
    std::error_code error;
    if (!keeps_) return;
    for (const Cell_id cell : cells) fs::remove(mark(cell), error);
  }

 private:
  fs::path mark(Cell_id cell) const { return folder_ / fmt::format("cell-{}.kept", cell); }

  fs::path folder_;
  std::string question_;
  bool keeps_;
  std::map<std::uint64_t, Certificate_facts> indexed_;
};

/// All that are not set aside, ascending.
std::vector<Face_id> kept_faces(const Scene& scene) {
  std::vector<Face_id> faces;
  for (const Piece& piece : scene.pieces())  // in the order of faces
    if (faces.empty() || faces.back() != piece.face) faces.push_back(piece.face);
  return faces;
}

/// What the portals of a cell see outwards: how many faces are undecided, as they are once the budget is over; those
/// that nothing is proved of; then the certificate.
std::string certificate_of(const Pvs_arguments& arguments, const Level_cells& level, const Occluders& occluders,
                           const Time_limit& limit, Cell_id cell) {
  Sources sources;
  sources.points = portals_of(level, cell);
  Weakly_visible found;
  if (!sources.points.empty() && limit.is_over()) {
    found.undecided = kept_faces(level.scene());  // without asking of each portal and face that there is no time
  } else if (!sources.points.empty()) {
    for (const std::vector<Exact_point>& portal : sources.points)
      sources.polygons.push_back(weak_source(occluders, portal));
    Weak_task task;
    task.threads = arguments.common.threads;
    task.seed = arguments.common.seed;
    task.out_of_time = limit.end();
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

}  // namespace

bool write_certificates(const Pvs_arguments& arguments, const Level_cells& level, const Visibility_table& table,
                        const Time_limit& limit, const Shard& own, Ranks& ranks) {
  const fs::path folder = arguments.certificates;
  if (ranks.is_first()) make_folder(folder);
  const Occluders occluders(level.scene());
  Progress progress("proving");
  // 1. The cells that are asked about, and others, go round among shards.
  std::vector<Cell_id> asked, others;
  std::array<std::size_t, 2> places{};
  for (Cell_id cell = 0; cell < table.cells.size(); ++cell)
    if (places[table.cells[cell]]++ % own.shards == own.shard) (table.cells[cell] ? asked : others).push_back(cell);
  // 2. Their certificates, but for those that are there.
  const Kept_cells kept(folder, table.question, own, arguments.resume && ranks.is_first());
  std::map<Cell_id, Certificate_facts> proved;
  std::vector<Cell_id> missing;
  for (const Cell_id cell : asked)
    if (auto facts = kept.facts_of(cell)) proved[cell] = *std::move(facts);
    else missing.push_back(cell);
  bool all_decided = true;
  ranks.share(
      "certificates", missing, [&](Cell_id cell) { return certificate_of(arguments, level, occluders, limit, cell); },
      [&](Cell_id cell, const std::string& answer) {
        Certificate_facts& facts = proved[cell];
        progress(proved.size(), asked.size());
        const auto number = [&](std::size_t i) { return load<std::uint32_t>(answer, 4 * i, std::endian::little); };
        facts.unproved.resize(number(1));
        for (std::size_t i = 0; i < facts.unproved.size(); ++i) facts.unproved[i] = number(i + 2);
        const std::string_view certificate = std::string_view(answer).substr(4 * (facts.unproved.size() + 2));
        if (number(0) == 0) facts.sum = sum_of_bytes(certificate);  // what time left open is asked again
        all_decided = all_decided && facts.sum.has_value();
        write_file(kept.certificate(cell).string(), certificate);
        kept.keep(cell, facts);
      },
      [&](std::size_t done, std::size_t all) { progress(done, all); });
  if (!ranks.is_first()) return true;
  // 3. The index, or a part of it.
  Json index = Json::array(), rest = Json::array();
  for (const Cell_id cell : asked)
    index.push_back(asked_entry(cell, stated_cell(level, cell), Kept_cells::name_of(cell), proved[cell]));
  for (const Cell_id cell : others) rest.push_back(other_entry(cell, stated_cell(level, cell)));
  progress.clear();
  write_index(folder, table.question, own, all_decided, std::move(index), std::move(rest));
  if (all_decided) kept.forget(asked);
  return all_decided;
}

}  // namespace sightline::app
