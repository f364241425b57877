#include <sightline/algorithms/weak_visibility/line_space.h>

#include <utility>

namespace sightline {

double near_quotient(const Integer& p, const Integer& w, long exponent) {
  if (sgn(p) == 0) return 0;
  const long shift =
      63 + static_cast<long>(mpz_sizeinbase(w.get_mpz_t(), 2)) - static_cast<long>(mpz_sizeinbase(p.get_mpz_t(), 2));
  thread_local Integer shifted, quotient;
  if (shift >= 0) {
    mpz_mul_2exp(shifted.get_mpz_t(), p.get_mpz_t(), static_cast<mp_bitcnt_t>(shift));
    mpz_tdiv_q(quotient.get_mpz_t(), shifted.get_mpz_t(), w.get_mpz_t());
  } else {
    mpz_mul_2exp(shifted.get_mpz_t(), w.get_mpz_t(), static_cast<mp_bitcnt_t>(-shift));
    mpz_tdiv_q(quotient.get_mpz_t(), p.get_mpz_t(), shifted.get_mpz_t());
  }
  const double size =
      std::ldexp(static_cast<double>(mpz_getlimbn(quotient.get_mpz_t(), 0)), static_cast<int>(-shift - exponent));
  return sgn(p) < 0 ? -size : size;
}

double Near_frame::rest(const Integer& p, const Integer& w, double near) const {
  if (near == 0 || !std::isfinite(near)) return 0;
  // near = mantissa 2^e; what is left of p / (w 2^shift), over the same.
  int e = 0;
  const Integer mantissa(std::ldexp(std::frexp(near, &e), 53));
  const long power = e - 53 + shift_;
  const Integer below = w * divisor_;
  Integer left = mantissa * below, p_there = p;
  if (power >= 0) left <<= static_cast<mp_bitcnt_t>(power);
  else p_there <<= static_cast<mp_bitcnt_t>(-power);
  left = p_there - left;
  return near_quotient(left, below, shift_ + std::max(0L, -power));
}

Rational Near_frame::near_cubic(const Integer& p, const Integer& w) const {
  Rational value(p, over(w));
  value.canonicalize();
  return times_power(std::move(value), -3 * shift_);
}

double Near_frame::near_cubic(const Integer& p, const Integer& w, long exponent) const {
  return near_quotient(p, over(w), 3 * shift_ - exponent);
}

long Near_frame::exponent_of_cubic(const Integer& p, const Integer& w) const {
  return static_cast<long>(bit_length(p)) - static_cast<long>(bit_length(over(w))) + 1 - 3 * shift_;
}

Near_point near_point(const Near_frame& frame, std::array<Integer, 4> exact) {
  const Integer common = gcd(gcd(exact[0], exact[1]), gcd(exact[2], exact[3]));
  Near_point p;
  for (std::size_t k = 0; k < 4; ++k) p.exact[k] = exact[k] / common;
  for (std::size_t k = 0; k < 3; ++k) {
    p.near[k] = frame.near(p.exact[k], p.exact[3]);
    p.rest[k] = frame.rest(p.exact[k], p.exact[3], p.near[k]);
  }
  return p;
}

Triple weighted_mean(const Near_polygon& polygon, const std::vector<double>& weights) {
  Triple p{};
  for (std::size_t i = 0; i < polygon.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) p[k] += weights[i] * polygon[i].near[k];
  return p;
}

Near_plane near_plane(const Near_frame& frame, const std::array<Integer, 4>& exact) {
  Near_plane h{exact, {}};
  const Integer size = std::max({Integer(abs(exact[0])), Integer(abs(exact[1])), Integer(abs(exact[2]))});
  for (std::size_t k = 0; k < 3; ++k) h.near[k] = near_quotient(exact[k], size, 0);
  h.near[3] = frame.near(exact[3], size);
  return h;
}

int likely_side(const Near_plane& h, const Triple& p) {
  double value = h.near[3], size = std::fabs(h.near[3]), reach = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double product = h.near[k] * p[k];
    value += product;
    size += std::fabs(product);
    reach += std::fabs(p[k]);
  }
  const double bound = 0x1p-49 * size + 0x1p-1000 * reach;
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

int side(const Near_plane& h, const Near_point& p) {
  if (const int s = likely_side(h, p.near); s != 0) return s;
  thread_local Integer sum;
  mpz_mul(sum.get_mpz_t(), h.exact[0].get_mpz_t(), p.exact[0].get_mpz_t());
  for (std::size_t k = 1; k < 4; ++k) mpz_addmul(sum.get_mpz_t(), h.exact[k].get_mpz_t(), p.exact[k].get_mpz_t());
  return sgn(sum);
}

int side(const Near_plane& h, const Near_polygon& polygon) {
  bool front = false, behind = false;
  for (const Near_point& p : polygon) {
    const int s = side(h, p);
    front |= s > 0;
    behind |= s < 0;
  }
  return front && behind ? both_sides : front ? 1 : behind ? -1 : 0;
}

Near_polygon clip(const Near_frame& frame, const Near_polygon& polygon, const Near_plane& h, bool front) {
  std::vector<int> sides;
  for (const Near_point& p : polygon) sides.push_back(front ? side(h, p) : -side(h, p));
  if (std::none_of(sides.begin(), sides.end(), [](int s) { return s > 0; })) return {};
  Near_polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    if (sides[i] >= 0) part.push_back(polygon[i]);
    if (sides[i] * sides[next] >= 0) continue;
    // Where the edge crosses the plane: |h(q)| p + |h(p)| q, each taken with its weight.
    const Integer at = abs(value(h, polygon[i])), after = abs(value(h, polygon[next]));
    std::array<Integer, 4> crossing;
    for (std::size_t k = 0; k < 4; ++k) crossing[k] = after * polygon[i].exact[k] + at * polygon[next].exact[k];
    part.push_back(near_point(frame, crossing));
  }
  return part;
}

Pluecker pluecker_of_pair(const Triple& p, const Triple& q) {
  return {p[2] * q[1] - p[1] * q[2],
          p[0] * q[2] - p[2] * q[0],
          p[1] * q[0] - p[0] * q[1],
          p[0] - q[0],
          p[1] - q[1],
          p[2] - q[2]};
}

std::vector<Pluecker> pairs_of(const Near_polygon& source, const Near_polygon& target) {
  std::vector<Pluecker> pairs;
  pairs.reserve(source.size() * target.size());
  for (const Near_point& p : source)
    for (const Near_point& q : target) pairs.push_back(pluecker_of_pair(p.near, q.near));
  return pairs;
}

Pluecker pluecker_of_edge(const Triple& a, const Triple& b) {
  return {b[0] - a[0],
          b[1] - a[1],
          b[2] - a[2],
          a[1] * b[2] - a[2] * b[1],
          a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

Exact_pluecker pluecker_of_edge(const std::array<Integer, 3>& a, const std::array<Integer, 3>& b) {
  return {b[0] - a[0],
          b[1] - a[1],
          b[2] - a[2],
          a[1] * b[2] - a[2] * b[1],
          a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

Exact_pluecker pluecker_of_pair(const std::array<Integer, 4>& p, const std::array<Integer, 4>& q) {
  return {p[2] * q[1] - p[1] * q[2], p[0] * q[2] - p[2] * q[0], p[1] * q[0] - p[0] * q[1],
          p[0] * q[3] - q[0] * p[3], p[1] * q[3] - q[1] * p[3], p[2] * q[3] - q[2] * p[3]};
}

}  // namespace sightline
