// The cells of levels, and what these see.

#include "bindings.h"

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/levels/coarse.h>
#include <sightline/algorithms/levels/grid.h>
#include <sightline/algorithms/levels/pvs.h>
#include <sightline/algorithms/levels/stated_cell.h>
#include <sightline/algorithms/levels/volumes.h>
#include <sightline/algorithms/solids/measure.h>
#include <sightline/io/file.h>
#include <sightline/io/read.h>
#include <sightline/kernel/quoted.h>
#include <sightline/own_leaves.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace sightline::python {

namespace {

struct Level {
  std::shared_ptr<const Level_cells> cells;
  std::uint32_t volumes = 0;  // that they are within
};

bool have_same_points(const Polygon_soup& a, const Polygon_soup& b) {
  if (a.point_count() != b.point_count() || a.face_count() != b.face_count()) return false;
  for (Point_id p = 0; p < a.point_count(); ++p)
    if (a.point(p) != b.point(p)) return false;
  return true;
}

/// The tree of the compiled level that a scene was read from. Errors: ValueError where it was not, or has changed.
Space_tree own_tree(const Model& model) {
  const std::string& file = model.soup().file;
  if (std::filesystem::is_regular_file(file))
    if (const std::string bytes = read_bytes(file); looks_like_quake_level(bytes)) {
      if (!have_same_points(read_scene(bytes, Format::bsp, file), model.soup()))
        throw py::value_error(printable(file, file.size(), false) + " is no longer what was read; read it again");
      return space_tree(read_quake_level({file, bytes}), file);
    }
  throw py::value_error("leaves are of a level that is compiled (.bsp, version 29) and was read; this scene is none");
}

/// The cells of a scene, within even boxes where `grid` has three counts, or within the polyhedra of `volumes`, a model
/// or nullptr, or within the leaves of its file.
Level level_of(const Model& model, unsigned candidates, std::uint64_t seed, const py::list& grid, const Model* volumes,
               bool leaves, const Question& question) {
  std::vector<std::uint32_t> counts;
  for (const py::handle count : grid) counts.push_back(py::cast<std::uint32_t>(count));
  Space_tree own = leaves ? own_tree(model) : Space_tree();
  std::optional<Model> rooms;
  if (volumes != nullptr) rooms = *volumes;
  return answer_to(question, [=, own = std::move(own)](const Asking& asking) mutable {
    Cell_options options;
    options.tree = std::move(own);
    options.candidates = candidates;
    options.seed = seed;
    options.threads = asking.threads;
    options.progress = progress_within_budget(asking);
    if (!counts.empty()) options.tree = even_boxes(model.soup(), {counts.at(0), counts.at(1), counts.at(2)});
    Volume_division division;
    if (rooms) {
      division = volume_division(rooms->soup(), progress_within_budget(asking));
      options.tree = std::move(division.tree);
    }
    return Level{std::make_shared<const Level_cells>(model.soup(), options), division.volumes};
  });
}

const Level_cell& cell_of(const Level& level, Cell_id cell) { return level.cells->cells().at(cell); }

py::tuple corners_of(const Level& level, const std::vector<std::uint32_t>& corners) {
  py::tuple all(corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) all[k] = fractions(level.cells->points()[corners[k]]);
  return all;
}

/// A wall's two cells, the second None at the end of the world; its corners; its open parts; faces in front, behind.
py::tuple wall_of(const Level& level, std::size_t i) {
  const Cell_wall& wall = level.cells->walls().at(i);
  py::tuple open(wall.open.size());
  for (std::size_t k = 0; k < open.size(); ++k) open[k] = corners_of(level, wall.open[k]);
  const py::object behind = wall.behind == no_cell ? py::object(py::none()) : py::object(py::int_(wall.behind));
  return py::make_tuple(wall.front, behind, corners_of(level, wall.corners), open, ids(wall.faces_front),
                        ids(wall.faces_behind));
}

Rational volume_of(const Level& level, Cell_id cell) {
  cell_of(level, cell);
  Polygon_soup surface;
  std::vector<Point_id> loop;
  for (const std::vector<Exact_point>& wall : stated_cell(*level.cells, cell).walls) {
    loop.clear();
    for (const Exact_point& p : wall) loop.push_back(surface.add_point(p[0], p[1], p[2]));
    surface.add_face(loop);
  }
  return volume(surface);
}

/// How the cells of a level are asked what they see.
Pvs_options looking(std::uint64_t seed, bool outside, const Asking& asking) {
  Pvs_options options;
  options.outside = outside;
  options.threads = asking.threads;
  options.progress = asking.progress;
  options.search.seed = seed;
  options.search.out_of_time = end_of_budget(asking);
  return options;
}

/// Of each cell that is asked about its number, what it sees, and what is undecided.
template <class Found>
py::list rows_of(const Found& found) {
  py::list rows;
  for (Cell_id cell = 0; cell < found.is_asked.size(); ++cell)
    if (found.is_asked[cell] != 0)
      rows.append(py::make_tuple(cell, ids(found.visible[cell]), ids(found.undecided[cell])));
  return rows;
}

py::list faces_seen(const Level& level, std::uint64_t seed, bool outside, const Question& question) {
  return rows_of(answer_to(question, [level, seed, outside](const Asking& asking) {
    return potentially_visible(*level.cells, looking(seed, outside, asking));
  }));
}

py::list cells_seen(const Level& level, std::uint64_t seed, bool outside, const Question& question) {
  return rows_of(answer_to(question, [level, seed, outside](const Asking& asking) {
    return mutually_visible_cells(*level.cells, looking(seed, outside, asking));
  }));
}

/// A number of each cell.
template <class Of>
auto of_cells(Of of) {
  return [of](const Level& level) {
    std::vector<std::int64_t> all;
    for (const Level_cell& cell : level.cells->cells()) all.push_back(of(cell));
    return ids(all);
  };
}

}  // namespace

