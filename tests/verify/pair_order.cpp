// The order of pairs of fragments (P-20): every right order accepted, every wrong one rejected with the pair at fault.

#include "scenes.h"

namespace {

using namespace verify_test;

const Points low_quad = rectangle(-2, 2, -2, 2, 0), high_quad = rectangle(-1, 1, -1, 1, 1);
const Exact_point high_eye = at(0, 0, 10), low_eye = at(0, 0, -10);

TEST(Pair_order, of_parallel_quads_is_by_distance) {
  for (const Exact_point& eye : {high_eye, low_eye, at(7, ratio(-3, 7), 5), at(1, 1, -1)}) {
    const bool from_above = sgn(eye[2]) > 0;
    Scene right;
    right.seen_from(eye);
    const Face_id l = right.face(low_quad), h = right.face(high_quad);
    Scene wrong = right;
    right.draw(from_above ? l : h, from_above ? low_quad : high_quad)
        .draw(from_above ? h : l, from_above ? high_quad : low_quad);
    wrong.draw(from_above ? h : l, from_above ? high_quad : low_quad)
        .draw(from_above ? l : h, from_above ? low_quad : high_quad);
    expect_accepted(right);
    expect_rejected(wrong, "is nearer", {0, 1});
  }
}

TEST(Pair_order, does_not_depend_on_the_sense_of_faces) {
  for (const bool turn_low : {false, true})
    for (const bool turn_high : {false, true}) {
      const Points l = turn_low ? reversed(low_quad) : low_quad, h = turn_high ? reversed(high_quad) : high_quad;
      Scene right, wrong;
      for (Scene* scene : {&right, &wrong}) {
        scene->seen_from(high_eye);
        scene->face(l);
        scene->face(h);
      }
      expect_accepted(right.draw(0, l).draw(1, h));
      expect_rejected(wrong.draw(1, h).draw(0, l), "fragment 0 (face 1) is drawn before fragment 1 (face 0)", {0, 1});
    }
}

TEST(Pair_order, between_the_faces_is_free) {
  for (const bool low_first : {false, true}) {
    Scene scene;
    scene.seen_from(at(0, 0, ratio(1, 2)));
    scene.face(low_quad);
    scene.face(high_quad);
    if (low_first) scene.draw(0, low_quad).draw(1, high_quad);
    else scene.draw(1, high_quad).draw(0, low_quad);
    expect_accepted(scene);
  }
}

TEST(Pair_order, of_coplanar_overlapping_faces_is_free) {
  const Points other = rectangle(-1, 5, -1, 5, 0);
  for (const Points& second : {other, reversed(other), low_quad, reversed(low_quad)})
    for (const bool first_first : {false, true}) {
      Scene scene;
      scene.seen_from(high_eye);
      scene.face(low_quad);
      scene.face(second);
      if (first_first) scene.draw(0, low_quad).draw(1, second);
      else scene.draw(1, second).draw(0, low_quad);
      expect_accepted(scene);
    }
}

TEST(Pair_order, of_faces_that_only_touch_in_the_view_is_free) {
  const Points beside = rectangle(1, 2, 0, 1, 0),
               over = rectangle(0, 1, 0, 1, 1);  // seen from (1, 0, 10) they share a line
  for (const bool first_first : {false, true}) {
    Scene scene;
    scene.seen_from(at(1, 0, 10));
    scene.face(beside);
    scene.face(over);
    if (first_first) scene.draw(0, beside).draw(1, over);
    else scene.draw(1, over).draw(0, beside);
    expect_accepted(scene);
  }
  Scene near;  // and a hair of overlap is overlap
  near.seen_from(at(1, 0, 10));
  near.face(beside);
  const Points wide = rectangle(0, 1 + tiny(200), 0, 1, 1);
  near.face(wide);
  expect_rejected(near.draw(1, wide).draw(0, beside), "is nearer", {0, 1});
}

TEST(Pair_order, equal_distance_on_a_shared_edge_is_in_order_and_a_hair_more_is_not) {
  // Two faces that share the edge x = 0 and overlap in the view.
  const Points floor = rectangle(0, 2, 0, 1, 0);
  for (const Rational& slope : {Rational(1), tiny(300)}) {
    const Points ramp = {at(0, 0, 0), at(2, 0, 2 * slope), at(2, 1, 2 * slope), at(0, 1, 0)};
    Scene right, wrong;
    for (Scene* scene : {&right, &wrong}) {
      scene->seen_from(at(1, 0, 10));
      scene->face(floor);
      scene->face(ramp);
    }
    expect_accepted(right.draw(0, floor).draw(1, ramp));
    expect_rejected(wrong.draw(1, ramp).draw(0, floor), "is nearer", {0, 1});
  }
}

TEST(Pair_order, of_crossing_quads_needs_a_split) {
  const auto slab = [](int x0, int x1, int slope) -> Points {
    return {at(x0, -1, slope * x0), at(x1, -1, slope * x1), at(x1, 1, slope * x1), at(x0, 1, slope * x0)};
  };
  const Points up = slab(-1, 1, 1), down = slab(-1, 1, -1);
  Scene empty;
  empty.seen_from(high_eye);
  empty.face(up);
  empty.face(down);
  for (const bool up_first : {false, true}) {
    Scene unsplit = empty;
    if (up_first) unsplit.draw(0, up).draw(1, down);
    else unsplit.draw(1, down).draw(0, up);
    expect_rejected(unsplit, "is nearer", {0, 1});
  }
  Scene split = empty;
  expect_accepted(
      split.draw(0, slab(-1, 0, 1)).draw(1, slab(0, 1, -1)).draw(1, slab(-1, 0, -1)).draw(0, slab(0, 1, 1)));
  Scene half = empty;  // it is enough to split one
  expect_accepted(half.draw(0, slab(-1, 0, 1)).draw(1, down).draw(0, slab(0, 1, 1)));
  Scene swapped = empty;
  expect_rejected(swapped.draw(0, slab(0, 1, 1)).draw(1, down).draw(0, slab(-1, 0, 1)), "is nearer", {0, 1});
}

TEST(Pair_order, of_three_bars_in_a_cycle_needs_a_split) {
  const Rational w = ratio(1, 4);
  const auto a_part = [&](int x0, int x1) -> Points {
    return {at(x0, -w, 1 - ratio(x0, 2)), at(x1, -w, 1 - ratio(x1, 2)), at(x1, w, 1 - ratio(x1, 2)),
            at(x0, w, 1 - ratio(x0, 2))};
  };
  const Points a = a_part(-1, 5);
  const Points b = {at(5 - w, -1 - w, ratio(3, 2)), at(5 + w, -1 + w, ratio(3, 2)), at(-1 + w, 5 + w, ratio(-3, 2)),
                    at(-1 - w, 5 - w, ratio(-3, 2))};
  const Points c = {at(-w, -1, ratio(-3, 2)), at(w, -1, ratio(-3, 2)), at(w, 5, ratio(3, 2)), at(-w, 5, ratio(3, 2))};
  const std::vector<Points> bars = {a, b, c};
  Scene empty;
  empty.seen_from(at(1, 1, 100));
  for (const Points& bar : bars) empty.face(bar);
  std::vector<Face_id> order = {0, 1, 2};
  do {
    Scene scene = empty;
    for (const Face_id f : order) scene.draw(f, bars[f]);
    const Verdict verdict = scene.verdict();
    EXPECT_FALSE(verdict.accepted);
    EXPECT_NE(verdict.why.find("is nearer"), std::string::npos) << verdict.why;
  } while (std::next_permutation(order.begin(), order.end()));
  Scene split = empty;
  expect_accepted(split.draw(0, a_part(2, 5)).draw(1, b).draw(2, c).draw(0, a_part(-1, 2)));
}

TEST(Pair_order, of_edge_on_faces_is_free) {
  const Points wall = {at(0, -3, -3), at(0, 3, -3), at(0, 3, 3), at(0, -3, 3)};  // x = 0: the eye is in its plane
  for (int place = 0; place < 3; ++place) {
    Scene scene;
    scene.seen_from(high_eye);
    scene.face(low_quad);
    scene.face(high_quad);
    scene.face(wall);
    for (int k = 0; k < 3; ++k) {
      if (k == place) scene.draw(2, wall);
      if (k == 0) scene.draw(0, low_quad);
      if (k == 1) scene.draw(1, high_quad);
    }
    expect_accepted(scene);
    Scene missing = scene;
    missing.certificate.fragments.erase(missing.certificate.fragments.begin() + place);
    expect_rejected(missing, "face 2 has no fragment");
  }
  Scene off;  // a hair beside the plane it counts
  off.seen_from(at(tiny(100), 0, 10));
  off.face(low_quad);
  off.face(wall);
  expect_rejected(off.draw(1, wall).draw(0, low_quad), "is nearer", {0, 1});
}

TEST(Pair_order, with_the_eye_at_a_vertex_or_on_a_face_leaves_that_face_free) {
  for (const Exact_point& eye : {at(1, 1, 1), at(0, 0, 1), at(1, 0, 1), at(50, 3, 1)})
    for (const bool low_first : {false, true}) {
      Scene scene;
      scene.seen_from(eye);
      scene.face(low_quad);
      scene.face(high_quad);
      if (low_first) scene.draw(0, low_quad).draw(1, high_quad);
      else scene.draw(1, high_quad).draw(0, low_quad);
      expect_accepted(scene);
    }
  Scene three;  // and the others bound
  const Points middle = rectangle(-1, 1, -1, 1, ratio(1, 2));
  three.seen_from(at(1, 1, 1));
  three.face(low_quad);
  three.face(high_quad);
  three.face(middle);
  Scene wrong = three;
  expect_accepted(three.draw(0, low_quad).draw(1, high_quad).draw(2, middle));
  expect_rejected(wrong.draw(2, middle).draw(1, high_quad).draw(0, low_quad), "is nearer", {0, 2});
}

TEST(Pair_order, of_wide_cones_looks_only_forward) {
  // Nearly half-spaces, so that each cone also meets the other's mirror image in the eye.
  const Points front = {at(-50, -70, 1), at(90, -80, 1), at(110, 60, 1), at(-100, 100, 1)};
  const Points side = {at(2, -90, 70), at(2, -60, -100), at(2, 100, -90), at(2, 80, 110)};
  Scene right, wrong;
  for (Scene* scene : {&right, &wrong}) {
    scene->seen_from(at(0, 0, 0));
    scene->face(front);
    scene->face(side);
  }
  // They cross (x = 2, z = 1), so that neither order is right.
  expect_rejected(right.draw(0, front).draw(1, side), "is nearer", {0, 1});
  expect_rejected(wrong.draw(1, side).draw(0, front), "is nearer", {0, 1});
}

TEST(Pair_order, reports_progress_up_to_the_end) {
  Scene scene;
  scene.seen_from(high_eye);
  scene.face(low_quad);
  scene.face(high_quad);
  scene.draw(0, low_quad).draw(1, high_quad);
  std::vector<std::size_t> seen;
  Verify_options options;
  options.progress = [&](std::size_t done, std::size_t total) {
    seen.push_back(done);
    EXPECT_EQ(total, 2u);
  };
  EXPECT_TRUE(verify_order(scene.soup, scene.certificate, options).accepted);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_GT(std::count(seen.begin(), seen.end(), 0), 4);  // faces, cones, and pairs, before any of these is done with
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2}));
}

}  // namespace
