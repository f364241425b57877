#include <sightline/algorithms/point_visibility/line_drawing.h>

#include <cstddef>
#include <utility>

namespace sightline {

Exact_point Drawn_line::at(const Rational& t) const {
  Exact_point p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = ends[0][k] + t * (ends[1][k] - ends[0][k]);
  return p;
}

std::vector<Drawn_line> line_drawing(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                                     const Piece_boxes& boxes, int threads, const Line_progress& progress) {
  static constexpr const char* names[] = {"boundary", "silhouette", "smooth", "crease"};
  const Scene& scene = view.scene();
  std::vector<Drawn_line> lines;
  for (Drawn_edge& drawn : hidden_lines(view, surface, threads, progress)) {
    if (drawn.parts.empty()) continue;
    Drawn_line& line = lines.emplace_back(Drawn_line{{scene.position(drawn.edge.p), scene.position(drawn.edge.q)},
                                                     names[static_cast<std::size_t>(drawn.kind)],
                                                     {},
                                                     std::move(drawn.parts)});
    for (const std::uint32_t piece : drawn.edge.pieces) line.faces.push_back(scene.pieces()[piece].face);
  }
  for (Drawn_crossing& crossing : visible_crossings(view, surface, boxes, threads, progress))
    lines.push_back({crossing.ends, "intersection", std::move(crossing.faces), {{0, 1, Line_part::nothing}}});
  return lines;
}

}  // namespace sightline
