#include <sightline/harness/laws/weak_partition.h>

#include <sightline/algorithms/weak_visibility/events/homogeneous.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/partition/partition.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/weak_outline.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sightline::harness {

namespace {

using Place = std::array<Rational, 2>;

Exact_point point_of(const Light_partition& partition, const Place& at) {
  Exact_point p = partition.chart[0];
  for (std::size_t k = 0; k < 3; ++k) p[k] += at[0] * partition.chart[1][k] + at[1] * partition.chart[2][k];
  return p;
}

/// What segments from a point of a cell to the source contradict: one that is free, umbra; one that is not, or does not
/// begin in front of both, lit. Segments at random, so that none only touches something.
bool is_contradicted(const Occluders& occluders, const Weak_source& source, std::uint32_t piece,
                     const Light_partition& partition, const Light_partition::Cell& cell, Random& random) {
  constexpr int segments = 6;
  const Near_plane& plane = occluders.plane(piece);
  const Near_point p = occluders.located(point_of(partition, cell.at));
  for (int k = 0; k < segments; ++k) {
    Homogeneous sum{0, 0, 0, 0};
    for (const Near_point& corner : source.polygon) {
      const unsigned long weight = 1 + random.below(1u << 20);
      for (std::size_t i = 0; i < 4; ++i) sum[i] += weight * corner.exact[i];
    }
    const Near_point q = near_point(occluders.frame(), sum);
    const bool is_free = sgn(dot(source.plane.exact, p.exact)) > 0 && sgn(dot(plane.exact, q.exact)) > 0 &&
                         !occluders.blocker(p, q, plane, source.plane);
    if (cell.light == (is_free ? Light::umbra : Light::lit)) return true;
  }
  return false;
}

}  // namespace

std::string flaw_of_edges(const Scene& scene, std::uint32_t piece, const generate::Points& source,
                          const Exact_point& eye, const std::vector<std::array<Exact_point, 2>>& edges) {
  using weak_flats::Level;
  const std::vector<generate::Points> all = weak_flats::polygons(scene);
  const Level front = weak_flats::level_of(all[piece]), of_source = weak_flats::level_of(source);
  if (of_source.side(eye) <= 0) return edges.empty() ? "" : "a source is not seen from behind, but has edges";
  // 1. That there are such edges.
  const auto is_on = [](const std::array<Exact_point, 2>& line, const generate::Points& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Exact_point &a = polygon[i], along = minus(polygon[(i + 1) % polygon.size()], a);
      if (is_zero(cross(along, minus(line[0], a))) && is_zero(cross(along, minus(line[1], a)))) return true;
    }
    return false;
  };
  const auto is_in = [](const std::array<Exact_point, 2>& line, const Level& level) {
    return level.side(line[0]) == 0 && level.side(line[1]) == 0;
  };
  for (const auto& line : edges) {
    const bool is_edge = is_on(line, source) || (is_in(line, of_source) && is_in(line, front)) ||
                         std::any_of(all.begin(), all.end(), [&](const generate::Points& polygon) {
                           return is_on(line, polygon) || (is_in(line, weak_flats::level_of(polygon)) &&
                                                           (is_in(line, of_source) || is_in(line, front)));
                         });
    if (!is_edge) return "a line that bounds what is seen is no edge";
  }
  // 2. That they are those that bound it.
  std::vector<weak_flats::Flat_line> images;
  for (const auto& line : edges) images.push_back(weak_flats::image_of(source, eye, line));
  std::sort(images.begin(), images.end());
  const std::vector<weak_flats::Flat_line> outline = weak_flats::seen_outline(all, source, front, eye);
  if (images == outline) return "";
  return std::to_string(edges.size()) + " edges bound what is seen, " + std::to_string(outline.size()) +
         " by brute force" + (images.size() == outline.size() ? ", others" : "");
}

