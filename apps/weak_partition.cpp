#include "weak_partition.h"

#include <sightline/algorithms/weak_visibility/partition/partition.h>
#include <sightline/io/svg.h>
#include <sightline/kernel/vectors.h>

namespace sightline::app {

namespace {

/// A face, divided: each of its convex pieces, and its share of the area.
struct Divided_face {
  Face_id face;
  std::vector<Light_partition> pieces;
  std::vector<double> weights;
};

Bounded share_of(const Divided_face& divided, Light light) {
  Bounded sum{0, 0};
  for (std::size_t k = 0; k < divided.pieces.size(); ++k) {
    const Bounded share = divided.pieces[k].shares()[static_cast<std::size_t>(light)];
    sum.low += divided.weights[k] * share.low;
    sum.high += divided.weights[k] * share.high;
  }
  // Weights are rounded, and so are products and sums.
  if (divided.pieces.size() > 1 && sum.high > 0) {
    constexpr double rounded = 0x1p-40;
    sum = {std::max(sum.low - rounded, 0.0), std::min(sum.high + rounded, 1.0)};
  }
  return sum;
}

std::array<double, 3> rounded_vector(const Exact_point& p) {
  return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
}

double area_of(const Scene& scene, const Piece& piece) {
  Exact_point sum{0, 0, 0};
  const std::span<const Piece_corner> corners = scene.corners(piece);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Exact_point first = scene.position(corners[0].point),
                      part = cross(minus(scene.position(corners[i].point), first),
                                   minus(scene.position(corners[i + 1].point), first));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  const std::array<double, 3> normal = rounded_vector(sum);
  return std::sqrt(dot(normal, normal));
}

// ---- JSON

Json bounded_json(const Bounded& b) { return {b.low, b.high}; }

/// A point of the chart, in the file's coordinates.
Exact_point point_at(const Light_partition& partition, const Rational& x, const Rational& y) {
  Exact_point p = partition.chart[0];
  for (std::size_t k = 0; k < 3; ++k) p[k] += x * partition.chart[1][k] + y * partition.chart[2][k];
  return p;
}

Json cell_number(std::size_t cell, std::size_t before) {
  return cell == Light_partition::none ? Json() : Json(before + cell);
}

Json face_json(const Scene& scene, const Divided_face& divided) {
  Json cells = Json::array(), borders = Json::array(), charts = Json::array();
  for (const Light_partition& partition : divided.pieces) {
    const std::size_t before = cells.size();
    const std::uint32_t piece = scene.pieces()[partition.piece].number;
    charts.push_back({{"piece", piece},
                      {"origin", point_json(partition.chart[0])},
                      {"x", point_json(partition.chart[1])},
                      {"y", point_json(partition.chart[2])}});
    for (const Light_partition::Cell& cell : partition.cells) {
      Json& added = cells.emplace_back(Json{{"piece", piece},
                                            {"light", name_of(cell.light)},
                                            {"point", point_json(point_at(partition, cell.at[0], cell.at[1]))},
                                            {"area", bounded_json(cell.area)}});
      for (const auto& of_source : cell.edges) {
        Json edges = Json::array();
        for (const auto& [a, b] : of_source) edges.push_back({point_json(a), point_json(b)});
        added["edges"].push_back(std::move(edges));
      }
    }
    for (const Light_partition::Border& border : partition.borders) {
      Json coefficients = Json::array();
      for (const Integer& c : partition.curves[border.curve].c) coefficients.push_back(to_string(c));
      borders.push_back({{"piece", piece},
                         {"kind", partition.curves[border.curve].is_line() ? "line" : "conic"},
                         {"curve", std::move(coefficients)},
                         {"upper", border.upper},
                         {"below", cell_number(border.below, before)},
                         {"above", cell_number(border.above, before)},
                         {"x", {bounded_json(border.x[0]), bounded_json(border.x[1])}},
                         {"y", {bounded_json(border.y[0]), bounded_json(border.y[1])}}});
    }
    for (const Light_partition::Upright& border : partition.uprights)
      borders.push_back({{"piece", piece},
                         {"kind", "upright"},
                         {"left", cell_number(border.left, before)},
                         {"right", cell_number(border.right, before)},
                         {"x", bounded_json(border.x)},
                         {"y", {bounded_json(border.y[0]), bounded_json(border.y[1])}}});
  }
  Json result{{"face", divided.face}};
  for (const Light light : {Light::lit, Light::penumbra, Light::umbra, Light::undecided})
    result[name_of(light)] = bounded_json(share_of(divided, light));
  result["cells"] = std::move(cells);
  result["borders"] = std::move(borders);
  result["charts"] = std::move(charts);
  return result;
}

// ---- The picture

const char* fill_of(Light light) {
  constexpr const char* fills[] = {"#fdeeb5", "#d8a24c", "#3d4257", "#a05fb0"};
  return fills[static_cast<std::size_t>(light)];
}

/// The face as one sees it from its front, its first chart's x to the right.
std::string picture_of(const Scene& scene, const Divided_face& divided) {
  // 1. A frame in the plane, in doubles.
  const Light_partition& first = divided.pieces.front();
  const auto unit = [](std::array<double, 3> a) {
    const double length = std::sqrt(dot(a, a));
    for (double& x : a) x /= length;
    return a;
  };
  const std::array<double, 3> right = unit(rounded_vector(first.chart[1]));
  const auto h = scene.file_coefficients(scene.pieces()[first.piece].support);
  const Rational largest = std::max({Rational(abs(h[0])), Rational(abs(h[1])), Rational(abs(h[2]))});
  const std::array<double, 3> normal =
      unit(rounded_vector({Rational(h[0] / largest), Rational(h[1] / largest), Rational(h[2] / largest)}));
  const std::array<double, 3> up = cross(normal, right);
  const auto flat = [&](const Light_partition& partition, double x, double y) {
    const std::array<double, 3> o = rounded_vector(minus(partition.chart[0], first.chart[0])),
                                u = rounded_vector(partition.chart[1]), v = rounded_vector(partition.chart[2]);
    std::array<double, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = o[k] + x * u[k] + y * v[k];
    return Flat_point{dot(p, right), -dot(p, up)};
  };
  std::array<Flat_point, 2> box{flat(first, 0, 0), flat(first, 0, 0)};
  for (const Light_partition& partition : divided.pieces)
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
      const Flat_point p = flat(partition, x, y);
      for (std::size_t k = 0; k < 2; ++k) {
        box[0][k] = std::min(box[0][k], p[k]);
        box[1][k] = std::max(box[1][k], p[k]);
      }
    }
  constexpr double margin = 20, legend = 36, wide = 760;
  const double scale = wide / std::max(box[1][0] - box[0][0], box[1][1] - box[0][1]);
  Svg svg(static_cast<int>(std::ceil(2 * margin + scale * (box[1][0] - box[0][0]))),
          static_cast<int>(std::ceil(margin + legend + scale * (box[1][1] - box[0][1]))), "#f4f3ef");
  const auto pixel = [&](const Light_partition& partition, double x, double y) {
    const Flat_point p = flat(partition, x, y);
    return Flat_point{margin + scale * (p[0] - box[0][0]), legend + scale * (p[1] - box[0][1])};
  };

