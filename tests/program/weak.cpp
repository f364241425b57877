// sightline weak: answers, certificates, pictures, sources that are none.

#include "program.h"
#include "terminal.h"

#include <algorithm>

namespace program {

class Weak : public Program {
 protected:
  const std::string cube = (corpus / "general" / "cube.off").string();  // [0, 1]^3
  const std::string cornell = (corpus / "general" / "cornell.obj").string();

  Json weak(std::vector<std::string> arguments, int code = done) {
    arguments.insert(arguments.begin(), "weak");
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, code) << r;
    return r.json();
  }
};

TEST_F(Weak, sees_the_sides_of_a_cube_that_face_the_source_and_proves_the_others_hidden) {
  const std::string to = path("weak.json").string();
  const Json above = weak({cube, "--from", "0,0,3 0,1,3 1,1,3 1,0,3", "--certificate", to});
  EXPECT_EQ(above["result"]["visible"].size(), 1u);
  EXPECT_EQ(above["result"]["hidden"].size(), 5u);
  EXPECT_EQ(above["result"]["undecided"].size(), 0u);
  EXPECT_EQ(above["result"]["certificate"], to);
  const Outcome checked = run({"verify", cube, to, "--json", "-"});
  EXPECT_EQ(checked.code, done) << checked;
  EXPECT_EQ(checked.json()["result"]["accepted"], true);
  // Larger than the cube: it sees four sides as well. Turned over: nothing.
  EXPECT_EQ(weak({cube, "--from", "-1,-1,3 -1,2,3 2,2,3 2,-1,3"})["result"]["visible"].size(), 5u);
  EXPECT_EQ(weak({cube, "--from", "0,0,3 1,0,3 1,1,3 0,1,3"})["result"]["visible"].size(), 0u);
  // Two polygons see what either sees.
  EXPECT_EQ(
      weak({cube, "--from", "0,0,3 0,1,3 1,1,3 1,0,3", "--from", "0,0,-3 1,0,-3 1,1,-3 0,1,-3"})["result"]["visible"]
          .size(),
      2u);
  // From a face: none of a convex body's own faces is in front of it; inside, from behind, all others are.
  EXPECT_EQ(weak({cube, "--from-face", "0"})["result"]["visible"].size(), 0u);
}

TEST_F(Weak, says_where_the_source_may_be_the_wrong_way_round) {
  const std::string note = "turned round?";
  const Outcome away = run({"weak", cube, "--from", "0,0,3 1,0,3 1,1,3 0,1,3"}),
                towards = run({"weak", cube, "--from", "0,0,3 0,1,3 1,1,3 1,0,3"});
  EXPECT_NE(away.out.find(note), std::string::npos) << away;
  EXPECT_EQ(towards.out.find(note), std::string::npos) << towards;
}

TEST_F(Weak, proves_when_each_face_is_visible_along_a_path) {
  const std::string lamp = (corpus / "general" / "lamp_and_screens.off").string(), to = path("along.json").string();
  weak({lamp, "--along", "1/2,-1,3/2 7,5,4", "--two-sided", "--certificate", to});
  const auto verdict = [&](const Json& certificate) {
    return run({"verify", lamp, file("changed.json", certificate.dump()), "--json", "-"});
  };
  const Json made = Json::parse(read_file(to));
  EXPECT_EQ(made["format"], "sightline along 2");
  EXPECT_EQ(verdict(made).code, done) << verdict(made);
  ASSERT_GT(made["faces"].size(), 3u);
  for (std::size_t k = 0; k < made["faces"].size(); ++k) {
    Json lie = made;
    lie["faces"][k]["seen"].erase(0);
    EXPECT_EQ(verdict(lie).code, disagreement) << k;
  }
  Json other = made;
  other["path"][1][2] = "401/100";
  EXPECT_EQ(verdict(other).code, disagreement);
}

