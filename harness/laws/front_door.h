#pragma once
// The front door as another way to each answer: what a user gets from sightline/sightline.h is held to what the rooms
// behind it say, and its certificates, and parts of what is seen in these, to the checkers.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Each as the subject of that name labels faces; a certificate that is rejected is a flaw.
Answer ordered_by_front_door(const Posed_scene& posed);
Answer grouped_by_front_door(const Posed_scene& posed);
Answer tracked_by_front_door(const Posed_scene& posed);
Answer seen_by_front_door(const Posed_scene& posed);
/// What is seen weakly from posed.source.
Answer weakly_seen_by_front_door(const Posed_scene& posed);

/// The check "front_door": the subject's labels again, by one of these; components by their numbers, too.
Check front_door_check(Answer (*by_front_door)(const Posed_scene&));

}  // namespace sightline::harness
