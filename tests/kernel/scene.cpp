// What becomes of a soup: the policies of proofs/semantics.md, the grid, the pieces.

#include "soup.h"

#include <sightline/kernel/predicates.h>

#include <CGAL/int.h>
#include <CGAL/number_utils.h>

using namespace kernel_test;

namespace {

using Points = std::vector<std::array<long, 3>>;

/// One face, each of its loops given as points, scaled; where that is not by 1, a point that no face uses keeps the
/// grid as fine as it was.
Polygon_soup one_face(const std::vector<Points>& loops, const Integer& scale = 1) {
  Polygon_soup soup;
  for (const Points& loop : loops) {
    std::vector<Point_id> ids;
    for (const auto& p : loop)
      ids.push_back(soup.add_point(Rational(p[0] * scale), Rational(p[1] * scale), Rational(p[2] * scale)));
    if (&loop == &loops[0]) soup.add_face(ids);
    else soup.add_hole(ids);
  }
  if (scale != 1) soup.add_point(Rational(1), Rational(2), Rational(3));
  return soup;
}

void expect_kept(const Polygon_soup& soup, std::size_t pieces, bool planar = true) {
  const Scene scene(soup);
  ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
  EXPECT_EQ(why(scene, 0), "");
  EXPECT_EQ(pieces_of(scene, 0), pieces);
  EXPECT_EQ(scene.non_planar().empty(), planar);
}
void expect_aside(const Polygon_soup& soup, const std::string& reason) {
  const Scene scene(soup);
  ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
  EXPECT_EQ(why(scene, 0), reason);
}

/// The same face in many positions: no policy may depend on axes, width or orientation.
std::vector<Polygon_soup> variants(const std::vector<Points>& loops) {
  std::vector<Polygon_soup> all;
  for (int turn = 0; turn < 3; ++turn)
    for (const bool mirrored : {false, true})
      for (const unsigned scale_bits : {0u, 31u, 60u, 80u})
        for (const long shear : {0l, 3l}) {
          std::vector<Points> moved = loops;
          for (Points& loop : moved)
            for (auto& p : loop) {
              p = {p[0], p[1], p[2] + shear * p[0] - 2 * shear * p[1]};
              p = {p[static_cast<std::size_t>(turn)], p[static_cast<std::size_t>((turn + 1) % 3)],
                   p[static_cast<std::size_t>((turn + 2) % 3)] + 5};
              if (mirrored) p[0] = -p[0];
            }
          all.push_back(one_face(moved, Integer(1) << scale_bits));
        }
  return all;
}

Rational tenth(long n) {
  Rational r(n, 10);
  r.canonicalize();
  return r;
}

}  // namespace

// ---- What is kept

