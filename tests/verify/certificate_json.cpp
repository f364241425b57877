// Certificates as JSON: what is written is read back, and what is not a certificate is said so.

#include "weak_scenes.h"

#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/certificate_writer.h>

#include <nlohmann/json.hpp>

#include <array>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace verify_test;

Scene example() {
  Scene scene;
  const Points square = rectangle(0, ratio(1, 3), 0, 4, -1),
               skew = {at(0, 0, 0), at(4, 0, 1), at(4, 4, 0), at(0, 4, 1)};
  scene.seen_from(at(ratio(-1, 7), 2, 1 / tiny(200))).face(square);
  scene.face(skew);
  scene.face({});
  const Points first = {skew[0], skew[1], skew[2]}, second = {skew[0], skew[2], skew[3]};
  return scene.cut(1, 0, first)
      .cut(1, 1, second)
      .draw(0, square)
      .draw(1, first, 0)
      .draw(1, second, 1)
      .leave_out(2, "zero area");
}

using Json = nlohmann::ordered_json;

Order_certificate read(const std::string& text) {
  std::istringstream in(text);
  return read_order_certificate(in);
}
Certificate read_any(const std::string& text) {
  std::istringstream in(text);
  return read_certificate(in);
}
template <class Any>
Json json_of(const Any& certificate) {
  return Json::parse(certificate_text(certificate));
}
std::string text_of(const Certificate& certificate) {
  return std::visit([](const auto& one) { return certificate_text(one); }, certificate);
}
/// The first form: every point where it is used.
Json written_out(Json json) {
  const Json table = json["points"];
  json.erase("points");
  for (const char* key : {"fragments", "pieces"})
    for (Json& entry : json[key])
      for (Json& vertex : entry["vertices"]) vertex = table[vertex.get<std::size_t>()];
  std::string format = json["format"];
  format.back() = '1';
  json["format"] = format;
  return json;
}
std::string fault_of(const std::string& text) {
  try {
    read(text);
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "nothing";
}

TEST(Certificate_json, what_is_written_is_read_back) {
  const Scene scene = example();
  EXPECT_TRUE(scene.verdict().accepted) << scene.verdict().why;
  const Order_certificate again = read(certificate_text(scene.certificate));
  EXPECT_EQ(again.eye, scene.certificate.eye);
  ASSERT_EQ(again.fragments.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again.fragments[i].face, scene.certificate.fragments[i].face);
    EXPECT_EQ(again.fragments[i].piece, scene.certificate.fragments[i].piece);
    EXPECT_EQ(again.fragments[i].vertices, scene.certificate.fragments[i].vertices);
  }
  ASSERT_EQ(again.pieces.size(), 2u);
  EXPECT_EQ(again.pieces[1].piece, 1u);
  EXPECT_EQ(again.pieces[1].vertices, scene.certificate.pieces[1].vertices);
  ASSERT_EQ(again.set_aside.size(), 1u);
  EXPECT_EQ(again.set_aside[0].face, 2u);
  EXPECT_EQ(again.set_aside[0].why, "zero area");
  EXPECT_TRUE(verify_order(scene.soup, again).accepted);
  EXPECT_EQ(certificate_text(again), certificate_text(scene.certificate));
  EXPECT_FALSE(again.on_view);
  Order_certificate odd = scene.certificate;
  odd.set_aside[0].why = "said \"so\", by C:\\it\n\tand \x01";
  EXPECT_EQ(read(certificate_text(odd)).set_aside[0].why, odd.set_aside[0].why);
  Order_certificate on_view = scene.certificate;
  on_view.on_view = true;
  EXPECT_TRUE(read(certificate_text(on_view)).on_view);
}

