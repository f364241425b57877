// Fragments tile their faces, pieces tile non-planar ones (P-21, P-22).

#include "scenes.h"

namespace {

using namespace verify_test;

const Exact_point eye_above = at(1, 2, 10);
const Points ground = rectangle(0, 4, 0, 4, 0);

Scene one_face(const Points& outer, const std::vector<Points>& holes = {}) {
  Scene scene;
  scene.seen_from(eye_above).face(outer, holes);
  return scene;
}
Scene one_face_drawn(const Points& outer, const std::vector<Points>& parts, const std::vector<Points>& holes = {}) {
  Scene scene = one_face(outer, holes);
  for (const Points& part : parts) scene.draw(0, part);
  return scene;
}

TEST(Tiling, by_the_face_itself_from_any_first_vertex) {
  Points turned = ground;
  for (int k = 0; k < 4; ++k) {
    expect_accepted(one_face_drawn(ground, {turned}));
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
  }
}

TEST(Tiling, piece_numbers_mean_nothing_where_there_are_no_pieces) {
  Scene scene = one_face(ground);
  expect_accepted(scene.draw(0, rectangle(0, 1, 0, 4, 0), 5).draw(0, rectangle(1, 4, 0, 4, 0), UINT32_MAX));
}

TEST(Tiling, missing_doubled_and_foreign_fragments_are_found) {
  const Points left = rectangle(0, 1, 0, 4, 0), right = rectangle(1, 4, 0, 4, 0);
  expect_accepted(one_face_drawn(ground, {left, right}));
  expect_rejected(one_face_drawn(ground, {}), "face 0 has no fragment and is not set aside");
  expect_rejected(one_face_drawn(ground, {left}), "face 0 is not tiled");
  expect_rejected(one_face_drawn(ground, {left, right, right}), "face 0 is not tiled");
  expect_rejected(one_face_drawn(ground, {ground, ground}), "face 0 is not tiled");
  expect_rejected(one_face_drawn(ground, {left, right, rectangle(5, 6, 0, 1, 0)}), "face 0 is not tiled");
  expect_rejected(one_face_drawn(ground, {rectangle(5, 9, 0, 4, 0)}), "face 0 is not tiled");
}

TEST(Tiling, of_on_view_faces_only_leaves_out_whole_faces_that_the_eye_is_not_in_front_of) {
  const auto seen = [](const Points& face, const Exact_point& eye, const std::vector<Points>& parts,
                       bool on_view = true) {
    Scene scene;
    scene.seen_from(eye).face(face);
    for (const Points& part : parts) scene.draw(0, part);
    scene.certificate.on_view = on_view;
    return scene;
  };
  const Exact_point below = at(1, 2, -10), in_plane = at(9, 9, 0);
  for (const Exact_point& eye : {below, in_plane}) {
    expect_accepted(seen(ground, eye, {}));
    EXPECT_EQ(seen(ground, eye, {}).verdict().why,
              std::string("0 fragments in back-to-front order from ") + (eye == below ? "(1, 2, -10)" : "(9, 9, 0)") +
                  ", every on-view face drawn once or set aside for a true reason; 0 faces set aside, 0 not planar");
    expect_accepted(seen(ground, eye, {ground}));
    expect_rejected(seen(ground, eye, {}, false), "face 0 has no fragment");
    expect_rejected(seen(ground, eye, {rectangle(0, 1, 0, 4, 0)}), "face 0 is not tiled");
  }
  expect_rejected(seen(ground, eye_above, {}), "face 0 has no fragment");
  expect_rejected(seen(ground, at(9, 9, tiny(500)), {}), "face 0 has no fragment");
  expect_accepted(seen(reversed(ground), eye_above, {}));
  // A bent face: one of its pieces is on-view, the other is not.
  const Points bent = {at(0, 0, 0), at(4, 0, 0), at(5, 5, 3), at(0, 4, 0)},
               low = {at(0, 0, 0), at(4, 0, 0), at(0, 4, 0)}, high = {at(4, 0, 0), at(5, 5, 3), at(0, 4, 0)};
  const auto pieces = [&](const Exact_point& eye, bool draw_low, bool draw_high) {
    Scene scene = seen(bent, eye, {});
    scene.cut(0, 0, low).cut(0, 1, high);
    if (draw_low) scene.draw(0, low, 0);
    if (draw_high) scene.draw(0, high, 1);
    return scene;
  };
  const Exact_point between = at(9, 9, 1);  // eye_above the plane of the low piece, below that of the high one
  expect_accepted(pieces(between, true, false));
  expect_accepted(pieces(between, true, true));
  expect_rejected(pieces(between, false, true), "face 0, piece 0 has no fragment");
  expect_rejected(pieces(at(9, 9, 100), true, false), "face 0, piece 1 has no fragment");
}

TEST(Tiling, is_exact_to_any_bit) {
  for (const unsigned bits : {1u, 60u, 500u}) {
    const Rational e = tiny(bits);
    const Points left = rectangle(0, 1, 0, 4, 0);
    expect_rejected(one_face_drawn(ground, {left, rectangle(1 + e, 4, 0, 4, 0)}), "is not tiled");
    expect_rejected(one_face_drawn(ground, {left, rectangle(1 - e, 4, 0, 4, 0)}), "is not tiled");
    expect_rejected(one_face_drawn(ground, {rectangle(0, 4 + e, 0, 4, 0)}), "is not tiled");
    expect_rejected(one_face_drawn(ground, {rectangle(0, 4 - e, 0, 4, 0)}), "is not tiled");
    expect_rejected(one_face_drawn(ground, {rectangle(e, 4 + e, 0, 4, 0)}), "is not tiled");
    expect_rejected(one_face_drawn(ground, {rectangle(0, 4, 0, 4, e)}), "off the plane", {0});
    Points bent = ground;
    bent[2][2] = e;
    expect_rejected(one_face_drawn(ground, {bent}), "off the plane", {0});
    Points dented = {at(0, 0, 0), at(2, e, 0), at(4, 0, 0), at(4, 4, 0), at(0, 4, 0)};
    expect_rejected(one_face_drawn(ground, {dented}), "is not convex", {0});
    dented[1][1] = -e;
    expect_rejected(one_face_drawn(ground, {dented}), "is not tiled");
  }
}

TEST(Tiling, fragments_are_convex_counterclockwise_polygons) {
  expect_rejected(one_face_drawn(ground, {reversed(ground)}), "is clockwise", {0});
  expect_rejected(one_face_drawn(ground, {{}}), "fewer than three", {0});
  expect_rejected(one_face_drawn(ground, {{ground[0]}}), "fewer than three", {0});
  expect_rejected(one_face_drawn(ground, {{ground[0], ground[1]}}), "fewer than three", {0});
  expect_rejected(one_face_drawn(ground, {{ground[0], ground[0], ground[1], ground[2], ground[3]}}), "repeated vertex",
                  {0});
  expect_rejected(one_face_drawn(ground, {{ground[0], ground[1], ground[2], ground[3], ground[0]}}), "repeated vertex",
                  {0});
  expect_rejected(one_face_drawn(ground, {ground, {ground[0], ground[1], at(2, 0, 0)}}), "zero area", {1});
  expect_rejected(one_face_drawn(ground, {ground, {ground[0], ground[1], ground[0], ground[1]}}), "zero area", {1});
  // A spike on a straight edge, out and back.
  const Scene spiked = one_face_drawn(ground, {{ground[0], at(6, 0, 0), ground[1], ground[2], ground[3]}});
  expect_rejected(spiked, "is not convex", {0});
  EXPECT_EQ(spiked.verdict().why, "fragment 0 of face 0 is not convex");
  // A dent that keeps all of its edges in one half of the directions, from each corner; it is its face's own contour.
  Points dented = {at(0, 0, 0), at(4, 0, 0), at(3, 1, 0), at(4, 2, 0), at(4, 4, 0), at(0, 4, 0)};
  for (std::size_t k = 0; k < dented.size(); ++k) {
    expect_rejected(one_face_drawn(dented, {dented}), "is not convex", {0});
    std::rotate(dented.begin(), dented.begin() + 1, dented.end());
  }
  // Twice around: every corner is convex.
  Points twice = ground;
  twice.insert(twice.end(), ground.begin(), ground.end());
  expect_rejected(one_face_drawn(ground, {twice}), "more than once around", {0});
  const Points star = {at(0, 0, 0), at(4, 1, 0), at(0, 3, 0), at(2, -1, 0), at(3, 4, 0)};
  expect_rejected(one_face_drawn(ground, {star}), "more than once around", {0});
  // The same, begun at each corner: the count of rounds may not depend on it.
  Points turned = star;
  for (int k = 0; k < 5; ++k) {
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    expect_rejected(one_face_drawn(ground, {turned}), "more than once around", {0});
  }
}

TEST(Tiling, straight_corners_and_t_junctions_are_welcome) {
  const Points with_middle = {at(0, 0, 0), at(1, 0, 0), at(2, 0, 0), at(4, 0, 0), at(4, 4, 0), at(0, 4, 0)};
  expect_accepted(one_face_drawn(ground, {with_middle}));
  expect_accepted(one_face_drawn(with_middle, {ground}));
  // One side of the cut x = 2 in one part, the other in three, none of which lists the other's corners.
  const std::vector<Points> parts = {rectangle(0, 2, 0, 4, 0), rectangle(2, 4, 0, 1, 0), rectangle(2, 4, 1, 3, 0),
                                     rectangle(2, 4, 3, 4, 0)};
  expect_accepted(one_face_drawn(ground, parts));
  std::vector<Points> swapped = parts;
  std::swap(swapped[0], swapped[3]);
  expect_accepted(one_face_drawn(ground, swapped));
  swapped[1] = rectangle(2, 4, 0, 2, 0);
  expect_rejected(one_face_drawn(ground, swapped), "is not tiled");
}

TEST(Tiling, tilted_and_turned_faces_work_alike) {
  // x + 2y + 3z = 6, and its reverse.
  const Points triangle = {at(6, 0, 0), at(0, 3, 0), at(0, 0, 2)};
  const Exact_point middle = at(3, ratio(3, 2), 0);
  const Points first = {triangle[0], middle, triangle[2]}, second = {middle, triangle[1], triangle[2]};
  expect_accepted(one_face_drawn(triangle, {first, second}));
  expect_accepted(one_face_drawn(reversed(triangle), {reversed(first), reversed(second)}));
  expect_rejected(one_face_drawn(reversed(triangle), {reversed(first), second}), "is clockwise", {1});
  // For each coordinate plane in turn.
  for (std::size_t k = 0; k < 3; ++k) {
    Points side = ground, whole = ground;
    for (Exact_point& p : whole) std::rotate(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(k), p.end());
    expect_accepted(one_face_drawn(whole, {whole}));
    expect_rejected(one_face_drawn(whole, {reversed(whole)}), "is clockwise", {0});
  }
}

TEST(Tiling, of_a_concave_face) {
  const Points ell = {at(0, 0, 0), at(4, 0, 0), at(4, 2, 0), at(2, 2, 0), at(2, 4, 0), at(0, 4, 0)};
  expect_accepted(one_face_drawn(ell, {rectangle(0, 4, 0, 2, 0), rectangle(0, 2, 2, 4, 0)}));
  expect_rejected(one_face_drawn(ell, {ell}), "is not convex", {0});
  expect_rejected(one_face_drawn(ell, {ground}), "is not tiled");
  expect_rejected(one_face_drawn(ell, {rectangle(0, 4, 0, 2, 0), rectangle(0, 2, 0, 4, 0)}), "is not tiled");
}

TEST(Tiling, of_a_concave_face_may_have_more_parts_than_corners) {
  const Points corner = {at(0, 0, 0), at(4, 0, 0), at(4, 2, 0), at(2, 2, 0), at(2, 4, 0), at(0, 4, 0)};
  std::vector<Points> parts;
  for (int k = 0; k < 8; ++k) parts.push_back(rectangle(ratio(k, 2), ratio(k + 1, 2), 0, k < 4 ? 4 : 2, 0));
  expect_accepted(one_face_drawn(corner, parts));
  for (Points& part : parts) std::rotate(part.begin(), part.begin() + 1, part.end());
  expect_accepted(one_face_drawn(corner, parts));
  std::vector<Points> missing = parts, doubled = parts;
  missing.pop_back();
  doubled.push_back(parts[2]);
  expect_rejected(one_face_drawn(corner, missing), "face 0 is not tiled");
  expect_rejected(one_face_drawn(corner, doubled), "face 0 is not tiled");
  // A spike across an edge of it, which no chain shows.
  Points crossed = corner;
  crossed.insert(crossed.begin() + 1, {at(1, 0, 0), at(1, 5, 0), at(1, 0, 0)});
  expect_rejected(one_face_drawn(crossed, parts), "face 0 crosses itself and is not set aside");
}

TEST(Tiling, of_a_face_with_holes_of_either_sense) {
  const Points hole = rectangle(1, 2, 1, 2, 0), other = rectangle(3, ratio(7, 2), 1, 2, 0);
  const std::vector<Points> ring = {rectangle(0, 1, 0, 4, 0), rectangle(1, 4, 2, 4, 0), rectangle(1, 4, 0, 1, 0),
                                    rectangle(2, 4, 1, 2, 0)};
  std::vector<Points> two = ring;
  two.back() = rectangle(2, 3, 1, 2, 0);
  two.push_back(rectangle(ratio(7, 2), 4, 1, 2, 0));
  for (const Points& h : {hole, reversed(hole)}) {
    expect_accepted(one_face_drawn(ground, ring, {h}));
    expect_rejected(one_face_drawn(ground, {ground}, {h}), "is not tiled");
    expect_rejected(one_face_drawn(ground, two, {h}), "is not tiled");
    for (const Points& o : {other, reversed(other)}) {
      expect_accepted(one_face_drawn(ground, two, {h, o}));
      expect_rejected(one_face_drawn(ground, ring, {h, o}), "is not tiled");
    }
    std::vector<Points> from_behind;
    for (const Points& part : ring) from_behind.push_back(reversed(part));
    expect_accepted(one_face_drawn(reversed(ground), from_behind, {h}));
  }
}

TEST(Tiling, of_keyhole_faces_repeated_points_and_spikes) {
  const std::vector<Points> ring = {rectangle(0, 1, 0, 4, 0), rectangle(1, 4, 2, 4, 0), rectangle(1, 4, 0, 1, 0),
                                    rectangle(2, 4, 1, 2, 0)};
  const Points keyhole = {at(0, 0, 0), at(4, 0, 0), at(4, 4, 0), at(0, 4, 0), at(0, 0, 0),
                          at(1, 1, 0), at(1, 2, 0), at(2, 2, 0), at(2, 1, 0), at(1, 1, 0)};
  expect_accepted(one_face_drawn(keyhole, ring));
  expect_rejected(one_face_drawn(keyhole, {ground}), "is not tiled");
  const Points stutter = {ground[0], ground[0], ground[0], ground[1], ground[2], ground[2], ground[3], ground[0]};
  expect_accepted(one_face_drawn(stutter, {ground}));
  const Points spiked = {at(0, 0, 0), at(4, 0, 0), at(4, 2, 0), at(9, 2, 0), at(4, 2, 0), at(4, 4, 0), at(0, 4, 0)};
  expect_accepted(one_face_drawn(spiked, {ground}));
}

TEST(Tiling, of_a_face_whose_spike_crosses_its_own_edge_is_none) {
  // What is left without the spike is tiled; the law sets such a face aside (P-21d).
  const auto with_spike_to = [&](const Exact_point& end) {
    Points face = ground;
    face.insert(face.begin() + 1, {end, ground[0]});
    return face;
  };
  const std::vector<Points> left{ground};
  expect_accepted(one_face_drawn(with_spike_to(at(3, 3, 0)), left));
  expect_accepted(one_face_drawn(with_spike_to(at(-2, -3, 0)), left));
  expect_accepted(one_face_drawn(with_spike_to(at(4, 3, 0)), left));  // ends on an edge
  expect_accepted(one_face_drawn(with_spike_to(at(6, 0, 0)), left));  // runs along one
  expect_accepted(one_face_drawn(with_spike_to(at(6, 6, 0)), left));  // passes a corner
  for (const Points& p : {with_spike_to(at(5, 4, 0)), with_spike_to(at(4 + tiny(300), 3, 0))})
    for (const bool turn : {false, true}) {
      Points face = turn ? reversed(p) : p;
      const std::vector<Points> tiles{turn ? reversed(ground) : ground};
      for (std::size_t k = 0; k < face.size(); ++k) {
        expect_rejected(one_face_drawn(face, tiles), "face 0 crosses itself and is not set aside");
        std::rotate(face.begin(), face.begin() + 1, face.end());
      }
    }
  // Of a hole, whose spike crosses the contour.
  Points hole = reversed(rectangle(1, 3, 1, 3, 0));
  const std::vector<Points> around{rectangle(0, 4, 0, 1, 0), rectangle(0, 4, 3, 4, 0), rectangle(0, 1, 1, 3, 0),
                                   rectangle(3, 4, 1, 3, 0)};
  expect_accepted(one_face_drawn(ground, around, {hole}));
  hole.insert(hole.begin() + 1, {at(-1, ratio(1, 2), 0), hole[0]});
  expect_rejected(one_face_drawn(ground, around, {hole}), "face 0 crosses itself and is not set aside");
}

TEST(Tiling, of_a_face_that_winds_twice_is_an_overlap) {
  Points twice = ground;
  twice.insert(twice.end(), ground.begin(), ground.end());
  expect_rejected(one_face_drawn(twice, {ground, ground}), "overlap", {0, 1});
  expect_rejected(one_face_drawn(twice, {ground, rectangle(0, 1, 0, 4, 0), rectangle(1, 4, 0, 4, 0)}), "overlap",
                  {0, 1});
  // In more parts than it has corners, which are told by what the contour winds round.
  std::vector<Points> strips;
  for (int k = 0; k < 16; ++k) strips.push_back(rectangle(ratio(k % 8, 2), ratio(k % 8 + 1, 2), 0, 4, 0));
  expect_rejected(one_face_drawn(twice, strips), "overlap", {0, 8});
  // Two squares in one contour, overlapping in [3, 4] x [1, 3], joined at (3, 1).
  const Points both = {at(3, 1, 0), at(0, 1, 0), at(0, 0, 0), at(4, 0, 0), at(4, 4, 0), at(0, 4, 0),
                       at(0, 1, 0), at(3, 1, 0), at(6, 1, 0), at(6, 3, 0), at(3, 3, 0)};
  expect_rejected(one_face_drawn(both, {ground, rectangle(3, 6, 1, 3, 0)}), "overlap", {0, 1});
  // A convex contour whose hole is a bow-tie: one lobe is cut out, the other is covered twice.
  const Points bow_tie = {at(1, 1, 0), at(3, 3, 0), at(3, 1, 0), at(1, 3, 0)};
  const std::vector<Points> once_and_twice = {rectangle(0, 2, 0, 4, 0),
                                              rectangle(3, 4, 0, 4, 0),
                                              {at(2, 0, 0), at(3, 0, 0), at(3, 1, 0), at(2, 2, 0)},
                                              {at(2, 2, 0), at(3, 3, 0), at(3, 4, 0), at(2, 4, 0)},
                                              {at(2, 2, 0), at(1, 3, 0), at(1, 1, 0)}};
  expect_rejected(one_face_drawn(ground, once_and_twice, {bow_tie}), "overlap", {0, 4});
  // Nothing overlaps where parts only touch, in a contour that is not convex.
  const Points pinched = {at(0, 0, 0), at(2, 0, 0), at(2, 2, 0), at(4, 2, 0),
                          at(4, 4, 0), at(2, 4, 0), at(2, 2, 0), at(0, 2, 0)};
  expect_accepted(one_face_drawn(pinched, {rectangle(0, 2, 0, 2, 0), rectangle(2, 4, 2, 4, 0)}));
  // An edge of one part only separates the two: the triangle points at the ground.
  const Points arrow = {at(0, -1, 0), at(2, -1, 0), at(2, 0, 0), at(4, -1, 0),
                        at(4, 1, 0),  at(2, 0, 0),  at(2, 1, 0), at(0, 1, 0)};
  const Points block = rectangle(0, 2, -1, 1, 0), head = {arrow[2], arrow[3], arrow[4]};
  expect_accepted(one_face_drawn(arrow, {block, head}));
  expect_accepted(one_face_drawn(arrow, {head, block}));
}

TEST(Tiling, a_planar_face_may_have_pieces) {
  const Points ell = {at(0, 0, 0), at(4, 0, 0), at(4, 2, 0), at(2, 2, 0), at(2, 4, 0), at(0, 4, 0)};
  const Points first = {ell[0], ell[1], ell[2], ell[3]}, second = {ell[0], ell[3], ell[4], ell[5]};
  Scene scene = one_face(ell);
  scene.cut(0, 7, first).cut(0, 9, second);
  Scene good = scene, wrong_number = scene, unknown = scene, half = scene;
  expect_accepted(good.draw(0, first, 7).draw(0, second, 9));
  expect_rejected(wrong_number.draw(0, first, 9).draw(0, second, 7), "is not tiled");
  expect_rejected(unknown.draw(0, first, 7).draw(0, second, 8), "a piece that its face does not have", {1});
  expect_rejected(half.draw(0, first, 7), "face 0, piece 9 has no fragment");
  Scene foreign = one_face(ell);
  expect_rejected(foreign.cut(0, 0, rectangle(0, 4, 0, 2, 0))
                      .cut(0, 1, rectangle(0, 2, 2, 4, 0))
                      .draw(0, first, 0)
                      .draw(0, second, 1),
                  "not one of the face's");
  Scene one_only = one_face(ell);
  expect_rejected(one_only.cut(0, 0, first).draw(0, first, 0), "is not tiled");
  Scene turned = one_face(ell);
  expect_rejected(turned.cut(0, 0, reversed(first))
                      .cut(0, 1, reversed(second))
                      .draw(0, reversed(first), 0)
                      .draw(0, reversed(second), 1),
                  "is clockwise");
  Points twice = ground;
  twice.insert(twice.end(), ground.begin(), ground.end());
  Scene doubled = one_face(twice);
  expect_rejected(doubled.cut(0, 0, ground).cut(0, 1, ground).draw(0, ground, 0).draw(0, ground, 1), "overlap");
}

// ---- Non-planar faces

const Points skew = {at(0, 0, 0), at(4, 0, 1), at(4, 4, 0), at(0, 4, 1)};

Points corners(const Points& all, std::initializer_list<std::size_t> which) {
  Points result;
  for (const std::size_t k : which) result.push_back(all[k]);
  return result;
}
Scene skew_face(const std::vector<Points>& pieces) {
  Scene scene = one_face(skew);
  for (std::size_t k = 0; k < pieces.size(); ++k)
    scene.cut(0, static_cast<std::uint32_t>(k), pieces[k]).draw(0, pieces[k], static_cast<std::uint32_t>(k));
  return scene;
}

TEST(Non_planar, a_skew_quad_is_cut_along_one_diagonal) {
  const Points s012 = corners(skew, {0, 1, 2}), s023 = corners(skew, {0, 2, 3}), s013 = corners(skew, {0, 1, 3}),
               s123 = corners(skew, {1, 2, 3});
  expect_accepted(skew_face({s012, s023}));
  expect_rejected(skew_face({s013, s123}), "should be the other one");
  expect_rejected(skew_face({s012, s123}), "is not bounded as its pieces are");
  expect_rejected(skew_face({s012}), "is not bounded as its pieces are");
  expect_rejected(skew_face({reversed(s012), reversed(s023)}), "does not run counterclockwise");
  expect_rejected(skew_face({s012, s012, s023}), "is not bounded as its pieces are");
  expect_rejected(skew_face({skew}), "piece 0 of face 0, which is not planar, is no triangle");
  expect_rejected(skew_face({s012, s023, {}}), "piece 2 of face 0, which is not planar, is no triangle");
  expect_rejected(skew_face({s012, s023, corners(skew, {0, 1, 0})}), "piece 2 of face 0 does not run counterclockwise");
  expect_rejected(skew_face({s012, corners(skew, {0, 2, 3, 3})}), "is no triangle");
  // A triangle and its reverse cancel; so does a closed surface.
  expect_rejected(skew_face({s012, s023, s013, reversed(s013)}), "does not run counterclockwise");
  expect_rejected(skew_face({s012, s023, s012, s023, reversed(s013), reversed(s123)}), "does not run counterclockwise");
  Scene plain = one_face(skew);
  expect_rejected(plain.draw(0, skew), "is not planar and has no pieces");
  Scene lost = one_face(skew);
  expect_rejected(lost.cut(0, 0, s012).cut(0, 1, s023).draw(0, s012, 0), "face 0, piece 1 has no fragment");
  Scene twice = one_face(skew);
  expect_rejected(twice.cut(0, 0, s012).cut(0, 0, s023).draw(0, s012, 0), "has piece 0 twice");
  // On points of its own: the same boundary, but not the face's corners.
  const Exact_point m = at(2, 2, 2);
  expect_rejected(
      skew_face({{skew[0], skew[1], m}, {skew[1], skew[2], m}, {skew[2], skew[3], m}, {skew[3], skew[0], m}}),
      "not a corner of the face's");
}

TEST(Non_planar, one_corner_off_the_plane_is_enough) {
  for (const int height : {-1, 1})  // symmetric about the z axis, so that the Newell normal is vertical
    for (std::size_t first = 0; first < 6; ++first) {
      Points bent = {at(2, 0, 0), at(1, 2, height), at(-1, 2, 0), at(-2, 0, 0), at(-1, -2, height), at(1, -2, 0)};
      std::rotate(bent.begin(), bent.begin() + static_cast<std::ptrdiff_t>(first), bent.end());
      Scene scene = one_face(bent), aside = scene;
      expect_rejected(scene.draw(0, ground), "is not planar and has no pieces");
      expect_rejected(aside.leave_out(0, "self-intersecting"), "is not planar");
    }
}

TEST(Non_planar, pieces_are_tiled_by_fragments) {
  const Points s012 = corners(skew, {0, 1, 2}), s023 = corners(skew, {0, 2, 3});
  const Exact_point middle = at(2, 2, 0);
  Scene scene = one_face(skew);
  scene.cut(0, 0, s012).cut(0, 1, s023);
  Scene good = scene, wrong = scene;
  expect_accepted(good.draw(0, {skew[0], skew[1], middle}, 0).draw(0, s023, 1).draw(0, {skew[1], skew[2], middle}, 0));
  expect_rejected(wrong.draw(0, {skew[0], skew[1], middle}, 0).draw(0, s023, 1).draw(0, {skew[1], skew[2], middle}, 1),
                  "face 0, piece 0 is not tiled");
}

TEST(Non_planar, the_pieces_are_in_the_order_too) {
  // A roof, seen from low beside it, so that one triangle hides the other.
  const Points roof = {at(0, 0, 0), at(2, -1, 3), at(4, 0, 0), at(2, 1, 3)};
  const Points near = corners(roof, {0, 1, 3}), far = corners(roof, {1, 2, 3});
  for (const bool far_first : {false, true}) {
    Scene scene;
    scene.seen_from(at(-20, 0, 1)).face(roof);
    scene.cut(0, 0, near).cut(0, 1, far);
    if (far_first) expect_accepted(scene.draw(0, far, 1).draw(0, near, 0));
    else expect_rejected(scene.draw(0, near, 0).draw(0, far, 1), "is nearer", {0, 1});
  }
}

TEST(Non_planar, pieces_are_triangles_on_corners_that_are_not_straight) {
  // A roof: a planar square and a triangle.
  const Points roof = {at(0, 0, 0), at(4, 0, 0), at(4, 4, 0), at(0, 4, 0), at(-2, 2, 3)};
  const Points floor = corners(roof, {0, 1, 2, 3}), half = corners(roof, {0, 1, 2}), other = corners(roof, {0, 2, 3}),
               flap = corners(roof, {0, 3, 4});
  Scene scene = one_face(roof), larger = scene;
  expect_accepted(
      scene.cut(0, 0, half).cut(0, 1, other).cut(0, 2, flap).draw(0, half, 0).draw(0, other, 1).draw(0, flap, 2));
  expect_rejected(larger.cut(0, 0, floor).cut(0, 1, flap).draw(0, floor, 0).draw(0, flap, 1), "is no triangle");
  // A straight corner is none of the surface's.
  const Points bent = {at(0, 0, 0), at(2, 0, 0), at(4, 0, 0), at(4, 4, 0), at(0, 4, 1)};
  Scene without = one_face(bent), with = without;
  const Points first = corners(bent, {0, 2, 3}), second = corners(bent, {0, 3, 4});
  expect_accepted(without.cut(0, 0, first).cut(0, 1, second).draw(0, first, 0).draw(0, second, 1));
  const Points left = corners(bent, {0, 1, 3}), right = corners(bent, {1, 2, 3});
  expect_rejected(
      with.cut(0, 0, left).cut(0, 1, right).cut(0, 2, second).draw(0, left, 0).draw(0, right, 1).draw(0, second, 2),
      "not a corner of the face's");
}

TEST(Non_planar, holes_are_no_caps) {
  // A triangle with a triangular hole, lifted at one corner: six triangles, and not the outer one minus the inner one.
  const Points outer = {at(0, 0, 0), at(12, 0, 0), at(0, 12, 3)}, inner = {at(2, 2, 1), at(4, 2, 0), at(2, 4, 0)};
  const std::vector<Points> ring = {{outer[0], outer[1], inner[1]}, {outer[0], inner[1], inner[0]},
                                    {outer[1], outer[2], inner[1]}, {outer[2], inner[2], inner[1]},
                                    {outer[2], outer[0], inner[2]}, {outer[0], inner[0], inner[2]}};
  for (const Points& hole : {inner, reversed(inner)}) {
    Scene whole = one_face(outer, {hole}), capped = one_face(outer, {hole});
    for (std::uint32_t k = 0; k < 6; ++k) whole.cut(0, k, ring[k]).draw(0, ring[k], k);
    whole.seen_from(at(1, 2, 100));
    expect_accepted(whole);
    expect_rejected(capped.cut(0, 0, outer).cut(0, 1, reversed(inner)).draw(0, outer, 0).draw(0, reversed(inner), 1),
                    "does not run counterclockwise");
  }
}

}  // namespace
