#include <sightline/algorithms/rays/tracer.h>

#include <sightline/kernel/located_point.h>
#include <sightline/kernel/predicates.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

namespace sightline {

// ---- A ray, made ready

/// A ray in doubles, in scaled coordinates: point o + s d for s = (t - shift) per_t - offset.
struct Ray_tracer::Ray {
  const Exact_ray* given = nullptr;  ///< or doubles, of which it is made where it is needed
  const Double_ray* doubles = nullptr;

  bool blind = false;  ///< doubles say nothing of it
  bool away = false;   ///< it passes the scene by
  Ray_boxes::Ray at{};
  std::optional<Rational> shift;  ///< of a ray from afar, which meets nothing before
  double offset = 0;              ///< likewise, of one from not so far
  double length = 1;              ///< of the direction's greatest coordinate, about

  std::array<std::size_t, 3> axis{};       ///< the direction is longest along the last
  std::array<double, 2> shear{};           ///< what the first two advance by per unit of the last: at most 1 in size
  double reach = 0, error = 0, bound = 0;  ///< for all corners: see Search::verdict

  Exact_ray exact() const { return given != nullptr ? *given : doubles->exact(); }
  /// What follows from `at`.
  void complete(double corner_error);
};

namespace {

using Vector = std::array<double, 3>;

double largest(const Vector& v) { return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])}); }
double dot_of(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

constexpr double tiny = 0x1p-900;  // more than what underflows
constexpr double far_away = 8;     // as far an origin may be
constexpr double too_far = 0x1p500;

/// The greatest coordinate of a direction, in size.
Rational largest(const Exact_point& direction) {
  Rational size = 0;
  for (const Rational& x : direction) size = std::max(size, Rational(abs(x)));
  return size;
}

/// Where a ray's line is nearest to the origin of coordinates.
double foot_of(const Ray_boxes::Ray& ray) {
  return -dot_of(ray.origin, ray.direction) / dot_of(ray.direction, ray.direction);
}

/// How far doubles of u_i v_j - u_j v_i are from their true values, where coordinates relative to the origin are at
/// most `size` and within `error`. Proof: P-95
double cross_bound(double size, double error) {
  const double each = 2 * error + 0x1p-49 * size;
  return 16 * std::max(size, each) * each + tiny;
}

}  // namespace

void Ray_tracer::Ray::complete(double corner_error) {
  std::size_t z = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::fabs(at.direction[k]) > std::fabs(at.direction[z])) z = k;
  axis = {(z + 1) % 3, (z + 2) % 3, z};
  for (std::size_t k = 0; k < 2; ++k) shear[k] = at.direction[axis[k]] / at.direction[z];
  reach = 1 + largest(at.origin) + at.error;
  error = at.error + corner_error + tiny;
  bound = cross_bound(reach, error);
}

Ray_tracer::Ray Ray_tracer::prepared(const Double_ray& doubles) const {
  Ray ray;
  ray.doubles = &doubles;
  ray.length = largest(doubles.direction);
  if (ray.length == 0) check_direction(doubles.exact());
  double error = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = ((doubles.origin[k] - centre_[k][0]) - centre_[k][1]) * about_per_unit_;
    error = std::max(error, 0x1p-50 * std::fabs(x) + 0x1p-100 * std::fabs(centre_[k][0] * about_per_unit_));
    ray.at.origin[k] = x;
    ray.at.direction[k] = doubles.direction[k] / ray.length;
  }
  ray.at.error = error + tiny;
  const double size = largest(ray.at.origin);
  if (about_per_unit_ > 0 && size <= far_away) {
    ray.complete(corner_error_);
  } else if (about_per_unit_ > 0 && size <= 0x1p20) {
    // From afar it begins anew before the point that is nearest to the scene's middle.
    ray.offset = foot_of(ray.at) - 4;
    if (ray.offset <= 0) {
      ray.away = true;
      return ray;
    }
    for (std::size_t k = 0; k < 3; ++k) ray.at.origin[k] += ray.offset * ray.at.direction[k];
    ray.at.error += 0x1p-50 * (size + ray.offset);
    if (largest(ray.at.origin) <= 2 * far_away) ray.complete(corner_error_);
    else ray.away = true;
  } else {
    const Exact_ray exact = doubles.exact();
    ray = prepared(exact);
    ray.given = nullptr;
    ray.doubles = &doubles;
  }
  return ray;
}

