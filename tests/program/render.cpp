// sightline render: every method on small scenes, colours and what lets light through, pictures that cannot be made.

#include "program.h"

#include <algorithm>
#include <map>
#include <set>

namespace program {

class Render : public Program {
 protected:
  const std::string cube = (corpus / "general" / "cube.off").string(),  // [0, 1]^3
      rooms = (corpus / "general" / "two_rooms.off").string();

  Json render(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"--size", "40x30", "--json", "-"});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, done) << r;
    return r.json();
  }
  /// Pixels of each face.
  static std::map<int, int> shown(const Json& made) {
    std::map<int, int> faces;
    for (const Json& entry : made["result"]["faces"]) faces[entry["face"]] = entry["pixels"];
    return faces;
  }
  /// Whether the program was built with Embree; without it, it says so.
  bool has_rays() {
    const Outcome rays = run({"render", cube, "--method", "rays", "--json", "-"});
    if (rays.code == usage) EXPECT_NE(rays.err.find("without Embree"), std::string::npos) << rays;
    return rays.code != usage;
  }
  /// What a picture that cannot be made says.
  std::string refusal(std::vector<std::string> arguments, int code) {
    const fs::path png = path("refused.png");
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"--png", png.string()});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, code) << r;
    EXPECT_FALSE(fs::exists(png)) << r;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r;
    return r.err;
  }
};

TEST_F(Render, shows_the_same_faces_of_a_cube_by_every_method) {
  const std::vector<std::string> view{cube, "--eye", "3,-4,5", "--look", "-5,9,-9", "--field", "40"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), view.begin(), view.end());
    return render(more);
  };
  const Json truth = with({"--method", "centres"});
  const std::map<int, int> faces = shown(truth);
  EXPECT_EQ(faces.size(), 3u);
  EXPECT_EQ(truth["counters"]["tied"], 0);
  for (const char* method : {"depth", "weighted", "weiler-atherton", "bsp2d", "graph"}) {
    const Json made = with({"--method", method});
    EXPECT_EQ(shown(made), faces) << method;
    EXPECT_EQ(made["counters"]["kernel"], made["counters"].contains("bits") ? "float" : "exact") << method;
  }
  for (const char* kernel : {"float", "double", "exact"})
    for (const char* method : {"newell", "scan-line", "warnock", "weiler-atherton", "bsp", "graph", "painter-min",
                               "painter-max", "painter-mean"})
      EXPECT_EQ(shown(with({"--method", method, "--kernel", kernel})), faces) << method << ", " << kernel;
  if (has_rays()) EXPECT_EQ(shown(with({"--method", "rays"})), faces);
}

TEST_F(Render, from_beyond_floats_and_doubles_is_a_picture) {
  std::vector<std::string> methods{"exact",     "centres", "depth",           "weighted", "painter-mean", "newell",
                                   "scan-line", "warnock", "weiler-atherton", "bsp2d",    "bsp",          "graph"};
  if (has_rays()) methods.push_back("rays");
  const std::string huge = (corpus / "robust" / "huge.off").string();
  for (const std::string& method : methods) {
    for (const char* eye : {"1e20,0,0", "1e400,0,0"}) {
      const Json made = render({cube, "--eye", eye, "--field", "60", "--method", method});
      if (method != "exact") EXPECT_TRUE(shown(made).empty()) << method << " from " << eye;
    }
    render({huge, "--method", method});
  }
  for (const char* kernel : {"float", "double"})
    for (const char* eye : {"1e20,0,0", "1e400,0,0"})
      for (const char* method : {"weiler-atherton", "graph", "bsp"})
        EXPECT_TRUE(
            shown(render({cube, "--eye", eye, "--field", "60", "--method", method, "--kernel", kernel})).empty())
            << method << ", " << kernel;
  EXPECT_FALSE(shown(render({huge, "--method", "centres"})).empty());
}

TEST_F(Render, writes_pictures_of_their_size) {
  for (const char* method : {"exact", "centres", "weighted"}) {
    const fs::path png = path("picture.png");
    const Outcome r =
        run({"render", rooms, "--method", method, "--size", "300x200", "--eye", "-3,-4,6", "--png", png.string()});
    EXPECT_EQ(r.code, done) << r;
    const std::string bytes = read_file(png);
    ASSERT_GT(bytes.size(), 24u);
    EXPECT_EQ(bytes.substr(1, 3), "PNG");
    const auto number = [&](std::size_t at) {
      return 256 * static_cast<unsigned char>(bytes[at]) + static_cast<unsigned char>(bytes[at + 1]);
    };
    EXPECT_EQ(number(18), 300);
    EXPECT_EQ(number(22), 200);
    fs::remove(png);
  }
}

