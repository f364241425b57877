// The question boolean: set operations on two solids, exact, and with the result's points rounded.

#include "questions.h"

#include <sightline/algorithms/solids/rounding.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/harness/judge/truth.h>
#include <sightline/io/off.h>
#include <sightline/kernel/threads.h>

#include <sstream>

namespace sightline::app {

namespace {

struct Solid_trial : Trial {
  judge::Query query;
  std::array<Polygon_soup, 2> solids;
  judge::Truth truth;
  bool says;

  Solid_trial(const Compare_arguments& arguments, const Polygon_soup& soup)
      : query(arguments.solids.value()), solids(judge::solids_of(soup, query.first)), says(arguments.says) {
    truth = judge::truth_of(soup, query, {1, arguments.common.budget, false});
    if (!truth.not_asked.empty()) throw std::invalid_argument(truth.not_asked);
    const auto add = [&](const char* kernel, std::optional<Rounding> to) {
      contestants.push_back(
          {{{"kernel", kernel}, {"method", to ? "rounded" : "fragments"}}, [this, to] { return judged(to); }});
    };
    add("exact", std::nullopt);
    add("double", Rounding::to_double);
    add("float", Rounding::to_float);
    right = [](const Json& r) { return r["errors"]["wrong"] == false; };
  }

  Polygon_soup result(std::optional<Rounding> to) const {
    Set_options options;
    options.operation = query.operation;
    const Polygon_soup exact = without_holes(set_operation(Operands(solids), options).soup).soup;
    return to ? rounded(exact, *to).soup : exact;
  }

  Json judged(std::optional<Rounding> to) const {
    const Peak_memory memory;
    const Stopwatch watch;
    judge::Answer answer;
    try {
      answer.surface = result(to);
    } catch (const std::domain_error&) {
      return {{"status", "left out: coordinates are beyond the numbers' range"}};
    }
    Json row{{"status", "done"}, {"seconds", watch.seconds()}, {"peak_bytes", memory.bytes()}};
    const judge::Grade grade = judge::grade(truth, answer);
    row["errors"] = {{"wrong", grade.wrong()}, {"share", solid_error(grade)}};
    if (!says) return row;
    std::ostringstream text;
    write_qoff(*answer.surface, text);
    row["said"] = text.str();
    return row;
  }
};

}  // namespace

double solid_error(const judge::Grade& grade) {
  // JSON has no infinity; and a mean of very many of these is finite, too.
  constexpr double most = 1e290;
  return std::min(most, std::max({std::fabs(grade.volume_error), std::fabs(grade.area_error),
                                  static_cast<double>(grade.wrong_points.size()) /
                                      std::max(1.0, static_cast<double>(grade.judged))}));
}

std::unique_ptr<Trial> boolean_trial(const Compare_arguments& arguments, const Polygon_soup& soup) {
  return std::make_unique<Solid_trial>(arguments, soup);
}

}  // namespace sightline::app
