#include <sightline/algorithms/solids/assembly.h>

#include <sightline/algorithms/solids/buckets.h>
#include <sightline/algorithms/solids/space_ids.h>
#include <sightline/kernel/predicates.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>

namespace sightline {

namespace {

constexpr std::uint32_t no_id = ~std::uint32_t{0};

/// What becomes one or more faces: all that is kept of a face in one plane, with one front, turned the same way.
struct Face_group {
  Face_id face;
  bool turned;
  Plane support;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  // of its boundary, the inside on the left
};

/// An edge of a fragment.
struct Line_edge {
  std::uint32_t line, group, from, to;
};

/// A point that splits what runs through it.
struct Line_mark {
  std::uint32_t line, vertex;
};

/// Part of a line that bounds a group.
struct Line_run {
  std::uint32_t group, line;
  std::uint32_t from, to;  // places among the vertices of lines
  bool forwards;
};

// ---- Loops of one group

/// The group's plane seen from its front in the result: two axes of the vertices, in this order.
struct Group_view {
  const Vertex_ids& vertices;
  std::size_t x, y;

  /// The turn from a over b to c.
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const auto &p = vertices.at(a), &q = vertices.at(b), &r = vertices.at(c);
    return sgn(Integer(p[x] * (q[y] * r[3] - r[y] * q[3]) - p[y] * (q[x] * r[3] - r[x] * q[3]) +
                       p[3] * (q[x] * r[y] - r[x] * q[y])));
  }
  std::array<Rational, 2> at(std::uint32_t a) const {
    const auto& p = vertices.at(a);
    std::array<Rational, 2> q{Rational(p[x], p[3]), Rational(p[y], p[3])};
    for (Rational& n : q) n.canonicalize();
    return q;
  }
  /// Whether a and b are on the same side of v, all three being on a line.
  bool same_side(std::uint32_t v, std::uint32_t a, std::uint32_t b) const {
    const auto o = at(v), p = at(a), q = at(b);
    return sgn(Rational((p[0] - o[0]) * (q[0] - o[0]) + (p[1] - o[1]) * (q[1] - o[1]))) > 0;
  }
};

using Loop = std::vector<std::uint32_t>;

/// The boundary as loops that keep to one side of the inside: at a vertex where several meet, the next edge is the
/// first clockwise from where one comes from.
std::vector<Loop> loops_of(std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges, const Group_view& view) {
  std::sort(edges.begin(), edges.end());
  const auto after = [&](std::size_t e) {
    const std::uint32_t u = edges[e].first, v = edges[e].second;
    const auto begin = std::lower_bound(edges.begin(), edges.end(), std::pair(v, std::uint32_t{0}));
    auto best = begin;
    const auto rank = [&, from = u](std::uint32_t w) {
      const int turn = view.turn(v, from, w);
      return turn < 0 ? 0 : turn > 0 ? 2 : view.same_side(v, from, w) ? 3 : 1;
    };
    for (auto at = begin; at != edges.end() && at->first == v; ++at) {
      if (at == begin) continue;
      const int a = rank(at->second), b = rank(best->second);
      if (a < b || (a == b && view.turn(v, at->second, best->second) < 0)) best = at;
    }
    return static_cast<std::size_t>(best - edges.begin());
  };
  std::vector<Loop> loops;
  std::vector<bool> used(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (used[e]) continue;
    Loop loop;
    for (std::size_t at = e; !used[at]; at = after(at)) {
      used[at] = true;
      loop.push_back(edges[at].first);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// A loop with its area, twice.
struct Area_loop {
  Loop loop;
  Rational area;
  std::vector<std::size_t> holes;
};

Rational doubled_area(const Loop& loop, const Group_view& view) {
  Rational sum;
  const auto origin = view.at(loop[0]);
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    const auto p = view.at(loop[k]), q = view.at(loop[k + 1]);
    sum += (p[0] - origin[0]) * (q[1] - origin[1]) - (p[1] - origin[1]) * (q[0] - origin[0]);
  }
  return sum;
}

/// Pre: the point is not on the loop.
bool is_inside(std::uint32_t point, const Loop& loop, const Group_view& view) {
  const Rational height = view.at(point)[1];
  bool inside = false;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::uint32_t a = loop[k], b = loop[k + 1 == loop.size() ? 0 : k + 1];
    const bool low = view.at(a)[1] <= height, next_low = view.at(b)[1] <= height;
    if (low != next_low && (view.turn(a, b, point) > 0) == low) inside = !inside;
  }
  return inside;
}

// ---- All of it

class Assembler {
 public:
  Assembler(const Operands& operands, Set_result& result)
      : operands_(operands),
        predicates_(operands.predicates()),
        result_(result),
        vertices_(operands),
        lines_(operands) {}

  void assemble(const std::vector<Kept_fragment>& kept,
                const std::vector<std::pair<std::uint32_t, Fragment_mark>>& marks,
                const std::function<void(std::size_t, std::size_t)>& progress) {
    // 1. Which are faces by themselves; edges of all others.
    std::vector<std::uint32_t> alone;  // places in kept
    for (std::uint32_t i = 0; i < kept.size(); ++i) {
      if (kept[i].corners.empty() && is_whole_face(operands_, kept[i].piece)) alone.push_back(i);
      else add_edges(kept[i]);
      if (progress) progress(i, 2 * kept.size());
    }
    // 2. What bounds a group, line by line; and which vertices it turns at.
    for (const auto& [piece, mark] : marks) {
      const std::uint32_t line = lines_.id(operands_.pieces()[piece].support.id(), mark.edge.id());
      marks_.push_back({line, vertices_.id(mark.at)});
    }
    result_.counters.vertices = vertices_.size();
    result_.counters.predicates += vertices_.counts();
    is_corner_.resize(vertices_.size());
    for (const std::uint32_t i : alone)
      for (const Piece_corner& corner : operands_.corners(kept[i].piece))
        if (const std::uint32_t id = vertices_.of_point(corner.point); id != no_id) is_corner_[id] = true;
    find_runs();
    find_crossings();
    split_runs();
    // 3. Faces, in the order of the operands'.
    vertex_points_.assign(vertices_.size(), no_id);
    input_points_.assign(operands_.points().size(), no_id);
    std::size_t next = 0;
    for (Face_group& group : groups_) {
      for (; next < alone.size() && operands_.pieces()[kept[alone[next]].piece].face < group.face; ++next)
        add_whole(kept[alone[next]]);
      add_faces(group);
      if (progress) progress(groups_.size() + static_cast<std::size_t>(&group - groups_.data()), 2 * groups_.size());
    }
    for (; next < alone.size(); ++next) add_whole(kept[alone[next]]);
    find_crowded();
  }

 private:
  std::uint32_t group_of(const Kept_fragment& fragment) {
    const Piece& piece = operands_.pieces()[fragment.piece];
    // A face that is not planar may be folded flat: in one plane it has parts of either sense.
    const std::uint64_t key =
        (std::uint64_t{piece.face} << 1 | static_cast<std::uint64_t>(fragment.turned)) << 32 |
        (std::uint64_t{piece.support.id()} << 1 | static_cast<std::uint64_t>(piece.support.flipped()));
    const auto [place, fresh] = by_face_.try_emplace(key, static_cast<std::uint32_t>(groups_.size()));
    if (fresh) groups_.push_back({piece.face, fragment.turned, piece.support, {}});
    return place->second;
  }

  void add_edges(const Kept_fragment& fragment) {
    const std::uint32_t group = group_of(fragment);
    std::vector<Fragment_corner> own;
    if (fragment.corners.empty()) own = whole(operands_, predicates_, fragment.piece).corners;
    const std::vector<Fragment_corner>& corners = fragment.corners.empty() ? own : fragment.corners;
    const std::uint32_t support = operands_.pieces()[fragment.piece].support.id();
    const std::uint32_t first = vertices_.id(corners[0].vertex);
    std::uint32_t from = first;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::uint32_t to = k + 1 == corners.size() ? first : vertices_.id(corners[k + 1].vertex);
      const std::uint32_t line = lines_.id(support, corners[k].edge.id(), from, to);
      edges_.push_back({line, group, fragment.turned ? to : from, fragment.turned ? from : to});
      from = to;
    }
  }

  /// The vertices on each line, in their order, and what bounds a group there: where it is on one side only.
  void find_runs() {
    const std::vector<std::size_t> first_edge = in_order_of(edges_, lines_.size(), &Line_edge::line);
    const std::vector<std::size_t> first_mark = in_order_of(marks_, lines_.size(), &Line_mark::line);
    std::vector<std::uint32_t> place(vertices_.size());  // in on_lines_, of those of one line
    std::vector<std::pair<std::uint32_t, int>> steps;
    for (std::uint32_t line = 0; line < lines_.size(); ++line) {
      const std::span<Line_edge> edges(edges_.data() + first_edge[line], edges_.data() + first_edge[line + 1]);
      if (edges.empty()) continue;
      // 1. Vertices.
      const auto begin = static_cast<std::ptrdiff_t>(on_lines_.size());
      for (const Line_edge& edge : edges) {
        on_lines_.push_back(edge.from);
        on_lines_.push_back(edge.to);
      }
      for (std::size_t m = first_mark[line]; m < first_mark[line + 1]; ++m) on_lines_.push_back(marks_[m].vertex);
      std::sort(on_lines_.begin() + begin, on_lines_.end());
      on_lines_.erase(std::unique(on_lines_.begin() + begin, on_lines_.end()), on_lines_.end());
      std::sort(
          on_lines_.begin() + begin, on_lines_.end(),
          [&, axis = lines_.axis(line)](std::uint32_t a, std::uint32_t b) { return vertices_.is_before(a, b, axis); });
      for (auto k = static_cast<std::size_t>(begin); k < on_lines_.size(); ++k)
        place[on_lines_[k]] = static_cast<std::uint32_t>(k);
      // 2. Group by group.
      std::sort(edges.begin(), edges.end(), [](const Line_edge& a, const Line_edge& b) { return a.group < b.group; });
      for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
        steps.clear();
        for (j = i; j < edges.size() && edges[j].group == edges[i].group; ++j) {
          steps.emplace_back(place[edges[j].from], 1);
          steps.emplace_back(place[edges[j].to], -1);
        }
        add_runs(steps, edges[i].group, line);
      }
    }
  }

