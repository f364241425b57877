// Which mutants tests/faults/mutate derives: of a made-up source each operator, condition, constant of a bound and
// early return, and nothing of comments, strings, templates, declarations of operators and what the compiler evaluates.

#include "../sample.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

const std::string made_up = R"--(#include <a < b>  // a < b
#define LESS(a, b) ((a) < (b))
/* a < b && c
   - d */
template <class T, int N = 2 + 3>
  requires(N < 4 && sizeof(T) > 1)
struct Row : Base<T, N - 1> {
  static_assert(N + 1 < 9);
  static constexpr int size = 3 * N + 1;
  bool operator<(const Row& other) const;
  Row& operator+=(Row&& other);
  std::array<std::vector<T>, N + 1> rows;
};

int sum(const std::vector<int>& all, int* last) {
  const char* text = "a < b";
  const std::string raw = R"(a && b)";
  if constexpr (sizeof(int) < 8) text = nullptr;
  if (const int* p = last) return *p;
  ++last;
  int x = -1;
  if (all.size() < 3) return x;
  for (const int one : all) {
    if (one == x) {
      return one - x - 1;
    }
  }
  x += last ? 1 : -1;
  return x + static_cast<std::pair<int, int>>(all[0]).first * 2 ? 1 : 0;
}

bool is_far(double d, bool a, bool b) { return d > 0x1p-50 * 1.5 || a && b; }
)--";

struct Folder {
  std::filesystem::path path = std::filesystem::path(testing::TempDir()) / ("mutants_" + std::to_string(getpid()));
  explicit Folder(const std::string& source) {
    std::filesystem::create_directories(path / "kernel");
    std::ofstream(path / "kernel/row.cpp") << source;
  }
  ~Folder() { std::filesystem::remove_all(path); }
};

// What `mutate list` prints of a source: for each mutant its id, and the rest of its line without the file's name.
std::vector<std::pair<std::string, std::string>> listed(const std::string& source, const std::string& options = "") {
  const Folder folder(source);
  const std::string command =
      "python3 " SIGHTLINE_SOURCE_DIR "/tests/faults/mutate list --root " + folder.path.string() + options;
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::string text;
  for (int c; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  EXPECT_EQ(pclose(pipe), 0);
  std::vector<std::pair<std::string, std::string>> result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find(".cpp:");
    result.emplace_back(line.substr(0, line.find(' ')), line.substr(at + 5));
  }
  return result;
}

/// Whether the tool can be asked: of sanitized libraries it knows nothing.
bool can_be_asked() { return !test_scenes::is_sanitized() && std::system("python3 -c '' 2>/dev/null") == 0; }

constexpr const char* not_asked = "no python3 here, or a run under sanitizers, of which it knows nothing";

TEST(Mutants, are_derived_from_what_runs_and_from_nothing_else) {
  if (!can_be_asked()) GTEST_SKIP() << not_asked;
  std::multiset<std::string> found;
  for (const auto& [id, row] : listed(made_up)) found.insert(row);
  const std::multiset<std::string> expected = {
      "22  condition is true: all.size() < 3  ->  true",
      "22  condition is false: all.size() < 3  ->  false",
      "22  < to <=: all.size() < 3  ->  all.size() <= 3",
      "22  < to >=: all.size() < 3  ->  all.size() >= 3",
      "24  condition is true: one == x  ->  true",
      "24  condition is false: one == x  ->  false",
      "24  == to !=: one == x  ->  one != x",
      "25  return removed: return one - x - 1;",
      "25  - to +: one - x  ->  (one + x)",
      "25  - to +: one - x - 1  ->  (one - x + 1)",
      "28  += to -=: x += last ? 1 : -1  ->  x -= last ? 1 : -1",
      "28  condition is true: last  ->  true",
      "28  condition is false: last  ->  false",
      "29  condition is true: x + static_cast<std::pair<int, int>>(all[0]).first * 2  ->  true",
      "29  condition is false: x + static_cast<std::pair<int, int>>(all[0]).first * 2  ->  false",
      "29  + to -: x + static_cast<std::pair<int, int>>(all[0]).first * 2  ->  "
      "(x - static_cast<std::pair<int, int>>(all[0]).first * 2)",
      "32  > to >=: d > 0x1p-50 * 1.5  ->  d >= 0x1p-50 * 1.5",
      "32  > to <=: d > 0x1p-50 * 1.5  ->  d <= 0x1p-50 * 1.5",
      "32  constant x 0.5: 0x1p-50  ->  0.5 * 0x1p-50",
      "32  constant x 2: 0x1p-50  ->  2 * 0x1p-50",
      "32  constant x 0.5: 1.5  ->  0.5 * 1.5",
      "32  constant x 2: 1.5  ->  2 * 1.5",
      "32  || to &&: d > 0x1p-50 * 1.5 || a && b  ->  (d > 0x1p-50 * 1.5) && (a && b)",
      "32  right of || dropped: d > 0x1p-50 * 1.5 || a && b  ->  static_cast<bool>(d > 0x1p-50 * 1.5)",
      "32  left of || dropped: d > 0x1p-50 * 1.5 || a && b  ->  static_cast<bool>(a && b)",
      "32  && to ||: a && b  ->  (a) || (b)",
      "32  right of && dropped: a && b  ->  static_cast<bool>(a)",
      "32  left of && dropped: a && b  ->  static_cast<bool>(b)",
  };
  EXPECT_EQ(found, expected);
}

