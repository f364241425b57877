#include <sightline/algorithms/weak_visibility/events/event_cells.h>

#include <sightline/kernel/number.h>

namespace sightline {

Exact_pluecker moved(const Event_chart& chart, const Event_move& move, const Rational& t) {
  std::array<Rational, 4> along;
  for (std::size_t k = 0; k < 4; ++k) along[k] = t * move.first[k];
  along[2] += t * t * move.second;
  const Over_common<4> over(along);
  const std::array<Integer, 4>& by = over.whole;
  const auto point = [&](const Homogeneous& from, const Integer& by_r, const Integer& by_n) {
    Homogeneous x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = over.denominator * from[k] + by_r * chart.r[k] + by_n * chart.n[k];
    return x;
  };
  return join(point(chart.v, by[0], by[2]), point(chart.w, by[1], by[3]));
}

namespace event_cells_detail {

std::vector<Rational> numbers_between(std::vector<Rational> at) {
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  if (at.empty()) return {Rational(0)};
  std::vector<Rational> between{Rational(at.front() - 1)};
  for (std::size_t k = 0; k + 1 < at.size(); ++k) between.push_back(Rational((at[k] + at[k + 1]) / 2));
  between.push_back(Rational(at.back() + 1));
  return between;
}

Form rounded(const Form& a, long bits) {
  long cut = -bits;
  for (const Integer& x : a) cut = std::max(cut, static_cast<long>(bit_length(x)) - bits);
  Form result;
  for (std::size_t k = 0; k < 3; ++k)
    result[k] =
        cut > 0 ? Integer(a[k] >> static_cast<unsigned long>(cut)) : Integer(a[k] << static_cast<unsigned long>(-cut));
  return result;
}

std::array<Rational, 3> inner_point(const std::vector<Form>& forms, const std::vector<int>& signs, const Form& ray,
                                    const Form& beside) {
  for (long bits = 16;; bits *= 2) {  // rounding moves the point by 2^-bits, the side by 2^(-bits / 2)
    const Form far = rounded(ray, bits), aside = rounded(beside, bits);
    Form point;
    for (std::size_t k = 0; k < 3; ++k) point[k] = (far[k] << static_cast<unsigned long>(bits / 2)) + aside[k];
    bool inside = true;
    for (std::size_t k = 0; k < forms.size() && inside; ++k) inside = sgn(dot(forms[k], point)) == signs[k];
    if (!inside) continue;
    std::array<Rational, 3> scaled;
    for (std::size_t k = 0; k < 3; ++k) {
      scaled[k] = Rational(point[k], Integer(1) << static_cast<unsigned long>(bits + bits / 2 + 1));
      scaled[k].canonicalize();
    }
    return scaled;
  }
}

}  // namespace event_cells_detail
}  // namespace sightline
