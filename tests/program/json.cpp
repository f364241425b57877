// What --json holds (design.md, section 7): keys, types, exact numbers as strings; the same at any number of threads.

#include "program.h"

#include <map>

#include <regex>
#include <set>

namespace program {

class Json_output : public Program {
 protected:
  const std::string cornell = (corpus / "general" / "cornell.obj").string();

  Json json_of(std::vector<std::string> arguments, int code = done) {
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, code) << r;
    EXPECT_EQ(r.err, "") << r;
    const Json document = r.json();
    EXPECT_TRUE(document.is_object()) << "standard output is one JSON document and nothing else: " << r;
    return document;
  }
  static void expect_exact_point(const Json& p) {
    static const std::regex exact("-?(0|[1-9][0-9]*)(/[1-9][0-9]*)?");
    ASSERT_TRUE(p.is_array() && p.size() == 3) << p;
    for (const Json& x : p) EXPECT_TRUE(x.is_string() && std::regex_match(x.get<std::string>(), exact)) << p;
  }
  /// The keys of every command, and those of the scene.
  static void expect_frame(const Json& document, const std::string& command, const std::string& file) {
    for (const char* key : {"command", "scene", "result", "counters", "seconds"})
      ASSERT_TRUE(document.contains(key)) << key;
    EXPECT_EQ(document["command"], command);
    EXPECT_TRUE(document["result"].is_object() && document["counters"].is_object() && document["seconds"].is_object());
    for (const auto& [what, seconds] : document["seconds"].items())
      EXPECT_TRUE(seconds.is_number() && seconds >= 0) << what;
    const Json& scene = document["scene"];
    EXPECT_EQ(scene["file"], file);
    EXPECT_TRUE(scene["faces_read"].is_number_unsigned() && scene["faces"].is_number_unsigned() &&
                scene["bits"].is_number_unsigned())
        << scene;
    EXPECT_TRUE(scene["arithmetic"].is_string()) << scene;
    EXPECT_EQ(scene["faces"].get<std::size_t>() + scene["set_aside"].size(), scene["faces_read"].get<std::size_t>());
    for (const Json& entry : scene["set_aside"]) {
      EXPECT_TRUE(entry["face"].is_number_unsigned() && entry["why"].is_string()) << entry;
      EXPECT_LT(entry["face"], scene["faces_read"]);
    }
  }
};

TEST_F(Json_output, info_has_the_frame_and_its_counts) {
  const Json d = json_of({"info", cornell});
  expect_frame(d, "info", cornell);
  EXPECT_EQ(d["scene"]["faces_read"], 16);
  for (const char* key : {"points_read", "points", "pieces", "supporting_planes", "lines"})
    EXPECT_TRUE(d["result"][key].is_number_unsigned()) << key;
  EXPECT_EQ(d["result"]["points_read"], 28);
  EXPECT_EQ(d["result"]["closed"], false);
  ASSERT_EQ(d["result"]["box"].size(), 2u);
  EXPECT_EQ(d["result"]["box"][0], Json({"0", "0", "0"}));
  EXPECT_EQ(d["result"]["box"][1], Json({"10", "10", "10"}));
}

TEST_F(Json_output, info_lists_non_planar_and_concave_faces_by_their_place_in_the_file) {
  EXPECT_EQ(json_of({"info", (corpus / "robust" / "non_planar.off").string()})["result"]["non_planar"],
            Json({0, 1, 2}));
  EXPECT_EQ(json_of({"info", (corpus / "general" / "l_room.off").string()})["result"]["concave"], Json({0, 1}));
  EXPECT_EQ(json_of({"info", (corpus / "general" / "l_room.off").string()})["result"]["closed"], true);
  EXPECT_EQ(json_of({"info", (corpus / "general" / "keyhole.off").string()})["result"]["concave"], Json::array({0}));
}

