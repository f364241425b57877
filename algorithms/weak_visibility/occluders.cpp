#include <sightline/algorithms/weak_visibility/occluders.h>

#include <sightline/kernel/predicates.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace sightline {
namespace {

constexpr std::size_t most_planes = 64;  // bits of a word

/// Planes with both polygons on them or in front: through an edge of one and a corner of the other, and around all of
/// them; less a little of their distance, of which half is more than what is lost to rounding. Proof: P-70
std::vector<std::array<double, 4>> shaft_planes(const Near_polygon& s, const Near_polygon& t) {
  std::vector<std::array<double, 4>> planes;
  double reach = 1;
  for (const Near_polygon* polygon : {&s, &t})
    for (const Near_point& p : *polygon) reach = std::max(reach, size(p.near));
  const double little = 1e-9 * reach;
  // `first`: corners that most likely show that it is none.
  const auto add = [&](Triple n, const Triple& through, std::initializer_list<const Near_point*> first) {
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(length > 1e-150 && std::isfinite(length))) return;
    for (double& x : n) x /= length;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    const auto in_front = [&] { return least > -little / 2; };
    const auto behind = [&] { return most < little / 2; };
    const auto goes_on = [&](const Near_point& p) {
      const double height =
          n[0] * (p.near[0] - through[0]) + n[1] * (p.near[1] - through[1]) + n[2] * (p.near[2] - through[2]);
      least = std::min(least, height);
      most = std::max(most, height);
      return in_front() || behind();  // or else no more corner will change that
    };
    for (const Near_point* p : first)
      if (!goes_on(*p)) return;
    for (const Near_polygon* polygon : {&s, &t})
      if (!std::all_of(polygon->begin(), polygon->end(), goes_on)) return;
    const double offset = n[0] * through[0] + n[1] * through[1] + n[2] * through[2];
    if (!std::isfinite(offset)) return;
    if (in_front()) planes.push_back({n[0], n[1], n[2], little - offset});
    else planes.push_back({-n[0], -n[1], -n[2], little + offset});
  };
  for (int turn = 0; turn < 2; ++turn) {
    const Near_polygon &own = turn == 0 ? s : t, &other = turn == 0 ? t : s;
    const std::size_t m = own.size(), n = other.size();
    for (std::size_t i = 0; i < m; ++i) {
      const Triple &a = own[i].near, &b = own[(i + 1) % m].near;
      for (std::size_t j = 0; j < n; ++j) {
        const Triple& c = other[j].near;
        add(cross(minus(b, a), minus(c, a)), a, {&own[(i + 2) % m], &other[(j + 1) % n], &other[(j + n - 1) % n]});
      }
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    Triple n{};
    n[k] = 1;
    const auto less = [&](const Near_point& a, const Near_point& b) { return a.near[k] < b.near[k]; };
    add(n,
        std::min(*std::min_element(s.begin(), s.end(), less), *std::min_element(t.begin(), t.end(), less), less).near,
        {});
    add(n,
        std::max(*std::max_element(s.begin(), s.end(), less), *std::max_element(t.begin(), t.end(), less), less).near,
        {});
  }
  // Most of them are given by several corners.
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  if (planes.size() > most_planes) planes.resize(most_planes);  // of polygons with many corners: any of them will do
  return planes;
}

/// What underflow may take from a coordinate, in those of boxes. Proof: P-70
double lost_in_boxes(double to_boxes) { return 0x1p-1000 * (1 + to_boxes); }

/// The box of a segment, for certain. Proof: P-70
Piece_boxes::Box box_around(const Triple& p, const Triple& q, double to_boxes) {
  Piece_boxes::Box around;
  for (std::size_t k = 0; k < 3; ++k) {
    around.low[k] = std::min(p[k], q[k]) * to_boxes;
    around.high[k] = std::max(p[k], q[k]) * to_boxes;
    const double slack =
        0x1p-50 * std::max(std::fabs(around.low[k]), std::fabs(around.high[k])) + lost_in_boxes(to_boxes);
    around.low[k] -= slack;
    around.high[k] += slack;
  }
  return around;
}
bool overlap(const Piece_boxes::Box& a, const Piece_boxes::Box& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.low[k] > b.high[k] || a.high[k] < b.low[k]) return false;
  return true;
}

