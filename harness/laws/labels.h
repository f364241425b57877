#pragma once
// How subjects, and other ways to the same answer, label faces.

#include <sightline/harness/laws/subject.h>
#include <sightline/kernel/scene/polygon_soup.h>

namespace sightline::harness {

/// 1 where an open part of the face is seen from its front, 2 from behind. Pre: kept faces have the label 0.
template <class Found>
void label_seen(const Found& found, Answer& answer) {
  for (const Face_id face : found.visible) answer.labels[face] |= 1;
  for (const Face_id face : found.from_behind) answer.labels[face] |= 2;
}

/// 1 visible, 0 hidden.
template <class Found>
void label_weakly_seen(const Found& found, Answer& answer) {
  for (const Face_id face : found.visible) answer.labels[face] = 1;
  for (const Face_id face : found.hidden) answer.labels[face] = 0;
  answer.undecided = found.undecided.size();
}

}  // namespace sightline::harness
