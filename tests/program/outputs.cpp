// What the program writes: never over what it reads, whole or not at all, and not without a word where it cannot.

#include "program.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <array>
#include <atomic>
#include <cstring>
#include <map>
#include <set>

namespace program {

class Outputs : public Program {
 protected:
  const std::string cube = read_file(corpus / "general" / "cube.off");
  /// Some 20 MB of JSON, and 5 where writing them takes longer.
  std::vector<std::string> much(const std::string& json) const {
    const std::string scene = path("many.off").string();
    const bool made =
        fs::exists(scene) || run({"generate", "rooms", "--size", sanitized ? "6" : "12", "--out", scene}).code == done;
    EXPECT_TRUE(made) << scene;
    return {"order", scene, "--eye", "3,4,5", "--json", json};
  }
  void expect_refused(const std::vector<std::string>& words, const std::string& mentions) const {
    const Outcome r = run(words);
    EXPECT_EQ(r.code, usage) << r;
    EXPECT_EQ(r.out, "") << r;
    EXPECT_NE(r.err.find(mentions), std::string::npos) << "no '" << mentions << "' in: " << r;
  }
  bool nothing_is_left_aside() const {
    for (const auto& entry : fs::directory_iterator(path("")))
      if (entry.path().string().find(".partial") != std::string::npos) return false;
    return true;
  }
};

// ---- Which file is which

TEST_F(Outputs, never_take_the_place_of_what_is_read) {
  const std::string scene = file("s.off", cube), hard = path("hard.off").string(), soft = path("soft.svg").string(),
                    dotted = path("./s.off").string(), numbers = file("path.csv", "3,4,5\n"),
                    query = path("s.json").string();
  fs::create_hard_link(scene, hard);
  fs::create_symlink("s.off", soft);
  ASSERT_EQ(run({"generate", "rooms", "--out", path("rooms.off").string(), "--query", query}).code, done);
  const std::string asked = read_file(query);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"order", scene, "--certificate", scene},
        {"order", scene, "--json", dotted},
        {"order", hard, "--certificate", scene},
        {"order", scene, "--svg", soft},
        {"see", soft, "--certificate", scene},
        {"info", scene, "--json", scene},
        {"bsp", scene, "--json", hard},
        {"graph", scene, "--dot", scene},
        {"weak", scene, "--from-face", "0", "--surfaces", scene, "--method", "events"},
        {"verify", scene, numbers, "--json", numbers},
        {"compare", scene, "order", "--json", scene},
        {"cutset", scene, "--path", numbers, "--json", numbers},
        {"weak", path("rooms.off").string(), "--from-volume", scene, "--certificate", scene},
        {"fuzz", "order", "--scene", scene, "--json", scene},
        {"reduce", scene, "--out", scene, "--", "false", "{}"},
        {"reduce", scene, "--out", path("s.obj").string(), "--query", query, "--", "false", "{}"},
        {"judge", "--program", "false {scene} {query} {answer}", "--query", "see", "--contract", "exact", "--scenes",
         scene, "--json", scene},
        {"judge", "--program", "false {scene} {query} {answer}", "--query", "see", "--contract", "exact", "--scenes",
         path("").string(), "--keep", path(".").string()}})
    expect_refused(words, words[0] == "judge" ? "--scenes" : "would be lost");
  EXPECT_EQ(read_file(scene), cube);
  EXPECT_EQ(read_file(numbers), "3,4,5\n");
  EXPECT_EQ(read_file(query), asked);
}

