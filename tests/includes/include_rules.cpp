// The include rules, on the tree itself and on small trees that break them one at a time.

#include "include_rules.h"

#include <gtest/gtest.h>

#include <iostream>
#include <iterator>
#include <sstream>

#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using namespace include_rules;

std::vector<std::string> words(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

TEST(IncludeRules, the_tree_keeps_them) {
  const Rules rules{SIGHTLINE_SOURCE_DIR, words(SIGHTLINE_OUTSIDE_HEADERS)};
  ASSERT_FALSE(sources_in(rules.root, "kernel").empty()) << "looked in the wrong place: " << rules.root;
  ASSERT_FALSE(rules.outside.empty());
  for (const std::string& breach : breaches(rules)) ADD_FAILURE() << breach;
}

TEST(IncludeRules, the_tree_has_no_cycle) { EXPECT_EQ(cycle(SIGHTLINE_SOURCE_DIR), ""); }

// Examples are compiled with all of the standard library precompiled, as headers are (tests/headers).
TEST(IncludeRules, examples_of_pages_include_what_they_use) {
  const fs::path root = SIGHTLINE_SOURCE_DIR;
  std::vector<fs::path> pages{root / "README.md"};
  for (const char* layer : library_layers)
    for (const auto& entry : fs::recursive_directory_iterator(root / layer))
      if (entry.path().extension() == ".md") pages.push_back(entry.path());
  std::size_t examples = 0;
  Reached_headers reached(root);
  for (const fs::path& page : pages) {
    std::ifstream in(page);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    for (std::size_t begin = 0; (begin = text.find("```cpp\n", begin)) != std::string::npos; ++examples) {
      begin += 7;
      const std::string example = text.substr(begin, text.find("```", begin) - begin);
      std::istringstream once(example), again(example);
      for (const auto& [line, what] : missing_headers(again, reached.of(includes_of(once))))
        ADD_FAILURE() << page << ": example, line " << line << ": " << what;
    }
  }
  EXPECT_GT(examples, 20u);
}

// No failure: a header this long asks to be read again, and perhaps to be cut in two.
TEST(IncludeRules, long_files_are_named) {
  constexpr std::size_t many = 600;
  for (const char* layer : {"kernel", "algorithms", "io", "harness", "apps", "tests", "bench"})
    for (const std::string& file : sources_in(SIGHTLINE_SOURCE_DIR, layer)) {
      std::ifstream in(fs::path(SIGHTLINE_SOURCE_DIR) / file);
      const auto lines = static_cast<std::size_t>(std::count(std::istreambuf_iterator<char>(in), {}, '\n'));
      if (lines > many) std::cout << "[  LONG    ] " << file << ": " << lines << " lines\n";
    }
}

// A tree of four headers and a program that keeps every rule, in which a test then plants one breach.
class PlantedBreach : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::temp_directory_path() / ("sightline_includes_" + std::to_string(getpid()) + '_' + test->name());
    write("kernel/number.h", "#pragma once\n#include <vector>\n#include <gmpxx.h>\n");
    write("kernel/scene/scene.h", "#pragma once\n#include <sightline/kernel/number.h>\n");
    write("algorithms/order.h", "#pragma once\n#include <sightline/kernel/number.h>\n#include <CGAL/Gmpq.h>\n");
    write("algorithms/bsp/tree.h",
          "#pragma once\n#include <sightline/algorithms/order.h>\n// #include <sightline/io/obj.h>\n");
    write("io/obj.h", "#pragma once\n#include <sightline/kernel/scene/scene.h>\n");
    write("apps/command.h", "#pragma once\n#include <CLI/CLI.hpp>\n");
    write("apps/main.cpp",
          "#include \"command.h\"\n#include <sightline/io/obj.h>\n#include <sightline/algorithms/bsp/tree.h>\n");
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& file, const std::string& text) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  std::vector<std::string> found() const { return breaches({root_, {"CGAL/", "gmpxx.h"}}); }
  using Found = std::vector<std::string>;

  fs::path root_;
};

TEST_F(PlantedBreach, none) {
  EXPECT_EQ(found(), Found{});
  EXPECT_EQ(cycle(root_), "");
}

TEST_F(PlantedBreach, the_wrong_direction) {
  write("kernel/plane.h", "#pragma once\n#include <cmath>\n  #  include <sightline/io/obj.h>  // for reading\n");
  write("io/svg.h", "#pragma once\n#include <sightline/algorithms/order.h>\n");
  write("algorithms/draw.h", "#pragma once\n#include <sightline/io/obj.h>\n");
  write("algorithms/run.h", "#pragma once\n#include <sightline/apps/command.h>\n");
  EXPECT_EQ(found(), (Found{"algorithms/draw.h:2: algorithms must not include <sightline/io/obj.h>",
                            "algorithms/run.h:2: algorithms must not include <sightline/apps/command.h>",
                            "io/svg.h:2: io must not include <sightline/algorithms/order.h>",
                            "kernel/plane.h:3: kernel must not include <sightline/io/obj.h>"}));
}

