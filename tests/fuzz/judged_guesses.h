#pragma once
// Guesses: an answer fits a reading iff it is what that reading sees, and what is said of neighbours is true of them.

#include "judged_questions.h"

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/judge/guess.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/harness/judge/truth.h>
#include <sightline/harness/laws/trace.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace fuzz::judged_laws {

inline Reading any_reading(Question question, Random& random) {
  const std::vector<Reading> readings = judge::readings_of(question);
  return readings[random.below(readings.size())];
}

inline void try_reading_of_faces(Random& random) {
  const std::optional<Asked> asked = any_asked(random.chance(1, 4) ? Question::weak : Question::see, random);
  if (!asked) return;
  Query query = asked->made.query;
  Polygon_soup soup = asked->made.soup;
  const Reading reading = any_reading(query.question, random);
  // 1. What is visible so read.
  Truth truth = asked->truth;
  if (reading == Reading::turned) {
    truth = judge::truth_of(generate::faces_reversed(soup), query, asked->options);
  } else if (reading == Reading::other_sides || reading == Reading::source_turned) {
    Query other = query;
    if (reading == Reading::other_sides) other.two_sided = !other.two_sided;
    else std::reverse(other.source.begin(), other.source.end());
    truth = judge::truth_of(soup, other, asked->options);
  } else if (reading == Reading::nothing_hides) {
    truth = {};
    for (const Face_id f : std::set<Face_id>(asked->owners.begin(), asked->owners.end()))
      (asked->counts_from(query.eye, f, query.two_sided) ? truth.visible : truth.hidden).push_back(f);
  } else if (reading == Reading::complement) {
    std::swap(truth.visible, truth.hidden);
  }
  // 2. An answer that is so, or not.
  Flipped answered = flipped(truth.visible, truth.hidden, soup.face_count(), false, random);
  bool is_right = answered.shown.empty() && answered.left_out.empty();
  Face_ids& shown = answered.answer.visible;
  if (reading == Reading::from_one) {
    for (Face_id& f : shown) ++f;
    if (!shown.empty() && shown.back() == soup.face_count()) return;  // no answer names it
    if (random.chance(1, 4)) {
      if (truth.visible.empty() || random.chance(1, 4)) shown.clear();
      shown.insert(shown.begin(), 0);
      is_right = false;
    }
  }
  require(judge::is_right(reading, soup, query, answered.answer, asked->options) == is_right,
          "an answer is right under a reading iff it is what that reading sees");
}

/// Of one triangle, seen from behind: who counts from 1 names no face 0.
inline void try_face_zero(Random& random) {
  const auto number = [&](std::int64_t least, std::int64_t most) { return generate::integer(random, least, most); };
  Query query;
  query.question = Question::see;
  for (Rational& x : query.eye) x = number(-3, 3);
  query.eye[2] = number(-5, -1);
  judge::Answer answer;
  answer.visible = {0};
  const Rational wide = number(1, 5), high = number(1, 5);
  require(!judge::is_right(Reading::from_one, generate::soup_of({{{0, 0, 0}, {wide, 0, 0}, {0, high, 0}}}), query,
                           answer, judge::Truth_options()),
          "who counts from 1 names no face 0");
}

inline void try_reading_of_an_order(Random& random) {
  const std::optional<Asked> asked = any_asked(Question::order, random);
  if (!asked) return;
  const Query& query = asked->made.query;
  const Reading reading = any_reading(Question::order, random);
  const Any_order order(*asked, random);
  bool is_right = wrong_pairs_by_force(*asked, order.faces).empty();
  for (const Face_id f : order.left_out) {
    const Rational height = asked->height(f, query.eye);
    if (reading == Reading::turned) is_right = is_right && !(height < 0 || (query.two_sided && height > 0));
    else
      is_right = is_right && !(asked->counts_from(query.eye, f, query.two_sided != (reading == Reading::other_sides)));
  }
  judge::Answer answer = order.answer(reading == Reading::from_one ? 1 : 0);
  if (reading == Reading::reversed) std::reverse(answer.order.begin(), answer.order.end());
  for (const judge::Drawn_face& drawn : answer.order)
    if (drawn.face == asked->faces()) return;  // no answer names it
  require(judge::is_right(reading, asked->made.soup, query, answer, asked->options) == is_right,
          "an order is right under a reading iff it is one that reading draws");
}

