// To be read after faces.h, contour.h, surface.h and verdict.h.

#include <sightline/algorithms/verify/set_aside.h>

#include <sightline/algorithms/verify/contour.h>
#include <sightline/algorithms/verify/surface.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/kernel/scene/set_aside.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sightline::certificate_check {

bool self_intersecting(const Face& face) {
  const Contour contour = seen_from_front(face.loops, face.plane);
  return contour.crosses_itself() || contour.winding() == Contour::Winding::other;
}

bool same_cycle(const Polygon& a, const Polygon& b) {
  const std::size_t n = a.size();
  if (n != b.size()) return false;
  if (n == 0) return true;
  // Knuth, Morris and Pratt: b in a told twice, whatever comes again and again in them.
  std::vector<std::size_t> border(n + 1);  // of the first so many of b how many begin and end them
  for (std::size_t k = 1, length = 0; k < n; border[++k] = length) {
    while (length > 0 && b[k] != b[length]) length = border[length];
    length += b[k] == b[length];
  }
  for (std::size_t k = 0, length = 0; k < 2 * n; ++k) {
    while (length > 0 && a[k % n] != b[length]) length = border[length];
    length += a[k % n] == b[length];
    if (length == n) return true;
  }
  return false;
}

namespace {

void check_zero_area(const std::string& what, const Face& face) {
  Boundary_chain boundary, outer;
  boundary.add(face.loops, 1);
  outer.add(face.loops[0], 1);
  const bool no_area = !boundary.nonzero() || !outer.nonzero();
  if (!no_area) reject(what + " is set aside for zero area but has area");
}

/// Loop by loop the same cycles, holes in either sense.
bool same_loops(const Face& a, const Face& b) {
  if (a.loops.size() != b.loops.size() || !same_cycle(a.loops[0], b.loops[0])) return false;
  for (std::size_t k = 1; k < a.loops.size(); ++k)
    if (!same_cycle(a.loops[k], b.loops[k]) && !same_cycle(a.loops[k], Polygon(b.loops[k].rbegin(), b.loops[k].rend())))
      return false;
  return true;
}

/// `digits`: what stands behind "duplicate of ".
void check_duplicate(const std::string& what, const Polygon_soup& soup, const Face& face, Face_id own,
                     std::string_view digits, const std::set<Face_id>& set_aside) {
  std::uint64_t original = 0;
  std::size_t count = 0;
  for (const char c : digits) {
    if (c < '0' || c > '9') break;
    original = std::min(10 * original + static_cast<std::uint64_t>(c - '0'), std::uint64_t{1} << 32);
    ++count;
  }
  if (count == 0 || original >= own) reject(what + " is set aside as a duplicate, but not of an earlier face");
  const Face_id f = static_cast<Face_id>(original);
  if (set_aside.count(f))
    reject(what + " is set aside as a duplicate of face " + std::to_string(f) + ", which is set aside itself");
  const Face other(soup, f);
  if (!same_loops(face, other))
    reject(what + " is set aside as a duplicate of face " + std::to_string(f) + " but differs from it");
}

void check_self_intersecting(const std::string& what, const Face& face) {
  if (!face.planar) reject(what + " is set aside as self-intersecting but is not planar");
  if (is_zero(face.plane.normal) || !self_intersecting(face))
    reject(what + " is set aside as self-intersecting but is not");
}

void check_no_simple_projection(const std::string& what, const Face& face) {
  const std::string aside = what + " is set aside as simple along no axis but ";
  if (face.planar) reject(aside + "is planar");
  const Skew_face skew(face);
  if (skew.loops.size() == 1) reject(aside + "has no holes");
  if (const auto axis = skew.axis()) reject(aside + "is along axis " + "xyz"[*axis]);
}

}  // namespace

void check_set_aside(const Polygon_soup& soup, const Covering::Set_aside& entry, const std::set<Face_id>& set_aside) {
  const std::string what = name("face", entry.face);
  const std::optional<Set_aside_reason> reason = set_aside_reason(entry.why);
  if (!reason) reject(what + " is set aside for no reason that can be checked");
  const Face face(soup, entry.face);
  switch (*reason) {
    case Set_aside_reason::zero_area: return check_zero_area(what, face);
    case Set_aside_reason::duplicate:
      return check_duplicate(what, soup, face, entry.face, std::string_view(entry.why).substr(text_of(*reason).size()),
                             set_aside);
    case Set_aside_reason::self_intersecting: return check_self_intersecting(what, face);
    case Set_aside_reason::no_simple_projection: return check_no_simple_projection(what, face);
  }
}

}  // namespace sightline::certificate_check
