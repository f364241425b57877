#pragma once
// Plantinga's events between one source and one target: the lines that touch edges where visibility changes, and
// exactly what is free beside them.

#include <sightline/algorithms/weak_visibility/events/active_subranges.h>
#include <sightline/algorithms/weak_visibility/events/curve_halves.h>
#include <sightline/algorithms/weak_visibility/events/edge_planes.h>
#include <sightline/algorithms/weak_visibility/events/event_cells.h>
#include <sightline/algorithms/weak_visibility/events/event_curve.h>
#include <sightline/algorithms/weak_visibility/events/event_lines.h>
#include <sightline/algorithms/weak_visibility/events/quadratic_roots.h>
#include <sightline/algorithms/weak_visibility/events/sign_cover.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/kernel/counters.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/time_limit.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

namespace sightline {

/// What a search by events modelled.
struct Event_counters {
  std::size_t targets = 0;  ///< pairs of a source and a piece
  /// Of these, decided at once: facing away, by one of a few lines, hidden by one piece alone.
  std::size_t away = 0, by_rays = 0, in_shadow = 0;
  std::size_t shafts = 0, shafts_covered = 0, shafts_together = 0,
              shafts_left = 0;  ///< parts of pairs; of these, blocked by one piece, or by several; searched by events
  std::size_t occluders = 0, lines = 0;  ///< ways in which a piece can block; lines of edges; summed over pairs
  std::size_t untouched = 0,
              unpaired = 0;  ///< edges, and skew pairs of them, that no line between the polygons touches
  std::size_t horizon = 0, edge_vertex = 0,
              triple = 0;  ///< potential events: in a plane of edges, through a vertex and an edge, through three edges
  /// How often something leads nowhere: an event, one of several ranges of it, or a plane or a point before an event of
  /// it is counted. No line touches all edges between source and target; none goes from one to the other; all are
  /// blocked.
  std::size_t off_edges = 0, off_polygons = 0, covered = 0;
  std::size_t subranges = 0, cells = 0;    ///< active subranges that were looked at, and cells of lines beside them
  std::size_t confirmed = 0, refuted = 0;  ///< sightlines proposed, by the exact test of all pieces

  /// Each by its key in reports, in their order.
  template <class Visit>
  static void each(Visit visit) {
    visit("searches", &Event_counters::targets);
    visit("", &Event_counters::away);
    visit("", &Event_counters::by_rays);
    visit("in_shadow", &Event_counters::in_shadow);
    visit("shafts", &Event_counters::shafts);
    visit("shafts_covered", &Event_counters::shafts_covered);
    visit("shafts_together", &Event_counters::shafts_together);
    visit("shafts_left", &Event_counters::shafts_left);
    visit("", &Event_counters::occluders);
    visit("", &Event_counters::lines);
    visit("untouched", &Event_counters::untouched);
    visit("unpaired", &Event_counters::unpaired);
    visit("horizon", &Event_counters::horizon);
    visit("edge_vertex", &Event_counters::edge_vertex);
    visit("triple", &Event_counters::triple);
    visit("off_edges", &Event_counters::off_edges);
    visit("off_polygons", &Event_counters::off_polygons);
    visit("covered", &Event_counters::covered);
    visit("subranges", &Event_counters::subranges);
    visit("cells", &Event_counters::cells);
    visit("", &Event_counters::confirmed);
    visit("", &Event_counters::refuted);
  }
};

struct Events_options {
  bool two_sided = false;
  int rays = 24;  ///< lines that are tried before events
  std::uint64_t seed = 1;
  std::size_t events = 20000000;  ///< potential events that a pair may have; then `undecided`
  std::size_t undivided = 8;      ///< edges of a pair, or of a part of one, up to which it is not divided
  bool surfaces = false;  ///< whether to keep event surfaces: then all of them, also where a line is free before
  int threads = 0;        ///< 0: as many as there are processors
  std::function<bool()> out_of_time;                                ///< asked before each event, and more often
  std::function<void(std::size_t done, std::size_t all)> progress;  ///< faces; called by any thread
};

struct Events_answer {
  Weak_status status = Weak_status::undecided;
  std::array<Near_point, 2> sightline;  ///< where visible: strictly inside source and target
};

/// One search, between convex polygons of which the target is in front of the source and the source on one side of the
/// target. Of every event it looks at each active subrange: at one line there, at all cells of lines around it, and
/// whether a piece blocks them. If some line is free, so is a cell beside some event. Degenerate: edges may be
/// parallel, coplanar, concurrent or the same. Cost: O(n^4 log n) for n edges, where few lie in one position. Exact:
/// yes. Ref: Plantinga. Proof: P-73
class Event_search {
 public:
  Event_search(const Occluders& occluders, const Event_lines& scene, const Events_options& options,
               Event_counters& counters)
      : occluders_(&occluders),
        scene_(&scene),
        options_(&options),
        counters_(&counters),
        polynomials_(scene.lines().size()),
        known_(scene.lines().size()),
        courses_(scene.lines().size()),
        planes_(occluders.frame(), scene, true),
        halves_(scene, deepest),
        cover_(scene.lines().size(), scene.blockers()) {}

