#pragma once
// Certificates as JSON text.

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/graph.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sightline {

namespace certificate_json {

inline constexpr const char* order_format = "sightline order 1";
inline constexpr const char* graph_format = "sightline graph 1";
inline constexpr const char* see_format = "sightline see 1";
inline constexpr const char* weak_format = "sightline weak 1";

[[noreturn]] inline void fail(const std::string& place, const std::string& what) {
  throw std::invalid_argument("certificate: " + place + ": " + what);
}

const nlohmann::json& member(const nlohmann::json& object, const char* key, const std::string& place);
inline const nlohmann::json& array(const nlohmann::json& value, const std::string& place) {
  if (!value.is_array()) fail(place, "expected an array");
  return value;
}
std::uint32_t number32(const nlohmann::json& value, const std::string& place);
Rational exact_number(const nlohmann::json& value, const std::string& place);
template <std::size_t n>
std::array<Rational, n> exact_numbers(const nlohmann::json& value, const std::string& place) {
  if (array(value, place).size() != n) fail(place, std::string("expected ") + (n == 3 ? "three" : "four") + " numbers");
  std::array<Rational, n> result;
  for (std::size_t k = 0; k < n; ++k) result[k] = exact_number(value[k], place);
  return result;
}
inline Exact_point point(const nlohmann::json& value, const std::string& place) {
  return exact_numbers<3>(value, place);
}
std::vector<Exact_point> points(const nlohmann::json& value, const std::string& place);
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

std::size_t place(const nlohmann::json& value, std::size_t below, const std::string& at);

inline bool truth(const nlohmann::json& value, const std::string& at) {
  if (!value.is_boolean()) fail(at, "expected true or false");
  return value.get<bool>();
}

/// What every certificate has.
void read_covering(const nlohmann::json& value, Covering& covering);

/// The kinds of nodes, by the words that they begin with.
inline constexpr std::array<std::pair<const char*, Weak_certificate::Node::Kind>, 6> node_words{
    {{"line", Weak_certificate::Node::Kind::line},
     {"cut source", Weak_certificate::Node::Kind::cut_source},
     {"cut target", Weak_certificate::Node::Kind::cut_target},
     {"blocked", Weak_certificate::Node::Kind::blocked},
     {"empty", Weak_certificate::Node::Kind::empty},
     {"away", Weak_certificate::Node::Kind::away}}};

/// [line, factor] or [line, factor, {"source": form, "target": form}].
Weak_certificate::Term term(const nlohmann::json& value, const Weak_certificate& certificate, const std::string& at);

/// [word], or [word, what it is about].
Weak_certificate::Node node(const nlohmann::json& value, const Weak_certificate& certificate, const std::string& at);

bool has_format(const nlohmann::json& value, const char* format);

nlohmann::json parse(std::istream& in);

template <std::size_t n>
nlohmann::json write(const std::array<Rational, n>& numbers) {
  nlohmann::json result = nlohmann::json::array();
  for (const Rational& r : numbers) result.push_back(to_string(r));
  return result;
}
nlohmann::json write(const std::vector<Exact_point>& all);
template <class Part>
nlohmann::json write(const std::vector<Part>& all) {
  nlohmann::json result = nlohmann::json::array();
  for (const Part& part : all) {
    result.push_back({{"face", part.face}, {"piece", part.piece}, {"vertices", write(part.vertices)}});
  }
  return result;
}

nlohmann::json write(const Weak_certificate::Node& node);

nlohmann::json write(const char* format, const Covering& covering);

}  // namespace certificate_json

/// The certificate that a JSON value holds. "on_view" (false), "pieces" and "set_aside" may be left out where there are
/// none; further keys are passed over. Throws std::invalid_argument, one line that says where, if the value does not
/// have the format; whether the certificate is right is for verify_order() to say. Exact: yes
Order_certificate order_certificate_from_json(const nlohmann::json& value);

/// The same for verify_graph().
Graph_certificate graph_certificate_from_json(const nlohmann::json& value);

/// The same for verify_visible(). "field" may be left out too: all directions.
Visible_certificate visible_certificate_from_json(const nlohmann::json& value);

/// The same for verify_weak(). "two_sided" (false) and "undecided" may be left out too.
Weak_certificate weak_certificate_from_json(const nlohmann::json& value);

/// Reads a certificate from JSON text. Throws std::invalid_argument where the text is not JSON or not a certificate of
/// that kind.
inline Order_certificate read_order_certificate(std::istream& in) {
  return order_certificate_from_json(certificate_json::parse(in));
}

using Certificate = std::variant<Order_certificate, Graph_certificate, Visible_certificate, Weak_certificate>;

/// The same for a certificate of whatever kind its "format" says.
Certificate read_certificate(std::istream& in);

/// The certificate as a JSON value, numbers as strings "p" or "p/q". Post: order_certificate_from_json() gives it back.
/// Exact: yes
nlohmann::json to_json(const Order_certificate& certificate);

/// The same for graph_certificate_from_json().
nlohmann::json to_json(const Graph_certificate& certificate);

/// The same for visible_certificate_from_json().
nlohmann::json to_json(const Visible_certificate& certificate);

/// The same for weak_certificate_from_json(). Pre: each node is of a kind that there is.
nlohmann::json to_json(const Weak_certificate& certificate);

}  // namespace sightline
