#include <sightline/harness/generate/families.h>

#include <sightline/harness/generate/exponents.h>
#include <sightline/harness/generate/gap_drafts.h>
#include <sightline/harness/generate/many_corners.h>
#include <sightline/harness/generate/projective.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/harness/generate/tangles.h>
#include <sightline/harness/generate/touching_solids.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/generate/twisted_holes.h>
#include <sightline/harness/generate/weak_draft.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace sightline::generate {

Posed_scene placed(Posed_scene scene, const Family_parameters& parameters) {
  require(sgn(parameters.scale) > 0, "the scale must be positive");
  if (!is_zero(parameters.offset) || parameters.scale != 1) {
    const auto place = [&](const Exact_point& p) { return along(parameters.offset, parameters.scale, p); };
    scene.soup = mapped(scene.soup, [&](Point_id, const Exact_point& p) { return place(p); });
    scene.eye = place(scene.eye);
    for (Exact_point& p : scene.source) p = place(p);
  }
  const std::uint64_t size = parameters.ulps < 0 ? 0 - static_cast<std::uint64_t>(parameters.ulps)
                                                 : static_cast<std::uint64_t>(parameters.ulps);
  scene.distance = size == 0                                     ? Distance::exact
                   : size < static_cast<std::uint64_t>(far_ulps) ? Distance::beside
                                                                 : Distance::far;
  return scene;
}

Rational power_of_two(int power) {
  Rational value = 1;
  if (power < 0) mpq_div_2exp(value.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(-power));
  else mpq_mul_2exp(value.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(power));
  return value;
}

Rational long_integer(Random& random) {
  const Rational size = power_of_two(static_cast<int>(random.between(52, 57)));
  const Rational value = size + integer(random, -9, 9);
  return random.chance(1, 2) ? Rational(-value) : value;
}

int size_bits(const Polygon_soup& soup) {
  Rational most = 1;
  for (std::size_t k = 0; k < soup.coordinates.size(); ++k) most = std::max(most, Rational(abs(soup.coordinates[k])));
  int bits = 0;
  for (Rational power = 1; power < most; power *= 2) ++bits;
  return bits;
}

Posed_scene with_an_eye(view_drafts::Made made, const Family_parameters& parameters, Random& random) {
  require(parameters.size <= 1000000, "size: at most 10^6 faces");
  while (made.faces.size() < parameters.size) made.faces.push_back(any_face(random));
  Posed_scene scene;
  scene.soup = soup_of(made.faces);
  scene.eye = made.eyes[random.below(made.eyes.size())];
  return scene;
}

Posed_scene nudged(view_drafts::Made made, const Family_parameters& parameters, Random& random) {
  const Rational gap = ulps_of_size(parameters.ulps, small_bits);
  for (std::size_t count = 1 + random.below(3); count > 0; --count) {
    const std::size_t chosen = random.below(made.faces.size() + 1);
    const Exact_point axis = view_drafts::unit_vector(random);
    if (chosen < made.faces.size()) made.faces[chosen] = view_drafts::moved(made.faces[chosen], gap, axis);
    else made.eyes = view_drafts::moved(made.eyes, gap, axis);
  }
  return with_an_eye(std::move(made), parameters, random);
}

namespace {

/// Faces with holes, and others anywhere, with some eye.
Posed_scene holed_scene(const std::vector<Holed_face>& holed, std::size_t others, std::size_t size, Random& random) {
  require(size <= 1000000, "size: at most 10^6 faces");
  Faces faces;
  add_any(faces, others, random);
  while (faces.size() + holed.size() < size) faces.push_back(any_face(random));
  Posed_scene scene;
  scene.soup = soup_of(faces);
  for (const Holed_face& face : holed) {
    scene.soup.add_face(added(scene.soup, face.outer));
    for (const Points& hole : face.holes) scene.soup.add_hole(added(scene.soup, hole));
    faces.push_back(face.outer);
  }
  scene.eye = view_drafts::some_eye(faces, random);
  return scene;
}

}  // namespace

Posed_scene with_twisted_holes(const Family_parameters& parameters, Random& random) {
  const Rational gap = ulps_of_size(parameters.ulps, small_bits);
  std::vector<Holed_face> holed;
  for (std::size_t count = 1 + random.below(3); count > 0; --count) holed.push_back(twisted_holes(random, gap));
  const std::size_t others = 1 + random.below(3);
  return holed_scene(holed, others, parameters.size, random);
}