Light light_at(const Scene& scene, std::uint32_t piece, const generate::Points& source, const Exact_point& eye) {
  using weak_flats::Level;
  const std::vector<generate::Points> all = weak_flats::polygons(scene);
  const Level front = weak_flats::level_of(all[piece]), of_source = weak_flats::level_of(source);
  if (of_source.side(eye) <= 0) return Light::umbra;
  const std::vector<weak_flats::Flat_line> seen = weak_flats::seen_outline(all, source, front, eye);
  if (seen.empty()) return Light::umbra;
  std::vector<weak_flats::Flat_line> whole;
  for (std::size_t i = 0; i < source.size(); ++i)
    whole.push_back(weak_flats::image_of(source, eye, {source[i], source[(i + 1) % source.size()]}));
  std::sort(whole.begin(), whole.end());
  whole.erase(std::unique(whole.begin(), whole.end()), whole.end());
  return seen == whole ? Light::lit : Light::penumbra;
}

namespace {

/// Whether it is seen that no curve passes between two points: none has a root on the segment, by what bounds it there.
bool are_together(const Light_partition& partition, const Place& p, const Place& q) {
  return std::all_of(partition.curves.begin(), partition.curves.end(), [&](const Plane_curve& curve) {
    const auto value = [&](const Rational& x, const Rational& y) -> Rational {
      const std::array<Integer, 6>& c = curve.c;
      return c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y;
    };
    const Rational first = value(p[0], p[1]), last = value(q[0], q[1]),
                   middle = 2 * value((p[0] + q[0]) / 2, (p[1] + q[1]) / 2) - (first + last) / 2;
    return sgn(first) != 0 && sgn(first) == sgn(middle) && sgn(first) == sgn(last);
  });
}

/// Whether doubles do not tell on which side of a border's end a place is.
bool is_beside_an_end(const Light_partition& partition, const Rational& x) {
  return std::any_of(partition.borders.begin(), partition.borders.end(), [&](const Light_partition::Border& border) {
    return std::any_of(border.x.begin(), border.x.end(),
                       [&](const Bounded& end) { return exact(end.low) <= x && x <= exact(end.high); });
  });
}

/// That a point of a cell is found there, and any other point in a cell that has its light, or on a border; that what
/// is inside of the piece, on no curve and beside no end of a border is found; and points between which there is no
/// curve in one cell.
std::string flaw_of_places(const Scene& scene, const Occluders& occluders, const Weak_source& source,
                           std::uint32_t piece, const Light_partition& partition) {
  constexpr std::size_t most_cells = 10;
  // Doubles do not tell where a sliver is.
  const auto is_sliver = [&](std::size_t cell) { return partition.cells[cell].area.low < 1e-6; };
  bool has_slivers = false;
  for (std::size_t c = 0; c < partition.cells.size(); ++c) has_slivers |= is_sliver(c);
  const generate::Points corners = weak_flats::polygons(scene)[piece];
  const weak_flats::Level plane = weak_flats::level_of(corners);
  for (std::size_t c = 0; c < std::min(most_cells, partition.cells.size()); ++c) {
    const Place& at = partition.cells[c].at;
    const std::size_t found = partition.cell_at(at[0], at[1]);
    if (found != c && found != Light_partition::none && !is_sliver(c))
      return "a point of a cell is found in another one";
    if (found == Light_partition::none && !is_sliver(c) && !is_beside_an_end(partition, at[0]))
      return "a point of a cell is found in none";
    if (partition.point(at[0], at[1]) != point_of(partition, at)) return "a point of the chart is elsewhere in space";
  }
  for (const auto& [x, y] : {std::array{0, 1}, {2, 1}, {1, 0}, {1, 2}})  // halves of the chart's sides
    if (partition.cell_at(Rational(x) / 2, Rational(y) / 2) != Light_partition::none)
      return "a point on the chart's border is found in a cell";
  generate::Random places(partition.cells.size());
  for (std::size_t k = 0; k < std::min(most_cells, partition.borders.size()); ++k)
    for (const Bounded& end : partition.borders[places.below(partition.borders.size())].x)
      if (end.low == end.high && partition.cell_at(exact(end.low), Rational(static_cast<long>(1 + places.below(999)),
                                                                            1000l)) != Light_partition::none)
        return "a point straight above or below an end of a border is found in a cell";
  for (int k = 0; k < 3; ++k) {
    const auto number = [&](std::int64_t low, std::int64_t high) {
      return Rational(static_cast<long>(places.between(low, high)), 1000l);
    };
    const Rational x = number(-20, 1020), y = number(-20, 1020);
    const std::size_t found = partition.cell_at(x, y);
    if (found == Light_partition::none) {
      const bool is_on_a_curve = std::any_of(partition.curves.begin(), partition.curves.end(),
                                             [&](const Plane_curve& curve) { return curve.sign(x, y) == 0; });
      if (weak_flats::location(corners, plane, point_of(partition, {x, y})) > 0 && !is_on_a_curve && !has_slivers &&
          !is_beside_an_end(partition, x))
        return "a point of the piece is found in no cell";
      continue;
    }
    const Place other{x + number(-90, 90), y + number(-90, 90)};
    if (const std::size_t next = partition.cell_at(other[0], other[1]);
        next != found && next != Light_partition::none && !is_sliver(found) && !is_sliver(next) &&
        are_together(partition, {x, y}, other))
      return "two points are in different cells, and no curve is between them";
    Light_partition::Cell there = partition.cells[found];
    there.at = {x, y};
    if (is_contradicted(occluders, source, piece, partition, there, places))
      return "a point is found in a cell that is " + std::string(name_of(there.light)) + ", and a segment denies it";
  }
  return "";
}

/// That a piece is within its chart, and fills enough of it for doubles.
std::string flaw_of_chart(const Scene& scene, const Light_partition& partition) {
  const auto& [origin, u, v] = partition.chart;
  const Exact_point all = cross(u, v);
  const auto axis = static_cast<std::size_t>(
      std::find_if(all.begin(), all.end(), [](const Rational& x) { return sgn(x) != 0; }) - all.begin());
  const generate::Points corners = scene.corner_points(scene.pieces()[partition.piece]);
  Rational twice = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Exact_point p = minus(corners[k], origin), next = minus(corners[(k + 1) % corners.size()], origin);
    const Place at{Rational(cross(p, v)[axis] / all[axis]), Rational(cross(u, p)[axis] / all[axis])};
    if (at[0] < 0 || at[0] > 1 || at[1] < 0 || at[1] > 1) return "a piece goes beyond its chart";
    twice += cross(p, next)[axis] / all[axis];
  }
  constexpr double least = 0x1p-20;
  return std::fabs(twice.get_d()) / 2 < least ? "a sliver of its chart is left to doubles" : "";
}

