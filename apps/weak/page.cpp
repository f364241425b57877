#include "page.h"

#include "../support/page.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace sightline::app {

namespace {

/// Sightlines of visible faces: the pair's piece and source, the ends, and these exactly where they are few.
Json sightlines_json(Page& page, const Scene& scene, const Weakly_visible& found) {
  constexpr std::size_t most = 8000, most_texts = 600;
  std::vector<std::uint32_t> pieces, sources;
  std::vector<float> ends;
  std::vector<std::string> texts;
  for (const Weakly_visible::Pair& pair : found.pairs) {
    if (pair.answer.status != Weak_status::visible) continue;
    if (pieces.size() == most) {
      page.add_note(fmt::format("the sightlines of {} faces are shown, the others left out", most));
      break;
    }
    pieces.push_back(pair.piece);
    sources.push_back(pair.source);
    for (const Near_point& end : pair.answer.sightline) {
      const Exact_point at = scene.position(end.exact);
      page.append_place(ends, at);
      if (found.visible.size() <= most_texts) texts.push_back(Page::text(at));
    }
  }
  return {{"pieces", packed(pieces)}, {"sources", packed(sources)}, {"ends", packed(ends)}, {"texts", texts}};
}

/// Proofs as walks that take a node before its two parts: `kinds` as in Weak_step::Kind, of each the piece that blocks
/// or has the edge, and that edge's first corner; the steps of the n-th pair are begin[n] up to begin[n + 1].
Json proofs_json(Page& page, const Weakly_visible& found) {
  constexpr std::size_t most_steps = 60000;
  std::vector<std::uint32_t> pieces, sources, begin{0}, kinds, of, corners;
  std::size_t left_out = 0;
  for (const std::vector<Weakly_visible::Pair>* list : {&found.pairs, &found.open})
    for (const Weakly_visible::Pair& pair : *list) {
      const Weak_answer& answer = pair.answer;
      if (answer.status == Weak_status::visible) continue;
      if (kinds.size() + answer.all_steps().size() > most_steps) {
        ++left_out;
        continue;
      }
      pieces.push_back(pair.piece);
      sources.push_back(pair.source);
      for (const Weak_step& step : answer.all_steps()) {
        const bool is_line = step.kind == Weak_step::Kind::line;
        kinds.push_back(static_cast<std::uint32_t>(step.kind));
        of.push_back(is_line ? answer.all_lines()[step.index].piece : step.index);
        corners.push_back(is_line ? answer.all_lines()[step.index].corner : 0);
      }
      begin.push_back(static_cast<std::uint32_t>(kinds.size()));
    }
  if (left_out > 0)
    page.add_note(fmt::format("the proofs of {} pairs are too long for a page: --certificate writes them", left_out));
  return {{"pieces", packed(pieces)}, {"sources", packed(sources)}, {"begin", packed(begin)},
          {"kinds", packed(kinds)},   {"of", packed(of)},           {"corners", packed(corners)}};
}

/// Of two sorted lists.
std::vector<Face_id> in_both(const std::vector<Face_id>& faces, const std::vector<Face_id>& others) {
  std::vector<Face_id> both;
  std::set_intersection(faces.begin(), faces.end(), others.begin(), others.end(), std::back_inserter(both));
  return both;
}

}  // namespace

Json doubles_json(const Weakly_visible& found, const Weakly_visible& doubles) {
  return {{"missing", packed(in_both(found.visible, doubles.hidden))},
          {"extra", packed(in_both(found.hidden, doubles.visible))}};
}

void write_page(const Weak_arguments& arguments, const Scene& scene, const Sources& sources,
                const Weakly_visible& found, const std::vector<std::string>& names, Json doubles) {
  static const std::vector<std::string> groups{"visible", "hidden", "undecided", "source"};
  Page page("weak", scene);
  page.add_fact("faces", fmt::format("{}", scene.counters().faces));
  page.add_fact("sources", fmt::format("{} convex polygons", sources.points.size()));
  page.add_fact("visible", fmt::format("{}", found.visible.size()));
  page.add_fact("hidden", fmt::format("{}", found.hidden.size()));
  page.add_fact("undecided", fmt::format("{}", found.undecided.size()));
  page.add_fact("method", arguments.method);
  for (const auto& [name, role] :
       {std::pair("visible", "seen"), {"hidden", "hidden"}, {"undecided", "open"}, {"source", "source"}})
    page.add_group(name, role);
  page.add_pieces(scene, [&](std::uint32_t piece) {
    const std::string& name = names[scene.pieces()[piece].face];
    return static_cast<std::uint32_t>(std::find(groups.begin(), groups.end(), name) - groups.begin());
  });
  page.more()["base"] = page.polygons();
  for (const std::vector<Exact_point>& source : sources.points) page.add_polygon(Page::no_face, source, 3);
  page.more()["sightlines"] = sightlines_json(page, scene, found);
  page.more()["proofs"] = proofs_json(page, found);
  page.more()["doubles"] = std::move(doubles);
  page.write(arguments.html);
}

}  // namespace sightline::app
