#include <sightline/algorithms/weak_visibility/search/line_search.h>

#include <sightline/algorithms/weak_visibility/search/near_lines.h>
#include <sightline/algorithms/weak_visibility/search/touching_lines.h>
#include <sightline/kernel/line_table.h>
#include <sightline/kernel/uniform.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace sightline {
namespace {

constexpr std::size_t deepest = 1000;
// Of the steps in which a cell's polygons were made smaller: after how many what else is tried, and after how many
// nothing.
constexpr int forms_after = 2, special_after = 3, smallest = 80, most_sectors = 24;
constexpr double close = 1e-12;  // to an edge, where its own row of the domain tells more; doubles err by a hundredth
constexpr std::size_t many = 1000;         // candidates: those near a line are sooner found in the tree of boxes
constexpr float edges_for_all = 6;         // of 0 to 20, what takes the fewest cells among random triangles
constexpr double thin = 1e-8;              // what doubles leave to exact programs
constexpr std::size_t random_starts = 32;  // of lines that are moved into thin cells; eight leave some unfound

/// Dear proofs are tried again only once the polygons have become much smaller: after 2, 3, 5, 8, ... steps.
bool is_worth_it(int narrowed) {
  int last = 1, next = forms_after;
  while (next < narrowed) last = std::exchange(next, next + last);
  return next == narrowed;
}

}  // namespace

Line_search::Line_search(const Occluders& occluders, Near_polygon source, const Near_plane& source_plane,
                         Near_polygon target, std::uint32_t target_piece, const Weak_search_options& options)
    : Line_search(occluders, std::move(source), source_plane, std::move(target), occluders.plane(target_piece), options,
                  target_piece) {}

Line_search::Line_search(const Occluders& occluders, Near_polygon source, const Near_plane& source_plane,
                         Near_polygon target, const Near_plane& target_plane, const Weak_search_options& options,
                         std::uint64_t salt)
    : occluders_(&occluders),
      source_plane_(&source_plane),
      target_plane_(&target_plane),
      options_(&options),
      dice_(options.seed * 0x9e3779b97f4a7c15u + salt),
      lines_(occluders),
      proofs_(occluders, lines_, source_plane, *target_plane_, options.out_of_time) {
  domains_.push_back(std::make_unique<Line_domain>(std::make_shared<const Near_polygon>(std::move(source)),
                                                   std::make_shared<const Near_polygon>(std::move(target))));
}

Weak_answer Line_search::run(Weak_counters& counters) {
  counters_ = &counters;
  if (std::exchange(waits_, false)) {
    counters += first_counters_;
    return answer_of(refute(0, 0));
  }
  ++counters.targets;
  const Refutation found = begin(0);
  counters.away += !facing_;
  return answer_of(found);
}

std::optional<Weak_answer> Line_search::first_answer(Weak_counters& counters) {
  only_first_ = true;
  counters_ = &first_counters_;
  ++first_counters_.targets;
  const Refutation found = begin(0);
  only_first_ = false;
  if (found.status == Weak_status::undecided) return std::nullopt;
  counters_ = &counters;
  counters += first_counters_;
  counters.away += !facing_;
  return answer_of(found);
}

std::size_t Line_search::bytes() const {
  std::size_t bytes = sizeof(*this);
  for (const std::unique_ptr<Line_domain>& domain : domains_)
    if (domain)
      bytes += domain->candidates.capacity() * sizeof(Candidate) + domain->pair_count() * sizeof(Pluecker) +
               (domain->source.size() + domain->target.size()) * sizeof(Near_point);
  return bytes;
}

Weak_answer Line_search::answer_of(const Refutation& found) {
  Weak_answer answer;
  answer.status = found.status;
  for (const Edge_lines::Edge_line& line : lines_.all()) answer.lines.push_back(line.edge);
  counters_->lines += lines_.size();
  if (found.status == Weak_status::visible) answer.sightline.assign(sightline_.begin(), sightline_.end());
  else answer.proof = in_order(found.node);
  return answer;
}

