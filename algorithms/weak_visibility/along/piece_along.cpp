#include <sightline/algorithms/weak_visibility/along/piece_along.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

namespace sightline {

namespace {

constexpr std::uint32_t no_line = ~std::uint32_t{0};
constexpr std::size_t most_lines = std::size_t{1} << 21;  // three numbers in one key

/// The moments of a range on which a linear function is >= 0; none where it is so nowhere.
std::optional<std::array<Rational, 2>> where_not_negative(const Quadratic& f, std::array<Rational, 2> range) {
  if (sgn(f.c[1]) == 0) return sgn(f.c[0]) < 0 ? std::nullopt : std::optional(range);
  Rational root(Integer(-f.c[0]), f.c[1]);
  root.canonicalize();
  if (sgn(f.c[1]) > 0) range[0] = std::max(range[0], root);
  else range[1] = std::min(range[1], root);
  return range[0] > range[1] ? std::nullopt : std::optional(range);
}

double squared_size(std::span<const Near_point> corners) {
  Triple sum{};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Triple part = cross(minus(corners[i].near, corners[0].near), minus(corners[i + 1].near, corners[0].near));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return dot(sum, sum);
}

Near<3> normal_of(const Near<4>& plane) { return {{plane.at[0], plane.at[1], plane.at[2]}, plane.size, plane.error}; }

Near<3> near_cross(const Near<3>& a, const Near<3>& b) {
  return homogeneous_detail::bounded(cross(a.at, b.at), homogeneous_detail::error_of_products(2, a, b));
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

Triple unit(const Triple& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? Triple{a[0] / length, a[1] / length, a[2] / length} : a;
}

constexpr double proposed_zero = 1e-11;  // of doubles that only propose

/// What ranges leave of a range, all open, but for single moments between them.
std::vector<Parameter_range> rest_of(const Parameter_range& range, std::vector<Parameter_range> taken) {
  std::sort(taken.begin(), taken.end(), [](const auto& a, const auto& b) { return a.low < b.low; });
  std::vector<Parameter_range> rest;
  const Quadratic_root* low = &range.low;
  for (const Parameter_range& part : taken) {
    if (*low < part.low) rest.push_back({*low, part.low});
    if (*low < part.high) low = &part.high;
  }
  if (*low < range.high) rest.push_back({*low, range.high});
  return rest;
}

}  // namespace

// ---- The scene

Along_scene::Along_scene(const Occluders& occluders, const Exact_point& from, const Exact_point& to)
    : occluders_(&occluders), eye_(occluders.scene(), occluders.frame(), from, to), contacts_{0, 1} {
  const auto count = static_cast<std::uint32_t>(occluders.scene().pieces().size());
  for (std::uint32_t piece = 0; piece < count; ++piece) {
    Eye_polygon& polygon = polygons_.emplace_back();
    polygon.piece = piece;
    polygon.eye_side = eye_.side(occluders.plane(piece).exact);
    if (polygon.eye_side.is_zero()) continue;
    polygon.corners = occluders.polygon(piece);
    polygon.size = squared_size(polygon.corners);
    for (std::uint32_t i = 0; i < polygon.corners.size(); ++i) {
      Exact_pluecker line = join(polygon.corners[i].exact, polygon.corners[(i + 1) % polygon.corners.size()].exact);
      const int sense = make_canonical(line);
      const auto [at, is_new] = numbers_.try_emplace(line, static_cast<std::uint32_t>(lines_.size()));
      if (is_new) {
        lines_.push_back(eye_line(eye_, occluders.frame(), line));
        edges_.push_back({piece, i});
      }
      polygon.edges.push_back({at->second, sense});
    }
    if (sgn(polygon.eye_side.c[1]) == 0) continue;
    Rational t(Integer(-polygon.eye_side.c[0]), polygon.eye_side.c[1]);
    t.canonicalize();
    if (t > 0 && t < 1 && is_on(polygon, eye_.at(t))) contacts_.push_back(t);
  }
  std::sort(contacts_.begin(), contacts_.end());
  contacts_.erase(std::unique(contacts_.begin(), contacts_.end()), contacts_.end());
}

bool Along_scene::is_on(const Eye_polygon& polygon, const Homogeneous& eye) const {
  // A point in front of the plane sees the point through the inside of all edges, or along them.
  const std::array<Integer, 4>& h = occluders_->plane(polygon.piece).exact;
  for (const Line_side& edge : polygon.edges) {
    const Homogeneous plane = join(eye, lines_[edge.line].line);
    if (edge.sign * sgn(Integer(plane[0] * h[0] + plane[1] * h[1] + plane[2] * h[2])) < 0) return false;
  }
  return true;
}

// ---- One piece

Piece_along::Piece_along(const Along_scene& scene, std::uint32_t piece, int side)
    : scene_(&scene), target_(&scene.polygons()[piece]), plane_(scene.occluders().plane(piece)), side_(side) {
  ++counters_.pieces;
  for (const Line_side& edge : target_->edges) whole_.push_back({edge.line, -side * edge.sign});
  if (side > 0) std::reverse(whole_.begin(), whole_.end());
  for (const Eye_polygon& other : scene.polygons())
    if (!other.corners.empty() && other.piece != piece) add_blocker(other.piece);
  if (scene.lines().size() + own_.size() >= most_lines)
    throw std::length_error("a path sees scenes of up to 2^21 lines of edges only");
  seen_.resize(scene.lines().size() + own_.size());
}

const Eye_line& Piece_along::line(std::uint32_t number) const {
  const std::size_t shared = scene_->lines().size();
  return number < shared ? scene_->lines()[number] : own_[number - shared];
}

std::uint32_t Piece_along::number_of(const Exact_pluecker& line) {
  if (const auto at = scene_->numbers().find(line); at != scene_->numbers().end()) return at->second;
  const auto number = static_cast<std::uint32_t>(scene_->lines().size() + own_.size());
  const auto [at, is_new] = own_numbers_.try_emplace(line, number);
  if (is_new) own_.push_back(eye_line(scene_->eye(), scene_->occluders().frame(), line));
  return at->second;
}

/// What of a piece is in front of the target's plane, on the eye's side.
void Piece_along::add_blocker(std::uint32_t piece) {
  const Eye_polygon& whole = scene_->polygons()[piece];
  const int towards = sightline::side(plane_, whole.corners);
  if (towards == side_) {
    blockers_.push_back(&whole);
    return;
  }
  if (towards != both_sides) return;
  Eye_polygon part{
      piece, sightline::clip(scene_->occluders().frame(), whole.corners, plane_, side_ > 0), {}, whole.eye_side, 0};
  for (std::size_t i = 0; i < part.corners.size(); ++i) {
    Exact_pluecker line = join(part.corners[i].exact, part.corners[(i + 1) % part.corners.size()].exact);
    const int sense = make_canonical(line);
    part.edges.push_back({number_of(line), sense});
  }
  part.size = squared_size(part.corners);
  blockers_.push_back(&parts_.emplace_back(std::move(part)));
}

bool Piece_along::is_out_of_the_way(const Eye_polygon& polygon, const Parameter_range& range) {
  const Near<4> low = scene_->eye().near(range.low), high = scene_->eye().near(range.high);
  // 1. Both on one side of its plane.
  const Near_plane& plane = scene_->occluders().plane(polygon.piece);
  const Near<4> near_plane = near(plane);
  const auto side_at = [&](const Quadratic_root& t, const Near<4>& eye) {
    const int sure = certain_dot(near_plane, eye);
    return sure != 0 ? sure : t.sign_of(polygon.eye_side);
  };
  const int from = side_at(range.low, low), to = side_at(range.high, high);
  const int eye_at = from * to < 0 ? 0 : from + to > 0 ? 1 : from + to < 0 ? -1 : 0;  // 0: it passes the plane
  const int target_at = sightline::side(plane, target_->corners);
  if (target_at == 0 || (eye_at != 0 && target_at == eye_at)) return true;
  // 2. All of it beyond one side of the target.
  const auto is_beyond = [&](const Line_side& side, std::span<const Near_point> corners, int sign) {
    const Near<4> at_low = join(low, line(side.line).near), at_high = join(high, line(side.line).near);
    for (const Near_point& corner : corners) {
      const Near<4> point = near(corner);
      const int a = sign * side.sign * certain_dot(at_low, point), b = sign * side.sign * certain_dot(at_high, point);
      if (a > 0 || b > 0) return false;
      if (a < 0 && b < 0) continue;
      const Quadratic f = sightline::side(scene_->eye(), line(side.line), corner.exact);
      if (sign * side.sign * range.low.sign_of(f) > 0 || sign * side.sign * range.high.sign_of(f) > 0) return false;
    }
    return true;
  };
  for (const Line_side& side : whole_)
    if (is_beyond(side, polygon.corners, 1)) return true;
  // 3. All of the target beyond one of its edges.
  if (eye_at == 0) return false;
  return std::any_of(polygon.edges.begin(), polygon.edges.end(),
                     [&](const Line_side& edge) { return is_beyond(edge, target_->corners, -eye_at); });
}

Piece_along::Blockers Piece_along::left_in(const Parameter_range& range, const Blockers& all) {
  Blockers left;
  for (const std::uint32_t blocker : all)
    if (!is_out_of_the_way(*blockers_[blocker], range)) left.push_back(blocker);
  return left;
}

bool Piece_along::is_seen_at(const Quadratic_root& t) {
  if (side_ * t.sign_of(target_->eye_side) <= 0) return false;
  Blockers all(blockers_.size());
  std::iota(all.begin(), all.end(), 0);
  const Parameter_range range{t, t};
  return run(t, range, left_in(range, all)).seen;
}

std::vector<Parameter_range> Piece_along::seen_within(const Parameter_range& whole) {
  // 1. What of the range is in front of it.
  Parameter_range front = whole;
  const auto in_front = [&](const Quadratic_root& t) { return side_ * t.sign_of(target_->eye_side); };
  if (in_front(whole.low) <= 0 && in_front(whole.high) <= 0) return {};
  std::vector<Quadratic_root> root;
  append_roots(target_->eye_side, whole, root);
  if (!root.empty()) (in_front(whole.low) > 0 ? front.high : front.low) = root[0];
  // 2. Runs until their ranges leave nothing.
  struct Work {
    Parameter_range range;
    Blockers blockers;
  };
  std::vector<Work> work{{front, Blockers(blockers_.size())}};
  std::iota(work[0].blockers.begin(), work[0].blockers.end(), 0);
  std::vector<Parameter_range> seen;
  while (!work.empty()) {
    const Work part = std::move(work.back());
    work.pop_back();
    const Blockers left = left_in(part.range, part.blockers);
    for (unsigned long attempt = 0;; ++attempt) {
      const Rational t = inner_rational(part.range, attempt);
      const Answer answer = run(moment(t), part.range, left);
      if (!answer.sure) continue;
      std::vector<Parameter_range> known{answer.range};
      if (answer.seen) {
        for (Parameter_range& range : seen_from_within(answer.part, t, part.range, left))
          known.push_back(std::move(range));
        seen.insert(seen.end(), known.begin(), known.end());
      }
      for (const Parameter_range& rest : rest_of(part.range, std::move(known))) work.push_back({rest, left});
      break;
    }
  }
  // 3. Put together.
  std::sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.low < b.low; });
  std::vector<Parameter_range> ranges;
  for (const Parameter_range& next : seen) {
    if (ranges.empty() || ranges.back().high < next.low || (ranges.back().high == next.low && !is_seen_at(next.low)))
      ranges.push_back(next);
    else if (ranges.back().high < next.high) ranges.back().high = next.high;
  }
  return ranges;
}