TEST_F(PlantedBreach, the_wrong_room) {
  write("kernel/plane.h", "#pragma once\n#include <sightline/kernel/scene/scene.h>\n");
  write("kernel/scene/graph.h", "#pragma once\n#include <sightline/kernel/traits/exact.h>\n");
  write("kernel/traits/exact.h", "#pragma once\n#include <sightline/kernel/scene/scene.h>\n");
  write("algorithms/verify/check.h",
        "#pragma once\n#include <sightline/kernel/number.h>\n#include <sightline/kernel/scene/scene.h>\n");
  write("algorithms/run.h", "#pragma once\n#include <sightline/harness/fuzz.h>\n");
  write("harness/fuzz.h", "#pragma once\n#include <sightline/algorithms/order.h>\n#include <sightline/io/obj.h>\n");
  EXPECT_EQ(found(), (Found{"algorithms/run.h:2: algorithms must not include <sightline/harness/fuzz.h>",
                            "algorithms/verify/check.h:3: algorithms/verify must not include "
                            "<sightline/kernel/scene/scene.h>",
                            "kernel/plane.h:2: kernel must not include <sightline/kernel/scene/scene.h>",
                            "kernel/scene/graph.h:2: kernel/scene must not include "
                            "<sightline/kernel/traits/exact.h>"}));
}

TEST_F(PlantedBreach, one_method_of_weak_visibility_in_another) {
  const std::string room = "algorithms/weak_visibility/", line = "#pragma once\n#include <sightline/" + room;
  write(room + "weak_answer.h", line + "search/search.h>\n");
  write(room + "settle.h", line + "search/search.h>\n#include <sightline/" + room + "events/events.h>\n");
  write(room + "search/search.h", line + "settle.h>\n");
  write(room + "events/events.h", line + "weak_answer.h>\n#include <sightline/" + room + "search/search.h>\n");
  EXPECT_EQ(found(), (Found{"algorithms/weak_visibility/events/events.h:3: algorithms/weak_visibility/events must not "
                            "include <sightline/algorithms/weak_visibility/search/search.h>",
                            "algorithms/weak_visibility/search/search.h:2: algorithms/weak_visibility/search must not "
                            "include <sightline/algorithms/weak_visibility/settle.h>",
                            "algorithms/weak_visibility/weak_answer.h:2: algorithms/weak_visibility/weak_answer must "
                            "not include <sightline/algorithms/weak_visibility/search/search.h>"}));
}

TEST_F(PlantedBreach, quotes_in_the_library) {
  write("kernel/plane.h", "#pragma once\n#include \"number.h\"\n");
  EXPECT_EQ(found(), Found{"kernel/plane.h:2: own includes are spelled <sightline/...>: \"number.h\""});
}

TEST_F(PlantedBreach, a_header_that_is_not_there) {
  write("io/off.h", "#pragma once\n#include <sightline/kernel/scene.h>\n");
  write("apps/info.cpp", "#include \"commands.h\"\n");
  EXPECT_EQ(found(), (Found{"apps/info.cpp:1: no such neighbour: \"commands.h\"",
                            "io/off.h:2: no such header: <sightline/kernel/scene.h>"}));
}

TEST_F(PlantedBreach, no_guard) {
  write("kernel/plane.h", "// Planes.\n#pragma once\n");
  EXPECT_EQ(found(), Found{"kernel/plane.h:1: does not begin with #pragma once"});
}

TEST_F(PlantedBreach, a_source_that_does_not_begin_with_its_header) {
  write("kernel/number.cpp", "// Numbers.\n#include <sightline/kernel/number.h>\n\n#include <algorithm>\n");
  EXPECT_EQ(found(), Found{});
  write("kernel/number.cpp", "#include <algorithm>\n\n#include <sightline/kernel/number.h>\n");
  EXPECT_EQ(found(), Found{"kernel/number.cpp:1: does not begin with <sightline/kernel/number.h>"});
  write("kernel/plane.h", "#pragma once\n");
  write("kernel/number.cpp", "#include <sightline/kernel/plane.h>\n");
  EXPECT_EQ(found(), Found{"kernel/number.cpp:1: does not begin with <sightline/kernel/number.h>"});
  write("kernel/number.cpp", "#include <sightline/kernel/number.h>\n");
  write("kernel/digits.cpp", "#include <sightline/kernel/number.h>\n");  // the rest of number.h
  EXPECT_EQ(found(), Found{});
  write("kernel/digits.cpp", "#include <sightline/io/off.h>\n");
  EXPECT_FALSE(found().empty());
}

TEST_F(PlantedBreach, a_dependency_that_is_not_announced) {
  write("kernel/plane.h", "#pragma once\n#include <mpfr.h>\n#include <CGAL/Gmpq.h>\n#include <Eigen/Core>\n");
  EXPECT_EQ(found(), (Found{"kernel/plane.h:2: <mpfr.h> is not among the dependencies in CMakeLists.txt",
                            "kernel/plane.h:4: <Eigen/Core> is not among the dependencies in CMakeLists.txt"}));
}

TEST_F(PlantedBreach, a_standard_header_that_is_missing) {
  write("kernel/plane.h",
        "#pragma once\n#include <sightline/kernel/number.h>\n// std::array\nstd::vector<int> f();\n"
        "const char* g(std::string s = \"std::map\", std::vector<std::string> t);  // of <vector>\nint h(std::what);\n"
        "std::size_t n;\n");
  write("algorithms/order.h", "#pragma once\n#include <string>\n#include <sightline/kernel/plane.h>\nstd::string s;\n");
  EXPECT_EQ(found(), (Found{"kernel/plane.h:5: uses std::string without <string>",
                            "kernel/plane.h:6: std::what is not in tests/includes/standard_names.h",
                            "kernel/plane.h:7: uses std::size_t without <cstddef>"}));
}

TEST_F(PlantedBreach, a_cycle) {
  write("kernel/number.h", "#pragma once\n#include <sightline/kernel/scene/scene.h>\n");
  EXPECT_EQ(cycle(root_), "kernel/number.h -> kernel/scene/scene.h -> kernel/number.h");
}

}  // namespace
