#include <sightline/harness/laws/weak_surfaces.h>

#include <sightline/algorithms/weak_visibility/events/events.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/labels.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sightline::harness {

namespace surfaces {

/// Of the source, the last of all polygons, or of a piece.
struct Edge {
  std::size_t polygon;
  Exact_point a, b;
};

/// A line that touches edges or, where a corner comes before, that and an edge.
struct Touching {
  std::optional<Exact_point> corner;
  std::vector<Edge> edges;
  std::vector<std::size_t> polygons;  ///< whose boundary it may meet
  Exact_point at, direction;
};

bool meets(const Edge& edge, const Exact_point& p, const Exact_point& direction) {
  return sgn(dot(cross(direction, minus(edge.b, edge.a)), minus(edge.a, p))) == 0;
}

/// Whether a ruling is on what the line touches.
bool is_on(const Touching& line, const std::array<Exact_point, 2>& ruling) {
  const Exact_point direction = minus(ruling[1], ruling[0]);
  return (!line.corner || is_zero(cross(direction, minus(*line.corner, ruling[0])))) &&
         std::all_of(line.edges.begin(), line.edges.end(),
                     [&](const Edge& edge) { return meets(edge, ruling[0], direction); });
}

/// The line through a point and two edges, where it meets both strictly between their ends.
std::optional<Exact_point> through(const Exact_point& at, const Edge& first, const Edge& second) {
  std::array<Exact_point, 2> normals;
  std::size_t k = 0;
  for (const Edge* edge : {&first, &second}) normals[k++] = cross(minus(edge->a, at), minus(edge->b, at));
  const Exact_point direction = cross(normals[0], normals[1]);
  if (is_zero(direction)) return std::nullopt;
  k = 0;
  for (const Edge* edge : {&first, &second}) {
    const Exact_point across = cross(normals[k++], direction);
    if (sgn(dot(across, minus(edge->a, at))) * sgn(dot(across, minus(edge->b, at))) >= 0) return std::nullopt;
  }
  return direction;
}

/// A point strictly between an edge's ends.
Exact_point inner_point(const Edge& edge, Random& random) {
  return generate::along(edge.a, generate::ratio(static_cast<long>(1 + random.below(63)), 64), minus(edge.b, edge.a));
}

std::optional<Touching> any_line(const std::vector<Edge>& edges, Random& random) {
  const auto any_edge = [&]() -> const Edge& { return edges[random.below(edges.size())]; };
  const Edge &first = any_edge(), &second = any_edge(), &third = any_edge();
  Touching line;
  const bool has_corner = random.chance(1, 3);
  line.at = has_corner ? first.a : inner_point(first, random);
  if (has_corner) {
    line.direction = minus(inner_point(second, random), line.at);
    if (is_zero(cross(line.direction, minus(second.b, second.a)))) return std::nullopt;
    line.corner = line.at;
    line.edges = {second};
    line.polygons = {first.polygon, second.polygon};
    return line;
  }
  const auto are_skew = [](const Edge& a, const Edge& b) { return !meets(a, b.a, minus(b.b, b.a)); };
  if (!are_skew(first, second) || !are_skew(first, third) || !are_skew(second, third)) return std::nullopt;
  const std::optional<Exact_point> direction = through(line.at, second, third);
  if (!direction) return std::nullopt;
  line.direction = *direction;
  line.edges = {first, second, third};
  line.polygons = {first.polygon, second.polygon, third.polygon};
  return line;
}

/// Where a line meets a polygon's plane, as a multiple of its direction.
std::optional<Rational> met(const Flat_face& face, const Touching& line) {
  const Rational slope = dot(face.normal, line.direction);
  if (slope == 0) return std::nullopt;
  return Rational(-face.height(line.at) / slope);
}

/// Whether the line goes from the source to a piece, each in front of the other, and is blocked by nothing, and touches
/// on its way all that it is to touch, and nothing else.
bool is_free(const std::vector<Flat_face>& polygons, std::size_t piece, const Touching& line) {
  const std::size_t source = polygons.size() - 1;
  const auto may_touch = [&](std::size_t k) {
    return std::find(line.polygons.begin(), line.polygons.end(), k) != line.polygons.end();
  };
  // 1. Its ends.
  std::array<Rational, 2> ends;
  for (const std::size_t k : {source, piece}) {
    const std::optional<Rational> t = met(polygons[k], line);
    if (!t) return false;
    const int within = polygons[k].side_within(generate::along(line.at, *t, line.direction));
    if (within < 0 || (within == 0 && !may_touch(k))) return false;
    ends[k == source ? 0 : 1] = *t;
  }
  const Exact_point from = generate::along(line.at, ends[0], line.direction),
                    to = generate::along(line.at, ends[1], line.direction);
  if (polygons[source].height(to) <= 0 || polygons[piece].height(from) <= 0) return false;
  // 2. What is between.
  const auto is_between = [&](const Rational& t, bool ends_too) {
    const Rational &low = std::min(ends[0], ends[1]), &high = std::max(ends[0], ends[1]);
    return (low < t && t < high) || (ends_too && (low == t || t == high));
  };
  for (std::size_t k = 0; k < source; ++k) {
    if (k == piece) continue;
    const std::optional<Rational> t = met(polygons[k], line);
    if (!t && polygons[k].height(line.at) == 0) return false;
    if (!t || !is_between(*t, true)) continue;
    const int within = polygons[k].side_within(generate::along(line.at, *t, line.direction));
    if (within > 0 || (within == 0 && (!may_touch(k) || !is_between(*t, false)))) return false;
  }
  // 3. What it touches.
  if (line.corner && (!is_between(0, true) || ends[0] == 0)) return false;
  return std::all_of(line.edges.begin(), line.edges.end(), [&](const Edge& edge) {
    // Where the line goes through the plane of the edge that it is across, it is on the edge.
    const Exact_point across = cross(minus(edge.b, edge.a), cross(line.direction, minus(edge.b, edge.a)));
    const Rational slope = dot(across, line.direction);
    return slope != 0 && is_between(Rational(dot(across, minus(edge.a, line.at)) / slope), true);
  });
}

/// What is wrong with a ruling; empty: nothing.
std::string flaw_of(const std::vector<Flat_face>& polygons, std::size_t piece,
                    const std::array<Exact_point, 2>& ruling) {
  const std::size_t source = polygons.size() - 1;
  if (!polygons[source].holds(ruling[0])) return "does not begin in the source";
  if (!polygons[piece].holds(ruling[1])) return "does not end in its piece";
  if (polygons[source].height(ruling[1]) < 0 || polygons[piece].height(ruling[0]) < 0) return "comes from behind";
  const Exact_point way = minus(ruling[1], ruling[0]);
  for (std::size_t k = 0; k < source; ++k) {
    if (k == piece) continue;
    const Rational from = polygons[k].height(ruling[0]), to = polygons[k].height(ruling[1]);
    if (sgn(from) * sgn(to) < 0 &&
        polygons[k].side_within(generate::along(ruling[0], Rational(from / (from - to)), way)) > 0)
      return "goes through piece " + std::to_string(k);
  }
  return "";
}

Outcome run(const Posed_scene& posed, const Answer&, Random& random) {
  constexpr std::size_t most_pieces = 6, most_events = 20000, tries = 600;
  if (!random.chance(1, 3)) return Outcome::not_applicable();
  const Scene scene(posed.soup);
  if (scene.pieces().empty() || scene.pieces().size() > most_pieces) return Outcome::not_applicable();
  const Occluders occluders(scene);
  Events_options options;
  options.threads = 1;
  options.surfaces = true;
  options.events = most_events;
  const Weakly_visible_by_events found =
      weakly_visible_by_events(occluders, {weak_source(occluders, posed.source)}, options);
  if (!found.undecided.empty()) return Outcome::not_applicable();

  // 1. What surfaces hold is right.
  std::vector<Flat_face> polygons = flat_faces_of(scene);
  polygons.emplace_back(posed.source);
  for (const Event_surface& surface : found.surfaces)
    for (const auto& ruling : surface.rulings)
      if (const std::string flaw = flaw_of(polygons, surface.piece, ruling); !flaw.empty())
        return Outcome::failed("a ruling of a surface to piece " + std::to_string(surface.piece) + " " + flaw);

  // 2. Each line is on one.
  std::vector<Edge> edges;
  for (std::size_t k = 0; k < polygons.size(); ++k)
    for (std::size_t i = 0; i < polygons[k].corners.size(); ++i)
      edges.push_back({k, polygons[k].corners[i], polygons[k].corners[(i + 1) % polygons[k].corners.size()]});
  std::size_t asked = 0;
  for (std::size_t k = 0; k < tries; ++k) {
    const std::optional<Touching> line = any_line(edges, random);
    if (!line) continue;
    for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
      if (!is_free(polygons, piece, *line)) continue;
      ++asked;
      if (std::none_of(found.surfaces.begin(), found.surfaces.end(), [&](const Event_surface& surface) {
            return surface.piece == piece && std::all_of(surface.rulings.begin(), surface.rulings.end(),
                                                         [&](const auto& ruling) { return is_on(*line, ruling); });
          }))
        return Outcome::failed("a free line to piece " + std::to_string(piece) + " touches " +
                               (line->corner ? "a corner and an edge" : "three edges") + ", and no surface holds it");
    }
  }
  return asked == 0 ? Outcome::not_applicable() : Outcome{};
}

}  // namespace surfaces

Check surfaces_check() {
  return {"surfaces", "surfaces of events hold the free lines that touch edges, and no others", surfaces::run};
}

}  // namespace sightline::harness
