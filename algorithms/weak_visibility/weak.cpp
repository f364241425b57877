#include <sightline/algorithms/weak_visibility/weak.h>

#include <sightline/algorithms/weak_visibility/search/line_search.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/threads.h>

#include <atomic>
#include <stdexcept>
#include <utility>

namespace sightline {

Weak_source weak_source(const Occluders& occluders, const std::vector<Exact_point>& points) {
  const auto minus = [](const Exact_point& a, const Exact_point& b) {
    return Exact_point{Rational(a[0] - b[0]), Rational(a[1] - b[1]), Rational(a[2] - b[2])};
  };
  const auto cross = [](const Exact_point& a, const Exact_point& b) {
    return Exact_point{Rational(a[1] * b[2] - a[2] * b[1]), Rational(a[2] * b[0] - a[0] * b[2]),
                       Rational(a[0] * b[1] - a[1] * b[0])};
  };
  const auto dot = [](const Exact_point& a, const Exact_point& b) {
    return Rational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
  };
  const auto is_zero = [](const Exact_point& a) { return sgn(a[0]) == 0 && sgn(a[1]) == 0 && sgn(a[2]) == 0; };
  std::vector<Exact_point> corners;
  for (const Exact_point& p : points)
    if (corners.empty() || corners.back() != p) corners.push_back(p);
  while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
  if (corners.size() < 3)
    throw std::invalid_argument(
        "a source has fewer than three points; give the corners of a convex polygon, counterclockwise as seen from the "
        "side it looks to");
  // Newell's normal; then each corner turns left around it, and all turn around once.
  Exact_point normal{0, 0, 0};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Exact_point part = cross(minus(corners[i], corners[0]), minus(corners[i + 1], corners[0]));
    for (std::size_t k = 0; k < 3; ++k) normal[k] += part[k];
  }
  if (is_zero(normal))
    throw std::invalid_argument(
        "a source has no area; give the corners of a convex polygon, counterclockwise as seen from the side it looks "
        "to");
  for (const Exact_point& p : corners)
    if (sgn(dot(normal, minus(p, corners[0]))) != 0)
      throw std::invalid_argument("a source is not planar; cut it into triangles and give each of them");
  const char* const not_convex = "a source is not convex; cut it into convex polygons and give each of them";
  std::vector<Exact_point> strict;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Exact_point &before = corners[(i + corners.size() - 1) % corners.size()],
                      &after = corners[(i + 1) % corners.size()];
    const Exact_point in = minus(corners[i], before), out = minus(after, corners[i]);
    const int turn = sgn(dot(normal, cross(in, out)));
    if (turn < 0 || (turn == 0 && sgn(dot(in, out)) < 0)) throw std::invalid_argument(not_convex);
    if (turn > 0) strict.push_back(corners[i]);
  }
  for (std::size_t i = 0; i < strict.size();
       ++i)  // a star turns left everywhere too, but has corners outside its edges
    for (const Exact_point& p : strict)
      if (sgn(dot(normal, cross(minus(strict[(i + 1) % strict.size()], strict[i]), minus(p, strict[i])))) < 0)
        throw std::invalid_argument(not_convex);

  Weak_source source;
  for (const Exact_point& p : strict) {
    const Located_point at = occluders.scene().locate(p);
    source.polygon.push_back(near_point(occluders.frame(), {at.x, at.y, at.z, at.w}));
  }
  const auto &a = source.polygon[0].exact, &b = source.polygon[1].exact, &c = source.polygon[2].exact;
  const auto minor = [&](std::size_t i, std::size_t j, std::size_t k) {  // of the rows a, b, c
    return Integer(a[i] * (b[j] * c[k] - b[k] * c[j]) - a[j] * (b[i] * c[k] - b[k] * c[i]) +
                   a[k] * (b[i] * c[j] - b[j] * c[i]));
  };
  source.plane = near_plane(occluders.frame(),
                            {minor(1, 2, 3), Integer(-minor(0, 2, 3)), minor(0, 1, 3), Integer(-minor(0, 1, 2))});
  return source;
}

std::vector<std::uint32_t> first_pieces(const std::vector<Piece>& pieces) {
  std::vector<std::uint32_t> first;
  for (std::uint32_t i = 0; i < pieces.size(); ++i)
    if (i == 0 || pieces[i].face != pieces[i - 1].face) first.push_back(i);
  return first;
}

void for_each_face(const std::vector<Piece>& pieces, const std::vector<std::uint32_t>& first, int threads,
                   const std::function<void(std::size_t, std::size_t)>& progress,
                   const std::function<void(std::size_t f, std::uint32_t begin, std::uint32_t end)>& decide) {
  std::atomic<std::size_t> done = 0;
  run_with_threads(threads, [&] {
    parallel_for(first.size(), [&](std::size_t f) {
      decide(f, first[f], f + 1 < first.size() ? first[f + 1] : static_cast<std::uint32_t>(pieces.size()));
      if (progress) progress(++done, first.size());
    });
  });
}

Weakly_visible weakly_visible(const Occluders& occluders, const std::vector<Weak_source>& sources,
                              const Weak_options& options) {
  struct Result {
    Weak_status status = Weak_status::hidden;
    std::vector<Weakly_visible::Pair> pairs;
    Weak_counters counters;
  };
  const std::vector<Piece>& pieces = occluders.scene().pieces();
  const std::vector<std::uint32_t> first = first_pieces(pieces);
  std::vector<Result> results(first.size());
  const auto decide = [&](std::size_t f, std::uint32_t begin, std::uint32_t end) {
    Result& result = results[f];
    for (std::uint32_t piece = begin; piece < end && result.status != Weak_status::visible; ++piece)
      for (std::uint32_t s = 0; s < sources.size(); ++s) {
        Weak_answer answer = Line_search(occluders, sources[s].polygon, sources[s].plane, occluders.polygon(piece),
                                         piece, options.search)
                                 .run(result.counters);
        if (answer.status == Weak_status::visible) {
          result.status = Weak_status::visible;
          result.pairs.clear();
        } else if (answer.status == Weak_status::undecided) {
          result.status = Weak_status::undecided;
        }
        result.pairs.push_back({piece, s, std::move(answer)});
        if (result.status == Weak_status::visible) break;
      }
  };
  for_each_face(pieces, first, options.threads, options.progress, decide);

  Weakly_visible all;
  for (std::size_t f = 0; f < first.size(); ++f) {
    Result& result = results[f];
    all.of(result.status).push_back(pieces[first[f]].face);
    all.counters += result.counters;
    for (Weakly_visible::Pair& pair : result.pairs) {
      if (result.status != Weak_status::undecided) all.pairs.push_back(std::move(pair));
      else if (pair.answer.status == Weak_status::undecided) all.open.push_back(std::move(pair));
    }
  }
  return all;
}

}  // namespace sightline
