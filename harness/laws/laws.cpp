#include <sightline/harness/laws/laws.h>

#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/weak_draft.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sightline::harness {

std::vector<std::optional<Face_id>> same_faces(const Polygon_soup& soup) {
  std::vector<std::optional<Face_id>> faces(soup.face_count());
  for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = static_cast<Face_id>(f);
  return faces;
}

generate::Points convex_corners(const Polygon_soup& soup, Face_id face) {
  using namespace generate;
  if (soup.loop_count(face) != 1) return {};
  Points corners;
  for (const Point_id p : soup.loop(face)) corners.push_back(soup.point(p));
  const std::size_t n = corners.size();
  if (n < 3) return {};
  const Exact_point normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j) {
      const Exact_point &a = corners[k], &b = corners[(k + 1) % n], &c = corners[j];
      if (sgn(dot(normal, minus(c, a))) != 0) return {};
      if (j != k && j != (k + 1) % n && sgn(dot(normal, cross(minus(b, a), minus(c, a)))) <= 0) return {};
    }
  return corners;
}

std::optional<Image> begun_elsewhere(const Posed_scene& scene, Random& random) {
  Image image{scene, same_faces(scene.soup)};
  Polygon_soup& soup = image.scene.soup = {};
  soup.file = scene.soup.file;
  soup.coordinates = scene.soup.coordinates;
  for (Face_id f = 0; f < scene.soup.face_count(); ++f)
    for (std::size_t k = 0; k < scene.soup.loop_count(f); ++k) {
      const auto given = scene.soup.loop(f, k);
      std::vector<Point_id> loop(given.begin(), given.end());
      if (!loop.empty()) {
        std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(random.below(loop.size())), loop.end());
        const std::size_t at = random.below(loop.size());
        Point_id extra = loop[at];
        if (random.chance(1, 2)) {
          const Exact_point p = soup.point(extra), q = soup.point(loop[(at + 1) % loop.size()]);
          const Exact_point middle = generate::along(p, generate::ratio(1, 2), minus(q, p));
          extra = soup.add_point(middle[0], middle[1], middle[2]);
        }
        if (random.chance(1, 2)) loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(at) + 1, extra);
      }
      if (k == 0) soup.add_face(loop);
      else soup.add_hole(loop);
    }
  return image;
}

std::optional<Image> permuted(const Posed_scene& scene, Random& random) {
  const std::vector<Face_id> order = generate::random_order(scene.soup.face_count(), random.below(1u << 30));
  Image image{scene, {}};
  image.scene.soup = generate::with_faces(scene.soup, order);
  image.face_of.assign(order.begin(), order.end());
  return image;
}

constexpr std::size_t few_faces = 40;  // of a scene whose numbers may be long

/// 2^-1200 to 2^1200 for one small scene in four, as numbers of so many bits take long; else nearer to 1.
static std::int64_t most_power(const Posed_scene& scene, Random& random, std::int64_t else_most) {
  return scene.soup.face_count() <= few_faces && random.chance(1, 4) ? 1200 : else_most;
}

std::optional<Image> translated(const Posed_scene& scene, Random& random) {
  const std::int64_t reach = random.chance(1, 2) ? 10 : 100000000, most = most_power(scene, random, 0);
  const Rational unit = generate::power_of_two(static_cast<int>(random.between(0, most)));
  Exact_point offset = generate::lattice(random, reach);
  for (Rational& x : offset) x *= unit;
  return moved_by(scene, [&](const Exact_point& p) { return generate::along(p, 1, offset); });
}

std::optional<Image> scaled(const Posed_scene& scene, Random& random) {
  const std::int64_t most = most_power(scene, random, 60);
  const Rational factor = generate::power_of_two(static_cast<int>(random.between(-most, most)));
  return moved_by(scene, [&](const Exact_point& p) { return generate::along({0, 0, 0}, factor, p); });
}

std::optional<Image> rotated(const Posed_scene& scene, Random& random) {
  const auto part = [&] { return static_cast<long>(random.between(-3, 3)); };
  const long a = static_cast<long>(random.between(1, 4)), b = part(), c = part(), d = part();
  const generate::Rational_matrix matrix = generate::rotation(a, b, c, d);
  return moved_by(scene, [&](const Exact_point& p) {
    Exact_point q{0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) q[i] += matrix[i][j] * p[j];
    return q;
  });
}

