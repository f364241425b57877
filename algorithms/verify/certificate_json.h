#pragma once
// Certificates as JSON text. Who calls what takes or gives a JSON value includes <nlohmann/json.hpp> too.

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/graph.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/algorithms/verify/weak.h>

#include <nlohmann/json_fwd.hpp>

#include <iosfwd>
#include <variant>

namespace sightline {

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
Order_certificate read_order_certificate(std::istream& in);

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
