#include <sightline/harness/judge/case.h>

#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/judge/rays.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/harness/judge/truth.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>

namespace sightline::judge {

namespace {

/// A planar convex piece of the scene.
std::vector<Exact_point> a_piece(const Scene& scene, std::uint64_t seed) {
  if (scene.pieces().empty()) return {};
  return scene.corner_points(scene.pieces()[seed % scene.pieces().size()]);
}

bool are_same(const Polygon_soup& a, const Polygon_soup& b) {
  if (a.coordinates.size() != b.coordinates.size() || a.face_count() != b.face_count()) return false;
  for (std::size_t k = 0; k < a.coordinates.size(); ++k)
    if (a.coordinates[k] != b.coordinates[k]) return false;
  for (Face_id f = 0; f < a.face_count(); ++f) {
    if (a.loop_count(f) != b.loop_count(f)) return false;
    for (std::size_t k = 0; k < a.loop_count(f); ++k)
      if (!std::ranges::equal(a.loop(f, k), b.loop(f, k))) return false;
  }
  return true;
}

/// Each face in triangles, on the same points: of a face that is no triangle, the fans of its convex pieces.
Polygon_soup in_triangles(const Polygon_soup& soup) {
  const Scene scene(soup);
  std::map<Exact_point, Point_id> ids;
  for (Point_id p = 0; p < soup.point_count(); ++p) ids.emplace(soup.point(p), p);
  Polygon_soup triangles;
  triangles.file = soup.file;
  triangles.coordinates = soup.coordinates;
  std::size_t next = 0;  // pieces are in the order of faces
  for (Face_id face = 0; face < soup.face_count(); ++face) {
    if (soup.loop(face).size() <= 3) triangles.add_face(soup.loop(face));
    for (; next < scene.pieces().size() && scene.pieces()[next].face == face; ++next) {
      if (soup.loop(face).size() <= 3) continue;
      const auto corners = scene.corners(scene.pieces()[next]);
      const auto id = [&](std::size_t i) { return ids.at(scene.position(corners[i].point)); };
      for (std::size_t i = 1; i + 1 < corners.size(); ++i) triangles.add_face({id(0), id(i), id(i + 1)});
    }
  }
  return triangles;
}

bool same_rays(const std::vector<Exact_ray>& a, const std::vector<Exact_ray>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Exact_ray& r, const Exact_ray& s) {
    return r.origin == s.origin && r.direction == s.direction;
  });
}

/// The rays of a case whose scene stands, as programs get them; one whose direction is rounded to nothing is left out.
void add_rays(Case& made, std::uint64_t seed, const Case_options& options) {
  made.query.rays = rays_about(made.soup, made.query.eye, seed);
  if (options.doubles) made.query = rounded_to_doubles(std::move(made.query));
  std::erase_if(made.query.rays, [](const Exact_ray& ray) { return ray.direction == Exact_point{0, 0, 0}; });
}

/// Planar faces, or triangles.
Polygon_soup with_faces_for(const Polygon_soup& soup, const Case_options& options) {
  Polygon_soup planar = with_planar_faces(soup);
  return options.triangles ? in_triangles(planar) : planar;
}

/// As programs get it: rounded where that is wanted, and with planar faces.
void prepare(Case& made, const Case_options& options) {
  const Polygon_soup given = made.soup;
  const Query wanted = made.query;
  if (options.doubles) {
    made.soup = rounded_to_doubles(made.soup);
    made.query = rounded_to_doubles(std::move(made.query));
  }
  if (options.question == Question::boolean) {
    std::array<Polygon_soup, 2> solids = solids_of(made.soup, made.query.first);
    for (Polygon_soup& solid : solids) solid = with_faces_for(solid, options);
    made.soup = joined(solids);
    made.query.first = solids[0].face_count();
  } else {
    made.soup = with_faces_for(made.soup, options);
  }
  made.as_given =
      are_same(made.soup, given) &&
      (options.question == Question::weak ? made.query.source == wanted.source : made.query.eye == wanted.eye) &&
      same_rays(made.query.rays, wanted.rays);
}

