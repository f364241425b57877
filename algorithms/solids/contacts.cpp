#include <sightline/algorithms/solids/contacts.h>

#include <sightline/kernel/predicates.h>
#include <sightline/kernel/threads.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <optional>

namespace sightline {

namespace {

/// A closed segment, a point of which both ends are one, or nothing.
struct Stretch {
  enum class Kind { nothing, point, segment } kind = Kind::nothing;
  Vertex from, to;
};

/// Two pieces, i < j, that doubles do not tell apart, and what they have in common.
struct Near_pair {
  static constexpr std::uint32_t no_corner = ~std::uint32_t{0};
  std::uint32_t i, j;
  std::uint32_t corner;       ///< the only common point, or no_corner
  bool has_common, has_edge;  ///< common points; both ends of an edge
};

/// An edge that two pieces have in common, with both ends.
struct Common_edge {
  std::uint32_t i, j;  ///< the pieces
  std::uint32_t k, l;  ///< the edges' first corners, counted on through all pieces
  bool is_against;     ///< whether they run against each other
};

/// What is found of some leaves' pairs.
struct Leaf_contacts {
  std::vector<Near_pair> near;
  std::vector<Cut> cuts;
  std::vector<Touch> touches;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> upon;
  std::vector<std::uint32_t> touched;
  std::vector<Common_edge> edges;
  std::size_t pairs = 0;
  Predicate_counts predicates;
};

/// What most pairs are settled by: a piece's plane in doubles, and the bound below which they do not tell an input
/// point's side (P-03); two axes in which the piece, seen from its front, is counterclockwise; and the corners of a
/// triangle.
struct Near_piece {
  double a, b, c, d, bound;
  std::uint32_t u, v;
  std::uint32_t piece, support, first;
  std::array<std::uint32_t, 3> point;  // of other pieces no_triangle
  std::array<std::array<double, 3>, 3> corner;

  static constexpr std::uint32_t no_triangle = ~std::uint32_t{0};
  bool is_triangle() const { return point[0] != no_triangle; }
};

/// All of them, in the order of the tree's leaves: those that are compared stand together.
struct Near_pieces {
  std::vector<Near_piece> pieces;
  double error;  // of each coordinate

  Near_pieces(const Operands& operands, const Box_tree& tree) : pieces(tree.order().size()) {
    const Predicates predicates = operands.predicates();
    const Grid_points& grid = operands.points();
    error = grid.bits() <= 53 ? 0 : 0x1p-53 * grid.range() + 0x1p-1000;  // as in input_vertex()
    for (std::size_t place = 0; place < pieces.size(); ++place) {
      Near_piece& near = pieces[place];
      near.piece = tree.order()[place];
      const Piece& piece = operands.pieces()[near.piece];
      const Prepared_plane h = predicates.prepare(piece.support);
      const std::array<double, 3> n{h.a, h.b, h.c};
      std::uint32_t axis = 0;
      for (std::uint32_t k = 1; k < 3; ++k)
        if (std::fabs(n[k]) > std::fabs(n[axis])) axis = k;
      const std::uint32_t one = axis == 2 ? 0 : axis + 1, other = axis == 0 ? 2 : axis - 1;
      near.a = h.a;
      near.b = h.b;
      near.c = h.c;
      near.d = h.d;
      near.bound = (h.bound + error * h.norm) * (1 + 0x1p-50);
      near.u = n[axis] > 0 ? one : other;
      near.v = n[axis] > 0 ? other : one;
      near.support = piece.support.id();
      near.first = piece.first;
      near.point[0] = Near_piece::no_triangle;
      if (piece.size != 3) continue;
      const std::span<const Piece_corner> corners = operands.corners(near.piece);
      for (std::size_t k = 0; k < 3; ++k) {
        near.point[k] = corners[k].point;
        near.corner[k] = {grid.approximate(near.point[k], 0), grid.approximate(near.point[k], 1),
                          grid.approximate(near.point[k], 2)};
      }
    }
  }
};

/// A piece's corners, in doubles.
struct Near_outline {
  std::span<const std::uint32_t> point;
  std::span<const std::array<double, 3>> at;
  std::size_t size() const { return point.size(); }
};

/// Tells most pairs apart, in doubles, and notes which edges they have in common.
class Pair_filter {
 public:
  Pair_filter(const Operands& operands, const Near_pieces& near, Leaf_contacts& found)
      : operands_(operands), near_(near), found_(found) {}

