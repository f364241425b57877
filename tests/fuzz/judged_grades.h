#pragma once
// Grades: an answer is wrong exactly where it was made so, and what each contract says of that.

#include "judged_questions.h"

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/harness/judge/grade.h>
#include <sightline/harness/judge/rays.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/harness/judge/truth.h>
#include <sightline/harness/laws/trace.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>
#include <sightline/sightline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace fuzz::judged_laws {

inline void try_grade_of_faces(Random& random) {
  const bool is_weak = random.chance(1, 4);
  const std::optional<Asked> asked = any_asked(is_weak ? Question::weak : Question::see, random);
  if (!asked) return;
  const Truth& truth = asked->truth;
  const Query& query = asked->made.query;
  // 1. The truth is what the library says.
  Asking asking;
  asking.threads = 1;
  asking.two_sided = query.two_sided;
  const Model model(asked->made.soup);
  std::set<Face_id> visible, hidden, known(asked->owners.begin(), asked->owners.end());
  if (is_weak) {
    const Weak_visibility all = weakly_visible(model, std::vector<Points>{query.source}, asking);
    visible.insert(all.visible.begin(), all.visible.end());
    hidden.insert(all.hidden.begin(), all.hidden.end());
  } else {
    const Seen seen = see(model, query.eye, asking);
    visible.insert(seen.visible.begin(), seen.visible.end());
    if (query.two_sided) visible.insert(seen.from_behind.begin(), seen.from_behind.end());
    for (const Face_id f : known)
      if (visible.count(f) == 0) hidden.insert(f);
  }
  const auto is_of = [](const Face_ids& some, const std::set<Face_id>& all) {
    return std::all_of(some.begin(), some.end(), [&](Face_id f) { return all.count(f) > 0; });
  };
  require(is_of(truth.visible, visible), "what is visible in truth the library sees");
  require(is_of(truth.hidden, hidden), "what is hidden in truth the library does not see");
  const std::size_t decided = truth.visible.size() + truth.hidden.size(), all = visible.size() + hidden.size();
  require(decided == all || (is_weak && 2 * decided >= all), "what the library decides is known, but for a few faces");
  // 2. An answer is wrong where it was made so.
  const Flipped answered = flipped(truth.visible, truth.hidden, asked->faces(), true, random);
  const Grade grade = judge::grade(truth, answered.answer);
  require(grade.wrong_visible == answered.shown, "a face is wrongly visible iff it is shown and hidden");
  require(grade.wrong_hidden == answered.left_out, "a face is wrongly hidden iff it is left out and visible");
  require(grade.abstained == answered.abstained, "a face is left open iff the answer says so and it is known");
  require(grade.judged == truth.visible.size() + truth.hidden.size(), "faces are judged of which something is known");
  const bool is_wrong = !answered.shown.empty() || !answered.left_out.empty();
  require(judge::mark_of(grade) == (is_wrong                     ? Mark::wrong
                                    : answered.abstained.empty() ? Mark::right
                                                                 : Mark::abstained),
          "a mark says whether anything is wrong, or left open");
}

/// Where rays that only touch faces are excused: what they touch before they meet something may be named, and nothing
/// too where they touch alone.
inline void try_excused_rays(Random& random) {
  const std::optional<Asked> asked = any_asked(Question::trace, random);
  if (!asked) return;
  judge::Truth_options options = asked->options;
  options.excuse_touching = true;
  const Polygon_soup& soup = asked->made.soup;
  const Truth truth = judge::truth_of(soup, asked->made.query, options);
  if (!asked->scene.set_aside().empty()) return;
  for (std::size_t r = 0; r < truth.rays.size(); ++r) {
    const Exact_ray& ray = asked->made.query.rays[r];
    std::set<Face_id> right;
    std::optional<Rational> end;  // of the first depth where a face is met inside
    for (const Face_hit& hit : harness::hits_by_definition(soup, asked->scene, ray, Ray_start::open)) {
      if (end && hit.t > *end) break;
      right.insert(hit.face);
      if (hit.side != Met_side::along && !is_on_border(soup, hit.face, point_at(ray, hit.t))) end = hit.t;
    }
    require(truth.rays[r].nothing == !end, "nothing is right iff a ray touches faces only");
    require(truth.rays[r].right == Face_ids(right.begin(), right.end()), "what a ray touches before may be named");
  }
}

