#pragma once
// The subject `weak`: faces weakly visible from the source polygon.

#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <cstddef>

namespace sightline::harness {

namespace weak_subject {

/// Searches end here: rarely, a tangled degenerate scene would take minutes.
inline constexpr std::size_t most_cells = 3000, most_events = 100000;

/// Labels: 1 visible, 0 hidden.
template <class Found>
Answer labels_of(const Polygon_soup& soup, const Scene& scene, const Found& found) {
  Answer answer;
  answer.labels.assign(soup.face_count(), Answer::none);
  answer.planar = scene.counters().non_planar + scene.counters().no_simple_projection == 0;
  for (const Face_id face : found.visible) answer.labels[face] = 1;
  for (const Face_id face : found.hidden) answer.labels[face] = 0;
  answer.undecided = found.undecided.size();
  return answer;
}

Answer by_lines(const Posed_scene& posed, bool verify);

Outcome by_events(const Posed_scene& posed, const Answer& answer);

Outcome as_constructed(const Posed_scene& posed, const Answer& answer);

/// The source about its centroid, three halves as large: visible faces only grow.
Outcome grown(const Posed_scene& posed, const Answer& answer);

/// A face sees the source, put in as a face, if the source sees it.
Outcome reversed(const Posed_scene& posed, const Answer& answer, Random& random);

}  // namespace weak_subject

/// Certificates are checked by verify_weak.
Subject weak();

}  // namespace sightline::harness