std::optional<Rational> Ray_tracer::start_from_afar(const Exact_ray& ray) const {
  const Rational per_t = largest(ray.direction) * per_unit_;
  const Exact_point centre = scene_->position({0, 0, 0, 1});
  Exact_point from, along;  // scaled
  Rational product = 0, square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    from[k] = (ray.origin[k] - centre[k]) * per_unit_;
    along[k] = ray.direction[k] * per_unit_ / per_t;
    product += from[k] * along[k];
    square += along[k] * along[k];
  }
  const Rational foot = -product / square;
  for (std::size_t k = 0; k < 3; ++k)
    if (abs(Rational(from[k] + foot * along[k])) > 4) return std::nullopt;
  Integer start;  // whole, so that it does not grow
  mpz_fdiv_q(start.get_mpz_t(), foot.get_num_mpz_t(), foot.get_den_mpz_t());
  start -= 4;
  if (start <= 0) return std::nullopt;
  return start / per_t;
}

Ray_tracer::Ray Ray_tracer::prepared(const Exact_ray& exact) const {
  check_direction(exact);
  Ray ray;
  ray.given = &exact;
  const Rational size = largest(exact.direction);
  ray.length = nearest_double(size);
  for (std::size_t k = 0; k < 3; ++k) ray.at.direction[k] = nearest_double(Rational(exact.direction[k] / size));
  const double per_t = nearest_double(Rational(size * per_unit_));
  Exact_point origin = exact.origin;
  for (int turn = 0; turn < 64; ++turn) {
    const Located_point at = scene_->locate(origin);
    ray.at.origin = {at.ax * scale_, at.ay * scale_, at.az * scale_};
    ray.at.error = at.error * scale_ + tiny;
    if (!(ray.at.error < too_far && largest(ray.at.origin) < too_far)) {  // doubles do not hold what is made of it
      if (ray.shift) break;
      const std::optional<Rational> start = start_from_afar(exact);
      if (!start) {
        ray.away = true;
        return ray;
      }
      ray.shift = start;
      origin = point_at(exact, *start);
      continue;
    }
    // From afar it begins anew a few units before the point that is nearest to the scene's middle.
    const double foot = -dot_of(ray.at.origin, ray.at.direction) / dot_of(ray.at.direction, ray.at.direction);
    if (turn == 0 ? largest(ray.at.origin) <= far_away : foot > 3 && largest(ray.at.origin) <= 2 * far_away) {
      ray.complete(corner_error_);
      return ray;
    }
    Vector nearest;
    for (std::size_t k = 0; k < 3; ++k) nearest[k] = ray.at.origin[k] + foot * ray.at.direction[k];
    if ((turn == 0 && foot <= 0) || largest(nearest) > 4 + 0x1p-40 * largest(ray.at.origin)) {
      ray.away = true;
      return ray;
    }
    const double by = (foot - 4) / per_t;
    if (!ray.shift) ray.shift = 0;
    *ray.shift += std::isnormal(by) ? sightline::exact(by) : Rational(sightline::exact(foot - 4) / (size * per_unit_));
    if (*ray.shift <= 0) break;
    origin = point_at(exact, *ray.shift);
  }
  ray.blind = true;
  return ray;
}

// ---- Looking for hits

class Ray_tracer::Search {
 public:
  Search(const Ray_tracer& tracer, const Ray& ray, Ray_start start, bool only_first, Ray_counters& counters)
      : tracer_(tracer),
        scene_(*tracer.scene_),
        ray_(ray),
        start_(start),
        only_first_(only_first),
        counters_(counters),
        whole_(tracer.grid_, ray.given, ray.doubles) {
    look();
  }