  /// Looks at piece i and j + k for each bit k of `met`: places in the tree's order.
  void look_at(std::uint32_t i, std::uint32_t j, unsigned met) {
    const Near_piece& p = near_.pieces[i];
    for (; met != 0; met &= met - 1) {
      const Near_piece& q = near_.pieces[j + static_cast<std::uint32_t>(std::countr_zero(met))];
      ++found_.pairs;
      // Most pairs are triangles, in planes of their own.
      if (p.support != q.support && p.is_triangle() && q.is_triangle()) look_at_triangles(p, q);
      else if (p.piece < q.piece) look_at_any(p, q);
      else look_at_any(q, p);
    }
  }

 private:
  void look_at_any(const Near_piece& p, const Near_piece& q) {
    const bool coplanar = p.support == q.support;
    const Near_outline a = outline_of(p.piece, rooms_[0]), b = outline_of(q.piece, rooms_[1]);
    // 1. Common corners and edges.
    std::size_t common = 0;
    Near_pair pair{p.piece, q.piece, Near_pair::no_corner, false, false};
    for (std::size_t k = 0; k < a.size(); ++k)
      for (std::size_t l = 0; l < b.size(); ++l) {
        if (a.point[k] != b.point[l]) continue;
        pair.corner = ++common == 1 ? a.point[k] : Near_pair::no_corner;
        const std::size_t k1 = k + 1 == a.size() ? 0 : k + 1, l1 = l + 1 == b.size() ? 0 : l + 1;
        const std::size_t l0 = l == 0 ? b.size() - 1 : l - 1;
        const bool with = a.point[k1] == b.point[l1], against = a.point[k1] == b.point[l0];
        if (!with && !against) continue;
        found_.edges.push_back({p.piece, q.piece, p.first + static_cast<std::uint32_t>(k),
                                q.first + static_cast<std::uint32_t>(with ? l : l0), against});
        // In different planes they share the line of the edge, and of that line each has no more than the edge.
        if (!coplanar) return;
        pair.has_edge = true;
      }
    pair.has_common = common > 0;
    // 2. Whether doubles tell them apart.
    if (!coplanar && common <= 1 &&
        (is_clearly_apart(p, b, common) || is_clearly_apart(q, a, common) || is_clearly_beside(p, a, b, pair.corner) ||
         is_clearly_beside(q, b, a, pair.corner)))
      return;
    found_.near.push_back(pair);
  }

  void look_at_triangles(const Near_piece& a, const Near_piece& b) {
    const unsigned which = common_corners(a.point, b.point);
    if ((which & (which - 1)) != 0) {  // two: an edge, opposite to the corner of each that is not common
      const auto missing = [](unsigned common) { return static_cast<std::size_t>(std::countr_one(common)); };
      const auto in_row = [which](unsigned k) { return static_cast<unsigned>((which >> (3 * k) & 7) != 0) << k; };
      const std::size_t k = missing(in_row(0) | in_row(1) | in_row(2));
      const std::size_t l = missing((which | which >> 3 | which >> 6) & 7);
      const std::size_t from = k == 2 ? 0 : k + 1, of_other = l == 2 ? 0 : l + 1;
      found_.edges.push_back({a.piece, b.piece, a.first + static_cast<std::uint32_t>(from),
                              b.first + static_cast<std::uint32_t>(of_other), a.point[from] != b.point[of_other]});
      return;
    }
    const std::size_t common = which != 0;
    const Near_outline of_a{a.point, a.corner}, of_b{b.point, b.corner};
    if (is_clearly_apart(a, of_b, common) || is_clearly_apart(b, of_a, common)) return;
    const std::uint32_t corner =
        common == 1 ? a.point[static_cast<std::size_t>(std::countr_zero(which)) / 3] : Near_pair::no_corner;
    if (is_clearly_beside(a, of_a, of_b, corner) || is_clearly_beside(b, of_b, of_a, corner)) return;
    found_.near.push_back({std::min(a.piece, b.piece), std::max(a.piece, b.piece), corner, common == 1, false});
  }

