#pragma once
// What a forger has: the right certificate of another scene, told as one of the scene at hand.

#include "certificate.h"
#include "cut_lies.h"
#include "truth.h"

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

enum class Kind { order, graph, see, along, weak };
inline constexpr std::array<const char*, 5> kind_names{"order", "graph", "see", "along", "weak"};

/// What the forger asks the engines, and which face of the true scene each face there is, or is a part of.
struct Pretence {
  Posed_scene scene;
  std::vector<Face_id> face_of;
  std::string name = as_it_was;
  std::vector<Covering::Set_aside> left_out = {};  ///< faces of the true scene that are not there: what is said of it
  std::vector<Part> passed_over = {};              ///< parts of such a face that are drawn nevertheless

  static constexpr const char* as_it_was = "the right one";
  bool is_true() const { return name == as_it_was; }
};

// ---- Other scenes

inline Pretence as_it_is(const Posed_scene& truth) {
  Pretence pretence{truth, {}};
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
  const std::string reason(set_aside_texts[bytes.below(set_aside_texts.size())]);
  const std::string of =
      reason == text_of(Set_aside_reason::duplicate) ? std::to_string(bytes.below(truth.soup.face_count())) : "";
  Pretence pretence{truth, all_but(truth.soup, gone), "set aside: " + std::string(reason), {{gone, reason + of}}};
  pretence.scene.soup = generate::with_faces(truth.soup, pretence.face_of);
  return pretence;
}

/// A face that hides nothing, although it is drawn.
inline Pretence passing_over(const Posed_scene& truth, Bytes& bytes) {
  const Model model(truth.soup);
  if (model.parts().empty()) return as_it_is(truth);
  const Face_id gone = model.parts()[bytes.below(std::min<std::size_t>(256, model.parts().size()))].face;
  Pretence pretence{truth, all_but(truth.soup, gone), "passed over"};
  pretence.scene.soup = generate::with_faces(truth.soup, pretence.face_of);
  std::copy_if(model.parts().begin(), model.parts().end(), std::back_inserter(pretence.passed_over),
               [&](const Part& part) { return part.face == gone; });
  return pretence;
}

/// A face of one loop, one that is not planar if there is such, as the triangles from one of its corners, whichever
/// surface that is.
inline Pretence triangulated_otherwise(const Posed_scene& truth, Bytes& bytes) {
  const Scene scene(truth.soup);
  const std::vector<Face_id>& skew = scene.non_planar();
  const Face_id chosen =
      skew.empty() ? static_cast<Face_id>(bytes.below(truth.soup.face_count())) : skew[bytes.below(skew.size())];
  const auto loop = truth.soup.loop(chosen);
  if (truth.soup.loop_count(chosen) > 1 || loop.size() < 4) return as_it_is(truth);
  Pretence pretence{truth, all_but(truth.soup, chosen), skew.empty() ? "triangulated" : "triangulated otherwise"};
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
  Pretence pretence{image->scene, {}, "cut"};
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
    pretence.name = "the eye elsewhere";
    pretence.scene.eye[axis] += step;
  } else if (which == 1 && !truth.source.empty()) {
    pretence.name = "the source elsewhere";
    for (Exact_point& p : pretence.scene.source) p[axis] += step;
  } else {
    pretence.name = "a point elsewhere";
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
  if (!truth.source.empty() && bytes.below(3) == 0) {
    pretence.name = "the source turned";
    std::reverse(pretence.scene.source.begin(), pretence.scene.source.end());
    return pretence;
  }
  pretence.name = "a face turned";
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
  switch (bytes.below(12)) {
    case 0: return without_a_face(truth, bytes);
    case 1:
    case 2: return passing_over(truth, bytes);
    case 3:
    case 4: return triangulated_otherwise(truth, bytes);
    case 5: return cut(truth, bytes);
    case 6: return nudged(truth, bytes);
    case 7: return turned(truth, bytes);
    default: return as_it_is(truth);
  }
}

// ---- Their certificates

