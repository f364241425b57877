#include <sightline/harness/laws/weak_answers.h>

#include <sightline/algorithms/verify/verdict.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/conservative.h>
#include <sightline/algorithms/weak_visibility/events/events.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/labels.h>
#include <sightline/harness/laws/weak_flats.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace sightline::harness {
namespace weak_answers {
namespace {

using generate::Points;
using weak_flats::Level;

/// A search or events with more than these would take minutes.
constexpr std::size_t most_cells = 3000, most_events = 20000;

Answer labels_of(const Polygon_soup& soup, const Weak_faces& found) {
  Answer answer;
  answer.labels.assign(soup.face_count(), Answer::none);
  label_weakly_seen(found, answer);
  return answer;
}

// ---- Conservative

/// Whether all segments from one convex polygon to another meet a third: its plane is between them, and no corner's
/// segment passes one of its edges outside. By definition: the side of an edge is linear in each end.
bool hides_all(const Points& piece, const Points& source, const Points& target) {
  const Level level = weak_flats::level_of(piece);
  const int front = weak_flats::position(level, source);
  if (front == 0 || front == 2 || weak_flats::position(level, target) != -front) return false;
  for (std::size_t i = 0; i < piece.size(); ++i)
    for (const Exact_point& p : source) {
      const Exact_point beyond = cross(minus(piece[i], p), minus(piece[(i + 1) % piece.size()], p));
      for (const Exact_point& q : target)
        if (front * sgn(dot(beyond, minus(q, p))) > 0) return false;
    }
  return true;
}

/// Whether what two convex polygons have in front of each other is nothing, or is hidden by one piece of some: from
/// each side of the target's plane that counts.
bool is_hidden_by_one(const std::vector<Points>& pieces, const Points& source, const Points& piece, bool two_sided) {
  const Level plane = weak_flats::level_of(piece);
  const Points target = weak_flats::clipped(piece, weak_flats::level_of(source));
  if (target.empty()) return true;
  for (const Level& side : {plane, plane.turned()}) {
    const Points from = weak_flats::clipped(source, side);
    if (!from.empty() &&
        std::none_of(pieces.begin(), pieces.end(), [&](const Points& other) { return hides_all(other, from, target); }))
      return false;
    if (!two_sided) break;
  }
  return true;
}

/// The convex hull of points of a plane, counterclockwise, without straight corners; empty where it has no inside.
Points hull_of(const Points& points, const Exact_point& normal) {
  const auto left_of = [&](const Exact_point& a, const Exact_point& b, const Exact_point& c) {
    return sgn(dot(cross(minus(b, a), minus(c, a)), normal));
  };
  Points hull{*std::min_element(points.begin(), points.end())};
  do {  // to the outermost point as seen from the last one, the farthest of these
    const Exact_point at = hull.back();
    Exact_point next = at;
    for (const Exact_point& p : points) {
      const int left = next == at ? -1 : left_of(at, next, p);
      const Exact_point step = minus(p, at);
      if (p != at && (left < 0 || (left == 0 && dot(step, step) > dot(minus(next, at), minus(next, at))))) next = p;
    }
    hull.push_back(next);
  } while (hull.back() != hull.front() && hull.size() <= points.size() + 1);
  hull.pop_back();
  return hull.size() < 3 || weak_flats::level_of(hull).normal == Exact_point{0, 0, 0} ? Points{} : hull;
}

/// Just what hides a piece from a source, between them; or a corner of that is a little off.
Points lid_between(const Points& source, const Points& piece, Random& random) {
  Level level = weak_flats::level_of(piece);
  Rational nearest;
  for (const Exact_point& p : source)
    if (const Rational height = level.height(p); &p == &source.front() || height < nearest) nearest = height;
  if (nearest <= 0) return {};
  level.offset += nearest / static_cast<long>(random.between(2, 4));
  Points met;
  for (const Exact_point& p : source)
    for (const Exact_point& q : piece) {
      const Rational from = level.height(p), to = level.height(q);
      met.push_back(generate::along(p, Rational(from / (from - to)), minus(q, p)));
    }
  Points lid = hull_of(met, level.normal);
  if (lid.size() >= 3 && random.chance(2, 3)) {  // towards another corner, or away from it
    Rational step = generate::power_of_two(-static_cast<int>(random.between(20, 60)));
    if (random.chance(1, 3)) step = -step;
    lid[0] = generate::along(lid[0], step, minus(lid[lid.size() / 2], lid[0]));
  }
  return lid;
}

Outcome conservatively(const Posed_scene& posed, const Answer& answer, Random& random) {
  constexpr std::size_t faces_tried = 6;
  const bool two_sided = random.chance(1, 4), lidded = random.chance(1, 2);
  // 1. The scene, or one piece more that hides one of it, or all but.
  Polygon_soup soup = posed.soup;
  std::optional<Face_id> below;
  if (lidded) {
    const Scene bare(soup);
    const std::vector<Points> targets = weak_flats::polygons(bare);
    if (targets.empty()) return Outcome::not_applicable();
    const std::size_t target = random.below(targets.size());
    const Points lid = lid_between(posed.source, targets[target], random);
    if (lid.empty()) return Outcome::not_applicable();
    below = bare.pieces()[target].face;
    soup.add_face(generate::added(soup, lid));
  }
  const Scene scene(soup);
  const Occluders occluders(scene);
  const std::vector<Points> pieces = weak_flats::polygons(scene);
  Conservative_options options;
  options.threads = 1;
  options.two_sided = two_sided;
  const Weakly_visible found = possibly_visible(occluders, {weak_source(occluders, posed.source)}, options);
  // 2. Its proofs.
  const Verdict verdict = verify_weak(soup, weak_certificate(scene, {posed.source}, two_sided, found));
  if (!verdict.accepted) return Outcome::failed("the certificate is rejected: " + verdict.why);
  if (!found.undecided.empty()) return Outcome::failed("something is undecided");
  // 3. All that is visible.
  for (const Face_id face : found.hidden)
    if (!lidded && answer.labels[face] == 1) return Outcome::failed(face_name(face) + " is visible, but not possibly");
  // 4. What one piece hides is hidden, and nothing else.
  const Answer own = labels_of(soup, found);
  for (std::size_t k = 0; k < faces_tried && !pieces.empty(); ++k) {
    const Face_id face = below && k == 0 ? *below : scene.pieces()[random.below(pieces.size())].face;
    bool hidden = true;
    for (std::size_t i = 0; i < pieces.size() && hidden; ++i)
      hidden = scene.pieces()[i].face != face || is_hidden_by_one(pieces, posed.source, pieces[i], two_sided);
    if (own.labels[face] != (hidden ? 0 : 1))
      return Outcome::failed(face_name(face) + (hidden ? " is hidden by one piece or looks away, but counts as visible"
                                                       : " counts as hidden, but no one piece hides it"));
  }
  return {};
}

// ---- Settled by events

Outcome settled(const Posed_scene& posed, const Answer& answer, Random& random) {
  constexpr std::size_t most_pieces = 12;
  const Scene scene(posed.soup);
  if (scene.pieces().size() > most_pieces) return Outcome::not_applicable();
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, posed.source)};
  // 1. A search that leaves much open, some of it in parts.
  Weak_options options;
  options.threads = 1;
  options.search.rays = 0;
  options.search.cells = 1 + random.below(16);
  Weakly_visible found = weakly_visible(occluders, sources, options);
  if (found.open.empty()) return Outcome::not_applicable();
  // 2. Often a thorough search, of as few cells; and events, often of fewer edges than are near all of source and
  // target.
  if (random.chance(1, 2)) search_thoroughly(occluders, sources, options, found);
  std::size_t edges = 0;
  for (const Weakly_visible::Pair& pair : found.open)
    edges = std::max(edges, edges_between(occluders, sources[0], pair.piece));
  Events_options events;
  events.threads = 1;
  events.events = most_events;
  events.rays = 0;
  settle_by_events(occluders, sources, edges - std::min<std::size_t>(edges, random.below(8)), events, found);
  // 3. The same as otherwise, and proved where it says so.
  const Verdict verdict = verify_weak(posed.soup, weak_certificate(scene, {posed.source}, false, found));
  if (!verdict.accepted) return Outcome::failed("the certificate is rejected: " + verdict.why);
  return compared(answer, labels_of(posed.soup, found), "the search", "a short search and events");
}

