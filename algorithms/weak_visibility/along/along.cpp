#include <sightline/algorithms/weak_visibility/along/along.h>

#include <sightline/algorithms/weak_visibility/weak_answer.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

namespace sightline {

namespace {

using Face = Visible_along::Face;
struct Timed_change {
  Quadratic_root t;
  Along_event::Change change;
};
/// What is seen of one piece, and the search that knows why it ends.
struct Seen_piece {
  Piece_along* search;
  Parameter_range seen;
};

bool by_low(const Parameter_range& a, const Parameter_range& b) { return a.low < b.low; }

/// Whether a face is seen at a moment of its own, or within one of its ranges.
bool is_moment(const Face& face, const Quadratic_root& t) {
  return std::any_of(face.moments.begin(), face.moments.end(), [&](const Rational& m) { return moment(m) == t; });
}
bool is_within(const Face& face, const Quadratic_root& t) {
  return std::any_of(face.seen.begin(), face.seen.end(), [&](const auto& r) { return r.low < t && t < r.high; });
}

bool is_seen_on_the_way(const Face& face) {
  return !face.seen.empty() ||
         std::any_of(face.moments.begin(), face.moments.end(), [](const Rational& t) { return t > 0 && t < 1; });
}

/// When the face of some pieces is seen: what of them is, put together.
Face seen_of(const Along_scene& scene, std::span<Piece_along> pieces, Face_id id, std::vector<Seen_piece>& all) {
  Face face{id, {}, {}};
  std::vector<Rational> contacts;  // at which it is seen
  for (const Rational& t : scene.stops())
    if (std::any_of(pieces.begin(), pieces.end(), [&](Piece_along& piece) { return piece.is_seen_at(moment(t)); }))
      contacts.push_back(t);
  std::vector<Parameter_range> parts;
  for (Piece_along& piece : pieces)
    for (std::size_t k = 0; k + 1 < scene.stops().size(); ++k)
      for (Parameter_range& part : piece.seen_within({moment(scene.stops()[k]), moment(scene.stops()[k + 1])})) {
        all.push_back({&piece, part});
        parts.push_back(std::move(part));
      }
  // Ranges of different pieces overlap; where they only meet nothing is seen, but perhaps from a contact.
  std::sort(parts.begin(), parts.end(), by_low);
  for (Parameter_range& part : parts) {
    if (face.seen.empty()) {
      face.seen.push_back(std::move(part));
      continue;
    }
    Quadratic_root& high = face.seen.back().high;
    const bool is_joined =
        part.low < high || (part.low == high && std::any_of(contacts.begin(), contacts.end(),
                                                            [&](const Rational& t) { return moment(t) == high; }));
    if (!is_joined) face.seen.push_back(std::move(part));
    else if (high < part.high) high = part.high;
  }
  for (const Rational& t : contacts)
    if (!is_within(face, moment(t))) face.moments.push_back(t);
  return face;
}

std::vector<Timed_change> changes_of(const Along_scene& scene, const Face& face, std::span<const Seen_piece> pieces) {
  std::vector<Quadratic_root> ends;
  for (const Rational& t : face.moments) ends.push_back(moment(t));
  for (const Parameter_range& range : face.seen) {
    ends.push_back(range.low);
    ends.push_back(range.high);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<Timed_change> changes;
  for (const Quadratic_root& t : ends) {
    Along_event::Change change{face.face, false, is_moment(face, t), false, Along_kind::contact, {}};
    for (const Parameter_range& range : face.seen) {
      change.before |= range.high == t;
      change.after |= range.low == t;
    }
    if (t == Quadratic_root(0)) change.before = change.at;
    if (t == Quadratic_root(1)) change.after = change.at;
    if (change.before == change.at && change.at == change.after) continue;
    const auto& contacts = scene.contacts();
    const bool is_contact =
        std::any_of(contacts.begin(), contacts.end(), [&](const Rational& c) { return moment(c) == t; });
    std::optional<Along_cause> cause;
    for (const auto& [search, seen] : pieces) {
      if (!(seen.low == t || seen.high == t) || (is_contact && !search->is_edge_on(t))) continue;
      Along_cause own = search->cause(t, seen);
      if (!cause || own.kind < cause->kind) cause = std::move(own);
    }
    if (cause) {
      change.kind = cause->kind;
      change.edges = std::move(cause->edges);
    }
    changes.push_back({t, std::move(change)});
  }
  return changes;
}

}  // namespace

Visible_along visible_along(const Occluders& occluders, const Exact_point& from, const Exact_point& to,
                            const Along_options& options) {
  struct Result {
    Face face;
    std::vector<Timed_change> changes;
    Along_counters counters;
    std::vector<Along_proof> proofs;
  };
  const std::vector<Piece>& pieces = occluders.scene().pieces();
  const std::vector<std::uint32_t> first = first_pieces(pieces);
  std::atomic<std::size_t> done = 0;  // faces, as was told last
  std::function<void(std::size_t, std::size_t)> tell;
  if (options.progress)
    tell = [&](std::size_t faces, std::size_t all) {
      done = faces;
      options.progress(faces, all);
    };
  const Along_scene scene(occluders, from, to, [&] {
    if (options.progress) options.progress(done, first.size());
  });
  std::vector<Result> results(first.size());
  const auto decide = [&](std::size_t f, std::uint32_t begin, std::uint32_t end) {
    std::vector<Piece_along> searches;
    for (std::uint32_t piece = begin; piece < end; ++piece) {
      if (scene.polygons()[piece].corners.empty()) continue;
      for (const int side : {1, -1})
        if (side == 1 || options.two_sided) searches.emplace_back(scene, piece, side, options.with_proofs);
    }
    Result& result = results[f];
    std::vector<Seen_piece> seen;
    result.face = seen_of(scene, searches, pieces[first[f]].face, seen);
    result.changes = changes_of(scene, result.face, seen);
    for (const Piece_along& search : searches) {
      result.counters += search.counters();
      result.proofs.insert(result.proofs.end(), search.proofs().begin(), search.proofs().end());
    }
  };
  for_each_face(pieces, first, options.threads, tell, decide);

  Visible_along all;
  std::vector<Timed_change> changes;
  for (Result& result : results) {
    const Face_id id = result.face.face;
    if (is_moment(result.face, Quadratic_root(0))) all.at_start.push_back(id);
    if (is_moment(result.face, Quadratic_root(1))) all.at_end.push_back(id);
    if (is_seen_on_the_way(result.face)) all.visible.push_back(id);
    all.counters += result.counters;
    std::move(result.proofs.begin(), result.proofs.end(), std::back_inserter(all.proofs));
    std::move(result.changes.begin(), result.changes.end(), std::back_inserter(changes));
    all.faces.push_back(std::move(result.face));
  }
  std::stable_sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  for (Timed_change& change : changes) {
    if (all.events.empty() || !(all.events.back().t == change.t)) all.events.push_back({change.t, {}});
    all.events.back().changes.push_back(std::move(change.change));
  }
  return all;
}

}  // namespace sightline
