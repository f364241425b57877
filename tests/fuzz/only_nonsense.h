#pragma once
// Nothing but nonsense (nonsense.h) in right certificates of all kinds, faces seen from behind or not: no checker
// accepts any of it, nor what is more than it reads, nor solids that are not closed.

#include "forged.h"
#include "nonsense.h"

#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/weak_visibility/along/along.h>
#include <sightline/algorithms/weak_visibility/along/certificate.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/solids.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace fuzz {

/// The right certificate of a scene, of what is seen from both sides too; nothing where it is asked what cannot be.
inline std::optional<Certificate> right_certificate(Kind kind, const Posed_scene& scene, bool two_sided) {
  if (!two_sided || (kind != Kind::weak && kind != Kind::along)) return answered(kind, scene);
  const Scene own(scene.soup);
  const Occluders occluders(own);
  if (kind == Kind::weak) {
    Weak_options options;
    options.threads = 1;
    options.search.two_sided = true;
    options.search.cells = 300;
    return weak_certificate(own, {scene.source}, true,
                            weakly_visible(occluders, {weak_source(occluders, scene.source)}, options));
  }
  const Exact_point to = path_end(scene);
  if (scene.eye == to) return std::nullopt;
  Along_options options;
  options.threads = 1;
  options.two_sided = options.with_proofs = true;
  return along_certificate(own, visible_along(occluders, scene.eye, to, options), scene.eye, to, true);
}

// ---- More than a checker reads

template <class Claim>
bool is_made_long(Claim&, Bytes&) {
  return false;
}
/// Cuts below cuts, without end.
inline bool is_made_long(Weak_certificate& claim, Bytes& bytes) {
  constexpr std::size_t more_than_are_read = 1010;
  if (claim.hidden.empty() || claim.sources.empty()) return false;
  Weak_certificate::Hidden& entry = claim.hidden[bytes.below(claim.hidden.size() % 256 + 1) % claim.hidden.size()];
  const Points& source = claim.sources[0];
  Weak_certificate::Node cut;
  cut.kind = Weak_certificate::Node::Kind::cut_source;
  const Exact_point along = minus(source[1], source[0]);  // a plane across an edge, through its middle
  cut.plane = {along[0], along[1], along[2], Rational(-dot(along, generate::along(source[0], Rational(1, 2), along)))};
  entry.proof.assign(more_than_are_read, cut);
  return true;
}
/// Sides of a cone, or cuts, without end.
inline bool is_made_long(Along_certificate& claim, Bytes& bytes) {
  constexpr std::size_t more_than_are_read = 1010;
  for (Along_certificate::Proof& proof : claim.proofs) {
    if (!proof.cone.empty() && bytes.below(2) == 0) {
      const std::vector<Along_certificate::Side> sides = proof.cone;
      while (proof.cone.size() < more_than_are_read) proof.cone.insert(proof.cone.end(), sides.begin(), sides.end());
      return true;
    }
    if (!proof.tree.empty() && proof.tree[0].is_cut) {
      proof.tree.assign(more_than_are_read, proof.tree[0]);
      return true;
    }
  }
  return false;
}

// ---- Of one certificate

template <class Claim>
void refuse_nonsense(const Claim& right, const Posed_scene& scene, Mutator& random) {
  constexpr std::size_t tries = 24, bytes_of_nonsense = 24;
  if (const Verdict verdict = verdict_on(scene.soup, right); !verdict.accepted)
    throw Finding("a right certificate is rejected: " + verdict.why);
  if (!right.set_aside.empty()) {  // any text is written so that it is read
    Claim claim = right;
    claim.set_aside[0].why = "a \"b\" \\c\t\x01";
    const std::optional<Certificate> read = certificate_in(certificate_text(claim));
    const Claim* const same = read ? std::get_if<Claim>(&*read) : nullptr;
    if (same == nullptr || same->set_aside[0].why != claim.set_aside[0].why)
      throw Finding("a reason is not read as it was written");
  }
  for (std::size_t k = 0; k < tries; ++k) {
    const std::string words = random.random_bytes(bytes_of_nonsense);
    Bytes bytes(words);
    Claim claim = right;
    std::string what = "more than is read";
    if (bytes.below(12) != 0) what = told_nonsense(claim, scene.soup.face_count(), bytes);
    else if (!is_made_long(claim, bytes)) what.clear();
    if (!what.empty() && verdict_on(scene.soup, claim).accepted) throw Finding("nonsense is accepted: " + what);
  }
}

inline void refuse_nonsense_of_solids(const Posed_scene& scene, Mutator& random) {
  constexpr std::size_t tries = 24, bytes_of_nonsense = 24, most_faces = 24;
  generate::Random choices(random.below(1u << 30));
  const Solids solids = harness::solids_of(scene, choices);
  std::size_t faces = 0;
  for (const Polygon_soup& solid : solids) faces += solid.face_count();
  if (faces == 0 || faces > most_faces) return;
  const Set_options options = harness::drawn_operation(random);
  const Operands operands(solids);
  const Solid_certificate right = solid_certificate(operands, options, set_operation(operands, options));
  if (const Verdict verdict = verdict_on(solids, right); !verdict.accepted)
    throw Finding("a right certificate of solids is rejected: " + verdict.why);
  for (std::size_t k = 0; k < tries; ++k) {
    const std::string words = random.random_bytes(bytes_of_nonsense);
    Bytes bytes(words);
    Solid_certificate claim = right;
    if (bytes.below(8) != 0) {
      const std::string what = told_nonsense(claim, solids, bytes);
      if (!what.empty() && verdict_on(solids, claim).accepted)
        throw Finding("nonsense about solids is accepted: " + what);
      continue;
    }
    // The last face of a solid is not there, nor what is said of it alone.
    Solids open = solids;
    const std::uint32_t operand = static_cast<std::uint32_t>(bytes.below(open.size()));
    if (solids[operand].face_count() == 0) continue;
    const Face_id last = static_cast<Face_id>(solids[operand].face_count() - 1);
    const auto is_of_last = [&](const auto& part) { return part.operand == operand && part.face == last; };
    if (std::any_of(claim.set_aside.begin(), claim.set_aside.end(), is_of_last)) continue;
    std::vector<Face_id> others(last);
    std::iota(others.begin(), others.end(), Face_id{0});
    open[operand] = generate::with_faces(solids[operand], others);
    std::erase_if(claim.fragments, [&](Solid_certificate::Fragment& fragment) {
      std::erase_if(fragment.parts, is_of_last);
      return fragment.parts.empty();
    });
    std::erase_if(claim.pieces, is_of_last);
    if (verdict_on(open, claim).accepted) throw Finding("a solid that is not closed is accepted");
  }
}

inline void only_nonsense(std::string_view text) {
  constexpr std::size_t most_faces = 10, kinds = 6;
  Bytes bytes(text);
  const Posed_scene scene = any_scene(bytes);
  if (scene.soup.face_count() == 0 || scene.soup.face_count() > most_faces) return;
  const std::size_t drawn = bytes.below(kinds);
  const bool two_sided = bytes.below(2) == 0;
  Mutator random(bytes.word());
  if (drawn == kinds - 1) return refuse_nonsense_of_solids(scene, random);
  const Kind kind = static_cast<Kind>(drawn);
  if (kind == Kind::weak && scene.source.empty()) return;
  const std::optional<Certificate> right = right_certificate(kind, scene, two_sided);
  if (right) std::visit([&](const auto& claim) { refuse_nonsense(claim, scene, random); }, *right);
}

}  // namespace fuzz
