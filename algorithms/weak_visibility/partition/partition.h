#pragma once
// Where the light of a polygon changes on a face: lit, penumbra, umbra, and their borders.

#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/partition/border_curves.h>
#include <sightline/algorithms/weak_visibility/partition/curve_arrangement.h>
#include <sightline/algorithms/weak_visibility/partition/plane_chart.h>
#include <sightline/algorithms/weak_visibility/partition/real_root.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/kernel/counters.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sightline {

/// What points of a face see of the sources: all of each, some of them, nothing; up to measure zero.
enum class Light : char { lit, penumbra, umbra, undecided };
inline constexpr std::size_t lights = 4;
const char* name_of(Light light);

struct Partition_counters {
  Border_counters borders;
  std::size_t boxes = 0, alike = 0;           ///< rectangles of the face; of these, seen alike from everywhere
  std::size_t arrangements = 0, sectors = 0;  ///< the others, with curves between them; what these divide them into

  template <class Visit>
  static void each(Visit visit) {
    visit("borders", &Partition_counters::borders);
    visit("boxes", &Partition_counters::boxes);
    visit("alike", &Partition_counters::alike);
    visit("arrangements", &Partition_counters::arrangements);
    visit("sectors", &Partition_counters::sectors);
  }
};

struct Partition_options {
  bool all_borders = false;  ///< also where the edges that bound what is seen change
  std::function<bool()> out_of_time;
  std::function<void(double share)> progress;
};

/// A convex piece of a face, divided. Coordinates x, y are of its chart: a point is origin + x u + y v.
struct Light_partition {
  std::uint32_t piece;
  std::array<Exact_point, 3> chart;  ///< origin, u, v, in the file's coordinates
  std::vector<Plane_curve> curves;

  /// An open connected set from all of whose points, but for curves, the same is seen.
  struct Cell {
    Light light;
    std::array<Rational, 2> at;  ///< a point of it
    Bounded area;                ///< as a share of the piece
    /// The edges that bound what is seen of each source, where all borders are asked for: two points on each.
    std::vector<std::vector<std::array<Exact_point, 2>>> edges;
  };
  std::vector<Cell> cells;

  /// A part of a curve between two cells: over an interval of x the lower or the upper of its two values of y, or the
  /// only one. `none`: outside the piece.
  struct Border {
    std::size_t curve;
    bool upper;
    std::size_t below, above;     ///< cells
    std::array<Bounded, 2> x, y;  ///< of its ends
  };
  /// Where a curve is x = constant.
  struct Upright {
    Bounded x;
    std::size_t left, right;
    std::array<Bounded, 2> y;
  };
  static constexpr std::size_t none = ~std::size_t{0};
  std::vector<Border> borders;
  std::vector<Upright> uprights;

  /// What a cell consists of, between two values of x, for pictures: points of its lower and of its upper border.
  struct Strip {
    std::size_t cell;
    std::vector<std::array<double, 2>> lower, upper;
  };
  std::vector<Strip> strips;
  /// Points of borders, a part of one in each.
  std::vector<std::vector<std::array<double, 2>>> border_lines;

  std::array<Bounded, lights> shares() const;  ///< of the piece
  /// The cell that a point is in. `none`: outside of the piece, on a border, or straight above or below an end of one
  /// as far as doubles tell. Pre: no cell is undecided. Cost: all borders. Exact: yes
  std::size_t cell_at(const Rational& x, const Rational& y) const;
};

/// Of a face that consists of these pieces. Surfaces that are not planar have roots as areas. Exact: bounds
std::array<Bounded, lights> shares_of_face(const Scene& scene, std::span<const Light_partition> pieces);

/// The partition of the front of a piece by what it sees of sources. Cells of one light are
/// one where doubles tell that a stretch of their border is open; so a region may come as several cells where it is as
/// narrow as doubles are. Degenerate: what is behind a source's plane, or in it, sees nothing of it; a source that
/// is partly behind the piece's plane is never seen whole. Cost: candidates for borders as events; an arrangement of
/// those in each rectangle of a grid that is as fine as they are dense. Exact: yes; `undecided` where time ran out.
/// Ref: Plantinga; Demouth, Devillers, Everett, Glisse, Lazard, Seidel. Proof: P-86
class Light_partitioner {
 public:
  /// Of all pieces of the scene as occluders, which it merges.
  explicit Light_partitioner(const Scene& scene);
  ~Light_partitioner();
  /// `sources`: convex polygons in the file's coordinates. Errors: std::invalid_argument, as weak_source().
  Light_partition partition(std::uint32_t piece, const std::vector<std::vector<Exact_point>>& sources,
                            const Partition_options& options, Partition_counters& counters) const;

 private:
  const Scene* scene_;
  struct Merged;
  std::unique_ptr<const Merged> merged_;
};

}  // namespace sightline
