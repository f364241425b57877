// Every capability has a page, every page an example, and every example is compiled: its text is that of a test.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
const fs::path root = SIGHTLINE_SOURCE_DIR;

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The C++ blocks of a page, without their includes.
std::vector<std::string> examples_of(const std::string& page) {
  std::vector<std::string> found;
  const std::string begin = "```cpp\n", end = "\n```\n";
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1)) {
    std::string block = page.substr(at + begin.size(), page.find(end, at) - at - begin.size());
    while (block.starts_with("#include") || block.starts_with("\n")) block.erase(0, block.find('\n') + 1);
    found.push_back(std::move(block));
  }
  return found;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> found{root / "README.md", root / "kernel" / "README.md", root / "io" / "README.md",
                              root / "sightline" / "README.md"};
  for (const char* layer : {"algorithms", "harness"})
    for (const auto& entry : fs::directory_iterator(root / layer))
      if (entry.is_directory()) found.push_back(entry.path() / "README.md");
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Pages, have_examples_that_are_compiled_and_run_by_tests) {
  std::string tests;
  for (const auto& entry : fs::recursive_directory_iterator(root / "tests"))
    if (entry.path().extension() == ".cpp") tests += read(entry.path());
  for (const fs::path& page : pages()) {
    const std::vector<std::string> examples = examples_of(read(page));
    EXPECT_FALSE(examples.empty()) << page << " has no example";
    for (const std::string& example : examples)
      EXPECT_NE(tests.find(example), std::string::npos) << page << ": no test holds this example:\n" << example;
  }
}

/// The lines of a page that are not in a block of code.
std::vector<std::string> prose_of(const fs::path& page) {
  std::vector<std::string> lines;
  std::istringstream text(read(page));
  bool is_code = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) is_code = !is_code;
    lines.push_back(is_code ? "" : line);
  }
  return lines;
}

/// Cells of a table's line, none elsewhere.
std::size_t cells_of(const std::string& line) {
  return line.starts_with("|") ? static_cast<std::size_t>(std::count(line.begin(), line.end(), '|')) - 1 : 0;
}

TEST(Pages, have_tables_with_as_many_dashes_as_heads) {
  // Else it is no table, and shown as a paragraph.
  for (const fs::path& page : pages()) {
    const std::vector<std::string> lines = prose_of(page);
    for (std::size_t i = 1; i < lines.size(); ++i)
      if (lines[i].starts_with("| --") && lines[i].find_first_not_of("|-: ") == std::string::npos)
        EXPECT_EQ(cells_of(lines[i]), cells_of(lines[i - 1])) << page << ": " << lines[i - 1];
  }
}

TEST(Pages, name_headers_and_pictures_that_are_there) {
  for (const fs::path& page : pages()) {
    const std::string text = read(page);
    for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
      const std::string link = text.substr(at + 2, text.find_first_of(")#", at) - at - 2);
      if (link.find(' ') == std::string::npos) {  // else it is a lambda expression
        EXPECT_TRUE(fs::exists(page.parent_path() / link)) << page << " links to " << link;
      }
    }
    for (std::size_t at = text.find("#include <sightline/"); at != std::string::npos;
         at = text.find("#include <sightline/", at + 1)) {
      const std::string header = text.substr(at + 20, text.find('>', at) - at - 20);
      EXPECT_TRUE(fs::is_regular_file(root / (header.find('/') == std::string::npos ? "sightline/" + header : header)))
          << page << " includes " << header;
    }
  }
}

}  // namespace
