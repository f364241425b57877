#pragma once
// Small cases for the judge, with all that is known of them, and answers that are wrong where they are made so.

#include "any_case.h"
#include "support.h"

#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/judge/case.h>
#include <sightline/harness/judge/explain.h>
#include <sightline/harness/judge/grade.h>
#include <sightline/harness/judge/guess.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/harness/judge/truth.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/fuzz.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace fuzz::judged_laws {

using generate::Points, generate::Random;
using harness::Flat_face;
using judge::Case, judge::Case_options, judge::Contract, judge::Explanation, judge::Grade, judge::Mark;
using judge::Neighbour, judge::Query, judge::Question, judge::Reading, judge::Refutation, judge::Truth;
using Face_ids = std::vector<Face_id>;
using Hits = std::vector<Face_hit>;

constexpr std::size_t most_faces = 12;

inline bool holds(const Face_ids& sorted, Face_id face) {
  return std::binary_search(sorted.begin(), sorted.end(), face);
}
inline bool names(const std::string& words, const std::string& what) { return words.find(what) != std::string::npos; }

inline Case_options any_options(Question question, Random& random) {
  Case_options options;
  options.question = question;
  options.two_sided = random.chance(1, 2);
  options.doubles = random.chance(1, 2);
  options.triangles = random.chance(1, 3);
  return options;
}

/// A small case, its convex pieces, and the library's truth about it.
struct Asked {
  Case made;
  Scene scene;
  std::vector<Flat_face> pieces;
  Face_ids owners;  ///< by piece
  judge::Truth_options options;
  Truth truth;

  explicit Asked(Case given) : made(std::move(given)), scene(made.soup), pieces(harness::flat_faces_of(scene)) {
    for (const Piece& piece : scene.pieces()) owners.push_back(piece.face);
    options.threads = 1;
  }

  std::size_t faces() const { return made.soup.face_count(); }

  /// How far a point is in front of a face that is kept.
  Rational height(Face_id face, const Exact_point& p) const {
    for (std::size_t k = 0; k < pieces.size(); ++k)
      if (owners[k] == face) return pieces[k].height(p);
    return 0;
  }
  bool counts_from(const Exact_point& eye, Face_id face, bool two_sided) const {
    const Rational h = height(face, eye);
    return h > 0 || (two_sided && h < 0);
  }
  /// Whether a point is on a face; `strictly`: inside one of its pieces.
  bool is_on(Face_id face, const Exact_point& p, bool strictly) const {
    for (std::size_t k = 0; k < pieces.size(); ++k)
      if (owners[k] == face && pieces[k].height(p) == 0 && pieces[k].side_within(p) >= (strictly ? 1 : 0)) return true;
    return false;
  }
  /// Where a face that does not have `from` in its plane first stands between two points, as a share of the way.
  std::optional<Rational> first_between(const Exact_point& from, const Exact_point& to) const {
    std::optional<Rational> first;
    for (const Flat_face& piece : pieces) {
      if (piece.height(from) == 0) continue;
      const std::optional<Rational> t = harness::met_at(piece, from, minus(to, from));
      if (t && *t < 1 && (!first || *t < *first)) first = t;
    }
    return first;
  }
};

/// Whether faces that count overlap in a cycle, by what sees what over what.
inline bool overlaps_in_a_cycle(const Asked& asked) {
  const Query& query = asked.made.query;
  std::set<Face_id> left;
  std::set<std::array<Face_id, 2>> over;
  const auto towards = [&](std::size_t k) {
    const Flat_face& piece = asked.pieces[k];
    return piece.height(query.eye) < 0 ? Flat_face(generate::reversed(piece.corners)) : piece;
  };
  const auto counts = [&](std::size_t k) { return asked.counts_from(query.eye, asked.owners[k], query.two_sided); };
  for (std::size_t a = 0; a < asked.pieces.size(); ++a) {
    if (!counts(a)) continue;
    left.insert(asked.owners[a]);
    for (std::size_t b = 0; b < asked.pieces.size(); ++b)
      if (counts(b) && asked.owners[a] != asked.owners[b] && harness::sees_over(query.eye, towards(a), towards(b)))
        over.insert({asked.owners[a], asked.owners[b]});
  }
  for (;;) {  // without those that are over nothing
    std::vector<Face_id> ends;
    for (const Face_id f : left)
      if (std::none_of(over.begin(), over.end(), [&](const auto& p) { return p[0] == f && left.count(p[1]) > 0; }))
        ends.push_back(f);
    if (ends.empty()) return !left.empty();
    for (const Face_id f : ends) left.erase(f);
  }
}