TEST(Scene_policy, a_convex_face_is_one_piece_whichever_way_it_faces) {
  for (const Polygon_soup& soup : variants({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}})) expect_kept(soup, 1);
}
TEST(Scene_policy, straight_and_repeated_points_of_a_convex_face_are_no_corners) {
  for (const Polygon_soup& soup : variants(
           {{{0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 4, 0}, {4, 4, 0}, {1, 4, 0}, {0, 4, 0}, {0, 0, 0}}})) {
    expect_kept(soup, 1);
    const Scene scene(soup);
    EXPECT_EQ(scene.pieces()[0].size, 4u);
    EXPECT_EQ(scene.counters().concave, 0u);
  }
}
TEST(Scene_policy, a_concave_face_is_cut_into_convex_pieces_on_its_own_points) {
  for (const Polygon_soup& soup : variants({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}}})) {
    expect_kept(soup, 2);
    const Scene scene(soup);
    EXPECT_EQ(scene.counters().concave, 1u);
    EXPECT_EQ(scene.concave(), std::vector<Face_id>{0});
  }
}
TEST(Scene_policy, a_face_with_a_hole_of_either_sense_is_cut_around_it) {
  for (const bool reversed : {false, true}) {
    Points hole{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
    if (reversed) std::reverse(hole.begin(), hole.end());
    for (const Polygon_soup& soup : variants({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, hole})) {
      const Scene scene(soup);
      ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
      EXPECT_GE(scene.pieces().size(), 4u);
      EXPECT_EQ(scene.counters().with_holes, 1u);
      Vector sum{0, 0, 0};
      for (const Piece& piece : scene.pieces()) {
        const Vector part = area_vector(scene.corner_points(piece));
        for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
      }
      const Vector whole = area_vector(loop_of(soup, 0)), gap = area_vector(loop_of(soup, 0, 1));
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(sum[k], whole[k] + (reversed ? gap[k] : Rational(-gap[k])));
    }
  }
}
TEST(Scene_policy, a_keyhole_is_a_hole) {
  for (const Polygon_soup& soup : variants({{{0, 0, 0},
                                             {4, 0, 0},
                                             {4, 4, 0},
                                             {0, 4, 0},
                                             {0, 0, 0},
                                             {1, 1, 0},
                                             {1, 2, 0},
                                             {2, 2, 0},
                                             {2, 1, 0},
                                             {1, 1, 0}}})) {
    const Scene scene(soup);
    ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
    EXPECT_GE(scene.pieces().size(), 4u);
  }
}
TEST(Scene_policy, a_spike_is_left_out) {
  for (const Polygon_soup& soup : variants({{{0, 0, 0}, {4, 0, 0}, {8, 0, 0}, {4, 0, 0}, {4, 4, 0}}}))
    expect_kept(soup, 1);
}
TEST(Scene_policy, a_face_that_is_convex_but_for_spikes_is_one_piece) {
  for (const Polygon_soup& soup :
       variants({{{0, 0, 0}, {2, 2, 0}, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {5, 5, 0}, {4, 4, 0}, {0, 4, 0}}}))
    expect_kept(soup, 1);
  for (const Polygon_soup& soup :  // with a twig
       variants({{{0, 0, 0},
                  {2, 2, 0},
                  {2, 3, 0},
                  {2, 2, 0},
                  {3, 2, 0},
                  {2, 2, 0},
                  {0, 0, 0},
                  {4, 0, 0},
                  {4, 4, 0},
                  {0, 4, 0}}}))
    expect_kept(soup, 1);
}
TEST(Scene_policy, a_spike_that_crosses_the_contour_is_one_that_crosses_itself) {
  for (const Polygon_soup& soup : variants({{{0, 0, 0}, {5, 3, 0}, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}}))
    expect_aside(soup, "self-intersecting");
}
TEST(Scene_policy, a_non_planar_quad_is_two_triangles) {
  for (const Polygon_soup& soup : variants({{{0, 0, 0}, {4, 0, 0}, {4, 4, 1}, {0, 4, 0}}})) {
    expect_kept(soup, 2, false);
    const Scene scene(soup);
    EXPECT_EQ(scene.non_planar(), std::vector<Face_id>{0});
  }
}
TEST(Scene_policy, a_non_planar_pentagon_is_three_triangles_concave_or_not) {
  for (const Polygon_soup& soup : variants({{{0, 0, 0}, {4, 0, 1}, {6, 3, 0}, {3, 6, 2}, {-1, 4, 0}}}))
    expect_kept(soup, 3, false);
  for (const Polygon_soup& soup : variants({{{0, 0, 0}, {4, 0, 1}, {2, 1, 0}, {3, 6, 2}, {-1, 4, 0}}})) {
    expect_kept(soup, 3, false);
    const Scene scene(soup);
    EXPECT_EQ(scene.counters().fanned, 0u);
  }
}
TEST(Scene_policy, a_non_planar_face_is_cut_as_its_largest_projection_is) {
  // Seen along z, where it is largest, the short diagonal is 1-3; seen along x it is 0-2.
  const Polygon_soup soup = one_face({{{0, 0, -30}, {500, -100, 0}, {1000, 0, 30}, {500, 100, 5}}});
  const Scene scene(soup);
  ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
  ASSERT_EQ(scene.pieces().size(), 2u);
  for (const Piece& piece : scene.pieces()) {
    const std::vector<Exact_point> corners = scene.corner_points(piece);
    for (const Point_id p : {1u, 3u})
      EXPECT_NE(std::find(corners.begin(), corners.end(), soup.point(p)), corners.end());
  }
}
TEST(Scene_policy, a_non_planar_face_whose_projection_crosses_itself_is_triangulated_all_the_same) {
  // A closed path whose three projections all cross themselves.
  for (const Polygon_soup& soup :
       variants({{{0, 0, 0}, {10, 0, 10}, {0, 10, 10}, {10, 10, 0}, {5, -5, 5}, {-3, 7, -4}}})) {
    const Scene scene(soup);
    ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
    EXPECT_EQ(why(scene, 0), "");
  }
}
TEST(Scene_policy, a_non_planar_face_with_a_hole_is_cut_around_it) {
  for (const bool reversed : {false, true}) {
    Points hole{{3, 3, 0}, {3, 6, 0}, {6, 6, 0}, {6, 3, 0}};
    if (reversed) std::reverse(hole.begin(), hole.end());
    for (const Polygon_soup& soup : variants({{{0, 0, 0}, {9, 0, 0}, {9, 9, 1}, {0, 9, 0}}, hole})) {
      const Scene scene(soup);
      ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
      EXPECT_EQ(scene.pieces().size(), 8u) << "hole " << (reversed ? "counterclockwise" : "clockwise");
    }
  }
}
TEST(Scene_policy, a_non_planar_face_with_an_edge_along_the_projection_keeps_all_its_corners) {
  // The last corner is straight above the first.
  for (const Polygon_soup& soup : variants({{{0, 0, 0}, {40, 0, 0}, {40, 40, 0}, {0, 40, 1}, {0, 0, 1}}}))
    expect_kept(soup, 3, false);
}

TEST(Scene_policy, two_corners_of_a_non_planar_face_above_one_another_stay_two) {
  for (const Polygon_soup& soup :
       variants({{{0, 0, 0}, {40, 0, 0}, {20, 20, 1}, {40, 40, 0}, {0, 40, 0}, {20, 20, 2}}})) {
    const Scene scene(soup);
    ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
    EXPECT_EQ(pieces_of(scene, 0), 4u);
  }
}

// ---- What is set aside

TEST(Scene_policy, faces_without_area_are_set_aside) {
  for (const std::vector<Points>& loops : std::vector<std::vector<Points>>{
           {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}},             // collinear
           {{{0, 0, 0}, {1, 2, 3}, {3, 6, 9}, {2, 4, 6}}},  // collinear, four
           {{{1, 2, 3}, {1, 2, 3}, {4, 5, 6}}},             // a repeated point
           {{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}},  // a point
           {{{1, 2, 3}, {4, 5, 6}}},                        // fewer than three
           {{{1, 2, 3}}},
           {{}},
           {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {4, 0, 0}}}})  // there and back around a bend
    for (const Polygon_soup& soup : variants(loops)) expect_aside(soup, "zero area");
}
TEST(Scene_policy, a_hole_as_large_as_its_face_leaves_zero_area) {
  for (const Polygon_soup& soup :
       variants({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}}}))
    expect_aside(soup, "zero area");
}
TEST(Scene_policy, a_star_of_spikes_in_space_has_zero_area) {
  for (const Polygon_soup& soup : variants({{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}}}))
    expect_aside(soup, "zero area");
}
TEST(Scene_policy, a_contour_that_crosses_itself_is_set_aside) {
  for (const std::vector<Points>& loops : std::vector<std::vector<Points>>{
           {{{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}}},                             // a bow tie of no net area
           {{{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 6, 0}}},                             // and of some
           {{{0, 0, 0}, {10, 0, 0}, {2, 7, 0}, {5, -3, 0}, {8, 7, 0}}},                // a pentagram
           {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}},       // twice around
           {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{9, 9, 0}, {10, 9, 0}, {9, 10, 0}}}})  // a hole outside
    for (const Polygon_soup& soup : variants(loops)) expect_aside(soup, "self-intersecting");
}

