#include <sightline/harness/judge/solids.h>

#include <sightline/algorithms/rays/tracer.h>
#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/algorithms/verify/solids.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/solid_oracle.h>
#include <sightline/io/exact_text.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

namespace sightline::judge {
namespace {

Set_result set_result_of(const Operands& operands, Set_operation operation) {
  Set_options options;
  options.operation = operation;
  options.keep_fragments = true;
  return set_operation(operands, options);
}

/// In squares of a unit, or doubles might not hold it.
double middle_area(const Polygon_soup& soup, const Rational& unit) {
  const auto [low, high] = area(generate::scaled(soup, 1 / unit));
  return (low + high) / 2;
}

/// About as long as the sides of a square as large as the largest face: in its squares doubles hold the area, however
/// large or thin the surface is. Pre: a face has area.
Rational unit_of_area(const Polygon_soup& soup) {
  Rational largest = 0;  // square of twice an area
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const Exact_point twice = doubled_area_vector(soup, f);
    largest = std::max(largest, dot(twice, twice));
  }
  return generate::power_of_two(static_cast<int>(binary_exponent(largest) / 4));
}

// ---- Points that are judged

/// The longest side of the scene's box.
Rational size_of(const Polygon_soup& soup) {
  Rational size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    Rational low = soup.point(0)[k], high = low;
    for (Point_id p = 0; p < soup.point_count(); ++p) {
      low = std::min(low, soup.point(p)[k]);
      high = std::max(high, soup.point(p)[k]);
    }
    size = std::max(size, Rational(high - low));
  }
  return size;
}

/// A point inside a fragment that no face holds but those that hold all of it: corners of others may touch it, and
/// beside such a point is not what is beside the fragment. The middle of its corners, or one at random.
Exact_point untouched_point(const Result_fragment& fragment, const Exact_point& normal, const Ray_tracer& tracer) {
  const auto is_of_fragment = [&](const Face_hit& hit) {
    return std::any_of(fragment.parts.begin(), fragment.parts.end(),
                       [&](const Result_fragment::Part& part) { return part.face == hit.face; });
  };
  generate::Random random(fragment.corners.size());
  Ray_counters counters;
  Exact_point on = generate::centroid(fragment.corners);
  for (;;) {
    const std::vector<Face_hit> held = tracer.first({on, normal}, Ray_start::closed, counters);
    if (std::all_of(held.begin(), held.end(), is_of_fragment)) return on;
    on = {0, 0, 0};
    long all = 0;
    for (const Exact_point& corner : fragment.corners) {
      const auto weight = static_cast<long>(random.between(1, 97));
      on = generate::along(on, weight, corner);
      all += weight;
    }
    for (Rational& x : on) x /= all;
  }
}

/// Two points on either side of each fragment, or of as many of them, evenly spread.
void add_points_of_fragments(const Polygon_soup& soup, const Ray_tracer& tracer, const Set_result& result,
                             Set_operation operation, std::vector<Judged_point>& points) {
  constexpr std::size_t most = 200;
  const std::size_t fragments = result.fragments.size(), taken = std::min(fragments, most);
  const Rational size = size_of(soup);
  Ray_counters counters;
  for (std::size_t i = 0; i < taken; ++i) {
    const Result_fragment& fragment = result.fragments[i * fragments / taken];
    const harness::Flat_face flat(fragment.corners);
    const Exact_point on = untouched_point(fragment, flat.normal, tracer);
    const bool dropped_inside = fragment.fate == Result_fragment::Fate::dropped &&
                                is_in_result(operation, Inside_rule::positive, fragment.front, 2);
    for (const int side : {1, -1}) {
      const auto inside_fate = side > 0 ? Result_fragment::Fate::turned : Result_fragment::Fate::kept;
      const bool inside = dropped_inside || fragment.fate == inside_fate;
      const Exact_point away = generate::along({0, 0, 0}, side, flat.normal);
      const std::vector<Face_hit> next = tracer.first({on, away}, Ray_start::open, counters);
      const Rational way =
          next.empty()
              ? Rational(size / std::max({Rational(abs(away[0])), Rational(abs(away[1])), Rational(abs(away[2]))}))
              : next.front().t;
      for (const long part : {2, 1 << 20})
        points.push_back({generate::along(on, way / part, away), on, fragment.parts.front().face, inside});
    }
  }
}

