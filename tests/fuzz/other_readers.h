#pragma once
// Readers of JSON and of lists of numbers: what is taken is written and read alike, what is refused is refused in one
// line.

#include "support.h"

#include <sightline/harness/laws/query_json.h>
#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/io/number_lines.h>
#include <sightline/harness/judge/protocol.h>

#include <sstream>

namespace fuzz {

inline bool is_one_line(std::string_view text) {
  return !text.empty() &&
         std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; });
}

/// What read() makes of the bytes; nothing where it refuses them, as it must: in one line that begins so.
template <class Read>
auto taken(const char* begin, Read&& read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const std::invalid_argument& error) {
    require(is_one_line(error.what()) && std::string_view(error.what()).starts_with(begin),
            "an error is one line that says whose it is");
    return std::nullopt;
  }
}

/// Certificates, which nobody checks.
inline void read_certificate(std::string_view bytes) {
  const auto read = [](std::string_view text) {
    return taken("certificate: ", [&] {
      std::istringstream in{std::string(text)};
      return sightline::read_certificate(in);
    });
  };
  const auto written = [](const Certificate& certificate) {
    return std::visit([](const auto& claim) { return certificate_text(claim); }, certificate);
  };
  const std::optional<Certificate> certificate = read(bytes);
  if (!certificate) return;
  const std::string text = written(*certificate);
  const std::optional<Certificate> again = read(text);
  require(again.has_value(), "what is written is read");
  require(written(*again) == text, "what is written is the same certificate when read");
}

/// Queries of both kinds, about a scene of twelve faces.
inline void query(std::string_view bytes) {
  constexpr std::size_t faces = 12;
  const nlohmann::json value = nlohmann::json::parse(bytes, nullptr, false);
  if (value.is_discarded()) return;
  const auto posed = taken("query: ", [&] { return harness::query_from_json(value, faces); });
  if (posed) {
    for (const std::vector<Face_id>* list : {&posed->scene.visible, &posed->scene.hidden})
      for (const Face_id face : *list) require(face < faces, "a query names faces that there are");
    const auto text = harness::query_json(posed->scene, posed->seed).dump();
    const auto again = taken("query: ", [&] { return harness::query_from_json(nlohmann::json::parse(text), faces); });
    require(again && harness::query_json(again->scene, again->seed).dump() == text,
            "what is written is the same query when read");
  }
  const auto asked = taken("", [&] { return judge::query_from_json(value); });
  if (asked) {
    const auto text = judge::to_json(*asked).dump();
    const auto again = taken("", [&] { return judge::query_from_json(nlohmann::json::parse(text)); });
    require(
        again && again->eye == asked->eye && again->source == asked->source && judge::to_json(*again).dump() == text,
        "what is asked is the same query when read");
  }
}

/// Answers of somebody's program about a scene of twelve faces, to each question.
inline void answer(std::string_view bytes) {
  constexpr std::size_t faces = 12;
  const auto ascends = [](const std::vector<Face_id>& list) {
    return std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end() &&
           (list.empty() || list.back() < faces);
  };
  for (const judge::Question question : {judge::Question::order, judge::Question::see, judge::Question::weak}) {
    const auto taken_answer = taken("", [&] { return judge::read_answer(std::string(bytes), question, faces); });
    if (!taken_answer) continue;
    require(ascends(taken_answer->visible) && ascends(taken_answer->abstained),
            "faces are sorted, once, and of the scene");
    require(question == judge::Question::order ? taken_answer->visible.empty() : taken_answer->order.empty(),
            "an answer is to what was asked");
    std::set<Face_id> whole, in_parts;
    for (const judge::Drawn_face& drawn : taken_answer->order) {
      require(drawn.face < faces && (drawn.part.empty() || drawn.part.size() >= 3),
              "what is drawn is a face or a part of it");
      require(drawn.part.empty() ? whole.insert(drawn.face).second : (in_parts.insert(drawn.face), true),
              "a face is drawn once");
    }
    for (const Face_id face : taken_answer->abstained)
      require(!whole.contains(face) && !in_parts.contains(face) &&
                  !std::binary_search(taken_answer->visible.begin(), taken_answer->visible.end(), face),
              "nothing is answered and abstained from");
    for (const Face_id face : in_parts) require(!whole.contains(face), "a face is drawn whole or in parts");
  }
}

/// Lists of numbers, one a line.
inline void number_lines(std::string_view bytes) {
  const auto numbers_of = [](std::string_view text) -> std::optional<std::vector<std::vector<Rational>>> {
    std::vector<std::vector<Rational>> lines;
    try {
      read_number_lines({"numbers", text}, "some numbers", [&](const std::vector<Rational>& numbers) {
        lines.push_back(numbers);
        return numbers.size() < 8;
      });
      return lines;
    } catch (const Input_error& error) {
      require(is_one_line(error.what()) && std::string_view(error.what()).starts_with("numbers:"),
              "an error is one line that names the file");
      require(error.line <= text.size() + 1 && error.column <= text.size() + 1, "an error is at a place in the file");
      return std::nullopt;
    }
  };
  const auto lines = numbers_of(bytes);
  if (!lines) return;
  std::string text;
  for (const std::vector<Rational>& numbers : *lines) {
    require(!numbers.empty() && numbers.size() < 8, "a line holds numbers that were taken");
    for (const Rational& number : numbers) text += to_string(number) + ',';
    text.back() = '\n';
  }
  require(numbers_of(text) == lines, "what is written is the same when read");
}

}  // namespace fuzz
