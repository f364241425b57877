#include "results.h"

#include "contests.h"

namespace sightline::app::schema {

namespace {

/// What boxes, volumes and convex regions see, each with its name.
Json groups_of(const std::string& key, const Json& name) {
  return list_of(
      object({{key, name}, {"cells", list_of(a_count())}, {"visible", named("faces")}, {"undecided", named("faces")}}));
}

/// Of `weak --partition`: the first face, and all where there are several.
Json partition_result() {
  const Json count = a_count(), bounds = tuple_of(type("number"), 2), cell = any_of({count, type("null")});
  const auto border = [&](const Json& kind, const Members& own) {
    return object(with(own, {{"piece", count}, {"kind", kind}, {"y", tuple_of(bounds, 2)}}));
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

Json info_result() {
  const Json count = a_count(), faces = named("faces");
  return object({{"points_read", count},
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
                 {"box?", tuple_of(named("point"), 2)}});
}

Json bsp_result() {
  const Json count = a_count();
  return object({{"nodes", count}, {"depth", count}, {"splits", count}, {"fragments", count}});
}

Json order_result() {
  const Json count = a_count(), face = a_face(), points = list_of(named("point")), faces = named("faces");
  const Json fragment = object({{"face", face}, {"piece", count}, {"vertices", points}});
  return object(
      {{"eye", named("point")}, {"fragments", list_of(fragment)}, {"visible?", faces}, {"from_behind?", faces}});
}

Json graph_result() {
  const Json count = a_count(), piece = named("piece");
  return object({{"scope", type("string")},
                 {"arcs", any_of({count, type("null")})},
                 {"components", list_of(list_of(piece))},
                 {"arc_list?", list_of(tuple_of(piece, 2))},
                 {"tree?", type("object")},
                 {"codes?", type("array")},
                 {"splits?", count},
                 {"pieces?", count},
                 {"images?", Json::object()}});
}

Json cutset_result() {
  const Json count = a_count(), faces = named("faces");
  return any_of({object({{"frames", list_of(object({{"eye?", named("point")},
                                                    {"direction?", named("point")},
                                                    {"on_view", any_of({count, faces})},
                                                    {"cut_edges", count},
                                                    {"tests", count},
                                                    {"tests_away", count},
                                                    {"births", count},
                                                    {"changed", count},
                                                    {"wrong?", count}}))},
                         {"wrong_frames?", count}}),
                 object({{"decision_tree", decision_tree()}})});
}

Json see_result() {
  const Json count = a_count(), face = a_face(), points = list_of(named("point")), faces = named("faces"),
             piece = named("piece");
  return object(
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
                                                            {"vertices", tuple_of(named("point"), 2)}}))}}))}});
}

Json trace_result() {
  const Json count = a_count();
  return object({{"method", type("string")},
                 {"start", one_word_of({"open", "closed"})},
                 {"rays", count},
                 {"hit", count},
                 {"hits", list_of(any_of({type("null"), named("hit"), list_of(named("hit"))}))}});
}

Json weak_result() {
  const Json faces = named("faces");
  return any_of({object({{"visible", faces},
                         {"hidden", faces},
                         {"undecided", faces},
                         {"certificate", type("string")},
                         {"unproved", faces},
                         {"by_events", faces},
                         {"within", faces},
                         {"open", type("array")}}),
                 partition_result(), object({{"along", along_result()}})});
}

Json shadow_result() {
  const Json count = a_count(), face = a_face(), points = list_of(named("point")), faces = named("faces");
  const Members part{{"face", face},
                     {"piece", count},
                     {"light", count},
                     {"side", one_word_of({"front", "back"})},
                     {"vertices", points}};
  return object(
      {{"lights",
        list_of(object({{"light?", named("point")}, {"sun?", named("point")}, {"lit_faces", faces}, {"away", faces}}))},
       {"lit", list_of(object(part))},
       {"dark", list_of(object(with({{"by", face}, {"by_piece", count}}, part)))},
       {"lit_faces", faces},
       {"dark_faces", faces},
       {"volume?", object({{"faces", count},
                           {"casting", count},
                           {"volume", named("exact")},
                           {"box", tuple_of(named("point"), 2)},
                           {"seconds", type("number")},
                           {"rounding?", named("rounding")}})}});
}