Line_search::Refutation Line_search::begin(std::uint32_t d) {
  if (is_across(*source_plane_, domains_[d]->target))
    return cut(d, {false, *source_plane_}, [this](std::uint32_t part) { return begin(part); });
  if (is_across(*target_plane_, domains_[d]->source))
    return cut(d, {true, *target_plane_}, [this](std::uint32_t part) { return begin(part); });
  const int q = side(*source_plane_, domains_[d]->target), p = side(*target_plane_, domains_[d]->source);
  if (q <= 0 || p == 0 || (p < 0 && !options_->two_sided)) {
    return leaf({Weak_step::Kind::away, 0, {}, {}}, {});
  }
  facing_ = true;
  if (const std::optional<std::uint32_t> blocker = whole_blocker(*domains_[d])) {
    ++counters_->blocked;
    ++counters_->by_one;
    return leaf({Weak_step::Kind::blocked, *blocker, {}, {}}, {});
  }
  if (options_->rays > 0 && try_lines(*domains_[d])) return {Weak_status::visible, 0, {}};
  Line_domain& domain = *domains_[d];
  if (domain.pair_count() > most_pairs) return open();
  for (const std::uint32_t piece : occluders_->near_shaft(domain.source, domain.target))
    domain.candidates.push_back({piece, 0, 0});
  settle(domain);
  counters_->occluders += domain.candidates.size();
  if (try_rays(d)) return {Weak_status::visible, 0, {}};
  if (!only_first_) return refute(d, 0);
  waits_ = d == 0;
  return {Weak_status::undecided, 0, {}};
}

std::optional<std::uint32_t> Line_search::whole_blocker(Line_domain& domain) const {
  if (domain.pair_count() > most_pairs) return std::nullopt;
  const Line_weights line = Line_weights::middle(domain);
  const auto corners = [](const Near_polygon& polygon) {
    return Occluders::Segment{polygon[0].near, polygon[polygon.size() / 2].near};
  };
  return occluders_->on_segment(
      {weighted_mean(domain.source, line.source), weighted_mean(domain.target, line.target)},
      [&](std::uint32_t piece) { return occluders_->blocks_all(piece, domain.source, domain.target, domain.pairs()); },
      Occluders::segments_between(corners(domain.source), corners(domain.target)));
}

bool Line_search::is_between(std::uint32_t piece, const Triple& p, const Triple& q) const {
  const std::array<double, 4>& h = occluders_->plane(piece).near;
  return std::fabs(likely_value(h, p)) > close && std::fabs(likely_value(h, q)) > close;
}

bool Line_search::is_seen_along(const Line_domain& domain, const Line_weights& line) {
  const Triple p = weighted_mean(domain.source, line.source), q = weighted_mean(domain.target, line.target);
  const auto is_met = [&](std::uint32_t piece) { return is_between(piece, p, q); };
  if (occluders_->on_segment({p, q}, is_met) || confirm(domain, line)) return false;
  ++counters_->by_rays;
  return true;
}

std::optional<std::array<Near_point, 2>> Line_search::beside(const Triple& p, const Triple& q,
                                                             Weak_counters& counters) {
  counters_ = &counters;
  const Line_domain& domain = *domains_[0];
  if (is_across(*source_plane_, domain.target) || is_across(*target_plane_, domain.source)) return std::nullopt;
  for (const Line_weights& line : lines_beside(domain.source, domain.target, p, q))
    if (is_seen_along(domain, line)) return sightline_;
  return std::nullopt;
}

bool Line_search::try_lines(const Line_domain& domain) {
  const auto is_seen = [&](const Line_weights& line) { return is_seen_along(domain, line); };
  if (is_seen(Line_weights::middle(domain))) return true;
  const std::vector<Line_weights> lines = near_lines(domain.source, *source_plane_, domain.target, *target_plane_);
  return std::any_of(lines.begin(), lines.end(), is_seen);
}

const std::vector<Candidate>& Line_search::candidates_of(std::uint32_t d) {
  Line_domain& domain = *domains_[d];
  if (!domain.settled) {
    std::uint32_t above = parents_[d];
    while (!domains_[above]->settled) above = parents_[above];
    domain.candidates = domains_[above]->candidates;
    settle(domain);
  }
  return domain.candidates;
}

