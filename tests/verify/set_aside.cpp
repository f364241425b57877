// Faces that are not drawn: each reason true and false.

#include "../sample.h"
#include "scenes.h"
#include "tree_order.h"

#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/set_aside.h>
#include <sightline/harness/generate/families.h>
#include <sightline/kernel/scene/set_aside.h>

namespace {

using test_scenes::least;
using test_scenes::sample;

using namespace verify_test;
using verify_test::Scene;  // made by hand, unlike sightline::Scene

const Points plot = rectangle(0, 4, 0, 4, 0);

Scene alone(const Points& outer, const std::string& why, const std::vector<Points>& holes = {}) {
  Scene scene;
  scene.seen_from(at(0, 0, 10)).face(outer, holes);
  return scene.leave_out(0, why);
}

TEST(Set_aside, for_zero_area) {
  expect_accepted(alone({}, "zero area"));
  expect_accepted(alone({at(1, 1, 1)}, "zero area"));
  expect_accepted(alone({at(1, 1, 1), at(2, 3, 4)}, "zero area"));
  expect_accepted(alone({at(1, 1, 1), at(2, 3, 4), at(1, 1, 1)}, "zero area (two points)"));
  expect_accepted(alone({at(0, 0, 0), at(1, 2, 3), at(3, 6, 9), at(2, 4, 6)}, "zero area"));
  expect_accepted(alone({at(0, 0, 0), at(1, 0, 0), at(0, 1, 0), at(1, 0, 0)}, "zero area"));  // there and back
  expect_accepted(
      alone({at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 1, 0), at(1, 0, 0)}, "zero area"));  // in space
  expect_accepted(alone(plot, "zero area", {plot}));
  expect_rejected(alone(plot, "zero area"), "but has area");
  expect_rejected(alone({at(0, 0, 0), at(1, 0, 0), at(0, tiny(300), 0)}, "zero area"), "but has area");
  expect_rejected(alone({at(0, 0, 0), at(2, 2, 0), at(2, 0, 0), at(0, 2, 0)}, "zero area"),
                  "but has area");  // a bow-tie
  Scene drawn;
  drawn.seen_from(at(0, 0, 10)).face({at(0, 0, 0), at(1, 0, 0), at(2, 0, 0)});
  expect_rejected(drawn, "face 0 has no front and is not set aside");
  drawn.cut(0, 0, {at(0, 0, 0), at(1, 0, 0), at(2, 0, 0)});
  expect_rejected(drawn, "face 0 has no front and is not set aside");
  // No front, but a hole with area: nothing says which way it would face.
  Scene inside_out;
  inside_out.seen_from(at(0, 0, 10)).face({at(0, 0, 0), at(4, 0, 0), at(0, 4, 0), at(4, 0, 0)}, {plot});
  Scene aside = inside_out;
  expect_accepted(aside.leave_out(0, "zero area"));
  expect_rejected(inside_out.draw(0, plot), "face 0 has no front and is not set aside");
}

