#include <sightline/algorithms/weak_visibility/weak.h>

#include <sightline/algorithms/weak_visibility/search/line_search.h>

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
  const auto decide = [&](std::size_t f, std::uint32_t begin, std::uint32_t end) {
    Result& result = results[f];
    if (!is_wanted(f)) return;
    for (std::uint32_t piece = begin; piece < end && result.status != Weak_status::visible; ++piece)
      for (std::uint32_t s = 0; s < sources.size(); ++s) {
        const auto& out_of_time = options.search.out_of_time;
        Weak_answer answer = out_of_time && out_of_time() ? nothing_known()
                                                          : Line_search(occluders, sources[s].polygon, sources[s].plane,
                                                                        occluders.polygon(piece), piece, options.search)
                                                                .run(result.counters);
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
  for (std::size_t f = 0; f < first.size(); ++f) {
    if (!is_wanted(f)) continue;
    Result& result = results[f];
    all.of(result.status).push_back(pieces[first[f]].face);
    all.counters += result.counters;
    for (Weakly_visible::Pair& pair : result.pairs) {
      if (result.status != Weak_status::undecided) all.pairs.push_back(std::move(pair));
      else if (pair.answer.status == Weak_status::undecided) all.open.push_back(std::move(pair));
    }
  }
  return all;
}

}  // namespace sightline
