#pragma once
// What a set operation tells its checker.

#include <sightline/algorithms/solids/operands.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/verify/solids.h>

namespace sightline {

/// Pre: the result kept its fragments.
Solid_certificate solid_certificate(const Operands& operands, const Set_options& options, const Set_result& result);

}  // namespace sightline