TEST_F(Outputs, never_take_the_place_of_what_was_read_by_another_files_name) {
  // A scene whose points are in another file: what is asked for is that file, by its name or another one.
  const std::string tree = R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "index.json"}]})";
  std::string bytes(36, '\0');
  for (const std::size_t one : {14u, 30u}) bytes.replace(one, 2, "\x80\x3f");  // x of the second point, y of the third
  fs::create_directory(path("all"));
  fs::create_directory(path("all/part"));
  const std::string scene = file("all/s.gltf", tree), buffer = file("all/index.json", bytes),
                    hard = path("hard.json").string(), small = file("all/part/smallest.off", cube),
                    materials = file("lib.png", "newmtl red\nKd 1 0 0\n"),
                    painted = file("s.obj", "mtllib lib.png\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  fs::create_hard_link(buffer, hard);
  const std::string program = "sh -c 'echo > $0' {answer} {scene} {query}";
  for (const std::vector<std::string>& words : {
           std::vector<std::string>{"info", scene, "--json", buffer},
           {"info", scene, "--json", hard},
           {"pvs", scene, "--outside", "--certificates", path("all").string()},
           {"render", painted, "--eye", "0,0,2", "--colours", "materials", "--png", materials},
           {"judge", "--program", program, "--query", "see", "--contract", "exact", "--cases", "1", "--scenes",
            path("all").string(), "--keep", path("all/part").string()},
           {"judge", "--program", program, "--query", "see", "--contract", "exact", "--cases", "1", "--scenes",
            path("all").string(), "--json", small},
           {"report", path("all").string(), "--questions", "see", "--cases", "1", "--json", small},
       }) {
    const Outcome r = run(words);
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find("which would be lost"), std::string::npos) << r;
    EXPECT_EQ(read_file(buffer), bytes) << r;
    EXPECT_EQ(read_file(small), cube) << r;
    EXPECT_EQ(read_file(materials).substr(0, 10), "newmtl red") << r;
  }
}

TEST_F(Outputs, never_take_the_place_of_what_is_printed) {
  const std::string scene = file("s.off", cube), printed = path("printed").string(), link = path("link").string();
  fs::create_symlink("printed", link);
  for (const std::string& name : {printed, link, std::string("/dev/stdout")})
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--certificate", "-"}}) {
      std::vector<std::string> words{"order", scene, "--json", name};
      words.insert(words.end(), more.begin(), more.end());
      const Outcome r = run_to(printed, words);
      EXPECT_EQ(r.code, usage) << r;
      EXPECT_EQ(r.out, "") << r;
      EXPECT_NE(r.err.find("standard output goes to"), std::string::npos) << r;
    }
  EXPECT_EQ(run_to(printed, {"order", scene, "--json", "-"}).code, done);
  EXPECT_EQ(run_to("/dev/null", {"order", scene, "--json", "/dev/null"}).code, done);
}

TEST_F(Outputs, never_take_the_place_of_one_another) {
  const std::string scene = file("s.off", cube), one = path("one").string(), other = path("./one").string(),
                    ahead = path("ahead").string();
  fs::create_symlink("one", ahead);  // to what is not there yet
  for (const std::string& name : {one, other, ahead})
    expect_refused({"order", scene, "--json", one, "--certificate", name}, "writes to already");
  expect_refused({"generate", "rooms", "--out", path("a.off").string(), "--query", path("a.off").string()}, "already");
  expect_refused(
      {"fuzz", "order", "--scenes", "1", "--out", path("found").string(), "--json", path("found/order.json").string()},
      "--json writes to already");
  EXPECT_FALSE(fs::exists(one));
  EXPECT_EQ(run({"order", scene, "--json", "/dev/null", "--certificate", "/dev/null"}).code, done)
      << "a device takes them all";
}

TEST_F(Outputs, of_a_folder_of_pictures_are_held_to_all_others) {
  const std::string eyes = "3,4,5\n4,5,6\n", one = file("image_0001.svg", cube), other = file("image_0002.svg", eyes);
  const auto words = [&](const std::string& scene, const std::string& file) {
    return std::vector<std::string>{"graph", scene, "--pixels", "8x6", "--eyes", file, "--pictures", path("").string()};
  };
  const std::string scene = file("s.off", cube), numbers = file("eyes.csv", eyes);
  expect_refused(words(one, numbers),
                 "--pictures " + path("").string() + "/image_0001.svg: that is the file that SCENE");
  expect_refused(words(scene, other), "/image_0002.svg: that is the file that --eyes reads, which would be lost");
  for (const char* option : {"--json", "--dot", "--certificate"}) {
    std::vector<std::string> both = words(scene, numbers);
    both.insert(both.end(), {option, path("./image_0002.svg").string()});
    expect_refused(both, "writes to already");
  }
  fs::remove(other);
  fs::create_symlink("image_0001.svg", other);
  expect_refused(words(scene, numbers), "by a link");
  EXPECT_EQ(read_file(one), cube);
  fs::remove(other);
  EXPECT_EQ(run(words(scene, numbers)).code, done);
  EXPECT_NE(read_file(one).find("<svg"), std::string::npos);
}

