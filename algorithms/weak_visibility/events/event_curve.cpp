#include <sightline/algorithms/weak_visibility/events/event_curve.h>

#include <algorithm>
#include <cstddef>

namespace sightline {
namespace {

/// first + s step
Homogeneous along(const Homogeneous& first, const Homogeneous& step, const Rational& s) {
  Homogeneous x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = first[k] * s.get_den() + step[k] * s.get_num();
  return x;
}

Homogeneous difference(const Homogeneous& from, const Homogeneous& to) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2], to[3] - from[3]};
}

/// The plane of two lines that meet; zero where they are one.
Homogeneous common_plane(const Exact_pluecker& a, const Exact_pluecker& b) {
  for (std::size_t k = 0; k < 4; ++k) {
    Homogeneous h{0, 0, 0, 0};
    h[k] = 1;
    const Homogeneous at = meet(h, b);
    if (all_zero(at)) continue;
    const Homogeneous plane = join(at, a);
    if (!all_zero(plane)) return plane;
  }
  return {0, 0, 0, 0};
}

/// The side of the point first + s step of a plane.
Quadratic linear(const Homogeneous& plane, const Homogeneous& first, const Homogeneous& step) {
  return {{dot(plane, first), dot(plane, step), Integer(0)}};
}

/// The side of a point of a plane that turns about a line.
Quadratic linear_at(const Homogeneous& plane, const Homogeneous& turn, const Homogeneous& x) {
  return {{dot(plane, x), dot(turn, x), Integer(0)}};
}

/// The parameters in (0, 1) where each of two pairs, ends[0] and ends[1], ends[2] and ends[3], has different signs.
std::vector<Parameter_range> changing(const std::array<Quadratic, 4>& ends) {
  std::array<int, 4> sure{};
  for (std::size_t k = 0; k < 4; ++k) {
    if (ends[k].is_zero()) return {};
    sure[k] = ends[k].certain_sign();
  }
  if (sure[0] * sure[1] > 0 || sure[2] * sure[3] > 0) return {};
  std::vector<Parameter_range> found;
  for (const Parameter_range& part : divided({Quadratic_root(0), Quadratic_root(1)}, ends)) {
    const Rational s = inner_rational(part);
    if (ends[0].sign(s) * ends[1].sign(s) < 0 && ends[2].sign(s) * ends[3].sign(s) < 0) found.push_back(part);
  }
  return found;
}

}  // namespace

Homogeneous off_plane(const Homogeneous& plane) {
  Homogeneous x{0, 0, 0, 0};
  const auto first = std::find_if(plane.begin(), plane.end(), [](const Integer& c) { return sgn(c) != 0; });
  x[static_cast<std::size_t>(first - plane.begin())] = 1;
  return x;
}

std::array<Near_part, 2> Near_part::halves() const {
  const Near<6> first = half(lines[0]), last = half(lines[2]), middle = half(lines[1]);
  const Near<6> at = half(first + middle + last);
  std::array<Near_part, 2> parts{Near_part{{lines[0], lines[0] + middle, at}, planes},
                                 Near_part{{at, middle + lines[2], lines[2]}, planes}};
  for (std::size_t k = 0; k < 2; ++k) parts[0].planes[k][1] = parts[1].planes[k][0] = half(planes[k][0] + planes[k][1]);
  return parts;
}

// ---- Pencils

namespace {

Near_part near_pencil(const Near<4>& vertex, const std::array<Filtered, 2>& segment) {
  const Near<6> first = join(vertex, segment[0].near), last = join(vertex, segment[1].near);
  return {{first, first + last, last}, {}};
}

Near_part near_regulus(const Event_lines::Event_line& a, const Event_lines::Event_line& b,
                       const Event_lines::Event_line& c) {
  const Near<4>&first = a.hull[0].near, &last = a.hull[1].near;
  const std::array<Near<4>, 2> of_b{join(first, b.near), join(last, b.near)},
      of_c{join(first, c.near), join(last, c.near)};
  return {{meet(of_b[0], of_c[0]), meet(of_b[0], of_c[1]) + meet(of_b[1], of_c[0]), meet(of_b[1], of_c[1])},
          {of_b, of_c}};
}

}  // namespace

Event_pencil::Event_pencil(Event_kind kind, const Filtered& vertex, const Homogeneous& plane,
                           const std::array<Filtered, 2>& segment)
    : Event_curve(kind, near_pencil(vertex.near, segment)), vertex_(&vertex), plane_(&plane), segment_(&segment) {}

