#include <sightline/algorithms/baseline/doubles_search.h>

#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace sightline {

Weak_status Doubles_search::run(const Weak_source& source, std::uint32_t piece) {
  const std::array<double, 4>&of_source = source.plane.near, of_target = occluders_->plane(piece).near;
  const Polygon target = part(near_of(occluders_->polygon(piece)), of_source, 1);
  pieces_ = occluders_->near_shaft(source.polygon, occluders_->polygon(piece));
  Weak_status status = Weak_status::hidden;
  for (const int side : {1, -1}) {
    if (side < 0 && !options_->two_sided) continue;
    const Polygon from = part(near_of(source.polygon), of_target, side);
    if (from.size() < 3 || target.size() < 3) continue;
    cells_ = 0;
    const Weak_status found = search(from, target, 0);
    if (found != Weak_status::hidden) status = found;
    if (found == Weak_status::visible) break;
  }
  return status;
}

double Doubles_search::height(const std::array<double, 4>& h, const Triple& p) {
  return h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3];
}

std::array<double, 2> Doubles_search::reach(const Polygon& polygon, const std::array<double, 4>& h) {
  std::array<double, 2> most{0, 0};
  for (const Triple& p : polygon) most = {std::max(most[0], height(h, p)), std::max(most[1], -height(h, p))};
  return most;
}

Doubles_search::Polygon Doubles_search::part(const Polygon& polygon, const std::array<double, 4>& h, int side) const {
  Polygon kept;
  if (reach(polygon, h)[side > 0 ? 0 : 1] <= options_->tolerance) return kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Triple &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at = side * height(h, p), after = side * height(h, q);
    if (at >= 0) kept.push_back(p);
    if ((at > 0 && after < 0) || (at < 0 && after > 0)) {
      Triple& x = kept.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) x[k] = p[k] + at / (at - after) * (q[k] - p[k]);
    }
  }
  return kept;
}

Weak_status Doubles_search::search(const Polygon& source, const Polygon& target, int halvings) {
  if (++cells_ > options_->cells) return Weak_status::undecided;
  Weighted_line line;
  const std::optional<bool> has_line = find_line(source, target, line);
  if (!has_line) return halves(source, target, halvings);
  if (!*has_line) return Weak_status::hidden;

  std::vector<Side> open;  // edges of the blocker that lines of the cell may pass on both sides
  const std::optional<std::uint32_t> blocker = find_blocker(source, target, line, open);
  if (!blocker) return Weak_status::visible;
  const std::array<double, 4>& plane = occluders_->plane(*blocker).near;
  for (const Polygon* polygon : {&source, &target})
    if (const auto [front, behind] = reach(*polygon, plane); std::min(front, behind) > options_->tolerance)
      return both([&](int side) {
        return polygon == &source ? search(part(source, plane, side), target, halvings)
                                  : search(source, part(target, plane, side), halvings);
      });

  Weak_status status = Weak_status::hidden;
  const std::size_t above = path_.size();
  for (const Side& edge : open) {
    path_.push_back({edge.piece, edge.edge, -edge.sign});
    const Weak_status outside = search(source, target, halvings);
    path_.back().sign = edge.sign;
    if (outside != Weak_status::hidden) status = outside;
    if (outside == Weak_status::visible) break;
  }
  path_.resize(above);
  return status;
}

template <class Search>
Weak_status Doubles_search::both(Search search) {
  const Weak_status first = search(1);
  if (first == Weak_status::visible) return first;
  const Weak_status second = search(-1);
  return second == Weak_status::hidden ? first : second;
}

