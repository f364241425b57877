// Certificates that somebody has changed are rejected, with exit code 1 and a reason.

#include "program.h"

#include <sightline/kernel/number.h>

#include <sys/stat.h>

#include <fstream>
#include <functional>
#include <set>
#include <thread>

namespace program {

class Certificates : public Program {
 protected:
  const std::string cornell = (corpus / "general" / "cornell.obj").string(),
                    duplicates = (corpus / "robust" / "duplicates.off").string();

  Json certificate(const std::string& scene, const std::string& eye) {
    const std::string to = path("made.json").string();
    const Outcome r = run({"order", scene, "--eye", eye, "--certificate", to});
    EXPECT_EQ(r.code, done) << r;
    const Json made = Json::parse(read_file(to));
    expect_accepted(scene, made);
    return made;
  }
  Outcome verify(const std::string& scene, const Json& certificate) {
    return run({"verify", scene, file("changed.json", certificate.dump()), "--json", "-"});
  }
  void expect_accepted(const std::string& scene, const Json& certificate) {
    const Outcome r = verify(scene, certificate);
    EXPECT_EQ(r.code, done) << r;
    EXPECT_EQ(r.json()["result"]["accepted"], true) << r;
  }
  /// Returns why.
  std::string expect_rejected(const std::string& scene, const Json& certificate) {
    const Outcome r = verify(scene, certificate);
    EXPECT_EQ(r.code, disagreement) << r;
    EXPECT_EQ(r.err, "") << r;
    const Json d = r.json();
    EXPECT_EQ(d["result"]["accepted"], false) << r;
    const std::string why = d["result"]["why"];
    EXPECT_FALSE(why.empty() || why.find('\n') != std::string::npos) << why;
    return why;
  }
  /// A vertex, written out where it stands.
  static Json& vertex(Json& certificate, const char* list, std::size_t entry, std::size_t corner) {
    Json& at = certificate[list][entry]["vertices"][corner];
    if (at.is_number()) {
      const Json point = certificate["points"][at.get<std::size_t>()];
      at = point;
    }
    return at;
  }
  std::string expect_rejected_after(const std::string& scene, Json certificate,
                                    const std::function<void(Json&)>& change) {
    change(certificate);
    return expect_rejected(scene, certificate);
  }
};

TEST_F(Certificates, a_vertex_moved_by_two_to_the_minus_sixty_is_rejected) {
  const Json made = certificate(cornell, "5,-20,5");
  sightline::Rational tiny(1);
  mpq_div_2exp(tiny.get_mpq_t(), tiny.get_mpq_t(), 60);
  for (std::size_t f = 0; f < made["fragments"].size(); f += 5)
    for (std::size_t k = 0; k < 3; ++k)
      for (const bool up : {false, true})
        expect_rejected_after(cornell, made, [&](Json& c) {
          Json& x = vertex(c, "fragments", f, f % 3)[k];
          x = sightline::to_string(sightline::rational_from_string(x.get<std::string>()) +
                                   (up ? tiny : sightline::Rational(-tiny)));
        });
}

TEST_F(Certificates, of_any_kind_are_verified_from_a_pipe) {
  const std::string cube = (corpus / "general" / "cube.off").string(), why = path("why.json").string(),
                    named = path("pipe").string();
  ASSERT_EQ(mkfifo(named.c_str(), 0600), 0);
  for (const std::vector<std::string>& maker :
       {std::vector<std::string>{"order", cube, "--eye", "3,4,5"}, {"boolean", "union", cube}}) {
    std::vector<std::string> words = maker;
    words.insert(words.end(), {"--certificate", why});
    ASSERT_EQ(run(words).code, done);
    const std::string bytes = read_file(why);
    const auto expect_verified = [&](const std::string& from) {
      const Outcome r = run({"verify", cube, from, "--json", "-"}, {.seconds = 20});
      EXPECT_EQ(r.code, done) << r;
      if (r.code == done) {
        EXPECT_EQ(r.json()["counters"]["fragments"], 6) << r;
      }
    };

    // 1. A name that can be opened once: both ends wait for each other.
    std::thread writer([&] { std::ofstream(named) << bytes; });
    expect_verified(named);
    const int end = open(named.c_str(), O_RDWR | O_NONBLOCK);  // lets the writer go where nobody has read
    writer.join();
    close(end);

    // 2. Standard input.
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    ASSERT_EQ(write(ends[1], bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));  // it holds 64 KiB
    close(ends[1]);
    input_ = "/dev/fd/" + std::to_string(ends[0]);
    expect_verified("-");
    close(ends[0]);
    input_ = "/dev/null";
  }
}

TEST_F(Certificates, two_fragments_that_overlap_and_change_places_are_rejected) {
  const std::string stacked = path("stacked.off").string();
  ASSERT_EQ(run({"generate", "stacked", "--size", "6", "--out", stacked}).code, done);
  const Json made = certificate(stacked, "0.5,0.25,100");
  ASSERT_EQ(made["fragments"].size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = i + 1; j < 6; ++j)
      expect_rejected_after(stacked, made, [&](Json& c) { std::swap(c["fragments"][i], c["fragments"][j]); });
}

TEST_F(Certificates, fragments_that_do_not_overlap_may_change_places) {
  const std::string scene =
      file("beside.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n5 5 1\n6 5 1\n5 6 1\n3 0 1 2\n3 3 4 5\n");
  Json made = certificate(scene, "0,0,10");
  std::swap(made["fragments"][0], made["fragments"][1]);
  expect_accepted(scene, made);
}

TEST_F(Certificates, a_fragment_dropped_or_doubled_or_turned_is_rejected) {
  const Json made = certificate(cornell, "5,-20,5");
  const std::size_t n = made["fragments"].size();
  for (std::size_t f = 0; f < n; ++f) expect_rejected_after(cornell, made, [&](Json& c) { c["fragments"].erase(f); });
  expect_rejected_after(cornell, made, [&](Json& c) { c["fragments"].push_back(c["fragments"][n - 1]); });
  expect_rejected_after(cornell, made, [&](Json& c) {
    std::reverse(c["fragments"][3]["vertices"].begin(), c["fragments"][3]["vertices"].end());
  });
  expect_rejected_after(cornell, made, [](Json& c) { c["fragments"].clear(); });
}

TEST_F(Certificates, a_fragment_said_to_be_of_another_face_is_rejected) {
  const Json made = certificate(cornell, "5,-20,5");
  expect_rejected_after(cornell, made,
                        [](Json& c) { c["fragments"][0]["face"] = (c["fragments"][0]["face"].get<int>() + 1) % 16; });
  expect_rejected_after(cornell, made, [](Json& c) { c["fragments"][0]["face"] = 16; });
  expect_rejected_after(cornell, made, [](Json& c) { c["fragments"][0]["face"] = 4294967295; });
}

TEST_F(Certificates, lies_about_what_is_set_aside_are_rejected) {
  const Json made = certificate(cornell, "5,-20,5");
  for (const char* why : {"zero area", "duplicate of 1", "duplicate of 0", "duplicate of 4294967295", "duplicate of",
                          "self-intersecting", "not needed", ""}) {
    std::set<std::string> reasons;
    const std::string reason = expect_rejected_after(cornell, made, [&](Json& c) {
      Json kept = Json::array();
      for (const Json& fragment : c["fragments"])
        if (fragment["face"] != 0) kept.push_back(fragment);
      c["fragments"] = kept;
      c["set_aside"].push_back({{"face", 0}, {"why", why}});
    });
    EXPECT_NE(reason.find("face 0"), std::string::npos) << reason;
  }
  expect_rejected_after(cornell, made, [](Json& c) { c["set_aside"].push_back({{"face", 16}, {"why", "zero area"}}); });
}

TEST_F(Certificates, what_was_set_aside_must_be_said) {
  const Json made = certificate(duplicates, "1,1,10");
  ASSERT_EQ(made["set_aside"].size(), 3u);
  expect_rejected_after(duplicates, made, [](Json& c) { c["set_aside"].erase(0); });
  expect_rejected_after(duplicates, made, [](Json& c) { c.erase("set_aside"); });
  // Two that vouch for each other: 1 is a duplicate of 0, and 0 of 1.
  expect_rejected_after(duplicates, made, [](Json& c) {
    Json kept = Json::array();
    for (const Json& fragment : c["fragments"])
      if (fragment["face"] != 0) kept.push_back(fragment);
    c["fragments"] = kept;
    c["set_aside"].push_back({{"face", 0}, {"why", "duplicate of 1"}});
  });
  // The back of a face is no duplicate of it.
  expect_rejected_after(duplicates, made, [](Json& c) {
    Json kept = Json::array();
    for (const Json& fragment : c["fragments"])
      if (fragment["face"] != 3) kept.push_back(fragment);
    c["fragments"] = kept;
    c["set_aside"].push_back({{"face", 3}, {"why", "duplicate of 0"}});
  });
}

TEST_F(Certificates, another_eye_or_another_scene_is_rejected) {
  const Json made = certificate(cornell, "5,-20,5");
  expect_rejected_after(cornell, made, [](Json& c) { c["eye"] = {"5", "40", "5"}; });
  expect_rejected((corpus / "general" / "cube.off").string(), made);
}

TEST_F(Certificates, pieces_of_a_cut_face_that_are_changed_are_rejected) {
  const std::string scene = (corpus / "robust" / "non_planar.off").string();
  const Json made = certificate(scene, "2,2,10");
  ASSERT_GE(made["pieces"].size(), 2u);
  expect_rejected_after(scene, made, [](Json& c) { c["pieces"].erase(0); });
  expect_rejected_after(scene, made, [](Json& c) { c["pieces"].clear(); });
  expect_rejected_after(scene, made, [](Json& c) { vertex(c, "pieces", 0, 0)[2] = "7"; });
  expect_rejected_after(scene, made,
                        [](Json& c) { std::swap(c["pieces"][0]["vertices"], c["pieces"][1]["vertices"]); });
}

TEST_F(Certificates, of_what_polygons_can_see_are_verified) {
  // A square that looks down on the source, and a roof between the two.
  const std::string scene = file(
      "roof.off", "OFF\n8 2 0\n0 1 3\n1 1 3\n1 0 3\n0 0 3\n-5 -5 1\n6 -5 1\n6 6 1\n-5 6 1\n4 0 1 2 3\n4 4 5 6 7\n");
  const Json made = Json::parse(R"({"format": "sightline weak 1",
    "fragments": [{"face": 0, "piece": 0, "vertices": [["0","1","3"],["1","1","3"],["1","0","3"],["0","0","3"]]}, {"face": 1, "piece": 0, "vertices": [["-5","-5","1"],["6","-5","1"],["6","6","1"],["-5","6","1"]]}],
    "sources": [[["0","0","0"],["1","0","0"],["1","1","0"],["0","1","0"]]], "visible": [], "lines": [],
    "hidden": [{"fragment": 0, "source": 0, "proof": [["blocked", 1]]}, {"fragment": 1, "source": 0, "proof": [["away"]]}]})");
  expect_accepted(scene, made);
  EXPECT_NE(expect_rejected_after(scene, made, [](Json& c) { c["two_sided"] = true; })
                .find("hidden 1 (face 1), node 0 is not away"),
            std::string::npos);
  EXPECT_NE(expect_rejected_after(scene, made, [](Json& c) { c["hidden"][0]["proof"][0][1] = 0; })
                .find("hidden 0 (face 0), node 0 is not blocked by fragment 0"),
            std::string::npos);
  Json unread = made;
  unread["hidden"][0]["proof"][0][1] = 2;
  const Outcome r = verify(scene, unread);
  EXPECT_EQ(r.code, bad_input) << r;
  EXPECT_NE(r.err.find("hidden[0].proof[0][1]: expected a number below 2"), std::string::npos) << r;
}

}  // namespace program
