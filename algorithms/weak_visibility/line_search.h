#pragma once
// Whether a convex polygon is weakly visible from another one: a search among the lines between them, by the sides on which they pass edges.

#include <sightline/algorithms/weak_visibility/matrix_game.h>
#include <sightline/algorithms/weak_visibility/occluders.h>

#include <bitset>
#include <functional>
#include <memory>
#include <random>

namespace sightline {

enum class Weak_status : char { hidden, visible, undecided };

/// What a search modelled.
struct Weak_counters {
  std::size_t targets = 0;       ///< pairs of a source and a piece
  std::size_t away = 0;          ///< of these, facing away from each other
  std::size_t by_rays = 0;       ///< of these, seen along one of the first few lines
  std::size_t occluders = 0;     ///< pieces near the shafts, summed over pairs
  std::size_t cells = 0, cuts = 0, shaves = 0, bisections = 0, blocked = 0, empty = 0, corners = 0, learned = 0, jumps = 0;
  std::size_t programs = 0, exact_programs = 0, form_programs = 0, by_forms = 0, confirmed = 0, refuted = 0;  ///< `confirmed`, `refuted`: lines proposed in doubles, by the exact test
  std::size_t lines = 0, open = 0, deepest = 0;

  Weak_counters& operator+=(const Weak_counters& o) {
    targets += o.targets, away += o.away, by_rays += o.by_rays, occluders += o.occluders, cells += o.cells, cuts += o.cuts, shaves += o.shaves, bisections += o.bisections;
    blocked += o.blocked, empty += o.empty, corners += o.corners, learned += o.learned, jumps += o.jumps, programs += o.programs, exact_programs += o.exact_programs, form_programs += o.form_programs, by_forms += o.by_forms;
    confirmed += o.confirmed, refuted += o.refuted, lines += o.lines, open += o.open, deepest = std::max(deepest, o.deepest);
    return *this;
  }
};

/// One step of a proof that no line is free, in the order of a walk that takes a node before its two parts. P-72 says what they mean.
struct Weak_step {
  enum class Kind : char { line, cut_source, cut_target, blocked, empty, away, open };
  using Form = std::array<Integer, 4>;  ///< in grid coordinates
  struct Term {
    std::uint32_t line;
    Rational factor;
    std::optional<Form> source, target;  ///< forms that are not negative there, to be multiplied too
  };
  Kind kind;
  std::uint32_t index = 0;          ///< of a line of the proof, or of a piece
  std::array<Integer, 4> plane{};   ///< of a cut, in grid coordinates
  std::vector<Term> terms;
};

/// A line that proofs speak of, by an edge that lies on it.
struct Weak_line {
  std::uint32_t piece, corner;
};

struct Weak_answer {
  Weak_status status = Weak_status::undecided;
  std::array<Near_point, 2> sightline;  ///< where visible: strictly inside source and target
  std::vector<Weak_step> proof;         ///< where hidden; where undecided with steps that are `open`
  std::vector<Weak_line> lines;
};

struct Weak_search_options {
  bool two_sided = false;
  std::size_t cells = 200000;           ///< that a search may take; then `undecided`
  int bisections = 12;                  ///< how often, one in another, a cell is halved that has neither a line nor a proof
  int rays = 24;                        ///< lines that are tried before the search
  std::uint64_t seed = 1;
  std::function<bool()> out_of_time;    ///< asked now and then
};

/// One search: source and target are convex, in grid coordinates. Which lines are blocked by a piece is a conjunction of the signs of its edge lines; "hidden"
/// says that such conjunctions cover all lines between the polygons but for a set of measure zero. The search takes a line of the cell that it is in, and a
/// piece that blocks it; cuts the polygons where they cross that piece's plane; and goes on, edge by edge, to the lines that pass the piece outside of it. A cell
/// ends where a piece blocks all of it, or where multipliers show that it has no line. Doubles propose, each step is checked in integers before it is believed.
/// Lines are known by name, so that edges shared by faces, T-junctions and abutting faces make one variable. Cost: exponential at worst, bounded by the
/// options. Exact: yes, or undecided. Ref: design.md, sections 4 and 5. Proof: P-70, P-71, P-72
class Line_search {
 public:
  Line_search(const Occluders& occluders, Near_polygon source, const Near_plane& source_plane, Near_polygon target, std::uint32_t target_piece, const Weak_search_options& options)
      : occluders_(&occluders), source_plane_(&source_plane), target_(target_piece), options_(&options), dice_(options.seed * 0x9e3779b97f4a7c15u + target_piece) {
    domains_.push_back(std::make_unique<Domain>(std::move(source), std::move(target)));
  }

  Weak_answer run(Weak_counters& counters) {
    counters_ = &counters;
    ++counters.targets;
    const Refutation found = begin(0);
    Weak_answer answer;
    answer.status = found.status;
    for (const Line& line : lines_) answer.lines.push_back(line.edge);
    counters.lines += lines_.size();
    if (found.status == Weak_status::visible) answer.sightline = sightline_;
    else answer.proof = in_order(found.node);
    return answer;
  }

 private:
  // ---- What is kept ----------------------------------------------------------------------------------------------------------

  struct Line {
    Weak_line edge;
    std::array<std::uint32_t, 2> points;
    Six near;
    double ends_sum, ends_product;  // of the largest coordinates of its two points
    Exact_six exact;
  };
  /// An edge's line: `sense` -1 where it runs the other way.
  struct Edge_line {
    std::uint32_t line;
    int sense;
  };
  /// The sides of a line on all pairs of vertices, scaled by a power of two to at most 1.
  struct Row {
    std::vector<double> values;
    double error;
    int exponent;  // of that scale
    int decided;   // 1: nowhere negative, -1: nowhere positive, 0: neither
  };
  struct Candidate {
    std::uint32_t piece;
    int sense;  // 1: source in front and target behind, -1: the other way round, 0: one of them is on both sides
  };
  struct Domain {
    Domain(Near_polygon s, Near_polygon t) : source(std::move(s)), target(std::move(t)) {
      for (const Near_point& p : source) source_size = std::max(source_size, size(p.near));
      for (const Near_point& q : target) target_size = std::max(target_size, size(q.near));
      for (const Near_point& p : source)
        for (const Near_point& q : target) pairs.push_back(pair_numbers(p.near, q.near));
    }
    Near_polygon source, target;
    double source_size = 0, target_size = 0;
    std::vector<Six> pairs;
    std::vector<Exact_six> exact_pairs;  // once they are asked for
    std::vector<std::unique_ptr<Row>> rows;
    std::vector<Candidate> candidates;
    std::uint32_t parent = 0;
    int bisections = 0, narrowed = 0;
  };
  struct Literal {
    std::uint32_t line;
    int sign;
  };
  using Used = std::bitset<256>;  // places of the path; beyond that nothing is left out
  struct Refutation {
    Weak_status status;
    std::uint32_t node = 0;
    Used used;
  };
  struct Node {
    Weak_step step;
    std::array<std::uint32_t, 2> parts{};  // for lines: where the side is positive, where it is negative; for cuts: in front, behind
  };
  struct Lemma {
    std::vector<Weak_step::Term> terms;
    std::vector<Literal> literals;
    std::uint32_t domain;
  };
  struct Weights {
    std::vector<double> source, target;
    std::vector<Rational> exact_source, exact_target;  // where doubles are too coarse to be in the cell
  };

  // ---- From the whole to the first cell ---------------------------------------------------------------------------------------

  /// Leaves only what source and target have in front of each other, tries some lines, then searches.
  Refutation begin(std::uint32_t d) {
    const Near_plane& target_plane = occluders_->plane(target_);
    if (across(*source_plane_, domains_[d]->target)) return cut(d, false, *source_plane_, [this](std::uint32_t part) { return begin(part); });
    if (across(target_plane, domains_[d]->source)) return cut(d, true, target_plane, [this](std::uint32_t part) { return begin(part); });
    const int q = position(*source_plane_, domains_[d]->target), p = position(target_plane, domains_[d]->source);
    if (q <= 0 || p == 0 || (p < 0 && !options_->two_sided)) {
      ++counters_->away;
      return leaf({Weak_step::Kind::away, 0, {}, {}}, {});
    }
    Domain& domain = *domains_[d];
    for (const std::uint32_t piece : occluders_->near_shaft(domain.source, domain.target)) domain.candidates.push_back({piece, 0});
    settle_candidates(domain);
    counters_->occluders += domain.candidates.size();
    if (try_rays(domain)) return {Weak_status::visible, 0, {}};
    return refute(d, 0);
  }