/// Whether a segment certainly misses a box that its own box meets: a plane along it and an axis has the box on one
/// side. Proof: P-70
bool misses(const Piece_boxes::Box& box, const Triple& p, const Triple& q, double to_boxes) {
  const double lost = lost_in_boxes(to_boxes);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    const double nu = q[v] - p[v], nv = p[u] - q[u], pu = p[u] * to_boxes, pv = p[v] * to_boxes;
    const double middle = nu * ((box.low[u] + box.high[u]) / 2 - pu) + nv * ((box.low[v] + box.high[v]) / 2 - pv);
    const double reach =
        std::fabs(nu) * (box.high[u] - box.low[u]) / 2 + std::fabs(nv) * (box.high[v] - box.low[v]) / 2;
    const double of_segment = std::fabs(p[u]) + std::fabs(q[u]) + std::fabs(p[v]) + std::fabs(q[v]),
                 of_box = std::fabs(pu) + std::fabs(pv) + std::fabs(box.low[u]) + std::fabs(box.high[u]) +
                          std::fabs(box.low[v]) + std::fabs(box.high[v]);
    if (std::fabs(middle) > reach + 0x1p-49 * (8 * of_segment * of_box) + lost * (1 + of_segment) * (1 + of_box))
      return true;
  }
  return false;
}

/// A segment in the coordinates of boxes, for proposals.
struct Segment_of_boxes {
  Triple above, below;  // its first end, by a little
  Triple inverse;       // of its length along each axis

  Segment_of_boxes(const Triple& p, const Triple& q, double to_boxes) {
    Triple from, along;
    for (std::size_t k = 0; k < 3; ++k) {
      from[k] = p[k] * to_boxes;
      along[k] = (q[k] - p[k]) * to_boxes;
      inverse[k] = std::clamp(1 / along[k], -0x1p900, 0x1p900);  // where it is flat, too
    }
    const double slack = 1e-12 * (sightline::size(from) + sightline::size(along));
    for (std::size_t k = 0; k < 3; ++k) {
      above[k] = from[k] + slack;
      below[k] = from[k] - slack;
    }
  }
  bool is_near(const Piece_boxes::Box& box) const {
    double enter = 0, leave = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = (box.low[k] - above[k]) * inverse[k], b = (box.high[k] - below[k]) * inverse[k];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
  }
};

/// Coordinates whose ways have a determinant of less than 128 bits.
constexpr int most_small_bits = 40;
using Small_point = std::array<std::int64_t, 3>;

std::optional<Small_point> small_point(const Near_point& p) {
  if (p.exact[3] != 1) return std::nullopt;
  Small_point small;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!fits_int64(p.exact[k])) return std::nullopt;
    small[k] = p.exact[k].get_si();
    constexpr std::int64_t most = std::int64_t{1} << most_small_bits;
    if (small[k] < -most || small[k] > most) return std::nullopt;
  }
  return small;
}

Ends ends_of_edge(std::span<const Triple> polygon, std::size_t i) {
  return ends(size(polygon[i]), size(polygon[(i + 1) % polygon.size()]));
}

bool same_plane(const Near_plane& g, const Near_plane& h) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = i + 1; k < 4; ++k)
      if (g.exact[i] * h.exact[k] != g.exact[k] * h.exact[i]) return false;
  return true;
}

}  // namespace

