#pragma once
// Cases of the judge: what programs get is what families and scenes give, rounded, cut and moved as it is said.

#include "judged_questions.h"

#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/judge/case.h>
#include <sightline/harness/judge/protocol.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/fuzz.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace fuzz::judged_laws {

inline bool same(const Polygon_soup& a, const Polygon_soup& b) {
  bool is_same = a.point_count() == b.point_count() && a.face_count() == b.face_count();
  for (Point_id p = 0; is_same && p < a.point_count(); ++p) is_same = a.point(p) == b.point(p);
  for (Face_id f = 0; is_same && f < a.face_count(); ++f) {
    is_same = a.loop_count(f) == b.loop_count(f);
    for (std::size_t k = 0; is_same && k < a.loop_count(f); ++k)
      is_same = std::equal(a.loop(f, k).begin(), a.loop(f, k).end(), b.loop(f, k).begin(), b.loop(f, k).end());
  }
  return is_same;
}

inline bool same(const Query& a, const Query& b) {
  const auto is_same_ray = [](const Exact_ray& p, const Exact_ray& q) {
    return p.origin == q.origin && p.direction == q.direction;
  };
  return a.question == b.question && a.eye == b.eye && a.source == b.source && a.two_sided == b.two_sided &&
         a.operation == b.operation && a.first == b.first &&
         std::equal(a.rays.begin(), a.rays.end(), b.rays.begin(), b.rays.end(), is_same_ray);
}

inline bool is_double(const Exact_point& p) {
  return std::all_of(p.begin(), p.end(), [](const Rational& x) { return exact(x.get_d()) == x; });
}

/// Whether all coordinates are doubles, and none has a neighbour nearer to what was rounded.
inline bool is_nearest(const Exact_point& rounded, const Exact_point& p) {
  for (std::size_t k = 0; k < 3; ++k)
    for (const double way : {-1.0, 1.0}) {
      const double next = std::nextafter(rounded[k].get_d(), way * std::numeric_limits<double>::infinity());
      if (std::isfinite(next) && abs(rounded[k] - p[k]) > abs(exact(next) - p[k])) return false;
    }
  return is_double(rounded);
}

/// Where an eye, a source, rays or a second solid are.
inline Points places(const Case& made, const Case_options& options) {
  if (options.question == Question::weak) return made.query.source;
  if (options.question == Question::see || options.question == Question::order) return {made.query.eye};
  Points all;
  for (const Exact_ray& ray : made.query.rays) all.push_back(ray.origin);
  if (options.question == Question::boolean)
    for (auto f = static_cast<Face_id>(made.query.first); f < made.soup.face_count(); ++f)
      for (const Point_id p : made.soup.loop(f)) all.push_back(made.soup.point(p));
  return all;
}

inline void require_moved(const Case& made, const Case_options& options, Random& random) {
  const Exact_point there = generate::half_lattice(random, 3), back = minus(Exact_point{0, 0, 0}, there);
  const Case moved = judge::moved(made, there, options);
  if (!moved.not_asked.empty()) return;
  const Points from = places(made, options), to = places(moved, options);
  require(from.size() == to.size(), "what is moved stays as much as it was");
  for (std::size_t k = 0; k < from.size(); ++k)
    require(minus(to[k], from[k]) == there, "what is asked about is moved as far as it is said");
  if (options.question != Question::boolean) require(same(moved.soup, made.soup), "a scene stays where it is");
  require(is_zero(there) || (moved.visible.empty() && moved.hidden.empty()),
          "of a case that is moved construction knows nothing");
  const Case again = judge::moved(moved, back, options);
  if (!again.not_asked.empty()) return;
  require(same(again.soup, made.soup) && same(again.query, made.query), "what is moved back is what it was");
}

/// Twice the vector area of all faces.
inline Exact_point vector_area(const Polygon_soup& soup) {
  Exact_point sum{0, 0, 0};
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    Points corners;
    for (const Point_id p : soup.loop(f)) corners.push_back(soup.point(p));
    sum = generate::along(sum, 1, Flat_face(corners).normal);
  }
  return sum;
}

