#include <sightline/algorithms/weak_visibility/along/piece_run.h>

#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace sightline {

namespace {

Near<3> normal_of(const Near<4>& plane) { return {{plane.at[0], plane.at[1], plane.at[2]}, plane.size, plane.error}; }

Near<3> near_cross(const Near<3>& a, const Near<3>& b) {
  return homogeneous_detail::bounded(cross(a.at, b.at), homogeneous_detail::error_of_products(2, a, b));
}

/// Exact: yes; doubles tell of most that they are not.
bool is_zero_at(const Quadratic_root& t, const Quadratic& f) {
  const std::array<double, 3> c = in_proportion(f.c);  // up to 1, each within 2^-52, as t is
  const double s = t.near();
  return !(std::fabs(c[0] + s * (c[1] + s * c[2])) > 0x1p-48) && t.sign_of(f) == 0;
}

/// a . b, with its error.
struct Near_number {
  double value, error;
};
Near_number near_dot(const Near<3>& a, const Near<3>& b) {
  return {a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2], homogeneous_detail::error_of_products(3, a, b)};
}
int certain_sum(std::initializer_list<Near_number> numbers) {
  double sum = 0, error = 0, size = 0;
  for (const Near_number& x : numbers) {
    sum += x.value;
    error += x.error;
    size += std::fabs(x.value);
  }
  return homogeneous_detail::certain_sign(sum, 1.001 * error + 0x1p-50 * size);
}

constexpr double proposed_zero = 1e-11;  // of doubles that only propose

}  // namespace

const Piece_run::Seen_line& Piece_run::seen(std::uint32_t number) {
  Seen_line& entry = seen_[number];
  if (entry.run == run_) return entry;
  entry.run = run_;
  const Near<6>& near = line(number).near;
  entry.low = normal_of(join(low_, near));
  entry.high = at_once_ ? entry.low : normal_of(join(high_, near));
  entry.now = unit_direction(normal_of(join(middle_, near)).at);
  return entry;
}

Piece_run::Answer Piece_run::run(const Quadratic_root& t, const Parameter_range& range, const Blockers& all) {
  ++counters_.runs;
  ++run_;
  seen_.resize(view_->line_count());
  now_ = &t;
  at_once_ = range.low == range.high;
  unlucky_ = false;
  low_ = view_->eye().near(range.low);
  high_ = view_->eye().near(range.high);
  middle_ = view_->eye().near(t);
  facts_.clear();
  steps_.clear();
  linear_.clear();
  front_.assign(view_->blocker_count(), 0);
  all_.clear();
  for (const std::uint32_t blocker : all) {
    front_[blocker] = t.sign_of(view_->blocker(blocker).eye_side);
    if (front_[blocker] != 0) all_.push_back(blocker);
    else if (!at_once_) unlucky_ = true;
  }
  std::sort(all_.begin(), all_.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double one = view_->blocker(a).size, other = view_->blocker(b).size;
    return one != other ? one > other : a < b;
  });
  Answer answer{false, true, range, {}, {}};
  answer.seen = find(view_->whole(), all_, answer.part);
  if (!answer.seen) answer.steps = std::move(steps_);
  if (unlucky_) {
    answer.sure = false;
    return answer;
  }
  if (at_once_) return answer;
  // As far as nothing that it rests on changes.
  std::vector<Quadratic_root> roots;
  for (const Fact& fact : facts_) {
    roots.clear();
    append_roots(*fact.sign, answer.range, roots);
    for (const Quadratic_root& root : roots) {
      if (root < t) {
        if (answer.range.low < root) answer.range.low = root;
      } else if (root < answer.range.high) answer.range.high = root;
    }
  }
  if (answer.seen)
    for (const Quadratic_root* end : {&answer.range.low, &answer.range.high})
      for (const Fact& fact : facts_)
        if (fact.lines[0] != no_line && is_zero_at(*end, *fact.sign)) zeros_.emplace_back(*end, fact.lines);
  return answer;
}

int Piece_run::note(const Quadratic& f, const std::array<std::uint32_t, 3>& lines) {
  if (f.is_zero()) return 0;
  const int sign = now_->sign_of(f);
  if (at_once_) return sign;
  if (sign == 0) unlucky_ = true;
  else facts_.push_back({&f, lines});
  return sign;
}

