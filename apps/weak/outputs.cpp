#include "outputs.h"

#include "../support/common.h"

#include <algorithm>

namespace sightline::app {

static const char* name_of(Event_kind kind) {
  return kind == Event_kind::horizon ? "horizon" : kind == Event_kind::edge_vertex ? "edge and vertex" : "triple";
}

Json surfaces_json(const Scene& scene, const std::vector<Event_surface>& surfaces) {
  Json all = Json::array();
  for (const Event_surface& surface : surfaces) {
    Json rulings = Json::array();
    for (const auto& [p, q] : surface.rulings) rulings.push_back({point_json(p), point_json(q)});
    const Piece& piece = scene.pieces()[surface.piece];
    all.push_back({{"kind", name_of(surface.kind)},
                   {"face", piece.face},
                   {"piece", piece.number},
                   {"source", surface.source},
                   {"rulings", std::move(rulings)}});
  }
  return {{"format", "sightline event surfaces 1"}, {"scene", scene.file()}, {"surfaces", std::move(all)}};
}

std::string surfaces_obj(const std::vector<Event_surface>& surfaces) {
  std::string text;
  std::size_t points = 0;
  for (const Event_surface& surface : surfaces) {
    const std::string kind = surface.kind == Event_kind::edge_vertex ? "edge_and_vertex" : name_of(surface.kind);
    text += fmt::format("g {0}\nusemtl {0}\n", kind);
    for (const auto& ruling : surface.rulings)
      for (const Exact_point& p : ruling)
        text += fmt::format("v {} {} {}\n", nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2]));
    for (std::size_t k = 1; k < surface.rulings.size(); ++k, points += 2)
      text += fmt::format("f {} {} {} {}\n", points + 1, points + 2, points + 4, points + 3);
    points += 2;
  }
  return text;
}

Json open_json(const Occluders& occluders, const Sources& sources, const Weakly_visible& found) {
  constexpr std::size_t most_cells = 4;
  const std::vector<Piece>& pieces = occluders.scene().pieces();
  const auto points_json = [](const std::vector<Exact_point>& points) {
    Json list = Json::array();
    for (const Exact_point& p : points) list.push_back(point_json(p));
    return list;
  };
  Json all = Json::array();
  for (const Weakly_visible::Pair& pair : found.open) {
    Json cells = Json::array();
    for (const Open_cell& cell : open_cells(occluders, sources.polygons[pair.source], pair, most_cells)) {
      Json sides = Json::array();
      for (const Open_cell::Side& side : cell.sides)
        sides.push_back({{"face", pieces[side.edge.piece].face},
                         {"piece", pieces[side.edge.piece].number},
                         {"corner", side.edge.corner},
                         {"side", side.sign}});
      cells.push_back(
          {{"source", points_json(cell.source)}, {"target", points_json(cell.target)}, {"sides", std::move(sides)}});
    }
    const auto is_open = [](const Weak_step& step) { return step.kind == Weak_step::Kind::open; };
    const auto count = std::count_if(pair.answer.proof.begin(), pair.answer.proof.end(), is_open);
    all.push_back({{"face", pieces[pair.piece].face},
                   {"piece", pieces[pair.piece].number},
                   {"source", pair.source},
                   {"open_cells", count},
                   {"cells", std::move(cells)}});
  }
  return all;
}

}  // namespace sightline::app