TEST(Mutants, keep_their_ids_where_the_file_changes_elsewhere) {
  if (!can_be_asked()) GTEST_SKIP() << not_asked;
  const auto before = listed(made_up);
  std::string moved = "int twice(int x) {\n  return x + x;\n}\n" + made_up;
  moved.replace(moved.find("all.size() < 3"), 14, "all.size() < 4");
  const auto after = listed(moved);
  std::set<std::string> ids, ids_before;
  for (const auto& [id, row] : after) EXPECT_TRUE(ids.insert(id).second) << row;
  for (const auto& [id, row] : before) {
    EXPECT_TRUE(ids_before.insert(id).second) << row;
    EXPECT_EQ(ids.count(id), row.find("all.size") == std::string::npos ? 1u : 0u) << row;
  }
}

TEST(Mutants, are_chosen_by_their_ids) {
  if (!can_be_asked()) GTEST_SKIP() << not_asked;
  const auto all = listed(made_up);
  const auto two = listed(made_up, " --ids " + all[7].first + "," + all[2].first);
  EXPECT_EQ(two, (std::vector{all[2], all[7]}));
}

// By clang a unit calls its own functions, whatever stands before the library: what calls a mutant is compiled with it.
TEST(Mutants, are_compiled_with_the_rest_of_their_unit) {
  if (!can_be_asked()) GTEST_SKIP() << not_asked;
  const Folder folder(made_up);
  const std::string path = folder.path.string();
  for (const int k : {0, 1}) {
    std::ofstream unit(folder.path / ("unity_" + std::to_string(k) + "_cxx.cxx"));
    for (const std::string file : {k == 0 ? "kernel/row.cpp" : "io/text.cpp", k == 0 ? "io/rows.cpp" : "io/words.cpp"})
      unit << "#include \"" << path << "/" << file << "\"\n";
  }
  const std::string script = folder.path / "script.py";
  std::ofstream(script)
      << "import importlib.machinery, importlib.util, sys\n"
         "sys.dont_write_bytecode = True\n"
         "loader = importlib.machinery.SourceFileLoader('mutate', '" SIGHTLINE_SOURCE_DIR
         "/tests/faults/mutate')\n"
         "mutate = importlib.util.module_from_spec(importlib.util.spec_from_loader('mutate', loader))\n"
         "loader.exec_module(mutate)\n"
         "root = '"
      << path
      << "'\n"
         "units = [{'directory': root, 'file': f'unity_{k}_cxx.cxx'} for k in (0, 1)]\n"
         "sys.exit(mutate.together_with({'kernel/row.cpp': ''}, units, root) != {'io/rows.cpp'})\n";
  EXPECT_EQ(std::system(("python3 " + script).c_str()), 0);
}

}  // namespace
