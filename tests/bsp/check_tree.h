#pragma once
// What holds for every exact tree, checked in rationals on the fragments' positions.

#include "support.h"

#include <sightline/harness/compare/flat_polygon.h>

namespace bsp_test {

/// The plane with front n.p + d > 0, in the file's coordinates.
struct Flat {
  Exact_point n;
  Rational d;
  Flat(const Built& built, Plane plane) {
    const std::array<Rational, 4> h = built.scene.file_coefficients(plane);
    n = {h[0], h[1], h[2]};
    d = h[3];
  }
  int side(const Exact_point& p) const { return sgn(Rational(dot(n, p) + d)); }
};

/// Nodes are in preorder and own consecutive fragments; each fragment is a convex counterclockwise polygon with
/// positive area on its node's plane and on the right closed side of every plane above; the fragments of each piece
/// tile it; numbers and counters add up.
inline void check_tree(const Built& built, std::size_t forced = 0) {
  const Tree& tree = built.tree;
  const std::vector<Piece>& pieces = built.scene.pieces();

  struct Way {
    std::int32_t node, parent;
    bool in_front;
  };
  std::vector<std::int32_t> parent(tree.nodes.size(), Tree::leaf);
  std::vector<char> in_front(tree.nodes.size());
  std::size_t visited = 0, first = 0, depth = 0, empty = 0;
  std::vector<std::pair<std::int32_t, std::size_t>> stack;
  if (!tree.nodes.empty()) stack.emplace_back(0, 1);
  std::vector<std::vector<Points>> parts(pieces.size());
  std::map<Face_id, std::uint32_t> numbers;
  while (!stack.empty()) {
    const auto [number, level] = stack.back();
    stack.pop_back();
    const Tree::Node& node = tree.nodes[static_cast<std::size_t>(number)];
    ASSERT_EQ(static_cast<std::size_t>(number), visited++) << "nodes in preorder, front first";
    ASSERT_EQ(node.first, first);
    first += node.count;
    depth = std::max(depth, level);
    empty += node.count == 0;
    for (const auto& [child, front] : {std::pair(node.behind, false), std::pair(node.front, true)}) {
      if (child == Tree::leaf) continue;
      ASSERT_LT(static_cast<std::size_t>(child), tree.nodes.size());
      parent[static_cast<std::size_t>(child)] = number;
      in_front[static_cast<std::size_t>(child)] = front;
      stack.emplace_back(child, level + 1);
    }
    const Flat plane(built, node.plane);
    for (const Drawn& fragment : tree.on(node)) {
      const Piece& piece = pieces[fragment.polygon.piece];
      const Points corners = built.corners(fragment.polygon);
      for (const Exact_point& p : corners) ASSERT_EQ(plane.side(p), 0);
      for (std::int32_t below = number; parent[static_cast<std::size_t>(below)] != Tree::leaf;
           below = parent[static_cast<std::size_t>(below)]) {
        const Flat above(built, tree.nodes[static_cast<std::size_t>(parent[static_cast<std::size_t>(below)])].plane);
        const int right = in_front[static_cast<std::size_t>(below)] ? 1 : -1;
        bool inside = false;
        for (const Exact_point& p : corners) {
          const int side = above.side(p);
          ASSERT_NE(side, -right);
          inside |= side == right;
        }
        ASSERT_TRUE(inside) << "a fragment on a plane above belongs there";
      }
      // A convex polygon: no corner repeated or straight, each edge's plane holds the edge and has the rest in front.
      const Flat support(built, piece.support);
      ASSERT_GE(corners.size(), 3u);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Exact_point &p = corners[i], &q = corners[(i + 1) % corners.size()],
                          &r = corners[(i + 2) % corners.size()];
        ASSERT_GT(dot(cross(minus(q, p), minus(r, q)), support.n), 0);
        const Flat edge(built, fragment.polygon.corners[i].edge.bound);
        ASSERT_EQ(edge.side(p), 0);
        ASSERT_EQ(edge.side(q), 0);
        for (const Exact_point& other : corners) ASSERT_GE(edge.side(other), 0);
        ASSERT_GT(edge.side(r), 0);
      }
      ASSERT_EQ(fragment.same_sense, dot(support.n, plane.n) > 0);
      ASSERT_EQ(fragment.number, numbers[piece.face]++);
      parts[fragment.polygon.piece].push_back(corners);
    }
  }
  ASSERT_EQ(visited, tree.nodes.size());
  ASSERT_EQ(first, tree.fragments.size());

  // Tiling: nothing of the piece is missing, and areas add up.
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Flat support(built, pieces[i].support);
    std::size_t axis = 0;
    while (sgn(support.n[axis]) == 0) ++axis;
    const auto flat = [&](const Points& points) {
      std::vector<Flat_polygon::Point> projected;
      for (const Exact_point& p : points) projected.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3]});
      return Flat_polygon::hull(projected);
    };
    const Flat_polygon whole = flat(built.scene.corner_points(pieces[i]));
    std::vector<Flat_polygon> missing{whole};
    Rational sum = 0;
    for (const Points& part : parts[i]) {
      const Flat_polygon polygon = flat(part);
      sum += polygon.area();
      std::vector<Flat_polygon> rest;
      for (const Flat_polygon& hole : missing)
        for (Flat_polygon& left : hole.without(polygon)) rest.push_back(std::move(left));
      missing = std::move(rest);
    }
    ASSERT_TRUE(missing.empty()) << "piece " << i;
    ASSERT_EQ(sum, whole.area()) << "piece " << i;
  }

  const Bsp_counters& c = tree.counters;
  EXPECT_EQ(c.pieces, pieces.size());
  EXPECT_EQ(c.fragments, c.pieces + c.splits);
  EXPECT_EQ(c.fragments, tree.fragments.size());
  EXPECT_EQ(c.nodes, tree.nodes.size());
  EXPECT_EQ(c.depth, depth);
  EXPECT_EQ(c.degenerate, 0u);
  EXPECT_LE(empty, c.free_planes + forced);
  EXPECT_LE(c.free_planes, c.nodes);
  EXPECT_GE(c.polygon_tests + c.nodes, c.fragments);
}

}  // namespace bsp_test