// ---- A piece along a segment

/// That lines and events say the same of a face.
Outcome agreed(const Posed_scene& posed, Face_id goal) {
  const Scene scene(posed.soup);
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, posed.source)};
  Weak_options options;
  options.threads = 1;
  options.search.cells = most_cells;
  options.faces = {goal};
  Answer lines = labels_of(posed.soup, weakly_visible(occluders, sources, options)), by_events = lines;
  by_events.labels[goal] = 0;
  Event_counters counters;
  Events_options events;
  events.threads = 1;
  events.events = most_events;
  events.rays = 0;
  for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
    if (scene.pieces()[piece].face != goal) continue;
    const Events_answer found = weakly_visible_by_events(occluders, sources[0], piece, events, counters);
    if (found.status == Weak_status::undecided) return Outcome::undecided();
    if (found.status == Weak_status::visible) by_events.labels[goal] = 1;
  }
  return compared(lines, by_events, "lines", "events");
}

/// A channel between two lids, each of two faces, and a face along its diagonal, which is across source and target and
/// alone keeps all lines from passing.
Outcome through_a_channel(Random& random) {
  const auto number = [&](std::int64_t least, std::int64_t most) { return generate::integer(random, least, most); };
  const Rational width = number(1, 3), low = number(4, 6), high = Rational(low + number(1, 3)), top = number(12, 16);
  Posed_scene channel;
  channel.source = generate::rectangle(-20, 20, -2, 2, 0);
  generate::Faces faces{generate::reversed(generate::rectangle(-20, 20, -2, 2, top))};
  for (const Rational& height : {low, high}) {
    faces.push_back(generate::rectangle(-90, 0, -9, 9, height));
    faces.push_back(generate::rectangle(width, 90, -9, 9, height));
  }
  Points diagonal{generate::at(0, -9, low), generate::at(width, -9, high), generate::at(width, 9, high),
                  generate::at(0, 9, low)};
  faces.push_back(generate::either_way(diagonal, random));
  channel.soup = generate::soup_of(faces);
  const Outcome outcome = agreed(channel, 0);
  if (outcome.state == Outcome::State::undecided)
    return Outcome::failed("events leave a channel of six faces undecided");
  return outcome;
}

