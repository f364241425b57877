#include <sightline/harness/laws/along.h>

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/verify/along.h>
#include <sightline/algorithms/weak_visibility/along/along.h>
#include <sightline/algorithms/weak_visibility/along/along_scene.h>
#include <sightline/algorithms/weak_visibility/along/certificate.h>
#include <sightline/algorithms/weak_visibility/along/piece_cause.h>
#include <sightline/algorithms/weak_visibility/along/piece_run.h>
#include <sightline/algorithms/weak_visibility/along/piece_view.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/along_edges.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace moving_eye {

using generate::ratio;
using Faces = std::vector<Face_id>;

Faces seen_from(const Scene& scene, const Piece_boxes& boxes, const Exact_point& eye, bool two_sided) {
  const Exact_view view(scene, eye);
  Visible_options serial;
  serial.threads = 1;
  const auto surface = visible_surface(view, boxes, serial);
  if (!two_sided) return surface.visible;
  Faces both;
  std::set_union(surface.visible.begin(), surface.visible.end(), surface.from_behind.begin(), surface.from_behind.end(),
                 std::back_inserter(both));
  return both;
}

/// Where a path ends that begins at the eye: anywhere, at a corner, along an edge, in a face.
Exact_point end_of_path(const Posed_scene& posed, const Scene& scene, Random& random) {
  const auto corner = [&](std::size_t piece, std::size_t k) {
    const auto corners = scene.corners(scene.pieces()[piece]);
    return scene.position(corners[k % corners.size()].point);
  };
  const std::size_t piece = random.below(scene.pieces().size()), k = random.below(8);
  const Exact_point a = corner(piece, k), b = corner(piece, k + 1), c = corner(piece, k + 2);
  switch (random.below(6)) {
    case 0: return a;
    case 1: return generate::along(posed.eye, ratio(random.between(-9, 9), 2), minus(b, a));
    case 2: return generate::along(a, ratio(random.between(1, 4), 2), minus(a, posed.eye));
    case 3: return generate::along(generate::along(a, ratio(1, 3), minus(b, a)), ratio(1, 4), minus(c, a));
    case 4: {
      const Exact_point d = corner(random.below(scene.pieces().size()), k);
      return generate::along(a, ratio(random.between(1, 5), 2), minus(d, posed.eye));
    }
    default: {
      // As far away as that whatever the scene's size, but of many pieces, where numbers of thousands of digits would
      // take minutes.
      constexpr std::size_t few_pieces = 8;
      const Exact_point edge = minus(b, a);
      const Rational size = std::max({Rational(abs(edge[0])), Rational(abs(edge[1])), Rational(abs(edge[2]))}),
                     unit = scene.pieces().size() > few_pieces ? size : Rational(1);
      Exact_point p = a;
      for (Rational& x : p) x += unit * ratio(random.between(-40, 40), 7);
      return p;
    }
  }
}

std::string listed(const Faces& faces) {
  std::string list;
  for (const Face_id face : faces) list += (list.empty() ? "" : " ") + std::to_string(face);
  return list.empty() ? "none" : list;
}

std::string at(const Rational& t) { return "at t = " + to_string(t); }

/// What is seen at a moment, by an answer.
Faces seen_at(const Visible_along& along, const Quadratic_root& t) {
  Faces faces;
  for (const Visible_along::Face& face : along.faces) {
    const bool within = std::any_of(face.seen.begin(), face.seen.end(),
                                    [&](const Parameter_range& range) { return range.low < t && t < range.high; });
    const bool now =
        std::any_of(face.moments.begin(), face.moments.end(), [&](const Rational& m) { return moment(m) == t; });
    if (within || now) faces.push_back(face.face);
  }
  return faces;
}

