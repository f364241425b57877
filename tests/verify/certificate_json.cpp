// Certificates as JSON: what is written is read back, and what is not a certificate is said so.

#include "scenes.h"

#include <sightline/algorithms/verify/certificate_json.h>

#include <sstream>

namespace {

using namespace verify_test;

Scene example() {
  Scene scene;
  const Points square = rectangle(0, ratio(1, 3), 0, 4, -1), skew = {at(0, 0, 0), at(4, 0, 1), at(4, 4, 0), at(0, 4, 1)};
  scene.seen_from(at(ratio(-1, 7), 2, 1 / tiny(200))).face(square);
  scene.face(skew), scene.face({});
  const Points first = {skew[0], skew[1], skew[2]}, second = {skew[0], skew[2], skew[3]};
  return scene.cut(1, 0, first).cut(1, 1, second).draw(0, square).draw(1, first, 0).draw(1, second, 1).leave_out(2, "zero area");
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
      {head + R"("fragments":[{"face":4294967296,"piece":0,"vertices":[]}]})", "fragments[0].face: expected an integer"},
      {head + R"("fragments":[{"face":0,"piece":0.5,"vertices":[]}]})", "fragments[0].piece: expected an integer"},
      {head + R"("fragments":[{"face":0,"piece":"0","vertices":[]}]})", "fragments[0].piece: expected an integer"},
      {head + R"("fragments":[{"face":0,"piece":0,"vertices":[["0","0","0"],["0","x","0"]]}]})", "fragments[0].vertices[1]: not a number"},
      {head + R"("fragments":[],"pieces":[{"face":0}]})", "pieces[0]: no \"piece\""},
      {head + R"("fragments":[],"pieces":7})", "pieces: expected an array"},
      {head + R"("fragments":[],"set_aside":7})", "set_aside: expected an array"},
      {head + R"("fragments":[],"set_aside":[{"face":0}]})", "set_aside[0]: no \"why\""},
      {head + R"("fragments":[],"set_aside":[{"why":"zero area"}]})", "set_aside[0]: no \"face\""},
      {head + R"("fragments":[],"set_aside":[{"face":0,"why":1}]})", "set_aside[0].why: expected a string"},
      {std::string(100000, '['), "parse error"},
      {"\"\xff\xfe\"", "parse error"},
  };
  for (const auto& [text, words] : cases) EXPECT_NE(fault_of(text).find(words), std::string::npos) << text.substr(0, 200) << " -> " << fault_of(text);
}

}  // namespace