void Line_search::settle(Line_domain& domain) const {
  domain.settled = true;
  std::size_t kept = 0;
  for (const Candidate& candidate : domain.candidates) {
    int sense = candidate.sense;
    if (sense == 0) {
      const Near_plane& h = occluders_->plane(candidate.piece);
      const int s = side(h, domain.source), t = side(h, domain.target);
      if (s == 0 || t == 0 || (s == t && s != both_sides)) continue;
      if (s != both_sides && t != both_sides) sense = s;
    }
    domain.candidates[kept++] = {candidate.piece, sense, candidate.share, candidate.edge};
  }
  domain.candidates.resize(kept);
}

bool Line_search::try_rays(std::uint32_t d) {
  constexpr std::size_t most = 8;  // with four times as many some searches take a twentieth less cells, and longer
  Line_domain& domain = *domains_[d];
  const std::size_t samples = std::min(most, domain.candidates.size() / 8),
                    rays = static_cast<std::size_t>(std::max(0, options_->rays));
  for (std::size_t k = 0; k < std::max(samples, rays) && !out_of_time(); ++k) {
    const Line_weights line = k == 0 ? Line_weights::middle(domain) : random_line(domain);
    bool is_free = true;
    for_each_blocker(domain, line, [&](Candidate& blocker) {
      is_free = false;
      if (k < samples) blocker.share += 1 / static_cast<float>(samples);
      return k < samples;
    });
    if (is_free && k < rays && !confirm(domain, line)) {
      ++counters_->by_rays;
      return true;
    }
  }
  return false;
}

Line_weights Line_search::random_line(const Line_domain& domain, int power) {
  const Uniform unit(0.05, 1);
  Line_weights line = Line_weights::middle(domain);
  for (std::vector<double>* weights : {&line.source, &line.target}) {
    double sum = 0;
    for (double& w : *weights) {
      w = unit(dice_);
      if (power != 1) w = std::pow(w, power);
      sum += w;
    }
    for (double& w : *weights) w /= sum;
  }
  return line;
}

Line_search::Refutation Line_search::refute(std::uint32_t d, std::size_t depth) {
  counters_->deepest = std::max(counters_->deepest, depth);
  if (++cells_ > options_->cells || open_ >= options_->open || depth > deepest || out_of_time()) return open();
  ++counters_->cells;
  Line_weights line;
  Refutation ended;
  switch (look_for_line(d, line, ended)) {
    case Look::ended: return ended;
    case Look::unclear: return narrow(d, depth);
    case Look::found: break;
  }
  std::vector<Candidate> blockers;
  find_blockers(d, line, blockers);
  std::vector<Edge_sign> unknown;
  const Candidate* chosen = choose(*domains_[d], blockers, unknown);
  if (chosen == nullptr) {
    const std::optional<std::uint32_t> closest = confirm(*domains_[d], line);
    if (!closest) return {Weak_status::visible, 0, {}};
    // What the exact test found and doubles did not.
    blockers.clear();
    for (const Candidate& candidate : candidates_of(d))
      if (candidate.piece == *closest) blockers.push_back(candidate);
    chosen = choose(*domains_[d], blockers, unknown);
    if (chosen == nullptr || (chosen->sense != 0 && unknown.empty())) return narrow(d, depth);
  }
  const Candidate blocker = *chosen;
  if (blocker.sense == 0) {
    const Near_plane& h = occluders_->plane(blocker.piece);
    ++counters_->cuts;
    return cut(d, {is_across(h, domains_[d]->source), h},
               [this, depth](std::uint32_t part) { return refute(part, depth + 1); });
  }
  return branch(d, blocker, unknown, depth);
}

Line_search::Refutation Line_search::open() {
  ++counters_->open;
  ++open_;
  Refutation r = leaf({Weak_step::Kind::open, 0, {}, {}}, {});
  r.status = Weak_status::undecided;
  return r;
}

Line_search::Refutation Line_search::leaf(Weak_step step, Used used) {
  nodes_.push_back({std::move(step), {}});
  return {Weak_status::hidden, static_cast<std::uint32_t>(nodes_.size() - 1), used};
}

