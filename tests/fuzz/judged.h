#pragma once
// The judge of other people's programs: its cases, grades, guesses and explanations are what their headers say, by
// rationals, by sets, and by the library's own answers to the question as it is read.

#include "judged_answers.h"
#include "judged_cases.h"
#include "judged_grades.h"
#include "judged_guesses.h"
#include "judged_reasons.h"
#include "support.h"

#include <sightline/harness/generate/random.h>

#include <array>
#include <cstddef>
#include <string_view>

namespace fuzz {

inline void judged(std::string_view bytes) {
  using namespace judged_laws;
  using Law = void (*)(generate::Random&);
  static constexpr std::array<Law, 34> laws{try_words_of_readings,
                                            try_grade_of_bent_faces,
                                            try_part_of_no_face,
                                            try_truth_without_rays,
                                            try_touched_borders,
                                            try_why_not_the_solid,
                                            try_why_not_inside,
                                            try_case_with_straight_corners,
                                            try_excused_rays,
                                            try_truth_without_time,
                                            try_face_zero,
                                            try_why_not_in_order_of_parts,
                                            try_case_of_a_family,
                                            try_case_of_a_scene,
                                            try_grade_of_faces,
                                            try_grade_of_an_order,
                                            try_contracts,
                                            try_reading_of_faces,
                                            try_reading_of_an_order,
                                            try_reading_of_rays,
                                            try_reading_of_solids,
                                            try_lists,
                                            try_words_of_tendencies,
                                            try_words_of_neighbours,
                                            try_words_of_kinds,
                                            try_why_not_seen,
                                            try_why_not_weakly_visible,
                                            try_why_not_in_order,
                                            try_why_not_met,
                                            try_rounded_source,
                                            try_part_beside_its_plane,
                                            try_told_answer,
                                            try_told_nothing,
                                            try_flaw_of_solids};
  ask_one_of(laws, bytes);
}

}  // namespace fuzz
