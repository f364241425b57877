#include <sightline/algorithms/solids/fragments.h>

#include <sightline/kernel/predicates.h>

#include <algorithm>
#include <utility>

namespace sightline {

namespace {

/// A segment that is still to be cut along.
struct Pending_cut {
  Plane plane;
  Vertex from, to;
};

/// Part of a piece with what is to be done in it.
struct Pending_part {
  std::vector<Fragment_corner> corners;
  std::vector<Pending_cut> cuts;
  std::vector<Vertex> points;  // that others end in
};

class Piece_cutter {
 public:
  Piece_cutter(const Operands& operands, const Predicates& predicates, const Contacts& contacts, std::uint32_t piece,
               Predicate_counts& counts)
      : operands_(operands),
        predicates_(predicates),
        contacts_(contacts),
        piece_(piece),
        support_(operands.pieces()[piece].support.id()),
        counts_(counts) {}

  Piece_fragments cut() {
    // 1. Points where others end, on the piece's own edges.
    Pending_part part{whole(operands_, predicates_, piece_).corners, {}, {}};
    for (const Cut& cut : contacts_.cuts_of(piece_)) {
      part.cuts.push_back({cut.plane, cut.from, cut.to});
      part.points.push_back(cut.from);
      part.points.push_back(cut.to);
    }
    for (const Touch& touch : contacts_.touches_of(piece_)) part.points.push_back(touch.at);
    for (const Fragment_corner& corner : part.corners) mark(part.points, corner.edge);

    // 2. Cut after cut.
    std::vector<Pending_part> stack;
    stack.push_back(std::move(part));
    while (!stack.empty()) {
      Pending_part whole = std::move(stack.back());
      stack.pop_back();
      if (whole.cuts.empty()) {
        finish(std::move(whole.corners));
        continue;
      }
      auto [front, behind] = divided(whole, whole.cuts[whole.cuts.size() / 2].plane);
      stack.push_back(std::move(behind));
      stack.push_back(std::move(front));
    }
    return std::move(result_);
  }

 private:
  Sign side(const Vertex& v, const Prepared_plane& h) { return predicates_.side(v, h, counts_); }

  /// Those of the points that are in a plane split what is there.
  void mark(const std::vector<Vertex>& points, Plane plane) {
    const Prepared_plane h = predicates_.prepare(plane);
    for (const Vertex& v : points)
      if (side(v, h) == CGAL::ZERO) result_.marks.push_back({plane, v});
  }

  /// Both sides of a plane that has some of the part on either.
  std::pair<Pending_part, Pending_part> divided(const Pending_part& part, Plane plane) {
    const Prepared_plane h = predicates_.prepare(plane);
    std::pair<Pending_part, Pending_part> halves;
    auto& [front, behind] = halves;
    // 1. Its corners.
    const std::size_t size = part.corners.size();
    std::vector<Sign> sides(size);
    for (std::size_t k = 0; k < size; ++k) sides[k] = side(part.corners[k].vertex, h);
    for (std::size_t k = 0; k < size; ++k) {
      const Fragment_corner& corner = part.corners[k];
      const Sign here = sides[k], next = sides[k + 1 == size ? 0 : k + 1];
      if (here != CGAL::NEGATIVE) front.corners.push_back(corner);
      if (here != CGAL::POSITIVE) behind.corners.push_back(corner);
      if (here == CGAL::ZERO) {  // the edge that begins here is the cut in one of them
        if (next != CGAL::POSITIVE) front.corners.back().edge = plane;
        if (next != CGAL::NEGATIVE) behind.corners.back().edge = plane.opposite();
      } else if (next == -here) {
        const Vertex v = predicates_.meet(support_, corner.edge.id(), plane.id());
        front.corners.push_back({v, here == CGAL::POSITIVE ? plane : corner.edge});
        behind.corners.push_back({v, here == CGAL::POSITIVE ? corner.edge : plane.opposite()});
      }
    }
    // 2. The other cuts.
    for (const Pending_cut& cut : part.cuts) {
      const Sign from = side(cut.from, h), to = side(cut.to, h);
      if (from == CGAL::ZERO && to == CGAL::ZERO) continue;  // it is cut along
      if (from != CGAL::NEGATIVE && to != CGAL::NEGATIVE) {
        front.cuts.push_back(cut);
      } else if (from != CGAL::POSITIVE && to != CGAL::POSITIVE) {
        behind.cuts.push_back(cut);
      } else {
        const Vertex v = predicates_.meet(support_, cut.plane.id(), plane.id());
        (from == CGAL::POSITIVE ? front : behind).cuts.push_back({cut.plane, cut.from, v});
        (from == CGAL::POSITIVE ? behind : front).cuts.push_back({cut.plane, v, cut.to});
      }
    }
    // 3. Points that others end in.
    for (const Vertex& v : part.points) {
      const Sign at = side(v, h);
      if (at == CGAL::ZERO) result_.marks.push_back({plane, v});
      if (at == CGAL::POSITIVE) front.points.push_back(v);
      if (at == CGAL::NEGATIVE) behind.points.push_back(v);
    }
    return halves;
  }

  bool holds(std::uint32_t other, const std::vector<Fragment_corner>& corners) {
    for (const Piece_corner& edge : operands_.corners(other)) {
      const Prepared_plane h = predicates_.prepare(edge.edge);
      for (const Fragment_corner& corner : corners)
        if (side(corner.vertex, h) == CGAL::NEGATIVE) return false;
    }
    return true;
  }

  void finish(std::vector<Fragment_corner> corners) {
    Solid_fragment fragment{piece_, std::move(corners), {}};
    for (const auto& [own, other] : contacts_.upon_of(piece_)) {
      if (!holds(other, fragment.corners)) continue;
      if (other < piece_) return;
      fragment.upon.push_back(other);
    }
    std::sort(fragment.upon.begin(), fragment.upon.end());
    result_.fragments.push_back(std::move(fragment));
  }

  const Operands& operands_;
  const Predicates& predicates_;
  const Contacts& contacts_;
  const std::uint32_t piece_, support_;
  Predicate_counts& counts_;
  Piece_fragments result_;
};

}  // namespace

Solid_fragment whole(const Operands& operands, const Predicates& predicates, std::uint32_t piece) {
  Solid_fragment fragment{piece, {}, {}};
  const std::span<const Piece_corner> corners = operands.corners(piece);
  for (std::size_t k = 0; k < corners.size(); ++k)
    fragment.corners.push_back({operands.vertex(predicates, piece, k), corners[k].edge});
  return fragment;
}

Piece_fragments cut_piece(const Operands& operands, const Predicates& predicates, const Contacts& contacts,
                          std::uint32_t piece, Predicate_counts& counts) {
  return Piece_cutter(operands, predicates, contacts, piece, counts).cut();
}

}  // namespace sightline