Json render_result() {
  const Json count = a_count();
  return object({{"eye", named("point")},
                 {"method", type("string")},
                 {"look", tuple_of(type("number"), 3)},
                 {"right", tuple_of(type("number"), 3)},
                 {"up", tuple_of(type("number"), 3)},
                 {"width", count},
                 {"height", count},
                 {"faces?", list_of(object({{"face", a_face()}, {"pixels", count}}))}});
}

Json boolean_result() {
  const Json count = a_count(), face = a_face();
  return any_of(
      {object({{"operation", type("string")},
               {"inside", one_word_of({"positive", "nonzero", "odd"})},
               {"faces", count},
               {"maximal_faces", count},
               {"points", count},
               {"volume", named("exact")},
               {"area", tuple_of(a_double(), 2)},
               {"not_manifold", list_of(object({{"from", named("point")}, {"to", named("point")}, {"faces", count}}))},
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
                                                                          {"to", named("point")}}))}}))}})});
}

Json fuzz_result() {
  const Json count = a_count();
  return object({{"subject", type("string")},
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
                                                           {"finished", type("boolean")}})})}});
}

Json cells_result() {
  const Json count = a_count();
  return object({{"cells", count},
                 {"solid", count},
                 {"portals", count},
                 {"regions", count},
                 {"closed", type("boolean")},
                 {"sealed", count},
                 {"in_solid", count},
                 {"convex_regions?", count},
                 {"leaks", list_of(object({{"from", named("point")},
                                           {"way", list_of(object({{"cell", count}, {"point", named("point")}}))}}))}});
}

Json pvs_result() {
  const Json count = a_count(), faces = named("faces");
  return object({{"cells", count},
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
                                            {"cells_undecided?", list_of(count)}}))}});
}

Json verify_result() {
  const Json count = a_count();
  return object({{"accepted", type("boolean")},
                 {"why", type("string")},
                 {"fragments?", list_of(count)},
                 {"rejected?", list_of(object({{"file", type("string")}, {"why", type("string")}}))}});
}

/// A document of counters and a result, and of what it was asked about.
template <Json (*result)()>
Members of_no_scene() {
  return {{"counters", type("object")}, {"result", result()}};
}
template <Json (*result)()>
Members of_scene() {
  return {{"counters", type("object")}, {"scene", named("scene")}, {"result", result()}};
}
template <Json (*result)()>
Members of_operands() {
  return {{"counters", type("object")}, {"scene", named("operands")}, {"result", result()}};
}

}  // namespace

const std::map<std::string, Members (*)()>& documents() {
  static const std::map<std::string, Members (*)()> all{{"boolean", of_operands<boolean_result>},
                                                        {"bsp", of_scene<bsp_result>},
                                                        {"cells", of_scene<cells_result>},
                                                        {"compare", of_scene<compare_result>},
                                                        {"cutset", of_scene<cutset_result>},
                                                        {"fuzz", of_no_scene<fuzz_result>},
                                                        {"graph", of_scene<graph_result>},
                                                        {"info", of_scene<info_result>},
                                                        {"judge", judge_members},
                                                        {"order", of_scene<order_result>},
                                                        {"pvs", of_scene<pvs_result>},
                                                        {"render", of_scene<render_result>},
                                                        {"report", report_members},
                                                        {"see", of_scene<see_result>},
                                                        {"shadow", of_scene<shadow_result>},
                                                        {"trace", of_scene<trace_result>},
                                                        {"verify", of_scene<verify_result>},
                                                        {"weak", of_scene<weak_result>}};
  return all;
}

}  // namespace sightline::app::schema
