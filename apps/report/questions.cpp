// How sightline report asks each question, and in one figure how wrong an answer is.

#include "questions.h"

#include <sightline/io/off.h>

#include <limits>
#include <sstream>

namespace sightline::app {

namespace {

std::string point_text(const Exact_point& p) { return to_string(p[0]) + ',' + to_string(p[1]) + ',' + to_string(p[2]); }

/// The share of an area that rounded corners may lose or win before an answer counts as wrong: what no picture shows.
constexpr double tolerance = 0x1p-20;

// ---- order

Compare_arguments order_arguments(const Judge_case& asked, const Report_effort&) {
  Compare_arguments a;
  a.command = "order";
  a.eye = point_text(asked.query.eye);
  return a;
}
Report_verdict order_judged(const Json& row, std::size_t) {
  const Json& e = row["errors"];
  double error =
      std::max({e["area_lost"].get<double>(), e["area_overlapping"].get<double>(), e["area_outside"].get<double>()});
  bool wrong = error > tolerance || e["fragments_not_finite"] != 0;
  if (e["pairs_wrong_beyond_rounding"].is_number() && e["pairs"] != 0) {
    const double pairs = e["pairs_wrong_beyond_rounding"].get<double>() / e["pairs"].get<double>();
    wrong = wrong || pairs > 0;
    error = std::max(error, pairs);
  }
  if (!wrong && e["pairs_wrong_beyond_rounding"].is_null())
    return {.why_not_asked = fmt::format("an order of more than {} fragments by {} is compared in no pair",
                                         Compare_arguments().max_fragments, row["kernel"].get<std::string>())};
  return {wrong ? Report_verdict::wrong : Report_verdict::right, error};
}
std::string order_again(const Compare_arguments& a, const Json& name) {
  return fmt::format("order --eye={} --kernels {}", a.eye, name["kernel"].get<std::string>());
}

// ---- see

Compare_arguments see_arguments(const Judge_case& asked, const Report_effort& effort) {
  if (asked.query.two_sided)
    throw Usage_error(
        "--ask: methods of see are asked which fronts are seen, not \"two_sided\"; ask a program by `sightline judge "
        "--ask`, or make it false");
  Compare_arguments a;
  a.command = "see";
  a.eye = point_text(asked.query.eye);
  a.sizes = effort.buffer_sizes;
  a.bits = effort.bits;
  return a;
}
Report_verdict see_judged(const Json& row, std::size_t) {
  const Json& e = row["errors"];
  constexpr double rounding = 1e-12;  // of sums of areas in doubles
  const double error = e["wrong_area"].get<double>();
  bool wrong = error > tolerance;
  for (const char* key : {"wrongly_visible", "wrongly_hidden", "not_finite"}) wrong = wrong || e[key] != 0;
  return {wrong ? Report_verdict::wrong : Report_verdict::right, error > rounding ? error : 0};
}
std::string see_again(const Compare_arguments& a, const Json& name) {
  const std::string ask = "see --eye=" + a.eye;
  return name["method"] == "depth buffer"
             ? fmt::format("{} --kernels exact --sizes {} --bits {}", ask, name["size"].get<int>(),
                           name["bits"].get<int>())
             : fmt::format("{} --kernels {} --sizes 64 --bits 24", ask, name["kernel"].get<std::string>());
}

// ---- render

Compare_arguments render_arguments(const Judge_case& asked, const Report_effort& effort) {
  Compare_arguments a;
  a.command = "render";
  a.eye = point_text(asked.query.eye);
  a.bits = effort.bits;
  a.samples.clear();
  a.view.canvas.size = fmt::format("{0}x{0}", effort.image_size);
  return a;
}
Report_verdict render_judged(const Json& row, std::size_t) {
  const Json& e = row["errors"];
  if (e.contains("off"))
    return {e["off"] != 0 ? Report_verdict::wrong : Report_verdict::right, e["off_share"].get<double>()};
  return {e["wrong"] != 0 ? Report_verdict::wrong : Report_verdict::right, e["wrong_share"].get<double>()};
}
std::string render_again(const Compare_arguments& a, const Json& name) {
  return fmt::format("render --eye={} --size {} --kernels {}{}", a.eye, a.view.canvas.size,
                     name["kernel"].get<std::string>(),
                     name.contains("bits") ? fmt::format(" --bits {}", name["bits"].get<int>()) : "");
}

// ---- weak

Compare_arguments weak_arguments(const Judge_case& asked, const Report_effort& effort) {
  Compare_arguments a;
  a.command = "weak";
  std::string source;
  for (const Exact_point& p : asked.query.source) source += (source.empty() ? "" : " ") + point_text(p);
  a.sources.polygons = {source};
  a.sources.two_sided = asked.query.two_sided;
  a.rays = effort.weak_rays;
  return a;
}
Report_verdict weak_judged(const Json& row, std::size_t faces) {
  const Json& e = row["errors"];
  const double wrong = e["wrongly_visible"].get<double>() + e["wrongly_hidden"].get<double>();
  return {wrong > 0            ? Report_verdict::wrong
          : e["undecided"] > 0 ? Report_verdict::abstained
                               : Report_verdict::right,
          wrong / std::max(1.0, static_cast<double>(faces))};
}
std::string weak_again(const Compare_arguments& a, const Json& name) {
  return fmt::format("weak --from=\"{}\"{} --kernels {}{}", a.sources.polygons[0],
                     a.sources.two_sided ? " --two-sided" : "", name["kernel"].get<std::string>(),
                     name.contains("rays") ? fmt::format(" --rays {}", name["rays"].get<std::size_t>()) : "");
}

// ---- trace

Compare_arguments trace_arguments(const Judge_case& asked, const Report_effort& effort) {
  Compare_arguments a;
  a.command = "trace";
  a.random = effort.rays;
  if (effort.own_query) a.own_rays = asked.query.rays;
  return a;
}
Report_verdict trace_judged(const Json& row, std::size_t) {
  const Json& e = row["errors"];
  const double wrong = e["missed"].get<double>() + e["invented"].get<double>() + e["wrong_face"].get<double>();
  return {wrong > 0 ? Report_verdict::wrong : Report_verdict::right, wrong / std::max(1.0, e["rays"].get<double>())};
}
std::string trace_again(const Compare_arguments& a, const Json&) {
  return a.own_rays.empty() ? fmt::format("trace --random {}", a.random)
                            : "--questions trace --cases 1 --reduce 1 --json -";
}

// ---- cutset

Compare_arguments cutset_arguments(const Judge_case&, const Report_effort& effort) {
  Compare_arguments a;
  a.random = effort.views;
  return a;
}
Report_verdict cutset_judged(const Json& row, std::size_t) {
  const Json& e = row["errors"];
  return {e["wrong_frames"] != 0 ? Report_verdict::wrong : Report_verdict::right,
          e["wrong_frames"].get<double>() / std::max(1.0, e["frames"].get<double>())};
}
std::string cutset_again(const Compare_arguments& a, const Json&) {
  return fmt::format("--questions cutset --cases 1 --reduce 1{} --json -",
                     a.random == report_effort(true).views ? " --quick" : "");
}

// ---- pvs

Compare_arguments pvs_arguments(const Judge_case&, const Report_effort& effort) {
  Compare_arguments a;
  a.command = "pvs";
  a.rays = effort.weak_rays;
  return a;
}
Report_verdict pvs_judged(const Json& row, std::size_t) {
  const Json& e = row["errors"];
  const double wrong = e["wrongly_visible"].get<double>() + e["wrongly_hidden"].get<double>();
  return {wrong > 0 ? Report_verdict::wrong : Report_verdict::right, wrong / std::max(1.0, row["pairs"].get<double>())};
}
std::string pvs_again(const Compare_arguments&, const Json& name) {
  return name.contains("rays") ? fmt::format("pvs --rays {}", name["rays"].get<std::size_t>()) : "pvs --rays 100";
}

// ---- boolean

Compare_arguments boolean_arguments(const Judge_case& asked, const Report_effort&) {
  Compare_arguments a;
  a.solids = asked.query;
  return a;
}
Report_verdict boolean_judged(const Json& row, std::size_t) {
  const Json& e = row["errors"];
  return {e["wrong"] == true ? Report_verdict::wrong : Report_verdict::right, e["share"].get<double>()};
}
std::string boolean_again(const Compare_arguments&, const Json&) {
  return "--questions boolean --cases 1 --reduce 1 --json -";
}

}  // namespace

Report_effort report_effort(bool quick) {
  if (quick) return {true, {64}, {24}, 48, {100, 1000}, 20, 24};
  return {false, {64, 256}, {16, 24, 32}, 128, {100, 1000, 10000}, 100, 100};
}

const std::vector<Report_question>& report_questions() {
  constexpr std::size_t any_size = std::numeric_limits<std::size_t>::max();
  static const std::vector<Report_question> all{
      {"order", "share of overlapping pairs of fragments drawn in the wrong order, or of area lost or drawn twice",
       any_size, order_arguments, order_trial, order_judged, order_again},
      {"see", "share of all directions in which another face is shown than the one that is seen", any_size,
       see_arguments, see_trial, see_judged, see_again},
      {"render", "share of the pixels that show another face than an exact ray meets first", any_size, render_arguments,
       render_trial, render_judged, render_again},
      {"weak", "share of the faces that are said to be visible and are hidden, or hidden and are visible", any_size,
       weak_arguments, weak_trial, weak_judged, weak_again},
      {"trace", "share of the rays that miss what they meet, or meet what they miss, or another face first", any_size,
       trace_arguments, trace_trial, trace_judged, trace_again},
      {"cutset",
       "share of the viewpoints along a path where a face is on-view and said not to be, or the other way round, or an "
       "edge of the cut is missing or too many",
       any_size, cutset_arguments, cutset_trial, cutset_judged, cutset_again},
      {"pvs",
       "share of the pairs of a cell and a face that are said to be visible and are hidden, or hidden and are visible",
       0, pvs_arguments, pvs_trial, pvs_judged, pvs_again},
      {"boolean",
       "share of the points about the result that it holds and ought not, or the other way round, or of its volume or "
       "area that is too much or missing, the largest of them",
       0, boolean_arguments, boolean_trial, boolean_judged, boolean_again}};
  return all;
}

const Report_question& report_question(const std::string& name) {
  for (const Report_question& question : report_questions())
    if (question.name == name) return question;
  throw std::logic_error("no question " + name);
}

judge::Question case_question(const std::string& name) {
  const auto place = std::find(judge::question_names.begin(), judge::question_names.end(), name);
  if (place == judge::question_names.end()) return judge::Question::see;
  return static_cast<judge::Question>(place - judge::question_names.begin());
}

std::string method_of(const Json& name) {
  std::string method = name["method"].get<std::string>();
  if (name.contains("size")) method += fmt::format(" {}", name["size"].get<int>());
  if (name.contains("bits")) method += fmt::format(", {} bit", name["bits"].get<int>());
  if (name.contains("rays")) method += fmt::format(", {} rays", name["rays"].get<std::size_t>());
  return method;
}

Report_verdict verdict_of(const Report_question& question, const Trial& trial, const Contestant& contestant,
                          std::size_t faces, const Report_limits& limits) {
  // What judges the answer takes its time too, beside the method. A program may name more addresses than it uses; its
  // court counts what it uses.
  const bool is_program = contestant.name["kernel"] == "program";
  const Json row = ask_apart(contestant, 4 * limits.seconds + 5, is_program ? 0 : limits.bytes);
  const std::string status = row["status"].get<std::string>();
  if (status.starts_with("left out")) return {};
  if (status == "timed out" || status == "out of memory") return {Report_verdict::stopped};
  if (status.starts_with("error: --program")) throw Usage_error(status.substr(7));  // it cannot be started
  const bool promises = claims_to_be_exact(row);
  if (status != "done") return {.kind = Report_verdict::crashed, .broken = promises};
  Report_verdict verdict =
      is_program ? Report_verdict{static_cast<Report_verdict::Kind>(row["kind"].get<int>()), row["error"].get<double>()}
                 : question.judged(row, faces);
  verdict.seconds = row["seconds"].get<double>() + row.value("prepare", 0.0);
  verdict.peak_bytes = row["peak_bytes"].get<std::uint64_t>();
  if (row.contains("said")) verdict.said = row["said"];
  if (row.contains("wrong_faces")) verdict.wrong_faces = row["wrong_faces"];
  verdict.broken = promises && row.contains("errors") && !trial.right(row);
  if (verdict.broken) verdict.kind = Report_verdict::wrong;
  if (verdict.seconds > limits.seconds) verdict.kind = Report_verdict::stopped;
  return verdict;
}

// ---- Programs

std::string Report_program::name() const {
  std::string name;
  for (const std::string& word : split_words(command))
    if (word.find('{') == std::string::npos) name += (name.empty() ? "" : " ") + word;
  return name;
}

Report_program report_program(const std::string& text, const Report_limits& limits) {
  const std::size_t equals = text.find('=');
  const std::string question = text.substr(0, equals);
  const auto place = std::find(judge::question_names.begin(), judge::question_names.end(), question);
  if (equals == std::string::npos || place == judge::question_names.end())
    throw Usage_error(
        fmt::format("--program {}: write QUESTION=COMMAND, the question one of {}, as in see=\"python3 "
                    "mine.py {{scene}} {{query}} {{answer}}\"",
                    text, fmt::join(judge::question_names, ", ")));
  Court_options options;
  options.program = text.substr(equals + 1);
  options.limits = {limits.seconds, limits.bytes};
  options.truth = {1, limits.seconds, false};
  return {question, options.program, std::make_shared<Court>(options)};
}

/// An answer as rows of `compare` have it.
static Json said_json(const judge::Answer& answer) {
  if (answer.surface) {
    std::ostringstream text;
    write_qoff(*answer.surface, text);
    return text.str();
  }
  Json all = Json::array();
  for (const std::optional<Face_id>& face : answer.first) all.push_back(face ? Json(*face) : Json());
  if (!answer.first.empty()) {
    for (const Face_id ray : answer.abstained) all[ray] = "abstained";
    return all;
  }
  if (answer.order.empty()) return answer.visible;
  for (const judge::Drawn_face& item : answer.order) {
    Json points = Json::array();
    for (const Exact_point& p : item.part) points.push_back(point_json(p));
    all.push_back({item.face, std::move(points)});
  }
  return all;
}

Contestant contestant_of(const Report_program& program, std::shared_ptr<const Judge_case> asked, std::uint64_t seed) {
  return {{{"kernel", "program"}, {"method", program.name()}}, [court = program.court, asked = std::move(asked), seed] {
            const Judged judged = court->judge(*asked, seed);
            if (!judged.not_asked.empty()) return Json{{"status", "left out: " + judged.not_asked}};
            const judge::Grade& grade = judged.grade;
            const auto kind = [&] {
              switch (judged.mark) {
                case judge::Mark::crashed:
                case judge::Mark::invalid: return Report_verdict::crashed;
                case judge::Mark::out_of_memory:
                case judge::Mark::timed_out: return Report_verdict::stopped;
                case judge::Mark::wrong: return Report_verdict::wrong;
                case judge::Mark::abstained: return Report_verdict::abstained;
                case judge::Mark::right: break;
              }
              return Report_verdict::right;
            }();
            const bool of_rays = asked->query.question == judge::Question::trace,
                       of_solids = asked->query.question == judge::Question::boolean;
            const auto wrong = static_cast<double>(of_rays ? grade.wrong_rays.size()
                                                           : grade.wrong_visible.size() + grade.wrong_hidden.size());
            const std::size_t least = of_rays ? 1 : asked->soup.face_count();
            return Json{
                {"status", "done"},
                {"kind", static_cast<int>(kind)},
                {"seconds", judged.seconds},
                {"peak_bytes", judged.bytes},
                {"said", said_json(judged.answer)},
                {"error", of_solids ? solid_error(grade)
                                    : wrong / std::max(1.0, static_cast<double>(std::max(grade.judged, least)))}};
          }};
}

}  // namespace sightline::app
