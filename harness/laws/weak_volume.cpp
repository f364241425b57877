#include <sightline/harness/laws/weak_volume.h>

#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/volume.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/weak_flats.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {
namespace weak_volume {
namespace {

using generate::Faces;
using generate::Points;
using weak_flats::Level;

/// A convex polyhedron that counts once: inside, or, with its fronts inwards, outside.
struct Body {
  Faces faces;
  std::vector<Level> walls;  // outwards
  Points corners;
  int winding = 1;
};

/// Whether points right beside p are strictly inside a body. Nothing where these are in one of its walls.
std::optional<bool> holds_beside(const Body& body, const Exact_point& p, const Exact_point& direction) {
  for (const Level& wall : body.walls) {
    const int at = wall.side(p), slope = sgn(dot(wall.normal, direction));
    if (at > 0 || (at == 0 && slope > 0)) return false;
    if (at == 0 && slope == 0) return std::nullopt;
  }
  return true;
}

struct Solid {
  std::vector<Body> bodies;
  std::vector<Level> walls;  // of all of them

  /// Whether points right beside p, or p itself, are inside: by its winding number. Nothing where they are in a wall.
  std::optional<bool> is_inside_beside(const Exact_point& p, const Exact_point& direction = {0, 0, 0}) const {
    int winding = 0;
    for (const Body& body : bodies) {
      const std::optional<bool> holds = holds_beside(body, p, direction);
      if (!holds) return std::nullopt;
      if (*holds) winding += body.winding;
    }
    return winding != 0;
  }