Weak_status Doubles_search::halves(const Polygon& source, const Polygon& target, int halvings) {
  if (halvings == options_->halvings) return Weak_status::undecided;
  double most = 0;
  bool of_source = true;
  std::array<double, 4> plane{};
  for (const Polygon* polygon : {&source, &target})
    for (const Triple& a : *polygon)
      for (const Triple& b : *polygon) {
        const Triple along{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        const double length = std::sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
        if (length <= most) continue;
        most = length;
        of_source = polygon == &source;
        for (std::size_t k = 0; k < 3; ++k) plane[k] = along[k] / length;
        plane[3] = -(plane[0] * (a[0] + b[0]) + plane[1] * (a[1] + b[1]) + plane[2] * (a[2] + b[2])) / 2;
      }
  if (most <= options_->tolerance) return Weak_status::hidden;
  return both([&](int side) {
    return of_source ? search(part(source, plane, side), target, halvings + 1)
                     : search(source, part(target, plane, side), halvings + 1);
  });
}

std::vector<double> Doubles_search::sides(const Polygon& source, const Polygon& target, std::uint32_t piece,
                                          std::size_t edge) const {
  std::vector<double> values;
  double most = 0;
  for (const Triple& p : source)
    for (const Triple& q : target)
      most =
          std::max(most, std::fabs(values.emplace_back(dot(pluecker_of_pair(p, q), occluders_->edges(piece)[edge]))));
  for (double& v : values) v = most > options_->tolerance * options_->tolerance ? v / most : 0;
  return values;
}

std::optional<bool> Doubles_search::find_line(const Polygon& source, const Polygon& target, Weighted_line& line) {
  const std::size_t m = source.size(), n = target.size();
  line = {std::vector<double>(m, 1.0 / static_cast<double>(m)), std::vector<double>(n, 1.0 / static_cast<double>(n))};
  rows_.clear();
  for (const Side& side : path_) {
    std::vector<double>& row = rows_.emplace_back(sides(source, target, side.piece, side.edge));
    for (double& v : row) v *= side.sign;
  }
  if (rows_.empty()) return true;
  // 1. Weights for all pairs of corners at once: if these have no room, no line has.
  game_.restart(m * n);
  for (const std::vector<double>& row : rows_) std::copy(row.begin(), row.end(), game_.add_row().begin());
  if (game_.solve() <= options_->tolerance) return false;
  line = {std::vector<double>(m, 0), std::vector<double>(n, 0)};
  for (std::size_t c = 0; c < m * n; ++c) {
    line.source[c / n] += game_.column_weights()[c];
    line.target[c % n] += game_.column_weights()[c];
  }
  // 2. The best end for the other one, in turn.
  for (int round = 0; round < 8; ++round)
    if (improve(line, round % 2 == 0) > options_->tolerance) {
      improve(line, round % 2 != 0);
      return true;
    }
  return std::nullopt;
}

double Doubles_search::improve(Weighted_line& line, bool source) {
  const std::size_t m = line.source.size(), n = line.target.size(), own = source ? m : n;
  end_.restart(own);
  for (const std::vector<double>& row : rows_) {
    const std::span<double> values = end_.add_row();
    std::fill(values.begin(), values.end(), 0.0);
    for (std::size_t c = 0; c < m * n; ++c)
      values[source ? c / n : c % n] += row[c] * (source ? line.target[c % n] : line.source[c / n]);
  }
  const double value = end_.solve();
  std::vector<double>& weights = source ? line.source : line.target;
  weights.assign(end_.column_weights().begin(), end_.column_weights().end());
  double middle = 1;  // the least side from there
  for (std::size_t k = 0; k < end_.rows(); ++k) {
    double sum = 0;
    for (const double v : end_.row(k)) sum += v;
    middle = std::min(middle, sum / static_cast<double>(own));
  }
  const double step = value <= 0 ? 0 : middle >= value ? 0.5 : std::min(0.5, value / 2 / (value - middle));
  for (double& w : weights) w = (1 - step) * w + step / static_cast<double>(own);
  return value;
}

Triple Doubles_search::mean(const Polygon& polygon, const std::vector<double>& weights) {
  Triple p{};
  for (std::size_t i = 0; i < polygon.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) p[k] += weights[i] * polygon[i][k];
  return p;
}

std::optional<std::uint32_t> Doubles_search::find_blocker(const Polygon& source, const Polygon& target,
                                                          const Weighted_line& line, std::vector<Side>& open) const {
  const Triple p = mean(source, line.source), q = mean(target, line.target);
  const Pluecker pluecker = pluecker_of_pair(p, q);
  std::optional<std::uint32_t> best;
  for (const std::uint32_t piece : pieces_) {
    const std::array<double, 4>& h = occluders_->plane(piece).near;
    const double from = height(h, p), to = height(h, q);
    if (std::min(std::fabs(from), std::fabs(to)) <= options_->tolerance || (from > 0) == (to > 0)) continue;
    const int sign = from > 0 ? 1 : -1;
    const std::span<const Pluecker> edges = occluders_->edges(piece);
    if (!std::all_of(edges.begin(), edges.end(), [&](const Pluecker& edge) { return sign * dot(pluecker, edge) >= 0; }))
      continue;
    std::vector<Side> of_piece;
    bool passed = false;  // by all of the cell, as doubles have it
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto known = std::find_if(path_.begin(), path_.end(),
                                      [&](const Side& side) { return side.piece == piece && side.edge == e; });
      if (known != path_.end()) {
        passed |= known->sign != sign;
        continue;
      }
      const std::vector<double> values = sides(source, target, piece, e);
      if (std::any_of(values.begin(), values.end(), [&](double v) { return sign * v < -options_->tolerance; }))
        of_piece.push_back({piece, e, sign});
    }
    if (passed || (best && of_piece.size() >= open.size())) continue;
    best = piece;
    open = of_piece;
  }
  return best;
}

Weak_faces visible_by_doubles(const Occluders& occluders, const std::vector<Weak_source>& sources,
                              const Doubles_search_options& options) {
  const std::vector<Piece>& pieces = occluders.scene().pieces();
  const std::vector<std::uint32_t> first = first_pieces(pieces);
  std::vector<Weak_status> results(first.size(), Weak_status::hidden);
  const auto decide = [&](std::size_t f, std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t piece = begin; piece < end; ++piece)
      for (const Weak_source& source : sources) {
        const Weak_status found = Doubles_search(occluders, options).run(source, piece);
        if (found != Weak_status::hidden) results[f] = found;
        if (found == Weak_status::visible) return;
      }
  };
  for_each_face(pieces, first, options.threads, options.progress, decide);
  Weak_faces all;
  for (std::size_t f = 0; f < first.size(); ++f) all.of(results[f]).push_back(pieces[first[f]].face);
  return all;
}

}  // namespace sightline
