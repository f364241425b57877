#include <sightline/algorithms/weak_visibility/events/event_lines.h>

#include <sightline/kernel/time_limit.h>

#include <span>
#include <utility>

namespace sightline {

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

/// A corner on that side of a plane. Pre: there is one.
const Homogeneous& in_front(const Near_plane& h, const Near_polygon& polygon, int sign) {
  return std::find_if(polygon.begin(), polygon.end(), [&](const Near_point& p) { return side(h, p) == sign; })->exact;
}

}  // namespace

Event_lines::Event_lines(const Occluders& occluders, const Near_polygon& source, const Near_plane& source_plane,
                         const Near_polygon& target, const Near_plane& target_plane, int beside,
                         std::span<const std::uint32_t> pieces, const std::function<bool()>& out_of_time)
    : source_polygon_(source),
      target_polygon_(target),
      near_source_plane_(source_plane),
      near_target_plane_(target_plane),
      source_plane_{source_plane.exact, near(source_plane)},
      target_plane_{target_plane.exact, near(target_plane)},
      beside_(beside) {
  for (const Near_point& p : source) source_.push_back({p.exact, near(p)});
  for (const Near_point& p : target) target_.push_back({p.exact, near(p)});
  for (std::size_t i = 0; i < source.size(); ++i)
    from_.push_back({edge(source[i].exact, source[(i + 1) % source.size()].exact), 0});
  for (std::size_t i = 0; i < target.size(); ++i)
    to_.push_back({edge(target[i].exact, target[(i + 1) % target.size()].exact), 0});
  for (std::size_t i = 0; i < from_.size(); ++i)
    from_[i].sense = -sense_of(source[i].exact, source[(i + 1) % source.size()].exact, from_[i].line);
  for (std::size_t i = 0; i < to_.size(); ++i)
    to_[i].sense = beside * sense_of(target[i].exact, target[(i + 1) % target.size()].exact, to_[i].line);
  std::vector<std::pair<double, std::uint32_t>> by_size;
  for (const std::uint32_t piece : pieces) by_size.emplace_back(-area(occluders.corners(piece)), piece);
  std::sort(by_size.begin(), by_size.end());
  for (const auto& [size, piece] : by_size) add_piece(occluders, piece);
  for (Event_line& line : lines_) {
    line.near = near(occluders.frame(), line.pluecker);
    if (!line.real) continue;
    for (Filtered& end : line.hull) end.near = near(occluders.frame(), end.exact);
  }
  bool is_over = false;
  for (Event_line& line : lines_) {
    if (!line.real) continue;
    is_over = is_over || has_run_out(out_of_time);
    if (line.in_source && sign_of_dot(target_plane_, line.hull[0]) == 0 &&
        sign_of_dot(target_plane_, line.hull[1]) == 0)
      line.real = false;
    else if (!is_over && !is_touched(line)) {
      line.real = false;
      ++untouched_;
    }
  }
}

bool Event_lines::is_touched(const Event_line& line) const {
  // A line through a point of it and one of the other polygon has a side that is linear in both points.
  const auto fails = [&](const Literal& literal, std::span<const Filtered> corners, int sense) {
    for (const Filtered& corner : corners)
      for (const Filtered& end : line.hull)
        if (sense * literal.sense * certain_side(join(end.near, corner.near), lines_[literal.line].near) >= 0)
          return false;
    return true;
  };
  return std::none_of(from_.begin(), from_.end(), [&](const Literal& l) { return fails(l, target_, 1); }) &&
         std::none_of(to_.begin(), to_.end(), [&](const Literal& l) { return fails(l, source_, -1); });
}

bool Event_lines::may_pass(std::span<const Near<6>> between, const std::vector<Literal>& literals) const {
  bool held = false, reversed = false;
  for (const Literal& literal : literals) {
    int common = 0;
    for (const Near<6>& line : between) {
      const int sure = certain_side(line, lines_[literal.line].near);
      if (sure == 0 || sure == -common) {
        common = 0;
        break;
      }
      common = sure;
    }
    held |= literal.sense * common > 0;
    reversed |= literal.sense * common < 0;
  }
  return !(held && reversed);
}

bool Event_lines::in_hull(const Event_line& line, const Homogeneous& x) {
  if (sgn(x[3]) == 0) return false;
  return before(line.pluecker, line.hull[0].exact, x) >= 0 && before(line.pluecker, x, line.hull[1].exact) >= 0;
}