/// That shares of a face, and of each of its pieces, add up to all of it.
std::string flaw_of_shares(const Scene& scene, const std::vector<Light_partition>& pieces) {
  const auto is_whole = [](const std::array<Bounded, lights>& shares) {
    double low = 0, high = 0;
    for (const Bounded& share : shares) {
      if (!(0 <= share.low && share.low <= share.high && share.high <= 1)) return false;
      low += share.low;
      high += share.high;
    }
    constexpr double rounding = 1e-12, width = 1e-3;
    return low <= 1 + rounding && high >= 1 - rounding && high - low < width;
  };
  for (const Light_partition& partition : pieces)
    if (!is_whole(partition.shares())) return "the shares of a piece are not all of it";
  return is_whole(shares_of_face(scene, pieces)) ? "" : "its shares are not all of it";
}

/// An L about a point of the scene, of several pieces. Returns whether it has an area.
bool add_bent_face(Polygon_soup& soup, Random& random) {
  if (soup.point_count() == 0) return false;
  const Exact_point origin = soup.point(static_cast<Point_id>(random.below(soup.point_count()))),
                    u = generate::lattice(random, 2), v = generate::lattice(random, 2);
  if (is_zero(cross(u, v))) return false;
  soup.add_face(
      generate::added(soup, generate::in_plane(origin, u, v, {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})));
  return true;
}