/// What is wrong with the ranges in which a face is seen, and with the moments beside them: they are in order, and as
/// few as they can be. Where one range ends and the next begins the face is not seen.
std::string flaw_of_ranges(const Visible_along::Face& face) {
  const auto is_seen_alone = [&](const Quadratic_root& t) {
    return std::any_of(face.moments.begin(), face.moments.end(), [&](const Rational& m) { return moment(m) == t; });
  };
  for (std::size_t k = 0; k < face.seen.size(); ++k) {
    const auto& [low, high] = face.seen[k];
    if (!(low < high) || low < Quadratic_root(0) || Quadratic_root(1) < high) return "a range has no length";
    if (k > 0 && low < face.seen[k - 1].high) return "two ranges overlap";
    if (k > 0 && low == face.seen[k - 1].high && is_seen_alone(low)) return "two ranges are one";
  }
  for (std::size_t k = 0; k < face.moments.size(); ++k) {
    if (k > 0 && face.moments[k] <= face.moments[k - 1]) return "moments are in no order";
    const Quadratic_root t = moment(face.moments[k]);
    if (std::any_of(face.seen.begin(), face.seen.end(),
                    [&](const Parameter_range& range) { return range.low < t && t < range.high; }))
      return "a moment is in a range";
  }
  return "";
}

/// The same by events alone: what they change of what is seen at first.
Faces after_events(const Visible_along& along, const Quadratic_root& t) {
  Faces seen = along.at_start;
  for (const Along_event& event : along.events) {
    if (t < event.t) break;
    const bool is_now = event.t == t;
    for (const Along_event::Change& change : event.changes) {
      std::erase(seen, change.face);
      if (is_now ? change.at : change.after) seen.push_back(change.face);
    }
  }
  std::sort(seen.begin(), seen.end());
  return seen;
}

// ---- Causes

/// Three lines of a view: any, or such that one may hide that another one's edge is missed, as they share a point.
std::array<std::uint32_t, 3> any_lines(const Piece_view& view, Random& random) {
  const std::uint32_t count = view.line_count();
  std::array<std::uint32_t, 3> lines{};
  for (std::uint32_t& line : lines) line = static_cast<std::uint32_t>(random.below(count));
  if (random.chance(1, 2)) return lines;
  std::vector<std::uint32_t> near;
  for (std::uint32_t k = 0; k < count; ++k)
    if (k != lines[0] && sgn(side(view.line(lines[0]).line, view.line(k).line)) == 0) near.push_back(k);
  if (!near.empty()) lines[1] = near[random.below(near.size())];
  return lines;
}

/// What is wrong with a run at a moment at which something changes: it is not sure, or what it says is so at just that
/// moment, and at others of its range.
std::string flaw_of_run(const Piece_view& view, const Rational& t) {
  const Quadratic_root now = moment(t);
  if (view.side_of_eye(now) <= 0) return "";
  const Parameter_range at_once{now, now}, around{moment(Rational(t / 2)), moment(Rational((1 + t) / 2))};
  Piece_run run(view);
  const Piece_run::Answer within = run.run(now, around, view.left_in(around, view.all_blockers())),
                          just_then = run.run(now, at_once, view.left_in(at_once, view.all_blockers()));
  if (!just_then.sure) return "a run of one moment is not sure";
  if (!within.sure) return "";
  if (within.seen != just_then.seen) return "a run is sure of what is not so";
  for (unsigned long attempt = 0; attempt < 4; ++attempt) {
    const Quadratic_root other = moment(inner_rational(within.range, attempt));
    const Parameter_range there{other, other};
    if (view.side_of_eye(other) > 0 &&
        run.run(other, there, view.left_in(there, view.all_blockers())).seen != within.seen)
      return "a run is sure of a range in which it is not so";
  }
  return "";
}

