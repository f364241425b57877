#include <sightline/harness/laws/shadow.h>

#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/rays/ray.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/harness/laws/manners.h>
#include <sightline/harness/laws/questions.h>
#include <sightline/harness/laws/trace.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace sightline::harness {

namespace shadow_subject {

/// An axis along which a piece has area.
std::size_t axis_of(const std::vector<Exact_point>& corners) {
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (area_of(corners, axis) != 0) return axis;
  return 2;
}

bool is_convex(const std::vector<Exact_point>& corners, std::size_t axis, int sense) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::vector<Exact_point> turn{corners[k], corners[(k + 1) % corners.size()],
                                        corners[(k + 2) % corners.size()]};
    if (sgn(area_of(turn, axis)) * sense < 0) return false;
  }
  return true;
}

/// The side of a polygon on which the light is: the front's is positive.
Sign side_of(const std::vector<Exact_point>& corners, const Exact_point& light, bool is_sun) {
  Rational sum = 0;  // along twice the polygon's area as a vector
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += dot(cross(minus(corners[k], corners[0]), minus(corners[k + 1], corners[0])),
               is_sun ? light : minus(light, corners[0]));
  return static_cast<Sign>(sgn(sum));
}

/// The faces that keep the light from a point, and are nearest to it; those edge-on do not count.
std::vector<Face_id> blockers(const Polygon_soup& soup, const Scene& scene, const Exact_point& p,
                              const Exact_point& light, bool is_sun) {
  // From the point to the light.
  const Exact_ray ray{p, is_sun ? light : minus(light, p)};
  std::vector<Face_hit> hits = hits_by_definition(soup, scene, ray, Ray_start::open);
  std::erase_if(hits, [&](const Face_hit& hit) { return hit.side == Met_side::along || (!is_sun && hit.t >= 1); });
  std::vector<Face_id> faces;
  for (const Face_hit& hit : hits)
    if (hit.t == hits.back().t) faces.push_back(hit.face);
  return faces;
}

Answer labels(const Posed_scene& posed) {
  const Scene scene(posed.soup);
  Answer answer;
  answer.labels.assign(posed.soup.face_count(), Answer::none);
  answer.planar = scene.counters().non_planar + scene.counters().no_simple_projection == 0;
  for (const Piece& piece : scene.pieces()) answer.labels[piece.face] = 0;
  Shadow_options options;
  options.threads = 1;
  options.two_sided = true;
  for (const Shadow_part& part : shadows(Exact_view(scene, posed.eye), Piece_boxes(scene), options).parts)
    if (part.is_lit()) answer.labels[scene.pieces()[part.piece].face] |= part.side == CGAL::POSITIVE ? 1 : 2;
  return answer;
}

/// A direction to a sun: of an edge or a face's diagonal, along an axis, or any.
Exact_point draw_sun(const Polygon_soup& soup, Random& random) {
  Exact_point d{0, 0, 0};
  const auto any = [&] { return soup.point(static_cast<Point_id>(random.below(soup.point_count()))); };
  if (random.chance(1, 3) && soup.point_count() > 1) {
    const Exact_point from = any();
    d = minus(any(), from);
  } else
    for (Rational& x : d) x = static_cast<long>(random.between(-4, 4));
  if (d == Exact_point{0, 0, 0}) d[2] = 1;
  return d;
}

/// How often a closed surface winds round a point, by a ray; nothing where rays meet edges, or the point is on it.
std::optional<int> winding_at(const Polygon_soup& surface, const Scene& scene, const Exact_point& p, Random& random) {
  for (int attempt = 0; attempt < 8; ++attempt) {
    Exact_ray ray{p, {}};
    for (Rational& x : ray.direction) x = Rational(static_cast<long>(random.between(-1000, 1000)), 7);
    if (is_zero(ray.direction)) continue;
    const std::vector<Face_hit> hits = hits_by_definition(surface, scene, ray, Ray_start::closed);
    int winding = 0;
    bool is_clear = true;
    for (std::size_t k = 0; k < hits.size(); ++k) {
      if (hits[k].t == 0) return std::nullopt;
      is_clear = is_clear && hits[k].side != Met_side::along && (k == 0 || hits[k].t != hits[k - 1].t);
      winding += hits[k].side == Met_side::back ? 1 : -1;
    }
    if (is_clear) return winding;
  }
  return std::nullopt;
}

/// The least box of the scene's pieces, larger on all sides by a quarter of its longest side. Pre: there are some.
std::array<Exact_point, 2> box_about(const Scene& scene) {
  std::array<std::vector<Rational>, 3> all;
  for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece)
    for (const Exact_point& p : scene.corner_points(scene.pieces()[piece]))
      for (std::size_t k = 0; k < 3; ++k) all[k].push_back(p[k]);
  std::array<Exact_point, 2> box;
  std::vector<Rational> sides;
  for (std::size_t k = 0; k < 3; ++k) {
    std::sort(all[k].begin(), all[k].end());
    sides.push_back(all[k].back() - all[k].front());
  }
  const Rational margin = *std::max_element(sides.begin(), sides.end()) / 4;
  for (std::size_t k = 0; k < 3; ++k) {
    box[0][k] = all[k].front() - margin;
    box[1][k] = all[k].back() + margin;
  }
  return box;
}

