// Counting what became of cases, and printing it.

#include "table.h"

#include <cmath>
#include <iostream>
#include <map>

namespace sightline::app {

/// Wrongly shown and wrongly hidden: rays or points, where these are wrong, else faces.
static std::array<std::size_t, 2> wrong_counts(const judge::Grade& grade) {
  if (grade.wrong_rays.empty() && grade.wrong_points.empty())
    return {grade.wrong_visible.size(), grade.wrong_hidden.size()};
  std::array<std::size_t, 2> counts{};
  for (const judge::Wrong_ray& ray : grade.wrong_rays) {
    counts[0] += ray.said.has_value();
    counts[1] += !ray.nothing;
  }
  for (const judge::Wrong_point& point : grade.wrong_points) ++counts[point.is_held() ? 0 : 1];
  return counts;
}

Json sums_of(const std::vector<const Judged*>& cases) {
  Json row;
  std::array<std::size_t, judge::mark_names.size()> marks{};
  std::size_t not_asked = 0, judged = 0, wrong_visible = 0, wrong_hidden = 0, abstained = 0, breaches = 0;
  std::vector<double> seconds;
  std::uint64_t bytes = 0;
  std::map<std::string, double> errors;  // of solids: the largest, as shares
  for (const Judged* c : cases) {
    if (!c->not_asked.empty()) {
      ++not_asked;
      continue;
    }
    ++marks[static_cast<std::size_t>(c->mark)];
    breaches += c->breaks;
    judged += c->grade.judged;
    const auto [visible, hidden] = wrong_counts(c->grade);
    wrong_visible += visible;
    wrong_hidden += hidden;
    if (c->answer.surface) {
      double &volume = errors["volume"], &area = errors["area"];
      volume = std::max(volume, std::fabs(c->grade.volume_error));
      area = std::max(area, std::fabs(c->grade.area_error));
    }
    abstained += c->grade.abstained.size();
    seconds.push_back(c->seconds);
    bytes = std::max(bytes, c->bytes);
  }
  row["asked"] = cases.size() - not_asked;
  row["not_asked"] = not_asked;
  for (std::size_t k = 0; k < judge::mark_names.size(); ++k) row["cases"][std::string(judge::mark_names[k])] = marks[k];
  row["breaches"] = breaches;
  row["faces"] = {
      {"judged", judged}, {"wrong_visible", wrong_visible}, {"wrong_hidden", wrong_hidden}, {"abstained", abstained}};
  if (!errors.empty()) row["errors"] = errors;
  std::sort(seconds.begin(), seconds.end());
  const auto percentile = [&](double share) {
    return seconds.empty()
               ? Json()
               : Json(seconds[std::min(seconds.size() - 1,
                                       static_cast<std::size_t>(share * static_cast<double>(seconds.size())))]);
  };
  row["seconds"] = {{"p50", percentile(0.5)}, {"p95", percentile(0.95)}, {"max", percentile(1)}};
  row["bytes"] = bytes;
  return row;
}

void print_table(const Json& document) {
  const std::string line =
      "{:<26} {:<8} {:>5} {:>5} {:>5} {:>9} {:>7} {:>7} {:>9} {:>6} {:>13} {:>12} {:>8} {:>8} {:>8} {:>7}\n";
  std::cout << fmt::format(fmt::runtime(line), "family", "distance", "asked", "right", "wrong", "abstained", "invalid",
                           "crashed", "timed out", "memory", "wrong visible", "wrong hidden", "p50 s", "p95 s", "max s",
                           "max MB");
  const auto print = [&](const Json& r) {
    const Json &cases = r["cases"], &faces = r["faces"];
    const auto count = [](const Json& value) { return value == 0 ? std::string("-") : to_text(value); };
    const auto seconds = [&](const char* key) {
      return r["seconds"][key].is_null() ? std::string("-") : fmt::format("{:.3f}", r["seconds"][key].get<double>());
    };
    std::cout << fmt::format(fmt::runtime(line), r["family"].get<std::string>(), r["distance"].get<std::string>(),
                             count(r["asked"]), count(cases["right"]), count(cases["wrong"]), count(cases["abstained"]),
                             count(cases["invalid"]), count(cases["crashed"]), count(cases["timed out"]),
                             count(cases["out of memory"]), count(faces["wrong_visible"]), count(faces["wrong_hidden"]),
                             seconds("p50"), seconds("p95"), seconds("max"),
                             fmt::format("{:.0f}", r["bytes"].get<double>() / 1e6));
    if (r.contains("errors") && (r["errors"]["volume"] != 0 || r["errors"]["area"] != 0))
      std::cout << fmt::format("    off by, at most: volume {:.2g}, area {:.2g} of the exact one\n",
                               r["errors"]["volume"].get<double>(), r["errors"]["area"].get<double>());
  };
  for (const Json& r : document["result"]["rows"]) print(r);
  print(document["result"]["total"]);
}

/// What refutes a case, and how much of it is wrong.
static void print_explained(const Json& of) {
  if (!of.contains("explained")) return;
  const Json& why = of["explained"];
  if (!why["line"].is_null()) std::cout << fmt::format("  refuted: {}\n", why["line"]["words"].get<std::string>());
  std::cout << fmt::format("  wrong: {}\n", why["share_words"].get<std::string>());
}

/// What became of cases at each distance: marks that there are none of have no column.
static void print_distances(const Json& rows, const Json& total) {
  std::vector<std::string> marks;
  for (const char* mark : {"right", "wrong", "abstained", "invalid", "crashed", "timed out", "out of memory"})
    if (marks.size() < 2 || total["cases"][mark] != 0) marks.push_back(mark);
  std::cout << fmt::format("{:<8} {:>5}", "distance", "asked");
  for (const std::string& mark : marks)
    std::cout << fmt::format(" {:>{}}", mark, std::max<std::size_t>(mark.size(), 5));
  std::cout << '\n';
  for (const Json& row : rows) {
    const auto count = [](const Json& value) { return value == 0 ? std::string("-") : to_text(value); };
    std::cout << fmt::format("{:<8} {:>5}", row["distance"].get<std::string>(), count(row["asked"]));
    for (const std::string& mark : marks)
      std::cout << fmt::format(" {:>{}}", count(row["cases"][mark]), std::max<std::size_t>(mark.size(), 5));
    std::cout << '\n';
  }
}

std::string what_holds(const Json& total) {
  const auto count = [&](const char* mark) { return total["cases"][mark].get<std::size_t>(); };
  const std::size_t asked = total["asked"].get<std::size_t>();
  const std::size_t answered = count("right") + count("wrong");  // wrong as the contract allows
  if (answered == asked) return fmt::format("holds in all {} cases", asked);
  std::string words = fmt::format("is not broken in {} cases: {} answered", asked, answered);
  for (const char* mark : {"abstained", "timed out", "out of memory"})
    if (count(mark) != 0) words += fmt::format(", {} {}", count(mark), mark);
  return words;
}

void print_verdict(const Json& document) {
  const Json &result = document["result"], &total = result["total"];
  for (const auto& [reason, count] : result["not_asked"].items())
    std::cout << fmt::format("not asked: {} cases, as {}\n", count.get<std::size_t>(), reason);
  if (!result["smallest"].is_null()) {
    const Json& s = result["smallest"];
    std::cout << fmt::format("the smallest that breaks it: {} {}, seed {}, {} faces: {}: {}\n",
                             s["family"].get<std::string>(), s["distance"].get<std::string>(),
                             s["seed"].get<std::uint64_t>(), s["faces"].get<std::size_t>(),
                             s["mark"].get<std::string>(), s["why"].get<std::string>());
    print_explained(s);
    if (s.contains("guess"))
      for (const Json& guess : s["guess"]) std::cout << fmt::format("  guess: {}\n", guess.get<std::string>());
    for (const Json& file : s["files"]) std::cout << fmt::format("  kept: {}\n", file.get<std::string>());
    std::cout << fmt::format("  again: {}\n", s["again"].get<std::string>());
    if (s.contains("reduced")) {
      const Json& r = s["reduced"];
      std::cout << fmt::format("made smaller, to {} of {} faces in {} runs{}: {}: {}\n", r["faces"].get<std::size_t>(),
                               s["faces"].get<std::size_t>(), r["runs"].get<std::size_t>(),
                               r["finished"] == true ? "" : ", not to the end", r["mark"].get<std::string>(),
                               r["why"].get<std::string>());
      print_explained(r);
      for (const Json& file : r["files"]) std::cout << fmt::format("  kept: {}\n", file.get<std::string>());
      std::cout << fmt::format("  again: {}\n", r["again"].get<std::string>());
    }
  }
  if (result["by_distance"].size() > 1) print_distances(result["by_distance"], total);
  for (const Json& guess : result["guess"]) std::cout << fmt::format("guess: {}\n", guess.get<std::string>());
  const std::string contract = document["contract"].get<std::string>();
  if (total["asked"] == 0) std::cout << "nothing was asked\n";
  else if (total["breaches"] == 0) std::cout << fmt::format("the contract `{}` {}\n", contract, what_holds(total));
  else
    std::cout << fmt::format("the contract `{}` is BROKEN in {} of {} cases\n", contract,
                             total["breaches"].get<std::size_t>(), total["asked"].get<std::size_t>());
}

}  // namespace sightline::app