  /// An edge that runs from a to b adds 1 behind a, and takes it away behind b: also where b comes first.
  void add_runs(std::vector<std::pair<std::uint32_t, int>>& steps, std::uint32_t group, std::uint32_t line) {
    std::sort(steps.begin(), steps.end());
    int net = 0;
    std::uint32_t since = 0;
    for (std::size_t i = 0, j = 0; i < steps.size(); i = j) {
      int step = 0;
      for (j = i; j < steps.size() && steps[j].first == steps[i].first; ++j) step += steps[j].second;
      if (step == 0) continue;
      const std::uint32_t here = steps[i].first;
      if (net != 0) runs_.push_back({group, line, since, here, net > 0});
      is_corner_[on_lines_[here]] = true;
      net += step;
      since = here;
    }
  }

  /// Runs on several lines that go on through a vertex: where three cross, what is inside may be every second of the
  /// six sectors, and then none of them ends there.
  void find_crossings() {
    std::vector<std::uint32_t> line_through(vertices_.size(), no_id);
    for (const Line_run& run : runs_)
      for (std::uint32_t place = run.from + 1; place < run.to; ++place) {
        const std::uint32_t vertex = on_lines_[place];
        if (line_through[vertex] == no_id) line_through[vertex] = run.line;
        else if (line_through[vertex] != run.line) is_corner_[vertex] = true;
      }
  }

