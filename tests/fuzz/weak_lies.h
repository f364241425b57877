#pragma once
// Lies about what polygons see, each by a name.

#include "lies.h"

#include <algorithm>
#include <utility>

namespace fuzz {

/// A sightline's end moved: to the boundary of what it is in, anywhere inside, or to where another fragment meets the
/// plane that it is in.
enum class To { boundary, inside, meeting };
template <To to>
bool move_an_end(Weak_certificate& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.visible.empty()) return false;
  Weak_certificate::Sightline& sightline = claim.visible[any_of_first(claim.visible, bytes)];
  const bool begins = bytes.below(2) == 0;
  const Points& own = begins ? claim.sources[sightline.source] : claim.fragments[sightline.fragment].vertices;
  const Flat flat(own);
  Points ends;
  if (to == To::boundary) {
    ends = own;
    ends.push_back(middle(own[0], own[1]));
  } else if (to == To::inside) {
    for (const Place& p : mixtures(flat.corners))
      ends.push_back({Rational(p[0]) / p[3], Rational(p[1]) / p[3], Rational(p[2]) / p[3]});
  } else {
    for (const Order_fragment& fragment : claim.fragments)
      for (std::size_t i = 0; i < fragment.vertices.size(); ++i) {
        const Exact_point &p = fragment.vertices[i], &q = fragment.vertices[(i + 1) % fragment.vertices.size()];
        Rational at_p = 0, at_q = 0;  // heights over the plane
        for (std::size_t k = 0; k < 3; ++k) {
          at_p += flat.plane[k] * (p[k] - own[0][k]);
          at_q += flat.plane[k] * (q[k] - own[0][k]);
        }
        if (sgn(at_p) * sgn(at_q) > 0) continue;
        Exact_point end = middle(p, q);
        for (std::size_t k = 0; k < 3 && at_p != at_q; ++k) end[k] = p[k] + at_p / (at_p - at_q) * (q[k] - p[k]);
        if (flat.location(place(end)) > 0) ends.push_back(end);
      }
  }
  if (ends.empty()) return false;
  const Exact_point& end = ends[any_of_first(ends, bytes)];
  return std::exchange(begins ? sightline.from : sightline.to, end) != end;
}

/// What is seen is hidden, by a proof at random: below the sides of edges of one fragment, it blocks everything; or all
/// is empty, by lines above the leaf or by any; or each leaf is of any kind.
enum class Leaves { blocked, empty, baseless, any };
template <Leaves leaves>
bool hide_at_random(Weak_certificate& claim, const Posed_scene&, Bytes& bytes) {
  using Node = Weak_certificate::Node;
  if (claim.visible.empty()) return false;
  const std::size_t k = any_of_first(claim.visible, bytes);
  const Weak_certificate::Sightline seen = claim.visible[k];
  const Flat source(claim.sources[seen.source]), target(claim.fragments[seen.fragment].vertices);
  // 1. A blocker, one whose plane is between them if the first few have such.
  std::size_t blocker = any_of_first(claim.fragments, bytes);
  const auto is_between = [&](const Flat& other) {
    const auto reaches = [&](const Flat& of, int side) {
      return std::any_of(of.corners.begin(), of.corners.end(), [&](const Place& p) { return other.side(p) == side; });
    };
    const int from = int{reaches(source, 1)} - int{reaches(source, -1)},
              to = int{reaches(target, 1)} - int{reaches(target, -1)};
    return from * to < 0;
  };
  for (std::size_t i = 0; i < claim.fragments.size() && !is_between(Flat(claim.fragments[blocker].vertices)); ++i)
    blocker = (blocker + 1) % claim.fragments.size();
  // 2. A tree over the lines of its edges.
  const std::size_t first = claim.lines.size(),
                    edges = std::min<std::size_t>(5, claim.fragments[blocker].vertices.size()),
                    decided = leaves == Leaves::baseless ? bytes.below(edges) : edges;
  for (std::size_t i = 0; i < edges; ++i) claim.lines.push_back({blocker, i});
  Weak_certificate::Hidden entry{seen.fragment, seen.source, {}};
  const auto grow = [&](const auto& self, std::size_t depth) -> void {
    Node node;
    if (depth < decided) {
      node.kind = Node::Kind::line;
      node.index = first + depth;
      entry.proof.push_back(node);
      self(self, depth + 1);
      return self(self, depth + 1);
    }
    const std::size_t kind = leaves == Leaves::blocked ? 0 : leaves == Leaves::any ? bytes.below(4) : 3;
    node.kind = kind < 2 ? Node::Kind::blocked : kind == 2 ? Node::Kind::away : Node::Kind::empty;
    node.index = blocker;
    if (kind > 2)
      for (std::size_t terms = 1 + bytes.below(3); terms > 0; --terms)
        node.terms.push_back({first + bytes.below(edges), Rational(static_cast<long>(1 + bytes.below(4))), {}, {}});
    entry.proof.push_back(std::move(node));
  };
  grow(grow, 0);
  claim.hidden.push_back(std::move(entry));
  claim.visible.erase(claim.visible.begin() + static_cast<std::ptrdiff_t>(k));
  return true;
}

