#pragma once
// Certificates of all kinds, on one small scene: read or refused, accepted or rejected in one line; and what is
// accepted is true where it is tried (claims.h).

#include "claims.h"

#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/io/read.h>

#include <nlohmann/json.hpp>

#include <sstream>

namespace fuzz {

/// tests/corpus/general/lamp_and_screens.off, which its certificates in tests/corpus/certificates are for.
inline const Known_scene& known_scene() {
  static const Known_scene scene = [] {
    Known_scene known{
        read_scene(std::string(SIGHTLINE_SOURCE_DIR) + "/tests/corpus/general/lamp_and_screens.off"), {}, {}, {}};
    for (Face_id f = 0; f < known.soup.face_count(); ++f) {
      Points corners;
      for (const Point_id p : known.soup.loop(f)) corners.push_back(known.soup.point(p));
      std::vector<Flat>& parts = known.parts.emplace_back();
      known.duplicate.push_back(false);
      known.set_aside.push_back(f == 6 || f == 7 || f == 10);  // a duplicate, one without area, one that winds twice
      if (f < 5 || f == 9) parts.emplace_back(corners);
      if (f == 5)
        parts = {Flat({corners[0], corners[1], corners[2], corners[3]}),
                 Flat({corners[0], corners[3], corners[4], corners[5]})};  // an L
    }
    return known;
  }();
  return scene;
}

/// In one thread: what is checked is small.
/// Whatever it says of where planes cut the sequence, it is the same verdict as without.
inline Verdict verdict_on(const Polygon_soup& soup, const Order_certificate& claim) {
  const Verdict verdict = verify_order(soup, claim, {1, {}});
  if (claim.cuts.depths.empty()) return verdict;
  Order_certificate without = claim;
  without.cuts = {};
  const Verdict other = verify_order(soup, without, {1, {}});
  require(verdict.accepted == other.accepted && verdict.why == other.why && verdict.fragments == other.fragments,
          "cuts of a sequence change no verdict");
  return verdict;
}
inline Verdict verdict_on(const Polygon_soup& soup, const Graph_certificate& claim) {
  return verify_graph(soup, claim, {1, {}});
}
inline Verdict verdict_on(const Polygon_soup& soup, const Visible_certificate& claim) {
  return verify_visible(soup, claim, {1, {}});
}
inline Verdict verdict_on(const Polygon_soup& soup, const Weak_certificate& claim) {
  return verify_weak(soup, claim, {1, {}});
}
inline Verdict verdict_on(const Polygon_soup& soup, const Along_certificate& claim) {
  return verify_along(soup, claim, {1, {}});
}

inline std::optional<Certificate> certificate_in(std::string_view bytes) {
  std::istringstream in{std::string(bytes)};
  try {
    return read_certificate(in);
  } catch (const std::invalid_argument& error) {
    require(std::string_view(error.what()).starts_with("certificate: "), "what is wrong with a certificate begins so");
    return std::nullopt;
  }
}

/// The verdict on a certificate; nothing where it is refused.
inline std::optional<Verdict> checked_certificate(std::string_view bytes) {
  const std::optional<Certificate> certificate = certificate_in(bytes);
  if (!certificate) return std::nullopt;
  return std::visit(
      [](const auto& claim) {
        const Verdict verdict = verdict_on(known_scene().soup, claim);
        require(!verdict.why.empty() && verdict.why.find('\n') == std::string::npos, "a verdict is one line");
        for (const std::size_t i : verdict.fragments)
          require(i < claim.fragments.size(), "a verdict names fragments that there are");
        require(certificate_in(certificate_text(claim)).has_value(), "what is written is read");
        if (verdict.accepted) try_claims(known_scene(), claim);
        return verdict;
      },
      *certificate);
}

inline void certificate(std::string_view bytes) { checked_certificate(bytes); }

}  // namespace fuzz
