// A case that is answered wrongly, as a scene to turn around.

#include "view.h"

#include "../support/page.h"
#include "picture.h"

namespace sightline::app {

namespace {

/// Faces that are something else than the others: a group's name, its colour's role, and whose it is.
struct Face_group {
  std::string name, role;
  std::vector<Face_id> faces;
};

/// What of an answer is wrong; in orders one pair, as all of them may be most of the scene.
std::vector<Face_group> groups_of_wrong(judge::Question question, const judge::Grade& grade,
                                        const judge::Explanation& why, const Wrong_words& words) {
  std::vector<Face_id> hidden = grade.wrong_hidden, visible = grade.wrong_visible;
  if (!grade.wrong_pairs.empty()) {
    const bool known = why.refutation && why.refutation->over;
    hidden = {known ? why.refutation->face : grade.wrong_pairs[0][0]};
    visible = {known ? *why.refutation->over : grade.wrong_pairs[0][1]};
  }
  std::vector<Face_group> groups{{words.hidden, "front", hidden}, {words.visible, "open", visible}};
  if (why.refutation && why.refutation->by) groups.push_back({"in the way", "other", {*why.refutation->by}});
  if (question == judge::Question::see || question == judge::Question::weak)
    groups.push_back({"left open", "new", grade.abstained});
  std::erase_if(groups, [](const Face_group& group) { return group.faces.empty(); });
  return groups;
}

/// How far from a scene a place may be that is shown beside it: four times its longest side.
Rational reach_of(const Scene& scene) {
  const auto box = scene.box();
  Rational size = 0;
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, Rational(box[1][k] - box[0][k]));
  return 4 * size;
}

Rational distance(const Exact_point& p, const Exact_point& q) {
  Rational most = 0;
  for (std::size_t k = 0; k < 3; ++k) most = std::max(most, Rational(abs(p[k] - q[k])));
  return most;
}

/// Of a line to a place the part within reach of it: where that begins.
Exact_point begin_of_line(const Exact_point& from, const Exact_point& to, const Rational& reach) {
  const Rational length = distance(from, to);
  if (length <= reach) return from;
  Exact_point begin;
  for (std::size_t k = 0; k < 3; ++k) begin[k] = to[k] + (from[k] - to[k]) * reach / length;
  return begin;
}

void note_what_is_set_aside(const Scene& scene, Page& page) {
  constexpr std::size_t most = 5;
  std::size_t count = 0;
  for (const Set_aside& entry : scene.set_aside())
    if (count++ < most) page.add_note(fmt::format("face {} is not drawn: {}", entry.face, entry.why));
  if (count > most) page.add_note(fmt::format("nor are {} more", count - most));
}

}  // namespace

Json view_of(const std::string& command, const std::string& question, const Polygon_soup& soup,
             const judge::Query& query, const judge::Grade& grade, const judge::Explanation& why,
             const Wrong_words& words) {
  constexpr std::size_t most_triangles = 3000;
  if (soup.point_count() == 0) return nullptr;
  const Scene scene(soup);
  Page page(command, scene, most_triangles);
  page.add_fact("asked", question);
  if (question == "boolean") page.add_fact("operation", judge::to_json(query)["operation"].get<std::string>());
  page.add_fact("faces", fmt::format("{}", soup.face_count()));
  if (grade.wrong_pairs.size() > 1)
    page.add_fact("in the wrong order", fmt::format("{} pairs, one of them shown", grade.wrong_pairs.size()));
  note_what_is_set_aside(scene, page);

  // 1. Faces, the first group that holds one; and the source, after all of them.
  const std::vector<Face_group> groups = groups_of_wrong(query.question, grade, why, words);
  for (const Face_group& group : groups) page.add_group(group.name, group.role, true);
  page.add_group(grade.wrong() ? "right" : "faces", grade.wrong() ? "face" : "one a face");
  page.add_pieces(scene, [&](std::uint32_t piece) {
    const Face_id face = scene.pieces()[piece].face;
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const Face_group& group) {
      return std::find(group.faces.begin(), group.faces.end(), face) != group.faces.end();
    });
    return static_cast<std::uint32_t>(found - groups.begin());
  });
  std::vector<Exact_point> shown;
  if (question == "weak") {
    page.add_group("source", "source");
    page.add_polygon(Page::no_face, query.source, static_cast<std::uint32_t>(groups.size() + 1));
    shown = query.source;
  }

  // 2. Who looks, and the line; of what is far away only its direction is in view at first.
  const Rational reach = reach_of(scene);
  if (question == "order" || question == "see" || question == "render" || question == "cutset" || question == "pvs") {
    page.set_eye(query.eye);
    page.add_fact(question == "pvs" ? "in the cell" : "eye", Page::text(query.eye));
    shown.push_back(query.eye);
  }
  if (why.refutation) {
    const judge::Refutation& line = *why.refutation;
    const Exact_point from = begin_of_line(line.from, line.to, reach);
    page.more()["refutation"] = {{"from", page.place(from)},
                                 {"to", page.place(line.to)},
                                 {"at", line.at ? page.place(*line.at) : Json()},
                                 {"words", line.words}};
    shown.insert(shown.end(), {from, line.to});
    const auto [x, y, z] = look_at_front(scene, why);
    page.more()["away"] = {-x, -y, -z};
  }
  std::vector<float> around;
  for (const Exact_point& p : shown)
    if (distance(p, scene.box()[0]) <= 2 * reach) page.append_place(around, p);
  if (!around.empty()) page.more()["around"] = packed(around);
  return page.data();
}

}  // namespace sightline::app
