#pragma once
// Certificates from JSON text, read as a stream: neither the text nor a JSON value of all of it is held.
// certificate_writer.h writes it.

#include <sightline/algorithms/verify/along.h>
#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/graph.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/algorithms/verify/weak.h>

#include <cstddef>
#include <iosfwd>
#include <stdexcept>
#include <string>
#include <variant>

namespace sightline {

/// What is wrong with the text of a certificate, and where. what() is one line, "certificate: line L, column C: " and
/// the message, without the place where there is none.
class Certificate_error : public std::invalid_argument {
 public:
  Certificate_error(std::size_t line, std::size_t column, const std::string& message, bool is_no_json = false);
  std::size_t line, column;  ///< from 1; 0 where no one place is to blame
  std::string message;
  bool is_no_json;
};

using Certificate =
    std::variant<Order_certificate, Graph_certificate, Visible_certificate, Weak_certificate, Along_certificate>;

/// Reads a certificate of whatever kind its "format" says, keys in any order. "on_view" (false), "points", "pieces",
/// "set_aside", "field", "rays", "two_sided" (false) and "undecided" may be left out where there are none; further keys
/// are passed over. Whether the certificate is right is for verify_order() and its like to say. Errors:
/// Certificate_error where the text is not JSON, or not a certificate; or where numbers name points of the table so
/// often that these would take, written out, more than 64 times the text that was read, and 256 MiB. Cost: linear;
/// memory for the certificate and one entry of its lists. Exact: yes
Certificate read_certificate(std::istream& in);

/// The same for one kind. Errors: as above, for other kinds too.
Order_certificate read_order_certificate(std::istream& in);

}  // namespace sightline
