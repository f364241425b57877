#pragma once
// Damage to inputs: of bytes, of the words and lines of text, and of the values of JSON. The same seed gives the same
// damage.

#include <nlohmann/json.hpp>

#include <algorithm>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace fuzz {

class Mutator {
 public:
  using Json = nlohmann::json;

  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }

  std::string random_bytes(std::size_t most) {
    std::string bytes(below(most + 1), '\0');
    for (char& c : bytes) c = static_cast<char>(random_());
    return bytes;
  }

  /// Some damage, at one to four places.
  std::string damaged(std::string text) {
    for (std::size_t k = 1 + below(4); k > 0; --k) {
      switch (below(8)) {
        case 0: flip(text); break;
        case 1: text.insert(below(text.size() + 1), 1, static_cast<char>(random_())); break;
        case 2: text.erase(below(text.size() + 1), 1 + below(8)); break;
        case 3: move_lines(text); break;
        case 4: text.erase(below(text.size() + 1), below(4) == 0 ? std::string::npos : below(200)); break;
        default: exchange_word(text); break;
      }
    }
    return text;
  }

  /// Some damage to a JSON value, at one to three places, that leaves it JSON.
  Json damaged(Json value) {
    for (std::size_t k = 1 + below(3); k > 0; --k) {
      const Json other = somewhere(value);  // a copy: it may be a part of what is changed
      damage(somewhere(value), other);
    }
    return value;
  }

 private:
  void flip(std::string& text) {
    if (!text.empty()) text[below(text.size())] ^= static_cast<char>(1 << below(8));
  }

  /// Exchanges, repeats or removes lines.
  void move_lines(std::string& text) {
    std::vector<std::string> lines(1);
    for (const char c : text) {
      lines.back() += c;
      if (c == '\n') lines.emplace_back();
    }
    const std::size_t i = below(lines.size()), j = below(lines.size());
    const std::string line = lines[j];
    switch (below(3)) {
      case 0: std::swap(lines[i], lines[j]); break;
      case 1: lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(i), line); break;
      default: lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(i));
    }
    text.clear();
    for (const std::string& kept : lines) text += kept;
  }

  /// Puts another word of the text, or one that is odd, in the place of a word.
  void exchange_word(std::string& text) {
    static constexpr std::string_view blanks = " \t\r\n,:[]{}\"";
    static constexpr std::string_view odd[] = {"0",
                                               "-0",
                                               "-1",
                                               "1",
                                               "2",
                                               "4294967295",
                                               "4294967296",
                                               "9223372036854775807",
                                               "9223372036854775808",
                                               "1e400",
                                               "1e-400",
                                               "1e1100",
                                               "1e-1101",
                                               "0.1",
                                               "-.5",
                                               "1.",
                                               "1/3",
                                               "-7/0",
                                               "+3",
                                               "nan",
                                               "inf",
                                               "#",
                                               "\\",
                                               "\xEF\xBB\xBF",
                                               "1//2",
                                               "1/2/3",
                                               "9007199254740993",
                                               "1e99999999999999999999"};
    const auto word_at = [&](std::size_t place) {
      const std::size_t begin = text.find_first_not_of(blanks, place);
      if (begin == std::string::npos) return std::pair(text.size(), std::size_t{0});
      return std::pair(begin, std::min(text.find_first_of(blanks, begin), text.size()) - begin);
    };
    const auto [begin, size] = word_at(below(text.size() + 1));
    const auto [other, other_size] = word_at(below(text.size() + 1));
    const std::string word = below(2) == 0 ? text.substr(other, other_size) : std::string(odd[below(std::size(odd))]);
    text.replace(begin, size, word);
  }

  /// A value within another one, however many there are beside it: at each level one is as likely as the next.
  Json& somewhere(Json& value) {
    Json* at = &value;
    while (at->is_structured() && !at->empty() && (at == &value || below(4) != 0))
      at = &*std::next(at->begin(), static_cast<std::ptrdiff_t>(below(at->size())));
    return *at;
  }

  /// A value of another kind than is wanted, as likely as not.
  Json odd_value() {
    switch (below(10)) {
      case 0: return nullptr;
      case 1: return below(2) == 0;
      case 2: return -1;
      case 3: return 0.5;
      case 4: return std::uint64_t{1} << (31 + below(33));
      case 5: return "";
      case 6: return "a \"b\" \\c\x01";
      case 7: return Json::array();
      case 8: return Json::object();
      default: return Json::array({Json::array(), 1, "1"});
    }
  }

  void damage(Json& value, const Json& other) {
    if (below(6) == 0) value = odd_value();
    else if (value.is_boolean()) value = !value.get<bool>();
    else if (value.is_number()) value = below(3) == 0 && other.is_number() ? other : Json(below(12));
    else if (value.is_string()) value = exact_number(value.get<std::string>(), other);
    else if (value.is_array() && !value.empty()) damage_list(value, other);
    else if (value.is_object() && !value.empty() && below(8) == 0)
      value.erase(std::next(value.begin(), static_cast<std::ptrdiff_t>(below(value.size()))));
  }

  void damage_list(Json& list, const Json& other) {
    const std::size_t i = below(list.size()), j = below(list.size());
    const Json copy = list[j];
    switch (below(6)) {
      case 0: list.erase(i); break;
      case 1: list.insert(list.begin() + static_cast<std::ptrdiff_t>(i), copy); break;
      case 2: list[i] = copy; break;
      case 3: std::swap(list[i], list[j]); break;
      case 4: std::rotate(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(i), list.end()); break;
      default:
        if (other.is_array()) list = other;
        else std::reverse(list.begin(), list.end());
    }
  }

  Json exact_number(const std::string& text, const Json& other) {
    static constexpr std::string_view some[] = {"0",          "1",
                                                "-1",         "2",
                                                "3",          "4",
                                                "6",          "1/2",
                                                "-1/2",       "5/2",
                                                "7/3",        "1/1099511627776",
                                                "1000000007", "-1000000007/3"};
    switch (below(4)) {
      case 0: return other.is_string() ? other : Json(std::string(some[below(std::size(some))]));
      case 1: return text.starts_with('-') ? text.substr(1) : "-" + text;
      case 2:
        return text.find('/') == std::string::npos ? text + "/" + std::string(below(2) == 0 ? "2" : "3")
                                                   : text.substr(0, text.find('/'));
      default: return std::string(some[below(std::size(some))]);
    }
  }

  std::mt19937_64 random_;
};

}  // namespace fuzz