inline void try_truth_without_time(Random& random) {
  const std::optional<Asked> asked = any_asked(Question::weak, random);
  if (!asked) return;
  judge::Truth_options options = asked->options;
  options.seconds = -1;
  const Truth truth = judge::truth_of(asked->made.soup, asked->made.query, options);
  require(truth.visible.empty() && truth.hidden.empty(), "without time nothing is decided");
  require(names(truth.not_asked, "budget"), "what is not decided at all is not asked");
}

/// A face of one piece as a part that is all of it, from any corner on and either way round; returns it smaller by
/// 2^-20, as it is judged, or nothing where corners are straight.
inline std::optional<Flat_face> drawn_as_part(const Flat_face& face, judge::Drawn_face& drawn, Random& random) {
  const std::size_t count = face.corners.size();
  Exact_point middle;
  for (std::size_t i = 0; i < count; ++i) {
    const Exact_point &p = face.corners[i], &q = face.corners[(i + 1) % count], &r = face.corners[(i + 2) % count];
    if (cross(minus(q, p), minus(r, q)) == Exact_point{}) return std::nullopt;
    for (std::size_t k = 0; k < 3; ++k) middle[k] += p[k] / static_cast<long>(count);
  }
  Points smaller = drawn.part = face.corners;
  std::rotate(drawn.part.begin(), drawn.part.begin() + static_cast<std::ptrdiff_t>(random.below(count)),
              drawn.part.end());
  if (random.chance(1, 2)) std::reverse(drawn.part.begin(), drawn.part.end());
  for (Exact_point& p : smaller)
    for (std::size_t k = 0; k < 3; ++k) p[k] += (middle[k] - p[k]) / (1 << 20);
  return Flat_face(std::move(smaller));
}

inline void try_grade_of_an_order(Random& random) {
  std::optional<Asked> asked = any_asked(Question::order, random);
  if (!asked) return;
  const Query& query = asked->made.query;
  const Any_order order(*asked, random);
  judge::Answer answer = order.answer();
  std::set<Face_id> nearer, farther, open;
  for (const Face_id f : order.left_out) {
    if (random.chance(1, 3)) open.insert(f);
    else if (asked->counts_from(query.eye, f, query.two_sided)) nearer.insert(f);
  }
  answer.abstained.assign(open.begin(), open.end());
  if (random.chance(1, 2))  // some in parts, which count as a little smaller
    for (judge::Drawn_face& drawn : answer.order) {
      const auto owner = std::find(asked->owners.begin(), asked->owners.end(), drawn.face);
      if (random.chance(1, 3) || std::count(owner, asked->owners.end(), drawn.face) != 1) continue;
      Flat_face& piece = asked->pieces[static_cast<std::size_t>(owner - asked->owners.begin())];
      if (std::optional<Flat_face> smaller = drawn_as_part(piece, drawn, random)) piece = std::move(*smaller);
    }
  const Grade grade = judge::grade(asked->truth, answer);
  const std::vector<std::array<Face_id, 2>> pairs = wrong_pairs_by_force(*asked, order.faces);
  require(grade.wrong_pairs == pairs, "pairs are in the wrong order iff some direction shows them so");
  for (const auto& [a, b] : pairs) {
    nearer.insert(a);
    farther.insert(b);
  }
  require(grade.wrong_hidden == Face_ids(nearer.begin(), nearer.end()),
          "wrongly hidden are those that are drawn too early, or missing");
  require(grade.wrong_visible == Face_ids(farther.begin(), farther.end()),
          "wrongly visible are those that are drawn too late");
}

