#pragma once
// Explanations: the line that refutes an answer does so, by rationals, and the share of the view is what is wrong.

#include "judged_grades.h"
#include "judged_questions.h"
#include "measured_flat.h"

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/judge/explain.h>
#include <sightline/harness/judge/grade.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/harness/judge/truth.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/trace.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/vectors.h>
#include <sightline/sightline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace fuzz::judged_laws {

/// A convex polygon's share of all directions from an eye that is not in its plane.
inline double share_of_directions(const Points& corners, const Exact_point& eye) {
  Points cone;
  for (const Exact_point& p : corners) cone.push_back(minus(p, eye));
  return measuring::angles_of(cone) / (4 * std::acos(-1.0));
}

inline bool are_near(double a, double b) {
  return std::fabs(a - b) <= 1e-6 * std::max(std::fabs(a), std::fabs(b)) + 1e-9;
}

/// The first number of a line that has a percentage, or the one after some words.
inline double percentage_after(const std::string& words, const std::string& before) {
  const std::size_t at = words.find(before);
  require(at != std::string::npos && names(words.substr(at), " %"), "a share is told in percent");
  return std::strtod(words.c_str() + at + before.size(), nullptr) / 100;
}

inline void require_told(const Explanation& why) {
  require(0 <= why.share && why.share <= 1, "a share is between nothing and all");
  require(std::fabs(percentage_after(why.share_words, "") - why.share) <= 1e-3 * why.share, "a share is told as it is");
}

inline bool is_forbidden(Contract contract, bool is_missing) {
  return contract == Contract::exact || (contract == Contract::conservative) == is_missing;
}

/// Whether what is told of is a missing face, not a shown one, where each contract wants those that it forbids first.
inline bool is_missing_first(Contract contract, const Grade& grade) {
  return contract == Contract::aggressive ? grade.wrong_visible.empty() : !grade.wrong_hidden.empty();
}

/// A line to a hidden face is blocked by what it meets first, or needs nothing that blocks it.
inline void require_blocked(const Asked& asked, const Refutation& line, const Points& lookers) {
  require(asked.is_on(line.face, line.to, false), "a line ends on the face that it is about");
  if (!line.by) {
    const bool is_behind = names(line.words, "behind"), is_along = names(line.words, "plane");
    require(is_behind || is_along, "a face that nothing hides is seen from behind or along its plane");
    const auto is_so = [&](const Exact_point& p) {
      const Rational h = asked.height(line.face, p);
      return (is_along && h == 0) || (is_behind && h < 0);
    };
    require(!is_behind || is_along || !asked.made.query.two_sided, "faces that count from behind are not hidden so");
    if (lookers.size() == 1) require(is_so(lookers[0]), "who looks is behind a face or in its plane");
    return;
  }
  require(line.at && asked.is_on(*line.by, *line.at, false), "what hides a face is where it is told to be");
  const Exact_point way = minus(line.to, line.from), part = minus(*line.at, line.from);
  require(is_zero(cross(way, part)) && dot(way, part) > 0 && dot(way, part) < dot(way, way),
          "what hides a face is on the way to it");
  const std::optional<Rational> first = asked.first_between(line.from, line.to);
  require(first && *first * dot(way, way) == dot(way, part), "what hides a face is met first");
}