TEST_F(Outputs, and_inputs_without_a_name_are_refused) {
  const std::string scene = file("s.off", cube), off = path("a.off").string();
  const std::vector<std::string> judge{"judge", "--program", "true", "--query", "see", "--contract", "exact"};
  const auto judged = [&](const std::string& option) {
    std::vector<std::string> words = judge;
    words.insert(words.end(), {option, ""});
    return words;
  };
  for (const std::vector<std::string>& words : {std::vector<std::string>{"info", ""},
                                                {"info", scene, "--json", ""},
                                                {"order", scene, "--certificate", ""},
                                                {"order", scene, "--svg", ""},
                                                {"see", scene, "--certificate", ""},
                                                {"see", scene, "--svg", ""},
                                                {"graph", scene, "--certificate", ""},
                                                {"graph", scene, "--dot", ""},
                                                {"cutset", scene, "--orbit", "3", "--svg", ""},
                                                {"cutset", scene, "--path", ""},
                                                {"weak", scene, "--from-face", "0", "--certificate", ""},
                                                {"weak", scene, "--from-face", "0", "--surfaces", ""},
                                                {"weak", scene, "--from-face", "0", "--svg", ""},
                                                {"weak", scene, "--from-face", "0", "--obj", ""},
                                                {"compare", scene, "weak", "--from-face", "0", "--svg", ""},
                                                {"verify", scene, ""},
                                                {"generate", "rooms", "--out", ""},
                                                {"generate", "rooms", "--out", off, "--query", ""},
                                                {"fuzz", "order", "--scenes", "1", "--json", ""},
                                                {"fuzz", "order", "--scenes", "1", "--out", ""},
                                                {"fuzz", "order", "--scene", ""},
                                                {"fuzz", "order", "--scene", scene, "--query", ""},
                                                {"reduce", scene, "--out", "", "--", "false", "{}"},
                                                {"reduce", scene, "--out", off, "--query", "", "--", "false", "{}"},
                                                judged("--json"),
                                                judged("--html"),
                                                judged("--keep"),
                                                judged("--scenes"),
                                                judged("--ask")})
    expect_refused(words, "is empty");
  EXPECT_FALSE(fs::exists(off));
}

// ---- Whole or not at all

TEST_F(Outputs, that_do_not_fit_leave_the_old_file_and_say_so) {
  for (const char* option : {"--json", "--certificate"}) {
    const std::string to = file("old.json", "old");
    std::vector<std::string> words = much(to);
    words[4] = option;
    Limits limits;
    limits.file_blocks = 16;
    const Outcome r = run(words, limits);
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_EQ(r.err, "sightline: " + to + ": cannot be written: File too large\n") << r;
    EXPECT_EQ(read_file(to), "old");
    EXPECT_TRUE(nothing_is_left_aside());
  }
}

TEST_F(Outputs, that_a_signal_cuts_off_leave_the_old_file_and_nothing_beside_it) {
  const std::string to = file("old.json", "old");
  std::string command = "exec 1> /dev/null; " + executable;
  for (const std::string& word : much(to)) command += " '" + word + "'";
  // As soon as there is a file aside; the whole one is there where the program was quicker.
  command += " & p=$!; while kill -0 $p && ! [ -e '" + to + ".partial' ]; do :; done; kill -TERM $p; wait $p";
  const int status = std::system(("exec 2> /dev/null; " + command).c_str());
  EXPECT_TRUE(nothing_is_left_aside());
  // The signal may come when the file is in its place already.
  const std::string text = read_file(to);
  const bool is_whole = text.size() > 1'000'000 && Json::accept(text);
  EXPECT_TRUE(is_whole || (text == "old" && WEXITSTATUS(status) != done)) << status << ' ' << text.size();
}

