#pragma once
// What looks, and the methods that say what it sees: for weak, and for compare.

#include "../support/common.h"

#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/volume.h>
#include <sightline/algorithms/weak_visibility/events/events.h>

#include <list>

namespace sightline::app {

/// The options that say what looks.
struct Source_arguments {
  std::vector<Face_id> faces, solid;
  std::vector<std::string> polygons, volumes;
  bool two_sided = false;

  bool empty() const { return faces.empty() && solid.empty() && polygons.empty() && volumes.empty(); }
  /// `prefix`: what the help of each begins with.
  void add_to(Command command, const std::string& prefix = "");
};

/// Sources as they were given, and as searches take them; volumes as their surfaces.
struct Sources {
  std::vector<std::vector<Exact_point>> points;
  std::vector<Weak_source> polygons;
  std::list<Weak_volume> volumes;
};
/// Errors: Usage_error where there are none, or that name what is none. `progress` is told how far each volume is; what
/// it throws ends it.
Sources sources_of(const Source_arguments& arguments, const Common& common, const Polygon_soup& soup,
                   const Occluders& occluders, const Report& progress = {});

struct Weak_task {
  bool two_sided = false;
  int threads = 0;
  std::uint64_t seed = 1;
  std::size_t cells = 0;  ///< lines: that a search may take; 0: so many at first, and more where event_edges is usual
  std::size_t event_edges = usual_event_edges;  ///< lines: what stays undecided goes to events where no more are near
  std::size_t rays = 100000;                    ///< sample
  bool surfaces = false;                        ///< events: whether to keep them
  std::function<bool()> out_of_time;            ///< lines, events: what they have no time for stays open
  Report progress;
};

struct Weak_outcome {
  Weakly_visible found;
  Event_counters events;
  std::vector<Event_surface> surfaces;
  std::vector<Face_id> by_events;  ///< of method lines, faces that events decided
  std::vector<Face_id> within;     ///< faces that volumes see from within
};

/// The colour of a method in plots.
std::string colour_of_method(const std::string& method);

/// `method`: lines, which ends with events where that helps; events, conservative, doubles, sample.
Weak_outcome run_weak_method(const std::string& method, const Occluders& occluders, const Sources& sources,
                             const Weak_task& task);

}  // namespace sightline::app