Occluders::Occluders(const Scene& scene) : scene_(&scene), frame_(scene), boxes_(scene) {
  const Predicates predicates = scene.predicates();
  for (const Piece& piece : scene.pieces())
    planes_.push_back(near_plane(frame_, predicates.coefficients(piece.support)));
  constexpr std::uint32_t nowhere = ~std::uint32_t{0};
  first_.assign(scene.pieces().size(), nowhere);
  for (const Piece_boxes::Chunk& chunk : boxes_.chunks()) {
    const Piece& piece = scene.pieces()[chunk.piece];
    std::uint32_t& first = first_[chunk.piece];
    if (first == nowhere) {
      first = static_cast<std::uint32_t>(corners_.size());
      for (const Piece_corner& corner : scene.corners(piece)) corners_.push_back(near(corner.point));
      for (std::size_t i = 0; i < piece.size; ++i)
        edges_.push_back(pluecker_of_edge(corners_[first + i], corners_[first + (i + 1) % piece.size]));
    }
    entries_.push_back({planes_[chunk.piece].near, chunk.piece, first, piece.size});
  }
  list_pieces_at_points();
  if (frame_.has_exact_points()) return;
  rests_.resize(scene.points().size());
  parallel_for(rests_.size(), [&](std::size_t p) {
    const std::uint32_t point = static_cast<std::uint32_t>(p);
    for (int k = 0; k < 3; ++k)
      rests_[p][static_cast<std::size_t>(k)] = frame_.rest(grid(point, k), Integer(1), frame_.near(scene, point, k));
  });
}

void Occluders::list_pieces_at_points() {
  const std::vector<Piece>& pieces = scene_->pieces();
  first_at_.assign(scene_->points().size() + 1, 0);
  for (const Piece& piece : pieces)
    for (const Piece_corner& corner : scene_->corners(piece)) ++first_at_[corner.point + 1];
  for (std::size_t p = 1; p < first_at_.size(); ++p) first_at_[p] += first_at_[p - 1];
  pieces_at_.resize(first_at_.back());
  std::vector<std::uint32_t> next(first_at_.begin(), first_at_.end() - 1);
  for (std::uint32_t i = 0; i < pieces.size(); ++i)
    for (const Piece_corner& corner : scene_->corners(pieces[i])) pieces_at_[next[corner.point]++] = i;
}

