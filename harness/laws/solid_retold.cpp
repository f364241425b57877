#include <sightline/harness/laws/solid_retold.h>

#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/verify/solids.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/solids.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace sightline::harness {

using generate::Points;
using generate::Random;

namespace {

/// A surface, each face the points of its loops.
using Face_loops = std::vector<Points>;
using Surface_loops = std::vector<Face_loops>;

Surface_loops told(const Polygon_soup& soup) {
  Surface_loops faces(soup.face_count());
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
      Points& loop = faces[f].emplace_back();
      for (const Point_id p : soup.loop(f, k)) loop.push_back(soup.point(p));
    }
  return faces;
}

/// The soup of it, on points in common or each face on its own.
Polygon_soup soup_of(const Surface_loops& faces, bool is_shared) {
  Polygon_soup soup;
  std::map<Exact_point, Point_id> known;
  for (const Face_loops& face : faces) {
    if (!is_shared) known.clear();
    for (const Points& loop : face) {
      std::vector<Point_id> ids;
      for (const Exact_point& p : loop) {
        const auto [at, is_new] = known.emplace(p, 0);
        if (is_new) at->second = soup.add_point(p[0], p[1], p[2]);
        ids.push_back(at->second);
      }
      if (&loop == &face[0]) soup.add_face(ids);
      else soup.add_hole(ids);
    }
  }
  return soup;
}

/// An axis along which a point of a face leaves its plane. Pre: it has area.
std::size_t axis_off(const Points& loop) {
  const Exact_point normal = Flat_face(loop).normal;
  return normal[0] != 0 ? 0 : normal[1] != 0 ? 1 : 2;
}

/// A face that has a hole; none: the number of faces.
std::size_t any_with_hole(const Surface_loops& faces, Random& random) {
  std::vector<std::size_t> found;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (faces[f].size() > 1) found.push_back(f);
  return found.empty() ? faces.size() : found[random.below(found.size())];
}

/// Cuts a triangle in two, from a corner to the middle of the edge across.
void cut_triangle(Surface_loops& faces, std::size_t f) {
  if (faces[f].size() != 1 || faces[f][0].size() != 3) return;
  const Points loop = faces[f][0];
  const Exact_point m = generate::centroid({loop[1], loop[2]});
  faces[f][0] = {loop[0], loop[1], m};
  faces.push_back({{loop[0], m, loop[2]}});
}

/// Tells the same surface otherwise.
void retell(Surface_loops& faces, Random& random) {
  if (random.chance(1, 2)) random.shuffle(faces);
  for (std::size_t f = 0, all = faces.size(); f < all; ++f) {
    for (Points& loop : faces[f]) {
      std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(random.below(loop.size())), loop.end());
      if (&loop != &faces[f][0] && random.chance(1, 2)) std::reverse(loop.begin(), loop.end());
      if (random.chance(1, 8)) loop.push_back(generate::centroid({loop.back(), loop.front()}));
    }
    if (random.chance(1, 8)) cut_triangle(faces, f);
  }
}

/// Makes another surface of it, and says how; empty where that does not apply.
std::string forge(Surface_loops& faces, const std::vector<Result_fragment>& fragments, Random& random) {
  const auto is_dropped = [](const Result_fragment& one) { return one.fate == Result_fragment::Fate::dropped; };
  const std::size_t way = random.below(9);
  if (way == 0) {
    const auto at = std::find_if(fragments.begin(), fragments.end(), is_dropped);
    if (at == fragments.end()) return {};
    faces.push_back({at->corners});
    return "a face that is dropped";
  }
  if (faces.empty()) return {};
  const std::size_t f = random.below(faces.size());
  Points& outer = faces[f][0];
  const std::size_t i = random.below(outer.size()), n = outer.size();
  switch (way) {
    case 1: faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(f)); return "a face left out";
    case 2: faces.push_back(Face_loops(faces[f])); return "a face twice";
    case 3:
      for (Points& loop : faces[f]) std::reverse(loop.begin(), loop.end());
      return "a face turned round";
    case 4: {  // everywhere: what it leaves no longer has its area, and nothing comes there
      const Exact_point from = outer[i];
      Exact_point to = from;
      to[axis_off(outer)] += Rational(1, 1024);
      for (Face_loops& face : faces)
        for (Points& loop : face) std::replace(loop.begin(), loop.end(), from, to);
      return "a corner elsewhere";
    }
    case 5: {
      const std::size_t g = any_with_hole(faces, random);
      if (g == faces.size()) return {};
      faces[g].pop_back();
      return "a hole left out";
    }
    case 6: {  // p q r s becomes p r q s, which adds two triangles to its boundary
      const Exact_point p = outer[i], q = outer[(i + 1) % n], r = outer[(i + 2) % n], s = outer[(i + 3) % n];
      if (n < 4 || p == s || is_zero(cross(minus(q, p), minus(r, q))) || is_zero(cross(minus(r, q), minus(s, r))))
        return {};
      std::swap(outer[(i + 1) % n], outer[(i + 2) % n]);
      return "corners exchanged";
    }
    case 7: {
      const Points once = outer;
      outer.insert(outer.end(), once.begin(), once.end());
      return "a loop that goes round twice";
    }
    default: {  // its area is in another plane
      Points leaf = outer;
      for (Exact_point& p : leaf) p[axis_off(outer)] += 1;
      faces.push_back({Points(leaf.rbegin(), leaf.rend())});
      faces.push_back({leaf});
      return "a leaf of two faces";
    }
  }
}

}  // namespace

std::string flaw_of_told_result(const std::vector<Polygon_soup>& solids, Random& random) {
  const Set_options options = drawn_operation(random);
  const Operands operands(solids);
  const Set_result result = set_operation(operands, options);
  const Solid_certificate claim = solid_certificate(operands, options, result);
  const auto verdict_on = [&](const Surface_loops& faces, bool is_shared) {
    const Polygon_soup soup = soup_of(faces, is_shared);
    return verify_solids(solids, claim, &soup, {1, {}});
  };

  const Surface_loops right = told(result.soup);
  constexpr int tellings = 3;
  for (int k = 0; k < tellings; ++k) {
    Surface_loops faces = right;
    if (k > 0) retell(faces, random);
    if (const Verdict verdict = verdict_on(faces, k != 1); !verdict.accepted)
      return "a right result is rejected: " + verdict.why;
  }
  for (int k = 0; k < tellings; ++k) {
    Surface_loops faces = right;
    const std::string how = forge(faces, result.fragments, random);
    if (!how.empty() && verdict_on(faces, true).accepted) return "a wrong result is accepted: " + how;
  }
  return {};
}

}  // namespace sightline::harness
