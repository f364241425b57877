#include <sightline/io/exact_text.h>

#include <sightline/io/decimal.h>
#include <sightline/kernel/quoted.h>

#include <algorithm>

namespace sightline {

std::optional<std::string> decimal_text(const Rational& value) {
  // The denominator is 2^a 5^b, or there is none; the number of places is the larger of a and b.
  Integer rest;
  const auto divide_out = [&rest](const Integer& n, unsigned long prime) {
    return mpz_remove(rest.get_mpz_t(), n.get_mpz_t(), Integer(prime).get_mpz_t());
  };
  const unsigned long twos = divide_out(value.get_den(), 2);
  const unsigned long fives = divide_out(rest, 5);
  if (rest != 1) return std::nullopt;
  const unsigned long places = std::max(twos, fives);
  if (places == 0) return value.get_num().get_str();
  if (places > largest_decimal_exponent) return std::nullopt;

  Integer factor;
  mpz_ui_pow_ui(factor.get_mpz_t(), twos < places ? 2 : 5, places - std::min(twos, fives));
  std::string digits = Integer(abs(value.get_num()) * factor).get_str();
  const std::string sign = sgn(value) < 0 ? "-" : "";
  if (places > digits.size() + 5) {  // one digit before the point, so that one sees how large it is
    const std::string exponent = "e-" + std::to_string(places + 1 - digits.size());
    return sign + (digits.size() == 1 ? digits : digits.insert(1, ".")) + exponent;
  }
  if (places >= digits.size()) digits.insert(0, places + 1 - digits.size(), '0');
  return sign + digits.insert(digits.size() - places, ".");
}

std::string decimal_texts(const Polygon_soup& soup, Point_id p, const std::string& format) {
  std::string texts;
  for (const Rational& coordinate : soup.point(p)) {
    const std::optional<std::string> text = decimal_text(coordinate);
    if (!text)
      throw Not_representable(format + " cannot hold the coordinate " + printable(to_string(coordinate), 40, true) +
                              " of point " + std::to_string(p) + ", which is no finite decimal; write .qoff");
    (texts += ' ') += *text;
  }
  return texts;
}

void check_no_holes(const Polygon_soup& soup, const std::string& format) {
  for (Face_id f = 0; f < soup.face_count(); ++f)
    if (soup.loop_count(f) != 1)
      throw Not_representable(format + " cannot hold face " + std::to_string(f) +
                              ", which has holes; cut it into faces without holes first");
}

}  // namespace sightline
