#pragma once
// The exact model of View: names decide, then doubles with a derived bound, then integers as wide as the scene needs.

#include <sightline/algorithms/point_visibility/lazy_table.h>
#include <sightline/algorithms/point_visibility/view.h>

namespace sightline {

/// Directions from the eye are integer vectors of b bits, so planes through it and an edge have normals of 2 b + 1
/// bits, rays where two of them meet 4 b + 3, and the side of such a ray 6 b + 7: 128 bits do for b <= 20, 256 for 41,
/// 512 for 84. Nothing is built on anything but input, so nothing grows. Exact: yes. Proof: P-60
class Exact_view {
 public:
  static constexpr bool is_exact = true;

  /// Doubles within `error` in each coordinate; `size` is at least the sum of their magnitudes.
  struct Plane {
    double x, y, z, size, error;
    Eye_plane_name name;
    bool flipped;
  };
  /// The direction of a point of the scene (or against it), or the product of the normals of p and q, in that order.
  struct Ray {
    double x, y, z, size, error;
    Eye_plane_name p, q;
    std::uint32_t point;  ///< or no_point
    bool flipped;         ///< against the point, or against the product of the canonical normals
  };
  static constexpr std::uint32_t no_point = ~std::uint32_t{0};

  /// Pre: the scene outlives the view, and takes no further planes. `field`: normals of the sides of a field of view;
  /// side k meets side k + 1, in this sense, in a ray of it.
  Exact_view(const Scene& scene, const Exact_point& eye, std::vector<std::array<Integer, 3>> field = {})
      : scene_(&scene),
        eye_point_(eye),
        eye_(scene.locate(eye)),
        field_(std::move(field)),
        forms_(scene.pieces().size()) {
    if (scene.pieces().size() >= (std::size_t{1} << 28)) throw std::length_error("scenes of up to 2^28 pieces only");
    measure();
  }

  const Scene& scene() const { return *scene_; }
  const Exact_point& eye() const { return eye_point_; }
  int bits() const { return bits_; }
  Sign eye_side(std::uint32_t piece) const { return static_cast<Sign>(form(piece).eye_side); }

  // ---- Planes and rays
  // ------------------------------------------------------------------------------------------------------

  Plane edge(std::uint32_t p, std::uint32_t q) const {
    const Eye_plane_name name = Eye_plane_name::edge(p, q);
    Plane w = narrow_ ? from(normal_of<__int128>(name.a, name.b)) : from(normal_of<Integer>(name.a, name.b));
    w.name = name, w.flipped = false;
    return p < q ? w : opposite(w);
  }
  Plane axis(std::uint32_t k) const {
    return {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0, 1, 0, Eye_plane_name::axis(k), false};
  }
  std::size_t field_sides() const { return field_.size(); }
  Plane field_side(std::uint32_t k) const {
    Plane w = from(field_[k]);
    w.name = Eye_plane_name::field(k), w.flipped = false;
    return w;
  }
  Plane crossing(std::uint32_t f, std::uint32_t g) const {
    const Form &m = form(std::min(f, g)), &n = form(std::max(f, g));
    Plane w{m.x - n.x, m.y - n.y, m.z - n.z, 0, 0, Eye_plane_name::crossing(f, g), false};
    w.size = magnitude(w.x, w.y, w.z), w.error = 0x1p-48 * (m.size + n.size);
    if (!std::isfinite(w.size) || !std::isfinite(w.error))
      w.x = w.y = w.z = 0, w.size = 0, w.error = std::numeric_limits<double>::infinity();
    return f < g ? w : opposite(w);
  }
  Plane opposite(const Plane& w) const { return {-w.x, -w.y, -w.z, w.size, w.error, w.name, !w.flipped}; }

