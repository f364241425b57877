// What polygons can see (P-72): right certificates accepted, and each rule of sightlines, sources and faces broken
// alone rejected for its reason. Trees: weak_trees.cpp.

#include "weak_scenes.h"

namespace weak_test {

namespace {

TEST(Weak_certificate, of_hand_made_scenes_is_accepted_and_right_wherever_one_shoots) {
  for (const auto& [what, scene] : all_scenes()) {
    SCOPED_TRACE(what);
    expect_accepted(scene);
    Dice dice(20261121);
    EXPECT_EQ(Judge(scene.certificate).fault(dice, 200 / share), "");
  }
}

TEST(Weak_certificate, says_how_many_faces_are_what) {
  expect_accepted(one_blocker(), "0 faces visible, 2 hidden, 0 undecided from 1 source polygons; 2 leaves of proofs");
  expect_accepted(open_slit(), "1 faces visible, 2 hidden, 0 undecided from 1 source polygons; 2 leaves of proofs");
  expect_accepted(two_sources(), "0 faces visible, 3 hidden, 1 undecided from 2 source polygons; 13 leaves of proofs");
  expect_accepted(strip(64), "0 faces visible, 65 hidden, 0 undecided from 1 source polygons; 128 leaves of proofs");
  Weak_scene nothing;
  expect_accepted(nothing.from(up(0, 1, 0, 1, 0)),
                  "0 faces visible, 0 hidden, 0 undecided from 1 source polygons; 0 leaves of proofs");
}

TEST(Weak_certificate, that_is_not_the_scene_is_rejected) {
  Weak_scene scene = one_blocker();
  scene.certificate.fragments.pop_back();
  scene.certificate.hidden.pop_back();
  scene.certificate.hidden.pop_back();
  expect_rejected(scene, "face 1 has no fragment");
  scene = one_blocker();
  scene.certificate.fragments[1].vertices[0][0] += tiny(60);
  expect_rejected(scene, "face 1 is not tiled");
}

TEST(Weak_sources, that_are_no_convex_polygons_are_rejected) {
  Weak_scene scene = one_blocker();
  scene.certificate.sources.clear();
  expect_rejected(scene, "there is no source");
  const std::vector<std::pair<Points, std::string>> wrong = {
      {{}, "source 0 has zero area"},
      {{at(0, 0, 0), at(1, 0, 0)}, "source 0 has zero area"},
      {{at(0, 0, 0), at(1, 0, 0), at(2, 0, 0)}, "source 0 has zero area"},
      {{at(0, 0, 0), at(4, 0, 0), at(1, 1, 0), at(0, 4, 0)}, "source 0 is not convex"},
      {{at(0, 0, 0), at(1, 0, 0), at(1, 1, 1), at(0, 1, 0)}, "source 0 has a vertex off the plane"},
      {{at(0, 0, 0), at(0, 0, 0), at(1, 0, 0), at(1, 1, 0)}, "source 0 has a repeated vertex"},
      {{at(0, 0, doubled()), at(1, 0, 0), at(1, 1, 0)}, "source 0 has a vertex that is not in canonical numbers"},
      {{at(0, 0, 0), at(1, infinite(), 0), at(1, 1, 0)}, "source 0 has a vertex that is not in canonical numbers"}};
  for (const auto& [polygon, words] : wrong) {
    scene = one_blocker();
    scene.certificate.sources[0] = polygon;
    expect_rejected(scene, words);
  }
}

TEST(Weak_sources, may_have_straight_corners_and_so_may_fragments) {
  Weak_scene scene = t_junction();
  scene.certificate.sources[0].insert(scene.certificate.sources[0].begin() + 1, at(ratio(1, 3), 0, 0));
  auto& first = scene.certificate.fragments[1].vertices;
  first.insert(first.begin() + 2, {at(ratio(1, 2), 0, 1), at(ratio(1, 2), ratio(1, 2), 1)});
  expect_accepted(scene);
  scene.certificate.lines[0] = {1, 3};  // the same line, by another stretch of it
  expect_accepted(scene);
  scene.certificate.lines[0] = {2, 3};  // by the other face, the other way round
  expect_rejected(scene,
                  "hidden 0 (face 0), node 2 is not blocked by fragment 3: lines may pass an edge of it outside");
  auto& proof = scene.certificate.hidden[0].proof;
  proof = {proof[0], proof[4], proof[1], proof[2], proof[3]};
  expect_accepted(scene);
  // In great numbers they cost little.
  const int count = 20000 / static_cast<int>(share);
  const auto many = [&](Points polygon, std::size_t corner) {
    const Exact_point start = polygon[corner], step = from_to(start, polygon[corner + 1]);
    Points between;
    for (int k = 1; k < count; ++k) between.push_back(along(start, ratio(k, count), step));
    polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(corner + 1), between.begin(), between.end());
    return polygon;
  };
  scene = closed_slit();
  scene.certificate.sources[0] = many(scene.certificate.sources[0], 0);
  for (auto& fragment : scene.certificate.fragments) fragment.vertices = many(fragment.vertices, 1);
  scene.certificate.lines[1].corner = static_cast<std::size_t>(count) + 2;
  scene.certificate.hidden[0].proof[2].terms[0].factor = 2 * count;
  expect_accepted(scene);
}

// ---- Visible

const Exact_point below_slit = at(ratio(3, 5), ratio(1, 2), 0), above_slit = at(ratio(3, 5), ratio(1, 2), 3);

void expect_rejected_sightline(Weak_scene scene, const Exact_point& from, const Exact_point& to,
                               const std::string& words) {
  scene.certificate.visible[0].from = from;
  scene.certificate.visible[0].to = to;
  expect_rejected(scene, "visible 0 (face 0) " + words);
}

TEST(Sightline, of_what_is_not_there_is_rejected) {
  Weak_scene scene = open_slit();
  scene.certificate.visible[0].fragment = 3;
  expect_rejected(scene, "visible 0 names fragment 3, which there is not");
  scene = open_slit();
  scene.certificate.visible[0].source = 1;
  expect_rejected(scene, "visible 0 (face 0) names source 1, which there is not");
  expect_rejected_sightline(open_slit(), at(doubled(), 0, 0), above_slit,
                            "has an end point that is not in canonical numbers");
  expect_rejected_sightline(open_slit(), below_slit, at(0, 0, infinite()),
                            "has an end point that is not in canonical numbers");
}

TEST(Sightline, begins_and_ends_strictly_inside) {
  for (const Exact_point& p :
       {at(ratio(3, 5), 0, 0), at(ratio(3, 5), 1, 0), at(1, ratio(1, 2), 0), at(0, 0, 0), at(2, ratio(1, 2), 0),
        at(ratio(3, 5), ratio(1, 2), tiny(90)), at(ratio(3, 5), ratio(1, 2), -tiny(90))}) {
    expect_rejected_sightline(open_slit(), p, above_slit, "does not begin inside its source");
    expect_rejected_sightline(open_slit(), below_slit, along(p, 3, at(0, 0, 1)), "does not end inside its fragment");
  }
  expect_rejected_sightline(open_slit(), above_slit, below_slit, "does not begin inside its source");
}

TEST(Sightline, goes_between_the_fronts) {
  Weak_scene scene = open_slit();
  std::reverse(scene.certificate.sources[0].begin(), scene.certificate.sources[0].end());
  expect_rejected(scene, "visible 0 (face 0) does not end in front of its source");
  Weak_scene flat;
  flat.from(up(0, 1, 0, 1, 0)).face(down(2, 3, 0, 1, 0));
  expect_rejected(flat.see(0, at(ratio(1, 2), ratio(1, 2), 0), at(ratio(5, 2), ratio(1, 2), 0)),
                  "does not end in front of its source");
  Weak_scene behind;
  behind.from(up(0, 1, 0, 1, 0)).face(up(0, 1, 0, 1, 1));
  behind.see(0, at(ratio(1, 2), ratio(1, 2), 0), at(ratio(1, 2), ratio(1, 2), 1));
  expect_rejected(behind, "visible 0 (face 0) begins behind its fragment");
  behind.certificate.two_sided = true;
  expect_accepted(behind, "1 faces visible");
  // A wall that stands on the source, seen from a point in its plane: from neither side, even if both count.
  Weak_scene board;
  board.from(up(0, 1, 0, 1, 0))
      .face({at(ratio(1, 2), 0, 1), at(ratio(1, 2), 1, 1), at(ratio(1, 2), 1, 2), at(ratio(1, 2), 0, 2)});
  board.certificate.two_sided = true;
  board.see(0, at(ratio(1, 2), ratio(1, 2), 0), at(ratio(1, 2), ratio(1, 2), ratio(3, 2)));
  expect_rejected(board, "visible 0 (face 0) begins in the plane of its fragment");
  board.certificate.visible[0].from[0] += tiny(50);
  expect_accepted(board, "1 faces visible");
  board.certificate.visible[0].from[0] -= tiny(49);
  expect_accepted(board, "1 faces visible");
}

TEST(Sightline, that_meets_a_fragment_is_rejected_be_it_in_an_edge_or_a_corner) {
  for (const Rational& x : {ratio(1, 2), ratio(7, 10), ratio(1, 10), ratio(9, 10)})
    expect_rejected_sightline(open_slit(), at(x, ratio(1, 2), 0), at(x, ratio(1, 2), 3),
                              x < ratio(3, 5) ? "meets fragment 1 (face 1)" : "meets fragment 2 (face 2)");
  for (const Rational& x : {Rational(ratio(1, 2) + tiny(80)), Rational(ratio(7, 10) - tiny(80))}) {
    Weak_scene scene = open_slit();
    scene.certificate.visible[0].from[0] = x;
    scene.certificate.visible[0].to[0] = x;
    expect_accepted(scene, "1 faces visible");
  }
  expect_rejected(open_slit(0), "visible 0 (face 0) meets fragment 1");
  Weak_scene corner = open_slit();
  corner.face({at(ratio(3, 5), ratio(1, 2), 2), at(9, 9, 2), at(8, 9, 2)});
  corner.hide(3, {away()});
  expect_rejected(corner, "visible 0 (face 0) meets fragment 3 (face 3)");
  corner = open_slit();
  corner.face({at(Rational(ratio(3, 5) + tiny(70)), ratio(1, 2), 2), at(9, 9, 2), at(8, 9, 2)});
  expect_accepted(corner.hide(3, {away()}));
}

TEST(Sightline, in_a_fragments_plane_is_rejected_only_where_they_meet) {
  const auto fin = [](const Rational& y, const Rational& z0,
                      const Rational& z1) {  // in the plane of the sightline, upright
    Weak_scene scene = nothing_between();
    const Rational x = ratio(1, 2);
    scene.face({at(x, y, z0), at(x, 9, z0), at(x, 9, z1), at(x, y, z1)});
    scene.certificate.undecided = {1};
    return scene.see(0, at(x, ratio(1, 2), 0), at(x, ratio(1, 2), 3));
  };
  expect_accepted(fin(ratio(2, 3), 1, 2));
  expect_accepted(fin(Rational(ratio(1, 2) + tiny(70)), 1, 2));
  expect_accepted(fin(ratio(1, 3), -2, -1));
  expect_accepted(fin(ratio(1, 3), 4, 5));
  expect_accepted(fin(ratio(1, 2), 4, 5));
  // Only edges of the fragment are between them: it is met beyond the end. Or only the sightline's own line: a thorn
  // points at it.
  const auto slanted = [](const std::vector<std::array<Rational, 2>>& fragment) {
    const auto in_plane = [](const Rational& y, const Rational& z) { return at(ratio(1, 2), y, z); };
    Weak_scene scene = nothing_between();
    Points corners;
    for (const auto& [y, z] : fragment) corners.push_back(in_plane(y, z));
    scene.face(corners);
    scene.certificate.undecided = {1};
    return scene.see(0, in_plane(ratio(1, 10), 0), in_plane(ratio(9, 10), 3));
  };
  expect_accepted(slanted({{ratio(1, 10), ratio(29, 10)}, {1, ratio(31, 10)}, {ratio(1, 10), 9}}));
  expect_rejected(slanted({{ratio(1, 10), ratio(28, 10)}, {1, 3}, {ratio(1, 10), 9}}),
                  "visible 0 (face 0) meets fragment 1 (face 1)");
  expect_accepted(slanted({{ratio(1, 2) + tiny(70), ratio(3, 2)}, {9, -50}, {9, 20}}));
  for (const Rational& y : {ratio(1, 2), Rational(ratio(1, 2) - tiny(70))})
    expect_rejected(slanted({{y, ratio(3, 2)}, {9, -50}, {9, 20}}), "visible 0 (face 0) meets fragment 1 (face 1)");
  for (const Weak_scene& scene : {fin(ratio(1, 3), 1, 2), fin(ratio(1, 2), 1, 2), fin(ratio(1, 3), -1, 9),
                                  fin(ratio(1, 3), 3, 4), fin(ratio(1, 3), -1, 0), fin(ratio(1, 2), 3, 4)})
    expect_rejected(scene, "visible 0 (face 0) meets fragment 1 (face 1)");
}

TEST(Sightline, has_nothing_at_its_ends_but_what_is_in_their_planes) {
  // A keel on the source, and one under the target: the open segment is free, but no segment beside it is.
  Weak_scene scene = keel();
  scene.see(0, at(0, 0, 0), at(0, 0, 3));
  expect_rejected(scene, "visible 0 (face 0) meets fragment");
  Weak_scene roof;
  roof.from(up(-1, 1, -1, 1, 0)).face(down(-1, 1, -1, 1, 3));
  roof.face({at(0, -9, 3), at(0, 9, 3), at(8, 9, -5), at(8, -9, -5)});
  roof.face({at(0, -9, 3), at(-8, -9, -5), at(-8, 9, -5), at(0, 9, 3)});
  roof.certificate.undecided = {1, 2};
  expect_rejected(roof.see(0, at(0, 0, 0), at(0, 0, 3)), "visible 0 (face 0) meets fragment");
  Weak_scene from_behind;
  from_behind.certificate.two_sided = true;
  from_behind.from(roof.certificate.sources[0]).face(up(-1, 1, -1, 1, 3));
  for (const std::size_t f : {1u, 2u}) from_behind.face(roof.certificate.fragments[f].vertices);
  from_behind.certificate.undecided = {1, 2};
  expect_rejected(from_behind.see(0, at(0, 0, 0), at(0, 0, 3)), "visible 0 (face 0) meets fragment");
  // A fragment in the plane of the source that holds its point, and one in the target's: they are met by no segment
  // beside it either.
  Weak_scene flat = nothing_between();
  flat.face(up(0, 1, 0, 1, 0));
  flat.face(down(-4, 4, -4, 4, 0));
  flat.face(up(-4, 4, -4, 4, 3));
  flat.hide(1, {away()})
      .hide(2, {away()})
      .hide(3, {away()})
      .see(0, at(ratio(1, 2), ratio(1, 2), 0), at(ratio(1, 3), ratio(1, 2), 3));
  expect_accepted(flat, "1 faces visible, 3 hidden");
  // A foot of a wall is met, one beside the sightline is not.
  for (const bool met : {false, true}) {
    Weak_scene board = nothing_between();
    const Rational x = met ? ratio(1, 2) : ratio(2, 3);
    board.face({at(x, 0, 0), at(x, 0, 1), at(x, 1, 1), at(x, 1, 0)});
    board.certificate.undecided = {1};
    board.see(0, at(ratio(1, 2), ratio(1, 2), 0), at(ratio(1, 3), ratio(1, 2), 3));
    met ? expect_rejected(board, "meets fragment 1") : expect_accepted(board);
  }
}

TEST(Sightline, is_judged_as_by_clipping_on_a_small_grid) {
  std::size_t accepted = 0, rejected = 0;
  for (unsigned seed = 0; seed < 3000 / share; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    const auto point = [&] { return at(roll(dice, 0, 4), roll(dice, 0, 4), roll(dice, 0, 4)); };
    const auto triangle = [&] {
      Points corners;
      do corners = {point(), point(), point()};
      while (inner(Judged(corners).normal, Judged(corners).normal) == 0);
      return corners;
    };
    const auto middle = [&](const Points& t) {
      const long a = roll(dice, 1, 2), b = roll(dice, 1, 2), c = roll(dice, 1, 2);
      const Exact_point sum = along(along(along(at(0, 0, 0), a, t[0]), b, t[1]), c, t[2]);
      return at(sum[0] / (a + b + c), sum[1] / (a + b + c), sum[2] / (a + b + c));
    };
    Weak_scene scene;
    scene.certificate.two_sided = roll(dice, 0, 1) == 1;
    const Points source = triangle();
    const std::size_t faces = static_cast<std::size_t>(roll(dice, 1, 4));
    for (std::size_t k = 0; k < faces; ++k) {
      const Points corners = triangle();
      scene.face(corners);
      if (k > 0) scene.certificate.undecided.push_back(static_cast<Face_id>(k));
    }
    const Points& target = scene.certificate.fragments[0].vertices;
    const Exact_point p = middle(source), q = middle(target);
    scene.from(source).see(0, p, q);
    const Judge judge(scene.certificate);
    bool right = judge.look_at_each_other(0, 0, p, q);
    for (const Judged& f : judge.fragments) {
      const auto flat = [&](const Points& polygon) {
        return std::all_of(f.corners.begin(), f.corners.end(),
                           [&](const Exact_point& v) { return Judged(polygon).above(v) == 0; });
      };
      const std::vector<Rational> places = f.meetings(p, q);
      right = right && (places.empty() || (places == std::vector<Rational>{0} && flat(source)) ||
                        (places == std::vector<Rational>{1} && flat(target)));
    }
    EXPECT_EQ(scene.verdict().accepted, right) << scene.verdict().why;
    ++(right ? accepted : rejected);
  }
  EXPECT_GT(accepted, 300 / share);
  EXPECT_GT(rejected, 300 / share);
}

// ---- Faces

TEST(Weak_faces, are_each_accounted_for_once) {
  Weak_scene scene = open_slit();
  scene.certificate.visible.clear();
  expect_rejected(
      scene, "face 0 is neither visible nor undecided, and fragment 0 of it is not shown to be hidden from source 0");
  scene.certificate.undecided = {0};
  expect_accepted(scene, "0 faces visible, 2 hidden, 1 undecided");
  scene.certificate.undecided = {0, 0};
  expect_rejected(scene, "face 0 is undecided twice");
  scene.certificate.undecided = {0, 3};
  expect_rejected(scene, "undecided names face 3, which is not drawn");
  scene = open_slit();
  scene.certificate.undecided = {0};
  expect_rejected(scene, "face 0 is undecided, but shown to be visible");
  scene.certificate.undecided = {1};
  expect_rejected(scene, "face 1 is undecided, but shown to be hidden");
  scene = one_blocker();
  scene.certificate.hidden.push_back(scene.certificate.hidden[0]);
  expect_rejected(scene, "hidden 2 is of the same fragment and source as one before");
  scene = open_slit();
  scene.see(0, along(below_slit, tiny(9), at(1, 0, 0)), above_slit);
  expect_accepted(scene, "1 faces visible, 2 hidden");
}

TEST(Weak_faces, are_told_with_the_first_sources) {
  Weak_scene scene = one_blocker();
  expect_accepted(scene, "from 1 source polygons; ");
  expect_accepted(scene, ", source 0 (0, 0, 0) (1, 0, 0) (1, 1, 0) (0, 1, 0) looking to (0, 0, 1); ");
  for (std::size_t source = 1; source < 5; ++source) {
    scene.from(scene.certificate.sources[0]).hide(0, {blocked(1)}, source).hide(1, {away()}, source);
    const std::string why = scene.verdict().why;
    EXPECT_NE(why.find(", source " + std::to_string(std::min<std::size_t>(source, 2)) + " (0, 0, 0)"),
              std::string::npos)
        << why;
    EXPECT_EQ(why.find("source 3 ("), std::string::npos) << why;
    const std::string more = " and " + std::to_string(source - 2) + " more; ";
    EXPECT_EQ(why.find(more) != std::string::npos, source > 2) << why;
  }
}

TEST(Weak_faces, are_hidden_together_by_one_leaf) {
  Weak_scene scene = one_blocker();
  Weak_scene more = scene;
  const std::size_t behind = more.face({at(0, 0, 4), at(0, 1, 4), at(1, 1, 4), at(1, 0, 4)});
  const std::size_t beside = more.face({at(99, 0, 4), at(99, 1, 4), at(100, 1, 4), at(100, 0, 4)});
  more.certificate.hidden[0].also = {behind};
  more.certificate.undecided = {static_cast<Face_id>(beside)};
  expect_accepted(more, "0 faces visible, 3 hidden, 1 undecided");
  // Each of them is checked.
  Weak_scene wrong = more;
  wrong.certificate.hidden[0].also = {behind, beside};
  expect_rejected(wrong, "hidden 0 (face 3), node 0 is not blocked by fragment 1");
  wrong = more;
  wrong.certificate.hidden[1].also = {beside};
  expect_rejected(wrong, "hidden 1 (face 3), node 0 is not away");
  // Each is there, and once.
  for (const std::size_t twice : {std::size_t{0}, behind}) {
    wrong = more;
    wrong.certificate.hidden[0].also = {behind, twice};
    expect_rejected(wrong, "is of the same fragment and source as one before");
  }
  wrong = more;
  wrong.certificate.hidden[0].also = {behind, 4};
  expect_rejected(wrong, "hidden 0 names fragment 4, which there is not");
  // A tree is of one fragment, or of a polygon.
  wrong = more;
  wrong.certificate.lines.push_back({1, 0});
  wrong.certificate.hidden[0].proof = {side_of(0), blocked(1), blocked(1)};
  expect_rejected(wrong, "hidden 0 is of several fragments, but its proof is neither one leaf nor of a polygon");
  wrong.certificate.hidden[0].also.clear();
  wrong.certificate.undecided.push_back(static_cast<Face_id>(behind));
  expect_accepted(wrong, "0 faces visible, 2 hidden, 2 undecided");
}

/// Two triangles behind a fragment, hidden by one tree of the square that they are.
Weak_scene two_in_a_target() {
  Weak_scene scene = one_blocker();
  const std::size_t one = scene.face({at(0, 0, 4), at(0, 1, 4), at(1, 1, 4)}),
                    other = scene.face({at(0, 0, 4), at(1, 1, 4), at(1, 0, 4)});
  scene.certificate.lines.push_back({1, 0});
  scene.certificate.hidden.push_back({one, 0, {side_of(0), blocked(1), blocked(1)}, {other}});
  scene.certificate.hidden.back().target = {at(0, 0, 4), at(0, 1, 4), at(1, 1, 4), at(1, 0, 4)};
  return scene;
}

TEST(Weak_faces, are_hidden_together_by_a_tree_of_a_polygon_that_holds_them) {
  const Weak_scene right = two_in_a_target();
  expect_accepted(right, "0 faces visible, 4 hidden");
  const auto with = [&](auto&& change) {
    Weak_scene scene = right;
    change(scene.certificate.hidden.back());
    return scene;
  };
  using Hidden = Weak_certificate::Hidden;
  expect_accepted(with([](Hidden& entry) { std::swap(entry.fragment, entry.also[0]); }), "4 hidden");
  // Larger, with straight corners, as long as its tree holds.
  expect_accepted(with([](Hidden& entry) {
                    entry.target = {at(-1, 0, 4), at(0, 1, 4), at(1, 2, 4), at(3, 2, 4), at(1, 0, 4), at(0, 0, 4)};
                  }),
                  "4 hidden");
  expect_rejected(with([](Hidden& entry) {
                    entry.target = {at(0, -99, 4), at(0, 1, 4), at(1, 1, 4), at(1, -99, 4)};
                  }),
                  "hidden 2 (face 2), node 1 is not blocked by fragment 1");
  // What a target must be.
  expect_rejected(with([](Hidden& entry) { entry.target.clear(); }),
                  "hidden 2 is of several fragments, but its proof is neither one leaf nor of a polygon");
  expect_rejected(with([](Hidden& entry) { std::reverse(entry.target.begin(), entry.target.end()); }),
                  "hidden 2 (face 2), its target ");
  expect_rejected(with([](Hidden& entry) { entry.target[2][2] = 5; }), "hidden 2 (face 2), its target ");
  expect_rejected(with([](Hidden& entry) { entry.target.resize(2); }), "hidden 2 (face 2), its target ");
  expect_rejected(with([](Hidden& entry) { std::swap(entry.target[0], entry.target[1]); }),
                  "hidden 2 (face 2), its target ");
  expect_rejected(with([](Hidden& entry) { mpq_set_ui(entry.target[0][2].get_mpq_t(), 8, 2); }),
                  "hidden 2 (face 2) has a target with a vertex that is not in canonical numbers");
  expect_rejected(with([](Hidden& entry) {
                    entry.target[1] = {Rational(1, 99), 1, 4};
                  }),
                  "hidden 2 (face 2) has a corner outside of its target");
  expect_rejected(with([](Hidden& entry) {
                    entry.target[3] = {Rational(98, 99), 0, 4};
                  }),
                  "hidden 2 (face 3) has a corner outside of its target");
  // What is in it.
  Weak_scene elsewhere = right;
  elsewhere.certificate.hidden.back().also.push_back(0);
  elsewhere.certificate.hidden.erase(elsewhere.certificate.hidden.begin());
  expect_rejected(elsewhere, "hidden 1 (face 0) is not in the plane of its target, or looks to the other side");
  Weak_scene turned = right;
  const std::size_t back = turned.face({at(0, 0, 4), at(1, 0, 4), at(0, 1, 4)});
  turned.certificate.hidden.back().also.push_back(back);
  expect_rejected(turned, "hidden 2 (face 4) is not in the plane of its target, or looks to the other side");
  turned.certificate.hidden.back().also.back() = 9;
  expect_rejected(turned, "hidden 2 names fragment 9, which there is not");
}

TEST(Weak_faces, are_hidden_with_all_fragments_from_all_sources) {
  const Weak_scene whole = two_sources();
  for (std::size_t k = 0; k < whole.certificate.hidden.size(); ++k) {
    Weak_scene scene = whole;
    scene.certificate.hidden.erase(scene.certificate.hidden.begin() + static_cast<std::ptrdiff_t>(k));
    const std::size_t fragment = whole.certificate.hidden[k].fragment, source = whole.certificate.hidden[k].source;
    expect_rejected(scene, "is neither visible nor undecided, and fragment " + std::to_string(fragment) +
                               " of it is not shown to be hidden from source " + std::to_string(source));
    scene.certificate.undecided.push_back(whole.certificate.fragments[fragment].face);
    expect_accepted(scene, "0 faces visible, 2 hidden, 2 undecided from 2");  // part of a proof is welcome
  }
  // One fragment seen from one source is enough for its face.
  Weak_scene scene = whole;
  scene.certificate.undecided.clear();
  scene.see(4, at(ratio(1, 4), ratio(1, 2), 0), at(ratio(1, 4), ratio(1, 2), 2));
  expect_rejected(scene, "visible 0 (face 3) meets fragment 1");
  Weak_scene wide = open_slit();
  wide.certificate.fragments[0].vertices = {at(0, 0, 3), at(0, 1, 3), at(ratio(1, 10), 1, 3), at(ratio(1, 10), 0, 3)};
  wide.certificate.fragments.push_back(
      {0, 0, {at(ratio(1, 10), 0, 3), at(ratio(1, 10), 1, 3), at(1, 1, 3), at(1, 0, 3)}});
  wide.certificate.visible[0].fragment = 3;
  expect_accepted(wide, "1 faces visible, 2 hidden");
  Weak_scene set_aside = one_blocker();
  set_aside.soup.add_face({0, 1, 0});
  set_aside.certificate.set_aside.push_back({2, "zero area"});
  expect_accepted(set_aside, "0 faces visible, 2 hidden");
  set_aside.certificate.undecided = {2};
  expect_rejected(set_aside, "undecided names face 2, which is not drawn");
}

}  // namespace

}  // namespace weak_test