/// Triangles, some with a corner more inside an edge: a case is as given iff nothing of it was changed.
inline void try_case_with_straight_corners(Random& random) {
  generate::Faces faces;
  for (std::uint64_t n = 1 + random.below(3); n > 0; --n) {
    Points face{generate::lattice(random, 5), generate::lattice(random, 5), generate::lattice(random, 5)};
    if (is_zero(cross(minus(face[1], face[0]), minus(face[2], face[0])))) return;
    const std::size_t at = random.below(3);
    if (random.chance(2, 3))
      face.insert(face.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                  generate::along(face[at], Rational(1, 2), minus(face[(at + 1) % 3], face[at])));
    faces.push_back(face);
  }
  const Polygon_soup soup = generate::soup_of(faces);
  Query query;
  query.question = Question::see;
  query.eye = generate::lattice(random, 5);
  Case_options options;
  options.question = Question::see;
  options.triangles = random.chance(3, 4);
  const Case made = judge::case_of(soup, query, options);
  if (made.not_asked.empty())
    require(made.as_given == same(made.soup, soup), "a case is as given iff nothing of it was changed");
}

inline void try_case_of_a_family(Random& random) {
  const harness::Fuzz_case drawn = any_case(random);
  const harness::Posed_scene posed = harness::make(drawn);
  if (posed.soup.face_count() > most_faces) return;
  const auto question = static_cast<Question>(random.below(5));
  const Case_options options = any_options(question, random);
  const auto made_by = [&](const Case_options& asked) {
    return judge::case_of(generate::family(drawn.family), drawn.parameters, asked);
  };
  // 1. The same again.
  const Case made = made_by(options), again = made_by(options);
  require(same(made.soup, again.soup) && same(made.query, again.query) && made.visible == again.visible &&
              made.hidden == again.hidden && made.as_given == again.as_given && made.not_asked == again.not_asked,
          "a case is the same when it is asked for again");
  if (!made.not_asked.empty()) return;
  require(made.query.question == question && made.query.two_sided == options.two_sided,
          "a case asks what it was asked for");
  const std::string told = judge::to_json(made.query).dump();
  require(judge::to_json(judge::query_from_json(nlohmann::json::parse(told))).dump() == told,
          "a query is read as it is written");
  // 2. As the family gave it.
  if (question != Question::boolean && question != Question::trace) {
    const bool is_given = same(made.soup, posed.soup) &&
                          (question == Question::weak ? posed.source.empty() || made.query.source == posed.source
                                                      : made.query.eye == posed.eye);
    require(made.as_given || !is_given, "a case of which nothing was changed is as given");
    require(is_given || !made.as_given, "a case of which something was changed is not as given");
  }
  if (!made.as_given || question != Question::weak)
    require(made.visible.empty() && made.hidden.empty(), "construction knows of what is as given alone");
  else if (!options.two_sided)
    require(made.visible == posed.visible && made.hidden == posed.hidden, "what construction knows is the family's");
  // 3. In doubles.
  Case_options exactly = options;
  exactly.doubles = false;
  const Case as_made = made_by(exactly);
  if (options.doubles && as_made.not_asked.empty()) {
    for (Point_id p = 0; p < made.soup.point_count(); ++p)
      require(is_double(made.soup.point(p)), "points are of doubles");
    for (const Exact_ray& ray : made.query.rays)
      require(is_double(ray.origin) && is_double(ray.direction), "rays are of doubles");
    require(is_nearest(made.query.eye, as_made.query.eye), "an eye is rounded to the nearest doubles");
    if (question != Question::boolean) {  // solids lose points that are one when they are rounded
      require(made.soup.point_count() == as_made.soup.point_count(), "no point is lost as numbers are rounded");
      for (Point_id p = 0; p < made.soup.point_count(); ++p)
        require(is_nearest(made.soup.point(p), as_made.soup.point(p)), "points are rounded to the nearest doubles");
    }
    if (question == Question::weak && !posed.source.empty()) {
      const Points &source = made.query.source, &from = as_made.query.source;
      require(source.size() == from.size() || source.size() == 3, "a source keeps its corners, or three of them");
      for (const Exact_point& p : source)
        require(std::any_of(from.begin(), from.end(), [&](const Exact_point& q) { return is_nearest(p, q); }),
                "a source is rounded to the nearest doubles");
    }
  }
  // 4. In triangles.
  if (options.triangles && question != Question::boolean) {
    Case_options whole = options;
    whole.triangles = false;
    const Case uncut = made_by(whole);
    for (Face_id f = 0; f < made.soup.face_count(); ++f)
      require(made.soup.loop_count(f) == 1 && made.soup.loop(f).size() == 3, "a triangle has three corners");
    if (const Scene scene(uncut.soup); uncut.not_asked.empty() && scene.set_aside().empty())
      require(vector_area(made.soup) == vector_area(uncut.soup), "triangles are as large as what they were cut from");
  }
  // 5. Moved.
  if (!options.doubles) require_moved(made, options, random);
}

