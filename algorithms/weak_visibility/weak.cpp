#include <sightline/algorithms/weak_visibility/weak.h>

#include <sightline/algorithms/weak_visibility/search/likely_blockers.h>
#include <sightline/algorithms/weak_visibility/search/line_search.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/time_limit.h>

#include <algorithm>
#include <utility>

namespace sightline {

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
  const auto& wanted = options.faces;
  const auto is_wanted = [&](std::size_t f) {
    return wanted.empty() || std::binary_search(wanted.begin(), wanted.end(), pieces[first[f]].face);
  };
  // What hides many targets at once is found once, where most of them are asked about.
  std::vector<std::vector<std::uint32_t>> likely(sources.size());
  constexpr std::size_t most_are = 8;
  if (wanted.empty() || wanted.size() * most_are > first.size())
    parallel_for(sources.size(), [&](std::size_t s) {
      likely[s] = likely_blockers(occluders, sources[s], options.search.out_of_time);
    });
  const auto answer_of = [&](std::uint32_t piece, std::uint32_t s, Weak_counters& counters) {
    const auto& [source, plane] = sources[s];
    if (has_run_out(options.search.out_of_time)) return nothing_known();
    const int towards = occluders.side_of(piece, plane), back = side(occluders.plane(piece), source);
    if (towards <= 0 || back == 0 || (back < 0 && !options.search.two_sided)) {
      ++counters.targets;
      ++counters.away;
      return facing_away();
    }
    Near_polygon target = occluders.polygon(piece);
    if (const std::uint32_t blocker = likely[s].empty() ? no_blocker : likely[s][piece];
        blocker != no_blocker && source.size() * target.size() <= most_pairs &&
        occluders.blocks_all(blocker, source, target, pairs_of(source, target))) {
      ++counters.targets;
      ++counters.by_one;
      ++counters.blocked;
      return blocked_by(blocker);
    }
    return Line_search(occluders, source, plane, std::move(target), piece, options.search).run(counters);
  };
  const auto decide = [&](std::size_t f, std::uint32_t begin, std::uint32_t end) {
    Result& result = results[f];
    if (!is_wanted(f)) return;
    for (std::uint32_t piece = begin; piece < end && result.status != Weak_status::visible; ++piece)
      for (std::uint32_t s = 0; s < sources.size(); ++s) {
        Weak_answer answer = answer_of(piece, s, result.counters);
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
  std::size_t pairs = 0;
  for (const Result& result : results) pairs += result.pairs.size();
  all.pairs.reserve(pairs);
  for (std::size_t f = 0; f < first.size(); ++f) {
    if (!is_wanted(f)) continue;
    Result& result = results[f];
    all.of(result.status).push_back(pieces[first[f]].face);
    all.counters += result.counters;
    for (Weakly_visible::Pair& pair : result.pairs) {
      if (result.status != Weak_status::undecided) all.pairs.push_back(std::move(pair));
      else if (pair.answer.status == Weak_status::undecided) all.open.push_back(std::move(pair));
    }
    result = {};  // both at once would be twice as much
  }
  return all;
}

}  // namespace sightline