/// The parts of a node of a proof exchanged.
inline bool exchange_parts_of_a_proof(Weak_certificate& claim, const Posed_scene&, Bytes& bytes) {
  using Node = Weak_certificate::Node;
  if (claim.hidden.empty()) return false;
  std::vector<Node>& proof = claim.hidden[any_of_first(claim.hidden, bytes)].proof;
  const auto is_inner = [&](std::size_t i) { return proof[i].kind <= Node::Kind::cut_target; };
  std::vector<std::size_t> inner;
  for (std::size_t i = 0; i < proof.size(); ++i)
    if (is_inner(i)) inner.push_back(i);
  if (inner.empty()) return false;
  const auto end_of = [&](std::size_t i) {
    for (std::size_t open = 1; open > 0; ++i) open += is_inner(i) ? 1 : -1;
    return proof.begin() + static_cast<std::ptrdiff_t>(i);
  };
  const std::size_t first = inner[any_of_first(inner, bytes)] + 1;
  const auto second = end_of(first);
  const auto end = end_of(static_cast<std::size_t>(second - proof.begin()));
  std::rotate(proof.begin() + static_cast<std::ptrdiff_t>(first), second, end);
  return true;
}

/// A node of a kind in a proof, or nothing.
inline Weak_certificate::Node* any_node(Weak_certificate& claim, Bytes& bytes, auto is_meant) {
  if (claim.hidden.empty()) return nullptr;
  std::vector<Weak_certificate::Node*> all;
  for (Weak_certificate::Node& node : claim.hidden[any_of_first(claim.hidden, bytes)].proof)
    if (is_meant(node)) all.push_back(&node);
  return all.empty() ? nullptr : all[any_of_first(all, bytes)];
}
inline bool is_a_cut(const Weak_certificate::Node& node) {
  return node.kind == Weak_certificate::Node::Kind::cut_source || node.kind == Weak_certificate::Node::Kind::cut_target;
}
template <class Member>
bool exchange_terms(Weak_certificate& claim, Bytes& bytes, Member member) {
  const auto node = any_node(claim, bytes, [](const auto& one) { return one.terms.size() > 1; });
  return node && exchange(node->terms, bytes, member);
}

