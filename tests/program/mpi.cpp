// mpirun sightline pvs: processes that share the work of one table.

#include "program.h"
#include "terminal.h"

#include <cstdlib>
#include <map>

namespace program {

class Mpi : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    if (std::system("command -v mpirun >/dev/null 2>&1") != 0) GTEST_SKIP() << "no mpirun here (Debian: openmpi-bin)";
    if (!fs::exists(fs::path(executable).parent_path() / "sightline_mpi.so"))
      GTEST_SKIP() << "the program is built without MPI (Debian: libopenmpi-dev)";
    for (const char* root : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"}) setenv(root, "1", 1);
    if (sanitized) setenv("ASAN_OPTIONS", "malloc_context_size=2:handle_sigill=1:detect_leaks=0", 1);  // MPI's own
  }

  /// Runs so many processes, each of which does `before` in a shell, with the program's command line as its arguments.
  Outcome run_on(int processes, const std::vector<std::string>& arguments, const std::string& before = "") {
    launcher_ = {"mpirun", "--quiet", "--oversubscribe", "-n", std::to_string(processes)};
    if (!before.empty()) launcher_.insert(launcher_.end(), {"sh", "-c", before + "; exec \"$@\"", "sh"});
    Outcome outcome = run(arguments);
    launcher_.clear();
    return outcome;
  }

  std::string at(const std::string& name) const { return path(name).string(); }
  std::map<std::string, std::string> files_of(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(path(folder)))
      files[entry.path().filename().string()] = read_file(entry.path());
    return files;
  }

  const std::string rooms = (corpus / "general" / "two_rooms.map").string();
};

TEST_F(Mpi, three_processes_write_what_one_does) {
  const auto arguments = [&](const std::string& name) {
    return std::vector<std::string>{"pvs",           rooms,       "--out", at(name + ".pvs"), "--certificates",
                                    at(name + ".d"), "--threads", "1",     "--json",          "-"};
  };
  const Outcome one = run(arguments("one")), three = run_on(3, arguments("three"));
  ASSERT_EQ(one.code, done) << one;
  ASSERT_EQ(three.code, done) << three;
  EXPECT_EQ(three.err, "");
  EXPECT_EQ(read_file(path("three.pvs")), read_file(path("one.pvs")));
  EXPECT_EQ(files_of("three.d"), files_of("one.d"));
  Json json = three.json(), wanted = one.json();
  for (Json* document : {&json, &wanted}) document->erase("seconds");
  EXPECT_EQ(json, wanted);
}

TEST_F(Mpi, pairs_of_cells_and_the_faces_of_a_shard_are_shared_too) {
  const std::vector<std::string> pvs{"pvs", rooms, "--cells-too", "--shard", "1/2", "--out"};
  const auto to = [&](const std::string& name) {
    std::vector<std::string> arguments = pvs;
    arguments.push_back(at(name));
    return arguments;
  };
  ASSERT_EQ(run(to("one.pvs")).code, done);
  const Outcome two = run_on(2, to("two.pvs"));
  ASSERT_EQ(two.code, done) << two;
  EXPECT_EQ(read_file(path("two.pvs")), read_file(path("one.pvs")));
}

TEST_F(Mpi, where_a_process_is_killed_what_was_done_is_kept) {
  const std::string house = at("house.off");
  ASSERT_EQ(run({"generate", "rooms", "--size", sanitized ? "1" : "2", "--seed", "3", "--out", house}).code, done);
  ASSERT_EQ(run({"pvs", house, "--out", at("whole.pvs")}).code, done);
  const std::vector<std::string> pvs{"pvs", house, "--resume", "--out", at("again.pvs"), "--json", "-"};
  // Once three blocks are there the last process dies.
  const std::string parts = at("again.pvs.parts");
  const Outcome killed = run_on(3, pvs,
                                "if [ \"$OMPI_COMM_WORLD_RANK\" = 2 ]; then (until [ \"$(ls " + parts +
                                    " 2>/dev/null | wc -l)\" -ge 3 ]; do sleep 0.005; done; kill -9 $$) & fi");
  EXPECT_NE(killed.code, done) << killed;
  EXPECT_FALSE(fs::exists(path("again.pvs")));
  const Outcome last = run(pvs);
  ASSERT_EQ(last.code, done) << last;
  EXPECT_GE(last.json()["result"]["blocks_kept"], 2);  // the third may have been being written
  EXPECT_EQ(read_file(path("again.pvs")), read_file(path("whole.pvs")));
  EXPECT_FALSE(fs::exists(parts));
}