  static int position(const Near_plane& h, const Near_polygon& polygon) {  // Pre: not across
    int result = 0;
    for (const Near_point& p : polygon)
      if (const int s = side(h, p); s != 0) result = s;
    return result;
  }
  static bool across(const Near_plane& h, const Near_polygon& polygon) {
    bool front = false, behind = false;
    for (const Near_point& p : polygon) {
      const int s = side(h, p);
      front |= s > 0, behind |= s < 0;
    }
    return front && behind;
  }

  /// Forgets candidates that cannot come between, and notes from which side the others do.
  void settle_candidates(Domain& domain) const {
    std::size_t kept = 0;
    for (const Candidate& candidate : domain.candidates) {
      int sense = candidate.sense;
      if (sense == 0) {
        const Near_plane& h = occluders_->plane(candidate.piece);
        const bool s_across = across(h, domain.source), t_across = across(h, domain.target);
        const int s = s_across ? 2 : position(h, domain.source), t = t_across ? 2 : position(h, domain.target);
        if (s == 0 || t == 0 || (s == t && s != 2)) continue;
        if (s != 2 && t != 2) sense = s;
      }
      domain.candidates[kept++] = {candidate.piece, sense};
    }
    domain.candidates.resize(kept);
  }

  bool try_rays(Domain& domain) {
    std::uniform_real_distribution<double> unit(0.05, 1);
    std::vector<Candidate> blockers;
    for (int k = 0; k < options_->rays; ++k) {
      Weights line{std::vector<double>(domain.source.size(), 1), std::vector<double>(domain.target.size(), 1), {}, {}};
      if (k > 0) {
        for (double& w : line.source) w = std::pow(unit(dice_), 3);
        for (double& w : line.target) w = std::pow(unit(dice_), 3);
      }
      normalise(line);
      find_blockers(domain, line, blockers, true);
      if (!blockers.empty()) continue;
      if (!confirm(domain, line)) return ++counters_->by_rays, true;
    }
    return false;
  }

  // ---- A cell ---------------------------------------------------------------------------------------------------------------

  static constexpr std::size_t deepest = 1000;
  // Of the steps in which a cell's polygons were made smaller: after how many what else is tried, and after how many nothing.
  static constexpr int forms_after = 2, special_after = 3, smallest = 80;

  Refutation refute(std::uint32_t d, std::size_t depth) {
    counters_->deepest = std::max(counters_->deepest, depth);
    if (++cells_ > options_->cells || depth > deepest || (cells_ % 64 == 0 && options_->out_of_time && options_->out_of_time())) return open();
    ++counters_->cells;
    Weights line;
    Refutation ended;
    switch (look_for_line(d, line, ended)) {
      case Look::ended: return ended;
      case Look::unclear: return narrow(d, depth);
      case Look::found: break;
    }
    std::vector<Candidate> blockers;
    find_blockers(*domains_[d], line, blockers, false);
    std::vector<Edge_sign> unknown;
    const Candidate* chosen = choose(*domains_[d], blockers, unknown);
    if (chosen == nullptr) {
      const std::optional<std::uint32_t> closest = confirm(*domains_[d], line);
      if (!closest) return {Weak_status::visible, 0, {}};
      // What the exact test found and doubles did not.
      blockers.clear();
      for (const Candidate& candidate : domains_[d]->candidates)
        if (candidate.piece == *closest) blockers.push_back(candidate);
      chosen = choose(*domains_[d], blockers, unknown);
      if (chosen == nullptr || (chosen->sense != 0 && unknown.empty())) return narrow(d, depth);
    }
    const Candidate blocker = *chosen;
    if (blocker.sense == 0) {
      const Near_plane& h = occluders_->plane(blocker.piece);
      ++counters_->cuts;
      return cut(d, across(h, domains_[d]->source), h, [this, depth](std::uint32_t part) { return refute(part, depth + 1); });
    }
    return branch(d, blocker, unknown, depth);
  }

  Refutation open() {
    ++counters_->open;
    Refutation r = leaf({Weak_step::Kind::open, 0, {}, {}}, {});
    r.status = Weak_status::undecided;
    return r;
  }
  Refutation leaf(Weak_step step, Used used) {
    nodes_.push_back({std::move(step), {}});
    return {Weak_status::hidden, static_cast<std::uint32_t>(nodes_.size() - 1), used};
  }

  template <class Part>
  Refutation cut(std::uint32_t d, bool source, const Near_plane& h, Part part) {
    Refutation both{Weak_status::hidden, 0, {}};
    std::array<std::uint32_t, 2> parts{};
    for (const bool front : {true, false}) {
      const Domain& whole = *domains_[d];
      auto piece = source ? std::make_unique<Domain>(clip(occluders_->frame(), whole.source, h, front), whole.target) : std::make_unique<Domain>(whole.source, clip(occluders_->frame(), whole.target, h, front));
      piece->parent = d, piece->bisections = whole.bisections, piece->narrowed = whole.narrowed;
      piece->candidates = whole.candidates;
      settle_candidates(*piece);
      domains_.push_back(std::move(piece));
      const Refutation r = part(static_cast<std::uint32_t>(domains_.size() - 1));
      if (r.status == Weak_status::visible) return r;
      if (r.status == Weak_status::undecided) both.status = Weak_status::undecided;
      both.used |= r.used;
      parts[front ? 0 : 1] = r.node;
    }
    nodes_.push_back({{source ? Weak_step::Kind::cut_source : Weak_step::Kind::cut_target, 0, h.exact, {}}, parts});
    both.node = static_cast<std::uint32_t>(nodes_.size() - 1);
    return both;
  }

  /// A cell with neither a line nor a proof: its polygons are too large for what is left of it. First cuts off what the relaxation shows to hold none of its
  /// lines, edge by edge; if that is little, halves the longer one of the two polygons.
  Refutation narrow(std::uint32_t d, std::size_t depth) {
    if (domains_[d]->narrowed > smallest) return open();
    if (domains_[d]->narrowed >= special_after) {
      Near_plane plane;
      for (const bool source : {true, false})
        if (common_plane(source ? domains_[d]->source : domains_[d]->target, plane)) {
          ++counters_->cuts;
          return cut(d, source, plane, [this, depth](std::uint32_t part) { return refute(part, depth + 1); });
        }
    }
    std::vector<Shave> shaves;
    if (find_shaves(*domains_[d], shaves)) return shave(d, shaves, 0, depth);
    return bisect(d, depth);
  }

