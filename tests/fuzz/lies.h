#pragma once
// Lies about what a right certificate shows, each by a name. Every one says whether it changed anything.

#include "certificate.h"
#include "cut_lies.h"
#include "retold.h"

#include <sightline/harness/generate/families.h>

#include <algorithm>
#include <numeric>
#include <optional>
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
  insert_fragment(claim, k + 1, fragment);
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
  std::vector<Weak_certificate::Hidden> entries;
  for (std::size_t i = 0; i < claim.hidden.size(); ++i)
    claim.hidden[i].for_each_fragment([&](std::size_t own) {
      if (own != k) return;
      entries.push_back({claim.fragments.size(), claim.hidden[i].source, claim.hidden[i].proof});
    });
  claim.hidden.insert(claim.hidden.end(), entries.begin(), entries.end());
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

/// A face that is set aside is drawn, as a fan of triangles: they may cover all that it winds around, as often.
template <class Claim>
bool draws_what_is_set_aside(Claim& claim, const Posed_scene& truth, Bytes& bytes) {
  if (claim.set_aside.empty() || claim.fragments.empty()) return false;
  const std::size_t k = any_of_first(claim.set_aside, bytes);
  const Face_id face = claim.set_aside[k].face;
  if (face >= truth.soup.face_count() || truth.soup.loop_count(face) != 1) return false;
  claim.set_aside.erase(claim.set_aside.begin() + static_cast<std::ptrdiff_t>(k));
  Points loop;
  for (const Point_id p : truth.soup.loop(face, 0)) loop.push_back(truth.soup.point(p));
  std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(bytes.below(loop.size())), loop.end());
  for (std::size_t i = 2; i < loop.size(); ++i) {
    const Points triangle{loop[0], loop[i - 1], loop[i]};
    if (!is_flat(triangle)) add_beside(claim, any_of_first(claim.fragments, bytes), {face, 0, triangle});
  }
  return true;
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
                           {"a set-aside face left out", drops_a_reason<Claim>},
                           {"a set-aside face drawn", draws_what_is_set_aside<Claim>}});
  return lies;
}

// ---- In an order

/// A lie that draws what it needs from a seed.
template <bool (*tell)(Order_certificate&, Mutator&)>
bool seeded(Order_certificate& claim, const Posed_scene&, Bytes& bytes) {
  Mutator random(bytes.word());
  if (!tell(claim, random)) return false;
  for (std::size_t left = random.below(3); left > 0; --left) retell_cuts(claim, random);
  return true;
}

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
          if (claim.fragments.empty()) return false;
          remove_fragment(claim, any_of_first(claim.fragments, bytes));
          return true;
        }},
       {"on-view, one twice",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.fragments.empty()) return false;
          claim.on_view = true;
          const std::size_t k = any_of_first(claim.fragments, bytes);
          const Order_fragment again = claim.fragments[k];
          add_beside(claim, k, again);
          return true;
        }},
       {"neighbours swapped", swap_neighbours<Claim>},
       {"exchanged across a cut", seeded<exchanged_across_a_cut>},
       {"exchanged with their depths", seeded<exchanged_with_depths>},
       {"a node's sides exchanged", seeded<sides_exchanged>},
       {"from near to far", seeded<from_near_to_far>},
       {"one drawn elsewhere", [](Claim& claim, const Posed_scene&, Bytes& bytes) {
          if (claim.fragments.size() < 2) return false;
          const std::size_t from = any_of_first(claim.fragments, bytes), to = any_of_first(claim.fragments, bytes);
          const Order_fragment moved = claim.fragments[from];
          if (bytes.below(2) == 0) {  // past what is said of cuts, or with it
            claim.fragments.erase(claim.fragments.begin() + static_cast<std::ptrdiff_t>(from));
            claim.fragments.insert(claim.fragments.begin() + static_cast<std::ptrdiff_t>(to), moved);
          } else {
            remove_fragment(claim, from);
            insert_fragment(claim, to, moved);
          }
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

enum class Joint { one_way, touching, none };

/// Two components are one, with all arcs that there are from the members of one to those of the other, and none back;
/// or with arcs both ways by corners that may be in the other's plane. Either of them comes first. Or they are two,
/// with one such arc between them.
template <Joint joint>
bool has_arcs_between(Graph_certificate& claim, const Posed_scene&, Bytes& bytes) {
  using Arc = Graph_certificate::Arc;
  if (claim.sizes.size() < 2) return false;
  const std::vector<Flat> fragments = flats(claim);
  const auto corner_on = [&](std::size_t of, int side, std::size_t plane) -> std::optional<std::size_t> {
    for (const int least : {side, joint == Joint::touching ? 0 : side})
      for (std::size_t k = 0; k < fragments[of].corners.size(); ++k)
        if (fragments[plane].side(fragments[of].corners[k]) == least) return k;
    return std::nullopt;
  };
  const std::size_t joints = std::min<std::size_t>(256, claim.sizes.size() - 1), start = bytes.below(joints);
  for (std::size_t tried = 0; tried < joints; ++tried) {
    // 1. Arcs between two that follow each other.
    const std::size_t c = (start + tried) % joints;
    const auto at = claim.sizes.begin() + static_cast<std::ptrdiff_t>(c);
    const std::size_t first = std::accumulate(claim.sizes.begin(), at, std::size_t{0}), middle = first + *at,
                      end = middle + *(at + 1);
    if (end > fragments.size()) return false;  // another lie has left some out
    std::vector<Arc> between;
    const auto add = [&](std::size_t i, std::size_t j) {
      if (const auto front = corner_on(i, 1, j), behind = corner_on(j, -1, i); front && behind)
        between.push_back({i, j, *front, *behind});
    };
    for (std::size_t i = first; i < middle; ++i)
      for (std::size_t j = middle; j < end; ++j) {
        add(i, j);
        if (joint == Joint::touching) add(j, i);
      }
    if (between.empty()) continue;
    if (joint == Joint::none) {
      claim.arcs.push_back(between[any_of_first(between, bytes)]);
      return true;
    }
    // 2. As one, perhaps the other one first.
    *at += *(at + 1);
    claim.sizes.erase(at + 1);
    claim.arcs.insert(claim.arcs.end(), between.begin(), between.end());
    if (bytes.below(2) == 0) return true;
    const auto begin = claim.fragments.begin();
    std::rotate(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
                begin + static_cast<std::ptrdiff_t>(end));
    for (Arc& arc : claim.arcs)
      for (std::size_t* place : {&arc.from, &arc.to})
        if (first <= *place && *place < end)
          *place = *place < middle ? *place + (end - middle) : *place - (middle - first);
    return true;
  }
  return false;
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
       {"components joined one way", has_arcs_between<Joint::one_way>},
       {"components joined where they touch", has_arcs_between<Joint::touching>},
       {"an arc between components", has_arcs_between<Joint::none>},
       {"a fragment cut", cuts_a_fragment},
       {"neighbours swapped", swap_neighbours<Claim>},
       {"arcs exchanged", [](Claim& claim, const Posed_scene&,
                             Bytes& bytes) { return exchange(claim.arcs, bytes, &Graph_certificate::Arc::to); }},
       {"an arc left out",
        [](Claim& claim, const Posed_scene&, Bytes& bytes) { return remove_any(claim.arcs, bytes); }}});
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
