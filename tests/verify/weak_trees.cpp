// Trees that show that nothing is seen (P-72): each rule broken alone is rejected for its reason, and sizes are no
// danger.

#include "weak_scenes.h"

namespace weak_test {

namespace {

void expect_rejected_with(Weak_scene scene, const Proof& proof, const std::string& words, std::size_t entry = 0) {
  scene.certificate.hidden[entry].proof = proof;
  expect_rejected(scene, words);
}

// ---- Trees

TEST(Tree, of_what_is_not_there_is_rejected) {
  Weak_scene scene = one_blocker();
  scene.certificate.hidden[1].fragment = 2;
  expect_rejected(scene, "hidden 1 names fragment 2, which there is not");
  scene = one_blocker();
  scene.certificate.hidden[1].source = 1;
  expect_rejected(scene, "hidden 1 (face 1) names source 1, which there is not");
  for (const Weak_certificate::Edge& edge : {Weak_certificate::Edge{3, 0}, {1, 4}}) {
    scene = two_abutting();
    scene.certificate.lines.push_back(edge);
    expect_rejected(scene, "line 1 names an edge that there is not");
  }
  expect_rejected_with(two_abutting(), {side_of(1), blocked(2), blocked(1)},
                       "hidden 0 (face 0), node 0 names line 1, which there is not");
  expect_rejected_with(one_blocker(), {blocked(2)},
                       "hidden 0 (face 0), node 0 is blocked by fragment 2, which there is not");
  expect_rejected_with(one_blocker(), {node(static_cast<Kind>(9))},
                       "hidden 0 (face 0), node 0 is of no kind that there is");
}

TEST(Tree, that_ends_early_or_goes_on_is_rejected) {
  const std::string early = "hidden 0 (face 0) ends before each of its cells has a leaf";
  expect_rejected_with(one_blocker(), {}, early);
  const Proof whole = t_junction().certificate.hidden[0].proof;
  for (std::size_t n = 0; n < whole.size(); ++n)
    expect_rejected_with(t_junction(), Proof(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(n)), early);
  expect_rejected_with(one_blocker(), {blocked(1), blocked(1)},
                       "hidden 0 (face 0) goes on after its last leaf, with node 1");
  expect_rejected_with(one_blocker(), {blocked(1), node(Kind::line, 99)}, "goes on after its last leaf");
}

TEST(Tree, has_the_positive_side_of_a_line_first) {
  expect_rejected_with(two_abutting(), {side_of(0), blocked(1), blocked(2)},
                       "hidden 0 (face 0), node 1 is not blocked by fragment 1: lines may pass an edge of it outside");
  expect_rejected_with(two_abutting(), {side_of(0), blocked(2), blocked(2)},
                       "node 2 is not blocked by fragment 2: lines may pass an edge of it outside");
  expect_rejected_with(two_abutting(), {blocked(1)},
                       "node 0 is not blocked by fragment 1: lines may pass an edge of it outside");
  // What was decided on one side of a line does not count on the other, nor after both.
  expect_rejected_with(t_junction(), {side_of(1), side_of(0), blocked(3), blocked(1), blocked(2)},
                       "node 4 is not blocked by fragment 2");
  expect_rejected_with(t_junction(), {side_of(0), side_of(1), blocked(3), blocked(2), blocked(2)},
                       "node 4 is not blocked by fragment 2");
  Weak_scene scene = t_junction();
  scene.certificate.hidden[0].proof = {side_of(1), side_of(0), blocked(3), blocked(1),
                                       side_of(0), blocked(2), blocked(1)};
  expect_accepted(scene);
  // A line may be decided twice; the second time counts within.
  scene.certificate.hidden[0].proof = {side_of(0), side_of(0), side_of(1), blocked(3),
                                       blocked(2), blocked(1), blocked(1)};
  expect_accepted(scene);
  scene.certificate.hidden[0].proof = {side_of(0), side_of(1), side_of(0), blocked(3), blocked(1), side_of(0),
                                       blocked(2), blocked(1), side_of(1), blocked(1), blocked(1)};
  expect_accepted(scene);
  scene.certificate.hidden[0].proof = {side_of(0), side_of(1), side_of(0), blocked(3),
                                       blocked(1), blocked(2), blocked(1)};  // and the first time again after it
  expect_accepted(scene);
  expect_rejected_with(t_junction(),
                       {side_of(0), side_of(0), side_of(1), blocked(3), blocked(2), blocked(1), blocked(3)},
                       "node 6 is not blocked by fragment 3");
}

TEST(Tree, has_leaves_that_block) {
  // Its plane must be between: not behind the target, not through the source, not with both in it.
  Weak_scene scene = one_blocker();
  scene.face(up(-5, 6, -5, 6, 4));
  scene.hide(2, {away()});
  expect_rejected_with(
      scene, {blocked(2)},
      "hidden 0 (face 0), node 0 is not blocked by fragment 2: its plane is not between source and fragment");
  expect_rejected_with(scene, {blocked(0)}, "its plane is not between source and fragment");
  expect_rejected_with(source_through_floor(), {blocked(2)},
                       "hidden 0 (face 0), node 0 is not blocked by fragment 2: its plane is not between");
  expect_rejected_with(source_through_floor(), {blocked(1)}, "lines may pass an edge of it outside");
  Weak_scene in_plane = nothing_between();
  in_plane.face(down(-5, 6, -5, 6, 3));
  in_plane.face(up(-5, 6, -5, 6, 0));
  in_plane.certificate.undecided = {1, 2};
  in_plane.hide(0, {blocked(1)});
  expect_rejected(in_plane, "node 0 is not blocked by fragment 1: its plane is not between source and fragment");
  expect_rejected_with(in_plane, {blocked(2)},
                       "node 0 is not blocked by fragment 2: its plane is not between source and fragment");
  // It may touch source and target, and lines may touch its edges: on the closed side all are blocked.
  // What was found of an edge for one leaf is used for the next one: here it is the other blocker's inside.
  Weak_scene beside = nothing_between();
  beside.face(up(-5, 2, -5, 6, 1));
  beside.face(up(2, 6, -5, 6, 1));
  beside.line(0, 0);
  beside.hide(0, {side_of(0), blocked(1), blocked(2)});
  expect_rejected(beside, "node 2 is not blocked by fragment 2: lines may pass an edge of it outside");
  Weak_scene exact = nothing_between();
  exact.face(up(0, 1, 0, 1, 1));
  expect_accepted(exact.hide(0, {blocked(1)}).hide(1, {away()}));
  exact.certificate.sources[0][2][0] += tiny(50);
  expect_rejected(exact, "node 0 is not blocked by fragment 1: lines may pass an edge of it outside");
  Weak_scene touching = nothing_between();  // the blocker leads from an edge of the source to one of the target
  touching.face({at(0, -9, 0), at(1, -9, 3), at(1, 9, 3), at(0, 9, 0)});
  touching.certificate.sources[0] = up(0, 1, 0, 1, 0);
  touching.certificate.undecided = {1};
  touching.hide(0, {blocked(1)});
  expect_accepted(touching);
}

TEST(Tree, has_leaves_that_are_away) {
  const std::string words = "hidden 0 (face 0), node 0 is not away: source and fragment look to each other";
  expect_rejected_with(one_blocker(), {away()}, words);
  Weak_scene scene = one_blocker();
  scene.certificate.two_sided = true;
  expect_rejected(scene, "hidden 1 (face 1), node 0 is not away");
  scene = target_through_ground();
  expect_rejected_with(scene, {away()}, words);
  expect_rejected_with(scene, {cut_target(form(0, 0, 1, 0)), away(), blocked(1)}, "node 1 is not away");
  scene.certificate.sources[0][0][2] = 0;
  // A wall in whose plane the source begins: from the other side nothing is in front of it.
  Weak_scene board;
  board.from(up(0, 1, 0, 1, 0)).face({at(0, 0, 1), at(0, 1, 1), at(0, 1, 2), at(0, 0, 2)});  // looks to +x
  board.hide(0, {away()});
  expect_rejected(board, words);
  std::reverse(board.certificate.fragments[0].vertices.begin(), board.certificate.fragments[0].vertices.end());
  expect_rejected(board, "clockwise");
  Weak_scene turned;
  turned.from(up(0, 1, 0, 1, 0)).face({at(0, 0, 2), at(0, 1, 2), at(0, 1, 1), at(0, 0, 1)});
  turned.hide(0, {away()});
  expect_accepted(turned);
  turned.certificate.two_sided = true;
  expect_rejected(turned, words);
  // Two-sided: a source in the fragment's plane does not see it, one that crosses the plane does.
  Weak_scene flat = all_away();
  flat.certificate.two_sided = true;
  expect_rejected(flat, "hidden 2 (face 2), node 0 is not away");
  flat.certificate.hidden.pop_back();
  expect_accepted(flat.see(2, at(ratio(1, 2), ratio(1, 2), 0), at(ratio(1, 2), ratio(1, 2), 2)),
                  "1 faces visible, 2 hidden");
  Weak_scene upright;
  upright.certificate.two_sided = true;
  upright.from({at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)})
      .face({at(0, 3, 0), at(0, 4, 0), at(0, 4, 1), at(0, 3, 1)});
  expect_accepted(upright.hide(0, {away()}));
  Weak_scene across = upright;
  across.soup = {};
  across.certificate.fragments.clear();
  across.face({at(1, 0, ratio(1, 2)), at(2, 0, ratio(1, 2)), at(2, 1, ratio(1, 2))});
  expect_rejected(across, words);
  across.certificate.hidden[0].proof = {cut_source(form(0, 0, 2, -1)), away(), away()};
  expect_rejected(across, "node 1 is not away");
}

TEST(Tree, cuts_by_planes_that_leave_something) {
  const std::string entry = "hidden 0 (face 0), node 0 cuts by a plane that ";
  for (const Form& plane : {form(0, 0, 1, 0), form(0, 0, -7, 0), form(0, 0, 0, 0)})
    expect_rejected_with(one_blocker(), {cut_source(plane), blocked(1), blocked(1)}, entry + "holds all of the source");
  for (const Form& plane : {form(0, 0, 1, -3), form(0, 0, 0, 0)})
    expect_rejected_with(one_blocker(), {cut_target(plane), blocked(1), blocked(1)},
                         entry + "holds all of the fragment");
  for (const Rational& bad : {doubled(), infinite()}) {
    expect_rejected_with(one_blocker(), {cut_source(form(1, 0, 0, bad)), blocked(1), blocked(1)},
                         entry + "is not in canonical numbers");
    expect_rejected_with(one_blocker(), {cut_target(form(bad, 0, 0, 1)), blocked(1), blocked(1)},
                         entry + "is not in canonical numbers");
  }
  // A plane that misses it, or touches it, leaves nothing on one side; that side has an empty leaf, and nothing else.
  for (const Form& plane : {form(1, 0, 0, 1), form(1, 0, 0, 0), form(0, 0, 0, 5), form(1, 1, 0, 0)}) {
    Form negative = plane;
    for (Rational& r : negative) r = -r;
    for (const auto& cut : {cut_source, cut_target}) {
      Weak_scene scene = one_blocker();
      scene.certificate.hidden[0].proof = {cut(plane), blocked(1), empty()};
      expect_accepted(scene);
      scene.certificate.hidden[0].proof = {cut(negative), empty(), blocked(1)};
      expect_accepted(scene);
      for (const Node& other : {blocked(1), away(), cut_source(form(1, 0, 0, -2)), empty({term(0, 1)})})
        expect_rejected_with(one_blocker(), {cut(plane), blocked(1), other},
                             "node 2 is below a cut that leaves nothing inside, but is no empty leaf without terms");
      expect_rejected_with(one_blocker(), {cut(plane), empty(), blocked(1)},
                           "node 1 says without terms that a cell with an inside is empty");
    }
  }
  Weak_scene lines = two_abutting();
  expect_rejected_with(lines,
                       {cut_source(form(1, 0, 0, 0)), side_of(0), blocked(2), blocked(1), side_of(0), empty(), empty()},
                       "node 4 is below a cut that leaves nothing inside");
}

TEST(Tree, cuts_first_where_the_plane_is_positive) {
  expect_rejected_with(source_through_floor(), {cut_source(form(0, 0, -1, 0)), blocked(1), blocked(2)},
                       "node 1 is not blocked by fragment 1: lines may pass");
  expect_rejected_with(source_through_floor(), {cut_target(form(0, 0, 1, 0)), blocked(1), empty()},
                       "node 1 is not blocked by fragment 1: lines may pass");
  Weak_scene scene = source_through_floor();
  scene.certificate.hidden[0].proof = {cut_source(form(0, 0, -3, 0)), blocked(2), blocked(1)};
  expect_accepted(scene);
  // Just off the floor's plane neither part is right.
  expect_rejected_with(source_through_floor(), {cut_source(form(0, 0, 1, tiny(40))), blocked(1), blocked(1)},
                       "node 2 is not blocked by fragment 1: lines may pass");
  expect_rejected_with(source_through_floor(), {cut_source(form(0, 0, 1, -tiny(40))), blocked(1), blocked(2)},
                       "node 2 is not blocked by fragment 2: its plane is not between");
  // Parts are cut again, and lines decided above a cut hold below it.
  scene = two_abutting();
  scene.certificate.hidden[0].proof = {
      side_of(0), cut_source(form(1, 1, 0, -1)), cut_target(form(1, -1, 0, 0)), blocked(2), blocked(2), blocked(2),
      blocked(1)};
  expect_accepted(scene);
  // Where a part sees the line from one side only, the line need not be decided.
  scene.certificate.hidden[0].proof = {cut_source(form(2, 0, 0, -1)),
                                       cut_target(form(2, 0, 0, -1)),
                                       blocked(2),
                                       side_of(0),
                                       blocked(2),
                                       blocked(1),
                                       side_of(0),
                                       blocked(2),
                                       blocked(1)};
  expect_accepted(scene);
  scene.certificate.hidden[0].proof = {cut_source(form(2, 0, 0, -1)),
                                       cut_target(form(2, 0, 0, -1)),
                                       blocked(2),
                                       blocked(2),
                                       side_of(0),
                                       blocked(2),
                                       blocked(1)};
  expect_rejected(scene, "node 3 is not blocked by fragment 2: lines may pass");
}

// ---- Empty cells

void expect_rejected_terms(const Weak_scene& scene, const std::vector<Term>& terms, const std::string& words) {
  Weak_scene changed = scene;
  changed.certificate.hidden[0].proof[2].terms = terms;
  expect_rejected(changed, "hidden 0 (face 0), node 2 " + words);
}

TEST(Empty_cell, needs_multipliers_within_sharp_bounds) {
  // The edges are 11 and 22 long, so 2 : 1 is balanced; half and twice of that are the last that will do.
  const std::string positive = "is not shown to be empty: its sum has a positive coefficient";
  for (const Rational& first : {Rational(1), Rational(2), Rational(4)}) expect_accepted(closed_slit(first, 1));
  for (const Rational& first : {Rational(1 - tiny(60)), Rational(4 + tiny(60)), tiny(60), Rational(100)})
    expect_rejected_terms(closed_slit(), {term(0, first), term(1, 1)}, positive);
  expect_rejected_terms(closed_slit(), {term(0, 1)}, positive);
  expect_rejected_terms(closed_slit(), {term(1, 1)}, positive);
  expect_accepted(closed_slit(ratio(2, 1000003), ratio(1, 1000003)));
  // A hair more room, and lines pass.
  EXPECT_FALSE(closed_slit(2, 1, -tiny(60)).verdict().accepted);
  expect_accepted(closed_slit(2, 1, tiny(60)));
  // One term may be given in parts.
  Weak_scene scene = closed_slit();
  scene.certificate.hidden[0].proof[2].terms = {term(0, ratio(1, 3)), term(1, 1), term(0, ratio(5, 3))};
  expect_accepted(scene);
}

TEST(Empty_cell, has_terms_that_are_positive_on_it) {
  for (const Rational& factor : {Rational(0), Rational(-1), doubled(), infinite()})
    expect_rejected_terms(closed_slit(), {term(0, factor), term(1, 1)},
                          "has a factor that is not positive, or not in canonical numbers");
  expect_rejected_terms(closed_slit(), {}, "says without terms that a cell with an inside is empty");
  expect_rejected_terms(closed_slit(), {term(0, 1), term(2, 1)}, "has a term of line 2, which there is not");
  Weak_scene scene = closed_slit();
  scene.line(1, 0);
  expect_rejected_terms(scene, {term(0, 2), term(2, 1)}, "has a term of line 2, which is not decided above it");
  expect_rejected_with(closed_slit(), {side_of(1), empty({term(0, 2), term(1, 1)}), blocked(2)},
                       "node 1 has a term of line 0, which is not decided above it");
  // Either side: a line that is negative in the cell counts as what is positive, so its other side is not empty.
  expect_rejected_with(closed_slit(), {side_of(0), side_of(1), blocked(2), empty({term(0, 2), term(1, 1)}), blocked(1)},
                       "node 2 is not blocked");
  expect_rejected_with(
      closed_slit(),
      {side_of(0), side_of(1), empty({term(0, 2), term(1, 1)}), empty({term(0, 2), term(1, 1)}), blocked(1)},
      "node 3 is not shown to be empty");
  // The other name of the same line, the other way round, is the same condition at another scale.
  scene = closed_slit();
  scene.face(up(1, 3, 20, 21, 1));
  const std::size_t other = scene.line(3, 3);
  scene.hide(3, {away()}).certificate.hidden[0].proof[2].terms = {term(other, 22), term(1, 1)};
  expect_accepted(scene);
  scene.certificate.hidden[0].proof[2].terms[0].factor = Rational(44) + tiny(60);
  expect_rejected(scene, "its sum has a positive coefficient");
}

TEST(Empty_cell, may_need_multipliers_that_are_forms) {
  const std::string positive = "is not shown to be empty: its sum has a positive coefficient";
  for (const bool mirrored : {false, true}) {
    const Weak_scene scene = mirrored ? skew_slit_mirrored() : skew_slit();
    SCOPED_TRACE(mirrored);
    expect_accepted(scene);
    const auto terms = [&](const Form& f, const Rational& factor) {
      return std::vector<Term>{mirrored ? term(0, factor, {}, f) : term(0, factor, f), term(1, 1)};
    };
    // No constant will do, whatever the ratio of the factors.
    for (int k = 1; k < 400; k += static_cast<int>(share))
      expect_rejected_terms(scene, {term(0, ratio(k, 1000)), term(1, 1)}, positive);
    // Nor will a form on the other side, nor a sum of single ones.
    expect_rejected_terms(
        scene,
        {mirrored ? term(0, ratio(5, 81), form(0, 1, 0, 1)) : term(0, ratio(5, 81), {}, form(1, 0, 0, 1)), term(1, 1)},
        positive);
    expect_rejected_terms(scene, terms(form(0, 0, 0, 1), ratio(5, 81)), positive);
    // Forms of any scale, and those zero on a border.
    Weak_scene scaled = scene;
    scaled.certificate.hidden[0].proof[2].terms = terms(form(ratio(1, 7), 0, 0, ratio(1, 7)), ratio(35, 81));
    expect_accepted(scaled);
    scaled.certificate.hidden[0].proof[2].terms.push_back(
        term(0, tiny(20), mirrored ? form(0, 1, 0, 0) : form(1, 0, 0, 0)));
    expect_accepted(scaled);
    expect_rejected_terms(scene, terms(form(1, 0, 0, -tiny(60)), ratio(5, 81)),
                          "has a form that is negative somewhere, or zero everywhere");
    expect_rejected_terms(scene, terms(form(-1, 0, 0, -1), ratio(5, 81)),
                          "has a form that is negative somewhere, or zero everywhere");
    expect_rejected_terms(scene, terms(form(0, 0, 1, mirrored ? -1 : 0), ratio(5, 81)),
                          "has a form that is negative somewhere, or zero everywhere");
    expect_rejected_terms(scene, terms(form(0, 0, 0, 0), ratio(5, 81)),
                          "has a form that is negative somewhere, or zero everywhere");
    expect_rejected_terms(scene, terms(form(1, 0, doubled(), 1), ratio(5, 81)),
                          "has a form that is not in canonical numbers");
    expect_rejected_terms(scene, terms(form(1, 0, 0, 1), -ratio(5, 81)), "has a factor that is not positive");
  }
}

TEST(Empty_cell, is_judged_as_by_interpolation_on_random_terms) {
  std::size_t accepted = 0, rejected = 0;
  for (unsigned seed = 0; seed < 3000 / share; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    const auto number = [&] { return ratio(roll(dice, -6, 6), roll(dice, 1, 3)); };
    Weak_scene scene;
    scene.from({at(0, 0, 0), at(roll(dice, 1, 3), 0, 0), at(roll(dice, 0, 2), roll(dice, 1, 2), 0)})
        .face({at(0, 0, 4), at(0, roll(dice, 1, 3), 4), at(roll(dice, 1, 3), number(), 4)});
    const std::size_t lines = static_cast<std::size_t>(roll(dice, 1, 3));
    for (std::size_t k = 0; k < lines; ++k) {
      const Exact_point a = at(number(), number(), roll(dice, 1, 3));
      const std::size_t f = scene.face({a, along(a, 1, at(number(), number(), roll(dice, 0, 1) + ratio(1, 7))),
                                        along(a, 1, at(number(), number(), ratio(1, 19)))});
      scene.line(f, static_cast<std::size_t>(roll(dice, 0, 2)));
      scene.certificate.undecided.push_back(static_cast<Face_id>(f));
    }
    const auto& c = scene.certificate;
    const Points &source = c.sources[0], &target = c.fragments[0].vertices;
    if (std::any_of(c.fragments.begin(), c.fragments.end(),
                    [](const Order_fragment& f) { return Judged(f.vertices).normal == at(0, 0, 0); }))
      continue;
    // Random terms, all lines positive.
    const auto random_form = [&](const Points& polygon, bool often) -> std::optional<Form> {
      if (roll(dice, 0, 2) < (often ? 1 : 2)) return std::nullopt;
      const Rational a = number(), b = number();
      Rational least = 1000, most = -1000;
      for (const Exact_point& p : polygon) {
        least = std::min(least, Rational(a * p[0] + b * p[1]));
        most = std::max(most, Rational(a * p[0] + b * p[1]));
      }
      if (least == most) return form(0, 0, 0, ratio(2, 3));
      return form(a, b, 0, roll(dice, 0, 1) == 0 ? Rational(-least) : Rational(1 - least));
    };
    std::vector<Term> terms;
    for (std::size_t k = 0; k < lines; ++k)
      terms.push_back(
          term(k, ratio(roll(dice, 1, 9), roll(dice, 1, 9)), random_form(source, true), random_form(target, false)));
    Proof proof;
    for (std::size_t k = 0; k < lines; ++k) proof.push_back(side_of(k));
    proof.push_back(empty(terms));
    scene.hide(0, proof);  // and no more: rejected at the leaf, or for ending early

    // The sum as a polynomial; the coefficient of two weights from its values at corners and half-way points.
    bool source_forms = false, target_forms = false;
    for (const Term& t : terms) {
      source_forms = source_forms || t.source;
      target_forms = target_forms || t.target;
    }
    const auto at_form = [](const std::optional<Form>& f, const Exact_point& p) {
      return f ? Rational((*f)[0] * p[0] + (*f)[1] * p[1] + (*f)[2] * p[2] + (*f)[3]) : Rational(1);
    };
    const auto sum = [&](const Exact_point& p, const Exact_point& q) {
      Rational total = 0;
      for (const Term& t : terms) {
        const auto& [fragment, corner] = c.lines[t.line];
        const Points& polygon = c.fragments[fragment].vertices;
        total += t.factor * at_form(t.source, p) * at_form(t.target, q) *
                 side_value(p, q, polygon[corner], polygon[(corner + 1) % 3]);
      }
      return total;
    };
    const auto half = [](const Exact_point& a, const Exact_point& b) {
      return at((a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2);
    };
    const auto pair_of = [&](const Points& polygon, std::size_t i, std::size_t j, const auto& f) {
      return i == j ? Rational(f(polygon[i]))
                    : Rational(4 * f(half(polygon[i], polygon[j])) - f(polygon[i]) - f(polygon[j]));
    };
    bool right = true;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < (source_forms ? 3 : i + 1); ++j)
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t l = k; l < (target_forms ? 3 : k + 1); ++l)
            right = right && pair_of(source, i, j, [&](const Exact_point& p) {
                               return pair_of(target, k, l, [&](const Exact_point& q) { return sum(p, q); });
                             }) <= 0;
    const std::string leaf = "node " + std::to_string(lines);
    expect_rejected(scene, right ? "ends before" : leaf + " is not shown to be empty");
    ++(right ? accepted : rejected);
  }
  EXPECT_GT(accepted, 300 / share);
  EXPECT_GT(rejected, 300 / share);
}