inline void try_reading_of_rays(Random& random) {
  const std::optional<Asked> asked = any_asked(Question::trace, random);
  if (!asked) return;
  const Query& query = asked->made.query;
  const Reading reading = any_reading(Question::trace, random);
  const std::uint64_t rare = random.chance(1, 2) ? 1000 : 20;
  judge::Answer answer;
  bool is_right = true;
  for (Exact_ray ray : query.rays) {
    if (reading == Reading::to_points) ray.direction = minus(ray.direction, ray.origin);
    if (is_zero(ray.direction)) return;
    Hits hits = harness::hits_by_definition(asked->made.soup, asked->scene, ray,
                                            reading == Reading::closed_start ? Ray_start::closed : Ray_start::open);
    if (reading == Reading::fronts_only)
      std::erase_if(hits, [](const Face_hit& hit) { return hit.side != Met_side::front; });
    std::set<Face_id> right;
    for (const Face_hit& hit : hits)
      if (hit.t == (reading == Reading::farthest ? hits.back().t : hits.front().t)) right.insert(hit.face);
    std::optional<Face_id> said;
    if (random.chance(1, rare)) {  // any face, or none
      if (random.chance(3, 4)) said = asked->owners[random.below(asked->owners.size())];
    } else if (!right.empty()) {
      said = *std::next(right.begin(), static_cast<std::ptrdiff_t>(random.below(right.size())));
    }
    is_right = is_right && (said ? right.count(*said) > 0 : right.empty());
    if (said && reading == Reading::from_one && ++*said == asked->faces()) return;  // no answer names it
    answer.first.push_back(said);
  }
  require(judge::is_right(reading, asked->made.soup, query, answer, asked->options) == is_right,
          "what rays meet is right under a reading iff it is what that reading meets");
}

inline void try_reading_of_solids(Random& random) {
  constexpr int most_bits = 120;  // with more it takes seconds
  const std::optional<Asked> asked = any_asked(Question::boolean, random);
  if (!asked || asked->scene.bits() > most_bits) return;
  const Query& query = asked->made.query;
  generate::Solid_pair solids = judge::solids_of(asked->made.soup, query.first);
  const auto surface_of = [](const generate::Solid_pair& of, Set_operation operation) {
    Set_options options;
    options.operation = operation;
    return without_holes(set_operation(Operands(std::span<const Polygon_soup>(of)), options).soup).soup;
  };
  const auto is_right = [&](Reading reading, const Polygon_soup& surface) {
    judge::Answer answer;
    answer.surface = surface;
    return judge::is_right(reading, asked->made.soup, query, answer, asked->options);
  };
  const Polygon_soup right = surface_of(solids, query.operation);
  if (query.operation == Set_operation::subtract && random.chance(1, 2)) {
    const Rational first_alone = volume(right);
    std::swap(solids[0], solids[1]);
    require(is_right(Reading::swapped, surface_of(solids, Set_operation::subtract)),
            "the second solid less the first is right if they are exchanged");
    require(first_alone == 0 || !is_right(Reading::swapped, right),
            "the first solid less the second is not the other way round");
    return;
  }
  require(is_right(Reading::inside_out, generate::faces_reversed(right)),
          "a result turned inside out is right if fronts look inwards");
  require(is_right(Reading::inside_out, right) == (right.face_count() == 0), "a result is not turned inside out");
}

inline void try_lists(Random& random) {
  const std::uint64_t which = random.below(5);
  judge::Answer answer;
  if (which == 1) answer.visible = {static_cast<Face_id>(random.below(3))};
  if (which == 2) answer.order = {{static_cast<Face_id>(random.below(3)), {}}};
  if (which == 3) answer.first = {std::nullopt, static_cast<Face_id>(random.below(3))};
  if (which == 4) answer.surface = generate::soup_of(generate::box({0, 0, 0}, {1, 1, 1}));
  if (random.chance(1, 2)) answer.abstained = {4};
  require(judge::lists_faces(answer) == (which != 0), "an answer lists faces iff it names any");
}