  /// Bit 3 k + l where corner k of one triangle is corner l of the other.
  static unsigned common_corners(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
    unsigned which = 0;
    for (unsigned k = 0; k < 3; ++k)
      for (unsigned l = 0; l < 3; ++l) which |= static_cast<unsigned>(a[k] == b[l]) << (3 * k + l);
    return which;
  }

  /// The corners of the piece that was asked for last: one of many corners is compared with many in turn.
  struct Outline_room {
    std::optional<std::uint32_t> piece;
    std::vector<std::uint32_t> point;
    std::vector<std::array<double, 3>> at;
  };
  Near_outline outline_of(std::uint32_t piece, Outline_room& room) const {
    if (room.piece == piece) return {room.point, room.at};
    room.piece = piece;
    const Grid_points& grid = operands_.points();
    room.point.clear();
    room.at.clear();
    for (const Piece_corner& corner : operands_.corners(piece)) {
      const std::uint32_t p = corner.point;
      room.point.push_back(p);
      room.at.push_back({grid.approximate(p, 0), grid.approximate(p, 1), grid.approximate(p, 2)});
    }
    return {room.point, room.at};
  }

  /// Whether doubles tell that all of another piece but a corner that they share, if they share one, is on one side of
  /// this one.
  bool is_clearly_apart(const Near_piece& h, const Near_outline& other, std::size_t common) {
    std::size_t front = 0, behind = 0;
    for (const std::array<double, 3>& p : other.at) {
      const double value = h.a * p[0] + h.b * p[1] + h.c * p[2] + h.d;
      front += value > h.bound;
      behind += value < -h.bound;
    }
    const std::size_t all = other.size() - common;  // a common corner is on the plane: neither
    if (front != all && behind != all) return false;
    found_.predicates.filtered += other.size();
    return true;
  }

  /// Whether doubles tell that an edge of a piece, at its common corner with another one, if there is one, has all of
  /// that but the corner on its outside, as seen along an axis. Proof of the bound: P-110
  bool is_clearly_beside(const Near_piece& piece, const Near_outline& a, const Near_outline& b, std::uint32_t corner) {
    const std::size_t u = piece.u, v = piece.v;
    for (std::size_t k = 0; k < a.size(); ++k) {
      const std::size_t k1 = k + 1 == a.size() ? 0 : k + 1;
      const std::uint32_t from = a.point[k], to = a.point[k1];
      if (corner != Near_pair::no_corner && from != corner && to != corner) continue;
      const std::array<double, 3>&p = a.at[k], &q = a.at[k1];
      const double x = q[u] - p[u], y = q[v] - p[v];
      const auto is_outside = [&](std::size_t l) {
        if (b.point[l] == corner) return true;
        const std::array<double, 3>& r = b.at[l];
        const double dx = r[u] - p[u], dy = r[v] - p[v];
        const double size = std::fabs(x) + std::fabs(y) + std::fabs(dx) + std::fabs(dy);
        const double bound =
            0x1p-50 * (std::fabs(x * dy) + std::fabs(y * dx)) + 4 * near_.error * (size + 2 * near_.error) + 0x1p-1000;
        return x * dy - y * dx < -bound;
      };
      bool outside = true;
      for (std::size_t l = 0; outside && l < b.size(); ++l) outside = is_outside(l);
      if (!outside) continue;
      found_.predicates.filtered += b.size();
      return true;
    }
    return false;
  }

  const Operands& operands_;
  const Near_pieces& near_;
  Leaf_contacts& found_;
  std::array<Outline_room, 2> rooms_;
};

/// Finds what near pairs have in common. Pre: edges are made.
class Pair_finder {
 public:
  Pair_finder(const Operands& operands, Leaf_contacts& found)
      : operands_(operands), predicates_(operands.predicates()), found_(found) {}