/// Points anywhere about the solids, by their winding numbers; each named by the face that a ray from it meets first.
void add_points_anywhere(const Polygon_soup& soup, const Ray_tracer& tracer, const Query& query,
                         std::span<const Polygon_soup, 2> solids, std::vector<Judged_point>& points) {
  constexpr int count = 16;
  const std::array<harness::Solid_oracle, 2> oracles{harness::Solid_oracle(solids[0]),
                                                     harness::Solid_oracle(solids[1])};
  generate::Random random(soup.face_count());
  Ray_counters counters;
  const auto corner = [&] { return soup.point(static_cast<Point_id>(random.below(soup.point_count()))); };
  for (int k = 0; k < count; ++k) {
    Exact_point at = corner();
    for (int step = 0; step < 3; ++step) {
      const Rational share = generate::ratio(random.between(-16, 80), 97);
      at = generate::along(at, share, minus(corner(), at));
    }
    if (oracles[0].is_on_a_face(at) || oracles[1].is_on_a_face(at)) continue;
    Windings windings;
    for (std::uint32_t operand = 0; operand < 2; ++operand)
      windings.push_back({operand, oracles[operand].winding(at, random)});
    const Exact_point towards = minus(corner(), at);
    const std::vector<Face_hit> met = tracer.first({at, towards}, Ray_start::open, counters);
    if (met.empty()) continue;  // a corner of faces without area
    points.push_back({at, generate::along(at, met[0].t, towards), met[0].face,
                      is_in_result(query.operation, Inside_rule::positive, windings, 2)});
  }
}

// ---- Closedness

using Directed_edge = std::pair<std::uint32_t, std::uint32_t>;

/// How often each edge is run along from its lower end to its higher one, less the other way; none that is 0.
class Edge_balance {
 public:
  void add(std::uint32_t from, std::uint32_t to, int times) {
    if (from == to) return;
    if (from > to) {
      std::swap(from, to);
      times = -times;
    }
    if ((edges_[{from, to}] += times) == 0) edges_.erase({from, to});
  }
  const std::map<Directed_edge, int>& edges() const { return edges_; }

 private:
  std::map<Directed_edge, int> edges_;
};

/// Edges without their opposites, cut at each other's ends: T-junctions are none. In words; empty: none.
std::string unmatched_edges(const Polygon_soup& soup) {
  std::map<Exact_point, std::uint32_t> ids;
  std::vector<Exact_point> places;
  Edge_balance whole;
  const auto id = [&](Point_id p) {
    const auto [entry, is_new] = ids.try_emplace(soup.point(p), static_cast<std::uint32_t>(ids.size()));
    if (is_new) places.push_back(entry->first);
    return entry->second;
  };
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
      const auto loop = soup.loop(f, k);
      for (std::size_t i = 0; i < loop.size(); ++i) whole.add(id(loop[i]), id(loop[(i + 1) % loop.size()]), 1);
    }
  std::set<std::uint32_t> ends;
  for (const auto& [edge, times] : whole.edges()) ends.insert({edge.first, edge.second});
  Edge_balance cut;
  for (const auto& [edge, times] : whole.edges()) {
    const Exact_point &p = places[edge.first], along = minus(places[edge.second], p);
    std::vector<std::pair<Rational, std::uint32_t>> on_it{{0, edge.first}, {dot(along, along), edge.second}};
    for (const std::uint32_t end : ends) {
      const Exact_point to = minus(places[end], p);
      if (!is_zero(cross(along, to))) continue;
      if (const Rational t = dot(along, to); t > 0 && t < on_it[1].first) on_it.emplace_back(t, end);
    }
    std::sort(on_it.begin(), on_it.end());
    for (std::size_t i = 1; i < on_it.size(); ++i) cut.add(on_it[i - 1].second, on_it[i].second, times);
  }
  if (cut.edges().empty()) return {};
  const auto [from, to] = cut.edges().begin()->first;
  const auto text = [&](std::uint32_t place) {
    const Exact_point& p = places[place];
    return "(" + to_string(p[0]) + ", " + to_string(p[1]) + ", " + to_string(p[2]) + ")";
  };
  return std::to_string(cut.edges().size()) + " edges without an opposite, one between " + text(from) + " and " +
         text(to);
}

}  // namespace

