#include <sightline/algorithms/weak_visibility/events/event_lines.h>

#include <utility>
#include <span>

namespace sightline {

Exact_pluecker join(const Homogeneous& a, const Homogeneous& b) {
  return {a[3] * b[0] - b[3] * a[0], a[3] * b[1] - b[3] * a[1], a[3] * b[2] - b[3] * a[2],
          a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Homogeneous join(const Homogeneous& x, const Exact_pluecker& e) {
  return {e[1] * x[2] - e[2] * x[1] + x[3] * e[3], e[2] * x[0] - e[0] * x[2] + x[3] * e[4],
          e[0] * x[1] - e[1] * x[0] + x[3] * e[5], -(x[0] * e[3] + x[1] * e[4] + x[2] * e[5])};
}

Homogeneous meet(const Homogeneous& h, const Exact_pluecker& e) {
  return {h[1] * e[5] - h[2] * e[4] - h[3] * e[0], h[2] * e[3] - h[0] * e[5] - h[3] * e[1],
          h[0] * e[4] - h[1] * e[3] - h[3] * e[2], h[0] * e[0] + h[1] * e[1] + h[2] * e[2]};
}

Exact_pluecker meet(const Homogeneous& g, const Homogeneous& h) {
  return {g[1] * h[2] - g[2] * h[1], g[2] * h[0] - g[0] * h[2], g[0] * h[1] - g[1] * h[0],
          g[3] * h[0] - h[3] * g[0], g[3] * h[1] - h[3] * g[1], g[3] * h[2] - h[3] * g[2]};
}

Integer dot(const Homogeneous& a, const Homogeneous& b) {
  Integer sum = a[0] * b[0];
  for (std::size_t k = 1; k < 4; ++k) mpz_addmul(sum.get_mpz_t(), a[k].get_mpz_t(), b[k].get_mpz_t());
  return sum;
}

Integer side(const Exact_pluecker& a, const Exact_pluecker& b) {
  Integer sum = a[0] * b[3];
  for (std::size_t k = 1; k < 6; ++k) mpz_addmul(sum.get_mpz_t(), a[k].get_mpz_t(), b[(k + 3) % 6].get_mpz_t());
  return -sum;
}

namespace {

/// The square of twice a polygon's area. In doubles.
double area(std::span<const Triple> corners) {
  Triple sum{};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    Triple u, v;
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = corners[i][k] - corners[0][k];
      v[k] = corners[i + 1][k] - corners[0][k];
    }
    for (std::size_t k = 0; k < 3; ++k) sum[k] += u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
  }
  return sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
}

/// 1 where b comes after a in a line's direction, 0 where they are one point.
int before(const Exact_pluecker& pluecker, const Homogeneous& a, const Homogeneous& b) {
  Integer sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += pluecker[k] * (b[k] * a[3] - a[k] * b[3]);
  return sgn(sum) * sgn(a[3]) * sgn(b[3]);
}

/// The side of a plane on which a polygon is, 0 where it is in the plane, 2 where it is on both sides.
int position(const Homogeneous& h, const Near_polygon& polygon) {
  bool front = false, behind = false;
  for (const Near_point& p : polygon) {
    const int s = sgn(dot(h, p.exact));
    front |= s > 0;
    behind |= s < 0;
  }
  return front && behind ? 2 : front ? 1 : behind ? -1 : 0;
}

/// A corner on that side of a plane. Pre: there is one.
const Homogeneous& in_front(const Homogeneous& h, const Near_polygon& polygon, int sign) {
  return std::find_if(polygon.begin(), polygon.end(), [&](const Near_point& p) { return sgn(dot(h, p.exact)) == sign; })
      ->exact;
}

}  // namespace

Event_lines::Event_lines(const Occluders& occluders, const Near_polygon& source, const Near_plane& source_plane,
                         const Near_polygon& target, const Near_plane& target_plane, int beside)
    : source_(source),
      target_(target),
      near_source_plane_(source_plane),
      near_target_plane_(target_plane),
      beside_(beside) {
  for (std::size_t i = 0; i < source.size(); ++i)
    from_.push_back({edge(source[i].exact, source[(i + 1) % source.size()].exact), 0});
  for (std::size_t i = 0; i < target.size(); ++i)
    to_.push_back({edge(target[i].exact, target[(i + 1) % target.size()].exact), 0});
  for (std::size_t i = 0; i < from_.size(); ++i)
    from_[i].sense = -sense_of(source[i].exact, source[(i + 1) % source.size()].exact, from_[i].line);
  for (std::size_t i = 0; i < to_.size(); ++i)
    to_[i].sense = beside * sense_of(target[i].exact, target[(i + 1) % target.size()].exact, to_[i].line);
  std::vector<std::pair<double, std::uint32_t>> by_size;
  for (const std::uint32_t piece : occluders.near_shaft(source, target))
    by_size.emplace_back(-area(occluders.corners(piece)), piece);
  std::sort(by_size.begin(), by_size.end());
  for (const auto& [size, piece] : by_size) add_piece(occluders, piece);
  for (Event_line& line : lines_)
    if (line.in_source && sgn(dot(target_plane.exact, line.hull[0])) == 0 &&
        sgn(dot(target_plane.exact, line.hull[1])) == 0)
      line.real = false;
}

bool Event_lines::in_hull(const Event_line& line, const Homogeneous& x) {
  if (sgn(x[3]) == 0) return false;
  return before(line.pluecker, line.hull[0], x) >= 0 && before(line.pluecker, x, line.hull[1]) >= 0;
}

std::uint32_t Event_lines::line(Exact_pluecker pluecker) {
  make_canonical(pluecker);
  const auto [at, is_new] = numbers_.try_emplace(pluecker, static_cast<std::uint32_t>(lines_.size()));
  if (is_new) {
    lines_.push_back({pluecker, false, false, {}});
    lines_.back().in_source = all_zero(meet(source_plane(), pluecker));
  }
  return at->second;
}

std::uint32_t Event_lines::edge(const Homogeneous& a, const Homogeneous& b) {
  const std::uint32_t number = line(join(a, b));
  Event_line& own = lines_[number];
  for (const Homogeneous* x : {&a, &b}) {
    if (!own.real) {
      own.real = true;
      own.hull = {*x, *x};
    }
    if (before(own.pluecker, *x, own.hull[0]) > 0) own.hull[0] = *x;
    if (before(own.pluecker, own.hull[1], *x) > 0) own.hull[1] = *x;
  }
  return number;
}

int Event_lines::sense_of(const Homogeneous& a, const Homogeneous& b, std::uint32_t number) const {
  Exact_pluecker pluecker = join(a, b);
  const int sense = make_canonical(pluecker);
  return pluecker == lines_[number].pluecker ? sense : 0;
}

bool Event_lines::is_outside(const Homogeneous& a, const Homogeneous& b) const {
  return (sgn(dot(source_plane(), a)) < 0 && sgn(dot(source_plane(), b)) < 0) ||
         (sgn(dot(target_plane(), a)) * beside_ < 0 && sgn(dot(target_plane(), b)) * beside_ < 0);
}

std::uint32_t Event_lines::trace(const Near_polygon& polygon, const Homogeneous& plane, const Homogeneous& other) {
  std::vector<Homogeneous> ends;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Homogeneous &a = polygon[i].exact, &b = polygon[(i + 1) % polygon.size()].exact;
    const int from = sgn(dot(other, a)), to = sgn(dot(other, b));
    if (from == 0) ends.push_back(a);
    if (from * to < 0) {
      Homogeneous x = meet(other, join(a, b));
      if (sgn(x[3]) < 0)
        for (Integer& coordinate : x) coordinate = -coordinate;
      ends.push_back(x);
    }
  }
  return ends.size() == 2 ? edge(ends[0], ends[1]) : line(meet(plane, other));
}

