#pragma once
// Doubles at random, the same with every standard library.

#include <algorithm>
#include <random>

namespace sightline {

/// Doubles from `low` on and below `high` (or `high` where rounding leads there), for samples and proposals. They are
/// those of libstdc++'s std::uniform_real_distribution, which takes two logarithms for each of them.
class Uniform {
 public:
  Uniform(double low, double high) : low_(low), width_(high - low) {}
  double operator()(std::mt19937_64& dice) const {
    const double share = std::min(static_cast<double>(dice()) * 0x1p-64, 1 - 0x1p-53);
    return share * width_ + low_;
  }

 private:
  double low_, width_;
};

}  // namespace sightline
