#include <sightline/algorithms/solids/set_operation.h>

#include <sightline/algorithms/solids/assembly.h>
#include <sightline/algorithms/solids/box_tree.h>
#include <sightline/algorithms/solids/contacts.h>
#include <sightline/algorithms/solids/fragments.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/union_find.h>

#include <atomic>

namespace sightline {

namespace {

/// What is decided of a fragment.
struct Fragment_verdict {
  Result_fragment::Fate fate = Result_fragment::Fate::dropped;
  Fragment_sides sides;  // where a certificate is asked for
};

Fragment_verdict verdict_on(const Operands& operands, const Set_options& options, Fragment_sides sides) {
  Fragment_verdict verdict;
  const bool front = is_in_result(options.operation, options.inside, sides.front, operands.size());
  const bool behind = is_in_result(options.operation, options.inside, sides.behind, operands.size());
  if (front != behind) verdict.fate = front ? Result_fragment::Fate::turned : Result_fragment::Fate::kept;
  if (options.keep_fragments) verdict.sides = std::move(sides);
  return verdict;
}

Result_fragment reported(const Operands& operands, const Predicates& predicates, const Solid_fragment& fragment,
                         const Fragment_verdict& verdict) {
  const Piece& piece = operands.pieces()[fragment.piece];
  Result_fragment result;
  result.parts.push_back({piece.face, piece.number, false});
  for (const std::uint32_t other : fragment.upon)
    result.parts.push_back({operands.pieces()[other].face, operands.pieces()[other].number,
                            operands.pieces()[other].support != piece.support});
  result.front = verdict.sides.front;
  result.fate = verdict.fate;
  for (const Fragment_corner& corner : fragment.corners)
    result.corners.push_back(operands.position(predicates.homogeneous(corner.vertex)));
  return result;
}

}  // namespace

const char* name(Set_operation operation) {
  switch (operation) {
    case Set_operation::unite: return "union";
    case Set_operation::intersect: return "intersection";
    case Set_operation::subtract: return "difference";
    case Set_operation::differ: break;
  }
  return "symmetric-difference";
}

const char* name(Inside_rule rule) {
  return rule == Inside_rule::positive ? "positive" : rule == Inside_rule::nonzero ? "nonzero" : "odd";
}

bool is_in_result(Set_operation operation, Inside_rule rule, std::span<const Winding> windings, std::size_t operands) {
  std::size_t inside = 0;
  bool first = false;
  for (const Winding& w : windings) {
    const bool is_inside = rule == Inside_rule::positive  ? w.number > 0
                           : rule == Inside_rule::nonzero ? w.number != 0
                                                          : w.number % 2 != 0;
    inside += is_inside;
    first |= is_inside && w.operand == 0;
  }
  switch (operation) {
    case Set_operation::unite: return inside > 0;
    case Set_operation::intersect: return inside > 0 && inside == operands;
    case Set_operation::subtract: return first && inside == 1;
    case Set_operation::differ: break;
  }
  return inside % 2 != 0;
}

Set_result set_operation(const Operands& given, const Set_options& options) {
  // Of three stages, each as much of the way as another: what meets, cutting it, putting it together.
  const auto stage = [&](std::size_t number) {
    return [&options, number](std::size_t done, std::size_t all) {
      constexpr std::size_t parts = 1000;
      if (options.progress) options.progress(parts * number + parts * done / all, 3 * parts);
    };
  };
  Set_result result;
  Operands operands = given.with_room_for_edges();  // of pieces that are asked for them
  const auto pieces = static_cast<std::uint32_t>(operands.pieces().size());

  // 1. What meets what.
  const Box_tree tree(operands);
  stage(0)(0, 1);
  const Contacts found = contacts(operands, tree, stage(0));

  // 2. Pieces that meet no other, in patches; each of them has the winding numbers of its least piece.
  Union_find patches(pieces);  // by the least of each
  for (const auto& [i, j] : found.joined) patches.join(i, j);
  std::vector<std::uint32_t> touched, heads;
  for (std::uint32_t i = 0; i < pieces; ++i) {
    if (found.touched[i]) touched.push_back(i);
    else if (patches.find(i) == i) heads.push_back(i);
    if (!found.touched[i] && (patches.find(i) == i || !is_whole_face(operands, i))) operands.make_edges(i);
  }
  const Predicates predicates = operands.predicates();

  // 3. Cut what meets others; winding numbers of all fragments, and of a piece of each patch.
  std::vector<Piece_fragments> cut(touched.size());
  std::vector<std::vector<Fragment_verdict>> verdicts(touched.size());
  std::vector<Fragment_verdict> of_heads(heads.size());
  Per_thread<Predicate_counts> counts;
  std::atomic<std::size_t> begun = 0;
  parallel_for(heads.size() + touched.size(), [&](std::size_t i) {
    Predicate_counts& own = counts.local();
    const std::size_t done = begun++;
    const auto tell = [&] { stage(1)(done, heads.size() + touched.size()); };
    tell();
    if (i < heads.size()) {
      of_heads[i] = verdict_on(operands, options,
                               sides_of(operands, predicates, tree, whole(operands, predicates, heads[i]), own));
      return;
    }
    i -= heads.size();
    cut[i] = cut_piece(operands, predicates, found, touched[i], own);
    for (const Solid_fragment& fragment : cut[i].fragments) {
      verdicts[i].push_back(verdict_on(operands, options, sides_of(operands, predicates, tree, fragment, own)));
      tell();  // a piece may have very many
    }
  });

  // 4. What bounds the result.
  std::vector<Kept_fragment> kept;
  std::vector<std::pair<std::uint32_t, Fragment_mark>> marks;
  std::size_t fragments = 0;
  std::vector<std::uint32_t> head_place(pieces);
  kept.reserve(pieces);
  for (std::uint32_t h = 0; h < heads.size(); ++h) head_place[heads[h]] = h;
  for (std::uint32_t i = 0, t = 0; i < pieces; ++i) {
    if (options.keep_fragments) stage(1)(1, 1);  // their points take long
    if (!found.touched[i]) {
      ++fragments;
      const Fragment_verdict& verdict = of_heads[head_place[patches.find(i)]];
      if (options.keep_fragments)
        result.fragments.push_back(reported(operands, predicates, whole(operands, predicates, i), verdict));
      if (verdict.fate != Result_fragment::Fate::dropped)
        kept.push_back({i, verdict.fate == Result_fragment::Fate::turned, {}});
      continue;
    }
    bool any = false;
    fragments += cut[t].fragments.size();
    for (std::size_t f = 0; f < cut[t].fragments.size(); ++f) {
      const Result_fragment::Fate fate = verdicts[t][f].fate;
      if (options.keep_fragments)
        result.fragments.push_back(reported(operands, predicates, cut[t].fragments[f], verdicts[t][f]));
      if (fate == Result_fragment::Fate::dropped) continue;
      any = true;
      kept.push_back({i, fate == Result_fragment::Fate::turned, std::move(cut[t].fragments[f].corners)});
    }
    if (any)
      for (const Fragment_mark& mark : cut[t].marks) marks.emplace_back(i, mark);
    ++t;
  }
  assemble(operands, kept, marks, result, stage(2));
  stage(2)(1, 1);

  Set_counters& c = result.counters;
  c.faces = operands.counters().faces;
  c.pieces = pieces;
  c.planes = given.planes().size();
  c.bits = static_cast<std::size_t>(operands.points().bits());
  c.pairs = found.pairs;
  c.touched = touched.size();
  c.cuts = found.cuts.size();
  c.fragments = fragments;
  c.kept = kept.size();
  c.rays = heads.size();
  for (const auto& of_piece : verdicts) c.rays += of_piece.size();
  c.predicates += found.predicates;
  counts.for_each([&](const Predicate_counts& own) { c.predicates += own; });
  return result;
}

}  // namespace sightline
