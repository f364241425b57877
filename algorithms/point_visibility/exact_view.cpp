#include <sightline/algorithms/point_visibility/exact_view.h>

#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/vectors.h>
#include <sightline/kernel/vertex.h>

#include <limits>
#include <type_traits>

namespace sightline {

Predicates Exact_view::predicates() const { return scene_->predicates(); }

Exact_view::Exact_view(const Scene& scene, const Sun& sun)
    : scene_(&scene), eye_point_(sun.direction), forms_(scene.pieces().size()) {
  std::array<Integer, 3> e = Over_common(sun.direction).whole;
  for (std::size_t k = 0; k < 3; ++k)
    if (sun_axis_ < 0 || abs(e[static_cast<std::size_t>(sun_axis_)]) < abs(e[k])) sun_axis_ = static_cast<int>(k);
  if (e[static_cast<std::size_t>(sun_axis_)] == 0) throw std::invalid_argument("a sun needs a direction other than 0");
  if (scene.pieces().size() >= (std::size_t{1} << 28)) throw std::length_error("scenes of up to 2^28 pieces only");
  const Integer common_factor = gcd(gcd(e[0], e[1]), e[2]);
  for (Integer& x : e) x /= common_factor;
  eye_ = {e[0], e[1], e[2], 0, 0, 0, 0, std::numeric_limits<double>::infinity()};
  measure();
  const Integer& along = e[static_cast<std::size_t>(sun_axis_)];
  for (std::size_t k = 0; k < 3; ++k) {
    sun_slope_[k] = nearest_double(Rational(Rational(e[k]) / along));
    sun_[k] = along < 0 ? -sun_slope_[k] : sun_slope_[k];
  }
  Rational last(along < 0 ? 1 : -1);
  last /= scene.points().divisor();
  mpq_div_2exp(last.get_mpq_t(), last.get_mpq_t(), static_cast<mp_bitcnt_t>(scene.points().shift()));
  sun_last_ = nearest_double(last);
}

Exact_view::Plane Exact_view::edge(std::uint32_t p, std::uint32_t q) const {
  const Eye_plane_name name = Eye_plane_name::edge(p, q);
  Plane w = narrow_ ? from(normal_of<__int128>(name.a, name.b)) : from(normal_of<Integer>(name.a, name.b));
  w.name = name;
  w.flipped = false;
  return p < q ? w : opposite(w);
}

Exact_view::Plane Exact_view::field_side(std::uint32_t k) const {
  Plane w = from(field_[k]);
  w.name = Eye_plane_name::field(k);
  w.flipped = false;
  return w;
}

Exact_view::Plane Exact_view::crossing(std::uint32_t f, std::uint32_t g) const {
  const Form &m = form(std::min(f, g)), &n = form(std::max(f, g));
  Plane w{m.x - n.x, m.y - n.y, m.z - n.z, 0, 0, Eye_plane_name::crossing(f, g), false};
  w.size = magnitude(w.x, w.y, w.z);
  w.error = 0x1p-48 * (m.size + n.size);
  if (!std::isfinite(w.size) || !std::isfinite(w.error)) {
    w.x = w.y = w.z = 0;
    w.size = 0;
    w.error = std::numeric_limits<double>::infinity();
  }
  return f < g ? w : opposite(w);
}

Exact_view::Plane Exact_view::cut(std::uint32_t f, sightline::Plane by) const {
  Plane w = from(cut_normal(f, {by.id(), false}));
  w.name = Eye_plane_name::cut(f, by.id());
  w.flipped = false;
  return by.flipped() ? opposite(w) : w;
}

Exact_view::Ray Exact_view::axis_ray(std::uint32_t k, bool positive) const {
  const Plane p = axis((k + 1) % 3), q = axis((k + 2) % 3);
  const double sign = positive ? 1 : -1;
  return {
      k == 0 ? sign : 0.0, k == 1 ? sign : 0.0, k == 2 ? sign : 0.0, 1, 0x1p-50, p.name, q.name, no_point, !positive};
}

Exact_view::Ray Exact_view::meet(const Plane& p, const Plane& q, Predicate_counts& counts) const {
  Ray r{p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x, 0, 0, p.name, q.name, no_point,
        p.flipped != q.flipped};
  r.size = magnitude(r.x, r.y, r.z);
  // Entries off by p.error and q.error, each product and difference by 2^-53: a quarter of the term in 2^-50 would
  // do. P-60
  r.error = p.size * q.error + q.size * p.error + 4 * p.error * q.error + 0x1p-50 * p.size * q.size + 0x1p-1000;
  if (!p.name.is_edge() || !q.name.is_edge()) return r;
  if (q.name.has_point(p.name.a)) return along(p.name.a, r, counts);
  if (q.name.has_point(p.name.b)) return along(p.name.b, r, counts);
  return r;
}

Sign Exact_view::beyond(std::uint32_t f, std::uint32_t point, Predicate_counts& counts) const {
  if (sun_axis_ >= 0) return beyond_unfiltered(f, point, counts);
  const Form& m = form(f);
  const Approximate_vector d = approximate_direction(point);
  const double value = m.x * d.x + m.y * d.y + m.z * d.z - 1;
  const double bound = 0x1p-48 * (m.size * magnitude(d.x, d.y, d.z) + 1) + 0x1p-1000 * m.size;
  if (const Sign sign = filtered(value, bound, counts); sign != CGAL::ZERO) return sign;
  return beyond_unfiltered(f, point, counts);
}

Sign Exact_view::side(std::uint32_t piece, std::uint32_t point, Predicate_counts& counts) const {
  const Predicates exact = predicates();
  const sightline::Plane support = scene_->pieces()[piece].support;
  return exact.side(exact.input_vertex(point, Vertex::no_plane, Vertex::no_plane, Vertex::no_plane),
                    exact.prepare(support), counts);
}

std::array<Integer, 3> Exact_view::direction(const Ray& r) const {
  std::array<Integer, 3> d =
      r.point != no_point ? point_direction<Integer>(r.point) : cross(normal<Integer>(r.p), normal<Integer>(r.q));
  if (r.flipped)
    for (Integer& x : d) x = -x;
  return d;
}

std::array<Integer, 3> Exact_view::normal(const Plane& w) const {
  std::array<Integer, 3> n = normal<Integer>(w.name);
  if (w.flipped)
    for (Integer& x : n) x = -x;
  return n;
}

Exact_point Exact_view::position(std::uint32_t piece, const Ray& r) const {
  if (r.point != no_point && scene_->incidences().contains(r.point, scene_->pieces()[piece].support.id()))
    return scene_->position(r.point);
  // The plane n x + d w = 0 at eye + t r: t = -(n eye + d w) / (w n r), in grid coordinates.
  const std::array<Integer, 4> h = predicates().coefficients(scene_->pieces()[piece].support);
  const std::array<Integer, 3> v = direction(r);
  if (sun_axis_ >= 0) {
    // The line from where v crosses the coordinate plane towards the sun. P-96
    const auto m = static_cast<std::size_t>(sun_axis_);
    const std::array<Integer, 3> e{eye_.x, eye_.y, eye_.z};
    const Integer rise = dot(in_view(h), v), to_sun = value_at_eye(h);
    std::array<Integer, 4> at;
    at[(m + 1) % 3] = v[0] * to_sun;
    at[(m + 2) % 3] = v[1] * to_sun;
    at[m] = 0;
    for (std::size_t k = 0; k < 3; ++k) at[k] -= rise * e[k];
    at[3] = (e[m] < 0 ? v[2] : Integer(-v[2])) * to_sun;
    return scene_->position(at);
  }
  const Integer slope = h[0] * v[0] + h[1] * v[1] + h[2] * v[2], value = value_at_eye(h);
  std::array<Integer, 4> at{eye_.x * slope - value * v[0], eye_.y * slope - value * v[1], eye_.z * slope - value * v[2],
                            eye_.w * slope};
  return scene_->position(at);
}

double Exact_view::farthest(std::uint32_t piece, const Ray& r) const {
  if (sun_axis_ >= 0) return std::numeric_limits<double>::infinity();
  const Form& m = form(piece);
  const double near = m.x * r.x + m.y * r.y + m.z * r.z - (m.size * (2 * r.error + 0x1p-48 * r.size) + 0x1p-700);
  const double length = std::sqrt(r.x * r.x + r.y * r.y + r.z * r.z) + 2 * r.error + 0x1p-530;  // squares underflow
  const double far = length / near * box_units_ * (1 + 0x1p-40);
  return near > 0 && std::isfinite(far) ? far : std::numeric_limits<double>::infinity();
}

template <int L>
int Exact_view::signum(const Fixed_integer<L>& n) {
  return n.sign();
}

void Exact_view::measure() {
  const Grid_points& points = scene_->points();
  const auto bits_of = [](const Integer& n) { return static_cast<int>(bit_length(n)); };
  const int of_eye = std::max({bits_of(eye_.x), bits_of(eye_.y), bits_of(eye_.z)});
  bits_ = 1 + (sun_axis_ >= 0 ? points.bits() + of_eye : std::max(points.bits() + bits_of(eye_.w), of_eye));
  narrow_ = bits_ <= 62;
  width_ = bits_ <= 20 ? 2 : bits_ <= 41 ? 4 : bits_ <= 84 ? 8 : 0;
  if (narrow_) narrow_eye_ = {eye_.x.get_si(), eye_.y.get_si(), eye_.z.get_si(), eye_.w.get_si()};
  else wide_directions_ = Lazy_table<Wide_direction, 16>(points.size());
  if (sun_axis_ >= 0) return;  // distances are of no use
  Rational units(1, eye_.w * points.divisor());
  mpq_div_2exp(units.get_mpq_t(), units.get_mpq_t(), static_cast<mp_bitcnt_t>(points.shift()));
  if (!narrow_) mpq_mul_2exp(units.get_mpq_t(), units.get_mpq_t(), static_cast<mp_bitcnt_t>(bits_));
  box_units_ = nearest_double(units);
}

const Exact_view::Wide_direction& Exact_view::wide_direction(std::uint32_t point) const {
  return wide_directions_.at(point, [&](std::size_t i) {
    const Grid_points& points = scene_->points();
    const auto p = static_cast<std::uint32_t>(i);
    const Vector<Integer> d =
        sun_axis_ >= 0
            ? sun_direction<Integer>([&](int axis) { return points.integer(p, axis); }, {eye_.x, eye_.y, eye_.z})
            : Vector<Integer>{eye_.w * points.integer(p, 0) - eye_.x, eye_.w * points.integer(p, 1) - eye_.y,
                              eye_.w * points.integer(p, 2) - eye_.z};
    return Wide_direction{d, {cut_off(d[0], bits_), cut_off(d[1], bits_), cut_off(d[2], bits_)}};
  });
}

Exact_view::Form Exact_view::form_of(const Piece& piece) const {
  const std::array<Integer, 4> h = predicates().coefficients(piece.support);
  const Integer value = value_at_eye(h);
  Form form{0, 0, 0, 0, sgn(value)};
  if (form.eye_side == 0) return form;
  long exponent = 0;
  const double divisor = -mpz_get_d_2exp(&exponent, value.get_mpz_t());
  const long scale = (narrow_ ? 0 : bits_) - exponent;
  const auto quotient = [&](const Integer& n) {
    long own = 0;
    const double mantissa = mpz_get_d_2exp(&own, n.get_mpz_t());
    return std::ldexp(mantissa / divisor, static_cast<int>(std::clamp(own + scale, -5000L, 5000L)));
  };
  const Vector<Integer> normal = in_view(h);
  form.x = quotient(normal[0]);
  form.y = quotient(normal[1]);
  form.z = quotient(normal[2]);
  form.size = magnitude(form.x, form.y, form.z);
  if (!(form.size < 0x1p300)) {  // or products of three of its kind would be beyond doubles
    form.x = form.y = form.z = 0;
    form.size = std::numeric_limits<double>::infinity();
  }
  return form;
}

template <class Number>
Exact_view::Vector<Number> Exact_view::point_direction(std::uint32_t p) const {
  if (narrow_) {
    const Vector<std::int64_t> d = narrow_direction(p);
    if constexpr (std::is_same_v<Number, Integer>)
      return {Integer(static_cast<long>(d[0])), Integer(static_cast<long>(d[1])), Integer(static_cast<long>(d[2]))};
    else return {Number(d[0]), Number(d[1]), Number(d[2])};
  }
  const Vector<Integer>& d = wide_direction(p).exact;
  if constexpr (std::is_same_v<Number, Integer>) {
    return d;
  } else {
    const auto number = [](const Integer& n) {
      Limb limbs[2];  // as fixed widths are for directions of up to 84 bits
      to_limbs(n, limbs, 2);
      if constexpr (std::is_same_v<Number, __int128>)
        return static_cast<__int128>(static_cast<unsigned __int128>(limbs[1]) << 64 | limbs[0]);
      else return Number(limbs, 2);
    };
    return {number(d[0]), number(d[1]), number(d[2])};
  }
}

template <class Number>
Exact_view::Vector<Number> Exact_view::normal_of(std::uint32_t p, std::uint32_t q) const {
  return cross(point_direction<Number>(p), point_direction<Number>(q));
}

template <class Number>
Exact_view::Vector<Number> Exact_view::normal(Eye_plane_name name) const {
  if (name.is_edge()) return normal_of<Number>(name.a, name.b);
  if constexpr (std::is_same_v<Number, Integer>) {
    if (name.kind() == Eye_plane_name::field_kind) return field_[name.index()];
    if (name.kind() == Eye_plane_name::crossing_kind) return crossing_normal(name.index(), name.b);
    if (name.kind() == Eye_plane_name::cut_kind) return cut_normal(name.index(), {name.b, false});
  }
  return {Number(name.index() == 0 ? 1 : 0), Number(name.index() == 1 ? 1 : 0), Number(name.index() == 2 ? 1 : 0)};
}

Exact_view::Vector<Integer> Exact_view::crossing_normal(std::uint32_t f, std::uint32_t g) const {
  const Predicates exact = predicates();
  const std::array<Integer, 4> m = exact.coefficients(scene_->pieces()[f].support),
                               n = exact.coefficients(scene_->pieces()[g].support);
  const Integer at_m = value_at_eye(m), at_n = value_at_eye(n);
  const int sign = sgn(at_m) * sgn(at_n);
  const Vector<Integer> of_m = in_view(m), of_n = in_view(n);
  Vector<Integer> difference;
  for (std::size_t k = 0; k < 3; ++k) difference[k] = sign * (at_m * of_n[k] - at_n * of_m[k]);
  return difference;
}

Exact_view::Vector<Integer> Exact_view::cut_normal(std::uint32_t f, sightline::Plane by) const {
  const Predicates exact = predicates();
  const std::array<Integer, 4> m = exact.coefficients(scene_->pieces()[f].support), h = exact.coefficients(by);
  const Integer at_m = value_at_eye(m), at_h = value_at_eye(h);
  // At a point x of f's plane, seen along x - eye, this is |at_m| h(x), as m(x) = 0.
  const Vector<Integer> of_m = in_view(m), of_h = in_view(h);
  Vector<Integer> normal;
  for (std::size_t k = 0; k < 3; ++k) normal[k] = sgn(at_m) * (at_m * of_h[k] - at_h * of_m[k]);
  return normal;
}

template <class Number>
int Exact_view::side_in(const Plane& w, const Ray& r) const {
  const Vector<Number> n = normal<Number>(w.name);
  const Vector<Number> v =
      r.point != no_point ? point_direction<Number>(r.point) : cross(normal<Number>(r.p), normal<Number>(r.q));
  return signum(dot(n, v)) * (w.flipped != r.flipped ? -1 : 1);
}

Sign Exact_view::side_unfiltered(const Plane& w, const Ray& r, Predicate_counts& counts) const {
  if (r.point != no_point ? w.name.has_point(r.point) : w.name == r.p || w.name == r.q) {
    ++counts.combinatorial;
    return CGAL::ZERO;
  }
  if (width_ != 0 && is_fixed(w.name) && (r.point != no_point || (is_fixed(r.p) && is_fixed(r.q)))) {
    ++counts.fixed;
    return static_cast<Sign>(width_ == 2   ? side_in<Fixed_integer<2>>(w, r)
                             : width_ == 4 ? side_in<Fixed_integer<4>>(w, r)
                                           : side_in<Fixed_integer<8>>(w, r));
  }
  ++counts.gmp;
  return static_cast<Sign>(side_in<Integer>(w, r));
}

Sign Exact_view::nearer_unfiltered(std::uint32_t f, std::uint32_t g, const Ray& r, Predicate_counts& counts) const {
  if (same_plane(f, g)) {
    ++counts.combinatorial;
    return CGAL::ZERO;
  }
  // On the line of both planes where the ray is of a point, or of an edge, that both hold.
  const auto on_both = [&](std::uint32_t point) {
    return side(f, point, counts) == CGAL::ZERO && side(g, point, counts) == CGAL::ZERO;
  };
  const auto edge_on_both = [&](Eye_plane_name name) { return name.is_edge() && on_both(name.a) && on_both(name.b); };
  if (r.point != no_point ? on_both(r.point) : edge_on_both(r.p) || edge_on_both(r.q)) {
    ++counts.combinatorial;
    return CGAL::ZERO;
  }
  const Eye_plane_name name = Eye_plane_name::crossing(f, g);
  if (r.point == no_point && (r.p == name || r.q == name)) {
    ++counts.combinatorial;
    return CGAL::ZERO;
  }
  ++counts.gmp;
  return static_cast<Sign>(sgn(dot(crossing_normal(f, g), direction(r))));
}

Exact_view::Ray Exact_view::along(std::uint32_t point, const Ray& r, Predicate_counts& counts) const {
  Ray to = ray(point);
  const double value = to.x * r.x + to.y * r.y + to.z * r.z,
               bound = to.size * r.error + to.error * (r.size + 4 * r.error);
  bool against = value < 0;
  if (std::fabs(value) > bound) {
    ++counts.filtered;
  } else {
    ++counts.gmp;
    against = sgn(dot(direction(r), direction(to))) < 0;
  }
  return against ? Ray{-to.x, -to.y, -to.z, to.size, to.error, r.p, r.q, point, true}
                 : Ray{to.x, to.y, to.z, to.size, to.error, r.p, r.q, point, false};
}

std::vector<std::array<Integer, 3>> field_of(const std::vector<Exact_point>& rays) {
  std::vector<std::array<Integer, 3>> normals;
  const std::size_t n = rays.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Exact_point &a = rays[k], &b = rays[(k + 1) % n];
    Exact_point normal;
    for (std::size_t i = 0; i < 3; ++i) normal[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    const std::array<Integer, 3>& row = normals.emplace_back(Over_common(normal).whole);
    for (std::size_t j = 0; j < n; ++j)
      if (j != k && j != (k + 1) % n &&
          sgn(Rational(row[0] * rays[j][0] + row[1] * rays[j][1] + row[2] * rays[j][2])) <= 0)
        throw std::invalid_argument(
            "the rays of a field of view must span a convex cone, counterclockwise around its inside");
  }
  if (n < 3) throw std::invalid_argument("a field of view wants three rays or more");
  return normals;
}

template Visible_surface<Exact_view> visible_surface(const Exact_view&, const Piece_boxes&, Cones<Exact_view>,
                                                     const Visible_options&);
template Visible_surface<Exact_view> visible_surface(const Exact_view&, const Piece_boxes&, Cones<Exact_view>,
                                                     const std::vector<std::vector<std::uint32_t>>&,
                                                     const Visible_options&);
template Visible_surface<Exact_view> visible_surface(const Exact_view&, const Piece_boxes&, const Visible_options&);

}  // namespace sightline
