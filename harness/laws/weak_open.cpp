#include <sightline/harness/laws/weak_open.h>

#include <sightline/algorithms/weak_visibility/events/events.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/labels.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace sightline::harness {

namespace open_lines {

/// The sign of det[p, q, a, b], in homogeneous coordinates.
int side_of_line(const Exact_point& p, const Exact_point& q, const Exact_point& a, const Exact_point& b) {
  return -sgn(dot(cross(minus(q, p), minus(a, p)), minus(b, p)));
}

/// Whether a line from p in the source to q in the target is in a cell, or on its border.
bool is_in(const Open_cell& cell, const std::vector<Flat_face>& faces, const Exact_point& p, const Exact_point& q) {
  if (cell.source.size() < 3 || cell.target.size() < 3) return false;
  if (!Flat_face(cell.source).holds(p) || !Flat_face(cell.target).holds(q)) return false;
  return std::all_of(cell.sides.begin(), cell.sides.end(), [&](const Open_cell::Side& side) {
    const generate::Points& corners = faces[side.edge.piece].corners;
    const Exact_point &a = corners[side.edge.corner], &b = corners[(side.edge.corner + 1) % corners.size()];
    return side_of_line(p, q, a, b) * side.sign >= 0;
  });
}

/// What is wrong with which pairs are open: of each undecided face one at least is, and of no other face any.
std::string flaw_of_open(const Scene& scene, const Weakly_visible& found) {
  std::vector<Face_id> faces;
  for (const Weakly_visible::Pair& open : found.open) {
    if (open.answer.status != Weak_status::undecided) return "a pair is open and decided";
    const Face_id face = scene.pieces()[open.piece].face;
    if (faces.empty() || faces.back() != face) faces.push_back(face);
  }
  return faces == found.undecided ? "" : "undecided faces are not those with open pairs";
}

Outcome run(const Posed_scene& posed, const Answer& answer, Random& random) {
  constexpr std::size_t most_pieces = 10, most_cells = 2000, most_shown = 1000;
  if (!random.chance(1, 4)) return Outcome::not_applicable();
  const Scene scene(posed.soup);
  if (scene.pieces().size() > most_pieces) return Outcome::not_applicable();
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, posed.source)};
  const std::vector<Flat_face> faces = flat_faces_of(scene);

  // 1. Hardly any search, and sightlines by more of it.
  Weak_options options;
  options.threads = 1;
  options.search.cells = most_cells;
  const Weakly_visible whole = weakly_visible(occluders, sources, options);
  options.search.cells = 1 + random.below(12);
  options.search.rays = 0;
  Weakly_visible found = weakly_visible(occluders, sources, options);
  if (const std::string flaw = flaw_of_open(scene, found); !flaw.empty()) return Outcome::failed(flaw);
  if (found.open.empty()) return Outcome::not_applicable();
  for (const Weakly_visible::Pair& open : found.open) {
    const std::vector<Open_cell> cells = open_cells(occluders, sources[0], open, most_shown);
    if (cells.empty())
      return Outcome::failed("piece " + std::to_string(open.piece) + " is open, but none of its cells");
    for (const Weakly_visible::Pair& seen : whole.pairs) {
      if (seen.piece != open.piece || seen.answer.status != Weak_status::visible) continue;
      const Exact_point p = scene.position(seen.answer.sightline[0].exact),
                        q = scene.position(seen.answer.sightline[1].exact);
      if (std::none_of(cells.begin(), cells.end(), [&](const Open_cell& cell) { return is_in(cell, faces, p, q); }))
        return Outcome::failed("a sightline to piece " + std::to_string(open.piece) + " is in no open cell");
    }
  }

  // 2. Events of what is open, or of its parts, where few enough edges are near: often just fewer than are near all of
  // a pair, so that they may be enough for its cells.
  std::size_t most_edges = random.chance(1, 8) ? 0 : random.below(40);
  const std::size_t most_asks = random.chance(1, 3) ? random.below(300) : 20000;
  if (most_edges > 0 && random.chance(1, 2))
    most_edges = edges_between(occluders, sources[0], found.open[0].piece) - std::size_t{1 + random.below(4)};
  const bool is_whole = std::all_of(found.open.begin(), found.open.end(), [&](const Weakly_visible::Pair& open) {
    return edges_between(occluders, sources[0], open.piece) <= most_edges;
  });
  Events_options events;
  events.threads = 1;
  events.rays = random.chance(1, 2) ? 0 : 4;
  std::size_t asks = 0, told = 0;
  events.out_of_time = [&] { return ++asks > most_asks; };
  events.progress = [&](std::size_t done, std::size_t all) { told += done <= all; };
  const std::size_t open_before = found.open.size();
  const Event_counters counters = settle_by_events(occluders, sources, most_edges, events, found);
  if (most_edges == 0 && counters.targets > 0) return Outcome::failed("events are asked though no edges may be near");
  if (told > open_before) return Outcome::failed("events tell more often than there are pairs");
  if (is_whole && asks <= most_asks && !found.undecided.empty())
    return Outcome::failed(face_name(found.undecided[0]) +
                           " is undecided although few edges are near and there is time");
  Answer settled;
  settled.labels.assign(posed.soup.face_count(), Answer::none);
  label_weakly_seen(found, settled);
  const Outcome outcome = compared(answer, settled, "the search", "events of open cells");
  return outcome.state == Outcome::State::failed ? outcome : Outcome{};
}

}  // namespace open_lines

Check open_check() {
  return {"open", "lines that see are in cells that hardly any search left open, and events decide these",
          open_lines::run};
}

}  // namespace sightline::harness
