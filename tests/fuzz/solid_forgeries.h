#pragma once
// Certificates of set operations on solids of a scene's faces, forged: of other solids, and with lies.

#include "lies.h"
#include "nonsense.h"
#include "tallies.h"

#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/verify/solids.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/solid_oracle.h>
#include <sightline/harness/laws/solids.h>

#include <map>

namespace fuzz {

using Solids = std::vector<Polygon_soup>;

inline Verdict verdict_on(const Solids& solids, const Solid_certificate& claim) {
  return verify_solids(solids, claim, nullptr, {1, {}});
}

// ---- Lies

inline bool in_a_fragment(Solid_certificate& claim, Bytes& bytes, auto change) {
  return !claim.fragments.empty() && change(claim.fragments[any_of_first(claim.fragments, bytes)]);
}

inline const std::vector<Lie<Solid_certificate>>& lies_in(const Solid_certificate&) {
  using Claim = Solid_certificate;
  using Fragment = Claim::Fragment;
  static const std::vector<Lie<Claim>> all{
      {"another operation",
       [](Claim& claim, const Posed_scene&, Bytes& bytes) {
         const std::string other = name(set_operations[bytes.below(4)]);
         return std::exchange(claim.operation, other) != other;
       }},
      {"another rule",
       [](Claim& claim, const Posed_scene&, Bytes& bytes) {
         const std::string other = name(inside_rules[bytes.below(3)]);
         return std::exchange(claim.inside, other) != other;
       }},
      {"another fate",
       [](Claim& claim, const Posed_scene&, Bytes& bytes) {
         return in_a_fragment(claim, bytes, [&](Fragment& fragment) {
           const auto fate = static_cast<Claim::Fate>(bytes.below(3));
           return std::exchange(fragment.fate, fate) != fate;
         });
       }},
      {"all dropped",
       [](Claim& claim, const Posed_scene&, Bytes&) {
         bool changed = false;
         for (Fragment& fragment : claim.fragments)
           changed |= std::exchange(fragment.fate, Claim::Fate::dropped) != Claim::Fate::dropped;
         return changed;
       }},
      {"another winding number",
       [](Claim& claim, const Posed_scene&, Bytes& bytes) {
         return in_a_fragment(claim, bytes, [&](Fragment& fragment) {
           if (fragment.front.empty()) fragment.front.emplace_back(0, 1);
           else fragment.front.back().second += fragment.front.back().second == -1 ? 2 : 1;
           return true;
         });
       }},
      {"winding numbers and fates exchanged",
       [](Claim& claim, const Posed_scene&, Bytes& bytes) {
         if (claim.fragments.size() < 2) return false;
         Fragment &one = claim.fragments[any_of_first(claim.fragments, bytes)],
                  &other = claim.fragments[any_of_first(claim.fragments, bytes)];
         const bool alike = one.front == other.front && one.fate == other.fate;
         std::swap(one.front, other.front);
         std::swap(one.fate, other.fate);
         return !alike;
       }},
      {"a fragment left out",
       [](Claim& claim, const Posed_scene&, Bytes& bytes) { return remove_any(claim.fragments, bytes); }},
      {"a fragment twice",
       [](Claim& claim, const Posed_scene&, Bytes& bytes) {
         if (claim.fragments.empty()) return false;
         claim.fragments.push_back(claim.fragments[any_of_first(claim.fragments, bytes)]);
         return true;
       }},
      {"a part left out",
       [](Claim& claim, const Posed_scene&, Bytes& bytes) {
         return in_a_fragment(claim, bytes, [&](Fragment& fragment) { return remove_any(fragment.parts, bytes); });
       }},
      {"a part turned",
       [](Claim& claim, const Posed_scene&, Bytes& bytes) {
         return in_a_fragment(claim, bytes, [&](Fragment& fragment) {
           if (fragment.parts.empty()) return false;
           bool& is_turned = fragment.parts[any_of_first(fragment.parts, bytes)].turned;
           is_turned = !is_turned;
           return true;
         });
       }},
      {"a corner elsewhere",
       [](Claim& claim, const Posed_scene&, Bytes& bytes) {
         return in_a_fragment(claim, bytes, [&](Fragment& fragment) { return nudge_any(fragment.vertices, bytes); });
       }},
      {"a straight corner",
       [](Claim& claim, const Posed_scene&, Bytes& bytes) {
         return in_a_fragment(claim, bytes, [&](Fragment& fragment) {
           add_straight_corner(fragment.vertices, any_of_first(fragment.vertices, bytes));
           return true;
         });
       }},
      {"a fragment turned", [](Claim& claim, const Posed_scene&, Bytes& bytes) {
         return in_a_fragment(claim, bytes, [&](Fragment& fragment) {
           std::reverse(fragment.vertices.begin(), fragment.vertices.end());
           return true;
         });
       }}};
  return all;
}

// ---- What is true

/// Some solids, by winding numbers at points, and the volumes of what engines make of them, each once.
class Solid_truth {
 public:
  explicit Solid_truth(const Solids& solids) : solids_(solids), random_(1) {
    for (const Polygon_soup& solid : solids) oracles_.emplace_back(solid);
  }