inline void try_part_beside_its_plane(Random& random) {
  const std::optional<Asked> asked = any_asked(Question::order, random);
  if (!asked) return;
  judge::Answer answer = Any_order(*asked, random).answer();
  if (answer.order.empty()) return;
  // 1. A face of one piece, drawn as a part that is all of it.
  judge::Drawn_face& drawn = answer.order[random.below(answer.order.size())];
  const auto owner = std::find(asked->owners.begin(), asked->owners.end(), drawn.face);
  if (std::count(owner, asked->owners.end(), drawn.face) != 1) return;
  const Flat_face& face = asked->pieces[static_cast<std::size_t>(owner - asked->owners.begin())];
  drawn.part = face.corners;
  const Grade on = judge::grade(asked->truth, answer);
  // 2. The same with a corner beside the plane.
  std::size_t axis = 0;
  Rational size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (abs(face.normal[axis]) < abs(face.normal[k])) axis = k;
    for (const Exact_point& p : face.corners)
      for (const Exact_point& q : face.corners) size = std::max(size, Rational(p[k] - q[k]));
  }
  const Rational most = size / (1 << 20) * (random.chance(1, 2) ? 1 : -1);
  const std::array<Rational, 3> shares{Rational(7, 8), 1, Rational(9, 8)};
  const Rational share = shares[random.below(shares.size())];
  drawn.part[random.below(drawn.part.size())][axis] += most * share;
  const Grade beside = judge::grade(asked->truth, answer);
  require(beside.wrong_pairs == on.wrong_pairs && beside.wrong_hidden == on.wrong_hidden,
          "a part stands for what it is on its face's plane");
  Face_ids shown = on.wrong_visible;
  if (share > 1 && !holds(shown, drawn.face)) {
    shown.push_back(drawn.face);
    std::sort(shown.begin(), shown.end());
  }
  require(beside.wrong_visible == shown, "a part is wrong iff it is beside its plane by more than 2^-20 of the face");
}

inline void try_contracts(Random& random) {
  Grade grade;
  if (random.chance(1, 2)) grade.wrong_visible = {static_cast<Face_id>(random.below(3))};
  if (random.chance(1, 2)) grade.wrong_hidden = {static_cast<Face_id>(random.below(3))};
  if (random.chance(1, 2)) grade.abstained = {4};
  const std::array<double, 4> errors{0, Grade::largest_error / 2, Grade::largest_error, Grade::largest_error * 2};
  const auto any_error = [&] { return (random.chance(1, 2) ? 1 : -1) * errors[random.below(4)]; };
  if (random.chance(1, 2)) grade.volume_error = any_error();
  if (random.chance(1, 2)) grade.area_error = any_error();
  const bool more = !grade.wrong_visible.empty() || grade.volume_error > Grade::largest_error,
             less = !grade.wrong_hidden.empty() ||
                    grade.volume_error<-Grade::largest_error, other = std::fabs(grade.area_error)> Grade::largest_error;
  const Mark mark = judge::mark_of(grade);
  require(mark == (more || less || other     ? Mark::wrong
                   : grade.abstained.empty() ? Mark::right
                                             : Mark::abstained),
          "a mark is wrong where anything is, and abstained where something is open");
  for (const auto& [contract, is_kept] :
       {std::pair(Contract::exact, !more && !less && !other), std::pair(Contract::conservative, !less),
        std::pair(Contract::aggressive, !more)}) {
    require(judge::keeps(contract, grade) == is_kept, "a contract is kept iff nothing is wrong that it forbids");
    require(judge::breaks(contract, mark, grade) == !is_kept, "a contract that is not kept is broken");
    for (const Mark by_itself : {Mark::crashed, Mark::invalid})
      require(judge::breaks(contract, by_itself, {}), "a crash and an invalid answer break any contract");
    for (const Mark limit : {Mark::out_of_memory, Mark::timed_out})
      require(!judge::breaks(contract, limit, {}), "limits of the judge's break no contract");
  }
}

