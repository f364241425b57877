#pragma once
// The subject `see`: the visible parts of faces from an eye, over the whole sphere of directions.

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/view_drafts.h>
#include <sightline/harness/generate/weak_neighbours.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <string>

namespace sightline::harness {

namespace see_subject {

inline Visible_options serial() {
  Visible_options options;
  options.threads = 1;
  return options;
}

/// Labels: 1 where an open part of the face is seen from its front, 2 from behind.
template <class Surface>
Answer labels_of(const Posed_scene& posed, const Scene& scene, const Surface& surface) {
  Answer answer;
  answer.labels.assign(posed.soup.face_count(), Answer::none);
  answer.planar = scene.counters().non_planar + scene.counters().no_simple_projection == 0;
  for (const Piece& piece : scene.pieces()) answer.labels[piece.face] = 0;
  for (const Face_id face : surface.visible) answer.labels[face] |= 1;
  for (const Face_id face : surface.from_behind) answer.labels[face] |= 2;
  return answer;
}

Answer exactly(const Posed_scene& posed, bool verify);

/// The same by another number type, which is exact too.
template <class FT>
Outcome by_numbers(const Posed_scene& posed, const Answer& answer, const std::string& name) {
  const Scene scene(posed.soup);
  const Piece_boxes boxes(scene);
  const Number_view<FT> view(scene, posed.eye);
  return compared(answer, labels_of(posed, scene, visible_surface(view, boxes, serial())), "exact", name);
}

}  // namespace see_subject

/// Certificates are checked by verify_visible.
Subject see();

}  // namespace sightline::harness