std::uint32_t Event_lines::line(Exact_pluecker pluecker) {
  make_canonical(pluecker);
  const auto [at, is_new] = numbers_.try_emplace(pluecker, static_cast<std::uint32_t>(lines_.size()));
  if (is_new) {
    lines_.push_back({pluecker, all_zero(meet(source_plane_.exact, pluecker)), false, {}, {}});
  }
  return at->second;
}

std::uint32_t Event_lines::edge(const Homogeneous& a, const Homogeneous& b) {
  const std::uint32_t number = line(join(a, b));
  Event_line& own = lines_[number];
  for (const Homogeneous* x : {&a, &b}) {
    if (!own.real) {
      own.real = true;
      own.hull = {Filtered{*x, {}}, Filtered{*x, {}}};
    }
    if (before(own.pluecker, *x, own.hull[0].exact) > 0) own.hull[0].exact = *x;
    if (before(own.pluecker, own.hull[1].exact, *x) > 0) own.hull[1].exact = *x;
  }
  return number;
}

int Event_lines::sense_of(const Homogeneous& a, const Homogeneous& b, std::uint32_t number) const {
  Exact_pluecker pluecker = join(a, b);
  const int sense = make_canonical(pluecker);
  return pluecker == lines_[number].pluecker ? sense : 0;
}

bool Event_lines::is_outside(const Near_point& a, const Near_point& b) const {
  return (side(near_source_plane_, a) < 0 && side(near_source_plane_, b) < 0) ||
         (side(near_target_plane_, a) * beside_ < 0 && side(near_target_plane_, b) * beside_ < 0);
}

std::uint32_t Event_lines::trace(const Near_polygon& polygon, const Near_plane& plane, const Near_plane& other) {
  std::vector<Homogeneous> ends;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Near_point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const int from = side(other, a), to = side(other, b);
    if (from == 0) ends.push_back(a.exact);
    if (from * to < 0) {
      Homogeneous x = meet(other.exact, join(a.exact, b.exact));
      if (sgn(x[3]) < 0)
        for (Integer& coordinate : x) coordinate = -coordinate;
      ends.push_back(x);
    }
  }
  return ends.size() == 2 ? edge(ends[0], ends[1]) : line(meet(plane.exact, other.exact));
}

void Event_lines::add_piece(const Occluders& occluders, std::uint32_t piece) {
  const Near_plane& plane = occluders.plane(piece);
  const int source_at = side(plane, source_polygon_), target_at = side(plane, target_polygon_);
  if (source_at == 0 || target_at == 0 || (source_at == target_at && source_at != both_sides))
    return;  // a line that leaves its plane at an end does not meet it
  const Near_polygon corners = occluders.polygon(piece);
  std::vector<Literal> edges;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Near_point &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const std::uint32_t number = is_outside(a, b) ? line(join(a.exact, b.exact)) : edge(a.exact, b.exact);
    edges.push_back({number, sense_of(a.exact, b.exact, number)});
  }
  // p in front of it where its trace on the source says so, and q the same.
  Literal p_in_front{0, 0}, q_in_front{0, 0};
  if (source_at == both_sides) {
    const std::uint32_t number = trace(corners, plane, near_source_plane_);
    p_in_front = {number,
                  sgn(side(join(in_front(plane, source_polygon_, 1), in_front(near_source_plane_, target_polygon_, 1)),
                           lines_[number].pluecker))};
  }
  if (target_at == both_sides) {
    const std::uint32_t number = trace(corners, plane, near_target_plane_);
    q_in_front = {
        number,
        sgn(side(join(in_front(near_target_plane_, source_polygon_, beside_), in_front(plane, target_polygon_, 1)),
                 lines_[number].pluecker))};
  }
  for (const int sense : {1, -1}) {  // p in front and q behind, then the other way round
    if (source_at == -sense || target_at == sense) continue;
    Blocker blocker{piece, {}};
    if (source_at == both_sides) blocker.literals.push_back({p_in_front.line, sense * p_in_front.sense});
    if (target_at == both_sides) blocker.literals.push_back({q_in_front.line, -sense * q_in_front.sense});
    for (const Literal& literal : edges) blocker.literals.push_back({literal.line, sense * literal.sense});
    blockers_.push_back(std::move(blocker));
  }
}

}  // namespace sightline
