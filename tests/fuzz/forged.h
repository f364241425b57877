#pragma once
// Certificates forged by meaning, on scenes of all families: the right certificate of another scene, or about something
// else, shown as one of the scene at hand. What a checker accepts nevertheless has to be true: where brute force tries
// it (claims.h), and by what the engines answer.

#include "certificate.h"
#include "claims.h"
#include "mutate.h"

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

enum class Kind { order, graph, see, weak };

/// What the forger asks the engines, and which face of the true scene each face there is, or is a part of.
struct Pretence {
  Posed_scene scene;
  std::vector<Face_id> face_of;
  std::vector<Covering::Set_aside> left_out;  ///< faces of the true scene that are not there, and what is said of it
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
    default: return as_it_is(truth);
  }
}

// ---- Their certificates

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
inline void lie(Weak_certificate& claim, const Posed_scene& truth, Bytes& bytes) {
  switch (bytes.below(6)) {
    case 0: claim.sources = {truth.source}; break;
    case 1: claim.two_sided = !claim.two_sided; break;
    case 2: exchange(claim.hidden, bytes, &Weak_certificate::Hidden::proof); break;
    case 3: exchange(claim.visible, bytes, &Weak_certificate::Sightline::fragment); break;
    case 4: exchange(claim.lines, bytes, &Weak_certificate::Edge::corner); break;
    default:
      if (!claim.visible.empty() && !claim.hidden.empty()) {  // what is seen is hidden, by the proof of another
        const std::size_t k = bytes.below(std::min<std::size_t>(256, claim.visible.size()));
        Weak_certificate::Hidden entry = claim.hidden[bytes.below(std::min<std::size_t>(256, claim.hidden.size()))];
        entry.fragment = claim.visible[k].fragment;
        claim.hidden.push_back(std::move(entry));
        claim.visible.erase(claim.visible.begin() + static_cast<std::ptrdiff_t>(k));
      }
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
  constexpr std::size_t forgeries = 24, bytes_of_lies = 24;
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
  const Kind kind = static_cast<Kind>(bytes.below(4));
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
        Judged judged;
        for (std::size_t k = 0; k < forgeries; ++k) {
          // 3. What is shown: the right one first.
          auto claim = right;
          const std::string words = lies.random_bytes(bytes_of_lies);
          Bytes told(words);
          for (std::size_t left = k == 0 ? 0 : 1 + told.below(2); left > 0; --left) lie(claim, truth, told);

          // 4. Whether it passes; then it is true.
          if (!verdict_on(truth.soup, claim).accepted) {
            ++judged.rejected;
            continue;
          }
          ++judged.accepted;
          if (!scene) scene = known(truth.soup);
          try_claims(*scene, claim);
          compare_with_engine(truth.soup, claim);
        }
        return judged;
      },
      *answer);
}

inline void forged(std::string_view bytes) { judged_forgeries(bytes); }

}  // namespace fuzz