template <class Part>
Line_search::Refutation Line_search::cut(std::uint32_t d, const Cell_cut& by, Part part) {
  Refutation both{Weak_status::hidden, 0, {}};
  std::array<std::uint32_t, 2> parts{};
  for (const bool front : {true, false}) {
    const Line_domain& whole = *domains_[d];
    auto part_of_polygon = std::make_shared<const Near_polygon>(
        clip(occluders_->frame(), by.source ? whole.source : whole.target, by.plane, front));
    auto piece = by.source ? std::make_unique<Line_domain>(std::move(part_of_polygon), whole.shared_target)
                           : std::make_unique<Line_domain>(whole.shared_source, std::move(part_of_polygon));
    piece->bisections = whole.bisections;
    piece->narrowed = whole.narrowed;
    piece->sectors = whole.sectors;
    const std::uint32_t number = static_cast<std::uint32_t>(domains_.size());
    domains_.push_back(std::move(piece));
    parents_.push_back(d);
    const std::size_t known = lemmas_.size();
    const Refutation r = part(number);
    domains_[number].reset();
    forget_lemmas(known);  // what was learned in the part holds nowhere else
    if (r.status == Weak_status::visible) return r;
    if (r.status == Weak_status::undecided) both.status = Weak_status::undecided;
    both.used |= r.used;
    parts[front ? 0 : 1] = r.node;
  }
  nodes_.push_back(
      {{by.source ? Weak_step::Kind::cut_source : Weak_step::Kind::cut_target, 0, by.plane.exact, {}}, parts});
  both.node = static_cast<std::uint32_t>(nodes_.size() - 1);
  return both;
}

Line_search::Refutation Line_search::narrow(std::uint32_t d, std::size_t depth) {
  if (domains_[d]->narrowed > smallest) return open();
  if (options_->thorough || domains_[d]->narrowed >= special_after)
    if (const std::optional<Cell_cut> plane = common_plane(cell_, *occluders_)) {
      ++counters_->cuts;
      return cut(d, *plane, [this, depth](std::uint32_t part) { return refute(part, depth + 1); });
    }
  if (options_->thorough && domains_[d]->sectors < most_sectors)
    if (const std::optional<Cell_cut> plane = sector_plane(cell_, *source_plane_, *target_plane_)) {
      ++counters_->cuts;
      return cut(d, *plane, [this, depth](std::uint32_t part) {
        ++domains_[part]->sectors;
        return refute(part, depth + 1);
      });
    }
  if (!cell_.rows.empty())
    if (const std::vector<Cell_cut> cuts = shaves(cell_, proofs_.game(), occluders_->frame(), *counters_);
        !cuts.empty())
      return shave(d, cuts, 0, depth);
  return bisect(d, depth);
}

Line_search::Refutation Line_search::shave(std::uint32_t d, const std::vector<Cell_cut>& cuts, std::size_t k,
                                           std::size_t depth) {
  while (k < cuts.size() && !is_across(cuts[k].plane, cuts[k].source ? domains_[d]->source : domains_[d]->target)) ++k;
  if (k == cuts.size()) {
    ++domains_[d]->narrowed;
    return refute(d, depth + 1);
  }
  ++counters_->shaves;
  bool front = true;
  return cut(d, cuts[k], [&](std::uint32_t part) {
    return std::exchange(front, false) ? shave(part, cuts, k + 1, depth) : refute(part, depth + 1);
  });
}

Line_search::Refutation Line_search::bisect(std::uint32_t d, std::size_t depth) {
  if (domains_[d]->bisections >= options_->bisections) return open();
  ++counters_->bisections;
  const std::optional<Cell_cut> plane = bisector(*domains_[d], occluders_->frame());
  if (!plane) return open();
  return cut(d, *plane, [this, depth](std::uint32_t part) {
    ++domains_[part]->bisections;
    ++domains_[part]->narrowed;
    return refute(part, depth + 1);
  });
}

