// The predicates of Exact_view against rational numbers, by every stage.

#include "support.h"

#include <gtest/gtest.h>

namespace sightline::see_test {
namespace {

/// The same numbers by the book, relative to the eye, in the file's coordinates.
struct Rational_view {
  const Scene& scene;
  const Exact_point& eye;

  Exact_point direction(std::uint32_t point) const { return oracle::minus(scene.position(point), eye); }
  Exact_point normal(std::uint32_t p, std::uint32_t q) const { return oracle::cross(direction(p), direction(q)); }
  /// q of a piece: q . x = 1 in its plane.
  Exact_point form(std::uint32_t piece) const {
    const std::span<const Piece_corner> corners = scene.corners(scene.pieces()[piece]);
    const Exact_point a = direction(corners[0].point);
    const Exact_point n =
        oracle::cross(oracle::minus(direction(corners[1].point), a), oracle::minus(direction(corners[2].point), a));
    const Rational at = oracle::dot(n, a);
    return {Rational(n[0] / at), Rational(n[1] / at), Rational(n[2] / at)};
  }
  /// Through the eye and the line in which a plane n . x + d = 0 cuts that of a piece: d = d (q . x) there.
  Exact_point cut(std::uint32_t piece, const Exact_point& n, const Rational& d) const {
    return oracle::along(n, d, form(piece));
  }
};

TEST(Exact_view, decides_as_rationals_do_whichever_stage_it_is) {
  Predicate_counts counts;
  generate::Random random(11);
  std::size_t compared = 0;
  for (const view_scenes::Family family : view_scenes::families)
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
      for (view_scenes::Case given : view_scenes::make(family, seed)) {
        if (seed == 3)  // an eye that makes directions wide
          for (Rational& x : given.eye) x += Rational(1, 3 + static_cast<long>(random.below(5))) / 1048573;
        if (seed == 4)  // and one beyond 512 bits
          for (Rational& x : given.eye) x += exact(0x1p-90);
        SCOPED_TRACE(given.name);
        const Scene scene(given.soup);
        if (scene.pieces().empty()) continue;
        const Exact_view view(scene, given.eye);
        const Rational_view book{scene, given.eye};
        const auto some_point = [&] { return static_cast<std::uint32_t>(random.below(scene.points().size())); };
        const auto some_piece = [&] { return static_cast<std::uint32_t>(random.below(scene.pieces().size())); };
        for (int round = 0; round < 60; ++round) {
          const std::uint32_t a = some_point(), b = some_point(), c = some_point(),
                              d = round % 3 == 0 ? b : some_point(), e = some_point(), f = some_point();
          const Exact_point first = book.normal(a, b), second = book.normal(d, c), third = book.normal(e, f);
          ASSERT_EQ(view.side(view.edge(a, b), e, counts),
                    static_cast<Sign>(sgn(oracle::dot(first, book.direction(e)))));
          const std::uint32_t piece = some_piece(), other = some_piece();
          const bool faces = view.eye_side(piece) != CGAL::ZERO && view.eye_side(other) != CGAL::ZERO;
          if (view.eye_side(piece) != CGAL::ZERO) {
            ASSERT_EQ(view.beyond(piece, e, counts),
                      static_cast<Sign>(sgn(Rational(oracle::dot(book.form(piece), book.direction(e)) - 1))));
          }
          if (faces) {
            ASSERT_EQ(view.nearer(piece, other, view.ray(a), counts),
                      static_cast<Sign>(
                          sgn(oracle::dot(oracle::minus(book.form(piece), book.form(other)), book.direction(a)))));
          }
          if (view.eye_side(piece) != CGAL::ZERO) {
            // By the plane of another piece, which may hold the eye, and by an axis plane.
            const std::span<const Piece_corner> corners = scene.corners(scene.pieces()[other]);
            const Exact_point at = book.direction(corners[0].point),
                              n = oracle::cross(oracle::minus(book.direction(corners[1].point), at),
                                                oracle::minus(book.direction(corners[2].point), at));
            const Exact_point by_face = book.cut(piece, n, Rational(-oracle::dot(n, at)));
            const Exact_point by_axis = book.cut(piece, {0, 1, 0}, Rational(-book.direction(a)[1]));
            const Plane support = scene.pieces()[other].support;
            for (const auto& [cut, normal] : {std::pair(view.cut(piece, support), by_face),
                                              std::pair(view.opposite(view.cut(piece, support.opposite())), by_face),
                                              std::pair(view.cut(piece, Plane::across(1, a)), by_axis)}) {
              if (oracle::is_zero(normal)) continue;  // the planes do not cross
              ASSERT_EQ(view.side(cut, b, counts), static_cast<Sign>(sgn(oracle::dot(normal, book.direction(b)))));
              const Exact_point on_cut = oracle::cross(normal, first);
              if (oracle::is_zero(on_cut)) continue;
              ASSERT_EQ(view.side(view.edge(e, f), view.meet(cut, view.edge(a, b), counts), counts),
                        static_cast<Sign>(sgn(oracle::dot(third, on_cut))));
            }
          }
          ++compared;
          const Exact_point ray = oracle::cross(first, second);
          if (oracle::is_zero(ray)) continue;  // the planes are one: not met
          const Exact_view::Ray meet = view.meet(view.edge(a, b), view.edge(d, c), counts);
          ASSERT_EQ(view.side(view.edge(e, f), meet, counts), static_cast<Sign>(sgn(oracle::dot(third, ray))));
          ASSERT_EQ(view.side(view.opposite(view.edge(e, f)), meet, counts),
                    static_cast<Sign>(-sgn(oracle::dot(third, ray))));
          ASSERT_EQ(view.side(view.axis(1), meet, counts), static_cast<Sign>(sgn(ray[1])));
          ASSERT_EQ(view.side(view.edge(a, b), meet, counts), CGAL::ZERO);
          if (!faces) continue;
          const Exact_point across = oracle::minus(book.form(piece), book.form(other));
          ASSERT_EQ(view.nearer(piece, other, meet, counts), static_cast<Sign>(sgn(oracle::dot(across, ray))));
          ASSERT_EQ(view.side(view.crossing(piece, other), meet, counts),
                    static_cast<Sign>(sgn(oracle::dot(across, ray))));
          const Exact_point third_ray = oracle::cross(across, third);
          if (oracle::is_zero(third_ray)) continue;
          const Exact_view::Ray on_crossing = view.meet(view.crossing(piece, other), view.edge(e, f), counts);
          ASSERT_EQ(view.side(view.edge(a, b), on_crossing, counts),
                    static_cast<Sign>(sgn(oracle::dot(first, third_ray))));
          ASSERT_EQ(view.nearer(piece, other, on_crossing, counts), CGAL::ZERO);
        }
      }
  EXPECT_GT(compared, 5000u);
  EXPECT_GT(counts.combinatorial, 1000u);
  EXPECT_GT(counts.filtered, 1000u);
  EXPECT_GT(counts.fixed, 1000u);
  EXPECT_GT(counts.gmp, 1000u);
}

TEST(Exact_view, tells_points_off_a_plane_by_less_than_doubles_know) {
  for (const double off : {0x1p-60, -0x1p-60, 0.0}) {
    Polygon_soup soup;
    const Point_id a = soup.add_point(0.0, 0.0, 1.0), b = soup.add_point(3.0, 0.0, 1.0),
                   c = soup.add_point(0.0, 3.0, 1.0), d = soup.add_point(0.0, 0.0, 0.0);
    Exact_point near{1, 1, 1};
    near[2] += exact(off);
    const Point_id e = soup.add_point(near[0], near[1], near[2]);
    soup.add_face({a, b, c});
    soup.add_face({a, b, d});
    soup.add_face({e, b, d});
    const Scene scene(soup);
    const Exact_view view(scene, {Rational(1, 2), Rational(1, 3), 9});
    Predicate_counts counts;
    const std::uint32_t tip = scene.corners(scene.pieces()[2])[0].point;
    EXPECT_EQ(view.beyond(0, tip, counts), off > 0 ? CGAL::NEGATIVE : off < 0 ? CGAL::POSITIVE : CGAL::ZERO);
  }
}

}  // namespace
}  // namespace sightline::see_test
