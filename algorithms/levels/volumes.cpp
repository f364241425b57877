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
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sightline {

namespace levels_detail {

/// A convex polyhedron, its planes with the inside behind them.
struct Convex_volume {
  std::string name;  // for messages: a face of it
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

Convex_volume convex_volume(const Polygon_soup& soup, const std::vector<Face_id>& faces, const Go_on& go_on) {
  const Scene scene(of_faces(soup, faces));
  const auto name = [&](Face_id f) { return "face " + std::to_string(faces[f]); };
  Convex_volume volume;
  volume.name = name(0);

  // 1. Its surface.
  if (!closure(scene).closed)
    throw std::invalid_argument(volume.name + " and what shares points with it do not close up; add the faces that " +
                                "are missing, and turn the others so that all fronts look outwards, or all inwards");
  for (const Piece& piece : scene.pieces()) {
    volume.planes.push_back(scene.file_coefficients(piece.support));
    for (const Piece_corner& corner : scene.corners(piece)) volume.corners.push_back(scene.position(corner.point));
  }
  std::sort(volume.corners.begin(), volume.corners.end());
  volume.corners.erase(std::unique(volume.corners.begin(), volume.corners.end()), volume.corners.end());

  // 2. All of it on one side of each plane.
  int inside = 0;  // the side that it is on
  for (std::size_t i = 0; i < volume.planes.size(); ++i) {
    go_on();
    const std::array<int, 2> sides = sides_to(volume.planes[i], volume.corners);
    const int side = sides[0] + sides[1];
    if (side == 0 || (inside != 0 && side != inside))
      throw std::invalid_argument(name(scene.pieces()[i].face) + " has corners of faces that share points with it on " +
                                  "both sides, or on none: they are not convex; cut them into convex volumes, each " +
                                  "with points of its own");
    inside = side;
  }
  if (inside == 0) throw std::invalid_argument(volume.name + " has no area; leave it out");
  if (inside > 0)
    for (Exact_plane& h : volume.planes)
      for (Rational& x : h) x = -x;

  volume.box = exact_box(volume.corners);
  return volume;
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
      go_on();
      if (!are_apart(a, b))
        throw std::invalid_argument(volumes[std::min(order[i], order[j])].name + " and " +
                                    volumes[std::max(order[i], order[j])].name +
                                    " are of volumes that overlap; move one, or cut off what they have in common");
    }
}

/// Divides space by planes of volumes until no more is left than one, or none.
class Volume_divider {
 public:
  explicit Volume_divider(const std::vector<Convex_volume>& volumes) : volumes_(volumes) {
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
  /// A volume that may have a part here, and those of its planes that are none of the nodes above.
  struct Left {
    std::uint32_t volume;
    std::vector<std::uint32_t> planes;
  };

  /// The number of the node to come; or below 0 a leaf, where nothing is left, or one volume is all.
  std::int32_t made_of(const std::vector<Left>& left) const {
    if (left.empty()) return -1 - static_cast<std::int32_t>(volumes_.size());
    for (const Left& one : left)
      if (one.planes.empty()) return -1 - static_cast<std::int32_t>(one.volume);
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
  std::vector<Exact_plane> planes_;
  std::vector<std::vector<std::uint32_t>> own_;  // by volume
  std::unordered_map<std::uint64_t, std::array<bool, 2>> reaches_;
  Space_tree tree_;
};

}  // namespace levels_detail

Volume_division convex_volumes(const Polygon_soup& soup,
                               const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<levels_detail::Convex_volume> volumes;
  const std::vector<std::vector<Face_id>> components = levels_detail::components_of(soup);
  const levels_detail::Go_on go_on = [&] {
    if (progress) progress(volumes.size(), components.size() + 1);  // then they are held to each other, and divided
  };
  for (const std::vector<Face_id>& faces : components)
    volumes.push_back(levels_detail::convex_volume(soup, faces, go_on));
  levels_detail::check_apart(volumes, go_on);
  Volume_division division{levels_detail::Volume_divider(volumes).divided(go_on),
                           static_cast<std::uint32_t>(volumes.size())};
  for (const levels_detail::Convex_volume& volume : volumes)
    division.tree.corners.insert(division.tree.corners.end(), volume.corners.begin(), volume.corners.end());
  return division;
}

}  // namespace sightline