// ---- Words

/// What is said of a distance.
inline std::string words_of_distance(std::int64_t ulps) {
  if (ulps == 1) return "one ulp";
  int bits = 0;
  for (; ulps > 1; ulps /= 2) ++bits;
  return "2^-" + std::to_string(52 - bits) + " of the scene's size";
}

/// What is said of neighbours, where one of the things that programs do explains all of them.
inline void try_words_of_tendencies(Random& random) {
  const std::array<int, 5> bits{0, 12, 22, 32, 44};
  const std::size_t reach = random.below(bits.size() + 1);  // so many distances are wrong
  const std::uint64_t kind = random.below(3);
  const std::int64_t sign = random.chance(1, 2) ? 1 : -1;
  const bool is_sided = kind == 1, is_zero_wrong = kind != 2 && (reach == 0 || random.chance(1, 2));
  std::vector<Neighbour> neighbours{{0, is_zero_wrong}};
  for (std::size_t k = 0; k < bits.size(); ++k)
    for (const std::int64_t side : {1, -1}) {
      const bool is_within = kind == 2 ? k >= reach : k < reach;
      neighbours.push_back({side * (std::int64_t{1} << bits[k]), is_within && (!is_sided || side == sign)});
    }
  random.shuffle(neighbours);
  if (kind == 2 && reach == bits.size()) return;  // none is wrong
  const auto distance = [&](std::size_t k) { return words_of_distance(std::int64_t{1} << bits[k]); };
  const std::string side = sign > 0 ? "to the one side (+)" : "to the other side (-)",
                    none = ": no tolerance explains that";
  std::string right;
  if (kind == 2 || (reach == bits.size() && !is_sided && !is_zero_wrong))
    right = "right when moved by nothing: it does not come from being flat";
  else if (reach == 0)
    right = "wrong only where it is flat, right when moved by one ulp: contact is decided wrongly, all else is right";
  else if (reach == bits.size() && is_sided)
    right = "wrong when moved " + side + ", as far as " + distance(4) + ", right when moved to the opposite one" + none;
  else if (reach == bits.size()) right = "wrong wherever it is moved, as far as " + distance(4) + none;
  else
    right = "wrong when moved by up to " + distance(reach - 1) + (is_sided ? " " + side : "") + ", right from " +
            distance(reach) + " on";
  require(names(judge::words_of(neighbours, "flat"), right), "what explains all neighbours is said of them");
}