TEST_F(Outputs, go_into_pipes_and_through_links) {
  const std::string scene = file("s.off", cube), pipe = path("pipe").string(), link = path("link").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink("behind", link);
  std::string piped;
  std::thread reader([&] { piped = read_file(pipe); });
  const Outcome r = run({"order", scene, "--eye", "3,4,5", "--certificate", pipe, "--json", link});
  if (r.code != done) std::ofstream(pipe).close();  // or the reader would wait for ever
  reader.join();
  EXPECT_EQ(r.code, done) << r;
  EXPECT_EQ(Json::parse(piped, nullptr, false)["format"], "sightline order 2");
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(Json::parse(read_file(path("behind")), nullptr, false)["command"], "order");
}

TEST_F(Outputs, that_cannot_be_written_name_the_reason) {
  const std::string scene = file("s.off", cube), here = path("").string();
  for (const auto& [name, why] : std::vector<std::pair<std::string, std::string>>{
           {"/dev/full", "No space left on device"},
           {path("no/such").string(), path("no").string() + " is not there; make that folder, or name another file"},
           {here, "that is a folder; name a file"},
           {path("s.off/x").string(), scene + " is a file, and no folder; name another file"}}) {
    const Outcome r = run({"order", scene, "--certificate", name});
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_EQ(r.err, "sightline: " + name + ": cannot be written: " + why + "\n") << r;
  }
  const Outcome early = run({"order", file("wrong.off", "nothing"), "--certificate", path("no/such").string()});
  EXPECT_NE(early.err.find("no is not there; make that folder"), std::string::npos) << "before it is read: " << early;
}

// ---- Standard output

TEST_F(Outputs, to_a_full_standard_output_are_no_answer_whatever_it_was) {
  const std::string scene = file("s.off", cube), right = path("right.json").string();
  ASSERT_EQ(run({"order", scene, "--eye", "3,4,5", "--certificate", right}).code, done);
  Json changed = Json::parse(read_file(right));
  changed["fragments"].erase(0);
  const std::string wrong = file("wrong.json", changed.dump());
  const std::string two = file("two.off",
                               "OFF\n12 3 0\n-2 -2 4\n-2 2 4\n2 2 4\n2 -2 4\n-4 -2 2\n0 -2 2\n0 2 2\n-4 2 2\n0 -2 "
                               "2\n4 -2 2\n4 2 2\n0 2 2\n4 0 1 2 3\n4 4 5 6 7\n4 8 9 10 11\n");
  const std::vector<std::string> open{"weak",    two, "--from",        "-1,-1,0 1,-1,0 1,1,0 -1,1,0",
                                      "--cells", "1", "--event-edges", "0"};
  for (const auto& [words, code] :
       std::vector<std::pair<std::vector<std::string>, int>>{{{"verify", scene, wrong}, disagreement},
                                                             {{"verify", scene, wrong, "--json", "-"}, disagreement},
                                                             {{"--help"}, done},
                                                             {open, undecided}}) {
    EXPECT_EQ(run(words).code, code);
    const Outcome r = run_to("/dev/full", words);
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_EQ(r.err.rfind("sightline: standard output cannot be written", 0), 0u) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
  }
}

TEST_F(Outputs, one_of_them_may_be_standard_output_and_then_it_is_all_there_is) {
  const std::string scene = file("s.off", cube);
  const auto printed = [&](const std::vector<std::string>& words) {
    const Outcome r = run(words);
    EXPECT_EQ(r.code, done) << r;
    EXPECT_EQ(r.err, "") << r;
    return r;
  };
  const std::vector<std::string> lamp{"weak", scene, "--from", "0,0,3 0,1,3 1,1,3 1,0,3"};
  const auto lit = [&](const std::string& option) {
    std::vector<std::string> words = lamp;
    words.insert(words.end(), {option, "-"});
    return printed(words);
  };
  for (const std::vector<std::string>& words : {std::vector<std::string>{"order", scene, "--svg", "-"},
                                                {"see", scene, "--svg", "-"},
                                                {"cutset", scene, "--orbit", "3", "--svg", "-"}}) {
    const std::string out = printed(words).out;
    EXPECT_EQ(out.rfind("<svg ", 0), 0u) << out;
    EXPECT_EQ(out.substr(out.size() - 7), "</svg>\n");
  }
  EXPECT_EQ(lit("--svg").out.rfind("<svg ", 0), 0u);
  EXPECT_EQ(lit("--obj").out.rfind("v ", 0), 0u);
  EXPECT_EQ(printed({"graph", scene, "--dot", "-"}).out.rfind("digraph priority {", 0), 0u);
  EXPECT_EQ(printed({"graph", scene, "--certificate", "-"}).json()["format"], "sightline graph 2");
  EXPECT_EQ(printed({"generate", "rooms", "--out", path("a.off").string(), "--query", "-"}).json()["format"],
            "sightline query 1");
  EXPECT_EQ(printed({"see", scene, "--svg", path("a.svg").string(), "--certificate", "-"}).json()["format"],
            "sightline see 2");
  EXPECT_EQ(lit("--certificate").json()["format"], "sightline weak 4");
  EXPECT_FALSE(fs::exists("-"));
  expect_refused({"order", scene, "--json", "-", "--certificate", "-"}, "writes to already");
}

