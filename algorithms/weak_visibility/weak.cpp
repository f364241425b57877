#include <sightline/algorithms/weak_visibility/weak.h>

#include <sightline/algorithms/weak_visibility/search/likely_blockers.h>
#include <sightline/algorithms/weak_visibility/search/line_search.h>
#include <sightline/algorithms/weak_visibility/search/shared_targets.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/time_limit.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <iterator>
#include <memory>
#include <optional>
#include <unordered_set>
#include <utility>

namespace sightline {
namespace {

/// One question, in three steps: each pair by itself, but for searches of those that may be hidden together; these;
/// then what is left of them.
class Weak_question {
 public:
  Weak_question(const Occluders& occluders, const std::vector<Weak_source>& sources, const Weak_options& options);

  Weakly_visible answered();

 private:
  using Pair = Weakly_visible::Pair;
  /// Of a face its pairs, until one is visible, and which of them wait for the next step.
  struct Face {
    std::uint32_t begin, end;  // of its pieces
    Weak_status status = Weak_status::hidden;
    std::vector<Pair> pairs;
    struct Waiting {
      std::size_t pair;                     // place in `pairs`
      std::unique_ptr<Line_search> search;  // that goes on, if it is kept
    };
    std::vector<Waiting> waiting;
    Weak_counters counters;
  };
  /// Targets that may be hidden together, and what was found of them so far.
  struct Group {
    Targets targets;
    Weak_counters counters = {};
    std::size_t searched = 0;                  // by themselves, or seen where a polygon was
    double spent = 0, saved = 0, in_vain = 0;  // cells: of these, by polygons that are hidden, of polygons that are not
    std::vector<Weak_answer> seen = {};        // sightlines
    std::unordered_set<std::uint32_t> seen_faces = {};  // by their first pieces
  };

  void ask(Face& face);
  /// Some targets of a group: all at once, then what is left in halves.
  /// `tried`: how many of the group's sightlines others beside them were looked for.
  void decide(Group& group, Targets targets, std::size_t tried);
  /// What one search for a polygon around two or more targets, and lines beside what it sees, do not decide.
  Targets left_of(Group& group, Targets targets);
  void decide_alone(Group& group, std::uint32_t target);
  bool is_seen_beside(Group& group, std::uint32_t target, std::size_t tried);
  void finish(Face& face);
  Weakly_visible put_together();
  bool is_wanted(const Face& face) const {
    const auto& wanted = options_->faces;
    return wanted.empty() || std::binary_search(wanted.begin(), wanted.end(), id_of(face));
  }
  Face_id id_of(const Face& face) const { return occluders_->scene().pieces()[face.begin].face; }

  /// What no search is needed for: pairs that look away, and what hides many targets at once.
  std::optional<Weak_answer> quick_answer(std::uint32_t piece, std::uint32_t source, Weak_counters& counters) const;
  std::unique_ptr<Line_search> search_of(std::uint32_t piece, std::uint32_t source) const;
  /// What the search of a pair comes to, gone on with where it is kept.
  Weak_answer searched(const Pair& pair, Face::Waiting& waiting, Weak_counters& counters) const;
  std::vector<Group> groups() const;
  Face& face_of(std::uint32_t piece);
  Pair& waiting_pair(std::uint32_t piece) {
    Face& face = face_of(piece);
    return face.pairs[piece - face.begin];
  }
  static void settle(Face& face);
  void count_done() {
    if (options_->progress) options_->progress(++done_, faces_.size());
  }

