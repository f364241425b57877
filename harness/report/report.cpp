#include <sightline/harness/report/report.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>

namespace sightline::report {

namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Json optional_number(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json to_json(const Contender& who) {
  return {{"question", who.question}, {"method", who.method}, {"kernel", who.kernel}};
}

// ---- From JSON

/// A member of an object. Errors: std::invalid_argument that names it.
template <class T>
T member(const nlohmann::json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end())
    throw std::invalid_argument(std::string("no report: it has no \"") + key + '"');
  const bool fits = std::is_same_v<T, std::string> ? found->is_string()
                    : std::is_same_v<T, double>    ? found->is_number()
                    : std::is_integral_v<T>        ? found->is_number_unsigned()
                                                   : true;
  if (!fits) throw std::invalid_argument(std::string("no report: \"") + key + "\" is of another type");
  return found->template get<T>();
}
const nlohmann::json& list(const nlohmann::json& object, const char* key) {
  if (!object.is_object() || !object.contains(key) || !object[key].is_array())
    throw std::invalid_argument(std::string("no report: it has no list \"") + key + '"');
  return object[key];
}

Contender contender_from_json(const nlohmann::json& value) {
  return {member<std::string>(value, "question"), member<std::string>(value, "method"),
          member<std::string>(value, "kernel")};
}

Json to_json(const Example& e) {
  Json json = to_json(e.who);
  json.update({{"family", e.family},
               {"distance", e.distance},
               {"size", e.size},
               {"seed", e.seed},
               {"faces_before", e.faces_before},
               {"faces", e.faces},
               {"error", e.error},
               {"file", e.file},
               {"scene", e.scene},
               {"query", e.query},
               {"why", e.why},
               {"again", e.again},
               {"picture", e.picture},
               {"view", e.view}});
  return json;
}
bool is_count(const nlohmann::json& value) {
  return value.is_number_unsigned() || (value.is_number_integer() && value.get<std::int64_t>() >= 0);
}

/// The name of a file of an example, which is written where somebody says: letters, digits and hyphens.
std::string file_from_json(const nlohmann::json& v) {
  const std::string file = member<std::string>(v, "file");
  const std::size_t dot = file.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-");
  if (dot == 0 || dot == std::string::npos || file.substr(dot) != ".off")
    throw std::invalid_argument("no report: an example's \"file\" is no name of one");
  return file;
}

Example example_from_json(const nlohmann::json& v) {
  return {contender_from_json(v),          member<std::string>(v, "family"),  member<std::string>(v, "distance"),
          member<std::size_t>(v, "size"),  member<std::uint64_t>(v, "seed"),  member<std::size_t>(v, "faces_before"),
          member<std::size_t>(v, "faces"), member<double>(v, "error"),        file_from_json(v),
          member<std::string>(v, "scene"), member<std::string>(v, "query"),   member<std::string>(v, "why"),
          member<std::string>(v, "again"), member<std::string>(v, "picture"), v.value("view", nlohmann::json())};
}

Json to_json(const Summary& s) {
  Json json = to_json(s.who);
  json.update({{"rows", s.rows},
               {"cases", s.cases},
               {"wrong", s.wrong},
               {"abstained", s.abstained},
               {"crashed", s.crashed},
               {"stopped", s.stopped},
               {"seconds", optional_number(s.seconds)},
               {"worst_seconds", s.worst_seconds},
               {"peak_bytes", s.peak_bytes},
               {"error", s.error},
               {"worst_error", s.worst_error}});
  return json;
}

}  // namespace

Json to_json(const Row& r) {
  Json json{{"unit", r.unit}};
  json.update(to_json(r.who));
  json.update({{"family", r.family},
               {"distance", r.distance},
               {"size", r.size},
               {"seed", r.seed},
               {"cases", r.cases},
               {"wrong", r.wrong},
               {"abstained", r.abstained},
               {"crashed", r.crashed},
               {"stopped", r.stopped},
               {"broken", r.broken},
               {"faces", r.faces},
               {"seconds", optional_number(r.seconds)},
               {"worst_seconds", r.worst_seconds},
               {"peak_bytes", r.peak_bytes},
               {"error", r.error},
               {"worst_error", r.worst_error},
               {"smallest", Json()}});
  if (r.smallest)
    json["smallest"] = {{"faces", r.smallest->faces}, {"seed", r.smallest->seed}, {"error", r.smallest->error}};
  return json;
}