TEST_F(Weak, walks_through_a_door_along_a_path) {
  const std::string rooms = (corpus / "general" / "two_rooms.off").string(), picture = path("walk.svg").string();
  const Json along = weak({rooms, "--along", "1,3/2,3/2 7,3/2,3/2", "--svg", picture})["result"]["along"];
  // `see` says the same of both ends.
  const auto seen_from = [&](const std::string& eye) {
    return run({"see", rooms, "--eye", eye, "--json", "-"}).json()["result"]["visible"];
  };
  EXPECT_EQ(along["visible_at_start"], seen_from("1,3/2,3/2"));
  EXPECT_EQ(along["visible_at_end"], seen_from("7,3/2,3/2"));
  EXPECT_EQ(along["visible"].size(), 137u);
  ASSERT_EQ(along["events"].size(), 29u);
  const Json& first = along["events"][0];
  EXPECT_EQ(first["t"]["root"], "1/30");
  EXPECT_EQ(first["kind"], "horizon");
  EXPECT_EQ(first["disappear"], Json::array({136}));
  EXPECT_NE(read_file(picture).find("<g id=\"face-136\">"), std::string::npos);
  // What is no path, and what it does not go with.
  for (const char* wrong : {"1,2,3", "1,2,3 1,2,3", "1,2,3 4,5", "1,2,3 4,5,6 7,8,9"})
    EXPECT_EQ(run({"weak", rooms, "--along", wrong}).code, usage) << wrong;
  EXPECT_EQ(run({"weak", rooms, "--along", "1,2,3 4,5,6", "--from-face", "0"}).code, usage);
  EXPECT_EQ(run({"weak", rooms, "--along", "1,2,3 4,5,6", "--method", "events"}).code, usage);
  EXPECT_EQ(run({"weak", rooms, "--along", "1,2,3 4,5,6", "--partition", "0"}).code, usage);
}

TEST_F(Weak, divides_a_wall_behind_a_door_into_penumbra_and_umbra) {
  const std::string rooms = (corpus / "general" / "two_rooms.off").string(), picture = path("wall.svg").string(),
                    lamp = "1,1,29/10 1,2,29/10 2,2,29/10 2,1,29/10";
  const Json wall = weak({rooms, "--from", lamp, "--partition", "84", "--svg", picture})["result"]["partition"];
  EXPECT_EQ(wall["lit"], Json::array({0.0, 0.0}));
  EXPECT_LT(wall["umbra"][0].get<double>(), 0.241130005188);
  EXPECT_GT(wall["umbra"][1].get<double>(), 0.241130005187);
  ASSERT_EQ(wall["cells"].size(), 2u);
  EXPECT_EQ(wall["cells"][0]["light"], "umbra");
  EXPECT_EQ(wall["cells"][1]["light"], "penumbra");
  ASSERT_EQ(wall["borders"].size(), 2u);
  EXPECT_EQ(wall["borders"][0]["kind"], "conic");
  EXPECT_EQ(wall["borders"][0]["curve"], Json::array({"-81", "90", "-55", "0", "50", "0"}));
  EXPECT_NE(read_file(picture).find("<path"), std::string::npos);
  // What rays make of it, beside it.
  const Json sampled = weak({rooms, "--from", lamp, "--partition", "84", "--beside-rays", "1600", "--svg",
                             picture})["result"]["partition"]["sampled"];
  EXPECT_EQ(sampled["rays"], 1600);
  EXPECT_EQ(sampled["lit"], 0.0);
  EXPECT_GT(sampled["umbra"].get<double>(), 0.25);  // corners of the lamp are missed
  EXPECT_NEAR(sampled["umbra"].get<double>() + sampled["penumbra"].get<double>(), 1, 1e-9);
  EXPECT_NE(read_file(picture).find("1600 rays:"), std::string::npos);
  EXPECT_EQ(run({"weak", rooms, "--from", lamp, "--beside-rays", "100"}).code, usage);
  // What it does not go with, and faces that there are not.
  for (const char* other : {"--certificate", "--obj"})
    EXPECT_EQ(run({"weak", rooms, "--from", lamp, "--partition", "84", other, path("x.obj").string()}).code, usage);
  EXPECT_EQ(run({"weak", rooms, "--from", lamp, "--partition", "84", "--method", "events"}).code, usage);
  for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{{"--eye", "1,1,1"},
                                                                                      {"--look", "1,0,0"},
                                                                                      {"--up", "0,1,0"},
                                                                                      {"--field", "60"},
                                                                                      {"--shade", "none"},
                                                                                      {"--size", "320x200"},
                                                                                      {"--background", "white"}}) {
    const Outcome wrong = run({"weak", rooms, "--from", lamp, "--partition", "84", option, value});
    EXPECT_EQ(wrong.code, usage) << option;
    EXPECT_NE(wrong.err.find(option + " is for faces that are visible or hidden"), std::string::npos) << wrong.err;
    EXPECT_EQ(run({"weak", rooms, "--along", "1,1,1 7,2,1", option, value}).code, usage) << option;
  }
  EXPECT_EQ(run({"weak", rooms, "--from", lamp, "--partition", "500"}).code, usage);
  EXPECT_EQ(run({"weak", rooms, "--from", lamp, "--all-borders"}).code, usage);
}