inline const std::vector<Lie<Weak_certificate>>& lies_in(const Weak_certificate&) {
  using Claim = Weak_certificate;
  using Node_kind = Claim::Node::Kind;
  static const std::vector<Lie<Claim>> all = with_lies_about_fragments<Claim>({{"of the true source",
                                                                                [](Claim& claim,
                                                                                   const Posed_scene& truth, Bytes&) {
                                                                                  std::vector<Points> sources{
                                                                                      truth.source};
                                                                                  return std::exchange(claim.sources,
                                                                                                       sources) !=
                                                                                         sources;
                                                                                }},
                                                                               {"the source nudged",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  return nudge_any(claim.sources[0],
                                                                                                   bytes);
                                                                                }},
                                                                               {"the source turned",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes&) {
                                                                                  std::reverse(claim.sources[0].begin(),
                                                                                               claim.sources[0].end());
                                                                                  return true;
                                                                                }},
                                                                               {"two-sided",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes&) {
                                                                                  claim.two_sided = !claim.two_sided;
                                                                                  return true;
                                                                                }},
                                                                               {"proofs exchanged",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  return exchange(
                                                                                      claim.hidden, bytes,
                                                                                      &Claim::Hidden::proof);
                                                                                }},
                                                                               {"fragments of sightlines exchanged",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  return exchange(
                                                                                      claim.visible, bytes,
                                                                                      &Claim::Sightline::fragment);
                                                                                }},
                                                                               {"lines exchanged",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  return exchange(claim.lines, bytes,
                                                                                                  &Claim::Edge::corner);
                                                                                }},
                                                                               {"hidden by another's proof",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  if (claim.visible.empty() ||
                                                                                      claim.hidden.empty())
                                                                                    return false;
                                                                                  const std::size_t k = any_of_first(
                                                                                      claim.visible, bytes);
                                                                                  Claim::Hidden entry =
                                                                                      claim.hidden[any_of_first(
                                                                                          claim.hidden, bytes)];
                                                                                  entry.fragment =
                                                                                      claim.visible[k].fragment;
                                                                                  entry.also.clear();
                                                                                  claim.hidden.push_back(
                                                                                      std::move(entry));
                                                                                  claim.visible.erase(
                                                                                      claim.visible.begin() +
                                                                                      static_cast<std::ptrdiff_t>(k));
                                                                                  return true;
                                                                                }},
                                                                               {"hidden with others",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  if (claim.visible.empty() ||
                                                                                      claim.hidden.empty())
                                                                                    return false;
                                                                                  const std::size_t k = any_of_first(
                                                                                      claim.visible, bytes);
                                                                                  Claim::Hidden& entry =
                                                                                      claim.hidden[any_of_first(
                                                                                          claim.hidden, bytes)];
                                                                                  entry.also.push_back(
                                                                                      claim.visible[k].fragment);
                                                                                  claim.visible.erase(
                                                                                      claim.visible.begin() +
                                                                                      static_cast<std::ptrdiff_t>(k));
                                                                                  return true;
                                                                                }},
                                                                               {"of others no more",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  if (claim.hidden.empty())
                                                                                    return false;
                                                                                  std::vector<std::size_t>& also =
                                                                                      claim
                                                                                          .hidden[any_of_first(
                                                                                              claim.hidden, bytes)]
                                                                                          .also;
                                                                                  if (also.empty()) return false;
                                                                                  also.erase(
                                                                                      also.begin() +
                                                                                      static_cast<std::ptrdiff_t>(
                                                                                          any_of_first(also, bytes)));
                                                                                  return true;
                                                                                }},
                                                                               {"hidden by a target nudged",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  if (claim.hidden.empty())
                                                                                    return false;
                                                                                  Claim::Hidden& entry =
                                                                                      claim.hidden[any_of_first(
                                                                                          claim.hidden, bytes)];
                                                                                  if (entry.target.empty())
                                                                                    entry.target =
                                                                                        claim.fragments[entry.fragment]
                                                                                            .vertices;
                                                                                  return nudge_any(entry.target, bytes);
                                                                                }},
                                                                               {"hidden by another's target",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  if (claim.hidden.empty())
                                                                                    return false;
                                                                                  Claim::Hidden& entry =
                                                                                      claim.hidden[any_of_first(
                                                                                          claim.hidden, bytes)];
                                                                                  const Points other =
                                                                                      claim
                                                                                          .fragments[any_of_first(
                                                                                              claim.fragments, bytes)]
                                                                                          .vertices;
                                                                                  return std::exchange(entry.target,
                                                                                                       other) != other;
                                                                                }},
                                                                               {"targets left out",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes&) {
                                                                                  bool any = false;
                                                                                  for (Claim::Hidden& entry :
                                                                                       claim.hidden)
                                                                                    any =
                                                                                        !std::exchange(entry.target, {})
                                                                                             .empty() ||
                                                                                        any;
                                                                                  return any;
                                                                                }},
                                                                               {"seen, but hidden with a target",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  if (claim.visible.empty() ||
                                                                                      claim.hidden.empty())
                                                                                    return false;
                                                                                  const std::size_t k = any_of_first(
                                                                                      claim.visible, bytes);
                                                                                  Claim::Hidden& entry =
                                                                                      claim.hidden[any_of_first(
                                                                                          claim.hidden, bytes)];
                                                                                  if (entry.target.empty())
                                                                                    entry.target =
                                                                                        claim.fragments[entry.fragment]
                                                                                            .vertices;
                                                                                  entry.also.push_back(
                                                                                      claim.visible[k].fragment);
                                                                                  claim.visible.erase(
                                                                                      claim.visible.begin() +
                                                                                      static_cast<std::ptrdiff_t>(k));
                                                                                  return true;
                                                                                }},
                                                                               {"parts of a proof exchanged",
                                                                                exchange_parts_of_a_proof},
                                                                               {"lines of terms exchanged",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  return exchange_terms(
                                                                                      claim, bytes, &Claim::Term::line);
                                                                                }},
                                                                               {"factors exchanged",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  return exchange_terms(
                                                                                      claim, bytes,
                                                                                      &Claim::Term::factor);
                                                                                }},
                                                                               {"a term left out",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  const auto node = any_node(
                                                                                      claim, bytes,
                                                                                      [](const auto& one) {
                                                                                        return one.terms.size() > 1;
                                                                                      });
                                                                                  return node &&
                                                                                         remove_any(node->terms, bytes);
                                                                                }},
                                                                               {"a cut nudged",
                                                                                [](
                                                                                    Claim& claim,
                                                                                    const Posed_scene&, Bytes& bytes) {
                                                                                  const auto node =
                                                                                      any_node(claim, bytes, is_a_cut);
                                                                                  return node &&
                                                                                         nudge(node->plane, bytes);
                                                                                }},
                                                                               {"another leaf",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  const auto node = any_node(
                                                                                      claim, bytes,
                                                                                      [](const auto& one) {
                                                                                        return one.kind >=
                                                                                               Node_kind::blocked;
                                                                                      });
                                                                                  if (!node) return false;
                                                                                  const Claim::Node old = *node;
                                                                                  node->kind = bytes.below(2) == 0
                                                                                                   ? Node_kind::away
                                                                                                   : Node_kind::blocked;
                                                                                  node->index = any_of_first(
                                                                                      claim.fragments, bytes);
                                                                                  return old.kind != node->kind ||
                                                                                         (old.kind ==
                                                                                              Node_kind::blocked &&
                                                                                          old.index != node->index);
                                                                                }},
                                                                               {"hidden by one fragment",
                                                                                hide_at_random<Leaves::blocked>},
                                                                               {"hidden by emptiness",
                                                                                hide_at_random<Leaves::empty>},
                                                                               {"hidden by what is not decided",
                                                                                hide_at_random<Leaves::baseless>},
                                                                               {"hidden by any leaves",
                                                                                hide_at_random<Leaves::any>},
                                                                               {"an end on the boundary",
                                                                                move_an_end<To::boundary>},
                                                                               {"an end elsewhere",
                                                                                move_an_end<To::inside>},
                                                                               {"an end in another fragment",
                                                                                move_an_end<To::meeting>},
                                                                               {"a sightline left out",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  return remove_any(claim.visible,
                                                                                                    bytes);
                                                                                }},
                                                                               {"a proof left out",
                                                                                [](Claim& claim, const Posed_scene&,
                                                                                   Bytes& bytes) {
                                                                                  return remove_any(claim.hidden,
                                                                                                    bytes);
                                                                                }}});
  return all;
}

}  // namespace fuzz