inline bool has_common_planes(const Asked& asked) {
  for (std::size_t a = 0; a < asked.pieces.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (asked.owners[a] != asked.owners[b] &&
          std::all_of(asked.pieces[b].corners.begin(), asked.pieces[b].corners.end(),
                      [&](const Exact_point& p) { return asked.pieces[a].height(p) == 0; }))
        return true;
  return false;
}

inline Contract any_contract(Random& random) { return static_cast<Contract>(random.below(3)); }

/// A wrong answer to see or weak, and why it is wrong: by a face that the contract forbids, a missing one or a shown
/// one.
struct Wrong_faces {
  Asked asked;
  Grade grade;
  Explanation why;
  bool is_missing;
};
inline std::optional<Wrong_faces> any_wrong_faces(Question question, Random& random) {
  std::optional<Asked> asked = any_asked(question, random);
  if (!asked) return std::nullopt;
  const judge::Answer answer = flipped(asked->truth.visible, asked->truth.hidden, asked->faces(), true, random).answer;
  const Grade grade = judge::grade(asked->truth, answer);
  if (!grade.wrong()) return std::nullopt;
  const Contract contract = any_contract(random);
  const Explanation why = judge::explain(asked->made.soup, asked->made.query, answer, grade, contract);
  const bool is_missing = is_missing_first(contract, grade);
  require(why.refutation.has_value(), "a line tells of a face that is seen or not");
  require(holds(is_missing ? grade.wrong_hidden : grade.wrong_visible, why.refutation->face),
          "a face is told of that the contract forbids, if there is one");
  return Wrong_faces{std::move(*asked), grade, why, is_missing};
}

inline void try_why_not_seen(Random& random) {
  const std::optional<Wrong_faces> wrong_faces = any_wrong_faces(Question::see, random);
  if (!wrong_faces) return;
  const auto& [asked, grade, why, is_missing] = *wrong_faces;
  const Query& query = asked.made.query;
  const Refutation& line = *why.refutation;
  require(line.from == query.eye, "a line begins at the eye");
  if (is_missing) {
    require(!line.by && asked.is_on(line.face, line.to, true), "a missing face is seen inside of itself");
    require(asked.counts_from(query.eye, line.face, query.two_sided), "a missing face is seen from where it counts");
    require(!asked.first_between(line.from, line.to), "a missing face is seen along a free line");
  } else {
    require_blocked(asked, line, {query.eye});
  }
  // How much is wrong.
  require_told(why);
  if (!grade.wrong_visible.empty()) {
    double shown = 0;
    bool is_front = true;
    for (std::size_t k = 0; k < asked.pieces.size(); ++k)
      if (holds(grade.wrong_visible, asked.owners[k])) {
        const int side = sgn(asked.pieces[k].height(query.eye));
        is_front = is_front && (side >= 0 || query.two_sided);
        is_front = is_front && !(side == 0 && asked.is_on(asked.owners[k], query.eye, false));
        if (side != 0) shown += share_of_directions(asked.pieces[k].corners, query.eye);
      }
    const double told = percentage_after(why.share_words, "would fill ");
    if (is_front)
      require(std::fabs(told - shown) <= 1e-3 * shown + 1e-9, "hidden faces fill what they would by themselves");
  }
  if (has_common_planes(asked)) return;
  Asking asking;
  asking.threads = 1;
  double missing = 0, largest = 0, told = 0;
  for (const Seen::Visible_part& part : see(Model(asked.made.soup), query.eye, asking).parts) {
    if (!holds(grade.wrong_hidden, part.face) || (!part.from_front && !query.two_sided)) continue;
    const double share = share_of_directions(part.corners, query.eye);
    missing += share;
    largest = std::max(largest, share);
    const Flat_face flat(part.corners);
    if (is_missing && flat.height(line.to) == 0 && flat.side_within(line.to) > 0) told = share;
  }
  require(are_near(why.share, missing), "missing faces fill what is seen of them");
  require(!is_missing || are_near(told, largest), "a line ends in the largest part that is seen and missing");
}

inline void try_why_not_weakly_visible(Random& random) {
  const std::optional<Wrong_faces> wrong_faces = any_wrong_faces(Question::weak, random);
  if (!wrong_faces) return;
  const auto& [asked, grade, why, is_missing] = *wrong_faces;
  const Query& query = asked.made.query;
  const Refutation& line = *why.refutation;
  const Flat_face source(query.source);
  require(source.height(line.from) == 0 && source.side_within(line.from) > 0, "a line begins inside the source");
  if (is_missing) {
    require(!line.by && asked.is_on(line.face, line.to, true), "a missing face is seen inside of itself");
    require(source.height(line.to) > 0 && asked.counts_from(line.from, line.face, query.two_sided),
            "a missing face is seen from where it counts");
    require(!asked.first_between(line.from, line.to), "a missing face is seen along a free line");
  } else {
    require_blocked(asked, line, query.source);
  }
  require_told(why);
  double wrong = 0, all = 0;
  Rational largest = 0;
  for (const Flat_face& piece : asked.pieces)
    for (const Rational& x : piece.normal) largest = std::max(largest, Rational(abs(x)));
  for (std::size_t k = 0; k < asked.pieces.size(); ++k) {
    const Exact_point& normal = asked.pieces[k].normal;
    const Face_id face = asked.owners[k];
    const double area = std::sqrt(Rational(dot(normal, normal) / (largest * largest)).get_d());
    if (holds(grade.wrong_visible, face) || holds(grade.wrong_hidden, face)) wrong += area;
    if (!holds(grade.abstained, face) && (holds(asked.truth.visible, face) || holds(asked.truth.hidden, face)))
      all += area;
  }
  const std::set<Face_id> kept(asked.owners.begin(), asked.owners.end());
  if (kept.size() == asked.truth.visible.size() + asked.truth.hidden.size())
    require(are_near(why.share, wrong / all), "a share is of areas that are answered for");
}

/// The share of all directions in which one face is nearer than another. Pre: the eye is in front of both.
inline double share_of_overlap(const Exact_point& eye, const Flat_face& a, const Flat_face& b) {
  Points left = a.corners;
  const auto cut = [&](const Exact_point& wall) {  // what is in front of a plane through the eye
    Points kept;
    for (std::size_t k = 0; k < left.size(); ++k) {
      const Exact_point &p = left[k], &q = left[(k + 1) % left.size()];
      const Rational from = dot(wall, minus(p, eye)), to = dot(wall, minus(q, eye));
      if (from >= 0) kept.push_back(p);
      if (sgn(from) * sgn(to) < 0) kept.push_back(generate::along(p, Rational(from / (from - to)), minus(q, p)));
    }
    left = kept;
  };
  for (std::size_t k = 0; k < b.corners.size(); ++k)
    cut(cross(minus(b.corners[(k + 1) % b.corners.size()], eye), minus(b.corners[k], eye)));
  // Nearer: a's plane is met before b's.
  const Rational of_a = a.height(eye), of_b = b.height(eye);
  Exact_point nearer;
  for (std::size_t k = 0; k < 3; ++k) nearer[k] = of_a * b.normal[k] - of_b * a.normal[k];
  cut(nearer);
  return left.size() < 3 ? 0 : share_of_directions(left, eye);
}

inline void try_why_not_in_order(Random& random) {
  const std::optional<Asked> asked = any_asked(Question::order, random);
  if (!asked) return;
  const Query& query = asked->made.query;
  const judge::Answer answer = Any_order(*asked, random).answer();
  const Grade grade = judge::grade(asked->truth, answer);
  if (!grade.wrong()) return;
  const Explanation why = judge::explain(asked->made.soup, query, answer, grade, any_contract(random));
  require(why.refutation.has_value(), "a line tells of whole faces in the wrong order");
  const Refutation& line = *why.refutation;
  require(line.from == query.eye, "a line begins at the eye");
  require(line.over || !grade.wrong_hidden.empty(), "a face is told of that is missing");
  const auto towards = [&](const Flat_face& piece) {
    return piece.height(query.eye) < 0 ? Flat_face(generate::reversed(piece.corners)) : piece;
  };
  const auto pierced = [&](Face_id face) {
    std::optional<Rational> first;
    for (std::size_t k = 0; k < asked->pieces.size(); ++k) {
      if (asked->owners[k] != face) continue;
      const std::optional<Rational> t =
          harness::pierced_at(towards(asked->pieces[k]), query.eye, minus(line.to, query.eye));
      if (t && (!first || *t < *first)) first = t;
    }
    return first;
  };
  if (line.over) {
    const std::array<Face_id, 2> pair{line.face, *line.over};
    require(std::find(grade.wrong_pairs.begin(), grade.wrong_pairs.end(), pair) != grade.wrong_pairs.end(),
            "a pair is told of that is in the wrong order");
    const std::optional<Rational> near = pierced(pair[0]), far = pierced(pair[1]);
    require(near && far && *near < *far, "what is drawn over is nearer on the line");
    require(*near == 1, "a line ends on the face that is nearer");
  } else {
    require(
        holds(grade.wrong_hidden, line.face) && asked->is_on(line.face, line.to, true) && names(line.words, "missing"),
        "a missing face is told of where it is");
    require(grade.wrong_pairs.empty(), "pairs are told of before faces that are missing");
  }
  double share = 0;
  for (const auto& [nearer, farther] : grade.wrong_pairs)
    for (std::size_t a = 0; a < asked->pieces.size(); ++a)
      for (std::size_t b = 0; b < asked->pieces.size(); ++b)
        if (asked->owners[a] == nearer && asked->owners[b] == farther)
          share += share_of_overlap(query.eye, towards(asked->pieces[a]), towards(asked->pieces[b]));
  if (share <= 1) require_told(why);
  require(are_near(why.share, share), "a share is of the directions that pairs have in the wrong order");
}

inline void try_why_not_met(Random& random) {
  const std::optional<Asked> asked = any_asked(Question::trace, random);
  if (!asked) return;
  const Query& query = asked->made.query;
  judge::Answer answer;
  std::vector<Hits> all, first;
  std::set<std::size_t> wrong;
  const std::uint64_t rare = random.chance(1, 2) ? 2 : 20;
  for (Face_id ray = 0; ray < query.rays.size(); ++ray) {
    all.push_back(harness::hits_by_definition(asked->made.soup, asked->scene, query.rays[ray], Ray_start::open));
    first.push_back(only_first(all.back()));
    std::optional<Face_id>& said = answer.first.emplace_back();
    if (random.chance(1, 8)) {
      answer.abstained.push_back(ray);
      continue;
    }
    if (random.chance(1, rare)) {
      if (random.chance(2, 3)) said = asked->owners[random.below(asked->owners.size())];
    } else if (!first[ray].empty()) {
      said = first[ray][random.below(first[ray].size())].face;
    }
    const auto is_said = [&](const Face_hit& hit) { return hit.face == said; };
    if (said ? std::none_of(first[ray].begin(), first[ray].end(), is_said) : !first[ray].empty()) wrong.insert(ray);
  }
  // 1. The grade.
  const Grade grade = judge::grade(asked->truth, answer);
  std::set<Face_id> shown;
  bool is_some_missed = false;
  for (const std::size_t ray : wrong) {
    if (answer.first[ray]) shown.insert(*answer.first[ray]);
    is_some_missed = is_some_missed || !first[ray].empty();
  }
  require(grade.wrong_visible == Face_ids(shown.begin(), shown.end()), "a face is shown that is not met first");
  require(grade.wrong_hidden.empty() != is_some_missed, "a face is hidden where one is met first and not named");
  require(grade.judged == query.rays.size() && grade.abstained == answer.abstained, "all rays are judged");
  require(grade.wrong_rays.size() == wrong.size(), "rays are wrong that meet something else first");
  if (wrong.empty()) return;
  // 2. The ray that is told of.
  const Contract contract = any_contract(random);
  const Explanation why = judge::explain(asked->made.soup, query, answer, grade, contract);
  require(why.refutation.has_value(), "a ray tells of itself");
  const Refutation& line = *why.refutation;
  const auto told =
      static_cast<std::size_t>(std::strtoull(line.words.c_str() + std::string("ray ").size(), nullptr, 10));
  require(wrong.count(told) > 0, "a ray is told of that is answered wrongly");
  const Exact_ray& ray = query.rays[told];
  require(line.from == ray.origin, "a line begins where the ray does");
  const bool is_missed = !first[told].empty();
  if (contract == Contract::aggressive && !shown.empty())
    require(answer.first[told].has_value(), "a ray is told of whose face is wrong, if such rays are forbidden");
  if (contract != Contract::aggressive && is_some_missed)
    require(is_missed, "a ray is told of whose face is missed, if such rays are forbidden");
  const Exact_point way = minus(line.to, line.from);
  require(is_zero(cross(way, ray.direction)) && dot(way, ray.direction) > 0, "a line is along the ray");
  const bool is_named_met = std::any_of(all[told].begin(), all[told].end(),
                                        [&](const Face_hit& hit) { return hit.face == answer.first[told]; });
  if (answer.first[told] && !is_named_met)
    for (Point_id p = 0; p < asked->made.soup.point_count(); ++p)
      require(dot(minus(asked->made.soup.point(p), line.to), ray.direction) <= 0,
              "what is never met is beyond all points");
  if (is_missed) {
    const auto is_face = [&](Face_id face) {
      return std::any_of(first[told].begin(), first[told].end(), [&](const Face_hit& hit) { return hit.face == face; });
    };
    const Exact_point at = point_at(ray, first[told][0].t);
    require(line.by ? is_face(*line.by) : is_face(line.face), "what a ray meets first is named");
    require(line.at ? *line.at == at : line.to == at, "what a ray meets first is where it is told to be");
    if (line.by) require(line.face == *answer.first[told], "what was named is told of");
    const Face_id named = line.by ? *line.by : line.face;
    const Met_side side = std::find_if(first[told].begin(), first[told].end(), [&](const Face_hit& hit) {
                            return hit.face == named;
                          })->side;
    require(names(line.words, " along itself") == (side == Met_side::along),
            "a face that is met along itself is told to be");
    require(
        names(line.words, ", on its border") == (side != Met_side::along && is_on_border(asked->made.soup, named, at)),
        "a border is told of iff a face is met there");
  } else {
    require(!line.by && names(line.words, "meets nothing") && line.face == *answer.first[told],
            "a ray that meets nothing is told to");
  }
  // 3. How much is wrong.
  require_told(why);
  require(are_near(why.share, static_cast<double>(wrong.size()) /
                                  static_cast<double>(query.rays.size() - answer.abstained.size())),
          "a share is of the rays that are answered for");
}

inline void try_why_not_in_order_of_parts(Random& random) {
  const std::optional<Asked> asked = any_asked(Question::order, random);
  if (!asked) return;
  judge::Answer answer = Any_order(*asked, random).answer();
  std::set<Face_id> in_parts;
  for (judge::Drawn_face& drawn : answer.order) {
    const auto owner = std::find(asked->owners.begin(), asked->owners.end(), drawn.face);
    if (random.chance(1, 2) || std::count(owner, asked->owners.end(), drawn.face) != 1) continue;
    if (drawn_as_part(asked->pieces[static_cast<std::size_t>(owner - asked->owners.begin())], drawn, random))
      in_parts.insert(drawn.face);
  }
  const Grade grade = judge::grade(asked->truth, answer);
  if (!grade.wrong()) return;
  const Explanation why = judge::explain(asked->made.soup, asked->made.query, answer, grade, any_contract(random));
  const auto is_left_out = [&](const std::array<Face_id, 2>& pair) {
    return in_parts.count(pair[0]) + in_parts.count(pair[1]) > 0;
  };
  require(names(why.share_words, ", without faces drawn in parts") ==
              std::any_of(grade.wrong_pairs.begin(), grade.wrong_pairs.end(), is_left_out),
          "a share says where it leaves out faces in parts");
}

/// A point as explanations tell it.
inline std::string told_point(const Exact_point& p) {
  std::string text;
  for (const Rational& x : p) {
    std::array<char, 32> number;
    std::snprintf(number.data(), number.size(), "%.4g", nearest_double(x));
    text += (text.empty() ? "(" : ", ") + std::string(number.data());
  }
  return text + ")";
}

/// Of an answer that is too large everywhere, or too small, a point is told, whatever the contract looks for first.
inline void try_why_not_the_solid(Random& random) {
  const Rational overlap = generate::integer(random, 1, 3);
  const generate::Faces first = generate::box({0, 0, 0}, {4, 4, 4}),
                        second = generate::box({Rational(4 - overlap), 0, 0}, {Rational(8 - overlap), 4, 4}),
                        both = generate::box({0, 0, 0}, {Rational(8 - overlap), 4, 4}),
                        common = generate::box({Rational(4 - overlap), 0, 0}, {4, 4, 4});
  Query query;
  query.question = Question::boolean;
  query.first = first.size();
  const bool is_too_large = random.chance(1, 2);
  query.operation = is_too_large ? Set_operation::intersect : Set_operation::unite;
  const generate::Solid_pair solids{generate::soup_of(first), generate::soup_of(second)};
  const Polygon_soup soup = generate::joined(solids);
  judge::Answer answer;
  answer.surface = generate::soup_of(is_too_large ? both : common);
  const Grade grade = judge::grade_solid(judge::solid_truth(soup, query, 1), answer);
  require(!grade.wrong_points.empty(), "the union is not the intersection");
  const Explanation why = judge::explain(soup, query, answer, grade, any_contract(random));
  require(why.refutation.has_value(), "a point tells why a solid is wrong");
  const Exact_point& at = why.refutation->from;
  const auto is_within = [&](const Rational& low) { return low < at[0] && at[0] < low + 4; };
  require(is_within(0) != is_within(4 - overlap), "it is in one of both");
  require(names(why.refutation->words, told_point(at)) && names(why.refutation->words, told_point(why.refutation->to)),
          "words tell where it is");
  require_told(why);
}

/// Of points of a solid one that the contract forbids is told, as it is.
inline void try_why_not_inside(Random& random) {
  Query query;
  query.question = Question::boolean;
  Grade grade;
  for (Face_id f = 0, all = static_cast<Face_id>(1 + random.below(4)); f < all; ++f) {
    judge::Wrong_point& point = grade.wrong_points.emplace_back();
    point.at = {Rational(static_cast<long>(f)), 0, 1};
    point.on = {Rational(static_cast<long>(f)), 0, 0};
    point.face = f;
    point.inside = random.chance(1, 2);
    if (random.chance(1, 2))
      point.winding = point.inside ? -static_cast<int>(random.below(3)) : 1 + static_cast<int>(random.below(3));
    (point.is_held() ? grade.wrong_visible : grade.wrong_hidden).push_back(f);
  }
  grade.judged = grade.wrong_points.size() + random.below(9);
  const Contract contract = any_contract(random);
  const Explanation why = judge::explain({}, query, {}, grade, contract);
  require(why.refutation && why.refutation->face < grade.wrong_points.size(), "a wrong point is told");
  const judge::Wrong_point& told = grade.wrong_points[why.refutation->face];
  if (contract != Contract::exact) {
    const auto is_worse = [&](const judge::Wrong_point& p) {
      return p.is_held() == (contract == Contract::aggressive);
    };
    require(is_worse(told) || std::none_of(grade.wrong_points.begin(), grade.wrong_points.end(), is_worse),
            "a point that the contract forbids comes first");
  }
  const std::string& words = why.refutation->words;
  require(names(words, told.inside ? " is inside the result" : " is outside the result"),
          "a point is where it is told to be");
  require(names(words, "has a face through it") == !told.winding, "a point on a face of the answer is told to be");
  if (told.winding)
    require(words.ends_with("winds round it " + std::to_string(*told.winding) + " times"), "a winding number is told");
}

}  // namespace fuzz::judged_laws