TEST_F(Json_output, set_aside_says_which_faces_and_why) {
  const auto set_aside = [&](const char* name) {
    return json_of({"info", (corpus / "robust" / name).string()})["scene"]["set_aside"];
  };
  EXPECT_EQ(
      set_aside("duplicates.off"),
      Json::parse(
          R"([{"face":1,"why":"duplicate of 0"},{"face":2,"why":"duplicate of 0"},{"face":5,"why":"duplicate of 4"}])"));
  Json zero = Json::array();
  for (const int face : {1, 2, 3, 4, 5, 6, 8}) zero.push_back({{"face", face}, {"why", "zero area"}});
  EXPECT_EQ(set_aside("zero_area.off"), zero);
  Json crossing = Json::array();
  for (const int face : {0, 1, 2}) crossing.push_back({{"face", face}, {"why", "self-intersecting"}});
  EXPECT_EQ(set_aside("bow_ties.off"), crossing);
  EXPECT_EQ(set_aside("one_ulp.off"), Json::array());
}

TEST_F(Json_output, bits_are_those_of_the_largest_coordinate_at_the_least_scale) {
  EXPECT_EQ(json_of({"info", file("a.off", "OFF\n3 1 0\n0 0 0\n1000 0 0\n0 -1024 0\n3 0 1 2\n")})["scene"]["bits"], 11);
  EXPECT_EQ(json_of({"info", file("b.off", "OFF\n3 1 0\n0 0 0\n0.5 0 0\n0 1 0\n3 0 1 2\n")})["scene"]["bits"], 2)
      << "halves: 1 is 2 of them";
  EXPECT_EQ(json_of({"info", file("c.off", "OFF\n3 1 0\n0 0 0\n0.015625 0 0\n0 1 0\n3 0 1 2\n")})["scene"]["bits"], 7)
      << "64ths, not millionths: 1 is 64 of them";
}

TEST_F(Json_output, bsp_has_nodes_depth_splits_and_fragments) {
  const Json d = json_of({"bsp", cornell});
  expect_frame(d, "bsp", cornell);
  for (const char* key : {"nodes", "depth", "splits", "fragments"})
    EXPECT_TRUE(d["result"][key].is_number_unsigned()) << key;
  EXPECT_EQ(d["result"]["fragments"].get<int>(), d["scene"]["pieces"].get<int>() + d["result"]["splits"].get<int>());
  EXPECT_GE(d["result"]["nodes"].get<int>(), d["result"]["depth"].get<int>());
}

TEST_F(Json_output, order_lists_each_fragment_once_with_exact_vertices) {
  for (const char* name :
       {"cornell.obj", "l_room.off", "three_bars.off", "keyhole.off", "concave_star.off", "u_and_quad.off"}) {
    const std::string scene = (corpus / "general" / name).string();
    const Json d = json_of({"order", scene, "--eye", "1/3,-20.5,7e-1"});
    expect_frame(d, "order", scene);
    EXPECT_EQ(d["result"]["eye"], Json({"1/3", "-41/2", "7/10"}));
    EXPECT_EQ(d["result"]["fragments"].size(), json_of({"bsp", scene})["result"]["fragments"].get<std::size_t>());
    std::set<std::pair<int, int>> seen;
    std::set<int> faces;
    for (const Json& fragment : d["result"]["fragments"]) {
      EXPECT_TRUE(fragment["face"].is_number_unsigned() && fragment["piece"].is_number_unsigned());
      EXPECT_TRUE(seen.emplace(fragment["face"].get<int>(), fragment["piece"].get<int>()).second)
          << "[face, piece] twice: " << fragment;
      EXPECT_LT(fragment["face"], d["scene"]["faces_read"]);
      faces.insert(fragment["face"].get<int>());
      EXPECT_GE(fragment["vertices"].size(), 3u);
      for (const Json& p : fragment["vertices"]) expect_exact_point(p);
    }
    EXPECT_EQ(faces.size(), d["scene"]["faces"].get<std::size_t>()) << "each kept face is drawn";
  }
}

