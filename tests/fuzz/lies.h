#pragma once
// Lies about what a right certificate shows, each by a name. Every one says whether it changed anything.

#include "certificate.h"
#include "retold.h"

#include <sightline/harness/generate/families.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace fuzz {

using generate::Posed_scene;

template <class Claim>
struct Lie {
  std::string_view name;
  bool (*tell)(Claim&, const Posed_scene& truth, Bytes&);
};

// ---- In any certificate

/// One of the first that there are. Pre: there are some.
template <class Entries>
std::size_t any_of_first(const Entries& entries, Bytes& bytes) {
  return bytes.below(std::min<std::size_t>(256, entries.size()));
}

template <class Entries>
bool exchange(Entries& entries, Bytes& bytes, auto member) {
  if (entries.size() < 2) return false;
  const std::size_t i = any_of_first(entries, bytes), j = any_of_first(entries, bytes);
  std::swap(entries[i].*member, entries[j].*member);
  return i != j;
}

template <class Entries>
bool remove_any(Entries& entries, Bytes& bytes) {
  if (entries.empty()) return false;
  entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(any_of_first(entries, bytes)));
  return true;
}

/// A number a little elsewhere.
template <std::size_t n>
bool nudge(std::array<Rational, n>& numbers, Bytes& bytes) {
  const Rational step = generate::power_of_two(-static_cast<int>(bytes.below(100)));
  Rational& number = numbers[bytes.below(n)];
  number += bytes.below(2) == 0 ? step : Rational(-step);
  return true;
}
template <class Entries>
bool nudge_any(Entries& entries, Bytes& bytes) {
  return !entries.empty() && nudge(entries[any_of_first(entries, bytes)], bytes);
}

// One more fragment, of the same face and piece as the k-th, wherever it disturbs nothing else.
inline void add_beside(Order_certificate& claim, std::size_t k, const Order_fragment& fragment) {
  claim.fragments.insert(claim.fragments.begin() + static_cast<std::ptrdiff_t>(k) + 1, fragment);
}
inline void add_beside(Graph_certificate& claim, std::size_t, const Order_fragment& fragment) {
  claim.fragments.push_back(fragment);
  claim.sizes.push_back(1);
}
inline void add_beside(Visible_certificate& claim, std::size_t, const Order_fragment& fragment) {
  claim.fragments.push_back(fragment);
}
inline void add_beside(Along_certificate& claim, std::size_t k, const Order_fragment& fragment) {
  for (std::size_t i = 0, entries = claim.proofs.size(); i < entries; ++i)
    if (claim.proofs[i].fragment == k) {
      Along_certificate::Proof entry = claim.proofs[i];
      entry.fragment = claim.fragments.size();
      claim.proofs.push_back(std::move(entry));
    }
  claim.fragments.push_back(fragment);
}
inline void add_beside(Weak_certificate& claim, std::size_t k, const Order_fragment& fragment) {
  for (std::size_t i = 0, entries = claim.hidden.size(); i < entries; ++i)
    if (claim.hidden[i].fragment == k) {
      Weak_certificate::Hidden entry = claim.hidden[i];
      entry.fragment = claim.fragments.size();
      claim.hidden.push_back(std::move(entry));
    }
  claim.fragments.push_back(fragment);
}

template <class Claim>
bool swap_neighbours(Claim& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.fragments.size() < 2) return false;
  const std::size_t k = bytes.below(std::min<std::size_t>(256, claim.fragments.size() - 1));
  std::swap(claim.fragments[k], claim.fragments[k + 1]);
  return true;
}

