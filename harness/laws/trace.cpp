#include <sightline/harness/laws/trace.h>

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/rays/by_tree.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/harness/generate/rays.h>
#include <sightline/harness/laws/judge_laws.h>
#include <sightline/harness/laws/laws.h>
#include <sightline/harness/laws/manners.h>
#include <sightline/harness/laws/questions.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/sightline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace sightline::harness {

namespace trace_subject {

// ---- By the definition

using Loops = std::vector<std::vector<Exact_point>>;

Exact_point minus(const Exact_point& a, const Exact_point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Exact_point product(const Exact_point& a, const Exact_point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Rational dot(const Exact_point& a, const Exact_point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The outer loop's Newell normal.
Exact_point normal_of(const Loops& loops) {
  Exact_point normal{0, 0, 0};
  const std::vector<Exact_point>& loop = loops[0];
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Exact_point n = product(loop[k], loop[(k + 1) % loop.size()]);
    for (std::size_t i = 0; i < 3; ++i) normal[i] += n[i];
  }
  return normal;
}

using Flat_point = std::array<Rational, 2>;
Rational turn(const Flat_point& u, const Flat_point& v) { return u[0] * v[1] - u[1] * v[0]; }

/// Of a point: where the loops' edges go from it, and how far from it along a direction the first other edge is met.
struct Edges_from {
  std::vector<std::array<Flat_point, 2>> others;  // from the point
  std::vector<Flat_point> directions;

  Edges_from(const Loops& loops, std::size_t x, std::size_t y, const Exact_point& p) {
    for (const std::vector<Exact_point>& loop : loops)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Exact_point &a = loop[k], &b = loop[(k + 1) % loop.size()];
        const Flat_point from{a[x] - p[x], a[y] - p[y]}, to{b[x] - p[x], b[y] - p[y]};
        if (turn(from, to) != 0 || from[0] * to[0] + from[1] * to[1] > 0) {
          others.push_back({from, to});
          continue;
        }
        for (const Flat_point& end : {from, to})
          if (end != Flat_point{0, 0}) directions.push_back(end);
      }
  }
  bool is_on_an_edge() const { return !directions.empty(); }
  bool goes_along_an_edge(const Flat_point& way) const {
    return std::any_of(directions.begin(), directions.end(),
                       [&](const Flat_point& d) { return turn(d, way) == 0 && d[0] * way[0] + d[1] * way[1] > 0; });
  }
  /// Whether what is next to the point in a direction is inside: what is on the way there before any other edge.
  bool is_inside_towards(const Flat_point& way) const {
    Rational before = 1;
    for (const auto& [from, to] : others) {
      const Flat_point edge{to[0] - from[0], to[1] - from[1]};
      const Rational across = turn(way, edge);
      if (across == 0) {
        if (turn(way, from) == 0)
          for (const Flat_point& end : {from, to}) {
            const Rational s = (end[0] * way[0] + end[1] * way[1]) / (way[0] * way[0] + way[1] * way[1]);
            if (s > 0) before = std::min(before, s);
          }
        continue;
      }
      const Rational s = turn(from, edge) / across, share = turn(from, way) / across;
      if (s > 0 && 0 <= share && share <= 1) before = std::min(before, s);
    }
    return is_inside({way[0] * before / 2, way[1] * before / 2});
  }
  /// Whether a place, from the point, is inside: an odd number of edges is beyond it. Pre: it is on none.
  bool is_inside(const Flat_point& q) const {
    bool inside = false;
    const auto pass = [&](const Flat_point& a, const Flat_point& b) {
      const Flat_point edge{b[0] - a[0], b[1] - a[1]}, to_q{q[0] - a[0], q[1] - a[1]};
      if ((a[1] <= q[1]) != (b[1] <= q[1]) && (turn(edge, to_q) > 0) == (a[1] < b[1])) inside = !inside;
    };
    for (const auto& [from, to] : others) pass(from, to);
    for (const Flat_point& d : directions) pass({0, 0}, d);
    return inside;
  }
};

/// Whether a point of the plane is inside, or on an edge beside which there is an inside: spikes hold nothing.
bool holds(const Loops& loops, const Exact_point& normal, const Exact_point& p) {
  const std::size_t across = normal[2] != 0 ? 2 : normal[1] != 0 ? 1 : 0;
  const Edges_from edges(loops, (across + 1) % 3, (across + 2) % 3, p);
  if (!edges.is_on_an_edge()) return edges.is_inside({0, 0});
  // Between two neighbours among the directions, in less than half a turn, in half of one, or in more.
  for (const Flat_point& d : edges.directions)
    for (const Flat_point& e : edges.directions)
      for (const Flat_point& way : {Flat_point{d[0] + e[0], d[1] + e[1]}, Flat_point{-d[0] - e[0], -d[1] - e[1]},
                                    Flat_point{-d[1], d[0]}, Flat_point{d[1], -d[0]}})
        if (way != Flat_point{0, 0} && !edges.goes_along_an_edge(way) && edges.is_inside_towards(way)) return true;
  return false;
}

/// The parts of a face joined: a hit begins where a part does that no earlier one reaches, from the first side in the
/// order of their names that begins there, and ends where nothing goes on. Not by hits_of(), which is judged by it.
void join(const std::vector<Face_hit>& parts, Ray_start start, std::vector<Face_hit>& hits) {
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Rational& begin = parts[k].t;
    Met_side side = parts[k].side;
    bool is_begun = start == Ray_start::open && begin == 0;
    for (std::size_t j = 0; j < parts.size(); ++j) {
      const bool is_there = parts[j].t == begin;
      is_begun = is_begun || (is_there ? j < k : parts[j].t < begin && begin <= parts[j].until);
      if (is_there) side = std::min(side, parts[j].side);
    }
    if (is_begun) continue;
    Rational end = parts[k].until;
    for (bool grows = true; grows;) {
      grows = false;
      for (const Face_hit& part : parts)
        if (begin <= part.t && part.t <= end && end < part.until) {
          end = part.until;
          grows = true;
        }
    }
    hits.push_back({parts[k].face, side, begin, end});
  }
}

/// Those of the least t.
std::vector<Face_hit> nearest_of(const std::vector<Face_hit>& hits) {
  std::vector<Face_hit> nearest;
  for (const Face_hit& hit : hits)
    if (std::none_of(hits.begin(), hits.end(), [&](const Face_hit& other) { return other.t < hit.t; }))
      nearest.push_back(hit);
  return nearest;
}

void add_parts(Face_id face, const Loops& loops, const Exact_ray& ray, std::vector<Face_hit>& parts) {
  const Exact_point normal = normal_of(loops);
  const Rational slope = dot(normal, ray.direction), height = dot(normal, minus(loops[0][0], ray.origin));
  if (slope != 0) {
    const Rational t = height / slope;
    if (t >= 0 && holds(loops, normal, point_at(ray, t)))
      parts.push_back({face, slope < 0 ? Met_side::front : Met_side::back, t, t});
    return;
  }
  if (height != 0) return;
  // In the plane: inside or outside changes where an edge is met.
  std::set<Rational> places{0};
  const Exact_point across = product(normal, ray.direction);
  const Rational length = dot(ray.direction, ray.direction);
  for (const std::vector<Exact_point>& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Exact_point a = minus(loop[k], ray.origin), b = minus(loop[(k + 1) % loop.size()], ray.origin);
      const Rational side_a = dot(across, a), side_b = dot(across, b);
      if (side_a == 0) places.insert(dot(a, ray.direction) / length);
      if (side_a * side_b < 0) {
        Exact_point p;
        for (std::size_t i = 0; i < 3; ++i) p[i] = a[i] + (b[i] - a[i]) * side_a / (side_a - side_b);
        places.insert(dot(p, ray.direction) / length);
      }
    }
  const Rational* before = nullptr;
  for (const Rational& t : places) {
    if (t < 0) continue;
    if (holds(loops, normal, point_at(ray, t))) parts.push_back({face, Met_side::along, t, t});
    if (before != nullptr && holds(loops, normal, point_at(ray, Rational((*before + t) / 2))))
      parts.push_back({face, Met_side::along, *before, t});
    before = &t;
  }
}

// ---- Checks

std::string text_of(const std::vector<Face_hit>& hits) {
  std::string text;
  for (const Face_hit& hit : hits)
    text += (text.empty() ? "" : ", ") + std::to_string(hit.face) + "/" + std::to_string(static_cast<int>(hit.side)) +
            " at " + sightline::to_string(hit.t) + (hit.until == hit.t ? "" : " to " + sightline::to_string(hit.until));
  return text.empty() ? "nothing" : text;
}
std::string text_of(const Exact_ray& ray) {
  std::string text;
  for (const Exact_point* p : {&ray.origin, &ray.direction})
    for (const Rational& x : *p) text += (text.empty() ? "" : ",") + sightline::to_string(x);
  return text;
}

constexpr Ray_start starts[] = {Ray_start::open, Ray_start::closed};

/// What `other` says of random rays, moved by `move`, all hits of each, or the first ones.
template <class Other>
Check same_hits(
    const std::string& name, const std::string& what, std::size_t times, Other other,
    void (*move)(Exact_ray&, Random&) = [](Exact_ray&, Random&) {}) {
  return {name, what, [times, name, other, move](const Posed_scene& posed, const Answer&, Random& random) {
            const Scene scene(posed.soup);
            const Ray_tracer tracer(scene);
            const auto theirs = other(posed, scene);
            Ray_counters counters;
            for (std::size_t k = 0; k < times; ++k)
              for (const generate::Ray_kind& kind : generate::ray_kinds()) {
                Exact_ray ray = kind.make(posed.soup, random);
                move(ray, random);
                const Ray_start start = starts[random.below(2)];
                const auto wrong = [&](const std::vector<Face_hit>& mine, const std::vector<Face_hit>& its) {
                  return Outcome::failed("ray " + text_of(ray) + ", " + std::string(kind.name) + ": " + text_of(mine) +
                                         " is met, " + name + " says " + text_of(its));
                };
                const std::vector<Face_hit> all = tracer.all(ray, start, counters), its = theirs(ray, start);
                if (all != its) return wrong(all, its);
                const std::vector<Face_hit> first = tracer.first(ray, start, counters);
                if (first != nearest_of(its)) return wrong(first, nearest_of(its));
              }
            return Outcome{};
          }};
}

Check by_tree() {
  return same_hits("tree", "the same hits by a BSP tree", 3, [](const Posed_scene&, const Scene& scene) {
    struct Tree {
      Exact_traits traits;
      Exact_tree tree;
    };
    Bsp_options options;
    options.threads = 1;
    auto made = std::make_shared<Tree>(Tree{Exact_traits(scene), {}});
    made->tree = build_bsp(made->traits, options);
    return [made](const Exact_ray& ray, Ray_start start) {
      std::vector<Face_hit> all = all_hits(made->traits, made->tree, ray, start);
      // Its own first hits, which it finds otherwise: if they are others, a hit of no face, which nobody else has.
      if (first_hits(made->traits, made->tree, ray, start) != nearest_of(all))
        all = {{~Face_id{0}, Met_side::along, Rational(-1), Rational(-1)}};
      return all;
    };
  });
}

auto loops_of_each_face(const Posed_scene& posed, const Scene& scene) {
  return [&](const Exact_ray& ray, Ray_start start) { return hits_by_definition(posed.soup, scene, ray, start); };
}
Check by_definition() {
  return same_hits("definition", "the same hits by the loops of each face", 3, loops_of_each_face);
}

/// So far away, and often in so small steps, that doubles do not hold the ray.
void move_beyond_doubles(Exact_ray& ray, Random& random) {
  const Rational distance = generate::power_of_two(static_cast<int>(random.between(900, 2200)));
  const bool far_behind = random.chance(1, 8), short_steps = random.chance(1, 2);
  const Rational step = short_steps ? generate::power_of_two(-static_cast<int>(random.between(600, 2200))) : 1;
  for (std::size_t k = 0; k < 3; ++k) {
    ray.origin[k] -= distance * ray.direction[k];
    ray.direction[k] *= far_behind ? Rational(-step) : step;
  }
}
Check from_beyond_doubles() {
  return same_hits("beyond", "the same hits by the loops of each face, of rays from beyond doubles", 1,
                   loops_of_each_face, move_beyond_doubles);
}

/// All rays at once, at times more than threads take together, by up to four threads.
Outcome ask_front_door(const Posed_scene& posed, const Answer&, Random& random) {
  constexpr std::size_t many = 600;  // in blocks of 256
  const Scene scene(posed.soup);
  const Ray_tracer tracer(scene);
  std::vector<Exact_ray> rays;
  for (const generate::Ray_kind& kind : generate::ray_kinds()) rays.push_back(kind.make(posed.soup, random));
  if (random.chance(1, 8))
    for (std::size_t k = 0; rays.size() < many; ++k) rays.push_back(rays[k]);
  random.shuffle(rays);
  const Ray_start start = starts[random.below(2)];
  const Model model(posed.soup);
  const Asking asking{static_cast<int>(random.below(5)), {}, 3600};
  const auto first = sightline::trace(model, rays, start, asking), all = trace_all(model, rays, start, asking);
  if (first.size() != rays.size() || all.size() != rays.size())
    return Outcome::failed("the front door does not answer for each ray");
  std::vector<Double_ray> doubles;
  Ray_counters counters;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const auto expected = tracer.all(rays[k], start, counters);
    if (all[k] != expected || first[k] != nearest_of(expected))
      return Outcome::failed("ray " + text_of(rays[k]) + " in the front door's place " + std::to_string(k) + ": " +
                             text_of(all[k]) + " is met, first " + text_of(first[k]) + "; asked alone " +
                             text_of(expected));
    if (const Double_ray ray = sightline::in_doubles(rays[k]); is_ray(ray)) doubles.push_back(ray);
  }
  const std::vector<Nearest_face> near = nearest(model, doubles, start, asking);
  if (near.size() != doubles.size()) return Outcome::failed("the front door does not answer for each ray in doubles");
  for (std::size_t k = 0; k < doubles.size(); ++k) {
    const Ray_tracer::Nearest alone = tracer.nearest(doubles[k], start, counters);
    const auto told = [](const auto& hit) { return std::tie(hit.face, hit.side, hit.tied, hit.low, hit.high); };
    if (told(near[k]) != told(alone))
      return Outcome::failed("ray " + text_of(doubles[k].exact()) + " in doubles, in the front door's place " +
                             std::to_string(k) + ", meets another face than asked alone");
  }
  return {};
}