  void split_runs() {
    for (const Line_run& run : runs_) {
      std::uint32_t from = on_lines_[run.from];
      for (std::uint32_t place = run.from + 1; place <= run.to; ++place) {
        const std::uint32_t to = on_lines_[place];
        if (!is_corner_[to]) continue;
        groups_[run.group].edges.emplace_back(run.forwards ? from : to, run.forwards ? to : from);
        from = to;
      }
    }
  }

  Point_id point_of(std::uint32_t vertex) {
    Point_id& point = vertex_points_[vertex];
    if (point == no_id) {
      const Exact_point p = operands_.position(vertices_.at(vertex));
      point = result_.soup.add_point(p[0], p[1], p[2]);
    }
    return point;
  }
  Point_id point_of_input(std::uint32_t input) {
    if (const std::uint32_t vertex = vertices_.of_point(input); vertex != no_id) return point_of(vertex);
    Point_id& point = input_points_[input];
    if (point == no_id) point = operands_.add_point(input, result_.soup);
    return point;
  }

  void name_face(Face_id face, bool turned) {
    const auto [operand, own] = operands_.source_of(face);
    result_.faces.push_back({operand, own, turned});
  }

  void add_whole(const Kept_fragment& fragment) {
    loop_.clear();
    for (const Piece_corner& corner : operands_.corners(fragment.piece)) loop_.push_back(point_of_input(corner.point));
    if (fragment.turned) std::reverse(loop_.begin(), loop_.end());
    result_.soup.add_face(loop_);
    name_face(operands_.pieces()[fragment.piece].face, fragment.turned);
  }

