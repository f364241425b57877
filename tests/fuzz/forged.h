#pragma once
// Certificates forged by meaning, on scenes of all families: the right certificate of another scene, or about something
// else, shown as one of the scene at hand. What a checker accepts nevertheless has to be true: where brute force tries
// it (claims.h), and by what the engines answer.

#include "certificate.h"
#include "claims.h"
#include "mutate.h"
#include "retold.h"

#include <sightline/algorithms/weak_visibility/along/certificate.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/scene/set_aside.h>
#include <sightline/sightline.h>

#include <algorithm>
#include <map>

namespace fuzz {

using generate::Posed_scene;

enum class Kind { order, graph, see, weak, along };

/// What the forger asks the engines, and which face of the true scene each face there is, or is a part of.
struct Pretence {
  Posed_scene scene;
  std::vector<Face_id> face_of;
  std::vector<Covering::Set_aside> left_out;  ///< faces of the true scene that are not there, and what is said of it
  bool is_true = false;                       ///< it is the true scene
};

inline Asking in_one_thread() { return {1, {}}; }

// ---- Other scenes

inline Pretence as_it_is(const Posed_scene& truth) {
  Pretence pretence{truth, {}, {}};
  for (Face_id f = 0; f < truth.soup.face_count(); ++f) pretence.face_of.push_back(f);
  return pretence;
}

inline std::vector<Face_id> all_but(const Polygon_soup& soup, Face_id left_out) {
  std::vector<Face_id> order;
  for (Face_id f = 0; f < soup.face_count(); ++f)
    if (f != left_out) order.push_back(f);
  return order;
}

/// One face set aside, with each reason there is.
inline Pretence without_a_face(const Posed_scene& truth, Bytes& bytes) {
  const Face_id gone = static_cast<Face_id>(bytes.below(truth.soup.face_count()));
  const auto reason = set_aside_texts[bytes.below(set_aside_texts.size())];
  const std::string of =
      reason == text_of(Set_aside_reason::duplicate) ? std::to_string(bytes.below(truth.soup.face_count())) : "";
  Pretence pretence{truth, all_but(truth.soup, gone), {{gone, std::string(reason) + of}}};
  pretence.scene.soup = generate::with_faces(truth.soup, pretence.face_of);
  return pretence;
}

/// A face of one loop, one that is not planar if there is such, as the triangles from one of its corners, whichever
/// surface that is.
inline Pretence triangulated_otherwise(const Posed_scene& truth, Bytes& bytes) {
  const std::vector<Face_id> skew = Scene(truth.soup).non_planar();
  const Face_id chosen =
      skew.empty() ? static_cast<Face_id>(bytes.below(truth.soup.face_count())) : skew[bytes.below(skew.size())];
  const auto loop = truth.soup.loop(chosen);
  if (truth.soup.loop_count(chosen) > 1 || loop.size() < 4) return as_it_is(truth);
  Pretence pretence{truth, all_but(truth.soup, chosen), {}};
  pretence.scene.soup = generate::with_faces(truth.soup, pretence.face_of);
  const std::size_t apex = bytes.below(loop.size());
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    pretence.scene.soup.add_face({loop[apex], loop[(apex + i) % loop.size()], loop[(apex + i + 1) % loop.size()]});
    pretence.face_of.push_back(chosen);
  }
  return pretence;
}

/// A convex face cut in two.
inline Pretence cut(const Posed_scene& truth, Bytes& bytes) {
  generate::Random random(bytes.byte());
  const std::optional<harness::Image> image = harness::cut(truth, random);
  if (!image) return as_it_is(truth);
  Pretence pretence{image->scene, {}, {}};
  for (const std::optional<Face_id>& face : image->face_of) pretence.face_of.push_back(*face);
  return pretence;
}

/// A coordinate of one point, of the eye or of the source is an ulp or so elsewhere.
inline Pretence nudged(const Posed_scene& truth, Bytes& bytes) {
  Pretence pretence = as_it_is(truth);
  const std::size_t axis = bytes.below(3), which = bytes.below(4);
  Rational step = generate::power_of_two(-static_cast<int>(bytes.below(100)));
  if (bytes.below(2) == 0) step = -step;
  if (which == 0) {
    pretence.scene.eye[axis] += step;
  } else if (which == 1 && !truth.source.empty()) {
    for (Exact_point& p : pretence.scene.source) p[axis] += step;
  } else {
    const Point_id chosen = static_cast<Point_id>(bytes.below(std::min<std::size_t>(256, truth.soup.point_count())));
    pretence.scene.soup = generate::mapped(truth.soup, [&](Point_id i, Exact_point p) {
      if (i == chosen) p[axis] += step;
      return p;
    });
  }
  return pretence;
}