Check by_front_door() {
  return {"front_door", "the same hits from sightline/sightline.h, of many rays at once and by threads",
          ask_front_door};
}

/// Rays in doubles, whose first hit is found without exact numbers as a rule.
Check in_doubles() {
  return {"doubles", "the same first face, and bounds that hold, for rays in doubles",
          [](const Posed_scene& posed, const Answer&, Random& random) {
            const Scene scene(posed.soup);
            const Ray_tracer tracer(scene);
            Ray_counters counters;
            for (std::size_t k = 0; k < 4; ++k)
              for (const generate::Ray_kind& kind : generate::ray_kinds()) {
                const Exact_ray drawn = kind.make(posed.soup, random);
                const Double_ray ray = sightline::in_doubles(drawn);
                if (!is_ray(ray)) continue;
                const Ray_start start = starts[random.below(2)];
                const std::vector<Face_hit> exact = tracer.first(ray.exact(), start, counters);
                const Ray_tracer::Nearest near = tracer.nearest(ray, start, counters);
                if (!is_first(near, exact))
                  return Outcome::failed("ray " + text_of(ray.exact()) + ": " + text_of(exact) +
                                         " is met, in doubles face " + std::to_string(near.face));
              }
            return Outcome{};
          }};
}

/// What an eye sees is what a ray from it meets first.
Check as_seen() {
  return {"see", "a ray from the eye to the middle of each part that is seen meets it there first",
          [](const Posed_scene& posed, const Answer& answer, Random&) {
            if (!answer.planar) return Outcome::not_applicable();
            const Scene scene(posed.soup);
            const Ray_tracer tracer(scene);
            const Piece_boxes boxes(scene);
            const Exact_view view(scene, posed.eye);
            Visible_options options;
            options.threads = 1;
            const auto surface = visible_surface(view, boxes, options);
            Ray_counters counters;
            for (const auto& part : surface.parts) {
              if (part.piece == surface.nothing) continue;
              const std::vector<Exact_point> corners = vertices(view, surface, part);
              Exact_ray ray{posed.eye, {0, 0, 0}};
              for (const Exact_point& p : corners)
                for (std::size_t k = 0; k < 3; ++k) ray.direction[k] += p[k] / static_cast<long>(corners.size());
              ray.direction = minus(ray.direction, posed.eye);
              std::vector<Face_hit> hits = tracer.all(ray, Ray_start::open, counters);
              std::erase_if(hits, [](const Face_hit& hit) { return hit.side == Met_side::along; });  // edge-on
              const Face_id face = scene.pieces()[part.piece].face;
              if (hits.empty() || hits[0].t != 1 ||
                  std::none_of(hits.begin(), hits.end(), [&](const Face_hit& h) { return h.t == 1 && h.face == face; }))
                return Outcome::failed("face " + std::to_string(face) + " is seen, ray " + text_of(ray) + " meets " +
                                       text_of(hits));
            }
            return Outcome{};
          }};
}