  /// A plane that holds two of the path's lines and cuts the polygon: the sides of lines in one plane depend on where one crosses it, so that lines near the plane
  /// never resolve while their ends are on both sides of it.
  bool common_plane(const Near_polygon& polygon, Near_plane& plane) const {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      for (std::size_t k = i + 1; k < rows_.size(); ++k) {
        const Line &a = lines_[path_[rows_[i].place].line], &b = lines_[path_[rows_[k].place].line];
        double near = 0;
        for (std::size_t x = 0; x < 6; ++x) near += a.near[x] * b.near[(x + 3) % 6];
        if (std::fabs(near) > 1e-12) continue;
        Integer product = 0;
        for (std::size_t x = 0; x < 6; ++x) product += a.exact[x] * b.exact[(x + 3) % 6];
        if (sgn(product) != 0) continue;
        const auto direction = [](const Exact_six& l) { return std::array<Integer, 3>{l[0], l[1], l[2]}; };
        const auto cross = [](const std::array<Integer, 3>& u, const std::array<Integer, 3>& v) { return std::array<Integer, 3>{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]}; };
        const std::array<Integer, 3> p = occluders_->grid_point(a.points[0]), q = occluders_->grid_point(b.points[0]);
        std::array<Integer, 3> normal = cross(direction(a.exact), direction(b.exact));
        const auto is_zero = [&] { return sgn(normal[0]) == 0 && sgn(normal[1]) == 0 && sgn(normal[2]) == 0; };
        if (is_zero()) normal = cross(direction(a.exact), {q[0] - p[0], q[1] - p[1], q[2] - p[2]});  // parallel, and not the same line
        if (is_zero()) continue;
        plane = near_plane(occluders_->frame(), {normal[0], normal[1], normal[2], Integer(-(normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2]))});
        if (across(plane, polygon)) return true;
      }
    return false;
  }

  /// A plane across the source, or the target, with none of the cell's lines behind it, by doubles.
  struct Shave {
    bool source;
    Near_plane plane;
  };
  Refutation shave(std::uint32_t d, const std::vector<Shave>& shaves, std::size_t k, std::size_t depth) {
    while (k < shaves.size() && !across(shaves[k].plane, shaves[k].source ? domains_[d]->source : domains_[d]->target)) ++k;
    if (k == shaves.size()) {
      ++domains_[d]->narrowed;
      return refute(d, depth + 1);
    }
    ++counters_->shaves;
    bool front = true;
    return cut(d, shaves[k].source, shaves[k].plane, [&](std::uint32_t part) {
      return std::exchange(front, false) ? shave(part, shaves, k + 1, depth) : refute(part, depth + 1);
    });
  }
  bool find_shaves(const Domain& domain, std::vector<Shave>& shaves) {
    double kept = 1;
    const std::size_t n = domain.target.size();
    for (const bool source : {true, false}) {
      const Near_polygon& polygon = source ? domain.source : domain.target;
      for (std::size_t e = 0; e < polygon.size(); ++e) {
        const Triple inward = inward_of(polygon, e);
        std::vector<double> heights;
        for (const Near_point& p : polygon) heights.push_back(inward[0] * p.near[0] + inward[1] * p.near[1] + inward[2] * p.near[2]);
        const double low = *std::min_element(heights.begin(), heights.end()), high = *std::max_element(heights.begin(), heights.end());
        if (!(high - low > 1e-12)) continue;
        double empty = 0;  // the share of the height that is known to hold no line
        for (const double share : {0.5, 0.25, 0.75, 0.125, 0.875}) {
          if (share < empty || (empty == 0 && share > 0.5) || (empty == 0.5 && share < 0.5) || (empty == 0.25 && share == 0.125)) continue;
          const double height = low + share * (high - low), scale = 1 / (high - low);
          const std::span<double> values = game_.add_row();
          for (std::size_t c = 0; c < values.size(); ++c) values[c] = (height - heights[source ? c / n : c % n]) * scale;
          ++counters_->programs;
          const double value = game_.solve();
          game_.remove_row();
          if (value < -1e-8) empty = share;
          else if (share > 0.5) break;
        }
        if (empty == 0) continue;
        kept *= 1 - empty;
        // In grid coordinates: the normal has few bits already, the height gets few.
        const double height = low + empty * (high - low);
        const Rational offset = exact(std::ldexp(std::floor(std::ldexp(height, 30)), -30)) * occluders_->frame().unit();
        std::array<Integer, 4> h;
        for (std::size_t k = 0; k < 3; ++k) h[k] = Integer(inward[k]) * offset.get_den();
        h[3] = -offset.get_num();
        shaves.push_back({source, near_plane(occluders_->frame(), h)});
      }
    }
    return kept < 0.8;
  }
  /// A normal of few bits that points from an edge into its convex polygon, about within its plane.
  static Triple inward_of(const Near_polygon& polygon, std::size_t e) {
    const Triple &a = polygon[e].near, &b = polygon[(e + 1) % polygon.size()].near;
    const Triple along{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double square = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
    Triple inward{};
    double most = 0;
    for (const Near_point& p : polygon) {
      const Triple to{p.near[0] - a[0], p.near[1] - a[1], p.near[2] - a[2]};
      const double share = square > 0 ? (to[0] * along[0] + to[1] * along[1] + to[2] * along[2]) / square : 0;
      const Triple across{to[0] - share * along[0], to[1] - share * along[1], to[2] - share * along[2]};
      const double length = across[0] * across[0] + across[1] * across[1] + across[2] * across[2];
      if (length > most) most = length, inward = across;
    }
    const double largest = size(inward);
    if (largest > 0)
      for (double& x : inward) x = std::round(x / largest * 256);
    return inward;
  }

  /// Halves the longer one of the two polygons, across its longest diagonal.
  Refutation bisect(std::uint32_t d, std::size_t depth) {
    const Domain& whole = *domains_[d];
    if (whole.bisections >= options_->bisections) return open();
    ++counters_->bisections;
    const auto longest = [](const Near_polygon& polygon, std::array<std::size_t, 2>& ends) {
      double most = -1;
      for (std::size_t i = 0; i < polygon.size(); ++i)
        for (std::size_t j = i + 1; j < polygon.size(); ++j) {
          double square = 0;
          for (std::size_t k = 0; k < 3; ++k) square += (polygon[i].near[k] - polygon[j].near[k]) * (polygon[i].near[k] - polygon[j].near[k]);
          if (square > most) most = square, ends = {i, j};
        }
      return most;
    };
    std::array<std::size_t, 2> s{}, t{};
    const bool source = longest(whole.source, s) >= longest(whole.target, t);
    const Near_point &a = source ? whole.source[s[0]] : whole.target[t[0]], &b = source ? whole.source[s[1]] : whole.target[t[1]];
    // A normal of few bits, through the middle.
    Triple direction{b.near[0] - a.near[0], b.near[1] - a.near[1], b.near[2] - a.near[2]};
    const double scale = size(direction);
    if (!(scale > 0)) return open();  // too small for doubles to tell its corners apart
    std::array<Integer, 4> h;
    for (std::size_t k = 0; k < 3; ++k) h[k] = static_cast<long>(std::lround(direction[k] / scale * 16));
    for (std::size_t k = 0; k < 3; ++k) h[3] -= h[k] * (a.exact[k] * b.exact[3] + b.exact[k] * a.exact[3]);
    const Integer weight = 2 * a.exact[3] * b.exact[3];
    for (std::size_t k = 0; k < 3; ++k) h[k] *= weight;
    const Near_plane plane = near_plane(occluders_->frame(), h);
    if (!across(plane, source ? whole.source : whole.target)) return open();
    return cut(d, source, plane, [this, depth](std::uint32_t part) {
      ++domains_[part]->bisections, ++domains_[part]->narrowed;
      return refute(part, depth + 1);
    });
  }

  /// An edge of a blocking piece, and the sign that its line has inside.
  struct Edge_sign {
    std::uint32_t line;
    int inside;
  };

  /// The lines that pass the piece outside an edge, edge by edge; what is left is blocked.
  Refutation branch(std::uint32_t d, const Candidate& blocker, const std::vector<Edge_sign>& unknown, std::size_t depth) {
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
    Refutation rest;
    if (path_.size() == base + unknown.size() && outside.size() == unknown.size()) {
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
    // Put together from the end; an edge that the rest does without is left out.
    for (std::size_t k = outside.size(); k-- > 0;) {
      const std::size_t place = base + k;
      if (rest.status == Weak_status::hidden && place < Used().size() && !rest.used[place]) {
        ++counters_->jumps;
        continue;
      }
      const std::array<std::uint32_t, 2> parts = unknown[k].inside > 0 ? std::array{rest.node, outside[k].node} : std::array{outside[k].node, rest.node};
      nodes_.push_back({{Weak_step::Kind::line, unknown[k].line, {}, {}}, parts});
      rest.node = static_cast<std::uint32_t>(nodes_.size() - 1);
      rest.used |= outside[k].used;
      if (place < Used().size()) rest.used.reset(place);
      if (outside[k].status == Weak_status::undecided) rest.status = Weak_status::undecided;
    }
    return rest;
  }

  void push(const Literal& literal) {
    path_.push_back(literal);
    sign_[literal.line] = literal.sign;
  }
  void pop() {
    sign_[path_.back().line] = 0;
    path_.pop_back();
  }

  // ---- Blockers -------------------------------------------------------------------------------------------------------------

  static Triple mean(const Near_polygon& polygon, const std::vector<double>& weights) {
    Triple p{};
    for (std::size_t i = 0; i < polygon.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) p[k] += weights[i] * polygon[i].near[k];
    return p;
  }
  static void normalise(Weights& line) {
    for (std::vector<double>* weights : {&line.source, &line.target}) {
      double sum = 0;
      for (const double w : *weights) sum += w;
      for (double& w : *weights) w /= sum;
    }
  }

  /// The pieces that a line meets, by doubles; only one where that is enough. Close to an edge, its own row of the domain tells more. Senses are those that the
  /// domain has.
  void find_blockers(Domain& domain, const Weights& line, std::vector<Candidate>& blockers, bool one) {
    blockers.clear();
    const Triple p = mean(domain.source, line.source), q = mean(domain.target, line.target);
    const Six numbers = pair_numbers(p, q);
    for (const Candidate& candidate : domain.candidates) {
      int sense = candidate.sense;
      if (sense == 0) {
        const std::array<double, 4>& h = occluders_->plane(candidate.piece).near;
        const double from = h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3], to = h[0] * q[0] + h[1] * q[1] + h[2] * q[2] + h[3];
        if ((from > 0) == (to > 0)) continue;
        sense = from > 0 ? 1 : -1;
      }
      const std::span<const Six> edges = occluders_->edges(candidate.piece);
      bool inside = true;
      for (std::size_t e = 0; e < edges.size() && inside; ++e) {
        double height = dot(numbers, edges[e]);
        if (std::fabs(height) < close) {
          const Edge_line edge = edge_lines(candidate.piece)[e];
          height = edge.sense * height_of(domain, edge.line, line);
        }
        inside = sense * height > 0;
      }
      if (!inside) continue;
      blockers.push_back(candidate);
      if (one) return;
    }
  }
  static constexpr double close = 1e-9;
  double height_of(Domain& domain, std::uint32_t line, const Weights& weights) {
    if (sign_[line] != 0) return sign_[line];
    const Row& r = row(domain, line);
    if (r.decided != 0) return r.decided;
    double sum = 0;
    for (std::size_t i = 0; i < domain.source.size(); ++i)
      for (std::size_t j = 0; j < domain.target.size(); ++j) sum += weights.source[i] * weights.target[j] * r.values[i * domain.target.size() + j];
    return sum;
  }

  /// The blocker with the fewest edges that are not known to have the line inside. One that is cut first comes last.
  const Candidate* choose(Domain& domain, const std::vector<Candidate>& blockers, std::vector<Edge_sign>& unknown) {
    const Candidate* best = nullptr;
    std::vector<Edge_sign> open_edges;
    for (const Candidate& blocker : blockers) {
      if (blocker.sense == 0) {
        if (best == nullptr) best = &blocker;
        continue;
      }
      open_edges.clear();
      bool outside = false;
      for (const Edge_sign& edge : signs_of(blocker)) {
        const int known = sign_[edge.line] != 0 ? sign_[edge.line] : row(domain, edge.line).decided;
        if (known == 0) open_edges.push_back(edge);
        else if (known != edge.inside) outside = true;
      }
      if (outside) continue;  // the line is not strictly in the cell
      if (best != nullptr && best->sense != 0 && open_edges.size() >= unknown.size()) continue;
      best = &blocker, unknown = open_edges;
      if (unknown.empty()) break;
    }
    return best;
  }

  std::vector<Edge_sign> signs_of(const Candidate& blocker) {
    std::vector<Edge_sign> signs;
    for (const Edge_line& edge : edge_lines(blocker.piece)) signs.push_back({edge.line, edge.sense * blocker.sense});
    return signs;
  }
  const std::vector<Edge_line>& edge_lines(std::uint32_t piece) {
    std::vector<Edge_line>& edges = edge_lines_[piece];
    if (edges.empty())
      for (std::size_t i = 0; i < occluders_->size(piece); ++i) edges.push_back(edge_line(piece, i));
    return edges;
  }
  /// The line of an edge by name: one that is known, also where its end points differ, or a new one.
  Edge_line edge_line(std::uint32_t piece, std::size_t corner) {
    const std::array<std::uint32_t, 2> points = occluders_->edge_points(piece, corner);
    const bool turned = points[1] < points[0];
    const std::uint64_t key = static_cast<std::uint64_t>(points[turned]) << 32 | points[!turned];
    if (const auto found = by_points_.find(key); found != by_points_.end()) return {found->second.line, turned ? -found->second.sense : found->second.sense};
    Line line{{piece, static_cast<std::uint32_t>(corner)}, points, occluders_->edges(piece)[corner], 0, 0, occluders_->exact_edge_of(points)};
    const double a = size(occluders_->corners(piece)[corner]), b = size(occluders_->corners(piece)[(corner + 1) % occluders_->size(piece)]);
    line.ends_sum = a + b, line.ends_product = a * b;
    std::uint32_t id = 0;
    int sense = 0;
    for (; id < lines_.size() && sense == 0; ++id) sense = same_line(lines_[id], line);
    if (sense == 0) {
      sense = 1, ++id;
      lines_.push_back(std::move(line));
      sign_.push_back(0);
    }
    by_points_[key] = {id - 1, turned ? -sense : sense};
    return {id - 1, sense};
  }
  static int same_line(const Line& a, const Line& b) {
    // Parallel six numbers: a quick look in doubles at the largest one, then integers.
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (std::fabs(a.near[i]) > std::fabs(a.near[k])) k = i;
    for (std::size_t i = 0; i < 6; ++i)
      if (std::fabs(a.near[k] * b.near[i] - a.near[i] * b.near[k]) > 1e-9 * std::fabs(a.near[k]) * (std::fabs(b.near[0]) + std::fabs(b.near[1]) + std::fabs(b.near[2])) + 1e-9 * std::fabs(b.near[k] * a.near[k])) return 0;
    if (sgn(a.exact[k]) == 0 || sgn(b.exact[k]) == 0) return 0;
    for (std::size_t i = 0; i < 6; ++i)
      if (a.exact[k] * b.exact[i] != a.exact[i] * b.exact[k]) return 0;
    return sgn(a.exact[k]) * sgn(b.exact[k]);
  }

  // ---- The sides of lines on pairs of vertices -------------------------------------------------------------------------------

  const Exact_six& exact_pair_of(Domain& domain, std::size_t c) const {
    if (domain.exact_pairs.empty())
      for (const Near_point& p : domain.source)
        for (const Near_point& q : domain.target) domain.exact_pairs.push_back(exact_pair(p.exact, q.exact));
    return domain.exact_pairs[c];
  }
  int exact_sign(Domain& domain, std::uint32_t line, std::size_t c) const { return sgn(dot(exact_pair_of(domain, c), lines_[line].exact)); }

  const Row& row(Domain& domain, std::uint32_t id) const {
    if (domain.rows.size() <= id) domain.rows.resize(lines_.size());
    std::unique_ptr<Row>& place = domain.rows[id];
    if (place) return *place;
    place = std::make_unique<Row>();
    Row& r = *place;
    const Line& line = lines_[id];
    double most = 0;
    for (const Six& pair : domain.pairs) {
      r.values.push_back(dot(pair, line.near));
      most = std::max(most, std::fabs(r.values.back()));
    }
    r.error = 0x1p-46 * ((domain.source_size + domain.target_size) * line.ends_product + domain.source_size * domain.target_size * line.ends_sum) + 0x1p-1000;
    if (most < 0x1p30 * r.error) {  // small polygons, or a line close to all of them: integers, rounded once
      most = 0;
      for (std::size_t c = 0; c < r.values.size(); ++c) {
        const Integer weight = domain.source[c / domain.target.size()].exact[3] * domain.target[c % domain.target.size()].exact[3];
        r.values[c] = nearest_double(occluders_->frame().near_cubic(dot(exact_pair_of(domain, c), line.exact), weight));
        most = std::max(most, std::fabs(r.values[c]));
      }
      r.error = 0x1p-52 * most + 0x1p-1060;
    }
    r.exponent = most > 0x1p-900 ? -std::ilogb(most) - 1 : 0;
    for (double& v : r.values) v = std::ldexp(v, r.exponent);
    r.error = std::ldexp(r.error, r.exponent);
    // One side on all pairs? Integers are asked only if doubles do not show both signs.
    bool positive = false, negative = false;
    for (const double v : r.values) positive |= v > r.error, negative |= v < -r.error;
    for (std::size_t c = 0; c < r.values.size() && !(positive && negative); ++c) {
      if (std::fabs(r.values[c]) > r.error) continue;
      const int sign = exact_sign(domain, id, c);
      positive |= sign > 0, negative |= sign < 0;
      if (sign == 0) r.values[c] = 0;
    }
    r.decided = positive == negative ? 0 : positive ? 1 : -1;
    return r;
  }

  // ---- A line of the cell, or none -------------------------------------------------------------------------------------------

  enum class Look { found, ended, unclear };

  Look look_for_line(std::uint32_t d, Weights& line, Refutation& ended) {
    Domain& domain = *domains_[d];
    const std::size_t m = domain.source.size(), n = domain.target.size();
    if (by_lemma(d, ended)) return Look::ended;
    rows_.clear();
    for (std::size_t k = 0; k < path_.size(); ++k) {
      const Row& r = row(domain, path_[k].line);
      if (r.decided == path_[k].sign) continue;
      if (r.decided == -path_[k].sign) {
        ended = conclude(d, {{k, Rational(1), {}, {}}});
        return Look::ended;
      }
      rows_.push_back({k, &r});
    }
    line = {std::vector<double>(m, 1.0 / static_cast<double>(m)), std::vector<double>(n, 1.0 / static_cast<double>(n)), {}, {}};
    if (rows_.empty()) return Look::found;

    // The relaxation: weights for all pairs of vertices at once.
    game_.restart(m * n);
    for (const Path_row& r : rows_) {
      const std::span<double> values = game_.add_row();
      for (std::size_t c = 0; c < m * n; ++c) values[c] = path_[r.place].sign * r.row->values[c];
    }
    ++counters_->programs;
    const double value = game_.solve();
    Relaxation relaxation = Relaxation::unclear;
    if (value < thin && (relaxation = conclude_from_game(d, ended)) == Relaxation::empty) return Look::ended;

    // From its weights, or a pair of vertices that has some, to a line: the best end for a fixed other end, in turn.
    std::vector<Weights> starts(1, Weights{std::vector<double>(m, 0), std::vector<double>(n, 0), {}, {}});
    std::vector<std::pair<double, std::size_t>> heaviest;
    for (std::size_t c = 0; c < m * n; ++c) {
      const double w = game_.column_weights()[c];
      starts[0].source[c / n] += w, starts[0].target[c % n] += w;
      if (w > 1e-6) heaviest.push_back({-w, c});
    }
    std::sort(heaviest.begin(), heaviest.end());
    starts.push_back(line);
    for (std::size_t k = 0; k < std::min<std::size_t>(3, heaviest.size()); ++k) {
      Weights& start = starts.emplace_back(line);
      for (double& w : start.source) w *= 0.2;
      for (double& w : start.target) w *= 0.2;
      start.source[heaviest[k].second / n] += 0.8, start.target[heaviest[k].second % n] += 0.8;
    }
    for (const Weights& start : starts) {
      line = start;
      if (alternate(domain, line)) return Look::found;
    }
    if (conclude_at_corner(d, ended)) return Look::ended;
    const bool worth_it = is_worth_it(domain.narrowed);
    if (value < thin && (worth_it || domain.narrowed < forms_after)) {
      if (relaxation == Relaxation::unclear && solve_relaxation_exactly(d, ended)) return Look::ended;
      for (std::size_t c = 0; c < std::min<std::size_t>(2, starts.size()); ++c) {
        line = starts[c];
        if (alternate_exactly(domain, line)) return Look::found;
      }
    }
    if (worth_it && (conclude_by_forms(d, true, ended) || conclude_by_forms(d, false, ended))) return Look::ended;
    return Look::unclear;
  }

  /// Dear proofs are tried again only once the polygons have become much smaller: after 2, 3, 5, 8, ... steps.
  static bool is_worth_it(int narrowed) {
    int last = 1, next = forms_after;
    while (next < narrowed) last = std::exchange(next, next + last);
    return next == narrowed;
  }
  static constexpr double thin = 1e-8;  // what doubles leave to exact programs

  /// The relaxation in rationals: a proof that there is no line, where its value is not positive.
  bool solve_relaxation_exactly(std::uint32_t d, Refutation& ended) {
    Domain& domain = *domains_[d];
    if (rows_.size() * domain.pairs.size() > 1500) return false;
    ++counters_->exact_programs;
    exact_game_.restart(domain.pairs.size());
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const std::span<Rational> values = exact_game_.add_row();
      for (std::size_t c = 0; c < values.size(); ++c) values[c] = exact_value(domain, k, c);
    }
    if (sgn(exact_game_.solve()) > 0) return false;
    std::vector<Weighted> proposal;
    for (std::size_t k = 0; k < rows_.size(); ++k)
      if (sgn(exact_game_.row_weights()[k]) > 0) proposal.push_back({k, 0, exact_game_.row_weights()[k]});
    if (proposal.empty() || !is_proof(domain, proposal)) return false;
    std::vector<Multiplier> multipliers;
    for (const Weighted& w : proposal) multipliers.push_back({rows_[w.row].place, factor_of(w.row, w.exact), {}, {}});
    ended = conclude(d, multipliers);
    return true;
  }
  /// alternate(), in rationals.
  bool alternate_exactly(Domain& domain, Weights& line) {
    const std::size_t m = domain.source.size(), n = domain.target.size();
    line.exact_source.clear(), line.exact_target.clear();
    for (const double w : line.source) line.exact_source.push_back(exact(w));
    for (const double w : line.target) line.exact_target.push_back(exact(w));
    for (int round = 0; round < 4; ++round) {
      const bool source = round % 2 == 0;
      const std::size_t own = source ? m : n;
      // The values of the other end's weights, exactly; rounded, a game in doubles; its basis, exactly.
      ++counters_->exact_programs;
      std::vector<std::vector<Rational>> rows(rows_.size(), std::vector<Rational>(own));
      small_.restart(own);
      for (std::size_t k = 0; k < rows_.size(); ++k) {
        Rational most;
        for (std::size_t i = 0; i < m; ++i)
          for (std::size_t j = 0; j < n; ++j) rows[k][source ? i : j] += (source ? line.exact_target[j] : line.exact_source[i]) * exact_value(domain, k, i * n + j);
        for (const Rational& v : rows[k]) most = std::max(most, Rational(abs(v)));
        const std::span<double> values = small_.add_row();
        for (std::size_t c = 0; c < own; ++c) {
          if (sgn(most) != 0) rows[k][c] /= most;
          values[c] = nearest_double(rows[k][c]);
        }
      }
      small_.solve();
      std::vector<Rational> solved, weights(own);
      Rational value;
      const std::vector<std::size_t>& columns = small_.tight_columns();
      if (!solve_exactly(columns, small_.tight_rows(), [&](std::size_t c, std::size_t k) { return rows[k][c]; }, solved, value)) return false;
      for (std::size_t c = 0; c < columns.size(); ++c) {
        if (sgn(solved[c]) < 0) return false;
        weights[columns[c]] = solved[c];
      }
      Rational least = 1;  // of the means of rows
      for (const std::vector<Rational>& row : rows) {
        Rational sum, mean;
        for (std::size_t c = 0; c < own; ++c) sum += weights[c] * row[c], mean += row[c] / static_cast<long>(own);
        value = std::min(value, sum), least = std::min(least, mean);
      }
      (source ? line.exact_source : line.exact_target) = weights;
      if (sgn(value) <= 0) continue;
      // This end off the polygon's boundary, by a step that keeps half of the margin.
      const Rational half(1, 2), step = least >= value / 2 ? half : std::min(half, Rational(value / (4 * (value - least))));
      for (Rational& w : source ? line.exact_source : line.exact_target) w = (1 - step) * w + step / static_cast<long>(own);
      return make_positive(domain, line, source);
    }
    return false;
  }
  /// Gives the vertices of the fixed end some weight each, so little that the line stays strictly in the cell.
  bool make_positive(Domain& domain, Weights& line, bool source) {
    const std::size_t m = domain.source.size(), n = domain.target.size();
    std::vector<Rational>& weights = source ? line.exact_target : line.exact_source;
    for (Rational step(1, 2); ; step /= 1024) {
      std::vector<Rational> moved;
      for (const Rational& w : weights) moved.push_back((1 - step) * w + step / static_cast<long>(weights.size()));
      const std::vector<Rational>&s = source ? line.exact_source : moved, &t = source ? moved : line.exact_target;
      bool inside = true;
      for (std::size_t k = 0; k < rows_.size() && inside; ++k) {
        Rational sum;
        for (std::size_t i = 0; i < m; ++i)
          for (std::size_t j = 0; j < n; ++j) sum += s[i] * t[j] * exact_value(domain, k, i * n + j);
        inside = sgn(sum) > 0;
      }
      if (inside) {
        weights = moved;
        break;
      }
      if (bit_length(step.get_den()) > 4000) return false;
    }
    for (std::size_t i = 0; i < m; ++i) line.source[i] = nearest_double(line.exact_source[i]);
    for (std::size_t j = 0; j < n; ++j) line.target[j] = nearest_double(line.exact_target[j]);
    return true;
  }

  struct Path_row {
    std::size_t place;
    const Row* row;
  };

  /// Improves one end for the other, in turn, until a line is strictly in the cell; then once more, to be well inside.
  bool alternate(const Domain& domain, Weights& line) {
    double before = -2;
    for (int round = 0; round < 6; ++round) {
      const double source = improve(domain, line, true);
      if (source > least_margin) return improve(domain, line, false), true;
      const double target = improve(domain, line, false);
      if (target > least_margin) return improve(domain, line, true), true;
      if (target < before + 1e-3 * std::fabs(before)) return false;
      before = target;
    }
    return false;
  }
  static constexpr double least_margin = 1e-11;

  double improve(const Domain& domain, Weights& line, bool source) {
    const std::size_t m = domain.source.size(), n = domain.target.size(), own = source ? m : n;
    small_.restart(own);
    for (const Path_row& r : rows_) {
      const std::span<double> values = small_.add_row();
      const int sign = path_[r.place].sign;
      std::fill(values.begin(), values.end(), 0.0);
      for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j < n; ++j) {
          const double v = sign * r.row->values[i * n + j];
          if (source) values[i] += v * line.target[j];
          else values[j] += v * line.source[i];
        }
    }
    ++counters_->programs;
    const double value = small_.solve();
    std::vector<double>& weights = source ? line.source : line.target;
    weights.assign(small_.column_weights().begin(), small_.column_weights().end());
    // Off the polygon's boundary, as far as half of the margin allows.
    double centre = 1;
    for (std::size_t k = 0; k < small_.rows(); ++k) {
      double sum = 0;
      for (const double v : small_.row(k)) sum += v;
      centre = std::min(centre, sum / static_cast<double>(own));
    }
    const double step = centre >= value / 2 ? 0.5 : std::min(0.5, value / 2 / (value - centre));
    if (value > 0)
      for (double& w : weights) w = (1 - step) * w + step / static_cast<double>(own);
    return value;
  }

  // ---- Proofs that a cell has no line -----------------------------------------------------------------------------------------

  struct Multiplier {
    std::size_t place;  // of the path
    Rational factor;
    std::optional<Weak_step::Form> source = {}, target = {};
  };

  bool by_lemma(std::uint32_t d, Refutation& ended) {
    if (path_.empty()) return false;
    const std::uint32_t newest = path_.back().line;
    if (lemmas_of_.size() <= newest) return false;
    for (const std::uint32_t id : lemmas_of_[newest]) {
      const Lemma& lemma = lemmas_[id];
      if (!std::all_of(lemma.literals.begin(), lemma.literals.end(), [&](const Literal& l) { return sign_[l.line] == l.sign; })) continue;
      std::uint32_t above = d;
      while (above > lemma.domain) above = domains_[above]->parent;
      if (above != lemma.domain) continue;
      ++counters_->learned;
      Used used;
      for (std::size_t k = 0; k < std::min(path_.size(), used.size()); ++k)
        if (std::any_of(lemma.literals.begin(), lemma.literals.end(), [&](const Literal& l) { return l.line == path_[k].line; })) used.set(k);
      ended = leaf({Weak_step::Kind::empty, 0, {}, lemma.terms}, used);
      return true;
    }
    return false;
  }

  /// A leaf by multipliers that have been checked, and a lemma for cells to come.
  Refutation conclude(std::uint32_t d, const std::vector<Multiplier>& multipliers) {
    ++counters_->empty;
    Lemma lemma{{}, {}, d};
    Used used;
    for (const Multiplier& m : multipliers) {
      const Literal& literal = path_[m.place];
      lemma.terms.push_back({literal.line, m.factor, m.source, m.target});
      lemma.literals.push_back(literal);
      if (m.place < used.size()) used.set(m.place);
    }
    lemmas_of_.resize(lines_.size());
    for (const Literal& literal : lemma.literals) lemmas_of_[literal.line].push_back(static_cast<std::uint32_t>(lemmas_.size()));
    lemmas_.push_back(lemma);
    return leaf({Weak_step::Kind::empty, 0, {}, std::move(lemma.terms)}, used);
  }

  enum class Relaxation { empty, has_room, unclear };

  Relaxation conclude_from_game(std::uint32_t d, Refutation& ended) {
    Domain& domain = *domains_[d];
    // 1. The weights as they are: by doubles, with their errors.
    std::vector<Weighted> proposal;
    for (std::size_t k = 0; k < rows_.size(); ++k)
      if (const double w = game_.row_weights()[k]; w > 1e-13) proposal.push_back({k, w, {}});
    if (is_proof_in_doubles(domain, proposal)) {
      std::vector<Multiplier> multipliers;
      for (const Weighted& w : proposal) multipliers.push_back({rows_[w.row].place, factor_of(w.row, exact(w.near)), {}, {}});
      ended = conclude(d, multipliers);
      return Relaxation::empty;
    }
    // 2. The exact solution for the basis that doubles ended with.
    ++counters_->exact_programs;
    const std::vector<std::size_t>&rows = game_.tight_rows(), &columns = game_.tight_columns();
    std::vector<Rational> weights;
    Rational value;
    if (!solve_exactly(rows, columns, [&](std::size_t k, std::size_t c) { return exact_value(domain, k, c); }, weights, value)) return Relaxation::unclear;
    std::vector<Weighted> kept;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (sgn(weights[k]) < 0) return Relaxation::unclear;
      if (sgn(weights[k]) > 0) kept.push_back({rows[k], 0, weights[k]});
    }
    if (sgn(value) > 0) return Relaxation::has_room;
    if (kept.empty() || !is_proof(domain, kept)) return Relaxation::unclear;
    std::vector<Multiplier> multipliers;
    for (const Weighted& w : kept) multipliers.push_back({rows_[w.row].place, factor_of(w.row, w.exact), {}, {}});
    ended = conclude(d, multipliers);
    return Relaxation::empty;
  }

  /// Three lines through a point v, with directions d1, d2, d3: p - v is c1 d1 + c2 d2 + c3 d3 with forms c in p, and as p, v and the line are in one plane, c1 h1 + c2 h2 +
  /// c3 h3 is 0 for all p and q. Where the signs on the path and those of the forms, on the source or on the target, are such that no term is negative, no line is
  /// in the cell. Corners of boxes are like that. Proof: P-71c
  bool conclude_at_corner(std::uint32_t d, Refutation& ended) {
    Domain& domain = *domains_[d];
    for (std::size_t i = 0; i < rows_.size(); ++i)
      for (const std::uint32_t point : lines_[path_[rows_[i].place].line].points) {
        through_.clear();
        for (std::size_t k = 0; k < rows_.size(); ++k)
          if (passes(lines_[path_[rows_[k].place].line], point)) through_.push_back(rows_[k].place);
        if (through_.size() < 3 || through_[0] < rows_[i].place) continue;  // seen from an earlier line
        for (std::size_t a = 0; a < through_.size(); ++a)
          for (std::size_t b = a + 1; b < through_.size(); ++b)
            for (std::size_t c = b + 1; c < through_.size(); ++c)
              for (const bool source : {true, false})
                if (corner_proof(d, domain, {through_[a], through_[b], through_[c]}, point, source, ended)) return true;
      }
    return false;
  }
  bool passes(const Line& line, std::uint32_t point) const {
    if (line.points[0] == point || line.points[1] == point) return true;
    const Triple v = occluders_->near_point_of(point);
    const Six& l = line.near;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, w = (k + 2) % 3;
      if (std::fabs(v[u] * l[w] - v[w] * l[u] - l[3 + k]) > 1e-9) return false;  // the moment that the line would have
    }
    const std::array<Integer, 3> p = occluders_->grid_point(point);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, w = (k + 2) % 3;
      if (p[u] * line.exact[w] - p[w] * line.exact[u] != line.exact[3 + k]) return false;
    }
    return true;
  }
  bool corner_proof(std::uint32_t d, const Domain& domain, const std::array<std::size_t, 3>& places, std::uint32_t point, bool source, Refutation& ended) {
    const std::array<Integer, 3> v = occluders_->grid_point(point);
    std::vector<Multiplier> multipliers;
    int all = 0;  // the sign of all terms
    for (std::size_t k = 0; k < 3; ++k) {
      const Exact_six &u = lines_[path_[places[(k + 1) % 3]].line].exact, &w = lines_[path_[places[(k + 2) % 3]].line].exact;
      Weak_step::Form h{u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0], 0};
      for (std::size_t i = 0; i < 3; ++i) h[3] -= h[i] * v[i];
      if (sgn(h[0]) == 0 && sgn(h[1]) == 0 && sgn(h[2]) == 0) return false;
      const Near_plane plane = near_plane(occluders_->frame(), h);
      const Near_polygon& polygon = source ? domain.source : domain.target;
      if (across(plane, polygon)) return false;
      const int sign = position(plane, polygon) * path_[places[k]].sign;
      if (sign == 0) continue;
      if (all == 0) all = sign;
      if (sign != all) return false;
      if (sign * path_[places[k]].sign < 0)
        for (Integer& x : h) x = -x;
      Multiplier& m = multipliers.emplace_back(Multiplier{places[k], Rational(1), {}, {}});
      (source ? m.source : m.target) = h;
    }
    if (multipliers.empty()) return false;
    ++counters_->corners;
    ended = conclude(d, multipliers);
    return true;
  }

  // Multipliers that are forms: the path's sides times the forms of the polygon's edges, which are not negative on it. A sum of such products is of degree two in
  // one of the points; it is not positive where its coefficients, for pairs of vertices of that polygon and a vertex of the other, are not. Proof: P-71d

  bool conclude_by_forms(std::uint32_t d, bool source, Refutation& ended) {
    Domain& domain = *domains_[d];
    const Near_polygon &own = source ? domain.source : domain.target, &other = source ? domain.target : domain.source;
    const Near_plane& plane = source ? *source_plane_ : occluders_->plane(target_);
    const std::size_t m = own.size(), columns = m * (m + 1) / 2 * other.size();
    if (columns > 400 || rows_.size() > 60) return false;
    // 1. The forms, and their values on the vertices.
    std::vector<Weak_step::Form> forms;
    std::vector<std::vector<Rational>> heights(m);
    for (std::size_t a = 0; a < m; ++a) {
      forms.push_back(form_of(own, a, plane));
      for (const Near_point& p : own) {
        Rational& height = heights[a].emplace_back(value({forms[a], {}}, p), p.exact[3]);
        height.canonicalize();
      }
      if (sgn(*std::min_element(heights[a].begin(), heights[a].end())) < 0) return false;  // no convex polygon
    }
    // 2. The game of all products.
    const auto pair_of = [&](std::size_t i, std::size_t j) { return source ? i * other.size() + j : j * m + i; };
    std::vector<double> scales;
    wide_.restart(columns);
    for (std::size_t a = 0; a < m; ++a) {
      std::vector<double> near;
      const Rational most = *std::max_element(heights[a].begin(), heights[a].end());
      for (const Rational& h : heights[a]) near.push_back(nearest_double(Rational(h / most)));
      for (const Path_row& r : rows_) {
        const std::span<double> values = wide_.add_row();
        const double sign = path_[r.place].sign * 0.5;
        std::size_t c = 0;
        for (std::size_t i = 0; i < m; ++i)
          for (std::size_t k = i; k < m; ++k)
            for (std::size_t j = 0; j < other.size(); ++j) values[c++] = sign * (near[i] * r.row->values[pair_of(k, j)] + near[k] * r.row->values[pair_of(i, j)]);
      }
    }
    ++counters_->form_programs;
    const double result = wide_.solve();
    if (result > 1e-12) return false;
    // 3. Exact weights: those of the basis, or, where there is room, these very doubles.
    const auto coefficient = [&](std::size_t row, std::size_t column) {
      const std::size_t a = row / rows_.size(), k = row % rows_.size(), j = column % other.size();
      std::size_t i = 0, rest = column / other.size();
      while (rest >= m - i) rest -= m - i, ++i;
      return Rational(heights[a][i] * exact_value(domain, k, pair_of(i + rest, j)) + heights[a][i + rest] * exact_value(domain, k, pair_of(i, j)));
    };
    std::vector<std::pair<std::size_t, Rational>> weights;
    if (result < -1e-11) {
      for (std::size_t k = 0; k < wide_.rows(); ++k)
        if (wide_.row_weights()[k] > 1e-10) weights.push_back({k, exact(wide_.row_weights()[k]) / *std::max_element(heights[k / rows_.size()].begin(), heights[k / rows_.size()].end())});
    } else {
      const std::vector<std::size_t>&rows = wide_.tight_rows(), &tight = wide_.tight_columns();
      std::vector<Rational> solved;
      Rational exact_result;
      if (!solve_exactly(rows, tight, coefficient, solved, exact_result)) return false;
      for (std::size_t k = 0; k < rows.size(); ++k) {
        if (sgn(solved[k]) < 0) return false;
        if (sgn(solved[k]) > 0) weights.push_back({rows[k], solved[k]});
      }
    }
    for (std::size_t c = 0; c < columns; ++c) {
      Rational sum;
      for (const auto& [row, weight] : weights) sum += weight * coefficient(row, c);
      if (sgn(sum) > 0) return false;
    }
    // 4. One form for each line.
    std::map<std::size_t, std::array<Rational, 4>> sums;
    for (const auto& [row, weight] : weights)
      for (std::size_t k = 0; k < 4; ++k) sums[row % rows_.size()][k] += weight * Rational(forms[row / rows_.size()][k]);
    std::vector<Multiplier> multipliers;
    for (const auto& [row, sum] : sums) {
      Integer common = 1;
      for (const Rational& x : sum) common = lcm(common, x.get_den());
      Weak_step::Form form;
      for (std::size_t k = 0; k < 4; ++k) form[k] = sum[k].get_num() * (common / sum[k].get_den());
      Multiplier& multiplier = multipliers.emplace_back(Multiplier{rows_[row].place, factor_of(row, Rational(Integer(1), common)), {}, {}});
      (source ? multiplier.source : multiplier.target) = form;
    }
    if (multipliers.empty()) return false;
    ++counters_->by_forms;
    ended = conclude(d, multipliers);
    return true;
  }
  /// A plane through an edge, upright on the polygon's plane, the polygon in front. It is zero on the edge.
  static Weak_step::Form form_of(const Near_polygon& polygon, std::size_t edge, const Near_plane& plane) {
    const std::array<Integer, 4>&a = polygon[edge].exact, &b = polygon[(edge + 1) % polygon.size()].exact;
    std::array<Integer, 3> along;
    for (std::size_t k = 0; k < 3; ++k) along[k] = a[3] * b[k] - b[3] * a[k];
    const std::array<Integer, 4>& n = plane.exact;
    const std::array<Integer, 3> inward{n[1] * along[2] - n[2] * along[1], n[2] * along[0] - n[0] * along[2], n[0] * along[1] - n[1] * along[0]};
    Weak_step::Form form{inward[0] * a[3], inward[1] * a[3], inward[2] * a[3], Integer(-(inward[0] * a[0] + inward[1] * a[1] + inward[2] * a[2]))};
    const Integer common = gcd(gcd(form[0], form[1]), gcd(form[2], form[3]));
    for (Integer& x : form) x /= common;
    return form;
  }

  struct Weighted {
    std::size_t row;
    double near;
    Rational exact;
  };
  /// A weight of a scaled row as a factor of the unscaled one.
  Rational factor_of(std::size_t row, Rational weight) const {
    const int exponent = rows_[row].row->exponent;
    if (exponent >= 0) mpq_mul_2exp(weight.get_mpq_t(), weight.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
    else mpq_div_2exp(weight.get_mpq_t(), weight.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
    return weight;
  }
  /// Whether the weighted sum of rows is negative on all pairs of vertices, for certain: rows within their errors, products and sums within 2^-50 of their sizes.
  bool is_proof_in_doubles(const Domain& domain, const std::vector<Weighted>& weights) const {
    for (std::size_t c = 0; c < domain.pairs.size(); ++c) {
      double sum = 0, error = 0x1p-1000;
      for (const Weighted& w : weights) {
        const double v = w.near * rows_[w.row].row->values[c];
        sum += path_[rows_[w.row].place].sign * v;
        error += 1.0001 * (w.near * rows_[w.row].row->error + 0x1p-47 * std::fabs(v));
      }
      if (!(sum < -error)) return false;
    }
    return true;
  }
  /// The sign of a literal's side on a pair of vertices, as a number: of the scaled row, for points with last coordinate 1. Exact: yes.
  Rational exact_value(Domain& domain, std::size_t row, std::size_t c) const {
    const Literal& literal = path_[rows_[row].place];
    const std::size_t n = domain.target.size();
    const Rational v = occluders_->frame().near_cubic(dot(exact_pair_of(domain, c), lines_[literal.line].exact), domain.source[c / n].exact[3] * domain.target[c % n].exact[3]);
    return factor_of(row, literal.sign > 0 ? v : Rational(-v));
  }
  bool is_proof(Domain& domain, const std::vector<Weighted>& weights) const {
    for (std::size_t c = 0; c < domain.pairs.size(); ++c) {
      Rational sum;
      for (const Weighted& w : weights) sum += w.exact * exact_value(domain, w.row, c);
      if (sgn(sum) > 0) return false;
    }
    return true;
  }
  /// Weights with sum 1 that give the same value in all of the columns: a square system.
  template <class Entry>
  static bool solve_exactly(const std::vector<std::size_t>& rows, const std::vector<std::size_t>& columns, Entry entry, std::vector<Rational>& weights, Rational& value) {
    const std::size_t n = rows.size() + 1;
    if (columns.size() != rows.size() || n > 17) return false;
    std::vector<std::vector<Rational>> a(n, std::vector<Rational>(n + 1));
    for (std::size_t i = 0; i + 1 < n; ++i) {
      for (std::size_t k = 0; k + 1 < n; ++k) a[i][k] = entry(rows[k], columns[i]);
      a[i][n - 1] = -1;
      a[n - 1][i] = 1;
    }
    a[n - 1][n] = 1;
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t pivot = k;
      while (pivot < n && sgn(a[pivot][k]) == 0) ++pivot;
      if (pivot == n) return false;
      std::swap(a[pivot], a[k]);
      for (std::size_t i = 0; i < n; ++i) {
        if (i == k || sgn(a[i][k]) == 0) continue;
        const Rational factor = a[i][k] / a[k][k];
        for (std::size_t j = k; j <= n; ++j) a[i][j] -= factor * a[k][j];
      }
    }
    weights.clear();
    for (std::size_t k = 0; k + 1 < n; ++k) weights.push_back(a[k][n] / a[k][k]);
    value = a[n - 1][n] / a[n - 1][n - 1];
    return true;
  }

  // ---- A line that nothing blocks ----------------------------------------------------------------------------------------------

  /// Takes a proposed line, with few bits, then with more, and moved a little, to the exact test. Returns a piece that is in the way, or none.
  std::optional<std::uint32_t> confirm(const Domain& domain, const Weights& line) {
    std::optional<std::uint32_t> blocker;
    const auto is_free = [&](const Near_point& p, const Near_point& q) {
      if (blocker = occluders_->blocker(p, q, *source_plane_, occluders_->plane(target_)); blocker) return false;
      ++counters_->confirmed;
      sightline_ = {p, q};
      return true;
    };
    if (!line.exact_source.empty()) {
      if (!is_free(inner_point(domain.source, line.exact_source), inner_point(domain.target, line.exact_target))) ++counters_->refuted;
      return blocker;
    }
    std::uniform_real_distribution<double> unit(0.9, 1.1);
    constexpr std::array bits{10, 20, 40, 52, 30};
    for (std::size_t k = 0; k < bits.size(); ++k) {
      Weights moved = line;
      if (k + 1 == bits.size())
        for (std::vector<double>* weights : {&moved.source, &moved.target})
          for (double& w : *weights) w *= unit(dice_);
      const auto rounded = [&](const std::vector<double>& weights) {
        std::vector<Rational> result;
        for (const double w : weights) result.push_back(Rational(std::max(1.0, std::round(std::ldexp(w, bits[k])))));
        return result;
      };
      if (is_free(inner_point(domain.source, rounded(moved.source)), inner_point(domain.target, rounded(moved.target)))) return {};
    }
    ++counters_->refuted;
    return blocker;
  }
  /// Pre: positive weights.
  Near_point inner_point(const Near_polygon& polygon, const std::vector<Rational>& weights) const {
    std::array<Rational, 4> sum;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) sum[k] += weights[i] * Rational(polygon[i].exact[k]) / Rational(polygon[i].exact[3]);
      sum[3] += weights[i];
    }
    Integer common = 1;
    for (const Rational& x : sum) common = lcm(common, x.get_den());
    std::array<Integer, 4> exact;
    for (std::size_t k = 0; k < 4; ++k) exact[k] = sum[k].get_num() * (common / sum[k].get_den());
    return near_point(occluders_->frame(), exact);
  }

  std::vector<Weak_step> in_order(std::uint32_t root) const {
    std::vector<Weak_step> steps;
    std::vector<std::uint32_t> stack{root};
    while (!stack.empty()) {
      const Node& node = nodes_[stack.back()];
      stack.pop_back();
      steps.push_back(node.step);
      if (node.step.kind <= Weak_step::Kind::cut_target) stack.push_back(node.parts[1]), stack.push_back(node.parts[0]);
    }
    return steps;
  }

  const Occluders* occluders_;
  const Near_plane* source_plane_;
  std::uint32_t target_;
  const Weak_search_options* options_;
  std::mt19937_64 dice_;
  Weak_counters* counters_ = nullptr;
  std::vector<std::unique_ptr<Domain>> domains_;
  std::vector<Line> lines_;
  std::vector<int> sign_;  // of lines on the path
  std::vector<Literal> path_;
  std::unordered_map<std::uint64_t, Edge_line> by_points_;
  std::unordered_map<std::uint32_t, std::vector<Edge_line>> edge_lines_;
  std::vector<Lemma> lemmas_;
  std::vector<std::vector<std::uint32_t>> lemmas_of_;
  std::vector<Node> nodes_;
  std::vector<Path_row> rows_;
  std::vector<std::size_t> through_;
  Matrix_game<double> game_, small_, wide_;
  Matrix_game<Rational> exact_game_;
  std::array<Near_point, 2> sightline_;
  std::size_t cells_ = 0;
};

}  // namespace sightline