TEST_F(Weak, ends_with_its_budget_beside_rays_and_says_how_many_were_asked) {
  const std::string rooms = (corpus / "general" / "two_rooms.off").string();
  std::vector<std::string> arguments{rooms,         "--from",   "1,1,29/10 1,2,29/10 2,2,29/10 2,1,29/10",
                                     "--partition", "84",       "--beside-rays",
                                     "10000000",    "--budget", "1"};
  const Json sampled = weak(arguments, undecided)["result"]["partition"]["sampled"];
  EXPECT_EQ(sampled["asked"], 10000000);
  EXPECT_LT(sampled["rays"].get<std::size_t>(), 10000000u);
  arguments.insert(arguments.begin(), "weak");
  const Outcome text = run(arguments);
  EXPECT_EQ(text.code, undecided) << text;
  EXPECT_NE(text.out.find(" of 10000000 rays, as the budget ran out"), std::string::npos) << text;
  EXPECT_NE(text.out.find(" by rays"), std::string::npos) << text;
}

TEST_F(Weak, tells_shares_of_a_sliver_too_thin_for_areas_of_its_box_in_doubles) {
  const std::string thin =
      file("thin.qoff", "OFF\n3 1 0\n0 0 0\n3 1 0\n1 4503599627370499/13510798882111488 0\n3 0 1 2\n");
  const Outcome lit = run({"weak", thin, "--from", "0,0,5 0,1,5 1,0,5", "--partition", "0"});
  EXPECT_NE(lit.out.find("lit 100.000000 %, penumbra 0.000000 %, umbra 0.000000 %"), std::string::npos) << lit;
  const Outcome split = run({"weak", thin, "--from", "3/2,0,0 3/2,1,5 3/2,0,5", "--partition", "0"});
  EXPECT_NE(split.out.find("lit 37.500000 %, penumbra 0.000000 %, umbra 62.500000 %"), std::string::npos) << split;
}

TEST_F(Weak, lights_two_rooms_through_the_door_between_them) {
  const std::string rooms = (corpus / "general" / "two_rooms.off").string(), to = path("rooms.json").string();
  const Json lit = weak({rooms, "--from", "1,1,29/10 1,2,29/10 2,2,29/10 2,1,29/10", "--certificate", to});
  EXPECT_EQ(lit["result"]["visible"].size(), 89u);
  EXPECT_EQ(lit["result"]["hidden"].size(), 53u);
  EXPECT_EQ(run({"verify", rooms, to}).code, done);
}

TEST_F(Weak, by_rays_sees_no_more_than_there_is_and_proves_nothing) {
  const std::string rooms = (corpus / "general" / "two_rooms.off").string(),
                    lamp = "1,1,29/10 1,2,29/10 2,2,29/10 2,1,29/10";
  const Json all = weak({rooms, "--from", lamp})["result"]["visible"],
             few = weak({rooms, "--from", lamp, "--method", "sample", "--rays", "300"})["result"]["visible"];
  EXPECT_LT(few.size(), all.size());
  EXPECT_GT(few.size(), 20u);
  for (const Json& face : few) EXPECT_NE(std::find(all.begin(), all.end(), face), all.end()) << face;
  const Outcome r =
      run({"weak", rooms, "--from", lamp, "--method", "sample", "--certificate", path("no.json").string()});
  EXPECT_EQ(r.code, usage) << r;
}

