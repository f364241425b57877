// The lists of planted faults, and of mutants that ./check plants, stay true to the sources: each text is found exactly
// once.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

namespace {

std::string content(const std::string& file) {
  std::ifstream in(std::string(SIGHTLINE_SOURCE_DIR) + "/" + file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Whether a text can stand alone in parentheses, as far as these tell.
bool is_balanced(const std::string& text) {
  std::string open;
  for (const char c : text) {
    if (c == '(' || c == '[' || c == '{') open += c == '(' ? ')' : c == '[' ? ']' : '}';
    if (c != ')' && c != ']' && c != '}') continue;
    if (open.empty() || open.back() != c) return false;
    open.pop_back();
  }
  return open.empty();
}

class Faults : public testing::TestWithParam<const char*> {};

TEST_P(Faults, each_text_is_found_exactly_once) {
  const auto faults = nlohmann::json::parse(content(std::string("tests/faults/") + GetParam() + ".json"));
  EXPECT_GE(faults.size(), 50u);
  std::set<std::string> names;
  std::map<std::string, std::string> files;
  for (const auto& fault : faults) {
    const std::string name = fault.at("name"), file = fault.at("file"), expression = fault.at("expression"),
                      faulty = fault.at("faulty");
    EXPECT_TRUE(names.insert(name).second) << name << " comes twice";
    EXPECT_NE(expression, faulty) << name;
    EXPECT_TRUE(is_balanced(expression) && is_balanced(faulty)) << name << ": no expression";
    EXPECT_FALSE(fault.at("what").get<std::string>().empty()) << name;
    EXPECT_FALSE(fault.at("hunt").empty()) << name << ": nothing is to find it";
    const std::string text = fault.value("before", "") + expression + fault.value("after", "");
    std::string& source = files.try_emplace(file, content(file)).first->second;
    const std::size_t at = source.find(text);
    ASSERT_NE(at, std::string::npos) << name << ": not found in " << file;
    EXPECT_EQ(source.find(text, at + 1), std::string::npos) << name << ": found again in " << file;
    source.replace(at, text.size(), std::string(text.size(), ' '));  // as the build does, which cannot replace it twice
  }
}

INSTANTIATE_TEST_SUITE_P(, Faults, testing::Values("faults", "sample"),
                         [](const auto& list) { return std::string(list.param); });

}  // namespace
