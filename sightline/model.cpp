#include <sightline/model_inside.h>

#include <sightline/algorithms/bsp/build.h>
#include <sightline/io/read.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/scene/whole_points.h>
#include <sightline/kernel/time_limit.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sightline {
namespace {

// ---- Measures: of whole numbers, rounded at the end

/// x 2^-exponent, to 2^-52 of itself.
double near(const Integer& x, long exponent) {
  long own;
  const double mantissa = mpz_get_d_2exp(&own, x.get_mpz_t());
  return std::ldexp(mantissa, static_cast<int>(own - exponent));
}

/// A direction; times 2^-exponent its largest coordinate is between 1/2 and 1, so that doubles hold products of it.
struct Whole_direction {
  Whole_point v;
  long exponent;
};
Whole_direction direction(const Exact_point& from, const Exact_point& to) {
  const std::array<Exact_point, 2> ends{from, to};
  const std::vector<Whole_point> whole = made_whole(ends).points;
  Whole_direction direction{minus(whole[1], whole[0]), 0};
  for (const Integer& x : direction.v)
    direction.exponent = std::max(direction.exponent, static_cast<long>(bit_length(x)));
  return direction;
}

/// The sum of roots of whole numbers, each times a sign, times 2^places: to 4.
struct Signed_root {
  int sign;
  Integer square;
};
Integer sum_of_roots(const std::array<Signed_root, 4>& roots, mp_bitcnt_t places) {
  Integer sum = 0;
  for (const Signed_root& root : roots) sum += root.sign * Integer(sqrt(Integer(root.square << (2 * places))));
  return sum;
}

/// Of a triangle by Van Oosterom and Strackee's formula: half of it has a tangent that is a volume over a sum of roots.
/// The volume is exact, so that thin triangles keep their precision. Where the eye is close to a triangle both may be
/// close to 0 beside the roots; then these are taken to so many places that the larger of both, which is no less than 1
/// in whole numbers, has 58 bits.
double solid_angle_of(const Whole_direction& a, const Whole_direction& b, const Whole_direction& c) {
  constexpr double large = 0x1p-6;  // of a sum, by its largest term: doubles have it to about 2^-44 of itself
  constexpr mp_bitcnt_t places = 60;
  const Integer volume = abs(dot(a.v, cross(b.v, c.v)));
  if (volume == 0) return 0;
  const Integer aa = dot(a.v, a.v), bb = dot(b.v, b.v), cc = dot(c.v, c.v), ab = dot(a.v, b.v), bc = dot(b.v, c.v),
                ca = dot(c.v, a.v);
  const double la = std::sqrt(near(aa, 2 * a.exponent)), lb = std::sqrt(near(bb, 2 * b.exponent)),
               lc = std::sqrt(near(cc, 2 * c.exponent)),
               near_volume = near(volume, a.exponent + b.exponent + c.exponent),
               below = la * lb * lc + near(ab, a.exponent + b.exponent) * lc + near(bc, b.exponent + c.exponent) * la +
                       near(ca, c.exponent + a.exponent) * lb;
  if (std::hypot(near_volume, below) >= large * la * lb * lc) return 2 * std::atan2(near_volume, below);
  const Integer height = volume << places, width = sum_of_roots({{{1, Integer(aa * bb * cc)},
                                                                  {sgn(ab), Integer(ab * ab * cc)},
                                                                  {sgn(bc), Integer(bc * bc * aa)},
                                                                  {sgn(ca), Integer(ca * ca * bb)}}},
                                                                places);
  const auto bits = static_cast<long>(std::max(bit_length(height), bit_length(width)));
  return 2 * std::atan2(near(height, bits), near(width, bits));
}

void require_index(std::uint32_t index, std::size_t count) {
  if (index >= count)
    throw std::out_of_range("corner " + std::to_string(index) + " is no point: there are " + std::to_string(count));
}

}  // namespace

// ---- Budgets

std::function<bool()> end_of_budget(const Asking& asking) { return Time_limit(asking.budget).end(); }

Asking::Progress progress_within_budget(const Asking& asking) {
  const std::function<bool()> is_over = end_of_budget(asking);
  if (!is_over) return asking.progress;
  return [is_over, progress = asking.progress](std::size_t done, std::size_t all) {
    if (is_over()) throw Out_of_budget("undecided: the budget ran out; give it more seconds, or a smaller scene");
    if (progress) progress(done, all);
  };
}

// ---- Answers

std::string Answer::certificate(const Asking::Progress& progress) const {
  if (!certify_) throw std::logic_error("no question made this answer: take that of see(), order() or another one");
  return certify_(progress);
}

// ---- Parts

double Part::area() const {
  const Whole_points whole = made_whole(corners);
  const std::vector<Whole_point>& p = whole.points;
  Whole_point twice{0, 0, 0};
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const Whole_point part = cross(minus(p[i], p[0]), minus(p[i + 1], p[0]));
    for (std::size_t k = 0; k < 3; ++k) twice[k] += part[k];
  }
  long exponent, of_scale;
  double square = mpz_get_d_2exp(&exponent, Integer(dot(twice, twice)).get_mpz_t());
  const double scale = mpz_get_d_2exp(&of_scale, Integer(whole.scale * whole.scale).get_mpz_t());
  if (exponent % 2 != 0) {
    square *= 2;
    --exponent;
  }
  return std::ldexp(std::sqrt(square) / scale, static_cast<int>(exponent / 2 - of_scale)) / 2;
}

double Part::solid_angle(const Exact_point& eye) const {
  std::vector<Whole_direction> rays;
  for (const Exact_point& p : corners) rays.push_back(direction(eye, p));
  double sum = 0;
  for (std::size_t i = 1; i + 1 < rays.size(); ++i) sum += solid_angle_of(rays[0], rays[i], rays[i + 1]);
  return sum;
}

// ---- The model

void require_face(Face_id face, std::size_t count) {
  if (face >= count)
    throw std::out_of_range("face " + std::to_string(face) + " is not there: there are " + std::to_string(count) +
                            ", counted from 0");
}

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
  part.corners = of.corner_points(piece);
  return part;
}

const Bsp_tree<Exact_traits>& Model::Inside::tree(int threads, const Asking::Progress& progress) const {
  return tree_.get(
      [&] {
        Bsp_options options;
        options.threads = threads;
        options.progress = progress;
        return build_bsp(traits(progress), options);
      },
      progress);
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
    if (c.faces > 0) found.box = of.box_of_faces();
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
const std::vector<Left_out>& Model::left_out() const& { return inside_->left_out(); }
const std::vector<Part>& Model::parts() const& { return inside_->parts(); }
const Polygon_soup& Model::soup() const& { return inside_->soup; }
const Scene& Model::scene() const& { return inside_->scene(); }
std::shared_ptr<const Model::Inside> Model::inside() const { return inside_; }

Facts Model::facts() const { return inside_->facts(); }

double Model::area(Face_id face) const {
  require_face(face, face_count());
  double sum = 0;
  for (const Piece& piece : inside_->scene().pieces())
    if (piece.face == face) sum += inside_->part(piece).area();
  return sum;
}

}  // namespace sightline
