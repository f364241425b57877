// From top to bottom: what parts of certificates are in JSON, read and written; then certificates of each kind.

#include <sightline/algorithms/verify/certificate_json.h>

#include <sightline/kernel/number.h>
#include <sightline/kernel/quoted.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sightline {
namespace certificate_json {
namespace {

constexpr const char* order_format = "sightline order 1";
constexpr const char* graph_format = "sightline graph 1";
constexpr const char* see_format = "sightline see 1";
constexpr const char* weak_format = "sightline weak 1";

// ---- Reading

[[noreturn]] void fail(const std::string& place, const std::string& what) {
  throw std::invalid_argument("certificate: " + place + ": " + what);
}

const nlohmann::json& member(const nlohmann::json& object, const char* key, const std::string& place) {
  if (!object.is_object()) fail(place, "expected an object");
  const auto found = object.find(key);
  if (found == object.end()) fail(place, std::string("no \"") + key + '"');
  return *found;
}

const nlohmann::json& array(const nlohmann::json& value, const std::string& place) {
  if (!value.is_array()) fail(place, "expected an array");
  return value;
}
std::uint32_t number32(const nlohmann::json& value, const std::string& place) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > UINT32_MAX)
    fail(place, "expected an integer from 0 to 4294967295");
  return value.get<std::uint32_t>();
}

Rational exact_number(const nlohmann::json& value, const std::string& place) {
  if (!value.is_string()) fail(place, "expected exact numbers as strings \"p\" or \"p/q\"");
  try {
    return rational_from_string(value.get_ref<const std::string&>());
  } catch (const std::invalid_argument& error) {
    fail(place, error.what());
  }
}

template <std::size_t n>
std::array<Rational, n> exact_numbers(const nlohmann::json& value, const std::string& place) {
  if (array(value, place).size() != n) fail(place, std::string("expected ") + (n == 3 ? "three" : "four") + " numbers");
  std::array<Rational, n> result;
  for (std::size_t k = 0; k < n; ++k) result[k] = exact_number(value[k], place);
  return result;
}
Exact_point point(const nlohmann::json& value, const std::string& place) { return exact_numbers<3>(value, place); }
std::vector<Exact_point> points(const nlohmann::json& value, const std::string& place) {
  std::vector<Exact_point> result;
  for (const nlohmann::json& p : array(value, place))
    result.push_back(point(p, place + '[' + std::to_string(result.size()) + ']'));
  return result;
}

/// {face, piece, vertices}: a fragment or a piece.
template <class Part>
std::vector<Part> parts(const nlohmann::json& certificate, const char* key) {
  std::vector<Part> result;
  for (const nlohmann::json& entry : array(member(certificate, key, "top level"), key)) {
    const std::string place = key + ('[' + std::to_string(result.size()) + ']');
    result.push_back({number32(member(entry, "face", place), place + ".face"),
                      number32(member(entry, "piece", place), place + ".piece"),
                      points(member(entry, "vertices", place), place + ".vertices")});
  }
  return result;
}

/// A number below a bound.
std::size_t place(const nlohmann::json& value, std::size_t below, const std::string& at) {
  const std::uint32_t number = number32(value, at);
  if (number >= below) fail(at, "expected a number below " + std::to_string(below));
  return number;
}

bool truth(const nlohmann::json& value, const std::string& at) {
  if (!value.is_boolean()) fail(at, "expected true or false");
  return value.get<bool>();
}

/// What every certificate has.
void read_covering(const nlohmann::json& value, Covering& covering) {
  covering.fragments = parts<Order_fragment>(value, "fragments");
  if (value.contains("pieces")) covering.pieces = parts<Covering::Piece>(value, "pieces");
  if (!value.contains("set_aside")) return;
  for (const nlohmann::json& entry : array(value["set_aside"], "set_aside")) {
    const std::string at = "set_aside[" + std::to_string(covering.set_aside.size()) + ']';
    const nlohmann::json& why = member(entry, "why", at);
    if (!why.is_string()) fail(at + ".why", "expected a string");
    covering.set_aside.push_back({number32(member(entry, "face", at), at + ".face"), why.get<std::string>()});
  }
}

/// The kinds of nodes, by the words that they begin with.
constexpr std::array<std::pair<const char*, Weak_certificate::Node::Kind>, 6> node_words{
    {{"line", Weak_certificate::Node::Kind::line},
     {"cut source", Weak_certificate::Node::Kind::cut_source},
     {"cut target", Weak_certificate::Node::Kind::cut_target},
     {"blocked", Weak_certificate::Node::Kind::blocked},
     {"empty", Weak_certificate::Node::Kind::empty},
     {"away", Weak_certificate::Node::Kind::away}}};