void Occluders::put_in_order(std::vector<std::uint32_t>& pieces) const {
  if (entries_.size() == planes_.size()) return;
  std::sort(pieces.begin(), pieces.end(), [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
}

Near_polygon Occluders::polygon(std::uint32_t piece) const {
  Near_polygon corners;
  for (const Piece_corner& corner : scene_->corners(scene_->pieces()[piece]))
    corners.push_back({{grid(corner.point, 0), grid(corner.point, 1), grid(corner.point, 2), Integer(1)},
                       near(corner.point),
                       rest_of(corner.point)});
  return corners;
}

int Occluders::side_of(std::uint32_t piece, const Near_plane& h) const {
  bool front = false, behind = false;
  const std::span<const Piece_corner> all = scene_->corners(scene_->pieces()[piece]);
  for (std::size_t i = 0; i < all.size(); ++i) {
    int s = likely_side(h, corners(piece)[i]);
    if (s == 0) {
      const std::array<Integer, 3> p = grid_point(all[i].point);
      s = sgn(Integer(h.exact[0] * p[0] + h.exact[1] * p[1] + h.exact[2] * p[2] + h.exact[3]));
    }
    front |= s > 0;
    behind |= s < 0;
  }
  return front && behind ? both_sides : front ? 1 : behind ? -1 : 0;
}

std::optional<int> Occluders::small_side(const Near_point& p, const Near_point& q,
                                         const std::array<std::uint32_t, 2>& points) const {
  if (scene_->points().bits() > most_small_bits) return std::nullopt;
  const std::optional<Small_point> from = small_point(p), to = small_point(q);
  if (!from || !to) return std::nullopt;
  // The determinant of the ways from p to q, from a to b and from p to a.
  std::array<__int128, 3> way, along, between;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t a = scene_->points().small(points[0], static_cast<int>(k)),
                       b = scene_->points().small(points[1], static_cast<int>(k));
    way[k] = (*to)[k] - (*from)[k];
    along[k] = b - a;
    between[k] = a - (*from)[k];
  }
  const __int128 side = way[0] * (along[1] * between[2] - along[2] * between[1]) +
                        way[1] * (along[2] * between[0] - along[0] * between[2]) +
                        way[2] * (along[0] * between[1] - along[1] * between[0]);
  return side > 0 ? 1 : side < 0 ? -1 : 0;
}

std::vector<std::uint32_t> Occluders::near_shaft(const Near_polygon& s, const Near_polygon& t) const {
  const std::vector<std::array<double, 4>> shaft = shaft_planes(s, t);
  const double to_boxes = frame_.to_boxes();
  const std::span<const Piece_boxes::Node> nodes = boxes_.nodes();
  std::vector<std::uint32_t> found;
  struct Waiting {
    std::uint32_t node;
    std::uint64_t across;  // which planes may have a part of its box behind
  };
  std::vector<Waiting> stack;
  if (!nodes.empty()) stack.push_back({0, shaft.empty() ? 0 : ~std::uint64_t{0} >> (most_planes - shaft.size())});
  // What one plane keeps away, it often does with the next one, too.
  std::size_t last = 0;
  const auto any_of = [&](std::uint64_t planes, auto keeps_away) {
    if ((planes >> last & 1) != 0) {
      if (keeps_away(last)) return true;
      planes ^= std::uint64_t{1} << last;
    }
    for (; planes != 0; planes &= planes - 1) {
      const std::size_t i = static_cast<std::size_t>(std::countr_zero(planes));
      if (!keeps_away(i)) continue;
      last = i;
      return true;
    }
    return false;
  };
  while (!stack.empty()) {
    const std::uint32_t at = stack.back().node;
    std::uint64_t across = stack.back().across;
    stack.pop_back();
    const Piece_boxes::Node& node = nodes[at];
    // 1. The box: whether a plane keeps it away, and which ones no part of it.
    Triple middle, reach;
    for (std::size_t k = 0; k < 3; ++k) {
      middle[k] = (node.box.low[k] / 2 + node.box.high[k] / 2);
      reach[k] = (node.box.high[k] / 2 - node.box.low[k] / 2);
    }
    const bool away = any_of(across, [&](std::size_t i) {
      const std::array<double, 4>& h = shaft[i];
      const double height = h[3] * to_boxes + h[0] * middle[0] + h[1] * middle[1] + h[2] * middle[2],
                   extent = std::fabs(h[0]) * reach[0] + std::fabs(h[1]) * reach[1] + std::fabs(h[2]) * reach[2];
      if (height - extent >= 0) across &= ~(std::uint64_t{1} << i);
      return height + extent < 0;
    });
    if (away) continue;
    // 2. Its parts.
    if (node.second != 0) {
      stack.push_back({node.second, across});
      stack.push_back({at + 1, across});
      continue;
    }
    for (const Entry& entry : entries_of(node)) {
      const std::span<const Triple> polygon = corners_of(entry);
      const auto keeps_away = [&](std::size_t i) {
        const std::array<double, 4>& h = shaft[i];
        return std::all_of(polygon.begin(), polygon.end(), [&](const Triple& p) { return likely_value(h, p) < 0; });
      };
      if (!any_of(across, keeps_away)) found.push_back(entry.piece);
    }
  }
  put_in_order(found);
  return found;
}

std::vector<std::uint32_t> Occluders::near_segment(const Triple& p, const Triple& q, double margin) const {
  const Segment_of_boxes segment(p, q, frame_.to_boxes());
  const Pluecker pluecker = pluecker_of_pair(p, q);
  std::vector<std::uint32_t> found;
  each_box([&](const Piece_boxes::Box& box) { return segment.is_near(box); },
           [&](const Entry& entry) {
             const double at_p = likely_value(entry.plane, p), at_q = likely_value(entry.plane, q);
             if (std::fabs(at_p) > margin && std::fabs(at_q) > margin) {
               if ((at_p > 0) == (at_q > 0)) return;
               const double sense = at_p > 0 ? 1 : -1;
               for (const Pluecker& edge : edges_of(entry))
                 if (sense * dot(pluecker, edge) < -margin) return;
             }
             found.push_back(entry.piece);
           });
  put_in_order(found);
  return found;
}

std::optional<std::uint32_t> Occluders::on_segment(const Segment& segment,
                                                   const std::function<bool(std::uint32_t)>& accept,
                                                   std::span<const Segment> beside) const {
  std::vector<Segment_of_boxes> all{{segment[0], segment[1], frame_.to_boxes()}};
  for (const Segment& other : beside) all.emplace_back(other[0], other[1], frame_.to_boxes());
  const auto is_near_all = [&](const Piece_boxes::Box& box) {
    return std::all_of(all.begin(), all.end(), [&](const Segment_of_boxes& one) { return one.is_near(box); });
  };
  const Pluecker pluecker = pluecker_of_pair(segment[0], segment[1]);
  std::optional<std::uint32_t> found;
  each_box([&](const Piece_boxes::Box& box) { return !found && is_near_all(box); },
           [&](const Entry& entry) {
             if (found) return;
             const std::array<double, 4>& h = entry.plane;
             const double at_p = likely_value(h, segment[0]), at_q = likely_value(h, segment[1]);
             if ((at_p > 0) == (at_q > 0)) return;
             const double sense = at_p > 0 ? 1 : -1;
             const std::span<const Pluecker> edges = edges_of(entry);
             if (std::all_of(edges.begin(), edges.end(),
                             [&](const Pluecker& edge) { return sense * dot(pluecker, edge) > 0; }) &&
                 accept(entry.piece))
               found = entry.piece;
           });
  return found;
}

bool Occluders::blocks_all(std::uint32_t piece, const Near_polygon& source, const Near_polygon& target,
                           std::span<const Pluecker> pairs) const {
  // 1. Most do not, and doubles tell: a line passes outside of an edge.
  if (lets_pass(piece, source, target, pairs)) return false;
  // 2. Its plane is between the polygons.
  const int front = side(planes_[piece], source);
  if (front == 0 || front == both_sides || side(planes_[piece], target) != -front) return false;
  // 3. On no pair of corners does a line pass an edge outside.
  const std::span<const Triple> polygon = corners(piece);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Ends of_edge = ends_of_edge(polygon, i);
    std::optional<Exact_pluecker> edge;  // once doubles do not tell
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      const Near_point &p = source[c / target.size()], &q = target[c % target.size()];
      const double height = front * dot(pairs[c], edges(piece)[i]),
                   bound = side_error(ends(sightline::size(p.near), sightline::size(q.near)), of_edge);
      if (height < -bound) return false;
      if (height > bound) continue;
      const std::optional<int> small = small_side(p, q, edge_points(piece, i));
      if (!small && !edge) edge = exact_pluecker_of(edge_points(piece, i));
      const int sign = small ? *small : sgn(sightline::dot(pluecker_of_pair(p.exact, q.exact), *edge));
      if (front * sign < 0) return false;
    }
  }
  return true;
}

