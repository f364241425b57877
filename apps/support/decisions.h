#pragma once
// Decision trees of on-view tests, from a scene and a likelihood of views.

#include "common.h"

#include <sightline/algorithms/cutset/decision_tree.h>
#include <sightline/kernel/scene/face_graph.h>

namespace sightline::app {

struct Decision_arguments {
  bool wanted = false, inside = false;
  std::string likelihood;  ///< a file, or empty: all views from open sets of viewpoints alike
};

void add_to(Command command, Decision_arguments& arguments);

/// The tree of fewest expected tests, and the names of what it tests.
struct Decisions {
  Decision_tree tree;
  std::vector<Face_id> faces;  ///< of bit k; the lowest face id of those in one plane that hang together
  std::size_t cells = 0, open_cells = 0;
};
/// Errors: Input_error for a bad file, and for a scene that has no such tree; std::length_error for too many views;
/// what `in_time` throws, which is called all the time.
Decisions decide(const Decision_arguments& arguments, const Face_graph& graph, const Report& in_time);
Json to_json(const Decisions& decisions);
void print(const Decisions& decisions);

}  // namespace sightline::app
