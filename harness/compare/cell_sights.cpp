#include <sightline/harness/compare/cell_sights.h>

#include <sightline/algorithms/levels/pvs.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <span>

namespace sightline {

/// Whether what is met first on the way is at its end: faces that the eye sees edge-on hide nothing, but may be met.
static bool is_free(const Model& model, const Exact_point& from, const Exact_point& to) {
  const Exact_ray way{from, minus(to, from)};
  const std::vector<Face_hit> first = trace(model, std::span(&way, 1)).front();
  return !first.empty() && first.front().t == 1;
}

std::vector<Cell_sightline> Cell_sights::sightlines(Cell_id cell, const std::vector<Face_id>& faces,
                                                    const Is_over& is_over) {
  // 1. From the middle.
  std::map<Face_id, Cell_sightline> found;
  const Exact_point middle = level_->inside(cell);
  const std::map<Face_id, Seen_face>& seen = seen_from(middle, is_over);
  Weak_options options;
  for (const Face_id face : faces) {
    const auto place = seen.find(face);
    if (place != seen.end() && is_free(*model_, middle, place->second.middle))
      found.emplace(face, Cell_sightline{face, middle, place->second.middle});
    else options.faces.push_back(face);
  }

  // 2. Through portals.
  if (!options.faces.empty()) {
    options.threads = 1;
    options.search.out_of_time = is_over;
    std::vector<Weak_source> sources;
    for (const std::vector<Exact_point>& portal : portals_of(*level_, cell))
      sources.push_back(weak_source(*occluders_, portal));
    const Scene& scene = level_->scene();
    for (const Weakly_visible::Pair& pair : weakly_visible(*occluders_, sources, options).pairs) {
      if (pair.answer.status != Weak_status::visible) continue;
      const Face_id face = scene.pieces()[pair.piece].face;
      const Exact_point through = scene.position(pair.answer.sightline[0].exact),
                        to = scene.position(pair.answer.sightline[1].exact);
      const auto back_by = [&](const Rational& share) {
        Exact_point from;
        for (std::size_t k = 0; k < 3; ++k) from[k] = through[k] + share * (through[k] - to[k]);
        return from;
      };
      Rational share(512);  // as far back as doubling the way goes within the cell, or reaches its wall
      while (level_->at(back_by(share)) != cell) share /= 2;
      found.emplace(face, Cell_sightline{face, back_by(share * Rational(3, 4)), to});
    }
  }

  std::vector<Cell_sightline> all;
  for (const auto& [face, line] : found) all.push_back(line);
  return all;
}

Seen_face Cell_sights::seen(const Exact_point& eye, Face_id face, const Is_over& is_over) {
  const std::map<Face_id, Seen_face>& all = seen_from(eye, is_over);
  const auto place = all.find(face);
  return place == all.end() ? Seen_face() : place->second;
}

const std::map<Face_id, Seen_face>& Cell_sights::seen_from(const Exact_point& eye, const Is_over& is_over) {
  if (const auto place = seen_.find(eye); place != seen_.end()) return place->second;
  Asking asking;
  asking.threads = 1;
  if (is_over)
    asking.progress = [&](std::size_t, std::size_t) {
      if (is_over()) throw Out_of_budget("undecided: the budget ran out before all sizes were measured");
    };
  return seen_.emplace(eye, seen_faces(*model_, eye, asking)).first->second;
}

}  // namespace sightline
