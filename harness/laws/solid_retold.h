#pragma once
// The law `results` of the subject `boolean`: which surfaces the checker of set operations takes for a result.

#include <sightline/harness/generate/random.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <string>
#include <vector>

namespace sightline::harness {

/// That the checker accepts the result of one of the set operations however its faces are told, with their holes, in
/// another order, on points of their own, loops begun elsewhere, holes turned round, cut in two or with straight
/// corners; and rejects it once a face or a hole is missing, there twice or turned round, or a corner is elsewhere;
/// empty: it does.
std::string flaw_of_told_result(const std::vector<Polygon_soup>& solids, generate::Random& random);

}  // namespace sightline::harness
