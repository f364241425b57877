#pragma once
// Checks a set operation on solids without trusting, or sharing a line with, whatever made it: rationals and integers,
// where doubles with a bound on their error do not tell. Laws: proofs/solids.md (P-115).

#include <sightline/algorithms/verify/verdict.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sightline {

/// The claim "the operands' faces are these fragments; just before each of them the operands wind round so often; so
/// the result is on one side only of those that are kept, which are its boundary".
struct Solid_certificate {
  std::string operation;  ///< union, intersection, difference (the first less all others), symmetric-difference
  std::string inside;     ///< positive, nonzero, odd
  std::uint32_t operands = 0;

  struct Part {  ///< of a face; `turned`: its front is the fragment's back
    std::uint32_t operand = 0;
    Face_id face = 0;
    std::uint32_t piece = 0;
    bool turned = false;
  };
  enum class Fate { dropped, kept, turned };
  struct Fragment {
    std::vector<Part> parts;            ///< all faces that hold it; the first gives it its front
    std::vector<Exact_point> vertices;  ///< convex, counterclockwise as seen from its front
    /// How often operands wind round the points just before its front, where that is not 0; operands ascending.
    std::vector<std::pair<std::uint32_t, int>> front;
    Fate fate = Fate::dropped;  ///< turned: the result is before its front
  };
  std::vector<Fragment> fragments;

  struct Piece {  ///< of a face that is cut into convex ones, or not planar
    std::uint32_t operand = 0;
    Face_id face = 0;
    std::uint32_t piece = 0;
    std::vector<Exact_point> vertices;
  };
  std::vector<Piece> pieces;
  struct Set_aside {
    std::uint32_t operand = 0;
    Face_id face = 0;
    std::string why;
  };
  std::vector<Set_aside> set_aside;
};

/// Whether the certificate proves the result of a set operation on the operands: (1) each operand is closed, and its
/// faces are tiled by the fragments that name them; (2) no fragment has points of another one inside it, but for single
/// points; (3) the winding numbers before its front are right, by a ray from it or from one it hangs together with; (4)
/// it is kept iff the result is on one side of it only, and turned iff that is its front; (5) the boundaries of what is
/// kept cancel. With a result, that (6) its faces are, plane by plane, what is kept, and none crosses itself.
/// Degenerate: faces upon each other have common fragments; nothing kept is an empty result. Pre: none on the
/// certificate; rejects whatever is wrong with it. Post: `why` is one line. Cost: O(n log n) for n fragments, and the
/// pairs of which boxes meet, and the boxes that a ray from each patch meets; quadratic at worst. Exact: yes. Proof:
/// P-115
Verdict verify_solids(std::span<const Polygon_soup> operands, const Solid_certificate& certificate,
                      const Polygon_soup* result = nullptr, const Verify_options& options = {});

}  // namespace sightline
