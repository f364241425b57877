// The page of `sightline judge`.

#include "page.h"

#include "../support/page.h"
#include "table.h"

#include <sightline/harness/report/page.h>

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
:root { color-scheme: light dark; --paper: #ffffff; --ink: #222222; --line: #e0e0e0; --panel: #f4f4f4; --holds: #dff0df; --broken: #f7dcd5; --bad: #b02a1a; --accent: #0b63a5 }
@media (prefers-color-scheme: dark) { :root { --paper: #17181b; --ink: #ececea; --line: #383b41; --panel: #202226; --holds: #1f3a24; --broken: #4a2620; --bad: #ff8a70; --accent: #6cb8f0 } }
* { box-sizing: border-box }
body { font: 14px/1.4 sans-serif; margin: 0 auto; padding: 24px 24px 48px; max-width: 1388px; color: var(--ink); background: var(--paper) }
h1, p { overflow-wrap: anywhere }
h1 { font-size: 22px; margin: 0 0 4px } h2 { font-size: 17px; margin: 28px 0 8px } p { margin: 8px 0 }
code { background: var(--panel); padding: 1px 4px; font-size: 13px; overflow-wrap: anywhere }
.verdict { font-size: 17px; font-weight: bold; padding: 8px 12px; border-radius: 4px; display: inline-block }
.holds { background: var(--holds) } .broken { background: var(--broken) }
.scroll { overflow-x: auto } table { border-collapse: collapse } td, th { padding: 2px 5px; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap }
th { background: var(--panel); font-weight: 600; white-space: normal; vertical-align: bottom } td.name, th.name { text-align: left } td.name { min-width: 90px; max-width: 220px; overflow-wrap: anywhere; white-space: normal }
tr.total td { font-weight: 600; border-top: 2px solid #888 } td.bad { color: var(--bad); font-weight: 600 }
.key span { display: inline-block; width: 12px; height: 12px; margin: 0 4px 0 14px; vertical-align: -1px }
.smallest svg, .card svg { display: block; margin: 6px 0; max-width: 100%; height: auto; border-radius: 4px }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(300px, 100%), 1fr)); gap: 14px }
.card { border: 1px solid var(--line); border-radius: 7px; padding: 10px 12px; background: var(--panel); min-width: 0 } .card code { display: block; background: var(--paper); padding: 5px 7px }
button { font: inherit; color: var(--ink); background: var(--panel); border: 1px solid var(--line); border-radius: 5px; padding: 3px 10px; cursor: pointer } .card button { background: var(--paper) }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 1px }
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