  /// What is met where doubles alone can tell; nothing where there may be several hits, or none.
  std::optional<Nearest> nearest() const;
  std::vector<Face_hit> hits();
  /// A hit between doubles.
  Nearest between(const Face_hit& hit) const;

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  /// What may be met, at s between low and high.
  struct Candidate {
    double low, high;
    Face_id face;
    Met_side side;
    std::uint32_t piece, exact;  ///< exact: a place in exact_, or none
    Met_border border;           ///< of a piece in whose plane the ray does not run
  };

  /// Where the plane of a piece is met, for certain; nothing where doubles do not tell.
  struct Depth {
    double low, high;
    Met_side side;
  };
  void look();
  void look_at(std::uint32_t place);
  /// Whether the ray's line passes inside a piece, outside of it, or closer to its border than doubles tell.
  enum class Verdict { outside, inside, open };
  Verdict verdict(const Flat& flat) const;
  Verdict verdict(const Flat& flat, double bound) const;
  Verdict verdict_there(const Flat& flat) const;
  std::optional<Depth> depth(const Flat& flat) const;

  void offer(const Candidate& candidate);
  void offer(Face_hit hit, std::uint32_t piece);
  /// Where doubles leave the border open, or, without a depth, the plane.
  /// `crosses`: the piece's plane, for certain.
  void look_exactly(std::uint32_t piece, const std::optional<Depth>& depth, bool crosses);
  /// All of a face of several pieces, as a ray that meets a border of one may meet others.
  void look_at_face(Face_id face);
  std::array<double, 2> bounds(const Rational& t) const;

  const Ray_tracer& tracer_;
  const Scene& scene_;
  const Ray& ray_;
  Ray_start start_;
  bool only_first_;
  Ray_counters& counters_;

  double limit_ = std::numeric_limits<double>::infinity();  // beyond it is nothing to be looked for
  boost::container::small_vector<Candidate, 8> candidates_;
  std::vector<Face_hit> exact_;
  std::vector<Face_id> whole_faces_;  // that look_at_face looked at
  Whole_ray whole_;
  bool begins_along_ = false;  // the ray begins in the plane of such a face, on it
};

void Ray_tracer::Search::look() {
  ++counters_.rays;
  if (ray_.away) return;
  if (ray_.blind) {
    for (const Flat& flat : tracer_.flats_) look_exactly(flat.piece, std::nullopt, false);
    return;
  }
  counters_.boxes += tracer_.boxes_.visit(
      ray_.at,
      [&](std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t place = first; place < first + count; ++place) look_at(place);
      },
      [&] { return limit_; });
}

inline Ray_tracer::Search::Verdict Ray_tracer::Search::verdict(const Flat& flat, double bound) const {
  const std::size_t x = ray_.axis[0], y = ray_.axis[1], z = ray_.axis[2];
  const Vector* corner = tracer_.corners(flat);
  const auto sheared = [&](const Vector& p) {
    const double along = p[z] - ray_.at.origin[z];
    return std::array<double, 2>{(p[x] - ray_.at.origin[x]) - ray_.shear[0] * along,
                                 (p[y] - ray_.at.origin[y]) - ray_.shear[1] * along};
  };
  std::array<double, 2> from = sheared(corner[flat.size - 1]);
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::uint32_t k = 0; k < flat.size; ++k) {
    const std::array<double, 2> to = sheared(corner[k]);
    const double side = from[0] * to[1] - from[1] * to[0];
    least = std::min(least, side);
    most = std::max(most, side);
    from = to;
  }
  if (least < -bound && most > bound) return Verdict::outside;
  return least > bound || most < -bound ? Verdict::inside : Verdict::open;
}

inline Ray_tracer::Search::Verdict Ray_tracer::Search::verdict(const Flat& flat) const {
  const Verdict quick = verdict(flat, ray_.bound);
  return quick != Verdict::open ? quick : verdict_there(flat);
}

