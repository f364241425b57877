#pragma once
// A piece as its light is found: rectangles, the sectors of those that borders cross, and cells of sectors.

#include <sightline/algorithms/weak_visibility/partition/border_curves.h>
#include <sightline/algorithms/weak_visibility/partition/curve_arrangement.h>
#include <sightline/algorithms/weak_visibility/partition/partition.h>
#include <sightline/algorithms/weak_visibility/partition/plane_chart.h>
#include <sightline/kernel/time_limit.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sightline::partition_detail {

/// A source as a piece sees it.
struct Seen_source {
  std::size_t number;  ///< among all sources
  Filtered plane;
  bool whole;  ///< all of it is in front of the piece
  Event_lines lines;
};

/// The state of a rectangle: what may block lines from it to each source.
using Blockers = std::vector<std::vector<std::uint32_t>>;

class Partition_builder {
 public:
  Partition_builder(const Occluders& occluders, const Near_polygon& piece, const Near_plane& plane,
                    const std::vector<Weak_source>& sources, const Partition_options& options,
                    Partition_counters& counters);
  void run(Light_partition& result);

 private:
  /// A curve between sectors, within a slab.
  struct Leaf {
    Curve_arrangement arrangement;
    std::vector<std::size_t> curves;  // of the arrangement, by number
    std::vector<std::size_t> first;   // the lowest sector of each slab
    Chart_box box;
  };
  struct Sector {
    bool inside;
    Light light;
    std::size_t outline;  // where all borders are asked for: the number of its edges
    Rational x, y;
    double size;
  };
  /// A stretch of a side of a rectangle that a sector touches.
  struct Touch {
    double from, to;
    std::size_t sector;
  };
  struct Side {
    std::vector<Touch> before, after;  // of rectangles left of it, or below; and the others
  };

  /// `edges`, by number: those of the piece that may cross the box; it is within the others.
  void divide(const Chart_box& box, const Blockers& blockers, const std::vector<std::size_t>& curves,
              const std::vector<std::size_t>& edges, int depth);
  /// What is known of all points of a rectangle, or nothing. Leaves out what blocks nothing from it.
  std::optional<Light> alike(const std::array<Filtered, 4>& corners, Blockers& blockers) const;
  /// Whether somewhere all that can be proved of a rectangle by a few points of sources: that each of its points sees
  /// one of them, or one of them is hidden from all.
  void probe(const std::array<Filtered, 4>& corners, const Blockers& blockers, bool& some_seen,
             bool& some_hidden) const;
  /// `edges`: those of the piece whose lines cross the box, which are among the curves. Undecided where time runs out.
  void arrange(const Chart_box& box, const std::vector<std::size_t>& edges, const std::vector<std::size_t>& curves,
               const Blockers& blockers, std::optional<Light> known);
  /// The lines of edges, as curves, in order.
  std::vector<std::size_t> lines_of(const std::vector<std::size_t>& edges) const;
  /// Of edges alone, between their corners: linear, where their lines cross as often as there are pairs. `own`: the
  /// curves themselves.
  Curve_arrangement outline(const Chart_box& box, const std::vector<std::size_t>& edges,
                            const std::vector<std::size_t>& curves, const std::vector<Plane_curve>& own) const;
  bool is_in_a_plane(const Homogeneous& point, const Blockers& blockers) const;
  /// A point in the plane of a piece does not see it: another one of the same sector, that is in none.
  void leave_planes(Sector& sector, const std::vector<Plane_curve>& curves, const Chart_box& box,
                    const Blockers& blockers) const;
  void classify(Sector& sector, const Blockers& blockers);
  bool is_inside(const std::vector<std::size_t>& edges, const Rational& x, const Rational& y) const;

  void join_leaf(std::size_t leaf);
  void join_sides(std::map<double, Side>& sides, bool upright);
  void meet(std::size_t a, std::size_t b) { contacts_.push_back({a, b}); }
  std::size_t root(std::size_t sector);

  void collect_cells(Light_partition& result);
  void join_alike();
  void measure_sectors();
  void number_cells(Light_partition& result);
  void measure_cells(Light_partition& result);
  void name_edges(Light_partition& result) const;

  void collect_borders(Light_partition& result);
  void collect_arcs(Light_partition& result) const;
  void collect_uprights(Light_partition& result) const;
  void collect_strips(Light_partition& result) const;

  /// Once time is out it stays so: where candidates may be missing nothing is decided.
  bool is_over() { return is_over_ |= has_run_out(options_->out_of_time); }

  const Occluders* occluders_;
  const Partition_options* options_;
  Partition_counters* counters_;
  Plane_chart chart_;
  std::vector<Seen_source> sources_;
  std::size_t never_seen_ = 0;                 // sources that face away
  std::vector<std::vector<Filtered>> probes_;  // points of each source
  std::vector<Border_curve> curves_;
  /// An edge of the piece.
  struct Edge {
    Plane_curve inwards;  // its line, the piece where it is > 0
    std::size_t curve;
    std::array<std::array<Rational, 2>, 2> ends;
  };
  std::vector<Edge> rim_;
  Rational piece_area_;
  std::vector<Leaf> leaves_;
  std::vector<Sector> sectors_;
  std::vector<std::array<std::size_t, 2>> contacts_;
  struct Upright_contact {
    double x0, x1;
    std::size_t left, right;
    double y0, y1;
  };
  std::vector<Upright_contact> uprights_;
  std::map<double, Side> upright_sides_, level_sides_;
  std::map<std::vector<std::vector<std::uint32_t>>, std::size_t> outlines_;
  std::vector<std::size_t> parents_, cell_of_;
  double done_ = 0;
  bool is_over_ = false;
};

}  // namespace sightline::partition_detail