/// What the volume says of random points of its box, against rays to the light.
Check by_volume() {
  return {"volume", "a point of the box about the scene is in the shadow volume iff a face is between it and the light",
          [](const Posed_scene& posed, const Answer& answer, Random& random) {
            constexpr std::size_t most_faces = 12;
            constexpr int most_bits = 100;
            if (!answer.planar || posed.soup.face_count() > most_faces) return Outcome::not_applicable();
            const Scene scene(posed.soup);
            if (scene.points().bits() > most_bits) return Outcome::not_applicable();
            const bool is_sun = random.chance(1, 2);
            const Exact_point light = is_sun ? draw_sun(posed.soup, random) : posed.eye;
            const std::string flaw = flaw_of(is_sun ? shadow_volume(scene, Sun{light}) : shadow_volume(scene, light),
                                             posed.soup, scene, light, is_sun, 6, random);
            return flaw.empty() ? Outcome{} : Outcome::failed(flaw);
          },
          2};
}

Check by_definition() {
  return {
      "definition",
      "parts tile the pieces that are asked, rays to the light meet what shadows them, and faces are lit or away by "
      "them, from points and suns",
      [](const Posed_scene& posed, const Answer& answer, Random& random) {
        if (!answer.planar) return Outcome::not_applicable();
        const Scene scene(posed.soup);
        const Piece_boxes boxes(scene);
        Shadow_options options;
        options.threads = 1;
        options.two_sided = random.chance(1, 2);
        std::string flaw = flaw_of(shadows(Exact_view(scene, posed.eye), boxes, options), posed.soup, scene, posed.eye,
                                   false, options.two_sided);
        for (int k = 0; k < 2 && flaw.empty(); ++k) {
          const Exact_point sun = draw_sun(posed.soup, random);
          flaw = flaw_of(shadows(Exact_view(scene, Sun{sun}), boxes, options), posed.soup, scene, sun, true,
                         options.two_sided);
          if (!flaw.empty())
            flaw = "sun " + sightline::to_string(sun[0]) + "," + sightline::to_string(sun[1]) + "," +
                   sightline::to_string(sun[2]) + ": " + flaw;
        }
        return flaw.empty() ? Outcome{} : Outcome::failed(flaw);
      }};
}

/// What `see` sees from the light is lit.
Check as_seen() {
  return {"see", "lit areas of pieces and lit faces are those that an eye at the light sees",
          [](const Posed_scene& posed, const Answer&, Random&) {
            const Scene scene(posed.soup);
            const Piece_boxes boxes(scene);
            const Exact_view view(scene, posed.eye);
            Shadow_options options;
            options.threads = 1;
            Visible_options seeing;
            seeing.threads = 1;
            const auto surface = visible_surface(view, boxes, seeing);
            const Shadows made = shadows(view, boxes, options);
            if (made.lit != surface.visible) return Outcome::failed("other faces are lit than are seen");
            std::map<std::uint32_t, Rational> seen, lit;
            for (const auto& part : surface.parts)
              if (part.piece != surface.nothing && view.eye_side(part.piece) == CGAL::POSITIVE)
                seen[part.piece] +=
                    area_of(vertices(view, surface, part), axis_of(scene.corner_points(scene.pieces()[part.piece])));
            for (const Shadow_part& part : made.parts)
              if (part.is_lit())
                lit[part.piece] += area_of(part.vertices, axis_of(scene.corner_points(scene.pieces()[part.piece])));
            std::map<std::uint32_t, int> in_plane;
            for (const Piece& piece : scene.pieces()) ++in_plane[piece.support.id()];
            for (const auto& [piece, area] : seen) {
              const bool alone = in_plane[scene.pieces()[piece].support.id()] == 1;
              if (alone ? lit[piece] != area : abs(lit[piece]) < abs(area))
                return Outcome::failed(face_name(scene.pieces()[piece].face) + ": lit " +
                                       sightline::to_string(lit[piece]) + ", seen " + sightline::to_string(area) +
                                       ", of twice its area along an axis");
            }
            return Outcome{};
          }};
}

}  // namespace shadow_subject

Rational area_of(const std::vector<Exact_point>& polygon, std::size_t axis) {
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  Rational twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Exact_point &p = polygon[k], &q = polygon[k + 1 == polygon.size() ? 0 : k + 1];
    twice += p[x] * q[y] - p[y] * q[x];
  }
  return twice;
}

