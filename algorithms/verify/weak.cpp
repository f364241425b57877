// To be read after covering.cpp, weak_lines.h and boxes.h, from top to bottom: sightlines, which prove that a fragment
// is visible; trees, which prove that one is hidden; and the check, step by step.

#include <sightline/algorithms/verify/weak.h>

#include <sightline/algorithms/verify/boxes.h>
#include <sightline/algorithms/verify/known_scene.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/weak_lines.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sightline {
namespace weak_check {
namespace {

/// A step of the check that would need more products than this, or a leaf whose multipliers have more bits on their
/// common denominator, is rejected.
constexpr std::size_t most_products = 10'000'000;
/// The same for cuts that are below one another: each gives a cell a corner more at most.
constexpr std::size_t most_cuts = 1000;
/// From so many pairs of corners on it asks whether to go on before each edge of what blocks them.
constexpr std::size_t pairs_worth_asking = 1000;

// ---- Visible

/// Checks sightlines against all fragments; those that are not near them are passed over.
class Sightlines {
 public:
  Sightlines(const Weak_certificate& certificate, const Known_scene& scene, const std::vector<Outline>& sources)
      : certificate_(certificate), fragments_(scene.outlines()), sources_(sources), boxes_(scene.boxes()) {}

  /// Rejects unless nothing is between the end points, nor near them but what is in the plane of the source or of the
  /// fragment. Proof: P-72a, P-72b
  void check(std::size_t k) const;

 private:
  std::string full_name(std::size_t i) const {
    return name("fragment", i) + " (" + name("face", certificate_.fragments[i].face) + ")";
  }

  const Weak_certificate& certificate_;
  const std::vector<Outline>&fragments_, &sources_;
  const Boxes& boxes_;
};

void Sightlines::check(std::size_t k) const {
  const auto& [fragment, source, from, to] = certificate_.visible[k];
  const auto refuse = [&, own = fragment](const std::string& why, std::vector<std::size_t> others = {}) {
    others.insert(others.begin(), own);
    reject(name("visible", k) + " (" + name("face", certificate_.fragments[own].face) + ") " + why, others);
  };
  if (fragment >= fragments_.size())
    reject(name("visible", k) + " names fragment " + std::to_string(fragment) + ", which there is not");
  if (source >= sources_.size()) refuse("names source " + std::to_string(source) + ", which there is not");
  if (!canonical(from) || !canonical(to)) refuse("has an end point that is not in canonical numbers");
  const Outline &own = fragments_[fragment], &start = sources_[source];
  const Homogeneous p = homogeneous(from), q = homogeneous(to);
  if (!start.has_inside(p)) refuse("does not begin inside its source");
  if (!own.has_inside(q)) refuse("does not end inside its fragment");
  if (side(start.plane, q) <= 0) refuse("does not end in front of its source");
  const int front = side(own.plane, p);
  if (front == 0) refuse("begins in the plane of its fragment");
  if (front < 0 && !certificate_.two_sided) refuse("begins behind its fragment");

  const Pluecker_line line = line_through(p, q);
  for (const std::size_t place : boxes_.near_segment(from, to)) {
    const Outline& other = fragments_[place];
    const int at_p = side(other.plane, p), at_q = side(other.plane, q);
    if (at_p * at_q > 0) continue;
    if (at_p == 0 && at_q == 0) {
      if (other.meets_in_plane(p, q)) refuse("meets " + full_name(place), {place});
      continue;
    }
    if ((at_p == 0 && other.in_plane(start.plane)) || (at_q == 0 && other.in_plane(own.plane)))
      continue;  // it holds an end point, but none of its neighbours' segments
    if (crossing(line, other.corners, at_p > 0 || at_q < 0 ? 1 : -1) >= 0) refuse("meets " + full_name(place), {place});
  }
}

// ---- Hidden

/// A form times a common denominator, and that.
struct Scaled_form {
  Homogeneous values;
  Integer scale;

  explicit Scaled_form(const Weak_certificate::Form& form);
};

Scaled_form::Scaled_form(const Weak_certificate::Form& form) : scale(1) {
  for (const Rational& r : form) scale = lcm(scale, r.get_den());
  for (std::size_t k = 0; k < 4; ++k) values[k] = form[k].get_num() * (scale / form[k].get_den());
}

/// Checks the proofs that a fragment is hidden from a source.
class Trees {
 public:
  using Node = Weak_certificate::Node;
  using Term = Weak_certificate::Term;

