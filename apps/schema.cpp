// sightline schema: what --json writes, as JSON Schema.

#include "support/common.h"

#include <iostream>
#include <map>

namespace sightline::app {

namespace schema {

/// What is defined once, and named everywhere.
Json named(const std::string& name) { return {{"$ref", "#/$defs/" + name}}; }
Json type(const std::string& name) { return {{"type", name}}; }
Json list_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }
Json tuple_of(Json items, int size) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", size}, {"maxItems", size}};
}
Json any_of(std::vector<Json> all) { return {{"anyOf", std::move(all)}}; }
Json one_word_of(const std::vector<std::string>& words) { return {{"enum", words}}; }

/// Keys with what each holds; one that ends with ? may be missing. Others may come to be there.
Json object(const std::vector<std::pair<std::string, Json>>& members) {
  Json properties = Json::object(), required = Json::array();
  for (const auto& [key, what] : members) {
    const bool optional = key.ends_with('?');
    const std::string name = optional ? key.substr(0, key.size() - 1) : key;
    properties[name] = what;
    if (!optional) required.push_back(name);
  }
  return {{"type", "object"}, {"properties", std::move(properties)}, {"required", std::move(required)}};
}

Json a_count() { return {{"type", "integer"}, {"minimum", 0}}; }
Json a_face() { return {{"type", "integer"}, {"minimum", 0}, {"description", "the place of a face, from 0"}}; }

/// What boxes, volumes and convex regions see, each with its name.
Json groups_of(const std::string& key, const Json& name) {
  return list_of(
      object({{key, name}, {"cells", list_of(a_count())}, {"visible", named("faces")}, {"undecided", named("faces")}}));
}

Json definitions() {
  const Json count = a_count(), face = a_face();
  return {{"exact", {{"type", "string"}, {"pattern", "^-?[0-9]+(/[0-9]+)?$"}, {"description", "p or p/q, reduced"}}},
          {"point", tuple_of(named("exact"), 3)},
          {"faces", list_of(face)},
          {"piece",
           {{"type", "array"},
            {"items", count},
            {"minItems", 2},
            {"maxItems", 2},
            {"description", "[face, which of its convex pieces]"}}},
          {"scene", object({{"file", type("string")},
                            {"faces_read", count},
                            {"faces", count},
                            {"set_aside", list_of(object({{"face", face}, {"why", type("string")}}))},
                            {"bits", count},
                            {"arithmetic", type("string")},
                            {"grid_bits", count},
                            {"pieces", count},
                            {"flipped?", type("boolean")}})},
          {"operands",
           object({{"operands", list_of(object({{"file", type("string")}, {"faces_read", count}}))},
                   {"set_aside", list_of(object({{"operand", count}, {"face", face}, {"why", type("string")}}))},
                   {"non_planar", list_of(tuple_of(count, 2))},
                   {"grid_bits", count},
                   {"arithmetic", type("string")}})},
          {"rounding", object({{"moved", count},
                               {"farthest", type("number")},
                               {"not_planar", list_of(face)},
                               {"collapsed", list_of(face)},
                               {"turned", list_of(face)},
                               {"crossing", list_of(tuple_of(face, 2))},
                               {"misplaced", list_of(face)},
                               {"snapped", count},
                               {"rounds", count},
                               {"sound", type("boolean")}})},
          {"hit", object({{"face", face},
                          {"side", one_word_of({"front", "back", "along"})},
                          {"t", named("exact")},
                          {"until?", named("exact")},
                          {"point", named("point")},
                          {"faces?", named("faces")}})}};
}