/// [line, factor] or [line, factor, {"source": form, "target": form}].
Weak_certificate::Term term(const nlohmann::json& value, const Weak_certificate& certificate, const std::string& at) {
  if (array(value, at).size() != 2 && value.size() != 3) fail(at, "expected [line, factor] or [line, factor, forms]");
  Weak_certificate::Term result;
  result.line = place(value[0], certificate.lines.size(), at + "[0]");
  result.factor = exact_number(value[1], at + "[1]");
  if (value.size() == 2) return result;
  if (!value[2].is_object()) fail(at + "[2]", "expected an object");
  if (value[2].contains("source")) result.source = exact_numbers<4>(value[2]["source"], at + "[2].source");
  if (value[2].contains("target")) result.target = exact_numbers<4>(value[2]["target"], at + "[2].target");
  return result;
}

/// [word], or [word, what it is about].
Weak_certificate::Node node(const nlohmann::json& value, const Weak_certificate& certificate, const std::string& at) {
  using Kind = Weak_certificate::Node::Kind;
  if (array(value, at).empty() || !value[0].is_string()) fail(at, "expected an array that begins with a word");
  const auto found = std::find_if(node_words.begin(), node_words.end(), [&](const auto& known) {
    return value[0].get_ref<const std::string&>() == known.first;
  });
  if (found == node_words.end())
    fail(at + "[0]", "expected \"line\", \"cut source\", \"cut target\", \"blocked\", \"empty\" or \"away\"");
  Weak_certificate::Node result;
  result.kind = found->second;
  const std::size_t size = result.kind == Kind::away ? 1 : 2;
  if (value.size() != size) fail(at, "expected " + std::to_string(size) + (size == 1 ? " entry" : " entries"));
  if (result.kind == Kind::line) result.index = place(value[1], certificate.lines.size(), at + "[1]");
  if (result.kind == Kind::blocked) result.index = place(value[1], certificate.fragments.size(), at + "[1]");
  if (result.kind == Kind::cut_source || result.kind == Kind::cut_target)
    result.plane = exact_numbers<4>(value[1], at + "[1]");
  if (result.kind == Kind::empty)
    for (const nlohmann::json& entry : array(value[1], at + "[1]"))
      result.terms.push_back(term(entry, certificate, at + "[1][" + std::to_string(result.terms.size()) + ']'));
  return result;
}

bool has_format(const nlohmann::json& value, const char* format) {
  const nlohmann::json& found = member(value, "format", "top level");
  return found.is_string() && found.get_ref<const std::string&>() == format;
}

nlohmann::json parse(std::istream& in) {
  try {
    return nlohmann::json::parse(in);
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument("certificate: " + printable(error.what(), 400, true));
  }
}

// ---- Writing

template <std::size_t n>
nlohmann::json write(const std::array<Rational, n>& numbers) {
  nlohmann::json result = nlohmann::json::array();
  for (const Rational& r : numbers) result.push_back(to_string(r));
  return result;
}
nlohmann::json write(const std::vector<Exact_point>& all) {
  nlohmann::json result = nlohmann::json::array();
  for (const Exact_point& p : all) result.push_back(write(p));
  return result;
}

template <class Part>
nlohmann::json write(const std::vector<Part>& all) {
  nlohmann::json result = nlohmann::json::array();
  for (const Part& part : all) {
    result.push_back({{"face", part.face}, {"piece", part.piece}, {"vertices", write(part.vertices)}});
  }
  return result;
}

nlohmann::json write(const Weak_certificate::Node& node) {
  using Kind = Weak_certificate::Node::Kind;
  const auto word =
      std::find_if(node_words.begin(), node_words.end(), [&](const auto& known) { return node.kind == known.second; });
  nlohmann::json result = nlohmann::json::array({word->first});
  if (node.kind == Kind::line || node.kind == Kind::blocked) result.push_back(node.index);
  if (node.kind == Kind::cut_source || node.kind == Kind::cut_target) result.push_back(write(node.plane));
  if (node.kind != Kind::empty) return result;
  nlohmann::json terms = nlohmann::json::array();
  for (const Weak_certificate::Term& term : node.terms) {
    nlohmann::json& entry = terms.emplace_back(nlohmann::json::array({term.line, to_string(term.factor)}));
    if (!term.source && !term.target) continue;
    nlohmann::json& forms = entry.emplace_back(nlohmann::json::object());
    if (term.source) forms["source"] = write(*term.source);
    if (term.target) forms["target"] = write(*term.target);
  }
  result.push_back(std::move(terms));
  return result;
}