/// The same with a bound for the corners of the piece alone.
[[gnu::noinline]] Ray_tracer::Search::Verdict Ray_tracer::Search::verdict_there(const Flat& flat) const {
  const Vector* corner = tracer_.corners(flat);
  double size = 0;
  for (std::uint32_t k = 0; k < flat.size; ++k)
    for (std::size_t i = 0; i < 3; ++i) size = std::max(size, std::fabs(corner[k][i] - ray_.at.origin[i]));
  return verdict(flat, cross_bound(size, ray_.error));
}

inline std::optional<Ray_tracer::Search::Depth> Ray_tracer::Search::depth(const Flat& flat) const {
  const Vector& n = flat.normal;
  const Vector& p = *tracer_.corners(flat);
  const double size = std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]);
  const double slope = dot_of(n, ray_.at.direction);
  const double rise = dot_of(n, {p[0] - ray_.at.origin[0], p[1] - ray_.at.origin[1], p[2] - ray_.at.origin[2]});
  const double slope_error = 0x1p-38 * size;  // directions are within 2^-40
  const double left = std::fabs(slope) - slope_error;
  if (!(left > slope_error)) return std::nullopt;
  const double s = rise / slope;
  const double error =
      (size * (ray_.error + 0x1p-49 * ray_.reach) + std::fabs(s) * size * 0x1p-49) / left * (1 + 0x1p-40) +
      0x1p-50 * std::fabs(s) + tiny;
  return Depth{s - error, s + error, slope < 0 ? Met_side::front : Met_side::back};
}

inline void Ray_tracer::Search::look_at(std::uint32_t place) {
  ++counters_.pieces;
  const Flat& flat = tracer_.flats_[place];
  const Verdict v = verdict(flat);
  if (v == Verdict::outside) return;
  const std::optional<Depth> d = depth(flat);
  if (d && (d->high < 0 || d->low > limit_)) return;
  if (!d || !(d->low > 0)) return look_exactly(flat.piece, std::nullopt, d.has_value());
  if (v == Verdict::open) return look_exactly(flat.piece, d, true);
  offer(Candidate{d->low, d->high, scene_.pieces()[flat.piece].face, d->side, flat.piece, none, {}});
}

inline void Ray_tracer::Search::offer(const Candidate& candidate) {
  candidates_.push_back(candidate);
  if (only_first_ && candidate.high < limit_) limit_ = candidate.high;
}

void Ray_tracer::Search::offer(Face_hit hit, std::uint32_t piece) {
  const auto [low, high] = bounds(hit.t);
  const auto place = static_cast<std::uint32_t>(exact_.size());
  const Candidate candidate{low, high, hit.face, hit.side, piece, place, {}};
  exact_.push_back(std::move(hit));
  offer(candidate);
}

void Ray_tracer::Search::look_exactly(std::uint32_t piece, const std::optional<Depth>& depth, bool crosses) {
  ++counters_.exact_pieces;
  const Face_id face = scene_.pieces()[piece].face;
  if (std::find(whole_faces_.begin(), whole_faces_.end(), face) != whole_faces_.end()) return;
  const bool alone = tracer_.first_piece_[face + 1] - tracer_.first_piece_[face] == 1;
  if (alone && depth) {  // t is exact where it is asked for
    if (const std::optional<Met_border> at = whole_.crosses(piece))
      offer(Candidate{depth->low, depth->high, face, depth->side, piece, none, *at});
    return;
  }
  std::optional<Face_hit> found = whole_.part(piece);
  if (!found) return;
  // All pieces in one plane that the line crosses are met at one t, or not.
  if (!alone && !(crosses && tracer_.is_flat_[face])) return look_at_face(face);
  if (start_ == Ray_start::closed || found->t > 0) offer(std::move(*found), piece);
}

void Ray_tracer::Search::look_at_face(Face_id face) {
  whole_faces_.push_back(face);
  std::vector<Face_hit> parts;
  for (std::uint32_t piece = tracer_.first_piece_[face]; piece < tracer_.first_piece_[face + 1]; ++piece)
    if (std::optional<Face_hit> found = whole_.part(piece)) {
      begins_along_ = begins_along_ || (found->t == 0 && found->until > 0);
      parts.push_back(std::move(*found));
    }
  for (Face_hit& hit : hits_of(std::move(parts), start_)) offer(std::move(hit), none);
}