/// A surface with bent faces has the volume of the triangles that a scene makes of them, wherever loops begin.
inline void try_grade_of_bent_faces(Random& random) {
  const generate::Faces first = generate::box({0, 0, 0}, {4, 4, 4}), second = generate::box({9, 0, 0}, {12, 3, 3});
  const generate::Solid_pair solids{generate::soup_of(first), generate::soup_of(second)};
  Query query;
  query.question = Question::boolean;
  query.operation = Set_operation::unite;
  query.first = first.size();
  const judge::Solid_truth truth = judge::solid_truth(generate::joined(solids), query, 1);
  // 1. The answer: a corner moved outwards, loops begun anywhere.
  const Exact_point from{4, 4, 4},
      to{generate::integer(random, 4, 6), generate::integer(random, 4, 6), generate::integer(random, 4, 6)};
  generate::Faces faces = first;
  generate::add(faces, second);
  for (generate::Points& face : faces) {
    std::replace(face.begin(), face.end(), from, to);
    std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random.below(face.size())), face.end());
  }
  judge::Answer answer;
  answer.surface = generate::soup_of(faces);
  // 2. Its volume, by the scene's own triangles.
  const Scene scene(*answer.surface);
  Rational six_times;
  for (const Piece& piece : scene.pieces()) {
    const auto corners = scene.corners(piece);
    const Exact_point p = scene.position(corners[0].point);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      six_times += dot(p, cross(scene.position(corners[k].point), scene.position(corners[k + 1].point)));
  }
  const Grade grade = judge::grade_solid(truth, answer);
  require(grade.volume_error == nearest_double(Rational((six_times / 6 - (64 + 27)) / (64 + 27))),
          "a bent face counts as the triangles that it is in a scene");
}

/// What is drawn of a face that is none changes no grade.
inline void try_part_of_no_face(Random& random) {
  const std::optional<Asked> asked = any_asked(Question::order, random);
  if (!asked) return;
  Polygon_soup soup = asked->made.soup;
  const auto none = static_cast<Face_id>(soup.face_count());
  const Exact_point p = generate::lattice(random, 4);
  Exact_point q = p, r = p;
  q[0] += 1;
  r[0] += 2;
  soup.add_face(generate::added(soup, {p, q, r}));  // on a line
  const Truth truth = judge::truth_of(soup, asked->made.query, asked->options);
  if (!truth.not_asked.empty()) return;
  judge::Answer answer = Any_order(*asked, random).answer();
  const Grade without = judge::grade(truth, answer);
  answer.order.push_back(
      {none, {generate::lattice(random, 4), generate::lattice(random, 4), generate::lattice(random, 4)}});
  const Grade with = judge::grade(truth, answer);
  require(with.wrong_pairs == without.wrong_pairs && with.wrong_visible == without.wrong_visible &&
              with.wrong_hidden == without.wrong_hidden && with.judged == without.judged,
          "a part of what is no face changes no grade");
}

/// Rays of which one has no direction, or none at all, are not asked about.
inline void try_truth_without_rays(Random& random) {
  const std::optional<Asked> asked = any_asked(Question::trace, random);
  if (!asked) return;
  Query query = asked->made.query;
  const bool has_none = random.chance(1, 4);
  if (has_none) query.rays.clear();
  else
    query.rays.insert(query.rays.begin() + static_cast<std::ptrdiff_t>(random.below(query.rays.size() + 1)),
                      Exact_ray{query.eye, {0, 0, 0}});
  const Truth truth = judge::truth_of(asked->made.soup, query, asked->options);
  require(names(truth.not_asked, has_none ? "no ray" : "no direction") && truth.rays.empty(),
          "rays without a direction are not asked about");
}

/// A ray that goes down on a face of any shape touches it iff it meets one of its edges.
inline void try_touched_borders(Random& random) {
  const auto number = [&] { return Rational(static_cast<long>(random.between(0, 4))); };
  generate::Points loop;
  for (std::size_t k = 3 + random.below(5); k > 0; --k) {
    Exact_point p{number(), number(), 0};
    while ((!loop.empty() && (p == loop.back())) || (k == 1 && p == loop.front())) p = {number(), number(), 0};
    loop.push_back(std::move(p));
  }
  const Polygon_soup soup = generate::soup_of({loop});
  const Exact_point at{number() / 2, number() / 2, 0};
  Face_hit hit{};
  hit.face = 0;
  hit.t = 1;
  hit.side = Met_side::front;
  require(judge::touches(soup, {{at[0], at[1], 1}, {0, 0, -1}}, hit) == is_on_border(soup, 0, at),
          "a hit is a touch iff it is on an edge");
}

}  // namespace fuzz::judged_laws
