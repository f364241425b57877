// Images of what an eye sees, and faces by what of a light they see.

#include "bindings.h"

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/weak_visibility/partition/partition.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace sightline::python {

namespace {

using Direction = std::array<double, 3>;
using Colours = py::array_t<double, py::array::c_style | py::array::forcecast>;

Direction direction_of(const py::handle& of, const std::string& what) {
  const Exact_point exact = point_of(of, what);
  return {nearest_double(exact[0]), nearest_double(exact[1]), nearest_double(exact[2])};
}

/// Pre: width and height are from 1 to 2^20.
Pixel_view pixels_of(const py::object& eye, const py::tuple& axes, std::uint32_t width, std::uint32_t height) {
  return {point_of(eye, "eye"),
          direction_of(axes[0], "look"),
          direction_of(axes[1], "right"),
          direction_of(axes[2], "up"),
          width,
          height};
}

template <class T, class List>
py::array_t<T> grid_of(const Pixel_view& pixels, const List& numbers) {
  py::array_t<T> grid({static_cast<py::ssize_t>(pixels.height), static_cast<py::ssize_t>(pixels.width)});
  std::copy(numbers.begin(), numbers.end(), grid.mutable_data());
  return grid;
}

/// What the rays through pixels' centres meet.
struct Met {
  std::vector<std::int64_t> faces;
  std::vector<std::int8_t> sides;
  std::vector<bool> tied;
};

/// Of each pixel the face that the ray through its centre meets first, or -1, from which side, and whether a rule
/// chose.
py::tuple met_at_centres(const Model& model, const py::object& eye, const py::tuple& axes, std::uint32_t width,
                         std::uint32_t height, const Question& question) {
  const Pixel_view pixels = pixels_of(eye, axes, width, height);
  const Met met = answer_to(question, [model, pixels](const Asking& asking) {
    const Exact_view view(model.scene(), pixels.eye);
    Image_options options;
    options.threads = asking.threads;
    options.progress = progress_within_budget(asking);
    const Piece_image image = centres(view, pixels, options);
    Met all;
    for (std::size_t i = 0; i < image.pieces.size(); ++i) {
      const std::uint32_t piece = image.pieces[i];
      const bool is_met = piece != Piece_image::nothing;
      all.faces.push_back(is_met ? std::int64_t{model.scene().pieces()[piece].face} : -1);
      all.sides.push_back(is_met ? static_cast<std::int8_t>(view.eye_side(piece) == CGAL::POSITIVE ? 1 : -1)
                                 : std::int8_t{0});
      all.tied.push_back(image.tied[i] != 0);
    }
    return all;
  });
  return py::make_tuple(grid_of<std::int64_t>(pixels, met.faces), grid_of<std::int8_t>(pixels, met.sides),
                        grid_of<bool>(pixels, met.tied));
}

/// Sums of faces' colours over each pixel's square, and its share in which something is seen. Pre: a row of three for
/// each face.
py::tuple means_of(const Model& model, const py::object& eye, const py::tuple& axes, std::uint32_t width,
                   std::uint32_t height, const Colours& colours, const Question& question) {
  const Pixel_view pixels = pixels_of(eye, axes, width, height);
  std::vector<double> of_faces(colours.data(), colours.data() + colours.size());
  const auto [sums, shares] =
      answer_to(question, [model, pixels, of_faces = std::move(of_faces)](const Asking& asking) {
        const std::size_t count = std::size_t{pixels.width} * pixels.height;
        std::vector<double> to(3 * count), share(count);
        const Exact_view view(model.scene(), pixels.eye, field_of(pixels));
        Visible_options looking;
        looking.threads = asking.threads;
        looking.progress = progress_within_budget(asking);
        const auto surface = visible_surface(view, Piece_boxes(model.scene()), field_of_view(view), looking);
        const auto colour = [&](std::uint32_t piece) {
          const double* of = of_faces.data() + 3 * std::size_t{model.scene().pieces()[piece].face};
          return Colour{of[0], of[1], of[2]};
        };
        const auto keep = [&](const Mean_row& row) {
          const std::size_t first = std::size_t{row.y} * pixels.width;
          for (std::size_t x = 0; x < pixels.width; ++x) {
            for (std::size_t k = 0; k < 3; ++k) to[3 * (first + x) + k] = row.colours[x][k];
            share[first + x] = row.covered[x];
          }
        };
        Image_options drawing;
        drawing.threads = asking.threads;
        drawing.progress = looking.progress;
        visible_means(view, surface, pixels, colour, keep, drawing);
        return std::pair(std::move(to), std::move(share));
      });
  py::array_t<double> image({static_cast<py::ssize_t>(height), static_cast<py::ssize_t>(width), py::ssize_t{3}});
  std::copy(sums.begin(), sums.end(), image.mutable_data());
  return py::make_tuple(image, grid_of<double>(pixels, shares));
}

// ---- Partitions

py::tuple bounded(const Bounded& b) { return py::make_tuple(b.low, b.high); }

py::object number_of(std::size_t cell, std::size_t before) {
  return cell == Light_partition::none ? py::object(py::none()) : py::object(py::int_(before + cell));
}

/// One after the other: cells (light, piece, point, share of the piece), borders (kind, piece, curve, the cells beside
/// it, its ends), and of each piece of the face its number and its chart.
struct Partition_lists {
  py::list cells, borders, charts;

  void add(const Light_partition& partition, std::uint32_t piece) {
    const std::size_t before = cells.size();
    for (const Light_partition::Cell& cell : partition.cells) {
      py::list seen_edges;
      for (const auto& of_source : cell.edges) {
        py::list edges;
        for (const auto& [p, q] : of_source) edges.append(py::make_tuple(fractions(p), fractions(q)));
        seen_edges.append(edges);
      }
      cells.append(py::make_tuple(name_of(cell.light), piece, fractions(partition.point(cell.at[0], cell.at[1])),
                                  bounded(cell.area), seen_edges));
    }
    for (const Light_partition::Border& border : partition.borders) {
      const Plane_curve& curve = partition.curves[border.curve];
      py::tuple coefficients(curve.c.size());
      for (std::size_t k = 0; k < curve.c.size(); ++k) coefficients[k] = py::int_(py::str(to_string(curve.c[k])));
      borders.append(py::make_tuple(curve.is_line() ? "line" : "conic", piece, coefficients,
                                    number_of(border.below, before), number_of(border.above, before),
                                    py::make_tuple(bounded(border.x[0]), bounded(border.x[1])),
                                    py::make_tuple(bounded(border.y[0]), bounded(border.y[1]))));
    }
    for (const Light_partition::Upright& border : partition.uprights)
      borders.append(py::make_tuple("upright", piece, py::tuple(), number_of(border.left, before),
                                    number_of(border.right, before),
                                    py::make_tuple(bounded(border.x), bounded(border.x)),
                                    py::make_tuple(bounded(border.y[0]), bounded(border.y[1]))));
    charts.append(py::make_tuple(piece, fractions(partition.chart[0]), fractions(partition.chart[1]),
                                 fractions(partition.chart[2])));
  }
};

py::tuple partition_of(const Model& model, const py::object& source, Face_id face, bool all_borders,
                       const Question& question) {
  const std::vector<std::vector<Exact_point>> sources = sources_of(model, source);
  std::vector<std::uint32_t> pieces;
  const Scene& scene = *answer_to(plain_question(), [model](const Asking&) { return &model.scene(); });
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i)
    if (scene.pieces()[i].face == face) pieces.push_back(i);
  if (pieces.empty())
    throw std::out_of_range("face " + std::to_string(face) + " is not there, or was left out: see left_out");
  const auto [found, shares] = answer_to(question, [model, pieces, sources, all_borders](const Asking& asking) {
    std::vector<Light_partition> all;
    const Light_partitioner partitioner(model.scene());
    Partition_options options;
    options.all_borders = all_borders;
    options.out_of_time = end_of_budget(asking);
    Partition_counters counters;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      options.progress = [&](double share) {
        if (asking.progress)
          asking.progress(static_cast<std::size_t>(1000 * (static_cast<double>(k) + share)), 1000 * pieces.size());
      };
      all.push_back(partitioner.partition(pieces[k], sources, options, counters));
    }
    const std::array<Bounded, lights> of_face = shares_of_face(model.scene(), all);
    return std::pair(std::move(all), of_face);
  });
  Partition_lists lists;
  for (const Light_partition& partition : found) lists.add(partition, scene.pieces()[partition.piece].number);
  py::dict by_light;
  for (const Light light : {Light::lit, Light::penumbra, Light::umbra, Light::undecided})
    by_light[name_of(light)] = bounded(shares[static_cast<std::size_t>(light)]);
  return py::make_tuple(by_light, lists.cells, lists.borders, lists.charts);
}

}  // namespace

void add_pictures(py::module_& module) {
  module.def("centres", &met_at_centres, py::arg("model"), py::arg("eye"), py::arg("axes"), py::arg("width"),
             py::arg("height"), py::arg("question"));
  module.def("means", &means_of, py::arg("model"), py::arg("eye"), py::arg("axes"), py::arg("width"), py::arg("height"),
             py::arg("colours"), py::arg("question"));
  module.def("partition", &partition_of, py::arg("model"), py::arg("source"), py::arg("face"), py::arg("all_borders"),
             py::arg("question"));
}

}  // namespace sightline::python