TEST(Certificate_json, cuts_are_read_back_and_may_be_left_out) {
  Order_certificate certificate = example().certificate;
  EXPECT_FALSE(json_of(certificate).contains("depths"));
  certificate.cuts = {{1, 0, 2}, {{2, 1, {ratio(1, 3), 0, -1, 7}}}};
  const Json json = json_of(certificate);
  EXPECT_EQ(json["depths"], Json::parse("[1, 0, 2]"));
  EXPECT_EQ(json["cuts"], Json::parse(R"([[2, 1, ["1/3", "0", "-1", "7"]]])"));
  const Order_certificate again = read(certificate_text(certificate));
  EXPECT_EQ(again.cuts.depths, certificate.cuts.depths);
  ASSERT_EQ(again.cuts.others.size(), 1u);
  EXPECT_EQ(again.cuts.others[0].place, 2u);
  EXPECT_EQ(again.cuts.others[0].depth, 1u);
  EXPECT_EQ(again.cuts.others[0].plane, certificate.cuts.others[0].plane);
  const auto with = [&](const char* key, const char* value) {
    Json changed = json;
    changed[key] = Json::parse(value);
    return fault_of(changed.dump());
  };
  EXPECT_NE(with("depths", "[1, -1]").find("depths[1]: expected an integer"), std::string::npos);
  EXPECT_NE(with("cuts", "[[2, 1]]").find("cuts[0]: expected [place, depth, plane]"), std::string::npos);
  EXPECT_NE(with("cuts", R"([[2, 1, ["1", "0", "1"]]])").find("cuts[0][2]: expected four"), std::string::npos);
}

TEST(Certificate_json, has_the_documented_keys) {
  const Json json = json_of(example().certificate);
  EXPECT_EQ(json["format"], "sightline order 2");
  EXPECT_EQ(json["eye"][0], "-1/7");
  EXPECT_EQ(json["points"][1], (Json{"1/3", "0", "-1"}));
  EXPECT_EQ(json["fragments"][0]["vertices"], Json::parse("[0, 1, 2, 3]"));
  EXPECT_EQ(json["fragments"][2]["vertices"], Json::parse("[4, 6, 7]")) << "a point is in the table once";
  EXPECT_EQ(json["points"].size(), 8u);
  EXPECT_EQ(json["fragments"][2]["face"], 1);
  EXPECT_EQ(json["fragments"][2]["piece"], 1);
  EXPECT_EQ(json["set_aside"][0], (Json{{"face", 2}, {"why", "zero area"}}));
  EXPECT_TRUE(json_of(Order_certificate{})["pieces"].is_array());
}

TEST(Certificate_json, points_may_be_named_or_written_out_in_either_form_and_keys_are_in_any_order) {
  const Scene scene = example();
  const Json tight = json_of(scene.certificate), plain = written_out(tight);
  const std::string text = certificate_text(scene.certificate);
  EXPECT_EQ(plain["fragments"][2]["vertices"][1], (Json{"4", "4", "0"}));
  EXPECT_EQ(text_of(read_any(plain.dump())), text);
  Json mixed = plain;
  mixed["points"] = tight["points"];
  mixed["fragments"][2] = tight["fragments"][2];
  EXPECT_EQ(text_of(read_any(mixed.dump())), text) << "the table last";
  // Sorted by name, the table is behind what names its points.
  EXPECT_EQ(text_of(read_any(nlohmann::json::parse(text).dump(1))), text);
  for (const char* number : {"1", "2"}) {
    Json other = tight;
    other["format"] = std::string("sightline order ") + number;
    EXPECT_EQ(text_of(read_any(other.dump())), text) << number;
  }
}

