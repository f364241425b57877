#pragma once
// Which faces can be on-view together: all sets that viewpoints of space have, found exactly from the faces' planes.
// Laws, tested: an eye has one of the sets on-view, the sample of a set that set; n planes in general position give 1 +
// n + n (n - 1) / 2 + n (n - 1) (n - 2) / 6 sets, all of them open; faces of a convex body with an inside have open
// sets only.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace sightline {

/// Planes beyond these are refused: sets of faces are bits of 32, and trees of tests end earlier.
inline constexpr std::size_t most_view_faces = 24;

/// A set of faces that some eye has on-view, and no others.
struct View_cell {
  std::uint32_t on_view;  ///< bit k: face k
  bool open;              ///< some open set of eyes has it; else only eyes in planes do
  Exact_point sample;     ///< such an eye, strictly off all planes if `open`
};

/// The faces of the planes a x + b y + c z + d = 0, fronts where that is positive, that an eye has on-view. In the
/// plane counts as off-view. Pre: at most 32. Exact: yes
std::uint32_t on_view_from(std::span<const std::array<Rational, 4>> planes, const Exact_point& eye);

namespace view_cells_detail {

/// An affine form on a space of some dimension: its coefficients, then its constant.
template <std::size_t dimension>
using Form = std::array<Rational, dimension + 1>;
template <std::size_t dimension>
using Point = std::array<Rational, dimension>;

template <std::size_t dimension>
Rational value(const Form<dimension>& form, const Point<dimension>& p) {
  Rational sum = form[dimension];
  for (std::size_t k = 0; k < dimension; ++k) sum += form[k] * p[k];
  return sum;
}
/// The change of the form along a vector.
template <std::size_t dimension>
Rational slope(const Form<dimension>& form, const Point<dimension>& v) {
  Rational sum = 0;
  for (std::size_t k = 0; k < dimension; ++k) sum += form[k] * v[k];
  return sum;
}
template <std::size_t dimension>
bool is_constant(const Form<dimension>& form) {
  return std::all_of(form.begin(), form.end() - 1, [](const Rational& c) { return sgn(c) == 0; });
}
template <std::size_t dimension>
bool is_zero(const Form<dimension>& form) {
  return is_constant<dimension>(form) && sgn(form[dimension]) == 0;
}

/// The hyperplane where a form is zero, as a space of its own: the last variable that the form has is eliminated. Pre:
/// the form is not constant.
template <std::size_t dimension>
class Hyperplane {
 public:
  explicit Hyperplane(const Form<dimension>& form) : form_(form), gone_(dimension - 1) {
    while (sgn(form[gone_]) == 0) --gone_;
  }
  Form<dimension - 1> restricted(const Form<dimension>& other) const {
    const Rational factor = other[gone_] / form_[gone_];
    Form<dimension - 1> result;
    for (std::size_t k = 0; k <= dimension; ++k)
      if (k != gone_) result[k - (k > gone_)] = other[k] - factor * form_[k];
    return result;
  }
  Point<dimension> lifted(const Point<dimension - 1>& p) const {
    Point<dimension> result;
    Rational rest = form_[dimension];
    for (std::size_t k = 0; k < dimension; ++k)
      if (k != gone_) {
        result[k] = p[k - (k > gone_)];
        rest += form_[k] * result[k];
      }
    result[gone_] = -rest / form_[gone_];
    return result;
  }

