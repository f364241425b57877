#pragma once
// Certificates as JSON text.

#include <sightline/algorithms/verify/graph.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/algorithms/verify/visible.h>

#include <nlohmann/json.hpp>

#include <istream>
#include <variant>

namespace sightline {

namespace certificate_json {

inline constexpr const char* order_format = "sightline order 1";
inline constexpr const char* graph_format = "sightline graph 1";
inline constexpr const char* see_format = "sightline see 1";

[[noreturn]] inline void fail(const std::string& place, const std::string& what) { throw std::invalid_argument("certificate: " + place + ": " + what); }

inline const nlohmann::json& member(const nlohmann::json& object, const char* key, const std::string& place) {
  if (!object.is_object()) fail(place, "expected an object");
  const auto found = object.find(key);
  if (found == object.end()) fail(place, std::string("no \"") + key + '"');
  return *found;
}
inline const nlohmann::json& array(const nlohmann::json& value, const std::string& place) {
  if (!value.is_array()) fail(place, "expected an array");
  return value;
}
inline std::uint32_t number32(const nlohmann::json& value, const std::string& place) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > UINT32_MAX) fail(place, "expected an integer from 0 to 4294967295");
  return value.get<std::uint32_t>();
}
inline Exact_point point(const nlohmann::json& value, const std::string& place) {
  if (array(value, place).size() != 3) fail(place, "expected three numbers");
  Exact_point p;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!value[k].is_string()) fail(place, "expected exact numbers as strings \"p\" or \"p/q\"");
    try {
      p[k] = rational_from_string(value[k].get_ref<const std::string&>());
    } catch (const std::invalid_argument& error) {
      fail(place, error.what());
    }
  }
  return p;
}
inline std::vector<Exact_point> points(const nlohmann::json& value, const std::string& place) {
  std::vector<Exact_point> result;
  for (const nlohmann::json& p : array(value, place)) result.push_back(point(p, place + '[' + std::to_string(result.size()) + ']'));
  return result;
}
/// {face, piece, vertices}: a fragment or a piece.
template <class Part>
std::vector<Part> parts(const nlohmann::json& certificate, const char* key) {
  std::vector<Part> result;
  for (const nlohmann::json& entry : array(member(certificate, key, "top level"), key)) {
    const std::string place = key + ('[' + std::to_string(result.size()) + ']');
    result.push_back({number32(member(entry, "face", place), place + ".face"), number32(member(entry, "piece", place), place + ".piece"),
                      points(member(entry, "vertices", place), place + ".vertices")});
  }
  return result;
}

inline std::size_t place(const nlohmann::json& value, std::size_t below, const std::string& at) {
  const std::uint32_t number = number32(value, at);
  if (number >= below) fail(at, "expected a number below " + std::to_string(below));
  return number;
}

/// What every certificate has.
inline void read_covering(const nlohmann::json& value, Covering& covering) {
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

inline bool has_format(const nlohmann::json& value, const char* format) {
  const nlohmann::json& found = member(value, "format", "top level");
  return found.is_string() && found.get_ref<const std::string&>() == format;
}

inline nlohmann::json parse(std::istream& in) {
  try {
    return nlohmann::json::parse(in);
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(std::string("certificate: ") + error.what());
  }
}

inline nlohmann::json write(const Exact_point& p) { return {to_string(p[0]), to_string(p[1]), to_string(p[2])}; }
inline nlohmann::json write(const std::vector<Exact_point>& all) {
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

inline nlohmann::json write(const char* format, const Covering& covering) {
  nlohmann::json set_aside = nlohmann::json::array();
  for (const auto& entry : covering.set_aside) set_aside.push_back({{"face", entry.face}, {"why", entry.why}});
  return {{"format", format}, {"fragments", write(covering.fragments)}, {"pieces", write(covering.pieces)}, {"set_aside", std::move(set_aside)}};
}

}  // namespace certificate_json

/// The certificate that a JSON value holds. "on_view" (false), "pieces" and "set_aside" may be left out where there are none; further keys are
/// passed over. Throws std::invalid_argument, one line that says where, if the value does not have the format; whether the
/// certificate is right is for verify_order() to say. Exact: yes
inline Order_certificate order_certificate_from_json(const nlohmann::json& value) {
  using namespace certificate_json;
  if (!has_format(value, order_format)) fail("format", std::string("expected \"") + order_format + '"');
  Order_certificate certificate;
  certificate.eye = point(member(value, "eye", "top level"), "eye");
  if (value.contains("on_view")) {
    if (!value["on_view"].is_boolean()) fail("on_view", "expected true or false");
    certificate.on_view = value["on_view"].get<bool>();
  }
  read_covering(value, certificate);
  return certificate;
}

/// The same for verify_graph().
inline Graph_certificate graph_certificate_from_json(const nlohmann::json& value) {
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
    certificate.arcs.push_back({from, to, place(arc[2], certificate.fragments[from].vertices.size(), at), place(arc[3], certificate.fragments[to].vertices.size(), at)});
  }
  return certificate;
}

