#include <sightline/algorithms/weak_visibility/along/piece_view.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace sightline {

namespace {

constexpr std::size_t most_lines = std::size_t{1} << 21;  // three numbers in one key

}  // namespace

Piece_view::Piece_view(const Along_scene& scene, std::uint32_t piece, int side)
    : scene_(&scene), target_(&scene.polygons()[piece]), plane_(scene.occluders().plane(piece)), side_(side) {
  for (const Line_side& edge : target_->edges) whole_.push_back({edge.line, -side * edge.sign});
  if (side > 0) std::reverse(whole_.begin(), whole_.end());
  const Parameter_range path{Quadratic_root(0), Quadratic_root(1)};
  if (side * path.low.sign_of(target_->eye_side) <= 0 && side * path.high.sign_of(target_->eye_side) <= 0) return;
  for (const Eye_polygon& other : scene.polygons())
    if (!other.corners.empty() && other.piece != piece && !is_out_of_the_way(other, path)) add_blocker(other.piece);
  if (line_count() >= most_lines) throw std::length_error("a path sees scenes of up to 2^21 lines of edges only");
}

const Eye_line& Piece_view::line(std::uint32_t number) const {
  const std::size_t shared = scene_->lines().size();
  return number < shared ? scene_->lines()[number] : own_[number - shared];
}

std::uint32_t Piece_view::number_of(const Exact_pluecker& line, std::uint32_t piece) {
  if (const auto at = scene_->numbers().find(line); at != scene_->numbers().end()) return at->second;
  const auto number = static_cast<std::uint32_t>(scene_->lines().size() + own_.size());
  const auto [at, is_new] = own_numbers_.try_emplace(line, number);
  if (is_new) {
    own_.push_back(eye_line(scene_->eye(), scene_->occluders().frame(), line));
    own_pieces_.push_back(piece);
  }
  return at->second;
}

/// Pre: the piece may be in the way. What of it is in front of the target's plane, on the eye's side.
void Piece_view::add_blocker(std::uint32_t piece) {
  const Eye_polygon& whole = scene_->polygons()[piece];
  const int towards = sightline::side(plane_, whole.corners);
  if (towards == side_) {
    blockers_.push_back(&whole);
    return;
  }
  if (towards != both_sides) return;
  Eye_polygon part{
      piece, sightline::clip(scene_->occluders().frame(), whole.corners, plane_, side_ > 0), {}, whole.eye_side, 0};
  for (std::size_t i = 0; i < part.corners.size(); ++i) {
    Exact_pluecker line = join(part.corners[i].exact, part.corners[(i + 1) % part.corners.size()].exact);
    const int sense = make_canonical(line);
    part.edges.push_back({number_of(line, piece), sense});
  }
  part.size = squared_size(part.corners);
  blockers_.push_back(&parts_.emplace_back(std::move(part)));
}

Along_certificate::Side Piece_view::named(const Line_side& side) const {
  using Kind = Along_certificate::Side::Kind;
  const std::size_t shared = scene_->lines().size();
  if (side.line < shared) {
    const auto& [piece, corner] = scene_->edges(side.line).front();
    return {Kind::edge, piece, corner, -side.sign * scene_->polygons()[piece].edges[corner].sign};
  }
  // Both normals are the same, but for a factor: that of the line, and that of the two planes.
  const std::uint32_t piece = own_pieces_[side.line - shared];
  const Eye_line& its = line(side.line);
  const std::array<Integer, 4>&own = plane_.exact, &other = scene_->occluders().plane(piece).exact;
  int sense = 0;
  for (const std::size_t c : {0, 1})
    for (std::size_t k = 0; k < 3 && sense == 0; ++k)
      sense = side_ * sgn((c == 0 ? its.first : its.change)[k]) *
              sgn(Integer(target_->eye_side.c[c] * other[k] - scene_->polygons()[piece].eye_side.c[c] * own[k]));
  return {Kind::meet, piece, 0, side.sign * sense};
}

bool Piece_view::is_out_of_the_way(const Eye_polygon& polygon, const Parameter_range& range) const {
  const Near<4> low = scene_->eye().near(range.low), high = scene_->eye().near(range.high);
  // 1. Both on one side of its plane.
  const Near_plane& plane = scene_->occluders().plane(polygon.piece);
  const Near<4> near_plane = near(plane);
  const auto side_at = [&](const Quadratic_root& t, const Near<4>& eye) {
    const int sure = certain_dot(near_plane, eye);
    return sure != 0 ? sure : t.sign_of(polygon.eye_side);
  };
  const int from = side_at(range.low, low), to = side_at(range.high, high);
  const int eye_at = from * to < 0 ? 0 : from + to > 0 ? 1 : from + to < 0 ? -1 : 0;  // 0: it passes the plane
  const int target_at = sightline::side(plane, target_->corners);
  if (target_at == 0 || (eye_at != 0 && target_at == eye_at)) return true;
  // 2. All of it beyond one side of the target.
  const auto is_beyond = [&](const Line_side& side, std::span<const Near_point> corners, int sign) {
    const Near<4> at_low = join(low, line(side.line).near), at_high = join(high, line(side.line).near);
    for (const Near_point& corner : corners) {
      const Near<4> point = near(corner);
      const int a = sign * side.sign * certain_dot(at_low, point), b = sign * side.sign * certain_dot(at_high, point);
      if (a > 0 || b > 0) return false;
      if (a < 0 && b < 0) continue;
      const Quadratic f = sightline::side(scene_->eye(), line(side.line), corner.exact);
      if (sign * side.sign * range.low.sign_of(f) > 0 || sign * side.sign * range.high.sign_of(f) > 0) return false;
    }
    return true;
  };
  for (const Line_side& side : whole_)
    if (is_beyond(side, polygon.corners, 1)) return true;
  // 3. All of the target beyond one of its edges.
  if (eye_at == 0) return false;
  return std::any_of(polygon.edges.begin(), polygon.edges.end(),
                     [&](const Line_side& edge) { return is_beyond(edge, target_->corners, -eye_at); });
}

Piece_view::Blockers Piece_view::all_blockers() const {
  Blockers all(blockers_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

Piece_view::Blockers Piece_view::left_in(const Parameter_range& range, const Blockers& all) const {
  Blockers left;
  for (const std::uint32_t blocker : all)
    if (!is_out_of_the_way(*blockers_[blocker], range)) left.push_back(blocker);
  return left;
}

}  // namespace sightline