Posed_scene with_flat_holes(const Family_parameters& parameters, Random& random) {
  const std::vector<Holed_face> holed = windows(random, ulps_of_size(parameters.ulps, small_bits));
  const std::size_t others = random.below(3);
  Posed_scene scene = holed_scene(holed, others, parameters.size, random);
  if (random.chance(1, 2)) scene.source = either_way(rectangle(-3, 3, -3, 3, integer(random, -3, 3)), random);
  return scene;
}

Posed_scene with_many_corners(const Family_parameters& parameters, Random& random) {
  Posed_scene scene = nudged(view_drafts::with_some_eyes(many_corners(random), random), parameters, random);
  if (random.chance(1, 2)) scene.source = round_face(random);
  return scene;
}

Posed_scene with_a_source(const weak_drafts::Drafter& drafter, const Family_parameters& parameters, Random& random) {
  require(parameters.size <= 1000000, "size: at most 10^6 faces");
  weak_drafts::Draft draft = drafter.draft(random, ulps_of_size(parameters.ulps, small_bits));
  const std::size_t own = draft.faces.size();
  while (draft.faces.size() < parameters.size)
    draft.faces.push_back(view_drafts::moved(any_face(random), 32, at(1, 1, 1)));
  if (draft.faces.size() > own && draft.targets.size() == own) draft.targets = {0};
  Weak_scene question = weak_drafts::finished(std::move(draft), random);
  Posed_scene scene;
  scene.soup = std::move(question.soup);
  scene.source = std::move(question.source);
  if (question.truth) (*question.truth ? scene.visible : scene.hidden) = question.targets;
  const Exact_point middle = centroid(scene.source);
  switch (random.below(3)) {
    case 0: scene.eye = middle; break;
    case 1: scene.eye = scene.source[random.below(scene.source.size())]; break;
    default: {
      const Point_id p = static_cast<Point_id>(random.below(scene.soup.point_count()));
      scene.eye = centroid({middle, scene.soup.point(p)});
    }
  }
  return scene;
}

Posed_scene of_two_solids(const touching_solids::Drafter& drafter, const Family_parameters& parameters,
                          Random& random) {
  require(parameters.size <= 1000000, "size: at most 10^6 faces");
  Solid_pair pair = drafter.draft(random, ulps_of_size(parameters.ulps, touching_solids::bits));
  touching_solids::enlarge(pair, parameters.size);
  Posed_scene scene;
  scene.soup = joined(pair);
  scene.first = pair[0].face_count();
  Faces faces;
  for (Face_id f = 0; f < scene.soup.face_count(); ++f) {
    faces.emplace_back();
    for (const Point_id p : scene.soup.loop(f)) faces.back().push_back(scene.soup.point(p));
  }
  scene.eye = view_drafts::some_eye(faces, random);
  return scene;
}

Posed_scene of_a_kind(const Kind& kind, const Family_parameters& parameters, Random& random) {
  Posed_scene scene;
  scene.soup = kind.make(parameters.size == 0 ? kind.example_size : parameters.size, parameters.seed);
  if (kind.name == "triangles_between_squares")  // its face as it was: once moved, it may not be planar
    for (const Point_id p : scene.soup.loop(0)) scene.source.push_back(scene.soup.point(p));
  if (parameters.ulps != 0) {
    const Rational gap = ulps_of_size(parameters.ulps, size_bits(scene.soup));
    scene.soup = mapped(scene.soup, [&](Point_id, Exact_point p) {
      for (Rational& x : p) x += gap * integer(random, -1, 1);
      return p;
    });
  }
  const std::size_t points = scene.soup.point_count();
  if (points == 0) return scene;
  const auto corner = [&] { return scene.soup.point(static_cast<Point_id>(random.below(points))); };
  const Exact_point p = corner(), q = corner(), r = corner();
  switch (random.below(4)) {
    case 0: scene.eye = p; break;
    case 1: scene.eye = along(p, integer(random, 1, 3), minus(p, q)); break;
    case 2: scene.eye = centroid({p, q, r}); break;
    default: {
      const Exact_point beside = along(p, integer(random, -2, 2), minus(q, r));
      scene.eye = along(beside, ratio(static_cast<long>(random.between(1, 5)), 3), at(1, 2, 3));
    }
  }
  return scene;
}