Line_search::Refutation Line_search::branch(std::uint32_t d, const Candidate& blocker,
                                            const std::vector<Edge_sign>& unknown, std::size_t depth) {
  // 1. Outside of each edge, then inside of it for those that follow.
  const std::size_t base = path_.size();
  std::vector<Refutation> outside;
  for (const Edge_sign& edge : unknown) {
    push({edge.line, -edge.inside});
    Refutation r = refute(d, depth + 1);
    pop();
    if (r.status == Weak_status::visible) {
      while (path_.size() > base) pop();
      return r;
    }
    const std::size_t place = path_.size();
    const bool needless = r.status == Weak_status::hidden && place < Used().size() && !r.used[place];
    outside.push_back(r);
    if (needless) break;  // it refutes the cell without that edge
    push({edge.line, edge.inside});
  }
  // 2. Inside of all of them: blocked. Or what an edge did not need.
  Refutation rest;
  if (path_.size() == base + unknown.size()) {
    ++counters_->blocked;
    Used used;
    for (const Edge_sign& edge : signs_of(blocker))
      for (std::size_t k = 0; k < std::min(path_.size(), used.size()); ++k)
        if (path_[k].line == edge.line) used.set(k);
    rest = leaf({Weak_step::Kind::blocked, blocker.piece, {}, {}}, used);
  } else {
    ++counters_->jumps;
    rest = outside.back();
    outside.pop_back();
  }
  while (path_.size() > base) pop();
  return put_together(unknown, outside, rest);
}

Line_search::Refutation Line_search::put_together(const std::vector<Edge_sign>& edges,
                                                  const std::vector<Refutation>& outside, Refutation rest) {
  // From the end; an edge that the rest does without is left out.
  for (std::size_t k = outside.size(); k-- > 0;) {
    const std::size_t place = path_.size() + k;
    if (rest.status == Weak_status::hidden && place < Used().size() && !rest.used[place]) {
      ++counters_->jumps;
      continue;
    }
    const std::array<std::uint32_t, 2> parts =
        edges[k].inside > 0 ? std::array{rest.node, outside[k].node} : std::array{outside[k].node, rest.node};
    nodes_.push_back({{Weak_step::Kind::line, edges[k].line, {}, {}}, parts});
    rest.node = static_cast<std::uint32_t>(nodes_.size() - 1);
    rest.used |= outside[k].used;
    if (place < Used().size()) rest.used.reset(place);
    if (outside[k].status == Weak_status::undecided) rest.status = Weak_status::undecided;
  }
  return rest;
}

const std::vector<Edge_lines::Edge>& Line_search::edge_lines(std::uint32_t piece) {
  const std::vector<Edge_lines::Edge>& edges = lines_.of(piece);
  sign_.resize(lines_.size(), 0);
  return edges;
}

template <class Visit>
void Line_search::for_each_blocker(Line_domain& domain, const Line_weights& line, Visit visit) {
  const Triple p = weighted_mean(domain.source, line.source), q = weighted_mean(domain.target, line.target);
  const Pluecker pluecker = pluecker_of_pair(p, q);
  std::vector<Candidate>& candidates = domain.candidates;
  if (candidates.size() < many) {
    for (Candidate& candidate : candidates)
      if (is_in_the_way(domain, line, p, q, pluecker, candidate) && !visit(candidate)) return;
    return;
  }
  auto next = candidates.begin();  // both are by rank
  for (const std::uint32_t piece : occluders_->near_segment(p, q, close)) {
    const std::uint32_t rank = occluders_->rank(piece);
    next = std::lower_bound(next, candidates.end(), rank, [&](const Candidate& candidate, std::uint32_t least) {
      return occluders_->rank(candidate.piece) < least;
    });
    if (next == candidates.end()) return;
    if (next->piece == piece && is_in_the_way(domain, line, p, q, pluecker, *next) && !visit(*next)) return;
  }
}