TEST_F(Weak, by_events_says_the_same) {
  for (const char* const from : {"0,0,3 0,1,3 1,1,3 1,0,3", "-1,-1,3 -1,2,3 2,2,3 2,-1,3", "0,0,3 1,0,3 1,1,3 0,1,3"}) {
    const Json lines = weak({cube, "--from", from})["result"],
               events = weak({cube, "--from", from, "--method", "events"})["result"];
    EXPECT_EQ(lines["visible"], events["visible"]) << from;
    EXPECT_EQ(lines["hidden"], events["hidden"]) << from;
  }
}

TEST_F(Weak, rejects_a_certificate_whose_answer_was_changed) {
  const std::string to = path("weak.json").string();
  weak({cornell, "--from-face", "5", "--certificate", to});
  Json certificate = Json::parse(read_file(to));
  ASSERT_GT(certificate["visible"].size(), 0u);
  ASSERT_GT(certificate["hidden"].size(), 0u);
  EXPECT_EQ(run({"verify", cornell, to}).code, done);
  Json other = certificate;
  other["visible"].erase(0);
  EXPECT_EQ(run({"verify", cornell, file("less.json", other.dump())}).code, disagreement);
  other = certificate;
  other["hidden"][0]["proof"] = Json::array({Json::array({"away"})});
  other["hidden"][0]["fragment"] = other["visible"][0]["fragment"];
  EXPECT_EQ(run({"verify", cornell, file("other.json", other.dump())}).code, disagreement);
}

TEST_F(Weak, draws_and_marks_what_it_found) {
  const std::string svg = path("weak.svg").string(), obj = path("weak.obj").string();
  weak({cornell, "--from-face", "5", "--eye", "5,-15,5", "--svg", svg, "--obj", obj});
  EXPECT_NE(read_file(svg).find("<polygon"), std::string::npos);
  const std::string marked = read_file(obj);
  EXPECT_NE(marked.find("\ng visible\n"), std::string::npos);
  EXPECT_NE(marked.find("\nf 1 2 3"), std::string::npos);
}

TEST_F(Weak, refuses_sources_that_are_none) {
  const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
    arguments.insert(arguments.begin(), {"weak", cube});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, usage) << r;
    EXPECT_NE(r.err.find(why), std::string::npos) << r;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r;
  };
  refused({}, "--from-face ID");
  refused({"--from-face", "77"}, "no such face");
  refused({"--from", "0,0,3 1,0,3"}, "fewer than three");
  refused({"--from", "0,0,3 1,0,3 2,0,3"}, "no area");
  refused({"--from", "0,0,3 1,0,3 1,1,4 0,1,3"}, "not planar");
  refused({"--from", "0,0,3 4,0,3 1,1,3 0,4,3"}, "not convex");
  refused({"--from", "0,0,3 1,0 1,1,3"}, "--from");
}

TEST_F(Weak, ends_with_its_budget_also_by_methods_that_leave_nothing_undecided) {
  const Outcome r = run({"weak", cube, "--from", "0,0,3 0,1,3 1,1,3 1,0,3", "--method", "sample", "--rays",
                         "1000000000000", "--budget", "0.2"},
                        {20, 1024});
  EXPECT_EQ(r.code, undecided) << r;
  EXPECT_TRUE(r.one_line_of_error()) << r;
  EXPECT_NE(r.err.find("the budget of 0.2 s ran out"), std::string::npos) << r;
  EXPECT_EQ(r.out, "") << r;
}

