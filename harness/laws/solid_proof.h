#pragma once
// The law `proof` of the subject `boolean`: what the checker of set operations accepts, and what it does not.

#include <sightline/harness/generate/random.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <string>
#include <vector>

namespace sightline::harness {

/// That the checker accepts a certificate of one of the set operations, and rejects it once something in it is changed;
/// empty: it does. Of neighbouring fragments of the same faces, around which solids wind otherwise, two become one, or
/// one gets what is said of the other. In a share an empty solid is there too, so that nothing is in the intersection:
/// all fragments are dropped, and winding numbers alone tell them apart.
std::string flaw_of_certificate(const std::vector<Polygon_soup>& solids, generate::Random& random);

}  // namespace sightline::harness
