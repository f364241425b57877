#pragma once
// Planes that have polygons on both sides and cut none: what lets each side be ordered alone (Schumacker's clusters,
// Naylor's inter-object trees).

#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/partition_traits.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace sightline {

/// The plane of a face, or a plane with coefficients in doubles, in the coordinates of the file, that has a gap around
/// it.
struct Separating_plane {
  Plane face;                    ///< valid where it is a face's
  std::array<double, 4> free{};  ///< a x + b y + c z + d otherwise; in front where that is positive

  bool is_free() const { return !face.valid(); }
};

/// The side of an eye. Exact: yes.
template <class Traits>
Sign side_of(const Traits& traits, const Separating_plane& plane, const Exact_point& eye,
             const typename Traits::Eye& viewpoint, Predicate_counts& counts) {
  if (!plane.is_free()) return traits.side(viewpoint, plane.face, counts);
  Rational value = exact(plane.free[3]);
  for (std::size_t k = 0; k < 3; ++k) value += exact(plane.free[k]) * eye[k];
  ++counts.gmp;
  return static_cast<Sign>(sgn(value));
}

/// position(), but a polygon's own plane holds it without a look at its corners.
template <class Traits>
Position position_to(const Traits& traits, const Convex_polygon<Traits>& polygon, const typename Traits::Cutter& cutter,
                     Plane plane, Predicate_counts& counts) {
  return traits.same_plane(polygon.support, plane) ? Position::on : position(traits, polygon, cutter, counts);
}

/// Some polygons, and where they lie to a plane that cuts none of them.
struct Separation {
  Separating_plane plane;
  std::array<std::vector<std::uint32_t>, 3> sides;  ///< on, behind, in front: by Position
};

/// Looks for such planes among the polygons that were added to it.
template <class Traits>
class Separation_finder {
 public:
  using Polygon = Convex_polygon<Traits>;

  /// Pre: the traits outlive it. Exact traits, or what kernels.h says.
  explicit Separation_finder(Traits&&) = delete;
  explicit Separation_finder(const Traits& traits) : traits_(&traits) {}

