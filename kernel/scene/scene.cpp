#include <sightline/kernel/scene/scene.h>

#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/face_cutter.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace sightline {

namespace {

/// The faces of a soup as loops on the grid, repetitions dropped.
struct Face_loops {
  const Polygon_soup& soup;
  const std::vector<std::uint32_t>& ids;  // of the soup's points on the grid

  void read(Face_id f, std::vector<Point_loop>& into) const {
    into.resize(soup.loop_count(f));
    for (std::size_t k = 0; k < into.size(); ++k) {
      Point_loop& loop = into[k];
      loop.clear();
      for (const Point_id p : soup.loop(f, k))
        if (loop.empty() || loop.back() != ids[p]) loop.push_back(ids[p]);
      while (loop.size() > 1 && loop.back() == loop.front()) loop.pop_back();
    }
  }
};

/// Where the least of a loop's rotations begins, in linear time, however often points come back: of two places that
/// agree for so long, the one that is greater then is none, nor is any place that it has passed.
std::size_t begin_of_least_rotation(const Point_loop& loop) {
  const std::size_t n = loop.size();
  std::size_t i = 0, j = 1, length = 0;
  while (i < n && j < n && length < n) {
    const std::uint32_t a = loop[(i + length) % n], b = loop[(j + length) % n];
    if (a == b) {
      ++length;
      continue;
    }
    (a > b ? i : j) += length + 1;
    if (i == j) ++j;
    length = 0;
  }
  return std::min(i, j);
}

/// The loops begun so that equal ones are equal lists.
std::vector<Point_loop> rotated(std::vector<Point_loop> loops) {
  for (Point_loop& loop : loops)
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(begin_of_least_rotation(loop)), loop.end());
  return loops;
}

std::size_t hash_of(const std::vector<Point_loop>& loops) {
  std::size_t h = loops.size();
  for (const Point_loop& loop : loops)
    for (const std::uint32_t p : loop) {
      h = (h ^ p) * 0xff51afd7ed558ccdu;
      h ^= h >> 29;
    }
  return h;
}

/// `of`: what goes behind the reason's text.
void set_aside(Scene_faces& faces, Face_id f, Set_aside_reason reason, const std::string& of = {}) {
  faces.set_aside.push_back({f, reason, std::string(text_of(reason)) + of});
  switch (reason) {
    case Set_aside_reason::zero_area: ++faces.counters.zero_area; break;
    case Set_aside_reason::duplicate: ++faces.counters.duplicates; break;
    case Set_aside_reason::self_intersecting: ++faces.counters.self_intersecting; break;
    case Set_aside_reason::no_simple_projection: ++faces.counters.no_simple_projection; break;
  }
}

/// Cuts each face, or sets it aside. An exact duplicate repeats the loops of an earlier kept face up to rotation.
void cut_faces(const Face_loops& all, const Grid_points& points, Scene_faces& faces) {
  std::unordered_multimap<std::size_t, Face_id> kept;  // by a hash of their loops
  kept.reserve(all.soup.face_count());
  std::vector<Point_loop> loops, others;
  for (Face_id f = 0; f < all.soup.face_count(); ++f) {
    all.read(f, loops);
    const std::vector<Point_loop> key = rotated(loops);
    const std::size_t hash = hash_of(key);
    const auto [begin, end] = kept.equal_range(hash);
    const auto twin = std::find_if(begin, end, [&](const auto& entry) {
      all.read(entry.second, others);
      return rotated(others) == key;
    });
    if (twin != end) set_aside(faces, f, Set_aside_reason::duplicate, std::to_string(twin->second));
    else if (const auto reason = cut_face(points, f, loops, faces)) set_aside(faces, f, *reason);
    else kept.emplace(hash, f);
  }
}

}  // namespace

Scene::Scene(const Polygon_soup& soup) : file_(soup.file) {
  if (soup.face_count() >= Plane::max_table_planes || soup.point_count() >= Plane::max_axis_point)
    throw std::length_error("scenes of up to 2^28 points and 2^30 faces only");
  soup.check_corners();

  // 1. Points on the grid, faces on planes.
  std::vector<std::uint32_t> ids;
  grid_ = Scene_grid(soup.coordinates, ids);
  faces_.planes = Plane_table(points());
  cut_faces({soup, ids}, points(), faces_);

  // 2. Which planes pass through each point.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  pairs.reserve(faces_.corners.size());
  for (const Piece& piece : pieces())
    for (const Piece_corner& corner : corners(piece)) pairs.emplace_back(corner.point, piece.support.id());
  incidences_ = Point_planes(points().size(), pairs);

  Scene_counters& c = faces_.counters;
  c.points_read = soup.point_count();
  c.points = points().size();
  c.faces_read = soup.face_count();
  c.faces = c.faces_read - set_aside().size();
  c.pieces = pieces().size();
}

Predicates Scene::predicates() const& { return {points(), planes(), incidences_}; }

std::vector<Exact_point> Scene::corner_points(const Piece& piece) const {
  std::vector<Exact_point> points;
  points.reserve(piece.size);
  for (const Piece_corner& corner : corners(piece)) points.push_back(position(corner.point));
  return points;
}

Prepared_plane Scene::prepared(Plane plane) const { return predicates().prepare(plane); }

std::array<Rational, 4> Scene::file_coefficients(Plane plane) const {
  return file_coefficients(predicates().coefficients(plane));
}

std::array<Exact_point, 2> Scene::box_of_faces() const {
  std::array<Exact_point, 2> box;
  for (int k = 0; k < 3; ++k) {
    std::array<std::uint32_t, 2> ends{corners(pieces()[0])[0].point, corners(pieces()[0])[0].point};
    Integer least = points().integer(ends[0], k), most = least;
    for (const Piece& piece : pieces())
      for (const Piece_corner& corner : corners(piece)) {
        const Integer x = points().integer(corner.point, k);
        if (x < least) {
          least = x;
          ends[0] = corner.point;
        } else if (x > most) {
          most = x;
          ends[1] = corner.point;
        }
      }
    const auto axis = static_cast<std::size_t>(k);
    for (const std::size_t side : {0u, 1u}) box[side][axis] = position(ends[side])[axis];
  }
  return box;
}

}  // namespace sightline