bool Occluders::lets_pass(std::uint32_t piece, const Near_polygon& source, const Near_polygon& target,
                          std::span<const Pluecker> pairs) const {
  int front = 0;  // if the plane is between them at all
  for (std::size_t i = 0; i < source.size() && front == 0; ++i) front = likely_side(planes_[piece], source[i].near);
  if (front == 0) return false;
  // What its edges let pass is asked of all pairs of corners, in vain where the plane is the target's own, say.
  if (std::none_of(target.begin(), target.end(),
                   [&](const Near_point& q) { return likely_side(planes_[piece], q.near) == -front; }))
    return false;
  const auto reach = [](const Near_polygon& of) {
    double most = 0;
    for (const Near_point& p : of) most = std::max(most, sightline::size(p.near));
    return most;
  };
  const Ends of_pairs = ends(reach(source), reach(target));
  const std::span<const Triple> polygon = corners(piece);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const double bound = side_error(of_pairs, ends_of_edge(polygon, i));
    const Pluecker& edge = edges(piece)[i];
    for (const Pluecker& pair : pairs)
      if (front * dot(pair, edge) < -bound) return true;
  }
  return false;
}

std::optional<Occluders::Hit> Occluders::first_hit(const Triple& p, const Triple& direction) const {
  const Triple ahead{p[0] + direction[0], p[1] + direction[1], p[2] + direction[2]};
  const Pluecker pluecker = pluecker_of_pair(p, ahead);
  const double to_boxes = frame_.to_boxes();
  double nearest = std::numeric_limits<double>::infinity();
  std::optional<Hit> hit;
  each_box(
      [&](const Piece_boxes::Box& box) {
        double enter = 0, leave = nearest * (1 + 1e-9);
        for (std::size_t k = 0; k < 3; ++k) {
          const double a = (box.low[k] / to_boxes - p[k]) / direction[k],
                       b = (box.high[k] / to_boxes - p[k]) / direction[k];
          if (direction[k] == 0 ? p[k] * to_boxes < box.low[k] || p[k] * to_boxes > box.high[k] : false) return false;
          if (direction[k] != 0) {
            enter = std::max(enter, std::min(a, b) - 1e-12);
            leave = std::min(leave, std::max(a, b) + 1e-12);
          }
        }
        return enter <= leave;
      },
      [&](const Entry& entry) {
        const std::array<double, 4>& h = entry.plane;
        const double height = likely_value(h, p),
                     slope = h[0] * direction[0] + h[1] * direction[1] + h[2] * direction[2];
        const double at = -height / slope;
        if (!(at > 1e-9) || at >= nearest) return;
        const double sense = height > 0 ? 1 : -1;
        const std::span<const Pluecker> all = edges_of(entry);
        if (std::all_of(all.begin(), all.end(),
                        [&](const Pluecker& edge) { return sense * dot(pluecker, edge) >= 0; })) {
          nearest = at;
          hit = Hit{entry.piece, height > 0};
        }
      });
  return hit;
}