TEST(Scene_policy, a_twisted_face_with_holes_that_no_projection_cuts_is_set_aside_and_counted_for_itself) {
  const std::string reason(text_of(Set_aside_reason::no_simple_projection));
  const Points saddle{{0, 0, 0}, {4, 0, 1}, {4, 4, 0}, {0, 4, 1}};
  for (const std::vector<Points>& loops : std::vector<std::vector<Points>>{
           {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{9, 9, 5}, {8, 9, 1}, {9, 8, 1}}},  // a hole far outside
           {{{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 4, 0}},
            {{3, 2, 1}, {1, 1, 0}, {2, 1, 0}}}})  // a contour of no net area
    for (const Polygon_soup& soup : variants(loops)) expect_aside(soup, reason);
  // There and back nothing is left of the contour, whatever the hole.
  for (const std::vector<Points>& loops : std::vector<std::vector<Points>>{
           {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 0, 0}}, {{3, 2, 1}, {1, 1, 0}, {2, 1, 0}}},
           {{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}}, {{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}}})
    for (const Polygon_soup& soup : variants(loops)) expect_aside(soup, "zero area");
  // Where its own axis is the only one: nothing sheared.
  for (const Points& hole : std::vector<Points>{{{1, 1, 0}, {2, 1, 0}, {2, 1, 1}, {1, 1, 1}},  // upright
                                                {{1, 0, 2}, {2, 1, 0}, {1, 1, 0}},             // on the contour's edge
                                                {{0, 0, 1}, {2, 1, 0}, {1, 2, 0}},     // at its corner, above it
                                                {{1, 1, 0}, {9, 1, 0}, {1, 2, 0}}}) {  // across it
    const Scene scene(one_face({saddle, hole}));
    EXPECT_EQ(why(scene, 0), reason);
    const Scene_counters& c = scene.counters();
    EXPECT_EQ(c.no_simple_projection, 1u);
    EXPECT_EQ(c.self_intersecting + c.zero_area + c.duplicates + c.non_planar + c.fanned, 0u);
    EXPECT_EQ(c.with_holes, 1u);
  }
}

TEST(Scene_policy, a_hole_is_cut_out_whichever_way_it_runs_and_wherever_its_area_points_in_space) {
  // Seen from above the hole is clockwise or not; in space its area points away from the contour's either way.
  const Points outer{{0, 0, 0}, {60, 0, 60}, {60, 60, 121}, {0, 60, 60}};
  const Points hole{{20, 20, 40}, {22, 20, 30}, {22, 21, 46}, {20, 21, 56}};
  for (const Points& either : {hole, Points(hole.rbegin(), hole.rend())}) {
    const Polygon_soup soup = one_face({outer, either});
    const Scene scene(soup);
    ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
    EXPECT_EQ(pieces_of(scene, 0), 8u);
  }
  // A hole of no area seen from above has no sense there, from either side.
  const Points flat{{0, 0, 0}, {8, 0, 1}, {8, 8, 0}, {0, 8, 1}}, bow{{2, 2, 0}, {4, 4, 1}, {2, 4, 0}, {4, 2, 0}};
  for (const Points& contour : {flat, Points(flat.rbegin(), flat.rend())})
    expect_aside(one_face({contour, bow}), std::string(text_of(Set_aside_reason::no_simple_projection)));
}

