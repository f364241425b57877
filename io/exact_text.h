#pragma once
// Exact numbers as text: what all text formats share when written.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <optional>
#include <stdexcept>
#include <string>

namespace sightline {

/// A soup that a format cannot hold without changing it; what() says why and which format can.
class Not_representable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The decimal that a rational is ("0.1", "-25", "1e-30"), such that parse_decimal gives it back; nothing where it has
/// no finite one, or one beyond largest_decimal_exponent. Exact: yes.
std::optional<std::string> decimal_text(const Rational& value);

/// " x y z" in decimals. Throws Not_representable where one has none.
std::string decimal_texts(const Polygon_soup& soup, Point_id p, const std::string& format);

/// Throws Not_representable where a face has holes.
void check_no_holes(const Polygon_soup& soup, const std::string& format);

}  // namespace sightline