/// Of `weak --partition`: the first face, and all where there are several.
Json partition_result() {
  const Json count = a_count(), bounds = tuple_of(type("number"), 2), cell = any_of({count, type("null")});
  const auto border = [&](const Json& kind, std::vector<std::pair<std::string, Json>> more) {
    more.insert(more.end(), {{"piece", count}, {"kind", kind}, {"y", tuple_of(bounds, 2)}});
    return object(more);
  };
  const Json a_border = any_of({border(one_word_of({"line", "conic"}), {{"curve", tuple_of(named("exact"), 6)},
                                                                        {"upper", type("boolean")},
                                                                        {"below", cell},
                                                                        {"above", cell},
                                                                        {"x", tuple_of(bounds, 2)}}),
                                border({{"const", "upright"}}, {{"left", cell}, {"right", cell}, {"x", bounds}})});
  const Json of_face = object(
      {{"face", a_face()},
       {"lit", bounds},
       {"penumbra", bounds},
       {"umbra", bounds},
       {"undecided", bounds},
       {"cells", list_of(object({{"piece", count},
                                 {"light", one_word_of({"lit", "penumbra", "umbra", "undecided"})},
                                 {"point", named("point")},
                                 {"area", bounds},
                                 {"edges?", list_of(list_of(tuple_of(named("point"), 2)))}}))},
       {"borders", list_of(a_border)},
       {"charts",
        list_of(object({{"piece", count}, {"origin", named("point")}, {"x", named("point")}, {"y", named("point")}}))},
       {"sampled?",
        object({{"rays", count}, {"lit", type("number")}, {"penumbra", type("number")}, {"umbra", type("number")}})}});
  return object({{"partition", of_face}, {"partitions?", list_of(of_face)}});
}

/// Of `weak --along`.
Json along_result() {
  const Json faces = named("faces"), number = type("number");
  const Json kinds = one_word_of({"horizon", "contact", "edge and vertex", "triple"});
  const Json change =
      object({{"face", a_face()},
              {"kind", kinds},
              {"visible", tuple_of(type("boolean"), 3)},
              {"edges", list_of(object({{"face", a_face()}, {"piece", a_count()}, {"corner", a_count()}}))}});
  const Json moment =
      any_of({object({{"root", named("exact")}, {"near", number}}), object({{"quadratic", tuple_of(named("exact"), 3)},
                                                                            {"low", named("exact")},
                                                                            {"high", named("exact")},
                                                                            {"near", number}})});
  return object({{"from", named("point")},
                 {"to", named("point")},
                 {"events", list_of(object({{"t", moment},
                                            {"kind", any_of({kinds, {{"const", "several"}}})},
                                            {"appear", faces},
                                            {"disappear", faces},
                                            {"momentary", object({{"visible", faces}, {"hidden", faces}})},
                                            {"changes", list_of(change)}}))},
                 {"visible_at_start", faces},
                 {"visible_at_end", faces},
                 {"visible", faces}});
}

/// Of `cutset --decision-tree`.
Json decision_tree() {
  const Json child = any_of({object({{"view", a_count()}}), object({{"step", a_count()}})});
  return object({{"expected", named("exact")},
                 {"bound", named("exact")},
                 {"cells", a_count()},
                 {"open_cells", a_count()},
                 {"states", a_count()},
                 {"steps", list_of(object({{"face", a_face()}, {"on", child}, {"off", child}}))},
                 {"views", list_of(named("faces"))}});
}

/// The commands that write JSON. They stand here, because results() is dear, and every start of the program names them.
const std::vector<std::string> commands{"boolean", "bsp",  "cells",  "compare", "cutset", "fuzz",
                                        "graph",   "info", "judge",  "order",   "pvs",    "render",
                                        "report",  "see",  "shadow", "trace",   "verify", "weak"};