TEST_F(Json_output, order_is_farthest_first) {
  const std::string scene =
      file("three.off",
           "OFF\n9 3 0\n0 0 5\n9 0 5\n0 9 5\n0 0 1\n9 0 1\n0 9 1\n0 0 3\n9 0 3\n0 9 3\n3 0 1 2\n3 3 4 5\n3 6 7 8\n");
  const auto faces = [&](const char* eye) {
    const Json d = json_of({"order", scene, "--eye", eye});
    Json list = Json::array();
    for (const Json& fragment : d["result"]["fragments"]) list.push_back(fragment["face"]);
    return list;
  };
  EXPECT_EQ(faces("1,1,100"), Json({1, 2, 0}));
  EXPECT_EQ(faces("1,1,-100"), Json({0, 2, 1}));
  EXPECT_EQ(faces("1,1,1000000000000000000000000000000000000000000/2"), Json({1, 2, 0}));
}

TEST_F(Json_output, pieces_of_cyclic_overlaps_are_numbered_within_their_face) {
  const Json d = json_of({"order", (corpus / "general" / "three_bars.off").string(), "--eye", "4,3,100"});
  EXPECT_GE(d["counters"]["splits"], 1) << "a cycle takes a cut";
  std::map<int, std::set<int>> pieces;
  for (const Json& fragment : d["result"]["fragments"])
    pieces[fragment["face"].get<int>()].insert(fragment["piece"].get<int>());
  for (const auto& [face, numbers] : pieces) {
    EXPECT_EQ(*numbers.begin(), 0);
    EXPECT_EQ(*numbers.rbegin() + 1, static_cast<int>(numbers.size())) << "face " << face;
  }
}

TEST_F(Json_output, verify_says_accepted_and_why) {
  const std::string certificate = path("certificate.json").string();
  ASSERT_EQ(run({"order", cornell, "--eye", "5,-20,5", "--certificate", certificate}).code, done);
  const Json yes = json_of({"verify", cornell, certificate});
  expect_frame(yes, "verify", cornell);
  EXPECT_EQ(yes["result"]["accepted"], true);
  EXPECT_TRUE(yes["result"]["why"].is_string() && yes["result"]["why"] != "");
  const std::string other = (corpus / "general" / "cube.off").string();
  const Json no = json_of({"verify", other, certificate}, disagreement);
  expect_frame(no, "verify", other);
  EXPECT_EQ(no["result"]["accepted"], false);
  EXPECT_TRUE(no["result"]["why"].is_string() && no["result"]["why"] != "");
}

TEST_F(Json_output, compare_has_a_row_for_each_kernel) {
  const Json d = json_of({"compare", cornell, "order", "--eye", "5,-20,5"});
  expect_frame(d, "compare", cornell);
  std::vector<std::string> kernels;
  for (const Json& row : d["result"]["rows"]) {
    kernels.push_back(row["kernel"]);
    EXPECT_TRUE(row["method"].is_string()) << row;
    EXPECT_EQ(row["status"], "done");
    EXPECT_TRUE(row["seconds"].is_number() && row["seconds"] >= 0) << row;
    EXPECT_TRUE(row["peak_bytes"].is_number_unsigned()) << row;
    EXPECT_TRUE(row["errors"].is_object()) << row;
  }
  EXPECT_EQ(kernels, (std::vector<std::string>{"exact", "epeck", "gmpq", "epick", "double", "float"}));
}

TEST_F(Json_output, a_json_file_holds_the_same_as_standard_output_and_the_table_stays) {
  const Outcome r = run({"info", cornell, "--json", path("info.json").string()});
  EXPECT_EQ(r.code, done) << r;
  EXPECT_NE(r.out.find("arithmetic"), std::string::npos) << r;
  Json from_file = Json::parse(read_file(path("info.json"))), from_output = json_of({"info", cornell});
  from_file.erase("seconds");
  from_output.erase("seconds");
  EXPECT_EQ(from_file.dump(), from_output.dump());
}