Along_cause Piece_along::cause(const Quadratic_root& end) const {
  if (end.sign_of(target_->eye_side) == 0) return {};
  Along_cause best{Along_kind::triple, {}};
  for (const auto& [at, lines] : ends_) {
    if (!(at == end) || lines[0] == no_line) continue;
    Along_cause cause{Along_kind::triple, {lines[0], lines[1], lines[2]}};
    for (std::size_t i = 0; i < 3; ++i)
      if (sgn(sightline::side(line(lines[i]).line, line(lines[(i + 1) % 3]).line)) == 0)
        cause.kind = Along_kind::edge_vertex;
    if (best.lines.empty() || cause.kind < best.kind) best = cause;
  }
  return best;
}

// ---- One run

const Piece_along::Seen_line& Piece_along::seen(std::uint32_t number) {
  Seen_line& entry = seen_[number];
  if (entry.run == run_) return entry;
  entry.run = run_;
  const Near<6>& near = line(number).near;
  entry.low = normal_of(join(low_, near));
  entry.high = at_once_ ? entry.low : normal_of(join(high_, near));
  entry.now = unit(normal_of(join(middle_, near)).at);
  return entry;
}

Piece_along::Answer Piece_along::run(const Quadratic_root& t, const Parameter_range& range, const Blockers& all) {
  ++counters_.runs;
  ++run_;
  now_ = &t;
  at_once_ = range.low == range.high;
  unlucky_ = false;
  low_ = scene_->eye().near(range.low);
  high_ = scene_->eye().near(range.high);
  middle_ = scene_->eye().near(t);
  facts_.clear();
  linear_.clear();
  front_.assign(blockers_.size(), 0);
  all_.clear();
  for (const std::uint32_t blocker : all) {
    front_[blocker] = t.sign_of(blockers_[blocker]->eye_side);
    if (front_[blocker] != 0) all_.push_back(blocker);
    else if (!at_once_) unlucky_ = true;
  }
  std::sort(all_.begin(), all_.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double one = blockers_[a]->size, other = blockers_[b]->size;
    return one != other ? one > other : a < b;
  });
  Answer answer{false, true, range, {}};
  answer.seen = find(whole_, all_, answer.part);
  if (unlucky_) {
    answer.sure = false;
    return answer;
  }
  if (at_once_) return answer;
  // As far as nothing that it rests on changes.
  std::array<std::array<std::uint32_t, 3>, 2> why{};
  why[0][0] = why[1][0] = no_line;
  std::vector<Quadratic_root> roots;
  for (const Fact& fact : facts_) {
    roots.clear();
    append_roots(*fact.sign, answer.range, roots);
    for (const Quadratic_root& root : roots) {
      if (root < t) {
        if (answer.range.low < root) {
          answer.range.low = root;
          why[0] = fact.lines;
        }
      } else if (root < answer.range.high) {
        answer.range.high = root;
        why[1] = fact.lines;
      }
    }
  }
  ends_.emplace_back(answer.range.low, why[0]);
  ends_.emplace_back(answer.range.high, why[1]);
  return answer;
}