int Piece_run::certain(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
  const Seen_line &a = seen(i), &b = seen(j), &c = seen(k);
  const Near<3> low = near_cross(a.low, b.low);
  const int first = certain_sum({near_dot(low, c.low)});
  if (first == 0 || at_once_) return first;
  const Near<3> high = near_cross(a.high, b.high), mixed = near_cross(a.low, b.high), other = near_cross(a.high, b.low);
  if (certain_sum({near_dot(high, c.high)}) != first) return 0;
  if (certain_sum({near_dot(low, c.high), near_dot(mixed, c.low), near_dot(other, c.low)}) != first) return 0;
  return certain_sum({near_dot(high, c.low), near_dot(mixed, c.high), near_dot(other, c.high)}) == first ? first : 0;
}

int Piece_run::sign(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
  if (i == j || j == k || i == k) return 0;
  ++counters_.signs;
  int parity = 1;
  std::array<std::uint32_t, 3> lines{i, j, k};
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)})
    if (lines[a] > lines[b]) {
      std::swap(lines[a], lines[b]);
      parity = -parity;
    }
  if (const int sure = certain(lines[0], lines[1], lines[2]); sure != 0) return parity * sure;
  ++counters_.exact_signs;
  const std::uint64_t key = std::uint64_t{lines[0]} << 42 | std::uint64_t{lines[1]} << 21 | lines[2];
  const auto [at, is_new] = determinants_.try_emplace(key);
  if (is_new) at->second = determinant(line(lines[0]), line(lines[1]), line(lines[2]));
  return parity * note(at->second, lines);
}

std::vector<int> Piece_run::signs(const Cone& cone, const Line_side& side) {
  std::vector<int> signs;
  for (std::size_t i = 0; i < cone.size(); ++i) {
    const Line_side &a = cone[i], &b = cone[(i + 1) % cone.size()];
    signs.push_back(side.sign * a.sign * b.sign * sign(a.line, b.line, side.line));
  }
  return signs;
}

/// The part where a side is positive. Pre: some ray is, and some negative.
Piece_run::Cone Piece_run::clip(const Cone& cone, const std::vector<int>& signs, const Line_side& side) {
  // Ray i is between sides i and i + 1. Sides stay that end in a positive ray.
  const std::size_t n = cone.size();
  std::size_t first = 0;
  while (signs[first] <= 0 || signs[(first + n - 1) % n] > 0) ++first;  // the first positive ray
  Cone part;
  std::size_t i = first;
  part.push_back(cone[i]);
  for (; signs[i % n] > 0; ++i) part.push_back(cone[(i + 1) % n]);
  part.push_back(side);
  return part;
}

Line_side Piece_run::inside(std::uint32_t blocker, std::size_t edge) const {
  const Line_side& side = view_->blocker(blocker).edges[edge];
  return {side.line, -front_[blocker] * side.sign};
}

bool Piece_run::covers(std::uint32_t blocker, const Cone& cone) {
  for (std::size_t edge = 0; edge < view_->blocker(blocker).edges.size(); ++edge)
    for (const int sign : signs(cone, inside(blocker, edge)))
      if (sign < 0) return false;
  note(view_->blocker(blocker).eye_side, {no_line, 0, 0});
  return true;
}

bool Piece_run::is_outside(std::uint32_t blocker, std::size_t edge, const Cone& cone) {
  for (const int sign : signs(cone, inside(blocker, edge)))
    if (sign > 0) return false;
  note(view_->blocker(blocker).eye_side, {no_line, 0, 0});
  return true;
}

/// Whether all of a blocker is on the outer side of a line.
bool Piece_run::is_beyond_side(std::uint32_t blocker, const Line_side& side) {
  for (const Near_point& corner : view_->blocker(blocker).corners) {
    const Near<4> point = near(corner);
    const Near<6>& of = line(side.line).near;
    const int low = certain_dot(join(low_, of), point), high = at_once_ ? low : certain_dot(join(high_, of), point);
    int sign = low == high ? low : 0;
    if (sign == 0) {
      linear_.push_back(sightline::side(view_->eye(), line(side.line), corner.exact));
      sign = note(linear_.back(), {no_line, 0, 0});
    }
    if (side.sign * sign > 0) return false;
  }
  return true;
}

std::vector<Triple> Piece_run::rays(const Cone& cone) {
  std::vector<Triple> rays;
  for (std::size_t i = 0; i < cone.size(); ++i) {
    const Line_side &a = cone[i], &b = cone[(i + 1) % cone.size()];
    Triple ray = unit_direction(cross(seen(a.line).now, seen(b.line).now));
    for (double& x : ray) x *= a.sign * b.sign;
    rays.push_back(ray);
  }
  return rays;
}