TEST(Scene_policy, duplicates_begin_anywhere_however_often_they_come_back) {
  // Petals about point 0, two of them alike: loops of up to 19 corners that begin at any.
  Polygon_soup soup;
  soup.add_point(0.0, 0.0, 0.0);
  std::vector<Point_id> petals;
  for (int k = 0; k < 6; ++k) {
    const Point_id p = soup.add_point(10.0, 4.0 * k, 0.0), q = soup.add_point(10.0, 4.0 * k + 2, 0.0);
    petals.insert(petals.end(), {0, p, q});
  }
  for (std::size_t k = 0; k < petals.size(); ++k) {
    soup.add_face(petals);
    std::rotate(petals.begin(), petals.begin() + 1, petals.end());
  }
  const Scene scene(soup);
  ASSERT_EQ(scene.set_aside().size(), petals.size() - 1);
  for (const Set_aside& entry : scene.set_aside()) EXPECT_EQ(why(scene, entry.face), "duplicate of 0") << entry.face;
}

TEST(Scene_policy, an_exact_duplicate_is_set_aside_and_says_of_what) {
  Polygon_soup soup = soup_of({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {4, 4, 0}});
  soup.add_face({0, 1, 2, 3});
  soup.add_face({2, 3, 0, 1});        // rotated
  soup.add_face({0, 1, 4, 3});        // through another point of the same coordinates
  soup.add_face({0, 1, 1, 2, 3, 0});  // with repetitions
  soup.add_face({3, 2, 1, 0});        // the other side: no duplicate
  soup.add_face({1, 0, 3, 2});        // but this one is, of it
  soup.add_face({0, 1, 2});
  soup.add_face({0, 2, 1});
  soup.add_face({1, 2, 0});
  const Scene scene(soup);
  ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
  EXPECT_EQ(why(scene, 0), "");
  EXPECT_EQ(why(scene, 1), "duplicate of 0");
  EXPECT_EQ(why(scene, 2), "duplicate of 0");
  EXPECT_EQ(why(scene, 3), "duplicate of 0");
  EXPECT_EQ(why(scene, 4), "");
  EXPECT_EQ(why(scene, 5), "duplicate of 4");
  EXPECT_EQ(why(scene, 6), "");
  EXPECT_EQ(why(scene, 7), "");
  EXPECT_EQ(why(scene, 8), "duplicate of 6");
  EXPECT_EQ(scene.counters().duplicates, 5u);
  EXPECT_EQ(scene.counters().points, 4u);
  // All of them lie in one plane, seen from either side.
  for (const Piece& piece : scene.pieces()) EXPECT_EQ(piece.support.id(), scene.pieces()[0].support.id());
}
TEST(Scene_policy, a_rotated_keyhole_is_a_duplicate_though_its_points_repeat) {
  Polygon_soup soup = soup_of({{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}});
  const std::vector<Point_id> loop{0, 1, 2, 3, 0, 4, 5, 6};
  for (std::size_t turn = 0; turn < loop.size(); ++turn) {
    std::vector<Point_id> rotated = loop;
    std::rotate(rotated.begin(), rotated.begin() + static_cast<std::ptrdiff_t>(turn), rotated.end());
    soup.add_face(rotated);
  }
  const Scene scene(soup);
  ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
  for (Face_id f = 1; f < 8; ++f) EXPECT_EQ(why(scene, f), "duplicate of 0") << f;
}
TEST(Scene_policy, faces_that_differ_in_a_hole_are_no_duplicates) {
  Polygon_soup soup = soup_of(
      {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {1, 1, 0}, {2, 1, 0}, {1, 2, 0}, {5, 5, 0}, {6, 5, 0}, {5, 6, 0}});
  soup.add_face({0, 1, 2, 3});
  soup.add_face({0, 1, 2, 3});
  soup.add_hole({4, 5, 6});
  soup.add_face({0, 1, 2, 3});
  soup.add_hole({7, 8, 9});
  soup.add_face({0, 1, 2, 3});
  soup.add_hole({5, 6, 4});
  const Scene scene(soup);
  ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
  EXPECT_EQ(scene.set_aside().size(), 1u);
  EXPECT_EQ(why(scene, 3), "duplicate of 1");
}
TEST(Scene_policy, a_duplicate_of_a_face_set_aside_is_set_aside_for_the_same_reason) {
  Polygon_soup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  soup.add_face({0, 1, 2});
  soup.add_face({0, 1, 2});
  const Scene scene(soup);
  EXPECT_EQ(why(scene, 0), "zero area");
  EXPECT_EQ(why(scene, 1), "zero area");
}

TEST(Scene_policy, ids_are_places_in_the_file_also_after_faces_set_aside) {
  Polygon_soup soup = soup_of({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 1, 0}, {0, 0, 5}});
  soup.add_face({0, 1, 1});
  soup.add_face({0, 1, 2, 4});  // concave
  soup.add_face({0, 1, 5});
  const Scene scene(soup);
  ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
  ASSERT_EQ(scene.pieces().size(), 3u);
  EXPECT_EQ(scene.pieces()[0].face, 1u);
  EXPECT_EQ(scene.pieces()[1].face, 1u);
  EXPECT_EQ(scene.pieces()[1].number, 1u);
  EXPECT_EQ(scene.pieces()[2].face, 2u);
  EXPECT_EQ(scene.pieces()[2].number, 0u);
}

