#include <sightline/algorithms/solids/operands.h>

#include <sightline/kernel/line_table.h>
#include <sightline/kernel/predicates.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

namespace sightline {

namespace {

/// Makes `loops` a face's loops on the grid, repetitions dropped.
void put_on_grid(const Polygon_soup& soup, Face_id f, std::size_t first_point, const std::vector<std::uint32_t>& ids,
                 std::vector<Point_loop>& loops) {
  loops.resize(soup.loop_count(f));
  for (std::size_t k = 0; k < loops.size(); ++k) {
    loops[k].clear();
    for (const Point_id p : soup.loop(f, k))
      if (loops[k].empty() || loops[k].back() != ids[first_point + p]) loops[k].push_back(ids[first_point + p]);
    while (loops[k].size() > 1 && loops[k].back() == loops[k].front()) loops[k].pop_back();
  }
}

/// A directed edge of a piece, kept with its lesser end.
struct Edge_use {
  std::uint32_t greater;                       // of its two ends
  std::uint32_t piece : 31, is_backwards : 1;  // from the greater to the lesser; corners have 32 bits, three a piece
};

/// One of an operand's edges between two points, and how many more run forwards.
struct Edge_left {
  std::uint32_t lesser, operand;
  Edge_use edge;
  long net;
};

/// Calls visit(lesser end, edge) for all edges of all pieces.
template <class Visit>
void for_each_edge(const Operands& operands, const Visit& visit) {
  for (std::uint32_t i = 0; i < operands.pieces().size(); ++i) {
    const std::span<const Piece_corner> corners = operands.corners(i);
    std::uint32_t p = corners.back().point;
    for (const Piece_corner& corner : corners) {
      const std::uint32_t q = corner.point;
      visit(std::min(p, q), Edge_use{std::max(p, q), i, q < p});
      p = q;
    }
  }
}

}  // namespace

Operands::Operands(std::span<const Polygon_soup> solids) {
  // 1. All points on one grid.
  Coordinates all;
  std::size_t points_read = 0, faces_read = 0;
  for (const Polygon_soup& solid : solids) points_read += solid.point_count();
  all.reserve(3 * std::exchange(points_read, 0));
  first_face_.push_back(0);
  for (const Polygon_soup& solid : solids) {
    solid.check_corners();
    all.append(solid.coordinates);
    points_read += solid.point_count();
    faces_read += solid.face_count();
    if (faces_read >= Plane::max_table_planes || points_read >= Plane::max_axis_point)
      throw std::length_error("operands of up to 2^28 points and 2^30 faces only, together");
    first_face_.push_back(static_cast<Face_id>(faces_read));
  }
  std::vector<std::uint32_t> ids;
  grid_ = Scene_grid(all, ids);

  // 2. Faces into pieces.
  faces_.planes = Plane_table(points());
  faces_.planes.reserve(faces_read);
  faces_.pieces.reserve(faces_read);
  faces_.corners.reserve(3 * faces_read);
  std::size_t first_point = 0;
  std::vector<Point_loop> loops;
  for (std::uint32_t operand = 0; operand < solids.size(); ++operand) {
    const Polygon_soup& solid = solids[operand];
    for (Face_id f = 0; f < solid.face_count(); ++f) {
      const Face_id face = first_face_[operand] + f;
      put_on_grid(solid, f, first_point, ids, loops);
      if (const auto reason = cut_face(points(), face, loops, faces_, Piece_bounds::left_out))
        faces_.set_aside.push_back({face, *reason, std::string(text_of(*reason))});
      operand_.resize(faces_.pieces.size(), operand);
    }
    first_point += solid.point_count();
  }

  // 3. Which planes pass through each point.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  pairs.reserve(faces_.corners.size());
  for (std::size_t i = 0; i < pieces().size(); ++i)
    for (const Piece_corner& corner : corners(i)) pairs.emplace_back(corner.point, pieces()[i].support.id());
  incidences_ = Point_planes(points().size(), pairs);
  faces_.counters.points_read = points_read;
  faces_.counters.points = points().size();
  faces_.counters.faces_read = faces_read;
  faces_.counters.faces = faces_read - faces_.set_aside.size();
  faces_.counters.pieces = pieces().size();
}

std::pair<std::uint32_t, Face_id> Operands::source_of(Face_id face) const {
  const auto after = std::upper_bound(first_face_.begin(), first_face_.end(), face);
  const auto operand = static_cast<std::uint32_t>(after - first_face_.begin() - 1);
  return {operand, face - first_face_[operand]};
}

Operands Operands::with_room_for_edges() const {
  Operands copy;
  copy.faces_.planes = Plane_table(points());
  copy.faces_.planes.reserve(planes().size() + planes().size() / 4 + 64);
  copy = *this;  // into that room
  return copy;
}

Predicates Operands::predicates() const& { return {points(), planes(), incidences_}; }

Vertex Operands::vertex(const Predicates& predicates, std::size_t piece, std::size_t k) const {
  const std::span<const Piece_corner> loop = corners(piece);
  const Piece_corner& before = loop[k == 0 ? loop.size() - 1 : k - 1];
  return predicates.input_vertex(loop[k].point, pieces()[piece].support.id(), before.edge.id(), loop[k].edge.id());
}

bool is_whole_face(const Operands& operands, std::size_t piece) {
  const std::vector<Piece>& all = operands.pieces();
  return (piece == 0 || all[piece - 1].face != all[piece].face) &&
         (piece + 1 == all.size() || all[piece + 1].face != all[piece].face);
}

std::vector<Operand_flaw> flaws(const Operands& operands) {
  std::vector<Operand_flaw> found;
  // 1. Faces without a surface of their own.
  for (const Set_aside& entry : operands.set_aside())
    if (entry.reason != Set_aside_reason::zero_area) {
      const auto [operand, face] = operands.source_of(entry.face);
      found.push_back({operand, face, entry.why, {}, {}});
    }

  // 2. Edges of each operand that have as many opposites as equals cancel.
  std::vector<std::size_t> ends(operands.points().size() +
                                1);  // first where a point's edges begin, then where they end
  for_each_edge(operands, [&](std::uint32_t p, const Edge_use&) { ++ends[p + 1]; });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Edge_use> edges(ends.back());
  for_each_edge(operands, [&](std::uint32_t p, const Edge_use& edge) { edges[ends[p]++] = edge; });
  std::vector<Edge_left> left;
  for (std::uint32_t p = 0; p < operands.points().size(); ++p) {
    const std::span<Edge_use> of_point(edges.data() + (p == 0 ? 0 : ends[p - 1]), edges.data() + ends[p]);
    std::sort(of_point.begin(), of_point.end(), [](const Edge_use& a, const Edge_use& b) {
      return a.greater != b.greater ? a.greater < b.greater : a.piece < b.piece;
    });
    for (std::size_t i = 0, j = 0; i < of_point.size(); i = j) {
      const std::uint32_t operand = operands.operand_of_piece(of_point[i].piece);
      long net = 0;
      const Edge_use* last[2] = {nullptr, nullptr};
      for (j = i; j < of_point.size() && of_point[j].greater == of_point[i].greater &&
                  operands.operand_of_piece(of_point[j].piece) == operand;
           ++j) {
        net += of_point[j].is_backwards ? -1 : 1;
        last[of_point[j].is_backwards] = &of_point[j];
      }
      if (net != 0) left.push_back({p, operand, *last[net < 0], net});
    }
  }
  // 3. The others may cancel on their lines. P-08a
  std::stable_sort(left.begin(), left.end(),
                   [](const Edge_left& a, const Edge_left& b) { return a.operand < b.operand; });
  for (std::size_t begin = 0, end = 0; begin < left.size(); begin = end) {
    const std::uint32_t operand = left[begin].operand;
    while (end < left.size() && left[end].operand == operand) ++end;
    const std::span<const Edge_left> own(left.data() + begin, left.data() + end);
    Line_table lines(operands.points());
    std::unordered_map<std::uint64_t, long> jumps;  // by line and point
    for (const auto& [lesser, of, edge, net] : own) {
      const std::uint64_t line = std::uint64_t{lines.through(lesser, edge.greater).id} << 32;
      jumps[line | lesser] -= net;
      jumps[line | edge.greater] += net;
    }
    std::vector<bool> open(lines.size());
    for (const auto& [place, jump] : jumps)
      if (jump != 0) open[place >> 32] = true;
    for (const auto& [lesser, of, edge, net] : own) {
      if (!open[lines.through(lesser, edge.greater).id]) continue;
      found.push_back({operand,
                       operands.source_of(operands.pieces()[edge.piece].face).second,
                       {},
                       operands.position(edge.is_backwards ? edge.greater : lesser),
                       operands.position(edge.is_backwards ? lesser : edge.greater)});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Operand_flaw& a, const Operand_flaw& b) { return a.operand < b.operand; });
  return found;
}

}  // namespace sightline