std::optional<std::uint32_t> Occluders::blocker(const Near_point& p, const Near_point& q, const Near_plane& of_p,
                                                const Near_plane& of_q) const {
  const Exact_pluecker pair = pluecker_of_pair(p.exact, q.exact);
  const Pluecker near_pair = pluecker_of_pair(p.near, q.near);
  const double to_boxes = frame_.to_boxes();
  const Piece_boxes::Box around = box_around(p.near, q.near, to_boxes);
  std::optional<std::uint32_t> found;
  each_box(
      [&](const Piece_boxes::Box& box) {
        return !found && overlap(box, around) && !misses(box, p.near, q.near, to_boxes);
      },
      [&](const Entry& entry) {
        if (!found && meets(entry.piece, p, q, of_p, of_q, pair, near_pair)) found = entry.piece;
      });
  return found;
}

template <class Open, class Visit>
void Occluders::each_box(Open open, Visit visit) const {
  const std::span<const Piece_boxes::Node> nodes = boxes_.nodes();
  if (nodes.empty()) return;
  std::array<std::uint32_t, 64> stack{};  // a tree of halves is less deep
  std::size_t waiting = 1;
  while (waiting > 0) {
    const std::uint32_t at = stack[--waiting];
    if (!open(nodes[at].box)) continue;
    if (nodes[at].second != 0) {
      stack[waiting++] = nodes[at].second;
      stack[waiting++] = at + 1;
    } else
      for (const Entry& entry : entries_of(nodes[at])) visit(entry);
  }
}

bool Occluders::meets(std::uint32_t piece, const Near_point& p, const Near_point& q, const Near_plane& of_p,
                      const Near_plane& of_q, const Exact_pluecker& pair, const Pluecker& near_pair) const {
  const int at_p = side(planes_[piece], p), at_q = side(planes_[piece], q);
  if (at_p == 0 && at_q == 0) return true;  // not looked at further
  if (at_p * at_q > 0) return false;
  if ((at_p == 0 && same_plane(planes_[piece], of_p)) || (at_q == 0 && same_plane(planes_[piece], of_q))) return false;
  const int from = at_p != 0 ? at_p : -at_q;
  const Ends of_pair = ends(sightline::size(p.near), sightline::size(q.near));
  const std::span<const Triple> polygon = corners(piece);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const double value = from * sightline::dot(near_pair, edges(piece)[i]);
    const double bound = side_error(of_pair, ends_of_edge(polygon, i));
    if (value < -bound) return false;
    if (value > bound) continue;
    if (from * sgn(sightline::dot(pair, exact_pluecker_of(edge_points(piece, i)))) < 0) return false;
  }
  return true;
}

}  // namespace sightline
