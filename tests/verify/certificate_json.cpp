// Certificates as JSON: what is written is read back, and what is not a certificate is said so.

#include "weak_scenes.h"

#include <sightline/algorithms/verify/certificate_json.h>

#include <nlohmann/json.hpp>

#include <sstream>

namespace {

using namespace verify_test;

Scene example() {
  Scene scene;
  const Points square = rectangle(0, ratio(1, 3), 0, 4, -1),
               skew = {at(0, 0, 0), at(4, 0, 1), at(4, 4, 0), at(0, 4, 1)};
  scene.seen_from(at(ratio(-1, 7), 2, 1 / tiny(200))).face(square);
  scene.face(skew), scene.face({});
  const Points first = {skew[0], skew[1], skew[2]}, second = {skew[0], skew[2], skew[3]};
  return scene.cut(1, 0, first)
      .cut(1, 1, second)
      .draw(0, square)
      .draw(1, first, 0)
      .draw(1, second, 1)
      .leave_out(2, "zero area");
}

Order_certificate read(const std::string& text) {
  std::istringstream in(text);
  return read_order_certificate(in);
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
  const Order_certificate again = read(to_json(scene.certificate).dump());
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
  EXPECT_EQ(to_json(again), to_json(scene.certificate));
  EXPECT_FALSE(again.on_view);
  Order_certificate on_view = scene.certificate;
  on_view.on_view = true;
  EXPECT_TRUE(read(to_json(on_view).dump()).on_view);
}

TEST(Certificate_json, has_the_documented_keys) {
  const nlohmann::json json = to_json(example().certificate);
  EXPECT_EQ(json["format"], "sightline order 1");
  EXPECT_EQ(json["eye"][0], "-1/7");
  EXPECT_EQ(json["fragments"][0]["vertices"][1], (nlohmann::json{"1/3", "0", "-1"}));
  EXPECT_EQ(json["fragments"][2]["face"], 1);
  EXPECT_EQ(json["fragments"][2]["piece"], 1);
  EXPECT_EQ(json["set_aside"][0], (nlohmann::json{{"face", 2}, {"why", "zero area"}}));
  EXPECT_TRUE(to_json(Order_certificate{})["pieces"].is_array());
}

TEST(Certificate_json, faults_are_named_with_their_place) {
  const std::string head = R"({"format":"sightline order 1","eye":["0","0","1/2"],)";
  EXPECT_EQ(fault_of(head + R"("fragments":[]})"), "nothing");
  EXPECT_EQ(fault_of(head + R"("fragments":[],"more":1})"), "nothing");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "parse error"},
      {"{", "parse error"},
      {"[1,2]", "top level: expected an object"},
      {"3", "top level: expected an object"},
      {"{}", "no \"format\""},
      {R"({"format":"sightline order 2"})", "format: expected \"sightline order 1\""},
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
      {std::string(100000, '['), "parse error"},
      {"\"\xff\xfe\"", "parse error"},
  };
  for (const auto& [text, words] : cases)
    EXPECT_NE(fault_of(text).find(words), std::string::npos) << text.substr(0, 200) << " -> " << fault_of(text);
}

TEST(Certificate_json, of_what_polygons_can_see_is_read_back_and_judged_the_same) {
  auto scenes = weak_test::all_scenes();
  scenes.push_back({"nothing", {}});
  for (const auto& [what, scene] : scenes) {
    SCOPED_TRACE(what);
    const nlohmann::json json = to_json(scene.certificate);
    std::istringstream text(json.dump());
    const Certificate again = read_certificate(text);
    ASSERT_TRUE(std::holds_alternative<Weak_certificate>(again));
    const auto& weak = std::get<Weak_certificate>(again);
    EXPECT_EQ(to_json(weak), json);
    EXPECT_EQ(verify_weak(scene.soup, weak).why, scene.verdict().why);
    EXPECT_EQ(verify_weak(scene.soup, weak).accepted, scene.verdict().accepted);
  }
}

TEST(Certificate_json, of_what_polygons_can_see_has_the_documented_keys) {
  const nlohmann::json json = to_json(weak_test::skew_slit_both().certificate);
  EXPECT_EQ(json["format"], "sightline weak 1");
  EXPECT_EQ(json["sources"][0][1], (nlohmann::json{"-1/100", "0", "0"}));
  EXPECT_EQ(json["lines"], nlohmann::json::parse("[[1, 2], [2, 0]]"));
  EXPECT_EQ(json["hidden"][0]["fragment"], 0);
  EXPECT_EQ(json["hidden"][0]["source"], 0);
  const char* proof =
      R"([["line",0],["line",1],["empty",[[0,"5/81",{"target":["1","0","0","1"]}],[1,"1",{"source":["0","1/100","0","1"]}]]],["blocked",2],["blocked",1]])";
  EXPECT_EQ(json["hidden"][0]["proof"], nlohmann::json::parse(proof));
  EXPECT_EQ(json["hidden"][1]["proof"], nlohmann::json::parse(R"([["away"]])"));
  EXPECT_FALSE(json.contains("two_sided"));
  EXPECT_TRUE(to_json(weak_test::two_sided().certificate)["two_sided"]);
  const nlohmann::json cuts = to_json(weak_test::two_sources().certificate);
  EXPECT_EQ(cuts["hidden"][4]["proof"],
            nlohmann::json::parse(R"([["cut source",["1","0","0","-2"]],["blocked",2],["empty",[]]])"));
  EXPECT_EQ(cuts["hidden"][7]["proof"][0], nlohmann::json::parse(R"(["cut target",["0","0","1","5"]])"));
  EXPECT_EQ(cuts["undecided"], nlohmann::json::parse("[3]"));
  EXPECT_EQ(to_json(weak_test::open_slit().certificate)["visible"][0],
            nlohmann::json::parse(R"({"fragment":0,"source":0,"from":["3/5","1/2","0"],"to":["3/5","1/2","3"]})"));
}

TEST(Certificate_json, faults_in_what_polygons_can_see_are_named_with_their_place) {
  const auto fault = [](const std::string& path, const std::string& text) {
    nlohmann::json json = to_json(weak_test::two_sources().certificate);
    json["visible"] = nlohmann::json::parse(R"([{"fragment":0,"source":1,"from":["0","0","0"],"to":["0","0","0"]}])");
    if (text.empty()) {
      nlohmann::json& parent = json[nlohmann::json::json_pointer(path).parent_pointer()];
      parent.erase(nlohmann::json::json_pointer(path).back());
    } else {
      json[nlohmann::json::json_pointer(path)] = nlohmann::json::parse(text);
    }
    try {
      weak_certificate_from_json(json);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(fault("/more", "1"), "nothing");
  for (const char* optional : {"/undecided", "/pieces", "/set_aside"}) EXPECT_EQ(fault(optional, ""), "nothing");
  const std::vector<std::array<std::string, 3>> cases = {
      {"/format", "\"sightline weak 2\"", "format: expected \"sightline weak 1\""},
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