// ---- What was found

/// Between which s what is met at t is.
std::array<double, 2> Ray_tracer::Search::bounds(const Rational& t) const {
  if (ray_.blind) return {0, std::numeric_limits<double>::infinity()};
  Rational exact = ray_.shift ? Rational(t - *ray_.shift) : t;
  exact *= tracer_.per_unit_ * largest(ray_.exact().direction);
  if (ray_.offset > 0) exact -= sightline::exact(ray_.offset);
  const double s = nearest_double(exact), error = 0x1p-52 * std::fabs(s) + tiny;
  return {s - error, s + error};
}

std::optional<Ray_tracer::Nearest> Ray_tracer::Search::nearest() const {
  if (begins_along_ && start_ == Ray_start::open) return std::nullopt;
  const Candidate* first = nullptr;
  bool tied = false;
  for (const Candidate& candidate : candidates_) {
    if (candidate.low > limit_) continue;
    if (candidate.exact != none) return std::nullopt;
    if (first != nullptr) {  // planes that the line crosses meet it in one point of a corner or an edge that they share
      if (!candidate.border.is_known() || candidate.border != first->border) return std::nullopt;
      tied = true;
    }
    if (first == nullptr || candidate.face < first->face) first = &candidate;
  }
  if (first == nullptr) return Nearest{};
  if (!whole_faces_.empty()) return std::nullopt;
  const double per_t = ray_.length * tracer_.about_per_unit_, shift = ray_.shift ? nearest_double(*ray_.shift) : 0;
  if (!(per_t > 0x1p-900 && per_t < 0x1p900 && std::isfinite(shift))) return std::nullopt;
  const auto at = [&](double s, double wider) {
    const double t = (s + ray_.offset) / per_t;
    return t + shift + wider * (0x1p-49 * (std::fabs(t) + std::fabs(shift)) + 0x1p-1060);
  };
  return Nearest{first->face, first->side, tied, at(first->low, -1), at(first->high, 1)};
}

std::vector<Face_hit> Ray_tracer::Search::hits() {
  std::vector<Face_hit> parts;
  for (const Candidate& candidate : candidates_) {
    if (candidate.low > limit_) continue;
    const bool superseded = candidate.piece != none &&
                            std::find(whole_faces_.begin(), whole_faces_.end(), candidate.face) != whole_faces_.end();
    if (superseded) continue;
    if (candidate.exact != none) {
      parts.push_back(exact_[candidate.exact]);
    } else {
      const Rational t = whole_.parameter(candidate.piece);
      parts.push_back({candidate.face, candidate.side, t, t});
    }
  }
  counters_.exact_orders += only_first_ && parts.size() > 1;
  std::vector<Face_hit> all = hits_of(std::move(parts), start_);
  if (!only_first_) return all;
  if (begins_along_ && start_ == Ray_start::open)  // what was passed over may have hidden what goes on in it
    all = Search(tracer_, ray_, start_, false, counters_).hits();
  return only_first(std::move(all));
}

Ray_tracer::Nearest Ray_tracer::Search::between(const Face_hit& hit) const {
  const double t = nearest_double(hit.t), error = 0x1p-52 * std::fabs(t) + 0x1p-1060;
  if (std::isinf(t)) return {hit.face, hit.side, false, std::numeric_limits<double>::max(), t};
  return {hit.face, hit.side, false, t - error, t + error};
}

// ---- The tracer