Row row_from_json(const nlohmann::json& v) {
  Row r;
  r.unit = member<std::size_t>(v, "unit");
  r.who = contender_from_json(v);
  r.family = member<std::string>(v, "family");
  r.distance = member<std::string>(v, "distance");
  r.size = member<std::size_t>(v, "size");
  r.seed = member<std::uint64_t>(v, "seed");
  r.cases = member<std::size_t>(v, "cases");
  r.wrong = member<std::size_t>(v, "wrong");
  r.abstained = member<std::size_t>(v, "abstained");
  r.crashed = member<std::size_t>(v, "crashed");
  r.stopped = member<std::size_t>(v, "stopped");
  r.broken = member<std::size_t>(v, "broken");
  std::size_t rest = r.cases;
  for (const std::size_t part : {r.wrong, r.abstained, r.crashed, r.stopped}) {
    if (part > rest)
      throw std::invalid_argument("no report: more cases are wrong, abstained, crashed or stopped than \"cases\" says");
    rest -= part;
  }
  r.faces = member<double>(v, "faces");
  if (const auto seconds = member<nlohmann::json>(v, "seconds"); !seconds.is_null())
    r.seconds = member<double>(v, "seconds");
  r.worst_seconds = member<double>(v, "worst_seconds");
  r.peak_bytes = member<std::uint64_t>(v, "peak_bytes");
  r.error = member<double>(v, "error");
  r.worst_error = member<double>(v, "worst_error");
  if (const auto smallest = member<nlohmann::json>(v, "smallest"); !smallest.is_null())
    r.smallest = Wrong_case{member<std::size_t>(smallest, "faces"), member<std::uint64_t>(smallest, "seed"),
                            member<double>(smallest, "error")};
  return r;
}

Json to_json(const Report& report) {
  Json questions = Json::array(), rows = Json::array(), summed = Json::array(), examples = Json::array();
  for (const Question& q : report.questions) questions.push_back({{"question", q.name}, {"error", q.error_means}});
  for (const Row& row : report.rows) rows.push_back(to_json(row));
  for (const Summary& summary : summaries(report.rows)) summed.push_back(to_json(summary));
  for (const Example& example : report.examples) examples.push_back(to_json(example));
  return {{"command", "report"},
          {"asked", report.asked},
          {"contents", report.contents},
          {"shard", {report.shard, report.shards}},
          {"units", report.units},
          {"open", report.open},
          {"result",
           {{"questions", std::move(questions)},
            {"summaries", std::move(summed)},
            {"rows", std::move(rows)},
            {"examples", std::move(examples)},
            {"not_asked", report.not_asked}}},
          {"seconds", {{"all", report.seconds}}}};
}