  void look_at(const Near_pair& pair) {
    if (support(pair.i).id() == support(pair.j).id()) look_at_coplanar(pair);
    else look_at_crossing(pair);
  }

 private:
  Plane support(std::uint32_t i) const { return operands_.pieces()[i].support; }

  Sign side(const Vertex& v, const Prepared_plane& h) { return predicates_.side(v, h, found_.predicates); }

  /// The sides of a piece's corners to a plane.
  struct Sides {
    std::vector<Sign> of;
    bool front = false, behind = false, on = false;
  };
  void find_sides(std::uint32_t i, const Prepared_plane& h, Sides& sides) {
    const std::size_t size = operands_.corners(i).size();
    sides.of.resize(size);
    sides.front = sides.behind = sides.on = false;
    for (std::size_t k = 0; k < size; ++k) {
      const Sign s = side(operands_.vertex(predicates_, i, k), h);
      sides.of[k] = s;
      sides.front |= s == CGAL::POSITIVE;
      sides.behind |= s == CGAL::NEGATIVE;
      sides.on |= s == CGAL::ZERO;
    }
  }

  /// Where piece i meets a plane that is not its own.
  Stretch in_plane(std::uint32_t i, const Sides& sides, Plane plane) const {
    Stretch stretch;
    const auto add = [&](const Vertex& v) {
      if (stretch.kind == Stretch::Kind::nothing) {
        stretch.kind = Stretch::Kind::point;
        stretch.from = stretch.to = v;
      } else {
        stretch.kind = Stretch::Kind::segment;
        stretch.to = v;
      }
    };
    const std::span<const Piece_corner> corners = operands_.corners(i);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Sign here = sides.of[k], next = sides.of[k + 1 == corners.size() ? 0 : k + 1];
      if (here == CGAL::ZERO) add(operands_.vertex(predicates_, i, k));
      else if (next == -here) add(predicates_.meet(support(i).id(), corners[k].edge.id(), plane.id()));
    }
    return stretch;
  }

  /// What of a stretch in the meet of two planes is on piece j, which lies in one of them.
  void clip(Stretch& stretch, std::uint32_t p, std::uint32_t q, std::uint32_t j) {
    for (const Piece_corner& corner : operands_.corners(j)) {
      if (stretch.kind == Stretch::Kind::nothing) return;
      const Prepared_plane bound = predicates_.prepare(corner.edge);
      const Sign from = side(stretch.from, bound);
      const Sign to = stretch.kind == Stretch::Kind::point ? from : side(stretch.to, bound);
      if (from == CGAL::NEGATIVE && to == CGAL::NEGATIVE) stretch.kind = Stretch::Kind::nothing;
      else if (from == CGAL::NEGATIVE && to == CGAL::ZERO) stretch = {Stretch::Kind::point, stretch.to, stretch.to};
      else if (from == CGAL::ZERO && to == CGAL::NEGATIVE) stretch = {Stretch::Kind::point, stretch.from, stretch.from};
      else if (from == CGAL::NEGATIVE) stretch.from = predicates_.meet(p, q, corner.edge.id());
      else if (to == CGAL::NEGATIVE) stretch.to = predicates_.meet(p, q, corner.edge.id());
    }
  }

  void touch(std::uint32_t i, const Stretch& stretch) {
    found_.touched.push_back(i);
    found_.touches.push_back({i, stretch.from});
    if (stretch.kind == Stretch::Kind::segment) found_.touches.push_back({i, stretch.to});
  }
  void cut(std::uint32_t i, std::uint32_t j, const Stretch& stretch, Plane plane) {
    found_.touched.push_back(i);
    found_.cuts.push_back({i, j, plane, stretch.from, stretch.to});
  }