TEST(Scene_policy, coplanar_faces_share_a_plane_and_know_which_way_they_face) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 3);
  add_cube(soup, 3, 0, 0, 3);
  add_cube(soup, 10, 0, 0, 3);
  const Scene scene(soup);
  std::vector<std::uint32_t> ids;
  for (const Piece& piece : scene.pieces()) ids.push_back(piece.support.id());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  EXPECT_EQ(ids.size(), 4u + 5u);
  EXPECT_EQ(scene.pieces()[1].support, scene.pieces()[6].support.opposite());  // the walls that touch
  EXPECT_EQ(scene.pieces()[5].support, scene.pieces()[11].support);
}

// ---- The grid

namespace {
/// Every soup point is a scene point of the very same coordinates, whichever way one asks.
void expect_exact_points(const Polygon_soup& soup, const Scene& scene) {
  const Predicates predicates = scene.predicates();
  std::map<Exact_point, std::uint32_t> place;
  for (std::uint32_t p = 0; p < scene.points().size(); ++p) {
    const Exact_point x = scene.position(p);
    ASSERT_TRUE(place.emplace(x, p).second) << "equal points are merged";
    ASSERT_EQ(scene.position(predicates.homogeneous(
                  predicates.input_vertex(p, Vertex::no_plane, Vertex::no_plane, Vertex::no_plane))),
              x);
    for (const Rational& c : x) ASSERT_EQ(gcd(c.get_num(), c.get_den()), 1);
    const Located_point q = scene.locate(x);
    ASSERT_EQ(scene.position({q.x, q.y, q.z, q.w}), x);
    ASSERT_EQ(q.w, 1);
    const std::array<Integer, 3> grid{scene.points().integer(p, 0), scene.points().integer(p, 1),
                                      scene.points().integer(p, 2)};
    ASSERT_TRUE(q.x == grid[0] && q.y == grid[1] && q.z == grid[2]);
    for (const Integer& g : grid) ASSERT_LE(bit_length(g), static_cast<std::size_t>(scene.points().bits()));
  }
  for (Point_id p = 0; p < soup.point_count(); ++p) ASSERT_TRUE(place.contains(soup.point(p)));
  ASSERT_EQ(scene.counters().points, place.size());
  if (soup.point_count() == 0) return;
  // The box of all points.
  std::array<Exact_point, 2> box{soup.point(0), soup.point(0)};
  for (Point_id p = 0; p < soup.point_count(); ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      box[0][k] = std::min(box[0][k], soup.point(p)[k]);
      box[1][k] = std::max(box[1][k], soup.point(p)[k]);
    }
  ASSERT_EQ(scene.box(), box);
  if (scene.pieces().empty()) return;
  // And that of the faces that are kept.
  std::optional<std::array<Exact_point, 2>> of_faces;
  for (const Piece& piece : scene.pieces())
    for (const Piece_corner& corner : scene.corners(piece)) {
      const Exact_point p = scene.position(corner.point);
      if (!of_faces) of_faces = {p, p};
      for (std::size_t k = 0; k < 3; ++k) {
        (*of_faces)[0][k] = std::min((*of_faces)[0][k], p[k]);
        (*of_faces)[1][k] = std::max((*of_faces)[1][k], p[k]);
      }
    }
  ASSERT_EQ(scene.box_of_faces(), of_faces);
}

/// A vertex's side of a plane as the file's coordinates have it.
void expect_right_sides(const Scene& scene, Random& random, int asked) {
  const Predicates predicates = scene.predicates();
  const auto any_piece = [&]() -> const Piece& { return scene.pieces()[random() % scene.pieces().size()]; };
  for (int i = 0; i < asked; ++i) {
    const Piece &f = any_piece(), &g = any_piece(), &h = any_piece();
    const Plane target = random() % 2 ? any_piece().support : scene.corners(g)[random() % g.size].edge;
    const std::array<Rational, 4> coefficients = scene.file_coefficients(target);
    Vertex v{};
    if (random() % 3 == 0) {
      const std::size_t k = random() % f.size;
      v = predicates.input_vertex(scene.corners(f)[k].point, f.support.id(), scene.corners(f)[k].edge.id(),
                                  f.support.id());
    } else {
      try {
        v = predicates.meet(f.support.id(), g.support.id(),
                            random() % 2 ? h.support.id() : scene.corners(f)[random() % f.size].edge.id());
      } catch (const std::domain_error&) {
        continue;
      }
    }
    const Exact_point x = scene.position(predicates.homogeneous(v));
    Predicate_counts counts;
    ASSERT_EQ(predicates.side(v, predicates.prepare(target), counts), CGAL::sign(sgn(value(coefficients, x))));
    ASSERT_EQ(predicates.side(scene.locate(x), target, counts), CGAL::sign(sgn(value(coefficients, x))));
    Exact_point beside = x;
    mpq_class step(1);
    mpq_div_2exp(step.get_mpq_t(), step.get_mpq_t(), 1500);
    beside[random() % 3] += random() % 2 ? step : mpq_class(-step);
    ASSERT_EQ(predicates.side(scene.locate(beside), target, counts), CGAL::sign(sgn(value(coefficients, beside))));
    // The doubles are within the error.
    if (std::isfinite(v.error)) {
      const std::array<Integer, 4> at = predicates.homogeneous(v);
      const std::array<double, 3> rounded{v.x, v.y, v.z};
      for (std::size_t k = 0; k < 3; ++k) {
        Rational truth(at[k], at[3]);
        truth.canonicalize();
        truth /= scene.points().divisor();
        mpq_div_2exp(truth.get_mpq_t(), truth.get_mpq_t(), static_cast<mp_bitcnt_t>(scene.points().shift()));
        ASSERT_TRUE(abs(exact(rounded[k]) - truth) <= exact(v.error));
      }
    }
  }
}

struct Transformation {
  const char* name;
  std::function<Rational(long)> number;
  int grid_bits;  ///< at most
};
Rational power_of_ten(long k) { return exact_decimal(1, k); }

class Scene_moved : public testing::TestWithParam<Transformation> {};
INSTANTIATE_TEST_SUITE_P(
    All, Scene_moved,
    testing::Values(Transformation{"as_it_is", [](long n) { return Rational(n); }, 21},
                    Transformation{"moved_by_1e8", [](long n) { return Rational(n + 100000000); }, 21},
                    Transformation{"scaled_by_1e_minus_50", [](long n) { return Rational(n * power_of_ten(-50)); }, 21},
                    Transformation{"scaled_by_1e_minus_50_in_doubles",
                                   [](long n) { return exact(static_cast<double>(n) * 1e-50); }, 75},
                    Transformation{"tenths", [](long n) { return Rational(n * power_of_ten(-1)); }, 21},
                    Transformation{"tenths_in_doubles", [](long n) { return exact(static_cast<double>(n) / 10); }, 80},
                    Transformation{"subnormals",
                                   [](long n) { return exact(static_cast<double>(n) * 4.9406564584124654e-324); }, 21},
                    Transformation{"thirds_far_away",
                                   [](long n) { return Rational(n * Rational(1, 3) + power_of_ten(30)); }, 21},
                    Transformation{"up_to_1e308", [](long n) { return exact(static_cast<double>(n) * 0x1p1000); }, 21},
                    Transformation{"from_subnormals_to_1e308",
                                   [](long n) {
                                     return n % 5 == 0   ? exact(static_cast<double>(n) * 0x1p1000)
                                            : n % 5 == 1 ? exact(static_cast<double>(n) * 4.9406564584124654e-324)
                                                         : Rational(n);
                                   },
                                   2200}),
    [](const auto& of) { return std::string(of.param.name); });

TEST_P(Scene_moved, points_are_exact_pieces_sound_and_sides_right) {
  Random random(42);
  for (const int bits : {4, 20}) {
    const Polygon_soup soup = random_soup(random, 30, bits, GetParam().number);
    const Scene scene(soup);
    ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
    ASSERT_NO_FATAL_FAILURE(expect_exact_points(soup, scene));
    EXPECT_LE(scene.points().bits(), GetParam().grid_bits + 1);
    ASSERT_NO_FATAL_FAILURE(expect_right_sides(scene, random, 150));
    // A coarser scene of the same shape has the same arithmetic: position and scale cost no bits.
    if (GetParam().grid_bits == 21 && bits == 4) {
      EXPECT_LE(scene.points().bits(), 6);
      EXPECT_EQ(scene.predicates().arithmetic(), Arithmetic::bits128);
    }
  }
}
}  // namespace