  Ray axis_ray(std::uint32_t k, bool positive) const {
    const Plane p = axis((k + 1) % 3), q = axis((k + 2) % 3);
    const double sign = positive ? 1 : -1;
    return {
        k == 0 ? sign : 0.0, k == 1 ? sign : 0.0, k == 2 ? sign : 0.0, 1, 0x1p-50, p.name, q.name, no_point, !positive};
  }
  /// Towards a point of the scene.
  Ray ray(std::uint32_t point) const {
    const Approximate_vector d = approximate_direction(point);
    const double size = magnitude(d.x, d.y, d.z);
    return {d.x, d.y, d.z, size, 0x1p-50 * size + 0x1p-1000, {}, {}, point, false};
  }
  /// Where planes through edges with a common point meet, it is that point's direction or the one against it.
  Ray meet(const Plane& p, const Plane& q, Predicate_counts& counts) const {
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

  // ---- Predicates
  // -----------------------------------------------------------------------------------------------------------

  Sign side(const Plane& w, const Ray& r, Predicate_counts& counts) const {
    const double value = w.x * r.x + w.y * r.y + w.z * r.z;
    const double bound =
        w.size * r.error + w.error * (r.size + 4 * r.error);  // the rounding of these lines is in r.error. P-60
    if (value > bound) return ++counts.filtered, CGAL::POSITIVE;
    if (value < -bound) return ++counts.filtered, CGAL::NEGATIVE;
    return side_unfiltered(w, r, counts);
  }
  Sign side(const Plane& w, std::uint32_t point, Predicate_counts& counts) const {
    const Approximate_vector d = approximate_direction(point);
    const double value = w.x * d.x + w.y * d.y + w.z * d.z;
    const double bound = (w.size * 0x1p-50 + w.error) * magnitude(d.x, d.y, d.z) + 0x1p-1000 * (1 + w.size);
    if (value > bound) return ++counts.filtered, CGAL::POSITIVE;
    if (value < -bound) return ++counts.filtered, CGAL::NEGATIVE;
    if (w.name.has_point(point)) return ++counts.combinatorial, CGAL::ZERO;
    return side_unfiltered(w, ray(point), counts);
  }
  /// Degenerate: ZERO where both planes are met at once, everywhere for pieces of one plane. Proof: P-61
  Sign nearer(std::uint32_t f, std::uint32_t g, const Ray& r, Predicate_counts& counts) const {
    const Form &m = form(f), &n = form(g);
    const double value = (m.x - n.x) * r.x + (m.y - n.y) * r.y + (m.z - n.z) * r.z;
    const double bound = (m.size + n.size) * (2 * r.error + 0x1p-48 * r.size) + 0x1p-700;
    if (value > bound) return ++counts.filtered, CGAL::POSITIVE;
    if (value < -bound) return ++counts.filtered, CGAL::NEGATIVE;
    return nearer_unfiltered(f, g, r, counts);
  }
  Sign beyond(std::uint32_t f, std::uint32_t point, Predicate_counts& counts) const {
    const Form& m = form(f);
    const Approximate_vector d = approximate_direction(point);
    const double value = m.x * d.x + m.y * d.y + m.z * d.z - 1;
    const double bound = 0x1p-48 * (m.size * magnitude(d.x, d.y, d.z) + 1) + 0x1p-1000 * m.size;
    if (value > bound) return ++counts.filtered, CGAL::POSITIVE;
    if (value < -bound) return ++counts.filtered, CGAL::NEGATIVE;
    return beyond_unfiltered(f, point, counts);
  }
  bool same_plane(std::uint32_t f, std::uint32_t g) const {
    return scene_->pieces()[f].support.id() == scene_->pieces()[g].support.id();
  }

  /// The side of a point of the scene to a piece's plane.
  Sign side(std::uint32_t piece, std::uint32_t point, Predicate_counts& counts) const {
    const Predicates exact = predicates();
    const sightline::Plane support = scene_->pieces()[piece].support;
    return exact.side(exact.input_vertex(point, Vertex::no_plane, Vertex::no_plane, Vertex::no_plane),
                      exact.prepare(support), counts);
  }

  // ---- Exact values
  // ---------------------------------------------------------------------------------------------------------

  /// An integer vector along a ray.
  std::array<Integer, 3> direction(const Ray& r) const {
    std::array<Integer, 3> d =
        r.point != no_point ? point_direction<Integer>(r.point) : cross(normal<Integer>(r.p), normal<Integer>(r.q));
    if (r.flipped)
      for (Integer& x : d) x = -x;
    return d;
  }
  Exact_point position(std::uint32_t piece, const Ray& r) const {
    if (r.point != no_point && scene_->incidences().contains(r.point, scene_->pieces()[piece].support.id()))
      return scene_->position(r.point);
    // The plane n x + d w = 0 at eye + t r: t = -(n eye + d w) / (w n r), in grid coordinates.
    const std::array<Integer, 4> h = predicates().coefficients(scene_->pieces()[piece].support);
    const std::array<Integer, 3> v = direction(r);
    const Integer slope = h[0] * v[0] + h[1] * v[1] + h[2] * v[2], value = value_at_eye(h);
    std::array<Integer, 4> at{eye_.x * slope - value * v[0], eye_.y * slope - value * v[1],
                              eye_.z * slope - value * v[2], eye_.w * slope};
    return scene_->position(at);
  }

  // ---- Doubles for culling and for choices
  // ------------------------------------------------------------------------------------

  Approximate_eye_plane approximate(const Plane& w) const { return {{w.x, w.y, w.z}, w.size, w.error}; }
  double farthest(std::uint32_t piece, const Ray& r) const {
    const Form& m = form(piece);
    const double near = m.x * r.x + m.y * r.y + m.z * r.z - (m.size * (2 * r.error + 0x1p-48 * r.size) + 0x1p-700);
    const double length = std::sqrt(r.x * r.x + r.y * r.y + r.z * r.z) + 2 * r.error;
    const double far = length / near * box_units_ * (1 + 0x1p-40);
    return near > 0 && std::isfinite(far) ? far : std::numeric_limits<double>::infinity();
  }
  Approximate_vector approximate(const Ray& r) const { return {r.x, r.y, r.z}; }
  double nearness(std::uint32_t piece, const Approximate_vector& direction) const {
    const Form& m = form(piece);
    return m.x * direction.x + m.y * direction.y + m.z * direction.z;
  }

 private:
  struct Form {
    double x, y, z, size;  // each within 2^-50 of its own value; size infinite where they overflow
    int eye_side;
  };
  template <class Number>
  using Vector = std::array<Number, 3>;
  struct Wide_direction {
    Vector<Integer> exact;
    Approximate_vector approximate;
  };

  Predicates predicates() const { return scene_->predicates(); }
  static double magnitude(double x, double y, double z) {
    return (std::fabs(x) + std::fabs(y) + std::fabs(z)) * (1 + 0x1p-50);
  }
  template <class Number>
  static Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
    return {Number(a[1] * b[2] - a[2] * b[1]), Number(a[2] * b[0] - a[0] * b[2]), Number(a[0] * b[1] - a[1] * b[0])};
  }
  template <class Number>
  static Number dot(const Vector<Number>& a, const Vector<Number>& b) {
    return Number(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
  }
  static int signum(const Integer& n) { return sgn(n); }
  template <int L>
  static int signum(const Fixed_integer<L>& n) {
    return n.sign();
  }

  // ---- Construction
  // ---------------------------------------------------------------------------------------------------------

  /// How wide directions are, and how long.
  void measure() {
    const Grid_points& points = scene_->points();
    const auto bits_of = [](const Integer& n) { return static_cast<int>(bit_length(n)); };
    bits_ =
        1 + std::max(points.bits() + bits_of(eye_.w), std::max({bits_of(eye_.x), bits_of(eye_.y), bits_of(eye_.z)}));
    narrow_ = bits_ <= 62;
    width_ = bits_ <= 20 ? 2 : bits_ <= 41 ? 4 : bits_ <= 84 ? 8 : 0;
    if (narrow_) narrow_eye_ = {eye_.x.get_si(), eye_.y.get_si(), eye_.z.get_si(), eye_.w.get_si()};
    else wide_directions_ = Lazy_table<Wide_direction, 16>(points.size());
    Rational units(1, eye_.w * points.divisor());
    mpq_div_2exp(units.get_mpq_t(), units.get_mpq_t(), static_cast<mp_bitcnt_t>(points.shift()));
    if (!narrow_) mpq_mul_2exp(units.get_mpq_t(), units.get_mpq_t(), static_cast<mp_bitcnt_t>(bits_));
    box_units_ = nearest_double(units);
  }
  /// w p - eye. Pre: narrow.
  Vector<std::int64_t> narrow_direction(std::uint32_t p) const {
    const Grid_points& points = scene_->points();
    const auto& [x, y, z, w] = narrow_eye_;
    return {w * points.small(p, 0) - x, w * points.small(p, 1) - y, w * points.small(p, 2) - z};
  }
  /// The same where it is not.
  const Wide_direction& wide_direction(std::uint32_t point) const {
    return wide_directions_.at(point, [&](std::size_t i) {
      const Grid_points& points = scene_->points();
      const auto p = static_cast<std::uint32_t>(i);
      const Vector<Integer> d{eye_.w * points.integer(p, 0) - eye_.x, eye_.w * points.integer(p, 1) - eye_.y,
                              eye_.w * points.integer(p, 2) - eye_.z};
      return Wide_direction{d, {scaled(d[0], bits_), scaled(d[1], bits_), scaled(d[2], bits_)}};
    });
  }
  /// As doubles, at one scale for all points.
  Approximate_vector approximate_direction(std::uint32_t point) const {
    if (!narrow_) return wide_direction(point).approximate;
    const Vector<std::int64_t> d = narrow_direction(point);
    return {static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])};
  }
  /// q = -n / (n eye + d w) of a piece, and the eye's side.
  const Form& form(std::uint32_t piece) const {
    return forms_.at(piece, [&](std::size_t i) { return form_of(scene_->pieces()[i]); });
  }
  Form form_of(const Piece& piece) const {
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
    form.x = quotient(h[0]), form.y = quotient(h[1]), form.z = quotient(h[2]);
    form.size = magnitude(form.x, form.y, form.z);
    if (!std::isfinite(form.size)) form.x = form.y = form.z = 0, form.size = std::numeric_limits<double>::infinity();
    return form;
  }
  Integer value_at_eye(const std::array<Integer, 4>& h) const {
    return h[0] * eye_.x + h[1] * eye_.y + h[2] * eye_.z + h[3] * eye_.w;
  }

