#include <sightline/harness/generate/buildings.h>

#include <sightline/harness/generate/random.h>
#include <sightline/kernel/number.h>

namespace sightline::generate {

void Lattice_points::add_wall(std::array<std::size_t, 3> p, std::size_t axis, bool positive, std::size_t width,
                              std::size_t height) {
  std::array<std::size_t, 3> q = p, r = p, s = p;
  const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;  // b x c = axis
  q[b] += width;
  r[b] += width;
  r[c] += height;
  s[c] += height;
  if (positive) soup_.add_face({id(p), id(q), id(r), id(s)});
  else soup_.add_face({id(p), id(s), id(r), id(q)});
}

template <class Is_solid, class Function>
void Lattice_points::for_each_wall(Is_solid is_solid, Function f) {
  const auto solid = [&](std::array<std::size_t, 3> cell) {
    for (std::size_t i = 0; i < 3; ++i)
      if (cell[i] + 1 >= planes_[i].size()) return false;  // also below 0, which wraps round
    return static_cast<bool>(is_solid(cell[0], cell[1], cell[2]));
  };
  std::array<std::size_t, 3> p;
  for (p[2] = 0; p[2] < planes_[2].size(); ++p[2])
    for (p[1] = 0; p[1] < planes_[1].size(); ++p[1])
      for (p[0] = 0; p[0] < planes_[0].size(); ++p[0]) {
        const bool here = solid(p);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          std::array<std::size_t, 3> behind = p;
          behind[axis] = p[axis] == 0 ? std::numeric_limits<std::size_t>::max() - 1 : p[axis] - 1;
          const bool there = solid(behind);
          if (here != there) f(p, axis, there);
        }
      }
}

Point_id Lattice_points::id(const std::array<std::size_t, 3>& p) {
  Point_id& known = ids_[(p[2] * planes_[1].size() + p[1]) * planes_[0].size() + p[0]];
  if (known == absent) known = soup_.add_point(planes_[0][p[0]], planes_[1][p[1]], planes_[2][p[2]]);
  return known;
}

std::vector<double> unit_planes(std::size_t n) {
  std::vector<double> planes;
  for (std::size_t i = 0; i <= n; ++i) planes.push_back(static_cast<double>(i));
  return planes;
}

Polygon_soup grid(std::size_t n) {
  require(n >= 1 && n <= 500, "grid: size must be in 1 .. 500");
  Polygon_soup soup;
  soup.file = "grid";
  Lattice_points lattice(soup, {unit_planes(n), unit_planes(n), unit_planes(n)});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<std::size_t, 3> p;
    const auto limit = [&](std::size_t i) { return i == axis ? n + 1 : n; };
    for (p[2] = 0; p[2] < limit(2); ++p[2])
      for (p[1] = 0; p[1] < limit(1); ++p[1])
        for (p[0] = 0; p[0] < limit(0); ++p[0]) lattice.add_wall(p, axis, true);
  }
  return soup;
}

