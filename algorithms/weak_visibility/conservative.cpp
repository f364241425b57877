#include <sightline/algorithms/weak_visibility/conservative.h>

#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <iterator>
#include <utility>

namespace sightline {

std::optional<std::vector<Weak_step>> hidden_by_one_piece(const Occluders& occluders, const Weak_source& source,
                                                          std::uint32_t piece, bool two_sided) {
  using Kind = Weak_step::Kind;
  const Near_plane& plane = occluders.plane(piece);
  Near_polygon target = occluders.polygon(piece);
  std::vector<Weak_step> proof;
  const auto leaf = [&](const Near_polygon& from) -> std::optional<Weak_step> {
    const int towards = side(source.plane, target), back = side(plane, from);
    if (towards <= 0 || (back < 0 && !two_sided)) return Weak_step{Kind::away, 0, {}, {}};
    if (from.size() * target.size() > most_pairs) return {};
    std::vector<Pluecker> pairs;  // once they are asked for
    for (const std::uint32_t near : occluders.near_shaft(from, target)) {
      if (near == piece) continue;
      if (pairs.empty()) pairs = pairs_of(from, target);
      if (occluders.blocks_all(near, from, target, pairs)) return Weak_step{Kind::blocked, near, {}, {}};
    }
    return {};
  };
  const bool cut_target = is_across(source.plane, target);
  if (cut_target) {
    proof.push_back({Kind::cut_target, 0, source.plane.exact, {}});
    target = clip(occluders.frame(), target, source.plane, true);
  }
  const bool cut_source = is_across(plane, source.polygon);
  if (cut_source) proof.push_back({Kind::cut_source, 0, plane.exact, {}});
  for (const bool front : {true, false}) {
    if (!cut_source && !front) break;
    std::optional<Weak_step> step =
        leaf(cut_source ? clip(occluders.frame(), source.polygon, plane, front) : source.polygon);
    if (!step) return {};
    proof.push_back(std::move(*step));
  }
  if (cut_target) proof.push_back({Kind::away, 0, {}, {}});
  return proof;
}

Weakly_visible possibly_visible(const Occluders& occluders, const std::vector<Weak_source>& sources,
                                const Conservative_options& options) {
  struct Result {
    bool hidden = true;
    std::vector<Weakly_visible::Pair> proofs;
  };
  const std::vector<Piece>& pieces = occluders.scene().pieces();
  const std::vector<std::uint32_t> first = first_pieces(pieces);
  std::vector<Result> results(first.size());
  const auto decide = [&](std::size_t f, std::uint32_t begin, std::uint32_t end) {
    auto& [hidden, proofs] = results[f];
    for (std::uint32_t piece = begin; piece < end && hidden; ++piece)
      for (std::uint32_t s = 0; s < sources.size() && hidden; ++s) {
        std::optional<std::vector<Weak_step>> proof =
            hidden_by_one_piece(occluders, sources[s], piece, options.two_sided);
        hidden = proof.has_value();
        if (!hidden) break;
        Weak_answer& answer = proofs.emplace_back(Weakly_visible::Pair{piece, s, {}}).answer;
        answer.status = Weak_status::hidden;
        answer.proof = std::move(*proof);
      }
  };
  for_each_face(pieces, first, options.threads, options.progress, decide);

  Weakly_visible all;
  for (std::size_t f = 0; f < first.size(); ++f) {
    const Face_id face = pieces[first[f]].face;
    if (!results[f].hidden) {
      all.visible.push_back(face);
      all.unproved.push_back(face);
      continue;
    }
    all.hidden.push_back(face);
    std::move(results[f].proofs.begin(), results[f].proofs.end(), std::back_inserter(all.pairs));
  }
  return all;
}

}  // namespace sightline
