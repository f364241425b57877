#pragma once
// What commands are asked in all manners (manners.h): each question's answer as text, all that it says.

#include <sightline/harness/laws/manners.h>

#include <vector>

namespace sightline::harness {

std::vector<Question> questions_of_see();
std::vector<Question> questions_of_trace();
std::vector<Question> questions_of_order();
std::vector<Question> questions_of_graph();
std::vector<Question> questions_of_weak();
std::vector<Question> questions_of_pvs();
std::vector<Question> questions_of_shadow();
std::vector<Question> questions_of_render();
std::vector<Question> questions_of_boolean();

}  // namespace sightline::harness
