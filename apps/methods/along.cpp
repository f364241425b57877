#include "along.h"

#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/weak_visibility/along/along.h>
#include <sightline/algorithms/weak_visibility/along/certificate.h>
#include <sightline/kernel/scene/scene.h>

#include <sstream>

namespace sightline::app {

namespace {

std::array<Exact_point, 2> path_of(const std::string& text) {
  std::istringstream words(text);
  std::vector<Exact_point> points;
  for (std::string word; words >> word;) points.push_back(parse_point(word, "--along"));
  if (points.size() != 2)
    throw Usage_error("--along wants two points, \"X,Y,Z X,Y,Z\": where the eye's way begins and ends");
  if (points[0] == points[1]) throw Usage_error("--along: both points are the same; `sightline see` looks from one");
  return {points[0], points[1]};
}

/// A fraction, or a quadratic and fractions between which it has this root alone.
Json moment_json(const Quadratic_root& t) {
  if (const std::optional<Rational> root = t.rational()) return {{"root", to_string(*root)}, {"near", t.near()}};
  const Quadratic f = t.polynomial();
  const auto [low, high] = t.bounds();
  return {{"quadratic", {to_string(f.c[2]), to_string(f.c[1]), to_string(f.c[0])}},
          {"low", to_string(low)},
          {"high", to_string(high)},
          {"near", t.near()}};
}

struct Change_lists {
  std::vector<Face_id> appear, disappear, seen_now, hidden_now;
};
Change_lists lists_of(const Along_event& event) {
  Change_lists lists;
  for (const Along_event::Change& change : event.changes)
    (change.before != change.after ? change.after ? lists.appear : lists.disappear
     : change.at                   ? lists.seen_now
                                   : lists.hidden_now)
        .push_back(change.face);
  return lists;
}

Json event_json(const Scene& scene, const Along_event& event) {
  const Change_lists lists = lists_of(event);
  Json changes = Json::array();
  bool same = true;
  for (const Along_event::Change& change : event.changes) {
    same &= change.kind == event.changes[0].kind;
    Json edges = Json::array();
    for (const auto& [piece, corner] : change.edges)
      edges.push_back(
          {{"face", scene.pieces()[piece].face}, {"piece", scene.pieces()[piece].number}, {"corner", corner}});
    changes.push_back({{"face", change.face},
                       {"kind", name(change.kind)},
                       {"visible", {change.before, change.at, change.after}},
                       {"edges", std::move(edges)}});
  }
  return {{"t", moment_json(event.t)},
          {"kind", same ? name(event.changes[0].kind) : "several"},
          {"appear", lists.appear},
          {"disappear", lists.disappear},
          {"momentary", {{"visible", lists.seen_now}, {"hidden", lists.hidden_now}}},
          {"changes", std::move(changes)}};
}

std::string listed(const std::vector<Face_id>& faces) {
  constexpr std::size_t most = 12;
  std::string text;
  for (std::size_t k = 0; k < faces.size() && k < most; ++k) text += fmt::format(" {}", faces[k]);
  return faces.size() > most ? fmt::format("{} and {} more", text, faces.size() - most) : text;
}

/// A line for each face that is seen at all, orange when it is seen, from left to right; events as upright lines.
std::string timeline(const Visible_along& found) {
  constexpr double left = 70, width = 760, top = 44, step = 9, bar = 7;
  std::vector<const Visible_along::Face*> rows;
  for (const Visible_along::Face& face : found.faces)
    if (!face.seen.empty() || !face.moments.empty()) rows.push_back(&face);
  const double height = top + step * static_cast<double>(rows.size()) + 14;
  const auto x = [&](double t) { return left + width * t; };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      left + width + 20, height);
  svg += fmt::format(
      "<text x=\"12\" y=\"20\" font-size=\"13\">orange: the face is seen from the point t of the path; red: events, "
      "{} of them</text>\n",
      found.events.size());
  for (int k = 0; k <= 4; ++k)
    svg += fmt::format("<text x=\"{:.1f}\" y=\"38\" font-size=\"10\" text-anchor=\"middle\">{}</text>\n", x(k / 4.0),
                       k / 4.0);
  double y = top;
  for (const Visible_along::Face* face : rows) {
    svg += fmt::format("<g id=\"face-{0}\"><title>face {0}</title>\n", face->face);
    svg += fmt::format("<text x=\"{:.0f}\" y=\"{:.1f}\" font-size=\"8\" text-anchor=\"end\">face {}</text>\n", left - 8,
                       y + bar, face->face);
    svg += fmt::format("<rect x=\"{:.0f}\" y=\"{:.1f}\" width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#ececf0\"/>\n", left,
                       y, width, bar);
    for (const Parameter_range& range : face->seen)
      svg += fmt::format("<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.0f}\" fill=\"#e59a3c\"/>\n",
                         x(range.low.near()), y, width * (range.high.near() - range.low.near()), bar);
    svg += "</g>\n";
    y += step;
  }
  for (const Along_event& event : found.events)
    svg += fmt::format(
        "<line x1=\"{0:.2f}\" x2=\"{0:.2f}\" y1=\"{1:.0f}\" y2=\"{2:.1f}\" stroke=\"#c02030\" stroke-width=\"0.6\">"
        "<title>t = {3}</title></line>\n",
        x(event.t.near()), top - 3, y, event.t.near());
  return svg + "</svg>\n";
}

}  // namespace

