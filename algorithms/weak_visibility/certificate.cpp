#include <sightline/algorithms/weak_visibility/certificate.h>

#include <sightline/algorithms/covering_of_scene.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace sightline {

Weak_certificate weak_certificate(const Scene& scene, const std::vector<std::vector<Exact_point>>& sources,
                                  bool two_sided, const Weakly_visible& found) {
  Weak_certificate certificate;
  for (const std::vector<Exact_point>& points : sources) certificate.sources.push_back(strict_corners(points));
  certificate.two_sided = two_sided;
  std::set_union(found.undecided.begin(), found.undecided.end(), found.unproved.begin(), found.unproved.end(),
                 std::back_inserter(certificate.undecided));
  add_all(certificate, scene);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> numbers;
  // Of each source what one fragment blocks, and what is away, is told at once.
  std::map<std::tuple<std::uint32_t, Weak_step::Kind, std::uint32_t>, std::size_t> leaves;
  std::map<std::pair<std::uint32_t, const Shared_proof*>, std::size_t> shared;
  const auto told_with_another = [&](const Weakly_visible::Pair& pair) {
    if (pair.answer.shared) {
      const auto [place, is_new] =
          shared.try_emplace({pair.source, pair.answer.shared.get()}, certificate.hidden.size());
      if (!is_new) certificate.hidden[place->second].also.push_back(pair.piece);
      return !is_new;
    }
    if (pair.answer.proof.size() != 1) return false;
    const Weak_step& leaf = pair.answer.proof[0];
    if (leaf.kind != Weak_step::Kind::away && leaf.kind != Weak_step::Kind::blocked) return false;
    const std::uint32_t blocker = leaf.kind == Weak_step::Kind::blocked ? leaf.index : 0;
    const auto [place, is_new] = leaves.try_emplace({pair.source, leaf.kind, blocker}, certificate.hidden.size());
    if (!is_new) certificate.hidden[place->second].also.push_back(pair.piece);
    return !is_new;
  };
  for (const Weakly_visible::Pair& pair : found.pairs) {
    if (pair.answer.status == Weak_status::visible) {
      certificate.visible.push_back({pair.piece, pair.source, scene.position(pair.answer.sightline[0].exact),
                                     scene.position(pair.answer.sightline[1].exact)});
      continue;
    }
    const auto line_number = [&](std::uint32_t line) {
      const Weak_line& edge = pair.answer.all_lines()[line];
      const auto [place, is_new] = numbers.try_emplace({edge.piece, edge.corner}, certificate.lines.size());
      if (is_new) certificate.lines.push_back({edge.piece, edge.corner});
      return place->second;
    };
    if (told_with_another(pair)) continue;
    Weak_certificate::Hidden& hidden = certificate.hidden.emplace_back();
    hidden.fragment = pair.piece;
    hidden.source = pair.source;
    if (pair.answer.shared)
      for (const Near_point& corner : pair.answer.shared->target) hidden.target.push_back(scene.position(corner.exact));
    for (const Weak_step& step : pair.answer.all_steps()) {
      using Kind = Weak_certificate::Node::Kind;
      Weak_certificate::Node& node = hidden.proof.emplace_back();
      switch (step.kind) {
        case Weak_step::Kind::line: {
          node.kind = Kind::line;
          node.index = line_number(step.index);
        } break;
        case Weak_step::Kind::cut_source: {
          node.kind = Kind::cut_source;
          node.plane = scene.file_coefficients(step.plane);
        } break;
        case Weak_step::Kind::cut_target: {
          node.kind = Kind::cut_target;
          node.plane = scene.file_coefficients(step.plane);
        } break;
        case Weak_step::Kind::blocked: {
          node.kind = Kind::blocked;
          node.index = step.index;
        } break;
        case Weak_step::Kind::away: node.kind = Kind::away; break;
        case Weak_step::Kind::empty:
        case Weak_step::Kind::open: node.kind = Kind::empty; break;  // none is open where all is decided
      }
      for (const Weak_step::Term& term : step.terms) {
        const auto form = [&](const std::optional<Weak_step::Form>& h) {
          return h ? std::optional(scene.file_coefficients(*h)) : std::nullopt;
        };
        node.terms.push_back({line_number(term.line), term.factor, form(term.source), form(term.target)});
      }
    }
  }
  return certificate;
}

}  // namespace sightline