std::optional<Image> stretched(const Posed_scene& scene, Random& random) {
  const std::int64_t most = most_power(scene, random, random.chance(1, 3) ? 60 : 6);
  Exact_point factors;
  for (Rational& factor : factors) factor = generate::power_of_two(static_cast<int>(random.between(-most, most)));
  const std::size_t from = random.below(3), to = (from + 1 + random.below(2)) % 3;
  const Rational shear = static_cast<long>(random.between(-2, 2));
  return moved_by(scene, [&](Exact_point p) {
    p[to] += shear * p[from];
    for (std::size_t k = 0; k < 3; ++k) p[k] *= factors[k];
    return p;
  });
}

std::optional<Image> projected(const Posed_scene& scene, Random& random) {
  constexpr std::size_t most_points = 16;  // each brings a denominator of its own
  if (scene.soup.point_count() > most_points || !random.chance(1, 4)) return std::nullopt;
  const Exact_point slope = generate::lattice(random, 3);
  Rational least = std::min<Rational>(0, dot(slope, scene.eye));  // at the origin, too: so no face is turned over
  for (const Exact_point& p : scene.source) least = std::min<Rational>(least, dot(slope, p));
  for (Point_id p = 0; p < scene.soup.point_count(); ++p)
    least = std::min<Rational>(least, dot(slope, scene.soup.point(p)));
  const Rational offset = static_cast<long>(random.between(1, 4)) - least;
  return moved_by(scene, [&](Exact_point p) {
    const Rational depth = offset + dot(slope, p);
    for (Rational& x : p) x /= depth;
    return p;
  });
}

std::optional<Image> mirrored(const Posed_scene& scene, Random& random) {
  const std::size_t axis = random.below(3);
  const bool swaps = random.chance(1, 2);  // two axes, instead of turning one round
  const auto map = [&](Exact_point p) {
    if (swaps) std::swap(p[axis], p[(axis + 1) % 3]);
    else p[axis] = -p[axis];
    return p;
  };
  return moved_by(scene, map, true);
}

std::optional<Image> turned(const Posed_scene& scene, Random&) {
  Image image{scene, same_faces(scene.soup), true};
  image.scene.soup = generate::faces_reversed(scene.soup);
  return image;
}

std::optional<Image> cut(const Posed_scene& scene, Random& random) {
  using namespace generate;
  const Polygon_soup& soup = scene.soup;
  if (soup.face_count() == 0) return std::nullopt;
  const Face_id chosen = static_cast<Face_id>(random.below(soup.face_count()));
  const Points corners = convex_corners(soup, chosen);
  if (corners.empty()) return std::nullopt;
  const std::size_t n = corners.size(), first = random.below(n), other = first + 1 + random.below(n - 1);  // edges
  const bool at_corner = n > 3 && other > first + 1 && other < first + n - 1 && random.chance(1, 2);
  const auto on_edge = [&](std::size_t k) {
    const Rational share = at_corner ? Rational(0) : ratio(static_cast<long>(random.between(1, 3)), 4);
    return along(corners[k % n], share, minus(corners[(k + 1) % n], corners[k % n]));
  };
  const Exact_point p = on_edge(first), q = on_edge(other);
  Points left{p}, right{q};
  for (std::size_t k = first + 1; k <= other; ++k) left.push_back(corners[k % n]);
  for (std::size_t k = other + 1; k <= first + n; ++k) right.push_back(corners[k % n]);
  if (!at_corner) {
    left.push_back(q);
    right.push_back(p);
  }
  Image image{scene, same_faces(soup)};
  std::vector<Face_id> order;
  for (Face_id f = 0; f < soup.face_count(); ++f)
    if (f != chosen) order.push_back(f);
  image.scene.soup = with_faces(soup, order);
  image.face_of.assign(order.begin(), order.end());
  for (const Points& half : {left, right}) {
    std::vector<Point_id> ids;
    for (const Exact_point& c : half) ids.push_back(image.scene.soup.add_point(c[0], c[1], c[2]));
    image.scene.soup.add_face(ids);
    image.face_of.push_back(chosen);
  }
  return image;
}

