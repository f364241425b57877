#include <sightline/algorithms/solids/assembly.h>

#include <sightline/kernel/predicates.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

namespace sightline {

namespace {

constexpr std::uint32_t no_id = ~std::uint32_t{0};

std::uint64_t mixed(std::uint64_t h, std::uint64_t x) {
  h = (h ^ x) * 0xff51afd7ed558ccdu;
  return h ^ h >> 32;
}

/// Rows of integers, each once, numbered; of two that are proportional by a positive factor only one. Exact: yes
template <std::size_t Size>
class Integer_rows {
 public:
  using Row = std::array<Integer, Size>;

  /// The number of a row, which is reduced. Pre: it is not zero.
  std::uint32_t intern(Row row) {
    Integer common = abs(row[0]);
    for (std::size_t k = 1; k < Size; ++k)
      if (common != 1) common = gcd(common, row[k]);
    std::uint64_t hash = 0;
    for (Integer& n : row) {
      if (common != 1) mpz_divexact(n.get_mpz_t(), n.get_mpz_t(), common.get_mpz_t());
      hash = mixed(hash, static_cast<std::uint64_t>(sgn(n) + 1));
      for (std::size_t i = 0; i < mpz_size(n.get_mpz_t()); ++i) hash = mixed(hash, mpz_getlimbn(n.get_mpz_t(), i));
    }
    const auto [begin, end] = by_hash_.equal_range(hash);
    for (auto at = begin; at != end; ++at)
      if (rows_[at->second] == row) return at->second;
    const auto id = static_cast<std::uint32_t>(rows_.size());
    by_hash_.emplace(hash, id);
    rows_.push_back(std::move(row));
    return id;
  }
  const Row& operator[](std::uint32_t id) const { return rows_[id]; }
  std::size_t size() const { return rows_.size(); }

 private:
  std::vector<Row> rows_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> by_hash_;
};

/// The result's vertices: equal in space, equal ids, whatever planes they were made of.
class Vertex_ids {
 public:
  explicit Vertex_ids(const Operands& operands)
      : operands_(operands), predicates_(operands.predicates()), of_point_(operands.points().size(), no_id) {}

  std::uint32_t id(const Vertex& v) {
    if (v.is_input()) {
      std::uint32_t& known = of_point_[v.point];
      if (known == no_id) known = intern(v);
      return known;
    }
    std::array<std::uint32_t, 3> planes{v.plane[0], v.plane[1], v.plane[2]};
    std::sort(planes.begin(), planes.end());
    std::uint64_t hash = 0;
    for (const std::uint32_t plane : planes) hash = mixed(hash, plane);
    const auto [begin, end] = by_planes_.equal_range(hash);
    for (auto at = begin; at != end; ++at)
      if (at->second.first == planes) return at->second.second;
    const std::uint32_t id = intern(v);
    by_planes_.emplace(hash, std::pair(planes, id));
    return id;
  }
  const std::array<Integer, 4>& at(std::uint32_t id) const { return rows_[id]; }
  std::size_t size() const { return rows_.size(); }
  /// The id of an input point, if it has one.
  std::uint32_t of_point(std::uint32_t point) const { return of_point_[point]; }

  /// Whether a vertex comes before another along an axis. Exact: filtered
  bool is_before(std::uint32_t a, std::uint32_t b, std::size_t axis) const {
    const Approximate_point &p = near_[a], &q = near_[b];
    const double step = axis == 0 ? q.x - p.x : axis == 1 ? q.y - p.y : q.z - p.z;
    const double bound = (p.error + q.error) * (1 + 0x1p-40);
    if (std::fabs(step) > bound) return step > 0;
    if (a == b) return false;
    return at(a)[axis] * at(b)[3] < at(b)[axis] * at(a)[3];
  }

 private:
  std::uint32_t intern(const Vertex& v) {
    const std::uint32_t id = rows_.intern(predicates_.homogeneous(v));
    if (id == near_.size()) near_.push_back({v.x, v.y, v.z, v.error});
    else if (v.error < near_[id].error) near_[id] = {v.x, v.y, v.z, v.error};
    return id;
  }

