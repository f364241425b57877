#include <sightline/algorithms/weak_visibility/events/event_shaft.h>

#include <sightline/kernel/time_limit.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sightline {
namespace {

/// What is expected of a search among so many edges, and of one cell, in microseconds: measured, and only a matter of
/// time.
double expected_search(std::size_t edges) {
  const double n = static_cast<double>(edges);
  return 400 + 5 * n * n + n * n * n / 6;
}
double expected_cell(std::size_t lines, std::size_t blockers) {
  return 1 + 0.04 * static_cast<double>(lines) + 0.02 * static_cast<double>(blockers);
}

constexpr unsigned long most_halvings = 48;  // of one side

}  // namespace

// ---- Patches

double Event_shaft::Patch::length(std::size_t axis) const {
  double longest = 0;
  for (const std::size_t first : {0, 2}) {
    const Near<4>&a = corners[first], &b = corners[axis == 0 ? first + 1 : 3 - first];
    longest = std::max(longest, std::hypot(a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2]));
  }
  return longest;
}

std::array<Event_shaft::Patch, 2> Event_shaft::Patch::halves(std::size_t axis) const {
  std::array<Patch, 2> parts{*this, *this};
  for (std::size_t k = 0; k < 2; ++k) {
    ++parts[k].halvings[axis];
    parts[k].at[axis] = 2 * at[axis] + k;
  }
  // The sides that are halved, each from a corner of the first half to one of the second.
  for (const std::size_t a : {std::size_t{0}, axis == 0 ? std::size_t{3} : std::size_t{1}}) {
    const std::size_t b = axis == 0 ? a ^ 1 : 3 - a;
    parts[0].corners[b] = parts[1].corners[a] = half(corners[a] + corners[b]);
  }
  return parts;
}

Homogeneous Event_shaft::Patch::point(unsigned long u, unsigned long v, unsigned long more) const {
  const std::array<Integer, 2> to{(Integer(at[0]) << more) + u, (Integer(at[1]) << more) + v},
      from{(Integer(1) << (halvings[0] + more)) - to[0], (Integer(1) << (halvings[1] + more)) - to[1]};
  const std::array<Integer, 4> weights{from[0] * from[1], to[0] * from[1], to[0] * to[1], from[0] * to[1]};
  Homogeneous sum{0, 0, 0, 0};
  for (std::size_t corner = 0; corner < 4; ++corner) {
    Integer weight = weights[corner];
    for (std::size_t other = 0; other < 4; ++other)
      if (other != corner) weight *= (*whole[other])[3];
    for (std::size_t k = 0; k < 4; ++k) sum[k] += weight * (*whole[corner])[k];
  }
  return sum;
}

Near_polygon Event_shaft::Patch::polygon(const Near_frame& frame) const {
  Near_polygon found;
  for (const auto& [u, v] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    Near_point corner = near_point(frame, point(static_cast<unsigned long>(u), static_cast<unsigned long>(v), 0));
    if (found.empty() || (found.back().exact != corner.exact && found.front().exact != corner.exact))
      found.push_back(std::move(corner));
  }
  return found;
}

std::vector<Event_shaft::Patch> Event_shaft::patches(std::span<const Filtered> polygon) {
  std::vector<Patch> found;
  for (std::size_t i = 1; i + 1 < polygon.size(); i += 2) {
    Patch& patch = found.emplace_back(Patch{{}, {0, 0}, {0, 0}, {}});
    const std::array<std::size_t, 4> corners{0, i, i + 1, std::min(i + 2, polygon.size() - 1)};
    for (std::size_t k = 0; k < 4; ++k) {
      patch.whole[k] = &polygon[corners[k]].exact;
      patch.corners[k] = polygon[corners[k]].near;
    }
  }
  return found;
}

Event_shaft::Joins Event_shaft::joins(const Cell& cell) {
  Joins all{{}, 0, 0};
  for (std::size_t p = 0; p < 4; ++p)
    for (std::size_t q = 0; q < 4; ++q) {
      const Near<6> one = join(cell.source.corners[p], cell.target.corners[q]);
      for (std::size_t k = 0; k < 6; ++k) all.at[k][4 * p + q] = one.at[k];
      all.size = std::max(all.size, one.size);
      if (!(one.error <= all.error) && !std::isnan(all.error)) all.error = one.error;
    }
  return all;
}