void add_levels(py::module_& module) {
  py::class_<Level>(module, "Level")
      .def("__len__", [](const Level& level) { return level.cells->cells().size(); })
      .def_property_readonly("is_closed", [](const Level& level) { return level.cells->is_closed(); })
      .def_property_readonly("portals", [](const Level& level) { return level.cells->counters().portals; })
      .def_property_readonly("wall_count", [](const Level& level) { return level.cells->walls().size(); })
      .def("solid", of_cells([](const Level_cell& cell) { return cell.is_solid ? 1 : 0; }))
      .def("outside", of_cells([](const Level_cell& cell) { return cell.is_outside ? 1 : 0; }))
      .def("windings", of_cells([](const Level_cell& cell) { return cell.winding; }))
      .def("regions", of_cells([](const Level_cell& cell) { return cell.region; }))
      .def_readonly("volumes", &Level::volumes)
      .def(
          "coarse",
          [](const Level& level, std::size_t most) {
            std::vector<std::int64_t> all;
            for (const std::uint32_t region : answer_to(
                     plain_question(), [level, most](const Asking&) { return convex_regions(*level.cells, most); }))
              all.push_back(region == no_cell ? -1 : std::int64_t{region});
            return ids(all);
          },
          py::arg("most"))
      .def("leaves", of_cells([](const Level_cell& cell) { return cell.leaf; }))
      .def(
          "faces", [](const Level& level, Cell_id cell) { return ids(cell_of(level, cell).faces); }, py::arg("cell"))
      .def(
          "walls", [](const Level& level, Cell_id cell) { return ids(cell_of(level, cell).walls); }, py::arg("cell"))
      .def("wall", &wall_of, py::arg("i"))
      .def(
          "portals_of",
          [](const Level& level, Cell_id cell) {
            cell_of(level, cell);
            py::list all;
            for (const std::vector<Exact_point>& portal : portals_of(*level.cells, cell)) {
              py::tuple corners(portal.size());
              for (std::size_t k = 0; k < portal.size(); ++k) corners[k] = fractions(portal[k]);
              all.append(corners);
            }
            return all;
          },
          py::arg("cell"))
      .def(
          "inside",
          [](const Level& level, Cell_id cell) {
            cell_of(level, cell);
            return fractions(level.cells->inside(cell));
          },
          py::arg("cell"))
      .def(
          "volume", [](const Level& level, Cell_id cell) { return fraction(volume_of(level, cell)); }, py::arg("cell"))
      .def(
          "at",
          [](const Level& level, const py::object& point) {
            const Cell_id cell = level.cells->at(point_of(point, "point"));
            return cell == no_cell ? py::object(py::none()) : py::object(py::int_(cell));
          },
          py::arg("point"))
      .def(
          "way_out",
          [](const Level& level, const py::object& point) {
            return ids(level.cells->way_out(point_of(point, "point")));
          },
          py::arg("point"));
  module.def("cells", &level_of, py::arg("model"), py::arg("candidates"), py::arg("seed"), py::arg("grid"),
             py::arg("volumes").none(true), py::arg("leaves"), py::arg("question"));
  for (const auto& [name, ask] : {std::pair("faces_seen", &faces_seen), {"cells_seen", &cells_seen}})
    module.def(name, ask, py::arg("level"), py::arg("seed"), py::arg("outside"), py::arg("question"));
}

}  // namespace sightline::python