/// What `result` holds, by command.
std::map<std::string, Json> results() {
  const Json count = a_count(), face = a_face();
  const Json points = list_of(named("point")), faces = named("faces"), piece = named("piece");
  const Json fragment = object({{"face", face}, {"piece", count}, {"vertices", points}});
  const auto shadow_part = [&](std::vector<std::pair<std::string, Json>> more) {
    more.insert(more.end(), {{"face", face},
                             {"piece", count},
                             {"light", count},
                             {"side", one_word_of({"front", "back"})},
                             {"vertices", points}});
    return object(more);
  };
  return {
      {"info",
       object({{"points_read", count},
               {"points", count},
               {"pieces", count},
               {"supporting_planes", count},
               {"planes", count},
               {"lines", count},
               {"closed", type("boolean")},
               {"scale_bits", type("integer")},
               {"non_planar", faces},
               {"concave", faces},
               {"fronts?", object({{"points", count}, {"outwards", type("number")}, {"inwards", type("number")}})},
               {"box?", tuple_of(named("point"), 2)}})},
      {"bsp", object({{"nodes", count}, {"depth", count}, {"splits", count}, {"fragments", count}})},
      {"order",
       object(
           {{"eye", named("point")}, {"fragments", list_of(fragment)}, {"visible?", faces}, {"from_behind?", faces}})},
      {"graph", object({{"scope", type("string")},
                        {"arcs", any_of({count, type("null")})},
                        {"components", list_of(list_of(piece))},
                        {"arc_list?", list_of(tuple_of(piece, 2))},
                        {"tree?", type("object")},
                        {"codes?", type("array")},
                        {"splits?", count},
                        {"pieces?", count},
                        {"images?", Json::object()}})},
      {"cutset", any_of({object({{"frames", list_of(object({{"eye?", named("point")},
                                                            {"direction?", named("point")},
                                                            {"on_view", any_of({count, faces})},
                                                            {"cut_edges", count},
                                                            {"tests", count},
                                                            {"tests_away", count},
                                                            {"births", count},
                                                            {"changed", count},
                                                            {"wrong?", count}}))},
                                 {"wrong_frames?", count}}),
                         object({{"decision_tree", decision_tree()}})})},
      {"see",
       object(
           {{"eye", named("point")},
            {"visible", faces},
            {"from_behind", faces},
            {"pieces",
             list_of(object(
                 {{"face", face}, {"piece", count}, {"side", one_word_of({"front", "back"})}, {"vertices", points}}))},
            {"lines?", list_of(object({{"class", type("string")},
                                       {"faces", faces},
                                       {"vertices", tuple_of(named("point"), 2)},
                                       {"parts", list_of(object({{"from", named("exact")},
                                                                 {"to", named("exact")},
                                                                 {"visible", type("boolean")},
                                                                 {"hidden_by?", piece},
                                                                 {"vertices", tuple_of(named("point"), 2)}}))}}))}})},
      {"trace", object({{"method", type("string")},
                        {"start", one_word_of({"open", "closed"})},
                        {"rays", count},
                        {"hit", count},
                        {"hits", list_of(any_of({type("null"), named("hit"), list_of(named("hit"))}))}})},
      {"weak", any_of({object({{"visible", faces},
                               {"hidden", faces},
                               {"undecided", faces},
                               {"certificate", type("string")},
                               {"unproved", faces},
                               {"by_events", faces},
                               {"within", faces},
                               {"open", type("array")}}),
                       partition_result(), object({{"along", along_result()}})})},
      {"shadow",
       object({{"lights",
                list_of(object(
                    {{"light?", named("point")}, {"sun?", named("point")}, {"lit_faces", faces}, {"away", faces}}))},
               {"lit", list_of(shadow_part({}))},
               {"dark", list_of(shadow_part({{"by", face}, {"by_piece", count}}))},
               {"lit_faces", faces},
               {"dark_faces", faces},
               {"volume?", object({{"faces", count},
                                   {"casting", count},
                                   {"volume", named("exact")},
                                   {"box", tuple_of(named("point"), 2)},
                                   {"seconds", type("number")},
                                   {"rounding?", named("rounding")}})}})},
      {"render", object({{"eye", named("point")},
                         {"method", type("string")},
                         {"look", tuple_of(type("number"), 3)},
                         {"right", tuple_of(type("number"), 3)},
                         {"up", tuple_of(type("number"), 3)},
                         {"width", count},
                         {"height", count}})},
      {"boolean",
       any_of(
           {object({{"operation", type("string")},
                    {"inside", one_word_of({"positive", "nonzero", "odd"})},
                    {"faces", count},
                    {"maximal_faces", count},
                    {"points", count},
                    {"volume", named("exact")},
                    {"area", tuple_of(type("number"), 2)},
                    {"not_manifold",
                     list_of(object({{"from", named("point")}, {"to", named("point")}, {"faces", count}}))},
                    {"provenance", list_of(tuple_of(count, 2))},
                    {"turned", list_of(count)},
                    {"brushes?", list_of(any_of({type("null"), tuple_of(count, 2)}))},
                    {"rounding?", named("rounding")}}),
            object({{"operation", type("string")},
                    {"refused", list_of(object({{"operand", count},
                                                {"file", type("string")},
                                                {"faces", list_of(object({{"face", face}, {"why", type("string")}}))},
                                                {"open_edges", list_of(object({{"face", face},
                                                                               {"from", named("point")},
                                                                               {"to", named("point")}}))}}))}})})},
      {"fuzz", object({{"subject", type("string")},
                       {"seed", count},
                       {"shard", tuple_of(count, 2)},
                       {"finding", any_of({type("null"), object({{"case", type("string")},
                                                                 {"check", type("string")},
                                                                 {"what", type("string")},
                                                                 {"replay", type("string")},
                                                                 {"reduced", type("string")},
                                                                 {"faces", count},
                                                                 {"faces_reduced", count},
                                                                 {"runs", count},
                                                                 {"finished", type("boolean")}})})}})},
      {"cells",
       object({{"cells", count},
               {"solid", count},
               {"portals", count},
               {"regions", count},
               {"closed", type("boolean")},
               {"sealed", count},
               {"in_solid", count},
               {"convex_regions?", count},
               {"leaks", list_of(object({{"from", named("point")},
                                         {"way", list_of(object({{"cell", count}, {"point", named("point")}}))}}))}})},
      {"pvs", object({{"cells", count},
                      {"faces", count},
                      {"visible", count},
                      {"undecided", count},
                      {"blocks_kept", count},
                      {"leaves?", object({{"leaves", count}, {"visible", count}})},
                      {"boxes?", groups_of("box", list_of(count))},
                      {"volumes?", groups_of("volume", count)},
                      {"convex_regions?", groups_of("convex_region", count)},
                      {"pairs_of_cells?", object({{"visible", count}, {"undecided", count}})},
                      {"shown?", list_of(object({{"cell", count},
                                                 {"point", named("point")},
                                                 {"visible", faces},
                                                 {"undecided", faces},
                                                 {"cells?", list_of(count)},
                                                 {"cells_undecided?", list_of(count)}}))}})},
      {"verify", object({{"accepted", type("boolean")},
                         {"why", type("string")},
                         {"fragments?", list_of(count)},
                         {"rejected?", list_of(object({{"file", type("string")}, {"why", type("string")}}))}})}};
}

