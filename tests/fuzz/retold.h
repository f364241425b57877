#pragma once
// Certificates told otherwise: what makes them no less right. Fragments in another order and in parts, loops begun
// elsewhere and with straight corners, proofs that are longer than they need be. Whatever is accepted is accepted so
// too: a checker that rejects what is right would not be found by lies.

#include "claims.h"
#include "cut_lies.h"
#include "mutate.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace fuzz {

inline Exact_point middle(const Exact_point& p, const Exact_point& q) {
  return {Rational((p[0] + q[0]) / 2), Rational((p[1] + q[1]) / 2), Rational((p[2] + q[2]) / 2)};
}

/// Numbers from 0, in any order.
inline std::vector<std::size_t> any_order(std::size_t count, Mutator& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

template <class T>
void shuffle(std::vector<T>& items, Mutator& random) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
}

template <class T>
void begin_elsewhere(std::vector<T>& loop, Mutator& random) {
  std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(random.below(loop.size())), loop.end());
}

/// A corner more behind the k-th one, halfway to the next.
inline void add_straight_corner(Points& loop, std::size_t k) {
  loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(k) + 1, middle(loop[k], loop[(k + 1) % loop.size()]));
}

/// A convex loop in two, from the first corner, or from the middle of the first edge, to that of another edge.
inline std::array<Points, 2> halves(const Points& loop, Mutator& random) {
  const std::size_t n = loop.size(), k = 1 + random.below(n - 2);
  const bool at_corner = random.below(2) == 0;
  const Exact_point begin = at_corner ? loop[0] : middle(loop[0], loop[1]), end = middle(loop[k], loop[(k + 1) % n]);
  const auto at = [&](std::size_t i) { return loop.begin() + static_cast<std::ptrdiff_t>(i); };
  std::array<Points, 2> parts{Points(at(1), at(k + 1)), Points(at(k + 1), loop.end())};
  parts[0].insert(parts[0].begin(), begin);
  parts[0].push_back(end);
  if (!at_corner) parts[1].push_back(loop[0]);
  parts[1].insert(parts[1].begin(), end);
  parts[1].push_back(begin);
  return parts;
}

/// Whether all of a loop is straight, as may be where it has straight corners.
inline bool is_flat(const Points& loop) { return Flat(loop).normal == Place{0, 0, 0, 0}; }
/// The same of the rays of a cone.
inline bool is_flat_cone(const Points& rays) {
  const Place side = cross(direction(rays[0]), direction(rays[1]));
  return std::all_of(rays.begin(), rays.end(),
                     [&](const Exact_point& d) { return sign_of_dot(side, direction(d)) == 0; });
}

/// The fragments in another order: order[i] is which one comes as the i-th. Returns which one each becomes.
inline std::vector<std::size_t> reorder(Covering& claim, const std::vector<std::size_t>& order) {
  std::vector<Order_fragment> fragments;
  std::vector<std::size_t> becomes(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    becomes[order[i]] = i;
    fragments.push_back(claim.fragments[order[i]]);
  }
  claim.fragments = std::move(fragments);
  return becomes;
}

inline void retell(Order_certificate& claim, Mutator& random) {
  if (claim.fragments.empty()) return;
  const std::size_t k = random.below(claim.fragments.size());
  Points& loop = claim.fragments[k].vertices;
  switch (random.below(6)) {
    case 0: begin_elsewhere(loop, random); break;
    case 1: add_straight_corner(loop, random.below(loop.size())); break;
    case 2:
    case 3:
    case 4: retell_cuts(claim, random); break;
    default: {
      const auto [one, other] = halves(loop, random);
      if (is_flat(one) || is_flat(other)) break;
      loop = one;
      Order_fragment rest = claim.fragments[k];
      rest.vertices = other;
      insert_fragment(claim, k, rest);
    }
  }
}

