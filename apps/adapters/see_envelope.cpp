// An adapter for `sightline judge`: what an eye sees by CGAL's lower envelopes of triangles in space, exact numbers.

#include "adapter.h"

#include <sightline/algorithms/verify/polygons.h>
#include <sightline/kernel/traits/point_traits.h>

#include <CGAL/Env_surface_data_traits_3.h>
#include <CGAL/Env_triangle_traits_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/envelope_3.h>

#include <set>

namespace {

using namespace sightline;
using Kernel = CGAL::Epeck;
using Traits = CGAL::Env_surface_data_traits_3<CGAL::Env_triangle_traits_3<Kernel>, Face_id>;
using Polygon = std::vector<Exact_point>;

/// The part of a convex polygon where a linear form is not negative.
Polygon clipped(const Polygon& polygon, const std::array<int, 3>& form) {
  const auto value = [&](const Exact_point& p) { return Rational(form[0] * p[0] + form[1] * p[1] + form[2] * p[2]); };
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Exact_point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Rational at_p = value(p), at_q = value(q);
    if (sgn(at_p) >= 0) part.push_back(p);
    if (sgn(at_p) * sgn(at_q) >= 0) continue;
    const Rational share = at_p / (at_p - at_q);
    part.push_back({p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1]), p[2] + share * (q[2] - p[2])});
  }
  return part;
}

/// The six cones to the sides of a cube around the eye fill all directions. In each, (x, y, z) -> (x / z, y / z, -1 /
/// z) takes rays of the eye to vertical lines, nearer points lower, so the faces of the lower envelope say what is
/// seen; where several triangles are on one, all of them are.
void solve(const adapter::Task& task) {
  std::set<Face_id> visible;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int sense : {1, -1}) {
      const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
      std::vector<Traits::Surface_3> triangles;
      for (const Piece& piece : task.scene.pieces()) {
        Polygon polygon;  // as the eye has it, with z along the cone
        for (const Exact_point& p : task.scene.corner_points(piece)) {
          const auto along = [&](std::size_t k) { return Rational(p[k] - task.query.eye[k]); };
          polygon.push_back({along(x), along(y), Rational(sense * along(axis))});
        }
        const certificate_check::Plane plane{certificate_check::newell_normal(polygon), polygon[0]};
        const int side = plane.side({0, 0, 0}) * sense;
        if (side == 0) continue;  // edge-on: it hides nothing
        for (const std::array<int, 3>& form :
             {std::array{1, 0, 1}, std::array{-1, 0, 1}, std::array{0, 1, 1}, std::array{0, -1, 1}})
          polygon = clipped(polygon, form);
        std::vector<Kernel::Point_3> images;
        const auto number = [](const Rational& value) { return Field_number<Kernel::FT>::from(value); };
        for (const Exact_point& p : polygon)
          images.push_back({number(p[0] / p[2]), number(p[1] / p[2]), number(-1 / p[2])});
        for (std::size_t k = 2; k < images.size(); ++k)
          if (const Kernel::Triangle_3 triangle(images[0], images[k - 1], images[k]); !triangle.is_degenerate())
            triangles.emplace_back(
                triangle, 2 * piece.face + (side < 0 && !task.query.two_sided));  // odd: it hides, but does not count
      }
      CGAL::Envelope_diagram_2<Traits> diagram;
      CGAL::lower_envelope_3(triangles.begin(), triangles.end(), diagram);
      for (auto face = diagram.faces_begin(); face != diagram.faces_end(); ++face)
        for (auto surface = face->surfaces_begin(); surface != face->surfaces_end(); ++surface)
          if (surface->data() % 2 == 0) visible.insert(surface->data() / 2);
    }
  adapter::write_answer(task, {{"visible", visible}});
}

}  // namespace

int main(int argc, char** argv) { return adapter::main(argc, argv, sightline::judge::Question::see, solve); }