/// What `result` of compare holds, which goes by the question.
Json compare_result() {
  const Json count = a_count(), text = type("string"), number = type("number"), point = named("point");
  using Members = std::vector<std::pair<std::string, Json>>;
  // A contestant that is done has all of these; another one says in its status what became of it.
  const auto rows_of = [&](const Members& names, const Members& more) {
    Members done{{"kernel", text}, {"method", text}};
    done.insert(done.end(), names.begin(), names.end());
    Members open = done;
    done.insert(done.end(), {{"status", {{"const", "done"}}}, {"seconds", number}, {"peak_bytes", count}});
    done.insert(done.end(), more.begin(), more.end());
    open.emplace_back("status", Json{{"type", "string"}, {"not", {{"const", "done"}}}});
    return list_of(any_of({object(done), object(open)}));
  };
  const auto question = [](const std::vector<std::string>& names, Members members) {
    members.emplace_back("question", one_word_of(names));
    return object(members);
  };
  const Json pairs = any_of({count, type("null")});
  const Json order_rows = rows_of({}, {{"build_seconds", number},
                                       {"order_seconds", number},
                                       {"splits", count},
                                       {"fragments", count},
                                       {"depth", count},
                                       {"predicates", type("object")},
                                       {"errors", object({{"sides_asked?", count},
                                                          {"sides_wrong?", count},
                                                          {"sides_opposite?", count},
                                                          {"sides_false_zero?", count},
                                                          {"sides_missed_zero?", count},
                                                          {"fragments_degenerate?", count},
                                                          {"fragments_not_finite?", count},
                                                          {"pairs?", count},
                                                          {"pairs_wrong?", pairs},
                                                          {"pairs_wrong_beyond_rounding?", pairs},
                                                          {"area_lost?", number},
                                                          {"area_overlapping?", number},
                                                          {"area_outside?", number},
                                                          {"tiles_exactly?", type("boolean")}})}});
  const Json see_rows = rows_of({{"size?", count}, {"bits?", count}}, {{"visible?", count},
                                                                       {"parts?", count},
                                                                       {"near?", number},
                                                                       {"far?", number},
                                                                       {"triangles?", count},
                                                                       {"clipped?", count},
                                                                       {"errors", object({{"wrong_area", number},
                                                                                          {"tied_area", number},
                                                                                          {"wrongly_visible", count},
                                                                                          {"wrongly_hidden", count},
                                                                                          {"missing", count},
                                                                                          {"largest_missing", number},
                                                                                          {"gaps", number},
                                                                                          {"overlaps", number},
                                                                                          {"not_finite", count}})}});
  const Json weak_rows = rows_of(
      {{"rays?", count}},
      {{"visible", count},
       {"errors",
        object({{"wrongly_visible", count}, {"wrongly_hidden", count}, {"undecided", count}, {"unjudged", count}})}});
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
  const Json render_rows =
      rows_of({{"bits?", count}, {"samples?", count}}, {{"errors", any_of({of_centres, of_squares})}});
  const Json rays = object({{"rays", count}, {"missed", count}, {"invented", count}, {"wrong_face", count}});
  const Json trace_rows = rows_of(
      {}, {{"prepare", number}, {"errors", rays}, {"by_kind", {{"type", "object"}, {"additionalProperties", rays}}}});
  const Json pvs_rows =
      rows_of({{"rays?", count}},
              {{"visible", count},
               {"pairs?", count},
               {"errors", object({{"wrongly_visible", count}, {"wrongly_hidden", count}, {"worst_cell?", count}})}});
  const Members line{{"from", point}, {"to", point}};
  Members of_faces = line, of_leaves = line;
  of_faces.insert(of_faces.end(), {{"leaf", count}, {"face", a_face()}, {"cell", count}});
  of_leaves.insert(
      of_leaves.end(),
      {{"from_leaf", count}, {"to_leaf", count}, {"through", list_of(count)}, {"checked", type("boolean")}});
  const Members sums{
      {"pairs", count}, {"visible", count}, {"undecided", count}, {"refuted", count}, {"rows", pvs_rows}};
  Members pvs = sums, leaves = sums;
  leaves.insert(leaves.end(),
                {{"seconds", number}, {"through_solid", count}, {"sightlines", list_of(object(of_leaves))}});
  pvs.insert(pvs.end(), {{"cells", count}, {"sightlines", list_of(object(of_faces))}, {"leaves?", object(leaves)}});
  return any_of({question({"order", "bsp"}, {{"rows", order_rows}}),
                 question({"see"}, {{"eye", point}, {"visible", count}, {"rows", see_rows}}),
                 question({"weak"}, {{"visible", count}, {"hidden", count}, {"undecided", count}, {"rows", weak_rows}}),
                 question({"render"}, {{"eye", point},
                                       {"width", count},
                                       {"height", count},
                                       {"tied", count},
                                       {"transparent", type("boolean")},
                                       {"rows", render_rows}}),
                 question({"trace"}, {{"rays", count}, {"hit", count}, {"tied", count}, {"rows", trace_rows}}),
                 question({"pvs"}, pvs)});
}