  Trees(const Weak_certificate& certificate, const std::vector<Outline>& fragments,
        const std::vector<Outline>& sources);

  std::size_t leaves() const { return leaves_; }

  /// Rejects unless the tree is one, and each of its leaves holds, of all fragments that it is said of. `step` is
  /// called now and then. Cost: linear in the nodes, each in the pairs of corners of a cell at most; no recursion.
  /// Proof: P-72c .. P-72f
  void check(std::size_t k, const std::function<void()>& step);

 private:
  /// Rejects unless the target is a convex polygon in the plane of the fragments, and holds them. Proof: P-72f
  void check_target(const Weak_certificate::Hidden& hidden);
  void check_tree(const Corners& target, const std::vector<Node>& proof);
  std::string entry() const {
    return name("hidden", entry_) + " (" + name("face", certificate_.fragments[fragment_].face) + ")";
  }
  [[noreturn]] void refuse(const std::string& why) const {
    reject(entry() + ", " + name("node", node_) + " " + why, {fragment_});
  }

  void decide(std::size_t line, int sign) {
    trail_.push_back({line, path_[line]});
    path_[line] = sign;
  }
  /// 0: undecided.
  int decided(std::size_t line) const { return line < path_.size() ? path_[line] : 0; }

  std::shared_ptr<Cell> cell_of(std::shared_ptr<const Corners> source, std::shared_ptr<const Corners> target,
                                std::size_t cuts) const;

  std::pair<std::shared_ptr<Cell>, std::shared_ptr<Cell>> halves(const Cell& cell, const Node& node) const;

  void check_leaf(Cell& cell, const Node& node);

  /// Nothing of the fragment's part is in front of the source, or nothing of the source's part sees the fragment's
  /// front.
  void check_away(const Cell& cell) const;

  /// All lines of the cell cross the fragment's plane between their ends, inside the fragment. Proof: P-72d
  void check_blocked(Cell& cell, std::size_t f);

  Cell::Signs signs_of(Cell& cell, std::size_t line) const;

  /// What is positive on all of the cell's lines adds up to what is positive on none. Proof: P-72e
  void check_empty(const Cell& cell, const std::vector<Term>& terms) const;

  /// A term's line and forms, and what their product counts.
  struct Summand {
    std::size_t line;
    Scaled_form source, target;
    Rational weight;
  };
  Summand summand_of(const Term& term, const Cell& cell) const;

  /// A line's values at the pairs of corners.
  static Matrix values_of(const Pluecker_line& line, const Cell& cell);

