#pragma once
// How a command becomes part of the program: each apps/<command>.cpp defines one add_<command>, and main.cpp calls it
// with the program's root.

#include "options.h"

namespace sightline::app {

void add_info(Command program);
void add_bsp(Command program);
void add_order(Command program);
void add_graph(Command program);
void add_cutset(Command program);
void add_verify(Command program);
void add_compare(Command program);
void add_see(Command program);
void add_weak(Command program);
void add_render(Command program);
void add_cells(Command program);
void add_pvs(Command program);
void add_merge(Command program);
void add_generate(Command program);
void add_fuzz(Command program);
void add_reduce(Command program);
void add_judge(Command program);
void add_report(Command program);
void add_completion(Command program);
void add_schema(Command program);
void add_trace(Command program);
void add_boolean(Command program);
void add_shadow(Command program);

}  // namespace sightline::app