TEST(Set_aside, as_self_intersecting) {
  const std::string why = "self-intersecting";
  const Points bow_tie = {at(0, 0, 0), at(2, 2, 0), at(2, 0, 0), at(0, 2, 0)};
  const Points touching_bow_tie = {at(0, 0, 0), at(1, 1, 0), at(2, 0, 0),
                                   at(2, 2, 0), at(1, 1, 0), at(0, 2, 0)};  // corners meet, nothing crosses
  const Points through_vertex = {at(0, 0, 0), at(1, 1, 0), at(2, 2, 0), at(2, 0, 0), at(1, 1, 0), at(0, 2, 0)};
  Points twice = plot;
  twice.insert(twice.end(), plot.begin(), plot.end());
  const Points star = {at(0, 0, 0), at(4, 1, 0), at(0, 3, 0), at(2, -1, 0), at(3, 4, 0)};
  for (std::size_t k = 0; k < 3; ++k)
    for (Points p : {bow_tie, through_vertex, twice, star})
      for (const bool turn : {false, true}) {
        for (Exact_point& q : p) std::rotate(q.begin(), q.begin() + static_cast<std::ptrdiff_t>(k), q.end());
        expect_accepted(alone(turn ? reversed(p) : p, why));
      }
  expect_rejected(alone(touching_bow_tie, why), "set aside as self-intersecting but is not");
  // An outer loop and holes that stick out or overlap.
  const Points inside = rectangle(1, 2, 1, 2, 0), wide = rectangle(1, 3, 1, 2, 0), outside = rectangle(5, 6, 1, 2, 0),
               beyond = rectangle(3, 6, 1, 2, 0);
  for (const bool turn : {false, true}) {
    const auto hole = [&](const Points& p) { return turn ? reversed(p) : p; };
    expect_rejected(alone(plot, why, {hole(inside)}), "but is not");
    expect_accepted(alone(plot, why, {hole(outside)}));
    expect_accepted(alone(plot, why, {hole(beyond)}));
    expect_accepted(alone(plot, why, {hole(inside), hole(wide)}));
    expect_accepted(alone(reversed(plot), why, {hole(inside), hole(wide)}));
    expect_rejected(alone(reversed(plot), why, {hole(inside)}), "but is not");
  }
  expect_rejected(alone(plot, why), "but is not");
  expect_rejected(alone(reversed(plot), why), "but is not");
  const Points keyhole = {at(0, 0, 0), at(4, 0, 0), at(4, 4, 0), at(0, 4, 0), at(0, 0, 0),
                          at(1, 1, 0), at(1, 2, 0), at(2, 2, 0), at(2, 1, 0), at(1, 1, 0)};
  const Points ell = {at(0, 0, 0), at(4, 0, 0), at(4, 2, 0), at(2, 2, 0), at(2, 4, 0), at(0, 4, 0)};
  for (const Points& weakly_simple : {keyhole, ell})
    for (const bool turn : {false, true})
      expect_rejected(alone(turn ? reversed(weakly_simple) : weakly_simple, why), "but is not");
  expect_rejected(alone({at(0, 0, 0), at(1, 0, 0), at(3, 0, 0), at(2, 0, 0)}, why), "but is not");
  expect_rejected(alone({}, why), "but is not");
  expect_rejected(alone({at(0, 0, 0), at(2, 2, 0), at(2, 0, 1), at(0, 2, 0)}, why), "is not planar");
  // Two edges cross in a corner of the contour, which goes back from there on half of each: a keyhole in an L.
  const Points spikes = {at(0, -2, 0), at(0, 2, 0),  at(0, 0, 0),   at(-2, 0, 0), at(2, 0, 0),
                         at(2, 3, 0),  at(-3, 3, 0), at(-3, -3, 0), at(0, -3, 0)};
  expect_rejected(alone(spikes, why), "but is not");
  // A fold that runs along edges: no proper crossing, winding number -1 beside the plot.
  expect_accepted(alone(
      {at(0, 0, 0), at(4, 0, 0), at(6, 0, 0), at(6, -1, 0), at(4, -1, 0), at(4, 0, 0), at(4, 4, 0), at(0, 4, 0)}, why));
}

/// The face turned onto each axis, either way around.
std::vector<Scene> turned(const Points& outer, const std::string& why, const std::vector<Points>& holes) {
  std::vector<Scene> all;
  for (std::size_t k = 0; k < 3; ++k)
    for (const bool back : {false, true}) {
      const auto turn = [&](Points p, bool reverse) {
        for (Exact_point& q : p) std::rotate(q.begin(), q.begin() + static_cast<std::ptrdiff_t>(k), q.end());
        return reverse ? reversed(p) : p;
      };
      std::vector<Points> turned_holes;
      for (const Points& hole : holes) turned_holes.push_back(turn(hole, k == 1));
      all.push_back(alone(turn(outer, back), why, turned_holes));
    }
  return all;
}