TEST_F(Weak, says_undecided_with_exit_code_4_where_it_may_not_search) {
  const std::string scene = file("two.off",
                                 "OFF\n12 3 0\n-2 -2 4\n-2 2 4\n2 2 4\n2 -2 4\n-4 -2 2\n0 -2 2\n0 2 2\n-4 2 2\n0 -2 "
                                 "2\n4 -2 2\n4 2 2\n0 2 2\n4 0 1 2 3\n4 4 5 6 7\n4 8 9 10 11\n");
  const std::vector<std::string> source{"--from", "-1,-1,0 1,-1,0 1,1,0 -1,1,0"};
  std::vector<std::string> arguments{scene};
  arguments.insert(arguments.end(), source.begin(), source.end());
  EXPECT_EQ(weak(arguments)["result"]["hidden"], Json({0, 1, 2}));  // the two are seen from behind
  arguments.insert(arguments.end(), {"--cells", "1"});
  EXPECT_EQ(weak(arguments)["result"]["by_events"], Json::array({0}));
  arguments.insert(arguments.end(), {"--event-edges", "0"});
  EXPECT_EQ(weak(arguments, undecided)["result"]["undecided"], Json::array({0}));
}

TEST_F(Weak, from_a_volume_sees_all_around_and_what_reaches_into_it) {
  const std::string rooms = (corpus / "general" / "two_rooms.off").string(), to = path("volume.json").string();
  // A cube of 1 in the first room sees no less than each of its sides.
  const std::string box = file("box.off",
                               "OFF\n8 6 0\n1 1 1\n2 1 1\n2 2 1\n1 2 1\n1 1 2\n2 1 2\n2 2 2\n1 2 2\n4 3 2 1 0\n4 4 5 6 "
                               "7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  const Json seen = weak({rooms, "--from-volume", box, "--certificate", to})["result"];
  const Json top = weak({rooms, "--from", "1,1,2 2,1,2 2,2,2 1,2,2"})["result"];
  for (const Json& face : top["visible"])
    EXPECT_NE(std::find(seen["visible"].begin(), seen["visible"].end(), face), seen["visible"].end()) << face;
  EXPECT_GT(seen["visible"].size(), top["visible"].size());
  EXPECT_EQ(run({"verify", rooms, to}).code, done);
  // A sheet through the cube, and one in it; from outside, in a corner that sees neither, nothing hides them.
  const std::string sheets = file("sheets.off",
                                  "OFF\n8 2 0\n1.25 1.25 1.5\n1.75 1.25 1.5\n1.75 1.75 1.5\n1.25 1.75 1.5\n1.25 1.25 "
                                  "3\n1.75 1.25 3\n1.75 1.75 3\n1.25 1.75 3\n4 0 1 2 3\n4 4 5 6 7\n");
  const Json within = weak({sheets, "--from-volume", box})["result"];
  EXPECT_EQ(within["within"], Json::array({0}));
  EXPECT_EQ(within["visible"], Json::array({0}));  // the other one looks up, away from it
  EXPECT_EQ(within["unproved"], Json::array({0}));
  // The sides of a cube of the scene see nothing of it: it is convex. Of two, each sees the other.
  EXPECT_EQ(weak({cube, "--from-faces", "0,1,2,3,4,5"})["result"]["visible"].size(), 0u);
}

TEST_F(Weak, conservatively_hides_only_what_lines_hide_and_proves_it) {
  const std::string rooms = (corpus / "general" / "two_rooms.off").string(),
                    lamp = "1,1,29/10 1,2,29/10 2,2,29/10 2,1,29/10", to = path("quick.json").string();
  const Json lines = weak({rooms, "--from", lamp})["result"],
             quick = weak({rooms, "--from", lamp, "--conservative", "--certificate", to})["result"];
  EXPECT_GT(quick["hidden"].size(), 0u);
  for (const Json& face : quick["hidden"])
    EXPECT_NE(std::find(lines["hidden"].begin(), lines["hidden"].end(), face), lines["hidden"].end()) << face;
  EXPECT_EQ(quick["unproved"], quick["visible"]);
  EXPECT_EQ(run({"verify", rooms, to}).code, done);
  EXPECT_NE(run({"weak", rooms, "--from", lamp, "--conservative"}).out.find("compare SCENE weak"),
            std::string::npos);  // where to learn how many it has too many
  // It is said in one way, and not together with another answer.
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--method", "conservative"},
                                                {"--conservative", "--method", "lines"},
                                                {"--conservative=lines"}}) {
    std::vector<std::string> arguments{"weak", rooms, "--from", lamp};
    arguments.insert(arguments.end(), words.begin(), words.end());
    EXPECT_EQ(run(arguments).code, usage) << words[0];
  }
}