 private:
  const Form<dimension> form_;
  std::size_t gone_;
};

/// Sets of forms that are positive, each with a point.
template <std::size_t dimension>
using Cells = std::map<std::uint32_t, Point<dimension>>;

/// A power of two t such that p + t v and p - t v are on p's side of all forms that are not zero at p. Keeps samples
/// short: what they grow from is one dimension lower.
template <std::size_t dimension>
Rational short_step(std::span<const Form<dimension>> forms, const Point<dimension>& p, const Point<dimension>& v) {
  long exponent = 0;
  for (const Form<dimension>& form : forms) {
    const Rational at_p = value<dimension>(form, p), along_v = slope<dimension>(form, v);
    if (sgn(at_p) == 0 || sgn(along_v) == 0) continue;
    const Rational reach =
        abs(at_p) / abs(along_v);  // at least 2^(difference of lengths - 1), and 2^(that - 1) is less
    exponent = std::min(exponent, binary_exponent(reach) - 2);
  }
  Rational step = 1;
  mpq_div_2exp(step.get_mpq_t(), step.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  return step;
}

/// The open cells of an arrangement: the components of what its hyperplanes leave, each by the forms that are positive
/// in it, with a point of it. Constant forms count by their signs. Hyperplanes are added one at a time. The cells that
/// a new one cuts are those that meet it, and it meets them in the open cells of the earlier ones within it. Proof:
/// P-52
template <std::size_t dimension>
Cells<dimension> open_cells(std::span<const Form<dimension>> forms, const std::function<void()>& ask = {}) {
  Cells<dimension> cells;
  cells[0] = Point<dimension>{};
  for (std::size_t k = 0; k < forms.size(); ++k) {
    if (ask) ask();
    Cells<dimension> next;
    if constexpr (dimension > 0) {
      if (!is_constant<dimension>(forms[k])) {
        const Hyperplane<dimension> hyperplane(forms[k]);
        std::vector<Form<dimension - 1>> earlier;
        bool is_new = true;
        for (std::size_t j = 0; j < k; ++j) {
          earlier.push_back(hyperplane.restricted(forms[j]));
          is_new = is_new && (!is_zero<dimension - 1>(earlier[j]) || is_zero<dimension>(forms[j]));
        }
        Point<dimension> normal;
        std::copy_n(forms[k].begin(), dimension, normal.begin());
        if (is_new)
          for (const auto& [on, below] : open_cells<dimension - 1>(earlier, ask)) {
            const Point<dimension> p = hyperplane.lifted(below);
            const Rational step = short_step<dimension>(forms.first(k), p, normal);
            for (const int side : {1, -1}) {
              Point<dimension>& q = next[side > 0 ? on | 1u << k : on];
              for (std::size_t i = 0; i < dimension; ++i) q[i] = p[i] + side * step * normal[i];
            }
            cells.erase(on);
          }
      }
    }
    for (const auto& [on, p] : cells) next[sgn(value<dimension>(forms[k], p)) > 0 ? on | 1u << k : on] = p;
    cells = std::move(next);
  }
  return cells;
}

/// The sets of forms that are positive at points of space, with points of open cells where there are some: first the
/// open cells, then those within each hyperplane. A point of several hyperplanes is met in the order of their forms, so
/// only later ones need be taken. Where no form is positive in some open cell, all sets are those of open cells. Proof:
/// P-52
template <std::size_t dimension>
Cells<dimension> all_cells(std::span<const Form<dimension>> forms, std::size_t first,
                           const std::function<void()>& ask = {}) {
  Cells<dimension> cells = open_cells<dimension>(forms, ask);
  if (cells.contains(0)) return cells;
  if constexpr (dimension > 0)
    for (std::size_t k = first; k < forms.size(); ++k) {
      if (is_constant<dimension>(forms[k])) continue;
      const Hyperplane<dimension> hyperplane(forms[k]);
      std::vector<Form<dimension - 1>> restricted;
      for (const Form<dimension>& form : forms) restricted.push_back(hyperplane.restricted(form));
      for (const auto& [on, p] : all_cells<dimension - 1>(restricted, k + 1, ask))
        if (!cells.contains(on)) cells.emplace(on, hyperplane.lifted(p));
    }
  return cells;
}

}  // namespace view_cells_detail

/// All sets of faces that viewpoints of space have on-view, in the order of the sets as numbers. The planes (a, b, c,
/// d) of the faces have their fronts where a x + b y
/// + c z + d > 0.
/// Errors: std::invalid_argument for a plane without a normal, and for more than most_view_faces planes.
/// Degenerate: planes may coincide in either sense, be parallel, and meet many at a time; no planes give one cell,
/// which has none on-view. In a plane counts as off-view, so what only eyes in planes have on-view is listed too, with
/// `open` false. Cost: O(n^4) rational operations; 24 planes of 26-bit coefficients in general position take 1 s if an
/// open set of eyes has none on-view, else 3 s. `ask` is called all the time; what it throws ends it. Exact: yes.
/// Proof: P-52
std::vector<View_cell> view_cells(std::span<const std::array<Rational, 4>> planes,
                                  const std::function<void()>& ask = {});

}  // namespace sightline