// ---- Size

TEST(Weak_size, of_a_tree_may_be_a_million_deep) {
  const std::size_t depth = 1'000'000 / share;
  for (const bool left : {true, false}) {
    Weak_scene scene = one_blocker();
    scene.line(1, 1);
    Proof& proof = scene.certificate.hidden[0].proof;
    proof.clear();
    for (std::size_t k = 0; k < depth; ++k) {
      proof.push_back(side_of(0));
      if (!left) proof.push_back(blocked(1));
    }
    proof.insert(proof.end(), left ? depth + 1 : 1, blocked(1));
    std::size_t calls = 0, last = 0;
    Verify_options options;
    options.progress = [&](std::size_t done, std::size_t total) {
      ++calls;
      last = done;
      EXPECT_EQ(total, 2u);
    };
    const Verdict verdict = verify_weak(scene.soup, scene.certificate, options);
    EXPECT_TRUE(verdict.accepted) << verdict.why;
    EXPECT_GT(calls, 1000 / share);
    EXPECT_EQ(last, 2u);
    proof.pop_back();
    expect_rejected(scene, "ends before each of its cells has a leaf");
  }
}

TEST(Weak_size, of_a_leaf_of_many_corners_asks_whether_to_go_on_before_each_edge) {
  // Regular enough: points of a parabola, there and back along its chord.
  const long corners = 60;
  const auto disc = [&](long reach, const Rational& z, bool looks_up) {
    Points result;
    for (long k = 0; k <= corners; ++k) {
      const Rational t = 2 * ratio(k, corners) - 1;
      result.push_back(at(reach * t, reach * (t * t - 1) + reach - 1, z));
    }
    return looks_up ? result : reversed(result);
  };
  Weak_scene scene;
  scene.from(disc(1, 0, true)).face(disc(1, 3, false));
  scene.face(disc(9, 1, true));
  scene.hide(0, {blocked(1)}).hide(1, {away()});
  std::size_t calls = 0;
  Verify_options options;
  options.progress = [&](std::size_t, std::size_t) { ++calls; };
  EXPECT_TRUE(verify_weak(scene.soup, scene.certificate, options).accepted)
      << verify_weak(scene.soup, scene.certificate).why;
  EXPECT_GT(calls, static_cast<std::size_t>(corners));
}