nlohmann::json write(const char* format, const Covering& covering) {
  nlohmann::json set_aside = nlohmann::json::array();
  for (const auto& entry : covering.set_aside) set_aside.push_back({{"face", entry.face}, {"why", entry.why}});
  return {{"format", format},
          {"fragments", write(covering.fragments)},
          {"pieces", write(covering.pieces)},
          {"set_aside", std::move(set_aside)}};
}

}  // namespace
}  // namespace certificate_json

// ---- From JSON

Order_certificate order_certificate_from_json(const nlohmann::json& value) {
  using namespace certificate_json;
  if (!has_format(value, order_format)) fail("format", std::string("expected \"") + order_format + '"');
  Order_certificate certificate;
  certificate.eye = point(member(value, "eye", "top level"), "eye");
  if (value.contains("on_view")) certificate.on_view = truth(value["on_view"], "on_view");
  read_covering(value, certificate);
  return certificate;
}

Graph_certificate graph_certificate_from_json(const nlohmann::json& value) {
  using namespace certificate_json;
  if (!has_format(value, graph_format)) fail("format", std::string("expected \"") + graph_format + '"');
  Graph_certificate certificate;
  read_covering(value, certificate);
  const std::size_t count = certificate.fragments.size();
  for (const nlohmann::json& size : array(member(value, "sizes", "top level"), "sizes"))
    certificate.sizes.push_back(number32(size, "sizes[" + std::to_string(certificate.sizes.size()) + ']'));
  for (const nlohmann::json& arc : array(member(value, "arcs", "top level"), "arcs")) {
    const std::string at = "arcs[" + std::to_string(certificate.arcs.size()) + ']';
    if (array(arc, at).size() != 4) fail(at, "expected [from, to, corner of from, corner of to]");
    const std::size_t from = place(arc[0], count, at), to = place(arc[1], count, at);
    certificate.arcs.push_back({from, to, place(arc[2], certificate.fragments[from].vertices.size(), at),
                                place(arc[3], certificate.fragments[to].vertices.size(), at)});
  }
  return certificate;
}

Visible_certificate visible_certificate_from_json(const nlohmann::json& value) {
  using namespace certificate_json;
  if (!has_format(value, see_format)) fail("format", std::string("expected \"") + see_format + '"');
  Visible_certificate certificate;
  certificate.eye = point(member(value, "eye", "top level"), "eye");
  if (value.contains("field")) certificate.field = points(value["field"], "field");
  read_covering(value, certificate);
  for (const nlohmann::json& entry : array(member(value, "parts", "top level"), "parts")) {
    const std::string at = "parts[" + std::to_string(certificate.parts.size()) + ']';
    const std::size_t fragment = place(member(entry, "fragment", at), certificate.fragments.size(), at + ".fragment");
    certificate.parts.push_back({fragment, points(member(entry, "vertices", at), at + ".vertices"),
                                 point(member(entry, "ray", at), at + ".ray")});
  }
  for (const nlohmann::json& cone : array(member(value, "empty", "top level"), "empty"))
    certificate.empty.push_back(points(cone, "empty[" + std::to_string(certificate.empty.size()) + ']'));
  return certificate;
}

Weak_certificate weak_certificate_from_json(const nlohmann::json& value) {
  using namespace certificate_json;
  if (!has_format(value, weak_format)) fail("format", std::string("expected \"") + weak_format + '"');
  Weak_certificate certificate;
  read_covering(value, certificate);
  const std::size_t fragments = certificate.fragments.size();
  for (const nlohmann::json& source : array(member(value, "sources", "top level"), "sources"))
    certificate.sources.push_back(points(source, "sources[" + std::to_string(certificate.sources.size()) + ']'));
  const std::size_t sources = certificate.sources.size();
  if (value.contains("two_sided")) certificate.two_sided = truth(value["two_sided"], "two_sided");
  for (const nlohmann::json& line : array(member(value, "lines", "top level"), "lines")) {
    const std::string at = "lines[" + std::to_string(certificate.lines.size()) + ']';
    if (array(line, at).size() != 2) fail(at, "expected [fragment, corner]");
    const std::size_t fragment = place(line[0], fragments, at);
    certificate.lines.push_back({fragment, place(line[1], certificate.fragments[fragment].vertices.size(), at)});
  }
  for (const nlohmann::json& entry : array(member(value, "visible", "top level"), "visible")) {
    const std::string at = "visible[" + std::to_string(certificate.visible.size()) + ']';
    const std::size_t fragment = place(member(entry, "fragment", at), fragments, at + ".fragment"),
                      source = place(member(entry, "source", at), sources, at + ".source");
    certificate.visible.push_back(
        {fragment, source, point(member(entry, "from", at), at + ".from"), point(member(entry, "to", at), at + ".to")});
  }
  for (const nlohmann::json& entry : array(member(value, "hidden", "top level"), "hidden")) {
    const std::string at = "hidden[" + std::to_string(certificate.hidden.size()) + ']';
    auto& hidden = certificate.hidden.emplace_back();
    hidden.fragment = place(member(entry, "fragment", at), fragments, at + ".fragment");
    hidden.source = place(member(entry, "source", at), sources, at + ".source");
    for (const nlohmann::json& part : array(member(entry, "proof", at), at + ".proof"))
      hidden.proof.push_back(node(part, certificate, at + ".proof[" + std::to_string(hidden.proof.size()) + ']'));
  }
  if (!value.contains("undecided")) return certificate;
  for (const nlohmann::json& face : array(value["undecided"], "undecided"))
    certificate.undecided.push_back(number32(face, "undecided[" + std::to_string(certificate.undecided.size()) + ']'));
  return certificate;
}

