#include <sightline/algorithms/verify/verdict.h>

#include <sstream>

namespace sightline::certificate_check {

std::string name(const Exact_point& p) {
  std::ostringstream text;
  text << '(' << nearest_double(p[0]) << ", " << nearest_double(p[1]) << ", " << nearest_double(p[2]) << ')';
  return text.str();
}

std::string exact_name(const Exact_point& p) {
  return '(' + p[0].get_str() + ", " + p[1].get_str() + ", " + p[2].get_str() + ')';
}

bool canonical(const Rational& r) { return sgn(r.get_den()) > 0 && gcd(r.get_num(), r.get_den()) == 1; }

bool canonical(const std::vector<Exact_point>& points) {
  return std::all_of(points.begin(), points.end(), [](const Exact_point& p) { return canonical(p); });
}

}  // namespace sightline::certificate_check