/// The same for verify_visible(). "field" may be left out too: all directions.
inline Visible_certificate visible_certificate_from_json(const nlohmann::json& value) {
  using namespace certificate_json;
  if (!has_format(value, see_format)) fail("format", std::string("expected \"") + see_format + '"');
  Visible_certificate certificate;
  certificate.eye = point(member(value, "eye", "top level"), "eye");
  if (value.contains("field")) certificate.field = points(value["field"], "field");
  read_covering(value, certificate);
  for (const nlohmann::json& entry : array(member(value, "parts", "top level"), "parts")) {
    const std::string at = "parts[" + std::to_string(certificate.parts.size()) + ']';
    const std::size_t fragment = place(member(entry, "fragment", at), certificate.fragments.size(), at + ".fragment");
    certificate.parts.push_back({fragment, points(member(entry, "vertices", at), at + ".vertices"), point(member(entry, "ray", at), at + ".ray")});
  }
  for (const nlohmann::json& cone : array(member(value, "empty", "top level"), "empty"))
    certificate.empty.push_back(points(cone, "empty[" + std::to_string(certificate.empty.size()) + ']'));
  return certificate;
}

/// Reads a certificate from JSON text. Throws std::invalid_argument where the text is not JSON or not a certificate of that kind.
inline Order_certificate read_order_certificate(std::istream& in) { return order_certificate_from_json(certificate_json::parse(in)); }

/// The same for a certificate of whatever kind its "format" says.
inline std::variant<Order_certificate, Graph_certificate, Visible_certificate> read_certificate(std::istream& in) {
  const nlohmann::json value = certificate_json::parse(in);
  if (certificate_json::has_format(value, certificate_json::see_format)) return visible_certificate_from_json(value);
  if (certificate_json::has_format(value, certificate_json::graph_format)) return graph_certificate_from_json(value);
  return order_certificate_from_json(value);
}

/// The certificate as a JSON value, numbers as strings "p" or "p/q". Post: order_certificate_from_json() gives it back. Exact: yes
inline nlohmann::json to_json(const Order_certificate& certificate) {
  nlohmann::json value = certificate_json::write(certificate_json::order_format, certificate);
  value["eye"] = certificate_json::write(certificate.eye);
  if (certificate.on_view) value["on_view"] = true;
  return value;
}

/// The same for graph_certificate_from_json().
inline nlohmann::json to_json(const Graph_certificate& certificate) {
  nlohmann::json value = certificate_json::write(certificate_json::graph_format, certificate);
  nlohmann::json arcs = nlohmann::json::array();
  for (const Graph_certificate::Arc& arc : certificate.arcs) arcs.push_back({arc.from, arc.to, arc.corner_from, arc.corner_to});
  value["sizes"] = certificate.sizes, value["arcs"] = std::move(arcs);
  return value;
}

/// The same for visible_certificate_from_json().
inline nlohmann::json to_json(const Visible_certificate& certificate) {
  using namespace certificate_json;
  nlohmann::json value = write(see_format, certificate);
  nlohmann::json parts = nlohmann::json::array(), empty = nlohmann::json::array();
  for (const Visible_certificate::Part& part : certificate.parts) parts.push_back({{"fragment", part.fragment}, {"vertices", write(part.vertices)}, {"ray", write(part.ray)}});
  for (const Visible_certificate::Directions& cone : certificate.empty) empty.push_back(write(cone));
  value["eye"] = write(certificate.eye), value["parts"] = std::move(parts), value["empty"] = std::move(empty);
  if (!certificate.field.empty()) value["field"] = write(certificate.field);
  return value;
}

}  // namespace sightline
