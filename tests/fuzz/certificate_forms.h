#pragma once
// Small certificates of which one part is written in each of its forms, right and wrong: which of these are taken is
// known.

#include "other_readers.h"
#include "support.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <list>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace fuzz {

struct Form {
  std::string_view text;
  bool is_right;
};

/// A certificate with a place for a part, and what that may be.
struct Formed_certificate {
  std::string_view before, after;
  std::vector<Form> forms;
};

inline const std::vector<Formed_certificate>& formed_certificates() {
  static constexpr std::string_view end =
      R"(,"fragments":[{"face":0,"piece":0,"vertices":[["0","0","0"],["1","0","0"],["0","1","0"]]}]})";
  static constexpr std::string_view end_with_points =
      R"(,"points":[["0","0","0"],["1","0","0"],["0","1","0"]],"fragments":[{"face":0,"piece":0,"vertices":[0,1,2]}]})";
  static constexpr std::string_view see = R"({"format":"sightline see 2","eye":["0","0","9"],"parts":[)";
  static const std::vector<Formed_certificate> all{
      {R"({"format":"sightline weak 3","sources":[[["0","0","5"],["0","1","5"],["1","0","5"]]],"lines":[[0,0]],)"
       R"("visible":[],"hidden":[{"fragment":0,"source":0,"proof":[["empty",[)",
       R"(]]]}])",
       {{R"([0,"1"])", true},
        {R"([0,"-2/3",{}])", true},
        {R"([0,"1",{"source":["0","0","1","0"]}])", true},
        {R"([0,"1",{"source":["0","0","1","0"],"target":["1","0","0","0"]}])", true},
        {R"([0])", false},
        {R"([0,"1",{},{}])", false},
        {R"([0,"1",5])", false},
        {R"([0,"1",["0"]])", false},
        {R"([0,"1",{"source":["0","0","1"]}])", false},
        {R"([1,"1"])", false},
        {R"("1")", false}}},
      {R"({"format":"sightline weak 4","sources":[[["0","0","5"],["0","1","5"],["1","0","5"]]],"lines":[],)"
       R"("visible":[],"hidden":[{"fragment":0,"source":0,"proof":[["away"]])",
       R"(}])",
       {{R"(,"target":[["0","0","0"],["1","0","0"],["0","1","0"]])", true},
        {R"(,"also":[0],"target":[])", true},
        {R"(,"target":[["0","0","0"],["1","0","0"],["0","1"]])", false},
        {R"(,"target":[["0","0","0"],["1","0","0"],[0,"1","0"]])", false},
        {R"(,"target":{"x":"0"})", false},
        {R"(,"target":"0")", false},
        {R"(,"target":[["0","0","0"],["1","0","0"],7])", false}}},
      {R"({"format":"sightline along 2","path":[["0","0","5"],["1","0","5"]],"faces":[],"proofs":[],"moments":[)",
       "]",
       {{R"({"root":"0"})", true},
        {R"({"quadratic":["1","0","-1/2"],"low":"1/2","high":"1"})", true},
        {R"({"root":"0","low":"0"})", false},
        {R"({"root":"0","quadratic":["1","0","0"]})", false},
        {R"({"low":"0","high":"1"})", false}}},
      {R"({"format":"sightline along 2","path":[["0","0","5"],["1","0","5"]],"moments":[{"root":"0"},{"root":"1"}],)"
       R"("faces":[],"proofs":[{"fragment":0,"moments":[0,1],"tree":[)",
       R"(]}])",
       {{R"(["blocked",0])", true},
        {R"(["blocked",0],["blocked",0])", true},
        {R"(["blocked",0,0])", false},
        {R"(["blocked"])", false},
        {R"(["blocked",1])", false},
        {R"([])", false},
        {R"(5)", false},
        {"", false}}},
      {see,
       R"(],"empty":[],"rays":[["0","0","-1"],["1","0","-1"],["0","1","-1"]])",
       {{R"({"fragment":0,"rays":[0,1,2]})", true},
        {R"({"fragment":0,"vertices":[["0","0","0"],["1","0","0"],["0","1","0"]],"ray":["0","0","-1"]})", true},
        {R"({"fragment":0,"rays":[0,1]})", false},
        {R"({"fragment":0,"rays":[0,1,3]})", false},
        {R"({"fragment":1,"rays":[0,1,2]})", false},
        {R"({"fragment":0,"rays":[0,1,2],"ray":["0","0","-1"]})", false},
        {R"({"fragment":0,"rays":[0,1,2],"vertices":[["0","0","0"],["1","0","0"],["0","1","0"]]})", false},
        {R"({"fragment":0,"fragment":0,"rays":[0,1,2]})", false}}},
      {R"({"format":"sightline see 2","eye":["0","0","9"],"parts":[],"empty":[],"field":)",
       "",
       {{R"([["0","0","-1"],["1","0","-1"],["0","1","-1"]])", true},
        {R"([["0","0","-1"],["1","0","-1"],0])", false},
        {R"(7)", false}}},
      {R"({"format":"sightline )",
       R"(","eye":["0","0","9"],"parts":[],"empty":[])",
       {{"see 1", true},
        {"see 2", true},
        {"see 3", false},
        {"see 0", false},
        {"see", false},
        {"see 21", false},
        {"order 2", true},
        {"order 3", false},
        {"weak 3", false}}},
      {R"({"format":"sightline see 2","eye":["0","0","9"],"parts":[],"empty":[],)",
       R"("proofs":[])",
       {{"", true},
        {R"("lines":[7],)", true},  // of another kind, whatever it says
        {R"("path":7,)", true},
        {R"("empty":[],)", false},
        {R"("parts":7,)", false},
        {R"("rays":7,)", false}}}};
  static const std::vector<Formed_certificate> by_points{
      {see,
       R"(],"empty":[])",
       {{R"({"fragment":0,"vertices":[0,1,2],"ray":["0","0","-1"]})", true},
        {R"({"fragment":0,"vertices":[2,1,0],"ray":["0","0","-1"]})", true},
        {R"({"fragment":0,"vertices":[0,1,3],"ray":["0","0","-1"]})", false},
        {R"({"fragment":0,"vertices":[0,1,-1],"ray":["0","0","-1"]})", false}}},
      {R"({"format":"sightline see 2","eye":["0","0","9"],"parts":[],"empty":[],"field":)",
       R"(,"rays":[["0","0","-1"],["1","0","-1"],["0","1","-1"]])",
       {{"[0,1,2]", true}, {"[0,1,3]", false}, {"[0,1,4294967296]", false}}},
      {R"({"format":"sightline see 2","eye":["0","0","9"],"parts":[],"empty":[)",
       R"(],"rays":[["0","0","-1"],["1","0","-1"],["0","1","-1"]])",
       {{"[0,1,2]", true}, {"[0,1,3]", false}, {"", true}}},
      {R"({"format":"sightline weak 3","lines":[],"visible":[],"hidden":[],"sources":[)",
       "]",
       {{"[0,1,2]", true}, {"[0,1,3]", false}}}};
  static const std::vector<Formed_certificate> whole = [] {
    std::vector<Formed_certificate> found;
    const auto add = [&](const std::vector<Formed_certificate>& from, std::string_view last) {
      for (const Formed_certificate& one : from)
        for (const Form& form : one.forms)
          found.push_back({one.before, last, {{form.text, form.is_right}, {one.after, true}}});
    };
    add(all, end);
    add(by_points, end_with_points);
    return found;
  }();
  return whole;
}