TEST_F(Weak, by_doubles_answers_without_proofs) {
  const Json doubles = weak({cube, "--from", "-1,-1,3 -1,2,3 2,2,3 2,-1,3", "--method", "doubles"})["result"];
  EXPECT_EQ(doubles["visible"].size(), 5u);
  EXPECT_EQ(doubles["unproved"].size(), 6u);
  EXPECT_EQ(
      run({"weak", cube, "--from-face", "0", "--method", "doubles", "--certificate", path("no.json").string()}).code,
      usage);
}

/// Three plates whose edges meet one line, and a fourth that is tangent to what they leave: lines alone do not decide
/// it.
static const char* const tangent =
    "OFF\n20 5 0\n-1 1 1\n1 1 1\n1 -1 1\n-1 -1 1\n"  // the target looks down
    "-2 -1/2 1/4\n2 1/2 1/4\n2 -11/2 1/4\n-2 -13/2 1/4\n"
    "-2 -1 1/2\n2 1 1/2\n2 7 1/2\n-2 5 1/2\n"
    "-2 -3/2 3/4\n2 3/2 3/4\n2 -9/2 3/4\n-2 -15/2 3/4\n"
    "-2 -7/4 223/256\n2 7/4 225/256\n2 31/4 225/256\n-2 17/4 223/256\n"
    "4 0 1 2 3\n4 4 5 6 7\n4 8 9 10 11\n4 12 13 14 15\n4 16 17 18 19\n";

TEST_F(Weak, hands_what_lines_leave_open_to_events_and_says_what_else_is_open) {
  const std::string scene = file("tangent.qoff", tangent), to = path("tangent.json").string();
  const std::vector<std::string> words{scene, "--from", "-1,-1,0 1,-1,0 1,1,0 -1,1,0", "--cells", "5"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return more;
  };
  const Json by_lines = weak(with({"--event-edges", "0", "--certificate", to}), undecided)["result"];
  ASSERT_EQ(by_lines["undecided"], Json::array({0}));
  EXPECT_EQ(run({"verify", scene, to}).code, done);
  ASSERT_EQ(by_lines["open"].size(), 1u);
  const Json& open = by_lines["open"][0];
  EXPECT_EQ(open["face"], 0);
  EXPECT_EQ(open["source"], 0);
  EXPECT_GT(open["open_cells"], 0);
  ASSERT_GT(open["cells"].size(), 0u);
  EXPECT_LE(open["cells"].size(), 4u);
  for (const Json& cell : open["cells"]) {
    EXPECT_GE(cell["source"].size(), 3u);
    EXPECT_GE(cell["target"].size(), 3u);
    for (const Json& side : cell["sides"]) {
      EXPECT_LT(side["face"], 5);
      EXPECT_EQ(side["piece"], 0);
      EXPECT_LT(side["corner"], 4);
      EXPECT_TRUE(side["side"] == 1 || side["side"] == -1);
    }
  }
  const Json both = weak(with({"--certificate", to}))["result"];
  EXPECT_EQ(both["undecided"].size(), 0u);
  EXPECT_EQ(both["open"].size(), 0u);
  EXPECT_EQ(both["by_events"], Json::array({0}));
  EXPECT_EQ(both["hidden"], weak({scene, "--from", words[2], "--method", "events"})["result"]["hidden"]);
  EXPECT_EQ(both["unproved"], Json::array({0}));  // as certificates do
  EXPECT_NE(run({"weak", scene, "--from", words[2], "--cells", "5"}).out.find("unproved"), std::string::npos);
  // With more cells lines decide and prove it all, in a second search.
  const Json proved = weak({scene, "--from", words[2], "--cells", "300", "--certificate", to})["result"];
  EXPECT_EQ(proved["hidden"], both["hidden"]);
  EXPECT_EQ(proved["unproved"].size() + proved["by_events"].size(), 0u);
  const Outcome checked = run({"verify", scene, to, "--json", "-"});
  EXPECT_EQ(checked.code, done) << checked;
  EXPECT_NE(checked.json()["result"]["why"].get<std::string>().find(" 0 undecided"), std::string::npos) << checked;
}