  const auto scale_of = [&](const Light_partition& partition) {
    const std::array<double, 3> u = rounded_vector(partition.chart[1]);
    return scale * std::sqrt(dot(u, u));
  };

  // 2. Cells, then borders.
  for (const Light_partition& partition : divided.pieces)
    for (const Light_partition::Strip& strip : partition.strips) {
      const char* fill = fill_of(partition.cells[strip.cell].light);
      // Between neighbouring points it is nearly a trapezoid; its own outline closes what pixels would leave open.
      const double pixels = scale_of(partition) * (strip.lower.back()[0] - strip.lower.front()[0]);
      if (pixels < 0.04) continue;
      const std::size_t steps = pixels < 4 ? 1 : std::max(strip.lower.size(), strip.upper.size()) - 1;
      for (std::size_t n = 0; n < steps; ++n) {
        std::vector<Flat_point> points;
        const auto add = [&](const std::vector<std::array<double, 2>>& side, std::size_t at) {
          const double t = static_cast<double>(at) / static_cast<double>(steps) * static_cast<double>(side.size() - 1);
          const std::size_t k = std::min(static_cast<std::size_t>(t), side.size() - 2);
          const double part = t - static_cast<double>(k);
          points.push_back(pixel(partition, side[k][0] + part * (side[k + 1][0] - side[k][0]),
                                 side[k][1] + part * (side[k + 1][1] - side[k][1])));
        };
        add(strip.lower, n);
        add(strip.lower, n + 1);
        add(strip.upper, n + 1);
        add(strip.upper, n);
        svg.polygon(std::move(points), fill, fill, 0.4);
      }
    }
  for (const Light_partition& partition : divided.pieces) {
    for (const std::vector<std::array<double, 2>>& line : partition.border_lines)
      for (std::size_t k = 0; k + 1 < line.size(); ++k)
        svg.line(pixel(partition, line[k][0], line[k][1]), pixel(partition, line[k + 1][0], line[k + 1][1]), "#20242c",
                 1.1);
  }
  std::string legend_words = fmt::format("face {}:", divided.face);
  for (const Light light : {Light::lit, Light::penumbra, Light::umbra, Light::undecided}) {
    const Bounded share = share_of(divided, light);
    if (light != Light::undecided || share.high > 0)
      legend_words += fmt::format(" {} {:.2f} %,", name_of(light), 50 * (share.low + share.high));
  }
  legend_words.pop_back();
  svg.label(margin, 24, 15, legend_words);
  return svg.text();
}

}  // namespace

