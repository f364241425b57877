#include <sightline/algorithms/levels/volumes.h>

#include <sightline/algorithms/levels/common_inside.h>
#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/union_find.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sightline {

namespace levels_detail {

/// A convex polyhedron, its planes with the inside behind them: a volume, or a part of one.
struct Convex_volume {
  std::string name;      // for messages: a face of it
  std::uint32_t number;  // of the volume
  std::vector<Exact_plane> planes;
  std::vector<Exact_point> corners;  // sorted
  std::array<Exact_point, 2> box;
};

/// The least and the largest side of corners to a plane.
std::array<int, 2> sides_to(const Exact_plane& h, const std::vector<Exact_point>& corners) {
  std::array<int, 2> sides{1, -1};
  for (const Exact_point& p : corners) {
    const int side = sgn(exact_height(h, p));
    sides = {std::min(sides[0], side), std::max(sides[1], side)};
  }
  return sides;
}

/// The faces of each component, by shared points; components by their first faces.
std::vector<std::vector<Face_id>> components_of(const Polygon_soup& soup) {
  Union_find sets(soup.point_count());
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t l = 0; l < soup.loop_count(f); ++l)
      for (const Point_id p : soup.loop(f, l)) sets.join(p, soup.loop(f)[0]);
  std::map<Point_id, std::size_t> places;
  std::vector<std::vector<Face_id>> components;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    if (soup.loop(f).empty()) continue;
    const auto [at, is_new] = places.try_emplace(sets.find(soup.loop(f)[0]), components.size());
    if (is_new) components.emplace_back();
    components[at->second].push_back(f);
  }
  return components;
}

Polygon_soup of_faces(const Polygon_soup& soup, const std::vector<Face_id>& faces) {
  Polygon_soup part;
  std::map<Point_id, Point_id> ids;
  std::vector<Point_id> loop;
  for (const Face_id f : faces)
    for (std::size_t l = 0; l < soup.loop_count(f); ++l) {
      loop.clear();
      for (const Point_id p : soup.loop(f, l)) {
        const auto [at, is_new] = ids.try_emplace(p, static_cast<Point_id>(part.point_count()));
        if (is_new)
          for (const Rational& x : soup.point(p)) part.coordinates.push(x);
        loop.push_back(at->second);
      }
      if (l == 0) part.add_face(loop);
      else part.add_hole(loop);
    }
  return part;
}

/// `go_on` is called all the time, and may throw; so below.
using Go_on = std::function<void()>;

/// A component of a soup, with the numbers of its faces there.
struct Component {
  std::uint32_t number;
  const std::vector<Face_id>& faces;
  Scene scene;

  std::string name(Face_id f) const { return "face " + std::to_string(faces[f]); }
};

