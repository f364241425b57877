#include "contests.h"

namespace sightline::app::schema {

namespace {

/// Contestants. One that is done has all of these members; another one says in its status what became of it.
Json rows_of(const Members& names, const Members& more) {
  const Members who = with({{"kernel", type("string")}, {"method", type("string")}}, names);
  const Members done{{"status", {{"const", "done"}}}, {"seconds", type("number")}, {"peak_bytes", a_count()}};
  const Members open{{"status", {{"type", "string"}, {"not", {{"const", "done"}}}}}};
  return list_of(any_of({object(with(with(who, done), more)), object(with(who, open))}));
}

/// The result of compare for these questions.
Json answer_to(const std::vector<std::string>& questions, const Members& members) {
  return object(with(members, {{"question", one_word_of(questions)}}));
}

Json order_answer() {
  const Json count = a_count(), number = type("number"), pairs = any_of({count, type("null")});
  const Json errors = object({{"sides_asked?", count},
                              {"sides_wrong?", count},
                              {"sides_opposite?", count},
                              {"sides_false_zero?", count},
                              {"sides_missed_zero?", count},
                              {"fragments_degenerate?", count},
                              {"fragments_not_finite?", count},
                              {"pairs?", count},
                              {"pairs_wrong?", pairs},
                              {"pairs_wrong_beyond_rounding?", pairs},
                              {"area_lost?", a_double()},
                              {"area_overlapping?", a_double()},
                              {"area_outside?", a_double()},
                              {"tiles_exactly?", type("boolean")}});
  return answer_to({"order", "bsp"}, {{"rows", rows_of({}, {{"build_seconds", number},
                                                            {"order_seconds", number},
                                                            {"splits", count},
                                                            {"fragments", count},
                                                            {"depth", count},
                                                            {"predicates", type("object")},
                                                            {"errors", errors}})}});
}

Json see_answer() {
  const Json count = a_count(), number = type("number");
  const Json errors = object({{"wrong_area", number},
                              {"tied_area", number},
                              {"wrongly_visible", count},
                              {"wrongly_hidden", count},
                              {"missing", count},
                              {"largest_missing", number},
                              {"gaps", number},
                              {"overlaps", number},
                              {"not_finite", count}});
  const Json rows = rows_of({{"size?", count}, {"bits?", count}}, {{"visible?", count},
                                                                   {"parts?", count},
                                                                   {"near?", a_double()},
                                                                   {"far?", a_double()},
                                                                   {"triangles?", count},
                                                                   {"clipped?", count},
                                                                   {"errors", errors}});
  return answer_to({"see"}, {{"eye", named("point")}, {"visible", count}, {"rows", rows}});
}

Json weak_answer() {
  const Json count = a_count();
  const Json errors =
      object({{"wrongly_visible", count}, {"wrongly_hidden", count}, {"undecided", count}, {"unjudged", count}});
  const Json rows = rows_of({{"rays?", count}}, {{"visible", count}, {"errors", errors}});
  return answer_to({"weak"}, {{"visible", count}, {"hidden", count}, {"undecided", count}, {"rows", rows}});
}

Json render_answer() {
  const Json count = a_count(), number = type("number");
  const Json of_centres = object({{"wrong", count},
                                  {"wrong_share", number},
                                  {"missing?", count},
                                  {"largest_missing?", count},
                                  {"largest?", number},
                                  {"mean?", number}}),
             of_squares = object({{"compared", count},
                                  {"off", count},
                                  {"off_share", number},
                                  {"largest", number},
                                  {"mean", number},
                                  {"missing?", count},
                                  {"largest_missing?", number}});
  const Json rows = rows_of({{"bits?", count}, {"samples?", count}}, {{"errors", any_of({of_centres, of_squares})}});
  return answer_to({"render"}, {{"eye", named("point")},
                                {"width", count},
                                {"height", count},
                                {"tied", count},
                                {"transparent", type("boolean")},
                                {"rows", rows}});
}

Json trace_answer() {
  const Json count = a_count();
  const Json rays = object({{"rays", count}, {"missed", count}, {"invented", count}, {"wrong_face", count}});
  const Json by_kind{{"type", "object"}, {"additionalProperties", rays}};
  const Json rows = rows_of({}, {{"prepare", type("number")}, {"errors", rays}, {"by_kind", by_kind}});
  return answer_to({"trace"}, {{"rays", count}, {"hit", count}, {"tied", count}, {"rows", rows}});
}

Json pvs_answer() {
  const Json count = a_count(), point = named("point");
  const Json errors = object({{"wrongly_visible", count}, {"wrongly_hidden", count}, {"worst_cell?", count}});
  const Json sizes = object({{"measured", count},
                             {"below_1", count},
                             {"below_10", count},
                             {"below_100", count},
                             {"below_1000", count},
                             {"above", count},
                             {"largest", type("number")}});
  const Json rows =
      rows_of({{"rays?", count}}, {{"visible", count},
                                   {"pairs?", count},
                                   {"errors", errors},
                                   {"sizes?", object({{"wrongly_hidden", sizes}, {"wrongly_visible", sizes}})}});
  const Members sums{{"pairs", count}, {"visible", count}, {"undecided", count}, {"refuted", count}, {"rows", rows}};
  const Members line{{"from", point}, {"to", point}, {"certificate?", type("string")}};
  const Json of_face = object(with(line, {{"leaf", count},
                                          {"face", a_face()},
                                          {"cell", count},
                                          {"through", list_of(count)},
                                          {"pixels", type("number")},
                                          {"draw", type("string")}}));
  const Json of_leaves = object(with(
      line, {{"from_leaf", count}, {"to_leaf", count}, {"through", list_of(count)}, {"checked", type("boolean")}}));
  const Json leaves =
      object(with(sums, {{"seconds", type("number")}, {"through_solid", count}, {"sightlines", list_of(of_leaves)}}));
  return answer_to({"pvs"}, with(sums, {{"cells", count}, {"sightlines", list_of(of_face)}, {"leaves?", leaves}}));
}

}  // namespace

Json compare_result() {
  return any_of({order_answer(), see_answer(), weak_answer(), render_answer(), trace_answer(), pvs_answer()});
}

/// A scene to turn around: the data of a page.
static Json a_view() { return any_of({type("object"), type("null")}); }

Members judge_members() {
  const Json count = a_count(), face = a_face(), text = type("string"), number = type("number");
  const Json faces = named("faces"), texts = list_of(text), seconds = any_of({number, type("null")});
  const std::vector<std::string> marks{"crashed",   "invalid",   "wrong", "out of memory",
                                       "timed out", "abstained", "right"};
  Members by_mark;
  for (const std::string& name : marks) by_mark.emplace_back(name, count);
  const Members sums{
      {"distance", text},
      {"asked", count},
      {"not_asked", count},
      {"cases", object(by_mark)},
      {"breaches", count},
      {"faces", object({{"judged", count}, {"wrong_visible", count}, {"wrong_hidden", count}, {"abstained", count}})},
      {"seconds", object({{"p50", seconds}, {"p95", seconds}, {"max", seconds}})},
      {"bytes", count},
      {"errors?", object({{"area", a_double()}, {"volume", a_double()}})}};
  const Json row = object(with(sums, {{"family", text}}));
  const Json line = object({{"face", face},
                            {"from", named("point")},
                            {"to", named("point")},
                            {"by", any_of({face, type("null")})},
                            {"words", text}});
  const Json explained = object({{"share", number},
                                 {"share_words", text},
                                 {"line", any_of({line, type("null")})},
                                 {"picture", text},
                                 {"view", a_view()}});
  const Members broken{
      {"faces", count}, {"mark", one_word_of(marks)}, {"why", text}, {"again", text}, {"explained?", explained}};
  const Members failure =
      with(broken,
           {{"family", text}, {"distance", text}, {"seed", count}, {"wrong_visible", faces}, {"wrong_hidden", faces}});
  const Json reduced = object(with(broken, {{"runs", count}, {"finished", type("boolean")}, {"files", texts}}));
  const Json smallest = object(with(failure, {{"files", texts}, {"guess?", texts}, {"reduced?", reduced}}));
  return {{"program", text},
          {"query", one_word_of({"order", "see", "weak", "trace", "boolean"})},
          {"two_sided", type("boolean")},
          {"contract", one_word_of({"exact", "conservative", "aggressive"})},
          {"shard", tuple_of(count, 2)},
          {"limits", object({{"seconds", number}, {"bytes", count}})},
          {"result", object({{"holds", type("boolean")},
                             {"rows", list_of(row)},
                             {"by_distance", list_of(object(sums))},
                             {"total", row},
                             {"guess", texts},
                             {"not_asked", {{"type", "object"}, {"additionalProperties", count}}},
                             {"smallest", any_of({smallest, type("null")})},
                             {"failures", list_of(object(failure))}})}};
}

Members report_members() {
  const Json count = a_count(), text = type("string"), number = type("number");
  const Json seconds = any_of({number, type("null")});
  const Members contender{{"question", text}, {"method", text}, {"kernel", text}};
  const Members counts{{"cases", count},   {"wrong", count},       {"abstained", count},      {"crashed", count},
                       {"stopped", count}, {"seconds", seconds},   {"worst_seconds", number}, {"peak_bytes", count},
                       {"error", number},  {"worst_error", number}};
  const Members counted = with(contender, counts), summary = with(counted, {{"rows", count}});
  const Json smallest = object({{"faces", count}, {"seed", count}, {"error", number}});
  const Members row = with(counted, {{"unit", count},
                                     {"broken", count},
                                     {"family", text},
                                     {"distance", text},
                                     {"size", count},
                                     {"seed", count},
                                     {"faces", number},
                                     {"smallest", any_of({type("null"), smallest})}});
  const Json example = object(with(contender, {{"family", text},
                                               {"distance", text},
                                               {"size", count},
                                               {"seed", count},
                                               {"faces_before", count},
                                               {"faces", count},
                                               {"error", number},
                                               {"file", text},
                                               {"scene", text},
                                               {"query", text},
                                               {"why", text},
                                               {"again", text},
                                               {"picture", text},
                                               {"view", a_view()}}));
  return {{"asked", type("object")},
          {"contents", {{"type", "object"}, {"additionalProperties", text}}},
          {"shard", tuple_of(count, 2)},
          {"units", count},
          {"open", count},
          {"result", object({{"questions", list_of(object({{"question", text}, {"error", text}}))},
                             {"summaries", list_of(object(summary))},
                             {"rows", list_of(object(row))},
                             {"examples", list_of(example)},
                             {"not_asked", {{"type", "object"}, {"additionalProperties", count}}}})}};
}

}  // namespace sightline::app::schema