int Event_shaft::common_side(const Joins& joins, const Near<6>& line) {
  const double error = homogeneous_detail::error_of_products(6, Near<6>{{}, joins.size, joins.error}, line);
  int positive = 0, negative = 0;
  for (std::size_t n = 0; n < 16; ++n) {
    double value = 0;
    for (std::size_t k = 0; k < 6; ++k) value -= joins.at[k][n] * line.at[(k + 3) % 6];
    positive += value > error ? 1 : 0;
    negative += value < -error ? 1 : 0;
  }
  return positive == 16 ? 1 : negative == 16 ? -1 : 0;
}

// ---- Cells

Event_shaft::Event_shaft(const Occluders& occluders, const Event_lines& scene, const Events_options& options,
                         Event_counters& counters)
    : occluders_(&occluders),
      scene_(&scene),
      options_(&options),
      counters_(&counters),
      sides_(scene.lines().size()),
      used_(scene.lines().size()),
      together_(scene.lines().size(), scene.blockers()) {}

Event_shaft::Parts Event_shaft::divided() {
  Numbers lines, blockers;
  std::size_t edges = 0;
  for (std::uint32_t k = 0; k < scene_->lines().size(); ++k) {
    lines.push_back(k);
    edges += scene_->lines()[k].real ? 1 : 0;
  }
  for (std::uint32_t k = 0; k < scene_->blockers().size(); ++k) blockers.push_back(k);
  if (edges <= options_->undivided) return {{}, true, {}};
  const double whole = expected_search(edges);
  double cost = 0;
  for (const Patch& source : patches(scene_->source()))
    for (const Patch& target : patches(scene_->target()))
      if (!sightline_) cost += divide({source, target}, lines, blockers, whole - spent_);
  Parts parts{{}, !sightline_ && cost >= whole, sightline_};
  if (!parts.is_whole && !sightline_)
    for (const auto& [cell, own] : left_) parts.left.push_back(part(cell, own));
  return parts;
}

double Event_shaft::divide(const Cell& cell, const Numbers& open, const Numbers& blockers, double allowance) {
  ++counters_->shafts;
  const double before = spent_;
  spent_ += expected_cell(open.size(), blockers.size());
  // 1. What blocks it, or may block some of it.
  Numbers still_open, still_blocking;
  const bool covered = is_covered(joins(cell), open, blockers, still_open, still_blocking);
  // The sides that are known of this cell, not of its neighbour.
  const auto forget = [&](double cost) {
    for (const std::uint32_t line : open) sides_[line] = 0;
    return cost;
  };
  if (covered) {
    ++counters_->shafts_covered;
    return forget(0);
  }
  if (together_.holds(still_blocking,
                      [&](const Event_lines::Literal& literal) { return sides_[literal.line] * literal.sense; })) {
    ++counters_->shafts_together;
    return forget(0);
  }
  if (try_middle(cell, still_blocking)) return forget(0);
  // 2. Its halves, or itself where that costs less.
  std::size_t edges = 0;
  for (const std::uint32_t line : still_open) edges += scene_->lines()[line].real ? 1 : 0;
  const double own = expected_search(edges + 8);  // those of the cell, too
  allowance = std::min(allowance, own) - (spent_ - before);
  const std::array<double, 4> lengths{cell.source.length(0), cell.source.length(1), cell.target.length(0),
                                      cell.target.length(1)};
  const std::size_t longest =
      static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
  const Patch& divided = longest < 2 ? cell.source : cell.target;
  if (edges <= options_->undivided || allowance < 2 * expected_cell(still_open.size(), still_blocking.size()) ||
      divided.halvings[longest % 2] == most_halvings || has_run_out(options_->out_of_time)) {
    left_.emplace_back(cell, std::move(still_blocking));
    return forget(own);
  }
  const std::size_t kept = left_.size();
  const auto halves = divided.halves(longest % 2);
  const double at_halves = spent_;
  double cost = 0;
  for (std::size_t k = 0; k < 2 && !sightline_; ++k) {
    Cell part = cell;
    (longest < 2 ? part.source : part.target) = halves[k];
    const double left = allowance - (spent_ - at_halves);
    cost += divide(part, still_open, still_blocking, k == 0 ? left / 2 : left);
  }
  if (cost >= own && !sightline_) {
    left_.resize(kept);
    left_.emplace_back(cell, std::move(still_blocking));
    cost = own;
  }
  return forget(cost);
}