TEST(Set_aside, as_simple_along_no_axis) {
  const std::string why(text_of(Set_aside_reason::no_simple_projection));
  const Points saddle = {at(0, 0, 0), at(4, 0, 1), at(4, 4, 0), at(0, 4, 1)};
  const auto accepted = [&](const Points& outer, const std::vector<Points>& holes) {
    for (const Scene& scene : turned(outer, why, holes)) expect_accepted(scene);
  };
  const auto rejected = [&](const Points& outer, const std::vector<Points>& holes, const std::string& words) {
    for (const Scene& scene : turned(outer, why, holes)) expect_rejected(scene, words);
  };
  // Along z, the only axis along which the saddle has area: the hole is outside, or half outside, ...
  accepted(saddle, {{at(6, 1, 0), at(7, 1, 0), at(6, 2, 0)}});
  accepted(saddle, {{at(1, 1, 0), at(6, 1, 0), at(1, 2, 0)}});
  // ... goes around another hole, ...
  accepted(saddle, {rectangle(1, 3, 1, 3, 0), rectangle(ratio(3, 2), 2, ratio(3, 2), 2, 0)});
  // ... is upright, so that two points are one, or touches the contour there and not in space, at a corner, ...
  accepted(saddle, {{at(1, 1, 0), at(2, 1, 0), at(2, 1, 1), at(1, 1, 1)}});
  accepted(saddle, {{at(1, 1, 0), at(2, 1, 0), at(0, 0, 1)}});
  // ... or on an edge; in space too, as a triangulation would cut that edge.
  accepted(saddle, {{at(1, 0, 2), at(2, 1, 0), at(1, 1, 0)}});
  accepted(saddle, {{at(2, 0, ratio(1, 2)), at(2, 1, 0), at(1, 1, 0)}});
  // A contour without area, in a plane and in space, whatever the hole.
  accepted({at(0, 0, 0), at(4, 4, 0), at(4, 0, 0), at(0, 4, 0)}, {{at(3, 2, 1), at(1, 1, 0), at(2, 1, 0)}});
  accepted({at(0, 0, 0), at(1, 0, 0), at(0, 0, 0), at(0, 1, 0), at(0, 0, 0), at(0, 0, 1)}, {rectangle(1, 2, 1, 2, 0)});
  // A bow-tie of some area.
  accepted({at(0, 0, 0), at(4, 4, 0), at(4, 0, 0), at(0, 6, 0)}, {{at(3, 2, 1), at(1, 1, 0), at(2, 1, 0)}});

  // Forged: it is planar, whatever else is wrong with it; it has no hole; or a projection does.
  rejected(plot, {rectangle(1, 2, 1, 2, 0)}, "but is planar");
  rejected(plot, {rectangle(5, 6, 1, 2, 0)}, "but is planar");
  rejected({}, {}, "but is planar");
  rejected(saddle, {}, "but has no holes");
  rejected({at(0, 0, 0), at(4, 4, 1), at(4, 0, 0), at(0, 4, 0)}, {}, "but has no holes");
  rejected(saddle, {rectangle(1, 2, 1, 2, 0)}, "but is along axis");
  rejected(saddle, {rectangle(1, 2, 1, 2, 0), {at(3, 3, 0), at(2, 3, 0), at(3, 2, 5)}}, "but is along axis");
  rejected(saddle, {{at(0, 0, 0), at(2, 1, 0), at(1, 2, 0)}}, "but is along axis");  // at a corner, in space
  rejected(saddle, {{at(1, tiny(300), 2), at(2, 1, 0), at(1, 1, 0)}}, "but is along axis");
  rejected(saddle, {{at(1, 1, 0), at(2, 1, 0), at(2, tiny(300) + 1, 1)}}, "but is along axis");
  rejected(saddle, {{at(1, 1, 0), at(2, 2, 0)}}, "but has no holes");  // there and back
  rejected(saddle, {{}}, "but has no holes");
  const Points corner_to_corner = {at(0, 0, 0), at(4, 0, 1), at(4, 4, 8), at(0, 4, 1)};  // area along all axes
  rejected(corner_to_corner, {rectangle(1, 2, 1, 2, 0)}, "but is along axis");
}

