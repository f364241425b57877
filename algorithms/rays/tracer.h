#pragma once
// What rays meet first, or at all: boxes, then faces in doubles with derived bounds, then exact numbers where these
// leave it open.

#include <sightline/algorithms/rays/ray.h>
#include <sightline/algorithms/rays/ray_boxes.h>
#include <sightline/algorithms/rays/whole_ray.h>
#include <sightline/kernel/counters.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sightline {

/// What rays took.
struct Ray_counters {
  std::uint64_t rays = 0, boxes = 0;           ///< rays; nodes of four boxes opened
  std::uint64_t pieces = 0, exact_pieces = 0;  ///< pieces looked at; of them, those where doubles left something open
  std::uint64_t exact_orders = 0;              ///< rays whose first hit doubles did not tell from another one
  template <class Visit>
  static void each(Visit visit) {
    visit("rays", &Ray_counters::rays);
    visit("boxes_opened", &Ray_counters::boxes);
    visit("pieces", &Ray_counters::pieces);
    visit("exact_pieces", &Ray_counters::exact_pieces);
    visit("exact_orders", &Ray_counters::exact_orders);
  }
};

/// Traces any number of rays in one scene. Faces are closed and met from both sides (proofs/semantics.md, rays).
/// Degenerate: a ray through an edge or a corner meets all faces that hold the point; one in a face's plane meets the
/// face in parts of itself; see Ray_start for origins on faces. Errors: std::domain_error for a zero direction. Cost:
/// O(n log n) to build; a ray that is not degenerate, what its boxes hold, in doubles. Thread-safe. Exact: filtered.
/// Proof: P-95
class Ray_tracer {
 public:
  /// Pre: the scene outlives the tracer.
  explicit Ray_tracer(Scene&&) = delete;
  explicit Ray_tracer(const Scene& scene);

  /// The hits of the least t, by face; none where nothing is met.
  std::vector<Face_hit> first(const Exact_ray& ray, Ray_start start, Ray_counters& counters) const;
  /// All hits, by t, then by face.
  std::vector<Face_hit> all(const Exact_ray& ray, Ray_start start, Ray_counters& counters) const;

  /// The first of first() for a ray in doubles, without its exact numbers: the face and the side are exact, t is
  /// between the bounds.
  struct Nearest {
    static constexpr Face_id nothing = ~Face_id{0};
    Face_id face = nothing;
    Met_side side = Met_side::front;
    bool tied = false;  ///< other faces are met there too
    double low = 0, high = 0;
  };
  Nearest nearest(const Double_ray& ray, Ray_start start, Ray_counters& counters) const;

 private:
  struct Ray;
  class Search;

  /// A piece for doubles, in two cache lines as a rule: its normal, and its corners within corner_error_.
  struct alignas(64) Flat {
    static constexpr std::uint32_t most = 4;
    std::uint32_t piece, size;
    std::array<double, 3> normal;  ///< each entry within 2^-51 of its own value, all times one factor
    std::array<std::array<double, 3>, most> corners;  ///< of more corners, [0][0] is the place of the first in more_
  };
  const std::array<double, 3>* corners(const Flat& flat) const {
    return flat.size <= Flat::most ? flat.corners.data() : &more_[static_cast<std::size_t>(flat.corners[0][0])];
  }

  /// Where a ray from farther than doubles go begins anew, before the scene; nothing where it passes the scene by.
  std::optional<Rational> start_from_afar(const Exact_ray& ray) const;
  Ray prepared(const Exact_ray& ray) const;
  Ray prepared(const Double_ray& ray) const;

  const Scene* scene_;
  Whole_ray::Grid grid_;
  Rational per_unit_;          ///< scaled coordinates per unit of the file; scaled ones are at most 1
  double scale_ = 1;           ///< scaled coordinates per approximate one: a power of two
  double about_per_unit_ = 0;  ///< per_unit_ within 2^-52; 0: doubles do not hold it
  std::array<std::array<double, 2>, 3> centre_{};  ///< of the grid, as a sum of two doubles
  double corner_error_ = 0;
  std::vector<Flat> flats_;  ///< in the order of the boxes
  std::vector<std::array<double, 3>> more_;
  std::vector<std::uint32_t> first_piece_;  ///< of each face: pieces [first_piece_[f], first_piece_[f + 1])
  std::vector<bool> is_flat_;               ///< of each face: all its pieces are in one plane
  Ray_boxes boxes_;
};

}  // namespace sightline