/// What is wrong with the causes that are found where three lines of a piece's view look concurrent, as if what is seen
/// rested on them: edges are named of such as one ray meets, also where these lines go on beyond their own; and if one
/// meets three, some are.
std::string flaw_of_causes(const Scene& scene, const Occluders& occluders, const Exact_point& from,
                           const Exact_point& to, const std::vector<Rational>& moments, Random& random) {
  constexpr int tries = 12;
  const Along_scene along(occluders, from, to, [] {});
  const auto piece = static_cast<std::uint32_t>(random.below(scene.pieces().size()));
  if (along.polygons()[piece].corners.empty()) return "";  // the path is in its plane
  const Piece_view view(along, piece, random.chance(1, 4) ? -1 : 1);
  for (const Rational& t : moments)
    if (t > 0 && t < 1)
      if (const std::string flaw = flaw_of_run(view, t); !flaw.empty())
        return "of piece " + std::to_string(piece) + ' ' + at(t) + ": " + flaw;
  for (int k = 0; k < tries; ++k) {
    const std::array<std::uint32_t, 3> lines = any_lines(view, random);
    const Quadratic f = determinant(view.line(lines[0]), view.line(lines[1]), view.line(lines[2]));
    std::vector<Quadratic_root> roots;
    append_roots(f, {Quadratic_root(0), Quadratic_root(1)}, roots);
    for (const Quadratic_root& t : roots) {
      if (view.side_of_eye(t) <= 0) continue;
      const Along_cause cause = cause_of(view, t, std::span(&lines, 1));
      const auto is_missed = [&](std::size_t i) {
        const std::array<std::uint32_t, 2> pair{lines[i], lines[(i + 1) % 3]};
        if (std::max(pair[0], pair[1]) >= along.lines().size()) return false;  // of the piece's plane, without edges
        return meets_three(scene, from, to, t, piece, {along.edges(pair[0])[0], along.edges(pair[1])[0]});
      };
      if (cause.kind == Along_kind::triple && cause.edges.empty() && (is_missed(0) || is_missed(1) || is_missed(2)))
        return "of piece " + std::to_string(piece) + " by lines " + std::to_string(lines[0]) + ' ' +
               std::to_string(lines[1]) + ' ' + std::to_string(lines[2]) + " near t = " + std::to_string(t.near()) +
               " edges that one ray meets are not named";
      if (cause.edges.empty()) continue;  // no ray meets three
      const std::string flaw = flaw_of_change(
          scene, from, to, t, {scene.pieces()[piece].face, false, false, false, cause.kind, cause.edges});
      if (!flaw.empty())
        return "of piece " + std::to_string(piece) + " by lines " + std::to_string(lines[0]) + ' ' +
               std::to_string(lines[1]) + ' ' + std::to_string(lines[2]) + " near t = " + std::to_string(t.near()) +
               ", " + name(cause.kind) + ": " + flaw;
    }
  }
  return "";
}

// ---- The certificate

using Range = Along_certificate::Range;
using Proof = Along_certificate::Proof;

/// A moment, or what is between it and the next one.
bool holds(const Range& seen, const Range& place) {
  if (place.low != place.high) return seen.low <= place.low && place.high <= seen.high;
  return seen.low == seen.high ? seen.low == place.low : seen.low < place.low && place.low < seen.high;
}

/// What is left of a range without a place in it.
void append_rest(const Range& range, const Range& place, std::vector<Range>& rest) {
  if (range.low == range.high) return;
  for (const Range& part : {Range{range.low, place.low}, Range{place.high, range.high}})
    if (part.low < part.high) rest.push_back(part);
  if (place.low == place.high) return;
  for (const std::size_t k : {place.low, place.high})
    if (range.low < k && k < range.high) rest.push_back({k, k});
}

/// The certificate that says the contrary of a face at one place. Returns whether it is seen there.
bool turn(Along_certificate& certificate, Face_id face, const Range& place) {
  auto claims =
      std::find_if(certificate.faces.begin(), certificate.faces.end(), [&](const auto& of) { return of.face == face; });
  if (claims == certificate.faces.end()) claims = certificate.faces.insert(claims, {face, {}});
  std::vector<Range> seen;
  bool was_seen = false;
  for (const Range& range : claims->seen)
    if (holds(range, place)) {
      was_seen = true;
      append_rest(range, place, seen);
    } else {
      seen.push_back(range);
    }
  if (!was_seen) seen.push_back(place);
  claims->seen = std::move(seen);
  return was_seen;
}

