#include <sightline/algorithms/point_visibility/crossings.h>

#include <sightline/kernel/plane.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace sightline {

namespace {

/// The pairs of pieces that have boxes with a point in common, of each at least one that is wanted; each pair once or
/// more; all of them, or those of one chunk.
class Close_pairs {
 public:
  /// `wanted`: of each piece.
  Close_pairs(const Piece_boxes& boxes, const std::vector<bool>& wanted) : boxes_(boxes) {
    wanted_before_.reserve(boxes.chunks().size() + 1);
    wanted_before_.push_back(0);
    for (const Piece_boxes::Chunk& chunk : boxes.chunks())
      wanted_before_.push_back(wanted_before_.back() + (wanted[chunk.piece] ? 1 : 0));
    leaf_of_.resize(boxes.chunks().size());
    for (std::uint32_t at = 0; at < boxes.nodes().size(); ++at)
      if (node(at).second == 0)
        for (std::uint32_t i = 0; i < node(at).count; ++i) leaf_of_[node(at).first + i] = at;
  }

  template <class Visit>
  void each(const Visit& visit) const {
    if (!boxes_.nodes().empty()) within(0, visit);
  }
  template <class Visit>
  void each_of(std::uint32_t chunk, const Visit& visit) const {
    of_chunk(chunk, 0, visit);
  }

 private:
  const Piece_boxes::Node& node(std::uint32_t at) const { return boxes_.nodes()[at]; }
  bool has_wanted(const Piece_boxes::Node& of) const {
    return wanted_before_[of.first] != wanted_before_[of.first + of.count];
  }
  bool is_wanted(std::uint32_t chunk) const { return wanted_before_[chunk] != wanted_before_[chunk + 1]; }
  static bool meet(const Piece_boxes::Box& a, const Piece_boxes::Box& b) {
    for (std::size_t k = 0; k < 3; ++k)
      if (a.high[k] < b.low[k] || b.high[k] < a.low[k]) return false;
    return true;
  }
  template <class Visit>
  void look_at(std::uint32_t i, std::uint32_t j, const Visit& visit) const {
    if (is_wanted(i) || is_wanted(j)) visit(boxes_.chunks()[i].piece, boxes_.chunks()[j].piece);
  }
  template <class Visit>
  void of_chunk(std::uint32_t chunk, std::uint32_t at, const Visit& visit) const {
    const Piece_boxes::Node& own = node(at);
    if ((!is_wanted(chunk) && !has_wanted(own)) || !meet(node(leaf_of_[chunk]).box, own.box)) return;
    if (own.second == 0) {
      for (std::uint32_t j = own.first; j < own.first + own.count; ++j) look_at(chunk, j, visit);
      return;
    }
    of_chunk(chunk, at + 1, visit);
    of_chunk(chunk, own.second, visit);
  }
  template <class Visit>
  void within(std::uint32_t at, const Visit& visit) const {
    const Piece_boxes::Node& own = node(at);
    if (!has_wanted(own)) return;
    if (own.second == 0) {
      for (std::uint32_t i = own.first; i < own.first + own.count; ++i)
        for (std::uint32_t j = own.first; j < i; ++j) look_at(i, j, visit);
      return;
    }
    within(at + 1, visit);
    within(own.second, visit);
    between(at + 1, own.second, visit);
  }
  template <class Visit>
  void between(std::uint32_t one, std::uint32_t other, const Visit& visit) const {
    const Piece_boxes::Node &a = node(one), &b = node(other);
    if ((!has_wanted(a) && !has_wanted(b)) || !meet(a.box, b.box)) return;
    if (a.second == 0 && b.second == 0) {
      for (std::uint32_t i = a.first; i < a.first + a.count; ++i)
        for (std::uint32_t j = b.first; j < b.first + b.count; ++j) look_at(i, j, visit);
    } else if (b.second == 0 || (a.second != 0 && a.count >= b.count)) {
      between(one + 1, other, visit);
      between(a.second, other, visit);
    } else {
      between(one, other + 1, visit);
      between(one, b.second, visit);
    }
  }

  std::vector<std::uint32_t> wanted_before_;  // of the chunks before each
  std::vector<std::uint32_t> leaf_of_;        // of each chunk
  const Piece_boxes& boxes_;
};

/// A piece that has a segment of the line where its plane and another one meet, and the sides of that plane on which it
/// has points.
struct Reaching {
  std::uint32_t piece;
  bool front, behind;
  friend auto operator<=>(const Reaching&, const Reaching&) = default;
};
/// What reaches the line of two planes: pieces of the one, pieces of the other.
using Reached = std::array<std::vector<Reaching>, 2>;

/// The segment of a line that a piece has, and the sides of it, in the piece's plane, on which the piece lies.
struct Chord {
  std::uint32_t piece, plane;
  bool left, right;
  std::array<Crossing_end, 2> ends;
  std::array<Rational, 2> at;  // the ends' places along the line, ascending
};

/// A line by its direction and moment, in lowest terms, the first of the direction that is not 0 positive.
using Line_name = std::array<Integer, 6>;

class Crossing_search {
 public:
  explicit Crossing_search(const Scene& scene) : scene_(scene), predicates_(scene.predicates()) {
    for (const Piece& piece : scene.pieces()) {
      const std::uint32_t plane = piece.support.id();
      if (plane >= in_plane_.size()) in_plane_.resize(plane + std::size_t{1}, 0);
      ++in_plane_[plane];
    }
  }