std::vector<Exact_point> corners_of(const Scene& scene) {
  std::vector<Exact_point> corners;
  for (const Piece& piece : scene.pieces())
    for (const Piece_corner& corner : scene.corners(piece)) corners.push_back(scene.position(corner.point));
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// A closed polyhedron where it is convex: all of it is on one side of each plane, the same side.
std::optional<Convex_volume> as_convex(const Component& of, const std::vector<Exact_point>& corners,
                                       const Go_on& go_on) {
  Convex_volume volume{of.name(0), of.number, {}, corners, {}};
  int inside = 0;  // the side that it is on
  for (const Piece& piece : of.scene.pieces()) {
    go_on();
    volume.planes.push_back(of.scene.file_coefficients(piece.support));
    const std::array<int, 2> sides = sides_to(volume.planes.back(), volume.corners);
    const int side = sides[0] + sides[1];
    if (side == 0 || (inside != 0 && side != inside)) return std::nullopt;
    inside = side;
  }
  if (inside == 0) throw std::invalid_argument(volume.name + " has no area; leave it out");
  if (inside > 0)
    for (Exact_plane& h : volume.planes)
      for (Rational& x : h) x = -x;
  volume.box = exact_box(volume.corners);
  return volume;
}

/// Any other one, as the cells of its own faces that it winds about: all as often, or it goes through itself.
std::vector<Convex_volume> in_convex_parts(const Component& of, const Polygon_soup& soup, const Go_on& go_on) {
  Cell_options options;
  options.threads = 1;
  options.progress = [&](std::size_t, std::size_t) { go_on(); };
  const Level_cells cells(soup, options);
  std::vector<Convex_volume> parts;
  int winding = 0;
  for (Cell_id c = 0; c < cells.cells().size(); ++c) {
    const Level_cell& cell = cells.cells()[c];
    if (cell.winding == 0) continue;
    if (winding != 0 && cell.winding != winding)
      throw std::invalid_argument(of.name(0) + " and what shares points with it go through each other; cut them into " +
                                  "volumes that do not, each with points of its own");
    winding = cell.winding;
    Convex_volume& part = parts.emplace_back(Convex_volume{of.name(0), of.number, {}, {}, {}});
    for (const std::uint32_t w : cell.walls) {
      const std::vector<Exact_point> polygon = cells.polygon(cells.walls()[w].corners);
      part.planes.push_back(exact_plane(polygon));
      if (cells.walls()[w].front == c)  // its polygon looks into the cell
        for (Rational& x : part.planes.back()) x = -x;
      part.corners.insert(part.corners.end(), polygon.begin(), polygon.end());
    }
    std::sort(part.corners.begin(), part.corners.end());
    part.corners.erase(std::unique(part.corners.begin(), part.corners.end()), part.corners.end());
    part.box = exact_box(part.corners);
  }
  if (parts.empty())
    throw std::invalid_argument(of.name(0) + " and what shares points with it have no inside; leave them out");
  return parts;
}

/// The convex parts of a component; and, for the level's grid, the corners that their planes are through.
std::vector<Convex_volume> parts_of(const Polygon_soup& soup, const std::vector<Face_id>& faces, std::uint32_t number,
                                    std::vector<Exact_point>& corners, const Go_on& go_on) {
  const Polygon_soup own = of_faces(soup, faces);
  const Component component{number, faces, Scene(own)};
  if (!closure(component.scene).closed)
    throw std::invalid_argument(component.name(0) + " and what shares points with it do not close up; add the faces " +
                                "that are missing, and turn the others so that all fronts look outwards, or all " +
                                "inwards");
  const std::vector<Exact_point> through = corners_of(component.scene);
  std::optional<Convex_volume> whole = as_convex(component, through, go_on);
  corners.insert(corners.end(), through.begin(), through.end());
  if (whole) return {*std::move(whole)};
  return in_convex_parts(component, own, go_on);
}

/// Whether two convex polyhedra have no point inside in common.
bool are_apart(const Convex_volume& a, const Convex_volume& b) {
  std::array<Exact_point, 2> common;
  for (std::size_t k = 0; k < 3; ++k) {
    common[0][k] = std::max(a.box[0][k], b.box[0][k]);
    common[1][k] = std::min(a.box[1][k], b.box[1][k]);
    if (common[1][k] <= common[0][k]) return true;
  }
  std::vector<Exact_plane> planes = a.planes;
  planes.insert(planes.end(), b.planes.begin(), b.planes.end());
  return !have_common_inside(planes, common);
}

void check_apart(const std::vector<Convex_volume>& volumes, const Go_on& go_on) {
  std::vector<std::size_t> order(volumes.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return volumes[a].box[0] < volumes[b].box[0]; });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Convex_volume &a = volumes[order[i]], &b = volumes[order[j]];
      if (b.box[0][0] >= a.box[1][0]) break;
      if (a.number == b.number) continue;
      go_on();
      if (!are_apart(a, b))
        throw std::invalid_argument(volumes[std::min(order[i], order[j])].name + " and " +
                                    volumes[std::max(order[i], order[j])].name +
                                    " are of volumes that overlap; move one, or cut off what they have in common");
    }
}

/// Divides space by planes of volumes' parts until no more is left than one, or none.
class Volume_divider {
 public:
  Volume_divider(const std::vector<Convex_volume>& volumes, std::uint32_t count) : volumes_(volumes), count_(count) {
    std::map<Exact_plane, std::uint32_t> ids;
    for (const Convex_volume& volume : volumes_) {
      std::vector<std::uint32_t>& own = own_.emplace_back();
      for (const Exact_plane& h : volume.planes) {
        const auto [at, is_new] = ids.try_emplace(unoriented(h).plane, static_cast<std::uint32_t>(planes_.size()));
        if (is_new) planes_.push_back(at->first);
        own.push_back(at->second);
      }
      std::sort(own.begin(), own.end());
      own.erase(std::unique(own.begin(), own.end()), own.end());
    }
  }