/// Proofs beside the place go on there, and beyond a moment.
void prolong(Along_certificate& lie, Face_id face, const Range& place, bool was_seen) {
  const std::size_t last = lie.moments.size() - 1;
  const bool is_moment = place.low == place.high;
  const Range until{is_moment && place.low > 0 ? place.low - 1 : place.low,
                    is_moment ? std::min(place.high + 1, last) : place.high};
  for (Proof& proof : lie.proofs)
    if (lie.fragments[proof.fragment].face == face && proof.cone.empty() == was_seen && proof.range.low <= place.high &&
        proof.range.high >= place.low)
      proof.range = {std::min(proof.range.low, until.low), std::max(proof.range.high, until.high)};
}

/// Proofs are made up: each part is hidden by one other, or seen in a cone that is none, or in all of it.
void make_up(Along_certificate& lie, Face_id face, const Range& place, bool was_seen, Random& random) {
  const std::size_t by = random.below(lie.fragments.size());
  const bool flat = random.below(2) == 0;
  for (std::size_t k = 0; k < lie.fragments.size(); ++k) {
    if (lie.fragments[k].face != face) continue;
    Proof proof{k, false, place, {}, {}};
    if (was_seen) proof.tree.push_back({false, {}, by});
    else
      for (std::size_t corner = lie.fragments[k].vertices.size(); corner-- > 0;)
        proof.cone.push_back({Along_certificate::Side::Kind::edge, k, flat ? 0 : corner, 1});
    lie.proofs.push_back(std::move(proof));
  }
}

/// What is wrong with the certificate of a path: it is refused, or accepted with a claim that is not true.
std::string flaw_of_certificate(const Posed_scene& posed, const Scene& scene, const Along_certificate& certificate,
                                Random& random) {
  Verify_options serial;
  serial.threads = 1;
  if (const Verdict verdict = verify_along(posed.soup, certificate, serial); !verdict.accepted)
    return "its certificate is rejected: " + verdict.why;
  constexpr int lies = 4;
  for (int k = 0; k < lies; ++k) {
    // Anywhere, or where a claim begins.
    Face_id face = scene.pieces()[random.below(scene.pieces().size())].face;
    std::size_t low = random.below(certificate.moments.size()), high = low;
    if (k % 2 == 0 && low + 1 < certificate.moments.size()) ++high;
    if (k == 1 && !certificate.faces.empty()) {
      const Along_certificate::Face& claims = certificate.faces[random.below(certificate.faces.size())];
      face = claims.face;
      if (!claims.seen.empty()) low = high = claims.seen[random.below(claims.seen.size())].low;
    }
    const Range place{low, high};
    Along_certificate lie = certificate;
    const bool was_seen = turn(lie, face, place);
    if (k < 2) prolong(lie, face, place, was_seen);
    else make_up(lie, face, place, was_seen, random);
    if (verify_along(posed.soup, lie, serial).accepted)
      return "a certificate is accepted that says of " + face_name(face) + " that it is " +
             (was_seen ? "not seen" : "seen") + " at moments " + std::to_string(low) + " to " + std::to_string(high);
  }
  return "";
}

