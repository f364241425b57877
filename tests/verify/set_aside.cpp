// Faces that are not drawn: each reason true and false.

#include "scenes.h"

namespace {

using namespace verify_test;

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
  // A fold that runs along edges: no proper crossing, winding number -1 beside the plot.
  expect_accepted(alone(
      {at(0, 0, 0), at(4, 0, 0), at(6, 0, 0), at(6, -1, 0), at(4, -1, 0), at(4, 0, 0), at(4, 4, 0), at(0, 4, 0)}, why));
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