Outcome with_a_piece_along(const Posed_scene& posed, const Answer&, Random& random) {
  constexpr std::size_t most_pieces = 8;
  if (random.chance(1, 8)) return through_a_channel(random);
  // A triangle or a quadrilateral about a point of a segment from the source to a piece, in a plane of that segment.
  Posed_scene more = posed;
  std::optional<Face_id> goal;
  {
    const Scene scene(posed.soup);
    const std::vector<Points> pieces = weak_flats::polygons(scene);
    if (pieces.empty() || pieces.size() > most_pieces) return Outcome::not_applicable();
    const std::size_t chosen = random.below(pieces.size());
    goal = scene.pieces()[chosen].face;
    const Exact_point p = weak_flats::inner_point(posed.source, random),
                      q = weak_flats::inner_point(pieces[chosen], random), way = minus(q, p);
    const Points& beside = random.chance(1, 2) ? posed.source : pieces[chosen];
    const Exact_point across = minus(beside[random.below(beside.size())], p);
    if (cross(way, across) == Exact_point{0, 0, 0}) return Outcome::not_applicable();
    const auto eighth = [&](std::int64_t least, std::int64_t most) {
      return Rational(generate::integer(random, least, most) / 8);
    };
    const auto corner = [&](const Rational& t, const Rational& u) {
      return generate::along(generate::along(p, t, way), u, across);
    };
    const Rational begin = eighth(1, 4), end = eighth(5, 7), left = eighth(1, 16), right = eighth(1, 16);
    Points piece{corner(begin, -left), corner(end, -left), corner(end, right)};
    if (random.chance(1, 2)) piece.push_back(corner(begin, right));
    more.soup.add_face(generate::added(more.soup, piece));
  }
  return agreed(more, *goal);
}

}  // namespace
}  // namespace weak_answers

Check conservative_check() {
  return {"conservative", "what one piece hides, by brute force, and nothing that is visible",
          weak_answers::conservatively, 4};
}

Check settle_check() {
  return {"settle", "the same by events in what a short search leaves open", weak_answers::settled, 3};
}

Check along_check() {
  return {"along", "lines and events agree about one more piece that lies along a segment",
          weak_answers::with_a_piece_along, 4};
}

}  // namespace sightline::harness