TEST(Set_aside, as_what_has_no_front_and_winds) {
  // A contour walked there and back, or around nothing in all: from both sides, a hole winds to -1 somewhere.
  for (const Points& hole : {plot, reversed(plot)}) {
    expect_accepted(alone({at(0, 0, 0), at(4, 0, 0), at(0, 4, 0), at(4, 0, 0)}, "self-intersecting", {hole}));
    expect_accepted(alone({at(0, 0, 0), at(4, 4, 0), at(4, 0, 0), at(0, 4, 0)}, "self-intersecting", {hole}));
  }
}

TEST(Set_aside, as_scenes_do_it_with_twisted_holes) {
  std::size_t aside = 0, kept = 0;
  for (const std::int64_t ulps : {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, generate::far_ulps})
    for (std::uint64_t seed = 0; seed < sample(100u); ++seed) {
      generate::Family_parameters parameters;
      parameters.seed = seed;
      parameters.ulps = ulps;
      const generate::Posed_scene posed = generate::family("twisted_holes").make(parameters);
      const sightline::Scene made(posed.soup);
      const Order_certificate certificate = certificate_of_tree(made, posed.eye);
      const Verdict verdict = verify_order(posed.soup, certificate);
      EXPECT_TRUE(verdict.accepted) << posed.name << ", " << ulps << " ulps: " << verdict.why;
      aside += made.counters().no_simple_projection;
      kept += made.counters().with_holes - made.counters().no_simple_projection;
      // No other reason will do for them, and theirs for none of the others. (A contour that is walked back has no
      // area, wherever its holes are.)
      for (std::size_t k = 0; k < certificate.set_aside.size(); ++k)
        for (const std::string_view text : set_aside_texts) {
          Order_certificate forged = certificate;
          if (forged.set_aside[k].why.starts_with(text) || text == text_of(Set_aside_reason::zero_area)) continue;
          forged.set_aside[k].why = std::string(text) + "0";
          EXPECT_FALSE(verify_order(posed.soup, forged).accepted)
              << posed.name << ": face " << forged.set_aside[k].face << " as " << text;
        }
    }
  EXPECT_GT(aside, least(150u));
  EXPECT_GT(kept, least(150u));
}

TEST(Same_cycle, is_some_rotation_whatever_comes_again_in_it) {
  Dice dice(5);
  std::size_t same = 0;
  for (int k = 0; k < 20000; ++k) {
    Points a, b;
    const long size = roll(dice, 0, 9), kinds = roll(dice, 1, 3);
    for (long i = 0; i < size; ++i) a.push_back(at(roll(dice, 1, kinds), 0, 0));
    b = a;
    if (size > 0) std::rotate(b.begin(), b.begin() + roll(dice, 0, size - 1), b.end());
    if (size > 0 && roll(dice, 0, 1) == 0) b[static_cast<std::size_t>(roll(dice, 0, size - 1))] = at(1, 0, 0);
    bool expected = size == 0;
    Points turned = a;
    for (long i = 0; i < size; ++i) {
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
      expected = expected || turned == b;
    }
    ASSERT_EQ(certificate_check::same_cycle(a, b), expected) << k;
    same += expected;
  }
  EXPECT_GT(same, 5000u);
  EXPECT_LT(same, 19000u);
  EXPECT_FALSE(certificate_check::same_cycle({at(1, 0, 0)}, {}));
}

