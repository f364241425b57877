#pragma once
// Documents held to JSON Schemas.

#include "program.h"

#include <algorithm>
#include <map>
#include <regex>
#include <string>

namespace program {

/// What is wrong with a value; empty: nothing. Knows the words that our schemas use, and asks more than they do: that
/// objects with properties have no others.
inline std::string flaw(const Json& value, const Json& schema, const Json& root, const std::string& at) {
  static const std::map<std::string, bool (*)(const Json&)> types{
      {"object", [](const Json& v) { return v.is_object(); }},
      {"array", [](const Json& v) { return v.is_array(); }},
      {"string", [](const Json& v) { return v.is_string(); }},
      {"integer", [](const Json& v) { return v.is_number_integer(); }},
      {"number", [](const Json& v) { return v.is_number(); }},
      {"boolean", [](const Json& v) { return v.is_boolean(); }},
      {"null", [](const Json& v) { return v.is_null(); }}};
  for (const auto& [word, what] : schema.items()) {
    if (word == "$ref") {
      const std::string name = what.get<std::string>().substr(std::string("#/$defs/").size());
      if (const std::string wrong = flaw(value, root.at("$defs").at(name), root, at); !wrong.empty()) return wrong;
    } else if (word == "type") {
      if (!types.at(what)(value)) return at + " is no " + what.get<std::string>() + ": " + value.dump().substr(0, 80);
    } else if (word == "const") {
      if (value != what) return at + " is not " + what.dump();
    } else if (word == "enum") {
      if (std::find(what.begin(), what.end(), value) == what.end()) return at + " is none of " + what.dump();
    } else if (word == "pattern") {
      static std::map<std::string, std::regex> patterns;  // to make one takes far longer than to search for it
      const std::regex& wanted = patterns.try_emplace(what, what.get<std::string>()).first->second;
      if (!std::regex_search(value.get<std::string>(), wanted)) return at + " is not exact";
    } else if (word == "minimum") {
      if (value < what) return at + " is less than " + what.dump();
    } else if (word == "minItems" || word == "maxItems") {
      if (word == "minItems" ? value.size() < what : value.size() > what) return at + " has another length";
    } else if (word == "items") {
      for (std::size_t i = 0; i < value.size(); ++i)
        if (const std::string wrong = flaw(value[i], what, root, at + '[' + std::to_string(i) + ']'); !wrong.empty())
          return wrong;
    } else if (word == "required") {
      for (const std::string key : what)
        if (!value.contains(key)) return at + " has no " + key;
    } else if (word == "properties") {
      for (const auto& [key, member] : value.items()) {
        if (!what.contains(key)) return at + " has a key that the schema does not name: " + key;
        if (const std::string wrong = flaw(member, what[key], root, at + '.' + key); !wrong.empty()) return wrong;
      }
    } else if (word == "additionalProperties") {
      for (const auto& [key, member] : value.items())
        if (const std::string wrong = flaw(member, what, root, at + '.' + key); !wrong.empty()) return wrong;
    } else if (word == "not") {
      if (flaw(value, what, root, at).empty()) return at + " is what it must not be: " + what.dump();
    } else if (word == "anyOf") {
      if (std::none_of(what.begin(), what.end(), [&](const Json& one) { return flaw(value, one, root, at).empty(); }))
        return at + " is nothing of what it may be";
    } else if (word != "description" && word != "$schema" && word != "$defs" && word != "title") {
      return "the schema has the word " + word + ", which this test does not know";
    }
  }
  return "";
}

}  // namespace program