  static double scaled(const Integer& n, long shift) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, n.get_mpz_t());
    return std::ldexp(mantissa, static_cast<int>(std::clamp(exponent - shift, -5000L, 5000L)));
  }
  /// A normal as doubles, each within 2^-52 of its own value.
  static Plane from(const Vector<__int128>& n) {
    return with_size(static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2]));
  }
  static Plane from(const Vector<Integer>& n) {
    const long shift = static_cast<long>(std::max({bit_length(n[0]), bit_length(n[1]), bit_length(n[2])}));
    return with_size(scaled(n[0], shift), scaled(n[1], shift), scaled(n[2], shift));
  }
  static Plane with_size(double x, double y, double z) {
    const double size = magnitude(x, y, z);
    return {x, y, z, size, 0x1p-52 * size + 0x1p-1060, {}, false};
  }

  // ---- Exact stages
  // ---------------------------------------------------------------------------------------------------------

  template <class Number>
  Vector<Number> point_direction(std::uint32_t p) const {
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
  Vector<Number> normal_of(std::uint32_t p, std::uint32_t q) const {
    return cross(point_direction<Number>(p), point_direction<Number>(q));
  }

  /// The canonical normal of a name. Pre: a fixed width only for planes of edges and axes.
  template <class Number>
  Vector<Number> normal(Eye_plane_name name) const {
    if (name.is_edge()) return normal_of<Number>(name.a, name.b);
    if constexpr (std::is_same_v<Number, Integer>) {
      if (name.kind() == Eye_plane_name::field_kind) return field_[name.index()];
      if (name.kind() == Eye_plane_name::crossing_kind) return crossing_normal(name.index(), name.b);
    }
    return {Number(name.index() == 0 ? 1 : 0), Number(name.index() == 1 ? 1 : 0), Number(name.index() == 2 ? 1 : 0)};
  }
  /// A positive multiple of q_f - q_g.
  Vector<Integer> crossing_normal(std::uint32_t f, std::uint32_t g) const {
    const Predicates exact = predicates();
    const std::array<Integer, 4> m = exact.coefficients(scene_->pieces()[f].support),
                                 n = exact.coefficients(scene_->pieces()[g].support);
    const Integer at_m = value_at_eye(m), at_n = value_at_eye(n);
    const int sign = sgn(at_m) * sgn(at_n);
    Vector<Integer> difference;
    for (std::size_t k = 0; k < 3; ++k) difference[k] = sign * (at_m * n[k] - at_n * m[k]);
    return difference;
  }
  template <class Number>
  int side_in(const Plane& w, const Ray& r) const {
    const Vector<Number> n = normal<Number>(w.name);
    const Vector<Number> v =
        r.point != no_point ? point_direction<Number>(r.point) : cross(normal<Number>(r.p), normal<Number>(r.q));
    return signum(dot(n, v)) * (w.flipped != r.flipped ? -1 : 1);
  }
  static bool is_fixed(Eye_plane_name name) { return name.is_edge() || name.kind() == Eye_plane_name::axis_kind; }

  [[gnu::noinline]] Sign side_unfiltered(const Plane& w, const Ray& r, Predicate_counts& counts) const {
    if (r.point != no_point ? w.name.has_point(r.point) : w.name == r.p || w.name == r.q)
      return ++counts.combinatorial, CGAL::ZERO;
    if (width_ != 0 && is_fixed(w.name) && (r.point != no_point || (is_fixed(r.p) && is_fixed(r.q)))) {
      ++counts.fixed;
      return static_cast<Sign>(width_ == 2   ? side_in<Fixed_integer<2>>(w, r)
                               : width_ == 4 ? side_in<Fixed_integer<4>>(w, r)
                                             : side_in<Fixed_integer<8>>(w, r));
    }
    ++counts.gmp;
    return static_cast<Sign>(side_in<Integer>(w, r));
  }
  [[gnu::noinline]] Sign nearer_unfiltered(std::uint32_t f, std::uint32_t g, const Ray& r,
                                           Predicate_counts& counts) const {
    if (same_plane(f, g)) return ++counts.combinatorial, CGAL::ZERO;
    // On the line of both planes where the ray is of a point, or of an edge, that both hold.
    const auto on_both = [&](std::uint32_t point) {
      return side(f, point, counts) == CGAL::ZERO && side(g, point, counts) == CGAL::ZERO;
    };
    const auto edge_on_both = [&](Eye_plane_name name) { return name.is_edge() && on_both(name.a) && on_both(name.b); };
    if (r.point != no_point ? on_both(r.point) : edge_on_both(r.p) || edge_on_both(r.q))
      return ++counts.combinatorial, CGAL::ZERO;
    const Eye_plane_name name = Eye_plane_name::crossing(f, g);
    if (r.point == no_point && (r.p == name || r.q == name)) return ++counts.combinatorial, CGAL::ZERO;
    ++counts.gmp;
    return static_cast<Sign>(sgn(dot(crossing_normal(f, g), direction(r))));
  }
  [[gnu::noinline]] Sign beyond_unfiltered(std::uint32_t f, std::uint32_t point, Predicate_counts& counts) const {
    return static_cast<Sign>(-side(f, point, counts) * form(f).eye_side);
  }
  /// The ray of a point, or the one against it, whichever goes the way of r.
  Ray along(std::uint32_t point, const Ray& r, Predicate_counts& counts) const {
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

  const Scene* scene_;
  Exact_point eye_point_;
  Located_point eye_;
  std::vector<Vector<Integer>> field_;
  int bits_ = 0, width_ = 0;  // of directions; in limbs, 0: GMP
  bool narrow_ = true;
  double box_units_ = 1;                            // the length of a direction's unit in approximate coordinates
  std::array<std::int64_t, 4> narrow_eye_{};        // where narrow
  Lazy_table<Wide_direction, 16> wide_directions_;  // where not
  Lazy_table<Form, 16> forms_;
};

static_assert(View<Exact_view>);

/// The normals of the sides of a cone that rays span, for Exact_view's field of view.
/// Pre: each three rays in this order turn one way, and all are within less than a half space: or
/// std::invalid_argument. Exact: yes
inline std::vector<std::array<Integer, 3>> field_of(const std::vector<Exact_point>& rays) {
  std::vector<std::array<Integer, 3>> normals;
  const std::size_t n = rays.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Exact_point &a = rays[k], &b = rays[(k + 1) % n];
    Exact_point normal;
    for (std::size_t i = 0; i < 3; ++i) normal[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    Integer common = lcm(lcm(normal[0].get_den(), normal[1].get_den()), normal[2].get_den());
    std::array<Integer, 3>& row = normals.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) row[i] = normal[i].get_num() * (common / normal[i].get_den());
    for (std::size_t j = 0; j < n; ++j)
      if (j != k && j != (k + 1) % n &&
          sgn(Rational(row[0] * rays[j][0] + row[1] * rays[j][1] + row[2] * rays[j][2])) <= 0)
        throw std::invalid_argument(
            "the rays of a field of view must span a convex cone, counterclockwise around its inside");
  }
  if (n < 3) throw std::invalid_argument("a field of view wants three rays or more");
  return normals;
}

}  // namespace sightline