TEST_F(Outputs, are_read_again_from_standard_input) {
  const std::string scene = file("s.off", cube);
  input_ = scene;
  const Outcome info = run({"info", "-", "--json", "-"});
  ASSERT_EQ(info.code, done) << info;
  EXPECT_EQ(info.json()["scene"]["faces"], 6);
  const Outcome order = run({"order", "-", "--eye", "3,4,5", "--certificate", "-"});
  EXPECT_EQ(order.code, done) << order;
  input_ = file("c.json", order.out);
  const Outcome verified = run({"verify", scene, "-"});
  EXPECT_EQ(verified.code, done) << verified;
  expect_refused({"verify", "-", "-"}, "reads standard input already");
}

TEST_F(Outputs, and_standard_input_may_be_a_fifo_whose_writer_is_gone) {
  const std::string pipe = path("pipe").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  launcher_ = {"/bin/sh", "-c", "cat \"$0\" > \"$1\" & p=$!; exec < \"$1\"; wait $p; shift; exec \"$@\"",
               file("s.off", cube), pipe};
  const Outcome info = run({"info", "-", "--json", "-"}, {.seconds = 20});
  ASSERT_EQ(info.code, done) << info;
  EXPECT_EQ(info.json()["scene"]["faces"], 6);
}

TEST_F(Outputs, and_standard_input_is_read_in_the_format_that_is_said_by_all_commands) {
  // Tetrahedra in thirds: its first line is that of OFF.
  const std::string text = "OFF\n4 4 0\n0 0 0\n1/3 0 0\n0 1/3 0\n0 0 1/3\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  const std::string scene = file("scene", text), qoff = file("scene.qoff", text),
                    rays = file("rays", "1,1,1,-1,-1,-1\n"), walk = file("walk", "1,2,3\n"),
                    certificate = path("c.json").string();
  const std::vector<std::vector<std::string>> commands{
      {"info"},
      {"bsp"},
      {"order", "--eye", "3,4,5"},
      {"graph"},
      {"cutset", "--path", walk},
      {"see", "--eye", "3,4,5", "--certificate", certificate},
      {"verify", certificate},
      {"weak", "--from-face", "2"},
      {"render", "--eye", "3,4,5", "--size", "32x32", "--json", path("r.json").string()},
      {"cells"},
      {"pvs"},
      {"compare", "see", "--eye", "3,4,5", "--kernels", "exact", "--sizes", "8"},
      {"trace", "--rays", rays},
      {"shadow", "--light", "3,4,5"},
      {"boolean", "union"},
      {"fuzz", "see", "--scene"},
      {"reduce", "--out", path("small.qoff").string()}};
  const std::set<std::string> behind{"fuzz", "boolean", "reduce"};
  for (std::vector<std::string> words : commands) {
    SCOPED_TRACE(words[0]);
    const auto run_on = [&](const std::string& name, const std::vector<std::string>& more) {
      std::vector<std::string> all = words;
      all.insert(behind.contains(words[0]) ? all.end() : all.begin() + 1, name);
      all.insert(all.end(), more.begin(), more.end());
      if (words[0] == "reduce") all.insert(all.end(), {"--", "sh", "-c", "test -s {} && exit 1"});
      return run(all);
    };
    input_ = "/dev/null";
    EXPECT_EQ(run_on(qoff, {}).code, done);
    const Outcome not_of_it = run_on(qoff, {"--format", "qoff"});
    EXPECT_EQ(not_of_it.code, usage) << not_of_it;
    EXPECT_NE(not_of_it.err.find("--format"), std::string::npos) << not_of_it;
    input_ = scene;
    const Outcome said = run_on("-", {"--format", "qoff"});
    EXPECT_EQ(said.code, done) << said;
    // As what its content shows, or what is wrong: what to do is told in one line.
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, {"--format", "obj"}, {"--format", "glb"}}) {
      const Outcome wrong = run_on("-", more);
      EXPECT_EQ(wrong.code, bad_input) << wrong;
      EXPECT_TRUE(wrong.one_line_of_error()) << wrong;
      EXPECT_NE(wrong.err.find(more.empty() ? "(read as off; --format says otherwise)"
                                            : "(read as " + more[1] + "; --format says so)"),
                std::string::npos)
          << wrong;
    }
  }
  input_ = (corpus / "robust" / "nodes.gltf").string();
  EXPECT_EQ(run({"info", "-", "--format", "gltf"}).code, done);
  input_ = file("unknown", "hello\n");
  const Outcome unknown = run({"info", "-"});
  EXPECT_EQ(unknown.code, bad_input) << unknown;
  EXPECT_NE(unknown.err.find("say which with --format"), std::string::npos) << unknown;
  EXPECT_EQ(run({"info", "-", "--format", "dwg"}).code, usage);
}

