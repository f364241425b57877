#pragma once
// Certificates as JSON text.

#include <sightline/algorithms/verify/order.h>

#include <nlohmann/json.hpp>

#include <istream>

namespace sightline {

namespace certificate_json {

inline constexpr const char* order_format = "sightline order 1";

[[noreturn]] inline void fail(const std::string& place, const std::string& what) { throw std::invalid_argument("order certificate: " + place + ": " + what); }

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

inline nlohmann::json write(const Exact_point& p) { return {to_string(p[0]), to_string(p[1]), to_string(p[2])}; }
template <class Part>
nlohmann::json write(const std::vector<Part>& all) {
  nlohmann::json result = nlohmann::json::array();
  for (const Part& part : all) {
    nlohmann::json vertices = nlohmann::json::array();
    for (const Exact_point& p : part.vertices) vertices.push_back(write(p));
    result.push_back({{"face", part.face}, {"piece", part.piece}, {"vertices", std::move(vertices)}});
  }
  return result;
}

}  // namespace certificate_json

/// The certificate that a JSON value holds. "pieces" and "set_aside" may be left out where there are none; further keys are
/// passed over. Throws std::invalid_argument, one line that says where, if the value does not have the format; whether the
/// certificate is right is for verify_order() to say. Exact: yes
inline Order_certificate order_certificate_from_json(const nlohmann::json& value) {
  using namespace certificate_json;
  const nlohmann::json& format = member(value, "format", "top level");
  if (!format.is_string() || format.get_ref<const std::string&>() != order_format) fail("format", std::string("expected \"") + order_format + '"');
  Order_certificate certificate;
  certificate.eye = point(member(value, "eye", "top level"), "eye");
  certificate.fragments = parts<Order_fragment>(value, "fragments");
  if (value.contains("pieces")) certificate.pieces = parts<Order_certificate::Piece>(value, "pieces");
  if (value.contains("set_aside"))
    for (const nlohmann::json& entry : array(value["set_aside"], "set_aside")) {
      const std::string place = "set_aside[" + std::to_string(certificate.set_aside.size()) + ']';
      const nlohmann::json& why = member(entry, "why", place);
      if (!why.is_string()) fail(place + ".why", "expected a string");
      certificate.set_aside.push_back({number32(member(entry, "face", place), place + ".face"), why.get<std::string>()});
    }
  return certificate;
}

/// Reads a certificate from JSON text. Throws std::invalid_argument where the text is not JSON or not a certificate.
inline Order_certificate read_order_certificate(std::istream& in) {
  nlohmann::json value;
  try {
    value = nlohmann::json::parse(in);
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(std::string("order certificate: ") + error.what());
  }
  return order_certificate_from_json(value);
}

/// The certificate as a JSON value, numbers as strings "p" or "p/q". Post: order_certificate_from_json() gives it back. Exact: yes
inline nlohmann::json to_json(const Order_certificate& certificate) {
  using namespace certificate_json;
  nlohmann::json set_aside = nlohmann::json::array();
  for (const auto& entry : certificate.set_aside) set_aside.push_back({{"face", entry.face}, {"why", entry.why}});
  return {{"format", order_format}, {"eye", write(certificate.eye)},     {"fragments", write(certificate.fragments)},
          {"pieces", write(certificate.pieces)}, {"set_aside", std::move(set_aside)}};
}

}  // namespace sightline