  /// Requires the surface that the claim keeps to bound what its words say.
  void compare(const Solid_certificate& claim) {
    const auto operation = *std::find_if(set_operations.begin(), set_operations.end(),
                                         [&](Set_operation one) { return claim.operation == name(one); });
    const auto rule = *std::find_if(inside_rules.begin(), inside_rules.end(),
                                    [&](Inside_rule one) { return claim.inside == name(one); });
    // 1. By points, between corners.
    const Polygon_soup surface = surface_of(claim);
    const harness::Solid_oracle kept(surface);
    constexpr std::size_t points = 3;
    for (std::size_t k = 0; k < points && !claim.fragments.empty(); ++k) {
      const Exact_point p = middle(any_corner(claim), middle(any_corner(claim), any_corner(claim)));
      const auto holds = [&](const harness::Solid_oracle& one) { return one.is_on_a_face(p); };
      if (holds(kept) || std::any_of(oracles_.begin(), oracles_.end(), holds)) continue;
      Windings windings;
      for (std::uint32_t i = 0; i < oracles_.size(); ++i)
        if (const int number = oracles_[i].winding(p, random_)) windings.push_back({i, number});
      require(kept.winding(p, random_) == int{is_in_result(operation, rule, windings, oracles_.size())},
              "what is kept bounds the result");
    }
    // 2. By the engine's volume.
    const auto question = std::pair(operation, rule);
    const auto known = volumes_.find(question);
    Set_options options;
    options.operation = operation;
    options.inside = rule;
    const Rational& expected =
        known != volumes_.end()
            ? known->second
            : volumes_.emplace(question, volume(set_operation(Operands(solids_), options).soup)).first->second;
    require(volume(surface) == expected, "what is kept has the volume that the engine finds");
  }

 private:
  static Polygon_soup surface_of(const Solid_certificate& claim) {
    Polygon_soup surface;
    for (const Solid_certificate::Fragment& fragment : claim.fragments) {
      if (fragment.fate == Solid_certificate::Fate::dropped) continue;
      std::vector<Point_id> loop;
      for (const Exact_point& p : fragment.vertices) loop.push_back(surface.add_point(p[0], p[1], p[2]));
      if (fragment.fate == Solid_certificate::Fate::turned) std::reverse(loop.begin(), loop.end());
      surface.add_face(loop);
    }
    return surface;
  }
  const Exact_point& any_corner(const Solid_certificate& claim) {
    const Points& corners = claim.fragments[random_.below(claim.fragments.size())].vertices;
    return corners[random_.below(corners.size())];
  }

  const Solids& solids_;
  std::vector<harness::Solid_oracle> oracles_;
  generate::Random random_;
  std::map<std::pair<Set_operation, Inside_rule>, Rational> volumes_;
};

// ---- Forgeries of one certificate

/// Shows certificates of solids, as they are or one of them elsewhere, and lies, as those of the solids: what passes is
/// true.
inline Tallies judged_solid_forgeries(const Posed_scene& scene, Mutator& random) {
  constexpr std::size_t forgeries = 64, bytes_of_lies = 48, most_faces = 40, nonsense_share = 6;
  // 1. The solids, and those that the forger has.
  generate::Random choices(random.below(1u << 30));
  const Solids solids = harness::solids_of(scene, choices);
  std::size_t faces = 0;
  for (const Polygon_soup& solid : solids) faces += solid.face_count();
  if (faces == 0 || faces > most_faces) return {};
  Solids others = solids;
  std::string pretence = "the right one";
  if (random.below(3) == 0) {
    pretence = "a solid elsewhere";
    Exact_point step{0, 0, 0};
    step[random.below(3)] = generate::power_of_two(-static_cast<int>(random.below(60)));
    Polygon_soup& moved = others[random.below(others.size())];
    moved = generate::translated(moved, step);
  } else if (random.below(3) == 0) {
    pretence = "solids exchanged";
    std::swap(others.front(), others.back());
  }
  const Set_options options = harness::drawn_operation(random);
  const Operands operands(others);
  const Solid_certificate shown = solid_certificate(operands, options, set_operation(operands, options));

  // 2. What is shown, and whether it passes.
  Tallies tallies;
  Solid_truth truth(solids);
  for (std::size_t k = 0; k < forgeries; ++k) {
    Solid_certificate claim = shown;
    std::string what = pretence;
    if (k > 0) {
      const std::string words = random.random_bytes(bytes_of_lies);
      Bytes bytes(words);
      if (bytes.below(nonsense_share) == 0) {
        const std::string where = told_nonsense(claim, solids, bytes);
        if (where.empty()) continue;
        ++tallies["solids: nonsense"].rejected;
        if (verdict_on(solids, claim).accepted) throw Finding("nonsense about solids is accepted: " + where);
        continue;
      }
      const std::string lie = told_a_lie(lies_in(claim), claim, scene, bytes);
      if (lie.empty()) continue;
      what = pretence == "the right one" ? lie : "a lie about other solids";
    }
    Judged& judged = tallies["solids: " + what];
    if (const Verdict verdict = verdict_on(solids, claim); !verdict.accepted) {
      if (what == "the right one") throw Finding("a right certificate of solids is rejected: " + verdict.why);
      ++judged.rejected;
      continue;
    }
    ++judged.accepted;
    try {
      truth.compare(claim);
    } catch (const Finding& finding) {
      throw Finding(scene.name + ", solids, " + what + ": " + finding.what());
    }
    judged.the_truth += claim.operation == name(options.operation) && claim.inside == name(options.inside);
  }
  return tallies;
}

}  // namespace fuzz