/// What the members of a judgement are, which is of no one scene.
std::vector<std::pair<std::string, Json>> judge_members() {
  const Json count = a_count(), face = a_face(), text = type("string"), number = type("number");
  const Json faces = named("faces"), texts = list_of(text), seconds = any_of({number, type("null")});
  using Members = std::vector<std::pair<std::string, Json>>;
  const auto with = [](Members members, const Members& more) {
    members.insert(members.end(), more.begin(), more.end());
    return members;
  };
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
      {"errors?", object({{"area", number}, {"volume", number}})}};
  const Json row = object(with(sums, {{"family", text}}));
  const Json line = object({{"face", face},
                            {"from", named("point")},
                            {"to", named("point")},
                            {"by", any_of({face, type("null")})},
                            {"words", text}});
  const Json explained =
      object({{"share", number}, {"share_words", text}, {"line", any_of({line, type("null")})}, {"picture", text}});
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

/// What the members of a report are, which is of no one scene.
std::vector<std::pair<std::string, Json>> report_members() {
  const Json count = a_count(), text = type("string"), number = type("number");
  const Json seconds = any_of({number, type("null")});
  const auto of_contender = [&](std::vector<std::pair<std::string, Json>> more) {
    std::vector<std::pair<std::string, Json>> all{{"question", text}, {"method", text}, {"kernel", text}};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const std::vector<std::pair<std::string, Json>> counts{
      {"cases", count},   {"wrong", count},       {"abstained", count},      {"crashed", count},
      {"stopped", count}, {"seconds", seconds},   {"worst_seconds", number}, {"peak_bytes", count},
      {"error", number},  {"worst_error", number}};
  auto row = of_contender(counts), summary = row;
  row.insert(row.end(),
             {{"unit", count},
              {"broken", count},
              {"family", text},
              {"distance", text},
              {"size", count},
              {"seed", count},
              {"faces", number},
              {"smallest", any_of({type("null"), object({{"faces", count}, {"seed", count}, {"error", number}})})}});
  summary.emplace_back("rows", count);
  const Json example = object(of_contender({{"family", text},
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
                                            {"picture", text}}));
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

Exit run(const std::string& command) {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "sightline " + command + " --json"},
              {"$defs", definitions()}};
  std::vector<std::pair<std::string, Json>> members{{"counters", type("object")}};
  if (command != "fuzz") members.emplace_back("scene", named(command == "boolean" ? "operands" : "scene"));
  if (command == "report") members = report_members();
  else if (command == "judge") members = judge_members();
  else if (command == "compare") members.emplace_back("result", compare_result());
  else members.emplace_back("result", results().at(command));
  members.emplace_back("command", Json{{"const", command}});
  members.emplace_back("seconds", Json{{"type", "object"}, {"additionalProperties", type("number")}});
  schema.update(object(members));
  std::cout << to_text(schema, 1) << '\n';
  return Exit::done;
}

}  // namespace schema

void add_schema(Command program) {
  const Command command = program.add_command("schema", "What --json of a command writes, as JSON Schema");
  auto name = std::make_shared<std::string>();
  command.add_option("COMMAND", *name, "the command").required().check(one_of(schema::commands));
  command.footer(
      "Keys may be added in later versions; these stay.\n"
      "Example: sightline schema see > see.schema.json");
  command.set_printing_action([name] { return schema::run(*name); });
}

}  // namespace sightline::app