  const Weak_certificate& certificate_;
  const std::vector<Outline>&fragments_, &sources_;
  Lines lines_;                                     // those of the certificate, then those of blockers
  std::vector<Lines::Named> named_;                 // the certificate's, each once
  std::vector<std::size_t> place_;                  // by the certificate's number, among those
  std::vector<std::vector<Lines::Named>> edges_;    // of fragments that block, when they first do
  std::vector<int> path_;                           // signs of numbered lines
  std::vector<std::pair<std::size_t, int>> trail_;  // lines decided, and what was there before
  const std::function<void()>* step_ = nullptr;     // to be called now and then
  std::size_t entry_ = 0, node_ = 0, source_ = 0, fragment_ = 0, leaves_ = 0;
};

Trees::Trees(const Weak_certificate& certificate, const std::vector<Outline>& fragments,
             const std::vector<Outline>& sources)
    : certificate_(certificate), fragments_(fragments), sources_(sources), edges_(fragments.size()) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> known;  // by edge, the place of its line
  for (std::size_t k = 0; k < certificate.lines.size(); ++k) {
    const auto& [fragment, corner] = certificate.lines[k];
    if (fragment >= fragments.size() || corner >= certificate.fragments[fragment].vertices.size())
      reject(name("line", k) + " names an edge that there is not");
    const auto [at, is_new] = known.try_emplace({fragment, corner}, named_.size());
    place_.push_back(at->second);
    if (!is_new) continue;
    const Polygon& polygon = certificate.fragments[fragment].vertices;
    named_.push_back(lines_.through(homogeneous(polygon[corner]), homogeneous(polygon[(corner + 1) % polygon.size()])));
  }
  path_.resize(lines_.size());
}

void Trees::check(std::size_t k, const std::function<void()>& step) {
  const Weak_certificate::Hidden& hidden = certificate_.hidden[k];
  entry_ = k;
  source_ = hidden.source;
  step_ = &step;
  hidden.for_each_fragment([&](std::size_t fragment) {
    if (fragment >= fragments_.size())
      reject(name("hidden", k) + " names fragment " + std::to_string(fragment) + ", which there is not");
    fragment_ = fragment;
    if (source_ >= sources_.size())
      reject(entry() + " names source " + std::to_string(source_) + ", which there is not", {fragment});
  });
  fragment_ = hidden.fragment;
  if (!hidden.target.empty()) {
    check_target(hidden);
    fragment_ = hidden.fragment;
    return check_tree(Outline(hidden.target).corners, hidden.proof);
  }
  if (!hidden.also.empty() && hidden.proof.size() != 1)
    reject(name("hidden", k) + " is of several fragments, but its proof is neither one leaf nor of a polygon");
  hidden.for_each_fragment([&](std::size_t fragment) {
    fragment_ = fragment;
    check_tree(fragments_[fragment].corners, hidden.proof);
  });
}

void Trees::check_target(const Weak_certificate::Hidden& hidden) {
  const auto refuse_target = [&](const std::string& why) { reject(entry() + why, {fragment_}); };
  if (!canonical(hidden.target)) refuse_target(" has a target with a vertex that is not in canonical numbers");
  const Homogeneous& plane = fragments_[hidden.fragment].plane;
  if (const std::string fault = not_convex(homogeneous(hidden.target), plane); !fault.empty())
    refuse_target(", its target " + fault);
  const Outline target(hidden.target);
  hidden.for_each_fragment([&](std::size_t fragment) {
    fragment_ = fragment;
    (*step_)();
    const Outline& own = fragments_[fragment];
    if (!own.in_plane(target.plane) || side(target.plane, own.upwards()) <= 0)
      refuse_target(" is not in the plane of its target, or looks to the other side");
    if (own.corners.size() > most_products / target.corners.size())
      refuse_target(" and its target have too many corners to be checked");
    for (const Homogeneous& corner : own.corners)
      if (crossing(line_through(target.upwards(), corner), target.corners) < 0)
        refuse_target(" has a corner outside of its target");
  });
}

void Trees::check_tree(const Corners& target, const std::vector<Node>& proof) {
  const std::size_t fragment = fragment_;

  /// The second part of an inner node, to be gone on with when the first is done.
  struct Second {
    std::shared_ptr<Cell> cell;
    std::size_t decided;  // how much of the trail is above the node
    std::size_t line;     // to be taken as negative, if there is one
    int sign;
  };
  std::vector<Second> waiting;
  std::shared_ptr<Cell> cell =
      cell_of(std::make_shared<const Corners>(sources_[source_].corners), std::make_shared<const Corners>(target), 0);
  for (std::size_t i = 0;; ++i) {
    if (i == proof.size()) reject(entry() + " ends before each of its cells has a leaf", {fragment});
    if (i % 1024 == 0) (*step_)();
    const Node& node = proof[i];
    node_ = i;
    const bool has_inside = !cell->source->empty() && !cell->target->empty();
    if (!has_inside && (node.kind != Node::Kind::empty || !node.terms.empty()))
      refuse("is below a cut that leaves nothing inside, but is no empty leaf without terms");
    if (node.kind == Node::Kind::line) {
      if (node.index >= place_.size()) refuse("names line " + std::to_string(node.index) + ", which there is not");
      const auto& [number, scale] = named_[place_[node.index]];
      waiting.push_back({cell, trail_.size(), number, -sgn(scale)});
      decide(number, sgn(scale));
      continue;
    }
    if (node.kind == Node::Kind::cut_source || node.kind == Node::Kind::cut_target) {
      auto [first, second] = halves(*cell, node);
      waiting.push_back({std::move(second), trail_.size(), 0, 0});
      cell = std::move(first);
      continue;
    }
    if (has_inside) check_leaf(*cell, node);
    ++leaves_;
    const std::size_t left = waiting.empty() ? 0 : waiting.back().decided;
    for (; trail_.size() > left; trail_.pop_back()) path_[trail_.back().first] = trail_.back().second;
    if (waiting.empty()) {
      if (i + 1 < proof.size())
        reject(entry() + " goes on after its last leaf, with " + name("node", i + 1), {fragment});
      return;
    }
    cell = std::move(waiting.back().cell);
    if (const int sign = waiting.back().sign; sign != 0) decide(waiting.back().line, sign);
    waiting.pop_back();
  }
}

std::shared_ptr<Cell> Trees::cell_of(std::shared_ptr<const Corners> source, std::shared_ptr<const Corners> target,
                                     std::size_t cuts) const {
  return std::make_shared<Cell>(Cell{std::move(source), std::move(target), cuts, {}});
}

std::pair<std::shared_ptr<Cell>, std::shared_ptr<Cell>> Trees::halves(const Cell& cell, const Node& node) const {
  const bool of_source = node.kind == Node::Kind::cut_source;
  const Corners& corners = of_source ? *cell.source : *cell.target;
  if (!canonical(node.plane)) refuse("cuts by a plane that is not in canonical numbers");
  if (cell.cuts == most_cuts) refuse("is below more than " + std::to_string(most_cuts) + " cuts");
  Homogeneous plane = Scaled_form(node.plane).values;
  if (!reaches(plane, corners, 1) && !reaches(plane, corners, -1))
    refuse(std::string("cuts by a plane that holds all of the ") + (of_source ? "source" : "fragment"));
  const auto half = [&] {
    auto part = std::make_shared<const Corners>(cut(corners, plane));
    return of_source ? cell_of(std::move(part), cell.target, cell.cuts + 1)
                     : cell_of(cell.source, std::move(part), cell.cuts + 1);
  };
  std::shared_ptr<Cell> first = half();
  for (Integer& coefficient : plane) coefficient = -coefficient;
  return {std::move(first), half()};
}

void Trees::check_leaf(Cell& cell, const Node& node) {
  switch (node.kind) {
    case Node::Kind::blocked: return check_blocked(cell, node.index);
    case Node::Kind::empty: return check_empty(cell, node.terms);
    case Node::Kind::away: return check_away(cell);
    default: refuse("is of no kind that there is");
  }
}

void Trees::check_away(const Cell& cell) const {
  if (!reaches(sources_[source_].plane, *cell.target, 1)) return;
  const Homogeneous& plane = fragments_[fragment_].plane;
  if (reaches(plane, *cell.source, 1) || (certificate_.two_sided && reaches(plane, *cell.source, -1)))
    refuse("is not away: source and fragment look to each other");
}

void Trees::check_blocked(Cell& cell, std::size_t f) {
  if (f >= fragments_.size()) refuse("is blocked by fragment " + std::to_string(f) + ", which there is not");
  if (cell.source->size() > most_products / cell.target->size())
    reject(name("fragment", fragment_) + " and " + name("source", source_) + " have too many corners to be checked",
           {fragment_});
  const Outline& blocker = fragments_[f];
  const int front = position(blocker.plane, *cell.source);
  if (front * position(blocker.plane, *cell.target) >= 0)
    refuse("is not blocked by " + name("fragment", f) + ": its plane is not between source and fragment");
  std::vector<Lines::Named>& edges = edges_[f];
  if (edges.empty())
    for (std::size_t i = 0; i < blocker.corners.size(); ++i)
      edges.push_back(lines_.through(blocker.corners[i], blocker.corners[(i + 1) % blocker.corners.size()]));
  for (const auto& [line, scale] : edges) {
    const int inwards = front * sgn(scale);
    if (decided(line) == inwards) continue;
    if (cell.source->size() * cell.target->size() > pairs_worth_asking) (*step_)();
    const Cell::Signs signs = signs_of(cell, line);
    if (inwards > 0 ? signs.negative : signs.positive)
      refuse("is not blocked by " + name("fragment", f) + ": lines may pass an edge of it outside");
  }
}

Cell::Signs Trees::signs_of(Cell& cell, std::size_t line) const {
  const auto [place, is_new] = cell.known.try_emplace(line);
  Cell::Signs& signs = place->second;
  if (!is_new) return signs;
  for (const Homogeneous& p : *cell.source) {
    const Homogeneous plane = plane_through(lines_[line], p);
    signs.positive = signs.positive || reaches(plane, *cell.target, 1);
    signs.negative = signs.negative || reaches(plane, *cell.target, -1);
    if (signs.positive && signs.negative) break;
  }
  return signs;
}

void Trees::check_empty(const Cell& cell, const std::vector<Term>& terms) const {
  if (terms.empty()) refuse("says without terms that a cell with an inside is empty");
  const Corners &source = *cell.source, &target = *cell.target;
  const bool source_forms =
      std::any_of(terms.begin(), terms.end(), [](const Term& term) { return term.source.has_value(); });
  const bool target_forms =
      std::any_of(terms.begin(), terms.end(), [](const Term& term) { return term.target.has_value(); });
  const auto products = [](const Corners& corners, bool forms) {
    return forms ? corners.size() * (corners.size() + 1) / 2 : corners.size();
  };
  if (products(source, source_forms) * products(target, target_forms) > most_products / terms.size())
    refuse("has too many terms for its corners to be checked");

  // 1. What is added up, and a common denominator of the weights.
  std::vector<Summand> summands;
  Integer denominator = 1;
  for (const Term& term : terms) {
    const Summand& summand = summands.emplace_back(summand_of(term, cell));
    denominator = lcm(denominator, summand.weight.get_den());
    if (bit_length(denominator) > most_products / terms.size()) refuse("has factors that are too long to be checked");
  }

  // 2. The sum's coefficients.
  Matrix sum;
  for (const Summand& summand : summands) {
    Matrix values = values_of(lines_[summand.line], cell);
    if (source_forms) values = times(summand.source.values, source, values);
    if (target_forms) values = transposed(times(summand.target.values, target, transposed(values)));
    const Integer weight = summand.weight.get_num() * (denominator / summand.weight.get_den());
    if (sum.empty()) sum.assign(values.size(), std::vector<Integer>(values[0].size()));
    for (std::size_t i = 0; i < sum.size(); ++i)
      for (std::size_t j = 0; j < sum[i].size(); ++j)
        mpz_addmul(sum[i][j].get_mpz_t(), weight.get_mpz_t(), values[i][j].get_mpz_t());
  }
  for (const std::vector<Integer>& row : sum)
    for (const Integer& coefficient : row)
      if (sgn(coefficient) > 0) refuse("is not shown to be empty: its sum has a positive coefficient");
}

Trees::Summand Trees::summand_of(const Term& term, const Cell& cell) const {
  const auto form_of = [&](const std::optional<Weak_certificate::Form>& form, const Corners& corners) {
    if (!form) return Scaled_form({0, 0, 0, 1});
    if (!canonical(*form)) refuse("has a form that is not in canonical numbers");
    Scaled_form scaled(*form);
    if (position(scaled.values, corners) <= 0) refuse("has a form that is negative somewhere, or zero everywhere");
    return scaled;
  };
  if (term.line >= place_.size()) refuse("has a term of line " + std::to_string(term.line) + ", which there is not");
  const auto& [line, scale] = named_[place_[term.line]];
  if (decided(line) == 0) refuse("has a term of line " + std::to_string(term.line) + ", which is not decided above it");
  if (!canonical(term.factor) || sgn(term.factor) <= 0)
    refuse("has a factor that is not positive, or not in canonical numbers");
  Summand summand{line, form_of(term.source, *cell.source), form_of(term.target, *cell.target), {}};
  summand.weight = term.factor * abs(scale) * decided(line) / Rational(summand.source.scale * summand.target.scale);
  return summand;
}

Matrix Trees::values_of(const Pluecker_line& line, const Cell& cell) {
  Matrix values;
  for (const Homogeneous& p : *cell.source) {
    const Homogeneous plane = plane_through(line, p);
    std::vector<Integer>& row = values.emplace_back();
    for (const Homogeneous& q : *cell.target) row.push_back(value(plane, q));
  }
  return values;
}

// ---- The certificate

using Faces = std::vector<char>;                               // 1 for those that are meant
using Places = std::set<std::pair<std::size_t, std::size_t>>;  // of fragments and sources

/// Rejects unless the sources are convex polygons.
std::vector<Outline> outlines_of_sources(const Weak_certificate& certificate) {
  std::vector<Outline> sources;
  if (certificate.sources.empty()) reject("there is no source");
  for (std::size_t k = 0; k < certificate.sources.size(); ++k) {
    const Polygon& polygon = certificate.sources[k];
    if (!canonical(polygon)) reject(name("source", k) + " has a vertex that is not in canonical numbers");
    const Integer_vector normal = polygon.empty() ? Integer_vector{} : newell_normal(polygon);
    if (is_zero(normal)) reject(name("source", k) + " has zero area");
    if (const std::string fault = not_convex(polygon, {normal, polygon[0]}); !fault.empty())
      reject(name("source", k) + " " + fault);
    sources.emplace_back(polygon);
  }
  return sources;
}

/// Rejects unless each face that is drawn is visible, hidden or undecided, and only one of these. Returns how many are.
std::string check_faces(const Weak_certificate& certificate, const Faces& visible, const Places& hidden) {
  Faces drawn(visible.size()), undecided(visible.size()), open(visible.size());
  for (const Order_fragment& fragment : certificate.fragments) drawn[fragment.face] = 1;
  for (const Face_id f : certificate.undecided) {
    if (f >= drawn.size() || !drawn[f]) reject("undecided names face " + std::to_string(f) + ", which is not drawn");
    if (undecided[f]++) reject(name("face", f) + " is undecided twice");
    if (visible[f]) reject(name("face", f) + " is undecided, but shown to be visible");
  }
  for (std::size_t i = 0; i < certificate.fragments.size(); ++i) {
    const Face_id f = certificate.fragments[i].face;
    for (std::size_t s = 0; s < certificate.sources.size() && !visible[f] && !open[f]; ++s) {
      if (hidden.count({i, s})) continue;
      if (!undecided[f])
        reject(name("face", f) + " is neither visible nor undecided, and " + name("fragment", i) +
                   " of it is not shown to be hidden from " + name("source", s),
               {i});
      open[f] = 1;
    }
  }
  for (const Face_id f : certificate.undecided)
    if (!open[f]) reject(name("face", f) + " is undecided, but shown to be hidden");
  const auto count = [](const Faces& of) { return static_cast<std::size_t>(std::count(of.begin(), of.end(), 1)); };
  const std::size_t faces = count(drawn), seen = count(visible), unknown = count(undecided);
  return std::to_string(seen) + " faces visible, " + std::to_string(faces - seen - unknown) + " hidden, " +
         std::to_string(unknown) + " undecided";
}

/// The first sources by their corners and the side that they look to.
std::string described(const std::vector<Polygon>& sources) {
  constexpr std::size_t most = 3, most_corners = 8;
  std::string text;
  for (std::size_t k = 0; k < std::min(most, sources.size()); ++k) {
    text += (k == 0 ? "" : ", ") + name("source", k);
    for (std::size_t i = 0; i < std::min(most_corners, sources[k].size()); ++i) text += ' ' + exact_name(sources[k][i]);
    if (sources[k].size() > most_corners)
      text += " and " + std::to_string(sources[k].size() - most_corners) + " more corners";
    const Integer_vector side = newell_normal(sources[k]);
    text += " looking to " + exact_name(Exact_point{Rational(side[0]), Rational(side[1]), Rational(side[2])});
  }
  return sources.size() > most ? text + " and " + std::to_string(sources.size() - most) + " more" : text;
}

}  // namespace