/// The same of set operations.
inline const std::vector<Formed_certificate>& formed_solid_certificates() {
  static constexpr std::string_view begin = R"({"format":"sightline boolean 1",)";
  static constexpr std::string_view head = R"("operation":"union","inside":"nonzero","operands":)";
  static constexpr std::string_view points = R"(,"points":[["0","0","0"],["1/2","0","0"],["0","1","0"])";
  static constexpr std::string_view end = R"(,"pieces":[],"set_aside":[]})";
  static const std::vector<Formed_certificate> all = [] {
    std::vector<Formed_certificate> found;
    const auto add = [&](const std::string& before, const std::string& after, const std::vector<Form>& forms) {
      static std::list<std::string> kept;  // what the views are of
      for (const Form& form : forms)
        found.push_back({kept.emplace_back(before), kept.emplace_back(after), {form, {"", true}}});
    };
    const std::string operands = std::string(begin) + std::string(head);
    const std::string top = operands + "2" + std::string(points);
    const std::string no_fragments = R"(],"fragments":[])" + std::string(end);
    add("{", "," + std::string(head) + "2" + std::string(points) + no_fragments,
        {{R"("format":"sightline boolean 1")", true},
         {R"("format":"sightline boolean 2")", false},
         {R"("format":"sightline boolean")", false},
         {R"("format":1)", false},
         {R"("format":"sightline boolean 1","operation":"union")", false},
         {R"("other":"sightline boolean 1")", false}});
    add(operands, std::string(points) + no_fragments,
        {{"2", true}, {"4294967295", true}, {"4294967296", false}, {"-1", false}, {"2.0", false}, {R"("2")", false}});
    add(top, no_fragments,
        {{"", true},
         {R"(,["1","2/3","-3"])", true},
         {R"(,["1","2"])", false},
         {R"(,["1","2","3","4"])", false},
         {R"(,["1","2","a"])", false},
         {R"(,"1")", false},
         {R"(,{"x":"1","y":"2","z":"3"})", false}});
    add(top + R"(],"fragments":[{"vertices":[0,1,2],"front":[],"fate":"kept","parts":[)", "]}]" + std::string(end),
        {{"[0,0,0,0]", true},
         {"[1,7,4294967295,1],[0,0,0,0]", true},
         {"[0,0,0,1]", true},
         {"[0,0,0,2]", false},
         {"", true},
         {"[0,0,0]", false},
         {"[0,0,0,0,0]", false},
         {"[0,0,4294967296,0]", false},
         {"[-1,0,0,0]", false},
         {"[0,0,0,true]", false},
         {"[]", false},
         {R"({"a":0,"b":0,"c":0,"d":0})", false},
         {"0", false}});
    add(top + R"(],"fragments":[{"vertices":[0,1,2],"parts":[],"fate":"dropped","front":[)", "]}]" + std::string(end),
        {{"[0,1]", true},
         {"[0,1],[1,-2147483647]", true},
         {"[0,2147483647]", true},
         {"[0,-2147483648]", false},
         {"[0,2147483648]", false},
         {"[0]", false},
         {"[0,1,2]", false},
         {"[-1,0]", false},
         {"[0,1.5]", false},
         {R"({"a":0,"b":1})", false},
         {"0", false}});
    add(top + R"(],"fragments":[{"parts":[],"front":[],"fate":"turned","vertices":[)", "]}]" + std::string(end),
        {{"0,1,2", true}, {"2,1,0,1", true}, {"0,1", false}, {"", false}, {"0,1,3", false}, {"0,1,-1", false}});
    add(top + R"(],"fragments":[{"parts":[],"front":[],"vertices":[0,1,2],"fate":)", "}]" + std::string(end),
        {{R"("dropped")", true},
         {R"("kept")", true},
         {R"("turned")", true},
         {R"("keep")", false},
         {R"("")", false},
         {"1", false}});
    add(top + R"(],"fragments":[],"set_aside":[],"pieces":[)", "]}",
        {{R"({"operand":0,"face":1,"piece":2,"vertices":[0,1,2]})", true},
         {R"({"operand":0,"face":1,"piece":2,"vertices":[0,1]})", false},
         {R"({"operand":0,"face":1,"vertices":[0,1,2]})", false},
         {R"({"operand":0,"face":-1,"piece":2,"vertices":[0,1,2]})", false},
         {"[0,1,2]", false}});
    add(top + R"(],"fragments":[],"pieces":[],"set_aside":[)", "]}",
        {{R"({"operand":0,"face":1,"why":"because"})", true},
         {R"({"operand":0,"face":1,"why":7})", false},
         {R"({"operand":0,"face":1})", false},
         {R"({"operand":4294967296,"face":1,"why":"because"})", false}});
    return found;
  }();
  return all;
}