/// A triangle with a corner in the source's plane, and the others on both sides of it: where it goes through that, its
/// trace has that end. Returns whether it has an area.
bool add_face_through(const generate::Points& source, Polygon_soup& soup, Random& random) {
  if (soup.point_count() == 0) return false;
  const weak_flats::Level level = weak_flats::level_of(source);
  const Exact_point p = soup.point(static_cast<Point_id>(random.below(soup.point_count())));
  if (level.side(p) == 0) return false;
  const Exact_point u = minus(source[1], source[0]), v = minus(source[2], source[0]);
  const auto any = [&] {
    const Exact_point from = generate::along(source[0], Rational(generate::integer(random, -2, 4) / 2), u);
    return generate::along(from, Rational(generate::integer(random, -2, 4) / 2), v);
  };
  const auto beside = [&](int sign) {
    const Exact_point from = any();
    return generate::along(from, Rational(sign * generate::integer(random, 1, 4) / 2), minus(p, from));
  };
  const Exact_point a = any(), b = beside(1), c = beside(-1);
  if (is_zero(cross(minus(b, a), minus(c, a)))) return false;
  soup.add_face(generate::added(soup, generate::either_way({a, b, c}, random)));
  return true;
}

/// A triangle beside a line through two of the scene's points, 2^-8 to 2^-60 of it wide. Returns whether it has an
/// area.
bool add_sliver(Polygon_soup& soup, Random& random) {
  if (soup.point_count() == 0) return false;
  const auto any = [&] { return soup.point(static_cast<Point_id>(random.below(soup.point_count()))); };
  const Exact_point a = any(), b = any(), beside = generate::lattice(random, 2);
  if (is_zero(cross(minus(b, a), beside))) return false;
  const Exact_point on = generate::along(a, Rational(generate::integer(random, -1, 5) / 4), minus(b, a)),
                    c = generate::along(on, generate::power_of_two(-static_cast<int>(random.between(8, 60))), beside);
  soup.add_face(generate::added(soup, generate::either_way({a, b, c}, random)));
  return true;
}

/// A source turned round, or a piece of a scene as one, either way round.
generate::Points other_source(const generate::Points& source, const Scene& scene, std::uint32_t but, Random& random) {
  const auto piece = static_cast<std::size_t>(random.below(scene.pieces().size()));
  const bool is_piece = piece != but && random.chance(2, 3);
  return generate::either_way(is_piece ? weak_flats::polygons(scene)[piece] : source, random);
}

}  // namespace

Check partition_check() {
  return {"partition",
          "a face is hidden iff all of it is in umbra, and segments from its cells to the source are free or not as "
          "their light says",
          [](const Posed_scene& posed, const Answer& answer, Random& random) {
            constexpr std::size_t most_pieces = 10;
            Polygon_soup soup = posed.soup;
            const bool is_added = random.chance(1, 8)   ? add_sliver(soup, random)
                                  : random.chance(1, 4) ? add_bent_face(soup, random)
                                                        : false,
                       is_through = random.chance(1, 4) && add_face_through(posed.source, soup, random);
            const Scene scene(soup);
            constexpr int most_bits = 100;  // an arrangement's roots have some fifty times as many
            if (scene.pieces().empty() || scene.pieces().size() > most_pieces || scene.bits() > most_bits)
              return Outcome::not_applicable();
            const auto given = static_cast<Face_id>(posed.soup.face_count());
            const Face_id face = is_added ? given : scene.pieces()[random.below(scene.pieces().size())].face;
            if (!is_added && (face >= given || answer.labels[face] == Answer::none)) return Outcome::not_applicable();
            const Occluders occluders(scene);
            const Weak_source source = weak_source(occluders, posed.source);
            const Light_partitioner partitioner(scene);
            std::size_t asked = 0;
            Partition_options options;
            constexpr std::size_t most_rectangles = 2000;
            options.out_of_time = [&] { return ++asked > most_rectangles; };
            double told = 0;
            bool is_told_wrongly = false;
            options.progress = [&](double share) {
              is_told_wrongly |= share < told || share > 1 + 1e-9;
              told = share;
            };
            bool some_light = false, open = false;
            std::vector<Light_partition> pieces;
            for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
              if (scene.pieces()[piece].face != face) continue;
              Partition_counters counters;
              told = 0;
              const Light_partition partition = partitioner.partition(piece, {posed.source}, options, counters);
              if (counters.boxes > 0 && told < 1 - 1e-9) is_told_wrongly = true;
              if (is_told_wrongly)
                return Outcome::failed("a partition's progress goes back, beyond all of it, or not to its end");
              constexpr std::size_t most_cells = 30;
              for (const auto& cell : partition.cells) {
                if (random.chance(most_cells, std::max(most_cells, partition.cells.size())) &&
                    is_contradicted(occluders, source, piece, partition, cell, random))
                  return Outcome::failed("a cell of " + face_name(face) + " is " + name_of(cell.light) +
                                         ", but a segment from there to the source says otherwise");
                some_light |= cell.light == Light::lit || cell.light == Light::penumbra;
                open |= cell.light == Light::undecided;
              }
              const std::string flaw = open ? "" : flaw_of_places(scene, occluders, source, piece, partition);
              if (!flaw.empty()) return Outcome::failed(face_name(face) + ": " + flaw);
              if (const std::string of_chart = flaw_of_chart(scene, partition); !of_chart.empty())
                return Outcome::failed(face_name(face) + ": " + of_chart);
              pieces.push_back(partition);
            }
            if (pieces.empty()) return Outcome::not_applicable();  // it was set aside
            const std::string flaw = flaw_of_shares(scene, pieces);
            if (!flaw.empty()) return Outcome::failed(face_name(face) + ": " + flaw);
            if (is_added || is_through) return Outcome{};  // of which no answer is known
            if (some_light ? answer.labels[face] == 1 : !open && answer.labels[face] == 0) return Outcome{};
            if (!some_light && open) return Outcome::undecided();
            return Outcome::failed(face_name(face) + (some_light ? " has light in its partition, but is hidden"
                                                                 : " is all in umbra, but visible"));
          }};
}

