#pragma once
// sightline weak --partition: where the light of sources changes on a face.

#include "../methods/methods.h"
#include "../methods/weak.h"

namespace sightline::app {

struct Partition_arguments {
  std::vector<Face_id> faces;
  bool all_borders = false;
  std::size_t rays = 0;  ///< what so many make of the first face; 0: none are asked

  bool asked_for() const { return !faces.empty(); }
  Option add_to(Command command);
};

/// Writes what of each face is lit, in penumbra and in umbra: a table or JSON, and a picture of the first where `svg`
/// is not empty.
Exit run_partition(const Partition_arguments& arguments, const Common& common, const Source_arguments& of_sources,
                   const std::string& svg);

}  // namespace sightline::app