TEST(Certificate_json, broken_tables_are_refused_with_line_and_column) {
  const auto with = [](const std::string& points, const std::string& vertices) {
    return "{\"format\":\"sightline order 2\",\"eye\":[\"0\",\"0\",\"0\"],\n" + points +
           "\"fragments\":[\n {\"face\":0,\"piece\":0,\"vertices\":" + vertices + "}]}";
  };
  const std::string table = R"("points":[["0","0","0"],["1","0","0"]],)";
  EXPECT_EQ(fault_of(with(table, "[0,1,0]")), "nothing");
  const std::string at = "certificate: line 3, column 2: fragments[0].vertices[1]: ";
  EXPECT_EQ(fault_of(with(table, "[0,2]")), at + "expected a number below 2, the size of \"points\"");
  EXPECT_EQ(fault_of(with(table, "[0,-1]")), at + "expected an integer from 0 to 4294967295");
  EXPECT_EQ(fault_of(with(table, "[0,0.5]")), at + "expected an integer from 0 to 4294967295");
  EXPECT_EQ(fault_of(with(table, "[0,4294967296]")), at + "expected an integer from 0 to 4294967295");
  EXPECT_EQ(fault_of(with(table, "[0,1e300]")), at + "expected an integer from 0 to 4294967295");
  EXPECT_EQ(fault_of(with(table, "[0,\"1\"]")), at + "expected an array");
  EXPECT_EQ(fault_of(with(table, "[0,null]")), at + "expected an array");
  const std::string late = "certificate: fragments[0].vertices[0]: ";
  EXPECT_EQ(fault_of(with("", "[0,1]")), late + "is a number, but there is no table \"points\"");
  EXPECT_EQ(
      fault_of(with(R"("points":[],)", "[0]")),
      "certificate: line 3, column 2: fragments[0].vertices[0]: expected a number below 0, the size of \"points\"");
  EXPECT_EQ(fault_of(with(R"("points":7,)", "[0]")), "certificate: line 2, column 11: points: expected an array");
  EXPECT_EQ(fault_of(with(R"("points":{},)", "[0]")), "certificate: line 2, column 10: points: expected an array");
  EXPECT_EQ(fault_of(with(R"("points":[0],)", "[0]")), "certificate: line 2, column 12: points[0]: expected an array");
  EXPECT_EQ(fault_of(with(R"("points":[["1","2"]],)", "[0]")),
            "certificate: line 2, column 11: points[0]: expected three numbers");
  EXPECT_EQ(fault_of(with(R"("points":[["1","2","1/0"]],)", "[0]")),
            "certificate: line 2, column 11: points[0]: zero denominator in \"1/0\"");
  EXPECT_EQ(fault_of(with(table + table, "[0]")), "certificate: line 2, column 47: points: is there twice");
  EXPECT_EQ(fault_of(with(R"("points":[[[[[[[[[[[[]]]]]]]]]]]],)", "[0]")),
            "certificate: line 2, column 11: points[0]: is nested too deeply");
  EXPECT_EQ(fault_of(with(table, "[0,1]") + "x"), "certificate: line 3, column 41: from here on it is no JSON");
}

TEST(Certificate_json, a_large_point_is_not_named_without_end) {
  // A megabyte of text, which written out would be a hundred gigabytes.
  const auto with = [](std::size_t uses) {
    std::string text = R"({"format":"sightline order 2","eye":["0","0","0"],"points":[["0","0","1)" +
                       std::string(500000, '7') + R"("]],"fragments":[{"face":0,"piece":0,"vertices":[0)";
    for (std::size_t k = 1; k < uses; ++k) text += ",0";
    return text + "]}]}";
  };
  EXPECT_EQ(fault_of(with(100)), "nothing");
  const std::string fault = fault_of(with(200000));
  EXPECT_NE(fault.find("are named so often that they take more than 64 times the file, and 256 MiB"), std::string::npos)
      << fault;
}

TEST(Certificate_json, a_large_ray_is_not_named_without_end) {
  const auto with = [](std::size_t uses) {
    std::string text = R"({"format":"sightline see 2","eye":["0","0","0"],"rays":[["0","0","1)" +
                       std::string(500000, '7') + R"("]],"parts":[{"fragment":0,"rays":[0,0,0]})";
    for (std::size_t k = 1; k < uses; ++k) text += R"(,{"fragment":0,"rays":[0,0,0]})";
    return text +
           R"(],"empty":[],"fragments":[{"face":0,"piece":0,"vertices":[["0","0","0"],["1","0","0"],["0","1","0"]]}]})";
  };
  std::istringstream few(with(100)), many(with(10000));
  EXPECT_NO_THROW(read_certificate(few));
  try {
    read_certificate(many);
    FAIL();
  } catch (const Certificate_error& error) {
    EXPECT_NE(error.message.find("are named so often that they take more than 64 times the file"), std::string::npos)
        << error.message;
  }
}

TEST(Certificate_json, what_has_a_key_twice_is_refused) {
  const auto with = [](const std::string& fragment) {
    return R"({"format":"sightline order 2","eye":["0","0","0"],"fragments":[)" + fragment + "]}";
  };
  EXPECT_EQ(fault_of(with(R"({"face":0,"piece":0,"vertices":[],"face":1})")),
            "certificate: line 1, column 106: fragments[0]: the key \"face\" is there twice");
}