  const Operands& operands_;
  const Predicates predicates_;
  std::vector<std::uint32_t> of_point_;
  std::unordered_multimap<std::uint64_t, std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> by_planes_;
  Integer_rows<4> rows_;
  std::vector<Approximate_point> near_;
};

/// The lines of edges, as meets of two planes: equal in space, equal ids.
class Line_ids {
 public:
  explicit Line_ids(const Operands& operands) : predicates_(operands.predicates()) {}

  std::uint32_t id(std::uint32_t p, std::uint32_t q) {
    const std::uint64_t key = std::uint64_t{std::min(p, q)} << 32 | std::max(p, q);
    const auto [place, fresh] = by_planes_.try_emplace(key, no_id);
    if (!fresh) return place->second;
    // All minors of the two planes' rows, the first that is not zero positive.
    const std::array<Integer, 4> a = predicates_.coefficients(Plane(p, false));
    const std::array<Integer, 4> b = predicates_.coefficients(Plane(q, false));
    std::array<Integer, 6> row;
    std::size_t k = 0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) row[k++] = a[i] * b[j] - a[j] * b[i];
    const auto first = std::find_if(row.begin(), row.end(), [](const Integer& n) { return sgn(n) != 0; });
    if (sgn(*first) < 0)
      for (Integer& n : row) n = -n;
    return place->second = rows_.intern(std::move(row));
  }
  std::size_t size() const { return rows_.size(); }
  /// An axis that the line is not across. Its direction is (row[3], -row[1], row[0]).
  std::size_t axis(std::uint32_t id) const { return sgn(rows_[id][3]) != 0 ? 0 : sgn(rows_[id][1]) != 0 ? 1 : 2; }

 private:
  const Predicates predicates_;
  std::unordered_map<std::uint64_t, std::uint32_t> by_planes_;
  Integer_rows<6> rows_;
};

/// What becomes one or more faces: all that is kept of a face, turned the same way.
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

/// Part of a line that bounds a group.
struct Line_run {
  std::uint32_t group, line;
  std::uint32_t from, to;  // ranks among the line's vertices
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
    const auto [u, v] = edges[e];
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
      if (kept[i].corners.empty() && is_whole_face(kept[i].piece)) alone.push_back(i);
      else add_edges(kept[i]);
      if (progress) progress(i, 2 * kept.size());
    }
    // 2. What bounds a group, line by line; and which vertices it turns at.
    for (const auto& [piece, mark] : marks) {
      const std::uint32_t line = lines_.id(operands_.pieces()[piece].support.id(), mark.edge.id());
      marks_.emplace_back(line, vertices_.id(mark.at));
    }
    result_.counters.vertices = vertices_.size();
    is_corner_.resize(vertices_.size());
    for (const std::uint32_t i : alone)
      for (const Piece_corner& corner : operands_.corners(kept[i].piece))
        if (const std::uint32_t id = vertices_.of_point(corner.point); id != no_id) is_corner_[id] = true;
    find_runs();
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
  bool is_whole_face(std::uint32_t piece) const {
    const std::vector<Piece>& all = operands_.pieces();
    return (piece == 0 || all[piece - 1].face != all[piece].face) &&
           (piece + 1 == all.size() || all[piece + 1].face != all[piece].face);
  }