  /// Pieces in different planes.
  void look_at_crossing(const Near_pair& pair) {
    const auto [i, j, corner, has_common, has_edge] = pair;
    const bool in_corner = corner != Near_pair::no_corner;
    find_sides(j, predicates_.prepare(support(i)), sides_j_);
    if (is_apart(sides_j_)) return;
    if (in_corner && is_touching_once(sides_j_)) return;  // in the common corner
    find_sides(i, predicates_.prepare(support(j)), sides_i_);
    if (is_apart(sides_i_)) return;
    if (in_corner && is_touching_once(sides_i_)) return;
    Stretch stretch = in_plane(i, sides_i_, support(j));
    clip(stretch, support(i).id(), support(j).id(), j);
    if (stretch.kind == Stretch::Kind::nothing) return;
    if (stretch.kind == Stretch::Kind::point && in_corner && stretch.from.is_input() && stretch.from.point == corner)
      return;
    const bool is_segment = stretch.kind == Stretch::Kind::segment;
    if (is_segment && sides_i_.front && sides_i_.behind) cut(i, j, stretch, support(j));
    else touch(i, stretch);
    if (is_segment && sides_j_.front && sides_j_.behind) cut(j, i, stretch, support(i));
    else touch(j, stretch);
  }
  static bool is_apart(const Sides& sides) { return !sides.on && !(sides.front && sides.behind); }
  /// Pre: a corner is on the plane.
  static bool is_touching_once(const Sides& sides) {
    return !(sides.front && sides.behind) && std::count(sides.of.begin(), sides.of.end(), CGAL::ZERO) == 1;
  }

  /// Whether an edge of piece i has all of piece j on its outside: in front of it, no corner of j. `touching`: whether
  /// j touches its line then; in more than one corner.
  bool is_separated(std::uint32_t i, std::uint32_t j, bool& apart, bool& by_corner) {
    for (const Piece_corner& corner : operands_.corners(i)) {
      find_sides(j, predicates_.prepare(corner.edge), sides_j_);
      if (sides_j_.front) continue;
      const auto on = std::count(sides_j_.of.begin(), sides_j_.of.end(), CGAL::ZERO);
      apart |= on == 0;
      by_corner |= on == 1;
      separated_ = true;
    }
    return separated_;
  }

  /// Pieces in one plane, of which either faces either way.
  void look_at_coplanar(const Near_pair& pair) {
    const std::uint32_t i = pair.i, j = pair.j;
    bool apart = false, by_corner = false;
    separated_ = false;
    is_separated(i, j, apart, by_corner);
    if (!apart) is_separated(j, i, apart, by_corner);
    if (apart) return;
    const bool shares_area = !separated_;
    if (!shares_area && by_corner && pair.has_common) return;  // in a corner of both
    if (!shares_area && pair.has_edge) return;
    if (shares_area) {
      found_.upon.emplace_back(i, j);
      found_.upon.emplace_back(j, i);
    }
    lay_upon(i, j, shares_area);
    lay_upon(j, i, shares_area);
  }

  /// The edges of piece j in piece i.
  void lay_upon(std::uint32_t i, std::uint32_t j, bool shares_area) {
    found_.touched.push_back(i);
    const std::span<const Piece_corner> edges = operands_.corners(j);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      Stretch stretch{Stretch::Kind::segment, operands_.vertex(predicates_, j, k),
                      operands_.vertex(predicates_, j, k + 1 == edges.size() ? 0 : k + 1)};
      clip(stretch, support(i).id(), edges[k].edge.id(), i);
      if (stretch.kind == Stretch::Kind::nothing) continue;
      if (stretch.kind == Stretch::Kind::segment && shares_area && !is_on_boundary(i, stretch))
        cut(i, j, stretch, edges[k].edge);
      else touch(i, stretch);
    }
  }
  bool is_on_boundary(std::uint32_t i, const Stretch& stretch) {
    for (const Piece_corner& corner : operands_.corners(i)) {
      const Prepared_plane bound = predicates_.prepare(corner.edge);
      if (side(stretch.from, bound) == CGAL::ZERO && side(stretch.to, bound) == CGAL::ZERO) return true;
    }
    return false;
  }

  const Operands& operands_;
  const Predicates predicates_;
  Leaf_contacts& found_;
  Sides sides_i_, sides_j_;
  bool separated_ = false;
};

