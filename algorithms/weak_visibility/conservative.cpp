#include <sightline/algorithms/weak_visibility/conservative.h>

#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <iterator>
#include <span>
#include <utility>

namespace sightline {
namespace {

/// Whether all lines from the inside of a source to that of a target are blocked by one piece: its plane is between
/// them, and on no pair of corners does a line pass an edge outside. Exact: yes. Proof: P-70
bool blocks_all(const Occluders& occluders, std::uint32_t piece, const Near_polygon& source, const Near_polygon& target,
                std::span<const Pluecker> pairs) {
  const int front = side(occluders.plane(piece), source);
  if (front == 0 || front == both_sides || side(occluders.plane(piece), target) != -front) return false;
  const std::span<const Triple> corners = occluders.corners(piece);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Ends of_edge = ends(size(corners[i]), size(corners[(i + 1) % corners.size()]));
    std::optional<Exact_pluecker> edge;  // once doubles do not tell
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      const Near_point &p = source[c / target.size()], &q = target[c % target.size()];
      const double value = front * dot(pairs[c], occluders.edges(piece)[i]),
                   bound = side_error(ends(size(p.near), size(q.near)), of_edge);
      if (value < -bound) return false;
      if (value > bound) continue;
      if (!edge) edge = occluders.exact_pluecker_of(occluders.edge_points(piece, i));
      if (front * sgn(dot(pluecker_of_pair(p.exact, q.exact), *edge)) < 0) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<std::vector<Weak_step>> hidden_by_one_piece(const Occluders& occluders, const Weak_source& source,
                                                          std::uint32_t piece, bool two_sided) {
  using Kind = Weak_step::Kind;
  const Near_plane& plane = occluders.plane(piece);
  Near_polygon target = occluders.polygon(piece);
  std::vector<Weak_step> proof;
  const auto leaf = [&](const Near_polygon& from) -> std::optional<Weak_step> {
    const int towards = side(source.plane, target), back = side(plane, from);
    if (towards <= 0 || (back < 0 && !two_sided)) return Weak_step{Kind::away, 0, {}, {}};
    std::vector<Pluecker> pairs;
    for (const Near_point& p : from)
      for (const Near_point& q : target) pairs.push_back(pluecker_of_pair(p.near, q.near));
    for (const std::uint32_t near : occluders.near_shaft(from, target))
      if (blocks_all(occluders, near, from, target, pairs)) return Weak_step{Kind::blocked, near, {}, {}};
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