Outcome moved(const Posed_scene& posed, const Answer&, Random& random) {
  constexpr std::size_t most_pieces = 40;
  const Scene scene(posed.soup);
  if (scene.pieces().empty() || scene.pieces().size() > most_pieces) return Outcome::not_applicable();
  const Exact_point from = posed.eye, to = end_of_path(posed, scene, random);
  if (from == to) return Outcome::not_applicable();
  const Occluders occluders(scene);
  Along_options options;
  options.threads = 1;
  options.two_sided = random.below(4) == 0;
  const Visible_along found = visible_along(occluders, from, to, options);
  const std::string path = "from (" + to_string(from[0]) + " " + to_string(from[1]) + " " + to_string(from[2]) +
                           ") to (" + to_string(to[0]) + " " + to_string(to[1]) + " " + to_string(to[2]) + ")" +
                           (options.two_sided ? " two-sided" : "");

  for (const Visible_along::Face& face : found.faces)
    if (const std::string flaw = flaw_of_ranges(face); !flaw.empty())
      return Outcome::failed(path + " of " + face_name(face.face) + ' ' + flaw);

  // 1. Held to `see`: at the ends, at events, between them, anywhere.
  std::vector<Rational> moments{0, 1, ratio(random.between(1, 99), 100), ratio(random.between(1, 999), 1000)};
  std::vector<Quadratic_root> events{Quadratic_root(0)};
  for (const Along_event& event : found.events) events.push_back(event.t);
  events.emplace_back(1);
  for (std::size_t k = 0; k < events.size(); ++k) {
    if (const auto t = events[k].rational()) moments.push_back(*t);
    if (k > 0 && events[k - 1] < events[k]) moments.push_back(inner_rational({events[k - 1], events[k]}));
  }
  const Piece_boxes boxes(scene);
  for (const Rational& t : moments) {
    const Faces truth = seen_from(scene, boxes, generate::along(from, t, minus(to, from)), options.two_sided),
                said = seen_at(found, moment(t)), by_events = after_events(found, moment(t));
    if (said != truth)
      return Outcome::failed(at(t) + " " + path + " an eye sees " + listed(truth) + ", but on its way " + listed(said));
    if (by_events != truth)
      return Outcome::failed(at(t) + " " + path + " an eye sees " + listed(truth) + ", but by events " +
                             listed(by_events));
  }
  // 2. Why.
  constexpr std::size_t most_changes = 12;
  std::size_t changes = 0;
  for (const Along_event& event : found.events)
    for (const Along_event::Change& change : event.changes) {
      if (++changes > most_changes) break;
      if (const std::string flaw = flaw_of_change(scene, from, to, event.t, change); !flaw.empty())
        return Outcome::failed("near t = " + std::to_string(event.t.near()) + ' ' + path + " of " +
                               face_name(change.face) + ": " + flaw);
    }
  if (const std::string flaw = flaw_of_causes(scene, occluders, from, to, moments, random); !flaw.empty())
    return Outcome::failed(path + " a cause " + flaw);
  // 3. The way back.
  const Visible_along back = visible_along(occluders, to, from, options);
  bool same = back.events.size() == found.events.size() && back.visible == found.visible;
  for (std::size_t k = 0; k < found.events.size() && same; ++k) {
    const Along_event &one = found.events[k], &other = back.events[found.events.size() - 1 - k];
    same = one.changes.size() == other.changes.size();
    for (std::size_t i = 0; i < one.changes.size() && same; ++i) {
      const auto &a = one.changes[i], &b = other.changes[i];
      same = a.face == b.face && a.before == b.after && a.at == b.at && a.after == b.before;
    }
  }
  if (!same) return Outcome::failed(path + " other events are met than on the way back");
  // 4. The certificate.
  options.with_proofs = true;
  const Visible_along proved = visible_along(occluders, from, to, options);
  const Along_certificate certificate = along_certificate(scene, proved, from, to, options.two_sided);
  if (const std::string flaw = flaw_of_certificate(posed, scene, certificate, random); !flaw.empty())
    return Outcome::failed(path + " " + flaw);
  same = proved.events.size() == found.events.size();
  for (std::size_t k = 0; k < found.events.size() && same; ++k)
    same = proved.events[k].t == found.events[k].t && proved.events[k].changes.size() == found.events[k].changes.size();
  if (!same) return Outcome::failed(path + " other events are met where proofs are kept");
  return {};
}

}  // namespace moving_eye

Check moving_eye_check() {
  return {"moving", "the same faces from points of a path as along it, and on the way back; certified",
          moving_eye::moved};
}

}  // namespace sightline::harness
