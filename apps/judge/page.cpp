// The page of `sightline judge`.

#include "page.h"

namespace sightline::app {

namespace {

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text)
    safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return safe;
}
std::string text_of(const Json& value) { return escaped(value.get<std::string>()); }

/// What may become of a case, in the order of the bars, with its colour.
struct Mark_colour {
  const char *mark, *colour;
};
constexpr Mark_colour colours[] = {{"right", "#3a923a"},         {"abstained", "#9ecae1"}, {"timed out", "#c7b299"},
                                   {"out of memory", "#8c6d31"}, {"wrong", "#e6872d"},     {"invalid", "#b05ab0"},
                                   {"crashed", "#c22f2f"}};

constexpr const char* style = R"(
body { font: 14px/1.4 sans-serif; margin: 24px auto; max-width: 1340px; color: #222 }
h1, p { overflow-wrap: anywhere }
h1 { font-size: 22px; margin-bottom: 4px } h2 { font-size: 17px; margin-top: 28px }
code { background: #f2f2f2; padding: 1px 4px; font-size: 13px; overflow-wrap: anywhere }
.verdict { font-size: 17px; font-weight: bold; padding: 8px 12px; border-radius: 4px; display: inline-block }
.holds { background: #dff0df } .broken { background: #f7dcd5 }
table { border-collapse: collapse } td, th { padding: 2px 5px; text-align: right; border-bottom: 1px solid #e4e4e4; white-space: nowrap }
th { background: #fafafa; font-weight: 600; white-space: normal; vertical-align: bottom } td.name, th.name { text-align: left } td.why { text-align: left; white-space: normal; overflow-wrap: anywhere } td.name { max-width: 220px; overflow-wrap: anywhere; white-space: normal }
svg.scene, .why svg, .smallest svg { display: block; margin: 6px 0; max-width: 100%; height: auto }
tr.total td { font-weight: 600; border-top: 2px solid #888 } td.bad { color: #b02a1a; font-weight: 600 }
.key span { display: inline-block; width: 12px; height: 12px; margin: 0 4px 0 14px; vertical-align: -1px }
)";

/// The shares of what became of the cases of a row.
std::string bar(const Json& row) {
  constexpr double width = 100;
  const double asked = row["asked"].get<double>();
  std::string svg =
      fmt::format("<svg width=\"{:.0f}\" height=\"12\"><rect width=\"100%\" height=\"12\" fill=\"#f0f0f0\"/>", width);
  double at = 0;
  for (const auto& [mark, colour] : colours) {
    const double share = asked == 0 ? 0 : width * row["cases"][mark].get<double>() / asked;
    if (share > 0)
      svg += fmt::format("<rect x=\"{:.2f}\" width=\"{:.2f}\" height=\"12\" fill=\"{}\"><title>{}: {}</title></rect>",
                         at, share, colour, mark, row["cases"][mark].get<std::size_t>());
    at += share;
  }
  return svg + "</svg>";
}

/// The line that refutes, the share that is wrong, the picture: where they are known.
std::string explained(const Json& of) {
  if (!of.contains("explained")) return "";
  const Json& why = of["explained"];
  std::string html = "<p>";
  if (!why["line"].is_null()) html += text_of(why["line"]["words"]) + ".<br>";
  std::string picture = why["picture"].get<std::string>();
  constexpr std::string_view name_space = " xmlns=\"http://www.w3.org/2000/svg\"";  // within a page it is known
  if (const std::size_t at = picture.find(name_space); at != std::string::npos) picture.erase(at, name_space.size());
  return html + text_of(why["share_words"]) + ".</p>\n" + picture;
}

std::string table_row(const Json& row, bool is_total) {
  const auto count = [](const Json& value, bool bad) {
    return fmt::format("<td{}>{}</td>", bad && value != 0 ? " class=\"bad\"" : "", value == 0 ? "" : to_text(value));
  };
  const auto seconds = [&](const char* key) {
    return row["seconds"][key].is_null() ? std::string("<td></td>")
                                         : fmt::format("<td>{:.3f}</td>", row["seconds"][key].get<double>());
  };
  const Json &cases = row["cases"], &faces = row["faces"];
  std::string html =
      fmt::format("<tr{}><td class=\"name\">{}</td><td class=\"name\">{}</td><td>{}</td>",
                  is_total ? " class=\"total\"" : "", text_of(row["family"]), text_of(row["distance"]), bar(row));
  html += count(row["asked"], false);
  for (const char* mark : {"right", "abstained", "timed out", "out of memory"}) html += count(cases[mark], false);
  for (const char* mark : {"wrong", "invalid", "crashed"}) html += count(cases[mark], true);
  html += count(faces["judged"], false) + count(faces["wrong_visible"], true) + count(faces["wrong_hidden"], true) +
          count(faces["abstained"], false);
  return html + seconds("p50") + seconds("p95") + seconds("max") +
         fmt::format("<td>{:.0f}</td></tr>\n", row["bytes"].get<double>() / 1e6);
}

std::string smallest_html(const Json& s) {
  std::string html = fmt::format(
      "<div class=\"smallest\"><p>The smallest that breaks it: {} ({}), seed {}, {} faces: {}: {}.<br>Again: "
      "<code>{}</code></p>\n{}",
      text_of(s["family"]), text_of(s["distance"]), s["seed"].get<std::uint64_t>(), s["faces"].get<std::size_t>(),
      text_of(s["mark"]), text_of(s["why"]), text_of(s["again"]), explained(s));
  if (s.contains("guess"))
    for (const Json& guess : s["guess"]) html += "<p>A guess: " + text_of(guess) + ".</p>\n";
  if (s.contains("reduced"))
    html += fmt::format("<p>Made smaller, it has {} faces: {}: {}.<br>Again: <code>{}</code></p>\n{}",
                        s["reduced"]["faces"].get<std::size_t>(), text_of(s["reduced"]["mark"]),
                        text_of(s["reduced"]["why"]), text_of(s["reduced"]["again"]), explained(s["reduced"]));
  return html + "</div>\n";
}

/// What was asked, whether the contract holds, and the smallest case that breaks it.
std::string verdict_html(const Json& document) {
  const Json &result = document["result"], &total = result["total"];
  std::string html =
      fmt::format("<h1>{}</h1>\n<p>asked <b>{}</b>{}, promises <b>{}</b>; at most {} s and {:.0f} MB a case</p>\n",
                  text_of(document["program"]), text_of(document["query"]),
                  document["two_sided"] == true ? ", two-sided" : "", text_of(document["contract"]),
                  document["limits"]["seconds"].get<double>(), document["limits"]["bytes"].get<double>() / (1 << 20));
  html += total["asked"] == 0 ? "<p class=\"verdict broken\">Nothing was asked.</p>\n"
          : result["holds"].get<bool>()
              ? fmt::format("<p class=\"verdict holds\">The contract holds in all {} cases.</p>\n",
                            total["asked"].get<std::size_t>())
              : fmt::format("<p class=\"verdict broken\">The contract is broken in {} of {} cases.</p>\n",
                            total["breaches"].get<std::size_t>(), total["asked"].get<std::size_t>());
  if (!result["smallest"].is_null()) html += smallest_html(result["smallest"]);
  for (const Json& guess : result["guess"]) html += "<p>A guess: " + text_of(guess) + ".</p>\n";
  return html;
}

/// What became of the cases, by family and distance.
std::string cases_html(const Json& result) {
  std::string html = "<h2>Cases</h2>\n<p class=\"key\">";
  for (const auto& [mark, colour] : colours)
    html += fmt::format("<span style=\"background:{}\"></span>{}", colour, mark);
  html += "</p>\n<table><tr><th class=\"name\">family</th><th class=\"name\">distance</th><th></th>";
  for (const char* head :
       {"asked", "right", "abstained", "timed out", "memory", "wrong", "invalid", "crashed", "faces judged",
        "wrong visible", "wrong hidden", "left open", "p50 s", "p95 s", "max s", "max MB"})
    html += fmt::format("<th>{}</th>", head);
  html += "</tr>\n";
  for (const Json& row : result["rows"]) html += table_row(row, false);
  html += table_row(result["total"], true) + "</table>\n";
  if (result["by_distance"].size() > 1) {
    html +=
        "<h2>By distance from degeneracy</h2>\n<table><tr><th class=\"name\">distance</th><th></th><th>asked</th>"
        "<th>right</th><th>wrong</th></tr>\n";
    for (const Json& row : result["by_distance"])
      html += fmt::format("<tr><td class=\"name\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                          text_of(row["distance"]), bar(row), to_text(row["asked"]), to_text(row["cases"]["right"]),
                          to_text(row["cases"]["wrong"]));
    html += "</table>\n";
  }
  for (const auto& [reason, count] : result["not_asked"].items())
    html += fmt::format("<p>Not asked: {} cases, as {}.</p>\n", count.get<std::size_t>(), escaped(reason));
  return html;
}

/// What broke the contract, the smallest first.
std::string failures_html(const Json& all) {
  if (all.empty()) return "";
  constexpr std::size_t shown = 40;
  std::vector<const Json*> failures;
  for (const Json& failure : all) failures.push_back(&failure);
  std::stable_sort(failures.begin(), failures.end(),
                   [](const Json* a, const Json* b) { return (*a)["faces"] < (*b)["faces"]; });
  std::string html =
      "<h2>What broke the contract</h2>\n<table><tr><th class=\"name\">family</th><th "
      "class=\"name\">distance</th><th>seed</th><th>faces</th><th class=\"name\">case</th><th class=\"name\">why, "
      "and how to ask it again</th></tr>\n";
  for (std::size_t i = 0; i < std::min(failures.size(), shown); ++i) {
    const Json& f = *failures[i];
    html += fmt::format(
        "<tr><td class=\"name\">{}</td><td class=\"name\">{}</td><td>{}</td><td>{}</td><td class=\"name\">{}</td><td "
        "class=\"why\">{}<br><code>{}</code>{}</td></tr>\n",
        text_of(f["family"]), text_of(f["distance"]), f["seed"].get<std::uint64_t>(), f["faces"].get<std::size_t>(),
        text_of(f["mark"]), text_of(f["why"]), text_of(f["again"]), explained(f));
  }
  html += "</table>\n";
  if (failures.size() > shown)
    html += fmt::format("<p>And {} more: --json has them all.</p>\n", failures.size() - shown);
  return html;
}

}  // namespace

std::string judge_page(const Json& document) {
  const Json& result = document["result"];
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>sightline judge</title><style>" +
         std::string(style) + "</style></head><body>\n" + verdict_html(document) + cases_html(result) +
         failures_html(result["failures"]) + "</body></html>\n";
}

}  // namespace sightline::app