Report report_from_json(const nlohmann::json& document) {
  if (member<std::string>(document, "command") != "report")
    throw std::invalid_argument("no report: \"command\" is another one");
  Report report;
  report.asked = member<nlohmann::json>(document, "asked");
  report.contents = member<nlohmann::json>(document, "contents");
  const nlohmann::json& shard = list(document, "shard");
  if (shard.size() != 2 || !shard[0].is_number_unsigned() || !shard[1].is_number_unsigned() || shard[0] >= shard[1] ||
      shard[1].get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("no report: \"shard\" is none");
  report.shard = shard[0].get<std::uint32_t>();
  report.shards = shard[1].get<std::uint32_t>();
  report.units = member<std::size_t>(document, "units");
  report.open = member<std::size_t>(document, "open");
  const auto result = member<nlohmann::json>(document, "result");
  for (const nlohmann::json& q : list(result, "questions"))
    report.questions.push_back({member<std::string>(q, "question"), member<std::string>(q, "error")});
  for (const nlohmann::json& row : list(result, "rows")) report.rows.push_back(row_from_json(row));
  for (const nlohmann::json& example : list(result, "examples")) report.examples.push_back(example_from_json(example));
  report.not_asked = member<nlohmann::json>(result, "not_asked");
  if (!report.not_asked.is_object() ||
      std::any_of(report.not_asked.begin(), report.not_asked.end(), [](const auto& count) { return !is_count(count); }))
    throw std::invalid_argument("no report: \"not_asked\" is none");
  report.seconds = member<double>(member<nlohmann::json>(document, "seconds"), "all");
  return report;
}

/// A file that only one of two reports asked about, or that had another content; empty where there is none.
static std::string file_that_differs(const Json& contents, const Json& others) {
  for (const auto& [file, name] : contents.items())
    if (!others.contains(file) || others[file] != name) return file;
  for (const auto& [file, name] : others.items())
    if (!contents.contains(file)) return file;
  return "";
}

Report merged(const std::vector<Report>& parts) {
  for (const Report& part : parts)
    if (part.open > 0)
      throw std::invalid_argument("shard " + std::to_string(part.shard) +
                                  " was not finished; run it again with --resume, and merge again");
  Report all = parts.at(0);
  std::set<std::uint32_t> there{all.shard};
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const Report& part = parts[k];
    if (part.asked != all.asked || part.shards != all.shards || part.units != all.units)
      throw std::invalid_argument("the parts are of different reports; give shards of one, made with the same options");
    if (const std::string file = file_that_differs(part.contents, all.contents); !file.empty())
      throw std::invalid_argument(file + " was another file for shard " + std::to_string(part.shard) +
                                  " than for shard " + std::to_string(all.shard) +
                                  "; run one of them again, and merge again");
    if (!there.insert(part.shard).second)
      throw std::invalid_argument("shard " + std::to_string(part.shard) + " is there twice; leave one of them out");
    all.rows.insert(all.rows.end(), part.rows.begin(), part.rows.end());
    all.examples.insert(all.examples.end(), part.examples.begin(), part.examples.end());
    for (const auto& [why, count] : part.not_asked.items())
      all.not_asked[why] = all.not_asked.value(why, std::size_t{0}) + count.get<std::size_t>();
    all.seconds += part.seconds;
  }
  for (std::uint32_t s = 0; s < all.shards; ++s)
    if (there.count(s) == 0)
      throw std::invalid_argument("shard " + std::to_string(s) + " of " + std::to_string(all.shards) +
                                  " is missing; run it, and merge again");
  all.shard = 0;
  all.shards = 1;
  std::stable_sort(all.rows.begin(), all.rows.end(), [](const Row& a, const Row& b) { return a.unit < b.unit; });

  // Of each contender the example of its smallest wrong case, which its shard had for its smallest one.
  std::vector<Example> kept;
  for (const Row* row : smallest_wrong(all.rows))
    for (const Example& e : all.examples)
      if (e.who == row->who && std::tie(e.family, e.distance, e.size, e.seed) ==
                                   std::tie(row->family, row->distance, row->size, row->smallest->seed))
        kept.push_back(e);
  all.examples = std::move(kept);
  return all;
}

std::vector<Summary> summaries(const std::vector<Row>& rows) {
  std::vector<Summary> all;
  std::vector<std::vector<double>> seconds;
  std::vector<std::size_t> ended;
  for (const Row& row : rows) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Summary& s) { return s.who == row.who; });
    const auto place = static_cast<std::size_t>(found - all.begin());
    if (found == all.end()) {
      all.emplace_back().who = row.who;
      seconds.emplace_back();
      ended.push_back(0);
    }
    Summary& s = all[place];
    ++s.rows;
    s.cases += row.cases;
    s.wrong += row.wrong;
    s.abstained += row.abstained;
    s.crashed += row.crashed;
    s.stopped += row.stopped;
    if (row.seconds) seconds[place].push_back(*row.seconds);
    s.worst_seconds = std::max(s.worst_seconds, row.worst_seconds);
    s.peak_bytes = std::max(s.peak_bytes, row.peak_bytes);
    const std::size_t of_row = row.cases - row.crashed - row.stopped;
    ended[place] += of_row;
    if (of_row > 0)  // a mean as it grows: a sum of the largest errors is no number
      s.error += (row.error - s.error) * (static_cast<double>(of_row) / static_cast<double>(ended[place]));
    s.worst_error = std::max(s.worst_error, row.worst_error);
  }
  for (std::size_t k = 0; k < all.size(); ++k)
    if (!seconds[k].empty()) all[k].seconds = median(seconds[k]);
  return all;
}

std::vector<const Row*> smallest_wrong(const std::vector<Row>& rows) {
  std::vector<const Row*> all;
  for (const Row& row : rows) {
    if (!row.smallest) continue;
    const auto found = std::find_if(all.begin(), all.end(), [&](const Row* r) { return r->who == row.who; });
    if (found == all.end()) all.push_back(&row);
    else if (row.smallest->faces < (*found)->smallest->faces) *found = &row;
  }
  return all;
}

}  // namespace sightline::report
