#include <sightline/algorithms/weak_visibility/along/piece_along.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace sightline {

namespace {

/// The moments of a range on which a linear function is >= 0; none where it is so nowhere.
std::optional<std::array<Rational, 2>> where_not_negative(const Quadratic& f, std::array<Rational, 2> range) {
  if (sgn(f.c[1]) == 0) return sgn(f.c[0]) < 0 ? std::nullopt : std::optional(range);
  Rational root(Integer(-f.c[0]), f.c[1]);
  root.canonicalize();
  if (sgn(f.c[1]) > 0) range[0] = std::max(range[0], root);
  else range[1] = std::min(range[1], root);
  return range[0] > range[1] ? std::nullopt : std::optional(range);
}

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

Piece_along::Piece_along(const Along_scene& scene, std::uint32_t piece, int side, bool with_proofs)
    : with_proofs_(with_proofs),
      view_(std::make_unique<const Piece_view>(scene, piece, side)),
      run_(std::make_unique<Piece_run>(*view_)) {
  ++run_->counters().pieces;
}

bool Piece_along::is_seen_at(const Quadratic_root& t) {
  if (view_->side_of_eye(t) <= 0) return false;
  const Parameter_range range{t, t};
  const Piece_run::Answer answer = run_->run(t, range, view_->left_in(range, view_->all_blockers()));
  if (with_proofs_) keep(answer);
  return answer.seen;
}

void Piece_along::keep(const Piece_run::Answer& answer) {
  Along_certificate::Proof proof;
  proof.fragment = view_->target().piece;
  proof.from_behind = view_->side() < 0;
  for (const Line_side& side : answer.part) proof.cone.push_back(view_->named(side));
  for (const Along_step& step : answer.steps)
    if (step.is_cut) proof.tree.push_back({true, view_->named(step.cut), 0});
    else proof.tree.push_back({false, {}, view_->blocker(step.blocker).piece});
  proofs_.push_back({answer.range, std::move(proof)});
}

std::vector<Parameter_range> Piece_along::seen_within(const Parameter_range& whole) {
  // 1. What of the range is in front of it.
  Parameter_range front = whole;
  if (view_->side_of_eye(whole.low) <= 0 && view_->side_of_eye(whole.high) <= 0) return {};
  std::vector<Quadratic_root> root;
  append_roots(view_->target().eye_side, whole, root);
  if (!root.empty()) (view_->side_of_eye(whole.low) > 0 ? front.high : front.low) = root[0];
  // 2. Runs until their ranges leave nothing.
  struct Work {
    Parameter_range range;
    Blockers blockers;
  };
  std::vector<Work> work{{front, view_->all_blockers()}};
  std::vector<Parameter_range> seen;
  while (!work.empty()) {
    const Work part = std::move(work.back());
    work.pop_back();
    const Blockers left = view_->left_in(part.range, part.blockers);
    for (unsigned long attempt = 0;; ++attempt) {
      const Rational t = inner_rational(part.range, attempt);
      const Piece_run::Answer answer = run_->run(moment(t), part.range, left);
      if (!answer.sure) continue;
      if (with_proofs_) keep(answer);
      std::vector<Parameter_range> known{answer.range};
      if (answer.seen) {
        if (!with_proofs_)
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

// ---- Why a range ends

Along_cause Piece_along::cause(const Quadratic_root& end, const Parameter_range& seen) {
  if (is_edge_on(end)) return {};
  return cause_of(*view_, end, zero_at(end, seen));
}

std::vector<std::array<std::uint32_t, 3>> Piece_along::zero_at(const Quadratic_root& end, const Parameter_range& seen) {
  std::vector<std::array<std::uint32_t, 3>> found;
  const auto collect = [&] {
    for (const auto& [at, lines] : run_->zeros())
      if (at == end) found.push_back(lines);
  };
  collect();
  if (!found.empty()) return found;
  // What one point sees reaches beyond the last run: others, ever nearer.
  const bool is_low = end == seen.low;
  Blockers all = view_->all_blockers();
  Parameter_range range = seen;
  for (unsigned long attempt = 0;;) {
    all = view_->left_in(range, all);
    const Piece_run::Answer answer = run_->run(moment(inner_rational(range, attempt)), range, all);
    if (!answer.sure) {
      ++attempt;
      continue;
    }
    if (is_low ? answer.range.low == end : answer.range.high == end) break;
    attempt = 0;
    if (is_low) range.high = answer.range.low;
    else range.low = answer.range.high;
  }
  collect();
  return found;
}

// ---- What one point sees

std::vector<Parameter_range> Piece_along::seen_from_within(const Eye_cone& part, const Rational& t,
                                                           const Parameter_range& range, const Blockers& blockers) {
  // 1. A point of the target in the part's middle, of few bits.
  Triple middle{};
  for (const Triple& ray : run_->rays(part))
    for (std::size_t k = 0; k < 3; ++k) middle[k] += ray[k];
  middle = unit_direction(middle);
  if (!std::isfinite(middle[0] + middle[1] + middle[2])) return {};  // beyond doubles
  const Homogeneous eye = view_->eye().at(t);
  const std::array<Integer, 4>& h = view_->plane().exact;
  Homogeneous q;
  std::array<Integer, 3> direction;
  for (std::size_t k = 0; k < 3; ++k) direction[k] = Integer(std::round(std::ldexp(middle[k], 30)));
  for (const Line_side& side : view_->whole()) {
    const Eye_line& its = view_->line(side.line);
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
  ++run_->counters().witnesses;
  // 2. When something is in between, ends included.
  const Near<4> from = view_->eye().near(range.low), until = view_->eye().near(range.high);
  const Near<4> near_q = near(view_->scene().occluders().frame(), q);
  std::vector<std::array<Rational, 2>> hidden;
  for (const std::uint32_t blocker : blockers) {
    const Eye_polygon& polygon = view_->blocker(blocker);
    const int q_at = sgn(dot(view_->scene().occluders().plane(polygon.piece).exact, q));
    if (q_at == 0) return {};
    const auto is_off = [&](const Line_side& edge) {
      const Near<6>& near = view_->line(edge.line).near;
      return q_at * edge.sign * certain_dot(join(from, near), near_q) < 0 &&
             q_at * edge.sign * certain_dot(join(until, near), near_q) < 0;
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
      in = where_not_negative(times(sightline::side(view_->eye(), view_->line(edge.line), q), q_at * edge.sign), *in);
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
  for (const auto& [begin, end] : hidden) {
    add(low, begin);
    low = std::max(low, end);
  }
  add(low, Rational(1));
  return seen;
}

}  // namespace sightline
