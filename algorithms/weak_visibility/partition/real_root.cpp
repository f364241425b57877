#include <sightline/algorithms/weak_visibility/partition/real_root.h>

#include <sightline/kernel/time_limit.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace sightline {
namespace {

void trim(Polynomial& f) {
  while (!f.empty() && sgn(f.back()) == 0) f.pop_back();
}

/// Divided by the common factor of its coefficients.
void make_primitive(Polynomial& f) {
  Integer common = 0;
  for (const Integer& c : f) common = gcd(common, c);
  if (common > 1)
    for (Integer& c : f) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), common.get_mpz_t());
}

int sign_at(const Polynomial& f, const Rational& x) {
  const Integer &n = x.get_num(), &d = x.get_den();
  Integer sum = f.back(), power = 1;
  for (std::size_t k = f.size() - 1; k-- > 0;) {
    power *= d;
    sum = sum * n + f[k] * power;
  }
  return sgn(sum);
}

/// The remainder of a times a power of b's first coefficient.
Polynomial remainder(Polynomial a, const Polynomial& b) {
  while (a.size() >= b.size()) {
    const Integer top = a.back();
    for (Integer& c : a) c *= b.back();
    for (std::size_t k = 0; k < b.size(); ++k) a[a.size() - b.size() + k] -= top * b[k];
    trim(a);
  }
  return a;
}

Polynomial common_divisor(Polynomial a, Polynomial b) {
  while (!b.empty()) {
    make_primitive(b);
    Polynomial rest = remainder(std::move(a), b);
    a = std::move(b);
    b = std::move(rest);
  }
  make_primitive(a);
  return a;
}

/// Pre: b divides a, both primitive.
Polynomial quotient(Polynomial a, const Polynomial& b) {
  Polynomial q(a.size() - b.size() + 1);
  for (std::size_t k = q.size(); k-- > 0;) {
    mpz_divexact(q[k].get_mpz_t(), a[k + b.size() - 1].get_mpz_t(), b.back().get_mpz_t());
    for (std::size_t i = 0; i < b.size(); ++i) a[k + i] -= q[k] * b[i];
  }
  return q;
}

Polynomial square_free(Polynomial f) {
  Polynomial slope;
  for (std::size_t k = 1; k < f.size(); ++k) slope.push_back(f[k] * static_cast<unsigned long>(k));
  const Polynomial common = common_divisor(f, std::move(slope));
  return common.size() > 1 ? quotient(std::move(f), common) : f;
}

/// Coefficients of f in Bernstein's basis over [low, high], times a positive number. Pre: low and high are dyadic.
Polynomial bernstein(const Polynomial& f, const Rational& low, const Rational& high) {
  const std::size_t n = f.size() - 1;
  const Integer scale = lcm(low.get_den(), high.get_den());
  const Integer from = low.get_num() * (scale / low.get_den()),
                width = high.get_num() * (scale / high.get_den()) - from;
  // f(x + low) for x = width t, by Horner's rule.
  Polynomial g(n + 1);
  Integer power = 1;
  for (std::size_t k = n + 1; k-- > 0;) {
    for (std::size_t i = n; i > 0; --i) g[i] = g[i] * from + g[i - 1] * width;
    g[0] = g[0] * from + f[k] * power;
    power *= scale;
  }
  // b[j] = sum of C(j, i) / C(n, i) g[i]; times n!.
  std::vector<Integer> factorial(n + 1, Integer(1));
  for (std::size_t k = 1; k <= n; ++k) factorial[k] = factorial[k - 1] * static_cast<unsigned long>(k);
  Polynomial b(n + 1);
  for (std::size_t j = 0; j <= n; ++j)
    for (std::size_t i = 0; i <= j; ++i) b[j] += factorial[j] / factorial[j - i] * factorial[n - i] * g[i];
  return b;
}

int variations(const Polynomial& b) {
  int count = 0, last = 0;
  for (const Integer& c : b) {
    const int s = sgn(c);
    count += s * last < 0;
    if (s != 0) last = s;
  }
  return count;
}

/// The roots strictly between, of a square-free polynomial.
void isolate(const std::shared_ptr<const Polynomial>& f, Polynomial b, const Rational& low, const Rational& high,
             std::vector<Real_root>& roots) {
  const int count = variations(b);
  if (count == 0) return;
  if (count == 1) {
    const int from = sgn(*std::find_if(b.begin(), b.end(), [](const Integer& c) { return sgn(c) != 0; }));
    roots.emplace_back(f, low, high, from);
    return;
  }
  // De Casteljau at the middle; everything times 2^n.
  const std::size_t n = b.size() - 1;
  Polynomial left(n + 1), right(n + 1);
  for (std::size_t step = 0; step <= n; ++step) {
    left[step] = b[0] << (n - step);
    right[n - step] = b[n - step] << (n - step);
    for (std::size_t k = 0; k + step < n; ++k) b[k] += b[k + 1];
  }
  const Rational middle = (low + high) / 2;
  const bool exact = sgn(left[n]) == 0;
  isolate(f, std::move(left), low, middle, roots);
  if (exact) roots.emplace_back(middle);
  isolate(f, std::move(right), middle, high, roots);
}