  Faces faces() const {
    Faces all;
    for (const Body& body : bodies)
      for (const Points& face : body.faces) all.push_back(body.winding > 0 ? face : generate::reversed(face));
    return all;
  }
};

/// A box or a tetrahedron on coordinates of points, which gives coincidences; nothing where it would be flat.
std::optional<Body> body_of(const Points& points, Random& random) {
  const auto any = [&]() -> const Exact_point& { return points[random.below(points.size())]; };
  Body body;
  if (random.chance(2, 3)) {
    Exact_point low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational a = any()[k], b = any()[k];
      low[k] = std::min(a, b);
      high[k] = std::max(a, b);
      if (low[k] == high[k]) return std::nullopt;
    }
    body.faces = generate::box(low, high);
  } else {
    Points c;
    for (std::size_t k = 0; k < 4; ++k) c.push_back(any());
    const int sense = sgn(dot(cross(minus(c[1], c[0]), minus(c[2], c[0])), minus(c[3], c[0])));
    if (sense == 0) return std::nullopt;
    if (sense < 0) std::swap(c[1], c[2]);
    body.faces = {{c[0], c[2], c[1]}, {c[0], c[1], c[3]}, {c[1], c[2], c[3]}, {c[2], c[0], c[3]}};
  }
  for (const Points& face : body.faces) {
    body.walls.push_back(weak_flats::level_of(face));
    body.corners.insert(body.corners.end(), face.begin(), face.end());
  }
  if (random.chance(1, 4)) body.winding = -1;
  return body;
}

/// That a volume's surface is where the inside is on one side only, and looks to the other.
Outcome has_its_surface(const Solid& solid, const Weak_volume& volume) {
  std::vector<Level> levels;
  for (const Points& polygon : volume.surface()) {
    const Level& level = levels.emplace_back(weak_flats::level_of(polygon));
    // In cells: the middle of all of it may be on an edge of a body that only touches it there.
    for (const Points& cell : weak_flats::cells(polygon, solid.walls)) {
      const Exact_point middle = generate::centroid(cell);
      const std::optional<bool> before = solid.is_inside_beside(middle, level.normal),
                                behind = solid.is_inside_beside(middle, minus({0, 0, 0}, level.normal));
      if (before.value_or(false) || !behind.value_or(true))
        return Outcome::failed("a part of the volume's surface does not look outwards");
    }
  }
  for (const Points& face : solid.faces()) {
    const Level level = weak_flats::level_of(face);
    for (const Points& cell : weak_flats::cells(face, solid.walls)) {
      const Exact_point p = generate::centroid(cell);
      const std::optional<bool> before = solid.is_inside_beside(p, level.normal),
                                behind = solid.is_inside_beside(p, minus({0, 0, 0}, level.normal));
      if (!before || !behind) continue;
      const int looks = int{*behind} - int{*before};
      std::array<bool, 2> found{};  // looking as the face does, and to its back
      for (std::size_t k = 0; k < levels.size(); ++k)
        if (levels[k].side(p) == 0 && weak_flats::position(levels[k], face) == 0 &&
            weak_flats::location(volume.surface()[k], levels[k], p) > 0)
          found[dot(levels[k].normal, level.normal) > 0 ? 0 : 1] = true;
      if (found[0] != (looks > 0) || found[1] != (looks < 0))
        return Outcome::failed("the volume's surface " + std::string(looks == 0 ? "has" : "lacks") +
                               " a point of its faces, or looks inwards there");
    }
  }
  return {};
}

/// That what a volume sees from within has inside right in front.
Outcome sees_what_is_within(const Solid& solid, const Weak_volume& volume, const Points& polygon, bool behind) {
  const Level level = weak_flats::level_of(polygon);
  const Level side = behind ? level.turned() : level;
  const std::vector<Points> parts = weak_flats::cells(polygon, solid.walls);
  const bool within = std::any_of(parts.begin(), parts.end(), [&](const Points& part) {
    return solid.is_inside_beside(generate::centroid(part), side.normal).value_or(false);
  });
  if (volume.sees_from_within(polygon, behind) == within) return {};
  return Outcome::failed(within ? "the volume is right in front of a piece, but does not see it from within"
                                : "the volume sees a piece from within that it is nowhere right in front of");
}

/// That a face is seen which a point inside sees, if some try finds one.
Outcome shows_what_a_point_sees(const Solid& solid, const Weak_volume& volume, const Scene& scene,
                                const std::vector<Points>& pieces, Random& random) {
  constexpr std::size_t tries = 6, most_sources = 24;
  if (volume.surface().size() > most_sources) return Outcome::not_applicable();
  for (std::size_t k = 0; k < tries; ++k) {
    const Body& body = solid.bodies[random.below(solid.bodies.size())];
    const std::size_t target = random.below(pieces.size());
    const Exact_point p = weak_flats::inner_point(body.corners, random),
                      q = weak_flats::inner_point(pieces[target], random);
    const Level level = weak_flats::level_of(pieces[target]);
    if (!solid.is_inside_beside(p).value_or(false) || level.side(p) <= 0) continue;
    if (std::any_of(pieces.begin(), pieces.end(), [&](const Points& other) {
          return weak_flats::position(level, other) != 0 && weak_flats::may_meet(other, p, q);
        }))
      continue;
    const Occluders occluders(scene);
    std::vector<Weak_source> sources;
    for (const Points& polygon : volume.surface()) sources.push_back(weak_source(occluders, polygon));
    const Face_id face = scene.pieces()[target].face;
    Weak_options options;
    options.threads = 1;
    options.search.cells = 300;
    options.faces = {face};
    Weakly_visible found = weakly_visible(occluders, sources, options);
    const bool two_sided = random.chance(1, 3);
    const std::size_t most_asks = random.chance(1, 2) ? random.below(4) : ~std::size_t{0};
    std::size_t asks = 0;
    const std::vector<Face_id> within =
        add_seen_from_within(scene, volume, two_sided, found, [&] { return ++asks > most_asks; });
    for (const Face_id f : within) {
      bool is_within = false;
      for (std::size_t piece = 0; piece < pieces.size(); ++piece)
        is_within |= scene.pieces()[piece].face == f && (volume.sees_from_within(pieces[piece], false) ||
                                                         (two_sided && volume.sees_from_within(pieces[piece], true)));
      if (!is_within) return Outcome::failed(face_name(f) + " is said to be seen from within, and is not");
    }
    if (std::binary_search(found.hidden.begin(), found.hidden.end(), face))
      return Outcome::failed(face_name(face) + " is hidden from a volume, but a point inside of it sees it");
    return {};
  }
  return {};
}

Outcome from_a_volume(const Posed_scene& posed, const Answer&, Random& random) {
  constexpr std::size_t pieces_tried = 4;
  if (!random.chance(1, 12)) return Outcome::not_applicable();
  const Scene scene(posed.soup);
  const std::vector<Points> pieces = weak_flats::polygons(scene);
  // 1. Bodies among the scene's points, or on those of another body.
  Points points = posed.source;
  for (const Points& piece : pieces) points.insert(points.end(), piece.begin(), piece.end());
  Solid solid;
  for (std::uint64_t k = 1 + random.below(3); k > 0; --k) {
    std::optional<Body> body = body_of(points, random);
    if (!body) continue;
    if (random.chance(1, 2)) points.insert(points.end(), body->corners.begin(), body->corners.end());
    solid.walls.insert(solid.walls.end(), body->walls.begin(), body->walls.end());
    solid.bodies.push_back(std::move(*body));
  }
  if (solid.bodies.empty()) return Outcome::not_applicable();

  // 2. Faces that do not close up are refused.
  Faces faces = solid.faces();
  if (random.chance(1, 2)) {
    Faces open;
    const char* what = "faces that do not close up are taken for a volume";
    switch (random.below(3)) {
      case 0:
        open = faces;
        open.erase(open.begin() + static_cast<std::ptrdiff_t>(random.below(open.size())));
        break;
      case 1: what = "no faces are taken for a volume"; break;
      default: {
        what = "a solid without its inside is taken for a volume";
        Solid turned = solid;
        for (Body& body : turned.bodies) body.winding = -body.winding;
        open = faces;
        const Faces back = turned.faces();
        open.insert(open.end(), back.begin(), back.end());
      }
    }
    try {
      const Weak_volume volume(generate::soup_of(open));
      return Outcome::failed(what);
    } catch (const std::invalid_argument&) {
    }
  }

  // 3. The surface, what is seen from within, and what a point inside sees.
  random.shuffle(faces);
  std::optional<Weak_volume> volume;
  try {
    volume.emplace(generate::soup_of(faces));
  } catch (const std::invalid_argument& error) {
    for (const Points& face : faces)
      for (const Points& cell : weak_flats::cells(face, solid.walls))
        for (const Level& level : {weak_flats::level_of(face), weak_flats::level_of(face).turned()})
          if (solid.is_inside_beside(generate::centroid(cell), level.normal).value_or(false))
            return Outcome::failed(std::string("a closed volume is refused: ") + error.what());
    return Outcome::not_applicable();
  }
  if (Outcome outcome = has_its_surface(solid, *volume); outcome.state == Outcome::State::failed) return outcome;
  if (pieces.empty()) return {};
  for (std::size_t k = 0; k < pieces_tried; ++k) {
    const Points& piece = pieces[random.below(pieces.size())];
    Outcome outcome = sees_what_is_within(solid, *volume, piece, random.chance(1, 2));
    if (outcome.state == Outcome::State::failed) return outcome;
  }
  return shows_what_a_point_sees(solid, *volume, scene, pieces, random);
}

}  // namespace
}  // namespace weak_volume

Check volume_check() {
  return {"volume", "a solid's surface, and what it sees, by brute force", weak_volume::from_a_volume};
}

}  // namespace sightline::harness
