#pragma once
// For each method of a report that errs the smallest scene that shows it.

#include "questions.h"

#include <sightline/harness/report/report.h>

namespace sightline::app {

struct Example_options {
  Report_effort effort;
  Report_limits limits;
  std::size_t tests;  ///< scenes that are tried for each, at most
  double seconds;     ///< the same; then the rest is left as it is
  std::vector<Report_program> programs;
};

/// The row's smallest wrong case, made smaller as long as the contender is still wrong about it; nothing where it is
/// right when it is asked again, as what depends on chance or time may be.
std::optional<report::Example> example_of(const report::Row& row, const Judge_case& asked,
                                          const Example_options& options);

}  // namespace sightline::app