std::optional<Image> with_a_bystander(const Posed_scene& scene, Random& random) {
  using namespace generate;
  const std::size_t axis = random.below(3);
  Rational most = scene.eye[axis];
  for (const Exact_point& p : scene.source) most = std::max(most, p[axis]);
  for (Point_id p = 0; p < scene.soup.point_count(); ++p) most = std::max(most, scene.soup.point(p)[axis]);
  Image image{scene, same_faces(scene.soup)};
  Points face = any_face(random);
  const std::int64_t power = most_power(scene, random, 0);
  const Rational size = power_of_two(static_cast<int>(random.between(-power, power)));
  Exact_point away{0, 0, 0};
  if (power == 0 && scene.soup.face_count() <= few_faces && random.chance(1, 6)) {
    for (Rational& x : away) x = long_integer(random);
    away[axis] = abs(away[axis]);
    away[random.below(3)] += ratio(1, 2097143);  // a prime
  }
  std::vector<Point_id> ids;
  for (Exact_point& p : face) {
    p[axis] += 5;  // its coordinates are at least -4
    for (std::size_t k = 0; k < 3; ++k) p[k] = size * p[k] + away[k];
    p[axis] += most;
    ids.push_back(image.scene.soup.add_point(p[0], p[1], p[2]));
  }
  image.scene.soup.add_face(ids);
  image.face_of.push_back(std::nullopt);
  return image;
}

const std::vector<Law>& laws() {
  using enum Law_kind;
  static const std::vector<Law> all{
      {"begin", "loops begun elsewhere, with corners repeated and straight ones more", everywhere, begun_elsewhere},
      {"permute", "faces in another order", everywhere, permuted},
      {"translate", "moved by integers up to 10^8, of some small scenes times up to 2^1200", everywhere, translated},
      {"scale", "scaled by a power of two, 2^-60 to 2^60, or 2^-1200 to 2^1200 of some small scenes", everywhere,
       scaled},
      {"rotate", "turned by a rational rotation", planar_only, rotated},
      {"stretch", "each axis scaled by a power of two of its own, 2^-1200 to 2^1200, and sheared", planar_only,
       stretched},
      {"project", "by a projective map that keeps all before the horizon, one of up to 16 points in four", planar_only,
       projected},
      {"mirror", "mirrored, faces turned back", planar_only, mirrored},
      {"turn", "all faces turned round: fronts are backs", everywhere, turned},
      {"cut", "a convex face cut in two", everywhere, cut},
      {"bystander",
       "a face more, out of sight, of some small scenes 2^-1200 to 2^1200 times as large, or so far away, by a "
       "fraction, that coordinates have 52 to 57 bits",
       everywhere, with_a_bystander}};
  return all;
}

Answer pulled_back(const Image& image, const Answer& of_image, std::size_t faces) {
  Answer answer = of_image;
  answer.labels.assign(faces, 0);
  for (std::size_t k = 0; k < image.face_of.size(); ++k) {
    if (!image.face_of[k]) continue;
    std::uint32_t& label = answer.labels[*image.face_of[k]];
    std::uint32_t own = of_image.labels[k];
    if (own != Answer::none && image.sides_swapped && !answer.is_partition)
      own = (own & ~3u) | (own & 1) << 1 | (own & 2) >> 1;
    label = label == Answer::none || own == Answer::none ? Answer::none : answer.is_partition ? own : label | own;
  }
  return answer;
}

Check check_of(const Law& law, const std::function<Answer(const Posed_scene&)>& answer,
               const std::function<Answer(const Posed_scene&)>& verified) {
  return {law.name, law.what, [law, answer, verified](const Posed_scene& scene, const Answer& own, Random& random) {
            const bool verify = verified && random.chance(1, 4);
            if (law.kind == Law_kind::planar_only && !own.planar) return Outcome::not_applicable();
            if (own.is_partition && !own.whole) return Outcome::not_applicable();
            const std::optional<Image> image = law.apply(scene, random);
            if (!image) return Outcome::not_applicable();
            const Answer other = verify ? verified(image->scene) : answer(image->scene);
            if (!other.flaw.empty()) return Outcome::failed("after '" + law.name + "': " + other.flaw);
            return compared(own, pulled_back(*image, other, scene.soup.face_count()), "the scene",
                            "after '" + law.name + "'");
          }};
}

void add_laws(Subject& subject, const std::vector<std::string>& names) {
  for (const Law& law : laws())
    if (std::find(names.begin(), names.end(), law.name) != names.end())
      subject.checks.push_back(check_of(law, subject.answer, subject.verified));
}

}  // namespace sightline::harness