/// Brings what all leaves found into one list, by piece.
template <class Item, class Of>
std::vector<std::size_t> gathered(const std::vector<Leaf_contacts>& leaves, std::vector<Item> Leaf_contacts::*list,
                                  std::size_t pieces, std::vector<Item>& all, Of piece_of) {
  std::vector<std::size_t> first(pieces + 1);
  std::size_t count = 0;
  for (const Leaf_contacts& leaf : leaves)
    for (const Item& item : leaf.*list) {
      ++first[piece_of(item)];
      ++count;
    }
  std::size_t sum = 0;
  for (std::size_t& f : first) sum += std::exchange(f, sum);
  std::vector<std::size_t> next = first;
  all.resize(count);
  for (const Leaf_contacts& leaf : leaves)
    for (const Item& item : leaf.*list) all[next[piece_of(item)]++] = item;
  return first;
}

}  // namespace

Contacts contacts(Operands& operands, const Box_tree& tree,
                  const std::function<void(std::size_t, std::size_t)>& progress) {
  // 1. All pairs, by leaves of the tree: which are near each other.
  constexpr std::size_t together = 64;
  std::vector<Leaf_contacts> found((tree.leaf_count() + together - 1) / together);
  std::atomic<std::size_t> done = 0;
  const Near_pieces near(operands, tree);
  parallel_for(found.size(), [&](std::size_t chunk) {
    Pair_filter filter(operands, near, found[chunk]);
    for (std::size_t leaf = together * chunk; leaf < std::min(together * (chunk + 1), tree.leaf_count()); ++leaf) {
      tree.for_each_pair(leaf, [&](std::uint32_t i, std::uint32_t j, unsigned met) { filter.look_at(i, j, met); });
      ++done;
      if (progress) progress(done, 2 * tree.leaf_count());
    }
  });
  // 2. What these have in common.
  std::size_t near_pairs = 0;
  for (const Leaf_contacts& leaf : found)
    for (const Near_pair& pair : leaf.near) {
      operands.make_edges(pair.i);
      operands.make_edges(pair.j);
      ++near_pairs;
    }
  done = near_pairs;
  parallel_for(found.size(), [&](std::size_t chunk) {
    Pair_finder finder(operands, found[chunk]);
    for (const Near_pair& pair : found[chunk].near) {
      finder.look_at(pair);
      const std::size_t now = ++done;
      if (progress && now % 16 == 0) progress(now, 2 * near_pairs);
    }
  });

  // 3. By piece, in an order that is the leaves'.
  Contacts all;
  const std::size_t pieces = operands.pieces().size();
  all.first_cut = gathered(found, &Leaf_contacts::cuts, pieces, all.cuts, [](const Cut& c) { return c.piece; });
  all.first_touch =
      gathered(found, &Leaf_contacts::touches, pieces, all.touches, [](const Touch& t) { return t.piece; });
  all.first_upon = gathered(found, &Leaf_contacts::upon, pieces, all.upon, [](const auto& p) { return p.first; });
  all.touched.resize(pieces);
  std::vector<std::uint8_t> edges(pieces == 0 ? 0 : operands.pieces().back().first + operands.pieces().back().size);
  for (const Leaf_contacts& leaf : found) {
    for (const std::uint32_t i : leaf.touched) all.touched[i] = true;
    for (const auto& [i, j, k, l, is_against] : leaf.edges) {
      edges[k] = static_cast<std::uint8_t>(std::min(2, edges[k] + 1));
      edges[l] = static_cast<std::uint8_t>(std::min(2, edges[l] + 1));
    }
    all.pairs += leaf.pairs;
    all.predicates += leaf.predicates;
  }
  // 4. Edges of two pieces alone.
  for (const Leaf_contacts& leaf : found)
    for (const auto& [i, j, k, l, is_against] : leaf.edges)
      if (is_against && edges[k] == 1 && edges[l] == 1 && !all.touched[i] && !all.touched[j])
        all.joined.emplace_back(i, j);
  return all;
}

}  // namespace sightline
