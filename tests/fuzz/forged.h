#pragma once
// Certificates forged by meaning, on scenes of all families: the right certificate of another scene (pretences.h), or
// one that lies about what is shown (lies.h and its like), as one of the scene at hand. What a checker accepts
// nevertheless has to be true: where brute force tries it (claims.h), and by what the engines answer (truth.h).

#include "certificate.h"
#include "lies.h"
#include "mutate.h"
#include "nonsense.h"
#include "path_lies.h"
#include "pretences.h"
#include "retold.h"
#include "solid_forgeries.h"
#include "tallies.h"
#include "truth.h"
#include "visible_lies.h"
#include "weak_lies.h"

#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/transform.h>

namespace fuzz {

// ---- The scene

/// A scene of any family, and any distance from what is degenerate in it; half of them with a point moved, which bends
/// faces. Often of the family with faces of all kinds.
inline Posed_scene any_scene(Bytes& bytes) {
  const std::vector<generate::Family>& families = generate::families();
  const generate::Family& family =
      bytes.below(3) == 0 ? generate::family("tangle") : families[bytes.below(families.size())];
  generate::Family_parameters parameters;
  parameters.seed = bytes.word() % 100000;
  parameters.size = family.small_size;
  const std::int64_t distances[] = {0, 0, 1, -1, 2, generate::far_ulps};
  parameters.ulps = distances[bytes.below(6)];
  Posed_scene scene = family.make(parameters);
  if (scene.soup.point_count() == 0 || bytes.below(2) != 0) return scene;
  const Point_id bent = static_cast<Point_id>(bytes.byte() % scene.soup.point_count());
  const std::size_t axis = bytes.below(3);
  scene.soup = generate::mapped(scene.soup, [&](Point_id i, Exact_point p) {
    if (i == bent) p[axis] += 1;
    return p;
  });
  return scene;
}

/// Where there is a source, often from it: much of that is proofs.
inline Kind any_kind(const Posed_scene& scene, Bytes& bytes) {
  const std::size_t drawn = bytes.below(8);
  if (drawn < 4) return static_cast<Kind>(drawn);
  return scene.source.empty() ? static_cast<Kind>(drawn % 4) : Kind::weak;
}

// ---- Forgeries of one certificate

/// How many are made of one certificate: fewer of one with long proofs, each of which takes its time.
template <class Claim>
std::size_t forgeries_of(const Claim&) {
  return 64;
}
inline std::size_t forgeries_of(const Weak_certificate& claim) {
  constexpr std::size_t long_proofs = 300;  // nodes
  std::size_t nodes = 0;
  for (const Weak_certificate::Hidden& entry : claim.hidden) nodes += entry.proof.size();
  return nodes > long_proofs ? 12 : 64;
}

inline std::size_t forgeries_of(const Along_certificate& claim) { return claim.proofs.size() > 100 ? 12 : 64; }

/// What is accepted is accepted however it is told.
template <class Claim>
void tell_otherwise(const Polygon_soup& soup, const Claim& accepted, Mutator& random) {
  constexpr std::size_t tellings = 6;
  for (std::size_t t = 0; t < tellings; ++t) {
    Claim retold = accepted;
    for (std::size_t left = 1 + t % 3; left > 0; --left) retell(retold, random);
    if (const Verdict verdict = verdict_on(soup, retold); !verdict.accepted)
      throw Finding("what is accepted is rejected when it is told otherwise: " + verdict.why);
  }
}

/// Shows a certificate of another scene, and lies about it, as those of the true one: what passes is true.
template <class Claim>
Tallies judged_forgeries_of(const Claim& shown, const Pretence& pretence, const Posed_scene& scene,
                            const std::string& kind, Mutator& random) {
  constexpr std::size_t bytes_of_lies = 48, nonsense_share = 6;
  Tallies tallies;
  std::optional<Truth> truth;
  for (std::size_t k = 0, forgeries = forgeries_of(shown); k < forgeries; ++k) {
    // 1. What is shown: the certificate itself first.
    Claim claim = shown;
    std::string name = pretence.name;
    if (k > 0) {
      const std::string words = random.random_bytes(bytes_of_lies);
      Bytes bytes(words);
      if (bytes.below(nonsense_share) == 0) {
        const std::string where = told_nonsense(claim, scene.soup.face_count(), bytes);
        if (where.empty()) continue;
        ++tallies[kind + ": nonsense"].rejected;
        if (verdict_on(scene.soup, claim).accepted) throw Finding(kind + ": nonsense is accepted: " + where);
        continue;
      }
      const std::string lie = told_a_lie(lies_in(claim), claim, scene, bytes);
      if (lie.empty()) continue;
      name = pretence.is_true() ? lie : "a lie about another scene";
    }

    // 2. Whether it passes; then it is true.
    Judged& judged = tallies[kind + ": " + name];
    const Verdict verdict = verdict_on(scene.soup, claim);
    if (!verdict.accepted) {
      if (k == 0 && pretence.is_true()) throw Finding("a right certificate is rejected: " + verdict.why);
      ++judged.rejected;
      continue;
    }
    ++judged.accepted;
    if (k == 0) tell_otherwise(scene.soup, claim, random);
    if (!truth) truth.emplace(scene.soup);
    try {
      try_claims(truth->known, claim);
      compare_with_engine(*truth, claim);
    } catch (const Finding& finding) {
      throw Finding(scene.name + ", " + kind + ", " + name + ": " + finding.what());
    }
    judged.the_truth += is_the_truth(claim, scene);
  }
  return tallies;
}

/// The same of what bytes stand for; nothing where they say nothing.
inline Tallies judged_forgeries(std::string_view text) {
  constexpr std::size_t most_faces = 16;
  Bytes bytes(text);
  const Posed_scene scene = any_scene(bytes);
  if (scene.soup.face_count() == 0 || scene.soup.face_count() > most_faces) return {};
  if (bytes.below(8) == 0) {
    Mutator random(bytes.word());
    return judged_solid_forgeries(scene, random);
  }
  const Kind kind = any_kind(scene, bytes);
  const Pretence pretence = pretence_of(scene, bytes);
  std::optional<Certificate> answer = answered(kind, pretence.scene);
  if (!answer) return {};
  const bool silent = bytes.below(4) == 0;
  Mutator random(bytes.word());
  return std::visit(
      [&](auto& claim) {
        translate(claim, pretence, silent, bytes);
        return judged_forgeries_of(claim, pretence, scene, kind_names[static_cast<std::size_t>(kind)], random);
      },
      *answer);
}

/// What `forged` has shown to the checkers.
inline Tallies certificates_shown;

inline void forged(std::string_view bytes) { add(certificates_shown, judged_forgeries(bytes)); }

}  // namespace fuzz
