#pragma once
// The command line of `sightline weak`.

#include "../methods/weak.h"
#include "../support/picture.h"
#include "partition.h"

#include <string>

namespace sightline::app {

struct Weak_arguments {
  Common common;
  View_arguments view;
  Source_arguments sources;
  std::string method = "lines", certificate, svg, html, obj, mesh, eye, surfaces, along;
  Weak_task task;
  Partition_arguments partition;
};

}  // namespace sightline::app
