#pragma once
// The subject `order`: back-to-front orders by BSP trees and by priority trees.

#include <sightline/harness/laws/subject.h>

namespace sightline::harness {

/// Certificates are checked by verify_order.
Subject order();

}  // namespace sightline::harness
