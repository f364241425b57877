#pragma once
// Readers of JSON and of lists of numbers: what is taken is written and read alike, what is refused is refused in one
// line.

#include "support.h"

#include <sightline/harness/laws/query_json.h>
#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/verify/solids_json.h>
#include <sightline/io/number_lines.h>
#include <sightline/harness/judge/protocol.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <set>
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

/// What a certificate names by places is there: fragments, corners, rays, sources and lines.
inline void require_named(const Order_certificate&) {}
inline void require_named(const Graph_certificate& claim) {
  const auto& fragments = claim.fragments;
  for (const auto& [from, to, of_from, of_to] : claim.arcs)
    require(from < fragments.size() && to < fragments.size() && of_from < fragments[from].vertices.size() &&
                of_to < fragments[to].vertices.size(),
            "an arc is from corner to corner");
}
inline void require_named(const Visible_certificate& claim) {
  for (const Visible_certificate::Part& part : claim.parts) {
    require(part.fragment < claim.fragments.size(), "a part is of a fragment");
    for (const std::uint32_t ray : part.rays) require(ray < claim.rays.size(), "a part has rays that there are");
  }
}
inline void require_named(const Weak_certificate& claim) {
  const std::size_t fragments = claim.fragments.size(), sources = claim.sources.size(), lines = claim.lines.size();
  for (const auto& [fragment, corner] : claim.lines)
    require(fragment < fragments && corner < claim.fragments[fragment].vertices.size(), "a line is of an edge");
  for (const auto& entry : claim.visible)
    require(entry.fragment < fragments && entry.source < sources, "a sightline is from a source to a fragment");
  for (const auto& entry : claim.hidden) {
    require(entry.source < sources, "a proof is of a source");
    entry.for_each_fragment([&](std::size_t k) { require(k < fragments, "a proof is of fragments that there are"); });
    for (const Weak_certificate::Node& node : entry.proof) {
      using Node = Weak_certificate::Node::Kind;
      require(node.kind != Node::line || node.index < lines, "a node is of a line that there is");
      require(node.kind != Node::blocked || node.index < fragments, "a leaf is of a fragment that there is");
      for (const auto& term : node.terms) require(term.line < lines, "a term is of a line that there is");
    }
  }
}

inline void require_named(const Along_certificate& claim) {
  const std::size_t fragments = claim.fragments.size(), moments = claim.moments.size();
  const auto require_side = [&](const Along_certificate::Side& side) {
    require(side.fragment < fragments, "a side is of a fragment that there is");
    require(side.kind == Along_certificate::Side::Kind::meet ||
                side.corner < claim.fragments[side.fragment].vertices.size(),
            "a side is of an edge");
  };
  for (const auto& face : claim.faces)
    for (const auto& [low, high] : face.seen) require(low < moments && high < moments, "a face is seen at moments");
  for (const auto& proof : claim.proofs) {
    require(proof.fragment < fragments && proof.range.low < moments && proof.range.high < moments,
            "a proof is of a fragment, at moments");
    for (const auto& side : proof.cone) require_side(side);
    for (const auto& node : proof.tree)
      if (node.is_cut) require_side(node.cut);
      else require(node.blocked < fragments, "a leaf is behind a fragment that there is");
  }
}

/// The certificate with one thing that it names one beyond those that there are, for each such thing: none may be
/// taken.
template <class Claim>
std::vector<Claim> naming_too_much(const Claim&) {
  return {};
}
inline std::vector<Weak_certificate> naming_too_much(const Weak_certificate& claim) {
  std::vector<Weak_certificate> all;
  for (std::size_t i = 0; i < claim.hidden.size() && all.empty(); ++i)
    if (!claim.hidden[i].also.empty()) {
      all.push_back(claim);
      all.back().hidden[i].also.back() = claim.fragments.size();
    }
  for (std::size_t i = 0; i < claim.hidden.size() && all.size() < 8; ++i)
    for (std::size_t k = 0; k < claim.hidden[i].proof.size() && all.size() < 8; ++k) {
      using Node = Weak_certificate::Node::Kind;
      Weak_certificate lie = claim;
      auto& node = lie.hidden[i].proof[k];
      if (node.kind == Node::line) node.index = claim.lines.size();
      else if (node.kind == Node::blocked) node.index = claim.fragments.size();
      else if (!node.terms.empty()) node.terms.back().line = claim.lines.size();
      else continue;
      all.push_back(std::move(lie));
    }
  return all;
}