/// 1, 2, 4: some ray from the eye to a corner of a piece meets the face first from its front, from behind, along it. Of
/// faces that are not planar, which a ray may meet from several sides at once, nothing.
Answer labels(const Posed_scene& posed) {
  const Scene scene(posed.soup);
  Answer answer;
  answer.labels.assign(posed.soup.face_count(), Answer::none);
  answer.planar = scene.counters().non_planar + scene.counters().no_simple_projection == 0;
  for (const Piece& piece : scene.pieces()) answer.labels[piece.face] = 0;
  const Ray_tracer tracer(scene);
  Ray_counters counters;
  for (const Piece& piece : scene.pieces())
    for (const Piece_corner& corner : scene.corners(piece)) {
      const Exact_ray ray{posed.eye, minus(scene.position(corner.point), posed.eye)};
      if (ray.direction == Exact_point{0, 0, 0}) continue;
      for (const Face_hit& hit : tracer.first(ray, Ray_start::open, counters))
        answer.labels[hit.face] |= 1u << static_cast<unsigned>(hit.side);
    }
  for (const Face_id face : scene.non_planar()) answer.labels[face] = Answer::none;
  return answer;
}

}  // namespace trace_subject

bool is_first(const Ray_tracer::Nearest& near, const std::vector<Face_hit>& first) {
  if (first.empty()) return near.face == Ray_tracer::Nearest::nothing;
  return near.face == first[0].face && near.side == first[0].side && near.tied == (first.size() > 1) &&
         (!std::isfinite(near.low) || exact(near.low) <= first[0].t) &&
         (!std::isfinite(near.high) || first[0].t <= exact(near.high));
}