Exit run_along(const Common& common, const Along_arguments& arguments) {
  const std::array<Exact_point, 2> path = path_of(arguments.path);
  const Scene scene = scene_of(common.read());
  Stopwatch watch;
  const Occluders occluders(scene);
  const double prepare_seconds = watch.seconds();
  watch = {};
  Progress progress("along the path");
  Along_options options;
  options.two_sided = arguments.two_sided;
  options.with_proofs = !arguments.certificate.empty();
  options.threads = common.threads;
  options.progress = common.within_budget(progress);
  const Visible_along found = visible_along(occluders, path[0], path[1], options);
  const double seconds = watch.seconds();
  progress.clear();

  if (options.with_proofs)
    write_file(arguments.certificate, [&](std::ostream& out) {
      write_certificate(out, along_certificate(scene, found, path[0], path[1], options.two_sided));
    });
  if (!arguments.svg.empty()) write_file(arguments.svg, timeline(found));
  Json events = Json::array();
  for (const Along_event& event : found.events) events.push_back(event_json(scene, event));
  Json along{{"from", point_json(path[0])},        {"to", point_json(path[1])},      {"events", std::move(events)},
             {"visible_at_start", found.at_start}, {"visible_at_end", found.at_end}, {"visible", found.visible}};
  if (write_json(common, "weak", scene, {{"along", std::move(along)}}, counters_json(found.counters),
                 {{"prepare", prepare_seconds}, {"search", seconds}}))
    return Exit::done;
  scene_rows(scene);
  row("at the start", fmt::format("{} of {} faces visible", found.at_start.size(), scene.counters().faces));
  row("on the way", fmt::format("{}, {} at its end", found.visible.size(), found.at_end.size()));
  row("events", fmt::format("{}: exactly with --json", found.events.size()));
  constexpr std::size_t most_rows = 24;
  for (std::size_t k = 0; k < found.events.size() && k < most_rows; ++k) {
    const Along_event& event = found.events[k];
    const std::optional<Rational> root = event.t.rational();
    const Change_lists lists = lists_of(event);
    std::string text = root && to_string(*root).size() <= 12 ? to_string(*root) : fmt::format("{:.9g}", event.t.near());
    text += fmt::format("{}, {}", root ? "" : " (quadratic)", name(event.changes[0].kind));
    if (!lists.appear.empty()) text += "; appear" + listed(lists.appear);
    if (!lists.disappear.empty()) text += "; disappear" + listed(lists.disappear);
    if (!lists.seen_now.empty()) text += "; just now seen" + listed(lists.seen_now);
    if (!lists.hidden_now.empty()) text += "; just now hidden" + listed(lists.hidden_now);
    row("t =", text);
  }
  if (found.events.size() > most_rows) row("", fmt::format("and {} more", found.events.size() - most_rows));
  row("runs",
      fmt::format("{}, {} points that see for a while; {} parts, {} signs, {} of them in integers", found.counters.runs,
                  found.counters.witnesses, found.counters.parts, found.counters.signs, found.counters.exact_signs));
  row("seconds", fmt::format("{:.4f}, and {:.4f} to prepare the scene", seconds, prepare_seconds));
  return Exit::done;
}

}  // namespace sightline::app
