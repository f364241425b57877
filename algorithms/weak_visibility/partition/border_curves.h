#pragma once
// Where what a receiver sees of a source may change: lines and conics in the receiver's plane.

#include <sightline/algorithms/weak_visibility/events/curve_halves.h>
#include <sightline/algorithms/weak_visibility/events/edge_planes.h>
#include <sightline/algorithms/weak_visibility/events/event_curve.h>
#include <sightline/algorithms/weak_visibility/events/event_lines.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/partition/plane_chart.h>
#include <sightline/kernel/time_limit.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

namespace sightline {

/// What was looked at for borders.
struct Border_counters {
  std::size_t lines = 0;                             ///< of edges
  std::size_t planes = 0, pencils = 0, triples = 0;  ///< planes of edges and vertices, vertices in them, three edges
  std::size_t idle = 0;                              ///< of pencils and triples: not between the polygons, or blocked
  std::size_t curves = 0;                            ///< that were kept

  template <class Visit>
  static void each(Visit visit) {
    visit("lines", &Border_counters::lines);
    visit("planes", &Border_counters::planes);
    visit("pencils", &Border_counters::pencils);
    visit("triples", &Border_counters::triples);
    visit("idle", &Border_counters::idle);
    visit("curves", &Border_counters::curves);
  }
};

/// A curve, and rectangles of the chart that hold what matters of it.
struct Border_curve {
  Plane_curve curve;
  /// Whether it may bound where all is seen: an edge in the plane, or where a plane meets it that does not cross the
  /// source.
  bool may_end_light = false;
  std::vector<Plane_chart::Bounds> where;
};

/// Curves that hold, in those rectangles, all points of a receiver near which the edges that bound what it sees of a
/// source change, but for finitely many points: where planes of a vertex and an edge, or of two edges, meet the
/// receiver's plane, where lines that touch three skew edges do, and edges in it. What is surely blocked, in doubles,
/// is left out; curves are missing where time ran out, which stays so. `lines`: from the receiver, as source, to the
/// source, as target. Exact: no curve is missing. Ref: Plantinga. Proof: P-86
class Border_search {
 public:
  Border_search(const Occluders& occluders, const Event_lines& lines, const Plane_chart& chart,
                const std::function<bool()>& out_of_time, Border_counters& counters);
  std::vector<Border_curve> run();

 private:
  using Event_line = Event_lines::Event_line;
  using Points = Edge_planes::Points;

  const std::vector<Event_line>& lines() const { return lines_->lines(); }
  void add(const Plane_curve& curve, bool may_end_light, const std::vector<Plane_chart::Bounds>& where);

  void edges_in_the_plane();
  /// Where a source has a point in the receiver's plane: what is seen of it may vanish there.
  void lines_between_points_in_the_plane();
  /// Planes of two edges, with the points in which others meet them; and of a vertex and an edge, with the vertex.
  void planes();
  void pencils(const Edge_planes& planes, const Homogeneous& plane, const Points& vertices);
  void reguli();

  /// Whether lines among those given may go between the polygons.
  bool may_pass(std::span<const Near<6>> between) const {
    return lines_->may_pass(between, lines_->from()) && lines_->may_pass(between, lines_->to());
  }
  /// The parts of a curve of lines that may matter.
  std::vector<Plane_chart::Bounds> parts(const Event_curve& curve);
  bool out_of_time() { return has_run_out(out_of_time_); }

  static constexpr int deepest = 6;  // halves of halves
  const Occluders* occluders_;
  const Event_lines* lines_;
  const Plane_chart* chart_;
  std::function<bool()> out_of_time_;
  Border_counters* counters_;
  Curve_halves halves_;
  std::map<std::array<Integer, 6>, Border_curve, Less_entries> found_;
};

}  // namespace sightline