/// One face, or the source, the other way round.
inline Pretence turned(const Posed_scene& truth, Bytes& bytes) {
  Pretence pretence = as_it_is(truth);
  if (bytes.below(3) == 0) {
    std::reverse(pretence.scene.source.begin(), pretence.scene.source.end());
    return pretence;
  }
  const Face_id chosen = static_cast<Face_id>(bytes.below(truth.soup.face_count()));
  pretence.face_of = all_but(truth.soup, chosen);
  Polygon_soup rest = generate::with_faces(truth.soup, pretence.face_of);
  const Polygon_soup one = generate::with_faces(truth.soup, {chosen}, true);
  rest.add_face(one.loop(0));
  for (std::size_t k = 1; k < one.loop_count(0); ++k) rest.add_hole(one.loop(0, k));
  pretence.face_of.push_back(chosen);
  pretence.scene.soup = std::move(rest);
  return pretence;
}

inline Pretence pretence_of(const Posed_scene& truth, Bytes& bytes) {
  switch (bytes.below(8)) {
    case 0:
    case 1: return without_a_face(truth, bytes);
    case 2:
    case 3: return triangulated_otherwise(truth, bytes);
    case 4: return cut(truth, bytes);
    case 5: return nudged(truth, bytes);
    case 6: return turned(truth, bytes);
    default: {
      Pretence pretence = as_it_is(truth);
      pretence.is_true = true;
      return pretence;
    }
  }
}

// ---- Their certificates

/// Where a path from the eye goes: past a point, or past the source's middle.
inline Exact_point path_end(const Posed_scene& scene) {
  const Points corners = scene.source.size() > 1 ? scene.source : Points{scene.soup.point(0), scene.soup.point(0)};
  const Exact_point middle_of_two = middle(corners[0], corners[1]);
  Exact_point end;
  for (std::size_t k = 0; k < 3; ++k) end[k] = (3 * middle_of_two[k] - scene.eye[k]) / 2;
  return end;
}

/// What an engine says, as a certificate; nothing where it is asked what cannot be.
inline std::optional<Certificate> answered(Kind kind, const Posed_scene& scene) {
  const Model model(scene.soup);
  std::string text;
  switch (kind) {
    case Kind::order: text = order(model, scene.eye, in_one_thread()).certificate(); break;
    case Kind::graph: text = priority_graph(model, in_one_thread()).certificate(); break;
    case Kind::see: text = see(model, scene.eye, in_one_thread()).certificate(); break;
    case Kind::weak: try { text = weakly_visible(model, {scene.source}, in_one_thread()).certificate();
      } catch (const std::invalid_argument&) {  // moved, the source is no convex polygon
        return std::nullopt;
      }
      break;
    case Kind::along: {
      const Scene own(scene.soup);
      const Exact_point to = path_end(scene);
      if (scene.eye == to) return std::nullopt;
      const Occluders occluders(own);
      Along_options options;
      options.threads = 1;
      options.with_proofs = true;
      return along_certificate(own, visible_along(occluders, scene.eye, to, options), scene.eye, to, false);
    }
  }
  return certificate_in(text);
}

/// The claim in the faces of the true scene. Parts of one face are its pieces; with `silent`, unless it needs to have
/// such, only its fragments.
inline void translate(Covering& claim, const Pretence& pretence, bool silent) {
  std::map<Face_id, std::uint32_t> parts;
  std::vector<std::uint32_t> part(pretence.face_of.size());
  for (std::size_t k = 0; k < part.size(); ++k) part[k] = parts[pretence.face_of[k]]++;
  for (Order_fragment& fragment : claim.fragments) {
    const Face_id own = fragment.face;
    fragment.face = pretence.face_of[own];
    if (parts[fragment.face] < 2) continue;
    fragment.piece = part[own];
    if (!silent) claim.pieces.push_back({fragment.face, fragment.piece, fragment.vertices});
  }
  for (Covering::Piece& piece : claim.pieces)
    if (piece.face < part.size() && parts[pretence.face_of[piece.face]] < 2) piece.face = pretence.face_of[piece.face];
  const std::string_view duplicate = text_of(Set_aside_reason::duplicate);
  for (Covering::Set_aside& entry : claim.set_aside) {
    entry.face = pretence.face_of[entry.face];
    if (entry.why.starts_with(duplicate))
      entry.why =
          std::string(duplicate) + std::to_string(pretence.face_of[std::stoul(entry.why.substr(duplicate.size()))]);
  }
  claim.set_aside.insert(claim.set_aside.end(), pretence.left_out.begin(), pretence.left_out.end());
}