bool Line_search::is_in_the_way(Line_domain& domain, const Line_weights& line, const Triple& p, const Triple& q,
                                const Pluecker& pluecker, Candidate& candidate) {
  int sense = candidate.sense;
  if (sense == 0) {
    const std::array<double, 4>& h = occluders_->plane(candidate.piece).near;
    const double from = likely_value(h, p), to = likely_value(h, q);
    if ((from > 0) == (to > 0)) return false;
    sense = from > 0 ? 1 : -1;
  }
  const std::span<const Pluecker> edges = occluders_->edges(candidate.piece);
  const auto is_inside = [&](std::size_t e) {
    double height = dot(pluecker, edges[e]);
    if (std::fabs(height) < close) {
      const Edge_lines::Edge edge = edge_lines(candidate.piece)[e];
      height = edge.sense * height_of(domain, edge.line, line);
    }
    return sense * height > 0;
  };
  // The edge that the last line passed outside, this one mostly does, too.
  const std::size_t last = candidate.edge;
  if (!is_inside(last)) return false;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (e != last && !is_inside(e)) {
      candidate.edge = static_cast<std::uint32_t>(e);
      return false;
    }
  return true;
}

void Line_search::find_blockers(std::uint32_t d, const Line_weights& line, std::vector<Candidate>& blockers) {
  blockers.clear();
  candidates_of(d);
  for_each_blocker(*domains_[d], line, [&](const Candidate& blocker) {
    blockers.push_back(blocker);
    return true;
  });
  std::sort(blockers.begin(), blockers.end(), [](const Candidate& a, const Candidate& b) { return a.piece < b.piece; });
}

double Line_search::height_of(Line_domain& domain, std::uint32_t line, const Line_weights& weights) const {
  if (sign_[line] != 0) return sign_[line];
  const Side_row& r = row(domain, line);
  if (r.decided != 0) return r.decided;
  double sum = 0;
  for (std::size_t i = 0; i < domain.source.size(); ++i)
    for (std::size_t j = 0; j < domain.target.size(); ++j)
      sum += weights.source[i] * weights.target[j] * r.values[i * domain.target.size() + j];
  return sum;
}

const Candidate* Line_search::choose(Line_domain& domain, std::vector<Candidate>& blockers,
                                     std::vector<Edge_sign>& unknown) {
  std::stable_sort(blockers.begin(), blockers.end(),
                   [](const Candidate& a, const Candidate& b) { return a.share > b.share; });
  const Candidate* best = nullptr;
  float best_cost = 0;
  std::vector<Edge_sign> open_edges;
  for (const Candidate& blocker : blockers) {
    if (blocker.sense == 0) {
      if (best == nullptr) best = &blocker;
      continue;
    }
    const auto cost = [&] { return static_cast<float>(open_edges.size()) - edges_for_all * blocker.share; };
    const auto is_worse = [&] {
      return best != nullptr && best->sense != 0 &&
             (cost() > best_cost || (cost() == best_cost && open_edges.size() >= unknown.size()));
    };
    open_edges.clear();
    if (is_worse()) break;  // whatever its edges are, and those of all that follow
    bool outside = false;   // then the line is not strictly in the cell
    for (const Edge_sign& edge : signs_of(blocker)) {
      const int known = sign_[edge.line] != 0 ? sign_[edge.line] : row(domain, edge.line).decided;
      if (known == 0) open_edges.push_back(edge);
      else if (known != edge.inside) outside = true;
      if (outside || is_worse()) break;
    }
    if (outside || is_worse()) continue;
    best = &blocker;
    best_cost = cost();
    unknown = open_edges;
    if (unknown.empty()) break;
  }
  return best;
}

std::vector<Line_search::Edge_sign> Line_search::signs_of(const Candidate& blocker) {
  std::vector<Edge_sign> signs;
  for (const Edge_lines::Edge& edge : edge_lines(blocker.piece))
    signs.push_back({edge.line, edge.sense * blocker.sense});
  return signs;
}