TEST_F(Outputs, with_the_ending_of_another_format_are_refused) {
  const std::string scene = file("s.off", cube);
  for (const char* name : {"a.png", "a.svg.gz", "a.json"})
    for (const char* command : {"order", "see"})
      expect_refused({command, scene, "--svg", path(name).string()}, "does not end with .svg");
  expect_refused({"weak", scene, "--from-face", "0", "--obj", path("a.off").string()}, "does not end with .obj");
  EXPECT_EQ(run({"order", scene, "--svg", path("A.SVG").string()}).code, done);
  EXPECT_EQ(run({"order", scene, "--svg", path("picture").string()}).code, done) << "no ending says nothing else";
}

TEST_F(Outputs, for_programs_that_draw_are_of_all_commands_and_formats) {
  const std::string scene = (corpus / "general" / "two_rooms.off").string();
  const std::vector<std::vector<std::string>> commands{{"order", scene, "--eye", "1,1,1"},
                                                       {"see", scene, "--eye", "1,1,1"},
                                                       {"graph", scene},
                                                       {"weak", scene, "--from-face", "3"},
                                                       {"pvs", scene, "--show", "30"},
                                                       {"shadow", scene, "--light", "1,1,1"},
                                                       {"cells", scene},
                                                       {"boolean", "union", scene}};
  for (std::vector<std::string> words : commands) {
    words.insert(words.end(), {"--mesh", path("drawn.ply").string()});
    EXPECT_EQ(run(words).code, done) << words[0];
    EXPECT_EQ(run({"info", path("drawn.ply").string()}).code, done) << words[0];
    words.back() = path("drawn.stl").string();
    expect_refused(words, "does not end with one of .glb .vtp .vtu .ply .obj");
  }
  for (const char* name : {"drawn.glb", "drawn.vtp", "drawn.vtu", "drawn.obj"}) {
    EXPECT_EQ(run({"see", scene, "--eye", "1,1,1", "--mesh", path(name).string()}).code, done);
    EXPECT_GT(fs::file_size(path(name)), 1000u) << name;
  }
  // In its own order, with the place of each.
  EXPECT_NE(run({"order", scene, "--eye", "1,1,1", "--mesh", path("order.ply").string()}).code, usage);
  EXPECT_NE(read_file(path("order.ply")).find("property uint order\n"), std::string::npos);
}