TEST_F(Render, lets_light_through) {
  const std::string colours = file("colours.csv", "r,g,b,a\n255,0,0,0.5\n0,255,0\n0,0,255,1\n1,2,3\n4,5,6,0\n7,8,9\n");
  for (const char* method : {"exact", "centres", "scan-line", "bsp", "graph", "depth", "weighted", "painter-max"}) {
    const Json made = render({cube, "--eye", "3,-4,5", "--method", method, "--colours", colours});
    EXPECT_FALSE(made["result"].contains("faces")) << method;  // a pixel shows several
    if (method != std::string("exact")) EXPECT_GT(made["counters"]["drawn"], 0) << method;
  }
  const Outcome table =
      run({"compare", rooms, "render", "--eye", "-3,-4,6", "--alpha", "0.5", "--size", "64x48", "--json", "-"});
  EXPECT_EQ(table.code, done) << table;
  const Json json = table.json();
  EXPECT_EQ(json["result"]["transparent"], true);
  std::set<std::string> wrong, methods;
  for (const Json& row : json["result"]["rows"]) {
    const std::string method = row["method"];
    methods.insert(method);
    if (method == "exact") {  // means, not what is at centres
      EXPECT_FALSE(row["errors"].contains("wrong"));
      EXPECT_EQ(row["errors"]["compared"], 256);
      EXPECT_EQ(row["errors"]["off"], 0);
    } else if (row["kernel"] == "exact" || method == "depth" || method == "weighted") {
      if (row["errors"]["wrong"] > 0) wrong.insert(method);
    }
    EXPECT_NE(method, "warnock");
  }
  EXPECT_EQ(methods.count("exact"), 1u);
  EXPECT_TRUE(wrong.count("depth") == 1 && wrong.count("weighted") == 1);
  for (const char* method : {"centres", "scan-line", "bsp", "graph"}) EXPECT_EQ(wrong.count(method), 0u) << method;
}

TEST_F(Render, takes_colours_of_materials) {
  file("panes.mtl", "newmtl clear\nKd 0 0 1\nd 0.5\n");
  const std::string scene = file("panes.obj", "mtllib panes.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl clear\nf 1 2 3\n");
  const Json made = render({scene, "--eye", "0.2,0.2,3", "--method", "centres", "--colours", "materials"});
  EXPECT_FALSE(made["result"].contains("faces"));
  const std::string opaque = file("wall.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(shown(render({opaque, "--eye", "0.2,0.2,3", "--method", "centres", "--colours", "materials"})).size(), 1u);
  EXPECT_NE(refusal({cube, "--colours", "materials"}, usage).find(".obj"), std::string::npos);
}

TEST_F(Render, is_nothing_but_the_background_where_nothing_is_seen) {
  // In a face, on an edge, at a vertex: what the eye is in the plane of is not seen, all else is.
  const auto count = [&](const std::string& eye) {
    return shown(render({cube, "--eye", eye, "--look", "1,2,3", "--field", "100", "--method", "centres"})).size();
  };
  EXPECT_EQ(count("1/3,1/3,0"), 5u);
  EXPECT_GE(count("1/3,0,0"), 3u);
  EXPECT_EQ(count("0,0,0"), 3u);
  EXPECT_EQ(count("1,1,1"), 0u);
  const std::string empty = file("empty.off", "OFF\n0 0 0\n");
  EXPECT_EQ(shown(render({empty, "--eye", "0,0,0", "--look", "1,0,0", "--method", "centres"})).size(), 0u);
}

TEST_F(Render, of_wrong_arguments_says_what_to_do_and_leaves_no_file) {
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(says(refusal({cube, "--field", "0"}, usage), "--field"));
  EXPECT_TRUE(says(refusal({cube, "--size", "1000000x1000000"}, usage), "--size"));
  EXPECT_TRUE(says(refusal({cube, "--look", "0,0,0"}, usage), "--look"));
  for (const char* method : {"depth", "bsp2d"})
    EXPECT_TRUE(says(refusal({cube, "--method", method, "--kernel", "double"}, usage), "leave out --kernel"));
  EXPECT_TRUE(
      says(refusal({(corpus / "robust" / "huge.off").string(), "--method", "graph", "--kernel", "float"}, usage),
           "take exact"));
  EXPECT_TRUE(says(refusal({cube, "--method", "centres", "--samples", "4"}, usage), "--samples is for --method rays"));
  EXPECT_TRUE(says(refusal({cube, "--method", "newell", "--bits", "16"}, usage), "--bits is for --method depth"));
  EXPECT_TRUE(says(refusal({cube, "--method", "warnock", "--alpha", "0.5"}, usage), "shows only what is first"));
  EXPECT_TRUE(says(refusal({cube, "--alpha", "1.5"}, usage), "--alpha"));
  EXPECT_TRUE(says(refusal({cube, "--alpha", "nan"}, usage), "--alpha"));
  EXPECT_TRUE(says(refusal({cube, "--colours", file("few.csv", "1,2,3\n")}, bad_input), "1 colours for 6 faces"));
  EXPECT_TRUE(
      says(refusal({cube, "--colours", file("many.csv", "r,g,b\n1,2,3\n1,2,3\n1,2,3\n1,2,3\n1,2,3\n1,2,3\n1,2,3\n")},
                   bad_input),
           "7 colours for 6 faces"));
  EXPECT_TRUE(says(refusal({cube, "--colours", file("nan.csv", "1,2,3\n4,nan,5\n")}, bad_input), "nan.csv:2:"));
  EXPECT_TRUE(says(refusal({cube, "--colours", file("far.csv", "1,2,300\n")}, bad_input), "far.csv:1:"));
  EXPECT_TRUE(says(refusal({cube, "--colours", path("none.csv").string()}, bad_input), "none.csv"));
  const Outcome unwritable = run({"render", cube, "--png", (path("no") / "such" / "folder.png").string()});
  EXPECT_NE(unwritable.code, done) << unwritable;
  EXPECT_TRUE(says(unwritable.err, "folder.png")) << unwritable;
  EXPECT_TRUE(says(run({"render", cube}).err, "--png"));
}

}  // namespace program
