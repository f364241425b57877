#include "partition.h"

#include "partition_picture.h"

#include <cmath>

namespace sightline::app {

namespace {

Bounded share_of(const Divided_face& divided, Light light) { return divided.shares[static_cast<std::size_t>(light)]; }

// ---- JSON

Json bounded_json(const Bounded& b) { return {b.low, b.high}; }

Json cell_number(std::size_t cell, std::size_t before) {
  return cell == Light_partition::none ? Json() : Json(before + cell);
}

Json rays_json(const Sampled_face& sampled, std::size_t asked) {
  Json result{{"rays", sampled.rays}};
  if (sampled.ended) result["asked"] = asked;
  for (const Light light : {Light::lit, Light::penumbra, Light::umbra})
    result[name_of(light)] = sampled.shares[static_cast<std::size_t>(light)];
  return result;
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
                                            {"point", point_json(partition.point(cell.at[0], cell.at[1]))},
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

// ---- Steps

/// Of what does not go together, before a long read.
void check_usage(const Source_arguments& of_sources) {
  if (of_sources.two_sided)
    throw Usage_error("--partition is of a face's front: leave out --two-sided; --flip turns the scene round");
  if (!of_sources.volumes.empty() || !of_sources.solid.empty())
    throw Usage_error("--partition wants polygons that look: --from-face or --from, not a volume");
}

void check_faces(const std::vector<Face_id>& faces, const Scene& scene) {
  for (const Face_id face : faces)
    if (std::none_of(scene.pieces().begin(), scene.pieces().end(),
                     [&](const Piece& piece) { return piece.face == face; }))
      throw Usage_error(fmt::format(
          "--partition {}: the scene has no such face, or it was set aside (`sightline info` lists them)", face));
}

/// Each of the faces, divided; what the budget leaves no time for is undecided.
std::vector<Divided_face> divided_faces(const Partition_arguments& arguments, const Light_partitioner& partitioner,
                                        const Scene& scene, const Sources& sources, const Time_limit& limit,
                                        Partition_counters& counters) {
  Progress progress("dividing");
  Partition_options options;
  options.all_borders = arguments.all_borders;
  options.out_of_time = limit.end();
  std::vector<Divided_face> divided;
  for (std::size_t k = 0; k < arguments.faces.size(); ++k) {
    Divided_face& own = divided.emplace_back(Divided_face{arguments.faces[k], {}, {}});
    options.progress = [&](double share) {
      progress(static_cast<std::size_t>(1000 * (static_cast<double>(k) + share)), 1000 * arguments.faces.size());
    };
    for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece)
      if (scene.pieces()[piece].face == own.face)
        own.pieces.push_back(partitioner.partition(piece, sources.points, options, counters));
    own.shares = shares_of_face(scene, own.pieces);
  }
  return divided;
}

Json result_json(const Scene& scene, const std::vector<Divided_face>& divided,
                 const std::optional<Sampled_face>& sampled, std::size_t rays) {
  Json all = Json::array(), result;
  for (const Divided_face& own : divided) all.push_back(face_json(scene, own));
  if (sampled) all.front()["sampled"] = rays_json(*sampled, rays);
  result["partition"] = all.front();
  if (all.size() > 1) result["partitions"] = std::move(all);
  return result;
}

void print(const Divided_face& own) {
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
    constexpr double digits = 1e6;  // of which six are shown
    if (100 * (share.high - share.low) * digits <= 1) return fmt::format("{:.6f} %", 50 * (share.low + share.high));
    return fmt::format("between {:.6f} and {:.6f} %", std::floor(100 * share.low * digits) / digits,
                       std::ceil(100 * share.high * digits) / digits);
  };
  row(fmt::format("face {}", own.face),
      fmt::format("lit {}, penumbra {}, umbra {}{}", percent(Light::lit), percent(Light::penumbra),
                  percent(Light::umbra),
                  share_of(own, Light::undecided).high > 0 ? ", undecided " + percent(Light::undecided) : ""));
  row("", fmt::format("{} cells; borders: {} parts of lines, {} of conics", cells, lines, conics));
}

void print(const Sampled_face& sampled, std::size_t asked) {
  const std::string rays = sampled.ended ? fmt::format("{} of {} rays, as the budget ran out", sampled.rays, asked)
                                         : fmt::format("{} rays", sampled.rays);
  if (sampled.rays == 0) return row("", "by " + rays);
  const auto percent = [&](Light light) {
    return fmt::format("{} {:.2f} %", name_of(light), 100 * sampled.shares[static_cast<std::size_t>(light)]);
  };
  row("", fmt::format("by {}: {}, {}, {}", rays, percent(Light::lit), percent(Light::penumbra), percent(Light::umbra)));
}

void print(const Partition_counters& counters) {
  const Border_counters& b = counters.borders;
  row("candidates", fmt::format("{} planes of edges, {} triples; {} curves kept", b.planes, b.triples, b.curves));
  row("rectangles", fmt::format("{}: {} seen alike, {} with curves, {} sectors", counters.boxes, counters.alike,
                                counters.arrangements, counters.sectors));
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
  command
      .add_option("--beside-rays", rays,
                  "of a partition: beside it, what about so many rays at random make of the first face, in squares of "
                  "16 rays each, which are lit if all reach a source")
      .check(range(16, 10000000))
      .needs(partition);
  return partition;
}

Exit run_partition(const Partition_arguments& arguments, const Common& common, const Source_arguments& of_sources,
                   const std::string& svg) {
  check_usage(of_sources);
  const Polygon_soup soup = common.read();
  const Scene scene = scene_of(soup);
  check_faces(arguments.faces, scene);

  // 1. The faces, divided, and what rays make of the first of them.
  Stopwatch watch;
  const Occluders occluders(scene);
  const Sources sources = sources_of(of_sources, common, soup, occluders);
  const Light_partitioner partitioner(scene);
  const double prepare_seconds = watch.seconds();
  watch = {};
  const Time_limit limit(common.budget);  // of rays, too
  Partition_counters counters;
  const std::vector<Divided_face> divided = divided_faces(arguments, partitioner, scene, sources, limit, counters);
  const double seconds = watch.seconds();
  watch = {};
  std::optional<Sampled_face> sampled;
  if (arguments.rays > 0)
    sampled = sampled_face(occluders, divided.front(), sources.polygons, arguments.rays, common.seed, limit.end());
  const double ray_seconds = watch.seconds();

  // 2. What is written and told of them.
  if (!svg.empty()) write_file(svg, picture_of(scene, divided.front(), sampled ? &*sampled : nullptr));
  const bool open = std::any_of(divided.begin(), divided.end(),
                                [](const Divided_face& own) { return share_of(own, Light::undecided).high > 0; });
  const Exit exit = open || (sampled && sampled->ended) ? Exit::undecided : Exit::done;
  Json all_seconds{{"prepare", prepare_seconds}, {"partition", seconds}};
  if (sampled) all_seconds["rays"] = ray_seconds;
  if (write_json(common, "weak", scene,
                 common.json.empty() ? Json() : result_json(scene, divided, sampled, arguments.rays),
                 counters_json(counters), all_seconds))
    return exit;
  scene_rows(scene);
  row("sources", fmt::format("{} convex polygons", sources.polygons.size()));
  for (const Divided_face& own : divided) print(own);
  if (sampled) print(*sampled, arguments.rays);
  print(counters);
  row("seconds", fmt::format("{:.4f}, and {:.4f} to prepare the scene{}", seconds, prepare_seconds,
                             sampled ? fmt::format(", {:.4f} by rays", ray_seconds) : ""));
  return exit;
}

}  // namespace sightline::app