Line_search::Look Line_search::look_for_line(std::uint32_t d, Line_weights& line, Refutation& ended) {
  using Relaxation = Cell_proofs::Relaxation;
  if (by_lemma(ended)) return Look::ended;
  Line_domain& domain = *domains_[d];
  // 1. What the polygons alone do not decide.
  cell_ = {&domain, &lines_, &occluders_->frame(), {}};
  for (std::size_t k = 0; k < path_.size(); ++k) {
    const Side_row& r = row(domain, path_[k].line);
    if (r.decided == path_[k].sign) continue;
    if (r.decided == -path_[k].sign) {
      ended = conclude({{k, Rational(1), {}, {}}});
      return Look::ended;
    }
    cell_.rows.push_back({k, path_[k], &r});
  }
  line = Line_weights::middle(domain);
  if (cell_.rows.empty()) return Look::found;

  // 2. The relaxation: no line, or weights to start from.
  std::vector<Multiplier> proof;
  const auto ends_with = [&](bool proved) {
    if (proved) ended = conclude(proof);
    return proved;
  };
  const double value = proofs_.relax(cell_, *counters_);
  Relaxation relaxation = Relaxation::unclear;
  if (value < thin && ends_with((relaxation = proofs_.by_relaxation(cell_, proof, *counters_)) == Relaxation::empty))
    return Look::ended;
  const std::vector<Line_weights> starts = starts_of(domain);
  for (const Line_weights& start : starts) {
    line = start;
    if (finder_.find(cell_, line, *counters_)) return Look::found;
  }

  // 3. What takes longer.
  std::optional<Line_finder::Whole_rows> whole;  // once they are asked for
  const auto is_found_exactly = [&] {
    if (!whole) whole = Line_finder::whole_rows(cell_);
    return finder_.find_exactly(cell_, *whole, line, *counters_);
  };
  if (ends_with(proofs_.at_corner(cell_, proof, *counters_))) return Look::ended;
  const bool worth_it = is_worth_it(domain.narrowed) || options_->thorough;
  if (value < thin && (worth_it || domain.narrowed < forms_after)) {
    if (relaxation == Relaxation::unclear && ends_with(proofs_.by_exact_relaxation(cell_, proof, *counters_)))
      return Look::ended;
    for (std::size_t c = 0; c < std::min<std::size_t>(2, starts.size()); ++c) {
      line = starts[c];
      if (is_found_exactly()) return Look::found;
    }
  }
  if (options_->thorough && (domain.narrowed < forms_after || is_worth_it(domain.narrowed)))
    for (std::size_t k = 0; k < random_starts; ++k) {
      line = random_line(domain, k % 2 == 0 ? 3 : 15);
      if (is_found_exactly()) return Look::found;
    }
  if (worth_it && ends_with(proofs_.by_forms(cell_, true, options_->thorough, proof, *counters_) ||
                            proofs_.by_forms(cell_, false, options_->thorough, proof, *counters_)))
    return Look::ended;
  return Look::unclear;
}

std::vector<Line_weights> Line_search::starts_of(const Line_domain& domain) {
  const std::size_t m = domain.source.size(), n = domain.target.size();
  const Line_weights middle = Line_weights::middle(domain);
  std::vector<Line_weights> starts(1, Line_weights{std::vector<double>(m, 0), std::vector<double>(n, 0), {}, {}});
  std::vector<std::pair<double, std::size_t>> heaviest;
  for (std::size_t c = 0; c < m * n; ++c) {
    const double w = proofs_.game().column_weights()[c];
    starts[0].source[c / n] += w;
    starts[0].target[c % n] += w;
    if (w > 1e-6) heaviest.push_back({-w, c});
  }
  std::sort(heaviest.begin(), heaviest.end());
  starts.push_back(middle);
  for (std::size_t k = 0; k < std::min<std::size_t>(3, heaviest.size()); ++k) {
    Line_weights& start = starts.emplace_back(middle);
    for (double& w : start.source) w *= 0.2;
    for (double& w : start.target) w *= 0.2;
    start.source[heaviest[k].second / n] += 0.8;
    start.target[heaviest[k].second % n] += 0.8;
  }
  return starts;
}