TEST_F(Json_output, names_of_files_that_are_no_utf8_do_no_harm) {
  const std::string scene = file("na\xffme \"quoted\".off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(json_of({"info", scene})["scene"]["faces"], 1);
}

TEST_F(Json_output, coordinates_are_exact_decimals_or_the_nearest_doubles) {
  const std::string scene = file("tenth.off", "OFF\n3 1 0\n0.1 0 0\n1 0 0\n0 0.3 0\n3 0 1 2\n");
  const auto vertices = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words{"order", scene, "--eye", "0.1,0.2,0.3"};
    words.insert(words.end(), options.begin(), options.end());
    const Json d = json_of(words);
    EXPECT_EQ(d["result"]["eye"], Json({"1/10", "1/5", "3/10"})) << "the eye stays exact";
    std::set<std::string> all;
    for (const Json& p : d["result"]["fragments"][0]["vertices"])
      for (const Json& x : p) all.insert(x.get<std::string>());
    return all;
  };
  EXPECT_EQ(vertices({}), (std::set<std::string>{"0", "1", "1/10", "3/10"}));
  EXPECT_EQ(vertices({"--coordinates", "exact"}), (std::set<std::string>{"0", "1", "1/10", "3/10"}));
  EXPECT_EQ(
      vertices({"--coordinates", "double"}),
      (std::set<std::string>{"0", "1", "3602879701896397/36028797018963968", "5404319552844595/18014398509481984"}));
}

TEST_F(Json_output, verify_reads_the_scene_with_the_coordinates_it_is_told) {
  const std::string scene = file("tenth.off", "OFF\n3 1 0\n0.1 0 0\n1 0 0\n0 0.3 0\n3 0 1 2\n"),
                    certificate = path("c.json").string();
  ASSERT_EQ(run({"order", scene, "--eye", "1,2,3", "--coordinates", "double", "--certificate", certificate}).code,
            done);
  EXPECT_EQ(run({"verify", scene, certificate, "--coordinates", "double"}).code, done);
  EXPECT_EQ(run({"verify", scene, certificate}).code, disagreement) << "0.1 is not the double nearest to it";
}

TEST_F(Json_output, threads_change_nothing_but_seconds) {
  const std::string soup = path("soup.off").string();
  ASSERT_EQ(run({"generate", "soup", "--size", sanitized ? "200" : "800", "--out", soup}).code, done);
  for (const std::string& scene : {soup, cornell})
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"info", scene}, {"bsp", scene}, {"order", scene, "--eye", "1.5,-2,0.25"}}) {
      std::string first;
      for (const char* threads : {"1", "2", "2", "3", "8", "0"}) {
        std::vector<std::string> words = command;
        words.insert(words.end(), {"--threads", threads, "--certificate", path("c.json").string()});
        if (command[0] != "order") words.resize(words.size() - 2);
        words.insert(words.end(), {"--json", "-"});
        const Outcome r = run(words);
        ASSERT_EQ(r.code, done) << r;
        const std::string text =
            r.out.substr(0, r.out.rfind("\"seconds\"")) + (command[0] == "order" ? read_file(path("c.json")) : "");
        if (first.empty()) {
          first = text;
          const Json whole = r.json();
          EXPECT_EQ((--whole.end()).key(), "seconds") << "nothing is behind them";
        }
        EXPECT_TRUE(text == first) << command[0] << " --threads " << threads << " gives another result";
      }
    }
}

TEST_F(Json_output, more_threads_than_processors_are_no_reason_for_a_message) {
  const Outcome r = run({"bsp", cornell, "--threads", "64"}, {60, 65536});
  EXPECT_EQ(r.code, done) << r;
  EXPECT_EQ(r.err, "");
  const Outcome rays = run(
      {"render", cornell, "--method", "rays", "--size", "16x16", "--threads", "64", "--png", path("a.png").string()},
      {60, 65536});
  if (rays.code == usage) return;  // built without Embree
  EXPECT_EQ(rays.code, done) << rays;
  EXPECT_EQ(rays.err, "");
}

TEST_F(Json_output, the_seed_is_used_and_repeats) {
  const std::string soup = path("soup.off").string();
  ASSERT_EQ(run({"generate", "soup", "--size", "500", "--out", soup}).code, done);
  std::set<std::string> results;
  for (const char* seed : {"1", "2", "3", "4", "1", "4", "9999999999999999999"}) {
    const Json d = json_of({"bsp", soup, "--seed", seed});
    results.insert(d["result"].dump() + d["counters"].dump());
  }
  EXPECT_EQ(results.size(), 5u);
  EXPECT_EQ(json_of({"bsp", soup})["result"], json_of({"bsp", soup, "--seed", "1"})["result"]) << "1 is the default";
}

}  // namespace program