const std::vector<Family>& families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> list;
    // Each family has random numbers of its own: seed 64 s + number; beyond 63, those of the next s of another family.
    const auto add = [&](const std::string& name, const std::string& what, const std::string& size_means,
                         std::size_t small_size, std::uint64_t number, auto make) {
      list.push_back(
          {name, what, size_means, small_size, false, false, [name, number, make](const Family_parameters& parameters) {
             Random random(parameters.seed * 64 + number);
             Posed_scene scene = make(parameters, random);
             scene.name = name + ' ' + std::to_string(parameters.seed);
             if (scene.soup.file.empty()) scene.soup.file = name;
             return placed(std::move(scene), parameters);
           }});
    };
    const std::string faces = "faces, at least";
    for (std::size_t k = 0; k < weak_drafts::drafters.size(); ++k)
      add(weak_drafts::drafters[k].name, weak_drafts::drafters[k].what, faces, 0, k,
          [k](const Family_parameters& parameters, Random& random) {
            return with_a_source(weak_drafts::drafters[k], parameters, random);
          });
    for (std::size_t k = 0; k < view_drafts::drafters.size(); ++k)
      add(view_drafts::drafters[k].name, view_drafts::drafters[k].what, faces, 0, 20 + k,
          [k](const Family_parameters& parameters, Random& random) {
            return nudged(view_drafts::drafters[k].draft(random), parameters, random);
          });
    for (std::size_t k = 0; k < view_drafts::gap_drafters.size(); ++k)
      add(view_drafts::gap_drafters[k].name, view_drafts::gap_drafters[k].what, faces, 0, 32 + k,
          [k](const Family_parameters& parameters, Random& random) {
            return with_an_eye(view_drafts::gap_drafters[k].draft(random, ulps_of_size(parameters.ulps, small_bits)),
                               parameters, random);
          });
    add("touching_faces", "convex faces, each placed by another one: in its plane, on its edge or corner, through it",
        faces, 0, 40, [](const Family_parameters& parameters, Random& random) {
          return nudged(view_drafts::with_some_eyes(touching_faces(random), random), parameters, random);
        });
    add("tangle", "faces on a tiny lattice, also concave, crossing themselves, non-planar, repeated and without area",
        faces, 0, 41, [](const Family_parameters& parameters, Random& random) {
          return nudged(view_drafts::with_some_eyes(tangle(random), random), parameters, random);
        });
    add("twisted_holes",
        "faces with holes, not planar, simple along all axes, some or none; K ulps beside (no file format holds them)",
        faces, 0, 38,
        [](const Family_parameters& parameters, Random& random) { return with_twisted_holes(parameters, random); });
    list.back().holes = true;
    add("flat_holes",
        "planar faces with holes that touch in corners and on edges; K ulps beside (no file format holds them)", faces,
        0, 58, [](const Family_parameters& parameters, Random& random) { return with_flat_holes(parameters, random); });
    list.back().holes = true;
    add("many_corners", "faces of 8 to 22 corners: convex, combs, saws, stairs, stars, spirals, with straight corners",
        faces, 0, 59,
        [](const Family_parameters& parameters, Random& random) { return with_many_corners(parameters, random); });
    add("exponents", "faces and a source whose coordinates have exponents from -1070 to 1020, mixed", faces, 0, 39,
        [](const Family_parameters& parameters, Random& random) {
          Faces_and_source made = exponents(random);
          Posed_scene scene = nudged(view_drafts::with_some_eyes(std::move(made.faces), random), parameters, random);
          scene.source = std::move(made.source);
          return scene;
        });
    for (std::size_t k = 0; k < touching_solids::drafters.size(); ++k) {
      add(touching_solids::drafters[k].name, touching_solids::drafters[k].what, faces, 0, 64 + k,
          [k](const Family_parameters& parameters, Random& random) {
            return of_two_solids(touching_solids::drafters[k], parameters, random);
          });
      list.back().pair = true;
    }
    for (std::size_t k = 0; k < kinds().size(); ++k) {
      const Kind& kind = kinds()[k];
      add(std::string(kind.name), std::string(kind.what), std::string(kind.size_means), kind.small_size, 42 + k,
          [&kind](const Family_parameters& parameters, Random& random) { return of_a_kind(kind, parameters, random); });
    }
    return list;
  }();
  return all;
}

const Family& family(std::string_view name) {
  std::string names;
  for (const Family& f : families()) {
    if (f.name == name) return f;
    names += (names.empty() ? "" : ", ") + f.name;
  }
  throw std::invalid_argument("no family '" + std::string(name) + "': choose one of " + names);
}

}  // namespace sightline::generate
