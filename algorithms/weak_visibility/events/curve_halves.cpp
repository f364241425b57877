#include <sightline/algorithms/weak_visibility/events/curve_halves.h>

#include <algorithm>
#include <numeric>

namespace sightline {

Curve_halves::Curve_halves(const Event_lines& lines, int deepest)
    : lines_(&lines),
      deepest_(deepest),
      all_(lines.blockers().size()),
      courses_(static_cast<std::size_t>(deepest) + 1, std::vector<signed char>(lines.lines().size())) {
  std::iota(all_.begin(), all_.end(), 0u);
}

Curve_halves::Idle Curve_halves::search(const Event_curve& curve, const Visit& visit, const Together& together) {
  std::fill(courses_[0].begin(), courses_[0].end(), unset);
  return search(curve, curve.near(), all_, 0, visit, together);
}

int Curve_halves::course(const Near_part& part, std::uint32_t line, int depth) {
  signed char& known = courses_[static_cast<std::size_t>(depth)][line];
  if (known == unset) known = static_cast<signed char>(part.course(lines_->lines()[line].near).value_or(0));
  return known;
}

Curve_halves::Idle Curve_halves::search(const Event_curve& curve, const Near_part& part,
                                        std::span<const std::uint32_t> blockers, int depth, const Visit& visit,
                                        const Together& together) {
  if (curve.is_off(part)) return Idle::off_edges;
  // 1. The direction in which its lines go from the source to the target, if any do.
  int turn = 0;
  for (const std::vector<Event_lines::Literal>* literals : {&lines_->from(), &lines_->to()}) {
    bool positive = false, negative = false;
    for (const Event_lines::Literal& literal : *literals) {
      const int own = course(part, literal.line, depth);
      positive |= own * literal.sense > 0;
      negative |= own * literal.sense < 0;
    }
    const int own = positive ? 1 : negative ? -1 : 0;
    if ((positive && negative) || own * turn < 0) return Idle::off_polygons;
    if (own != 0) turn = own;
  }
  // 2. Pieces that block all of it, or some.
  std::vector<std::uint32_t> some;
  for (const std::uint32_t b : blockers) {
    bool all = turn != 0, any = true;
    for (const Event_lines::Literal& literal : lines_->blockers()[b].literals) {
      const int own = course(part, literal.line, depth);
      all &= own == literal.sense * turn;
      any &= turn == 0 || own != -literal.sense * turn;
      if (!any) break;
    }
    if (any && all) return Idle::covered;
    if (any) some.push_back(b);
  }
  const std::vector<signed char>& known = courses_[static_cast<std::size_t>(depth)];
  if (turn != 0 && together && together(some, turn, known)) return Idle::covered;
  // 3. By halves.
  if (depth == deepest_) return visit(part) ? Idle::off_edges : Idle::no;
  Idle reason = Idle::no;
  for (const Near_part& one : part.halves()) {
    std::transform(known.begin(), known.end(), courses_[static_cast<std::size_t>(depth) + 1].begin(),
                   [](signed char own) { return own == 1 || own == -1 ? own : unset; });
    const Idle own = search(curve, one, some, depth + 1, visit, together);
    if (own == Idle::no) return Idle::no;
    reason = std::max(reason, own);
  }
  return reason;
}

}  // namespace sightline