  std::uint32_t group_of(const Kept_fragment& fragment) {
    const Piece& piece = operands_.pieces()[fragment.piece];
    const std::uint64_t key =
        (std::uint64_t{piece.face} << 1 | static_cast<std::uint64_t>(fragment.turned)) << 32 | piece.support.id();
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
      const std::uint32_t line = lines_.id(support, corners[k].edge.id());
      edges_.push_back({line, group, fragment.turned ? to : from, fragment.turned ? from : to});
      from = to;
    }
  }

  /// The vertices on each line, in their order, and what bounds a group there: where it is on one side only.
  void find_runs() {
    std::sort(edges_.begin(), edges_.end(), [](const Line_edge& a, const Line_edge& b) {
      return std::tie(a.line, a.group) < std::tie(b.line, b.group);
    });
    std::sort(marks_.begin(), marks_.end());
    on_line_.resize(lines_.size());
    auto mark = marks_.begin();
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ranks;  // by vertex
    for (std::size_t begin = 0, end = 0; begin < edges_.size(); begin = end) {
      const std::uint32_t line = edges_[begin].line;
      std::vector<std::uint32_t>& on = on_line_[line];
      for (end = begin; end < edges_.size() && edges_[end].line == line; ++end) {
        on.push_back(edges_[end].from);
        on.push_back(edges_[end].to);
      }
      while (mark != marks_.end() && mark->first < line) ++mark;
      for (; mark != marks_.end() && mark->first == line; ++mark) on.push_back(mark->second);
      std::sort(on.begin(), on.end());
      on.erase(std::unique(on.begin(), on.end()), on.end());
      const std::size_t axis = lines_.axis(line);
      std::sort(on.begin(), on.end(),
                [&](std::uint32_t a, std::uint32_t b) { return vertices_.is_before(a, b, axis); });
      ranks.clear();
      for (std::uint32_t rank = 0; rank < on.size(); ++rank) ranks.emplace_back(on[rank], rank);
      std::sort(ranks.begin(), ranks.end());
      const auto rank_of = [&](std::uint32_t v) {
        return std::lower_bound(ranks.begin(), ranks.end(), std::pair(v, std::uint32_t{0}))->second;
      };
      for (std::size_t i = begin, j = begin; i < end; i = j) {
        std::vector<std::pair<std::uint32_t, int>> steps;
        for (j = i; j < end && edges_[j].group == edges_[i].group; ++j) {
          const std::uint32_t from = rank_of(edges_[j].from), to = rank_of(edges_[j].to);
          steps.emplace_back(from, 1);
          steps.emplace_back(to, -1);
        }
        add_runs(steps, edges_[i].group, line);
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
      is_corner_[on_line_[line][here]] = true;
      net += step;
      since = here;
    }
  }

  void split_runs() {
    for (const Line_run& run : runs_) {
      const std::vector<std::uint32_t>& on = on_line_[run.line];
      std::uint32_t from = on[run.from];
      for (std::uint32_t rank = run.from + 1; rank <= run.to; ++rank) {
        const std::uint32_t to = on[rank];
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
    if (point == no_id) {
      const Exact_point p = operands_.position(input);
      point = result_.soup.add_point(p[0], p[1], p[2]);
    }
    return point;
  }

  void name_face(Face_id face, bool turned) {
    const auto [operand, own] = operands_.source_of(face);
    result_.faces.push_back({operand, own, turned});
  }

  void add_whole(const Kept_fragment& fragment) {
    std::vector<Point_id> loop;
    for (const Piece_corner& corner : operands_.corners(fragment.piece)) loop.push_back(point_of_input(corner.point));
    if (fragment.turned) std::reverse(loop.begin(), loop.end());
    result_.soup.add_face(loop);
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
    std::vector<std::uint64_t> keys;
    for (Face_id f = 0; f < result_.soup.face_count(); ++f)
      for (std::size_t k = 0; k < result_.soup.loop_count(f); ++k) {
        const std::span<const Point_id> loop = result_.soup.loop(f, k);
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const auto [p, q] = std::minmax(loop[i], loop[i + 1 == loop.size() ? 0 : i + 1]);
          keys.push_back(std::uint64_t{p} << 32 | q);
        }
      }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 0, j = 0; i < keys.size(); i = j) {
      while (j < keys.size() && keys[j] == keys[i]) ++j;
      if (j - i != 2)
        result_.crowded.push_back(
            {static_cast<Point_id>(keys[i] >> 32), static_cast<Point_id>(keys[i]), static_cast<std::uint32_t>(j - i)});
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
  std::vector<std::pair<std::uint32_t, std::uint32_t>> marks_;  // line, vertex
  std::vector<std::vector<std::uint32_t>> on_line_;             // vertices in their order
  std::vector<Line_run> runs_;
  std::vector<bool> is_corner_;  // by vertex
  std::vector<Point_id> vertex_points_, input_points_;
};

}  // namespace

void assemble(const Operands& operands, const std::vector<Kept_fragment>& kept,
              const std::vector<std::pair<std::uint32_t, Fragment_mark>>& marks, Set_result& result,
              const std::function<void(std::size_t, std::size_t)>& progress) {
  Assembler(operands, result).assemble(kept, marks, progress);
}

}  // namespace sightline