TEST(Set_aside, as_a_duplicate) {
  const auto pair = [](const Points& first, const Points& second, const std::string& why,
                       const std::vector<Points>& holes = {}, const std::vector<Points>& other_holes = {}) {
    Scene scene;
    scene.seen_from(at(0, 0, 10)).face(first, holes);
    scene.face(second, other_holes);
    return scene.leave_out(1, why).draw(0, plot);
  };
  Points turned = plot;
  std::rotate(turned.begin(), turned.begin() + 2, turned.end());
  Points moved = plot;
  moved[2][0] += tiny(60);
  const Points stutter = {plot[1], plot[1], plot[2], plot[3], plot[0]};
  const Points shared_prefix = {plot[0], plot[1], plot[2], plot[1]};
  const std::string why = "duplicate of 0";
  expect_accepted(pair(plot, plot, why));
  expect_accepted(pair(plot, turned, why));
  expect_accepted(pair(plot, stutter, "duplicate of 0 (to the bit)"));
  expect_accepted(pair(plot, {plot[0], plot[1], plot[2], plot[3], plot[0]}, why));
  expect_rejected(pair(plot, reversed(plot), why), "but differs");
  expect_rejected(pair(plot, moved, why), "but differs");
  expect_rejected(pair(plot, shared_prefix, why), "but differs");
  expect_rejected(pair(plot, {plot[0], plot[1], plot[2]}, why), "but differs");
  expect_rejected(pair({plot[0], plot[1], plot[2]}, plot, why), "but differs");  // part of it, in order
  expect_rejected(pair(plot, plot, why, {}, {rectangle(1, 2, 1, 2, 0)}), "but differs");
  expect_rejected(pair(plot, plot, why, {rectangle(1, 2, 1, 2, 0)}), "but differs");
  for (const std::string bad : {"duplicate of 1", "duplicate of 2", "duplicate of ", "duplicate of x",
                                "duplicate of 99999999999999999999999999", "duplicate of -1", "duplicate of 4294967296",
                                "duplicate of 18446744073709551616"})
    expect_rejected(pair(plot, plot, bad), "not of an earlier face");
  for (const std::string bad : {"", "zero", "duplicate", "because", " zero area", "Zero area"})
    expect_rejected(pair(plot, plot, bad), "no reason that can be checked");
  // Holes are the same cycles too, each in either sense, and in the same order.
  const Points hole = rectangle(1, 2, 1, 2, 0), other = rectangle(3, 4, 3, 4, 0);
  const auto holed = [&](const std::vector<Points>& holes) {
    Scene scene;
    scene.seen_from(at(0, 0, 10)).face(plot, {hole});
    scene.face(plot, holes);
    scene.draw(0, rectangle(0, 4, 0, 1, 0)).draw(0, rectangle(0, 4, 2, 4, 0));
    return scene.draw(0, rectangle(0, 1, 1, 2, 0)).draw(0, rectangle(2, 4, 1, 2, 0)).leave_out(1, why);
  };
  expect_accepted(holed({hole}));
  expect_accepted(holed({reversed(hole)}));
  expect_accepted(holed({{hole[2], hole[3], hole[0], hole[1]}}));
  expect_rejected(holed({other}), "but differs");
  expect_rejected(holed({{hole[0], hole[2], hole[1], hole[3]}}), "but differs");
  expect_rejected(pair(plot, plot, why, {hole, other}, {other, hole}), "but differs");
  // The original must be kept, and be the earlier one.
  Scene chain = pair(plot, plot, why);
  chain.face(plot);
  Scene right = chain, wrong = chain;
  expect_accepted(right.leave_out(2, "duplicate of 0"));
  expect_rejected(wrong.leave_out(2, "duplicate of 1"), "which is set aside itself");
  Scene first;
  first.seen_from(at(0, 0, 10)).face(plot);
  first.face(plot);
  expect_rejected(first.leave_out(0, "duplicate of 1").draw(1, plot), "not of an earlier face");
}

TEST(Set_aside, and_drawn_or_cut_or_set_aside_twice_is_an_error) {
  Scene drawn = alone({at(0, 0, 0), at(1, 0, 0), at(2, 0, 0)}, "zero area");
  Scene cut = drawn, twice = drawn, nowhere = drawn;
  expect_rejected(drawn.draw(0, plot), "face 0 is set aside but drawn", {0});
  expect_rejected(cut.cut(0, 0, plot), "face 0 is set aside but has pieces");
  expect_rejected(twice.leave_out(0, "zero area"), "face 0 is set aside twice");
  expect_rejected(nowhere.leave_out(1, "zero area"), "which the scene does not have");
}

}  // namespace