void Event_lines::add_piece(const Occluders& occluders, std::uint32_t piece) {
  const Homogeneous& plane = occluders.plane(piece).exact;
  const int source_at = position(plane, source_), target_at = position(plane, target_);
  if (source_at == 0 || target_at == 0 || (source_at == target_at && source_at != 2))
    return;  // a line that leaves its plane at an end does not meet it
  const Near_polygon corners = occluders.polygon(piece);
  std::vector<Literal> edges;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Homogeneous &a = corners[i].exact, &b = corners[(i + 1) % corners.size()].exact;
    const std::uint32_t number = is_outside(a, b) ? line(join(a, b)) : edge(a, b);
    edges.push_back({number, sense_of(a, b, number)});
  }
  // p in front of it where its trace on the source says so, and q the same.
  Literal p_in_front{0, 0}, q_in_front{0, 0};
  if (source_at == 2) {
    const std::uint32_t number = trace(corners, plane, source_plane());
    p_in_front = {number, sgn(side(join(in_front(plane, source_, 1), in_front(source_plane(), target_, 1)),
                                   lines_[number].pluecker))};
  }
  if (target_at == 2) {
    const std::uint32_t number = trace(corners, plane, target_plane());
    q_in_front = {number, sgn(side(join(in_front(target_plane(), source_, beside_), in_front(plane, target_, 1)),
                                   lines_[number].pluecker))};
  }
  for (const int sense : {1, -1}) {  // p in front and q behind, then the other way round
    if (source_at == -sense || target_at == sense) continue;
    Blocker blocker{piece, {}};
    if (source_at == 2) blocker.literals.push_back({p_in_front.line, sense * p_in_front.sense});
    if (target_at == 2) blocker.literals.push_back({q_in_front.line, -sense * q_in_front.sense});
    for (const Literal& literal : edges) blocker.literals.push_back({literal.line, sense * literal.sense});
    blockers_.push_back(std::move(blocker));
  }
}

}  // namespace sightline