inline void retell(Graph_certificate& claim, Mutator& random) {
  if (claim.fragments.empty()) return;
  switch (random.below(3)) {
    case 0: {
      const std::size_t k = random.below(claim.fragments.size());
      const auto is_of_its_face = [&](const auto& part) { return part.face == claim.fragments[k].face; };
      if (std::count_if(claim.fragments.begin(), claim.fragments.end(), is_of_its_face) > 1 ||
          std::any_of(claim.pieces.begin(), claim.pieces.end(), is_of_its_face))
        break;  // cut, it is at its own points only
      Points& loop = claim.fragments[k].vertices;
      const std::size_t corner = random.below(loop.size());
      add_straight_corner(loop, corner);
      for (Graph_certificate::Arc& arc : claim.arcs) {
        arc.corner_from += arc.from == k && arc.corner_from > corner;
        arc.corner_to += arc.to == k && arc.corner_to > corner;
      }
    } break;
    case 1: {  // within components
      std::vector<std::size_t> order;
      for (const std::size_t size : claim.sizes) {
        const std::size_t first = order.size();
        for (const std::size_t i : any_order(size, random)) order.push_back(first + i);
      }
      const std::vector<std::size_t> becomes = reorder(claim, order);
      for (Graph_certificate::Arc& arc : claim.arcs) {
        arc.from = becomes[arc.from];
        arc.to = becomes[arc.to];
      }
    } break;
    default: shuffle(claim.arcs, random);
  }
}

inline void retell(Visible_certificate& claim, Mutator& random) {
  if (claim.fragments.empty()) return;
  const auto sum = [](const Exact_point& a, const Exact_point& b) {
    return Exact_point{Rational(a[0] + b[0]), Rational(a[1] + b[1]), Rational(a[2] + b[2])};
  };
  switch (random.below(5)) {
    case 0: {
      const std::vector<std::size_t> becomes = reorder(claim, any_order(claim.fragments.size(), random));
      for (Visible_certificate::Part& part : claim.parts) part.fragment = becomes[part.fragment];
      shuffle(claim.parts, random);
      shuffle(claim.empty, random);
    } break;
    case 1: {
      Points& loop = claim.fragments[random.below(claim.fragments.size())].vertices;
      add_straight_corner(loop, random.below(loop.size()));
    } break;
    case 2:
      if (!claim.empty.empty()) {  // an empty cone in two
        const std::size_t k = random.below(claim.empty.size());
        begin_elsewhere(claim.empty[k], random);
        const auto [one, other] = halves(claim.empty[k], random);
        if (is_flat_cone(one) || is_flat_cone(other)) break;
        claim.empty[k] = one;
        claim.empty.push_back(other);
      }
      break;
    case 3:
      if (!claim.empty.empty()) {
        Points& cone = claim.empty[random.below(claim.empty.size())];
        add_straight_corner(cone, random.below(cone.size()));
        if (random.below(2) == 0) std::reverse(cone.begin(), cone.end());
      }
      break;
    default:
      if (!claim.parts.empty()) {  // a part in two, through a ray of it and one between two others
        Visible_certificate::Part& part = claim.parts[random.below(claim.parts.size())];
        if (part.rays.size() < 3) break;
        begin_elsewhere(part.rays, random);
        claim.rays.push_back(sum(claim.rays[part.rays[1]], claim.rays[part.rays[2]]));
        const auto between = static_cast<std::uint32_t>(claim.rays.size() - 1);
        Visible_certificate::Part rest = part;
        part.rays = {part.rays[0], part.rays[1], between};
        rest.rays[1] = between;
        if (random.below(2) == 0) std::reverse(rest.rays.begin(), rest.rays.end());
        claim.parts.push_back(std::move(rest));
      }
  }
}

/// A plane halfway between two corners, nearer to one of which each side is; both sides have an inside.
inline Weak_certificate::Form bisector(const Points& polygon) {
  const Exact_point &p = polygon[0], &q = polygon[1];
  Weak_certificate::Form plane;
  for (std::size_t k = 0; k < 3; ++k) {
    plane[k] = q[k] - p[k];
    plane[3] -= plane[k] * (p[k] + q[k]) / 2;
  }
  return plane;
}