  Space_tree divided(const Go_on& go_on) {
    struct Waiting {
      std::int32_t above;
      std::size_t side;  // of `above`: 0 in front, 1 behind
      std::vector<Left> left;
    };
    std::vector<Waiting> stack;
    std::vector<Left> all;
    for (std::uint32_t v = 0; v < volumes_.size(); ++v) all.push_back({v, own_[v]});
    stack.push_back({-1, 0, std::move(all)});
    while (!stack.empty()) {
      go_on();
      const Waiting job = std::move(stack.back());
      stack.pop_back();
      const std::int32_t made = made_of(job.left);
      if (job.above < 0) tree_.root = made;
      else tree_.nodes[static_cast<std::size_t>(job.above)].children[job.side] = made;
      if (made < 0) continue;
      const std::uint32_t plane = chosen(job.left);
      tree_.nodes.push_back({planes_[plane], {}});
      for (const std::size_t side : {0u, 1u}) {
        Waiting& below = stack.emplace_back(Waiting{made, side, {}});
        for (const Left& left : job.left)
          if (reaches(left.volume, plane)[side]) {
            below.left.push_back(left);
            std::erase(below.left.back().planes, plane);
          }
      }
    }
    return std::move(tree_);
  }

 private:
  /// What may be here of the parts of volumes, and those of its planes that are none of the nodes above.
  struct Left {
    std::uint32_t volume;  // a place of these
    std::vector<std::uint32_t> planes;
  };

  /// The number of the node to come; or below 0 a leaf, where nothing is left, or one volume is all.
  std::int32_t made_of(const std::vector<Left>& left) const {
    if (left.empty()) return -1 - static_cast<std::int32_t>(count_);
    for (const Left& one : left)
      if (one.planes.empty()) return -1 - static_cast<std::int32_t>(volumes_[one.volume].number);
    return static_cast<std::int32_t>(tree_.nodes.size());
  }

  /// Whether a volume has points in front of a plane, behind it: found once, as the same two meet below many nodes.
  std::array<bool, 2> reaches(std::uint32_t volume, std::uint32_t plane) {
    const auto [found, is_new] = reaches_.try_emplace(std::uint64_t{volume} << 32 | plane);
    if (is_new) found->second = asked_reaches(volume, plane);
    return found->second;
  }
  std::array<bool, 2> asked_reaches(std::uint32_t volume, std::uint32_t plane) const {
    const std::array<int, 2> sides = sides_to(planes_[plane], volumes_[volume].corners);
    return {sides[1] > 0, sides[0] < 0};
  }

  /// Of some planes that are left the one that leaves the least on both sides: cut volumes count twice.
  std::uint32_t chosen(const std::vector<Left>& left) {
    constexpr std::size_t tried = 8;
    std::uint32_t best = left[0].planes[0];
    std::size_t least = ~std::size_t{0};
    for (std::size_t k = 0; k < tried; ++k) {
      const Left& of = left[k * left.size() / tried];
      const std::uint32_t plane = of.planes[k % of.planes.size()];
      std::array<std::size_t, 2> counts{};
      for (const Left& one : left) {
        const std::array<bool, 2> sides = reaches(one.volume, plane);
        counts[0] += sides[0];
        counts[1] += sides[1];
      }
      const std::size_t cost = counts[0] + counts[1] + std::max(counts[0], counts[1]);
      if (cost >= least) continue;
      least = cost;
      best = plane;
    }
    return best;
  }

  const std::vector<Convex_volume>& volumes_;
  std::uint32_t count_;
  std::vector<Exact_plane> planes_;
  std::vector<std::vector<std::uint32_t>> own_;  // by volume
  std::unordered_map<std::uint64_t, std::array<bool, 2>> reaches_;
  Space_tree tree_;
};

}  // namespace levels_detail

Volume_division volume_division(const Polygon_soup& soup,
                                const std::function<void(std::size_t, std::size_t)>& progress) {
  using namespace levels_detail;
  Volume_division division;
  std::vector<Convex_volume> parts;
  const std::vector<std::vector<Face_id>> components = components_of(soup);
  const Go_on go_on = [&] {  // when all are known they are held to each other, and divided
    if (progress) progress(division.volumes, components.size() + 1);
  };
  std::vector<Exact_point> corners;
  for (const std::vector<Face_id>& faces : components) {
    std::vector<Convex_volume> more = parts_of(soup, faces, division.volumes, corners, go_on);
    std::move(more.begin(), more.end(), std::back_inserter(parts));
    ++division.volumes;
  }
  check_apart(parts, go_on);
  division.tree = Volume_divider(parts, division.volumes).divided(go_on);
  division.tree.corners = std::move(corners);
  return division;
}

}  // namespace sightline