TEST(Scene_grid, a_scene_of_mostly_zeros_and_numbers_too_small_for_doubles_is_exact) {
  // 60 bits times 10^-400: in the scale of the other coordinates nothing but zeros.
  Random random(3);
  Polygon_soup soup;
  for (int i = 0; i < 20; ++i) {
    const auto number = [&] { return static_cast<std::int64_t>(random() >> 4 | 1) * (random() % 2 ? 1 : -1); };
    const auto add = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
      for (const std::int64_t n : {x, y, z}) soup.coordinates.push_decimal(n, -400);
      return static_cast<Point_id>(soup.point_count() - 1);
    };
    soup.add_face({add(number(), 0, 0), add(0, number(), 0), add(0, 0, number())});
    soup.add_face({add(0, 0, 0), add(number(), 0, 0), add(0, number(), 0)});
    soup.add_face({add(0, 0, 0), add(number(), number(), 0), add(0, 0, number())});
  }
  const Scene scene(soup);
  EXPECT_GT(scene.points().bits(), 53);
  ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
  ASSERT_NO_FATAL_FAILURE(expect_exact_points(soup, scene));
  ASSERT_NO_FATAL_FAILURE(expect_right_sides(scene, random, 1000));
}
TEST(Scene_grid, a_few_fine_coordinates_among_many_coarse_ones_are_exact) {
  for (const long shift : {30l, 70l, 600l, 1074l}) {
    Random random(static_cast<std::uint64_t>(shift));
    const Rational tiny = exact(std::ldexp(1.0, -static_cast<int>(shift)));
    const Polygon_soup soup = random_soup(
        random, 40, 20, [&](long n) { return n % 16 == 3 ? Rational(n + tiny * (n % 7 + 1)) : Rational(n); });
    const Scene scene(soup);
    ASSERT_NO_FATAL_FAILURE(expect_sound_pieces(soup, scene));
    ASSERT_NO_FATAL_FAILURE(expect_exact_points(soup, scene));
    ASSERT_NO_FATAL_FAILURE(expect_right_sides(scene, random, 300));
  }
}
TEST(Scene_grid, the_grid_is_the_coarsest_and_centred) {
  Polygon_soup soup;
  for (const long x : {0l, 6l, 12l}) soup.add_point(tenth(x + 1000000007l), tenth(3 * x), tenth(-x * x));
  soup.add_face({0, 1, 2});
  const Scene scene(soup);
  ASSERT_NO_FATAL_FAILURE(expect_exact_points(soup, scene));
  EXPECT_LE(scene.points().bits(), 4);  // z: 0, -36, -144 in steps of 6
}
TEST(Scene_grid, both_ends_of_every_axis_fit_its_bits) {
  for (long last = 1; last < 70; ++last)
    for (const long first : {0l, -3l, 1000000l}) {
      const Polygon_soup soup = soup_of({{first, 0, 0}, {first + last, 0, 0}, {first + 1, 0, 1}});
      ASSERT_NO_FATAL_FAILURE(expect_exact_points(soup, Scene(soup)));
    }
}
TEST(Scene_grid, a_scene_without_points_is_empty) {
  const Scene scene((Polygon_soup()));
  EXPECT_EQ(scene.pieces().size(), 0u);
  EXPECT_EQ(scene.points().size(), 0u);
  EXPECT_EQ(scene.counters().faces, 0u);
  EXPECT_EQ(scene.predicates().arithmetic(), Arithmetic::bits128);
}
TEST(Scene_grid, a_scene_of_one_point_is_that_point) {
  for (const double x : {0.0, 0.1, -1e308, 4.9e-324}) {
    Polygon_soup soup;
    soup.add_point(x, x, -x);
    soup.add_face({0, 0, 0});
    soup.add_face(std::initializer_list<Point_id>{});
    const Scene scene(soup);
    ASSERT_NO_FATAL_FAILURE(expect_exact_points(soup, scene));
    EXPECT_EQ(scene.set_aside().size(), 2u);
    EXPECT_EQ(scene.position(0)[2], -exact(x));
  }
}
TEST(Scene_grid, decimals_are_what_the_file_says) {
  Polygon_soup soup;
  for (const long n : {1l, 2l, 3l}) {
    soup.coordinates.push_decimal(n, -1);
    soup.coordinates.push_decimal(n * n, -2);
    soup.coordinates.push_decimal(0, -9);
  }
  soup.add_face({0, 1, 2});
  const Scene scene(soup);
  EXPECT_EQ(scene.position(0)[0], Rational(1, 10));
  EXPECT_EQ(scene.position(2)[1], Rational(9, 100));
  ASSERT_NO_FATAL_FAILURE(expect_exact_points(soup, scene));
}
TEST(Scene_grid, equal_points_are_merged_whatever_they_are_written_as) {
  Polygon_soup soup;
  soup.add_point(0.5, 0.25, 1.0);
  soup.coordinates.push_decimal(5, -1);
  soup.coordinates.push_decimal(250, -3);
  soup.coordinates.push_decimal(1, 0);
  soup.add_point(Rational(1, 2), Rational(1, 4), Rational(1));
  const Scene scene(soup);
  EXPECT_EQ(scene.counters().points_read, 3u);
  EXPECT_EQ(scene.counters().points, 1u);
}
TEST(Scene_grid, bits_are_those_of_the_largest_coordinate_at_the_common_scale) {
  Polygon_soup soup;
  soup.add_point(0.5, 0.25, 8.0);
  soup.add_point(0.0, -100.75, 3.0);
  const Scene scene(soup);
  EXPECT_EQ(scene.scale_bits(), 2);
  EXPECT_EQ(scene.bits(), 9);  // 403
}