  /// Pre: the polygon's corners outlive the finder. Cost: an exact position a corner.
  void add(const Polygon& polygon) {
    polygons_.push_back(polygon);
    for (const Corner<Traits>& corner : polygon) {
      const Exact_point p = traits_->position(*corner.vertex);
      corners_.push_back({nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])});
      for (const double x : corners_.back()) range_ = std::max(range_, std::fabs(x));
    }
    begin_.push_back(static_cast<std::uint32_t>(corners_.size()));
    normals_.push_back(normal(begin_.size() - 2));
  }

  /// A plane that cuts no member and leaves at least `least` of them strictly on each side: the one found that leaves
  /// the fewest on its larger side. Across each of the three axes and of up to `directions` normals of members it looks
  /// at all faces' planes and all gaps. Nothing where those have no such plane; others may. Degenerate: members that
  /// touch the plane are on their side of it; members in it are on it. Cost: O(n log n) a direction. Exact: yes.
  std::optional<Separation> find(std::span<const std::uint32_t> members, std::size_t least, std::size_t directions,
                                 Predicate_counts& counts) {
    if (!std::isfinite(4 * range_)) return std::nullopt;
    candidates_.clear();
    collect_directions(members, directions);
    for (const Triple& direction : directions_) {
      if (tick) tick();
      sweep(members, direction, least);
    }
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.larger < b.larger; });
    if (candidates_.size() > tried) candidates_.resize(tried);
    for (const Candidate& candidate : candidates_) {
      if (tick) tick();
      if (std::optional<Separation> found = candidate.plane.is_free() ? divided_by_gap(members, candidate)
                                                                      : divided_by_face(members, candidate, counts);
          found && std::min(found->sides[1].size(), found->sides[2].size()) >= least)
        return found;
    }
    return std::nullopt;
  }

  std::function<void()> tick = {};  ///< called before each direction and each candidate; what it throws ends find()

 private:
  static constexpr std::size_t tried = 16;  // candidates that are decided exactly
  struct Candidate {
    std::size_t larger;  ///< members on the larger side, about
    Separating_plane plane;
  };
  struct Extent {
    double low, high;
    std::uint32_t member;
    double place;  // where it stands in the sweep
  };

  std::span<const Triple> corners(std::uint32_t i) const {
    return std::span(corners_).subspan(begin_[i], begin_[i + std::size_t{1}] - begin_[i]);
  }

  /// Scaled to largest entry 1, that entry being positive; zero where doubles do not tell.
  Triple normal(std::size_t i) const {
    const std::span<const Triple> c = corners(static_cast<std::uint32_t>(i));
    Triple sum{};
    for (std::size_t k = 1; k + 1 < c.size(); ++k)
      for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t p = (a + 1) % 3, q = (a + 2) % 3;
        sum[a] += (c[k][p] - c[0][p]) * (c[k + 1][q] - c[0][q]) - (c[k][q] - c[0][q]) * (c[k + 1][p] - c[0][p]);
      }
    double largest = 0;
    for (const double x : sum)
      if (std::fabs(x) > std::fabs(largest)) largest = x;
    for (double& x : sum) x /= largest;
    return std::isfinite(sum[0] + sum[1] + sum[2]) ? sum : Triple{};
  }

  void collect_directions(std::span<const std::uint32_t> members, std::size_t most) {
    directions_ = {Triple{1, 0, 0}, Triple{0, 1, 0}, Triple{0, 0, 1}};
    seen_.clear();
    const auto key = [](const Triple& d) {
      return std::array<long, 3>{std::lrint(d[0] * 0x1p24), std::lrint(d[1] * 0x1p24), std::lrint(d[2] * 0x1p24)};
    };
    for (const Triple& d : directions_) seen_.insert(key(d));
    // From all over the list, as neighbours in it tend to be alike.
    const std::size_t n = members.size(), stride = most > 0 && n > 2 * most ? n / most | 1 : 1;
    std::size_t looked = 0;
    for (std::size_t k = 0; looked < n && looked < 4 * most && directions_.size() < most + 3;
         ++looked, k = (k + stride) % n) {
      const Triple& d = normals_[members[k]];
      if (d != Triple{} && seen_.insert(key(d)).second) directions_.push_back(d);
    }
  }

  /// Three products of a coordinate, off by 2^-53 of the range, with an entry of at most 1, and two sums: each of the
  /// eight roundings is below 2^-53 x 3 range.
  double projection_error() const { return 0x1p-48 * range_ + 0x1p-1000; }

  Extent extent(std::uint32_t member, const Triple& direction) const {
    Extent e{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), member, 0};
    for (const Triple& corner : corners(member)) {
      const double value = dot(direction, corner);
      e.low = std::min(e.low, value);
      e.high = std::max(e.high, value);
    }
    return e;
  }

  /// Candidates across a direction: gaps, and planes of faces that lie between what is behind and what is in front.
  void sweep(std::span<const std::uint32_t> members, const Triple& direction, std::size_t least) {
    const double error = projection_error();
    extents_.clear();
    for (const std::uint32_t member : members) {
      Extent& e = extents_.emplace_back(extent(member, direction));
      e.place = is_flat(e, direction) ? e.low - 8 * error
                                      : e.low;  // before what touches it from the front, however that is rounded
    }
    std::sort(extents_.begin(), extents_.end(), [](const Extent& a, const Extent& b) {
      return a.place != b.place ? a.place < b.place : a.high != b.high ? a.high < b.high : a.member < b.member;
    });
    const std::size_t n = extents_.size();
    double reached = -std::numeric_limits<double>::infinity(), last_face = reached;
    std::array<std::optional<Candidate>, 2> best;  // gap, face
    const auto offer = [&](std::size_t behind, std::size_t front, const Separating_plane& plane) {
      if (std::min(behind, front) < least) return;
      std::optional<Candidate>& place = best[!plane.is_free()];
      if (const std::size_t larger = std::max(behind, front); !place || larger < place->larger) place = {larger, plane};
    };
    for (std::size_t k = 0; k < n; ++k) {
      const Extent& e = extents_[k];
      if (k > 0 && e.low - reached > 32 * error) {
        const double middle = reached + (e.low - reached) / 2;
        offer(k, n - k, {{}, {direction[0], direction[1], direction[2], -middle}});
      }
      if (reached <= e.low + 4 * error && e.low > last_face + 4 * error && is_flat(e, direction)) {
        std::size_t next = k + 1;
        while (next < n && extents_[next].high <= e.high + 4 * error) ++next;
        if (next == n || extents_[next].low >= e.high - 4 * error)
          offer(k, n - next, {polygons_[e.member].support, {}});
        last_face = e.low;
      }
      reached = std::max(reached, e.high);
    }
    for (const auto& candidate : best)
      if (candidate) candidates_.push_back(*candidate);
  }
  /// Whether a member's plane is across the direction, as far as doubles tell.
  bool is_flat(const Extent& e, const Triple& direction) const {
    return e.high - e.low <= 4 * projection_error() && parallel(normals_[e.member], direction);
  }
  static bool parallel(const Triple& a, const Triple& b) {
    return a != Triple{} && std::fabs(a[0] - b[0]) + std::fabs(a[1] - b[1]) + std::fabs(a[2] - b[2]) < 0x1p-20;
  }

  /// Nothing where the plane is not proved to have room on both sides.
  std::optional<Separation> divided_by_gap(std::span<const std::uint32_t> members, const Candidate& candidate) const {
    const auto& [a, b, c, d] = candidate.plane.free;
    const double error = projection_error();
    Separation found{candidate.plane, {}};
    for (const std::uint32_t member : members) {
      const Extent e = extent(member, {a, b, c});
      if (e.high + error < -d) found.sides[1].push_back(member);
      else if (e.low - error > -d) found.sides[2].push_back(member);
      else return std::nullopt;
    }
    return found;
  }
  std::optional<Separation> divided_by_face(std::span<const std::uint32_t> members, const Candidate& candidate,
                                            Predicate_counts& counts) const {
    const auto cutter = traits_->prepare(candidate.plane.face);
    Separation found{candidate.plane, {}};
    for (const std::uint32_t member : members) {
      const Position at = position_to(*traits_, polygons_[member], cutter, candidate.plane.face, counts);
      if (at == Position::across) return std::nullopt;
      found.sides[static_cast<std::size_t>(at)].push_back(member);
    }
    return found;
  }

  const Traits* traits_;
  std::vector<Polygon> polygons_;
  std::vector<Triple> corners_, normals_, directions_;
  std::vector<std::uint32_t> begin_{0};
  double range_ = 0;
  std::set<std::array<long, 3>> seen_;
  std::vector<Extent> extents_;
  std::vector<Candidate> candidates_;
};

}  // namespace sightline