  Events_answer run();

  /// Whether one piece blocks all lines inside. Exact: yes
  bool in_one_shadow() const;

  struct Surface {
    Event_kind kind;
    std::vector<std::array<Homogeneous, 2>> rulings;
  };
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  std::size_t events() const { return events_; }  ///< that were looked at

 private:
  using Event_line = Event_lines::Event_line;
  using Literal = Event_lines::Literal;
  using Blocker = Event_lines::Blocker;
  /// Along them, p comes before q in the lines' direction, or (-1) after it.
  struct Active {
    Active_subranges<Quadratic_root> left;
    int turn;
  };

  const std::vector<Event_line>& lines() const { return scene_->lines(); }

  // ---- Events in planes: horizon, edge and vertex

  /// All pencils of lines that touch three edges. Returns whether the search has ended.
  bool pencils();

  /// The lines of a plane through points of edges. Where these are vertices, they learn of it.
  bool search_flat(const Homogeneous& plane, const Edge_planes::Flat& flat,
                   std::map<Homogeneous, Edge_planes::Planes, Less_entries>& searched);
  /// The lines through a vertex in planes with an edge, but those of flats.
  bool search_vertex(const Homogeneous& point, const Edge_planes::Planes& flats);
  bool search_pencil(Event_kind kind, const Filtered& vertex, const Edge_planes::Section& section);

  // ---- Events on ruled quadrics: three skew edges

  bool reguli();

  /// Whether lines through two edges may have all literals, or all of them reversed.
  bool can_pass(const std::array<Joined_line, 4>& extreme, const std::vector<Literal>& literals) const;

  bool search_regulus(const std::array<std::uint32_t, 3>& edges);

  // ---- Along an event: active subranges

  const Quadratic& polynomial(const Event_curve& curve, std::uint32_t line);
  /// The side on which all of a curve passes a line: 1, -1; 0 where it may change; `touched` where all of it meets the
  /// line.
  int course(const Event_curve& curve, std::uint32_t line);
  int sign(const Event_curve& curve, std::uint32_t line, const Rational& s);
  /// 1 where all literals hold as far as they are not zero on all of the curve, -1 where all are reversed, else 0.
  int common_sign(const Event_curve& curve, const std::vector<Literal>& literals, const Rational& s);
  /// Of the literals that may change.
  void append_polynomials(const Event_curve& curve, const std::vector<Literal>& literals,
                          std::vector<Quadratic>& found);
  bool never_passes(const Event_curve& curve, const std::vector<Literal>& literals);

  /// The parts of a range with lines from the source to the target.
  std::vector<Active> parts_between(const Event_curve& curve, const Parameter_range& range);

  /// Whether surely no line of a curve is of use: by halves, each off its edges, or leading nowhere, or blocked by one
  /// of the pieces or by some together. In doubles.
  bool is_idle(const Event_curve& curve);

  /// Looks at a potential event. Returns whether the search has ended.
  bool search_curve(const Event_curve& curve, const Parameter_range& range);

  /// Leaves what a piece does not block. What only touches it stays whole.
  void subtract(const Event_curve& curve, const Blocker& blocker, std::vector<Active>& active);

  // ---- Beside an event

  /// `ends`: the curve's, and those of what is grazed.
  bool look_beside(const Event_curve& curve, const Parameter_range& active, int turn, std::span<const Quadratic> ends,
                   const std::vector<const Blocker*>& crossed, const std::vector<const Blocker*>& grazed);
  bool is_past(const Event_curve& curve, const Blocker& blocker, const Rational& s, int turn);

  /// All cells of lines around one event line.
  bool look_around(const Event_curve& curve, const Rational& s, int turn, const std::vector<const Blocker*>& grazed);
  /// Whether the chart's v and w follow each other as the curve's lines are directed: 1, or -1.
  static int orientation(const Event_chart& chart, const Event_curve& curve, const Rational& s);

  /// Moves the event line into a free cell, until no piece of the scene meets it: it is a sightline then.
  void confirm(const Event_chart& chart, const Event_move& move);

  void keep_surface(const Event_curve& curve, const Parameter_range& range);

  /// Whether the search ends here: too many events, or no time. Then it is undecided, unless it has a line.
  bool out_of_budget() { return ends_if(++events_ > options_->events) || out_of_time(); }
  bool out_of_time() { return ends_if(has_run_out(options_->out_of_time)); }
  bool ends_if(bool out);

  static constexpr std::uint32_t none = 0xffffffff;
  static constexpr signed char touched = 2, unknown = 3;  // courses
  static constexpr int deepest = 7;                       // halves of halves
  const Occluders* occluders_;
  const Event_lines* scene_;
  const Events_options* options_;
  Event_counters* counters_;
  std::vector<Quadratic> polynomials_;  // of the curve at hand
  std::vector<char> known_;
  std::vector<signed char> courses_;
  Edge_planes planes_;
  Curve_halves halves_;
  Blocked_together cover_;
  Events_answer answer_;
  std::vector<Surface> surfaces_;
  std::size_t events_ = 0;
};

}  // namespace sightline