// ---- Planes of one's own, and back to the file's coordinates

TEST(Scene_planes, coefficients_in_the_file_and_on_the_grid_are_one_plane) {
  Polygon_soup soup;
  for (const auto& p : {std::array<long, 3>{1000001, 7, 3}, {1000011, 27, -3}, {1000005, -1, 9}, {1000021, 3, 5}})
    soup.add_point(tenth(p[0]), tenth(p[1]), tenth(p[2]));
  soup.add_face({0, 1, 2});
  soup.add_face({0, 2, 3});
  Scene scene(soup);
  const std::array<Integer, 4> own{3, -2, 5, 17};
  const Plane plane = scene.add_plane(own);
  const std::array<Rational, 4> h = scene.file_coefficients(plane), back = scene.file_coefficients(plane.opposite());
  const Predicates predicates = scene.predicates();
  for (std::uint32_t p = 0; p < scene.points().size(); ++p) {
    Integer on_grid = own[3];
    for (int k = 0; k < 3; ++k) on_grid += own[static_cast<std::size_t>(k)] * scene.points().integer(p, k);
    EXPECT_EQ(sgn(value(h, scene.position(p))), sgn(on_grid));
    EXPECT_EQ(sgn(value(back, scene.position(p))), -sgn(on_grid));
    Predicate_counts counts;
    EXPECT_EQ(static_cast<int>(predicates.side(scene.locate(scene.position(p)), plane, counts)), sgn(on_grid));
  }
  for (const Piece& piece : scene.pieces())
    for (const Exact_point& p : scene.corner_points(piece))
      EXPECT_EQ(value(scene.file_coefficients(piece.support), p), 0);
  EXPECT_EQ(scene.add_plane({-6, 4, -10, -34}), plane.opposite());
  EXPECT_THROW(scene.add_plane({Integer(1) << 200, 1, 1, 1}), std::overflow_error);
  EXPECT_THROW(scene.add_plane({0, 0, 0, 1}), std::domain_error);
}

