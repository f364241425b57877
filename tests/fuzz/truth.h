#pragma once
// What is true of a scene: by its faces' own points, and by what the engines answer, each question once.

#include "claims.h"

#include <sightline/harness/generate/families.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/scene/set_aside.h>
#include <sightline/sightline.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace fuzz {

inline Asking in_one_thread() { return {1, {}}; }

inline Known_scene known(const Polygon_soup& soup) {
  const Scene scene(soup);
  Known_scene all{soup, std::vector<std::vector<Flat>>(soup.face_count()), std::vector<bool>(soup.face_count()),
                  std::vector<bool>(soup.face_count())};
  for (const Piece& piece : scene.pieces()) all.parts[piece.face].emplace_back(scene.corner_points(piece));
  for (const sightline::Set_aside& entry : scene.set_aside()) {
    all.set_aside[entry.face] = true;
    if (entry.reason != Set_aside_reason::duplicate) continue;
    all.duplicate[entry.face] = true;
    all.parts[entry.face] = all.parts[std::stoul(entry.why.substr(text_of(entry.reason).size()))];
  }
  return all;
}

/// A scene, and its answers so far.
class Truth {
 public:
  explicit Truth(const Polygon_soup& soup) : known(fuzz::known(soup)), model(soup) {}

  const Known_scene known;
  const Model model;

  const Priority& graph() {
    if (!graph_) graph_ = priority_graph(model, in_one_thread());
    return *graph_;
  }
  const Seen& seen(const Exact_point& eye) {
    const auto found = seen_.find(eye);
    return found != seen_.end() ? found->second : seen_.emplace(eye, see(model, eye, in_one_thread())).first->second;
  }
  const Weak_visibility& weak(const std::vector<Points>& sources, bool two_sided) {
    const auto question = std::pair(sources, two_sided);
    const auto found = weak_.find(question);
    if (found != weak_.end()) return found->second;
    Asking asking = in_one_thread();
    asking.two_sided = two_sided;
    return weak_.emplace(question, weakly_visible(model, sources, asking)).first->second;
  }

 private:
  std::optional<Priority> graph_;
  std::map<Exact_point, Seen> seen_;
  std::map<std::pair<std::vector<Points>, bool>, Weak_visibility> weak_;
};

// ---- Claims against the engines

using Face_set = std::set<Face_id>;

/// What is drawn last in a direction is what is seen there.
inline void compare_with_engine(Truth& truth, const Order_certificate& claim) {
  const std::vector<Flat> fragments = flats(claim);
  const Place eye = place(claim.eye);
  for (const Seen::Visible_part& part : truth.seen(claim.eye).parts) {
    if (claim.on_view && !part.from_front) continue;  // it may be left out
    const Place p = mixtures(places(part.corners))[0];
    std::optional<Flat::Hit> last;
    bool on_a_boundary = false;
    for (const Flat& fragment : fragments)
      if (const auto hit = fragment.hit(eye, p); hit && hit->at != Flat::At::before && hit->at != Flat::At::p) {
        on_a_boundary = on_a_boundary || hit->location == 0;
        last = hit;
      }
    require(on_a_boundary || (last && last->at == Flat::At::q), "what is drawn last is what the engine sees");
  }
}

inline void compare_with_engine(Truth& truth, const Graph_certificate& claim) {
  const std::vector<Part>& parts = truth.model.parts();
  const auto is_cut = [](const Part& part) { return part.piece != 0; };
  if (parts.size() != claim.fragments.size() || std::any_of(parts.begin(), parts.end(), is_cut))
    return;  // a concave face cut otherwise has other components
  using Partition = std::multiset<std::multiset<Face_id>>;
  Partition claimed, found;
  for (std::size_t c = 0, first = 0; c < claim.sizes.size(); first += claim.sizes[c++]) {
    std::multiset<Face_id> faces;
    for (std::size_t i = first; i < first + claim.sizes[c]; ++i) faces.insert(claim.fragments[i].face);
    claimed.insert(std::move(faces));
  }
  for (const std::vector<std::uint32_t>& component : truth.graph().components) {
    std::multiset<Face_id> faces;
    for (const std::uint32_t part : component) faces.insert(parts[part].face);
    found.insert(std::move(faces));
  }
  require(claimed == found, "accepted components are those that the engine finds");
}

inline void compare_with_engine(Truth& truth, const Visible_certificate& claim) {
  const std::vector<Flat> fragments = flats(claim);
  Face_set front, back;
  for (const Visible_certificate::Part& part : claim.parts)
    (fragments[part.fragment].side(place(claim.eye)) > 0 ? front : back).insert(claim.fragments[part.fragment].face);
  const Seen& found = truth.seen(claim.eye);
  Face_set found_front, found_back;  // of the parts, as of faces in one plane one has the part
  for (const Seen::Visible_part& part : found.parts) (part.from_front ? found_front : found_back).insert(part.face);
  const auto is_all = [&](const Face_set& claimed, const Face_set& seen) {
    return claim.field.empty() ? claimed == seen
                               : std::includes(seen.begin(), seen.end(), claimed.begin(), claimed.end());
  };
  require(is_all(front, found_front) && is_all(back, found_back),
          "accepted parts are of the faces that the engine sees");
}

inline void compare_with_engine(Truth& truth, const Along_certificate& claim) {
  for (const auto& [t, then] : times_of(claim)) {
    const Seen& found = truth.seen(eye_at(claim, t));
    Face_set faces(found.visible.begin(), found.visible.end());
    if (claim.two_sided) faces.insert(found.from_behind.begin(), found.from_behind.end());
    require(faces == said_to_be_seen(claim, then), "what is accepted of a moment is what the eye sees then");
  }
}

inline void compare_with_engine(Truth& truth, const Weak_certificate& claim) {
  Face_set visible, undecided(claim.undecided.begin(), claim.undecided.end());
  for (const Weak_certificate::Sightline& entry : claim.visible) visible.insert(claim.fragments[entry.fragment].face);
  const Weak_visibility& found = truth.weak(claim.sources, claim.two_sided);
  for (const Face_id face : found.visible)
    require(visible.count(face) + undecided.count(face) > 0, "what the engine sees is not hidden");
  for (const Face_id face : found.hidden) require(visible.count(face) == 0, "what is hidden to the engine is not seen");
}

// ---- Whether a claim that holds is about what the scene was made for, and leaves nothing open: it says what is true

inline bool is_the_truth(const Order_certificate& claim, const generate::Posed_scene& scene) {
  return claim.eye == scene.eye && !claim.on_view;
}
inline bool is_the_truth(const Graph_certificate&, const generate::Posed_scene&) { return true; }
inline bool is_the_truth(const Visible_certificate& claim, const generate::Posed_scene& scene) {
  return claim.eye == scene.eye && claim.field.empty();
}
inline bool is_the_truth(const Along_certificate& claim, const generate::Posed_scene& scene) {
  return claim.from == scene.eye && !claim.two_sided;
}
inline bool is_the_truth(const Weak_certificate& claim, const generate::Posed_scene& scene) {
  return claim.sources == std::vector<Points>{scene.source} && !claim.two_sided && claim.undecided.empty();
}

}  // namespace fuzz