/// Fragments that are none, as polygons: clockwise, with a corner twice or a spike, without area; or the same one again
/// and once clockwise, so that boundaries cancel.
template <class Claim>
bool is_no_polygon(Claim& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.fragments.empty()) return false;
  Points& loop = claim.fragments[any_of_first(claim.fragments, bytes)].vertices;
  const std::size_t corner = bytes.below(loop.size());
  const auto at = loop.begin() + static_cast<std::ptrdiff_t>(corner);
  const Exact_point p = *at;
  switch (bytes.below(3)) {
    case 0: std::reverse(loop.begin(), loop.end()); break;
    case 1: loop.insert(at, p); break;
    default: loop.insert(at + 1, {middle(p, middle(loop[0], loop[2])), p});
  }
  return true;
}
template <class Claim>
bool has_no_area(Claim& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.fragments.empty()) return false;
  const std::size_t k = any_of_first(claim.fragments, bytes);
  Order_fragment fragment = claim.fragments[k];
  Points& loop = fragment.vertices;
  const std::size_t corner = bytes.below(loop.size());
  const Exact_point p = loop[corner], q = loop[(corner + 1) % loop.size()];
  loop = {p, middle(p, q), q};
  if (bytes.below(2) == 0) loop.push_back(loop[1]);
  add_beside(claim, k, fragment);
  return true;
}
template <class Claim>
bool cancels(Claim& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.fragments.empty()) return false;
  const std::size_t k = any_of_first(claim.fragments, bytes);
  Order_fragment fragment = claim.fragments[k];
  add_beside(claim, k, fragment);
  std::reverse(fragment.vertices.begin(), fragment.vertices.end());
  add_beside(claim, k, fragment);
  return true;
}
template <class Claim>
bool corner_elsewhere(Claim& claim, const Posed_scene&, Bytes& bytes) {
  return !claim.fragments.empty() && nudge_any(claim.fragments[any_of_first(claim.fragments, bytes)].vertices, bytes);
}
template <class Claim>
bool face_exchanged(Claim& claim, const Posed_scene&, Bytes& bytes) {
  return exchange(claim.fragments, bytes, &Order_fragment::face);
}
template <class Claim>
bool drops_a_reason(Claim& claim, const Posed_scene&, Bytes& bytes) {
  return remove_any(claim.set_aside, bytes);
}

/// Two triangles of a face that share an edge, on the other diagonal of what they are together.
template <class Claim>
bool on_the_other_diagonal(Claim& claim, const Posed_scene&, Bytes& bytes) {
  struct Pair {
    Order_fragment *one, *other;
    Points together;  // from one end of the diagonal
  };
  std::vector<Pair> pairs;
  for (Order_fragment& one : claim.fragments)
    for (Order_fragment& other : claim.fragments) {
      const Points &a = one.vertices, &b = other.vertices;
      if (&one >= &other || one.face != other.face || a.size() != 3 || b.size() != 3) continue;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          if (a[i] == b[(k + 1) % 3] && a[(i + 1) % 3] == b[k])
            pairs.push_back({&one, &other, {a[i], b[(k + 2) % 3], b[k], a[(i + 2) % 3]}});
    }
  if (pairs.empty()) return false;
  const auto& [one, other, loop] = pairs[any_of_first(pairs, bytes)];
  one->vertices = {loop[0], loop[1], loop[3]};
  other->vertices = {loop[1], loop[2], loop[3]};
  for (Covering::Piece& piece : claim.pieces)
    for (const Order_fragment* fragment : {one, other})
      if (piece.face == fragment->face && piece.piece == fragment->piece) piece.vertices = fragment->vertices;
  return true;
}

template <class Claim>
bool of_the_true_eye(Claim& claim, const Posed_scene& truth, Bytes&) {
  return std::exchange(claim.eye, truth.eye) != truth.eye;
}
template <class Claim>
bool nudges_the_eye(Claim& claim, const Posed_scene&, Bytes& bytes) {
  return nudge(claim.eye, bytes);
}

template <class Claim>
std::vector<Lie<Claim>> with_lies_about_fragments(std::vector<Lie<Claim>> lies) {
  lies.insert(lies.end(), {{"a fragment that is no polygon", is_no_polygon<Claim>},
                           {"a fragment without area", has_no_area<Claim>},
                           {"fragments that cancel", cancels<Claim>},
                           {"a corner elsewhere", corner_elsewhere<Claim>},
                           {"faces exchanged", face_exchanged<Claim>},
                           {"the other diagonal", on_the_other_diagonal<Claim>},
                           {"a set-aside face left out", drops_a_reason<Claim>}});
  return lies;
}

// ---- In an order