TEST(Scene_planes, a_located_point_comes_back_exactly_and_knows_its_error) {
  Polygon_soup soup;
  soup.add_point(0.1, 0.2, 0.3);
  soup.add_point(1e3, 5.0, 7.0);
  soup.add_point(-3.0, 2e3, 1.0);
  soup.add_face({0, 1, 2});
  const Scene scene(soup);
  for (const Exact_point& p :
       {Exact_point{Rational(1, 3), Rational(2, 7), Rational(-5)}, Exact_point{exact(0.1), exact(0.2), exact(0.3)},
        Exact_point{power_of_ten(400), Rational(1), power_of_ten(-400)}}) {
    const Located_point q = scene.locate(p);
    EXPECT_GT(q.w, 0);
    EXPECT_EQ(scene.position({q.x, q.y, q.z, q.w}), p);
    if (!std::isfinite(q.error)) continue;
    const std::array<const Integer*, 3> x{&q.x, &q.y, &q.z};
    const std::array<double, 3> rounded{q.ax, q.ay, q.az};
    for (std::size_t k = 0; k < 3; ++k) {
      Rational truth(*x[k], q.w);
      truth.canonicalize();
      truth /= scene.points().divisor();
      mpq_div_2exp(truth.get_mpq_t(), truth.get_mpq_t(), static_cast<mp_bitcnt_t>(scene.points().shift()));
      EXPECT_TRUE(abs(exact(rounded[k]) - truth) <= exact(q.error));
    }
  }
  EXPECT_TRUE(std::isinf(scene.locate({power_of_ten(400), Rational(1), Rational(0)}).error));
}

TEST(Scene_planes, incidences_are_those_of_the_corners) {
  Polygon_soup soup;
  add_cube(soup, 0, 0, 0, 2);
  const Scene scene(soup);
  for (std::uint32_t p = 0; p < scene.points().size(); ++p) {
    EXPECT_EQ(scene.incidences().at(p).size(), 3u);
    for (const Piece& piece : scene.pieces()) {
      const std::span<const Piece_corner> corners = scene.corners(piece);
      const bool corner =
          std::any_of(corners.begin(), corners.end(), [&](const Piece_corner& c) { return c.point == p; });
      EXPECT_EQ(scene.incidences().contains(p, piece.support.id()), corner);
    }
  }
}

// ---- Soups that are none

/// What a std::out_of_range or std::domain_error says; "" where there is none.
static std::string complaint(const std::function<void()>& about) {
  try {
    about();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "";
}

TEST(Soup, of_a_corner_that_is_no_point_is_refused_with_face_and_point) {
  Polygon_soup soup;
  for (const double x : {0.0, 1.0}) soup.add_point(x, 0.0, 0.0);
  soup.add_face({0, 1, 2});  // its last point comes after it
  soup.add_point(0.0, 1.0, 0.0);
  EXPECT_EQ(complaint([&] { Scene scene(soup); }), "");
  Polygon_soup holed = soup;
  soup.add_face({0, 1, 7});
  EXPECT_EQ(complaint([&] { Scene scene(soup); }), "face 1 has the corner 7, and there are 3 points, counted from 0");
  holed.add_hole({2, 3, 1});
  EXPECT_EQ(complaint([&] { Scene scene(holed); }), "face 0 has the corner 3, and there are 3 points, counted from 0");
}

TEST(Soup, of_coordinates_that_are_no_numbers_names_the_point) {
  Polygon_soup soup;
  soup.add_point(0.0, 0.0, 0.0);
  EXPECT_EQ(complaint([&] { soup.add_point(0.0, std::nan(""), 0.0); }).rfind("point 1: nan is no coordinate", 0), 0u);
  EXPECT_EQ(complaint([&] { soup.add_point(-HUGE_VAL, 0.0, 0.0); }).rfind("point 1: -inf is no coordinate", 0), 0u);
  EXPECT_EQ(soup.point_count(), 1u) << "nothing is left of it";
}