/// A certificate in which one value, however deep, is nothing: where that is refused, it is told in which entry.
inline void require_named_entry(const std::string& text, Bytes& from) {
  nlohmann::json whole = nlohmann::json::parse(text, nullptr, false);
  if (!whole.is_object()) return;
  std::vector<std::string> lists;
  for (const auto& [key, value] : whole.items())
    if (value.is_array() && !value.empty()) lists.push_back(key);
  if (lists.empty()) return;
  const std::string& key = lists[from.below(lists.size())];
  const std::size_t number = from.below(whole[key].size());
  nlohmann::json* place = &whole[key][number];
  while (place->is_structured() && !place->empty()) {
    auto next = place->begin();
    for (std::size_t k = from.below(place->size()); k > 0; --k) ++next;
    place = &*next;
  }
  *place = nullptr;
  std::istringstream in{whole.dump()};
  try {
    sightline::read_certificate(in);
  } catch (const std::invalid_argument& error) {
    const std::string_view why = error.what();
    const std::string entry = key + '[' + std::to_string(number) + ']';
    if (why.find(entry) == std::string_view::npos && why.find(key + ": ") == std::string_view::npos)  // or as a whole
      throw Finding("what is wrong is not told to be in " + entry + ": " + std::string(why));
  }
}

/// One of them, with blanks between its tokens or without.
inline void certificate_forms(std::string_view bytes) {
  Bytes from(bytes);
  const bool is_of_solids = from.below(3) == 0;
  const std::vector<Formed_certificate>& all = is_of_solids ? formed_solid_certificates() : formed_certificates();
  const Formed_certificate& one = all[from.word() % all.size()];
  const bool is_right = one.forms[0].is_right, has_lines = from.below(2) == 0;
  const std::string whole = std::string(one.before) + std::string(one.forms[0].text) + std::string(one.forms[1].text) +
                            std::string(one.after);
  std::string text;
  bool is_quoted = false;
  for (const char c : whole) {
    is_quoted = is_quoted != (c == '"');
    text += c;
    if (has_lines && c == ',' && !is_quoted) text += from.below(2) == 0 ? "\n" : " ";
  }
  const bool is_taken = is_of_solids ? taken("no certificate of a set operation: ",
                                             [&] { return sightline::read_solid_certificate(text); })
                                           .has_value()
                                     : taken("certificate: ", [&] {
                                         std::istringstream in{text};
                                         return sightline::read_certificate(in);
                                       }).has_value();
  if (is_taken != is_right)
    throw Finding((is_right ? "a form that is right is refused: " : "a form that is wrong is taken: ") + text);
  if (is_of_solids) read_solid_certificate(text);
  else read_certificate(text);
  if (is_right && !is_of_solids) require_named_entry(text, from);
}

}  // namespace fuzz