/// A source in any plane, in thirds, whose first corners are on a line at times.
inline void try_rounded_source(Random& random) {
  const std::array<Exact_point, 2> axes = generate::directions(random, 5);
  const Exact_point origin = generate::lattice(random, 5);
  Query query;
  for (const auto& [x, y] : random.chance(1, 2)
                                ? std::vector<std::array<long, 2>>{{0, 0}, {2, 0}, {3, 2}, {1, 3}}
                                : std::vector<std::array<long, 2>>{{0, 0}, {1, 0}, {2, 0}, {3, 2}, {1, 3}}) {
    const Exact_point at = generate::along(generate::along(origin, Rational(x), axes[0]), Rational(y), axes[1]);
    query.source.push_back({at[0] / 3, at[1] / 3, at[2] / 3});
  }
  const Points source = judge::rounded_to_doubles(query).source;
  Points rounded;
  for (const Exact_point& p : query.source)
    rounded.push_back({exact(nearest_double(p[0])), exact(nearest_double(p[1])), exact(nearest_double(p[2]))});
  const auto normal = [&](std::size_t k) {
    return cross(minus(rounded[k - 1], rounded[0]), minus(rounded[k], rounded[0]));
  };
  std::size_t first = 2;  // that is not on a line with those before it
  while (is_zero(normal(first))) ++first;
  const bool is_planar = std::all_of(rounded.begin(), rounded.end(), [&](const Exact_point& p) {
    return dot(normal(first), minus(p, rounded[0])) == 0;
  });
  require(source == (is_planar ? rounded : Points{rounded[0], rounded[first - 1], rounded[first]}),
          "a source that is rounded out of its plane is its first triangle");
}

inline void try_case_of_a_scene(Random& random) {
  const harness::Posed_scene posed = harness::make(any_case(random));
  if (posed.soup.face_count() == 0 || posed.soup.face_count() > most_faces) return;
  Case_options options = any_options(static_cast<Question>(random.below(5)), random);
  options.doubles = options.triangles = false;
  if (random.chance(1, 64))
    require(judge::case_of(Polygon_soup(), random.below(1000), options).soup.point_count() == 0,
            "a case about nothing is one");
  const Case made = judge::case_of(posed.soup, random.below(1000), options);
  if (!made.not_asked.empty()) return;
  const std::array<Exact_point, 2> box = Scene(posed.soup).box();
  const Exact_point &low = box[0], &high = box[1];
  const Exact_point sides = minus(high, low);
  const Rational longest = *std::max_element(sides.begin(), sides.end());
  const auto is_about = [&](const Exact_point& p) {
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] < low[k] - sides[k] / 4 || p[k] > high[k] + sides[k] / 4) return false;
    return true;
  };
  if (options.question == Question::see || options.question == Question::order)
    require(is_about(made.query.eye), "an eye is in the scene's box, or a quarter of its sides beyond");
  if (options.question == Question::weak) {
    const Points& source = made.query.source;
    require(source.size() == 4, "a source about a scene has four corners");
    std::size_t axes = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Exact_point edge = minus(source[(k + 1) % 4], source[k]), next = minus(source[(k + 2) % 4], source[k]);
      std::size_t along = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (edge[axis] != 0) {
          axes |= std::size_t{1} << axis;
          ++along;
          require(abs(edge[axis]) == longest / 16, "sides of a source are a sixteenth of the longest side of the box");
        }
      require(along == 1, "sides of a source are along axes");
      require(!is_zero(cross(edge, next)), "a source has corners");
    }
    require(axes == 3 || axes == 5 || axes == 6, "a source is in a plane across an axis");
    require(is_about(generate::centroid(source)), "a source is about the scene");
  }
  if (options.question == Question::trace)
    for (const Exact_ray& ray : made.query.rays) require(!is_zero(ray.direction), "a ray goes somewhere");
  if (options.question == Question::boolean &&
      same(made.soup, judge::joined(judge::solids_of(made.soup, made.query.first)))) {
    const generate::Solid_pair solids = judge::solids_of(made.soup, made.query.first);
    require(solids[0].face_count() == solids[1].face_count(), "a copy has the faces of the scene");
    const Exact_point step = minus(solids[1].point(solids[1].loop(0)[0]), solids[0].point(solids[0].loop(0)[0]));
    for (Face_id f = 0; f < solids[0].face_count(); ++f)
      for (std::size_t k = 0; k < solids[0].loop(f).size(); ++k)
        require(minus(solids[1].point(solids[1].loop(f)[k]), solids[0].point(solids[0].loop(f)[k])) == step,
                "a copy is the scene, moved");
  }
  require_moved(made, options, random);
}

}  // namespace fuzz::judged_laws
