#include <sightline/harness/generate/projective.h>

#include <algorithm>
#include <stdexcept>

namespace sightline::generate {

Rational determinant(const std::vector<std::vector<Rational>>& m) {
  if (m.empty()) return 1;
  Rational sum = 0;
  for (std::size_t column = 0; column < m.size(); ++column) {
    std::vector<std::vector<Rational>> minor;
    for (std::size_t row = 1; row < m.size(); ++row) {
      minor.push_back(m[row]);
      minor.back().erase(minor.back().begin() + static_cast<std::ptrdiff_t>(column));
    }
    sum += (column % 2 == 0 ? 1 : -1) * m[0][column] * determinant(minor);
  }
  return sum;
}

Rational image_coordinate(const Projective_map& map, std::size_t row, const Exact_point& p) {
  return Rational(map[row][0] * p[0] + map[row][1] * p[1] + map[row][2] * p[2] + map[row][3]);
}

Exact_point image(const Projective_map& map, const Exact_point& p) {
  const Rational weight = image_coordinate(map, 3, p);
  if (sgn(weight) <= 0) throw std::invalid_argument("a point goes to infinity, or beyond it");
  return {Rational(image_coordinate(map, 0, p) / weight), Rational(image_coordinate(map, 1, p) / weight),
          Rational(image_coordinate(map, 2, p) / weight)};
}

Weak_scene project(const Weak_scene& scene, const Projective_map& map) {
  std::vector<std::vector<Rational>> rows;
  for (const auto& row : map) rows.emplace_back(row.begin(), row.end());
  const int turn = sgn(determinant(rows));
  if (turn == 0) throw std::invalid_argument("not a projective map: its determinant is zero");
  Weak_scene result = scene;
  result.soup = mapped(scene.soup, [&](Point_id, const Exact_point& p) { return image(map, p); });
  for (Exact_point& p : result.source) p = image(map, p);
  if (turn < 0) {
    result.soup = faces_reversed(result.soup);
    result.source = reversed(result.source);
  }
  return result;
}

Projective_map affine_map(const Rational_matrix& matrix, const Exact_point& offset) {
  Projective_map map;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) map[i][j] = matrix[i][j];
    map[i][3] = offset[i];
    map[3][i] = 0;
  }
  map[3][3] = 1;
  return map;
}

Projective_map scaling(const Rational& factor, const Exact_point& offset) {
  return affine_map({{{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}}}, offset);
}

Projective_map random_rotation(Random& random) {
  const auto part = [&] { return static_cast<long>(random.between(-3, 3)); };
  const long a = static_cast<long>(random.between(1, 4)), b = part(), c = part(), d = part();
  return affine_map(rotation(a, b, c, d), at(0, 0, 0));
}

Projective_map random_axes(Random& random) {
  std::vector<std::size_t> order{0, 1, 2};
  random.shuffle(order);
  Rational_matrix matrix{};
  for (std::size_t i = 0; i < 3; ++i) matrix[i][order[i]] = random.chance(1, 2) ? -1 : 1;
  return affine_map(matrix, at(0, 0, 0));
}

Projective_map random_shear(Random& random) {
  while (true) {
    Rational_matrix matrix;
    std::vector<std::vector<Rational>> rows;
    for (auto& row : matrix) {
      for (Rational& x : row) x = integer(random, -2, 2);
      rows.emplace_back(row.begin(), row.end());
    }
    if (sgn(determinant(rows)) != 0) return affine_map(matrix, lattice(random, 2));
  }
}

Projective_map random_projection(const Weak_scene& scene, Random& random) {
  Projective_map map = random_shear(random);
  for (std::size_t j = 0; j < 3; ++j) map[3][j] = ratio(static_cast<long>(random.between(-2, 2)), 4);
  map[3][3] = 1;
  Rational least = 1;
  const auto note = [&](const Exact_point& p) { least = std::min(least, image_coordinate(map, 3, p)); };
  for (std::size_t p = 0; p < scene.soup.point_count(); ++p) note(scene.soup.point(static_cast<Point_id>(p)));
  for (const Exact_point& p : scene.source) note(p);
  if (least < 1) map[3][3] += 1 - least;
  std::vector<std::vector<Rational>> rows;
  for (const auto& row : map) rows.emplace_back(row.begin(), row.end());
  return sgn(determinant(rows)) == 0 ? random_rotation(random) : map;
}

}  // namespace sightline::generate