/// A proof twice, below a node that it does not need.
inline void weaken(Weak_certificate& claim, Weak_certificate::Hidden& entry, Mutator& random) {
  using Node = Weak_certificate::Node;
  constexpr std::size_t most_nodes = 500;
  if (entry.proof.empty() || entry.proof.size() > most_nodes || (!entry.also.empty() && entry.target.empty())) return;
  const auto has = [&](Node::Kind kind) {  // a part may have no inside on one side of such a cut
    return std::any_of(entry.proof.begin(), entry.proof.end(), [&](const Node& node) { return node.kind == kind; });
  };
  Node root;
  switch (random.below(3)) {
    case 0:
      root.kind = Node::Kind::line;
      if (claim.lines.empty()) claim.lines.push_back({entry.fragment, 0});
      root.index = random.below(claim.lines.size());
      break;
    case 1:
      if (has(Node::Kind::cut_source)) return;
      root.kind = Node::Kind::cut_source;
      root.plane = bisector(claim.sources[entry.source]);
      break;
    default:
      if (has(Node::Kind::cut_target)) return;
      root.kind = Node::Kind::cut_target;
      root.plane = bisector(entry.target.empty() ? claim.fragments[entry.fragment].vertices : entry.target);
  }
  std::vector<Node> proof{root};
  for (int times = 0; times < 2; ++times) proof.insert(proof.end(), entry.proof.begin(), entry.proof.end());
  entry.proof = std::move(proof);
}

/// A proof of fragments by themselves as one of a polygon, or of a polygon that begins elsewhere and has a corner more.
inline void tell_of_a_target(Weak_certificate& claim, Mutator& random) {
  if (claim.hidden.empty()) return;
  Weak_certificate::Hidden& entry = claim.hidden[random.below(claim.hidden.size())];
  if (entry.target.empty() && entry.also.empty()) entry.target = claim.fragments[entry.fragment].vertices;
  if (entry.target.empty()) return;
  begin_elsewhere(entry.target, random);
  add_straight_corner(entry.target, random.below(entry.target.size()));
}

/// Fragments that one leaf hides, one by one; or two that the same leaf hides, together.
inline void tell_apart(Weak_certificate& claim, Mutator& random) {
  if (claim.hidden.empty()) return;
  const std::size_t k = random.below(claim.hidden.size());
  if (!claim.hidden[k].also.empty()) {
    const std::size_t other = claim.hidden[k].also.back();
    claim.hidden[k].also.pop_back();
    const Weak_certificate::Hidden& entry = claim.hidden[k];
    claim.hidden.push_back(Weak_certificate::Hidden{other, entry.source, entry.proof, {}, entry.target});
    return;
  }
  const Weak_certificate::Hidden mine = claim.hidden[k];
  if (mine.proof.size() != 1 || !mine.target.empty()) return;
  for (std::size_t i = 0; i < claim.hidden.size(); ++i) {
    auto& entry = claim.hidden[i];
    if (i == k || entry.source != mine.source || entry.proof.size() != 1 || !entry.target.empty() ||
        !mine.proof[0].terms.empty() || !entry.proof[0].terms.empty() || entry.proof[0].kind != mine.proof[0].kind ||
        entry.proof[0].index != mine.proof[0].index)
      continue;
    entry.also.push_back(mine.fragment);
    claim.hidden.erase(claim.hidden.begin() + static_cast<std::ptrdiff_t>(k));
    return;
  }
}

inline void retell(Along_certificate& claim, Mutator& random) {
  if (claim.fragments.empty()) return;
  if (random.below(2) == 0) {
    shuffle(claim.proofs, random);
    shuffle(claim.faces, random);
    return;
  }
  const std::vector<std::size_t> becomes = reorder(claim, any_order(claim.fragments.size(), random));
  const auto rename = [&](std::size_t& fragment) { fragment = becomes[fragment]; };
  for (auto& proof : claim.proofs) {
    rename(proof.fragment);
    for (auto& side : proof.cone) rename(side.fragment);
    for (auto& node : proof.tree) rename(node.is_cut ? node.cut.fragment : node.blocked);
  }
}