Polygon_soup lattice(std::size_t n) {
  require(n >= 1 && n <= 10000000, "lattice: size must be in 1 .. 10^7");
  Polygon_soup soup;
  soup.file = "lattice";
  // Corners are on the twelve edges of the cube: a place for each of these, where Lattice_points has them all over it.
  constexpr Point_id absent = std::numeric_limits<Point_id>::max();
  std::vector<Point_id> ids(12 * (n + 1), absent);
  const auto id = [&](const std::array<std::size_t, 3>& p) {
    std::size_t along = 0;  // the cube's own corners are on edges along x
    for (std::size_t k = 1; k < 3; ++k)
      if (p[k] != 0 && p[k] != n) along = k;
    const std::size_t edge = 2 * (p[(along + 1) % 3] == n) + (p[(along + 2) % 3] == n);
    Point_id& known = ids[(4 * along + edge) * (n + 1) + p[along]];
    if (known == absent)
      known = soup.add_point(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
    return known;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i <= n; ++i) {
      std::array<std::size_t, 3> p{}, q, r, s;
      p[axis] = i;
      q = r = s = p;
      const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
      q[b] = r[b] = r[c] = s[c] = n;
      const Point_id first = id(p), second = id(q), third = id(r), fourth = id(s);
      soup.add_face({first, second, third, fourth});
    }
  return soup;
}

Polygon_soup menger_sponge(std::size_t level, bool merged) {
  require(level <= 5, "menger_sponge: level must be in 0 .. 5");
  std::size_t side = 1;
  for (std::size_t k = 0; k < level; ++k) side *= 3;
  Polygon_soup soup;
  soup.file = merged ? "menger_sponge_merged" : "menger_sponge";
  Lattice_points lattice(soup, {unit_planes(side), unit_planes(side), unit_planes(side)});
  const auto solid = [&](std::size_t x, std::size_t y, std::size_t z) {
    for (; x + y + z > 0; x /= 3, y /= 3, z /= 3)
      if ((x % 3 == 1) + (y % 3 == 1) + (z % 3 == 1) >= 2) return false;
    return true;
  };
  if (merged) lattice.add_merged_boundary(solid);
  else lattice.add_boundary(solid);
  return soup;
}

Polygon_soup city(std::size_t boxes, std::uint64_t seed, bool rotated) {
  require(boxes <= 100000000, "city: at most 10^8 boxes");
  std::size_t side = 1;
  while (side * side < boxes) ++side;
  Random random(seed);
  std::vector<std::size_t> cells(side * side);
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = i;
  random.shuffle(cells);

  struct Rotation {
    std::int64_t cosine, sine, radius;
  };
  constexpr std::array<Rotation, 5> triples{{{4, 3, 5}, {12, 5, 13}, {15, 8, 17}, {24, 7, 25}, {21, 20, 29}}};
  constexpr std::int64_t unit = 1024;  // of the coordinates below
  // In the worst case a box reaches 5/16 sqrt(2) + 3/64 < 0.489 or 5/16 + 11/64 < 0.485 from its cell's middle:
  // disjoint.
  constexpr std::int64_t least_half = unit / 8, most_half = 5 * unit / 16;
  const std::int64_t jitter = rotated ? 3 * unit / 64 : 11 * unit / 64;

  Polygon_soup soup;
  soup.file = rotated ? "city_rotated" : "city";
  soup.coordinates.reserve(24 * boxes + 12);
  for (std::size_t k = 0; k < boxes; ++k) {
    const std::int64_t x =
        unit * static_cast<std::int64_t>(cells[k] % side) + unit / 2 + random.between(-jitter, jitter);
    const std::int64_t y =
        unit * static_cast<std::int64_t>(cells[k] / side) + unit / 2 + random.between(-jitter, jitter);
    const std::int64_t half_x = random.between(least_half, most_half), half_y = random.between(least_half, most_half);
    const std::int64_t height = random.between(unit / 4, random.chance(1, 10) ? 4 * unit : unit);
    Rotation rotation{1, 0, 1};
    if (rotated) {
      rotation = triples[random.below(triples.size())];
      if (random.chance(1, 2)) std::swap(rotation.cosine, rotation.sine);
      if (random.chance(1, 2)) rotation.sine = -rotation.sine;
    }
    constexpr std::array<std::array<int, 2>, 4> corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    Point_id base = 0;
    for (const std::int64_t z : {std::int64_t{0}, height})
      for (const auto& [right, back] : corners) {
        const std::int64_t u = right * half_x, v = back * half_y;
        const std::int64_t p = x * rotation.radius + rotation.cosine * u - rotation.sine * v;
        const std::int64_t q = y * rotation.radius + rotation.sine * u + rotation.cosine * v;
        const double up = static_cast<double>(z) / unit;
        if (rotated) {
          Rational px(Integer(static_cast<long>(p)), Integer(static_cast<long>(unit * rotation.radius)));
          Rational py(Integer(static_cast<long>(q)), Integer(static_cast<long>(unit * rotation.radius)));
          px.canonicalize();
          py.canonicalize();
          soup.coordinates.push(px);
          soup.coordinates.push(py);
          soup.coordinates.push_double(up);
          base = static_cast<Point_id>(soup.point_count() - 8);
        } else {
          base = soup.add_point(static_cast<double>(p) / unit, static_cast<double>(q) / unit, up) - 7;
        }
      }
    for (Point_id i = 0; i < 4; ++i) {
      const Point_id j = (i + 1) % 4;
      soup.add_face({base + i, base + j, base + 4 + j, base + 4 + i});
    }
    soup.add_face({base + 4, base + 5, base + 6, base + 7});
  }
  const double end = static_cast<double>(side) + 1;
  const Point_id a = soup.add_point(-1.0, -1.0, 0.0), b = soup.add_point(end, -1.0, 0.0),
                 c = soup.add_point(end, end, 0.0), d = soup.add_point(-1.0, end, 0.0);
  soup.add_face({a, b, c, d});
  return soup;
}

Polygon_soup rooms(std::size_t nx, std::size_t ny, std::uint64_t seed) {
  require(nx >= 1 && ny >= 1 && nx <= 1000 && ny <= 1000 && nx * ny <= 100000,
          "rooms: at most 1000 rooms in a row and 10^5 in all");
  Random random(seed);
  constexpr std::size_t inner = 5, pitch = inner + 1;  // cells of a room, and with one wall

  // Planes: a wall, five cells, a wall, ...
  const auto planes = [&](std::size_t n) {
    std::vector<double> result{0.0};
    const auto go = [&](std::int64_t steps) { result.push_back(result.back() + static_cast<double>(steps) / 64); };
    for (std::size_t k = 0; k < n; ++k) {
      go(random.between(10, 20));
      for (std::size_t i = 0; i < inner; ++i) go(random.between(45, 80));
    }
    go(random.between(10, 20));
    return result;
  };
  std::array<std::vector<double>, 3> lattice_planes;
  lattice_planes[0] = planes(nx);
  lattice_planes[1] = planes(ny);
  lattice_planes[2] = {-0.25, 0.0, 0.75, 0.9375,
                       2.0,   2.5, 2.75};  // slab, furniture, sill, window head, door head, slab
  enum Level : std::size_t { below_floor, low, breast, eye, head, above_ceiling, levels };

  const std::size_t width = nx * pitch + 1, depth = ny * pitch + 1;
  std::vector<bool> solid(width * depth * levels, false);
  const auto at = [&](std::size_t x, std::size_t y, std::size_t z) { return solid[(z * depth + y) * width + x]; };
  const auto set = [&](std::size_t x, std::size_t y, std::size_t z, bool value) {
    solid[(z * depth + y) * width + x] = value;
  };
  for (std::size_t z = 0; z < levels; ++z)
    for (std::size_t y = 0; y < depth; ++y)
      for (std::size_t x = 0; x < width; ++x)
        set(x, y, z, z == below_floor || z == above_ceiling || x % pitch == 0 || y % pitch == 0);

  // Doors: all inner walls in random order, open where they join two parts of the house, or by chance.
  struct Wall {
    std::size_t x, y;
    bool along_y;  // the wall between rooms x - 1 and x, else between y - 1 and y
  };
  std::vector<Wall> walls;
  for (std::size_t y = 0; y < ny; ++y)
    for (std::size_t x = 0; x < nx; ++x) {
      if (x > 0) walls.push_back({x, y, true});
      if (y > 0) walls.push_back({x, y, false});
    }
  random.shuffle(walls);
  std::vector<std::size_t> part(nx * ny);
  for (std::size_t i = 0; i < part.size(); ++i) part[i] = i;
  const auto part_of = [&](std::size_t room) {
    while (part[room] != room) room = part[room] = part[part[room]];
    return room;
  };
  const auto open = [&](const Wall& wall, std::size_t from, std::size_t to) {
    const std::size_t cell = 2 + random.below(inner - 2);  // never beside another wall
    for (std::size_t z = from; z <= to; ++z) {
      if (wall.along_y) set(wall.x * pitch, wall.y * pitch + cell, z, false);
      else set(wall.x * pitch + cell, wall.y * pitch, z, false);
    }
  };
  for (const Wall& wall : walls) {
    const std::size_t here = part_of(wall.y * nx + wall.x),
                      there = part_of(wall.along_y ? wall.y * nx + wall.x - 1 : (wall.y - 1) * nx + wall.x);
    const bool more = random.chance(1, 6);
    if (here != there || more) open(wall, low, eye);
    part[here] = there;
  }
  open({0, random.below(ny), true}, low, eye);  // the front door, in the wall x = 0

  // Windows in the other outer walls.
  for (std::size_t x = 0; x < nx; ++x)
    for (const std::size_t y : {std::size_t{0}, ny})
      if (random.chance(2, 3)) open({x, y, false}, eye, eye);
  for (std::size_t y = 0; y < ny; ++y)
    if (random.chance(2, 3)) open({nx, y, true}, eye, eye);

  // Furniture: away from the walls so that no door is blocked; tables are low, cupboards high.
  for (std::size_t y = 0; y < ny; ++y)
    for (std::size_t x = 0; x < nx; ++x)
      for (std::size_t count = random.below(4); count > 0; --count) {
        const std::size_t cell_x = x * pitch + 2 + random.below(inner - 2),
                          cell_y = y * pitch + 2 + random.below(inner - 2);
        const std::size_t top = random.chance(1, 3) ? eye : low;
        for (std::size_t z = low; z <= top; ++z) set(cell_x, cell_y, z, true);
      }

  Polygon_soup soup;
  soup.file = "rooms";
  Lattice_points(soup, std::move(lattice_planes)).add_boundary(at);
  return soup;
}

}  // namespace sightline::generate