std::vector<Face_hit> hits_by_definition(const Polygon_soup& soup, const Scene& scene, const Exact_ray& ray,
                                         Ray_start start) {
  using namespace trace_subject;
  std::set<Face_id> kept, skew(scene.non_planar().begin(), scene.non_planar().end());
  for (const Piece& piece : scene.pieces()) kept.insert(piece.face);
  std::map<Face_id, std::vector<Face_hit>> parts;
  for (const Face_id face : kept) {
    if (skew.contains(face)) continue;
    Loops loops(soup.loop_count(face));
    for (std::size_t k = 0; k < loops.size(); ++k)
      for (const Point_id p : soup.loop(face, k)) loops[k].push_back(soup.point(p));
    add_parts(face, loops, ray, parts[face]);
  }
  for (const Piece& piece : scene.pieces()) {
    if (!skew.contains(piece.face)) continue;
    Loops loops(1);
    loops[0] = scene.corner_points(piece);
    add_parts(piece.face, loops, ray, parts[piece.face]);
  }
  std::vector<Face_hit> hits;
  for (const auto& [face, its] : parts) join(its, start, hits);
  std::sort(hits.begin(), hits.end(),
            [](const Face_hit& a, const Face_hit& b) { return a.t != b.t ? a.t < b.t : a.face < b.face; });
  return hits;
}

std::vector<Face_hit> first_by_definition(const Polygon_soup& soup, const Scene& scene, const Exact_ray& ray,
                                          Ray_start start) {
  return trace_subject::nearest_of(hits_by_definition(soup, scene, ray, start));
}

Subject trace() {
  using namespace trace_subject;
  Subject subject;
  subject.name = "trace";
  subject.what = "what rays meet, first and at all, by boxes, by a BSP tree and by the definition";
  subject.answer = labels;
  subject.checks = {by_definition(), by_tree(), in_doubles(), as_seen()};
  add_laws(subject, {"begin", "permute", "translate", "scale", "rotate", "stretch", "mirror", "turn"});
  subject.checks.push_back(by_front_door());  // last: others keep their random choices
  subject.checks.push_back(judged_rays_check());
  subject.checks.push_back(from_beyond_doubles());
  subject.checks.push_back(manners_check(questions_of_trace()));
  return subject;
}

}  // namespace sightline::harness
