// sightline cells, pvs, merge: levels in cells, tables whole and in parts, certificates in a folder.

#include "program.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <map>
#include <numeric>
#include <random>
#include <set>

namespace program {

class Levels : public Program {
 protected:
  const std::string rooms = (corpus / "general" / "two_rooms.map").string();

  std::string bytes_of(const std::string& file) {
    std::ifstream in(path(file), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string out(const std::string& file) { return path(file).string(); }
  /// The sum that a file of cells has of how they were made.
  static std::string sum_of(nlohmann::json made) {
    made.erase("sum");
    std::uint64_t sum = 0xcbf29ce484222325u;
    for (const char c : made.dump()) sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    std::ostringstream text;
    text << std::hex << std::setw(16) << std::setfill('0') << sum;
    return text.str();
  }
};

/// A table of no cells and a hundred million faces, none of which was asked about: 98 KB of zeros.
TEST_F(Levels, tables_that_announce_many_faces_are_merged_in_little_memory) {
  std::string bytes = "sightline pvs 1\n";
  const auto store = [&](std::uint32_t number) {
    for (int k = 0; k < 4; ++k, number >>= 8) bytes += static_cast<char>(number & 255);
  };
  const std::uint32_t runs = sanitized ? 490 : 49'000;
  store(0);
  store(0);
  store(runs * 255 * 8);
  for (std::uint32_t k = 0; k < runs; ++k) bytes += std::string("\0\xFF", 2);
  const std::string part = file("part.pvs", bytes), other = file("other.pvs", bytes);
  const Outcome twice = run({"merge", part, other, part, "--out", out("t.pvs")});
  EXPECT_EQ(twice.code, usage) << twice;
  EXPECT_NE(twice.err.find("part.pvs is named twice"), std::string::npos) << twice;
  const Outcome r = run({"merge", part, other, "--out", out("t.pvs")}, {60, 300});
  EXPECT_EQ(r.code, bad_input) << r;
  EXPECT_NE(r.err.find("face 0 and " + std::to_string(runs * 255 * 8 - 1) + " more are in no part"), std::string::npos)
      << r;
}

/// Tables by hand: of a cell and two faces in two parts, the one undecided; of two cells, undecided of each other.
TEST_F(Levels, merged_parts_with_undecided_pairs_end_as_undecided) {
  const auto table = [](char kind, const std::vector<std::string>& parts) {
    std::string bytes = std::string("sightline pvs ") + kind + "\n" + std::string(4, '\0');
    for (const std::string& part : parts) bytes += part;
    return bytes;
  };
  const std::string one("\1\0\0\0", 4), two("\2\0\0\0", 4), none("\0\1", 2);
  const std::string open = file("0.pvs", table('1', {one, two, "\1", "\1", none, "\1"}));
  const std::string rest = file("1.pvs", table('1', {one, two, "\1", "\2", "\2", none}));
  const Outcome faces = run({"merge", open, rest, "--out", out("all.pvs")});
  EXPECT_EQ(faces.code, undecided) << faces;
  EXPECT_NE(faces.out.find("1 pairs visible, 1 undecided"), std::string::npos) << faces;
  EXPECT_TRUE(std::filesystem::exists(path("all.pvs")));
  const std::string hidden = file("2.pvs", table('1', {one, two, "\1", "\1", none, none}));
  EXPECT_EQ(run({"merge", hidden, rest, "--out", out("all.pvs")}).code, done);

  const auto of_cells = [&](const std::string& undecided_cells) {
    return table('2', {two, one, "\3", "\1", "\3", "\1", none, none, undecided_cells, "\1", none, none, none});
  };
  const Outcome cells = run({"merge", file("3.pvs", of_cells("\2")), "--out", out("all.pvs")});
  EXPECT_EQ(cells.code, undecided) << cells;
  EXPECT_NE(cells.out.find("0 see each other, 1 undecided"), std::string::npos) << cells;
  EXPECT_EQ(run({"merge", file("4.pvs", of_cells(none)), "--out", out("all.pvs")}).code, done);
}

TEST_F(Levels, cells_are_counted_and_written) {
  const Outcome r = run({"cells", rooms, "--seal", "64,64,24", "--out", out("cells.json"), "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json result = r.json()["result"];
  EXPECT_EQ(result["closed"], true);
  EXPECT_EQ(result["leaks"].size(), 0u);
  const Json file = Json::parse(bytes_of("cells.json"));
  EXPECT_EQ(file["cells"].size(), result["cells"]);
  std::size_t portals = 0;
  for (const Json& wall : file["walls"])
    portals += !wall["open"].empty() && !file["cells"][wall["cells"][0].get<std::size_t>()]["solid"].get<bool>() &&
               !file["cells"][wall["cells"][1].get<std::size_t>()]["solid"].get<bool>();
  EXPECT_EQ(portals, result["portals"]);
}

TEST_F(Levels, of_faces_and_cells_take_the_same_work_at_any_number_of_threads) {
  Json first;
  for (const char* threads : {"1", "2", "4", "2", "8", "4"}) {
    const Outcome r = run({"pvs", rooms, "--cells-too", "--threads", threads, "--json", "-"});
    ASSERT_EQ(r.code, done) << r;
    Json said = r.json();
    said.erase("seconds");
    if (first.is_null()) first = said;
    EXPECT_EQ(said, first) << threads << " threads";
  }
}

TEST_F(Levels, cells_of_a_file_have_the_table_of_how_they_were_made) {
  const std::string cells = out("cells.json"), house = (corpus / "general" / "two_rooms.off").string();
  const std::vector<std::vector<std::string>> ways{{},
                                                   {"--grid", "3,2,1"},
                                                   {"--coarse", "4", "--candidates", "3"},
                                                   {"--volumes", (corpus / "general" / "cube.off").string()}};
  for (const std::vector<std::string>& way : ways) {
    if (sanitized && way.size() == 2) continue;  // half of them
    SCOPED_TRACE(way.empty() ? "" : way[0]);
    const auto with = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
      words.insert(words.end(), more.begin(), more.end());
      return run(words);
    };
    ASSERT_EQ(with({"cells", house, "--seed", "7", "--out", cells}, way).code, done);
    const Outcome made = with({"pvs", house, "--seed", "7", "--out", out("made.pvs"), "--json", "-"}, way),
                  read = run({"pvs", house, "--cells", cells, "--out", out("read.pvs"), "--json", "-"});
    ASSERT_EQ(made.code, done) << made;
    ASSERT_EQ(read.code, done) << read;
    EXPECT_EQ(bytes_of("read.pvs"), bytes_of("made.pvs"));
    EXPECT_EQ(read.json()["result"], made.json()["result"]);
    // Parts of both are parts of one table.
    ASSERT_EQ(with({"pvs", house, "--seed", "7", "--shard", "0/2", "--out", out("0.pvs")}, way).code, done);
    ASSERT_EQ(run({"pvs", house, "--cells", cells, "--shard", "1/2", "--resume", "--out", out("1.pvs")}).code, done);
    ASSERT_EQ(run({"merge", out("0.pvs"), out("1.pvs"), "--out", out("all.pvs")}).code, done);
    EXPECT_EQ(bytes_of("all.pvs"), bytes_of("made.pvs"));
  }
}

TEST_F(Levels, a_cell_file_of_another_scene_or_a_damaged_one_is_refused) {
  const std::string cells = out("cells.json");
  ASSERT_EQ(run({"cells", rooms, "--grid", "2,1,1", "--out", cells}).code, done);
  const Json right = Json::parse(bytes_of("cells.json"));
  const auto refused = [&](const std::string& scene, const std::string& says) {
    const Outcome r = run({"pvs", scene, "--cells", cells, "--out", out("t.pvs")});
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find("cells.json:"), std::string::npos) << r;
    EXPECT_NE(r.err.find(says), std::string::npos) << r;
    EXPECT_FALSE(std::filesystem::exists(path("t.pvs")));
  };
  refused((corpus / "general" / "cube.off").string(), "another scene");
  const auto damaged = [&](auto change, const std::string& says) {
    Json other = right;
    change(other);
    std::ofstream(cells, std::ios::binary) << other.dump();
    refused(rooms, says);
  };
  damaged([](Json& c) { c["points"][3][0] = "1/7"; }, "of its points number 3 is not");
  damaged([](Json& c) { c["cells"][2]["leaf"] = 9; }, "of its cells number 2 is not");
  damaged([](Json& c) { c["cells"].erase(c["cells"].size() - 1); }, "of its cells number");
  damaged(
      [](Json& c) {
        c["walls"][0]["open"] = Json::array();
        c["walls"][1]["corners"] = 3;
      },
      "of its walls number");
  damaged([](Json& c) { c.erase("walls"); }, "of its walls number 0");
  damaged([](Json& c) { c.erase("made"); }, "how its cells were made");
  damaged([](Json& c) { c["format"] = "sightline cells 0"; }, "is no file of cells");
  damaged(
      [](Json& c) {
        Json deep = Json::array();
        for (int k = 0; k < 1000; ++k) deep = Json::array({std::move(deep)});
        c["format"] = std::move(deep);
      },
      "is nested too deeply");
  damaged([](Json& c) { c = Json::array(); }, "is no file of cells");
  for (const char* key : {"by", "candidates", "seed", "question", "grid", "volumes", "tree", "sum"})
    damaged([&](Json& c) { c["made"][key] = "leaves"; }, "is damaged");
  damaged([](Json& c) { c["made"]["tree"]["nodes"][0][1] = 0; }, "is damaged");  // below itself
  // Whoever makes the sum again is held to the scene.
  const auto forged = [&](const Json& made, const std::string& says) {
    damaged(
        [&](Json& c) {
          c["made"].update(made);
          c["made"]["sum"] = sum_of(c["made"]);
        },
        says);
  };
  forged({{"grid", {1, 2, 1}}}, "of its");
  forged({{"grid", {0, 1, 1}}}, "--grid 0,1,1: three positive numbers");
  forged({{"grid", {100000, 100000, 1}}}, "more than 1000000 boxes");
  forged({{"by", "faces"}}, "of its");
  forged({{"by", "leaves"}}, "--leaves is of a level that is compiled");
  forged({{"by", "coarse"}, {"coarse", 3}}, "of its");
  forged({{"candidates", 0}}, "candidates");
  Json renamed = right;
  renamed["made"].update({{"question", ", of somebody else"}, {"tree", nullptr}});
  renamed["made"]["sum"] = sum_of(renamed["made"]);
  std::ofstream(cells, std::ios::binary) << renamed.dump();
  ASSERT_EQ(run({"pvs", rooms, "--cells", cells, "--out", out("renamed.pvs")}).code, done);
  ASSERT_EQ(run({"pvs", rooms, "--grid", "2,1,1", "--out", out("made.pvs")}).code, done);
  EXPECT_EQ(bytes_of("renamed.pvs"), bytes_of("made.pvs"));
  std::ofstream(cells, std::ios::binary) << right.dump().substr(0, 1000);
  refused(rooms, "ends too early");
  std::ofstream(cells, std::ios::binary) << right.dump();
  EXPECT_EQ(run({"pvs", rooms, "--cells", cells, "--grid", "2,1,1"}).code, usage);
  EXPECT_EQ(run({"pvs", rooms, "--cells", cells, "--candidates", "3"}).code, usage);
  EXPECT_EQ(run({"pvs", rooms, "--cells", cells, "--out", cells}).code, usage);
  EXPECT_EQ(run({"pvs", rooms, "--cells", cells}).code, done);
}

TEST_F(Levels, a_leak_is_found_and_a_solid_point_refused) {
  const Outcome leak = run({"cells", rooms, "--seal", "-20,0,0", "--json", "-"});
  EXPECT_EQ(leak.code, disagreement) << leak;
  EXPECT_EQ(leak.json()["result"]["leaks"].size(), 1u);
  const Outcome solid = run({"cells", rooms, "--seal", "-8,64,50"});
  EXPECT_EQ(solid.code, usage) << solid;
  EXPECT_NE(solid.err.find("--seal -8,64,50: the point is in a solid cell"), std::string::npos) << solid;
}

/// The two rooms less the ceiling's brush, or another one.
static std::string without_brush(const std::string& rooms, std::size_t brush) {
  std::string text = read_file(rooms);
  std::size_t begin = text.find("\n{\n(");
  for (; brush > 0; --brush) begin = text.find("\n{\n(", begin + 1);
  return text.erase(begin, text.find("\n}", begin) + 2 - begin);
}

TEST_F(Levels, what_stands_on_a_brush_is_in_the_room_beside_it) {
  std::string leak = without_brush(rooms, 1);
  const std::string origin = "\"64 64 24\"";
  ASSERT_NE(leak.find(origin), std::string::npos);
  for (const char* place :
       {"\"64 64 24\"", "\"64 64 0\"", "\"0 64 0\"", "\"0 0 0\""}) {  // in it, on its floor, an edge
    std::string with_place = leak;
    file("leak.map", with_place.replace(leak.find(origin), origin.size(), place));
    for (const char* seed : {"1", "2", "3"}) {
      const Outcome found = run({"cells", out("leak.map"), "--seal", "entities", "--seed", seed});
      EXPECT_EQ(found.code, disagreement) << place << found;
      EXPECT_NE(found.out.find("a leak"), std::string::npos) << found;
    }
    const Outcome refused = run({"pvs", out("leak.map"), "--out", out("leak.pvs")});
    EXPECT_EQ(refused.code, bad_input) << refused;
    EXPECT_NE(refused.err.find("there is a way out from info_player_start"), std::string::npos) << refused;
    EXPECT_FALSE(std::filesystem::exists(path("leak.pvs")));
  }
  EXPECT_EQ(run({"pvs", out("leak.map"), "--outside"}).code, done);
  // Where all stand in walls nothing is known.
  std::string shut = read_file(rooms);
  file("shut.map", shut.replace(shut.find(origin), origin.size(), "\"-8 64 50\""));
  const Outcome nothing = run({"cells", out("shut.map"), "--seal", "entities"});
  EXPECT_EQ(nothing.code, bad_input) << nothing;
  EXPECT_NE(nothing.err.find("nothing is known of leaks"), std::string::npos) << nothing;
}

TEST_F(Levels, of_no_face_that_is_kept_have_a_picture) {
  const std::string flat = file("flat.off", "OFF\n3 1 0\n0 0 0\n1 1 1\n2 2 2\n3 0 1 2\n");
  const Outcome drawn = run({"pvs", flat, "--show", "0", "--svg", out("flat.svg")});
  EXPECT_EQ(drawn.code, done) << drawn;
  EXPECT_NE(bytes_of("flat.svg").find("<svg"), std::string::npos);
}

TEST_F(Levels, from_standard_input_are_levels_all_the_same) {
  input_ = file("leak.map", without_brush(rooms, 1));
  EXPECT_EQ(run({"cells", "-", "--seal", "entities"}).code, disagreement);
  const Outcome refused = run({"pvs", "-"});
  EXPECT_EQ(refused.code, bad_input) << refused;
  EXPECT_NE(refused.err.find("there is a way out from info_player_start"), std::string::npos) << refused;
  EXPECT_EQ(run({"pvs", "-", "--outside"}).code, done);
  input_ = rooms;
  EXPECT_EQ(run({"cells", "-", "--seal", "entities"}).code, done);
  EXPECT_EQ(run({"pvs", "-", "--leaves"}).code, usage);  // not a compiled one
}

TEST_F(Levels, a_table_that_is_there_is_shown_and_written_without_being_asked_again) {
  for (const char* shard : {"0/2", "1/2"})
    ASSERT_EQ(run({"pvs", rooms, "--grid", "3,2,1", "--cells-too", "--shard", shard, "--out",
                   out(std::string(1, shard[0]) + ".pvs")})
                  .code,
              done);
  ASSERT_EQ(run({"merge", out("0.pvs"), out("1.pvs"), "--out", out("all.pvs")}).code, done);
  const auto asked = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"pvs", rooms, "--grid", "3,2,1", "--json", "-"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  const std::vector<std::string> show{"--show", "64,64,24",      "--obj",      out("now.obj"),
                                      "--out",  out("now.JSON"), "--cells-too"};
  const Outcome now = asked(show);
  const Outcome saved = asked({"--table", out("all.pvs"), "--show", "64,64,24", "--obj", out("saved.obj"), "--out",
                               out("saved.json"), "--certificates", out("proofs")});
  ASSERT_EQ(now.code, done) << now;
  ASSERT_EQ(saved.code, done) << saved;
  for (const char* what : {"cells", "faces", "visible", "pairs_of_cells", "shown", "boxes"})
    EXPECT_EQ(saved.json()["result"][what], now.json()["result"][what]) << what;
  EXPECT_EQ(saved.json()["counters"]["searched"], 0);
  EXPECT_EQ(bytes_of("saved.obj"), bytes_of("now.obj"));
  EXPECT_EQ(bytes_of("saved.json"), bytes_of("now.JSON"));
  EXPECT_EQ(Json::parse(bytes_of("saved.json"))["boxes"], now.json()["result"]["boxes"]);
  EXPECT_EQ(run({"verify", rooms, out("proofs")}).code, done);
  // What is none of this scene, with these options, or not whole.
  const auto refused = [&](const std::string& table, const std::string& why) {
    const Outcome r = asked({"--table", table});
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_NE(r.err.find(why), std::string::npos) << r;
  };
  refused(out("0.pvs"), "is a part of a table");
  ASSERT_EQ(run({"pvs", rooms, "--out", out("other.pvs")}).code, done);
  refused(out("other.pvs"), "is a table of");
  EXPECT_EQ(asked({"--table", out("all.pvs"), "--resume", "--out", out("x.pvs")}).code, usage);
  for (const char* cell : {"31,32", "-1", "x", ""})
    EXPECT_EQ(asked({"--table", out("all.pvs"), "--show", cell}).code, usage);
  // Of a part nobody would see in text that it is one.
  for (const char* file : {"part.json", "part.csv", "part.CSV"})
    EXPECT_EQ(run({"pvs", rooms, "--shard", "0/2", "--out", out(file)}).code, usage) << file;
}

TEST_F(Levels, parts_of_other_programs_are_not_put_together) {
  for (const char* shard : {"0/2", "1/2"})
    ASSERT_EQ(run({"pvs", rooms, "--shard", shard, "--out", out(std::string(1, shard[0]) + ".pvs")}).code, done);
  std::string old = bytes_of("0.pvs");  // as the first version wrote it: without a sum
  const std::size_t version = old.find("sightline 0.");
  ASSERT_NE(version, std::string::npos);
  old.replace(old.find("pvs 3"), 5, "pvs 1");
  old[version + 10] = '9';
  file("0.pvs", old.substr(0, old.size() - 8));
  const Outcome r = run({"merge", out("0.pvs"), out("1.pvs"), "--out", out("all.pvs")});
  EXPECT_EQ(r.code, bad_input) << r;
  EXPECT_FALSE(std::filesystem::exists(path("all.pvs")));
}

TEST_F(Levels, entities_are_sealed_where_they_do_not_stand_in_something_solid) {
  const auto with_entities = [&](const std::string& more) {
    std::ifstream in(rooms, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    std::ofstream(out("entities.map"), std::ios::binary)
        << text << "{\n\"classname\" \"light\"\n\"origin\" \"64 64 24\"\n}\n"
        << "{\n\"classname\" \"light\"\n\"origin\" \"-8 0 0\"\n}\n"
        << more;
    return run({"cells", out("entities.map"), "--seal", "entities", "--json", "-"});
  };
  const Outcome closed = with_entities("");
  ASSERT_EQ(closed.code, done) << closed;
  EXPECT_EQ(closed.json()["result"]["sealed"], 2);  // the scene has one, too
  EXPECT_EQ(closed.json()["result"]["in_solid"], 1);
  const Outcome leak = with_entities("{\n\"origin\" \"-20 0.5 0\"\n}\n");
  ASSERT_EQ(leak.code, disagreement) << leak;
  EXPECT_EQ(leak.json()["result"]["leaks"][0]["from"], Json::parse(R"(["-20", "1/2", "0"])")) << leak;
  const Outcome broken = with_entities("{\n\"origin\" \"1 2\"\n}\n");
  EXPECT_EQ(broken.code, bad_input) << broken;
  EXPECT_NE(broken.err.find("three decimals"), std::string::npos) << broken;
  EXPECT_EQ(run({"cells", (corpus / "general" / "two_rooms.off").string(), "--seal", "entities"}).code, usage);
}

TEST_F(Levels, a_table_is_the_same_however_it_was_divided) {
  ASSERT_EQ(run({"pvs", rooms, "--out", out("whole.pvs"), "--threads", "1"}).code, done);
  ASSERT_EQ(run({"pvs", rooms, "--out", out("threads.pvs"), "--threads", "3"}).code, done);
  EXPECT_EQ(bytes_of("threads.pvs"), bytes_of("whole.pvs"));
  for (const char* shard : {"0", "1", "2"})
    ASSERT_EQ(
        run({"pvs", rooms, "--shard", std::string(shard) + "/3", "--resume", "--out", out(std::string("part") + shard)})
            .code,
        done);
  const Outcome merged = run({"merge", out("part2"), out("part0"), out("part1"), "--out", out("merged.pvs")});
  EXPECT_EQ(merged.code, done) << merged;
  EXPECT_EQ(bytes_of("merged.pvs"), bytes_of("whole.pvs"));
  const Outcome gap = run({"merge", out("part2"), out("part0"), "--out", out("gap.pvs")});
  EXPECT_EQ(gap.code, bad_input) << gap;
  EXPECT_NE(gap.err.find("run again --shard 1/3"), std::string::npos) << gap;
  EXPECT_FALSE(std::filesystem::exists(path("gap.pvs")));
  EXPECT_EQ(run({"merge", rooms, "--out", out("gap.pvs")}).code, bad_input);
}

TEST_F(Levels, a_table_with_cells_is_symmetric_and_the_same_however_it_was_divided) {
  const std::vector<std::string> pvs{"pvs", rooms, "--cells-too", "--out"};
  const auto made = [&](const std::string& file, std::vector<std::string> more) {
    std::vector<std::string> arguments = pvs;
    arguments.push_back(out(file));
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(arguments).code, done);
    return bytes_of(file);
  };
  const std::string whole = made("whole.pvs", {"--threads", "1"});
  EXPECT_EQ(made("threads.pvs", {"--threads", "3"}), whole);
  EXPECT_EQ(made("resumed.pvs", {"--resume"}), whole);
  for (const char* shard : {"0", "1", "2"}) made(std::string("part") + shard, {"--shard", std::string(shard) + "/3"});
  ASSERT_EQ(run({"merge", out("part2"), out("part0"), out("part1"), "--out", out("merged.pvs")}).code, done);
  EXPECT_EQ(bytes_of("merged.pvs"), whole);
  ASSERT_EQ(run({"pvs", rooms, "--shard", "1/3", "--out", out("faces")}).code, done);
  const Outcome other = run({"merge", out("part2"), out("part0"), out("faces"), "--out", out("other.pvs")});
  EXPECT_EQ(other.code, bad_input) << other;
  EXPECT_NE(other.err.find("another question"), std::string::npos) << other;

  made("t.json", {});
  const Json table = Json::parse(bytes_of("t.json"));
  std::map<int, std::set<int>> seen;
  std::string csv = "cell,kind,number,state\n";
  for (const Json& cell : table["cells"]) {
    seen[cell["cell"]] = cell["cells"].get<std::set<int>>();
    for (const Json& face : cell["visible"]) csv += cell["cell"].dump() + ",face," + face.dump() + ",visible\n";
    for (const Json& cell_seen : cell["cells"]) csv += cell["cell"].dump() + ",cell," + cell_seen.dump() + ",visible\n";
  }
  std::size_t sum = 0;
  for (const auto& [cell, others] : seen)
    for (const int other_cell : others) {
      ++sum;
      EXPECT_NE(other_cell, cell);
      EXPECT_TRUE(seen[other_cell].contains(cell));
    }
  EXPECT_EQ(made("t.csv", {}), csv);
  const std::string cell = table["cells"][0]["cell"].dump();
  const Outcome shown = run({"pvs", rooms, "--cells-too", "--show", cell, "--json", "-"});
  ASSERT_EQ(shown.code, done) << shown;
  EXPECT_EQ(shown.json()["result"]["shown"][0]["cells"], table["cells"][0]["cells"]);
  EXPECT_EQ(shown.json()["result"]["pairs_of_cells"]["visible"], sum / 2);
}

TEST_F(Levels, what_was_done_before_an_end_is_not_done_again) {
  ASSERT_EQ(run({"pvs", rooms, "--out", out("whole.pvs")}).code, done);
  // Blocks of another run, one of another question, one broken, one with a bit flipped in its last row.
  std::filesystem::create_directories(path("again.pvs.parts"));
  for (const int block : {3, 5, 9, 11})
    ASSERT_EQ(run({"pvs", rooms, "--shard", std::to_string(block) + "/64", "--out",
                   out("again.pvs.parts/" + std::to_string(block) + "-of-64.pvs"), "--seed", block == 5 ? "2" : "1"})
                  .code,
              done);
  std::ofstream(path("again.pvs.parts/9-of-64.pvs"), std::ios::app) << "more";
  std::string flipped = bytes_of("again.pvs.parts/11-of-64.pvs");
  flipped[flipped.size() - 9] = static_cast<char>(flipped[flipped.size() - 9] ^ 1);
  file("again.pvs.parts/11-of-64.pvs", flipped);
  const Outcome again = run({"pvs", rooms, "--resume", "--out", out("again.pvs"), "--json", "-"});
  ASSERT_EQ(again.code, done) << again;
  EXPECT_EQ(again.json()["result"]["blocks_kept"], 1);
  EXPECT_EQ(bytes_of("again.pvs"), bytes_of("whole.pvs"));
  EXPECT_FALSE(std::filesystem::exists(path("again.pvs.parts")));

  // What is whole is taken as it is.
  const Outcome whole = run({"pvs", rooms, "--resume", "--out", out("again.pvs"), "--json", "-"});
  ASSERT_EQ(whole.code, done) << whole;
  EXPECT_EQ(whole.json()["result"]["blocks_kept"], 64);
  EXPECT_EQ(whole.json()["counters"]["searched"], 0);
  EXPECT_EQ(bytes_of("again.pvs"), bytes_of("whole.pvs"));

  // One that is of other faces than its name says is asked again; what somebody else put there stays.
  std::filesystem::remove(path("again.pvs"));
  std::filesystem::create_directories(path("again.pvs.parts"));
  ASSERT_EQ(run({"pvs", rooms, "--shard", "3/64", "--out", out("again.pvs.parts/5-of-64.pvs"), "--seed", "1"}).code,
            done);
  std::ofstream(path("again.pvs.parts/mine.txt")) << "mine";
  const Outcome other = run({"pvs", rooms, "--resume", "--out", out("again.pvs"), "--json", "-"});
  ASSERT_EQ(other.code, done) << other;
  EXPECT_EQ(other.json()["result"]["blocks_kept"], 0);
  EXPECT_EQ(bytes_of("again.pvs"), bytes_of("whole.pvs"));
  EXPECT_EQ(bytes_of("again.pvs.parts/mine.txt"), "mine");
  EXPECT_FALSE(std::filesystem::exists(path("again.pvs.parts/5-of-64.pvs")));
}

TEST_F(Levels, what_a_budget_left_open_is_asked_again_and_nothing_else) {
  const std::string house = path("house.off").string();
  ASSERT_EQ(run({"generate", "rooms", "--size", "1", "--seed", "3", "--out", house}).code, done);
  ASSERT_EQ(run({"pvs", house, "--out", out("whole.pvs")}).code, done);
  // Some of the blocks are there, the others have no time.
  const int step = sanitized ? 32 : 2, made = 64 / step;
  std::filesystem::create_directories(path("again.pvs.parts"));
  for (int block = 0; block < 64; block += step)
    ASSERT_EQ(run({"pvs", house, "--shard", std::to_string(block) + "/64", "--out",
                   out("again.pvs.parts/" + std::to_string(block) + "-of-64.pvs")})
                  .code,
              done);
  const auto again = [&](const std::string& seconds) {
    return run({"pvs", house, "--resume", "--out", out("again.pvs"), "--budget", seconds, "--json", "-"});
  };
  Outcome open;
  for (double seconds = sanitized ? 0.1 : 0.01; !std::filesystem::exists(path("again.pvs")); seconds *= 1.3) {
    open = again(std::to_string(seconds));
    ASSERT_EQ(open.code, undecided) << open;  // at first there is no time for the cells
  }
  EXPECT_EQ(open.json()["result"]["blocks_kept"], made);
  const auto kept = [&] {
    const std::filesystem::directory_iterator files(path("again.pvs.parts"));
    return std::distance(begin(files), end(files));
  };
  ASSERT_TRUE(std::filesystem::exists(path("again.pvs.parts")));
  const auto count = kept();
  EXPECT_GE(count, made);
  EXPECT_LT(count, 64);
  const Outcome last = again("0");
  ASSERT_EQ(last.code, done) << last;
  EXPECT_EQ(last.json()["result"]["blocks_kept"], count);
  EXPECT_EQ(bytes_of("again.pvs"), bytes_of("whole.pvs"));
  EXPECT_FALSE(std::filesystem::exists(path("again.pvs.parts")));
}

TEST_F(Levels, certificates_that_there_is_no_time_for_leave_all_faces_undecided) {
  const std::string house = path("house.off").string();
  ASSERT_EQ(run({"generate", "rooms", "--size", "1", "--seed", "3", "--out", house}).code, done);
  ASSERT_EQ(run({"pvs", house, "--out", out("whole.pvs")}).code, done);
  std::size_t faces = 0;
  for (double seconds = sanitized ? 0.1 : 0.01; !std::filesystem::exists(path("proofs/index.json")); seconds *= 1.3) {
    const Outcome r = run({"pvs", house, "--table", out("whole.pvs"), "--certificates", out("proofs"), "--budget",
                           std::to_string(seconds), "--json", "-"});
    ASSERT_EQ(r.code, undecided) << r;  // at first there is no time for the cells
    if (!r.out.empty()) faces = r.json()["result"]["faces"];
  }
  std::vector<std::uint32_t> all(faces);
  std::iota(all.begin(), all.end(), 0u);
  const Json last = Json::parse(bytes_of("proofs/index.json"))["cells"].back();
  EXPECT_EQ(Json::parse(bytes_of("proofs/" + last["certificate"].get<std::string>()))["undecided"], Json(all));
  EXPECT_FALSE(last.contains("sum"));
  EXPECT_EQ(run({"verify", house, out("proofs")}).code, done);
}

TEST_F(Levels, a_cell_that_is_not_asked_about_is_refused_before_the_work) {
  for (const char* cell : {"1000000", "4000000000"})
    EXPECT_EQ(run({"pvs", rooms, "--show", cell, "--resume", "--out", out("shown.pvs")}).code, usage);
  EXPECT_FALSE(std::filesystem::exists(path("shown.pvs.parts")));
}

/// SIGHTLINE_LONG: so many times as often.
TEST_F(Levels, a_worker_that_is_killed_at_any_moment_goes_on_to_the_same_table) {
  const char* const more = std::getenv("SIGHTLINE_LONG");
  const int kills = (sanitized ? 2 : 6) * std::max(1, more == nullptr ? 1 : std::atoi(more));
  const std::string house = path("house.off").string();
  ASSERT_EQ(run({"generate", "rooms", "--size", "1", "--seed", "3", "--out", house}).code, done);
  ASSERT_EQ(run({"pvs", house, "--out", out("whole.pvs")}).code, done);
  std::mt19937 random(5);
  int killed = 0, ended = 0;
  while (killed < kills) {
    const double seconds = 0.02 + static_cast<double>(random() % 1000) / 10000;
    const Outcome r = run({"pvs", house, "--resume", "--out", out("again.pvs")}, {.seconds = seconds});
    if (r.code == done) {  // and begins anew
      ++ended;
      ASSERT_EQ(bytes_of("again.pvs"), bytes_of("whole.pvs"));
      ASSERT_FALSE(std::filesystem::exists(path("again.pvs.parts")));
      std::filesystem::remove(path("again.pvs"));
      continue;
    }
    ASSERT_EQ(r.code, -1) << r;
    ++killed;
  }
  const Outcome last = run({"pvs", house, "--resume", "--out", out("again.pvs"), "--json", "-"});
  ASSERT_EQ(last.code, done) << last;
  EXPECT_EQ(bytes_of("again.pvs"), bytes_of("whole.pvs"));
  EXPECT_FALSE(std::filesystem::exists(path("again.pvs.parts")));
  RecordProperty("killed", killed);
  RecordProperty("ended", ended);
}

TEST_F(Levels, certificates_that_are_there_are_not_made_again) {
  const std::string house = path("house.off").string();
  ASSERT_EQ(run({"generate", "rooms", "--size", "1", "--seed", "3", "--out", house}).code, done);
  const auto asked = [&](std::vector<std::string> more, Limits limits = {}) {  // what takes a second or two
    std::vector<std::string> words =
        sanitized ? std::vector<std::string>{"pvs", rooms, "--grid", "6,4,2"} : std::vector<std::string>{"pvs", house};
    words.insert(words.end(), more.begin(), more.end());
    return run(words, limits).code;
  };
  ASSERT_EQ(asked({"--out", out("whole.pvs"), "--certificates", out("proofs")}), done);
  const auto kept = [&] {
    std::vector<std::string> cells;
    if (std::filesystem::exists(path("again")))
      for (const auto& entry : std::filesystem::directory_iterator(path("again")))
        if (entry.path().extension() == ".kept") cells.push_back(entry.path().stem().string());
    return cells;
  };
  const auto again = [&](std::size_t cells) {  // until so many are kept
    return asked({"--resume", "--out", out("again.pvs"), "--certificates", out("again")},
                 {.is_enough = [&kept, cells] { return kept().size() >= cells; }});
  };
  const std::size_t all = 100000;
  ASSERT_EQ(again(1), -1) << "it was done before one certificate was kept";
  const std::string first = kept()[0], name = "again/" + first + ".json";
  const auto written = std::filesystem::last_write_time(path(name));
  const std::string mark = bytes_of("again/" + first + ".kept");
  EXPECT_EQ(again(kept().size() + 3), -1);
  ASSERT_EQ(again(all), done);
  EXPECT_EQ(std::filesystem::last_write_time(path(name)), written);
  EXPECT_TRUE(kept().empty());
  ASSERT_EQ(again(all), done);  // as the index says what was there
  EXPECT_EQ(std::filesystem::last_write_time(path(name)), written);
  for (const auto& entry : std::filesystem::directory_iterator(path("proofs"))) {
    const std::string file = entry.path().filename().string();
    EXPECT_EQ(bytes_of("again/" + file), bytes_of("proofs/" + file)) << file;
  }
  // What is damaged is made again.
  for (const bool is_damaged : {false, true}) {
    std::ofstream(path("again/" + first + ".kept")) << (is_damaged ? mark : std::string("{}"));
    if (is_damaged) std::ofstream(path(name), std::ios::app) << ' ';
    ASSERT_EQ(again(all), done);
    EXPECT_NE(std::filesystem::last_write_time(path(name)), written);
    EXPECT_EQ(bytes_of(name), bytes_of("proofs/" + first + ".json"));
  }
}

TEST_F(Levels, tables_are_text_too_and_show_cells) {
  ASSERT_EQ(run({"pvs", rooms, "--out", out("t.json")}).code, done);
  ASSERT_EQ(run({"pvs", rooms, "--out", out("t.csv")}).code, done);
  const Json table = Json::parse(bytes_of("t.json"));
  std::string csv = "cell,face,state\n";
  for (const Json& cell : table["cells"])
    for (const Json& face : cell["visible"]) csv += cell["cell"].dump() + "," + face.dump() + ",visible\n";
  EXPECT_EQ(bytes_of("t.csv"), csv);
  const std::string cell = table["cells"][0]["cell"].dump();
  const Outcome shown = run({"pvs", rooms, "--show", cell, "--obj", out("t.obj"), "--json", "-"});
  ASSERT_EQ(shown.code, done) << shown;
  EXPECT_EQ(shown.json()["result"]["shown"][0]["visible"], table["cells"][0]["visible"]);
  EXPECT_NE(bytes_of("t.obj").find("g cell-" + cell), std::string::npos);
  EXPECT_EQ(run({"pvs", rooms, "--show", "100000"}).code, usage);
}

TEST_F(Levels, boxes_of_a_grid_see_what_their_cells_see) {
  ASSERT_EQ(run({"cells", rooms, "--grid", "3,2,1", "--out", out("cells.json")}).code, done);
  const Outcome r = run({"pvs", rooms, "--grid", "3,2,1", "--out", out("t.json"), "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json cells = Json::parse(bytes_of("cells.json"))["cells"], table = Json::parse(bytes_of("t.json"));
  std::map<std::uint32_t, std::set<std::uint32_t>> seen, asked;
  for (const Json& cell : table["cells"]) {
    const std::uint32_t number = cell["cell"], box = cells[number]["leaf"];
    asked[box].insert(number);
    for (const std::uint32_t face : cell["visible"]) seen[box].insert(face);
  }
  EXPECT_EQ(seen.size(), 6u);
  std::map<std::uint32_t, std::set<std::uint32_t>> said, said_cells;
  const Json boxes = r.json()["result"]["boxes"];
  for (const Json& box : boxes) {
    const std::uint32_t x = box["box"][0], y = box["box"][1], z = box["box"][2], number = x + 3 * (y + 2 * z);
    said[number] = box["visible"].get<std::set<std::uint32_t>>();
    said_cells[number] = box["cells"].get<std::set<std::uint32_t>>();
    EXPECT_EQ(box["undecided"].size(), 0u);
  }
  EXPECT_EQ(said, seen);
  EXPECT_EQ(said_cells, asked);

  // A table of other boxes is another table.
  ASSERT_EQ(run({"pvs", rooms, "--grid", "3,2,1", "--shard", "0/2", "--out", out("0.pvs")}).code, done);
  ASSERT_EQ(run({"pvs", rooms, "--grid", "3,1,2", "--shard", "1/2", "--out", out("1.pvs")}).code, done);
  EXPECT_NE(run({"merge", out("0.pvs"), out("1.pvs"), "--out", out("all.pvs")}).code, done);
}

TEST_F(Levels, grids_that_are_none_are_refused) {
  for (const char* grid : {"0,1,1", "1,1", "1,1,1,1", "x", "2,2,2 ", "-1,1,1", "1000000,2,1", "1,1,99999999999"})
    EXPECT_EQ(run({"cells", rooms, "--grid", grid}).code, usage) << grid;
  std::ofstream(path("flat.off")) << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(run({"cells", out("flat.off"), "--grid", "2,2,1"}).code, done);
  const Outcome flat = run({"cells", out("flat.off"), "--grid", "1,1,2"});
  EXPECT_EQ(flat.code, usage) << flat;
  EXPECT_EQ(run({"cells", rooms, "--grid", "2,2,2", "--leaves"}).code, usage);
}

TEST_F(Levels, certificates_of_all_cells_are_accepted_and_agree_with_the_table) {
  ASSERT_EQ(run({"pvs", rooms, "--certificates", out("proofs"), "--out", out("t.json")}).code, done);
  const Outcome all = run({"verify", rooms, out("proofs"), "--json", "-"});
  EXPECT_EQ(all.code, done) << all;
  EXPECT_EQ(all.json()["result"]["accepted"], true);
  const Json index = Json::parse(bytes_of("proofs/index.json")), table = Json::parse(bytes_of("t.json"));
  ASSERT_EQ(index["cells"].size(), table["cells"].size());
  EXPECT_EQ(run({"verify", rooms, out("proofs"), "--sample", "2"}).code, done);
  EXPECT_EQ(run({"verify", rooms, out("proofs"), "--sample", "0"}).code, usage);
  // One alone is that of its cell, not only right.
  const std::string cell = index["cells"][0]["cell"].dump(), other = index["cells"][1]["certificate"];
  EXPECT_EQ(run({"verify", rooms, out("proofs"), "--cell", cell}).code, done);
  EXPECT_EQ(run({"verify", rooms, out("proofs"), "--cell", "100000"}).code, usage);
  const std::string own = "proofs/" + index["cells"][0]["certificate"].get<std::string>(), right = bytes_of(own);
  file(own, bytes_of("proofs/" + other));
  EXPECT_EQ(run({"verify", rooms, out("proofs/" + other)}).code, done);
  EXPECT_EQ(run({"verify", rooms, out("proofs"), "--cell", cell}).code, disagreement);
  file(own, right);
  // Of another scene none is.
  EXPECT_EQ(run({"verify", (corpus / "general" / "cube.off").string(), out("proofs")}).code, disagreement);
  EXPECT_EQ(run({"verify", rooms, rooms, "--sample", "2"}).code, usage);
}

TEST_F(Levels, certificates_of_shards_are_those_of_one_run) {
  ASSERT_EQ(run({"pvs", rooms, "--certificates", out("proofs"), "--out", out("whole.pvs")}).code, done);
  const auto shard = [&](const std::string& i, const std::vector<std::string>& more) {
    std::vector<std::string> words{"pvs", rooms, "--shard", i + "/3", "--out", out("part" + i)};
    words.insert(words.end(), more.begin(), more.end());
    return run(words).code;
  };
  const auto merge = [&] {
    return run({"merge", out("part0"), out("part1"), out("part2"), "--out", out("merged.pvs"), "--certificates",
                out("shared")});
  };
  for (const char* i : {"0", "1"}) ASSERT_EQ(shard(i, {"--certificates", out("shared")}), done);
  ASSERT_EQ(shard("2", {}), done);
  // What is not there yet.
  const Outcome in_parts = run({"verify", rooms, out("shared")});
  EXPECT_EQ(in_parts.code, bad_input) << in_parts;
  EXPECT_NE(in_parts.err.find("merge"), std::string::npos) << in_parts;
  const Outcome gap = merge();
  EXPECT_EQ(gap.code, bad_input) << gap;
  EXPECT_NE(gap.err.find("index-2-of-3.json: is missing; run again --shard 2/3"), std::string::npos) << gap;
  EXPECT_FALSE(std::filesystem::exists(path("merged.pvs")));
  // What is of other cells, or of another division.
  ASSERT_EQ(shard("2", {"--certificates", out("shared"), "--candidates", "1"}), done);
  ASSERT_EQ(shard("2", {}), done);
  const Outcome other = merge();
  EXPECT_EQ(other.code, bad_input) << other;
  EXPECT_NE(other.err.find("another question"), std::string::npos) << other;
  std::ofstream(path("shared/index-0-of-2.json")) << "{}";
  EXPECT_EQ(merge().code, bad_input);
  std::filesystem::remove(path("shared/index-0-of-2.json"));
  std::ofstream(path("shared/index-2-of-3.json")) << "{}";
  EXPECT_EQ(merge().code, bad_input);
  // All of it, byte by byte.
  std::filesystem::remove_all(path("shared"));
  for (const char* i : {"0", "1", "2"}) ASSERT_EQ(shard(i, {"--certificates", out("shared")}), done);
  ASSERT_EQ(merge().code, done);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(path("proofs"))) {
    ++files;
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(bytes_of("shared/" + name), bytes_of("proofs/" + name)) << name;
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("shared")), {}), static_cast<std::ptrdiff_t>(files));
  EXPECT_EQ(bytes_of("merged.pvs"), bytes_of("whole.pvs"));
  EXPECT_EQ(run({"verify", rooms, out("shared")}).code, done);
  // A shard that is run again makes no certificate again, neither by its part of the index nor by all of it.
  const auto written = [&] {
    std::map<std::string, std::filesystem::file_time_type> times;
    for (const auto& entry : std::filesystem::directory_iterator(path("shared")))
      if (entry.path().filename().string().starts_with("cell-")) times[entry.path().string()] = entry.last_write_time();
    return times;
  };
  const auto before = written();
  for (int times = 0; times < 2; ++times) ASSERT_EQ(shard("1", {"--certificates", out("shared"), "--resume"}), done);
  EXPECT_EQ(written(), before);
}

/// A folder in which the index or the certificate says something else of one cell than `pvs` did; what `verify` says.
/// Nothing is claimed of what the cell sees, so that what is wrong is what is said of the cell.
TEST_F(Levels, cells_that_are_not_what_is_said_of_them_are_refused) {
  ASSERT_EQ(run({"pvs", rooms, "--certificates", out("proofs")}).code, done);
  const Json index = Json::parse(bytes_of("proofs/index.json"));
  const auto certificate_of = [&](const Json& cell) {
    Json certificate = Json::parse(bytes_of("proofs/" + cell["certificate"].get<std::string>()));
    std::set<std::uint32_t> faces;
    for (const Json& fragment : certificate["fragments"]) faces.insert(fragment["face"].get<std::uint32_t>());
    for (const char* list : {"visible", "lines", "hidden"}) certificate[list] = Json::array();
    certificate["undecided"] = faces;
    return certificate;
  };
  const auto verified = [&](const Json& cell, const Json& certificate) {
    if (!std::filesystem::exists(path("forged"))) {  // where nothing is claimed of what the other cells see, either
      std::filesystem::copy(path("proofs"), path("forged"), std::filesystem::copy_options::recursive);
      for (const Json& other : index["cells"])
        std::ofstream(path("forged/" + other["certificate"].get<std::string>())) << certificate_of(other);
    }
    Json one = index;
    for (Json& entry : one["cells"])
      if (entry["cell"] == cell["cell"]) entry = cell;
    std::ofstream(path("forged/index.json")) << one;
    std::ofstream(path("forged/" + cell["certificate"].get<std::string>())) << certificate;
    return run({"verify", rooms, out("forged"), "--cell", cell["cell"].dump()});
  };
  // The cell with the most portals, and a portal of another one that is not between the two.
  const Json* most = nullptr;
  std::size_t portals = 0;
  for (const Json& cell : index["cells"])
    if (const std::size_t count = certificate_of(cell)["sources"].size(); count > portals) {
      most = &cell;
      portals = count;
    }
  ASSERT_GE(portals, 2u);
  const Json cell = *most, certificate = certificate_of(cell);
  const auto corners_of = [](const Json& source) { return std::set<Json>(source.begin(), source.end()); };
  Json elsewhere;
  for (const Json& other : index["cells"]) {
    const Json sources = certificate_of(other)["sources"];
    for (const Json& source : sources)
      if (std::none_of(certificate["sources"].begin(), certificate["sources"].end(),
                       [&](const Json& own) { return corners_of(own) == corners_of(source); }))
        elsewhere = source;
  }
  ASSERT_FALSE(elsewhere.is_null());
  const Outcome as_it_is = verified(cell, certificate);
  ASSERT_EQ(as_it_is.code, done) << as_it_is;

  const std::string number = "cell " + cell["cell"].dump() + " ";
  const auto expect_refused = [&](const std::string& why, auto change) {
    Json said = cell, claim = certificate;
    change(said, claim);
    const Outcome r = verified(said, claim);
    EXPECT_EQ(r.code, disagreement) << why << r;
    EXPECT_NE(r.out.find(number), std::string::npos) << why << r;
    EXPECT_NE(r.out.find(why), std::string::npos) << why << r;
  };
  const auto turn = [](Json& polygon) { std::reverse(polygon.begin(), polygon.end()); };
  // Walls.
  expect_refused("do not close up", [&](Json& said, Json&) { said["walls"].erase(0); });
  expect_refused("do not close up", [&](Json& said, Json&) {
    for (Json& place : said["walls"][0]) {  // moved along all axes
      Json corner = said["corners"][place.get<std::size_t>()];
      for (Json& x : corner) x = "1" + x.get<std::string>().substr(x.get<std::string>()[0] == '-' ? 1 : 0);
      place = said["corners"].size();
      said["corners"].push_back(corner);
    }
  });
  expect_refused("it is not convex", [&](Json& said, Json&) {
    for (Json& wall : said["walls"]) turn(wall);
  });
  expect_refused("it has no inside", [&](Json& said, Json&) {
    said["walls"] = Json::array({said["walls"][0], said["walls"][0]});
    turn(said["walls"][1]);
  });
  expect_refused("has zero area", [&](Json& said, Json&) { said["walls"].push_back({0, 1}); });
  expect_refused("passes through its inside", [&](Json& said, Json& claim) {  // all of the level and more
    said["corners"] = Json::array();
    for (const char* x : {"-1000", "1000"})
      for (const char* y : {"-1000", "1000"})
        for (const char* z : {"-1000", "1000"}) said["corners"].push_back({x, y, z});
    said["walls"] = Json::parse("[[0,1,3,2],[4,6,7,5],[0,4,5,1],[2,3,7,6],[0,2,6,4],[1,5,7,3]]");
    said["within"] = Json::array();
    claim["sources"] = Json::array();
    for (const Json& wall : said["walls"]) {
      Json& source = claim["sources"].emplace_back(Json::array());
      for (const Json& place : wall) source.push_back(said["corners"][place.get<std::size_t>()]);
    }
  });
  // Portals.
  for (std::size_t k = 0; k < (sanitized ? 1 : portals); ++k) {
    expect_refused("is covered by no source and no face", [&](Json&, Json& claim) { claim["sources"].erase(k); });
    expect_refused("looks into the cell", [&](Json&, Json& claim) { turn(claim["sources"][k]); });
  }
  expect_refused("is in none of its walls", [&](Json&, Json& claim) { claim["sources"].push_back(elsewhere); });
  std::size_t covered = 0;
  for (const Json& wall : cell["walls"]) {  // all of a wall, be it a face
    Json source = Json::array();
    for (const Json& place : wall) source.push_back(cell["corners"][place.get<std::size_t>()]);
    Json claim = certificate;
    claim["sources"].push_back(source);
    const Outcome r = verified(cell, claim);
    covered += r.code == disagreement && r.out.find("covers some of source") != std::string::npos;
  }
  EXPECT_GE(covered, 1u);
  // Faces that look into it.
  ASSERT_FALSE(cell["within"].empty());
  expect_refused("looks into it, and is not said to", [&](Json& said, Json&) { said["within"].erase(0); });
  expect_refused("does not look into it, but is said to", [&](Json& said, Json&) { said["within"].push_back(100000); });
  // No folder of this kind.
  for (const char* key : {"walls", "corners", "within"}) {
    Json said = cell;
    said[key] = "x";
    const Outcome r = verified(said, certificate);
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_NE(r.err.find("sightline pvs --certificates"), std::string::npos) << r;
  }
}

TEST_F(Levels, an_index_says_what_it_says_once_and_in_numbers_that_fit) {
  ASSERT_EQ(run({"pvs", rooms, "--certificates", out("proofs")}).code, done);
  const std::string truth = bytes_of("proofs/index.json");
  const Json index = Json::parse(truth);
  const auto refused = [&](const std::string& text, const std::string& what) {
    std::ofstream(path("proofs/index.json")) << text;
    const Outcome r = run({"verify", rooms, out("proofs")});
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_NE(r.err.find(what), std::string::npos) << r;
  };
  const auto with = [&](auto change) {
    Json said = index;
    change(said["cells"]);
    return said.dump();
  };
  refused(with([](Json& cells) { cells[0]["within"] = {4294967296u + 0}; }), "no whole number up to 4294967295");
  refused(with([](Json& cells) { cells[0]["within"] = {1.5}; }), "no whole number");
  refused(with([](Json& cells) { cells[0]["cell"] = -1; }), "\"cell\" is no whole number");
  refused(with([](Json& cells) { cells[1]["cell"] = cells[0]["cell"]; }), "twice");
  refused(with([](Json& cells) { cells[1]["certificate"] = cells[0]["certificate"]; }), "twice");
  refused(with([](Json& cells) { cells[0]["certificate"] = "../x.json"; }), "no file of this folder");
  refused(truth.substr(0, truth.rfind('}')) + ", \"rest\": []}", "the key \"rest\" is there twice");
  // Certificates of both sides are those of another question.
  std::ofstream(path("proofs/index.json")) << truth;
  const std::string name = "proofs/" + index["cells"][0]["certificate"].get<std::string>();
  Json both = Json::parse(bytes_of(name));
  both["two_sided"] = true;
  std::ofstream(path(name)) << both;
  const Outcome sides = run({"verify", rooms, out("proofs")});
  EXPECT_EQ(sides.code, disagreement) << sides;
  EXPECT_NE(sides.out.find("backs count as visible"), std::string::npos) << sides;
}

TEST_F(Levels, cells_that_are_left_out_of_an_index_are_missed) {
  ASSERT_EQ(run({"pvs", rooms, "--certificates", out("proofs")}).code, done);
  const Json index = Json::parse(bytes_of("proofs/index.json"));
  const auto verified = [&](auto change) {
    Json said = index;
    change(said);
    std::ofstream(path("proofs/index.json")) << said;
    return run({"verify", rooms, out("proofs")});
  };
  const Outcome truth = verified([](Json&) {});
  EXPECT_EQ(truth.code, done) << truth;
  EXPECT_NE(truth.out.find("they fill a box about the scene, and no way leads to these"), std::string::npos) << truth;
  EXPECT_NE(truth.out.find(" faces seen in all, 0 undecided"), std::string::npos) << truth;
  const Outcome hole = verified([](Json& said) { said["rest"].erase(0); });
  EXPECT_EQ(hole.code, disagreement) << hole;
  EXPECT_NE(hole.out.find("with no cell beyond it"), std::string::npos) << hole;
  const Outcome room = verified([](Json& said) { said["cells"].erase(0); });
  EXPECT_EQ(room.code, disagreement) << room;
  const Outcome unasked = verified([](Json& said) {  // stated, but nothing is said of what it sees
    said["rest"].push_back(said["cells"][0]);
    said["cells"].erase(0);
  });
  EXPECT_EQ(unasked.code, disagreement) << unasked;
  EXPECT_NE(unasked.out.find("there is a way to cell " + index["cells"][0]["cell"].dump()), std::string::npos)
      << unasked;
  const Outcome none = verified([](Json& said) { said.erase("rest"); });
  EXPECT_EQ(none.code, bad_input) << none;
}

TEST_F(Levels, volumes_see_what_their_cells_see) {
  // The halves of two_rooms as the boxes of a grid have them, and as volumes.
  const Json by_grid = run({"pvs", rooms, "--grid", "2,1,1", "--json", "-"}).json()["result"]["boxes"];
  ASSERT_EQ(by_grid.size(), 2u);
  const Json box = Json::parse(run({"info", rooms, "--json", "-"}).out)["result"]["box"];
  const auto number = [&](std::size_t end, std::size_t k) { return std::stoi(box[end][k].get<std::string>()); };
  const int middle = (number(0, 0) + number(1, 0)) / 2;
  std::ofstream halves(path("halves.off"));
  halves << "OFF\n16 12 0\n";
  for (const auto& [low, high] : {std::pair(-1000, middle), {middle, 1000}})
    for (const int z : {-1000, 1000})
      halves << low << " -1000 " << z << "\n"
             << high << " -1000 " << z << "\n"
             << high << " 1000 " << z << "\n"
             << low << " 1000 " << z << "\n";
  for (const int v : {0, 8})
    for (const std::array<int, 4>& f : std::initializer_list<std::array<int, 4>>{
             {3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}})
      halves << 4 << ' ' << v + f[0] << ' ' << v + f[1] << ' ' << v + f[2] << ' ' << v + f[3] << '\n';
  halves.close();
  const Outcome r = run({"pvs", rooms, "--volumes", out("halves.off"), "--certificates", out("proofs"), "--out",
                         out("t.pvs"), "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json by_volume = r.json()["result"]["volumes"];
  ASSERT_EQ(by_volume.size(), 2u);
  for (std::size_t v : {0u, 1u}) {
    EXPECT_EQ(by_volume[v]["volume"], v);
    EXPECT_EQ(by_volume[v]["visible"], by_grid[v]["visible"]);
  }
  EXPECT_NE(by_volume[0]["visible"], by_volume[1]["visible"]);
  const Outcome proved = run({"verify", rooms, out("proofs")});
  EXPECT_EQ(proved.code, done) << proved;

  // A table of other volumes is another table; what are no volumes is told with faces.
  std::ofstream(path("one.off")) << "OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  ASSERT_EQ(run({"pvs", rooms, "--volumes", out("halves.off"), "--shard", "0/2", "--out", out("0.pvs")}).code, done);
  ASSERT_EQ(run({"pvs", rooms, "--volumes", out("one.off"), "--shard", "1/2", "--out", out("1.pvs")}).code, done);
  EXPECT_NE(run({"merge", out("0.pvs"), out("1.pvs"), "--out", out("all.pvs")}).code, done);
  std::ofstream(path("open.off")) << "OFF\n4 3 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n";
  const Outcome open = run({"cells", rooms, "--volumes", out("open.off")});
  EXPECT_EQ(open.code, bad_input) << open;
  EXPECT_NE(open.err.find("open.off: face 0 "), std::string::npos) << open;
  EXPECT_EQ(run({"cells", rooms, "--volumes", out("one.off"), "--grid", "2,2,2"}).code, usage);
  EXPECT_EQ(run({"cells", rooms, "--volumes", out("none.off")}).code, bad_input);
}

TEST_F(Levels, convex_regions_see_what_their_cells_see) {
  const Outcome cells = run({"cells", rooms, "--coarse", "1", "--out", out("cells.json"), "--json", "-"});
  ASSERT_EQ(cells.code, done) << cells;
  ASSERT_EQ(run({"pvs", rooms, "--out", out("t.json")}).code, done);
  std::map<std::uint32_t, std::set<std::uint32_t>> seen, said;
  std::set<std::uint32_t> numbers;
  const Json list = Json::parse(bytes_of("cells.json"))["cells"], table = Json::parse(bytes_of("t.json"));
  for (const Json& cell : list) {
    EXPECT_EQ(cell["solid"].get<bool>(), cell["convex_region"].is_null());
    if (!cell["convex_region"].is_null()) numbers.insert(cell["convex_region"].get<std::uint32_t>());
  }
  EXPECT_EQ(cells.json()["result"]["convex_regions"], numbers.size());
  EXPECT_LT(numbers.size(), list.size() / 2);
  for (const Json& cell : table["cells"])
    for (const std::uint32_t face : cell["visible"])
      seen[list[cell["cell"].get<std::size_t>()]["convex_region"].get<std::uint32_t>()].insert(face);
  const Json regions = run({"pvs", rooms, "--coarse", "1", "--json", "-"}).json()["result"]["convex_regions"];
  for (const Json& region : regions)
    said[region["convex_region"].get<std::uint32_t>()] = region["visible"].get<std::set<std::uint32_t>>();
  EXPECT_EQ(said, seen);
  EXPECT_LT(said.size(), table["cells"].size());
  const Json most = run({"cells", rooms, "--coarse", "30", "--json", "-"}).json()["result"]["convex_regions"];
  EXPECT_EQ(most, 30);
  EXPECT_EQ(run({"cells", rooms, "--coarse", "0"}).code, usage);
}

TEST_F(Levels, rooms_of_the_corpus_have_cells_that_are_checked) {
  for (const char* scene : {"two_rooms.off", "cube.off", "cornell.obj", "l_room.off"}) {
    const std::string file = (corpus / "general" / scene).string();
    ASSERT_EQ(run({"pvs", file, "--outside", "--certificates", out(scene)}).code, done) << scene;
    const Outcome r = run({"verify", file, out(scene)});
    EXPECT_EQ(r.code, done) << scene << r;
  }
}

/// JSON with one value, however deep, in the place of which something else stands, or nothing; or text that is damaged.
static std::string damaged(const Json& right, std::mt19937_64& random) {
  if (random() % 4 == 0) {
    std::string text = right.dump();
    const std::size_t place = random() % text.size();
    if (random() % 2 == 0) text.resize(place);
    else text[place] = static_cast<char>(random() % 256);
    return text;
  }
  Json whole = right;
  Json *place = &whole, *above = nullptr;
  std::size_t child = 0;
  while (place->is_structured() && !place->empty() && (above == nullptr || random() % 4 != 0)) {
    above = place;
    child = random() % place->size();
    place = &*std::next(place->begin(), static_cast<std::ptrdiff_t>(child));
  }
  static const std::vector<Json> others{nullptr,
                                        true,
                                        -1,
                                        0,
                                        1,
                                        7,
                                        4294967295u,
                                        4294967296u,
                                        1e300,
                                        "x",
                                        "1/0",
                                        "-3/7",
                                        "1e999999",
                                        "",
                                        Json::array(),
                                        Json::object(),
                                        "..",
                                        0.5,
                                        "0",
                                        Json::array({0, 1, 2}),
                                        Json::array({Json::array()})};
  if (random() % 5 != 0) *place = others[random() % others.size()];
  else if (above->is_array()) above->erase(above->begin() + static_cast<std::ptrdiff_t>(child));
  else above->erase(std::next(above->begin(), static_cast<std::ptrdiff_t>(child)));
  return whole.dump();
}

TEST_F(Levels, files_of_cells_and_indexes_that_are_damaged_anyhow_end_in_one_line) {
  const std::string cells = out("cells.json"), proofs = out("proofs");
  const std::vector<std::vector<std::string>> divisions{{}, {"--grid", "2,2,1"}, {"--coarse", "3"}};
  std::mt19937_64 random(1);
  for (const std::vector<std::string>& division : divisions) {
    std::vector<std::string> words{"cells", rooms, "--out", cells};
    words.insert(words.end(), division.begin(), division.end());
    ASSERT_EQ(run(words).code, done);
    const Json right = Json::parse(bytes_of("cells.json"));
    for (int k = 0; k < (sanitized ? 6 : 40); ++k) {
      const std::string text = damaged(right, random);
      file("cells.json", text);
      const Outcome r = run({"pvs", rooms, "--cells", cells, "--shard", "0/1000"});
      EXPECT_TRUE(r.code == done || (r.code == bad_input && r.one_line_of_error())) << text.substr(0, 2000) << r;
    }
  }
  ASSERT_EQ(run({"pvs", rooms, "--certificates", proofs}).code, done);
  const Json right = Json::parse(bytes_of("proofs/index.json"));
  for (int k = 0; k < (sanitized ? 10 : 80); ++k) {
    const std::string text = damaged(right, random);
    file("proofs/index.json", text);
    const Outcome r = run({"verify", rooms, proofs, "--sample", "1"});
    EXPECT_TRUE(r.code == done || r.code == disagreement || (r.code == bad_input && r.one_line_of_error()))
        << text.substr(0, 2000) << r;
  }
}

TEST_F(Levels, methods_are_compared) {
  const Outcome r = run({"compare", rooms, "pvs", "--rays", "10,1000", "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json rows = r.json()["result"]["rows"];
  ASSERT_EQ(rows.size(), 5u);
  const auto errors = [&](std::size_t i, const char* kind) { return rows[i]["errors"][kind].get<std::size_t>(); };
  EXPECT_EQ(errors(0, "wrongly_hidden") + errors(0, "wrongly_visible"), 0u);
  EXPECT_GT(errors(1, "wrongly_hidden"), errors(2, "wrongly_hidden"));  // more rays find more
  EXPECT_EQ(errors(2, "wrongly_visible"), 0u);
  EXPECT_EQ(rows[3]["method"], "midpoints");
  EXPECT_GT(errors(3, "wrongly_hidden"), errors(2, "wrongly_hidden"));
  EXPECT_EQ(errors(3, "wrongly_visible"), 0u);
  EXPECT_EQ(errors(4, "wrongly_hidden"), 0u);
  EXPECT_GT(errors(4, "wrongly_visible"), 0u);
}

TEST_F(Levels, shards_come_from_an_array_of_jobs) {
  EXPECT_EQ(run({"pvs", rooms, "--shard", "3/3"}).code, usage);
  EXPECT_EQ(run({"pvs", rooms, "--shard", "-1/3"}).code, usage);
  EXPECT_EQ(run({"pvs", rooms, "--shard", "1"}).code, usage);
  EXPECT_EQ(run({"pvs", rooms, "--resume"}).code, usage);
  EXPECT_EQ(run({"pvs", rooms, "--shard", "0/2", "--show", "1"}).code, usage);
  const Json whole = run({"pvs", rooms, "--json", "-"}).json()["result"];
  setenv("SLURM_ARRAY_TASK_ID", "3", 1);
  setenv("SLURM_ARRAY_TASK_COUNT", "2", 1);
  setenv("SLURM_ARRAY_TASK_MIN", "2", 1);
  EXPECT_EQ(run({"pvs", rooms, "--json", "-"}).code, usage);  // a part of an array, of unknown size
  setenv("SLURM_ARRAY_TASK_ID", "1", 1);
  setenv("SLURM_ARRAY_TASK_MIN", "0", 1);
  const Json part = run({"pvs", rooms, "--json", "-"}).json()["result"];
  for (const char* id : {"abc", "1.9", "4294967297", ""}) {
    setenv("SLURM_ARRAY_TASK_ID", id, 1);
    EXPECT_EQ(run({"pvs", rooms, "--json", "-"}).code, usage) << id;
  }
  setenv("SLURM_ARRAY_TASK_ID", "3", 1);
  setenv("SLURM_ARRAY_TASK_COUNT", "67108864", 1);  // of which 64 blocks each would be 2^32
  const Outcome many = run({"pvs", rooms, "--resume", "--out", out("many.pvs")});
  EXPECT_EQ(many.code, usage);
  EXPECT_NE(many.err.find("SLURM_ARRAY_TASK_COUNT 67108864"), std::string::npos) << many;
  for (const char* name : {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN"}) unsetenv(name);
  EXPECT_EQ(whole["faces"], 71);
  EXPECT_EQ(part["faces"], 35);  // 1, 3, ... 69
}

}  // namespace program