Ray_tracer::Ray_tracer(const Scene& scene) : scene_(&scene), grid_(scene) {
  // 1. Doubles: coordinates of at most 1.
  const Grid_points& points = scene.points();
  const Exact_point centre = scene.position({0, 0, 0, 1});
  int exponent = 0;
  std::frexp(points.range(), &exponent);
  scale_ = std::ldexp(1.0, std::min(-exponent, 1000));
  per_unit_ = sightline::exact(scale_) / (grid_.step() * points.divisor());
  mpq_div_2exp(per_unit_.get_mpq_t(), per_unit_.get_mpq_t(), static_cast<mp_bitcnt_t>(points.shift()));
  about_per_unit_ = nearest_double(per_unit_);
  for (std::size_t k = 0; k < 3; ++k) {
    centre_[k][0] = nearest_double(centre[k]);
    if (std::isfinite(centre_[k][0]))
      centre_[k][1] = nearest_double(Rational(centre[k] - sightline::exact(centre_[k][0])));
    else about_per_unit_ = 0;
  }
  if (!(about_per_unit_ > 0x1p-900 && about_per_unit_ < 0x1p900)) about_per_unit_ = 0;
  corner_error_ = (points.bits() <= 53 ? 0 : 0x1p-51) + 0x1p-1074 * scale_;  // rounding, and what underflows

  // 2. Which pieces a face has.
  const std::vector<Piece>& pieces = scene.pieces();
  first_piece_.assign(scene.counters().faces_read + 1, 0);
  for (const Piece& piece : pieces) ++first_piece_[piece.face + 1];
  for (std::size_t f = 1; f < first_piece_.size(); ++f) first_piece_[f] += first_piece_[f - 1];
  is_flat_.assign(scene.counters().faces_read, true);
  for (const Piece& piece : pieces)
    if (!(piece.support == pieces[first_piece_[piece.face]].support)) is_flat_[piece.face] = false;

  // 3. Boxes, and pieces in their order.
  const auto scaled = [&](std::uint32_t point) {
    return Vector{scale_ * points.approximate(point, 0), scale_ * points.approximate(point, 1),
                  scale_ * points.approximate(point, 2)};
  };
  std::vector<Ray_boxes::Box> boxes(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    boxes[i].low.fill(1);
    boxes[i].high.fill(-1);
    for (const Piece_corner& corner : scene.corners(pieces[i])) {
      const Vector p = scaled(corner.point);
      for (std::size_t k = 0; k < 3; ++k) {
        boxes[i].low[k] = std::min(boxes[i].low[k], p[k]);
        boxes[i].high[k] = std::max(boxes[i].high[k], p[k]);
      }
    }
  }
  boxes_ = Ray_boxes(boxes);
  flats_.reserve(pieces.size());
  const Predicates exact = scene.predicates();
  for (const std::uint32_t i : boxes_.order()) {
    const Prepared_plane h = exact.prepare(pieces[i].support);
    const double size = h.norm > 0x1p-900 && h.norm < 0x1p900 ? h.norm : std::numeric_limits<double>::infinity();
    Flat& flat = flats_.emplace_back(Flat{i, pieces[i].size, {h.a / size, h.b / size, h.c / size}, {}});
    const std::span<const Piece_corner> its = scene.corners(pieces[i]);
    if (flat.size > Flat::most) flat.corners[0][0] = static_cast<double>(more_.size());
    for (std::size_t k = 0; k < its.size(); ++k) {
      if (flat.size > Flat::most) more_.push_back(scaled(its[k].point));
      else flat.corners[k] = scaled(its[k].point);
    }
  }
}

std::vector<Face_hit> Ray_tracer::first(const Exact_ray& ray, Ray_start start, Ray_counters& counters) const {
  const Ray made = prepared(ray);
  return Search(*this, made, start, true, counters).hits();
}

std::vector<Face_hit> Ray_tracer::all(const Exact_ray& ray, Ray_start start, Ray_counters& counters) const {
  const Ray made = prepared(ray);
  return Search(*this, made, start, false, counters).hits();
}

Ray_tracer::Nearest Ray_tracer::nearest(const Double_ray& ray, Ray_start start, Ray_counters& counters) const {
  const Ray made = prepared(ray);
  Search search(*this, made, start, true, counters);
  if (const std::optional<Nearest> sure = search.nearest()) return *sure;
  const std::vector<Face_hit> hits = search.hits();
  if (hits.empty()) return {};
  Nearest first = search.between(hits.front());
  first.tied = hits.size() > 1;
  return first;
}

}  // namespace sightline