Option Partition_arguments::add_to(Command command) {
  const Option partition =
      command
          .add_option("--partition", faces,
                      "instead: what of this face is lit, in penumbra and in umbra, and where the borders run, lines "
                      "and conics, exactly; with commas or again for several. --svg draws the first, --json has cells "
                      "and borders")
          .delimiter(',');
  command
      .add_flag("--all-borders", all_borders,
                "of a partition: also the borders between parts that see the sources bounded by different edges")
      .needs(partition);
  return partition;
}

Exit run_partition(const Partition_arguments& arguments, const Common& common, const Source_arguments& of_sources,
                   const std::string& svg) {
  if (of_sources.two_sided)
    throw Usage_error("--partition is of a face's front: leave out --two-sided; --flip turns the scene round");
  if (!of_sources.volumes.empty() || !of_sources.solid.empty())
    throw Usage_error("--partition wants polygons that look: --from-face or --from, not a volume");
  const Polygon_soup soup = common.read();
  const Scene scene(soup);
  for (const Face_id face : arguments.faces)
    if (std::none_of(scene.pieces().begin(), scene.pieces().end(),
                     [&](const Piece& piece) { return piece.face == face; }))
      throw Usage_error(fmt::format(
          "--partition {}: the scene has no such face, or it was set aside (`sightline info` lists them)", face));
  Stopwatch watch;
  const Occluders occluders(scene);
  const Sources sources = sources_of(of_sources, common, soup, occluders);
  const Light_partitioner partitioner(scene);
  const double prepare_seconds = watch.seconds();

  watch = {};
  Progress progress("dividing");
  Partition_options options;
  options.all_borders = arguments.all_borders;
  if (common.budget > 0) options.out_of_time = [&] { return watch.seconds() > common.budget; };
  Partition_counters counters;
  std::vector<Divided_face> divided;
  for (std::size_t k = 0; k < arguments.faces.size(); ++k) {
    Divided_face& own = divided.emplace_back(Divided_face{arguments.faces[k], {}, {}});
    options.progress = [&](double share) {
      progress(static_cast<std::size_t>(1000 * (static_cast<double>(k) + share)), 1000 * arguments.faces.size());
    };
    double sum = 0;
    for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
      if (scene.pieces()[piece].face != own.face) continue;
      own.pieces.push_back(partitioner.partition(piece, sources.points, options, counters));
      own.weights.push_back(area_of(scene, scene.pieces()[piece]));
      sum += own.weights.back();
    }
    for (double& weight : own.weights) weight /= sum;
  }
  const double seconds = watch.seconds();
  progress.clear();

  if (!svg.empty()) write_file(svg, picture_of(scene, divided.front()));
  const bool open = std::any_of(divided.begin(), divided.end(),
                                [](const Divided_face& own) { return share_of(own, Light::undecided).high > 0; });
  const Exit exit = open ? Exit::undecided : Exit::done;
  Json result;
  if (!common.json.empty()) {
    Json all = Json::array();
    for (const Divided_face& own : divided) all.push_back(face_json(scene, own));
    result["partition"] = all.front();
    if (all.size() > 1) result["partitions"] = std::move(all);
  }
  if (write_json(common, "weak", scene, std::move(result), counters_json(counters),
                 {{"prepare", prepare_seconds}, {"partition", seconds}}))
    return exit;
  scene_rows(scene);
  row("sources", fmt::format("{} convex polygons", sources.polygons.size()));
  for (const Divided_face& own : divided) {
    std::size_t cells = 0, lines = 0, conics = 0;
    for (const Light_partition& partition : own.pieces) {
      cells += partition.cells.size();
      for (const Light_partition::Border& border : partition.borders)
        if (border.below != Light_partition::none && border.above != Light_partition::none)
          ++(partition.curves[border.curve].is_line() ? lines : conics);
      for (const Light_partition::Upright& border : partition.uprights)
        lines += border.left != Light_partition::none && border.right != Light_partition::none;
    }
    const auto percent = [&](Light light) {
      const Bounded share = share_of(own, light);
      return fmt::format("{:.6f} %", 50 * (share.low + share.high));
    };
    row(fmt::format("face {}", own.face),
        fmt::format("lit {}, penumbra {}, umbra {}{}", percent(Light::lit), percent(Light::penumbra),
                    percent(Light::umbra),
                    share_of(own, Light::undecided).high > 0 ? ", undecided " + percent(Light::undecided) : ""));
    row("", fmt::format("{} cells; borders: {} parts of lines, {} of conics", cells, lines, conics));
  }
  const Border_counters& b = counters.borders;
  row("candidates", fmt::format("{} planes of edges, {} triples; {} curves kept", b.planes, b.triples, b.curves));
  row("rectangles", fmt::format("{}: {} seen alike, {} with curves, {} sectors", counters.boxes, counters.alike,
                                counters.arrangements, counters.sectors));
  row("seconds", fmt::format("{:.4f}, and {:.4f} to prepare the scene", seconds, prepare_seconds));
  return exit;
}

}  // namespace sightline::app