TEST_F(Weak, writes_the_surfaces_of_events_exactly_or_as_strips) {
  const std::string json = path("surfaces.json").string(), obj = path("surfaces.obj").string();
  const std::vector<std::string> words{"weak",     cube,     "--from",    "-1,-1,3 -1,2,3 2,2,3 2,-1,3",
                                       "--method", "events", "--surfaces"};
  const auto with = [&](const std::string& to) {
    std::vector<std::string> all = words;
    all.push_back(to);
    return all;
  };
  EXPECT_EQ(run(with(json)).code, done);
  const Json d = Json::parse(read_file(json));
  EXPECT_EQ(d["format"], "sightline event surfaces 1");
  ASSERT_GT(d["surfaces"].size(), 0u);
  std::size_t rulings = 0;
  for (const Json& surface : d["surfaces"]) {
    EXPECT_TRUE(surface["kind"] == "horizon" || surface["kind"] == "edge and vertex" || surface["kind"] == "triple")
        << surface;
    EXPECT_LT(surface["face"], 6);
    EXPECT_GE(surface["rulings"].size(), 2u);
    rulings += surface["rulings"].size();
    for (const Json& ruling : surface["rulings"]) EXPECT_EQ(ruling[0][2], "3");  // the source's plane
  }
  EXPECT_EQ(run(with(obj)).code, done);
  const std::string strips = read_file(obj);
  const auto lines = [&](const std::string& begin) {
    std::size_t count = strips.starts_with(begin);
    for (std::size_t at = strips.find("\n" + begin); at != std::string::npos; at = strips.find("\n" + begin, at + 1))
      ++count;
    return count;
  };
  EXPECT_EQ(lines("v "), 2 * rulings);
  EXPECT_EQ(lines("f "), rulings - d["surfaces"].size());
  EXPECT_EQ(run({"info", obj}).code, done);
  for (const std::string& to : {path("surfaces.txt").string(), std::string("x")}) EXPECT_EQ(run(with(to)).code, usage);
  EXPECT_EQ(run({"weak", cube, "--from-face", "0", "--surfaces", json}).code, usage);
}

TEST_F(Weak, refuses_volumes_that_are_none) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& why, int code = usage) {
    std::vector<std::string> all{"weak", cube};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome r = run(all);
    EXPECT_EQ(r.code, code) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find(why), std::string::npos) << r;
  };
  refused({"--from-faces", "0,1,2,3,4"}, "do not close up");
  refused({"--from-faces", "0,1,77"}, "no such face");
  refused({"--from-volume", file("open.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")},
          "open.off: the faces of a volume do not close up", bad_input);
  refused({"--from-volume", path("nothing.off").string()}, "nothing.off", bad_input);
  refused({"--from-volume", ""}, "--from-volume");
}

TEST_F(Weak, shows_a_bar_of_its_own_while_doubles_are_asked_for_a_page) {
  const std::string soup = path("soup.off").string(), page = path("page.html").string();
  ASSERT_EQ(run({"generate", "soup", "--size", sanitized ? "1500" : "2000", "--out", soup}).code, done);
  std::vector<std::string> words{executable,  "weak", soup,     "--two-sided",
                                 "--threads", "1",    "--from", "-2,-2,-2 3,-2,-2 3,3,-2 -2,3,-2"};
  EXPECT_EQ(on_a_terminal(words).find("doubles"), std::string::npos) << "there is no page";
  words.insert(words.end(), {"--html", page});
  const std::string told = on_a_terminal(words);
  const std::size_t first = told.find("searching ["), second = told.find("what doubles make of it [");
  EXPECT_LT(first, second) << told;
  EXPECT_NE(second, std::string::npos) << told;
}

}  // namespace program