bool Line_search::by_lemma(Refutation& ended) {
  if (path_.empty()) return false;
  const std::uint32_t newest = path_.back().line;
  if (lemmas_of_.size() <= newest) return false;
  for (const std::uint32_t id : lemmas_of_[newest]) {
    const Lemma& lemma = lemmas_[id];
    if (!std::all_of(lemma.literals.begin(), lemma.literals.end(),
                     [&](const Literal& l) { return sign_[l.line] == l.sign; }))
      continue;
    ++counters_->learned;
    Used used;
    for (std::size_t k = 0; k < std::min(path_.size(), used.size()); ++k)
      if (std::any_of(lemma.literals.begin(), lemma.literals.end(),
                      [&](const Literal& l) { return l.line == path_[k].line; }))
        used.set(k);
    ended = leaf({Weak_step::Kind::empty, 0, {}, lemma.terms}, used);
    return true;
  }
  return false;
}

void Line_search::forget_lemmas(std::size_t kept) {
  while (lemmas_.size() > kept) {
    for (const Literal& literal : lemmas_.back().literals) lemmas_of_[literal.line].pop_back();
    lemmas_.pop_back();
  }
}

Line_search::Refutation Line_search::conclude(const std::vector<Multiplier>& multipliers) {
  ++counters_->empty;
  Lemma lemma;
  Used used;
  for (const Multiplier& m : multipliers) {
    const Literal& literal = path_[m.place];
    lemma.terms.push_back({literal.line, m.factor, m.source, m.target});
    lemma.literals.push_back(literal);
    if (m.place < used.size()) used.set(m.place);
  }
  lemmas_of_.resize(lines_.size());
  for (const Literal& literal : lemma.literals)
    lemmas_of_[literal.line].push_back(static_cast<std::uint32_t>(lemmas_.size()));
  lemmas_.push_back(lemma);
  return leaf({Weak_step::Kind::empty, 0, {}, std::move(lemma.terms)}, used);
}

std::optional<std::uint32_t> Line_search::confirm(const Line_domain& domain, const Line_weights& line) {
  std::optional<std::uint32_t> blocker;
  const auto is_free = [&](const Near_point& p, const Near_point& q) {
    if (blocker = occluders_->blocker(p, q, *source_plane_, *target_plane_); blocker) return false;
    ++counters_->confirmed;
    sightline_ = {p, q};
    return true;
  };
  if (!line.exact_source.empty()) {
    if (!is_free(inner_point(domain.source, line.exact_source), inner_point(domain.target, line.exact_target)))
      ++counters_->refuted;
    return blocker;
  }
  const Uniform unit(0.9, 1.1);
  constexpr std::array bits{10, 20, 40, 52, 30};
  for (std::size_t k = 0; k < bits.size(); ++k) {
    Line_weights moved = line;
    if (k + 1 == bits.size())
      for (std::vector<double>* weights : {&moved.source, &moved.target})
        for (double& w : *weights) w *= unit(dice_);
    const auto rounded = [&](const std::vector<double>& weights) {
      std::vector<Integer> result;
      for (const double w : weights) result.push_back(Integer(std::max(1.0, std::round(std::ldexp(w, bits[k])))));
      return result;
    };
    if (is_free(inner_point(domain.source, rounded(moved.source)), inner_point(domain.target, rounded(moved.target))))
      return {};
  }
  ++counters_->refuted;
  return blocker;
}

Near_point Line_search::inner_point(const Near_polygon& polygon, const std::vector<Integer>& weights) const {
  Integer common = 1;
  for (const Near_point& corner : polygon) common = lcm(common, corner.exact[3]);
  std::array<Integer, 4> exact;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Integer weight = weights[i] * (common / polygon[i].exact[3]);
    for (std::size_t k = 0; k < 4; ++k) exact[k] += weight * polygon[i].exact[k];
  }
  return near_point(occluders_->frame(), exact);
}

std::vector<Weak_step> Line_search::in_order(std::uint32_t root) const {
  std::vector<Weak_step> steps;
  std::vector<std::uint32_t> stack{root};
  while (!stack.empty()) {
    const Node& node = nodes_[stack.back()];
    stack.pop_back();
    steps.push_back(node.step);
    if (node.step.kind <= Weak_step::Kind::cut_target) {
      stack.push_back(node.parts[1]);
      stack.push_back(node.parts[0]);
    }
  }
  return steps;
}

}  // namespace sightline