/// A binary PLY as --mesh writes it: points, and for each polygon its corners and its numbers by name.
struct Drawn_mesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<std::uint32_t>> polygons;
  std::vector<std::map<std::string, std::int64_t>> numbers;
};
static Drawn_mesh read_mesh(const std::string& bytes) {
  Drawn_mesh mesh;
  const std::size_t end = bytes.find("end_header\n");
  std::istringstream header(bytes.substr(0, end));
  std::vector<std::pair<std::string, std::size_t>> properties;  // of polygons, behind their corners
  std::size_t points = 0, polygons = 0;
  bool is_long = false;
  for (std::string line; std::getline(header, line);) {
    std::istringstream words(line);
    std::string word, type, name;
    words >> word >> type;
    if (word == "element" && type == "vertex") words >> points;
    if (word == "element" && type == "face") words >> polygons;
    if (word != "property" || polygons == 0) continue;
    if (type == "list") {
      words >> name;
      is_long = name == "uint";
    } else {
      words >> name;
      properties.emplace_back(name, type == "uchar" ? 1 : 4);
    }
  }
  const char* at = bytes.data() + end + std::string_view("end_header\n").size();
  const auto take = [&]<class T>(T value) {
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
    return value;
  };
  for (std::size_t i = 0; i < points; ++i) {
    auto& p = mesh.points.emplace_back();
    for (double& x : p) x = take(double{});
  }
  for (std::size_t i = 0; i < polygons; ++i) {
    auto& corners = mesh.polygons.emplace_back(is_long ? take(std::uint32_t{}) : take(std::uint8_t{}));
    for (std::uint32_t& corner : corners) corner = take(std::uint32_t{});
    auto& numbers = mesh.numbers.emplace_back();
    for (const auto& [name, size] : properties)
      numbers[name] = size == 1 ? take(std::uint8_t{}) : name == "face" ? take(std::int32_t{}) : take(std::uint32_t{});
  }
  EXPECT_EQ(at, bytes.data() + bytes.size());
  return mesh;
}

TEST_F(Outputs, of_cells_are_closed_polyhedra_whose_neighbours_have_other_colours) {
  const std::string scene = (corpus / "general" / "two_rooms.map").string(), mesh = path("cells.ply").string(),
                    all = path("cells.json").string();
  for (const std::vector<std::string>& way : {std::vector<std::string>{}, {"--grid", "2,2,1"}, {"--coarse", "3"}}) {
    std::vector<std::string> words{"cells", scene, "--mesh", mesh, "--out", all};
    words.insert(words.end(), way.begin(), way.end());
    ASSERT_EQ(run(words).code, done);
    const Json file = Json::parse(read_file(all));
    const Drawn_mesh drawn = read_mesh(read_file(mesh));
    struct Polyhedron {
      double volume = 0;
      std::array<double, 3> area{};  // of all its walls, as vectors: nothing, where it is closed
      std::set<std::int64_t> groups, within;
    };
    std::map<std::int64_t, Polyhedron> cells;
    for (std::size_t i = 0; i < drawn.polygons.size(); ++i) {
      Polyhedron& cell = cells[drawn.numbers[i].at("cell")];
      cell.groups.insert(drawn.numbers[i].at("group"));
      if (!way.empty()) cell.within.insert(drawn.numbers[i].at(way[0] == "--grid" ? "box" : "convex_region"));
      const auto& corners = drawn.polygons[i];
      for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        const auto &p = drawn.points[corners[0]], &q = drawn.points[corners[k]], &r = drawn.points[corners[k + 1]];
        for (std::size_t x = 0; x < 3; ++x) {
          const std::size_t y = (x + 1) % 3, z = (x + 2) % 3;
          cell.area.at(x) += (q[y] - p[y]) * (r[z] - p[z]) - (q[z] - p[z]) * (r[y] - p[y]);
        }
        cell.volume += p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) +
                       p[2] * (q[0] * r[1] - q[1] * r[0]);
      }
    }
    ASSERT_EQ(cells.size(), file["cells"].size());
    for (const auto& [number, cell] : cells) {
      const Json& said = file["cells"][static_cast<std::size_t>(number)];
      EXPECT_GT(cell.volume, 0) << number;
      for (const double x : cell.area) EXPECT_NEAR(x, 0, 1e-6) << number;
      ASSERT_EQ(cell.groups.size(), 1u);
      EXPECT_EQ(*cell.groups.begin() == 8, said["solid"].get<bool>()) << number;
      EXPECT_EQ(*cell.groups.begin() == 7, said["outside"].get<bool>() && !said["solid"].get<bool>()) << number;
      if (way.empty()) continue;
      ASSERT_EQ(cell.within.size(), 1u);
      if (way[0] == "--grid") EXPECT_EQ(*cell.within.begin(), said["leaf"]);
      else if (!said["solid"]) EXPECT_EQ(*cell.within.begin(), said["convex_region"]);
    }
    std::size_t together = 0;
    for (const Json& wall : file["walls"]) {
      if (wall["cells"][1].is_null()) continue;
      const auto group = [&](int k) {
        return *cells.at(wall["cells"][static_cast<std::size_t>(k)].get<std::int64_t>()).groups.begin();
      };
      const auto& one = file["cells"][wall["cells"][0].get<std::size_t>()];
      const auto& other = file["cells"][wall["cells"][1].get<std::size_t>()];
      if (group(0) >= 7 || group(1) >= 7) continue;
      ++together;
      EXPECT_EQ(group(0) == group(1), one.contains("convex_region") && one["convex_region"] == other["convex_region"]);
    }
    EXPECT_GT(together, 3u);
  }
}