std::string flaw_of_solids(const Polygon_soup& soup, std::size_t first) {
  for (const Polygon_soup& solid : solids_of(soup, first)) {
    if (solid.face_count() == 0) return "a solid has no faces";
    const Operands alone(std::span(&solid, 1));
    if (!flaws(alone).empty()) return "a solid is not closed";
    for (const Result_fragment& fragment : set_result_of(alone, Set_operation::unite).fragments)
      if (fragment.fate != Result_fragment::Fate::kept || !fragment.front.empty() || fragment.parts.size() != 1)
        return "a solid winds otherwise than once round its inside";
  }
  return {};
}

Solid_truth solid_truth(const Polygon_soup& soup, const Query& query, int threads) {
  // 1. The result, proved.
  const std::array<Polygon_soup, 2> solids = solids_of(soup, query.first);
  const Operands operands(solids);
  const Set_result result = set_result_of(operands, query.operation);
  Set_options options;
  options.operation = query.operation;
  Verify_options verifying;
  verifying.threads = threads;
  const Hole_free flat = without_holes(result.soup);
  if (const Verdict verdict =
          verify_solids(solids, solid_certificate(operands, options, result), &flat.soup, verifying);
      !verdict.accepted)
    throw std::logic_error("the library's own answer is not accepted by its checker: " + verdict.why +
                           "; please report it");
  // 2. Points about it.
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  Solid_truth truth;
  add_points_of_fragments(soup, tracer, result, query.operation, truth.points);
  add_points_anywhere(soup, tracer, query, solids, truth.points);
  // 3. How large it is.
  const Polygon_soup& measured = result.soup.face_count() > 0 ? result.soup : soup;
  truth.unit = unit_of_area(measured);
  truth.volume = volume(result.soup);
  truth.area = middle_area(result.soup, truth.unit);
  truth.volume_scale = truth.volume != 0 ? truth.volume : Rational(volume(solids[0]) + volume(solids[1]));
  truth.area_scale = truth.volume != 0 ? truth.area : middle_area(soup, truth.unit);
  return truth;
}

Grade grade_solid(const Solid_truth& truth, const Answer& answer) {
  Grade grade;
  grade.judged = truth.points.size();
  if (!answer.surface) {
    grade.abstained.resize(grade.judged);
    std::iota(grade.abstained.begin(), grade.abstained.end(), Face_id{0});
    return grade;
  }
  // 1. A surface that has winding numbers.
  const Polygon_soup& surface = *answer.surface;
  const harness::Solid_oracle oracle(surface);
  if (!oracle.unusable().empty())
    throw std::invalid_argument("face " + std::to_string(oracle.unusable()[0]) + " crosses itself");
  if (const std::string open = unmatched_edges(surface); !open.empty())
    throw std::invalid_argument("the surface is not closed: " + open);
  // 2. The points.
  generate::Random random(truth.points.size());
  std::set<Face_id> shown, hidden;
  for (const Judged_point& point : truth.points) {
    std::optional<int> winding;
    if (!oracle.is_on_a_face(point.at)) winding = oracle.winding(point.at, random);
    if (winding == (point.inside ? 1 : 0)) continue;
    const Wrong_point& wrong =
        grade.wrong_points.emplace_back(Wrong_point{point.at, point.on, point.face, point.inside, winding});
    (wrong.is_held() ? shown : hidden).insert(wrong.face);
  }
  grade.wrong_visible.assign(shown.begin(), shown.end());
  grade.wrong_hidden.assign(hidden.begin(), hidden.end());
  // 3. Volume and area, of the same parts where a face is not planar; else its faces are summed as the truth's are.
  const Polygon_soup parts = oracle.has_bent_faces() ? oracle.parts() : surface;
  grade.volume_error = nearest_double((volume(parts) - truth.volume) / truth.volume_scale);
  grade.area_error = (middle_area(parts, truth.unit) - truth.area) / truth.area_scale;
  return grade;
}

}  // namespace sightline::judge