Order_certificate read_order_certificate(std::istream& in) {
  return order_certificate_from_json(certificate_json::parse(in));
}

Certificate read_certificate(std::istream& in) {
  const nlohmann::json value = certificate_json::parse(in);
  if (certificate_json::has_format(value, certificate_json::weak_format)) return weak_certificate_from_json(value);
  if (certificate_json::has_format(value, certificate_json::see_format)) return visible_certificate_from_json(value);
  if (certificate_json::has_format(value, certificate_json::graph_format)) return graph_certificate_from_json(value);
  return order_certificate_from_json(value);
}

// ---- To JSON

nlohmann::json to_json(const Order_certificate& certificate) {
  nlohmann::json value = certificate_json::write(certificate_json::order_format, certificate);
  value["eye"] = certificate_json::write(certificate.eye);
  if (certificate.on_view) value["on_view"] = true;
  return value;
}

nlohmann::json to_json(const Graph_certificate& certificate) {
  nlohmann::json value = certificate_json::write(certificate_json::graph_format, certificate);
  nlohmann::json arcs = nlohmann::json::array();
  for (const Graph_certificate::Arc& arc : certificate.arcs)
    arcs.push_back({arc.from, arc.to, arc.corner_from, arc.corner_to});
  value["sizes"] = certificate.sizes;
  value["arcs"] = std::move(arcs);
  return value;
}

nlohmann::json to_json(const Visible_certificate& certificate) {
  using namespace certificate_json;
  nlohmann::json value = write(see_format, certificate);
  nlohmann::json parts = nlohmann::json::array(), empty = nlohmann::json::array();
  for (const Visible_certificate::Part& part : certificate.parts)
    parts.push_back({{"fragment", part.fragment}, {"vertices", write(part.vertices)}, {"ray", write(part.ray)}});
  for (const Visible_certificate::Directions& cone : certificate.empty) empty.push_back(write(cone));
  value["eye"] = write(certificate.eye);
  value["parts"] = std::move(parts);
  value["empty"] = std::move(empty);
  if (!certificate.field.empty()) value["field"] = write(certificate.field);
  return value;
}

nlohmann::json to_json(const Weak_certificate& certificate) {
  using namespace certificate_json;
  nlohmann::json value = write(weak_format, certificate);
  nlohmann::json sources = nlohmann::json::array(), visible = sources, lines = sources, hidden = sources;
  for (const std::vector<Exact_point>& source : certificate.sources) sources.push_back(write(source));
  for (const Weak_certificate::Sightline& sightline : certificate.visible)
    visible.push_back({{"fragment", sightline.fragment},
                       {"source", sightline.source},
                       {"from", write(sightline.from)},
                       {"to", write(sightline.to)}});
  for (const Weak_certificate::Edge& line : certificate.lines) lines.push_back({line.fragment, line.corner});
  for (const Weak_certificate::Hidden& entry : certificate.hidden) {
    nlohmann::json proof = nlohmann::json::array();
    for (const Weak_certificate::Node& node : entry.proof) proof.push_back(write(node));
    hidden.push_back({{"fragment", entry.fragment}, {"source", entry.source}, {"proof", std::move(proof)}});
  }
  value["sources"] = std::move(sources);
  value["visible"] = std::move(visible);
  value["lines"] = std::move(lines);
  value["hidden"] = std::move(hidden);
  value["undecided"] = certificate.undecided;
  if (certificate.two_sided) value["two_sided"] = true;
  return value;
}

}  // namespace sightline