Homogeneous Event_pencil::step() const { return difference((*segment_)[0].exact, (*segment_)[1].exact); }

Event_curve::Lines Event_pencil::exact_lines() const {
  return {join(vertex_->exact, (*segment_)[0].exact), join(vertex_->exact, step()), Exact_pluecker{0, 0, 0, 0, 0, 0}};
}

Event_chart Event_pencil::chart(const Rational& s) const {
  return {vertex_->exact, along((*segment_)[0].exact, step(), s), (*segment_)[1].exact, off_plane(*plane_)};
}

std::vector<Quadratic> Event_pencil::ends(std::span<const Event_lines::Event_line> lines) const {
  const Homogeneous &first = (*segment_)[0].exact, by = step(), beyond = off_plane(*plane_);
  std::vector<Quadratic> found;
  std::vector<const Exact_pluecker*> star, flat;
  for (const Event_lines::Event_line& line : lines) {
    const bool through = all_zero(join(vertex_->exact, line.pluecker)), within = all_zero(meet(*plane_, line.pluecker));
    if (through) star.push_back(&line.pluecker);
    if (within) flat.push_back(&line.pluecker);
    if (through && within) found.push_back(linear(join(beyond, line.pluecker), first, by));
  }
  for (std::size_t i = 0; i < star.size(); ++i)
    for (std::size_t j = i + 1; j < star.size(); ++j)
      found.push_back(linear(common_plane(*star[i], *star[j]), first, by));
  for (std::size_t i = 0; i < flat.size(); ++i)
    for (std::size_t j = i + 1; j < flat.size(); ++j) {
      const Homogeneous at = meet(join(beyond, *flat[i]), *flat[j]);
      const Exact_pluecker up = join(at, beyond);
      found.push_back({{side(this->lines()[0], up), side(this->lines()[1], up), Integer(0)}});
    }
  return found;
}

// ---- Three skew edges

Event_regulus::Event_regulus(std::span<const Edge> lines, const std::array<std::uint32_t, 3>& edges)
    : Event_curve(Event_kind::triple, near_regulus(lines[edges[0]], lines[edges[1]], lines[edges[2]])),
      edges_(edges),
      a_(&lines[edges[0]]),
      b_(&lines[edges[1]]),
      c_(&lines[edges[2]]) {}

bool Event_regulus::is_off(const Near_part& part) const {
  // It touches the second edge where its ends are on both sides of the plane with the third; and so on.
  const auto beside = [](const std::array<Near<4>, 2>& planes, const Edge& edge) {
    const int sure = certain_dot(planes[0], edge.hull[0].near);
    return sure != 0 && sure == certain_dot(planes[1], edge.hull[0].near) &&
           sure == certain_dot(planes[0], edge.hull[1].near) && sure == certain_dot(planes[1], edge.hull[1].near);
  };
  return beside(part.planes[1], *b_) || beside(part.planes[0], *c_);
}

const Event_regulus::Planes& Event_regulus::planes() const {
  if (!planes_) {
    const Homogeneous &first = a_->hull[0].exact, step = difference(first, a_->hull[1].exact);
    planes_ = {step, join(first, b_->pluecker), join(step, b_->pluecker), join(first, c_->pluecker),
               join(step, c_->pluecker)};
  }
  return *planes_;
}

std::vector<Parameter_range> Event_regulus::touching() const {
  const Planes& p = planes();
  return changing({linear_at(p.c0, p.c1, b_->hull[0].exact), linear_at(p.c0, p.c1, b_->hull[1].exact),
                   linear_at(p.b0, p.b1, c_->hull[0].exact), linear_at(p.b0, p.b1, c_->hull[1].exact)});
}

Event_curve::Lines Event_regulus::exact_lines() const {
  const Planes& p = planes();
  Lines l{meet(p.b0, p.c0), meet(p.b0, p.c1), meet(p.b1, p.c1)};
  const Exact_pluecker other = meet(p.b1, p.c0);
  for (std::size_t k = 0; k < 6; ++k) l[1][k] += other[k];
  return l;
}

Event_chart Event_regulus::chart(const Rational& s) const {
  const Planes& p = planes();
  const auto on_second = [&](const Rational& at) { return meet(along(p.c0, p.c1, at), b_->pluecker); };
  const Rational beside = s + 1;  // any other line of the ruling
  return {along(a_->hull[0].exact, p.step, s), on_second(s), along(a_->hull[0].exact, p.step, beside),
          on_second(beside)};
}

}  // namespace sightline
