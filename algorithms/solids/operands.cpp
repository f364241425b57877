#include <sightline/algorithms/solids/operands.h>

#include <sightline/kernel/line_table.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/face_cutter.h>

#include <algorithm>
#include <optional>
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

/// A directed edge of a piece.
struct Edge_use {
  std::uint64_t key;  // the lesser point, then the greater
  std::uint32_t piece;
  bool backwards;  // from the greater to the lesser
};

}  // namespace

Operands::Operands(std::span<const Polygon_soup> solids) {
  // 1. All points on one grid.
  Coordinates all;
  std::size_t points_read = 0, faces_read = 0;
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
  std::size_t first_point = 0;
  std::vector<Point_loop> loops;
  for (std::uint32_t operand = 0; operand < solids.size(); ++operand) {
    const Polygon_soup& solid = solids[operand];
    for (Face_id f = 0; f < solid.face_count(); ++f) {
      const Face_id face = first_face_[operand] + f;
      put_on_grid(solid, f, first_point, ids, loops);
      if (const auto reason = cut_face(points(), face, loops, faces_))
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

Predicates Operands::predicates() const& { return {points(), planes(), incidences_}; }

Vertex Operands::vertex(const Predicates& predicates, std::size_t piece, std::size_t k) const {
  const std::span<const Piece_corner> loop = corners(piece);
  const Piece_corner& before = loop[k == 0 ? loop.size() - 1 : k - 1];
  return predicates.input_vertex(loop[k].point, pieces()[piece].support.id(), before.edge.id(), loop[k].edge.id());
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
  for (std::size_t begin = 0, end = 0; begin < operands.pieces().size(); begin = end) {
    const std::uint32_t operand = operands.operand_of_piece(begin);
    std::vector<Edge_use> edges;
    for (end = begin; end < operands.pieces().size() && operands.operand_of_piece(end) == operand; ++end) {
      const std::span<const Piece_corner> corners = operands.corners(end);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::uint32_t p = corners[k].point, q = corners[k + 1 == corners.size() ? 0 : k + 1].point;
        edges.push_back({std::uint64_t{std::min(p, q)} << 32 | std::max(p, q), static_cast<std::uint32_t>(end), q < p});
      }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge_use& a, const Edge_use& b) {
      return std::pair(a.key, a.piece) < std::pair(b.key, b.piece);
    });
    std::vector<std::pair<const Edge_use*, long>> left;  // one of the edges, and how many more run forwards
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
      long net = 0;
      const Edge_use* last[2] = {nullptr, nullptr};
      for (j = i; j < edges.size() && edges[j].key == edges[i].key; ++j) {
        net += edges[j].backwards ? -1 : 1;
        last[edges[j].backwards] = &edges[j];
      }
      if (net != 0) left.emplace_back(last[net < 0], net);
    }
    // 3. The others may cancel on their lines. P-08a
    Line_table lines(operands.points());
    std::unordered_map<std::uint64_t, long> jumps;  // by line and point
    const auto ends = [](const Edge_use& edge) {
      return std::pair(static_cast<std::uint32_t>(edge.key >> 32), static_cast<std::uint32_t>(edge.key));
    };
    for (const auto& [edge, net] : left) {
      const auto [p, q] = ends(*edge);
      const std::uint64_t line = std::uint64_t{lines.through(p, q).id} << 32;
      jumps[line | p] -= net;
      jumps[line | q] += net;
    }
    std::vector<bool> open(lines.size());
    for (const auto& [place, jump] : jumps)
      if (jump != 0) open[place >> 32] = true;
    for (const auto& [edge, net] : left) {
      const auto [p, q] = ends(*edge);
      if (!open[lines.through(p, q).id]) continue;
      found.push_back({operand,
                       operands.source_of(operands.pieces()[edge->piece].face).second,
                       {},
                       operands.position(edge->backwards ? q : p),
                       operands.position(edge->backwards ? p : q)});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Operand_flaw& a, const Operand_flaw& b) { return a.operand < b.operand; });
  return found;
}

}  // namespace sightline