inline std::optional<Asked> any_asked(Question question, Random& random) {
  const harness::Fuzz_case drawn = any_case(random);
  if (harness::make(drawn).soup.face_count() > most_faces) return std::nullopt;
  const Case made = judge::case_of(generate::family(drawn.family), drawn.parameters, any_options(question, random));
  if (!made.not_asked.empty()) return std::nullopt;
  Asked asked(made);
  if (asked.pieces.empty() || asked.pieces.size() > most_faces) return std::nullopt;
  asked.truth = judge::truth_of(asked.made.soup, asked.made.query, asked.options);
  if (asked.truth.order)
    require(asked.truth.order->whole_faces_do() != overlaps_in_a_cycle(asked),
            "no order of whole faces is right iff faces overlap in a cycle");
  if (!asked.truth.not_asked.empty()) {
    require(asked.truth.visible.empty() && asked.truth.hidden.empty(), "of what is not asked nothing is known");
    require(question != Question::see || !asked.scene.set_aside().empty(), "an eye may be asked about proper faces");
    return std::nullopt;
  }
  return asked;
}

/// Whether a point of a face is on an edge of it.
inline bool is_on_border(const Polygon_soup& soup, Face_id face, const Exact_point& at) {
  for (std::size_t l = 0; l < soup.loop_count(face); ++l) {
    const auto loop = soup.loop(face, l);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Exact_point p = minus(soup.point(loop[i]), at), q = minus(soup.point(loop[(i + 1) % loop.size()]), at);
      if (is_zero(cross(p, q)) && dot(p, q) <= 0) return true;
    }
  }
  return false;
}

/// An answer to see or weak, and how it differs from the right one.
struct Flipped {
  judge::Answer answer;
  Face_ids shown, left_out, abstained;
};

inline Flipped flipped(const Face_ids& visible, const Face_ids& hidden, std::size_t faces, bool may_abstain,
                       Random& random) {
  Flipped made;
  const std::uint64_t rare = random.chance(1, 3) ? 2 : 1 + faces * random.between(1, 2);
  for (Face_id f = 0; f < faces; ++f) {
    const bool is_visible = holds(visible, f), is_known = is_visible || holds(hidden, f);
    if (may_abstain && random.chance(1, 2 * rare)) {
      made.answer.abstained.push_back(f);
      if (is_known) made.abstained.push_back(f);
      continue;
    }
    const bool is_wrong = random.chance(1, rare);
    if (is_visible != is_wrong) made.answer.visible.push_back(f);
    if (is_wrong && is_known) (is_visible ? made.left_out : made.shown).push_back(f);
  }
  return made;
}

// ---- Orders

/// Pairs of an order that some direction shows the wrong way round.
inline std::vector<std::array<Face_id, 2>> wrong_pairs_by_force(const Asked& asked, const Face_ids& order) {
  const Exact_point& eye = asked.made.query.eye;
  std::vector<Flat_face> towards;
  for (const Flat_face& piece : asked.pieces)
    towards.push_back(piece.height(eye) < 0 ? Flat_face(generate::reversed(piece.corners)) : piece);
  std::set<std::array<Face_id, 2>> wrong;
  const auto place = [&](std::size_t piece) {
    return std::find(order.begin(), order.end(), asked.owners[piece]) - order.begin();
  };
  for (std::size_t a = 0; a < towards.size(); ++a)
    for (std::size_t b = 0; b < towards.size(); ++b)
      if (place(a) < place(b) && place(b) < static_cast<std::ptrdiff_t>(order.size()) &&
          harness::sees_over(eye, towards[a], towards[b]))
        wrong.insert({asked.owners[a], asked.owners[b]});
  return {wrong.begin(), wrong.end()};
}

/// An order at random: often nearly right, at times without a face, or two.
struct Any_order {
  Face_ids faces, left_out;

  Any_order(const Asked& asked, Random& random) {
    const std::set<Face_id> all(asked.owners.begin(), asked.owners.end());
    Face_ids rest(all.begin(), all.end());
    random.shuffle(rest);
    const std::uint64_t most_wrong = random.chance(1, 2) ? 0 : random.below(4);
    std::uint64_t wrong = 0;
    const bool is_whole = random.chance(1, 2);
    for (const Face_id f : rest) {
      if (!is_whole && random.chance(1, 6)) {
        left_out.push_back(f);
        continue;
      }
      // Where it does least harm, or anywhere.
      std::size_t best = random.below(faces.size() + 1), least = asked.pieces.size() * asked.pieces.size();
      if (wrong++ >= most_wrong)
        for (std::size_t at = 0; at <= faces.size() && least > 0; ++at) {
          Face_ids tried = faces;
          tried.insert(tried.begin() + static_cast<std::ptrdiff_t>(at), f);
          const std::size_t pairs = wrong_pairs_by_force(asked, tried).size();
          if (pairs < least) std::tie(least, best) = std::pair(pairs, at);
        }
      faces.insert(faces.begin() + static_cast<std::ptrdiff_t>(best), f);
    }
    std::sort(left_out.begin(), left_out.end());
  }

  judge::Answer answer(Face_id more = 0) const {
    judge::Answer made;
    for (const Face_id f : faces) made.order.push_back({f + more, {}});
    return made;
  }
};

}  // namespace fuzz::judged_laws