TEST(Weak_size, of_cuts_and_cells_is_bounded) {
  const auto shaved = [](std::size_t cuts, bool left) {
    // Tangents of a parabola, so that each cuts a corner off.
    Weak_scene scene = one_blocker();
    Proof& proof = scene.certificate.hidden[0].proof;
    proof.clear();
    for (std::size_t k = 1; k <= cuts; ++k) {
      const Rational t = ratio(static_cast<long>(k), 2000);
      const Form plane = left ? form(-2 * t, 1, 0, t * t) : form(2 * t, -1, 0, -t * t);
      proof.push_back(cut_source(plane));
      if (!left) proof.push_back(blocked(1));
    }
    proof.insert(proof.end(), left ? cuts + 1 : 1, blocked(1));
    return scene;
  };
  for (const bool left : {true, false}) {
    if (!left && test_scenes::is_sanitized()) continue;  // as many cells again
    if (!test_scenes::is_sanitized()) expect_accepted(shaved(1000, left));
    expect_rejected(shaved(1001, left), "is below more than 1000 cuts");
  }
  const auto disc = [](long n, const Rational& z, bool looks_up) {  // on a parabola
    Points result;
    for (long k = 0; k <= n; ++k) result.push_back(at(ratio(k, n), ratio(k, n) * ratio(k, n), z));
    return looks_up ? result : reversed(result);
  };
  Weak_scene round;
  round.from(disc(1000, 0, true)).face(disc(1000, 3, false));
  round.face(up(-5, 6, -5, 6, 1));
  round.line(1, 1);
  round.hide(0, {blocked(1)}).hide(1, {away()});
  expect_accepted(round);
  round.certificate.hidden[0].proof = {side_of(0), empty({term(0, 1, form(0, 0, 0, 1))}), blocked(1)};
  expect_rejected(round, "node 1 has too many terms for its corners to be checked");
  round.certificate.hidden[0].proof = {side_of(0), empty(std::vector<Term>(11, term(0, 1))), blocked(1)};
  expect_rejected(round, "node 1 has too many terms for its corners to be checked");
  round.certificate.hidden[0].proof = {side_of(0), empty({term(0, 1)}), blocked(1)};
  expect_accepted(round);  // nothing passes on that side
  Weak_scene large;
  large.from(disc(4000, 0, true)).face(disc(4000, 3, false));
  large.face(up(-5, 6, -5, 6, 1));
  large.hide(0, {blocked(1)}).hide(1, {away()});
  expect_rejected(large, "fragment 0 and source 0 have too many corners to be checked");
  Weak_scene turned;  // what is away takes each corner once
  turned.from(disc(4000, 0, true)).face(disc(4000, 3, true));
  expect_accepted(turned.hide(0, {away()}), " and 3993 more corners looking to ");
  Weak_scene terms = closed_slit();
  Rational fine = 1 / Rational((Integer(1) << 6'000'000) + 1);
  terms.certificate.hidden[0].proof[2].terms = {term(0, fine), term(1, fine)};
  expect_rejected(terms, "node 2 has factors that are too long to be checked");
}

TEST(Weak_size, of_numbers_may_be_absurd) {
  const Rational huge = 1 / tiny(20000), small = tiny(20000);
  Weak_scene scene = one_blocker();
  scene.certificate.hidden[0].proof = {cut_source(form(huge, -small, 0, -small)), cut_target(form(small, huge, 0, -1)),
                                       blocked(1), blocked(1), blocked(1)};
  expect_accepted(scene);
  scene = closed_slit(Rational(2 * small), small);
  expect_accepted(scene);
  scene = closed_slit(2, small);
  expect_rejected(scene, "positive coefficient");
  scene = open_slit();
  scene.certificate.visible[0].from[0] += small;
  expect_accepted(scene);
  scene.certificate.visible[0].from[0] += huge;
  expect_rejected(scene, "does not begin inside");
}

}  // namespace

}  // namespace weak_test