  const Occluders* occluders_;
  const std::vector<Weak_source>* sources_;
  const Weak_options* options_;
  bool is_together_;  // of several sources one mostly sees what another one takes long to
  std::vector<Face> faces_;
  std::vector<std::vector<std::uint32_t>> likely_;  // by source, what may hide each piece
  std::vector<Weak_counters> of_groups_;
  std::atomic<std::size_t> done_{0}, kept_{0};  // faces; bytes of searches
};

Weak_question::Weak_question(const Occluders& occluders, const std::vector<Weak_source>& sources,
                             const Weak_options& options)
    : occluders_(&occluders),
      sources_(&sources),
      options_(&options),
      is_together_(options.together_after.has_value() && sources.size() == 1),
      likely_(sources.size()) {
  const std::vector<Piece>& pieces = occluders.scene().pieces();
  const std::vector<std::uint32_t> first = first_pieces(pieces);
  for (std::size_t f = 0; f < first.size(); ++f)
    faces_.push_back({first[f],
                      f + 1 < first.size() ? first[f + 1] : static_cast<std::uint32_t>(pieces.size()),
                      Weak_status::hidden,
                      {},
                      {},
                      {}});
}

Weakly_visible Weak_question::answered() {
  // What hides many targets at once is found once, where most of them are asked about.
  constexpr std::size_t most_are = 8;
  if (options_->faces.empty() || options_->faces.size() * most_are > faces_.size())
    parallel_for(sources_->size(), [&](std::size_t s) {
      likely_[s] = likely_blockers(*occluders_, (*sources_)[s], options_->search.out_of_time);
    });
  run_with_threads(options_->threads, [&] {
    // 1. Each pair by itself.
    parallel_for(faces_.size(), [&](std::size_t f) { ask(faces_[f]); });
    // 2. What may be hidden together.
    std::vector<Group> all = groups();
    parallel_for(all.size(), [&](std::size_t g) { decide(all[g], all[g].targets, 0); });
    for (Group& group : all) of_groups_.push_back(group.counters);
    // 3. What was not.
    parallel_for(faces_.size(), [&](std::size_t f) { finish(faces_[f]); });
  });
  return put_together();
}

std::optional<Weak_answer> Weak_question::quick_answer(std::uint32_t piece, std::uint32_t source,
                                                       Weak_counters& counters) const {
  const auto& [polygon, plane] = (*sources_)[source];
  if (has_run_out(options_->search.out_of_time)) return nothing_known();
  const int towards = occluders_->side_of(piece, plane), back = side(occluders_->plane(piece), polygon);
  if (towards <= 0 || back == 0 || (back < 0 && !options_->search.two_sided)) {
    ++counters.targets;
    ++counters.away;
    return facing_away();
  }
  const std::uint32_t blocker = likely_[source].empty() ? no_blocker : likely_[source][piece];
  if (blocker == no_blocker) return std::nullopt;
  const Near_polygon target = occluders_->polygon(piece);
  if (polygon.size() * target.size() > most_pairs ||
      !occluders_->blocks_all(blocker, polygon, target, pairs_of(polygon, target)))
    return std::nullopt;
  ++counters.targets;
  ++counters.by_one;
  ++counters.blocked;
  return blocked_by(blocker);
}

std::unique_ptr<Line_search> Weak_question::search_of(std::uint32_t piece, std::uint32_t source) const {
  const auto& [polygon, plane] = (*sources_)[source];
  return std::make_unique<Line_search>(*occluders_, polygon, plane, occluders_->polygon(piece), piece,
                                       options_->search);
}

Weak_answer Weak_question::searched(const Pair& pair, Face::Waiting& waiting, Weak_counters& counters) const {
  std::unique_ptr<Line_search> search = std::move(waiting.search);
  if (!search) search = search_of(pair.piece, pair.source);
  return search->run(counters);
}

void Weak_question::settle(Face& face) {
  for (std::size_t k = 0; k < face.pairs.size() && face.status != Weak_status::visible; ++k) {
    const Weak_status status = face.pairs[k].answer.status;
    if (status == Weak_status::hidden) continue;
    face.status = status;
    if (status != Weak_status::visible) continue;
    face.pairs = {std::move(face.pairs[k])};
    face.waiting.clear();
  }
}

void Weak_question::ask(Face& face) {
  if (!is_wanted(face)) return count_done();
  constexpr std::size_t most_kept = std::size_t{1} << 24;  // bytes
  for (std::uint32_t piece = face.begin; piece < face.end; ++piece) {
    const bool together = is_together_ && has_neighbour_in_plane(*occluders_, piece);
    for (std::uint32_t s = 0; s < sources_->size(); ++s) {
      std::optional<Weak_answer> answer = quick_answer(piece, s, face.counters);
      if (!answer) {
        std::unique_ptr<Line_search> search = search_of(piece, s);
        answer = together ? search->first_answer(face.counters) : search->run(face.counters);
        if (!answer) {
          if (!search->can_go_on() || (kept_ += search->bytes()) > most_kept) search.reset();
          face.waiting.push_back({face.pairs.size(), std::move(search)});
          answer.emplace();
        }
      }
      face.pairs.push_back({piece, s, std::move(*answer)});
      if (face.pairs.back().answer.status != Weak_status::visible) continue;
      settle(face);
      return count_done();
    }
  }
  if (!face.waiting.empty()) return;
  settle(face);
  count_done();
}

std::vector<Weak_question::Group> Weak_question::groups() const {
  constexpr std::size_t most = 128;  // as a group is one thread's
  Targets targets;
  for (const Face& face : faces_)
    for (const Face::Waiting& waiting : face.waiting) targets.push_back(face.pairs[waiting.pair].piece);
  std::vector<Targets> left = hanging_together(*occluders_, targets);
  std::vector<Group> all;
  while (!left.empty()) {
    Targets group = std::move(left.back());
    left.pop_back();
    if (group.size() > most) std::ranges::move(halves(*occluders_, group), std::back_inserter(left));
    else all.push_back({std::move(group)});
  }
  return all;
}

Weak_question::Face& Weak_question::face_of(std::uint32_t piece) {
  return *std::prev(std::upper_bound(faces_.begin(), faces_.end(), piece,
                                     [](std::uint32_t p, const Face& later) { return p < later.begin; }));
}

bool Weak_question::is_seen_beside(Group& group, std::uint32_t target, std::size_t tried) {
  constexpr std::size_t most = 4;  // of the newest
  const auto& [polygon, plane] = sources_->front();
  for (std::size_t k = group.seen.size(); k > tried && k + most > group.seen.size(); --k) {
    const Weak_answer& seen = group.seen[k - 1];
    Weak_answer answer = seen;
    if (!has_inside(*occluders_, target, seen.sightline[1])) {
      const auto line = Line_search(*occluders_, polygon, plane, occluders_->polygon(target), target, options_->search)
                            .beside(seen.sightline[0].near, seen.sightline[1].near, group.counters);
      if (!line) continue;
      answer.sightline.assign(line->begin(), line->end());
    }
    ++group.counters.targets;
    waiting_pair(target).answer = std::move(answer);
    group.seen_faces.insert(face_of(target).begin);
    return true;
  }
  return false;
}

void Weak_question::decide(Group& group, Targets targets, std::size_t tried) {
  std::erase_if(targets, [&](std::uint32_t target) {
    return group.seen_faces.contains(face_of(target).begin) || is_seen_beside(group, target, tried);
  });
  if (targets.empty() || has_run_out(options_->search.out_of_time)) return;
  if (targets.size() == 1) return decide_alone(group, targets[0]);
  targets = left_of(group, std::move(targets));
  tried = group.seen.size();
  if (targets.size() < 2) return decide(group, std::move(targets), tried);
  for (const Targets& half : halves(*occluders_, targets)) decide(group, half, tried);
}

Targets Weak_question::left_of(Group& group, Targets targets) {
  Weak_search_options search = options_->search;
  if (const std::size_t after = *options_->together_after; after > 0) {
    const double most = 2 * (group.spent + group.saved) - group.in_vain;
    if (most < static_cast<double>(after)) return targets;
    search.cells = std::min(search.cells, static_cast<std::size_t>(most));
  }
  const auto& [polygon, plane] = sources_->front();
  Near_polygon around = polygon_around(*occluders_, targets);
  if (polygon.size() * around.size() > most_pairs) return targets;
  Weak_counters own;
  Weak_answer found =
      Line_search(*occluders_, polygon, plane, around, occluders_->plane(targets[0]), search, targets[0]).run(own);
  own.targets = own.away = 0;  // it is none of the pairs that were asked about
  own.polygons = 1;
  group.counters += own;
  const double cells = static_cast<double>(own.cells);

  if (found.status == Weak_status::hidden) {
    const double count = static_cast<double>(targets.size());
    if (group.searched > 0)
      group.saved += std::max(0.0, count * group.spent / static_cast<double>(group.searched) - cells);
    const auto shared = std::make_shared<const Shared_proof>(
        Shared_proof{std::move(around), std::move(found.proof), std::move(found.lines)});
    for (const std::uint32_t target : targets) {
      ++group.counters.targets;
      ++group.counters.together;
      waiting_pair(target).answer = {Weak_status::hidden, {}, {}, {}, shared};
    }
    return {};
  }
  std::size_t beside = 0;
  if (found.status == Weak_status::visible) {
    const std::size_t tried = group.seen.size();
    group.seen.push_back(std::move(found));
    beside = std::erase_if(targets, [&](std::uint32_t target) { return is_seen_beside(group, target, tried); });
  }
  group.searched += beside;
  (beside > 0 ? group.spent : group.in_vain) += cells;
  return targets;
}

void Weak_question::decide_alone(Group& group, std::uint32_t target) {
  Face& face = face_of(target);
  Pair& pair = waiting_pair(target);
  const auto waiting = std::find_if(face.waiting.begin(), face.waiting.end(),
                                    [&](const Face::Waiting& one) { return &face.pairs[one.pair] == &pair; });
  const std::size_t before = group.counters.cells;
  pair.answer = searched(pair, *waiting, group.counters);
  ++group.searched;
  group.spent += static_cast<double>(group.counters.cells - before);
  if (pair.answer.status != Weak_status::visible) return;
  group.seen.push_back(pair.answer);
  group.seen_faces.insert(face.begin);
}

void Weak_question::finish(Face& face) {
  if (face.waiting.empty()) return;
  const auto is_seen = [&](const Face::Waiting& waiting) {
    return face.pairs[waiting.pair].answer.status == Weak_status::visible;
  };
  if (std::none_of(face.waiting.begin(), face.waiting.end(), is_seen))
    for (Face::Waiting& waiting : face.waiting) {
      Pair& pair = face.pairs[waiting.pair];
      if (pair.answer.status != Weak_status::undecided || !pair.answer.proof.empty()) continue;  // it is searched
      pair.answer =
          has_run_out(options_->search.out_of_time) ? nothing_known() : searched(pair, waiting, face.counters);
      if (is_seen(waiting)) break;
    }
  settle(face);
  face.waiting.clear();
  count_done();
}

Weakly_visible Weak_question::put_together() {
  Weakly_visible all;
  std::size_t pairs = 0;
  for (const Face& face : faces_) pairs += face.pairs.size();
  all.pairs.reserve(pairs);
  for (const Weak_counters& counters : of_groups_) all.counters += counters;
  for (Face& face : faces_) {
    if (!is_wanted(face)) continue;
    all.of(face.status).push_back(id_of(face));
    all.counters += face.counters;
    for (Pair& pair : face.pairs) {
      if (face.status != Weak_status::undecided) all.pairs.push_back(std::move(pair));
      else if (pair.answer.status == Weak_status::undecided) all.open.push_back(std::move(pair));
    }
    face = {};  // both at once would be twice as much
  }
  return all;
}

}  // namespace

Weakly_visible weakly_visible(const Occluders& occluders, const std::vector<Weak_source>& sources,
                              const Weak_options& options) {
  return Weak_question(occluders, sources, options).answered();
}

}  // namespace sightline
