#include <sightline/model_inside.h>

#include <sightline/algorithms/bsp/build.h>
#include <sightline/io/read.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/time_limit.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace sightline {
namespace {

// ---- Measures: exact vectors, one root at the end

/// The root of a rational in doubles, where that is within their range, to three units in the last place.
double root(const Rational& square) { return std::sqrt(nearest_double(square)); }

/// Of a triangle by Van Oosterom and Strackee's formula: the volume is exact, so thin triangles keep their precision.
double solid_angle_of(const Exact_point& a, const Exact_point& b, const Exact_point& c) {
  const double volume = std::fabs(nearest_double(dot(a, cross(b, c))));
  const double la = root(dot(a, a)), lb = root(dot(b, b)), lc = root(dot(c, c));
  const double below =
      la * lb * lc + nearest_double(dot(a, b)) * lc + nearest_double(dot(b, c)) * la + nearest_double(dot(c, a)) * lb;
  const double angle = 2 * std::atan2(volume, below);
  return angle < 0 ? angle + 4 * std::numbers::pi : angle;
}

void require_index(std::uint32_t index, std::size_t count) {
  if (index >= count)
    throw std::out_of_range("corner " + std::to_string(index) + " is no point: there are " + std::to_string(count));
}

}  // namespace

// ---- Budgets

std::function<bool()> end_of_budget(const Asking& asking) { return Time_limit(asking.budget).end(); }

std::function<void(std::size_t, std::size_t)> progress_within_budget(const Asking& asking) {
  const std::function<bool()> is_over = end_of_budget(asking);
  if (!is_over) return asking.progress;
  return [is_over, progress = asking.progress](std::size_t done, std::size_t all) {
    if (is_over()) throw Out_of_budget("undecided: the budget ran out; give it more seconds, or a smaller scene");
    if (progress) progress(done, all);
  };
}

// ---- Parts

double Part::area() const {
  Exact_point twice{0, 0, 0};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Exact_point part = cross(minus(corners[i], corners[0]), minus(corners[i + 1], corners[0]));
    for (std::size_t k = 0; k < 3; ++k) twice[k] += part[k];
  }
  return root(dot(twice, twice)) / 2;
}

double Part::solid_angle(const Exact_point& eye) const {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += solid_angle_of(minus(corners[0], eye), minus(corners[i], eye), minus(corners[i + 1], eye));
  return sum;
}

// ---- The model

const std::vector<Left_out>& Model::Inside::left_out() const {
  return left_out_.get([&] {
    std::vector<Left_out> all;
    for (const Set_aside& entry : scene().set_aside()) all.push_back({entry.face, entry.why});
    return all;
  });
}

const std::vector<Part>& Model::Inside::parts() const {
  return parts_.get([&] {
    const std::vector<Piece>& pieces = scene().pieces();
    std::vector<Part> parts;
    parts.reserve(pieces.size());
    for (const Piece& piece : pieces) parts.push_back(part(piece));
    return parts;
  });
}

Part Model::Inside::part(const Piece& piece) const {
  const Scene& of = scene();
  Part part{piece.face, piece.number, {}};
  for (const Piece_corner& corner : of.corners(piece)) part.corners.push_back(of.position(corner.point));
  return part;
}

const Bsp_tree<Exact_traits>& Model::Inside::tree(const Asking& asking) const {
  return tree_.get([&] {
    Bsp_options options;
    options.threads = asking.threads;
    options.progress = progress_within_budget(asking);
    return build_bsp(traits(), options);
  });
}

const Facts& Model::Inside::facts() const {
  return facts_.get([&] {
    const Scene& of = scene();
    const Scene_counters& c = of.counters();
    std::vector<bool> supports(of.planes().size());
    for (const Piece& piece : of.pieces()) supports[piece.support.id()] = true;
    const auto planes = static_cast<std::size_t>(std::count(supports.begin(), supports.end(), true));
    Facts found{c.points_read, c.points, c.faces_read, c.faces, c.pieces,           c.concave,   c.non_planar,
                c.with_holes,  planes,   of.bits(),    {},      closure(of).closed, std::nullopt};
    found.arithmetic = name(of.predicates().arithmetic());
    if (c.faces > 0) found.box = of.box();
    return found;
  });
}

Model::Model(Polygon_soup soup) : Model(std::make_shared<const Inside>(std::move(soup))) { inside_->traits(); }

Model::Model(std::shared_ptr<const Inside> inside) : inside_(std::move(inside)) {}

Model Model::read(const std::filesystem::path& file) { return Model(read_scene(file)); }

Model Model::of_triangles(std::span<const std::array<double, 3>> points,
                          std::span<const std::array<std::uint32_t, 3>> triangles) {
  const std::vector<std::uint32_t> sizes(triangles.size(), 3);
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * triangles.size());
  for (const std::array<std::uint32_t, 3>& triangle : triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  return of_polygons(points, corners, sizes);
}

Model Model::of_polygons(std::span<const std::array<double, 3>> points, std::span<const std::uint32_t> corners,
                         std::span<const std::uint32_t> sizes) {
  Polygon_soup soup;
  for (const std::array<double, 3>& p : points) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      throw std::domain_error("point " + std::to_string(soup.point_count()) + " has a coordinate that is no number");
    soup.add_point(p[0], p[1], p[2]);
  }
  for (const std::uint32_t corner : corners) require_index(corner, points.size());
  std::size_t next = 0;
  for (const std::uint32_t size : sizes) {
    if (size > corners.size() - next) throw std::invalid_argument("the sizes of faces are more than the corners");
    soup.add_face(corners.subspan(next, size));
    next += size;
  }
  if (next != corners.size()) throw std::invalid_argument("the sizes of faces are less than the corners");
  return Model(std::move(soup));
}

std::size_t Model::face_count() const { return inside_->soup.face_count(); }
const std::vector<Left_out>& Model::left_out() const { return inside_->left_out(); }
const std::vector<Part>& Model::parts() const { return inside_->parts(); }
const Polygon_soup& Model::soup() const { return inside_->soup; }
const Scene& Model::scene() const { return inside_->scene(); }
const std::shared_ptr<const Model::Inside>& Model::inside() const { return inside_; }

Facts Model::facts() const { return inside_->facts(); }

double Model::area(Face_id face) const {
  double sum = 0;
  for (const Piece& piece : inside_->scene().pieces())
    if (piece.face == face) sum += inside_->part(piece).area();
  return sum;
}

}  // namespace sightline
