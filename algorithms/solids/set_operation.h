#pragma once
// Set operations on solids, exactly: union, intersection, difference, symmetric difference of any number of them.

#include <sightline/algorithms/solids/operands.h>
#include <sightline/algorithms/solids/winding.h>
#include <sightline/kernel/counters.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/sign.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sightline {

enum class Set_operation { unite, intersect, subtract, differ };  ///< subtract: the first less all others
inline constexpr std::array<Set_operation, 4> set_operations{Set_operation::unite, Set_operation::intersect,
                                                             Set_operation::subtract, Set_operation::differ};

/// Where an operand is: by its winding number.
enum class Inside_rule { positive, nonzero, odd };
inline constexpr std::array<Inside_rule, 3> inside_rules{Inside_rule::positive, Inside_rule::nonzero, Inside_rule::odd};

/// "union", "intersection", "difference", "symmetric-difference"
const char* name(Set_operation operation);
/// "positive", "nonzero", "odd"
const char* name(Inside_rule rule);

/// Whether a point is in the result, given the winding numbers of `operands` operands there. Of no operands nothing is.
bool is_in_result(Set_operation operation, Inside_rule rule, std::span<const Winding> windings, std::size_t operands);

struct Set_options {
  Set_operation operation = Set_operation::unite;
  Inside_rule inside = Inside_rule::positive;
  bool keep_fragments = false;  ///< for a certificate
  /// Called from any thread; what it throws ends the operation, and comes out of it.
  std::function<void(std::size_t done, std::size_t all)> progress = {};
};

/// A face of the result: part of a face of an operand, turned round where it bounds a hole that this one cuts.
struct Result_face {
  std::uint32_t operand;
  Face_id face;  ///< of the operand
  bool turned;
};

/// An edge that has another number of faces than two.
struct Crowded_edge {
  Point_id from, to;
  std::uint32_t faces;
};

/// A convex part of the operands' faces that no other face crosses, as certificates have it.
struct Result_fragment {
  /// A piece of a face that holds it. `turned`: its front is the fragment's back.
  struct Part {
    Face_id face;  ///< counted on through all operands
    std::uint32_t piece;
    bool turned;
  };
  enum class Fate { dropped, kept, turned };

  std::vector<Part> parts;  ///< of all operands; the first gives the fragment its front
  std::vector<Exact_point> corners;
  Windings front;
  Fate fate = Fate::dropped;
};

struct Set_counters {
  std::size_t faces = 0, pieces = 0, planes = 0, bits = 0, pairs = 0, touched = 0, cuts = 0, fragments = 0, kept = 0,
              rays = 0, vertices = 0;
  Predicate_counts predicates;
  template <class Visit>
  static void each(Visit visit) {
    visit("faces", &Set_counters::faces);
    visit("pieces", &Set_counters::pieces);
    visit("planes", &Set_counters::planes);
    visit("pairs", &Set_counters::pairs);
    visit("touched", &Set_counters::touched);
    visit("cuts", &Set_counters::cuts);
    visit("fragments", &Set_counters::fragments);
    visit("kept", &Set_counters::kept);
    visit("rays", &Set_counters::rays);
    visit("new_vertices", &Set_counters::vertices);
    visit("predicates", &Set_counters::predicates);
  }
};

struct Set_result {
  Polygon_soup soup;  ///< faces planar, oriented, their holes as loops; points in use only, each once
  std::vector<Result_face> faces;
  std::vector<Crowded_edge> crowded;
  std::vector<Result_fragment> fragments;
  Set_counters counters;
};

/// The boundary of the set of all points that have a neighbourhood in the result: faces of the operands where the
/// result is on one side only, fronts outwards.
/// Pre: flaws(operands) is empty. Post: the soup is closed; no vertex lies inside an edge; all that is left of a face,
/// and turned the same way, is one face for each part that hangs together. Degenerate: what has no volume vanishes;
/// faces upon each other count as often as they are given, and the first of them gives its name; an empty result has no
/// faces. The same for any number of threads.
/// Cost: O(n log n + k log k), k what meets. Exact: yes. Proof: P-113
Set_result set_operation(const Operands& operands, const Set_options& options);

}  // namespace sightline