inline const std::vector<Lie<Order_certificate>>& lies_in(const Order_certificate&) {
  using Claim = Order_certificate;
  static const std::vector<Lie<Claim>> all = with_lies_about_fragments<Claim>(
      {{"of the true eye", of_the_true_eye<Claim>},
       {"the eye nudged", nudges_the_eye<Claim>},
       {"the eye at a point",
        [](Claim& claim, const Posed_scene& truth, Bytes& bytes) {
          claim.eye = truth.soup.point(
              static_cast<Point_id>(bytes.below(std::min<std::size_t>(256, truth.soup.point_count()))));
          return true;
        }},
       {"on-view",
        [](Claim& claim, const Posed_scene&, Bytes&) {
          claim.on_view = !claim.on_view;
          return true;
        }},
       {"on-view, one less",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          claim.on_view = true;
          return remove_any(claim.fragments, bytes);
        }},
       {"neighbours swapped", swap_neighbours<Claim>},
       {"one drawn elsewhere", [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.fragments.size() < 2) return false;
          const std::size_t from = any_of_first(claim.fragments, bytes), to = any_of_first(claim.fragments, bytes);
          const Order_fragment moved = claim.fragments[from];
          claim.fragments.erase(claim.fragments.begin() + static_cast<std::ptrdiff_t>(from));
          claim.fragments.insert(claim.fragments.begin() + static_cast<std::ptrdiff_t>(to), moved);
          return from != to;
        }}});
  return all;
}

// ---- In a graph

inline bool splits_a_component(Graph_certificate& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.sizes.empty()) return false;
  const std::size_t c = any_of_first(claim.sizes, bytes);
  if (claim.sizes[c] < 2) return false;
  --claim.sizes[c];
  claim.sizes.insert(claim.sizes.begin() + static_cast<std::ptrdiff_t>(c), 1);
  std::erase_if(claim.arcs, [&](const auto&) { return bytes.below(2) == 0; });
  return true;
}
inline bool joins_components(Graph_certificate& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.sizes.size() < 2) return false;
  const std::size_t c = bytes.below(std::min<std::size_t>(256, claim.sizes.size() - 1));
  claim.sizes[c] += claim.sizes[c + 1];
  claim.sizes.erase(claim.sizes.begin() + static_cast<std::ptrdiff_t>(c) + 1);
  return true;
}
inline bool joins_with_arcs(Graph_certificate& claim, const Posed_scene& truth, Bytes& bytes) {
  if (!joins_components(claim, truth, bytes)) return false;
  for (std::size_t c = 0, first = 0; c < claim.sizes.size(); first += claim.sizes[c++])
    for (std::size_t i = first; i + 1 < first + claim.sizes[c]; ++i) {
      const auto corner = [&](std::size_t of) { return any_of_first(claim.fragments[of].vertices, bytes); };
      claim.arcs.push_back({i, i + 1, corner(i), corner(i + 1)});
      claim.arcs.push_back({i + 1, i, corner(i + 1), corner(i)});
    }
  return true;
}

/// What may not be cut, or not there.
inline bool cuts_a_fragment(Graph_certificate& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.fragments.empty()) return false;
  const std::size_t k = any_of_first(claim.fragments, bytes);
  Mutator random(bytes.byte());
  const auto [one, other] = halves(claim.fragments[k].vertices, random);
  if (is_flat(one) || is_flat(other)) return false;
  claim.fragments[k].vertices = one;
  add_beside(claim, k, {claim.fragments[k].face, claim.fragments[k].piece, other});
  return true;
}

inline const std::vector<Lie<Graph_certificate>>& lies_in(const Graph_certificate&) {
  using Claim = Graph_certificate;
  static const std::vector<Lie<Claim>> all = with_lies_about_fragments<Claim>(
      {{"a component split", splits_a_component},
       {"components joined", joins_components},
       {"components joined by arcs", joins_with_arcs},
       {"a fragment cut", cuts_a_fragment},
       {"neighbours swapped", swap_neighbours<Claim>},
       {"arcs exchanged", [](Claim& claim, const Posed_scene&,
                             Bytes& bytes) { return exchange(claim.arcs, bytes, &Graph_certificate::Arc::to); }},
       {"an arc left out",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) { return remove_any(claim.arcs, bytes); }}});
  return all;
}