  std::vector<Crossing> find(const Piece_boxes& boxes, const std::vector<bool>& wanted,
                             const std::function<void()>& go_on) {
    // Plane after plane, each with those of higher ids: of many faces through one line all pairs take too much memory.
    const Close_pairs pairs(boxes, wanted);
    std::vector<std::uint32_t> order(boxes.chunks().size());
    std::iota(order.begin(), order.end(), 0u);
    const auto piece_at = [&](std::size_t k) { return boxes.chunks()[order[k]].piece; };
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
      const std::uint32_t f = boxes.chunks()[i].piece, g = boxes.chunks()[j].piece;
      return std::pair(plane_of(f), f) < std::pair(plane_of(g), g);
    });
    std::vector<std::uint32_t> close;
    for (std::size_t k = 0; k < order.size();) {
      const std::uint32_t f = piece_at(k), plane = plane_of(f);
      close.clear();
      if (go_on) go_on();
      for (; k < order.size() && piece_at(k) == f; ++k)
        pairs.each_of(order[k], [&](std::uint32_t, std::uint32_t g) {
          if (plane_of(g) > plane) close.push_back(g);
        });
      std::sort(close.begin(), close.end());
      close.erase(std::unique(close.begin(), close.end()), close.end());
      for (const std::uint32_t g : close) {
        if (go_on) go_on();
        note(f, g);
      }
      if (k < order.size() && plane_of(piece_at(k)) == plane) continue;
      for (auto& [other, reached] : reached_) {
        if (go_on) go_on();
        add_chords({plane, other}, reached);
      }
      reached_.clear();
    }
    for (auto& [line, chords] : chords_) {
      if (go_on) go_on();
      list(chords);
    }
    return std::move(found_);
  }

  /// Some of the pieces, and those close to them that are in the plane of one, or in whose plane one has an edge.
  std::vector<bool> with_neighbours(const std::vector<bool>& some, const Piece_boxes& boxes) {
    std::vector<bool> all = some;
    const auto add = [&](std::uint32_t f, std::uint32_t g) {
      if (some[f] && !all[g] && (plane_of(f) == plane_of(g) || has_edge_in(f, plane_of(g)))) all[g] = true;
    };
    Close_pairs(boxes, some).each([&](std::uint32_t f, std::uint32_t g) {
      add(f, g);
      add(g, f);
    });
    return all;
  }

 private:
  static constexpr std::size_t low = 0, high = 1;

  // ---- Pairs of planes, and what reaches their line

  std::uint32_t plane_of(std::uint32_t piece) const { return scene_.pieces()[piece].support.id(); }
  Sign side(std::uint32_t point, const Prepared_plane& h) {
    return predicates_.side(predicates_.input_vertex(point, Vertex::no_plane, Vertex::no_plane, Vertex::no_plane), h,
                            counts_);
  }
  bool has_edge_in(std::uint32_t piece, std::uint32_t plane) {
    const Prepared_plane h = predicates_.prepare(Plane(plane, false));
    std::size_t on = 0;
    for (const Piece_corner& corner : scene_.corners(scene_.pieces()[piece])) on += side(corner.point, h) == CGAL::ZERO;
    return on >= 2;
  }
  /// How a piece reaches the line of its plane and another one; none where it does not, or nothing can be on the other
  /// side of the line.
  std::optional<Reaching> reach(std::uint32_t piece, std::uint32_t plane) {
    const Prepared_plane h = predicates_.prepare(Plane(plane, false));
    Reaching found{piece, false, false};
    std::size_t on = 0;
    for (const Piece_corner& corner : scene_.corners(scene_.pieces()[piece])) {
      const Sign s = side(corner.point, h);
      found.front |= s == CGAL::POSITIVE;
      found.behind |= s == CGAL::NEGATIVE;
      on += s == CGAL::ZERO;
    }
    const bool across = found.front && found.behind;
    if (!across && (on < 2 || in_plane_[plane_of(piece)] == 1)) return std::nullopt;
    return found;
  }
  /// Pre: the plane of f is the one that is looked at, that of g has a higher id.
  void note(std::uint32_t f, std::uint32_t g) {
    const std::optional<Reaching> one = reach(f, plane_of(g));
    if (!one) return;
    const std::optional<Reaching> other = reach(g, plane_of(f));
    if (!other) return;
    Reached& reached = reached_[plane_of(g)];
    reached[low].push_back(*one);
    reached[high].push_back(*other);
  }

  // ---- Lines, and the chords that pieces have of them

  void add_chords(const std::pair<std::uint32_t, std::uint32_t>& planes, Reached& reached) {
    for (std::vector<Reaching>& side : reached) {
      std::sort(side.begin(), side.end());
      side.erase(std::unique(side.begin(), side.end()), side.end());
      if (std::none_of(side.begin(), side.end(), [](const Reaching& r) { return r.front; }) ||
          std::none_of(side.begin(), side.end(), [](const Reaching& r) { return r.behind; }))
        return;
    }
    const std::array<std::array<Integer, 4>, 2> h{predicates_.coefficients(Plane(planes.first, false)),
                                                  predicates_.coefficients(Plane(planes.second, false))};
    const auto [line, turned] = line_of(h[low], h[high]);
    std::map<std::uint32_t, Chord>& chords = chords_[line];
    const std::size_t axis = line[0] != 0 ? 0 : line[1] != 0 ? 1 : 2;
    for (const std::size_t k : {low, high})
      for (const Reaching& r : reached[k]) {
        if (chords.contains(r.piece)) continue;  // by another plane through the line
        // The other plane's front is on the right of the line in the lower plane, and on its left in the higher one,
        // unless the line is turned.
        const bool left_is_front = (k == high) != turned;
        Chord chord{r.piece,
                    plane_of(r.piece),
                    left_is_front ? r.front : r.behind,
                    left_is_front ? r.behind : r.front,
                    ends_of(r.piece, k == low ? planes.second : planes.first, h[1 - k]),
                    {}};
        for (std::size_t e = 0; e < 2; ++e) chord.at[e] = place(chord.ends[e], axis);
        if (chord.at[1] < chord.at[0]) {
          std::swap(chord.at[0], chord.at[1]);
          std::swap(chord.ends[0], chord.ends[1]);
        }
        chords.emplace(r.piece, std::move(chord));
      }
  }
  /// The line of two planes, and whether it runs against the product of their normals.
  static std::pair<Line_name, bool> line_of(const std::array<Integer, 4>& g, const std::array<Integer, 4>& h) {
    const std::array<Integer, 3> m{g[0], g[1], g[2]}, n{h[0], h[1], h[2]}, direction = cross(m, n);
    Line_name line{direction[0], direction[1], direction[2], {}, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) line[k + 3] = g[3] * n[k] - h[3] * m[k];
    Integer common = 0;
    for (const Integer& x : line) common = gcd(common, x);
    const bool turned = *std::find_if(direction.begin(), direction.end(), [](const Integer& x) { return x != 0; }) < 0;
    if (turned) common = -common;
    for (Integer& x : line) x /= common;
    return {line, turned};
  }
  Integer height(std::uint32_t point, const std::array<Integer, 4>& h) const {
    const Grid_points& points = scene_.points();
    return Integer(h[0] * points.integer(point, 0) + h[1] * points.integer(point, 1) + h[2] * points.integer(point, 2) +
                   h[3]);
  }
  /// Where a strictly convex piece, across a plane or with an edge in it, meets it.
  std::array<Crossing_end, 2> ends_of(std::uint32_t piece, std::uint32_t plane, const std::array<Integer, 4>& h) {
    const std::span<const Piece_corner> corners = scene_.corners(scene_.pieces()[piece]);
    const Grid_points& points = scene_.points();
    const Prepared_plane prepared = predicates_.prepare(Plane(plane, false));
    std::vector<Sign> sides;
    for (const Piece_corner& corner : corners) sides.push_back(side(corner.point, prepared));
    std::array<Crossing_end, 2> ends;
    std::size_t found = 0;
    for (std::size_t k = 0; k < corners.size() && found < 2; ++k) {
      const std::size_t next = k + 1 == corners.size() ? 0 : k + 1;
      const std::uint32_t p = corners[k].point, q = corners[next].point;
      if (sides[k] == CGAL::ZERO) {
        ends[found++] = {p, p, {points.integer(p, 0), points.integer(p, 1), points.integer(p, 2), 1}};
      } else if (sides[k] * sides[next] < 0) {
        const Integer to_p = abs(height(p, h)), to_q = abs(height(q, h));
        Crossing_end& end = ends[found++] = {p, q, {}};
        for (int i = 0; i < 3; ++i)
          end.at[static_cast<std::size_t>(i)] = to_q * points.integer(p, i) + to_p * points.integer(q, i);
        end.at[3] = to_p + to_q;
      }
    }
    return ends;
  }
  static Rational place(const Crossing_end& end, std::size_t axis) {
    Rational at(end.at[axis], end.at[3]);
    at.canonicalize();
    return at;
  }

  // ---- Along one line

  /// Lists the stretches of a line that are inside the surfaces of two planes or more.
  void list(std::map<std::uint32_t, Chord>& by_piece) {
    std::vector<Chord> chords;
    for (auto& [piece, chord] : by_piece) chords.push_back(std::move(chord));
    struct Event {
      std::uint32_t chord;
      std::size_t end;
    };
    std::vector<Event> events;
    for (std::uint32_t i = 0; i < chords.size(); ++i)
      for (std::size_t e = 0; e < 2; ++e) events.push_back({i, e});
    const auto at = [&](const Event& e) -> const Rational& { return chords[e.chord].at[e.end]; };
    std::sort(events.begin(), events.end(), [&](const Event& a, const Event& b) { return at(a) < at(b); });

    std::set<std::uint32_t> active, before;
    std::optional<Crossing> open;
    for (std::size_t k = 0; k < events.size(); ++k) {
      if (events[k].end == 0) active.insert(events[k].chord);
      else active.erase(events[k].chord);
      if (k + 1 < events.size() && at(events[k + 1]) == at(events[k])) continue;
      const Crossing_end& here = chords[events[k].chord].ends[events[k].end];
      std::optional<Crossing> next = inside(chords, active, here);
      if (!open || !next || !same(*open, *next)) {
        if (open) {
          open->ends[1] = here;
          open->beyond[1] = beyond(chords, before, *open, 1);
          found_.push_back(std::move(*open));
        }
        if (next) next->beyond[0] = beyond(chords, active, *next, 0);
        open = std::move(next);
      }
      before = active;
    }
  }
  /// An end of what a piece in the plane of a crossing's first one has of the line there. Pre: such a chord is active.
  Crossing_end beyond(const std::vector<Chord>& chords, const std::set<std::uint32_t>& active, const Crossing& crossing,
                      std::size_t end) const {
    const std::uint32_t plane = plane_of(crossing.pieces[0]);
    return chords[*std::find_if(active.begin(), active.end(),
                                [&](std::uint32_t i) { return chords[i].plane == plane; })]
        .ends[end];
  }
  /// The crossing that begins at an end with these chords, if they make one.
  std::optional<Crossing> inside(const std::vector<Chord>& chords, const std::set<std::uint32_t>& active,
                                 const Crossing_end& from) const {
    std::map<std::uint32_t, std::pair<bool, bool>> sides;  // of planes: left, right
    for (const std::uint32_t i : active) {
      auto& [left, right] = sides[chords[i].plane];
      left |= chords[i].left;
      right |= chords[i].right;
    }
    const auto both = [](const auto& of) { return of.second.first && of.second.second; };
    if (std::count_if(sides.begin(), sides.end(), both) < 2) return std::nullopt;
    Crossing crossing{{}, {}, {from, from}, {from, from}};
    std::set<std::uint32_t> planes;
    for (const std::uint32_t i : active) {
      if (!both(*sides.find(chords[i].plane))) continue;
      crossing.faces.push_back(scene_.pieces()[chords[i].piece].face);
      if (planes.insert(chords[i].plane).second) crossing.pieces.push_back(chords[i].piece);
    }
    std::sort(crossing.faces.begin(), crossing.faces.end());
    crossing.faces.erase(std::unique(crossing.faces.begin(), crossing.faces.end()), crossing.faces.end());
    return crossing;
  }
  /// Whether two crossings on one line are of the same faces in the same planes.
  bool same(const Crossing& a, const Crossing& b) const {
    const auto planes = [&](const Crossing& c) {
      std::set<std::uint32_t> of;
      for (const std::uint32_t piece : c.pieces) of.insert(plane_of(piece));
      return of;
    };
    return a.faces == b.faces && planes(a) == planes(b);
  }

  const Scene& scene_;
  Predicates predicates_;
  Predicate_counts counts_;
  std::vector<std::uint32_t> in_plane_;                         // pieces, by plane
  std::map<std::uint32_t, Reached> reached_;                    // of the plane that is looked at, by the other one
  std::map<Line_name, std::map<std::uint32_t, Chord>> chords_;  // by piece
  std::vector<Crossing> found_;
};

}  // namespace

std::vector<Crossing> crossings(const Scene& scene, const Piece_boxes& boxes) {
  return Crossing_search(scene).find(boxes, std::vector<bool>(scene.pieces().size(), true), {});
}

std::vector<Crossing> crossings_on(const std::vector<bool>& pieces, const Scene& scene, const Piece_boxes& boxes,
                                   const std::function<void()>& go_on) {
  Crossing_search search(scene);
  return search.find(boxes, search.with_neighbours(pieces, boxes), go_on);
}

}  // namespace sightline