Piece_run::Guess Piece_run::guess(std::uint32_t blocker, const Cone& cone, const std::vector<Triple>& rays) {
  // Of large faces this alone takes milliseconds.
  if (view_->blocker(blocker).edges.size() * rays.size() >= 10'000) view_->scene().ask();
  bool covers = true;
  double deepest = 0;
  std::size_t best = 0;
  for (std::size_t edge = 0; edge < view_->blocker(blocker).edges.size(); ++edge) {
    const Line_side side = inside(blocker, edge);
    const Triple& normal = seen(side.line).now;
    double least = 2, most = -2;
    for (const Triple& ray : rays) {
      const double value = side.sign * dot(normal, ray);
      least = std::min(least, value);
      most = std::max(most, value);
    }
    if (most <= proposed_zero) return {Guess::beside, edge};
    if (least < -proposed_zero) covers = false;
    if (const double depth = std::min(most, -least); depth > deepest) {
      deepest = depth;
      best = edge;
    }
  }
  if (covers) return {Guess::covers, 0};
  for (std::size_t k = 0; k < cone.size(); ++k) {
    const Triple& normal = seen(cone[k].line).now;
    const auto is_inside = [&](const Near_point& corner) {
      Triple to;
      for (std::size_t x = 0; x < 3; ++x) to[x] = corner.near[x] - middle_.at[x];
      return cone[k].sign * dot(normal, unit_direction(to)) > proposed_zero;
    };
    const auto& corners = view_->blocker(blocker).corners;
    if (std::none_of(corners.begin(), corners.end(), is_inside)) return {Guess::beside_side, k};
  }
  return {Guess::across, best};
}

bool Piece_run::is_beside(std::uint32_t blocker, const Cone& cone) {
  const Guess first = guess(blocker, cone, rays(cone));
  if (first.kind == Guess::beside && is_outside(blocker, first.edge, cone)) return true;
  return first.kind == Guess::beside_side && is_beyond_side(blocker, cone[first.edge]);
}

bool Piece_run::find(const Cone& cone, const Blockers& left, Cone& found) {
  if (unlucky_) return false;
  view_->scene().ask();
  ++counters_.parts;
  // 1. What is in front of it, as doubles have it.
  const std::vector<Triple> near_rays = rays(cone);
  Blockers near;
  for (const std::uint32_t blocker : left) {
    const Guess its = guess(blocker, cone, near_rays);
    if (its.kind == Guess::covers && covers(blocker, cone)) {
      steps_.push_back({false, {}, blocker});
      return false;
    }
    if (its.kind == Guess::covers || its.kind == Guess::across) near.push_back(blocker);
  }
  for (Blockers beside;;) {
    // 2. Nothing is: exactly.
    if (near.empty()) {
      for (const std::uint32_t blocker : all_)
        if (std::find(beside.begin(), beside.end(), blocker) == beside.end() && !is_beside(blocker, cone))
          near.push_back(blocker);
      if (unlucky_) return false;
      if (near.empty()) {
        found = cone;
        return true;
      }
    }
    // 3. Cut along an edge of the first.
    const std::uint32_t blocker = near.front();
    near.erase(near.begin());
    const std::size_t count = view_->blocker(blocker).edges.size(), begin = guess(blocker, cone, near_rays).edge;
    bool is_covered = true;
    for (std::size_t k = 0; k < count && is_covered; ++k) {
      const Line_side side = inside(blocker, (begin + k) % count);
      std::vector<int> at = signs(cone, side);
      if (unlucky_) return false;
      is_covered = std::any_of(at.begin(), at.end(), [](int s) { return s > 0; });
      if (!is_covered || std::none_of(at.begin(), at.end(), [](int s) { return s < 0; })) continue;
      const Cone inner = clip(cone, at, side);
      for (int& s : at) s = -s;
      steps_.push_back({true, {side.line, -side.sign}, 0});
      const std::size_t before = facts_.size();
      if (find(clip(cone, at, {side.line, -side.sign}), near, found)) return true;
      const std::size_t between = facts_.size();
      near.insert(near.begin(), blocker);
      if (!find(inner, near, found)) return false;
      facts_.erase(facts_.begin() + static_cast<std::ptrdiff_t>(before),
                   facts_.begin() + static_cast<std::ptrdiff_t>(between));
      return true;
    }
    note(view_->blocker(blocker).eye_side, {no_line, 0, 0});
    if (is_covered) {
      steps_.push_back({false, {}, blocker});
      return false;
    }
    beside.push_back(blocker);
  }
}

}  // namespace sightline