// The certificate, step by step.
std::string check(const Polygon_soup& soup, const Weak_certificate& certificate, const Known_scene& scene,
                  const Verify_options& options) {
  // 1. The sources are convex polygons.
  const std::size_t total = certificate.visible.size() + certificate.hidden.size();
  const std::vector<Outline>& fragments = scene.outlines();
  const std::vector<Outline> sources = outlines_of_sources(certificate);

  // 2. What is said of fragments is true.
  std::size_t done = 0;
  const auto progress = [&] {
    if (options.progress) options.progress(done, total);
  };
  Faces visible(soup.face_count());
  const Sightlines sightlines(certificate, scene, sources);
  for (std::size_t k = 0; k < certificate.visible.size(); ++k, ++done) {
    progress();
    sightlines.check(k);
    visible[certificate.fragments[certificate.visible[k].fragment].face] = 1;
  }
  Places hidden;
  Trees trees(certificate, fragments, sources);
  for (std::size_t k = 0; k < certificate.hidden.size(); ++k, ++done) {
    const auto& entry = certificate.hidden[k];
    entry.for_each_fragment([&](std::size_t fragment) {
      if (!hidden.insert({fragment, entry.source}).second)
        reject(name("hidden", k) + " is of the same fragment and source as one before", {fragment});
    });
    trees.check(k, progress);
  }
  progress();

  // 3. Each face that is drawn is visible, hidden or undecided, and only one of these.
  return check_faces(certificate, visible, hidden) + " from " + std::to_string(sources.size()) + " source polygons; " +
         std::to_string(trees.leaves()) + " leaves of proofs; " + (certificate.two_sided ? "both sides" : "fronts") +
         " of faces, " + described(certificate.sources) + "; " + scene.covered().text();
}

}  // namespace weak_check

Verdict verify_weak(const Polygon_soup& soup, const Weak_certificate& certificate, const Verify_options& options) {
  return certificate_check::verdict_of([&] {
    const certificate_check::Workers workers(options, certificate.visible.size() + certificate.hidden.size());
    return weak_check::check(soup, certificate, weak_check::Known_scene(soup, certificate, workers), options);
  });
}

}  // namespace sightline
