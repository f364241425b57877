#include <sightline/kernel/scene/polygon_soup.h>

namespace sightline {

Point_id Polygon_soup::add_point(const Rational& x, const Rational& y, const Rational& z) {
  coordinates.push(x);
  coordinates.push(y);
  coordinates.push(z);
  return static_cast<Point_id>(point_count() - 1);
}

Point_id Polygon_soup::add_point(double x, double y, double z) {
  coordinates.push_double(x);
  coordinates.push_double(y);
  coordinates.push_double(z);
  return static_cast<Point_id>(point_count() - 1);
}

}  // namespace sightline