/// Two solids, and any operation on them.
void pose_solids(Case& made, const generate::Solid_pair& solids, generate::Random& random) {
  made.soup = joined(solids);
  made.query.first = solids[0].face_count();
  made.query.operation = set_operations[random.below(4)];
}

/// Runs `make`; what cannot be made, or is beyond the range of doubles, is not asked.
template <class Make>
Case attempted(Make make) {
  Case made;
  try {
    make(made);
  } catch (const std::invalid_argument& error) {
    made.not_asked = error.what();
  } catch (const std::domain_error&) {
    made.not_asked = "coordinates are beyond the range of doubles";
  }
  return made;
}

}  // namespace

Case case_of(const generate::Family& family, const generate::Family_parameters& parameters,
             const Case_options& options) {
  return attempted([&](Case& made) {
    generate::Posed_scene posed = family.make(parameters);
    made.soup = posed.soup;
    made.query = {options.question, posed.eye, posed.source, options.two_sided};
    if (options.question == Question::boolean) {
      std::uint64_t seed = parameters.seed;  // another for each family, or all would be asked the same operation
      for (const char letter : family.name) seed = seed * 31 + static_cast<unsigned char>(letter);
      generate::Random random(seed);
      pose_solids(made, generate::pair_of_solids(posed, random), random);
    }
    prepare(made, options);
    if (options.question == Question::trace) add_rays(made, parameters.seed, options);
    if (options.question != Question::weak) return;
    if (posed.source.empty()) made.query.source = a_piece(Scene(made.soup), parameters.seed);
    else if (!options.two_sided && made.as_given) {
      made.visible = posed.visible;
      made.hidden = posed.hidden;
    }
  });
}

Case case_of(const Polygon_soup& scene, std::uint64_t seed, const Case_options& options) {
  return attempted([&](Case& made) {
    made.soup = scene;
    made.query.question = options.question;
    made.query.two_sided = options.two_sided;
    if (scene.point_count() == 0) return;
    Exact_point low = scene.point(0), high = low;
    for (Point_id p = 0; p < scene.point_count(); ++p)
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], scene.point(p)[k]);
        high[k] = std::max(high[k], scene.point(p)[k]);
      }
    generate::Random random(seed);
    if (options.question == Question::boolean) {
      pose_solids(made, generate::pair_of_copies(scene, random), random);
      prepare(made, options);
      return;
    }
    // A place in the box, or up to a quarter of its sides outside.
    Rational longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational side = high[k] - low[k];
      made.query.eye[k] = low[k] + side * Rational(static_cast<long>(random.between(-16, 80))) / 64;
      longest = std::max(longest, side);
    }
    // A square around it, counterclockwise as seen from a side of its axis.
    const std::size_t axis = random.below(3), x = (axis + 1) % 3, y = (axis + 2) % 3;
    const bool turned = random.chance(1, 2);
    const Rational half = longest / 32;
    for (const auto& [dx, dy] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
      Exact_point corner = made.query.eye;
      corner[x] += half * (turned ? dy : dx);
      corner[y] += half * (turned ? dx : dy);
      made.query.source.push_back(corner);
    }
    prepare(made, options);
    if (options.question == Question::trace) add_rays(made, seed, options);
  });
}

Case moved(const Case& made, const Exact_point& by, const Case_options& options) {
  const auto move = [&](Exact_point& p) { p = generate::along(p, 1, by); };
  Polygon_soup soup = made.soup;
  Query query = made.query;
  move(query.eye);
  for (Exact_point& p : query.source) move(p);
  for (Exact_ray& ray : query.rays) move(ray.origin);
  if (query.question == Question::boolean) {
    std::array<Polygon_soup, 2> solids = solids_of(soup, query.first);
    solids[1] = generate::translated(solids[1], by);
    soup = joined(solids);
  }
  return case_of(soup, query, options);
}

Case case_of(const Polygon_soup& scene, const Query& query, const Case_options& options) {
  return attempted([&](Case& made) {
    made.soup = scene;
    made.query = query;
    prepare(made, options);
  });
}

}  // namespace sightline::judge
