#include <sightline/algorithms/solids/space_ids.h>

#include <algorithm>
#include <cmath>

namespace sightline {

namespace {

/// Numbers modulo the prime 2^31 - 1.
using Residue = std::uint64_t;
constexpr Residue prime = (Residue{1} << 31) - 1;

Residue reduced(std::uint64_t n) {
  n = (n & prime) + (n >> 31);
  n = (n & prime) + (n >> 31);
  return n >= prime ? n - prime : n;
}
Residue difference(Residue a, Residue b) { return a >= b ? a - b : a + prime - b; }
/// Pre: a, b < prime: one step leaves less than twice the prime.
Residue times(Residue a, Residue b) {
  const std::uint64_t product = a * b, n = (product & prime) + (product >> 31);
  return n >= prime ? n - prime : n;
}

/// Of a two's complement number: 2^64 is 4.
Residue residue(const Limb* limbs, int count) {
  Residue r = static_cast<std::int64_t>(limbs[count - 1]) < 0 ? prime - 1 : 0;
  for (int i = count; i-- > 0;) r = reduced(4 * r + reduced(limbs[i]));
  return r;
}
Residue residue(const Integer& n) {
  const Residue r = mpz_tdiv_ui(n.get_mpz_t(), prime);
  return sgn(n) < 0 && r != 0 ? prime - r : r;
}

/// By Fermat: a^(prime - 2), whose exponent is 29 ones, a zero and a one. Pre: a != 0.
Residue inverse(Residue a) {
  const auto followed_by = [](Residue ones, int steps, Residue more) {
    for (int k = 0; k < steps; ++k) ones = times(ones, ones);
    return times(ones, more);
  };
  const Residue ones2 = followed_by(a, 1, a), ones4 = followed_by(ones2, 2, ones2);
  const Residue ones8 = followed_by(ones4, 4, ones4), ones16 = followed_by(ones8, 8, ones8);
  const Residue ones24 = followed_by(ones16, 8, ones8), ones28 = followed_by(ones24, 4, ones4);
  const Residue ones29 = followed_by(ones28, 1, a);
  return followed_by(ones29, 2, a);
}

template <std::size_t Size>
using Residues = std::array<Residue, Size>;

/// Divides by the last one that is not zero: rows that are proportional become equal. Whether there is one.
template <std::size_t Size>
bool normalize(Residues<Size>& row) {
  std::size_t last = Size;
  while (last > 0 && row[last - 1] == 0) --last;
  if (last == 0) return false;
  if (row[last - 1] == 1) return true;
  const Residue factor = inverse(row[last - 1]);
  for (Residue& r : row) r = times(r, factor);
  return true;
}

/// Where a factor of the row is a multiple of the prime: of the row without it.
template <std::size_t Size>
Residues<Size> residues_of_primitive(std::array<Integer, Size> row) {
  Integer common;
  for (const Integer& n : row) common = gcd(common, n);
  Residues<Size> residues;
  for (std::size_t k = 0; k < Size; ++k) {
    mpz_divexact(row[k].get_mpz_t(), row[k].get_mpz_t(), common.get_mpz_t());
    residues[k] = residue(row[k]);
  }
  normalize(residues);
  return residues;
}

template <std::size_t Size>
std::array<Limb, Size / 2> key_of(const Residues<Size>& row) {
  std::array<Limb, Size / 2> key;
  for (std::size_t k = 0; k < key.size(); ++k) key[k] = row[2 * k] << 32 | row[2 * k + 1];
  return key;
}

Residues<4> residues_of_plane(const Predicates& predicates, std::uint32_t id) {
  const Plane plane(id, false);
  if (plane.is_axis_plane()) {
    const std::array<Integer, 4> h = predicates.coefficients(plane);
    return {residue(h[0]), residue(h[1]), residue(h[2]), residue(h[3])};
  }
  const Plane_table& planes = predicates.planes();
  const auto entry = [&](int k) {
    return residue(planes.coefficient(id, k), k == 3 ? planes.offset_limbs() : planes.normal_limbs());
  };
  return {entry(0), entry(1), entry(2), entry(3)};
}

Residue minor(const Residues<4>& f, const Residues<4>& g, std::size_t i, std::size_t j) {
  return difference(times(f[i], g[j]), times(f[j], g[i]));
}

Residues<4> residues_of_vertex(const Predicates& predicates, const Vertex& v) {
  Residues<4> row;
  if (v.is_input()) {
    for (std::size_t k = 0; k < 3; ++k)
      row[k] = residue(predicates.points().coordinate(v.point, static_cast<int>(k)), predicates.points().limbs());
    row[3] = 1;
  } else {
    const Residues<4> f = residues_of_plane(predicates, v.plane[0]), g = residues_of_plane(predicates, v.plane[1]),
                      h = residues_of_plane(predicates, v.plane[2]);
    const auto three = [&](std::size_t i, std::size_t j, std::size_t k) {
      return reduced(times(f[i], minor(g, h, j, k)) + times(f[k], minor(g, h, i, j)) + prime -
                     times(f[j], minor(g, h, i, k)));
    };
    row = {difference(0, three(1, 2, 3)), three(0, 2, 3), difference(0, three(0, 1, 3)), three(0, 1, 2)};
  }
  return normalize(row) ? row : residues_of_primitive(predicates.homogeneous(v));
}

constexpr std::array<std::array<std::size_t, 2>, 6> minor_columns{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

Limb pair_key(std::uint32_t p, std::uint32_t q) { return Limb{std::min(p, q)} << 32 | std::max(p, q); }

}  // namespace

void Keyed_ids::add(const Limb* key) {
  const auto id = static_cast<std::uint32_t>(next_.size());
  next_.push_back(none);
  const std::uint32_t row = keys_.intern(key);
  if (row == first_.size()) {
    first_.push_back(id);
    last_.push_back(id);
  } else {
    next_[last_[row]] = id;
    last_[row] = id;
  }
}

// ---- Vertices

Vertex_ids::Vertex_ids(const Operands& operands)
    : predicates_(operands.predicates()), of_point_(operands.points().size(), none) {}

std::uint32_t Vertex_ids::id(const Vertex& v) {
  if (v.is_input()) {
    std::uint32_t& known = of_point_[v.point];
    if (known == none) known = find_or_add(v);
    return known;
  }
  std::array<std::uint32_t, 3> planes{v.plane[0], v.plane[1], v.plane[2]};
  std::sort(planes.begin(), planes.end());
  const Limb key[2] = {Limb{planes[0]} << 32 | planes[1], planes[2]};
  const std::uint32_t triple = triples_.intern(key);
  if (triple == of_triple_.size()) of_triple_.push_back(find_or_add(v));
  return of_triple_[triple];
}

std::uint32_t Vertex_ids::find_or_add(const Vertex& v) {
  const std::array<Limb, 2> key = key_of(residues_of_vertex(predicates_, v));
  for (std::uint32_t id = by_residues_.first(key.data()); id != none; id = by_residues_.next(id)) {
    Vertex& known = vertices_[id];
    if (!is_same(v, known)) continue;
    if (v.error < known.error) {
      known.x = v.x;
      known.y = v.y;
      known.z = v.z;
      known.error = v.error;
    }
    return id;
  }
  by_residues_.add(key.data());
  vertices_.push_back(v);
  return static_cast<std::uint32_t>(vertices_.size() - 1);
}

bool Vertex_ids::is_same(const Vertex& v, const Vertex& known) {
  return std::all_of(std::begin(known.plane), std::end(known.plane), [&](std::uint32_t plane) {
    return predicates_.side(v, predicates_.prepare(Plane(plane, false)), counts_) == CGAL::ZERO;
  });
}

const std::array<Integer, 4>& Vertex_ids::at(std::uint32_t id) const {
  if (exact_.size() < vertices_.size()) exact_.resize(vertices_.size());
  std::array<Integer, 4>& h = exact_[id];
  if (sgn(h[3]) == 0) h = predicates_.homogeneous(vertices_[id]);
  return h;
}

bool Vertex_ids::is_before(std::uint32_t a, std::uint32_t b, std::size_t axis) const {
  const Vertex &p = vertices_[a], &q = vertices_[b];
  const double step = axis == 0 ? q.x - p.x : axis == 1 ? q.y - p.y : q.z - p.z;
  const double bound = (p.error + q.error) * (1 + 0x1p-40);
  if (std::fabs(step) > bound) return step > 0;
  if (a == b) return false;
  return at(a)[axis] * at(b)[3] < at(b)[axis] * at(a)[3];
}

// ---- Lines

std::uint32_t Line_ids::id(std::uint32_t p, std::uint32_t q) {
  const Limb key = pair_key(p, q);
  const std::uint32_t pair = pairs_.intern(&key);
  if (pair == of_pair_.size()) of_pair_.push_back(find_or_add(p, q));
  return of_pair_[pair];
}

std::uint32_t Line_ids::id(std::uint32_t p, std::uint32_t q, std::uint32_t from, std::uint32_t to) {
  const Limb key = pair_key(p, q);
  const std::uint32_t pair = pairs_.intern(&key);
  if (pair < of_pair_.size()) return of_pair_[pair];
  const Limb ends_key = pair_key(from, to);
  const std::uint32_t ends = ends_.intern(&ends_key);
  if (ends == of_ends_.size()) of_ends_.push_back(find_or_add(p, q));
  of_pair_.push_back(of_ends_[ends]);
  return of_pair_.back();
}

std::uint32_t Line_ids::find_or_add(std::uint32_t p, std::uint32_t q) {
  const Residues<4> f = residues_of_plane(predicates_, p), g = residues_of_plane(predicates_, q);
  Residues<6> row;
  for (std::size_t k = 0; k < 6; ++k) row[k] = minor(f, g, minor_columns[k][0], minor_columns[k][1]);
  if (!normalize(row)) row = residues_of_primitive(minors(p, q));
  const std::array<Limb, 3> key = key_of(row);
  // 1. One that is known: proportional minors.
  std::uint32_t id = by_residues_.first(key.data());
  if (id != Keyed_ids::none) {
    const std::array<Integer, 6> own = minors(p, q);
    for (; id != Keyed_ids::none; id = by_residues_.next(id)) {
      const std::array<Integer, 6> known = minors(lines_[id].p, lines_[id].q);
      std::size_t k = 0;
      while (sgn(known[k]) == 0) ++k;
      bool same = true;
      for (std::size_t i = 0; i < 6 && same; ++i) same = own[i] * known[k] == own[k] * known[i];
      if (same) return id;
    }
  }
  // 2. Its direction is (minor 12, -minor 02, minor 01), of which one is not zero.
  by_residues_.add(key.data());
  std::uint8_t axis = 0;
  if (row[3] == 0) {
    const std::array<Integer, 6> own = minors(p, q);
    axis = sgn(own[3]) != 0 ? 0 : sgn(own[1]) != 0 ? 1 : 2;
  }
  lines_.push_back({p, q, axis});
  return static_cast<std::uint32_t>(lines_.size() - 1);
}

std::array<Integer, 6> Line_ids::minors(std::uint32_t p, std::uint32_t q) const {
  const std::array<Integer, 4> f = predicates_.coefficients(Plane(p, false));
  const std::array<Integer, 4> g = predicates_.coefficients(Plane(q, false));
  std::array<Integer, 6> row;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [i, j] = minor_columns[k];
    row[k] = f[i] * g[j] - f[j] * g[i];
  }
  return row;
}

}  // namespace sightline
