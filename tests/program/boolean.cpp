// sightline boolean: results, certificates, what is refused.

#include "program.h"

namespace program {

class Boolean : public Program {
 protected:
  /// A box as OFF; `faces` of its six.
  std::string box(const std::string& name, const std::vector<int>& low, const std::vector<int>& high, int faces = 6) {
    std::string text = "OFF\n8 " + std::to_string(faces) + " 0\n";
    for (int k = 0; k < 8; ++k)
      text += std::to_string((k & 4) != 0 ? high[0] : low[0]) + " " + std::to_string((k & 2) != 0 ? high[1] : low[1]) +
              " " + std::to_string((k & 1) != 0 ? high[2] : low[2]) + "\n";
    const char* const all[] = {"0 1 3 2", "4 6 7 5", "0 4 5 1", "2 3 7 6", "0 2 6 4", "1 5 7 3"};
    for (int f = 0; f < faces; ++f) text += std::string("4 ") + all[f] + "\n";
    const fs::path file = path(name);
    std::ofstream(file) << text;
    return file.string();
  }
};

TEST_F(Boolean, writes_results_that_its_checker_accepts) {
  const std::string a = box("a.off", {0, 0, 0}, {3, 3, 3}), b = box("b.off", {1, 1, -1}, {2, 2, 4}),
                    c = box("c.off", {-1, 1, 1}, {4, 2, 2});
  const std::string out = path("left.qoff").string(), why = path("why.json").string();
  const Outcome r = run({"boolean", "difference", a, b, c, "--out", out, "--certificate", why, "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json result = r.json()["result"];
  EXPECT_EQ(result["operation"], "difference");
  EXPECT_EQ(result["volume"], "22");
  EXPECT_EQ(result["maximal_faces"], 20);
  EXPECT_EQ(result["provenance"].size(), result["faces"]);
  EXPECT_TRUE(result["not_manifold"].empty());
  EXPECT_EQ(run({"info", out, "--json", "-"}).json()["result"]["closed"], true);
  EXPECT_EQ(run({"verify", a, why, "--solid", b, c, "--result", out}).code, done);
  EXPECT_EQ(run({"verify", a, why, "--solid", c, b}).code, disagreement);
  EXPECT_EQ(run({"verify", a, why, "--solid", b, c, "--result", a}).code, disagreement);
  EXPECT_EQ(run({"verify", a, a, "--solid", b, c}).code, bad_input);
}

TEST_F(Boolean, refuses_what_bounds_no_solid_and_names_its_edges) {
  const std::string a = box("a.off", {0, 0, 0}, {3, 3, 3}), open = box("open.off", {1, 1, 1}, {2, 2, 2}, 5);
  const Outcome r = run({"boolean", "union", a, open});
  EXPECT_EQ(r.code, bad_input) << r;
  EXPECT_TRUE(r.one_line_of_error()) << r;
  EXPECT_NE(r.err.find("open.off"), std::string::npos) << r;
  EXPECT_NE(r.err.find("4 edges without an opposite"), std::string::npos) << r;
  EXPECT_EQ(run({"boolean", "union", a}).code, usage);
  EXPECT_EQ(run({"boolean", "unite", a, a}).code, usage);
  EXPECT_EQ(run({"boolean", "union", a, a, "--inside", "out"}).code, usage);
  EXPECT_EQ(run({"boolean", "union", a, path("none.off").string()}).code, bad_input);
}

}  // namespace program