inline void retell(Weak_certificate& claim, Mutator& random) {
  using Node = Weak_certificate::Node;
  if (claim.fragments.empty()) return;
  switch (random.below(6)) {
    case 0: {
      const std::vector<std::size_t> becomes = reorder(claim, any_order(claim.fragments.size(), random));
      for (auto& entry : claim.visible) entry.fragment = becomes[entry.fragment];
      for (auto& line : claim.lines) line.fragment = becomes[line.fragment];
      for (auto& entry : claim.hidden) {
        entry.fragment = becomes[entry.fragment];
        for (std::size_t& other : entry.also) other = becomes[other];
        shuffle(entry.also, random);
        for (Node& node : entry.proof)
          if (node.kind == Node::Kind::blocked) node.index = becomes[node.index];
      }
      shuffle(claim.visible, random);
      shuffle(claim.hidden, random);
    } break;
    case 1: {
      const std::size_t k = random.below(claim.fragments.size());
      Points& loop = claim.fragments[k].vertices;
      const std::size_t corner = random.below(loop.size());
      add_straight_corner(loop, corner);
      for (auto& entry : claim.hidden)  // an edge is half as long, and its side counts half as much
        for (Node& node : entry.proof)
          for (auto& term : node.terms)
            if (claim.lines[term.line].fragment == k && claim.lines[term.line].corner == corner) term.factor *= 2;
      for (auto& line : claim.lines) line.corner += line.fragment == k && line.corner > corner;
    } break;
    case 2: {
      Points& source = claim.sources[random.below(claim.sources.size())];
      begin_elsewhere(source, random);
      add_straight_corner(source, random.below(source.size()));
    } break;
    case 3: {  // a fragment in two, hidden by the same proof if that does not cut it
      const std::size_t k = random.below(claim.fragments.size());
      const auto is_of_it = [&](const auto& entry) { return entry.fragment == k; };
      const auto hides_it = [&](const Weak_certificate::Hidden& entry) {
        return is_of_it(entry) || std::find(entry.also.begin(), entry.also.end(), k) != entry.also.end();
      };
      const auto cuts = [&](const Weak_certificate::Hidden& entry) {
        return hides_it(entry) && entry.target.empty() &&
               std::any_of(entry.proof.begin(), entry.proof.end(),
                           [](const Node& node) { return node.kind == Node::Kind::cut_target; });
      };
      const auto names = [&](const Weak_certificate::Hidden& entry) {
        return std::any_of(entry.proof.begin(), entry.proof.end(),
                           [&](const Node& node) { return node.kind == Node::Kind::blocked && node.index == k; });
      };
      if (std::any_of(claim.visible.begin(), claim.visible.end(), is_of_it) ||
          std::any_of(claim.lines.begin(), claim.lines.end(), is_of_it) ||
          std::any_of(claim.hidden.begin(), claim.hidden.end(), cuts) ||
          std::any_of(claim.hidden.begin(), claim.hidden.end(), names))
        break;
      const auto [one, other] = halves(claim.fragments[k].vertices, random);
      if (is_flat(one) || is_flat(other)) break;
      claim.fragments[k].vertices = one;
      Order_fragment rest = claim.fragments[k];
      rest.vertices = other;
      for (std::size_t i = 0, entries = claim.hidden.size(); i < entries; ++i)
        if (hides_it(claim.hidden[i])) {
          const Weak_certificate::Hidden& entry = claim.hidden[i];
          const bool together = (entry.proof.size() == 1 || !entry.target.empty()) && random.below(2) == 0;
          if (together) claim.hidden[i].also.push_back(claim.fragments.size());
          else
            claim.hidden.push_back(
                Weak_certificate::Hidden{claim.fragments.size(), entry.source, entry.proof, {}, entry.target});
        }
      claim.fragments.push_back(std::move(rest));
    } break;
    case 4:
      tell_apart(claim, random);
      tell_of_a_target(claim, random);
      for (auto& entry : claim.hidden)
        for (Node& node : entry.proof) {
          const Rational factor(static_cast<long>(1 + random.below(9)));
          shuffle(node.terms, random);
          for (auto& term : node.terms) term.factor *= factor;
        }
      break;
    default:
      if (!claim.hidden.empty()) weaken(claim, claim.hidden[random.below(claim.hidden.size())], random);
  }
}

}  // namespace fuzz