bool Event_shaft::is_covered(const Joins& joins, const Numbers& open, const Numbers& blockers, Numbers& still_open,
                             Numbers& still_blocking) {
  for (const std::uint32_t line : open)
    sides_[line] = static_cast<signed char>(common_side(joins, scene_->lines()[line].near));
  bool covered = false;
  for (const std::uint32_t b : blockers) {
    bool any = true;
    covered = true;
    for (const Event_lines::Literal& literal : scene_->blockers()[b].literals) {
      const int side = sides_[literal.line] * literal.sense;
      covered &= side > 0;
      any &= side >= 0;
    }
    if (covered) break;
    if (!any) continue;
    still_blocking.push_back(b);
    for (const Event_lines::Literal& literal : scene_->blockers()[b].literals)
      if (sides_[literal.line] == 0 && !std::exchange(used_[literal.line], char{1})) still_open.push_back(literal.line);
  }
  for (const std::uint32_t line : still_open) used_[line] = 0;
  return covered;
}

bool Event_shaft::try_middle(const Cell& cell, const Numbers& blockers) {
  const auto middle = [](const Patch& patch) {
    return half(half(patch.corners[0] + patch.corners[2]) + half(patch.corners[1] + patch.corners[3]));
  };
  const Near<6> line = join(middle(cell.source), middle(cell.target));
  for (const std::uint32_t b : blockers) {
    const std::vector<Event_lines::Literal>& literals = scene_->blockers()[b].literals;
    if (std::none_of(literals.begin(), literals.end(), [&](const Event_lines::Literal& literal) {
          return literal.sense * certain_side(line, scene_->lines()[literal.line].near) < 0;
        }))
      return false;
  }
  const std::array<Near_point, 2> ends{near_point(occluders_->frame(), cell.source.point(1, 1, 1)),
                                       near_point(occluders_->frame(), cell.target.point(1, 1, 1))};
  if (occluders_->blocker(ends[0], ends[1], scene_->near_source_plane(), scene_->near_target_plane())) return false;
  sightline_ = ends;
  return true;
}

Event_shaft::Part Event_shaft::part(const Cell& cell, const Numbers& blockers) const {
  Part part{cell.source.polygon(occluders_->frame()), cell.target.polygon(occluders_->frame()), {}};
  for (const std::uint32_t b : blockers) part.pieces.push_back(scene_->blockers()[b].piece);
  std::sort(part.pieces.begin(), part.pieces.end());
  part.pieces.erase(std::unique(part.pieces.begin(), part.pieces.end()), part.pieces.end());
  return part;
}

// ---- The whole

Events_answer search_shaft(const Occluders& occluders, const Near_polygon& source, const Near_plane& source_plane,
                           const Near_polygon& target, const Near_plane& target_plane, int beside,
                           const Events_options& options, Event_counters& counters) {
  const Event_lines lines(occluders, source, source_plane, target, target_plane, beside, options.out_of_time);
  Event_search whole(occluders, lines, options, counters);
  const Event_shaft::Parts parts = whole.in_one_shadow() ? Event_shaft::Parts{{}, true, {}}
                                                         : Event_shaft(occluders, lines, options, counters).divided();
  if (parts.is_whole) return whole.run();
  Events_answer answer;
  answer.status = Weak_status::hidden;
  if (parts.sightline) {
    ++counters.confirmed;
    return {Weak_status::visible, *parts.sightline};
  }
  Events_options left = options;
  for (const Event_shaft::Part& part : parts.left) {
    if (has_run_out(options.out_of_time)) {
      answer.status = Weak_status::undecided;
      break;
    }
    ++counters.shafts_left;
    const Event_lines own(occluders, part.source, source_plane, part.target, target_plane, beside, part.pieces,
                          options.out_of_time);
    Event_search search(occluders, own, left, counters);
    const Events_answer found = search.run();
    if (found.status != Weak_status::hidden) answer = found;
    if (found.status == Weak_status::visible) break;
    left.events -= std::min(left.events, search.events());
  }
  return answer;
}

}  // namespace sightline
