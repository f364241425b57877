#pragma once
// Certificates of set operations as JSON text.

#include <sightline/algorithms/verify/solids.h>

#include <iosfwd>
#include <string>

namespace sightline {

/// Writes the certificate, its points in a table. Exact: yes
void write_solid_certificate(std::ostream& out, const Solid_certificate& certificate);

/// Reads it back, keys in any order. Whether it is right is for verify_solids() to say. Errors: std::invalid_argument,
/// one line that says why the text is no certificate of a set operation. Cost: linear; all of it is held. Exact: yes
Solid_certificate read_solid_certificate(const std::string& text);

}  // namespace sightline