TEST_F(Outputs, of_set_operations_say_whose_each_face_is) {
  const std::string one = file("one.off", cube), mesh = path("b.ply").string();
  const std::string other =
      file("other.off",
           "OFF\n8 6 0\n-2 -2 -2\n2 -2 -2\n2 1/2 -2\n-2 1/2 -2\n-2 -2 1/2\n2 -2 1/2\n2 1/2 1/2\n-2 "
           "1/2 1/2\n4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  fs::rename(other, path("other.qoff"));
  const Outcome r = run({"boolean", "difference", one, path("other.qoff").string(), "--mesh", mesh, "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json result = r.json()["result"];
  const Drawn_mesh drawn = read_mesh(read_file(mesh));
  ASSERT_GE(drawn.polygons.size(), result["faces"].get<std::size_t>());
  std::set<std::int64_t> faces, operands;
  for (const auto& numbers : drawn.numbers) {
    const std::int64_t face = numbers.at("face");
    faces.insert(face);
    operands.insert(numbers.at("operand"));
    EXPECT_EQ(result["provenance"][static_cast<std::size_t>(face)],
              (Json{numbers.at("operand"), numbers.at("operand_face")}));
    EXPECT_EQ(numbers.at("group"), numbers.at("operand"));
    EXPECT_EQ(numbers.at("turned"), numbers.at("operand"));  // what is cut out is bounded by backs
  }
  EXPECT_EQ(faces.size(), result["faces"]);
  EXPECT_EQ(operands.size(), 2u);
}

// ---- A terminal

TEST_F(Outputs, to_a_terminal_begin_where_the_bar_was) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) GTEST_SKIP() << "no terminal to be had";
  const std::string name = ptsname(terminal), scene = path("many.off").string();
  const int kept = open(name.c_str(), O_RDWR | O_NOCTTY);  // or what is written is lost once the program closes it
  ASSERT_EQ(run({"generate", "rooms", "--size", "3", "--out", scene}).code, done);

  std::string text;
  std::atomic<bool> ended{false};
  std::thread reader([&] {
    for (char bytes[4096];;) {
      const bool last = ended;
      const ssize_t n = read(terminal, bytes, sizeof bytes);
      if (n > 0) text.append(bytes, static_cast<std::size_t>(n));
      else if (last) return;
      else std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  errors_ = name;
  const Outcome r = run_to(
      name, {"weak", scene, "--from-face", "0", "--method", "sample", "--rays", sanitized ? "600000" : "3000000"});
  ended = true;
  reader.join();
  close(kept);
  close(terminal);
  EXPECT_EQ(r.code, done) << r;
  const std::size_t bar = text.rfind("searching ["), clear = text.find("\r\033[K", bar), table = text.find("scene   ");
  ASSERT_NE(bar, std::string::npos) << "the run was too short for a bar: " << text;
  EXPECT_LT(clear, table) << text;
}

}  // namespace program
