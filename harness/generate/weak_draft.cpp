#include <sightline/harness/generate/weak_draft.h>

#include <cstdint>
#include <set>

namespace sightline::generate::weak_drafts {

Draft shaft(const Rational& height) {
  return {{reversed(rectangle(-1, 1, -1, 1, height))}, rectangle(-1, 1, -1, 1, 0), std::nullopt};
}

Points shrunk(const Points& face, const Rational& gap) {
  const Exact_point middle = centroid(face);
  Points points;
  for (const Exact_point& p : face) points.push_back(along(p, gap, minus(middle, p)));
  return points;
}

void shrink_one(Faces& faces, std::size_t first, const Rational& gap, Random& random) {
  Points& face = faces[first + random.below(faces.size() - first)];
  face = shrunk(face, gap);
}

Points plate(const Exact_point& on, const Exact_point& u, const Exact_point& w) {
  const Exact_point a = along(on, -1, u), b = along(on, 1, u);
  return {a, b, along(b, 1, w), along(a, 1, w)};
}

Exact_point level_direction(Random& random) {
  Exact_point u = at(0, 0, 0);
  while (is_zero(u)) u = {integer(random, -2, 2), integer(random, -2, 2), 0};
  return u;
}

Rational share(Random& random) {
  const std::int64_t whole = random.between(2, 5), part = random.between(1, whole - 1);
  return ratio(part, whole);
}

std::vector<Rational> subdivided(const Rational& low, const Rational& high, std::size_t inner, Random& random) {
  std::set<Rational> cuts{low, high};
  while (cuts.size() < inner + 2) cuts.insert(Rational(low + (high - low) * ratio(random.between(1, 11), 12)));
  return {cuts.begin(), cuts.end()};
}

}  // namespace sightline::generate::weak_drafts
