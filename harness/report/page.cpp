#include <sightline/harness/report/page.h>

#include <sightline/harness/report/page_text.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace sightline::report {

namespace {

constexpr std::size_t most_rows = 30'000;  // so that a page stays below 3 MB

/// Names, each once, and their numbers.
class Names {
 public:
  std::size_t operator()(const std::string& name) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
    names_.push_back(name);
    return names_.size() - 1;
  }
  const std::vector<std::string>& all() const { return names_; }

 private:
  std::vector<std::string> names_;
};

/// To three digits; the largest doubles, whose three digits are beyond all of them, as they are.
Json rounded(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  const double shorter = std::strtod(text, nullptr);
  return std::isfinite(shorter) ? Json::parse(text) : Json(x);
}

Json questions_json(const std::vector<Question>& questions) {
  Json all = Json::array();
  for (const Question& q : questions) all.push_back({{"question", q.name}, {"error", q.error_means}});
  return all;
}

std::size_t place_of(const std::string& question, const std::vector<Question>& questions) {
  const auto found =
      std::find_if(questions.begin(), questions.end(), [&](const Question& q) { return q.name == question; });
  return static_cast<std::size_t>(found - questions.begin());
}

/// Scenes to turn around: of the examples with the smallest, as many as there is room for, by their numbers; of the
/// others null.
Json views_json(const std::vector<Example>& examples) {
  constexpr std::size_t most_bytes = 300'000;
  std::vector<std::pair<std::size_t, std::size_t>> sizes;
  for (std::size_t k = 0; k < examples.size(); ++k)
    if (!examples[k].view.is_null()) sizes.push_back({in_element(examples[k].view).size(), k});
  std::sort(sizes.begin(), sizes.end());
  Json views = Json::array();
  for (std::size_t k = 0; k < examples.size(); ++k) views.push_back(nullptr);
  std::size_t bytes = 0;
  for (const auto& [size, k] : sizes)
    if ((bytes += size) <= most_bytes) views[k] = examples[k].view;
  return views;
}

/// `views`: which of them have one.
Json examples_json(const std::vector<Example>& examples, const Json& views) {
  Json all = Json::array();
  for (const Example& e : examples) {
    const bool has_view = all.size() < views.size() && !views[all.size()].is_null();
    std::string picture = e.picture;
    constexpr std::string_view name_space = " xmlns=\"http://www.w3.org/2000/svg\"";  // within a page it is known
    if (const std::size_t at = picture.find(name_space); at != std::string::npos) picture.erase(at, name_space.size());
    all.push_back({{"question", e.who.question},
                   {"method", e.who.method},
                   {"kernel", e.who.kernel},
                   {"family", e.family},
                   {"distance", e.distance},
                   {"seed", e.seed},
                   {"faces_before", e.faces_before},
                   {"faces", e.faces},
                   {"error", rounded(e.error)},
                   {"file", e.file},
                   {"scene", e.scene},
                   {"query", e.query},
                   {"why", e.why},
                   {"again", e.again},
                   {"picture", picture},
                   {"view", has_view ? Json(all.size()) : Json()}});
  }
  return all;
}

/// What the script draws.
Json page_data(const Report& report, const Json& views) {
  // 1. Contenders, in the order of their questions, with all that is known of each.
  std::vector<Summary> summed = summaries(report.rows);
  std::stable_sort(summed.begin(), summed.end(), [&](const Summary& a, const Summary& b) {
    return place_of(a.who.question, report.questions) < place_of(b.who.question, report.questions);
  });
  Json contenders = Json::array(), sums = Json::array();
  for (const Summary& s : summed) {
    contenders.push_back(
        {{"question", place_of(s.who.question, report.questions)}, {"method", s.who.method}, {"kernel", s.who.kernel}});
    sums.push_back({{"cases", s.cases},
                    {"wrong", s.wrong},
                    {"abstained", s.abstained},
                    {"crashed", s.crashed},
                    {"stopped", s.stopped},
                    {"seconds", s.seconds ? rounded(*s.seconds) : Json()},
                    {"worst", rounded(s.worst_seconds)},
                    {"bytes", s.peak_bytes},
                    {"error", rounded(s.error)},
                    {"worstError", rounded(s.worst_error)}});
  }

  // 2. Rows.
  Names families, distances;
  Json rows = Json::array();
  const std::size_t step = report.rows.size() / most_rows + 1;
  for (std::size_t k = 0; k < report.rows.size(); ++k) {
    const Row& r = report.rows[k];
    const std::size_t family = families(r.family), distance = distances(r.distance);
    if (k % step != 0) continue;
    const auto who = std::find_if(summed.begin(), summed.end(), [&](const Summary& s) { return s.who == r.who; });
    rows.push_back({who - summed.begin(), family, distance, r.size, r.seed, r.cases, r.wrong, r.abstained, r.crashed,
                    r.stopped, rounded(r.faces), r.seconds ? rounded(*r.seconds) : Json(), rounded(r.worst_seconds),
                    r.peak_bytes, rounded(r.error), rounded(r.worst_error)});
  }
  std::size_t cases = 0;
  for (const Row& row : report.rows) cases += row.cases;
  std::string about = std::to_string(cases) + " answers in " + std::to_string(report.rows.size()) + " rows, from " +
                      std::to_string(families.all().size()) +
                      (families.all().size() == 1 ? " family or scene at " : " families or scenes at ") +
                      std::to_string(distances.all().size()) +
                      " distances from degeneracy; each method in a process of its own, against the exact truth.";
  if (step > 1)
    about += " This page draws one row of " + std::to_string(step) + "; its tables and examples are of all.";
  return {{"about", about},
          {"questions", questions_json(report.questions)},
          {"contenders", std::move(contenders)},
          {"summaries", std::move(sums)},
          {"families", families.all()},
          {"distances", distances.all()},
          {"rows", std::move(rows)},
          {"examples", examples_json(report.examples, views)}};
}

}  // namespace

std::string in_element(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
    if (c == '<') text += "\\u003c";
    else text += c;
  return text;
}

std::string report_page(const Report& report, const std::string& viewer) {
  const Json views = viewer.empty() ? Json::array() : views_json(report.examples);
  return std::string("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">") +
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">" +
         "<title>sightline report: speed against error</title><style>" + page_style + "</style></head>\n<body>" +
         page_frame + "<script id=\"data\" type=\"application/json\">" + in_element(page_data(report, views)) +
         "</script>\n<script>" + page_script + "</script>\n" +
         (viewer.empty()
              ? ""
              : "<script id=\"views\" type=\"application/json\">" + in_element(views) + "</script>\n" + viewer) +
         "</body></html>\n";
}

}  // namespace sightline::report