TEST_F(Mpi, an_error_ends_all_with_one_line_and_its_exit_code) {
  // 1. All find it.
  const Outcome unreadable = run_on(3, {"pvs", at("missing.map"), "--out", at("t.pvs")});
  EXPECT_EQ(unreadable.code, bad_input) << unreadable;
  EXPECT_TRUE(unreadable.one_line_of_error()) << unreadable;
  EXPECT_NE(unreadable.err.find("missing.map"), std::string::npos) << unreadable;
  // 2. The first alone, which writes.
  const Outcome full = run_on(2, {"pvs", rooms, "--out", "/dev/full"});
  EXPECT_EQ(full.code, bad_input) << full;
  EXPECT_TRUE(full.one_line_of_error()) << full;
  // 3. A helper alone, which has no such file, or another scene.
  fs::copy(rooms, path("here.map"));
  const std::string elsewhere = "if [ \"$OMPI_COMM_WORLD_RANK\" = 1 ]; then cd /; fi";
  const std::string here = fs::current_path().string();
  fs::current_path(path(""));
  const Outcome lost = run_on(2, {"pvs", "here.map", "--out", at("t.pvs")}, elsewhere);
  fs::current_path(here);
  EXPECT_EQ(lost.code, bad_input) << lost;
  EXPECT_TRUE(lost.one_line_of_error()) << lost;
  EXPECT_NE(lost.err.find("process 1: here.map"), std::string::npos) << lost;
  EXPECT_FALSE(fs::exists(path("t.pvs")));
}

TEST_F(Mpi, processes_that_were_asked_something_else_are_refused) {
  const std::string other = "if [ \"$OMPI_COMM_WORLD_RANK\" = 1 ]; then set -- \"$@\" --shard 1/2; fi";
  const Outcome r = run_on(2, {"pvs", rooms, "--out", at("t.pvs")}, other);
  EXPECT_EQ(r.code, bad_input) << r;
  EXPECT_TRUE(r.one_line_of_error()) << r;
  EXPECT_NE(r.err.find("asked another question"), std::string::npos) << r;
  EXPECT_FALSE(fs::exists(path("t.pvs")));
}

TEST_F(Mpi, the_first_process_shows_a_bar_on_a_terminal) {
  if (sanitized)
    GTEST_SKIP() << "it is about a bar after a second of work; other tests of these processes are sanitized";
  const std::string house = at("house.off"), smaller = at("smaller.off");  // two seconds, and one
  ASSERT_EQ(run({"generate", "rooms", "--size", "3", "--seed", "3", "--out", house}).code, done);
  ASSERT_EQ(run({"generate", "rooms", "--size", "2", "--seed", "3", "--out", smaller}).code, done);
  const auto told = [&](const std::string& scene, std::vector<std::string> more) {
    std::vector<std::string> words{"mpirun",
                                   "--quiet",
                                   "--oversubscribe",
                                   "-n",
                                   "3",
                                   "sh",
                                   "-c",
                                   "exec \"$@\" 2> /dev/tty",
                                   "sh",
                                   executable,
                                   "pvs",
                                   scene,
                                   "--threads",
                                   "1",
                                   "--out",
                                   at("t.pvs")};
    words.insert(words.end(), more.begin(), more.end());
    return on_a_terminal(words);
  };
  const std::string bar = told(house, {});
  EXPECT_NE(bar.find("looking [###"), std::string::npos) << bar;
  EXPECT_NE(bar.find("s left"), std::string::npos) << bar;
  EXPECT_TRUE(bar.ends_with("\r\033[K")) << "taken away at the end: " << bar;
  EXPECT_EQ(told(smaller, {"--quiet"}), "");
}

}  // namespace program
