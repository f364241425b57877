#include <sightline/algorithms/levels/common_inside.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <random>
#include <span>

namespace sightline {

namespace {

using Numbers = std::vector<Rational>;

Rational dot_of(const Numbers& a, const Numbers& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), Rational(0));
}

/// factors x <= most
struct Constraint {
  Numbers factors;
  Rational most;
};

/// Unknowns between two ends each, of which factors x shall be as large as can be.
struct Program {
  Numbers factors, low, high;
};

/// What is left of a program where a constraint holds with equality: its k-th unknown follows from the others.
class Eliminated {
 public:
  Eliminated(const Constraint& equality, std::size_t k) : equality_(equality), k_(k) {}

  /// The same form in the others: of factors and what they are compared to.
  void put_in(Numbers& factors, Rational& most) const {
    const Rational share = factors[k_] / equality_.factors[k_];
    for (std::size_t i = 0; i < factors.size(); ++i) factors[i] -= share * equality_.factors[i];
    most -= share * equality_.most;
    erase(factors);
  }
  void erase(Numbers& numbers) const { numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(k_)); }
  /// With the unknown that follows from the others.
  void complete(Numbers& x) const {
    Numbers others = equality_.factors;
    erase(others);
    const Rational own = (equality_.most - dot_of(others, x)) / equality_.factors[k_];
    x.insert(x.begin() + static_cast<std::ptrdiff_t>(k_), own);
  }

 private:
  const Constraint& equality_;
  std::size_t k_;
};

/// A best point; nothing where there is none.
std::optional<Numbers> best_point(const Program& program, std::span<const Constraint> constraints) {
  // 1. Without constraints.
  Numbers x = program.low;
  for (std::size_t k = 0; k < x.size(); ++k)
    if (program.factors[k] > 0) x[k] = program.high[k];
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const Constraint& next = constraints[i];
    if (dot_of(next.factors, x) <= next.most) continue;
    // 2. Where the next one does not hold, it holds with equality at the best point.
    const auto used = std::find_if(next.factors.begin(), next.factors.end(), [](const Rational& f) { return f != 0; });
    if (used == next.factors.end()) return std::nullopt;
    const auto k = static_cast<std::size_t>(used - next.factors.begin());
    const Eliminated eliminated(next, k);
    Program rest = program;
    Rational ignored = 0;
    eliminated.put_in(rest.factors, ignored);
    eliminated.erase(rest.low);
    eliminated.erase(rest.high);
    std::vector<Constraint> before(constraints.begin(), constraints.begin() + static_cast<std::ptrdiff_t>(i));
    for (const int sign : {1, -1}) {  // the ends of the unknown that goes
      Constraint& end = before.emplace_back(Constraint{Numbers(x.size(), 0), program.high[k]});
      end.factors[k] = sign;
      if (sign < 0) end.most = -program.low[k];
    }
    for (Constraint& one : before) eliminated.put_in(one.factors, one.most);
    std::optional<Numbers> found = best_point(rest, before);
    if (!found) return std::nullopt;
    x = *std::move(found);
    eliminated.complete(x);
  }
  return x;
}

}  // namespace

bool have_common_inside(const std::vector<Exact_plane>& planes, const std::array<Exact_point, 2>& box) {
  // As far as the planes' normals are long, and 1 at most: a x + b y + c z + d + t <= 0.
  std::vector<Constraint> constraints;
  for (const Exact_plane& h : planes) constraints.push_back({{h[0], h[1], h[2], 1}, -h[3]});
  std::shuffle(constraints.begin(), constraints.end(), std::mt19937(1));
  Program program{{0, 0, 0, 1}, {box[0].begin(), box[0].end()}, {box[1].begin(), box[1].end()}};
  program.low.emplace_back(0);
  program.high.emplace_back(1);
  const std::optional<Numbers> found = best_point(program, constraints);
  return found && found->back() > 0;
}

}  // namespace sightline