// ---- In what an eye sees

inline bool is_of_another_in_its_plane(Visible_certificate& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.parts.empty()) return false;
  std::size_t& own = claim.parts[any_of_first(claim.parts, bytes)].fragment;
  const std::vector<Flat> fragments = flats(claim);
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < fragments.size(); ++i)
    if (i != own && fragments[i].is_in_plane_of(fragments[own])) others.push_back(i);
  if (others.empty()) return false;
  own = others[any_of_first(others, bytes)];
  return true;
}

inline const std::vector<Lie<Visible_certificate>>& lies_in(const Visible_certificate&) {
  using Claim = Visible_certificate;
  static const std::vector<Lie<Claim>> all = with_lies_about_fragments<Claim>(
      {{"of the true eye", of_the_true_eye<Claim>},
       {"the eye nudged", nudges_the_eye<Claim>},
       {"a ray nudged", [](Claim& claim, const Posed_scene&, Bytes& bytes) { return nudge_any(claim.rays, bytes); }},
       {"an empty cone nudged",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          return !claim.empty.empty() && nudge_any(claim.empty[any_of_first(claim.empty, bytes)], bytes);
        }},
       {"parts exchanged",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          return exchange(claim.parts, bytes, &Visible_certificate::Part::fragment);
        }},
       {"a part of another fragment",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.parts.empty()) return false;
          const std::size_t fragment = any_of_first(claim.fragments, bytes);
          return std::exchange(claim.parts[any_of_first(claim.parts, bytes)].fragment, fragment) != fragment;
        }},
       {"a part of another fragment in its plane", is_of_another_in_its_plane},
       {"what is seen is called empty",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.parts.empty()) return false;
          const std::size_t k = any_of_first(claim.parts, bytes);
          claim.empty.push_back(rays_of(claim, claim.parts[k]));
          claim.parts.erase(claim.parts.begin() + static_cast<std::ptrdiff_t>(k));
          return true;
        }},
       {"what is empty is seen",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.empty.empty() || claim.fragments.empty()) return false;
          const std::size_t k = any_of_first(claim.empty, bytes);
          Visible_certificate::Part part;
          part.fragment = any_of_first(claim.fragments, bytes);
          for (const Exact_point& ray : claim.empty[k]) {
            part.rays.push_back(static_cast<std::uint32_t>(claim.rays.size()));
            claim.rays.push_back(ray);
          }
          claim.parts.push_back(std::move(part));
          claim.empty.erase(claim.empty.begin() + static_cast<std::ptrdiff_t>(k));
          return true;
        }},
       {"one part, in a field",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.parts.empty()) return false;
          claim.field = rays_of(claim, claim.parts[any_of_first(claim.parts, bytes)]);
          claim.parts = {claim.parts[any_of_first(claim.parts, bytes)]};
          claim.empty.clear();
          return true;
        }},
       {"a part left out",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) { return remove_any(claim.parts, bytes); }},
       {"an empty cone left out",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) { return remove_any(claim.empty, bytes); }}});
  return all;
}

// ---- In what polygons see

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
        for (std::size_t k = 0; k < 3; ++k)
          at_p += flat.plane[k] * (p[k] - own[0][k]), at_q += flat.plane[k] * (q[k] - own[0][k]);
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