TEST(Certificate_json, a_moment_is_a_root_or_a_quadratic) {
  for (const std::string& more :
       std::vector<std::string>{R"("quadratic":["1","0","-1"])", R"("low":"0")", R"("high":"1")"}) {
    const std::string text =
        R"({"format":"sightline along 2","path":[["0","0","5"],["1","0","5"]],"moments":[{"root":"0",)" + more +
        R"(},{"root":"1"}]})";
    try {
      read_any(text);
      ADD_FAILURE() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("moments[0]: expected a \"root\" or a \"quadratic\", not both"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(Certificate_json, what_belongs_to_another_kind_is_passed_over) {
  const std::string head =
      R"({"arcs":7,"parts":[1],"rays":{"a":[[[[[[[[[[]]]]]]]]]]},"lines":[[0]],"empty":[[[5]],[1]],)";
  EXPECT_EQ(fault_of(head + R"("format":"sightline order 2","eye":["0","0","1/2"],"fragments":[]})"), "nothing");
  EXPECT_NE(
      fault_of(head + R"("format":"sightline graph 2","sizes":[],"fragments":[]})").find("arcs: expected an array"),
      std::string::npos);
  // So is what would be right in its own kind, but for what it refers to.
  const std::string refers = R"({"arcs":[[9,0,9,0]],"parts":[{"fragment":9,"rays":[]}],"lines":[[9,0]],)";
  EXPECT_EQ(fault_of(refers + R"("format":"sightline order 2","eye":["0","0","1/2"],"fragments":[]})"), "nothing");
  EXPECT_NE(fault_of(refers + R"("format":"sightline graph 2","sizes":[],"fragments":[]})")
                .find("arcs[0]: expected a number below 0"),
            std::string::npos);
}

TEST(Certificate_json, takes_a_quarter_of_the_text_where_faces_share_points) {
  // A roof of 400 triangles, each of whose corners six of them share, with numbers of twenty digits.
  Order_certificate certificate;
  const auto corner = [](long i, long j) {
    return at(Rational(exact_decimal(i, -2) + 1 / tiny(60)), Rational(exact_decimal(j, -2) + 1 / tiny(61)),
              Rational(i * j) + 1 / tiny(62));
  };
  for (long i = 0; i < 20; ++i)
    for (long j = 0; j < 20; ++j)
      for (const bool upper : {false, true})
        certificate.fragments.push_back({0,
                                         0,
                                         {corner(i, j), upper ? corner(i + 1, j + 1) : corner(i + 1, j),
                                          upper ? corner(i, j + 1) : corner(i + 1, j + 1)}});
  const std::string text = certificate_text(certificate);
  EXPECT_LT(3 * text.size(), written_out(Json::parse(text)).dump().size());
  EXPECT_EQ(text_of(read_any(text)), text);
}

TEST(Certificate_json, faults_are_named_with_their_place) {
  const std::string head = R"({"format":"sightline order 1","eye":["0","0","1/2"],)";
  EXPECT_EQ(fault_of(head + R"("fragments":[]})"), "nothing");
  EXPECT_EQ(fault_of(head + R"("fragments":[],"more":1})"), "nothing");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "line 1, column 1: the JSON ends too early"},
      {"{", "line 1, column 2: the JSON ends too early"},
      {"[1,2]", "top level: expected an object"},
      {"3", "top level: expected an object"},
      {"{}", "no \"format\""},
      {R"({"format":"sightline order 3"})", "format: expected \"sightline order 2\""},
      {R"({"format":"sightline graph 2","sizes":[],"arcs":[],"fragments":[]})",
       "format: expected \"sightline order 2\""},
      {R"({"format":1})", "format: expected"},
      {R"({"format":"sightline order 1"})", "no \"eye\""},
      {R"({"format":"sightline order 1","eye":["0","0"],"fragments":[]})", "eye: expected three numbers"},
      {R"({"format":"sightline order 1","eye":["0","0","0","0"],"fragments":[]})", "eye: expected three numbers"},
      {R"({"format":"sightline order 1","eye":"0","fragments":[]})", "eye: expected an array"},
      {R"({"format":"sightline order 1","eye":[0,0,0.5],"fragments":[]})", "expected exact numbers as strings"},
      {R"({"format":"sightline order 1","eye":["0","0","1/0"],"fragments":[]})", "eye: zero denominator"},
      {R"({"format":"sightline order 1","eye":["0","0","0.5"],"fragments":[]})", "eye: not a number"},
      {R"({"format":"sightline order 1","eye":["0","0",""],"fragments":[]})", "eye: not a number"},
      {head + R"("pieces":[]})", "no \"fragments\""},
      {head + R"("on_view":1,"fragments":[]})", "on_view: expected true or false"},
      {head + R"("fragments":{}})", "fragments: expected an array"},
      {head + R"("fragments":[7]})", "fragments[0]: expected an object"},
      {head + R"("fragments":[{"piece":0,"vertices":[]}]})", "fragments[0]: no \"face\""},
      {head + R"("fragments":[{"face":0,"vertices":[]}]})", "fragments[0]: no \"piece\""},
      {head + R"("fragments":[{"face":0,"piece":0}]})", "fragments[0]: no \"vertices\""},
      {head + R"("fragments":[{"face":-1,"piece":0,"vertices":[]}]})", "fragments[0].face: expected an integer"},
      {head + R"("fragments":[{"face":4294967296,"piece":0,"vertices":[]}]})",
       "fragments[0].face: expected an integer"},
      {head + R"("fragments":[{"face":0,"piece":0.5,"vertices":[]}]})", "fragments[0].piece: expected an integer"},
      {head + R"("fragments":[{"face":0,"piece":"0","vertices":[]}]})", "fragments[0].piece: expected an integer"},
      {head + R"("fragments":[{"face":0,"piece":0,"vertices":[["0","0","0"],["0","x","0"]]}]})",
       "fragments[0].vertices[1]: not a number"},
      {head + R"("fragments":[],"pieces":[{"face":0}]})", "pieces[0]: no \"piece\""},
      {head + R"("fragments":[],"pieces":7})", "pieces: expected an array"},
      {head + R"("fragments":[],"set_aside":7})", "set_aside: expected an array"},
      {head + R"("fragments":[],"set_aside":[{"face":0}]})", "set_aside[0]: no \"why\""},
      {head + R"("fragments":[],"set_aside":[{"why":"zero area"}]})", "set_aside[0]: no \"face\""},
      {head + R"("fragments":[],"set_aside":[{"face":0,"why":1}]})", "set_aside[0].why: expected a string"},
      {std::string(100000, '['), "line 1, column 1: top level: expected an object"},
      {"{\"x\":" + std::string(100000, '['), "line 1, column 100006: the JSON ends too early"},
      {"\"\xff\xfe\"", "line 1, column 2: from here on it is no JSON"},
  };
  for (const auto& [text, words] : cases)
    EXPECT_NE(fault_of(text).find(words), std::string::npos) << text.substr(0, 200) << " -> " << fault_of(text);
}

TEST(Certificate_json, of_what_polygons_can_see_is_read_back_and_judged_the_same) {
  auto scenes = weak_test::all_scenes();
  scenes.push_back({"nothing", {}});
  for (const auto& [what, scene] : scenes) {
    SCOPED_TRACE(what);
    const Json json = json_of(scene.certificate);
    const Certificate again = read_any(json.dump());
    ASSERT_TRUE(std::holds_alternative<Weak_certificate>(again));
    const auto& weak = std::get<Weak_certificate>(again);
    EXPECT_EQ(json_of(weak), json);
    EXPECT_EQ(text_of(read_any(written_out(json).dump())), certificate_text(weak));
    EXPECT_EQ(text_of(read_any(nlohmann::json(json).dump())), certificate_text(weak)) << "sorted by name";
    EXPECT_EQ(verify_weak(scene.soup, weak).why, scene.verdict().why);
    EXPECT_EQ(verify_weak(scene.soup, weak).accepted, scene.verdict().accepted);
  }
}

TEST(Certificate_json, of_what_polygons_can_see_has_the_documented_keys) {
  const Json json = json_of(weak_test::skew_slit_both().certificate);
  EXPECT_EQ(json["format"], "sightline weak 4");
  EXPECT_EQ(json["sources"][0][1], (Json{"-1/100", "0", "0"}));
  EXPECT_EQ(json["lines"], Json::parse("[[1, 2], [2, 0]]"));
  EXPECT_EQ(json["hidden"][0]["fragment"], 0);
  EXPECT_EQ(json["hidden"][0]["source"], 0);
  const char* proof =
      R"([["line",0],["line",1],["empty",[[0,"5/81",{"target":["1","0","0","1"]}],[1,"1",{"source":["0","1/100","0","1"]}]]],["blocked",2],["blocked",1]])";
  EXPECT_EQ(json["hidden"][0]["proof"], Json::parse(proof));
  EXPECT_EQ(json["hidden"][1]["proof"], Json::parse(R"([["away"]])"));
  EXPECT_FALSE(json["hidden"][1].contains("also"));
  weak_test::Weak_scene together = weak_test::all_away();
  together.certificate.hidden = {{1, 0, {weak_test::away()}, {0, 2}}};
  EXPECT_EQ(json_of(together.certificate)["hidden"],
            Json::parse(R"([{"fragment":1,"source":0,"proof":[["away"]],"also":[0,2]}])"));
  EXPECT_EQ(certificate_text(std::get<Weak_certificate>(read_any(certificate_text(together.certificate)))),
            certificate_text(together.certificate));
  EXPECT_FALSE(json.contains("two_sided"));
  EXPECT_TRUE(json_of(weak_test::two_sided().certificate)["two_sided"]);
  const Json cuts = json_of(weak_test::two_sources().certificate);
  EXPECT_EQ(cuts["hidden"][4]["proof"],
            Json::parse(R"([["cut source",["1","0","0","-2"]],["blocked",2],["empty",[]]])"));
  EXPECT_EQ(cuts["hidden"][7]["proof"][0], Json::parse(R"(["cut target",["0","0","1","5"]])"));
  EXPECT_EQ(cuts["undecided"], Json::parse("[3]"));
  EXPECT_EQ(json_of(weak_test::open_slit().certificate)["visible"][0],
            Json::parse(R"({"fragment":0,"source":0,"from":["3/5","1/2","0"],"to":["3/5","1/2","3"]})"));
}

TEST(Certificate_json, faults_in_what_polygons_can_see_are_named_with_their_place) {
  const auto fault = [](const std::string& path, const std::string& text) {
    Json json = json_of(weak_test::two_sources().certificate);
    json["visible"] = Json::parse(R"([{"fragment":0,"source":1,"from":["0","0","0"],"to":["0","0","0"]}])");
    if (text.empty()) {
      Json& parent = json[Json::json_pointer(path).parent_pointer()];
      parent.erase(Json::json_pointer(path).back());
    } else {
      json[Json::json_pointer(path)] = Json::parse(text);
    }
    try {
      read_any(json.dump());
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(fault("/more", "1"), "nothing");
  for (const char* optional : {"/undecided", "/pieces", "/set_aside"}) EXPECT_EQ(fault(optional, ""), "nothing");
  const std::vector<std::array<std::string, 3>> cases = {
      {"/format", "\"sightline weak 5\"", "format: expected \"sightline order 2\", or graph, see, weak or along"},
      {"/sources", "", "top level: no \"sources\""},
      {"/sources", "7", "sources: expected an array"},
      {"/sources/1", "7", "sources[1]: expected an array"},
      {"/sources/1/2", R"(["0","0"])", "sources[1][2]: expected three numbers"},
      {"/two_sided", "1", "two_sided: expected true or false"},
      {"/lines", "", "top level: no \"lines\""},
      {"/lines", "{}", "lines: expected an array"},
      {"/lines/0", "[1]", "lines[0]: expected [fragment, corner]"},
      {"/lines/0", "[5,0]", "lines[0]: expected a number below 5"},
      {"/lines/0", "[1,4]", "lines[0]: expected a number below 4"},
      {"/lines/0", "[-1,0]", "lines[0]: expected an integer"},
      {"/visible", "", "top level: no \"visible\""},
      {"/visible", "3", "visible: expected an array"},
      {"/visible/0", "3", "visible[0]: expected an object"},
      {"/visible/0/fragment", "", "visible[0]: no \"fragment\""},
      {"/visible/0/fragment", "5", "visible[0].fragment: expected a number below 5"},
      {"/visible/0/source", "", "visible[0]: no \"source\""},
      {"/visible/0/source", "2", "visible[0].source: expected a number below 2"},
      {"/visible/0/from", "", "visible[0]: no \"from\""},
      {"/visible/0/from", R"(["0","0","x"])", "visible[0].from: not a number"},
      {"/visible/0/to", "[1,2,3]", "visible[0].to: expected exact numbers as strings"},
      {"/hidden", "", "top level: no \"hidden\""},
      {"/hidden", "3", "hidden: expected an array"},
      {"/hidden/1", "3", "hidden[1]: expected an object"},
      {"/hidden/1/fragment", "\"1\"", "hidden[1].fragment: expected an integer"},
      {"/hidden/1/fragment", "9", "hidden[1].fragment: expected a number below 5"},
      {"/hidden/1/source", "9", "hidden[1].source: expected a number below 2"},
      {"/hidden/1/also", "3", "hidden[1].also: expected an array"},
      {"/hidden/1/also", "[2, -3]", "hidden[1].also[1]: expected an integer"},
      {"/hidden/1/also", "[2, 5]", "hidden[1].also[1]: expected a number below 5"},
      {"/hidden/1/proof", "", "hidden[1]: no \"proof\""},
      {"/hidden/1/proof", "{}", "hidden[1].proof: expected an array"},
      {"/hidden/1/proof/0", "3", "hidden[1].proof[0]: expected an array"},
      {"/hidden/1/proof/0", "[]", "hidden[1].proof[0]: expected an array that begins with a word"},
      {"/hidden/1/proof/0", "[3]", "hidden[1].proof[0]: expected an array that begins with a word"},
      {"/hidden/1/proof/0", "[\"near\"]", "hidden[1].proof[0][0]: expected \"line\""},
      {"/hidden/1/proof/0", "[\"away\",1]", "hidden[1].proof[0]: expected 1 entry"},
      {"/hidden/1/proof/0", "[\"line\"]", "hidden[1].proof[0]: expected 2 entries"},
      {"/hidden/1/proof/0", "[\"line\",1]", "hidden[1].proof[0][1]: expected a number below 1"},
      {"/hidden/1/proof/0", "[\"blocked\",5]", "hidden[1].proof[0][1]: expected a number below 5"},
      {"/hidden/1/proof/0", R"(["cut source",["1","2","3"]])", "hidden[1].proof[0][1]: expected four numbers"},
      {"/hidden/1/proof/0", R"(["cut target",["1","2","3","4","5"]])", "hidden[1].proof[0][1]: expected four numbers"},
      {"/hidden/1/proof/0", R"(["cut target",["1","2","3","1/0"]])", "hidden[1].proof[0][1]: zero denominator"},
      {"/hidden/1/proof/0", R"(["empty",7])", "hidden[1].proof[0][1]: expected an array"},
      {"/hidden/1/proof/0", R"(["empty",[7]])", "hidden[1].proof[0][1][0]: expected an array"},
      {"/hidden/1/proof/0", R"(["empty",[[0]]])",
       "hidden[1].proof[0][1][0]: expected [line, factor] or [line, factor, forms]"},
      {"/hidden/1/proof/0", R"(["empty",[[0,"1"],[1,"1"]]])", "hidden[1].proof[0][1][1][0]: expected a number below 1"},
      {"/hidden/1/proof/0", R"(["empty",[[0,1]]])", "hidden[1].proof[0][1][0][1]: expected exact numbers as strings"},
      {"/hidden/1/proof/0", R"(["empty",[[0,"1",[]]]])", "hidden[1].proof[0][1][0][2]: expected an object"},
      {"/hidden/1/proof/0", R"(["empty",[[0,"1",{"source":["1"]}]]])",
       "hidden[1].proof[0][1][0][2].source: expected four numbers"},
      {"/hidden/1/proof/0", R"(["empty",[[0,"1",{"target":7}]]])",
       "hidden[1].proof[0][1][0][2].target: expected an array"},
      {"/undecided", "7", "undecided: expected an array"},
      {"/undecided/0", "-7", "undecided[0]: expected an integer"},
  };
  for (const auto& [path, text, words] : cases)
    EXPECT_NE(fault(path, text).find(words), std::string::npos) << path << ' ' << text << " -> " << fault(path, text);
}

}  // namespace