/// What is said of any neighbours is true of them.
inline void try_words_of_neighbours(Random& random) {
  const std::array<int, 5> bits{0, 12, 22, 32, 44};
  std::vector<Neighbour> neighbours;
  const bool is_wild = random.chance(1, 3);
  const std::int64_t least = random.chance(1, 2) ? 0 : std::int64_t{-1} << bits[random.below(5)],
                     most = std::int64_t{1} << bits[random.below(5)];
  const auto offer = [&](std::int64_t ulps) {
    if (random.chance(1, 3)) return;
    neighbours.push_back({ulps, is_wild ? random.chance(1, 2) : least <= ulps && ulps <= most});
  };
  offer(0);
  const bool is_one_sided = random.chance(1, 4);
  for (const int b : bits) {
    offer(std::int64_t{1} << b);
    if (!is_one_sided) offer(std::int64_t{-1} << b);
  }
  random.shuffle(neighbours);
  const auto some = [&](auto is_meant) { return std::any_of(neighbours.begin(), neighbours.end(), is_meant); };
  if (!some([](const Neighbour& n) { return n.wrong; })) return;
  const std::string words = judge::words_of(neighbours, "flat");
  require(names(words, "nothing is known") != some([](const Neighbour& n) { return n.ulps != 0; }),
          "nothing is said of where it is moved iff it is not");
  const bool is_plus = names(words, "(+)"), is_minus = names(words, "(-)");
  const auto is_meant = [&](const Neighbour& n) {  // of the side that is told of
    return n.ulps != 0 && (!is_plus || n.ulps > 0) && (!is_minus || n.ulps < 0);
  };
  const auto some_moved = [&](bool wrong, std::int64_t from, std::int64_t until) {
    return some([&](const Neighbour& n) {
      return is_meant(n) && n.wrong == wrong && from <= std::abs(n.ulps) && std::abs(n.ulps) <= until;
    });
  };
  const auto said_after = [&](const std::string& before) -> std::int64_t {
    for (const int b : bits)
      if (names(words, before + words_of_distance(std::int64_t{1} << b))) return std::int64_t{1} << b;
    return 0;
  };
  constexpr std::int64_t far = std::int64_t{1} << 60;
  const bool wrong_at_none = some([](const Neighbour& n) { return n.ulps == 0 && n.wrong; });
  if (is_plus || is_minus)
    require(!some([&](const Neighbour& n) { return n.ulps != 0 && n.wrong && (n.ulps > 0) != is_plus; }),
            "what is wrong is on the side that is told of");
  if (names(words, "wrong only where"))
    require(wrong_at_none && !some_moved(true, 1, far) && some_moved(false, 1, said_after("right when moved by ")),
            "what is wrong only where it is degenerate is right wherever it is moved");
  if (names(words, "as far as ")) {
    const std::int64_t until = said_after("as far as ");
    require(some_moved(true, until, until) && !some_moved(true, until + 1, far), "as far as is told some is wrong");
    require(!some_moved(false, 1, far), "what is wrong wherever it is moved is right nowhere");
  }
  if (names(words, "opposite"))
    require((is_plus || is_minus) &&
                some([&](const Neighbour& n) { return n.ulps != 0 && !n.wrong && (n.ulps > 0) != is_plus; }),
            "the opposite side is right where that is told");
  if (names(words, "by up to ")) {
    const std::int64_t until = said_after("by up to "), from = said_after("right from ");
    require(some_moved(true, until, until) && !some_moved(true, until + 1, far), "up to what is told some is wrong");
    require(until < from && some_moved(false, from, from) && !some_moved(false, until + 1, from - 1),
            "what is right from a distance on is the first beyond what is wrong");
  }
  if (names(words, "moved by nothing"))
    require(some([](const Neighbour& n) { return n.ulps == 0 && !n.wrong; }) &&
                some_moved(true, said_after("wrong when moved by "), said_after("wrong when moved by ")),
            "what is right when not moved, and wrong when moved so far, is so");
}

inline void try_words_of_kinds(Random& random) {
  const auto any_number = [&] { return random.chance(1, 2) ? 0 : random.below(4); };
  judge::Kinds kinds;
  for (std::size_t* number : {&kinds.concave_right, &kinds.concave_wrong, &kinds.convex_right, &kinds.convex_wrong})
    *number = any_number();
  const std::string words = judge::words_of(kinds);
  const bool is_said = kinds.concave_wrong > 0 && kinds.convex_wrong == 0 && kinds.convex_right > 0;
  require(words.empty() != is_said,
          "kinds are told apart iff all that is wrong is concave, and what is convex is judged");
  if (is_said)
    require(names(words, std::to_string(kinds.concave_wrong) + " of " +
                             std::to_string(kinds.concave_wrong + kinds.concave_right) + " concave") &&
                names(words, std::to_string(kinds.convex_right) + " convex"),
            "of each kind it is said how many are wrong");
}

/// What is said of a reading is not what was asked for: of sides, the others; and no two readings have the same words.
inline void try_words_of_readings(Random& random) {
  const bool two_sided = random.chance(1, 2);
  const std::string sides = judge::words_of(Reading::other_sides, two_sided);
  require(names(sides, "only fronts") == two_sided && names(sides, "from behind") == !two_sided,
          "the other sides are those that were not asked for");
  for (std::size_t q = 0; q < judge::question_names.size(); ++q) {
    std::set<std::string> all;
    const std::vector<Reading> readings = judge::readings_of(static_cast<Question>(q));
    for (const Reading reading : readings) all.insert(judge::words_of(reading, two_sided));
    require(all.size() == readings.size() && all.count("") == 0, "each reading has its own words");
  }
}

}  // namespace fuzz::judged_laws