/// What is seen is hidden, by a proof at random: below the sides of edges of one fragment, it blocks everything; or
/// some leaf, or terms of lines above it.
template <bool always_blocked>
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
                    edges = std::min<std::size_t>(5, claim.fragments[blocker].vertices.size());
  for (std::size_t i = 0; i < edges; ++i) claim.lines.push_back({blocker, i});
  Weak_certificate::Hidden entry{seen.fragment, seen.source, {}};
  const auto grow = [&](const auto& self, std::size_t depth) -> void {
    Node node;
    if (depth < edges) {
      node.kind = Node::Kind::line, node.index = first + depth;
      entry.proof.push_back(node);
      self(self, depth + 1);
      return self(self, depth + 1);
    }
    const std::size_t kind = always_blocked ? 0 : bytes.below(4);
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
  using Kind = Claim::Node::Kind;
  static const std::vector<Lie<Claim>> all = with_lies_about_fragments<Claim>(
      {{"of the true source",
        [](Claim& claim, const Posed_scene& truth, Bytes&) {
          std::vector<Points> sources{truth.source};
          return std::exchange(claim.sources, sources) != sources;
        }},
       {"the source nudged",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) { return nudge_any(claim.sources[0], bytes); }},
       {"the source turned",
        [](Claim& claim, const Posed_scene&, Bytes&) {
          std::reverse(claim.sources[0].begin(), claim.sources[0].end());
          return true;
        }},
       {"two-sided",
        [](Claim& claim, const Posed_scene&, Bytes&) {
          claim.two_sided = !claim.two_sided;
          return true;
        }},
       {"proofs exchanged", [](Claim& claim, const Posed_scene&,
                               Bytes& bytes) { return exchange(claim.hidden, bytes, &Claim::Hidden::proof); }},
       {"fragments of sightlines exchanged",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          return exchange(claim.visible, bytes, &Claim::Sightline::fragment);
        }},
       {"lines exchanged", [](Claim& claim, const Posed_scene&,
                              Bytes& bytes) { return exchange(claim.lines, bytes, &Claim::Edge::corner); }},
       {"hidden by another's proof",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.visible.empty() || claim.hidden.empty()) return false;
          const std::size_t k = any_of_first(claim.visible, bytes);
          Claim::Hidden entry = claim.hidden[any_of_first(claim.hidden, bytes)];
          entry.fragment = claim.visible[k].fragment;
          claim.hidden.push_back(std::move(entry));
          claim.visible.erase(claim.visible.begin() + static_cast<std::ptrdiff_t>(k));
          return true;
        }},
       {"parts of a proof exchanged", exchange_parts_of_a_proof},
       {"lines of terms exchanged", [](Claim& claim, const Posed_scene&,
                                       Bytes& bytes) { return exchange_terms(claim, bytes, &Claim::Term::line); }},
       {"factors exchanged", [](Claim& claim, const Posed_scene&,
                                Bytes& bytes) { return exchange_terms(claim, bytes, &Claim::Term::factor); }},
       {"a term left out",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          const auto node = any_node(claim, bytes, [](const auto& one) { return one.terms.size() > 1; });
          return node && remove_any(node->terms, bytes);
        }},
       {"a cut nudged",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          const auto node = any_node(claim, bytes, is_a_cut);
          return node && nudge(node->plane, bytes);
        }},
       {"another leaf",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          const auto node = any_node(claim, bytes, [](const auto& one) { return one.kind >= Kind::blocked; });
          if (!node) return false;
          const Claim::Node old = *node;
          node->kind = bytes.below(2) == 0 ? Kind::away : Kind::blocked;
          node->index = any_of_first(claim.fragments, bytes);
          return old.kind != node->kind || (old.kind == Kind::blocked && old.index != node->index);
        }},
       {"hidden by one fragment", hide_at_random<true>},
       {"hidden by any leaves", hide_at_random<false>},
       {"an end on the boundary", move_an_end<To::boundary>},
       {"an end elsewhere", move_an_end<To::inside>},
       {"an end in another fragment", move_an_end<To::meeting>},
       {"a sightline left out",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) { return remove_any(claim.visible, bytes); }},
       {"a proof left out",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) { return remove_any(claim.hidden, bytes); }}});
  return all;
}

// ---- Any of them

/// A lie about what a certificate shows, or now and then two; its name, nothing where there is nothing to lie about.
template <class Claim>
std::string told_a_lie(const std::vector<Lie<Claim>>& lies, Claim& claim, const Posed_scene& scene, Bytes& bytes) {
  std::string name;
  for (std::size_t left = bytes.below(4) == 0 ? 2 : 1; left > 0; --left) {
    const Lie<Claim>& lie = lies[bytes.below(lies.size())];
    if (lie.tell(claim, scene, bytes)) name = name.empty() ? std::string(lie.name) : "several lies";
  }
  return name;
}

}  // namespace fuzz