inline std::vector<Along_certificate> naming_too_much(const Along_certificate& claim) {
  std::vector<Along_certificate> all;
  for (std::size_t k = 0; k < claim.proofs.size() && all.size() < 12; ++k) {
    const auto add = [&](auto&& change) { change(all.emplace_back(claim).proofs[k]); };
    add([&](auto& proof) { proof.range.high = claim.moments.size(); });
    add([&](auto& proof) { proof.fragment = claim.fragments.size(); });
    add([&](auto& proof) {
      if (!proof.cone.empty()) proof.cone.back().fragment = claim.fragments.size();
      else if (proof.tree.back().is_cut) proof.tree.back().cut.fragment = claim.fragments.size();
      else proof.tree.back().blocked = claim.fragments.size();
    });
  }
  return all;
}

/// Where the text is wrong; (0, 0) where it is not, or no one place is to blame.
inline std::array<std::size_t, 2> place_of_error(const std::string& text) {
  std::istringstream in(text);
  try {
    sightline::read_certificate(in);
  } catch (const Certificate_error& error) {
    return {error.line, error.column};
  } catch (const std::invalid_argument&) {
  }
  return {0, 0};
}
/// A place in the text moves with what stands before it: a line, a blank, but no byte order mark.
inline void require_place(const std::string& text) {
  const auto [line, column] = place_of_error(text);
  require((line == 0) == (column == 0), "a place has a line and a column");
  if (line == 0) return;
  const auto lines = 1 + std::count_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; });
  require(line <= static_cast<std::size_t>(lines) && column <= text.size() + 1, "a place is in the text");
  if (text.starts_with("\xEF")) return;
  using At = std::array<std::size_t, 2>;
  require(place_of_error("\xEF\xBB\xBF" + text) == At{line, column}, "a byte order mark takes no column");
  require(place_of_error("    " + text) == At{line, column + (line == 1 ? 4 : 0)}, "a blank takes a column");
  require(place_of_error("  \n " + text) == At{line + 1, column + (line == 1 ? 1 : 0)}, "a line is a line");
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
  if (!certificate) return require_place(std::string(bytes));
  std::visit(
      [&](const auto& claim) {
        require_named(claim);
        for (const auto& lie : naming_too_much(claim))
          require(!read(certificate_text(lie)).has_value(), "what names more than there is is refused");
      },
      *certificate);
  const std::string text = written(*certificate);
  const std::optional<Certificate> again = read(text);
  require(again.has_value(), "what is written is read");
  require(written(*again) == text, "what is written is the same certificate when read");
}

/// Of a set operation.
inline void read_solid_certificate(std::string_view bytes) {
  const auto read = [](const std::string& text) {
    return taken("", [&] { return sightline::read_solid_certificate(text); });
  };
  const auto written = [](const sightline::Solid_certificate& certificate) {
    std::ostringstream out;
    sightline::write_solid_certificate(out, certificate);
    return out.str();
  };
  const auto certificate = read(std::string(bytes));
  if (!certificate) return;
  const std::string text = written(*certificate);
  const auto again = read(text);
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
  constexpr std::size_t faces = 12, rays = 3;
  const auto ascends = [](const std::vector<Face_id>& list) {
    return std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end() &&
           (list.empty() || list.back() < faces);
  };
  for (const judge::Question question : {judge::Question::order, judge::Question::see, judge::Question::weak,
                                         judge::Question::trace, judge::Question::boolean}) {
    const auto taken_answer = taken("", [&] { return judge::read_answer(std::string(bytes), question, faces, rays); });
    if (!taken_answer) continue;
    require(ascends(taken_answer->visible) && ascends(taken_answer->abstained),
            "faces are sorted, once, and of the scene");
    require(question == judge::Question::boolean || !taken_answer->surface, "a surface answers set operations alone");
    if (taken_answer->surface) taken_answer->surface->check_corners();
    require(question == judge::Question::order ? taken_answer->visible.empty() : taken_answer->order.empty(),
            "an answer is to what was asked");
    require(taken_answer->first.size() == (question == judge::Question::trace ? rays : 0), "each ray is answered");
    for (const auto& first : taken_answer->first) require(!first || *first < faces, "a ray meets a face of the scene");
    std::set<Face_id> whole, in_parts;
    for (const judge::Drawn_face& drawn : taken_answer->order) {
      require(drawn.face < faces && (drawn.part.empty() || drawn.part.size() >= 3),
              "what is drawn is a face or a part of it");
      const bool is_first = drawn.part.empty() && whole.insert(drawn.face).second;
      require(is_first || !drawn.part.empty(), "a face is drawn once");
      if (!drawn.part.empty()) in_parts.insert(drawn.face);
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