std::size_t count_roots(const Polynomial& f, const Rational& low, const Rational& high) {
  std::vector<Real_root> roots;
  append_real_roots(f, low, high, roots);
  return roots.size();
}

}  // namespace

void Real_root::refine() {
  if (is_rational()) return;
  Rational middle = (low_ + high_) / 2;
  const int sign = sign_at(*f_, middle);
  if (sign == 0) {
    f_ = nullptr;
    low_ = high_ = std::move(middle);
  } else (sign == from_ ? low_ : high_) = std::move(middle);
}

void Real_root::refine_to(unsigned long bits) {
  const Rational least(Integer(1), Integer(1) << bits);
  while (!is_rational() && high_ - low_ > least) refine();
}

int compare(Real_root& a, Real_root& b) {
  constexpr int tries = 24;
  std::optional<Polynomial> common;  // once it is asked for
  for (int round = 0;; ++round) {
    if (a.is_rational() && b.is_rational()) return cmp(a.low_, b.low_) < 0 ? -1 : cmp(a.low_, b.low_) > 0;
    // The interval of what is not rational is open.
    if (a.high_ <= b.low_) return -1;
    if (b.high_ <= a.low_) return 1;
    if (a.is_rational()) {
      if (sign_at(*b.f_, a.low_) == 0) return 0;
      b.refine();
    } else if (b.is_rational()) {
      if (sign_at(*a.f_, b.low_) == 0) return 0;
      a.refine();
    } else {
      if (round >= tries) {
        if (!common) common = common_divisor(*a.f_, *b.f_);
        if (common->size() > 1 && count_roots(*common, a.low_, a.high_) == 1 &&
            count_roots(*common, b.low_, b.high_) == 1 &&
            count_roots(*common, std::min(a.low_, b.low_), std::max(a.high_, b.high_)) == 1)
          return 0;
      }
      (a.high_ - a.low_ > b.high_ - b.low_ ? a : b).refine();
    }
  }
}

void append_real_roots(Polynomial f, const Rational& low, const Rational& high, std::vector<Real_root>& roots) {
  trim(f);
  if (f.size() < 2) return;
  make_primitive(f);
  if (f.size() == 2) {
    Rational root(-f[0], f[1]);
    root.canonicalize();
    if (low < root && root < high) roots.emplace_back(std::move(root));
    return;
  }
  if (variations(bernstein(f, low, high)) == 0) return;
  const auto free = std::make_shared<const Polynomial>(square_free(std::move(f)));
  if (free->size() == 2) return append_real_roots(*free, low, high, roots);
  isolate(free, bernstein(*free, low, high), low, high, roots);
}

bool sort_distinct(std::vector<Real_root>& roots, const std::function<bool()>& out_of_time) {
  std::sort(roots.begin(), roots.end(),
            [](const Real_root& a, const Real_root& b) { return cmp(a.low() + a.high(), b.low() + b.high()) < 0; });
  // Nearly in order: by insertion, equal ones left out.
  std::vector<Real_root> sorted;
  for (Real_root& root : roots) {
    if (has_run_out(out_of_time)) return false;
    std::size_t at = sorted.size();
    int order = 1;
    while (at > 0 && (order = compare(root, sorted[at - 1])) < 0) --at;
    if (at > 0 && order == 0) continue;
    sorted.insert(sorted.begin() + static_cast<std::ptrdiff_t>(at), std::move(root));
  }
  roots = std::move(sorted);
  return true;
}

Rational between(Real_root& a, Real_root& b) {
  while (a.high() >= b.low()) {  // equal ends of open intervals
    a.refine();
    b.refine();
  }
  const Rational &low = a.high(), &high = b.low();
  // The finest dyadic grid that has a point strictly between, near the middle.
  for (unsigned long bits = 0;; ++bits) {
    Integer k;
    const Rational scaled = (low + high) / 2 * Rational(Integer(1) << bits);
    mpz_fdiv_q(k.get_mpz_t(), scaled.get_num_mpz_t(), scaled.get_den_mpz_t());
    for (const Integer& at : {k, Integer(k + 1)}) {
      Rational found(at, Integer(1) << bits);
      found.canonicalize();
      if (low < found && found < high) return found;
    }
  }
}

}  // namespace sightline