std::string flaw_of(const Shadows& shadows, const Polygon_soup& soup, const Scene& scene, const Exact_point& light,
                    bool is_sun, bool two_sided) {
  using namespace shadow_subject;
  std::map<std::uint32_t, Rational> area;
  for (const Shadow_part& part : shadows.parts) {
    const Piece& piece = scene.pieces()[part.piece];
    const std::vector<Exact_point> whole = scene.corner_points(piece);
    const std::size_t axis = axis_of(whole);
    const Rational of_whole = area_of(whole, axis), of_part = area_of(part.vertices, axis);
    const std::string name = "a part of face " + std::to_string(piece.face);
    if (part.side != side_of(whole, light, is_sun)) return name + " has the light on its other side";
    if (sgn(of_part) != sgn(of_whole) || !is_convex(part.vertices, axis, sgn(of_whole)))
      return name + " is not convex, or turned round";
    area[part.piece] += of_part;
    const Exact_point middle = middle_of(part.vertices);
    const std::vector<Face_id> by = blockers(soup, scene, middle, light, is_sun);
    if (part.is_lit() ? !by.empty() : std::find(by.begin(), by.end(), scene.pieces()[part.by].face) == by.end())
      return name + " about " + sightline::to_string(middle[0]) + "," + sightline::to_string(middle[1]) + "," +
             sightline::to_string(middle[2]) +
             (part.is_lit()
                  ? " is lit, but face " + std::to_string(by[0]) + " is on the way"
                  : ": face " + std::to_string(scene.pieces()[part.by].face) + " is not the first on the way");
  }
  for (const auto& [piece, twice] : area) {
    const std::vector<Exact_point> whole = scene.corner_points(scene.pieces()[piece]);
    if (twice != area_of(whole, axis_of(whole))) return "parts do not tile " + face_name(scene.pieces()[piece].face);
  }

  std::set<Face_id> kept, turned, lit, away;
  for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
    const Face_id face = scene.pieces()[piece].face;
    const Sign side = side_of(scene.corner_points(scene.pieces()[piece]), light, is_sun);
    const bool is_asked = side == CGAL::POSITIVE || (two_sided && side == CGAL::NEGATIVE);
    if (is_asked != area.contains(piece))
      return face_name(face) +
             (is_asked ? " is turned to the light, but has no parts" : " has parts, but is not asked");
    kept.insert(face);
    if (is_asked) turned.insert(face);
  }
  for (const Shadow_part& part : shadows.parts)
    if (part.is_lit()) lit.insert(scene.pieces()[part.piece].face);
  std::ranges::set_difference(kept, turned, std::inserter(away, away.end()));
  if (!std::ranges::equal(shadows.lit, lit)) return "the faces that are lit are not those of the lit parts";
  if (!std::ranges::equal(shadows.away, away)) return "the faces said to be away are not those without a part";
  return {};
}

std::string flaw_of(const Shadow_volume& volume, const Polygon_soup& soup, const Scene& scene, const Exact_point& light,
                    bool is_sun, std::size_t points, generate::Random& random) {
  using namespace shadow_subject;
  if (scene.pieces().empty()) return volume.soup.face_count() == 0 ? "" : "a scene of nothing has a shadow volume";
  if (volume.box != box_about(scene)) return "the box is not the scene's, larger by a quarter of its longest side";
  const Polygon_soup flat = without_holes(volume.soup).soup;
  const Scene surface(flat);
  for (std::size_t k = 0; k < points; ++k) {
    Exact_point p;
    for (std::size_t axis = 0; axis < 3; ++axis)
      p[axis] = volume.box[0][axis] +
                (volume.box[1][axis] - volume.box[0][axis]) * Rational(static_cast<long>(random.between(1, 996)), 997);
    if (!is_sun && p == light) continue;
    const std::optional<int> winding = winding_at(flat, surface, p, random);
    if (!winding) continue;
    const bool is_dark = !blockers(soup, scene, p, light, is_sun).empty();
    if (*winding != (is_dark ? 1 : 0))
      return "the volume winds " + std::to_string(*winding) + " times round " + sightline::to_string(p[0]) + "," +
             sightline::to_string(p[1]) + "," + sightline::to_string(p[2]) + ", which " +
             (is_dark ? "some face" : "no face") + " keeps from the light";
  }
  return {};
}

Subject shadow() {
  using namespace shadow_subject;
  Subject subject;
  subject.name = "shadow";
  subject.what = "lit and dark parts of faces by a point and by suns, by rays and by what an eye sees";
  subject.answer = labels;
  subject.checks = {by_definition(), as_seen(), by_volume()};
  add_laws(subject, {"begin", "permute", "translate", "scale", "rotate", "stretch", "project", "mirror", "turn", "cut",
                     "bystander"});
  subject.checks.push_back(manners_check(questions_of_shadow()));
  return subject;
}

}  // namespace sightline::harness