Check outline_check() {
  return {"outline", "what cells of a face see of the source, and the edges that bound it, against all shadows",
          [](const Posed_scene& posed, const Answer& answer, Random& random) {
            constexpr std::size_t most_pieces = 8;
            constexpr int most_bits = 64;
            Polygon_soup soup = posed.soup;
            if (random.chance(1, 4)) add_face_through(posed.source, soup, random);
            const Scene scene(soup);
            if (scene.pieces().empty() || scene.pieces().size() > most_pieces || scene.bits() > most_bits)
              return Outcome::not_applicable();
            const auto piece = static_cast<std::uint32_t>(random.below(scene.pieces().size()));
            if (const Face_id face = scene.pieces()[piece].face;
                face >= posed.soup.face_count() || answer.labels[face] == Answer::none)
              return Outcome::not_applicable();
            std::size_t asked = 0;
            Partition_options options;
            options.all_borders = random.chance(1, 2);
            constexpr std::size_t most_rectangles = 1000;
            options.out_of_time = [&] { return ++asked > most_rectangles; };
            Partition_counters counters;
            std::vector<generate::Points> sources{posed.source};
            if (random.chance(1, 3)) sources.push_back(other_source(posed.source, scene, piece, random));
            const Light_partition partition = Light_partitioner(scene).partition(piece, sources, options, counters);
            constexpr std::size_t most_cells = 6;
            for (const auto& cell : partition.cells) {
              if (cell.light == Light::undecided ||
                  !random.chance(most_cells, std::max(most_cells, partition.cells.size())))
                continue;
              const Exact_point at = point_of(partition, cell.at);
              std::size_t lit = 0, dark = 0;
              for (const generate::Points& source : sources) {
                const Light light = light_at(scene, piece, source, at);
                lit += light == Light::lit;
                dark += light == Light::umbra;
              }
              const Light light = lit == sources.size()    ? Light::lit
                                  : dark == sources.size() ? Light::umbra
                                                           : Light::penumbra;
              if (light != cell.light)
                return Outcome::failed("a cell of piece " + std::to_string(piece) + " is " + name_of(cell.light) +
                                       ", and by all shadows " + name_of(light));
              for (std::size_t s = 0; options.all_borders && s < sources.size(); ++s) {
                const std::string flaw = flaw_of_edges(scene, piece, sources[s], at, cell.edges.at(s));
                if (!flaw.empty())
                  return Outcome::failed("from a cell of piece " + std::to_string(piece) + ": " + flaw);
              }
            }
            return partition.cells.empty() ? Outcome::not_applicable() : Outcome{};
          }};
}

}  // namespace sightline::harness