int Piece_along::note(const Quadratic& f, const std::array<std::uint32_t, 3>& lines) {
  if (f.is_zero()) return 0;
  const int sign = now_->sign_of(f);
  if (at_once_) return sign;
  if (sign == 0) unlucky_ = true;
  else facts_.push_back({&f, lines});
  return sign;
}

int Piece_along::certain(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
  const Seen_line &a = seen(i), &b = seen(j), &c = seen(k);
  const Near<3> low = near_cross(a.low, b.low);
  const int first = certain_sum({near_dot(low, c.low)});
  if (first == 0 || at_once_) return first;
  const Near<3> high = near_cross(a.high, b.high), mixed = near_cross(a.low, b.high), other = near_cross(a.high, b.low);
  if (certain_sum({near_dot(high, c.high)}) != first) return 0;
  if (certain_sum({near_dot(low, c.high), near_dot(mixed, c.low), near_dot(other, c.low)}) != first) return 0;
  return certain_sum({near_dot(high, c.low), near_dot(mixed, c.high), near_dot(other, c.high)}) == first ? first : 0;
}

int Piece_along::sign(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
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

std::vector<int> Piece_along::signs(const Cone& cone, const Line_side& side) {
  std::vector<int> signs;
  for (std::size_t i = 0; i < cone.size(); ++i) {
    const Line_side &a = cone[i], &b = cone[(i + 1) % cone.size()];
    signs.push_back(side.sign * a.sign * b.sign * sign(a.line, b.line, side.line));
  }
  return signs;
}

/// The part where a side is positive. Pre: some ray is, and some negative.
Piece_along::Cone Piece_along::clip(const Cone& cone, const std::vector<int>& signs, const Line_side& side) {
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

Line_side Piece_along::inside(std::uint32_t blocker, std::size_t edge) const {
  const Line_side& side = blockers_[blocker]->edges[edge];
  return {side.line, -front_[blocker] * side.sign};
}

bool Piece_along::covers(std::uint32_t blocker, const Cone& cone) {
  for (std::size_t edge = 0; edge < blockers_[blocker]->edges.size(); ++edge)
    for (const int sign : signs(cone, inside(blocker, edge)))
      if (sign < 0) return false;
  note(blockers_[blocker]->eye_side, {no_line, 0, 0});
  return true;
}

bool Piece_along::is_outside(std::uint32_t blocker, std::size_t edge, const Cone& cone) {
  for (const int sign : signs(cone, inside(blocker, edge)))
    if (sign > 0) return false;
  note(blockers_[blocker]->eye_side, {no_line, 0, 0});
  return true;
}

/// Whether all of a blocker is on the outer side of a line.
bool Piece_along::is_beyond_side(std::uint32_t blocker, const Line_side& side) {
  for (const Near_point& corner : blockers_[blocker]->corners) {
    const Near<4> point = near(corner);
    const Near<6>& of = line(side.line).near;
    const int low = certain_dot(join(low_, of), point), high = at_once_ ? low : certain_dot(join(high_, of), point);
    int sign = low == high ? low : 0;
    if (sign == 0) {
      linear_.push_back(sightline::side(scene_->eye(), line(side.line), corner.exact));
      sign = note(linear_.back(), {no_line, 0, 0});
    }
    if (side.sign * sign > 0) return false;
  }
  return true;
}

std::vector<Triple> Piece_along::rays(const Cone& cone) {
  std::vector<Triple> rays;
  for (std::size_t i = 0; i < cone.size(); ++i) {
    const Line_side &a = cone[i], &b = cone[(i + 1) % cone.size()];
    Triple ray = unit(cross(seen(a.line).now, seen(b.line).now));
    for (double& x : ray) x *= a.sign * b.sign;
    rays.push_back(ray);
  }
  return rays;
}

Piece_along::Guess Piece_along::guess(std::uint32_t blocker, const Cone& cone, const std::vector<Triple>& rays) {
  bool covers = true;
  double deepest = 0;
  std::size_t best = 0;
  for (std::size_t edge = 0; edge < blockers_[blocker]->edges.size(); ++edge) {
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
      return cone[k].sign * dot(normal, unit(to)) > proposed_zero;
    };
    const auto& corners = blockers_[blocker]->corners;
    if (std::none_of(corners.begin(), corners.end(), is_inside)) return {Guess::beside_side, k};
  }
  return {Guess::across, best};
}

bool Piece_along::is_beside(std::uint32_t blocker, const Cone& cone) {
  const Guess first = guess(blocker, cone, rays(cone));
  if (first.kind == Guess::beside && is_outside(blocker, first.edge, cone)) return true;
  return first.kind == Guess::beside_side && is_beyond_side(blocker, cone[first.edge]);
}

bool Piece_along::find(const Cone& cone, const Blockers& left, Cone& found) {
  if (unlucky_) return false;
  ++counters_.parts;
  // 1. What is in front of it, as doubles have it.
  const std::vector<Triple> near_rays = rays(cone);
  Blockers near;
  for (const std::uint32_t blocker : left) {
    const Guess its = guess(blocker, cone, near_rays);
    if (its.kind == Guess::covers && covers(blocker, cone)) return false;
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
    const std::size_t count = blockers_[blocker]->edges.size(), begin = guess(blocker, cone, near_rays).edge;
    bool is_covered = true;
    for (std::size_t k = 0; k < count && is_covered; ++k) {
      const Line_side side = inside(blocker, (begin + k) % count);
      std::vector<int> at = signs(cone, side);
      if (unlucky_) return false;
      is_covered = std::any_of(at.begin(), at.end(), [](int s) { return s > 0; });
      if (!is_covered || std::none_of(at.begin(), at.end(), [](int s) { return s < 0; })) continue;
      const Cone inner = clip(cone, at, side);
      for (int& s : at) s = -s;
      const std::size_t before = facts_.size();
      if (find(clip(cone, at, {side.line, -side.sign}), near, found)) return true;
      const std::size_t between = facts_.size();
      near.insert(near.begin(), blocker);
      if (!find(inner, near, found)) return false;
      facts_.erase(facts_.begin() + static_cast<std::ptrdiff_t>(before),
                   facts_.begin() + static_cast<std::ptrdiff_t>(between));
      return true;
    }
    note(blockers_[blocker]->eye_side, {no_line, 0, 0});
    if (is_covered) return false;
    beside.push_back(blocker);
  }
}

// ---- What one point sees

std::vector<Parameter_range> Piece_along::seen_from_within(const Cone& part, const Rational& t,
                                                           const Parameter_range& range, const Blockers& blockers) {
  // 1. A point of the target in the part's middle, of few bits.
  Triple middle{};
  for (const Triple& ray : rays(part))
    for (std::size_t k = 0; k < 3; ++k) middle[k] += ray[k];
  middle = unit(middle);
  if (!std::isfinite(middle[0] + middle[1] + middle[2])) return {};  // beyond doubles
  const Homogeneous eye = scene_->eye().at(t);
  const std::array<Integer, 4>& h = plane_.exact;
  Homogeneous q;
  std::array<Integer, 3> direction;
  for (std::size_t k = 0; k < 3; ++k) direction[k] = Integer(std::round(std::ldexp(middle[k], 30)));
  for (const Line_side& side : whole_) {
    const Eye_line& its = line(side.line);
    Integer sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += (its.first[k] * t.get_den() + its.change[k] * t.get_num()) * direction[k];
    if (side.sign * sgn(sum) <= 0) return {};
  }
  const Integer across = h[0] * direction[0] + h[1] * direction[1] + h[2] * direction[2], at = dot(h, eye);
  for (std::size_t k = 0; k < 3; ++k) q[k] = eye[k] * across - direction[k] * at;
  q[3] = eye[3] * across;
  if (sgn(q[3]) == 0) return {};
  make_canonical(q);
  ++counters_.witnesses;
  // 2. When something is in between, ends included.
  const Near<4> near_q = near(scene_->occluders().frame(), q);
  std::vector<std::array<Rational, 2>> hidden;
  for (const std::uint32_t blocker : blockers) {
    const Eye_polygon& polygon = *blockers_[blocker];
    const int q_at = sgn(dot(scene_->occluders().plane(polygon.piece).exact, q));
    if (q_at == 0) return {};
    const auto is_off = [&](const Line_side& edge) {
      const Near<6>& near = line(edge.line).near;
      return q_at * edge.sign * certain_dot(join(low_, near), near_q) < 0 &&
             q_at * edge.sign * certain_dot(join(high_, near), near_q) < 0;
    };
    if (std::any_of(polygon.edges.begin(), polygon.edges.end(), is_off)) continue;
    const auto times = [](Quadratic f, int sign) {
      for (Integer& c : f.c) c *= sign;
      return f;
    };
    std::optional<std::array<Rational, 2>> in =
        where_not_negative(times(polygon.eye_side, -q_at), {Rational(0), Rational(1)});
    for (std::size_t k = 0; k < polygon.edges.size() && in; ++k) {
      const Line_side& edge = polygon.edges[k];
      in = where_not_negative(times(sightline::side(scene_->eye(), line(edge.line), q), q_at * edge.sign), *in);
    }
    if (in) hidden.push_back(*in);
  }
  // 3. What is left of the range.
  std::sort(hidden.begin(), hidden.end());
  std::vector<Parameter_range> seen;
  const auto add = [&](const Rational& low, const Rational& high) {
    if (!(low < high)) return;
    const Quadratic_root a = moment(low), b = moment(high);
    const Parameter_range part_of{a < range.low ? range.low : a, range.high < b ? range.high : b};
    if (part_of.low < part_of.high) seen.push_back(part_of);
  };
  Rational low = 0;
  for (const auto& [from, to] : hidden) {
    add(low, from);
    low = std::max(low, to);
  }
  add(low, Rational(1));
  return seen;
}

}  // namespace sightline