  void add_faces(Face_group& group) {
    // 1. Its loops, as seen from the front that the result has there.
    const Prepared_plane h = predicates_.prepare(group.support);
    const std::array<double, 3> n{std::fabs(h.a), std::fabs(h.b), std::fabs(h.c)};
    const auto axis = static_cast<std::size_t>(std::max_element(n.begin(), n.end()) - n.begin());
    const bool upwards = ((axis == 0 ? h.a : axis == 1 ? h.b : h.c) > 0) != group.turned;
    const std::size_t one = (axis + 1) % 3, other = (axis + 2) % 3;
    const Group_view view{vertices_, upwards ? one : other, upwards ? other : one};
    std::vector<Loop> loops = loops_of(group.edges, view);
    // 2. Holes, each in the least loop around it: an island in a hole may touch it, and is smaller.
    std::vector<Area_loop> all;
    for (Loop& loop : loops) {
      const Rational area = loops.size() == 1 ? Rational(1) : doubled_area(loop, view);
      all.push_back({std::move(loop), area, {}});
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (sgn(all[i].area) > 0) continue;
      std::size_t around = all.size();
      for (std::size_t j = 0; j < all.size(); ++j)
        if (sgn(all[j].area) > 0 && all[j].area > -all[i].area &&
            (around == all.size() || all[j].area < all[around].area) && is_inside(all[i].loop[0], all[j].loop, view))
          around = j;
      if (around < all.size()) all[around].holes.push_back(i);
    }
    // 3. Faces.
    const auto points_of = [&](const Loop& loop) {
      std::vector<Point_id> points;
      for (const std::uint32_t v : loop) points.push_back(point_of(v));
      return points;
    };
    for (const Area_loop& outer : all) {
      if (sgn(outer.area) <= 0) continue;
      result_.soup.add_face(points_of(outer.loop));
      for (const std::size_t hole : outer.holes) result_.soup.add_hole(points_of(all[hole].loop));
      name_face(group.face, group.turned);
    }
  }

  void find_crowded() {
    struct Edge {
      Point_id from, to;
    };
    std::vector<Edge> edges;
    for (Face_id f = 0; f < result_.soup.face_count(); ++f)
      for (std::size_t k = 0; k < result_.soup.loop_count(f); ++k) {
        const std::span<const Point_id> loop = result_.soup.loop(f, k);
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const auto [p, q] = std::minmax(loop[i], loop[i + 1 == loop.size() ? 0 : i + 1]);
          edges.push_back({p, q});
        }
      }
    const std::vector<std::size_t> first = in_order_of(edges, result_.soup.point_count(), &Edge::from);
    for (Point_id p = 0; p < result_.soup.point_count(); ++p) {
      const std::span<Edge> of_point(edges.data() + first[p], edges.data() + first[p + 1]);
      std::sort(of_point.begin(), of_point.end(), [](const Edge& a, const Edge& b) { return a.to < b.to; });
      for (std::size_t i = 0, j = 0; i < of_point.size(); i = j) {
        while (j < of_point.size() && of_point[j].to == of_point[i].to) ++j;
        if (j - i != 2) result_.crowded.push_back({p, of_point[i].to, static_cast<std::uint32_t>(j - i)});
      }
    }
  }

  const Operands& operands_;
  const Predicates predicates_;
  Set_result& result_;
  Vertex_ids vertices_;
  Line_ids lines_;
  std::vector<Face_group> groups_;
  std::unordered_map<std::uint64_t, std::uint32_t> by_face_;  // groups, by face, sense and plane
  std::vector<Line_edge> edges_;
  std::vector<Line_mark> marks_;
  std::vector<std::uint32_t> on_lines_;  // vertices: of each line that has edges, in their order along it
  std::vector<Line_run> runs_;
  std::vector<bool> is_corner_;  // by vertex
  std::vector<Point_id> vertex_points_, input_points_;
  std::vector<Point_id> loop_;  // of the face that is added
};

}  // namespace

void assemble(const Operands& operands, const std::vector<Kept_fragment>& kept,
              const std::vector<std::pair<std::uint32_t, Fragment_mark>>& marks, Set_result& result,
              const std::function<void(std::size_t, std::size_t)>& progress) {
  Assembler(operands, result).assemble(kept, marks, progress);
}

}  // namespace sightline