// ---- Lies about what is shown

template <class Entries>
void exchange(Entries& entries, Bytes& bytes, auto member) {
  if (entries.size() < 2) return;
  const std::size_t i = bytes.below(std::min<std::size_t>(256, entries.size())),
                    j = bytes.below(std::min<std::size_t>(256, entries.size()));
  std::swap(entries[i].*member, entries[j].*member);
}

/// One that there is, if there is one.
template <class Entries>
std::size_t any_of_first(const Entries& entries, Bytes& bytes) {
  return bytes.below(std::min<std::size_t>(256, entries.size()));
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

/// Fragments that are none, as polygons: clockwise, with a corner twice or a spike, without area; or the same one again
/// and once clockwise, so that boundaries cancel.
template <class Claim>
void lie_about_fragments(Claim& claim, Bytes& bytes) {
  if (claim.fragments.empty()) return;
  const std::size_t k = any_of_first(claim.fragments, bytes);
  Order_fragment fragment = claim.fragments[k];
  Points &loop = claim.fragments[k].vertices, &other = fragment.vertices;
  const std::size_t corner = bytes.below(loop.size());
  const Exact_point p = loop[corner], q = loop[(corner + 1) % loop.size()];
  const auto at = loop.begin() + static_cast<std::ptrdiff_t>(corner);
  switch (bytes.below(5)) {
    case 0: std::reverse(loop.begin(), loop.end()); break;
    case 1: loop.insert(at, p); break;
    case 2: loop.insert(at + 1, {middle(p, middle(loop[0], loop[2])), p}); break;
    case 3:
      other = {p, middle(p, q), q};
      if (bytes.below(2) == 0) other.push_back(other[1]);
      add_beside(claim, k, fragment);
      break;
    default:
      add_beside(claim, k, fragment);
      std::reverse(other.begin(), other.end());
      add_beside(claim, k, fragment);
  }
}

inline void lie(Order_certificate& claim, const Posed_scene& truth, Bytes& bytes) {
  switch (bytes.below(4)) {
    case 0: claim.eye = truth.eye; break;
    case 1: claim.on_view = !claim.on_view; break;
    case 2:
      if (claim.fragments.size() > 1) {
        const std::size_t k = bytes.below(std::min<std::size_t>(256, claim.fragments.size() - 1));
        std::swap(claim.fragments[k], claim.fragments[k + 1]);
      }
      break;
    default: exchange(claim.fragments, bytes, &Order_fragment::face);
  }
}
inline void lie(Graph_certificate& claim, const Posed_scene&, Bytes& bytes) {
  if (claim.sizes.empty()) return;
  const std::size_t c = bytes.below(std::min<std::size_t>(256, claim.sizes.size()));
  switch (bytes.below(4)) {
    case 0:
      if (claim.sizes[c] > 1) {
        --claim.sizes[c];
        claim.sizes.insert(claim.sizes.begin() + static_cast<std::ptrdiff_t>(c), 1);
        std::erase_if(claim.arcs, [&](const auto&) { return bytes.below(2) == 0; });
      }
      break;
    case 1:
      if (c + 1 < claim.sizes.size()) {
        claim.sizes[c] += claim.sizes[c + 1];
        claim.sizes.erase(claim.sizes.begin() + static_cast<std::ptrdiff_t>(c) + 1);
      }
      break;
    case 2:
      if (claim.fragments.size() > 1) {
        const std::size_t k = bytes.below(std::min<std::size_t>(256, claim.fragments.size() - 1));
        std::swap(claim.fragments[k], claim.fragments[k + 1]);
      }
      break;
    default: exchange(claim.arcs, bytes, &Graph_certificate::Arc::to);
  }
}
inline void lie(Visible_certificate& claim, const Posed_scene& truth, Bytes& bytes) {
  switch (bytes.below(4)) {
    case 0: claim.eye = truth.eye; break;
    case 1: exchange(claim.parts, bytes, &Visible_certificate::Part::fragment); break;
    case 2:
      if (!claim.parts.empty()) {  // what is seen there is called empty
        const std::size_t k = bytes.below(std::min<std::size_t>(256, claim.parts.size()));
        claim.empty.push_back(rays_of(claim, claim.parts[k]));
        claim.parts.erase(claim.parts.begin() + static_cast<std::ptrdiff_t>(k));
      }
      break;
    default:
      if (!claim.empty.empty())
        claim.empty.erase(claim.empty.begin() + static_cast<std::ptrdiff_t>(bytes.below(claim.empty.size())));
  }
}
/// A sightline's end moved: to where another fragment meets the plane that it is in, to the boundary of what it is in,
/// or anywhere inside.
inline void move_an_end(Weak_certificate& claim, Bytes& bytes) {
  if (claim.visible.empty()) return;
  Weak_certificate::Sightline& sightline = claim.visible[any_of_first(claim.visible, bytes)];
  const bool begins = bytes.below(2) == 0;
  const Points& own = begins ? claim.sources[sightline.source] : claim.fragments[sightline.fragment].vertices;
  const Flat flat(own);
  Points ends;
  switch (bytes.below(6)) {
    case 0:
      ends = own;
      ends.push_back(middle(own[0], own[1]));
      break;
    case 1:
      for (const Place& p : mixtures(flat.corners))
        ends.push_back({Rational(p[0]) / p[3], Rational(p[1]) / p[3], Rational(p[2]) / p[3]});
      break;
    default:
      for (const Order_fragment& fragment : claim.fragments)
        for (std::size_t i = 0; i < fragment.vertices.size(); ++i) {
          const Exact_point &p = fragment.vertices[i], &q = fragment.vertices[(i + 1) % fragment.vertices.size()];
          Rational from = 0, to = 0;  // heights over the plane
          for (std::size_t k = 0; k < 3; ++k)
            from += flat.plane[k] * (p[k] - own[0][k]), to += flat.plane[k] * (q[k] - own[0][k]);
          if (sgn(from) * sgn(to) > 0) continue;
          Exact_point end = middle(p, q);
          for (std::size_t k = 0; k < 3 && from != to; ++k) end[k] = p[k] + from / (from - to) * (q[k] - p[k]);
          if (flat.location(place(end)) > 0) ends.push_back(end);
        }
  }
  if (!ends.empty()) (begins ? sightline.from : sightline.to) = ends[any_of_first(ends, bytes)];
}

/// What is seen is hidden, by a proof at random: below the sides of edges of one fragment, it blocks everything; or
/// some leaf, or terms of lines above it.
inline void hide_at_random(Weak_certificate& claim, Bytes& bytes) {
  using Node = Weak_certificate::Node;
  if (claim.visible.empty()) return;
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
  const bool always_blocked = bytes.below(2) == 0;
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
}

/// A proof with the parts of a node exchanged, or the lines or factors of two terms.
inline void lie_in_a_proof(Weak_certificate& claim, Bytes& bytes) {
  using Node = Weak_certificate::Node;
  if (claim.hidden.empty()) return;
  std::vector<Node>& proof = claim.hidden[any_of_first(claim.hidden, bytes)].proof;
  std::vector<std::size_t> inner, leaves;
  const auto is_inner = [&](std::size_t i) { return proof[i].kind <= Node::Kind::cut_target; };
  for (std::size_t i = 0; i < proof.size(); ++i)
    if (is_inner(i)) inner.push_back(i);
    else if (proof[i].terms.size() > 1) leaves.push_back(i);
  const std::size_t lie = bytes.below(3);
  if (lie == 0 && !inner.empty()) {
    const auto end_of = [&](std::size_t i) {
      for (std::size_t open = 1; open > 0; ++i) open += is_inner(i) ? 1 : -1;
      return proof.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const std::size_t first = inner[any_of_first(inner, bytes)] + 1;
    const auto second = end_of(first);
    const auto end = end_of(static_cast<std::size_t>(second - proof.begin()));
    std::rotate(proof.begin() + static_cast<std::ptrdiff_t>(first), second, end);
  } else if (lie != 0 && !leaves.empty()) {
    auto& terms = proof[leaves[any_of_first(leaves, bytes)]].terms;
    if (lie == 1) exchange(terms, bytes, &Weak_certificate::Term::line);
    else exchange(terms, bytes, &Weak_certificate::Term::factor);
  }
}

inline void lie(Weak_certificate& claim, const Posed_scene& truth, Bytes& bytes) {
  switch (bytes.below(16)) {
    case 0: claim.sources = {truth.source}; break;
    case 1: claim.two_sided = !claim.two_sided; break;
    case 2: exchange(claim.hidden, bytes, &Weak_certificate::Hidden::proof); break;
    case 3: exchange(claim.visible, bytes, &Weak_certificate::Sightline::fragment); break;
    case 4: exchange(claim.lines, bytes, &Weak_certificate::Edge::corner); break;
    case 5:
      if (!claim.visible.empty() && !claim.hidden.empty()) {  // what is seen is hidden, by the proof of another
        const std::size_t k = any_of_first(claim.visible, bytes);
        Weak_certificate::Hidden entry = claim.hidden[any_of_first(claim.hidden, bytes)];
        entry.fragment = claim.visible[k].fragment;
        claim.hidden.push_back(std::move(entry));
        claim.visible.erase(claim.visible.begin() + static_cast<std::ptrdiff_t>(k));
      }
      break;
    case 6:
    case 7: lie_in_a_proof(claim, bytes); break;
    case 8:
    case 9: hide_at_random(claim, bytes); break;
    default: move_an_end(claim, bytes);
  }
}

/// One face is said to be seen, or not to be, at a moment or between two; its proofs beside that go on there, or one
/// more is made of another's.
inline void lie_about_a_while(Along_certificate& claim, Bytes& bytes) {
  using Range = Along_certificate::Range;
  if (claim.fragments.empty() || claim.proofs.empty()) return;
  const std::size_t fragment = any_of_first(claim.fragments, bytes), last = claim.moments.size() - 1;
  const Face_id face = claim.fragments[fragment].face;
  const std::size_t low = bytes.below(std::min<std::size_t>(256, last)), high = low + bytes.below(2);
  const bool is_seen = said_to_be_seen(claim, {low, high}).contains(face);
  std::vector<Range> seen;  // by places
  for (std::size_t k = 0; k <= last; ++k)
    for (const Range& place : {Range{k, k}, Range{k, k + 1}})
      if (place.high <= last &&
          said_to_be_seen(claim, place).contains(face) != (place.low == low && place.high == high))
        seen.push_back(place);
  std::erase_if(claim.faces, [&](const auto& of) { return of.face == face; });
  claim.faces.push_back({face, std::move(seen)});
  const std::size_t way = bytes.below(3);
  for (Along_certificate::Proof& proof : claim.proofs)
    if (way > 0 && proof.cone.empty() == is_seen && claim.fragments[proof.fragment].face == face &&
        proof.range.low <= high && low <= proof.range.high) {
      proof.range = {std::min(proof.range.low, low), std::max(proof.range.high, high)};
      if (way == 2) proof.range = {std::max<std::size_t>(proof.range.low, 1) - 1, std::min(proof.range.high + 1, last)};
    }
  if (bytes.below(3) == 0) {
    Along_certificate::Proof proof = claim.proofs[any_of_first(claim.proofs, bytes)];
    proof.fragment = fragment;
    proof.range = {low, high};
    claim.proofs.push_back(std::move(proof));
  }
}

inline void lie(Along_certificate& claim, const Posed_scene& truth, Bytes& bytes) {
  using Proof = Along_certificate::Proof;
  switch (bytes.below(12)) {
    case 0: claim.from = truth.eye; break;
    case 1: claim.two_sided = !claim.two_sided; break;
    case 2: exchange(claim.proofs, bytes, &Proof::cone); break;
    case 3: exchange(claim.proofs, bytes, &Proof::tree); break;
    case 4: exchange(claim.proofs, bytes, &Proof::range); break;
    case 5: exchange(claim.faces, bytes, &Along_certificate::Face::seen); break;
    case 6:
    case 7:
      if (!claim.proofs.empty()) {  // a side, or what blocks, exchanged with another of the proof
        Proof& proof = claim.proofs[any_of_first(claim.proofs, bytes)];
        if (bytes.below(2) == 0) exchange(proof.tree, bytes, &Along_certificate::Node::blocked);
        else exchange(proof.tree, bytes, &Along_certificate::Node::cut);
        if (!proof.cone.empty()) proof.cone[any_of_first(proof.cone, bytes)].sign *= -1;
      }
      break;
    default: lie_about_a_while(claim, bytes);
  }
}

// ---- What is true

inline Known_scene known(const Polygon_soup& soup) {
  const Scene scene(soup);
  Known_scene all{soup, std::vector<std::vector<Flat>>(soup.face_count()), std::vector<bool>(soup.face_count()),
                  std::vector<bool>(soup.face_count())};
  for (const Piece& piece : scene.pieces()) {
    Points corners;
    for (const Piece_corner& corner : scene.corners(piece)) corners.push_back(scene.position(corner.point));
    all.parts[piece.face].emplace_back(std::move(corners));
  }
  for (const sightline::Set_aside& entry : scene.set_aside()) {
    all.set_aside[entry.face] = true;
    if (entry.reason != Set_aside_reason::duplicate) continue;
    all.duplicate[entry.face] = true;
    all.parts[entry.face] = all.parts[std::stoul(entry.why.substr(text_of(entry.reason).size()))];
  }
  return all;
}

using Face_set = std::set<Face_id>;

inline void compare_with_engine(const Polygon_soup&, const Order_certificate&) {}  // brute force tries all of it
inline void compare_with_engine(const Polygon_soup& soup, const Graph_certificate& claim) {
  const Model model(soup);
  if (model.parts().size() != claim.fragments.size()) return;  // a concave face cut otherwise has other components
  const auto partition_of = [](auto&& component_of, const auto& parts) {
    std::map<std::size_t, std::multiset<Face_id>> by_component;
    for (std::size_t i = 0; i < parts.size(); ++i) by_component[component_of(i)].insert(parts[i].face);
    std::multiset<std::multiset<Face_id>> partition;
    for (const auto& [component, faces] : by_component) partition.insert(faces);
    return partition;
  };
  for (std::size_t i = 0; i < model.parts().size(); ++i)
    if (model.parts()[i].piece != 0) return;
  std::vector<std::size_t> claimed, found(model.parts().size());
  for (std::size_t c = 0; c < claim.sizes.size(); ++c) claimed.insert(claimed.end(), claim.sizes[c], c);
  const Priority answer = priority_graph(model, in_one_thread());
  for (std::size_t c = 0; c < answer.components.size(); ++c)
    for (const std::uint32_t part : answer.components[c]) found[part] = c;
  require(partition_of([&](std::size_t i) { return claimed[i]; }, claim.fragments) ==
              partition_of([&](std::size_t i) { return found[i]; }, model.parts()),
          "accepted components are those that the engine finds");
}
inline void compare_with_engine(const Polygon_soup& soup, const Visible_certificate& claim) {
  if (!claim.field.empty()) return;
  const std::vector<Flat> fragments = flats(claim);
  Face_set front, back;
  for (const Visible_certificate::Part& part : claim.parts)
    (fragments[part.fragment].side(place(claim.eye)) > 0 ? front : back).insert(claim.fragments[part.fragment].face);
  const Seen found = see(Model(soup), claim.eye, in_one_thread());
  Face_set found_front, found_back;  // of the parts, as of faces in one plane one has the part
  for (const Seen::Visible_part& part : found.parts) (part.from_front ? found_front : found_back).insert(part.face);
  require(front == found_front && back == found_back, "accepted parts are of the faces that the engine sees");
}
inline void compare_with_engine(const Polygon_soup& soup, const Along_certificate& claim) {
  const Model model(soup);
  for (const auto& [t, then] : times_of(claim)) {
    const Seen found = see(model, eye_at(claim, t), in_one_thread());
    Face_set faces(found.visible.begin(), found.visible.end());
    if (claim.two_sided) faces.insert(found.from_behind.begin(), found.from_behind.end());
    require(faces == said_to_be_seen(claim, then), "what is accepted of a moment is what the eye sees then");
  }
}
inline void compare_with_engine(const Polygon_soup& soup, const Weak_certificate& claim) {
  if (claim.two_sided) return;
  Face_set visible, undecided(claim.undecided.begin(), claim.undecided.end());
  for (const Weak_certificate::Sightline& entry : claim.visible) visible.insert(claim.fragments[entry.fragment].face);
  const Weak_visibility found = weakly_visible(Model(soup), claim.sources, in_one_thread());
  for (const Face_id face : found.visible)
    require(visible.count(face) + undecided.count(face) > 0, "what the engine sees is not hidden");
  for (const Face_id face : found.hidden) require(visible.count(face) == 0, "what is hidden to the engine is not seen");
}

// ---- One forgery

/// What became of the certificates that bytes stand for.
struct Judged {
  std::size_t accepted = 0, rejected = 0;
};

/// Shows certificates of another scene, the right one and some that lie about what is shown, as those of the first:
/// what passes is true. Nothing where the bytes say nothing.
inline Judged judged_forgeries(std::string_view text) {
  constexpr std::size_t forgeries = 24, bytes_of_lies = 48, tellings = 6;
  Bytes bytes(text);
  // 1. The scene as it is.
  const std::vector<generate::Family>& families = generate::families();
  const generate::Family& family =  // often the one with faces of all kinds
      bytes.below(3) == 0 ? generate::family("tangle") : families[bytes.below(families.size())];
  generate::Family_parameters parameters;
  parameters.seed = bytes.word() % 100000;
  parameters.size = family.small_size;
  const std::int64_t distances[] = {0, 0, 1, -1, 2, generate::far_ulps};
  parameters.ulps = distances[bytes.below(6)];
  Posed_scene truth = family.make(parameters);
  if (truth.soup.point_count() > 0 && bytes.below(2) == 0) {  // a point elsewhere bends its faces
    const Point_id bent = static_cast<Point_id>(bytes.byte() % truth.soup.point_count());
    const std::size_t axis = bytes.below(3);
    truth.soup = generate::mapped(truth.soup, [&](Point_id i, Exact_point p) {
      if (i == bent) p[axis] += 1;
      return p;
    });
  }
  if (truth.soup.face_count() == 0 || truth.soup.face_count() > 16) return {};
  const std::size_t drawn = bytes.below(8);  // where there is a source, often from it: much of that is proofs
  const Kind kind = drawn < 5              ? static_cast<Kind>(drawn)
                    : truth.source.empty() ? static_cast<Kind>(drawn % 3)
                                           : Kind::weak;
  if (kind == Kind::weak && truth.source.empty()) return {};

  // 2. What the forger has.
  const Pretence pretence = pretence_of(truth, bytes);
  std::optional<Certificate> answer = answered(kind, pretence.scene);
  if (!answer) return {};
  const bool silent = bytes.below(4) == 0;
  Mutator lies(bytes.word());
  std::optional<Known_scene> scene;
  return std::visit(
      [&](auto& right) {
        translate(right, pretence, silent);
        if constexpr (std::is_same_v<std::decay_t<decltype(right)>, Weak_certificate>)
          for (Face_id& face : right.undecided) face = pretence.face_of[face];
        if constexpr (std::is_same_v<std::decay_t<decltype(right)>, Along_certificate>)
          for (Along_certificate::Face& of : right.faces) of.face = pretence.face_of[of.face];
        Judged judged;
        for (std::size_t k = 0; k < forgeries; ++k) {
          // 3. What is shown: the right one first.
          auto claim = right;
          const std::string words = lies.random_bytes(bytes_of_lies);
          Bytes told(words);
          for (std::size_t left = k == 0 ? 0 : 1 + told.below(2); left > 0; --left) {
            if (told.below(4) == 0) lie_about_fragments(claim, told);
            else lie(claim, truth, told);
          }

          // 4. Whether it passes; then it is true, and the right one passes however it is told.
          if (const Verdict verdict = verdict_on(truth.soup, claim); !verdict.accepted) {
            if (k == 0 && pretence.is_true) throw Finding("a right certificate is rejected: " + verdict.why);
            ++judged.rejected;
            continue;
          }
          ++judged.accepted;
          for (std::size_t t = 0; k == 0 && t < tellings; ++t) {
            auto retold = claim;
            for (std::size_t left = 1 + t % 3; left > 0; --left) retell(retold, lies);
            if (const Verdict verdict = verdict_on(truth.soup, retold); !verdict.accepted)
              throw Finding("what is accepted is rejected when it is told otherwise: " + verdict.why);
          }
          if (!scene) scene = known(truth.soup);
          try_claims(*scene, claim);
          compare_with_engine(truth.soup, claim);
        }
        return judged;
      },
      *answer);
}

/// How many certificates `forged` has shown to the checkers.
inline std::size_t certificates_shown = 0;

inline void forged(std::string_view bytes) {
  const Judged judged = judged_forgeries(bytes);
  certificates_shown += judged.accepted + judged.rejected;
}

}  // namespace fuzz