/// Where a path from the eye goes: past a point, or past the source's middle.
inline Exact_point path_end(const Posed_scene& scene) {
  const Points corners = scene.source.size() > 1 ? scene.source : Points{scene.soup.point(0), scene.soup.point(0)};
  const Exact_point between = middle(corners[0], corners[1]);
  Exact_point end;
  for (std::size_t k = 0; k < 3; ++k) end[k] = (3 * between[k] - scene.eye[k]) / 2;
  return end;
}

inline std::optional<Certificate> path_answered(const Posed_scene& scene) {
  const Scene own(scene.soup);
  const Exact_point to = path_end(scene);
  if (scene.eye == to) return std::nullopt;
  const Occluders occluders(own);
  Along_options options;
  options.threads = 1;
  options.with_proofs = true;
  return along_certificate(own, visible_along(occluders, scene.eye, to, options), scene.eye, to, false);
}

/// What an engine says, as a certificate; nothing where it is asked what cannot be.
inline std::optional<Certificate> answered(Kind kind, const Posed_scene& scene) {
  const Model model(scene.soup);
  std::string text;
  switch (kind) {
    case Kind::order: text = order(model, scene.eye, in_one_thread()).certificate(); break;
    case Kind::graph: text = priority_graph(model, in_one_thread()).certificate(); break;
    case Kind::see: text = see(model, scene.eye, in_one_thread()).certificate(); break;
    case Kind::along: return path_answered(scene);
    case Kind::weak: try { text = weakly_visible(model, {scene.source}, in_one_thread()).certificate();
      } catch (const std::invalid_argument&) {  // moved, the source is no convex polygon
        return std::nullopt;
      }
  }
  return certificate_in(text);
}

// One more fragment, as the k-th or wherever it disturbs nothing else.
inline void add_at(Order_certificate& claim, std::size_t k, const Order_fragment& fragment) {
  insert_fragment(claim, k, fragment);
}
inline void add_at(Graph_certificate& claim, std::size_t k, const Order_fragment& fragment) {  // before a component
  std::size_t component = 0, first = 0;
  while (first < k) first += claim.sizes[component++];
  claim.sizes.insert(claim.sizes.begin() + static_cast<std::ptrdiff_t>(component), 1);
  claim.fragments.insert(claim.fragments.begin() + static_cast<std::ptrdiff_t>(first), fragment);
  for (Graph_certificate::Arc& arc : claim.arcs) {
    arc.from += arc.from >= first;
    arc.to += arc.to >= first;
  }
}
inline void add_at(Visible_certificate& claim, std::size_t, const Order_fragment& fragment) {
  claim.fragments.push_back(fragment);
}
inline void add_at(Along_certificate& claim, std::size_t, const Order_fragment& fragment) {
  claim.fragments.push_back(fragment);
}
inline void add_at(Weak_certificate& claim, std::size_t, const Order_fragment& fragment) {
  claim.fragments.push_back(fragment);
  if (claim.undecided.empty() || claim.undecided.back() != fragment.face) claim.undecided.push_back(fragment.face);
}

/// The claim in the faces of the true scene. Parts of one face are its pieces; with `silent`, unless it needs to have
/// such, only its fragments.
template <class Claim>
void translate(Claim& claim, const Pretence& pretence, bool silent, Bytes& bytes) {
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
  if constexpr (std::is_same_v<Claim, Weak_certificate>)
    for (Face_id& face : claim.undecided) face = pretence.face_of[face];
  if constexpr (std::is_same_v<Claim, Along_certificate>)
    for (Along_certificate::Face& of : claim.faces) of.face = pretence.face_of[of.face];
  for (const Part& drawn : pretence.passed_over) {
    if (pretence.passed_over.size() > 1) claim.pieces.push_back({drawn.face, drawn.piece, drawn.corners});
    add_at(claim, bytes.below(std::min<std::size_t>(256, claim.fragments.size() + 1)),
           {drawn.face, drawn.piece, drawn.corners});
  }
}

}  // namespace fuzz