/// The line that refutes, the share that is wrong, the picture, and a button for the scene in three dimensions, which
/// goes to `views`: where they are known.
std::string explained(const Json& of, Json& views) {
  if (!of.contains("explained")) return "";
  const Json& why = of["explained"];
  std::string html = "<p>";
  if (!why["line"].is_null()) html += text_of(why["line"]["words"]) + ".<br>";
  std::string picture = why["picture"].get<std::string>();
  constexpr std::string_view name_space = " xmlns=\"http://www.w3.org/2000/svg\"";  // within a page it is known
  if (const std::size_t at = picture.find(name_space); at != std::string::npos) picture.erase(at, name_space.size());
  html += text_of(why["share_words"]) + ".</p>\n" + picture;
  if (why["view"].is_null()) return html;
  views.push_back(why["view"]);
  return html +
         fmt::format("<button type=\"button\" data-view=\"{}\" aria-expanded=\"false\">turn it around</button>\n",
                     views.size() - 1);
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

std::string smallest_html(const Json& s, Json& views) {
  std::string html = fmt::format(
      "<div class=\"smallest\"><p>The smallest that breaks it: {} ({}), seed {}, {} faces: {}: {}.<br>Again: "
      "<code>{}</code></p>\n{}",
      text_of(s["family"]), text_of(s["distance"]), s["seed"].get<std::uint64_t>(), s["faces"].get<std::size_t>(),
      text_of(s["mark"]), text_of(s["why"]), text_of(s["again"]), explained(s, views));
  if (s.contains("guess"))
    for (const Json& guess : s["guess"]) html += "<p>A guess: " + text_of(guess) + ".</p>\n";
  if (s.contains("reduced"))
    html += fmt::format(
        "</div>\n<div class=\"smallest\"><p>Made smaller, it has {} faces: {}: {}.<br>Again: <code>{}</code></p>\n{}",
        s["reduced"]["faces"].get<std::size_t>(), text_of(s["reduced"]["mark"]), text_of(s["reduced"]["why"]),
        text_of(s["reduced"]["again"]), explained(s["reduced"], views));
  return html + "</div>\n";
}

/// What was asked, whether the contract holds, and the smallest case that breaks it.
std::string verdict_html(const Json& document, Json& views) {
  const Json &result = document["result"], &total = result["total"];
  std::string html =
      fmt::format("<h1>{}</h1>\n<p>asked <b>{}</b>{}, promises <b>{}</b>; at most {} s and {:.0f} MB a case</p>\n",
                  text_of(document["program"]), text_of(document["query"]),
                  document["two_sided"] == true ? ", two-sided" : "", text_of(document["contract"]),
                  document["limits"]["seconds"].get<double>(), document["limits"]["bytes"].get<double>() / (1 << 20));
  html += total["asked"] == 0 ? "<p class=\"verdict broken\">Nothing was asked.</p>\n"
          : result["holds"].get<bool>()
              ? fmt::format("<p class=\"verdict holds\">The contract {}.</p>\n", what_holds(total))
              : fmt::format("<p class=\"verdict broken\">The contract is broken in {} of {} cases.</p>\n",
                            total["breaches"].get<std::size_t>(), total["asked"].get<std::size_t>());
  if (!result["smallest"].is_null()) html += smallest_html(result["smallest"], views);
  for (const Json& guess : result["guess"]) html += "<p>A guess: " + text_of(guess) + ".</p>\n";
  return html;
}

/// What became of the cases, by family and distance.
std::string cases_html(const Json& result) {
  std::string html = "<h2>Cases</h2>\n<p class=\"key\">";
  for (const auto& [mark, colour] : colours)
    html += fmt::format("<span style=\"background:{}\"></span>{}", colour, mark);
  html +=
      "</p>\n<div class=\"scroll\"><table><tr><th class=\"name\">family</th><th class=\"name\">distance</th><th></th>";
  for (const char* head :
       {"asked", "right", "abstained", "timed out", "memory", "wrong", "invalid", "crashed", "faces judged",
        "wrong visible", "wrong hidden", "left open", "p50 s", "p95 s", "max s", "max MB"})
    html += fmt::format("<th>{}</th>", head);
  html += "</tr>\n";
  for (const Json& row : result["rows"]) html += table_row(row, false);
  html += table_row(result["total"], true) + "</table></div>\n";
  if (result["by_distance"].size() > 1) {
    html +=
        "<h2>By distance from degeneracy</h2>\n<div class=\"scroll\"><table><tr><th "
        "class=\"name\">distance</th><th></th><th>asked</th>"
        "<th>right</th><th>wrong</th></tr>\n";
    for (const Json& row : result["by_distance"])
      html += fmt::format("<tr><td class=\"name\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                          text_of(row["distance"]), bar(row), to_text(row["asked"]), to_text(row["cases"]["right"]),
                          to_text(row["cases"]["wrong"]));
    html += "</table></div>\n";
  }
  for (const auto& [reason, count] : result["not_asked"].items())
    html += fmt::format("<p>Not asked: {} cases, as {}.</p>\n", count.get<std::size_t>(), escaped(reason));
  return html;
}

/// What broke the contract, the smallest first: a card each.
std::string failures_html(const Json& all, Json& views) {
  if (all.empty()) return "";
  constexpr std::size_t shown = 40;
  std::vector<const Json*> failures;
  for (const Json& failure : all) failures.push_back(&failure);
  std::stable_sort(failures.begin(), failures.end(),
                   [](const Json* a, const Json* b) { return (*a)["faces"] < (*b)["faces"]; });
  std::string html = "<h2>What broke the contract, and how to ask it again</h2>\n<div class=\"cards\">\n";
  for (std::size_t i = 0; i < std::min(failures.size(), shown); ++i) {
    const Json& f = *failures[i];
    html += fmt::format(
        "<div class=\"card\"><b>{}</b> ({}), seed {}, {} faces: {}: {}.\n{}<p><code>{}</code></p></div>\n",
        text_of(f["family"]), text_of(f["distance"]), f["seed"].get<std::uint64_t>(), f["faces"].get<std::size_t>(),
        text_of(f["mark"]), text_of(f["why"]), explained(f, views), text_of(f["again"]));
  }
  html += "</div>\n";
  if (failures.size() > shown)
    html += fmt::format("<p>And {} more: --json has them all.</p>\n", failures.size() - shown);
  return html;
}

}  // namespace

std::string judge_page(const Json& document) {
  const Json& result = document["result"];
  Json views = Json::array();
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>sightline judge</title><style>" +
      std::string(style) + "</style></head><body>\n" + verdict_html(document, views) + cases_html(result) +
      failures_html(result["failures"], views);
  if (!views.empty())
    html +=
        "<script type=\"application/json\" id=\"views\">" + report::in_element(views) + "</script>\n" + scenes_within();
  return html + "</body></html>\n";
}

}  // namespace sightline::app
